//! Cutter radius compensation, symbolically: the contour is executed as it is programmed, and side,
//! radius (by its place in the tables) and plane are an attribute of its moves.
//!
//! What controls refuse under compensation, or do each in a way of their own, is refused here by name:
//! an arc as the first move or as the one that leaves, cycles, another plane, another frame, another
//! tool or length, moves to reference points. Not here: the tool centre path.

use crate::{Event, Exec, Kind, Length};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AdviceKind, Axis, Plane, Side};
use ncc_ir::compensated::kind::CompensationRefusal;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::geometry::arc_feed::{self, ArcFeed};
use ncc_ir::lack::CompensationLack;
use ncc_ir::program::kinds::{conduct, drilling, flow, miscellaneous, variables};
use ncc_ir::program::{CutterRadius, Data, Op, Point, Stmt, ToolValue};
use ncc_ir::source::Span;
use ncc_ir::syntax::Ranged;
use ncc_ir::unexecuted::{CompensationUnexecuted, CycleUnexecuted};

/// Compensation of a move. Without one, all the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Compensation {
    /// Side of the contour as the machine sees it; `None` is off.
    pub side: Option<Side>,
    /// Its plane.
    pub plane: Plane,
    /// Whether two blocks or more without a move in the plane, or one that goes nowhere, stood before
    /// this move: some controls then do not look as far as this move for the corner before it.
    pub gap: bool,
    /// Whether it was switched on again, while it was on, for this move: the contour before it ends as the control
    /// ends one, and this move goes onto it again.
    pub again: bool,
    /// Of an arc: whether F counts along the contour, and not at the tool centre.
    pub on_contour: bool,
    /// The place of the radius: an entry of the table, or with `EDGE` an edge that is none; with `STATED`
    /// the diameter that the program states, in hundredths of a micrometre.
    pub radius: u32,
}

/// Where the radius of a compensated move is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompensationRadius {
    /// In an entry of the table.
    Entry(u32),
    /// The program states the diameter, mm in nanos.
    Diameter(Nanos),
    /// In an edge of the tool that is no entry.
    Edge,
}

impl Compensation {
    /// Where its radius is.
    pub fn radius_place(&self) -> CompensationRadius {
        match self.radius & (EDGE | STATED) {
            0 => CompensationRadius::Entry(self.radius),
            STATED => CompensationRadius::Diameter(Nanos::from(self.radius & !STATED) * STEP),
            _ => CompensationRadius::Edge,
        }
    }
}

impl Compensation {
    /// The entry of the table that has the radius, if it is one.
    pub(crate) fn entry(&self) -> Option<u32> {
        (self.radius & (EDGE | STATED) == 0).then_some(self.radius)
    }
}

impl Default for Compensation {
    fn default() -> Compensation {
        Compensation { side: None, plane: Plane::Xy, gap: false, again: false, on_contour: false, radius: 0 }
    }
}

/// Marks the place of a radius that is no entry.
const EDGE: u32 = 1 << 31;

/// Marks a diameter.
const STATED: u32 = 1 << 30;

/// What a diameter is counted in: hundredths of a micrometre.
const STEP: Nanos = ONE / 100_000;

/// What is remembered of the way while compensation is on, or has not been left yet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Contour {
    /// Whether statements are looked at: it is on, or the move that leaves it has not come yet.
    pub(crate) watched: bool,
    /// Whether the two controls may differ in what they do where they are not told.
    pub(crate) elsewhere: bool,
    /// Whether the text has no blocks, only lines: then none is counted.
    lines: bool,
    /// Whether a move in the plane has gone onto the contour.
    entered: bool,
    /// Blocks without a move in the plane since the last one, two at most.
    still: u8,
    /// The last of them that has words and goes nowhere.
    nowhere: Option<Span>,
    /// Whether it was switched on again, and no move in the plane has come since.
    again: bool,
    /// What the block at hand has done so far.
    block: Block,
    /// Its plane.
    plane: Option<Plane>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Block {
    #[default]
    Empty,
    Still,
    Moved,
}

