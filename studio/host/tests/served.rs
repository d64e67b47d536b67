//! The server as a browser and as a stranger meet it, over a socket.

use std::fs;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use ncc_studio::Studio;

/// A server that goes with the test.
struct Server {
    port: u16,
    token: String,
}

impl Server {
    fn of(programs: &Path) -> Server {
        let studio = Studio::open(0, programs).expect("a port");
        let address = studio.address();
        let (host, token) = address
            .strip_prefix("http://127.0.0.1:")
            .and_then(|rest| rest.split_once("/#token="))
            .expect("an address");
        let server = Server { port: host.parse().expect("a port"), token: token.to_owned() };
        thread::spawn(move || studio.serve());
        server
    }

    /// Sends a request as it is; gives the status, the head and the body.
    fn send(&self, request: &[u8]) -> (u16, String, Vec<u8>) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("a connection");
        stream.write_all(request).expect("sent");
        let mut all = Vec::new();
        stream.read_to_end(&mut all).expect("an answer");
        let end = all.windows(4).position(|four| four == b"\r\n\r\n").expect("a head");
        let head = String::from_utf8_lossy(&all[..end]).to_lowercase();
        let status = head.split(' ').nth(1).and_then(|code| code.parse().ok()).expect("a status");
        (status, head, all[end + 4..].to_vec())
    }

    /// A request with the token, for this host.
    fn ask(&self, method: &str, path: &str, headers: &str, body: &[u8]) -> (u16, String, Vec<u8>) {
        let head = format!(
            "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAuthorization: Bearer {}\r\nConnection: close\r\nContent-Length: {}\r\n{headers}\r\n",
            self.port,
            self.token,
            body.len()
        );
        self.send(&[head.as_bytes(), body].concat())
    }
}

const PART: &str =
    "%\nO1\nG21 G17 G90 G94 G54\nT1 M6\nS3000 M3\nG0 X10. Y10. Z5.\nG1 Z-2. F200.\nG0 Z5.\nM30\n%\n";

