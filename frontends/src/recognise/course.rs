//! What only several blocks together show: tools called without M06, feeds that are all low, a Y that never comes.

use std::collections::BTreeSet;
use std::ops::Range;

use super::blocks::{Block, Word, bit};
use super::signs::{Kind, Sign, Sort};

/// Letters of axes.
const AXES: &[u8] = b"XYZABCUVW";
/// Words of turners in comments.
const TURNERS: [&[u8]; 11] = [
    b"TURN",
    b"TURNING",
    b"LATHE",
    b"OD",
    b"ID",
    b"THREAD",
    b"THREADING",
    b"TORNO",
    b"TORNEADO",
    b"DREHEN",
    b"DREHTEIL",
];
/// G codes of the canned cycles of mills.
const HOLES: [u32; 13] = [730, 740, 760, 800, 810, 820, 830, 840, 850, 860, 870, 880, 890];
/// G codes whose F is the lead of a thread, or may be.
const THREADS: [u32; 9] = [320, 330, 331, 740, 760, 780, 840, 920, 210];
/// Beginnings of names of an Okuma's system variables.
const OKUMA_VARIABLES: [&[u8]; 9] =
    [b"VZOF", b"VTOF", b"VZSHF", b"VTLC", b"VTLN", b"VWKC", b"VDOUT", b"VUACM", b"VMOFS"];
/// So many moves with an E show that it is an axis.
const EXTRUSIONS: usize = 3;
/// Names with which blocks of a Sinumerik begin: lines that need no word with a number.
const CONTROL: [&[u8]; 18] = [
    b"CALL",
    b"PROC",
    b"DEF",
    b"REDEF",
    b"EXTERN",
    b"MSG",
    b"MCALL",
    b"IF",
    b"ELSE",
    b"ENDIF",
    b"WHILE",
    b"ENDWHILE",
    b"FOR",
    b"ENDFOR",
    b"LOOP",
    b"ENDLOOP",
    b"REPEAT",
    b"UNTIL",
];
/// Signs that no control writes outside comments and texts in quotes. Braces are left out: some macro languages
/// have them.
const FOREIGN: &[u8] = b"\\?!|`^";
/// A line with more words than these is a sentence, though it may name a code.
const MANY_WORDS: usize = 4;
/// Of the lines of a text, so many percent may look like blocks, and so many must be sentences.
const PROSE: (usize, usize) = (20, 30);

/// The unit of length that the text names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Unit {
    #[default]
    Unsaid,
    Millimetre,
    Inch,
}

/// A cycle's first block, waiting for the next one.
#[derive(Debug)]
struct Waiting {
    code: u32,
    place: Range<usize>,
}

/// What was seen so far.
#[derive(Debug, Default)]
pub(super) struct Course {
    moves_y: bool,
    moves_z: bool,
    moves_v: bool,
    xz: Option<Range<usize>>,
    length_offset: bool,
    tool_change: bool,
    incremental: bool,
    feed_mode: bool,
    /// G93 or G95: G98 and G99 are no modes of the feed then.
    feed_code: bool,
    /// The first G95.
    per_revolution: Option<Range<usize>>,
    unit: Unit,
    cycles: bool,
    per_turn: Option<Range<usize>>,
    highest_feed: f64,
    first_feed: Option<Range<usize>>,
    tool: Option<Range<usize>>,
    tools: BTreeSet<u32>,
    cancelled: Option<Range<usize>>,
    surface: Option<Range<usize>>,
    turner: Option<Range<usize>>,
    waiting: Option<Waiting>,
    repeated: Vec<(u32, Range<usize>)>,
    extrusions: Vec<Range<usize>>,
    conditions: Vec<Range<usize>>,
    origin: Option<Range<usize>>,
    offset: Option<Range<usize>>,
    named: Option<Range<usize>>,
    call: Option<Range<usize>>,
    variable: Option<Range<usize>>,
    system: Option<Range<usize>>,
    lettered: Option<Range<usize>>,
    stations: BTreeSet<u32>,
    station: Option<Range<usize>>,
    six_digits: Option<Range<usize>>,
    heading: Option<Range<usize>>,
    conversational: Option<Range<usize>>,
    begun: bool,
    lines: usize,
    blocks: usize,
    sentences: usize,
    first_sentence: Option<Range<usize>>,
}

