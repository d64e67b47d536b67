//! Reading dictionaries, and the ones that are built in.

use std::collections::BTreeSet;
use std::fmt;
use std::sync::LazyLock;

use ncc_ir::canon::ReturnLevel;
use ncc_ir::caps::{Caps, CycleCap};

use crate::meaning::Meaning;
use crate::names::{CallKind, CallRow, FrameWord, NameMeaning, NameRole, NameRow, ParameterRole};
use crate::schema::{CodeIndex, CodeRow, CycleRow, Dialect, Family, PatternRow};

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
    include_str!("../data/siemens.toml"),
    include_str!("../data/canon.toml"),
    include_str!("../data/ir.toml"),
];

pub(crate) static DIALECTS: LazyLock<Vec<Dialect>> = LazyLock::new(|| {
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
    dialect.code = each_code(std::mem::take(&mut dialect.code))?;
    dialect.name = each_name(std::mem::take(&mut dialect.name));
    dialect.index = index(&dialect)?;
    dialect.caps = caps(&dialect);
    Ok(dialect)
}

/// The rows of codes with those that stand for several made into one each.
fn each_code(rows: Vec<CodeRow>) -> Result<Vec<CodeRow>, DialectError> {
    let mut all = Vec::with_capacity(rows.len());
    for row in rows {
        let Some(upto) = row.upto else {
            all.push(row);
            continue;
        };
        let wrong = |wrong| DialectError::Row { row: row.code.clone(), wrong };
        let first =
            row.code.get(1..).and_then(|n| n.parse::<u16>().ok()).ok_or_else(|| wrong("is no code"))?;
        let Some(Meaning::SetOriginOffsets(number)) = row.means else {
            return Err(wrong("stands for several codes, but for no work offsets"));
        };
        for code in first..=upto.min(first.saturating_add(999)) {
            let means = Some(Meaning::SetOriginOffsets(number + (code - first)));
            all.push(CodeRow { code: format!("{}{code}", &row.code[..1]), upto: None, means, ..row.clone() });
        }
    }
    Ok(all)
}

/// The rows of words with those that stand for several made into one each.
fn each_name(rows: Vec<NameRow>) -> Vec<NameRow> {
    let mut all = Vec::with_capacity(rows.len());
    for row in rows {
        for name in row.name.split(' ') {
            all.push(NameRow { name: name.to_owned(), ..row.clone() });
        }
    }
    all
}

/// Tenths of a code's number: `G5.1` is 51.
fn tenths(code: &str) -> Option<(u8, usize)> {
    let letter = *code.as_bytes().first()?;
    let (whole, tenth) = code[1..].split_once('.').unwrap_or((&code[1..], "0"));
    let number = whole.parse::<usize>().ok()? * 10 + tenth.parse::<usize>().ok()?;
    (number < 100_000).then_some((letter, number))
}

/// Kinds of cycles, as `ncc_ir::cycle::CycleKind::name` has them.
const CYCLE_KINDS: &[&str] = &["drill", "drill-dwell", "drill-peck", "drill-break", "bore"];

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
    names(dialect)?;
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

/// Checks the words of several letters and the calls.
fn names(dialect: &Dialect) -> Result<(), DialectError> {
    let wrong = |row: &str, wrong| DialectError::Row { row: row.to_owned(), wrong };
    let mut seen = BTreeSet::new();
    let names = dialect.name.iter().map(|row| (&row.name, &row.source));
    for (name, source) in names.chain(dialect.call.iter().map(|row| (&row.name, &row.source))) {
        if !seen.insert(name) {
            return Err(wrong(name, "stands twice"));
        }
        if name.is_empty() || !name.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit() || b == b'_')
        {
            return Err(wrong(name, "is no word in capitals"));
        }
        if source.is_empty() {
            return Err(wrong(name, "names no source"));
        }
    }
    for row in &dialect.name {
        let uses = [row.means.is_some(), row.role.is_some(), row.refuse.is_some()];
        if uses.into_iter().filter(|u| *u).count() != 1 {
            return Err(wrong(&row.name, "needs one of `means`, `role` and `refuse`"));
        }
        if row.role.is_some() != row.quantity.is_some() {
            return Err(wrong(&row.name, "needs `quantity` with `role`"));
        }
    }
    for row in &dialect.call {
        for p in &row.parameters {
            if p.role.is_some() == p.refuse.is_some() || p.role.is_some() != p.quantity.is_some() {
                return Err(wrong(&row.name, "has a parameter without `role` and `quantity`, or `refuse`"));
            }
            let several = matches!(p.role, Some(ParameterRole::PointFirst | ParameterRole::PointSecond));
            let same = row.parameters.iter().filter(|q| q.role == p.role).count();
            if p.role.is_some() && !several && same > 1 {
                return Err(wrong(&row.name, "has two parameters of one role"));
            }
        }
    }
    Ok(())
}

