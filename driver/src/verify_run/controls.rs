//! What a control of a dialect always has: its state at power-on, what its numbers resolve, how it says alarms.

use ncc_dialects::{BREAK_LIFT, Dialect, PECK_CLEARANCE, Quantity, Settings};
use ncc_exec::Exec;
use ncc_exec::verify::Resolution;
use ncc_ir::alarms::Alarms;
use ncc_ir::canon::Modes;
use ncc_ir::computed::computes::ComputeFeature;

use crate::job::Job;
use crate::job::parameters::{bore_shift, orientation, parameter};

/// Facts that hold at power-on of every such control.
pub fn fixed(dialect: &Dialect) -> Modes {
    let p = &dialect.power_on;
    Modes {
        motion: p.motion.as_ref().filter(|f| f.always).map(|f| f.value.into()),
        distance: p.distance.as_ref().filter(|f| f.always).map(|f| f.value.into()),
        units: p.units.as_ref().filter(|f| f.always).map(|f| f.value.into()),
        plane: p.plane.as_ref().filter(|f| f.always).map(|f| f.value.into()),
        feed_mode: p.feed_mode.as_ref().filter(|f| f.always).map(|f| f.value.into()),
        return_level: p.return_level.as_ref().filter(|f| f.always).map(|f| f.value.into()),
        work_offset: p.work_offset.as_ref().filter(|f| f.always).map(|f| f.value),
        length_offset: p.length_offset.as_ref().filter(|f| f.always).map(|f| f.value),
        no_origin_shift: p.no_origin_shift.as_ref().filter(|f| f.always).map(|f| f.value),
    }
}

/// How a control says alarms.
pub fn alarms_of(settings: &Settings) -> Option<Alarms> {
    settings.caps().flow.computes.and_then(|computes| computes.alarms.clone())
}

/// Whether a control writes to devices.
pub fn writes(settings: &Settings) -> bool {
    settings.dialect.can.everything
        || settings.caps().flow.computes.is_some_and(|computes| computes.has(ComputeFeature::Output))
}

/// What a dialect's numbers resolve.
pub fn resolution(settings: &Settings) -> Resolution {
    let numbers = |q| settings.dialect.numbers(q);
    let (length, feed) = (numbers(Quantity::Length), numbers(Quantity::Feed));
    Resolution {
        mm: length.decimals,
        inch: length.decimals_inch.unwrap_or(length.decimals),
        degree: numbers(Quantity::Angle).decimals,
        feed: feed.decimals,
        feed_inch: feed.decimals_inch.unwrap_or(feed.decimals),
        second: numbers(Quantity::Seconds).decimals.max(3),
        speed: numbers(Quantity::Speed).decimals,
    }
}

/// Takes the source control's parameters of cycles for granted of a control.
pub fn with_parameters(exec: &mut Exec, job: &Job) {
    let value = |option| parameter(job, option).and_then(|value| value.nanos(false));
    if let Some(clearance) = value(PECK_CLEARANCE) {
        exec.set_peck_clearance(clearance);
    }
    if let Some(lift) = value(BREAK_LIFT) {
        exec.set_break_lift(lift);
    }
    if let Some(direction) = bore_shift(job) {
        exec.set_bore_shift(direction);
    }
    if let Some(angle) = orientation(job).and_then(|angle| angle.nanos(false)) {
        exec.set_orientation(angle);
    }
}
