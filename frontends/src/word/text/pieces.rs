//! Splits a line of a word dialect into pieces, by its tokens alone.
//!
//! `N10 G1 X5 (face)` gives the addresses N, G and X, three numbers and a comment. Not here: their meaning.

use ncc_dialects::Dialect;

use super::token::{Signs, Token, Tokens};
use crate::outline::{LineIs, Piece, PieceKind};

/// No dialect has a block with more than this number of letters without a number in a row: such a line is plain text.
const WORDS_OF_A_TEXT: usize = 5;

/// Splits a line into pieces, sorted by their start. [`LineIs::Unread`] if a block has an unknown token.
pub(crate) fn pieces(dialect: &Dialect, line: &[u8], into: &mut Vec<Piece>) -> LineIs {
    let line = line.trim_ascii_end();
    let signs = Signs::new(dialect);
    let (open, close) = (dialect.comment.open.trim_end().len().min(1), dialect.comment.close.len().min(1));
    let mut comments = Vec::new();
    let mut from = 0;
    loop {
        comments.clear();
        let mut tokens = Tokens::new(line, from, signs, &mut comments);
        if !block(&mut tokens, dialect, into) {
            return LineIs::Unread;
        }
        let next = tokens.next_block();
        // The end sign of a block comes before the next block, or before a comment that fills the line.
        let last = into.last().map_or(from, |piece| piece.end.max(from));
        let end = next.unwrap_or(line.len());
        let sign = dialect.block.end.as_bytes().first();
        let comment = |start: usize, end: usize| Piece {
            kind: PieceKind::Comment,
            start: start.saturating_sub(open),
            end: end + close,
            depth: 0,
        };
        into.extend(comments.iter().map(|&(start, end)| comment(start, end)));
        into.sort_by_key(|piece| piece.start);
        let mut at = last.max(comments.iter().filter(|c| c.1 < end).map(|c| c.1 + close).max().unwrap_or(0));
        while at < end && matches!(line[at], b' ' | b'\t') {
            at += 1;
        }
        if at < end && Some(&line[at]) == sign {
            into.push(Piece { kind: PieceKind::End, start: at, end: at + 1, depth: 0 });
            into.sort_by_key(|piece| piece.start);
        }
        match next {
            Some(at) => from = at,
            None => return LineIs::Blocks,
        }
    }
}

/// Appends the tokens of one block to `into`; `false` if the text is not a block.
fn block(tokens: &mut Tokens, dialect: &Dialect, into: &mut Vec<Piece>) -> bool {
    let mut depth = 0u32;
    let mut bare = 0;
    for token in tokens.by_ref() {
        let Ok((start, token, end)) = token else { return false };
        let kind = match token {
            Token::Letter(_) => PieceKind::Address,
            Token::Number(_) => PieceKind::Number,
            Token::Skip => PieceKind::Skip,
            Token::Name | Token::System | Token::Print => PieceKind::Kept,
            Token::If
            | Token::While
            | Token::Then
            | Token::Goto
            | Token::Do
            | Token::End
            | Token::Function(_)
            | Token::Atan
            | Token::Pow
            | Token::Compare(_)
            | Token::Or(_)
            | Token::And(_)
            | Token::Logic(_)
            | Token::Modulo
            | Token::Exists
            | Token::Flow(_) => PieceKind::Key,
            Token::Label => PieceKind::Address,
            Token::Plus
            | Token::Minus
            | Token::Star
            | Token::Slash
            | Token::Hash
            | Token::Equals
            | Token::Comma
            | Token::Colon
            | Token::Open
            | Token::Power
            | Token::Close => PieceKind::Sign,
        };
        let kind = if kind == PieceKind::Address && depth > 0 { PieceKind::Letter } else { kind };
        if kind == PieceKind::Address {
            bare += 1;
            // Plain text is a row of letters without numbers.
            if bare > WORDS_OF_A_TEXT || (bare > 2 && !dialect.block.omitted_zero) {
                return false;
            }
        } else {
            bare = 0;
        }
        depth = depth.saturating_sub(u32::from(token == Token::Close));
        into.push(Piece { kind, start, end, depth });
        depth += u32::from(token == Token::Open);
    }
    true
}
