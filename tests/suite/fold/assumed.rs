//! What a long program takes for granted, and says otherwise later.
//!
//! A program that streams is folded piece by piece, and the facts that it takes for granted become more
//! as it is read. A fact that it has said in the meantime stays as it was said.

use std::fmt::Write;

use ncc_tests::translate::{job, rendered, translate};

/// A contour of more than a piece of the source, nothing said of the work offset; then the second one;
/// then the first arc, with which the plane is taken for granted; then holes in the first offset, the
/// first of them from a height that is not known there.
fn program(head: &str) -> String {
    let mut text = format!("O1\nG21 G90 G94{head}\nG0 X0. Y0. Z5.\nG1 Z-1. F100.\n");
    for cut in 0..1000 {
        let _ = writeln!(text, "G1 X{}.{:03} Y{}.5", cut % 7, cut % 1000, cut % 5);
    }
    text += "G55\n";
    for cut in 0..1000 {
        let _ = writeln!(text, "G1 X{}.25 Y{}.5", cut % 2, cut % 3);
    }
    text += "G2 X11.25 Y0.5 I5. J0.\nG0 Z5.\nG54\n";
    for hole in 1..=6 {
        let _ = writeln!(text, "G0 X{}. Y{}.\nG0 Z2.\nG1 Z-4. F50.\nG0 Z5.", hole * hole, hole % 3);
    }
    text + "M30\n"
}

/// The folded text.
fn folded(text: &str) -> String {
    let mut job = job("fanuc", "ir", "long");
    (job.head, job.fold) = (false, Some(true));
    let (outcome, written) = translate(&job, text.as_bytes());
    let told = rendered(&job, "long", text.as_bytes(), &outcome.diagnostics);
    assert!(outcome.release.is_ok(), "{told}");
    String::from_utf8(written).expect("text")
}

#[test]
fn what_is_taken_for_granted_does_not_overwrite_what_was_said() {
    let [said, taken] = [" G17 G54", ""].map(|head| folded(&program(head)));
    let from = |text: &str| text[text.find("ARC_FEED").expect("the arc")..].to_owned();
    assert!(said.contains("START_CYCLE"), "the holes are folded:\n{}", from(&said));
    assert_eq!(from(&taken), from(&said));
}
