//! Checks of Host and Origin, and headers of each answer for browsers.
//!
//! The service answers this computer alone, without a login. So a request must name this server as its host, and must not
//! come from another page: else a page of a stranger could have the browser ask.

use std::net::SocketAddr;
use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::header::{HOST, ORIGIN};
use axum::http::{HeaderMap, HeaderValue, Uri};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::Problem;

/// The names of this server.
#[derive(Clone)]
pub(crate) struct Gate(Arc<[String]>);

impl Gate {
    /// Of a server that listens here.
    pub(crate) fn new(here: SocketAddr) -> Gate {
        let port = here.port();
        let names = ["127.0.0.1", "localhost", "[::1]"].map(|name| format!("{name}:{port}"));
        // A browser leaves out the port of HTTP.
        let bare = names.iter().filter(|_| port == 80).filter_map(|name| name.strip_suffix(":80"));
        Gate(names.iter().map(String::as_str).chain(bare).map(str::to_owned).collect())
    }

    fn is_for_us(&self, uri: &Uri, headers: &HeaderMap) -> bool {
        let text = |value: &HeaderValue| value.to_str().unwrap_or_default().to_ascii_lowercase();
        let ours = |host: &str| self.0.iter().any(|own| own == host);
        // A request line with a host goes before the header (RFC 9112, 3.2.2); both have to be ours.
        let line = uri.authority().is_none_or(|host| ours(&host.as_str().to_ascii_lowercase()));
        let host = headers.get_all(HOST).iter().map(text).collect::<Vec<_>>();
        let origin = headers.get_all(ORIGIN).iter().map(text);
        line && matches!(host.as_slice(), [host] if ours(host))
            && origin.into_iter().all(|origin| origin.strip_prefix("http://").is_some_and(ours))
    }
}

/// Turns away what is not meant for this server.
pub(crate) async fn pass(State(gate): State<Gate>, request: Request, next: Next) -> Response {
    let mut answer = match gate.is_for_us(request.uri(), request.headers()) {
        true => next.run(request).await,
        false => Problem::stranger().into_response(),
    };
    let headers = answer.headers_mut();
    for (name, value) in [
        (
            "content-security-policy",
            "default-src 'none'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
        ),
        ("x-content-type-options", "nosniff"),
        ("referrer-policy", "no-referrer"),
        ("cross-origin-resource-policy", "same-origin"),
        // A copy is used only after the server has been asked.
        ("cache-control", "no-cache"),
    ] {
        // A page states the rights that it needs.
        headers.entry(name).or_insert(HeaderValue::from_static(value));
    }
    answer
}
