//! The history of a profile.

use std::sync::Arc;

use axum::extract::{Path, RawQuery, State};
use axum::http::header::{ETAG, LOCATION};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

use super::{TAG, fits, told};
use crate::Shared;
use crate::access::Caller;
use crate::api::revision_number;
use crate::http::body::{self, Name, encoded};
use crate::http::conditions::{etag, expected, is_known, not_modified};
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;
use crate::store::MachineRevision;

/// A revision of a profile.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = MachineRevision)]
struct Revision {
    /// Its number, from 1.
    number: i64,
    /// The machine was deleted.
    deleted: bool,
    /// The account that made it; empty of profiles that are older than their revisions.
    author: String,
    /// Its time, UTC.
    #[schema(format = DateTime)]
    made: String,
}

/// A page of revisions.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = MachineRevisions)]
struct Revisions {
    revisions: Vec<Revision>,
    /// Value of `before` for the next page.
    next: Option<i64>,
}

fn document(of: &MachineRevision) -> Revision {
    Revision {
        number: of.number,
        deleted: of.text.is_none(),
        author: of.author.clone(),
        made: http::moment(of.made),
    }
}

/// The text of a revision that has one.
fn text_of(of: MachineRevision) -> Result<(String, String), Problem> {
    match of.text {
        Some(text) => Ok((text, of.tag)),
        None => Err(Problem::absent("the machine was deleted in this revision")),
    }
}

/// Lists the revisions of a profile, the newest first.
#[utoipa::path(get, path = "/api/v1/machines/{name}/revisions", tag = TAG,
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("before" = Option<i64>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Revisions)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let before = query.number("before")?.unwrap_or(i64::MAX);
    let most = query.limit()?;
    query.end("before, limit")?;
    let listed =
        shared.store(&caller, move |store| Ok(store.machine_revisions(&name, before, most)?)).await?;
    let next = listed.last().filter(|last| last.number > 1).map(|last| last.number);
    let next = next.filter(|_| listed.len() == most as usize);
    Ok(http::json(&Revisions { revisions: listed.iter().map(document).collect(), next }))
}

/// Gives a profile as it was in a revision.
#[utoipa::path(get, path = "/api/v1/machines/{name}/revisions/{number}", tag = TAG,
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("number" = i64, Path, minimum = 1),
        ("If-None-Match" = Option<String>, Header),
    ),
    responses(
        (status = 200, content((String = "application/toml"), (Value = "application/json"))),
        (status = 304),
    ))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((name, number)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    body::name(&name)?;
    let number = revision_number(&number)?;
    let found = shared.store(&caller, move |store| Ok(store.machine_revision(&name, number)?)).await?;
    let (text, tag) = text_of(found)?;
    let tag = etag(&tag, "");
    Ok(if is_known(&headers, &tag) { not_modified(tag) } else { told(text, tag) })
}

/// Makes a new revision that is as an earlier one, unless the profile is so already; a deleted machine is there again.
#[utoipa::path(post, path = "/api/v1/machines/{name}/revisions/{number}/restore", tag = TAG,
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("number" = i64, Path, minimum = 1),
        ("If-Match" = Option<String>, Header),
    ),
    responses((status = 201, headers(("Location" = String), ("ETag" = String)))))]
pub(super) async fn restore(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((name, number)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Administer, "")?;
    let over = expected(&headers)?;
    body::name(&name)?;
    let number = revision_number(&number)?;
    let place = format!("/api/v1/machines/{}", encoded(&name));
    let (tag, _) = shared
        .store(&caller, move |store| {
            let (text, _) = text_of(store.machine_revision(&name, number)?)?;
            // A later ncc may have another idea of profiles, or a machine of this name.
            fits(&name, &text)?;
            Ok(store.keep_machine(&name, &text, &over)?)
        })
        .await?;
    Ok((StatusCode::CREATED, [(LOCATION, place), (ETAG, etag(&tag, ""))]).into_response())
}
