//! What is assumed of a machine that does not state it.
//!
//! Each model names what it needs; here is the value that it works with where the machine is silent,
//! and the list of such values, which the caller tells the user. Nothing is reported here.
//!
//! The values of axes are those of a worked example in a control maker's technical manual: 30 m/min,
//! a jerk of 35 m/s³ while cutting, and the acceleration of 3.4 m/s² that follows (HEIDENHAIN, iTNC 530
//! HSCI Technical Manual, July 2013, page 813). Those of rotary axes are working values without a
//! source. A corner may be left by 0.01 mm, which is the factory setting of a public control (grbl 1.1,
//! setting `$11`). A time that nobody has stated is not counted: 0.

use ncc_ir::canon::Axis;

use crate::machine::Machine;
use crate::model::Model;

/// A fact that a model needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fact {
    /// Rate of an axis in rapids, mm/min or degrees a minute; without an axis, along the line, mm/min.
    RapidRate,
    /// Acceleration of an axis, mm/s² or degrees/s².
    Acceleration,
    /// Jerk of an axis, mm/s³ or degrees/s³.
    Jerk,
    /// How far the path may leave a corner, mm.
    PathTolerance,
    /// Whether every move ends in a stop: 1 or 0.
    ExactStop,
    /// Seconds of a tool change.
    ToolChange,
    /// Seconds of a start of the spindle.
    SpindleStart,
    /// Seconds of its stop.
    SpindleStop,
    /// Seconds of an M function.
    MFunction,
    /// Least seconds of a block with a move.
    Block,
    /// Blocks that the control knows beyond the one that it carries out; [`WHOLE_PATH`] are all.
    LookAhead,
}

impl Fact {
    /// Its name, by which its words are found.
    pub const fn name(self) -> &'static str {
        match self {
            Fact::RapidRate => "rapid-rate",
            Fact::Acceleration => "acceleration",
            Fact::Jerk => "jerk",
            Fact::PathTolerance => "path-tolerance",
            Fact::ExactStop => "exact-stop",
            Fact::ToolChange => "tool-change",
            Fact::SpindleStart => "spindle-start",
            Fact::SpindleStop => "spindle-stop",
            Fact::MFunction => "m-function",
            Fact::Block => "block",
            Fact::LookAhead => "look-ahead",
        }
    }

    /// Its unit; empty for a yes or no.
    pub const fn unit(self, axis: Option<Axis>) -> &'static str {
        let turns = match axis {
            Some(axis) => axis.is_rotary(),
            None => false,
        };
        match (self, turns) {
            (Fact::RapidRate, false) => "mm/min",
            (Fact::RapidRate, true) => "°/min",
            (Fact::Acceleration, false) => "mm/s²",
            (Fact::Acceleration, true) => "°/s²",
            (Fact::Jerk, false) => "mm/s³",
            (Fact::Jerk, true) => "°/s³",
            (Fact::PathTolerance, _) => "mm",
            (Fact::ExactStop, _) => "",
            (Fact::LookAhead, _) => "blocks",
            (
                Fact::ToolChange | Fact::SpindleStart | Fact::SpindleStop | Fact::MFunction | Fact::Block,
                _,
            ) => "s",
        }
    }
}

/// A value that was assumed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssumedFact {
    /// What it is.
    pub fact: Fact,
    /// The axis that it is of. One that never moves need not be reported.
    pub axis: Option<Axis>,
    /// The value, in the fact's unit.
    pub value: f64,
}

/// Values of an axis: of a linear one, of a rotary one.
const RAPID_RATE: [f64; 2] = [30_000.0, 7_200.0];
const ACCELERATION: [f64; 2] = [3_400.0, 500.0];
const JERK: [f64; 2] = [35_000.0, 5_000.0];
/// Millimetres.
const PATH_TOLERANCE: f64 = 0.01;

/// Blocks of a look-ahead over the whole path.
pub const WHOLE_PATH: u32 = u32::MAX;

/// A machine that is being completed.
struct Filling {
    assumed: Vec<AssumedFact>,
}

impl Filling {
    fn fill(&mut self, known: &mut Option<f64>, fact: Fact, axis: Option<Axis>, value: f64) {
        if known.is_none() {
            *known = Some(value);
            self.assumed.push(AssumedFact { fact, axis, value });
        }
    }
}

impl Machine {
    /// The machine with everything that a model needs, and what was filled in. A machine that is
    /// complete comes back as it is, with an empty list.
    pub fn assumed(&self, model: Model) -> (Machine, Vec<AssumedFact>) {
        let mut machine = self.clone();
        let mut filling = Filling { assumed: Vec::new() };
        match model {
            Model::Ideal => {
                let by_axes = Axis::ALL
                    .iter()
                    .any(|axis| !axis.is_rotary() && machine.axes[*axis as usize].rapid_rate.is_some());
                if !by_axes {
                    filling.fill(&mut machine.rapid_rate, Fact::RapidRate, None, RAPID_RATE[0]);
                }
                for axis in Axis::ALL {
                    let kind = usize::from(axis.is_rotary());
                    let facts = &mut machine.axes[axis as usize];
                    // The rate along the line says nothing of a rotary axis.
                    if machine.rapid_rate.is_none() || axis.is_rotary() {
                        filling.fill(&mut facts.rapid_rate, Fact::RapidRate, Some(axis), RAPID_RATE[kind]);
                    }
                }
            }
            Model::Trapezoidal | Model::JerkLimited => {
                for axis in Axis::ALL {
                    let kind = usize::from(axis.is_rotary());
                    let facts = &mut machine.axes[axis as usize];
                    // The rate along the line says nothing of a rotary axis.
                    if machine.rapid_rate.is_none() || axis.is_rotary() {
                        filling.fill(&mut facts.rapid_rate, Fact::RapidRate, Some(axis), RAPID_RATE[kind]);
                    }
                    let value = ACCELERATION[kind];
                    filling.fill(&mut facts.acceleration, Fact::Acceleration, Some(axis), value);
                    if model == Model::JerkLimited {
                        filling.fill(&mut facts.jerk, Fact::Jerk, Some(axis), JERK[kind]);
                    }
                }
                filling.fill(&mut machine.path_tolerance, Fact::PathTolerance, None, PATH_TOLERANCE);
                if machine.exact_stop.is_none() {
                    machine.exact_stop = Some(false);
                    filling.assumed.push(AssumedFact { fact: Fact::ExactStop, axis: None, value: 0.0 });
                }
                if machine.look_ahead.is_none() {
                    machine.look_ahead = Some(WHOLE_PATH);
                    let value = f64::from(WHOLE_PATH);
                    filling.assumed.push(AssumedFact { fact: Fact::LookAhead, axis: None, value });
                }
                filling.fill(&mut machine.m_function, Fact::MFunction, None, 0.0);
                filling.fill(&mut machine.block, Fact::Block, None, 0.0);
            }
        }
        filling.fill(&mut machine.tool_change, Fact::ToolChange, None, 0.0);
        if model == Model::Ideal || machine.spindle_acceleration.is_none() {
            filling.fill(&mut machine.spindle_start, Fact::SpindleStart, None, 0.0);
            filling.fill(&mut machine.spindle_stop, Fact::SpindleStop, None, 0.0);
        }
        (machine, filling.assumed)
    }
}
