//! `ncc translate` of several programs. Every case is a command line in one folder of programs; what it
//! says on both streams, its exit code, and what it writes stand in `tests/expected/batch`.

use std::fs;

use super::*;

/// Fanuc programs with subprograms: two of which one is the same, one of which it is another.
const FANUC: [(&str, &str, &str); 3] = [
    ("plate.nc", "O1001 (PLATE)", "G91 G01 Z-1. F100.\nX5.\nG90"),
    ("cover.nc", "O1002 (COVER)", "G91 G01 Z-1. F100.\nX5.\nG90"),
    ("other/lid.nc", "O1003 (LID)", "G91 G01 Z-2. F100.\nX5.\nG90"),
];

/// A folder with programs good and bad, in folders of their own, and with what is no program.
fn shop() -> tempfile::TempDir {
    let folder = folder();
    let write = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    let binary: Vec<u8> = (0..=255u8).cycle().take(2000).collect();
    for (name, text) in [
        ("mixed/a.cn", GOOD.as_bytes()),
        ("mixed/b-bad.cn", BAD.as_bytes()),
        ("mixed/c-empty.cn", b""),
        ("mixed/d-binary.cn", &binary),
        ("mixed/e.CN", GOOD.replace('\n', "\r\n").as_bytes()),
        ("mixed/f-cut.cn", &GOOD.as_bytes()[..GOOD.len() - 14]),
        ("nested/part.cn", GOOD.as_bytes()),
        ("nested/.old.cn", GOOD.as_bytes()),
        ("nested/.git/x.cn", GOOD.as_bytes()),
        ("nested/notes.txt", b"text\n"),
        ("nested/one/part.cn", GOOD.as_bytes()),
        ("nested/one/two/part.cn", GOOD.replace("X10.", "X20.").as_bytes()),
        ("nested/out/part.cn", GOOD.as_bytes()),
        ("twin/part.cn", GOOD.as_bytes()),
        ("twin/PART.txt", GOOD.as_bytes()),
        ("twin/single.cn", GOOD.as_bytes()),
        ("apart/main.nc", main("O7", "M98 P300\nM98 P0301\n").as_bytes()),
        ("apart/O0300.nc", b"%\nO0300\nM99\n%\n"),
        ("numbers/kept.cn", GOOD.replace("G1Z", "N50G1Z").as_bytes()),
        ("none/notes.txt", b"text\n"),
        ("tools/plate.nc", tools().as_bytes()),
        ("tools/out/plate-3-T9.gcode", b"of an earlier run\n"),
        ("tools/out/lid-1-T1.gcode", b"of another program\n"),
    ] {
        write(name, text);
    }
    for (name, head, sub) in FANUC {
        let text = main(head, "M98 P300\n").replace("M30\n%", &format!("M30\nO0300\n{sub}\nM99\n%"));
        write(&format!("fanuc/{name}"), text.as_bytes());
    }
    folder
}

/// A Haas program with two tools.
fn tools() -> String {
    let tool = |tool: u32| {
        format!(
            "T{tool} M06\nS1000 M03\nG00 X{tool}. Y0.\nG43 H{tool} Z5.\nG01 Z-1. F100.\nG00 Z50.\nM05\nG53 G00 Z0.\n"
        )
    };
    format!("%\nO7\nG21 G17 G90 G40 G49 G80 G94 G54\n{}{}M30\n%\n", tool(1), tool(2))
}

fn main(head: &str, calls: &str) -> String {
    format!(
        "%\n{head}\nG21 G17 G90 G40 G49 G80 G94\nG54\nT1 M06\nS1000 M03\nG00 X0. Y0.\nG43 H1 Z5.\n{calls}\
         G00 Z50.\nM05\nM30\n%\n"
    )
}

