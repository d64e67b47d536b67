//! Two revisions compared by their motion.
//!
//! ```text
//! GET /api/v1/programs/ID/comparison                 the latest revision and the one before it
//! GET /api/v1/programs/ID/comparison?from=1&to=4     two revisions
//! GET /api/v1/programs/ID/comparison?other=ID2       two programs
//! ```
//!
//! Not here: the comparison itself (`ncc_diff`), and its line in the list of revisions (`crate::comparing`).

use std::sync::Arc;

use axum::extract::{Path, RawQuery, State};
use axum::http::HeaderMap;
use axum::response::Response;
use ncc_engine::Engine;
use serde_json::{Value, json};

use super::executed::{Found, Reading};
use super::page::{HTML, Made};
use crate::Shared;
use crate::access::Caller;
use crate::compiler::{DONE, REFUSED, refusal};
use crate::http::Problem;
use crate::http::query::Query;
use crate::shop::dialects;
use crate::store::{Revision, Store};
use crate::translating::run_with_called;

/// A comparison, from the address.
struct Asked {
    from: Option<i64>,
    to: Option<i64>,
    other: Option<String>,
    reading: Reading,
    tolerance: Option<String>,
    is_page: bool,
}

impl Asked {
    fn of(query: Option<&str>) -> Result<Asked, Problem> {
        let mut query = Query::of(query);
        let asked = Asked {
            from: query.number("from")?,
            to: query.number("to")?,
            other: query.one("other")?,
            reading: Reading::of(&mut query)?,
            tolerance: query.one("tolerance")?,
            is_page: query.among("form", &[("json", false), ("html", true)])?.unwrap_or(false),
        };
        query.end(&format!("from, to, other, {}, tolerance, form", Reading::NAMES))?;
        Ok(asked)
    }

    /// Both revisions.
    fn sides(&self, store: &Store, id: &str) -> Result<[Revision; 2], Problem> {
        let at = |id: &str, number: Option<i64>| match number {
            None => store.program(id),
            Some(number) => store.revision(id, number),
        };
        let to = at(self.other.as_deref().unwrap_or(id), self.to)?;
        let before = match (self.from, &self.other) {
            (None, None) if to.number == 1 => {
                return Err(Problem::absent("the program has no revision before this one")
                    .help("from=N names the revision to compare with, other=ID another program"));
            }
            (None, None) => Some(to.number - 1),
            (from, _) => from,
        };
        Ok([at(id, before)?, to])
    }
}

/// Compares two programs; gives the document, and the page.
///
/// # Errors
/// One of them cannot be executed.
pub(crate) fn compare(
    store: &Store,
    [a, b]: [Revision; 2],
    tolerance: Option<&str>,
) -> Result<[Vec<u8>; 2], Problem> {
    compare_as(store, [a, b], &Reading::default(), tolerance)
}

fn compare_as(
    store: &Store,
    sides: [Revision; 2],
    reading: &Reading,
    tolerance: Option<&str>,
) -> Result<[Vec<u8>; 2], Problem> {
    let mut engine = Engine::default();
    engine.know(dialects(store)?);
    let is_one = sides[0].program == sides[1].program;
    let mut fields = Vec::new();
    for (side, of) in ["a", "b"].into_iter().zip(&sides) {
        // Two programs of one name, in the same revision, are two files.
        let other = if is_one { String::new() } else { format!(", {side}") };
        let file = format!("{} (revision {}{other})", of.details.name, of.number);
        let found = Found::of(store, of.clone(), reading)?;
        fields.push(found.put(&mut engine, &file, store.whole(&of.content)?));
    }
    let request = json!({ "verb": "diff", "a": fields[0], "b": fields[1], "tolerance": tolerance });
    let (code, _) = run_with_called(store, &sides[1], &mut engine, &request.to_string())?;
    match [engine.output("document"), engine.output("page")] {
        [Some(document), Some(page)] if matches!(code, DONE | REFUSED) => {
            Ok([document.to_vec(), page.to_vec()])
        }
        _ => Err(refusal(&engine, code, Value::Null, Value::Null)),
    }
}

/// Compares two revisions of a program, or of two programs, by their motion.
///
/// The same as `ncc diff` says: JSON, or a page for people. Without `from` and `to`: the latest revision, and the one before
/// it. Programs that they call are looked for in the folder of the second one.
#[utoipa::path(get, path = "/api/v1/programs/{id}/comparison", tag = "programs",
    params(
        ("id" = String, Path),
        ("from" = Option<i64>, Query, minimum = 1, description = "The first revision; that before `to` without it"),
        ("to" = Option<i64>, Query, minimum = 1, description = "The second revision; the latest without it"),
        ("other" = Option<String>, Query, description = "The program that `to` is of; the same without it"),
        ("dialect" = Option<String>, Query, description = "The dialect of both; those kept with them without this"),
        ("machine" = Option<String>, Query, description = "The machine of both; those kept with them without this"),
        ("option" = Option<Vec<String>>, Query, description = "Settings of the control: `NAME=VALUE`"),
        ("assume_milling" = Option<bool>, Query, description = "They are for a mill, whatever they look like"),
        ("tolerance" = Option<String>, Query, description = "Within how much two positions are the same, mm"),
        ("form" = Option<String>, Query, pattern = "^(json|html)$", description = "`json` (without it) or `html`"),
        ("If-None-Match" = Option<String>, Header),
    ),
    responses(
        (status = 200, headers(("ETag" = String)),
            content((Value = "application/json"), (String = "text/html; charset=utf-8"))),
        (status = 304),
    ))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let asked = Asked::of(query.as_deref())?;
    let is_page = asked.is_page;
    let [document, page] = shared
        .compile(&caller, move |store| {
            let sides = asked.sides(store, &id)?;
            compare_as(store, sides, &asked.reading, asked.tolerance.as_deref())
        })
        .await?;
    let made = match is_page {
        true => Made { media: HTML, bytes: page, has_pictures: false },
        false => Made { media: "application/json", bytes: document, has_pictures: false },
    };
    Ok(made.answer(&headers, if is_page { "html" } else { "json" }))
}
