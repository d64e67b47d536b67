//! Reader of the canonical stream: one call a line, after NIST (Proctor, Kramer & Michaloski 1997;
//! Kramer & Proctor 1998) in the print of the case study.
//!
//! ```text
//! COMMENT("text")  MESSAGE("text")
//! USE_LENGTH_UNITS(CANON_UNITS_MM | CANON_UNITS_INCHES | CANON_UNITS_CM)     millimetres at the start
//! SELECT_PLANE(CANON_PLANE_XY | CANON_PLANE_XZ | CANON_PLANE_YZ)     XY at the start
//! SET_FEED_MODE(CANON_PER_MINUTE | CANON_PER_REVOLUTION | CANON_INVERSE_TIME)
//! SET_ORIGIN_OFFSETS(n)  CLEAR_ORIGIN_SHIFT()      ours: number of the work offset; no shift
//! SET_ORIGIN_OFFSETS(x, y, z [, a, b, c])          NIST's: the origin in machine coordinates
//! SET_FEED_RATE(f)  SET_SPINDLE_SPEED(s)  SELECT_TOOL(n)  CHANGE_TOOL(n)  DWELL(seconds)
//! USE_TOOL_LENGTH_OFFSET(n)                        ours: entry of the length table, 0 for none
//! USE_TOOL_LENGTH_OFFSET(length)                   NIST's: a number with a decimal point is a length
//! SET_TRAVERSE_RATE(rate)                          left out: rapid moves are made at the machine's rate
//! START_CUTTER_RADIUS_COMPENSATION(CANON_SIDE_LEFT | CANON_SIDE_RIGHT, entry)     entry of the table
//! STOP_CUTTER_RADIUS_COMPENSATION()
//! START_SPINDLE_CLOCKWISE()  START_SPINDLE_COUNTERCLOCKWISE()  STOP_SPINDLE_TURNING()
//! MACHINE_FUNCTION("name")                        ours: what no dialect supports
//! SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP | CANON_EXACT_PATH | CANON_CONTINUOUS [, tolerance])
//! EXACT_STOP()                                    ours: the move that follows ends in one
//! SET_SPINDLE_MODE(CANON_TURNS_PER_MINUTE | CANON_SURFACE_SPEED)  LIMIT_SPINDLE_SPEED(s)     ours
//! ORIENT_SPINDLE([angle])  SELECT_TOOL_BY_NAME("name")                                       ours
//! FLOOD_ON()  MIST_ON()  COOLANT_OFF()             ours: both at once
//! STRAIGHT_TRAVERSE(x, y, z [, a, b, c])  STRAIGHT_FEED(x, y, z [, a, b, c])
//! ARC_FEED(first_end, second_end, first_axis, second_axis, rotation, axis_end_point [, a, b, c])
//! PROGRAM_STOP()  OPTIONAL_PROGRAM_STOP()  PROGRAM_END()  BEGIN_AGAIN()
//! ```
//!
//! Coordinates are absolute in the program's frame; `_` is an axis that stays where it is. The axes
//! of an arc are X Y, Z X or Y Z; its centre is absolute; rotation is positive counter-clockwise
//! seen from the positive end of the normal, and counts the turns begun. `CHANGE_TOOL` names the
//! tool selected, or nothing if that may have been skipped. `/` before a call, or `/2 ` with its
//! level, marks it for block skip. Blank lines are kept.
//!
//! NIST's forms (`canon.hh` of its RS274/NGC interpreter, Kramer, Proctor & Messina 2000): `SET_ORIGIN_OFFSETS` puts
//! the origin at a point in machine coordinates, in the active unit of length; `USE_TOOL_LENGTH_OFFSET` names the length
//! itself. The origin becomes work offset 1: a program names it before its first move, and no work offset by number.
//! Lengths and feeds in centimetres become millimetres.
//!
//! Lines are read one by one, straight moves by a recogniser of their own. After a fault the next
//! line is read. Not here: whether the stream makes sense.

mod call;
mod canon_state;
mod lexer;
mod lower;
mod straight;

