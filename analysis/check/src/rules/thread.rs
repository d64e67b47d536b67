//! NC0815: taps and threads whose pitch is no standard one. F of a tap is speed × pitch, so an F or S that belongs to
//! another tool makes a pitch that no tap has. Reported once for each pitch until another tool is in the spindle.

use ncc_exec::{Event, Kind};
use ncc_ir::expr::num::Nanos;

use crate::finding::{Finding, StandardPitch, What};
use crate::watched::Watched;

/// Usual pitches in micrometres: ISO 261, and ISO 1501 for the smallest.
const METRIC: [Nanos; 32] = [
    80, 90, 100, 125, 150, 175, 200, 225, 250, 300, 350, 400, 450, 500, 600, 700, 750, 800, 1000, 1250, 1500,
    1750, 2000, 2500, 3000, 3500, 4000, 4500, 5000, 5500, 6000, 8000,
];

/// Usual threads in two inches: Unified (ASME B1.1), Whitworth (BS 84), and pipe threads (ISO 228, ASME B1.20.1).
const IN_TWO_INCHES: [u8; 31] = [
    8, 9, 10, 12, 14, 16, 18, 20, 22, 23, 24, 26, 28, 32, 36, 38, 40, 48, 52, 54, 56, 64, 72, 80, 88, 96,
    112, 128, 144, 160, 200,
];

/// Rare ones, which are standard as well but help nobody who looks for the right pitch: BA threads (BS 93), and 22 and 3½
/// threads per inch (BS 84).
const RARE: [StandardPitch; 11] = [
    StandardPitch::Metric(900_000_000),
    StandardPitch::Metric(810_000_000),
    StandardPitch::Metric(730_000_000),
    StandardPitch::Metric(660_000_000),
    StandardPitch::Metric(590_000_000),
    StandardPitch::Metric(530_000_000),
    StandardPitch::Metric(480_000_000),
    StandardPitch::Metric(430_000_000),
    StandardPitch::Metric(390_000_000),
    StandardPitch::InTwoInches(44),
    StandardPitch::InTwoInches(7),
];

/// How far a pitch may be from a standard one, in thousandths of it: F has few digits.
const ROUNDED: Nanos = 10;
/// How far below it a tap in a compensating chuck may be fed, in thousandths: often on purpose, so that the chuck pulls.
const PULLED: Nanos = 60;

/// A spindle-synchronised move. Such moves are few, and plain ones must not pay for them.
#[cold]
pub(crate) fn cut(checker: &mut Watched, event: &Event) {
    let Kind::Synchronised { pitch, chuck } = event.kind else { return };
    // NC0804 is reported, and the pitch follows from a made-up feed.
    if checker.feed.made_up {
        return;
    }
    let pitch = pitch.abs();
    if pitch == 0 || usual().chain(RARE).any(|standard| fits(pitch, millimetres(standard), chuck)) {
        return;
    }
    let met = &mut checker.thread;
    if let Some(place) = met.reported.iter().position(|(known, ..)| *known == pitch) {
        let (_, last, index) = &mut met.reported[place];
        // Into a hole and out of it the tap goes along one axis; to the next hole it goes along others too.
        let along = std::mem::replace(last, event.end).iter().zip(&event.end).filter(|(a, b)| a != b).count();
        if let Some(finding) = checker.findings.get_mut(*index).filter(|_| along > 1) {
            finding.more += 1;
        }
        return;
    }
    let apart = |standard: &StandardPitch| {
        let own = millimetres(*standard);
        (own.max(pitch) as f64 / own.min(pitch) as f64 * 1e9) as Nanos
    };
    let Some(nearest) = usual().min_by_key(apart) else { return };
    if let Some(index) = checker.findings.add(Finding::new(What::ThreadPitch { pitch, nearest }, event.span))
    {
        checker.thread.reported.push((pitch, event.end, index));
    }
}

/// Another tool is in the spindle.
pub(crate) fn changed(checker: &mut Watched) {
    checker.thread.reported.clear();
}

fn usual() -> impl Iterator<Item = StandardPitch> {
    let metric = METRIC.into_iter().map(|micrometres| StandardPitch::Metric(micrometres * 1_000_000));
    let inch = IN_TWO_INCHES.into_iter().map(StandardPitch::InTwoInches);
    metric.chain(inch)
}

/// A standard pitch, in nanos of a millimetre.
fn millimetres(standard: StandardPitch) -> Nanos {
    match standard {
        StandardPitch::Metric(pitch) => pitch,
        StandardPitch::InTwoInches(threads) => 50_800_000_000 / Nanos::from(threads),
    }
}

fn fits(pitch: Nanos, standard: Nanos, chuck: bool) -> bool {
    let below = if chuck { PULLED } else { ROUNDED };
    pitch * 1000 >= standard * (1000 - below) && pitch * 1000 <= standard * (1000 + ROUNDED)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn standard(pitch: Nanos, chuck: bool) -> bool {
        usual().chain(RARE).any(|standard| fits(pitch, millimetres(standard), chuck))
    }

    /// M8 is 1.25, 1/4-20 UNC is 1.27, G1/4 is 1.337, M8 fed slowly in a chuck is 1.19: no thread lies between 1.27 and 1.337. 4BA is 0.66.
    #[test]
    fn standard_pitches_and_none() {
        assert!(standard(1_250_000_000, false) && standard(1_270_000_000, false));
        assert!(standard(1_337_000_000, false) && !standard(1_300_000_000, false));
        assert!(standard(1_190_000_000, true) && !standard(1_190_000_000, false));
        assert!(standard(8_000_000_000, false), "the greatest of ISO 261");
        assert!(standard(660_000_000, false) && !standard(620_000_000, false));
    }
}
