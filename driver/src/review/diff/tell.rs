//! What was found: one account that every form of output lays out.

use std::collections::BTreeMap;
use std::io::{self, Read, Seek, SeekFrom};

use ncc_diff::change::{Change, Group};
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;

use super::motion::Motion;
use super::wording::{entry, kind, summary, title, values};
use crate::render::source::Lines;
use crate::render::text::visible;
use crate::side::Side;
use crate::source::Source;
use crate::verify_run::WORLDS;

/// Longest text of a block that is shown, in bytes.
const LONGEST: u64 = 160;

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
            true => entry("block-number").text("number", number).headline(),
            false => entry("block-line").text("line", self.line.to_string()).headline(),
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
        let facts = [
            (motion.mute, "mute"),
            (found.units, "units"),
            (motion.sampled, "sampled"),
            (found.lost, "lost"),
        ];
        let notes =
            facts.iter().filter(|(holds, _)| *holds).map(|(_, form)| entry(form).headline()).collect();
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
