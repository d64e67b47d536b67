//! Statements of the `ir` text, each without its block's marks.

use ncc_ir::canon::{Distance, FeedMode, Modes, Motion, SpindleMode, Turn, Units};
use ncc_ir::expr::Expr;
use ncc_ir::program::{
    Arc, ArcForm, Call, Centre, CentreFrom, Control, Coord, Op, Output, Piece, Shape, ToolLength,
};

use super::cycle::{cycle, further_turn, pattern, pitch};
use super::expr::{expr, sizes, target, var};
use super::frame::{axis_words, filled, frame, slot};
use super::machine;
use super::polar::{polar_point, pole, rotary_ways};
use super::words::{coord, further, name, plane, point, put, return_level, text_argument, turn};
use crate::common::quoted::write_whole;

/// Writes what a statement does; of a control statement what stands before its body.
pub(super) fn op(op: &Op, out: &mut Vec<u8>) {
    let said = match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) => m.said,
        Op::ArcFeed(arc) => arc.said,
        Op::ArcForm(arc) => arc.said,
        Op::UseToolEdge { said, .. } => *said,
        Op::Polar(polar) => {
            polar_point(polar, out);
            return self::op(&polar.op, out);
        }
        Op::Assign(to, value) => {
            target(to, out);
            put(" = ", out);
            return expr(value, out);
        }
        Op::Control(c) => return control(c, out),
        Op::Comment(_)
        | Op::NoEffect(_)
        | Op::Blank
        | Op::Lines(_)
        | Op::UseLengthUnits(_)
        | Op::SetDistanceMode(_)
        | Op::SelectPlane(_)
        | Op::SetFeedMode(_)
        | Op::SetReturnLevel(_)
        | Op::SetOriginOffsets(_)
        | Op::ClearFrame(_)
        | Op::SetFrame(_)
        | Op::SetSlot(_)
        | Op::SetPosition(_)
        | Op::UseOriginShift(_)
        | Op::UseMachineCoordinates { .. }
        | Op::Probe(_)
        | Op::Detour(_)
        | Op::GoToReference(_)
        | Op::SetData(_)
        | Op::SetPole(_)
        | Op::RepeatBlocks(_)
        | Op::StartCutterRadiusCompensation { .. }
        | Op::StopCutterRadiusCompensation
        | Op::UseToolCentrePoint(_)
        | Op::OrientToolAxis(_)
        | Op::SetMotionControlMode(_)
        | Op::ExactStop
        | Op::TurnRotaryAxes(_)
        | Op::Corner { .. }
        | Op::Advise(_)
        | Op::SetFeedRate(_)
        | Op::SetSpindleSpeed(_)
        | Op::SetSpindleMode(_)
        | Op::LimitSpindleSpeed(_)
        | Op::SelectTool(_)
        | Op::SelectToolByName(_)
        | Op::ChangeTool
        | Op::UseToolLengthOffset(_)
        | Op::UseToolLength(_)
        | Op::StartSpindleClockwise
        | Op::StartSpindleCounterclockwise
        | Op::StopSpindleTurning
        | Op::SynchronisedFeed(_)
        | Op::OrientSpindle(_)
        | Op::MachineFunction(_)
        | Op::FloodOn
        | Op::MistOn
        | Op::CoolantOff
        | Op::Dwell(_)
        | Op::StartCycle(_)
        | Op::Pattern(_)
        | Op::EndCycle
        | Op::ProgramStop
        | Op::OptionalProgramStop
        | Op::ProgramEnd
        | Op::BeginAgain
        | Op::Message(_)
        | Op::MessageOf(_)
        | Op::Output(_)
        | Op::Alarm(_)
        | Op::Declare(_)
        | Op::Call(_)
        | Op::Return
        | Op::Goto(_)
        | Op::Leave
        | Op::NextTurn
        | Op::Label(_) => false,
    };
    if said {
        put("said ", out);
    }
    put(op.name(), out);
    out.push(b'(');
    arguments(op, out);
    out.push(b')');
}

