//! Tokens of a block: a logos lexer over the bytes of one line, and the little that depends on
//! where a token stands.
//!
//! **How words are distinguished.** Only the bytes decide, never what a name means:
//! - two letters or underscores begin a *name*, which takes all letters, digits and underscores
//!   that follow: `CYCLE81`, `CR`, `N_A`, `GOTOF`. Some names are key words;
//! - any other letter is an *address letter*: `N10G1X10Y20F100` is five words, `L010`, `R1`, `X1`
//!   are a letter and a number. A sign `=` after the number makes the number the address's
//!   extension (`X1=10`, `S2=500`): that is the grammar's business;
//! - `N` before a number is a block number (or the target of a jump);
//! - a number takes `EX` and an exponent: `1EX5`; `E` alone is an address;
//! - a name with an underscore first does not follow a digit directly: `G505_VAR` is neither.
//!
//! Where the place matters: a slash that comes first is a skip mark and takes the digit that
//! follows it directly; `WHEN`, `WHENEVER`, `FROM`, `EVERY`, `DO`, `ID=` and `REDEF` take the rest
//! of the block, `AS` as well, and `PCALL` takes its path.
//!
//! `&` reads as a blank. The comment is set aside. Not here: the order of words.

use logos::Logos;
use ncc_ir::diag::Fault;
use ncc_ir::source::Span;
use ncc_ir::syntax::Found;

use super::tree::{Binary, Direction, Qualifier, TypeName, Unary};
use crate::common::text::first_char;
use crate::common::words::Digits;

/// A token as the bytes alone show it.
#[derive(Clone, Copy, Debug, Logos, PartialEq)]
#[logos(utf8 = false, skip r"[ \t&]+")]
enum Raw {
    #[regex("[A-Za-z]")]
    Letter,
    #[regex("[A-Za-z_][A-Za-z_][A-Za-z0-9_]*")]
    Name,
    #[regex(r"\$[A-Za-z_][A-Za-z0-9_]*")]
    System,
    #[regex(r"([0-9]+\.?[0-9]*|\.[0-9]+)([Ee][Xx][+-]?[0-9]+)?")]
    Number,
    #[regex(r"'(?-u:[^'])*'")]
    Quoted,
    #[regex(r#""((?-u:[^"])|"")*""#)]
    Text,
    #[regex(r"[-+*/=,:()\[\]<>;]|<<|==|<>|<=|>=")]
    Sign,
}

/// A token as the grammar takes it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // The names are the meaning.
pub(crate) enum Token {
    /// A capital.
    Letter(u8),
    /// `N` before a number.
    BlockNumber,
    Number(Digits),
    Bits(i64),
    Character,
    Text,
    Name,
    System,
    /// With its level as written.
    Skip(u8),
    Plus,
    Minus,
    /// `* / DIV MOD`
    Times(Binary),
    BitAnd,
    BitXor,
    BitOr,
    And,
    Xor,
    Or,
    Join,
    Compare(Binary),
    /// `NOT B_NOT`
    Not(Unary),
    Equals,
    Comma,
    Colon,
    Open,
    Close,
    OpenIndex,
    CloseIndex,
    Qualifier(Qualifier),
    Type(TypeName),
    If,
    Else,
    EndIf,
    Loop,
    EndLoop,
    For,
    To,
    EndFor,
    While,
    EndWhile,
    Repeat,
    RepeatBlock,
    Until,
    Case,
    Of,
    Default,
    Goto(Direction),
    GotoStart,
    Call,
    Block,
    /// With its path.
    CallByPath(Span),
    CallExternal,
    CallIso,
    CallModal,
    Def,
    Extern,
    Proc,
    Var,
    Define,
    /// With the macro's text.
    As(Span),
    Synchronous,
    Redefine,
}

/// Why there is no block.
#[derive(Clone, Debug)]
pub(crate) struct Refusal {
    pub(crate) fault: Fault,
    pub(crate) span: Span,
}

/// Most tokens of a block: no expression is deeper than that.
const MOST: usize = 1000;

/// The tokens of one line.
pub(crate) struct Tokens<'t> {
    raw: logos::Lexer<'t, Raw>,
    /// Place of the line's first byte in the source.
    base: u32,
    count: usize,
    /// The comment, once it is reached.
    pub(in crate::siemens) comment: Option<Span>,
}

type Lexed = Result<(u32, Token, u32), Refusal>;

