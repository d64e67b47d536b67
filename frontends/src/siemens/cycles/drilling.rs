//! Lowering of drilling cycles that are called with arguments, once or after each move (`MCALL`).
//!
//! What an argument is comes from the dictionary's row. An argument that is empty or 0 is as good as
//! none, as the cycles themselves find it; a depth of 0 counts if it is written.
//!
//! Not here: the moves of a cycle.

use ncc_dialects::{CallKind, CallRow, ParameterRole, Quantity};
use ncc_ir::canon::{Fact, Plane, Units};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, ONE, Unit};
use ncc_ir::program::cycle::{Clearance, Cycle, CycleKind, absolute};
use ncc_ir::program::{Move, Op};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CycleUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::number::spell;
use crate::siemens::block_words::Given;
use crate::siemens::lower::Lower;
use crate::siemens::program::repeated_blocks::CYCLE;
use crate::siemens::siemens_state::ModalCall;
use crate::siemens::text::tree::{Called, Expr as Argument};

/// Arguments of a call by the places of its parameters.
pub(in crate::siemens) struct Arguments {
    pub(in crate::siemens) row: &'static CallRow,
    pub(in crate::siemens) given: Vec<Option<Given>>,
    pub(in crate::siemens) span: Span,
}

impl Arguments {
    /// The argument with a role, and what it counts.
    pub(in crate::siemens) fn get(&self, role: ParameterRole) -> Option<(Given, Quantity)> {
        let place = self.row.place(role)?;
        Some(((*self.given.get(place)?)?, self.row.parameters[place].quantity?))
    }

    /// Name of the parameter with a role.
    pub(in crate::siemens) fn name(&self, role: ParameterRole) -> &'static str {
        self.row.place(role).map_or("", |place| &self.row.parameters[place].name)
    }

    /// Place of the argument with a role, or of the call.
    pub(in crate::siemens) fn at(&self, role: ParameterRole) -> Span {
        self.get(role).map_or(self.span, |(given, _)| given.span)
    }
}

impl Lower {
    /// Arguments of a call, as far as they are constants and do what is translated.
    pub(in crate::siemens) fn arguments(
        &mut self,
        row: &'static CallRow,
        called: &Called,
        src: Source,
        out: &mut Batch,
    ) -> Option<Arguments> {
        let places = called.arguments.as_deref().unwrap_or_default();
        if let Some(extra) = places.get(row.parameters.len()..).and_then(|rest| rest.iter().flatten().next())
        {
            let word = src.text(extra.span());
            return self.refuse(Fault::WordUnused { word }, extra.span(), out);
        }
        if !row.sure && self.first_time(&row.name) {
            let meaning = if is_cycle(row.kind) { "START_CYCLE" } else { "PATTERN" };
            let (code, meaning) = (row.name.as_str().into(), meaning.into());
            out.report(Fault::AssumedRow { code, meaning }, called.name);
        }
        let mut given = Vec::with_capacity(places.len());
        for (place, parameter) in places.iter().zip(&row.parameters) {
            given.push(match place {
                None => None,
                Some(Argument::Number(digits, span)) => {
                    let value =
                        Num { mantissa: digits.mantissa, scale: digits.scale, point: true, unit: Unit::One };
                    let neutral = || value.whole_number().is_some_and(|w| parameter.neutral.contains(&w));
                    if let Some(refuse) = &parameter.refuse
                        && !value.is_zero()
                        && !neutral()
                    {
                        let (parameter, name) = (parameter.name.as_str().into(), refuse.as_str().into());
                        let what = CycleUnsupported::RefusedArgument { parameter, name };
                        self.not_supported(&row.name, what, *span, out);
                    }
                    if !parameter.sure && !value.is_zero() && self.first_time(&parameter.name) {
                        let name = parameter.name.as_str().into();
                        let value =
                            value.whole_number().map_or_else(|| "?".into(), |value| value.to_string().into());
                        out.report(Fault::AssumedFact { fact: ControlFact::Argument { name, value } }, *span);
                    }
                    Some(Given { digits: *digits, distance: None, way: None, computed: None, span: *span })
                }
                Some(Argument::Text(_)) if parameter.role == Some(ParameterRole::FormText) => None,
                Some(other) => {
                    let span = other.span();
                    if parameter.refuse.is_some() {
                        let what =
                            CycleUnsupported::ComputedArgument { parameter: parameter.name.as_str().into() };
                        self.not_supported(&row.name, what, span, out);
                    }
                    self.formula(other, src, out).map(|typed| self.given(typed, span))
                }
            });
        }
        let arguments = Arguments { row, given, span: called.span };
        self.modes(&arguments, out);
        (!self.now.failed).then_some(arguments)
    }

