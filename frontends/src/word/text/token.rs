//! Tokens of a block: a logos lexer over bytes, and the reading of its tokens that depends on the
//! dictionary (what opens a comment, what ends a block, whether the control has variables).
//!
//! Comments may stand between any two tokens; they are set aside here, so that the grammar does
//! not meet them. Not here: what words mean, and the lines of a program.

use logos::Logos;
use ncc_dialects::Dialect;
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Binary, Function};
use ncc_ir::unsupported::FlowUnsupported;

use super::device_text;
use crate::common::text::{begins, first_char};
use crate::common::words::Digits;

/// What of the dictionary the lexer needs.
#[derive(Clone, Copy, Debug)]
pub(in crate::word) struct Signs {
    /// First byte of a comment; 0 for none.
    comment: u8,
    /// Last byte of a comment; 0 if the line's end closes it.
    close: u8,
    /// After it the rest of the line is a comment; 0 for none.
    line: u8,
    /// Ends a block before the line's end; 0 for none.
    end: u8,
    /// Marks what is under block skip; 0 for none.
    skip: u8,
    /// Letter of the block number; 0 for none.
    pub(in crate::word) number: u8,
    /// Letter of programs; 0 for none.
    program: u8,
    /// Signs that stand for the letters of radius and angle; 0 for none.
    polar: [u8; 2],
    /// Whether the control has variables and expressions.
    macros: bool,
    /// Whether what they mean is known; else they are refused.
    pub(in crate::word) computes: bool,
    /// Whether they are those of O words.
    pub(in crate::word) o_words: bool,
}

impl Signs {
    pub(in crate::word) fn new(dialect: &Dialect) -> Signs {
        let first = |text: &str| text.bytes().next().unwrap_or(0);
        Signs {
            comment: first(&dialect.comment.open),
            close: first(&dialect.comment.close),
            line: first(&dialect.comment.line),
            end: first(&dialect.block.end),
            skip: first(&dialect.block.skip),
            number: dialect.block.number.map_or(0, |c| c as u8),
            program: dialect.program.number.map_or(0, |c| c as u8),
            polar: dialect.polar.signs().unwrap_or_default(),
            macros: dialect.program.macros,
            computes: dialect.program.macro_b || dialect.program.o_words,
            o_words: dialect.program.o_words,
        }
    }
}

/// A token as the bytes alone show it.
#[derive(Clone, Copy, Debug, Logos, PartialEq)]
#[logos(utf8 = false, skip r"[ \t]+")]
enum Raw {
    #[regex("[A-Za-z]")]
    Letter,
    #[regex("[@^]")]
    PolarSign,
    #[regex(r"[0-9]+\.?[0-9]*|\.[0-9]+")]
    Number,
    #[regex(r"[-+*/#=,:;()\[\]<]")]
    Sign,
    #[regex(r"_[A-Za-z0-9_]+")]
    System,
    #[token("**")]
    Power,
}

/// A token as the grammar takes it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // The names are the meaning.
pub(crate) enum Token {
    Letter(u8),
    Number(Digits),
    Plus,
    Minus,
    Star,
    Slash,
    Skip,
    Hash,
    Equals,
    Comma,
    Colon,
    Open,
    Close,
    /// A program's name, `<...>`.
    Name,
    /// The name of a system variable, `_DATE`.
    System,
    If,
    While,
    Then,
    Goto,
    Do,
    End,
    /// Output of text and setting of names: the rest of the block.
    Print,
    /// A function; `None` is one that is refused.
    Function(Option<Function>),
    /// The function of two arguments with a division sign between them.
    Atan,
    /// A power, of two arguments.
    Pow,
    Compare(Binary),
    /// OR and XOR.
    Or(Binary),
    /// AND and MOD.
    And(Binary),
    Power,
    /// AND, OR and XOR, where all three bind least.
    Logic(Binary),
    Modulo,
    /// Whether a parameter exists.
    Exists,
    /// The letter of a block that decides where the program goes, or begins a program.
    Label,
    /// What such a block does.
    Flow(FlowWord),
}

/// What a block does that begins with the letter of programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // The names are the meaning.
pub(crate) enum FlowWord {
    Sub,
    EndSub,
    Call,
    Return,
    If,
    ElseIf,
    Else,
    EndIf,
    Do,
    While,
    EndWhile,
    Repeat,
    EndRepeat,
    Break,
    Continue,
}

/// Why there is no block.
#[derive(Clone, Debug)]
pub(crate) struct Refusal {
    pub(crate) fault: Fault,
    pub(crate) start: usize,
    pub(crate) end: usize,
}

