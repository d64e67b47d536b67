//! Many different programs, imported and searched, to measure a search.
//!
//! ```text
//! search FILE-OR-URL PROGRAMS ROUNDS
//! ```
//!
//! The database is a new SQLite file or an empty database of a PostgreSQL server. Programs are made of the shapes that shops
//! have: drilled plates, pockets, faces, slots, callers of subprograms, for several controls, and some that are refused. Tells
//! how many are imported and executed a second, and for each search how long it took in ROUNDS rounds, with other values in
//! each. One program is translated, released and made stale at the end.

#![allow(clippy::print_stdout, reason = "its figures are for whoever calls it")]

use std::error::Error;
use std::io::{BufRead, BufReader, Cursor, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use ncc_service::{Entry, Import, Part, Place, Service};
use serde_json::{Value, json};

type Failed = Box<dyn Error + Send + Sync>;

/// Numbers by chance, the same in each run (a linear congruence of Knuth's MMIX).
struct Chance(u64);

impl Chance {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }

    fn of<'t>(&mut self, all: &[&'t str]) -> &'t str {
        all[self.below(all.len() as u64) as usize]
    }

    /// Millimetres with two digits, up to so many.
    fn mm(&mut self, most: u64) -> String {
        format!("{:.2}", self.below(most * 100) as f64 / 100.0)
    }
}

const PARTS: [&str; 12] = [
    "PLATE", "BRACKET", "FLANGE", "COVER", "HOUSING", "MANIFOLD", "LEVER", "CLAMP", "SPACER", "GRIPPER",
    "YOKE", "BASE",
];
const WORK: [&str; 10] =
    ["ROUGH", "FINISH", "SEMIFINISH", "SPOT", "DRILL", "REAM", "CHAMFER", "DEBURR", "PROBE", "ENGRAVE"];
const MATERIALS: [&str; 6] = ["C45", "1.4301", "ALMGSI1", "TI6AL4V", "POM", "CUZN39"];
const CUSTOMERS: [&str; 8] = ["MEYER", "ROSSI", "SILVA", "NOVAK", "TANAKA", "DUBOIS", "LARSEN", "SMITH"];

/// One operation with a tool.
fn operation(chance: &mut Chance, text: &mut String, tool: u64) {
    let work = chance.of(&WORK);
    *text += &format!(
        "({work} {} D{}.{})\nT{tool} M06\nS{} M03\n",
        chance.of(&PARTS),
        3 + tool,
        chance.below(10),
        500 + chance.below(8000)
    );
    let (x, y) = (chance.mm(500), chance.mm(300));
    *text += &format!("G00 X{x} Y{y}\nG43 Z50. H{tool} M08\n");
    let feed = 50 + chance.below(900);
    match chance.below(4) {
        0 => {
            let cycle = chance.of(&["G81", "G83", "G73", "G85", "G82"]);
            let more = match cycle {
                "G83" | "G73" => "Q2. ",
                "G82" => "P500 ",
                _ => "",
            };
            *text += &format!("G99 {cycle} X{x} Y{y} Z-{} R2. {more}F{feed}\n", chance.mm(40));
            for _ in 0..2 + chance.below(20) {
                *text += &format!("X{} Y{}\n", chance.mm(500), chance.mm(300));
            }
            *text += "G80\n";
        }
        1 => {
            *text += &format!("G01 Z-{} F{feed}\n", chance.mm(15));
            for _ in 0..4 + chance.below(30) {
                *text += &format!("G01 X{} Y{}\n", chance.mm(500), chance.mm(300));
            }
        }
        2 => {
            *text += &format!("G01 Z-{} F{feed}\nG91\n", chance.mm(8));
            for _ in 0..3 + chance.below(8) {
                *text += "G02 X10. Y10. I10. J0.\nG01 X5.\n";
            }
            *text += "G90\n";
        }
        _ => {
            *text += &format!("G01 Z-{} F{feed}\n", chance.mm(3));
            for row in 0..5 + chance.below(20) {
                let ends = if row % 2 == 0 { ["0.", "300."] } else { ["300.", "0."] };
                *text += &format!("X{} Y{row}0.\nX{}\n", ends[0], ends[1]);
            }
        }
    }
    *text += "G00 Z100. M09\nM05\n";
}

