//! Charts, pictures, setup sheets, times by operation, and comparisons of revisions.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::client::{Answer, PROGRAM, Server, TABLE_10};
use crate::programs::new;

/// A program with a pocket and a hole, whose comments state its tools.
const PART: &str = "(T1 END MILL D10)\nT1 M6\nM8\n(<b>ROUGH & \"FINE\"</b>)\nG21 G54 G90 G0 X0. Y0. S2000 M3\nG43 H1 Z2.\n\
                    G1 Z-3. F100.\nG1 X40. F300.\nG1 Y20.\nG0 Z50.\n(DRILL)\nT2 M6\nM8\nG55 G0 X10. Y10. S900 M3\n\
                    G43 H2 Z2.\nG1 Z-8. F80.\nG0 Z50.\nM30\n";

fn get(server: &Server, program: &str, what: &str) -> Answer {
    server.get(&format!("/api/v1/programs/{program}/{what}"))
}

fn part(server: &Server) -> String {
    new(server, "name=%3Ci%3Epart.nc&dialect=fanuc&machine=fanuc-vmc&message=%3Cscript%3E", PART)
}

#[test]
fn operations_are_csv_and_json() {
    let server = Server::all();
    let program = part(&server);
    let made = get(&server, &program, "outputs/operations");
    assert_eq!((made.status, made.header("content-type")), (200, "application/json"), "{}", made.text());
    let document = made.json();
    let operations = document["operations"].as_array().expect("a list");
    let tools: Vec<&Value> = operations.iter().map(|own| &own["tool"]).collect();
    assert_eq!(tools, [&json!(1), &json!(1), &json!(2)], "{document}");
    assert_eq!((&operations[2]["operation"], &operations[2]["line"]), (&json!("DRILL"), &json!(11)));
    assert_eq!((&operations[1]["feed_min"], &operations[1]["feed_max"]), (&json!(100.0), &json!(300.0)));
    assert_eq!((&document["revision"], &document["machine"]), (&json!(1), &json!("fanuc-vmc")));
    // All time belongs to an operation.
    let sum: f64 = operations.iter().filter_map(|own| own["time"].as_f64()).sum();
    assert!((sum - document["total"]["time"].as_f64().expect("a time")).abs() < 1e-5, "{document}");
    let table = get(&server, &program, "outputs/operations?form=csv");
    assert_eq!(table.header("content-type"), "text/csv; charset=utf-8; header=present");
    assert_ne!(table.header("etag"), made.header("etag"));
    let text = table.text();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 4, "{text}");
    assert!(lines[0].starts_with(
        "program,revision,sha256,dialect,machine,model,position,operation,tool,line,start,time,"
    ));
    assert!(
        lines[2].starts_with("<i>part.nc,1,") && lines[2].contains(",\"<b>ROUGH & \"\"FINE\"\"</b>\",1,"),
        "{text}"
    );
    assert!(lines.iter().all(|line| !line.is_empty()) && text.ends_with("\r\n"));
    // The times rest on the same as those of the JSON.
    let assumed = document["assumed"].as_array().expect("a list");
    let assumed: Vec<&str> = assumed.iter().filter_map(Value::as_str).collect();
    assert!(!assumed.is_empty() && lines[0].ends_with(",assumed"), "{text}");
    assert!(lines[1..].iter().all(|line| line.contains(&assumed.join("; "))), "{text}");
    assert_eq!(get(&server, &program, "outputs/operations?form=xml").status, 400);
}

