//! Lowering of tapping and of boring cycles that stop the spindle, which are called with arguments.
//!
//! What an argument is comes from the dictionary's row; `drilling` has what is common to all cycles.

use ncc_dialects::ParameterRole as Role;
use ncc_ir::canon::{Axis, Plane, Spindle, Turn, Units};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::{BoreStop, CycleKind, FineBore, Shift, Tap};
use ncc_ir::program::{Op, Pitch};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CycleUnsupported;

use super::drilling::Arguments;
use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::lower::Lower;
use crate::siemens::siemens_state::ModalCall;

/// Nominal sizes of the coarse metric series and their pitches in hundredths of a millimetre (ISO 261).
const COARSE: [(i64, i64); 21] = [
    (3, 50),
    (4, 70),
    (5, 80),
    (6, 100),
    (8, 125),
    (10, 150),
    (12, 175),
    (14, 200),
    (16, 200),
    (18, 250),
    (20, 250),
    (22, 250),
    (24, 300),
    (27, 300),
    (30, 350),
    (33, 350),
    (36, 400),
    (39, 400),
    (42, 450),
    (45, 450),
    (48, 500),
];

impl Lower {
    /// The number of an argument as it is written; nothing if it is empty or 0.
    fn written(&self, a: &Arguments, role: Role) -> Option<Num> {
        let digits = a.get(role)?.0.digits;
        let num = Num { mantissa: digits.mantissa, scale: digits.scale, point: true, unit: Unit::One };
        (!num.is_zero()).then_some(num)
    }

    fn whole_argument(&self, a: &Arguments, role: Role) -> i64 {
        self.written(a, role).map_or(0, |num| num.whole_number().unwrap_or(i64::MAX))
    }

    /// The sense in which the spindle turns for a cycle.
    fn sense(&mut self, a: &Arguments, role: Role, out: &mut Batch) -> Option<Turn> {
        match self.whole_argument(a, role) {
            3 => Some(Turn::Clockwise),
            4 => Some(Turn::Counterclockwise),
            _ => self.out_of_range(a, role, out),
        }
    }

    /// A pitch and the hand of its thread; `Some(None)` if none is given.
    #[allow(clippy::option_option)]
    fn thread_pitch(&mut self, a: &Arguments, unit: Unit, out: &mut Batch) -> Option<Option<(Num, Turn)>> {
        let hand = |num: Num| if num.mantissa < 0 { Turn::Counterclockwise } else { Turn::Clockwise };
        let found = match (self.written(a, Role::ThreadSize), self.written(a, Role::ThreadPitch)) {
            (Some(_), Some(_)) => {
                let what = CycleUnsupported::SizeAndPitch;
                self.not_supported(&a.row.name, what, a.at(Role::ThreadPitch), out);
                return None;
            }
            (None, None) => return Some(None),
            (Some(size), None) => {
                let nominal = size.whole_number().map_or(0, i64::abs);
                let Some((_, pitch)) = COARSE.iter().find(|(size, _)| *size == nominal) else {
                    return self.out_of_range(a, Role::ThreadSize, out);
                };
                (Num { mantissa: *pitch, scale: 2, point: true, unit: Unit::Mm }.trimmed(), hand(size))
            }
            (None, Some(pitch)) => {
                let unit = match self.whole_argument(a, Role::PitchUnit) {
                    0 => self.pitch_unit(unit, a.at(Role::ThreadPitch), out),
                    1 => Unit::Mm,
                    3 => Unit::Inch,
                    _ => return self.out_of_range(a, Role::PitchUnit, out),
                };
                (Num { mantissa: pitch.mantissa.abs(), unit, ..pitch }, hand(pitch))
            }
        };
        Some(Some(found))
    }

    /// The unit of a pitch that has none of its own: the machine's, or the active one.
    fn pitch_unit(&mut self, active: Unit, at: Span, out: &mut Batch) -> Unit {
        let machine = if self.settings.get("feed_unit") == "inch" { Unit::Inch } else { Unit::Mm };
        let known = match (active, self.state.modes.units.value()) {
            (Unit::Entry, Some(Units::Inch)) => Unit::Inch,
            (Unit::Entry, Some(Units::Mm)) => Unit::Mm,
            (unit, _) => unit,
        };
        if known == machine {
            return active;
        }
        match self.option("pitch_unit", at, out) {
            "in-force" => active,
            _ => machine,
        }
    }

