//! `ncc dialects`: what the dictionaries know, and how sure of it they are.

use std::fmt::{self, Write};

use ncc_dialects::{Dialect, PatternRow, PowerOn, PowerOnFact};
use ncc_ir::canon::ReturnLevel;
use ncc_ir::caps::ReturnsTo;

/// The form of a dictionary, for whoever writes one.
pub const SCHEMA: &str = include_str!("../../../docs/book/src/reference/dialect.md");

/// One line for each dialect.
pub fn list(dialects: &[&Dialect]) -> String {
    let wide = dialects.iter().map(|d| d.id.len()).max().unwrap_or(0);
    let mut text = String::new();
    for d in dialects {
        text.push_str(&format!("{:wide$}  {}\n", d.id, d.title));
    }
    text
}

/// Everything that a dictionary says.
pub fn show(dialect: &Dialect) -> String {
    let mut text = String::new();
    // Writing into a text cannot fail.
    let _ = write_all(&mut text, dialect);
    text
}

fn write_all(out: &mut String, d: &Dialect) -> fmt::Result {
    writeln!(out, "{}: {}", d.id, d.title)?;
    if let Some(base) = &d.base {
        writeln!(out, "builds on: {base}")?;
    }
    if let Some(extension) = d.extensions.first() {
        writeln!(out, "usual extension: .{extension}")?;
    }
    let rows = d.code.len() + d.address.len() + d.cycle.len() + d.name.len() + d.call.len();
    let unsure = d.code.iter().filter(|r| !r.sure).count()
        + d.address.iter().filter(|r| !r.sure).count()
        + d.cycle.iter().filter(|r| !r.sure).count()
        + d.name.iter().filter(|r| !r.sure).count()
        + d.call.iter().filter(|r| !r.sure).count();
    if rows > 0 {
        writeln!(out, "{rows} rows, {unsure} of them unconfirmed (marked ?)")?;
    }
    behaviours(out, d)?;
    options(out, d)?;
    capabilities(out, d)?;
    codes(out, d)?;
    names(out, d)?;
    calls(out, d)?;
    addresses(out, d)?;
    variants(out, d)?;
    power_on(out, &d.power_on)?;
    if !d.sources.is_empty() {
        heading(out, "Sources")?;
        for (tag, source) in &d.sources {
            writeln!(out, "  {tag:<12}  {source}")?;
        }
    }
    Ok(())
}

fn heading(out: &mut String, text: &str) -> fmt::Result {
    write!(out, "\n{text}:\n")
}

fn options(out: &mut String, d: &Dialect) -> fmt::Result {
    if d.option.is_empty() {
        return Ok(());
    }
    heading(out, "Options (--from-option, --to-option NAME=VALUE)")?;
    for row in &d.option {
        let values = match row.values.is_empty() {
            true => format!("a number, {}", row.default),
            false => {
                let mark = |v: &String| if *v == row.default { format!("{v} (default)") } else { v.clone() };
                row.values.iter().map(mark).collect::<Vec<_>>().join(", ")
            }
        };
        writeln!(out, "  {}: {values}", row.name)?;
        writeln!(out, "      {}", row.doc)?;
        writeln!(out, "      source: {}", row.source)?;
    }
    Ok(())
}

