//! The block that is being put together: what stands in it, in which order it is written, and
//! whether one more statement fits.

use ncc_ir::source::Span;

use super::codes::Code;
use super::number::{self, WordValue};

/// Parts of a block, in the order in which a move is written; in a cycle's call the offset stands
/// before the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// The label of the block.
    Label,
    /// Codes of settings, dwell and cycle end, with their own words.
    Mode,
    /// Motion, cycle and pattern codes.
    Motion,
    /// The length offset and its entry.
    Offset,
    /// Axis, centre and cycle words.
    Axes,
    /// The word of the corner after the move.
    Corner,
    /// The feed.
    Feed,
    /// Speed, tool, M codes, the words of a call.
    Tail,
}

const PARTS: usize = 8;

/// Place of a statement in the order of one block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Rank {
    Setting,
    Feed,
    Speed,
    Tool,
    ToolChange,
    SpindleOn,
    Coolant,
    Dwell,
    Offset,
    CycleEnd,
    ExactStop,
    Motion,
    SpindleOff,
    CoolantOff,
    Stop,
    Call,
    /// Nothing stands in one block with it.
    Alone,
}

/// What a statement takes of a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Need {
    rank: Rank,
    g: u8,
    m: u8,
    groups: u64,
    letters: u32,
    /// Two codes of one group in the need itself.
    clash: bool,
}

/// The bit of an address letter.
fn bit(letter: u8) -> u32 {
    1 << (letter.wrapping_sub(b'A') & 31)
}

impl Need {
    pub(crate) fn new(rank: Rank) -> Need {
        Need { rank, g: 0, m: 0, groups: 0, letters: 0, clash: false }
    }

    pub(crate) fn code(mut self, code: Option<Code>) -> Need {
        if let Some(code) = code {
            if code.is_g() {
                self.g += 1;
            } else {
                self.m += 1;
            }
            self.clash |= self.groups & code.group != 0;
            self.groups |= code.group;
            if code.letter != 0 {
                self.letters |= bit(code.letter);
            }
        }
        self
    }

    pub(crate) fn letter(mut self, letter: u8) -> Need {
        self.letters |= bit(letter);
        self
    }
}

/// A block under construction.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    parts: [Vec<u8>; PARTS],
    pub comment: Vec<u8>,
    /// Lines of comment that follow the block.
    pub after: Vec<u8>,
    pub number: Option<u32>,
    pub skip: Option<u8>,
    /// The statement of the source that stands in it last.
    pub at: Span,
    /// Codes written of which no source confirms the meaning.
    pub unsure: Vec<Code>,
    /// Whether the motion is a cycle's call.
    pub calls_up: bool,
    /// Whether a tool is changed.
    changes: bool,
    /// From which statements on none stands in a block with a tool change, if the machine decides which comes first.
    pub apart: Option<Rank>,
    blanks: bool,
    most_g: u8,
    most_m: u8,
    g: u8,
    m: u8,
    groups: u64,
    letters: u32,
    rank: Option<Rank>,
    /// What is computed in words of the block of the source at hand.
    formulas: Vec<String>,
}

impl Block {
    /// An empty block; 0 of `most_g` or `most_m` is no limit.
    pub(crate) fn new(blanks: bool, most_g: u8, most_m: u8) -> Block {
        Block {
            parts: Default::default(),
            comment: Vec::new(),
            after: Vec::new(),
            number: None,
            skip: None,
            at: Span::default(),
            unsure: Vec::new(),
            calls_up: false,
            changes: false,
            apart: None,
            blanks,
            most_g,
            most_m,
            g: 0,
            m: 0,
            groups: 0,
            letters: 0,
            rank: None,
            formulas: Vec::new(),
        }
    }

    /// Whether no word stands in it.
    pub(crate) fn is_empty(&self) -> bool {
        self.parts.iter().all(Vec::is_empty)
    }

    /// Whether no more than a label stands in it.
    pub(crate) fn is_label(&self) -> bool {
        self.parts.iter().enumerate().all(|(part, text)| text.is_empty() == (part != Part::Label as usize))
    }

    /// Whether an address letter stands in it.
    pub(crate) fn has(&self, letter: u8) -> bool {
        self.letters & bit(letter) != 0
    }

    /// Takes a word out that stands in it alone.
    pub(crate) fn drop_alone(&mut self, letter: u8) {
        let tail = Part::Tail as usize;
        let others = self.parts.iter().enumerate().any(|(part, text)| part != tail && !text.is_empty());
        if self.letters == bit(letter) && (self.g, self.m) == (0, 0) && !others {
            self.parts[tail].clear();
            (self.letters, self.rank) = (0, None);
        }
    }

    /// How many characters its words have, without blanks.
    pub(crate) fn bare_length(&self) -> usize {
        self.parts.iter().flatten().filter(|byte| **byte != b' ').count()
    }

    /// Whether a code of these modal groups stands in it.
    pub(crate) fn says(&self, groups: u64) -> bool {
        self.groups & groups != 0
    }

