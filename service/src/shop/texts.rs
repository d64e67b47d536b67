//! The work that machines and dialects have in common: a text is read, kept, deleted.

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::http::header::{CONTENT_TYPE, ETAG, LOCATION};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};

use super::fits::{fits, is_free};
use crate::Shared;
use crate::access::Caller;
use crate::http::Problem;
use crate::http::body::{self, encoded};
use crate::http::conditions::{etag, expected, is_known, not_modified};
use crate::http::query::Query;
use crate::rights::Act;
use crate::store::Sort;

/// The media type of a profile and of a dictionary.
pub(super) const TOML: &str = "application/toml";

/// The media type of a machine.json of the case study.
const JSON: &str = "application/json";

/// Bytes of a text at most.
const LARGEST: usize = 1 << 20;

/// A request about a text: its sort and its name, and what comes with every request.
pub(super) struct Asked {
    pub(super) sort: Sort,
    pub(super) name: String,
    pub(super) query: Option<String>,
    pub(super) headers: HeaderMap,
}

impl Asked {
    /// The address of the text.
    pub(super) fn place(&self) -> String {
        format!("/api/v1/{}s/{}", self.sort.name(), encoded(&self.name))
    }

    /// The address has no query.
    pub(super) fn has_no_query(&self) -> Result<(), Problem> {
        Query::of(self.query.as_deref()).end("")
    }

    /// The text, if it comes with ncc.
    fn shipped(&self) -> Option<&'static str> {
        match self.sort {
            Sort::Machine => ncc_machines::shipped_text(&self.name),
            Sort::Dialect => {
                let at = ncc_dialects::builtin_ids().position(|id| id == self.name)?;
                Some(ncc_dialects::builtin_text(at)?.1)
            }
        }
    }

    /// Media types that it is kept in, and those in words.
    fn media(&self) -> (&'static [&'static str], &'static str) {
        match self.sort {
            Sort::Machine => (&[TOML, JSON], "application/toml, or application/json for a machine.json"),
            Sort::Dialect => (&[TOML], TOML),
        }
    }
}

/// The answer with a text.
pub(super) fn told(text: String, tag: String) -> Response {
    let media = if text.trim_start().starts_with('{') { JSON } else { TOML };
    ([(CONTENT_TYPE, media.to_owned()), (ETAG, tag)], text).into_response()
}

/// Gives a text.
pub(super) async fn read(shared: &Shared, caller: &Caller, asked: Asked) -> Result<Response, Problem> {
    asked.has_no_query()?;
    if let Some(text) = asked.shipped() {
        return Ok(([(CONTENT_TYPE, TOML)], text).into_response());
    }
    let Asked { sort, name, headers, .. } = asked;
    let found = shared.store(caller, move |store| Ok(store.shop_text(sort, &name)?)).await?;
    let tag = etag(&found.tag, "");
    if is_known(&headers, &tag) {
        return Ok(not_modified(tag));
    }
    Ok(told(found.text, tag))
}

/// Keeps a text.
pub(super) async fn keep(
    shared: &Shared,
    caller: &Caller,
    asked: Asked,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    asked.has_no_query()?;
    caller.may(Act::Administer, "")?;
    let over = expected(&asked.headers)?;
    let (media, in_words) = asked.media();
    if !body::media(&asked.headers)?.is_some_and(|own| media.contains(&own.as_str())) {
        return Err(Problem::media(in_words));
    }
    let body = body::whole(body, LARGEST as u64)?;
    if body.len() > LARGEST {
        return Err(Problem::too_large(LARGEST as u64));
    }
    let text = String::from_utf8(body.to_vec()).map_err(|_| Problem::content("it is no text in UTF-8"))?;
    let place = asked.place();
    let Asked { sort, name, .. } = asked;
    let (tag, is_new) = shared
        .store(caller, move |store| {
            let touched = fits(store, sort, &name, &text)?;
            Ok(store.keep_shop_text(sort, &name, &text, &touched, &over)?)
        })
        .await?;
    let tag = etag(&tag, "");
    Ok(match is_new {
        true => (StatusCode::CREATED, [(LOCATION, place), (ETAG, tag)]).into_response(),
        false => (StatusCode::NO_CONTENT, [(ETAG, tag)]).into_response(),
    })
}

/// Lets go of a text.
pub(super) async fn delete(shared: &Shared, caller: &Caller, asked: Asked) -> Result<StatusCode, Problem> {
    asked.has_no_query()?;
    caller.may(Act::Administer, "")?;
    let over = expected(&asked.headers)?;
    let Asked { sort, name, .. } = asked;
    shared
        .store(caller, move |store| {
            match sort {
                Sort::Machine => {}
                Sort::Dialect => is_free(store, &name)?,
            }
            Ok(store.delete_shop_text(sort, &name, &over)?)
        })
        .await?;
    Ok(StatusCode::NO_CONTENT)
}
