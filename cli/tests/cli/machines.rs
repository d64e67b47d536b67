//! Machines and the doctor: profiles in, facts out, and the loop from one to the other.

use super::*;

const SHOP: &str = "id = \"shop\"\ntitle = \"A shop's machine\"\ndialect = \"fanuc\"\n";

fn with_profile(text: &str) -> tempfile::TempDir {
    let folder = folder();
    std::fs::write(folder.path().join("shop.toml"), text).unwrap();
    folder
}

#[test]
fn machines_are_listed_shown_and_tested() {
    let folder = folder();
    let done = ncc(folder.path(), &["machines"]).exits(0);
    expect("machines.txt", &done.out);
    let ids: Vec<&str> = done.out.lines().filter_map(|line| line.split_whitespace().next()).collect();
    for id in &ids {
        expect(&format!("machine-{id}.txt"), &ncc(folder.path(), &["machines", "show", id]).exits(0).out);
    }
    let mut arguments = vec!["machines", "test"];
    arguments.extend(ids);
    let tested = ncc(folder.path(), &arguments).exits(0).out;
    assert!(!tested.contains("failed") && tested.matches("passed").count() == 27, "{tested}");
    let codes = "[[m_code]]\ncode = \"M70\"\nfunction = \"air-on\"\n[[m_code]]\ncode = \"M71\"\nfunction = \"air-off\"\n";
    std::fs::write(folder.path().join("shop.toml"), format!("{SHOP}{codes}")).unwrap();
    let tested = ncc(folder.path(), &["machines", "test", "shop.toml"]).exits(0).out;
    assert!(tested.contains("passed  its 2 M codes, written and read back: 26 events"), "{tested}");
    std::fs::write(folder.path().join("shop.toml"), SHOP.replace("A shop's machine", "")).unwrap();
    for verb in ["show", "test"] {
        let told = ncc(folder.path(), &["machines", verb, "shop.toml"]).exits(0).out;
        assert_eq!(told.lines().next(), Some("shop"), "no title is told, and none is promised");
    }
    let schema = ncc(folder.path(), &["machines", "schema"]).exits(0).out;
    assert!(schema.contains("### `[[axis]]`"));
}

#[test]
fn a_profile_names_the_dialect() {
    let folder = with_profile(SHOP);
    let plain = ncc(folder.path(), &["mach9", "to", "fanuc", "good.cn"]).exits(0).out;
    let machines = ["--machine-from", "romi-discovery-4022", "--machine-to", "shop.toml"];
    let by_machine = ncc(folder.path(), &[&["translate", "good.cn"], &machines[..]].concat()).exits(0).out;
    assert_eq!(plain, by_machine, "an empty profile changes nothing");
    for (arguments, says) in [
        (&["--from", "fanuc", "--machine-from", "romi-discovery-4022", "--to", "fanuc"][..], "is a mach9"),
        (&["--from", "mach9", "--machine-to", "shop.toml", "--to", "siemens"], "is a fanuc"),
        (&["--from", "mach9", "--machine-to", "nobody"], "there is no machine `nobody`"),
        (&["--machine-to", "shop.toml"], "--from"),
    ] {
        ncc(folder.path(), &[&["translate", "good.cn"], arguments].concat()).exits(2).says(says);
    }
    ncc(folder.path(), &["mach9", "to", "fanuc", "good.cn", "--machine-to", "none.toml"]).exits(4);
}

#[test]
fn a_faulty_profile_is_wrong_usage_and_points_into_the_file() {
    let folder = with_profile(&format!("{SHOP}[times]\ntoolchange = 5\n"));
    let arguments = ["translate", "good.cn", "--from", "mach9", "--machine-to", "shop.toml"];
    let done = ncc(folder.path(), &arguments).exits(2).says("shop.toml:5:1").says("NC0701");
    assert_eq!(done.out, "");
    let done = ncc(folder.path(), &[&arguments[..], &["--format", "json"]].concat()).exits(2);
    assert!(done.err.starts_with('{') && done.err.contains("line 5, column 1"), "{}", done.err);
    ncc(folder.path(), &["machines", "test", "shop.toml", "fanuc-vmc"]).exits(1).says("NC0701");
}

