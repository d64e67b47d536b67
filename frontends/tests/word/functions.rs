//! Custom functions: what a program is given, what becomes of its answer, and where functions are refused.

use std::sync::{Arc, Mutex};

use ncc_dialects::{FunctionAnswer, FunctionCall, FunctionHost, GivenBlock, RunFunctions, Settings, load};
use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, ONE, Unit};
use ncc_ir::program::{Coord, Move, Op, Point};
use ncc_ir::unsupported::FunctionFailure;

use super::{diagnostics, read_with, stmts};
use crate::Batch;

const SHOP: &str = "id = \"shop\"\ntitle = \"\"\nbase = \"fanuc\"\n[functions]\n\
    G200 = { command = [\"a\"] }\nG201 = { command = [\"b\", \"c\"], until = \"G202\" }\n";

const HEAD: &str = "G21 G17 G90 G94 G98 G54 G40 G80\nS1000 M03\nG43 H1 Z5. G0 X1. Y2. F100.\n";

/// Takes a note of the calls; moves to X9 at feed, and back.
#[derive(Debug, Default)]
struct Noted(Mutex<Vec<Vec<GivenBlock>>>);

impl RunFunctions for Noted {
    fn run(&self, call: &FunctionCall) -> Result<FunctionAnswer, (FunctionFailure, Box<str>)> {
        self.0.lock().unwrap().push(call.blocks.to_vec());
        let to = |value: i64| {
            let mut to = Point::default();
            let value = Expr::Num(Num::from_nanos(value * ONE, 6, Unit::Mm));
            to.set(Axis::X, Coord { value, distance: Fact::Known(Distance::Absolute) });
            Move { to, said: false }
        };
        let last = call.blocks.len() - 1;
        Ok(FunctionAnswer {
            blocks: vec![(0, vec![Op::StraightFeed(to(9))]), (last, vec![Op::StraightTraverse(to(1))])],
        })
    }

    fn digest(&self) -> Option<[u8; 32]> {
        None
    }
}

/// Reads a text in the dialect with functions; and what the programs were given.
fn read(text: &str) -> (Batch, Vec<Vec<GivenBlock>>) {
    let mut dialect = load(&[SHOP]).unwrap().remove(0);
    let host = Arc::new(Noted::default());
    dialect.function_host = Some(FunctionHost::new(host.clone()));
    let settings = Settings::new(Box::leak(Box::new(dialect)));
    let out = read_with(settings, true, text.as_bytes());
    let given = host.0.lock().unwrap().clone();
    (out, given)
}

/// Statements after the head, faults, and calls.
fn after_head(piece: &str) -> (Vec<String>, Vec<String>, Vec<Vec<GivenBlock>>) {
    let text = format!("{HEAD}{piece}");
    let (out, given) = read(&text);
    let faults = diagnostics(&out, &text);
    let usual = |d: &String| d.starts_with("NoProgramEnd") || d.starts_with("AssumedMode");
    let faults = faults.into_iter().filter(|d| !usual(d)).collect();
    let head = stmts(&read(HEAD).0).len();
    (stmts(&out).split_off(head), faults, given)
}

#[test]
fn a_block_is_handed_over_with_its_words_and_what_is_active() {
    let (stmts, faults, given) = after_head("N10 G200 X10. Z-3. R2.5 Q4. (slot)\nG00 X2.\n");
    assert_eq!(stmts, ["N10 FEED X9.", "TRAVERSE X1. (slot)", "TRAVERSE! X2."]);
    assert_eq!(faults, ["AssumedFunction { name: 'G200', program: 'a' } at 'G200'"]);
    let block = &given[0][0];
    assert_eq!((&*block.gcode, &*block.function_name), ("N10 G200 X10. Z-3. R2.5 Q4. (slot)", "G200"));
    assert_eq!(block.position, [1, 2, 5, 0, 0, 0].map(|at| at * ONE));
    assert_eq!((block.feed, block.speed, block.cut_offset), (100 * ONE, 1000 * ONE, Some(1)));
    let words = [('x', 10 * ONE), ('z', -3 * ONE), ('r', 5 * ONE / 2), ('q', 4 * ONE)];
    assert_eq!(block.parameters, words);
    assert!(!block.rotary);
}

#[test]
fn axis_words_are_end_points_in_either_mode_and_unit() {
    let (_, _, given) = after_head("G91\nG200 X10. Z-3.\nG90 G20\nG200 X1.\n");
    assert_eq!(given[0][0].parameters, [('x', 11 * ONE), ('z', 2 * ONE)]);
    assert_eq!(given[1][0].parameters, [('x', 25_400_000_000)]);
}

#[test]
fn blocks_up_to_the_end_are_handed_over_together() {
    let (stmts, faults, given) = after_head("N1 G201 Z-5.\nX10. Y0.\n(between)\nG202 X20.\nG01 X3.\n");
    assert_eq!(stmts, ["(between)", "N1 FEED X9.", "TRAVERSE X1.", "FEED! X3."]);
    assert_eq!(faults, ["AssumedFunction { name: 'G201', program: 'b c' } at 'G201'"]);
    let names: Vec<&str> = given[0].iter().map(|block| &*block.function_name).collect();
    assert_eq!(names, ["START_CYCLE", "HOLE", "END_CYCLE"]);
    assert_eq!(given[0][1].gcode, "X10. Y0.");
    assert_eq!(given[0][1].position, given[0][0].position);
    let (out, _) = read(&format!("{HEAD}N1 G201 Z-5.\nX10. Y0.\nG202 X20.\n"));
    let text = format!("{HEAD}N1 G201 Z-5.\nX10. Y0.\nG202 X20.\n");
    let places: Vec<&str> = out.stmts[out.stmts.len() - 2..]
        .iter()
        .map(|stmt| &text[stmt.span.start as usize..stmt.span.end as usize])
        .collect();
    assert_eq!(places, ["N1 G201 Z-5.", "G202 X20."]);
}

