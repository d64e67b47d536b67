//! What is said on stderr, in which form, and what stops a translation.

use super::*;

#[test]
fn a_good_translation_says_what_was_verified() {
    let folder = folder();
    let done = ncc(folder.path(), &["mach9", "to", "fanuc", "good.cn"]).exits(0);
    let first = done.err.lines().next().unwrap_or_default();
    assert!(first.starts_with("good.cn: mach9 to fanuc, verified: the same "), "{}", done.err);
    assert!(!done.err.contains('\x1b'), "colour without a terminal");
    let quiet = ncc(folder.path(), &["mach9", "to", "fanuc", "good.cn", "--quiet"]).exits(0);
    assert_eq!((quiet.err.as_str(), quiet.out), ("", done.out));
    let unverified = ncc(folder.path(), &["mach9", "to", "fanuc", "good.cn", "--no-verify"]).exits(0);
    assert!(unverified.err.contains("NOT VERIFIED") && unverified.out.contains("UNVERIFIED"));
}

#[test]
fn the_case_study_reads_well() {
    let folder = folder();
    let teste = Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpus/mach9/teste.cn");
    std::fs::copy(teste, folder.path().join("teste.cn")).unwrap();
    let done = ncc(folder.path(), &["mach9", "to", "fanuc", "teste.cn"]).exits(0);
    expect("teste-summary.txt", &done.err);
}

/// What a way of taking corners does to the feed is not lost among numbers that are rounded.
#[test]
fn corners_are_told_by_what_they_do() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let told = ncc(&root, &["fanuc", "to", "siemens", "corpus/fanuc/corner-override.nc"]).exits(0);
    let told = told.says("  check at the machine   ");
    let told = told.says("  the feed, not lowered at inner corners of a contour (line");
    let told = told.says("  the feed, which can be held and overridden (line");
    let harmless = told.err.split_once("no effect on the cut").map_or("", |(_, rest)| rest);
    assert!(!harmless.contains("corners") && !harmless.contains("the feed"), "{}", told.err);
    let all = ncc(&root, &["fanuc", "to", "siemens", "corpus/fanuc/corner-override.nc", "-v"]).exits(0);
    all.says("full feed at inner corners of a contour").says("do not use feed hold and override");
}

#[test]
fn an_error_shows_the_place_and_the_mend() {
    let folder = folder();
    let done = ncc(folder.path(), &["mach9", "to", "fanuc", "bad.cn"]).exits(1);
    assert_eq!(done.out, "");
    let done = done
        .says("error[NC0107]")
        .says("bad.cn:2:")
        .says("│ GOX-15.")
        .says("write the digit 0: `G0X-15.`")
        .says("nothing was written");
    let quiet = ncc(folder.path(), &["mach9", "to", "fanuc", "bad.cn", "-q"]).exits(1);
    assert!(done.err.starts_with(&quiet.err) && quiet.err.contains("NC0107"));
    let colour = ncc(folder.path(), &["mach9", "to", "fanuc", "bad.cn", "--color", "always"]).exits(1);
    assert!(colour.err.contains("\x1b["));
}

#[test]
fn every_verb_takes_a_colour() {
    let folder = folder();
    for line in [
        "explain NC9999",
        "dialects show nope",
        "dialects test nope.toml",
        "machines show nope",
        "doctor none.cn --to fanuc",
        "time none.cn --machine nope",
        "plot none.cn --machine nope",
        "mach9 to nope good.cn",
    ] {
        for (colour, shown) in [("always", true), ("never", false)] {
            let words: Vec<&str> = line.split(' ').chain(["--color", colour]).collect();
            let done = ncc(folder.path(), &words);
            assert_eq!(done.err.contains("\x1b["), shown, "{words:?}: {}", done.err);
            let before: Vec<&str> = ["--color", colour].into_iter().chain(line.split(' ')).collect();
            assert_eq!(ncc(folder.path(), &before).err, done.err, "{before:?}");
        }
    }
}

#[test]
fn the_doctor_is_quiet_or_verbose() {
    let folder = folder();
    let usual = ncc(folder.path(), &["doctor", "good.cn", "--to", "fanuc"]).exits(0).says("read as mach9");
    let quiet = ncc(folder.path(), &["doctor", "good.cn", "--to", "fanuc", "-q"]).exits(0);
    assert_eq!((quiet.err.as_str(), &quiet.out), ("", &usual.out));
    let verbose = ncc(folder.path(), &["doctor", "good.cn", "--to", "fanuc", "-v"]).exits(0).says("[NC0");
    assert!(!usual.err.contains("[NC0") && verbose.out == usual.out, "{}{}", usual.err, verbose.err);
}

