//! Makes statements of the blocks that a program has answered with.
//!
//! Each block starts where the one before it ends. A function that ncc does not know by this form, or whose meaning depends
//! on tables of the control, is refused by its name. Not here: the form of a block, which the payload's reader judges.

use ncc_dialects::{FunctionAnswer, FunctionCall};
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Plane, Turn, Units};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, ONE, Unit};
use ncc_ir::program::{Arc, Centre, CentreFrom, Coord, Move, Op, Point, Turns};
use ncc_ir::unsupported::FunctionFailure;
use serde_json::Value;

use super::units;
use crate::time::payload::Block;

/// Two positions are one up to here, in mm and degrees: the payload's last digit.
const SAME: f64 = 1e-6;

/// Largest position, feed or speed.
const LARGEST: f64 = 1e6;

/// Digits after the point of lengths in inches: finer than a millionth of a millimetre.
const INCH_DIGITS: u8 = 8;

/// The answer so far.
struct State {
    inch: bool,
    plane: Plane,
    position: [f64; AXES],
    /// The feed active, mm/min; 0 for none.
    feed: f64,
}

/// The statements of an answer.
///
/// # Errors
/// The first block that ncc does not take.
pub(super) fn statements(call: &FunctionCall, blocks: &[Block]) -> Result<FunctionAnswer, FunctionFailure> {
    let first = call.blocks.first();
    let mut state = State {
        inch: call.units == Units::Inch,
        plane: call.plane,
        position: first.map_or([0.0; AXES], |block| block.position.map(units)),
        feed: first.map_or(0.0, |block| units(block.feed)),
    };
    let mut answer = FunctionAnswer::default();
    let mut from = 0;
    for (at, block) in blocks.iter().enumerate() {
        let same = call.blocks.iter().skip(from).position(|given| given.gcode == block.gcode);
        from += same.unwrap_or(0);
        let ops = state.block(at + 1, block)?;
        if !ops.is_empty() {
            answer.blocks.push((from, ops));
        }
    }
    Ok(answer)
}

impl State {
    fn block(&mut self, number: usize, block: &Block) -> Result<Vec<Op>, FunctionFailure> {
        let (start, end) = self.ends(block);
        for axis in Axis::ALL {
            if (start[axis as usize] - self.position[axis as usize]).abs() > SAME {
                let axis = char::from(axis.letter());
                return Err(FunctionFailure::Start { block: number, axis });
            }
        }
        let moved: [bool; AXES] = std::array::from_fn(|at| (end[at] - self.position[at]).abs() > SAME);
        let name = &*block.function_name;
        let moves = matches!(name, "STRAIGHT_TRAVERSE" | "STRAIGHT_FEED" | "ARC_FEED");
        if !moves && moved != [false; AXES] {
            return Err(FunctionFailure::Moves { block: number, function: name.into() });
        }
        let large = end.iter().chain([&block.feed, &block.speed]).any(|value| value.abs() > LARGEST);
        if large {
            return Err(FunctionFailure::TooLong { block: number });
        }
        let mut ops = Vec::new();
        if matches!(name, "STRAIGHT_FEED" | "ARC_FEED" | "SET_FEED_RATE") {
            self.feed(number, block.feed, &mut ops)?;
        }
        match name {
            "SET_FEED_RATE" => {}
            "STRAIGHT_TRAVERSE" | "STRAIGHT_FEED" => {
                let to = Move { to: self.point(&end, moved), said: false };
                if !to.to.is_empty() {
                    let feeds = name == "STRAIGHT_FEED";
                    ops.push(if feeds { Op::StraightFeed(to) } else { Op::StraightTraverse(to) });
                }
            }
            "ARC_FEED" => ops.push(self.arc(number, block, &end, moved)?),
            "SET_SPINDLE_SPEED" => ops.push(Op::SetSpindleSpeed(plain(block.speed, Unit::One))),
            "START_SPINDLE_CLOCKWISE" => ops.push(Op::StartSpindleClockwise),
            "START_SPINDLE_COUNTERCLOCKWISE" => ops.push(Op::StartSpindleCounterclockwise),
            "STOP_SPINDLE_TURNING" => ops.push(Op::StopSpindleTurning),
            "FLOOD_ON" => ops.push(Op::FloodOn),
            "MIST_ON" => ops.push(Op::MistOn),
            "COOLANT_OFF" => ops.push(Op::CoolantOff),
            "DWELL" => ops.push(Op::Dwell(dwell(number, block)?)),
            "PROGRAM_STOP" => ops.push(Op::ProgramStop),
            "OPTIONAL_PROGRAM_STOP" => ops.push(Op::OptionalProgramStop),
            _ => return Err(FunctionFailure::Function { block: number, function: name.into() }),
        }
        self.position = end;
        Ok(ops)
    }

