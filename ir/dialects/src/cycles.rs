//! Rows of canned cycles and of patterns of positions.

use ncc_ir::expr::num::{Num, Unit};
use serde::Deserialize;

use crate::power_on::{ApproachName, ReturnLevelName};
use crate::words::{Quantity, yes};

/// What all canned cycles of a dialect share.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CycleRules {
    /// Whether the block that calls a cycle up makes a hole (if it has an axis word or its own).
    pub hole_on_definition: bool,
    /// Where the tool goes, if that is fixed; else the modal return level decides.
    pub return_level: Option<ReturnLevelName>,
    /// The way to a hole; the option `cycle_approach` of a dictionary may choose another one.
    pub approach: ApproachName,
    /// Whether Z and R stay active from one cycle code to the next.
    pub retained: bool,
    /// Whether they stay so only as long as it is the same code.
    pub retained_by_code: bool,
    /// Whether words that stay active are measured as the distance mode of each further block has it, not
    /// as they were when they were stated.
    pub measured_anew: bool,
    /// Whether the initial level of a hole is where the tool is before its block; else where it stood before the
    /// first hole of the series.
    pub level_of_block: bool,
    /// Whether every move that is no cycle's, and the code that ends a cycle, make the initial level the return level
    /// again.
    pub level_lost: bool,
    /// Whether a cycle works along the normal of any plane, with that axis's letter for the depth.
    pub any_plane: bool,
    /// Whether words of rotary axes can stand in a cycle's block.
    pub no_rotary: bool,
    /// Whether no motion is active after the code that ends a cycle: axis words alone are an error.
    pub ends_motion: bool,
    /// Whether a cycle that a subprogram activates ends with it: it cannot be left active to the caller.
    pub ends_with_call: bool,
    /// Letter of the number of repetitions in a cycle's block: 0 stores the data and makes no hole.
    pub repeat: Option<char>,
    /// Whether 0 is no such number.
    pub repeat_once: bool,
    /// Whether the dwell that any cycle has said stays active for a later cycle that can go without one.
    pub dwell_left: bool,
    /// Value of the peck cycle's clearance parameter assumed, in mm, where an expansion
    /// needs one.
    pub peck_clearance: Option<f64>,
    /// The alarm with which the control ends a program of which a cycle's planes do not lie one above the other.
    pub planes_alarm: Option<u32>,
    /// Whether the rows are confirmed for incremental mode.
    pub incremental: bool,
    /// The manual and its page, or another source.
    pub source: String,
}

impl CycleRules {
    /// Whether what a cycle has said stays active for one of another code.
    pub const fn retained_by_all(&self) -> bool {
        self.retained && !self.retained_by_code
    }
}

/// A canned cycle.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CycleRow {
    /// Its code.
    pub code: String,
    /// Its kind: `drill`, `drill-dwell`, `drill-peck`, `drill-break`, `bore`, `tap`, `tap-rigid`,
    /// `bore-fine`, `bore-stop`.
    pub kind: String,
    /// Letter of the bottom.
    pub depth: char,
    /// Letter of the retract plane.
    pub retract: char,
    /// Letter and unit of the dwell, if it has one.
    #[serde(default)]
    pub dwell: Option<DwellWord>,
    /// A word that the sources do not agree on: an option says whether it is the dwell.
    #[serde(default)]
    pub dwell_by: Option<AskedDwell>,
    /// Letter of the peck.
    #[serde(default)]
    pub peck: Option<char>,
    /// Letters of pecks that decrease, in place of that one: of the first, of how much less each further one is, and
    /// of the least.
    #[serde(default)]
    pub shrinking: Option<[char; 3]>,
    /// Whether the dwell must be stated.
    #[serde(default)]
    pub dwell_needed: bool,
    /// Of pecks, milliseconds that the control dwells by itself after each of them, at the bottom too.
    #[serde(default)]
    pub pause: Option<u32>,
    /// Of pecks, whether each goes out to where the tool is left after the hole, and down at feed; else by rapid to the
    /// retract plane and back to the clearance.
    #[serde(default)]
    pub from_return: bool,
    /// Whether it works along its own letter's axis alone, where other cycles work in any plane.
    #[serde(default)]
    pub one_plane: bool,
    /// Whether the feed out of the hole goes on to the level where the tool is left.
    #[serde(default)]
    pub feed_to_level: bool,
    /// Of tapping, the hand of the thread.
    #[serde(default)]
    pub hand: Option<Hand>,
    /// Of tapping, whether the dwell is at the bottom alone, when the spindle has turned round; else it is at
    /// both ends, before it does.
    #[serde(default)]
    pub dwells_turned: bool,
    /// Of boring with a stop, whether the spindle then turns as it did before; else clockwise.
    #[serde(default)]
    pub turns_on: bool,
    /// Of fine boring, the letter of the shift off the wall.
    #[serde(default)]
    pub shift: Option<char>,
    /// Whether the row is confirmed.
    #[serde(default = "yes")]
    pub sure: bool,
    /// The manual and its page, or another source.
    pub source: String,
}

