//! `ncc time` as a process: what it refuses, what goes where, and how much memory it takes.

use std::io::BufWriter;

use super::*;

const MACHINE: [&str; 2] = ["--machine", "romi-discovery-4022"];

fn time(folder: &Path, arguments: &[&str]) -> Done {
    ncc(folder, &[&["time"], arguments].concat())
}

fn write(folder: &Path, name: &str, text: &[u8]) {
    std::fs::write(folder.join(name), text).unwrap();
}

#[test]
fn a_summary_goes_to_stdout_and_nothing_to_stderr() {
    let folder = folder();
    let done = time(folder.path(), &[&MACHINE[..], &["good.cn"]].concat()).exits(0);
    assert!(done.out.starts_with("good.cn (mach9) on Romi Discovery 4022"), "{}", done.out);
    assert!(done.out.contains("model ideal") && done.out.contains("assumed"), "{}", done.out);
    assert_eq!(done.err, "");
}

#[test]
fn other_forms_tell_their_assumptions_on_stderr() {
    let folder = folder();
    let done = time(folder.path(), &[&MACHINE[..], &["good.cn", "--as", "csv"]].concat()).exits(0);
    assert!(done.out.starts_with("n,block,function_name,x1,y1,z1,feed,speed,tool,time,timestamp\r\n"));
    done.says("over at 0:00:").says("assumed      the tool starts at program zero in X Y Z");
    let done = time(folder.path(), &[&MACHINE[..], &["good.cn", "--as", "csv", "-q"]].concat()).exits(0);
    assert_eq!(done.err, "");
}

#[test]
fn without_a_machine_it_says_so() {
    let folder = folder();
    let done = time(folder.path(), &["--from", "mach9", "good.cn"]).exits(0);
    assert!(done.out.contains("on no machine") && done.out.contains("no machine is named"), "{}", done.out);
    assert!(done.out.contains("time of a tool change = 0 s"), "{}", done.out);
}

#[test]
fn the_dialect_is_named_or_recognised_or_the_machines() {
    let folder = folder();
    let folder = folder.path();
    write(
        folder,
        "fanuc.nc",
        b"%\nO0001 (PART)\nG21 G17 G90 G94\nT1 M6\nS500 M3\nG0 X1.\nG43 H1 Z50.\nM30\n%\n",
    );
    time(folder, &["fanuc.nc"]).exits(0).says("read as fanuc");
    time(folder, &["fanuc.nc", "-q"]).exits(0);
    // The machine's control reads another one.
    time(folder, &[&MACHINE[..], &["fanuc.nc"]].concat()).exits(1).says("fanuc.nc reads like fanuc");
    let done = time(folder, &[&MACHINE[..], &["fanuc.nc", "--from", "auto"]].concat()).exits(0);
    assert!(done.out.contains("the machine, whose control reads mach9"), "{}", done.out);
    time(folder, &["--from", "fanuk", "fanuc.nc"]).exits(2).says("did you mean fanuc?");
}

#[test]
fn what_cannot_be_executed_is_refused_at_its_place() {
    let folder = folder();
    let folder = folder.path();
    let cases: [(&str, &[u8], &str, &str); 6] = [
        ("empty.nc", b"", "fanuc", "NC0108"),
        ("binary.nc", b"G0 X1\n\0\x01\x02", "fanuc", "NC0105"),
        ("variables.nc", b"%\nO1\nG21 G90 G17 G94\n#1=#5101\nG0 X#1\nM30\n%\n", "fanuc", "variables.nc:4"),
        ("nofeed.cn", b"G90\nG71\nG17\nG0X0Y0Z0\nG1X10.\nM2\n", "mach9", "nofeed.cn:5"),
        ("bad.cn", BAD.as_bytes(), "mach9", "NC0107"),
        ("unit.mpf", b"G17 G90 G710 G94\nL77\nM30\n", "siemens", "NC0217"),
    ];
    for (name, text, dialect, says) in cases {
        write(folder, name, text);
        for form in ["summary", "csv", "payload", "ndjson", "json", "canon"] {
            let done = time(folder, &["--from", dialect, "--as", form, name]);
            assert_eq!(done.code, 1, "{name} {form}: {}", done.err);
            assert!(done.err.contains(says), "{name} {form}: {}", done.err);
            assert_eq!(done.out, "", "{name} {form}");
        }
        time(folder, &["--from", dialect, "-o", "out", name]).exits(1).says("nothing was written");
        assert!(!folder.join("out").exists(), "{name}");
    }
}

