//! Random part programs, drawn as what the machine does and spelled in either word-address dialect.
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

/// Spells a program: Mach-9 or Fanuc.
pub fn spell(pieces: &[Piece], fanuc: bool) -> String {
    let mut out = match fanuc {
        true => String::from(
            "%\nO0007\nG21 G17 G90 G40 G49 G80 G94\nG54\nT1 M06\nS500 M03\nG00 X0. Y0.\nG43 Z20. H1\n",
        ),
        false => String::from("G99\nG90\nG71\nG17\nT1M6\nO1S500M3\nG0X0.Y0.\nZ20.\n"),
    };
    let mut at = [0, 0, 20_000];
    for piece in pieces {
        one(piece, fanuc, false, &mut at, &mut out);
    }
    out.push_str(if fanuc { "G00 Z50. M05\nM30\n%\n" } else { "G0Z50.\nM5\nM2\n" });
    out
}

fn words(point: &[Option<i32>; 3], incremental: bool, at: &mut [i32; 3], fanuc: bool) -> String {
    let mut text = String::new();
    for (axis, letter) in ["X", "Y", "Z"].iter().enumerate() {
        if let Some(value) = point[axis] {
            at[axis] = if incremental { at[axis] + value } else { value };
            let blank = if fanuc { " " } else { "" };
            let _ = write!(text, "{blank}{letter}{}", number(value));
        }
    }
    text
}

fn one(piece: &Piece, fanuc: bool, incremental: bool, at: &mut [i32; 3], out: &mut String) {
    let code = |f: &str, m: &str| if fanuc { f.to_owned() } else { m.to_owned() };
    let _ = match piece {
        Piece::Rapid(p) => writeln!(out, "{}{}", code("G00", "G0"), words(p, incremental, at, fanuc)),
        Piece::Feed(p, f) => {
            let feed = if fanuc { format!(" F{f}.") } else { format!("F{f}") };
            writeln!(out, "{}{}{feed}", code("G01", "G1"), words(p, incremental, at, fanuc))
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
            let end = (number(at[0]), number(at[1]));
            match fanuc {
                true => writeln!(out, "G0{g} X{} Y{} I{} J{} F300.", end.0, end.1, number(i), number(j)),
                false => {
                    writeln!(out, "G{g}X{}Y{}I{}J{}F300", end.0, end.1, number(centre.0), number(centre.1))
                }
            }
        }
        Piece::Holes { kind, retract, depth, feed, at: places } => {
            let (g, r, z) = ([81, 82, 85][usize::from(*kind % 3)], number(*retract), number(retract - depth));
            let _ = writeln!(out, "{}", code("G00 Z20.", "G0Z20."));
            if fanuc {
                let dwell = if *kind == 1 { " P250" } else { "" };
                for (index, (x, y)) in places.iter().enumerate() {
                    let _ = match index {
                        0 => writeln!(
                            out,
                            "G99 G{g} X{} Y{} Z{z} R{r}{dwell} F{feed}.",
                            number(*x),
                            number(*y)
                        ),
                        _ => writeln!(out, "X{} Y{}", number(*x), number(*y)),
                    };
                }
            } else {
                let dwell = if *kind == 1 { "D.25" } else { "" };
                let _ = writeln!(out, "G{g}Z{z}R{r}{dwell}F{feed}");
                for (x, y) in places {
                    let _ = writeln!(out, "X{}Y{}", number(*x), number(*y));
                }
            }
            let last = places.last().copied().unwrap_or((at[0], at[1]));
            *at = [last.0, last.1, *retract];
            writeln!(out, "G80")
        }
        Piece::Dwell(ms) => match fanuc {
            true => writeln!(out, "G04 P{ms}"),
            false => writeln!(out, "G4D{}", number(i32::from(*ms))),
        },
        Piece::Coolant(n) => writeln!(out, "{}{}", code("M0", "M"), 7 + n % 3),
        Piece::Tool(t) => {
            let _ = writeln!(out, "{}", code("M05", "M5"));
            let _ = writeln!(out, "{}", if fanuc { format!("T{t} M06") } else { format!("T{t}M6") });
            at[2] = 30_000;
            match fanuc {
                true => writeln!(out, "G00 G43 Z30. H{t}"),
                false => writeln!(out, "G0Z30.O{t}"),
            }
        }
        Piece::Spindle(s, d) => {
            let d = 3 + d % 3;
            writeln!(out, "S{s}{}{d}", code(" M0", "M"))
        }
        Piece::Stop(optional) => writeln!(out, "{}{}", code("M0", "M"), u8::from(*optional)),
        Piece::Remark(text) => match fanuc {
            true => writeln!(out, "({text})"),
            false => writeln!(out, ";{text}"),
        },
        Piece::Incremental(piece) => {
            let _ = writeln!(out, "G91");
            one(piece, fanuc, true, at, out);
            writeln!(out, "G90")
        }
        Piece::Skipped(p) => {
            // Where the axes stand depends on the switch, so all three are named again.
            let _ = writeln!(out, "{}", code("G00 Z40.", "G0Z40."));
            let mut there = *at;
            let _ = writeln!(out, "/{}{}", code("G00", "G0"), words(p, false, &mut there, fanuc));
            *at = [1_000, 2_000, 40_000];
            writeln!(out, "{}", code("G00 X1. Y2. Z40.", "G0X1.Y2.Z40."))
        }
    };
}
