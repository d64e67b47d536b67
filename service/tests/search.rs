//! Search by what programs say and do, over both stores.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use ncc_service::{Limits, Part};

use crate::client::{PROGRAM, Server, place};
use crate::programs::new;

/// Three holes with two tools, in comments' words.
const HOLES: &str = "%\nO0012 (COVER PLATE)\nG21 G90 G17 G54\n(ROUGH THE SLOT)\nT3 M06\nS1200 M03\nG00 X10. Y20. Z5.\n\
                     G01 Z-4.5 F100.\nG01 X60. F300.\nN100 (DRILL 6.8 THE HOLES)\nT12 M06\nS900 M03\nG00 X20. Y10. Z5.\n\
                     G81 X20. Y10. Z-8. R2. F80.\nX30.\nX40.\nG80\nM30\n%\n";

/// Waits until no program waits for its facts.
pub(crate) fn settled(server: &Server) {
    let begun = Instant::now();
    while server.get("/api/v1/search?limit=1").json()["waiting"] != 0 {
        assert!(begun.elapsed() < Duration::from_secs(60), "facts are not computed");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Names of what is found, once the facts of all are there.
fn found(server: &Server, query: &str) -> Vec<String> {
    let answer = server.get(&format!("/api/v1/search?{query}"));
    assert_eq!(answer.status, 200, "{query}: {}", answer.text());
    let programs = answer.json()["programs"].as_array().expect("a list").clone();
    programs.iter().map(|of| of["name"].as_str().expect("a name").to_owned()).collect()
}

pub(crate) fn facts(server: &Server, id: &str) -> Value {
    settled(server);
    server.get(&format!("/api/v1/programs/{id}/facts")).json()
}

fn put(server: &Server, id: &str, text: &str) -> u16 {
    server.program("PUT", &format!("/api/v1/programs/{id}/text"), text).status
}

#[test]
fn a_program_has_the_facts_of_its_execution() {
    let server = Server::all();
    let id = new(&server, "name=holes.nc&dialect=fanuc", HOLES);
    let facts = facts(&server, &id);
    let own = &facts["facts"];
    assert_eq!((&facts["up_to_date"], &own["refused"]), (&json!(true), &json!(false)), "{facts}");
    assert_eq!(own["tools"], json!([3, 12]));
    let codes = ["G0", "G1", "G17", "G21", "G54", "G80", "G81", "G90", "M3", "M30", "M6"];
    assert_eq!((&own["codes"], &own["cycles"]), (&json!(codes), &json!(["G81"])));
    // Depths by hand: the slot at -4.5, the holes at -8.
    assert_eq!(own["extents"], json!({ "x": [10.0, 60.0], "y": [10.0, 20.0], "z": [-8.0, 5.0] }), "{own}");
    assert_eq!((&own["depth"], &own["holes"]), (&json!(8.0), &json!(3)));
    // 9.5 mm at 100, 50 mm at 300, three holes of 10 mm at 80 mm/min.
    let cutting = own["cutting_seconds"].as_f64().expect("a time");
    assert!((cutting - 60.0 * (9.5 / 100.0 + 50.0 / 300.0 + 30.0 / 80.0)).abs() < 0.01, "{own}");
    let summary = server.get(&format!("/api/v1/programs/{id}/outputs/summary")).json();
    assert_eq!(own["seconds"], summary["programs"][0]["total"]["time"]);
    // Without a machine the time rests on many assumptions, which go with it.
    let assumed = &summary["programs"][0]["assumed"];
    assert!(assumed.as_array().is_some_and(|all| all.len() > 1) && own["assumed"] == *assumed, "{own}");
    let line = facts["line"].as_str().expect("a line");
    assert!(line.starts_with("T3 T12, 0:00:") && line.contains("X 10…60, Y 10…20, Z -8…5, "), "{line}");
}

#[test]
fn programs_are_found_by_what_they_say_and_do() {
    let server = Server::all();
    new(&server, "name=holes.nc&folder=a&dialect=fanuc&tag=plate&machine=fanuc-vmc", HOLES);
    new(&server, "name=small.cn&folder=a/b&dialect=mach9&tag=plate&tag=Prototyp", PROGRAM);
    new(
        &server,
        "name=B%C3%BCgel_7.nc&folder=a-b&dialect=fanuc",
        "G21 G90\nG0 X0 Y0 Z0\nG1 X400. F1000 (SLOT)\nM30\n",
    );
    new(&server, "name=wrong.nc&folder=c&dialect=fanuc", "(SLOT)\nG21\nG1 X5. F100.\nG987 X1.\nM30\n");
    settled(&server);
    for (query, names) in [
        ("", &["holes.nc", "Bügel_7.nc", "small.cn", "wrong.nc"][..]),
        ("text=slot", &["holes.nc", "Bügel_7.nc", "wrong.nc"]),
        ("text=SLOT+rough", &["holes.nc"]),
        ("text=slot+none", &[]),
        ("text=slo*", &["holes.nc", "Bügel_7.nc", "wrong.nc"]),
        ("text=pla*", &["holes.nc", "small.cn"]),
        ("text=b%C3%BCgel_7", &["Bügel_7.nc"]),
        ("text=6.8", &["holes.nc"]),
        ("text=m06", &["holes.nc", "small.cn"]),
        ("text=prototyp", &["small.cn"]),
        ("tag=plate", &["holes.nc", "small.cn"]),
        ("tag=plate&tag=Prototyp", &["small.cn"]),
        ("under=a", &["holes.nc", "small.cn"]),
        ("folder=a", &["holes.nc"]),
        ("under=a&text=slot", &["holes.nc"]),
        ("dialect=fanuc", &["holes.nc", "Bügel_7.nc", "wrong.nc"]),
        ("machine=fanuc-vmc", &["holes.nc"]),
        ("tool=T3", &["holes.nc"]),
        ("tool=1", &["small.cn"]),
        ("tool=3&tool=T12", &["holes.nc"]),
        ("tool=3&tool=1", &[]),
        ("code=g81", &["holes.nc"]),
        ("code=G01&code=M06", &["holes.nc", "small.cn"]),
        ("code=G1&code=G987", &["wrong.nc"]),
        ("time_max=20", &["small.cn"]),
        ("time_min=20&time_max=30", &["Bügel_7.nc"]),
        ("time_min=20", &["holes.nc", "Bügel_7.nc"]),
        ("x_max=60", &["holes.nc", "small.cn"]),
        ("x_max=59.999", &["small.cn"]),
        ("z_min=-8&code=G81", &["holes.nc"]),
        ("z_min=-7.9&code=G81", &[]),
        ("fits=X50,Y10,Z13", &["holes.nc", "small.cn"]),
        ("fits=X49.9,Y10,Z13", &["small.cn"]),
        ("fits=X500", &["holes.nc", "Bügel_7.nc", "small.cn"]),
        ("refused=true", &["wrong.nc"]),
        ("refused=false&text=slot", &["holes.nc", "Bügel_7.nc"]),
        ("state=draft", &[]),
        ("stale=true", &[]),
    ] {
        assert_eq!(found(&server, query), names, "{query}");
    }
    for wrong in ["text=*", "colour=red", "tool=x", "fits=3", "time_min=nan", "state=new", "under=../a"] {
        assert_eq!(server.get(&format!("/api/v1/search?{wrong}")).status, 400, "{wrong}");
    }
    let (mut all, mut query) = (Vec::new(), "limit=1".to_owned());
    loop {
        let page = server.get(&format!("/api/v1/search?text=slot&{query}")).json();
        all.extend(page["programs"].as_array().expect("a list").iter().map(|of| of["name"].clone()));
        let Some(next) = page["next"].as_str() else { break };
        query = format!("limit=1&after={next}");
    }
    assert_eq!(all, ["holes.nc", "Bügel_7.nc", "wrong.nc"]);
}

#[test]
fn a_hit_says_where() {
    let server = Server::all();
    new(&server, "name=holes.nc&dialect=fanuc", HOLES);
    // A line in the second piece of its text.
    let long = format!("{}N77 (CHAMFER)\r\nM30\n", format!("({})\n", "-".repeat(997)).repeat(1100));
    new(&server, "name=long.nc&dialect=fanuc", &long);
    let wrong = new(&server, "name=wrong.nc&dialect=fanuc", "G21\nG1 X5. F100.\nG987 X1.\nM30\n");
    settled(&server);
    let hit =
        |text: &str| server.get(&format!("/api/v1/search?text={text}")).json()["programs"][0]["hit"].clone();
    assert_eq!(hit("drill"), json!({ "line": 10, "block": "N100", "text": "N100 (DRILL 6.8 THE HOLES)" }));
    assert_eq!(hit("dri*"), hit("drill"));
    assert_eq!(hit("t12"), json!({ "line": 11, "block": null, "text": "T12 M06" }));
    assert_eq!(hit("chamfer"), json!({ "line": 1101, "block": "N77", "text": "N77 (CHAMFER)" }));
    // A name is in no line.
    assert_eq!(hit("wrong"), json!(null));
    let facts = server.get(&format!("/api/v1/programs/{wrong}/facts")).json();
    assert_eq!(
        (&facts["facts"]["refused"], &facts["facts"]["code"]),
        (&json!(true), &json!("NC0201")),
        "{facts}"
    );
    assert_eq!(facts["facts"]["codes"], json!(["G1", "G21", "G987", "M30"]));
    assert!(facts["line"].as_str().is_some_and(|line| line.starts_with("not executed: ")), "{facts}");
}

#[test]
fn facts_follow_each_change() {
    let server = Server::all();
    let main = "%\nO1\nG21 G90 G54\nG0 X1.\nM98 P2001\nM30\n%\n";
    let caller = new(&server, "name=main.nc&folder=f&dialect=fanuc", main);
    let code = |id: &str| facts(&server, id)["facts"]["code"].clone();
    assert_eq!(code(&caller), "NC0217");
    // The program that it calls comes into its folder, changes, moves away.
    let called = new(&server, "name=O2001&folder=f&dialect=fanuc", "%\nO2001\nG1 Y10. F600.\nM99\n%\n");
    let seconds = |id: &str| Some(facts(&server, id)["facts"]["seconds"].as_f64()?.floor());
    assert_eq!(seconds(&caller), Some(1.0));
    assert_eq!(found(&server, "calls=O2001"), ["main.nc"]);
    assert_eq!(put(&server, &called, "%\nO2001\nG1 Y20. F600.\nM99\n%\n"), 200);
    assert_eq!(seconds(&caller), Some(2.0));
    let patch = |id: &str, change: Value| {
        server.json("PATCH", &format!("/api/v1/programs/{id}"), change.to_string().as_bytes()).status
    };
    assert_eq!(patch(&called, json!({ "folder": "g" })), 200);
    assert_eq!((seconds(&caller), code(&caller)), (None, json!("NC0217")));
    assert_eq!(
        (found(&server, "under=f"), found(&server, "under=g")),
        (vec!["main.nc".into()], vec!["O2001".into()])
    );
    // A change of the details, of the text, of the machine.
    assert_eq!(patch(&caller, json!({ "tags": ["new"], "machine": "own" })), 200);
    assert_eq!(patch(&called, json!({ "folder": "f" })), 200);
    let own = facts(&server, &caller);
    assert!(own["facts"]["reason"].as_str().is_some_and(|why| why.contains("no machine `own`")), "{own}");
    let machine = |more: &str| {
        let text = format!("id = \"own\"\ntitle = \"Own\"\ndialect = \"fanuc\"\n{more}");
        let toml = [("Content-Type", "application/toml")];
        server.ask("PUT", "/api/v1/machines/own", &toml, text.as_bytes()).status
    };
    assert_eq!(machine(""), 201);
    let before = seconds(&caller).expect("a time");
    assert_eq!(machine("[rates]\nrapid = 1\n"), 204);
    assert!(seconds(&caller).is_some_and(|after| after > before + 1.0), "{before}");
    assert_eq!(server.delete("/api/v1/machines/own").status, 204);
    assert_eq!(facts(&server, &caller)["facts"]["refused"], true);
    assert_eq!(found(&server, "tag=new"), ["main.nc"]);
    assert_eq!(server.delete(&format!("/api/v1/programs/{caller}")).status, 200);
    settled(&server);
    assert_eq!(found(&server, ""), ["O2001"]);
    assert_eq!(server.get(&format!("/api/v1/programs/{caller}/facts")).status, 404);
    assert_eq!(
        server.ask("POST", &format!("/api/v1/programs/{caller}/revisions/1/restore"), &[], b"").status,
        201
    );
    assert_eq!(seconds(&caller), Some(2.0));
}

#[test]
fn stale_translations_are_found() {
    let server = Server::all();
    let id = new(&server, "name=part.cn&dialect=mach9", PROGRAM);
    let machine = |more: &str| {
        let text = format!("id = \"new_mill\"\ntitle = \"New\"\ndialect = \"fanuc\"\n{more}");
        let toml = [("Content-Type", "application/toml")];
        assert!(server.ask("PUT", "/api/v1/machines/new_mill", &toml, text.as_bytes()).status < 300);
        settled(&server);
    };
    machine("");
    let asked = json!({ "program": id, "machine_to": "new_mill" });
    let made = server.json("POST", "/api/v1/translations", asked.to_string().as_bytes());
    assert_eq!(made.status, 201, "{}", made.text());
    for state in ["in-review", "approved", "released"] {
        let path = format!("/api/v1/translations/{}/states", made.json()["id"].as_str().expect("a name"));
        assert_eq!(server.json("POST", &path, json!({ "state": state }).to_string().as_bytes()).status, 200);
    }
    assert_eq!(
        (found(&server, "state=released"), found(&server, "stale=true")),
        (vec!["part.cn".into()], vec![])
    );
    machine("[rates]\nrapid = 1000\n");
    assert_eq!(found(&server, "state=released&stale=true"), ["part.cn"]);
    assert_eq!(found(&server, "stale=false"), [""; 0]);
    let page = server.get("/api/v1/search?state=released").json();
    let of = &page["programs"][0]["translations"][0];
    assert_eq!(
        of,
        &json!({ "id": made.json()["id"], "target": "new_mill", "state": "released", "stale": true })
    );
    machine("");
    assert_eq!(found(&server, "stale=true"), [""; 0]);
    // One of an earlier revision is stale from its beginning.
    assert_eq!(put(&server, &id, &format!("{PROGRAM}G0Z9.\n")), 200);
    settled(&server);
    let asked = json!({ "program": id, "revision": 1, "to": "haas" });
    assert_eq!(server.json("POST", "/api/v1/translations", asked.to_string().as_bytes()).status, 201);
    let page = server.get("/api/v1/search?state=draft").json();
    assert_eq!(page["programs"][0]["translations"][0]["stale"], true, "{page}");
}

#[test]
fn a_program_without_end_does_not_hold_up_others() {
    let server = Server::limited(Limits { work: Duration::from_millis(500), ..Limits::default() });
    let endless = "%\nO1 (ENDLESS)\nG21 G90 G54\n#1=0\nN10 #1=#1+1\nG0 X[#1 MOD 7]\nGOTO10\nM30\n%\n";
    let id = new(&server, "name=endless.nc&dialect=fanuc", endless);
    new(&server, "name=part.cn&dialect=mach9", PROGRAM);
    let facts = facts(&server, &id);
    assert!(
        facts["facts"]["reason"].as_str().is_some_and(|why| why.starts_with("it was stopped")),
        "{facts}"
    );
    assert_eq!(found(&server, "text=endless&refused=true"), ["endless.nc"]);
    assert_eq!(found(&server, "tool=1"), ["part.cn"]);
}

#[test]
fn two_servers_share_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    let part = Part::All { database: place(&folder.path().join("a.sqlite")) };
    let servers = [(); 2].map(|()| Server::of(&part, Limits::default()));
    for number in 0..20 {
        let text = format!("T{number}M6\n{PROGRAM}");
        new(&servers[number % 2], &format!("name=p{number:02}.cn&dialect=mach9"), &text);
    }
    settled(&servers[0]);
    for server in &servers {
        assert_eq!(found(server, "tool=1").len(), 20);
        assert_eq!(found(server, "tool=7"), ["p07.cn"]);
    }
}
