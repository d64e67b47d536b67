//! Tables 6, 7 and 8 of the case study, row by row, and the conditions of HTTP.

use crate::client::{Answer, PROGRAM, Server, TABLE_10};

/// A request and the status that it gets, in an order that makes sense of them.
struct Row {
    method: &'static str,
    target: &'static str,
    body: Body,
    status: u16,
    /// What the body of the answer has.
    has: &'static str,
}

#[derive(Clone, Copy)]
enum Body {
    None,
    /// [`PROGRAM`].
    Program,
    Text(&'static str),
    Json(&'static str),
    Media(&'static str),
    /// The payload of `made.cn`, or of another name.
    Payload(&'static str),
}

use Body::{Json, Media, None as Nothing, Payload, Program, Text};

const fn row(method: &'static str, target: &'static str, body: Body, status: u16, has: &'static str) -> Row {
    Row { method, target, body, status, has }
}

const ROWS: &[Row] = &[
    // Table 6.
    row(
        "POST",
        "/transpiler/made.cn?dialect=mach9&machine=romi-discovery-4022",
        Program,
        201,
        "\"blocks\": 8",
    ),
    row(
        "POST",
        "/transpiler/made.cn?dialect=mach9&machine=romi-discovery-4022",
        Program,
        409,
        "problem:exists",
    ),
    row("GET", "/transpiler/made.cn", Nothing, 200, "\"prog_name\": \"made.cn\""),
    row("GET", "/transpiler/made.cn", Nothing, 200, "\"parameters\":[{}]"),
    row("GET", "/transpiler/made.cn?form=ncc", Nothing, 200, "\"parameters\":{}"),
    row("GET", "/transpiler/made.cn?stage=before", Nothing, 200, "\"timestamp\":0.0"),
    row("PUT", "/transpiler/made.cn?dialect=mach9&machine=romi", Program, 400, "there is no machine `romi`"),
    row("PUT", "/transpiler/made.cn", Text("T1M6\nM5\n"), 200, "\"dialect\": \"mach9\""),
    row("PUT", "/transpiler/made.cn?dialect=haas", Text("T1M6\nM5\nM30\n"), 200, "\"dialect\": \"haas\""),
    row("POST", "/transpiler/plain.cn?dialect=mach9", Program, 201, "\"machine_name\": \"\""),
    row("PUT", "/transpiler/plain.cn", Program, 200, "\"dialect\": \"mach9\""),
    row("DELETE", "/transpiler/plain.cn", Nothing, 204, ""),
    row("PUT", "/transpiler/absent.cn?dialect=mach9", Program, 404, "problem:absent"),
    row("POST", "/transpiler/other.cn?dialect=mach9", Text("G1X1F100\nG99999\n"), 422, "\"code\": \"NC0"),
    row("GET", "/transpiler/other.cn", Nothing, 404, "problem:absent"),
    row("POST", "/transpiler/other.cn?dialect=mach9", Text(""), 422, "NC0108"),
    row("POST", "/transpiler/other.cn?dialect=cobol", Program, 400, "there is no dialect `cobol`"),
    row("POST", "/transpiler/other.cn", Program, 400, "is not certain"),
    row("POST", "/transpiler/other.cn?dialect=mach9&dialect=haas", Program, 400, "stands there 2 times"),
    row("POST", "/transpiler/other.cn?dialect=mach9&diallect=haas", Program, 400, "takes no `diallect`"),
    row("POST", "/transpiler/other.cn?dialect=mach9&option=none", Program, 400, "option=NAME=VALUE"),
    row("POST", "/transpiler/other.cn?dialect=mach9&start_time=soon", Program, 400, "takes no `soon`"),
    row("POST", "/transpiler/other.cn?dialect=mach9&start_time=nan", Program, 400, "takes no `NaN`"),
    row("POST", "/transpiler/other.cn?dialect=mach9", Media("application/json"), 415, "text/plain"),
    row("PATCH", "/transpiler/made.cn", Nothing, 405, "problem:method"),
    row("GET", "/transpiler/made.cn?form=xml", Nothing, 400, "one of: stored, ncc, printed, whole"),
    row("GET", "/transpiler/made.cn?stage=middle", Nothing, 400, "one of: before, after"),
    row("GET", "/transpiler", Nothing, 200, "\"prog_name\": \"made.cn\""),
    row("DELETE", "/transpiler/made.cn", Nothing, 204, ""),
    row("DELETE", "/transpiler/made.cn", Nothing, 404, "problem:absent"),
    // Table 7.
    row("POST", "/transpiler/made.cn?dialect=mach9&machine=romi-discovery-4022", Program, 201, ""),
    row("POST", "/persistence/put.cn", Payload("put.cn"), 201, ""),
    row("POST", "/persistence/put.cn", Payload("put.cn"), 409, "problem:exists"),
    row("GET", "/persistence/put.cn", Nothing, 200, "\"prog_name\": \"put.cn\""),
    row("GET", "/persistence/put.cn?form=printed", Nothing, 200, "\"parameters\":[{}]"),
    row("GET", "/persistence/put.cn?form=ncc&stage=after", Nothing, 200, "\"parameters\":{}"),
    row("GET", "/persistence/put.cn?stage=before", Nothing, 404, "other stage alone"),
    row("PUT", "/persistence/put.cn", Payload("put.cn"), 204, ""),
    row("PUT", "/persistence/put.cn", Payload("made.cn"), 422, "its prog_name"),
    row("PUT", "/persistence/absent.cn", Payload("absent.cn"), 404, "problem:absent"),
    row("PUT", "/persistence/put.cn", Json("{"), 422, "the body is not a payload"),
    row("PUT", "/persistence/put.cn", Json("[]"), 422, "the body is not a payload"),
    row("PUT", "/persistence/put.cn", Text("{}"), 415, "application/json"),
    row("PUT", "/persistence/put.cn?form=ncc", Payload("put.cn"), 400, "takes no `form`"),
    row("GET", "/persistence/absent.cn", Nothing, 404, "problem:absent"),
    row("GET", "/persistence", Nothing, 200, "\"prog_name\": \"put.cn\""),
    row("PATCH", "/persistence/put.cn", Nothing, 405, "problem:method"),
    // Table 8.
    row("GET", "/output/made.cn?type=csv", Nothing, 200, "function_name,"),
    row("GET", "/output/made.cn", Nothing, 200, "function_name,"),
    row("GET", "/output/made.cn&type=csv", Nothing, 200, "function_name,"),
    row("GET", "/output/made.cn?type=cmf", Nothing, 200, "START_SPINDLE_CLOCKWISE"),
    row("GET", "/output/made.cn&type=cmf", Nothing, 200, "START_SPINDLE_CLOCKWISE"),
    row("GET", "/output/made.cn&type=cmf?type=csv", Nothing, 400, "stands there 2 times"),
    row("GET", "/output/made.cn?type=pdf", Nothing, 400, "one of: csv, cmf"),
    row("GET", "/output/made.cn?typ=csv", Nothing, 400, "takes no `typ`"),
    row("GET", "/output/put.cn?type=csv", Nothing, 200, "function_name,"),
    row("GET", "/output/put.cn?type=cmf", Nothing, 422, "stored by itself"),
    row("GET", "/output/absent.cn", Nothing, 404, "problem:absent"),
    row("POST", "/output/made.cn", Program, 405, "problem:method"),
    row("DELETE", "/output/made.cn", Nothing, 405, "problem:method"),
    row("DELETE", "/persistence/put.cn", Nothing, 204, ""),
    row("DELETE", "/persistence/put.cn", Nothing, 404, "problem:absent"),
    // A document of TRANSPILER is one of PERSISTENCE.
    row("GET", "/persistence/made.cn", Nothing, 200, "\"prog_name\": \"made.cn\""),
    row("PUT", "/persistence/made.cn", Payload("made.cn"), 204, ""),
    row("GET", "/output/made.cn?type=cmf", Nothing, 422, "stored by itself"),
    row("DELETE", "/persistence/made.cn", Nothing, 204, ""),
    row("GET", "/transpiler/made.cn", Nothing, 404, "problem:absent"),
    // Table 10.
    row("GET", "/api/v1/machines/romi", Nothing, 404, "problem:absent"),
    row("PUT", "/api/v1/machines/romi", Json(TABLE_10), 201, ""),
    row("PUT", "/api/v1/machines/romi", Json(TABLE_10), 204, ""),
    row("GET", "/api/v1/machines/romi", Nothing, 200, TABLE_10),
    row("GET", "/api/v1/machines", Nothing, 200, "\"name\": \"romi\""),
    row("PUT", "/api/v1/machines/other", Json(TABLE_10), 422, "\\\"romi\\\""),
    row(
        "PUT",
        "/api/v1/machines/romi",
        Json("{ \"name\": \"romi\", \"max_feed\": \"fast\" }"),
        422,
        "\"line\": 1",
    ),
    row("PUT", "/api/v1/machines/romi-discovery-4022", Text("x"), 415, "application/toml"),
    row("POST", "/api/v1/machines/romi", Json(TABLE_10), 405, "problem:method"),
    row("DELETE", "/api/v1/machines/romi", Nothing, 204, ""),
    row("DELETE", "/api/v1/machines/romi", Nothing, 404, "problem:absent"),
    // The studio's page.
    row("GET", "/", Nothing, 200, "content=\"serve\""),
    row("POST", "/", Program, 405, "problem:method"),
    row("GET", "/studio.js", Nothing, 200, ""),
    // No such address.
    row("GET", "/index.html", Nothing, 404, "no such address"),
    row("GET", "/persistence/", Nothing, 404, "no such address"),
    row("GET", "/persistence/a/b", Nothing, 404, "no such address"),
    row("GET", "/output", Nothing, 404, "no such address"),
];

/// A payload of [`PROGRAM`] under a name.
fn payload(name: &str) -> Vec<u8> {
    let server = Server::all();
    server.keep(name);
    server.get(&format!("/persistence/{name}")).body
}

fn sent(server: &Server, row: &Row) -> Answer {
    match row.body {
        Nothing => server.ask(row.method, row.target, &[], b""),
        Program => server.program(row.method, row.target, PROGRAM),
        Text(text) => server.program(row.method, row.target, text),
        Json(text) => server.json(row.method, row.target, text.as_bytes()),
        Media(media) => server.ask(row.method, row.target, &[("Content-Type", media)], b"M30\n"),
        Payload(name) => server.json(row.method, row.target, &payload(name)),
    }
}

#[test]
fn every_row_of_the_tables_is_answered() {
    let server = Server::all();
    for (k, row) in ROWS.iter().enumerate() {
        let answer = sent(&server, row);
        let told = format!("row {k}, {} {}: {}", row.method, row.target, answer.text());
        assert_eq!(answer.status, row.status, "{told}");
        assert!(answer.text().contains(row.has), "{told}");
        match answer.status {
            201 => {
                let target = row.target.split('?').next().unwrap_or_default();
                assert_eq!(answer.header("location"), target, "{told}");
                assert!(answer.header("etag").len() > 60, "{told}");
            }
            204 => assert!(answer.body.is_empty(), "{told}"),
            400.. => {
                assert_eq!(answer.header("content-type"), "application/problem+json", "{told}");
                assert_eq!(answer.json()["status"], answer.status, "{told}");
            }
            _ => {}
        }
        if answer.status == 405 {
            assert!(answer.header("allow").contains("GET"), "{told}: {:?}", answer.headers);
        }
        for (name, value) in [("x-content-type-options", "nosniff"), ("cache-control", "no-cache")] {
            assert_eq!(answer.header(name), value, "{told}");
        }
    }
}

/// A refused program: each diagnostic has its number and its place.
#[test]
fn a_refused_program_is_told_where() {
    let server = Server::all();
    let refused = server.program("POST", "/transpiler/a.cn?dialect=mach9", "G0X1.\nG1X5.F100\n  G99999\n");
    assert_eq!(refused.status, 422);
    let told = refused.json();
    let first = &told["diagnostics"][0];
    assert_eq!(first["severity"], "error", "{told}");
    assert_eq!((&first["place"]["line"], &first["place"]["column"]), (&3.into(), &3.into()), "{told}");
    assert!(first["code"].as_str().is_some_and(|code| code.len() == 6 && code.starts_with("NC")), "{told}");
    assert!(told["messages"].as_str().is_some_and(|text| text.contains("a.cn:3:3")), "{told}");
}

/// Media types of outputs, and tags by which a reader has them already.
#[test]
fn a_reader_is_told_that_nothing_has_changed() {
    let server = Server::all();
    server.keep("a.cn");
    let mut tags = Vec::new();
    for (target, media) in [
        ("/transpiler/a.cn", "application/json"),
        ("/transpiler/a.cn?stage=before", "application/json"),
        ("/transpiler/a.cn?form=ncc", "application/json"),
        ("/persistence/a.cn", "application/json"),
        ("/persistence/a.cn?form=whole", "application/vnd.ncc.document+json"),
        ("/output/a.cn", "text/csv; charset=utf-8; header=present"),
        ("/output/a.cn?type=cmf", "text/plain; charset=utf-8"),
    ] {
        let answer = server.get(target);
        assert_eq!((answer.status, answer.header("content-type")), (200, media), "{target}");
        let tag = answer.header("etag").to_owned();
        for known in [&tag, &format!("W/{tag}"), &format!("\"x\", {tag}"), "*"] {
            let again = server.ask("GET", target, &[("If-None-Match", known)], b"");
            assert_eq!((again.status, again.body.len()), (304, 0), "{target}, {known}");
            assert_eq!(again.header("etag"), tag);
        }
        let other = server.ask("GET", target, &[("If-None-Match", "\"x\"")], b"");
        assert_eq!((other.status, other.body), (200, answer.body), "{target}");
        let head = server.ask("HEAD", target, &[], b"");
        assert_eq!((head.status, head.body.len(), head.header("etag")), (200, 0, &*tag), "{target}");
        assert!(!tags.contains(&tag), "{target}: outputs that differ have tags that differ");
        tags.push(tag);
    }
    let changed = server.program("PUT", "/transpiler/a.cn", "T2M6\nM5\n");
    assert_eq!(changed.status, 200);
    let again = server.ask("GET", "/transpiler/a.cn", &[("If-None-Match", &tags[0])], b"");
    assert_eq!(again.status, 200);
}

/// A writer names what was read by the tag of any output of it.
#[test]
fn a_writer_changes_only_what_was_read() {
    let server = Server::all();
    let payload = payload("a.cn");
    let put = |headers: &[(&str, &str)]| {
        let headers = [&[("Content-Type", "application/json")], headers].concat();
        server.ask("PUT", "/persistence/a.cn", &headers, &payload)
    };
    for (target, method, body) in [
        ("/transpiler/a.cn", "PUT", PROGRAM),
        ("/transpiler/a.cn", "DELETE", ""),
        ("/persistence/a.cn", "DELETE", ""),
    ] {
        let made = server.keep("a.cn");
        let first = made.header("etag").to_owned();
        let csv = server.get("/output/a.cn").header("etag").to_owned();
        let ask = |tag: &str| server.ask(method, target, &[("If-Match", tag)], body.as_bytes()).status;
        for wrong in ["\"x\"", &format!("W/{first}"), "\"\"", "x", "\"x\", \"y\""] {
            assert_eq!(ask(wrong), 412, "{method} {target}, {wrong}");
        }
        assert!(matches!(ask(&format!("\"x\", {csv}")), 200 | 204), "{method} {target}");
        server.delete(target);
        assert_eq!(ask("*"), 404, "{method} {target}");
    }
    let first = server.keep("a.cn").header("etag").to_owned();
    let second = put(&[("If-Match", &first)]);
    assert_eq!(second.status, 204);
    assert_eq!(put(&[("If-Match", &first)]).status, 412);
    assert_eq!(put(&[("If-None-Match", "*")]).status, 400);
    assert_eq!(put(&[("If-Match", second.header("etag"))]).status, 204);
    assert_eq!(server.get("/persistence/a.cn").body, payload);
}

#[test]
fn a_list_comes_page_by_page() {
    let server = Server::all();
    let names = ["a", "b", "c%20d", "e", "f"];
    for name in names {
        server.keep(name);
    }
    for (address, limit, pages) in [
        ("/persistence", 2, 3),
        ("/transpiler", 1, 6),
        ("/persistence", 5, 2),
        ("/persistence", 6, 1),
        ("/persistence", 1000, 1),
    ] {
        let (mut seen, mut after, mut count) = (Vec::new(), String::new(), 0);
        loop {
            let page = server.get(&format!("{address}?limit={limit}&after={after}")).json();
            count += 1;
            for document in page["documents"].as_array().expect("documents") {
                assert_eq!(document["dialect"], "mach9");
                seen.push(document["prog_name"].as_str().expect("a name").replace(' ', "%20"));
            }
            let Some(next) = page["next"].as_str() else { break };
            after = next.replace(' ', "%20");
        }
        assert_eq!((seen, count), (names.map(str::to_owned).to_vec(), pages), "{address}, {limit}");
    }
    for wrong in ["limit=-1", "limit=x", "limit=1&limit=2", "before=a"] {
        assert_eq!(server.get(&format!("/persistence?{wrong}")).status, 400, "{wrong}");
    }
}
