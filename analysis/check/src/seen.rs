//! The state of the control as the rules see it: each mode is as at the entry, stated, or lost.

use ncc_ir::canon::AXES;
use ncc_ir::source::Span;

use crate::finding::LeftOn;

/// How well a fact is known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Known {
    /// The program has not stated it: it is as at power-on, or as a caller left it.
    #[default]
    Entry,
    /// The program has stated it.
    Said,
    /// A block that was not read may have changed it.
    Lost,
}

/// The length of the tool since the last change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Length {
    /// No change, or its length is active, or it was reported already that it is not.
    #[default]
    Fine,
    /// The tool was changed at the place, and its length is not active.
    Missing(Span),
}

/// What has been seen.
#[derive(Clone, Debug, Default)]
pub(crate) struct Seen {
    pub(crate) feed: Known,
    pub(crate) spindle: Known,
    pub(crate) speed: Known,
    pub(crate) length: Length,
    /// Whether the frames between machine and program may be others than those executed.
    pub(crate) frame_lost: bool,
    /// Whether the active length is not known.
    pub(crate) length_lost: bool,
    /// Axes whose place is known in program coordinates.
    pub(crate) program: [bool; AXES],
    /// Axes whose place is known in machine coordinates.
    pub(crate) machine: [bool; AXES],
    /// Axes of which an absolute word is known in machine coordinates.
    pub(crate) base: [bool; AXES],
    /// The words of the coming move are machine coordinates.
    pub(crate) raw: bool,
    /// Modes that are on, with the places that switched them on.
    on: Vec<(LeftOn, Span)>,
}

impl Seen {
    /// A mode is switched on.
    pub(crate) fn switch_on(&mut self, mode: LeftOn, at: Span) {
        self.switch_off(mode);
        self.on.push((mode, at));
    }

    /// A mode is switched off.
    pub(crate) fn switch_off(&mut self, mode: LeftOn) {
        self.on.retain(|(on, _)| *on != mode);
    }

    /// Whether a mode is on.
    pub(crate) fn is_on(&self, mode: LeftOn) -> bool {
        self.on.iter().any(|(on, _)| *on == mode)
    }

    /// Modes that are on.
    pub(crate) fn on(&self) -> &[(LeftOn, Span)] {
        &self.on
    }

    /// A block was not read: nothing that the program has said is certain any more.
    pub(crate) fn lose(&mut self) {
        *self = Seen {
            feed: Known::Lost,
            spindle: Known::Lost,
            speed: Known::Lost,
            frame_lost: true,
            length_lost: true,
            ..Seen::default()
        };
    }
}
