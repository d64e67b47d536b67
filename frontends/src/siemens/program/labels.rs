//! Labels of a program and the jumps to them, when it has been read.
//!
//! A jump looks for its label in its direction, the nearest first. Labels of one name that a jump names get names of
//! their own, so that each jump says which it means.

use std::collections::{HashMap, HashSet};

use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Num;
use ncc_ir::program::{Op, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::FlowUnsupported;

use crate::siemens::siemens_state::ModalCall;
use crate::siemens::text::tree::Direction;

/// What must be the same at a jump and where it goes.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::siemens) struct InPlace {
    pub(in crate::siemens) cycle: ModalCall,
    pub(in crate::siemens) rounding: Option<Num>,
}

/// A label, or a block number that a jump names.
#[derive(Debug)]
pub(in crate::siemens) struct Label {
    pub(in crate::siemens) name: Text,
    pub(in crate::siemens) at: u32,
    /// What is active there; `None` for a label that no jump was known to name.
    pub(in crate::siemens) found: Option<InPlace>,
}

/// A jump whose label is looked for.
#[derive(Debug)]
pub(in crate::siemens) struct Pending {
    pub(in crate::siemens) name: Text,
    pub(in crate::siemens) direction: Direction,
    pub(in crate::siemens) span: Span,
    pub(in crate::siemens) found: InPlace,
}

/// Lets the jumps of a program go to their labels; what cannot is reported. Gives whether anything was.
pub(in crate::siemens) fn resolve(
    labels: &[Label],
    jumps: &[Pending],
    body: &mut Vec<Stmt>,
    reported: &mut Vec<Diagnostic>,
) -> bool {
    let before = reported.len();
    let names = own_names(labels, jumps);
    let mut by_name: HashMap<&str, Vec<usize>> = HashMap::new();
    for (place, label) in labels.iter().enumerate() {
        by_name.entry(&label.name).or_default().push(place);
    }
    let mut found: HashMap<Text, Option<Text>> = HashMap::new();
    for jump in jumps {
        let to = aim(labels, by_name.get(&*jump.name).map_or(&[], Vec::as_slice), jump);
        let quiet = jump.direction == Direction::BothQuietly;
        let refuse = match to {
            None if quiet => None,
            None => {
                reported.push(Diagnostic::new(Fault::LabelUnknown { name: jump.name.clone() }, jump.span));
                None
            }
            Some(to) => match &labels[to].found {
                None => Some(FlowUnsupported::FarBack),
                Some(at) if *at != jump.found => Some(FlowUnsupported::OtherModal),
                Some(_) => None,
            },
        };
        if let Some(refuse) = refuse {
            let fault = Fault::NotSupported { code: jump.name.clone(), what: refuse.into() };
            reported.push(Diagnostic::new(fault, jump.span));
        }
        found.insert(marked(&jump.name, jump.span), to.map(|to| names[to].clone()));
    }
    let renamed: HashMap<u32, Text> = labels
        .iter()
        .zip(&names)
        .filter(|(label, name)| label.name != **name)
        .map(|(label, name)| (label.at, name.clone()))
        .collect();
    let mut now: HashMap<Text, Text> = HashMap::new();
    join(body, &found, &renamed, &mut now);
    reported.len() > before
}

/// What a jump is called until its label is found, by its end: no label has such a name.
pub(in crate::siemens) fn marked(name: &str, span: Span) -> Text {
    format!("{name} {}", span.end).into()
}

/// The place of the label that a jump goes to; `named` are those of its name, in the order of the text.
fn aim(labels: &[Label], named: &[usize], jump: &Pending) -> Option<usize> {
    let at = jump.span.end;
    let behind = named.partition_point(|place| labels[*place].at <= at);
    let forward = || named.get(behind).copied();
    let backward = || behind.checked_sub(1).map(|last| named[last]);
    match jump.direction {
        Direction::Forward => forward(),
        Direction::Backward => backward(),
        Direction::Both | Direction::BothQuietly => forward().or_else(backward),
        Direction::ToStart => None,
    }
}

/// A name for each label: its own, but where jumps name one of several that have it.
fn own_names(labels: &[Label], jumps: &[Pending]) -> Vec<Text> {
    let mut taken: HashSet<Text> = labels.iter().map(|label| label.name.clone()).collect();
    let jumped: HashSet<&str> = jumps.iter().map(|jump| &*jump.name).collect();
    let mut last: HashMap<&str, u32> = HashMap::new();
    let mut seen: HashSet<&str> = HashSet::new();
    let mut names = Vec::with_capacity(labels.len());
    for label in labels {
        let again = !seen.insert(&label.name) && jumped.contains(&*label.name);
        let name = match again {
            false => label.name.clone(),
            true => {
                let number = last.entry(&label.name).or_insert(1);
                loop {
                    *number += 1;
                    let name = Text::from(format!("{}_{number}", label.name));
                    if !taken.contains(&name) {
                        break name;
                    }
                }
            }
        };
        taken.insert(name.clone());
        names.push(name);
    }
    names
}

/// Puts the names of labels into jumps, and into labels and repetitions that have other names now.
fn join(
    body: &mut Vec<Stmt>,
    jumps: &HashMap<Text, Option<Text>>,
    renamed: &HashMap<u32, Text>,
    now: &mut HashMap<Text, Text>,
) {
    body.retain_mut(|stmt| {
        let at = stmt.span.start;
        match &mut stmt.op {
            Op::Goto(to) => match jumps.get(to) {
                Some(Some(name)) => *to = name.clone(),
                // One that goes nowhere, and need not.
                Some(None) => return false,
                None => {}
            },
            Op::Label(name) => {
                now.remove(name);
                if let Some(own) = renamed.get(&at) {
                    now.insert(name.clone(), own.clone());
                    *name = own.clone();
                }
            }
            Op::RepeatBlocks(repeat) => {
                for name in [Some(&mut repeat.from), repeat.to.as_mut()].into_iter().flatten() {
                    if let Some(own) = now.get(name) {
                        *name = own.clone();
                    }
                }
            }
            Op::Control(control) => control.bodies_mut().for_each(|body| join(body, jumps, renamed, now)),
            _ => {}
        }
        true
    });
}
