//! Engines by rooms: a page has one for what the eye waits for, and two for work that takes its time.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use axum::body::Bytes;
use axum::extract::{Path, State};
use axum::http::StatusCode;
use ncc_engine::Engine;
use ncc_exec::halt::{self, Halt};

use crate::Shared;

/// Rooms at most: three for each of some tabs.
const MOST: usize = 48;

/// The engines.
#[derive(Default)]
pub(crate) struct Engines(Mutex<BTreeMap<String, Arc<Mutex<Engine>>>>);

impl Engines {
    /// The engine of a room; none where there are too many.
    fn of(&self, room: &str) -> Result<Arc<Mutex<Engine>>, StatusCode> {
        if !is_room(room) {
            return Err(StatusCode::NOT_FOUND);
        }
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if !all.contains_key(room) && all.len() >= MOST {
            return Err(StatusCode::TOO_MANY_REQUESTS);
        }
        Ok(Arc::clone(all.entry(room.to_owned()).or_default()))
    }
}

/// Whether a text is the name of a room: 1 to 64 letters of ASCII, digits and `-`.
pub fn is_room(name: &str) -> bool {
    (1..=64).contains(&name.len()) && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-')
}

/// Does something with an engine, on a thread of its own.
async fn with(
    shared: &Shared,
    room: &str,
    work: impl FnOnce(&mut Engine) -> Vec<u8> + Send + 'static,
) -> Result<Vec<u8>, StatusCode> {
    let engine = shared.engines.of(room)?;
    let done = tokio::task::spawn_blocking(move || {
        // After a panic it is as it was before that request.
        work(&mut engine.lock().unwrap_or_else(PoisonError::into_inner))
    });
    done.await.map_err(|_| StatusCode::INTERNAL_SERVER_ERROR)
}

/// Keeps a file.
pub(crate) async fn keep(
    State(shared): State<Arc<Shared>>,
    Path((room, name)): Path<(String, String)>,
    bytes: Bytes,
) -> Result<StatusCode, StatusCode> {
    with(&shared, &room, move |engine| {
        engine.put(&name, bytes.to_vec());
        Vec::new()
    })
    .await?;
    Ok(StatusCode::NO_CONTENT)
}

/// Asks the work of a request to stop when nobody waits for its answer: then the request is dropped with what it holds.
struct Waiting(Halt);

impl Drop for Waiting {
    fn drop(&mut self) {
        self.0.ask();
    }
}

/// Does a request, for as long as its connection is there.
pub(crate) async fn run(
    State(shared): State<Arc<Shared>>,
    Path(room): Path<String>,
    request: Bytes,
) -> Result<Vec<u8>, StatusCode> {
    let request = String::from_utf8(request.to_vec()).map_err(|_| StatusCode::BAD_REQUEST)?;
    let waiting = Waiting(Halt::default());
    let halt = waiting.0.clone();
    with(&shared, &room, move |engine| match halt.is_asked() {
        true => Vec::new(),
        false => halt::under(Some(halt), || answer(engine, &request)),
    })
    .await
}

/// Does a request. The answer is a line of JSON, then the outputs.
pub fn answer(engine: &mut Engine, request: &str) -> Vec<u8> {
    let code = engine.run(request);
    let list: Vec<_> = engine.outputs().map(|(name, bytes)| (name, bytes.len())).collect();
    let mut all = serde_json::json!({ "code": code, "outputs": list }).to_string().into_bytes();
    all.push(b'\n');
    engine.outputs().for_each(|(_, bytes)| all.extend_from_slice(bytes));
    all
}