impl Exec {
    /// The other control is of another kind: what each does in a way of its own under compensation is
    /// refused.
    pub fn between_controls(&mut self) {
        self.contour.elsewhere = true;
    }

    /// One of the texts compared has no blocks: what stands between moves is not counted.
    pub fn without_blocks(&mut self) {
        self.contour.lines = true;
    }

    /// Switches compensation on.
    #[cold]
    pub(crate) fn start_compensation(
        &mut self,
        side: Side,
        radius: &CutterRadius,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let on = self.state.compensation;
        if on.side.is_some() && (!self.world.compensation_again || self.centre_path.is_some()) {
            return self.not_executed(CompensationUnexecuted::OnTwice, span);
        }
        if self.cycle.is_some() {
            return self.not_executed(CycleUnexecuted::CompensationInCycle, span);
        }
        let plane = self.modes.plane;
        let place = self.place_of_radius(radius, span)?;
        let mut side = side;
        if let CutterRadius::Diameter(diameter) = radius
            && self.value(diameter, span)? < 0
        {
            side = side.other();
        }
        let side = match self.mirrors(plane) {
            Some(false) => side,
            Some(true) => side.other(),
            None => return self.not_executed(CompensationUnexecuted::TiltedPlane, span),
        };
        let new = Compensation { side: Some(side), plane, radius: place, ..Compensation::default() };
        let again = on.side.is_some();
        if again && self.contour.elsewhere {
            // A Sinumerik takes the block for the way onto a contour, a Fanuc for a part of it.
            return self.fault(Fault::lacks(CompensationLack::OnAgain), span);
        }
        if again && (on.side, on.plane, on.radius) != (new.side, new.plane, new.radius) {
            return self.not_executed(CompensationUnexecuted::OtherSide, span);
        }
        self.state.compensation = new;
        let Contour { elsewhere, lines, .. } = self.contour;
        self.contour =
            Contour { watched: true, elsewhere, lines, again, plane: Some(plane), ..Contour::default() };
        self.start_path(radius, span)
    }

    /// Switches it off.
    pub(crate) fn stop_compensation(&mut self) {
        let was_on = self.state.compensation.side.is_some();
        self.state.compensation = crate::Compensation::default();
        if was_on {
            // The next move in the plane leaves the contour.
            self.contour.watched = self.contour.entered;
        }
    }

