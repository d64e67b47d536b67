//! What was found, in words: one account that every form of output lays out.

use std::collections::BTreeMap;
use std::io::{self, Read, Seek, SeekFrom};

use ncc_diff::change::{Change, Group};
use ncc_diff::record::What;
use ncc_ir::canon::{AXES, Axis, SpindleMode};
use ncc_ir::expr::num::{Nanos, ONE};

use super::motion::Motion;
use crate::render::source::Lines;
use crate::render::text::visible;
use crate::review::words::{coolant, length, number, rounded, spindle};
use crate::side::Side;
use crate::source::Source;
use crate::verify_run::WORLDS;

/// Longest text of a block that is shown, in bytes.
const LONGEST: u64 = 160;
/// Things that a summary names.
const SUMMARY: usize = 12;

/// The result of a comparison.
#[derive(Clone, Debug)]
pub struct Account {
    /// `motion` or `text`.
    pub level: &'static str,
    /// Names of both programs.
    pub names: [String; 2],
    /// Their dialects.
    pub dialects: [String; 2],
    /// Whether nothing differs.
    pub equal: bool,
    /// In one line, in the words of a reviewer.
    pub summary: String,
    /// Events, or blocks, that agree.
    pub same: u64,
    /// What has no partner, on either side.
    pub unmatched: [u64; 2],
    /// Worlds in which programs were executed; 0 of texts.
    pub worlds: u32,
    /// Settings of the block-skip switches.
    pub settings: usize,
    /// Within how much lengths are the same, mm.
    pub tolerance: f64,
    /// What the reader must know of the comparison.
    pub notes: Vec<String>,
    /// The differences, in the order of the first program.
    pub differences: Vec<Difference>,
    /// Differences that are counted only.
    pub left_out: u64,
}

/// A difference.
#[derive(Clone, Debug)]
pub struct Difference {
    /// Its kind, a stable name.
    pub kind: &'static str,
    /// What it is.
    pub title: String,
    /// Before and after, if it is a value.
    pub values: Option<[String; 2]>,
    /// By how much it is off, X to C, nanos.
    pub offset: Option<[Nanos; AXES]>,
    /// Tool, if it is known.
    pub tool: Option<i64>,
    /// Moves of both sides.
    pub moves: [u64; 2],
    /// Holes of both sides.
    pub holes: [u64; 2],
    /// Block-skip levels that are on when it shows.
    pub skip: Vec<u8>,
    /// Blocks of both sides.
    pub blocks: [Vec<Block>; 2],
    /// Whether there are further ones.
    pub more: [bool; 2],
    /// Whether blocks at the same index belong together.
    pub paired: bool,
    /// Where a side has nothing, the block before it.
    pub beside: [Option<Block>; 2],
}

/// A block of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Its line.
    pub line: u64,
    /// Its text.
    pub text: String,
}

impl Block {
    /// How people call it: by its number, else by its line.
    pub fn called(&self) -> String {
        let number: String = self.text.chars().skip(1).take_while(char::is_ascii_digit).collect();
        match self.text.starts_with(['N', 'n']) && !number.is_empty() {
            true => format!("N{number}"),
            false => format!("line {}", self.line),
        }
    }
}

impl Account {
    /// Of two programs that were executed.
    ///
    /// # Errors
    /// Reading the sources.
    pub fn of(motion: &Motion, sides: &mut [Side; 2]) -> io::Result<Account> {
        let found = &motion.found;
        let mut texts = [Blocks::default(), Blocks::default()];
        for (side, blocks) in texts.iter_mut().enumerate() {
            let places =
                |g: &Group| g.blocks[side].iter().copied().chain(g.beside[side]).collect::<Vec<u32>>();
            let places = found.groups.iter().flat_map(places).collect();
            *blocks = Blocks::read(&mut sides[side].source, places)?;
        }
        let differences: Vec<Difference> =
            found.groups.iter().map(|group| difference(group, &texts)).collect();
        let summary = summary(&found.groups, &differences, found.left_out);
        let mut notes = Vec::new();
        if motion.mute {
            notes.push("messages are not compared: one of the controls has none".to_owned());
        }
        if found.units {
            notes.push("one program is in inches where the other is in millimetres".to_owned());
        }
        if motion.sampled {
            notes.push(
                "not every setting of the block-skip switches was tried: there are too many".to_owned(),
            );
        }
        if found.lost {
            notes.push(
                "the programs are too long to be brought together again where they have nothing in common"
                    .to_owned(),
            );
        }
        Ok(Account {
            level: "motion",
            names: [0, 1].map(|side: usize| sides[side].source.shown.clone()),
            dialects: [0, 1].map(|side: usize| sides[side].dialect().id.clone()),
            equal: found.equal(),
            summary,
            same: found.pairs,
            unmatched: found.unmatched,
            worlds: 1 + WORLDS,
            settings: motion.settings,
            tolerance: motion.measure.lengths[0] as f64 / 1e9,
            notes,
            differences,
            left_out: found.left_out,
        })
    }
}

