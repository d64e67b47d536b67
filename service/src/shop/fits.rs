//! Conditions on texts: a text has no faults, one name with its address, and takes nothing else of the shop away.

use std::collections::BTreeSet;

use ncc_dialects::{DialectError, load_one};
use ncc_driver::machines::words::words;
use ncc_driver::render::dictionary::fault::{Fault, fault};
use ncc_engine::dialects::Dialects;
use ncc_machines::{Profile, ProfileError};
use serde_json::{Value, json};

use super::known::{dialects, file, of_texts, profile};
use crate::http::Problem;
use crate::store::{ShopText, Sort, Store, StoreError};

/// Dictionaries of a shop at most.
const MOST: usize = 100;

/// Names that are none of a dialect where a program's dialect is stated.
const TAKEN: [&str; 3] = ["auto", "help", "to"];

/// Checks that a text may be kept under a name; gives the names of others that it changes too.
///
/// # Errors
/// It has faults, another name, or the name of one that comes with ncc; or others of the shop cannot be read with it.
pub(super) fn fits(store: &Store, sort: Sort, name: &str, text: &str) -> Result<Vec<String>, Problem> {
    match sort {
        Sort::Machine => machine_fits(&dialects(store)?, name, text).map(|()| Vec::new()),
        Sort::Dialect => dialect_fits(store, name, text),
    }
}

fn machine_fits(dialects: &Dialects, name: &str, text: &str) -> Result<(), Problem> {
    let read = profile(text, dialects);
    let read = read.map_err(|wrong| Problem::faulty("the profile has errors", of_profile(&wrong, text)))?;
    has_name(name, read.id(), "profile")?;
    match ncc_machines::find(name) {
        Some(_) => Err(comes_with_ncc(name)),
        None => Ok(()),
    }
}

fn has_name(name: &str, own: &str, what: &str) -> Result<(), Problem> {
    match own == name {
        true => Ok(()),
        false => Err(Problem::content(format!("the {what} is that of {own:?}"))
            .help(format!("the address and the {what} have one name"))),
    }
}

fn comes_with_ncc(name: &str) -> Problem {
    Problem::exists(format!("`{name}` comes with ncc")).help("give yours another name")
}

/// Diagnostics of a profile, each with line and column.
fn of_profile(wrong: &[ProfileError], text: &str) -> Value {
    let fault = |error: &ProfileError| {
        let before = &text[..error.span.start.min(text.len())];
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        let said = words(&error.wrong, "`ncc machines schema` lists all keys");
        json!({
            "code": format!("NC{:04}", error.wrong.code()),
            "severity": "error",
            "message": said.message,
            "place": { "line": line, "column": column, "label": said.label },
            "advice": said.help.into_iter().collect::<Vec<_>>(),
        })
    };
    wrong.iter().map(fault).collect()
}

/// The diagnostic of a dictionary among all of its shop. A row of its base is at fault in the base's text.
fn of_dictionary(error: &DialectError, texts: &[ShopText]) -> Value {
    let names: Vec<String> = texts.iter().map(|own| file(&own.name)).collect();
    let Fault { place, inherited_by, words } = fault(error, &names, &plain(texts));
    let place = place.map(|(file, line, column)| json!({ "file": file, "line": line, "column": column }));
    json!([{
        "severity": "error",
        "message": words.headline,
        "place": place,
        "inherited_by": inherited_by,
        "advice": words.helps,
    }])
}

fn plain(texts: &[ShopText]) -> Vec<&str> {
    texts.iter().map(|own| own.text.as_str()).collect()
}

