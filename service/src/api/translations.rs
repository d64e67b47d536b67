//! Translations of programs: made once, kept with their reports, stale when what went in has changed.
//!
//! ```text
//! POST /api/v1/translations                 { "program": ID, "to": "siemens", … }
//! GET  /api/v1/translations?program=ID      translations, with what is stale of each
//! GET  /api/v1/translations/ID              one of them
//! GET  /api/v1/translations/ID/output       its text; also /report, /map, /certificate
//! ```

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State};
use axum::http::header::{CONTENT_TYPE, ETAG, LOCATION};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde_json::{Map, Value, json};

use super::programs::new_id;
use crate::Shared;
use crate::access::Caller;
use crate::http::body::{self, LISTED};
use crate::http::conditions::{etag, is_known, not_modified};
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;
use crate::store::{Outcome, State as Wanted, Store, Translation};
use crate::translating::{Asked, certificate, stale, translate};

/// The document of a translation.
pub(super) fn document(store: &Store, of: &Translation) -> Result<Value, Problem> {
    let asked: Value = serde_json::from_str(&of.asked).unwrap_or_default();
    let inputs: Value = serde_json::from_str(&of.inputs).unwrap_or_default();
    Ok(json!({
        "id": of.id,
        "program": of.program,
        "revision": of.revision,
        "asked": short(&asked),
        "inputs": inputs,
        "state": of.state,
        "stale": stale(store, of)?,
        "author": of.author,
        "made": http::moment(of.made),
    }))
}

/// A request without its empty fields.
pub(super) fn short(asked: &Value) -> Value {
    let says = |value: &Value| {
        !value.is_null() && *value != json!({}) && *value != json!(false) && *value != json!("")
    };
    let fields = asked.as_object().into_iter().flatten().filter(|(_, value)| says(value));
    fields.map(|(name, value)| (name.clone(), value.clone())).collect::<Map<_, _>>().into()
}

/// Translates a program.
pub(super) async fn create(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may_somewhere(Act::Change)?;
    let asked: Asked = body::json(&headers, body)?;
    let (id, author) = (new_id()?, caller.name().to_owned());
    let (document, place, is_new) = shared
        .compile(&caller, move |store| {
            let (made, is_new) = translate(store, asked, id, &author)?;
            Ok((document(store, &made)?, format!("/api/v1/translations/{}", made.id), is_new))
        })
        .await?;
    let status = if is_new { StatusCode::CREATED } else { StatusCode::OK };
    Ok((status, [(LOCATION, place)], http::json(&document)).into_response())
}

/// Lists translations.
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let program = query.one("program")?;
    let state = query.among("state", &Wanted::ALL)?;
    let after = query.one("after")?.unwrap_or_default();
    let most = query.number("limit")?.unwrap_or(LISTED[0]).clamp(1, LISTED[1]);
    query.end("program, state, after, limit")?;
    let (all, next) = shared
        .store(&caller, move |store| {
            let all = store.translations(program.as_deref(), state, &after, most)?;
            let next = all.last().filter(|_| all.len() == most as usize).map(|last| last.id.clone());
            let all = all.iter().map(|own| document(store, own)).collect::<Result<Vec<_>, _>>()?;
            Ok((all, next))
        })
        .await?;
    Ok(http::json(&json!({ "translations": all, "next": next })))
}

/// Tells of a translation. It has no tag: what is stale changes with others.
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let found = shared.store(&caller, move |store| document(store, &store.translation(&id)?)).await?;
    Ok(http::json(&found))
}

/// Gives what came out of a translation.
pub(super) async fn outcome(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((id, what)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let (outcome, media) = match what.as_str() {
        "output" => (Outcome::Output, "text/plain"),
        "report" => (Outcome::Report, "application/json"),
        "map" => (Outcome::Map, "application/json"),
        "certificate" => (Outcome::Certificate, "application/json"),
        _ => return Err(Problem::no_address()),
    };
    let tag = etag(&id, &what);
    if is_known(&headers, &tag) {
        // Who may not read it learns nothing by its tag.
        shared.store(&caller, move |store| Ok(store.translation(&id)?)).await?;
        return Ok(not_modified(tag));
    }
    let bytes = match outcome {
        Outcome::Certificate => {
            shared.compile(&caller, move |store| certificate(store, &store.translation(&id)?)).await?
        }
        Outcome::Output | Outcome::Report | Outcome::Map => {
            let whole = move |store: &Store| {
                let found = store.outcome(&id, outcome)?;
                Ok(found.map(|content| store.whole(&content)).transpose()?.unwrap_or_default())
            };
            shared.store(&caller, whole).await?
        }
    };
    Ok(([(CONTENT_TYPE, media.to_owned()), (ETAG, tag)], bytes).into_response())
}