#[test]
fn json_is_one_object_a_line() {
    let folder = folder();
    let done = ncc(folder.path(), &["mach9", "to", "fanuc", "bad.cn", "--format", "json"]).exits(1);
    let lines: Vec<serde_json::Value> =
        done.err.lines().map(|line| serde_json::from_str(line).expect(line)).collect();
    let error = lines.iter().find(|l| l["code"] == "NC0107").expect("the error");
    assert_eq!((&error["severity"], &error["place"]["line"]), (&"error".into(), &2.into()));
    let start = error["place"]["start"].as_u64().unwrap() as usize;
    let end = error["place"]["end"].as_u64().unwrap() as usize;
    assert_eq!(error["place"]["text"], BAD[start..end]);
    assert_eq!(lines.last().unwrap()["result"], "refused");
    let usage = ncc(folder.path(), &["mach9", "to", "fanuc", "none.cn", "--format", "json"]).exits(4);
    let line: serde_json::Value = serde_json::from_str(usage.err.trim_end()).unwrap();
    assert_eq!(line["severity"], "error");
}

#[test]
fn a_report_tells_everything() {
    let folder = folder();
    let report = |file: &str, code| -> serde_json::Value {
        ncc(folder.path(), &["mach9", "to", "fanuc", file, "-q", "--report", "r.json"]).exits(code);
        serde_json::from_slice(&std::fs::read(folder.path().join("r.json")).unwrap()).unwrap()
    };
    let good = report("good.cn", 0);
    assert_eq!(good["ncc_report"], 1);
    assert_eq!(good["source"]["name"], "good.cn");
    assert_eq!(good["source"]["bytes"], GOOD.len());
    assert_eq!(good["source"]["sha256"].as_str().unwrap().len(), 64);
    assert_eq!(good["source"]["options"]["o_word"]["value"], "offset");
    assert_eq!(good["target"]["dialect"], "fanuc");
    assert_eq!(good["result"], "verified");
    assert!(good["verification"]["worlds"].as_u64().unwrap() >= 2);
    assert!(good["verification"]["events"].as_u64().unwrap() > 0);
    assert!(good["verdicts"]["exact"].as_u64().unwrap() > 0);
    assert!(!good["assumptions"].as_array().unwrap().is_empty());
    let told = good["diagnostics"].as_array().unwrap();
    assert!(told.iter().any(|d| d["verdict"] == "assumed" && d["place"]["line"].as_u64() > Some(0)));
    let bad = report("bad.cn", 1);
    assert_eq!((&bad["result"], &bad["target"]["bytes"]), (&"refused".into(), &0.into()));
}

#[test]
fn a_verdict_can_be_denied() {
    let folder = folder();
    let done = ncc(folder.path(), &["mach9", "to", "fanuc", "good.cn", "--deny", "assumed"]).exits(1);
    assert_eq!(done.out, "");
    done.says("error[NC03").says("--deny assumed").says("verdicts that are not allowed");
    // What is denied stops even if it is allowed too.
    ncc(folder.path(), &["mach9", "to", "fanuc", "good.cn", "--deny", "assumed", "--allow", "assumed"])
        .exits(1);
}

#[test]
fn of_many_messages_twenty_of_a_kind_are_shown() {
    let folder = folder();
    std::fs::write(folder.path().join("many.cn"), "GOX-15.\n".repeat(50)).unwrap();
    let done = ncc(folder.path(), &["mach9", "to", "fanuc", "many.cn"]).exits(1);
    assert_eq!(done.err.matches("error[NC0107]").count(), 20);
    done.says("… and 30 more of NC0107");
}

#[test]
fn an_unknown_dialect_of_a_text_is_not_guessed() {
    let folder = folder();
    std::fs::write(folder.path().join("p.nc"), "G0 X1.\nM30\n").unwrap();
    let done = ncc(folder.path(), &["auto", "to", "ir", "p.nc"]).exits(2);
    assert_eq!(done.out, "");
    done.says("is not certain").says("name it: --from");
    let done = ncc(folder.path(), &["auto", "to", "fanuc", "good.cn"]).exits(0);
    done.says("good.cn: read as mach9: ");
}

#[test]
fn a_program_in_another_dialect_is_noticed() {
    let folder = folder();
    ncc(folder.path(), &["fanuc", "to", "canon", "good.cn"])
        .exits(1)
        .says("good.cn reads like mach9: ")
        .says("help: ncc mach9 to canon good.cn");
    let bad = ncc(folder.path(), &["mach9", "to", "canon", "bad.cn"]).exits(1);
    assert!(!bad.err.contains("reads like"), "{}", bad.err);
}

