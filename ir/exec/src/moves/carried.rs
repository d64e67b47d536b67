//! Incremental words that include a change of frame.
//!
//! On some controls an axis counts its first incremental word after a change of frame or work offset from the
//! coordinate that it was programmed to before: `G0 X1`, `TRANS X100`, `X=IC(1)` goes to X2 in the new frame, that is
//! to 102. An axis without a word does not move, and the change waits for its next word. Where frames turn, the words
//! of one axis would move others: that is refused.
//!
//! Not here: lengths of tools, which no control includes without being asked ([`crate::Exec::another_length_waits`]).

use crate::Exec;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, Axis, Distance};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::arguments::words_of;
use ncc_ir::program::kinds::{flow, frames, machine};
use ncc_ir::program::{Coord, Op, Point, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::FrameUnexecuted;

/// What decides whether such words include the change.
const INCLUDED: Behaviour = Behaviour::FrameOffsetIncremental;

/// Axes whose next incremental word includes a change, where the control does so.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Carried {
    /// From which coordinate of the program that word counts, nanos of a millimetre or a degree.
    from: [Option<Nanos>; AXES],
    /// Whether a frame before or after the change turns.
    turned: bool,
}

/// What is known of a control before a change of frame.
#[derive(Clone, Copy)]
pub(crate) struct Before {
    position: [Nanos; AXES],
    turned: bool,
}

impl Exec {
    /// What a change of frame may carry into the words that follow.
    #[inline]
    pub(crate) fn before_frame(&self) -> Before {
        let turned = self.tracks_frames() && self.mixes_axes();
        Before { position: self.position, turned }
    }

    /// The frame is another one now: the next incremental words include that.
    #[inline]
    pub(crate) fn carry(&mut self, before: Before) {
        if self.tracks_frames() {
            self.carry_from(before);
        }
    }

    /// Whether the control includes changes of frames in incremental words, or may do so.
    fn tracks_frames(&self) -> bool {
        let all = &self.world.behaviours;
        all.does(INCLUDED) || all.is_open(INCLUDED)
    }

    #[cold]
    fn carry_from(&mut self, before: Before) {
        let turned = before.turned || self.mixes_axes();
        let changed: [bool; AXES] = std::array::from_fn(|axis| before.position[axis] != self.position[axis]);
        if !changed.contains(&true) {
            return;
        }
        let carried = self.carried.get_or_insert_default();
        carried.turned |= turned;
        for (axis, from) in carried.from.iter_mut().enumerate() {
            if changed[axis] {
                from.get_or_insert(before.position[axis]);
            }
        }
    }

    /// Whether a word of one axis moves others in the active frames.
    fn mixes_axes(&self) -> bool {
        let turn = self.chain.as_ref().and_then(|chain| chain.turn());
        let off = |(row, factors): (usize, &[f64; 3])| {
            factors.iter().enumerate().any(|(column, factor)| row != column && factor.abs() > 1e-12)
        };
        turn.is_some_and(|turn| turn.iter().enumerate().any(off))
    }

    /// Whether the next incremental word of an axis includes a change.
    pub(crate) fn carries(&self, axis: usize) -> bool {
        self.world.behaviours.does(INCLUDED) && self.waits(axis)
    }

    /// Whether an axis has had no word since a change.
    fn waits(&self, axis: usize) -> bool {
        self.carried.as_ref().is_some_and(|carried| carried.from[axis].is_some())
    }

    /// From where the words of a point count, if they are incremental; afterwards these axes carry nothing.
    ///
    /// # Errors
    /// A frame turns.
    #[cold]
    pub(crate) fn counted_from(&mut self, to: &Point, span: Span) -> Result<[Nanos; AXES], Diagnostic> {
        let mut from = self.position;
        let Some(carried) = &self.carried else { return Ok(from) };
        for (axis, word) in to.axes.iter().enumerate() {
            let Some((word, own)) = word.as_ref().zip(carried.from[axis]) else { continue };
            if word.distance.or(self.modes.distance) == Distance::Absolute {
                continue;
            }
            self.asked |= INCLUDED.bit();
            if !self.world.behaviours.does(INCLUDED) {
                continue;
            }
            if carried.turned {
                return self.not_executed(FrameUnexecuted::IncrementAfterTurn, span).map(|()| from);
            }
            from[axis] = own;
        }
        self.not_carried(to);
        Ok(from)
    }