use lalrpop_util::ParseError;
use logos::Logos;
use ncc_dialects::Settings;
use ncc_ir::canon::{AXES, Distance, FeedMode, Modes, Plane, SpindleMode, Units};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::num::Num;
use ncc_ir::program::{Move, Op, Stmt};
use ncc_ir::source::Span;
use ncc_ir::syntax::{Expected, Found, Ranged};
use ncc_ir::unsupported::left_out::LeftOut;

use self::call::Placed;
use self::canon_state::{CanonState, Origin, Selected};
use self::lexer::{LexFault, Token};
use crate::batch::Batch;

lalrpop_util::lalrpop_mod!(
    #[allow(clippy::all, clippy::pedantic, missing_docs, unreachable_pub, unused, private_interfaces)]
    grammar,
    "/canon/call.rs"
);

/// Most words of a line.
const WORDS: usize = 64;

/// Reads the canonical stream.
pub struct Reader {
    settings: Settings,
    /// Whether facts that the text relies on are taken from the dictionary.
    assume: bool,
    state: CanonState,
    /// Facts that the text has said or that were assumed; for a user's text only.
    said: Modes,
    moved: bool,
    /// Whether anything was found.
    found: bool,
    /// Whether the program has ended, and whether text after it was reported.
    ended: bool,
    after_end: bool,
    end: u32,
}

impl Reader {
    /// A reader. For a user's text (`assume`) the facts that it relies on are recorded.
    pub fn new(settings: Settings, assume: bool) -> Reader {
        Reader {
            settings,
            assume,
            state: CanonState {
                units: Some(Units::Mm),
                centimetres: false,
                origin: Origin::None,
                plane: Some(Plane::Xy),
                feed_mode: Some(FeedMode::PerMinute),
                selected: Selected::None,
                positions: [None; AXES],
            },
            said: Modes::default(),
            moved: !assume,
            found: false,
            ended: false,
            after_end: false,
            end: 0,
        }
    }

    /// Reads whole lines; `base` is the place of their first byte.
    pub fn read(&mut self, text: &[u8], base: u32, out: &mut Batch) {
        let mut rest = text;
        let mut at = base;
        while !rest.is_empty() {
            let length =
                if self.moved && !self.ended && !self.state.centimetres && self.fast_lower(rest, at, out) {
                    self.end.wrapping_sub(at) as usize
                } else {
                    let newline = rest.iter().position(|&b| b == b'\n');
                    let line = &rest[..newline.unwrap_or(rest.len())];
                    self.line(line.strip_suffix(b"\r").unwrap_or(line), at, out);
                    newline.map_or(rest.len(), |n| n + 1)
                };
            at = at.wrapping_add(length as u32);
            rest = &rest[length..];
        }
        self.end = at;
    }

    /// The end of the text.
    pub fn finish(&mut self, out: &mut Batch) {
        if !self.assume {
            return;
        }
        let end = Span::new(self.end, self.end);
        if !self.found {
            out.diagnostics.push(Diagnostic::new(Fault::EmptyProgram, Span::new(0, self.end)));
        } else if !self.ended {
            out.diagnostics.push(Diagnostic::new(Fault::NoProgramEnd, end));
        }
    }

    /// Reads a straight move at the start of the text, if there is one that the recogniser takes;
    /// `end` is then the end of its line.
    #[inline]
    fn fast_lower(&mut self, text: &[u8], at: u32, out: &mut Batch) -> bool {
        let Some(found) = straight::straight(text, self.state.length()) else { return false };
        self.state.go(&found.to, false);
        let m = Move { to: found.to, said: false };
        let op = if found.traverse { Op::StraightTraverse(m) } else { Op::StraightFeed(m) };
        let span = Span::new(at, at.wrapping_add(found.length as u32));
        out.stmts.push(Stmt::new(span, op));
        self.end = at.wrapping_add(found.line as u32);
        true
    }