    /// Refuses what the newer lists of arguments append, where it says something else than the arguments before it and
    /// the active plane.
    fn modes(&mut self, a: &Arguments, out: &mut Batch) {
        use ParameterRole as Role;
        let plane = self.whole_of(a, Role::WorkingPlane);
        let says = match plane {
            Some(0) => None,
            Some(1) => Some(Plane::Xy),
            Some(2) => Some(Plane::Zx),
            Some(3) => Some(Plane::Yz),
            _ => {
                let what = CycleUnsupported::DisplayMode { parameter: a.name(Role::WorkingPlane).into() };
                return self.not_supported(&a.row.name, what, a.at(Role::WorkingPlane), out);
            }
        };
        if says.is_some() && self.known_plane(a.at(Role::WorkingPlane), out) != says {
            let what = CycleUnsupported::ArgumentPlane { parameter: a.name(Role::WorkingPlane).into() };
            return self.not_supported(&a.row.name, what, a.at(Role::WorkingPlane), out);
        }
        let Some(place) = a.row.place(Role::DepthMode) else { return };
        let mode = self.whole_of(a, Role::DepthMode).unwrap_or(-1);
        let rest = mode - mode % 10;
        let agrees = match mode % 10 {
            0 => true,
            1 => self.is_given(a, Role::RelativeDepth) && !self.is_given(a, Role::Depth),
            2 => a.get(Role::Depth).is_some() && !self.is_given(a, Role::RelativeDepth),
            _ => false,
        };
        if !agrees || rest != 0 && !a.row.parameters[place].neutral.contains(&rest) {
            let what = CycleUnsupported::DepthMode { parameter: a.name(Role::DepthMode).into() };
            self.not_supported(&a.row.name, what, a.at(Role::DepthMode), out);
        }
    }

    /// The whole number with a role; 0 for an empty argument, none for one that is computed or no whole number.
    pub(in crate::siemens) fn whole_of(&self, a: &Arguments, role: ParameterRole) -> Option<i64> {
        let Some(given) = a.row.place(role).and_then(|place| *a.given.get(place)?) else { return Some(0) };
        let digits = given.computed.is_none().then_some(given.digits)?;
        Num { mantissa: digits.mantissa, scale: digits.scale, point: true, unit: Unit::One }.whole_number()
    }

    /// The number with a role; nothing for an empty argument, or one that is refused.
    pub(in crate::siemens) fn argument(
        &mut self,
        arguments: &Arguments,
        role: ParameterRole,
        src: Source,
        out: &mut Batch,
    ) -> Option<Num> {
        let (given, quantity) = arguments.get(role)?;
        self.number(given, quantity, src, out)
    }

    /// The number with a role, that must be there.
    pub(in crate::siemens) fn needed(
        &mut self,
        arguments: &Arguments,
        role: ParameterRole,
        src: Source,
        out: &mut Batch,
    ) -> Option<Num> {
        self.is_there(arguments, role, out)?;
        self.argument(arguments, role, src, out)
    }

