//! Programs, labels, loops and variables of a text, by the pieces of its lines.

use std::collections::BTreeSet;

use ncc_dialects::{Dialect, Family, Meaning, Settings};
use ncc_frontends::pieces::{LineIs, Lines, Piece, PieceKind as Kind};

use super::{All, Doubt, Place, Sort};
use crate::fmt::references::{Found, reason};

/// Looks through a text of which the blocks are known.
pub(super) fn find(settings: &Settings, text: &[u8], found: &Found) -> All {
    let dialect = settings.dialect;
    let mut look = Look {
        dialect,
        sinumerik: dialect.family == Family::Sinumerik,
        all: All::default(),
        scope: 0,
        local: 0,
        line: 0,
        base: 0,
        loops: Vec::new(),
        opened: 0,
        declared: BTreeSet::new(),
        units: BTreeSet::new(),
    };
    look.units(text);
    let (mut lines, mut pieces) = (Lines::new(settings.clone()), Vec::new());
    let mut blocks = found.blocks.iter().peekable();
    for whole in text.split_inclusive(|byte| *byte == b'\n') {
        look.line += 1;
        let line = whole.trim_ascii_end();
        let is = lines.line(line, &mut pieces);
        while let Some(block) = blocks.next_if(|block| block.line <= look.line) {
            look.scope = block.scope;
        }
        match is {
            LineIs::Blocks => {
                let own: Vec<Piece> =
                    pieces.iter().copied().filter(|one| one.kind != Kind::Comment).collect();
                for block in own.split(|piece| piece.kind == Kind::End) {
                    look.block(line, block);
                }
            }
            LineIs::Frame if look.sinumerik => look.unit(line),
            LineIs::Frame | LineIs::Outside => {}
            LineIs::Unread => look.doubt_all("unread"),
        }
        look.base += whole.len();
    }
    look.all
}

struct Look<'d> {
    dialect: &'d Dialect,
    sinumerik: bool,
    all: All,
    /// The program in hand, as `fmt` counts them.
    scope: usize,
    /// The subprogram in hand of a control with O words; 0 is none.
    local: usize,
    line: u32,
    /// Where the line begins.
    base: usize,
    /// Loops that are open: their numbers, and which they are.
    loops: Vec<(String, usize)>,
    opened: usize,
    /// Names of variables that the program in hand declares.
    declared: BTreeSet<String>,
    /// Names of the units of the text.
    units: BTreeSet<String>,
}

/// The name of a unit in its heading, `%_N_NAME_MPF`, and where it stands there.
fn unit_name(line: &[u8]) -> Option<(usize, &str)> {
    let line = std::str::from_utf8(line).ok()?;
    let name = line.strip_prefix("%_N_")?;
    let end = name.rfind('_').unwrap_or(name.len());
    Some((4, &name[..end])).filter(|(_, name)| !name.is_empty())
}

impl<'d> Look<'d> {
    fn doubt(&mut self, sort: Sort, form: &'static str) {
        self.all.doubts.push(Doubt { sort, what: reason(form).headline() });
    }

    fn doubt_all(&mut self, form: &'static str) {
        for sort in [Sort::Label, Sort::Program, Sort::Loop, Sort::Variable] {
            self.doubt(sort, form);
        }
    }

    fn put(&mut self, sort: Sort, scope: Option<usize>, text: &str, at: (usize, usize), defines: bool) {
        let range = self.base + at.0..self.base + at.1;
        self.all.put(sort, scope, text, Place { range, line: self.line, defines });
    }

    fn units(&mut self, text: &[u8]) {
        let lines = text.split(|byte| *byte == b'\n').filter(|_| self.sinumerik);
        self.units =
            lines.filter_map(|line| Some(unit_name(line.trim_ascii_end())?.1.to_ascii_uppercase())).collect();
    }

    fn unit(&mut self, line: &[u8]) {
        self.declared.clear();
        if let Some((start, name)) = unit_name(line) {
            self.put(Sort::Program, None, name, (start, start + name.len()), true);
        }
    }