/// Texts of the blocks that are shown.
#[derive(Debug, Default)]
pub struct Blocks {
    by_place: BTreeMap<u32, Block>,
}

impl Blocks {
    /// Reads the blocks of these places.
    ///
    /// # Errors
    /// Reading the source.
    pub fn read(source: &mut Source, places: Vec<u32>) -> io::Result<Blocks> {
        let lines = Lines::find(&mut source.file, places.clone())?;
        let mut blocks = Blocks::default();
        for place in places {
            if blocks.by_place.contains_key(&place) {
                continue;
            }
            let Some(line) = lines.line(place) else { continue };
            let mut bytes = Vec::new();
            source.file.seek(SeekFrom::Start(line.start))?;
            (&mut source.file).take((line.end - line.start).min(LONGEST)).read_to_end(&mut bytes)?;
            let mut text = decoded(&bytes);
            if line.end - line.start > LONGEST {
                text.push('…');
            }
            blocks.by_place.insert(place, Block { line: line.number, text });
        }
        Ok(blocks)
    }

    /// The block of a place that was read.
    pub fn get(&self, place: u32) -> Option<Block> {
        self.by_place.get(&place).cloned()
    }
}

/// UTF-8, else Latin-1, without what would move a terminal's cursor.
pub fn decoded(bytes: &[u8]) -> String {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(e) if e.error_len().is_none() => String::from_utf8_lossy(&bytes[..e.valid_up_to()]).into_owned(),
        Err(_) => bytes.iter().map(|b| char::from(*b)).collect(),
    };
    text.trim().chars().map(visible).collect()
}

fn difference(group: &Group, texts: &[Blocks; 2]) -> Difference {
    let blocks = [0, 1].map(|side: usize| {
        group.blocks[side].iter().filter_map(|at| texts[side].get(*at)).collect::<Vec<Block>>()
    });
    let beside = [0, 1].map(|side: usize| match blocks[side].is_empty() {
        true => group.beside[side].and_then(|at| texts[side].get(at)),
        false => None,
    });
    let paired = group.paired && blocks[0].len() == blocks[1].len();
    let skip = (1..16u8).filter(|level| group.skip >> level & 1 == 1).collect();
    Difference {
        kind: kind(&group.change),
        title: title(group),
        values: values(&group.change),
        offset: match group.change {
            Change::Moved(by) | Change::Shift(by) => Some(by),
            _ => None,
        },
        tool: (group.tool > 0).then_some(group.tool),
        moves: group.moves,
        holes: group.holes,
        skip,
        blocks,
        more: group.more_blocks,
        paired,
        beside,
    }
}

/// A stable name.
fn kind(change: &Change) -> &'static str {
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
fn values(change: &Change) -> Option<[String; 2]> {
    Some(match change {
        Change::Feed(a, b) => [rounded(*a, 3), rounded(*b, 3)],
        Change::Speed((a, x), (b, y)) if x == y => [number(*a), number(*b)],
        Change::Speed(a, b) => [*a, *b].map(|(speed, counts)| speed_counting(speed, counts)),
        Change::SpeedLimit(a, b) => [*a, *b].map(limit),
        Change::Dwell(a, b) | Change::Orient(a, b) => [number(*a), number(*b)],
        Change::Spindle(a, b) => [*a, *b].map(|s| spindle(s).to_owned()),
        Change::Tool(a, b) => [*a, *b].map(tool_name),
        Change::Coolant(a, b) => [*a, *b].map(|on| coolant(on).to_owned()),
        Change::Compensation(a, b) => [a.words(), b.words()],
        Change::WorkOffset(a, b) => [a.to_string(), b.to_string()],
        Change::Length(a, b) => [length(a), length(b)],
        Change::Kind(a, b) => [*a, *b].map(|what| name(what).to_owned()),
        Change::Frame | Change::Moved(_) | Change::Arc | Change::Text | Change::Gap | Change::Shift(_) => {
            return None;
        }
    })
}

fn tool_name(tool: i64) -> String {
    if tool < 0 { "the one at the start".to_owned() } else { format!("T{tool}") }
}

/// A speed of the spindle with what it counts.
fn speed_counting(speed: Nanos, counts: SpindleMode) -> String {
    match counts {
        SpindleMode::Turns => format!("{} rev/min", number(speed)),
        SpindleMode::Surface => format!("{} m/min constant surface speed", number(speed)),
    }
}

