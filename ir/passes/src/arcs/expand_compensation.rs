//! `expand-compensation`: writes the tool centre path in place of a contour and the side on which
//! the tool goes along it.
//!
//! The radius must be known: the program states a diameter, has put a radius into the table, or a profile
//! has the tool's. Every leg is written with coordinates of the plane from program zero; corners away from
//! the tool get an arc before the move that follows them. Refused is a contour that cannot be gone along
//! without cutting into it ([`ncc_ir::geometry::offset_path`]), and what would have to be known and is not: a position, what
//! a block that may be skipped does, a called program, frames that turn left into right or scale.
//!
//! Where F counts along the contour on arcs ([`ncc_ir::geometry::arc_feed`]), each arc gets the F of the tool centre that takes the
//! same time.

mod contour;
mod written;

use crate::pass::Pass;

use self::contour::{Contour, contour};
use self::written::{Written, cannot, mm, nanos, straight};
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, rebuild};
use crate::target::{Compensating, Target};
use ncc_exec::world::Tables;
use ncc_ir::canon::{AdviceKind, FeedMode, Motion, Plane, Side};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::num::Num;
use ncc_ir::geometry::arc_feed::ArcFeed;
use ncc_ir::geometry::offset_path::{Leg, OffsetPath, Unreachable};
use ncc_ir::lack::{CompensationLack, ExpandedContour};
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{CutterRadius, Data, Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass::named(
    "expand-compensation",
    "writes the tool centre path for cutter radius compensation",
    Some(run),
);

/// Works compensation out.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    let mut reported = false;
    let begins = target.compensating.arc_feed;
    let mut one = Some(begins);
    program.procedures.iter().for_each(|procedure| only_meaning(&procedure.body, &mut one));
    let mut first = true;
    each_body(program, entry, |body, walk| {
        let main = std::mem::take(&mut first);
        let mut pass = Expansion {
            how: &target.compensating,
            decimals: target.decimals,
            tables: Tables { radii: target.compensating.radii.clone(), ..Tables::default() },
            on: None,
            leaving: None,
            no_arc: false,
            reported: std::mem::take(&mut reported),
            one_meaning: one.is_some(),
            // A subprogram has the meaning of its caller.
            arc_feed: one.or(main.then_some(begins)),
            feed_decimals: target.compensating.feed_decimals.max(target.caps.modes.feed_decimals),
            own_feed: None,
        };
        rebuild(body, |stmt, made| {
            walk.enter(stmt.skip);
            if let Err(fault) = pass.statement(stmt, walk, made, diags) {
                diags.push(fault);
                (pass.on, pass.leaving) = (None, None);
            }
        });
        reported = pass.reported;
    });
}

/// The pass in one body.
struct Expansion<'t> {
    how: &'t Compensating,
    decimals: u8,
    tables: Tables,
    on: Option<Contour>,
    /// The plane of a contour that the next move leaves.
    leaving: Option<Plane>,
    /// The next move must be straight.
    no_arc: bool,
    reported: bool,
    /// Whether all arcs of the program have one meaning of F.
    one_meaning: bool,
    /// What F counts on arcs; `None` is not known here.
    arc_feed: Option<ArcFeed>,
    /// Digits of F after the point.
    feed_decimals: u8,
    /// The F active in the output, where it is that of an arc of the tool centre and not the source's.
    own_feed: Option<Num>,
}

/// What F counts on arcs in all of a program, if it is one meaning.
fn only_meaning(body: &[Stmt], one: &mut Option<ArcFeed>) {
    for stmt in body {
        match &stmt.op {
            Op::Advise(advice)
                if advice.kind == AdviceKind::CompensatedFeed
                    && *one != Some(ArcFeed::stated(advice.value)) =>
            {
                *one = None;
            }
            Op::Control(control) => control.bodies().for_each(|body| only_meaning(body, one)),
            _ => {}
        }
    }
}

