//! The guard before all addresses: it finds the user of a request, and turns everybody else away.
//!
//! | request | user |
//! |---|---|
//! | no account is there | the one user of this computer, with all rights |
//! | `Authorization: Bearer ncc_…` | the account of the token, within its scopes |
//! | the cookie of a session | its account; what changes something needs the header `X-NCC-CSRF` too |
//! | another one | nobody: 401, but for the addresses that are open |
//!
//! Rights are read with each request, so that another process, or the command line, can take them away at once.

use std::collections::HashSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use axum::extract::{MatchedPath, Request, State};
use axum::http::Method;
use axum::http::request::Parts;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::buckets::{Buckets, Holder};
use super::caller::Caller;
use super::passwords::Passwords;
use super::secrets;
use crate::http::Problem;
use crate::http::connections::Peer;
use crate::observe::RequestName;
use crate::rights::{Via, Who};
use crate::{Limits, Shared};

/// Time for which it is believed that there is no account. An account of this process is known at once.
const BELIEVED: Duration = Duration::from_millis(250);

/// State of the guard.
pub(crate) struct Guard {
    /// Passwords of logins.
    pub(super) passwords: Passwords,
    /// Attempts to log in.
    pub(super) attempts: Buckets,
    /// Seconds after which an unused session ends.
    pub(super) idle: i64,
    /// Whether browsers send cookies over TLS alone.
    pub(super) is_secure: bool,
    requests: Buckets,
    work: Buckets,
    /// Routes of pages, which hold nothing of a user.
    open: HashSet<String>,
    /// Whether there are accounts. There are some for ever then: none is ever taken out.
    is_needed: AtomicBool,
    begun: Instant,
    /// When it was found that there are none, ms since `begun`, and 1 more.
    looked: AtomicU64,
}

impl Guard {
    /// `open` are the routes that need no login to be read.
    pub(crate) fn new(limits: &Limits, is_secure: bool, open: HashSet<String>) -> Guard {
        Guard {
            passwords: Passwords::new(limits.password),
            attempts: Buckets::new(limits.attempts),
            idle: i64::try_from(limits.session.as_secs()).unwrap_or(i64::MAX),
            is_secure,
            requests: Buckets::new(limits.requests),
            work: Buckets::new(limits.work_of_one),
            open,
            is_needed: AtomicBool::new(false),
            begun: Instant::now(),
            looked: AtomicU64::new(0),
        }
    }

    /// A user asks for work of the compiler.
    ///
    /// # Errors
    /// The account has asked for too much of it.
    pub(crate) fn takes_work(&self, caller: &Caller) -> Result<(), Problem> {
        match caller.who().via {
            Via::Login(_) | Via::Token(..) => {
                self.work.take(&Holder::Account(caller.name().to_owned())).map_err(Problem::too_many)
            }
            _ => Ok(()),
        }
    }
}

/// Whether a login is needed: as soon as there is an account.
pub(crate) async fn is_needed(shared: &Arc<Shared>) -> Result<bool, Problem> {
    let guard = &shared.guard;
    if guard.is_needed.load(Ordering::Acquire) {
        return Ok(true);
    }
    // A part without a store has no accounts.
    let Some(store) = &shared.own else { return Ok(false) };
    let time = u64::try_from(guard.begun.elapsed().as_millis()).unwrap_or(u64::MAX);
    let looked = guard.looked.load(Ordering::Acquire);
    if looked > 0 && time < looked - 1 + BELIEVED.as_millis() as u64 {
        return Ok(false);
    }
    let store = store.clone();
    let found = tokio::task::spawn_blocking(move || store.has_accounts()).await;
    let found = found.map_err(|_| Problem::fault())??;
    match found {
        true => guard.is_needed.store(true, Ordering::Release),
        false => guard.looked.store(time + 1, Ordering::Release),
    }
    Ok(found)
}

/// This process has made an account.
pub(super) fn now_needed(shared: &Arc<Shared>) {
    shared.guard.is_needed.store(true, Ordering::Release);
}

