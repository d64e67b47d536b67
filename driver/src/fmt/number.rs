//! New block numbers, with everything that names a block following them, or none at all.
//!
//! A text is refused, by the place, where it cannot be seen for certain which block is meant. The result is
//! looked through again: its blocks, and the block that each reference leads to, are the same, and nothing
//! but numbers differs. Not here: what names a block (`references`).

use std::collections::{BTreeMap, BTreeSet};

use ncc_backends::Numbering;
use ncc_dialects::Settings;

use super::references::{Found, Reference, find, reason};

/// Highest number that is written.
const HIGHEST: u32 = 99_999_999;

/// Why numbers cannot be changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// The line, from 1; 0 for the whole text.
    pub line: u32,
    /// What is in the way.
    pub what: String,
    /// It is no trait of the program but a fault of ours.
    pub ours: bool,
}

fn refused(line: u32, what: String) -> Refused {
    Refused { line, what, ours: false }
}

/// A text, laid out before, with other numbers.
///
/// # Errors
/// It cannot be seen for certain which block something leads to.
pub fn renumber(settings: &Settings, text: &[u8], numbering: Numbering) -> Result<Vec<u8>, Refused> {
    let (first, step) = match numbering {
        Numbering::Keep => return Ok(text.to_vec()),
        Numbering::Off => (0, 0),
        Numbering::Every { first, step } => (first, step),
    };
    let found = find(settings, text);
    let numbers = Numbers::of(&found);
    for doubt in &found.doubts {
        if doubt.only.is_none_or(|number| numbers.blocks.contains_key(&number)) {
            return Err(refused(doubt.line, doubt.what.clone()));
        }
    }
    let mut targets = Vec::new();
    for reference in &found.references {
        targets.push(numbers.targets(&found, reference)?);
    }
    let is_target: BTreeSet<usize> = targets.iter().flatten().copied().collect();

    let mut new: BTreeMap<usize, u32> = BTreeMap::new();
    let mut edits = Vec::new();
    let (mut scope, mut next) = (usize::MAX, u64::from(first));
    for (at, block) in found.blocks.iter().enumerate() {
        if std::mem::replace(&mut scope, block.scope) != block.scope {
            next = u64::from(first);
        }
        match (numbering, &block.number) {
            (Numbering::Every { .. }, number) if block.says || number.is_some() => {
                let value = u32::try_from(next).ok().filter(|n| *n <= HIGHEST);
                let value = value.ok_or_else(|| {
                    refused(block.line, reason("too-high").text("most", HIGHEST.to_string()).headline())
                })?;
                next += u64::from(step);
                new.insert(at, value);
                match number {
                    Some(number) => edits.push((number.digits.clone(), value.to_string())),
                    None => {
                        let letter = settings.dialect.block.number;
                        let letter = letter.ok_or_else(|| refused(0, reason("no-numbers").headline()))?;
                        // Digits would run together.
                        let digits = text.get(block.place).is_some_and(|b| b.is_ascii_digit() || *b == b'.');
                        let blank = if settings.dialect.block.blanks || digits { " " } else { "" };
                        // Behind the level of a skip mark.
                        let level = block.place > 0 && text[block.place - 1].is_ascii_digit();
                        let before = if level { blank } else { "" };
                        edits.push((block.place..block.place, format!("{before}{letter}{value}{blank}")));
                    }
                }
            }
            (Numbering::Off, Some(number)) if number.optional && block.says && !is_target.contains(&at) => {
                edits.push((number.word.start..number.rest, String::new()));
            }
            _ => {}
        }
    }
    let are_new: BTreeSet<(usize, u32)> =
        new.iter().map(|(at, value)| (found.blocks[*at].scope, *value)).collect();
    if let Some(doubt) = found.doubts.iter().find(|d| d.only.is_some_and(|number| are_new.contains(&number)))
    {
        return Err(refused(doubt.line, doubt.what.clone()));
    }
    for (reference, targets) in found.references.iter().zip(&targets) {
        let values: BTreeSet<Option<&u32>> = targets.iter().map(|at| new.get(at)).collect();
        match values.into_iter().collect::<Vec<_>>().as_slice() {
            [Some(value)] => edits.push((reference.digits.clone(), value.to_string())),
            [None] | [] => {}
            _ => return Err(refused(reference.line, reason("return").headline())),
        }
    }
    edits.sort_by_key(|(range, _)| range.start);
    let mut written = Vec::with_capacity(text.len() + text.len() / 8);
    let mut at = 0;
    for (range, instead) in &edits {
        written.extend_from_slice(&text[at..range.start]);
        written.extend_from_slice(instead.as_bytes());
        at = range.end;
    }
    written.extend_from_slice(&text[at..]);
    match holds(settings, text, &found, &targets, &written) {
        true => Ok(written),
        false => Err(Refused { line: 0, what: "block numbers".to_owned(), ours: true }),
    }
}

