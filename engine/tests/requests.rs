//! Requests as a host makes them: what comes back, and what is refused.

use ncc_engine::Engine;

const PART: &str = "G21 G90 G17 G40\nG00 Z50.\nG00 X10. Y5.\nM30\n";

/// The code of a request about a file, and its outputs.
fn done(files: &[(&str, &str)], request: &str) -> (u8, Engine) {
    let mut engine = Engine::default();
    files.iter().for_each(|(name, text)| engine.put(name, text.as_bytes().to_vec()));
    (engine.run(request), engine)
}

fn text(engine: &Engine, name: &str) -> String {
    String::from_utf8_lossy(engine.output(name).unwrap_or_default()).into_owned()
}

#[test]
fn what_is_no_request_is_told() {
    for wrong in [
        "",
        "{}",
        r#"{ "verb": "melt" }"#,
        r#"{ "verb": "translate", "file": "part.nc", "from": "haas", "to": "siemens", "colour": 1 }"#,
        r#"{ "verb": "explain", "code": "NC0107", "file": "part.nc" }"#,
        r#"{ "verb": "dialects", "file": "part.nc" }"#,
        r#"{ "verb": "translate", "file": "part.nc", "from": "haas", "to": "nosuch" }"#,
        r#"{ "verb": "translate", "file": "part.nc", "from": "haas" }"#,
        r#"{ "verb": "translate", "file": "part.nc", "from": "haas", "to": "grbl", "to_option": { "tool_change": "file-per-tool" } }"#,
        r#"{ "verb": "translate", "file": "part.nc", "from": "haas", "to": "siemens", "pass": ["refuse"] }"#,
    ] {
        let (code, engine) = done(&[("part.nc", PART)], wrong);
        assert_eq!(code, 2, "{wrong}: {}", text(&engine, "messages"));
        assert!(text(&engine, "messages").starts_with("error: "), "{wrong}");
        assert!(engine.output("output").is_none());
    }
    let (code, engine) = done(&[], r#"{ "verb": "check", "file": "part.nc" }"#);
    assert_eq!((code, text(&engine, "messages").contains("no such file")), (4, true));
}

#[test]
fn a_program_calls_another_by_its_name() {
    let main = "O1\nG21 G90 G17 G94 G40 G49 G80 G54\nM98 P1234\nM30\n";
    let request = r#"{ "verb": "translate", "file": "main.nc", "from": "fanuc", "to": "haas" }"#;
    let (code, engine) = done(&[("main.nc", main)], request);
    assert_eq!(code, 1, "{}", text(&engine, "messages"));
    let files = [("main.nc", main), ("O1234.nc", "O1234\nG90 G17 G00 X5.\nM99\n")];
    let (code, engine) = done(&files, request);
    assert_eq!(code, 0, "{}", text(&engine, "messages"));
    assert!(text(&engine, "output").contains("CALLED: O1234.NC"), "{}", text(&engine, "output"));
}

#[test]
fn what_is_for_no_mill_is_refused_unless_it_is_said() {
    let lathe =
        "G50 S2000\nT0101\nG96 S200 M03\nG00 X50. Z2.\nG71 U2. R1.\nG71 P10 Q20 U0.5 W0.1 F0.3\nM30\n";
    let (code, engine) =
        done(&[("part.nc", lathe)], r#"{ "verb": "check", "file": "part.nc", "from": "fanuc" }"#);
    assert_eq!(code, 1);
    assert!(text(&engine, "messages").contains("lathe"), "{}", text(&engine, "messages"));
    assert!(engine.output("findings").is_none());
    let request = r#"{ "verb": "check", "file": "part.nc", "from": "fanuc", "assume_milling": true }"#;
    let (_, engine) = done(&[("part.nc", lathe)], request);
    assert!(engine.output("findings").is_some());
}

#[test]
fn a_certificate_names_what_it_rests_on() {
    let one = r#"{ "file": "part.nc", "from": "haas", "machine": "haas-vf2" }"#;
    let request = format!(r#"{{ "verb": "verify", "a": {one}, "b": {one} }}"#);
    let (code, engine) = done(&[("part.nc", PART)], &request);
    assert_eq!(code, 0, "{}", text(&engine, "messages"));
    let document = text(&engine, "document");
    assert!(
        document.contains("\"dictionaries\": [\n    {") && document.contains("\"name\": \"haas-vf2\""),
        "{document}"
    );
}

const SLOT: &str = "%\nO1\nG21 G17 G90 G94 G54\nT1 M6\nS3000 M3\nG0 X10. Y10. Z5.\nG1 Z-2. F200.\nX50. F600.\nG2 X50. Y20. \
                    I0. J5.\nG0 Z5.\nM30\n%\n";

/// The numbers of a column.
fn column(path: &[u8], name: &str) -> Vec<f64> {
    let end = path.iter().position(|byte| *byte == b'\n').expect("a line") + 1;
    assert_eq!(end % 8, 0, "columns begin where their type may");
    let head: serde_json::Value = serde_json::from_slice(&path[..end]).expect("JSON");
    let pieces = head["pieces"].as_u64().expect("a count") as usize;
    let columns = head["columns"].as_array().expect("columns");
    let own = columns.iter().find(|own| own["name"] == name).expect("a column");
    let at = end + own["offset"].as_u64().expect("a place") as usize;
    let of = |size: usize| path[at..at + size * pieces].chunks_exact(size);
    match own["type"].as_str().expect("a type") {
        "f64" => of(8).map(|b| f64::from_le_bytes(b.try_into().expect("eight"))).collect(),
        "f32" => of(4).map(|b| f64::from(f32::from_le_bytes(b.try_into().expect("four")))).collect(),
        "u32" => of(4).map(|b| f64::from(u32::from_le_bytes(b.try_into().expect("four")))).collect(),
        "u16" => of(2).map(|b| f64::from(u16::from_le_bytes(b.try_into().expect("two")))).collect(),
        "u8" => of(1).map(|b| f64::from(b[0])).collect(),
        other => panic!("a column of {other}"),
    }
}

#[test]
fn moves_come_as_columns() {
    let (code, engine) = done(&[("a.nc", SLOT)], r#"{ "verb": "path", "file": "a.nc", "from": "fanuc" }"#);
    assert_eq!(code, 0, "{}", text(&engine, "messages"));
    let path = engine.output("path").expect("moves");
    let (kinds, moves) = (column(path, "kind"), column(path, "move"));
    // The first rapid, two cuts, half a circle in 48 pieces, the way up.
    assert_eq!(kinds.iter().filter(|kind| **kind == 2.0).count(), 48);
    assert_eq!((kinds[0], kinds[1], *kinds.last().expect("the last")), (0.0, 1.0, 0.0));
    assert_eq!((moves[0], *moves.last().expect("the last")), (1.0, 5.0));
    let [x, y, z] = ["x1", "y1", "z1"].map(|name| column(path, name));
    // The middle of the half circle.
    assert!((x[2 + 24] - 45.0).abs() < 1e-4 && (y[2 + 24] - 15.0).abs() < 0.01, "{} {}", x[26], y[26]);
    assert!(z[1..51].iter().all(|z| *z == -2.0));
    let (begins, ends) = (column(path, "t0"), column(path, "t1"));
    assert!(begins.iter().zip(&ends).all(|(begin, end)| begin <= end));
    assert!(ends.windows(2).all(|pair| pair[0] <= pair[1]));
    assert!(
        column(path, "line")[1] == 7.0
            && column(path, "feed")[1] == 200.0
            && column(path, "speed")[1] == 3000.0
    );
}

#[test]
fn a_part_is_shown_after_any_move() {
    let request = r#"{ "verb": "simulate", "file": "a.nc", "from": "fanuc", "stock": "X0:60 Y0:30 Z-10:0",
        "tools": ["1=flat,10"], "cells": 60 }"#;
    let (code, mut engine) = done(&[("a.nc", SLOT)], request);
    assert_eq!(code, 0, "{}", text(&engine, "messages"));
    let document: serde_json::Value =
        serde_json::from_slice(engine.output("document").expect("a document")).expect("JSON");
    // Counted over places of 0.05 mm: 1192.8 mm³. A cell is 1 mm here.
    let removed = document["programs"][0]["tools"][0]["removed"].as_f64().expect("a volume");
    assert!((removed - 1192.8).abs() < 12.0, "{removed}");
    let heights = |engine: &Engine| -> Vec<f32> {
        let bytes = engine.output("heights").expect("heights");
        bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().expect("four"))).collect()
    };
    let end = heights(&engine);
    assert_eq!(end.len(), 60 * 30);
    let low = |all: &[f32]| all.iter().filter(|height| **height == -2.0).count();
    let at = |engine: &mut Engine, moves: usize| {
        let request = format!(r#"{{ "verb": "seek", "moves": {moves} }}"#);
        assert_eq!(engine.run(&request), 0);
        heights(engine)
    };
    let [start, plunged, slot] = [0, 2, 3].map(|moves| at(&mut engine, moves));
    assert_eq!(low(&start), 0);
    assert!(low(&plunged) > 60 && low(&slot) > low(&plunged) && low(&end) > low(&slot));
    assert_eq!(at(&mut engine, 1_000_000), end);
    assert_eq!(engine.run(r#"{ "verb": "stl" }"#), 0);
    assert!(engine.output("stl").expect("a body").len() > 84);
    engine.clear();
    assert_eq!(engine.run(r#"{ "verb": "seek", "moves": 0 }"#), 2);
    assert!(text(&engine, "messages").contains("no program was cut"));
    for wrong in [r#""stock": "100x60""#, r#""tools": ["1=spoon,10"]"#, r#""fixtures": ["none.stl"]"#] {
        let request = format!(r#"{{ "verb": "simulate", "file": "a.nc", "from": "fanuc", {wrong} }}"#);
        let (code, engine) = done(&[("a.nc", SLOT)], &request);
        assert!(code > 1, "{wrong}: {}", text(&engine, "messages"));
    }
}

/// Moves that were asked for are not made anew for the part; a file, or a request, that is another has its own.
#[test]
fn a_program_whose_moves_are_known_is_cut_as_any_other() {
    let simulate = |more: &str| format!(r#"{{ "verb": "simulate", "file": "a.nc", "cells": 60 {more} }}"#);
    let path = r#"{ "verb": "path", "file": "a.nc" }"#;
    // Its last line is unreachable code, which ncc reports.
    let one = SLOT.replace("M30", "M30\nG0 X0.");
    let other = one.replace("Z-2.", "Z-3.");
    let files = [("a.nc", one.as_str())];
    let outputs = |engine: &Engine| -> Vec<(&str, Vec<u8>)> {
        engine.outputs().map(|(name, bytes)| (name, bytes.to_vec())).collect()
    };
    let (_, alone) = done(&files, &simulate(""));
    assert!(text(&alone, "messages").contains("NC0111"), "{}", text(&alone, "messages"));
    let (code, mut engine) = done(&files, path);
    assert_eq!((code, text(&engine, "messages").contains("NC0111")), (0, true));
    for _ in 0..2 {
        engine.run(&simulate(""));
        assert_eq!(outputs(&engine), outputs(&alone));
    }
    engine.run(path);
    engine.put("a.nc", other.clone().into_bytes());
    engine.run(&simulate(""));
    let (_, changed) = done(&[("a.nc", &other)], &simulate(""));
    assert_eq!(outputs(&engine), outputs(&changed));
    assert_ne!(outputs(&engine), outputs(&alone));
    // Another request: on a machine.
    engine.run(path);
    engine.run(&simulate(r#", "machine": "fanuc-vmc", "zero": [-200, -200, -300]"#));
    let (_, placed) =
        done(&[("a.nc", &other)], &simulate(r#", "machine": "fanuc-vmc", "zero": [-200, -200, -300]"#));
    assert_eq!(outputs(&engine), outputs(&placed));
}

#[test]
fn parts_of_two_programs_are_compared() {
    // The same way with no word of the tool's size but in the first; then a slot 0.1 mm less deep.
    let sized = SLOT.replace("T1 M6", "(T1 D=10. END MILL)\nT1 M6");
    let compared = |other: &str| {
        let request = r#"{ "verb": "simulate", "file": "a.nc", "from": "fanuc", "cells": 60,
            "compare": { "file": "b.nc", "from": "fanuc" } }"#;
        let (code, mut engine) = done(&[("a.nc", &sized), ("b.nc", other)], request);
        let document: serde_json::Value =
            serde_json::from_slice(engine.output("document").unwrap_or_default()).unwrap_or_default();
        // What is kept is the first.
        assert_eq!(engine.run(r#"{ "verb": "seek", "moves": 0 }"#), if document.is_null() { 2 } else { 0 });
        (code, document)
    };
    let (code, document) = compared(SLOT);
    assert_eq!((code, &document["between"]["same"]), (0, &serde_json::Value::Bool(true)), "{document}");
    assert_eq!(document["programs"].as_array().map(Vec::len), Some(2));
    let (code, document) = compared(&SLOT.replace("Z-2.", "Z-1.9"));
    let between = &document["between"];
    assert_eq!((code, &between["same"]), (1, &serde_json::Value::Bool(false)));
    let number = |value: &serde_json::Value| value.as_f64().unwrap_or_default();
    assert!((number(&between["below"]["by"]) - 0.1).abs() < 1e-5, "{between}");
    // 0.1 mm over a slot of 596 mm².
    assert!(number(&between["more"]) == 0.0 && (number(&between["less"]) - 59.6).abs() < 1.0, "{between}");
    assert_eq!(compared("%\nO1\nG21\nG65 P9999\nM30\n%\n").0, 1);
}

#[test]
fn words_have_colours_whatever_they_mean() {
    let coloured = |text: &str, request: &str| {
        let (code, engine) = done(&[("part.nc", text)], request);
        assert_eq!(code, 0, "{}", self::text(&engine, "messages"));
        serde_json::from_str::<serde_json::Value>(&self::text(&engine, "document")).expect("JSON")
    };
    let kinds = |document: &serde_json::Value| -> Vec<String> {
        let numbers: Vec<usize> = document["stretches"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|n| n.as_u64().expect("a number") as usize)
            .collect();
        let told = |one: &[usize]| {
            format!(
                "{}:{}-{} {}",
                one[0],
                one[1],
                one[2],
                document["kinds"][one[3]].as_str().expect("a name")
            )
        };
        numbers.chunks(4).map(told).collect()
    };
    let text = "%\nN10 G01 X-20.5 (é SLOT) F100\n#1=[SIN[30]]\n";
    let request = r#"{ "verb": "colours", "file": "part.nc", "from": "fanuc", "first": 2, "lines": 1 }"#;
    let expected = ["2:0-3 block-number", "2:4-7 code-g", "2:8-14 axis", "2:15-23 comment", "2:24-28 feed"];
    assert_eq!(kinds(&coloured(text, request)), expected);
    // No dialect is recognised in one word, and it has its colour.
    let request = r#"{ "verb": "colours", "file": "part.nc", "first": 1, "lines": 9 }"#;
    assert_eq!(kinds(&coloured("G1", request)), ["1:0-2 code-g"]);
}

#[test]
fn colours_of_lines_are_those_of_the_text_in_whatever_order_they_are_asked_for() {
    // From its second mark on the text is no program: the lines behind are comments.
    let text = |blocks: usize| format!("%\n{}%\n{}", "G1 X1. (A)\n".repeat(blocks), "G1 X2.\n".repeat(9_000));
    let asked = |engine: &mut Engine, first: usize| {
        let request = format!(
            r#"{{ "verb": "colours", "file": "part.nc", "from": "fanuc", "first": {first}, "lines": 3 }}"#
        );
        assert_eq!(engine.run(&request), 0);
        self::text(engine, "document")
    };
    let mut engine = Engine::default();
    for blocks in [12_000, 4_998, 4_999, 5_000] {
        engine.put("part.nc", text(blocks).into_bytes());
        for first in [13_000, 4_999, 5_000, 5_001, 5_002, 1, 10_001, 12_001, 21_000, 9_999, 30_000] {
            let mut fresh = Engine::default();
            fresh.put("part.nc", text(blocks).into_bytes());
            assert_eq!(asked(&mut engine, first), asked(&mut fresh, first), "{first} with {blocks} blocks");
        }
    }
    let comment = |engine: &mut Engine, first| asked(engine, first).contains(&format!("[{first},0,6,0,"));
    assert!(comment(&mut engine, 5_003) && !comment(&mut engine, 5_001));
}

#[test]
fn machines_are_listed_with_their_dialects() {
    let (code, engine) = done(&[], r#"{ "verb": "machines" }"#);
    assert_eq!(code, 0);
    assert!(text(&engine, "document").contains("\"haas-vf2\""));
}

#[test]
fn words_of_a_dialect_have_meanings_and_sources() {
    let (code, engine) = done(&[], r#"{ "verb": "words", "dialect": "fanuc" }"#);
    assert_eq!(code, 0);
    let document: serde_json::Value = serde_json::from_str(&text(&engine, "document")).expect("JSON");
    let words = document["words"].as_array().expect("a list");
    let found = |name: &str| words.iter().find(|row| row["word"] == name).expect("a row");
    assert_eq!(found("G01")["means"], "STRAIGHT_FEED");
    assert_eq!(found("X")["means"], "axis, length");
    assert!(words.iter().any(|row| !row["refused"].is_null()));
    assert!(document["sources"]["16-C"].is_string());
}

/// The zero of the part in machine coordinates: where it is stated, the travel of the machine is known around the part, and
/// what leaves it is found.
#[test]
fn the_zero_of_the_part_shows_the_travel() {
    let text = "%\nO1\nG21 G17 G90 G94 G40 G49 G80\nT1 M6\nG55 G0 X0. Y0. S3000 M3\nG43 H1 Z10.\nG1 Z-2. F300.\nX300.\nG0 Z10.\nM30\n%\n";
    let mut engine = Engine::default();
    engine.put("part.nc", text.as_bytes().to_vec());
    let mut row = |zero: &str| {
        engine.run(&format!(
            r#"{{ "verb": "simulate", "file": "part.nc", "machine": "fanuc-vmc", "cells": 64 {zero} }}"#
        ));
        let document: serde_json::Value =
            serde_json::from_slice(engine.output("document").expect("a document")).expect("JSON");
        let travel = document["programs"][0]["travel"].clone();
        engine.run(&format!(r#"{{ "verb": "check", "file": "part.nc", "machine": "fanuc-vmc" {zero} }}"#));
        let findings = String::from_utf8_lossy(engine.output("findings").expect("findings")).into_owned();
        (travel, findings.contains("NC0801"))
    };
    assert_eq!(row(""), (serde_json::Value::Null, false));
    let (travel, leaves) = row(r#", "zero": [-500, -200, -300]"#);
    assert_eq!(travel, serde_json::json!([[-500.0, -300.0, -200.0], [500.0, 200.0, 300.0]]));
    assert!(!leaves);
    assert!(row(r#", "zero": [-200, -200, -300]"#).1);
}

/// A machine times programs in the language of another control; they are read in that language.
#[test]
fn a_dialect_that_is_named_is_read_on_any_machine() {
    let file = [("part.nc", "T1M6\nM5\nM30\n")];
    for dialect in ["haas", "mach9"] {
        let request = format!(
            r#"{{ "verb": "time", "file": "part.nc", "from": "{dialect}", "machine": "romi-discovery-4022" }}"#
        );
        let (code, engine) = done(&file, &request);
        assert_eq!(code, 0, "{}", text(&engine, "messages"));
        let times: serde_json::Value = serde_json::from_str(&text(&engine, "times")).expect("JSON");
        assert_eq!(times["dialect"], dialect);
    }
}
