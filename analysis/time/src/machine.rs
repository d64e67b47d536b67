//! What a model needs to know of a machine.
//!
//! Every fact may be unknown. A model that needs it takes a value for granted, which
//! [`Machine::assumed`] lists; it is never filled in silently.

use ncc_ir::canon::AXES;

/// Facts of a machine, as far as they are known. Lengths in mm (degrees of a rotary axis), rates in
/// mm/min (degrees a minute), times in seconds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Machine {
    /// Facts of each axis.
    pub axes: [AxisFacts; AXES],
    /// Rate of a rapid along its straight line, mm/min; where not known, the axes' rates decide.
    pub rapid_rate: Option<f64>,
    /// Highest feed along the path, mm/min.
    pub max_feed: Option<f64>,
    /// Seconds of a tool change.
    pub tool_change: Option<f64>,
    /// Which function takes them.
    pub tool_change_on: ToolChangeOn,
    /// Seconds until the spindle turns at its speed.
    pub spindle_start: Option<f64>,
    /// Seconds until it stands.
    pub spindle_stop: Option<f64>,
    /// Change of the spindle's speed, rev/min per second, where the time depends on the speed.
    pub spindle_acceleration: Option<f64>,
    /// Highest speed, rev/min.
    pub spindle_max: Option<f64>,
    /// How far the path may leave a corner, mm; 0 is an exact stop in every corner. A length that the program
    /// states wins over it.
    pub path_tolerance: Option<f64>,
    /// Whether every move ends in a stop, in a straight line too: a control in exact-stop mode. A path mode that the
    /// program states wins over it.
    pub exact_stop: Option<bool>,
    /// Blocks with a move that the control knows beyond the one that it carries out; `None` and
    /// [`WHOLE_PATH`](crate::WHOLE_PATH) are the whole path.
    pub look_ahead: Option<u32>,
    /// Seconds that an M function takes besides what it does.
    pub m_function: Option<f64>,
    /// Functions of the machine's own by name, with the seconds that each takes.
    pub functions: Vec<(String, f64)>,
    /// Least seconds of a block with a move: what the control needs to prepare the next one.
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

/// Which function takes the time of a tool change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToolChangeOn {
    /// `CHANGE_TOOL`.
    #[default]
    Change,
    /// `SELECT_TOOL`, as in the case study's table.
    Select,
}

impl Machine {
    /// Seconds of a function of the machine's own, if they are stated.
    pub(crate) fn function(&self, name: &str) -> Option<f64> {
        self.functions.iter().find(|(function, _)| function == name).map(|(_, seconds)| *seconds)
    }
}
