//! Laws of what is left out: nothing that a picture would show.

use ncc_plot::{Course, Leg, MOST, Series, Stroke, Way, distance, simplify};
use proptest::prelude::*;

use crate::made::Made;

/// Least and greatest value of a curve in a stretch of time, from all its points.
fn truth(points: &[(f64, f64)], course: Course, from: f64, to: f64) -> Option<(f64, f64)> {
    let mut found: Option<(f64, f64)> = None;
    let mut see = |v: f64| found = Some(found.map_or((v, v), |(a, b)| (a.min(v), b.max(v))));
    let first = points.partition_point(|point| point.0 < from).saturating_sub(1);
    for pair in points[first..].windows(2).take_while(|pair| pair[0].0 < to) {
        let ((t0, v0), (t1, v1)) = (pair[0], pair[1]);
        let (left, right) = (t0.max(from), t1.min(to));
        match course {
            Course::Step if left < right => see(v0),
            Course::Line if left < right => {
                for t in [left, right] {
                    see(v0 + (v1 - v0) * (t - t0) / (t1 - t0));
                }
            }
            Course::Line if t0 == t1 && from <= t0 && t0 < to => {
                see(v0);
                see(v1);
            }
            Course::Step | Course::Line => {}
        }
    }
    found
}

fn points() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let step = prop_oneof![3 => 0.0..0.01f64, 1 => Just(0.0), 1 => 0.0..20.0f64];
    prop::collection::vec((step, -100.0..100.0f64), 4200..9000).prop_map(|steps| {
        let mut now = 3.0;
        steps
            .into_iter()
            .map(|(step, value)| {
                now += step;
                (now, value)
            })
            .collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Each bin has the least and the greatest value of its time.
    #[test]
    fn bins_keep_least_and_greatest(points in points(), step in any::<bool>()) {
        let course = if step { Course::Step } else { Course::Line };
        let mut series = Series::new(course);
        for (time, value) in &points {
            series.push(*time, *value);
        }
        let (width, bins) = series.bins();
        prop_assert!(!bins.is_empty() && bins.len() <= 2048);
        let zero = points[0].0;
        let end = points[points.len() - 1].0;
        for (i, bin) in bins.iter().enumerate() {
            // What lies within a hair of an edge may be in either of two bins.
            let hair = width * 1e-6;
            let (from, to) = (zero + i as f64 * width, zero + (i + 1) as f64 * width);
            if to > end {
                continue;
            }
            if let Some((min, max)) = truth(&points, course, from + hair, to - hair) {
                prop_assert!(bin.min <= min + 1e-9 && bin.max >= max - 1e-9, "{i}: {bin:?} {min} {max}");
            }
            if let Some((min, max)) = truth(&points, course, from - hair, to + hair) {
                prop_assert!(bin.min >= min - 1e-9 && bin.max <= max + 1e-9, "{i}: {bin:?} {min} {max}");
            }
        }
        let line = series.polyline(end);
        let drawn = line.iter().fold((f64::MAX, f64::MIN), |a, p| (a.0.min(p.1), a.1.max(p.1)));
        let all = bins.iter().fold((f64::MAX, f64::MIN), |a, b| (a.0.min(b.min), a.1.max(b.max)));
        prop_assert!(drawn.0 <= all.0 && drawn.1 >= all.1);
        prop_assert!(line.windows(2).all(|pair| pair[0].0 <= pair[1].0 + 1e-9));
    }

    /// A curve of few points is kept as it is.
    #[test]
    fn few_points_are_kept(values in prop::collection::vec(-5.0..5.0f64, 1..200)) {
        let mut series = Series::new(Course::Line);
        for (i, value) in values.iter().enumerate() {
            series.push(i as f64, *value);
        }
        let line = series.polyline(values.len() as f64 - 1.0);
        for (i, value) in values.iter().enumerate() {
            prop_assert!(line.contains(&(i as f64, *value)));
        }
    }

    /// No point of the way is farther from what one line replaces it by than is allowed.
    #[test]
    fn a_simplified_way_is_near(
        steps in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64, -0.2..0.2f64, 0..12u8), 2..3000),
        off in 0.01..3.0f64,
    ) {
        let mut at = [0.0; 3];
        let mut stroke = Stroke::Feed;
        let legs: Vec<Leg> = steps.iter().enumerate().map(|(i, (x, y, z, turn))| {
            at = [at[0] + x, at[1] + y, at[2] + z];
            stroke = match turn {
                0 => Stroke::Rapid,
                1 => Stroke::Arc,
                2 => Stroke::Still,
                _ => stroke,
            };
            Leg { stroke, to: at, end: i as f64, lines: [i as u32, i as u32] }
        }).collect();
        let short = simplify(Some([0.0; 3]), &legs, 0, off);
        // In order; every leg is replaced by the first that ends no earlier.
        let mut from = [0.0; 3];
        let mut rest = legs.as_slice();
        for leg in &short {
            let count = rest.iter().take_while(|one| one.end <= leg.end).count();
            let (these, after) = rest.split_at(count);
            prop_assert!(!these.is_empty() && these.iter().all(|one| one.stroke == leg.stroke));
            prop_assert_eq!(leg.lines, [these[0].lines[0], these[count - 1].lines[1]]);
            prop_assert_eq!(leg.to, these[count - 1].to);
            if leg.stroke != Stroke::Still {
                for one in these {
                    prop_assert!(distance(one.to, from, leg.to) <= off + 1e-9);
                }
            }
            from = leg.to;
            rest = after;
        }
        prop_assert!(rest.is_empty());
    }
}

