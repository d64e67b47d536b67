//! Programs and their revisions.

use serde_json::{Value, json};

use crate::client::{Answer, PROGRAM, Server};

const TEXT: &[(&str, &str)] = &[("Content-Type", "text/plain")];

/// A new program; gives its name.
pub(crate) fn new(server: &Server, query: &str, text: &str) -> String {
    let made = server.program("POST", &format!("/api/v1/programs?{query}"), text);
    assert_eq!(made.status, 201, "{query}: {}", made.text());
    let id = made.json()["id"].as_str().expect("a name").to_owned();
    assert_eq!(made.header("location"), format!("/api/v1/programs/{id}"));
    assert_eq!(made.header("etag"), "\"1\"");
    id
}

fn put(server: &Server, id: &str, over: &str, text: &str) -> Answer {
    let headers = [TEXT[0], ("If-Match", over)];
    server.ask("PUT", &format!("/api/v1/programs/{id}/text"), &headers, text.as_bytes())
}

fn patch(server: &Server, id: &str, change: &Value) -> Answer {
    let headers = [("Content-Type", "application/merge-patch+json")];
    server.ask("PATCH", &format!("/api/v1/programs/{id}"), &headers, change.to_string().as_bytes())
}

/// Names of listed programs.
fn listed(server: &Server, query: &str) -> Vec<String> {
    let list = server.get(&format!("/api/v1/programs?{query}"));
    assert_eq!(list.status, 200, "{query}: {}", list.text());
    let programs = list.json()["programs"].as_array().expect("a list").clone();
    let place = |of: &Value| format!("{}/{}", of["folder"].as_str().unwrap(), of["name"].as_str().unwrap());
    programs.iter().map(|of| place(of).trim_start_matches('/').to_owned()).collect()
}

#[test]
fn nothing_is_overwritten() {
    let server = Server::all();
    let id = new(&server, "name=part.cn&folder=a&dialect=mach9&tag=z&tag=b&message=first", PROGRAM);
    assert_eq!(put(&server, &id, "\"1\"", "G0X1.\n").json()["revision"], 2);
    // Two writers who have read the same: the second one is told.
    assert_eq!(put(&server, &id, "\"1\"", "G0X2.\n").status, 412);
    // The same text again is no change.
    assert_eq!(put(&server, &id, "\"2\"", "G0X1.\n").json()["revision"], 2);
    let changed = patch(&server, &id, &json!({ "folder": "b/c", "tags": null, "message": "moved" }));
    assert_eq!((changed.status, &changed.json()["revision"]), (200, &json!(3)));
    assert_eq!(patch(&server, &id, &json!({})).json()["revision"], 3);
    let path = format!("/api/v1/programs/{id}");
    assert_eq!(server.delete(&format!("{path}?message=old")).json()["change"], "deleted");
    assert_eq!(listed(&server, ""), [""; 0]);
    assert_eq!(listed(&server, "deleted=true"), ["b/c/part.cn"]);
    for (method, target) in [("PUT", "/text"), ("DELETE", "")] {
        assert_eq!(server.program(method, &format!("{path}{target}"), "M30\n").status, 404, "{method}");
    }
    assert_eq!(patch(&server, &id, &json!({ "name": "x" })).status, 404);
    let restored = server.ask("POST", &format!("{path}/revisions/1/restore"), &[], b"");
    assert_eq!((restored.status, &restored.json()["folder"]), (201, &json!("a")));
    assert_eq!(server.get(&format!("{path}/text")).text(), PROGRAM);
    let history = server.get(&format!("{path}/revisions")).json();
    let history: Vec<String> = history["revisions"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|of| {
            format!(
                "{} {} {}",
                of["revision"],
                of["change"].as_str().unwrap(),
                of["message"].as_str().unwrap()
            )
        })
        .collect();
    assert_eq!(history, ["5 restored ", "4 deleted old", "3 details moved", "2 text ", "1 created first"]);
    assert_eq!(server.get(&format!("{path}/revisions/2/text")).text(), "G0X1.\n");
    assert_eq!(server.get(&format!("{path}/revisions/3")).json()["tags"], json!([]));
    assert_eq!(server.get(&format!("{path}/revisions/1")).json()["tags"], json!(["b", "z"]));
    assert_eq!(server.get(&format!("{path}/revisions/6")).status, 404);
    assert_eq!(server.get(&format!("{path}/revisions?limit=2&before=4")).json()["next"], 2);
}

#[test]
fn a_name_is_taken_once() {
    let server = Server::all();
    let first = new(&server, "name=a.nc&folder=f", "M30\n");
    let other = new(&server, "name=b.nc&folder=f", "M30\n");
    assert_eq!(server.program("POST", "/api/v1/programs?name=a.nc&folder=f", "M30\n").status, 409);
    assert_eq!(patch(&server, &other, &json!({ "name": "a.nc" })).status, 409);
    assert_eq!(server.delete(&format!("/api/v1/programs/{first}")).status, 200);
    // Its name is free then, and the deleted one cannot come back to it.
    assert_eq!(patch(&server, &other, &json!({ "name": "a.nc" })).status, 200);
    let back = server.ask("POST", &format!("/api/v1/programs/{first}/revisions/1/restore"), &[], b"");
    assert_eq!(back.status, 409);
}

