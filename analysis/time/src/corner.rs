//! How the corner at the end of a move is taken: the path mode that the program has active wins over the
//! machine's own.
//!
//! The mode of a move counts for the corner at its end: so controls queue their moves (LinuxCNC's planner keeps
//! it with each segment), and so a block with G09 or G9 stops at its own end alone.

use ncc_exec::{Event, Kind};
use ncc_ir::canon::PathMode;

use crate::machine::Machine;

/// Tenths of a micrometre in a millimetre: what lengths of a state count.
const TENTHS: f64 = 1e4;

/// How a corner is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corner {
    /// Whether the axes stand still at it, in a straight line too.
    pub(crate) stop: bool,
    /// How far the path may leave it, mm; 0 goes through it.
    pub(crate) tolerance: f64,
    /// How far before it and after it the path may begin to leave it, mm.
    pub(crate) distance: f64,
}

impl Corner {
    const STOP: Corner = Corner { stop: true, tolerance: 0.0, distance: 0.0 };

    /// Rounded within a tolerance, mm.
    fn within(tolerance: f64) -> Corner {
        Corner { stop: false, tolerance, distance: f64::INFINITY }
    }
}

/// What a machine does with corners of which the program says nothing, or not how far it rounds them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corners {
    exact_stop: bool,
    tolerance: f64,
}

impl Corners {
    pub(crate) fn new(machine: &Machine) -> Corners {
        Corners {
            exact_stop: machine.exact_stop.unwrap_or(false),
            tolerance: machine.path_tolerance.unwrap_or(0.0),
        }
    }

    /// The corner at the end of a move.
    #[inline]
    pub(crate) fn of(&self, event: &Event) -> Corner {
        let Some(mode) = event.state.path else {
            return Corner { stop: self.exact_stop, ..Corner::within(self.tolerance) };
        };
        let rapid = matches!(event.kind, Kind::Traverse);
        let stated = f64::from(event.state.within[usize::from(rapid)]) / TENTHS;
        match mode {
            PathMode::ExactStop => Corner::STOP,
            PathMode::ExactPath => Corner::within(0.0),
            PathMode::Distance => Corner { stop: false, tolerance: f64::INFINITY, distance: stated },
            // Without a length of their own, they round as far as the machine does.
            PathMode::Tolerance
            | PathMode::AxisTolerances
            | PathMode::WithinBlocks
            | PathMode::Dynamics
            | PathMode::Tangential
                if stated > 0.0 =>
            {
                Corner::within(stated)
            }
            PathMode::Continuous
            | PathMode::SlowCorners
            | PathMode::Tapping
            | PathMode::Tolerance
            | PathMode::AxisTolerances
            | PathMode::WithinBlocks
            | PathMode::Dynamics
            | PathMode::Tangential => Corner::within(self.tolerance),
        }
    }
}
