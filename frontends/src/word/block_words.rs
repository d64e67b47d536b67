//! Codes and words of a block, and which letters have which role.
//!
//! Not here: how they are sorted (`sort`).

use ncc_dialects::{BLOCK_SKIP, Bare, CodeRow, Dialect, Meaning, NumberRules, Quantity, Role, Settings};
use ncc_ir::canon::{Axis, Motion, Plane};
use ncc_ir::expr::Expr;
use ncc_ir::source::Span;

use crate::common::fast_block::{Letters, Line};
use crate::common::fast_lower::repeated_motion_code;
use crate::common::words::Word;

/// Letters by role; 0 where the dialect has none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Roles {
    pub(super) feed: u8,
    pub(super) speed: u8,
    pub(super) tool: u8,
    pub(super) length_entry: u8,
    pub(super) corrector: u8,
    pub(super) radius_entry: u8,
    pub(super) radius: u8,
    pub(super) centre: [u8; 3],
    /// Letters of axes, a bit each.
    pub(super) axes: u32,
    /// Letters of rotary axes, a bit each.
    pub(super) rotary: u32,
    /// Letter of an arc's turns.
    pub(super) turns: u8,
}

impl Roles {
    pub(super) fn new(dialect: &Dialect) -> Roles {
        let letter = |role| dialect.letter_for(role).map_or(0, |c| c as u8);
        let axes = dialect.address.iter().filter(|row| row.role == Role::Axis);
        let bits =
            |bits: u32, row: &ncc_dialects::Address| bits | 1 << (row.letter as u8).saturating_sub(b'A');
        Roles {
            feed: letter(Role::Feed),
            speed: letter(Role::Speed),
            tool: letter(Role::Tool),
            length_entry: letter(Role::LengthEntry),
            corrector: letter(Role::Corrector),
            radius_entry: letter(Role::RadiusEntry),
            radius: letter(Role::Radius),
            centre: [letter(Role::CentreX), letter(Role::CentreY), letter(Role::CentreZ)],
            axes: axes.clone().fold(0, bits),
            rotary: axes.filter(|row| row.quantity == ncc_dialects::Quantity::Angle).fold(0, bits),
            turns: dialect.arc.turns.map_or(0, |c| c as u8),
        }
    }
}

/// A G or M code of a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Code {
    pub(super) row: &'static CodeRow,
    pub(super) meaning: Meaning,
    pub(super) span: Span,
    /// Index of its word.
    pub(super) at: usize,
}

/// The words of a block that are no codes, each to be used once.
#[derive(Debug)]
pub(super) struct Words<'b> {
    pub(super) all: &'b [Word],
    /// What of them is computed.
    pub(super) exprs: &'b [Expr],
    /// Index plus one, by letter.
    pub(super) at: [u16; 26],
    /// Letters that are still to be used, a bit each.
    pub(super) left: u32,
}

impl Words<'_> {
    /// The word of a letter, which is then used.
    #[inline]
    pub(super) fn take(&mut self, letter: u8) -> Option<Word> {
        let word = self.get(letter)?;
        self.left &= !(1 << (letter - b'A'));
        Some(word)
    }

    /// Whether any of these letters (a bit each) is still to be used.
    #[inline]
    pub(super) fn has_any(&self, letters: u32) -> bool {
        self.left & letters != 0
    }

    /// The word of a letter, if it is still to be used.
    #[inline]
    pub(super) fn get(&self, letter: u8) -> Option<Word> {
        let place = usize::from(letter.wrapping_sub(b'A'));
        if place >= 26 || self.left >> place & 1 == 0 {
            return None;
        }
        Some(self.all[usize::from(self.at[place]) - 1])
    }
}

/// The motion of a motion code.
pub(super) fn motion_of(meaning: Meaning) -> Option<Motion> {
    match meaning {
        Meaning::StraightTraverse => Some(Motion::Traverse),
        Meaning::StraightFeed | Meaning::SynchronisedFeed(_) => Some(Motion::Feed),
        Meaning::ArcFeed(turn) => Some(Motion::Arc(turn)),
        _ => None,
    }
}

