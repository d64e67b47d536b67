//! Called programs in files of their own: found by `-I`, verified with what calls them, named in what is
//! written about them.

use std::fs;

use super::*;

const MAIN: &str = "%\nO0007(MAIN)\nG21 G17 G90 G40 G49 G80 G94 G54\nT1 M06\nS1000 M03\nG00 X0. Y0.\nG43 H1 Z5.\n\
                    M98 P1002\nM98 P8\nG00 Z50.\nM05\nM30\n%\n";

/// A main program, and a folder with what it calls.
fn shop() -> tempfile::TempDir {
    let folder = folder();
    fs::create_dir(folder.path().join("sub")).unwrap();
    for (name, text) in [
        ("main.nc", MAIN),
        ("sub/O1002.nc", "%\nO1002(STEP)\nG91\nG01 Z-6. F100.\nX3.\nG00 Z6.\nM98 P2003\nG90\nM99\n%\n"),
        ("sub/2003.NC", "G91\nX1.\nX-1.\nM99\n"),
        ("sub/o0008", "G00 X1.\nM99\n"),
        (
            "main.mpf",
            "G71 G17 G90 G40 G94 G54\nT1 M6\nD1 S1000 M3\nG0 X0 Y0 Z5 F100\nL12\nLOCH P2\nG0 Z50\nM30\n",
        ),
        ("sub/L12.SPF", "G91 G1 Z-6\nZ6\nG90\nM17\n"),
        ("sub/loch.spf", "%_N_LOCH_SPF\n;$PATH=/_N_WKS_DIR\nPROC LOCH\nG91 G1 X1\nX-1 G90\nRET\n"),
    ] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// Runs ncc with words parted by blanks.
fn say(folder: &Path, line: &str) -> Done {
    ncc(folder, &line.split(' ').collect::<Vec<_>>())
}

#[test]
fn called_files_are_part_of_the_program() {
    let shop = shop();
    let at = shop.path();
    say(at, "fanuc to siemens main.nc").exits(1);
    let done =
        say(at, "fanuc to siemens main.nc -I sub --map x.mpf.map.json --report x.json -o x.mpf").exits(0);
    assert!(done.err.contains("verified"), "{}", done.err);
    // What was renamed there is told with its place in that file.
    say(at, "fanuc to siemens main.nc -I sub -v").exits(0).says("sub/O1002.nc:7:");
    let text = fs::read_to_string(at.join("x.mpf")).unwrap();
    for part in
        ["; called: O1002.nc sha256 ", "; called: 2003.NC", "%_N_L1002_SPF", "%_N_L2003_SPF", "%_N_L8_SPF"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    for name in ["x.mpf.map.json", "x.json"] {
        let text = fs::read_to_string(at.join(name)).unwrap();
        assert!(text.contains("sub/2003.NC"), "{text}");
    }
    let line = text.lines().position(|line| line.starts_with("G1 Z-6")).unwrap() + 1;
    let why = say(at, &format!("why x.mpf:{line}")).exits(0);
    assert!(why.out.contains("from sub/O1002.nc:4: G01 Z-6. F100."), "{}", why.out);
    say(at, "verify main.nc x.mpf -I sub --cert c.json").exits(0);
    let certificate = fs::read_to_string(at.join("c.json")).unwrap();
    assert!(certificate.contains("sub/o0008"), "{certificate}");
    say(at, "verify --cert c.json -I sub").exits(0);
    fs::write(at.join("sub/o0008"), "G00 X2.\nM99\n").unwrap();
    let apart = say(at, "verify --cert c.json -I sub");
    assert_eq!(apart.code, 1, "{}{}", apart.out, apart.err);
    let changed = say(at, &format!("why x.mpf:{line}"));
    assert!(changed.code == 1 && changed.err.contains("sub/o0008"), "{}{}", changed.out, changed.err);
}

#[test]
fn a_sinumerik_finds_its_subprograms_by_name() {
    let shop = shop();
    let done = say(shop.path(), "siemens to fanuc main.mpf -I sub").exits(0);
    assert!(done.out.contains("O0012\n") && done.out.contains("M98 P21001"), "{}", done.out);
    fs::write(shop.path().join("sub/L12.SPF"), "%_N_L13_SPF\nM17\n").unwrap();
    let done = say(shop.path(), "siemens to fanuc main.mpf -I sub").exits(1);
    assert!(done.err.contains("named as program 12, but holds program 13"), "{}", done.err);
}

#[test]
fn programs_are_found_by_the_numbers_in_their_files() {
    let shop = folder();
    let at = shop.path();
    fs::create_dir(at.join("jobs")).unwrap();
    let main = "%\nO1\nG21 G17 G90 G54 G40 G49 G80\nG0 X0 Y0\nM98 P1002\nM98 P1003\nM30\n%\n";
    fs::write(at.join("main.nc"), main).unwrap();
    fs::write(at.join("jobs/plate side b.cnc"), "%\n(of a job)\nO1002 (SIDE B)\nG0 X5.\nM99\n%\n").unwrap();
    fs::write(at.join("jobs/o1003"), "O1003\nG0 X7.\nM99\n").unwrap();
    // One with signs that no text has is passed over, and so is a folder.
    fs::write(at.join("jobs/a.bin"), b"O1002\n\0").unwrap();
    fs::create_dir(at.join("jobs/O1002")).unwrap();
    let done = say(at, "fanuc to haas main.nc -I jobs").exits(0);
    assert!(done.out.contains("X5.") && done.out.contains("X7."), "{}", done.out);
    // A file of its name counts before one that holds its number; of two that hold it none does.
    fs::write(at.join("jobs/copy of plate.cnc"), "O1002\nG0 X6.\nM99\n").unwrap();
    let done = say(at, "fanuc to haas main.nc -I jobs").exits(1);
    let both = "program 1002 is in two files: jobs/copy of plate.cnc and jobs/plate side b.cnc";
    assert!(done.err.contains(both) && done.err.contains("name the right one O1002."), "{}", done.err);
    fs::write(at.join("jobs/O1002.nc"), "O1002\nG0 X8.\nM99\n").unwrap();
    let done = say(at, "fanuc to haas main.nc -I jobs").exits(0);
    assert!(done.out.contains("X8."), "{}", done.out);
    // A Sinumerik knows programs by the names of their files alone; signs that no name has are underscores.
    fs::write(at.join("main.mpf"), "G71 G90 G17 G54\nG0 X0 Y0\nEXTCALL \"side b.spf\"\nM30\n").unwrap();
    fs::write(at.join("jobs/Side b.SPF"), "G0 X9\nM17\n").unwrap();
    let done = say(at, "siemens to fanuc main.mpf -I jobs").exits(0);
    assert!(done.out.contains("(SIDE_B)"), "{}", done.out);
}

#[test]
fn a_message_names_the_file_and_its_line() {
    let shop = shop();
    fs::write(shop.path().join("sub/o0008"), "G00 X1.\nG77\nM99\n").unwrap();
    let done = say(shop.path(), "fanuc to siemens main.nc -I sub").exits(1);
    assert!(done.err.contains("sub/o0008:2:1"), "{}", done.err);
    let done = say(shop.path(), "fanuc to siemens main.nc -I nowhere").exits(2);
    assert!(done.err.contains("no such folder"), "{}", done.err);
}

#[test]
fn o_words_are_found_in_files_of_their_names() {
    let shop = folder();
    let at = shop.path();
    fs::create_dir(at.join("sub")).unwrap();
    let main = "G21 G17 G90 G94 G40 G49 G54\nF200\n#1=2\nG0 X0 Y0 Z5\no1 if [#1 GT 1]\n  o<groove> call [12]\no1 endif\no20 call\nM2\n";
    for (name, text) in [
        ("main.ngc", main),
        // What stands beside the subprogram is not executed.
        (
            "sub/groove.ngc",
            "(A)\nG0 X99\n O <Groove> SUB (length)\nG1 Z-1\nX#1\no20 call\nG0 Z5\no<groove> endsub\nM2\n",
        ),
        ("sub/20.ngc", "o020 sub\nG4 P1\no20 endsub\nM2\n"),
    ] {
        fs::write(at.join(name), text).unwrap();
    }
    say(at, "linuxcnc to fanuc main.ngc").exits(1);
    let done = say(at, "linuxcnc to linuxcnc -I sub main.ngc").exits(0);
    assert!(done.err.contains("verified") && !done.out.contains("X99"), "{}{}", done.out, done.err);
    assert!(
        done.out.contains("(called: groove.ngc sha256 ") && done.out.contains("(called: 20.ngc"),
        "{}",
        done.out
    );
    fs::write(at.join("sub/20.ngc"), "G4 P1\nM99\n").unwrap();
    let done = say(at, "linuxcnc to linuxcnc -I sub main.ngc").exits(1);
    assert!(done.err.contains("NC0202"), "{}", done.err);
}

/// Blocks are repeated as often as a variable says, a whole number that is told to be 1 or more; up to a label with
/// its whole block.
#[test]
fn repeated_by_a_computed_number() {
    let folder = folder();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let source = |times: &str, last: &str| {
        format!(
            "DEF REAL TIMES={times}\nG710 G90 G17 G94\nT1 D1 M6\nG0 X0 Y0 Z5 S500 M3\nDOWN: G90 G1 Z-1 F100\nG0 Z5\n\
             G91 X10\nLAST: {last}\nG90 G0 Z6\nREPEAT DOWN LAST P=TIMES\nG90 G0 Z50\nM30\n"
        )
    };
    for last in ["G4 F1", "G0 X1", "R1=R1+1"] {
        write("rows.mpf", &source("3", last));
        for (to, kept) in [
            ("siemens", format!("LAST: {}\n", last.replace('+', " + "))),
            ("fanuc", "WHILE [".to_owned()),
            ("linuxcnc", "o1 repeat [#<times>]\n".to_owned()),
        ] {
            let done = ncc(folder.path(), &["siemens", "to", to, "rows.mpf", "-o", "out"]).exits(0);
            assert!(done.err.contains("P of REPEAT, computed = a whole number, 1 or more"), "{}", done.err);
            let written = std::fs::read_to_string(folder.path().join("out")).unwrap();
            assert!(written.contains(&kept), "{written}");
        }
    }
    for times in ["0", "-1", "2.5"] {
        write("none.mpf", &source(times, "X1"));
        let done = ncc(folder.path(), &["siemens", "to", "fanuc", "none.mpf", "-o", "no.nc"]).exits(1);
        done.says("NC0209").says("REPEAT DOWN LAST P=TIMES");
    }
    write("text.mpf", &source("3", "X1").replace("P=TIMES", "P=\"A\""));
    ncc(folder.path(), &["siemens", "to", "fanuc", "text.mpf", "-o", "no.nc"]).exits(1).says("error[");
}
