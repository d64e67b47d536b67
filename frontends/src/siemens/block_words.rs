//! Codes and words of a block, each to be used once.
//!
//! Not here: how they are sorted (`sort`).

use ncc_dialects::{NameMeaning, NameRole};
use ncc_ir::canon::{Distance, FeedMode, RotaryWay};
use ncc_ir::source::Span;

use crate::common::words::Digits;

/// A G or M code, or a word of several letters with a meaning.
#[derive(Clone, Copy, Debug)]
pub(super) struct Code {
    /// As the dictionary spells it.
    pub(super) name: &'static str,
    pub(super) meaning: NameMeaning,
    pub(super) group: &'static str,
    /// Whether units leave the feed in the machine's basic system.
    pub(super) feed_stays: bool,
    /// What a feed counts, where a code of the spindle's speed says that as well.
    pub(super) feed_mode: Option<FeedMode>,
    pub(super) span: Span,
}

/// The value of an address.
#[derive(Clone, Copy, Debug)]
pub(super) struct Given {
    pub(super) digits: Digits,
    /// What `AC` or `IC` says of it.
    pub(super) distance: Option<Distance>,
    /// What `DC`, `ACP` or `ACN` says of it.
    pub(super) way: Option<RotaryWay>,
    /// Its place among what the block computes, in place of digits.
    pub(super) computed: Option<u16>,
    pub(super) span: Span,
}

/// The words of a block, each to be used once.
#[derive(Debug, Default)]
pub(super) struct Words {
    pub(super) codes: Vec<Code>,
    pub(super) letters: [Option<Given>; 26],
    pub(super) named: [Option<Given>; NAMED],
    /// A tool by its name, with the quotes.
    pub(super) tool_name: Option<Span>,
}

/// Number of roles of named addresses.
pub(super) const NAMED: usize = NameRole::ChamferCornerByLength as usize + 1;

impl Words {
    /// Takes out which way round an axis goes, if a word of it says so.
    pub(super) fn take_way(&mut self, letter: u8) -> Option<(RotaryWay, Span)> {
        let given = self.letters[usize::from(letter - b'A')].as_mut()?;
        given.way.take().map(|way| (way, given.span))
    }

    /// Nothing, with the memory of what was.
    pub(super) fn clear(&mut self) {
        self.codes.clear();
        self.letters = [None; 26];
        self.named = [None; NAMED];
        self.tool_name = None;
    }

    pub(super) fn get(&self, letter: u8) -> Option<Given> {
        self.letters.get(usize::from(letter.wrapping_sub(b'A'))).copied().flatten()
    }

    pub(super) fn take(&mut self, letter: u8) -> Option<Given> {
        self.letters.get_mut(usize::from(letter.wrapping_sub(b'A')))?.take()
    }

    pub(super) fn named(&self, role: NameRole) -> Option<Given> {
        self.named[role as usize]
    }

    pub(super) fn take_named(&mut self, role: NameRole) -> Option<Given> {
        self.named[role as usize].take()
    }

    /// Whether any of these letters is left.
    pub(super) fn has_any(&self, letters: &[u8]) -> bool {
        letters.iter().any(|&l| self.get(l).is_some())
    }

    /// Whether no address is left.
    pub(super) fn no_address(&self) -> bool {
        self.letters.iter().chain(&self.named).all(Option::is_none)
    }

    /// The first address that is left.
    pub(super) fn first_left(&self) -> Option<(Option<u8>, Given)> {
        let letters = self.letters.iter().zip(b'A'..).find_map(|(g, l)| Some((Some(l), (*g)?)));
        letters.or_else(|| self.named.iter().find_map(|g| Some((None, (*g)?))))
    }

    /// Leaves an address alone that has been refused.
    pub(super) fn drop_left(&mut self, letter: Option<u8>) {
        match letter {
            Some(letter) => drop(self.take(letter)),
            None => {
                if let Some(slot) = self.named.iter_mut().find(|g| g.is_some()) {
                    *slot = None;
                }
            }
        }
    }

    pub(super) fn find(&self, wanted: impl Fn(NameMeaning) -> bool) -> Option<Code> {
        self.codes.iter().find(|c| wanted(c.meaning)).copied()
    }
}