    /// Rigid tapping: the control turns the spindle itself. With it its speed, if it has one of its own
    /// ([`Lower::speed_of_tap`]).
    pub(in crate::siemens) fn rigid_tap(
        &mut self,
        a: &Arguments,
        unit: Unit,
        dwell: Option<Expr>,
        src: Source,
        out: &mut Batch,
    ) -> Option<(CycleKind, Option<Num>)> {
        let Some((pitch, turn)) = self.thread_pitch(a, unit, out)? else {
            let (code, word) = (a.row.name.as_str().into(), a.name(Role::ThreadPitch).into());
            return self.refuse(Fault::WordMissing { code, word }, a.span, out);
        };
        let after = match self.whole_argument(a, Role::After) {
            3 => Spindle::Clockwise,
            4 => Spindle::Counterclockwise,
            5 => Spindle::Stopped,
            _ => return self.out_of_range(a, Role::After, out),
        };
        let speed = self.argument(a, Role::Speed, src, out).filter(|num| !num.is_zero());
        let back = self.argument(a, Role::SpeedOut, src, out).filter(|num| !num.is_zero());
        let value = |num: Num| (num.trimmed().mantissa, num.trimmed().scale);
        if back.is_some() && back.map(value) != speed.map(value) {
            let what = CycleUnsupported::SpeedOut;
            self.not_supported(&a.row.name, what, a.at(Role::SpeedOut), out);
            return None;
        }
        let pitch = Pitch::Stated(pitch.into());
        let tap = Tap { turn, pitch, chuck: false, dwell, back: None, settle: None, after, to_level: false };
        Some((CycleKind::Tap(Box::new(tap)), speed))
    }

    /// The speed that a rigid tap has of its own is set before it is activated.
    pub(in crate::siemens) fn speed_of_tap(&mut self, speed: Option<Num>, at: Span, out: &mut Batch) {
        let Some(speed) = speed else { return };
        // The cycle that was modal is over before that: its own speed is what it was activated with.
        if matches!(self.state.cycle, ModalCall::Active(_)) {
            self.push(at, Op::EndCycle, out);
        }
        self.push(at, Op::SetSpindleSpeed(Expr::Num(speed)), out);
        self.idle_tap = true;
    }

    /// Tapping with a compensating chuck.
    pub(in crate::siemens) fn chuck_tap(
        &mut self,
        a: &Arguments,
        unit: Unit,
        dwell: Option<Expr>,
        out: &mut Batch,
    ) -> Option<CycleKind> {
        let back = match self.whole_argument(a, Role::Back) {
            0 => {
                let what = CycleUnsupported::SpindleByItself;
                self.not_supported(&a.row.name, what, a.at(Role::Back), out);
                return None;
            }
            _ => self.sense(a, Role::Back, out)?,
        };
        let after = match self.whole_argument(a, Role::After) {
            3 => Spindle::Clockwise,
            4 => Spindle::Counterclockwise,
            5 => Spindle::Stopped,
            _ => return self.out_of_range(a, Role::After, out),
        };
        let turn = back.back();
        let pitch = match (self.whole_argument(a, Role::Encoder), self.thread_pitch(a, unit, out)?) {
            (1, None) => Pitch::Feed,
            (0 | 11, Some((pitch, hand))) if hand == turn => Pitch::Stated(pitch.into()),
            (0 | 11, Some(_)) => return self.out_of_range(a, Role::Back, out),
            (0 | 11, None) => {
                let (code, word) = (a.row.name.as_str().into(), a.name(Role::ThreadPitch).into());
                return self.refuse(Fault::WordMissing { code, word }, a.span, out);
            }
            (1, Some(_)) => {
                let what = CycleUnsupported::FeedAndPitch;
                self.not_supported(&a.row.name, what, a.at(Role::ThreadPitch), out);
                return None;
            }
            _ => return self.out_of_range(a, Role::Encoder, out),
        };
        Some(CycleKind::Tap(Box::new(Tap {
            turn,
            pitch,
            chuck: true,
            dwell,
            back: None,
            settle: None,
            after,
            to_level: false,
        })))
    }

    /// Boring with an oriented stop.
    pub(in crate::siemens) fn fine_bore(
        &mut self,
        a: &Arguments,
        plane: Option<Plane>,
        dwell: Option<Expr>,
        src: Source,
        out: &mut Batch,
    ) -> Option<CycleKind> {
        let turn = self.sense(a, Role::Sense, out)?;
        let Some(plane) = plane else {
            let what = CycleUnsupported::UnknownPlane;
            self.not_supported(&a.row.name, what, a.span, out);
            return None;
        };
        let (first, second, normal) = plane.axes();
        let mut by: [Option<Expr>; 3] = [None, None, None];
        let roles = [(first, Role::ShiftFirst), (second, Role::ShiftSecond), (normal, Role::ShiftNormal)];
        for (axis, role) in roles {
            let num = self.argument(a, role, src, out).filter(|num| !num.is_zero());
            debug_assert!(axis <= Axis::Z, "a plane is of linear axes");
            by[axis as usize] = num.map(Expr::Num);
        }
        let angle = self.argument(a, Role::Orientation, src, out);
        let angle = angle.unwrap_or(Num::int(0, Unit::Degree));
        Some(CycleKind::FineBore(Box::new(FineBore {
            turn: Some(turn),
            dwell,
            angle: Some(angle.into()),
            shift: Shift::Stated(by),
            after: Some(Spindle::Stopped),
        })))
    }

    /// Boring with a stop of spindle and program.
    pub(in crate::siemens) fn stop_bore(
        &mut self,
        a: &Arguments,
        dwell: Option<Expr>,
        out: &mut Batch,
    ) -> Option<CycleKind> {
        let turn = Some(self.sense(a, Role::Sense, out)?);
        Some(CycleKind::BoreStop(BoreStop { turn, dwell, stop: true, after: Some(Spindle::Stopped) }))
    }
}
