//! The project file, where a page of `sessions` cannot show it: files that cannot be read, git, documents.

use std::fs;

use super::*;

const PART: &str =
    "%\nO1000\nG17 G90 G94 G54 G40 G49 G80\nT1 M06\nS500 M03\nG00 X0. Y0.\nM51\nG43 H1 Z5.\nM05\nM30\n%\n";

const PROJECT: &str = "[[programs]]\nfiles = \"**/*.nc\"\nto = { dialect = \"siemens\" }\n[programs.machine]\n\
                       dialect = \"haas\"\n[programs.machine.power_on]\nunits = \"mm\"\n\
                       [[programs.machine.m_code]]\ncode = \"M51\"\neffect = \"none\"\n";

/// A folder with a project file, and a program in a folder below.
fn project() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ncc.toml"), PROJECT).unwrap();
    fs::create_dir(folder.path().join("old")).unwrap();
    fs::write(folder.path().join("old/part.nc"), PART).unwrap();
    folder
}

#[test]
fn every_code_of_a_project_file_is_in_a_session() {
    let page = include_str!("../sessions/project-file-faults.md");
    for code in ncc_machines::Wrong::PROJECT_CODES {
        assert!(page.contains(&format!("[NC{code:04}]")), "NC{code:04}");
    }
}

#[test]
fn the_book_shows_a_project_file() {
    let page = book::page("use/machines.md");
    let (_, block) = page.split_once("```toml\n[[programs]]\n").unwrap();
    let (file, rest) = block.split_once("```\n").unwrap();
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ncc.toml"), format!("[[programs]]\n{file}")).unwrap();
    fs::write(folder.path().join("part.nc"), PART).unwrap();
    let told = ncc(folder.path(), &["to", "siemens", "part.nc"]).exits(0).err;
    let (_, shown) = rest.split_once("```\n").unwrap();
    let (shown, _) = shown.split_once("```\n").unwrap();
    assert!(told.starts_with(shown), "the book does not show\n{told}");
}

#[test]
fn a_row_about_sources_is_not_about_their_outputs() {
    let folder = project();
    fs::write(
        folder.path().join("ncc.toml"),
        PROJECT.replace("to =", "output = \"out\"\nto =").replace("siemens", "fanuc"),
    )
    .unwrap();
    let run = |arguments: &[&str]| ncc(folder.path(), arguments).exits(0);
    run(&["to", "fanuc", "old/part.nc"]);
    let told = run(&["verify", "old/part.nc", "out/part.nc"]).err;
    assert!(told.contains("out/part.nc: ncc.toml") && told.contains(": to = fanuc"), "{told}");
    // The outputs of an earlier call are no programs of a later one.
    let told = run(&["to", "fanuc", "."]).out;
    assert!(told.contains("1 program: 1 translated") && told.contains("the folder of the outputs"), "{told}");
    fs::remove_file(folder.path().join("old/part.nc")).unwrap();
    fs::write(folder.path().join("old/b.nc"), PART).unwrap();
    run(&["init", "old/b.nc", "--from", "haas", "--to", "siemens"]).says("it goes before ncc.toml");
}

#[test]
fn a_file_that_cannot_be_read_is_told() {
    let folder = project();
    let translate = || ncc(folder.path(), &["to", "siemens", "old/part.nc"]);
    translate().exits(0);
    fs::write(folder.path().join("ncc.toml"), b"[[programs]]\nfiles = \"\xFF\"\n").unwrap();
    translate().exits(4).says("cannot read ncc.toml: it is not UTF-8").says("`--no-config` ignores it");
    #[cfg(unix)]
    {
        fs::remove_file(folder.path().join("ncc.toml")).unwrap();
        std::os::unix::fs::symlink("nowhere", folder.path().join("ncc.toml")).unwrap();
        translate().exits(4).says("cannot read ncc.toml: there is no such file or folder");
        ncc(folder.path(), &["init", "old/../part.nc", "--to", "siemens"]).exits(2).says("is there already");
    }
}

