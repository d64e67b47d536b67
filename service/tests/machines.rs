//! Machines and their history.

use serde_json::{Value, json};

use crate::client::{Answer, Server, TABLE_10};

const PATH: &str = "/api/v1/machines/own";

fn profile(rapid: u32) -> String {
    format!("id = \"own\"\ntitle = \"Own {rapid}\"\ndialect = \"fanuc\"\n")
}

fn put(server: &Server, text: &str, more: &[(&str, &str)]) -> Answer {
    let headers = [&[("Content-Type", "application/toml")], more].concat();
    server.ask("PUT", PATH, &headers, text.as_bytes())
}

fn numbers(server: &Server, query: &str) -> Vec<Value> {
    let list = server.get(&format!("{PATH}/revisions{query}")).json();
    let list = list["revisions"].as_array().expect("revisions");
    list.iter().map(|own| json!([own["number"], own["deleted"]])).collect()
}

/// Every state of a profile stays, also of a machine that was deleted and is there again.
#[test]
fn nothing_of_a_profile_is_overwritten() {
    let server = Server::all();
    assert_eq!(server.get(&format!("{PATH}/revisions")).status, 404);
    let first = put(&server, &profile(1), &[]);
    assert_eq!(first.status, 201, "{}", first.text());
    assert_eq!(put(&server, &profile(2), &[]).status, 204);
    // The same text again is no revision.
    assert_eq!(put(&server, &profile(2), &[]).status, 204);
    assert_eq!(numbers(&server, ""), [json!([2, false]), json!([1, false])]);
    assert_eq!(server.delete(PATH).status, 204);
    assert_eq!(put(&server, &profile(3), &[]).status, 201);
    let all = [json!([4, false]), json!([3, true]), json!([2, false]), json!([1, false])];
    assert_eq!(numbers(&server, ""), all);
    let page = server.get(&format!("{PATH}/revisions?limit=3")).json();
    assert_eq!(page["next"], 2, "{page}");
    assert_eq!(numbers(&server, "?limit=3&before=2"), all[3..]);
    for (number, text) in [(1, profile(1)), (2, profile(2)), (4, profile(3))] {
        let then = server.get(&format!("{PATH}/revisions/{number}"));
        assert_eq!((then.status, then.text()), (200, text));
        assert_eq!(then.header("content-type"), "application/toml");
    }
    let then = server.get(&format!("{PATH}/revisions/1"));
    assert_eq!(then.header("etag"), first.header("etag"));
    let known = [("If-None-Match", then.header("etag"))];
    assert_eq!(server.ask("GET", &format!("{PATH}/revisions/1"), &known, b"").status, 304);
    for absent in ["3", "5", "0", "x"] {
        assert_eq!(server.get(&format!("{PATH}/revisions/{absent}")).status, 404, "{absent}");
    }
}

#[test]
fn a_profile_is_restored() {
    let server = Server::all();
    let restore = |number: u32, more: &[(&str, &str)]| {
        server.ask("POST", &format!("{PATH}/revisions/{number}/restore"), more, b"")
    };
    let first = put(&server, &profile(1), &[]);
    let second = put(&server, &profile(2), &[]);
    // Somebody has changed it meanwhile.
    assert_eq!(restore(1, &[("If-Match", first.header("etag"))]).status, 412);
    let made = restore(1, &[("If-Match", second.header("etag"))]);
    assert_eq!(made.status, 201, "{}", made.text());
    assert_eq!(made.header("location"), PATH);
    assert_eq!(made.header("etag"), first.header("etag"));
    assert_eq!(server.get(PATH).text(), profile(1));
    assert_eq!(server.delete(PATH).status, 204);
    assert_eq!(restore(4, &[]).status, 404, "a deleted machine has no text");
    assert_eq!(restore(2, &[]).status, 201);
    assert_eq!(server.get(PATH).text(), profile(2));
    assert_eq!(numbers(&server, "").len(), 5);
    // A profile that is so already gets no further revision.
    assert_eq!(restore(2, &[]).status, 201);
    assert_eq!(numbers(&server, "").len(), 5);
}

/// A translation is stale while its machine has another profile, and holds again with the one that it was made with.
#[test]
fn a_restored_profile_makes_a_translation_hold_again() {
    let server = Server::all();
    put(&server, &profile(1), &[]);
    let program = server.program("POST", "/api/v1/programs?name=a.cn&dialect=mach9", crate::client::PROGRAM);
    let program = program.json()["id"].as_str().expect("an id").to_owned();
    let asked = json!({ "program": program, "to": "fanuc", "machine_to": "own" });
    let made = server.json("POST", "/api/v1/translations", asked.to_string().as_bytes());
    assert_eq!(made.status, 201, "{}", made.text());
    let place = made.header("location").to_owned();
    let stale = || server.get(&place).json()["stale"].clone();
    assert_eq!(stale(), json!([]));
    put(&server, &profile(2), &[]);
    assert_eq!(stale(), json!(["machine_to"]));
    assert_eq!(server.ask("POST", &format!("{PATH}/revisions/1/restore"), &[], b"").status, 201);
    assert_eq!(stale(), json!([]));
}

/// A machine file of the case study has a history too.
#[test]
fn a_machine_json_comes_back_as_json() {
    let server = Server::all();
    assert_eq!(server.json("PUT", "/api/v1/machines/romi", TABLE_10.as_bytes()).status, 201);
    let then = server.get("/api/v1/machines/romi/revisions/1");
    assert_eq!((then.status, then.text().as_str()), (200, TABLE_10));
    assert_eq!(then.header("content-type"), "application/json");
}
