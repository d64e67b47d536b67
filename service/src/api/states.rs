//! States of translations: draft, in review, approved, released, obsolete.
//!
//! ```text
//! GET  /api/v1/translations/ID/states    what it has gone through
//! POST /api/v1/translations/ID/states    { "state": "released", "message": "…" }
//! ```
//!
//! A translation is released only while it is not stale, and with a certificate that says that both programs make the same
//! cut.

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State as Here};
use axum::http::HeaderMap;
use axum::response::Response;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::ToSchema;

use super::document::message_fits;
use super::translations::{TranslationDocument, document};
use crate::Shared;
use crate::access::Caller;
use crate::http::body;
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::store::{Said, State, Step, Store, StoreError, Translation};
use crate::translating::{certificate, stale};

/// Verdicts of a certificate with which a translation may be released.
const SAME: [&str; 2] = ["equal", "equal-within-tolerance"];

/// The state that is asked for.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = NextState)]
struct Asked {
    state: State,
    /// A message for the history.
    #[serde(default)]
    #[schema(max_length = 2000)]
    message: String,
}

/// A change of the state.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = StateChange)]
struct StepDocument {
    /// Counted from 1.
    number: i64,
    state: State,
    author: String,
    message: String,
    /// Its time, UTC.
    #[schema(format = DateTime)]
    made: String,
}

/// The history of a translation's states.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = StateChanges)]
struct Steps {
    states: Vec<StepDocument>,
}

fn told(step: &Step) -> StepDocument {
    StepDocument {
        number: step.number,
        state: step.state,
        author: step.said.author.clone(),
        message: step.said.message.clone(),
        made: http::moment(step.made),
    }
}

/// Lists the states that a translation has gone through.
#[utoipa::path(get, path = "/api/v1/translations/{id}/states", tag = "translations",
    params(("id" = String, Path)),
    responses((status = 200, body = Steps)))]
pub(super) async fn list(
    Here(shared): Here<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let steps = shared.store(&caller, move |store| Ok(store.steps(&id)?)).await?;
    Ok(http::json(&Steps { states: steps.iter().map(told).collect() }))
}

/// Puts a translation into another state.
///
/// It is released only while it is not stale, and with a certificate that both programs make the same cut.
#[utoipa::path(post, path = "/api/v1/translations/{id}/states", tag = "translations",
    params(("id" = String, Path)),
    request_body = Asked,
    responses((status = 200, body = TranslationDocument)))]
pub(super) async fn step(
    Here(shared): Here<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let asked: Asked = body::json(&headers, body)?;
    message_fits(&asked.message)?;
    let said = Said { author: caller.name().to_owned(), message: asked.message };
    let document = shared
        .compile(&caller, move |store| {
            store.allows_step(&id, asked.state)?;
            let of = store.translation(&id)?;
            may_step(store, &of, asked.state)?;
            let holds =
                || asked.state != State::Released || stale(store, &of).is_ok_and(|stale| stale.is_empty());
            store.step(&id, asked.state, &said, holds)?;
            document(store, &store.translation(&id)?)
        })
        .await?;
    Ok(http::json(&document))
}

/// Whether a translation may be put into a state now.
fn may_step(store: &Store, of: &Translation, to: State) -> Result<(), Problem> {
    if !of.state.next().contains(&to) {
        let next: Vec<_> = of.state.next().iter().map(|state| state.name()).collect();
        let words = format!("it is `{}`, and cannot become `{}`", of.state.name(), to.name());
        return Err(Problem::conflict(words).help(format!("it can become: {}", next.join(", "))));
    }
    if to != State::Released {
        return Ok(());
    }
    let changed = stale(store, of)?;
    if !changed.is_empty() {
        return Err(Problem::conflict(format!("it is stale: changed since are {}", changed.join(", ")))
            .help("translate the program again"));
    }
    let certificate: Value =
        serde_json::from_slice(&certificate(store, of)?).map_err(|_| StoreError::Absent)?;
    let verdict = certificate["verdict"].as_str().unwrap_or_default();
    match SAME.contains(&verdict) {
        true => Ok(()),
        false => Err(Problem::conflict(format!("its certificate says `{verdict}`"))
            .help(format!("GET /api/v1/translations/{}/certificate says where", of.id))),
    }
}