    /// Refuses a call without an argument that it needs.
    fn is_there(&mut self, arguments: &Arguments, role: ParameterRole, out: &mut Batch) -> Option<()> {
        if arguments.get(role).is_some() {
            return Some(());
        }
        let (code, word) = (arguments.row.name.as_str().into(), arguments.name(role).into());
        self.refuse(Fault::WordMissing { code, word }, arguments.span, out)
    }

    /// The value with a role, written or computed; nothing for an empty argument, or one that is refused.
    pub(in crate::siemens) fn value(
        &mut self,
        a: &Arguments,
        role: ParameterRole,
        src: Source,
        out: &mut Batch,
    ) -> Option<Expr> {
        let (given, quantity) = a.get(role)?;
        self.amount(given, quantity, src, out)
    }

    /// The value with a role, that must be there.
    pub(in crate::siemens) fn needed_value(
        &mut self,
        a: &Arguments,
        role: ParameterRole,
        src: Source,
        out: &mut Batch,
    ) -> Option<Expr> {
        self.is_there(a, role, out)?;
        self.value(a, role, src, out)
    }

    pub(in crate::siemens) fn out_of_range<T>(
        &mut self,
        arguments: &Arguments,
        role: ParameterRole,
        out: &mut Batch,
    ) -> Option<T> {
        let word = arguments.name(role).into();
        self.refuse(Fault::OutOfRange { word }, arguments.at(role), out)
    }

    /// A cycle that is called: once here, or after each of the following moves.
    pub(in crate::siemens) fn cycle(
        &mut self,
        row: &'static CallRow,
        called: &Called,
        modal: bool,
        src: Source,
        out: &mut Batch,
    ) {
        let block = called.span;
        self.no_idle_tap(block, src, out);
        let cycle = self.arguments(row, called, src, out).and_then(|a| self.cycle_of(&a, src, out));
        if modal {
            self.repeated_blocks.say(CYCLE);
        }
        let says_speed = std::mem::take(&mut self.idle_tap);
        let Some(cycle) = cycle.filter(|_| !self.now.failed) else {
            if modal {
                self.state.cycle = ModalCall::Refused;
            }
            return;
        };
        self.moved = None;
        self.cycled = true;
        self.recall = false;
        let cycle = Box::new(cycle);
        if modal {
            if matches!(self.state.cycle, ModalCall::Subprogram(_)) && self.skipped() {
                let what = CycleUnsupported::CallEndSkipped;
                return self.not_supported(&row.name, what, block, out);
            }
            self.push(block, Op::StartCycle(cycle.clone()), out);
            self.idle_tap = says_speed;
            // Whether it has made a hole or not: which feed is active after it must be stated.
            self.hole_made(&cycle);
            self.state.cycle = ModalCall::Active(cycle);
            return;
        }
        self.repeated_blocks.use_fact(CYCLE);
        if !matches!(self.state.cycle, ModalCall::None | ModalCall::Refused) {
            let what = CycleUnsupported::InModalCycle;
            return self.not_supported(&row.name, what, block, out);
        }
        if cycle.relies_on_feed() {
            self.rely_on_feed(block, out);
        }
        self.rely_on_frames(true, block, out);
        self.push(block, Op::StartCycle(cycle.clone()), out);
        self.push(block, Op::Hole(Move::default()), out);
        self.push(block, Op::EndCycle, out);
        self.hole_made(&cycle);
    }

    /// A modal tap that goes without a hole: which speed the spindle then has is its control's matter.
    pub(in crate::siemens) fn no_idle_tap(&mut self, at: Span, src: Source, out: &mut Batch) {
        self.idle_tap_ends(&src.text(at), at, out);
    }

    /// The same where the place is a code.
    pub(in crate::siemens) fn idle_tap_ends(&mut self, code: &str, at: Span, out: &mut Batch) {
        if std::mem::take(&mut self.idle_tap) {
            let what = CycleUnsupported::IdleTap;
            self.not_supported(code, what, at, out);
        }
    }