/// Of several programs those that can be executed are told, those that are missing named.
#[test]
fn one_of_several_that_is_wrong_hides_no_other() {
    let folder = folder();
    let folder = folder.path();
    write(folder, "prose.txt", b"hello world\n");
    let done = time(folder, &["--from", "mach9", "good.cn", "bad.cn"])
        .exits(1)
        .says("NC0107")
        .says("bad.cn: not timed\n");
    let total: Vec<&str> = done.out.lines().rev().take(3).collect();
    assert!(total[0].starts_with("  1 of 2 programs  0:00:"), "{}", done.out);
    assert!(total[1].starts_with("  bad.cn ") && total[1].ends_with(" not timed"), "{}", done.out);
    assert!(total[2].starts_with("  good.cn ") && total[2].contains(" 0:00:"), "{}", done.out);
    // The highest exit code counts, wherever the file stands.
    let files = ["gone.cn", "bad.cn", "prose.txt", "good.cn", "--as", "json", "-o", "out.json"];
    time(folder, &files).exits(4).says("gone.cn").says("NC0107").says("the dialect of prose.txt");
    let out = std::fs::read_to_string(folder.join("out.json")).unwrap();
    let out: String = out.split_whitespace().collect();
    assert!(out.contains(r#""not_timed":["gone.cn","bad.cn","prose.txt"]"#), "{out}");
    // If there is no other, there is nothing to print.
    let done = time(folder, &["--from", "mach9", "bad.cn", "gone.cn"]).exits(4);
    assert_eq!(done.out, "");
    time(folder, &["-", "-"]).exits(2).says("stdin can be read only once");
}

/// The rate along the line is none of rotary axes.
#[test]
fn a_rotary_axis_has_its_own_rate() {
    let folder = folder();
    let folder = folder.path();
    write(folder, "turn.nc", b"G21 G90 G17 G94\nG54\nG00 A90.\nX10. A180.\nM30\n");
    write(
        folder,
        "own.toml",
        b"id = \"own\"\ntitle = \"own\"\ndialect = \"fanuc\"\n[rates]\nrapid = 600\n\
          [[axis]]\nletter = \"A\"\nrapid = 5400\n",
    );
    let done = time(folder, &["turn.nc", "--machine", "own.toml", "--as", "csv", "-q"]).exits(0);
    let row = |n: usize| done.out.lines().nth(n).unwrap_or_default().to_owned();
    assert_eq!(row(1), "1,G00 A90.,STRAIGHT_TRAVERSE,0.0000,0.0000,0.0000,5400,0,0,1.000000,1.000000");
    assert!(row(2).ends_with(",600,0,0,1.000000,2.000000"), "{}", row(2));
}

/// Figures of a kind of machine, or marked in a profile, are no facts.
#[test]
fn what_a_profile_marks_as_assumed_is_told() {
    let folder = folder();
    let folder = folder.path();
    let done = time(folder, &["--from", "mach9", "good.cn", "--machine", "fanuc-vmc"]).exits(0);
    assert!(done.out.contains("typical figures, not those of one machine"), "{}", done.out);
    write(
        folder,
        "own.toml",
        b"id = \"own\"\ntitle = \"own\"\ndialect = \"mach9\"\n\
          [times]\ntool_change = { value = 4, assumed = true }\nspindle_start = 2\n\
          [[axis]]\nletter = \"X\"\nrapid = { value = 9000, assumed = true }\n\
          [[axis]]\nletter = \"Z\"\nrapid = { value = 9000, assumed = true }\n",
    );
    let done = time(folder, &["good.cn", "--machine", "own.toml"]).exits(0);
    let line = "marked as assumed in the machine profile: tool_change, rapid of X Z\n";
    assert!(done.out.contains(line), "{}", done.out);
}

#[test]
fn wrong_usage() {
    let folder = folder();
    let folder = folder.path();
    time(folder, &[]).exits(2);
    time(folder, &["good.cn", "bad.cn", "--as", "csv"]).exits(2).says("2 files: --as csv is about one");
    time(folder, &["good.cn", "--stage", "before"]).exits(2).says("--stage before with --as summary");
    time(folder, &["good.cn", "--machine", "nobody"]).exits(2).says("romi-discovery-4022");
    time(folder, &["good.cn", "--model", "real"]).exits(2).says("ideal, trapezoidal, jerk-limited");
    time(folder, &["good.cn", "--start-time", "-1"]).exits(2).says("0 or more");
    time(folder, &["good.cn", "--start", "X"]).exits(2).says("no axis with a decimal");
    time(folder, &["good.cn", "--skip", "11"]).exits(2);
    time(folder, &["good.cn", "--from-option", "x=1", "--from", "mach9"]).exits(2).says("has no option `x`");
    time(folder, &["nothing.cn"]).exits(4).says("there is no such file");
    time(folder, &["good.cn", "--from", "mach9", "-o", "good.cn"]).exits(2).says("never written over");
    time(folder, &["good.cn", "--from", "mach9", "-o", "no/such"]).exits(4);
    assert_eq!(std::fs::read_to_string(folder.join("good.cn")).unwrap(), GOOD);
}

#[test]
fn the_schema_needs_no_program() {
    let folder = folder();
    let done = time(folder.path(), &["--schema"]).exits(0);
    assert!(done.out.starts_with("{\n  \"$schema\"") && done.out.contains("prog_name"));
}

#[test]
fn stdin_is_a_program_too() {
    let folder = folder();
    let arguments = ["time", "-", "--from", "mach9", "--as", "payload", "-q"];
    let done = ncc_with(folder.path(), &arguments, GOOD.as_bytes()).exits(0);
    assert!(done.out.contains("\"prog_name\": \"-\""), "{}", done.out);
}

/// What `--as canon` prints is a canonical program, and takes as long.
#[test]
fn canon_with_times_is_read_again() {
    let folder = folder();
    let folder = folder.path();
    time(folder, &[&MACHINE[..], &["good.cn", "--as", "canon", "-o", "good.canon"]].concat()).exits(0);
    let text = std::fs::read_to_string(folder.join("good.canon")).unwrap();
    assert!(text.contains("CHANGE_TOOL(1)\nCOMMENT(\"time 7.000000, end 7.000000\")\n"), "{text}");
    let done = ncc(folder, &["canon", "to", "mach9", "good.canon"]).exits(0);
    assert!(done.out.contains("G1"), "{}", done.out);
    let first = time(folder, &[&MACHINE[..], &["good.cn", "--as", "json"]].concat()).exits(0).out;
    let again = [&MACHINE[..], &["good.canon", "--from", "canon", "--as", "json"]].concat();
    let again = time(folder, &again).exits(0).out;
    let total = |text: &str| text.lines().find(|l| l.contains("\"time\"")).map(str::to_owned);
    assert_eq!(total(&first), total(&again));
}

#[test]
fn help() {
    let folder = folder();
    let done = time(folder.path(), &["--help"]).exits(0);
    expect("help-time.txt", &done.out);
}

/// Peak memory does not grow with a program that streams: one five times as long takes no more.
#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_program() {
    let folder = folder();
    let folder = folder.path();
    for (form, model) in [("summary", "trapezoidal"), ("csv", "ideal"), ("ndjson", "jerk-limited")] {
        let peaks = [30_000u32, 160_000].map(|blocks| {
            let source = folder.join("long.nc");
            let mut file = BufWriter::new(std::fs::File::create(&source).unwrap());
            writeln!(file, "%\nO1\nG21 G17 G90 G94\nT1 M6\nS9000 M3\nG0 X0. Y0.\nG43 H1 Z1.\nG1 Z-1. F900")
                .unwrap();
            for k in 0..blocks {
                let (x, y) = (k % 400, k / 400 % 50);
                writeln!(file, "X{x}. Y{y}.{}", (k * 7) % 10).unwrap();
            }
            writeln!(file, "G0 Z50.\nM5\nM30\n%").unwrap();
            file.flush().unwrap();
            let arguments = [
                "time",
                "--from",
                "fanuc",
                "-q",
                "--as",
                form,
                "--model",
                model,
                "-o",
                "/dev/null",
                "long.nc",
            ];
            peak(folder, &arguments)
        });
        // A page more or less, and what the allocator keeps.
        assert!(peaks[1] < peaks[0] + 1536, "{form}: {peaks:?} KiB");
    }
}

/// High-water mark of a run's memory that is asked for, in KiB. Not of the memory that is there: pages of code that
/// the end of a run touches are in it or not by the moment of the last look. One arena, since the C library asks for
/// 64 MiB for a second one at once.
#[cfg(target_os = "linux")]
fn peak(folder: &Path, arguments: &[&str]) -> u64 {
    let mut child = command(NCC, folder, arguments).env("MALLOC_ARENA_MAX", "1").spawn().unwrap();
    let mut peak = 0;
    loop {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let mark = status.lines().find(|line| line.starts_with("VmPeak:"));
        let kib = mark.and_then(|line| line.split_whitespace().nth(1)?.parse().ok());
        peak = peak.max(kib.unwrap_or(0));
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success());
            return peak;
        }
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
}

