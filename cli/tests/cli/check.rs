//! `ncc check` as a process: exit codes, what goes where, and what it makes of files that are no programs.

use super::*;

fn check(folder: &Path, arguments: &[&str]) -> Done {
    ncc(folder, &[&["check"], arguments].concat())
}

fn write(folder: &Path, name: &str, text: &[u8]) {
    std::fs::write(folder.join(name), text).unwrap();
}

#[test]
fn the_book_shows_what_is_found() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = book::page("use/check.md");
    let arguments = ["tests/check/example.nc", "--machine", "tests/check/machine.toml"];
    let printed = check(&root, &arguments).exits(1).out;
    assert!(page.contains(&format!("```\n{printed}```\n")), "the book does not show\n{printed}");
}

#[test]
fn the_help_reads_as_written_down() {
    let folder = folder();
    expect("help-check.txt", &check(folder.path(), &["--help"]).exits(0).out);
}

#[test]
fn findings_go_to_stdout_and_decide_the_exit_code() {
    let folder = folder();
    let folder = folder.path();
    let done = check(folder, &["--from", "mach9", "good.cn"]).exits(0);
    assert!(done.out.starts_with("good.cn (mach9): nothing found\n") && done.err.is_empty(), "{done:?}");
    let done = check(folder, &["--from", "mach9", "bad.cn"]).exits(1);
    assert!(done.out.contains("error[NC0107]") && done.err.is_empty(), "{done:?}");
    // One bad file does not stop the others.
    let done = check(folder, &["--from", "mach9", "good.cn", "nosuch.cn", "bad.cn"]).exits(4);
    assert!(done.out.contains("good.cn (mach9)") && done.out.contains("bad.cn (mach9)"), "{}", done.out);
    done.says("cannot read nosuch.cn");
    let done = check(folder, &["mach9:good.cn", "--format", "sarif", "-o", "log.sarif"]).exits(0);
    assert!(done.out.is_empty());
    assert!(std::fs::read_to_string(folder.join("log.sarif")).unwrap().contains("\"version\": \"2.1.0\""));
    check(folder, &["mach9:good.cn", "-o", "good.cn"]).exits(2).says("never written over");
    check(folder, &["nosuch.cn"]).exits(4);
    check(folder, &["--from", "fanuk", "good.cn"]).exits(2).says("did you mean fanuc?");
    check(folder, &["--machine", "nosuch", "good.cn"]).exits(2);
    check(folder, &["--deny", "NC9999", "good.cn"]).exits(2);
    check(folder, &[]).exits(2);
    assert!(check(folder, &["--schema"]).exits(0).out.contains("not_checked"));
}

#[test]
fn what_is_no_program_is_told_as_such() {
    let folder = folder();
    let folder = folder.path();
    let cases: [(&str, &[u8], &str, &str); 5] = [
        ("empty.nc", b"", "fanuc", "NC0108"),
        ("binary.nc", b"%\nO1\nG0 X1.\n\0\x01\x02\nG1 Y5.\n", "fanuc", "NC0105"),
        ("truncated.nc", b"%\nO1\nG21 G17 G90 G94 G54\nG0 X1", "fanuc", "NC0110"),
        ("other.nc", b"G17 G90 G710 G94\nG0 X=IC(5) SUPA\nTRANS X5\nM30\n", "fanuc", "NC01"),
        ("long.mpf", &[b'X'; 70_000], "siemens", "NC0104"),
    ];
    for (name, text, dialect, code) in cases {
        write(folder, name, text);
        let done = check(folder, &["--from", dialect, name]).exits(1);
        assert!(done.out.contains(code), "{name}: {}", done.out);
    }
    let done = ncc_with(folder, &["check", "--from", "fanuc", "-"], b"%\nO1\nG90\nM30\n%\n").exits(0);
    assert!(done.out.starts_with("<stdin> (fanuc): nothing found"), "{}", done.out);
}