    /// `MCALL` alone.
    pub(in crate::siemens) fn end_cycle(&mut self, at: Span, src: Source, out: &mut Batch) {
        self.no_idle_tap(at, src, out);
        self.repeated_blocks.say(CYCLE);
        if matches!(self.state.cycle, ModalCall::Subprogram(_)) {
            if self.skipped() {
                let what = CycleUnsupported::CallEndSkipped;
                return self.not_supported("MCALL", what, at, out);
            }
            self.now.heading = true;
            self.state.cycle = ModalCall::None;
            return;
        }
        if self.state.cycle != ModalCall::None {
            self.moved = None;
        }
        self.state.cycle = ModalCall::None;
        self.push(at, Op::EndCycle, out);
    }

    /// Calls the active cycle up again if a feed was stated since, which is not its own.
    pub(in crate::siemens) fn call_up_again(&mut self, cycle: &Cycle, at: Span, out: &mut Batch) {
        self.idle_tap = false;
        if std::mem::take(&mut self.recall) {
            self.push(at, Op::StartCycle(Box::new(cycle.clone())), out);
        }
    }

    /// Which feed is active after a cycle that has its own is not known.
    pub(in crate::siemens) fn hole_made(&mut self, cycle: &Cycle) {
        if cycle.feed.is_some() {
            (self.state.modes.feed, self.state.spent) = (Know::Unsaid, false);
        }
    }

    /// The cycle of a call; `None` if it is refused (reported).
    fn cycle_of(&mut self, a: &Arguments, src: Source, out: &mut Batch) -> Option<Cycle> {
        use ParameterRole as Role;
        if a.given.iter().flatten().any(|given| given.computed.is_some()) {
            return self.computed_cycle(a, src, out);
        }
        let plane = self.plane(a.span, out);
        let return_plane = self.needed(a, Role::ReturnPlane, src, out)?;
        let zero = Num::int(0, return_plane.unit);
        let reference = self.argument(a, Role::ReferencePlane, src, out).unwrap_or(zero);
        let safety = self.argument(a, Role::SafetyDistance, src, out).unwrap_or(zero);
        if safety.mantissa < 0 {
            return self.out_of_range(a, Role::SafetyDistance, out);
        }
        let level = self.sum(a, reference, safety, out)?;
        let depth = self.depth(a, [Role::Depth, Role::RelativeDepth], reference, src, out)?;
        if below(return_plane, reference)
            || !below(reference, return_plane) && self.is_given(a, Role::RelativeDepth)
        {
            return self.out_of_range(a, Role::ReturnPlane, out);
        }
        if below(reference, depth) {
            return self.refuse(Fault::CycleUpsideDown, a.span, out);
        }
        let dwell = self.time(a, Role::Dwell, src, out);
        let mut feed = None;
        let kind = match a.row.kind {
            CallKind::Drill => CycleKind::Drill,
            CallKind::DrillDwell => dwell.map_or(CycleKind::Drill, |dwell| CycleKind::DrillDwell { dwell }),
            CallKind::DrillPeck => self.pecks(a, [reference, safety, depth], dwell, src, out)?,
            CallKind::Tap => self.chuck_tap(a, return_plane.unit, dwell, out)?,
            CallKind::TapRigid => {
                let (kind, speed) = self.rigid_tap(a, return_plane.unit, dwell, src, out)?;
                self.speed_of_tap(speed, a.span, out);
                kind
            }
            CallKind::BoreFine => self.fine_bore(a, plane.known(), dwell, src, out)?,
            CallKind::BoreStop => self.stop_bore(a, dwell, out)?,
            CallKind::Bore if a.row.place(Role::FeedIn).is_none() => {
                CycleKind::Bore { dwell, feed_out: None, to_level: false }
            }
            CallKind::Bore => {
                let (kind, into) = self.bore_by_feeds(a, dwell, src, out)?;
                feed = Some(into);
                kind
            }
            CallKind::Line | CallKind::Circle | CallKind::Grid | CallKind::List => return None,
        };
        Some(Cycle {
            kind,
            plane,
            retract: absolute(level),
            reference: (!safety.is_zero()).then(|| absolute(reference)),
            depth: absolute(depth),
            return_level: Fact::Entry,
            return_plane: Some(absolute(return_plane)),
            approach: self.settings.approach(),
            feed,
        })
    }

