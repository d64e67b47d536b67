//! Addresses that the service may send to, and the one way to them.
//!
//! ```text
//! --hook-target https://erp.example/hooks    https://erp.example/hooks/released     yes
//!                                            https://erp.example/hooksx, /hooks/../admin, http://erp.example/hooks    no
//! ```
//!
//! A target is an https or http address; its path is the beginning of others, by whole segments. So an admin who makes a hook cannot
//! have the server ask whatever it can reach. No redirect is followed, and no proxy of the environment is used.

use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use axum::http::Uri;
use axum::http::header::{CONTENT_TYPE, USER_AGENT};
use rustls::RootCertStore;
use rustls::crypto::ring;
use rustls::pki_types::CertificateDer;
use rustls::pki_types::pem::PemObject;
use ureq::tls::{Certificate, RootCerts, TlsConfig, TlsProvider};
use ureq::{Agent, Error};
use webpki_root_certs::TLS_SERVER_ROOT_CERTS;

use super::signing::signature;
use crate::{Hooks, Limits};

/// Bytes of an address at most.
pub(super) const LONGEST: usize = 2000;

/// Bytes of an answer that are read, so that a receiver can write it to its end.
const READ: u64 = 64 << 10;

/// Signs of a path that some servers read as `.`, `/`, `\` or `%`, so that the path is another one there.
const DISGUISED: [&str; 4] = ["%2e", "%2f", "%5c", "%25"];

/// An address, taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Address {
    uri: Uri,
    is_https: bool,
    /// In small letters.
    host: String,
    port: u16,
}

impl Address {
    /// The address that a text states.
    ///
    /// # Errors
    /// The reason why it is none of the form.
    fn of(text: &str) -> Result<Address, &'static str> {
        if text.len() > LONGEST || !text.bytes().all(|byte| byte.is_ascii_graphic()) || text.contains('\\') {
            return Err("it is an address of at most 2000 signs, without spaces");
        }
        if text.contains('#') {
            return Err("it has no fragment (`#`)");
        }
        let uri: Uri = text.parse().map_err(|_| "it is an address such as https://erp.example/hooks")?;
        let is_https = match uri.scheme_str() {
            Some(scheme) if scheme.eq_ignore_ascii_case("https") => true,
            Some(scheme) if scheme.eq_ignore_ascii_case("http") => false,
            _ => return Err("it begins with https:// or http://"),
        };
        let authority = uri.authority().ok_or("it names a host")?.as_str();
        if authority.contains('@') {
            return Err("it has neither user nor password");
        }
        let host = uri.host().unwrap_or_default().to_ascii_lowercase();
        let port = match authority.get(host.len()..) {
            Some("") => Some(if is_https { 443 } else { 80 }),
            Some(rest) => rest.strip_prefix(':').and_then(|port| port.parse().ok()).filter(|port| *port > 0),
            None => None,
        };
        let port = port.ok_or("its port is a number from 1 to 65535")?;
        if host.is_empty() {
            return Err("it names a host");
        }
        let path = uri.path().to_ascii_lowercase();
        // Some servers cut off what follows `;` in a segment.
        let is_dots = |part: &str| matches!(part.split(';').next(), Some("." | ".."));
        if path.split('/').any(is_dots) || DISGUISED.iter().any(|sign| path.contains(sign)) {
            return Err("its path has neither `.` nor `..`, and no %2e, %2f, %5c or %25");
        }
        Ok(Address { is_https, host, port, uri })
    }

    /// Whether another one is this one, or below it.
    fn has(&self, other: &Address) -> bool {
        let is_there = (self.is_https, &self.host, self.port) == (other.is_https, &other.host, other.port);
        let rest = other.uri.path().strip_prefix(self.uri.path().trim_end_matches('/'));
        is_there && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    }
}

/// An address that the service may send to.
pub(super) struct Allowed(Uri);

impl Allowed {
    /// The address without its query, which may hold a secret of the receiver.
    pub(super) fn shown(&self) -> String {
        let own = &self.0;
        format!(
            "{}://{}{}",
            own.scheme_str().unwrap_or_default(),
            own.authority().map_or("", |own| own.as_str()),
            own.path()
        )
    }
}

/// A message to be sent.
pub(super) struct Message<'m> {
    /// The name of the event.
    pub(super) id: &'m str,
    /// Seconds since 1970 (UTC) of this attempt.
    pub(super) timestamp: i64,
    /// The body.
    pub(super) body: &'m str,
    /// The secret of its receiver.
    pub(super) secret: &'m [u8],
}

/// The targets of this process, and the client that asks them.
pub(crate) struct Targets {
    all: Vec<Address>,
    agent: Agent,
    /// Pauses before each further attempt.
    pauses: [Duration; 7],
    /// Time limit of a message with its answer.
    limit: Duration,
}

