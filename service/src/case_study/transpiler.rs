//! TRANSPILER: a program in, its document stored (Aguiar 2023, 3.2).
//!
//! A program that is refused is not stored; the answer has what is wrong with it, and where. GET gives the payload after
//! processing in the case study's form; `?stage=before` and `?form=ncc` give others.

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{RawQuery, State};
use axum::http::header::{ETAG, LOCATION};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use ncc_engine::dialects::Dialects;

use super::document::{Account, Setting, Whole, process};
use super::persistence::{self, Documents, Form, read_in};
use super::shelf::Shelf;
use crate::Shared;
use crate::access::Caller;
use crate::http::body::{self, Name, encoded};
use crate::http::conditions::{etag, expected};
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;

/// Group of the addresses in the description.
const TAG: &str = "case study";

/// Lists documents.
#[utoipa::path(get, path = "/transpiler", tag = TAG,
    params(
        ("after" = Option<String>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Documents)))]
pub(super) async fn list(
    shared: State<Arc<Shared>>,
    caller: Caller,
    query: RawQuery,
) -> Result<Response, Problem> {
    persistence::list(shared, caller, query).await
}

/// Deletes a document.
#[utoipa::path(delete, path = "/transpiler/{name}", tag = TAG,
    params(("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"), ("If-Match" = Option<String>, Header)),
    responses((status = 204)))]
pub(super) async fn delete(
    shared: State<Arc<Shared>>,
    caller: Caller,
    name: Name,
    query: RawQuery,
    headers: HeaderMap,
) -> Result<StatusCode, Problem> {
    persistence::delete(shared, caller, name, query, headers).await
}

/// Query names of the address of a program.
const TAKES: &str =
    "dialect, machine, option, start, start_time, model, tool_change_on, units, assume_milling";

/// The settings in the address of a program.
fn stated(query: Option<&str>) -> Result<Setting, Problem> {
    let mut query = Query::of(query);
    let start_time = query.number("start_time")?.unwrap_or_default();
    if !f64::is_finite(start_time) {
        return Err(Problem::request(format!("`start_time` takes no `{start_time}`")));
    }
    let words = |own: &'static [&'static str]| own.iter().map(|word| (*word, *word)).collect::<Vec<_>>();
    let setting = Setting {
        dialect: query.one("dialect")?,
        machine: query.one("machine")?,
        profile: None,
        dialects: Dialects::default(),
        options: query.pairs("option")?,
        start: query.one("start")?,
        start_time,
        model: query.one("model")?,
        tool_change_on: query.among("tool_change_on", &words(&["select", "change"]))?.map(str::to_owned),
        units: query.among("units", &words(&["mm", "inch"]))?.map(str::to_owned),
        assume_milling: query.among("assume_milling", &[("true", true), ("false", false)])?.unwrap_or(false),
    };
    query.end(TAKES)?;
    Ok(setting)
}

/// Fetches what does not come with ncc: the machine's profile, and the shop's dialects where the dialect is none of ncc's, or the
/// profile may name one of them.
fn with_shop(setting: &mut Setting, shelf: &Shelf) -> Result<(), Problem> {
    let is_own = |id: &String| id != "auto" && ncc_dialects::builtin(id).is_none();
    let machine = setting.machine.clone().filter(|name| ncc_machines::find(name).is_none());
    if machine.is_some() || setting.dialect.as_ref().is_some_and(is_own) {
        setting.dialects = shelf.dialects()?;
    }
    let Some(name) = machine else { return Ok(()) };
    let absent = |problem: Problem| match problem.is_absent() {
        true => Problem::request(format!("there is no machine `{name}`"))
            .help("GET /api/v1/machines lists them; PUT /api/v1/machines/NAME keeps another one"),
        false => problem,
    };
    setting.profile = Some(shelf.machine(&name).map_err(absent)?.text);
    Ok(())
}

/// The program of a body.
fn program(headers: &HeaderMap, body: Result<Bytes, BytesRejection>, most: u64) -> Result<Bytes, Problem> {
    match body::media(headers)?.as_deref() {
        None | Some("application/octet-stream") => {}
        Some(media) if media.starts_with("text/") => {}
        Some(_) => return Err(Problem::media("text/plain")),
    }
    body::whole(body, most)
}

