//! Execution of canned cycles and patterns.
//!
//! The moves are defined in `passes::expand_cycles` as statements and here as events; a law in the
//! tests holds the two together.

pub(crate) mod repeated;
pub(crate) mod same;
pub(crate) mod strokes;

use crate::{Attribute, Event, Exec, Kind, Z};
use ncc_ir::canon::{AXES, Distance, Motion, Plane, ReturnLevel, Spindle, Turn};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry::hole_positions::{Here, HolePositions};
use ncc_ir::program::cycle::{Approach, Clearance, Cycle, CycleKind, Leg, Pattern, Shift, next_peck};
use ncc_ir::program::{Coord, Point};
use ncc_ir::source::Span;
use ncc_ir::syntax::Ranged;
use ncc_ir::unexecuted::CycleUnexecuted;
use ncc_ir::unsupported::CycleUnsupported;

/// Most pecks of one hole; more is a slip of the pen.
const MAX_PECKS: i64 = 100_000;

/// An active cycle, in program coordinates.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ActiveCycle {
    plane: Plane,
    initial: Nanos,
    /// The work offset in which the initial level was found.
    initial_in: u16,
    /// The length by which it was found.
    initial_length: Nanos,
    /// Whether the retract plane is measured from it.
    from_level: bool,
    retract: Nanos,
    depth: Nanos,
    return_level: Option<ReturnLevel>,
    return_plane: Option<Nanos>,
    approach: Approach,
    /// Feed that the cycle's own block says.
    feed: Option<Nanos>,
    way: Way,
}

impl ActiveCycle {
    /// Its plane, the retract plane and the bottom.
    pub(crate) fn levels(&self) -> (Plane, Nanos, Nanos) {
        (self.plane, self.retract, self.depth)
    }
}

/// How the hole is made.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Drill {
        dwell: Option<Nanos>,
    },
    Peck {
        strokes: Strokes,
        /// How far above the last depth the rapid back ends; without, each peck goes out to where the tool is left, and
        /// down at feed.
        clearance: Option<Nanos>,
        settle: Option<Nanos>,
    },
    Break {
        strokes: Strokes,
        lift: Nanos,
        at_feed: bool,
    },
    Bore {
        dwell: Option<Nanos>,
        feed_out: Option<Nanos>,
        to_level: bool,
    },
    Tap {
        turn: Turn,
        pitch: Option<Nanos>,
        chuck: bool,
        dwell: [Option<Nanos>; 3],
        after: Spindle,
        to_level: bool,
    },
    Fine {
        turn: Option<Turn>,
        dwell: Option<Nanos>,
        angle: Option<Nanos>,
        shift: [Nanos; 3],
        after: Option<Spindle>,
    },
    Stop {
        turn: Option<Turn>,
        dwell: Option<Nanos>,
        stop: bool,
        after: Option<Spindle>,
    },
}

/// Pecks of a hole.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Strokes {
    /// Depth of the first below the retract plane.
    first: Nanos,
    /// Depth of each further one, the least where they decrease.
    peck: Nanos,
    /// How much less each further one is than the one before it, where they decrease.
    less: Option<Nanos>,
    /// Seconds after every one but the last.
    pause: Option<Nanos>,
    /// Seconds at the bottom.
    dwell: Option<Nanos>,
}

/// What execution knows of where holes are.
struct Now<'e> {
    exec: &'e Exec,
    axes: [usize; 2],
    span: Span,
}

impl Here for Now<'_> {
    type Unknown = Diagnostic;

    fn at(&self, side: usize) -> Result<Nanos, Diagnostic> {
        Ok(self.exec.position[self.axes[side]])
    }

    fn word(&self, word: &Coord, side: usize) -> Result<Nanos, Diagnostic> {
        let axis = self.axes[side];
        if self.exec.carries(axis) && word.distance.or(self.exec.modes.distance) == Distance::Incremental {
            self.exec.not_executed(CycleUnexecuted::PatternInFrameChange, self.span)?;
        }
        self.exec.target(word, self.exec.position[axis], self.span)
    }

    fn after(&self, word: &Coord, _: usize, last: Nanos) -> Result<Nanos, Diagnostic> {
        self.exec.target(word, last, self.span)
    }

    fn value(&self, value: &Expr) -> Result<Nanos, Diagnostic> {
        self.exec.value(value, self.span)
    }

    fn out_of_range(&self) -> Diagnostic {
        Diagnostic::new(Fault::OutOfRange { word: Ranged::Unnamed }, self.span)
    }
}

