//! The characters of an emitted text, where a control does not take all.
//!
//! Not here: which signs a comment may have (`word::comment`).

use ncc_ir::transliterate::stand_in;

use crate::Characters;

/// Brings what stands in `out` from `start` on within the characters.
pub(crate) fn encode(out: &mut Vec<u8>, start: usize, characters: Characters) {
    if characters == Characters::All || out[start..].is_ascii() {
        return;
    }
    // A writer writes text; what were none could not be read back, and is left to be found there.
    let Ok(text) = String::from_utf8(out.split_off(start)) else { return };
    for c in text.chars() {
        match (u8::try_from(u32::from(c)), characters) {
            (Ok(byte), _) if byte.is_ascii() => out.push(byte),
            (Ok(byte), Characters::Latin1) if byte >= 0xa0 => out.push(byte),
            _ => {
                let capital = stand_in(c);
                match c.is_lowercase() {
                    true => out.extend(capital.bytes().map(|b| b.to_ascii_lowercase())),
                    false => out.extend_from_slice(capital.as_bytes()),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoded(text: &str, characters: Characters) -> Vec<u8> {
        let mut out = format!("Ø{text}").into_bytes();
        encode(&mut out, "Ø".len(), characters);
        out.split_off("Ø".len())
    }

    #[test]
    fn each_set_has_its_characters() {
        assert_eq!(encoded("FURAÇÃO größe – 日", Characters::All), "FURAÇÃO größe – 日".as_bytes());
        assert_eq!(encoded("FURAÇÃO größe – 日", Characters::Ascii), b"FURACAO groesse - *");
        assert_eq!(encoded("AÇão –\u{85}", Characters::Latin1), b"A\xc7\xe3o - ");
    }
}
