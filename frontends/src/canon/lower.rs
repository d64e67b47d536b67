//! From a call to a statement: names, numbers of arguments, what each argument is.

use ncc_ir::canon::{AXES, Axis, Fact, FeedMode, PathMode, Plane, Side, SpindleMode, Turn, Units};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, POW10, Unit};
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::{
    Arc, Centre, CentreFrom, CutterRadius, Data, DataMode, FrameSlot, Move, Op, PathControl, Point, Text,
    ToolLength,
};
use ncc_ir::syntax::Expected;
use ncc_ir::unsupported::{CodeUnsupported, Unsupported};

use super::call::{Call, Placed};
use super::canon_state::{CanonState, Selected};
use super::lexer::Argument;

/// The work offset that `SET_ORIGIN_OFFSETS` by values sets and makes current.
pub(super) const ORIGIN: u16 = 1;

/// A fault and its place in the line.
type Refused = (Fault, usize, usize);

/// The arguments of a call, taken one after the other.
struct Arguments<'a> {
    rest: std::vec::IntoIter<Placed<Argument>>,
    /// Unit of lengths.
    length: Unit,
    /// Whether lengths are written in centimetres; their unit is then the millimetre.
    centimetres: bool,
    text: &'a str,
    call: &'a str,
    close: usize,
}

impl Arguments<'_> {
    fn next(&mut self, word: &str) -> Result<Placed<Argument>, Refused> {
        let missing = || Fault::WordMissing { code: self.call.into(), word: word.into() };
        self.rest.next().ok_or_else(|| (missing(), self.close, self.close + 1))
    }

    fn wrong(&self, found: &Placed<Argument>, expected: impl Into<Expected>) -> Refused {
        let fault = Fault::Syntax { found: self.text[found.l..found.r].into(), expected: expected.into() };
        (fault, found.l, found.r)
    }

    /// A number in a unit.
    fn number(&mut self, word: &str, unit: Unit) -> Result<Expr, Refused> {
        let found = self.next(word)?;
        match found.is {
            Argument::Number(n) => Ok(Expr::Num(Num { unit, ..n })),
            Argument::Text(_) | Argument::Name | Argument::Nothing => {
                Err(self.wrong(&found, Expected::Number))
            }
        }
    }

    /// A length, or a feed, in the unit of lengths.
    fn length(&mut self, word: &str) -> Result<Expr, Refused> {
        let found = self.next(word)?;
        match found.is {
            Argument::Number(n) => Ok(Expr::Num(self.in_length(n, word, &found)?)),
            Argument::Text(_) | Argument::Name | Argument::Nothing => {
                Err(self.wrong(&found, Expected::Number))
            }
        }
    }

    /// A number as written, in the unit of lengths: ten millimetres are a centimetre.
    fn in_length<T>(&self, n: Num, word: &str, found: &Placed<T>) -> Result<Num, Refused> {
        let n = Num { unit: self.length, ..n };
        match n.scale.checked_sub(1) {
            _ if !self.centimetres => Ok(n),
            Some(scale) => Ok(Num { scale, ..n }),
            None => {
                let mantissa = n.mantissa.checked_mul(10).filter(|n| n.unsigned_abs() < POW10[18] as u64);
                let fault = || (Fault::OutOfRange { word: word.into() }, found.l, found.r);
                Ok(Num { mantissa: mantissa.ok_or_else(fault)?, ..n })
            }
        }
    }

    /// The number of an axis: a length, or degrees.
    fn along(&mut self, axis: Axis) -> Result<Expr, Refused> {
        let word = axis_word(axis);
        if axis.is_rotary() { self.number(word, Unit::Degree) } else { self.length(word) }
    }

    /// The coordinate of an axis, or `_`.
    fn coordinate(&mut self, axis: Axis, to: &mut Point) -> Result<(), Refused> {
        let word = axis_word(axis);
        let found = self.next(word)?;
        match found.is {
            Argument::Number(n) => {
                let n = match axis.is_rotary() {
                    true => Num { unit: Unit::Degree, ..n },
                    false => self.in_length(n, word, &found)?,
                };
                to.set(axis, absolute(n));
                Ok(())
            }
            Argument::Nothing => Ok(()),
            Argument::Text(_) | Argument::Name => Err(self.wrong(&found, Expected::NumberOrNothing)),
        }
    }

    /// The three rotary axes, if they are there.
    fn rotary(&mut self, to: &mut Point) -> Result<(), Refused> {
        if self.rest.len() > 0 {
            for axis in [Axis::A, Axis::B, Axis::C] {
                self.coordinate(axis, to)?;
            }
        }
        Ok(())
    }

    /// A whole number that is no less than zero, with its place.
    fn count(&mut self, word: &str) -> Result<Placed<i64>, Refused> {
        let found = self.next(word)?;
        match found.is {
            Argument::Number(Num { mantissa, point: false, .. }) if mantissa >= 0 => {
                Ok(Placed { is: mantissa, l: found.l, r: found.r })
            }
            Argument::Number(_) => Err((Fault::OutOfRange { word: word.into() }, found.l, found.r)),
            Argument::Text(_) | Argument::Name | Argument::Nothing => {
                Err(self.wrong(&found, Expected::WholeNumber))
            }
        }
    }

    fn text(&mut self) -> Result<Text, Refused> {
        let found = self.next("text")?;
        match found.is {
            Argument::Text(text) => Ok(text),
            Argument::Number(_) | Argument::Name | Argument::Nothing => {
                Err(self.wrong(&found, Expected::QuotedText))
            }
        }
    }

    /// One of several names.
    fn one_of<T: Copy>(&mut self, word: &str, names: &[(&str, T)]) -> Result<T, Refused> {
        let found = self.next(word)?;
        if found.is == Argument::Name {
            let name = &self.text[found.l..found.r];
            if let Some((_, value)) = names.iter().find(|(n, _)| *n == name) {
                return Ok(*value);
            }
        }
        let expected: Vec<String> = names.iter().map(|(n, _)| format!("`{n}`")).collect();
        Err(self.wrong(&found, expected.join(", ").as_str()))
    }

    /// Whether the argument that follows is a number with a decimal point.
    fn next_has_point(&self) -> bool {
        let next = self.rest.as_slice().first().map(|placed| &placed.is);
        matches!(next, Some(Argument::Number(Num { point: true, .. })))
    }

    /// A call that ncc reads and does not translate.
    fn refuse(&self, what: impl Into<Unsupported>) -> Refused {
        (Fault::NotSupported { code: self.call.into(), what: what.into() }, 0, self.close + 1)
    }

    fn end(&mut self) -> Result<(), Refused> {
        match self.rest.next() {
            Some(found) => Err(self.wrong(&found, "`)`")),
            None => Ok(()),
        }
    }
}

