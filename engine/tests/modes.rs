//! The modes of a program, as a page gets them.

use ncc_engine::Engine;
use serde_json::Value;

struct Modes {
    head: Value,
    columns: Vec<u8>,
}

impl Modes {
    fn of(text: &str, from: &str, machine: &str) -> Modes {
        let mut engine = Engine::default();
        engine.put("shop.toml", SHOP.as_bytes().to_vec());
        engine.put("part.nc", text.as_bytes().to_vec());
        let machine = if machine.is_empty() { String::new() } else { format!(r#", "machine": "{machine}""#) };
        let code =
            engine.run(&format!(r#"{{ "verb": "path", "file": "part.nc", "from": "{from}"{machine} }}"#));
        assert_eq!(code, 0, "{:?}", engine.output("messages").map(String::from_utf8_lossy));
        let bytes = engine.output("modes").expect("modes");
        let end = bytes.iter().position(|byte| *byte == b'\n').expect("a line");
        let head = serde_json::from_slice(&bytes[..end]).expect("JSON");
        Modes { head, columns: bytes[end + 1..].to_vec() }
    }

    fn column(&self, name: &str) -> Vec<f64> {
        let all = self.head["columns"].as_array().expect("columns");
        let own = all.iter().find(|own| own["name"] == name).expect("a column");
        let (at, count) = (own["offset"].as_u64().unwrap(), own["count"].as_u64().unwrap());
        let width = own["type"].as_str().unwrap()[1..].parse::<u64>().unwrap() / 8;
        (0..count)
            .map(|n| {
                let from = (at + n * width) as usize;
                let bytes = &self.columns[from..from + width as usize];
                match width {
                    8 => f64::from_le_bytes(bytes.try_into().unwrap()),
                    4 => f64::from(u32::from_le_bytes(bytes.try_into().unwrap())),
                    _ => f64::from(bytes[0]),
                }
            })
            .collect()
    }

    /// What is active after so many changes.
    fn after(&self, changes: usize) -> String {
        let (modes, texts) = (self.column("change_mode"), self.column("change_text"));
        let count = self.head["modes"].as_array().unwrap().len();
        let active = (0..count).filter_map(|mode| {
            let last = (0..changes).rev().find(|n| modes[*n] == mode as f64)?;
            self.head["texts"][texts[last].max(1.0) as usize - 1].as_str().filter(|_| texts[last] > 0.0)
        });
        active.collect::<Vec<_>>().join(" ")
    }

    /// What is active behind a line; nothing where nothing is executed.
    fn line(&self, line: u32) -> Option<String> {
        let (lines, changes) = (self.column("line"), self.column("line_changes"));
        let at = lines.iter().rposition(|own| *own <= f64::from(line))?;
        (changes[at] > 0.0).then(|| self.after(changes[at] as usize - 1))
    }

    /// What is active in a move.
    fn at(&self, number: u32) -> String {
        let moves = self.column("change_move");
        self.after(moves.iter().filter(|own| **own <= f64::from(number)).count())
    }
}

/// A machine that states what leads to it, and how long its spindle runs up and down.
const SHOP: &str = "id = \"shop\"\ntitle = \"Shop\"\ndialect = \"fanuc\"\n[times]\nspindle_start = 3\nspindle_stop = 2\n\
    [[work_offset]]\nnumber = 1\nx = -100\ny = -200\nz = -300\n[[work_offset]]\nnumber = 2\nx = -110\ny = -200\nz = -300\n\
    [[tool]]\nnumber = 1\nlength = 80\n";

const PART: &str = "%\nO1\nG21 G17 G90 G94 G40 G49 G80\nT3 M6\nG55 G0 X10. Y10. S3000 M3\nG43 H3 Z10. M8\n\
    G1 Z-2. F200.\n\nG41 D13 X50. F600.\nG2 X60. Y20. R10.\nG40 G1 X70.\nG0 Z10. M9\nG99 G83 X20. Y20. Z-9. R2. Q3. F150.\n\
    G80 M5\nM30\n%\n";

#[test]
fn modes_are_told_in_the_words_of_the_dialect() {
    let modes = Modes::of(PART, "fanuc", "");
    assert_eq!(modes.line(3).as_deref(), Some("G17 G90 G94 G21 G40 G49"));
    assert_eq!(modes.line(7).as_deref(), Some("G01 G17 G90 G94 G21 G40 G55 M03 M08 G43 H3 F200 S3000 T3"));
    assert_eq!(
        modes.line(9).as_deref(),
        Some("G01 G17 G90 G94 G21 G41 D13 G55 M03 M08 G43 H3 F600 S3000 T3")
    );
    assert_eq!(
        modes.line(10).as_deref(),
        Some("G02 G17 G90 G94 G21 G41 D13 G55 M03 M08 G43 H3 F600 S3000 T3")
    );
    assert!(
        modes.line(13).is_some_and(|text| text.starts_with("G83 ") && text.contains("G99 ")),
        "{:?}",
        modes.line(13)
    );
    assert!(modes.line(14).is_some_and(|text| text.contains("M05") && !text.contains("G83")));
    assert_eq!(modes.at(1), "G00 G17 G90 G94 G21 G40 G55 M03 G49 S3000 T3");
    assert!(modes.at(3).starts_with("G01 ") && modes.at(3).ends_with("F200 S3000 T3"), "{}", modes.at(3));
}

/// A Sinumerik takes the length of an edge, and its tools have names. Two of its codes say millimetres.
#[test]
fn a_sinumerik_has_its_own_words() {
    let text = "G17 G90 G94 G71 G40\nT=\"MILL\"\nM6\nD2\nG54\nG0 X1 Y1 S900 M4\nG1 Z-1 F100 M8\nM30\n";
    let modes = Modes::of(text, "siemens", "");
    assert_eq!(modes.line(7).as_deref(), Some("G1 G17 G90 G94 mm G40 G54 M4 M8 D2 F100 S900 \"MILL\""));
}

/// A line that is passed several times is reported by its first pass; each move has its own.
#[test]
fn a_loop_has_the_modes_of_each_move() {
    let text = "%\nO1\nG21 G17 G90 G94 G40 G49 G80 G54\nS100 M3\nG0 X0. Y0. Z0.\n#1=1\nWHILE[#1LE3]DO1\n\
        G1 X#1 F[100*#1]\n#1=#1+1\nEND1\nIF[#1EQ0]GOTO10\n/M8\nN10 X9.\nM30\n%\n";
    let modes = Modes::of(text, "fanuc", "");
    assert!(modes.line(8).is_some_and(|text| text.contains("F100 ")), "{:?}", modes.line(8));
    let feeds: Vec<String> = (1..=3).map(|own| modes.at(own)).collect();
    for (own, feed) in feeds.iter().zip(["F100 ", "F200 ", "F300 "]) {
        assert!(own.contains(feed), "{feeds:?}");
    }
    assert_eq!(modes.line(7), None);
    // Behind a label and a block under a switch that is off, all is known as it was executed.
    assert_eq!(modes.at(4), "G01 G17 G90 G94 G21 G40 G54 M03 M08 G49 F300 S100");
}

/// What leads to the machine is known where the machine states it, and rotary axes are there where one moves.
#[test]
fn places_lead_to_the_machine_and_to_the_work_offset() {
    let text = "%\nO1\nG21 G17 G90 G94 G40 G49 G80\nG54 G0 X0. Y0.\nG43 H1 Z5.\nG1 X1. F100.\nG55 X2.\nA90.\nM30\n%\n";
    let modes = Modes::of(text, "fanuc", "");
    assert_eq!(modes.column("turn_a"), [0.0, 90.0]);
    assert_eq!(modes.column("shift_known").iter().sum::<f64>(), 0.0);
    let text = text.replace("G54 G0", "G54 S3000 M3\nG0").replace("A90.", "M5");
    let modes = Modes::of(&text, "fanuc", "shop.toml");
    let ends = |from: &str, to: &str| (modes.column(from), modes.column(to));
    assert_eq!(ends("spindle_before", "spindle_after"), (vec![0.0, 3000.0], vec![3000.0, 0.0]));
    let (from, to) = ends("spindle_from", "spindle_to");
    assert!((to[0] - from[0] - 3.0).abs() < 1e-9 && (to[1] - from[1] - 2.0).abs() < 1e-9, "{from:?} {to:?}");
    assert!(modes.column("turn_a").is_empty());
    let at = |column: &str, number: f64| {
        let own = modes.column("shift_move").iter().rposition(|own| *own <= number).expect("a shift");
        modes.column(column)[own]
    };
    assert_eq!((at("shift_known", 1.0), at("shift_known", 3.0)), (7.0, 7.0));
    assert_eq!((at("shift_x", 3.0), at("shift_z", 3.0)), (-100.0, -220.0));
    assert_eq!((at("offset_x", 2.0), at("offset_x", 3.0)), (0.0, 10.0));
}