#[test]
fn the_search_begins_in_the_folder_of_the_program() {
    let folder = project();
    let below = folder.path().join("old");
    ncc(&below, &["to", "siemens", "part.nc"]).exits(0).says("  ncc.toml ");
    let shown = ncc(&below, &["config", "part.nc"]).exits(0).out;
    assert!(shown.starts_with("../ncc.toml  sha256 "), "{shown}");
    // A program on stdin has no folder.
    ncc_with(&below, &["to", "siemens", "-"], PART.as_bytes()).exits(2).says("translate from what?");
    let elsewhere = tempfile::tempdir().unwrap();
    let path = below.join("part.nc");
    ncc(elsewhere.path(), &["to", "siemens", path.to_str().unwrap()]).exits(0).says("  ncc.toml ");
}

#[test]
fn documents_name_the_file_first() {
    let folder = project();
    let run = |arguments: &[&str]| ncc(folder.path(), arguments).exits(0);
    run(&["to", "siemens", "old/part.nc", "-o", "part.mpf", "--report", "report.json", "-q"]);
    let report = fs::read_to_string(folder.path().join("report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["project"]["file"], "ncc.toml");
    assert_eq!(report["project"]["answers"][1]["key"], "machine.power_on.units");
    assert_eq!(report["project"]["answers"][1]["line"], 7);
    let json = run(&["to", "siemens", "old/part.nc", "-o", "part.mpf", "--format", "json"]).err;
    assert!(
        json.lines().last().unwrap().starts_with("{\"project\":{\"file\":\"ncc.toml\",\"sha256\":"),
        "{json}"
    );
}

#[test]
fn a_certificate_rests_on_the_file() {
    let folder = project();
    let run = |arguments: &[&str]| ncc(folder.path(), arguments);
    run(&["to", "siemens", "old/part.nc", "-o", "part.mpf", "-q"]).exits(0);
    run(&["verify", "old/part.nc", "part.mpf", "--cert", "c.json", "-q"]).exits(0);
    let certificate = fs::read_to_string(folder.path().join("c.json")).unwrap();
    let certificate: serde_json::Value = serde_json::from_str(&certificate).unwrap();
    assert_eq!(certificate["source"]["project"]["answers"][0]["value"], "haas");
    assert_eq!(certificate["output"]["project"]["answers"][0]["key"], "to");
    assert!(run(&["verify", "--cert", "c.json"]).exits(0).out.contains("c.json: holds"));
    fs::write(folder.path().join("ncc.toml"), format!("# mine\n{PROJECT}")).unwrap();
    let other = run(&["verify", "--cert", "c.json"]).exits(1).out;
    assert!(other.contains("source/project/sha256"), "{other}");
    // One without a project file is not changed by one that came later.
    let plain = "%\nO1\nG21 G17 G90 G94 G54 G40 G49 G80\nM30\n%\n";
    fs::write(folder.path().join("plain.nc"), plain).unwrap();
    let pair = ["verify", "haas:plain.nc", "haas:plain.nc", "--cert", "d.json", "-q", "--no-config"];
    run(&pair).exits(0);
    assert!(run(&["verify", "--cert", "d.json"]).exits(0).out.contains("d.json: holds"));
}

#[test]
fn drivers_of_git_search_from_the_working_folder() {
    let folder = project();
    let copy = tempfile::tempdir().unwrap();
    let old = copy.path().join("part.nc");
    fs::write(&old, PART.replace("Z5.", "Z6.")).unwrap();
    let old = old.to_str().unwrap();
    let run = |arguments: &[&str]| ncc(folder.path(), arguments).exits(0);
    let git = ["git-diff", "old/part.nc", old, "1", "100644", "old/part.nc", "2", "100644"];
    let shown = run(&git).out;
    assert!(shown.contains("Z offset") || shown.contains("Z6"), "{shown}");
    assert!(!shown.contains("not compared") && !shown.contains("cannot be executed"), "{shown}");
    let without = run(&[&git[..], &["--no-config"]].concat()).out;
    assert!(without.contains("not compared"), "{without}");
    let listed = run(&["git-textconv", old]).out;
    assert!(listed.contains("spindle clockwise 500"), "{listed}");
    let without = run(&["git-textconv", old, "--no-config"]);
    assert!(without.err.contains("shown as it is"), "{without:?}");
}
