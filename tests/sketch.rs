//! Random part programs, drawn as what the machine does and spelled in any of four dialects.
//!
//! Coordinates are whole micrometres, so that no spelling rounds; arcs are quarter turns, so that
//! their ends are exact.

use std::fmt::Write;

use proptest::collection::vec;
use proptest::prelude::*;

/// A piece of a program.
#[derive(Clone, Debug)]
#[allow(missing_docs)] // The names are the meaning; lengths are micrometres.
pub enum Piece {
    Rapid([Option<i32>; 3]),
    Feed([Option<i32>; 3], u16),
    /// A turn of so many quarters about a centre `radius` away in one of four directions.
    Arc {
        clockwise: bool,
        quarters: u8,
        towards: u8,
        radius: i32,
    },
    /// Kind 0 drill, 1 with dwell, 2 bore; R and depth below it.
    Holes {
        kind: u8,
        retract: i32,
        depth: i32,
        feed: u16,
        at: Vec<(i32, i32)>,
    },
    Dwell(u16),
    Coolant(u8),
    Tool(u8),
    Spindle(u16, u8),
    Stop(bool),
    Remark(String),
    /// Incremental words for the piece that follows.
    Incremental(Box<Piece>),
    /// Run only while the switch is off.
    Skipped([Option<i32>; 3]),
}

/// Pieces of a program.
pub fn pieces() -> impl Strategy<Value = Vec<Piece>> {
    vec(piece(), 1..20)
}

fn point() -> impl Strategy<Value = [Option<i32>; 3]> {
    let word = || {
        proptest::option::of(prop_oneof![
            Just(0),
            -200_000..200_000i32,
            (-200..200i32).prop_map(|v| v * 1000)
        ])
    };
    [word(), word(), word()]
}

fn piece() -> impl Strategy<Value = Piece> {
    let holes = (
        0..3u8,
        -5_000..15_000i32,
        1..30_000i32,
        1..900u16,
        vec((-99_000..99_000i32, -99_000..99_000i32), 1..5),
    );
    prop_oneof![
        4 => point().prop_map(Piece::Rapid),
        4 => (point(), 1..3000u16).prop_map(|(p, f)| Piece::Feed(p, f)),
        2 => (any::<bool>(), 1..5u8, 0..4u8, 1..40_000i32)
            .prop_map(|(clockwise, quarters, towards, radius)| Piece::Arc { clockwise, quarters, towards, radius }),
        2 => holes.prop_map(|(kind, retract, depth, feed, at)| Piece::Holes { kind, retract, depth, feed, at }),
        1 => (1..9999u16).prop_map(Piece::Dwell),
        1 => (0..3u8).prop_map(Piece::Coolant),
        1 => (1..40u8).prop_map(Piece::Tool),
        1 => (1..9999u16, 0..3u8).prop_map(|(s, d)| Piece::Spindle(s, d)),
        1 => any::<bool>().prop_map(Piece::Stop),
        1 => "[A-Z0-9 .,=+*/-]{0,20}".prop_map(Piece::Remark),
        1 => (point(), 1..3000u16).prop_map(|(p, f)| Piece::Incremental(Box::new(Piece::Feed(p, f)))),
        1 => point().prop_map(|p| Piece::Incremental(Box::new(Piece::Rapid(p)))),
        1 => point().prop_map(Piece::Skipped),
    ]
}

/// A number of micrometres in millimetres, with a point.
pub fn number(micrometres: i32) -> String {
    let (whole, part) = (micrometres.unsigned_abs() / 1000, micrometres.unsigned_abs() % 1000);
    let sign = if micrometres < 0 { "-" } else { "" };
    let text = format!("{sign}{whole}.{part:03}");
    text.trim_end_matches('0').to_owned()
}

/// Dialects in which sketches are spelled.
pub const SPELLED: [&str; 4] = ["mach9", "fanuc", "siemens", "linuxcnc"];

#[derive(Clone, Copy, PartialEq, Eq)]
enum Control {
    Mach9,
    Fanuc,
    Sinumerik,
    LinuxCnc,
}

