//! Lines that frame units: `%_N_NAME_MPF` and `;$PATH=…`, as programs are transferred. On the
//! control they are no part of the program, so a text may come without them.
//!
//! Not here: blocks, and what is in units that are no programs.

use ncc_ir::diag::Fault;
use ncc_ir::source::Span;
use ncc_ir::syntax::Found;

/// What a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Line {
    /// A unit begins.
    Header(Header),
    /// Where the unit is kept; the path without `;$PATH=`.
    Path(Span),
    /// A percent sign alone.
    Mark,
    /// Anything else.
    Block,
}

/// The head of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Header {
    /// The program's name, without `_N_` and its type.
    pub(crate) name: Span,
    pub(crate) kind: Kind,
}

/// What a unit is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// `MPF`: a main program.
    Main,
    /// `SPF`: a subprogram.
    Sub,
    /// Data, texts, definitions: not in the language of programs.
    Other,
}

/// Tells what a line (without its end) is; `base` is the place of its first byte.
pub(crate) fn line(line: &[u8], base: u32) -> Result<Line, (Fault, Span)> {
    const PATH: &[u8] = b";$PATH=";
    let span = |start: usize, end: usize| Span::new(base + start as u32, base + end as u32);
    let text = line.trim_ascii_end();
    if text.get(..PATH.len()).is_some_and(|start| start.eq_ignore_ascii_case(PATH)) {
        return Ok(Line::Path(span(PATH.len(), text.len())));
    }
    let Some(rest) = text.strip_prefix(b"%") else {
        return Ok(Line::Block);
    };
    if rest.is_empty() {
        return Ok(Line::Mark);
    }
    let header = rest.strip_prefix(b"_N_").or_else(|| rest.strip_prefix(b"_n_")).and_then(|name| {
        let stem = name.len().checked_sub(4).filter(|stem| *stem > 0)?;
        let kind = match name[stem..].to_ascii_uppercase().as_slice() {
            b"_MPF" => Kind::Main,
            b"_SPF" => Kind::Sub,
            [b'_', kind @ ..] if kind.iter().all(u8::is_ascii_alphanumeric) => Kind::Other,
            _ => return None,
        };
        let is_name = name[..stem].iter().all(|b| b.is_ascii_alphanumeric() || *b == b'_');
        is_name.then(|| Header { name: span(4, 4 + stem), kind })
    });
    match header {
        Some(header) => Ok(Line::Header(header)),
        None => {
            let found = Found::Text(String::from_utf8_lossy(text).into());
            let expected = "%_N_NAME_MPF".into();
            Err((Fault::Syntax { found, expected }, span(0, text.len())))
        }
    }
}
