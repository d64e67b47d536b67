//! Dictionaries of a shop: kept with their history, and known wherever a dialect is named.

use ncc_service::{Limits, Part};
use serde_json::{Value, json};

use crate::client::{Answer, Server};
use crate::search::{facts, settled};

const PATH: &str = "/api/v1/dialects/shop";

/// A program that no built-in dialect knows: M277.
const PROGRAM: &str =
    "%\nO1\nG21 G90 G17 G40 G80 G54\nT1 M06\nG00 X0. Y0. Z5.\nS1000 M03\nM277\nG01 Z-1. F100.\nM05\nM30\n%\n";

/// A dictionary in which M277 turns on coolant.
fn dictionary(meaning: &str) -> String {
    format!(
        "id = \"shop\"\ntitle = \"Shop\"\nbase = \"fanuc\"\n[sources]\nS = \"its maker\"\n\
         [[code]]\ncode = \"M277\"\nmeans = \"{meaning}\"\nsource = \"S\"\n"
    )
}

fn put(server: &Server, path: &str, text: &str) -> Answer {
    server.ask("PUT", path, &[("Content-Type", "application/toml")], text.as_bytes())
}

/// A server with the dictionary.
fn with_shop() -> Server {
    let server = Server::all();
    let made = put(&server, PATH, &dictionary("FLOOD_ON"));
    assert_eq!((made.status, made.header("location")), (201, PATH), "{}", made.text());
    server
}

/// The id of a new program.
fn program(server: &Server, query: &str, text: &str) -> String {
    let made = server.program("POST", &format!("/api/v1/programs?{query}"), text);
    assert_eq!(made.status, 201, "{}", made.text());
    made.json()["id"].as_str().expect("an id").to_owned()
}

/// The address of a new translation.
fn translated(server: &Server, asked: &Value) -> String {
    let made = server.json("POST", "/api/v1/translations", asked.to_string().as_bytes());
    assert_eq!(made.status, 201, "{}", made.text());
    made.header("location").to_owned()
}

fn stale(server: &Server, place: &str) -> Value {
    server.get(place).json()["stale"].clone()
}

#[test]
fn dialects_are_listed_and_read() {
    let server = with_shop();
    let all = server.get("/api/v1/dialects").json();
    let all = all["dialects"].as_array().expect("dialects").clone();
    let of = |name: &str| all.iter().find(|own| own["name"] == name).cloned().unwrap_or_default();
    let own = json!({ "name": "shop", "ships_with_ncc": false, "title": "Shop", "base": "fanuc", "is_faulty": false });
    assert_eq!(of("shop"), own);
    assert_eq!([&of("fanuc")["ships_with_ncc"], &of("haas")["is_faulty"]], [true, false]);
    assert_eq!(all.len(), ncc_dialects::builtin_ids().count() + 1);
    let read = server.get(PATH);
    assert_eq!((read.status, read.text()), (200, dictionary("FLOOD_ON")));
    assert_eq!(read.header("content-type"), "application/toml");
    let shipped = server.get("/api/v1/dialects/fanuc");
    assert_eq!(shipped.status, 200);
    assert!(shipped.text().contains("\nid = \"fanuc\"\n"), "{:.200}", shipped.text());
    assert_eq!(server.get("/api/v1/dialects/none").status, 404);
}

#[test]
fn nothing_of_a_dictionary_is_overwritten() {
    let server = with_shop();
    assert_eq!(put(&server, PATH, &dictionary("MIST_ON")).status, 204);
    assert_eq!(server.delete(PATH).status, 204);
    assert_eq!(server.get(PATH).status, 404);
    let revisions = server.get(&format!("{PATH}/revisions")).json();
    let revisions: Vec<_> = revisions["revisions"]
        .as_array()
        .expect("revisions")
        .iter()
        .map(|own| json!([own["number"], own["deleted"], own["author"]]))
        .collect();
    assert_eq!(revisions, [json!([3, true, "ana"]), json!([2, false, "ana"]), json!([1, false, "ana"])]);
    assert_eq!(server.get(&format!("{PATH}/revisions/1")).text(), dictionary("FLOOD_ON"));
    let restored = server.ask("POST", &format!("{PATH}/revisions/1/restore"), &[], b"");
    assert_eq!(restored.status, 201, "{}", restored.text());
    assert_eq!(server.get(PATH).text(), dictionary("FLOOD_ON"));
    let audit = server.get("/api/v1/audit").text();
    for act in ["dialect.put", "dialect.delete"] {
        assert!(audit.contains(act), "{act}: {audit}");
    }
}

