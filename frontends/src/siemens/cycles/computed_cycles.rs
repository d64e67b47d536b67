//! Lowering of drilling cycles of which arguments are computed.
//!
//! What a written argument is refused for is found when the program runs: planes that are not one above the other end
//! it with the cycle's own alarm 61101 (reference, 9).
//!
//! Refused: other arguments than planes and depths.

use ncc_dialects::{CallKind, ParameterRole as Role};
use ncc_ir::canon::Fact;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Binary, Expr, Node, Unary};
use ncc_ir::program::cycle::{Clearance, Cycle, CycleKind, absolute, clearance_by_depth};
use ncc_ir::program::{Alarm, Control, Op, Stmt};
use ncc_ir::unsupported::CycleUnsupported;

use super::drilling::Arguments;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::number::unit_of;
use crate::siemens::lower::Lower;

impl Lower {
    /// A depth: absolute, or below the reference plane.
    fn computed_depth(
        &mut self,
        a: &Arguments,
        [to, by]: [Role; 2],
        reference: &Expr,
        src: Source,
        out: &mut Batch,
    ) -> Option<Expr> {
        if !self.is_given(a, by) {
            return self.needed_value(a, to, src, out);
        }
        if a.get(to).is_some() {
            let (first, second) = (a.name(to).into(), a.name(by).into());
            let what = CycleUnsupported::TwoComputedDepths { first, second };
            self.not_supported(&a.row.name, what, a.at(by), out);
            return None;
        }
        let down = self.value(a, by, src, out)?;
        Some(reference.minus(&down))
    }

    /// A cycle of which planes or depths are computed; `None` if it is refused (reported).
    pub(in crate::siemens) fn computed_cycle(
        &mut self,
        a: &Arguments,
        src: Source,
        out: &mut Batch,
    ) -> Option<Cycle> {
        let plane = self.plane(a.span, out);
        let return_plane = self.needed_value(a, Role::ReturnPlane, src, out)?;
        let reference = match a.get(Role::ReferencePlane) {
            Some(_) => self.value(a, Role::ReferencePlane, src, out)?,
            None => Expr::int(0),
        };
        // Its sign is not known where it is computed.
        let safety = match self.argument(a, Role::SafetyDistance, src, out) {
            Some(safety) if safety.mantissa < 0 => return self.out_of_range(a, Role::SafetyDistance, out),
            Some(safety) if safety.is_zero() => None,
            Some(safety) => Some(Expr::Num(safety)),
            None if a.get(Role::SafetyDistance).is_some() => return None,
            None => None,
        };
        let level = safety.as_ref().map_or_else(|| reference.clone(), |safety| reference.plus(safety));
        let depth = self.computed_depth(a, [Role::Depth, Role::RelativeDepth], &reference, src, out)?;
        let dwell = self.time(a, Role::Dwell, src, out);
        let binary = |operator, x: &Expr, y: &Expr| Expr::binary(operator, x.operand(), y.operand());
        let less = |x: &Expr, y: &Expr| binary(Binary::Less, x, y);
        let mut wrong = Expr::binary(Binary::Or, less(&return_plane, &reference), less(&reference, &depth));
        if self.is_given(a, Role::RelativeDepth) {
            let higher = less(&reference, &return_plane);
            let level = Expr::Node(Box::new(Node::Unary(Unary::Not, higher)));
            wrong = Expr::binary(Binary::Or, wrong, level);
        }
        let (mut feed, mut speed) = (None, None);
        let kind = match a.row.kind {
            CallKind::Drill => CycleKind::Drill,
            CallKind::DrillDwell => dwell.map_or(CycleKind::Drill, |dwell| CycleKind::DrillDwell { dwell }),
            CallKind::Bore if a.row.place(Role::FeedIn).is_none() => {
                CycleKind::Bore { dwell, feed_out: None, to_level: false }
            }
            CallKind::DrillPeck => {
                let roles = [Role::FirstDepth, Role::RelativeFirstDepth];
                let first = self.computed_depth(a, roles, &reference, src, out)?;
                let stroke = match self.is_given(a, Role::RelativeFirstDepth) {
                    true => self.value(a, Role::RelativeFirstDepth, src, out)?,
                    false => reference.minus(&first),
                };
                wrong = Expr::binary(Binary::Or, wrong, less(&first, &depth));
                let none = binary(Binary::LessOrEqual, &reference, &first);
                wrong = Expr::binary(Binary::Or, wrong, none);
                let first = safety.as_ref().map(|safety| stroke.plus(safety));
                let planes = [&reference, &depth];
                self.computed_pecks(a, planes, (stroke, first), dwell, src, out)?
            }
            CallKind::Tap => {
                self.planes_alone(a, out)?;
                let unit = unit_of(self.units(a.span, out));
                self.chuck_tap(a, unit, dwell, out)?
            }
            CallKind::TapRigid => {
                self.planes_alone(a, out)?;
                let unit = unit_of(self.units(a.span, out));
                let (kind, own) = self.rigid_tap(a, unit, dwell, src, out)?;
                speed = own;
                kind
            }
            CallKind::BoreFine => {
                self.planes_alone(a, out)?;
                self.fine_bore(a, plane.known(), dwell, src, out)?
            }
            CallKind::BoreStop => {
                self.planes_alone(a, out)?;
                self.stop_bore(a, dwell, out)?
            }
            CallKind::Bore => {
                self.planes_alone(a, out)?;
                let (kind, into) = self.bore_by_feeds(a, dwell, src, out)?;
                feed = Some(into);
                kind
            }
            CallKind::Line | CallKind::Circle | CallKind::Grid | CallKind::List => return None,
        };
        if self.now.failed {
            return None;
        }
        let number = self.settings.dialect.cycles.planes_alarm;
        let alarm = Alarm { number: number.map(|number| Expr::int(number.into())), text: "".into() };
        let then = vec![Stmt::new(a.span, Op::Alarm(Box::new(alarm)))];
        let check = Control::If { condition: wrong, then, otherwise: Vec::new() };
        self.push(a.span, Op::Control(Box::new(check)), out);
        self.speed_of_tap(speed, a.span, out);
        Some(Cycle {
            kind,
            plane,
            retract: absolute(level),
            reference: safety.map(|_| absolute(reference)),
            depth: absolute(depth),
            return_level: Fact::Entry,
            return_plane: Some(absolute(return_plane)),
            approach: self.settings.approach(),
            feed,
        })
    }

