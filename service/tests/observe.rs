//! Compression, counters, and names of requests.

use serde_json::Value;

use crate::client::{PROGRAM, Server};

const GZIP: [(&str, &str); 1] = [("Accept-Encoding", "gzip")];

/// The name of a new program.
fn program(server: &Server) -> String {
    let text = PROGRAM.repeat(100);
    let made = server.program("POST", "/api/v1/programs?name=a.cn&dialect=mach9&message=ssecret", &text);
    assert_eq!(made.status, 201, "{}", made.text());
    made.json()["id"].as_str().expect("a name").to_owned()
}

#[test]
fn a_compressed_answer_has_a_tag_of_its_own() {
    let server = Server::all();
    let path = format!("/api/v1/programs/{}/text", program(&server));
    let [plain, packed] = [&[], GZIP.as_slice()].map(|headers| server.ask("GET", &path, headers, b""));
    assert_eq!((plain.header("etag"), plain.header("content-encoding")), ("\"1\"", ""));
    assert_eq!((packed.header("etag"), packed.header("content-encoding")), ("\"1-gzip\"", "gzip"));
    assert_eq!(packed.header("vary"), "accept-encoding");
    assert_eq!(plain.text(), PROGRAM.repeat(100));
    // It comes in chunks, of which the first is the head of gzip.
    assert!(packed.body.windows(2).any(|two| two == [0x1f, 0x8b]) && packed.body.len() < 400);
    // Either tag says to a reader and to a writer what was read.
    for tag in ["\"1\"", "\"1-gzip\"", "W/\"1-gzip\""] {
        assert_eq!(server.ask("GET", &path, &[("If-None-Match", tag)], b"").status, 304, "{tag}");
    }
    let write = |tag: &str, text: &[u8]| {
        let headers = [("Content-Type", "text/plain"), ("If-Match", tag)];
        server.ask("PUT", &path, &headers, text).status
    };
    assert_eq!(write("\"1-gzip\"", b"M30\n"), 200);
    assert_eq!(write("\"1-gzip\"", b"M5\n"), 412);
}

#[test]
fn events_are_not_compressed() {
    let server = Server::all();
    let body = format!("{{\"programs\": [{:?}], \"to\": \"fanuc\"}}", program(&server));
    let job = server.json("POST", "/api/v1/jobs", body.as_bytes()).json();
    let path = format!("/api/v1/jobs/{}/events", job["id"].as_str().expect("a name"));
    let events = server.ask("GET", &path, &GZIP, b"");
    assert_eq!(events.header("content-encoding"), "");
    assert!(events.text().contains("event: end"), "{}", events.text());
}

#[test]
fn requests_are_counted_by_their_routes() {
    let server = Server::all();
    let id = program(&server);
    for _ in 0..3 {
        server.get(&format!("/api/v1/programs/{id}"));
    }
    server.get("/nothing/here");
    let told = server.get("/metrics");
    assert_eq!(told.header("content-type"), "application/openmetrics-text; version=1.0.0; charset=utf-8");
    let text = told.text();
    for line in [
        "ncc_requests_total{method=\"GET\",route=\"/api/v1/programs/{id}\",status=\"200\"} 3",
        "ncc_requests_total{method=\"GET\",route=\"none\",status=\"404\"} 1",
        "ncc_request_seconds_count{method=\"POST\",route=\"/api/v1/programs\"} 1",
        "ncc_requests_running 1",
        "ncc_work_waiting 0",
        "# EOF",
    ] {
        assert!(text.lines().any(|own| own == line), "{line} is not in\n{text}");
    }
    // Neither a name nor a query is in it.
    assert!(!text.contains(&id) && !text.contains("ssecret"), "{text}");
}

#[test]
fn a_request_has_a_name() {
    let server = Server::all();
    let ask = |name: &str| {
        let path = format!("/api/v1/programs?name={}.cn", name.len());
        let headers = [("Content-Type", "text/plain"), ("X-Request-Id", name)];
        server.ask("POST", &path, &headers, PROGRAM.as_bytes()).header("x-request-id").to_owned()
    };
    assert_eq!(ask("erp-7"), "erp-7");
    let forged = ask("a forged=name");
    assert_eq!(forged.len(), 16, "{forged}");
    let audit = server.get("/api/v1/audit").json();
    let names: Vec<&str> = audit["audit"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|entry| entry["request"].as_str())
        .collect();
    assert_eq!(names, [&*forged, "erp-7"]);
}

#[test]
fn the_description_has_each_error() {
    let described: Value = Server::all().get("/api/v1/openapi.json").json();
    assert_eq!(described["openapi"], "3.1.0");
    for (path, item) in described["paths"].as_object().expect("paths") {
        for (method, operation) in item.as_object().expect("methods") {
            let error = &operation["responses"]["default"]["content"]["application/problem+json"];
            assert_eq!(error["schema"]["$ref"], "#/components/schemas/Problem", "{method} {path}");
            assert!(operation["summary"].is_string(), "{method} {path}");
        }
    }
}

#[cfg(unix)]
#[test]
fn others_cannot_read_the_database() {
    use std::os::unix::fs::PermissionsExt;

    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("ncc.sqlite");
    let part = ncc_service::Part::All { database: ncc_service::Place::File(path) };
    let server = Server::of(&part, ncc_service::Limits::default());
    program(&server);
    for entry in folder.path().read_dir().expect("a folder") {
        let entry = entry.expect("an entry");
        let mode = entry.metadata().expect("its rights").permissions().mode() & 0o777;
        assert_eq!(mode, 0o600, "{:?}", entry.file_name());
    }
}
