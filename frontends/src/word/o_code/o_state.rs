//! What a text of O words has decided so far: open structures, labels, subprograms and parameters with a value.
//!
//! Not here: what its blocks do.

use std::collections::{HashMap, HashSet};

use ncc_ir::canon::Motion;
use ncc_ir::expr::{Expr, Var};
use ncc_ir::program::{CentreFrom, Stmt, Text};
use ncc_ir::source::Span;

use crate::initial_modes::Unsaid;
use crate::word::word_state::WordState;

/// What the text decides, as far as read.
#[derive(Debug, Default)]
pub(in crate::word) struct OWordState {
    pub(in crate::word) open: Vec<OpenStructure>,
    /// Labels met in the program at hand.
    pub(in crate::word) labels: Vec<Text>,
    pub(in crate::word) given: Given,
    /// Whether the missing axes U, V and W were reported.
    pub(in crate::word) no_such_axes: bool,
    /// Whether the program at hand ends with M99.
    pub(in crate::word) numbered_program: bool,
    pub(in crate::word) subs: Subs,
    pub(in crate::word) standalone: StandaloneOsub,
    /// Where a loop of `while` is left by a break, and where one of `do` begins.
    pub(in crate::word) left: Option<Span>,
    pub(in crate::word) does: Option<Span>,
    /// Where an iteration of a `do` is left, and where a `repeat` begins.
    pub(in crate::word) turned: Option<Span>,
    pub(in crate::word) repeats: Option<Span>,
    /// Structures stand in one another deeper than they are read: none is looked at any more.
    pub(in crate::word) too_deep: bool,
    /// A word that opens or closes a structure was misspelt: which one is open nobody knows.
    pub(in crate::word) misspelt: bool,
}

/// What has not been closed.
#[derive(Debug)]
pub(in crate::word) struct OpenStructure {
    pub(in crate::word) label: Text,
    pub(in crate::word) kind: StructureKind,
    /// Where its body begins; `None` until a further block is read.
    pub(in crate::word) at: Option<usize>,
    pub(in crate::word) block: Span,
    pub(in crate::word) number: Option<u32>,
    pub(in crate::word) given: Given,
    pub(in crate::word) paths: StructurePaths,
    /// Whether a `continue` stands in it.
    pub(in crate::word) turned: bool,
}

#[derive(Debug)]
pub(in crate::word) enum StructureKind {
    /// What has been decided so far, and what is being decided; `None` is the rest.
    If {
        before: Vec<(Expr, Vec<Stmt>)>,
        now: Option<Expr>,
    },
    While(Expr),
    Do,
    Repeat(Expr),
    Sub(Box<Outer>),
}

impl StructureKind {
    pub(in crate::word) fn word(&self) -> &'static str {
        match self {
            StructureKind::If { .. } => "if",
            StructureKind::While(_) => "while",
            StructureKind::Do => "do",
            StructureKind::Repeat(_) => "repeat",
            StructureKind::Sub(_) => "sub",
        }
    }
}

/// What holds where a structure begins, and on the ways that have left its bodies.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::word) struct StructurePaths {
    /// From where the program has said before that centres are measured.
    pub(in crate::word) centre: Option<CentreFrom>,
    /// Modes that are not said at the head.
    pub(in crate::word) head: Unsaid,
    /// Modes that are not said where a body that is over has ended, or was left.
    pub(in crate::word) ends: Unsaid,
}

impl StructurePaths {
    /// The end of the structure: all its bodies may have been passed over, unless one is `else`, or the condition is
    /// asked for after the body.
    pub(in crate::word) fn passed_over(&mut self, kind: &StructureKind) {
        if let StructureKind::While(_) | StructureKind::Repeat(_) | StructureKind::If { now: Some(_), .. } =
            kind
        {
            self.ends = self.ends.and(self.head);
        }
    }
}

impl OpenStructure {
    /// The structure is over: what it is.
    pub(in crate::word) fn close(&mut self) -> StructureKind {
        self.paths.passed_over(&self.kind);
        std::mem::replace(&mut self.kind, StructureKind::Do)
    }
}

/// Whether the text is a subprogram by itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::word) enum StandaloneOsub {
    /// Nothing says so.
    #[default]
    No,
    /// The text is that of a file of this name, in small letters.
    File(Text),
    /// It is said to be one, which has not begun yet.
    Looked,
    /// The subprogram that is open.
    Open(Text),
    /// It is over: its caller goes on.
    Over,
}

impl StandaloneOsub {
    /// Whether it is open under this name.
    pub(in crate::word) fn is(&self, name: &str) -> bool {
        matches!(self, StandaloneOsub::Open(own) if **own == *name)
    }

    /// Whether it is open.
    pub(in crate::word) fn is_open(&self) -> bool {
        matches!(self, StandaloneOsub::Open(_))
    }
}

/// What is put aside while a subprogram is read.
#[derive(Debug)]
pub(in crate::word) struct Outer {
    pub(in crate::word) state: WordState,
    /// A code of motion that no move has said yet.
    pub(in crate::word) motion_without_move: Option<(Span, Motion)>,
    pub(in crate::word) ended: bool,
    pub(in crate::word) labels: Vec<Text>,
    pub(in crate::word) numbered_program: bool,
}

/// Subprograms and calls met.
#[derive(Debug, Default)]
pub(in crate::word) struct Subs {
    /// Names, and whether they end with M99.
    pub(in crate::word) known: HashMap<Text, bool>,
    /// The same of what is called, each with where, and whether the main program calls it.
    pub(in crate::word) called: Vec<(Text, bool, Span, bool)>,
    /// What the main program calls.
    pub(in crate::word) called_by_main: HashSet<Text>,
    /// Whether anything asks for the result of a call, and whether a return without one has been met before.
    pub(in crate::word) results: bool,
    pub(in crate::word) plain_return: Option<Span>,
}

impl Subs {
    /// A program that ends with M99.
    pub(in crate::word) fn numbered(&mut self, name: Text) {
        self.known.entry(name).or_insert(true);
    }

    /// A call of one.
    pub(in crate::word) fn calls_numbered(&mut self, name: Text, at: Span, main: bool) {
        self.called_by_main.extend(main.then(|| name.clone()));
        self.called.push((name, true, at, main));
    }
}

/// Which variables surely have a value where the text is being read.
#[derive(Clone, Debug, Default)]
pub(in crate::word) struct Given {
    pub(in crate::word) set: HashSet<Var>,
    /// Whether all numbered locals have: a program that is called by an O word has its arguments in them, and zeros.
    pub(in crate::word) numbered: bool,
}

impl Given {
    pub(in crate::word) fn set(&mut self, var: &Var) {
        if let Var::Local(_) = var {
            self.set.insert(var.clone());
        }
    }

    pub(in crate::word) fn has(&self, var: &Var) -> bool {
        match var {
            Var::Local(name) => {
                self.numbered && name.bytes().all(|b| b.is_ascii_digit()) || self.set.contains(var)
            }
            Var::Common(_) | Var::Retentive(_) | Var::System(_) => true,
        }
    }
}
