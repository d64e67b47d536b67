//! What a control does besides the names of codes, in a comparison.
//!
//! A Haas takes Z to machine zero at M06, and a target that lacks it stays. Both do the same as long as nothing is
//! cut, and as long as the program says nothing of it:
//!
//! ```text
//! T6 M06
//! G00 X-10. Y0.     Z stands elsewhere on the target: passed over
//! G00 Z20.          the source's program moves Z: the target's must stand there too
//! ```
//!
//! Not here: what the controls do (`exec::at_codes`).

use crate::Event;
use crate::Kind;
use crate::State;
use crate::by_control;
use crate::cuts;
use ncc_ir::canon::{AXES, Axis, Spindle};
use ncc_ir::expr::num::Nanos;

/// What the source had where the target's control switched or moved by itself: this much alone is passed over.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Passed {
    /// The sense of the spindle.
    spindle: Option<Spindle>,
    /// Z in machine coordinates.
    z: Option<Nanos>,
    /// Whether coolant is off since, and nothing was cut.
    dry: bool,
}

impl Passed {
    /// Whether nothing is passed over.
    pub(super) fn is_nothing(&self) -> bool {
        self.spindle.is_none() && self.z.is_none() && !self.dry
    }

    /// Two events were found equal; `around` is what an optional stop lets pass besides.
    pub(super) fn after(&mut self, a: &Event, b: &Event, around: u8) {
        let by_target = b.state.by_control | around;
        if by_target & by_control::SPINDLE == 0 {
            self.spindle = None;
        } else if switches(&a.kind) || self.spindle.is_none() {
            self.spindle = Some(a.state.spindle);
        }
        let off = !(b.state.flood || b.state.mist);
        self.dry = off && (by_target & by_control::COOLANT != 0 || self.dry && !cuts(&a.kind));
        if b.state.by_control & by_control::Z == 0 {
            self.z = None;
        } else if a.kind == Kind::ToolChange || self.z.is_none() {
            self.z = Some(a.end[Axis::Z as usize]);
        }
    }

    /// The bits of these that are passed over: the source's program has not turned the spindle another way since.
    pub(super) fn unsaid(&self, a: &Event, bits: u8) -> u8 {
        let said = !switches(&a.kind) && self.spindle.is_some_and(|was| was != a.state.spindle);
        if said { bits & !by_control::SPINDLE } else { bits }
    }

    /// Whether a word of the source switches coolant off that the target's control has switched off already.
    pub(super) fn off_already(&self, a: &Event, b: &Event) -> bool {
        a.kind == Kind::Coolant
            && self.dry
            && ![a, b].iter().any(|event| event.state.flood || event.state.mist)
    }

    /// Whether the source's Z has moved since the target's control took Z away.
    pub(super) fn z_moved(&self, a: &Event, half: Nanos) -> bool {
        let moved = |was: Nanos| a.end[Axis::Z as usize].abs_diff(was) > half as u64;
        a.kind != Kind::ToolChange && self.z.is_some_and(moved)
    }
}

/// Whether controls switch the spindle at such a code by themselves.
fn switches(kind: &Kind) -> bool {
    matches!(kind, Kind::ProgramStop | Kind::OptionalProgramStop | Kind::ToolChange | Kind::ProgramEnd)
}

/// Whether two moves take the same time, where one of their controls counts the feed in a way of its own: to half a per
/// cent, because F of such a move has few digits.
pub(super) fn same_time([source, target]: [Nanos; 2], timed: bool) -> bool {
    let apart = i128::from(source.abs_diff(target));
    timed && apart * 190 <= i128::from(source)
}

/// Whether Z is where the control or the operator has left it, on one side alone.
pub(super) fn z_passed_over(source: &Event, target: &Event) -> bool {
    target.state.by_control & !source.state.by_control & by_control::Z != 0 || from_start(source, target)
}

/// Whether the source's control has taken Z to machine zero, and the target's Z still stands where the operator has
/// left it.
pub(super) fn from_start(source: &Event, target: &Event) -> bool {
    source.state.by_control & by_control::Z != 0 && target.state.by_control & by_control::Z_AT_START != 0
}

