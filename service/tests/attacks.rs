//! What somebody might try who should not: each is sent as it stands, and the server answers others afterwards.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::client::{PROGRAM, Server, TABLE_10, read_answer};

/// What is sent after `{HOST}` has been replaced, and the answers that may come; 0 is the end of the connection.
type Sent = (&'static str, &'static str, &'static [u16]);

/// Requests that are not meant for this server, or are none.
const HEADS: &[Sent] = &[
    ("no Host", "GET /persistence HTTP/1.1\r\n\r\n", &[403]),
    ("HTTP 1.0 without Host", "GET /persistence HTTP/1.0\r\n\r\n", &[403]),
    ("an empty Host", "GET /persistence HTTP/1.1\r\nHost:\r\n\r\n", &[403]),
    ("another Host", "GET /persistence HTTP/1.1\r\nHost: example.com\r\n\r\n", &[403]),
    (
        "a Host that names this server in DNS",
        "GET /persistence HTTP/1.1\r\nHost: evil.example:80\r\n\r\n",
        &[403],
    ),
    ("a Host without the port", "GET /persistence HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n", &[403]),
    ("a Host with another port", "GET /persistence HTTP/1.1\r\nHost: localhost:1\r\n\r\n", &[403]),
    ("a Host with more behind", "GET /persistence HTTP/1.1\r\nHost: {HOST}.example.com\r\n\r\n", &[403]),
    ("a Host with a user", "GET /persistence HTTP/1.1\r\nHost: a@{HOST}\r\n\r\n", &[403]),
    ("two Hosts", "GET /persistence HTTP/1.1\r\nHost: {HOST}\r\nHost: example.com\r\n\r\n", &[403]),
    ("two Hosts of ours", "GET /persistence HTTP/1.1\r\nHost: {HOST}\r\nHost: {HOST}\r\n\r\n", &[403]),
    ("a Host that is no text", "GET /persistence HTTP/1.1\r\nHost: \u{ff}\r\n\r\n", &[403]),
    (
        "a foreign Origin",
        "GET /persistence HTTP/1.1\r\nHost: {HOST}\r\nOrigin: http://example.com\r\n\r\n",
        &[403],
    ),
    ("Origin null", "GET /persistence HTTP/1.1\r\nHost: {HOST}\r\nOrigin: null\r\n\r\n", &[403]),
    ("Origin of TLS", "GET /persistence HTTP/1.1\r\nHost: {HOST}\r\nOrigin: https://{HOST}\r\n\r\n", &[403]),
    (
        "two Origins",
        "GET /persistence HTTP/1.1\r\nHost: {HOST}\r\nOrigin: http://{HOST}\r\nOrigin: null\r\n\r\n",
        &[403],
    ),
    ("our Origin", "GET /persistence HTTP/1.1\r\nHost: {HOST}\r\nOrigin: http://{HOST}\r\n\r\n", &[200]),
    (
        "absolute form, another host",
        "GET http://example.com/persistence HTTP/1.1\r\nHost: {HOST}\r\n\r\n",
        &[403],
    ),
    (
        "absolute form, another Host",
        "GET http://{HOST}/persistence HTTP/1.1\r\nHost: example.com\r\n\r\n",
        &[403],
    ),
    ("absolute form, ours", "GET http://{HOST}/persistence HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[200]),
    ("absolute form, a file", "GET file:///etc/passwd HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[0, 400, 403, 404]),
    ("a way up", "GET /persistence/../../etc/passwd HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[404]),
    ("a way up, encoded", "GET /persistence/..%2f..%2fetc%2fpasswd HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[400]),
    (
        "a way up, encoded twice",
        "GET /persistence/..%252f..%252fetc%252fpasswd HTTP/1.1\r\nHost: {HOST}\r\n\r\n",
        &[404],
    ),
    (
        "a way up in OUTPUT",
        "GET /output/..%2f..%2fetc%2fpasswd&type=cmf HTTP/1.1\r\nHost: {HOST}\r\n\r\n",
        &[400],
    ),
    ("NUL in a name", "GET /persistence/a%00b HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[400]),
    ("lines in a name", "GET /persistence/a%0d%0aX:%20y HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[400]),
    ("SQL in a name", "GET /persistence/'%20OR%201=1-- HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[404]),
    (
        "SQL in a list",
        "GET /persistence?after='%20UNION%20SELECT%201-- HTTP/1.1\r\nHost: {HOST}\r\n\r\n",
        &[200],
    ),
    (
        "the highest limit of all",
        "GET /persistence?limit=4294967295 HTTP/1.1\r\nHost: {HOST}\r\n\r\n",
        &[200],
    ),
    (
        "a limit that is too high",
        "GET /persistence?limit=4294967296 HTTP/1.1\r\nHost: {HOST}\r\n\r\n",
        &[400],
    ),
    ("OPTIONS", "OPTIONS /persistence/a HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[405]),
    ("OPTIONS of all", "OPTIONS * HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[404]),
    (
        "a preflight",
        "OPTIONS /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nOrigin: http://example.com\r\nAccess-Control-Request-Method: PUT\r\n\r\n",
        &[403],
    ),
    ("TRACE", "TRACE /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nX: secret\r\n\r\n", &[405]),
    ("CONNECT", "CONNECT example.com:443 HTTP/1.1\r\nHost: example.com:443\r\n\r\n", &[403]),
    ("CONNECT to us", "CONNECT {HOST} HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[404, 405]),
    ("an unknown method", "BREW /persistence/a HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[405]),
    ("HEAD of nothing", "HEAD /persistence/a HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[404]),
    ("HTTP 2 at once", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", &[0, 400, 505]),
    ("HTTP 9", "GET / HTTP/9.9\r\nHost: {HOST}\r\n\r\n", &[0, 400, 505]),
    ("TLS", "\u{16}\u{3}\u{1}\u{2}\0\u{1}\0", &[0, 400]),
    ("no HTTP", "hello\r\n\r\n", &[0, 400]),
    ("a head that is folded", "GET /persistence HTTP/1.1\r\nHost: {HOST}\r\n X: y\r\n\r\n", &[0, 400, 403]),
    ("a space before the colon", "GET /persistence HTTP/1.1\r\nHost : {HOST}\r\n\r\n", &[0, 400]),
    (
        "two lengths",
        "POST /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\nxx",
        &[400],
    ),
    (
        "a length below 0",
        "POST /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nContent-Length: -1\r\n\r\n",
        &[400],
    ),
    (
        "a length that is no number",
        "POST /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nContent-Length: 0x10\r\n\r\n",
        &[400],
    ),
    (
        "a length beyond numbers",
        "POST /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nContent-Length: 99999999999999999999\r\n\r\n",
        &[400],
    ),
    (
        "a chunk without a size",
        "POST /transpiler/a?dialect=mach9 HTTP/1.1\r\nHost: {HOST}\r\nTransfer-Encoding: chunked\r\n\r\nx\r\n",
        &[0, 400],
    ),
    (
        "a chunk of the highest size",
        "POST /transpiler/a?dialect=mach9 HTTP/1.1\r\nHost: {HOST}\r\nTransfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\nM5",
        &[0, 400, 413],
    ),
    (
        "chunks within another coding",
        "POST /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nTransfer-Encoding: gzip\r\n\r\n",
        &[0, 400],
    ),
    (
        "a body that ends too soon",
        "POST /transpiler/a?dialect=mach9 HTTP/1.1\r\nHost: {HOST}\r\nContent-Length: 100\r\n\r\nT1M6\nM5\n",
        &[0, 400],
    ),
    (
        "a length and chunks",
        "POST /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nContent-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\nGET /x",
        &[400, 415],
    ),
    (
        "a body that waits for leave",
        "POST /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nExpect: 100-continue\r\nContent-Length: 5\r\n\r\n",
        &[0, 100, 400, 415],
    ),
    ("an address without end", "GET /{LONG} HTTP/1.1\r\nHost: {HOST}\r\n\r\n", &[414, 431, 404]),
    (
        "a header without end",
        "GET /persistence HTTP/1.1\r\nHost: {HOST}\r\nX: {LONG}{LONG}{LONG}{LONG}{LONG}\r\n\r\n",
        &[431],
    ),
    ("headers without end", "GET /persistence HTTP/1.1\r\nHost: {HOST}\r\n{MANY}\r\n", &[431]),
    (
        "tags without end",
        "DELETE /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nIf-Match: {TAGS}\r\n\r\n",
        &[404],
    ),
    (
        "lines in a tag",
        "DELETE /persistence/a HTTP/1.1\r\nHost: {HOST}\r\nIf-Match: \"a\rX: y\"\r\n\r\n",
        &[0, 400],
    ),
];

#[test]
fn a_head_that_should_not_be_has_no_effect() {
    let server = Server::all();
    let host = server.address.to_string();
    for (what, text, statuses) in HEADS {
        let text = text.replace("{HOST}", &host).replace("{LONG}", &"a".repeat(65_000));
        let text =
            text.replace("{MANY}", &"X: y\r\n".repeat(200)).replace("{TAGS}", &"\"x\", ".repeat(10_000));
        let bytes =
            text.chars().map(|sign| u8::try_from(u32::from(sign)).unwrap_or(b'?')).collect::<Vec<_>>();
        let answer = server.raw(&bytes);
        let status = answer.as_ref().map_or(0, |answer| answer.status);
        assert!(statuses.contains(&status), "{what}: {answer:?}");
        if let Ok(answer) = answer {
            let told = answer.text();
            assert!(!told.contains("root:") && !told.contains("secret"), "{what}: {told}");
            for name in ["x", "set-cookie", "access-control-allow-origin"] {
                assert_eq!(answer.header(name), "", "{what}");
            }
        }
        assert!(server.is_well(), "{what}");
    }
    assert_eq!(server.get("/persistence").json()["documents"].as_array().map(Vec::len), Some(0));
}

/// Programs that would read files of the server, or use it up.
#[test]
fn a_program_reads_no_file_of_the_server() {
    let server = Server::all();
    let file = "/etc/passwd";
    // A file of programs beside the server's own folder is not there for them either.
    for (what, dialect, text, found) in [
        ("M98 with a path", "fanuc", format!("O1\nM98 P{file}\nM30\n"), "NC0202"),
        ("M98 of a program that is absent", "fanuc", "O1\nM98 P9999\nM30\n".to_owned(), "NC0217"),
        ("G65 of a program that is absent", "fanuc", "O1\nG65 P9999 A1.\nM30\n".to_owned(), "NC0217"),
        ("M98 of a file", "haas", format!("O1\nM98 ({file})\nM30\n"), "NC0"),
        ("CALL", "siemens", format!("CALL \"{file}\"\nM30\n"), "NC0202"),
        ("EXTCALL", "siemens", format!("EXTCALL \"{file}\"\nM30\n"), "NC0217"),
        ("PCALL", "siemens", format!("PCALL {file}\nM30\n"), "NC0"),
        ("EXTERN", "siemens", "EXTERN PASSWD\nPASSWD\nM30\n".to_owned(), "NC0"),
        ("READ of a file", "siemens", format!("DEF STRING[99] A\nREAD(E,\"{file}\",1,1,A)\nM30\n"), "NC0"),
        ("a call by a path", "linuxcnc", "o<../../etc/passwd> call\nM2\n".to_owned(), "NC0217"),
        ("LOGOPEN", "linuxcnc", format!("(LOGOPEN,{file}.ncc)\n(LOG,x)\nG21 G1 X1 F100\nM2\n"), ""),
        ("an M code that runs a program", "linuxcnc", "M101 P1\nM2\n".to_owned(), "NC0"),
    ] {
        let target = format!("/transpiler/a?dialect={dialect}");
        let answer = server.program("POST", &target, &text);
        assert!(matches!(answer.status, 201 | 422), "{what}: {}", answer.text());
        assert!(answer.text().contains(found), "{what}: {}", answer.text());
        assert_eq!(answer.status == 201, found.is_empty(), "{what}: {}", answer.text());
        assert!(!answer.text().contains("root:"), "{what}: {}", answer.text());
        assert!(!std::path::Path::new("/etc/passwd.ncc").exists(), "{what}");
        server.delete("/transpiler/a");
    }
    for (name, value) in [
        ("machine", file),
        ("machine", "../../etc/passwd"),
        ("machine", "a"),
        ("dialect", file),
        ("model", file),
        ("start", "@/etc/passwd"),
        ("option", "o_word=@/etc/passwd"),
        ("units", file),
        ("tool_change_on", file),
        ("from", "mach9"),
    ] {
        let dialect = if name == "dialect" { "" } else { "dialect=mach9&" };
        let answer = server.program("POST", &format!("/transpiler/a?{dialect}{name}={value}"), PROGRAM);
        assert_eq!(answer.status, 400, "{name}={value}: {}", answer.text());
    }
    assert!(server.is_well());
}

/// Profiles that name files, or are made to be hard to read.
#[test]
fn a_profile_names_no_file_of_the_server() {
    let server = Server::all();
    let with = |more: &str| format!("{}, {more} }}", TABLE_10.trim_end_matches(" }"));
    let profile = |more: &str| format!("id = \"romi\"\ntitle = \"A mill\"\ndialect = \"fanuc\"\n{more}\n");
    let deep = "[".repeat(100_000);
    for (what, media, text, status) in [
        ("a dialect that is a file", "application/toml", profile("").replace("fanuc", "/etc/passwd"), 422),
        ("a base that is a file", "application/toml", profile("extends = \"/etc/passwd\""), 422),
        ("an include", "application/toml", profile("include = [\"/etc/passwd\"]"), 422),
        ("a key twice", "application/json", with("\"name\": \"romi\""), 422),
        ("a key that is unknown", "application/json", with("\"file\": \"/etc/passwd\""), 422),
        ("no number", "application/json", TABLE_10.replace("15000", "NaN"), 422),
        ("infinity", "application/json", TABLE_10.replace("15000", "1e999"), 422),
        ("below zero", "application/json", TABLE_10.replace("15000", "-15000"), 422),
        ("depth", "application/json", format!("{{\"name\":{deep}"), 422),
        ("depth in TOML", "application/toml", format!("a = {deep}"), 422),
        ("tables without end", "application/toml", format!("{} = 1", vec!["a"; 100_000].join(".")), 422),
        ("a large one", "application/toml", " ".repeat((1 << 20) + 1), 413),
        ("no text", "application/toml", String::from("\u{0}\u{1}"), 422),
        ("nothing", "application/json", String::new(), 422),
        ("another's name", "application/json", TABLE_10.replace("romi", "romi-discovery-4022"), 422),
    ] {
        let answer = server.ask("PUT", "/api/v1/machines/romi", &[("Content-Type", media)], text.as_bytes());
        assert_eq!(answer.status, status, "{what}: {}", answer.text());
        assert!(!answer.text().contains("root:"), "{what}: {}", answer.text());
        assert!(server.is_well(), "{what}");
    }
    let bytes = server.ask("PUT", "/api/v1/machines/romi", &[("Content-Type", "application/toml")], b"\xff");
    assert_eq!(bytes.status, 422);
    let taken = TABLE_10.replace("romi", "romi-discovery-4022");
    assert_eq!(server.json("PUT", "/api/v1/machines/romi-discovery-4022", taken.as_bytes()).status, 409);
    assert_eq!(server.get("/api/v1/machines/romi").status, 404);
}

/// Programs that are made to be hard to read.
#[test]
fn a_program_nests_no_deeper_than_the_stack() {
    let server = Server::all();
    let brackets = |of: usize| format!("O1\n#1={}1{}\nM30\n", "[".repeat(of), "]".repeat(of));
    let labels = (1..5000).map(|k| format!("o{k} if [1]\n")).collect::<String>();
    for (what, dialect, text, status) in [
        ("nothing", "fanuc", String::new(), 422),
        ("an empty line", "fanuc", "\n".to_owned(), 422),
        ("NUL", "fanuc", "\0".repeat(1000), 422),
        ("percent signs", "fanuc", "%\n".repeat(10_000), 422),
        ("brackets", "fanuc", brackets(2000), 201),
        ("more brackets", "fanuc", brackets(500_000), 422),
        ("minus signs", "fanuc", format!("O1\n#1={}1\nM30\n", "-".repeat(4000)), 201),
        (
            "brackets in an index",
            "linuxcnc",
            format!("#1={}1{}\nM2\n", "#[".repeat(1300), "]".repeat(1300)),
            422,
        ),
        ("functions", "fanuc", format!("O1\n#1={}1{}\nM30\n", "SIN[".repeat(600), "]".repeat(600)), 422),
        ("a long line", "siemens", format!("X={}1\nM30\n", "1+".repeat(1_000_000)), 422),
        ("structures", "linuxcnc", labels + "M2\n", 422),
        ("structures that never end", "siemens", "IF TRUE\n".repeat(20_000) + "M30\n", 422),
        ("calls of itself", "linuxcnc", "o1 sub\no1 call\no1 endsub\no1 call\nM2\n".to_owned(), 422),
        ("a jump to itself", "fanuc", "O1\nN1\nGOTO1\nM30\n".to_owned(), 422),
        ("a number without end", "fanuc", format!("O1\nG1X{}F1.\nM30\n", "9".repeat(4000)), 422),
        ("repeats without end", "fanuc", "O1\nG91G81X1.Z-1.R1.F1.K99999999\nM30\n".to_owned(), 422),
    ] {
        let answer = server.program("POST", &format!("/transpiler/a?dialect={dialect}"), &text);
        assert_eq!(answer.status, status, "{what}: {}", answer.text().get(..600).unwrap_or(&answer.text()));
        server.delete("/transpiler/a");
        assert!(server.is_well(), "{what}");
    }
    let binary = (0..=255).collect::<Vec<u8>>().repeat(100);
    let answer = server.ask("POST", "/transpiler/a?dialect=fanuc", &[], &binary);
    assert_eq!(answer.status, 422, "{}", answer.text());
    let answer = server.ask("POST", "/transpiler/a?dialect=fanuc", &[("Content-Encoding", "gzip")], b"M30\n");
    assert_eq!(answer.status, 415, "{}", answer.text());
}

/// Payloads that are made to be hard to read, or that lie.
#[test]
fn a_payload_that_lies_is_refused() {
    let server = Server::all();
    server.keep("a");
    let payload = server.get("/persistence/a?form=ncc").text();
    let deep = "[".repeat(100_000);
    let no_list = r#"{"machine":"","dialect":"mach9","parts":{}}"#.to_owned();
    let part = r#"{"machine":"","dialect":"mach9","parts":{"other":""}}"#.to_owned();
    let json = "application/json";
    let whole = "application/vnd.ncc.document+json";
    for (what, media, text, status) in [
        ("depth", json, deep.clone(), 422),
        (
            "depth in parameters",
            json,
            payload.replacen("\"parameters\":{}", &format!("\"parameters\":{deep}"), 1),
            422,
        ),
        ("a key twice", json, payload.replacen('{', "{\"prog_name\":\"a\",", 1), 422),
        ("a key that is unknown", json, payload.replacen('{', "{\"file\":\"/etc/passwd\",", 1), 422),
        ("no number", json, payload.replacen("\"tool\":1", "\"tool\":NaN", 1), 422),
        ("infinity", json, payload.replacen("\"x1\":0.0", "\"x1\":1e999", 1), 422),
        ("a tool below 0", json, payload.replacen("\"tool\":1", "\"tool\":-1", 1), 422),
        ("a tool beyond numbers", json, payload.replacen("\"tool\":1", "\"tool\":4294967296", 1), 422),
        ("a function that is unknown", json, payload.replacen("SELECT_TOOL", "__import__", 1), 422),
        ("text behind", json, format!("{payload}x"), 422),
        ("two payloads", json, format!("{payload}{payload}"), 422),
        ("half of it", json, payload[..payload.len() / 2].to_owned(), 422),
        ("half a sign", json, payload.replacen("\"dialect\": \"mach9", "\"dialect\": \"\\ud800", 1), 422),
        (
            "a long name of a machine",
            json,
            payload.replacen("\"machine_name\": \"", &format!("\"machine_name\": \"{}", "x".repeat(256)), 1),
            422,
        ),
        ("no part", whole, no_list, 422),
        ("a part that is unknown", whole, part, 422),
        ("a document that is a payload", whole, payload.clone(), 422),
        ("a payload as a form", "application/x-www-form-urlencoded", payload.clone(), 415),
        ("a payload as text", "text/plain", payload.clone(), 415),
    ] {
        assert!(text != payload || status == 415 || media == whole, "{what}: nothing was replaced");
        for (method, name) in [("POST", "b"), ("PUT", "a")] {
            let text = text.replace("\"prog_name\": \"a\"", &format!("\"prog_name\": \"{name}\""));
            let target = format!("/persistence/{name}");
            let answer = server.ask(method, &target, &[("Content-Type", media)], text.as_bytes());
            assert_eq!(answer.status, status, "{what}: {}", answer.text());
            assert!(server.is_well(), "{what}");
        }
    }
    let bytes = [payload.as_bytes(), b"\xff"].concat();
    assert_eq!(server.json("PUT", "/persistence/a", &bytes).status, 422);
    assert_eq!(server.get("/persistence/a?form=ncc").text(), payload);
    assert_eq!(server.get("/persistence/b").status, 404);
}

/// Of writers with one tag, one has its way.
#[test]
fn of_writers_with_one_tag_one_writes() {
    let server = Server::all();
    let mut tag = server.keep("a").header("etag").to_owned();
    for round in 0..10 {
        let texts = (0..8).map(|k| format!("T{}M6\nM5\n", 1 + round * 8 + k)).collect::<Vec<_>>();
        let all = texts
            .iter()
            .map(|text| server.send("PUT", "/transpiler/a", &[("If-Match", &tag)], text.as_bytes()));
        let all = all.collect::<Vec<_>>();
        let answers = all.into_iter().map(|mut stream| read_answer(&mut stream)).collect::<Vec<_>>();
        let won = answers.iter().filter(|answer| answer.status == 200).collect::<Vec<_>>();
        assert_eq!(won.len(), 1, "{answers:?}");
        assert_eq!(answers.iter().filter(|answer| answer.status == 412).count(), 7, "{answers:?}");
        tag = won[0].header("etag").to_owned();
        let there = server.get("/persistence/a");
        assert!(there.header("etag").starts_with(tag.trim_end_matches('"')));
    }
}

/// PUT, DELETE, POST and GET of one name at the same time: each answer is one that some order of them gives, and what is
/// read is whole.
#[test]
fn what_is_changed_at_once_stays_whole() {
    let server = Server::all();
    let texts = ["T1M6\nM5\n", "T2M6\nS100M3\nM5\n"];
    let wholes = texts.map(|text| {
        server.program("POST", "/transpiler/a?dialect=mach9", text);
        let whole = server.get("/persistence/a?form=whole").text();
        server.delete("/persistence/a");
        whole
    });
    let counts = std::thread::scope(|scope| {
        let worker = |of: usize| {
            let (server, wholes) = (&server, &wholes);
            move || {
                let mut counts = BTreeMap::<u16, i64>::new();
                for k in 0..25 {
                    let text = texts[(of + k) % 2];
                    let answers = [
                        server.program("PUT", "/transpiler/a?dialect=mach9", text),
                        server.program("POST", "/transpiler/a?dialect=mach9", text),
                        server.get("/persistence/a?form=whole"),
                        server.delete("/persistence/a"),
                    ];
                    let [put, post, get, delete] = answers;
                    assert!(matches!(put.status, 200 | 404), "{}", put.text());
                    assert!(matches!(post.status, 201 | 409), "{}", post.text());
                    assert!(matches!(delete.status, 204 | 404), "{}", delete.text());
                    match get.status {
                        200 => assert!(wholes.contains(&get.text()), "{}", get.text()),
                        status => assert_eq!(status, 404, "{}", get.text()),
                    }
                    *counts.entry(post.status).or_default() += 1;
                    *counts.entry(delete.status).or_default() += 1;
                }
                counts
            }
        };
        let all = (0..4).map(|of| scope.spawn(worker(of))).collect::<Vec<_>>();
        all.into_iter().fold(BTreeMap::<u16, i64>::new(), |mut all, one| {
            for (status, count) in one.join().expect("a worker") {
                *all.entry(status).or_default() += count;
            }
            all
        })
    });
    // Each document that was made was deleted once; one may be left.
    let left = i64::from(server.get("/persistence/a").status == 200);
    assert_eq!(
        counts.get(&201).copied().unwrap_or(0),
        counts.get(&204).copied().unwrap_or(0) + left,
        "{counts:?}"
    );
}

/// Half requests, many at once, hold no one else up.
#[test]
fn many_clients_that_say_nothing_hold_nobody_up() {
    use std::io::Write;
    let server = Server::all();
    let idle = (0..300).map(|k| {
        let mut stream = server.connect();
        let _ = stream
            .write_all(&b"POST /transpiler/a HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\n\r\n"[..k % 60]);
        stream
    });
    let idle = idle.collect::<Vec<_>>();
    let begun = std::time::Instant::now();
    server.keep("a");
    assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
    drop(idle);
    assert!(server.is_well());
}
