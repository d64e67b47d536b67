//! Checks of Host and Origin, and headers of each answer for browsers.
//!
//! A request must name this server as its host, and must not come from another page: else a page of a stranger could have the
//! browser ask. A server that other computers may ask has the names that it was started with.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::header::{HOST, ORIGIN};
use axum::http::{HeaderMap, HeaderValue, Uri};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::Problem;
use crate::Listen;

/// The names of this server.
#[derive(Clone)]
pub(crate) struct Gate {
    /// Names with which a request may come, in small letters.
    hosts: Arc<[String]>,
    /// Origins of the pages that may ask.
    origins: Arc<[String]>,
    /// Whether it listens to this computer alone, and so needs no further name.
    is_here: bool,
    is_tls: bool,
}

impl Gate {
    /// Of a server that listens here; the port is the one that it has.
    pub(crate) fn new(listen: &Listen) -> Gate {
        let port = listen.address.port();
        let is_tls = listen.tls.is_some();
        // A browser leaves out the port of its protocol.
        let usual = if is_tls { 443 } else { 80 };
        let own = ["127.0.0.1", "localhost", "[::1]"].map(str::to_owned);
        let with_port = |name: &String| match has_port(name) {
            true => vec![name.clone()],
            false => {
                let bare = (port == usual || listen.behind_proxy).then(|| name.clone());
                [format!("{name}:{port}")].into_iter().chain(bare).collect()
            }
        };
        let named: Vec<String> = listen.hosts.iter().map(|name| name.to_ascii_lowercase()).collect();
        let mut hosts: Vec<String> = own.iter().flat_map(with_port).collect();
        let scheme = if is_tls { "https" } else { "http" };
        let mut origins: Vec<String> = hosts.iter().map(|host| format!("{scheme}://{host}")).collect();
        for host in named.iter().flat_map(with_port) {
            // A proxy ends TLS: its pages are those of https.
            let scheme = if is_tls || listen.behind_proxy { "https" } else { "http" };
            origins.push(format!("{scheme}://{host}"));
            hosts.push(host);
        }
        let is_here = listen.address.ip().is_loopback();
        Gate { hosts: hosts.into(), origins: origins.into(), is_here, is_tls }
    }

    fn is_for_us(&self, uri: &Uri, headers: &HeaderMap) -> bool {
        let text = |value: &HeaderValue| value.to_str().unwrap_or_default().to_ascii_lowercase();
        let ours = |host: &str| self.hosts.iter().any(|own| own == host);
        // A request line with a host goes before the header (RFC 9112, 3.2.2); both have to be ours.
        let line = uri.authority().is_none_or(|host| ours(&host.as_str().to_ascii_lowercase()));
        let host = headers.get_all(HOST).iter().map(text).collect::<Vec<_>>();
        let origin = headers.get_all(ORIGIN).iter().map(text);
        line && matches!(host.as_slice(), [host] if ours(host))
            && origin.into_iter().all(|origin| self.origins.contains(&origin))
    }

    /// Turns a request away.
    fn stranger(&self) -> Problem {
        match self.is_here {
            true => Problem::stranger(),
            false => {
                Problem::stranger().help("ncc serve --host NAME adds a name by which this server is asked")
            }
        }
    }
}

/// Whether a name has a port: `ncc.example:8443`, `[fd00::1]:8443`.
fn has_port(name: &str) -> bool {
    name.rsplit_once(':').is_some_and(|(before, port)| {
        !port.is_empty()
            && port.bytes().all(|byte| byte.is_ascii_digit())
            && (!before.contains(':') || before.ends_with(']'))
    })
}

/// Turns away what is not meant for this server.
pub(crate) async fn pass(State(gate): State<Gate>, request: Request, next: Next) -> Response {
    let mut answer = match gate.is_for_us(request.uri(), request.headers()) {
        true => next.run(request).await,
        false => gate.stranger().into_response(),
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
    if gate.is_tls {
        headers.insert("strict-transport-security", HeaderValue::from_static("max-age=31536000"));
    }
    answer
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gate(address: &str, hosts: &[&str], tls: bool, behind_proxy: bool) -> Gate {
        let tls = tls.then(|| ["c".into(), "k".into()]);
        let hosts = hosts.iter().map(|host| (*host).to_owned()).collect();
        Gate::new(&Listen { address: address.parse().expect("an address"), hosts, tls, behind_proxy })
    }

    fn lets_in(gate: &Gate, host: &str, origin: Option<&str>) -> bool {
        let value = |text: &str| HeaderValue::from_str(text).expect("a value");
        let mut headers = HeaderMap::from_iter([(HOST, value(host))]);
        headers.extend(origin.map(|origin| (ORIGIN, value(origin))));
        gate.is_for_us(&Uri::from_static("/"), &headers)
    }

    #[test]
    fn a_server_has_the_names_that_it_was_given() {
        let tls = gate("0.0.0.0:8274", &["NCC.example", "10.0.0.5", "other.example:99"], true, false);
        for host in
            ["ncc.example:8274", "NCC.EXAMPLE:8274", "10.0.0.5:8274", "other.example:99", "localhost:8274"]
        {
            assert!(lets_in(&tls, host, None), "{host}");
        }
        for host in
            ["ncc.example", "evil.example:8274", "other.example:8274", "0.0.0.0:8274", "ncc.example.:8274"]
        {
            assert!(!lets_in(&tls, host, None), "{host}");
        }
        assert!(lets_in(&tls, "ncc.example:8274", Some("https://ncc.example:8274")));
        for origin in ["http://ncc.example:8274", "https://ncc.example", "https://evil.example:8274", "null"]
        {
            assert!(!lets_in(&tls, "ncc.example:8274", Some(origin)), "{origin}");
        }
        assert!(lets_in(&gate("0.0.0.0:443", &["ncc.example"], true, false), "ncc.example", None));
        assert!(!lets_in(&gate("0.0.0.0:8274", &[], true, false), "10.0.0.5:8274", None));
    }

    #[test]
    fn pages_behind_a_proxy_are_of_https() {
        let proxied = gate("10.0.0.5:8274", &["ncc.example"], false, true);
        assert!(lets_in(&proxied, "ncc.example", Some("https://ncc.example")));
        assert!(!lets_in(&proxied, "ncc.example", Some("http://ncc.example")));
        let plain = gate("127.0.0.1:8274", &[], false, false);
        assert!(lets_in(&plain, "127.0.0.1:8274", Some("http://127.0.0.1:8274")));
        assert!(!lets_in(&plain, "127.0.0.1", None));
    }

    #[test]
    fn a_port_is_told_from_an_address() {
        assert!(has_port("a:1") && has_port("[::1]:80"));
        assert!(!has_port("a") && !has_port("[::1]") && !has_port("::1") && !has_port("a:"));
    }
}
