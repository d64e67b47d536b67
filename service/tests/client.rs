//! A server with a database of its own, and a client that sends any bytes.

use std::io::{self, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use ncc_service::{Hooks, Limits, Listen, Part, Place, Service};
use serde_json::Value;
use tempfile::TempDir;

/// How long a test waits for an answer.
const PATIENCE: Duration = Duration::from_secs(60);

/// How long a server says nothing that says no more.
const PAUSE: Duration = Duration::from_millis(300);

/// The machine file of table 10.
pub(crate) const TABLE_10: &str =
    r#"{ "name": "romi", "tool_change_time": 7, "max_feed": 15000, "start_spindle_time": 2 }"#;

/// A program of mach9 that takes 2 s and some.
pub(crate) const PROGRAM: &str = "T1M6\nS1000M3\nG0X1.Y2.Z3.\nG1X10.F100\nM5\n";

/// A server in this process. Its database goes with it.
pub(crate) struct Server {
    pub(crate) address: SocketAddr,
    place: Option<Place>,
    _folder: Option<TempDir>,
}

/// An answer.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) status: u16,
    /// Names in small letters.
    pub(crate) headers: Vec<(String, String)>,
    pub(crate) body: Vec<u8>,
}

impl Answer {
    pub(crate) fn header(&self, name: &str) -> &str {
        self.headers.iter().find(|(own, _)| own == name).map_or("", |(_, value)| value)
    }

    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    pub(crate) fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|e| panic!("{e}: {}", self.text()))
    }
}