impl Control {
    /// One of three spellings; LinuxCNC's is the third.
    fn say<T>(self, mach9: T, fanuc: T, sinumerik: T) -> T {
        match self {
            Control::Mach9 => mach9,
            Control::Fanuc => fanuc,
            Control::Sinumerik | Control::LinuxCnc => sinumerik,
        }
    }
}

/// Spells a program in one of [`SPELLED`].
///
/// # Panics
/// It is another dialect.
pub fn spell(pieces: &[Piece], dialect: &str) -> String {
    let control = match dialect {
        "mach9" => Control::Mach9,
        "fanuc" => Control::Fanuc,
        "siemens" => Control::Sinumerik,
        "linuxcnc" => Control::LinuxCnc,
        other => panic!("sketches are not spelled in {other}"),
    };
    let sinumerik = "G710 G17 G90 G40 G94\nG54\nT1 M6\nD1\nS500 M3\nG0 X0 Y0\nZ20\n";
    let linuxcnc = "G21 G17 G90 G40 G49 G80 G94 G91.1\nG54 G92.1\nT1 M6\nG43 H1\nS500 M3\nG0 X0 Y0\nZ20\n";
    let mut out = String::from(control.say(
        "G99\nG90\nG71\nG17\nT1M6\nO1S500M3\nG0X0.Y0.\nZ20.\n",
        "%\nO0007\nG21 G17 G90 G40 G49 G80 G94\nG54\nT1 M06\nS500 M03\nG00 X0. Y0.\nG43 Z20. H1\n",
        if control == Control::LinuxCnc { linuxcnc } else { sinumerik },
    ));
    let mut at = [0, 0, 20_000];
    for piece in pieces {
        one(piece, control, false, &mut at, &mut out);
    }
    out.push_str(control.say("G0Z50.\nM5\nM9\nM2\n", "G00 Z50. M05\nM09\nM30\n%\n", "G0 Z50\nM5\nM9\nM30\n"));
    out
}

fn words(point: &[Option<i32>; 3], incremental: bool, at: &mut [i32; 3], control: Control) -> String {
    let mut text = String::new();
    for (axis, letter) in ["X", "Y", "Z"].iter().enumerate() {
        if let Some(value) = point[axis] {
            at[axis] = if incremental { at[axis] + value } else { value };
            let blank = control.say("", " ", " ");
            let _ = write!(text, "{blank}{letter}{}", number(value));
        }
    }
    text
}

