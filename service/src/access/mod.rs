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
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::Shared;

pub(crate) use self::caller::Caller;
pub use self::command::{Users, UsersError};

/// Bytes of a request at most: rights of an account are the longest.
const LARGEST: usize = 1 << 17;

/// Addresses of sessions, tokens, accounts and the audit.
pub(crate) fn routes() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new()
        .routes(routes!(sessions::read, sessions::login, sessions::logout))
        .routes(routes!(sessions::password))
        .routes(routes!(tokens::list, tokens::create))
        .routes(routes!(tokens::delete))
        .routes(routes!(accounts::list, accounts::create))
        .routes(routes!(accounts::read, accounts::change, accounts::delete))
        .routes(routes!(audit::read))
        .layer(DefaultBodyLimit::max(LARGEST))
}