#[test]
fn a_request_with_a_key_is_done_once() {
    let server = Server::all();
    let send = |query: &str, text: &str| {
        let headers = [TEXT[0], ("Idempotency-Key", "k-1")];
        server.ask("POST", &format!("/api/v1/programs?{query}"), &headers, text.as_bytes())
    };
    let first = send("name=a.nc", "M30\n");
    let again = send("name=a.nc", "M30\n");
    assert_eq!((first.status, again.status, first.text()), (201, 201, again.text()));
    assert_eq!(send("name=b.nc", "M30\n").status, 422);
    assert_eq!(send("name=a.nc", "M02\n").status, 422);
    assert_eq!(listed(&server, ""), ["a.nc"]);
}

#[test]
fn programs_are_found() {
    let server = Server::all();
    for (place, more) in [
        ("name=c.nc", "&dialect=fanuc&tag=x"),
        ("name=a.nc&folder=f", "&machine=m&tag=x&tag=y"),
        ("name=B.nc&folder=f", ""),
        ("name=d.nc&folder=f/g", "&dialect=haas"),
        ("name=e.nc&folder=fg", ""),
        ("name=100%25.nc&folder=h", ""),
    ] {
        new(&server, &format!("{place}{more}"), "M30\n");
    }
    for (query, found) in [
        ("", &["c.nc", "f/B.nc", "f/a.nc", "f/g/d.nc", "fg/e.nc", "h/100%.nc"][..]),
        ("folder=", &["c.nc"]),
        ("folder=f", &["f/B.nc", "f/a.nc"]),
        ("under=f", &["f/B.nc", "f/a.nc", "f/g/d.nc"]),
        ("name=b", &["f/B.nc"]),
        ("name=%25", &["h/100%.nc"]),
        ("tag=x", &["c.nc", "f/a.nc"]),
        ("tag=x&tag=y", &[]),
        ("dialect=haas", &["f/g/d.nc"]),
        ("machine=m", &["f/a.nc"]),
        ("under=f&tag=y", &["f/a.nc"]),
    ] {
        if query == "tag=x&tag=y" {
            assert_eq!(server.get(&format!("/api/v1/programs?{query}")).status, 400);
            continue;
        }
        assert_eq!(listed(&server, query), found, "{query}");
    }
    let mut all = Vec::new();
    let mut query = "limit=2".to_owned();
    loop {
        let page = server.get(&format!("/api/v1/programs?{query}")).json();
        all.extend(page["programs"].as_array().expect("a list").iter().map(|of| of["name"].clone()));
        let Some(next) = page["next"].as_str() else { break };
        query = format!("limit=2&after={next}");
    }
    assert_eq!(all, ["c.nc", "B.nc", "a.nc", "d.nc", "e.nc", "100%.nc"]);
}

#[test]
fn what_is_wrong_is_refused() {
    let server = Server::all();
    let id = new(&server, "name=a.nc", "M30\n");
    for (query, status) in [
        ("", 400),
        ("name=", 400),
        ("name=a%2Fb", 400),
        ("name=b&folder=/x", 400),
        ("name=b&folder=x/../y", 400),
        ("name=b&dialect=nobody", 400),
        ("name=b&tag=", 400),
        ("name=b&color=red", 400),
        ("name=b&name=c", 400),
    ] {
        assert_eq!(
            server.program("POST", &format!("/api/v1/programs?{query}"), "M30\n").status,
            status,
            "{query}"
        );
    }
    let many = (0..101).map(|n| format!("&tag=t{n}")).collect::<String>();
    assert_eq!(server.program("POST", &format!("/api/v1/programs?name=b{many}"), "M30\n").status, 400);
    for change in
        [json!([]), json!({ "nam": "x" }), json!({ "name": null }), json!({ "tags": "x" }), json!(1)]
    {
        assert_eq!(
            patch(&server, &id, &change).status,
            if change == json!({ "name": null }) { 200 } else { 422 }
        );
    }
    for target in ["/api/v1/programs/none", "/api/v1/programs/none/text", "/api/v1/programs/none/revisions"] {
        assert_eq!(server.get(target).status, 404, "{target}");
    }
    assert_eq!(server.json("POST", "/api/v1/programs?name=b", b"{}").status, 415);
}

#[test]
fn a_text_comes_back_byte_for_byte() {
    let server = Server::all();
    // Longer than a piece, and no text in UTF-8.
    let bytes: Vec<u8> = (0..2_500_000_u32).map(|n| (n % 251) as u8).collect();
    let made = server.ask("POST", "/api/v1/programs?name=long.nc", TEXT, &bytes);
    assert_eq!((made.status, &made.json()["bytes"]), (201, &json!(bytes.len())));
    let again = server.ask("POST", "/api/v1/programs?name=twin.nc", TEXT, &bytes);
    assert_eq!(again.json()["sha256"], made.json()["sha256"]);
    for of in [&made, &again] {
        let id = of.json()["id"].as_str().expect("a name").to_owned();
        let text = server.get(&format!("/api/v1/programs/{id}/text"));
        assert!(text.status == 200 && text.body == bytes);
        assert_eq!(text.header("content-length"), bytes.len().to_string());
        let known = [("If-None-Match", "\"1\"")];
        assert_eq!(server.ask("GET", &format!("/api/v1/programs/{id}/text"), &known, b"").status, 304);
    }
    let empty = server.ask("POST", "/api/v1/programs?name=empty.nc", TEXT, b"");
    let id = empty.json()["id"].as_str().expect("a name").to_owned();
    let text = server.get(&format!("/api/v1/programs/{id}/text"));
    assert_eq!((empty.status, text.status, text.body.len()), (201, 200, 0));
}