/// Keeps the first place.
fn first(kept: &mut Option<Range<usize>>, place: &Range<usize>) {
    kept.get_or_insert_with(|| place.clone());
}

impl Course {
    /// Takes a line in.
    pub(super) fn block(&mut self, block: &Block) {
        if block.text.is_empty() {
            return;
        }
        self.comment(block);
        self.lines(block);
        if !block.is_empty() && !std::mem::replace(&mut self.begun, true) {
            self.heading(block);
        }
        if let Some(name) = block.text.strip_prefix(b"CALL").map(<[u8]>::trim_ascii_start)
            && name.len() < block.text.len() - 4
            && let [b'O', b'0'..=b'9', ..] | [b'O', b'O', b'0'..=b'9', ..] = name
        {
            first(&mut self.call, &block.place);
        }
        if block.is_empty() || block.calls {
            return;
        }
        self.modes(block);
        self.axes(block);
        self.feed(block);
        self.tools(block);
        self.cycle(block);
        self.others(block);
    }

    /// The place of a sign, if the text has shown it.
    pub(super) fn place(&self, sign: &Sign) -> Option<Range<usize>> {
        let without_y = |place: &Option<Range<usize>>| place.clone().filter(|_| !self.moves_y);
        match sign.of_course()? {
            Sort::ToolWithOffset => self.tool.clone().filter(|_| !self.tool_change),
            Sort::OffsetCancelled => self.cancelled.clone().filter(|_| !self.tool_change),
            Sort::RepeatedCycle(code) => {
                let found = self.repeated.iter().find(|(own, _)| *own == code);
                found.map(|(_, place)| place.clone()).filter(|_| !self.incremental && !self.moves_y)
            }
            Sort::FeedPerTurn => self.per_turn.clone().filter(|_| !self.feed_code && self.feeds_below(2.0)),
            Sort::TurnedFeed => {
                // G98 and G99 beside G95 are return levels of a mill's cycles.
                let turned = !self.cycles && self.per_turn.is_none() && self.xz.is_some();
                let turned = turned && self.feeds_below(2.0);
                without_y(&self.per_revolution).filter(|_| turned)
            }
            Sort::LowFeed => {
                let told = self.per_turn.is_some() || self.feed_mode;
                self.first_feed.clone().filter(|_| !told && self.feeds_below(1.0))
            }
            Sort::NoY => without_y(&self.xz),
            Sort::Turret => {
                let turret = self.stations.len() > 1 && !self.tool_change && self.xz.is_some();
                without_y(&self.station).filter(|_| turret)
            }
            Sort::SurfaceSpeed => without_y(&self.surface),
            Sort::TurnersWord => self.turner.clone(),
            Sort::Extrusion => {
                self.extrusions.first().filter(|_| self.extrusions.len() >= EXTRUSIONS).cloned()
            }
            Sort::OriginWithoutZ => self.origin.clone().filter(|_| !self.moves_z),
            Sort::CuttingCondition => self.conditions.first().filter(|_| self.conditions.len() > 1).cloned(),
            Sort::OffsetAssigned => self.offset.clone(),
            Sort::NamedBlock => self.named.clone(),
            Sort::OkumaCall => self.call.clone(),
            Sort::CommonVariable => self.variable.clone(),
            Sort::SystemVariable => self.system.clone(),
            Sort::LetteredProgram => self.lettered.clone(),
            Sort::SixDigitTool => self.six_digits.clone().filter(|_| !self.tool_change),
            Sort::IsoHeading => self.heading.clone(),
            Sort::ConversationalMove => self.conversational.clone(),
            Sort::Prose => {
                let prose =
                    self.blocks * 100 <= self.lines * PROSE.0 && self.sentences * 100 >= self.lines * PROSE.1;
                self.first_sentence.clone().filter(|_| prose)
            }
        }
    }