    fn block(&mut self, line: &[u8], pieces: &[Piece]) {
        let text = |at: usize| {
            pieces.get(at).map_or("", |piece| std::str::from_utf8(piece.text(line)).unwrap_or(""))
        };
        let kind = |at: usize| pieces.get(at).map(|piece| piece.kind);
        match self.sinumerik {
            true => self.names(line, pieces),
            false if self.dialect.program.o_words => self.o_word(line, pieces),
            false => self.programs(line, pieces),
        }
        for at in 0..pieces.len() {
            if !self.sinumerik && text(at) == "#" {
                let own = &pieces[at..pieces.len().min(at + 2)];
                let defines =
                    text(at + 2) == "=" && at.checked_sub(1).is_none_or(|before| text(before) != "[");
                match kind(at + 1) {
                    Some(Kind::Number) => self.variable(text(at + 1), (own[1].start, own[1].end), defines),
                    Some(Kind::Kept | Kind::Name) => {
                        let (start, end) = (own[1].start, own[1].end);
                        let inner = usize::from(text(at + 1).starts_with('<'));
                        let name = text(at + 1).trim_matches(['<', '>']);
                        // A name with `_` in front is seen by all programs.
                        let scope = if name.starts_with('_') { None } else { Some(self.local) };
                        self.put(Sort::Variable, scope, name, (start + inner, end - inner), defines);
                    }
                    _ => self.doubt(Sort::Variable, "computed-variable"),
                }
            }
            if !self.sinumerik && kind(at) == Some(Kind::Key) && kind(at + 1) == Some(Kind::Number) {
                let number = &pieces[at + 1];
                self.fanuc_loop(text(at), text(at + 1), (number.start, number.end));
            }
        }
    }

    /// A variable with a number: local ones are those of their program.
    fn variable(&mut self, number: &str, at: (usize, usize), defines: bool) {
        let number = number.trim_start_matches('0');
        let within = |ranges: &[[u32; 2]]| {
            number
                .parse::<u32>()
                .is_ok_and(|own| ranges.iter().any(|[from, to]| (*from..=*to).contains(&own)))
        };
        let local = within(&self.dialect.formula.local);
        let scope = if self.dialect.program.o_words { self.local } else { self.scope };
        self.put(Sort::Variable, local.then_some(scope), number, at, defines);
    }

    /// `DO 1` and the `END 1` that belongs to it.
    fn fanuc_loop(&mut self, key: &str, number: &str, at: (usize, usize)) {
        match key {
            "DO" => {
                self.opened += 1;
                self.loops.push((number.to_owned(), self.opened));
                self.put(Sort::Loop, Some(self.opened), number, at, true);
            }
            "END" => {
                let open = self.loops.iter().rposition(|(own, _)| own == number);
                if let Some((_, which)) = open.map(|open| self.loops.remove(open)) {
                    self.put(Sort::Loop, Some(which), number, at, false);
                }
            }
            _ => {}
        }
    }

    /// Programs by their numbers: `O1000`, `M98 P1000`, `G65 P1000`.
    fn programs(&mut self, line: &[u8], pieces: &[Piece]) {
        let text = |at: usize| pieces.get(at).map_or(&b""[..], |piece| piece.text(line));
        let rules = &self.dialect.program;
        let is = |own: Option<char>| own.is_some_and(|own| text(0) == [own as u8]);
        let value = |at: usize| {
            let own = pieces.get(at).filter(|piece| piece.kind == Kind::Number)?;
            Some((std::str::from_utf8(own.text(line)).ok()?, (own.start, own.end)))
        };
        if is(rules.number) || is(rules.number_also) {
            if let Some((number, at)) = value(1) {
                self.put(Sort::Program, None, number.trim_start_matches('0'), at, true);
            }
            return;
        }
        for (at, piece) in pieces.iter().enumerate().filter(|(_, piece)| piece.kind == Kind::Address) {
            let Some((code, _)) = value(at + 1).filter(|_| matches!(piece.text(line), b"G" | b"M")) else {
                continue;
            };
            let Ok(tenths) = code.parse::<f64>().map(|code| (code * 10.0).round() as u32) else { continue };
            let Some(row) = self.dialect.code_row(piece.text(line)[0], tenths) else { continue };
            let letter = row.words.bytes().next();
            let calls = row.means.is_some_and(|means| means == Meaning::Call || means.calls_macro());
            if !calls || letter.is_some_and(|letter| row.blocks.as_bytes().contains(&letter)) {
                continue;
            }
            let named = pieces.iter().position(|one| {
                one.kind == Kind::Address && letter.is_some_and(|own| one.text(line) == [own])
            });
            let Some(named) = named else { continue };
            match value(named + 1) {
                Some((number, at)) => {
                    // The last digits name the program where the first say how often.
                    let digits = self.dialect.program.packed_call_digits as usize;
                    let skip = if digits > 0 { number.len().saturating_sub(digits) } else { 0 };
                    let number = number[skip..].trim_start_matches('0').to_owned();
                    self.put(Sort::Program, None, &number, (at.0 + skip, at.1), false);
                }
                None => self.doubt(Sort::Program, "computed-call"),
            }
        }
    }