    /// Boring with feeds of the cycle's own: the cycle, and its feed into the hole.
    pub(in crate::siemens) fn bore_by_feeds(
        &mut self,
        a: &Arguments,
        dwell: Option<Expr>,
        src: Source,
        out: &mut Batch,
    ) -> Option<(CycleKind, Expr)> {
        use ParameterRole as Role;
        let into = self.needed(a, Role::FeedIn, src, out)?;
        let back = self.needed(a, Role::FeedOut, src, out)?;
        for (num, role) in [(into, Role::FeedIn), (back, Role::FeedOut)] {
            if num.is_zero() {
                return self.out_of_range(a, role, out);
            }
        }
        self.rely_on_feed_mode(a.span, out);
        let value = |num: Num| (num.trimmed().mantissa, num.trimmed().scale);
        let other = (value(into) != value(back)).then_some(Expr::Num(back));
        Some((CycleKind::Bore { dwell, feed_out: other, to_level: false }, Expr::Num(into)))
    }

    /// Whether an argument is there and not 0.
    pub(in crate::siemens) fn is_given(&self, a: &Arguments, role: ParameterRole) -> bool {
        a.get(role).is_some_and(|(given, _)| given.computed.is_some() || given.digits.mantissa != 0)
    }

    /// A depth: absolute, or below the reference plane. Both must agree.
    fn depth(
        &mut self,
        a: &Arguments,
        [to, by]: [ParameterRole; 2],
        reference: Num,
        src: Source,
        out: &mut Batch,
    ) -> Option<Num> {
        let to_given = a.get(to).is_some();
        if !self.is_given(a, by) {
            return self.needed(a, to, src, out);
        }
        let down = self.argument(a, by, src, out)?;
        if down.mantissa < 0 {
            return self.out_of_range(a, by, out);
        }
        let depth = self.sum(a, reference, Num { mantissa: -down.mantissa, ..down }, out)?;
        if to_given {
            let written = self.argument(a, to, src, out)?;
            if !written.is_zero() && (below(written, depth) || below(depth, written)) {
                let (first, second) = (a.name(to).into(), a.name(by).into());
                let what = CycleUnsupported::TwoDepths { first, second };
                self.not_supported(&a.row.name, what, a.at(by), out);
                return None;
            }
        }
        Some(depth)
    }

    /// A dwell, if it is there and not 0.
    pub(in crate::siemens) fn time(
        &mut self,
        a: &Arguments,
        role: ParameterRole,
        src: Source,
        out: &mut Batch,
    ) -> Option<Expr> {
        self.argument(a, role, src, out).filter(|num| !num.is_zero()).map(Expr::Num)
    }

