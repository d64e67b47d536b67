//! Program numbers, subprograms, start and end.

use super::*;

fn errors(id: &str, text: &str) -> Vec<String> {
    diagnostics(&read(id, text), text).into_iter().filter(|d| !d.starts_with("Assumed")).collect()
}

#[test]
fn the_case_study_reads_without_a_fault() {
    let text = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../corpus/mach9/teste.cn")).unwrap();
    let out = read_with(settings("mach9"), true, &text);
    assert_eq!(out.stmts.len(), 59);
    let text = String::from_utf8(text).unwrap();
    assert_eq!(
        diagnostics(&out, &text),
        [
            "AssumedNoEffect { code: 'G66' } at 'G66'",
            "AssumedWorkOffset { offset: 1 } at 'GZ0'",
            "AssumedMode { fact: LengthOffset, value: '0' } at 'GZ0'",
            "AssumedOption { option: 'o_word', value: 'offset' } at 'O1'",
            "AssumedOffsetWithZ at 'O1'",
            "AssumedOption { option: 'g24_centre', value: 'current' } at 'G24'",
            "AssumedOption { option: 'cycle_approach', value: 'plane' } at 'G24'",
            "AssumedOption { option: 'g24_direction', value: 'ccw' } at 'G24'"
        ]
    );
    assert_eq!(
        stmts(&out)[22..27],
        ["S3183", "& StartSpindleClockwise", "& LENGTH 2", "TRAVERSE! Z5.", "TRAVERSE! X0 Y0"]
    );
}

#[test]
fn names_and_titles() {
    let out = read("fanuc", "%\nO1234(PART 12)\nM30\n%\n");
    assert_eq!((out.name.number, out.name.title.as_deref()), (Some(1234), Some("PART 12")));
    assert_eq!(stmts(&out), ["ProgramEnd"]);
    assert!(out.diagnostics.is_empty() && !out.whole);
    assert_eq!(read("fanuc", ":0097\nM30\n").name.number, Some(97));
    assert_eq!(stmts(&read("fanuc", "O5 (A) (B) G21\nM30\n")), ["UseLengthUnits(Mm) (B)", "ProgramEnd"]);
    // The number is given at the control.
    let unnumbered = read("fanuc", "O0000 (PART 12)\nM30\n");
    assert_eq!((unnumbered.name.number, unnumbered.name.title.as_deref()), (None, Some("PART 12")));
    assert_eq!(errors("fanuc", "O1\nM30\nO0\n"), ["OutOfRange { word: Word('O0') } at 'O0'"]);
    assert_eq!(errors("fanuc", "O1\nM30\nO1\nM99\n"), ["ProgramTwice { name: '1' } at 'O1'"]);
}

#[test]
fn frame_marks() {
    assert_eq!(stmts(&read("fanuc", "% LEADER\nM30\n%\n")), ["ProgramEnd"]);
    assert_eq!(errors("fanuc", "%\nM30\n%\n\nREST 1\nMORE\n"), ["TextAfterEnd at 'REST 1'"]);
    // A mark after the end needs none before the program; one in the middle of it does.
    assert_eq!(errors("fanuc", "M30\n%\n"), Vec::<String>::new());
    assert_eq!(errors("haas", "O1\nM30\n%\n"), Vec::<String>::new());
    assert_eq!(errors("linuxcnc", "M30\n%\nG0 X1\n"), ["TextAfterEnd at 'G0 X1'"]);
    assert!(
        errors("fanuc", "G21\n%\nM30\n")
            .contains(&"OpeningMarkMissing { mark: '%', follows: false } at '%'".to_owned())
    );
    assert_eq!(errors("fanuc", "(NOTE)\n%\nM30\n%\n"), Vec::<String>::new());
    assert_eq!(errors("mach9", "%\nM2\n"), ["UnexpectedCharacter { found: '%' } at '%'"]);
}

#[test]
fn text_before_the_first_mark_is_a_leader() {
    for id in ["fanuc", "haas"] {
        let text = "Posted by CAM\nREV 2\n\n%\nO1\nG21\nM30\n%\n";
        assert_eq!(errors(id, text), ["TextBeforeStart { mark: '%' } at 'Posted by CAM'"]);
        assert_eq!(read(id, text).name.number, Some(1));
        for text in ["\0\0\0\n%\nO1\nM30\n%\n\0\0", "\0\0%\nO1\nM30\n%\n", "%\nO1\nM30\n%\n\0\0\n"] {
            assert_eq!(errors(id, text), Vec::<String>::new(), "{text:?}");
            assert_eq!(read(id, text).name.number, Some(1), "{text:?}");
        }
        // What may be executed is never skipped.
        for text in ["G0 X1.\n%\nO1\nM30\n%\n", "NOTE\nX 1.\n%\nO1\nM30\n%\n"] {
            assert!(errors(id, text).iter().any(|e| e.starts_with("OpeningMarkMissing")), "{text:?}");
        }
        // A mark after the end of the program is no first one, unless blocks follow it: a control begins there.
        assert_eq!(errors(id, "O1\nM30\n%\nNOTE\n"), ["TextAfterEnd at 'NOTE'"]);
        let between = ["OpeningMarkMissing { mark: '%', follows: true } at '%'"];
        assert_eq!(errors(id, "O1\nM30\n%\nNOTE\nO2\nG0 X1.\nM30\n%\n")[1..], between);
        assert_eq!(errors(id, "M30\n%\nG0 X1.\nM30\n%\n"), between);
        assert_eq!(errors(id, "O1\nM30\n%\n%\n"), [between[0].replace("true", "false")]);
        assert!(errors(id, "%\nO1\nG0\0\nM30\n%\n").iter().any(|e| e.starts_with("NotText")));
    }
    assert!(!errors("linuxcnc", "NOTE\n%\nM2\n%\n").is_empty());
}

