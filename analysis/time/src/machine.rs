//! The facts of a machine that a time model needs.
//!
//! Every fact may be unknown. A model that needs an unknown fact uses a typical value;
//! [`Machine::assumed`] lists these values, so that each is reported.

use ncc_ir::canon::AXES;

/// Facts of a machine, as far as they are known. Lengths in mm (degrees of a rotary axis), rates in
/// mm/min (degrees a minute), times in seconds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Machine {
    /// Facts of each axis.
    pub axes: [AxisFacts; AXES],
    /// Rapid rate along a straight line, mm/min; if unknown, the rates of the axes decide.
    pub rapid_rate: Option<f64>,
    /// Highest feed along the path, mm/min.
    pub max_feed: Option<f64>,
    /// Seconds of a tool change.
    pub tool_change: Option<f64>,
    /// The function that takes this time.
    pub tool_change_on: ToolChangeOn,
    /// Seconds until the spindle reaches its speed.
    pub spindle_start: Option<f64>,
    /// Seconds until the spindle is stopped.
    pub spindle_stop: Option<f64>,
    /// Spindle acceleration, rev/min per second, where the time depends on the speed.
    pub spindle_acceleration: Option<f64>,
    /// Highest speed, rev/min.
    pub spindle_max: Option<f64>,
    /// Path tolerance at a corner, mm; 0 is an exact stop at every corner. A tolerance in the program
    /// takes precedence.
    pub path_tolerance: Option<f64>,
    /// Whether every move ends with an exact stop, also between collinear moves. A path mode in the
    /// program takes precedence.
    pub exact_stop: Option<bool>,
    /// Look-ahead in blocks with a move; `None` and
    /// [`WHOLE_PATH`](crate::WHOLE_PATH) mean the whole path.
    pub look_ahead: Option<u32>,
    /// Seconds of an M function, in addition to its effect.
    pub m_function: Option<f64>,
    /// Machine functions by name, with the seconds of each.
    pub functions: Vec<(String, f64)>,
    /// Least seconds of a block with a move: the block processing time.
    pub block: Option<f64>,
}

/// Facts of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisFacts {
    /// Least and greatest machine coordinate, mm or degrees.
    pub travel: Option<[f64; 2]>,
    /// Rate in rapids, mm/min or degrees a minute.
    pub rapid_rate: Option<f64>,
    /// Highest feed, mm/min or degrees a minute.
    pub max_feed: Option<f64>,
    /// Acceleration, mm/s² or degrees/s².
    pub acceleration: Option<f64>,
    /// Jerk, mm/s³ or degrees/s³.
    pub jerk: Option<f64>,
}

/// The function that takes the time of a tool change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToolChangeOn {
    /// `CHANGE_TOOL`.
    #[default]
    Change,
    /// `SELECT_TOOL`, as in the case study's table.
    Select,
}

impl Machine {
    /// Seconds of a machine function, if stated.
    pub(crate) fn function(&self, name: &str) -> Option<f64> {
        self.functions.iter().find(|(function, _)| function == name).map(|(_, seconds)| *seconds)
    }
}