/// A text with values in it.
fn with_values(pieces: &[Piece], out: &mut Vec<u8>) {
    for (place, piece) in pieces.iter().enumerate() {
        put(if place > 0 { ", " } else { "" }, out);
        match piece {
            Piece::Text(text) => text_argument(text, out),
            Piece::Value { value, digits, short, places } => {
                expr(value, out);
                if *places > 0 {
                    put(" places ", out);
                    write_whole(u64::from(*places), out);
                }
                put(" digits ", out);
                write_whole(u64::from(*digits), out);
                put(if *short { " short" } else { "" }, out);
            }
        }
    }
}

fn arguments(op: &Op, out: &mut Vec<u8>) {
    match op {
        Op::Comment(text)
        | Op::NoEffect(text)
        | Op::Message(text)
        | Op::MachineFunction(text)
        | Op::SelectToolByName(text) => text_argument(text, out),
        Op::SetMotionControlMode(control) => {
            text_argument(control.mode.name(), out);
            let lengths: Vec<Expr> = control.within.iter().chain(&control.rapids).cloned().collect();
            further(&lengths, out);
            if let Some(merged) = &control.merged {
                put(", merged ", out);
                expr(merged, out);
            }
        }
        Op::Advise(advice) => {
            text_argument(advice.kind.name(), out);
            put(", ", out);
            text_argument(advice.value_name(), out);
            further(advice.amount.as_slice(), out);
        }
        Op::SetSpindleMode(SpindleMode::Turns) => text_argument("turns", out),
        Op::SetSpindleMode(SpindleMode::Surface) => text_argument("surface", out),
        Op::UseLengthUnits(u) => put(units(*u), out),
        Op::SetDistanceMode(d) => put(distance(*d), out),
        Op::SelectPlane(p) => put(plane(*p), out),
        Op::SetFeedMode(f) => put(feed_mode(*f), out),
        Op::SetReturnLevel(r) => put(return_level(*r), out),
        Op::SetOriginOffsets(n) => write_whole(u64::from(*n), out),
        Op::ClearFrame(s) => put(slot(*s), out),
        Op::SetFrame(f) => frame(f, out),
        Op::SetSlot(s) => filled(s, out),
        Op::UseToolCentrePoint(on) | Op::UseOriginShift(on) => put(if *on { "on" } else { "off" }, out),
        Op::OrientToolAxis(toward) => put(toward.map_or("", |toward| toward.name()), out),
        Op::StartCutterRadiusCompensation { side, radius } => machine::compensation(*side, radius, out),
        Op::SetPosition(words) => axis_words(&words[..], "", out),
        Op::UseToolEdge { edge: e, .. }
        | Op::SetFeedRate(e)
        | Op::SetSpindleSpeed(e)
        | Op::LimitSpindleSpeed(e)
        | Op::SelectTool(e)
        | Op::UseToolLengthOffset(e)
        | Op::Corner { size: e, .. }
        | Op::Dwell(e) => expr(e, out),
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) => {
            point(&m.to, b"", out);
        }
        Op::SynchronisedFeed(m) => {
            point(&m.to, b", ", out);
            put("pitch ", out);
            pitch(&m.pitch, out);
            put(if m.chuck { ", chuck" } else { "" }, out);
            further_turn(m.turn, out);
            put(if m.back { ", back" } else { "" }, out);
        }
        Op::OrientSpindle(angle) => angle.iter().for_each(|angle| expr(angle, out)),
        Op::ArcFeed(a) => arc(a, out),
        Op::ArcForm(a) => arc_form(a, out),
        Op::StartCycle(c) => cycle(c, out),
        Op::Pattern(p) => pattern(p, out),
        Op::Call(c) => call(c, out),
        Op::Goto(label) | Op::Label(label) => name(label, out),
        Op::RepeatBlocks(r) => {
            name(&r.from, out);
            if let Some(to) = &r.to {
                put(" to ", out);
                name(to, out);
            }
            put(", times ", out);
            expr(&r.times, out);
        }
        Op::UseMachineCoordinates { length } => put(if *length { "" } else { "no-length" }, out),
        Op::Probe(probe) => {
            put(if probe.away { "no-contact" } else { "contact" }, out);
            put(if probe.error { ", or-error" } else { "" }, out);
        }
        Op::Detour(detour) => put(detour.name(), out),
        Op::GoToReference(r) => machine::reference(r, out),
        Op::SetData(d) => machine::data(d, out),
        Op::UseToolLength(length) => match &**length {
            ToolLength::Value(value) | ToolLength::Added(value) | ToolLength::AddedEntry(value) => {
                expr(value, out);
            }
            ToolLength::Offsets { words, .. } => axis_words(&words[..], "", out),
        },
        Op::SetPole(set) => pole(set, out),
        Op::TurnRotaryAxes(ways) => rotary_ways(ways, out),
        Op::Declare(declare) => {
            put(declare.kind.name(), out);
            put(", ", out);
            var(&declare.var, out);
            if !declare.sizes.is_empty() {
                put("[", out);
                sizes(&declare.sizes, out);
                put("]", out);
            }
            for value in &declare.initial {
                put(", ", out);
                match value {
                    Some(value) => expr(value, out),
                    None => put("none", out),
                }
            }
        }
        Op::MessageOf(pieces) => with_values(pieces, out),
        Op::Output(output) => {
            if let Output::Line(pieces) = &**output {
                with_values(pieces, out);
            }
        }
        Op::Alarm(alarm) => {
            text_argument(&alarm.text, out);
            further(alarm.number.as_slice(), out);
        }
        Op::Polar(_)
        | Op::Blank
        | Op::Lines(_)
        | Op::ExactStop
        | Op::StopCutterRadiusCompensation
        | Op::ChangeTool
        | Op::StartSpindleClockwise
        | Op::StartSpindleCounterclockwise
        | Op::StopSpindleTurning
        | Op::FloodOn
        | Op::MistOn
        | Op::CoolantOff
        | Op::EndCycle
        | Op::ProgramStop
        | Op::OptionalProgramStop
        | Op::ProgramEnd
        | Op::BeginAgain
        | Op::Return
        | Op::Leave
        | Op::NextTurn
        | Op::Assign(..)
        | Op::Control(_) => {}
    }
}

