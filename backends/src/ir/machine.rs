//! Statements of the `ir` text about reference points and values of the control's tables.

use ncc_ir::canon::{Axis, Side};
use ncc_ir::program::{CutterRadius, Data, DataMode, Reference, ReferencePoint, ToolValue};

use super::expr::expr;
use super::frame::words;
use super::words::{point, put};
use crate::common::quoted::write_whole;

/// A reference point, the axes that go there, and through which intermediate point.
pub(super) fn reference(r: &Reference, out: &mut Vec<u8>) {
    let (name, number) = match r.point {
        ReferencePoint::Home => ("home", None),
        ReferencePoint::Further(n) => ("further ", Some(n)),
        ReferencePoint::Fixed(n) => ("fixed ", Some(n)),
        ReferencePoint::Stored(n) => ("stored ", Some(n)),
    };
    put(name, out);
    if let Some(number) = number {
        write_whole(u64::from(number), out);
    }
    for (axis, goes) in Axis::ALL.into_iter().zip(r.axes) {
        if goes {
            put(", ", out);
            out.push(axis.letter());
        }
    }
    if !r.via.is_empty() {
        put(", via (", out);
        point(&r.via, b"", out);
        put(")", out);
    }
    put(if r.keeps_length { ", keeps-length" } else { "" }, out);
}

/// A value of a table.
pub(super) fn data(d: &Data, out: &mut Vec<u8>) {
    match d {
        Data::Position(place) => write_whole(u64::from(*place), out),
        Data::ToolInSpindle(tool) => expr(tool, out),
        Data::Offset { offset, mode, words: by, turn } => {
            write_whole(u64::from(*offset), out);
            let mode = match mode {
                DataMode::Set => "",
                DataMode::Add => ", added",
                DataMode::Here => ", here",
            };
            put(mode, out);
            words(&by[..], out);
            if let Some(turn) = turn {
                put(", turned ", out);
                expr(turn, out);
            }
        }
        Data::Tool { entry, which, added, kept, value } => {
            write_whole(u64::from(*entry), out);
            let which = match which {
                ToolValue::Length => ", length, ",
                ToolValue::LengthWear => ", length-wear, ",
                ToolValue::Radius => ", tool-radius, ",
                ToolValue::RadiusWear => ", tool-radius-wear, ",
                ToolValue::OffsetX => ", x-offset, ",
                ToolValue::OffsetY => ", y-offset, ",
            };
            put(which, out);
            put(if *added { "added " } else { "" }, out);
            put(if *kept { "kept " } else { "" }, out);
            expr(value, out);
        }
        Data::Measured { entry, offset, words: by } => {
            write_whole(u64::from(*entry), out);
            if let Some(offset) = offset {
                put(", offset ", out);
                write_whole(u64::from(*offset), out);
            }
            words(&by[..], out);
        }
    }
}

/// Side and radius of cutter radius compensation.
pub(super) fn compensation(side: Side, radius: &CutterRadius, out: &mut Vec<u8>) {
    put(side.name(), out);
    put(", ", out);
    match radius {
        CutterRadius::Entry(entry) => expr(entry, out),
        CutterRadius::Tool => put("tool", out),
        CutterRadius::InForce => put("in-force", out),
        CutterRadius::Diameter(diameter) => {
            put("diameter ", out);
            expr(diameter, out);
        }
    }
}
