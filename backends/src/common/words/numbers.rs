//! Numbers of blocks: those of the source, or counted by the layout, and the number that a line has because others name
//! it.

use ncc_dialects::BlockRules;
use ncc_ir::source::Span;

use crate::Numbering;

/// Highest block number (FANUC 16-C: N1 to N99999); numbering begins again after it.
pub(crate) const HIGHEST_NUMBER: u32 = 99_999;

/// Which number the next block has, and what became of the source's.
#[derive(Clone, Debug)]
pub(crate) struct Numbers {
    pub(crate) numbering: Numbering,
    /// The next one, where they are counted.
    pub(super) next: u32,
    /// Number that the next line with words has.
    pub(crate) waiting: Option<u32>,
    /// Whether the line at hand is a number alone.
    pub(crate) bare: bool,
    /// Whether blocks are jumped to: beside their numbers no block has one of ours.
    pub(crate) jumps: bool,
    /// Lines with words since the last label.
    pub(crate) lines: u32,
    /// How many of the source are not written, and where the first of them stands.
    pub(super) left: u32,
    pub(super) first_left: Option<Span>,
}

impl Numbers {
    pub(super) fn new(rules: &BlockRules, numbering: Numbering) -> Numbers {
        let next = match numbering {
            Numbering::Every { first, .. } => first,
            Numbering::Off | Numbering::Keep => 0,
        };
        let numbering = match rules.number {
            Some(_) => numbering,
            None => Numbering::Off,
        };
        let (waiting, first_left) = (None, None);
        Numbers { numbering, next, waiting, bare: false, jumps: false, lines: 0, left: 0, first_left }
    }

    /// The next of counted numbers.
    pub(crate) fn count(&mut self, first: u32, step: u32) -> u32 {
        let number = self.next;
        let next = number.saturating_add(step);
        self.next = if next > HIGHEST_NUMBER { first } else { next };
        number
    }

    /// The number of the line that is being written; `empty`: it has no words.
    pub(super) fn of_line(&mut self, empty: bool, own: Option<u32>) -> Option<u32> {
        let label = if empty { None } else { self.waiting.take() };
        self.lines += u32::from(!empty);
        match self.numbering {
            _ if self.bare => None,
            Numbering::Off | Numbering::Keep | Numbering::Every { .. } if label.is_some() => label,
            Numbering::Off => None,
            Numbering::Keep => own,
            Numbering::Every { .. } if empty || self.jumps => None,
            Numbering::Every { first, step } => Some(self.count(first, step)),
        }
    }

    /// Notes the block number of the source at a place, if it is not written.
    pub(crate) fn seen(&mut self, number: Option<u32>, at: Span) {
        if number.is_some() && self.numbering == Numbering::Off {
            self.left = self.left.saturating_add(1);
            self.first_left.get_or_insert(at);
        }
    }
}
