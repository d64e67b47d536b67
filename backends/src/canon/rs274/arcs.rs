//! Arcs: the call of one, with its centre in the plane and its number of turns.

use std::fmt::Write;

use ncc_ir::canon::{Axis, Turn};
use ncc_ir::diag::Fault;
use ncc_ir::geometry::{self, ArcFault};
use ncc_ir::lack::ArcsLack;
use ncc_ir::program::{Arc, Centre};

use super::{Printer, cannot};

impl Printer<'_> {
    pub(super) fn arc(&mut self, arc: &Arc) -> Result<(), Fault> {
        let plane = self.at.plane(arc.plane).ok_or_else(|| cannot(ArcsLack::NoPlane))?;
        let (first, second, normal) = plane.axes();
        let (here, to) = (self.here()?, self.target(&arc.to)?);
        let start = [here[first as usize], here[second as usize]];
        let end = [to[first as usize], to[second as usize]];
        let centre = match &arc.centre {
            Centre::Point { .. } => self.at.centre(arc).ok_or_else(|| cannot(ArcsLack::CentreUnknown))?,
            Centre::Radius(radius) => {
                let radius = self.at.nanos(radius).ok_or_else(|| cannot(ArcsLack::RadiusUnknown))?;
                geometry::centre_by_radius(start, end, radius, arc.turn, self.arcs.short(self.inch()))
                    .map_err(|fault| match fault {
                        ArcFault::RadiusTooSmall => Fault::ArcRadiusTooSmall,
                        ArcFault::NoWay | ArcFault::NoRadius | ArcFault::Straight => Fault::ArcRadiusNoWay,
                        ArcFault::EndOffCircle { radii, allowed } => {
                            Fault::ArcEndOffCircle { radii, allowed }
                        }
                    })?
            }
        };
        self.arcs.check(geometry::radii(start, end, centre), self.inch()).map_err(|fault| match fault {
            ArcFault::EndOffCircle { radii, allowed } => Fault::ArcEndOffCircle { radii, allowed },
            ArcFault::RadiusTooSmall | ArcFault::NoWay | ArcFault::NoRadius | ArcFault::Straight => {
                Fault::ArcRadiusTooSmall
            }
        })?;
        let turns = i64::from(arc.turns.number().unwrap_or(0)) + 1;
        let turns = if arc.turn == Turn::Clockwise { -turns } else { turns };
        self.rate_of_arc([start, end, centre], turns, to[normal as usize] - here[normal as usize])?;
        let shown = |axis: Axis, nanos| self.shown(axis as usize, nanos);
        let [e1, e2, c1, c2, n] = [
            shown(first, end[0]),
            shown(second, end[1]),
            shown(first, centre[0]),
            shown(second, centre[1]),
            shown(normal, to[normal as usize]),
        ];
        let [a, b, c] = [3, 4, 5].map(|axis| self.shown(axis, to[axis]));
        let _ = writeln!(
            self.out,
            "ARC_FEED({e1:.4}, {e2:.4}, {c1:.4}, {c2:.4}, {turns}, {n:.4}, {a:.4}, {b:.4}, {c:.4})"
        );
        Ok(())
    }
}