/// A limit of the spindle's speed, in thousandths of a rev/min.
fn limit(limit: Option<u32>) -> String {
    limit.map_or("none".to_owned(), |limit| format!("{} rev/min", number(Nanos::from(limit) * (ONE / 1000))))
}

fn name(what: What) -> &'static str {
    match what {
        What::Traverse => "rapid",
        What::Feed => "feed move",
        What::Thread => "thread",
        What::Orient => "stop of the spindle at an angle",
        What::Arc => "arc",
        What::Dwell => "dwell",
        What::ToolChange => "tool change",
        What::Function => "machine function",
        What::Stop => "stop",
        What::OptionalStop => "optional stop",
        What::End => "program end",
        What::BeginAgain => "program that begins again",
        What::TextEnd => "end of the text without a program end",
        What::Message => "message",
        What::Alarm => "alarm",
    }
}

/// What changed, without where.
fn changed(change: &Change) -> String {
    let arrow = |what: &str, change: &Change| match values(change) {
        Some([a, b]) => format!("{what} {a} → {b}"),
        None => what.to_owned(),
    };
    match change {
        Change::Feed(..) => arrow("feed", change),
        Change::Speed((_, SpindleMode::Surface), (_, SpindleMode::Surface)) => {
            format!("{} m/min", arrow("constant surface speed", change))
        }
        Change::Speed(..) => arrow("spindle speed", change),
        Change::SpeedLimit(..) => arrow("limit of the spindle's speed", change),
        Change::Spindle(..) => arrow("spindle", change),
        Change::Tool(..) => arrow("tool", change),
        Change::Coolant(..) => arrow("coolant", change),
        Change::Compensation(..) => arrow("cutter radius compensation", change),
        Change::WorkOffset(..) => arrow("work offset", change),
        Change::Length(..) => arrow("tool length", change),
        Change::Orient(..) => arrow("angle of the spindle", change),
        Change::Dwell(a, b) => format!("dwell {} s → {} s", number(*a), number(*b)),
        Change::Kind(..) => arrow("other kind of move:", change),
        Change::Frame => "another place on the machine at the same coordinates".to_owned(),
        Change::Arc => "other way round an arc, or another centre".to_owned(),
        Change::Text => "another text or function".to_owned(),
        Change::Gap => "blocks without a partner".to_owned(),
        Change::Moved(by) => format!("{} off ({})", distance(by), vector(by)),
        Change::Shift(by) => format!("all that follows is shifted by {}", vector(by)),
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

/// How far off, in mm, or in degrees if only axes that turn are.
fn distance(by: &[Nanos; AXES]) -> String {
    let far = |axes: &[Nanos]| axes.iter().map(|v| (*v as f64) * (*v as f64)).sum::<f64>().sqrt();
    let (linear, turned) = (far(&by[..3]), far(&by[3..]));
    let shown = |v: f64| number(v.round() as Nanos);
    if linear > 0.0 { format!("{} mm", shown(linear)) } else { format!("{}°", shown(turned)) }
}

fn many(n: u64, one: &str, several: &str) -> String {
    if n == 1 { format!("1 {one}") } else { format!("{n} {several}") }
}

fn of_holes(n: u64) -> String {
    if n == 1 { "one hole".to_owned() } else { format!("{n} holes") }
}

fn of_tool(tool: i64) -> String {
    if tool > 0 { format!(" of T{tool}") } else { String::new() }
}

/// On how much it is so.
fn extent(group: &Group) -> String {
    match (group.moves[0].max(group.moves[1]), group.count[0].max(group.count[1])) {
        (0, n) => many(n, "event", "events"),
        (n, _) => many(n, "move", "moves"),
    }
}

fn title(group: &Group) -> String {
    let what = changed(&group.change);
    match &group.change {
        Change::Feed(..)
        | Change::Speed(..)
        | Change::SpeedLimit(..)
        | Change::Spindle(..)
        | Change::Tool(..)
        | Change::Coolant(..)
        | Change::Compensation(..)
        | Change::WorkOffset(..)
        | Change::Length(..)
        | Change::Frame => format!("{what} on {}{}", extent(group), of_tool(group.tool)),
        Change::Moved(_) => match group.holes[0] {
            0 => format!("{}{} {what}", extent(group), of_tool(group.tool)),
            holes => format!("{}{} {what}", of_holes(holes), of_tool(group.tool)),
        },
        Change::Arc => match group.count[0] {
            1 => format!("an arc{} with another centre, sense or sweep", of_tool(group.tool)),
            n => format!("{n} arcs{} with another centre, sense or sweep", of_tool(group.tool)),
        },
        Change::Kind(..) | Change::Orient(..) | Change::Dwell(..) | Change::Text => what,
        Change::Gap => {
            let side = |side: usize| match (group.holes[side], group.moves[side], group.count[side]) {
                (0, 0, n) => many(n, "event", "events"),
                (0, n, _) => many(n, "move", "moves"),
                (holes, ..) => of_holes(holes),
            };
            match group.count {
                [_, 0] => format!("{}{} only in the first", side(0), of_tool(group.tool)),
                [0, _] => format!("{}{} only in the second", side(1), of_tool(group.tool)),
                [_, _] => format!("{}{} replaced by {}", side(0), of_tool(group.tool), side(1)),
            }
        }
        Change::Shift(_) => format!("{what}, over {}", extent(group)),
    }
}

/// In the words of a reviewer.
fn summary(groups: &[Group], differences: &[Difference], left_out: u64) -> String {
    if groups.is_empty() && left_out == 0 {
        return "the same cut".to_owned();
    }
    let path = |group: &Group| match group.change {
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
    };
    let mut parts: Vec<String> = Vec::new();
    if left_out == 0 && !groups.iter().any(path) {
        parts.push("same path".to_owned());
    }
    // What is the same change in several places is said once.
    let mut order: Vec<(String, Vec<usize>)> = Vec::new();
    let mut place: BTreeMap<String, usize> = BTreeMap::new();
    for (i, group) in groups.iter().enumerate() {
        let key = match group.change {
            Change::Gap => format!("gap {:?} {}", group.count.map(|n| n > 0), group.moves != [0, 0]),
            _ => format!("{} {}", changed(&group.change), group.holes[0] > 0),
        };
        let at = *place.entry(key.clone()).or_insert_with(|| {
            order.push((key, Vec::new()));
            order.len() - 1
        });
        order[at].1.push(i);
    }
    // Where differences are few, each is said by itself and with its place.
    order.sort_by_key(|(_, same)| {
        let group = &groups[same[0]];
        (path(group), same[0])
    });
    if order.len() > SUMMARY || left_out > 0 {
        parts.extend(classes(groups));
        if left_out > 0 {
            parts.push(format!("and {} that are counted only", many(left_out, "difference", "differences")));
        }
        return parts.join("; ");
    }
    for (_, same) in &order {
        let group = &groups[same[0]];
        let at = differences[same[0]].blocks.iter().flatten().next().or(differences[same[0]]
            .beside
            .iter()
            .flatten()
            .next());
        let several = same.len() == 1 && differences[same[0]].blocks.iter().any(|blocks| blocks.len() > 1);
        let first = if several { "first " } else { "" };
        let at = at.map(|block| format!(" {first}at {}", block.called())).unwrap_or_default();
        match same.len() {
            1 => {
                let title = &differences[same[0]].title;
                // A change of modes goes on over many moves; one of a place is there.
                let spread = group.paired && group.moves[0] > 1 && group.holes[0] == 0 && !path(group);
                parts.push(if spread { title.clone() } else { format!("{title}{at}") });
            }
            n => {
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
                parts.push(format!("{} in {n} places, first{at}", self::title(&all)));
            }
        }
    }
    parts.join("; ")
}

/// Many differences, by their kind.
fn classes(groups: &[Group]) -> Vec<String> {
    /// What is said of a kind, in the order in which it is said.
    const KINDS: [(&str, &str); 18] = [
        ("shift", "a tail is shifted"),
        ("moved", "off"),
        ("gap", ""),
        ("arc", "arcs with another centre, sense or sweep"),
        ("kind", "another kind of move"),
        ("work-offset", "another work offset"),
        ("length", "another tool length"),
        ("frame", "another place on the machine at the same coordinates"),
        ("tool", "another tool"),
        ("feed", "another feed"),
        ("speed", "another spindle speed"),
        ("speed-limit", "another limit of the spindle's speed"),
        ("spindle", "another sense of the spindle"),
        ("coolant", "other coolant"),
        ("compensation", "other cutter radius compensation"),
        ("orientation", "another angle of the spindle"),
        ("dwell", "another dwell"),
        ("text", "another text or function"),
    ];
    let mut said = Vec::new();
    for (name, words) in KINDS {
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
        let on = many(events[0].max(events[1]), "event", "events");
        let places = many(places, "difference", "differences");
        match (name, events) {
            (_, [0, 0]) => {}
            ("moved", _) => {
                said.push(format!("{on} up to {} mm off ({places})", number(farthest.round() as Nanos)));
            }
            ("gap", [a, b]) => {
                said.push(format!("{a} events only in the first and {b} only in the second ({places})"))
            }
            (_, _) => said.push(format!("{words} on {on} ({places})")),
        }
    }
    said
}
