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

use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use serde::Serialize;

pub(crate) use self::problem::Problem;
pub(crate) use crate::moments::moment;

/// A document as JSON, for people too.
pub(crate) fn json(document: &impl Serialize) -> Response {
    let mut text = serde_json::to_vec_pretty(document).unwrap_or_default();
    text.push(b'\n');
    ([(CONTENT_TYPE, "application/json")], text).into_response()
}