fn one(piece: &Piece, control: Control, incremental: bool, at: &mut [i32; 3], out: &mut String) {
    let _ = match piece {
        Piece::Rapid(p) => {
            writeln!(out, "{}{}", control.say("G0", "G00", "G0"), words(p, incremental, at, control))
        }
        Piece::Feed(p, f) => {
            let (code, words) = (control.say("G1", "G01", "G1"), words(p, incremental, at, control));
            let (blank, point) = control.say(("", ""), (" ", "."), (" ", ""));
            writeln!(out, "{code}{words}{blank}F{f}{point}")
        }
        Piece::Arc { clockwise, quarters, towards, radius } => {
            let (sin, cos) = [(0, 1), (1, 0), (0, -1), (-1, 0)][usize::from(*towards % 4)];
            let (i, j) = (cos * radius, sin * radius);
            let centre = (at[0] + i, at[1] + j);
            let (mut x, mut y) = (-i, -j);
            for _ in 0..*quarters {
                (x, y) = if *clockwise { (y, -x) } else { (-y, x) };
            }
            (at[0], at[1]) = (centre.0 + x, centre.1 + y);
            let g = if *clockwise { 2 } else { 3 };
            let (x, y) = (number(at[0]), number(at[1]));
            match control {
                Control::Fanuc => {
                    writeln!(out, "G0{g} X{x} Y{y} I{} J{} F300.", number(i), number(j))
                }
                Control::Sinumerik | Control::LinuxCnc => {
                    writeln!(out, "G{g} X{x} Y{y} I{} J{} F300", number(i), number(j))
                }
                Control::Mach9 => {
                    writeln!(out, "G{g}X{x}Y{y}I{}J{}F300", number(centre.0), number(centre.1))
                }
            }
        }
        Piece::Holes { kind, retract, depth, feed, at: places } => {
            holes(control, *kind % 3, [*retract, retract - depth], *feed, places, out);
            let last = places.last().copied().unwrap_or((at[0], at[1]));
            *at = [last.0, last.1, *retract];
            writeln!(out, "{}", if control == Control::Sinumerik { "MCALL" } else { "G80" })
        }
        Piece::Dwell(ms) => match control {
            Control::Fanuc => writeln!(out, "G04 P{ms}"),
            Control::Mach9 => writeln!(out, "G4D{}", number(i32::from(*ms))),
            Control::Sinumerik => writeln!(out, "G4 F{}", number(i32::from(*ms))),
            Control::LinuxCnc => writeln!(out, "G4 P{}", number(i32::from(*ms))),
        },
        Piece::Coolant(n) => writeln!(out, "{}{}", control.say("M", "M0", "M"), 7 + n % 3),
        Piece::Tool(t) => {
            at[2] = 30_000;
            match control {
                Control::Fanuc => writeln!(out, "M05\nT{t} M06\nG00 G43 Z30. H{t}"),
                Control::Mach9 => writeln!(out, "M5\nT{t}M6\nG0Z30.O{t}"),
                Control::Sinumerik => writeln!(out, "M5\nT{t} M6\nG0 Z30"),
                Control::LinuxCnc => writeln!(out, "M5\nT{t} M6\nG43 H{t}\nG0 Z30"),
            }
        }
        Piece::Spindle(s, d) => {
            let d = 3 + d % 3;
            writeln!(out, "S{s}{}{d}", control.say("M", " M0", " M"))
        }
        Piece::Stop(optional) => {
            writeln!(out, "{}{}", control.say("M", "M0", "M"), u8::from(*optional))
        }
        Piece::Remark(text) => match control {
            Control::Fanuc => writeln!(out, "({text})"),
            Control::Mach9 | Control::Sinumerik | Control::LinuxCnc => writeln!(out, ";{text}"),
        },
        Piece::Incremental(piece) => {
            let _ = writeln!(out, "G91");
            one(piece, control, true, at, out);
            writeln!(out, "G90")
        }
        Piece::Skipped(p) => {
            // Where the axes stand depends on the switch, so all three are named again.
            let mut there = *at;
            let words = words(p, false, &mut there, control);
            let (up, code, on) = control.say(
                ("G0Z40.", "G0", "G0X1.Y2.Z40."),
                ("G00 Z40.", "G00", "G00 X1. Y2. Z40."),
                ("G0 Z40", "G0", "G0 X1 Y2 Z40"),
            );
            *at = [1_000, 2_000, 40_000];
            writeln!(out, "{up}\n/{code}{words}\n{on}")
        }
    };
}

/// The call of a cycle and its positions. Kind 0 drill, 1 with dwell, 2 bore.
fn holes(control: Control, kind: u8, levels: [i32; 2], feed: u16, places: &[(i32, i32)], out: &mut String) {
    let kind = usize::from(kind);
    let [r, z] = levels.map(number);
    let g = [81, 82, 85][kind];
    let call = match control {
        Control::Mach9 => format!("G0Z20.\nG{g}Z{z}R{r}{}F{feed}\n", ["", "D.25", ""][kind]),
        Control::Fanuc => format!("G00 Z20.\nG99 G{g} "),
        Control::LinuxCnc => format!("G0 Z20\nG99 G{g} "),
        Control::Sinumerik => {
            let more = ["".to_owned(), ",,0.25".to_owned(), format!(",,,{feed},{feed}")];
            format!("G0 Z20\nF{feed}\nMCALL CYCLE{g}({r},{r},0,{z}{})\n", more[kind])
        }
    };
    out.push_str(&call);
    for (index, (x, y)) in places.iter().enumerate() {
        let blank = control.say("", " ", " ");
        let _ = write!(out, "X{}{blank}Y{}", number(*x), number(*y));
        if control == Control::Fanuc && index == 0 {
            let _ = write!(out, " Z{z} R{r}{} F{feed}.", ["", " P250", ""][kind]);
        }
        if control == Control::LinuxCnc && index == 0 {
            let _ = write!(out, " Z{z} R{r}{} F{feed}", ["", " P0.25", ""][kind]);
        }
        out.push('\n');
    }
}