impl<'t> Tokens<'t> {
    /// The tokens of a line without its end.
    pub(in crate::siemens) fn new(line: &'t [u8], base: u32) -> Tokens<'t> {
        Tokens { raw: Raw::lexer(line), base, count: 0, comment: None }
    }

    fn place(&self, start: usize, end: usize) -> Span {
        Span::new(self.base + start as u32, self.base + end as u32)
    }

    fn here(&self) -> Span {
        let span = self.raw.span();
        self.place(span.start, span.end)
    }

    fn lexed(&self, token: Token) -> Lexed {
        let span = self.here();
        Ok((span.start, token, span.end))
    }

    fn refuse(&self, fault: Fault) -> Lexed {
        Err(Refusal { fault, span: self.here() })
    }

    fn text(&self) -> Box<str> {
        String::from_utf8_lossy(self.raw.slice()).into()
    }

    /// A stretch that is no token. What is open is not closed: that is stated, not the sign.
    fn unexpected(&self) -> Lexed {
        let start = self.raw.span().start;
        let rest = &self.raw.source()[start..];
        if let Some(quote @ (b'"' | b'\'')) = rest.first() {
            let found = Found::Text(String::from_utf8_lossy(rest.trim_ascii_end()).into());
            let fault = Fault::Syntax { found, expected: char::from(*quote).to_string().as_str().into() };
            return Err(Refusal { fault, span: self.place(start, start + rest.trim_ascii_end().len()) });
        }
        let (found, len) = first_char(rest);
        Err(Refusal { fault: Fault::UnexpectedCharacter { found }, span: self.place(start, start + len) })
    }

    /// Bytes up to the comment, without blanks at the end; a semicolon in a text opens none.
    fn rest_of_block(&self) -> usize {
        let rest = self.raw.remainder();
        let mut quoted = false;
        let end = rest.iter().position(|&byte| {
            quoted ^= byte == b'"';
            byte == b';' && !quoted
        });
        rest[..end.unwrap_or(rest.len())].trim_ascii_end().len()
    }

    /// Takes the rest of the block into the token; gives what follows its key word.
    fn swallow(&mut self) -> Span {
        let start = self.raw.span().end;
        let blanks = self.blanks();
        let rest = self.rest_of_block();
        self.raw.bump(rest);
        self.place(start + blanks.min(rest), start + rest)
    }

    fn blanks(&self) -> usize {
        self.raw.remainder().iter().take_while(|b| matches!(b, b' ' | b'\t')).count()
    }

    /// The path after `PCALL`: up to a blank, its arguments or the comment, or in quotes.
    fn path(&mut self) -> Span {
        let blanks = self.blanks();
        let rest = &self.raw.remainder()[blanks..];
        let len = match rest.first() {
            Some(b'"') => memchr::memchr(b'"', &rest[1..]).map_or(rest.len(), |len| len + 2),
            _ => rest.iter().take_while(|b| !matches!(b, b' ' | b'\t' | b'(' | b';')).count(),
        };
        let start = self.raw.span().end + blanks;
        self.raw.bump(blanks + len);
        self.place(start, start + len)
    }

    fn letter(&self, byte: u8) -> Token {
        let next = self.raw.remainder().get(self.blanks());
        match byte.to_ascii_uppercase() {
            b'N' if next.is_some_and(u8::is_ascii_digit) => Token::BlockNumber,
            letter => Token::Letter(letter),
        }
    }

    fn name(&mut self) -> Lexed {
        let start = self.raw.span().start;
        let before = start.checked_sub(1).map(|at| self.raw.source()[at]);
        if self.raw.slice()[0] == b'_' && before.is_some_and(|b| b.is_ascii_digit()) {
            return self.unexpected();
        }
        let token = match keyword(self.raw.slice()) {
            None => {
                let numbered = self.raw.slice().eq_ignore_ascii_case(b"ID")
                    || self.raw.slice().eq_ignore_ascii_case(b"IDS");
                let next = self.raw.remainder().get(self.blanks()..).unwrap_or_default();
                if numbered && next.starts_with(b"=") && !next.starts_with(b"==") {
                    self.swallow();
                    Token::Synchronous
                } else {
                    Token::Name
                }
            }
            Some(token @ (Token::Synchronous | Token::Redefine)) => {
                self.swallow();
                token
            }
            Some(Token::As(_)) => Token::As(self.swallow()),
            Some(Token::CallByPath(_)) => Token::CallByPath(self.path()),
            Some(token) => token,
        };
        self.lexed(token)
    }

    /// The skip mark with the digit that follows it directly.
    fn skip(&mut self) -> Lexed {
        let digits = self.raw.remainder().iter().take_while(|b| b.is_ascii_digit()).count();
        let level = self.raw.remainder().first().filter(|_| digits == 1).map_or(0, |b| b - b'0');
        self.raw.bump(digits);
        match digits {
            0 | 1 => self.lexed(Token::Skip(level)),
            _ => self.refuse(Fault::OutOfRange { word: self.text().into() }),
        }
    }

    /// A constant in single quotes.
    fn quoted(&self) -> Lexed {
        let slice = self.raw.slice();
        let inner = &slice[1..slice.len() - 1];
        let radix = match inner.first().map(u8::to_ascii_uppercase) {
            Some(b'H') if inner.len() > 1 => 16,
            Some(b'B') if inner.len() > 1 => 2,
            _ if first_char(inner).1 == inner.len() => return self.lexed(Token::Character),
            _ => return self.refuse(Fault::BadNumber { text: self.text() }),
        };
        let digits = std::str::from_utf8(&inner[1..]).ok().filter(|d| !d.starts_with(['+', '-']));
        match digits.and_then(|d| i64::from_str_radix(d, radix).ok()) {
            Some(bits) => self.lexed(Token::Bits(bits)),
            None => self.refuse(Fault::BadNumber { text: self.text() }),
        }
    }

    fn sign(&self) -> Lexed {
        let token = match self.raw.slice() {
            b"+" => Token::Plus,
            b"-" => Token::Minus,
            b"*" => Token::Times(Binary::Multiply),
            b"/" => Token::Times(Binary::Divide),
            b"=" => Token::Equals,
            b"," => Token::Comma,
            b":" => Token::Colon,
            b"(" => Token::Open,
            b")" => Token::Close,
            b"[" => Token::OpenIndex,
            b"]" => Token::CloseIndex,
            b"<<" => Token::Join,
            b"==" => Token::Compare(Binary::Equal),
            b"<>" => Token::Compare(Binary::NotEqual),
            b"<" => Token::Compare(Binary::Less),
            b"<=" => Token::Compare(Binary::LessOrEqual),
            b">" => Token::Compare(Binary::Greater),
            b">=" => Token::Compare(Binary::GreaterOrEqual),
            _ => return self.unexpected(),
        };
        self.lexed(token)
    }
}

impl Iterator for Tokens<'_> {
    type Item = Lexed;