#[test]
fn the_page_and_its_engine() {
    let folder = tempfile::tempdir().expect("a folder");
    let server = Server::of(folder.path());
    let (status, head, page) = server.ask("GET", "/", "", b"");
    assert_eq!(status, 200);
    assert!(head.contains("default-src 'self'") && head.contains("frame-ancestors 'none'"), "{head}");
    assert!(String::from_utf8_lossy(&page).contains(r#"name="ncc-host" content="loopback""#));
    for (name, kind) in
        [("studio.js", "text/javascript"), ("studio.css", "text/css"), ("icon.svg", "image/svg+xml")]
    {
        let (status, head, body) = server.ask("GET", &format!("/{name}"), "", b"");
        assert!(status == 200 && head.contains(kind) && !body.is_empty(), "{name}: {head}");
    }
    assert_eq!(server.ask("PUT", "/engine/heavy/files/part.nc", "", PART.as_bytes()).0, 204);
    let request = br#"{ "verb": "simulate", "file": "part.nc", "from": "fanuc", "cells": 64 }"#;
    let (status, _, answer) = server.ask("POST", "/engine/heavy/run", "", request);
    assert_eq!(status, 200);
    let end = answer.iter().position(|byte| *byte == b'\n').expect("a line");
    let head: serde_json::Value = serde_json::from_slice(&answer[..end]).expect("JSON");
    assert_eq!(head["code"], 0);
    let bytes: u64 = head["outputs"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|own| own[1].as_u64().expect("a length"))
        .sum();
    assert_eq!(answer.len() as u64, end as u64 + 1 + bytes);
    // The program that was cut is kept in its room, and in no other one.
    let code = |room: &str| {
        let (_, _, answer) =
            server.ask("POST", &format!("/engine/{room}/run"), "", br#"{ "verb": "seek", "moves": 1 }"#);
        String::from_utf8_lossy(&answer).starts_with(r#"{"code":0"#)
    };
    assert!(code("heavy") && !code("quick"));
}

#[test]
fn programs_are_listed_read_watched_and_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.nc"), PART).expect("a file");
    fs::write(folder.path().join(".hidden"), "no").expect("a file");
    let server = Server::of(folder.path());
    let list = |query: &str| -> serde_json::Value {
        let (status, _, body) = server.ask("GET", &format!("/programs{query}"), "", b"");
        assert_eq!(status, 200);
        serde_json::from_slice(&body).expect("JSON")
    };
    let first = list("");
    assert_eq!(first["programs"], serde_json::json!([{ "name": "a.nc", "bytes": PART.len() }]));
    let (status, head, body) = server.ask("GET", "/programs/a.nc", "", b"");
    assert_eq!((status, body.as_slice()), (200, PART.as_bytes()));
    let tag =
        head.split("etag: ").nth(1).and_then(|rest| rest.split("\r\n").next()).expect("a tag").to_owned();
    // Saved over what was read, and over nothing else.
    let save = |name: &str, headers: &str, text: &str| {
        server.ask("PUT", &format!("/programs/{name}"), headers, text.as_bytes()).0
    };
    assert_eq!(save("a.nc", "", "x"), 428);
    assert_eq!(save("a.nc", "If-Match: \"0\"\r\n", "x"), 412);
    assert_eq!(save("a.nc", "If-None-Match: *\r\n", "x"), 412);
    let path = folder.path().join("a.nc");
    assert_eq!(fs::read_to_string(&path).expect("a file"), PART);
    assert_eq!(save("a.nc", &format!("If-Match: {tag}\r\n"), "M30\n"), 204);
    assert_eq!(fs::read_to_string(&path).expect("a file"), "M30\n");
    assert_eq!(save("a.nc", &format!("If-Match: {tag}\r\n"), "x"), 412);
    assert_eq!(save("b.nc", "If-None-Match: *\r\n", "M2\n"), 204);
    // Whoever knows the old list is told of the new one at once.
    let stamp = first["stamp"].as_str().expect("a stamp");
    let second = list(&format!("?stamp={stamp}"));
    assert_eq!(second["programs"].as_array().map(Vec::len), Some(2));
    assert_ne!(second["stamp"], first["stamp"]);
}

#[test]
fn nobody_else_gets_in() {
    let outside = tempfile::tempdir().expect("a folder");
    let folder = outside.path().join("programs");
    fs::create_dir(&folder).expect("a folder");
    fs::create_dir(folder.join("deeper")).expect("a folder");
    for (name, text) in
        [("secret.nc", "secret"), ("programs/part.nc", PART), ("programs/deeper/in.nc", "deeper")]
    {
        fs::write(outside.path().join(name), text).expect("a file");
    }
    #[cfg(unix)]
    std::os::unix::fs::symlink(outside.path().join("secret.nc"), folder.join("link.nc")).expect("a link");
    let server = Server::of(&folder);
    let guarded = [
        ("GET", "/programs"),
        ("GET", "/programs/part.nc"),
        ("PUT", "/programs/part.nc"),
        ("POST", "/engine/a/run"),
        ("PUT", "/engine/a/files/x"),
    ];
    let port = server.port;
    for (method, path) in guarded {
        let own = format!("127.0.0.1:{port}");
        let token = format!("Authorization: Bearer {}\r\n", server.token);
        for (host, headers, status) in [
            (own.as_str(), "", 401),
            (own.as_str(), "Authorization: Bearer 0\r\n", 401),
            (own.as_str(), "Authorization: Basic YTpi\r\n", 401),
            ("evil.example", token.as_str(), 403),
            (&format!("evil.example:{port}"), token.as_str(), 403),
            (own.as_str(), &format!("{token}Origin: http://evil.example\r\n"), 403),
            (own.as_str(), &format!("{token}Origin: null\r\n"), 403),
            (own.as_str(), &format!("{token}Origin: https://127.0.0.1:{port}\r\n"), 403),
        ] {
            let request = format!(
                "{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Length: 0\r\n{headers}\r\n"
            );
            let (got, head, body) = server.send(request.as_bytes());
            assert_eq!(got, status, "{method} {path} {host} {headers}: {head}");
            assert!(body.is_empty(), "{method} {path} {host} {headers}");
        }
    }
    // No file outside the folder, by any name.
    for name in [
        "..%2Fsecret.nc",
        "%2E%2E%2Fsecret.nc",
        "..%5Csecret.nc",
        "%2Fetc%2Fpasswd",
        "deeper%2Fin.nc",
        "deeper",
        "link.nc",
        "..",
        ".",
        "%00",
        "part.nc%00.txt",
        "C:%5Csecret.nc",
        "none.nc",
        ".hidden",
    ] {
        let (status, _, body) = server.ask("GET", &format!("/programs/{name}"), "", b"");
        assert!(matches!(status, 400 | 404), "{name}: {status}");
        assert!(!String::from_utf8_lossy(&body).contains("secret"), "{name}");
        let (status, ..) = server.ask("PUT", &format!("/programs/{name}"), "If-Match: \"0\"\r\n", b"x");
        assert!(matches!(status, 400 | 404 | 412), "{name}: {status}");
    }
    let (status, ..) = server.ask("PUT", "/programs/..%2Fnew.nc", "If-None-Match: *\r\n", b"x");
    assert_eq!(status, 404);
    assert!(!outside.path().join("new.nc").exists());
    assert_eq!(fs::read_to_string(outside.path().join("secret.nc")).expect("a file"), "secret");
    // Of one file, no other one.
    let server = Server::of(&folder.join("part.nc"));
    assert_eq!(server.ask("GET", "/programs/part.nc", "", b"").0, 200);
    assert_eq!(server.ask("PUT", "/programs/other.nc", "If-None-Match: *\r\n", b"x").0, 404);
    // What no page has is not there; nothing but reading is done to the page's files.
    assert_eq!(server.ask("GET", "/../Cargo.toml", "", b"").0, 404);
    assert_eq!(server.ask("DELETE", "/", "", b"").0, 405);
    // Rooms have plain names, and there are not too many.
    assert_eq!(server.ask("POST", "/engine/%3Cb%3E/run", "", b"{}").0, 404);
    let statuses: Vec<u16> =
        (0..56).map(|n| server.ask("POST", &format!("/engine/r{n}/run"), "", b"{}").0).collect();
    assert!(statuses[..8].iter().all(|status| *status == 200) && statuses[55] == 429, "{statuses:?}");
}

/// Blocks of a loop that takes minutes.
const ENDLESS: &str =
    "%\nO1\nG21 G17 G90 G94 G54\n#1=0\nWHILE[#1LT900000000]DO1\nG1 X[#1/1000] F500.\n#1=#1+1\nEND1\nM30\n%\n";

#[test]
fn a_request_whose_connection_is_gone_stops() {
    let folder = tempfile::tempdir().expect("a folder");
    let server = Server::of(folder.path());
    for (name, text) in [("endless.nc", ENDLESS), ("part.nc", PART)] {
        assert_eq!(server.ask("PUT", &format!("/engine/heavy/files/{name}"), "", text.as_bytes()).0, 204);
    }
    for verb in ["check", "simulate", "time"] {
        let request = format!(r#"{{ "verb": "{verb}", "file": "endless.nc", "from": "fanuc" }}"#);
        let head = format!(
            "POST /engine/heavy/run HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAuthorization: Bearer {}\r\nContent-Length: {}\r\n\r\n{request}",
            server.port,
            server.token,
            request.len()
        );
        let mut stream = TcpStream::connect(("127.0.0.1", server.port)).expect("a connection");
        stream.write_all(head.as_bytes()).expect("sent");
        thread::sleep(Duration::from_millis(300));
        drop(stream);
        // The room is free again: the next request has its answer.
        let began = Instant::now();
        let request = br#"{ "verb": "check", "file": "part.nc", "from": "fanuc" }"#;
        assert_eq!(server.ask("POST", "/engine/heavy/run", "", request).0, 200);
        assert!(began.elapsed() < Duration::from_secs(20), "{verb}: {:?}", began.elapsed());
    }
}
