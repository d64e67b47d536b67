//! `ncc dialects`: what the dictionaries know, and how sure of it they are.

use std::fmt::{self, Write};

use ncc_dialects::{BehaviourRow, Dialect, OptionRow, PatternRow, PowerOn, PowerOnFact, VariantRow};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::ReturnLevel;
use ncc_ir::caps::ReturnsTo;

use super::messages::message::{Message, Part};
use super::text::plain;

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
        writeln!(out, "{}", shown("base").text("base", base).headline())?;
    }
    if let Some(extension) = d.extensions.first() {
        writeln!(out, "{}", shown("extension").text("extension", extension).headline())?;
    }
    let rows = d.code.len() + d.address.len() + d.cycle.len() + d.name.len() + d.call.len();
    let unsure = d.code.iter().filter(|r| !r.sure).count()
        + d.address.iter().filter(|r| !r.sure).count()
        + d.cycle.iter().filter(|r| !r.sure).count()
        + d.name.iter().filter(|r| !r.sure).count()
        + d.call.iter().filter(|r| !r.sure).count();
    if rows > 0 {
        let rows = shown("rows").text("rows", rows.to_string()).text("unsure", unsure.to_string());
        writeln!(out, "{}", rows.headline())?;
    }
    behaviours(out, d)?;
    options(out, d)?;
    capabilities(out, d)?;
    codes(out, d)?;
    names(out, d)?;
    calls(out, d)?;
    functions(out, d)?;
    addresses(out, d)?;
    variants(out, d)?;
    power_on(out, &d.power_on)?;
    if !d.sources.is_empty() {
        heading(out, &shown("sources"))?;
        for (tag, source) in &d.sources {
            writeln!(out, "  {tag:<12}  {source}")?;
        }
    }
    Ok(())
}

/// An entry about a dictionary that is shown.
fn shown(form: &'static str) -> Message {
    Message::part(Part::Dialect, form)
}

fn heading(out: &mut String, text: &Message) -> fmt::Result {
    write!(out, "\n{}:\n", text.headline())
}

fn functions(out: &mut String, d: &Dialect) -> fmt::Result {
    if d.functions.is_empty() {
        return Ok(());
    }
    heading(out, &shown("functions"))?;
    for (name, row) in &d.functions {
        let codes = row.until.as_ref().map_or(name.clone(), |until| format!("{name} … {until}"));
        let does = shown("function")
            .text("program", plain(&row.program()))
            .text("seconds", row.time_limit.to_string())
            .headline();
        writeln!(out, "  {codes:<14}  {does}")?;
    }
    Ok(())
}

fn options(out: &mut String, d: &Dialect) -> fmt::Result {
    if d.option.is_empty() {
        return Ok(());
    }
    heading(out, &shown("options"))?;
    for row in &d.option {
        let values = match row.values.is_empty() {
            true => shown("number-value").text("default", &row.default).headline(),
            false => {
                let mark = |value: &String| match *value == row.default {
                    true => shown("default-value").text("value", value).headline(),
                    false => value.clone(),
                };
                row.values.iter().map(mark).collect::<Vec<_>>().join(", ")
            }
        };
        writeln!(out, "  {}: {values}", row.name)?;
        writeln!(out, "      {}", option_about(d, row))?;
        writeln!(out, "      {}", shown("source").text("source", &row.source).headline())?;
    }
    Ok(())
}

/// The text of an option: its own words, or those of the behaviour that it settles.
pub fn option_about<'d>(d: &'d Dialect, option: &OptionRow) -> String {
    let settles = |row: &&BehaviourRow| {
        row.open && Behaviour::named(&row.name).is_some_and(|behaviour| behaviour.option() == option.name)
    };
    let of_variant = || {
        let found = |variant: &'d VariantRow| Some((variant.behaviour.iter().find(settles)?, Some(variant)));
        d.variant.iter().find_map(found)
    };
    let found = d.behaviour.iter().find(settles).map(|row| (row, None)).or_else(of_variant);
    let Some((row, variant)) = found.filter(|_| option.doc.is_empty()) else { return option.doc.clone() };
    let form = if variant.is_some() { "behaviour-option-variant" } else { "behaviour-option" };
    let when = variant.map_or(String::new(), |variant| {
        let when: Vec<String> =
            variant.when.iter().map(|(name, value)| format!("`{name}={value}`")).collect();
        when.join(", ")
    });
    let about = Behaviour::named(&row.name).map_or("", Behaviour::about);
    shown(form).text("about", about).text("usual", &row.value).text("when", when).headline()
}

