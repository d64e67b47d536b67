//! The studio's page and its engines: headers, limits, and rooms of users.

use std::thread;
use std::time::{Duration, Instant};

use ncc_service::Limits;
use serde_json::Value;

use crate::access::{admin, limits, with_rights};
use crate::client::{Answer, Server};
use crate::limits::MOVES;

const PART: &str = "%\nO1\nG21 G17 G90 G94 G40 G54\nT1 M6\nS3000 M3\nG43 H1 G0 X10. Y10. Z5.\nG1 Z-2. F200.\nG0 Z5.\nM30\n%\n";

/// A call of a program that another file has.
const CALLS: &str = "%\nO1\nG21 G17 G90 G94 G40 G54\nT1 M6\nS3000 M3\nG0 X10. Y10. Z5.\nM98 P2000\nM30\n%\n";

const CALLED: &str = "%\nO2000\nG1 Z-2. F200.\nG0 Z5.\nM99\n%\n";

impl Server {
    fn room(&self, room: &str) -> Answer {
        self.ask("PUT", &format!("/api/v1/engine/{room}"), &[], b"")
    }

    fn file(&self, room: &str, name: &str, text: &[u8]) -> Answer {
        self.ask("PUT", &format!("/api/v1/engine/{room}/files/{name}"), &[], text)
    }

    fn run(&self, room: &str, request: &str) -> Answer {
        self.json("POST", &format!("/api/v1/engine/{room}/run"), request.as_bytes())
    }
}

/// The code of an answer, and its outputs.
fn read(answer: &Answer) -> (Value, String) {
    assert_eq!(answer.status, 200, "{}", answer.text());
    let end = answer.body.iter().position(|byte| *byte == b'\n').expect("a line");
    let head: Value = serde_json::from_slice(&answer.body[..end]).expect("JSON");
    (head["code"].clone(), String::from_utf8_lossy(&answer.body[end + 1..]).into_owned())
}