impl Exec {
    pub(crate) fn start_cycle(&mut self, cycle: &Cycle, span: Span) -> Result<(), Diagnostic> {
        let plane = self.plane_of(cycle.plane);
        let normal = plane.axes().2 as usize;
        if self.cycle.as_ref().is_some_and(|cycle| cycle.plane != plane) {
            // 16-C: the drilling axis is changed when no cycle is active.
            return self.not_executed(CycleUnexecuted::OtherAxis, span);
        }
        let initial = self.cycle.as_ref().map_or(self.position[normal], |c| c.initial);
        let initial_in = self.cycle.as_ref().map_or(self.modes.work_offset, |c| c.initial_in);
        let length = |length| if normal == self.along { self.length_of(length) } else { 0 };
        let initial_length = self.cycle.as_ref().map_or(length(self.modes.length), |c| c.initial_length);
        let from_level = cycle.retract.distance.or(self.modes.distance) == Distance::Incremental;
        let retract = self.target(&cycle.retract, initial, span)?;
        let depth = self.target(&cycle.depth, retract, span)?;
        if depth > retract {
            return self.fault(Fault::CycleUpsideDown, span);
        }
        let dwell = |d: &Option<Expr>| d.as_ref().map(|d| self.value(d, span)).transpose();
        let way = match &cycle.kind {
            CycleKind::Drill => Way::Drill { dwell: None },
            CycleKind::DrillDwell { dwell } => Way::Drill { dwell: Some(self.value(dwell, span)?) },
            CycleKind::DrillPeck { peck, first, less, clearance, pause, settle, dwell: d } => {
                let pecks = [peck, first.as_ref().unwrap_or(peck)];
                let strokes = self.strokes(pecks, less.as_ref(), retract - depth, span)?;
                let strokes = Strokes { pause: dwell(pause)?, dwell: dwell(d)?, ..strokes };
                let clearance = match clearance {
                    Clearance::Stated(value) => Some(self.value(value, span)?),
                    Clearance::Parameter => Some(self.world.peck_clearance),
                    Clearance::FromReturn => None,
                };
                Way::Peck { strokes, clearance, settle: dwell(settle)? }
            }
            CycleKind::DrillBreak { peck, first, less, lift, lift_at_feed, pause, dwell: d } => {
                let pecks = [peck, first.as_ref().unwrap_or(peck)];
                let strokes = self.strokes(pecks, less.as_ref(), retract - depth, span)?;
                let strokes = Strokes { pause: dwell(pause)?, dwell: dwell(d)?, ..strokes };
                let lift = match lift {
                    Clearance::Stated(value) => self.value(value, span)?,
                    // No reader makes one.
                    Clearance::Parameter | Clearance::FromReturn => self.world.break_lift,
                };
                Way::Break { strokes, lift, at_feed: *lift_at_feed }
            }
            CycleKind::Bore { dwell: d, feed_out, to_level } => Way::Bore {
                to_level: *to_level,
                dwell: dwell(d)?,
                feed_out: feed_out.as_ref().map(|f| self.value(f, span)).transpose()?,
            },
            CycleKind::Tap(tap) => Way::Tap {
                turn: tap.turn,
                pitch: self.stated_pitch(&tap.pitch, span)?,
                chuck: tap.chuck,
                dwell: [dwell(&tap.dwell)?, dwell(&tap.back)?, dwell(&tap.settle)?],
                after: tap.after,
                to_level: tap.to_level,
            },
            CycleKind::FineBore(bore) => Way::Fine {
                turn: bore.turn,
                dwell: dwell(&bore.dwell)?,
                angle: dwell(&bore.angle)?,
                shift: self.off_the_wall(&bore.shift, plane, span)?,
                after: bore.after,
            },
            CycleKind::BoreStop(bore) => {
                Way::Stop { turn: bore.turn, dwell: dwell(&bore.dwell)?, stop: bore.stop, after: bore.after }
            }
        };
        let return_plane = match &cycle.return_plane {
            Some(word) => Some(self.target(word, retract, span)?),
            None => None,
        };
        let feed = cycle.feed.as_ref().map(|f| self.value(f, span)).transpose()?;
        if let Some(feed) = feed {
            (self.feed, self.feed_inch) = (feed, Some(self.modes.inch));
        }
        if normal == Z {
            self.counts_z(true);
        }
        self.modes.motion = Motion::Cycle;
        self.cycle = Some(ActiveCycle {
            plane,
            initial,
            initial_in,
            initial_length,
            from_level,
            retract,
            depth,
            return_level: cycle.return_level.known(),
            return_plane,
            approach: cycle.approach,
            feed,
            way,
        });
        Ok(())
    }

