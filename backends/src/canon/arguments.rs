//! Arguments of canonical calls: coordinates, numbers, names of modes.

use ncc_ir::canon::{Axis, Distance, FeedMode, Plane, Units};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, POW10, Unit};
use ncc_ir::geometry::arc_solver::MOST_SHORT;
use ncc_ir::geometry::{self, ArcFault};
use ncc_ir::lack::WordsLack;
use ncc_ir::program::{Arc, Centre, Coord, Point, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

use super::Writer;
use crate::common::quoted::decimal;

pub(super) fn units(u: Units) -> &'static [u8] {
    match u {
        Units::Mm => b"CANON_UNITS_MM",
        Units::Inch => b"CANON_UNITS_INCHES",
    }
}

/// NIST's names; its XZ is our ZX, with Z as the first axis.
pub(super) fn plane(p: Plane) -> &'static [u8] {
    match p {
        Plane::Xy => b"CANON_PLANE_XY",
        Plane::Zx => b"CANON_PLANE_XZ",
        Plane::Yz => b"CANON_PLANE_YZ",
    }
}

pub(super) fn feed_mode(f: FeedMode) -> &'static [u8] {
    match f {
        FeedMode::PerMinute => b"CANON_PER_MINUTE",
        FeedMode::PerRevolution => b"CANON_PER_REVOLUTION",
        FeedMode::InverseTime => b"CANON_INVERSE_TIME",
    }
}

/// A literal; the canonical stream has no expressions.
pub(super) fn literal(e: &Expr) -> Result<Num, Fault> {
    e.literal().ok_or(Fault::lacks(WordsLack::Expression))
}

/// Whole numbers are below this: the reader takes 18 digits.
const BEYOND: u64 = 1_000_000_000_000_000_000;

/// A whole number that is no less than zero.
pub(super) fn count(e: &Expr, call: &str) -> Result<u64, Fault> {
    let whole = literal(e)?.whole_number().and_then(|n| u64::try_from(n).ok()).filter(|n| *n < BEYOND);
    whole.ok_or(Fault::TargetRange { word: call.into() })
}

/// The unit in which an axis is written.
#[inline]
pub(super) fn unit(axis: Axis, units: Option<Units>) -> Unit {
    match (axis.is_rotary(), units) {
        (true, _) => Unit::Degree,
        (false, Some(Units::Mm)) => Unit::Mm,
        (false, Some(Units::Inch)) => Unit::Inch,
        (false, None) => Unit::Entry,
    }
}

/// The centre of an arc from program zero.
pub(super) fn centre(at: &Tracker, arc: &Arc, axes: [Axis; 2]) -> Result<[Nanos; 2], Fault> {
    // Beyond this the differences of positions leave the range of a nano.
    const FAR: Nanos = Nanos::MAX / 4;
    let near = |p: &Nanos| p.abs() < FAR;
    let start = axes.map(|axis| at.position[axis as usize].filter(near));
    let target = at.target(&arc.to);
    let end = axes.map(|axis| target[axis as usize].filter(near));
    let unknown = |places: [Option<Nanos>; 2]| {
        let axis = if places[0].is_none() { axes[0] } else { axes[1] };
        Fault::PositionUnknown { axis: char::from(axis.letter()) }
    };
    match &arc.centre {
        Centre::Radius(radius) => {
            let [Some(x), Some(y)] = start else { return Err(unknown(start)) };
            let [Some(to_x), Some(to_y)] = end else { return Err(unknown(end)) };
            let radius = at.nanos(radius).ok_or(Fault::lacks(WordsLack::Expression))?;
            geometry::centre_by_radius([x, y], [to_x, to_y], radius, arc.turn, MOST_SHORT).map_err(|fault| {
                match fault {
                    ArcFault::RadiusTooSmall => Fault::ArcRadiusTooSmall,
                    ArcFault::NoWay | ArcFault::NoRadius | ArcFault::Straight => Fault::ArcRadiusNoWay,
                    ArcFault::EndOffCircle { radii, allowed } => Fault::ArcEndOffCircle { radii, allowed },
                }
            })
        }
        Centre::Point { .. } => at.centre(arc).ok_or_else(|| match start {
            [Some(_), Some(_)] => Fault::lacks(WordsLack::Expression),
            [None, _] | [_, None] => unknown(start),
        }),
    }
}

/// A position of nanos in a unit, rounded half away from zero, and whether that is exact.
fn from_nanos(nanos: Nanos, unit: Unit, decimals: u8) -> (Num, bool) {
    let (over, under) = match unit {
        // 25.4 mm to the inch.
        Unit::Inch => (10i128, 254i128),
        Unit::One | Unit::Mm | Unit::Entry | Unit::Degree | Unit::Second => (1, 1),
    };
    let step = under * i128::from(POW10[9 - usize::from(decimals.min(9))]);
    let value = i128::from(nanos) * over;
    let half = if value < 0 { -(step / 2) } else { step / 2 };
    let mantissa = (value + half) / step;
    let exact = mantissa * step == value;
    (Num { mantissa: mantissa as i64, scale: decimals.min(9), point: true, unit }.trimmed(), exact)
}

