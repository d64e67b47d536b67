//! Tags of compressed answers. The compression itself is `tower_http`'s; requests are not compressed.

use axum::http::HeaderValue;
use axum::http::header::{CONTENT_ENCODING, ETAG};
use axum::response::Response;
use tower_http::CompressionLevel;
use tower_http::compression::CompressionLayer;
use tower_http::compression::predicate::{And, DefaultPredicate, Predicate, SizeAbove};

use super::conditions::COMPRESSED;

/// Bytes of an answer that is worth it: less fits into one packet.
const LEAST: u64 = 1024;

/// Compresses answers for clients that take that; no events, which would wait for each other.
pub(crate) fn layer() -> CompressionLayer<And<DefaultPredicate, SizeAbove>> {
    let worth = DefaultPredicate::new().and(SizeAbove::new(LEAST));
    CompressionLayer::new().quality(CompressionLevel::Fastest).compress_when(worth)
}

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
