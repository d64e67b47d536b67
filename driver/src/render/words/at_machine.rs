//! What to check at the machine, in words: a message and a label.

use ncc_ir::behaviour::{Behaviour, Concern};
use ncc_ir::canon::{Axis, PathMode};
use ncc_ir::expr::num::Nanos;

use crate::render::numbers::{millimetres, signed};
use crate::render::spelled::next_run;
use crate::render::text::plain;

/// A fact that a parameter of `control` decides; with the value `other`, something else is done.
pub(super) fn open_behaviour(behaviour: Behaviour, other: &str, control: &str) -> (String, String) {
    let cut = match behaviour.concern() {
        Concern::AtEnd => next_run(behaviour),
        Concern::Machine | Concern::Nothing => "another cut",
    };
    (
        format!("check at the machine: {}", behaviour.about()),
        format!("{cut} where {} = {other} on {control}", behaviour.option()),
    )
}

/// Corners that the target takes in the mode `now`, and the source in the mode `before`.
pub(super) fn path_relaxed(before: &str, now: &str, to: &str) -> (String, String) {
    match PathMode::named(before) {
        Some(PathMode::SlowCorners) => (
            "the feed is not lowered at inner corners of a contour any more".into(),
            format!("{to} has no word for it, and goes round them at the whole feed"),
        ),
        Some(PathMode::Tapping) => {
            ("the feed can be held and overridden again".into(), format!("{to} has no word that forbids it"))
        }
        _ => (
            format!("corners by {} written as {}", plain(before), plain(now)),
            format!("{to} has no word for this way of taking corners"),
        ),
    }
}

/// The next run begins with an axis shifted otherwise: each control's name, and by how much it shifts the axis.
pub(super) fn next_run_shifted(axis: Axis, [source, target]: [(&str, Nanos); 2]) -> (String, String) {
    (
        "check at the machine: the next run begins in another place".into(),
        format!(
            "{} begins it with {} shifted by {}, {} by {}",
            source.0,
            char::from(axis.letter()),
            signed(source.1),
            target.0,
            signed(target.1)
        ),
    )
}

/// F on arcs of a compensated contour, which one of both controls counts along the contour.
pub(super) fn feed_on_arcs(contour_in_source: bool, [from, to]: [&str; 2]) -> (String, String) {
    (
        "check at the machine: feed on arcs under cutter compensation".into(),
        match contour_in_source {
            true => format!("F counts along the contour on {from}, at the tool centre on {to}"),
            false => format!("F counts at the tool centre on {from}, along the contour on {to}"),
        },
    )
}

/// F on both sides of a change of units.
pub(super) fn feed_at_units(before: Nanos, now: Nanos, from: &str) -> (String, String) {
    (
        match before == now {
            true => "check the feed: F was stated before the units changed".into(),
            false => "check the feed: F counts in the new unit from here on".into(),
        },
        format!("{} mm/min before, {} mm/min here on {from}", millimetres(before), millimetres(now)),
    )
}
