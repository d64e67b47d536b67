//! One JSON object in a line, with no character in it that a terminal acts on.

use std::io::{self, Write};

use serde::Serialize;

use super::text::visible;

/// One object in a line.
///
/// # Errors
/// Writing.
pub fn line(out: &mut dyn Write, object: &impl Serialize) -> io::Result<()> {
    let text = serde_json::to_string(object)?;
    // serde_json escapes the control characters below the blank alone; the others stand in strings too.
    match text.contains(|c: char| visible(c) != c) {
        false => out.write_all(text.as_bytes())?,
        true => {
            for c in text.chars() {
                match visible(c) == c {
                    true => write!(out, "{c}")?,
                    false => write!(out, "\\u{:04x}", c as u32)?,
                }
            }
        }
    }
    out.write_all(b"\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_escaped_and_kept() {
        let text = "a\u{85}\u{9b}31m \u{1b}[2J \u{7f} \u{202e} Ü";
        let mut out = Vec::new();
        line(&mut out, &[text]).unwrap();
        let out = String::from_utf8(out).unwrap();
        assert!(!out.trim_end().contains(|c: char| c.is_control() || c == '\u{202e}'), "{out}");
        assert!(out.contains("\\u0085\\u009b31m") && out.contains("Ü"), "{out}");
        assert_eq!(serde_json::from_str::<Vec<String>>(&out).unwrap(), [text]);
    }
}
