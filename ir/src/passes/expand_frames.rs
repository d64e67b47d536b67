//! `expand-frames`: frames are said in the target's own form (`frame_forms`), or worked into the
//! coordinates.
//!
//! A translation moves absolute words and leaves increments alone. Rotations, factors and mirrors are
//! computed, every point from its exact place, so that roundings do not add up; a point is exact
//! where the chain is one of translations, mirrors and quarter turns, else rounded to the target's
//! digits. Positions must be known where axes are mixed. Words in machine coordinates stay.
//!
//! Refused by name: arcs that the chain does not leave arcs, cycles whose drilling axis it turns,
//! mirrors or scales, frames that may be skipped, and frames under calls, jumps and repetitions.

use super::frame_forms::{self, shifted};
use super::walk::Walk;
use super::write::{EXACT, Rebuild, exact, rebuild, rounded, unit_of};
use super::{Target, arc_form, each_body, expand_patterns, pattern_forms};
use crate::canon::{AXES, Axis, Distance, Fact, Plane};
use crate::caps::Caps;
use crate::cycle::{Along, Cycle, First, Pattern, Row, absolute};
use crate::diag::{Diagnostic, Fault, ModeName};
use crate::exec::{Chain, Frames as Slots, Present};
use crate::expr::Expr;
use crate::kinds::{conduct, flow, frames, machine, miscellaneous, modes, tooling};
use crate::num::{Nanos, Num, ONE, POW10, Unit};
use crate::places::Places;
use crate::program::{
    Arc, Centre, CentreFrom, Coord, Data, DataMode, FrameSlot, Move, Op, Point, Program, Reference, Slot,
    Stmt, Synchronised,
};
use crate::track::Tracker;

/// Less than this is no share of an axis.
const NOTHING: f64 = 1e-12;

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    /// The frames in force, and where the tool stands in the program's own coordinates.
    framed: Option<Box<(Set, Walk, arc_form::State)>>,
    /// Whether a chain may be in force that the target says as it stands.
    chained: bool,
}

/// Works the frames in.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| over(body, walk, &mut State::default(), target, diags));
}

impl State {
    /// Whether a frame is in force.
    pub(super) fn is_busy(&self) -> bool {
        self.framed.is_some()
    }

    /// At the start of another body.
    pub(super) fn start_over(&mut self) {
        *self = State::default();
    }

    /// Passes over statements of which none is this pass's business.
    pub(super) fn note(&mut self, body: &[Stmt]) {
        for stmt in body {
            match &stmt.op {
                Op::SetFrame(_) => self.chained = true,
                Op::ClearFrame(FrameSlot::Chain) => self.chained &= stmt.skip.is_some(),
                _ => {}
            }
        }
    }

    /// Facts that were taken for granted since.
    pub(super) fn assume(&mut self, assumed: &crate::canon::Modes) {
        if let Some(framed) = &mut self.framed {
            framed.1.assume(assumed);
        }
    }
}

/// Whether a statement is this pass's business: a change of frames, unless all that the target has is a
/// chain and this is one of its steps.
pub(super) fn concerns(op: &Op, caps: &Caps) -> bool {
    match op {
        Op::SetFrame(_) | Op::ClearFrame(FrameSlot::Chain) => !caps.frames,
        Op::SetSlot(_) | Op::SetPosition(_) => true,
        Op::ClearFrame(slot) => *slot != FrameSlot::Shift,
        _ => false,
    }
}

/// Whether any procedure of a program sets a frame that the target cannot say as it is.
pub(super) fn has_frames(program: &Program, caps: &Caps) -> bool {
    let sets = |op: &Op| matches!(op, Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_));
    program.procedures.iter().flat_map(|p| &p.body).any(|s| sets(&s.op) && !caps.says_frame(&s.op))
}

/// The same for one piece of a body. The walk stands before what is made of it.
pub(super) fn over(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut State,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    if state.framed.is_none() && !body.iter().any(|stmt| concerns(&stmt.op, &target.caps)) {
        return state.note(body);
    }
    let (set, inner, arcs) = match state.framed.take() {
        Some(framed) => *framed,
        None => (Set::NONE, walk.clone(), arc_form::State::default()),
    };
    let mut frames = Frames { set, inner, arcs, outer: walk, target, chained: state.chained };
    rebuild(body, |stmt, made| frames.take(stmt, made, diags));
    let goes_on = frames.goes_on();
    let Frames { set, inner, arcs, chained, .. } = frames;
    state.chained = chained;
    state.framed = goes_on.then(|| Box::new((set, inner, arcs)));
}