/// The rights of the author of a job now.
pub(crate) async fn author(shared: &Arc<Shared>, name: &str) -> Result<Caller, Problem> {
    if !is_needed(shared).await? {
        return Ok(Caller::of(Who { via: Via::Job, ..Who::local(name) }));
    }
    let of = name.to_owned();
    let rights = shared.store(&Caller::of(Who::service()), move |store| Ok(store.rights(&of)?)).await?;
    Ok(Caller::of(Who::account(name, rights, Via::Job)))
}

/// Whether an address is open to everybody.
fn is_open(shared: &Arc<Shared>, request: &Parts) -> bool {
    let reads = matches!(request.method, Method::GET | Method::HEAD);
    let route = request.extensions.get::<MatchedPath>().map_or("", MatchedPath::as_str);
    match route {
        "/api/v1/session" => reads || request.method == Method::POST,
        _ => reads && shared.guard.open.contains(route),
    }
}

/// The user of a request, if there is one.
async fn find(shared: &Arc<Shared>, request: &Parts, peer: Option<Peer>) -> Result<Option<Caller>, Problem> {
    let headers = &request.headers;
    let request = request.extensions.get::<RequestName>().map_or("", RequestName::text).to_owned();
    let address = peer.map(|peer| peer.0.ip());
    if !is_needed(shared).await? {
        let who = Who { address, request, ..Who::local(&shared.author) };
        let bearer = headers.get(axum::http::header::AUTHORIZATION).cloned();
        return Ok(Some(Caller::of(who).with_bearer(bearer)));
    }
    let idle = shared.guard.idle;
    let ncc = Caller::of(Who::service());
    let found = match secrets::token(headers) {
        Some(Some(token)) => {
            let digest = secrets::kept(&token);
            shared.store(&ncc, move |store| Ok(store.of_token(&digest)?)).await?
        }
        Some(None) => None,
        None => match secrets::session(headers) {
            Some(secret) => {
                let digest = secrets::kept(&secret);
                shared.store(&ncc, move |store| Ok(store.of_login(&digest, idle)?)).await?
            }
            None => None,
        },
    };
    Ok(found.map(|who| Caller::of(Who { address, request, ..who })))
}

/// A request counts for its account, or else for its address; the user of this computer has no limit.
fn counts(shared: &Arc<Shared>, caller: Option<&Caller>, peer: Option<Peer>) -> Result<(), Problem> {
    let holder = match (caller, peer) {
        (Some(caller), _) if caller.who().is_account() => Holder::Account(caller.name().to_owned()),
        (None, Some(peer)) => Holder::at(peer.0.ip()),
        _ => return Ok(()),
    };
    shared.guard.requests.take(&holder).map_err(Problem::too_many)
}

/// Lets the users in, and each visitor to what is open.
async fn let_in(shared: &Arc<Shared>, request: &Parts) -> Result<Option<Caller>, Problem> {
    let (headers, method) = (&request.headers, &request.method);
    let peer = request.extensions.get::<Peer>().copied();
    let caller = find(shared, request, peer).await?;
    counts(shared, caller.as_ref(), peer)?;
    if is_open(shared, request) {
        return Ok(caller);
    }
    let Some(caller) = caller else { return Err(Problem::login_needed()) };
    let is_safe = matches!(*method, Method::GET | Method::HEAD | Method::OPTIONS);
    if matches!(caller.who().via, Via::Login(_)) && !is_safe {
        let secret = secrets::session(headers).unwrap_or_default();
        if !secrets::is_meant(headers, &secret) {
            return Err(Problem::forged());
        }
    }
    Ok(Some(caller))
}

/// Lets the users in, and turns everybody else away.
pub(crate) async fn pass(State(shared): State<Arc<Shared>>, request: Request, next: Next) -> Response {
    let (mut parts, body) = request.into_parts();
    match let_in(&shared, &parts).await {
        Ok(caller) => {
            // A request brings none of its own.
            parts.extensions.remove::<Caller>();
            if let Some(caller) = caller {
                parts.extensions.insert(caller);
            }
            next.run(Request::from_parts(parts, body)).await
        }
        Err(problem) => problem.into_response(),
    }
}
