//! Tokens of programs that ask for an account. A token does what its account may do, and no more than its scopes.
//!
//! ```text
//! POST   /api/v1/tokens       { "name": "erp", "scopes": ["read"], "expires": "2027-01-01T00:00:00Z" }
//! GET    /api/v1/tokens       those of the own account, without their secrets
//! DELETE /api/v1/tokens/ID
//! ```

use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State};
use axum::http::header::LOCATION;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::{Value, json};

use super::caller::Caller;
use super::secrets;
use crate::Shared;
use crate::http::body::LISTED;
use crate::http::query::Query;
use crate::http::{self, Problem, body};
use crate::rights::Scope;
use crate::store::Token;

/// Seconds for which a token holds where nothing else is stated.
const DAYS_90: i64 = 90 * 86_400;

/// Signs of the name of a token in addresses.
const ID: usize = 20;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    name: String,
    scopes: Vec<Scope>,
    expires: Option<String>,
}

/// Seconds since 1970 (UTC).
fn now() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    since.map_or(0, |since| i64::try_from(since.as_secs()).unwrap_or(0))
}

/// A token with its secret, which is shown once.
pub(super) struct Made {
    pub(super) token: Token,
    pub(super) secret: String,
}

/// Makes a token.
///
/// # Errors
/// Its name or its end is not of the form, or it may do nothing.
pub(super) fn make(name: &str, mut scopes: Vec<Scope>, expires: Option<&str>) -> Result<Made, Problem> {
    body::name(name).map_err(|problem| Problem::content(problem.detail()))?;
    scopes.sort_unstable();
    scopes.dedup();
    if scopes.is_empty() {
        return Err(Problem::content("a token without scopes can do nothing")
            .help(format!("there are: {}", Scope::NAMES.join(", "))));
    }
    let made = now();
    let expires = match expires {
        None => made + DAYS_90,
        Some(text) => {
            let form =
                || Problem::content(format!("`{text}` is no moment to come")).help("2027-01-01T00:00:00Z");
            let moment =
                humantime::parse_rfc3339(text).ok().and_then(|at| at.duration_since(UNIX_EPOCH).ok());
            let moment = moment.and_then(|since| i64::try_from(since.as_secs()).ok());
            moment.filter(|moment| *moment > made).ok_or_else(form)?
        }
    };
    let id = crate::chance::signs(ID).map_err(|_| Problem::fault())?;
    let secret = format!("{}{}", secrets::TOKEN, secrets::secret()?);
    Ok(Made { token: Token { id, name: name.to_owned(), scopes, made, expires }, secret })
}

fn told(token: &Token) -> Value {
    json!({
        "id": token.id,
        "name": token.name,
        "scopes": token.scopes,
        "made": http::moment(token.made),
        "expires": http::moment(token.expires),
    })
}

/// Makes a token of the user's account.
pub(super) async fn create(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    // A token that makes tokens would never end.
    caller.login()?;
    let Asked { name, scopes, expires } = body::json(&headers, body)?;
    let made = make(&name, scopes, expires.as_deref())?;
    let (token, account) = (made.token.clone(), caller.name().to_owned());
    let digest = secrets::kept(&made.secret);
    shared.store(&caller, move |store| Ok(store.create_token(&account, &token, &digest)?)).await?;
    let mut document = told(&made.token);
    document["token"] = json!(made.secret);
    let place = format!("/api/v1/tokens/{}", made.token.id);
    Ok((StatusCode::CREATED, [(LOCATION, place)], http::json(&document)).into_response())
}

/// Lists the tokens of the user's account.
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let after = query.one("after")?.unwrap_or_default();
    let most = query.number("limit")?.unwrap_or(LISTED[0]).clamp(1, LISTED[1]);
    query.end("after, limit")?;
    caller.login()?;
    let tokens = shared.store(&caller, move |store| Ok(store.tokens(&after, most)?)).await?;
    let next = tokens.last().filter(|_| tokens.len() == most as usize).map(|last| last.id.clone());
    let tokens: Vec<Value> = tokens.iter().map(told).collect();
    Ok(http::json(&json!({ "tokens": tokens, "next": next })))
}

/// Takes a token of the user's account back.
pub(super) async fn delete(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.login()?;
    shared.store(&caller, move |store| Ok(store.delete_token(&id)?)).await?;
    Ok(StatusCode::NO_CONTENT)
}