    /// These axes have a word, so that they carry nothing on.
    pub(crate) fn not_carried(&mut self, to: &Point) {
        let Some(carried) = &mut self.carried else { return };
        for (axis, word) in to.axes.iter().enumerate() {
            if word.is_some() {
                carried.from[axis] = None;
            }
        }
        if carried.from == [None; AXES] {
            self.carried = None;
        }
    }

    /// These axes, a bit each, have had an absolute word, so that they carry nothing on.
    pub(crate) fn carries_no_more(&mut self, axes: u32) {
        let Some(carried) = &mut self.carried else { return };
        for (axis, from) in carried.from.iter_mut().enumerate() {
            if axes >> axis & 1 == 1 {
                *from = None;
            }
        }
        if carried.from == [None; AXES] {
            self.carried = None;
        }
    }

    /// An axis goes to where no word of the program says, and carries nothing on.
    pub(crate) fn stop_carrying(&mut self, axis: usize) {
        if let Some(carried) = &mut self.carried {
            carried.from[axis] = None;
        }
    }

    /// Whether plain moves do the same here and on another control in the same state, as far as the changes go that
    /// their words may include, and turns of rotary axes.
    pub fn counts_alike(&self, other: &Exec, moves: &[Stmt]) -> bool {
        let alike = |behaviour| self.world.behaviours.get(behaviour) == other.world.behaviours.get(behaviour);
        if !alike(Behaviour::RotaryTurn) && moves.iter().filter_map(words).any(Exec::turns) {
            return false;
        }
        if !alike(Behaviour::FineDigits) && (self.is_fine_in(moves) || other.is_fine_in(moves)) {
            return false;
        }
        if self.carried == other.carried && alike(INCLUDED) {
            return true;
        }
        !self.includes_in(moves) && !other.includes_in(moves)
    }

    /// Whether any of these statements may have an incremental word of an axis that has had no word since a change of
    /// frame. What is changed within them counts for all axes.
    pub fn includes_in(&self, stmts: &[Stmt]) -> bool {
        let changes = || stmts.iter().any(|stmt| matches!(stmt.op, frames!() | machine!()));
        if !self.tracks_frames() || self.carried.is_none() && !changes() {
            return false;
        }
        let (mut distance, mut all) = (self.modes.distance, false);
        stmts.iter().any(|stmt| {
            match &stmt.op {
                Op::SetDistanceMode(mode) => distance = *mode,
                frames!() | machine!() => all = true,
                // By itself it has no words; before others a jump may lead to it.
                Op::Label(_) if stmts.len() == 1 => {}
                flow!() => return true,
                _ => {}
            }
            let relative = |(axis, word): (usize, &Option<Coord>)| {
                let incremental = |word: &Coord| word.distance.or(distance) == Distance::Incremental;
                (all || self.waits(axis)) && word.as_ref().is_some_and(incremental)
            };
            words_of(&stmt.op).is_some_and(|to| to.axes.iter().enumerate().any(relative))
        })
    }

    /// Whether words count from zero, so that plain lines do the same on all controls in one state.
    pub fn counts_absolute(&self) -> bool {
        self.modes.distance == Distance::Absolute && self.said & crate::DISTANCE != 0
    }

    /// Whether any linear axis has had no word since a change of frame.
    pub fn carries_linear(&self) -> bool {
        let carries = |carried: &Carried| carried.from[..Axis::A as usize].iter().any(Option::is_some);
        self.carried.as_deref().is_some_and(carries)
    }

    /// Another control has executed plain lines for this one: what their axes carried is over.
    pub fn has_moved(&mut self, moves: &[Stmt]) {
        if self.carries_linear() {
            let executed: Vec<&Stmt> = moves.iter().filter(|stmt| !self.skips(stmt)).collect();
            executed.into_iter().filter_map(words).for_each(|to| self.not_carried(to));
        }
    }
}

/// The words of a plain move.
fn words(stmt: &Stmt) -> Option<&Point> {
    match &stmt.op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) => Some(&m.to),
        _ => None,
    }
}
