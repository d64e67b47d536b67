//! `translate --map`, `--annotate` and `ncc why` as a process: what is told, and what is refused.

use super::*;

/// Translates good.cn with a map beside it.
fn mapped() -> tempfile::TempDir {
    let folder = folder();
    let arguments = ["mach9", "to", "fanuc", "good.cn", "-o", "out.nc", "--map", "out.nc.map.json", "-q"];
    ncc(folder.path(), &arguments).exits(0);
    folder
}

/// The number of the line that begins so.
fn line(folder: &Path, begins: &str) -> usize {
    let text = std::fs::read_to_string(folder.join("out.nc")).unwrap();
    text.lines().position(|line| line.starts_with(begins)).unwrap() + 1
}

#[test]
fn the_help_reads_as_written_down() {
    expect("help-why.txt", &ncc(folder().path(), &["why", "--help"]).exits(0).out);
}

#[test]
fn what_a_line_comes_from_is_told() {
    let folder = mapped();
    let folder = folder.path();
    let place = format!("out.nc:{}", line(folder, "G43"));
    expect("why.txt", &ncc(folder, &["why", &place]).exits(0).out);
    expect("why.json", &ncc(folder, &["why", &place, "--format", "json"]).exits(0).out);
    let told = |line: usize| ncc(folder, &["why", &format!("out.nc:{line}")]).exits(0).out;
    assert!(told(1).contains("in the head"), "{}", told(1));
    let last = line(folder, "M30") + 1;
    assert!(told(last).contains("no line of the source says it"), "{}", told(last));
    assert!(told(line(folder, "X10.")).contains("from good.cn:9: X10.\n"));
    // The same without a map.
    std::fs::remove_file(folder.join("out.nc.map.json")).unwrap();
    let again = ncc(folder, &["why", &place, "--from-source", "good.cn", "--from", "mach9"]).exits(0).out;
    expect("why.txt", &again);
}

#[test]
fn files_that_are_not_those_of_the_map_are_refused() {
    let folder = mapped();
    let folder = folder.path();
    let write = |name: &str, text: &[u8]| std::fs::write(folder.join(name), text).unwrap();
    ncc(folder, &["why", "out.nc:99"]).exits(2).says("there is no line 99");
    ncc(folder, &["why", "out.nc"]).exits(2).says("such as part.nc:214");
    ncc(folder, &["why", "out.nc:0"]).exits(2);
    ncc(folder, &["why", "nosuch.nc:1"]).exits(4);
    ncc(folder, &["why", "good.cn:1"]).exits(2).says("there is no good.cn.map.json");
    ncc(folder, &["why", "good.cn:1", "--map", "out.nc.map.json"]).exits(1).says("another hash");
    ncc(folder, &["why", "out.nc:1", "--map", "good.cn"]).exits(4).says("is no map");
    write("empty.nc", b"");
    ncc(folder, &["why", "empty.nc:1"]).exits(2).says("is empty");
    write("binary.nc", b"\0\x01\xff\n\n");
    ncc(folder, &["why", "binary.nc:1", "--map", "binary.nc"]).exits(4).says("is no map");
    write("v2.json", b"{\"version\": 2}");
    ncc(folder, &["why", "out.nc:1", "--map", "v2.json"]).exits(4).says("version 2 of maps is not known");
    // Another source gives another program.
    write("other.cn", GOOD.replace("X10.", "X11.").as_bytes());
    let again = ["why", "out.nc:1", "--map", "out.nc.map.json", "--from-source", "other.cn"];
    ncc(folder, &again).exits(1).says("other.cn is not what out.nc.map.json was made of");
    write("good.cn", b"G90\n");
    ncc(folder, &["why", "out.nc:1"]).exits(1).says("good.cn is not what");
    std::fs::remove_file(folder.join("good.cn")).unwrap();
    ncc(folder, &["why", "out.nc:1"]).exits(4).says("--from-source");
    write("out.nc", b"%\n");
    ncc(folder, &["why", "out.nc:1"]).exits(1).says("out.nc is not what");
}

#[test]
fn maps_and_comments_are_refused_where_they_cannot_be() {
    let folder = folder();
    let folder = folder.path();
    let asked = |more: &[&str]| ncc(folder, &[&["mach9", "to", "fanuc", "good.cn", "-q"], more].concat());
    asked(&["--map", "m.json", "--no-verify"]).exits(2);
    asked(&["--map", "good.cn"]).exits(2).says("never written over");
    asked(&["-o", "a.nc", "--map", "a.nc"]).exits(2).says("both output and map");
    asked(&["--report", "a.json", "--map", "a.json"]).exits(2).says("both report and map");
    ncc(folder, &["mach9", "to", "canon", "good.cn", "--annotate"]).exits(2).says("has no comments");
    // What is not released has no map.
    ncc(folder, &["mach9", "to", "fanuc", "bad.cn", "-q", "--map", "bad.json"]).exits(1);
    assert!(!folder.join("bad.json").exists());
    let done = asked(&["--annotate"]).exits(0);
    assert!(done.out.contains("\nX10. (9: X10.)\n"), "{}", done.out);
}

#[test]
fn the_book_shows_what_stands_beside() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = book::page("use/why.md");
    let done = ncc(&root, &["mach9", "to", "fanuc", "corpus/mach9/arcs-xy.cn", "--annotate", "-q"]).exits(0);
    let shown: Vec<&str> = done.out.lines().skip_while(|l| !l.starts_with("G00 X0.")).take(3).collect();
    assert!(page.contains(&format!("```\n{}\n```\n", shown.join("\n"))), "{shown:#?}");
}
