//! Lowering of moves: lines, and arcs in all the forms that the control knows; what a position means
//! while a cycle is active.
//!
//! A position under `MCALL` at G0 with words of the plane is a hole. Any other move is made first,
//! with the cycle off, and the hole where it ends. Under `MCALL` with a subprogram, a call follows
//! every move.
//!
//! Not here: the cycles themselves.

use ncc_dialects::{MACHINE_LENGTH, Meaning, NameMeaning, NameRole, Quantity, Role};
use ncc_ir::canon::{Axis, Distance, Fact, Plane, Turn};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::ONE;
use ncc_ir::program::{Arc, ArcForm, Centre, CentreFrom, Coord, Move, Op, Point, Shape, Turns};
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::siemens::block_words::{Code, Given, Words};
use crate::siemens::lower::Lower;
use crate::siemens::program::repeated_blocks::{CYCLE, MOTION};
use crate::siemens::siemens_state::{ModalCall, Motion};

const CENTRE: &[u8] = b"IJK";

/// Most turns that can be added to an arc.
const MOST_TURNS: u32 = 999;

const NAMED: [NameRole; 6] = [
    NameRole::Radius,
    NameRole::OpeningAngle,
    NameRole::Turns,
    NameRole::ThroughX,
    NameRole::ThroughY,
    NameRole::ThroughZ,
];

/// A word of an arc's centre.
type CentreWord = Option<(Expr, Option<Distance>)>;

impl Lower {
    /// The block's motion code, and its axis words.
    pub(in crate::siemens) fn motion_words(
        &mut self,
        motion: Option<(Code, Motion)>,
        machine: Option<Code>,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        if let Some((code, motion)) = motion {
            self.state.modes.motion = Know::Said(motion);
            self.repeated_blocks.say(MOTION);
            let foreign = matches!(self.state.cycle, ModalCall::Inherited { .. } | ModalCall::Lost { .. });
            if foreign && motion != Motion::Traverse {
                let what = MoveUnsupported::FeedInCallersCycle;
                self.not_supported(code.name, what, code.span, out);
            }
        }
        let line = |m| matches!(m, Motion::Traverse | Motion::Feed | Motion::Thread(_));
        let arc_now = self.state.modes.motion.value().is_some_and(|m| !line(m));
        let arc_words = words.has_any(CENTRE) || NAMED.iter().any(|&role| words.named(role).is_some());
        if !(words.has_point() || arc_now && arc_words) {
            self.motion_without_move |= motion.is_some();
            if let Some(code) = machine {
                // Without a move it does nothing.
                self.push(code.span, Op::NoEffect(code.name.into()), out);
            }
            return;
        }
        self.motion_without_move = false;
        self.repeated_blocks.use_fact(CYCLE);
        self.repeated_blocks.use_fact(MOTION);
        if let Some(Motion::Thread(thread)) = self.state.modes.motion.value() {
            self.moved = None;
            return self.thread(thread, machine, block, words, src, out);
        }
        match std::mem::take(&mut self.state.cycle) {
            cycle @ (ModalCall::None | ModalCall::Refused) => {
                self.state.cycle = cycle;
                let made = self.path(motion.is_some(), machine, block, words, src, out);
                self.moved = made;
            }
            ModalCall::Subprogram(after) => {
                self.moved = self.path(motion.is_some(), machine, block, words, src, out);
                if !self.now.failed {
                    self.call_after_move(&after, block, src, out);
                }
                self.state.cycle = ModalCall::Subprogram(after);
            }
            ModalCall::Active(cycle) => {
                self.state.cycle = ModalCall::Active(cycle.clone());
                self.moved = None;
                if self.state.modes.motion.value().is_none() {
                    self.take_rapid(block, out);
                }
                if cycle.relies_on_feed() {
                    self.rely_on_feed(block, out);
                }
                if self.is_position(machine, block, words, out) {
                    self.call_up_again(&cycle, block, out);
                    let Ok(polar) = self.polar_words(words, src, out) else { return };
                    let to = self.point(true, None, words, src, out);
                    self.push_to(polar, block, Op::Hole(Move { to, said: false }), out);
                } else if cycle.feed.is_some() && self.state.modes.motion.value() != Some(Motion::Traverse) {
                    // The way there has the program's feed; the cycle's takes effect in the hole.
                    let what = MoveUnsupported::PositionAtFeed;
                    self.not_supported(&src.text(block), what, block, out);
                } else if self.idle_tap {
                    // On the way there the spindle still has the speed that was stated before.
                    let what = MoveUnsupported::TapPosition;
                    self.idle_tap = false;
                    self.not_supported(&src.text(block), what, block, out);
                } else {
                    self.push(block, Op::EndCycle, out);
                    self.path(motion.is_some(), machine, block, words, src, out);
                    self.push(block, Op::StartCycle(cycle.clone()), out);
                    self.rely_on_frames(true, block, out);
                    self.push(block, Op::Hole(Move::default()), out);
                    (self.recall, self.idle_tap) = (false, false);
                }
                self.hole_made(&cycle);
            }
            ModalCall::Inherited { own_feed } => {
                self.state.cycle = ModalCall::Inherited { own_feed };
                if self.is_position(machine, block, words, out) {
                    self.position(words, block, src, out);
                } else if !self.now.failed {
                    let what = MoveUnsupported::NoPosition;
                    self.not_supported(&src.text(block), what, block, out);
                }
            }
            ModalCall::Lost { own_feed } => {
                self.state.cycle = ModalCall::Lost { own_feed };
                match (self.state.modes.motion.value(), machine) {
                    (None, None) => self.position(words, block, src, out),
                    _ => self.fault(Fault::EntryFactNeeded { fact: ModeName::Motion }, block, out),
                }
            }
        }
    }

