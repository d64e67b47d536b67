//! Texts of programs, in pieces: neither the body of a request nor that of an answer is in memory as a whole.

use std::sync::Arc;

use axum::body::{Body, Bytes};
use axum::extract::{Path, RawQuery, State};
use axum::http::HeaderMap;
use axum::http::header::{CONTENT_DISPOSITION, CONTENT_LENGTH, CONTENT_TYPE, ETAG};
use axum::response::{IntoResponse, Response};
use futures_util::{StreamExt, stream};

use super::document::{Program, changed, number, said, tag};
use crate::Shared;
use crate::access::Caller;
use crate::http::Problem;
use crate::http::body::{self, encoded};
use crate::http::conditions::{expected, is_known, not_modified};
use crate::http::query::Query;
use crate::rights::Act;
use crate::store::{Content, Receiving, Revision};

/// Group of the addresses in the description.
const TAG: &str = "programs";

/// Receives a text.
///
/// # Errors
/// It is of another type, too large, or broke off: nothing of it is kept then.
pub(super) async fn receive(
    shared: &Arc<Shared>,
    caller: &Caller,
    headers: &HeaderMap,
    body: Body,
) -> Result<Receiving, Problem> {
    match body::media(headers)?.as_deref() {
        None | Some("application/octet-stream") => {}
        Some(media) if media.starts_with("text/") => {}
        Some(_) => return Err(Problem::media("text/plain")),
    }
    let mut text = Receiving::default();
    let mut pieces = body.into_data_stream();
    while let Some(piece) = pieces.next().await {
        let refused = match piece {
            Err(error) => Some(body::broken(&error)),
            Ok(piece) if text.bytes() + piece.len() as u64 > shared.largest => {
                Some(Problem::too_large(shared.largest))
            }
            Ok(piece) => {
                if text.take(&piece) {
                    text = put_aside(shared, caller, text).await?;
                }
                None
            }
        };
        if let Some(problem) = refused {
            let aside = text.aside();
            shared.store(caller, move |store| Ok(store.forget(aside)?)).await?;
            return Err(problem);
        }
    }
    Ok(text)
}

async fn put_aside(shared: &Arc<Shared>, caller: &Caller, mut text: Receiving) -> Result<Receiving, Problem> {
    let put = move |store: &crate::store::Store| {
        let before = text.aside();
        match store.put_aside(&mut text) {
            Ok(()) => Ok(text),
            Err(error) => {
                store.forget(before)?;
                Err(error.into())
            }
        }
    };
    shared.store(caller, put).await
}

/// Keeps another text of a program: a new revision, unless it is the same text.
#[utoipa::path(put, path = "/api/v1/programs/{id}/text", tag = TAG,
    params(
        ("id" = String, Path),
        ("message" = Option<String>, Query, max_length = 2000, description = "A message for the revision"),
        ("If-Match" = Option<String>, Header),
    ),
    request_body(content((String = "text/plain"), (Vec<u8> = "application/octet-stream")),
        description = "The text of the program, as it is on the machine"),
    responses((status = 200, body = Program, headers(("ETag" = String)))))]
pub(super) async fn change(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Body,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let said = said(&mut query, caller.name())?;
    query.end("message")?;
    let over = expected(&headers)?;
    let program = id.clone();
    // Before the body is received.
    shared.store(&caller, move |store| Ok(store.allows(Act::Change, &program)?)).await?;
    let text = receive(&shared, &caller, &headers, body).await?;
    let made = shared
        .store(&caller, move |store| {
            let aside = text.aside();
            store.change_text(&id, text, &said, &over).or_else(|error| {
                store.forget(aside)?;
                Err(error.into())
            })
        })
        .await?;
    Ok(changed(&made, None))
}

/// Gives the text of a program.
#[utoipa::path(get, path = "/api/v1/programs/{id}/text", tag = TAG,
    params(("id" = String, Path), ("If-None-Match" = Option<String>, Header)),
    responses((status = 200, body = String, content_type = "text/plain", headers(("ETag" = String))), (status = 304)))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let found = shared.store(&caller, move |store| Ok(store.program(&id)?)).await?;
    Ok(given(&shared, caller, found, &headers))
}

/// Gives the text of a program as it was.
#[utoipa::path(get, path = "/api/v1/programs/{id}/revisions/{number}/text", tag = TAG,
    params(("id" = String, Path), ("number" = i64, Path, minimum = 1), ("If-None-Match" = Option<String>, Header)),
    responses((status = 200, body = String, content_type = "text/plain", headers(("ETag" = String))), (status = 304)))]
pub(super) async fn read_revision(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((id, revision)): Path<(String, String)>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let revision = number(&revision)?;
    let found = shared.store(&caller, move |store| Ok(store.revision(&id, revision)?)).await?;
    Ok(given(&shared, caller, found, &headers))
}

fn given(shared: &Arc<Shared>, caller: Caller, of: Revision, headers: &HeaderMap) -> Response {
    let tag = tag(&of);
    if is_known(headers, &tag) {
        return not_modified(tag);
    }
    let file = format!("inline; filename*=UTF-8''{}", encoded(&of.details.name));
    let headers = [
        (CONTENT_TYPE, "text/plain".to_owned()),
        (CONTENT_LENGTH, of.content.bytes.to_string()),
        (CONTENT_DISPOSITION, file),
        (ETAG, tag),
    ];
    (headers, Body::from_stream(pieces(Arc::clone(shared), caller, of.content))).into_response()
}

/// The pieces of a content. A reader that cannot be given all of them gets less than the length that was stated.
fn pieces(
    shared: Arc<Shared>,
    caller: Caller,
    content: Content,
) -> impl stream::Stream<Item = Result<Bytes, axum::BoxError>> {
    stream::try_unfold((shared, caller, content, 0_u32), async |(shared, caller, content, number)| {
        let own = content.clone();
        let piece = shared.store(&caller, move |store| Ok(store.piece(&own, number)?)).await;
        let piece = piece.map_err(|_| axum::BoxError::from("the store"))?;
        Ok(piece.map(|piece| (Bytes::from(piece), (shared, caller, content, number + 1))))
    })
}
