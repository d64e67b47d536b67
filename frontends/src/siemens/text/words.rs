//! Words of a line, by its tokens alone: for somebody who asks which rows of the dictionary stand after
//! it. Not here: what the words mean together.

use super::token::{Token, Tokens};
use super::unit::{self, Line};
use crate::common::plain_words::{MOST, PlainWord, plain_words};
use crate::common::words::tenths;
use crate::outline::Word;

/// Tells the words of a line, with or without its end.
pub(crate) fn words(line: &[u8], found: &mut dyn FnMut(Word)) {
    let line = line.trim_ascii_end();
    if !matches!(unit::line(line, 0), Ok(Line::Block)) {
        return;
    }
    let mut plain = [PlainWord::default(); MOST];
    if let Some(words) = plain_words(line, &mut plain) {
        // The number of a block is no word.
        let words = words.iter().filter(|word| word.letter != b'N' || word.negative);
        return words.for_each(|word| found(word.to_word(line)));
    }
    let mut letter: Option<u8> = None;
    for token in Tokens::new(line, 0) {
        let Ok((start, token, end)) = token else { break };
        match token {
            Token::Letter(next) => {
                if let Some(before) = letter.replace(next) {
                    found(Word::Letter(before));
                }
                continue;
            }
            Token::Number(digits) => {
                if let Some(letter) = letter.take() {
                    found(Word::Numbered { letter, tenths: tenths(digits) });
                }
                continue;
            }
            // Between a letter and its number.
            Token::Plus | Token::Minus | Token::Equals => continue,
            _ => {}
        }
        if let Some(letter) = letter.take() {
            found(Word::Letter(letter));
        }
        let text = line.get(start as usize..end as usize).unwrap_or_default();
        // Key words that take what follows them into their token stand for themselves.
        let name = text.iter().take_while(|b| b.is_ascii_alphanumeric() || **b == b'_').count();
        if text.first().is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_') && name > 1 {
            found(Word::Name(&text[..name]));
        }
    }
    if let Some(letter) = letter {
        found(Word::Letter(letter));
    }
}
