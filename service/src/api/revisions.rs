//! The history of a program.

use std::sync::Arc;

use axum::extract::{Path, RawQuery, State};
use axum::http::HeaderMap;
use axum::response::Response;
use serde::Serialize;
use utoipa::ToSchema;

use super::document::{Program, changed, document, number, said, told};
use crate::Shared;
use crate::access::Caller;
use crate::http::conditions::expected;
use crate::http::query::Query;
use crate::http::{self, Problem};

/// Group of the addresses in the description.
const TAG: &str = "programs";

/// A revision in the list.
#[derive(Debug, Serialize, ToSchema)]
struct Listed {
    #[serde(flatten)]
    revision: Program,
    /// The motion of this revision and of the one before it; none of the first revision.
    comparison: Option<Compared>,
}

/// A comparison with the revision before.
#[derive(Debug, Serialize, ToSchema)]
struct Compared {
    /// `equal`, `different`, `not-compared`; `waiting` where it is not known yet.
    state: &'static str,
    /// The same in a line; empty where it is not known yet.
    line: String,
}

/// A page of revisions.
#[derive(Debug, Serialize, ToSchema)]
struct Revisions {
    revisions: Vec<Listed>,
    /// Value of `before` for the next page.
    next: Option<i64>,
}

/// Lists the revisions of a program, the newest first.
#[utoipa::path(get, path = "/api/v1/programs/{id}/revisions", tag = TAG,
    params(
        ("id" = String, Path),
        ("before" = Option<i64>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Revisions)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let before = query.number("before")?.unwrap_or(i64::MAX);
    let most = query.limit()?;
    query.end("before, limit")?;
    let (listed, mut comparisons) = shared
        .store(&caller, move |store| {
            let listed = store.revisions(&id, before, most)?;
            let ends = [listed.last(), listed.first()].map(|end| end.map_or(0, |end| end.number));
            let comparisons = store.comparisons(&id, ends)?;
            Ok((listed, comparisons))
        })
        .await?;
    let next = listed.last().filter(|last| last.number > 1).map(|last| last.number);
    let next = next.filter(|_| listed.len() == most as usize);
    let revisions = listed.iter().map(|of| {
        let comparison = comparisons.remove(&of.number);
        let comparison = comparison.map(|own| Compared { state: own.verdict.name(), line: own.line });
        Listed { revision: document(of), comparison }
    });
    Ok(http::json(&Revisions { revisions: revisions.collect(), next }))
}

/// Gives what was known of a program in a revision.
#[utoipa::path(get, path = "/api/v1/programs/{id}/revisions/{number}", tag = TAG,
    params(("id" = String, Path), ("number" = i64, Path, minimum = 1), ("If-None-Match" = Option<String>, Header)),
    responses((status = 200, body = Program, headers(("ETag" = String))), (status = 304)))]
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

/// Makes a new revision that is as an earlier one; a deleted program is there again.
#[utoipa::path(post, path = "/api/v1/programs/{id}/revisions/{number}/restore", tag = TAG,
    params(
        ("id" = String, Path),
        ("number" = i64, Path, minimum = 1),
        ("message" = Option<String>, Query, max_length = 2000, description = "A message for the revision"),
        ("If-Match" = Option<String>, Header),
    ),
    responses((status = 201, body = Program, headers(("Location" = String), ("ETag" = String)))))]
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
