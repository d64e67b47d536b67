//! Open branches and loops of the text, and its jumps and labels, while the front-end parses a unit.
//!
//! After `WHILE R1<5`, one structure is open until `ENDWHILE`.
//! Not here: parsing their heads and bodies (`flow`).

use std::collections::HashSet;

use ncc_ir::expr::{Expr, Var};
use ncc_ir::program::{Stmt, Text};
use ncc_ir::source::Span;

use super::labels::{InPlace, Label, Pending};
use crate::common::known::Know;
use crate::siemens::siemens_state::{Motion, SiemensState};

/// Jumps and labels of the unit so far, and its open structures.
#[derive(Debug, Default)]
pub(in crate::siemens) struct Flow {
    /// Labels and block numbers that jumps name.
    pub(in crate::siemens) targets: HashSet<Text>,
    /// Whether a jump names a block number.
    pub(in crate::siemens) numbered: bool,
    pub(in crate::siemens) labels: Vec<Label>,
    pub(in crate::siemens) jumps: Vec<Pending>,
    pub(in crate::siemens) open: Vec<OpenStructure>,
    /// The first feed within the open structures that relied on the feed unit at the start of a loop.
    pub(in crate::siemens) relied: Option<Span>,
    /// Whether control never passes from the last statement to the next one.
    pub(in crate::siemens) over: bool,
    /// Whether the text so far has a program end.
    pub(in crate::siemens) has_end: bool,
}

/// A branch or a loop before its closing word.
#[derive(Debug)]
pub(in crate::siemens) struct OpenStructure {
    pub(in crate::siemens) what: StructureKind,
    /// Index of the first statement of its body.
    pub(in crate::siemens) at: usize,
    pub(in crate::siemens) head: Span,
    pub(in crate::siemens) number: Option<u32>,
    pub(in crate::siemens) comment: Option<Box<Text>>,
    pub(in crate::siemens) found: InPlace,
    /// Whether feeds use the active length unit at its start. Every iteration agrees if its end has the same value.
    pub(in crate::siemens) scaled: Know<bool>,
}

#[derive(Debug)]
pub(in crate::siemens) enum StructureKind {
    /// `then` has the statements before `ELSE`, once `ELSE` is read. `other` has the modes at the start, then those
    /// at the end of the first branch.
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

/// Kind of structure that a closing word ends.
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
