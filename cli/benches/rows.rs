//! What one line costs: long programs of one kind each, translated by the finished program, beside the plain one.
//! `cargo bench --bench rows` (Linux only); `NCC_ROWS_MB` is the size of each, `NCC_ROWS` names some of them, with commas,
//! by how they begin, `NCC_BINARY` another program to compare with, and `NCC_ROWS_KEEP` a folder that gets the programs
//! and nothing else happens (`.ci/peers`).
//!
//! A row tells MB of source a second of processor time, and the peak of memory.
//!
//! `NCC_COUNTS=compare` counts instructions instead, which do not depend on what else the machine does, of 1 MB each, by
//! valgrind, and holds them against `counts.tsv`, within 3 % (15 % where another compiler built the program);
//! `NCC_COUNTS=write` writes that table.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// A program for measuring.
struct Row {
    name: &'static str,
    from: &'static str,
    to: &'static str,
    /// Blocks behind the usual head.
    head: &'static str,
    /// What becomes of each plain move, `{}` in it; several are taken in turn.
    lines: &'static [&'static str],
    moves: Moves,
    foot: &'static str,
    verb: Verb,
}

/// The verb that is measured. `Verify` and `Diff` compare the source with its translation.
#[derive(Clone, Copy, PartialEq)]
enum Verb {
    Translate,
    /// A translation with its map of provenance.
    Map,
    Check,
    Time,
    Verify,
    Diff,
    /// The source with itself, as text.
    DiffText,
    Fmt,
}

#[derive(Clone, Copy, PartialEq)]
enum Moves {
    Lines,
    Arcs,
    Radius,
    Holes,
}

const PLAIN: Row = Row {
    name: "plain",
    from: "fanuc",
    to: "siemens",
    head: "",
    lines: &["{}"],
    moves: Moves::Lines,
    foot: "",
    verb: Verb::Translate,
};