impl CycleRow {
    /// Seconds that the control dwells by itself after each peck.
    pub fn own_pause(&self) -> Option<Num> {
        let pause = self.pause?;
        Some(Num { mantissa: i64::from(pause), scale: 3, point: true, unit: Unit::Second }.trimmed())
    }

    /// What the control does in it that no word says.
    pub fn own(&self) -> ncc_ir::caps::Own {
        ncc_ir::caps::Own { dwells_turned: self.dwells_turned, turns_on: self.turns_on }
    }
}

impl AskedDwell {
    /// The word, where it is a dwell.
    pub const fn word(&self) -> DwellWord {
        DwellWord { letter: self.letter, quantity: self.quantity }
    }
}

/// The hand of a thread.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Hand {
    /// Cut with the spindle turning clockwise.
    Right,
    /// Cut with the spindle turning counter-clockwise.
    Left,
}

impl Hand {
    /// The sense in which the spindle turns into the thread.
    pub const fn turn(self) -> ncc_ir::canon::Turn {
        match self {
            Hand::Right => ncc_ir::canon::Turn::Clockwise,
            Hand::Left => ncc_ir::canon::Turn::Counterclockwise,
        }
    }
}

/// A word that is a dwell on some machines and has no use on others. Where it is none, its value still stays
/// active for a cycle that has a use for it.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct AskedDwell {
    /// Its letter.
    pub letter: char,
    /// Seconds or milliseconds.
    pub quantity: Quantity,
    /// The option that is asked: `dwell`, `ignored`, or `refused`.
    pub option: String,
}

/// What an option says of an [`AskedDwell`]: the control dwells.
pub const DWELLS: &str = "dwell";

/// What an option says of an [`AskedDwell`]: a program with the word is not read.
pub const DWELL_REFUSED: &str = "refused";

/// A word that says how long to dwell.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct DwellWord {
    /// Its letter.
    pub letter: char,
    /// Seconds or milliseconds.
    pub quantity: Quantity,
}

impl CycleRow {
    /// Letters of the words that a cycle alone has: not those of axes, nor of the feed.
    pub fn own_letters(&self) -> impl Iterator<Item = char> + use<> {
        let dwells =
            [self.dwell.as_ref().map(|word| word.letter), self.dwell_by.as_ref().map(|word| word.letter)];
        let letters = dwells.into_iter().chain([Some(self.retract), self.peck, self.shift]).flatten();
        letters.chain(self.shrinking.into_iter().flatten())
    }
}

/// A pattern of positions.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
#[allow(missing_docs)] // Letters of the words of `ncc_ir::program::cycle::Pattern`.
pub enum PatternRow {
    Circle { code: String, first: [char; 2], centre: [char; 2], step: char, count: char, source: String },
    Grid { code: String, pitch: [char; 2], counts: [char; 2], serpentine: bool, source: String },
}

impl PatternRow {
    /// Its code.
    pub fn code(&self) -> &str {
        match self {
            PatternRow::Circle { code, .. } | PatternRow::Grid { code, .. } => code,
        }
    }
}
