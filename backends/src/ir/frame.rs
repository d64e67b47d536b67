//! Slots of the coordinate chain and steps of the chain of frames, as the `ir` text has them.

use ncc_ir::canon::Axis;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Frame, FrameSlot, FrameStep, Slot};

use super::expr::expr;
use super::words::{coord, plane, put};

/// Values along axes, separated by commas; `before` is written before the first.
pub(super) fn axis_words(words: &[Option<Expr>], before: &str, out: &mut Vec<u8>) {
    let mut before = before;
    for (axis, word) in Axis::ALL.into_iter().zip(words) {
        if let Some(value) = word {
            put(before, out);
            before = ", ";
            out.push(axis.letter());
            put(" ", out);
            expr(value, out);
        }
    }
}

/// The values of a slot of the coordinate chain.
pub(super) fn filled(s: &Slot, out: &mut Vec<u8>) {
    match s {
        Slot::Shift { origin, axes } => {
            put(if *origin { "shift" } else { "local" }, out);
            axis_words(&axes[..], ", ", out);
        }
        Slot::Rotation { plane: p, centre, angle } => {
            put(p.known().map_or("entry", plane), out);
            axis_words(&centre[..], ", ", out);
            put(", angle ", out);
            coord(angle, out);
        }
        Slot::Scale { centre, factors } => {
            put("centre(", out);
            axis_words(&centre[..], "", out);
            put(")", out);
            axis_words(&factors[..], ", ", out);
        }
        Slot::Mirror(lines) => axis_words(&lines[..], "", out),
        Slot::Tilt(tilt) => {
            axis_words(&tilt.origin, "", out);
            if tilt.origin.iter().any(Option::is_some) {
                put(", ", out);
            }
            put("about", out);
            for (about, angle) in tilt.about.iter().zip(&tilt.angles) {
                put(" ", out);
                out.push(about.letter());
                put(" ", out);
                expr(angle, out);
            }
        }
        Slot::NoMirror(axes) => {
            let mut before = "";
            for (axis, _) in Axis::ALL.into_iter().zip(axes).filter(|(_, over)| **over) {
                put(before, out);
                before = ", ";
                out.push(axis.letter());
            }
        }
    }
}

/// Values along axes, each after a comma.
pub(super) fn words(words: &[Option<Expr>], out: &mut Vec<u8>) {
    for (axis, word) in Axis::ALL.into_iter().zip(words) {
        if let Some(value) = word {
            put(", ", out);
            out.push(axis.letter());
            put(" ", out);
            expr(value, out);
        }
    }
}

pub(super) fn frame(f: &Frame, out: &mut Vec<u8>) {
    match &f.step {
        FrameStep::Translate(by) => {
            put("translate", out);
            words(&by[..], out);
        }
        FrameStep::Rotate { plane: p, angle } => {
            put("rotate, ", out);
            put(p.known().map_or("entry", plane), out);
            put(", ", out);
            expr(angle, out);
        }
        FrameStep::Scale(by) => {
            put("scale", out);
            words(&by[..], out);
        }
        FrameStep::Mirror(axes) => {
            put("mirror", out);
            for (axis, turned) in Axis::ALL.into_iter().zip(axes) {
                if *turned {
                    put(", ", out);
                    out.push(axis.letter());
                }
            }
        }
    }
}

pub(super) fn slot(s: FrameSlot) -> &'static str {
    match s {
        FrameSlot::Shift => "shift",
        FrameSlot::Local => "local",
        FrameSlot::Rotation => "rotation",
        FrameSlot::Scale => "scale",
        FrameSlot::Mirror => "mirror",
        FrameSlot::Polar => "polar",
        FrameSlot::Tilt => "tilt",
        FrameSlot::Chain => "chain",
    }
}
