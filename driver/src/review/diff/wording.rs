//! A difference in words, and all of them in one line: `messages/difference`.
//!
//! ```text
//! feed 300 → 250 on 12 moves of T3        the title of a group
//! same path; feed 300 → 250 on 12 moves   the summary
//! ```
//!
//! Not here: which blocks are shown (`tell`).

use std::collections::BTreeMap;

use ncc_diff::change::{Change, Group};
use ncc_diff::record::What;
use ncc_ir::canon::{AXES, Axis, SpindleMode};
use ncc_ir::expr::num::{Nanos, ONE};

use super::account::{Block, Difference};
use crate::render::events::compensation;
use crate::render::messages::message::{Message, Part};
use crate::review::words::{coolant, length, number, rounded, spindle};

/// Things that a summary names.
const SUMMARY: usize = 12;

/// Kinds of differences by their stable names, in the order in which a summary names them.
const KINDS: [&str; 18] = [
    "shift",
    "moved",
    "gap",
    "arc",
    "kind",
    "work-offset",
    "length",
    "frame",
    "tool",
    "feed",
    "speed",
    "speed-limit",
    "spindle",
    "coolant",
    "compensation",
    "orientation",
    "dwell",
    "text",
];

/// An entry about differences.
pub(crate) fn entry(form: &'static str) -> Message {
    Message::part(Part::Difference, form)
}

/// The stable name of a kind of change, which is that of its entry too.
pub(super) fn kind(change: &Change) -> &'static str {
    match change {
        Change::Feed(..) => "feed",
        Change::Speed(..) => "speed",
        Change::SpeedLimit(..) => "speed-limit",
        Change::Spindle(..) => "spindle",
        Change::Tool(..) => "tool",
        Change::Coolant(..) => "coolant",
        Change::Compensation(..) => "compensation",
        Change::WorkOffset(..) => "work-offset",
        Change::Length(..) => "length",
        Change::Frame => "frame",
        Change::Moved(_) => "moved",
        Change::Arc => "arc",
        Change::Kind(..) => "kind",
        Change::Orient(..) => "orientation",
        Change::Dwell(..) => "dwell",
        Change::Text => "text",
        Change::Gap => "gap",
        Change::Shift(_) => "shift",
    }
}

/// Before and after.
pub(super) fn values(change: &Change) -> Option<[String; 2]> {
    Some(match change {
        Change::Feed(a, b) => [rounded(*a, 3), rounded(*b, 3)],
        Change::Speed((a, x), (b, y)) if x == y => [number(*a), number(*b)],
        Change::Speed(a, b) => [*a, *b].map(|(speed, mode)| speed_in_mode(speed, mode)),
        Change::SpeedLimit(a, b) => [*a, *b].map(limit),
        Change::Dwell(a, b) | Change::Orient(a, b) => [number(*a), number(*b)],
        Change::Spindle(a, b) => [*a, *b].map(|s| spindle(s).to_owned()),
        Change::Tool(a, b) => [*a, *b].map(tool_name),
        Change::Coolant(a, b) => [*a, *b].map(coolant),
        Change::Compensation(a, b) => [a, b].map(compensation),
        Change::WorkOffset(a, b) => [a.to_string(), b.to_string()],
        Change::Length(a, b) => [length(a), length(b)],
        Change::Kind(a, b) => [*a, *b].map(|what| entry(name(what)).headline()),
        Change::Frame | Change::Moved(_) | Change::Arc | Change::Text | Change::Gap | Change::Shift(_) => {
            return None;
        }
    })
}

fn tool_name(tool: i64) -> String {
    if tool < 0 { entry("first-tool").headline() } else { format!("T{tool}") }
}

fn speed_in_mode(speed: Nanos, mode: SpindleMode) -> String {
    let form = match mode {
        SpindleMode::Turns => "turns",
        SpindleMode::Surface => "surface",
    };
    entry(form).text("speed", number(speed)).headline()
}

/// A limit of the spindle's speed, in thousandths of a rev/min.
fn limit(limit: Option<u32>) -> String {
    match limit {
        Some(limit) => speed_in_mode(Nanos::from(limit) * (ONE / 1000), SpindleMode::Turns),
        None => entry("none").headline(),
    }
}

