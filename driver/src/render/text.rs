//! Text in messages: what is shown of it, and its quotes.

/// Text as it may be shown: no control characters. ncc's own sentences are never cut.
pub fn plain(text: &str) -> String {
    plain_upto(text, 400)
}

/// The same, with a length of one's own, in characters.
pub fn plain_upto(text: &str, longest: usize) -> String {
    let mut shown: String = text.chars().take(longest).map(visible).collect();
    if text.chars().nth(longest).is_some() {
        shown.push('…');
    }
    shown
}

/// Text from the source, not too long.
pub fn shown(text: &str) -> String {
    plain_upto(text, 60)
}

/// The same, in the quotes of code.
pub fn quoted(text: &str) -> String {
    format!("`{}`", shown(text))
}

/// A character that can be shown: pictures for control characters, so that none reaches a terminal.
pub fn visible(c: char) -> char {
    match c {
        '\t' => '\t',
        '\0'..='\x1f' => char::from_u32(0x2400 + c as u32).unwrap_or('\u{fffd}'),
        '\x7f' => '\u{2421}',
        '\u{80}'..='\u{9f}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => {
            '\u{fffd}'
        }
        _ => c,
    }
}