impl Expansion<'_> {
    fn statement(
        &mut self,
        stmt: Stmt,
        walk: &mut Walk,
        made: &mut Rebuild,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Diagnostic> {
        let span = stmt.span;
        if self.on.is_some() && stmt.skip.is_some() {
            return cannot(ExpandedContour::SkippedBlock, span);
        }
        match &stmt.op {
            Op::Advise(advice) if advice.kind == AdviceKind::CompensatedFeed && !self.one_meaning => {
                self.arc_feed = stmt.skip.is_none().then(|| ArcFeed::stated(advice.value));
            }
            flow!() if !self.one_meaning => self.arc_feed = None,
            Op::SetFeedRate(_) => self.own_feed = None,
            _ => {}
        }
        match &stmt.op {
            Op::StartCutterRadiusCompensation { side, radius } => {
                let contour = self.start(*side, radius, walk, span)?;
                diags.push(Diagnostic::new(
                    Fault::CompensationExpanded { radius: nanos(contour.radius) },
                    span,
                ));
                if !self.how.known && !std::mem::replace(&mut self.reported, true) {
                    diags.push(Diagnostic::new(Fault::AssumedContourPath, span));
                }
                let side = if contour.left { Side::Left } else { Side::Right };
                self.on = Some(contour);
                walk.step(&stmt);
                match self.how.listing {
                    true => made.push(Stmt {
                        op: Op::StartCutterRadiusCompensation { side, radius: radius.clone() },
                        ..stmt
                    }),
                    false => made.leave_out(stmt),
                }
            }
            Op::StopCutterRadiusCompensation => {
                if let Some(contour) = self.on.take() {
                    self.end(contour, walk, made, span)?;
                    walk.step(&stmt);
                    let feed = self.source_feed(walk).map(|op| (true, op));
                    match (self.how.listing, feed) {
                        (true, None) => made.push(stmt),
                        (true, Some(feed)) => {
                            made.replace(stmt, [feed, (true, Op::StopCutterRadiusCompensation)]);
                        }
                        (false, None) => made.leave_out(stmt),
                        (false, Some(feed)) => made.replace(stmt, [feed]),
                    }
                } else {
                    walk.step(&stmt);
                    made.push(stmt);
                }
            }
            Op::ProgramEnd | Op::BeginAgain if self.on.is_some() => {
                if let Some(contour) = self.on.take() {
                    self.end(contour, walk, made, span)?;
                }
                self.leaving = None;
                walk.step(&stmt);
                made.push(stmt);
            }
            Op::SetData(data) => {
                if let Data::Tool { entry, which, added, value, .. } = &**data {
                    if let Some(value) = walk.at.nanos(value) {
                        self.tables.set_radius(*entry, *which, *added, value);
                    } else {
                        self.tables.radii.remove(entry);
                    }
                }
                walk.step(&stmt);
                made.push(stmt);
            }
            _ if self.on.is_some() => return self.along(stmt, walk, made),
            _ => self.beyond(stmt, walk, made)?,
        }
        Ok(())
    }

    /// What is known of the contour at its start.
    fn start(
        &self,
        side: Side,
        radius: &CutterRadius,
        walk: &Walk,
        span: Span,
    ) -> Result<Contour, Diagnostic> {
        let refuse = |fault| Diagnostic::new(fault, span);
        let at = &walk.at;
        if self.on.is_some() {
            return cannot(ExpandedContour::OtherStart, span);
        }
        if at.framed || at.turned || at.tilted {
            return cannot(ExpandedContour::Frame, span);
        }
        let plane = at.modes.plane.ok_or(refuse(Fault::EntryFactNeeded { fact: ModeName::Plane }))?;
        let entry = |n: Option<i64>| n.and_then(|n| u32::try_from(n).ok()).filter(|n| *n > 0);
        let entry = match radius {
            CutterRadius::Diameter(diameter) => {
                let fault = refuse(Fault::EntryFactNeeded { fact: ModeName::Units });
                let radius = mm(at.nanos(diameter).ok_or(fault)?) / 2.0;
                return Ok(contour(plane, side, radius, span));
            }
            CutterRadius::Entry(n) => entry(n.literal().and_then(|n| n.whole_number())),
            CutterRadius::Tool => entry(at.tool),
            CutterRadius::InForce => at.modes.length_offset.filter(|n| *n > 0),
        };
        match entry.and_then(|entry| self.tables.radius(entry)) {
            Some(radius) => Ok(contour(plane, side, mm(radius), span)),
            None => Err(refuse(Fault::RadiusUnknown { entry })),
        }
    }

    /// A statement on the contour.
    fn along(&mut self, stmt: Stmt, walk: &mut Walk, made: &mut Rebuild) -> Result<(), Diagnostic> {
        let span = stmt.span;
        let motion = match &stmt.op {
            Op::StraightTraverse(_) => Motion::Traverse,
            Op::StraightFeed(_) => Motion::Feed,
            Op::ArcFeed(arc) => Motion::Arc(arc.turn),
            Op::Position(_) => match walk.at.modes.motion {
                Some(motion @ (Motion::Traverse | Motion::Feed)) => motion,
                Some(Motion::Arc(_) | Motion::Cycle) | None => return cannot(ExpandedContour::Motion, span),
            },
            op => {
                if !stays(op, walk) {
                    return cannot(ExpandedContour::Function { function: op.name() }, span);
                }
                walk.step(&stmt);
                made.push(stmt);
                return Ok(());
            }
        };
        let Some(contour) = &mut self.on else { return Ok(()) };
        if walk.at.raw || matches!(walk.at.modes.feed_mode, Some(FeedMode::InverseTime)) {
            return cannot(ExpandedContour::FeedByTime, span);
        }
        let rules = self.how.rules;
        let writer = Written { walk, decimals: self.decimals, plane: contour.plane };
        let words = contour.words(&stmt, walk)?;
        let refuse = |fault| Diagnostic::new(fault, span);
        let unreachable = |why: Unreachable| refuse(Fault::ContourUnreachable { why });
        let (from, to) = (
            writer.plane_of(&walk.at.position).map_err(refuse)?,
            writer.plane_of(&walk.at.target(words)).map_err(refuse)?,
        );
        let full = matches!(stmt.op, Op::ArcFeed(_)) && from == to;
        let still = from == to && !full;
        if contour.radius == 0.0 {
            if self.leaving.is_some() {
                return cannot(ExpandedContour::NoRadius, span);
            }
            walk.step(&stmt);
            made.push(stmt);
            return Ok(());
        }
        if still {
            if contour.path.is_none() && rules.left_at_once {
                return Err(unreachable(Unreachable::Entry));
            }
            // Beside the contour, words of the plane would lead back onto it.
            let words = writer.others(words).map_err(refuse)?;
            walk.step(&stmt);
            made.push(Stmt { op: straight(motion, words), ..stmt });
            return Ok(());
        }
        let (from, to) = (from.map(mm), to.map(mm));
        let leg = match &stmt.op {
            Op::ArcFeed(arc) => {
                if contour.path.is_none() {
                    return cannot(ExpandedContour::ArcLeadIn, span);
                }
                let centre = walk.at.centre(arc).ok_or(refuse(Fault::ArcWithoutCentre))?;
                super::expand_turns::leg(arc, centre.map(mm)).map_err(refuse)?
            }
            _ => Leg::Line { rapid: motion == Motion::Traverse },
        };
        let part = match leg {
            Leg::Arc { .. } => {
                let feed =
                    self.arc_feed.ok_or_else(|| refuse(Fault::lacks(CompensationLack::ArcFeedUnknown)))?;
                contour.part_of_feed(feed, leg, [from, to], words, &writer).map_err(refuse)?
            }
            Leg::Line { .. } => None,
        };
        let enters = contour.path.is_none();
        let before = contour.go_on(leg, [from, to], rules, &writer, made).map_err(unreachable)?;
        if enters {
            self.leaving = None;
        }
        let now = contour.path.as_ref().map_or(to, OffsetPath::now);
        let words = writer.spot(now, writer.others(words).map_err(refuse)?);
        let op = match leg {
            Leg::Arc { centre, ccw, turns } => writer.arc(words, centre, ccw, turns),
            Leg::Line { .. } => straight(motion, words),
        };
        let arc_feed = match part {
            Some(part) => Some(self.feed_of_centre(walk, part, span)?),
            None => None,
        };
        let source_feed = (motion != Motion::Traverse && (arc_feed.is_none() || before.is_some()))
            .then(|| self.source_feed(walk))
            .flatten();
        self.put(stmt, op, [source_feed, before], arc_feed, walk, made);
        Ok(())
    }

    /// Puts a move on the contour in the place of its statement, after the source's F and an arc before it, where there
    /// are such.
    fn put(
        &mut self,
        mut stmt: Stmt,
        op: Op,
        [source_feed, before]: [Option<Op>; 2],
        arc_feed: Option<Num>,
        walk: &mut Walk,
        made: &mut Rebuild,
    ) {
        if arc_feed.is_some()
            && before.is_none()
            && let Some(stated) = made.out.pop_if(|last| stmt.joined && matches!(last.op, Op::SetFeedRate(_)))
        {
            // F in the same block is that of the contour.
            (stmt.joined, stmt.number) = (stated.joined, stated.number.or(stmt.number));
        }
        walk.step(&stmt);
        let listing = self.how.listing;
        let mut all: Vec<(bool, Op)> = Vec::new();
        all.extend(source_feed.map(|op| (true, op)));
        all.extend(before.map(|op| (true, op)));
        let joined =
            all.is_empty() || listing || !all.iter().any(|(_, op)| !matches!(op, Op::SetFeedRate(_)));
        let in_force = self.own_feed.is_some() && self.own_feed == arc_feed;
        match arc_feed.filter(|_| !in_force) {
            Some(feed) => all.extend([(joined, Op::SetFeedRate(feed.into())), (true, op)]),
            None => all.push((joined, op)),
        }
        self.own_feed = arc_feed.or(self.own_feed);
        let own = all.len() == 1;
        match own {
            true => made.push(Stmt { op: all.into_iter().next().map_or(Op::Blank, |(_, op)| op), ..stmt }),
            false => made.replace(stmt, all),
        }
        if let Some(contour) = &mut self.on {
            contour.held = made.out.len() - 1;
        }
    }

    /// The source's F, where the output has another one active.
    fn source_feed(&mut self, walk: &Walk) -> Option<Op> {
        let own = self.own_feed.take();
        walk.at.feed.filter(|_| own.is_some()).map(|feed| Op::SetFeedRate(feed.into()))
    }

    /// F of the tool centre: this part of F.
    fn feed_of_centre(&self, walk: &Walk, part: f64, span: Span) -> Result<Num, Diagnostic> {
        let Some(feed) = walk.at.feed else {
            return cannot(ExpandedContour::ArcFeedUnknown, span);
        };
        let number = feed.mantissa as f64 / 10f64.powi(i32::from(feed.scale)) * part;
        let said = Num::from_nanos(nanos(number), self.feed_decimals, feed.unit);
        match said.is_zero() {
            true => cannot(ExpandedContour::ArcFeedDigits, span),
            false => Ok(said),
        }
    }

    /// Ends a contour.
    fn end(
        &mut self,
        contour: Contour,
        walk: &mut Walk,
        made: &mut Rebuild,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let Some(path) = &contour.path else { return Ok(()) };
        self.no_arc = true;
        let end = path.leave().map_err(|why| {
            let mut found = Diagnostic::new(Fault::ContourUnreachable { why }, span);
            found.related.push(contour.start);
            found
        })?;
        let writer = Written { walk, decimals: self.decimals, plane: contour.plane };
        writer.settle(&mut made.out[contour.held], end);
        self.leaving = Some(contour.plane);
        Ok(())
    }

    /// A statement where compensation is off.
    fn beyond(&mut self, mut stmt: Stmt, walk: &mut Walk, made: &mut Rebuild) -> Result<(), Diagnostic> {
        if self.no_arc {
            match &stmt.op {
                Op::ArcFeed(_) | Op::ArcForm(_) => {
                    return cannot(ExpandedContour::ArcLeadOut, stmt.span);
                }
                Op::StraightTraverse(_) | Op::StraightFeed(_) | Op::Position(_) => self.no_arc = false,
                _ => {}
            }
        }
        let Some(plane) = self.leaving else {
            walk.step(&stmt);
            made.push(stmt);
            return Ok(());
        };
        let span = stmt.span;
        let (first, second, _) = plane.axes();
        if stmt.skip.is_some() {
            return cannot(ExpandedContour::SkippedLeadOut, span);
        }
        let known =
            stays(&stmt.op, walk) || matches!(stmt.op, Op::EndCycle | Op::ProgramEnd | Op::BeginAgain);
        match &mut stmt.op {
            Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) if !walk.at.raw => {
                let named = m.to.get(first).is_some() || m.to.get(second).is_some();
                if named || self.how.rules.left_at_once {
                    let writer = Written { walk, decimals: self.decimals, plane };
                    m.to = writer.absolute_point(&m.to).map_err(|fault| Diagnostic::new(fault, span))?;
                    self.leaving = None;
                }
            }
            _ if known => {}
            op => return cannot(ExpandedContour::BeforeLeadOut { function: op.name() }, span),
        }
        walk.step(&stmt);
        made.push(stmt);
        Ok(())
    }
}

