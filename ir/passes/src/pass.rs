//! What a pass is: a name, a line about it, and how it is run.
//!
//! Each pass is a `PASS` in its own file, which says what makes it needed; [`crate::table::PASSES`] is the table of them, and its
//! order is the order in which they run. A new pass is a file and a line of the table.

use std::collections::BTreeSet;
use std::rc::Rc;

use ncc_ir::canon::Modes;
use ncc_ir::caps::Caps;
use ncc_ir::computed::computes::Computes;
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Num;
use ncc_ir::expr::system::System;
use ncc_ir::geometry::arc_solver::ArcRule;
use ncc_ir::program::{Lines, Program, Stmt, Text};
use ncc_ir::track::Tracker;

use crate::support::mode_analysis::Known;
use crate::support::states::States;
use crate::support::walk::Walk;
use crate::target::Target;
use crate::values::variables::renamed::{Digits, Renamed};

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
    /// How the legaliser runs it on a program that is kept whole, at each moment at which it does.
    pub(crate) program: &'static [ProgramStep],
    /// How it is run on a program that computes; `None` of one that is not.
    pub(crate) parametric: Option<ParametricStep>,
}

impl Pass {
    /// One that is run by name alone, or by whoever keeps a program whole.
    pub(crate) const fn named(name: &'static str, about: &'static str, alone: Option<Alone>) -> Pass {
        Pass { name, about, alone, step: None, program: &[], parametric: None }
    }

    /// One that is run on programs that compute.
    pub(crate) const fn parametric(
        name: &'static str,
        about: &'static str,
        needed: Needed,
        run: Run,
    ) -> Pass {
        let parametric = Some(ParametricStep { needed, run });
        Pass { name, about, alone: None, step: None, program: &[], parametric }
    }
}

/// What makes a pass on a program that computes needed.
pub(crate) type Needed = fn(&Parametric, &Program) -> bool;

/// Runs a pass on a program that computes.
pub(crate) type Run = fn(&mut Program, &mut Parametric, &mut Vec<Diagnostic>);

/// A pass on a program that computes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ParametricStep {
    /// What makes it needed.
    pub(crate) needed: Needed,
    /// Runs it.
    pub(crate) run: Run,
}

/// When the legaliser runs a pass on a program that is kept whole. At each moment it walks the table of passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ProgramMoment {
    /// Incremental words after a change of frame, as the source's control counts them: before passes that are asked for.
    SourceIncrements,
    /// The same words, as both controls count them.
    Increments,
    /// Blocks that are repeated may need a frame or a cycle of their own each time.
    Repetitions,
    /// Subprograms are about to be inlined: their repetitions have no labels in the caller.
    SubprogramRepetitions,
    /// Subprograms are specialised or inlined.
    Calls,
    /// The subprograms that are left get their names.
    Names,
    /// Frames of a program that computes.
    Frames,
}

/// What is done with the subprograms of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Subprograms<'n> {
    /// They stay as they are.
    Keep,
    /// They get the modes active in their callers.
    Specialise,
    /// They are inlined.
    Expand,
    /// Those with these names are inlined.
    ExpandNamed(&'n BTreeSet<Text>),
}

/// A program that is kept whole, on its way through the passes of a moment.
pub(crate) struct KeptProgram<'p> {
    pub(crate) program: &'p mut Program,
    /// What is done with its subprograms.
    pub(crate) subprograms: Subprograms<'p>,
    /// Of a program that computes, what holds where stretches of its blocks begin.
    pub(crate) known: Option<&'p Known>,
    pub(crate) diags: &'p mut Vec<Diagnostic>,
    /// Whether a pass has refused it: no further one is run.
    pub(crate) refused: bool,
}

impl KeptProgram<'_> {
    /// The program cannot be translated.
    pub(crate) fn refuse(&mut self, refusal: Diagnostic) {
        self.diags.push(refusal);
        self.refused = true;
    }
}

/// A pass on a program that is kept whole.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProgramStep {
    /// When it is run.
    pub(crate) moment: ProgramMoment,
    /// What makes it needed.
    pub(crate) needed: fn(&Shared, &KeptProgram) -> bool,
    /// Runs it.
    pub(crate) run: fn(&mut Shared, &mut KeptProgram),
}