fn check(server: &Server, room: &str, file: &str) -> (Value, String) {
    read(&server.run(room, &format!(r#"{{ "verb": "check", "file": "{file}", "from": "fanuc" }}"#)))
}

#[test]
fn the_page_has_its_own_policy() {
    let server = Server::all();
    for (path, media) in [
        ("/", "text/html; charset=utf-8"),
        ("/studio.css", "text/css; charset=utf-8"),
        ("/studio.js", "text/javascript; charset=utf-8"),
        ("/icon.svg", "image/svg+xml"),
        ("/manifest.webmanifest", "application/manifest+json"),
    ] {
        let file = server.get(path);
        assert_eq!((file.status, file.header("content-type")), (200, media), "{path}");
        let policy = file.header("content-security-policy");
        for part in
            ["default-src 'none'", "script-src 'self'", "connect-src 'self'", "frame-ancestors 'none'"]
        {
            assert!(policy.contains(part), "{path}: {policy}");
        }
        assert!(!policy.contains("unsafe") && !policy.contains('*') && !policy.contains("http"), "{policy}");
        for (name, value) in [
            ("x-content-type-options", "nosniff"),
            ("referrer-policy", "no-referrer"),
            ("cross-origin-opener-policy", "same-origin"),
            ("cross-origin-resource-policy", "same-origin"),
            // A browser asks each time, and gets nothing where nothing has changed.
            ("cache-control", "no-cache"),
        ] {
            assert_eq!(file.header(name), value, "{path}: {name}");
        }
        let again = server.ask("GET", path, &[("If-None-Match", file.header("etag"))], b"");
        assert_eq!((again.status, again.body.len()), (304, 0), "{path}");
        assert_eq!(server.ask("HEAD", path, &[], b"").status, 200, "{path}");
        assert_eq!(server.ask("PUT", path, &[], b"x").status, 405, "{path}");
        let foreign = [("Origin", "http://example.com")];
        assert_eq!(server.ask("GET", path, &foreign, b"").status, 403, "{path}");
    }
    assert!(server.get("/").text().contains(r#"name="ncc-host" content="serve""#));
    let api = server.get("/api/v1/programs");
    assert!(api.header("content-security-policy").starts_with("default-src 'none'; frame-ancestors"));
}

#[test]
fn an_engine_has_a_room() {
    let server = Server::all();
    assert_eq!(server.file("a", "part.nc", PART.as_bytes()).status, 404);
    assert_eq!(server.room("a").status, 204);
    assert_eq!(server.room("a").status, 204);
    assert_eq!(server.file("a", "part.nc", PART.as_bytes()).status, 204);
    let cut = server.run("a", r#"{ "verb": "simulate", "file": "part.nc", "from": "fanuc", "cells": 64 }"#);
    assert_eq!(read(&cut).0, 0, "{}", cut.text());
    // The part that was cut stays in its room, and is in no other one.
    assert_eq!(server.room("b").status, 204);
    let seek = |room: &str| read(&server.run(room, r#"{ "verb": "seek", "moves": 1 }"#)).0;
    assert!(seek("a") == 0 && seek("b") != 0);
    assert_eq!(server.delete("/api/v1/engine/a").status, 204);
    assert_eq!(server.run("a", "{}").status, 404);
    for wrong in ["%3Cb%3E", "a%2Fb", "..%2F..", &"x".repeat(65), "%20"] {
        assert!(matches!(server.room(wrong).status, 400 | 404), "{wrong}");
    }
    for wrong in ["a%2Fb", "%00", "..", "%FF"] {
        assert_eq!(server.file("b", wrong, b"x").status, 400, "{wrong}");
    }
}

/// No file of the computer is read, by whatever name.
#[test]
fn calls_find_the_files_of_the_room_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let secret = folder.path().join("O2000.nc");
    std::fs::write(&secret, CALLED).expect("a file");
    let server = Server::all();
    server.room("a");
    server.file("a", "part.nc", CALLS.as_bytes());
    let secret = secret.to_string_lossy().into_owned();
    for file in [secret.as_str(), "/etc/passwd", "../Cargo.toml", "Cargo.toml"] {
        let (code, told) = check(&server, "a", file);
        assert!(code != 0 && !told.contains("root:") && !told.contains("[package]"), "{file}: {told}");
    }
    for machine in ["/etc/passwd", "Cargo.toml"] {
        let request = format!(r#"{{ "verb": "check", "file": "part.nc", "machine": "{machine}" }}"#);
        assert!(!read(&server.run("a", &request)).1.contains("root:"));
    }
    assert!(check(&server, "a", "part.nc").1.contains("NC0811"));
    // Those of the store come on wish, and go with it.
    let keep = |folder: &str, name: &str, text: &str| {
        let target = format!("/api/v1/programs?folder={folder}&name={name}");
        server.program("POST", &target, text).json()["id"].as_str().expect("an id").to_owned()
    };
    let (part, sub) = (keep("x", "part.nc", CALLS), keep("x", "sub.nc", CALLED));
    keep("y", "other.nc", CALLED);
    let beside =
        |program: &str| server.ask("PUT", &format!("/api/v1/engine/a/called/{program}"), &[], b"").status;
    assert_eq!(beside(&part), 204);
    assert!(!check(&server, "a", "part.nc").1.contains("NC0811"));
    assert_eq!(server.delete(&format!("/api/v1/programs/{sub}")).status, 200);
    assert_eq!(beside(&part), 204);
    assert!(check(&server, "a", "part.nc").1.contains("NC0811"));
    assert_eq!(beside("none"), 404);
}

/// A room is its user's; the page is there for everybody, and its engines are not.
#[test]
fn nobody_uses_the_room_of_another() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let [ana, bob] = ["ana", "bob"].map(|name| with_rights(&server, &root, name, &[(name, "editor")]));
    let nothing = Value::Null;
    assert_eq!(ana.ask(&server, "PUT", "/api/v1/engine/a", &nothing).status, 204);
    let file = "/api/v1/engine/a/files/part.nc";
    assert_eq!(ana.ask(&server, "PUT", file, &PART.into()).status, 204);
    let check = serde_json::json!({ "verb": "check", "file": "part.nc", "from": "fanuc" });
    let code = |answer: &Answer| read(answer).0;
    assert_eq!(code(&ana.ask(&server, "POST", "/api/v1/engine/a/run", &check)), 0);
    assert_eq!(bob.ask(&server, "PUT", file, &PART.into()).status, 404);
    assert_eq!(bob.ask(&server, "POST", "/api/v1/engine/a/run", &check).status, 404);
    // Bob's room of this name is another one.
    assert_eq!(bob.ask(&server, "PUT", "/api/v1/engine/a", &nothing).status, 204);
    assert_ne!(code(&bob.ask(&server, "POST", "/api/v1/engine/a/run", &check)), 0);
    assert_eq!(bob.ask(&server, "DELETE", "/api/v1/engine/a", &nothing).status, 204);
    assert_eq!(code(&ana.ask(&server, "POST", "/api/v1/engine/a/run", &check)), 0);
    // A program of a folder that bob may not read is not there for his calls.
    let made = ana.ask(&server, "POST", "/api/v1/programs?folder=ana&name=sub.nc", &CALLED.into()).json();
    let called = format!("/api/v1/engine/a/called/{}", made["id"].as_str().expect("an id"));
    assert_eq!(bob.ask(&server, "PUT", "/api/v1/engine/a", &nothing).status, 204);
    assert_eq!(ana.ask(&server, "PUT", &called, &nothing).status, 204);
    assert_eq!(bob.ask(&server, "PUT", &called, &nothing).status, 404);
    let folders = |of: &crate::access::User| of.get(&server, "/api/v1/folders").json()["folders"].clone();
    assert_eq!(folders(&ana), serde_json::json!([{ "folder": "ana", "programs": 1 }]));
    assert_eq!(folders(&bob), serde_json::json!([]));
    assert_eq!((server.get("/").status, server.get("/studio.js").status), (200, 200));
    assert_eq!(server.room("a").status, 401);
}

#[test]
fn rooms_have_their_number_and_their_bytes() {
    let limits = Limits { rooms_of_user: 2, room_bytes: 3000, rooms_bytes: 4000, ..Limits::default() };
    let server = Server::limited(limits);
    for room in ["a", "b", "c"] {
        assert_eq!(server.room(room).status, 204);
    }
    // The one that was not used for the longest time has made place.
    assert_eq!(server.file("a", "x", b"x").status, 404);
    assert_eq!(server.file("b", "x", &[b' '; 2900]).status, 204);
    assert_eq!(server.file("b", "y", &[b' '; 200]).status, 413);
    assert_eq!(server.file("b", "x", &[b' '; 2950]).status, 204, "in the place of the other one");
    assert_eq!(server.file("c", "x", &[b' '; 2000]).status, 204);
    assert_eq!(server.run("b", "{}").status, 404);
    let many = Limits { rooms: 2, ..Limits::default() };
    let server = Server::limited(many);
    for room in ["a", "b", "c"] {
        assert_eq!(server.room(room).status, 204);
    }
    assert_eq!(server.run("a", "{}").status, 404);
    // A room without use is given up.
    let server = Server::limited(Limits { room_age: Duration::ZERO, ..Limits::default() });
    assert_eq!(server.room("a").status, 204);
    assert_eq!(server.run("a", "{}").status, 404);
    let server = Server::limited(Limits { largest: 100, ..Limits::default() });
    server.room("a");
    assert_eq!(server.file("a", "x", &[b' '; 101]).status, 413);
    let fine = server.run("a", r#"{ "verb": "simulate", "file": "x", "cells": 4096 }"#);
    assert_eq!(
        (fine.status, fine.json()["detail"].as_str()),
        (400, Some("a part has 2048 cells along its longer side at most"))
    );
}

/// A loop of a few lines makes any number of moves, and its path as many places.
#[test]
fn a_path_has_its_length() {
    let server = Server::limited(Limits { moves: 1000, ..Limits::default() });
    server.room("a");
    server.file("a", "long.nc", MOVES.as_bytes());
    let request = r#"{ "verb": "path", "file": "long.nc", "from": "fanuc", "most_moves": 9000000 }"#;
    let (code, told) = read(&server.run("a", request));
    assert!(code != 0 && told.contains("it makes more than 1000 moves"), "{code}: {told}");
}

/// Work of a room has the limits of other work, ends with its client, and its room is free again.
#[test]
fn work_in_a_room_has_its_time() {
    let server = Server::limited(Limits { work: Duration::from_millis(400), ..Limits::default() });
    server.room("a");
    server.file("a", "long.nc", MOVES.as_bytes());
    server.file("a", "part.nc", PART.as_bytes());
    for verb in ["check", "path", "simulate"] {
        let request = format!(r#"{{ "verb": "{verb}", "file": "long.nc", "from": "fanuc" }}"#);
        let stopped = server.run("a", &request);
        assert_eq!(stopped.json()["type"], "urn:ncc:problem:too-long", "{verb}: {}", stopped.text());
    }
    assert_eq!(check(&server, "a", "part.nc").0, 0);
    let server = Server::all();
    server.room("a");
    server.file("a", "long.nc", MOVES.as_bytes());
    server.file("a", "part.nc", PART.as_bytes());
    let request = r#"{ "verb": "simulate", "file": "long.nc", "from": "fanuc" }"#;
    let begun = Instant::now();
    let media = [("Content-Type", "application/json")];
    let stream = server.send("POST", "/api/v1/engine/a/run", &media, request.as_bytes());
    thread::sleep(Duration::from_millis(300));
    drop(stream);
    assert_eq!(check(&server, "a", "part.nc").0, 0);
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
    for (request, status) in [("{", 422), ("[]", 422), ("{}", 200)] {
        assert_eq!(server.run("a", request).status, status, "{request}");
    }
    assert_eq!(server.ask("POST", "/api/v1/engine/a/run", &[], b"{}").status, 415);
}

#[test]
fn folders_are_listed() {
    let server = Server::all();
    for target in ["folder=b%2Fc&name=1", "folder=a&name=1", "folder=a&name=2", "name=1"] {
        assert_eq!(server.program("POST", &format!("/api/v1/programs?{target}"), "M30\n").status, 201);
    }
    let folders = server.get("/api/v1/folders").json()["folders"].clone();
    assert_eq!(
        folders,
        serde_json::json!([
            { "folder": "", "programs": 1 },
            { "folder": "a", "programs": 2 },
            { "folder": "b/c", "programs": 1 },
        ])
    );
}
