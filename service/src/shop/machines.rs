//! Machines: those that come with ncc, and profiles of the shop. A profile is TOML; the case study's machine.json is taken too.

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State};
use axum::http::{HeaderMap, StatusCode};
use axum::response::Response;
use serde::Serialize;
use utoipa::ToSchema;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use super::known::{dialects, profile};
use super::revisions::{self, Revisions};
use super::texts::{self, Asked};
use crate::Shared;
use crate::access::Caller;
use crate::http::body::Name;
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::store::Sort;

/// Group of the addresses in the description.
const TAG: &str = "machines";

/// The sort of the texts.
const SORT: Sort = Sort::Machine;

/// Addresses of machines.
pub(super) fn routes() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new()
        .routes(routes!(list))
        .routes(routes!(read, keep, delete))
        .routes(routes!(revisions))
        .routes(routes!(revision))
        .routes(routes!(restore))
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
    let (own, dialects) =
        shared.store(&caller, |store| Ok((store.shop_texts(SORT)?, dialects(store)?))).await?;
    let own = own.into_iter().map(|machine| {
        let profile = profile(&machine.text, &dialects).ok();
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
    texts::read(&shared, &caller, Asked { sort: SORT, name, query, headers }).await
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
    texts::keep(&shared, &caller, Asked { sort: SORT, name, query, headers }, body).await
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
    texts::delete(&shared, &caller, Asked { sort: SORT, name, query, headers }).await
}

/// Lists the revisions of a profile, the newest first.
#[utoipa::path(get, path = "/api/v1/machines/{name}/revisions", tag = TAG,
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
async fn revision(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((name, number)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    revisions::read(&shared, &caller, Asked { sort: SORT, name, query, headers }, &number).await
}

/// Makes a new revision that is as an earlier one, unless the profile is so already; a deleted machine is there again.
#[utoipa::path(post, path = "/api/v1/machines/{name}/revisions/{number}/restore", tag = TAG,
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
