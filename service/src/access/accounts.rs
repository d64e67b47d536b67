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
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::caller::Caller;
use super::checks::{self, password_fits};
use super::guard::now_needed;
use super::sessions::not_compared;
use crate::Shared;
use crate::http::query::Query;
use crate::http::{self, Problem, body};
use crate::rights::{Act, Right};
use crate::store::{Account, AccountChange};

/// Group of the addresses in the description.
const TAG: &str = "accounts";

/// A new account.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = NewAccount)]
struct New {
    name: String,
    #[schema(format = Password)]
    password: String,
    rights: Vec<Right>,
}

/// A change of an account: a field that is left out stays.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = AccountChange)]
struct Patch {
    rights: Option<Vec<Right>>,
    disabled: Option<bool>,
    #[schema(format = Password)]
    password: Option<String>,
}

/// An account.
#[derive(Serialize, ToSchema)]
#[schema(as = Account)]
struct AccountDocument {
    name: String,
    disabled: bool,
    rights: Vec<Right>,
    /// Its begin, UTC.
    #[schema(format = DateTime)]
    made: String,
}

/// A page of accounts.
#[derive(Serialize, ToSchema)]
struct Accounts {
    accounts: Vec<AccountDocument>,
    /// Value of `after` for the next page.
    next: Option<String>,
}

fn told(account: &Account) -> AccountDocument {
    AccountDocument {
        name: account.name.clone(),
        disabled: account.is_disabled,
        rights: account.rights.clone(),
        made: http::moment(account.made),
    }
}

/// Makes an account. The first one is an admin; from then on a login is needed.
#[utoipa::path(post, path = "/api/v1/accounts", tag = TAG,
    request_body = New,
    responses((status = 201, body = AccountDocument, headers(("Location" = String)))))]
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
#[utoipa::path(get, path = "/api/v1/accounts", tag = TAG,
    params(
        ("after" = Option<String>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Accounts)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let after = query.one("after")?.unwrap_or_default();
    let most = query.limit()?;
    query.end("after, limit")?;
    let accounts = shared.store(&caller, move |store| Ok(store.accounts(&after, most)?)).await?;
    let next = accounts.last().filter(|_| accounts.len() == most as usize).map(|last| last.name.clone());
    Ok(http::json(&Accounts { accounts: accounts.iter().map(told).collect(), next }))
}

/// Gives what is known of an account.
#[utoipa::path(get, path = "/api/v1/accounts/{name}", tag = TAG,
    params(("name" = String, Path)),
    responses((status = 200, body = AccountDocument)))]
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

/// Changes rights or password of an account, or disables it.
#[utoipa::path(patch, path = "/api/v1/accounts/{name}", tag = TAG,
    params(("name" = String, Path)),
    request_body = Patch,
    responses((status = 200, body = AccountDocument)))]
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
#[utoipa::path(delete, path = "/api/v1/accounts/{name}", tag = TAG,
    params(("name" = String, Path)),
    responses((status = 204)))]
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
