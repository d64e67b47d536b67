//! Limits: of sizes, of time and of number. What is over a limit is told so, and what it held is free again.

use std::io::{Read, Write};
use std::net::Shutdown;
use std::time::{Duration, Instant};

use ncc_service::Limits;

use crate::client::{PROGRAM, Server, read_answer};

/// A few lines that make nine million moves.
pub(crate) const MOVES: &str =
    "%\nO1\nG21G90G17G40G80\n#1=0\nWHILE[#1LT9000000]DO1\nG1X#1F100.\n#1=#1+1\nEND1\nM30\n%\n";

/// A loop that never ends, and whose values differ in each iteration.
const ENDLESS: &str = "%\nO1\nG21G90G17G40G80\n#1=0\nWHILE[#1LT1]DO1\n#2=#2+1\nEND1\nM30\n%\n";

const LONG: &str = "/transpiler/long?dialect=fanuc";

fn threads() -> usize {
    std::thread::available_parallelism().map_or(2, usize::from)
}

/// Bytes of a program and of a document, as they are promised, and as they come.
#[test]
fn a_body_has_its_largest_size() {
    let server = Server::limited(Limits { largest: 20_000, ..Limits::default() });
    let largest = format!("{PROGRAM}{}", "\n".repeat(20_000 - PROGRAM.len()));
    let target = "/transpiler/a?dialect=mach9";
    assert_eq!(server.program("POST", target, &largest).status, 201);
    let promised = |bytes: u64| {
        let mut stream = server.connect();
        let head = format!(
            "POST {target} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nContent-Length: {bytes}\r\n\r\n",
            server.address
        );
        stream.write_all(head.as_bytes()).expect("a head");
        read_answer(&mut stream)
    };
    // It is told before its body comes.
    for bytes in [20_001, 1 << 40, 1 << 62] {
        let answer = promised(bytes);
        assert_eq!(answer.status, 413, "{bytes}: {}", answer.text());
        assert_eq!(answer.json()["detail"], "it takes 20000 bytes at most");
    }
    for (method, target) in [
        ("POST", "/persistence/b"),
        ("PUT", "/persistence/a"),
        ("PUT", "/transpiler/a"),
        ("PUT", "/api/v1/machines/m"),
    ] {
        let answer = chunks(&server, method, target, 20_001);
        assert_eq!(answer.0, 413, "{method} {target}: {}", answer.1);
    }
    assert_eq!(chunks(&server, "POST", "/persistence/b", 20_000).0, 422);
    // A document that would be larger than what was sent.
    let moves = server.program("POST", LONG, MOVES);
    assert_eq!(moves.status, 422);
    assert!(moves.text().contains("longer than 20000 bytes"), "{}", moves.text());
    assert!(server.is_well());
}

/// Sends chunks, so many bytes.
fn chunks(server: &Server, method: &str, target: &str, bytes: usize) -> (u16, String) {
    let mut stream = server.connect();
    let head = format!(
        "{method} {target} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nContent-Type: {media}\r\n\
         Transfer-Encoding: chunked\r\n\r\n",
        server.address,
        media = if target.starts_with("/transpiler") { "text/plain" } else { "application/json" },
    );
    stream.write_all(head.as_bytes()).expect("a head");
    let mut left = bytes;
    while left > 0 {
        let size = left.min(1000);
        let _ = write!(stream, "{size:x}\r\n{}\r\n", " ".repeat(size));
        left -= size;
    }
    let _ = stream.write_all(b"0\r\n\r\n");
    let answer = read_answer(&mut stream);
    (answer.status, answer.text())
}

/// What takes too long is stopped, and its thread does other work.
#[test]
fn work_has_its_time() {
    let server = Server::limited(Limits { work: Duration::from_millis(400), ..Limits::default() });
    let begun = Instant::now();
    let answers = std::thread::scope(|scope| {
        let all = (0..threads() * 2).map(|_| scope.spawn(|| server.program("POST", LONG, MOVES)));
        let all = all.collect::<Vec<_>>();
        all.into_iter().map(|one| one.join().expect("an answer")).collect::<Vec<_>>()
    });
    for answer in answers {
        assert_eq!(answer.status, 422, "{}", answer.text());
        assert_eq!(answer.json()["type"], "urn:ncc:problem:too-long");
    }
    server.keep("a");
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
    assert_eq!(server.get("/persistence/long").status, 404);
}

