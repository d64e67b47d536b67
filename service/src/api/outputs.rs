//! Outputs of an executed program: times, tools, checks.
//!
//! ```text
//! GET /api/v1/programs/ID/outputs/summary    times by tool and operation, as `ncc time --as json`
//! GET /api/v1/programs/ID/outputs/tools      tools, as `ncc time --as tools` (CSV)
//! GET /api/v1/programs/ID/outputs/times      every function with its time (CSV)
//! GET /api/v1/programs/ID/outputs/payload    the same as the case study's document
//! GET /api/v1/programs/ID/outputs/check      what is wrong with it, as `ncc check --format json`
//! ```
//!
//! The program is the one that it is, or a revision (`?revision=N`); its dialect and machine are those that are kept with it,
//! or others.

use std::collections::BTreeMap;
use std::sync::Arc;

use axum::extract::{Path, RawQuery, State};
use axum::http::HeaderMap;
use axum::http::header::{CONTENT_TYPE, ETAG};
use axum::response::{IntoResponse, Response};
use ncc_driver::time::{csv, payload};
use ncc_engine::Engine;
use serde_json::{Value, json};
use utoipa::ToSchema;

use crate::Shared;
use crate::access::Caller;
use crate::compiler::{DONE, REFUSED, put_machine, refusal};
use crate::http::Problem;
use crate::http::conditions::{etag, is_known, not_modified};
use crate::http::query::Query;
use crate::store::{Revision, Store, digest};
use crate::translating::{profile, run_with_called};

/// An output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ToSchema)]
#[schema(rename_all = "lowercase")]
enum Output {
    Summary,
    Tools,
    Times,
    Payload,
    Check,
}

impl Output {
    const ALL: [(&str, Output); 5] = [
        ("summary", Output::Summary),
        ("tools", Output::Tools),
        ("times", Output::Times),
        ("payload", Output::Payload),
        ("check", Output::Check),
    ];

    /// The verb that makes it, and which of its outputs it is.
    const fn of(self) -> (&'static str, &'static str) {
        match self {
            Output::Summary => ("summary", "document"),
            Output::Tools => ("summary", "tools"),
            Output::Times | Output::Payload => ("time", "times"),
            Output::Check => ("check", "findings"),
        }
    }

    const fn media(self) -> &'static str {
        match self {
            Output::Summary | Output::Payload | Output::Check => "application/json",
            Output::Tools | Output::Times => "text/csv; charset=utf-8; header=present",
        }
    }
}

/// Settings of the execution, from the address.
struct Asked {
    revision: Option<i64>,
    dialect: Option<String>,
    machine: Option<String>,
    options: BTreeMap<String, String>,
    model: Option<String>,
    start: Option<String>,
    tool_change_on: Option<&'static str>,
    assume_milling: bool,
}

impl Asked {
    fn of(query: Option<&str>, output: Output) -> Result<Asked, Problem> {
        let mut query = Query::of(query);
        let mut asked = Asked {
            revision: query.number("revision")?,
            dialect: query.one("dialect")?,
            machine: query.one("machine")?,
            options: query.pairs("option")?,
            assume_milling: query
                .among("assume_milling", &[("true", true), ("false", false)])?
                .unwrap_or(false),
            model: None,
            start: None,
            tool_change_on: None,
        };
        if output == Output::Check {
            query.end("revision, dialect, machine, option, assume_milling")?;
            return Ok(asked);
        }
        asked.model = query.one("model")?;
        asked.start = query.one("start")?;
        asked.tool_change_on =
            query.among("tool_change_on", &[("select", "select"), ("change", "change")])?;
        query.end("revision, dialect, machine, option, assume_milling, model, start, tool_change_on")?;
        Ok(asked)
    }

    /// The request for the engine; fields of times only where the verb has them.
    fn request(&self, verb: &str, file: &str, machine: Option<&str>) -> Value {
        let mut request = json!({
            "verb": verb,
            "file": file,
            "from": self.dialect,
            "machine": machine,
            "from_option": self.options,
            "assume_milling": self.assume_milling,
        });
        if verb != "check" {
            request["model"] = json!(self.model);
            request["start"] = json!(self.start);
            request["tool_change_on"] = json!(self.tool_change_on);
        }
        request
    }
}