impl Targets {
    /// Targets as they were stated, and a file with authorities beside those of the web.
    ///
    /// # Errors
    /// The reason: an address or the file is not of the form.
    pub(crate) fn of(stated: &Hooks, limits: &Limits) -> Result<Targets, String> {
        let target = |text: &String| {
            let address = Address::of(text).map_err(|why| format!("`{text}`: {why}"))?;
            match address.uri.query() {
                None => Ok(address),
                Some(_) => Err(format!("`{text}`: it has no query (`?`)")),
            }
        };
        let all = stated.targets.iter().map(target).collect::<Result<Vec<_>, String>>()?;
        let tls = TlsConfig::builder()
            .provider(TlsProvider::Rustls)
            .unversioned_rustls_crypto_provider(Arc::new(ring::default_provider()))
            .root_certs(RootCerts::from(authorities(stated.authorities.as_deref())?))
            .build();
        let config = Agent::config_builder()
            .tls_config(tls)
            .timeout_global(Some(limits.hook))
            .http_status_as_error(false)
            .max_redirects(0)
            // No other host is asked, whatever the environment says.
            .proxy(None)
            // A connection that is kept may be dead when the next message comes, hours later.
            .max_idle_connections(0)
            .build();
        let agent = Agent::new_with_config(config);
        Ok(Targets { all, agent, pauses: limits.hook_pauses, limit: limits.hook })
    }

    /// The address of a text, if the service may send to it.
    ///
    /// # Errors
    /// The reason why not.
    pub(super) fn allowed(&self, text: &str) -> Result<Allowed, &'static str> {
        let address = Address::of(text)?;
        match self.all.iter().any(|target| target.has(&address)) {
            true => Ok(Allowed(address.uri)),
            false => Err("it is below no --hook-target of this process"),
        }
    }

    /// The pause after an attempt, from 1; none after the last one.
    pub(super) fn pause_after(&self, attempt: i64) -> Option<Duration> {
        let at = usize::try_from(attempt).ok()?.checked_sub(1)?;
        self.pauses.get(at).copied()
    }

    /// Sends a message; gives the status of the answer. It blocks its thread.
    ///
    /// # Errors
    /// The reason why there is no answer, without the address.
    pub(super) fn send(&self, to: &Allowed, message: &Message) -> Result<u16, String> {
        let signed = signature(message.secret, message.id, message.timestamp, message.body);
        let request = ureq::http::Request::post(&to.0)
            .header(CONTENT_TYPE, "application/json")
            .header(USER_AGENT, concat!("ncc/", env!("CARGO_PKG_VERSION")))
            .header("webhook-id", message.id)
            .header("webhook-timestamp", message.timestamp.to_string())
            .header("webhook-signature", signed)
            .body(message.body.to_owned())
            .map_err(|_| "the message cannot be sent".to_owned())?;
        let mut answer = self.agent.run(request).map_err(|error| self.reason(&error))?;
        // The status says all; a body that breaks off changes nothing.
        let _ = io::copy(&mut answer.body_mut().as_reader().take(READ), &mut io::sink());
        Ok(answer.status().as_u16())
    }

    /// The reason why there is no answer.
    fn reason(&self, error: &Error) -> String {
        match error {
            Error::Timeout(_) => format!("no answer within {} s", self.limit.as_secs_f64()),
            Error::HostNotFound => "its host is not found".to_owned(),
            Error::ConnectionFailed => "no connection".to_owned(),
            Error::Io(error) if error.kind() == io::ErrorKind::TimedOut => {
                format!("no answer within {} s", self.limit.as_secs_f64())
            }
            Error::Io(error) if error.get_ref().is_some_and(|own| own.is::<rustls::Error>()) => {
                format!("TLS: {error}")
            }
            Error::Io(error) => error.to_string(),
            Error::Rustls(error) => format!("TLS: {error}"),
            Error::Tls(why) => format!("TLS: {why}"),
            _ => "its answer is no HTTP".to_owned(),
        }
    }
}

/// Certificates of the authorities of the web, and of those of a PEM file.
fn authorities(file: Option<&Path>) -> Result<Vec<Certificate<'static>>, String> {
    let own = file.map(read).transpose()?.unwrap_or_default();
    let all = TLS_SERVER_ROOT_CERTS.iter().chain(&own);
    Ok(all.map(|own| Certificate::from_der(own).to_owned()).collect())
}

