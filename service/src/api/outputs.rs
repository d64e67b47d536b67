//! Outputs of an executed program: times, tools, checks, charts, pictures, a setup sheet.
//!
//! ```text
//! GET /api/v1/programs/ID/outputs/summary    times by tool and operation, as `ncc time --as json`
//! GET /api/v1/programs/ID/outputs/operations the same for an ERP, as CSV or JSON
//! GET /api/v1/programs/ID/outputs/tools      tools, as `ncc time --as tools` (CSV)
//! GET /api/v1/programs/ID/outputs/times      every function with its time (CSV)
//! GET /api/v1/programs/ID/outputs/payload    the same as the case study's document
//! GET /api/v1/programs/ID/outputs/check      what is wrong with it, as `ncc check --format json`
//! GET /api/v1/programs/ID/outputs/chart      feed, speed, tool and position over time, as `ncc plot` (SVG)
//! GET /api/v1/programs/ID/outputs/picture    the part after the program, as `ncc simulate --svg` and `--png`
//! GET /api/v1/programs/ID/outputs/sheet      a setup sheet that prints (HTML)
//! ```
//!
//! The program is the one that it is, or a revision (`?revision=N`); its dialect and machine are those that are kept with it,
//! or others.

use std::sync::Arc;

use axum::extract::{Path, RawQuery, State};
use axum::http::HeaderMap;
use axum::response::Response;
use ncc_driver::time::{csv, payload};
use serde_json::{Value, json};
use utoipa::ToSchema;

use super::executed::{Found, Reading, Ready};
use super::page::{CSV, HTML, Made, SVG};
use super::{operations, sheet};
use crate::Shared;
use crate::access::Caller;
use crate::compiler::{DONE, REFUSED, json, refusal};
use crate::http::Problem;
use crate::http::query::Query;
use crate::store::Store;

/// Cells along the longer side of a part at most, as in the studio.
const CELLS: [u32; 2] = [16, 2048];

/// An output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ToSchema)]
#[schema(rename_all = "lowercase")]
enum Output {
    Summary,
    Operations,
    Tools,
    Times,
    Payload,
    Check,
    Chart,
    Picture,
    Sheet,
}

impl Output {
    const ALL: [(&str, Output); 9] = [
        ("summary", Output::Summary),
        ("operations", Output::Operations),
        ("tools", Output::Tools),
        ("times", Output::Times),
        ("payload", Output::Payload),
        ("check", Output::Check),
        ("chart", Output::Chart),
        ("picture", Output::Picture),
        ("sheet", Output::Sheet),
    ];

    /// Its forms, with their media types; the first one without `form`.
    const fn forms(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Output::Summary | Output::Payload | Output::Check => &[("json", "application/json")],
            Output::Operations => &[("json", "application/json"), ("csv", CSV)],
            Output::Tools | Output::Times => &[("csv", CSV)],
            Output::Chart => &[("svg", SVG)],
            Output::Picture => &[("svg", SVG), ("png", "image/png")],
            Output::Sheet => &[("html", HTML)],
        }
    }

    /// Whether it has times.
    const fn is_timed(self) -> bool {
        !matches!(self, Output::Check | Output::Picture)
    }

    /// Whether the part is cut for it.
    const fn is_cut(self) -> bool {
        matches!(self, Output::Picture | Output::Sheet)
    }
}

/// Settings of an output, from the address.
struct Asked {
    output: Output,
    /// Its form, and its media type.
    form: (&'static str, &'static str),
    revision: Option<i64>,
    reading: Reading,
    /// Fields of a request with a clock.
    timed: Value,
    /// Fields of a request that cuts.
    cut: Value,
    charts: Vec<String>,
    view: &'static str,
}

