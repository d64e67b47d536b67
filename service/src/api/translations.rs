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
use serde::Serialize;
use serde_json::{Map, Value, json};
use utoipa::ToSchema;

use super::programs::new_id;
use crate::Shared;
use crate::access::Caller;
use crate::http::body;
use crate::http::conditions::{etag, is_known, not_modified};
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;
use crate::store::{Outcome, State as Wanted, Store, Translation};
use crate::translating::{Asked, certificate, stale, translate};

/// Group of the addresses in the description.
const TAG: &str = "translations";

/// A translation.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Translation)]
pub(super) struct TranslationDocument {
    /// Name in addresses.
    id: String,
    /// The program.
    program: String,
    /// Its revision.
    revision: i64,
    /// The request, without its empty fields.
    #[schema(value_type = Object)]
    asked: Value,
    /// Digests of its inputs.
    #[schema(value_type = Object)]
    inputs: Value,
    state: Wanted,
    /// Inputs that are others now: none while it holds.
    #[schema(value_type = Vec<String>)]
    stale: Vec<&'static str>,
    author: String,
    /// Its time, UTC.
    #[schema(format = DateTime)]
    made: String,
}

/// A page of translations.
#[derive(Debug, Serialize, ToSchema)]
struct Translations {
    translations: Vec<TranslationDocument>,
    /// Value of `after` for the next page.
    next: Option<String>,
}

/// The document of a translation.
pub(super) fn document(store: &Store, of: &Translation) -> Result<TranslationDocument, Problem> {
    let asked: Value = serde_json::from_str(&of.asked).unwrap_or_default();
    Ok(TranslationDocument {
        id: of.id.clone(),
        program: of.program.clone(),
        revision: of.revision,
        asked: short(&asked),
        inputs: serde_json::from_str(&of.inputs).unwrap_or_default(),
        state: of.state,
        stale: stale(store, of)?,
        author: of.author.clone(),
        made: http::moment(of.made),
    })
}

/// A request without its empty fields.
pub(super) fn short(asked: &Value) -> Value {
    let says = |value: &Value| {
        !value.is_null() && *value != json!({}) && *value != json!(false) && *value != json!("")
    };
    let fields = asked.as_object().into_iter().flatten().filter(|(_, value)| says(value));
    fields.map(|(name, value)| (name.clone(), value.clone())).collect::<Map<_, _>>().into()
}

/// Translates a program; the same request again gives the translation that is kept.
#[utoipa::path(post, path = "/api/v1/translations", tag = TAG,
    request_body = Asked,
    responses(
        (status = 201, body = TranslationDocument, headers(("Location" = String))),
        (status = 200, body = TranslationDocument, description = "It was kept already", headers(("Location" = String))),
    ))]
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
#[utoipa::path(get, path = "/api/v1/translations", tag = TAG,
    params(
        ("program" = Option<String>, Query, description = "Those of a program"),
        ("state" = inline(Option<Wanted>), Query, description = "Those in a state"),
        ("after" = Option<String>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Translations)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let program = query.one("program")?;
    let state = query.among("state", &Wanted::ALL)?;
    let after = query.one("after")?.unwrap_or_default();
    let most = query.limit()?;
    query.end("program, state, after, limit")?;
    let (all, next) = shared
        .store(&caller, move |store| {
            let all = store.translations(program.as_deref(), state, &after, most)?;
            let next = all.last().filter(|_| all.len() == most as usize).map(|last| last.id.clone());
            let all = all.iter().map(|own| document(store, own)).collect::<Result<Vec<_>, _>>()?;
            Ok((all, next))
        })
        .await?;
    Ok(http::json(&Translations { translations: all, next }))
}

/// Gives what is known of a translation.
// It has no tag: what is stale changes with others.
#[utoipa::path(get, path = "/api/v1/translations/{id}", tag = TAG,
    params(("id" = String, Path)),
    responses((status = 200, body = TranslationDocument)))]
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

/// Gives a result of a translation.
///
/// `output` is its text, `report` the diagnostics, `map` the source line of each line of the output, `certificate` the verdict
/// of the comparison of both programs.
#[utoipa::path(get, path = "/api/v1/translations/{id}/{what}", tag = TAG,
    params(("id" = String, Path), ("what" = inline(Outcome), Path), ("If-None-Match" = Option<String>, Header)),
    responses(
        (status = 200, headers(("ETag" = String)), content((String = "text/plain"), (Value = "application/json"))),
        (status = 304),
    ))]
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
        // The tag reveals nothing without the right to read.
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
