//! A program's answer: what is taken, and what is refused by its block.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use ncc_dialects::FunctionRow;
use ncc_ir::canon::{Plane, Units};
use serde_json::json;

use super::*;

/// Answers with a text, and counts its starts.
#[derive(Debug)]
struct Answers(String, Arc<AtomicUsize>);

impl StartProgram for Answers {
    fn start(&self, _: &Program, _: &[u8]) -> Result<Vec<u8>, Failed> {
        self.1.fetch_add(1, Ordering::Relaxed);
        Ok(self.0.clone().into_bytes())
    }
}

fn row() -> FunctionRow {
    toml::from_str("command = [\"a\"]\nmost_blocks = 4").unwrap()
}

fn block() -> GivenBlock {
    GivenBlock {
        gcode: "G200 X4.".to_owned(),
        function_name: "G200".to_owned(),
        position: [ONE, 2 * ONE, 5 * ONE, 0, 0, 0],
        rotary: false,
        cut_offset: Some(1),
        feed: 100 * ONE,
        speed: 0,
        tool: 3,
        parameters: vec![('x', 4 * ONE)],
    }
}

/// Has a program answer so.
fn run_in(units: Units, plane: Plane, answer: &str) -> Result<FunctionAnswer, FunctionFailure> {
    let functions = Functions::new(Box::new(Answers(answer.to_owned(), Arc::default())));
    let (row, blocks) = (row(), [block()]);
    let call = FunctionCall { name: "G200", row: &row, units, plane, blocks: &blocks };
    functions.run(&call).map_err(|(why, _)| why)
}

fn run(answer: &str) -> Result<FunctionAnswer, FunctionFailure> {
    run_in(Units::Mm, Plane::Xy, answer)
}

/// A block of an answer that goes to a point from another.
fn goes(function: &str, from: [f64; 3], to: [f64; 3], feed: f64, parameters: Value) -> Value {
    json!({
        "gcode": "G200 X4.", "function_name": function,
        "x0": from[0], "y0": from[1], "z0": from[2], "x1": to[0], "y1": to[1], "z1": to[2],
        "cut_offset": 1, "feed": feed, "speed": 500.0, "tool": 3,
        "dx": 0, "dy": 0, "dz": 0, "distance": 0, "time": 0, "timestamp": 0, "parameters": parameters,
    })
}

const AT: [f64; 3] = [1.0, 2.0, 5.0];

/// One block that stays where it is.
fn stays(function: &str, parameters: Value) -> String {
    json!([goes(function, AT, AT, 100.0, parameters)]).to_string()
}

/// The statements of an answer, as the text form of the neutral program has their names.
fn names(answer: &FunctionAnswer) -> Vec<&'static str> {
    answer.blocks.iter().flat_map(|(_, ops)| ops.iter().map(ncc_ir::program::Op::name)).collect()
}

#[test]
fn a_program_gets_the_blocks_of_the_payload() {
    let given = String::from_utf8(input(&[block()]).unwrap()).unwrap();
    let read = read_blocks_of_source(&given);
    assert_eq!(read["function_name"], "G200");
    assert_eq!((&read["x0"], &read["z1"], &read["feed"]), (&json!(1.0), &json!(5.0), &json!(100.0)));
    assert_eq!(read["parameters"], json!({ "x": 4.0 }));
    assert!(read.get("a0").is_none());
}

fn read_blocks_of_source(text: &str) -> Value {
    let all: Vec<Value> = serde_json::from_str(text).unwrap();
    assert_eq!(all.len(), 1);
    all[0].clone()
}

#[test]
fn moves_feeds_and_switches_are_taken() {
    let up = [1.0, 2.0, 9.0];
    let all = json!([
        goes("STRAIGHT_TRAVERSE", AT, up, 0.0, json!({})),
        goes("STRAIGHT_FEED", up, AT, 50.0, json!({})),
        goes(
            "ARC_FEED",
            AT,
            [3.0, 2.0, 5.0],
            50.0,
            json!({ "i": 2.0, "j": 2.0, "turn": "clockwise", "plane": "XY", "full": false })
        ),
        goes("DWELL", [3.0, 2.0, 5.0], [3.0, 2.0, 5.0], 0.0, json!({ "seconds": 0.5 })),
    ]);
    let answer = run(&all.to_string()).unwrap();
    let said = ["STRAIGHT_TRAVERSE", "SET_FEED_RATE", "STRAIGHT_FEED", "ARC_FEED", "DWELL"];
    assert_eq!(names(&answer), said);
    for name in [
        "SET_FEED_RATE",
        "SET_SPINDLE_SPEED",
        "START_SPINDLE_CLOCKWISE",
        "START_SPINDLE_COUNTERCLOCKWISE",
        "STOP_SPINDLE_TURNING",
        "FLOOD_ON",
        "MIST_ON",
        "COOLANT_OFF",
        "PROGRAM_STOP",
        "OPTIONAL_PROGRAM_STOP",
    ] {
        let answer = run(&stays(name, json!({}))).unwrap();
        // The feed is the active one.
        let expected = if name == "SET_FEED_RATE" { vec![] } else { vec![name] };
        assert_eq!(names(&answer), expected, "{name}");
    }
    assert_eq!(run("[]").unwrap(), FunctionAnswer::default());
}

#[test]
fn lengths_are_in_the_unit_of_the_program() {
    let all = json!([goes("STRAIGHT_FEED", AT, [26.4, 2.0, 5.0], 254.0, json!({}))]).to_string();
    let answer = format!("{:?}", run_in(Units::Inch, Plane::Xy, &all).unwrap());
    assert!(answer.contains("mantissa: 10, scale: 0, point: true, unit: Inch"), "{answer}");
    assert!(answer.contains("mantissa: 103937008, scale: 8, point: true, unit: Inch"), "{answer}");
}