fn caps(dialect: &Dialect) -> Caps {
    let says = |meaning| dialect.code_for(meaning).is_some();
    let returns: Vec<ReturnLevel> = match dialect.cycles.return_level {
        Some(level) => vec![level.into()],
        None => vec![ReturnLevel::Initial, ReturnLevel::Retract],
    };
    let everything = dialect.can.everything;
    let calls = |kind| dialect.call_for(kind);
    let names = |meaning| dialect.name_for(meaning).is_some();
    let states = dialect.call.iter().any(|row| row.place(ParameterRole::ReturnPlane).is_some());
    let either = |says: bool| (!everything).then_some(says);
    let list = calls(CallKind::List).map(|row| {
        row.parameters.iter().filter(|p| p.role == Some(ParameterRole::PointFirst)).count() as u32
    });
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
            let called = |row: &CallRow| {
                let has = |role| row.place(role).is_some();
                let caps = row.kind.cycles().iter().map(|kind| CycleCap {
                    kind: (*kind).to_owned(),
                    returns: returns.clone(),
                    dwell: has(ParameterRole::Dwell),
                    clearance: has(ParameterRole::Clearance),
                    parameter: !has(ParameterRole::Clearance),
                    strokes: has(ParameterRole::RelativeFirstDepth),
                    feed_out: has(ParameterRole::FeedOut),
                    lift_at_feed: Some(has(ParameterRole::Lift)),
                });
                caps.collect::<Vec<_>>()
            };
            dialect.cycle.iter().map(cap).chain(dialect.call.iter().flat_map(called)).collect()
        },
        circle_pattern: everything
            || calls(CallKind::Circle).is_some()
            || dialect.pattern.iter().any(|p| matches!(p, PatternRow::Circle { .. })),
        grid_pattern: match calls(CallKind::Grid) {
            _ if everything => u32::MAX,
            Some(_) => u32::MAX,
            None => dialect.can.grid_upto,
        },
        grid_serpentine: match calls(CallKind::Grid) {
            Some(_) => Some(true),
            None => dialect.pattern.iter().find_map(|p| match p {
                PatternRow::Grid { serpentine, .. } => Some(*serpentine),
                PatternRow::Circle { .. } => None,
            }),
        },
        grid_square: calls(CallKind::Grid).is_some(),
        order_by_position: dialect.call.iter().any(|row| row.order_by_position),
        line_pattern: everything || calls(CallKind::Line).is_some(),
        list_pattern: if everything { u32::MAX } else { list.unwrap_or(0) },
        circle_polar: either(calls(CallKind::Circle).is_some()),
        pattern_start: everything || calls(CallKind::Grid).is_some(),
        // A pattern that is called has its start among the arguments.
        pattern_here: calls(CallKind::Grid).is_none(),
        pattern_angle: everything || calls(CallKind::Grid).is_some(),
        frames: everything || names(NameMeaning::SetFrame(FrameWord::Translate)),
        machine_coordinates: everything || names(NameMeaning::Code(Meaning::UseMachineCoordinates)),
        tool_edges: either(dialect.letter_for(crate::Role::ToolEdge).is_some()),
        return_planes: either(states),
        arc_forms: everything || names(NameMeaning::ArcThrough),
        word_distance: everything || dialect.can.flat || dialect.block.qualifiers,
        feed_apart: everything || dialect.can.flat || dialect.code.iter().any(|row| row.feed_stays),
        feed_again: !everything && dialect.code.iter().any(|row| row.feed_stays),
        call_digits: if says(Meaning::Call) { dialect.program.number_digits as u32 } else { 0 },
        repeat_blocks: everything || names(NameMeaning::RepeatBlocks),
        circle_centre_at_zero_only: dialect.can.circle_centre_at_zero_only,
        incremental_cycles: everything || dialect.cycles.incremental,
        calls: everything
            || (dialect.program.subprograms
                && (says(Meaning::Call) || dialect.letter_for(crate::Role::Call).is_some())),
        repeats: everything,
        work_offsets: if everything || dialect.family == Family::Canon {
            u16::MAX
        } else {
            dialect.code.iter().filter(|r| matches!(r.means, Some(Meaning::SetOriginOffsets(1..)))).count()
                as u16
        },
        clears_shift: everything
            || dialect.can.flat
            || dialect.power_on.no_origin_shift.as_ref().is_some_and(|f| f.always && f.value)
            || says(Meaning::ClearFrame(ncc_ir::program::FrameSlot::Shift)),
        offset_with_z: dialect.can.offset_with_z,
        arc_radius: everything
            || dialect.letter_for(crate::Role::Radius).is_some()
            || dialect.name_with(NameRole::Radius).is_some(),
        helix: everything || dialect.can.flat || dialect.arc.helix,
        arc_turns: everything || dialect.can.flat || dialect.name_with(NameRole::Turns).is_some(),
        skip_levels: if everything { 10 } else { dialect.block.skip_levels },
        incremental: everything || says(Meaning::SetDistanceMode(ncc_ir::canon::Distance::Incremental)),
        inch: true,
        flat: dialect.can.flat,
        inherits_motion: everything || dialect.can.inherits_motion,
        messages: everything || dialect.can.flat || names(NameMeaning::Message),
        approach: if everything { None } else { Some(dialect.cycles.approach.into()) },
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn built_in_dictionaries_load() {
        let ids: Vec<_> = super::builtins().iter().map(|d| d.id.as_str()).collect();
        assert_eq!(ids, ["mach9", "fanuc", "siemens", "canon", "ir"]);
    }
}
