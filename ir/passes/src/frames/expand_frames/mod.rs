//! `expand-frames`: frames are stated in the target's own form (`frame_forms`), or worked into the
//! coordinates.
//!
//! A translation moves absolute words and leaves increments alone. Rotations, factors and mirrors are
//! computed, every point from its exact place, so that roundings do not add up; a point is exact
//! where the chain is one of translations, mirrors and quarter turns, else rounded to the target's
//! digits. Positions must be known where axes are mixed. Words in machine coordinates stay.
//!
//! Refused: arcs that the chain does not leave arcs, cycles whose drilling axis it turns,
//! mirrors or scales, frames but local shifts that may be skipped, and frames under calls, jumps and repetitions.

mod concerns;
mod holes;
mod lines;
mod now;
mod shut;
mod skipped;
mod words;

pub(crate) use self::concerns::{concerns, has_frames, shifts_origin_in_calls};

use self::concerns::tilts;
use self::now::{Now, cannot};
use crate::arcs::arc_form;
use crate::frames::frame_forms::{self, shifted};
use crate::pass::{Moment, Pass, Step};
use crate::support::needs::FRAME;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{EXACT, Rebuild, exact, rebuild, unit_of};
use crate::target::Target;
use ncc_exec::{Chain, Frames as Slots, Present};
use ncc_ir::canon::{AXES, Axis, Plane, Turn};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::lack::FramesLack;
use ncc_ir::program::kinds::{
    conduct, flow, frames, machine, miscellaneous, modes, polar, tooling, variables,
};
use ncc_ir::program::{Data, DataMode, FrameSlot, Op, Program, Reference, Slot, Stmt, Synchronised};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "expand-frames",
    about: "works chains of frames into the coordinates",
    alone: Some(run),
    step: Step::at(
        Moment::Placing,
        |_, p| p.needs(FRAME),
        |l, p| {
            expand_frames(
                p.stmts,
                &mut p.start.clone(),
                l.states.state_mut::<ExpandFramesState>(),
                &l.target,
                p.diags,
            )
        },
    ),
    program: &[],
    parametric: None,
};

/// Less than this is no share of an axis.
const NOTHING: f64 = 1e-12;

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct ExpandFramesState {
    /// The active frames, and where the tool is in the program's own coordinates.
    framed: Option<Box<(Set, Walk, arc_form::ArcFormState)>>,
    /// Whether a chain may be active that the target says as it stands.
    chained: bool,
}

/// Works the frames in.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| expand_frames(body, walk, &mut Default::default(), target, diags));
}

impl ExpandFramesState {
    /// Whether a frame is active.
    pub(crate) fn is_busy(&self) -> bool {
        self.framed.is_some()
    }

    /// Whether a frame is worked into the coordinates of what follows.
    pub(crate) fn is_worked_in(&self) -> bool {
        self.framed.as_ref().is_some_and(|framed| framed.0.chain != Chain::NONE)
    }

    /// At the start of another body.
    pub(crate) fn start_over(&mut self) {
        *self = ExpandFramesState::default();
    }

    /// Passes over statements of which none is this pass's business.
    pub(crate) fn note(&mut self, body: &[Stmt]) {
        for stmt in body {
            match &stmt.op {
                Op::SetFrame(_) => self.chained = true,
                Op::ClearFrame(FrameSlot::Chain) => self.chained &= stmt.skip.is_some(),
                _ => {}
            }
        }
    }

    /// Facts that were assumed since.
    pub(crate) fn assume(&mut self, assumed: &ncc_ir::canon::Modes) {
        if let Some(framed) = &mut self.framed {
            framed.1.assume(assumed);
        }
    }
}

