//! `ncc machines` and `ncc machines show`: what is stated of a machine, and what is not.

use std::fmt::{self, Write};

use ncc_machines::table::{Stated, Tell};
use ncc_machines::{Profile, Row};

use super::machine;

/// One line for each profile.
pub fn list(profiles: &[Profile]) -> String {
    let wide = profiles.iter().map(|p| p.id().len()).max().unwrap_or(0);
    let mut text = String::new();
    for profile in profiles {
        let typical = if profile.schema.typical { " (typical)" } else { "" };
        let (id, dialect) = (profile.id(), &profile.dialect.id);
        text.push_str(&format!("{id:wide$}  {dialect:<8}  {}{typical}\n", profile.schema.title));
    }
    text
}

/// The line that opens what is reported of a machine; a profile need have no title.
pub fn headline(profile: &Profile) -> String {
    match profile.schema.title.as_str() {
        "" => format!("{}\n", profile.id()),
        title => format!("{}: {title}\n", profile.id()),
    }
}

/// Everything that a profile states, and what it does not.
pub fn show(profile: &Profile) -> String {
    let mut text = String::new();
    // Writing into a text cannot fail.
    let _ = write_all(&mut text, profile);
    text
}

fn write_all(out: &mut String, profile: &Profile) -> fmt::Result {
    let s = &profile.schema;
    out.push_str(&headline(profile));
    let dialect =
        machine("dialect").text("dialect", &profile.dialect.id).text("title", &profile.dialect.title);
    writeln!(out, "{}", dialect.headline())?;
    if s.typical {
        writeln!(out, "{}", machine("typical").headline())?;
    }
    if !s.notes.is_empty() {
        writeln!(out, "{}", s.notes)?;
    }
    writeln!(out, "{}", machine("legend").headline())?;
    options(out, profile)?;
    confirmed(out, profile)?;
    for row in profile.rows() {
        table(out, &row)?;
    }
    if !s.sources.is_empty() {
        write!(out, "\nSources:\n")?;
        for (tag, source) in &s.sources {
            writeln!(out, "  {tag:<10}  {source}")?;
        }
    }
    Ok(())
}

fn options(out: &mut String, profile: &Profile) -> fmt::Result {
    let rows = &profile.dialect.option;
    let facts: Vec<Stated> = rows
        .iter()
        .map(|row| {
            let chosen = profile.schema.options.iter().find(|(name, _)| *name.get_ref() == row.name);
            let stated = chosen.map(|(_, choice)| choice.tell("")).filter(|stated| stated.value.is_some());
            stated.unwrap_or(Stated {
                key: "",
                value: None,
                source: String::new(),
                assumed: false,
                span: 0..0,
            })
        })
        .collect();
    if rows.is_empty() {
        return Ok(());
    }
    write!(out, "\n[options]\n")?;
    let named: Vec<(&str, Stated)> = rows.iter().map(|row| row.name.as_str()).zip(facts).collect();
    lines(out, &named)
}

fn confirmed(out: &mut String, profile: &Profile) -> fmt::Result {
    let d = profile.dialect;
    let unsure = d.code.iter().filter(|r| !r.sure).count()
        + d.address.iter().filter(|r| !r.sure).count()
        + d.cycle.iter().filter(|r| !r.sure).count()
        + d.name.iter().filter(|r| !r.sure).count()
        + d.call.iter().filter(|r| !r.sure).count();
    let rows = &profile.schema.confirmed;
    if rows.is_empty() && unsure == 0 {
        return Ok(());
    }
    write!(out, "\n[confirmed]\n")?;
    let named: Vec<(&str, Stated)> =
        rows.iter().map(|(name, yes)| (name.get_ref().as_str(), yes.tell(""))).collect();
    lines(out, &named)?;
    if unsure > 0 {
        let unsure = machine("unconfirmed").text("rows", unsure.to_string()).text("dialect", &d.id);
        writeln!(out, "  {}", unsure.headline())?;
    }
    Ok(())
}

fn table(out: &mut String, row: &Row) -> fmt::Result {
    write!(out, "\n{}\n", row.head)?;
    let named: Vec<(&str, Stated)> = row.facts.iter().map(|fact| (fact.key, fact.clone())).collect();
    lines(out, &named)
}

/// What is stated, one fact a line, and the names of what is not.
fn lines(out: &mut String, facts: &[(&str, Stated)]) -> fmt::Result {
    let wide = facts.iter().filter(|(_, f)| f.value.is_some()).map(|(name, _)| name.len()).max().unwrap_or(0);
    for (name, fact) in facts {
        let Some(value) = &fact.value else { continue };
        let mark = if fact.assumed { '~' } else { ' ' };
        let line = format!("{mark} {name:wide$}  {value:<14}  {}", fact.source);
        writeln!(out, "{}", line.trim_end())?;
    }
    let missing: Vec<&str> = facts.iter().filter(|(_, f)| f.value.is_none()).map(|(name, _)| *name).collect();
    if !missing.is_empty() {
        writeln!(out, "  not stated: {}", missing.join(", "))?;
    }
    Ok(())
}
