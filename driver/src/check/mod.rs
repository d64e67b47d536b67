//! What is wrong with a program before it meets a machine: [`drive`] goes from the text to findings, [`told`] has them in
//! words, [`text`], [`json`] and [`sarif`] lay them out. Not here: the rules (`ncc_check`).
//!
//! ```text
//! a program, a profile    drive    findings: rule, place, data
//! ```

pub mod drive;
pub mod json;
pub mod sarif;
pub mod text;
pub mod told;
pub mod words;

use ncc_check::Limits;
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_machines::Profile;

/// The facts of a machine that rules need.
pub fn limits(profile: Option<&Profile>, rapid_plane: Option<Nanos>) -> Limits {
    let Some(profile) = profile else {
        return Limits { rapid_plane, ..Limits::default() };
    };
    let machine = profile.machine();
    let nanos = |value: f64| (value * 1e6).round() as Nanos * (ONE / 1_000_000);
    Limits {
        machine: true,
        travel: std::array::from_fn::<_, AXES, _>(|axis| machine.axes[axis].travel.map(|t| t.map(nanos))),
        max_feed: machine.max_feed.map(nanos),
        axis_feed: std::array::from_fn::<_, AXES, _>(|axis| machine.axes[axis].max_feed.map(nanos)),
        max_speed: machine.spindle_max.map(nanos),
        rapid_plane,
        tables: profile.tables(),
        no_lengths: false,
    }
}
