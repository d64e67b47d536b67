//! Access: the user of a request, and the acts that are allowed to this user.
//!
//! | addresses | what |
//! |---|---|
//! | `/api/v1/session` | login, logout, the own password |
//! | `/api/v1/tokens` | tokens of programs that ask for an account |
//! | `/api/v1/accounts`, `/api/v1/audit` | accounts and the audit, for admins |
//!
//! [`guard`] finds the user of each request before its handler sees it. The store asks once more, in the transaction of
//! the change itself, so that no handler can forget to. Not here: which acts a role has (`rights`).

mod accounts;
mod audit;
mod buckets;
mod caller;
mod checks;
mod command;
pub(crate) mod guard;
mod passwords;
mod secrets;
mod sessions;
mod tokens;

use std::sync::Arc;

use axum::extract::DefaultBodyLimit;
use axum::routing::{delete, get, put};
use utoipa_axum::router::OpenApiRouter;

use crate::Shared;

pub(crate) use self::caller::Caller;
pub use self::command::{Users, UsersError};

/// Bytes of a request at most: rights of an account are the longest.
const LARGEST: usize = 1 << 17;

/// Addresses of sessions, tokens, accounts and the audit.
pub(crate) fn routes() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new()
        .route("/api/v1/session", get(sessions::read).post(sessions::login).delete(sessions::logout))
        .route("/api/v1/session/password", put(sessions::password))
        .route("/api/v1/tokens", get(tokens::list).post(tokens::create))
        .route("/api/v1/tokens/{id}", delete(tokens::delete))
        .route("/api/v1/accounts", get(accounts::list).post(accounts::create))
        .route(
            "/api/v1/accounts/{name}",
            get(accounts::read).patch(accounts::change).delete(accounts::delete),
        )
        .route("/api/v1/audit", get(audit::read))
        .layer(DefaultBodyLimit::max(LARGEST))
}
