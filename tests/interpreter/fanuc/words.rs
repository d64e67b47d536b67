//! A block taken apart into words: letters, and the text of their values.

use super::super::Halt;
use super::{Control, Word, number};

impl Control {
    /// The words of a block, or nothing where it is skipped; a letter after a comma is kept as a small one.
    pub(super) fn words<'b>(&self, block: &'b str) -> Result<Option<Vec<(char, &'b str)>>, Halt> {
        let mut words = Vec::new();
        let mut rest = block;
        while let Some(mut letter) = rest.chars().next() {
            rest = &rest[1..];
            let comma = letter == ',';
            if comma {
                (letter, rest) = (rest.chars().next().unwrap_or(' '), rest.get(1..).unwrap_or(""));
            }
            if letter == '/' {
                let level = rest.chars().next().and_then(|c| c.to_digit(10)).filter(|n| *n > 0);
                if level.is_some() {
                    rest = &rest[1..];
                }
                let on = self.m.setup.skip[level.unwrap_or(1) as usize];
                match (on, words.is_empty()) {
                    (true, true) => return Ok(None),
                    (true, false) => return Ok(Some(words)),
                    (false, _) => continue,
                }
            }
            if !letter.is_ascii_uppercase() {
                return self.m.halt(format!("unexpected {letter}"));
            }
            let end = end_of_value(rest);
            let (text, behind) = rest.split_at(end);
            rest = behind;
            if letter != 'N' {
                words.push((if comma { letter.to_ascii_lowercase() } else { letter }, text));
            } else if text.parse::<f64>().is_err() {
                return self.m.halt(format!("no number: {letter}{text}"));
            }
        }
        Ok(Some(words))
    }

    /// A length, in millimetres: without a point it counts 0.001 mm or 0.0001 inch.
    pub(super) fn length(&self, words: &[Word], letter: char) -> Option<f64> {
        let (value, point) = number(words, letter)?;
        let unit = if self.m.inch { 25.4 } else { 1.0 };
        let step = match (point, self.m.inch) {
            (true, _) => 1.0,
            (false, false) => 0.001,
            (false, true) => 0.0001,
        };
        Some(value * step * unit)
    }

    /// An angle, in degrees: without a point it counts 0.001.
    pub(super) fn angle(&self, words: &[Word], letter: char) -> Option<f64> {
        let (value, point) = number(words, letter)?;
        Some(if point { value } else { value * 0.001 })
    }
}

/// How long the value at the front of a text is: a number, a variable, or a bracket, each with its sign.
fn end_of_value(text: &str) -> usize {
    let signs = text.find(|c: char| !"+-".contains(c)).unwrap_or(text.len());
    let bare = &text[signs..];
    let number =
        |text: &str| text.find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).unwrap_or(text.len());
    let bracket = |text: &str| {
        let mut depth = 0;
        let over = |c: char| {
            depth += i32::from(c == '[') - i32::from(c == ']');
            depth == 0
        };
        text.find(over).map_or(text.len(), |at| at + 1)
    };
    signs
        + match bare.strip_prefix('#') {
            Some(behind) if behind.starts_with('[') => 1 + bracket(behind),
            Some(behind) => 1 + behind.find(|c: char| !c.is_ascii_digit()).unwrap_or(behind.len()),
            None if bare.starts_with('[') => bracket(bare),
            None => number(bare),
        }
}
