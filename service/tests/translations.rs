//! Translations of kept programs: made once, stale, released; and what is made of programs.

use serde_json::{Value, json};

use crate::client::{Answer, PROGRAM, Server, TABLE_10};
use crate::programs::new;

fn translate(server: &Server, asked: &Value) -> Answer {
    server.json("POST", "/api/v1/translations", asked.to_string().as_bytes())
}

fn step(server: &Server, id: &str, state: &str) -> Answer {
    let asked = json!({ "state": state, "message": "so" });
    server.json("POST", &format!("/api/v1/translations/{id}/states"), asked.to_string().as_bytes())
}

fn id(of: &Answer) -> String {
    of.json()["id"].as_str().unwrap_or_else(|| panic!("{}", of.text())).to_owned()
}

fn stale(server: &Server, id: &str) -> Value {
    server.get(&format!("/api/v1/translations/{id}")).json()["stale"].clone()
}

const OWN: &str = "id = \"own\"\ntitle = \"Own\"\ndialect = \"fanuc\"\n";

fn own_machine(server: &Server, more: &str) -> u16 {
    let text = format!("{OWN}{more}");
    server.ask("PUT", "/api/v1/machines/own", &[("Content-Type", "application/toml")], text.as_bytes()).status
}

#[test]
fn a_translation_is_made_once() {
    let server = Server::all();
    let program = new(&server, "name=part.cn&dialect=mach9", PROGRAM);
    let asked = json!({ "program": program, "to": "fanuc" });
    let first = translate(&server, &asked);
    let again = translate(&server, &asked);
    assert_eq!((first.status, again.status, id(&first)), (201, 200, id(&again)), "{}", first.text());
    assert_eq!(first.header("location"), format!("/api/v1/translations/{}", id(&first)));
    let other = translate(&server, &json!({ "program": program, "to": "fanuc", "program_number": 7 }));
    assert_eq!(other.status, 201);
    let path = format!("/api/v1/translations/{}", id(&other));
    let output = server.get(&format!("{path}/output")).text();
    assert!(output.contains("O0007") && output.contains("VERIFIED"), "{output}");
    let lines = server.get(&format!("{path}/map")).json();
    assert_eq!(lines.as_array().map(Vec::len), Some(output.lines().count()));
    assert_eq!(server.get(&format!("{path}/report")).json()["result"], "verified");
    let certificate = server.get(&format!("{path}/certificate"));
    assert_eq!(certificate.json()["verdict"], "equal", "{}", certificate.text());
    assert_eq!(server.get(&format!("{path}/certificate")).text(), certificate.text());
    assert_eq!(server.get(&format!("{path}/else")).status, 404);
    let list = server.get(&format!("/api/v1/translations?program={program}")).json();
    assert_eq!(list["translations"].as_array().map(Vec::len), Some(2));
}

#[test]
fn what_goes_in_makes_it_stale() {
    let server = Server::all();
    assert_eq!(own_machine(&server, ""), 201);
    let program = new(
        &server,
        "name=main.nc&folder=f&dialect=fanuc",
        "%\nO1\nG21 G90 G54\nG0 X1.\nM98 P2001\nM30\n%\n",
    );
    let asked = json!({ "program": program, "to": "haas", "machine_from": "own" });
    let alone = translate(&server, &asked);
    assert_eq!(alone.status, 422, "{}", alone.text());
    assert!(alone.text().contains("NC0217"), "{}", alone.text());
    let called = new(&server, "name=O2001&folder=f&dialect=fanuc", "%\nO2001\nG0 Y1.\nM99\n%\n");
    let made = translate(&server, &asked);
    assert_eq!(made.status, 201, "{}", made.text());
    let made = id(&made);
    assert_eq!(stale(&server, &made), json!([]));
    let put =
        |id: &str, text: &str| server.program("PUT", &format!("/api/v1/programs/{id}/text"), text).status;
    assert_eq!(put(&called, "%\nO2001\nG0 Y2.\nM99\n%\n"), 200);
    assert_eq!(stale(&server, &made), json!(["called programs"]));
    assert_eq!(own_machine(&server, "[rates]\nrapid = 1000\n"), 204);
    assert_eq!(stale(&server, &made), json!(["machine_from", "called programs"]));
    assert_eq!(put(&program, "%\nO1\nG21 G90 G54\nG0 X2.\nM98 P2001\nM30\n%\n"), 200);
    assert_eq!(stale(&server, &made), json!(["program", "machine_from", "called programs"]));
    // As all of it was before, it holds again.
    assert_eq!(put(&called, "%\nO2001\nG0 Y1.\nM99\n%\n"), 200);
    assert_eq!(own_machine(&server, ""), 204);
    let restored = server.ask("POST", &format!("/api/v1/programs/{program}/revisions/1/restore"), &[], b"");
    assert_eq!((restored.status, stale(&server, &made)), (201, json!([])));
    assert_eq!(server.delete("/api/v1/machines/own").status, 204);
    assert_eq!(stale(&server, &made), json!(["machine_from"]));
}

