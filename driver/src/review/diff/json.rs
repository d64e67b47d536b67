//! The account as JSON; its schema is `driver/schema/diff.schema.json`.

use std::io::{self, Write};

use serde::Serialize;

use super::tell::{Account, Difference};

/// Version of the form.
const VERSION: u32 = 1;

/// Its JSON Schema.
pub const SCHEMA: &str = include_str!("../../../schema/diff.schema.json");

#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    level: &'static str,
    equal: bool,
    summary: &'a str,
    a: Program<'a>,
    b: Program<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    compared: Option<Compared>,
    notes: &'a [String],
    differences: Vec<One<'a>>,
    not_listed: u64,
}

#[derive(Serialize)]
struct Program<'a> {
    name: &'a str,
    dialect: &'a str,
}

#[derive(Serialize)]
struct Compared {
    same: u64,
    only_a: u64,
    only_b: u64,
    worlds: u32,
    skip_settings: usize,
    tolerance_mm: f64,
}

#[derive(Serialize)]
struct One<'a> {
    kind: &'static str,
    title: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    from: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    to: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    offset: Option<[f64; 6]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tool: Option<i64>,
    moves: [u64; 2],
    holes: [u64; 2],
    block_skip: &'a [u8],
    paired: bool,
    a: Vec<Place<'a>>,
    b: Vec<Place<'a>>,
    further_blocks: bool,
}

#[derive(Serialize)]
struct Place<'a> {
    line: u64,
    text: &'a str,
}

/// Writes it.
///
/// # Errors
/// Writing.
pub fn write(out: &mut dyn Write, account: &Account) -> io::Result<()> {
    let program = |side: usize| Program { name: &account.names[side], dialect: &account.dialects[side] };
    let compared = (account.level == "motion").then(|| Compared {
        same: account.same,
        only_a: account.unmatched[0],
        only_b: account.unmatched[1],
        worlds: account.worlds,
        skip_settings: account.settings,
        tolerance_mm: account.tolerance,
    });
    let document = Document {
        version: VERSION,
        level: account.level,
        equal: account.equal,
        summary: &account.summary,
        a: program(0),
        b: program(1),
        compared,
        notes: &account.notes,
        differences: account.differences.iter().map(one).collect(),
        not_listed: account.left_out,
    };
    serde_json::to_writer_pretty(&mut *out, &document)?;
    writeln!(out)
}

fn one(difference: &Difference) -> One<'_> {
    let side = |side: usize| {
        difference.blocks[side].iter().map(|block| Place { line: block.line, text: &block.text }).collect()
    };
    let value = |side: usize| difference.values.as_ref().map(|values| values[side].as_str());
    One {
        kind: difference.kind,
        title: &difference.title,
        from: value(0),
        to: value(1),
        offset: difference.offset.map(|by| by.map(|nanos| nanos as f64 / 1e9)),
        tool: difference.tool,
        moves: difference.moves,
        holes: difference.holes,
        block_skip: &difference.skip,
        paired: difference.paired,
        a: side(0),
        b: side(1),
        further_blocks: difference.more != [false; 2],
    }
}
