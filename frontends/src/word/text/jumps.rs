//! Jumps and block numbers of a text, by its tokens and the `blocks` of its codes alone: for somebody who
//! looks where a program that is not translated can go. Not here: what any block means otherwise.

use ncc_dialects::{Dialect, Meaning, Settings};
use ncc_ir::source::Span;

use super::token::{FlowWord, Signs, Token, Tokens};
use crate::common::words::{Digits, tenths};
use crate::outline::Flow;

/// Tells every program, block and jump of a text.
pub(crate) fn jumps(settings: &Settings, text: &[u8], found: &mut dyn FnMut(Flow)) {
    let program = &settings.dialect.program;
    let signs = Signs::new(settings.dialect);
    let (frame, ignored) = (program.frame.as_bytes(), program.ignored.as_bytes());
    let mut comments = Vec::new();
    let mut base = 0u32;
    for line in text.split_inclusive(|b| *b == b'\n') {
        let start = base;
        base += line.len() as u32;
        let line = line.trim_ascii_end();
        if line.is_empty()
            || (!ignored.is_empty() && line.starts_with(ignored))
            || (!frame.is_empty() && line.starts_with(frame))
        {
            continue;
        }
        let mut from = 0;
        loop {
            comments.clear();
            let mut tokens = Tokens::new(line, from, signs, &mut comments);
            block(&mut tokens, start, settings.dialect, signs.number, found);
            match tokens.next_block() {
                Some(at) => from = at,
                None => break,
            }
        }
    }
}

fn block(tokens: &mut Tokens, base: u32, dialect: &Dialect, block_number: u8, found: &mut dyn FnMut(Flow)) {
    let (number, number_also) = (dialect.program.number, dialect.program.number_also);
    let span = |start: usize, end: usize| Span::new(base + start as u32, base + end as u32);
    let mut whole: Option<Span> = None;
    let mut label: Option<String> = None;
    let (mut says, mut decides, mut frames, mut skipped) = (false, false, false, false);
    let mut before: Option<Token> = None;
    let mut jumps = Vec::new();
    let mut words = Vec::new();
    let mut labelled = false;
    let mut begun = 0;
    for token in tokens.by_ref() {
        // A block that is none says something all the same.
        let Ok((l, token, r)) = token else {
            says = true;
            break;
        };
        let at = whole.map_or(span(l, r), |whole| Span::new(whole.start, base + r as u32));
        let first = whole.replace(at).is_none();
        if let Some(Token::Letter(letter)) = before {
            let digits = if let Token::Number(digits) = token { Some(digits) } else { None };
            words.push((letter, digits, span(begun, r)));
        }
        begun = l;
        match (before, token) {
            (Some(Token::Letter(letter)), Token::Number(digits))
                if letter == block_number && label.is_none() =>
            {
                label = Some(format!("{}{}", letter as char, digits.mantissa));
                says = false;
            }
            (Some(Token::Goto), Token::Number(digits)) => {
                jumps.push((Some(format!("{}{}", block_number as char, digits.mantissa)), at));
            }
            (Some(Token::Goto), _) => jumps.push((None, at)),
            (_, Token::Label) => labelled = true,
            (Some(_), Token::Flow(word)) if labelled => {
                labelled = false;
                frames = true;
                if word == FlowWord::Sub {
                    found(Flow::Program);
                }
            }
            (Some(Token::Label), Token::Number(_) | Token::Name) => {}
            (_, Token::If) => decides = true,
            (_, Token::Do | Token::End | Token::While) => frames = true,
            (_, Token::Skip) => skipped = true,
            (_, Token::Letter(letter)) if first && number == Some(letter as char) => found(Flow::Program),
            (_, Token::Name) if first && dialect.program.names => found(Flow::Program),
            (_, Token::Colon) if first && number_also == Some(':') => found(Flow::Program),
            _ => says = true,
        }
        before = Some(token);
    }
    let Some(at) = whole else { return };
    if labelled {
        found(Flow::Program);
    }
    let says = says || decides || frames || !jumps.is_empty();
    found(Flow::Block { label, at, says, frames });
    for (to, at) in jumps {
        found(Flow::Jump { to, at, always: !decides && !skipped, quiet: false });
    }
    named(dialect, block_number, &words, found);
}

/// Blocks that words of a code name. Nothing says that the control goes there for good; where a return goes
/// is the caller's matter.
fn named(
    dialect: &Dialect,
    block_number: u8,
    words: &[(u8, Option<Digits>, Span)],
    found: &mut dyn FnMut(Flow),
) {
    for (letter, digits, _) in words.iter().filter(|word| matches!(word.0, b'G' | b'M')) {
        let row = digits.and_then(tenths).and_then(|tenths| dialect.code_row(*letter, tenths));
        let Some(row) = row else { continue };
        let quiet = row.means == Some(Meaning::Return) && !dialect.program.returns_within;
        for (_, digits, at) in words.iter().filter(|word| row.blocks.as_bytes().contains(&word.0)) {
            let to = digits.map(|digits| format!("{}{}", block_number as char, digits.mantissa));
            found(Flow::Jump { to, at: *at, always: false, quiet });
        }
    }
}