const ROWS: &[Row] = &[
    PLAIN,
    Row { name: "plain numbered", lines: &["N{n} {}"], ..PLAIN },
    Row { name: "plain to haas", to: "haas", ..PLAIN },
    Row { name: "plain to linuxcnc", to: "linuxcnc", ..PLAIN },
    Row { name: "numbered mach9", from: "mach9", to: "fanuc", lines: &["N{n} {}"], ..PLAIN },
    Row {
        name: "kept: call",
        head: "M98 P2000\nG90 G54 G17 G21 G94 G40 G49 G80 G0 X0. Y0.\nG43 H1 Z50.",
        foot: "O2000\nG91\nG1 X1. F100\nG90\nM99",
        ..PLAIN
    },
    Row { name: "kept: variable", head: "#1=1.\nG1 X#1 F100", ..PLAIN },
    Row { name: "kept: loop", head: "#1=0\nWHILE[#1LT3]DO1\nG1 X#1 F100\n#1=#1+1\nEND1", ..PLAIN },
    Row { name: "kept: jump", head: "#1=1\nIF[#1EQ2]GOTO10\nG1 X1. F100\nN10 G1 X2.", ..PLAIN },
    Row {
        name: "kept: label",
        from: "siemens",
        to: "fanuc",
        head: "R1=1\nIF R1==2 GOTOF END_A\nG1 X1 F100\nEND_A: G1 X2",
        ..PLAIN
    },
    Row { name: "variable in each line", head: "#1=0.5", lines: &["{} F[500.+#1]"], ..PLAIN },
    Row {
        name: "other variables in each line",
        from: "siemens",
        to: "fanuc",
        head: "R1=0.5",
        lines: &["{} F=500+R{v}+R{w}"],
        ..PLAIN
    },
    Row { name: "arcs by centre", moves: Moves::Arcs, ..PLAIN },
    Row { name: "arcs by radius", moves: Moves::Radius, ..PLAIN },
    Row { name: "G0 and G1 in turn", head: "G1 F900", lines: &["G0 {}", "G1 {}"], ..PLAIN },
    Row { name: "comment in each line", lines: &["{} (PASS)"], ..PLAIN },
    Row { name: "comment, siemens", from: "siemens", to: "fanuc", lines: &["{} ; PASS"], ..PLAIN },
    Row { name: "skip in each line", lines: &["/{}"], ..PLAIN },
    Row {
        name: "skip, eight levels",
        lines: &["/1 {}", "/2 {}", "/3 {}", "/4 {}", "/5 {}", "/6 {}", "/7 {}", "/8 {}"],
        ..PLAIN
    },
    Row { name: "X= words, siemens", from: "siemens", to: "fanuc", lines: &["Y={y} {}"], ..PLAIN },
    Row { name: "rotary axis", head: "G0 A0.", lines: &["{} A{a}."], ..PLAIN },
    Row {
        name: "inverse-time feed",
        head: "G1 X0. Y0. F100\nG93",
        lines: &["{} F{f}."],
        foot: "G94",
        ..PLAIN
    },
    Row { name: "rotation", head: "G68 X0. Y0. R30.", foot: "G69", ..PLAIN },
    Row { name: "local shift", head: "G52 X10. Y5.", foot: "G52 X0. Y0.", ..PLAIN },
    Row { name: "G92 shift", head: "G92 X10. Y5.", ..PLAIN },
    Row { name: "TRANS", from: "siemens", to: "fanuc", head: "TRANS X10 Y5", foot: "TRANS", ..PLAIN },
    Row {
        name: "holes G81",
        head: "G99 G81 X1. Y1. Z-20. R2. F150",
        moves: Moves::Holes,
        foot: "G80",
        ..PLAIN
    },
    Row {
        name: "holes G83, ten pecks",
        head: "G99 G83 X1. Y1. Z-20. R2. Q2. F150",
        moves: Moves::Holes,
        foot: "G80",
        ..PLAIN
    },
    Row {
        name: "holes MCALL",
        from: "siemens",
        to: "fanuc",
        head: "F150\nMCALL CYCLE81(5,0,2,-20)",
        moves: Moves::Holes,
        foot: "MCALL",
        ..PLAIN
    },
    Row { name: "plain, with its map", verb: Verb::Map, ..PLAIN },
    Row { name: "plain, check", verb: Verb::Check, ..PLAIN },
    Row { name: "plain, time", verb: Verb::Time, ..PLAIN },
    Row { name: "plain, verify", verb: Verb::Verify, ..PLAIN },
    Row { name: "plain, diff", verb: Verb::Diff, ..PLAIN },
    Row { name: "plain, diff --text", verb: Verb::DiffText, ..PLAIN },
    Row { name: "plain, fmt", verb: Verb::Fmt, ..PLAIN },
];

fn heads(dialect: &str) -> [&'static str; 2] {
    match dialect {
        "siemens" => {
            ["G71 G17 G40 G90 G94\nT1 M6\nG54 G0 X0 Y0 D1 S12000 M3\nZ50 M8\n", "G0 Z50 M9\nM5\nM30\n"]
        }
        "mach9" => ["G99\nG90\nG71\nG17\nT1M6\nO1S2600M3\nG0X0.Y0.\n", "M5\nM2\n"],
        _ => [
            "%\nO1001\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S12000 M3\nG43 H1 Z50. M8\n",
            "G0 Z50. M9\nM5\nM30\n",
        ],
    }
}

/// Thousandths as a decimal: `12.345`, `-0.5`, `3.`
fn mm(thousandths: i64) -> String {
    let sign = if thousandths < 0 { "-" } else { "" };
    let (whole, part) = (thousandths.abs() / 1000, thousandths.abs() % 1000);
    format!("{sign}{whole}.{}", format!("{part:03}").trim_end_matches('0'))
}

