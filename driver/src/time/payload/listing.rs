//! The canonical functions of a document that was read back, with times in comments: what OUTPUT makes of a stored
//! program (Aguiar 2023, 3.4).
//!
//! A document has neither work offsets nor modes, so the list was not verified: positions are mm in the program's
//! coordinates, and feeds the mm/min of each move. What has no canonical function with what the document has of it is
//! refused, and so is what shows that the tool went elsewhere: a way that is not the one between the positions, and an
//! origin that changes. The canonical writer writes.
//!
//! ```text
//! "function_name":"STRAIGHT_FEED","x1":-15.0, …    STRAIGHT_FEED(-15.0, -65.0, -8.0)
//! ```

use std::io::{self, Write};

use ncc_backends::Layout;
use ncc_backends::canon::Writer;
use ncc_dialects::{Dialect, Settings};
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Modes, Plane, Turn, Units};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::{Arc, Centre, CentreFrom, Move, Op, Point, Stmt};
use ncc_ir::source::Span;

use super::path;
use super::refusal::{Unusable, Why};
use super::{Block, Document};
use crate::render::events;

/// Writes the list in the canonical dialect, or gives the block that has no call.
///
/// # Errors
/// Writing.
pub fn list(
    document: &Document,
    canon: &'static Dialect,
    out: &mut dyn Write,
) -> io::Result<Result<(), Unusable>> {
    if let Err(unusable) = document.processed() {
        return Ok(Err(unusable));
    }
    let modes = Modes { units: Some(Units::Mm), distance: Some(Distance::Absolute), ..Modes::default() };
    let mut writer = Writer::new(Settings::new(canon), Layout::default());
    let (mut text, mut faults): (Vec<u8>, Vec<Diagnostic>) = (Vec::new(), Vec::new());
    let (mut entry, mut feed, mut stmts) = (0, None, Vec::new());
    for (place, block) in document.blocks.iter().enumerate() {
        let unusable = |why| Ok(Err(Unusable { place, why }));
        let Some(own) = block.cut_offset else { return unusable(Why::Edge) };
        let op = match operation(block) {
            Ok(op) => op,
            Err(why) => return unusable(why),
        };
        let before = place.checked_sub(1).and_then(|before| document.blocks.get(before));
        if before.is_some_and(|before| entry == own && path::jumps(before, block)) {
            return unusable(Why::Origin);
        }
        if !path::is_between_positions(block) {
            return unusable(Why::Path);
        }
        // Under feeds by the turn or by time, the rate of a move is known by the move alone.
        let cuts = matches!(op, Op::StraightFeed(_) | Op::ArcFeed(_));
        let states = cuts || matches!(op, Op::SetFeedRate(_));
        let changes = states && feed.replace(block.feed) != Some(block.feed);
        if cuts && changes {
            let rate = number(block.feed, Unit::Mm);
            stmts.extend(rate.map(|rate| statement(Op::SetFeedRate(rate.into()))));
        }
        if std::mem::replace(&mut entry, own) != own {
            stmts.push(statement(Op::UseToolLengthOffset(Expr::int(own.into()))));
        }
        stmts.push(statement(op));
        if block.time > 0.0 {
            let times = format!("time {:.6}, end {:.6}", block.time, block.timestamp);
            stmts.push(statement(Op::Comment(times.as_str().into())));
        }
        writer.write(&stmts, &modes, &mut text, &mut faults);
        stmts.clear();
        if !faults.is_empty() {
            return unusable(Why::NoCall);
        }
        out.write_all(&text)?;
        text.clear();
    }
    out.flush().map(Ok)
}

fn statement(op: Op) -> Stmt {
    Stmt::new(Span::default(), op)
}

/// The statement of a block.
fn operation(block: &Block) -> Result<Op, Why> {
    let text = |name: &str| block.parameters.get(name).and_then(|value| value.as_str()).ok_or(Why::NoCall);
    let real = |name: &str, unit| {
        let value = block.parameters.get(name).and_then(|value| value.as_f64());
        value.and_then(|value| number(value, unit)).map(Expr::Num).ok_or(Why::NoCall)
    };
    let given = |value: f64, unit| number(value, unit).map(Expr::Num).ok_or(Why::NoCall);
    let name = &*block.function_name;
    Ok(match name {
        "STRAIGHT_TRAVERSE" => Op::StraightTraverse(Move { to: end(block)?, said: true }),
        "STRAIGHT_FEED" => Op::StraightFeed(Move { to: end(block)?, said: true }),
        "ARC_FEED" => {
            let plane = text("plane")?;
            let planes = [Plane::Xy, Plane::Zx, Plane::Yz];
            let plane = planes.into_iter().find(|p| events::plane(*p) == plane).ok_or(Why::NoCall)?;
            let turn = match text("turn")? {
                "clockwise" => Turn::Clockwise,
                "counterclockwise" => Turn::Counterclockwise,
                _ => return Err(Why::NoCall),
            };
            let mut words = [None, None, None];
            for axis in [plane.axes().0, plane.axes().1] {
                words[axis as usize] = Some(real(["i", "j", "k"][axis as usize], Unit::Mm)?);
            }
            let centre = Centre::Point { words, from: CentreFrom::Zero };
            let plane = Fact::Known(plane);
            Op::ArcFeed(Box::new(Arc { plane, turn, to: end(block)?, centre, turns: 0.into(), said: true }))
        }
        "SET_FEED_RATE" => Op::SetFeedRate(given(block.feed, Unit::Mm)?),
        "SET_SPINDLE_SPEED" => Op::SetSpindleSpeed(given(block.speed, Unit::One)?),
        "SELECT_TOOL" => Op::SelectTool(Expr::int(block.tool)),
        "CHANGE_TOOL" => Op::ChangeTool,
        "DWELL" => Op::Dwell(real("seconds", Unit::Second)?),
        "ORIENT_SPINDLE" => Op::OrientSpindle(Some(real("angle", Unit::Degree)?)),
        "MESSAGE" => Op::Message(text("text")?.into()),
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
        _ => return Err(Why::NoCall),
    })
}

/// Where a block ends, along all axes that the document has of it.
fn end(block: &Block) -> Result<Point, Why> {
    let mut to = Point::default();
    let angles = block.rotary.map_or([None; 3], |r| [r.a1, r.b1, r.c1].map(Some));
    let [a, b, c] = angles;
    let places: [Option<f64>; AXES] = [Some(block.x1), Some(block.y1), Some(block.z1), a, b, c];
    for (axis, place) in Axis::ALL.into_iter().zip(places) {
        let Some(place) = place else { continue };
        let unit = if axis.is_rotary() { Unit::Degree } else { Unit::Mm };
        to.set(axis, absolute(number(place, unit).ok_or(Why::NoCall)?));
    }
    Ok(to)
}

/// A number of the document, which has at most six digits after the point.
fn number(value: f64, unit: Unit) -> Option<Num> {
    let millionths = (value * 1e6).round();
    let fits = millionths.abs() < 1e15;
    fits.then(|| Num { mantissa: millionths as i64, scale: 6, point: true, unit }.trimmed())
}
