//! The files of the page. They need no login: they hold nothing of the store.

use std::sync::Arc;

use axum::Router;
use axum::http::HeaderMap;
use axum::http::header::{CONTENT_SECURITY_POLICY, CONTENT_TYPE, ETAG};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use ncc_studio::page::{File, Host, files};

use crate::Shared;
use crate::http::conditions::{etag, is_known, not_modified};
use crate::store::digest;

/// Sources of the page: this server alone, and pictures that the page makes. Nothing frames the page, and no form is sent.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
                      connect-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Routes of the page's files.
pub(crate) fn open() -> impl Iterator<Item = String> {
    files(Host::Serve).into_iter().map(|file| file.path)
}

/// Addresses of the page's files.
pub(super) fn routes() -> Router<Arc<Shared>> {
    files(Host::Serve).into_iter().fold(Router::new(), |routes, file| {
        let path = file.path.clone();
        let tag = etag(&digest(&[&file.bytes]), "");
        let file = Arc::new((file, tag));
        routes.route(&path, get(move |headers: HeaderMap| async move { answer(&file, &headers) }))
    })
}

fn answer((file, tag): &(File, String), headers: &HeaderMap) -> Response {
    let mut answer = match is_known(headers, tag) {
        true => not_modified(tag.clone()),
        false => {
            let head = [(CONTENT_TYPE, file.media.to_owned()), (ETAG, tag.clone())];
            (head, file.bytes.clone()).into_response()
        }
    };
    for (name, value) in
        [(CONTENT_SECURITY_POLICY.as_str(), POLICY), ("cross-origin-opener-policy", "same-origin")]
    {
        answer.headers_mut().insert(name, axum::http::HeaderValue::from_static(value));
    }
    answer
}
