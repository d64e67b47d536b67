//! `ncc diff`, and git calling it.

use super::*;

/// What stands under an edit of [`GOOD`].
fn edited(folder: &Path) {
    std::fs::write(folder.join("feed.cn"), GOOD.replace("F100", "F80")).unwrap();
    std::fs::write(folder.join("off.cn"), GOOD.replace("X10.", "X10.02")).unwrap();
}

#[test]
fn equal_and_different_programs() {
    let folder = folder();
    edited(folder.path());
    let run = |arguments: &[&str]| ncc(folder.path(), &[&["diff", "--from", "mach9"], arguments].concat());
    let same = run(&["good.cn", "good.cn"]).exits(0);
    assert!(same.out.contains("the same cut") && same.err.is_empty(), "{same:?}");
    assert_eq!(
        run(&["good.cn", "feed.cn", "--summary"]).exits(1).out,
        "same path; feed 100 → 80 on 2 moves of T1\n"
    );
    expect("diff.txt", &run(&["good.cn", "off.cn"]).exits(1).out);
    expect("diff-columns.txt", &run(&["good.cn", "off.cn", "--side-by-side"]).exits(1).out);
    expect("diff-text.txt", &run(&["good.cn", "off.cn", "--text"]).exits(1).out);
    expect("diff.json", &run(&["good.cn", "off.cn", "--format", "json"]).exits(1).out);
    assert_eq!(run(&["good.cn", "off.cn", "--tolerance", "0.05"]).exits(0).err, "");
    assert_eq!(run(&["-q", "good.cn", "off.cn"]).exits(1).out, "");
    run(&["good.cn", "off.cn", "--html", "page.html", "-q"]).exits(1);
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    assert!(page.contains("X10.02") && page.ends_with("</html>\n") && !page.contains("src="), "{page}");
    run(&["good.cn", "off.cn", "--html", "good.cn"]).exits(2).says("never written over");
}

#[test]
fn programs_that_cannot_be_compared() {
    let folder = folder();
    let run = |arguments: &[&str]| ncc(folder.path(), &[&["diff"], arguments].concat());
    run(&["mach9:good.cn", "mach9:bad.cn"]).exits(5).says("bad.cn: not compared").says("GOX-15.");
    run(&["mach9:good.cn", "mach9:none.cn"]).exits(4).says("no such file");
    run(&["nosuch:good.cn", "mach9:good.cn"]).exits(2).says("there is no dialect `nosuch`");
    std::fs::write(folder.path().join("prose.txt"), "hello world\n").unwrap();
    run(&["prose.txt", "prose.txt"]).exits(5).says("is not certain");
    run(&["mach9:-", "mach9:-"]).exits(2).says("only once");
    std::fs::write(folder.path().join("empty.cn"), "").unwrap();
    std::fs::write(folder.path().join("binary.cn"), [0u8, 1, 2, 255, 0, 9]).unwrap();
    run(&["mach9:good.cn", "mach9:binary.cn"]).exits(5).says("binary.cn: not compared");
    run(&["mach9:good.cn", "mach9:empty.cn"]).exits(5).says("nothing to translate");
    let cut = &GOOD[..GOOD.len() - 9];
    std::fs::write(folder.path().join("cut.cn"), cut).unwrap();
    run(&["mach9:good.cn", "mach9:cut.cn", "--summary"]).exits(1);
    let stdin = ncc_with(folder.path(), &["diff", "mach9:-", "mach9:good.cn"], GOOD.as_bytes()).exits(0);
    assert!(stdin.out.starts_with("<stdin> (mach9) and good.cn (mach9)\n"), "{}", stdin.out);
}

/// The book's example.
#[test]
fn the_book_shows_what_is_told() {
    let folder = folder();
    let old = "%\nO1\nN10 G21 G17 G90 G40 G49 G80 G94\nN20 G54\nN30 T3 M06\nN40 S1000 M03\n\
        N50 G00 X10. Y0. Z5.\nN60 G01 X0. F300.\nN70 Y5.\nN80 G00 X0. Y0.\nN90 G43 Z25. H3\n\
        N100 G99 G81 X10. Y10. Z-12. R2. F191.\nN110 X20.\nN120 X30. Y20.\nN130 G80\nN140 G00 Z50.\n\
        N150 M05\nN160 M30\n%\n";
    std::fs::write(folder.path().join("old.nc"), old).unwrap();
    let new = old.replace("F300", "F250").replace("N110 X20.", "N110 X20.02");
    std::fs::write(folder.path().join("new.nc"), new).unwrap();
    let told = ncc(folder.path(), &["diff", "--from", "fanuc", "old.nc", "new.nc"]).exits(1).out;
    let page = book::page("use/differences.md");
    assert!(page.contains(&format!("```\n{told}```\n")), "the book does not show\n{told}");
}

