//! Two programs executed and held side by side, under every setting of the block-skip switches.
//!
//! Both sides hand their records over in pieces (`side_by_side`). Not here: what is reported of it.

use std::io;

use ncc_diff::change::Collector;
use ncc_diff::measure::Measure;
use ncc_diff::record::Batch;
use ncc_diff::resync::{Rules, compare};
use ncc_diff::tape::Tape;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::expr::num::Nanos;

use crate::problem::BrokenOff;
use crate::review::feed::{Settings, records};
use crate::review::stream::{Course, clearances};
use crate::side::Side;
use crate::side_by_side::{self, Take};
use crate::verify_run::controls::resolution;

/// Pieces that a side may be ahead.
const AHEAD: usize = 4;
/// Levels of block skip of which every setting is tried; of more, each alone, pairs, and all.
const ALL_SETTINGS: u32 = 6;

/// What was found.
pub struct Motion {
    /// The differences.
    pub found: Collector,
    /// What became of both programs.
    pub courses: [Course; 2],
    /// Settings of the block-skip switches that were tried.
    pub settings: usize,
    /// Levels of block skip of which not every setting was tried.
    pub sampled: bool,
    /// Within how much two places are one.
    pub measure: Measure,
    /// Whether messages were left out, because one control has none.
    pub mute: bool,
}

impl Motion {
    /// Whether one of the programs could not be executed.
    pub fn refused(&self) -> bool {
        self.courses.iter().any(|course| course.refused)
    }
}

/// Compares what two programs do.
///
/// # Errors
/// Reading the sources.
pub fn motion(sides: &mut [Side; 2], tolerance: Option<Nanos>) -> io::Result<Motion> {
    let [a, b] = &*sides;
    let mut measure = Measure::of(&resolution(&a.job.from), &resolution(&b.job.from));
    if let Some(most) = tolerance {
        measure.lengths = [most; 2];
    }
    let mute = sides[0].dialect().caps.modes.messages != sides[1].dialect().caps.modes.messages;
    // What one control leaves to a parameter and its profile does not state is as on the other one.
    let own = [clearances(&sides[0].job), clearances(&sides[1].job)];
    let clearances =
        [0, 1].map(|side| std::array::from_fn(|which: usize| own[side][which].or(own[1 - side][which])));
    let mut found = Collector::default();
    let stops = sides.iter().all(|side| side.dialect().caps.shows_at_stops());
    let muted = mute.then_some(stops);
    // Side effects of a stop, a tool change or the end are the machine's: both controls are taken to do what one of them
    // does, and a program is not another one for that. Not so where Z goes for a tool change: that is not in the text.
    let own = [0, 1].map(|side: usize| sides[side].job.from.behaviours());
    let besides = [
        Behaviour::SpindleAtStop,
        Behaviour::CoolantAtStop,
        Behaviour::SpindleAtChange,
        Behaviour::CoolantAtChange,
        Behaviour::SpindleAtEnd,
        Behaviour::CoolantAtEnd,
        Behaviour::ZAtChange,
    ];
    let besides = besides.map(|behaviour| match behaviour {
        Behaviour::ZAtChange => (behaviour, 0),
        _ => (behaviour, own[0].get(behaviour).max(own[1].get(behaviour))),
    });
    let settings = |skip| {
        clearances.map(|clearances| Settings { skip, mute: muted, clearances, besides: Some(besides) })
    };
    let courses = once(sides, settings(0), measure, &mut found)?;
    let levels = courses[0].skip_levels | courses[1].skip_levels;
    let one_level = sides.iter().any(|side| side.dialect().caps.flow.skip_levels <= 1);
    let further =
        if courses.iter().any(|course| course.refused) { Vec::new() } else { further(levels, one_level) };
    let mut motion = Motion {
        found,
        courses,
        settings: 1 + further.len(),
        sampled: !one_level && levels.count_ones() > ALL_SETTINGS,
        measure,
        mute,
    };
    for skip in further {
        motion.found.again(skip);
        let courses = once(sides, settings(skip), measure, &mut motion.found)?;
        if courses.iter().any(|course| course.refused) {
            motion.courses = courses;
            break;
        }
    }
    Ok(motion)
}

/// Settings of the switches besides all off.
fn further(levels: u16, one_level: bool) -> Vec<u16> {
    if levels == 0 {
        return Vec::new();
    }
    if one_level {
        // Bit 1 is the level of a control that has one only.
        return vec![levels | 1 << 1];
    }
    let many = levels.count_ones() > ALL_SETTINGS;
    (1..=u16::MAX)
        .filter(|skip| skip & !levels == 0)
        .filter(|skip| !many || skip.count_ones() <= 2 || *skip == levels)
        .collect()
}

fn once(
    sides: &mut [Side; 2],
    settings: [Settings; 2],
    measure: Measure,
    into: &mut Collector,
) -> io::Result<[Course; 2]> {
    let [a, b] = sides;
    let first = |take: Take<Batch>| records(a, settings[0], take);
    let second = |take: Take<Batch>| records(b, settings[1], take);
    let ((), courses) = side_by_side::run(first, second, AHEAD, |[a, b]| {
        compare(Tape::new(a), Tape::new(b), Rules { measure, shifts: true }, into);
    });
    let joined =
        |course: Option<io::Result<Course>>| course.unwrap_or_else(|| Err(io::Error::other(BrokenOff::Side)));
    let [first, second] = courses;
    Ok([joined(first)?, joined(second)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_of_switches() {
        assert!(further(0, false).is_empty());
        assert_eq!(further(0b110, false), [0b10, 0b100, 0b110]);
        assert_eq!(further(0b110, true), [0b110]);
        assert_eq!(further(0b10, true), [0b10]);
        let many = further(0b1111_1110, false);
        assert_eq!(many.len(), 7 + 21 + 1);
    }
}
