//! Words of text whose names have several letters: `X10`, `CR=5`, `X=IC(5)`, `CYCLE81(3,3,0,-6)`,
//! `LABEL:`, `; comment`.

use super::words::{Is, Word};

/// The words of a line that begins at `base`.
pub(super) fn words(line: &[u8], base: usize, words: &mut Vec<Word>) {
    let mut put = |from: usize, to: usize, is: Is| words.push(Word { at: base + from..base + to, is });
    let end = line.iter().position(|b| *b == b'\r' || *b == b'\n').unwrap_or(line.len());
    if line.starts_with(b"%") {
        return put(0, end, Is::Name);
    }
    let mut at = 0;
    while at < end {
        let from = at;
        let c = line[at];
        at += 1;
        let is = match c {
            b';' => {
                at = end;
                Is::Text
            }
            b'"' => {
                at = line[at..end].iter().position(|b| *b == b'"').map_or(end, |n| at + n + 1);
                Is::Text
            }
            // A skip mark and its level are one word.
            b'/' => {
                at += usize::from(line.get(at).is_some_and(u8::is_ascii_digit));
                Is::Sign
            }
            // A comma moves all arguments behind it to other places.
            b',' => Is::Sign,
            b':' => {
                at = number(line, at);
                Is::Letter(c)
            }
            c if c.is_ascii_alphabetic() || c == b'_' => {
                let (to, is) = named(line, from);
                at = to;
                is
            }
            c if c.is_ascii_digit() || b"+-.".contains(&c) => {
                at = number(line, from);
                Is::Number
            }
            _ => continue,
        };
        put(from, at, is);
    }
}

/// The end of a word that begins with a letter, and what it is.
fn named(line: &[u8], from: usize) -> (usize, Is) {
    let letter = |at: usize| line.get(at).is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_');
    let single = !letter(from + 1);
    let mut at = from + 1;
    if !single {
        while letter(at) || line.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
    } else {
        // `I1=5` is a name, `X1` a letter with a number.
        let digits = line[at..].iter().take_while(|b| b.is_ascii_digit()).count();
        if digits > 0 && line.get(at + digits) == Some(&b'=') {
            return (value(line, at + digits + 1), Is::Named);
        }
    }
    match (line.get(at), single) {
        (Some(b'='), true) => (value(line, at + 1), Is::Letter(line[from])),
        (Some(b'='), false) => (value(line, at + 1), Is::Named),
        (Some(b':'), false) => (at + 1, Is::Label),
        (_, false) => (at, Is::Name),
        (_, true) => (number(line, at), Is::Letter(line[from])),
    }
}

/// The end of a value: a number, or one in `AC(…)` or `IC(…)`.
fn value(line: &[u8], from: usize) -> usize {
    if [&b"AC("[..], b"IC("].iter().any(|mark| line[from..].starts_with(mark)) {
        let at = number(line, from + 3);
        return at + usize::from(line.get(at) == Some(&b')'));
    }
    number(line, from)
}

fn number(line: &[u8], from: usize) -> usize {
    let digits = |b: &&u8| b.is_ascii_digit() || b"+-.".contains(b);
    from + line[from..].iter().take_while(digits).count()
}

#[test]
fn words_of_a_line() {
    let line = b"/2 N10 LAB: X-5 Y=IC(2.5) CR=5 I1=-3 CYCLE82(3,,-6) L12 P=3 MSG(\"a;b\") SUPA ; c\n";
    let mut found = Vec::new();
    words(line, 0, &mut found);
    let shown: Vec<_> =
        found.iter().map(|w| (std::str::from_utf8(&line[w.at.clone()]).unwrap_or("?"), w.is)).collect();
    let l = Is::Letter;
    let expected = [
        ("/2", Is::Sign),
        ("N10", l(b'N')),
        ("LAB:", Is::Label),
        ("X-5", l(b'X')),
        ("Y=IC(2.5)", l(b'Y')),
        ("CR=5", Is::Named),
        ("I1=-3", Is::Named),
        ("CYCLE82", Is::Name),
        ("3", Is::Number),
        (",", Is::Sign),
        (",", Is::Sign),
        ("-6", Is::Number),
        ("L12", l(b'L')),
        ("P=3", l(b'P')),
        ("MSG", Is::Name),
        ("\"a;b\"", Is::Text),
        ("SUPA", Is::Name),
        ("; c", Is::Text),
    ];
    assert_eq!(shown, expected);
}
