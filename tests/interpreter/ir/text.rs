//! Words of the neutral program's text.

/// A line: its number and its words.
pub(super) type Line = (usize, Vec<Token>);

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Name(String),
    Number(f64, String),
    Text(String),
    Sign(char),
}

pub(super) fn tokens(line: &str) -> Result<Vec<Token>, String> {
    let mut tokens = Vec::new();
    let mut chars = line.chars().peekable();
    while let Some(&c) = chars.peek() {
        if c.is_whitespace() {
            chars.next();
        } else if c == '#' {
            break;
        } else if c == '"' {
            chars.next();
            let mut text = String::new();
            loop {
                match chars.next() {
                    Some('"') => break,
                    Some('\\') => text.extend(chars.next()),
                    Some(c) => text.push(c),
                    None => return Err("a text that does not end".into()),
                }
            }
            tokens.push(Token::Text(text));
        } else if c.is_ascii_digit() || c == '.' || c == '-' {
            let mut number = String::new();
            while let Some(&c) =
                chars.peek().filter(|c| c.is_ascii_digit() || **c == '.' || (number.is_empty() && **c == '-'))
            {
                number.push(c);
                chars.next();
            }
            let mut unit = String::new();
            while let Some(&c) = chars.peek().filter(|c| c.is_ascii_lowercase()) {
                unit.push(c);
                chars.next();
            }
            let Ok(value) = number.parse() else { return Err(format!("no number: {number}")) };
            tokens.push(Token::Number(value, unit));
        } else if c.is_alphabetic() {
            let mut name = String::new();
            while let Some(&c) = chars.peek().filter(|c| c.is_alphanumeric() || "_-".contains(**c)) {
                name.push(c);
                chars.next();
            }
            tokens.push(Token::Name(name));
        } else {
            tokens.push(Token::Sign(c));
            chars.next();
        }
    }
    Ok(tokens)
}

/// The name in a function's brackets: a number or a text.
pub(super) fn name(token: Option<&Token>) -> Option<String> {
    match token {
        Some(Token::Number(value, _)) => Some(value.to_string()),
        Some(Token::Text(text)) => Some(text.clone()),
        _ => None,
    }
}

/// The label that a line begins with.
pub(super) fn label(line: &Line) -> Option<String> {
    let at = line.1.iter().position(|t| matches!(t, Token::Name(n) if n == "LABEL"))?;
    name(line.1.get(at + 2))
}

/// Arguments, parted at the commas that stand in no inner parentheses.
pub(super) fn split(tokens: &[Token]) -> Vec<&[Token]> {
    let mut parts = Vec::new();
    let (mut depth, mut from) = (0, 0);
    for (at, token) in tokens.iter().enumerate() {
        match token {
            Token::Sign('(') => depth += 1,
            Token::Sign(')') => depth -= 1,
            Token::Sign(',') if depth == 0 => {
                parts.push(&tokens[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    if from < tokens.len() {
        parts.push(&tokens[from..]);
    }
    parts
}
