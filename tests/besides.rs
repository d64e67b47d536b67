//! What controls do besides the names of codes, where two lists of events are laid side by side: what the one switches by
//! itself, the other may say in words, as long as nothing is cut.

use ncc_dialects::builtin;
use ncc_driver::job::Job;
use ncc_exec::world::World;

use crate::plain::{Happening, Plain};

/// Whether coolant is switched by a word, where the other control did the same by itself, or this one had.
pub(crate) fn switched(event: &Plain, other: &Plain) -> bool {
    matches!(event.what, Happening::Coolant)
        && (event.by_itself.coolant || other.by_itself.coolant && event.coolant == other.coolant)
}

/// Whether it is a cut.
pub(crate) fn cuts(what: Happening) -> bool {
    matches!(what, Happening::Feed | Happening::Arc { .. } | Happening::Thread { .. } | Happening::Probe(..))
}

/// The same without spindle and coolant where nothing is cut.
pub fn of_cuts(list: &[Plain]) -> Vec<Plain> {
    let kept = list.iter().filter(|event| event.what != Happening::Coolant);
    let bare = |event: &Plain| match cuts(event.what) {
        true => *event,
        false => Plain { speed: 0.0, surface: None, coolant: (false, false), ..*event },
    };
    kept.map(bare).collect()
}

/// What the first control had where the second one switched or moved by itself: that alone is passed over.
#[derive(Clone, Copy, Default)]
pub(crate) struct Unsaid {
    /// Speed of the spindle, negative counter-clockwise.
    speed: Option<f64>,
    z: Option<f64>,
}

impl Unsaid {
    /// What the second control alone has done by itself is as the first one has it, as long as nothing is cut, and as
    /// long as the first program neither turns the spindle the other way nor moves Z by more than `near`.
    pub(crate) fn passed_over(&self, a: &Plain, b: &Plain, near: f64) -> Plain {
        let mut b = *b;
        if cuts(b.what) {
            return b;
        }
        let (code, changes) = (is_code(a.what), a.what == Happening::ToolChange);
        let turned = !code && self.speed.is_some_and(|was| sense(was) != sense(a.speed));
        if b.by_itself.spindle && !a.by_itself.spindle && !turned {
            (b.speed, b.surface) = (a.speed, a.surface);
        }
        if b.by_itself.coolant && !a.by_itself.coolant {
            b.coolant = a.coolant;
        }
        let moved = !changes && self.z.is_some_and(|was| (was - a.at[2]).abs() > near);
        if b.by_itself.z && !a.by_itself.z && !moved || a.by_itself.z && !b.by_itself.z_moved {
            b.at[2] = a.at[2];
        }
        b
    }

    /// Two events were found equal.
    pub(crate) fn after(&mut self, a: &Plain, b: &Plain) {
        let keep = |by_itself: bool, code: bool, was: Option<f64>, now: f64| match was {
            _ if !by_itself => None,
            Some(was) if !code => Some(was),
            _ => Some(now),
        };
        self.speed = keep(b.by_itself.spindle, is_code(a.what), self.speed, a.speed);
        self.z = keep(b.by_itself.z, a.what == Happening::ToolChange, self.z, a.at[2]);
    }
}

/// Whether controls switch the spindle there by themselves.
fn is_code(what: Happening) -> bool {
    matches!(what, Happening::Stop | Happening::OptionalStop | Happening::ToolChange | Happening::End)
}

/// Sense of a spindle: 0 while it stands.
fn sense(speed: f64) -> i8 {
    i8::from(speed > 0.0) - i8::from(speed < 0.0)
}

/// The source's events as the second interpreter of a target makes them that has no words for the way up to a tool change
/// ([`Job::takes_way_up`]): it takes nothing of it; nor has it messages that its control does not show.
pub fn for_target(list: Vec<Plain>, job: &Job) -> Vec<Plain> {
    let list = as_shown(list, &job.to.dialect.id);
    if job.takes_way_up() { without_way_up(list) } else { list }
}

/// The events without messages that a control does not show: one that shows none while the program runs may show those with
/// which it stops.
pub fn as_shown(list: Vec<Plain>, dialect: &str) -> Vec<Plain> {
    let Some(caps) = builtin(dialect).map(|dialect| &dialect.caps).filter(|caps| !caps.modes.messages) else {
        return list;
    };
    let stops = |at: usize| list.get(at + 1).is_some_and(|next| next.what == Happening::Stop);
    let shown = |(at, event): &(usize, &Plain)| match event.what {
        Happening::MessageCleared => false,
        Happening::Message => caps.modes.stop_messages && stops(*at),
        _ => true,
    };
    list.iter().enumerate().filter(shown).map(|(_, event)| *event).collect()
}

/// A world in which two programs are compared, in which the operator sets the zero of Z by each tool where one of the two
/// controls has no other way.
pub fn zeroed(world: World, dialects: [&str; 2]) -> World {
    let by_hand = |id: &str| ncc_dialects::builtin(id).is_some_and(|dialect| dialect.can.change_by_hand);
    World { zeroed_by_tool: dialects.into_iter().any(by_hand), ..world }
}

/// The same as if the control stayed where the program has put it: what it does by itself for a tool change is undone, as
/// long as nothing is cut there.
pub fn without_way_up(list: Vec<Plain>) -> Vec<Plain> {
    let (mut kept, mut z): (Vec<Plain>, Option<f64>) = (Vec::new(), None);
    for mut event in list {
        if event.by_itself.moves {
            z = kept.last().map(|last: &Plain| last.at[2]);
            continue;
        }
        match z {
            Some(z) if event.by_itself.z && !cuts(event.what) => event.at[2] = z,
            _ => z = None,
        }
        kept.push(event);
    }
    kept
}

/// The events without straight moves that are no longer than this, in mm.
pub fn longer(moves: &[Plain], least: f64) -> Vec<Plain> {
    let mut kept: Vec<Plain> = Vec::new();
    for event in moves {
        let straight = matches!(event.what, Happening::Traverse | Happening::Feed);
        let short = |from: &Plain| from.at.iter().zip(event.at).all(|(a, b)| (a - b).abs() <= least);
        if !(straight && kept.last().is_some_and(short)) {
            kept.push(*event);
        }
    }
    kept
}