    /// How far fine boring shifts the tool along X, Y and Z.
    fn off_the_wall(&self, shift: &Shift, plane: Plane, span: Span) -> Result<[Nanos; 3], Diagnostic> {
        let mut by = [0; 3];
        match shift {
            Shift::Stated(words) => {
                for (by, word) in by.iter_mut().zip(words) {
                    *by = word.as_ref().map_or(Ok(0), |word| self.value(word, span))?;
                }
            }
            Shift::Parameter(amount) => {
                let amount = self.value(amount, span)?;
                let direction = self.world.bore_shift;
                let (first, second, _) = plane.axes();
                let along = if direction.second { second } else { first };
                by[along as usize] = if direction.minus { -amount } else { amount };
            }
        }
        Ok(by)
    }

    fn strokes(
        &self,
        words: [&Expr; 2],
        less: Option<&Expr>,
        way: Nanos,
        span: Span,
    ) -> Result<Strokes, Diagnostic> {
        let (peck, first) = (self.value(words[0], span)?, self.value(words[1], span)?);
        let less = less.map(|less| self.value(less, span)).transpose()?;
        let grows = less.is_some_and(|less| less < 0 || first < peck);
        if peck <= 0 || first <= 0 || grows || way / peck > MAX_PECKS {
            return self.fault(Fault::OutOfRange { word: Ranged::PeckDepth }, span);
        }
        Ok(Strokes { first, peck, less, pause: None, dwell: None })
    }

    pub(crate) fn hole(&mut self, to: &Point, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let Some(cycle) = self.cycle.clone() else {
            return self.fault(Fault::NoCycle, span);
        };
        // What it says of the hole is the reader's to find out; where that could not know of the cycle,
        // nobody does.
        if to.axes[cycle.plane.axes().2 as usize].is_some() {
            let letter = char::from(cycle.plane.axes().2.letter()).to_string();
            return self.fault(Fault::not_supported(letter, CycleUnsupported::HoleAlongAxis), span);
        }
        let from = if self.carried.is_some() { self.counted_from(to, span)? } else { self.position };
        let mut next = self.position;
        self.put(&to.axes, &mut next, &from, span)?;
        self.make_hole(&cycle, next, to.axes[self.along].is_some(), span, out)
    }

    pub(crate) fn pattern(
        &mut self,
        pattern: &Pattern,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let Some(cycle) = self.cycle.clone() else {
            return self.fault(Fault::NoCycle, span);
        };
        let (first, second, _) = cycle.plane.axes();
        let (f, s) = (first as usize, second as usize);
        let places =
            HolePositions::from_pattern(pattern, cycle.plane, &Now { exec: self, axes: [f, s], span })?;
        for k in 0..places.count() {
            self.hole_at(&cycle, f, s, places.get(k), span, out)?;
        }
        Ok(())
    }

    fn hole_at(
        &mut self,
        cycle: &ActiveCycle,
        first: usize,
        second: usize,
        at: [Nanos; 2],
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let mut next = self.position;
        next[first] = at[0];
        next[second] = at[1];
        self.make_hole(cycle, next, first == self.along || second == self.along, span, out)
    }

    /// The spindle turns as the control asks it for this cycle.
    fn spindle_turns_for(&self, cycle: &ActiveCycle, span: Span) -> Result<(), Diagnostic> {
        if !self.world.cycles_need_spindle {
            return Ok(());
        }
        let turned = self.state.spindle;
        let (turn, turns) = match cycle.way {
            Way::Stop { turn: None, .. } => (None, turned != Spindle::Stopped),
            Way::Tap { turn, .. } => (Some(turn), turned == turn.spindle()),
            _ => return Ok(()),
        };
        if turns { Ok(()) } else { self.fault(Fault::SpindleForCycle { turn, by_target: false }, span) }
    }

