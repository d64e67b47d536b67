//! Rights by folder: what is in another one is as if it were not there.

use std::io::Read;
use std::net::TcpStream;
use std::time::{Duration, Instant};

use ncc_service::Limits;
use serde_json::{Value, json};

use super::{User, admin, limits, make, user, with_rights};
use crate::client::{Answer, PROGRAM, Server};

/// A program in a folder.
fn program(server: &Server, by: &User, folder: &str, name: &str) -> String {
    make(server, by, &format!("/api/v1/programs?name={name}&folder={folder}&dialect=mach9"), &PROGRAM.into())
}

fn translation(server: &Server, by: &User, program: &str) -> String {
    make(server, by, "/api/v1/translations", &json!({ "program": program, "to": "fanuc" }))
}

fn job(server: &Server, by: &User, programs: &[&str]) -> String {
    make(server, by, "/api/v1/jobs", &json!({ "programs": programs, "to": "fanuc" }))
}

fn ended(server: &Server, by: &User, id: &str) -> Value {
    let since = Instant::now();
    loop {
        let job = by.get(server, &format!("/api/v1/jobs/{id}")).json();
        if !job["ended"].is_null() {
            return job;
        }
        assert!(since.elapsed() < Duration::from_secs(60), "{job}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Names of the entries of a list, page by page.
fn all(server: &Server, by: &User, list: &str, cursor: &str) -> Vec<String> {
    let (mut names, mut next) = (Vec::new(), String::new());
    loop {
        let page = by.get(server, &format!("/api/v1/{list}?limit=2{next}"));
        assert_eq!(page.status, 200, "{}", page.text());
        let page = page.json();
        let entries = page[list].as_array().expect("a list");
        names.extend(entries.iter().map(|own| own["id"].as_str().expect("a name").to_owned()));
        match page["next"].as_str() {
            Some(name) => next = format!("&{cursor}={name}"),
            None => return names,
        }
        assert_eq!(entries.len(), 2, "a page that is not the last one is full: {page}");
    }
}

/// The answer, without the address that it is about.
fn told(answer: &Answer) -> (u16, String) {
    (answer.status, answer.text())
}

#[test]
fn lists_have_what_may_be_read_and_full_pages() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let folders = [
        "",
        "plates",
        "plates/left",
        "plates2",
        "Plates",
        "pl%D0%B0tes",
        "a/plates",
        "plates%2Fleft%2Fx",
        "shafts",
    ];
    let mut programs = Vec::new();
    for folder in folders {
        for name in ["a", "b", "c"] {
            programs.push((folder, program(&server, &root, folder, name)));
        }
    }
    let translations: Vec<_> =
        programs.iter().map(|(folder, id)| (*folder, translation(&server, &root, id))).collect();
    let jobs: Vec<_> = programs.iter().map(|(folder, id)| (*folder, job(&server, &root, &[id]))).collect();
    let of = |folder: &str| {
        let mut own = programs.iter().filter(|(other, _)| *other == folder);
        own.next().map(|(_, id)| id.clone()).expect("a program")
    };
    let mixed = job(&server, &root, &[&of("plates"), &of("shafts")]);
    let seen = |who: &User, folders: &[&str]| {
        for (list, cursor, all_of) in [
            ("programs", "after", &programs),
            ("translations", "after", &translations),
            ("jobs", "before", &jobs),
        ] {
            let mut found = all(&server, who, list, cursor);
            found.retain(|id| *id != mixed);
            found.sort();
            let mut expected: Vec<_> = all_of
                .iter()
                .filter(|(folder, _)| folders.contains(folder))
                .map(|(_, id)| id.clone())
                .collect();
            expected.sort();
            assert_eq!(found, expected, "{list} of {folders:?}");
            let path = |id: &str| format!("/api/v1/{list}/{id}");
            let nothing = told(&who.get(&server, &path("0123456789abcdefghjk")));
            for (folder, id) in all_of {
                let answer = told(&who.get(&server, &path(id)));
                match folders.contains(folder) {
                    true => assert_eq!(answer.0, 200, "{list} in {folder}"),
                    false => assert_eq!(answer, nothing, "{list} in {folder}"),
                }
            }
        }
    };
    let below = ["plates", "plates/left", "plates%2Fleft%2Fx"];
    let ben = with_rights(&server, &root, "ben", &[("plates", "reader")]);
    seen(&ben, &below);
    seen(&with_rights(&server, &root, "eva", &[("plates/left", "editor")]), &below[1..]);
    seen(
        &with_rights(&server, &root, "two", &[("shafts", "editor"), ("Plates", "reader")]),
        &["shafts", "Plates"],
    );
    seen(&with_rights(&server, &root, "all", &[("", "reader")]), &folders);
    seen(&with_rights(&server, &root, "nix", &[]), &[]);
    // A job over two folders is for those who may read both.
    assert_eq!(ben.get(&server, &format!("/api/v1/jobs/{mixed}/results")).status, 404);
    // A filter finds no more.
    for query in [
        "under=shafts",
        "folder=shafts",
        "name=a&under=",
        "dialect=mach9",
        "under=plates/../shafts",
        "folder=%2e%2e%2fshafts",
    ] {
        let found = ben.get(&server, &format!("/api/v1/programs?{query}"));
        assert!(!found.text().contains(&of("shafts")), "{query}: {}", found.text());
    }
    let found = ben.get(&server, &format!("/api/v1/translations?program={}", of("shafts"))).json();
    assert_eq!(found["translations"], json!([]));
    for query in
        ["", "under=shafts", "folder=shafts", "dialect=mach9", "text=shafts", "tool=1", "state=draft"]
    {
        let found = ben.get(&server, &format!("/api/v1/search?{query}"));
        assert!(found.status == 200 && !found.text().contains(&of("shafts")), "{query}: {}", found.text());
    }
    // Nor does a cursor that is in another folder tell of it.
    assert_eq!(ben.get(&server, &format!("/api/v1/programs?after={}", of("shafts"))).status, 200);
}

/// What changes a program asks for the right before it looks at anything else.
#[test]
fn a_program_elsewhere_is_as_none() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let ben = with_rights(&server, &root, "ben", &[("plates", "releaser")]);
    let secret = program(&server, &root, "secret", "a");
    let made = translation(&server, &root, &secret);
    let of_job = job(&server, &root, &[&secret]);
    let nothing = "0123456789abcdefghjk";
    let patch = json!({ "name": "b" });
    let rows: [(&str, &str, Value); 17] = [
        ("GET", "programs/{p}/text", Value::Null),
        ("GET", "programs/{p}/revisions", Value::Null),
        ("GET", "programs/{p}/revisions/1", Value::Null),
        ("GET", "programs/{p}/revisions/1/text", Value::Null),
        ("GET", "programs/{p}/outputs/check", Value::Null),
        ("POST", "programs/{p}/revisions/1/restore", Value::Null),
        ("PUT", "programs/{p}/text", PROGRAM.into()),
        ("PATCH", "programs/{p}", patch.clone()),
        ("DELETE", "programs/{p}", Value::Null),
        ("POST", "translations", json!({ "program": "{p}", "to": "fanuc" })),
        ("POST", "jobs", json!({ "programs": ["{p}"], "to": "fanuc" })),
        ("GET", "translations/{t}/output", Value::Null),
        ("GET", "translations/{t}/certificate", Value::Null),
        ("GET", "translations/{t}/states", Value::Null),
        ("POST", "translations/{t}/states", json!({ "state": "in-review" })),
        ("GET", "jobs/{j}/events", Value::Null),
        ("DELETE", "jobs/{j}", Value::Null),
    ];
    for (method, path, body) in rows {
        // Conditions that hold, and that do not, tell nothing either.
        for condition in ["", "If-Match: \"1\"", "If-Match: \"77\"", "If-None-Match: *"] {
            let ask = |[p, t, j]: [&str; 3]| {
                let put = |text: &str| text.replace("{p}", p).replace("{t}", t).replace("{j}", j);
                let mut own = ben.clone();
                own.headers.extend(
                    condition.split_once(": ").map(|(name, value)| (name.to_owned(), value.to_owned())),
                );
                let body = match &body {
                    Value::Object(_) => serde_json::from_str(&put(&body.to_string())).expect("JSON"),
                    other => other.clone(),
                };
                told(&own.ask(&server, method, &format!("/api/v1/{}", put(path)), &body))
            };
            let (found, none) = (ask([&secret, &made, &of_job]), ask([nothing; 3]));
            assert!(matches!(found.0, 400 | 404), "{method} {path} {condition}: {found:?}");
            assert_eq!(found, none, "{method} {path} {condition}");
        }
    }
    // A folder that was named is refused whether it is there or not.
    let own = program(&server, &ben, "plates", "a");
    for folder in ["secret", "nowhere", "", "plates2", "Plates"] {
        let moved =
            ben.ask(&server, "PATCH", &format!("/api/v1/programs/{own}"), &json!({ "folder": folder }));
        assert_eq!(moved.status, 403, "{folder}: {}", moved.text());
        let target = format!("/api/v1/programs?name=a&folder={folder}");
        assert_eq!(ben.ask(&server, "POST", &target, &PROGRAM.into()).status, 403, "{folder}");
    }
    for folder in ["plates/../secret", "plates/./a", "/secret", "plates//a", "plates/"] {
        let target = format!("/api/v1/programs?name=a&folder={folder}");
        assert_eq!(ben.ask(&server, "POST", &target, &PROGRAM.into()).status, 400, "{folder}");
    }
    let target = "/api/v1/programs?name=..%2F..%2Fsecret%2Fa&folder=plates";
    assert_eq!(ben.ask(&server, "POST", target, &PROGRAM.into()).status, 400);
}

/// A program that came from another folder takes nothing along with it.
#[test]
fn a_moved_program_opens_no_other_folder() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let ben = with_rights(&server, &root, "ben", &[("plates", "editor")]);
    let main = "%\nO1\nG21 G90 G54\nG0 X1.\nM98 P2001\nM30\n%\n";
    let moved =
        make(&server, &root, "/api/v1/programs?name=main.nc&folder=secret&dialect=fanuc", &main.into());
    let called = "%\nO2001\nG0 Y1.2345\nM99\n%\n";
    let hidden =
        make(&server, &root, "/api/v1/programs?name=O2001&folder=secret&dialect=fanuc", &called.into());
    let path = format!("/api/v1/programs/{moved}");
    assert_eq!(root.ask(&server, "PATCH", &path, &json!({ "folder": "plates" })).status, 200);
    // Its first revision was in the folder of the program that it calls.
    let asked = json!({ "program": moved, "revision": 1, "to": "haas" });
    assert_eq!(make(&server, &root, "/api/v1/translations", &asked).len(), 20);
    let other = json!({ "program": moved, "revision": 1, "to": "haas", "program_number": 5 });
    let refused = ben.ask(&server, "POST", "/api/v1/translations", &other);
    assert_eq!(refused.status, 422, "{}", refused.text());
    assert!(refused.text().contains("NC0217") && !refused.text().contains("1.2345"), "{}", refused.text());
    let output = ben.get(&server, &format!("{path}/outputs/times?revision=1&machine=haas-vf2"));
    assert!(output.status == 422 && !output.text().contains("1.2345"), "{}", output.text());
    // It cannot be put back there.
    assert_eq!(ben.ask(&server, "POST", &format!("{path}/revisions/1/restore"), &Value::Null).status, 403);
    assert_eq!(ben.ask(&server, "POST", &format!("{path}/revisions/2/restore"), &Value::Null).status, 201);
    assert_eq!(ben.get(&server, &format!("/api/v1/programs/{hidden}")).status, 404);
}

