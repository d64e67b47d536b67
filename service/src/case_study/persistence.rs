//! PERSISTENCE: payloads stored and restored (Aguiar 2023, 3.3).
//!
//! A payload in either form comes back as it was put in, byte for byte; `?form=printed`, `?form=ncc` write the other form.
//! A document of TRANSPILER has both stages: `?stage=before`.

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{RawQuery, State};
use axum::http::header::{CONTENT_TYPE, ETAG, LOCATION};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use ncc_driver::time::payload::{self, Fields};
use serde::Serialize;
use utoipa::ToSchema;

use super::document::{self, AFTER, BEFORE, CMF, CMF_REFUSED, WHOLE_MEDIA, Whole};
use super::shelf::{Found, Shelf, whole};
use crate::Shared;
use crate::access::Caller;
use crate::http::body::{self, Name, encoded};
use crate::http::conditions::{etag, expected, is_known, not_modified};
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;
use crate::store::{Listed, Parts};

/// Group of the addresses in the description.
const TAG: &str = "case study";

/// The form in which a payload is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ToSchema)]
#[schema(rename_all = "lowercase")]
pub(super) enum Form {
    /// As it was put in.
    Stored,
    /// The form of ncc.
    Ncc,
    /// The form of the case study.
    Printed,
    /// The document with all its parts, for another service.
    Whole,
}

/// A page of documents.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct Documents {
    documents: Vec<Listed>,
    /// Value of `after` for the next page.
    next: Option<String>,
}

/// Lists documents.
#[utoipa::path(get, path = "/persistence", tag = TAG,
    params(
        ("after" = Option<String>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Documents)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let after = query.one("after")?.unwrap_or_default();
    let most = query.limit()?;
    query.end("after, limit")?;
    let listed = shared.keep(&caller, move |shelf| shelf.list(&after, most)).await?;
    // A full page has a next one, which may be empty.
    let next = listed.last().filter(|_| listed.len() == most as usize).map(|last| last.name.clone());
    Ok(http::json(&Documents { documents: listed, next }))
}

/// The document of a body.
fn sent(headers: &HeaderMap, name: &str, body: &[u8]) -> Result<(Parts, [String; 2]), Problem> {
    match body::media(headers)?.as_deref() {
        Some("application/json") => document::of_payload(body, name),
        Some(WHOLE_MEDIA) => {
            let whole: Result<Whole, _> = serde_json::from_slice(body);
            whole.map_err(|error| Problem::content(error.to_string()))?.checked(name)
        }
        _ => Err(Problem::media("application/json")),
    }
}

/// Stores a payload under a name that is free.
#[utoipa::path(post, path = "/persistence/{name}", tag = TAG,
    params(("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$")),
    request_body(content((Value = "application/json"), (Whole = "application/vnd.ncc.document+json"))),
    responses((status = 201, headers(("Location" = String), ("ETag" = String)))))]
pub(super) async fn create(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Change, "")?;
    let body = body::whole(body, shared.largest)?;
    let place = format!("/persistence/{}", encoded(&name));
    let tag = shared
        .work(&caller, move |shelf| {
            let (parts, of) = sent(&headers, &name, &body)?;
            shelf.create(&name, &of, parts)
        })
        .await?;
    Ok((StatusCode::CREATED, [(LOCATION, place), (ETAG, etag(&tag, ""))]).into_response())
}

/// Stores a payload in the place of another one.
#[utoipa::path(put, path = "/persistence/{name}", tag = TAG,
    params(("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"), ("If-Match" = Option<String>, Header)),
    request_body(content((Value = "application/json"), (Whole = "application/vnd.ncc.document+json"))),
    responses((status = 204, headers(("ETag" = String)))))]
pub(super) async fn update(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Change, "")?;
    let over = expected(&headers)?;
    let body = body::whole(body, shared.largest)?;
    let tag = shared
        .work(&caller, move |shelf| {
            let (parts, of) = sent(&headers, &name, &body)?;
            shelf.replace(&name, &of, parts, &over)
        })
        .await?;
    Ok((StatusCode::NO_CONTENT, [(ETAG, etag(&tag, ""))]).into_response())
}

/// Deletes a document.
#[utoipa::path(delete, path = "/persistence/{name}", tag = TAG,
    params(("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"), ("If-Match" = Option<String>, Header)),
    responses((status = 204)))]
