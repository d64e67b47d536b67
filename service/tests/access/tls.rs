//! Other computers: accounts, TLS, and the names of the server.

use std::fs;
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use ncc_service::{Limits, Listen, OpenError, Part, Role, Service, Users};
use rustls::pki_types::{CertificateDer, ServerName};
use rustls::{ClientConfig, ClientConnection, RootCertStore, StreamOwned};
use serde_json::json;
use tempfile::TempDir;

use super::{CHEAP, PASSWORD, admin, limits, user};
use crate::client::{Server, place};

/// A certificate of a name, and its files.
pub(crate) struct Pair {
    folder: TempDir,
    certificate: CertificateDer<'static>,
}

impl Pair {
    pub(crate) fn of(names: &[&str]) -> Pair {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let own = rcgen::generate_simple_self_signed(names).expect("a certificate");
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("cert.pem"), own.cert.pem()).expect("a file");
        fs::write(folder.path().join("key.pem"), own.signing_key.serialize_pem()).expect("a file");
        secret(&folder.path().join("key.pem"), 0o600);
        Pair { folder, certificate: own.cert.der().clone() }
    }

    pub(crate) fn files(&self) -> [PathBuf; 2] {
        ["cert.pem", "key.pem"].map(|name| self.folder.path().join(name))
    }
}

#[cfg(unix)]
fn secret(path: &Path, mode: u32) {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(path, fs::Permissions::from_mode(mode)).expect("its rights");
}

#[cfg(not(unix))]
fn secret(_: &Path, _: u32) {}

/// A server with TLS, and its folder.
fn server(pair: &Pair, hosts: &[&str], limits: Limits) -> (Server, TempDir) {
    let folder = tempfile::tempdir().expect("a folder");
    let database = place(&folder.path().join("ncc.sqlite"));
    if !hosts.is_empty() {
        let users = Users::with_cost(&database, "op", CHEAP).expect("the database");
        users.add("root", Role::Admin, "", PASSWORD).expect("an account");
    }
    let listen = Listen {
        hosts: hosts.iter().map(|name| (*name).to_owned()).collect(),
        tls: Some(pair.files()),
        ..SocketAddr::from(([127, 0, 0, 1], 0)).into()
    };
    (Server::at(listen, &Part::All { database }, limits), folder)
}

/// Asks over TLS; the whole answer.
fn ask(server: &Server, pair: &Pair, name: &str, request: &str) -> std::io::Result<String> {
    let mut roots = RootCertStore::empty();
    roots.add(pair.certificate.clone()).expect("a root");
    let provider = Arc::new(rustls::crypto::ring::default_provider());
    let config = ClientConfig::builder_with_provider(provider)
        .with_safe_default_protocol_versions()
        .expect("versions")
        .with_root_certificates(roots)
        .with_no_client_auth();
    let name = ServerName::try_from(name.to_owned()).expect("a name");
    let client = ClientConnection::new(Arc::new(config), name).expect("a client");
    let mut stream = StreamOwned::new(client, server.connect());
    stream.write_all(request.as_bytes())?;
    let mut answer = String::new();
    // The end of the connection may come without the end of TLS.
    match stream.read_to_string(&mut answer) {
        Err(error) if answer.is_empty() => Err(error),
        _ => Ok(answer),
    }
}

fn get(host: &str, target: &str) -> String {
    format!("GET {target} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n")
}

#[test]
fn a_server_with_tls_answers_those_who_know_it() {
    let pair = Pair::of(&["localhost", "ncc.example"]);
    let (server, _folder) = server(&pair, &["ncc.example"], limits());
    let port = server.address.port();
    let host = format!("ncc.example:{port}");
    let answer = ask(&server, &pair, "ncc.example", &get(&host, "/api/v1/session")).expect("an answer");
    assert!(answer.starts_with("HTTP/1.1 200") && answer.contains("\"login\": \"needed\""), "{answer}");
    assert!(answer.contains("strict-transport-security: max-age=31536000\r\n"), "{answer}");
    let login = json!({ "user": "root", "password": PASSWORD }).to_string();
    let asked = |more: &str| {
        format!(
            "POST /api/v1/session HTTP/1.1\r\nHost: {host}\r\n{more}Connection: close\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n{login}",
            login.len()
        )
    };
    let own = format!("Origin: https://{host}\r\n");
    let answer = ask(&server, &pair, "ncc.example", &asked(&own)).expect("an answer");
    assert!(
        answer.starts_with("HTTP/1.1 200") && answer.contains("Path=/; Max-Age=604800; Secure\r\n"),
        "{answer}"
    );
    let plain = format!("Origin: http://{host}\r\n");
    for wrong in [asked(&plain), get("evil.example", "/api/v1/session"), get("ncc.example", "/")] {
        let answer = ask(&server, &pair, "ncc.example", &wrong).expect("an answer");
        assert!(answer.starts_with("HTTP/1.1 403"), "{answer}");
    }
    // Whoever does not trust the certificate asks nothing.
    let other = Pair::of(&["ncc.example"]);
    assert!(ask(&server, &other, "ncc.example", &get(&host, "/api/v1/session")).is_err());
    assert!(ask(&server, &pair, "evil.example", &get(&host, "/api/v1/session")).is_err());
}

