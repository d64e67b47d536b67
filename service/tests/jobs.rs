//! Jobs over folders.

use std::io::Read;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::client::{Answer, PROGRAM, Server};
use crate::programs::new;

/// A program that never ends.
const ENDLESS: &str = "%\nO1\nG21 G90 G54\n#1=0\nN10 #1=#1+1\nG0 X[#1 MOD 7]\nGOTO10\nM30\n%\n";

fn begin(server: &Server, asked: &Value) -> Answer {
    server.json("POST", "/api/v1/jobs", asked.to_string().as_bytes())
}

fn job(server: &Server, asked: &Value) -> String {
    let begun = begin(server, asked);
    assert_eq!(begun.status, 202, "{}", begun.text());
    let id = begun.json()["id"].as_str().expect("a name").to_owned();
    assert_eq!(begun.header("location"), format!("/api/v1/jobs/{id}"));
    id
}

/// Waits for the end of a job.
fn ended(server: &Server, id: &str) -> Value {
    let since = Instant::now();
    loop {
        let job = server.get(&format!("/api/v1/jobs/{id}")).json();
        if !job["ended"].is_null() {
            return job;
        }
        assert!(since.elapsed() < Duration::from_secs(60), "{job}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_folder_is_translated() {
    let server = Server::all();
    for n in 1..=5 {
        new(&server, &format!("name=p{n}.cn&folder=f&dialect=mach9"), &format!("{PROGRAM}G0X{n}.\n"));
    }
    new(&server, "name=wrong.nc&folder=f/g&dialect=fanuc", "%\nO1\nG21 G90\nG777\nM30\n%\n");
    new(&server, "name=other.cn&folder=fg&dialect=mach9", PROGRAM);
    let id = job(&server, &json!({ "under": "f", "to": "haas" }));
    let mut events = String::new();
    let mut stream = server.send("GET", &format!("/api/v1/jobs/{id}/events"), &[], b"");
    stream.read_to_string(&mut events).expect("events until the end");
    assert!(events.contains("text/event-stream") && events.contains("event: end"), "{events}");
    let over = ended(&server, &id);
    assert_eq!(over["tasks"], json!({ "done": 5, "refused": 1 }), "{over}");
    let results = server.get(&format!("/api/v1/jobs/{id}/results")).json();
    let results = results["results"].as_array().expect("a list").clone();
    let states: Vec<_> =
        results.iter().map(|of| (of["name"].as_str().unwrap(), of["state"].as_str().unwrap())).collect();
    assert_eq!(states.last(), Some(&("wrong.nc", "refused")));
    assert_eq!(results[5]["problem"]["diagnostics"][0]["code"], "NC0201", "{}", results[5]);
    let first = results[0]["translation"].as_str().expect("a translation");
    assert_eq!(server.get(&format!("/api/v1/translations/{first}")).json()["program"], results[0]["program"]);
    // The same job again makes nothing anew.
    let again = job(&server, &json!({ "under": "f", "to": "haas" }));
    ended(&server, &again);
    let same = server.get(&format!("/api/v1/jobs/{again}/results?limit=1")).json();
    assert_eq!((&same["results"][0]["translation"], &same["next"]), (&json!(first), &json!(1)));
    let list = server.get("/api/v1/jobs?limit=1").json();
    assert_eq!(list["jobs"].as_array().map(Vec::len), Some(1));
}

#[test]
fn a_job_is_cancelled() {
    let server = Server::all();
    for n in 1..=4 {
        new(&server, &format!("name=p{n}.nc&tag=long&dialect=fanuc"), ENDLESS);
    }
    let id = job(&server, &json!({ "tag": "long", "to": "haas" }));
    std::thread::sleep(Duration::from_millis(600));
    let cancelled = server.delete(&format!("/api/v1/jobs/{id}"));
    assert_eq!((cancelled.status, &cancelled.json()["cancelled"]), (200, &json!(true)));
    let since = Instant::now();
    let over = ended(&server, &id);
    assert!(since.elapsed() < Duration::from_secs(10), "{over}");
    assert_eq!(over["tasks"]["waiting"], Value::Null, "{over}");
    assert!(over["tasks"]["cancelled"].as_i64() >= Some(2), "{over}");
    assert!(server.is_well());
}

#[test]
fn what_is_wrong_is_refused() {
    let server = Server::all();
    let program = new(&server, "name=a.cn&dialect=mach9", PROGRAM);
    for (asked, status) in [
        (json!({}), 422),
        (json!({ "to": "haas" }), 422),
        (json!({ "under": "/x", "to": "haas" }), 400),
        (json!({ "under": "", "program": program }), 422),
        (json!({ "under": "", "colour": "red" }), 422),
        (json!({ "programs": ["none"], "to": "haas" }), 404),
        (json!({ "programs": program, "to": "haas" }), 422),
        (json!([1]), 422),
    ] {
        let answer = begin(&server, &asked);
        assert_eq!(answer.status, status, "{asked}: {}", answer.text());
    }
    for target in ["/api/v1/jobs/none", "/api/v1/jobs/none/results", "/api/v1/jobs/none/events"] {
        assert_eq!(server.get(target).status, 404, "{target}");
    }
    assert_eq!(server.delete("/api/v1/jobs/none").status, 404);
    let empty = job(&server, &json!({ "under": "nothing/here", "to": "haas" }));
    assert_eq!(ended(&server, &empty)["tasks"], json!({}));
}