/// A program: its folder, its name, its dialect, its text.
fn program(chance: &mut Chance, number: u64) -> (String, String, &'static str, String) {
    let customer = chance.of(&CUSTOMERS);
    let folder = format!("{}/order-{}", customer.to_lowercase(), number / 100);
    let dialect = ["fanuc", "haas", "linuxcnc"][chance.below(3) as usize];
    // Every hundredth is a subprogram of its folder, which a tenth of the others call.
    if number.is_multiple_of(100) {
        let text = format!("%\nO{}\nG91\nG01 X{} F200.\nG90\nM99\n%\n", 8000 + number / 100, chance.mm(50));
        return (folder, format!("O{}.nc", 8000 + number / 100), "fanuc", text);
    }
    let part = chance.of(&PARTS);
    let mut text = format!(
        "%\nO{:04}\n({part} {number} {} FOR {customer})\nG21 G17 G90 G94 G54\n",
        1 + number % 7000,
        chance.of(&MATERIALS)
    );
    let mut tool = 0;
    for _ in 0..1 + chance.below(5) {
        tool += 1 + chance.below(5);
        operation(chance, &mut text, tool);
    }
    match chance.below(20) {
        0 => text += "G987 X1.\n",
        1 | 2 if dialect == "fanuc" => text += &format!("M98 P{}\n", 8000 + number / 100),
        _ => {}
    }
    text += "M30\n%\n";
    (folder, format!("{}-{number}.nc", part.to_lowercase()), dialect, text)
}

/// A client that keeps its connection.
struct Client {
    address: String,
    reader: BufReader<TcpStream>,
}

impl Client {
    fn at(address: &str) -> Result<Client, Failed> {
        let address = address.trim_start_matches("http://").to_owned();
        let stream = TcpStream::connect(&address)?;
        stream.set_nodelay(true)?;
        Ok(Client { address, reader: BufReader::new(stream) })
    }

    fn ask(&mut self, method: &str, target: &str, media: &str, body: &str) -> Result<Vec<u8>, Failed> {
        let mut head = format!("{method} {target} HTTP/1.1\r\nHost: {}\r\n", self.address);
        if !body.is_empty() {
            head += &format!("Content-Type: {media}\r\nContent-Length: {}\r\n", body.len());
        }
        self.reader.get_mut().write_all(format!("{head}\r\n{body}").as_bytes())?;
        let mut line = String::new();
        self.reader.read_line(&mut line)?;
        let status: u16 = line.split(' ').nth(1).unwrap_or_default().parse()?;
        let mut length = 0;
        loop {
            line.clear();
            self.reader.read_line(&mut line)?;
            let Some((name, value)) = line.trim_end().split_once(':') else { break };
            if name.eq_ignore_ascii_case("content-length") {
                length = value.trim().parse()?;
            }
        }
        let mut answer = vec![0; length];
        self.reader.read_exact(&mut answer)?;
        if status >= 300 {
            return Err(format!("{method} {target}: {status} {}", String::from_utf8_lossy(&answer)).into());
        }
        Ok(answer)
    }

    fn json(&mut self, method: &str, target: &str, body: &Value) -> Result<Value, Failed> {
        let body = if body.is_null() { String::new() } else { body.to_string() };
        Ok(serde_json::from_slice(&self.ask(method, target, "application/json", &body)?)?)
    }

    /// Waits until no program waits for its facts.
    fn settled(&mut self) -> Result<(), Failed> {
        while self.json("GET", "/api/v1/search?limit=1", &Value::Null)?["waiting"] != 0 {
            std::thread::sleep(Duration::from_millis(100));
        }
        Ok(())
    }
}

/// A search, with values by chance.
fn query(chance: &mut Chance, kind: usize) -> String {
    match kind {
        0 => "limit=100".to_owned(),
        1 => format!("text={}", chance.of(&WORK)),
        2 => format!("text={}+{}", chance.of(&MATERIALS), chance.of(&CUSTOMERS)),
        3 => format!("text={}+{}", chance.of(&PARTS), 1 + chance.below(9999)),
        4 => format!("text={}*", &chance.of(&PARTS)[..3]),
        5 => format!("code={}", chance.of(&["G81", "G83", "G73", "G02", "M98"])),
        6 => "code=G81&code=G02&code=M98".to_owned(),
        7 => format!("tool=T{}&tool=T{}", 1 + chance.below(9), 10 + chance.below(9)),
        8 => format!("time_min={}&time_max={}", 60 + chance.below(100), 200 + chance.below(100)),
        9 => format!(
            "fits=X{},Y{},Z{}",
            50 + chance.below(100),
            50 + chance.below(100),
            100 + chance.below(50)
        ),
        10 => format!("under={}&code=G81&dialect=haas", chance.of(&CUSTOMERS).to_lowercase()),
        11 => "refused=true".to_owned(),
        12 => "state=released".to_owned(),
        13 => format!("dialect=fanuc&x_max={}&text=drill", 100 + chance.below(300)),
        _ => format!("text={}&tool=T{}&time_max=30&refused=false", chance.of(&WORK), 1 + chance.below(20)),
    }
}

/// Searches of a round.
const KINDS: usize = 15;

fn at(times: &[Duration], part: usize) -> f64 {
    times.get(times.len().saturating_sub(1) * part / 100).copied().unwrap_or_default().as_secs_f64() * 1e3
}