#[test]
fn the_position_after_a_function_is_that_of_its_last_move() {
    let (_, faults, given) = after_head("G200 X10.\nG91 G01 X5.\nG200\n");
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert_eq!(given[1][0].position[0], 6 * ONE);
    // A motion code is no longer active.
    let (_, faults, _) = after_head("G01 X5.\nG200 X10.\nX7.\n");
    assert!(faults.contains(&"NoMotionMode at 'X7.'".to_owned()), "{faults:?}");
}

#[test]
fn a_function_is_reported_once() {
    let (_, faults, given) = after_head("G200\nG200 X4.\nG201\nG202\n");
    assert_eq!((faults.len(), given.len()), (2, 3), "{faults:?}");
}

#[test]
fn a_position_that_is_not_known_is_refused() {
    let fault = |text: &str| diagnostics(&read(text).0, text);
    let begin = "G21 G17 G90 G94 G54 G40 G49 G80\n";
    for (piece, axis) in [("G00 Y0. Z5.", 'X'), ("G00 X0. Z5.", 'Y'), ("G00 X0. Y0.", 'Z')] {
        let found = fault(&format!("{begin}{piece}\nG200 R1.\nM30\n"));
        let says = format!("PositionUnknown {{ axis: '{axis}' }} at 'G200 R1.'");
        assert!(found.contains(&says), "{found:?}");
    }
    // After a jump's target, and in a subprogram, until it is stated.
    let jump = format!("{HEAD}IF [#500 GT 0] GOTO 10\nG00 X9.\nN10 G40 G80\nG200\nM30\n");
    assert!(fault(&jump).iter().any(|d| d.starts_with("PositionUnknown")), "{:?}", fault(&jump));
    let after = format!("{HEAD}M98 P2\nG40 G80\nG200\nM30\nO2\nG00 X5.\nM99\n");
    assert!(fault(&after).iter().any(|d| d.starts_with("PositionUnknown")), "{:?}", fault(&after));
    let stated = |text: &str| text.replace("G40 G80\n", "G40 G80 G21 G17 G94 G90 G00 X1. Y1. Z1.\n");
    for text in [jump, after] {
        let found = fault(&stated(&text));
        assert!(found.iter().any(|d| d.starts_with("AssumedFunction")), "{found:?}");
    }
    let rotary = format!("{HEAD}G28 G91 A0.\nG90\nG200 X1.\nM30\n");
    assert!(
        fault(&rotary).iter().any(|d| d.contains("PositionUnknown { axis: 'A' }")),
        "{:?}",
        fault(&rotary)
    );
}

#[test]
fn what_a_program_cannot_know_is_refused_by_name() {
    for (piece, says) in [
        ("G200 X[1+1]", "Function(Computed)"),
        ("#1=3.\nG200 X#1", "Function(Computed)"),
        ("G41 D1 G01 X5. F100.\nG200", "Function(Compensated)"),
        ("G81 Z-5. R2. F100.\nG200", "Function(InCycle)"),
        ("G95 F0.1\nG200", "Function(FeedMode)"),
        ("G200 M08", "Function(BesideCodes)"),
        ("G201\nG01 X4.\nG202", "Function(BesideCodes)"),
        ("G201\n#1=4\nG202", "Function(BesideCodes)"),
        ("/G200", "Function(Skipped)"),
        ("G201\n/X4.\nG202", "Function(Skipped)"),
        ("G201 X4.\nM30", "Function(BesideCodes)"),
        ("G201 X4.", "Function(NotEnded { until: 'G202' })"),
        ("G202", "Function(NotBegun { name: 'G201' })"),
        ("WHILE [#500 LT 3] DO1\nG200\nEND1", "Function(InStructure)"),
        ("G201\nN7 X4.\nG202\nIF [#500 EQ 1] GOTO 7", "Function(JumpTarget)"),
        ("G200 X", "WordWithoutNumber"),
        ("G200 X1. X2.", "WordTwice"),
    ] {
        let (_, faults, given) = after_head(&format!("{piece}\n"));
        let found: Vec<&String> = faults.iter().filter(|d| !d.starts_with("Assumed")).collect();
        assert!(found.iter().any(|d| d.contains(says)), "{piece}: {faults:?}");
        assert!(given.is_empty(), "{piece}: {given:?}");
    }
}

#[test]
fn without_a_host_nothing_is_run() {
    let dialect = Box::leak(Box::new(load(&[SHOP]).unwrap().remove(0)));
    let text = format!("{HEAD}G200 X4.\nG201\nG202\n");
    let out = read_with(Settings::new(dialect), true, text.as_bytes());
    let found = diagnostics(&out, &text);
    assert!(
        found.contains(&"FunctionNotRun { name: 'G200', program: 'a' } at 'G200'".to_owned()),
        "{found:?}"
    );
    assert!(
        found.contains(&"FunctionNotRun { name: 'G201', program: 'b c' } at 'G201'".to_owned()),
        "{found:?}"
    );
}
