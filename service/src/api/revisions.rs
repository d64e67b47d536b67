//! The history of a program.

use std::sync::Arc;

use axum::extract::{Path, RawQuery, State};
use axum::http::HeaderMap;
use axum::response::Response;
use serde_json::{Value, json};

use super::document::{changed, document, number, said, told};
use crate::Shared;
use crate::access::Caller;
use crate::http::body::LISTED;
use crate::http::conditions::expected;
use crate::http::query::Query;
use crate::http::{self, Problem};

/// Lists revisions, the newest first.
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let before = query.number("before")?.unwrap_or(i64::MAX);
    let most = query.number("limit")?.unwrap_or(LISTED[0]).clamp(1, LISTED[1]);
    query.end("before, limit")?;
    let listed = shared.store(&caller, move |store| Ok(store.revisions(&id, before, most)?)).await?;
    let next = listed.last().filter(|last| last.number > 1).map(|last| last.number);
    let next = next.filter(|_| listed.len() == most as usize);
    let revisions: Vec<Value> = listed.iter().map(document).collect();
    Ok(http::json(&json!({ "revisions": revisions, "next": next })))
}

/// Tells what was known of a program.
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((id, revision)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let revision = number(&revision)?;
    let found = shared.store(&caller, move |store| Ok(store.revision(&id, revision)?)).await?;
    Ok(told(&found, &headers))
}

/// Makes a program again what it was.
pub(super) async fn restore(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((id, revision)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let said = said(&mut query, caller.name())?;
    query.end("message")?;
    let over = expected(&headers)?;
    let revision = number(&revision)?;
    let made = shared.store(&caller, move |store| Ok(store.restore(&id, revision, &said, &over)?)).await?;
    let place = format!("/api/v1/programs/{}/revisions/{}", made.program, made.number);
    Ok(changed(&made, Some(place)))
}
