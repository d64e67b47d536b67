//! Reading dictionaries, and the ones that are built in.

use std::fmt;
use std::sync::LazyLock;

use ncc_ir::canon::ReturnLevel;
use ncc_ir::caps::{Caps, CycleCap};

use crate::meaning::Meaning;
use crate::schema::{CodeIndex, CycleRow, Dialect, Family, PatternRow};

/// Why a dictionary cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DialectError {
    /// Not the form of a dictionary; the message names the line.
    Form(String),
    /// A row that contradicts another, or names what is not there.
    Row {
        /// Code or letter of the row.
        row: String,
        /// What is wrong.
        wrong: &'static str,
    },
}

impl fmt::Display for DialectError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DialectError::Form(message) => f.write_str(message),
            DialectError::Row { row, wrong } => write!(f, "row {row}: {wrong}"),
        }
    }
}

impl std::error::Error for DialectError {}

/// Data files of the built-in dialects, in the order of `ncc dialects`.
const BUILTIN: &[&str] = &[
    include_str!("../data/mach9.toml"),
    include_str!("../data/fanuc.toml"),
    include_str!("../data/canon.toml"),
    include_str!("../data/ir.toml"),
];

static DIALECTS: LazyLock<Vec<Dialect>> = LazyLock::new(|| {
    BUILTIN.iter().map(|text| parse(text).unwrap_or_else(|e| panic!("built-in dictionary: {e}"))).collect()
});

/// The built-in dialects.
pub fn builtins() -> &'static [Dialect] {
    &DIALECTS
}

/// A built-in dialect by its id.
pub fn builtin(id: &str) -> Option<&'static Dialect> {
    DIALECTS.iter().find(|d| d.id == id)
}

/// Reads a dictionary.
///
/// # Errors
/// The text is not a dictionary, or its rows contradict each other.
pub fn parse(text: &str) -> Result<Dialect, DialectError> {
    let mut dialect: Dialect = toml::from_str(text).map_err(|e| DialectError::Form(e.to_string()))?;
    dialect.index = index(&dialect)?;
    dialect.caps = caps(&dialect);
    Ok(dialect)
}

/// Tenths of a code's number: `G5.1` is 51.
fn tenths(code: &str) -> Option<(u8, usize)> {
    let letter = *code.as_bytes().first()?;
    let (whole, tenth) = code[1..].split_once('.').unwrap_or((&code[1..], "0"));
    let number = whole.parse::<usize>().ok()? * 10 + tenth.parse::<usize>().ok()?;
    (number < 100_000).then_some((letter, number))
}

/// Kinds of cycles, as `ncc_ir::cycle::CycleKind::name` has them.
const CYCLE_KINDS: &[&str] = &["drill", "drill-dwell", "drill-peck", "bore"];

fn index(dialect: &Dialect) -> Result<CodeIndex, DialectError> {
    let wrong = |row: &str, wrong| DialectError::Row { row: row.to_owned(), wrong };
    let mut index = CodeIndex::default();
    for (at, row) in dialect.code.iter().enumerate() {
        let (letter, number) = tenths(&row.code).ok_or_else(|| wrong(&row.code, "is no code"))?;
        let table = match letter {
            b'G' => &mut index.g,
            b'M' => &mut index.m,
            _ => return Err(wrong(&row.code, "is neither a G nor an M code")),
        };
        if table.len() <= number {
            table.resize(number + 1, None);
        }
        if table[number].replace(at as u16).is_some() {
            return Err(wrong(&row.code, "stands twice"));
        }
        if row.means.is_some() == row.refuse.is_some() {
            return Err(wrong(&row.code, "needs either `means` or `refuse`"));
        }
        if row.means == Some(Meaning::StartCycle) && dialect.cycle_row(&row.code).is_none() {
            return Err(wrong(&row.code, "has no [[cycle]] row"));
        }
        if row.means == Some(Meaning::Pattern) && dialect.pattern_row(&row.code).is_none() {
            return Err(wrong(&row.code, "has no [[pattern]] row"));
        }
        if row.source.is_empty() {
            return Err(wrong(&row.code, "names no source"));
        }
    }
    for row in &dialect.cycle {
        if !CYCLE_KINDS.contains(&row.kind.as_str()) {
            return Err(wrong(&row.code, "has a kind that there is not"));
        }
    }
    for (at, row) in dialect.address.iter().enumerate() {
        let place = row.letter as usize;
        let slot = index
            .letter
            .get_mut(place.wrapping_sub(65))
            .ok_or_else(|| wrong(&row.letter.to_string(), "is no letter"))?;
        if slot.replace(at as u8).is_some() {
            return Err(wrong(&row.letter.to_string(), "stands twice"));
        }
    }
    Ok(index)
}