/// What is in force.
#[derive(Clone, Debug, PartialEq)]
struct Set {
    /// What the program has set.
    slots: Slots,
    /// What that amounts to, with the shift of the origin.
    whole: Chain,
    /// What of it coordinates must be changed by: all of it, or nothing.
    chain: Chain,
    /// What has been written of it: slots of a target that has them.
    said: Slots,
    /// Whether a chain has been written.
    said_chain: bool,
    /// A plane of which the next move must name both axes, absolutely.
    unplaced: Option<Plane>,
    /// Whether what is in force depends on a block-skip switch; all of it has been said as it stood.
    lost: bool,
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
    };
}

struct Frames<'f> {
    set: Set,
    /// Where the tool stands as the program sees it.
    inner: Walk,
    /// Which way it came.
    arcs: arc_form::State,
    /// Where it stands as what is made sees it.
    outer: &'f mut Walk,
    target: &'f Target,
    /// Whether a chain may be in force that was said as it stood, before this pass had any business.
    chained: bool,
}

impl Frames<'_> {
    /// Whether a frame is in force, or what is made stands at a rounded place that a frame has left.
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
            Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_) => true,
            Op::ClearFrame(FrameSlot::Shift) => self.set.slots.origin != [None; AXES],
            Op::ClearFrame(_) => true,
            _ => false,
        };
        if is_change {
            match self.change(&stmt) {
                Ok((told, mut ops)) => {
                    if told {
                        diags.push(Diagnostic::new(Fault::FramesExpanded, stmt.span));
                    }
                    // What an earlier program left is another's business.
                    let shift = Op::ClearFrame(FrameSlot::Shift);
                    if stmt.op == shift && !ops.contains(&shift) {
                        ops.push(shift);
                    }
                    for op in &ops {
                        self.outer.step(&Stmt::new(stmt.span, op.clone()));
                        self.note(op);
                    }
                    return made.replace(stmt, ops.into_iter().map(|op| (false, op)));
                }
                Err(fault) => diags.push(Diagnostic::new(fault, stmt.span)),
            }
            return made.leave_out(stmt);
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
    fn change(&mut self, stmt: &Stmt) -> Result<(bool, Vec<Op>), Fault> {
        let sets = !matches!(stmt.op, Op::ClearFrame(_));
        let caps = &self.target.caps;
        let as_it_stands =
            caps.says_frame(&stmt.op) && self.set.chain == Chain::NONE && self.set.said == self.set.slots;
        if as_it_stands && !caps.frames && (self.set.lost || stmt.skip.is_some()) {
            self.set.lost = true;
            self.inner.at.position = [None; AXES];
            return Ok((false, vec![stmt.op.clone()]));
        }
        if self.set.lost || stmt.skip.is_some() && (sets || self.set.slots != Slots::NONE) {
            return Err(cannot("a frame in a block that can be skipped"));
        }
        if self.chained {
            match &stmt.op {
                // A chain that begins anew leaves nothing of the one before.
                Op::SetFrame(frame) if !frame.added => self.chained = false,
                Op::ClearFrame(FrameSlot::Chain) => self.chained = false,
                Op::ClearFrame(_) => return Ok((false, Vec::new())),
                _ => return Err(cannot("a shift, rotation, scale or mirror beside a chain of frames")),
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
            _ => return Ok((false, Vec::new())),
        }
        let fresh = before == Slots::NONE || matches!(&stmt.op, Op::SetFrame(f) if !f.added);
        let new = shifted(&slots);
        let said = self.say(&stmt.op, &slots, &new)?;
        let (ops, worked_in) = match said {
            Some(ops) => (ops, Chain::NONE),
            None => (self.unsay()?, new.clone()),
        };
        let in_force = self.inner.at.cycle.as_ref().map(|c| c.cycle.plane);
        if in_force.is_some() || self.inner.at.cycle_in_doubt {
            let plane = in_force.and_then(|plane| self.inner.at.plane(plane));
            let stays = |n: usize| new.shift()[n] == self.set.whole.shift()[n] && leaves_alone(&new, n);
            if !plane.is_some_and(|plane| stays(plane.axes().2 as usize)) {
                return Err(cannot("a frame that moves the drilling axis of the cycle in force"));
            }
        }
        let told = sets && fresh && worked_in != Chain::NONE;
        self.set.chain = worked_in;
        self.set.whole = new;
        self.set.slots = slots;
        self.arcs.step(stmt, &mut self.inner);
        self.inner.at.position = self.set.whole.unplace_known(&here);
        Ok((told, ops))
    }

    /// The statements that say the frames in the target's own form; `None` if it has none for them.
    fn say(&mut self, op: &Op, slots: &Slots, new: &Chain) -> Result<Option<Vec<Op>>, Fault> {
        let caps = &self.target.caps;
        let unit = self.inner.unit();
        if caps.frames {
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
        // What can be said as it stands is, while nothing else is in the way.
        if caps.says_frame(op) && self.set.chain == Chain::NONE && self.set.said == self.set.slots {
            self.set.said = slots.clone();
            return Ok(Some(vec![op.clone()]));
        }
        if self.set.said.origin != [None; AXES] {
            return Ok(None);
        }
        let digits = self.target.decimals_in(unit);
        let Some(wanted) = frame_forms::as_slots(new, caps, digits, unit) else { return Ok(None) };
        let ops = frame_forms::between(&self.set.said, &wanted, caps, unit);
        if !ops.is_empty() && (self.inner.at.cycle.is_some() || self.inner.at.cycle_in_doubt) {
            return Ok(None);
        }
        self.set.said = wanted;
        Ok(Some(ops))
    }

    /// The statements that take back what was said of frames, before coordinates are worked on.
    fn unsay(&mut self) -> Result<Vec<Op>, Fault> {
        let said = std::mem::replace(&mut self.set.said, Slots::NONE);
        let chain = std::mem::take(&mut self.set.said_chain);
        if said.origin != [None; AXES] || said.steps != Chain::NONE {
            return Err(cannot("this frame beside coordinates of the present point"));
        }
        let mut ops = frame_forms::between(&said, &Slots::NONE, &self.target.caps, self.inner.unit());
        if chain {
            ops.push(Op::ClearFrame(FrameSlot::Chain));
        }
        if !ops.is_empty() && self.inner.at.cycle.is_some() {
            return Err(cannot("another form of frame while a cycle is in force"));
        }
        Ok(ops)
    }

    /// After a rotation is set or taken back, controls do not agree about an axis of its plane that the
    /// next move there leaves out.
    fn note(&mut self, op: &Op) {
        match op {
            Op::SetSlot(slot) if !self.target.caps.frames => {
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

    /// Both axes of the plane in which the tool must be placed, as absolute words.
    fn placed(&self, out: &mut Point, after: &[Option<Nanos>; AXES]) -> Result<(), Fault> {
        let Some(plane) = self.set.unplaced else { return Ok(()) };
        let (first, second, _) = plane.axes();
        let in_force = self.inner.at.modes.distance;
        let is_absolute = |axis: Axis, out: &Point| {
            let word = out.get(axis);
            word.is_some_and(|w| w.distance.known().or(in_force) == Some(Distance::Absolute))
        };
        if [first, second].iter().all(|axis| out.get(*axis).is_none()) {
            return Ok(());
        }
        for axis in [first, second] {
            if !is_absolute(axis, out) {
                let nanos = after[axis as usize];
                let nanos = nanos.ok_or(Fault::PositionUnknown { axis: axis.letter() as char })?;
                out.set(axis, absolute(exact(nanos, unit_of(axis, self.inner.unit()))));
            }
        }
        Ok(())
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
                    return Err(cannot("a thread in a turned or scaled frame"));
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
            flow!() if self.set.chain != Chain::NONE => {
                return Err(cannot("a frame where the program does not go straight on"));
            }
            Op::GoToReference(reference) if !reference.via.is_empty() => {
                let via = self.point(&reference.via)?;
                Op::GoToReference(Box::new(Reference { via, ..(**reference).clone() }))
            }
            Op::SetData(data) if matches!(**data, Data::Offset { mode: DataMode::Here, .. }) => {
                return Err(cannot("a work offset set by the position under a frame"));
            }
            machine!()
            | Op::SetFeedRate(_)
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::Message(_)
            | Op::Assign(..)
            | miscellaneous!()
            | conduct!()
            | modes!()
            | tooling!()
            | frames!()
            | flow!() => return Ok(Vec::new()),
        }])
    }

    /// The shift of the origin.
    fn shift(&self) -> [Nanos; AXES] {
        self.set.slots.origin.map(Option::unwrap_or_default)
    }

    /// Digits of a computed length: all, where the chain leaves it exact, or as many as the target
    /// has.
    fn decimals(&self) -> u8 {
        if self.is_exact() { EXACT } else { self.target.decimals_in(self.inner.unit()) }
    }

    /// Whether the chain is one of translations, mirrors and quarter turns.
    fn is_exact(&self) -> bool {
        let whole = |v: &f64| v.abs() < NOTHING || (v.abs() - 1.0).abs() < NOTHING;
        self.set.chain.turn().is_none_or(|m| m.iter().flatten().all(whole))
    }

    /// A coordinate moved along its axis.
    fn shifted(&self, word: &Coord, axis: Axis) -> Result<Coord, Fault> {
        let at = &self.inner.at;
        let by = self.set.chain.shift()[axis as usize];
        match word.distance.known().or(at.modes.distance) {
            None => Err(Fault::EntryFactNeeded { fact: ModeName::Distance }),
            Some(Distance::Incremental) => Ok(word.clone()),
            Some(Distance::Absolute) if by == 0 => Ok(word.clone()),
            Some(Distance::Absolute) => {
                let value = value_of(at, &word.value)?;
                let unit = unit_of(axis, self.inner.unit());
                Ok(absolute(exact(value.wrapping_add(by), unit)))
            }
        }
    }

    fn moved(&self, m: &Move) -> Result<Move, Fault> {
        Ok(Move { to: self.point(&m.to)?, said: m.said })
    }

    fn point(&self, to: &Point) -> Result<Point, Fault> {
        self.point_to(to, self.decimals())
    }

    fn point_to(&self, to: &Point, decimals: u8) -> Result<Point, Fault> {
        let unit = self.inner.unit();
        let mut out = Point::default();
        let after = self.set.chain.place_known(&self.inner.at.target(to));
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            let Some(row) = self.set.chain.turn().and_then(|m| m.get(i)) else {
                if let Some(word) = to.get(axis) {
                    out.set(axis, self.shifted(word, axis)?);
                }
                continue;
            };
            let from = || (0..3).filter(|j| row[*j].abs() >= NOTHING);
            let word = to.get(axis);
            let takes_up = axis == Axis::Z && self.inner.waiting;
            if !(from().any(|j| to.axes[j].is_some()) || takes_up && word.is_some()) {
                continue;
            }
            if takes_up && word.is_none() {
                return Err(cannot("a length offset that waits in a turned frame"));
            }
            // Along its own axis an increment is one outside as well.
            if from().eq([i])
                && (row[i].abs() - 1.0).abs() < NOTHING
                && let Some(word) = word
                && word.distance.known().or(self.inner.at.modes.distance) == Some(Distance::Incremental)
            {
                out.set(axis, if row[i] > 0.0 { word.clone() } else { negative(word)? });
                continue;
            }
            let Some(nanos) = after[i] else {
                let target = self.inner.at.target(to);
                let unknown = from().find(|j| target[*j].is_none()).unwrap_or(i);
                return Err(self.unknown(Axis::ALL[unknown], to));
            };
            out.set(axis, absolute(rounded(nanos, decimals, unit_of(axis, unit))));
        }
        self.placed(&mut out, &after)?;
        Ok(out)
    }

    /// Why it is not known where an axis goes.
    fn unknown(&self, axis: Axis, to: &Point) -> Fault {
        let distance = |w: &Coord| w.distance.known().or(self.inner.at.modes.distance).is_none();
        match to.get(axis) {
            Some(word) if distance(word) => Fault::EntryFactNeeded { fact: ModeName::Distance },
            Some(_) | None => Fault::PositionUnknown { axis: axis.letter() as char },
        }
    }

    fn arc(&self, arc: &Arc) -> Result<Arc, Fault> {
        let at = &self.inner.at;
        let plane = at.plane(arc.plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
        let (first, second, _) = plane.axes();
        if self.set.unplaced.is_some() {
            return Err(cannot("an arc as the first move of another rotation"));
        }
        let mut out = arc.clone();
        // How a third axis goes with several turns depends on the very angle.
        let decimals = if arc.turns > 0 { EXACT } else { self.decimals() };
        out.to = self.point_to(&arc.to, decimals)?;
        if self.set.chain.turn().is_none() {
            if let Centre::Point { words, from: CentreFrom::Zero } = &mut out.centre {
                for axis in [first, second] {
                    if let Some(word) = &mut words[axis as usize] {
                        *word = self.shifted(&absolute(word.clone()), axis)?.value;
                    }
                }
            }
            return Ok(out);
        }
        let sense = self.set.chain.sense(plane, arc.turn);
        out.turn = sense.ok_or_else(|| cannot("an arc in a frame that does not leave it an arc"))?;
        out.plane = Fact::Known(plane);
        let unknown = |axis: Axis| Fault::PositionUnknown { axis: axis.letter() as char };
        let centre = at.centre(arc).ok_or_else(|| unknown(first))?;
        let mut middle = at.target(&arc.to);
        let start = [first, second].map(|a| at.position[a as usize]);
        let end = [first, second].map(|a| middle[a as usize]);
        for (axis, place) in [first, second].into_iter().zip(centre) {
            middle[axis as usize] = Some(place);
        }
        let middle = self.set.chain.place_known(&middle);
        if start == end {
            // A whole circle stays one, however its ends are rounded.
            out.to.axes[first as usize] = None;
            out.to.axes[second as usize] = None;
        }
        let mut words: [Option<Expr>; 3] = [None, None, None];
        for axis in [first, second] {
            // From where the axis stands as it is written.
            let from = self.outer.at.position[axis as usize].ok_or_else(|| unknown(axis))?;
            let to = middle[axis as usize].ok_or_else(|| unknown(axis))?;
            let unit = self.inner.unit();
            let way = rounded(to.wrapping_sub(from), decimals, unit_of(axis, unit));
            words[axis as usize] = Some(way.into());
        }
        out.centre = Centre::Point { words, from: CentreFrom::Start };
        Ok(out)
    }

    fn cycle(&self, cycle: &Cycle) -> Result<Cycle, Fault> {
        let plane = self.inner.at.plane(cycle.plane);
        let plane = plane.ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
        let (_, _, normal) = plane.axes();
        let n = normal as usize;
        if !leaves_alone(&self.set.chain, n) {
            return Err(cannot("a cycle in a frame that turns, mirrors or scales its drilling axis"));
        }
        let mut out = cycle.clone();
        out.plane = Fact::Known(plane);
        out.retract = self.shifted(&cycle.retract, normal)?;
        out.depth = self.shifted(&cycle.depth, normal)?;
        out.return_plane = cycle.return_plane.as_ref().map(|p| self.shifted(p, normal)).transpose()?;
        Ok(out)
    }

    fn pattern(&self, pattern: &Pattern) -> Result<Vec<Op>, Fault> {
        let at = &self.inner.at;
        let plane = at.cycle.as_ref().map_or(Fact::Entry, |c| c.cycle.plane);
        let plane = at.plane(plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
        let (first, second, _) = plane.axes();
        let axes = [first, second];
        let off = axes.into_iter().any(|axis| self.is_rounded(axis as usize));
        if self.set.chain.turn().is_none() && !off && self.set.unplaced.is_none() {
            return Ok(vec![Op::Pattern(Box::new(self.shifted_pattern(pattern, axes)?))]);
        }
        let unknown = |axis: Axis| Fault::PositionUnknown { axis: axis.letter() as char };
        let places = at.places(pattern).filter(|p| p.count() <= expand_patterns::MOST_HOLES);
        let places = places.ok_or_else(|| {
            unknown(axes.into_iter().find(|a| at.position[*a as usize].is_none()).unwrap_or(first))
        })?;
        let outside = |place: [Nanos; 2]| {
            let mut p = at.position;
            (p[first as usize], p[second as usize]) = (Some(place[0]), Some(place[1]));
            let p = self.set.chain.place_known(&p);
            Ok::<_, Fault>([
                p[first as usize].ok_or_else(|| unknown(first))?,
                p[second as usize].ok_or_else(|| unknown(second))?,
            ])
        };
        let all: Vec<[Nanos; 2]> =
            (0..places.count()).map(|k| outside(places.get(k))).collect::<Result<_, _>>()?;
        let (f, s) = (first as usize, second as usize);
        let turn = self.set.chain.turn().filter(|m| {
            (m[f][f] - m[s][s]).abs() < NOTHING
                && (m[f][s] + m[s][f]).abs() < NOTHING
                && (m[f][f].hypot(m[s][f]) - 1.0).abs() < 1e-9
        });
        if let (Some(m), false, None) = (turn, off, self.set.unplaced) {
            let angle = (m[s][f].atan2(m[f][f]).to_degrees() * ONE as f64).round() as Nanos;
            if let Some(form) = self.turned(pattern, &places, angle, axes, &outside)?
                && self.says(&form, plane, &all)
            {
                return Ok(vec![Op::Pattern(Box::new(form))]);
            }
        }
        let unit = self.inner.unit();
        let hole = |place: &[Nanos; 2]| {
            let mut to = Point::default();
            for (axis, place) in axes.into_iter().zip(place) {
                to.set(axis, absolute(rounded(*place, self.decimals(), unit_of(axis, unit))));
            }
            Op::Hole(Move { to, said: false })
        };
        Ok(all.iter().map(hole).collect())
    }

    /// Whether the target has this very form, and its holes are where they must be.
    fn says(&self, form: &Pattern, plane: Plane, places: &[[Nanos; 2]]) -> bool {
        let at_once = pattern_forms::fit(self.outer, form, plane, self.target);
        let unit = self.inner.unit();
        let half = POW10[9 - self.target.decimals_in(unit).min(9) as usize];
        let half = if unit == Unit::Inch { half * 254 / 10 } else { half } / 2;
        let near = |a: &[Nanos; 2], b: &[Nanos; 2]| (0..2).all(|i| a[i].abs_diff(b[i]) <= half as u64);
        at_once.is_some_and(|forms| forms == [form.clone()])
            && self.outer.at.positions(form).is_some_and(|own| {
                own.len() == places.len() && own.iter().zip(places).all(|(a, b)| near(a, b))
            })
    }

    /// A pattern turned in its plane; `None` if that is better said by its holes.
    fn turned(
        &self,
        pattern: &Pattern,
        places: &Places,
        by: Nanos,
        axes: [Axis; 2],
        outside: &dyn Fn([Nanos; 2]) -> Result<[Nanos; 2], Fault>,
    ) -> Result<Option<Pattern>, Fault> {
        let at = &self.inner.at;
        // With all digits, for what is computed from them later.
        let words = |place: [Nanos; 2]| {
            let (place, unit) = (outside(place)?, self.inner.unit());
            Ok::<_, Fault>([0, 1].map(|i| absolute(exact(place[i], unit_of(axes[i], unit)))))
        };
        let start = |said: &Option<[Coord; 2]>, place: [Nanos; 2]| match said {
            Some(_) => words(place).map(Some),
            None => Ok(None),
        };
        let further = |angle: Nanos| -> Expr {
            let whole = 360 * ONE;
            let angle = (angle.rem_euclid(whole) + by).rem_euclid(whole);
            let angle = if angle > 180 * ONE { angle - whole } else { angle };
            Num::from_nanos(angle, 9, Unit::Degree).into()
        };
        Ok(match (pattern, places) {
            (Pattern::Circle { centre, first, step, count }, Places::Circle { centre: c, first: f, .. }) => {
                let first = match first {
                    // Two roundings would add up on the way round.
                    First::At(_) if !self.is_exact() => return Ok(None),
                    First::At(_) => First::At(words(*f)?),
                    First::Polar { radius, angle } => {
                        First::Polar { radius: radius.clone(), angle: further(value_of(at, angle)?) }
                    }
                };
                let centre = start(centre, *c)?;
                Some(Pattern::Circle { centre, first, step: step.clone(), count: *count })
            }
            (
                Pattern::Line { start: s, offset, pitch, count, .. },
                Places::Line { start: place, angle, .. },
            ) => {
                let start = start(s, *place)?;
                let (offset, pitch) = (offset.clone(), pitch.clone());
                Some(Pattern::Line { start, angle: further(*angle), offset, pitch, count: *count })
            }
            (
                Pattern::Grid { start: s, columns, rows, serpentine },
                Places::Grid { start: place, columns: c, rows: r, .. },
            ) => {
                let start = start(s, *place)?;
                let row = |row: &Row, along: Result<usize, Nanos>| Row {
                    along: Along::Angle(further(along.map_or_else(|a| a, |side| side as Nanos * 90 * ONE))),
                    pitch: row.pitch.clone(),
                    count: row.count,
                };
                let (columns, rows) = (row(columns, c.along), row(rows, r.along));
                Some(Pattern::Grid { start, columns, rows, serpentine: *serpentine })
            }
            _ => None,
        })
    }

    fn shifted_pattern(&self, pattern: &Pattern, axes: [Axis; 2]) -> Result<Pattern, Fault> {
        let mut out = pattern.clone();
        let shift = |pair: &mut [Coord; 2]| {
            for (word, axis) in pair.iter_mut().zip(axes) {
                *word = self.shifted(word, axis)?;
            }
            Ok::<_, Fault>(())
        };
        match &mut out {
            Pattern::Circle { centre, first, .. } => {
                centre.iter_mut().try_for_each(shift)?;
                if let First::At(first) = first {
                    shift(first)?;
                }
            }
            Pattern::Line { start, .. } | Pattern::Grid { start, .. } => {
                start.iter_mut().try_for_each(shift)?;
            }
            Pattern::List(points) => {
                for point in points {
                    for axis in axes {
                        if let Some(word) = &mut point.axes[axis as usize] {
                            *word = self.shifted(word, axis)?;
                        }
                    }
                }
            }
        }
        Ok(out)
    }
}

/// What is known where a frame changes.
struct Now<'t> {
    at: &'t Tracker,
    /// Where the tool stands in the work offset.
    work: [Option<Nanos>; AXES],
    shift: [Nanos; AXES],
}

impl Present for Now<'_> {
    type Unknown = Fault;

    fn plane(&self, plane: Fact<Plane>) -> Result<Plane, Fault> {
        self.at.plane(plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })
    }

    fn value(&self, value: &Expr) -> Result<Nanos, Fault> {
        value_of(self.at, value)
    }

    fn distance(&self, word: &Coord) -> Result<Distance, Fault> {
        let distance = word.distance.known().or(self.at.modes.distance);
        distance.ok_or(Fault::EntryFactNeeded { fact: ModeName::Distance })
    }

    fn work(&self, axis: usize) -> Result<Nanos, Fault> {
        let at = self.work[axis].ok_or(Fault::PositionUnknown { axis: Axis::ALL[axis].letter() as char })?;
        Ok(at.wrapping_sub(self.shift[axis]))
    }

    fn out_of_range(&self) -> Fault {
        Fault::OutOfRange { word: "factor".into() }
    }
}

/// Whether a statement moves along an axis of a plane.
fn moves_in(op: &Op, plane: Plane) -> bool {
    let (first, second, _) = plane.axes();
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) => {
            m.to.get(first).is_some() || m.to.get(second).is_some()
        }
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

fn cannot(what: &str) -> Fault {
    Fault::CannotSay { what: what.into() }
}

/// A literal's value.
fn value_of(at: &Tracker, value: &Expr) -> Result<Nanos, Fault> {
    at.nanos(value).ok_or_else(|| match value.literal() {
        Some(n) if n.unit == Unit::Entry => Fault::EntryFactNeeded { fact: ModeName::Units },
        Some(_) | None => cannot("a computed word in a frame"),
    })
}

/// The same increment the other way.
fn negative(word: &Coord) -> Result<Coord, Fault> {
    let n = word.value.literal().ok_or_else(|| cannot("a computed word in a frame"))?;
    let value = Num { mantissa: n.mantissa.wrapping_neg(), ..n };
    Ok(Coord { value: value.into(), distance: Fact::Known(Distance::Incremental) })
}