fn text(row: &Row, bytes: usize) -> String {
    let mut rng = fastrand::Rng::with_seed(20_260_101);
    let [head, foot] = heads(row.from);
    let mut text = head.to_owned();
    let _ = writeln!(text, "{}", row.head);
    let (mut x, mut y, mut n) = (0i64, 0i64, 0u32);
    match row.moves {
        Moves::Lines => text += "G1 X0. Y0. Z0. F600.\n",
        Moves::Arcs | Moves::Radius => text += "G0 Z5.\nG1 Z-1. F500\n",
        Moves::Holes => {}
    }
    while text.len() < bytes {
        n += 1;
        let plain = match row.moves {
            Moves::Lines if row.lines[0].starts_with("G0") || n % 400 != 0 => {
                x += rng.i64(80..=450) * if n / 400 % 2 == 0 { 1 } else { -1 };
                let z = if n % 3 > 0 { format!(" Z{}", mm(rng.i64(-9000..=9000))) } else { String::new() };
                // With `Y=` in the line there is no other Y.
                let own = row.lines[0].contains("{y}") || n % 3 > 0;
                y += if own { 0 } else { rng.i64(1..=30) };
                let along = if own { String::new() } else { format!(" Y{}", mm(y)) };
                format!("X{}{along}{z}", mm(x))
            }
            Moves::Lines => {
                let feed = [800, 1200, 1800, 2500][rng.usize(0..4)];
                let _ = writeln!(text, "G0 Z5.\nX{} Y{}\nG1 Z0. F{feed}.", mm(x), mm(y));
                continue;
            }
            Moves::Arcs | Moves::Radius => {
                let radius = rng.i64(2000..=20_000);
                let code = rng.i32(2..=3);
                // A quarter, from the right of its centre to above or below it.
                let up = if code == 3 { radius } else { -radius };
                (x, y) = if x.abs() > 300_000 || y.abs() > 300_000 { (0, 0) } else { (x - radius, y + up) };
                match (x, y) {
                    (0, 0) => "G1 X0. Y0.".to_owned(),
                    _ if row.moves == Moves::Radius => {
                        format!("G{code} X{} Y{} R{}", mm(x), mm(y), mm(radius))
                    }
                    _ => format!("G{code} X{} Y{} I{} J0.", mm(x), mm(y), mm(-radius)),
                }
            }
            Moves::Holes => {
                format!("X{} Y{}", mm(rng.i64(-300_000..=300_000)), mm(rng.i64(-300_000..=300_000)))
            }
        };
        let line = row.lines[n as usize % row.lines.len()];
        let values = [
            ("{}", plain.as_str()),
            ("{n}", &(n % 99_990 * 10 + 10).to_string()),
            ("{a}", &(n as i64 % 360 - 180).abs().to_string()),
            ("{y}", &mm(i64::from(n % 90_000))),
            ("{v}", &(1 + n % 100).to_string()),
            ("{w}", &(1 + (n * 37 + n / 100) % 100).to_string()),
            ("{f}", &(10 + n % 50).to_string()),
        ];
        text += &values.iter().fold(line.to_owned(), |line, (key, value)| line.replace(key, value));
        text.push('\n');
    }
    // A subprogram stands behind the end.
    let behind = row.foot.starts_with('O');
    text += &if behind { format!("{foot}{}\n", row.foot) } else { format!("{}\n{foot}", row.foot) };
    text += if head.starts_with('%') { "%\n" } else { "" };
    text
}

/// The command line that translates a row.
fn translation(row: &Row, source: &Path, output: &Path) -> Vec<OsString> {
    let mut all: Vec<OsString> =
        ["translate", "--from", row.from, "--to", row.to, "--quiet", "-o"].map(OsString::from).to_vec();
    all.extend([output.into(), source.into()]);
    all
}