    fn line(&mut self, line: &[u8], at: u32, out: &mut Batch) {
        let place = |l: usize, r: usize| Span::new(at.wrapping_add(l as u32), at.wrapping_add(r as u32));
        let length = line.trim_ascii_end().len();
        let start = length - line[..length].trim_ascii_start().len();
        let result = match std::str::from_utf8(line) {
            Ok(text) => self.call(text),
            Err(e) => Err((Fault::NotText, e.valid_up_to(), e.valid_up_to() + 1)),
        };
        match result {
            Ok((skip, op)) => {
                let span = place(start, length);
                if let Err(fault) = self.state.set_origin(&op, self.moved && self.assume) {
                    self.found = true;
                    out.diagnostics.push(Diagnostic::new(fault, span));
                    return;
                }
                if let (Op::NoEffect(code), true) = (&op, self.assume) {
                    let what = LeftOut::RapidRate { code: code[..].into() };
                    out.diagnostics.push(Diagnostic::new(Fault::CodeLeftOut { what }, span));
                }
                let values = matches!(op, Op::SetData(_));
                self.push(op, skip, span, out);
                if values {
                    self.push(Op::SetOriginOffsets(lower::ORIGIN), skip, span, out);
                    if self.assume {
                        let fact = ControlFact::OriginWorkOffset { offset: lower::ORIGIN };
                        out.diagnostics.push(Diagnostic::new(Fault::AssumedFact { fact }, span));
                    }
                }
            }
            Err((fault, l, r)) => {
                self.found = true;
                out.diagnostics.push(Diagnostic::new(fault, place(l, r)));
            }
        }
    }

    fn push(&mut self, op: Op, skip: Option<u8>, span: Span, out: &mut Batch) {
        let silent = matches!(op, Op::Blank | Op::Comment(_));
        self.account(&op, skip.is_some(), span, silent, out);
        self.state.after(&op, skip.is_some());
        let before = out.stmts.last().filter(|before| before.skip == skip);
        let joined = before.is_some_and(|before| match op {
            // A surface speed is said with the function that makes it one.
            Op::SetSpindleSpeed(_) => before.op == Op::SetSpindleMode(SpindleMode::Surface),
            Op::SetOriginOffsets(_) => before.span == span,
            _ => false,
        });
        out.stmts.push(Stmt { skip, joined, ..Stmt::new(span, op) });
    }

    fn call(&mut self, text: &str) -> Result<(Option<u8>, Op), (Fault, usize, usize)> {
        let words = Token::lexer(text).spanned().enumerate().map(|(count, (token, place))| match token {
            _ if count >= WORDS => Err((0, text.len(), LexFault::Long)),
            Ok(token) => Ok((place.start, token, place.end)),
            Err(fault) => Err((place.start, place.end, fault)),
        });
        let Some(call) = grammar::LineParser::new().parse(words).map_err(|e| explain(e, text))? else {
            return Ok((None, Op::Blank));
        };
        let skip = match &call.skip {
            None => None,
            Some(Placed { is: None, .. }) => Some(1),
            Some(Placed { is: Some(Num { mantissa: level @ 1..=9, point: false, .. }), .. }) => {
                Some(*level as u8)
            }
            Some(Placed { l, r, .. }) => {
                return Err((Fault::OutOfRange { word: Ranged::SkipLevel }, *l, *r));
            }
        };
        let op = lower::lower(call, text, &mut self.state, skip.is_some())?;
        Ok((skip, op))
    }

    /// Keeps account of the facts that a user's text relies on, and of its end.
    fn account(&mut self, op: &Op, skipped: bool, span: Span, silent: bool, out: &mut Batch) {
        if silent {
            return;
        }
        self.found = true;
        if self.ended && !std::mem::replace(&mut self.after_end, true) && self.assume {
            out.diagnostics.push(Diagnostic::new(Fault::TextAfterEnd, span));
        }
        self.ended |= matches!(op, Op::ProgramEnd | Op::BeginAgain) && !skipped;
        if !self.assume {
            return;
        }
        let moves = matches!(op, Op::StraightTraverse(_) | Op::StraightFeed(_) | Op::ArcFeed(_));
        let feeds = matches!(op, Op::SetFeedRate(_));
        if !skipped {
            self.said = said(self.said, op);
        }
        let said = self.said;
        // Facts by definition are recorded without a word.
        if (moves || feeds) && said.units.is_none() {
            out.assumed.units = Some(Units::Mm);
        }
        if feeds && said.feed_mode.is_none() {
            out.assumed.feed_mode = Some(FeedMode::PerMinute);
        }
        if matches!(op, Op::ArcFeed(_)) && said.plane.is_none() {
            out.assumed.plane = Some(Plane::Xy);
        }
        if moves && !std::mem::replace(&mut self.moved, true) {
            out.assumed.distance = Some(Distance::Absolute);
            self.first_move(span, out);
        }
    }

