//! LinuxCNC's own test programs beside the repository, listed as a user lists them: verified, with a profile that
//! states the tools of their tables. Says "skipped: …" where they are absent.
//!
//! The suite holds the printed calls; here it is seen that nothing is held back on the way to a user.

use std::fmt::Write as _;

use super::*;

/// Programs that are right for the interpreter and refused here by name, each with what is told of it.
const REFUSED: [(&str, &str); 7] = [
    ("ccomp-lathe-comp", "NC0501"),
    ("interp-g71-with-g70", "NC0120"),
    ("interp-g76", "NC0120"),
    ("interp-g84-g18-g99", "drills along another axis"),
    ("interp-g84-g19-g99", "drills along another axis"),
    ("interp-inverse-time-with-comp", "SET_FEED_MODE in a contour that ncc computes"),
    ("interp-m98m99-10-M98-P001", "two programs have the name `2`"),
];

/// Half-way between two digits a binary number is printed the other way.
const TO_A_DIGIT: &str = "interp-cam-nisley";

/// What it shows alone is listed in the folder.
const MESSAGES: &str = "interp-rotation-abs-pts";

/// A profile with the tools of a table in inches. Of a lathe's tool, told by the side on which its tip lies, only the
/// diameter is one of a mill's.
fn profile(table: &str) -> String {
    let mut text =
        "id = \"judged\"\ntitle = \"judged\"\ndialect = \"linuxcnc\"\n[options]\nmachine_units = \"inch\"\n"
            .to_owned();
    for line in table.lines().map(|line| line.split_once(';').map_or(line, |(row, _)| row)) {
        let word = |letter: char| line.split_whitespace().find_map(|word| word.strip_prefix(letter));
        let mm =
            |letter| word(letter).and_then(|inches| inches.parse::<f64>().ok()).map(|inches| inches * 25.4);
        let Some(number) = word('T') else { continue };
        let _ = writeln!(text, "[[tool]]\nnumber = {number}");
        if let Some(length) = mm('Z').filter(|_| word('Q').is_none()) {
            let _ = writeln!(text, "length = {length:.6}");
        }
        if let Some(diameter) = mm('D') {
            let _ = writeln!(text, "diameter = {diameter:.6}");
        }
    }
    text
}

/// As the folder of the programs says that texts are to be compared.
fn normalised(text: &str) -> Vec<String> {
    let listed = text.lines().filter(|line| !line.starts_with("START_CHANGE"));
    let squeezed =
        |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ").replace("-0.0000", "0.0000");
    let change = |line: &str| line.starts_with("CHANGE_TOOL(");
    listed.map(|line| if change(line) { "CHANGE_TOOL()".to_owned() } else { squeezed(line) }).collect()
}

fn same_to_a_digit(a: &str, b: &str) -> bool {
    let numbers = |line: &str| -> Vec<Option<f64>> {
        line.split([' ', ',', '(', ')']).map(|n| n.parse().ok()).collect()
    };
    let near = |(a, b): (&Option<f64>, &Option<f64>)| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() < 0.000_100_1,
        (a, b) => a == b,
    };
    let (a, b) = (numbers(a), numbers(b));
    a.len() == b.len() && a.iter().zip(&b).all(near)
}

#[test]
fn are_listed_as_by_the_interpreter_or_refused() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/cases/linuxcnc");
    let Ok(index) = std::fs::read_to_string(shared.join("INDEX.tsv")) else {
        #[allow(clippy::print_stderr)] // What was left out is to be seen.
        {
            eprintln!("skipped: no ../shared/cases/linuxcnc beside the repository");
        }
        return;
    };
    let folder = folder();
    let (mut wrong, mut all) = (String::new(), 0);
    for row in index.lines().skip(1) {
        let fields: Vec<&str> = row.split('\t').collect();
        let (name, from) = (fields[0], shared.join(fields[0]));
        all += 1;
        std::fs::copy(from.join(fields[1]), folder.path().join("part.ngc")).expect("a program");
        let table = std::fs::read_to_string(from.join("test.tbl")).unwrap_or_default();
        std::fs::write(folder.path().join("judged.toml"), profile(&table)).unwrap();
        let style = ["--style", "rs274", "--machine-from", "judged.toml", "part.ngc"];
        let done = ncc(folder.path(), &[&["linuxcnc", "to", "canon"][..], &style].concat());
        let refused = REFUSED.iter().find(|(refused, _)| *refused == name);
        let right = match refused {
            Some((_, told)) => done.code == 1 && done.err.contains(told),
            None if fields[4] == "yes" => done.code == 1,
            None => {
                let expected = std::fs::read_to_string(from.join("expected.canon")).expect("its calls");
                let (expected, mut listed) = (normalised(&expected), normalised(&done.out));
                if name == MESSAGES {
                    listed.retain(|line| line.starts_with("MESSAGE"));
                }
                let same = |(a, b): (&String, &String)| a == b || name == TO_A_DIGIT && same_to_a_digit(a, b);
                done.code == 0 && expected.len() == listed.len() && expected.iter().zip(&listed).all(same)
            }
        };
        if !right {
            let _ = writeln!(wrong, "{name}: exit {}\n{}", done.code, done.err);
        }
    }
    assert_eq!(all, 51);
    assert!(wrong.is_empty(), "{wrong}");
}