/// What of the dictionary the usual blocks of one move need (`lower/fast_block`), and the block at hand.
#[derive(Debug)]
pub(in crate::word) struct UsualBlocks {
    pub(in crate::word) letters: Letters,
    /// The motions of G0 to G3, if their rows are confirmed.
    pub(in crate::word) motions: [Option<Motion>; 4],
    /// The numbers of the codes of straight motions, the one at feed last.
    pub(in crate::word) straight: [Option<u8>; 2],
    /// Whether one of these changes the motion and nothing else, where the other one is active.
    pub(in crate::word) switches: bool,
    /// Whether X, Y and Z are lengths.
    pub(in crate::word) linear: bool,
    /// Whether the feed's row is confirmed.
    pub(in crate::word) feed: bool,
    /// Whether a length without a point means the same, and an angle.
    pub(in crate::word) lengths: bool,
    pub(in crate::word) angles: bool,
    /// Highest level of a block skip that goes this way.
    pub(in crate::word) skip_levels: u8,
    /// The plane of which positions are holes that go this way.
    pub(in crate::word) holes: Option<Plane>,
    pub(in crate::word) line: Line,
    /// Whether the last block was one, so that the next one is likely to be one, and no plain move.
    pub(in crate::word) likely: bool,
    /// Every block goes the long way.
    #[cfg(test)]
    pub(in crate::word) off: bool,
}

impl UsualBlocks {
    pub(in crate::word) fn new(settings: &Settings, roles: &Roles, rules: &[NumberRules; 8]) -> UsualBlocks {
        let dialect = settings.dialect;
        let row = |letter: u8| dialect.address_row(letter).filter(|row| row.sure);
        let linear = |axis: Axis| {
            row(axis.letter()).is_some_and(|row| row.role == Role::Axis && row.quantity == Quantity::Length)
        };
        let motion = |code: u32| {
            let row = dialect.code_row(b'G', 10 * code).filter(|row| row.sure)?;
            let plain = row.refused_under_compensation.is_none() && row.read_as.is_none();
            let meaning = row.means.filter(|_| plain && !row.passed_over)?;
            motion_of(meaning).filter(|_| !matches!(meaning, Meaning::SynchronisedFeed(_)))
        };
        let understood = |quantity: Quantity| {
            let rules = &rules[quantity as usize];
            rules.bare == Bare::Units && !rules.unsigned
        };
        let first = |text: &str| text.bytes().next().unwrap_or(0);
        let (block, comment) = (&dialect.block, &dialect.comment);
        let signs = [&comment.open, &comment.close, &comment.line].map(|text| first(text));
        let straight = [false, true].map(|feed| repeated_motion_code(dialect, feed));
        let says = |code: Option<u8>, which: Motion| {
            code.is_some_and(|code| motion(u32::from(code)).is_some_and(|motion| motion == which))
        };
        let switches = says(straight[0], Motion::Traverse)
            && says(straight[1], Motion::Feed)
            && !dialect.cycles.level_lost;
        let stated = ["on", "off"].contains(&settings.get(BLOCK_SKIP));
        UsualBlocks {
            letters: Letters::new(dialect, roles.centre, roles.radius).with_signs(first(&block.skip), signs),
            skip_levels: if stated { 0 } else { block.skip_levels },
            motions: [0, 1, 2, 3].map(motion),
            straight,
            switches,
            linear: linear(Axis::X) && linear(Axis::Y) && linear(Axis::Z),
            feed: row(roles.feed).is_some(),
            lengths: understood(Quantity::Length),
            angles: understood(Quantity::Angle),
            holes: None,
            line: Line::default(),
            likely: false,
            #[cfg(test)]
            off: false,
        }
    }
}
