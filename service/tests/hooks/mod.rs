//! Web hooks: told once, signed, tried again, and sent to no other address.

mod receiver;

use std::time::Duration;

use ncc_service::{Hooks, Limits, Part};
use serde_json::{Value, json};

use self::receiver::{Message, Receiver, Reply};
use crate::access::tls::Pair;
use crate::access::{admin, limits, with_rights};
use crate::client::{PROGRAM, Server, here, place};
use crate::programs::new;
use crate::search::settled;

/// Limits with which nobody waits for the next attempt.
fn quick() -> Limits {
    Limits { hook: Duration::from_millis(400), hook_pauses: [Duration::ZERO; 7], ..limits() }
}

/// Limits with which the next attempt does not come while a test runs.
fn patient() -> Limits {
    Limits { hook_pauses: [Duration::from_secs(3600); 7], ..limits() }
}

/// A hook, as its maker is told of it.
fn hook(server: &Server, target: &str, events: &[&str], folder: &str) -> Value {
    let asked = json!({ "target": target, "events": events, "folder": folder }).to_string();
    let made = server.json("POST", "/api/v1/hooks", asked.as_bytes());
    assert_eq!(made.status, 201, "{}", made.text());
    let told = made.json();
    assert_eq!(made.header("location"), format!("/api/v1/hooks/{}", told["id"].as_str().expect("a name")));
    told
}

