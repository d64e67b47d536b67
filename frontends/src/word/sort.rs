//! Sorting of a block's words: codes, looked up in the dictionary and put in the order in which
//! their functions happen, and the other words by their letters.
//!
//! What must not stand together is refused here. Not here: what the words do.

use ncc_dialects::{AFTER_MOTION, CHANGE_IN_BLOCK, Meaning, Role};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::unsupported::{CodeUnsupported, Unsupported};

use super::block_words::{Code, Words};
use super::lower::Lower;
use super::text::block::Block;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::sort::{RANK_AFTER, rank};
use crate::common::words::{Value, Word};

impl Lower {
    /// Tells codes from other words, and finds what must not stand together.
    pub(super) fn sort_words<'b>(
        &mut self,
        block: &'b Block,
        codes: &mut Vec<Code>,
        words: &mut Words<'b>,
        src: Source,
        out: &mut Batch,
    ) {
        let dialect = self.settings.dialect;
        let number_letter = dialect.block.number.map_or(0, |c| c as u8);
        let mut counts = [0u8; 2];
        for (at, word) in block.words.iter().enumerate() {
            if word.value == Value::None && !dialect.block.omitted_zero {
                let letter = char::from(word.letter);
                self.fault(Fault::WordWithoutNumber { letter }, word.span, out);
                self.now.refused = true;
            }
            match word.letter {
                b'G' | b'M' => {
                    let m = usize::from(word.letter == b'M');
                    let known = codes.len();
                    let stated = self.stated_code(word, block, src, out);
                    self.code(at, stated.as_ref().unwrap_or(word), codes, src, out);
                    // The machine knows what is left out, and how many codes it takes with it.
                    if codes.get(known).is_some_and(|code| code.meaning == Meaning::LeftOut) {
                        continue;
                    }
                    counts[m] = counts[m].saturating_add(1);
                    let limit = if m == 1 { dialect.block.m_codes } else { dialect.block.g_codes };
                    if limit != 0 && counts[m] == limit + 1 {
                        let letter = char::from(word.letter);
                        self.fault(Fault::TooManyCodes { letter, limit }, word.span, out);
                    }
                }
                b'a'..=b'z' => self.comma_word(word, src, out),
                b'@' | b'^' => self.polar_sign(word, out),
                letter if letter == number_letter => {
                    if at > 0 && dialect.block.number_first {
                        self.fault(Fault::WordUnused { word: src.text(word.span) }, word.span, out);
                    }
                    if self.now.number.is_some() {
                        self.fault(Fault::WordTwice { letter: char::from(letter) }, word.span, out);
                    }
                    self.now.number = self.read_whole(word, src, out);
                }
                letter => {
                    let place = usize::from(letter.wrapping_sub(b'A'));
                    let Some(row) = self.letters.get(place).copied().flatten() else {
                        self.fault(Fault::UnknownCode { code: src.text(word.span) }, word.span, out);
                        continue;
                    };
                    if words.at[place] != 0 {
                        self.fault(Fault::WordTwice { letter: char::from(letter) }, word.span, out);
                    }
                    words.at[place] = (at + 1) as u16;
                    words.left |= 1 << place;
                    let reported = self.reported.letters >> place & 1 == 1;
                    if !row.sure && self.assume && !reported {
                        self.reported.letters |= 1 << place;
                        let meaning = role_name(row.role).into();
                        out.report(
                            Fault::AssumedRow { code: char::from(letter).to_string().into(), meaning },
                            word.span,
                        );
                    }
                }
            }
        }
        self.rotary_named |= words.left & self.roles.rotary;
        self.two_distances(block, codes, src, out);
        codes.sort_by_key(|c| self.rank(c));
    }

    /// When a code's function happens within its block, by this dialect.
    pub(super) fn rank(&self, code: &Code) -> u8 {
        match (code.meaning, self.settings.dialect.block.off_before_move) {
            (Meaning::MachineFunction(_), _) if code.row.after_move => rank(Meaning::CoolantOff),
            (Meaning::ChangeTool, _) if self.settings.get(CHANGE_IN_BLOCK) == AFTER_MOTION => RANK_AFTER,
            (Meaning::StopSpindleTurning, true) => rank(Meaning::StartSpindleClockwise),
            (Meaning::CoolantOff, true) => rank(Meaning::FloodOn),
            (meaning, _) => rank(meaning),
        }
    }

    /// Looks a code up.
    fn code(&mut self, at: usize, word: &Word, codes: &mut Vec<Code>, src: Source, out: &mut Batch) {
        let dialect = self.settings.dialect;
        if let Value::Computed(_) = word.value {
            if self.may_be_computed(word) {
                return;
            }
            self.now.refused = true;
            return self.fault(Fault::MacroLanguage { what: src.text(word.span) }, word.span, out);
        }
        let tenths = match word.value {
            Value::None => Some(0),
            Value::Number(d) if d.scale == 0 => d.mantissa.checked_mul(10),
            Value::Number(d) if d.scale == 1 => Some(d.mantissa),
            Value::Number(_) | Value::Computed(_) => None,
        };
        let tenths = tenths.and_then(|t| u32::try_from(t).ok());
        let Some(row) = tenths.and_then(|t| dialect.code_row(word.letter, t)) else {
            self.now.refused = true;
            return self.fault(Fault::UnknownCode { code: src.text(word.span) }, word.span, out);
        };
        if word.letter == b'M' && matches!(word.value, Value::Number(d) if d.point) {
            self.fault(Fault::PointNotAllowed { word: src.text(word.span) }, word.span, out);
        }
        let Some(meaning) = row.means else {
            self.now.refused = true;
            let cycles = dialect.code_for(Meaning::StartCycle).map(|row| row.group.as_str());
            self.now.cycle_refused |= cycles == Some(&row.group);
            let what = Unsupported::named(row.refuse.as_deref().unwrap_or_default());
            return self.fault(Fault::NotSupported { code: row.code.as_str().into(), what }, word.span, out);
        };
        let of_group = |c: &Code| !row.group.is_empty() && c.row.group == row.group;
        if row.passed_over && codes.iter().any(of_group) {
            return;
        }
        codes.retain(|c| !(c.row.passed_over && of_group(c)));
        let other = codes.iter().find(|c| of_group(c));
        if let Some(other) = other.filter(|_| !self.may_have_two_distances(meaning, codes)) {
            let fault = Fault::CodesExclude { first: src.text(other.span), second: src.text(word.span) };
            self.now.failed = true;
            out.diagnostics.push(Diagnostic { fault, span: word.span, related: vec![other.span] });
        }
        if !row.sure {
            self.assume_row(row, &meaning.to_string(), word.span, out);
        }
        codes.push(Code { row, meaning, span: word.span, at });
    }

    /// A skip mark amid the words counts for what follows it. That is taken only of M codes that
    /// stand for themselves; anything else would be a different block, not a shorter one.
    pub(super) fn check_tail(&mut self, block: &Block, codes: &[Code], out: &mut Batch) {
        let Some(tail) = block.tail else {
            return;
        };
        let words = block.words.get(tail..).unwrap_or_default();
        let calls = codes.iter().any(|c| matches!(c.meaning, Meaning::Call | Meaning::Return));
        if calls || words.iter().any(|w| w.letter != b'M') {
            let what = CodeUnsupported::SkipAmidWords.into();
            self.fault(Fault::NotSupported { code: "/".into(), what }, block.span, out);
        }
    }
}

fn role_name(role: Role) -> &'static str {
    match role {
        Role::Axis => "ROLE axis",
        Role::CentreX | Role::CentreY | Role::CentreZ => "ROLE centre",
        Role::Radius => "ROLE radius",
        Role::Feed => "ROLE feed",
        Role::Speed => "ROLE speed",
        Role::Tool => "ROLE tool",
        Role::LengthEntry => "ROLE length-entry",
        Role::Corrector => "ROLE corrector",
        Role::RadiusEntry => "ROLE radius-entry",
        Role::ToolEdge => "ROLE edge",
        Role::Call => "ROLE call",
        Role::Parameter => "ROLE parameter",
    }
}
