//! Programs that are not for a mill: one message and exit code 1 in every verb, and the way on.

use super::*;

/// A thread on a lathe; a mill would shift its origin and go rapidly into the part.
const THREAD: &str = "G21 G40 G99\nT0303\nG97 S800 M03\nG00 X32. Z5.\nG92 X29.5 Z-20. F1.5\nX29.1\nM30\n";
/// The same place on a mill.
const MILL: &str = "O1\nG21 G90 G17 G94 G54\nS1000 M03\nG00 X0 Y0\nG01 Z-1. F100.\nM30\n";

fn thread() -> tempfile::TempDir {
    let folder = folder();
    std::fs::write(folder.path().join("thread.nc"), THREAD).unwrap();
    std::fs::write(folder.path().join("mill.nc"), MILL).unwrap();
    folder
}

#[test]
fn every_verb_refuses_a_lathe_program() {
    let folder = thread();
    for arguments in [
        &["fanuc", "to", "siemens", "thread.nc"][..],
        &["auto", "to", "siemens", "thread.nc"],
        &["haas", "to", "linuxcnc", "thread.nc", "-q"],
        &["fanuc", "to", "siemens", "thread.nc", "mill.nc", "-o", "out"],
        &["time", "thread.nc"],
        &["time", "thread.nc", "mill.nc", "--from", "fanuc"],
        &["check", "thread.nc", "--from", "haas"],
        &["plot", "thread.nc"],
        &["fmt", "fanuc:thread.nc"],
        &["diff", "thread.nc", "mill.nc"],
        &["verify", "fanuc:mill.nc", "fanuc:thread.nc"],
        &["doctor", "thread.nc", "--from", "fanuc", "--to", "siemens"],
    ] {
        let done = ncc(folder.path(), arguments).exits(1);
        assert_eq!(
            done.err.matches("error[NC0120]: this looks like a lathe program").count(),
            1,
            "{arguments:?}"
        );
        assert!(done.err.contains("G92 X Z F is a threading cycle of a lathe"), "{arguments:?}");
        assert!(!done.err.contains("reads like"), "{arguments:?}:\n{}", done.err);
    }
}

#[test]
fn a_refusal_reads_as_written_down() {
    let folder = thread();
    let done = ncc(folder.path(), &["auto", "to", "siemens", "thread.nc"]).exits(1);
    assert_eq!(done.out, "");
    expect("lathe.txt", &done.err);
    let done = ncc(folder.path(), &["fanuc", "to", "siemens", "thread.nc", "--format", "json"]).exits(1);
    let lines: Vec<serde_json::Value> =
        done.err.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 2, "{}", done.err);
    for (line, severity) in lines.iter().zip(["question", "error"]) {
        assert_eq!((line["code"].as_str(), line["place"]["line"].as_u64()), (Some("NC0120"), Some(5)));
        assert_eq!(line["severity"], severity);
    }
}

/// The report of one program and the row of a batch ask whether the program is for a mill.
#[test]
fn a_lathe_or_a_mill_is_a_question_for_programs() {
    let folder = thread();
    let at = folder.path();
    ncc(at, &["fanuc", "to", "siemens", "thread.nc", "--report", "r.json"]).exits(1);
    let report: serde_json::Value =
        serde_json::from_slice(&std::fs::read(at.join("r.json")).unwrap()).unwrap();
    assert_eq!((&report["result"], &report["source"]["dialect"]), (&"refused".into(), &"fanuc".into()));
    assert_eq!(report["diagnostics"][0]["code"], "NC0120");
    let done = ncc(at, &["auto", "to", "siemens", "thread.nc", "mill.nc", "-o", "out", "--format", "json"]);
    let batch: serde_json::Value = serde_json::from_str(&done.exits(1).out).unwrap();
    for questions in [&report["questions"], &batch["files"][0]["questions"]] {
        assert_eq!(questions.as_array().map(Vec::len), Some(1), "{questions}");
        let asked = &questions[0];
        assert_eq!(asked["question"], "this looks like a lathe program");
        assert_eq!(asked["answers"][0]["result"], "a lathe program, not translated");
        assert_eq!(asked["answers"][1]["option"], "--assume milling");
    }
    assert_eq!(batch["files"][1]["questions"], serde_json::json!([]));
    ncc(at, &["fanuc", "to", "siemens", "thread.nc", "--report", "thread.nc"]).exits(2);
}

#[test]
fn few_signs_are_a_question() {
    let folder = folder();
    std::fs::write(folder.path().join("few.nc"), "G0 X12. Z4.\nG32 Z-16. F1.25\n").unwrap();
    ncc(folder.path(), &["fanuc", "to", "siemens", "few.nc"]).exits(1).says("is this a lathe program?");
}

#[test]
fn what_is_assumed_goes_on_and_is_stated() {
    let folder = thread();
    for assume in [&["--assume", "milling"][..], &["--assume=milling"]] {
        let arguments =
            [&["fanuc", "to", "siemens", "thread.nc", "--report", "report.json"], assume].concat();
        let done = ncc(folder.path(), &arguments).exits(0).says("read as a milling program");
        let head = "assumed: a milling program, though line 5 looks like a lathe program";
        assert!(done.out.contains(head), "{}", done.out);
        let report = std::fs::read_to_string(folder.path().join("report.json")).unwrap();
        assert!(report.contains("NC0350"), "{report}");
    }
    let denied = ["fanuc", "to", "siemens", "thread.nc", "--assume", "milling", "--deny", "assumed"];
    ncc(folder.path(), &denied).exits(1).says("NC0350");
    let timed = ncc(folder.path(), &["time", "thread.nc", "--from", "fanuc", "--assume", "milling"]);
    timed.exits(0).says("thread.nc: looks like a lathe program (line 5); read as a milling program");
    // Of two readings alone: a lathe program is none of them.
    ncc(folder.path(), &["time", "thread.nc", "--assume"]).exits(1).says("--assume milling");
}

#[test]
fn git_is_shown_the_text() {
    let folder = thread();
    let done = ncc(folder.path(), &["git-textconv", "thread.nc"]).exits(0);
    assert_eq!(done.out, THREAD);
    assert_eq!(done.err, "thread.nc looks like a lathe program; shown as it is\n");
    std::fs::write(folder.path().join("new.nc"), THREAD.replace("X29.1", "X29.2")).unwrap();
    let git = ["git-diff", "part.nc", "thread.nc", "0", "100644", "new.nc", "0", "100644"];
    let done = ncc(folder.path(), &git).exits(0);
    assert!(
        done.out.contains("part.nc (new) looks like a lathe program; the texts are compared"),
        "{}",
        done.out
    );
    assert!(done.out.contains("\n-X29.1\n+X29.2\n"), "{}", done.out);
}

#[test]
fn another_dialect_is_named_only_where_it_has_fewer_errors() {
    let folder = folder();
    // The same error in every dialect: nothing is gained by another one.
    let wrong = "O00012\nG20 G90 G54\nT1 M06\nG43 H1 Z1.\nG01 X1. Y1. F10.\nM30\nG01 QQ\n";
    std::fs::write(folder.path().join("wrong.nc"), wrong.replace("M30\nG01 QQ\n", "G01 QQ\nM30\n")).unwrap();
    let done = ncc(folder.path(), &["haas", "to", "siemens", "wrong.nc"]).exits(1);
    assert!(!done.err.contains("reads like"), "{}", done.err);
    // A program of the controller mach9 has many errors as fanuc's.
    let done = ncc(folder.path(), &["fanuc", "to", "siemens", "good.cn"]).exits(1);
    assert!(done.err.contains("reads like mach9"), "{}", done.err);
}