/// A job that has ended before it is answered; gives its name.
fn empty_job(server: &Server) -> String {
    let made = server.json("POST", "/api/v1/jobs", br#"{ "under": "nothing/here", "to": "haas" }"#);
    assert_eq!(made.status, 202, "{}", made.text());
    made.json()["id"].as_str().expect("a name").to_owned()
}

fn translation(server: &Server, asked: &Value, states: &[&str]) -> String {
    let made = server.json("POST", "/api/v1/translations", asked.to_string().as_bytes());
    assert_eq!(made.status, 201, "{}", made.text());
    let id = made.json()["id"].as_str().expect("a name").to_owned();
    for state in states {
        let path = format!("/api/v1/translations/{id}/states");
        let asked = json!({ "state": state, "message": "for the mill" }).to_string();
        assert_eq!(server.json("POST", &path, asked.as_bytes()).status, 200, "{state}");
    }
    id
}

fn put(server: &Server, program: &str, text: &str) {
    assert_eq!(server.program("PUT", &format!("/api/v1/programs/{program}/text"), text).status, 200);
    settled(server);
}

/// Messages up to that of a job, which is the last one.
fn until(receiver: &Receiver, job: &str) -> Vec<Message> {
    let mut all = Vec::new();
    loop {
        let next = receiver.next();
        if next.json()["data"]["job"] == job {
            return all;
        }
        all.push(next);
    }
}

/// The deliveries of a hook, the newest first.
fn deliveries(server: &Server, hook: &Value) -> Vec<Value> {
    let path = format!("/api/v1/hooks/{}/deliveries", hook["id"].as_str().expect("a name"));
    server.get(&path).json()["deliveries"].as_array().expect("a list").clone()
}

/// Waits until the last delivery of a hook is in a state.
fn last_is(server: &Server, hook: &Value, state: &str) -> Value {
    for _ in 0..3000 {
        let all = deliveries(server, hook);
        if all.first().is_some_and(|last| last["state"] == state) {
            return all[0].clone();
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("no delivery is {state}: {:?}", deliveries(server, hook));
}

#[test]
fn a_release_is_told_once() {
    let receiver = Receiver::new(|_| Reply::Status(204));
    let server = Server::telling(&[receiver.address()], limits());
    let made = hook(&server, &receiver.at("ncc"), &["release", "job"], "");
    let program = new(&server, "name=a.cn&folder=plates&dialect=mach9", PROGRAM);
    let asked = json!({ "program": program, "to": "fanuc" });
    let first = translation(&server, &asked, &["in-review", "approved", "released"]);
    put(&server, &program, &format!("{PROGRAM}G0Z9.\n"));
    let second = translation(&server, &asked, &["in-review", "approved", "released"]);
    // It is released already.
    let again =
        server.json("POST", &format!("/api/v1/translations/{second}/states"), br#"{ "state": "released" }"#);
    assert_eq!(again.status, 409);
    let all = until(&receiver, &empty_job(&server));
    assert_eq!(all.len(), 2, "{all:?}");
    for (message, id, revision, replaces) in
        [(&all[0], &first, 1, json!([])), (&all[1], &second, 2, json!([first]))]
    {
        message.is_signed_by(&made);
        assert_eq!(message.path, "/ncc");
        assert_eq!(message.header("content-type"), "application/json");
        let body = message.json();
        assert!(body["timestamp"].as_str().is_some_and(|moment| moment.ends_with('Z')), "{body}");
        let output = server.get(&format!("/api/v1/translations/{id}/output")).body;
        assert_eq!(
            (&body["type"], &body["data"]),
            (
                &json!("release"),
                &json!({
                    "translation": id,
                    "program": program,
                    "folder": "plates",
                    "name": "a.cn",
                    "revision": revision,
                    "target": "fanuc",
                    "sha256": receiver::sha256(&output),
                    "author": "ana",
                    "message": "for the mill",
                    "replaces": replaces,
                })
            )
        );
    }
    assert_ne!(all[0].header("webhook-id"), all[1].header("webhook-id"));
}

#[test]
fn what_is_used_and_becomes_stale_is_told_once() {
    let receiver = Receiver::new(|_| Reply::Status(200));
    let server = Server::telling(&[receiver.address()], limits());
    let made = hook(&server, &receiver.at(""), &["stale", "job"], "");
    let own_machine = |more: &str| {
        let text = format!("id = \"own\"\ntitle = \"Own\"\ndialect = \"fanuc\"\n{more}");
        let toml = [("Content-Type", "application/toml")];
        assert!(server.ask("PUT", "/api/v1/machines/own", &toml, text.as_bytes()).status < 300);
        settled(&server);
    };
    own_machine("");
    let main = "%\nO1\nG21 G90 G54\nG0 X1.\nM98 P2001\nM30\n%\n";
    let called = new(&server, "name=O2001&folder=f&dialect=fanuc", "%\nO2001\nG0 Y1.\nM99\n%\n");
    let program = new(&server, "name=main.nc&folder=f&dialect=fanuc", main);
    settled(&server);
    let asked = |target: &str| json!({ "program": program, "to": target, "machine_from": "own" });
    let reviewed = translation(&server, &asked("haas"), &["in-review"]);
    translation(&server, &asked("linuxcnc"), &[]);
    let told = |of: &Message| {
        of.is_signed_by(&made);
        let body = of.json();
        let data = &body["data"];
        assert_eq!(
            (&body["type"], &data["translation"], &data["program"], &data["folder"], &data["name"]),
            (&json!("stale"), &json!(reviewed), &json!(program), &json!("f"), &json!("main.nc"))
        );
        assert_eq!(
            (&data["revision"], &data["target"], &data["state"]),
            (&json!(1), &json!("haas"), &json!("in-review"))
        );
        data["changed"].clone()
    };
    let next = || {
        let all = until(&receiver, &empty_job(&server));
        all.iter().map(told).collect::<Vec<_>>()
    };
    // A tag is no input.
    let headers = [("Content-Type", "application/merge-patch+json")];
    let path = format!("/api/v1/programs/{program}");
    assert_eq!(server.ask("PATCH", &path, &headers, br#"{ "tags": ["x"] }"#).status, 200);
    settled(&server);
    assert_eq!(next(), [Value::Null; 0]);
    put(&server, &called, "%\nO2001\nG0 Y2.\nM99\n%\n");
    assert_eq!(next(), [json!(["called programs"])]);
    // It stays stale: nothing new is told.
    own_machine("[rates]\nrapid = 1000\n");
    put(&server, &program, &main.replace("X1.", "X2."));
    assert_eq!(next(), [Value::Null; 0]);
    // It holds again, and becomes stale by something else.
    put(&server, &called, "%\nO2001\nG0 Y1.\nM99\n%\n");
    put(&server, &program, main);
    own_machine("");
    assert_eq!(next(), [Value::Null; 0]);
    own_machine("[rates]\nrapid = 1000\n");
    assert_eq!(next(), [json!(["machine_from"])]);
    own_machine("");
    put(&server, &program, &main.replace("X1.", "X3."));
    assert_eq!(next(), [json!(["program"])]);
}

#[test]
fn a_job_is_told_once_at_its_end() {
    let receiver = Receiver::new(|_| Reply::Status(200));
    let server = Server::telling(&[receiver.address()], limits());
    let made = hook(&server, &receiver.at("jobs"), &["job"], "");
    for number in 1..=3 {
        new(
            &server,
            &format!("name=p{number}.cn&folder=f&dialect=mach9"),
            &format!("{PROGRAM}G0X{number}.\n"),
        );
    }
    new(&server, "name=wrong.nc&folder=f&dialect=fanuc", "%\nO1\nG21 G90\nG777\nM30\n%\n");
    let job = |asked: &Value| {
        let begun = server.json("POST", "/api/v1/jobs", asked.to_string().as_bytes());
        assert_eq!(begun.status, 202, "{}", begun.text());
        begun.json()["id"].as_str().expect("a name").to_owned()
    };
    let first = job(&json!({ "under": "f", "to": "haas" }));
    let told = receiver.next();
    told.is_signed_by(&made);
    let data = told.json()["data"].clone();
    assert_eq!(
        (&data["job"], &data["author"], &data["cancelled"], &data["tasks"]),
        (&json!(first), &json!("ana"), &json!(false), &json!({ "done": 3, "refused": 1 }))
    );
    let over = server.get(&format!("/api/v1/jobs/{first}")).json();
    assert_eq!((&data["made"], &data["ended"]), (&over["made"], &over["ended"]));
    // A job that has ended cannot be cancelled: there is no second message.
    assert_eq!(server.delete(&format!("/api/v1/jobs/{first}")).status, 200);
    let endless = "%\nO1\nG21 G90 G54\n#1=0\nN10 #1=#1+1\nG0 X[#1 MOD 7]\nGOTO10\nM30\n%\n";
    for number in 1..=2 {
        new(&server, &format!("name=long{number}.nc&tag=long&dialect=fanuc"), endless);
    }
    let second = job(&json!({ "tag": "long", "to": "haas" }));
    assert_eq!(server.delete(&format!("/api/v1/jobs/{second}")).status, 200);
    let told = receiver.next().json()["data"].clone();
    assert_eq!(
        (&told["job"], &told["cancelled"], &told["tasks"]),
        (&json!(second), &json!(true), &json!({ "cancelled": 2 }))
    );
    assert_eq!(until(&receiver, &empty_job(&server)).len(), 0);
}

#[test]
fn a_hook_of_a_folder_is_told_of_it_alone() {
    let receiver = Receiver::new(|_| Reply::Status(200));
    let server = Server::telling(&[receiver.address()], limits());
    hook(&server, &receiver.at("plates"), &["release", "job"], "plates");
    hook(&server, &receiver.at("all"), &["job"], "");
    let released = ["in-review", "approved", "released"];
    let programs: Vec<String> = ["plates/left", "plates2", "plates", ""]
        .iter()
        .map(|folder| new(&server, &format!("name=a.cn&folder={folder}&dialect=mach9"), PROGRAM))
        .collect();
    for program in &programs {
        translation(&server, &json!({ "program": program, "to": "fanuc" }), &released);
    }
    let job = |programs: &[&String]| {
        let asked = json!({ "programs": programs, "to": "haas" }).to_string();
        let id = server.json("POST", "/api/v1/jobs", asked.as_bytes()).json()["id"].clone();
        server.get(&format!("/api/v1/jobs/{}/events", id.as_str().expect("a name")));
        id
    };
    let mixed = job(&[&programs[0], &programs[1]]);
    let within = job(&[&programs[0], &programs[2]]);
    let mut told = (0..5).map(|_| receiver.next()).map(|own| {
        let data = own.json()["data"].clone();
        let subject = if data["job"].is_null() { data["program"].clone() } else { data["job"].clone() };
        format!("{} {}", own.path, subject.as_str().unwrap_or_default())
    });
    let mut told: Vec<String> = told.by_ref().collect();
    told.sort();
    let mut expected = vec![
        format!("/plates {}", programs[0]),
        format!("/plates {}", programs[2]),
        format!("/plates {}", within.as_str().unwrap_or_default()),
        format!("/all {}", mixed.as_str().unwrap_or_default()),
        format!("/all {}", within.as_str().unwrap_or_default()),
    ];
    expected.sort();
    assert_eq!(told, expected);
    assert_eq!(until(&receiver, &empty_job(&server)).len(), 0);
}

#[test]
fn a_receiver_that_fails_is_told_again() {
    let receiver = Receiver::new(|number| match number {
        0 => Reply::Status(500),
        1 => Reply::Nothing,
        2 => Reply::Close,
        3 => Reply::Redirect,
        // More than anybody reads.
        _ => Reply::Flood,
    });
    let server = Server::telling(&[receiver.address()], quick());
    let made = hook(&server, &receiver.at("a"), &["job"], "");
    empty_job(&server);
    let all: Vec<Message> = (0..5).map(|_| receiver.next()).collect();
    for message in &all {
        message.is_signed_by(&made);
        assert_eq!(
            (message.header("webhook-id"), &message.body, message.path.as_str()),
            (all[0].header("webhook-id"), &all[0].body, "/a")
        );
    }
    let ended = last_is(&server, &made, "delivered");
    assert_eq!(
        (&ended["attempts"], &ended["status"], &ended["reason"]),
        (&json!(5), &json!(200), &Value::Null)
    );
    assert!(ended["next"].is_null() && !ended["ended"].is_null(), "{ended}");
    assert_eq!(ended["id"], all[0].header("webhook-id"));
    let metrics = server.get("/metrics").text();
    for line in ["ncc_deliveries_total{end=\"failed\"} 4", "ncc_deliveries_total{end=\"delivered\"} 1"] {
        assert!(metrics.lines().any(|own| own == line), "{line} is not in\n{metrics}");
    }
}

#[test]
fn a_receiver_that_fails_for_long_is_given_up_until_somebody_asks() {
    let receiver = Receiver::new(|number| if number < 8 { Reply::Status(503) } else { Reply::Status(200) });
    let server = Server::telling(&[receiver.address()], quick());
    let made = hook(&server, &receiver.at("a"), &["job"], "");
    empty_job(&server);
    let given_up = last_is(&server, &made, "given-up");
    assert_eq!((&given_up["attempts"], &given_up["status"]), (&json!(8), &json!(503)));
    let path = format!(
        "/api/v1/hooks/{}/deliveries/{}",
        made["id"].as_str().expect("a name"),
        given_up["id"].as_str().expect("a name")
    );
    let again = server.ask("POST", &path, &[], b"");
    assert_eq!((again.status, &again.json()["state"]), (202, &json!("waiting")), "{}", again.text());
    let ended = last_is(&server, &made, "delivered");
    assert_eq!((&ended["attempts"], &ended["id"]), (&json!(1), &given_up["id"]));
    let all: Vec<Message> = (0..9).map(|_| receiver.next()).collect();
    assert!(all.iter().all(|own| own.header("webhook-id") == ended["id"]));
    assert_eq!(server.ask("POST", &path.replace("deliveries/", "deliveries/x"), &[], b"").status, 404);
}

#[test]
fn a_receiver_that_is_gone_is_told_of_nothing_more() {
    let receiver = Receiver::new(|_| Reply::Status(410));
    let other = Receiver::new(|_| Reply::Status(200));
    let server = Server::telling(&[receiver.address(), other.address()], quick());
    let made = hook(&server, &receiver.at("a"), &["job"], "");
    hook(&server, &other.at("a"), &["job"], "");
    empty_job(&server);
    receiver.next();
    let given_up = last_is(&server, &made, "given-up");
    assert_eq!((&given_up["status"], &given_up["attempts"]), (&json!(410), &json!(1)));
    let path = format!("/api/v1/hooks/{}", made["id"].as_str().expect("a name"));
    assert_eq!(server.get(&path).json()["state"], "stopped");
    let last = empty_job(&server);
    until(&other, &last);
    assert_eq!(deliveries(&server, &made).len(), 1);
    let again = format!("{path}/deliveries/{}", given_up["id"].as_str().expect("a name"));
    assert_eq!(server.ask("POST", &again, &[], b"").status, 409);
    receiver.has_no_more();
}

/// The claim of a process that was killed while it sent runs out, and another one sends.
#[test]
fn what_a_killed_process_was_sending_is_sent_again_under_the_same_name() {
    let receiver = Receiver::new(|number| if number == 0 { Reply::Status(500) } else { Reply::Status(200) });
    let server = Server::telling(&[receiver.address()], patient());
    let made = hook(&server, &receiver.at("a"), &["job"], "");
    empty_job(&server);
    let first = receiver.next();
    last_is(&server, &made, "failed");
    server
        .sql("UPDATE delivery SET state = 'sending', worker = 'a dead one', until = 1")
        .expect("as the process has left it");
    // Any change wakes the one who sends.
    new(&server, "name=a.cn&dialect=mach9", PROGRAM);
    let second = receiver.next();
    assert_eq!((first.header("webhook-id"), &first.body), (second.header("webhook-id"), &second.body));
    second.is_signed_by(&made);
    assert_eq!(last_is(&server, &made, "delivered")["attempts"], 2);
}

#[test]
fn nothing_is_sent_elsewhere() {
    let [own, other] = [(); 2].map(|()| Receiver::new(|_| Reply::Status(200)));
    let server = Server::telling(&[own.at("ncc")], limits());
    let refused = |server: &Server, target: &str| {
        let asked = json!({ "target": target, "events": ["job"] }).to_string();
        let answer = server.json("POST", "/api/v1/hooks", asked.as_bytes());
        assert_eq!(answer.status, 422, "{target}: {}", answer.text());
        assert!(answer.text().contains("--hook-target"), "{}", answer.text());
    };
    for target in [
        other.at("ncc"),
        own.at(""),
        own.at("nccx"),
        own.at("ncc/../b"),
        own.at("ncc#b"),
        own.at("ncc").replace("http:", "https:"),
        own.at("ncc").replace("127.0.0.1", "ana:secret@127.0.0.1"),
        own.at("ncc").replace("127.0.0.1", "localhost"),
    ] {
        refused(&server, &target);
    }
    refused(&Server::all(), &own.at("ncc"));
    // Of other processes that share the database, one has no targets, and one has another target.
    let folder = tempfile::tempdir().expect("a folder");
    let part = Part::All { database: place(&folder.path().join("a.sqlite")) };
    let silent = Server::of(&part, limits());
    silent
        .sql(&format!(
            "INSERT INTO hook (id, target, secret, events, folder, author, made)
             VALUES ('h', '{}', CAST('x' AS {}), 'job', '', 'ana', 0)",
            own.at("ncc"),
            if std::env::var("NCC_TEST_POSTGRES").is_ok() { "BYTEA" } else { "BLOB" }
        ))
        .expect("a hook of before");
    let first = empty_job(&silent);
    let targets = Hooks { targets: vec![other.address()], authorities: None };
    let telling = Server::with_hooks(here(), &part, limits(), &targets);
    let made = hook(&telling, &other.at("ncc"), &["job"], "");
    let last = empty_job(&telling);
    assert_eq!(until(&other, &last).len(), 0);
    last_is(&telling, &made, "delivered");
    let waiting = deliveries(&telling, &json!({ "id": "h" }));
    let states: Vec<_> =
        waiting.iter().map(|own| (&own["subject"], &own["state"], &own["attempts"])).collect();
    let zero = json!(0);
    let waits = json!("waiting");
    assert_eq!(states, [(&json!(last), &waits, &zero), (&json!(first), &waits, &zero)]);
    let told = telling.get("/api/v1/hooks/h").json();
    assert_eq!((&told["allowed"], &told["state"]), (&json!(false), &json!("active")));
    own.has_no_more();
}

#[test]
fn a_secret_is_shown_once_and_admins_alone_see_hooks() {
    let receiver = Receiver::new(|_| Reply::Status(200));
    let server = Server::telling(&[receiver.address()], limits());
    let root = admin(&server);
    let asked =
        json!({ "target": receiver.at("a?key=of-the-receiver"), "events": ["job", "job", "release"] });
    let made = root.ask(&server, "POST", "/api/v1/hooks", &asked);
    assert_eq!(made.status, 201, "{}", made.text());
    let made = made.json();
    let secret = made["secret"].as_str().expect("a secret").to_owned();
    assert!(secret.starts_with("whsec_") && secret.len() == 50, "{secret}");
    assert_eq!((&made["events"], &made["author"]), (&json!(["release", "job"]), &json!("root")));
    let path = format!("/api/v1/hooks/{}", made["id"].as_str().expect("a name"));
    for target in ["/api/v1/hooks", &path, "/api/v1/audit", "/metrics"] {
        let text = root.get(&server, target).text();
        assert!(!text.contains("secret\"") && !text.contains(&secret[6..]), "{target}: {text}");
    }
    let audit = root.get(&server, "/api/v1/audit?action=hook.create").json();
    let entry = &audit["audit"][0];
    assert_eq!(
        (&entry["account"], &entry["subject"], &entry["detail"]),
        (&json!("root"), &made["id"], &json!(format!("release job to {}", receiver.at("a"))))
    );
    let reader = with_rights(&server, &root, "ben", &[("", "releaser")]);
    for (method, target) in [("GET", "/api/v1/hooks"), ("GET", &path), ("DELETE", &path)] {
        assert_eq!(reader.ask(&server, method, target, &Value::Null).status, 403, "{method} {target}");
    }
    let begin = json!({ "under": "nothing/here", "to": "haas" });
    for _ in 0..3 {
        assert_eq!(root.ask(&server, "POST", "/api/v1/jobs", &begin).status, 202);
        let message = receiver.next();
        assert_eq!(message.path, "/a?key=of-the-receiver");
        message.is_signed_by(&made);
    }
    let page = |query: &str| root.get(&server, &format!("{path}/deliveries?{query}")).json();
    let [first, second] = [page("limit=2"), page(&format!("limit=2&before={}", page("limit=2")["next"]))];
    assert_eq!([&first, &second].map(|own| own["deliveries"].as_array().map(Vec::len)), [Some(2), Some(1)]);
    assert!(second["next"].is_null(), "{second}");
    assert_eq!(root.ask(&server, "DELETE", &path, &Value::Null).status, 204);
    for target in [path.clone(), format!("{path}/deliveries")] {
        assert_eq!(root.get(&server, &target).status, 404);
    }
    let deleted = root.get(&server, "/api/v1/audit?action=hook.delete").json();
    assert_eq!(deleted["audit"][0]["subject"], made["id"]);
    assert_eq!(server.select("SELECT id FROM delivery"), [""; 0]);
}

#[test]
fn what_is_no_hook_is_refused() {
    let receiver = Receiver::new(|_| Reply::Status(200));
    let server = Server::telling(&[receiver.address()], limits());
    let target = receiver.at("a");
    for (asked, status) in [
        (json!({ "target": target, "events": [] }), 422),
        (json!({ "target": target, "events": ["lunch"] }), 422),
        (json!({ "target": target }), 422),
        (json!({ "events": ["job"] }), 422),
        (json!({ "target": target, "events": ["job"], "secret": "mine" }), 422),
        (json!({ "target": target, "events": ["job"], "folder": "a/../b" }), 400),
        (json!([target]), 422),
    ] {
        let answer = server.json("POST", "/api/v1/hooks", asked.to_string().as_bytes());
        assert_eq!(answer.status, status, "{asked}: {}", answer.text());
    }
    for path in ["/api/v1/hooks/none", "/api/v1/hooks/none/deliveries"] {
        assert_eq!(server.get(path).status, 404, "{path}");
    }
    assert_eq!(server.delete("/api/v1/hooks/none").status, 404);
    assert_eq!(server.ask("POST", "/api/v1/hooks/none/deliveries/none", &[], b"").status, 404);
    assert_eq!(server.get("/api/v1/hooks?limit=x").status, 400);
}

/// A receiver with a certificate of the shop: known by `--hook-ca`, and asked by nobody else.
#[test]
fn a_receiver_with_tls_is_known_by_its_authority() {
    let pair = Pair::of(&["localhost"]);
    let receiver = Receiver::with_tls(&pair.files(), |_| Reply::Status(200));
    let target = receiver.at("a").replace("127.0.0.1", "localhost");
    let telling = |authorities: bool| {
        let folder = tempfile::tempdir().expect("a folder");
        let part = Part::All { database: place(&folder.path().join("a.sqlite")) };
        let [certificate, _] = pair.files();
        let hooks = Hooks { targets: vec![target.clone()], authorities: authorities.then_some(certificate) };
        (Server::with_hooks(here(), &part, patient(), &hooks), folder)
    };
    let (stranger, _folder) = telling(false);
    let unknown = hook(&stranger, &target, &["job"], "");
    empty_job(&stranger);
    let failed = last_is(&stranger, &unknown, "failed");
    assert!(failed["reason"].as_str().is_some_and(|why| why.starts_with("TLS: ")), "{failed}");
    assert!(failed["status"].is_null(), "{failed}");
    let (server, _folder) = telling(true);
    let made = hook(&server, &target, &["job"], "");
    let job = empty_job(&server);
    let message = receiver.next();
    message.is_signed_by(&made);
    assert_eq!(message.json()["data"]["job"], job.as_str());
    last_is(&server, &made, "delivered");
    receiver.has_no_more();
}
