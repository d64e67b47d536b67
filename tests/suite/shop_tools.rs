//! Tools beside a change and lengths without Z, of a Fanuc of either kind: the compiler's execution, and the second
//! interpreter, which has it from the reference notes.

use ncc_ir::behaviour::Behaviour;
use ncc_tests::expect::Failures;
use ncc_tests::plain::{self, Tolerance};
use ncc_tests::translate;

const HEAD: &str = "%\nO1\nG21 G17 G90 G94 G54 G40 G49 G80\n";

/// Blocks after the head, separated by ` / `.
const TOOLS: [&str; 4] = [
    "T1 / M06 T2 / G00 X0. Y0. / G43 H1 Z10. / G00 X5. / M06 T1 / G43 H2 Z20. / X7.",
    "T1 M06 / G00 G43 H1 Z10. / T2 / G00 X5. / T3 M06 / G43 H2 Z10. / X6. / M06 / G43 H3 Z10. / X7.",
    "T1 / T2 / T4 M06 / G00 X1. / M06 T5 / X2. / T5 M06 / X3. / M06 / X4.",
    // None waits: the same on both.
    "T1 M06 / G00 X1. / T2 M06 / X2. / T2 / T2 M06 / X3.",
];

/// The same.
const LENGTHS: [&str; 5] = [
    "T1 M06 / G00 X0. Y0. / G43 H1 Z10. / G01 Z5. F100. / G49 / X10. / G00 Z50.",
    "G00 X0. Y0. Z10. / G43 H1 / X5. / G43 H2 X6. Z11. / G43 H3 / G49 / G00 X1. Z1.",
    "G00 X0. Y0. / G43 H1 Z10. / G91 G28 Z0. / G49 / G90 X5. / G00 Z10. / G43 H2 / G00 X1. Z1.",
    "G00 X0. Y0. / G43 H1 Z10. / G53 Z0. / G43 H2 / G00 X5. Z12. / G49 / M30",
    // With a Z in its block: the same on both.
    "G00 X0. Y0. / G43 H1 Z10. / G49 Z50. / G43 H2 X5. Z20.",
];

/// Executes programs by both, with both values of a fact. Each but the last is another program with each value.
fn by_both(behaviour: Behaviour, programs: &[&str]) {
    let mut failures = Failures::default();
    for (at, blocks) in programs.iter().enumerate() {
        let text = format!("{HEAD}{blocks}\nM30\n%\n").replace(" / ", "\n");
        let Some(read) = failures.check(*blocks, translate::read("fanuc", text.as_bytes())) else { continue };
        let mut made = Vec::new();
        for value in [0, 1] {
            let mut world = plain::of_dialect(plain::world(1), "fanuc");
            world.behaviours.set(behaviour, value, false);
            let start = world.start.map(|n| n as f64 / 1e9);
            let result =
                plain::second("fanuc", text.as_bytes(), plain::setup(&world, 0)).and_then(|machine| {
                    let events = translate::execute(&read, &world, 0)?;
                    let (a, b) = (plain::of_machine(&machine, start), plain::of_events(&events, start));
                    plain::compare(&a, &b, Tolerance::SAME)?;
                    Ok(b)
                });
            made.extend(
                failures.check(format!("{blocks}, {}", behaviour.values()[usize::from(value)]), result),
            );
        }
        if let [usual, other] = &made[..] {
            let same = plain::compare(usual, other, Tolerance::SAME).is_ok();
            if same != (at + 1 == programs.len()) {
                failures.add(*blocks, format!("the two kinds make the same: {same}"));
            }
        }
    }
    failures.finish();
}

#[test]
fn a_tool_that_waits() {
    by_both(Behaviour::ToolWithChange, &TOOLS);
}

#[test]
fn a_length_that_moves() {
    by_both(Behaviour::LengthWithoutAxis, &LENGTHS);
}