/// Processes a program, and stores its document under a name that is free.
#[utoipa::path(post, path = "/transpiler/{name}", tag = TAG,
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("dialect" = Option<String>, Query, description = "Its dialect; it is recognised without this"),
        ("machine" = Option<String>, Query, description = "Its machine"),
        ("option" = Option<Vec<String>>, Query, description = "Settings of the control: `NAME=VALUE`"),
        ("start" = Option<String>, Query, description = "Position before the first block: `X-9,Y15.588,Z3`, mm"),
        ("start_time" = Option<f64>, Query, description = "Time stamp before the first block, s"),
        ("model" = Option<String>, Query, description = "The model of times"),
        ("tool_change_on" = Option<String>, Query, pattern = "^(select|change)$", description = "The function with the time of a tool change: `select` or `change`"),
        ("units" = Option<String>, Query, pattern = "^(mm|inch)$", description = "Units at power-on: `mm` or `inch`"),
        ("assume_milling" = Option<bool>, Query, description = "It is for a mill, whatever it looks like"),
    ),
    request_body(content((String = "text/plain"), (Vec<u8> = "application/octet-stream")),
        description = "The text of the program"),
    responses((status = 201, body = Account, headers(("Location" = String), ("ETag" = String)))))]
pub(super) async fn create(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    caller.may(Act::Change, "")?;
    let mut setting = stated(query.as_deref())?;
    let program = program(&headers, body, shared.largest)?;
    let place = format!("/transpiler/{}", encoded(&name));
    let most = shared.largest;
    let (tag, account) = shared
        .work(&caller, move |shelf| {
            with_shop(&mut setting, shelf)?;
            let made = process(&name, &program, &setting, most)?;
            Ok((shelf.create(&name, &made.of, made.parts)?, made.account))
        })
        .await?;
    let headers = [(LOCATION, place), (ETAG, etag(&tag, ""))];
    Ok((StatusCode::CREATED, headers, http::json(&account)).into_response())
}

/// Processes a program, and stores its document in the place of the one under its name. Dialect and machine are those of
/// that one, unless the address names others.
#[utoipa::path(put, path = "/transpiler/{name}", tag = TAG,
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("dialect" = Option<String>, Query, description = "Its dialect; that of the stored document without this"),
        ("machine" = Option<String>, Query, description = "Its machine; that of the stored document without this"),
        ("option" = Option<Vec<String>>, Query, description = "Settings of the control: `NAME=VALUE`"),
        ("start" = Option<String>, Query, description = "Position before the first block: `X-9,Y15.588,Z3`, mm"),
        ("start_time" = Option<f64>, Query, description = "Time stamp before the first block, s"),
        ("model" = Option<String>, Query, description = "The model of times"),
        ("tool_change_on" = Option<String>, Query, pattern = "^(select|change)$", description = "The function with the time of a tool change: `select` or `change`"),
        ("units" = Option<String>, Query, pattern = "^(mm|inch)$", description = "Units at power-on: `mm` or `inch`"),
        ("assume_milling" = Option<bool>, Query, description = "It is for a mill, whatever it looks like"),
        ("If-Match" = Option<String>, Header),
    ),
    request_body(content((String = "text/plain"), (Vec<u8> = "application/octet-stream")),
        description = "The text of the program"),
    responses((status = 200, body = Account, headers(("ETag" = String)))))]
pub(super) async fn update(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    caller.may(Act::Change, "")?;
    let mut setting = stated(query.as_deref())?;
    let over = expected(&headers)?;
    let program = program(&headers, body, shared.largest)?;
    let most = shared.largest;
    let (tag, account) = shared
        .work(&caller, move |shelf| {
            let there = shelf.find(&name, &[])?;
            if setting.dialect.is_none() {
                setting.dialect = Some(there.dialect);
            }
            if setting.machine.is_none() {
                setting.machine = Some(there.machine).filter(|machine| !machine.is_empty());
            }
            with_shop(&mut setting, shelf)?;
            let made = process(&name, &program, &setting, most)?;
            Ok((shelf.replace(&name, &made.of, made.parts, &over)?, made.account))
        })
        .await?;
    Ok((StatusCode::OK, [(ETAG, etag(&tag, ""))], http::json(&account)).into_response())
}

/// Gives the payload.
#[utoipa::path(get, path = "/transpiler/{name}", tag = TAG,
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("form" = inline(Option<Form>), Query, description = "The stored form, or that of the case study, without it"),
        ("stage" = Option<String>, Query, pattern = "^(before|after)$", description = "Before or after processing"),
        ("If-None-Match" = Option<String>, Header),
    ),
    responses((status = 200, headers(("ETag" = String)), content((Value = "application/json"), (Whole = "application/vnd.ncc.document+json"))), (status = 304)))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    read_in(&shared, &caller, name, query.as_deref(), &headers, Form::Printed).await
}