/// The text of the program means what its dictionary says, and the translation says so in all its parts.
#[test]
fn a_program_is_translated_from_a_dialect_of_the_shop() {
    let server = with_shop();
    let refused = server.program("POST", "/api/v1/programs?name=a.nc&dialect=stop", PROGRAM);
    assert_eq!(refused.status, 400, "{}", refused.text());
    assert!(refused.text().contains("grbl") && refused.text().contains("shop"), "{}", refused.text());
    let own = program(&server, "name=a.nc&dialect=haas", PROGRAM);
    for (dialect, status) in [("stop", 400), ("shop", 200)] {
        let patch = json!({ "dialect": dialect }).to_string();
        let answer = server.json("PATCH", &format!("/api/v1/programs/{own}"), patch.as_bytes());
        assert_eq!(answer.status, status, "{dialect}: {}", answer.text());
    }
    let place = translated(&server, &json!({ "program": own, "to": "haas" }));
    let output = server.get(&format!("{place}/output")).text();
    assert!(output.contains("M08") && !output.contains("M277"), "{output}");
    let report = server.get(&format!("{place}/report")).json();
    assert_eq!(report["source"]["dialect"], "shop");
    let certificate = server.get(&format!("{place}/certificate")).json();
    let names: Vec<_> = certificate["dictionaries"]
        .as_array()
        .expect("dictionaries")
        .iter()
        .map(|own| json!([own["name"], own["file"]]))
        .collect();
    assert_eq!(names, [json!(["shop", "dialect shop"]), json!(["fanuc", null]), json!(["haas", null])]);
    // And into it.
    let other = program(&server, "name=b.nc&dialect=haas", &PROGRAM.replace("M277", "M08"));
    let place = translated(&server, &json!({ "program": other, "to": "shop" }));
    assert_eq!(server.get(&format!("{place}/report")).json()["target"]["dialect"], "shop");
    // A program that names no dialect is never taken for one of the shop.
    let unnamed = program(&server, "name=c.nc", PROGRAM);
    let asked = json!({ "program": unnamed, "to": "haas" }).to_string();
    let refused = server.json("POST", "/api/v1/translations", asked.as_bytes());
    assert_eq!(refused.status, 400, "{}", refused.text());
    assert!(refused.text().contains("the dialect of c.nc is not certain"), "{}", refused.text());
}

#[test]
fn a_changed_dictionary_makes_a_translation_stale() {
    let server = with_shop();
    let own = program(&server, "name=a.nc&dialect=shop", PROGRAM);
    let place = translated(&server, &json!({ "program": own, "to": "linuxcnc" }));
    assert_eq!(stale(&server, &place), json!([]));
    assert_eq!(put(&server, PATH, &dictionary("MIST_ON")).status, 204);
    assert_eq!(stale(&server, &place), json!(["dialect"]));
    let again = translated(&server, &json!({ "program": own, "to": "linuxcnc" }));
    assert_ne!(again, place);
    assert!(server.get(&format!("{again}/output")).text().contains("M7"));
    assert_eq!(server.ask("POST", &format!("{PATH}/revisions/1/restore"), &[], b"").status, 201);
    assert_eq!(stale(&server, &place), json!([]));
    assert_eq!(server.delete(PATH).status, 204);
    assert_eq!(stale(&server, &place), json!(["dialect"]));
}

/// A profile may name a dialect of the shop; both are then inputs of a translation.
#[test]
fn a_machine_is_in_a_dialect_of_the_shop() {
    let server = with_shop();
    let profile = "id = \"mill\"\ntitle = \"Mill\"\ndialect = \"shop\"\n";
    let machine = put(&server, "/api/v1/machines/mill", profile);
    assert_eq!(machine.status, 201, "{}", machine.text());
    let own = program(&server, "name=a.nc&machine=mill", PROGRAM);
    let place = translated(&server, &json!({ "program": own, "to": "haas" }));
    assert_eq!(server.get(&format!("{place}/report")).json()["source"]["dialect"], "shop");
    put(&server, PATH, &dictionary("MIST_ON"));
    assert_eq!(stale(&server, &place), json!(["dialect"]));
    let kept = server.delete(PATH);
    assert_eq!(kept.status, 409, "{}", kept.text());
    assert!(kept.text().contains("machine `mill` cannot be read without it"), "{}", kept.text());
    assert_eq!(server.delete("/api/v1/machines/mill").status, 204);
    assert_eq!(server.delete(PATH).status, 204);
    // Its profile cannot come back before the dialect.
    let refused = server.ask("POST", "/api/v1/machines/mill/revisions/1/restore", &[], b"");
    assert_eq!(refused.status, 422, "{}", refused.text());
}

