//! Whether what a profile says makes sense: all faults that its form alone does not show.

use std::collections::BTreeMap;
use std::ops::Range;

use ncc_dialects::{Dialect, Quantity, Role, SettingError, Settings, near};
use ncc_ir::canon::Axis;

use crate::fact::Fact;
use crate::reading::is_reading;
use crate::schema::{BlockNumbers, Emit, FileName, Schema};
use crate::table::{Key, Table};
use crate::wrong::{Lacks, Needs, ProfileError, Twice, Wrong};

/// Faults as they are found.
struct Found(Vec<ProfileError>);

/// Everything that is wrong.
pub(crate) fn check(schema: &Schema, dialect: &'static Dialect) -> Vec<ProfileError> {
    let mut found = Found(Vec::new());
    options(schema, dialect, &mut found);
    for key in schema.confirmed.keys() {
        if !is_reading(key.get_ref(), dialect) {
            found.add(Wrong::UnknownRow { row: key.get_ref().clone() }, key.span());
        }
    }
    sources(schema, &mut found);
    numbers(schema, &mut found);
    axes(schema, &mut found);
    tables(schema, dialect, &mut found);
    edges(schema, dialect, &mut found);
    programs(schema, dialect, &mut found);
    codes(schema, dialect, &mut found);
    emit(&schema.emit, dialect, &mut found);
    found.0
}

impl Found {
    fn add(&mut self, wrong: Wrong, span: Range<usize>) {
        self.0.push(ProfileError::new(wrong, span));
    }

    /// A number that must fit; what it takes is in the schema.
    fn number<T: Table>(&mut self, fact: &Fact<f64>, key: &'static str, fits: fn(f64) -> bool) {
        if fact.value.is_some_and(|value| !value.is_finite() || !fits(value)) {
            self.takes::<T>(key, fact.span.clone());
        }
    }

    fn takes<T: Table>(&mut self, key: &'static str, span: Range<usize>) {
        if let Some(takes) = T::KEYS.iter().find(|k: &&Key| k.name == key).map(|k| k.takes) {
            self.add(Wrong::Takes { key, takes }, span);
        }
    }

    /// Something that may stand once.
    fn once(
        &mut self,
        seen: &mut BTreeMap<String, Range<usize>>,
        name: String,
        what: Twice,
        span: Range<usize>,
    ) {
        match seen.get(&name) {
            Some(first) => {
                let error = ProfileError::new(Wrong::Twice { what }, span);
                self.0.push(ProfileError { related: Some(first.clone()), ..error });
            }
            None => {
                seen.insert(name, span);
            }
        }
    }
}

fn options(schema: &Schema, dialect: &'static Dialect, found: &mut Found) {
    let mut settings = Settings::new(dialect);
    for (option, choice) in &schema.options {
        let name = option.get_ref();
        let Some(row) = dialect.option.iter().find(|o| o.name == *name) else {
            let has = dialect.option.iter().map(|o| o.name.clone()).collect();
            found.add(Wrong::UnknownOption { option: name.clone(), has }, option.span());
            continue;
        };
        let Some(value) = &choice.value else { continue };
        if let Err(SettingError::NoOption(_) | SettingError::NoValue { .. }) = settings.choose(name, &value.0)
        {
            let wrong = Wrong::OptionValue {
                option: name.clone(),
                value: value.0.clone(),
                takes: row.values.clone(),
            };
            found.add(wrong, choice.span.clone());
        }
    }
}