fn dialect_fits(store: &Store, name: &str, text: &str) -> Result<Vec<String>, Problem> {
    if ncc_dialects::builtin(name).is_some() {
        return Err(comes_with_ncc(name));
    }
    if TAKEN.contains(&name) {
        return Err(Problem::content(format!("`{name}` has another meaning where a dialect is stated"))
            .help("give yours another name"));
    }
    let before = store.shop_texts(Sort::Dialect)?;
    let mut after: Vec<ShopText> = before.iter().filter(|own| own.name != name).cloned().collect();
    after.push(ShopText { name: name.to_owned(), text: text.to_owned(), tag: String::new() });
    if after.len() > MOST {
        return Err(Problem::conflict(format!("a shop has {MOST} dictionaries at most"))
            .help("DELETE one that no program names any more"));
    }
    let own = load_one(&plain(&after), after.len() - 1);
    let own =
        own.map_err(|error| Problem::faulty("the dictionary has an error", of_dictionary(&error, &after)))?;
    has_name(name, &own.id, "dictionary")?;
    keeps_others(store, name, &before, &after)?
        .map_err(|lost| Problem::faulty(format!("{} cannot be read with it", lost.what), lost.diagnostics))
}

/// A text that cannot be read any more.
struct Lost {
    what: String,
    diagnostics: Value,
}

/// Checks that what depends on a dialect can be read after a change as before; gives the names of those dialects and machines.
fn keeps_others(
    store: &Store,
    name: &str,
    before: &[ShopText],
    after: &[ShopText],
) -> Result<Result<Vec<String>, Lost>, Problem> {
    for (at, other) in after.iter().enumerate().filter(|(_, other)| other.name != name) {
        let Err(error) = load_one(&plain(after), at) else { continue };
        let then = before.iter().position(|own| own.name == other.name);
        // One that could not be read before, as of another ncc, is no reason.
        if then.is_some_and(|then| load_one(&plain(before), then).is_ok()) {
            let what = format!("the dialect `{}`, which builds on it,", other.name);
            return Ok(Err(Lost { what, diagnostics: of_dictionary(&error, after) }));
        }
    }
    let [before, after] = [before, after].map(|texts| of_texts(texts.to_vec()));
    let all: BTreeSet<&str> = before.ids().chain(after.ids()).collect();
    let depends = |id: &str| [&before, &after].iter().any(|dialects| builds_on(dialects, id, name));
    let mut touched: Vec<String> = all.into_iter().filter(|id| depends(id)).map(str::to_owned).collect();
    for machine in store.shop_texts(Sort::Machine)? {
        let [then, now] = [&before, &after].map(|dialects| profile(&machine.text, dialects));
        if let (Ok(_), Err(wrong)) = (&then, &now) {
            let what = format!("the profile of the machine `{}`", machine.name);
            return Ok(Err(Lost { what, diagnostics: of_profile(wrong, &machine.text) }));
        }
        let is_in = |profile: &Profile| {
            let id = &profile.dialect.id;
            !profile.any_control && (id == name || touched.contains(id))
        };
        if now.is_ok_and(|profile| is_in(&profile)) {
            touched.push(machine.name);
        }
    }
    Ok(Ok(touched))
}

/// Whether a dialect builds on another one, in one or more steps.
fn builds_on(dialects: &Dialects, id: &str, other: &str) -> bool {
    let mut next = dialects.get(id);
    while let Some(base) = next.and_then(|dialect| dialect.base.as_deref()) {
        if base == other {
            return true;
        }
        next = dialects.get(base);
    }
    false
}

/// Checks that nothing of the shop builds on a dialect, so that it may be deleted.
pub(super) fn is_free(store: &Store, name: &str) -> Result<(), Problem> {
    let before = store.shop_texts(Sort::Dialect)?;
    if before.iter().all(|own| own.name != name) {
        return Err(StoreError::Absent.into());
    }
    let after: Vec<ShopText> = before.iter().filter(|own| own.name != name).cloned().collect();
    keeps_others(store, name, &before, &after)?.map(|_| ()).map_err(|lost| {
        Problem::conflict(format!("{} cannot be read without it", lost.what))
            .help("let it name another dialect first, or DELETE it")
    })
}
