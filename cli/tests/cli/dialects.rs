//! Dictionaries of a shop, and the test of dictionaries.

use super::*;

const SHOP: &str = "\
id = \"shop\"
title = \"Our Fanuc\"
base = \"fanuc\"

[[code]]
code = \"M24\"
means = \"FLOOD_ON\"
write = false
source = \"the builder's list\"
";

const PROGRAM: &str = "%\nO0012\nG21 G90 G54\nM24\nG0 X1. Y0. Z5.\nM30\n%\n";

fn shop() -> tempfile::TempDir {
    let folder = folder();
    std::fs::write(folder.path().join("shop.toml"), SHOP).unwrap();
    std::fs::write(folder.path().join("part.nc"), PROGRAM).unwrap();
    folder
}

#[test]
fn a_shops_dialect_is_a_name_like_any_other() {
    let folder = shop();
    let run = |line: &str| ncc(folder.path(), &line.split(' ').collect::<Vec<_>>());
    for line in [
        "shop to canon part.nc --dialect shop.toml",
        "--dialect shop.toml shop to canon part.nc",
        "shop:canon part.nc --dialect=shop.toml",
        "translate --from shop --to canon part.nc --dialect shop.toml",
        "auto to canon part.nc --dialect shop.toml",
    ] {
        assert!(run(line).exits(0).out.contains("FLOOD_ON()"), "{line}");
    }
    // Written are the words of the base.
    let back = run("shop to shop part.nc --dialect shop.toml --no-head").exits(0).out;
    assert!(back.contains("\nM08\n"), "{back}");
    assert!(run("fanuc to canon part.nc").exits(1).err.contains("`M24` is not a standard fanuc code"));
    assert!(run("dialects --dialect shop.toml").exits(0).out.contains("shop      Our Fanuc"));
    let shown = run("dialects show shop --dialect shop.toml").exits(0).out;
    assert!(shown.contains("builds on: fanuc") && shown.contains("the builder's list"), "{shown}");
    assert!(run("shop to canon part.nc").exits(2).err.contains("there is no dialect `shop`"));
}

#[test]
fn auto_takes_the_plainer_dialect_where_both_fit() {
    let folder = shop();
    std::fs::write(folder.path().join("part.nc"), PROGRAM.replace("M24", "M8")).unwrap();
    let done = ncc(folder.path(), &["auto", "to", "canon", "part.nc", "--dialect", "shop.toml"]).exits(0);
    assert!(done.err.contains("read as fanuc: "), "{}", done.err);
}

#[test]
fn what_is_wrong_with_a_dictionary_is_told_at_its_place() {
    let folder = shop();
    for (from, to, place, says) in [
        ("FLOOD_ON", "FLOD_ON", "shop.toml:7:9", "no meaning: FLOD_ON"),
        ("id = \"shop\"", "id = \"fanuc\"", "shop.toml:1:6", "fanuc is built in"),
        ("id = \"shop\"", "id = \"dialects\"", "shop.toml:1:1", "`dialects` is not a name for a dialect"),
        ("base = \"fanuc\"", "base = \"shop\"", "shop.toml:3:8", "cannot build on itself: shop, on shop"),
        ("write = false", "writes = false", "shop.toml:8:1", "unknown field `writes`"),
        ("means", "cycle", "shop.toml:7:1", "unknown field `cycle`"),
    ] {
        std::fs::write(folder.path().join("shop.toml"), SHOP.replace(from, to)).unwrap();
        let done = ncc(folder.path(), &["shop", "to", "canon", "part.nc", "--dialect", "shop.toml"]).exits(2);
        assert!(done.err.contains(place) && done.err.contains(says), "{place} {says}\n{}", done.err);
        let line = ["shop", "to", "canon", "part.nc", "--dialect", "shop.toml", "--format", "json"];
        let done = ncc(folder.path(), &line).exits(2);
        assert!(done.err.starts_with("{\"severity\":\"error\"") && done.err.contains(place), "{}", done.err);
    }
    let done = ncc(folder.path(), &["dialects", "--dialect", "none.toml"]).exits(4);
    assert!(done.err.contains("none.toml"), "{}", done.err);
}

#[test]
fn a_fault_of_the_base_is_shown_in_the_base() {
    let folder = shop();
    let text = format!("{SHOP}\n[[cycle]]\ncode = \"G81\"\nremove = true\n");
    std::fs::write(folder.path().join("shop.toml"), text).unwrap();
    let done = ncc(folder.path(), &["dialects", "--dialect", "shop.toml"]).exits(2);
    let says = ["row G81: has no [[cycle]] row", "fanuc (built in):", "shop.toml:3:8", "this base is meant"];
    assert!(says.iter().all(|s| done.err.contains(s)), "{}", done.err);
}

