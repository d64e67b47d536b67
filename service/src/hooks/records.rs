//! Hooks, for admins.
//!
//! ```text
//! POST   /api/v1/hooks       { "target": "https://erp.example/hooks", "events": ["release"], "folder": "plates" }
//! GET    /api/v1/hooks       all of them, without their secrets
//! GET    /api/v1/hooks/ID
//! DELETE /api/v1/hooks/ID    with its deliveries
//! ```

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State};
use axum::http::header::LOCATION;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{TAG, signing};
use crate::Shared;
use crate::access::Caller;
use crate::http::query::Query;
use crate::http::{self, Problem, body};
use crate::rights::Act;
use crate::store::{EventKind, Hook, HookState};

/// A new hook.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = NewHook)]
struct Asked {
    /// The address that is told: below one that the service was started with.
    #[schema(max_length = 2000, pattern = "^[Hh][Tt][Tt][Pp][Ss]?://")]
    target: String,
    /// The kinds of events.
    #[schema(min_items = 1)]
    events: Vec<EventKind>,
    /// The folder, with those below it; empty is everything. A job is in it if all of its programs are.
    #[serde(default)]
    folder: String,
}

/// A hook.
#[derive(Serialize, ToSchema)]
#[schema(as = Hook)]
struct HookDocument {
    /// Name in addresses.
    id: String,
    target: String,
    events: Vec<EventKind>,
    folder: String,
    state: HookState,
    /// Whether the process that answers may send to the target.
    allowed: bool,
    author: String,
    /// Its begin, UTC.
    #[schema(format = DateTime)]
    made: String,
    /// The secret that signs: in the answer to its maker alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    secret: Option<String>,
}

/// A page of hooks.
#[derive(Serialize, ToSchema)]
struct Hooks {
    hooks: Vec<HookDocument>,
    /// Value of `after` for the next page.
    next: Option<String>,
}

fn told(shared: &Shared, hook: Hook) -> HookDocument {
    let targets = shared.targets.get();
    HookDocument {
        allowed: targets.is_some_and(|targets| targets.allowed(&hook.target).is_ok()),
        id: hook.id,
        target: hook.target,
        events: hook.events,
        folder: hook.folder,
        state: hook.state,
        author: hook.author,
        made: http::moment(hook.made),
        secret: None,
    }
}

/// Makes a hook. Its secret is in this answer alone.
#[utoipa::path(post, path = "/api/v1/hooks", tag = TAG,
    request_body = Asked,
    responses((status = 201, body = HookDocument, headers(("Location" = String)))))]
pub(super) async fn create(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Administer, "")?;
    let Asked { target, mut events, folder } = body::json(&headers, body)?;
    events.sort_unstable();
    events.dedup();
    if events.is_empty() {
        return Err(Problem::content("a hook without events is told of nothing")
            .help("there are: release, stale, job"));
    }
    crate::api::folder_fits(&folder)?;
    let none = || {
        Problem::content("this service sends to no address")
            .help("ncc serve --hook-target URL names an address below which it may send")
    };
    let refused = |why: &str| {
        Problem::content(format!("it cannot be the target: {why}"))
            .help("ncc serve --hook-target URL names an address below which it may send")
    };
    let shown = shared.targets.get().ok_or_else(none)?.allowed(&target).map_err(refused)?.shown();
    let mut hook = Hook {
        id: crate::api::new_id()?,
        target,
        events,
        folder,
        state: HookState::Active,
        author: caller.name().to_owned(),
        made: 0,
    };
    let (own, secret) = (hook.clone(), signing::secret()?);
    hook.made = shared.store(&caller, move |store| Ok(store.create_hook(&own, &secret, &shown)?)).await?;
    let place = format!("/api/v1/hooks/{}", hook.id);
    let document = HookDocument { secret: Some(signing::shown(&secret)), ..told(&shared, hook) };
    Ok((StatusCode::CREATED, [(LOCATION, place)], http::json(&document)).into_response())
}

/// Lists the hooks.
#[utoipa::path(get, path = "/api/v1/hooks", tag = TAG,
    params(
        ("after" = Option<String>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Hooks)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    caller.may(Act::Administer, "")?;
    let mut query = Query::of(query.as_deref());
    let after = query.one("after")?.unwrap_or_default();
    let most = query.limit()?;
    query.end("after, limit")?;
    let hooks = shared.store(&caller, move |store| Ok(store.hooks(&after, most)?)).await?;
    let next = hooks.last().filter(|_| hooks.len() == most as usize).map(|last| last.id.clone());
    let hooks = hooks.into_iter().map(|hook| told(&shared, hook)).collect();
    Ok(http::json(&Hooks { hooks, next }))
}

/// Gives a hook.
#[utoipa::path(get, path = "/api/v1/hooks/{id}", tag = TAG,
    params(("id" = String, Path)),
    responses((status = 200, body = HookDocument)))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Administer, "")?;
    let hook = shared.store(&caller, move |store| Ok(store.hook(&id)?)).await?;
    Ok(http::json(&told(&shared, hook)))
}

/// Deletes a hook with its deliveries.
#[utoipa::path(delete, path = "/api/v1/hooks/{id}", tag = TAG,
    params(("id" = String, Path)),
    responses((status = 204)))]
pub(super) async fn delete(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Administer, "")?;
    shared.store(&caller, move |store| Ok(store.delete_hook(&id)?)).await?;
    Ok(StatusCode::NO_CONTENT)
}