    /// What the first move relies on.
    fn first_move(&self, span: Span, out: &mut Batch) {
        let power_on = &self.settings.dialect.power_on;
        let mut assume = |fact, value: String, always: bool| {
            if !always {
                let fault = Fault::AssumedMode { fact, value: value.into() };
                out.diagnostics.push(Diagnostic::new(fault, span));
            }
        };
        if self.said.work_offset.is_none()
            && let Some(fact) = &power_on.work_offset
        {
            assume(ModeName::WorkOffset, fact.value.to_string(), fact.always);
            out.assumed.work_offset = Some(fact.value);
        }
        if self.said.length_offset.is_none()
            && let Some(fact) = &power_on.length_offset
        {
            assume(ModeName::LengthOffset, fact.value.to_string(), fact.always);
            out.assumed.length_offset = Some(fact.value);
        }
        if self.said.no_origin_shift.is_none()
            && let Some(fact) = &power_on.no_origin_shift
        {
            assume(ModeName::OriginShift, fact.value.to_string(), fact.always);
            out.assumed.no_origin_shift = Some(fact.value);
        }
    }
}

/// What the text has said by itself, whatever its value.
fn said(mut so_far: Modes, op: &Op) -> Modes {
    if let Op::UseLengthUnits(units) = op {
        so_far.units = Some(*units);
    }
    if let Op::SelectPlane(plane) = op {
        so_far.plane = Some(*plane);
    }
    if let Op::SetFeedMode(mode) = op {
        so_far.feed_mode = Some(*mode);
    }
    if let Op::SetOriginOffsets(number) = op {
        so_far.work_offset = Some(*number);
    }
    if let Op::UseToolLengthOffset(_) | Op::UseToolLength(_) = op {
        so_far.length_offset = Some(0);
    }
    if let Op::ClearFrame(_) = op {
        so_far.no_origin_shift = Some(true);
    }
    so_far
}

/// The fault of a line that could not be parsed, with its place in the line.
fn explain(error: ParseError<usize, Token, (usize, usize, LexFault)>, text: &str) -> (Fault, usize, usize) {
    let syntax =
        |l: usize, r: usize, found: Found, expected: Expected| (Fault::Syntax { found, expected }, l, r);
    let list = |expected: &[String]| {
        let names: Vec<_> = expected.iter().map(|e| e.trim_matches('"')).collect();
        let quoted = |n: &&str| if n.len() > 1 { (*n).to_owned() } else { format!("`{n}`") };
        Expected::from(names.iter().map(quoted).collect::<Vec<_>>().join(", ").as_str())
    };
    match error {
        ParseError::UnrecognizedToken { token: (l, _, r), expected } => {
            syntax(l, r, text[l..r].into(), list(&expected))
        }
        ParseError::ExtraToken { token: (l, _, r) } => syntax(l, r, text[l..r].into(), Expected::EndOfLine),
        ParseError::UnrecognizedEof { expected, .. } => {
            let end = text.trim_end().len();
            syntax(end, end, Found::EndOfLine, list(&expected))
        }
        ParseError::InvalidToken { location } => (Fault::NotText, location, location),
        ParseError::User { error: (l, r, fault) } => match fault {
            LexFault::Number => (Fault::BadNumber { text: text[l..r].into() }, l, r),
            LexFault::Escape => syntax(l, r, text[l..r].into(), Expected::PlainEscapes),
            LexFault::Long => syntax(l, r, Found::ManyWords, Expected::Words { most: WORDS }),
            LexFault::Character => match text[l..].chars().next() {
                Some('"') => (Fault::UnclosedComment, l, text.trim_end().len()),
                Some(found) => (Fault::UnexpectedCharacter { found }, l, l + found.len_utf8()),
                None => (Fault::NotText, l, r),
            },
        },
    }
}
