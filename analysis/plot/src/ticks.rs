//! Where an axis has its marks, and what they say.

/// Marks of a length or a number between two values, at most so many (one more where both values are
/// marks): steps of 1, 2 or 5 times a power of ten. One mark alone says nothing about how long an axis
/// is: there, steps are made smaller until there are two. Gives the marks and their step.
pub(crate) fn marks(low: f64, high: f64, most: usize) -> (Vec<f64>, f64) {
    let rough = ((high - low) / most.max(1) as f64).max(1e-9);
    let power = 10f64.powf(rough.log10().floor());
    let first = [1.0, 2.0, 5.0].into_iter().position(|n| n * power >= rough * (1.0 - 1e-9));
    // Places in the row 1, 2, 5, 10, 20, …
    let step = |place: i32| [1.0, 2.0, 5.0][place.rem_euclid(3) as usize] * 10f64.powi(place.div_euclid(3));
    let coarse = power.log10().round() as i32 * 3 + first.map_or(3, |at| at as i32);
    let shown = |place: i32| (multiples(low, high, step(place)), step(place));
    // The third is at most half as long as the axis, so that two of its multiples lie on it.
    let finer = (0..3).map(|by| shown(coarse - by)).find(|(marks, _)| marks.len() > 1);
    finer.filter(|_| high > low).unwrap_or_else(|| shown(coarse))
}

/// Marks of a time, seconds: steps that a clock knows. Gives the marks and their step.
pub(crate) fn clock_marks(low: f64, high: f64, most: usize) -> (Vec<f64>, f64) {
    const STEPS: [f64; 16] = [
        10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 900.0, 1800.0, 3600.0, 7200.0, 10800.0, 21600.0,
        43200.0, 86400.0, 172_800.0,
    ];
    let rough = (high - low) / most.max(1) as f64;
    if rough <= 5.0 {
        return marks(low, high, most);
    }
    match STEPS.into_iter().find(|step| *step >= rough) {
        Some(step) => (multiples(low, high, step), step),
        None => marks(low, high, most),
    }
}

/// Marks of an axis of powers of ten, for values above 0: 1, 2 and 5 times each power, as many as fit.
pub(crate) fn power_marks(low: f64, high: f64, most: usize) -> Vec<f64> {
    for digits in [&[1.0, 2.0, 5.0][..], &[1.0, 3.0], &[1.0]] {
        let powers = (low.log10().floor() as i32)..=(high.log10().ceil() as i32);
        let all = powers.flat_map(|power| digits.iter().map(move |digit| digit * 10f64.powi(power)));
        let marks: Vec<f64> =
            all.filter(|mark| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(mark)).collect();
        if marks.len() <= most {
            return marks;
        }
    }
    Vec::new()
}

fn multiples(low: f64, high: f64, step: f64) -> Vec<f64> {
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    (first..=last.min(first + 1000)).map(|n| n as f64 * step).collect()
}

/// A number with the digits that a step needs; thousands set apart by narrow spaces.
pub(crate) fn number(value: f64, step: f64) -> String {
    let digits = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{:.digits$}", value.abs());
    let (whole, fraction) = text.split_at(text.find('.').unwrap_or(text.len()));
    let mut out = String::new();
    if value < 0.0 && text.bytes().any(|b| (b'1'..=b'9').contains(&b)) {
        out.push('\u{2212}');
    }
    for (i, digit) in whole.chars().enumerate() {
        // Four digits are read at a glance.
        if i > 0 && whole.len() > 4 && (whole.len() - i).is_multiple_of(3) {
            out.push('\u{202f}');
        }
        out.push(digit);
    }
    out.push_str(fraction);
    out
}

/// Whether a program of so many seconds is reported in seconds alone.
pub(crate) fn in_seconds(long: f64) -> bool {
    long < 180.0
}

/// A time at a mark: seconds, or h:mm:ss where the program is long.
pub(crate) fn clock(seconds: f64, step: f64, long: f64) -> String {
    if in_seconds(long) {
        return number(seconds, step);
    }
    let whole = seconds.max(0.0);
    let tenths = if step < 1.0 { 1 } else { 0 };
    let unit = 10f64.powi(tenths);
    let all = (whole * unit).round() as u64;
    let (whole, part) = (all / unit as u64, all % unit as u64);
    let text = format!("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    if tenths > 0 { format!("{text}.{part}") } else { text }
}

/// A duration for a caption: 131.525 s, or h:mm:ss.
pub(crate) fn duration(seconds: f64) -> String {
    if in_seconds(seconds) { format!("{seconds:.3} s") } else { clock(seconds.round(), 1.0, seconds) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round_and_few() {
        assert_eq!(marks(-108.0, 108.0, 6).0, [-100.0, -50.0, 0.0, 50.0, 100.0]);
        assert_eq!(marks(0.0, 0.3, 4).0.len(), 4);
        assert_eq!(clock_marks(0.0, 131.5, 10), ((0..9).map(|n| n as f64 * 15.0).collect(), 15.0));
        assert_eq!(clock_marks(0.0, 7300.0, 10).1, 900.0);
        assert_eq!(power_marks(150.0, 15000.0, 8), [200.0, 500.0, 1000.0, 2000.0, 5000.0, 10000.0]);
        assert_eq!(marks(-2.3, 4.5, 3), (vec![-2.0, 0.0, 2.0, 4.0], 2.0));
        for low in [-7.3, -2.3, -0.4, 0.6, 11.0] {
            for long in [0.011, 0.3, 1.0, 6.8, 95.0] {
                for most in 1..9 {
                    let (all, step) = marks(low, low + long, most);
                    assert!(
                        (2..=(most + 1).max(5)).contains(&all.len()),
                        "{low} {long} {most}: {all:?} {step}"
                    );
                }
            }
        }
        for most in 1..20 {
            for high in [1e-6, 0.3, 7.0, 99.9, 1e6] {
                assert!(marks(0.0, high, most).0.len() <= most + 1, "{high} {most}");
                assert!(clock_marks(0.0, high, most).0.len() <= most + 1, "{high} {most}");
            }
        }
    }

    #[test]
    fn numbers_and_times_are_readable() {
        assert_eq!(number(-12.5, 0.5), "\u{2212}12.5");
        assert_eq!(number(-0.0, 1.0), "0");
        assert_eq!(number(15000.0, 5000.0), "15\u{202f}000");
        assert_eq!(number(1500.0, 500.0), "1500");
        assert_eq!(clock(15.0, 15.0, 131.5), "15");
        assert_eq!(clock(3723.0, 60.0, 7300.0), "1:02:03");
        assert_eq!(duration(131.52501), "131.525 s");
        assert_eq!(duration(7299.7), "2:01:40");
    }
}
