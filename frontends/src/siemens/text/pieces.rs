//! The pieces of a line, by its tokens alone. Not here: what they mean.

use super::token::{Token, Tokens};
use super::unit::{self, Kind, Line};
use crate::outline::{LineIs, Piece, PieceKind};

/// Takes a line without its end apart; `outside` is whether it stands in a unit that is no program.
pub(crate) fn line(line: &[u8], outside: &mut bool, into: &mut Vec<Piece>) -> LineIs {
    match unit::line(line, 0) {
        Ok(Line::Header(header)) => {
            *outside = header.kind == Kind::Other;
            LineIs::Frame
        }
        Ok(Line::Path(_) | Line::Mark) => LineIs::Frame,
        Ok(Line::Block) if *outside => LineIs::Outside,
        Ok(Line::Block) => block(line.trim_ascii_end(), into),
        Err(_) => LineIs::Unread,
    }
}

fn block(line: &[u8], into: &mut Vec<Piece>) -> LineIs {
    let mut tokens = Tokens::new(line, 0);
    let mut depth = 0u32;
    for token in tokens.by_ref() {
        let Ok((start, token, end)) = token else { return LineIs::Unread };
        let (start, end) = (start as usize, end as usize);
        let before = into.last().map(|piece| (piece.kind, piece.text(line)));
        let kind = match token {
            Token::BlockNumber => PieceKind::Address,
            Token::Letter(_) if depth == 0 && begins_word(before) => PieceKind::Address,
            Token::Letter(_) => PieceKind::Letter,
            Token::Number(_) => PieceKind::Number,
            Token::Bits(_) | Token::Character | Token::Text => PieceKind::Kept,
            // Paths and texts of macros belong to what they follow; their key words do not matter.
            Token::CallByPath(_) | Token::As(_) | Token::Synchronous | Token::Redefine => PieceKind::Kept,
            Token::Name | Token::System => PieceKind::Name,
            Token::Skip(_) => PieceKind::Skip,
            Token::Plus
            | Token::Minus
            | Token::Join
            | Token::Compare(_)
            | Token::Equals
            | Token::Comma
            | Token::Colon
            | Token::Open
            | Token::Close
            | Token::OpenIndex
            | Token::CloseIndex => PieceKind::Sign,
            Token::Times(_) if matches!(line.get(start), Some(b'*' | b'/')) => PieceKind::Sign,
            Token::Times(_)
            | Token::BitAnd
            | Token::BitXor
            | Token::BitOr
            | Token::And
            | Token::Xor
            | Token::Or
            | Token::Not(_)
            | Token::Qualifier(_)
            | Token::Type(_)
            | Token::If
            | Token::Else
            | Token::EndIf
            | Token::Loop
            | Token::EndLoop
            | Token::For
            | Token::To
            | Token::EndFor
            | Token::While
            | Token::EndWhile
            | Token::Repeat
            | Token::RepeatBlock
            | Token::Until
            | Token::Case
            | Token::Of
            | Token::Default
            | Token::Goto(_)
            | Token::GotoStart
            | Token::Call
            | Token::Block
            | Token::CallExternal
            | Token::CallIso
            | Token::CallModal
            | Token::Def
            | Token::Extern
            | Token::Proc
            | Token::Var
            | Token::Define => PieceKind::Key,
        };
        let (opens, closes) = match token {
            Token::Open | Token::OpenIndex => (1, 0),
            Token::Close | Token::CloseIndex => (0, 1),
            _ => (0, 0),
        };
        depth = depth.saturating_sub(closes);
        into.push(Piece { kind, start, end, depth });
        depth += opens;
    }
    if let Some(comment) = tokens.comment {
        let start = (comment.start as usize).saturating_sub(1);
        into.push(Piece { kind: PieceKind::Comment, start, end: comment.end as usize, depth: 0 });
    }
    LineIs::Blocks
}

/// Whether a letter outside of brackets begins a word after this: not as an operand, which follows an
/// operator, an assignment or a word of the language. A colon ends a label; where it chains frames, no
/// sum follows.
fn begins_word(before: Option<(PieceKind, &[u8])>) -> bool {
    match before {
        None => true,
        Some((PieceKind::Number | PieceKind::Name | PieceKind::Skip, _)) => true,
        Some((PieceKind::Sign, text)) => matches!(text, b")" | b"]" | b":"),
        Some((
            PieceKind::Address
            | PieceKind::Letter
            | PieceKind::Key
            | PieceKind::Kept
            | PieceKind::Comment
            | PieceKind::End,
            _,
        )) => false,
    }
}