/// When the legaliser runs a pass on a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Moment {
    /// As the piece comes, before it is known what it needs.
    Arrival,
    /// What says where things are: frames, offsets, corners. After it the tool is followed again.
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
    pub(crate) needed: fn(&Shared, &Piece) -> bool,
    /// Runs it.
    pub(crate) run: fn(&mut Shared, &mut Piece),
    /// Follows a piece that does not need it.
    pub(crate) otherwise: fn(&mut Shared, &Piece),
    /// A form that is tried first.
    pub(crate) first: Option<First>,
    /// The end of the program: what it has held back, and what it only knows then.
    pub(crate) finish: Finish,
}

/// Ends a pass: what waits stands last.
pub(crate) type Finish = fn(&mut Shared, &mut Vec<Stmt>, &mut Vec<Diagnostic>);

/// A form of a pass that is tried on a copy of the piece together with all passes after it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct First {
    /// Puts the piece in this form; `false`, and nothing done, where that has no sense.
    pub(crate) tried: fn(&mut Shared, &mut Piece) -> bool,
    /// Whether it is kept, where no pass has refused anything: what the form left, and what came of that.
    pub(crate) kept: fn(&Piece, &[Stmt], &[Stmt]) -> bool,
}

impl Step {
    /// One that follows nothing.
    pub(crate) const fn at(
        moment: Moment,
        needed: fn(&Shared, &Piece) -> bool,
        run: fn(&mut Shared, &mut Piece),
    ) -> Option<Step> {
        Step::to_the_end(moment, needed, run, |_, _, _| {})
    }

    /// One that follows nothing, and may hold something back to the end of the program.
    pub(crate) const fn to_the_end(
        moment: Moment,
        needed: fn(&Shared, &Piece) -> bool,
        run: fn(&mut Shared, &mut Piece),
        finish: Finish,
    ) -> Option<Step> {
        Some(Step { moment, needed, run, otherwise: |_, _| {}, first: None, finish })
    }
}

/// What passes share while a program goes through them piece by piece.
#[derive(Clone, Debug)]
pub(crate) struct Shared {
    pub(crate) target: Target,
    /// What the target lacks: bits of `support::needs`.
    pub(crate) lacks: u32,
    /// Whether words of the source may have a measure of their own that the target's cannot have.
    pub(crate) measures: bool,
    /// Which arcs the source's control accepts, if the target's has another rule.
    pub(crate) source_arcs: Option<ArcRule>,
    /// Whether feeds are stated again after a change of units.
    pub(crate) feed_again: bool,
    /// Whether the target counts F of some moves otherwise than the source.
    pub(crate) times_differ: bool,
    /// Whether any pass wants to know where the tool is.
    pub(crate) follow: bool,
    /// Where it is, and what is active.
    pub(crate) walk: Walk,
    /// What holds after each call and label of a program that is kept whole.
    pub(crate) entries: Option<Rc<Known>>,
    /// What each pass remembers.
    pub(crate) states: States,
}

/// What is known of both controls of a program that computes, and what the passes find out about it.
pub struct Parametric<'p> {
    /// What the target can say.
    pub caps: &'p Caps,
    /// What it computes with.
    pub target: &'p Computes,
    /// What the source's control computes with.
    pub source: &'p Computes,
    /// Whether words of the source say how they are measured, each by itself.
    pub word_distance: bool,
    /// Whether both are controls of other kinds.
    pub others: bool,
    /// Whether the program's own words of control stay, which say by themselves where they lead.
    pub keeps_words: bool,
    /// How far apart two numbers are that the source's comparisons find equal, if they have a tolerance.
    pub tolerance: Option<Num>,
    /// To which digits the target's words are rounded.
    pub digits: Digits,
    /// Whether the target tells this, where a program asks its control.
    pub tells: &'p dyn Fn(&System) -> bool,
    /// What holds where the program begins.
    pub entry: Tracker,
    /// What holds where stretches of its blocks begin.
    pub known: Known,
    /// Which variables became which.
    pub renamed: Renamed,
}

/// A piece of a program on its way through the steps.
pub(crate) struct Piece<'p> {
    pub(crate) stmts: &'p mut Vec<Stmt>,
    /// What its statements need that the target lacks: bits of `support::needs`.
    pub(crate) needs: u32,
    /// What holds before it: every pass walks from there.
    pub(crate) start: &'p Walk,
    /// Facts assumed so far.
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
