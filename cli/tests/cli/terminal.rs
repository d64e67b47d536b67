//! Nothing of a program, and no name of a file, reaches a terminal as a command to it.

use super::*;

/// Characters that move a cursor, change colours or set a title: of two tables, a byte and two bytes long.
const SIGNS: &str = "\u{1b}[2J\u{9b}31m\u{7}\u{7f}\u{202e}";

fn program() -> String {
    format!(
        "G21 G17 G90 G94 G54\n(POCKET {SIGNS})\nT1 M6\nS500 M3\nG0 X1 Y0 Z5\nG1 Z-1 F100 (CUT {SIGNS})\nM1 (STOP {SIGNS})\nG0 Z5 Q{SIGNS}\nM2\n"
    )
}

#[track_caller]
fn is_clean(done: &Done, what: &str) {
    for text in [&done.out, &done.err] {
        let bad = text.chars().find(|c| c.is_control() && !"\n\t".contains(*c) || *c == '\u{202e}');
        assert_eq!(bad, None, "{what}: {text}");
    }
}

#[test]
fn no_verb_shows_control_characters() {
    let folder = tempfile::tempdir().unwrap();
    let name = format!("a{}b.nc", &SIGNS[..SIGNS.len() - 3]);
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    // Once with a block that nobody reads, once without.
    for (case, text) in [program(), program().replace(&format!(" Q{SIGNS}"), "")].into_iter().enumerate() {
        write(&name, &text);
        write("other.nc", &text.replace("X1", "X2").replace("POCKET", "SLOT"));
        write("good.nc", &text);
        for file in [name.as_str(), "good.nc"] {
            for arguments in [
                &["time", "--from", "linuxcnc", file][..],
                &["time", "--from", "linuxcnc", "--by", "operation", file],
                &["check", "--from", "linuxcnc", file],
                &["check", file],
                &["fmt", "--from", "linuxcnc", "--diff", file],
                &["fmt", "--from", "linuxcnc", "--check", file],
                &["diff", "--from", "linuxcnc", file, "other.nc"],
                &["diff", "--from", "linuxcnc", "--text", file, "other.nc"],
                &["diff", "--from", "linuxcnc", "--side-by-side", file, "other.nc"],
                &["verify", "--from", "linuxcnc", "--to", "linuxcnc", file, "other.nc"],
                &["doctor", "--from", "linuxcnc", "--to", "fanuc", file],
                &["linuxcnc", "to", "fanuc", "-o", "out.nc", file],
                &["linuxcnc", "to", "fanuc", "--format", "json", "-o", "out.nc", file],
                &["linuxcnc", "to", "fanuc", file, "-o", "none/out.nc"],
                &["why", file, "3"],
                &["time", "--nothing", file],
                &["explain", file],
            ] {
                is_clean(&ncc(folder.path(), arguments), &format!("{case} {arguments:?}"));
            }
        }
    }
}

#[test]
fn programs_keep_every_character() {
    let folder = tempfile::tempdir().unwrap();
    let text = "G21 G17 G90 G94 G54\n(A \u{1b}[2J)\nG0 X1\nM2\n";
    std::fs::write(folder.path().join("part.nc"), text).unwrap();
    let done = ncc(folder.path(), &["fmt", "--from", "linuxcnc", "--stdout", "part.nc"]).exits(0);
    assert!(done.out.contains("(A \u{1b}[2J)"), "{}", done.out);
}