    fn next(&mut self) -> Option<Lexed> {
        if self.comment.is_some() {
            return None;
        }
        let raw = self.raw.next()?;
        self.count += 1;
        if self.count > MOST {
            return Some(self.refuse(Fault::BlockTooLong { limit: MOST as u32 }));
        }
        let byte = self.raw.slice().first().copied().unwrap_or(0);
        Some(match raw {
            Ok(Raw::Letter) => self.lexed(self.letter(byte)),
            Ok(Raw::Name) => self.name(),
            Ok(Raw::System) => self.lexed(Token::System),
            Ok(Raw::Number) => match number(self.raw.slice()) {
                Some(digits) => self.lexed(Token::Number(digits)),
                None => self.refuse(Fault::BadNumber { text: self.text() }),
            },
            Ok(Raw::Quoted) => self.quoted(),
            Ok(Raw::Text) => self.lexed(Token::Text),
            Ok(Raw::Sign) if byte == b';' => {
                let start = self.raw.span().end;
                let len = self.raw.remainder().trim_ascii_end().len();
                self.comment = Some(self.place(start, start + len));
                return None;
            }
            Ok(Raw::Sign) if byte == b'/' && self.count == 1 => self.skip(),
            Ok(Raw::Sign) => self.sign(),
            Err(()) => self.unexpected(),
        })
    }
}

/// A number with or without an exponent; `None` for more than 18 digits that count. With an
/// exponent it counts as written with a point.
fn number(text: &[u8]) -> Option<Digits> {
    let Some(at) = text.iter().position(|b| b.eq_ignore_ascii_case(&b'E')) else {
        return Digits::parse(text);
    };
    let mut digits = Digits { point: true, ..Digits::parse(&text[..at])? };
    let mut exponent: i32 = std::str::from_utf8(&text[at + 2..]).ok()?.parse().ok()?;
    if digits.mantissa == 0 {
        return Some(Digits { scale: 0, ..digits });
    }
    while exponent > 0 {
        match digits.scale {
            0 => digits.mantissa = digits.mantissa.checked_mul(10).filter(|m| *m < 10i64.pow(18))?,
            _ => digits.scale -= 1,
        }
        exponent -= 1;
    }
    while exponent < 0 {
        match digits.mantissa % 10 {
            0 => digits.mantissa /= 10,
            _ if digits.scale < 18 => digits.scale += 1,
            _ => return None,
        }
        exponent += 1;
    }
    Some(digits)
}

