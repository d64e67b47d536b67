//! Sessions: who is logged in, login, logout, the own password.
//!
//! ```text
//! GET    /api/v1/session             { "user": "ana", "login": "needed", "rights": [ … ], "csrf": "…" }
//! POST   /api/v1/session             { "user": "ana", "password": "…" }
//! DELETE /api/v1/session
//! PUT    /api/v1/session/password    { "old": "…", "new": "…" }
//! ```

use std::sync::Arc;

use axum::Extension;
use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{RawQuery, State};
use axum::http::header::SET_COOKIE;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::buckets::Holder;
use super::caller::Caller;
use super::checks::{is_account, password_fits};
use super::guard::is_needed;
use super::passwords::NotCompared;
use super::secrets;
use crate::Shared;
use crate::http::connections::Peer;
use crate::http::query::Query;
use crate::http::{self, Problem, body};
use crate::rights::{Right, Via, Who};
use crate::store::LONGEST;

/// Group of the addresses in the description.
const TAG: &str = "accounts";

/// A login.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
struct Login {
    user: String,
    #[schema(format = Password)]
    password: String,
}

/// Another password of the user's account.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = PasswordChange)]
struct Change {
    #[schema(format = Password)]
    old: String,
    #[schema(format = Password)]
    new: String,
}

/// The user of a request.
#[derive(Serialize, ToSchema)]
#[schema(as = Session)]
struct SessionDocument<'s> {
    /// The account, or the user of this computer; none without a login.
    user: Option<&'s str>,
    /// `needed`, or `none` while there is no account.
    login: &'static str,
    rights: &'s [Right],
    /// Value of the header `X-NCC-CSRF` for requests that change something.
    csrf: &'s str,
}

fn told(user: Option<&str>, is_needed: bool, rights: &[Right], csrf: &str) -> Response {
    let login = if is_needed { "needed" } else { "none" };
    http::json(&SessionDocument { user, login, rights, csrf })
}

/// Gives the user of the request, and whether a login is needed.
#[utoipa::path(get, path = "/api/v1/session", tag = TAG, responses((status = 200, body = SessionDocument<'static>)))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Option<Extension<Caller>>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let is_needed = is_needed(&shared).await?;
    let Some(Extension(caller)) = caller else { return Ok(told(None, is_needed, &[], "")) };
    let who = caller.who();
    let secret = secrets::session(&headers).filter(|_| matches!(who.via, Via::Login(_)));
    let csrf = secret.map(|secret| secrets::csrf(&secret)).unwrap_or_default();
    Ok(told(Some(&who.name), is_needed, &who.rights, &csrf))
}

/// Attempts of an account and of an address count, until one of them is right.
fn attempt(shared: &Arc<Shared>, holders: &[Holder]) -> Result<(), Problem> {
    holders.iter().try_for_each(|holder| shared.guard.attempts.take(holder)).map_err(Problem::too_many)
}

/// Whether the password is that of the account, and the account is not disabled.
async fn is_right(shared: &Arc<Shared>, ncc: &Caller, user: &str, password: String) -> Result<bool, Problem> {
    let name = user.to_owned();
    let found = shared.store(ncc, move |store| Ok(store.password(&name)?)).await?;
    let is_disabled = found.as_ref().is_some_and(|(_, is_disabled)| *is_disabled);
    let has = shared.guard.passwords.has(password, found.map(|(digest, _)| digest)).await;
    Ok(has.map_err(not_compared)? && !is_disabled)
}

pub(super) fn not_compared(not: NotCompared) -> Problem {
    match not {
        NotCompared::Busy => Problem::busy("too many log in at once"),
        NotCompared::Broken => Problem::fault(),
    }
}

/// Begins a session: a cookie, with a new secret whatever cookie has come.
#[utoipa::path(post, path = "/api/v1/session", tag = TAG,
    request_body = Login,
    responses((status = 200, body = SessionDocument<'static>, headers(("Set-Cookie" = String)))))]
pub(super) async fn login(
    State(shared): State<Arc<Shared>>,
    peer: Option<Extension<Peer>>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let Login { user, password } = body::json(&headers, body)?;
    if !is_needed(&shared).await? {
        return Err(Problem::conflict("there are no accounts, and no login is needed"));
    }
    let address = peer.map(|Extension(peer)| peer.0.ip());
    let mut holders: Vec<Holder> = address.map(Holder::at).into_iter().collect();
    // A name that no account can have is that of nobody: each of them counts as the same.
    holders.push(Holder::Account(if is_account(&user) { user.clone() } else { String::new() }));
    attempt(&shared, &holders)?;
    let ncc = Caller::of(Who { address, ..Who::service() });
    if !is_right(&shared, &ncc, &user, password).await? {
        // The name of an account that is not there may be a password, and is not written down.
        let failed = move |store: &crate::store::Store| {
            let known = store.password(&user)?.map_or("", |_| user.as_str());
            Ok(store.note_alone("login.failed", known, "")?)
        };
        shared.store(&ncc, failed).await?;
        return Err(Problem::wrong_login());
    }
    holders.iter().for_each(|holder| shared.guard.attempts.give_back(holder));
    let secret = secrets::secret()?;
    let (digest, before) =
        (secrets::kept(&secret), secrets::session(&headers).map(|own| secrets::kept(&own)));
    let who = Who { address, ..Who::account(&user, Vec::new(), Via::Login(digest.clone())) };
    let (name, idle) = (user.clone(), shared.guard.idle);
    let rights = shared
        .store(&Caller::of(who), move |store| Ok(store.log_in(&name, &digest, before.as_deref(), idle)?))
        .await?;
    let mut answer = told(Some(&user), true, &rights, &secrets::csrf(&secret));
    // The store ends a session that is not used earlier than the browser.
    set_cookie(&mut answer, &secrets::cookie(&secret, LONGEST, shared.guard.is_secure));
    Ok(answer)
}

fn set_cookie(answer: &mut Response, cookie: &str) {
    answer.headers_mut().extend(cookie.parse().ok().map(|value| (SET_COOKIE, value)));
}

/// Ends the session.
#[utoipa::path(delete, path = "/api/v1/session", tag = TAG, responses((status = 204)))]
pub(super) async fn logout(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let login = caller.login()?.to_owned();
    shared.store(&caller, move |store| Ok(store.log_out(&login)?)).await?;
    let mut answer = StatusCode::NO_CONTENT.into_response();
    set_cookie(&mut answer, &secrets::cookie("", 0, shared.guard.is_secure));
    Ok(answer)
}

/// Changes the password of the user's account. A stolen session does not have it, and cannot.
#[utoipa::path(put, path = "/api/v1/session/password", tag = TAG,
    request_body = Change,
    responses((status = 204)))]
pub(super) async fn password(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    let login = caller.login()?.to_owned();
    let Change { old, new } = body::json(&headers, body)?;
    password_fits(&new)?;
    let holder = Holder::Account(caller.name().to_owned());
    attempt(&shared, std::slice::from_ref(&holder))?;
    if !is_right(&shared, &caller, caller.name(), old).await? {
        return Err(Problem::wrong_login());
    }
    shared.guard.attempts.give_back(&holder);
    let digest = shared.guard.passwords.digest(new).await.map_err(not_compared)?;
    shared.store(&caller, move |store| Ok(store.change_own_password(&digest, &login)?)).await?;
    Ok(StatusCode::NO_CONTENT)
}
