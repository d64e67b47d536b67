//! The files of the page, which are part of the binary.

use std::borrow::Cow;

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

/// The server of the page, which the page names in its head.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Host {
    /// `ncc studio`: one user, programs of a folder.
    Loopback,
    /// `ncc serve`: programs of a database.
    Serve,
}

impl Host {
    const fn name(self) -> &'static str {
        match self {
            Host::Loopback => "loopback",
            Host::Serve => "serve",
        }
    }
}

/// A file of the page.
#[derive(Clone, Debug)]
pub struct File {
    /// Its address: `/` for the page itself.
    pub path: String,
    /// Its media type.
    pub media: &'static str,
    /// Its bytes.
    pub bytes: Cow<'static, [u8]>,
}

/// Words of a static page about its host.
const STATIC: &str = r#"name="ncc-host" content="worker""#;

/// All files of the page.
pub fn files(host: Host) -> Vec<File> {
    let file = |(name, media, bytes): &(&str, &'static str, &'static [u8])| match *name {
        "index.html" => {
            let own = format!(r#"name="ncc-host" content="{}""#, host.name());
            let text = String::from_utf8_lossy(bytes).replace(STATIC, &own);
            File { path: "/".to_owned(), media, bytes: Cow::Owned(text.into_bytes()) }
        }
        name => File { path: format!("/{name}"), media, bytes: Cow::Borrowed(*bytes) },
    };
    FILES.iter().map(file).collect()
}

/// A file of the page, by its address.
pub(crate) async fn file(method: Method, uri: Uri) -> Response {
    if method != Method::GET && method != Method::HEAD {
        return StatusCode::METHOD_NOT_ALLOWED.into_response();
    }
    match files(Host::Loopback).into_iter().find(|file| file.path == uri.path()) {
        Some(File { media, bytes, .. }) => ([(CONTENT_TYPE, media)], bytes.into_owned()).into_response(),
        None => StatusCode::NOT_FOUND.into_response(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_says_which_host_it_has() {
        let (_, _, page) = FILES[0];
        assert_eq!(String::from_utf8_lossy(page).matches(STATIC).count(), 1);
        for (host, name) in [(Host::Loopback, "loopback"), (Host::Serve, "serve")] {
            let all = files(host);
            assert_eq!(all.len(), FILES.len());
            let page = String::from_utf8_lossy(&all[0].bytes).into_owned();
            assert_eq!(page.matches(&format!(r#"name="ncc-host" content="{name}""#)).count(), 1);
            assert_eq!((all[0].path.as_str(), page.matches(STATIC).count()), ("/", 0));
        }
    }
}
