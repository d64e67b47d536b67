//! OUTPUT: what is made of a stored document (Aguiar 2023, 3.4): the rows of its times (`csv`, without `type`), or the list
//! of canonical functions (`cmf`).
//!
//! Table 8 prints the address as `/output/NAME&type=cmf`, without `?`; that is read too.

use std::sync::Arc;

use axum::extract::{OriginalUri, RawQuery, State};
use axum::http::HeaderMap;
use axum::http::header::{CONTENT_TYPE, ETAG};
use axum::response::{IntoResponse, Response};
use ncc_driver::time::csv;
use percent_encoding::percent_decode_str;
use utoipa::ToSchema;

use super::document::{self, AFTER, CMF, CMF_REFUSED};
use super::shelf::Found;
use crate::Shared;
use crate::access::Caller;
use crate::http::Problem;
use crate::http::body;
use crate::http::conditions::{etag, is_known, not_modified};
use crate::http::query::Query;

/// A type of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ToSchema)]
#[schema(as = OutputType, rename_all = "lowercase")]
enum Type {
    Csv,
    Cmf,
}

/// The name and the query of an address: what follows a plain `&` is a query too. One in a name is written `%26`.
fn name_and_query(path: &str, query: Option<&str>) -> Result<(String, String), Problem> {
    let last = path.rsplit('/').next().unwrap_or_default();
    let (name, printed) = last.split_once('&').unwrap_or((last, ""));
    let name = percent_decode_str(name).decode_utf8();
    let name = name.map_err(|_| Problem::request("the name is no text in UTF-8"))?.into_owned();
    Ok((name, [printed, query.unwrap_or_default()].join("&")))
}

/// Gives an output of a stored document: its rows of times (CSV), or its list of canonical functions.
#[utoipa::path(get, path = "/output/{name}", tag = "case study",
    params(
        ("name" = String, Path, min_length = 1, max_length = 255, pattern = "^[^/\\x00-\\x1F\\x7F-\\x9F]+$"),
        ("type" = inline(Option<Type>), Query, description = "`csv` without it"),
        ("If-None-Match" = Option<String>, Header),
    ),
    responses(
        (status = 200, headers(("ETag" = String)),
            content((String = "text/csv; charset=utf-8; header=present"), (String = "text/plain; charset=utf-8"))),
        (status = 304),
    ))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    OriginalUri(address): OriginalUri,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let (name, query) = name_and_query(address.path(), query.as_deref())?;
    body::name(&name)?;
    let mut query = Query::of(Some(&query));
    let kind = query.among("type", &[("csv", Type::Csv), ("cmf", Type::Cmf)])?.unwrap_or(Type::Csv);
    query.end("type")?;
    let (wanted, word, media): (&'static [&'static str], _, _) = match kind {
        Type::Csv => (&[AFTER], "csv", "text/csv; charset=utf-8; header=present"),
        Type::Cmf => (&[CMF, CMF_REFUSED], "cmf", "text/plain; charset=utf-8"),
    };
    let found = shared
        .keep(&caller, {
            let name = name.clone();
            move |shelf| shelf.find(&name, wanted)
        })
        .await?;
    let tag = etag(&found.tag, word);
    if is_known(&headers, &tag) {
        return Ok(not_modified(tag));
    }
    let body = match kind {
        Type::Csv => shared.work(&caller, move |_| rows(&name, found)).await?,
        Type::Cmf => list(found)?,
    };
    Ok(([(CONTENT_TYPE, media.to_owned()), (ETAG, tag)], body).into_response())
}

/// The rows of a payload's times.
fn rows(name: &str, mut found: Found) -> Result<Vec<u8>, Problem> {
    let not_processed = || {
        Problem::not_made("the payload was stored before processing: it has no times", None)
            .help("store it after processing, or give the program to /transpiler")
    };
    let text = found.parts.remove(AFTER).ok_or_else(not_processed)?;
    let document = document::read(&text, name)?;
    let mut out = Vec::new();
    let written = csv::of_document(&document, &mut out).map_err(|_| Problem::fault())?;
    written.map_err(|not| Problem::not_made(not.problem(&document, name).message, None))?;
    Ok(out)
}

/// The list of canonical functions.
fn list(mut found: Found) -> Result<Vec<u8>, Problem> {
    if let Some(list) = found.parts.remove(CMF) {
        return Ok(list);
    }
    let refused = found.parts.remove(CMF_REFUSED);
    Err(match refused.and_then(|text| serde_json::from_slice(&text).ok()) {
        Some(refused) => {
            Problem::not_made("the program was not translated into canonical functions", Some(refused))
        }
        None => Problem::not_made("a list is made of a program, and this payload was stored by itself", None)
            .help("give the program to /transpiler"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_address_is_read() {
        let of = |path: &str, query| name_and_query(path, query).expect("an address");
        assert_eq!(of("/output/teste.cn", Some("type=cmf")), ("teste.cn".into(), "&type=cmf".into()));
        assert_eq!(of("/output/teste.cn&type=cmf", None), ("teste.cn".into(), "type=cmf&".into()));
        assert_eq!(of("/output/a%26type=b.cn", None), ("a&type=b.cn".into(), "&".into()));
    }
}
