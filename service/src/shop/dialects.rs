//! Dialects: those that come with ncc, and dictionaries of the shop, which may build on them and on each other.
//!
//! A dictionary is kept where nothing of the shop is lost by it: dictionaries that build on it and profiles that name its
//! dialect can be read as before. One that something builds on is not deleted. Programs of custom functions (`[functions]`)
//! are never started here.

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State};
use axum::http::{HeaderMap, StatusCode};
use axum::response::Response;
use ncc_dialects::Dialect;
use serde::Serialize;
use utoipa::ToSchema;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use super::known::shop;
use super::revisions::{self, Revisions};
use super::texts::{self, Asked};
use crate::Shared;
use crate::access::Caller;
use crate::http::body::Name;
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::store::Sort;

/// Group of the addresses in the description.
const TAG: &str = "dialects";

/// The sort of the texts.
const SORT: Sort = Sort::Dialect;

/// Addresses of dialects.
pub(super) fn routes() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new()
        .routes(routes!(list))
        .routes(routes!(read, keep, delete))
        .routes(routes!(revisions))
        .routes(routes!(revision))
        .routes(routes!(restore))
}

/// A dialect.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Dialect)]
struct DialectDocument {
    /// Name in addresses, and of its dictionary.
    name: String,
    /// It comes with ncc.
    ships_with_ncc: bool,
    /// Its title; none of a dictionary that cannot be read.
    title: Option<String>,
    /// Dialect that its dictionary builds on.
    base: Option<String>,
    /// Its dictionary cannot be read by this ncc, as that of another could.
    is_faulty: bool,
}

/// All dialects.
#[derive(Debug, Serialize, ToSchema)]
struct Dialects {
    dialects: Vec<DialectDocument>,
}

/// Lists dialects.
#[utoipa::path(get, path = "/api/v1/dialects", tag = TAG, responses((status = 200, body = Dialects)))]
async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let (texts, shop) = shared.store(&caller, |store| Ok(shop(store)?)).await?;
    let document = |dialect: &Dialect, ships_with_ncc| DialectDocument {
        name: dialect.id.clone(),
        ships_with_ncc,
        title: Some(dialect.title.clone()),
        base: dialect.base.clone(),
        is_faulty: false,
    };
    let own = texts.into_iter().map(|own| match shop.dialects.get(&own.name) {
        Some(dialect) => document(dialect, false),
        None => DialectDocument {
            name: own.name,
            ships_with_ncc: false,
            title: None,
            base: None,
            is_faulty: true,
        },
    });
    let shipped = ncc_dialects::builtins().map(|dialect| document(dialect, true));
    Ok(http::json(&Dialects { dialects: shipped.chain(own).collect() }))
}

/// Gives a dictionary, as its owner wrote it.
#[utoipa::path(get, path = "/api/v1/dialects/{name}", tag = TAG,
    params(("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"), ("If-None-Match" = Option<String>, Header)),
    responses(
        (status = 200, body = String, content_type = "application/toml"),
        (status = 304),
    ))]
async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    texts::read(&shared, &caller, Asked { sort: SORT, name, query, headers }).await
}

/// Keeps a dictionary.
#[utoipa::path(put, path = "/api/v1/dialects/{name}", tag = TAG,
    params(("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"), ("If-Match" = Option<String>, Header)),
    request_body(content = String, content_type = "application/toml"),
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
    texts::keep(&shared, &caller, Asked { sort: SORT, name, query, headers }, body).await
}

/// Deletes a dictionary on which nothing of the shop builds.
#[utoipa::path(delete, path = "/api/v1/dialects/{name}", tag = TAG,
    params(("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"), ("If-Match" = Option<String>, Header)),
    responses((status = 204)))]
async fn delete(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<StatusCode, Problem> {
    texts::delete(&shared, &caller, Asked { sort: SORT, name, query, headers }).await
}

/// Lists the revisions of a dictionary, the newest first.
#[utoipa::path(get, path = "/api/v1/dialects/{name}/revisions", tag = TAG,
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("before" = Option<i64>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Revisions)))]
async fn revisions(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    revisions::list(&shared, &caller, Asked { sort: SORT, name, query, headers }).await
}

/// Gives a dictionary as it was in a revision.
#[utoipa::path(get, path = "/api/v1/dialects/{name}/revisions/{number}", tag = TAG,
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("number" = i64, Path, minimum = 1),
        ("If-None-Match" = Option<String>, Header),
    ),
    responses(
        (status = 200, body = String, content_type = "application/toml"),
        (status = 304),
    ))]
async fn revision(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((name, number)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    revisions::read(&shared, &caller, Asked { sort: SORT, name, query, headers }, &number).await
}

/// Makes a new revision that is as an earlier one, unless the dictionary is so already; a deleted dialect is there again.
#[utoipa::path(post, path = "/api/v1/dialects/{name}/revisions/{number}/restore", tag = TAG,
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("number" = i64, Path, minimum = 1),
        ("If-Match" = Option<String>, Header),
    ),
    responses((status = 201, headers(("Location" = String), ("ETag" = String)))))]
async fn restore(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((name, number)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    revisions::restore(&shared, &caller, Asked { sort: SORT, name, query, headers }, &number).await
}
