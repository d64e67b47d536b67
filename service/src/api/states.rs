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
use serde::Deserialize;
use serde_json::{Value, json};

use super::document::message_fits;
use super::translations::document;
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
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    state: State,
    #[serde(default)]
    message: String,
}

fn told(step: &Step) -> Value {
    json!({
        "number": step.number,
        "state": step.state,
        "author": step.said.author,
        "message": step.said.message,
        "made": http::moment(step.made),
    })
}

/// Lists what a translation has gone through.
pub(super) async fn list(
    Here(shared): Here<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let steps = shared.store(&caller, move |store| Ok(store.steps(&id)?)).await?;
    let steps: Vec<Value> = steps.iter().map(told).collect();
    Ok(http::json(&json!({ "states": steps })))
}

/// Puts a translation into another state.
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