    /// What speaks for a mill, where the text may be of this kind.
    pub(super) fn milling(&self, kind: Kind) -> i32 {
        match kind {
            // With a V, U and W are axes of their own.
            Kind::Lathe => {
                3 * (i32::from(self.moves_y) + i32::from(self.moves_v) + i32::from(self.length_offset))
            }
            Kind::WireEdm => {
                i32::from(self.moves_z) + 3 * i32::from(self.length_offset) + 3 * i32::from(self.tool_change)
            }
            Kind::Printer => 3 * i32::from(self.length_offset),
            Kind::Heidenhain | Kind::Okuma | Kind::Mazatrol | Kind::Text => 0,
        }
    }

    /// Whether there are feeds, and all are as low as those per revolution: below `most` millimetres, a twentieth
    /// of that in inches, half of it where no unit is named.
    fn feeds_below(&self, most: f64) -> bool {
        let most = match self.unit {
            Unit::Millimetre => most,
            Unit::Inch => most / 20.0,
            Unit::Unsaid => most / 2.0,
        };
        self.first_feed.is_some() && self.highest_feed <= most
    }

    fn modes(&mut self, block: &Block) {
        self.incremental |= block.code(b'G', 910);
        self.feed_mode |= [930, 940, 950].iter().any(|code| block.code(b'G', *code));
        self.feed_code |= block.code(b'G', 930) || block.code(b'G', 950);
        if let Some((_, word)) = block.codes(b'G').find(|(code, _)| *code == 950) {
            first(&mut self.per_revolution, &word.place);
        }
        self.length_offset |= block.has(b'H') && (block.code(b'G', 430) || block.code(b'G', 440));
        self.tool_change |= block.code(b'M', 60);
        if block.code(b'G', 210) || block.code(b'G', 710) && !block.has(b'P') && !block.has(b'U') {
            self.unit = Unit::Millimetre;
        } else if block.code(b'G', 200) {
            self.unit = Unit::Inch;
        }
        let holes = block.codes(b'G').any(|(code, _)| HOLES.contains(&code) && code != 800);
        for code in [980, 990] {
            let found = block.codes(b'G').find(|(own, _)| *own == code);
            if let Some((_, word)) = found.filter(|_| !holes && !self.cycles) {
                first(&mut self.per_turn, &word.place);
            }
        }
        self.cycles |= holes;
        for code in [960, 970] {
            if let Some((_, word)) = block.codes(b'G').find(|(own, _)| *own == code)
                && block.has(b'S')
            {
                first(&mut self.surface, &word.place);
            }
        }
    }

    fn axes(&mut self, block: &Block) {
        self.moves_y |= block.has(b'Y');
        self.moves_z |= block.has(b'Z');
        self.moves_v |= block.has(b'V');
        if block.has(b'X') && block.has(b'Z') {
            first(&mut self.xz, &block.place);
        }
        if block.has(b'E') && (block.has(b'X') || block.has(b'Y')) && self.extrusions.len() < EXTRUSIONS {
            self.extrusions.push(block.place.clone());
        }
        if block.code(b'G', 920) && block.has(b'X') && block.has(b'Y') && !block.has(b'Z') {
            first(&mut self.origin, &block.place);
        }
    }

    fn feed(&mut self, block: &Block) {
        let thread = block.codes(b'G').any(|(code, _)| THREADS.contains(&code) && !matches!(code, 210));
        let Some(word) = block.word(b'F').filter(|_| !thread) else { return };
        let Some(value) = word.value.filter(|value| *value > 0.0) else {
            // A computed feed may be anything.
            self.highest_feed = f64::INFINITY;
            return;
        };
        first(&mut self.first_feed, &word.place);
        // Without a point it may count thousandths.
        self.highest_feed = self.highest_feed.max(if word.point { value } else { value.max(10.0) });
    }

