//! What every finding is called: its message, the words at its places, and what to do.

use ncc_check::{Checked, Finding, LeftOn, Outside, Unchecked, What};
use ncc_ir::canon::Axis;
use ncc_ir::expr::num::Nanos;

/// The words of a finding.
pub struct Words {
    /// What is wrong, in one line.
    pub message: String,
    /// Why this place.
    pub label: String,
    /// What the related places are.
    pub related: &'static [&'static str],
    /// What to do.
    pub advice: &'static str,
}

/// A value in nanos, as a decimal without zeros at its end.
pub fn decimal(nanos: Nanos) -> String {
    let text = format!("{:.6}", nanos as f64 / 1e9);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The words of a finding.
pub fn words(finding: &Finding) -> Words {
    let more = match finding.more {
        0 => String::new(),
        1 => "; one more move too".to_owned(),
        n => format!("; {n} more moves too"),
    };
    let (message, label, related, advice): (String, String, &[&str], &str) = match &finding.what {
        What::AxisTravel { axis, side, to, limit, farthest } => {
            travel(*axis, *side, [*to, *limit, *farthest], &more)
        }
        What::FeedRange { axis, feed, limit } => {
            let whose = match axis {
                Some(axis) => format!("of {}", axis.letter() as char),
                None => "of the machine".to_owned(),
            };
            (
                format!("feed above the highest {whose}"),
                format!("{} mm/min, and the highest is {}{more}", decimal(*feed), decimal(*limit)),
                &[],
                "the control cuts with its highest feed, or stops",
            )
        }
        What::SpeedRange { speed, limit } => (
            "spindle speed above the machine's highest".to_owned(),
            format!("{} rev/min, and the highest is {}", decimal(*speed), decimal(*limit)),
            &[],
            "the spindle turns with its highest speed, or the control stops",
        ),
        What::NoFeed => (
            "move at feed without a feed".to_owned(),
            "no feed has been said before it".to_owned(),
            &[],
            "say the feed in this block or before it",
        ),
        What::SpindleStands => (
            "move at feed while the spindle stands".to_owned(),
            "nothing has started the spindle".to_owned(),
            &[],
            "start the spindle before the first cut of each tool",
        ),
        What::SpindleWithoutSpeed => (
            "move at feed while the spindle has no speed".to_owned(),
            "the spindle was started, and no speed has been said".to_owned(),
            &[],
            "say the speed before the spindle starts",
        ),
        What::NoLength { tool } => (
            format!("Z moves without the length of T{tool}"),
            "no length offset since the tool was changed".to_owned(),
            &["changed here"],
            "say the length offset of the tool before Z moves",
        ),
        What::OldLength { tool } => (
            format!("Z moves with a length that is not said for T{tool}"),
            "the length of before the change is still in force".to_owned(),
            &["changed here", "this length is in force"],
            "say the length offset of the tool before Z moves",
        ),
        What::RapidBelow { z, plane, cycle } => (
            format!("rapid below Z{}", decimal(*plane)),
            match cycle {
                true => format!("the tool goes to its retract plane, Z{}, in rapid", decimal(*z)),
                false => format!("in rapid at Z{}", decimal(*z)),
            },
            &[],
            "go below the plane at feed",
        ),
        What::BareNumber { read, with_point } => (
            "number without a decimal point among numbers with one".to_owned(),
            format!(
                "counts increments: {}, and with a point it would be {}",
                ncc_frontends::spell(*read),
                ncc_frontends::spell(*with_point)
            ),
            &[],
            "write the point; if the control counts whole units, say so: --from-option",
        ),
        What::Left(mode) => left(*mode),
        What::CallNowhere { name } => (
            format!("program {name} is not in the text"),
            "what it does was not checked".to_owned(),
            &[],
            "it must be in the control's memory when the program runs",
        ),
        What::JumpNowhere { name } => (
            format!("there is no block {name}"),
            "this jump leads nowhere".to_owned(),
            &[],
            "give a block that number or label, or correct the jump",
        ),
        What::AfterEnd => (
            "blocks after the end of the program".to_owned(),
            "never executed, nor what follows".to_owned(),
            &[],
            "remove them, or the end before them",
        ),
        What::AfterJump => (
            "blocks that are never reached".to_owned(),
            "the jump before is always made, and nothing leads here".to_owned(),
            &[],
            "remove them, or give them a number that something jumps to",
        ),
        What::NeverCalled { name } => (
            format!("subprogram {name} is never called"),
            "nothing in the text calls it".to_owned(),
            &[],
            "remove it, or call it",
        ),
    };
    Words { message, label, related, advice }
}

/// A move beyond an axis's travel: to where, beyond which limit, and the farthest of all such moves.
fn travel(
    axis: Axis,
    side: Outside,
    [to, limit, farthest]: [Nanos; 3],
    more: &str,
) -> (String, String, &'static [&'static str], &'static str) {
    let (axis, unit) = (axis.letter() as char, if axis.is_rotary() { "°" } else { " mm" });
    let beyond = match side {
        Outside::Below => "below its least",
        Outside::Above => "above its greatest",
    };
    let far = match farthest != to {
        true => format!(", the farthest to {}{unit}", decimal(farthest)),
        false => String::new(),
    };
    (
        format!("{axis} goes beyond its travel"),
        format!("machine coordinate {}{unit}, {beyond}, {}{unit}{more}{far}", decimal(to), decimal(limit)),
        &[],
        "move the work, or state the work offset and the tool's length that are really set",
    )
}