#[test]
fn dictionaries_are_tested() {
    let folder = shop();
    let run = |line: &str| ncc(folder.path(), &line.split(' ').collect::<Vec<_>>());
    let done = run("dialects test shop.toml -v").exits(0).out;
    assert!(done.contains("ok      code      M24") && done.contains(", 0 failed"), "{done}");
    let done = run("dialects test shop.toml").exits(0).out;
    assert!(!done.contains("ok      code") && done.contains("\n301 rows tested ("), "{done}");
    let both = run("dialects test -q haas shop.toml").exits(0).out;
    let heads: Vec<&str> = both.lines().filter(|l| l.contains(": ") && !l.starts_with("builds")).collect();
    assert!(heads[0].starts_with("haas: ") && both.contains("\nshop: Our Fanuc\n"), "{both}");
    std::fs::write(folder.path().join("shop.toml"), format!("{SHOP}\n[number.length]\npoint = \"never\"\n"))
        .unwrap();
    let failed = run("dialects test -q shop.toml").exits(1).out;
    assert!(failed.contains("failed  number    length 100 mm"), "{failed}");
    std::fs::write(folder.path().join("shop.toml"), SHOP.replace("FLOOD_ON", "FLOD_ON")).unwrap();
    run("dialects test shop.toml").exits(1).says("did you mean `FLOOD_ON`?");
    run("dialects test nothing").exits(2);
    run("dialects test nothing.toml").exits(4);
}

#[test]
fn the_form_of_a_dictionary_is_printed() {
    let folder = folder();
    let page = ncc(folder.path(), &["dialects", "schema"]).exits(0).out;
    assert!(page.starts_with("# Dictionaries\n") && page.contains("| `packed_call_digits`* |"));
}

/// A word that the manuals give no meaning, and some machines dwell by.
const PECKS: &str = "%\nO0013\nG21 G90 G17 G98 G54\nS900 M3\nG0 X0. Y0.\nZ20.\nG83 X5. Y0. Z-9. R2. Q4. P500 F80.\nG80\nM5\nM30\n%\n";

#[test]
fn an_option_says_what_p_of_a_deep_hole_is() {
    let folder = folder();
    std::fs::write(folder.path().join("part.nc"), PECKS).unwrap();
    let run = |line: &str| ncc(folder.path(), &line.split(' ').collect::<Vec<_>>());
    let ignored = run("fanuc to canon part.nc --no-head").exits(0).says("peck_dwell = ignored");
    assert!(!ignored.out.contains("DWELL"), "{}", ignored.out);
    let dwells = "fanuc to canon part.nc --no-head --from-option peck_dwell=dwell";
    let done = run(dwells).exits(0).out;
    assert_eq!(done.matches("DWELL(0.5)").count(), 1, "{done}");
    let refused = "fanuc to canon part.nc --from-option peck_dwell=refused";
    run(refused).exits(1).says("the option `peck_dwell` decides");
    // What the target has no word for is written out; what it has, is not.
    let out = run("fanuc to fanuc part.nc --no-head --from-option peck_dwell=dwell").exits(0).out;
    assert!(!out.contains("G83") && out.contains("G04 X0.500"), "{out}");
    let both = "fanuc to fanuc part.nc --no-head --from-option peck_dwell=dwell --to-option peck_dwell=dwell";
    let out = run(both).exits(0).out;
    assert!(out.contains("G83 X5. Y0. Z-9. R2. Q4. P500 F80."), "{out}");
}

/// A subprogram with a name, called twice.
const NAMED: &str = "%\nO0014\nG21 G90 G17 G54\nG0 X0. Y0. Z5.\nM98 <ROW-1> L2\nM30\n<ROW-1> (ALONG X)\nG91 X5.\nG90\nM99\n%\n";

#[test]
fn an_option_says_whether_names_are_written() {
    let folder = folder();
    std::fs::write(folder.path().join("part.nc"), NAMED).unwrap();
    let run = |line: &str| ncc(folder.path(), &line.split(' ').collect::<Vec<_>>());
    let out = run("fanuc to fanuc part.nc --no-head").exits(0).out;
    assert!(out.contains("M98 P21001") && out.contains("O1001 (ALONG X)"), "{out}");
    let out = run("fanuc to fanuc part.nc --no-head --to-option program_names=names").exits(0).out;
    assert!(out.contains("M98 <ROW-1> L2") && out.contains("<ROW-1> (ALONG X)"), "{out}");
    let by = "siemens to fanuc part.mpf --no-head --to-option program_names=names";
    let text =
        "%_N_MAIN_MPF\nG710 G17 G90 G94 G54\nG0 X0 Y0 Z5\nROW_1\nM30\n%_N_ROW_1_SPF\nG1 X5 F100\nM17\n";
    std::fs::write(folder.path().join("part.mpf"), text).unwrap();
    let out = run(by).exits(0).out;
    assert!(out.contains("M98 <ROW_1>") && out.contains("<ROW_1>\n"), "{out}");
}