/// Tags that no fact names, where a fact names one that is nearly the same: one of the two is misspelt.
fn sources(schema: &Schema, found: &mut Found) {
    let is_tag = |name: &str| schema.sources.keys().any(|tag| tag.get_ref() == name);
    let facts = schema.facts();
    let unknown = |name: &str| !name.is_empty() && !name.contains(' ') && !is_tag(name);
    for tag in schema.sources.keys() {
        if facts.iter().any(|fact| fact.source == *tag.get_ref()) {
            continue;
        }
        let names = facts.iter().map(|fact| fact.source.as_str()).filter(|name| unknown(name));
        let Some(nearest) = near(tag.get_ref(), names).first().map(|name| (*name).to_owned()) else {
            continue;
        };
        let fact = facts.iter().find(|fact| fact.source == nearest).map(|fact| fact.span.clone());
        let wrong = Wrong::UnusedSource { tag: tag.get_ref().clone(), nearest };
        found.0.push(ProfileError { related: fact, ..ProfileError::new(wrong, tag.span()) });
    }
}

fn above_zero(value: f64) -> bool {
    value > 0.0
}

fn from_zero(value: f64) -> bool {
    value >= 0.0
}

/// What no machine exceeds, mm or degrees: positions stay far from the ends of what can be reckoned with.
const FARTHEST: f64 = 1_000_000.0;

fn within(value: f64) -> bool {
    value.abs() <= FARTHEST
}

fn length(value: f64) -> bool {
    from_zero(value) && within(value)
}

fn numbers(schema: &Schema, found: &mut Found) {
    use crate::schema::{AxisRow, MCodeRow, Rates, Spindle, Times, ToolRow, ValueRow, WorkOffsetRow};
    let rates = &schema.rates;
    found.number::<Rates>(&rates.rapid, "rapid", above_zero);
    found.number::<Rates>(&rates.max_feed, "max_feed", above_zero);
    found.number::<Rates>(&rates.path_tolerance, "path_tolerance", from_zero);
    if rates.look_ahead.value == Some(0) {
        found.takes::<Rates>("look_ahead", rates.look_ahead.span.clone());
    }
    let times = &schema.times;
    found.number::<Times>(&times.tool_change, "tool_change", from_zero);
    found.number::<Times>(&times.spindle_start, "spindle_start", from_zero);
    found.number::<Times>(&times.spindle_stop, "spindle_stop", from_zero);
    found.number::<Times>(&times.m_function, "m_function", from_zero);
    found.number::<Times>(&times.block, "block", from_zero);
    found.number::<Spindle>(&schema.spindle.max_speed, "max_speed", above_zero);
    found.number::<Spindle>(&schema.spindle.acceleration, "acceleration", above_zero);
    for axis in schema.axis.iter().map(toml::Spanned::get_ref) {
        found.number::<AxisRow>(&axis.rapid, "rapid", above_zero);
        found.number::<AxisRow>(&axis.max_feed, "max_feed", above_zero);
        found.number::<AxisRow>(&axis.acceleration, "acceleration", above_zero);
        found.number::<AxisRow>(&axis.jerk, "jerk", above_zero);
    }
    for tool in schema.tool.iter().map(toml::Spanned::get_ref) {
        found.number::<ToolRow>(&tool.length, "length", length);
        found.number::<ToolRow>(&tool.diameter, "diameter", from_zero);
        found.number::<ToolRow>(&tool.corner, "corner", from_zero);
        found.number::<ToolRow>(&tool.angle, "angle", above_zero);
        found.number::<ToolRow>(&tool.end_diameter, "end_diameter", from_zero);
        found.number::<ToolRow>(&tool.flute, "flute", above_zero);
        found.number::<ToolRow>(&tool.shank, "shank", above_zero);
        found.number::<ToolRow>(&tool.holder, "holder", above_zero);
        found.number::<ToolRow>(&tool.holder_from, "holder_from", above_zero);
    }
    for offset in schema.work_offset.iter().map(toml::Spanned::get_ref) {
        let all = [&offset.x, &offset.y, &offset.z, &offset.a, &offset.b, &offset.c];
        for (key, value) in ["x", "y", "z", "a", "b", "c"].into_iter().zip(all) {
            found.number::<WorkOffsetRow>(value, key, within);
        }
    }
    for code in schema.m_code.iter().map(toml::Spanned::get_ref) {
        found.number::<MCodeRow>(&code.seconds, "seconds", from_zero);
    }
    for row in schema.value.iter().map(toml::Spanned::get_ref) {
        found.number::<ValueRow>(&row.holds, "holds", within);
    }
}

