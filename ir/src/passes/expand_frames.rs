//! `expand-frames`: chains of frames are worked into the coordinates.
//!
//! A translation moves absolute words and leaves increments alone. Rotations, factors and mirrors are
//! computed, every point from its exact place, so that roundings do not add up; a point is exact
//! where the chain is one of translations, mirrors and quarter turns, else rounded to the target's
//! digits. Positions must be known where axes are mixed. Words in machine coordinates stay.
//!
//! Refused by name: arcs that the chain does not leave arcs, cycles whose drilling axis it turns,
//! mirrors or scales, frames that may be skipped, and frames under calls, jumps and repetitions.

use super::walk::Walk;
use super::write::{EXACT, Rebuild, exact, rebuild, rounded, unit_of};
use super::{Target, arc_form, each_body, expand_patterns, pattern_forms};
use crate::canon::{Axis, Distance, Fact, Plane};
use crate::cycle::{Along, Cycle, First, Pattern, Row, absolute};
use crate::diag::{Diagnostic, Fault, ModeName};
use crate::exec::Chain;
use crate::expr::Expr;
use crate::kinds::{conduct, flow, frames, miscellaneous, modes, tooling};
use crate::num::{Nanos, Num, ONE, POW10, Unit};
use crate::places::Places;
use crate::program::{
    Arc, Centre, CentreFrom, Coord, Frame, FrameSlot, Move, Op, Point, Program, Stmt, Synchronised,
};
use crate::track::Tracker;

/// Less than this is no share of an axis.
const NOTHING: f64 = 1e-12;

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    /// The chain in force, and where the tool stands in the program's own coordinates.
    framed: Option<Box<(Chain, Walk, arc_form::State)>>,
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
        self.framed = None;
    }

    /// Facts that were taken for granted since.
    pub(super) fn assume(&mut self, assumed: &crate::canon::Modes) {
        if let Some(framed) = &mut self.framed {
            framed.1.assume(assumed);
        }
    }
}

/// Whether any procedure of a program sets a frame.
pub(super) fn has_frames(program: &Program) -> bool {
    program.procedures.iter().flat_map(|p| &p.body).any(|s| matches!(s.op, Op::SetFrame(_)))
}

/// The same for one piece of a body. The walk stands before what is made of it.
pub(super) fn over(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut State,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    if target.caps.frames {
        return;
    }
    let (chain, inner, arcs) = match state.framed.take() {
        Some(framed) => *framed,
        None => (Chain::NONE, walk.clone(), arc_form::State::default()),
    };
    let mut frames = Frames { chain, inner, arcs, outer: walk, target };
    rebuild(body, |stmt, made| frames.take(stmt, made, diags));
    let goes_on = frames.goes_on();
    let Frames { chain, inner, arcs, .. } = frames;
    state.framed = goes_on.then(|| Box::new((chain, inner, arcs)));
}

struct Frames<'f> {
    chain: Chain,
    /// Where the tool stands as the program sees it.
    inner: Walk,
    /// Which way it came.
    arcs: arc_form::State,
    /// Where it stands as what is made sees it.
    outer: &'f mut Walk,
    target: &'f Target,
}

