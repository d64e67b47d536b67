//! Two machines' names for the same things: the maps of numbers from one to the other.
//!
//! Tools, work offsets and programs that have one name are one. [`maps`] is for writing, and goes from
//! the source's numbers; [`renaming`] is for judging what was written, and maps back from the target's
//! rows by a way of its own, so that a fault of the first shows.

use std::collections::BTreeMap;

use ncc_dialects::Dialect;
use ncc_exec::maps::{Maps, Renaming};
use ncc_ir::program::Text;
use ncc_ir::program::numbered::Numbered;

use crate::fact::Fact;
use crate::profile::Profile;
use crate::schema::{ToolRow, WorkOffsetRow};

/// The target's numbers of what the source calls by its own. Tools and work offsets are mapped where
/// both machines name any; programs by what either says, as their controls call by number or by name.
pub fn maps(from: Option<&Profile>, to: Option<&Profile>, target: &Dialect) -> Maps {
    let mut maps = numbers(from, to, target);
    let Some(to) = to.filter(|_| !target.caps.tools.names) else { return maps };
    // Whose length has another number is known only where numbers go by names altogether.
    let told = |tool: &Tool| tool.entry == tool.number || maps.tools.is_some();
    let named = tools(to).into_iter().filter(|(_, tool)| told(tool));
    maps.tool_names = named.map(|(name, tool)| (name.into(), tool.number)).collect();
    maps
}

/// The maps of what the source calls by numbers, and of programs.
fn numbers(from: Option<&Profile>, to: Option<&Profile>, target: &Dialect) -> Maps {
    let mut maps = Maps::default();
    if target.caps.flow.calls {
        programs(from, to, target.caps.flow.call_digits > 0, &mut maps);
    }
    let (Some(from), Some(to)) = (from, to) else { return maps };
    let (ours, theirs) = (tools(from), tools(to));
    if !ours.is_empty() && !theirs.is_empty() {
        let (mut numbers, mut entries) = (BTreeMap::new(), BTreeMap::new());
        for (name, tool) in &ours {
            let Some(other) = theirs.get(name) else {
                maps.unmatched.insert((Numbered::Tool, tool.number), (*name).into());
                maps.unmatched.insert((Numbered::LengthEntry, tool.entry), (*name).into());
                continue;
            };
            numbers.insert(tool.number, other.number);
            if tool.entry > 0 && other.entry > 0 {
                entries.insert(tool.entry, other.entry);
            }
        }
        // No tool is no tool, unless one of them has a tool of that number.
        if !ours.values().chain(theirs.values()).any(|tool| tool.number == 0) {
            numbers.insert(0, 0);
        }
        (maps.tools, maps.entries) = (Some(numbers), Some(entries));
        maps.edge_entries = to.tables().edge_entries;
    }
    let (ours, theirs) = (offsets(from), offsets(to));
    if !ours.is_empty() && !theirs.is_empty() {
        let mut numbers = BTreeMap::new();
        for (name, number) in ours {
            match theirs.get(name) {
                Some(other) => drop(numbers.insert(number, *other)),
                None => drop(maps.unmatched.insert((Numbered::WorkOffset, number.into()), name.into())),
            }
        }
        maps.offsets = Some(numbers);
    }
    maps
}

/// What the source calls what the target's text says, for worlds that compare the two.
pub fn renaming(from: Option<&Profile>, to: Option<&Profile>) -> Renaming {
    let mut renaming = Renaming::default();
    for row in to.iter().flat_map(|to| to.schema.tool.iter().map(toml::Spanned::get_ref)) {
        if let (Some(number), Some(name)) = (row.number.value, &row.name.value) {
            renaming.tool_names.insert(number, name.as_str().into());
        }
    }
    let (Some(from), Some(to)) = (from, to) else { return renaming };
    let named = |profile: &Profile| {
        profile
            .schema
            .tool
            .iter()
            .any(|t| t.get_ref().name.value.is_some() && t.get_ref().number.value.is_some())
    };
    if named(from) && named(to) {
        let (mut numbers, mut entries) = (BTreeMap::new(), BTreeMap::new());
        let zero = |profile: &Profile| {
            profile
                .schema
                .tool
                .iter()
                .any(|t| t.get_ref().name.value.is_some() && t.get_ref().number.value == Some(0))
        };
        if !zero(from) && !zero(to) {
            numbers.insert(0, 0);
        }
        for theirs in to.schema.tool.iter().map(toml::Spanned::get_ref) {
            let same = |t: &&ToolRow| t.name.value.is_some() && t.name.value == theirs.name.value;
            let Some(ours) = from.schema.tool.iter().map(toml::Spanned::get_ref).find(same) else { continue };
            let (Some(there), Some(here)) = (theirs.number.value, ours.number.value) else { continue };
            numbers.insert(there, here);
            entries
                .insert(theirs.length_entry.value.unwrap_or(there), ours.length_entry.value.unwrap_or(here));
        }
        (renaming.tools, renaming.entries) = (Some(numbers), Some(entries));
        renaming.edge_entries = to.tables().edge_entries;
    }
    let named = |profile: &Profile| {
        let rows = profile.schema.work_offset.iter().map(toml::Spanned::get_ref);
        rows.filter(|o| o.name.value.is_some() && o.number.value.is_some()).count() > 0
    };
    if named(from) && named(to) {
        let mut numbers = BTreeMap::new();
        for theirs in to.schema.work_offset.iter().map(toml::Spanned::get_ref) {
            let rows = from.schema.work_offset.iter().map(toml::Spanned::get_ref);
            let ours = rows.into_iter().find(|o| o.name.value.is_some() && o.name.value == theirs.name.value);
            let number = |n: Option<u32>| n.and_then(|n| u16::try_from(n).ok());
            if let (Some(there), Some(here)) =
                (number(theirs.number.value), ours.and_then(|o| number(o.number.value)))
            {
                numbers.insert(there, here);
            }
        }
        renaming.offsets = Some(numbers);
    }
    renaming
}

