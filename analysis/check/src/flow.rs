//! NC0812 to NC0814: where a program can go. Calls by its statements, jumps by its text.

use std::collections::{BTreeSet, HashSet};

use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::source::Span;

use crate::finding::{Finding, What};

/// Subprograms that nothing calls, from the main program on. Not to be asked where blocks that
/// were not read may call them.
pub fn never_called(program: &Program) -> Vec<Finding> {
    let mut called = BTreeSet::new();
    let by_name = program.by_name();
    let mut open: Vec<&[Stmt]> = program.procedures.first().map(|p| p.body.as_slice()).into_iter().collect();
    while let Some(body) = open.pop() {
        calls(body, &mut |name| {
            if let Some(index) = by_name.get(name).copied()
                && called.insert(index)
            {
                open.push(&program.procedures[index].body);
            }
        });
    }
    let left = program.procedures.iter().enumerate().skip(1).filter(|(index, _)| !called.contains(index));
    left.filter_map(|(_, procedure)| {
        let span = procedure.body.iter().map(|stmt| stmt.span).find(|span| *span != Span::default())?;
        Some(Finding::new(What::NeverCalled { name: procedure.name.clone() }, span))
    })
    .collect()
}

fn calls(body: &[Stmt], found: &mut dyn FnMut(&str)) {
    for stmt in body {
        match &stmt.op {
            Op::Call(call) => found(&call.name),
            Op::Control(control) => {
                for body in control.bodies() {
                    calls(body, found);
                }
            }
            _ => {}
        }
    }
}

/// How a block counts for the jumps before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// It executes nothing: a label, a comment.
    Silent,
    /// It is executed.
    Executed,
    /// A structure may lead to it.
    OfStructure,
}

/// Jumps and blocks of a text, one after the other: what leads nowhere, and what is never reached.
#[derive(Debug, Default)]
pub struct Jumps {
    labels: HashSet<String>,
    targets: HashSet<String>,
    /// Jumps with their targets, of the program that is being read.
    jumps: Vec<(String, Span)>,
    /// First blocks after jumps that are always made, with their labels.
    after: Vec<(Vec<String>, Span)>,
    computed: bool,
    /// Whether the block before is left by a jump that is always made.
    left: bool,
    /// Labels since then.
    passed: Vec<String>,
    found: Vec<Finding>,
}

impl Jumps {
    /// Another program of the text begins.
    pub fn program(&mut self) {
        let labels = std::mem::take(&mut self.labels);
        for (name, at) in self.jumps.drain(..).filter(|(name, _)| !labels.contains(name)) {
            self.found.push(Finding::new(What::JumpNowhere { name: name.into() }, at));
        }
        let targets = std::mem::take(&mut self.targets);
        // A computed jump may go to any label.
        let led = |labels: &[String]| {
            labels.iter().any(|label| targets.contains(label)) || (self.computed && !labels.is_empty())
        };
        for (_, at) in self.after.drain(..).filter(|(labels, _)| !led(labels)) {
            self.found.push(Finding::new(What::AfterJump, at));
        }
        (self.computed, self.left) = (false, false);
        self.passed.clear();
    }

    /// A block with its number or label.
    pub fn block(&mut self, label: Option<String>, at: Span, block: Block) {
        if let Some(label) = label {
            if self.left {
                self.passed.push(label.clone());
            }
            self.labels.insert(label);
        }
        if block != Block::Silent && std::mem::take(&mut self.left) {
            let labels = std::mem::take(&mut self.passed);
            if block == Block::Executed {
                self.after.push((labels, at));
            }
        }
    }

    /// The last block jumps to the name `to`; `None` if the name is computed. `reported_at` is the place of the jump, where a
    /// jump to a missing name is reported; `None` if the control continues without such a block.
    pub fn jump(&mut self, to: Option<String>, reported_at: Option<Span>, always: bool) {
        match to {
            Some(name) => {
                self.targets.insert(name.clone());
                self.jumps.extend(reported_at.map(|at| (name, at)));
            }
            None => self.computed |= reported_at.is_some(),
        }
        self.left |= always;
    }

    /// All that was found.
    pub fn finish(mut self) -> Vec<Finding> {
        self.program();
        self.found
    }
}