/// Words of the macro language that stand where a statement does, longest first.
const STATEMENTS: &[(&[u8], Token)] = &[
    (b"WHILE", Token::While),
    (b"THEN", Token::Then),
    (b"GOTO", Token::Goto),
    (b"POPEN", Token::Print),
    (b"PCLOS", Token::Print),
    (b"DPRNT", Token::Print),
    (b"BPRNT", Token::Print),
    (b"SETVN", Token::Print),
    (b"IF", Token::If),
    (b"END", Token::End),
    // Two letters are enough.
    (b"WH", Token::While),
    (b"TH", Token::Then),
    (b"GO", Token::Goto),
    (b"EN", Token::End),
    (b"DO", Token::Do),
];

/// Words of the macro language that stand in expressions, longest first.
const OPERATORS: &[(&[u8], Token)] = &[
    (b"ROUND", Token::Function(Some(Function::Round))),
    (b"ASIN", Token::Function(Some(Function::Asin))),
    (b"ACOS", Token::Function(Some(Function::Acos))),
    (b"ATAN", Token::Atan),
    (b"SQRT", Token::Function(Some(Function::Sqrt))),
    (b"SIN", Token::Function(Some(Function::Sin))),
    (b"COS", Token::Function(Some(Function::Cos))),
    (b"TAN", Token::Function(Some(Function::Tan))),
    (b"ABS", Token::Function(Some(Function::Abs))),
    (b"FIX", Token::Function(Some(Function::Truncate))),
    (b"FUP", Token::Function(Some(Function::RoundUp))),
    (b"EXISTS", Token::Function(None)),
    (b"EXP", Token::Function(Some(Function::Exp))),
    (b"POW", Token::Pow),
    (b"BIN", Token::Function(None)),
    (b"BCD", Token::Function(None)),
    (b"ADP", Token::Function(None)),
    (b"PRM", Token::Function(None)),
    (b"LN", Token::Function(Some(Function::Ln))),
    (b"XOR", Token::Or(Binary::Xor)),
    (b"OR", Token::Or(Binary::Or)),
    (b"AND", Token::And(Binary::And)),
    (b"MOD", Token::And(Binary::Modulo)),
    (b"EQ", Token::Compare(Binary::Equal)),
    (b"NE", Token::Compare(Binary::NotEqual)),
    (b"GT", Token::Compare(Binary::Greater)),
    (b"GE", Token::Compare(Binary::GreaterOrEqual)),
    (b"LT", Token::Compare(Binary::Less)),
    (b"LE", Token::Compare(Binary::LessOrEqual)),
    // Two letters are enough (B-63684EN, custom macro, codes and reserved words: abbreviations).
    (b"RO", Token::Function(Some(Function::Round))),
    (b"AS", Token::Function(Some(Function::Asin))),
    (b"AC", Token::Function(Some(Function::Acos))),
    (b"AT", Token::Atan),
    (b"SQ", Token::Function(Some(Function::Sqrt))),
    (b"SI", Token::Function(Some(Function::Sin))),
    (b"CO", Token::Function(Some(Function::Cos))),
    (b"TA", Token::Function(Some(Function::Tan))),
    (b"AB", Token::Function(Some(Function::Abs))),
    (b"FI", Token::Function(Some(Function::Truncate))),
    (b"FU", Token::Function(Some(Function::RoundUp))),
    (b"EX", Token::Function(Some(Function::Exp))),
    (b"XO", Token::Or(Binary::Xor)),
    (b"AN", Token::And(Binary::And)),
];

/// What stands after the name of a block that begins with the letter of programs, longest first.
const FLOW: &[(&[u8], Token)] = &[
    (b"ENDREPEAT", Token::Flow(FlowWord::EndRepeat)),
    (b"ENDWHILE", Token::Flow(FlowWord::EndWhile)),
    (b"CONTINUE", Token::Flow(FlowWord::Continue)),
    (b"ENDSUB", Token::Flow(FlowWord::EndSub)),
    (b"RETURN", Token::Flow(FlowWord::Return)),
    (b"REPEAT", Token::Flow(FlowWord::Repeat)),
    (b"ELSEIF", Token::Flow(FlowWord::ElseIf)),
    (b"ENDIF", Token::Flow(FlowWord::EndIf)),
    (b"WHILE", Token::Flow(FlowWord::While)),
    (b"BREAK", Token::Flow(FlowWord::Break)),
    (b"CALL", Token::Flow(FlowWord::Call)),
    (b"ELSE", Token::Flow(FlowWord::Else)),
    (b"SUB", Token::Flow(FlowWord::Sub)),
    (b"IF", Token::Flow(FlowWord::If)),
    (b"DO", Token::Flow(FlowWord::Do)),
];