fn axis_word(axis: Axis) -> &'static str {
    ["x", "y", "z", "a", "b", "c"][axis as usize]
}

/// The statement of a call.
pub(super) fn lower(call: Call, text: &str, state: &mut CanonState, skipped: bool) -> Result<Op, Refused> {
    let name = &text[call.name.l..call.name.r];
    let mut args = Arguments {
        rest: call.arguments.into_iter(),
        length: state.length(),
        centimetres: state.centimetres,
        text,
        call: name,
        close: call.close,
    };
    let op = match name {
        "STRAIGHT_TRAVERSE" | "STRAIGHT_FEED" => {
            let mut to = Point::default();
            for axis in [Axis::X, Axis::Y, Axis::Z] {
                args.coordinate(axis, &mut to)?;
            }
            args.rotary(&mut to)?;
            let m = Move { to, said: false };
            if name == "STRAIGHT_FEED" { Op::StraightFeed(m) } else { Op::StraightTraverse(m) }
        }
        "ARC_FEED" => Op::ArcFeed(Box::new(arc(&mut args, state)?)),
        "SET_FEED_RATE" => {
            let inverse = state.feed_mode == Some(FeedMode::InverseTime);
            Op::SetFeedRate(if inverse { args.number("rate", Unit::One)? } else { args.length("rate")? })
        }
        "SET_SPINDLE_SPEED" => Op::SetSpindleSpeed(args.number("speed", Unit::One)?),
        "DWELL" => Op::Dwell(args.number("seconds", Unit::Second)?),
        "SELECT_TOOL" => {
            let tool = args.count("tool")?.is;
            state.select(tool, skipped);
            Op::SelectTool(Expr::int(tool))
        }
        "CHANGE_TOOL" => {
            if args.rest.len() > 0 {
                let tool = args.count("tool")?;
                state.check_tool(tool.is).map_err(|fault| (fault, tool.l, tool.r))?;
            }
            Op::ChangeTool
        }
        "USE_TOOL_LENGTH_OFFSET" => match args.next_has_point() {
            true => Op::UseToolLength(Box::new(ToolLength::Value(args.length("length")?))),
            false => Op::UseToolLengthOffset(Expr::int(args.count("entry")?.is)),
        },
        "SET_ORIGIN_OFFSETS" if args.rest.len() > 1 => origin(&mut args, skipped)?,
        "SET_ORIGIN_OFFSETS" => {
            let n = args.count("number")?;
            let fault = || (Fault::OutOfRange { word: "number".into() }, n.l, n.r);
            Op::SetOriginOffsets(u16::try_from(n.is).map_err(|_| fault())?)
        }
        "SET_TRAVERSE_RATE" => {
            args.length("rate")?;
            Op::NoEffect(text[call.name.l..=call.close].into())
        }
        "USE_LENGTH_UNITS" => units(&mut args, state, skipped)?,
        "SELECT_PLANE" => Op::SelectPlane(args.one_of(
            "plane",
            &[("CANON_PLANE_XY", Plane::Xy), ("CANON_PLANE_XZ", Plane::Zx), ("CANON_PLANE_YZ", Plane::Yz)],
        )?),
        "SET_FEED_MODE" => Op::SetFeedMode(args.one_of(
            "mode",
            &[
                ("CANON_PER_MINUTE", FeedMode::PerMinute),
                ("CANON_PER_REVOLUTION", FeedMode::PerRevolution),
                ("CANON_INVERSE_TIME", FeedMode::InverseTime),
            ],
        )?),
        "SET_MOTION_CONTROL_MODE" => {
            let mode = args.one_of(
                "mode",
                &[
                    ("CANON_EXACT_STOP", PathMode::ExactStop),
                    ("CANON_EXACT_PATH", PathMode::ExactPath),
                    ("CANON_CONTINUOUS", PathMode::Continuous),
                ],
            )?;
            let within = match args.rest.len() > 0 && mode == PathMode::Continuous {
                true => Some(args.length("tolerance")?),
                false => None,
            };
            let mode = if within.is_some() { PathMode::Tolerance } else { mode };
            Op::SetMotionControlMode(Box::new(PathControl { mode, within, rapids: None, merged: None }))
        }
        "EXACT_STOP" => Op::ExactStop,
        "SET_SPINDLE_MODE" => Op::SetSpindleMode(args.one_of(
            "mode",
            &[("CANON_TURNS_PER_MINUTE", SpindleMode::Turns), ("CANON_SURFACE_SPEED", SpindleMode::Surface)],
        )?),
        "LIMIT_SPINDLE_SPEED" => Op::LimitSpindleSpeed(args.number("speed", Unit::One)?),
        "ORIENT_SPINDLE" => Op::OrientSpindle(match args.rest.len() > 0 {
            true => Some(args.number("angle", Unit::Degree)?),
            false => None,
        }),
        "SELECT_TOOL_BY_NAME" => {
            state.selected = Selected::Unsure;
            Op::SelectToolByName(args.text()?)
        }
        "COMMENT" => Op::Comment(args.text()?),
        "MESSAGE" => Op::Message(args.text()?),
        "MACHINE_FUNCTION" => Op::MachineFunction(args.text()?),
        "CLEAR_ORIGIN_SHIFT" => Op::ClearFrame(FrameSlot::Shift),
        "START_CUTTER_RADIUS_COMPENSATION" => Op::StartCutterRadiusCompensation {
            side: args
                .one_of("side", &[("CANON_SIDE_LEFT", Side::Left), ("CANON_SIDE_RIGHT", Side::Right)])?,
            radius: match args.rest.len() > 1 {
                true => {
                    args.one_of("radius", &[("CANON_DIAMETER", ())])?;
                    CutterRadius::Diameter(args.length("diameter")?)
                }
                false => CutterRadius::Entry(Expr::int(args.count("entry")?.is)),
            },
        },
        "STOP_CUTTER_RADIUS_COMPENSATION" => Op::StopCutterRadiusCompensation,
        "START_SPINDLE_CLOCKWISE" => Op::StartSpindleClockwise,
        "START_SPINDLE_COUNTERCLOCKWISE" => Op::StartSpindleCounterclockwise,
        "STOP_SPINDLE_TURNING" => Op::StopSpindleTurning,
        "FLOOD_ON" => Op::FloodOn,
        "MIST_ON" => Op::MistOn,
        "COOLANT_OFF" => Op::CoolantOff,
        "PROGRAM_STOP" => Op::ProgramStop,
        "OPTIONAL_PROGRAM_STOP" => Op::OptionalProgramStop,
        "PROGRAM_END" => Op::ProgramEnd,
        "BEGIN_AGAIN" => Op::BeginAgain,
        _ => return Err((Fault::UnknownCode { code: name.into() }, call.name.l, call.name.r)),
    };
    args.end()?;
    Ok(op)
}