fn axes(schema: &Schema, found: &mut Found) {
    use crate::schema::AxisRow;
    let mut seen = BTreeMap::new();
    for row in &schema.axis {
        let axis = row.get_ref();
        let Some(letter) = &axis.letter.value else {
            found.add(Wrong::Missing { key: "letter", needs: Needs::Axis }, row.span());
            continue;
        };
        match letter.as_bytes() {
            [one] if Axis::from_letter(*one).is_some() => {
                found.once(
                    &mut seen,
                    letter.clone(),
                    Twice::Axis { letter: letter.clone() },
                    axis.letter.span.clone(),
                );
            }
            _ => found.takes::<AxisRow>("letter", axis.letter.span.clone()),
        }
        if let Some([low, high]) = axis.travel.value {
            if !low.is_finite() || !high.is_finite() {
                found.takes::<AxisRow>("travel", axis.travel.span.clone());
            } else if low >= high {
                found.add(Wrong::UpsideDown, axis.travel.span.clone());
            }
        }
    }
}

/// Whether a key is there and empty.
fn asked<T>(fact: &Fact<T>) -> bool {
    fact.value.is_none() && !fact.span.is_empty()
}

fn tables(schema: &Schema, dialect: &'static Dialect, found: &mut Found) {
    use crate::schema::{ToolRow, WorkOffsetRow};
    let (mut tools, mut pockets, mut offsets) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    let (mut entries, mut stated, mut names) = (BTreeMap::new(), Vec::new(), BTreeMap::new());
    for row in &schema.tool {
        let tool = row.get_ref();
        match tool.number.value {
            // `ncc doctor` writes rows to be filled in: they say nothing yet.
            None if asked(&tool.number) => {}
            None => found.add(Wrong::Missing { key: "number", needs: Needs::Tool }, row.span()),
            Some(n) => {
                found.once(&mut tools, n.to_string(), Twice::Tool { number: n }, tool.number.span.clone())
            }
        }
        let entry = &tool.length_entry;
        if entry.value == Some(0) {
            found.takes::<ToolRow>("length_entry", entry.span.clone());
        } else if entry.value.is_some() && dialect.letter_for(Role::ToolEdge).is_some() {
            let lacks = Lacks::LengthTable;
            found.add(Wrong::NoForm { key: "length_entry", lacks }, entry.span.clone());
        } else if let Some(n) = entry.value.or(tool.number.value).filter(|n| *n > 0) {
            match entry.value {
                Some(_) => stated.push((n, entry.span.clone())),
                // A tool twice is reported as that.
                None => drop(entries.entry(n).or_insert_with(|| tool.number.span.clone())),
            }
        }
        if let Some(name) = &tool.name.value {
            found.once(
                &mut names,
                name.clone(),
                Twice::ToolName { name: name.clone() },
                tool.name.span.clone(),
            );
        }
        if let Some(n) = tool.pocket.value {
            found.once(&mut pockets, n.to_string(), Twice::Pocket { number: n }, tool.pocket.span.clone());
        }
    }
    for (n, span) in stated {
        match entries.get(&n) {
            Some(first) => {
                let error = ProfileError::new(Wrong::Twice { what: Twice::LengthEntry { number: n } }, span);
                found.0.push(ProfileError { related: Some(first.clone()), ..error });
            }
            None => drop(entries.insert(n, span)),
        }
    }
    let mut names = BTreeMap::new();
    for row in &schema.work_offset {
        let offset = row.get_ref();
        if let Some(name) = &offset.name.value {
            let what = Twice::WorkOffsetName { name: name.clone() };
            found.once(&mut names, name.clone(), what, offset.name.span.clone());
        }
        let span = offset.number.span.clone();
        match offset.number.value {
            // `ncc doctor` writes rows to be filled in: they say nothing yet.
            None if asked(&offset.number) => {}
            None => found.add(Wrong::Missing { key: "number", needs: Needs::WorkOffset }, row.span()),
            Some(0) => found.takes::<WorkOffsetRow>("number", span),
            Some(n) => found.once(&mut offsets, n.to_string(), Twice::WorkOffset { number: n }, span),
        }
    }
}