/// Whether there is a git to be called; if not, its tests say so.
fn git(folder: &Path, arguments: &[&str]) -> Option<Done> {
    let mut command = command("git", folder, arguments);
    for (name, value) in [
        ("GIT_CONFIG_GLOBAL", "/dev/null"),
        ("GIT_CONFIG_NOSYSTEM", "1"),
        ("GIT_AUTHOR_NAME", "n"),
        ("GIT_AUTHOR_EMAIL", "n@example.org"),
        ("GIT_COMMITTER_NAME", "n"),
        ("GIT_COMMITTER_EMAIL", "n@example.org"),
    ] {
        command.env(name, value);
    }
    let there = Command::new("git").arg("--version").output().is_ok();
    if !there {
        #[allow(clippy::print_stderr)] // What was left out is to be seen.
        {
            eprintln!("skipped: there is no git");
        }
        return None;
    }
    Some(finish(command))
}

/// A repository with `good.cn`, changed since its commit.
fn repository(driver: &str) -> Option<tempfile::TempDir> {
    let folder = folder();
    git(folder.path(), &["init", "-q"])?;
    std::fs::write(folder.path().join(".gitattributes"), "*.cn diff=ncc\n").unwrap();
    let (key, value) = driver.split_once('=').unwrap();
    git(folder.path(), &["config", key, &value.replace("ncc", NCC)])?.exits(0);
    std::fs::write(folder.path().join("gone.cn"), GOOD).unwrap();
    git(folder.path(), &["add", "."])?.exits(0);
    git(folder.path(), &["commit", "-q", "-m", "first"])?.exits(0);
    std::fs::write(folder.path().join("good.cn"), GOOD.replace("F100", "F80")).unwrap();
    std::fs::write(folder.path().join("new.cn"), GOOD).unwrap();
    std::fs::remove_file(folder.path().join("gone.cn")).unwrap();
    git(folder.path(), &["add", "-A"])?.exits(0);
    Some(folder)
}

#[test]
fn git_shows_what_programs_do() {
    let Some(folder) = repository("diff.ncc.command=ncc git-diff --from mach9") else { return };
    let Some(shown) = git(folder.path(), &["--no-pager", "diff", "--cached", "--no-renames"]) else { return };
    let shown = shown.exits(0);
    for line in [
        "diff --ncc good.cn\n",
        "good.cn (old) (mach9) and good.cn (new) (mach9)\n",
        "  different: same path; feed 100 → 80 on 2 moves of T1\n",
        "new program: 12 blocks\n",
        "deleted program: 12 blocks\n",
    ] {
        assert!(shown.out.contains(line), "no `{line}` in\n{}{}", shown.out, shown.err);
    }
    // A version that has errors: the texts are shown.
    std::fs::write(folder.path().join("good.cn"), BAD).unwrap();
    let Some(shown) = git(folder.path(), &["--no-pager", "diff"]) else { return };
    let shown = shown.exits(0);
    assert!(shown.out.contains("cannot be executed as mach9; the texts are compared"), "{}", shown.out);
    assert!(shown.out.contains("+GOX-15."), "{}", shown.out);
}

#[test]
fn git_shows_events() {
    let Some(folder) = repository("diff.ncc.textconv=ncc git-textconv --from mach9") else { return };
    let Some(shown) = git(folder.path(), &["--no-pager", "diff", "--cached", "good.cn"]) else { return };
    let shown = shown.exits(0);
    let lines: Vec<&str> = shown.out.lines().filter(|l| l.starts_with(['+', '-'])).skip(2).collect();
    assert_eq!(
        lines,
        ["-feed X0 Y0 Z-1 F100", "-feed X10 Y0 Z-1 F100", "+feed X0 Y0 Z-1 F80", "+feed X10 Y0 Z-1 F80"]
    );
}