/// Whether a statement may stand between the moves of a contour, and stays what it is.
fn stays(op: &Op, walk: &Walk) -> bool {
    match op {
        Op::Comment(_)
        | Op::NoEffect(_)
        | Op::Blank
        | Op::Message(_)
        | Op::SetFeedRate(_)
        | Op::SetSpindleSpeed(_)
        | Op::SetSpindleMode(_)
        | Op::LimitSpindleSpeed(_)
        | Op::StartSpindleClockwise
        | Op::StartSpindleCounterclockwise
        | Op::StopSpindleTurning
        | Op::MachineFunction(_)
        | Op::FloodOn
        | Op::MistOn
        | Op::CoolantOff
        | Op::Dwell(_)
        | Op::ProgramStop
        | Op::OptionalProgramStop
        | Op::SelectTool(_)
        | Op::SelectToolByName(_)
        | Op::SetMotionControlMode(_)
        | Op::Advise(_)
        | Op::SetDistanceMode(_)
        | Op::SetReturnLevel(_) => true,
        Op::SetFeedMode(mode) => *mode != FeedMode::InverseTime,
        Op::SelectPlane(plane) => walk.at.modes.plane == Some(*plane),
        Op::UseLengthUnits(units) => walk.at.modes.units == Some(*units),
        Op::SetOriginOffsets(offset) => walk.at.modes.work_offset == Some(*offset),
        _ => false,
    }
}