/// Functions and operators of a control with O words (LinuxCNC 2.9, gcode/overview.html, binary operators and
/// functions): `FIX` goes down and `FUP` up on the line of numbers.
const O_OPERATORS: &[(&[u8], Token)] = &[
    (b"EXISTS", Token::Exists),
    (b"ROUND", Token::Function(Some(Function::Round))),
    (b"ASIN", Token::Function(Some(Function::Asin))),
    (b"ACOS", Token::Function(Some(Function::Acos))),
    (b"ATAN", Token::Atan),
    (b"SQRT", Token::Function(Some(Function::Sqrt))),
    (b"SIN", Token::Function(Some(Function::Sin))),
    (b"COS", Token::Function(Some(Function::Cos))),
    (b"TAN", Token::Function(Some(Function::Tan))),
    (b"ABS", Token::Function(Some(Function::Abs))),
    (b"FIX", Token::Function(Some(Function::Floor))),
    (b"FUP", Token::Function(Some(Function::Ceiling))),
    (b"EXP", Token::Function(Some(Function::Exp))),
    (b"LN", Token::Function(Some(Function::Ln))),
    (b"XOR", Token::Logic(Binary::Xor)),
    (b"OR", Token::Logic(Binary::Or)),
    (b"AND", Token::Logic(Binary::And)),
    (b"MOD", Token::Modulo),
    (b"EQ", Token::Compare(Binary::Equal)),
    (b"NE", Token::Compare(Binary::NotEqual)),
    (b"GT", Token::Compare(Binary::Greater)),
    (b"GE", Token::Compare(Binary::GreaterOrEqual)),
    (b"LT", Token::Compare(Binary::Less)),
    (b"LE", Token::Compare(Binary::LessOrEqual)),
];

/// Letters by which a misspelt word may differ.
const MISSPELT: usize = 2;

/// The tokens of one block.
pub(crate) struct Tokens<'t> {
    raw: logos::Lexer<'t, Raw>,
    signs: Signs,
    /// Open brackets.
    depth: u32,
    /// Whether an expression runs without brackets: after `=`.
    assigned: bool,
    /// Whether nothing but a skip mark has been met; whether a value comes next. Of a control with O words.
    begins: bool,
    value_next: bool,
    /// Whether `IF` has been met, or the letter of programs of a control with O words.
    decides: bool,
    /// Where the block has ended: at its end sign, or at the end of the text.
    ended: Option<usize>,
    comments: &'t mut Vec<(usize, usize)>,
}