/// `SET_ORIGIN_OFFSETS(x, y, z, a, b, c)`: the values of [`ORIGIN`].
fn origin(args: &mut Arguments<'_>, skipped: bool) -> Result<Op, Refused> {
    let mut words = [const { None }; AXES];
    for axis in Axis::ALL {
        if axis.is_rotary() && args.rest.len() == 0 && words[Axis::A as usize].is_none() {
            break;
        }
        words[axis as usize] = Some(args.along(axis)?);
    }
    if skipped {
        return Err(args.refuse(CodeUnsupported::Skipped));
    }
    let data = Data::Offset { offset: ORIGIN, mode: DataMode::Set, words: Box::new(words), turn: None };
    Ok(Op::SetData(Box::new(data)))
}

/// `USE_LENGTH_UNITS`. A skipped block leaves either unit, of which centimetres are none of the statements'.
fn units(args: &mut Arguments<'_>, state: &mut CanonState, skipped: bool) -> Result<Op, Refused> {
    let (units, centimetres) = args.one_of(
        "units",
        &[
            ("CANON_UNITS_MM", (Units::Mm, false)),
            ("CANON_UNITS_INCHES", (Units::Inch, false)),
            ("CANON_UNITS_CM", (Units::Mm, true)),
        ],
    )?;
    if skipped && (centimetres || state.centimetres) {
        return Err(args.refuse(CodeUnsupported::Skipped));
    }
    state.centimetres = centimetres;
    Ok(Op::UseLengthUnits(units))
}