/// Translates a program for a machine, releases it, and changes the machine.
fn story(client: &mut Client) -> Result<(), Failed> {
    let machine = |more: &str| format!("id = \"mill_7\"\ntitle = \"Mill 7\"\ndialect = \"haas\"\n{more}");
    client.ask("PUT", "/api/v1/machines/mill_7", "application/toml", &machine(""))?;
    let found =
        client.json("GET", "/api/v1/search?dialect=fanuc&refused=false&code=G81&limit=50", &Value::Null)?;
    let programs = found["programs"].as_array().cloned().unwrap_or_default();
    let translated = programs.iter().find_map(|program| {
        let asked = json!({ "program": program["id"], "machine_to": "mill_7", "assume": true });
        client.json("POST", "/api/v1/translations", &asked).ok()
    });
    let translated = translated.ok_or("none of the programs can be translated")?;
    let id = translated["id"].as_str().unwrap_or_default().to_owned();
    for state in ["in-review", "approved", "released"] {
        client.json("POST", &format!("/api/v1/translations/{id}/states"), &json!({ "state": state }))?;
    }
    let mut count = |query: &str| -> Result<usize, Failed> {
        let found = client.json("GET", &format!("/api/v1/search?{query}"), &Value::Null)?;
        Ok(found["programs"].as_array().map_or(0, Vec::len))
    };
    println!(
        "released: {}, of them stale: {}",
        count("state=released")?,
        count("state=released&stale=true")?
    );
    let begun = Instant::now();
    client.ask("PUT", "/api/v1/machines/mill_7", "application/toml", &machine("[rates]\nrapid = 9000\n"))?;
    client.settled()?;
    let found = client.json("GET", "/api/v1/search?state=released&stale=true", &Value::Null)?;
    println!(
        "its machine changed: after {:.0} ms {}",
        begun.elapsed().as_secs_f64() * 1e3,
        found["programs"][0]["translations"]
    );
    let told = client.json("GET", &format!("/api/v1/translations/{id}"), &Value::Null)?;
    println!("the translation says: state {}, stale {}", told["state"], told["stale"]);
    Ok(())
}

fn main() -> Result<(), Failed> {
    let arguments = std::env::args().skip(1).collect::<Vec<_>>();
    let [database, programs, rounds] = arguments.as_slice() else {
        return Err("search FILE-OR-URL PROGRAMS ROUNDS".into());
    };
    let (programs, rounds): (u64, usize) = (programs.parse()?, rounds.parse()?);
    let place = match database.starts_with("postgres") {
        true => Place::Server(database.clone()),
        false => Place::File(PathBuf::from(database)),
    };
    let mut chance = Chance(2026);
    let import = Import::open(&place, "load")?;
    let (begun, mut bytes) = (Instant::now(), 0);
    for number in 0..programs {
        let (folder, name, dialect, text) = program(&mut chance, number);
        bytes += text.len();
        let entry = Entry { folder: &folder, name: &name, dialect, machine: "" };
        import.put(&entry, &mut Cursor::new(text.into_bytes()))?;
    }
    let took = begun.elapsed().as_secs_f64();
    println!(
        "imported: {programs} programs, {bytes} bytes, {took:.1} s, {:.0} a second",
        programs as f64 / took
    );
    let service =
        Service::open(SocketAddr::from(([127, 0, 0, 1], 0)), &Part::All { database: place }, "load");
    let service = service.map_err(|error| format!("{error:?}"))?;
    let mut client = Client::at(&service.address())?;
    std::thread::spawn(move || service.serve());
    let begun = Instant::now();
    client.settled()?;
    let took = begun.elapsed().as_secs_f64();
    println!("facts: {took:.1} s, {:.0} programs a second", programs as f64 / took);
    let mut by_kind: Vec<Vec<Duration>> = vec![Vec::new(); KINDS];
    let mut last: Vec<(String, usize)> = vec![Default::default(); KINDS];
    for _ in 0..rounds {
        for kind in 0..KINDS {
            let query = query(&mut chance, kind);
            let begun = Instant::now();
            let answer = client.ask("GET", &format!("/api/v1/search?{query}"), "", "")?;
            by_kind[kind].push(begun.elapsed());
            let found: Value = serde_json::from_slice(&answer)?;
            last[kind] = (query, found["programs"].as_array().map_or(0, Vec::len));
        }
    }
    for (times, (query, found)) in by_kind.iter_mut().zip(&last) {
        times.sort_unstable();
        println!("p50 {:6.2} ms  p99 {:6.2} ms  {query} ({found} on the page)", at(times, 50), at(times, 99));
    }
    let mut all: Vec<Duration> = by_kind.concat();
    all.sort_unstable();
    println!(
        "all {} searches: p50 {:.2} ms, p99 {:.2} ms, longest {:.2} ms",
        all.len(),
        at(&all, 50),
        at(&all, 99),
        at(&all, 100)
    );
    story(&mut client)
}