impl<'t> Tokens<'t> {
    /// The tokens of the block that begins at `from`; a line's end must not be in `line`.
    pub(in crate::word) fn new(
        line: &'t [u8],
        from: usize,
        signs: Signs,
        comments: &'t mut Vec<(usize, usize)>,
    ) -> Tokens<'t> {
        let mut raw = Raw::lexer(line);
        raw.bump(from);
        Tokens {
            raw,
            signs,
            depth: 0,
            assigned: false,
            begins: true,
            value_next: false,
            decides: false,
            ended: None,
            comments,
        }
    }

    /// Where the next block begins, once this one is over; `None` if the line is over.
    pub(in crate::word) fn next_block(&self) -> Option<usize> {
        self.ended.filter(|&at| at < self.raw.source().len())
    }

    fn refuse(&self, fault: Fault) -> Option<<Self as Iterator>::Item> {
        let span = self.raw.span();
        Some(Err(Refusal { fault, start: span.start, end: span.end }))
    }

    fn unexpected(&mut self) -> Option<<Self as Iterator>::Item> {
        let start = self.raw.span().start;
        let (before, rest) = self.raw.source().split_at(start);
        let (found, len) = first_char(rest);
        // `Y3O.`: the letter, and not the point after it, is what is wrong.
        if let ([b'.', ..], [.., b'0'..=b'9', b'O' | b'o']) = (rest, before) {
            return Some(Err(Refusal { fault: Fault::LetterOForZero, start: start - 1, end: start }));
        }
        // An error token of the lexer may be longer than one character.
        Some(Err(Refusal { fault: Fault::UnexpectedCharacter { found }, start, end: start + len }))
    }

    /// Sets a comment aside; `Err` if it is not closed.
    fn comment(&mut self, close: u8) -> Result<(), Refusal> {
        let start = self.raw.span().end;
        let rest = self.raw.remainder();
        if close == 0 {
            let end = start + rest.len();
            self.raw.bump(rest.len());
            self.comments.push((start, end));
            return Ok(());
        }
        match memchr::memchr(close, rest) {
            Some(len) => {
                self.raw.bump(len + 1);
                self.comments.push((start, start + len));
                Ok(())
            }
            None => {
                self.raw.bump(rest.len());
                Err(Refusal { fault: Fault::UnclosedComment, start: start - 1, end: start + rest.len() })
            }
        }
    }

    /// The block's end; a comment after it that fills the line still belongs to it.
    fn end_sign(&mut self) {
        let end = self.raw.span().end;
        self.ended = Some(end);
        let rest = self.raw.remainder();
        let blanks = rest.len() - rest.trim_ascii_start().len();
        if self.signs.close == 0 && self.signs.comment != 0 && rest.get(blanks) == Some(&self.signs.comment) {
            self.comments.push((end + blanks + 1, end + rest.len()));
            self.ended = Some(self.raw.source().len());
        }
    }

    /// Letters after a label that are none of the words that stand there.
    fn not_a_flow_word(&mut self) -> Option<Refusal> {
        let start = self.raw.span().start;
        let rest = &self.raw.source()[start..];
        let letters = rest.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        let operator = |word: &[u8]| begins(&rest[1..], word).is_some();
        // An address with a function is no word: `XSIN[30]`.
        if !self.decides || letters < 2 || O_OPERATORS.iter().any(|(word, _)| operator(word)) {
            return None;
        }
        self.raw.bump(letters - 1);
        let code = String::from_utf8_lossy(&rest[..letters]);
        let spelled = code.to_ascii_uppercase();
        let words = FLOW.iter().map(|(word, _)| String::from_utf8_lossy(word));
        let near = words.map(|word| (strsim::damerau_levenshtein(&word, &spelled), word));
        let what = match near.min_by_key(|(off, _)| *off).filter(|(off, _)| *off <= MISSPELT) {
            Some((_, word)) => FlowUnsupported::OWordNear { nearest: word.to_ascii_lowercase().into() },
            None => FlowUnsupported::OWord,
        };
        let fault = Fault::NotSupported { code: code.as_ref().into(), what: what.into() };
        Some(Refusal { fault, start, end: start + letters })
    }

    /// The key word of a control with O words that begins with the letter just read. Functions stand where values do.
    fn o_keyword(&mut self) -> Option<Token> {
        let start = self.raw.span().start;
        let rest = &self.raw.source()[start..];
        let (in_expression, after_name) = (self.depth > 0 || self.value_next, self.decides);
        let fits = |word: &[u8]| rest.get(..word.len()).is_some_and(|t| t.eq_ignore_ascii_case(word));
        if in_expression && let Some(&(word, token)) = O_OPERATORS.iter().find(|(word, _)| fits(word)) {
            self.raw.bump(word.len() - 1);
            return Some(token);
        }
        // Blanks within a word count for nothing: `end sub` (rs274, run).
        if !in_expression
            && after_name
            && let Some((len, token)) =
                FLOW.iter().find_map(|(word, token)| Some((begins(rest, word)?, *token)))
        {
            self.raw.bump(len - 1);
            self.decides = false;
            return Some(token);
        }
        let label = !in_expression && rest[0].eq_ignore_ascii_case(&self.signs.program);
        if label {
            self.decides = true;
        }
        label.then_some(Token::Label)
    }

    /// The key word that begins with the letter just read.
    fn keyword(&mut self) -> Option<Token> {
        if self.signs.o_words {
            return self.o_keyword();
        }
        let start = self.raw.span().start;
        let rest = &self.raw.source()[start..];
        let in_expression = self.depth > 0 || self.assigned;
        let statements = if self.depth > 0 { &[] } else { STATEMENTS };
        let operators = if in_expression { OPERATORS } else { &[] };
        let fits = |word: &[u8]| rest.get(..word.len()).is_some_and(|t| t.eq_ignore_ascii_case(word));
        let &(word, token) = statements.iter().chain(operators).find(|(word, token)| {
            // `DO1`, `END1`: without its number the letters are words of their own.
            let numbered = matches!(token, Token::Do | Token::End);
            // Elsewhere than after a condition, `GO` is a G and a letter that is meant as a zero.
            let behind = [b"GO".as_slice(), b"TH"].contains(word);
            fits(word)
                && (!numbered || rest.get(word.len()).is_some_and(|b| b.is_ascii_digit() || *b == b' '))
                && (!behind || self.decides)
        })?;
        self.decides |= token == Token::If;
        let all = match token {
            Token::Print => device_text::length(rest).unwrap_or_else(|| self.rest_of_block(rest)),
            _ => word.len(),
        };
        self.raw.bump(all - 1);
        Some(token)
    }

    fn rest_of_block(&self, rest: &[u8]) -> usize {
        match self.signs.end {
            0 => rest.len(),
            end => memchr::memchr(end, rest).unwrap_or(rest.len()),
        }
    }

    fn sign(&mut self, byte: u8) -> Option<<Self as Iterator>::Item> {
        let signs = self.signs;
        let token = match byte {
            b'/' if self.depth > 0 || self.assigned => Token::Slash,
            b'/' if signs.o_words && !self.begins => Token::Slash,
            _ if byte == signs.skip => Token::Skip,
            b'+' => Token::Plus,
            b'-' => Token::Minus,
            b',' => Token::Comma,
            b':' => Token::Colon,
            b'#' if signs.macros => Token::Hash,
            b'*' if signs.macros => Token::Star,
            b'=' if signs.macros => {
                self.assigned = !signs.o_words;
                Token::Equals
            }
            b'[' if signs.macros => {
                self.depth += 1;
                Token::Open
            }
            b']' if signs.macros => {
                self.depth = self.depth.saturating_sub(1);
                Token::Close
            }
            b'<' if signs.macros => match memchr::memchr(b'>', self.raw.remainder()) {
                Some(len) => {
                    self.raw.bump(len + 1);
                    Token::Name
                }
                None => return self.unexpected(),
            },
            _ => return self.unexpected(),
        };
        Some(Ok(self.spanned(token)))
    }

    fn spanned(&mut self, token: Token) -> (usize, Token, usize) {
        let span = self.raw.span();
        self.begins &= token == Token::Skip;
        self.value_next = matches!(
            token,
            Token::Letter(_) | Token::Label | Token::Hash | Token::Equals | Token::Plus | Token::Minus
        );
        (span.start, token, span.end)
    }
}