#[test]
fn dictionaries_build_on_each_other() {
    let server = with_shop();
    let over = "id = \"cell\"\ntitle = \"Cell\"\nbase = \"shop\"\n";
    let early =
        put(&server, "/api/v1/dialects/early", &over.replace("cell", "early").replace("shop", "none"));
    assert_eq!(early.status, 422, "{}", early.text());
    assert_eq!(put(&server, "/api/v1/dialects/cell", over).status, 201);
    let own = program(&server, "name=a.nc&dialect=cell", PROGRAM);
    let place = translated(&server, &json!({ "program": own, "to": "haas" }));
    put(&server, PATH, &dictionary("MIST_ON"));
    assert_eq!(stale(&server, &place), json!(["dialect"]));
    let kept = server.delete(PATH);
    assert_eq!(kept.status, 409, "{}", kept.text());
    assert!(kept.text().contains("`cell`"), "{}", kept.text());
    // A dictionary on itself, over others.
    let circle = put(&server, PATH, &dictionary("MIST_ON").replace("fanuc", "cell"));
    assert_eq!(circle.status, 422, "{}", circle.text());
    // A row that the other one takes out has to stay.
    let without = format!("{over}[[code]]\ncode = \"M277\"\nremove = true\n");
    assert_eq!(put(&server, "/api/v1/dialects/cell", &without).status, 204);
    let bare = put(&server, PATH, "id = \"shop\"\ntitle = \"Shop\"\nbase = \"fanuc\"\n");
    assert_eq!(bare.status, 422, "{}", bare.text());
    assert!(bare.text().contains("the dialect `cell`"), "{}", bare.text());
}

/// The fault of a dictionary is reported at its place, as on the command line.
#[test]
fn a_faulty_dictionary_is_refused() {
    let server = with_shop();
    let wrong = put(&server, PATH, &dictionary("FLOD_ON"));
    assert_eq!(wrong.status, 422, "{}", wrong.text());
    let found = wrong.json()["diagnostics"][0].clone();
    assert_eq!(found["message"], "no meaning: FLOD_ON");
    assert_eq!(found["place"], json!({ "file": "dialect shop", "line": 8, "column": 9 }));
    assert_eq!(found["advice"], json!(["did you mean `FLOOD_ON`?"]));
    for (path, text, status) in [
        ("fanuc", "id = \"fanuc\"\ntitle = \"\"\n", 409),
        ("auto", "id = \"auto\"\ntitle = \"\"\nbase = \"fanuc\"\n", 422),
        ("other", &*dictionary("FLOOD_ON").replace("id = \"shop\"", "id = \"third\""), 422),
        ("a%20b", "id = \"a b\"\ntitle = \"\"\nbase = \"fanuc\"\n", 422),
        ("empty", "", 422),
    ] {
        let answer = put(&server, &format!("/api/v1/dialects/{path}"), text);
        assert_eq!(answer.status, status, "{path}: {}", answer.text());
    }
    let json = server.json("PUT", PATH, b"{}");
    assert_eq!(json.status, 415, "{}", json.text());
    assert_eq!(server.get(PATH).text(), dictionary("FLOOD_ON"), "the one before stays");
}