/// What was stopped before it was stored is not stored.
#[test]
fn what_was_stopped_is_not_stored() {
    let server = Server::limited(Limits { work: Duration::from_millis(1), ..Limits::default() });
    let mut payload = {
        let made = Server::all();
        made.keep("a");
        made.get("/persistence/a?form=ncc").json()
    };
    let blocks = vec![payload["blocks"][0].clone(); 40_000];
    payload["blocks"] = blocks.into();
    let answer = server.json("POST", "/persistence/a", payload.to_string().as_bytes());
    assert_eq!((answer.status, answer.json()["type"].as_str()), (422, Some("urn:ncc:problem:too-long")));
    assert_eq!(server.get("/persistence/a").status, 404);
}

/// A loop without end is found by its steps.
#[test]
fn a_loop_has_its_steps() {
    let server = Server::all();
    let answer = server.program("POST", LONG, ENDLESS);
    assert_eq!((answer.status, &answer.json()["diagnostics"][0]["code"]), (422, &"NC0227".into()));
    server.keep("a");
}

/// More than the queue holds is turned away, and told to come again.
#[test]
fn the_queue_has_its_length() {
    let limits = Limits { waiting: 1, work: Duration::from_secs(1), ..Limits::default() };
    let server = Server::limited(limits);
    let all = (0..threads() * 4).map(|_| server.send("POST", LONG, &[], MOVES.as_bytes()));
    let all = all.collect::<Vec<_>>();
    let answers = all.into_iter().map(|mut stream| read_answer(&mut stream)).collect::<Vec<_>>();
    let busy = answers.iter().filter(|answer| answer.status == 503).collect::<Vec<_>>();
    assert_eq!(busy.len(), threads() * 2, "{:?}", answers.iter().map(|own| own.status).collect::<Vec<_>>());
    assert!(busy.iter().all(|answer| answer.header("retry-after") == "1"), "{busy:?}");
    assert!(answers.iter().all(|answer| matches!(answer.status, 503 | 422)));
    server.keep("a");
}

/// A client that goes away takes its work with it, also work that waits.
#[test]
fn work_ends_with_its_client() {
    let server = Server::all();
    let begun = Instant::now();
    let all = (0..threads() * 3).map(|_| server.send("POST", LONG, &[], MOVES.as_bytes()));
    let all = all.collect::<Vec<_>>();
    std::thread::sleep(Duration::from_millis(300));
    drop(all);
    server.keep("a");
    assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
    assert_eq!(server.get("/persistence/long").status, 404);
}

/// A head that does not come in time ends its connection.
#[test]
fn a_head_has_its_time() {
    let server = Server::limited(Limits { head: Duration::from_millis(300), ..Limits::default() });
    for begun in ["", "GET", "GET /persistence HTTP/1.1\r\n", "GET /persistence HTTP/1.1\r\nHost: a\r\nX: "] {
        let mut stream = server.connect();
        stream.write_all(begun.as_bytes()).expect("a part of a head");
        let since = Instant::now();
        let mut rest = Vec::new();
        let _ = stream.read_to_end(&mut rest);
        assert!(since.elapsed() < Duration::from_secs(10), "{begun:?}");
        assert!(!String::from_utf8_lossy(&rest).contains(" 200 "), "{begun:?}");
    }
    // One letter at a time gives no more time.
    let mut stream = server.connect();
    let since = Instant::now();
    while stream.write_all(b"G").is_ok() && since.elapsed() < Duration::from_secs(10) {
        std::thread::sleep(Duration::from_millis(50));
    }
    assert!(since.elapsed() < Duration::from_secs(10));
    assert!(server.is_well());
}