/// Blocks by scope and number.
pub(crate) struct Numbers {
    pub(crate) blocks: BTreeMap<(usize, u32), Vec<usize>>,
}

impl Numbers {
    pub(crate) fn of(found: &Found) -> Numbers {
        let mut blocks: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        for (at, block) in found.blocks.iter().enumerate() {
            if let Some(number) = &block.number {
                blocks.entry((block.scope, number.value)).or_default().push(at);
            }
        }
        Numbers { blocks }
    }

    /// The blocks that a reference leads to: one in each scope that it may lead into.
    pub(crate) fn targets(&self, found: &Found, reference: &Reference) -> Result<Vec<usize>, Refused> {
        let &Reference { value, line, .. } = reference;
        let main = found.blocks.first().map_or(0, |block| block.scope);
        let main = found.programs.keys().next().copied().unwrap_or(main);
        let scopes: Vec<usize> = match reference.of_callers && reference.scope != main {
            false => vec![reference.scope],
            true => {
                let program = found.programs.get(&reference.scope);
                let callers = found.calls.iter().filter(|(_, called)| Some(called) == program);
                callers.map(|(scope, _)| *scope).collect()
            }
        };
        let block = |form| reason(form).text("block", value.to_string()).headline();
        if scopes.is_empty() {
            return Err(refused(line, block("caller")));
        }
        let one = |scope: usize| match self.blocks.get(&(scope, value)).map(Vec::as_slice) {
            Some([one]) => Ok(*one),
            Some(_) => Err(refused(line, block("several"))),
            None => Err(refused(line, block("nowhere"))),
        };
        scopes.into_iter().map(one).collect()
    }
}

/// Whether a new text has the same blocks, leads to the same ones, and differs in nothing but numbers.
fn holds(settings: &Settings, before: &[u8], found: &Found, targets: &[Vec<usize>], after: &[u8]) -> bool {
    let again = find(settings, after);
    let numbers = Numbers::of(&again);
    let leads = |(reference, to): (&Reference, &Vec<usize>)| {
        numbers.targets(&again, reference).is_ok_and(|found| found == *to)
    };
    again.blocks.len() == found.blocks.len()
        && again.references.len() == targets.len()
        && again.references.iter().zip(targets).all(leads)
        && bare(before, found) == bare(after, &again)
}

/// A text without blanks and without the numbers that may change.
fn bare(text: &[u8], found: &Found) -> Vec<u8> {
    let words = found.blocks.iter().filter_map(|b| b.number.as_ref());
    let words = words.map(|n| if n.optional { n.word.clone() } else { n.digits.clone() });
    let mut gone: Vec<_> = words.chain(found.references.iter().map(|r| r.digits.clone())).collect();
    gone.sort_by_key(|range| range.start);
    let mut left = Vec::with_capacity(text.len());
    let mut at = 0;
    for range in gone {
        left.extend_from_slice(text.get(at..range.start).unwrap_or_default());
        at = range.end;
    }
    left.extend_from_slice(&text[at..]);
    left.retain(|b| *b != b' ');
    left
}