fn capabilities(out: &mut String, d: &Dialect) -> fmt::Result {
    heading(out, "What can be said in it")?;
    let caps = &d.caps;
    let yes = |yes: bool| if yes { "yes" } else { "no" };
    let mut row = |name: &str, value: &str| writeln!(out, "  {name:<28}  {value}");
    if d.can.everything {
        return row("everything", "whatever the neutral program can hold");
    }
    if caps.flat {
        row("form", "a list of events; cycles, patterns, calls and repeats are written out")?;
    }
    if !caps.holes.cycles.is_empty() {
        let kinds: Vec<&str> = caps.holes.cycles.iter().map(|c| c.kind.as_str()).collect();
        row("cycles", &kinds.join(", "))?;
        row(
            "cycles return to",
            match d.cycles.return_level.map(ReturnLevel::from) {
                None if caps.holes.returns == ReturnsTo::Plane => "a stated plane",
                None => "the initial level or the retract plane",
                Some(ReturnLevel::Initial) => "the initial level",
                Some(ReturnLevel::Retract) => "the retract plane",
            },
        )?;
    }
    let patterns: Vec<&str> = d
        .pattern
        .iter()
        .map(|p| match p {
            PatternRow::Circle { .. } => "bolt circle",
            PatternRow::Grid { .. } => "grid",
        })
        .collect();
    let named = d.call.iter().filter(|c| c.kind.cycles().is_empty()).map(|c| c.name.as_str());
    let patterns: Vec<&str> = patterns.into_iter().chain(named).collect();
    if !patterns.is_empty() {
        row("patterns of holes", &patterns.join(", "))?;
    }
    row("subprograms", yes(caps.flow.calls))?;
    row("repetition of blocks", yes(caps.flow.repeats || caps.flow.repeat_blocks))?;
    row("frames", yes(caps.frames.chain))?;
    row("machine coordinates", yes(caps.machine.coordinates))?;
    let offsets = match caps.frames.work_offsets {
        0 => "one, without a word for it".to_owned(),
        u16::MAX => "any number".to_owned(),
        n => n.to_string(),
    };
    row("work offsets", &offsets)?;
    row("incremental coordinates", yes(caps.modes.incremental))?;
    row("helices", yes(caps.arcs.helix))?;
    row("arcs by radius", yes(caps.arcs.by_radius))?;
    let skip = match caps.flow.skip_levels {
        0 => "no".to_owned(),
        1 => "one switch".to_owned(),
        n => format!("{n} switches"),
    };
    row("block skip", &skip)?;
    row("messages to the operator", yes(caps.modes.messages))
}

fn codes(out: &mut String, d: &Dialect) -> fmt::Result {
    if d.code.is_empty() {
        return Ok(());
    }
    let mark = |sure: bool| if sure { ' ' } else { '?' };
    heading(out, "Codes (word, meaning, source)")?;
    for row in d.code.iter().filter(|r| r.refuse.is_none()) {
        let mut meaning = row.means.map(|m| m.to_string()).unwrap_or_default();
        if let Some(cycle) = d.cycle_row(&row.code) {
            meaning = format!("{meaning} {}", cycle.kind);
        }
        writeln!(out, "{} {:<6}  {meaning:<38}  {}", mark(row.sure), row.code, row.source)?;
    }
    heading(out, "Codes that are known and refused")?;
    for row in &d.code {
        let Some(name) = &row.refuse else { continue };
        writeln!(out, "{} {:<6}  {name:<38}  {}", mark(row.sure), row.code, row.source)?;
    }
    Ok(())
}

/// What a dictionary has under options.
fn variants(out: &mut String, d: &Dialect) -> fmt::Result {
    let mark = |sure: bool| if sure { ' ' } else { '?' };
    for variant in &d.variant {
        let when: Vec<String> =
            variant.when.iter().map(|(option, value)| format!("{option}={value}")).collect();
        heading(out, &format!("With {} (word, meaning or refusal, source)", when.join(", ")))?;
        for row in &variant.code {
            let cycle = variant.cycle.iter().find(|cycle| cycle.code == row.code);
            let means = row.means.map(|m| m.to_string()).or_else(|| row.refuse.clone());
            let kind = cycle.map_or_else(String::new, |cycle| format!(" {}", cycle.kind));
            let means = means.unwrap_or_default() + &kind;
            writeln!(out, "{} {:<6}  {means:<38}  {}", mark(row.sure), row.code, row.source)?;
        }
        for row in &variant.name {
            let means = row.means.map(|m| m.to_string()).or_else(|| row.refuse.clone()).unwrap_or_default();
            writeln!(out, "{} {:<6}  {means:<38}  {}", mark(row.sure), row.name, row.source)?;
        }
        for row in &variant.address {
            let role = spaced(&format!("{:?}", row.role));
            writeln!(out, "{} {:<6}  {role:<38}  {}", mark(row.sure), row.letter, row.source)?;
        }
        for row in &variant.behaviour {
            writeln!(out, "  {:<6}  {} {}: {}", row.codes.join(" "), row.name, row.value, row.source)?;
        }
    }
    Ok(())
}

