//! Whether a text is a milling program at all, or what else it looks like.
//!
//! `G21 G99 / T0303 / G92 X29.5 Z-20. F1.5 / X29.1` is a thread on a lathe. A milling control would read the
//! same blocks as a G92 shift and rapid moves into the part. So every text is weighed before a dialect
//! reads it: [`signs`] lists what gives a kind of program away, `blocks` cuts the text into words that all these
//! languages share, `course` follows what only several blocks together show.
//!
//! Not here: which milling dialect a text is written in, what its words mean, and what ncc reports.

mod blocks;
mod course;
pub mod signs;
mod sources;

use std::collections::HashMap;
use std::ops::Range;

use blocks::Block;
use course::{Course, Line};
use signs::{Kind, SIGNS, Shape, Sign, Sort, System};

/// How much of a text is weighed, in bytes from its beginning.
pub const BEGINNING: usize = 1 << 16;
/// Bytes that an editor may put before a text in UTF-8.
const MARK: &[u8] = b"\xEF\xBB\xBF";
/// A kind of program is named from this weight on.
const ENOUGH: i32 = 3;
/// From this weight on, nothing is left to ask.
const CERTAIN: i32 = 5;
/// So many hints of different kinds stand for a second strong sign.
const MANY_HINTS: i32 = 3;
/// Hints do not count for more than this together, so that no number of them is a strong sign.
const MOST_HINTS: i32 = 1;

/// The code of the message about a program that is not for a mill: `NC0120`.
pub const CODE: u16 = 120;

/// A sign and the first place where the text shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shown {
    /// The sign.
    pub sign: &'static Sign,
    /// Bytes of the text.
    pub place: Range<usize>,
}

/// A text that looks like something else than a milling program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What it looks like.
    pub kind: Kind,
    /// The control that its signs point to, where they agree on one.
    pub system: Option<System>,
    /// Whether the signs leave no doubt. Without, a milling program might look so too.
    pub certain: bool,
    /// The sign that decides, and its first place.
    pub decisive: Shown,
    /// The other signs, the strongest first.
    pub others: Vec<Shown>,
}

/// Weighs the beginning of a text; no more than [`BEGINNING`] bytes of it are looked at. `None` is a milling
/// program, as far as the signs tell.
pub fn recognise(text: &[u8]) -> Option<Finding> {
    let cut = text.len() > BEGINNING;
    let mut text = &text[..text.len().min(BEGINNING)];
    if cut {
        // The last line is cut.
        text = &text[..text.iter().rposition(|b| *b == b'\n').unwrap_or(text.len())];
    }
    let skipped = if text.starts_with(MARK) { MARK.len() } else { 0 };
    let weighed = Weighed::weigh(&text[skipped..], skipped);
    weighed.judge()
}

/// All that was found in a text.
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
        // Of equal weights in the order of the table, which names cycles first.
        all.sort_by_key(|shown| std::cmp::Reverse(shown.sign.weight));
        Weighed { shown: all, course }
    }

    fn judge(self) -> Option<Finding> {
        let weights = Kind::ALL.map(|kind| (kind, self.weight(kind)));
        // Of equal weights, the first of the list.
        let (kind, weight) = weights.into_iter().rev().max_by_key(|(_, weight)| *weight)?;
        if weight < ENOUGH {
            return None;
        }
        let system = self.system(kind);
        let mut own = self.shown.into_iter().filter(|shown| shown.sign.kind == kind);
        let decisive = own.next()?;
        Some(Finding { kind, system, certain: weight >= CERTAIN, decisive, others: own.collect() })
    }

    /// What speaks for a kind, less what speaks for a mill; 0 where no sign is strong enough to speak at all.
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

    /// The control that the strong signs of a kind agree on.
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

/// The signs that a block may show, by what is cheap to see of it: most blocks show none.
#[derive(Default)]
struct Possible {
    /// By the letters of a block, those of words.
    by_letters: HashMap<u32, Vec<usize>>,
}

impl Possible {
    /// Looks at the signs that a block may show, by their place in the table.
    fn of(&mut self, block: &Block, sentence: bool, mut look: impl FnMut(usize)) {
        let shapes = signs::shapes();
        // The words of a sentence are no codes, but it may name a control.
        if !sentence {
            let fits = |sign: &usize| shapes[*sign].fits(block.letters);
            let signs = self.by_letters.entry(block.letters);
            signs
                .or_insert_with(|| (0..shapes.len()).filter(fits).collect())
                .iter()
                .for_each(|sign| look(*sign));
        }
        // No other sign is without two letters side by side.
        if block.text.windows(2).any(|pair| pair.iter().all(u8::is_ascii_uppercase)) {
            let others = (0..shapes.len()).filter(|sign| !matches!(shapes[*sign], Shape::Block { .. }));
            others.for_each(look);
        }
    }
}

impl Sign {
    /// Whether several blocks together show it.
    fn of_course(&self) -> Option<Sort> {
        match self.shape {
            signs::Pattern::Course(sort) => Some(sort),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