/// The command line of a row.
fn arguments(row: &Row, source: &Path, output: &Path) -> Vec<OsString> {
    let read = |dialect: &str, path: &Path| OsString::from(format!("{dialect}:{}", path.display()));
    let (ours, theirs) = (read(row.from, source), read(row.to, output));
    let verb = |words: &[&str], programs: &[&OsString]| {
        let words = words.iter().map(OsString::from);
        words.chain(programs.iter().map(|program| (*program).clone())).collect()
    };
    match row.verb {
        Verb::Translate => translation(row, source, output),
        Verb::Map => {
            let mut all = translation(row, source, output);
            all.extend(["--map".into(), output.with_extension("map").into()]);
            all
        }
        Verb::Check => verb(&["check"], &[&ours]),
        Verb::Time => verb(&["time", "--from", row.from], &[&source.into()]),
        Verb::Verify => verb(&["verify"], &[&ours, &theirs]),
        Verb::Diff => verb(&["diff"], &[&ours, &theirs]),
        Verb::DiffText => verb(&["diff", "--text"], &[&ours, &ours]),
        Verb::Fmt => verb(&["fmt"], &[&ours]),
    }
}

/// Writes the program of a row, and its translation where the verb takes two; gives the program's bytes.
fn prepare(
    binary: &str,
    row: &Row,
    bytes: usize,
    [source, output]: [&Path; 2],
) -> Result<usize, Box<dyn std::error::Error>> {
    let text = text(row, bytes);
    fs::write(source, &text)?;
    if matches!(row.verb, Verb::Verify | Verb::Diff) {
        Command::new(binary).args(translation(row, source, output)).status()?;
    }
    Ok(text.len())
}

/// Instructions that the program executes for a row.
fn count(binary: &str, row: &Row, source: &Path, output: &Path) -> Result<u64, Box<dyn std::error::Error>> {
    let done = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", binary])
        .args(arguments(row, source, output))
        .output()?;
    let said = String::from_utf8_lossy(&done.stderr);
    let collected = said.lines().find_map(|line| line.split_once("Collected : "));
    Ok(collected.ok_or_else(|| format!("valgrind counted nothing: {said}"))?.1.trim().parse()?)
}

/// What is kept of counts: the compiler of the program, and thousands of instructions of each row.
struct Counts {
    compiler: String,
    rows: BTreeMap<String, u64>,
}

impl Counts {
    fn read(text: &str) -> Counts {
        let mut lines = text.lines();
        let compiler = lines.next().and_then(|line| line.strip_prefix("# ")).unwrap_or_default().to_owned();
        let rows = lines.filter_map(|line| line.split_once('\t'));
        let rows = rows.filter_map(|(name, count)| Some((name.to_owned(), count.parse().ok()?)));
        Counts { compiler, rows: rows.collect() }
    }

    fn text(&self) -> String {
        let rows: String = self.rows.iter().map(|(name, count)| format!("{name}\t{count}\n")).collect();
        format!("# {}\n{rows}", self.compiler)
    }
}

/// Counts instructions of the rows, and compares them with the table or writes it anew.
fn counts(binary: &str, only: &str, write: bool) -> Result<(), Box<dyn std::error::Error>> {
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/counts.tsv");
    let before = Counts::read(&fs::read_to_string(&table).unwrap_or_default());
    let compiler = String::from_utf8(Command::new("rustc").arg("--version").output()?.stdout)?;
    let mut now = Counts { compiler: compiler.trim().to_owned(), rows: before.rows.clone() };
    let within = if now.compiler == before.compiler { 3.0 } else { 15.0 };
    let folder = tempfile::tempdir()?;
    let mut report = std::io::stdout().lock();
    let mut far = Vec::new();
    for row in ROWS.iter().filter(|row| only.split(',').any(|begin| row.name.starts_with(begin))) {
        let source = folder.path().join("source");
        let output = folder.path().join("output");
        prepare(binary, row, 1_000_000, [&source, &output])?;
        let count = count(binary, row, &source, &output)? / 1000;
        let change = before.rows.get(row.name).map(|before| (count as f64 / *before as f64 - 1.0) * 100.0);
        let told = change.map_or("new".to_owned(), |change| format!("{change:+.1} %"));
        writeln!(report, "{:<24} {count:>12} thousand instructions, {told}", row.name)?;
        if change.is_none_or(|change| change.abs() > within) {
            far.push(row.name);
        }
        now.rows.insert(row.name.to_owned(), count);
    }
    if write {
        return Ok(fs::write(&table, now.text())?);
    }
    match far.is_empty() {
        true => Ok(()),
        false => Err(format!("further than {within} % from counts.tsv: {}", far.join(", ")).into()),
    }
}

