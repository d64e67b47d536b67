//! Lowering of cutter radius compensation: side, and the entry of the table that has the radius.
//!
//! Where a dialect supports the entry, it stands in the block or stays active from an earlier one, also where
//! its number is computed, until a variable that it is computed from is set; where the code's row says so, it is the
//! tool's own without that word, which then never stays. A dialect without such a word takes the radius that belongs to
//! the active length. Codes of their own have the tool's diameter in that word. Not here: what controls refuse under
//! compensation; that is execution's.

use ncc_dialects::{BesideCompensation, Meaning, NO_RADIUS, Quantity, RADIUS_UNSAID};
use ncc_ir::canon::Side;
use ncc_ir::compensated::kind::CompensationRefusal;
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Expr, Node, Var};
use ncc_ir::program::{CutterRadius, Op};
use ncc_ir::unsupported::MoveUnsupported;
use ncc_ir::unsupported::left_out::LeftOut;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::words::{Value, Word};
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;

impl Lower {
    /// Switches compensation on, and notes the entry that a word names.
    pub(in crate::word) fn compensation(
        &mut self,
        codes: &[Code],
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let start = codes.iter().find_map(|code| match code.meaning {
            Meaning::StartCutterRadiusCompensation(side) => Some((code, side, false)),
            Meaning::StartCompensationByDiameter(side) => Some((code, side, true)),
            _ => None,
        });
        let letter = self.roles.radius_entry;
        let Some((code, side, stated)) = start else { return self.radius_alone(codes, words, src, out) };
        self.set_mode(code.meaning, out);
        // The contour lies in the plane that is active here.
        self.plane(code.span, out);
        if let Some(word) = words.get(letter) {
            self.names_radius(&word, src, out);
        }
        if stated {
            return self.by_diameter(code, side, words, src, out);
        }
        let own_tool = |word: &Word| {
            let zero = matches!(word.value, Value::Number(digits) if digits.mantissa == 0);
            zero && code.row.own_tool
        };
        let radius = match words.take(letter) {
            // Its D0 is no entry, but the tool in the spindle.
            Some(word) if own_tool(&word) => CutterRadius::Tool,
            Some(word) => match self.entry(&word, words, src, out) {
                Some(entry) => {
                    self.state.radius_entry = kept(&entry);
                    CutterRadius::Entry(entry)
                }
                None => return,
            },
            None if letter == 0 => CutterRadius::InForce,
            None if code.row.own_tool => CutterRadius::Tool,
            None if self.goes_without(code, out) => return,
            None => match &self.state.radius_entry {
                Know::Said(entry) | Know::Taken(entry) => CutterRadius::Entry(entry.clone()),
                Know::Lost => {
                    let what = MoveUnsupported::RadiusEntryOfBefore { letter: char::from(letter) };
                    let code_text = code.row.code.as_str().into();
                    return self.fault(
                        Fault::NotSupported { code: code_text, what: what.into() },
                        code.span,
                        out,
                    );
                }
                Know::Unsaid | Know::Open | Know::Callers => {
                    let (code_text, word) =
                        (code.row.code.as_str().into(), char::from(letter).to_string().into());
                    return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
                }
            },
        };
        self.push(code.span, Op::StartCutterRadiusCompensation { side, radius }, out);
    }

    /// Whether a code of compensation without its entry compensates nothing, as the user states of the control. Where
    /// something may have been before, no entry is named in the whole text.
    fn goes_without(&mut self, code: &Code, out: &mut Batch) -> bool {
        let may_be_named = match self.state.radius_entry {
            Know::Said(_) | Know::Taken(_) => return false,
            Know::Unsaid => false,
            Know::Lost | Know::Open | Know::Callers => true,
        };
        if may_be_named && self.radius.named || self.settings.get(RADIUS_UNSAID) != NO_RADIUS {
            return false;
        }
        if may_be_named {
            self.radius.none_named = true;
        }
        if self.assume && !std::mem::replace(&mut self.radius.reported, true) {
            let letter = char::from(self.roles.radius_entry);
            let what = LeftOut::WithoutLetter { code: code.row.code.as_str().into(), letter };
            out.report(Fault::CodeLeftOut { what }, code.span);
        }
        true
    }