#[test]
fn of_a_binary_only_that_is_said() {
    let folder = folder();
    let binary: Vec<u8> = (0..=255u8).cycle().take(100_000).collect();
    std::fs::write(folder.path().join("binary.cn"), binary).unwrap();
    for from in ["mach9", "fanuc", "canon", "ir"] {
        let done = ncc(folder.path(), &[from, "to", "fanuc", "binary.cn"]).exits(1);
        assert_eq!(done.err.matches("error[").count(), 1, "{from}: {}", done.err);
        done.says("NC0105").says("this file is not a part program");
    }
}

/// Text for a device stays what it is where the control has one, and is lost where it has none.
#[test]
fn text_for_a_device() {
    let folder = folder();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let run = |arguments: &[&str]| ncc(folder.path(), arguments);
    let source = "%\nO4050\nG21 G17 G90 G94 G40 G49 G80\nPOPEN\nDPRNT[***HOLES*]\nDPRNT[]\n#100 = 1.5436\n\
        #1 = 1\nG54 G0 X0. Y0.\nWHILE [#1 LE 2] DO1\nX[20. * #1]\nDPRNT[NO#1[20]*D#100[44]/-+] (A SIZE)\n\
        #1 = #1 + 1\nEND1\n/PCLOS\nM30\n%\n";
    write("sizes.nc", source);
    for to in ["fanuc", "haas"] {
        let told = run(&["fanuc", "to", to, "sizes.nc", "-o", "out.nc"]).exits(0).err;
        let blanks = "never empty or too long; blanks stand before them";
        assert_eq!(told.contains(blanks), to == "haas", "{told}");
        let written = read("out.nc");
        let lines =
            ["POPEN\nDPRNT[***HOLES*]\nDPRNT[]\n", "DPRNT[NO#1[20]*D#100[44]/-+] (A SIZE)\n", "/PCLOS\n"];
        assert!(lines.iter().all(|line| written.contains(line)), "{written}");
        let out = format!("{to}:out.nc");
        run(&["verify", "fanuc:sizes.nc", &out]).exits(0);
        // Other digits, another text, no device.
        for (was, is) in [("[44]", "[34]"), ("*HOLES", "*SLOTS"), ("POPEN\n", "")] {
            write("other.nc", &written.replace(was, is));
            run(&["verify", "fanuc:sizes.nc", &format!("{to}:other.nc")]).exits(1);
        }
    }
    for to in ["siemens", "linuxcnc"] {
        // The cut is the same without it.
        let told = run(&["fanuc", "to", to, "sizes.nc", "-o", "lost"]).exits(0).err;
        assert!(told.contains("text for a device or a file left out"), "{told}");
        assert!(read("lost").contains("NO... D.../-+"), "{}", read("lost"));
    }
    // What was executed has its values written out, which no such text has.
    let told = run(&["fanuc", "to", "fanuc", "sizes.nc", "-o", "flat.nc", "--pass", "flatten"]).exits(1).err;
    assert!(told.contains("has no output with these characters"), "{told}");
    // A Haas writes eight digits, and needs nothing opened.
    write("digits.nc", &source.replace("[44]", "[54]"));
    let told = run(&["fanuc", "to", "haas", "digits.nc", "-o", "no.nc"]).exits(1).err;
    assert!(told.contains("haas has no output value with these digits"), "{told}");
    assert!(
        run(&["haas", "to", "haas", "digits.nc", "-o", "no.nc"]).exits(1).err.contains("more digits than")
    );
    write("unopened.nc", &source.replace("POPEN\n", ""));
    run(&["haas", "to", "haas", "unopened.nc", "-o", "open.nc"]).exits(0);
    let told = run(&["haas", "to", "fanuc", "unopened.nc", "-o", "no.nc"]).exits(1).err;
    assert!(told.contains("output to a device that the program does not open"), "{told}");
}

/// What the output takes for granted of the target's control is told as what the source does.
#[test]
fn the_output_tells_what_it_takes_for_granted() {
    let folder = folder();
    let program =
        "%\nO1\nG21 G17 G90 G94 G54\nG00 X0. Y0. Z5.\n#1 = ROUND[#500 * 1.5]\nG01 X#1 F100.\nM30\n%\n";
    std::fs::write(folder.path().join("half.nc"), program).unwrap();
    let done = ncc(folder.path(), &["fanuc", "to", "siemens", "half.nc", "-v"]).exits(0);
    let told = "not stated: half of a negative number, rounded\n";
    assert_eq!(done.err.matches(told).count(), 1, "{}", done.err);
}
