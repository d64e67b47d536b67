//! Where the structures of a program begin and end: IF, LOOP, FOR, WHILE and REPEAT, each with its words alone in a
//! block (Job Planning 03/2006, 1.14).

use super::text::{Block, Reader};
use super::variables::Variables;

/// Structures of a program, by places of blocks.
#[derive(Debug, Default)]
pub(super) struct Shape {
    /// Pairs of head and end; an IF with ELSE is two: up to it, and from it on.
    pairs: Vec<(usize, usize)>,
}

impl Shape {
    /// Where what begins here ends.
    pub(super) fn end(&self, begin: usize) -> Option<usize> {
        self.pairs.iter().find(|pair| pair.0 == begin).map(|pair| pair.1)
    }

    /// Where what ends here begins.
    pub(super) fn begin(&self, end: usize) -> Option<usize> {
        self.pairs.iter().find(|pair| pair.1 == end).map(|pair| pair.0)
    }

    /// Whether one comes into a structure between two places.
    pub(super) fn enters(&self, from: usize, to: usize) -> bool {
        let within = |at: usize, pair: &(usize, usize)| (pair.0 + 1..=pair.1).contains(&at);
        self.pairs.iter().any(|pair| within(to, pair) && !within(from, pair))
    }
}

/// The first word of a block's text and what stands behind it.
pub(super) fn first_word(text: &[char]) -> Option<(String, &[char])> {
    let none = Variables::default();
    let mut reader = Reader::new(text, &none);
    reader.blanks();
    let word = reader.name()?;
    reader.blanks();
    Some((word, &text[reader.at..]))
}

/// Whether a jump stands in a text, outside its texts in quotation marks.
pub(super) fn jumps(text: &[char]) -> bool {
    let text: String = text.iter().collect();
    let bare = text.split('"').step_by(2).collect::<Vec<_>>().join(" ").to_ascii_uppercase();
    bare.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).any(|word| word.starts_with("GOTO"))
}

/// Finds the structures.
pub(super) fn of(blocks: &[(usize, Block)]) -> Result<Shape, String> {
    let mut open: Vec<(&str, usize)> = Vec::new();
    let mut shape = Shape::default();
    for (at, (line, block)) in blocks.iter().enumerate() {
        let Some((word, rest)) = first_word(&block.rest) else { continue };
        let closes: &[&str] = match word.as_str() {
            "IF" if jumps(rest) => continue,
            // The other one repeats a part of the program.
            "REPEAT" if !rest.is_empty() => continue,
            "IF" | "LOOP" | "FOR" | "WHILE" | "REPEAT" => &[],
            "ELSE" => &["IF"],
            "ENDIF" => &["IF", "ELSE"],
            "ENDLOOP" => &["LOOP"],
            "ENDFOR" => &["FOR"],
            "ENDWHILE" => &["WHILE"],
            "UNTIL" => &["REPEAT"],
            _ => continue,
        };
        if block.skip.is_some() {
            return Err(format!("line {line}: a structure that is skipped"));
        }
        if !closes.is_empty() {
            match open.pop() {
                Some((begun, from)) if closes.contains(&begun) => shape.pairs.push((from, at)),
                _ => return Err(format!("line {line}: {word} without its beginning")),
            }
        }
        match word.as_str() {
            "IF" => open.push(("IF", at)),
            "ELSE" => open.push(("ELSE", at)),
            "LOOP" => open.push(("LOOP", at)),
            "FOR" => open.push(("FOR", at)),
            "WHILE" => open.push(("WHILE", at)),
            "REPEAT" => open.push(("REPEAT", at)),
            _ => {}
        }
    }
    match open.pop() {
        None => Ok(shape),
        Some((word, at)) => Err(format!("line {}: {word} without its end", blocks[at].0)),
    }
}