    /// Notes the entry of a radius. It is refused where the text before it was read as one without.
    fn names_radius(&mut self, word: &Word, src: Source, out: &mut Batch) {
        self.radius.named = true;
        if self.radius.none_named {
            let what = MoveUnsupported::RadiusAfterNone.into();
            self.fault(Fault::NotSupported { code: src.text(word.span), what }, word.span, out);
        }
    }

    /// Refuses a code that the control does not take while compensation is on, as far as the text says that it is.
    pub(in crate::word) fn refused_under_compensation(&mut self, codes: &[Code], out: &mut Batch) {
        let on = self.state.compensated == Know::Said(true);
        let has = |start: bool| {
            codes.iter().any(|code| match code.meaning {
                Meaning::StartCutterRadiusCompensation(_) | Meaning::StartCompensationByDiameter(_) => start,
                Meaning::StopCutterRadiusCompensation => !start,
                _ => false,
            })
        };
        let stops = |code: &&Code| match code.row.refused_under_compensation {
            Some(BesideCompensation::Before) => on,
            Some(BesideCompensation::After) => on && !has(false) || has(true),
            None => false,
        };
        if let Some(code) = codes.iter().find(stops) {
            self.now.refused = true;
            let what = CompensationRefusal::Code { code: code.row.code.as_str().into() };
            self.fault(Fault::RefusedCompensated { what }, code.span, out);
        }
    }

    /// Compensation by a diameter that the block states.
    fn by_diameter(&mut self, code: &Code, side: Side, words: &mut Words, src: Source, out: &mut Batch) {
        let letter = self.roles.radius_entry;
        let Some(word) = words.take(letter) else {
            let (code_text, word) = (code.row.code.as_str().into(), char::from(letter).to_string().into());
            return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
        };
        if let Some(diameter) = self.amount(&word, Quantity::Length, words, src, out) {
            let radius = CutterRadius::Diameter(diameter);
            self.push(code.span, Op::StartCutterRadiusCompensation { side, radius }, out);
        }
    }

    /// The word of an entry in a block that does not switch compensation on: it counts for the next one
    /// that does. While it is on, or where that is not known, another radius is refused.
    fn radius_alone(&mut self, codes: &[Code], words: &mut Words, src: Source, out: &mut Batch) {
        let letter = self.roles.radius_entry;
        let Some(word) = words.get(letter) else { return };
        let starts = self.settings.dialect.code.iter();
        let mut starts =
            starts.filter(|r| matches!(r.means, Some(Meaning::StartCutterRadiusCompensation(_))));
        let stays = starts.next().is_some_and(|row| !row.own_tool);
        // A word of a cycle or a call by the same letter is theirs.
        let others = codes.iter().any(|code| code.row.words.bytes().any(|own| own == letter));
        if !stays || others {
            return;
        }
        // At the start of a program it is off.
        let off = matches!(self.state.compensated, Know::Unsaid | Know::Said(false));
        if !off {
            let what = MoveUnsupported::RadiusInCompensation.into();
            return self.fault(Fault::NotSupported { code: src.text(word.span), what }, word.span, out);
        }
        self.names_radius(&word, src, out);
        let _ = words.take(letter);
        if let Some(entry) = self.entry(&word, words, src, out) {
            self.state.radius_entry = kept(&entry);
        }
    }

    /// A variable is set: the entry whose number was computed from it is that of the old value.
    pub(in crate::word) fn entry_changes(&mut self, reads: impl Fn(&Expr) -> bool) {
        if matches!(&self.state.radius_entry, Know::Said(entry) if reads(entry)) {
            self.state.radius_entry = Know::Lost;
        }
    }
}

/// The entry as it stays active: one that is computed from what the control tells may be another one later.
fn kept(entry: &Expr) -> Know<Expr> {
    let asks = |node: &Node| matches!(node, Node::Var(Var::System(_)));
    if entry.has(&asks) { Know::Lost } else { Know::Said(entry.clone()) }
}