/// The entry that names a kind of event.
fn name(what: What) -> &'static str {
    match what {
        What::Traverse => "move-rapid",
        What::Feed => "move-feed",
        What::Thread => "move-thread",
        What::Orient => "move-orient",
        What::Arc => "move-arc",
        What::Dwell => "move-dwell",
        What::ToolChange => "move-tool-change",
        What::Function => "move-function",
        What::Stop => "move-stop",
        What::OptionalStop => "move-optional-stop",
        What::End => "move-end",
        What::BeginAgain => "move-begin-again",
        What::TextEnd => "move-text-end",
        What::Message => "move-message",
        What::Alarm => "move-alarm",
    }
}

/// `X+0.02 Y-1`.
fn vector(by: &[Nanos; AXES]) -> String {
    let words: Vec<String> = Axis::ALL
        .into_iter()
        .filter(|axis| by[*axis as usize] != 0)
        .map(|axis| {
            let value = number(by[axis as usize]);
            let sign = if value.starts_with('-') { "" } else { "+" };
            format!("{}{sign}{value}", axis.letter() as char)
        })
        .collect();
    words.join(" ")
}

/// How far off, in mm, or in degrees if only rotary axes are.
fn distance(by: &[Nanos; AXES]) -> String {
    let far = |axes: &[Nanos]| axes.iter().map(|v| (*v as f64) * (*v as f64)).sum::<f64>().sqrt();
    let (linear, turned) = (far(&by[..3]), far(&by[3..]));
    let shown = |v: f64| number(v.round() as Nanos);
    if linear > 0.0 { format!("{} mm", shown(linear)) } else { format!("{}°", shown(turned)) }
}

/// What a group is, without its place.
pub(super) fn title(group: &Group) -> String {
    let form = match (&group.change, group.count) {
        (Change::Gap, [_, 0]) => "gap-first",
        (Change::Gap, [0, _]) => "gap-second",
        (Change::Gap, _) => "gap-replaced",
        (Change::Speed((_, SpindleMode::Surface), (_, SpindleMode::Surface)), _) => "surface-speed",
        (change, _) => kind(change),
    };
    // What has a partner counts once; of a gap, each side counts.
    let most = |counts: [u64; 2]| counts[0].max(counts[1]);
    let (events, moves, holes) = match &group.change {
        Change::Gap => {
            let side = usize::from(group.count[0] == 0);
            (group.count[side], group.moves[side], group.holes[side])
        }
        Change::Moved(_) => (most(group.count), most(group.moves), group.holes[0]),
        Change::Arc => (group.count[0], group.moves[0], 0),
        _ => (most(group.count), most(group.moves), 0),
    };
    let mut words = entry(form)
        .count("events", events)
        .count("moves", moves)
        .count("holes", holes)
        .count("new-events", group.count[1])
        .count("new-moves", group.moves[1])
        .count("new-holes", group.holes[1])
        .count("tool", u64::try_from(group.tool).unwrap_or(0));
    if let Some([before, after]) = values(&group.change) {
        words = words.text("before", before).text("after", after);
    }
    if let Change::Moved(by) | Change::Shift(by) = &group.change {
        words = words.text("offset", vector(by)).text("distance", distance(by));
    }
    words.headline()
}

/// Whether a difference is one of the path, and not only of what it is done with.
fn is_of_path(group: &Group) -> bool {
    match group.change {
        Change::Moved(_) | Change::Arc | Change::Kind(..) | Change::Shift(_) => true,
        Change::WorkOffset(..) | Change::Length(..) | Change::Frame => true,
        Change::Gap => group.moves != [0, 0],
        Change::Feed(..)
        | Change::Speed(..)
        | Change::SpeedLimit(..)
        | Change::Spindle(..)
        | Change::Tool(..)
        | Change::Coolant(..)
        | Change::Compensation(..)
        | Change::Orient(..)
        | Change::Dwell(..)
        | Change::Text => false,
    }
}

/// What is one difference in several places, although its groups are several.
fn sameness(group: &Group) -> String {
    match &group.change {
        Change::Gap => format!("{:?} {}", group.count.map(|n| n > 0), group.moves != [0, 0]),
        Change::Moved(by) | Change::Shift(by) => {
            format!("{} {} {}", kind(&group.change), vector(by), group.holes[0] > 0)
        }
        change => format!("{} {:?} {}", kind(change), values(change), group.holes[0] > 0),
    }
}

