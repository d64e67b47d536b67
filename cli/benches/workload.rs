//! Workloads for measuring: long programs of one kind each, the same from run to run.
//!
//! Shared by the benchmarks and the example that writes them to a file.

use std::fmt;
use std::io::{self, Write};

/// A kind of workload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Workload {
    /// Three-axis surfacing: short straight moves, words left out where nothing changes.
    Surfacing,
    /// Chained arcs with centre words from the start point.
    Arcs,
    /// Drilling with G81, G82 and G83, some dozens of holes a cycle.
    Drilling,
}

impl Workload {
    /// All of them.
    pub(crate) const ALL: [Workload; 3] = [Workload::Surfacing, Workload::Arcs, Workload::Drilling];

    /// Writes a Fanuc program of about `bytes` bytes.
    pub(crate) fn write(self, bytes: u64, into: &mut dyn Write) -> io::Result<()> {
        let mut text = Text { into, written: 0, number: 0 };
        let mut rng = fastrand::Rng::with_seed(20_260_101 + self as u64);
        match self {
            Workload::Surfacing => surfacing(&mut text, bytes, &mut rng)?,
            Workload::Arcs => arcs(&mut text, bytes, &mut rng)?,
            Workload::Drilling => drilling(&mut text, bytes, &mut rng)?,
        }
        text.line("M30")?;
        text.plain("%")
    }
}

/// Its name on a command line.
impl fmt::Display for Workload {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Workload::Surfacing => "surfacing",
            Workload::Arcs => "arcs",
            Workload::Drilling => "drilling",
        })
    }
}

struct Text<'w> {
    into: &'w mut dyn Write,
    written: u64,
    number: u32,
}

impl Text<'_> {
    fn plain(&mut self, line: &str) -> io::Result<()> {
        self.written += line.len() as u64 + 1;
        writeln!(self.into, "{line}")
    }

    fn line(&mut self, words: &str) -> io::Result<()> {
        self.number = if self.number >= 99_990 { 10 } else { self.number + 10 };
        let line = format!("N{} {words}", self.number);
        self.plain(&line)
    }

    fn head(&mut self, program: u32, tool: u32, speed: u32) -> io::Result<()> {
        self.plain("%")?;
        self.plain(&format!("O{program} (WORKLOAD)"))?;
        self.line("G21 G17 G40 G49 G80 G90 G94")?;
        self.line(&format!("T{tool} M6"))?;
        self.line(&format!("G54 G0 X0. Y0. S{speed} M3"))?;
        self.line(&format!("G43 H{tool} Z50. M8"))
    }
}

/// Thousandths of a millimetre as a decimal without needless zeros: `12.345`, `-0.5`, `3.`
fn mm(thousandths: i64) -> String {
    let sign = if thousandths < 0 { "-" } else { "" };
    let (whole, part) = (thousandths.abs() / 1000, thousandths.abs() % 1000);
    format!("{sign}{whole}.{}", format!("{part:03}").trim_end_matches('0'))
}

fn surfacing(text: &mut Text, bytes: u64, rng: &mut fastrand::Rng) -> io::Result<()> {
    text.head(1001, 1, 12_000)?;
    let (mut x, mut z, mut pass) = (0i64, 0i64, 0i64);
    while text.written < bytes {
        pass += 1;
        let mut y = pass * 137 % 200_000 - 100_000;
        let direction = if pass % 2 == 1 { 1 } else { -1 };
        text.line("G0 Z5.")?;
        text.line(&format!("X{} Y{}", mm(x), mm(y)))?;
        text.line(&format!("G1 Z{} F600", mm(z)))?;
        let mut feed = 600;
        for k in 0..400 {
            x += direction * rng.i64(80..=450);
            let wave = 9000.0 * (x as f64 / 23_000.0).sin() * (y as f64 / 31_000.0).cos();
            let next_z = wave as i64 + rng.i64(-40..=40);
            let next_y = y + [0, 0, 0, 0, 1, -1, 2][rng.usize(0..7)] * rng.i64(0..=30);
            let mut words = String::new();
            if k % 16 == 0 {
                words += "G1 ";
            }
            words += &format!("X{}", mm(x));
            if next_y != y || k % 16 == 0 {
                words += &format!(" Y{}", mm(next_y));
            }
            if next_z != z {
                words += &format!(" Z{}", mm(next_z));
            }
            (y, z) = (next_y, next_z);
            if k % 40 == 0 {
                let next = [800, 1200, 1800, 2500, 2500, 2500, 3200][rng.usize(0..7)];
                if next != feed {
                    words += &format!(" F{next}");
                    feed = next;
                }
            }
            text.line(&words)?;
        }
    }
    text.line("G0 Z50. M9")?;
    text.line("M5")
}

