//! What a target can say. Passes see these capabilities, never a dialect's name.
//!
//! ```text
//! caps.arcs.by_radius        whether `R` can be written
//! caps.holes.cycles          the cycles, each with where it can leave the tool
//! ```
//!
//! Not here: which word says it: the dictionary.

/// What there is to ask of a choice between two sides, where a target may also have both.
macro_rules! sides {
    ($name:ident, $yes:ident, $no:ident, $which:ident) => {
        impl $name {
            #[doc = concat!("The only side there is: `", stringify!($yes), "`, or else `", stringify!($no), "`.")]
            pub fn only($which: bool) -> $name {
                if $which { $name::$yes } else { $name::$no }
            }

            /// Whether this side can be stated.
            pub fn says(self, $which: bool) -> bool {
                self == $name::Either || self == $name::only($which)
            }
        }
    };
}

mod frames;
mod holes;
mod modes;
mod moves;
mod tools;

pub use frames::{FrameCaps, LengthThere, MachineCaps, References, TiltForm};
pub use holes::{CircleStart, CycleCap, CycleForm, FeedsOutTo, GridWay, HoleCaps, Lift, Own, ReturnsTo};
pub use modes::{FlowCaps, ModeCaps};
pub use moves::{ArcCaps, CompensationCaps, Corners, MoveCaps, PolarForm, Radii, Threads};
pub use tools::{LengthsOf, TipForm, ToolCaps};

use crate::behaviour::Behaviours;
use crate::canon::{AdviceKind, PathMode, ReturnLevel};
use crate::program::kinds::{
    conduct, drilling, flow, machine, miscellaneous, modes, moves, polar, tooling, variables,
};
use crate::program::{FrameSlot, Op, Probe, Slot, ToolLength};

/// Capabilities of a target, filled from its dictionary, by what they are about.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Caps {
    /// Holes: its cycles and patterns.
    pub holes: HoleCaps,
    /// Moves, but for arcs.
    pub moves: MoveCaps,
    /// Arcs.
    pub arcs: ArcCaps,
    /// Cutter radius compensation.
    pub compensation: CompensationCaps,
    /// Zeros and frames.
    pub frames: FrameCaps,
    /// Machine coordinates.
    pub machine: MachineCaps,
    /// Tools, and how it changes them.
    pub tools: ToolCaps,
    /// Modes, advice and messages.
    pub modes: ModeCaps,
    /// The order of blocks, and what it computes.
    pub flow: FlowCaps,
    /// What codes of the control do besides their names.
    pub behaviours: Behaviours,
    /// The target is a list of events: every structure is expanded, every axis named, absolute.
    pub flat: bool,
}

impl Caps {
    /// Place of a kind of probing move in [`MoveCaps::probes`].
    pub fn probe(probe: Probe) -> usize {
        usize::from(probe.away) * 2 + usize::from(probe.error)
    }

    /// Whether a mode of taking corners can be written.
    pub fn says_path(&self, mode: PathMode) -> bool {
        self.modes.path >> mode as u16 & 1 == 1
    }

    /// Whether advice can be written.
    pub fn advises(&self, kind: AdviceKind, value: u8) -> bool {
        self.modes.advice.contains(&(kind, value))
    }

    /// Whether it shows what a program stop says.
    pub fn shows_at_stops(&self) -> bool {
        self.modes.messages || self.modes.stop_messages
    }

    /// Whether a length that stands in no table can be written.
    pub fn says_length(&self, length: &ToolLength) -> bool {
        let [stated, added] = self.tools.stated_lengths;
        match length {
            ToolLength::Value(_) => stated,
            ToolLength::Added(_) | ToolLength::AddedEntry(_) => added,
            // Who has them in the table can state them.
            ToolLength::Offsets { added: adds, .. } => {
                let [.., x, y] = self.tools.data;
                x && y && if *adds { added } else { stated }
            }
        }
    }

    /// Whether a statement that changes a frame can be written as it is. Anything else can.
    pub fn says_frame(&self, op: &Op) -> bool {
        match op {
            Op::SetFrame(_) | Op::ClearFrame(FrameSlot::Chain) => self.frames.chain,
            Op::SetPosition(_) => self.frames.origin_shift,
            Op::UseOriginShift(_) => self.frames.suspends_shift,
            Op::SetSlot(slot) => match **slot {
                Slot::Shift { origin: true, .. } => self.frames.stated_shift,
                Slot::Shift { origin: false, .. } => self.frames.local_shift,
                Slot::Rotation { .. } => self.frames.rotation,
                Slot::Scale { .. } => self.frames.scale,
                Slot::Mirror(_) | Slot::NoMirror(_) => self.frames.mirror,
                Slot::Tilt(_) => self.frames.tilt != TiltForm::None,
            },
            Op::ClearFrame(FrameSlot::Shift) => self.frames.clears_shift,
            Op::ClearFrame(FrameSlot::Local) => self.frames.local_shift,
            Op::ClearFrame(FrameSlot::Rotation) => self.frames.rotation,
            Op::ClearFrame(FrameSlot::Scale) => self.frames.scale,
            Op::ClearFrame(FrameSlot::Mirror) => self.frames.mirror,
            Op::ClearFrame(FrameSlot::Tilt) => self.frames.tilt != TiltForm::None,
            Op::ClearFrame(FrameSlot::Polar)
            | Op::SetOriginOffsets(_)
            | Op::UseToolCentrePoint(_)
            | Op::UseMachineCoordinates { .. }
            | Op::SetFeedRate(_)
            | Op::Position(_)
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | machine!()
            | miscellaneous!()
            | conduct!()
            | modes!()
            | tooling!()
            | moves!()
            | drilling!()
            | polar!()
            | flow!()
            | Op::Probe(_)
            | Op::Detour(_) => true,
        }
    }

    /// Whether every frame can be written as it is.
    pub fn says_all_frames(&self) -> bool {
        self.frames.chain
            && self.frames.local_shift
            && self.frames.origin_shift
            && self.frames.stated_shift
            && self.frames.suspends_shift
            && self.frames.rotation
            && self.frames.scale
            && self.frames.mirror
    }

    /// Whether a cycle of this kind can be written, returning there.
    pub fn cycle(&self, kind: &str, level: Option<ReturnLevel>, dwell: bool) -> bool {
        self.holes
            .cycles
            .iter()
            .any(|c| c.kind == kind && (c.dwell || !dwell) && level.is_none_or(|l| c.returns.contains(&l)))
    }
}