    /// Of a cycle that does something with the spindle, or has feeds of its own, planes and depths alone may be
    /// computed; `None` if another argument is (reported).
    fn planes_alone(&mut self, a: &Arguments, out: &mut Batch) -> Option<()> {
        const PLANES: [Role; 5] =
            [Role::ReturnPlane, Role::ReferencePlane, Role::SafetyDistance, Role::Depth, Role::RelativeDepth];
        for (given, parameter) in a.given.iter().zip(&a.row.parameters) {
            let Some(given) = given.filter(|given| given.computed.is_some()) else { continue };
            if !parameter.role.is_some_and(|role| PLANES.contains(&role)) {
                let what = CycleUnsupported::ComputedArgument { parameter: parameter.name.as_str().into() };
                self.not_supported(&a.row.name, what, given.span, out);
                return None;
            }
        }
        Some(())
    }

    /// Deep-hole drilling with a stroke or a depth that is computed.
    fn computed_pecks(
        &mut self,
        a: &Arguments,
        planes: [&Expr; 2],
        (peck, first): (Expr, Option<Expr>),
        pause: Option<Expr>,
        src: Source,
        out: &mut Batch,
    ) -> Option<CycleKind> {
        if self.is_given(a, Role::LeastPeck) {
            let what = CycleUnsupported::LeastPeckComputed { parameter: a.name(Role::LeastPeck).into() };
            self.not_supported(&a.row.name, what, a.at(Role::LeastPeck), out);
            return None;
        }
        let settle = self.time(a, Role::Settle, src, out);
        let dwell = self.time(a, Role::LastDwell, src, out).or_else(|| pause.clone());
        let way = self.argument(a, Role::Way, src, out).and_then(Num::whole_number).unwrap_or(0);
        let role = if way == 0 { Role::Lift } else { Role::Clearance };
        let stated = self.argument(a, role, src, out).filter(|num| !num.is_zero());
        if stated.is_some_and(|num| num.mantissa < 0) {
            return self.out_of_range(a, role, out);
        }
        match (way, stated) {
            (0, lift) => {
                let lift = Clearance::Stated(Expr::Num(lift.unwrap_or(Num::int(1, Unit::Mm))));
                Some(CycleKind::DrillBreak {
                    peck,
                    first,
                    less: None,
                    lift,
                    lift_at_feed: true,
                    pause,
                    dwell,
                })
            }
            (1, stated) => {
                let clearance = match stated {
                    Some(clearance) => Expr::Num(clearance),
                    None => self.own_clearance(a, planes, out)?,
                };
                let clearance = Clearance::Stated(clearance);
                Some(CycleKind::DrillPeck { peck, first, less: None, clearance, pause, settle, dwell })
            }
            _ => self.out_of_range(a, Role::Way, out),
        }
    }

    /// The control's own clearance above the last depth, of a hole that is as deep as the run has it.
    fn own_clearance(
        &mut self,
        a: &Arguments,
        [reference, depth]: [&Expr; 2],
        out: &mut Batch,
    ) -> Option<Expr> {
        if let (Some(reference), Some(depth)) = (reference.literal(), depth.literal()) {
            return self.automatic_clearance(a, reference, depth, true, out).map(Expr::Num);
        }
        let units = self.known_units(a.span, out)?;
        if self.first_time("clearance") {
            let assumption = ControlFact::ComputedClearance { name: a.name(Role::Clearance).into() };
            out.report(Fault::AssumedFact { fact: assumption }, a.span);
        }
        Some(clearance_by_depth(&reference.minus(depth), units))
    }
}