/// The file of the repository.
pub(crate) fn repository(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// A database of its own: this file, or a new one of the server at `NCC_TEST_POSTGRES` (`postgres://user@host/database`),
/// where the same tests hold.
pub(crate) fn place(file: &Path) -> Place {
    static MADE: AtomicU32 = AtomicU32::new(0);
    let Ok(server) = std::env::var("NCC_TEST_POSTGRES") else { return Place::File(file.to_owned()) };
    let name = format!("ncc_{}_{}", std::process::id(), MADE.fetch_add(1, Ordering::Relaxed));
    let mut client = postgres::Client::connect(&server, postgres::NoTls).expect("the server of the tests");
    client.batch_execute(&format!("CREATE DATABASE {name}")).expect("a database");
    let (address, _) = server.rsplit_once('/').expect("an address with a database");
    Place::Server(format!("{address}/{name}"))
}

/// An address of this computer with any port that is free.
pub(crate) fn here() -> SocketAddr {
    SocketAddr::from(([127, 0, 0, 1], 0))
}

impl Server {
    pub(crate) fn all() -> Server {
        Server::limited(Limits::default())
    }

    pub(crate) fn limited(limits: Limits) -> Server {
        let folder = tempfile::tempdir().expect("a folder");
        let part = Part::All { database: place(&folder.path().join("ncc.sqlite")) };
        Server { _folder: Some(folder), ..Server::of(&part, limits) }
    }

    /// One that has a part alone.
    pub(crate) fn of(part: &Part, limits: Limits) -> Server {
        Server::at(here(), part, limits)
    }

    /// One that listens in another way.
    pub(crate) fn at(listen: impl Into<Listen>, part: &Part, limits: Limits) -> Server {
        Server::with_hooks(listen, part, limits, &Hooks::default())
    }

    /// One that may tell these targets of events.
    pub(crate) fn telling(targets: &[String], limits: Limits) -> Server {
        let folder = tempfile::tempdir().expect("a folder");
        let part = Part::All { database: place(&folder.path().join("ncc.sqlite")) };
        let hooks = Hooks { targets: targets.to_vec(), authorities: None };
        Server { _folder: Some(folder), ..Server::with_hooks(here(), &part, limits, &hooks) }
    }

    /// One with hooks that listens in another way.
    pub(crate) fn with_hooks(
        listen: impl Into<Listen>,
        part: &Part,
        limits: Limits,
        hooks: &Hooks,
    ) -> Server {
        let service = Service::with_limits(listen, part, "ana", limits);
        let service = service.and_then(|service| service.with_hooks(hooks));
        let service = service.unwrap_or_else(|error| panic!("no server: {error:?}"));
        let address = service.address();
        let address = address.split_once("://").and_then(|(_, address)| address.parse().ok());
        let place = match part {
            Part::All { database } | Part::Persistence { database } => Some(database.clone()),
            _ => None,
        };
        // It serves until the process of the tests ends.
        std::thread::spawn(move || service.serve());
        Server { address: address.expect("an address"), place, _folder: None }
    }

    /// The place of its database.
    pub(crate) fn place(&self) -> Place {
        self.place.clone().expect("a store")
    }

    /// Changes its database behind its back.
    ///
    /// # Errors
    /// The words of the database.
    pub(crate) fn sql(&self, sql: &str) -> Result<(), String> {
        match self.place() {
            Place::File(path) => rusqlite::Connection::open(path)
                .and_then(|file| {
                    file.busy_timeout(PATIENCE)?;
                    file.execute_batch(sql)
                })
                .map_err(|error| error.to_string()),
            Place::Server(address) => postgres::Client::connect(&address, postgres::NoTls)
                .and_then(|mut client| client.batch_execute(sql))
                .map_err(|error| format!("{error:?}")),
        }
    }

    /// The first column of rows of its database.
    pub(crate) fn select(&self, sql: &str) -> Vec<String> {
        match self.place() {
            Place::File(path) => {
                let file = rusqlite::Connection::open(path).expect("the file");
                let mut select = file.prepare(sql).expect("a statement");
                let rows = select.query_map([], |row| row.get::<_, String>(0)).expect("rows");
                rows.map(|row| row.expect("a text")).collect()
            }
            Place::Server(address) => {
                let mut client = postgres::Client::connect(&address, postgres::NoTls).expect("the server");
                client.query(sql, &[]).expect("rows").iter().map(|row| row.get(0)).collect()
            }
        }
    }

    /// A connection.
    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address).expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a limit");
        stream.set_write_timeout(Some(PATIENCE)).expect("a limit");
        stream
    }

    /// Sends a request with a `Host`, and with `Content-Length` where it has a body.
    pub(crate) fn ask(&self, method: &str, target: &str, headers: &[(&str, &str)], body: &[u8]) -> Answer {
        read_answer(&mut self.send(method, target, headers, body))
    }

    /// Sends a request; the answer is still to be read.
    pub(crate) fn send(
        &self,
        method: &str,
        target: &str,
        headers: &[(&str, &str)],
        body: &[u8],
    ) -> TcpStream {
        let mut head =
            format!("{method} {target} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n", self.address);
        for (name, value) in headers {
            head += &format!("{name}: {value}\r\n");
        }
        if !body.is_empty() || matches!(method, "POST" | "PUT") {
            head += &format!("Content-Length: {}\r\n", body.len());
        }
        let mut stream = self.connect();
        stream.write_all(format!("{head}\r\n").as_bytes()).expect("the head is sent");
        // A server that refuses a body does not read it to its end.
        let _ = stream.write_all(body);
        stream
    }

    pub(crate) fn get(&self, target: &str) -> Answer {
        self.ask("GET", target, &[], b"")
    }

    pub(crate) fn delete(&self, target: &str) -> Answer {
        self.ask("DELETE", target, &[], b"")
    }

    /// Sends a program.
    pub(crate) fn program(&self, method: &str, target: &str, text: &str) -> Answer {
        self.ask(method, target, &[("Content-Type", "text/plain")], text.as_bytes())
    }

    /// Sends JSON.
    pub(crate) fn json(&self, method: &str, target: &str, body: &[u8]) -> Answer {
        self.ask(method, target, &[("Content-Type", "application/json")], body)
    }

    /// Sends bytes as they are, and reads what comes back until the server ends the connection, or says no more.
    pub(crate) fn raw(&self, bytes: &[u8]) -> io::Result<Answer> {
        let mut stream = self.connect();
        stream.set_read_timeout(Some(PAUSE)).expect("a limit");
        let _ = stream.write_all(bytes);
        answer(&mut stream)
    }

    /// Puts in the machine of table 10.
    pub(crate) fn romi(&self) -> Answer {
        self.json("PUT", "/api/v1/machines/romi", TABLE_10.as_bytes())
    }

    /// Keeps a program.
    pub(crate) fn keep(&self, name: &str) -> Answer {
        let made = self.program("POST", &format!("/transpiler/{name}?dialect=mach9"), PROGRAM);
        assert_eq!(made.status, 201, "{name}: {}", made.text());
        made
    }

    /// Whether it answers.
    pub(crate) fn is_well(&self) -> bool {
        self.get("/persistence?limit=1").status == 200
    }
}

/// Reads an answer to the end of its connection.
pub(crate) fn read_answer(stream: &mut TcpStream) -> Answer {
    answer(stream).expect("an answer")
}

fn answer(stream: &mut TcpStream) -> io::Result<Answer> {
    let mut all = Vec::new();
    let end = stream.read_to_end(&mut all);
    let broken = || io::Error::other("no answer");
    let head = all.windows(4).position(|four| four == b"\r\n\r\n");
    // A server that refuses a body may reset the connection after its answer.
    let head = head.ok_or_else(|| end.err().unwrap_or_else(broken))?;
    let text = String::from_utf8_lossy(&all[..head]).into_owned();
    let mut lines = text.lines();
    let status = lines.next().and_then(|line| line.split(' ').nth(1)?.parse().ok()).ok_or_else(broken)?;
    let headers = lines.filter_map(|line| line.split_once(':'));
    let headers = headers.map(|(name, value)| (name.to_ascii_lowercase(), value.trim().to_owned()));
    Ok(Answer { status, headers: headers.collect(), body: all[head + 4..].to_vec() })
}