/// Writes a number with at least one digit after the point and no needless zeros.
#[inline]
fn put(n: Num, out: &mut Vec<u8>) {
    let n = Num { point: true, ..n.trimmed() };
    decimal(n, out);
    if n.scale == 0 {
        out.push(b'0');
    }
}

impl Writer {
    fn digits(&self, unit: Unit) -> u8 {
        match unit {
            Unit::Mm | Unit::Entry => self.decimals.mm,
            Unit::Inch => self.decimals.inch,
            Unit::Degree => self.decimals.degree,
            Unit::Second => self.decimals.second,
            Unit::One => self.decimals.speed,
        }
    }

    /// Writes the argument of an axis: its word, or where it stands.
    #[inline]
    pub(super) fn axis(
        &self,
        axis: Axis,
        to: &Point,
        s: &Stmt,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        let Some(coord) = to.get(axis) else {
            let waits = axis == Axis::Z && self.offset_waits;
            let unit = unit(axis, self.units);
            let stands = self.at.position[axis as usize]
                .filter(|_| !waits && unit != Unit::Entry)
                .map(|nanos| from_nanos(nanos, unit, self.digits(unit)));
            match stands {
                Some((n, true)) => put(n, out),
                _ => out.push(b'_'),
            }
            return Ok(());
        };
        self.coordinate(axis, coord, s, out, diags)
    }

    #[inline]
    fn coordinate(
        &self,
        axis: Axis,
        coord: &Coord,
        s: &Stmt,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        let word = axis_name(axis);
        match coord.distance.known().or(self.at.modes.distance) {
            None => Err(Fault::EntryFactNeeded { fact: ModeName::Distance }),
            Some(Distance::Absolute) => self.value(literal(&coord.value)?, word, s.span, out, diags),
            Some(Distance::Incremental) => {
                let by = literal(&coord.value)?;
                let from = self.at.position[axis as usize];
                let Some(from) = from else {
                    return Err(Fault::PositionUnknown { axis: char::from(axis.letter()) });
                };
                let target = self.at.nanos(&Expr::Num(by)).and_then(|by| from.checked_add(by));
                let target = target.ok_or(Fault::TargetRange { word: word.into() })?;
                self.computed(target, unit(axis, self.units), word, s.span, out, diags)
            }
        }
    }

    /// Writes a literal, with its own digits where the text's unit and resolution allow.
    #[inline]
    pub(super) fn value(
        &self,
        n: Num,
        word: &str,
        span: Span,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        let in_force = match (n.unit, self.units) {
            (Unit::One | Unit::Degree | Unit::Second, _)
            | (Unit::Mm, Some(Units::Mm))
            | (Unit::Inch, Some(Units::Inch))
            | (Unit::Entry, None) => n.unit,
            (Unit::Entry, Some(units)) if n.is_zero() || self.at.modes.units == Some(units) => n.unit,
            (Unit::Entry, Some(_)) => return Err(Fault::EntryFactNeeded { fact: ModeName::Units }),
            (Unit::Mm, Some(Units::Inch)) => Unit::Inch,
            (Unit::Inch, Some(Units::Mm)) => Unit::Mm,
            (Unit::Mm | Unit::Inch, None) => return Err(Fault::EntryFactNeeded { fact: ModeName::Units }),
        };
        let decimals = match (in_force, self.units) {
            (Unit::Entry, Some(Units::Inch)) => self.decimals.inch,
            _ => self.digits(in_force),
        };
        let n = n.trimmed();
        // The digit that stands after every point is one of the 18 that can be read back.
        let most = POW10[if n.scale == 0 { 17 } else { 18 }];
        if n.mantissa.unsigned_abs() >= most as u64 {
            return Err(Fault::TargetRange { word: word.into() });
        }
        if in_force == n.unit && n.scale <= decimals {
            put(n, out);
            return Ok(());
        }
        if in_force == n.unit {
            // Too many digits, of which the last one is not zero.
            let step = i128::from(POW10[usize::from((n.scale - decimals).min(18))]);
            let half = if n.mantissa < 0 { -(step / 2) } else { step / 2 };
            let mantissa = ((i128::from(n.mantissa) + half) / step) as i64;
            self.rounded(Num { mantissa, scale: decimals, ..n }, word, span, out, diags);
            return Ok(());
        }
        let nanos = n.nanos(false).ok_or(Fault::TargetRange { word: word.into() })?;
        self.computed(nanos, in_force, word, span, out, diags)
    }

    /// Writes a value that had to be computed.
    pub(super) fn computed(
        &self,
        nanos: Nanos,
        unit: Unit,
        word: &str,
        span: Span,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        if unit == Unit::Entry {
            return Err(Fault::EntryFactNeeded { fact: ModeName::Units });
        }
        match from_nanos(nanos, unit, self.digits(unit)) {
            (n, true) => put(n, out),
            (n, false) => self.rounded(n, word, span, out, diags),
        }
        Ok(())
    }

    fn rounded(&self, n: Num, word: &str, span: Span, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let start = out.len();
        put(n, out);
        let written = String::from_utf8_lossy(&out[start..]).into();
        diags.push(Diagnostic::new(Fault::Rounded { word: word.into(), written }, span));
    }
}

fn axis_name(axis: Axis) -> &'static str {
    ["X", "Y", "Z", "A", "B", "C"][axis as usize]
}
