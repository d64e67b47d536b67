//! Usage, help, and the verbs that translate nothing.

use super::*;

#[test]
fn the_help_reads_as_written_down() {
    let folder = folder();
    for (name, arguments) in [
        ("help.txt", &["--help"][..]),
        ("help-translate.txt", &["translate", "--help"]),
        ("help-verify.txt", &["verify", "--help"]),
        ("dialects.txt", &["dialects"]),
        ("explain-NC0107.txt", &["explain", "NC0107"]),
    ] {
        let done = ncc(folder.path(), arguments).exits(0);
        assert_eq!(done.err, "");
        expect(name, &done.out);
    }
    let long = ncc(folder.path(), &["mach9", "to", "fanuc", "--help"]).exits(0).out;
    assert_eq!(long, ncc(folder.path(), &["translate", "--help"]).out);
}

#[test]
fn wrong_usage_is_exit_2_and_writes_nothing() {
    let folder = folder();
    for (arguments, says) in [
        (&[][..], "Usage:"),
        (&["good.cn"], "neither a command nor a dialect"),
        (&["mach9"], "translate from mach9 into what?"),
        (&["mach9", "to"], "translate from mach9 into what?"),
        (&["mach9", "to", "fanuc"], "<FILE>"),
        (&["translate", "good.cn", "--machine-from", "fanuc-vmc"], "--machine-to MACHINE"),
        (&["translate", "good.cn", "--from", "mach9"], "--to fanuc"),
        (&["translate", "good.cn", "--to", "fanuc"], "--machine-from MACHINE"),
        (&["fanuc", "to", "siemens", "good.cn", "--from-option", "path_tolerance=-0.02"], "path_tolerance"),
        (&["fanuc", "to", "siemens", "good.cn", "--from-option", "path_tolerance=1e-3"], "path_tolerance"),
        (&["doctor", "good.cn"], "--machine-to MACHINE"),
        (&["mach9", "to", "fanuk", "good.cn"], "did you mean fanuc?"),
        (&["Mach9", "to", "fanuc", "good.cn"], "did you mean mach9?"),
        (&["mach9", "to", "auto", "good.cn"], "no dialect `auto`"),
        (&["mach9:nonsense", "good.cn"], "no dialect `nonsense`"),
        (&["mach9", "to", "fanuc", "good.cn", "bad.cn"], "name a folder for the outputs"),
        (&["mach9", "to", "fanuc", "good.cn", "--eol", "cr"], "--eol"),
        (&["mach9", "to", "fanuc", "good.cn", "--number", "10"], "FIRST:STEP"),
        (&["mach9", "to", "fanuc", "good.cn", "--allow", "everything"], "--allow"),
        (&["mach9", "to", "fanuc", "good.cn", "--start", "X1,Q2"], "X Y Z A B C"),
        (&["mach9", "to", "fanuc", "good.cn", "--program-number", "0"], "--program-number"),
        (&["mach9", "to", "fanuc", "good.cn", "--from-option", "o_word"], "NAME=VALUE"),
        (&["mach9", "to", "fanuc", "good.cn", "--from-option", "nope=1"], "it has: change_in_block"),
        (&["mach9", "to", "fanuc", "good.cn", "--from-option", "o_word=maybe"], "it takes: offset, ignore"),
        (&["mach9", "to", "ir", "good.cn", "--to-option", "o_word=offset"], "no option"),
        (&["mach9", "to", "fanuc", "good.cn", "--no-head", "--no-verify"], "cannot be used with"),
        (&["mach9", "to", "fanuc", "good.cn", "--quiet", "--verbose"], "cannot be used with"),
        (&["dialects", "show", "nope"], "no dialect `nope`"),
        (&["explain", "NC9999"], "no message `NC9999`"),
        (&["completions", "cmd.exe"], "cmd.exe"),
    ] {
        let done = ncc(folder.path(), arguments).exits(2).says(says);
        assert_eq!(done.out, "", "{arguments:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn every_code_is_explained() {
    let folder = folder();
    for code in ncc_ir::diag::Fault::CODES {
        let code = format!("NC{code:04}");
        let done = ncc(folder.path(), &["explain", &code]).exits(0);
        assert!(done.out.starts_with(&format!("# {code}: ")), "{code}");
    }
}

#[test]
fn manual_pages_are_roff_and_know_the_options() {
    let folder = folder();
    let page = ncc(folder.path(), &["man"]).exits(0).out;
    assert!(page.contains(".TH ncc 1") && page.contains("ncc\\-translate"), "{page}");
    let page = ncc(folder.path(), &["man", "translate"]).exits(0).out;
    assert!(page.contains(".TH ncc\\-translate 1") || page.contains(".TH ncc-translate 1"), "{page}");
    assert!(page.contains("from\\-option"), "{page}");
    ncc(folder.path(), &["man", "translat"]).exits(2).says("there is no verb `translat`");
}

#[test]
fn completions_know_the_options() {
    let folder = folder();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let done = ncc(folder.path(), &["completions", shell]).exits(0);
        assert!(done.out.contains("from-option") && done.out.contains("translate"), "{shell}");
    }
    let script = ncc(folder.path(), &["completions", "bash"]).out;
    std::fs::write(folder.path().join("c.bash"), script).unwrap();
    finish(command("bash", folder.path(), &["-n", "c.bash"])).exits(0);
}

#[test]
fn dialects_and_passes_are_listed() {
    let folder = folder();
    let list = ncc(folder.path(), &["dialects"]).exits(0).out;
    for dialect in ncc_dialects::builtins() {
        assert!(list.contains(&format!("{} ", dialect.id)) && list.contains(&dialect.title));
        let shown = ncc(folder.path(), &["dialects", "show", &dialect.id]).exits(0).out;
        for row in &dialect.code {
            assert!(shown.contains(&row.code) && shown.contains(&row.source), "{}", row.code);
        }
        for row in &dialect.option {
            let about = ncc_driver::render::dialects::option_about(dialect, row);
            assert!(!about.is_empty() && shown.contains(&row.name) && shown.contains(&about), "{}", row.name);
        }
        for (tag, source) in &dialect.sources {
            assert!(shown.contains(tag.as_str()) && shown.contains(source.as_str()), "{tag}");
        }
    }
    let passes = ncc(folder.path(), &["passes"]).exits(0).out;
    let names: Vec<&str> = passes.lines().filter_map(|l| l.split_whitespace().next()).collect();
    assert_eq!(names, ncc_passes::PASSES.iter().map(|p| p.name).collect::<Vec<_>>());
}

#[test]
fn the_corpus_is_recognised() {
    let folder = folder();
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpus");
    for dialect in ncc_dialects::builtins() {
        let (mut sure, mut all) = (0, 0);
        for entry in std::fs::read_dir(corpus.join(&dialect.id)).into_iter().flatten() {
            let path = entry.unwrap().path();
            let done = ncc(folder.path(), &["auto", "to", "ir", path.to_str().unwrap(), "-o", "x"]);
            all += 1;
            match done.err.split_once("read as ") {
                // What both explain is read as the whole; where the two differ, the user is asked.
                Some((_, rest))
                    if dialect
                        .part_of
                        .as_ref()
                        .is_some_and(|whole| rest.starts_with(&format!("{whole}: "))) =>
                {
                    sure += 1;
                }
                Some((_, rest)) => {
                    sure += 1;
                    assert!(rest.starts_with(&format!("{}: ", dialect.id)), "{}: {rest}", path.display());
                }
                None => assert_eq!(done.code, 2, "{}: {}", path.display(), done.err),
            }
        }
        assert!(sure * 10 >= all * 8, "{}: {sure} of {all} recognised", dialect.id);
    }
}
