//! A setup sheet: all that a machinist sets up for a program, on one page that prints.
//!
//! Facts come from the program as it is executed, from its machine, and from the request; each guess is marked as one.
//! Not here: the page (`layout`).

mod gathered;
mod layout;
mod tools;

use serde_json::{Value, json};

use self::gathered::{Facts, Part, Translated};
use super::executed::Ready;
use crate::compiler::{self, DONE, refusal};
use crate::http::{Problem, moment};
use crate::store::Store;
use crate::translating::stale;

/// Translations of a program that a sheet lists.
const TRANSLATIONS: u32 = 20;

/// The first line of the messages of a request that failed.
fn reason(ready: &Ready) -> String {
    let messages = compiler::text(&ready.engine, "messages");
    let line = messages.lines().map(str::trim).find(|line| !line.is_empty());
    line.unwrap_or("no reason is known").to_owned()
}

/// Cuts the part, and draws it.
fn part(ready: &mut Ready, cut: &Value) -> Result<Part, Problem> {
    ready.ask("simulate", cut)?;
    let document = compiler::json(&ready.engine, "document");
    if document.is_null() {
        return Ok(Err(reason(ready)));
    }
    let title = ready.found.of.details.name.clone();
    let code = ready.run(&json!({ "verb": "picture", "form": "svg", "title": title }))?;
    if code != DONE {
        return Ok(Err(reason(ready)));
    }
    Ok(Ok((document, compiler::text(&ready.engine, "picture"))))
}

/// Makes the sheet of a program, with these fields of requests with a clock, and of those that cut.
///
/// # Errors
/// The program is refused. A part that cannot be cut is no error: the sheet says why it has no picture.
pub(super) fn of(store: &Store, ready: &mut Ready, timed: &Value, cut: &Value) -> Result<String, Problem> {
    let code = ready.ask("sheet", timed)?;
    if code != DONE {
        return Err(refusal(&ready.engine, code, Value::Null, Value::Null));
    }
    let (summary, used) = (compiler::json(&ready.engine, "document"), compiler::json(&ready.engine, "used"));
    ready.ask("check", &Value::Null)?;
    let check = Some(compiler::json(&ready.engine, "findings")).filter(|found| !found.is_null());
    let check = check.ok_or_else(|| reason(ready));
    let part = part(ready, cut)?;
    let of = &ready.found.of;
    let listed = store.translations(Some(&of.program), None, "", TRANSLATIONS + 1)?;
    let has_more = listed.len() > TRANSLATIONS as usize;
    let translations = listed.iter().take(TRANSLATIONS as usize).map(|own| {
        let stale = stale(store, own)?;
        let (target, state) = (own.target.clone(), own.state.name());
        Ok(Translated { target, state, revision: own.revision, stale })
    });
    let facts = Facts {
        name: of.details.name.clone(),
        folder: of.details.folder.clone(),
        revision: of.number,
        sha256: of.content.sha256.clone(),
        author: of.said.author.clone(),
        message: of.said.message.clone(),
        made: moment(of.made),
        dialect: (
            summary["programs"][0]["dialect"].as_str().unwrap_or_default().to_owned(),
            ready.found.dialect.is_none() && ready.found.machine().is_none(),
        ),
        translations: translations.collect::<Result<_, Problem>>()?,
        summary,
        used,
        check,
        part,
        has_more,
    };
    Ok(layout::page(&facts))
}
