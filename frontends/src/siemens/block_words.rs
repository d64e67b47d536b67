//! Codes and words of a block, each to be used once.
//!
//! Not here: how they are sorted (`sort`).

use ncc_dialects::{Meaning, NameMeaning, NameRole, Quantity, Role, Settings};
use ncc_ir::canon::{Axis, Distance, FeedMode, Plane, RotaryWay, Units};
use ncc_ir::source::Span;

use super::siemens_state::Motion;
use crate::common::fast_block::{Letters, Line};
use crate::common::fast_lower::repeated_motion_code;
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
    /// Takes out the direction of an axis, if a word states it.
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

/// What of the dictionary the usual blocks of one move need (`lower/fast_block`), and the block at hand.
#[derive(Debug)]
pub(in crate::siemens) struct UsualBlocks {
    pub(in crate::siemens) letters: Letters,
    /// The motions of G0 to G3, if their rows are confirmed.
    pub(in crate::siemens) motions: [Option<Motion>; 4],
    /// The numbers of the codes of straight motions, the one at feed last.
    pub(in crate::siemens) straight: [Option<u8>; 2],
    /// Whether X, Y and Z are lengths.
    pub(in crate::siemens) linear: bool,
    /// The letter of the feed, if its row is confirmed.
    pub(in crate::siemens) feed: Option<u8>,
    /// The units of the machine's basic system.
    pub(in crate::siemens) basic: Units,
    /// The plane of which positions are holes that go this way.
    pub(in crate::siemens) holes: Option<Plane>,
    pub(in crate::siemens) line: Line,
    /// Whether the last block was one, so that the next one is likely to be one, and no plain move.
    pub(in crate::siemens) likely: bool,
}

impl UsualBlocks {
    pub(in crate::siemens) fn new(settings: &Settings) -> UsualBlocks {
        let dialect = settings.dialect;
        let row = |letter: u8| dialect.address_row(letter).filter(|row| row.sure);
        let linear = |axis: Axis| {
            let row = row(axis.letter());
            row.is_some_and(|row| row.role == Role::Axis && row.quantity == Quantity::Length)
        };
        let motion = |code: u32| {
            let row = dialect.code_row(b'G', 10 * code).filter(|row| row.sure && row.read_as.is_none())?;
            match row.means? {
                Meaning::StraightTraverse => Some(Motion::Traverse),
                Meaning::StraightFeed => Some(Motion::Feed),
                Meaning::ArcFeed(turn) => Some(Motion::Arc(turn)),
                _ => None,
            }
        };
        let letters = Letters::new(dialect, *b"IJK", 0).with_signs(b'/', [b';', 0, 0]);
        let radius = dialect.name_row("CR").is_some_and(|row| row.role == Some(NameRole::Radius));
        UsualBlocks {
            letters: if radius { letters.with_equals() } else { letters },
            motions: [0, 1, 2, 3].map(motion),
            straight: [false, true].map(|feed| repeated_motion_code(dialect, feed)),
            linear: linear(Axis::X) && linear(Axis::Y) && linear(Axis::Z),
            feed: dialect.letter_for(Role::Feed).map(|letter| letter as u8).filter(|l| row(*l).is_some()),
            basic: if settings.get("feed_unit") == "inch" { Units::Inch } else { Units::Mm },
            holes: None,
            line: Line::default(),
            likely: false,
        }
    }
}