/// The same for one piece of a body. The walk stands before what is made of it.
pub(crate) fn expand_frames(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut ExpandFramesState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    if state.framed.is_none() && !body.iter().any(|stmt| concerns(&stmt.op, &target.caps)) {
        return state.note(body);
    }
    let (set, inner, arcs) = match state.framed.take() {
        Some(framed) => *framed,
        None => (Set::NONE, walk.clone(), arc_form::ArcFormState::default()),
    };
    let mut frames = Frames { set, inner, arcs, outer: walk, target, chained: state.chained };
    if frames.leaves(body) {
        frames.follow(body);
    } else {
        rebuild(body, |stmt, made| frames.take(stmt, made, diags));
    }
    let goes_on = frames.goes_on();
    let Frames { set, inner, arcs, chained, .. } = frames;
    state.chained = chained;
    state.framed = goes_on.then(|| Box::new((set, inner, arcs)));
}

/// What is active.
#[derive(Clone, Debug, PartialEq)]
struct Set {
    /// What the program has set.
    slots: Slots,
    /// What that amounts to, with the G92 shift.
    whole: Chain,
    /// What of it coordinates must be changed by: all of it, or nothing.
    chain: Chain,
    /// What has been written of it: slots of a target that has them.
    said: Slots,
    /// Whether a chain has been written.
    said_chain: bool,
    /// A plane of which the next move must name both axes, absolutely.
    unplaced: Option<Plane>,
    /// Whether what is active depends on a block-skip switch; all of it has been stated as it stood.
    lost: bool,
    /// Frames that may be active instead of `slots`: a block-skip switch decides. All are shifts, and are stated.
    others: Vec<Slots>,
}

impl Set {
    const NONE: Set = Set {
        slots: Slots::NONE,
        whole: Chain::NONE,
        chain: Chain::NONE,
        said: Slots::NONE,
        said_chain: false,
        unplaced: None,
        lost: false,
        others: Vec::new(),
    };
}

struct Frames<'f> {
    set: Set,
    /// Tool position as the program sees it.
    inner: Walk,
    /// Which way it came.
    arcs: arc_form::ArcFormState,
    /// Tool position as what is made sees it.
    outer: &'f mut Walk,
    target: &'f Target,
    /// Whether a chain may be active that was stated as it stood, before this pass had any business.
    chained: bool,
}