    fn tools(&mut self, block: &Block) {
        let Some(word) = block.word(b'T').filter(|word| !word.point) else { return };
        let Some(value) = word.value.map(|value| value as u32) else { return };
        if value > 0 {
            self.stations.insert(value);
            first(&mut self.station, &word.place);
        }
        match word.digits {
            3 | 4 => {
                first(&mut self.tool, &word.place);
                match value % 100 {
                    0 if self.tools.contains(&(value / 100)) => first(&mut self.cancelled, &word.place),
                    0 => {}
                    _ => drop(self.tools.insert(value / 100)),
                }
            }
            6 => first(&mut self.six_digits, &word.place),
            _ => {}
        }
    }

    /// A cycle's block, and the blocks that repeat it.
    fn cycle(&mut self, block: &Block) {
        if let Some(waiting) = self.waiting.take() {
            let axes = AXES.iter().filter(|axis| block.has(**axis)).count();
            let one = axes == 1 && (block.has(b'X') || block.has(b'Z'));
            let others = block.letters & !(bit(b'X') | bit(b'Z') | bit(b'F') | bit(b'N'));
            if one && others == 0 {
                self.repeated.push((waiting.code, waiting.place));
            }
        }
        let mut codes = block.codes(b'G');
        let (Some((code, _)), None) = (codes.next(), codes.next()) else { return };
        let axes = (block.has(b'X') || block.has(b'U')) && (block.has(b'Z') || block.has(b'W'));
        let others = [b'Y', b'A', b'B', b'C', b'I', b'J', b'K', b'M', b'H'].iter().any(|l| block.has(*l));
        if [900, 940, 200, 210].contains(&code) && axes && block.has(b'F') && !others {
            self.waiting = Some(Waiting { code, place: block.place.clone() });
        }
    }

    fn others(&mut self, block: &Block) {
        if let Some(word) = block.word(b'E').filter(|word| word.digits == 4 && !word.point)
            && self.conditions.len() < 2
        {
            self.conditions.push(word.place.clone());
        }
        if let Some((at, rest)) = assigned(block, b'H')
            && rest.contains(&b'.')
        {
            first(&mut self.offset, &at);
        }
        if let Some((name, place)) = block.names.first()
            && *place == (block.place.start..block.place.start + name.len())
        {
            let letters = name.iter().take_while(|b| b.is_ascii_alphabetic()).count();
            let digits = &name[letters..];
            let numbered = !digits.is_empty() && digits.iter().all(u8::is_ascii_digit);
            if name[0] == b'N' && numbered && block.words.first().is_some_and(|word| word.letter == b'G') {
                first(&mut self.named, place);
            }
            if OKUMA_VARIABLES.iter().any(|own| name.starts_with(own)) {
                first(&mut self.system, place);
            }
            if name.starts_with(b"VC") && letters == 2 && numbered && block.code.contains(&b'=') {
                first(&mut self.variable, place);
            }
        }
        self.heidenhain(block);
    }

    /// The first line that is no comment.
    fn heading(&mut self, block: &Block) {
        let text = &block.text[..];
        if text.starts_with(b"%")
            && text.ends_with(b"*")
            && [&b" G71 "[..], b" G70 "].iter().any(|code| memchr::memmem::find(text, code).is_some())
        {
            first(&mut self.heading, &block.place);
        }
        if let [(name, place)] = &block.names[..]
            && block.words.is_empty()
            && name == &block.code
            && name[0] == b'O'
            && name.len() <= 5
            && name.iter().all(u8::is_ascii_alphanumeric)
        {
            first(&mut self.lettered, place);
        }
    }

    fn heidenhain(&mut self, block: &Block) {
        let text = &block.text[..];
        let digits = text.iter().take_while(|b| b.is_ascii_digit()).count();
        let mut words = text[digits..].split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        if words.next() != Some(b"L") {
            return;
        }
        let axis = words.clone().next().is_some_and(|word| {
            let word = word.strip_prefix(b"I").unwrap_or(word);
            matches!(word, [b'X' | b'Y' | b'Z' | b'A' | b'B' | b'C', b'+' | b'-' | b'0'..=b'9', ..])
        });
        let ends = |word: &[u8]| matches!(word, b"R0" | b"RL" | b"RR" | b"FMAX");
        if axis && words.any(ends) {
            first(&mut self.conversational, &block.place);
        }
    }

