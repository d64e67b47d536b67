//! `ncc plot` as a process: what it writes, what it refuses; and the pictures of the book.

use super::*;

fn plot(folder: &Path, arguments: &[&str]) -> Done {
    ncc(folder, &[&["plot"], arguments].concat())
}

/// The pictures of the book, by the arguments that make them.
const PICTURES: [(&str, &[&str]); 3] = [
    ("teste-charts.svg", &[]),
    ("teste-plan.svg", &["--view", "plan"]),
    ("teste-isometric.svg", &["--view", "isometric"]),
];

#[test]
fn the_pictures_of_the_book_are_what_is_drawn() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for (name, arguments) in PICTURES {
        let file = root.join("docs/book/src/images").join(name);
        let call = ["corpus/mach9/teste.cn", "--machine", "romi-discovery-4022", "-q"];
        let drawn = plot(&root, &[&call, arguments].concat()).exits(0);
        assert_eq!(drawn.err, "");
        if std::env::var_os("UPDATE_EXPECT").is_some() {
            std::fs::write(&file, &drawn.out).unwrap();
        }
        let expected = std::fs::read_to_string(&file).unwrap_or_default();
        assert!(expected == drawn.out, "{} differs; bless it with UPDATE_EXPECT=1", file.display());
        assert!(
            book::page("use/pictures.md").contains(&format!("(../images/{name})")),
            "{name} is not in the book"
        );
    }
}

#[test]
fn the_name_of_the_file_says_what_it_is() {
    let folder = folder();
    let folder = folder.path();
    plot(folder, &["good.cn", "--from", "mach9", "-o", "a.svg"]).exits(0).says("over at 0:00:");
    plot(folder, &["good.cn", "--from", "mach9", "-o", "a.HTML", "-q"]).exits(0);
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    assert!(read("a.svg").starts_with("<svg ") && read("a.HTML").starts_with("<!DOCTYPE html>"));
    assert!(read("a.HTML").contains("O1S1000M3"));
    for name in ["a.png", "a", "a.svg.gz"] {
        plot(folder, &["good.cn", "--from", "mach9", "-o", name]).exits(2).says(".svg or .html");
        assert!(!folder.join(name).exists());
    }
}

#[test]
fn a_tool_that_stands_still_has_no_way() {
    let folder = folder();
    let folder = folder.path();
    std::fs::write(folder.join("turn.nc"), "G21 G90 G17 G94\nG54\nG00 A90.\nM30\n").unwrap();
    for view in ["plan", "isometric"] {
        let arguments = ["turn.nc", "--from", "fanuc", "--view", view, "-o", "way.svg"];
        plot(folder, &arguments).exits(1).says("stand still").says("without --view");
        assert!(!folder.join("way.svg").exists());
    }
    plot(folder, &["turn.nc", "--from", "fanuc", "-o", "charts.svg"]).exits(0);
}

/// What the digits do not show has no sign.
#[test]
fn no_difference_is_not_negative() {
    let folder = folder();
    let arguments = ["good.cn", "good.cn", "--from", "mach9", "-q"];
    let done = plot(folder.path(), &arguments).exits(0);
    assert!(done.out.contains("difference 0.000 s"), "{}", done.out);
}

#[test]
fn what_contradicts_itself_is_wrong_usage() {
    let folder = folder();
    let folder = folder.path();
    plot(folder, &["good.cn", "--chart", "speed", "--view", "plan"]).exits(2);
    plot(folder, &["good.cn", "--chart", "temperature"]).exits(2);
    plot(folder, &["good.cn", "good.cn", "good.cn"]).exits(2);
    plot(folder, &["good.cn", "--from", "mach9,fanuc"]).exits(2).says("2 dialects for 1 programs");
    plot(folder, &["good.cn", "--view", "plan", "-o", "a.html"]).exits(2).says("a report has all of it");
    plot(folder, &["-", "-", "--from", "mach9"]).exits(2).says("only once");
    let options = ["good.cn", "good.cn", "--from", "mach9", "--from-option", "o_word=ignore"];
    plot(folder, &options).exits(2).says("one dialect");
    plot(folder, &["good.cn", "--machine", "nowhere"]).exits(2).says("there is no machine");
}

#[test]
fn nothing_is_drawn_of_a_program_with_errors() {
    let folder = folder();
    let folder = folder.path();
    plot(folder, &["bad.cn", "--from", "mach9", "-o", "a.svg"]).exits(1).says("NC");
    plot(folder, &["good.cn", "bad.cn", "--from", "mach9", "-o", "a.svg"]).exits(1);
    plot(folder, &["missing.cn", "-o", "a.svg"]).exits(4);
    assert!(!folder.join("a.svg").exists());
    // The source is never written over.
    std::fs::copy(folder.join("good.cn"), folder.join("good.svg")).unwrap();
    plot(folder, &["good.svg", "--from", "mach9", "-o", "good.svg"]).exits(2);
    assert_eq!(std::fs::read_to_string(folder.join("good.svg")).unwrap(), GOOD);
}

#[test]
fn a_port_and_its_source_lie_over_each_other() {
    let folder = folder();
    let folder = folder.path();
    ncc(folder, &["translate", "--from", "mach9", "--to", "fanuc", "good.cn", "-o", "good.nc"]).exits(0);
    let call = ["good.cn", "good.nc", "--from", "mach9,fanuc", "--machine", "romi-discovery-4022", "-q"];
    let both = plot(folder, &call).exits(0);
    // Both take the same time, to the last digit.
    assert!(both.out.contains("difference 0.000 s"), "{}", both.out);
    assert_eq!(both.out.matches("class=\"curve p1\"").count(), 5);
}

#[test]
fn charts_are_drawn_as_they_are_asked_for() {
    let folder = folder();
    let done = plot(folder.path(), &["good.cn", "--from", "mach9", "-q", "--chart", "tool,speed"]).exits(0);
    let at = |text: &str| done.out.find(text);
    assert!(at(">Tool<").unwrap() < at(">Spindle (rev/min)<").unwrap());
    assert!(at("Position").is_none() && at("Feed").is_none());
}

#[test]
fn an_arc_lies_where_the_program_says_it_under_any_frame() {
    let folder = folder();
    let folder = folder.path();
    let drawn = |frame: &str, view: &str| {
        let moves = "G0 X10 Y5\nG1 Z-2 F150\nG3 X40 Y15 CR=20\nG2 X40 Y15 I0 J8\nG2 X50 Y25 CR=10\nM30\n";
        let text = format!("G17 G90 G71 G94 G40\nG54\n{frame}\n{moves}");
        std::fs::write(folder.join("arcs.mpf"), text).unwrap();
        plot(folder, &["arcs.mpf", "--from", "siemens", "--view", view, "-q"]).exits(0).out
    };
    for view in ["plan", "isometric"] {
        let plain = drawn("; none", view);
        assert!(plain.contains("<path"));
        for frame in ["MIRROR X0", "MIRROR Y0", "MIRROR X0 Y0", "ROT RPL=90"] {
            assert!(drawn(frame, view) == plain, "{frame}, {view}");
        }
    }
}
