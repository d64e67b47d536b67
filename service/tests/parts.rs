//! The three services as processes of their own: TRANSPILER and OUTPUT find PERSISTENCE over HTTP.

use std::fs;
use std::net::SocketAddr;

use ncc_service::{Limits, OpenError, Part, Place, Service};

use crate::client::{PROGRAM, Server, place, repository};

struct Three {
    persistence: Server,
    transpiler: Server,
    output: Server,
    _folder: tempfile::TempDir,
}

fn three() -> Three {
    let folder = tempfile::tempdir().expect("a folder");
    let part = Part::Persistence { database: place(&folder.path().join("ncc.sqlite")) };
    let persistence = Server::of(&part, Limits::default());
    let there = format!("http://{}", persistence.address);
    let transpiler = Server::of(&Part::Transpiler { persistence: there.clone() }, Limits::default());
    let output = Server::of(&Part::Output { persistence: format!("{there}/") }, Limits::default());
    Three { persistence, transpiler, output, _folder: folder }
}

/// What one process answers, three together answer too.
#[test]
fn three_processes_answer_as_one_does() {
    let (three, one) = (three(), Server::all());
    let text = fs::read_to_string(repository("corpus/mach9/table9.cn")).expect("the corpus");
    for server in [&three.persistence, &one] {
        assert_eq!(server.romi().status, 201);
    }
    let post = "/transpiler/a%20b.cn?dialect=mach9&machine=romi&start=X-9%2CY15.588%2CZ3";
    for (method, apart, target, body, status) in [
        ("POST", &three.transpiler, post, &*text, 201),
        ("POST", &three.transpiler, post, &*text, 409),
        ("GET", &three.transpiler, "/transpiler/a%20b.cn", "", 200),
        ("GET", &three.transpiler, "/transpiler/a%20b.cn?stage=before&form=ncc", "", 200),
        ("GET", &three.persistence, "/persistence/a%20b.cn", "", 200),
        ("GET", &three.persistence, "/persistence/a%20b.cn?form=printed", "", 200),
        ("GET", &three.output, "/output/a%20b.cn", "", 200),
        ("GET", &three.output, "/output/a%20b.cn&type=cmf", "", 200),
        ("GET", &three.output, "/output/absent", "", 404),
        ("PUT", &three.transpiler, "/transpiler/absent", PROGRAM, 404),
        ("PUT", &three.transpiler, "/transpiler/a%20b.cn?machine=none", PROGRAM, 400),
        ("PUT", &three.transpiler, "/transpiler/a%20b.cn", "G99999\n", 422),
        ("PUT", &three.transpiler, "/transpiler/a%20b.cn", PROGRAM, 200),
        ("GET", &three.output, "/output/a%20b.cn", "", 200),
        ("DELETE", &three.transpiler, "/transpiler/a%20b.cn", "", 204),
        ("DELETE", &three.persistence, "/persistence/a%20b.cn", "", 404),
        ("GET", &three.output, "/output/a%20b.cn&type=cmf", "", 404),
    ] {
        let answers = [apart, &one].map(|server| server.ask(method, target, &[], body.as_bytes()));
        let [apart, one] = &answers;
        assert_eq!(apart.status, status, "{method} {target}: {}", apart.text());
        assert_eq!(one.status, status, "{method} {target}: {}", one.text());
        for header in ["etag", "location", "content-type"] {
            assert_eq!(apart.header(header), one.header(header), "{method} {target}");
        }
        // A problem may be told in other words.
        if status < 300 {
            assert_eq!(apart.text(), one.text(), "{method} {target}");
        }
    }
}

