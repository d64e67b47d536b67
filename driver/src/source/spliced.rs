//! Texts for tests that cut them where a piece ends.

use super::chunks::PIECE;

/// Lines behind the first piece: more than another one has.
const MANY: usize = 6_000;

/// A program whose first piece ends just behind `block`: remarks fill it up. The lines, by many, are the pieces behind it,
/// and read as tables if they are plain; the end of the program is in another one.
pub(crate) fn behind_a_piece(head: &str, block: &str, lines: &[String]) -> String {
    let mut text = format!("%\nO1\n{head}");
    let remark = "(A REMARK THAT FILLS THE PIECE)\n";
    while text.len() + block.len() + 2 * remark.len() < PIECE {
        text.push_str(remark);
    }
    let rest = PIECE - text.len() - block.len() - 1 - "()\n".len();
    text.push_str(&format!("({})\n{block}\n", "A".repeat(rest)));
    assert_eq!(text.len(), PIECE);
    for line in lines.iter().cycle().take(MANY) {
        text.push_str(&format!("{line}\n"));
    }
    text.push_str("M5\nM30\n%\n");
    text
}

/// Blocks that change what the lines behind them hang on.
pub(crate) const CHANGES: [&str; 16] = [
    "G54",
    "S600",
    "G55",
    "G95",
    "G52 X1.",
    "F50.",
    "M4",
    "M8",
    "G91",
    "G20",
    "G18",
    "G93",
    "M5",
    "S0",
    "G91 G28 Z0.\nG90",
    "G53 G0 Z-1.",
];
