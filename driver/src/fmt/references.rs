//! Block numbers of a text, and everything that names one: what renumbering has to know.
//!
//! What names a block:
//! - `GOTO n` of the macro languages (Fanuc 16i/18i-PB, custom macro), `GOTO`, `GOTOF`, `GOTOB`, `GOTOC`
//!   with a number, `CALL BLOCK n TO m` (Sinumerik, Job Planning);
//! - the `blocks` of a code's row in the dictionary: `M97 P`, a block of the same program, and of a return
//!   the block at which the *caller* goes on, `M99 P`.
//!
//! What may name one and cannot be known to, is a [`Doubt`]. Not here: new numbers (`number`).

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use ncc_dialects::{Dialect, Family, Meaning, Role, Settings};
use ncc_frontends::pieces::{LineIs, Lines, Piece, PieceKind as Kind};

use crate::render::messages::message::{Message, Part};

/// A block.
#[derive(Clone, Debug)]
pub struct Block {
    /// Which program or unit it stands in.
    pub scope: usize,
    /// Its number.
    pub number: Option<Number>,
    /// Where a number goes, if it has none.
    pub place: usize,
    /// Whether it says anything besides its number.
    pub says: bool,
    /// Its line, from 1.
    pub line: u32,
}

/// A block's number.
#[derive(Clone, Debug)]
pub struct Number {
    pub(crate) value: u32,
    /// Letter and digits.
    pub word: Range<usize>,
    /// The digits.
    pub digits: Range<usize>,
    /// Where the rest of the block begins.
    pub rest: usize,
    /// Whether a number of this form can be left out.
    pub optional: bool,
}

/// A place that names a block.
#[derive(Clone, Debug)]
pub struct Reference {
    pub(crate) value: u32,
    pub(crate) digits: Range<usize>,
    /// Whose block it is.
    pub scope: usize,
    /// It is a block of those that call the program it stands in.
    pub of_callers: bool,
    pub(crate) line: u32,
}

/// What keeps numbers from being changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    pub(crate) line: u32,
    pub(crate) what: String,
    /// It counts only if a block of the scope has this number.
    pub only: Option<(usize, u32)>,
}

/// What was found in a text.
#[derive(Debug, Default)]
pub struct Found {
    pub(crate) blocks: Vec<Block>,
    pub(crate) references: Vec<Reference>,
    pub(crate) doubts: Vec<Doubt>,
    /// Numbers of programs, by scope.
    pub programs: BTreeMap<usize, u32>,
    /// Which scope calls which program.
    pub calls: BTreeSet<(usize, u32)>,
    /// Names that jumps lead to: scope, name, line.
    named: Vec<(usize, String, u32)>,
    labels: BTreeSet<(usize, String)>,
}

/// An entry about what keeps numbers from being changed.
pub(crate) fn reason(form: &'static str) -> Message {
    Message::part(Part::Renumber, form)
}

/// Looks through a text.
pub fn find(settings: &Settings, text: &[u8]) -> Found {
    let mut lines = Lines::new(settings.clone());
    let mut look =
        Look { dialect: settings.dialect, found: Found::default(), scope: 0, named: false, line: 0 };
    let (mut base, mut pieces) = (0, Vec::new());
    for whole in text.split_inclusive(|b| *b == b'\n') {
        look.line += 1;
        let line = whole.trim_ascii_end();
        match lines.line(line, &mut pieces) {
            LineIs::Blocks => {
                for block in pieces.split(|piece| piece.kind == Kind::End) {
                    look.block(line, base, block);
                }
            }
            LineIs::Frame if line.len() > 1 && settings.dialect.family == Family::Sinumerik => {
                look.scope += usize::from(line.starts_with(b"%"));
            }
            LineIs::Frame | LineIs::Outside => {}
            LineIs::Unread => look.doubt(&reason("unread"), None),
        }
        base += whole.len();
    }
    let mut found = look.found;
    for (scope, name, line) in std::mem::take(&mut found.named) {
        if !found.labels.contains(&(scope, name.clone())) {
            let what = reason("no-label").text("name", name).headline();
            found.doubts.push(Doubt { line, what, only: None });
        }
    }
    found.doubts.sort_by_key(|doubt| doubt.line);
    found
}