/// Conditions go through to PERSISTENCE; lists come from it.
#[test]
fn conditions_go_through() {
    let three = three();
    let made = three.transpiler.keep("a");
    let tag = made.header("etag");
    let stored = three.persistence.get("/persistence/a");
    assert_eq!(stored.header("etag"), format!("{}-after\"", tag.trim_end_matches('"')));
    for target in ["/output/a", "/output/a?type=cmf"] {
        let tag = three.output.get(target).header("etag").to_owned();
        assert_eq!(three.output.ask("GET", target, &[("If-None-Match", &tag)], b"").status, 304);
    }
    for (method, body) in [("PUT", PROGRAM), ("DELETE", "")] {
        for wrong in ["\"x\"", "W/\"x\"", "\"x\", \"y\"", "x"] {
            let answer =
                three.transpiler.ask(method, "/transpiler/a", &[("If-Match", wrong)], body.as_bytes());
            assert_eq!(answer.status, 412, "{method}, {wrong}: {}", answer.text());
        }
        let answer = three.transpiler.ask(method, "/transpiler/a", &[("If-Match", tag)], body.as_bytes());
        assert!(answer.status < 300, "{method}: {}", answer.text());
    }
    for name in ["a", "b", "c"] {
        three.transpiler.keep(name);
    }
    let page = three.transpiler.get("/transpiler?limit=2&after=a").json();
    assert_eq!(page["documents"].as_array().map(Vec::len), Some(2), "{page}");
    assert_eq!(page["next"], "c");
}

/// Each has its own addresses alone.
#[test]
fn each_has_its_own_addresses() {
    let three = three();
    three.transpiler.keep("a");
    for (server, own) in [
        (&three.persistence, &["/persistence/a", "/persistence", "/api/v1/machines"][..]),
        (&three.transpiler, &["/transpiler/a", "/transpiler"]),
        (&three.output, &["/output/a"]),
    ] {
        for target in [
            "/persistence/a",
            "/persistence",
            "/api/v1/machines",
            "/transpiler/a",
            "/transpiler",
            "/output/a",
        ] {
            let status = if own.contains(&target) { 200 } else { 404 };
            assert_eq!(server.get(target).status, status, "{own:?}: {target}");
        }
    }
}

/// Without PERSISTENCE the others say so.
#[test]
fn without_persistence_there_is_no_document() {
    // Nothing listens on port 1. One that was free a moment ago may be that of another test now.
    let persistence = "http://127.0.0.1:1".to_owned();
    let output = Server::of(&Part::Output { persistence: persistence.clone() }, Limits::default());
    assert_eq!(output.get("/output/a").status, 502);
    let transpiler = Server::of(&Part::Transpiler { persistence }, Limits::default());
    for (method, status) in [("POST", 502), ("PUT", 502), ("GET", 502), ("DELETE", 502)] {
        let body = if matches!(method, "POST" | "PUT") { PROGRAM } else { "" };
        let target = if body.is_empty() { "/transpiler/a" } else { "/transpiler/a?dialect=mach9" };
        assert_eq!(transpiler.ask(method, target, &[], body.as_bytes()).status, status, "{method}");
    }
    // One that is refused needs no store.
    assert_eq!(transpiler.program("POST", "/transpiler/a?dialect=mach9", "G99999\n").status, 422);
}

#[test]
fn a_server_opens_on_this_computer_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let all = |file: &str| Part::All { database: Place::File(folder.path().join(file)) };
    let open = |address: &str, part: &Part| {
        Service::open(address.parse::<SocketAddr>().expect("an address"), part, "ana").err()
    };
    for address in ["0.0.0.0:0", "192.0.2.1:0", "[::]:0"] {
        assert!(matches!(open(address, &all("a")), Some(OpenError::NoAccount)), "{address}");
    }
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let taken = taken.local_addr().expect("an address").to_string();
    assert!(matches!(open(&taken, &all("b")), Some(OpenError::Address(_))));
    fs::write(folder.path().join("text"), "no database, but a text that is long enough").expect("a file");
    for file in ["text", "no/such/folder"] {
        assert!(matches!(open("127.0.0.1:0", &all(file)), Some(OpenError::Database(_))), "{file}");
    }
    assert!(open("127.0.0.1:0", &all("good")).is_none());
}