/// Writes the programs of the rows into a folder, for other tools to be measured by.
fn keep(folder: &Path, bytes: usize, only: &str) -> Result<(), Box<dyn std::error::Error>> {
    for row in ROWS.iter().filter(|row| only.split(',').any(|begin| row.name.starts_with(begin))) {
        let name: String = row.name.replace(|c: char| !c.is_ascii_alphanumeric(), "-");
        fs::write(folder.join(format!("{name}.{}", row.from)), text(row, bytes))?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let megabytes: f64 = std::env::var("NCC_ROWS_MB").map_or(Ok(4.0), |mb| mb.parse())?;
    let only = std::env::var("NCC_ROWS").unwrap_or_default();
    let binary = std::env::var("NCC_BINARY").unwrap_or_else(|_| env!("CARGO_BIN_EXE_ncc").to_owned());
    if let Ok(counted) = std::env::var("NCC_COUNTS") {
        return counts(&binary, &only, counted == "write");
    }
    if let Ok(folder) = std::env::var("NCC_ROWS_KEEP") {
        return keep(Path::new(&folder), (megabytes * 1e6) as usize, &only);
    }
    let folder = tempfile::tempdir()?;
    let mut report = std::io::stdout().lock();
    writeln!(report, "{:<24} {:<20} {:>8} {:>9}  exit", "row", "", "MB/s", "peak MiB")?;
    for row in ROWS.iter().filter(|row| only.split(',').any(|begin| row.name.starts_with(begin))) {
        let source = folder.path().join("source");
        let output = folder.path().join("output");
        let bytes = prepare(&binary, row, (megabytes * 1e6) as usize, [&source, &output])?;
        let done = run(&binary, row, &source, &output)?;
        let way = format!("{} to {}", row.from, row.to);
        let speed = bytes as f64 / 1e6 / done.seconds;
        let (name, peak, code) = (row.name, done.peak_kib as f64 / 1024.0, done.code);
        writeln!(report, "{name:<24} {way:<20} {speed:>8.1} {peak:>9.1}  {code}")?;
    }
    Ok(())
}

struct Done {
    seconds: f64,
    peak_kib: u64,
    code: i32,
}

/// Runs the program; its processor time is read when it has ended and before it is asked for its exit code.
fn run(binary: &str, row: &Row, source: &Path, output: &Path) -> Result<Done, Box<dyn std::error::Error>> {
    let mut child =
        Command::new(binary).args(arguments(row, source, output)).stdout(Stdio::null()).spawn()?;
    let mut peak_kib = 0;
    let seconds = loop {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id()))?;
        let high = status
            .lines()
            .find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse().ok());
        peak_kib = peak_kib.max(high.unwrap_or(0));
        let stat = fs::read_to_string(format!("/proc/{}/stat", child.id()))?;
        let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or("").split_whitespace().collect();
        if fields.first() == Some(&"Z") {
            let ticks: u64 = fields[11].parse::<u64>()? + fields[12].parse::<u64>()?;
            break ticks as f64 / 100.0;
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let code = child.wait()?.code().unwrap_or(-1);
    Ok(Done { seconds: seconds.max(0.01), peak_kib, code })
}