/// An imaginary machine of a dialect that has the names of a profile's tools and work offsets, with
/// numbers in another order: a program for it shows what the profile makes of the names.
pub fn counterpart(profile: &Profile, dialect: &'static Dialect) -> Profile {
    let mut other = Profile::empty(dialect);
    let fact = |number: usize| u32::try_from(number).map(|n| Fact { value: Some(n), ..Fact::default() });
    let named = |name: &str| Fact { value: Some(name.to_owned()), ..Fact::default() };
    for (at, name) in tools(profile).keys().enumerate() {
        let row =
            ToolRow { number: fact(at + 1).unwrap_or_default(), name: named(name), ..ToolRow::default() };
        other.schema.tool.push(toml::Spanned::new(0..0, row));
    }
    for (at, name) in offsets(profile).keys().enumerate() {
        let number = fact(at + 1).unwrap_or_default();
        let row = WorkOffsetRow { number, name: named(name), ..WorkOffsetRow::default() };
        other.schema.work_offset.push(toml::Spanned::new(0..0, row));
    }
    other
}

/// The same machine without a name for any number: numbers from and to it stay as they are.
pub fn nameless(profile: &Profile) -> Profile {
    fn cleared<T: Clone>(rows: &[toml::Spanned<T>], clear: fn(&mut T)) -> Vec<toml::Spanned<T>> {
        let own = |row: &toml::Spanned<T>| {
            let mut own = row.get_ref().clone();
            clear(&mut own);
            toml::Spanned::new(row.span(), own)
        };
        rows.iter().map(own).collect()
    }
    let mut own = profile.clone();
    own.schema.tool = cleared(&profile.schema.tool, |row| row.name = Fact::default());
    own.schema.work_offset = cleared(&profile.schema.work_offset, |row| row.name = Fact::default());
    own.schema.program.clear();
    own
}

/// A named tool.
struct Tool {
    number: u32,
    entry: u32,
}

fn tools(profile: &Profile) -> BTreeMap<&str, Tool> {
    let rows = profile.schema.tool.iter().map(toml::Spanned::get_ref);
    let named = rows.filter_map(|row| {
        let (name, number) = (row.name.value.as_deref()?, row.number.value?);
        Some((name, Tool { number, entry: row.length_entry.value.unwrap_or(number) }))
    });
    named.collect()
}

fn offsets(profile: &Profile) -> BTreeMap<&str, u16> {
    let rows = profile.schema.work_offset.iter().map(toml::Spanned::get_ref);
    let named =
        rows.filter_map(|row| Some((row.name.value.as_deref()?, u16::try_from(row.number.value?).ok()?)));
    named.collect()
}

/// Numbers and names of programs, names in capitals.
fn called(profile: Option<&Profile>) -> BTreeMap<u32, String> {
    let rows = profile.into_iter().flat_map(|p| p.schema.program.iter().map(toml::Spanned::get_ref));
    rows.filter_map(|row| Some((row.number.value?, row.name.value.as_ref()?.to_ascii_uppercase()))).collect()
}

/// Where the target calls by number, a number goes through the name in both profiles, and a name by the
/// target's profile or else the source's; where it calls by name, a number gets the name that the
/// source's profile has for it, or else the target's.
fn programs(from: Option<&Profile>, to: Option<&Profile>, by_number: bool, maps: &mut Maps) {
    let (ours, theirs) = (called(from), called(to));
    let text = |number: &u32| -> Text { number.to_string().into() };
    if !by_number {
        let all = theirs.iter().chain(&ours);
        maps.programs = all.map(|(number, name)| (text(number), name.as_str().into())).collect();
        return;
    }
    let by_name = |rows: &BTreeMap<u32, String>| -> BTreeMap<String, u32> {
        rows.iter().map(|(number, name)| (name.clone(), *number)).collect()
    };
    let known = by_name(&theirs);
    maps.program_numbers = theirs.keys().copied().collect();
    for (name, number) in by_name(&ours).into_iter().chain(known.clone()) {
        maps.programs.insert(name.into(), text(&number));
    }
    if ours.is_empty() || theirs.is_empty() {
        return;
    }
    maps.programs_in_force = true;
    for (number, name) in ours {
        match known.get(&name) {
            Some(other) => drop(maps.programs.insert(text(&number), text(other))),
            None => drop(maps.unmatched.insert((Numbered::Program, number), name.into())),
        }
    }
}
