//! Text in messages: what is shown of it, and its quotes.

/// Text as it may be shown: no control characters. ncc's own sentences are never cut.
pub fn plain(text: &str) -> String {
    plain_upto(text, 400)
}

/// The same, with a length of one's own, in characters.
pub fn plain_upto(text: &str, longest: usize) -> String {
    let mut shown: String = text.chars().take(longest).map(super::source::visible).collect();
    if text.chars().nth(longest).is_some() {
        shown.push('…');
    }
    shown
}

/// Text from the source, not too long, in the quotes of code.
pub fn quoted(text: &str) -> String {
    format!("`{}`", plain_upto(text, 60))
}