impl Iterator for Tokens<'_> {
    type Item = Result<(usize, Token, usize), Refusal>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended.is_some() {
            return None;
        }
        loop {
            let Some(raw) = self.raw.next() else {
                self.ended = Some(self.raw.source().len());
                return None;
            };
            let Ok(raw) = raw else {
                return self.unexpected();
            };
            let byte = self.raw.slice()[0];
            match raw {
                Raw::Letter => {
                    let keyword = if self.signs.macros { self.keyword() } else { None };
                    if self.signs.o_words
                        && keyword.is_none()
                        && self.depth == 0
                        && !self.value_next
                        && let Some(refusal) = self.not_a_flow_word()
                    {
                        return Some(Err(refusal));
                    }
                    let token = keyword.unwrap_or(Token::Letter(byte.to_ascii_uppercase()));
                    return Some(Ok(self.spanned(token)));
                }
                Raw::PolarSign if self.signs.polar.contains(&byte) => {
                    return Some(Ok(self.spanned(Token::Letter(byte))));
                }
                Raw::PolarSign => return self.unexpected(),
                Raw::Number => {
                    return match Digits::parse(self.raw.slice()) {
                        Some(digits) => Some(Ok(self.spanned(Token::Number(digits)))),
                        None => {
                            let text = String::from_utf8_lossy(self.raw.slice()).into();
                            self.refuse(Fault::BadNumber { text })
                        }
                    };
                }
                Raw::Power if self.signs.macros => return Some(Ok(self.spanned(Token::Power))),
                Raw::Power => return self.unexpected(),
                Raw::System if self.signs.macros && !self.signs.o_words => {
                    return Some(Ok(self.spanned(Token::System)));
                }
                Raw::System => return self.unexpected(),
                Raw::Sign if byte == self.signs.comment => {
                    if let Err(refusal) = self.comment(self.signs.close) {
                        return Some(Err(refusal));
                    }
                }
                Raw::Sign if byte == self.signs.line => {
                    if let Err(refusal) = self.comment(0) {
                        return Some(Err(refusal));
                    }
                }
                Raw::Sign if byte == self.signs.end => {
                    self.end_sign();
                    return None;
                }
                Raw::Sign => return self.sign(byte),
            }
        }
    }
}
