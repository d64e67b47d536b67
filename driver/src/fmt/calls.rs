//! The layout of texts that are lists of calls, `NAME(argument, argument)`: blanks as their writers set
//! them, and nothing else. What the writers would say in other words stays as it is.
//!
//! Not here: words of letters and numbers (`layout`).

/// Lays a line (without its end) out. `false` if it cannot be taken apart; then nothing is written.
pub fn line(line: &[u8], indented: bool, to: &mut Vec<u8>) -> bool {
    let text = line.trim_ascii();
    if text.starts_with(b"#") {
        to.extend_from_slice(if indented { line.trim_ascii_end() } else { text });
        return true;
    }
    let start = to.len();
    if indented {
        to.extend_from_slice(&line[..line.len() - line.trim_ascii_start().len()]);
    }
    let mut at = 0;
    while at < text.len() {
        match text[at] {
            b'"' => {
                let Some(len) = quoted(&text[at..]) else {
                    to.truncate(start);
                    return false;
                };
                to.extend_from_slice(&text[at..at + len]);
                at += len;
                continue;
            }
            b' ' | b'\t' => {
                let next = text[at..].iter().find(|b| !matches!(b, b' ' | b'\t'));
                if !matches!(next, Some(b' ' | b')' | b',')) && !matches!(to.last(), Some(b' ' | b'(')) {
                    to.push(b' ');
                }
            }
            b',' => {
                to.push(b',');
                if !matches!(text.get(at + 1), Some(b' ' | b'\t') | None) {
                    to.push(b' ');
                }
            }
            byte => to.push(byte),
        }
        at += 1;
    }
    true
}

/// Length of the string at the beginning of a text.
fn quoted(text: &[u8]) -> Option<usize> {
    let mut at = 1;
    loop {
        match text.get(at)? {
            b'"' => return Some(at + 1),
            b'\\' => at += 2,
            _ => at += 1,
        }
    }
}

/// Whether two lines say the same: strings byte for byte, all else but for blanks beside brackets and
/// commas, and runs of blanks.
pub fn same(a: &[u8], b: &[u8]) -> bool {
    if a.trim_ascii_start().starts_with(b"#") || b.trim_ascii_start().starts_with(b"#") {
        return a.trim_ascii() == b.trim_ascii();
    }
    words(a) == words(b)
}

/// A line in words: strings, brackets and commas, and what stands between blanks and those.
fn words(line: &[u8]) -> Vec<&[u8]> {
    let mut words = Vec::new();
    let (mut from, mut at) = (0, 0);
    while at < line.len() {
        let len = match line[at] {
            b' ' | b'\t' | b'\r' => 0,
            b'(' | b')' | b',' => 1,
            b'"' => quoted(&line[at..]).unwrap_or(line.len() - at),
            _ => {
                at += 1;
                continue;
            }
        };
        words.extend((from < at).then(|| &line[from..at]));
        words.extend((len > 0).then(|| &line[at..at + len]));
        at += len.max(1);
        from = at;
    }
    words.extend((from < line.len()).then(|| &line[from..]));
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laid_out(text: &str) -> String {
        let mut to = Vec::new();
        assert!(line(text.as_bytes(), true, &mut to));
        assert!(same(text.as_bytes(), &to), "{text}");
        String::from_utf8(to).unwrap()
    }

    #[test]
    fn calls_look_as_their_writers_set_them() {
        for (text, expected) in [
            ("STRAIGHT_FEED(1,2 , _ )  ", "STRAIGHT_FEED(1, 2, _)"),
            ("    A( X  1.mm,Y\tinc 3.mm )  &   B()", "    A(X 1.mm, Y inc 3.mm) & B()"),
            ("COMMENT( \"a ,( b\\\"  c\" )", "COMMENT(\"a ,( b\\\"  c\")"),
            ("  # a  note,kept ", "  # a  note,kept"),
            ("", ""),
        ] {
            assert_eq!(laid_out(text), expected);
            assert_eq!(laid_out(expected), expected);
        }
        assert!(!line(b"COMMENT(\"open)", true, &mut Vec::new()));
        for (a, b) in
            [("A(1, 2)", "A(12)"), ("A(\"a b\")", "A(\"a  b\")"), ("A B", "AB"), ("A(-1)", "A(- 1)")]
        {
            assert!(!same(a.as_bytes(), b.as_bytes()), "{a} | {b}");
        }
    }
}