/// Edges of tools other than the first: each has an entry that is nobody else's.
fn edges(schema: &Schema, dialect: &'static Dialect, found: &mut Found) {
    use crate::schema::EdgeRow;
    let mut seen = BTreeMap::new();
    let tools = schema.tool.iter().map(toml::Spanned::get_ref);
    let entries: Vec<u32> = tools.filter_map(|tool| tool.length_entry.value.or(tool.number.value)).collect();
    for row in &schema.edge {
        let edge = row.get_ref();
        if dialect.letter_for(Role::ToolEdge).is_some() {
            let lacks = Lacks::LengthTable;
            found.add(Wrong::NoForm { key: "length_entry", lacks }, row.span());
            continue;
        }
        let (Some(tool), Some(number), Some(entry)) =
            (edge.tool.value, edge.edge.value, edge.length_entry.value)
        else {
            if ![&edge.tool, &edge.edge, &edge.length_entry].into_iter().any(asked) {
                let needs = Needs::Edge;
                found.add(Wrong::Missing { key: "length_entry", needs }, row.span());
            }
            continue;
        };
        if tool == 0 {
            found.takes::<EdgeRow>("tool", edge.tool.span.clone());
        }
        if !(2..=9).contains(&number) {
            found.takes::<EdgeRow>("edge", edge.edge.span.clone());
        }
        if entry == 0 {
            found.takes::<EdgeRow>("length_entry", edge.length_entry.span.clone());
        }
        let what = Twice::Edge { tool, edge: number };
        found.once(&mut seen, format!("{tool}.{number}"), what, edge.edge.span.clone());
        let what = Twice::LengthEntry { number: entry };
        match entries.contains(&entry) {
            true => found.add(Wrong::Twice { what }, edge.length_entry.span.clone()),
            false => found.once(&mut seen, entry.to_string(), what, edge.length_entry.span.clone()),
        }
    }
}

/// Programs: a number has one name, and a name one number.
fn programs(schema: &Schema, dialect: &'static Dialect, found: &mut Found) {
    use crate::schema::ProgramRow;
    let (mut numbers, mut names) = (BTreeMap::new(), BTreeMap::new());
    let digits = dialect.caps.flow.call_digits;
    for row in &schema.program {
        let program = row.get_ref();
        let span = program.number.span.clone();
        match program.number.value {
            // `ncc doctor` writes rows to be filled in: they say nothing yet.
            None if asked(&program.number) => {}
            None => found.add(Wrong::Missing { key: "number", needs: Needs::Program }, row.span()),
            Some(0) => found.takes::<ProgramRow>("number", span),
            Some(n) if digits > 0 && n >= 10u32.saturating_pow(digits) => {
                found.takes::<ProgramRow>("number", span);
            }
            Some(n) => found.once(&mut numbers, n.to_string(), Twice::Program { number: n }, span),
        }
        let Some(name) = &program.name.value else { continue };
        let plain = |b: u8| b.is_ascii_alphanumeric() || b == b'_';
        if !name.bytes().all(plain) || !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
            found.takes::<ProgramRow>("name", program.name.span.clone());
            continue;
        }
        let what = Twice::ProgramName { name: name.clone() };
        found.once(&mut names, name.to_ascii_uppercase(), what, program.name.span.clone());
    }
}

