//! Tags of compressed answers. The compression itself is `tower_http`'s; requests are not compressed.

use axum::http::HeaderValue;
use axum::http::header::{CONTENT_ENCODING, ETAG};
use axum::response::Response;

use super::conditions::COMPRESSED;

/// Gives a compressed answer a tag of its own: its bytes are others.
pub(crate) async fn tag(mut answer: Response) -> Response {
    let headers = answer.headers_mut();
    if headers.contains_key(CONTENT_ENCODING) {
        let tag = headers.get(ETAG).and_then(|tag| tag.to_str().ok());
        let own = tag.and_then(|tag| tag.strip_suffix('"')).map(|tag| format!("{tag}{COMPRESSED}"));
        if let Some(own) = own.and_then(|own| HeaderValue::from_str(&own).ok()) {
            headers.insert(ETAG, own);
        }
    }
    answer
}
