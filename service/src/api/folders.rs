//! Folders of programs: each that has one, with the number of its programs.

use std::sync::Arc;

use axum::extract::{RawQuery, State};
use axum::response::Response;
use serde::Serialize;
use utoipa::ToSchema;

use crate::Shared;
use crate::access::Caller;
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;

/// A folder.
#[derive(Debug, Serialize, ToSchema)]
struct Folder {
    /// Its name, with `/` between names; empty at the top.
    folder: String,
    /// Number of its programs, without those of folders below.
    programs: i64,
}

/// Folders.
#[derive(Debug, Serialize, ToSchema)]
struct Folders {
    folders: Vec<Folder>,
}

/// Lists folders that the user may read, in their order. The top is the empty name.
#[utoipa::path(get, path = "/api/v1/folders", tag = "programs", responses((status = 200, body = Folders)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let all = shared.store(&caller, |store| Ok(store.folders()?)).await?;
    let all = all.into_iter().filter(|(folder, _)| caller.may(Act::Read, folder).is_ok());
    Ok(http::json(&Folders { folders: all.map(|(folder, programs)| Folder { folder, programs }).collect() }))
}
