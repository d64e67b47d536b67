//! Programs of the Sinumerik's language beside the repository, with the tables that another interpreter makes of
//! them: block by block, positions, feed, speed, tool, motion and M functions are the same. Says "skipped: …" where
//! they are absent.
//!
//! A row is a block of the peer's, with all that was said before. Rows that say the same as the row before are left out
//! on both sides, so that blocks without a word of these count as little as blank ones. What the peer accepts and a
//! control does not is refused by name; the rest of such a program is compared with those blocks mended.

use std::fs;

use ncc_exec::world::World;
use ncc_exec::{Exec, Runner};
use ncc_frontends::{Batch, Reader};
use ncc_ir::canon::{Axis, Turn};
use ncc_ir::diag::Gravity;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::ONE;
use ncc_ir::program::valid::leads_nowhere;
use ncc_ir::program::{Op, Point, Procedure, Program, Stmt};
use ncc_tests::expect::Failures;
use ncc_tests::translate::settings;

use crate::shared::beside;

/// Columns that are compared.
const COLUMNS: [&str; 11] = ["gg01_motion", "X", "Y", "Z", "A", "B", "C", "F", "S", "T", "M"];

/// A program that a control would not run as it is.
struct Mended {
    name: &'static str,
    /// Why it is refused, and a part of what is told.
    why: &'static str,
    told: &'static str,
    /// Pieces of its text, and what stands in their place to compare the rest; nothing is compared where the text
    /// is left as it is.
    by: &'static [(&'static str, &'static str)],
}

/// Programs that a control runs as they are.
const AS_THEY_ARE: [&str; 4] =
    ["actual_position", "case_insensitive_variables", "def_string", "logic_operators"];

const NO_FEED: &str = "G1 at power-on moves at feed, and no feed is said (alarm 10860)";

const MENDED: [Mended; 12] = [
    Mended {
        name: "arrays",
        why: "nn, m and o are not defined, and a name has two letters first",
        told: "Value(Undefined)",
        by: &[
            ("DEF INT FELD[", "DEF INT nn, mm, oo\nDEF INT FELD["),
            ("FOR nn", "F1000\nFOR nn"),
            ("FOR m=", "FOR mm="),
            ("FOR o=", "FOR oo="),
            ("FELD[nn,m,o] = nn*100+m*10+o", "FELD[nn,mm,oo] = nn*100+mm*10+oo"),
            ("X = FELD[nn,m,o]", "X = FELD[nn,mm,oo]"),
        ],
    },
    Mended { name: "basic_math", why: NO_FEED, told: "NoFeed", by: &[("X = 1+1", "F1000\nX = 1+1")] },
    Mended {
        name: "edge_cases",
        why: "axes ELX and E, names that are not defined, a subprogram that is not there, a definition behind blocks",
        told: "ELX",
        by: &[
            ("N10 G1 X1.5", "DEF REAL DEPTH = 2.5\nN10 G1 X1.5"),
            (" ELX=3087.022334", ""),
            ("E_MULTIPLIER = 1\nE=0\n", ""),
            (" E=IC(E_MULTIPLIER*0.02988)\nE_MULTIPLIER = 2", ""),
            (" E=IC(0.25*E_MULTIPLIER)\nF_MULTI = 2", "\nR92 = 2"),
            ("F_MULTI*1314", "R92*1314"),
            ("grammar; TRANS is sticky, bare TRANS resets\nDEF REAL DEPTH = 2.5", "grammar"),
            ("N53 MATERIAL_UPDATE", "N53"),
        ],
    },
    Mended {
        name: "function_calls",
        why: "an alarm outside of the numbers that alarms of programs have",
        told: "SETAL(12345)",
        by: &[],
    },
    Mended { name: "if_statement", why: NO_FEED, told: "NoFeed", by: &[("IF TRUE", "F1000\nIF TRUE")] },
    Mended {
        name: "multiple_m_codes",
        why: "M101 to M103 are the machine's own; M2 to M5 exclude each other",
        told: "M101",
        by: &[],
    },
    Mended {
        name: "r_param",
        why: "R0 is no name of a variable: it is defined already",
        told: "Value(VariableName)",
        by: &[("DEF REAL R0=0", "R0=0 F1000")],
    },
    Mended {
        name: "simple",
        why: "an axis twice in a block, and an arc without a centre",
        told: "WordTwice",
        by: &[],
    },
    Mended { name: "tool", why: "no end of the program", told: "", by: &[("M6", "M6")] },
    Mended { name: "trans2", why: NO_FEED, told: "NoFeed", by: &[("X1\n", "F1000 X1\n")] },
    Mended { name: "trans_reset", why: NO_FEED, told: "NoFeed", by: &[("\nX1 Y1\n", "\nF1000 X1 Y1\n")] },
    Mended {
        name: "variables",
        why: NO_FEED,
        told: "NoFeed",
        by: &[("X=aa/bb\naa=2", "F1000 X=aa/bb\naa=2")],
    },
];