fn caps(dialect: &Dialect) -> Caps {
    let says = |meaning| dialect.code_for(meaning).is_some();
    let returns: Vec<ReturnLevel> = match dialect.cycles.return_level {
        Some(level) => vec![level.into()],
        None => vec![ReturnLevel::Initial, ReturnLevel::Retract],
    };
    let everything = dialect.can.everything;
    Caps {
        cycles: if everything {
            let all = ["drill", "drill-dwell", "drill-peck", "drill-break", "bore"];
            let cap = |kind: &str| CycleCap {
                kind: kind.to_owned(),
                returns: vec![ReturnLevel::Initial, ReturnLevel::Retract],
                dwell: true,
                clearance: true,
                parameter: true,
                strokes: true,
                feed_out: true,
                lift_at_feed: None,
            };
            all.into_iter().map(cap).collect()
        } else {
            let cap = |row: &CycleRow| CycleCap {
                kind: row.kind.clone(),
                returns: returns.clone(),
                dwell: row.dwell.is_some(),
                clearance: false,
                parameter: true,
                strokes: false,
                feed_out: false,
                lift_at_feed: Some(false),
            };
            dialect.cycle.iter().map(cap).collect()
        },
        circle_pattern: everything || dialect.pattern.iter().any(|p| matches!(p, PatternRow::Circle { .. })),
        grid_pattern: if everything { u32::MAX } else { dialect.can.grid_upto },
        grid_serpentine: dialect.pattern.iter().find_map(|p| match p {
            PatternRow::Grid { serpentine, .. } => Some(*serpentine),
            PatternRow::Circle { .. } => None,
        }),
        line_pattern: everything,
        list_pattern: if everything { u32::MAX } else { 0 },
        circle_polar: (!everything).then_some(false),
        pattern_start: everything,
        pattern_angle: everything,
        frames: everything,
        machine_coordinates: everything,
        tool_edges: (!everything).then_some(false),
        return_planes: (!everything).then_some(false),
        arc_forms: everything,
        repeat_blocks: everything,
        circle_centre_at_zero_only: dialect.can.circle_centre_at_zero_only,
        incremental_cycles: everything || dialect.cycles.incremental,
        calls: everything || (dialect.program.subprograms && says(Meaning::Call)),
        repeats: everything,
        work_offsets: if everything || dialect.family == Family::Canon {
            u16::MAX
        } else {
            dialect.code.iter().filter(|r| matches!(r.means, Some(Meaning::SetOriginOffsets(_)))).count()
                as u16
        },
        clears_shift: everything
            || dialect.can.flat
            || says(Meaning::ClearFrame(ncc_ir::program::FrameSlot::Shift)),
        offset_with_z: dialect.can.offset_with_z,
        arc_radius: everything || dialect.letter_for(crate::Role::Radius).is_some(),
        helix: everything || dialect.can.flat || dialect.arc.helix,
        arc_turns: everything || dialect.can.flat,
        skip_levels: if everything { 10 } else { dialect.block.skip_levels },
        incremental: everything || says(Meaning::SetDistanceMode(ncc_ir::canon::Distance::Incremental)),
        inch: true,
        flat: dialect.can.flat,
        inherits_motion: everything || dialect.can.inherits_motion,
        messages: everything || dialect.can.flat,
        approach: if everything { None } else { Some(dialect.cycles.approach.into()) },
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn built_in_dictionaries_load() {
        let ids: Vec<_> = super::builtins().iter().map(|d| d.id.as_str()).collect();
        assert_eq!(ids, ["mach9", "fanuc", "canon", "ir"]);
    }
}