impl Asked {
    fn of(query: Option<&str>, output: Output, moves: usize) -> Result<Asked, Problem> {
        let mut query = Query::of(query);
        let forms: Vec<_> = output.forms().iter().map(|form| (form.0, *form)).collect();
        let mut names = format!("revision, {}, form", Reading::NAMES);
        let mut asked = Asked {
            output,
            form: query.among("form", &forms)?.unwrap_or(output.forms()[0]),
            revision: query.number("revision")?,
            reading: Reading::of(&mut query)?,
            timed: Value::Null,
            cut: Value::Null,
            charts: Vec::new(),
            view: "isometric",
        };
        if output.is_timed() {
            asked.timed = json!({
                "model": query.one("model")?,
                "start": query.one("start")?,
                "tool_change_on":
                    query.among("tool_change_on", &[("select", "select"), ("change", "change")])?,
            });
            names += ", model, start, tool_change_on";
        }
        if output.is_cut() {
            let cells: Option<u32> = query.number("cells")?;
            let [least, most] = CELLS;
            if cells.is_some_and(|cells| !(least..=most).contains(&cells)) {
                return Err(Problem::request(format!("`cells` is from {least} to {most}")));
            }
            asked.cut = json!({
                "stock": query.one("stock")?,
                "fixtures": query.all("fixture"),
                "tools": query.all("tool"),
                "cells": cells.unwrap_or(1024),
                "most_moves": moves,
            });
            names += ", stock, fixture, tool, cells";
        }
        if output == Output::Chart {
            let charts = ["speed", "tool", "feed", "position"];
            asked.charts =
                query.all("chart").iter().flat_map(|all| all.split(',')).map(str::to_owned).collect();
            if let Some(other) = asked.charts.iter().find(|own| !charts.contains(&own.as_str())) {
                return Err(Problem::request(format!("there is no chart `{other}`"))
                    .help(format!("there are: {}", charts.join(", "))));
            }
            names += ", chart";
        }
        if output == Output::Picture && asked.form.0 == "png" {
            let views = [("plan", "plan"), ("isometric", "isometric")];
            asked.view = query.among("view", &views)?.unwrap_or(asked.view);
            names += ", view";
        }
        query.end(&names)?;
        Ok(asked)
    }
}

/// Finds the program; what the address does not say is what is kept with it.
fn find(store: &Store, id: &str, asked: &Asked) -> Result<Found, Problem> {
    let of = match asked.revision {
        None => store.program(id)?,
        Some(number) => store.revision(id, number)?,
    };
    Found::of(store, of, &asked.reading)
}

/// The output of a request under a name, if it is there.
fn output(ready: &Ready, code: u8, name: &str) -> Result<Vec<u8>, Problem> {
    let made = ready.engine.output(name).map(<[u8]>::to_vec);
    made.ok_or_else(|| refusal(&ready.engine, code, Value::Null, Value::Null))
}

/// Does a request, and gives an output of it.
fn done(ready: &mut Ready, verb: &str, more: &Value, name: &str) -> Result<Vec<u8>, Problem> {
    let code = ready.ask(verb, more)?;
    if code != DONE {
        return Err(refusal(&ready.engine, code, Value::Null, Value::Null));
    }
    output(ready, code, name)
}

/// Every function with its time, as CSV.
fn rows(document: &[u8], file: &str) -> Result<Vec<u8>, Problem> {
    let document = payload::read(document).map_err(|_| Problem::fault())?;
    let mut rows = Vec::new();
    let written = csv::of_document(&document, &mut rows).map_err(|_| Problem::fault())?;
    // A program that does nothing has no times, and no rows.
    written.map_err(|not| Problem::not_made(not.problem(&document, file).message, None))?;
    Ok(rows)
}