/// The program of a text, or what is told of its faults.
fn read(text: &[u8]) -> Result<Program, String> {
    let mut batch = Batch::default();
    let mut reader = Reader::new(settings("siemens"), true);
    reader.read(text, 0, &mut batch);
    reader.finish(&mut batch);
    let errors = batch.diagnostics.iter().filter(|d| d.fault.gravity() == Gravity::Error);
    let errors: Vec<String> = errors.map(|d| format!("{:?}", d.fault)).collect();
    if !errors.is_empty() {
        return Err(errors.join("; "));
    }
    let main = Procedure { body: std::mem::take(&mut batch.stmts), ..Procedure::default() };
    let procedures = [main].into_iter().chain(std::mem::take(&mut batch.procedures)).collect();
    let program = Program { name: batch.name.clone(), assumed: batch.assumed, procedures };
    match leads_nowhere(&program).first() {
        Some(fault) => Err(format!("{:?}", fault.fault)),
        None => Ok(program),
    }
}

/// What is known after a block: one field for each of [`COLUMNS`], empty while nothing was said.
type Row = [String; COLUMNS.len()];

fn three(value: f64) -> String {
    let text = format!("{value:.3}");
    if text == "-0.000" { "0.000".to_owned() } else { text }
}

fn literal(value: &Expr) -> String {
    value.literal().map_or_else(String::new, |n| three(n.mantissa as f64 / 10f64.powi(n.scale.into())))
}

/// Puts what a statement says into the row.
fn say(op: &Op, row: &mut Row, named: &mut [bool; 6]) {
    let mut goes = |to: &Point| {
        for axis in Axis::ALL {
            named[axis as usize] |= to.get(axis).is_some();
        }
    };
    match op {
        Op::StraightTraverse(to) => {
            goes(&to.to);
            row[0] = "G0".into();
        }
        Op::StraightFeed(to) => {
            goes(&to.to);
            row[0] = "G1".into();
        }
        Op::ArcFeed(arc) => {
            goes(&arc.to);
            row[0] = if arc.turn == Turn::Clockwise { "G2" } else { "G3" }.into();
        }
        Op::Position(to) => goes(&to.to),
        Op::SetFeedRate(feed) => row[7] = literal(feed),
        Op::SetSpindleSpeed(speed) => row[8] = literal(speed),
        Op::SelectToolByName(name) => row[9] = name.to_string(),
        Op::SelectTool(tool) => row[9] = literal(tool),
        Op::ChangeTool => row[10] = "M6".into(),
        Op::ProgramEnd => row[10] = "M30".into(),
        _ => {}
    }
}

/// The rows of a program that is executed.
fn rows(program: &Program) -> Result<Vec<Row>, String> {
    let mut world = World::generate(0, &program.assumed);
    world.behaviours = settings("siemens").behaviours();
    let mut exec = Exec::new(&world, 0);
    let mut runner = Runner::new(program);
    let mut all: Vec<Row> = Vec::new();
    let mut row = Row::default();
    let mut named = [false; 6];
    let told = |d: ncc_ir::diag::Diagnostic| format!("{:?}", d.fault);
    loop {
        let next: Option<Stmt> = runner.next(&exec).map_err(told)?.cloned();
        let begins = next.as_ref().is_none_or(|stmt| !stmt.joined);
        if begins {
            let at = exec.machine();
            for axis in Axis::ALL {
                if named[axis as usize] {
                    row[1 + axis as usize] = three(at[axis as usize] as f64 / ONE as f64);
                }
            }
            all.push(row.clone());
            // An M function is its block's alone.
            row[10].clear();
        }
        let Some(stmt) = next else { break };
        say(&stmt.op, &mut row, &mut named);
        exec.step(&stmt, &mut Vec::new()).map_err(told)?;
    }
    Ok(all)
}