    fn comment(&mut self, block: &Block) {
        if self.turner.is_some() || !block.text.iter().any(|b| b"(;".contains(b)) {
            return;
        }
        let from = block.text.iter().position(|b| b"(;".contains(b)).unwrap_or(0);
        let words = block.text[from..].split(|b| !b.is_ascii_alphanumeric());
        if words.into_iter().any(|word| TURNERS.contains(&word)) {
            self.turner = Some(block.place.start + from..block.place.end);
        }
    }

    /// Counts lines that are blocks, and lines that are sentences.
    fn lines(&mut self, block: &Block) {
        if block.is_empty() {
            return;
        }
        self.lines += 1;
        match Line::from_block(block) {
            Line::Block => self.blocks += 1,
            Line::Sentence => {
                self.sentences += 1;
                first(&mut self.first_sentence, &block.place);
            }
            Line::Neither => {}
        }
    }
}

/// What a line looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Line {
    /// A block of some control.
    Block,
    /// Words of a text; comments and texts in quotes are none.
    Sentence,
    /// It may be either.
    Neither,
}

impl Line {
    /// Of a line that is more than a comment.
    pub(super) fn from_block(block: &Block) -> Line {
        let foreign = block.code.iter().any(|b| FOREIGN.contains(b));
        if foreign && !block.names.is_empty() && !block.code.contains(&b'#') {
            return Line::Sentence;
        }
        let plain = block.names.iter().filter(|(name, _)| name.iter().all(u8::is_ascii_alphabetic)).count();
        let codes = block.words.iter().filter(|word| is_block_word(word)).count();
        if plain > MANY_WORDS && codes <= 2 && !block.code.iter().any(|b| b"=[#<".contains(b)) {
            return Line::Sentence;
        }
        let starts = |sign: &[u8]| block.code.first().is_some_and(|b| sign.contains(b));
        // A label is a name with a colon; `:1000` is the number of a program.
        let label = block.names.first().is_some_and(|(name, _)| block.code.get(name.len()) == Some(&b':'));
        let block_like = block.words.iter().any(is_block_word)
            || block.code.iter().any(|b| b"=[".contains(b))
            || starts(b"%:$/")
            || label && block.names.len() < 4
            || block.text.windows(2).any(|two| two[0] == b'#' && b"0123456789[<#".contains(&two[1]))
            || block.text.windows(2).any(|two| two[0] == b'$' && two[1].is_ascii_uppercase())
            || block.text.iter().position(|b| *b == b'(').is_some_and(|at| {
                at > 1 && block.text[..at].iter().all(|b| b.is_ascii_uppercase() || *b == b'_')
            })
            || block.names.first().is_some_and(|(name, _)| {
                CONTROL.contains(&&name[..]) || name.starts_with(b"GOTO") || name.contains(&b'_')
            });
        match (block_like, block.names.len()) {
            (true, _) => Line::Block,
            (false, 4..) => Line::Sentence,
            (false, _) => Line::Neither,
        }
    }
}

/// Whether a word is one that blocks are made of.
fn is_block_word(word: &Word) -> bool {
    word.value.is_some() && b"GMNOTSFXYZ".contains(&word.letter)
}

/// A block that gives a value to a numbered letter, `H1=0.25`: the place, and what follows the sign.
fn assigned(block: &Block, letter: u8) -> Option<(Range<usize>, &[u8])> {
    let text = &block.text[..];
    let [first, rest @ ..] = text else { return None };
    let digits = rest.iter().take_while(|b| b.is_ascii_digit()).count();
    let value = rest[digits..].trim_ascii_start().strip_prefix(b"=")?;
    (*first == letter && digits > 0).then_some((block.place.clone(), value))
}
