//! Requests to the engine of a room. A program's calls find the files of its room alone.

use std::sync::Arc;
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State};
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use serde_json::Value;

use super::rooms::Room;
use crate::Shared;
use crate::access::Caller;
use crate::http::query::Query;
use crate::http::{Problem, body};
use crate::rights::Act;
use crate::translating::callable;

/// Bytes of a request at most.
const REQUEST: u64 = 1 << 20;

/// Cells along the longer side of a part at most: with both maps of the part, 32 MB.
const CELLS: u64 = 2048;

/// Makes a room.
pub(super) async fn open(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(room): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    // An account without rights has no use of the compiler.
    caller.may_somewhere(Act::Read)?;
    let is_first = shared.rooms.len() == 0;
    shared.rooms.open(caller.name(), &room)?;
    if is_first {
        tokio::spawn(sweep(Arc::clone(&shared)));
    }
    Ok(StatusCode::NO_CONTENT)
}

/// Lets go of rooms that are too old, until there are none.
async fn sweep(shared: Arc<Shared>) {
    while shared.rooms.len() > 0 {
        tokio::time::sleep(shared.rooms.age().max(Duration::from_secs(1)) / 2).await;
    }
}

/// Lets go of a room.
pub(super) async fn close(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(room): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    shared.rooms.close(caller.name(), &room);
    Ok(StatusCode::NO_CONTENT)
}

/// Keeps a file.
pub(super) async fn keep(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((room, name)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    bytes: Result<Bytes, BytesRejection>,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    body::name(&name)?;
    let bytes = body::whole(bytes, shared.largest)?;
    let room = shared.rooms.of(caller.name(), &room)?;
    let mut inside = room.inside.lock().await;
    shared.rooms.reserve(&room, inside.others(&name) + bytes.len() as u64)?;
    inside.put(&name, bytes.to_vec());
    inside.called.remove(&name);
    Ok(StatusCode::NO_CONTENT)
}

/// Puts the programs in the folder of a program beside it. Those that the room has already stay.
pub(super) async fn called(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((room, program)): Path<(String, String)>,
    RawQuery(query): RawQuery,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    let room = shared.rooms.of(caller.name(), &room)?;
    let mut inside = Arc::clone(&room.inside).lock_owned().await;
    let shared_too = Arc::clone(&shared);
    let put = move |store: &crate::store::Store| {
        let all = callable(store, &store.program(&program)?)?;
        let gone: Vec<String> = inside.called.keys().cloned().collect();
        for name in gone.iter().filter(|name| all.iter().all(|own| own.details.name != **name)) {
            inside.put(name, Vec::new());
            inside.called.remove(name);
        }
        for own in all {
            let (name, digest) = (own.details.name, own.content.sha256.clone());
            if inside.called.get(&name) == Some(&digest) {
                continue;
            }
            shared_too.rooms.reserve(&room, inside.others(&name) + own.content.bytes)?;
            inside.put(&name, store.whole(&own.content)?);
            inside.called.insert(name, digest);
        }
        Ok(())
    };
    shared.store(&caller, put).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// A request with the limits that a stranger could break.
fn bounded(request: &str, moves: usize) -> Result<String, Problem> {
    // The engine says what is wrong with one that is no JSON.
    let Ok(mut bounded) = serde_json::from_str::<Value>(request) else { return Ok(request.to_owned()) };
    if bounded["cells"].as_u64().is_some_and(|cells| cells > CELLS) {
        return Err(Problem::request(format!("a part has {CELLS} cells along its longer side at most"))
            .help("choose fewer cells in the set-up"));
    }
    if matches!(bounded["verb"].as_str(), Some("path" | "simulate")) {
        bounded["most_moves"] = moves.into();
        if let Some(other) = bounded.get_mut("compare").filter(|other| other.is_object()) {
            other["most_moves"] = moves.into();
        }
    }
    Ok(bounded.to_string())
}

/// Does a request within the limits of the compiler's work, for as long as its connection is there.
pub(super) async fn run(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(room): Path<String>,
    RawQuery(query): RawQuery,
    request: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let request = body::whole(request, REQUEST)?;
    if request.len() as u64 > REQUEST {
        return Err(Problem::too_large(REQUEST));
    }
    let request = String::from_utf8(request.to_vec())
        .map_err(|_| Problem::request("the request is no text in UTF-8"))?;
    let request = bounded(&request, shared.rooms.moves())?;
    let room: Arc<Room> = shared.rooms.of(caller.name(), &room)?;
    shared.guard.takes_work(&caller)?;
    let mut inside = Arc::clone(&room.inside).lock_owned().await;
    let counts = Arc::clone(&shared);
    let work = move || {
        let answer = ncc_studio::answer(&mut inside.engine, &request);
        counts.rooms.count(&room, &inside);
        // What was stopped says so, and no more.
        if ncc_exec::halt::is_asked() { Err(()) } else { Ok(answer) }
    };
    match shared.pool.run(work).await {
        Ok(Ok(answer)) => Ok(([(CONTENT_TYPE, "application/octet-stream")], answer).into_response()),
        Ok(Err(())) => Err(Problem::busy("the service ends")),
        Err(not) => Err(Problem::of_work(not, shared.pool.limit())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_has_its_cells() {
        assert!(bounded(r#"{ "verb": "simulate", "cells": 2048 }"#, 9).is_ok());
        assert!(bounded(r#"{ "verb": "simulate", "cells": 2049 }"#, 9).is_err());
        assert_eq!(bounded("{", 9).expect("the engine says what is wrong with it"), "{");
    }

    #[test]
    fn a_path_has_its_moves() {
        let most = |request: &str| {
            let bounded: Value =
                serde_json::from_str(&bounded(request, 9).expect("a request")).expect("JSON");
            [bounded["most_moves"].as_u64(), bounded["compare"]["most_moves"].as_u64()]
        };
        let own = Some(9);
        assert_eq!(most(r#"{ "verb": "path", "most_moves": 9000000 }"#), [own, None]);
        assert_eq!(most(r#"{ "verb": "simulate", "compare": { "file": "a" } }"#), [own, own]);
        assert_eq!(most(r#"{ "verb": "check" }"#), [None, None]);
    }
}
