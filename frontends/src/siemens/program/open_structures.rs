//! Structures that are open, and what the text says of jumps.
//!
//! Not here: what their blocks do (`flow`).

use std::collections::HashSet;

use ncc_ir::expr::{Expr, Var};
use ncc_ir::program::{Stmt, Text};
use ncc_ir::source::Span;

use super::labels::{InPlace, Label, Pending};
use crate::common::known::Know;
use crate::siemens::siemens_state::{Motion, SiemensState};

/// What the text says of jumps, and the structures that are open.
#[derive(Debug, Default)]
pub(in crate::siemens) struct Flow {
    /// Labels and block numbers that jumps name.
    pub(in crate::siemens) targets: HashSet<Text>,
    /// Whether there are block numbers among them.
    pub(in crate::siemens) numbered: bool,
    pub(in crate::siemens) labels: Vec<Label>,
    pub(in crate::siemens) jumps: Vec<Pending>,
    pub(in crate::siemens) open: Vec<OpenStructure>,
    /// The first feed within them that relied on what feeds count in where a loop begins.
    pub(in crate::siemens) relied: Option<Span>,
    /// Whether what was read last cannot be left towards what follows.
    pub(in crate::siemens) over: bool,
    /// Whether an end of the program has been read.
    pub(in crate::siemens) has_end: bool,
}

/// A structure that has not ended.
#[derive(Debug)]
pub(in crate::siemens) struct OpenStructure {
    pub(in crate::siemens) what: StructureKind,
    /// Where its body begins in the statements.
    pub(in crate::siemens) at: usize,
    pub(in crate::siemens) head: Span,
    pub(in crate::siemens) number: Option<u32>,
    pub(in crate::siemens) comment: Option<Box<Text>>,
    pub(in crate::siemens) found: InPlace,
    /// Whether feeds count in the active units, where it begins: so they do in every iteration, if they do at its end.
    pub(in crate::siemens) scaled: Know<bool>,
}

#[derive(Debug)]
pub(in crate::siemens) enum StructureKind {
    /// With its other branch, what was read before that, and what is active where the branches begin or ended.
    If {
        condition: Expr,
        then: Option<Vec<Stmt>>,
        other: Box<(SiemensState, Option<Motion>)>,
    },
    Loop,
    While(Expr),
    For {
        variable: Var,
        from: Expr,
        to: Expr,
    },
    Until,
}

/// Which structure a word closes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::siemens) enum Closes {
    If,
    Loop,
    While,
    For,
    Until,
}

impl Closes {
    pub(in crate::siemens) const fn word(self) -> &'static str {
        match self {
            Closes::If => "ENDIF",
            Closes::Loop => "ENDLOOP",
            Closes::While => "ENDWHILE",
            Closes::For => "ENDFOR",
            Closes::Until => "UNTIL",
        }
    }
}

impl StructureKind {
    pub(in crate::siemens) const fn closed_by(&self) -> Closes {
        match self {
            StructureKind::If { .. } => Closes::If,
            StructureKind::Loop => Closes::Loop,
            StructureKind::While(_) => Closes::While,
            StructureKind::For { .. } => Closes::For,
            StructureKind::Until => Closes::Until,
        }
    }

    pub(in crate::siemens) const fn word(&self) -> &'static str {
        match self {
            StructureKind::If { .. } => "IF",
            StructureKind::Loop => "LOOP",
            StructureKind::While(_) => "WHILE",
            StructureKind::For { .. } => "FOR",
            StructureKind::Until => "REPEAT",
        }
    }
}
