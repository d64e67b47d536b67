//! Recognises texts that are not milling programs, for example lathe programs.
//!
//! `G21 G99 / T0303 / G92 X29.5 Z-20. F1.5 / X29.1` is a thread on a lathe. A milling control would read the
//! same blocks as a G92 shift and rapid moves into the part. So ncc weighs every text before a dialect reads it.
//! [`signs`] lists the signs of each kind of program. `blocks` splits the text into words that all these
//! languages share. `course` finds signs that need several blocks.
//!
//! Not here: the milling dialect of a text, the meaning of its words, and the message.

mod blocks;
mod course;
pub mod signs;
mod sources;

use std::collections::HashMap;
use std::ops::Range;

use blocks::Block;
use course::{Course, Line};
use signs::{Kind, SIGNS, Shape, Sign, Sort, System};

/// Bytes from the start of a text that ncc weighs: 64 KiB.
pub const BEGINNING: usize = 1 << 16;
/// UTF-8 byte order mark; some editors write it at the start of a file.
const MARK: &[u8] = b"\xEF\xBB\xBF";
/// Lowest weight at which ncc names a kind of program.
const ENOUGH: i32 = 3;
/// Lowest weight at which the kind is certain.
const CERTAIN: i32 = 5;
/// Total weight of hints that replaces a second strong sign.
const MANY_HINTS: i32 = 3;
/// Highest total weight of hints in a sum, so that hints alone never equal a strong sign.
const MOST_HINTS: i32 = 1;

/// Code of the message about a program that is not for a mill: `NC0120`.
pub const CODE: u16 = 120;

/// A sign with its first span in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shown {
    /// Row of the table [`SIGNS`].
    pub sign: &'static Sign,
    /// Byte range in the text, from its start.
    pub place: Range<usize>,
}

/// The result for a text that looks like another kind of program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Most likely kind of program.
    pub kind: Kind,
    /// Control of the strong signs, if they agree on one.
    pub system: Option<System>,
    /// If false, a milling program might look the same.
    pub certain: bool,
    /// The strongest sign.
    pub decisive: Shown,
    /// The other signs of this kind, the strongest first.
    pub others: Vec<Shown>,
}

/// Weighs the first [`BEGINNING`] bytes of a text. `None` if the signs show no other kind than a milling
/// program.
pub fn recognise(text: &[u8]) -> Option<Finding> {
    let cut = text.len() > BEGINNING;
    let mut text = &text[..text.len().min(BEGINNING)];
    if cut {
        // The last line is incomplete.
        text = &text[..text.iter().rposition(|b| *b == b'\n').unwrap_or(text.len())];
    }
    let skipped = if text.starts_with(MARK) { MARK.len() } else { 0 };
    let weighed = Weighed::weigh(&text[skipped..], skipped);
    weighed.judge()
}

/// The signs of a text, the strongest first, and the facts of its blocks together.
struct Weighed {
    shown: Vec<Shown>,
    course: Course,
}

impl Weighed {
    fn weigh(text: &[u8], base: usize) -> Weighed {
        let mut shown: Vec<Option<Range<usize>>> = vec![None; SIGNS.len()];
        let shapes = signs::shapes();
        let mut possible = Possible::default();
        let mut course = Course::default();
        let mut at = base;
        let mut block = Block::default();
        for line in text.split_inclusive(|b| *b == b'\n') {
            block.read(line, at);
            at += line.len();
            let sentence = Line::from_block(&block) == Line::Sentence;
            possible.of(&block, sentence, |sign| {
                let found = &mut shown[sign];
                if found.is_none() {
                    *found = shapes[sign].place(&block);
                }
            });
            course.block(&block);
        }
        let mut all: Vec<Shown> = SIGNS
            .iter()
            .zip(shown)
            .filter_map(|(sign, place)| Some(Shown { sign, place: place.or_else(|| course.place(sign))? }))
            .collect();
        // A stable sort: equal weights keep the order of the table, which lists cycles first.
        all.sort_by_key(|shown| std::cmp::Reverse(shown.sign.weight));
        Weighed { shown: all, course }
    }

    fn judge(self) -> Option<Finding> {
        let weights = Kind::ALL.map(|kind| (kind, self.weight(kind)));
        // For equal weights, the first kind of the list wins.
        let (kind, weight) = weights.into_iter().rev().max_by_key(|(_, weight)| *weight)?;
        if weight < ENOUGH {
            return None;
        }
        let system = self.system(kind);
        let mut own = self.shown.into_iter().filter(|shown| shown.sign.kind == kind);
        let decisive = own.next()?;
        Some(Finding { kind, system, certain: weight >= CERTAIN, decisive, others: own.collect() })
    }

    /// Weight of a kind, minus the weight of the signs for a mill. 0 if no sign of the kind is strong enough.
    fn weight(&self, kind: Kind) -> i32 {
        let own = || self.shown.iter().filter(move |shown| shown.sign.kind == kind).map(|shown| shown.sign);
        let strong = own().filter(|sign| sign.weight >= 2);
        let hints: i32 = own().filter(|sign| sign.weight < 2).map(|sign| i32::from(sign.weight)).sum();
        let supported = strong.clone().count() > 1 || strong.clone().count() == 1 && hints >= MANY_HINTS;
        if own().all(|sign| sign.weight < 3) && !supported {
            return 0;
        }
        let strong: i32 = strong.map(|sign| i32::from(sign.weight)).sum();
        strong + hints.min(MOST_HINTS) - self.course.milling(kind)
    }

    /// The control on which the strong signs of a kind agree; `None` if several remain.
    fn system(&self, kind: Kind) -> Option<System> {
        let mut own = self.shown.iter().filter(|shown| shown.sign.kind == kind && shown.sign.weight >= 2);
        let left: Vec<System> = own.try_fold(System::ALL.to_vec(), |mut left, shown| {
            left.retain(|system| shown.sign.systems.is_empty() || shown.sign.systems.contains(system));
            Some(left)
        })?;
        match left[..] {
            [system] => Some(system),
            _ => None,
        }
    }
}

/// A cheap filter of the signs that a block may show. Most blocks show none.
#[derive(Default)]
struct Possible {
    /// Set of letters of a block to the indices of the signs whose needed and excluded letters fit it.
    by_letters: HashMap<u32, Vec<usize>>,
}

impl Possible {
    /// Calls `look` for each sign that the block may show, with its index in the table.
    fn of(&mut self, block: &Block, sentence: bool, mut look: impl FnMut(usize)) {
        let shapes = signs::shapes();
        // A sentence has no codes, but it may name a control.
        if !sentence {
            let fits = |sign: &usize| shapes[*sign].fits(block.letters);
            let signs = self.by_letters.entry(block.letters);
            signs
                .or_insert_with(|| (0..shapes.len()).filter(fits).collect())
                .iter()
                .for_each(|sign| look(*sign));
        }
        // All other signs need two adjacent letters.
        if block.text.windows(2).any(|pair| pair.iter().all(u8::is_ascii_uppercase)) {
            let others = (0..shapes.len()).filter(|sign| !matches!(shapes[*sign], Shape::Block { .. }));
            others.for_each(look);
        }
    }
}

impl Sign {
    /// The sort of a sign that needs several blocks; `None` for a sign of one block.
    fn of_course(&self) -> Option<Sort> {
        match self.shape {
            signs::Pattern::Course(sort) => Some(sort),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