/// Writes the line of facts that were assumed.
pub(super) fn assumed(m: &Modes, out: &mut Vec<u8>) {
    let turned = |motion| match motion {
        Motion::Traverse => "traverse",
        Motion::Feed => "feed",
        Motion::Arc(Turn::Clockwise) => "arc clockwise",
        Motion::Arc(Turn::Counterclockwise) => "arc counterclockwise",
        Motion::Cycle => "cycle",
    };
    let facts = [
        m.motion.map(|v| ("motion ", turned(v).to_owned())),
        m.distance.map(|v| ("distance ", distance(v).to_owned())),
        m.units.map(|v| ("units ", units(v).to_owned())),
        m.plane.map(|v| ("plane ", plane(v).to_owned())),
        m.feed_mode.map(|v| ("feed-mode ", feed_mode(v).to_owned())),
        m.return_level.map(|v| ("return-level ", return_level(v).to_owned())),
        m.work_offset.map(|v| ("work-offset ", v.to_string())),
        m.length_offset.map(|v| ("length-offset ", v.to_string())),
        m.no_origin_shift.map(|v| ("no-origin-shift ", v.to_string())),
    ];
    put("assumed(", out);
    for (place, (fact, value)) in facts.into_iter().flatten().enumerate() {
        put(if place > 0 { ", " } else { "" }, out);
        put(fact, out);
        put(&value, out);
    }
    put(")", out);
}

