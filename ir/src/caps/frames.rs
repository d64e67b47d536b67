//! Zeros, frames, and machine coordinates.

use crate::program::ReferencePoint;

/// What a target can say of zeros and frames.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameCaps {
    /// Number of work offsets that it can name; 0 if it has one without a name.
    pub work_offsets: u16,
    /// A word for none of its settable work offsets: number 0.
    pub work_offsets_off: bool,
    /// Values of work offsets: set; added to; so that the present position reads the words.
    pub offset_data: [bool; 3],
    /// Whether a work offset can be turned.
    pub offset_turns: bool,
    /// A chain of frames: translation, rotation in the plane, scale, mirror.
    pub chain: bool,
    /// A local shift, axis by axis.
    pub local_shift: bool,
    /// A G92 shift, by the coordinates that the present point gets.
    pub origin_shift: bool,
    /// Words that suspend a G92 shift and restore it.
    pub suspends_shift: bool,
    /// A G92 shift, axis by axis.
    pub stated_shift: bool,
    /// A word that cancels a G92 shift.
    pub clears_shift: bool,
    /// A rotation in the plane about a point.
    pub rotation: bool,
    /// Factors about a point.
    pub scale: bool,
    /// Axes mirrored at a place.
    pub mirror: bool,
    /// Form of tilted working planes.
    pub tilt: TiltForm,
    /// Whether no other zero may be set while a rotation, factors or a mirror are active.
    pub shut: bool,
}

/// How a target says a tilted working plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TiltForm {
    /// Not at all.
    #[default]
    None,
    /// By turns about Z, the new X, and the new Z; the tool is turned by a word of its own.
    Euler,
    /// By turns about three different axes, each about the new one, in any order; the tool is turned by
    /// the same word, towards a side that it names.
    AxisByAxis,
    /// As the text form does.
    Any,
}

/// What a target can say of machine coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MachineCaps {
    /// Moves in machine coordinates.
    pub coordinates: bool,
    /// What becomes of the tool's length in such a move.
    pub length: LengthThere,
    /// Whether a move in machine coordinates is always rapid.
    pub rapid: bool,
    /// Reference points that have a word.
    pub references: References,
    /// Whether a rapid move to such a point can go by another point first.
    pub reference_via: bool,
    /// What becomes of the tool's length after a move to such a point.
    pub reference_length: LengthThere,
    /// Stored positions that can be set to where the axes stand: 1, 2.
    pub stored_positions: [bool; 2],
}

/// What becomes of the tool's length in a move of the machine's own coordinates, or after one to a reference point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LengthThere {
    /// Either.
    #[default]
    Either,
    /// It stays active.
    Stays,
    /// It is off.
    Off,
}

sides!(LengthThere, Stays, Off, stays);

impl LengthThere {
    /// Whether it stays: as asked, where either can be stated.
    pub fn or(self, asked: bool) -> bool {
        match self {
            LengthThere::Either => asked,
            LengthThere::Stays => true,
            LengthThere::Off => false,
        }
    }
}

/// Reference points that a target supports, each up to which number; 0 is none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)] // As [`crate::program::ReferencePoint`].
pub struct References {
    pub home: bool,
    pub further: u8,
    pub fixed: u8,
    pub stored: u8,
}

impl References {
    /// All there are.
    pub const ALL: References = References { home: true, further: 4, fixed: 4, stored: 2 };

    /// Whether a point has a word.
    pub fn has(&self, point: ReferencePoint) -> bool {
        match point {
            ReferencePoint::Home => self.home,
            ReferencePoint::Further(n) => n <= self.further,
            ReferencePoint::Fixed(n) => n <= self.fixed,
            ReferencePoint::Stored(n) => n <= self.stored,
        }
    }
}
