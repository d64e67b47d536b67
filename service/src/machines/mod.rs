//! Machines: those that come with ncc, and profiles that were put in.
//!
//! ```text
//! GET    /api/v1/machines         all of them
//! GET    /api/v1/machines/NAME    a profile, as its owner wrote it
//! PUT    /api/v1/machines/NAME    a profile (TOML), or the case study's machine.json
//! DELETE /api/v1/machines/NAME
//! GET    /api/v1/machines/NAME/revisions           its history ([`revisions`])
//! GET    /api/v1/machines/NAME/revisions/N         the profile then
//! POST   /api/v1/machines/NAME/revisions/N/restore
//! ```

mod revisions;

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{RawQuery, State};
use axum::http::header::{CONTENT_TYPE, ETAG, LOCATION};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use ncc_driver::machines::words::words;
use ncc_machines::{Profile, ProfileError};
use serde::Serialize;
use serde_json::{Value, json};
use utoipa::ToSchema;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::Shared;
use crate::access::Caller;
use crate::http::body::{self, Name, encoded};
use crate::http::conditions::{etag, expected, is_known, not_modified};
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;

const TOML: &str = "application/toml";
const JSON: &str = "application/json";

/// Group of the addresses in the description.
const TAG: &str = "machines";

/// Bytes of a profile at most.
const LARGEST: usize = 1 << 20;

/// Addresses of machines.
pub(crate) fn routes() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new()
        .routes(routes!(list))
        .routes(routes!(read, keep, delete))
        .routes(routes!(revisions::list))
        .routes(routes!(revisions::read))
        .routes(routes!(revisions::restore))
}

/// A machine.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Machine)]
struct MachineDocument {
    /// Name in addresses, and of its profile.
    name: String,
    /// It comes with ncc.
    ships_with_ncc: bool,
    title: Option<String>,
    /// Dialect of its control; none of a machine.json.
    dialect: Option<String>,
}

/// All machines.
#[derive(Debug, Serialize, ToSchema)]
struct Machines {
    machines: Vec<MachineDocument>,
}

/// Lists machines.
#[utoipa::path(get, path = "/api/v1/machines", tag = TAG, responses((status = 200, body = Machines)))]
async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let own = shared.store(&caller, |store| Ok(store.machines()?)).await?;
    let own = own.into_iter().map(|machine| {
        let profile = profile(&machine.text).ok();
        let dialect =
            profile.as_ref().filter(|profile| !profile.any_control).map(|own| own.dialect.id.clone());
        let title = profile.map(|profile| profile.schema.title);
        MachineDocument { name: machine.name, title, dialect, ships_with_ncc: false }
    });
    let shipped = ncc_machines::shipped().iter().map(|profile| {
        let (title, dialect) = (profile.schema.title.clone(), profile.dialect.id.clone());
        let name = profile.id().to_owned();
        MachineDocument { name, title: Some(title), dialect: Some(dialect), ships_with_ncc: true }
    });
    Ok(http::json(&Machines { machines: shipped.chain(own).collect() }))
}

/// A profile in either form.
pub(crate) fn profile(text: &str) -> Result<Profile, Vec<ProfileError>> {
    match text.trim_start().starts_with('{') {
        true => Profile::parse_machine_json(text),
        false => Profile::parse(text, &ncc_dialects::builtin),
    }
}

/// Diagnostics of a profile, each with line and column.
fn faults(wrong: &[ProfileError], text: &str) -> Value {
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

/// Gives a profile, as its owner wrote it.
#[utoipa::path(get, path = "/api/v1/machines/{name}", tag = TAG,
    params(("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"), ("If-None-Match" = Option<String>, Header)),
    responses(
        (status = 200, content((String = "application/toml"), (Value = "application/json"))),
        (status = 304),
    ))]
async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    if let Some(text) = ncc_machines::shipped_text(&name) {
        return Ok(([(CONTENT_TYPE, TOML)], text).into_response());
    }
    let machine = shared.store(&caller, move |store| Ok(store.machine(&name)?)).await?;
    let tag = etag(&machine.tag, "");
    if is_known(&headers, &tag) {
        return Ok(not_modified(tag));
    }
    Ok(told(machine.text, tag))
}

/// The answer with a profile.
fn told(text: String, tag: String) -> Response {
    let media = if text.trim_start().starts_with('{') { JSON } else { TOML };
    ([(CONTENT_TYPE, media.to_owned()), (ETAG, tag)], text).into_response()
}

/// Checks that a text is a profile for a name.
///
/// # Errors
/// It is none, of another name, or of a machine that comes with ncc.
fn fits(name: &str, text: &str) -> Result<(), Problem> {
    let read = profile(text);
    let read = read.map_err(|wrong| Problem::faulty("the profile has errors", faults(&wrong, text)))?;
    if read.id() != name {
        return Err(Problem::content(format!("the profile is that of {:?}", read.id()))
            .help("the address and the profile have one name"));
    }
    match ncc_machines::find(name) {
        Some(_) => Err(Problem::exists(format!("`{name}` comes with ncc")).help("give yours another name")),
        None => Ok(()),
    }
}

/// Keeps a profile, or a machine.json of the case study.
#[utoipa::path(put, path = "/api/v1/machines/{name}", tag = TAG,
    params(("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"), ("If-Match" = Option<String>, Header)),
    request_body(content((String = "application/toml"), (Value = "application/json"))),
    responses(
        (status = 201, headers(("Location" = String), ("ETag" = String))),
        (status = 204, headers(("ETag" = String))),
    ))]
async fn keep(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Administer, "")?;
    let over = expected(&headers)?;
    if !matches!(body::media(&headers)?.as_deref(), Some(TOML | JSON)) {
        return Err(Problem::media("application/toml, or application/json for a machine.json"));
    }
    let body = body::whole(body, LARGEST as u64)?;
    if body.len() > LARGEST {
        return Err(Problem::too_large(LARGEST as u64));
    }
    let text =
        String::from_utf8(body.to_vec()).map_err(|_| Problem::content("a profile is text in UTF-8"))?;
    fits(&name, &text)?;
    let place = format!("/api/v1/machines/{}", encoded(&name));
    let (tag, is_new) =
        shared.store(&caller, move |store| Ok(store.keep_machine(&name, &text, &over)?)).await?;
    let tag = etag(&tag, "");
    Ok(match is_new {
        true => (StatusCode::CREATED, [(LOCATION, place), (ETAG, tag)]).into_response(),
        false => (StatusCode::NO_CONTENT, [(ETAG, tag)]).into_response(),
    })
}

/// Deletes a profile.
#[utoipa::path(delete, path = "/api/v1/machines/{name}", tag = TAG,
    params(("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"), ("If-Match" = Option<String>, Header)),
    responses((status = 204)))]
async fn delete(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Administer, "")?;
    let over = expected(&headers)?;
    shared.store(&caller, move |store| Ok(store.delete_machine(&name, &over)?)).await?;
    Ok(StatusCode::NO_CONTENT)
}
