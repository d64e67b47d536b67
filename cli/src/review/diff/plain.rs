//! The account for a terminal: one difference after the other, or both texts in two columns.

use std::io::{self, Write};

use ncc_driver::review::diff::tell::{Account, Block, Difference};

/// Narrowest column of a text.
const NARROWEST: usize = 20;

/// The terminal's width, or 100 where nobody knows.
pub(crate) fn width() -> usize {
    let said = std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
    said.unwrap_or(100).clamp(2 * NARROWEST + 20, 400)
}

/// One difference after the other.
///
/// # Errors
/// Writing.
pub(crate) fn write(out: &mut dyn Write, account: &Account, most: usize) -> io::Result<()> {
    head(out, account)?;
    for difference in account.differences.iter().take(most) {
        writeln!(out, "\n{}", titled(difference))?;
        let places = |side: usize, block: &Block| format!("{}:{}", account.names[side], block.line);
        let wide = [0, 1].map(|side: usize| {
            let all = difference.blocks[side].iter().chain(&difference.beside[side]);
            all.map(|block| places(side, block).chars().count()).max().unwrap_or(0)
        });
        let wide = wide[0].max(wide[1]);
        let mut line = |sign: char, side: usize, block: &Block| {
            let place = places(side, block);
            let pad = wide - place.chars().count();
            writeln!(out, "{}", format!("  {sign} {place}{:pad$}  {}", "", block.text).trim_end())
        };
        if difference.paired {
            for (a, b) in difference.blocks[0].iter().zip(&difference.blocks[1]) {
                line('-', 0, a)?;
                line('+', 1, b)?;
            }
        } else {
            for (side, sign) in ['-', '+'].into_iter().enumerate() {
                for block in &difference.blocks[side] {
                    line(sign, side, block)?;
                }
                if difference.blocks[side].is_empty()
                    && let Some(block) = &difference.beside[side]
                {
                    line('>', side, block)?;
                }
            }
        }
        if difference.more != [false; 2] {
            writeln!(out, "    … and further blocks")?;
        }
    }
    foot(out, account, most)
}

/// Both texts in two columns.
///
/// # Errors
/// Writing.
pub(crate) fn columns(out: &mut dyn Write, account: &Account, most: usize, width: usize) -> io::Result<()> {
    head(out, account)?;
    let column = (width - 3) / 2;
    let cell = |block: Option<&Block>| {
        let text = block.map(|block| format!("{:>6}  {}", block.line, block.text)).unwrap_or_default();
        fitted(&text, column)
    };
    writeln!(
        out,
        "\n{} | {}",
        fitted(&account.names[0], column),
        fitted(&account.names[1], column).trim_end()
    )?;
    for difference in account.differences.iter().take(most) {
        let title = format!("-- {} ", titled(difference));
        let rule = width.saturating_sub(title.chars().count());
        writeln!(out, "{title}{}", "-".repeat(rule))?;
        let [a, b] = &difference.blocks;
        for i in 0..a.len().max(b.len()) {
            let sign = match (a.get(i), b.get(i)) {
                (Some(_), Some(_)) => '|',
                (Some(_), None) => '<',
                (None, _) => '>',
            };
            let line = format!("{} {sign} {}", cell(a.get(i)), cell(b.get(i)));
            writeln!(out, "{}", line.trim_end())?;
        }
        if difference.more != [false; 2] {
            writeln!(out, "    … and further blocks")?;
        }
    }
    foot(out, account, most)
}

/// A text cut or filled to a width.
fn fitted(text: &str, width: usize) -> String {
    let text = text.replace('\t', " ");
    match text.chars().count() {
        n if n <= width => format!("{text}{:pad$}", "", pad = width - n),
        _ => text.chars().take(width - 1).chain(['…']).collect(),
    }
}

fn titled(difference: &Difference) -> String {
    let levels: Vec<String> = difference.skip.iter().map(u8::to_string).collect();
    match levels.is_empty() {
        true => difference.title.clone(),
        false => format!("{} (with block skip {} on)", difference.title, levels.join(", ")),
    }
}

fn head(out: &mut dyn Write, account: &Account) -> io::Result<()> {
    let [a, b] = &account.names;
    let [x, y] = &account.dialects;
    writeln!(out, "{a} ({x}) and {b} ({y})")?;
    match account.equal {
        true => writeln!(out, "  {}", account.summary)?,
        false => writeln!(out, "  different: {}", account.summary)?,
    }
    if account.level == "motion" {
        let settings = match account.settings {
            1 => String::new(),
            n => format!(", under {n} settings of the block-skip switches"),
        };
        writeln!(
            out,
            "  compared: {} events in {} test set-ups{settings}, within {} mm",
            account.same + account.unmatched[0].max(account.unmatched[1]),
            account.worlds,
            account.tolerance
        )?;
    }
    for note in &account.notes {
        writeln!(out, "  note: {note}")?;
    }
    Ok(())
}

fn foot(out: &mut dyn Write, account: &Account, most: usize) -> io::Result<()> {
    let left = account.differences.len().saturating_sub(most);
    match (left, account.left_out) {
        (0, 0) => Ok(()),
        (0, n) => writeln!(out, "\n… and {n} more, too many to be listed"),
        (n, 0) => writeln!(out, "\n… and {n} more; --all shows them"),
        (n, m) => writeln!(out, "\n… and {} more; --all shows {n} of them", n as u64 + m),
    }
}