/// Cases: name of the expectation, and the arguments of `ncc translate`.
const CASES: [(&str, &[&str]); 19] = [
    ("mixed", &["mixed", "--from", "mach9", "--to", "fanuc", "-o", "out"]),
    ("mixed-auto", &["mixed", "--from", "auto", "--to", "fanuc", "-o", "out/"]),
    ("mixed-quiet", &["mixed", "--from", "mach9", "--to", "fanuc", "-o", "out", "-q"]),
    ("mixed-json", &["mixed", "--from", "mach9", "--to", "fanuc", "-o", "out", "--format", "json"]),
    (
        "apart-json",
        &["apart", "nested", "none.nc", "--from", "auto", "--to", "siemens", "-o", "out", "--format", "json"],
    ),
    (
        "nested",
        &[
            "nested",
            "good.cn",
            "nested/part.cn",
            "--from",
            "mach9",
            "--to",
            "fanuc",
            "-o",
            "nested/out",
            "-v",
        ],
    ),
    (
        "same-names",
        &[
            "twin/part.cn",
            "twin/PART.txt",
            "twin/single.cn",
            "nested/one/part.cn",
            "--from",
            "mach9",
            "--to",
            "canon",
            "-o",
            "out",
        ],
    ),
    ("onto-sources", &["twin", "--from", "mach9", "--to", "mach9", "-o", "twin"]),
    (
        "split-siemens",
        &["fanuc/plate.nc", "fanuc/cover.nc", "--from", "fanuc", "--to", "siemens", "-o", "out", "-q"],
    ),
    (
        "split-at-odds",
        &[
            "fanuc/plate.nc",
            "fanuc/other",
            "good.cn",
            "--from",
            "fanuc",
            "--to",
            "siemens",
            "-o",
            "out",
            "-q",
        ],
    ),
    ("split-fanuc", &["fanuc/plate.nc", "--from", "fanuc", "--to", "fanuc", "--split", "-o", "out", "-q"]),
    ("no-split", &["fanuc", "--from", "fanuc", "--to", "siemens", "--no-split", "-o", "out", "-q"]),
    ("apart", &["apart", "--from", "fanuc", "--to", "siemens", "-o", "out"]),
    ("numbers-keep", &["numbers", "--from", "mach9", "--to", "fanuc", "--number", "keep", "-o", "out", "-q"]),
    (
        "numbers-new",
        &[
            "numbers",
            "good.cn",
            "--from",
            "mach9",
            "--to",
            "fanuc",
            "--number",
            "10:10",
            "--program-number",
            "700",
            "-o",
            "out",
            "-q",
        ],
    ),
    (
        "per-tool",
        &[
            "tools/plate.nc",
            "--from",
            "haas",
            "--to",
            "grbl",
            "--to-option",
            "tool_change=file-per-tool",
            "-o",
            "tools/out",
        ],
    ),
    (
        "per-tool-json",
        &[
            "tools/plate.nc",
            "--format",
            "json",
            "--from",
            "haas",
            "--to",
            "grbl",
            "--to-option",
            "tool_change=file-per-tool",
            "-o",
            "tools/out",
        ],
    ),
    ("missing-file", &["good.cn", "none.cn", "--from", "mach9", "--to", "fanuc", "-o", "out", "-q"]),
    ("file-in-the-way", &["nested", "--from", "mach9", "--to", "fanuc", "-o", "way", "-q"]),
];

/// Durations are another ones every time.
fn masked(text: &str) -> String {
    let mut lines = String::new();
    for line in text.lines() {
        let seconds = line.rfind("\"seconds\": ").map(|at| at + 11);
        let tail = line.strip_suffix(" s").unwrap_or(line);
        let digits = tail.bytes().rev().take_while(|b| b.is_ascii_digit() || *b == b'.').count();
        let number = &tail[tail.len() - digits..];
        match seconds {
            Some(at) => {
                lines.push_str(&format!("{}0.0{}", &line[..at], if line.ends_with(',') { "," } else { "" }))
            }
            None if number.len() >= 4 && number[..number.len() - 2].ends_with('.') => {
                lines.push_str(&format!("{}0.00{}", &tail[..tail.len() - digits], &line[tail.len()..]));
            }
            None => lines.push_str(line),
        }
        lines.push('\n');
    }
    lines
}

/// Every file with what is in it, in order.
fn tree(folder: &Path, below: &str, out: &mut Vec<(String, Vec<u8>)>) {
    let mut names: Vec<String> = fs::read_dir(folder.join(below))
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    for name in names {
        let inside = if below.is_empty() { name } else { format!("{below}/{name}") };
        match folder.join(&inside).is_dir() {
            true => tree(folder, &inside, out),
            false => out.push((inside.clone(), fs::read(folder.join(&inside)).unwrap())),
        }
    }
}

fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all = Vec::new();
    tree(folder, "", &mut all);
    all
}

