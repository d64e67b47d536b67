//! Lowering of calls by name and by number, of `MCALL`, `REPEAT` and `PROC`.
//!
//! The procedure of a subprogram `L12` is named `12`, so that it is the one that other controls call
//! by that number; `L012` is another subprogram and keeps its whole name, as all others do, in
//! capitals.
//!
//! A subprogram that is called after each move becomes a call after every block with motion. What it hands over is
//! computed from variables of the calling program, which do not change meanwhile, so that it is one thing when it is
//! computed.
//!
//! Refused: calls by path, calls while a subprogram is called after each move
//! (it would be called after the moves in them as well), and subprograms that leave an active cycle.

use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::{Expr as Value, Many, Node, Var};
use ncc_ir::program::{Attribute, Call, Move, Op, RepeatBlocks, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::left_out::LeftOut;
use ncc_ir::unsupported::{CallUnsupported, Unsupported};

use super::repeated_blocks::{NotRepeatable, Under};
use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::words::{Digits, Value as Number, Word};
use crate::initial_modes::report;
use crate::siemens::cycles::drilling::is_cycle;
use crate::siemens::lower::{Head, Lower};
use crate::siemens::siemens_state::{AfterMove, ModalCall, Motion, SiemensState};
use crate::siemens::text::tree::{Address, Called, Expr, Item, Parameter, Place, Value as Written};
use crate::siemens::text::unit::Kind;
use crate::siemens::values::typed::{Kind as Formed, Typed};

/// What a call hands over.
#[derive(Clone, Copy, Debug)]
pub(in crate::siemens) enum Handing<'h> {
    /// The arguments that are written.
    Written(&'h [Option<Expr>]),
    /// Those of a call after each move.
    AfterMove(&'h [Option<Typed>]),
}

/// Whether what stands after `MCALL` is a word such as `M9`.
fn is_word(name: &str) -> bool {
    matches!(name.as_bytes(), [letter, digit, ..] if *letter != b'L' && letter.is_ascii_alphabetic() && digit.is_ascii_digit())
}

/// Whether a value is computed from variables of the program at hand alone.
fn is_own(expr: &Value) -> bool {
    let own = match expr {
        Value::Num(_) => true,
        Value::Node(node) => match &**node {
            Node::Var(var) => matches!(var, Var::Local(_)),
            Node::Element(element) => matches!(&element.of, Many::Array { var: Var::Local(_), .. }),
            Node::Vacant | Node::Unary(..) | Node::Binary(..) | Node::Call(..) => true,
        },
    };
    own && expr.parts().all(is_own)
}

/// Most calls, or repetitions, by one word.
const MOST_TIMES: i64 = 9999;

/// Attributes of a subprogram, with what they say (Job planning, subprograms); of the others, which change only what is
/// shown and when it is made ready, nothing is kept.
const ATTRIBUTES: [(&str, Option<Attribute>); 8] = [
    ("SAVE", Some(Attribute::GivesBack)),
    ("SBLOF", Some(Attribute::RunsThrough)),
    ("SBLON", None),
    ("DISPLOF", Some(Attribute::NotShown)),
    ("DISPLON", None),
    ("ACTBLOCNO", None),
    ("PREPRO", None),
    ("ICYCOF", None),
];

/// The name of a subprogram's procedure, from its name in the text.
pub(in crate::siemens) fn procedure_name(name: &str) -> Text {
    let name = name.to_ascii_uppercase();
    let number = name.strip_prefix('L').filter(|number| {
        !number.is_empty() && !number.starts_with('0') && number.bytes().all(|b| b.is_ascii_digit())
    });
    match number {
        Some(number) => number.into(),
        None => name.into(),
    }
}

impl Lower {
    /// `L12`, `L012 P3`
    pub(in crate::siemens) fn call_number(
        &mut self,
        word: Span,
        before: &[Item],
        after: &[Item],
        src: Source,
        out: &mut Batch,
    ) {
        let text: String = src.text(word).chars().filter(|c| !matches!(c, ' ' | '\t' | '&')).collect();
        if !text[1..].bytes().all(|b| b.is_ascii_digit()) {
            return self.fault(Fault::OutOfRange { word: text.into() }, word, out);
        }
        self.call(&text, word, Handing::Written(&[]), [before, after], src, out);
    }

    /// A name that the dictionary has as a cycle or pattern, or does not have: a subprogram's.
    pub(in crate::siemens) fn call_name(
        &mut self,
        called: &Called,
        before: &[Item],
        after: &[Item],
        head: &Head,
        src: Source,
        out: &mut Batch,
    ) {
        let name = src.text(called.name).to_ascii_uppercase();
        let dialect = self.settings.dialect;
        let row = dialect.call_row(&name);
        let message = dialect.name_row(&name).is_some();
        if row.is_none() && !message {
            let arguments = called.arguments.as_deref().unwrap_or_default();
            return self.call(&name, called.span, Handing::Written(arguments), [before, after], src, out);
        }
        if !before.is_empty() || !after.is_empty() {
            return self.not_supported(&name, CallUnsupported::BesideWords, head.span, out);
        }
        match row {
            None if name == "SETAL" => self.alarm(called, src, out),
            None if self.is_word_with_arguments(&name) => self.word_with_arguments(&name, called, src, out),
            None => self.message(called, src, out),
            Some(row) if is_cycle(row.kind) => self.cycle(row, called, false, src, out),
            Some(row) => self.pattern(row, called, src, out),
        }
    }

    /// `CALL "NAME"`, `CALL "L"<<20`, and by a text variable whose text is known.
    pub(in crate::siemens) fn call_by_text(
        &mut self,
        name: &Expr,
        head: &Head,
        src: Source,
        out: &mut Batch,
    ) {
        if !self.is_text(name, src) {
            return self.refuse_word("CALL", head.span, out);
        }
        let Some(text) = self.known_text(name, src) else {
            return self.not_supported("CALL", CallUnsupported::UnknownText, head.span, out);
        };
        let name = &*text;
        let plain = name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
        if !plain || name.starts_with(|c: char| c.is_ascii_digit()) || name.is_empty() {
            return self.not_supported("CALL", CallUnsupported::ByPath, head.span, out);
        }
        self.call(name, head.span, Handing::Written(&[]), [&[], &[]], src, out);
    }

    /// `EXTCALL "NAME"`: a program from another memory of the control, called as any subprogram. Its name is that of the
    /// file, without folders and extension; of files of this machine it is known by the folders of called programs.
    pub(in crate::siemens) fn call_external(
        &mut self,
        file: &Expr,
        head: &Head,
        src: Source,
        out: &mut Batch,
    ) {
        if !self.is_text(file, src) {
            return self.refuse_word("EXTCALL", head.span, out);
        }
        let Some(text) = self.known_text(file, src) else {
            return self.not_supported("EXTCALL", CallUnsupported::UnknownText, head.span, out);
        };
        let name = program_in_file(&text);
        if name.is_empty() || name.starts_with(|c: char| c.is_ascii_digit()) {
            let what = CallUnsupported::FileName;
            return self.not_supported("EXTCALL", what, head.span, out);
        }
        self.call(&name, head.span, Handing::Written(&[]), [&[], &[]], src, out);
    }

    /// `MCALL`, alone or with a cycle.
    pub(in crate::siemens) fn call_modal(
        &mut self,
        called: Option<&Called>,
        head: &Head,
        src: Source,
        out: &mut Batch,
    ) {
        let Some(called) = called else {
            return self.end_cycle(head.span, src, out);
        };
        let name = src.text(called.name).to_ascii_uppercase();
        let dialect = self.settings.dialect;
        match (dialect.call_row(&name), dialect.name_row(&name)) {
            (Some(row), _) if is_cycle(row.kind) => self.cycle(row, called, true, src, out),
            (None, Some(row)) => {
                let refuse = row.refuse.as_deref().map_or(CallUnsupported::Modal.into(), Unsupported::named);
                self.not_supported(&name, refuse, called.span, out);
                self.state.cycle = ModalCall::Refused;
            }
            (Some(_), _) => self.not_supported(&name, CallUnsupported::ModalPattern, called.span, out),
            // A name begins with two letters, or an underline and one (PGsl, subprogram names); `L` alone has a number.
            (None, None) if is_word(&name) => {
                self.not_supported("MCALL", CallUnsupported::ModalWord, called.span, out);
                self.state.cycle = ModalCall::Refused;
            }
            (None, None) => self.call_modal_program(&name, called, src, out),
        }
    }

    /// `MCALL NAME`: of a subprogram, after each block with motion.
    fn call_modal_program(&mut self, name: &str, called: &Called, src: Source, out: &mut Batch) {
        let mut given = Vec::new();
        for argument in called.arguments.as_deref().unwrap_or_default() {
            given.push(match argument {
                None => None,
                Some(argument) => match self.formula(argument, src, out) {
                    Some(typed) => Some(typed),
                    None => {
                        self.state.cycle = ModalCall::Refused;
                        return;
                    }
                },
            });
        }
        let refuse = if given.iter().flatten().any(|typed| !is_own(&typed.expr)) {
            Some(CallUnsupported::ModalShared)
        } else if self.skipped() {
            Some(CallUnsupported::ModalSkipped)
        } else if matches!(self.state.cycle, ModalCall::Inherited { .. } | ModalCall::Lost { .. }) {
            Some(CallUnsupported::ModalInCycle)
        } else {
            None
        };
        self.repeated_blocks.say(super::repeated_blocks::CYCLE);
        if let Some(refuse) = refuse {
            self.not_supported(&src.text(called.span), refuse, called.span, out);
            self.state.cycle = ModalCall::Refused;
            return;
        }
        // A cycle that was active is off; the call itself says nothing.
        if matches!(self.state.cycle, ModalCall::Active(_)) {
            self.moved = None;
            self.push(called.span, Op::EndCycle, out);
        }
        self.now.heading = true;
        self.state.cycle = ModalCall::Subprogram(Box::new(AfterMove { name: name.into(), given }));
    }

    /// The call after a block with motion, as a block of its own.
    pub(in crate::siemens) fn call_after_move(
        &mut self,
        after: &AfterMove,
        block: Span,
        src: Source,
        out: &mut Batch,
    ) {
        self.apart();
        self.call(&after.name, block, Handing::AfterMove(&after.given), [&[], &[]], src, out);
    }

    /// A call of a subprogram by its name in the text.
    fn call(
        &mut self,
        written: &str,
        at: Span,
        given: Handing,
        [before, after]: [&[Item]; 2],
        src: Source,
        out: &mut Batch,
    ) {
        let written = written.to_ascii_uppercase();
        let name = &*procedure_name(&written);
        if self.leaves_call_out(name, at, out) {
            return;
        }
        let times = match (before, after) {
            ([], []) => Some(1),
            ([], [item]) => times(item),
            _ => None,
        };
        let Some((times, at)) = times.map(|t| (t, after.first().map_or(at, |item| at.to(item_span(item)))))
        else {
            // Two unknown words are no call of one with the other.
            if let Some(Item::Name(other)) = before.first().or(after.first()) {
                self.now.refused = true;
                return self.fault(Fault::UnknownCode { code: src.text(other.span) }, other.span, out);
            }
            return self.not_supported(&src.text(at), CallUnsupported::BesideWords, at, out);
        };
        if !(1..=MOST_TIMES).contains(&times) {
            return self.fault(Fault::OutOfRange { word: src.text(at).into() }, at, out);
        }
        let own_feed = self.state.cycle.own_feed();
        let under = match &self.state.cycle {
            ModalCall::None | ModalCall::Refused => Under::Nothing,
            ModalCall::Active(_) | ModalCall::Inherited { .. } => Under::Cycle { own_feed },
            ModalCall::Lost { .. } => Under::Either { own_feed },
            ModalCall::Subprogram(_) => {
                let what = CallUnsupported::WhileModal;
                return self.not_supported(&src.text(at), what, at, out);
            }
        };
        let drills = matches!(under, Under::Cycle { .. });
        self.repeated_blocks.use_fact(super::repeated_blocks::CYCLE);
        if drills {
            self.repeated_blocks.use_fact(super::repeated_blocks::MOTION);
            match self.state.modes.motion.value() {
                Some(Motion::Traverse) => {}
                None if matches!(self.state.cycle, ModalCall::Inherited { .. }) => {}
                None => self.take_rapid(at, out),
                Some(_) => {
                    let what = CallUnsupported::UnderCycleMotion;
                    return self.not_supported(&src.text(at), what, at, out);
                }
            }
        } else {
            self.hand_motion_on(at, out);
        }
        if !self.repeated_blocks.call(name, &written, at, under) {
            let what = CallUnsupported::UnderOtherCycle;
            return self.not_supported(&src.text(at), what, at, out);
        }
        // What a subprogram finds active that nothing has said is not what the text says.
        self.as_it_begins(out);
        out.whole = true;
        let times = times as u32;
        self.no_stale_offset(at, out);
        let Some(arguments) = self.handed_over(name, given, at, src, out) else { return };
        self.inherited.call(Some(name.into()), self.state.modes.unsaid());
        self.motion_goes_on(&[self.state.modes.motion], out);
        self.push(at, Op::Call(Box::new(Call { name: name.into(), times, arguments, shared: false })), out);
        // A subprogram leaves the cycle as it found it, and under one makes no other moves than G0.
        let cycle = std::mem::take(&mut self.state.cycle);
        let motion = self.state.modes.motion;
        self.state = self.state.after_call(cycle);
        if drills {
            self.state.modes.motion = motion;
        }
        if own_feed {
            self.state.modes.feed = Know::Unsaid;
        }
        self.stand.forget();
        self.moved = None;
        self.cycled = false;
    }

    /// Whether a call is left out, as the user states of the program that it names; reported once for each.
    fn leaves_call_out(&mut self, name: &str, at: Span, out: &mut Batch) -> bool {
        let names = &self.settings.dialect.program.calls_left_out;
        let Some(own) = names.iter().find(|own| own.eq_ignore_ascii_case(name)) else { return false };
        if self.first_time(own) {
            out.report(Fault::CodeLeftOut { what: LeftOut::Call { name: name.into() } }, at);
        }
        true
    }

    /// A subprogram's position finds the motion of the last move: one that was only said is made a
    /// statement.
    fn hand_motion_on(&mut self, at: Span, out: &mut Batch) {
        let motion = self.state.modes.motion.value();
        if motion == self.moved {
            return;
        }
        self.repeated_blocks.use_fact(super::repeated_blocks::MOTION);
        let nowhere = Move { said: true, ..Move::default() };
        match motion {
            Some(Motion::Traverse) => self.push(at, Op::StraightTraverse(nowhere), out),
            Some(Motion::Feed) => self.push(at, Op::StraightFeed(nowhere), out),
            Some(Motion::Arc(_) | Motion::Through | Motion::Tangent | Motion::Thread(_)) | None => {}
        }
    }

    /// The subprogram that is read returns to its caller.
    pub(in crate::siemens) fn leave(&mut self, at: Span, out: &mut Batch) {
        self.motion_goes_on(&[self.state.modes.motion], out);
        if self.state.cycle != self.entry && self.state.cycle != ModalCall::Refused {
            let what = CallUnsupported::CycleLeft;
            return self.not_supported("MCALL", what, at, out);
        }
        // A caller's move that misses the feed of another way of counting is refused where it is executed.
        let unsaid = self.state.modes.feed == Know::Unsaid && !self.state.spent;
        if unsaid && !self.entry.own_feed() && !self.watch {
            self.fault(Fault::NoFeed, at, out);
        }
    }

    /// `REPEAT FIRST LAST P=3`
    pub(in crate::siemens) fn repeat(
        &mut self,
        first: Span,
        last: Option<Span>,
        count: Option<&Expr>,
        head: &Head,
        src: Source,
        out: &mut Batch,
    ) {
        let upper = |span: Span| -> Text { src.text(span).to_ascii_uppercase().into() };
        let times = match count {
            None => Some(Value::int(1)),
            Some(Expr::Number(digits, _)) => {
                whole_digits(*digits).filter(|t| (1..=MOST_TIMES).contains(t)).map(Value::int)
            }
            Some(other) => {
                let Some(typed) = self.formula(other, src, out) else { return };
                let known =
                    typed.expr.literal().is_some() || matches!(typed.kind, Formed::Text | Formed::Bool);
                // Nothing found says what the control does with other numbers.
                out.report(Fault::AssumedFact { fact: ControlFact::RepeatCount }, other.span());
                Some(typed.expr).filter(|_| !known)
            }
        };
        let Some(times) = times else {
            return self.fault(Fault::OutOfRange { word: src.text(head.span).into() }, head.span, out);
        };
        let (from, mut to) = (upper(first), last.map(upper));
        for (name, span) in [Some((&from, first)), to.as_ref().zip(last)].into_iter().flatten() {
            if !self.repeated_blocks.has_label(name) {
                return self.fault(Fault::LabelUnknown { name: name.clone() }, span, out);
            }
        }
        if to.is_none() {
            to = self.repeated_blocks.end_behind(&from);
        }
        let several = times != Value::int(1);
        match self.repeated_blocks.repeat(&from, to.as_deref(), several, &mut self.state) {
            Ok(()) => {}
            Err(NotRepeatable::Unknown) => {
                return self.fault(Fault::LabelUnknown { name: to.unwrap_or(from) }, head.span, out);
            }
            Err(NotRepeatable::Differs) => {
                let what = CallUnsupported::RepeatDiffers;
                return self.not_supported("REPEAT", what, head.span, out);
            }
        }
        out.whole = true;
        self.push(head.span, Op::RepeatBlocks(Box::new(RepeatBlocks { from, to, times })), out);
        self.stand.forget();
        self.moved = None;
    }

    /// `PROC NAME` at the head of a subprogram.
    pub(in crate::siemens) fn procedure(
        &mut self,
        name: Span,
        parameters: &[Parameter],
        attributes: &[Span],
        src: Source,
        out: &mut Batch,
    ) {
        self.now.heading = true;
        self.parameters(parameters, name, src, out);
        for &attribute in attributes {
            let name = src.text(attribute).to_ascii_uppercase();
            let Some((_, own)) = ATTRIBUTES.iter().find(|(own, _)| *own == name) else {
                self.not_supported(&name, CallUnsupported::Attribute, attribute, out);
                continue;
            };
            match (own, &mut self.sub) {
                (Some(own), Some(procedure)) if procedure.attributes.contains(own) => {}
                (Some(own), Some(procedure)) => procedure.attributes.push(*own),
                // Of a program by itself the heading is not kept.
                (Some(Attribute::GivesBack), None) => {
                    self.not_supported(&name, CallUnsupported::Attribute, attribute, out);
                }
                (Some(Attribute::RunsThrough | Attribute::NotShown), None) => {
                    out.report(Fault::AdviceLeftOut { kind: name.into() }, attribute);
                }
                (None, _) => {}
            }
        }
        if self.sub.is_none() {
            self.unit = Some(Kind::Sub);
            out.whole = true;
        }
    }

    /// The text of a subprogram begins.
    pub(in crate::siemens) fn enter(&mut self, name: &Text, at: Span, out: &mut Batch) {
        let entry = self.repeated_blocks.enter(name);
        if entry.is_none() {
            out.report(Fault::ProgramTwice { name: name.clone() }, at);
        }
        self.entry = entry.unwrap_or_default();
        self.state = SiemensState::called(self.entry.clone());
        self.inherited.enter(name.clone());
        self.variables.clear();
        self.executed = false;
        self.stand.forget();
        self.moved = None;
        self.cycled = false;
        (self.recall, self.idle_tap) = (false, false);
        self.rounding = None;
        self.ended = false;
        self.refresh();
    }

    /// What is called runs under what the text has not said: as the program begins, where that is assumed.
    fn as_it_begins(&mut self, out: &mut Batch) {
        let power_on = &self.settings.dialect.power_on;
        let (units, plane) = (self.state.modes.units, self.state.modes.plane);
        let unit = power_on.units.as_ref().map(|row| row.value.into()).filter(|_| self.assume);
        let own = power_on.plane.as_ref().map(|row| row.value.into()).filter(|_| self.assume);
        let units = units.unsaid().then(|| self.only_units.see_or_open(unit)).flatten();
        let plane = plane.unsaid().then(|| self.only_plane.see_or_open(own)).flatten();
        let relied = [(ModeName::Units, units), (ModeName::Plane, plane)];
        for (fact, at) in relied.into_iter().filter_map(|(fact, at)| Some((fact, at?))) {
            out.report(Fault::EntryFactNeeded { fact }, at);
        }
    }

    /// Under a cycle, positions are taken for rapid where the active motion is not known.
    pub(in crate::siemens) fn take_rapid(&mut self, at: Span, out: &mut Batch) {
        if self.state.modes.motion == Know::Unsaid && self.motion(at, out).is_ok_and(|m| m.is_some()) {
            return;
        }
        if self.state.modes.motion != Know::Unsaid {
            if self.feed_away {
                // It is reported once.
                self.state.modes.motion = Know::Taken(Motion::Traverse);
                return self.refuse_rapid(at, out);
            }
            self.rapid_taken.get_or_insert(at);
        }
        if self.first_time("rapid under a cycle") {
            report(out, at, ModeName::Motion, Some("rapid"));
        }
        self.state.modes.motion = Know::Taken(Motion::Traverse);
    }

    /// Control goes elsewhere with such an active motion: what is taken for rapid there may be none.
    pub(in crate::siemens) fn motion_goes_on(&mut self, motions: &[Know<Motion>], out: &mut Batch) {
        let at_feed = |motion: &Know<Motion>| motion.value().is_some_and(|motion| motion != Motion::Traverse);
        if motions.iter().any(at_feed) {
            self.feed_away = true;
            if let Some(at) = self.rapid_taken.take() {
                self.refuse_rapid(at, out);
            }
        }
    }

    fn refuse_rapid(&mut self, at: Span, out: &mut Batch) {
        self.not_supported("MCALL", CallUnsupported::FirstPosition, at, out);
    }
}

/// The count of a call: `P3`, `P=3`.
fn times(item: &Item) -> Option<i64> {
    match item {
        Item::Word(Word { letter: b'P', value: Number::Number(digits), .. }) => whole_digits(*digits),
        Item::Set {
            place: Place { address: Address::Letter(b'P'), extension: None, index, .. },
            value: Written::Expr(Expr::Number(digits, _)),
            ..
        } if index.is_empty() => whole_digits(*digits),
        Item::Word(_) | Item::Set { .. } | Item::Name(_) => None,
    }
}

fn whole_digits(digits: Digits) -> Option<i64> {
    (digits.scale == 0).then_some(digits.mantissa)
}

fn item_span(item: &Item) -> Span {
    match item {
        Item::Word(word) => word.span,
        Item::Set { span, .. } => *span,
        Item::Name(called) => called.span,
    }
}

/// The program that a file holds by its name: without folders, extension, and the marks of a transfer; what is no
/// letter, digit or underscore is an underscore.
fn program_in_file(path: &str) -> String {
    let file = path.rsplit(['/', '\\', ':']).next().unwrap_or_default().trim().to_ascii_uppercase();
    let file = match file.rsplit_once(['.', '_']) {
        Some((stem, "SPF" | "MPF")) => stem,
        _ => &file,
    };
    let name = file.strip_prefix("_N_").unwrap_or(file);
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect()
}
