//! What a pass is: a name, a line about it, and how it is run.
//!
//! Each pass is a `PASS` in its own file, which says what makes it needed; [`crate::PASSES`] is the table of them, and its
//! order is the order in which they run. A new pass is a file and a line of the table.

use ncc_ir::canon::Modes;
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::{Lines, Program, Stmt};
use ncc_ir::track::Tracker;

use crate::Target;
use crate::legalise::Legaliser;
use crate::parametric::Parametric;
use crate::support::walk::Walk;

/// A pass on a whole program; the tracker says what holds before the main procedure.
pub type Alone = fn(&mut Program, &Target, &Tracker, &mut Vec<Diagnostic>);

/// A pass.
#[derive(Clone, Copy, Debug)]
pub struct Pass {
    /// Its name.
    pub name: &'static str,
    /// What it does, in a line.
    pub about: &'static str,
    /// Runs it where it is asked for by name; `None` of one that has no sense alone.
    pub alone: Option<Alone>,
    /// How the legaliser runs it on a piece of a program; `None` of one that it does not run so.
    pub(crate) step: Option<Step>,
    /// How it is run on a program that computes; `None` of one that is not.
    pub(crate) parametric: Option<Whole>,
}

impl Pass {
    /// One that is run by name alone, or by whoever keeps a program whole.
    pub(crate) const fn whole(name: &'static str, about: &'static str, alone: Option<Alone>) -> Pass {
        Pass { name, about, alone, step: None, parametric: None }
    }

    /// One that is run on programs that compute.
    pub(crate) const fn parametric(
        name: &'static str,
        about: &'static str,
        needed: Needed,
        run: Run,
    ) -> Pass {
        let parametric = Some(Whole { needed, run });
        Pass { name, about, alone: None, step: None, parametric }
    }
}

/// What makes a pass on a program that computes needed.
pub(crate) type Needed = fn(&Parametric, &Program) -> bool;

/// Runs a pass on a program that computes.
pub(crate) type Run = fn(&mut Program, &mut Parametric, &mut Vec<Diagnostic>);

/// A pass on a program that computes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Whole {
    /// What makes it needed.
    pub(crate) needed: Needed,
    /// Runs it.
    pub(crate) run: Run,
}

/// When the legaliser runs a pass on a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Moment {
    /// As the piece comes, before it is known what it needs.
    Arrival,
    /// What says where things are: frames, offsets, corners. Behind it the tool is followed anew.
    Placing,
    /// All else that the target lacks.
    Wording,
    /// When nothing else is changed any more.
    Departure,
}

/// A pass on a piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    /// When it is run.
    pub(crate) moment: Moment,
    /// What makes it needed.
    pub(crate) needed: fn(&Legaliser, &Piece) -> bool,
    /// Runs it.
    pub(crate) run: fn(&mut Legaliser, &mut Piece),
    /// Follows a piece that does not need it.
    pub(crate) otherwise: fn(&mut Legaliser, &Piece),
}

impl Step {
    /// One that follows nothing.
    pub(crate) const fn at(
        moment: Moment,
        needed: fn(&Legaliser, &Piece) -> bool,
        run: fn(&mut Legaliser, &mut Piece),
    ) -> Option<Step> {
        Some(Step { moment, needed, run, otherwise: |_, _| {} })
    }
}

/// A piece of a program on its way through the steps.
pub(crate) struct Piece<'p> {
    pub(crate) stmts: &'p mut Vec<Stmt>,
    /// What its statements need that the target lacks: bits of `support::needs`.
    pub(crate) needs: u32,
    /// What holds before it: every pass walks from there.
    pub(crate) start: &'p Walk,
    /// Facts taken for granted so far.
    pub(crate) assumed: &'p Modes,
    /// Whether it goes along lines alone, by words from zero.
    pub(crate) lines: Option<Lines>,
    pub(crate) diags: &'p mut Vec<Diagnostic>,
    /// Whether the rest has been done on a copy, which is the piece now.
    pub(crate) done: bool,
}

impl Piece<'_> {
    /// Whether it needs any of these.
    pub(crate) fn needs(&self, any: u32) -> bool {
        self.needs & any != 0
    }
}