/// The certificates of a PEM file. The client would leave out those that it cannot read.
fn read(file: &Path) -> Result<Vec<CertificateDer<'static>>, String> {
    let wrong = |why: &dyn std::fmt::Display| format!("{}: {why}", file.display());
    let all = CertificateDer::pem_file_iter(file).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let all = all.map_err(|error| wrong(&error))?;
    if all.is_empty() {
        return Err(wrong(&"it has no certificate"));
    }
    let mut roots = RootCertStore::empty();
    all.iter().try_for_each(|own| roots.add(own.clone())).map_err(|error| wrong(&error))?;
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn targets(all: &[&str]) -> Result<Targets, String> {
        let targets = all.iter().map(|own| (*own).to_owned()).collect();
        Targets::of(&Hooks { targets, authorities: None }, &Limits::default())
    }

    #[test]
    fn an_address_is_below_a_target_or_it_is_not_asked() {
        let all = targets(&[
            "https://erp.example/hooks",
            "http://10.0.0.5:8080/",
            "https://Two.example:444/a/b/",
            "http://[::1]:81/h",
        ])
        .expect("targets");
        for allowed in [
            "https://erp.example/hooks",
            "https://erp.example/hooks/",
            "https://erp.example/hooks/a/b?key=x%2F..",
            "https://erp.example:443/hooks",
            "HTTPS://ERP.Example/hooks/a",
            "https://erp.example/hooks/..a",
            "http://10.0.0.5:8080",
            "http://10.0.0.5:8080/any/thing",
            "https://two.example:444/a/b/c",
            "https://two.example:444/a/b",
            "http://[::1]:81/h/i",
        ] {
            assert!(all.allowed(allowed).is_ok(), "{allowed}: {:?}", all.allowed(allowed).err());
        }
        for refused in [
            "",
            "erp.example/hooks",
            "/hooks",
            "//erp.example/hooks",
            "http://erp.example/hooks",
            "ftp://erp.example/hooks",
            "https://erp.example",
            "https://erp.example/",
            "https://erp.example/hook",
            "https://erp.example/hooksx",
            "https://erp.example/Hooks",
            "https://erp.example/hooks/../admin",
            "https://erp.example/hooks/..;/admin",
            "https://erp.example/hooks/./a",
            "https://erp.example/hooks/%2e%2e/admin",
            "https://erp.example/hooks/.%2E/admin",
            "https://erp.example/hooks/a%2F..%2Fadmin",
            "https://erp.example/hooks/%5c..%5cadmin",
            "https://erp.example/hooks/%252e%252e/admin",
            "https://erp.example/hooks\\..\\admin",
            "https://erp.example/hooks#a",
            "https://erp.example/hooks a",
            "https://erp.example/hooks\r\nx: y",
            "https://erp.example:8443/hooks",
            "https://erp.example:80/hooks",
            "https://erp.example:/hooks",
            "https://erp.example:0/hooks",
            "https://erp.example:99999/hooks",
            "https://erp.example./hooks",
            "https://erp.example.evil.example/hooks",
            "https://evil.example/erp.example/hooks",
            "https://erp.example@evil.example/hooks",
            "https://user:pass@erp.example/hooks",
            "https://user@erp.example/hooks",
            "https://evil.example?https://erp.example/hooks",
            "http://10.0.0.5/",
            "http://10.0.0.5:80/",
            "http://10.0.0.50:8080/",
            "http://167772165:8080/",
            "http://127.0.0.1:8080/",
            "http://[::1]/h",
            "http://::1:81/h",
            "http://[::1]:81h/",
        ] {
            assert!(all.allowed(refused).is_err(), "{refused}");
        }
        assert!(all.allowed(&format!("https://erp.example/hooks/{}", "a".repeat(LONGEST))).is_err());
    }

    #[test]
    fn a_target_has_its_form() {
        for wrong in [
            "erp.example",
            "https://erp.example/a?b",
            "https://a@erp.example/",
            "https:///a",
            "https://:443/",
        ] {
            assert!(targets(&[wrong]).is_err(), "{wrong}");
        }
        assert!(targets(&[]).expect("none").allowed("https://erp.example/").is_err());
    }

    #[test]
    fn authorities_of_the_web_are_among_those_of_the_client() {
        let all = authorities(None).expect("certificates");
        let mut roots = RootCertStore::empty();
        let all = all.iter().map(|own| CertificateDer::from_slice(own.der()).into_owned());
        let (known, unknown) = roots.add_parsable_certificates(all);
        assert!(known > 100 && unknown == 0, "{known} {unknown}");
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("own.pem");
        for wrong in ["", "no certificate", "-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n"]
        {
            std::fs::write(&file, wrong).expect("a file");
            assert!(authorities(Some(&file)).is_err(), "{wrong}");
        }
    }

    #[test]
    fn what_is_shown_of_an_address_has_no_query() {
        let all = targets(&["https://erp.example/"]).expect("targets");
        let shown = all.allowed("https://erp.example/a?key=secret").map(|own| own.shown());
        assert_eq!(shown.as_deref(), Ok("https://erp.example/a"));
    }

    #[test]
    fn attempts_come_to_an_end() {
        let all = targets(&["https://erp.example/"]).expect("targets");
        let pauses: Vec<_> =
            (1..20).map_while(|attempt| all.pause_after(attempt)).map(|own| own.as_secs()).collect();
        assert_eq!(pauses, [10, 60, 300, 1800, 7200, 21_600, 86_400]);
    }
}