fn arc(a: &Arc, out: &mut Vec<u8>) {
    put(a.plane.known().map_or("entry", plane), out);
    put(", ", out);
    put(turn(a.turn), out);
    put(", ", out);
    point(&a.to, b", ", out);
    match &a.centre {
        Centre::Radius(radius) => {
            put("radius ", out);
            expr(radius, out);
        }
        Centre::Point { words, from } => {
            put("centre(", out);
            put(
                match from {
                    CentreFrom::Start => "start",
                    CentreFrom::Zero => "zero",
                },
                out,
            );
            for (word, letter) in words.iter().zip([", I ", ", J ", ", K "]) {
                if let Some(value) = word {
                    put(letter, out);
                    expr(value, out);
                }
            }
            put(")", out);
        }
    }
    if !a.turns.is_none() {
        put(", turns ", out);
        expr(&a.turns.0, out);
    }
}

fn arc_form(a: &ArcForm, out: &mut Vec<u8>) {
    put(a.plane.known().map_or("entry", plane), out);
    put(", ", out);
    point(&a.to, b", ", out);
    let about = |words: &[Option<Coord>; 3], out: &mut Vec<u8>| {
        put("centre(", out);
        let mut first = true;
        for (word, letter) in words.iter().zip(["I ", "J ", "K "]) {
            if let Some(word) = word {
                put(if first { "" } else { ", " }, out);
                first = false;
                put(letter, out);
                coord(word, out);
            }
        }
        put(")", out);
    };
    let opened = |sense, angle: &Expr, out: &mut Vec<u8>| {
        put(turn(sense), out);
        put(", angle ", out);
        expr(angle, out);
    };
    match &a.shape {
        Shape::Angle { turn, angle } => opened(*turn, angle, out),
        Shape::AngleAbout { turn, angle, centre } => {
            opened(*turn, angle, out);
            put(" about ", out);
            about(centre, out);
        }
        Shape::Mixed { turn: sense, centre } => {
            put(turn(*sense), out);
            put(", ", out);
            about(centre, out);
        }
        Shape::Through(via) => {
            put("through(", out);
            point(via, b"", out);
            put(")", out);
        }
        Shape::Tangent => put("tangent", out),
    }
    if a.turns > 0 {
        put(", turns ", out);
        write_whole(u64::from(a.turns), out);
    }
}

fn call(c: &Call, out: &mut Vec<u8>) {
    name(&c.name, out);
    if c.times != 1 {
        put(", times ", out);
        write_whole(u64::from(c.times), out);
    }
    if c.shared {
        put(", shared", out);
    }
    further(&c.arguments, out);
}

fn control(c: &Control, out: &mut Vec<u8>) {
    match c {
        Control::Repeat { times, .. } => {
            put("repeat ", out);
            expr(times, out);
        }
        Control::Loop { .. } => put("loop", out),
        Control::While { condition, .. } => {
            put("while ", out);
            expr(condition, out);
        }
        Control::Until { condition, .. } => {
            put("until ", out);
            expr(condition, out);
        }
        Control::For { variable, from, to, step, .. } => {
            put("for ", out);
            var(variable, out);
            put(" = ", out);
            expr(from, out);
            put(" to ", out);
            expr(to, out);
            put(" step ", out);
            expr(step, out);
        }
        Control::If { condition, .. } => {
            put("if ", out);
            expr(condition, out);
        }
    }
}

fn units(u: Units) -> &'static str {
    match u {
        Units::Mm => "mm",
        Units::Inch => "inch",
    }
}

fn distance(d: Distance) -> &'static str {
    match d {
        Distance::Absolute => "absolute",
        Distance::Incremental => "incremental",
    }
}

fn feed_mode(f: FeedMode) -> &'static str {
    match f {
        FeedMode::PerMinute => "per-minute",
        FeedMode::PerRevolution => "per-revolution",
        FeedMode::InverseTime => "inverse-time",
    }
}