/// A long way stays small, and no point of it is farther from a line of its kind than it says.
#[test]
fn a_long_way_is_true_to_a_pixel() {
    let mut way = Way::default();
    way.stand([0.0; 3], 0.0, 1);
    let mut full = Vec::new();
    for i in 0..400_000u32 {
        // Rows of a surface, in short moves.
        let (row, along) = (i / 2000, i % 2000);
        let x = if row % 2 == 0 { along } else { 1999 - along };
        let (x, y) = (f64::from(x) * 0.1, f64::from(row));
        let to = [x, y, 10.0 * (x / 30.0).sin() * (y / 40.0).cos()];
        full.push(to);
        way.add(Leg { stroke: Stroke::Feed, to, end: f64::from(i), lines: [i, i] });
    }
    way.finish();
    assert!(way.legs.len() <= MOST / 4 * 3, "{}", way.legs.len());
    let pixel = 200.0 / 1000.0;
    assert!(way.off > 0.0 && way.off <= pixel, "{}", way.off);
    let mut from = way.start.unwrap();
    let mut rest = full.iter().enumerate();
    let mut worst = 0.0f64;
    for leg in &way.legs {
        for (i, point) in rest.by_ref() {
            worst = worst.max(distance(*point, from, leg.to));
            if i as f64 == leg.end {
                break;
            }
        }
        from = leg.to;
    }
    assert!(worst <= way.off, "{worst} > {}", way.off);
    assert_eq!(way.legs.last().map(|leg| leg.to), full.last().copied());
}

/// Moves to and fro over the same places, with stops between them, cannot fill the memory.
#[test]
fn what_cannot_be_simplified_is_hidden() {
    let mut made = Made::new();
    for i in 0..40_000u32 {
        let to = [f64::from(i * 919 % 997), f64::from(i * 729 % 1009), 0.0];
        if i % 2 == 0 {
            made.rapid(to, 0.01)
        } else {
            made.feed(to, 0.1)
        }
        made.dwell(0.5);
        made.tool(i64::from(i % 90), 0.001);
    }
    let record = made.finish();
    assert!(record.way.legs.len() <= MOST / 4 * 3);
    assert!(record.way.off < 20.0, "{}", record.way.off);
    assert!(record.tools.len() < 9000);
    assert!(record.stamps.times.len() <= 4096);
    assert!((record.end - 40_000.0 * 0.556).abs() < 1.0);
}

/// Many holes are drawn as far as they lie apart, and counted all.
#[test]
fn many_holes_are_thinned() {
    let mut made = Made::new();
    for i in 0..45_000u32 {
        made.hole([f64::from(i % 300) * 0.01, f64::from(i / 300) * 0.01], 2.9);
    }
    let record = made.finish();
    assert_eq!(record.sums.holes, 45_000);
    assert!(record.holes.len() < 40_000);
}