#[test]
fn only_what_holds_is_released() {
    let server = Server::all();
    let program = new(&server, "name=part.cn&dialect=mach9", PROGRAM);
    let first = id(&translate(&server, &json!({ "program": program, "to": "fanuc" })));
    for (state, status) in [
        ("released", 409),
        ("approved", 409),
        ("in-review", 200),
        ("draft", 200),
        ("in-review", 200),
        ("approved", 200),
        ("released", 200),
        ("draft", 409),
        ("finished", 422),
    ] {
        let answer = step(&server, &first, state);
        assert_eq!(answer.status, status, "{state}: {}", answer.text());
    }
    // The program changes: the release is stale, and what is made of it now takes its place once it is released.
    let text = format!("{PROGRAM}G0Z9.\n");
    let path = format!("/api/v1/programs/{program}/text");
    assert_eq!(server.program("PUT", &path, &text).status, 200);
    let second = id(&translate(&server, &json!({ "program": program, "to": "fanuc" })));
    assert_eq!(
        (step(&server, &second, "in-review").status, step(&server, &second, "approved").status),
        (200, 200)
    );
    let released = |state: &str| {
        let list = server.get(&format!("/api/v1/translations?state={state}")).json();
        list["translations"].as_array().expect("a list").iter().map(|of| of["id"].clone()).collect::<Vec<_>>()
    };
    assert_eq!(released("released"), [json!(first)]);
    assert_eq!(step(&server, &second, "released").status, 200);
    assert_eq!((released("released"), released("obsolete")), (vec![json!(second)], vec![json!(first)]));
    // One that is stale is not released.
    let third = id(&translate(&server, &json!({ "program": program, "to": "haas" })));
    assert_eq!(
        (step(&server, &third, "in-review").status, step(&server, &third, "approved").status),
        (200, 200)
    );
    assert_eq!(server.program("PUT", &path, PROGRAM).status, 200);
    let refused = step(&server, &third, "released");
    assert!(refused.status == 409 && refused.text().contains("stale"), "{}", refused.text());
    let steps = server.get(&format!("/api/v1/translations/{first}/states")).json();
    let steps = steps["states"].as_array().expect("a list").iter();
    let steps: Vec<_> = steps.map(|of| of["state"].as_str().unwrap_or_default().to_owned()).collect();
    assert_eq!(steps, ["in-review", "draft", "in-review", "approved", "released", "obsolete"]);
}

#[test]
fn a_refusal_says_why_and_where() {
    let server = Server::all();
    let program = new(&server, "name=wrong.nc&dialect=fanuc", "%\nO1\nG21 G90\nG0 X1.\nG777\nM30\n%\n");
    let refused = translate(&server, &json!({ "program": program, "to": "siemens" }));
    assert_eq!((refused.status, refused.header("content-type")), (422, "application/problem+json"));
    let first = &refused.json()["diagnostics"][0];
    assert_eq!(
        (&first["code"], &first["place"]["line"]),
        (&json!("NC0201"), &json!(5)),
        "{}",
        refused.text()
    );
    let asking = new(
        &server,
        "name=asks.nc&dialect=fanuc",
        "%\nO1\nG21 G17 G40 G49 G80 G90 G54\nT1 M6\nS1000 M3\nG00 G43 H1 Z100\nG1 Z-5. F100.\nM30\n%\n",
    );
    let asked = translate(&server, &json!({ "program": asking, "to": "siemens" }));
    assert_eq!(asked.status, 422, "{}", asked.text());
    assert_eq!(asked.json()["questions"][0]["code"], "NC0303", "{}", asked.text());
    for (wrong, status) in [
        (json!({ "program": "none", "to": "haas" }), 404),
        (json!({ "program": program, "to": "nobody" }), 400),
        (json!({ "program": program }), 400),
        (json!({ "program": program, "machine_to": "nobody" }), 400),
        (json!({ "program": program, "two": "haas" }), 422),
        (json!([program]), 422),
    ] {
        assert_eq!(translate(&server, &wrong).status, status, "{wrong}");
    }
}

#[test]
fn outputs_are_those_of_the_command_line() {
    let server = Server::all();
    let program = new(&server, "name=part.cn&dialect=mach9", PROGRAM);
    let put = server.json("PUT", "/api/v1/machines/romi", TABLE_10.as_bytes());
    assert_eq!(put.status, 201);
    let get = |what: &str| server.get(&format!("/api/v1/programs/{program}/outputs/{what}"));
    let summary = get("summary?machine=romi").json();
    assert_eq!(
        (&summary["machine"], &summary["programs"][0]["tools"][0]["tool"]),
        (&json!("romi"), &json!(1))
    );
    let seconds = |what: &str| get(what).json()["programs"][0]["total"]["time"].as_f64().expect("a time");
    assert!(
        seconds("summary?machine=romi") > seconds("summary?machine=romi-discovery-4022&model=ideal") - 1e-9
    );
    assert!(get("tools").text().starts_with("program,position,tool,"));
    assert!(get("times").text().starts_with("n,block,function_name,"));
    assert_eq!(get("payload").json()["prog_name"], "part.cn");
    assert_eq!(get("check").json()["programs"][0]["source"], "part.cn");
    let times = get("times");
    let again = [("If-None-Match", times.header("etag"))];
    let target = format!("/api/v1/programs/{program}/outputs/times");
    assert_eq!(server.ask("GET", &target, &again, b"").status, 304);
    for (what, status) in [
        ("drawing", 404),
        ("times?model=x", 400),
        ("check?model=ideal", 400),
        ("times?machine=nobody", 400),
        ("times?revision=2", 404),
        ("times?dialect=canon", 422),
    ] {
        assert_eq!(get(what).status, status, "{what}: {}", get(what).text());
    }
}

/// A text that is not whole any more is never taken for a shorter program.
#[test]
fn a_lost_piece_is_a_fault() {
    let server = Server::all();
    let made = server.program("POST", "/api/v1/programs?name=a.cn&dialect=mach9", PROGRAM);
    let program = made.json()["id"].as_str().expect("an id").to_owned();
    server.sql("DELETE FROM content_piece").expect("the piece is gone");
    let asked = json!({ "program": program, "to": "fanuc" }).to_string();
    let refused = server.json("POST", "/api/v1/translations", asked.as_bytes());
    assert_eq!(refused.status, 500, "{}", refused.text());
}