struct Look<'d> {
    dialect: &'d Dialect,
    found: Found,
    scope: usize,
    /// Whether the program in hand has a name in place of a number.
    named: bool,
    line: u32,
}

/// A word with a number without point: its letter, its value, its digits in the line.
#[derive(Clone, Copy)]
struct Whole {
    letter: u8,
    value: u32,
    start: usize,
    end: usize,
}

/// The number of a program that is named by it, `<O12>`.
fn number_named(name: &[u8]) -> Option<u32> {
    let digits = name.strip_prefix(b"<")?.strip_suffix(b">")?;
    let digits = digits.strip_prefix(b"O").or_else(|| digits.strip_prefix(b"o"))?;
    std::str::from_utf8(digits).ok().filter(|d| d.bytes().all(|b| b.is_ascii_digit()))?.parse().ok()
}

impl Look<'_> {
    fn doubt(&mut self, what: &Message, only: Option<u32>) {
        let only = only.map(|value| (self.scope, value));
        self.found.doubts.push(Doubt { line: self.line, what: what.headline(), only });
    }

    fn reference(&mut self, base: usize, value: u32, start: usize, end: usize, of_callers: bool) {
        if of_callers && self.named {
            // Which programs call it by its name is not looked for.
            self.doubt(&reason("named-program"), None);
        }
        let digits = base + start..base + end;
        let (scope, line) = (self.scope, self.line);
        self.found.references.push(Reference { value, digits, scope, of_callers, line });
    }

    fn block(&mut self, line: &[u8], base: usize, all: &[Piece]) {
        let pieces: Vec<Piece> = all.iter().copied().filter(|p| p.kind != Kind::Comment).collect();
        let at = match pieces.as_slice() {
            [] => return,
            [Piece { kind: Kind::Skip, .. }, Piece { kind: Kind::Number, .. }, ..] => 2,
            [Piece { kind: Kind::Skip, .. }, ..] => 1,
            _ => 0,
        };
        let program = match pieces.get(at..) {
            Some([sign, number, ..]) if self.begins_program(sign.text(line)) => whole_number(number, line),
            Some(_) | None => None,
        };
        let name = pieces.get(at).filter(|p| self.dialect.program.names && p.text(line).starts_with(b"<"));
        let heads = program.is_some() || name.is_some();
        self.scope += usize::from(heads);
        self.named = if heads { name.is_some() } else { self.named };
        let numbered = name.and_then(|p| number_named(p.text(line)));
        if let Some(program) = program.or(numbered) {
            self.found.programs.insert(self.scope, program);
        }
        for number in pieces.iter().skip(at + 1).filter_map(|p| number_named(p.text(line))) {
            self.found.calls.insert((self.scope, number));
        }
        let number = self.number(line, base, all, &pieces, at);
        let used = at + if number.is_some() { 2 } else { 0 };
        self.found.blocks.push(Block {
            scope: self.scope,
            place: base + pieces.get(at).map_or(line.len(), |p| p.start),
            says: !heads && pieces.len() > used,
            line: self.line,
            number: number.clone(),
        });
        match self.dialect.family {
            Family::Sinumerik => self.names(line, base, &pieces, at, number.is_some()),
            Family::Word | Family::Canon | Family::Ir => self.words(line, base, &pieces),
        }
    }

    fn begins_program(&self, sign: &[u8]) -> bool {
        let rules = &self.dialect.program;
        let is = |c: Option<char>| c.is_some_and(|c| sign == [c as u8]);
        is(rules.number) || is(rules.number_also)
    }

    /// The number of a block.
    fn number(
        &self,
        line: &[u8],
        base: usize,
        all: &[Piece],
        pieces: &[Piece],
        from: usize,
    ) -> Option<Number> {
        let letter = self.dialect.block.number? as u8;
        let at = match self.dialect.family {
            Family::Sinumerik => from,
            Family::Word | Family::Canon | Family::Ir => {
                pieces.iter().position(|p| p.kind == Kind::Address && p.text(line) == [letter])?
            }
        };
        let (sign, number) = (pieces.get(at)?, pieces.get(at + 1)?);
        let optional = sign.text(line) == [letter];
        let main = self.dialect.family == Family::Sinumerik && sign.text(line) == b":";
        let value = whole_number(number, line).filter(|_| optional || main)?;
        let rest = all.iter().find(|p| p.start >= number.end).map_or(number.end, |p| p.start);
        Some(Number {
            value,
            word: base + sign.start..base + number.end,
            digits: base + number.start..base + number.end,
            rest: base + rest,
            optional,
        })
    }

    /// References in a block of words.
    fn words(&mut self, line: &[u8], base: usize, pieces: &[Piece]) {
        let text = |at: usize| pieces.get(at).map_or(&b""[..], |p| p.text(line));
        let mut words = Vec::new();
        let mut computed = BTreeSet::new();
        let mut numbers = 0;
        for (at, piece) in pieces.iter().enumerate() {
            let next = pieces.get(at + 1);
            let value = next.and_then(|next| Some((whole_number(next, line)?, next.start, next.end)));
            match (piece.kind, value) {
                (Kind::Key, Some((value, start, end))) if text(at) == b"GOTO" => {
                    self.reference(base, value, start, end, false);
                }
                (Kind::Key, None) if text(at) == b"GOTO" => self.doubt(&reason("computed-jump"), None),
                (Kind::Address, Some((value, start, end))) => {
                    let letter = text(at)[0];
                    numbers += usize::from(Some(letter as char) == self.dialect.block.number);
                    words.push(Whole { letter, value, start, end });
                }
                (Kind::Address, None) if next.is_some_and(|n| n.kind == Kind::Sign) => {
                    computed.insert(text(at)[0]);
                }
                _ => {}
            }
        }
        if numbers > 1 || self.dialect.block.number.is_some_and(|n| computed.contains(&(n as u8))) {
            self.doubt(&reason("two-or-computed"), None);
        }
        self.codes(base, pieces, line, &words, &computed);
    }

    /// What the codes of a block make of its words.
    fn codes(
        &mut self,
        base: usize,
        pieces: &[Piece],
        line: &[u8],
        words: &[Whole],
        computed: &BTreeSet<u8>,
    ) {
        let word = |letter: u8| words.iter().find(|w| w.letter == letter).copied();
        let row = |w: &Whole| {
            let tenths = w.value.checked_mul(10)?;
            matches!(w.letter, b'G' | b'M').then(|| self.dialect.code_row(w.letter, tenths)).flatten()
        };
        let mut known = Vec::new();
        for row in words.iter().filter_map(row) {
            let program = row.words.bytes().next();
            let names_program = row.means == Some(Meaning::Call)
                && !program.is_some_and(|letter| row.blocks.as_bytes().contains(&letter));
            let elsewhere = names_program
                && program.is_some_and(|letter| word(letter).is_some() || computed.contains(&letter));
            for letter in row.blocks.bytes().filter(|_| !elsewhere) {
                match word(letter) {
                    Some(w) => {
                        let of_callers =
                            row.means == Some(Meaning::Return) && !self.dialect.program.returns_within;
                        self.reference(base, w.value, w.start, w.end, of_callers);
                        known.push(w.start);
                    }
                    None if computed.contains(&letter) => {
                        self.doubt(&reason("by-variable").text("letter", char::from(letter)), None);
                    }
                    None => {}
                }
            }
            if row.means.is_some_and(Meaning::calls_macro)
                && let Some(p) = row.words.bytes().next().and_then(word)
            {
                self.found.calls.insert((self.scope, p.value));
                known.push(p.start);
            }
            if names_program {
                let packed = 10u32.checked_pow(self.dialect.program.packed_call_digits).filter(|p| *p > 1);
                // As the front-end takes them: the first letter names the program.
                if let Some(p) = row.words.bytes().next().and_then(word) {
                    let program = packed.filter(|by| p.value >= *by).map_or(p.value, |by| p.value % by);
                    self.found.calls.insert((self.scope, program));
                    known.push(p.start);
                }
                for letter in [b'Q', b'H'] {
                    let own = !elsewhere && row.blocks.as_bytes().contains(&letter);
                    if !own && (word(letter).is_some() || computed.contains(&letter)) {
                        self.doubt(&reason("call").text("letter", char::from(letter)), None);
                    }
                }
            }
        }
        let is_code = |w: &&Whole| matches!(w.letter, b'G' | b'M');
        let means: Vec<Option<Meaning>> =
            words.iter().filter(is_code).map(|w| row(w).and_then(|row| row.means)).collect();
        let strange = means.iter().any(Option::is_none)
            || pieces.windows(2).any(|p| p[0].text(line) == b"G" && p[1].text(line).contains(&b'.'));
        let uses_letters = means
            .iter()
            .flatten()
            .any(|m| m.calls_macro() || matches!(m, Meaning::StartCycle | Meaning::Pattern | Meaning::Call));
        for w in words {
            let row = self.dialect.address_row(w.letter);
            let number = self.dialect.block.number == Some(w.letter as char);
            let fixed = matches!(w.letter, b'G' | b'M' | b'O' | b'S' | b'T' | b'F')
                || row.is_some_and(|row| matches!(row.role, Role::Axis));
            let repeats = self.dialect.cycles.repeat == Some(w.letter as char);
            let refused = row.is_some_and(|row| row.refuse.is_some()) && !uses_letters && !repeats;
            if !number && !fixed && !known.contains(&w.start) && (strange || refused) {
                let word = format!("{}{}", char::from(w.letter), w.value);
                self.doubt(&reason("word").text("word", word), Some(w.value));
            }
        }
    }

    /// References in a block with names.
    fn names(&mut self, line: &[u8], base: usize, pieces: &[Piece], at: usize, numbered: bool) {
        let text = |at: usize| pieces.get(at).map_or(&b""[..], |p| p.text(line));
        let head = at + if numbered { 2 } else { 0 };
        if pieces.get(head).is_some_and(|p| p.kind == Kind::Name) && text(head + 1) == b":" {
            let label = String::from_utf8_lossy(text(head)).to_ascii_uppercase();
            self.found.labels.insert((self.scope, label));
        }
        for (at, piece) in pieces.iter().enumerate().skip(head) {
            let value = pieces.get(at + 1).and_then(|next| whole_number(next, line));
            let jumps = at > 0 && text(at - 1).starts_with(b"GOTO") && pieces[at - 1].kind == Kind::Key;
            if at == head && numbered && text(at) == b"N" {
                // Whichever of them is taken away, the other one is the block's.
                self.doubt(&reason("two-numbers"), None);
                continue;
            }
            let names_block = piece.kind == Kind::Address && text(at) == b"N" || jumps && text(at) == b":";
            match (piece.kind, value) {
                (_, Some(value)) if names_block => {
                    let next = &pieces[at + 1];
                    self.reference(base, value, next.start, next.end, false);
                }
                _ if names_block => self.doubt(&reason("computed-jump"), None),
                (Kind::Name, _) if jumps => {
                    let name = String::from_utf8_lossy(text(at)).to_ascii_uppercase();
                    self.found.named.push((self.scope, name, self.line));
                }
                _ if jumps => self.doubt(&reason("computed-jump"), None),
                (Kind::Name, _) if text(at) == b"EXECSTRING" => {
                    self.doubt(&reason("execstring"), None);
                }
                (Kind::Kept, _) => self.kept(text(at)),
                _ => {}
            }
        }
    }

    /// A text that may name blocks: `CYCLE95("N100:N200")`.
    fn kept(&mut self, text: &[u8]) {
        let capitals = text.to_ascii_uppercase();
        let quoted = text.first() == Some(&b'"');
        if !quoted && capitals.windows(4).any(|w| w == b"GOTO") {
            return self.doubt(&reason("action"), None);
        }
        for (at, _) in capitals.iter().enumerate().filter(|(_, b)| **b == b'N') {
            let digits = capitals[at + 1..].iter().take_while(|b| b.is_ascii_digit()).count();
            let digits = std::str::from_utf8(&capitals[at + 1..at + 1 + digits]).unwrap_or_default();
            if let Ok(value) = digits.parse() {
                self.doubt(&reason("in-text").text("word", format!("N{value}")), Some(value));
            }
        }
    }
}

/// The value of a number without a point.
fn whole_number(piece: &Piece, line: &[u8]) -> Option<u32> {
    let text = piece.text(line);
    let digits = (piece.kind == Kind::Number).then(|| std::str::from_utf8(text).ok()).flatten()?;
    digits.bytes().all(|b| b.is_ascii_digit()).then(|| digits.parse().ok()).flatten()
}
