//! Bytes of a text as characters.

use ncc_ir::program::Text;

/// Text as UTF-8, else Latin-1; blanks at the end are no part of it.
pub(crate) fn decode(bytes: &[u8]) -> Text {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.trim_end().into(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect::<String>().trim_end().into(),
    }
}

/// The first character, as UTF-8 or else Latin-1, and its length in bytes.
pub(crate) fn first_char(bytes: &[u8]) -> (char, usize) {
    for len in 1..=bytes.len().min(4) {
        if let Some(c) = std::str::from_utf8(&bytes[..len]).ok().and_then(|s| s.chars().next()) {
            return (c, len);
        }
    }
    (bytes.first().map_or(' ', |&b| char::from(b)), 1)
}

/// Where the rest of a comment begins that begins with a word, blanks and the size of letters apart.
pub(crate) fn begins(text: &[u8], word: impl AsRef<[u8]>) -> Option<usize> {
    let mut at = 0;
    for byte in word.as_ref() {
        at += text[at..].iter().take_while(|b| b.is_ascii_whitespace()).count();
        if !text.get(at)?.eq_ignore_ascii_case(byte) {
            return None;
        }
        at += 1;
    }
    Some(at)
}
