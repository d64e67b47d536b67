//! Cycles and patterns of positions, as the `ir` text has them; and what goes synchronised with the spindle.

use ncc_ir::canon::{Axis, Spindle, Turn};
use ncc_ir::expr::Expr;
use ncc_ir::program::cycle::{
    Along, Approach, Clearance, Cycle, CycleKind, FineBore, First, Pattern, Row, Shift, Tap,
};
use ncc_ir::program::{Coord, Pitch};

use super::expr::expr;
use super::words::{coord, plane, point, put, return_level, turn};
use crate::common::quoted::write_whole;

/// What a kind of cycle says, in brackets if there is anything.
fn details(words: &[(&str, Option<&Expr>)], out: &mut Vec<u8>) {
    for (word, value) in words {
        if let Some(value) = value {
            put(word, out);
            expr(value, out);
        }
    }
    put(")", out);
}

pub(super) fn pitch(p: &Pitch, out: &mut Vec<u8>) {
    match p {
        Pitch::Stated(e) => expr(e, out),
        Pitch::Feed => put("feed", out),
    }
}

pub(super) fn further_turn(sense: Option<Turn>, out: &mut Vec<u8>) {
    if let Some(sense) = sense {
        put(", ", out);
        put(turn(sense), out);
    }
}

fn spindle(s: Spindle) -> &'static str {
    match s {
        Spindle::Stopped => "stopped",
        Spindle::Clockwise => turn(Turn::Clockwise),
        Spindle::Counterclockwise => turn(Turn::Counterclockwise),
    }
}

fn after(s: Option<Spindle>, out: &mut Vec<u8>) {
    put("after ", out);
    put(s.map_or("as-before", spindle), out);
}

fn clearance(c: &Clearance, out: &mut Vec<u8>) {
    match c {
        Clearance::Stated(e) => expr(e, out),
        Clearance::Parameter => put("parameter", out),
        Clearance::FromReturn => put("return", out),
    }
}

pub(super) fn cycle(c: &Cycle, out: &mut Vec<u8>) {
    put(c.kind.name(), out);
    match &c.kind {
        CycleKind::Drill | CycleKind::Bore { dwell: None, feed_out: None, to_level: false } => {}
        CycleKind::Bore { dwell: None, feed_out: None, to_level: true } => put("(to-level)", out),
        CycleKind::DrillDwell { dwell } => details(&[("(dwell ", Some(dwell))], out),
        CycleKind::Bore { dwell, feed_out, to_level } => {
            let feed = if dwell.is_some() { ", feed-out " } else { "(feed-out " };
            for (word, value) in [("(dwell ", dwell), (feed, feed_out)] {
                if let Some(value) = value {
                    put(word, out);
                    expr(value, out);
                }
            }
            put(if *to_level { ", to-level)" } else { ")" }, out);
        }
        CycleKind::DrillPeck { peck, first, less, clearance: c, pause, settle, dwell } => {
            put("(peck ", out);
            expr(peck, out);
            put(", clearance ", out);
            clearance(c, out);
            let words = [
                (", first ", first.as_ref()),
                (", less ", less.as_ref()),
                (", pause ", pause.as_ref()),
                (", settle ", settle.as_ref()),
                (", dwell ", dwell.as_ref()),
            ];
            details(&words, out);
        }
        CycleKind::DrillBreak { peck, first, less, lift, lift_at_feed, pause, dwell } => {
            put("(peck ", out);
            expr(peck, out);
            put(", lift ", out);
            clearance(lift, out);
            put(if *lift_at_feed { ", at-feed" } else { "" }, out);
            let words = [
                (", first ", first.as_ref()),
                (", less ", less.as_ref()),
                (", pause ", pause.as_ref()),
                (", dwell ", dwell.as_ref()),
            ];
            details(&words, out);
        }
        CycleKind::Tap(tap) => tapping(tap, out),
        CycleKind::FineBore(bore) => fine_boring(bore, out),
        CycleKind::BoreStop(bore) => {
            put("(", out);
            after(bore.after, out);
            further_turn(bore.turn, out);
            if let Some(dwell) = &bore.dwell {
                put(", dwell ", out);
                expr(dwell, out);
            }
            put(if bore.stop { ", program-stop)" } else { ")" }, out);
        }
    }
    put(", ", out);
    put(c.plane.known().map_or("entry", plane), out);
    put(", retract ", out);
    coord(&c.retract, out);
    if let Some(plane) = &c.reference {
        put(", reference ", out);
        coord(plane, out);
    }
    put(", depth ", out);
    coord(&c.depth, out);
    put(", return ", out);
    put(c.return_level.known().map_or("entry", return_level), out);
    if let Some(plane) = &c.return_plane {
        put(", return-plane ", out);
        coord(plane, out);
    }
    put(
        match c.approach {
            Approach::RaiseFirst => ", raise-first",
            Approach::ClearFirst => ", clear-first",
            Approach::PlaneFirst => ", plane-first",
            Approach::RetractFirst => ", retract-first",
        },
        out,
    );
    if let Some(feed) = &c.feed {
        put(", feed ", out);
        expr(feed, out);
    }
}