#[test]
fn what_cannot_be_written_is_told_before_anything_is_timed() {
    let folder = folder();
    let folder = folder.path();
    let told = time(folder, &[&MACHINE[..], &["good.cn", "-o", "none/x.csv", "--as", "csv"]].concat());
    assert_eq!(told.exits(4).err.lines().count(), 1, "nothing of the program");
    time(folder, &["--schema", "good.cn"]).exits(2);
}

#[test]
fn a_text_in_another_dialect_is_one_hint_and_no_page_of_errors() {
    let folder = folder();
    let told = time(folder.path(), &["good.cn", "--from", "fanuc"]).exits(1).says("--from mach9");
    assert!(!told.err.contains("error["), "{}", told.err);
}

#[test]
fn a_parameter_that_the_machine_states_is_used_for_programs_in_the_text_form() {
    let folder = folder();
    let folder = folder.path();
    let cycle = "drill-peck(peck 5.mm, clearance parameter)";
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpus/ir/pecks.ir"));
    let text = text.unwrap();
    assert!(text.contains(cycle));
    std::fs::write(folder.join("pecks.ir"), text).unwrap();
    let profile = "id = \"own\"\ntitle = \"Own\"\ndialect = \"fanuc\"\n";
    std::fs::write(folder.join("none.toml"), profile).unwrap();
    let stated = format!("{profile}[options]\npeck_clearance = 0.5\nbreak_lift = 0.5\n");
    std::fs::write(folder.join("own.toml"), stated).unwrap();
    let call = |machine: &str| time(folder, &["pecks.ir", "--from", "ir", "--machine", machine]);
    call("none.toml").exits(1).says("NC0226").says("`[options]` of a machine profile");
    call("own.toml").exits(0);
}

