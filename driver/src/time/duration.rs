//! Formats durations and numbers for reports: 131.525 s is `0:02:11.525`.

/// Seconds as `h:mm:ss.mmm`, rounded to milliseconds. Hours have no limit; negative times give 0.
pub fn hms(seconds: f64) -> String {
    let millis = (seconds.max(0.0) * 1000.0).round() as u64;
    let (whole, part) = (millis / 1000, millis % 1000);
    format!("{}:{:02}:{:02}.{part:03}", whole / 3600, whole / 60 % 60, whole % 60)
}

/// A number rounded to at most `digits` decimals, without trailing zeros: 0.5 is `0.5`.
pub fn short(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations() {
        for (seconds, text) in [
            (0.0, "0:00:00.000"),
            (59.9996, "0:01:00.000"),
            (131.525013, "0:02:11.525"),
            (360_000.0, "100:00:00.000"),
            (-1.0, "0:00:00.000"),
        ] {
            assert_eq!(hms(seconds), text);
        }
    }

    #[test]
    fn numbers() {
        for (value, text) in [(15_000.0, "15000"), (0.5, "0.5"), (-0.0001, "0"), (12.3456, "12.346")] {
            assert_eq!(short(value, 3), text);
        }
    }
}
