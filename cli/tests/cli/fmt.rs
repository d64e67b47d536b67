//! `ncc fmt` as a process: what is written where, what is refused, and what is never touched.

use super::*;

fn fmt(folder: &Path, arguments: &[&str]) -> Done {
    ncc(folder, &[&["fmt"], arguments].concat())
}

fn write(folder: &Path, name: &str, text: &[u8]) {
    std::fs::write(folder.join(name), text).unwrap();
}

fn read(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).unwrap()
}

const UNTIDY: &[u8] = b"%\nO0100 (PART)\ng21 g17 g90 g94 g54\nG0 X+1. Y 02.50\nM30\n%\n";
const TIDY: &[u8] = b"%\nO0100 (PART)\nG21 G17 G90 G94 G54\nG00 X1. Y2.50\nM30\n%\n";

#[test]
fn the_help_reads_as_written_down() {
    let folder = folder();
    expect("help-fmt.txt", &fmt(folder.path(), &["--help"]).exits(0).out);
}

#[test]
fn a_program_is_laid_out_in_place_or_on_stdout() {
    let folder = folder();
    let folder = folder.path();
    write(folder, "part.nc", UNTIDY);
    let done = fmt(folder, &["--check", "fanuc:part.nc", "mach9:good.cn"]).exits(1);
    assert_eq!(done.out, "part.nc\n");
    done.says("part.nc: 2 lines change; the same words, and ");
    let done = fmt(folder, &["--diff", "fanuc:part.nc"]).exits(0);
    expect("fmt-diff.txt", &done.out);
    assert_eq!(read(folder, "part.nc"), UNTIDY);
    let done = fmt(folder, &["--stdout", "-q", "fanuc:part.nc"]).exits(0);
    assert!(done.out.as_bytes() == TIDY && done.err.is_empty(), "{done:?}");
    let done = ncc_with(folder, &["fmt", "fanuc:-"], UNTIDY).exits(0);
    assert_eq!(done.out.as_bytes(), TIDY);
    assert_eq!(read(folder, "part.nc"), UNTIDY);
    fmt(folder, &["fanuc:part.nc"]).exits(0);
    assert_eq!(read(folder, "part.nc"), TIDY);
    fmt(folder, &["--check", "fanuc:part.nc"]).exits(0).says("nothing to change");
}

#[test]
fn bytes_of_comments_and_line_ends_stay() {
    let folder = folder();
    let folder = folder.path();
    write(folder, "latin1.nc", b"g21 g90 g17 g94 g54 (gro\xdf,  \x80)\r\nG0 X1.\nM30");
    fmt(folder, &["fanuc:latin1.nc"]).exits(0);
    assert_eq!(read(folder, "latin1.nc"), b"G21 G90 G17 G94 G54 (gro\xdf,  \x80)\r\nG00 X1.\r\nM30\r\n");
    fmt(folder, &["fanuc:latin1.nc", "--eol", "lf"]).exits(0);
    assert!(!read(folder, "latin1.nc").contains(&b'\r'));
}

#[test]
fn what_is_no_program_of_the_dialect_is_never_touched() {
    let folder = folder();
    let folder = folder.path();
    let siemens: &[u8] = b"n10 G17 G90 G710 G94\nG0 X=IC(5) SUPA\nTRANS X5\nM30\n";
    let cases: [(&str, &[u8], i32, &str); 4] = [
        ("binary.nc", b"%\nO1\ng0 X1.\n\0\x01\x02\nG1 Y5.\n", 1, "binary.nc:4 is not the text of a program"),
        ("other.nc", siemens, 1, "reads like siemens"),
        ("empty.nc", b"", 0, "nothing to change"),
        ("cut.nc", b"%\nO1\nG21 G17 G90 G94 G54\nG00 X1. (unclosed", 0, "kept as it is"),
    ];
    for (name, text, code, says) in cases {
        write(folder, name, text);
        fmt(folder, &["--from", "fanuc", name]).exits(code).says(says);
        assert!(read(folder, name) == text, "{name} was written");
    }
    fmt(folder, &["empty.nc"]).exits(1).says("is empty");
    fmt(folder, &["nosuch.nc"]).exits(4);
    fmt(folder, &["."]).exits(4);
    fmt(folder, &[]).exits(2);
    fmt(folder, &["-", "fanuc:-"]).exits(2);
    fmt(folder, &["--stdout", "good.cn", "bad.cn"]).exits(2);
    fmt(folder, &["--from", "fanuk", "good.cn"]).exits(2).says("did you mean fanuc?");
    // One bad file does not stop the others.
    write(folder, "part.nc", UNTIDY);
    fmt(folder, &["--from", "fanuc", "binary.nc", "part.nc"]).exits(1);
    assert_eq!(read(folder, "part.nc"), TIDY);
}

#[cfg(unix)]
#[test]
fn links_stay_links_and_what_is_protected_stays() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let folder = folder.path();
    write(folder, "part.nc", UNTIDY);
    std::os::unix::fs::symlink("part.nc", folder.join("link.nc")).unwrap();
    fmt(folder, &["fanuc:link.nc"]).exits(0);
    assert!(folder.join("link.nc").is_symlink());
    assert_eq!(read(folder, "part.nc"), TIDY);
    write(folder, "part.nc", UNTIDY);
    std::fs::set_permissions(folder.join("part.nc"), std::fs::Permissions::from_mode(0o444)).unwrap();
    fmt(folder, &["fanuc:part.nc"]).exits(4).says("permission denied");
    assert_eq!(read(folder, "part.nc"), UNTIDY);
}

#[test]
fn a_program_that_cannot_be_executed_is_told_as_such() {
    let folder = folder();
    let folder = folder.path();
    let text = b"%\nO1\nG21 G17 G90 G94 G54\n#1=BIN[1]\nwhile[#1LT5]do1\nG0X#1\n#1=#1+1\nEND1\nM30\n%\n";
    write(folder, "macro.nc", text);
    fmt(folder, &["--executed", "fanuc:macro.nc"]).exits(1).says("left as it is");
    assert_eq!(read(folder, "macro.nc"), text);
    fmt(folder, &["fanuc:macro.nc"]).exits(0).says("no more was shown");
    let expected =
        b"%\nO1\nG21 G17 G90 G94 G54\n#1=BIN[1]\nWHILE[#1LT5]DO1\nG00 X#1\n#1=#1+1\nEND1\nM30\n%\n";
    assert_eq!(read(folder, "macro.nc"), expected);
}

#[test]
fn the_book_shows_what_changes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = book::page("use/layout.md");
    let printed = fmt(&root, &["--diff", "-q", "tests/fmt/example.nc", "--number", "10:10"]).exits(0).out;
    assert!(page.contains(&format!("```\n{printed}```\n")), "the book does not show\n{printed}");
}