/// Three holes in a row, counted as a Series 15 counts them.
const COUNTED: &str =
    "%\nO0015\nG21 G90 G17 G98 G54\nS900 M3\nG0 X0. Y0. Z10.\nG91 G81 X5. Z-6. R-8. F100. L3\nG80\nM30\n%\n";

#[test]
fn an_option_says_by_which_letter_holes_are_counted() {
    let folder = folder();
    std::fs::write(folder.path().join("part.nc"), COUNTED).unwrap();
    let run = |line: &str| ncc(folder.path(), &line.split(' ').collect::<Vec<_>>());
    run("fanuc to canon part.nc").exits(1).says("repetition by L");
    let counted = run("fanuc to canon part.nc --no-head --from-option repeat_word=L").exits(0).out;
    assert_eq!(counted.matches("STRAIGHT_FEED").count(), 3, "{counted}");
    let none = COUNTED.replace("X5.", "").replace("L3", "L0");
    std::fs::write(folder.path().join("stored.nc"), none.replace("G80\n", "X5.\nG80\n")).unwrap();
    let by = "fanuc to fanuc stored.nc --no-head --from-option repeat_word=L --to-option repeat_word=L";
    let stored = run(by).exits(0).out;
    assert!(stored.contains("G81 ") && !stored.contains('K'), "{stored}");
}

/// A second tool is changed in with the spindle turning, and positioned before it is started again.
const TURNING: &str = "%\nO0016\nG21 G90 G17 G54 G40 G49 G80\nT1 M6\nS900 M3\nG0 X0. Y0.\nG43 H1 Z5.\nT2 M6\nX50.\nS700 M3\nG43 H2 Z5.\nM5\nM30\n%\n";

#[test]
fn an_option_says_what_a_tool_change_leaves_of_the_spindle() {
    let folder = folder();
    std::fs::write(folder.path().join("part.nc"), TURNING).unwrap();
    let run = |line: &str| ncc(folder.path(), &line.split(' ').collect::<Vec<_>>());
    run("fanuc to linuxcnc part.nc").exits(1).says("--from-option spindle_at_change=stops");
    let stopped = "--no-head --from-option spindle_at_change=stops";
    let out = run(&format!("fanuc to linuxcnc part.nc {stopped}")).exits(0).out;
    assert!(out.contains("T2 M6\nX50"), "{out}");
    // Another machine may let it turn on: there it is stopped by a word.
    let out = run(&format!("fanuc to fanuc part.nc {stopped}")).exits(0).out;
    assert!(out.contains("M05\nT2 M06\n"), "{out}");
    let out = run(&format!("fanuc to fanuc part.nc {stopped} --to-option spindle_at_change=stops"));
    assert!(out.exits(0).out.contains("T2 M06\nX50.\n"));
    run("fanuc to fanuc part.nc --to-option spindle_at_change=stops")
        .exits(1)
        .says("tool change with the spindle turning");
}

/// `dialects new` prints a dialect that works at once and passes its test.
#[test]
fn a_new_dialect_is_its_base_until_rows_are_added() {
    let folder = folder();
    let run = |line: &str| ncc(folder.path(), &line.split(' ').collect::<Vec<_>>());
    for base in ["mach9", "fanuc", "haas", "siemens", "linuxcnc", "grbl", "mach3"] {
        let file = run(&format!("dialects new own-{base} --base {base}")).exits(0).out;
        std::fs::write(folder.path().join("own.toml"), &file).unwrap();
        let done = run("dialects test own.toml").exits(0).out;
        assert!(done.contains(" 0 failed"), "{base}: {done}");
        // The options are what they are on the base, also without the mark of a comment.
        let (head, options) = file.split_once("# What a parameter").unwrap();
        let uncommented = |text: &str| {
            let rows = text.lines().filter_map(|line| line.strip_prefix("# "));
            let is_row = |row: &&str| row.starts_with('[') || row.contains(" = ") && !row.contains(": ");
            rows.filter(is_row).collect::<Vec<_>>().join("\n")
        };
        let all = format!("{head}\n{}\n", uncommented(options));
        std::fs::write(folder.path().join("all.toml"), all).unwrap();
        run("dialects --dialect all.toml").exits(0);
        let list = run("dialects --dialect own.toml").exits(0).out;
        assert!(list.contains(&format!("own-{base}")), "{list}");
        // So are the rows, each by itself, but for what a builder's row adds.
        let (start, rows) = head.split_once("# A code that").unwrap();
        let all = format!("{start}\n{}\n", uncommented(rows));
        std::fs::write(folder.path().join("rows.toml"), &all).unwrap();
        let done = ncc(folder.path(), &["dialects", "test", "rows.toml"]);
        let done = done.exits(0).out;
        assert!(all.contains("remove = true") && done.contains(" 0 failed"), "{base}: {done}");
    }
    run("dialects new fanuc --base haas").exits(2).says("cannot be the name");
    run("dialects new shop --base fanuk").exits(2).says("did you mean fanuc?");
}
