//! Folders of programs: each that has one, with the number of its programs.

use std::sync::Arc;

use axum::extract::{RawQuery, State};
use axum::response::Response;
use serde_json::{Value, json};

use crate::Shared;
use crate::access::Caller;
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;

/// Lists folders that the user may read, in their order. The top is the empty name.
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let all = shared.store(&caller, |store| Ok(store.folders()?)).await?;
    let all = all.into_iter().filter(|(folder, _)| caller.may(Act::Read, folder).is_ok());
    let folders: Vec<Value> =
        all.map(|(folder, programs)| json!({ "folder": folder, "programs": programs })).collect();
    Ok(http::json(&json!({ "folders": folders })))
}