    /// One hole; `next` says where, the drilling axis of it is not used. `z` says whether Z is
    /// commanded in the plane, which takes a waiting length up.
    fn make_hole(
        &mut self,
        cycle: &ActiveCycle,
        next: [Nanos; AXES],
        z: bool,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let normal = cycle.plane.axes().2 as usize;
        self.heading = crate::Heading::None;
        let turned = self.state.spindle;
        self.spindle_turns_for(cycle, span)?;
        if matches!(cycle.way, Way::Tap { chuck: false, .. }) {
            self.turn_spindle(Spindle::Stopped, span, out)?;
        }
        let level = self.return_to(cycle);
        self.level_is_known(cycle, level, span)?;
        let out_to = cycle.return_plane.unwrap_or(level);
        let leg = cycle.approach.leg(self.position[normal], cycle.initial, cycle.retract, out_to);
        let by_height = matches!(cycle.approach, Approach::RaiseFirst | Approach::ClearFirst);
        if by_height && normal == self.along && self.waiting.is_some() {
            // Which way comes first depends on where the tool is by the length that takes effect on it.
            return self.fault(Fault::not_executed(CycleUnexecuted::LengthAtFirstHole), span);
        }
        if leg == Leg::Level {
            self.go_to_level(normal, cycle.retract, false, span, out)?;
        }
        let level = if leg == Leg::Slant { out_to } else { self.position[normal] };
        self.position = next;
        self.position[normal] = level;
        if z && normal != self.along || leg == Leg::Slant && normal == self.along {
            self.take_up_length();
        }
        self.at_place &= normal != self.along;
        self.emit_move(false, span, out)?;
        self.go_to_level(normal, cycle.retract, false, span, out)?;
        self.tell(Attribute::Hole, span, out)?;
        if let Some(feed) = cycle.feed {
            self.tell(Attribute::FeedRate(feed), span, out)?;
        }
        self.cut_hole(cycle, out_to, span, out)?;
        self.go_to_level(normal, out_to, false, span, out)?;
        self.after_hole(cycle, turned, span, out)
    }

    /// The level to return to, where the cycle states no plane.
    fn return_to(&self, cycle: &ActiveCycle) -> Nanos {
        match cycle.return_level.unwrap_or(self.modes.return_level) {
            ReturnLevel::Retract => cycle.retract,
            ReturnLevel::Initial => cycle.approach.initial(cycle.initial, cycle.retract),
        }
    }

    /// Refuses a hole of which the level to return to is not known: that of another work offset or length.
    fn level_is_known(&self, cycle: &ActiveCycle, level: Nanos, span: Span) -> Result<(), Diagnostic> {
        let normal = cycle.plane.axes().2 as usize;
        if cycle.return_plane.is_none()
            && level != cycle.retract
            && cycle.initial_in != self.modes.work_offset
        {
            // Whether it is a level of the work or of the machine, no source tells.
            return self.fault(Fault::not_executed(CycleUnexecuted::LevelOfOtherOffset), span);
        }
        let to_level = cycle.return_plane.is_none() && level != cycle.retract;
        if (to_level || cycle.from_level) && normal == self.along {
            let length = self.length_of(self.waiting.unwrap_or(self.modes.length));
            if length != cycle.initial_length {
                // Whether it is a level of the work or of the tool's end, no source tells.
                return self.not_executed(CycleUnexecuted::LevelOfOtherLength, span);
            }
        }
        Ok(())
    }

