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
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::caller::Caller;
use super::secrets;
use crate::Shared;
use crate::http::query::Query;
use crate::http::{self, Problem, body};
use crate::rights::Scope;
use crate::store::Token;

/// Seconds for which a token holds where nothing else is stated.
const DAYS_90: i64 = 90 * 86_400;

/// Signs of the name of a token in addresses.
const ID: usize = 20;

/// Group of the addresses in the description.
const TAG: &str = "accounts";

/// A new token.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = NewToken)]
struct Asked {
    name: String,
    scopes: Vec<Scope>,
    /// Its end, UTC; 90 days from now without it.
    #[schema(format = DateTime)]
    expires: Option<String>,
}

/// A token.
#[derive(Serialize, ToSchema)]
#[schema(as = Token)]
struct TokenDocument {
    /// Name in addresses.
    id: String,
    name: String,
    scopes: Vec<Scope>,
    /// Its begin, UTC.
    #[schema(format = DateTime)]
    made: String,
    /// Its end, UTC.
    #[schema(format = DateTime)]
    expires: String,
    /// The token itself: in the answer to its maker alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    token: Option<String>,
}

/// A page of tokens.
#[derive(Serialize, ToSchema)]
struct Tokens {
    tokens: Vec<TokenDocument>,
    /// Value of `after` for the next page.
    next: Option<String>,
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

fn told(token: &Token) -> TokenDocument {
    TokenDocument {
        id: token.id.clone(),
        name: token.name.clone(),
        scopes: token.scopes.clone(),
        made: http::moment(token.made),
        expires: http::moment(token.expires),
        token: None,
    }
}

/// Makes a token of the user's account.
#[utoipa::path(post, path = "/api/v1/tokens", tag = TAG,
    request_body = Asked,
    responses((status = 201, body = TokenDocument, headers(("Location" = String)))))]
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
    let document = TokenDocument { token: Some(made.secret), ..told(&made.token) };
    let place = format!("/api/v1/tokens/{}", made.token.id);
    Ok((StatusCode::CREATED, [(LOCATION, place)], http::json(&document)).into_response())
}

/// Lists the tokens of the user's account.
#[utoipa::path(get, path = "/api/v1/tokens", tag = TAG,
    params(
        ("after" = Option<String>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Tokens)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let after = query.one("after")?.unwrap_or_default();
    let most = query.limit()?;
    query.end("after, limit")?;
    caller.login()?;
    let tokens = shared.store(&caller, move |store| Ok(store.tokens(&after, most)?)).await?;
    let next = tokens.last().filter(|_| tokens.len() == most as usize).map(|last| last.id.clone());
    Ok(http::json(&Tokens { tokens: tokens.iter().map(told).collect(), next }))
}

/// Takes a token of the user's account back.
#[utoipa::path(delete, path = "/api/v1/tokens/{id}", tag = TAG,
    params(("id" = String, Path)),
    responses((status = 204)))]
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