    /// Start and end of a block. A block without rotary axes leaves them as they are.
    fn ends(&self, block: &Block) -> ([f64; AXES], [f64; AXES]) {
        let [.., a, b, c] = self.position;
        let (a0, b0, c0, a1, b1, c1) = match block.rotary {
            Some(r) => (r.a0, r.b0, r.c0, r.a1, r.b1, r.c1),
            None => (a, b, c, a, b, c),
        };
        ([block.x0, block.y0, block.z0, a0, b0, c0], [block.x1, block.y1, block.z1, a1, b1, c1])
    }

    /// The feed of a block, where it is another one than before.
    fn feed(&mut self, number: usize, feed: f64, ops: &mut Vec<Op>) -> Result<(), FunctionFailure> {
        if feed <= 0.0 {
            return Err(FunctionFailure::NoFeed { block: number });
        }
        if (feed - self.feed).abs() > SAME {
            ops.push(Op::SetFeedRate(self.length(feed)));
            self.feed = feed;
        }
        Ok(())
    }

    /// A length or a feed, in the unit of the statements.
    fn length(&self, value: f64) -> Expr {
        match self.inch {
            true => Expr::Num(number(value / 25.4, INCH_DIGITS, Unit::Inch)),
            false => Expr::Num(number(value, 6, Unit::Mm)),
        }
    }

    /// The coordinate of an axis.
    fn coordinate(&self, axis: Axis, value: f64) -> Coord {
        let value = match axis.is_rotary() {
            true => Expr::Num(number(value, 6, Unit::Degree)),
            false => self.length(value),
        };
        Coord { value, distance: Fact::Known(Distance::Absolute) }
    }

    /// The point of these axes.
    fn point(&self, end: &[f64; AXES], named: [bool; AXES]) -> Point {
        let mut to = Point::default();
        for axis in Axis::ALL.into_iter().filter(|axis| named[*axis as usize]) {
            to.set(axis, self.coordinate(axis, end[axis as usize]));
        }
        to
    }

    /// `ARC_FEED`: the centre from program zero (`i`, `j`, `k`), `turn`, `plane` and `full`, as the payload has them.
    fn arc(
        &self,
        number: usize,
        block: &Block,
        end: &[f64; AXES],
        moved: [bool; AXES],
    ) -> Result<Op, FunctionFailure> {
        let wrong = |name: &str| FunctionFailure::Parameter { block: number, parameter: name.into() };
        let text = |name: &str| block.parameters.get(name).and_then(Value::as_str);
        let plane = match text("plane") {
            Some("XY") => Plane::Xy,
            Some("ZX") => Plane::Zx,
            Some("YZ") => Plane::Yz,
            _ => return Err(wrong("plane")),
        };
        if plane != self.plane {
            return Err(FunctionFailure::Plane { block: number });
        }
        let turn = match text("turn") {
            Some("clockwise") => Turn::Clockwise,
            Some("counterclockwise") => Turn::Counterclockwise,
            _ => return Err(wrong("turn")),
        };
        let (first, second, _) = plane.axes();
        let in_plane = [first, second].map(|axis| axis as usize);
        let full = block.parameters.get("full").and_then(Value::as_bool).ok_or_else(|| wrong("full"))?;
        if full == in_plane.iter().any(|axis| moved[*axis]) {
            return Err(wrong("full"));
        }
        let mut words = [None, None, None];
        for axis in [first, second] {
            let letter = ["i", "j", "k"][axis as usize];
            let value = block.parameters.get(letter).and_then(Value::as_f64);
            let value = value.filter(|value| value.abs() <= LARGEST).ok_or_else(|| wrong(letter))?;
            words[axis as usize] = Some(self.length(value));
        }
        let mut named = moved;
        in_plane.into_iter().for_each(|axis| named[axis] = true);
        Ok(Op::ArcFeed(Box::new(Arc {
            plane: Fact::Known(plane),
            turn,
            to: self.point(end, named),
            centre: Centre::Point { words, from: CentreFrom::Zero },
            turns: Turns::NONE,
            said: false,
        })))
    }
}

/// The seconds of a dwell.
fn dwell(number: usize, block: &Block) -> Result<Expr, FunctionFailure> {
    let seconds = block.parameters.get("seconds").and_then(Value::as_f64);
    match seconds.filter(|seconds| (0.0..=LARGEST).contains(seconds)) {
        Some(seconds) => Ok(plain(seconds, Unit::Second)),
        None => Err(FunctionFailure::Parameter { block: number, parameter: "seconds".into() }),
    }
}

/// A value that no unit of length changes; a whole one without a point.
fn plain(value: f64, unit: Unit) -> Expr {
    let num = number(value, 6, unit);
    Expr::Num(if num.scale == 0 { Num::int(num.mantissa, unit) } else { num })
}

/// The nearest literal with so many digits. The value is in range.
fn number(value: f64, digits: u8, unit: Unit) -> Num {
    Num::from_nanos((value * ONE as f64).round() as i64, digits, unit)
}