/// Table 10 as a file: the same times as of the profile that is shipped, of any dialect.
#[test]
fn the_machine_file_of_the_case_study() {
    let folder = folder();
    let folder = folder.path();
    let table_10 = r#"{ "name": "romi", "tool_change_time": 7, "max_feed": 15000, "start_spindle_time": 2 }"#;
    write(folder, "machine.json", table_10.as_bytes());
    let rows = |machine: &str| {
        time(folder, &["good.cn", "--from", "mach9", "-m", machine, "--as", "csv", "-q"]).exits(0).out
    };
    assert_eq!(rows("machine.json"), rows("romi-discovery-4022"));
    let printed = time(folder, &["good.cn", "-m", "machine.json", "--as", "payload-printed", "-q"]).exits(0);
    assert!(printed.out.contains("\"machine_name\": \"romi\""), "{}", printed.out);
    write(
        folder,
        "fanuc.nc",
        b"%\nO0001 (PART)\nG21 G17 G90 G94\nT1 M6\nS500 M3\nG0 X1.\nG43 H1 Z50.\nM30\n%\n",
    );
    let done = time(folder, &["fanuc.nc", "-m", "machine.json"]).exits(0).says("read as fanuc");
    assert!(!done.out.contains("whose control"), "{}", done.out);
    // It names no control, so nothing is translated by it.
    for arguments in [
        &["translate", "--from", "mach9", "good.cn", "--machine-to", "machine.json"][..],
        &["translate", "--to", "fanuc", "good.cn", "--machine-from", "machine.json"],
        &["check", "good.cn", "-m", "machine.json"],
        &["machines", "show", "machine.json"],
    ] {
        ncc(folder, arguments).exits(2).says("machine.json names no control");
    }
    write(folder, "wrong.json", b"{ \"name\": \"romi\",\n  \"tool_change\": 7 }\n");
    let done = time(folder, &["good.cn", "-m", "wrong.json"]).exits(2);
    done.says("wrong.json:2:")
        .says("unknown field `tool_change`, expected one of `name`, `tool_change_time`");
    write(folder, "wrong.json", b"{ \"name\": \"romi\", \"max_feed\": 0 }\n");
    time(folder, &["good.cn", "-m", "wrong.json"]).exits(2).says("NC0708").says("max_feed");
}

