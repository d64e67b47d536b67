//! Web hooks: addresses that are told of releases, of translations that have become stale, and of jobs that have ended.
//!
//! | addresses | what |
//! |---|---|
//! | `/api/v1/hooks` | hooks, for admins |
//! | `/api/v1/hooks/ID/deliveries` | what each was told, and when it is told again |
//!
//! A message is signed as by Standard Webhooks ([`signing`]), and sent to an address below one that the process was started
//! with ([`targets`]) and to no other one. Messages are rows of the store, written with the change that they tell of, so none is lost ([`sending`]).

mod deliveries;
mod records;
pub(crate) mod sending;
mod signing;
mod targets;

use std::sync::Arc;

use axum::extract::DefaultBodyLimit;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::Shared;

pub(crate) use self::targets::Targets;

/// Bytes of a request at most.
const LARGEST: usize = 1 << 14;

/// Group of the addresses in the description.
const TAG: &str = "hooks";

/// Addresses of hooks.
pub(crate) fn routes() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new()
        .routes(routes!(records::list, records::create))
        .routes(routes!(records::read, records::delete))
        .routes(routes!(deliveries::list))
        .routes(routes!(deliveries::again))
        .layer(DefaultBodyLimit::max(LARGEST))
}
