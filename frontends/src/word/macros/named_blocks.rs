//! Which blocks of a text may be named by a jump: `GOTO 10` names N10. It looks at the bytes alone, before the text is
//! parsed, and may find more than there are.

use std::collections::BTreeSet;

use ncc_dialects::Dialect;

/// Whether a text has a word that jumps, or the two letters of it that are enough after a condition.
pub(super) fn has_jumps(text: &[u8]) -> bool {
    memchr::memchr2_iter(b'O', b'o', text).any(|at| {
        let Some(before) = text[..at].strip_suffix(b"G").or_else(|| text[..at].strip_suffix(b"g")) else {
            return false;
        };
        let to = text[at + 1..].get(..2).is_some_and(|to| to.eq_ignore_ascii_case(b"TO"));
        to || before.ends_with(b"]") || before.ends_with(b"] ")
    })
}

/// Adds the numbers of blocks that a text may name to those known: what stands after a jump, and in words that name blocks
/// beside some code. `None` if one is computed.
pub(super) fn named_blocks(text: &[u8], dialect: &Dialect, mut all: BTreeSet<u32>) -> Option<BTreeSet<u32>> {
    let letters: BTreeSet<u8> = dialect.code.iter().flat_map(|row| row.blocks.bytes()).collect();
    // Most lines have none of the letters that may name a block.
    let mut names = [false; 256];
    for letter in letters.iter().copied().chain([b'O']) {
        names[usize::from(letter.to_ascii_uppercase())] = true;
        names[usize::from(letter.to_ascii_lowercase())] = true;
    }
    let number = dialect.block.number.map_or(0, |c| c as u8);
    let blanks = |text: &[u8]| text.iter().take_while(|b| b.is_ascii_whitespace()).count();
    for line in text.split(|b| *b == b'\n') {
        if !line.iter().any(|b| names[usize::from(*b)]) {
            continue;
        }
        let calls = line.iter().any(|b| b.eq_ignore_ascii_case(&b'M'));
        for at in 0..line.len() {
            let rest = &line[at..];
            let jump = rest.get(..2).is_some_and(|word| word.eq_ignore_ascii_case(b"GO"));
            let long = rest.get(2..4).is_some_and(|word| word.eq_ignore_ascii_case(b"TO"));
            let word = letters.contains(&rest[0].to_ascii_uppercase());
            let behind = match (jump, long) {
                (true, true) => &rest[4..],
                (true, false) => &rest[2..],
                (false, _) if word => &rest[1..],
                (false, _) => continue,
            };
            let behind = &behind[blanks(behind)..];
            let named = behind.first().filter(|b| jump && b.eq_ignore_ascii_case(&number));
            let behind = if named.is_some() { &behind[1 + blanks(&behind[1..])..] } else { behind };
            let digits = behind.iter().take_while(|b| b.is_ascii_digit()).count();
            match behind.first() {
                Some(b'#' | b'[') if jump || calls => return None,
                Some(_) if digits > 0 => {
                    let number =
                        std::str::from_utf8(&behind[..digits]).ok().and_then(|text| text.parse().ok());
                    all.extend::<Option<u32>>(number);
                }
                Some(_) | None => {}
            }
        }
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn words_that_jump() {
        for text in ["GOTO10", "goto 10", "IF[#1EQ2]GO10", "IF[#1EQ2] go 10", "X1\nGoTo"] {
            assert!(has_jumps(text.as_bytes()), "{text}");
        }
        for text in ["GO10", "X1O2", "O1000", "(LOGO)", "] G O", "TO", "", "G", "O"] {
            assert!(!has_jumps(text.as_bytes()), "{text}");
        }
    }

    proptest! {
        /// As it is stated: each place of the text is looked at for each of the words.
        #[test]
        fn it_is_found_wherever_it_stands(text in "[GOTOgoto \\]1]{0,12}") {
            let has = |word: &str| text.to_ascii_uppercase().contains(word);
            prop_assert_eq!(has_jumps(text.as_bytes()), has("GOTO") || has("]GO") || has("] GO"));
        }
    }
}