/// Where the target's event ends, with Z as it is in the source.
pub(super) fn with_z_of(source: &Event, target: &Event) -> [Nanos; AXES] {
    let mut end = target.end;
    end[Axis::Z as usize] = source.end[Axis::Z as usize];
    end
}

/// The target's state with what its control alone has switched as it is in the source.
pub(super) fn but_for_control(source: &State, target: &State, bits: u8) -> State {
    let mut state = *target;
    if bits & by_control::SPINDLE != 0 {
        (state.spindle, state.speed) = (source.spindle, source.speed);
        (state.spindle_mode, state.limit, state.centre) = (source.spindle_mode, source.limit, source.centre);
    }
    if bits & by_control::COOLANT != 0 {
        (state.flood, state.mist) = (source.flood, source.mist);
    }
    state
}

/// Whether coolant is switched by a word on one side, where the control of the other side did the same by itself; or
/// on again, where the own control had switched it off by itself.
pub(super) fn switched_by_control(event: &Event, other: &Event) -> bool {
    let bit = by_control::COOLANT;
    let same = (event.state.flood, event.state.mist) == (other.state.flood, other.state.mist);
    matches!(event.kind, Kind::Coolant)
        && (event.state.by_control & bit != 0 || other.state.by_control & bit != 0 && same)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::{Aspect, Comparison, Resolution};
    use ncc_ir::source::Span;

    const RESOLUTION: Resolution =
        Resolution { mm: 3, inch: 4, degree: 3, feed: 3, feed_inch: 4, second: 3, speed: 0 };

    fn event(kind: Kind, [x, z]: [Nanos; 2], spindle: Spindle, by_control: u8) -> Event {
        let state = State { spindle, by_control, ..State::default() };
        let end = [x, 0, z, 0, 0, 0];
        Event { kind, end, rate: 0, state, inch: false, span: Span::default() }
    }

    fn compared(mut source: Vec<Event>, mut target: Vec<Event>) -> Option<Aspect> {
        let mut comparison = Comparison::new(RESOLUTION, [0; AXES]);
        comparison.advance(&mut source, &mut target, true).err().map(|found| found.aspect)
    }

    /// The target's control goes up for a change: passed over until the source's program moves Z.
    #[test]
    fn z_at_a_change_counts_as_soon_as_the_program_moves_it() {
        let z = by_control::Z;
        let at = |kind, place, by| event(kind, place, Spindle::Stopped, by);
        let up = || {
            let change = at(Kind::ToolChange, [0, 900_000_000], z);
            vec![at(Kind::Traverse, [0, 900_000_000], z | by_control::MOVE), change]
        };
        let source = |place| vec![at(Kind::ToolChange, [0; 2], 0), at(Kind::Traverse, place, 0)];
        let target = || [up(), vec![at(Kind::Traverse, [5_000_000, 900_000_000], z)]].concat();
        assert_eq!(compared(source([5_000_000, 0]), target()), None);
        assert_eq!(compared(source([5_000_000, 20_000_000]), target()), Some(Aspect::End(Axis::Z)));
    }

    /// The target's control stops the spindle: passed over until the source's program turns it another way.
    #[test]
    fn a_spindle_counts_as_soon_as_the_program_turns_it() {
        let at = |kind, x, spindle, by| event(kind, [x, 0], spindle, by);
        let source = |then| {
            vec![at(Kind::ProgramStop, 0, Spindle::Clockwise, 0), at(Kind::Traverse, 5_000_000, then, 0)]
        };
        let stopped = |kind, x| at(kind, x, Spindle::Stopped, by_control::SPINDLE);
        let target = || vec![stopped(Kind::ProgramStop, 0), stopped(Kind::Traverse, 5_000_000)];
        assert_eq!(compared(source(Spindle::Clockwise), target()), None);
        assert_eq!(compared(source(Spindle::Counterclockwise), target()), Some(Aspect::State));
    }
}