#[test]
fn calls() {
    let calls = |piece: &str| after_head("fanuc", piece);
    assert_eq!(calls("M98 P1002\n"), ["CALL 1002 x1"]);
    assert_eq!(calls("M98 P51002\n"), ["CALL 1002 x5"]);
    assert_eq!(calls("M98 P30012\n"), ["CALL 12 x3"]);
    assert_eq!(calls("M98 P1002 L4\n"), ["CALL 1002 x4"]);
    assert_eq!(calls("M98 P51002 L4\n"), ["CALL 51002 x4"]);
    assert_eq!(calls("G0 X1. M98 P7\n"), ["TRAVERSE! X1.", "& CALL 7 x1"]);
    assert_eq!(faults("fanuc", "M98\n"), ["WordMissing { code: 'M98', word: 'P' } at 'M98'"]);
    assert_eq!(faults("fanuc", "M98 P0\n"), ["OutOfRange { word: Word('P0') } at 'P0'"]);
    assert_eq!(faults("fanuc", "M98 P1002 Q300\n"), ["WordUnused { word: 'Q300' } at 'Q300'"]);
}

#[test]
fn subprograms_stand_after_the_main_program() {
    let out = read("fanuc", "%\nO1\nM98 P12\nM30\n(SUBS)\nO0012(HOLES)\nX1.\nM99\nO13\nM99\n%\n");
    let names: Vec<_> = out.procedures.iter().map(|p| (&*p.name, p.title.as_deref())).collect();
    assert_eq!(names, [("12", Some("HOLES")), ("13", None)]);
    assert_eq!(stmts(&out), ["CALL 12 x1", "ProgramEnd", "(SUBS)"]);
    // The first call's name is the subprogram's.
    assert_eq!(out.procedures[0].body.len(), 2);
    // A standalone subprogram.
    assert!(errors("fanuc", "O1\nM99\n").is_empty());
    // One that begins again: the program's end is the usual last block after it, and never executed.
    assert!(errors("fanuc", "O1\nM99\nM30\n").is_empty());
    assert_eq!(stmts(&read("fanuc", "O1\nM99\nM30\n")), ["BeginAgain"]);
    assert_eq!(stmts(&read("fanuc", "O1\n/M99\nM30\n")), ["/1 BeginAgain", "ProgramEnd"]);
    assert_eq!(stmts(&read("linuxcnc", "G21\nM99\n")).last().map(String::as_str), Some("BeginAgain"));
    assert_eq!(errors("fanuc", "O1\nM99\nG21\n"), ["TextAfterEnd at 'G21'"]);
    let what = "Call(MainReturn)";
    let told = format!("NotSupported {{ code: 'M99', what: {what} }} at 'M99'");
    assert_eq!(errors("fanuc", "O1\n/M99\nM99\n"), [told]);
    // One that says where its caller goes on.
    assert!(errors("fanuc", "O1\nM98 P2\nN100 M30\nO2\nM99 P100\n").is_empty());
    let what = "Call(ReturnElsewhere)";
    let told = format!("NotSupported {{ code: 'M99', what: {what} }} at 'M99'");
    assert_eq!(errors("fanuc", "O1\nM30\nO2\nM99 P100\n"), [told]);
    assert_eq!(errors("fanuc", "O1\nM99 P100\n"), ["WordUnused { word: 'P100' } at 'P100'"]);
}

#[test]
fn ends() {
    assert_eq!(errors("mach9", "G71\nM5\n"), ["NoProgramEnd at 'M5'"]);
    assert_eq!(errors("mach9", "M2"), Vec::<String>::new());
    assert_eq!(errors("mach9", "M2\n\n\n\x1A"), Vec::<String>::new());
    assert_eq!(errors("fanuc", "M30\n\x1A\x1A\n"), Vec::<String>::new());
    assert_eq!(errors("mach9", "M2\nG71\nG70\n"), ["TextAfterEnd at 'G71'"]);
    assert_eq!(errors("fanuc", "O1\nG21\nO2\nM99\n"), ["NoProgramEnd at 'G21'"]);
    assert_eq!(errors("fanuc", "O1\nM30\nO2\nM8\n\x1A"), ["NoProgramEnd at 'M8'"]);
    assert_eq!(read("fanuc", "O1\nM30\nO2\nM8\n\x1A").procedures.len(), 1);
    // A switch may let the program run on.
    assert_eq!(errors("fanuc", "/M30\nM8\nM30\n"), Vec::<String>::new());
}

#[test]
fn nothing_to_translate() {
    for text in ["", "\n\n", "%\n%\n", "(NOTE)\n", "O1234\n", "\u{FEFF}"] {
        assert_eq!(errors("fanuc", text), ["EmptyProgram at ''"], "{text:?}");
    }
    assert_eq!(errors("mach9", ";NOTE\n"), ["EmptyProgram at ''"]);
}

#[test]
fn texts_that_are_none() {
    assert_eq!(errors("mach9", "M2\n\0\0\n"), ["NotText at '\\0'"]);
    let noise = "\x01\n".repeat(100);
    let found = errors("fanuc", &noise);
    assert_eq!(found.len(), 17);
    assert_eq!(found[16], "NotText at '\\u{1}'");
    assert_eq!(stmts(&read("fanuc", "\u{FEFF}M8\nM30\n")), ["FloodOn", "ProgramEnd"]);
}