/// In the words of a reviewer. `differences` are those of the groups, in the same order.
pub(super) fn summary(groups: &[Group], differences: &[Difference], left_out: u64) -> String {
    if groups.is_empty() && left_out == 0 {
        return entry("same-cut").headline();
    }
    let mut parts: Vec<String> = Vec::new();
    if left_out == 0 && !groups.iter().any(is_of_path) {
        parts.push(entry("same-path").headline());
    }
    let mut order: Vec<(String, Vec<usize>)> = Vec::new();
    let mut index: BTreeMap<String, usize> = BTreeMap::new();
    for (i, group) in groups.iter().enumerate() {
        let key = sameness(group);
        let at = *index.entry(key.clone()).or_insert_with(|| {
            order.push((key, Vec::new()));
            order.len() - 1
        });
        order[at].1.push(i);
    }
    if order.len() > SUMMARY || left_out > 0 {
        parts.extend(KINDS.iter().filter_map(|name| many(name, groups)));
        if left_out > 0 {
            parts.push(entry("left-out").count("places", left_out).headline());
        }
        return parts.join("; ");
    }
    order.sort_by_key(|(_, same)| (is_of_path(&groups[same[0]]), same[0]));
    parts.extend(order.iter().map(|(_, same)| in_places(same, groups, differences)));
    parts.join("; ")
}

/// A difference with the first of its places.
fn in_places(same: &[usize], groups: &[Group], differences: &[Difference]) -> String {
    let (group, difference) = (&groups[same[0]], &differences[same[0]]);
    let shown = difference.blocks.iter().flatten().next();
    let block = shown.or(difference.beside.iter().flatten().next()).map(called);
    if same.len() > 1 {
        let mut all = group.clone();
        for other in &same[1..] {
            for side in 0..2 {
                all.count[side] += groups[*other].count[side];
                all.moves[side] += groups[*other].moves[side];
                all.holes[side] += groups[*other].holes[side];
            }
            if groups[*other].tool != all.tool {
                all.tool = 0;
            }
        }
        let form = if block.is_some() { "several" } else { "several-unplaced" };
        let words = entry(form).text("difference", title(&all)).text("places", same.len().to_string());
        return words.text("block", block.unwrap_or_default()).headline();
    }
    // A change of modes goes on over many moves; one of a place is there.
    let spread = group.paired && group.moves[0] > 1 && group.holes[0] == 0 && !is_of_path(group);
    match block {
        Some(block) if !spread => {
            let has_several = difference.blocks.iter().any(|blocks| blocks.len() > 1);
            let form = if has_several { "first-at" } else { "at" };
            entry(form).text("difference", difference.title.clone()).text("block", block).headline()
        }
        _ => difference.title.clone(),
    }
}

/// How people call a block: by its number, else by its line.
fn called(block: &Block) -> String {
    let number: String = block.text.chars().skip(1).take_while(char::is_ascii_digit).collect();
    match block.text.starts_with(['N', 'n']) && !number.is_empty() {
        true => entry("block-number").text("number", number).headline(),
        false => entry("block-line").text("line", block.line.to_string()).headline(),
    }
}

/// All differences of a kind, if there are any.
fn many(name: &'static str, groups: &[Group]) -> Option<String> {
    let mut events = [0; 2];
    let (mut places, mut farthest) = (0u64, 0f64);
    for group in groups.iter().filter(|group| kind(&group.change) == name) {
        places += 1;
        for (sum, n) in events.iter_mut().zip(group.count) {
            *sum += n;
        }
        if let Change::Moved(by) = group.change {
            let square = by[..3].iter().map(|v| (*v as f64) * (*v as f64)).sum::<f64>();
            farthest = farthest.max(square.sqrt());
        }
    }
    if events == [0, 0] {
        return None;
    }
    let words = entry(name)
        .count("places", places)
        .text("distance", format!("{} mm", number(farthest.round() as Nanos)));
    Some(match name {
        "gap" => words.count("events", events[0]).count("new-events", events[1]).headline(),
        _ => words.count("events", events[0].max(events[1])).attribute("many"),
    })
}
