//! Evidence for and against a dialect whose words may have several letters.
//!
//! Not here: what such a text means; nothing is looked at but the words' names.

use ncc_dialects::Dialect;
use ncc_frontends::siemens::is_key_word;

use super::sign::Sign;
use super::{Evidence, word_of};

/// A line such as `N10 G1 X=AC(5) MCALL CYCLE81(3,3,0,-6) ; text`.
pub(super) fn line(dialect: &Dialect, number: usize, line: &[u8], evidence: &mut Evidence) {
    if line.starts_with(b"%_N_") {
        evidence.conclusive = true;
        evidence.pro(number, Sign::Header);
        return;
    }
    if line[0] == b'%' {
        return evidence.con(number, Sign::NoMark);
    }
    let mut at = 0;
    let (mut after_name, mut key_word) = (false, false);
    while at < line.len() {
        let c = line[at];
        let name = line[at..].iter().take_while(|b| b.is_ascii_alphanumeric() || **b == b'_').count();
        let letters = line[at..].iter().take_while(|b| b.is_ascii_alphabetic() || **b == b'_').count();
        if c == b';' {
            break;
        }
        if c == b'"' {
            at += 1 + line[at + 1..].iter().take_while(|b| **b != b'"').count() + 1;
            continue;
        }
        if c == b'(' && !after_name && !line[..at].contains(&b'=') {
            evidence.con(number, Sign::Foreign('('));
            return;
        }
        if letters >= 2 {
            let word = String::from_utf8_lossy(&line[at..at + name]).to_uppercase();
            let before = &line[..at];
            let key = is_key_word(word.as_bytes());
            if key || dialect.name_row(&word).is_some() || dialect.call_row(&word).is_some() {
                evidence.pro(number, Sign::OwnWord(word));
                key_word |= key;
            } else if key_word || before.iter().any(|b| b"=(<>".contains(b)) {
                // A name of the program's own, in an expression or where a structure names it.
            } else if !matches!(line.get(at + name), Some(b'(' | b'=' | b':' | b'[')) && name < line.len() {
                evidence.con(number, Sign::ForeignWord(word));
            }
            (at, after_name) = (at + name, true);
            continue;
        }
        after_name = false;
        if letters == 1 {
            let from = at;
            at += 1;
            let digits = line[at..].iter().take_while(|b| b"+-.0123456789".contains(b)).count();
            let value = std::str::from_utf8(&line[at..at + digits]).unwrap_or("");
            at += digits;
            let word = String::from_utf8_lossy(&line[from..at]).to_uppercase();
            match line[at..].trim_ascii_start().first() {
                Some(b'=') => evidence.pro(number, Sign::SetsValue(word)),
                _ => word_of(dialect, number, c.to_ascii_uppercase(), value, &word, from == 0, evidence),
            }
            after_name = line.get(at) == Some(&b'[');
            continue;
        }
        if !b" \t/+-.0123456789:=,()[]*<>$'&".contains(&c) {
            evidence.con(number, Sign::Foreign(char::from(c)));
        }
        at += 1;
    }
}
