//! Entity tags and conditions (RFC 9110, 8.8.3 and 13).
//!
//! A tag is `"DIGEST"` of what is stored, or `"DIGEST-FORM"` of an output that is made of it. A writer may name any of
//! them: all say what the writer has read.

use axum::http::header::{ETAG, IF_MATCH, IF_NONE_MATCH};
use axum::http::{HeaderMap, HeaderName, StatusCode};
use axum::response::{IntoResponse, Response};

use super::Problem;
use crate::store::Condition;

/// End of the tag of a compressed answer: other bytes, so another tag (RFC 9110, 8.8.3.3).
pub(crate) const COMPRESSED: &str = "-gzip\"";

/// The tag of what is stored, or of an output of it.
pub(crate) fn etag(digest: &str, form: &str) -> String {
    if form.is_empty() { format!("\"{digest}\"") } else { format!("\"{digest}-{form}\"") }
}

/// The tags of a header, without their signs; `None` where the header is not there.
fn tags(headers: &HeaderMap, name: &HeaderName) -> Option<Vec<String>> {
    let mut found = None;
    for value in headers.get_all(name) {
        let all: &mut Vec<String> = found.get_or_insert_default();
        let text = value.to_str().unwrap_or_default();
        all.extend(text.split(',').map(|tag| tag.trim().to_owned()).filter(|tag| !tag.is_empty()));
    }
    found
}

/// The condition of a writer (`If-Match`).
///
/// # Errors
/// `If-None-Match` with tags, which says nothing to a writer.
pub(crate) fn expected(headers: &HeaderMap) -> Result<Condition, Problem> {
    if headers.contains_key(IF_NONE_MATCH) {
        return Err(Problem::request("If-None-Match is for readers").help("a writer sends If-Match"));
    }
    let Some(tags) = tags(headers, &IF_MATCH) else { return Ok(Condition::Any) };
    if tags.iter().any(|tag| tag == "*") {
        return Ok(Condition::Any);
    }
    // A weak tag never matches (RFC 9110, 13.1.1).
    let digest = |tag: &String| {
        let own = tag.strip_prefix('"')?.strip_suffix('"')?;
        Some(own.split_once('-').map_or(own, |(digest, _)| digest).to_owned())
    };
    Ok(Condition::OneOf(tags.iter().filter_map(digest).collect()))
}

/// Whether a reader has this already (`If-None-Match`).
pub(crate) fn is_known(headers: &HeaderMap, etag: &str) -> bool {
    let tags = tags(headers, &IF_NONE_MATCH).unwrap_or_default();
    let bare = |tag: &str| tag.strip_prefix("W/").unwrap_or(tag).replace(COMPRESSED, "\"");
    tags.iter().any(|tag| tag == "*" || bare(tag) == etag)
}

/// The answer to a reader who has this already.
pub(crate) fn not_modified(etag: String) -> Response {
    (StatusCode::NOT_MODIFIED, [(ETAG, etag)]).into_response()
}

#[cfg(test)]
mod tests {
    use axum::http::HeaderValue;

    use super::*;

    fn with(name: HeaderName, value: &'static str) -> HeaderMap {
        HeaderMap::from_iter([(name, HeaderValue::from_static(value))])
    }

    #[test]
    fn a_writer_names_what_was_read() {
        let of = |value| expected(&with(IF_MATCH, value)).expect("a condition");
        assert_eq!(of(r#""ab", "cd-csv""#), Condition::OneOf(vec!["ab".to_owned(), "cd".to_owned()]));
        assert_eq!(of(r#"W/"ab""#), Condition::OneOf(Vec::new()));
        assert_eq!(of("*"), Condition::Any);
        assert_eq!(expected(&HeaderMap::new()).expect("none"), Condition::Any);
        assert!(expected(&with(IF_NONE_MATCH, "*")).is_err());
    }

    #[test]
    fn a_reader_names_what_is_there() {
        let known = |value| is_known(&with(IF_NONE_MATCH, value), &etag("ab", "csv"));
        assert!(known(r#""xy", W/"ab-csv""#) && known("*"));
        assert!(!known(r#""ab""#) && !is_known(&HeaderMap::new(), &etag("ab", "")));
    }
}