    /// Subprograms, loops and branches of O words: each word says which by its number or name.
    fn o_word(&mut self, line: &[u8], pieces: &[Piece]) {
        let Some(at) = pieces.iter().position(|piece| piece.text(line).eq_ignore_ascii_case(b"o")) else {
            return self.programs(line, pieces);
        };
        let (Some(name), Some(key)) = (pieces.get(at + 1), pieces.get(at + 2)) else {
            return self.programs(line, pieces);
        };
        let word = String::from_utf8_lossy(key.text(line)).to_ascii_lowercase();
        let text = String::from_utf8_lossy(name.text(line)).into_owned();
        let inner = usize::from(text.starts_with('<'));
        match name.kind {
            Kind::Number | Kind::Kept | Kind::Name => {}
            _ => return self.doubt(Sort::Program, "computed-call"),
        }
        let of_sub = matches!(word.as_str(), "sub" | "endsub" | "call" | "return");
        let defines = matches!(word.as_str(), "sub" | "while" | "do" | "if" | "repeat");
        let sort = if of_sub { Sort::Program } else { Sort::Loop };
        if word == "sub" {
            self.opened += 1;
            self.local = self.opened;
        }
        self.put(sort, None, text.trim_matches(['<', '>']), (name.start + inner, name.end - inner), defines);
        if word == "endsub" {
            self.local = 0;
        }
    }

    /// Labels, calls and variables of a Sinumerik.
    fn names(&mut self, line: &[u8], pieces: &[Piece]) {
        let text = |at: usize| pieces.get(at).map_or(&b""[..], |piece| piece.text(line));
        let upper = |at: usize| String::from_utf8_lossy(text(at)).to_ascii_uppercase();
        let scope = Some(self.scope);
        let at_of = |piece: &Piece| (piece.start, piece.end);
        let declares = text(0).eq_ignore_ascii_case(b"DEF");
        if declares {
            let mut depth = 0;
            for (at, piece) in pieces.iter().enumerate().skip(1) {
                depth +=
                    i32::from(matches!(text(at), b"(" | b"[")) - i32::from(matches!(text(at), b")" | b"]"));
                let before = &pieces[at - 1];
                let opens = matches!(before.kind, Kind::Key)
                    || before.text(line) == b","
                    || before.text(line) == b"]";
                if piece.kind == Kind::Name && depth == 0 && opens {
                    self.declared.insert(upper(at));
                }
            }
        }
        for (at, piece) in pieces.iter().enumerate() {
            let before = at.checked_sub(1).map_or(&b""[..], text);
            let jumps = before.len() >= 4 && before[..4].eq_ignore_ascii_case(b"GOTO");
            match piece.kind {
                Kind::Name if text(at + 1) == b":" && at <= 2 => {
                    self.put(Sort::Label, scope, &upper(at), at_of(piece), true)
                }
                Kind::Name if jumps => self.put(Sort::Label, scope, &upper(at), at_of(piece), false),
                Kind::Name if self.declared.contains(&upper(at)) => {
                    let defines = text(at + 1) == b"=" || declares;
                    self.put(Sort::Variable, scope, &upper(at), at_of(piece), defines);
                }
                Kind::Name if self.units.contains(&upper(at)) => {
                    let heading = before.eq_ignore_ascii_case(b"PROC");
                    self.put(Sort::Program, None, &upper(at), at_of(piece), heading);
                }
                Kind::Name if text(at).eq_ignore_ascii_case(b"EXECSTRING") => self.doubt_all("execstring"),
                Kind::Address if text(at).eq_ignore_ascii_case(b"L") => {
                    let name = format!("L{}", String::from_utf8_lossy(text(at + 1)));
                    if self.units.contains(&name) && text(at + 1).iter().all(u8::is_ascii_digit) {
                        self.put(Sort::Program, None, &name, (piece.start, pieces[at + 1].end), false);
                    }
                }
                Kind::Address | Kind::Letter if text(at).eq_ignore_ascii_case(b"R") => {
                    match pieces.get(at + 1).filter(|next| next.kind == Kind::Number) {
                        Some(number) => {
                            let name = format!("R{}", String::from_utf8_lossy(number.text(line)));
                            self.put(
                                Sort::Variable,
                                None,
                                &name,
                                (piece.start, number.end),
                                text(at + 2) == b"=",
                            );
                        }
                        None => self.doubt(Sort::Variable, "computed-variable"),
                    }
                }
                Kind::Kept => self.kept(text(at)),
                _ => {}
            }
        }
    }

    /// A text may name anything where it is no message, and an action names what it likes.
    fn kept(&mut self, text: &[u8]) {
        if text.first() != Some(&b'"') {
            self.doubt_all("action");
        }
    }
}