/// What is no TLS gets no answer of the service, and holds nobody up.
#[test]
fn what_is_no_tls_is_not_answered() {
    let pair = Pair::of(&["localhost"]);
    let limits = Limits { head: Duration::from_millis(300), ..limits() };
    let (server, _folder) = server(&pair, &[], limits);
    let host = server.address.to_string();
    let good = || {
        ask(&server, &pair, "localhost", &get(&host, "/api/v1/session"))
            .is_ok_and(|own| own.contains(" 200 "))
    };
    assert!(good());
    let hello = b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03";
    let garbage: Vec<u8> = (0..100_000_u32).map(|n| (n.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let http = get(&host, "/api/v1/session").into_bytes();
    let heartbleed = b"\x18\x03\x02\x00\x03\x01\x40\x00".to_vec();
    let sslv2 = b"\x80\x2e\x01\x00\x02\x00\x15\x00\x00\x00\x10".to_vec();
    for sent in
        [http, garbage, hello.to_vec(), heartbleed, sslv2, vec![0; 10], vec![0x16; 70_000], Vec::new()]
    {
        let mut stream = server.connect();
        let since = Instant::now();
        let _ = stream.write_all(&sent);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        assert!(!String::from_utf8_lossy(&answer).contains("HTTP/1.1 200"), "{sent:?}");
        assert!(answer.len() < 100, "an alert at most: {answer:?}");
        assert!(since.elapsed() < Duration::from_secs(10));
    }
    // Those who begin and go on slowly, many at once.
    let slow: Vec<TcpStream> = (0..200)
        .map(|number| {
            let mut stream = server.connect();
            let _ = stream.write_all(&hello[..number % hello.len()]);
            stream
        })
        .collect();
    assert!(good());
    for mut stream in slow {
        let since = Instant::now();
        let _ = stream.read_to_end(&mut Vec::new());
        assert!(since.elapsed() < Duration::from_secs(10));
    }
    assert!(good());
}

/// Reasons why a server that others may ask does not open.
#[test]
fn others_need_an_account_and_tls() {
    let folder = tempfile::tempdir().expect("a folder");
    let database = place(&folder.path().join("ncc.sqlite"));
    let part = Part::All { database: database.clone() };
    let pair = Pair::of(&["localhost"]);
    let listen = |address: &str, host: Option<&str>, tls: bool, behind_proxy: bool| Listen {
        address: format!("{address}:0").parse().expect("an address"),
        hosts: host.into_iter().map(str::to_owned).collect(),
        tls: tls.then(|| pair.files()),
        behind_proxy,
    };
    let open = |listen: Listen, part: &Part| Service::open(listen, part, "ana").err();
    for (address, host, tls, proxy) in [
        ("0.0.0.0", None, true, false),
        ("0.0.0.0", None, false, true),
        ("[::]", Some("ncc.example"), true, false),
        // By a proxy on this computer.
        ("127.0.0.1", Some("ncc.example"), false, false),
        ("127.0.0.1", None, false, true),
    ] {
        let refused = open(listen(address, host, tls, proxy), &part);
        assert!(matches!(refused, Some(OpenError::NoAccount)), "{address} {host:?}: {refused:?}");
    }
    let users = Users::with_cost(&database, "op", CHEAP).expect("the database");
    users.add("root", Role::Admin, "", PASSWORD).expect("an account");
    assert!(matches!(open(listen("0.0.0.0", None, false, false), &part), Some(OpenError::NoTls)));
    assert!(open(listen("0.0.0.0", None, true, false), &part).is_none());
    assert!(open(listen("0.0.0.0", None, false, true), &part).is_none());
    assert!(open(listen("127.0.0.1", Some("ncc.example"), false, false), &part).is_none());
    // A part without a database has no accounts.
    let alone = Part::Output { persistence: "http://127.0.0.1:1".to_owned() };
    assert!(matches!(open(listen("0.0.0.0", None, true, false), &alone), Some(OpenError::NoAccount)));
    // Files that are none.
    let tls = |certificate: &Path, key: &Path| {
        let listen =
            Listen { tls: Some([certificate.into(), key.into()]), ..listen("127.0.0.1", None, false, false) };
        match open(listen, &part) {
            Some(OpenError::Tls(reason)) => reason,
            other => panic!("{other:?}"),
        }
    };
    let [certificate, key] = pair.files();
    let other = Pair::of(&["localhost"]);
    assert!(tls(&certificate, &other.files()[1]).contains("key.pem"));
    assert!(tls(&key, &key).contains("no certificate"));
    tls(&certificate, &certificate);
    assert!(tls(Path::new("no/such/file"), &key).contains("no/such/file"));
    tls(&certificate, Path::new("no/such/file"));
    #[cfg(unix)]
    {
        secret(&key, 0o644);
        assert!(tls(&certificate, &key).contains("chmod"));
    }
}

/// Behind a proxy, names and pages are those that others see; its headers are not believed.
#[test]
fn a_proxy_does_not_speak_for_others() {
    let folder = tempfile::tempdir().expect("a folder");
    let database = place(&folder.path().join("ncc.sqlite"));
    let users = Users::with_cost(&database, "op", CHEAP).expect("the database");
    users.add("root", Role::Admin, "", PASSWORD).expect("an account");
    let listen = Listen {
        hosts: vec!["ncc.example".to_owned()],
        behind_proxy: true,
        ..SocketAddr::from(([127, 0, 0, 1], 0)).into()
    };
    let server = Server::at(listen, &Part::All { database }, limits());
    let raw = |head: &str| {
        server.raw(format!("GET /api/v1/programs HTTP/1.1\r\n{head}\r\n\r\n").as_bytes()).expect("an answer")
    };
    assert_eq!(raw("Host: ncc.example").status, 401);
    assert_eq!(raw("Host: ncc.example\r\nOrigin: https://ncc.example").status, 401);
    for head in [
        "Host: ncc.example\r\nOrigin: http://ncc.example",
        "Host: evil.example\r\nX-Forwarded-Host: ncc.example",
        "Host: evil.example\r\nForwarded: host=ncc.example",
        "Host: ncc.example.evil.example",
    ] {
        assert_eq!(raw(head).status, 403, "{head}");
    }
    let cookie = super::log_in(&server, "root", PASSWORD);
    assert!(cookie.header("set-cookie").ends_with("; Secure"), "{cookie:?}");
    for name in ["X-Forwarded-User: root", "X-Forwarded-For: 127.0.0.1", "X-Forwarded-Proto: https"] {
        assert_eq!(raw(&format!("Host: ncc.example\r\n{name}")).status, 401, "{name}");
    }
}

/// A server without a name for others says how to give it one.
#[test]
fn a_name_that_is_missing_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let database = place(&folder.path().join("ncc.sqlite"));
    let users = Users::with_cost(&database, "op", CHEAP).expect("the database");
    users.add("root", Role::Admin, "", PASSWORD).expect("an account");
    let listen = Listen { behind_proxy: true, ..SocketAddr::from(([0, 0, 0, 0], 0)).into() };
    let mut server = Server::at(listen, &Part::All { database }, limits());
    server.address.set_ip([127, 0, 0, 1].into());
    let answer =
        server.raw(b"GET /api/v1/programs HTTP/1.1\r\nHost: 192.0.2.7:8274\r\n\r\n").expect("an answer");
    assert_eq!(answer.status, 403);
    assert!(answer.text().contains("ncc serve --host NAME"), "{}", answer.text());
    assert_eq!(server.get("/api/v1/programs").status, 401);
    user(&server, "root");
    let alone = Server::all();
    admin(&alone);
    let answer =
        alone.raw(b"GET /api/v1/programs HTTP/1.1\r\nHost: 192.0.2.7:8274\r\n\r\n").expect("an answer");
    assert!(answer.status == 403 && !answer.text().contains("--host"), "{}", answer.text());
}