    /// Deep-hole drilling: strokes measured from the reference plane, all alike but the last.
    fn pecks(
        &mut self,
        a: &Arguments,
        [reference, safety, depth]: [Num; 3],
        pause: Option<Expr>,
        src: Source,
        out: &mut Batch,
    ) -> Option<CycleKind> {
        use ParameterRole as Role;
        let first = self.depth(a, [Role::FirstDepth, Role::RelativeFirstDepth], reference, src, out)?;
        let stroke = self.sum(a, reference, Num { mantissa: -first.mantissa, ..first }, out)?;
        if stroke.mantissa <= 0 || below(first, depth) {
            let role =
                if a.get(Role::FirstDepth).is_some() { Role::FirstDepth } else { Role::RelativeFirstDepth };
            return self.out_of_range(a, role, out);
        }
        // Pecks are all alike here, so that a least depth says nothing; a greater one contradicts them.
        if let Some(least) = self.argument(a, Role::LeastPeck, src, out)
            && (least.mantissa < 0 || below(stroke, least))
        {
            let what = CycleUnsupported::LeastPeckAbove { parameter: a.name(Role::LeastPeck).into() };
            self.not_supported(&a.row.name, what, a.at(Role::LeastPeck), out);
            return None;
        }
        let whole = self.sum(a, stroke, safety, out)?;
        let first_peck = (!safety.is_zero()).then_some(Expr::Num(whole));
        let settle = self.time(a, Role::Settle, src, out);
        let dwell = self.time(a, Role::LastDwell, src, out).or_else(|| pause.clone());
        let peck = Expr::Num(stroke);
        let way = self.argument(a, Role::Way, src, out).and_then(Num::whole_number).unwrap_or(0);
        Some(match way {
            0 => {
                let lift = self.argument(a, Role::Lift, src, out).filter(|num| !num.is_zero());
                if lift.is_some_and(|num| num.mantissa < 0) {
                    return self.out_of_range(a, Role::Lift, out);
                }
                let lift = Clearance::Stated(Expr::Num(lift.unwrap_or(Num::int(1, Unit::Mm))));
                CycleKind::DrillBreak {
                    peck,
                    first: first_peck,
                    less: None,
                    lift,
                    lift_at_feed: true,
                    pause,
                    dwell,
                }
            }
            1 => {
                let clearance = match self.argument(a, Role::Clearance, src, out).filter(|num| !num.is_zero())
                {
                    Some(num) if num.mantissa < 0 => return self.out_of_range(a, Role::Clearance, out),
                    Some(num) => num,
                    None => self.automatic_clearance(a, reference, depth, below(depth, first), out)?,
                };
                let clearance = Clearance::Stated(Expr::Num(clearance));
                CycleKind::DrillPeck { peck, first: first_peck, less: None, clearance, pause, settle, dwell }
            }
            _ => return self.out_of_range(a, Role::Way, out),
        })
    }

    /// The control's own clearance above the last depth: 0.6 mm for holes up to 30 mm, a fiftieth of
    /// the depth for deeper ones, at most 7 mm.
    pub(in crate::siemens) fn automatic_clearance(
        &mut self,
        a: &Arguments,
        reference: Num,
        depth: Num,
        matters: bool,
        out: &mut Batch,
    ) -> Option<Num> {
        let inch = self.known_units(a.span, out)? == Units::Inch;
        let hole = self.sum(a, reference, Num { mantissa: -depth.mantissa, ..depth }, out)?.nanos(inch)?;
        let clearance = if hole <= 30 * ONE { 6 * ONE / 10 } else { (hole / 50).min(7 * ONE) };
        let num = Num::from_nanos(clearance, 9, Unit::Mm);
        if matters && self.first_time("clearance") {
            let (name, length) = (a.name(ParameterRole::Clearance).into(), spell(num).into());
            out.report(Fault::AssumedFact { fact: ControlFact::AutomaticClearance { name, length } }, a.span);
        }
        Some(num)
    }

    /// The exact sum of two numbers of one unit.
    pub(in crate::siemens) fn sum(&mut self, a: &Arguments, x: Num, y: Num, out: &mut Batch) -> Option<Num> {
        match x.plus(y) {
            Some(sum) => Some(sum),
            None => self.refuse(Fault::OutOfRange { word: a.row.name.as_str().into() }, a.span, out),
        }
    }
}

/// Whether a kind of call is a cycle; else it is a pattern.
pub(in crate::siemens) fn is_cycle(kind: CallKind) -> bool {
    !kind.cycles().is_empty()
}

/// Whether one number is less than another of the same unit.
fn below(x: Num, y: Num) -> bool {
    x.nanos(false) < y.nanos(false)
}
