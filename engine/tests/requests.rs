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
fn machines_are_listed_with_their_dialects() {
    let (code, engine) = done(&[], r#"{ "verb": "machines" }"#);
    assert_eq!(code, 0);
    assert!(text(&engine, "document").contains("\"haas-vf2\""));
}
