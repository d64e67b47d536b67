//! The document of a program, and the statements of its owner.

use axum::http::HeaderMap;
use axum::http::header::{ETAG, LOCATION};
use axum::http::{HeaderName, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

use crate::http::body;
use crate::http::conditions::{etag, is_known, not_modified};
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::store::{Change, Details, Revision, Said};

/// Bytes of a message and of an author's name at most.
const LONGEST: usize = 2000;

/// Tags of a program at most.
const TAGS: usize = 100;

/// Folders in each other at most.
const DEEPEST: usize = 32;

/// A program in a revision.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct Program {
    /// Name in addresses; it never changes.
    id: String,
    /// Folder, with `/` between names; empty at the top.
    folder: String,
    name: String,
    /// Dialect, where it is known.
    dialect: Option<String>,
    /// Machine, where it is known.
    machine: Option<String>,
    tags: Vec<String>,
    /// Number of the revision, from 1.
    revision: i64,
    /// The kind of change of this revision.
    change: Change,
    /// Digest of the text.
    sha256: String,
    /// Length of the text.
    bytes: u64,
    /// Author of this revision.
    author: String,
    /// The author's message; may be empty.
    message: String,
    /// Time of this revision, UTC.
    #[schema(format = DateTime)]
    made: String,
}

/// The document of a program.
pub(super) fn document(of: &Revision) -> Program {
    let stated = |name: &str| Some(name.to_owned()).filter(|name| !name.is_empty());
    let (details, said) = (of.details.clone(), of.said.clone());
    Program {
        id: of.program.clone(),
        dialect: stated(&details.dialect),
        machine: stated(&details.machine),
        folder: details.folder,
        name: details.name,
        tags: details.tags,
        revision: of.number,
        change: of.change,
        sha256: of.content.sha256.clone(),
        bytes: of.content.bytes,
        author: said.author,
        message: said.message,
        made: http::moment(of.made),
    }
}

/// The tag of a program in a revision.
pub(super) fn tag(of: &Revision) -> String {
    etag(&of.number.to_string(), "")
}

/// Tells of a program, unless its reader knows that already.
pub(super) fn told(of: &Revision, headers: &HeaderMap) -> Response {
    let tag = tag(of);
    if is_known(headers, &tag) {
        return not_modified(tag);
    }
    ([(ETAG, tag)], http::json(&document(of))).into_response()
}

/// Tells of a program that has been changed: with 201 where something is new.
pub(super) fn changed(of: &Revision, place: Option<String>) -> Response {
    let status = if place.is_some() { StatusCode::CREATED } else { StatusCode::OK };
    let place: Vec<(HeaderName, String)> = place.into_iter().map(|place| (LOCATION, place)).collect();
    let mut answer = (status, [(ETAG, tag(of))], http::json(&document(of))).into_response();
    for (name, value) in place {
        answer.headers_mut().extend(value.parse().ok().map(|value| (name, value)));
    }
    answer
}

/// The number of a revision in an address.
pub(crate) fn number(text: &str) -> Result<i64, Problem> {
    let number = text.parse().ok().filter(|number| *number > 0);
    number.ok_or_else(|| Problem::absent("revisions are counted from 1"))
}

/// A folder: names with `/` between them.
pub(crate) fn folder(folder: &str) -> Result<(), Problem> {
    if folder.is_empty() {
        return Ok(());
    }
    let parts: Vec<&str> = folder.split('/').collect();
    if parts.len() > DEEPEST || folder.len() > LONGEST {
        return Err(Problem::request(format!("a folder has {DEEPEST} folders above it at most")));
    }
    parts.into_iter().try_for_each(|part| body::name(part).map(|_| ()))
}

/// Tags, each once, in order.
pub(super) fn tags(tags: Vec<String>) -> Result<Vec<String>, Problem> {
    let mut tags = tags;
    for tag in &tags {
        body::name(tag)?;
    }
    tags.sort();
    tags.dedup();
    let many = || Problem::request(format!("a program has {TAGS} tags at most"));
    (tags.len() <= TAGS).then_some(tags).ok_or_else(many)
}

/// Details of a new program, from the address.
pub(super) fn details(query: &mut Query) -> Result<Details, Problem> {
    let needed = || Problem::request("a program has a name").help("?name=part.nc");
    let details = Details {
        folder: query.one("folder")?.unwrap_or_default(),
        name: query.one("name")?.ok_or_else(needed)?,
        dialect: query.one("dialect")?.unwrap_or_default(),
        machine: query.one("machine")?.unwrap_or_default(),
        tags: tags(query.all("tag"))?,
    };
    fits(&details)?;
    Ok(details)
}

/// Place and machine of a program are such as a program may have. Its dialect is one of its shop, `crate::shop`.
pub(crate) fn fits(details: &Details) -> Result<(), Problem> {
    body::name(&details.name)?;
    folder(&details.folder)?;
    machine(&details.machine)
}

/// A name that a machine may have, or an empty one. It may be put in later.
pub(super) fn machine(name: &str) -> Result<(), Problem> {
    if name.is_empty() { Ok(()) } else { body::name(name).map(|_| ()) }
}

/// Author and message of a change, from the address.
pub(super) fn said(query: &mut Query, author: &str) -> Result<Said, Problem> {
    let message = query.one("message")?.unwrap_or_default();
    message_fits(&message)?;
    Ok(Said { author: author.to_owned(), message })
}

/// A message is not too long.
pub(super) fn message_fits(message: &str) -> Result<(), Problem> {
    let long = || Problem::request(format!("a message has {LONGEST} bytes at most"));
    (message.len() <= LONGEST).then_some(()).ok_or_else(long)
}
