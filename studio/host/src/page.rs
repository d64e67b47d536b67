//! The files of the page, which are part of the binary.

use axum::http::header::CONTENT_TYPE;
use axum::http::{Method, StatusCode, Uri};
use axum::response::{IntoResponse, Response};

macro_rules! files {
    ($($name:literal $kind:literal)*) => {
        /// Name, media type, bytes.
        const FILES: &[(&str, &str, &[u8])] = &[$(($name, $kind, include_bytes!(concat!("../../dist/", $name)))),*];
    };
}

files! {
    "index.html" "text/html; charset=utf-8"
    "studio.css" "text/css; charset=utf-8"
    "studio.js" "text/javascript; charset=utf-8"
    "worker.js" "text/javascript; charset=utf-8"
    "icon.svg" "image/svg+xml"
    "manifest.webmanifest" "application/manifest+json"
}

/// What a static page says of its host, and what this one says.
const HOST: [&str; 2] = [r#"name="ncc-host" content="worker""#, r#"name="ncc-host" content="loopback""#];

/// A file of the page.
pub(crate) async fn file(method: Method, uri: Uri) -> Response {
    if method != Method::GET && method != Method::HEAD {
        return StatusCode::METHOD_NOT_ALLOWED.into_response();
    }
    let name = match uri.path() {
        "/" => "index.html",
        path => path.trim_start_matches('/'),
    };
    let Some((_, kind, bytes)) = FILES.iter().find(|(own, ..)| *own == name) else {
        return StatusCode::NOT_FOUND.into_response();
    };
    let head = [(CONTENT_TYPE, *kind)];
    match name {
        "index.html" => (head, String::from_utf8_lossy(bytes).replace(HOST[0], HOST[1])).into_response(),
        _ => (head, *bytes).into_response(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_says_which_host_it_has() {
        let (_, _, page) = FILES[0];
        assert_eq!(String::from_utf8_lossy(page).matches(HOST[0]).count(), 1);
    }
}