/// `ARC_FEED(first_end, second_end, first_axis, second_axis, rotation, axis_end_point, a, b, c)`
fn arc(args: &mut Arguments<'_>, state: &CanonState) -> Result<Arc, Refused> {
    // After a change of plane that may be skipped the axes are not known.
    let plane =
        state.plane.ok_or_else(|| (Fault::EntryFactNeeded { fact: ModeName::Plane }, 0, args.close + 1))?;
    let (first, second, normal) = plane.axes();
    let mut to = Point::default();
    args.coordinate(first, &mut to)?;
    args.coordinate(second, &mut to)?;
    let mut words = [None, None, None];
    words[first as usize] = Some(args.length("first_axis")?);
    words[second as usize] = Some(args.length("second_axis")?);
    let rotation = args.next("rotation")?;
    let (turn, turns) = match rotation.is {
        Argument::Number(Num { mantissa, point: false, .. })
            if mantissa != 0 && mantissa.unsigned_abs() <= u64::from(u32::MAX) =>
        {
            let turn = if mantissa < 0 { Turn::Clockwise } else { Turn::Counterclockwise };
            (turn, (mantissa.unsigned_abs() - 1) as u32)
        }
        Argument::Number(_) => {
            return Err((Fault::OutOfRange { word: "rotation".into() }, rotation.l, rotation.r));
        }
        Argument::Text(_) | Argument::Name | Argument::Nothing => {
            return Err(args.wrong(&rotation, Expected::WholeNumber));
        }
    };
    args.coordinate(normal, &mut to)?;
    args.rotary(&mut to)?;
    // An axis outside of the plane that ends where it stands makes no helix.
    for axis in Axis::ALL {
        let in_plane = axis == first || axis == second;
        if !in_plane && to.get(axis).is_some() && state.is_at(axis, to.get(axis)) {
            to.axes[axis as usize] = None;
        }
    }
    let centre = Centre::Point { words, from: CentreFrom::Zero };
    Ok(Arc { plane: Fact::Known(plane), turn, to, centre, turns: turns.into(), said: false })
}