fn left(mode: LeftOn) -> (String, String, &'static [&'static str], &'static str) {
    let (message, label, advice) = match mode {
        LeftOn::Incremental => (
            "the program ends in incremental mode",
            "switched on here, and never back",
            "say absolute again before the end: the next program may find it so",
        ),
        LeftOn::Cycle => (
            "the program ends with a canned cycle in force",
            "called up here, and never cancelled",
            "cancel the cycle before the end",
        ),
        LeftOn::Frame => (
            "the program ends with a frame in force",
            "set here, and never cleared",
            "clear frames before the end",
        ),
        LeftOn::Compensation => (
            "the program ends with cutter compensation in force",
            "switched on here, and never off",
            "switch the compensation off on a way out of the work",
        ),
        LeftOn::Spindle => (
            "the spindle turns when the program ends",
            "started here, and never stopped",
            "most controls stop it at the end; say it if yours does not",
        ),
        LeftOn::Coolant => (
            "coolant is on when the program ends",
            "switched on here, and never off",
            "most controls switch it off at the end; say it if yours does not",
        ),
        LeftOn::Length => (
            "a length offset is in force when the program ends",
            "said here, and never cancelled",
            "cancel it if the next program may move Z before it says its own",
        ),
    };
    (message.to_owned(), label.to_owned(), &["the program ends here"], advice)
}

/// What was not checked, and why: a line each. `line` gives the number of a place's line.
pub fn not_checked(checked: &Checked, dialect: &str, line: &dyn Fn(u32) -> u64) -> Vec<(String, String)> {
    let mut told: Vec<(String, String)> = Vec::new();
    let mut say = |what: String, why: &str| match told.iter_mut().find(|(_, known)| known == why) {
        Some((known, _)) if !known.split(", ").any(|k| k == what) => {
            known.push_str(", ");
            known.push_str(&what);
        }
        Some(_) => {}
        None => told.push((what, why.to_owned())),
    };
    let travel = |index: u8| format!("travel of {}", Unchecked::axis(index).letter() as char);
    for unchecked in &checked.unchecked {
        match unchecked {
            Unchecked::NoMachine => {
                say("travel, feed and speed ranges".to_owned(), "no machine is named (--machine)");
            }
            Unchecked::NoPlane => say("rapids".to_owned(), "no plane is named (--rapid-plane)"),
            Unchecked::Travel(axis) => say(travel(*axis), "the profile does not state it"),
            Unchecked::Offset(number, axis) => {
                say(travel(*axis), &format!("the profile does not state the zero of work offset {number}"));
            }
            Unchecked::Length(-1) => say(travel(2), "the tool whose length is in force is not known"),
            Unchecked::Length(entry) => {
                say(travel(2), &format!("the profile does not state the length of tool {entry}"));
            }
            Unchecked::Frame(axis) => say(travel(*axis), "zero is not known after blocks that were not read"),
            Unchecked::Start(axis) => say(travel(*axis), "where it starts is not said"),
            Unchecked::Tilted(axis) => {
                say(travel(*axis), "points of the tool's tip or of a tilted plane say nothing of the axes")
            }
            Unchecked::MaxFeed => say("feeds".to_owned(), "the profile states no highest feed"),
            Unchecked::MaxSpeed => say("speeds".to_owned(), "the profile states no highest speed"),
            Unchecked::Endless => {
                say("the rest".to_owned(), "the program does not come to an end");
            }
        }
    }
    if let Some(first) = checked.first_refusal {
        let why =
            format!("blocks were not read as {dialect}, the first of them in line {}", line(first.start));
        say("what needs the state of the control, until it is said anew".to_owned(), &why);
    }
    told
}