fn names(out: &mut String, d: &Dialect) -> fmt::Result {
    if d.name.is_empty() {
        return Ok(());
    }
    let mark = |sure: bool| if sure { ' ' } else { '?' };
    heading(out, "Words of several letters (word, meaning, source)")?;
    for row in d.name.iter().filter(|r| r.refuse.is_none()) {
        let address = || row.role.map(|role| spaced(&format!("{role:?}")));
        let meaning = row.means.map(|m| m.to_string()).or_else(address).unwrap_or_default();
        writeln!(out, "{} {:<8}  {meaning:<36}  {}", mark(row.sure), row.name, row.source)?;
    }
    heading(out, "Words of several letters that are known and refused")?;
    for row in &d.name {
        let Some(name) = &row.refuse else { continue };
        writeln!(out, "{} {:<8}  {name:<36}  {}", mark(row.sure), row.name, row.source)?;
    }
    Ok(())
}

fn calls(out: &mut String, d: &Dialect) -> fmt::Result {
    if d.call.is_empty() {
        return Ok(());
    }
    heading(out, "Cycles and patterns that are called (name, meaning, arguments, source)")?;
    for row in &d.call {
        let mark = if row.sure { ' ' } else { '?' };
        let what = spaced(&format!("{:?}", row.kind));
        let arguments: Vec<&str> = row.parameters.iter().map(|p| p.name.as_str()).collect();
        writeln!(out, "{mark} {}({}): {what}", row.name, arguments.join(","))?;
        writeln!(out, "      source: {}", row.source)?;
    }
    Ok(())
}

fn addresses(out: &mut String, d: &Dialect) -> fmt::Result {
    if d.address.is_empty() {
        return Ok(());
    }
    heading(out, "Words (letter, what it is, source)")?;
    for row in &d.address {
        let mark = if row.sure { ' ' } else { '?' };
        let what = spaced(&format!("{:?}, {:?}", row.role, row.quantity));
        writeln!(out, "{mark} {:<6}  {what:<38}  {}", row.letter, row.source)?;
    }
    Ok(())
}

/// `CentreX` as `centre x`.
pub fn spaced(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !text.is_empty() && !text.ends_with(' ') {
            text.push(' ');
        }
        text.push(c.to_ascii_lowercase());
    }
    text
}

fn behaviours(out: &mut String, d: &Dialect) -> fmt::Result {
    if d.behaviour.is_empty() {
        return Ok(());
    }
    heading(out, "What codes do besides their names (? is open: an option of the same name states it)")?;
    for row in &d.behaviour {
        let mark = if row.open { '?' } else { ' ' };
        let codes = row.codes.join(" ");
        writeln!(out, "{mark} {codes:<12}  {:<26}  {:<13}  {}", row.name, row.value, row.source)?;
    }
    Ok(())
}

fn power_on(out: &mut String, facts: &PowerOn) -> fmt::Result {
    let mut rows = Vec::new();
    fact(&mut rows, "unit of length", facts.units.as_ref());
    fact(&mut rows, "distance mode", facts.distance.as_ref());
    fact(&mut rows, "plane", facts.plane.as_ref());
    fact(&mut rows, "feed mode", facts.feed_mode.as_ref());
    fact(&mut rows, "return level", facts.return_level.as_ref());
    fact(&mut rows, "motion", facts.motion.as_ref());
    fact(&mut rows, "work offset", facts.work_offset.as_ref());
    fact(&mut rows, "length offset", facts.length_offset.as_ref());
    fact(&mut rows, "no origin shift", facts.no_origin_shift.as_ref());
    fact(&mut rows, "corners", facts.path.as_ref());
    if rows.is_empty() {
        return Ok(());
    }
    heading(out, "At power-on (* is always so; else taken for granted, and told)")?;
    for row in rows {
        writeln!(out, "{row}")?;
    }
    Ok(())
}

fn fact<T: fmt::Debug>(rows: &mut Vec<String>, name: &str, fact: Option<&PowerOnFact<T>>) {
    if let Some(fact) = fact {
        let mark = if fact.always { '*' } else { ' ' };
        let value = spaced(&format!("{:?}", fact.value));
        rows.push(format!("{mark} {name:<16}  {value:<14}  {}", fact.source));
    }
}
