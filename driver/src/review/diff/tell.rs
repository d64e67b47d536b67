//! What was found: one account that every form of output lays out.

use std::collections::BTreeMap;
use std::io::{self, Read, Seek, SeekFrom};

use ncc_diff::change::{Change, Group};

pub use super::account::{Account, Block, Difference};
use super::motion::Motion;
use super::wording::{entry, kind, summary, title, values};
use crate::render::source::Lines;
use crate::render::text::visible;
use crate::side::Side;
use crate::source::Source;
use crate::verify_run::WORLDS;

/// Longest text of a block that is shown, in bytes.
const LONGEST: u64 = 160;

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
