//! Words of a line, by its tokens alone: for somebody who asks which rows of the dictionary stand after
//! it. Not here: what the words mean together.

use ncc_dialects::Dialect;

use super::token::{Signs, Token, Tokens};
use crate::common::plain_words::{MOST, PlainWord, plain_words};
use crate::common::words::tenths;
use crate::outline::Word;

/// Tells the words of a line, with or without its end.
pub(crate) fn words(dialect: &Dialect, line: &[u8], found: &mut dyn FnMut(Word)) {
    let line = line.trim_ascii_end();
    let frame = dialect.program.frame.as_bytes();
    let ignored = dialect.program.ignored.as_bytes();
    if !ignored.is_empty() && line.starts_with(ignored) || !frame.is_empty() && line.starts_with(frame) {
        return;
    }
    let mut plain = [PlainWord::default(); MOST];
    let program = dialect.program.number.map_or(0, |letter| letter as u8);
    if let Some(words) = plain_words(line, &mut plain)
        && words.iter().all(|word| word.letter != program)
    {
        return words.iter().for_each(|word| found(word.to_word(line)));
    }
    let signs = Signs::new(dialect);
    let mut comments = Vec::new();
    let mut from = 0;
    loop {
        comments.clear();
        let mut tokens = Tokens::new(line, from, signs, &mut comments);
        block(&mut tokens, found);
        match tokens.next_block() {
            Some(at) => from = at,
            None => return,
        }
    }
}

fn block(tokens: &mut Tokens, found: &mut dyn FnMut(Word)) {
    let mut letter: Option<u8> = None;
    for token in tokens.by_ref() {
        let Ok((_, token, _)) = token else { break };
        match token {
            Token::Letter(next) => {
                if let Some(before) = letter.replace(next) {
                    found(Word::Letter(before));
                }
            }
            Token::Number(digits) => {
                if let Some(letter) = letter.take() {
                    found(Word::Numbered { letter, tenths: tenths(digits) });
                }
            }
            // A sign between a letter and its number.
            Token::Plus | Token::Minus => {}
            _ => {
                if let Some(letter) = letter.take() {
                    found(Word::Letter(letter));
                }
            }
        }
    }
    if let Some(letter) = letter {
        found(Word::Letter(letter));
    }
}