    /// Where the tables have a radius.
    fn place_of_radius(&self, radius: &CutterRadius, span: Span) -> Result<u32, Diagnostic> {
        let none = || self.fault(Fault::not_executed(CompensationUnexecuted::NoEntry), span);
        let entry = match radius {
            CutterRadius::Entry(entry) => match u32::try_from(self.whole_number(entry, span)?) {
                Ok(entry) => entry,
                Err(_) => return self.fault(Fault::OutOfRange { word: Ranged::Unnamed }, span),
            },
            CutterRadius::Tool => u32::try_from(self.state.tool).unwrap_or(0),
            CutterRadius::InForce => match self.length_in_force() {
                Length::Entry(entry) => entry,
                // A tool with a name whose number on the other control is known.
                Length::Edge(tool, edge) if self.world.tables.named_entries.contains_key(&(tool, edge)) => {
                    return Ok(self.world.tables.named_entries[&(tool, edge)] & !(EDGE | STATED));
                }
                Length::Edge(tool, edge) => {
                    // Any two tools of a program are distinguished by this.
                    let tool = u32::try_from(tool).map_or(tool, |n| i64::from(self.world.tool_number(n)));
                    let tool = (tool as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
                    return Ok(EDGE | (tool as u32) << 4 | edge);
                }
                Length::Value(_) => 0,
            },
            CutterRadius::Diameter(diameter) => {
                let steps = (self.value(diameter, span)?.abs() + STEP / 2) / STEP;
                return match u32::try_from(steps) {
                    Ok(steps) if steps < STATED => Ok(STATED | steps),
                    Ok(_) | Err(_) => self.fault(Fault::OutOfRange { word: "D".into() }, span),
                };
            }
        };
        if entry == 0 {
            return none();
        }
        Ok(self.world.entry_number(entry) & !(EDGE | STATED))
    }

    /// Whether the frames turn left and right of a plane's ways round; `None` if they tilt the plane.
    fn mirrors(&self, plane: Plane) -> Option<bool> {
        if self.chain.is_none() {
            return Some(false);
        }
        let (first, second, normal) = plane.axes();
        let (first, second, normal) = (first as usize, second as usize, normal as usize);
        let zero = self.place(&[0; 6]);
        let along = |axis: usize| {
            let mut point = [0; 6];
            point[axis] = 1000 * ONE;
            let placed = self.place(&point);
            [first, second, normal].map(|axis| placed[axis].wrapping_sub(zero[axis]))
        };
        let (a, b) = (along(first), along(second));
        let flat = a[2].abs() < 1000 && b[2].abs() < 1000;
        let wide = |x: Nanos| i128::from(x);
        flat.then(|| wide(a[0]) * wide(b[1]) - wide(a[1]) * wide(b[0]) < 0)
    }

    /// Executes a statement while compensation is on, or has not been left yet.
    #[cold]
    pub(crate) fn step_on_contour(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let span = stmt.span;
        let on = self.state.compensation.side.is_some();
        if on && let Some(kind) = self.world.refused_compensated.kind(&stmt.op) {
            return self.fault(Fault::RefusedCompensated { what: CompensationRefusal::Kind(kind) }, span);
        }
        if on && let Some(what) = self.refused_on_contour(&stmt.op, span)? {
            return self.not_executed(what, span);
        }
        if !stmt.joined {
            if self.contour.block == Block::Still {
                self.contour.still = (self.contour.still + 1).min(2);
            }
            self.contour.block = Block::Empty;
        }
        let Some(plane) = self.contour.plane else { return self.step_plainly(stmt, out) };
        let (first, second, _) = plane.axes();
        let (before, events) = (self.position, out.len());
        let arc = is_arc(&stmt.op);
        if arc && !(on && self.contour.entered) {
            return self.not_executed(
                match on {
                    true => CompensationUnexecuted::ArcLeadIn,
                    false => CompensationUnexecuted::ArcLeadOut,
                },
                span,
            );
        }
        let computed = self.centre_path.is_some();
        match computed {
            true => self.step_beside(stmt, on, out)?,
            false => {
                self.step_plainly(stmt, out)?;
                if let Some(events) = out.get_mut(events..) {
                    self.feed_of_arcs(events);
                }
            }
        }
        let goes = |axis: Axis| {
            // A word that leads off a computed contour leads to where the program is already.
            let named = || to(&stmt.op).is_some_and(|to| to.axes[axis as usize].is_some());
            self.position[axis as usize] != before[axis as usize] || computed && !on && named()
        };
        let moved = arc || goes(first) || goes(second);
        if moved {
            if !on {
                self.contour.watched = false;
            } else if self.contour.entered && self.contour.still > 1 && !computed {
                if self.contour.elsewhere {
                    // The corner before them is each control's own.
                    let (lack, at) = match self.contour.nowhere {
                        Some(at) => (CompensationLack::WithoutMotion, at),
                        None => (CompensationLack::TwoWithoutMotion, span),
                    };
                    return self.fault(Fault::lacks(lack), at);
                }
                if let Some(event) = out.get_mut(events) {
                    event.state.compensation.gap = true;
                }
            }
            if on
                && std::mem::take(&mut self.contour.again)
                && let Some(event) = out.get_mut(events)
            {
                event.state.compensation.again = true;
            }
            self.contour.entered = true;
            (self.contour.still, self.contour.block) = (0, Block::Moved);
            self.contour.nowhere = None;
        } else if self.contour.block == Block::Empty && counts(&stmt.op) && !self.contour.lines {
            self.contour.block = Block::Still;
        }
        let words = matches!(stmt.op, Op::Polar(_)) || to(&stmt.op).is_some_and(|to| !to.is_empty());
        if !moved && before == self.position && words && !self.contour.lines {
            if !self.world.looks_over_blocks {
                self.contour.still = 2;
            }
            self.contour.nowhere = Some(span);
        }
        Ok(())
    }

    /// Notes of events under compensation what F counts on their arcs.
    pub(crate) fn feed_of_arcs(&mut self, events: &mut [Event]) {
        for event in events {
            let (Kind::Arc { turn, .. }, Some(side)) = (&event.kind, self.state.compensation.side) else {
                event.state.compensation.on_contour = false;
                continue;
            };
            let feed = match (self.state.advice & arc_feed::ADVICE) >> AdviceKind::CompensatedFeed.bits() {
                0 => {
                    self.asked |= Behaviour::FeedOnArcs.bit();
                    ArcFeed::from_behaviours(&self.world.behaviours)
                }
                value => ArcFeed::stated(value as u8 - 1),
            };
            let on_contour = feed.on_contour(side, *turn);
            event.state.compensation.on_contour = on_contour;
            let inner = usize::from(arc_feed::is_inner(side, *turn));
            self.arc_feeds[inner][usize::from(on_contour)].get_or_insert(event.span);
        }
    }

    /// The first arc under compensation on which F counts otherwise than on the same kind of arc (inner, outer) of another
    /// run; whether it counts along the contour there, and whether the arc is an inner one.
    pub fn arc_fed_otherwise(&self, other: &Exec) -> Option<(Span, [bool; 2])> {
        let of = |inner: usize, on_contour: usize| {
            let [own, others] = [self, other].map(|exec| exec.arc_feeds[inner]);
            let otherwise = others[on_contour].is_none() && others[1 - on_contour].is_some();
            own[on_contour].filter(|_| otherwise).map(|at| (at, [on_contour == 1, inner == 1]))
        };
        [of(0, 0), of(0, 1), of(1, 0), of(1, 1)].into_iter().flatten().min_by_key(|(at, _)| at.start)
    }

    /// Whether these statements reach an arc under compensation on which no code of the program says what F counts.
    pub(crate) fn feeds_arcs_in(&self, stmts: &[Stmt]) -> bool {
        let starts = |stmt: &Stmt| matches!(stmt.op, Op::StartCutterRadiusCompensation { .. });
        self.state.advice & arc_feed::ADVICE == 0
            && (self.state.compensation.side.is_some() || stmts.iter().any(starts))
            && stmts.iter().any(|stmt| is_arc(&stmt.op) || matches!(stmt.op, Op::Corner { .. }))
    }

    /// What no move under compensation can be, or each control does in its own way.
    fn refused_on_contour(&self, op: &Op, span: Span) -> Result<Option<CompensationUnexecuted>, Diagnostic> {
        let plane = self.contour.plane;
        let length = self.waiting.unwrap_or(self.modes.length);
        Ok(match op {
            Op::Polar(polar) => return self.refused_on_contour(&polar.op, span),
            drilling!() => Some(CompensationUnexecuted::Cycle),
            Op::SelectPlane(other) if Some(*other) != plane => Some(CompensationUnexecuted::Plane),
            Op::ArcFeed(arc) if Some(self.plane_of(arc.plane)) != plane => {
                Some(CompensationUnexecuted::ArcOtherPlane)
            }
            Op::ArcForm(arc) if Some(self.plane_of(arc.plane)) != plane => {
                Some(CompensationUnexecuted::ArcOtherPlane)
            }
            Op::UseLengthUnits(units) if (*units == ncc_ir::canon::Units::Inch) != self.modes.inch => {
                Some(CompensationUnexecuted::Units)
            }
            Op::SetOriginOffsets(offset) if *offset != self.modes.work_offset => {
                Some(CompensationUnexecuted::WorkOffset)
            }
            Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_) => Some(CompensationUnexecuted::Frame),
            Op::ClearFrame(_) | Op::UseOriginShift(_)
                if self.chain.is_some()
                    || self.slots.is_some()
                    || self.modes.shifted
                    || self.state.tilted =>
            {
                Some(CompensationUnexecuted::Frame)
            }
            Op::UseToolCentrePoint(on) if *on != self.state.tip => Some(CompensationUnexecuted::TipControl),
            Op::OrientToolAxis(_) => Some(CompensationUnexecuted::AxisTurned),
            Op::UseMachineCoordinates { .. } | Op::GoToReference(_) => {
                Some(CompensationUnexecuted::MachinePoint)
            }
            Op::Probe(_) => Some(CompensationUnexecuted::Probing),
            Op::Detour(_) => Some(CompensationUnexecuted::Detour),
            Op::SynchronisedFeed(_) => Some(CompensationUnexecuted::Thread),
            Op::ChangeTool => Some(CompensationUnexecuted::ToolChange),
            Op::UseToolLengthOffset(entry) => {
                let entry = u32::try_from(self.whole_number(entry, span)?).unwrap_or(u32::MAX);
                (length != Length::Entry(entry)).then_some(CompensationUnexecuted::Length)
            }
            Op::UseToolLength(_) => Some(CompensationUnexecuted::Length),
            Op::UseToolEdge { edge, .. } => {
                let edge = u32::try_from(self.whole_number(edge, span)?).unwrap_or(u32::MAX);
                (length != self.edge(edge)).then_some(CompensationUnexecuted::Edge)
            }
            Op::SetData(data) => match **data {
                Data::Offset { offset, .. } if offset == self.modes.work_offset => {
                    Some(CompensationUnexecuted::WorkOffset)
                }
                Data::Tool { which: ToolValue::Radius | ToolValue::RadiusWear, .. } => {
                    Some(CompensationUnexecuted::Radius)
                }
                Data::Position(_) => Some(CompensationUnexecuted::PositionStored),
                Data::ToolInSpindle(_) => Some(CompensationUnexecuted::Tool),
                Data::Offset { .. } | Data::Tool { .. } => None,
                Data::Measured { .. } => Some(CompensationUnexecuted::ToolMeasured),
            },
            miscellaneous!()
            | conduct!()
            | Op::SelectPlane(_)
            | Op::ArcFeed(_)
            | Op::ArcForm(_)
            | Op::UseLengthUnits(_)
            | Op::SetOriginOffsets(_)
            | Op::ClearFrame(_)
            | Op::UseOriginShift(_)
            | Op::UseToolCentrePoint(_)
            | Op::SetDistanceMode(_)
            | Op::SetFeedMode(_)
            | Op::SetReturnLevel(_)
            | Op::SetFeedRate(_)
            | Op::SelectTool(_)
            | Op::SelectToolByName(_)
            | Op::StraightTraverse(_)
            | Op::StraightFeed(_)
            | Op::Position(_)
            | Op::SetPole(_)
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | flow!() => None,
        })
    }
}

/// Whether it is an arc, by whatever words.
fn is_arc(op: &Op) -> bool {
    match op {
        Op::ArcFeed(_) | Op::ArcForm(_) => true,
        Op::Polar(polar) => is_arc(&polar.op),
        _ => false,
    }
}

/// Whether a block of such statements alone is one that a control sees between two moves. What only
/// says how others are meant is not counted: writers put it into the block of what it belongs to.
fn counts(op: &Op) -> bool {
    let acts = matches!(
        op,
        Op::Dwell(_)
            | Op::StartSpindleClockwise
            | Op::StartSpindleCounterclockwise
            | Op::StopSpindleTurning
            | Op::OrientSpindle(_)
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::MachineFunction(_)
            | Op::ProgramStop
            | Op::OptionalProgramStop
    );
    acts || to(op).is_some()
}

/// The axis words of a move.
pub(crate) fn to(op: &Op) -> Option<&Point> {
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) => Some(&m.to),
        Op::Polar(polar) => to(&polar.op),
        _ => None,
    }
}
