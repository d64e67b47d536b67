//! Calls that set a mode of the path: how corners are taken, and cutter radius compensation; what they need first.

use ncc_ir::canon::{Modes, PathMode, Plane, Side, Units};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Unit;
use ncc_ir::program::{CutterRadius, Data, DataMode, PathControl, Stmt, ToolLength};

use super::{FIRST, Origin, Writer, arguments, cannot};
use crate::common::quoted::write_whole;

impl Writer {
    /// The call of a path mode, and its tolerance.
    pub(super) fn path_mode(
        &mut self,
        s: &Stmt,
        control: &PathControl,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        let within = control.within.as_ref().map(arguments::literal).transpose()?;
        if within.is_some() && matches!(control.mode, PathMode::ExactStop | PathMode::ExactPath) {
            // An exact mode has no tolerance.
            return Err(cannot(&s.op));
        }
        if let Some(within) = within {
            self.use_units(within.unit, out);
        }
        self.open(s, out);
        out.extend_from_slice(match control.mode {
            PathMode::ExactStop => b"CANON_EXACT_STOP",
            PathMode::ExactPath => b"CANON_EXACT_PATH",
            PathMode::Continuous | PathMode::Tolerance => b"CANON_CONTINUOUS",
            PathMode::Distance
            | PathMode::AxisTolerances
            | PathMode::WithinBlocks
            | PathMode::Dynamics
            | PathMode::Tangential
            | PathMode::SlowCorners
            | PathMode::Tapping => return Err(cannot(&s.op)),
        });
        if let Some(within) = within {
            out.extend_from_slice(b", ");
            self.value(within, "tolerance", s.span, out, diags)?;
        }
        Ok(())
    }

    /// The call that starts cutter radius compensation, by an entry of the table or a diameter.
    pub(super) fn start_compensation(
        &mut self,
        s: &Stmt,
        side: Side,
        radius: &CutterRadius,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        let fault = Fault::EntryFactNeeded { fact: ModeName::Plane };
        let plane = self.at.modes.plane.ok_or(fault)?;
        self.use_plane(plane, out);
        let diameter = match radius {
            CutterRadius::Diameter(d) => Some(arguments::literal(d)?),
            CutterRadius::Entry(_) | CutterRadius::Tool | CutterRadius::InForce => None,
        };
        if let Some(diameter) = diameter {
            self.use_units(diameter.unit, out);
        }
        self.open(s, out);
        out.extend_from_slice(match side {
            Side::Left => b"CANON_SIDE_LEFT, ",
            Side::Right => b"CANON_SIDE_RIGHT, ",
        });
        if let Some(diameter) = diameter {
            out.extend_from_slice(b"CANON_DIAMETER, ");
            self.value(diameter, "diameter", s.span, out, diags)?;
        } else if let CutterRadius::Entry(entry) = radius {
            write_whole(arguments::count(entry, s.op.name())?, out);
        }
        Ok(())
    }

    /// The call of an origin by values: those of the first work offset, while it is active or the next statement activates
    /// it.
    pub(super) fn origin_by_values(
        &mut self,
        s: &Stmt,
        data: &Data,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        let Data::Offset { offset: FIRST, mode: DataMode::Set, words, turn: None } = data else {
            return Err(cannot(&s.op));
        };
        let values: Vec<&Expr> = words.iter().map_while(Option::as_ref).collect();
        let whole = matches!(values.len(), 3 | 6) && values.len() == words.iter().flatten().count();
        if !whole || s.skip.is_some() || self.origin == Some(Origin::Number) {
            return Err(cannot(&s.op));
        }
        let values = values.into_iter().map(arguments::literal).collect::<Result<Vec<_>, _>>()?;
        self.use_units(values[0].unit, out);
        let mut call = Vec::new();
        self.begin(s, "SET_ORIGIN_OFFSETS", &mut call);
        for (place, value) in values.into_iter().enumerate() {
            call.extend_from_slice(if place == 0 { b"" } else { b", " });
            self.value(value, "origin", s.span, &mut call, diags)?;
        }
        self.close(&mut call);
        if self.at.modes.work_offset == Some(FIRST) {
            out.extend_from_slice(&call);
            self.origin = Some(Origin::Values);
        } else {
            self.waiting = Some((call, cannot(&s.op), s.span));
        }
        Ok(())
    }

    /// The call of a length that stands in no table: a number with a decimal point.
    pub(super) fn tool_length(
        &mut self,
        s: &Stmt,
        length: &ToolLength,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        let ToolLength::Value(value) = length else { return Err(cannot(&s.op)) };
        let value = arguments::literal(value)?;
        self.use_units(value.unit, out);
        self.begin(s, "USE_TOOL_LENGTH_OFFSET", out);
        self.value(value, "length", s.span, out, diags)?;
        self.offset_waits = true;
        Ok(())
    }

    /// States the plane, if another one is active.
    pub(super) fn use_plane(&mut self, plane: Plane, out: &mut Vec<u8>) {
        if self.plane != Some(plane) {
            out.extend_from_slice(b"SELECT_PLANE(");
            out.extend_from_slice(arguments::plane(plane));
            self.close(out);
            self.plane = Some(plane);
        }
    }

    /// A statement's unit of length, said first if it is another than the active one.
    #[inline]
    pub(super) fn use_units(&mut self, unit: Unit, out: &mut Vec<u8>) {
        let units = match unit {
            Unit::Mm => Units::Mm,
            Unit::Inch => Units::Inch,
            Unit::One | Unit::Entry | Unit::Degree | Unit::Second => return,
        };
        if self.units != Some(units) {
            out.extend_from_slice(b"USE_LENGTH_UNITS(");
            out.extend_from_slice(arguments::units(units));
            self.close(out);
            self.units = Some(units);
        }
    }

    /// The feed mode that the program assumes, said before the first feed.
    pub(super) fn feed_mode(&mut self, assumed: &Modes, out: &mut Vec<u8>) {
        let mode = self.at.modes.feed_mode.or(assumed.feed_mode);
        if let Some(mode) = mode
            && self.feed_mode != Some(mode)
        {
            out.extend_from_slice(b"SET_FEED_MODE(");
            out.extend_from_slice(arguments::feed_mode(mode));
            self.close(out);
            self.feed_mode = Some(mode);
        }
    }
}