/// The key of a request of another user gives away nothing that this user has made.
#[test]
fn a_key_of_another_user_gives_nothing() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let ben = with_rights(&server, &root, "ben", &[("plates", "editor")]);
    let send = |by: &User| {
        let mut by = by.clone();
        by.headers.push(("Idempotency-Key".to_owned(), "one".to_owned()));
        by.ask(&server, "POST", "/api/v1/programs?name=a&folder=plates", &PROGRAM.into())
    };
    let first = send(&root);
    assert_eq!(first.status, 201, "{}", first.text());
    let id = first.json()["id"].as_str().expect("a name").to_owned();
    assert_eq!(send(&ben).json()["id"], json!(id));
    let path = format!("/api/v1/programs/{id}");
    assert_eq!(root.ask(&server, "PATCH", &path, &json!({ "folder": "secret" })).status, 200);
    let again = send(&ben);
    assert!(again.status == 422 && !again.text().contains(&id), "{}", again.text());
}

/// A job does what its author may do when it does it.
#[test]
fn a_job_has_the_rights_of_its_author() {
    let server = Server::limited(Limits { work: Duration::from_secs(2), ..limits() });
    let root = admin(&server);
    let ben = with_rights(&server, &root, "ben", &[("plates", "editor"), ("plates/read", "reader")]);
    let ids: Vec<String> =
        (0..3).map(|number| program(&server, &ben, "plates/a", &number.to_string())).collect();
    program(&server, &root, "secret", "a");
    // Of all below the top, those with which ben may do it; a role in a folder adds to those above it.
    program(&server, &root, "plates/read", "r");
    for under in ["", "plates", "secret"] {
        let id = make(&server, &ben, "/api/v1/jobs", &json!({ "under": under, "to": "haas" }));
        let tasks = ended(&server, &ben, &id)["tasks"].clone();
        assert_eq!(tasks, if under == "secret" { json!({}) } else { json!({ "done": 4 }) }, "{under:?}");
    }
    // A job without programs is its author's.
    let eva = with_rights(&server, &root, "eva", &[("plates", "editor")]);
    let empty = make(&server, &ben, "/api/v1/jobs", &json!({ "under": "nothing", "to": "haas" }));
    let path = format!("/api/v1/jobs/{empty}");
    assert_eq!([&ben, &eva, &root].map(|by| by.get(&server, &path).status), [200, 404, 200]);
    assert!(!all(&server, &eva, "jobs", "before").contains(&empty));
    assert!(all(&server, &ben, "jobs", "before").contains(&empty));
    // Tasks that wait when the rights are lost are refused.
    let endless = "%\nO1\nG21 G90 G54\n#1=0\nN10 #1=#1+1\nG0 X[#1 MOD 7]\nGOTO10\nM30\n%\n";
    let mut waiting: Vec<String> = Vec::new();
    // As many as there are workers, and then the others.
    for number in 0..std::thread::available_parallelism().map_or(2, usize::from) {
        let place = format!("/api/v1/programs?name=e{number}&folder=plates/a&dialect=fanuc");
        waiting.push(make(&server, &root, &place, &format!("{endless}({number})\n").into()));
    }
    waiting.extend(ids);
    let id = make(&server, &ben, "/api/v1/jobs", &json!({ "programs": waiting, "to": "siemens" }));
    // Events of a session that ends end with it, and those of rights that are lost.
    let events = |by: &User| {
        let headers: Vec<_> =
            by.headers.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
        let mut stream = server.send("GET", &format!("/api/v1/jobs/{id}/events"), &headers, b"");
        let mut begin = [0; 100];
        stream.read_exact(&mut begin).expect("the first event");
        stream
    };
    let end = |mut stream: TcpStream| {
        let mut rest = String::new();
        stream.read_to_string(&mut rest).expect("the end of the events");
        assert!(!rest.contains("event: end"), "{rest}");
    };
    let other = user(&server, "ben");
    let [of_session, of_rights] = [&other, &ben].map(events);
    assert_eq!(other.ask(&server, "DELETE", "/api/v1/session", &Value::Null).status, 204);
    end(of_session);
    let changed = root.ask(&server, "PATCH", "/api/v1/accounts/ben", &json!({ "rights": [] }));
    assert_eq!(changed.status, 200, "{}", changed.text());
    end(of_rights);
    assert_eq!(ben.get(&server, &format!("/api/v1/jobs/{id}")).status, 404);
    ended(&server, &root, &id);
    let results = root.get(&server, &format!("/api/v1/jobs/{id}/results")).json();
    let last = results["results"].as_array().and_then(|all| all.last()).cloned().expect("a task");
    assert_eq!((&last["state"], &last["problem"]["status"]), (&json!("refused"), &json!(404)), "{last}");
}