/// What a case does, as it is written down.
fn done(arguments: &[&str], jobs: &str) -> String {
    let folder = shop();
    fs::create_dir(folder.path().join("way")).unwrap();
    fs::write(folder.path().join("way/one"), "a file where a folder is to be\n").unwrap();
    let before = files(folder.path());
    let done = ncc(folder.path(), &[&["translate", "-j", jobs], arguments].concat());
    let mut text = format!("$ ncc translate {}\nexit {}\n", arguments.join(" "), done.code);
    text.push_str(&format!("--- stdout\n{}--- stderr\n{}", masked(&done.out), masked(&done.err)));
    let after = files(folder.path());
    for (name, bytes) in &before {
        let now = after.iter().find(|(other, _)| other == name);
        assert!(now.is_some_and(|(_, now)| now == bytes), "{arguments:?}: {name} is another");
    }
    for (name, bytes) in after.iter().filter(|file| !before.contains(file)) {
        text.push_str(&format!("--- {name}\n{}", String::from_utf8_lossy(bytes)));
    }
    text
}

#[test]
fn a_batch_does_what_is_written_down_on_however_many_threads() {
    for (name, arguments) in CASES {
        let one = done(arguments, "1");
        assert_eq!(one, done(arguments, "4"), "{name}");
        expect(&format!("batch/{name}.txt"), &one);
    }
}

/// An output of a batch is the one that the program has by itself.
#[test]
fn each_is_translated_as_by_itself() {
    let folder = shop();
    ncc(folder.path(), &["mach9", "to", "fanuc", "mixed", "-o", "out", "-q"]).exits(1);
    for (source, output) in [("mixed/a.cn", "out/a.nc"), ("mixed/e.CN", "out/e.nc")] {
        let alone = ncc(folder.path(), &["mach9", "to", "fanuc", source]).exits(0).out;
        assert_eq!(fs::read_to_string(folder.path().join(output)).unwrap(), alone, "{source}");
    }
    // The arrow as well.
    ncc(folder.path(), &["mach9", "->", "fanuc", "good.cn", "nested/one", "-o", "arrow"]).exits(0);
    let made = files(&folder.path().join("arrow"));
    let names: Vec<&str> = made.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["good.nc", "part.nc", "two/part.nc"]);
}

/// A folder is filled by several commands: what one wrote, another does not change unasked.
#[test]
fn a_subprogram_of_an_earlier_batch_stays_what_it_was() {
    let folder = shop();
    let run = |program: &str| {
        let options = ["fanuc", "to", "siemens", program, "-o", "out/"];
        ncc(folder.path(), &[&options[..], &["--split"]].concat())
    };
    let made = || files(&folder.path().join("out"));
    run("fanuc/plate.nc").exits(0);
    let first = made();
    run("fanuc/other/lid.nc").exits(2).says("L300.SPF is there already, and is another");
    assert_eq!(made(), first);
    // The same subprogram is nobody's own.
    run("fanuc/cover.nc").exits(0);
    assert_eq!(made().len(), first.len() + 1);
    // A program that is translated again brings its own along, and that is told.
    let plate = fs::read_to_string(folder.path().join("fanuc/plate.nc")).unwrap();
    fs::write(folder.path().join("fanuc/plate.nc"), plate.replace("Z-1.", "Z-3.")).unwrap();
    run("fanuc/plate.nc").exits(0).says("L300.SPF becomes another");
    assert_ne!(made()[0], first[0]);
}

/// A main program is there only if all that it calls is.
#[test]
fn without_its_subprogram_a_program_is_not_written() {
    let folder = shop();
    fs::create_dir_all(folder.path().join("out/L300.SPF")).unwrap();
    let way = ["fanuc", "to", "siemens", "fanuc/plate.nc", "-o", "out", "--split"];
    ncc(folder.path(), &way).exits(4).says("L300.SPF");
    assert_eq!(files(&folder.path().join("out")), []);
}

#[test]
fn what_makes_no_sense_is_exit_2_and_writes_nothing() {
    let folder = shop();
    let before = files(folder.path());
    for (arguments, says) in [
        (&["good.cn", "bad.cn"][..], "name a folder for the outputs: -o FOLDER"),
        (&["mixed"], "name a folder for the outputs: -o FOLDER"),
        (&["mixed", "-o", "-"], "name a folder for the outputs: -o FOLDER"),
        (&["mixed", "-o", "good.cn"], "good.cn is a file"),
        (&["mixed", "-", "-o", "out"], "`-` among several programs"),
        (&["mixed", "-o", "out", "--report", "r.json"], "--report is about one program"),
        (&["mixed", "-o", "out", "--map", "m.json"], "--map is about one program"),
        (&["none", "-o", "out"], "there is no program in the folders"),
        (&["mixed", "-o", "out", "--jobs", "0"], "--jobs"),
        (&["mixed", "-o", "out", "--split", "--no-split"], "cannot be used with"),
    ] {
        let done = ncc(folder.path(), &[&["mach9", "to", "fanuc"], arguments].concat()).exits(2).says(says);
        assert_eq!(done.out, "", "{arguments:?}");
    }
    let split = ["mach9", "to", "canon", "mixed", "-o", "out", "--split"];
    ncc(folder.path(), &split).exits(2).says("subprograms of canon are no files of their own");
    assert_eq!(files(folder.path()), before);
}