/// All addresses that execute a program know its dialect, and so do the services by themselves and the studio.
#[test]
fn a_dialect_of_the_shop_is_known_everywhere() {
    let server = with_shop();
    let own = program(&server, "name=a.nc&dialect=shop", PROGRAM);
    for output in [
        "outputs/summary",
        "outputs/tools",
        "outputs/operations",
        "outputs/chart",
        "outputs/sheet",
        "comparison?from=1&to=1",
    ] {
        let made = server.get(&format!("/api/v1/programs/{own}/{output}"));
        assert_eq!(made.status, 200, "{output}: {}", made.text());
    }
    let processed = server.program("POST", "/transpiler/a.nc?dialect=shop", PROGRAM);
    assert_eq!(processed.status, 201, "{}", processed.text());
    for address in ["/persistence/a.nc", "/persistence/a.nc?form=printed", "/transpiler/a.nc"] {
        let payload = server.get(address);
        assert_eq!(payload.status, 200, "{address}: {}", payload.text());
    }
    let persistence = format!("http://{}", server.address);
    let alone = Server::of(&Part::Transpiler { persistence }, Limits::default());
    let processed = alone.program("POST", "/transpiler/b.nc?dialect=shop", PROGRAM);
    assert_eq!(processed.status, 201, "{}", processed.text());
    assert_eq!(server.ask("PUT", "/api/v1/engine/r", &[], b"").status, 204);
    assert_eq!(server.ask("PUT", "/api/v1/engine/r/files/a.nc", &[], PROGRAM.as_bytes()).status, 204);
    let run = |request: &str| server.json("POST", "/api/v1/engine/r/run", request.as_bytes()).text();
    assert!(run(r#"{ "verb": "dialects" }"#).contains("\"shop\""));
    let checked = run(r#"{ "verb": "check", "file": "a.nc", "from": "shop" }"#);
    assert!(checked.contains("\"dialect\": \"shop\"") && !checked.contains("NC0201"), "{checked}");
}

/// Facts of a program are those of its dictionary as it is now, in whatever way the program comes to it.
#[test]
fn facts_follow_a_dictionary() {
    let server = with_shop();
    put(&server, "/api/v1/dialects/cell", "id = \"cell\"\ntitle = \"Cell\"\nbase = \"shop\"\n");
    put(&server, "/api/v1/machines/mill", "id = \"mill\"\ntitle = \"Mill\"\ndialect = \"cell\"\n");
    let all = ["name=a.nc&dialect=shop", "name=b.nc&dialect=cell", "name=c.nc&machine=mill"]
        .map(|query| program(&server, query, PROGRAM));
    for (own, dialect) in all.iter().zip(["shop", "cell", "cell"]) {
        let facts = facts(&server, own)["facts"].clone();
        assert_eq!([&facts["dialect"], &facts["refused"]], [&json!(dialect), &json!(false)], "{facts}");
        assert!(facts["codes"].as_array().is_some_and(|codes| codes.contains(&json!("M277"))), "{facts}");
    }
    let refused = dictionary("FLOOD_ON").replace("means = \"FLOOD_ON\"", "refuse = \"a door\"");
    assert_eq!(put(&server, PATH, &refused).status, 204);
    for own in &all {
        assert_eq!(facts(&server, own)["facts"]["refused"], true);
    }
}

/// A translation into a dialect is found as stale, although its program does not name the dialect.
#[test]
fn a_stale_translation_into_a_dialect_of_the_shop_is_found() {
    let server = with_shop();
    let own = program(&server, "name=a.nc&dialect=haas", &PROGRAM.replace("M277", "M08"));
    translated(&server, &json!({ "program": own, "to": "shop" }));
    let found = || {
        settled(&server);
        server.get("/api/v1/search?stale=true").json()["programs"].as_array().map_or(0, Vec::len)
    };
    assert_eq!(found(), 0);
    put(&server, PATH, &dictionary("MIST_ON"));
    assert_eq!(found(), 1);
}

/// A custom function (`function_dict`) is for the command line: the dictionary is kept, and its program is never started.
#[test]
fn a_program_of_a_dictionary_is_never_started() {
    let server = Server::all();
    let folder = tempfile::tempdir().expect("a folder");
    let started = folder.path().join("started");
    let text = format!("{}[functions.G200]\ncommand = [\"touch\", {started:?}]\n", dictionary("FLOOD_ON"));
    let kept = put(&server, PATH, &text);
    assert_eq!(kept.status, 201, "{}", kept.text());
    let refused =
        server.program("POST", "/transpiler/a.nc?dialect=shop", &PROGRAM.replace("M277", "G200 X10."));
    assert_eq!(refused.status, 422, "{}", refused.text());
    assert!(refused.text().contains("NC0243"), "{}", refused.text());
    let done = server.program("POST", "/transpiler/b.nc?dialect=shop", PROGRAM);
    assert_eq!(done.status, 201, "its other codes are as good as ever: {}", done.text());
    assert!(!started.exists());
}