impl Frames<'_> {
    /// Whether a frame is in force, or what is made stands at a rounded place that a frame has left.
    fn goes_on(&self) -> bool {
        self.chain != Chain::NONE || (0..3).any(|axis| self.is_rounded(axis))
    }

    /// Whether an axis stands, as it is written, at another place than the exact one.
    fn is_rounded(&self, axis: usize) -> bool {
        let exact = self.chain.place_known(&self.inner.at.position)[axis];
        exact.zip(self.outer.at.position[axis]).is_some_and(|(a, b)| a != b)
    }

    fn take(&mut self, mut stmt: Stmt, made: &mut Rebuild, diags: &mut Vec<Diagnostic>) {
        self.inner.enter(stmt.skip);
        self.outer.enter(stmt.skip);
        let step = match &stmt.op {
            Op::SetFrame(frame) => Some(Some(frame)),
            Op::ClearFrame(FrameSlot::Chain) => Some(None),
            _ => None,
        };
        if let Some(frame) = step {
            match self.change(&stmt, frame.map(|f| &**f)) {
                Ok(true) => diags.push(Diagnostic::new(Fault::FramesExpanded, stmt.span)),
                Ok(false) => {}
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
        let before = self.chain.place_known(&self.inner.at.position);
        self.arcs.step(stmt, &mut self.inner);
        if let (true, Op::StraightTraverse(m) | Op::StraightFeed(m)) = (raw, &stmt.op) {
            let mut after = before;
            for (at, word) in after.iter_mut().zip(&m.to.axes) {
                if word.is_some() {
                    *at = None;
                }
            }
            self.inner.at.position = self.chain.unplace_known(&after);
        }
    }

    /// Another chain; `true` if it is one that was not reported.
    fn change(&mut self, stmt: &Stmt, frame: Option<&Frame>) -> Result<bool, Fault> {
        if stmt.skip.is_some() && (frame.is_some() || self.chain != Chain::NONE) {
            return Err(cannot("a frame in a block that can be skipped"));
        }
        let here = self.chain.place_known(&self.inner.at.position);
        let mut new = self.chain.clone();
        let mut told = false;
        if let Some(frame) = frame {
            told = !frame.added || self.chain == Chain::NONE;
            if !frame.added {
                new = Chain::NONE;
            }
            let at = &self.inner.at;
            new.add(
                &frame.step,
                |plane| at.plane(plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane }),
                |value| value_of(at, value),
                || Fault::OutOfRange { word: "factor".into() },
            )?;
        } else {
            new = Chain::NONE;
        }
        let in_force = self.inner.at.cycle.as_ref().map(|c| c.cycle.plane);
        if in_force.is_some() || self.inner.at.cycle_in_doubt {
            let plane = in_force.and_then(|plane| self.inner.at.plane(plane));
            let stays = |n: usize| new.shift()[n] == self.chain.shift()[n] && leaves_alone(&new, n);
            if !plane.is_some_and(|plane| stays(plane.axes().2 as usize)) {
                return Err(cannot("a frame that moves the drilling axis of the cycle in force"));
            }
        }
        self.chain = new;
        self.arcs.step(stmt, &mut self.inner);
        self.inner.at.position = self.chain.unplace_known(&here);
        Ok(told && self.chain != Chain::NONE)
    }

    /// What becomes of a statement under the chain; nothing if it stays as it is.
    fn worked_in(&self, op: &Op) -> Result<Vec<Op>, Fault> {
        let at = &self.inner.at;
        Ok(vec![match op {
            Op::StraightTraverse(_) | Op::StraightFeed(_) if at.raw => return Ok(Vec::new()),
            Op::StraightTraverse(m) => Op::StraightTraverse(self.moved(m)?),
            Op::StraightFeed(m) => Op::StraightFeed(self.moved(m)?),
            Op::SynchronisedFeed(m) => {
                if self.chain.turn().is_some() {
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
            flow!() if self.chain != Chain::NONE => {
                return Err(cannot("a frame where the program does not go straight on"));
            }
            Op::SetFeedRate(_)
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

    /// Digits of a computed length: all, where the chain leaves it exact, or as many as the target
    /// has.
    fn decimals(&self) -> u8 {
        if self.is_exact() { EXACT } else { self.target.decimals_in(self.inner.unit()) }
    }

    /// Whether the chain is one of translations, mirrors and quarter turns.
    fn is_exact(&self) -> bool {
        let whole = |v: &f64| v.abs() < NOTHING || (v.abs() - 1.0).abs() < NOTHING;
        self.chain.turn().is_none_or(|m| m.iter().flatten().all(whole))
    }

    /// A coordinate moved along its axis.
    fn shifted(&self, word: &Coord, axis: Axis) -> Result<Coord, Fault> {
        let at = &self.inner.at;
        let by = self.chain.shift()[axis as usize];
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
        let after = self.chain.place_known(&self.inner.at.target(to));
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            let Some(row) = self.chain.turn().and_then(|m| m.get(i)) else {
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
        let mut out = arc.clone();
        // How a third axis goes with several turns depends on the very angle.
        let decimals = if arc.turns > 0 { EXACT } else { self.decimals() };
        out.to = self.point_to(&arc.to, decimals)?;
        if self.chain.turn().is_none() {
            if let Centre::Point { words, from: CentreFrom::Zero } = &mut out.centre {
                for axis in [first, second] {
                    if let Some(word) = &mut words[axis as usize] {
                        *word = self.shifted(&absolute(word.clone()), axis)?.value;
                    }
                }
            }
            return Ok(out);
        }
        let sense = self.chain.sense(plane, arc.turn);
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
        let middle = self.chain.place_known(&middle);
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
        if !leaves_alone(&self.chain, n) {
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
        if self.chain.turn().is_none() && !off {
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
            let p = self.chain.place_known(&p);
            Ok::<_, Fault>([
                p[first as usize].ok_or_else(|| unknown(first))?,
                p[second as usize].ok_or_else(|| unknown(second))?,
            ])
        };
        let all: Vec<[Nanos; 2]> =
            (0..places.count()).map(|k| outside(places.get(k))).collect::<Result<_, _>>()?;
        let (f, s) = (first as usize, second as usize);
        let turn = self.chain.turn().filter(|m| {
            (m[f][f] - m[s][s]).abs() < NOTHING
                && (m[f][s] + m[s][f]).abs() < NOTHING
                && (m[f][f].hypot(m[s][f]) - 1.0).abs() < 1e-9
        });
        if let (Some(m), false) = (turn, off) {
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
