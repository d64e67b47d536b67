//! Lowering of drilling cycles of which arguments are computed.
//!
//! What a written argument is refused for is found when the program runs: planes that are not one above the other end
//! it with the cycle's own alarm 61101 (reference, 9).
//!
//! Refused by name: other arguments than planes and depths.

use ncc_dialects::{CallKind, ParameterRole as Role, Quantity};
use ncc_ir::canon::Distance;
use ncc_ir::canon::Fact;
use ncc_ir::cycle::{Clearance, Cycle, CycleKind};
use ncc_ir::expr::{Binary, Expr, Node, Unary};
use ncc_ir::num::{Num, Unit};
use ncc_ir::program::{Alarm, Control, Coord, Op, Stmt};

use super::cycles::{Arguments, sum};
use super::formula::binary;
use super::lower::Lower;
use crate::Batch;
use crate::word::Source;
use crate::word::number::unit_of;

/// A length, as it counts by itself and as an operand.
#[derive(Clone)]
struct Length {
    /// With its unit, where it is written.
    own: Expr,
    operand: Expr,
}

impl Length {
    fn coord(self) -> Coord {
        Coord { value: self.own, distance: Fact::Known(Distance::Absolute) }
    }

    /// The sum, or the difference, of two lengths.
    fn with(&self, other: &Length, less: bool) -> Length {
        if let (Expr::Num(a), Expr::Num(b)) = (&self.own, &other.own) {
            let signed = Num { mantissa: if less { -b.mantissa } else { b.mantissa }, ..*b };
            if let Some(sum) = sum(*a, signed) {
                return Length { own: Expr::Num(sum), operand: Expr::Num(Num { unit: Unit::One, ..sum }) };
            }
        }
        let operator = if less { Binary::Subtract } else { Binary::Add };
        let value = binary(operator, self.operand.clone(), other.operand.clone());
        Length { own: value.clone(), operand: value }
    }
}

impl Lower {
    /// The length with a role; nothing for an empty argument, or one that is refused.
    fn length(&mut self, a: &Arguments, role: Role, src: Source, out: &mut Batch) -> Option<Length> {
        let (given, _) = a.get(role)?;
        let own = self.amount(given, Quantity::Length, src, out)?;
        let operand = match &own {
            Expr::Num(num) => Expr::Num(Num { unit: Unit::One, ..*num }),
            computed @ Expr::Node(_) => computed.clone(),
        };
        Some(Length { own, operand })
    }

    fn needed_length(&mut self, a: &Arguments, role: Role, src: Source, out: &mut Batch) -> Option<Length> {
        if a.get(role).is_none() {
            // Reported as missing.
            self.needed(a, role, src, out)?;
        }
        self.length(a, role, src, out)
    }

    /// A depth: absolute, or below the reference plane.
    fn computed_depth(
        &mut self,
        a: &Arguments,
        [to, by]: [Role; 2],
        reference: &Length,
        src: Source,
        out: &mut Batch,
    ) -> Option<Length> {
        if !self.is_given(a, by) {
            return self.needed_length(a, to, src, out);
        }
        if a.get(to).is_some() {
            let name = format!("{} beside {} where one is computed", a.name(to), a.name(by));
            self.not_supported(&a.row.name, &name, a.at(by), out);
            return None;
        }
        let down = self.length(a, by, src, out)?;
        Some(reference.with(&down, true))
    }

    /// A cycle of which planes or depths are computed; `None` if it is refused (reported).
    pub(super) fn computed_cycle(&mut self, a: &Arguments, src: Source, out: &mut Batch) -> Option<Cycle> {
        let plane = self.plane(a.span, out);
        let nothing = Expr::int(0);
        let zero = Length { own: nothing.clone(), operand: nothing };
        let return_plane = self.needed_length(a, Role::ReturnPlane, src, out)?;
        let reference = match a.get(Role::ReferencePlane) {
            Some(_) => self.length(a, Role::ReferencePlane, src, out)?,
            None => zero.clone(),
        };
        // Its sign is not known where it is computed.
        let safety = match self.argument(a, Role::SafetyDistance, src, out) {
            Some(safety) if safety.mantissa < 0 => return self.out_of_range(a, Role::SafetyDistance, out),
            Some(safety) if safety.is_zero() => None,
            Some(safety) => {
                Some(Length { own: Expr::Num(safety), operand: Expr::Num(Num { unit: Unit::One, ..safety }) })
            }
            None if a.get(Role::SafetyDistance).is_some() => return None,
            None => None,
        };
        let level = safety.as_ref().map_or_else(|| reference.clone(), |safety| reference.with(safety, false));
        let depth = self.computed_depth(a, [Role::Depth, Role::RelativeDepth], &reference, src, out)?;
        let dwell = self.time(a, Role::Dwell, src, out);
        let less = |x: &Length, y: &Length| binary(Binary::Less, x.operand.clone(), y.operand.clone());
        let mut wrong = binary(Binary::Or, less(&return_plane, &reference), less(&reference, &depth));
        if self.is_given(a, Role::RelativeDepth) {
            let higher = less(&reference, &return_plane);
            let level = Expr::Node(Box::new(Node::Unary(Unary::Not, higher)));
            wrong = binary(Binary::Or, wrong, level);
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
                    true => self.length(a, Role::RelativeFirstDepth, src, out)?,
                    false => reference.with(&first, true),
                };
                wrong = binary(Binary::Or, wrong, less(&first, &depth));
                let none = binary(Binary::LessOrEqual, reference.operand.clone(), first.operand);
                wrong = binary(Binary::Or, wrong, none);
                let first = safety.as_ref().map(|safety| stroke.with(safety, false).own);
                self.computed_pecks(a, stroke.own, first, dwell, src, out)?
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
            retract: level.coord(),
            reference: safety.map(|_| reference.coord()),
            depth: depth.coord(),
            return_level: Fact::Entry,
            return_plane: Some(return_plane.coord()),
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
                let name = format!("{}: an argument that is computed", parameter.name);
                self.not_supported(&a.row.name, &name, given.span, out);
                return None;
            }
        }
        Some(())
    }

    /// Deep-hole drilling with a stroke that is computed.
    fn computed_pecks(
        &mut self,
        a: &Arguments,
        peck: Expr,
        first: Option<Expr>,
        pause: Option<Expr>,
        src: Source,
        out: &mut Batch,
    ) -> Option<CycleKind> {
        if self.is_given(a, Role::LeastPeck) {
            let name = format!("{} beside depths that are computed", a.name(Role::LeastPeck));
            self.not_supported(&a.row.name, &name, a.at(Role::LeastPeck), out);
            return None;
        }
        let settle = self.time(a, Role::Settle, src, out);
        let dwell = self.time(a, Role::LastDwell, src, out).or_else(|| pause.clone());
        let way = self.argument(a, Role::Way, src, out).and_then(Num::whole).unwrap_or(0);
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
            (1, Some(clearance)) => {
                let clearance = Clearance::Stated(Expr::Num(clearance));
                Some(CycleKind::DrillPeck { peck, first, less: None, clearance, pause, settle, dwell })
            }
            (1, None) => {
                let name = "the control's own clearance of a hole whose depth is computed";
                self.not_supported(&a.row.name, name, a.span, out);
                None
            }
            _ => self.out_of_range(a, Role::Way, out),
        }
    }
}
