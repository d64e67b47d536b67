//! Accounts, for their admins.
//!
//! ```text
//! GET    /api/v1/accounts         all of them
//! POST   /api/v1/accounts         { "name": "ana", "password": "…", "rights": [{ "folder": "plates", "role": "editor" }] }
//! GET    /api/v1/accounts/NAME
//! PATCH  /api/v1/accounts/NAME    { "rights": [ … ], "disabled": true, "password": "…" }: each may be left out
//! DELETE /api/v1/accounts/NAME    disables it: its changes keep its name
//! ```

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State};
use axum::http::header::LOCATION;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::{Value, json};

use super::caller::Caller;
use super::checks::{self, password_fits};
use super::guard::now_needed;
use super::sessions::not_compared;
use crate::Shared;
use crate::http::body::LISTED;
use crate::http::query::Query;
use crate::http::{self, Problem, body};
use crate::rights::{Act, Right};
use crate::store::{Account, AccountChange};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct New {
    name: String,
    password: String,
    rights: Vec<Right>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Patch {
    rights: Option<Vec<Right>>,
    disabled: Option<bool>,
    password: Option<String>,
}

fn told(account: &Account) -> Value {
    json!({
        "name": account.name,
        "disabled": account.is_disabled,
        "rights": account.rights,
        "made": http::moment(account.made),
    })
}

/// Makes an account. The first one is an admin; from then on a login is needed.
pub(super) async fn create(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Administer, "")?;
    let New { name, password, rights } = body::json(&headers, body)?;
    checks::account(&name)?;
    password_fits(&password)?;
    checks::rights(&rights)?;
    let digest = shared.guard.passwords.digest(password).await.map_err(not_compared)?;
    let made = shared.store(&caller, move |store| Ok(store.create_account(&name, &digest, &rights)?)).await?;
    now_needed(&shared);
    let place = format!("/api/v1/accounts/{}", made.name);
    Ok((StatusCode::CREATED, [(LOCATION, place)], http::json(&told(&made))).into_response())
}

/// Lists accounts.
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let after = query.one("after")?.unwrap_or_default();
    let most = query.number("limit")?.unwrap_or(LISTED[0]).clamp(1, LISTED[1]);
    query.end("after, limit")?;
    let accounts = shared.store(&caller, move |store| Ok(store.accounts(&after, most)?)).await?;
    let next = accounts.last().filter(|_| accounts.len() == most as usize).map(|last| last.name.clone());
    let accounts: Vec<Value> = accounts.iter().map(told).collect();
    Ok(http::json(&json!({ "accounts": accounts, "next": next })))
}

/// Tells of an account.
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(name): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let account = shared.store(&caller, move |store| Ok(store.account(&name)?)).await?;
    Ok(http::json(&told(&account)))
}

/// Changes an account.
pub(super) async fn change(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(name): Path<String>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Administer, "")?;
    let patch: Patch = body::json(&headers, body)?;
    checks::rights(patch.rights.as_deref().unwrap_or_default())?;
    let password = match patch.password {
        None => None,
        Some(password) => {
            password_fits(&password)?;
            Some(shared.guard.passwords.digest(password).await.map_err(not_compared)?)
        }
    };
    let change = AccountChange { rights: patch.rights, is_disabled: patch.disabled, password };
    let account = shared.store(&caller, move |store| Ok(store.change_account(&name, &change)?)).await?;
    Ok(http::json(&told(&account)))
}

/// Disables an account.
pub(super) async fn delete(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(name): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    let change = AccountChange { is_disabled: Some(true), ..AccountChange::default() };
    shared.store(&caller, move |store| Ok(store.change_account(&name, &change)?)).await?;
    Ok(StatusCode::NO_CONTENT)
}