fn tapping(tap: &Tap, out: &mut Vec<u8>) {
    put("(", out);
    put(turn(tap.turn), out);
    put(", pitch ", out);
    pitch(&tap.pitch, out);
    for (word, value) in [(", dwell ", &tap.dwell), (", back ", &tap.back), (", settle ", &tap.settle)] {
        if let Some(value) = value {
            put(word, out);
            expr(value, out);
        }
    }
    put(", after ", out);
    put(spindle(tap.after), out);
    put(if tap.to_level { ", to-level)" } else { ")" }, out);
}

fn fine_boring(bore: &FineBore, out: &mut Vec<u8>) {
    put("(shift ", out);
    match &bore.shift {
        Shift::Parameter(amount) => {
            put("parameter ", out);
            expr(amount, out);
        }
        Shift::Stated(words) => {
            put("along (", out);
            let words = Axis::ALL.into_iter().zip(words);
            let words = words.filter_map(|(axis, word)| Some((axis, word.as_ref()?)));
            for (place, (axis, value)) in words.enumerate() {
                put(if place > 0 { ", " } else { "" }, out);
                out.push(axis.letter());
                out.push(b' ');
                expr(value, out);
            }
            put(")", out);
        }
    }
    put(", ", out);
    after(bore.after, out);
    further_turn(bore.turn, out);
    details(&[(", dwell ", bore.dwell.as_ref()), (", angle ", bore.angle.as_ref())], out);
}

pub(super) fn pattern(p: &Pattern, out: &mut Vec<u8>) {
    match p {
        Pattern::Circle { centre, first, step, count } => {
            put("centre ", out);
            match centre {
                Some(centre) => pair(centre, out),
                None => put("here", out),
            }
            put(", first ", out);
            match first {
                First::At(first) => pair(first, out),
                First::Polar { radius, angle } => {
                    put("(radius ", out);
                    expr(radius, out);
                    put(", angle ", out);
                    expr(angle, out);
                    put(")", out);
                }
            }
            put(", step ", out);
            expr(step, out);
            put(", count ", out);
            write_whole(u64::from(*count), out);
        }
        Pattern::Line { start, angle, offset, pitch, count } => {
            put("start ", out);
            match start {
                Some(start) => pair(start, out),
                None => put("here", out),
            }
            for (word, value) in [(", angle ", angle), (", offset ", offset), (", pitch ", pitch)] {
                put(word, out);
                expr(value, out);
            }
            put(", count ", out);
            write_whole(u64::from(*count), out);
        }
        Pattern::List(points) => {
            for (at, to) in points.iter().enumerate() {
                put(if at > 0 { ", (" } else { "(" }, out);
                point(to, b"", out);
                put(")", out);
            }
        }
        Pattern::Grid { start, columns, rows, serpentine } => {
            if let Some(start) = start {
                put("start ", out);
                pair(start, out);
                put(", ", out);
            }
            put("columns ", out);
            row(columns, out);
            put(", rows ", out);
            row(rows, out);
            put(if *serpentine { ", serpentine" } else { "" }, out);
        }
    }
}

fn pair([a, b]: &[Coord; 2], out: &mut Vec<u8>) {
    put("(", out);
    coord(a, out);
    put(", ", out);
    coord(b, out);
    put(")", out);
}

fn row(r: &Row, out: &mut Vec<u8>) {
    put("(", out);
    match &r.along {
        Along::Axis(axis) => out.push(axis.letter()),
        Along::Angle(angle) => {
            put("angle ", out);
            expr(angle, out);
        }
    }
    put(", ", out);
    expr(&r.pitch, out);
    put(", ", out);
    write_whole(u64::from(r.count), out);
    put(")", out);
}
