//! How points of a contour's plane are written: as words of a move or an arc, from program zero.

use crate::support::walk::Walk;
use crate::support::write::{at, exact, rounded, unit_of};
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Motion, Plane, Turn};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::geometry;
use ncc_ir::geometry::offset_path::Spot;
use ncc_ir::lack::{CompensationLack, ExpandedContour};
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::{Arc, Centre, CentreFrom, Coord, Move, Op, Point, Stmt};
use ncc_ir::source::Span;

/// How points of a plane are written.
pub(super) struct Written<'w> {
    pub(super) walk: &'w Walk,
    pub(super) decimals: u8,
    pub(super) plane: Plane,
}

impl Written<'_> {
    pub(super) fn plane_of(&self, point: &[Option<Nanos>; AXES]) -> Result<[Nanos; 2], Fault> {
        let (first, second, _) = self.plane.axes();
        let at = |axis: Axis| {
            point[axis as usize].ok_or(Fault::PositionUnknown { axis: char::from(axis.letter()) })
        };
        Ok([at(first)?, at(second)?])
    }

    /// Angle of an arc of the contour, radians, and how far it goes along the third axis, mm.
    pub(super) fn climb(
        &self,
        words: &Point,
        from: Spot,
        to: Spot,
        (centre, turn, turns): (Spot, Turn, u32),
    ) -> Result<(f64, f64), Fault> {
        let normal = self.plane.axes().2;
        let along = match words.get(normal) {
            None => 0.0,
            Some(_) => {
                let (at, end) = (&self.walk.at.position, self.walk.at.target(words));
                let fault = || Fault::PositionUnknown { axis: char::from(normal.letter()) };
                let climb = at[normal as usize].zip(end[normal as usize]).map(|(here, end)| end - here);
                mm(climb.ok_or_else(fault)?)
            }
        };
        let of = |spot: Spot| spot.map(nanos);
        let angle = geometry::sweep_degrees(of(from), of(to), of(centre), turn, turns);
        Ok((angle.abs().to_radians(), along))
    }

    pub(super) fn coordinate(&self, axis: Axis, mm: f64) -> Coord {
        let unit = unit_of(axis, self.walk.unit());
        let decimals = if unit == ncc_ir::expr::num::Unit::Inch {
            self.decimals.saturating_add(1)
        } else {
            self.decimals
        };
        absolute(rounded(nanos(mm), decimals, unit))
    }

    /// The same words with coordinates of the plane.
    pub(super) fn spot(&self, spot: Spot, mut to: Point) -> Point {
        let (first, second, _) = self.plane.axes();
        for (axis, mm) in [first, second].into_iter().zip(spot) {
            to.set(axis, self.coordinate(axis, mm));
        }
        to
    }

    /// The words that are none of the plane, from program zero.
    pub(super) fn others(&self, words: &Point) -> Result<Point, Fault> {
        let (first, second, _) = self.plane.axes();
        self.absolute_words(words, |axis| axis != first && axis != second && words.get(axis).is_some())
    }

    /// All words from program zero, and those of both axes of the plane among them.
    pub(super) fn absolute_point(&self, words: &Point) -> Result<Point, Fault> {
        let (first, second, _) = self.plane.axes();
        self.absolute_words(words, |axis| axis == first || axis == second || words.get(axis).is_some())
    }

    /// Where words lead along some axes; an absolute word stays as it is written.
    pub(super) fn absolute_words(&self, words: &Point, along: impl Fn(Axis) -> bool) -> Result<Point, Fault> {
        let target = self.walk.at.target(words);
        let mut point = Point::default();
        for axis in Axis::ALL.into_iter().filter(|axis| along(*axis)) {
            let fault = Fault::PositionUnknown { axis: char::from(axis.letter()) };
            let to = target[axis as usize].ok_or(fault)?;
            let own = |word: &Coord| word.distance.known().or(self.walk.at.modes.distance);
            let absolute = words.get(axis).filter(|word| own(word) == Some(Distance::Absolute));
            point.set(
                axis,
                absolute.map_or_else(|| at(to, axis, self.walk.unit()), crate::support::write::as_absolute),
            );
        }
        Ok(point)
    }

    pub(super) fn arc(&self, to: Point, centre: Spot, ccw: bool, turns: u32) -> Op {
        let (first, second, _) = self.plane.axes();
        let mut words: [Option<Expr>; 3] = [None, None, None];
        for (axis, mm) in [first, second].into_iter().zip(centre) {
            words[axis as usize] = Some(exact(nanos(mm), unit_of(axis, self.walk.unit())).into());
        }
        Op::ArcFeed(Box::new(Arc {
            plane: Fact::Known(self.plane),
            turn: if ccw { Turn::Counterclockwise } else { Turn::Clockwise },
            to,
            centre: Centre::Point { words, from: CentreFrom::Zero },
            turns: turns.into(),
            said: true,
        }))
    }

    /// Puts the end of a held move where it is now known to be.
    pub(super) fn settle(&self, held: &mut Stmt, end: Spot) {
        let to = match &mut held.op {
            Op::StraightTraverse(m) | Op::StraightFeed(m) => &mut m.to,
            Op::ArcFeed(arc) => &mut arc.to,
            _ => return,
        };
        *to = self.spot(end, std::mem::take(to));
    }
}

pub(super) fn cannot<T>(what: ExpandedContour, span: Span) -> Result<T, Diagnostic> {
    Err(Diagnostic::new(Fault::lacks(CompensationLack::Expanded { what }), span))
}

pub(super) fn mm(nanos: Nanos) -> f64 {
    nanos as f64 / ONE as f64
}

pub(super) fn nanos(mm: f64) -> Nanos {
    (mm * ONE as f64).round() as Nanos
}

pub(super) fn straight(motion: Motion, to: Point) -> Op {
    let to = Move { to, said: true };
    match motion {
        Motion::Traverse => Op::StraightTraverse(to),
        Motion::Feed | Motion::Arc(_) | Motion::Cycle => Op::StraightFeed(to),
    }
}