/// A body that does not come in time is told so, and one that breaks off changes nothing.
#[test]
fn a_body_has_its_time() {
    let server = Server::limited(Limits { body: Duration::from_millis(500), ..Limits::default() });
    let head = format!(
        "POST /transpiler/a?dialect=mach9 HTTP/1.1\r\nHost: {}\r\nContent-Length: 1000\r\n\r\n{PROGRAM}",
        server.address
    );
    let all = (0..100).map(|_| {
        let mut stream = server.connect();
        stream.write_all(head.as_bytes()).expect("a part of a body");
        stream
    });
    let all = all.collect::<Vec<_>>();
    // Half requests hold no thread: others are answered meanwhile.
    server.keep("b");
    for mut stream in all {
        let answer = read_answer(&mut stream);
        assert_eq!((answer.status, answer.json()["type"].as_str()), (408, Some("urn:ncc:problem:too-slow")));
    }
    let mut stream = server.connect();
    stream.write_all(head.as_bytes()).expect("a part of a body");
    let _ = stream.shutdown(Shutdown::Write);
    let mut rest = String::new();
    let _ = stream.read_to_string(&mut rest);
    assert!(rest.is_empty() || rest.contains(" 400 "), "{rest}");
    assert_eq!(server.get("/persistence/a").status, 404);
}

/// All bodies together have their size; bytes that are promised do not count.
#[test]
fn bodies_have_their_size_together() {
    let server = Server::limited(Limits { bodies: 1_000_000, ..Limits::default() });
    let head = |bytes: usize| {
        format!("POST /transpiler/a HTTP/1.1\r\nHost: {}\r\nContent-Length: {bytes}\r\n\r\n", server.address)
    };
    let begin = |sent: usize| {
        let mut stream = server.connect();
        stream.write_all(head(900_000).as_bytes()).expect("a head");
        stream.write_all(&vec![b' '; sent]).expect("a part of a body");
        stream
    };
    let promises = (0..10).map(|_| begin(10)).collect::<Vec<_>>();
    let held = begin(800_000);
    std::thread::sleep(Duration::from_millis(300));
    let mut more = begin(300_000);
    let answer = {
        let mut first = [0; 12];
        more.read_exact(&mut first).expect("an answer");
        String::from_utf8_lossy(&first).into_owned()
    };
    assert_eq!(answer, "HTTP/1.1 503");
    server.keep("b");
    drop((promises, held, more));
    let since = Instant::now();
    let large = " ".repeat(800_000);
    loop {
        let status = server.json("POST", "/persistence/a", large.as_bytes()).status;
        if status == 422 {
            break;
        }
        assert!(status == 503 && since.elapsed() < Duration::from_secs(10), "{status}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// A client that does not read its answer loses it, and one that reads slowly does not.
#[test]
fn a_reader_has_its_time() {
    let server = Server::limited(Limits { reader: Duration::from_millis(300), ..Limits::default() });
    server.keep("a");
    let mut document = server.get("/persistence/a?form=whole").json();
    document["parts"]["cmf"] = "STOP_SPINDLE_TURNING()\n".repeat(1 << 20).into();
    let media = [("Content-Type", "application/vnd.ncc.document+json")];
    let put = server.ask("PUT", "/persistence/a", &media, document.to_string().as_bytes());
    assert_eq!(put.status, 204, "{}", put.text());
    let whole = server.get("/output/a?type=cmf").body.len();
    assert!(whole > 16 << 20, "more than the system keeps of a connection: {whole}");
    let read = |pause: Duration, step: usize| {
        let mut stream = server.send("GET", "/output/a?type=cmf", &[], b"");
        std::thread::sleep(pause);
        let (mut all, mut piece) = (0, vec![0; step]);
        while let Ok(bytes @ 1..) = stream.read(&mut piece) {
            all += bytes;
            std::thread::sleep(Duration::from_millis(2));
        }
        all
    };
    assert!(read(Duration::from_millis(1500), 1 << 20) < whole);
    assert!(read(Duration::ZERO, 1 << 17) > whole);
}