/// A program and its machine, found.
struct Found {
    of: Revision,
    /// Its name, and the text of its profile where it is not one that comes with ncc.
    machine: Option<(String, Option<String>)>,
}

/// Finds the program; what the address does not say is what is kept with it.
fn find(store: &Store, id: &str, asked: &mut Asked) -> Result<Found, Problem> {
    let of = match asked.revision {
        None => store.program(id)?,
        Some(number) => store.revision(id, number)?,
    };
    let kept = |name: &String| Some(name.clone()).filter(|name| !name.is_empty());
    if asked.dialect.is_none() {
        asked.dialect = kept(&of.details.dialect);
    }
    if asked.machine.is_none() {
        asked.machine = kept(&of.details.machine);
    }
    let machine = match &asked.machine {
        None => None,
        Some(name) => Some((name.clone(), profile(store, name)?.0)),
    };
    Ok(Found { of, machine })
}

/// Makes an output.
fn make(store: &Store, found: &Found, asked: &Asked, output: Output, most: u64) -> Result<Vec<u8>, Problem> {
    let file = &found.of.details.name;
    let mut engine = Engine::default();
    let machine = found.machine.as_ref().map(|(name, text)| put_machine(&mut engine, name, text.as_deref()));
    engine.put(file, store.whole(&found.of.content)?);
    let (verb, name) = output.of();
    let mut request = asked.request(verb, file, machine.as_deref());
    if verb == "time" {
        request["most"] = json!(most);
    }
    let (code, _) = run_with_called(store, &found.of, &mut engine, &request.to_string())?;
    let made = engine.output(name).filter(|_| code == DONE || output == Output::Check && code == REFUSED);
    let made = made.ok_or_else(|| refusal(&engine, code, Value::Null, Value::Null))?;
    if output != Output::Times {
        return Ok(made.to_vec());
    }
    let document = payload::read(made).map_err(|_| Problem::fault())?;
    let mut rows = Vec::new();
    let written = csv::of_document(&document, &mut rows).map_err(|_| Problem::fault())?;
    // A program that does nothing has no times, and no rows.
    written.map_err(|not| Problem::not_made(not.problem(&document, file).message, None))?;
    Ok(rows)
}

/// Executes a program, and gives an output of that.
///
/// `summary`, `payload` and `check` are JSON, `tools` and `times` are CSV. `model`, `start` and `tool_change_on` are not for
/// `check`.
#[utoipa::path(get, path = "/api/v1/programs/{id}/outputs/{what}", tag = "programs",
    params(
        ("id" = String, Path),
        ("what" = inline(Output), Path),
        ("revision" = Option<i64>, Query, minimum = 1, description = "A revision; the latest without it"),
        ("dialect" = Option<String>, Query, description = "Its dialect; that kept with it without this"),
        ("machine" = Option<String>, Query, description = "The machine; that kept with it without this"),
        ("option" = Option<Vec<String>>, Query, description = "Settings of the control: `NAME=VALUE`"),
        ("assume_milling" = Option<bool>, Query, description = "It is for a mill, whatever it looks like"),
        ("model" = Option<String>, Query, description = "The model of times: `constant`, `trapezoid`, …"),
        ("start" = Option<String>, Query, description = "Position before the first block: `X-9,Y15.588,Z3`, mm"),
        ("tool_change_on" = Option<String>, Query, pattern = "^(select|change)$", description = "The function with the time of a tool change: `select` or `change`"),
        ("If-None-Match" = Option<String>, Header),
    ),
    responses(
        (status = 200, headers(("ETag" = String)),
            content((Value = "application/json"), (String = "text/csv; charset=utf-8; header=present"))),
        (status = 304),
    ))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((id, what)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let found = Output::ALL.iter().find(|(name, _)| *name == what);
    let (_, output) = *found.ok_or_else(Problem::no_address)?;
    let mut asked = Asked::of(query.as_deref(), output)?;
    let most = shared.largest;
    let made = shared
        .compile(&caller, move |store| {
            let found = find(store, &id, &mut asked)?;
            make(store, &found, &asked, output, most)
        })
        .await?;
    // It is made of many texts, so that only the output itself says whether it is still the same.
    let tag = etag(&digest(&[&made]), &what);
    if is_known(&headers, &tag) {
        return Ok(not_modified(tag));
    }
    Ok(([(CONTENT_TYPE, output.media().to_owned()), (ETAG, tag)], made).into_response())
}