#[test]
fn a_folder_that_cannot_be_made_is_exit_4() {
    let folder = shop();
    let done = ncc(folder.path(), &["mach9", "to", "fanuc", "mixed", "-o", "good.cn/out"])
        .exits(4)
        .says("cannot make the folder good.cn/out: there is a file of that name");
    assert_eq!(done.out, "");
    assert!(!done.err.contains("mixed"), "it was found out late: {}", done.err);
}

/// A program that is stopped leaves whole files or none.
#[cfg(unix)]
#[test]
fn an_interrupted_batch_leaves_no_half_files() {
    let folder = shop();
    let moves: String = (0..20_000).map(|i| format!("X{}.Y{}.\n", i % 90, i % 70)).collect();
    let long = GOOD.replace("X10.\n", &moves);
    fs::create_dir(folder.path().join("long")).unwrap();
    for i in 0..6 {
        fs::write(folder.path().join(format!("long/{i}.cn")), &long).unwrap();
    }
    let arguments = ["mach9", "to", "fanuc", "long", "-o", "out", "-j", "2", "-q"];
    ncc(folder.path(), &["mach9", "to", "fanuc", "long/0.cn", "-o", "whole.nc", "-q"]).exits(0);
    let whole = fs::read(folder.path().join("whole.nc")).unwrap();
    let mut child = command(NCC, folder.path(), &arguments).spawn().unwrap();
    while !folder.path().join("out/0.nc").exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended without an output");
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let made = files(&folder.path().join("out"));
    let named: Vec<_> = made.iter().filter(|(name, _)| !name.starts_with(".ncc-")).collect();
    assert!(!named.is_empty());
    for (name, bytes) in named {
        assert_eq!(bytes.len(), whole.len(), "{name}");
    }
}

/// A torn arrow: the shell has made a file named as the target, which stays empty.
#[cfg(unix)]
#[test]
fn a_torn_arrow_leads_to_the_folder() {
    let folder = shop();
    let mut command = command(NCC, folder.path(), &["mach9", "-", "good.cn", "mixed/a.cn", "-o", "out"]);
    command.stdout(fs::File::create(folder.path().join("fanuc-file")).unwrap());
    finish(command).exits(2);
    let mut command =
        super::command(NCC, folder.path(), &["mach9", "-", "good.cn", "mixed/a.cn", "-o", "out"]);
    fs::create_dir(folder.path().join("here")).unwrap();
    fs::remove_dir_all(folder.path().join("fanuc")).unwrap();
    command.stdout(fs::File::create(folder.path().join("fanuc")).unwrap());
    finish(command).exits(0).says("2 programs: 2 translated, verified").says("The empty file `fanuc`");
    assert_eq!(fs::read(folder.path().join("fanuc")).unwrap(), b"");
    assert!(folder.path().join("out/good.nc").exists() && folder.path().join("out/a.nc").exists());
}

#[test]
fn the_book_shows_the_summary() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let out = tempfile::tempdir().unwrap();
    let folder = out.path().join("out");
    let arguments = ["fanuc", "to", "siemens", "corpus/fanuc/calls.nc", "corpus/fanuc/tools.nc", "-o", "out"];
    let arguments: Vec<&str> =
        arguments.iter().map(|a| if *a == "out" { folder.to_str().unwrap() } else { a }).collect();
    let told = ncc(&root, &arguments).exits(1).out.replace(folder.to_str().unwrap(), "out");
    // The columns are as wide as the folder's name.
    let squeezed = |text: &str| -> Vec<String> {
        masked(text).lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
    };
    let shown = squeezed(&book::page("use/several.md"));
    let told = squeezed(&told);
    assert!(shown.windows(told.len()).any(|lines| lines == told), "the book does not show\n{told:#?}");
}
