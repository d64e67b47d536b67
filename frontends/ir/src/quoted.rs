//! Texts in quotation marks, as `canon` and `ir` write them.

use ncc_ir::program::Text;

/// The text between two quotation marks, its escapes undone: `\"`, `\\`, `\n`, `\r`, `\t` and
/// `\u{…}` with the number of a character in hexadecimal. `None` if an escape is none of these.
pub fn unquote(quoted: &str) -> Option<Text> {
    let inner = quoted.strip_prefix('"')?.strip_suffix('"')?;
    if !inner.contains('\\') {
        return Some(inner.into());
    }
    let mut text = String::with_capacity(inner.len());
    let mut rest = inner;
    while let Some(at) = rest.find('\\') {
        text.push_str(&rest[..at]);
        let escape = &rest[at + 1..];
        let first = escape.chars().next()?;
        rest = &escape[first.len_utf8()..];
        text.push(match first {
            '"' | '\\' => first,
            'n' => '\n',
            'r' => '\r',
            't' => '\t',
            'u' => {
                let (digits, after) = rest.strip_prefix('{')?.split_once('}')?;
                rest = after;
                char::from_u32(u32::from_str_radix(digits, 16).ok()?)?
            }
            _ => return None,
        });
    }
    text.push_str(rest);
    Some(text.into())
}