    /// Whether the block can take a statement and still be read in the order of its statements.
    pub(crate) fn fits(&self, need: &Need) -> bool {
        let Some(rank) = self.rank else { return true };
        let ordered = rank < need.rank || (rank == need.rank && rank == Rank::Setting);
        // A dwell takes over letters of the block, so no motion goes with it.
        let dwell = rank == Rank::Dwell && (Rank::Offset..=Rank::Motion).contains(&need.rank);
        // A call's words stand alone with their code.
        let call = need.rank == Rank::Call && self.letters != 0;
        // Whether the machine does what another M code says before, with or after the change is its builder's.
        let change = self.changes && need.m > 0;
        // A length that counts after the change reads as one before it, where its code stands first.
        let length = self.changes && need.rank == Rank::Offset && need.g > 0;
        let moves = self.changes && self.apart.is_some_and(|from| (from..=Rank::Motion).contains(&need.rank));
        ordered
            && !dwell
            && !call
            && !change
            && !moves
            && !length
            && self.groups & need.groups == 0
            && self.letters & need.letters == 0
            && (self.most_g == 0 || self.g + need.g <= self.most_g || need.g == 0)
            && (self.most_m == 0 || self.m + need.m <= self.most_m || need.m == 0)
    }

    /// Whether a statement fits into a block at all.
    pub(crate) fn possible(&self, need: &Need) -> bool {
        !need.clash
            && (self.most_g == 0 || need.g <= self.most_g)
            && (self.most_m == 0 || need.m <= self.most_m)
    }

    /// Whether it says a feed.
    pub(crate) fn has_feed(&self) -> bool {
        !self.parts[Part::Feed as usize].is_empty()
    }

    /// Whether the feed may go over to the next block, which is a motion.
    pub(crate) fn feed_can_wait(&self, need: &Need) -> bool {
        need.rank == Rank::Motion
            && self.rank.is_some_and(|r| r < Rank::Motion)
            && !self.parts[Part::Feed as usize].is_empty()
            && need.letters & self.feed_letter() == 0
    }

    fn feed_letter(&self) -> u32 {
        self.parts[Part::Feed as usize].first().map_or(0, |l| bit(*l))
    }

    /// Takes the feed out.
    pub(crate) fn take_feed(&mut self) -> Vec<u8> {
        self.letters &= !self.feed_letter();
        std::mem::take(&mut self.parts[Part::Feed as usize])
    }

    /// Puts a feed in that [`Block::take_feed`] took out.
    pub(crate) fn put_feed(&mut self, feed: Vec<u8>) {
        self.parts[Part::Feed as usize] = feed;
        self.letters |= self.feed_letter();
        self.rank = self.rank.max(Some(Rank::Feed));
    }

    /// Notes what a statement takes.
    pub(crate) fn take(&mut self, need: &Need) {
        self.rank = Some(need.rank);
        self.changes |= need.rank == Rank::ToolChange;
        self.g += need.g;
        self.m += need.m;
        self.groups |= need.groups;
        self.letters |= need.letters;
    }

    fn part(&mut self, part: Part) -> &mut Vec<u8> {
        let to = &mut self.parts[part as usize];
        if self.blanks && !to.is_empty() {
            to.push(b' ');
        }
        to
    }

    pub(crate) fn code(&mut self, part: Part, code: &Code) {
        if code.unsure.is_some() {
            self.unsure.push(*code);
        }
        let text = code.text();
        self.part(part).extend_from_slice(text);
    }

    pub(crate) fn word(&mut self, part: Part, letter: u8, value: impl Into<WordValue>) {
        let formulas = std::mem::take(&mut self.formulas);
        let to = self.part(part);
        to.push(letter);
        match value.into() {
            WordValue::Number(shaped) => number::append(to, shaped),
            WordValue::Formula(at) => to.extend_from_slice(formulas[usize::from(at)].as_bytes()),
        }
        self.formulas = formulas;
    }

    /// Keeps the text of what is computed until its word is written.
    pub(crate) fn formula(&mut self, text: String) -> WordValue {
        self.formulas.push(text);
        WordValue::Formula((self.formulas.len() - 1) as u16)
    }

    /// A block of the source begins: words of the one before are written.
    pub(crate) fn forget_formulas(&mut self) {
        self.formulas.clear();
    }

    /// A word that is not a letter and a number.
    pub(crate) fn text(&mut self, part: Part, text: &str) {
        self.part(part).extend_from_slice(text.as_bytes());
    }

    /// A word with digits of its own.
    pub(crate) fn digits(&mut self, part: Part, letter: u8, digits: &str) {
        let to = self.part(part);
        to.push(letter);
        to.extend_from_slice(digits.as_bytes());
    }

    /// Appends the words to a line and empties the block, all but its skip level.
    pub(crate) fn write(&mut self, to: &mut Vec<u8>, mut blank: bool) {
        let order = match self.calls_up {
            true => [
                Part::Label,
                Part::Mode,
                Part::Offset,
                Part::Motion,
                Part::Axes,
                Part::Corner,
                Part::Feed,
                Part::Tail,
            ],
            false => [
                Part::Label,
                Part::Mode,
                Part::Motion,
                Part::Offset,
                Part::Axes,
                Part::Corner,
                Part::Feed,
                Part::Tail,
            ],
        };
        for part in order {
            let from = &mut self.parts[part as usize];
            if !from.is_empty() {
                if blank && self.blanks {
                    to.push(b' ');
                }
                to.append(from);
                blank = true;
            }
        }
        if !self.comment.is_empty() {
            if blank && self.blanks {
                to.push(b' ');
            }
            to.append(&mut self.comment);
        }
        self.number = None;
        self.calls_up = false;
        self.changes = false;
        (self.g, self.m, self.groups, self.letters, self.rank) = (0, 0, 0, 0, None);
    }
}