#[test]
fn statements_belong_to_the_blocks_that_they_name() {
    let functions = |answer: &str| Functions::new(Box::new(Answers(answer.to_owned(), Arc::default())));
    let of = |gcode: &str| GivenBlock { gcode: gcode.to_owned(), ..block() };
    let blocks = [of("G201"), of("X4."), of("X4."), of("G202")];
    let mut all = [goes("FLOOD_ON", AT, AT, 0.0, json!({})), goes("MIST_ON", AT, AT, 0.0, json!({}))];
    all[0]["gcode"] = json!("X4.");
    all[1]["gcode"] = json!("G202");
    let row = row();
    let call = FunctionCall { name: "G201", row: &row, units: Units::Mm, plane: Plane::Xy, blocks: &blocks };
    let answer = functions(&json!(all).to_string()).run(&call).unwrap();
    assert_eq!(answer.blocks.iter().map(|(from, _)| *from).collect::<Vec<_>>(), [1, 3]);
}

#[test]
fn answers_that_are_no_list_of_blocks_are_refused() {
    use FunctionFailure::*;
    assert_eq!(run(""), Err(Empty));
    assert_eq!(run(" \n"), Err(Empty));
    assert_eq!(run("[\0]"), Err(NotText));
    let cut = stays("DWELL", json!({ "seconds": 1 }));
    for text in ["[", "{}", "null", "nothing", &cut[..cut.len() - 9], "[{\"gcode\":\"\"}]"] {
        assert!(matches!(run(text), Err(NotBlocks { .. })), "{text}");
    }
    let unknown = run(&stays("DRAW", json!({}))).unwrap_err();
    assert!(matches!(&unknown, NotBlocks { reason, .. } if reason.contains("DRAW")), "{unknown:?}");
    let five = json!(vec![goes("FLOOD_ON", AT, AT, 0.0, json!({})); 5]).to_string();
    assert_eq!(run(&five), Err(TooMany { most: 4 }));
}

#[test]
fn blocks_that_are_not_taken_are_refused() {
    use FunctionFailure::*;
    for name in
        ["SELECT_TOOL", "CHANGE_TOOL", "SET_DATA", "STRAIGHT_PROBE", "PROGRAM_END", "START_CYCLE", "HOLE"]
    {
        assert_eq!(run(&stays(name, json!({}))), Err(Function { block: 1, function: name.into() }));
    }
    let one = |block: Value| {
        run(&json!([goes("FLOOD_ON", AT, AT, 0.0, json!({})), block]).to_string()).unwrap_err()
    };
    let feed = |from, to, feed| goes("STRAIGHT_FEED", from, to, feed, json!({}));
    assert_eq!(one(feed([1.0, 2.1, 5.0], AT, 10.0)), Start { block: 2, axis: 'Y' });
    assert_eq!(one(feed(AT, [4.0, 2.0, 5.0], 0.0)), NoFeed { block: 2 });
    assert_eq!(one(feed(AT, [4e7, 2.0, 5.0], 10.0)), TooLong { block: 2 });
    let dwell = goes("DWELL", AT, [4.0, 2.0, 5.0], 0.0, json!({ "seconds": 1 }));
    assert_eq!(one(dwell), Moves { block: 2, function: "DWELL".into() });
    assert_eq!(
        one(goes("DWELL", AT, AT, 0.0, json!({}))),
        Parameter { block: 2, parameter: "seconds".into() }
    );
    let arc = |plane: &str, full: bool, j: Value| {
        let parameters = json!({ "i": 2.0, "j": j, "turn": "clockwise", "plane": plane, "full": full });
        one(goes("ARC_FEED", AT, [3.0, 2.0, 5.0], 10.0, parameters))
    };
    assert_eq!(arc("ZX", false, json!(2.0)), Plane { block: 2 });
    let parameter = |name: &str| Parameter { block: 2, parameter: name.into() };
    assert_eq!(arc("XZ", false, json!(2.0)), parameter("plane"));
    assert_eq!(arc("XY", true, json!(2.0)), parameter("full"));
    assert_eq!(arc("XY", false, json!("2")), parameter("j"));
}

#[test]
fn a_program_is_started_once_for_an_input() {
    let starts = Arc::new(AtomicUsize::new(0));
    let functions = Functions::new(Box::new(Answers("[]".to_owned(), starts.clone())));
    assert_eq!(functions.digest(), None);
    let row = row();
    let mut blocks = [block()];
    let named = |name, blocks: &[GivenBlock], units| {
        functions.run(&FunctionCall { name, row: &row, units, plane: Plane::Xy, blocks }).unwrap();
    };
    let run = |blocks: &[GivenBlock], units| named("G200", blocks, units);
    run(&blocks, Units::Mm);
    run(&blocks, Units::Mm);
    assert_eq!(starts.load(Ordering::Relaxed), 1);
    let before = functions.digest();
    blocks[0].parameters[0].1 = 0;
    run(&blocks, Units::Mm);
    run(&blocks, Units::Inch);
    assert_eq!(starts.load(Ordering::Relaxed), 3);
    // Another function may have a program of the same name in another folder.
    named("G201", &blocks, Units::Mm);
    assert_eq!(starts.load(Ordering::Relaxed), 4);
    assert!(before.is_some() && before != functions.digest());
}