#[test]
fn files_in_a_folder_are_named_as_the_shop_wants() {
    let emit = "[emit]\nfile_name = \"program-number\"\nextension = \"nc\"\nupper_case = true\nline_ends = \"crlf\"\nblock_numbers = \"new\"\nfirst_number = 5\nnumber_step = 5\n";
    let folder = with_profile(&format!("{SHOP}{emit}"));
    std::fs::create_dir(folder.path().join("out")).unwrap();
    let arguments = [
        "mach9",
        "to",
        "fanuc",
        "good.cn",
        "--machine-to",
        "shop.toml",
        "--program-number",
        "17",
        "-o",
        "out",
    ];
    ncc(folder.path(), &arguments).exits(0);
    let text = std::fs::read_to_string(folder.path().join("out/O0017.NC")).unwrap();
    assert!(text.contains("\r\nN5 G21"), "{text}");
    let plainly = [&arguments[..], &["--eol", "lf", "--number", "off"]].concat();
    ncc(folder.path(), &plainly).exits(0);
    let text = std::fs::read_to_string(folder.path().join("out/O0017.NC")).unwrap();
    assert!(text.contains("\nG21") && !text.contains('\r'), "the command line goes before: {text}");
    ncc(folder.path(), &["mach9", "to", "fanuc", "good.cn", "-o", "out"]).exits(0);
    assert!(folder.path().join("out/good.nc").exists());
    // The source is not written over under its own name.
    ncc(folder.path(), &["mach9", "to", "mach9", "good.cn", "-o", "."]).exits(2);
}