    /// Whether the words are a position of a hole: at G0, and of the plane alone.
    fn is_position(&mut self, machine: Option<Code>, block: Span, words: &Words, out: &mut Batch) -> bool {
        let rapid = self.state.modes.motion.value().is_none_or(|m| m == Motion::Traverse);
        if !rapid || machine.is_some() {
            return false;
        }
        let Some(plane) = self.known_plane(block, out) else {
            return false;
        };
        let (first, second, _) = plane.axes();
        Axis::ALL.iter().all(|a| *a == first || *a == second || words.get(a.letter()).is_none())
    }

    /// Axis words that do whatever is active when the program runs.
    fn position(&mut self, words: &mut Words, block: Span, src: Source, out: &mut Batch) {
        let Ok(polar) = self.polar_words(words, src, out) else { return };
        let to = self.point(true, None, words, src, out);
        self.push_to(polar, block, Op::Position(Move { to, said: false }), out);
    }

    /// The move itself; gives what is active after it, if that is known.
    fn path(
        &mut self,
        said: bool,
        machine: Option<Code>,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<Motion> {
        let motion = self.motion(block, out).ok()?;
        match motion {
            None if machine.is_some() => {
                self.fault(Fault::EntryFactNeeded { fact: ModeName::Motion }, block, out);
            }
            None if self.cycled => {
                self.fault(Fault::EntryFactNeeded { fact: ModeName::Motion }, block, out);
            }
            None => self.position(words, block, src, out),
            Some(line @ (Motion::Traverse | Motion::Feed)) => {
                if line == Motion::Feed {
                    self.rely_on_feed(block, out);
                    self.corner(words, block, src, out);
                }
                self.rotary_ways(machine, words, src, out);
                let polar = self.polar_words(words, src, out).ok()?;
                let to = self.point(false, machine, words, src, out);
                if let (Some(code), true) = (machine, polar.is_some()) {
                    self.not_supported(code.name, MoveUnsupported::MachinePolar, code.span, out);
                }
                if let Some(code) = machine {
                    self.in_machine(code, &to, out);
                }
                let to = Move { to, said };
                let op = match line {
                    Motion::Feed => Op::StraightFeed(to),
                    _ => Op::StraightTraverse(to),
                };
                self.push_to(polar, block, op, out);
            }
            Some(arc) => {
                if let Some(code) = machine {
                    self.not_supported(code.name, MoveUnsupported::MachineArc, code.span, out);
                }
                self.rely_on_feed(block, out);
                self.corner(words, block, src, out);
                match arc {
                    Motion::Through => self.through(said, block, words, src, out),
                    Motion::Arc(turn) => self.arc(turn, said, block, words, src, out),
                    Motion::Tangent | Motion::Traverse | Motion::Feed | Motion::Thread(_) => {
                        let plane = self.plane(block, out);
                        let to = self.point(false, None, words, src, out);
                        let arc = ArcForm { plane, to, shape: Shape::Tangent, turns: 0, said };
                        self.push(block, Op::ArcForm(Box::new(arc)), out);
                    }
                }
            }
        }
        motion
    }

    /// Coordinates of the machine. Whether the tool's length counts in them is a setting of the control.
    fn in_machine(&mut self, code: Code, to: &Point, out: &mut Batch) {
        let counts = |length| NameMeaning::Code(Meaning::UseMachineCoordinates { length, rapid: false });
        if to.get(Axis::Z).is_some() && self.state.modes.length.value() != Some(false) {
            self.option(MACHINE_LENGTH, code.span, out);
        }
        self.push(code.span, Op::UseMachineCoordinates { length: code.meaning == counts(true) }, out);
    }

    /// The axis words that are left. With `hole`, the drilling axis moves as well.
    pub(in crate::siemens) fn point(
        &mut self,
        hole: bool,
        machine: Option<Code>,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Point {
        let mut to = Point::default();
        let mut at = None;
        for axis in Axis::ALL {
            let Some(given) = words.take(axis.letter()) else {
                continue;
            };
            at.get_or_insert(given.span);
            let row = self.settings.dialect.address_row(axis.letter()).filter(|row| row.role == Role::Axis);
            let Some(row) = row else {
                continue;
            };
            if let Some(coord) = self.coord(given, row.quantity, src, out) {
                if machine.is_some() && coord.distance == Fact::Known(Distance::Incremental) {
                    let what = MoveUnsupported::MachineIncrementWord;
                    self.not_supported(&src.text(given.span), what, given.span, out);
                }
                if let Some(stand) = self.stand.axes.get_mut(axis as usize) {
                    let absolute = coord.distance == Fact::Known(Distance::Absolute) && machine.is_none();
                    *stand = coord.value.literal().filter(|_| absolute);
                }
                to.set(axis, coord);
            }
        }
        if let Some(at) = at {
            self.rely_on_frames(hole || to.get(Axis::Z).is_some(), at, out);
        }
        to
    }

    /// The direction in which rotary axes turn in a line.
    fn rotary_ways(&mut self, machine: Option<Code>, words: &mut Words, src: Source, out: &mut Batch) {
        let mut directions = [None; 3];
        let mut at: Option<Span> = None;
        for (way, letter) in directions.iter_mut().zip(b"ABC") {
            let Some((said, span)) = words.take_way(*letter) else { continue };
            let angle = words.get(*letter).map(|given| given.digits);
            if machine.is_some() || words.has_polar() {
                let what = MoveUnsupported::RotaryMachine;
                return self.not_supported(&src.text(span), what, span, out);
            }
            if angle.is_some_and(|n| n.mantissa < 0) {
                return self.fault(Fault::OutOfRange { word: src.text(span).into() }, span, out);
            }
            *way = Some(said);
            at = Some(at.map_or(span, |at| at.to(span)));
        }
        if let Some(at) = at {
            self.push(at, Op::TurnRotaryAxes(directions), out);
        }
    }

    /// A coordinate.
    fn coord(&mut self, given: Given, quantity: Quantity, src: Source, out: &mut Batch) -> Option<Coord> {
        if given.way.is_some() {
            let what = MoveUnsupported::RotaryNoLine;
            self.not_supported(&src.text(given.span), what, given.span, out);
            return None;
        }
        let distance = match given.distance {
            Some(distance) => Fact::Known(distance),
            None => self.distance(given.span, out),
        };
        let value = self.amount(given, quantity, src, out)?;
        Some(Coord { value, distance })
    }

    /// `CIP`
    fn through(&mut self, said: bool, block: Span, words: &mut Words, src: Source, out: &mut Batch) {
        let plane = self.plane(block, out);
        let to = self.point(false, None, words, src, out);
        let mut via = Point::default();
        let roles = [NameRole::ThroughX, NameRole::ThroughY, NameRole::ThroughZ];
        for (axis, role) in [Axis::X, Axis::Y, Axis::Z].into_iter().zip(roles) {
            if let Some(given) = words.take_named(role)
                && let Some(coord) = self.coord(given, Quantity::Length, src, out)
            {
                via.set(axis, coord);
            }
        }
        // An axis that has an end and no point on the way could be anywhere there.
        if let Fact::Known(plane) = plane {
            let (first, second, _) = plane.axes();
            for axis in [first, second] {
                if via.get(axis).is_none() && (to.get(axis).is_some() || via.is_empty()) {
                    let word: &str = ["I1", "J1", "K1"].get(axis as usize).copied().unwrap_or_default();
                    let fault = Fault::WordMissing { code: "CIP".into(), word: word.into() };
                    return self.fault(fault, block, out);
                }
            }
        }
        let shape = Shape::Through(Box::new(via));
        self.push(block, Op::ArcForm(Box::new(ArcForm { plane, to, shape, turns: 0, said })), out);
    }

    /// `G2` and `G3`
    fn arc(&mut self, turn: Turn, said: bool, block: Span, words: &mut Words, src: Source, out: &mut Batch) {
        let plane = self.plane(block, out);
        let Ok(polar) = self.polar_words(words, src, out) else { return };
        let to = self.point(false, None, words, src, out);
        if let Some(polar) = polar {
            // The pole is the centre: words of another one are left, and blamed as ones that nothing uses.
            let Some(centre) = self.about_pole(&polar, block, out) else { return };
            let arc = Arc { plane, turn, to, centre, turns: Turns::NONE, said };
            return self.push_to(Some(polar), block, Op::ArcFeed(Box::new(arc)), out);
        }
        let mut centre: [CentreWord; 3] = [None, None, None];
        for (place, letter) in CENTRE.iter().enumerate() {
            // The word along the normal is left, and blamed as one that nothing uses.
            if matches!(plane, Fact::Known(p) if p.axes().2 as usize == place) {
                continue;
            }
            if let Some(given) = words.take(*letter) {
                let value = self.amount(given, Quantity::Length, src, out);
                centre[place] = value.map(|value| (value, given.distance));
            }
        }
        let about = centre.iter().any(Option::is_some);
        let radius = words.take_named(NameRole::Radius);
        let angle = words.take_named(NameRole::OpeningAngle);
        let turns = match words.take_named(NameRole::Turns) {
            None => 0,
            Some(given) => match self.read_whole(given, src, out) {
                Some(turns @ 0..=MOST_TURNS) => turns,
                Some(_) => {
                    return self.fault(
                        Fault::OutOfRange { word: src.text(given.span).into() },
                        given.span,
                        out,
                    );
                }
                None => return,
            },
        };
        if self.now.failed {
            return;
        }
        let ended = has_end(plane, &to);
        let op = match (about, radius, angle) {
            (_, Some(given), Some(_)) | (true, Some(given), None) => {
                return self.fault(Fault::ArcCentreAndRadius, given.span, out);
            }
            (true, None, Some(given)) if ended => {
                return self.fault(Fault::ArcCentreAndRadius, given.span, out);
            }
            (false, None, None) => return self.fault(Fault::ArcWithoutCentre, block, out),
            (false, None, Some(given)) if !ended => {
                return self.fault(Fault::ArcWithoutCentre, given.span, out);
            }
            (false, Some(_), None) if !ended => return self.fault(Fault::ArcRadiusNoWay, block, out),
            (false, Some(given), None) => {
                let Some(radius) = self.amount(given, Quantity::Length, src, out) else {
                    return;
                };
                if radius.literal().is_some_and(ncc_ir::expr::num::Num::is_zero) {
                    return self.fault(
                        Fault::OutOfRange { word: src.text(given.span).into() },
                        given.span,
                        out,
                    );
                }
                let centre = Centre::Radius(radius);
                Op::ArcFeed(Box::new(Arc { plane, turn, to, centre, turns: Turns::from(turns), said }))
            }
            (_, None, Some(given)) => {
                let Some(num) = self.number(given, Quantity::Angle, src, out) else {
                    return;
                };
                let inside = num.nanos(false).is_some_and(|a| a > 0 && a < 360 * ONE);
                if !inside {
                    return self.fault(
                        Fault::OutOfRange { word: src.text(given.span).into() },
                        given.span,
                        out,
                    );
                }
                let angle = Expr::Num(num);
                let shape = if about {
                    self.stand.forget();
                    Shape::AngleAbout { turn, angle, centre: Box::new(centre.map(coord_of)) }
                } else {
                    Shape::Angle { turn, angle }
                };
                Op::ArcForm(Box::new(ArcForm { plane, to, shape, turns, said }))
            }
            (true, None, None) => self.about(plane, turn, to, centre, turns, said),
        };
        self.push(block, op, out);
    }

    /// An arc by its centre: from the start, from zero, or one word so and the other so.
    fn about(
        &mut self,
        plane: Fact<Plane>,
        turn: Turn,
        to: Point,
        centre: [CentreWord; 3],
        turns: u32,
        said: bool,
    ) -> Op {
        let absolute = |word: &CentreWord| matches!(word, Some((_, Some(Distance::Absolute))));
        let zeros = centre.iter().filter(|w| absolute(w)).count();
        let given = centre.iter().filter(|w| w.is_some()).count();
        let from = match zeros {
            0 => CentreFrom::Start,
            2 if given == 2 => CentreFrom::Zero,
            _ => {
                let shape = Shape::Mixed { turn, centre: Box::new(centre.map(coord_of)) };
                return Op::ArcForm(Box::new(ArcForm { plane, to, shape, turns, said }));
            }
        };
        let words = centre.map(|word| word.map(|(value, _)| value));
        let turns = Turns::from(turns);
        Op::ArcFeed(Box::new(Arc { plane, turn, to, centre: Centre::Point { words, from }, turns, said }))
    }
}

/// A word of a centre: without `AC` it is measured from the start, under G90 too.
fn coord_of(word: CentreWord) -> Option<Coord> {
    let (value, distance) = word?;
    Some(Coord { value, distance: Fact::Known(distance.unwrap_or(Distance::Incremental)) })
}

/// Whether an arc has an end point in its plane.
fn has_end(plane: Fact<Plane>, to: &Point) -> bool {
    match plane {
        Fact::Known(plane) => {
            let (first, second, _) = plane.axes();
            to.get(first).is_some() || to.get(second).is_some()
        }
        Fact::Entry => !to.is_empty(),
    }
}