fn arcs(text: &mut Text, bytes: u64, rng: &mut fastrand::Rng) -> io::Result<()> {
    text.head(1002, 2, 8000)?;
    text.line("G0 Z5.")?;
    text.line("G1 Z-1. F500")?;
    let (mut x, mut y, mut code) = (0i64, 0i64, 1);
    while text.written < bytes {
        let radius = rng.i64(2000..=40_000) as f64;
        let sweep = 0.2 + 2.6 * rng.f64();
        let towards = std::f64::consts::TAU * rng.f64();
        let next_code = rng.i32(2..=3);
        let (i, j) = ((radius * towards.cos()).round() as i64, (radius * towards.sin()).round() as i64);
        let radius = (i as f64).hypot(j as f64);
        let start = (-j as f64).atan2(-i as f64);
        let end = if next_code == 3 { start + sweep } else { start - sweep };
        let next_x = x + i + (radius * end.cos()).round() as i64;
        let next_y = y + j + (radius * end.sin()).round() as i64;
        if next_x.abs() > 400_000 || next_y.abs() > 400_000 {
            (x, y, code) = (0, 0, 1);
            text.line("G1 X0. Y0.")?;
            continue;
        }
        let mut words = String::new();
        if next_code != code || rng.f64() < 0.3 {
            words += &format!("G{next_code} ");
        }
        words += &format!("X{} Y{} I{} J{}", mm(next_x), mm(next_y), mm(i), mm(j));
        if rng.f64() < 0.03 {
            words += &format!(" F{}", [400, 600, 900, 1500][rng.usize(0..4)]);
        }
        (x, y, code) = (next_x, next_y, next_code);
        text.line(&words)?;
    }
    text.line("G0 Z50. M9")
}

fn drilling(text: &mut Text, bytes: u64, rng: &mut fastrand::Rng) -> io::Result<()> {
    text.head(1003, 3, 3000)?;
    let mut cycles = 0;
    while text.written < bytes {
        cycles += 1;
        let depth = mm(-rng.i64(5000..=40_000));
        let (code, extra) = match rng.usize(0..3) {
            0 => (81, String::new()),
            1 => (82, " P500".to_owned()),
            _ => (83, format!(" Q{}", mm(rng.i64(1000..=4000)))),
        };
        let (x, y) = (mm(rng.i64(-300_000..=300_000)), mm(rng.i64(-300_000..=300_000)));
        let feed = [120, 180, 250][rng.usize(0..3)];
        text.line(&format!("G{} G{code} X{x} Y{y} Z{depth} R2.{extra} F{feed}", 98 + cycles % 2))?;
        for _ in 0..rng.usize(20..=60) {
            let which = rng.f64();
            let mut words = Vec::new();
            if which < 0.8 {
                words.push(format!("X{}", mm(rng.i64(-300_000..=300_000))));
            }
            if which > 0.3 {
                words.push(format!("Y{}", mm(rng.i64(-300_000..=300_000))));
            }
            text.line(&words.join(" "))?;
        }
        text.line("G80")?;
        text.line("G0 Z25.")?;
    }
    Ok(())
}