fn capabilities(out: &mut String, d: &Dialect) -> fmt::Result {
    heading(out, &shown("capabilities"))?;
    let caps = &d.caps;
    let word = |form| shown(form).headline();
    let yes = |yes: bool| word(if yes { "yes" } else { "no" });
    let mut row = |name, value: &str| writeln!(out, "  {:<28}  {value}", word(name));
    if d.can.everything {
        return row("everything", &word("everything-value"));
    }
    if caps.flat {
        row("form", &word("form-flat"))?;
    }
    if !caps.holes.cycles.is_empty() {
        let kinds: Vec<&str> = caps.holes.cycles.iter().map(|c| c.kind.as_str()).collect();
        row("cycles", &kinds.join(", "))?;
        row(
            "return",
            &word(match d.cycles.return_level.map(ReturnLevel::from) {
                None if caps.holes.returns == ReturnsTo::Plane => "return-stated",
                None => "return-either",
                Some(ReturnLevel::Initial) => "return-initial",
                Some(ReturnLevel::Retract) => "return-retract",
            }),
        )?;
    }
    let patterns: Vec<String> = d
        .pattern
        .iter()
        .map(|p| match p {
            PatternRow::Circle { .. } => word("bolt-circle"),
            PatternRow::Grid { .. } => word("grid"),
        })
        .collect();
    let named = d.call.iter().filter(|c| c.kind.cycles().is_empty()).map(|c| c.name.clone());
    let patterns: Vec<String> = patterns.into_iter().chain(named).collect();
    if !patterns.is_empty() {
        row("patterns", &patterns.join(", "))?;
    }
    row("subprograms", &yes(caps.flow.calls))?;
    row("repeats", &yes(caps.flow.repeats || caps.flow.repeat_blocks))?;
    row("frames", &yes(caps.frames.chain))?;
    row("machine", &yes(caps.machine.coordinates))?;
    let offsets = match caps.frames.work_offsets {
        0 => word("one-offset"),
        u16::MAX => word("any-offset"),
        n => n.to_string(),
    };
    row("work-offsets", &offsets)?;
    row("incremental", &yes(caps.modes.incremental))?;
    row("helices", &yes(caps.arcs.helix))?;
    row("radius", &yes(caps.arcs.by_radius))?;
    let skip = match caps.flow.skip_levels {
        0 => word("no"),
        1 => word("one-switch"),
        n => shown("switches").text("number", n.to_string()).headline(),
    };
    row("skip", &skip)?;
    row("operator", &yes(caps.modes.messages))
}

fn codes(out: &mut String, d: &Dialect) -> fmt::Result {
    if d.code.is_empty() {
        return Ok(());
    }
    let mark = |sure: bool| if sure { ' ' } else { '?' };
    heading(out, &shown("codes"))?;
    for row in d.code.iter().filter(|r| r.refuse.is_none()) {
        let mut meaning = row.means.map(|m| m.to_string()).unwrap_or_default();
        if let Some(cycle) = d.cycle_row(&row.code) {
            meaning = format!("{meaning} {}", cycle.kind);
        }
        writeln!(out, "{} {:<6}  {meaning:<38}  {}", mark(row.sure), row.code, row.source)?;
    }
    heading(out, &shown("refused-codes"))?;
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
        heading(out, &shown("variant").text("options", when.join(", ")))?;
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
    heading(out, &shown("names"))?;
    for row in d.name.iter().filter(|r| r.refuse.is_none()) {
        let address = || row.role.map(|role| spaced(&format!("{role:?}")));
        let meaning = row.means.map(|m| m.to_string()).or_else(address).unwrap_or_default();
        writeln!(out, "{} {:<8}  {meaning:<36}  {}", mark(row.sure), row.name, row.source)?;
    }
    heading(out, &shown("refused-names"))?;
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
    heading(out, &shown("calls"))?;
    for row in &d.call {
        let mark = if row.sure { ' ' } else { '?' };
        let what = spaced(&format!("{:?}", row.kind));
        let arguments: Vec<&str> = row.parameters.iter().map(|p| p.name.as_str()).collect();
        writeln!(out, "{mark} {}({}): {what}", row.name, arguments.join(","))?;
        writeln!(out, "      {}", shown("source").text("source", &row.source).headline())?;
    }
    Ok(())
}

fn addresses(out: &mut String, d: &Dialect) -> fmt::Result {
    if d.address.is_empty() {
        return Ok(());
    }
    heading(out, &shown("addresses"))?;
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
    heading(out, &shown("behaviours"))?;
    for row in &d.behaviour {
        let mark = if row.open { '?' } else { ' ' };
        let codes = row.codes.join(" ");
        writeln!(out, "{mark} {codes:<12}  {:<26}  {:<13}  {}", row.name, row.value, row.source)?;
    }
    Ok(())
}

fn power_on(out: &mut String, facts: &PowerOn) -> fmt::Result {
    let mut rows = Vec::new();
    fact(&mut rows, "units", facts.units.as_ref());
    fact(&mut rows, "distance", facts.distance.as_ref());
    fact(&mut rows, "plane", facts.plane.as_ref());
    fact(&mut rows, "feed-mode", facts.feed_mode.as_ref());
    fact(&mut rows, "return-level", facts.return_level.as_ref());
    fact(&mut rows, "motion", facts.motion.as_ref());
    fact(&mut rows, "work-offset", facts.work_offset.as_ref());
    fact(&mut rows, "length-offset", facts.length_offset.as_ref());
    fact(&mut rows, "no-shift", facts.no_origin_shift.as_ref());
    fact(&mut rows, "corners", facts.path.as_ref());
    if rows.is_empty() {
        return Ok(());
    }
    heading(out, &shown("power-on"))?;
    for row in rows {
        writeln!(out, "{row}")?;
    }
    Ok(())
}

fn fact<T: fmt::Debug>(rows: &mut Vec<String>, name: &'static str, fact: Option<&PowerOnFact<T>>) {
    if let Some(fact) = fact {
        let mark = if fact.always { '*' } else { ' ' };
        let value = spaced(&format!("{:?}", fact.value));
        let name = shown(name).headline();
        rows.push(format!("{mark} {name:<16}  {value:<14}  {}", fact.source));
    }
}