pub(super) async fn delete(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<StatusCode, Problem> {
    Query::of(query.as_deref()).end("")?;
    let over = expected(&headers)?;
    shared.keep(&caller, move |shelf| shelf.delete(&name, &over)).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// Gives a payload.
#[utoipa::path(get, path = "/persistence/{name}", tag = TAG,
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("form" = inline(Option<Form>), Query, description = "The stored form, or that of the case study, without it"),
        ("stage" = Option<String>, Query, pattern = "^(before|after)$", description = "Before or after processing"),
        ("If-None-Match" = Option<String>, Header),
    ),
    responses((status = 200, headers(("ETag" = String)), content((Value = "application/json"), (Whole = "application/vnd.ncc.document+json"))), (status = 304)))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Name(name): Name,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    read_in(&shared, &caller, name, query.as_deref(), &headers, Form::Stored).await
}

/// Gives a payload in a form, unless the address names another one.
pub(super) async fn read_in(
    shared: &Arc<Shared>,
    caller: &Caller,
    name: String,
    query: Option<&str>,
    headers: &HeaderMap,
    without: Form,
) -> Result<Response, Problem> {
    let mut query = Query::of(query);
    let forms =
        [("stored", Form::Stored), ("ncc", Form::Ncc), ("printed", Form::Printed), ("whole", Form::Whole)];
    let form = query.among("form", &forms)?.unwrap_or(without);
    let stage = query.among("stage", &[(BEFORE, BEFORE), (AFTER, AFTER)])?;
    query.end("stage, form")?;
    let wanted: &'static [&'static str] = match (form, stage) {
        (Form::Whole, _) => &[BEFORE, AFTER, CMF, CMF_REFUSED],
        (_, Some(BEFORE)) => &[BEFORE],
        (_, Some(_)) => &[AFTER],
        // A payload that was put in by itself has one stage.
        (_, None) => &[BEFORE, AFTER],
    };
    let found = shared
        .keep(caller, {
            let name = name.clone();
            move |shelf| shelf.find(&name, wanted)
        })
        .await?;
    let own = forms.iter().find(|(_, own)| *own == form).map_or("", |(word, _)| *word);
    let part = if found.parts.contains_key(AFTER) { AFTER } else { BEFORE };
    let tag = match form {
        Form::Stored | Form::Whole => etag(&found.tag, if form == Form::Whole { own } else { part }),
        Form::Ncc | Form::Printed => etag(&found.tag, &format!("{part}-{own}")),
    };
    if is_known(headers, &tag) {
        return Ok(not_modified(tag));
    }
    if form == Form::Whole {
        let body = whole(&[found.machine, found.dialect], found.parts)?;
        let body = serde_json::to_vec(&body).unwrap_or_default();
        return Ok(([(CONTENT_TYPE, WHOLE_MEDIA.to_owned()), (ETAG, tag)], body).into_response());
    }
    let body = match form {
        Form::Stored => payload_of(found)?.1,
        _ => shared.work(caller, move |shelf| rewritten(shelf, &name, found, form)).await?,
    };
    Ok(([(CONTENT_TYPE, "application/json".to_owned()), (ETAG, tag)], body).into_response())
}

/// The payload among the parts that were found, after processing if there is one; and the machine's short name.
fn payload_of(mut found: Found) -> Result<(String, Vec<u8>), Problem> {
    let payload = found.parts.remove(AFTER).or_else(|| found.parts.remove(BEFORE));
    let payload =
        payload.ok_or_else(|| Problem::absent("this payload has been stored in its other stage alone"))?;
    Ok((found.machine, payload))
}

/// The payload in another form than it was put in.
fn rewritten(shelf: &Shelf, name: &str, found: Found, form: Form) -> Result<Vec<u8>, Problem> {
    let dialect = match ncc_dialects::builtin(&found.dialect) {
        None => shelf.dialects()?.get(&found.dialect),
        built_in => built_in,
    };
    let (machine, text) = payload_of(found)?;
    let document = document::read(&text, name)?;
    let (fields, machine_name) = match form {
        Form::Printed => {
            let no_dialect =
                || Problem::not_made(format!("ncc does not know its dialect, {:?}", document.dialect), None);
            (Fields::Printed(dialect.ok_or_else(no_dialect)?), machine)
        }
        Form::Ncc | Form::Stored | Form::Whole => (Fields::Full, document.machine_name.clone()),
    };
    let mut out = Vec::new();
    payload::write(&document, &machine_name, fields, &mut out).map_err(|_| Problem::fault())?;
    Ok(out)
}
