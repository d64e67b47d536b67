//! Layout, names and renaming, as a page asks for them.

use ncc_engine::Engine;
use serde_json::Value;

fn done(text: &str, request: &str) -> (u8, String, String) {
    let mut engine = Engine::default();
    engine.put("part.nc", text.as_bytes().to_vec());
    let code = engine.run(request);
    let of = |name: &str| String::from_utf8_lossy(engine.output(name).unwrap_or_default()).into_owned();
    (code, of("output") + &of("document"), of("messages"))
}

/// Names with their places, `Variable 100: 3:0 def, 4:7`.
fn names(text: &str, from: &str) -> Vec<String> {
    let (code, document, told) =
        done(text, &format!(r#"{{ "verb": "names", "file": "part.nc", "from": "{from}" }}"#));
    assert_eq!(code, 0, "{told}");
    let document: Value = serde_json::from_str(&document).expect("JSON");
    let numbers: Vec<u64> =
        document["places"].as_array().expect("places").iter().filter_map(Value::as_u64).collect();
    let names = document["names"].as_array().expect("names").iter().enumerate();
    names
        .map(|(at, name)| {
            let own = numbers.chunks(5).filter(|place| place[0] == at as u64);
            let own: Vec<String> = own
                .map(|place| {
                    let def = if place[4] == 1 { "!" } else { "" };
                    format!("{}:{}-{}{def}", place[1], place[2], place[3])
                })
                .collect();
            format!("{} {} {}", name["sort"].as_str().unwrap(), name["text"].as_str().unwrap(), own.join(" "))
        })
        .collect()
}

/// The text with another name, or what is reported.
fn renamed(text: &str, from: &str, line: usize, column: usize, to: &str) -> Result<String, String> {
    let request = format!(
        r#"{{ "verb": "rename", "file": "part.nc", "from": "{from}", "line": {line}, "column": {column}, "to": "{to}" }}"#
    );
    let (code, output, told) = done(text, &request);
    if code == 0 { Ok(output) } else { Err(told) }
}

const MACRO: &str = "%\nO1000 (ÇA #100)\nG21 G17 G90 G94 G40 G49 G80 G54\nS100 M3\nG0 X0. Y0. Z0.\n#100=1\nN10 G1 X#100 F100.\n\
    #100=#100+1\nIF[#100LE3]GOTO10\nM98 P2000\nM30\nO2000\n#1=5.\nWHILE[#1LT7]DO1\nG1 Y#1\n#1=#1+1\nEND1\nM99\n%\n";

#[test]
fn names_have_all_their_places() {
    let all = names(MACRO, "fanuc");
    assert_eq!(
        all,
        [
            "program 1000 2:1-5!",
            "variable 100 6:1-4! 7:9-12 8:1-4! 8:6-9 9:4-7",
            "block 10 7:1-3! 9:15-17",
            "program 2000 10:5-9 12:1-5!",
            "variable 1 13:1-2! 14:7-8 15:5-6 16:1-2! 16:4-5",
            "loop 1 14:14-15! 17:3-4",
        ]
    );
}

#[test]
fn a_linuxcnc_has_names_by_o_words_and_a_sinumerik_by_its_own() {
    let text = "o100 sub\n#<own>=1\no101 while [#<own> LT 3]\n#<own>=[#<own>+1]\no101 endwhile\no100 endsub\n#<_all>=2\no100 call\nM2\n";
    assert_eq!(
        names(text, "linuxcnc"),
        [
            "program 100 1:1-4! 6:1-4 8:1-4",
            "variable OWN 2:2-5! 3:14-17 4:2-5! 4:10-13",
            "loop 101 3:1-4! 5:1-4",
            "variable _ALL 7:2-6!",
        ]
    );
    let text = "DEF REAL LEN=3\nR1=LEN\nAGAIN: G1 X=LEN F100\nR1=R1+1\nIF R1<5 GOTOB AGAIN\nM30\n";
    assert_eq!(
        names(text, "siemens"),
        [
            "variable LEN 1:9-12! 2:3-6 3:12-15",
            "variable R1 2:0-2! 4:0-2! 4:3-5 5:3-5",
            "label AGAIN 3:0-5! 5:14-19"
        ]
    );
}

#[test]
fn all_places_are_renamed_at_once() {
    let own = renamed(MACRO, "fanuc", 9, 5, "#101").expect("renamed");
    assert_eq!(
        own,
        MACRO
            .replace("#100=", "#101=")
            .replace("X#100", "X#101")
            .replace("#100+", "#101+")
            .replace("[#100", "[#101")
    );
    let own = renamed(MACRO, "fanuc", 9, 16, "20").expect("renamed");
    assert_eq!(own, MACRO.replace("N10", "N20").replace("GOTO10", "GOTO20"));
    let own = renamed(MACRO, "fanuc", 10, 6, "3000").expect("renamed");
    assert_eq!(own, MACRO.replace("2000", "3000"));
    let text = "DEF REAL LEN=3\nG17 G90 G71 G94 G40 G54\nS100 M3\nG0 X0 Y0 Z0\nG1 X=LEN F100\nM30\n";
    assert_eq!(renamed(text, "siemens", 1, 10, "WIDTH").expect("renamed"), text.replace("LEN", "WIDTH"));
}

#[test]
fn what_cannot_be_shown_to_be_complete_is_refused() {
    let refused = |text: &str, line, column, to: &str, why: &str| {
        let told = renamed(text, "fanuc", line, column, to).expect_err(why);
        assert!(told.contains(why), "{told}");
    };
    refused(MACRO, 9, 5, "#2", "lives longer or shorter");
    refused(MACRO, 9, 5, "1.5", "form");
    refused(MACRO, 3, 0, "7", "no name at this place");
    refused(MACRO, 10, 6, "1000", "already");
    refused(&MACRO.replace("S100 M3", "#[99+2]=1"), 9, 5, "#102", "computed number of a variable");
    refused(&MACRO.replace("S100 M3", "GOTO[#5+10]"), 9, 16, "20", "computed");
    refused(&MACRO.replace("#100=1\n", ""), 8, 16, "20", "cannot execute");
    refused(&MACRO.replace("#100", "#500"), 9, 5, "#501", "other programs");
    refused(&MACRO.replace("S100 M3", "M98 P#5"), 10, 6, "3000", "computed");
}

#[test]
fn a_program_is_laid_out_and_numbered() {
    let text = "%\nO1\ng21g90g17g40\nN7 g0x1.y2.\nM30\n%\n";
    let (code, output, told) = done(text, r#"{ "verb": "layout", "file": "part.nc", "from": "fanuc" }"#);
    assert_eq!((code, output.as_str()), (0, "%\nO1\nG21 G90 G17 G40\nN7 G00 X1. Y2.\nM30\n%\n"), "{told}");
    let (code, output, told) =
        done(text, r#"{ "verb": "layout", "file": "part.nc", "from": "fanuc", "number": [10, 10] }"#);
    assert_eq!(
        (code, output.as_str()),
        (0, "%\nO1\nN10 G21 G90 G17 G40\nN20 G00 X1. Y2.\nN30 M30\n%\n"),
        "{told}"
    );
}

/// Each line of a translation has its line of the source; the head and what frames the program have none.
#[test]
fn lines_of_a_translation_have_their_source() {
    let text =
        "%\nO1\nG21 G17 G90 G94 G40 G49 G80 G54\nT1 M6\nS100 M3\nG0 X0. Y0. Z5.\nG1 Z-1. F100.\nM30\n%\n";
    let mut engine = Engine::default();
    engine.put("part.nc", text.as_bytes().to_vec());
    let request =
        r#"{ "verb": "translate", "file": "part.nc", "from": "fanuc", "to": "siemens", "map": true }"#;
    assert_eq!(engine.run(request), 0, "{:?}", engine.output("messages").map(String::from_utf8_lossy));
    let output = String::from_utf8_lossy(engine.output("output").expect("output")).into_owned();
    let lines = engine.output("lines").expect("lines").chunks(4);
    let lines: Vec<u32> = lines.map(|own| u32::from_le_bytes(own.try_into().expect("four bytes"))).collect();
    assert_eq!(lines.len(), output.lines().count());
    let of = |block: &str| output.lines().position(|line| line.contains(block)).map(|at| lines[at]);
    assert_eq!((of("Z-1"), of("M3"), of("M30")), (Some(7), Some(5), Some(8)), "{output}\n{lines:?}");
    assert_eq!(lines[0], 0);
}

/// The answers for a program are written for the control that is stated; where several fit, nobody has said which.
#[test]
fn answers_go_into_a_project_file() {
    let text = "%\nO0101\nG21 G17 G90 G94 G40 G49 G80\nT1 M6\nG54 G0 X0. Y0. S3000 M3\nG43 H1 Z50.\nG1 Z-5 F100.\nM30\n%\n";
    let request = |from: &str| {
        let options = r#""to": "siemens", "from_option": { "decimal_point": "calculator" }"#;
        format!(r#"{{ "verb": "project", "file": "part.nc", "from": "{from}", {options} }}"#)
    };
    let (code, output, told) = done(text, &request("fanuc"));
    assert_eq!(code, 0, "{told}");
    assert!(output.contains("options = { decimal_point = \"calculator\" }"), "{output}");
    let (code, output, told) = done(text, &request("auto"));
    assert_eq!((code, output.as_str()), (1, ""), "{told}");
    assert!(told.contains("choose the control first"), "{told}");
}

/// What programs in other files may use too: programs and common variables, not what a program has for itself.
#[test]
fn names_that_other_files_may_use_are_marked() {
    let text = "%\nO1000\nG21 G17 G90 G94 G54\n#1=2\n#100=3\nWHILE [#1 GT 0] DO1\n#1=#1-1\nEND1\nM98 P2000\nM30\nO2000\nM99\n%\n";
    let (code, document, told) = done(text, r#"{ "verb": "names", "file": "part.nc", "from": "fanuc" }"#);
    assert_eq!(code, 0, "{told}");
    let document: Value = serde_json::from_str(&document).expect("JSON");
    let names = document["names"].as_array().expect("names").iter();
    let shared: Vec<&str> =
        names.filter(|name| name["shared"] == true).filter_map(|name| name["text"].as_str()).collect();
    assert_eq!(shared, ["1000", "100", "2000"]);
}

/// What a project file states holds for each request that names it, and what the request states goes before.
#[test]
fn a_project_file_is_read_back() {
    let project = "[[programs]]\nfiles = \"part.nc\"\nstock = \"X0:40 Y0:40 Z-10:0\"\nfixtures = [\"vise.stl\"]\ntable = -30\n\
                   to = \"haas-vf2\"\n[programs.machine]\ndialect = \"fanuc\"\noptions = { decimal_point = \"calculator\" }\n\
                   [[programs.machine.tool]]\nnumber = 1\nshape = \"ball\"\ndiameter = 8\n";
    let mut engine = Engine::default();
    engine.put(
        "part.nc",
        b"%\nO1\nG21 G17 G90 G94 G54\nT1 M6\nS3000 M3\nG0 X10. Y10. Z5.\nG1 Z-2. F200.\nG0 Z5.\nM30\n%\n"
            .to_vec(),
    );
    engine.put("ncc.toml", project.as_bytes().to_vec());
    let told =
        |engine: &Engine| engine.output("messages").map(|text| String::from_utf8_lossy(text).into_owned());
    let code = engine.run(r#"{ "verb": "stated", "file": "part.nc", "project": "ncc.toml" }"#);
    assert_eq!(code, 0, "{:?}", told(&engine));
    let stated: serde_json::Value =
        serde_json::from_slice(engine.output("document").expect("a document")).expect("JSON");
    assert_eq!(
        stated,
        serde_json::json!({
            "machine": { "name": null, "dialect": "fanuc", "options": { "decimal_point": "calculator" } },
            "to": { "name": "haas-vf2", "dialect": "haas", "options": {} },
            "stock": "X0:40 Y0:40 Z-10:0", "fixtures": ["vise.stl"], "table": -30.0, "files": ["vise.stl"],
            "told": ["ncc.toml names vise.stl, and there is no such file"],
        })
    );
    let row = |engine: &Engine| -> serde_json::Value {
        let document: serde_json::Value =
            serde_json::from_slice(engine.output("document").expect("a document")).expect("JSON");
        document["programs"][0].clone()
    };
    let request = r#"{ "verb": "simulate", "file": "part.nc", "project": "ncc.toml", "cells": 64, "fixtures": ["X50:60 Y0:40 Z-10:0"] }"#;
    assert_eq!(engine.run(request), 0, "{:?}", told(&engine));
    let own = row(&engine);
    assert_eq!((&own["raw"]["guessed"], &own["raw"]["high"][0]), (&false.into(), &40.0.into()));
    assert_eq!((&own["tools"][0]["shape"], &own["tools"][0]["known"]), (&"ball".into(), &"profile".into()));
    let over =
        request.replace("\"cells\"", "\"stock\": \"X0:60 Y0:40 Z-10:0\", \"from\": \"linuxcnc\", \"cells\"");
    assert_eq!(engine.run(&over), 0, "{:?}", told(&engine));
    let own = row(&engine);
    assert_eq!((&own["raw"]["high"][0], &own["tools"][0]["known"]), (&60.0.into(), &"guess".into()));
    let code = engine.run(r#"{ "verb": "translate", "file": "part.nc", "project": "ncc.toml" }"#);
    assert_eq!(code, 0, "{:?}", told(&engine));
    assert_eq!(engine.run(r#"{ "verb": "stated", "file": "other.nc", "project": "ncc.toml" }"#), 0);
    assert!(engine.output("document").is_none());
    engine.put("ncc.toml", b"[[programs]\n".to_vec());
    assert_eq!(engine.run(r#"{ "verb": "stated", "file": "part.nc", "project": "ncc.toml" }"#), 1);
}

/// A profile and a body that a project file names, and that no file is, are reported; nothing else fails with them.
#[test]
fn what_a_project_file_names_may_be_away() {
    let project = "[[programs]]\nfiles = \"part.nc\"\nmachine = \"machines/ours.toml\"\nstock = \"models/raw.stl\"\n\
                   fixtures = [\"models/vise.stl\", \"X50:60 Y0:40 Z-10:0\"]\nto = \"old.toml\"\n";
    let mut engine = Engine::default();
    let part =
        "%\nO1\nG21 G17 G90 G94 G54\nT1 M6\nS3000 M3\nG0 X10. Y10. Z5.\nG1 Z-2. F200.\nG0 Z5.\nM30\n%\n";
    engine.put("part.nc", part.as_bytes().to_vec());
    engine.put("ncc.toml", project.as_bytes().to_vec());
    let told = |engine: &mut Engine, verb: &str, more: &str| {
        let request = format!(
            r#"{{ "verb": "{verb}", "file": "part.nc", "project": "ncc.toml", "from": "fanuc"{more} }}"#
        );
        let code = engine.run(&request);
        let told = String::from_utf8_lossy(engine.output("messages").expect("messages")).into_owned();
        (code, told)
    };
    let warning = |name: &str| format!("warning: ncc.toml names {name}, and there is no such file\n");
    let machine = warning("machines/ours.toml");
    for verb in ["check", "time", "path"] {
        let (code, told) = told(&mut engine, verb, "");
        assert!(code < 2 && told.matches(&machine).count() == 1, "{verb}: {code} {told}");
    }
    let (code, messages) = told(&mut engine, "simulate", r#", "cells": 64"#);
    let all = ["machines/ours.toml", "models/raw.stl", "models/vise.stl"].map(warning);
    assert!(code == 0 && all.iter().all(|text| messages.matches(text).count() == 1), "{code} {messages}");
    let document: serde_json::Value =
        serde_json::from_slice(engine.output("document").expect("a document")).expect("JSON");
    let row = &document["programs"][0];
    assert_eq!((&row["raw"]["guessed"], row["fixtures"].as_array().map(Vec::len)), (&true.into(), Some(1)));
    let (code, messages) = told(&mut engine, "translate", r#", "to": "haas", "assume": true"#);
    assert!(
        code == 0 && messages.contains(&machine) && messages.contains(&warning("old.toml")),
        "{messages}"
    );
    // What the request names must be there.
    let (code, messages) = told(&mut engine, "path", r#", "machine": "machines/ours.toml""#);
    assert!(code == 2 && !messages.contains("warning"), "{messages}");
}

/// The document of a simulation has all of a tool's shape that was stated, so that it can be stated again.
#[test]
fn the_shape_of_a_tool_is_told_in_full() {
    let mut engine = Engine::default();
    let part =
        "%\nO1\nG21 G17 G90 G94 G54\nT1 M6\nS3000 M3\nG0 X10. Y10. Z5.\nG1 Z-2. F200.\nG0 Z5.\nM30\n%\n";
    engine.put("part.nc", part.as_bytes().to_vec());
    let mut detail = |tool: &str| {
        let request =
            r#"{ "verb": "simulate", "file": "part.nc", "from": "fanuc", "cells": 64, "tools": [TOOL] }"#;
        let told = engine.run(&request.replace("TOOL", tool));
        assert!(told < 2, "{tool}");
        let document: serde_json::Value =
            serde_json::from_slice(engine.output("document").expect("a document")).expect("JSON");
        let tool = &document["programs"][0]["tools"][0];
        ["corner", "angle", "end_diameter"].map(|key| tool[key].as_f64())
    };
    assert_eq!(detail("\"1=bull-nose,10,corner=2\""), [Some(2.0), None, None]);
    assert_eq!(detail("\"1=drill,6.8,angle=140\""), [None, Some(140.0), None]);
    assert_eq!(detail("\"1=chamfer,10,angle=90,end_diameter=1\""), [None, Some(90.0), Some(1.0)]);
    assert_eq!(detail("\"1=taper,10,angle=3\""), [None, Some(3.0), None]);
    // A guess is none of it.
    assert_eq!(detail(""), [None; 3]);
    assert_eq!(detail("\"1=bull-nose,10\""), [None; 3]);
}

/// A called program in another file, by its number, by the file's name, and by both.
#[test]
fn a_called_program_is_found_in_another_file() {
    let found = |from: &str, main: &str, line: usize, others: &[(&str, &str)]| {
        let mut engine = Engine::default();
        for (name, text) in others.iter().chain(&[("main.nc", main)]) {
            engine.put(name, text.as_bytes().to_vec());
        }
        let code = engine.run(&format!(
            r#"{{ "verb": "called", "file": "main.nc", "from": "{from}", "line": {line}, "column": 5 }}"#
        ));
        let told = String::from_utf8_lossy(engine.output("messages").unwrap_or_default()).into_owned();
        assert_eq!(code, 0, "{told}");
        engine.output("document").map(|text| serde_json::from_slice::<Value>(text).expect("JSON"))
    };
    let at = |file: &str, line: u64| Some(serde_json::json!({ "file": file, "line": line }));
    let main = "%\nO1\nG21 G17 G90 G94 G54\nM98 P2000\nM98 P2001\nM98 P3000\nM30\n%\n";
    let others = [("bores.nc", "%\n(BORES)\nO2000\nG0 X1.\nM99\n%\n"), ("O2001.nc", "G0 X2.\nM99\n")];
    assert_eq!(found("fanuc", main, 4, &others), at("bores.nc", 3));
    assert_eq!(found("fanuc", main, 5, &others), at("O2001.nc", 1));
    assert_eq!(found("fanuc", main, 6, &others), None);
    let main = "G21 G17 G90 G94 G54\no<bore> call [3]\nM2\n";
    let others = [("bore.ngc", "; a bore\no<bore> sub\nG0 X#1\no<bore> endsub\n")];
    assert_eq!(found("linuxcnc", main, 2, &others), at("bore.ngc", 2));
    let main = "G71 G17 G90 G94 G54\nL300\nBOHREN\nM30\n";
    let others = [("L300.SPF", "G0 X1\nRET\n"), ("BOHREN.SPF", "; holes\nG0 X2\nRET\n")];
    assert_eq!(found("siemens", main, 2, &others), at("L300.SPF", 1));
    assert_eq!(found("siemens", main, 3, &others), at("BOHREN.SPF", 1));
}