/// The doctor asks, somebody fills in, and the translation assumes nothing any more.
#[test]
fn what_the_doctor_asks_for_is_no_assumption_once_it_is_stated() {
    let folder = folder();
    let asks = ["doctor", "good.cn", "--from", "mach9", "--to", "fanuc"];
    let done = ncc(folder.path(), &asks).exits(0);
    expect("doctor.txt", &done.out);
    let writes = [&asks[..], &["--write-from", "a.toml", "--write-to", "b.toml"]].concat();
    ncc(folder.path(), &writes).exits(0);
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    expect("doctor-from.toml", &read("a.toml"));
    expect("doctor-to.toml", &read("b.toml"));
    ncc(folder.path(), &writes).exits(2).says("there already");

    let translates = ["translate", "good.cn", "--machine-from", "a.toml", "--machine-to", "b.toml"];
    let empty =
        ncc(folder.path(), &translates).exits(0).says("  usual defaults ").says("  check at the machine ");
    assert!(empty.out.contains("ASSUMED"), "{}", empty.out);

    for name in ["a.toml", "b.toml"] {
        let mut text = read(name);
        for (key, value) in [
            ("o_word", "\"offset\""),
            ("work_offset", "1"),
            ("length_offset", "0"),
            ("no_origin_shift", "true"),
            ("length-offset-with-next-z", "true"),
        ] {
            text = text.replace(&format!("\n{key} = \"\""), &format!("\n{key} = {value}"));
        }
        assert!(!text.contains("= \"\"\n[") && text.matches("= \"\"").count() == 1, "only the title: {text}");
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let stated = ncc(folder.path(), &translates).exits(0);
    assert!(
        !stated.out.contains("ASSUMED")
            && !stated.err.contains("usual defaults")
            && !stated.err.contains("check at the machine"),
        "{}{}",
        stated.out,
        stated.err
    );
    let asks = ["doctor", "good.cn", "--machine-from", "a.toml", "--machine-to", "b.toml"];
    assert!(ncc(folder.path(), &asks).exits(0).out.contains("depends on no fact that is not stated"));
}

#[test]
fn the_doctor_asks_for_m_codes_on_both_sides() {
    let folder = folder();
    std::fs::write(folder.path().join("m.cn"), GOOD.replace("G0X0.", "M21\nG0X0.")).unwrap();
    let asks = [
        "doctor",
        "m.cn",
        "--from",
        "mach9",
        "--to",
        "fanuc",
        "--write-from",
        "a.toml",
        "--write-to",
        "b.toml",
    ];
    let done = ncc(folder.path(), &asks).exits(1);
    assert!(
        done.out.contains("what M21 does is not known") && done.out.contains("m_code for M21"),
        "{}",
        done.out
    );
    let translates = ["translate", "m.cn", "--machine-from", "a.toml", "--machine-to", "b.toml"];
    ncc(folder.path(), &translates).exits(1).says("NC0201");
    for (name, code) in [("a.toml", "M21"), ("b.toml", "M70")] {
        let path = folder.path().join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        let text = text.replace("\ncode = \"\"", &format!("\ncode = \"{code}\""));
        std::fs::write(path, text.replace("\nfunction = \"\"", "\nfunction = \"air-on\"")).unwrap();
    }
    let done = ncc(folder.path(), &translates).exits(0);
    assert!(done.out.contains("\nM70\n"), "{}", done.out);
}

const PART: &str = "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT3 M06\nG00 X0. Y0.\nG43 H23 Z5.\nM98 P1001\nM30\nO1001\nG21 G90 G00 X1.\nM99\n%\n";

/// Rows of one tool, one work offset and one program of two machines.
fn two_machines() -> tempfile::TempDir {
    let rows = |tool: &str, offset: u32, program: u32| {
        format!(
            "{SHOP}[[tool]]\n{tool}\nname = \"drill-8\"\n[[work_offset]]\nnumber = {offset}\nname = \"vice\"\n[[program]]\nnumber = {program}\nname = \"POCKET\"\n"
        )
    };
    let folder = folder();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("old.toml", &rows("number = 3\nlength_entry = 23", 1, 1001));
    write("new.toml", &rows("number = 7", 2, 2001));
    write("part.nc", PART);
    folder
}

#[test]
fn what_goes_by_name_is_told_everywhere() {
    let folder = two_machines();
    let machines = ["translate", "part.nc", "--machine-from", "old.toml", "--machine-to", "new.toml"];
    let done = ncc(folder.path(), &[&machines[..], &["--report", "r.json"]].concat()).exits(0);
    for line in [
        "  tools by name: 3 → 7\n",
        "  length entries by name: 23 → 7\n",
        "  work offsets by name: 1 → 2\n",
        "  programs by name: 1001 → 2001\n",
    ] {
        assert!(done.err.contains(line), "{line}{}", done.err);
    }
    for line in ["(TOOLS BY NAME: 3 TO 7)", "T7 M06", "G43 H7 Z5.", "G55", "M98 P2001", "O2001"] {
        assert!(done.out.contains(line), "{line}:\n{}", done.out);
    }
    let report = std::fs::read_to_string(folder.path().join("r.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let rows: Vec<String> = report["renumbered"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| format!("{} {} {}", row["what"], row["from"], row["to"]).replace('"', ""))
        .collect();
    assert_eq!(rows, ["tool 3 7", "length_entry 23 7", "work_offset 1 2", "program 1001 2001"]);
    // Nothing is said of machines without names.
    let done = ncc(folder.path(), &["fanuc", "to", "haas", "part.nc", "--report", "r.json"]).exits(0);
    assert!(!done.err.contains("by name") && !done.out.contains("BY NAME"), "{}{}", done.err, done.out);
    let report = std::fs::read_to_string(folder.path().join("r.json")).unwrap();
    assert!(report.contains("\"renumbered\": []"), "{report}");
}

#[test]
fn names_are_shown_tested_and_asked_for() {
    let folder = two_machines();
    let shown = ncc(folder.path(), &["machines", "show", "old.toml"]).exits(0).out;
    for line in
        ["  name          drill-8\n", "  length_entry  23\n", "  name    vice\n", "  name    POCKET\n"]
    {
        assert!(shown.contains(line), "{line}{shown}");
    }
    let tested = ncc(folder.path(), &["machines", "test", "old.toml", "new.toml"]).exits(0).out;
    let line = "passed  the names of its 1 tool and 1 work offset, from other numbers: ";
    assert!(tested.matches(line).count() == 2 && !tested.contains("failed"), "{tested}");
    // A tool that the control cannot call is found out.
    let far = std::fs::read_to_string(folder.path().join("new.toml")).unwrap();
    std::fs::write(folder.path().join("far.toml"), far.replace("number = 7", "number = 123456789")).unwrap();
    let tested = ncc(folder.path(), &["machines", "test", "far.toml"]).exits(1).out;
    assert!(tested.contains("failed  the names of its 1 tool"), "{tested}");

    // Nothing is asked for while all that is used has a name.
    let asks = ["doctor", "part.nc", "--machine-from", "old.toml", "--machine-to", "new.toml"];
    let asked = ncc(folder.path(), &asks).exits(0).out;
    assert!(!asked.contains("tool"), "{asked}");
    let text = PART.replace("M98", "T5 M06\nT6 M06\nG43 H66 Z5.\nG55\nM98");
    std::fs::write(folder.path().join("part.nc"), text).unwrap();
    let more = std::fs::read_to_string(folder.path().join("old.toml")).unwrap();
    let more = format!("{more}[[tool]]\nnumber = 6\nname = \"tap \\\"M6\\\"\"\n");
    std::fs::write(folder.path().join("old.toml"), more).unwrap();
    let writes = [&asks[..], &["--write-from", "a.toml", "--write-to", "b.toml"]].concat();
    let asked = ncc(folder.path(), &writes).exits(1).out;
    expect("doctor-names.txt", &asked);
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    expect("doctor-names-from.toml", &read("a.toml"));
    expect("doctor-names-to.toml", &read("b.toml"));
    // What is written is a profile, empty as it is.
    ncc(folder.path(), &["machines", "test", "a.toml", "b.toml"]).exits(0);
}