/// Makes an output.
fn make(store: &Store, found: Found, asked: &Asked, most: u64) -> Result<Made, Problem> {
    let file = found.of.details.name.clone();
    let mut ready = Ready::of(store, found)?;
    let timed = &asked.timed;
    let bytes = match asked.output {
        Output::Summary => done(&mut ready, "summary", timed, "document")?,
        Output::Tools => done(&mut ready, "summary", timed, "tools")?,
        Output::Operations => {
            done(&mut ready, "summary", timed, "document")?;
            operations::of(&json(&ready.engine, "document"), &ready.found, asked.form.0 == "csv")?
        }
        Output::Times | Output::Payload => {
            let mut fields = timed.clone();
            fields["most"] = most.into();
            let document = done(&mut ready, "time", &fields, "times")?;
            if asked.output == Output::Times { rows(&document, &file)? } else { document }
        }
        Output::Check => {
            let code = ready.ask("check", &Value::Null)?;
            if !matches!(code, DONE | REFUSED) {
                return Err(refusal(&ready.engine, code, Value::Null, Value::Null));
            }
            output(&ready, code, "findings")?
        }
        Output::Chart => {
            let of = ready.fields(timed);
            let code = ready.run(&json!({ "verb": "chart", "of": of, "charts": asked.charts }))?;
            output(&ready, code, "picture")?
        }
        Output::Picture => {
            let code = ready.ask("simulate", &asked.cut)?;
            output(&ready, code, "document")?;
            let drawn = json!({ "verb": "picture", "form": asked.form.0, "view": asked.view, "title": file });
            let code = ready.run(&drawn)?;
            output(&ready, code, "picture")?
        }
        Output::Sheet => sheet::of(store, &mut ready, timed, &asked.cut)?.into_bytes(),
    };
    Ok(Made { media: asked.form.1, bytes, has_pictures: asked.output.is_cut() })
}

/// Executes a program, and gives an output of that.
///
/// `form` chooses among the forms of an output: `operations` as `json` or `csv`, `picture` as `svg` or `png`. `check` and
/// `picture` have no times, so they take no `model`, `start` and `tool_change_on`; `picture` and `sheet` take what the part is
/// cut from, and by which tools: what is not stated is guessed.
#[utoipa::path(get, path = "/api/v1/programs/{id}/outputs/{what}", tag = "programs",
    params(
        ("id" = String, Path),
        ("what" = inline(Output), Path),
        ("revision" = Option<i64>, Query, minimum = 1, description = "A revision; the latest without it"),
        ("dialect" = Option<String>, Query, description = "Its dialect; that kept with it without this"),
        ("machine" = Option<String>, Query, description = "The machine; that kept with it without this"),
        ("option" = Option<Vec<String>>, Query, description = "Settings of the control: `NAME=VALUE`"),
        ("assume_milling" = Option<bool>, Query, description = "It is for a mill, whatever it looks like"),
        ("form" = Option<String>, Query, pattern = "^(json|csv|svg|png|html)$", description = "`json`, `csv`, `svg`, `png` or `html`, as the output has them"),
        ("model" = Option<String>, Query, description = "The model of times: `ideal`, `trapezoidal`, `jerk-limited`"),
        ("start" = Option<String>, Query, description = "Position before the first block: `X-9,Y15.588,Z3`, mm"),
        ("tool_change_on" = Option<String>, Query, pattern = "^(select|change)$", description = "The function with the time of a tool change: `select` or `change`"),
        ("chart" = Option<Vec<String>>, Query, description = "Charts: `speed`, `tool`, `feed`, `position`; all without it"),
        ("view" = Option<String>, Query, pattern = "^(plan|isometric)$", description = "The view of a PNG: `plan` or `isometric`"),
        ("stock" = Option<String>, Query, description = "The raw part: `X0:100 Y0:60 Z-20:0`, mm; guessed without it"),
        ("fixture" = Option<Vec<String>>, Query, description = "What holds it, in the same form"),
        ("tool" = Option<Vec<String>>, Query, description = "Tools: `4=drill,6.8,angle=118`; guessed without them"),
        ("cells" = Option<u32>, Query, minimum = 16, maximum = 2048, description = "Cells along the longer side of the part"),
        ("If-None-Match" = Option<String>, Header),
    ),
    responses(
        (status = 200, headers(("ETag" = String)),
            content((Value = "application/json"), (String = "text/csv; charset=utf-8; header=present"),
                (String = "image/svg+xml"), (Vec<u8> = "image/png"), (String = "text/html; charset=utf-8"))),
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
    let asked = Asked::of(query.as_deref(), output, shared.rooms.moves())?;
    let most = shared.largest;
    // The first form of an output has the tag of the output.
    let form = if asked.form.0 == output.forms()[0].0 { what } else { format!("{what}-{}", asked.form.0) };
    let made = shared
        .compile(&caller, move |store| {
            let found = find(store, &id, &asked)?;
            make(store, found, &asked, most)
        })
        .await?;
    Ok(made.answer(&headers, &form))
}
