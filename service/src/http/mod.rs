//! Shared parts of all addresses: conditions, queries, bodies, problems, checks of Host and Origin.

pub(crate) mod arrival;
pub(crate) mod body;
pub(crate) mod compression;
pub(crate) mod conditions;
pub(crate) mod connections;
pub(crate) mod gate;
pub(crate) mod openapi;
pub(crate) mod problem;
pub(crate) mod query;
pub(crate) mod tls;

use std::time::{Duration, UNIX_EPOCH};

use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use serde::Serialize;

pub(crate) use self::problem::Problem;

/// A moment, seconds since 1970 (UTC), as RFC 3339 has it.
pub(crate) fn moment(seconds: i64) -> String {
    let since = Duration::from_secs(u64::try_from(seconds).unwrap_or_default());
    humantime::format_rfc3339_seconds(UNIX_EPOCH + since).to_string()
}

/// A document as JSON, for people too.
pub(crate) fn json(document: &impl Serialize) -> Response {
    let mut text = serde_json::to_vec_pretty(document).unwrap_or_default();
    text.push(b'\n');
    ([(CONTENT_TYPE, "application/json")], text).into_response()
}