fn codes(schema: &Schema, dialect: &'static Dialect, found: &mut Found) {
    use crate::schema::MCodeRow;
    let (mut codes, mut functions) = (BTreeMap::new(), BTreeMap::<&str, Range<usize>>::new());
    for row in &schema.m_code {
        let m = row.get_ref();
        // A row without its code says nothing yet: `ncc doctor` writes such rows to be filled in.
        let Some(code) = &m.code.value else { continue };
        let number = code.strip_prefix('M').filter(|n| n.len() <= 4 && n.bytes().all(|b| b.is_ascii_digit()));
        let Some(number) = number.and_then(|n| n.parse::<u32>().ok()) else {
            found.takes::<MCodeRow>("code", m.code.span.clone());
            continue;
        };
        if let Some(means) = dialect.code_row(b'M', number * 10).and_then(|known| known.means) {
            let means = means.to_string();
            found.add(Wrong::CodeKnown { code: code.clone(), means }, m.code.span.clone());
        }
        found.once(&mut codes, number.to_string(), Twice::Code { code: code.clone() }, m.code.span.clone());
        let Some(function) = &m.function.value else { continue };
        let plain = |b: u8| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-';
        if !function.bytes().all(plain) || !function.starts_with(|c: char| c.is_ascii_lowercase()) {
            found.takes::<MCodeRow>("function", m.function.span.clone());
        } else if let Some(first) = functions.get(function.as_str()) {
            let wrong = Wrong::NotOneToOne { function: function.clone() };
            let error = ProfileError::new(wrong, m.function.span.clone());
            found.0.push(ProfileError { related: Some(first.clone()), ..error });
        } else {
            functions.insert(function, m.function.span.clone());
        }
    }
}

fn emit(emit: &Emit, dialect: &'static Dialect, found: &mut Found) {
    let length = dialect.numbers(Quantity::Length);
    let inch = length.decimals_inch.unwrap_or(length.decimals);
    for (fact, key, most) in
        [(&emit.decimals, "decimals", length.decimals), (&emit.decimals_inch, "decimals_inch", inch)]
    {
        if fact.value.is_some_and(|n| n > u32::from(most)) {
            found.add(Wrong::TooFine { key, most }, fact.span.clone());
        }
    }
    let numbers = &emit.block_numbers;
    if matches!(numbers.value, Some(BlockNumbers::New | BlockNumbers::Keep)) && dialect.block.number.is_none()
    {
        let lacks = Lacks::BlockNumbers;
        found.add(Wrong::NoForm { key: "block_numbers", lacks }, numbers.span.clone());
    }
    if numbers.value == Some(BlockNumbers::New) {
        for (fact, key) in [(&emit.first_number, "first_number"), (&emit.number_step, "number_step")] {
            if fact.value.is_none() {
                let needs = Needs::NewNumbers;
                found.add(Wrong::Missing { key, needs }, numbers.span.clone());
            }
        }
    }
    let most = 99_999;
    if emit.first_number.value.is_some_and(|n| n > most) {
        found.takes::<Emit>("first_number", emit.first_number.span.clone());
    }
    if emit.number_step.value.is_some_and(|n| n == 0 || n > most) {
        found.takes::<Emit>("number_step", emit.number_step.span.clone());
    }
    for (fact, key) in [(&emit.header, "header"), (&emit.footer, "footer")] {
        let lines = fact.value.as_deref().unwrap_or_default();
        if !lines.is_empty() && dialect.comment.open.is_empty() {
            found.add(Wrong::NoForm { key, lacks: Lacks::Comments }, fact.span.clone());
        }
        if lines.iter().any(|line| line.chars().any(char::is_control)) {
            found.takes::<Emit>(key, fact.span.clone());
        }
    }
    let by_number = emit.file_name.value == Some(FileName::ProgramNumber);
    if by_number && dialect.program.number.is_none() {
        let lacks = Lacks::ProgramNumbers;
        found.add(Wrong::NoForm { key: "file_name", lacks }, emit.file_name.span.clone());
    }
    if let Some(extension) = &emit.extension.value
        && !extension.bytes().all(|b| b.is_ascii_alphanumeric())
    {
        found.takes::<Emit>("extension", emit.extension.span.clone());
    }
}
