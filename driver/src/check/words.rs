//! Chooses the entry of `messages/` for a finding, with its values. Lists the checks that ncc could not make.
//!
//! Example: a feed move with the spindle stopped gives the form `stopped` of its message.
//! Not here: the checks themselves (`ncc_check`), and the texts.

use ncc_check::{Checked, Finding, LeftOn, Outside, StandardPitch, Unchecked, What};
use ncc_ir::expr::num::Nanos;

use crate::render::messages::message::{Message, Part};

/// A value in nanos as a decimal with at most 6 places, without trailing zeros: `1.5`.
pub fn decimal(nanos: Nanos) -> String {
    let text = format!("{:.6}", nanos as f64 / 1e9);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A pitch computed from F and S, in nanos: 3 decimal places, or 6 below 0.1. No trailing zeros.
fn pitch_of(nanos: Nanos) -> String {
    let digits = if nanos < 100_000_000 { 6 } else { 3 };
    let text = format!("{:.digits$}", nanos as f64 / 1e9);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The message of a finding: its code, its form and its values.
pub(super) fn message(finding: &Finding) -> Message {
    let m = Message::new(finding.what.rule().code()).count("more", finding.more);
    match &finding.what {
        What::AxisTravel { axis, side, to, limit, farthest } => {
            let m = if farthest == to { m } else { m.form("farthest").text("farthest", decimal(*farthest)) };
            m.text("axis", char::from(axis.letter()))
                .text("unit", if axis.is_rotary() { "°" } else { " mm" })
                .text(
                    "side",
                    match side {
                        Outside::Below => "below",
                        Outside::Above => "above",
                    },
                )
                .text("to", decimal(*to))
                .text("limit", decimal(*limit))
        }
        What::FeedRange { axis, feed, limit } => {
            let m = match axis {
                Some(axis) => m.form("axis").text("axis", char::from(axis.letter())),
                None => m,
            };
            m.text("feed", decimal(*feed)).text("limit", decimal(*limit))
        }
        What::SpeedRange { speed, limit } => m.text("speed", decimal(*speed)).text("limit", decimal(*limit)),
        What::NoFeed | What::AfterJump => m,
        What::SpindleStands if finding.related.is_empty() => m.form("check"),
        What::SpindleStands => m.form("stopped"),
        What::SpindleWithoutSpeed => m.form("speed"),
        What::NoLength { tool } => m.text("tool", tool.to_string()),
        What::OldLength { tool } => m.form("old").text("tool", tool.to_string()),
        What::RapidBelow { z, plane, cycle } => {
            let m = if *cycle { m.form("cycle") } else { m };
            m.text("z", decimal(*z)).text("plane", decimal(*plane))
        }
        What::BareNumber { read, with_point } => {
            m.text("read", ncc_frontends::spell(*read)).text("other", ncc_frontends::spell(*with_point))
        }
        What::Left(mode) => m.form(match mode {
            LeftOn::Incremental => "incremental",
            LeftOn::Cycle => "cycle",
            LeftOn::Frame => "frame",
            LeftOn::Compensation => "compensation",
            LeftOn::Spindle => "spindle",
            LeftOn::Coolant => "coolant",
            LeftOn::Length => "length",
        }),
        What::CallNowhere { name } | What::JumpNowhere { name } | What::NeverCalled { name } => {
            m.text("name", name.to_string())
        }
        What::AfterEnd => m.form("end"),
        What::ThreadPitch { pitch, nearest } => {
            let m = m.text("pitch", pitch_of(*pitch));
            match nearest {
                StandardPitch::Metric(nearest) => m.text("nearest", decimal(*nearest)),
                StandardPitch::InTwoInches(threads) => {
                    let nearest = 50.8 / f64::from(*threads);
                    m.form("inch")
                        .text("nearest", format!("{nearest:.3}"))
                        .text("threads", decimal(Nanos::from(*threads) * 500_000_000))
                }
            }
        }
    }
}

/// The checks that were left out, grouped by reason: (checks with commas between, reason). `line` gives the line number
/// of a byte offset.
pub fn not_checked(checked: &Checked, dialect: &str, line: &dyn Fn(u32) -> u64) -> Vec<(String, String)> {
    let mut told: Vec<(String, String)> = Vec::new();
    let mut tell = |what: Message, why: Message| {
        let (what, why) = (what.headline(), why.headline());
        match told.iter_mut().find(|(_, known)| *known == why) {
            Some((known, _)) if !known.split(", ").any(|k| k == what) => {
                known.push_str(", ");
                known.push_str(&what);
            }
            Some(_) => {}
            None => told.push((what, why)),
        }
    };
    let words = |form| Message::part(Part::Unchecked, form);
    let travel = |index: u8| words("travel").text("axis", char::from(Unchecked::axis(index).letter()));
    for unchecked in &checked.unchecked {
        match unchecked {
            Unchecked::NoMachine => tell(words("ranges"), words("no-machine")),
            Unchecked::NoPlane => tell(words("rapids"), words("no-plane")),
            Unchecked::Travel(axis) => tell(travel(*axis), words("not-stated")),
            Unchecked::Offset(number, axis) => {
                tell(travel(*axis), words("no-offset").text("offset", number.to_string()));
            }
            Unchecked::Length(-1) => tell(travel(2), words("tool-unknown")),
            Unchecked::Length(entry) => {
                tell(travel(2), words("no-length").text("tool", entry.to_string()));
            }
            Unchecked::Frame(axis) => tell(travel(*axis), words("frame")),
            Unchecked::Start(axis) => tell(travel(*axis), words("start")),
            Unchecked::Tilted(axis) => tell(travel(*axis), words("tilted")),
            Unchecked::MaxFeed => tell(words("feeds"), words("no-feed")),
            Unchecked::MaxSpeed => tell(words("speeds"), words("no-speed")),
            Unchecked::Endless => tell(words("rest"), words("endless")),
        }
    }
    if let Some(first) = checked.first_refusal {
        let why = words("not-read").text("dialect", dialect).text("line", line(first.start).to_string());
        tell(words("modes"), why);
    }
    told
}

#[cfg(test)]
mod tests {
    use super::*;
    use ncc_check::Rule;
    use ncc_ir::canon::Axis;
    use ncc_ir::expr::num::{Num, Unit};
    use ncc_ir::source::Span;

    /// Formatting checks by itself that an entry is there, parses, and has a value for each of its variables.
    #[test]
    fn every_finding_has_its_words() {
        let (name, nanos) = (|| "2000".into(), 1_500_000_000);
        let number = Num::int(5, Unit::Mm);
        let left = [
            LeftOn::Incremental,
            LeftOn::Cycle,
            LeftOn::Frame,
            LeftOn::Compensation,
            LeftOn::Spindle,
            LeftOn::Coolant,
            LeftOn::Length,
        ];
        let mut all = vec![
            What::AxisTravel { axis: Axis::X, side: Outside::Below, to: nanos, limit: 0, farthest: nanos },
            What::AxisTravel { axis: Axis::A, side: Outside::Above, to: nanos, limit: 0, farthest: 0 },
            What::FeedRange { axis: Some(Axis::X), feed: nanos, limit: 0 },
            What::FeedRange { axis: None, feed: nanos, limit: 0 },
            What::SpeedRange { speed: nanos, limit: 0 },
            What::NoFeed,
            What::SpindleStands,
            What::SpindleWithoutSpeed,
            What::NoLength { tool: 2 },
            What::OldLength { tool: 2 },
            What::RapidBelow { z: nanos, plane: 0, cycle: false },
            What::RapidBelow { z: nanos, plane: 0, cycle: true },
            What::BareNumber { read: number, with_point: number },
            What::CallNowhere { name: name() },
            What::JumpNowhere { name: name() },
            What::AfterEnd,
            What::AfterJump,
            What::NeverCalled { name: name() },
            What::ThreadPitch { pitch: nanos, nearest: StandardPitch::Metric(nanos) },
            What::ThreadPitch { pitch: nanos, nearest: StandardPitch::InTwoInches(23) },
        ];
        all.extend(left.map(What::Left));
        let mut codes: Vec<u16> = all.iter().map(|what| what.rule().code()).collect();
        codes.sort_unstable();
        codes.dedup();
        assert_eq!(codes, Rule::CODES, "a rule without a sample");
        for what in all {
            for (more, places) in [(0, 0), (1, 1), (5, 1)] {
                let finding = Finding {
                    what: what.clone(),
                    span: Span::default(),
                    related: vec![Span::default(); places],
                    more,
                    at_entry: false,
                };
                let message = message(&finding);
                assert!(!message.headline().is_empty() && !message.label().is_empty(), "{finding:?}");
                assert_eq!(message.helps(None).len(), 1, "{finding:?}");
                assert!(!message.label().contains('\n'), "{finding:?}");
            }
        }
    }
}