#[test]
fn charts_and_pictures_are_those_of_the_command_line() {
    let server = Server::all();
    let program = part(&server);
    let chart = get(&server, &program, "outputs/chart?chart=feed,speed");
    assert_eq!((chart.status, chart.header("content-type")), (200, "image/svg+xml"), "{}", chart.text());
    assert!(chart.text().starts_with("<svg ") && !chart.text().contains("<i>part"), "names are text");
    assert!(
        get(&server, &program, "outputs/chart").body.len() > chart.body.len(),
        "all charts are more than two"
    );
    let policy = chart.header("content-security-policy");
    assert!(
        policy.contains("style-src 'unsafe-inline'") && policy.starts_with("default-src 'none'"),
        "{policy}"
    );
    let svg = get(&server, &program, "outputs/picture?cells=64");
    assert_eq!((svg.status, svg.header("content-type")), (200, "image/svg+xml"), "{}", svg.text());
    assert!(svg.text().contains("data:image/png;base64,") && !svg.text().contains("<i>"));
    let png = get(&server, &program, "outputs/picture?form=png&view=plan&cells=64");
    assert_eq!((png.status, png.header("content-type")), (200, "image/png"));
    assert!(png.body.starts_with(b"\x89PNG"));
    let larger = get(
        &server,
        &program,
        "outputs/picture?form=png&view=plan&cells=64&stock=X-50:90%20Y-50:70%20Z-20:0",
    );
    assert!(larger.status == 200 && larger.body != png.body, "another raw part is another picture");
    for (what, status) in [
        ("chart?chart=colour", 400),
        ("chart?cells=64", 400),
        ("picture?cells=15", 400),
        ("picture?cells=2049", 400),
        ("picture?model=ideal", 400),
        ("picture?view=plan", 400),
        ("picture?form=png&view=below", 400),
        ("picture?tool=nonsense", 400),
        // A body is stated; no file of the server is one.
        ("picture?stock=/etc/hostname", 404),
    ] {
        let answer = get(&server, &program, &format!("outputs/{what}"));
        assert!(
            answer.status == status || status == 404 && matches!(answer.status, 400 | 422),
            "{what}: {} {}",
            answer.status,
            answer.text()
        );
    }
}

#[test]
fn a_sheet_has_what_is_set_up_and_marks_each_guess() {
    let server = Server::all();
    let program = part(&server);
    let made = server.json(
        "POST",
        "/api/v1/translations",
        json!({ "program": program, "to": "haas" }).to_string().as_bytes(),
    );
    assert_eq!(made.status, 201, "{}", made.text());
    let sheet = get(&server, &program, "outputs/sheet?cells=64");
    assert_eq!(
        (sheet.status, sheet.header("content-type")),
        (200, "text/html; charset=utf-8"),
        "{}",
        sheet.text()
    );
    assert!(sheet.header("content-security-policy").contains("default-src 'none'"));
    let text = sheet.text();
    let of = server.get(&format!("/api/v1/programs/{program}")).json();
    let sha256 = of["sha256"].as_str().expect("a digest");
    assert!(text.contains(sha256), "{sha256}");
    for wanted in [
        "&lt;i&gt;part.nc, revision 1",
        "&lt;script&gt;",
        "&lt;b&gt;ROUGH &amp; &quot;FINE&quot;&lt;/b&gt;",
        "<b>T1</b>",
        "<b>T2</b>",
        "flood",
        "G54, G55",
        "X 0 … 40",
        "haas: draft, of revision 1",
        "@page{size:A4",
        "<figure><svg ",
        "<mark>guess</mark>",
        "ana, 2",
    ] {
        assert!(text.contains(wanted), "{wanted} is not in\n{text}");
    }
    for never in ["<script", "<i>part", "<b>ROUGH", "src=\"http", "javascript:"] {
        assert!(!text.contains(never), "{never}");
    }
    let stated = get(
        &server,
        &program,
        "outputs/sheet?cells=64&stock=X-10:50%20Y-10:30%20Z-20:0&tool=1=flat,10&tool=2=drill,6.8,angle=118",
    );
    assert_eq!(stated.status, 200, "{}", stated.text());
    // The mark is explained at the end, and marks nothing else.
    assert_eq!(stated.text().matches("<mark>guess</mark>").count(), 1, "{}", stated.text());
    assert!(stated.text().contains("⌀ 6.8 <small>stated</small>"));
    // A machine of times alone cuts no part, and the sheet says so.
    assert_eq!(server.json("PUT", "/api/v1/machines/romi", TABLE_10.as_bytes()).status, 201);
    let plain = new(&server, "name=plain.cn&dialect=mach9&machine=romi", PROGRAM);
    let plain = get(&server, &plain, "outputs/sheet");
    assert!(plain.status == 200 && plain.text().contains("The part was not cut: "), "{}", plain.text());
    assert_eq!(get(&server, &program, "outputs/sheet?dialect=canon").status, 422);
}

fn change(server: &Server, program: &str, text: &str) {
    let answer = server.program("PUT", &format!("/api/v1/programs/{program}/text"), text);
    assert_eq!(answer.status, 200, "{}", answer.text());
}