/// A stored payload gives the rows again, or says where it is wrong.
#[test]
fn a_payload_is_read_back() {
    let folder = folder();
    let folder = folder.path();
    let with =
        |arguments: &[&str]| time(folder, &[&MACHINE[..], &["good.cn", "-q"], arguments].concat()).exits(0);
    let rows = with(&["--as", "csv"]).out;
    with(&["--as", "payload", "-o", "good.json"]);
    let stored =
        |arguments: &[&str]| time(folder, &[&["--from", "payload", "good.json"], arguments].concat());
    assert_eq!(stored(&["--as", "csv"]).exits(0).out, rows);
    // It has no work offsets and no cutter compensation: a list made of it would be another program.
    stored(&["--as", "canon"]).exits(2).says("for other forms, name the program");
    stored(&["--as", "csv", "-o", "good.json"]).exits(2).says("never written over");
    stored(&[]).exits(2).says("ncc writes --as csv");
    stored(&["--as", "csv", "-m", "romi-discovery-4022"]).exits(2).says("has its times already");
    with(&["--as", "payload", "--stage", "before", "-o", "before.json"]);
    time(folder, &["--from", "payload", "before.json", "--as", "csv"]).exits(1).says("is not processed");
    let good = std::fs::read_to_string(folder.join("good.json")).unwrap();
    for (from, to, says) in [
        ("\"x0\":", "\"x9\":", "line 6, column 54: unknown field `x9`"),
        ("\"STRAIGHT_TRAVERSE\"", "\"MOVE\"", "unknown variant `MOVE`, expected one of `SELECT_TOOL`"),
        ("\"time\":7.0", "\"time\":-7.0", "expected >= 0"),
        ("\"cut_offset\":0,", "", "missing field `cut_offset`"),
        ("  ]\n}", "", "EOF while parsing a list"),
        ("\"parameters\":{}", "\"parameters\":[{},{}]", "invalid length 2"),
        ("\"dialect\": \"mach9\",", "", "missing field `dialect`"),
    ] {
        let wrong = good.replacen(from, to, 1);
        assert_ne!(wrong, good, "{from}");
        write(folder, "wrong.json", wrong.as_bytes());
        let done = time(folder, &["--from", "payload", "wrong.json", "--as", "csv"]).exits(1);
        done.says("wrong.json is not a payload: line ").says(says);
    }
}