impl Frames<'_> {
    /// Whether a frame is active, or what is made stands at a rounded place that a frame has left.
    fn goes_on(&self) -> bool {
        self.set != Set::NONE || (0..3).any(|axis| self.is_rounded(axis))
    }

    /// Whether an axis stands, as it is written, at another place than the exact one.
    fn is_rounded(&self, axis: usize) -> bool {
        let exact = self.set.chain.place_known(&self.inner.at.position)[axis];
        exact.zip(self.outer.at.position[axis]).is_some_and(|(a, b)| a != b)
    }

    fn take(&mut self, mut stmt: Stmt, made: &mut Rebuild, diags: &mut Vec<Diagnostic>) {
        self.inner.enter(stmt.skip);
        self.outer.enter(stmt.skip);
        let is_change = match &stmt.op {
            op if tilts(op) => false,
            Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_) => true,
            Op::ClearFrame(FrameSlot::Shift) | Op::UseOriginShift(_) => {
                let slots = &self.set.slots;
                self.set.lost || slots.origin != [None; AXES] || slots.suspended.is_some()
            }
            Op::ClearFrame(_) => true,
            _ => false,
        };
        let shift = Op::ClearFrame(FrameSlot::Shift);
        // Without words for it, a shift that is suspended is over, and set again where it is restored.
        let said = match &stmt.op {
            Op::UseOriginShift(false) if !self.target.caps.frames.suspends_shift => shift.clone(),
            op => op.clone(),
        };
        if is_change {
            match self.change(&stmt, &said) {
                Ok((reported, mut ops)) => {
                    if reported {
                        diags.push(Diagnostic::new(Fault::FramesExpanded, stmt.span));
                    }
                    // What an earlier program left is another's business.
                    if said == shift && !ops.contains(&shift) {
                        ops.push(shift.clone());
                    }
                    // That word is left out where the target has none (`origin_shift`).
                    let is_said = |op: &&Op| **op != shift || self.target.caps.frames.clears_shift;
                    for op in ops.iter().filter(is_said) {
                        self.outer.step(&Stmt { skip: stmt.skip, ..Stmt::new(stmt.span, op.clone()) });
                        self.note(op);
                    }
                    // Where frames are stated, what is made stands where the program does.
                    if self.set.chain == Chain::NONE {
                        for (made, own) in self.outer.at.position.iter_mut().zip(self.inner.at.position) {
                            *made = made.or(own);
                        }
                    }
                    return made.replace(stmt, ops.into_iter().map(|op| (false, op)));
                }
                Err(fault) => diags.push(Diagnostic::new(fault, stmt.span)),
            }
            return made.leave_out(stmt);
        }
        if stmt.op == Op::UseOriginShift(true) && !self.target.caps.frames.suspends_shift {
            return made.leave_out(stmt);
        }
        stmt.op = said;
        if self.is_shut(&stmt.op) {
            let span = stmt.span;
            if let Err(fault) = self.outside(stmt, made) {
                diags.push(Diagnostic::new(fault, span));
            }
            return;
        }
        if let (Op::ArcForm(arc), true) = (&stmt.op, self.goes_on()) {
            match self.arcs.by_centre(arc, &self.inner, EXACT) {
                Ok((op, _)) => stmt.op = op,
                Err(fault) => diags.push(Diagnostic::new(fault, stmt.span)),
            }
        }
        if !self.goes_on() {
            self.arcs.step(&stmt, &mut self.inner);
            self.outer.step(&stmt);
            return made.push(stmt);
        }
        let ops = match self.worked_in(&stmt.op) {
            Ok(ops) => ops,
            Err(fault) => {
                diags.push(Diagnostic::new(fault, stmt.span));
                Vec::new()
            }
        };
        if let (Op::Pattern(_), [.., Op::Hole(_)]) = (&stmt.op, &ops[..]) {
            let holes = ops.len() as u32;
            diags.push(Diagnostic::new(Fault::PatternExpanded { holes }, stmt.span));
        }
        self.advance(&stmt);
        if let Some(plane) = self.set.unplaced
            && ops.iter().chain(ops.is_empty().then_some(&stmt.op)).any(|op| moves_in(op, plane))
        {
            self.set.unplaced = None;
        }
        let Some(first) = ops.first() else {
            self.outer.step(&stmt);
            return made.push(stmt);
        };
        for op in &ops {
            let mut one = Stmt::new(stmt.span, op.clone());
            one.skip = stmt.skip;
            self.outer.step(&one);
        }
        if ops.len() == 1 {
            let op = first.clone();
            return made.push(Stmt { op, ..stmt });
        }
        let joined = stmt.joined;
        made.replace(stmt, ops.into_iter().enumerate().map(|(k, op)| (joined && k == 0, op)));
    }

    /// A step of the program: a move in machine coordinates leaves the other axes of the machine.
    fn advance(&mut self, stmt: &Stmt) {
        let raw = self.inner.at.raw;
        let before = self.set.whole.place_known(&self.inner.at.position);
        self.arcs.step(stmt, &mut self.inner);
        if let (true, Op::StraightTraverse(m) | Op::StraightFeed(m)) = (raw, &stmt.op) {
            let mut after = before;
            for (at, word) in after.iter_mut().zip(&m.to.axes) {
                if word.is_some() {
                    *at = None;
                }
            }
            self.inner.at.position = self.set.whole.unplace_known(&after);
        }
    }

    /// Other frames; `true` if they are some that were not reported.
    fn change(&mut self, stmt: &Stmt, said: &Op) -> Result<(bool, Vec<Op>), Fault> {
        let sets = !matches!(said, Op::ClearFrame(_));
        let caps = &self.target.caps;
        let as_it_stands =
            caps.says_frame(said) && self.set.chain == Chain::NONE && self.set.said == self.set.slots;
        if as_it_stands && !caps.frames.chain && (self.set.lost || stmt.skip.is_some()) {
            self.set.lost = true;
            self.inner.at.position = [None; AXES];
            return Ok((false, vec![said.clone()]));
        }
        let in_doubt = stmt.skip.is_some() && (sets || self.set.slots != Slots::NONE);
        if self.set.lost || in_doubt || !self.set.others.is_empty() {
            return self.change_in_doubt(stmt).map(|ops| (false, ops));
        }
        if self.chained {
            match said {
                // A chain that begins again leaves nothing of the one before.
                Op::SetFrame(frame) if !frame.added => self.chained = false,
                Op::ClearFrame(FrameSlot::Chain) => self.chained = false,
                Op::ClearFrame(_) => return Ok((false, Vec::new())),
                _ => return Err(cannot(FramesLack::BesideChain)),
            }
        }
        let here = self.set.whole.place_known(&self.inner.at.position);
        let before = self.set.slots.clone();
        let now = Now { at: &self.inner.at, work: here, shift: self.shift() };
        let mut slots = before.clone();
        match &stmt.op {
            Op::SetFrame(frame) => {
                if !frame.added {
                    slots.steps = Chain::NONE;
                }
                let range = || Fault::OutOfRange { word: "factor".into() };
                slots.steps.add(&frame.step, |plane| now.plane(plane), |value| now.value(value), range)?;
            }
            Op::SetSlot(slot) => slots.set(slot, &now)?,
            Op::SetPosition(axes) => slots.set_position(axes, &now.shift, &now)?,
            Op::ClearFrame(slot) => slots.clear(*slot),
            Op::UseOriginShift(false) => slots.suspend(false),
            Op::UseOriginShift(true) => {
                slots.resume();
                if slots == before && !caps.frames.suspends_shift {
                    return Ok((false, Vec::new()));
                }
            }
            _ => return Ok((false, Vec::new())),
        }
        let fresh = before == Slots::NONE
            || stmt.op == Op::UseOriginShift(true)
            || matches!(&stmt.op, Op::SetFrame(f) if !f.added);
        let new = shifted(&slots);
        let said = self.say(said, &slots, &new)?;
        let (ops, worked_in) = match said {
            Some(ops) => (ops, Chain::NONE),
            None => (self.unsay()?, new.clone()),
        };
        let in_force = self.inner.at.cycle.as_ref().map(|c| c.cycle.plane);
        if in_force.is_some() || self.inner.at.cycle_in_doubt {
            let plane = in_force.and_then(|plane| self.inner.at.plane(plane));
            let stays = |n: usize| new.shift()[n] == self.set.whole.shift()[n] && leaves_alone(&new, n);
            if !plane.is_some_and(|plane| stays(plane.axes().2 as usize)) {
                return Err(cannot(FramesLack::DrillingAxisMoved));
            }
        }
        let reported = sets && fresh && worked_in != Chain::NONE;
        self.set.chain = worked_in;
        self.set.whole = new;
        self.set.slots = slots;
        self.arcs.step(stmt, &mut self.inner);
        self.inner.at.position = self.set.whole.unplace_known(&here);
        Ok((reported, ops))
    }

    /// The statements that say the frames in the target's own form; `None` if it has none for them.
    fn say(&mut self, op: &Op, slots: &Slots, new: &Chain) -> Result<Option<Vec<Op>>, Fault> {
        let caps = &self.target.caps;
        let unit = self.inner.unit();
        if caps.frames.chain {
            let chained = |slots: &Slots| Slots { steps: Chain::NONE, ..slots.clone() } == Slots::NONE;
            if caps.says_frame(op) && chained(slots) && chained(&self.set.slots) {
                self.set.said_chain = slots.steps != Chain::NONE;
                return Ok(Some(vec![op.clone()]));
            }
            let ops = frame_forms::as_chain(slots, self.set.said_chain, unit);
            if let Some(ops) = &ops {
                self.set.said_chain = ops.iter().any(|op| matches!(op, Op::SetFrame(_)));
            }
            return Ok(ops);
        }
        // What can be stated as it stands is, while nothing else is in the way.
        if self.set.chain == Chain::NONE && self.set.said == self.set.slots {
            if caps.says_frame(op) {
                self.set.said = slots.clone();
                return Ok(Some(vec![op.clone()]));
            }
            if caps.frames.origin_shift && *op == Op::ClearFrame(FrameSlot::Shift) {
                let ops = self.origin_back(slots)?;
                self.set.said = slots.clone();
                return Ok(Some(ops));
            }
        }
        if self.set.said.origin != [None; AXES] {
            return Ok(None);
        }
        let digits = self.target.decimals_in(unit);
        let Some(wanted) = frame_forms::as_slots(new, &self.set.said, caps, digits, unit) else {
            return Ok(None);
        };
        let ops = frame_forms::between(&self.set.said, &wanted, caps, unit);
        if !ops.is_empty() && (self.inner.at.cycle.is_some() || self.inner.at.cycle_in_doubt) {
            return Ok(None);
        }
        self.set.said = wanted;
        Ok(Some(ops))
    }

    /// The statements that take a G92 shift back where no word does: the present point gets the
    /// coordinates that it has without one, and the local shift, which that ends, is stated again.
    fn origin_back(&self, slots: &Slots) -> Result<Vec<Op>, Fault> {
        if slots.is_turned() {
            return Err(cannot(FramesLack::ShiftEndInTurnedFrame));
        }
        if self.inner.at.cycle.is_some() || self.inner.at.cycle_in_doubt {
            return Err(cannot(FramesLack::ShiftEndInCycle));
        }
        let here = self.set.whole.place_known(&self.inner.at.position);
        let unit = self.inner.unit();
        let mut axes = [const { None }; AXES];
        let mut left = slots.clone();
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            if self.set.said.origin[i].is_none() {
                continue;
            }
            if axis == Axis::Z && self.inner.waiting {
                return Err(cannot(FramesLack::ShiftEndBeforeLength));
            }
            let at = here[i].ok_or(Fault::PositionUnknown { axis: axis.letter() as char })?;
            axes[i] = Some(Expr::Num(exact(at, unit_of(axis, unit))));
            left.local[i] = 0;
        }
        if axes == [const { None }; AXES] {
            return Ok(Vec::new());
        }
        let mut ops = vec![Op::SetPosition(Box::new(axes))];
        ops.extend(frame_forms::between(&left, slots, &self.target.caps, unit));
        Ok(ops)
    }

    /// The statements that take back what was said of frames, before coordinates are worked on.
    fn unsay(&mut self) -> Result<Vec<Op>, Fault> {
        let said = std::mem::replace(&mut self.set.said, Slots::NONE);
        let chain = std::mem::take(&mut self.set.said_chain);
        if said.origin != [None; AXES] || said.steps != Chain::NONE {
            return Err(cannot(FramesLack::BesidePresentPoint));
        }
        let mut ops = frame_forms::between(&said, &Slots::NONE, &self.target.caps, self.inner.unit());
        if chain {
            ops.push(Op::ClearFrame(FrameSlot::Chain));
        }
        if !ops.is_empty() && self.inner.at.cycle.is_some() {
            return Err(cannot(FramesLack::OtherFormInCycle));
        }
        Ok(ops)
    }

    /// After a rotation is set or taken back, controls do not agree about an axis of its plane that the
    /// next move there leaves out.
    fn note(&mut self, op: &Op) {
        match op {
            Op::SetSlot(slot) if !self.target.caps.frames.chain => {
                if let Slot::Rotation { plane, .. } = &**slot {
                    self.set.unplaced = self.inner.at.plane(*plane);
                }
            }
            Op::ClearFrame(FrameSlot::Rotation) => {
                self.set.unplaced = self.set.unplaced.or(self.inner.at.modes.plane).or(Some(Plane::Xy));
            }
            _ => {}
        }
    }

    /// What becomes of a statement under the chain; nothing if it stays as it is.
    fn worked_in(&self, op: &Op) -> Result<Vec<Op>, Fault> {
        let at = &self.inner.at;
        Ok(vec![match op {
            Op::StraightTraverse(_) | Op::StraightFeed(_) if at.raw => return Ok(Vec::new()),
            Op::StraightTraverse(m) => Op::StraightTraverse(self.moved(m)?),
            Op::StraightFeed(m) => Op::StraightFeed(self.moved(m)?),
            Op::SynchronisedFeed(m) => {
                if self.set.chain.turn().is_some() {
                    return Err(cannot(FramesLack::Thread));
                }
                Op::SynchronisedFeed(Box::new(Synchronised { to: self.point(&m.to)?, ..(**m).clone() }))
            }
            Op::Position(m) => Op::Position(self.moved(m)?),
            Op::Hole(m) => Op::Hole(self.moved(m)?),
            Op::ArcFeed(arc) => Op::ArcFeed(Box::new(self.arc(arc)?)),
            // One that is left could not be computed.
            Op::ArcForm(_) => return Ok(Vec::new()),
            Op::StartCycle(cycle) => Op::StartCycle(Box::new(self.cycle(cycle)?)),
            Op::Pattern(pattern) => return self.pattern(pattern),
            Op::Probe(_) if self.set.chain != Chain::NONE => {
                return Err(cannot(FramesLack::Probing));
            }
            Op::Detour(_) if self.set.chain != Chain::NONE => {
                return Err(cannot(FramesLack::Detour));
            }
            polar!() if self.set.chain != Chain::NONE => {
                return Err(cannot(FramesLack::PolarPoint));
            }
            polar!() => return Ok(Vec::new()),
            flow!() if self.set.chain != Chain::NONE => {
                return Err(cannot(FramesLack::NotStraightOn));
            }
            Op::GoToReference(reference) if !reference.via.is_empty() => {
                let via = self.point(&reference.via)?;
                Op::GoToReference(Box::new(Reference { via, ..(**reference).clone() }))
            }
            Op::StartCutterRadiusCompensation { side, radius } if self.set.chain != Chain::NONE => {
                let plane =
                    self.inner.at.modes.plane.ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
                match self.set.chain.sense(plane, Turn::Clockwise) {
                    Some(Turn::Clockwise) => return Ok(Vec::new()),
                    Some(Turn::Counterclockwise) => {
                        Op::StartCutterRadiusCompensation { side: side.other(), radius: radius.clone() }
                    }
                    None => {
                        return Err(cannot(FramesLack::CompensationWithoutArcs));
                    }
                }
            }
            Op::SetData(data) if matches!(**data, Data::Offset { mode: DataMode::Here, .. }) => {
                return Err(cannot(FramesLack::OffsetByPosition));
            }
            machine!()
            | Op::SetFeedRate(_)
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | miscellaneous!()
            | conduct!()
            | modes!()
            | tooling!()
            | frames!()
            | flow!() => return Ok(Vec::new()),
        }])
    }

    /// The G92 shift.
    fn shift(&self) -> [Nanos; AXES] {
        self.set.slots.origin.map(Option::unwrap_or_default)
    }
}

/// Whether a statement moves along an axis of a plane.
fn moves_in(op: &Op, plane: Plane) -> bool {
    let (first, second, _) = plane.axes();
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) => {
            m.to.get(first).is_some() || m.to.get(second).is_some()
        }
        Op::Polar(_) => true,
        _ => false,
    }
}

/// Whether a chain does no more to an axis than to move its zero.
fn leaves_alone(chain: &Chain, axis: usize) -> bool {
    chain.turn().is_none_or(|m| {
        let others = (0..3).filter(|j| *j != axis);
        let mut mixed = others.flat_map(|j| [m[axis][j], m[j][axis]]);
        mixed.all(|v| v.abs() < NOTHING) && (m[axis][axis] - 1.0).abs() < NOTHING
    })
}