/// The longest key word.
const LONGEST: usize = 8;

/// Whether a name is a key word of the language with names, in any size of letters: of a structure, a jump, a call, a
/// definition or an operator.
#[must_use]
pub fn is_key_word(name: &[u8]) -> bool {
    keyword(name).is_some()
}

/// The token of a key word. What the grammar gives to `As` and `CallByPath` is still missing.
fn keyword(name: &[u8]) -> Option<Token> {
    let mut capitals = [0u8; LONGEST];
    let capitals = capitals.get_mut(..name.len())?;
    capitals.copy_from_slice(name);
    capitals.make_ascii_uppercase();
    Some(match &*capitals {
        b"IF" => Token::If,
        b"ELSE" => Token::Else,
        b"ENDIF" => Token::EndIf,
        b"LOOP" => Token::Loop,
        b"ENDLOOP" => Token::EndLoop,
        b"FOR" => Token::For,
        b"TO" => Token::To,
        b"ENDFOR" => Token::EndFor,
        b"WHILE" => Token::While,
        b"ENDWHILE" => Token::EndWhile,
        b"REPEAT" => Token::Repeat,
        b"REPEATB" => Token::RepeatBlock,
        b"UNTIL" => Token::Until,
        b"CASE" => Token::Case,
        b"OF" => Token::Of,
        b"DEFAULT" => Token::Default,
        b"GOTO" => Token::Goto(Direction::Both),
        b"GOTOC" => Token::Goto(Direction::BothQuietly),
        b"GOTOF" => Token::Goto(Direction::Forward),
        b"GOTOB" => Token::Goto(Direction::Backward),
        b"GOTOS" => Token::GotoStart,
        b"CALL" => Token::Call,
        b"BLOCK" => Token::Block,
        b"PCALL" => Token::CallByPath(Span::default()),
        b"EXTCALL" => Token::CallExternal,
        b"ISOCALL" => Token::CallIso,
        b"MCALL" => Token::CallModal,
        b"DEF" => Token::Def,
        b"EXTERN" => Token::Extern,
        b"PROC" => Token::Proc,
        b"VAR" => Token::Var,
        b"DEFINE" => Token::Define,
        b"AS" => Token::As(Span::default()),
        b"REAL" => Token::Type(TypeName::Real),
        b"INT" => Token::Type(TypeName::Int),
        b"BOOL" => Token::Type(TypeName::Bool),
        b"CHAR" => Token::Type(TypeName::Char),
        b"STRING" => Token::Type(TypeName::String),
        b"AXIS" => Token::Type(TypeName::Axis),
        b"FRAME" => Token::Type(TypeName::Frame),
        b"DIV" => Token::Times(Binary::IntegerDivide),
        b"MOD" => Token::Times(Binary::Modulo),
        b"NOT" => Token::Not(Unary::Not),
        b"B_NOT" => Token::Not(Unary::BitNot),
        b"B_AND" => Token::BitAnd,
        b"B_XOR" => Token::BitXor,
        b"B_OR" => Token::BitOr,
        b"AND" => Token::And,
        b"XOR" => Token::Xor,
        b"OR" => Token::Or,
        b"AC" => Token::Qualifier(Qualifier::Absolute),
        b"IC" => Token::Qualifier(Qualifier::Incremental),
        b"DC" => Token::Qualifier(Qualifier::Direct),
        b"ACP" => Token::Qualifier(Qualifier::Positive),
        b"ACN" => Token::Qualifier(Qualifier::Negative),
        b"CAC" | b"CIC" | b"CDC" | b"CACP" | b"CACN" => Token::Qualifier(Qualifier::Coded),
        b"QU" => Token::Qualifier(Qualifier::Quick),
        b"WHEN" | b"WHENEVER" | b"FROM" | b"EVERY" | b"DO" => Token::Synchronous,
        b"REDEF" => Token::Redefine,
        _ => return None,
    })
}