/// The fields of a line of a table.
fn fields(text: &str) -> Vec<String> {
    let mut all = vec![String::new()];
    let mut quoted = false;
    for c in text.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => all.push(String::new()),
            c => {
                if let Some(field) = all.last_mut() {
                    field.push(c);
                }
            }
        }
    }
    all
}

/// The rows of a table, and which of the columns it has.
fn table(text: &str) -> (Vec<Row>, [bool; COLUMNS.len()]) {
    let mut lines = text.lines();
    let head = fields(lines.next().unwrap_or_default());
    let places = COLUMNS.map(|column| head.iter().position(|name| name == column));
    let number = |field: &str| field.parse::<f64>().map_or_else(|_| field.to_owned(), three);
    let rows = lines.map(|line| {
        let all = fields(line);
        places.map(|place| place.and_then(|at| all.get(at)).map_or_else(String::new, |field| number(field)))
    });
    (rows.collect(), places.map(|place| place.is_some()))
}

/// Rows with something to compare, without those that say the same as the row before.
fn told(rows: Vec<Row>, has: &[bool; COLUMNS.len()]) -> Vec<Row> {
    let mut rows: Vec<Row> = rows
        .into_iter()
        .map(|mut row| {
            row.iter_mut().zip(has).filter(|(_, has)| !**has).for_each(|(field, _)| field.clear());
            row
        })
        .filter(|row| row.iter().any(|field| !field.is_empty()))
        .collect();
    rows.dedup();
    rows
}

fn compared(name: &str, text: &str, peer: &str) -> Result<usize, String> {
    let program = read(text.as_bytes())?;
    let (theirs, has) = table(peer);
    let (ours, theirs) = (told(rows(&program)?, &has), told(theirs, &has));
    if ours == theirs {
        return Ok(ours.len());
    }
    let spelt = |rows: &[Row]| rows.iter().map(|row| row.join(",") + "\n").collect::<String>();
    let diff = ncc_tests::expect::diff(spelt(&theirs).as_bytes(), spelt(&ours).as_bytes());
    Err(format!("{name}: {diff}"))
}

#[test]
fn programs_of_the_peer_go_where_it_says() {
    let Some(folder) = beside("cases/siemens-peer") else { return };
    let mut failures = Failures::default();
    let file = |name: &str, kind: &str| {
        fs::read_to_string(folder.join(format!("{name}.{kind}"))).expect("a program and its table")
    };
    let mut found = fs::read_dir(&folder)
        .expect("the folder")
        .flatten()
        .filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            Some(name.strip_suffix(".mpf")?.to_owned())
        })
        .collect::<Vec<_>>();
    found.sort();
    let mut listed: Vec<&str> = AS_THEY_ARE.into_iter().chain(MENDED.iter().map(|m| m.name)).collect();
    listed.sort_unstable();
    assert_eq!(found, listed);
    for name in AS_THEY_ARE {
        match compared(name, &file(name, "mpf"), &file(name, "csv")) {
            Ok(rows) => println!("  {name}: {rows} rows"),
            Err(why) => failures.add(name, why),
        }
    }
    for Mended { name, why, told, by } in &MENDED {
        let text = file(name, "mpf").replace("\r\n", "\n");
        match read(text.as_bytes()).and_then(|program| rows(&program)) {
            Err(refused) if refused.contains(told) && !told.is_empty() => {
                println!("  {name}: refused, {why}")
            }
            Ok(_) if told.is_empty() => {}
            other => failures.add(name, format!("is not refused for {told}: {other:?}")),
        }
        let mut mended = text.clone();
        for (piece, by) in *by {
            if !mended.contains(piece) {
                failures.add(name, format!("has no {piece}"));
            }
            mended = mended.replacen(piece, by, 1);
        }
        if by.is_empty() {
            continue;
        }
        match compared(name, &mended, &file(name, "csv")) {
            Ok(rows) => println!("  {name}, mended: {rows} rows"),
            Err(why) => failures.add(name, why),
        }
    }
    failures.finish();
}