    /// From the retract plane to the bottom, and as far back as the cycle itself takes the tool; `out_to` is the level
    /// to return to.
    fn cut_hole(
        &mut self,
        cycle: &ActiveCycle,
        out_to: Nanos,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let normal = cycle.plane.axes().2 as usize;
        match cycle.way {
            Way::Drill { dwell } => {
                self.go_to_level(normal, cycle.depth, true, span, out)?;
                self.dwell(dwell, span, out)?;
            }
            Way::Peck { strokes, clearance, settle } => {
                let (mut stroke, mut bottom) = (strokes.first, cycle.retract - strokes.first);
                while bottom > cycle.depth {
                    self.go_to_level(normal, bottom, true, span, out)?;
                    self.dwell(strokes.pause, span, out)?;
                    // Without a clearance it goes down at feed.
                    let [up, down] = clearance.map_or([out_to; 2], |by| [cycle.retract, bottom + by]);
                    self.go_to_level(normal, up, false, span, out)?;
                    self.dwell(settle, span, out)?;
                    self.go_to_level(normal, down, false, span, out)?;
                    stroke = next_peck(stroke, strokes.peck, strokes.less);
                    bottom -= stroke;
                }
                self.go_to_level(normal, cycle.depth, true, span, out)?;
                self.dwell(strokes.dwell, span, out)?;
            }
            Way::Break { strokes, lift, at_feed } => {
                let mut stroke = strokes.first;
                let mut bottom = cycle.retract - stroke;
                while bottom > cycle.depth {
                    self.go_to_level(normal, bottom, true, span, out)?;
                    self.dwell(strokes.pause, span, out)?;
                    self.go_to_level(normal, bottom + lift, at_feed, span, out)?;
                    stroke = next_peck(stroke, strokes.peck, strokes.less);
                    bottom -= stroke;
                }
                self.go_to_level(normal, cycle.depth, true, span, out)?;
                self.dwell(strokes.dwell, span, out)?;
            }
            Way::Bore { dwell, feed_out, to_level } => {
                self.go_to_level(normal, cycle.depth, true, span, out)?;
                self.dwell(dwell, span, out)?;
                let feed_in = self.feed;
                self.feed = feed_out.unwrap_or(feed_in);
                let end = if to_level { out_to } else { cycle.retract };
                self.go_to_level(normal, end, true, span, out)?;
                self.feed = feed_in;
            }
            Way::Tap { turn, pitch, chuck, dwell, after, to_level } => {
                if !chuck {
                    self.turn_spindle(turn.spindle(), span, out)?;
                }
                self.position[normal] = cycle.depth;
                self.in_step(pitch, chuck, span, out)?;
                if !chuck {
                    self.turn_spindle(Spindle::Stopped, span, out)?;
                }
                self.dwell(dwell[0], span, out)?;
                self.turn_spindle(turn.back().spindle(), span, out)?;
                self.dwell(dwell[1], span, out)?;
                self.position[normal] = if to_level { out_to } else { cycle.retract };
                self.in_step(pitch, chuck, span, out)?;
                if !chuck {
                    self.turn_spindle(Spindle::Stopped, span, out)?;
                }
                self.dwell(dwell[2], span, out)?;
                if chuck {
                    self.turn_spindle(after, span, out)?;
                }
            }
            Way::Fine { turn, dwell, angle, shift, .. } => {
                if let Some(turn) = turn {
                    self.turn_spindle(turn.spindle(), span, out)?;
                }
                self.go_to_level(normal, cycle.depth, true, span, out)?;
                self.dwell(dwell, span, out)?;
                let angle = angle.unwrap_or(self.world.orientation);
                self.state.spindle = Spindle::Stopped;
                self.emit(Kind::Orient(angle), span, out)?;
                for (at, by) in self.position.iter_mut().zip(shift) {
                    *at += by;
                }
                self.emit_move(false, span, out)?;
            }
            Way::Stop { turn, dwell, stop, .. } => {
                if let Some(turn) = turn {
                    self.turn_spindle(turn.spindle(), span, out)?;
                }
                self.go_to_level(normal, cycle.depth, true, span, out)?;
                self.dwell(dwell, span, out)?;
                self.turn_spindle(Spindle::Stopped, span, out)?;
                if stop {
                    self.emit(Kind::ProgramStop, span, out)?;
                }
            }
        }
        Ok(())
    }

    /// What the spindle does after the hole, at the level to return to; `turned` is what it did before.
    fn after_hole(
        &mut self,
        cycle: &ActiveCycle,
        turned: Spindle,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let normal = cycle.plane.axes().2 as usize;
        match cycle.way {
            Way::Tap { chuck: false, after, .. } => self.turn_spindle(after, span, out),
            Way::Fine { shift, after, .. } => {
                for (axis, by) in shift.iter().enumerate() {
                    if axis != normal {
                        self.position[axis] -= by;
                    }
                }
                self.emit_move(false, span, out)?;
                self.turn_spindle(after.unwrap_or(turned), span, out)
            }
            Way::Stop { after, .. } => self.turn_spindle(after.unwrap_or(turned), span, out),
            Way::Tap { chuck: true, .. }
            | Way::Drill { .. }
            | Way::Peck { .. }
            | Way::Break { .. }
            | Way::Bore { .. } => Ok(()),
        }
    }

    fn go_to_level(
        &mut self,
        axis: usize,
        level: Nanos,
        feed: bool,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if axis == self.along {
            self.take_up_length();
        }
        self.position[axis] = level;
        self.emit_move(feed, span, out)
    }

    fn dwell(&mut self, seconds: Option<Nanos>, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        match seconds {
            // Of no seconds it is none.
            Some(0) | None => Ok(()),
            Some(seconds) => self.emit(Kind::Dwell(seconds), span, out),
        }
    }
}
