//! Words of canned cycles, and of patterns of holes.

use ncc_ir::canon::Turn;
use ncc_ir::caps::CycleForm;

use super::{Code, Dwell, Letter};

/// A canned cycle's words.
#[derive(Clone, Debug)]
pub(crate) struct CycleCode {
    pub kind: String,
    pub code: Code,
    pub depth: Letter,
    pub retract: Letter,
    pub dwell: Option<Dwell>,
    /// The option that says whether there is that word.
    pub asked: Option<&'static str>,
    pub peck: Option<Letter>,
    /// Of pecks that decrease: of the first, of how much less each further one is, of the least.
    pub shrinking: Option<[Letter; 3]>,
    pub hand: Option<Turn>,
    /// How it drives the spindle.
    pub form: CycleForm,
    /// Whether its feed out goes on to where the tool is left.
    pub to_level: bool,
    /// Whether its dwell must be stated.
    pub dwell_needed: bool,
    /// Whether the control dwells after each peck by itself.
    pub own_pause: bool,
    /// Whether each peck goes out to where the tool is left, and down at feed.
    pub from_return: bool,
}

/// A bolt circle's words.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CircleCode {
    pub code: Code,
    pub first: [Letter; 2],
    pub centre: [Letter; 2],
    pub step: Letter,
    pub count: Letter,
}

/// A grid's words.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GridCode {
    pub code: Code,
    pub pitch: [Letter; 2],
    pub counts: [Letter; 2],
    pub serpentine: bool,
}
