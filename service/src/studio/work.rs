//! Requests to the engine of a room. A program's calls find the files of its room alone.

use std::sync::Arc;
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State};
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde_json::{Map, Value};

use super::rooms::Room;
use crate::Shared;
use crate::access::Caller;
use crate::http::query::Query;
use crate::http::{Problem, body};
use crate::rights::Act;
use crate::shop::dialects;
use crate::translating::callable;

/// Cells along the longer side of a part at most: with both maps of the part, 32 MB.
const CELLS: u64 = 2048;

/// Makes a room with an engine; one that is there stays.
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

/// Puts a file into a room, in the place of another of its name.
pub(super) async fn keep(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((room, name)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    bytes: Result<Bytes, BytesRejection>,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    body::name(&name)?;
    body::media(&headers)?;
    let bytes = body::whole(bytes, shared.largest)?;
    let room = shared.rooms.of(caller.name(), &room)?;
    let mut inside = room.inside.lock().await;
    shared.rooms.reserve(&room, inside.others(&name) + bytes.len() as u64)?;
    inside.put(&name, bytes.to_vec());
    inside.called.remove(&name);
    Ok(StatusCode::NO_CONTENT)
}

/// Puts the programs in the folder of a program into a room, for its calls. Those that the room has already stay.
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
fn bounded(mut request: Map<String, Value>, moves: usize) -> Result<String, Problem> {
    if request.get("cells").and_then(Value::as_u64).is_some_and(|cells| cells > CELLS) {
        return Err(Problem::request(format!("a part has {CELLS} cells along its longer side at most"))
            .help("choose fewer cells in the set-up"));
    }
    if matches!(request.get("verb").and_then(Value::as_str), Some("path" | "simulate")) {
        request.insert("most_moves".to_owned(), moves.into());
        if let Some(other) = request.get_mut("compare").and_then(Value::as_object_mut) {
            other.insert("most_moves".to_owned(), moves.into());
        }
    }
    Ok(Value::from(request).to_string())
}

/// Does a request to the engine of a room, for as long as its connection is there. The answer is a line of JSON, `code` and `outputs`
/// with their names and lengths, then the outputs.
pub(super) async fn run(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(room): Path<String>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    request: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let room: Arc<Room> = shared.rooms.of(caller.name(), &room)?;
    let request = bounded(body::json(&headers, request)?, shared.rooms.moves())?;
    shared.guard.takes_work(&caller)?;
    shared.guard.takes_work(&caller)?;
    let dialects = shared.store(&caller, |store| Ok(dialects(store)?)).await?;
    let mut inside = Arc::clone(&room.inside).lock_owned().await;
    inside.engine.know(dialects);
    let counts = Arc::clone(&shared);
    let work = move || {
        let answer = ncc_studio::answer(&mut inside.engine, &request);
        counts.rooms.count(&room, &inside);
        // A stopped request has no outputs.
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

    /// The limits of a request that has 9 moves at most.
    fn limits(request: &str) -> Result<[Option<u64>; 2], Problem> {
        let bounded = bounded(serde_json::from_str(request).expect("an object"), 9)?;
        let bounded: Value = serde_json::from_str(&bounded).expect("JSON");
        Ok([bounded["most_moves"].as_u64(), bounded["compare"]["most_moves"].as_u64()])
    }

    #[test]
    fn a_part_has_its_cells_and_a_path_its_moves() {
        assert!(limits(r#"{ "verb": "simulate", "cells": 2048 }"#).is_ok());
        assert!(limits(r#"{ "verb": "simulate", "cells": 2049 }"#).is_err());
        for (request, own) in [
            (r#"{ "verb": "path", "most_moves": 9000000 }"#, [Some(9), None]),
            (r#"{ "verb": "simulate", "compare": { "file": "a" } }"#, [Some(9), Some(9)]),
            (r#"{ "verb": "check" }"#, [None, None]),
        ] {
            assert_eq!(limits(request).expect("a request"), own, "{request}");
        }
    }
}