#[test]
fn revisions_are_compared_by_their_motion() {
    let server = Server::all();
    let program = part(&server);
    assert_eq!(get(&server, &program, "comparison").status, 404, "a first revision has none before it");
    change(&server, &program, &PART.replace("X40.", "X41."));
    change(&server, &program, &PART.replace("X40.", "X41.").replace("G1 Y20.", "G01 Y20.0"));
    let last = get(&server, &program, "comparison").json();
    assert_eq!((&last["equal"], &last["level"]), (&json!(true), &json!("motion")), "{last}");
    let first = get(&server, &program, "comparison?from=1&to=2");
    let document = first.json();
    assert_eq!((document["equal"].clone(), first.status), (json!(false), 200), "{document}");
    assert_eq!(document["a"]["name"], "<i>part.nc (revision 1)");
    assert_eq!(document["differences"][0]["a"][0]["line"], 8, "{document}");
    assert_eq!(get(&server, &program, "comparison?from=1&to=2&tolerance=2").json()["equal"], true);
    let page = get(&server, &program, "comparison?from=1&form=html");
    assert_eq!((page.status, page.header("content-type")), (200, "text/html; charset=utf-8"));
    let policy = page.header("content-security-policy");
    assert!(
        policy.starts_with("default-src 'none'; style-src 'unsafe-inline';") && !policy.contains("img-src"),
        "{policy}"
    );
    assert!(
        page.text().contains("&lt;i&gt;part.nc")
            && !page.text().contains("<i>")
            && !page.text().contains("<script")
    );
    let again = [("If-None-Match", page.header("etag"))];
    let target = format!("/api/v1/programs/{program}/comparison?from=1&form=html");
    assert_eq!(server.ask("GET", &target, &again, b"").status, 304);
    // The same name in another folder, in another dialect's words.
    let other = new(&server, "name=%3Ci%3Epart.nc&folder=f&dialect=haas&machine=haas-vf2", PART);
    let between = get(&server, &program, &format!("comparison?from=1&other={other}")).json();
    assert_eq!(between["b"]["dialect"], "haas", "{between}");
    for (query, status) in [
        ("from=9", 404),
        ("to=9", 404),
        ("other=nobody", 404),
        ("from=x", 400),
        ("form=pdf", 400),
        ("tolerance=wide", 400),
        ("colour=red", 400),
        ("dialect=canon", 422),
    ] {
        assert_eq!(get(&server, &program, &format!("comparison?{query}")).status, status, "{query}");
    }
}

/// The list of revisions says what each changed: not yet at first, and once it was compared in a line.
#[test]
fn the_list_of_revisions_says_what_changed() {
    let server = Server::all();
    let program = part(&server);
    change(&server, &program, &PART.replace("X40.", "X41."));
    change(&server, &program, "G99999\n");
    let tags = [("Content-Type", "application/merge-patch+json")];
    let patch = server.ask("PATCH", &format!("/api/v1/programs/{program}"), &tags, br#"{ "tags": ["new"] }"#);
    assert_eq!(patch.status, 200);
    let begun = Instant::now();
    let mut known = Vec::new();
    while begun.elapsed() < Duration::from_secs(60) {
        let list = get(&server, &program, "revisions").json();
        let all = list["revisions"].as_array().expect("a list").clone();
        assert_eq!(all.len(), 4);
        assert_eq!(all[3]["comparison"], Value::Null, "the first revision has none before it");
        for own in &all[..3] {
            let is_waiting = own["comparison"]["state"] == "waiting";
            assert_eq!(own["comparison"]["line"] == "", is_waiting, "{own}");
        }
        known = all;
        if known[..3].iter().all(|own| own["comparison"]["state"] != "waiting") {
            break;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    let states: Vec<&Value> = known[..3].iter().map(|own| &own["comparison"]["state"]).collect();
    assert_eq!(states, ["equal", "not-compared", "different"], "{known:?}");
    assert_eq!(known[0]["comparison"]["line"], "the same text");
    let said = get(&server, &program, "comparison?from=1&to=2").json()["summary"].clone();
    assert_eq!(known[2]["comparison"]["line"], said);
    let page = get(&server, &program, "revisions?limit=2").json();
    assert_eq!(page["revisions"][1]["comparison"]["state"], "not-compared");
}
