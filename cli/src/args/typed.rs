//! Values of options: their forms, and how they are read.

use std::fmt;

use clap::ValueEnum;
use ncc_backends::Numbering;
use ncc_ir::canon::{AXES, Units};
use ncc_ir::expr::num::Nanos;

/// How canon is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Style {
    /// As a program that can be read again
    Plain,
    /// As LinuxCNC's stand-alone interpreter prints calls
    Rs274,
}

/// Line ends of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Eol {
    /// Those of the source's first line
    Keep,
    /// LF
    Lf,
    /// CR LF
    Crlf,
}

/// The unit of lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UnitsArg {
    /// Millimetres
    Mm,
    /// Inches
    Inch,
}

impl From<UnitsArg> for Units {
    fn from(units: UnitsArg) -> Units {
        match units {
            UnitsArg::Mm => Units::Mm,
            UnitsArg::Inch => Units::Inch,
        }
    }
}

/// Form of the messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people
    Human,
    /// One JSON object a line
    Json,
}

/// Colour of the messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Color {
    /// If somebody can see it
    Auto,
    /// Yes
    Always,
    /// No
    Never,
}

/// Where the axes stand before the first block.
pub(crate) type Start = [Option<Nanos>; AXES];

pub(crate) fn pair(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() && !value.is_empty() => {
            Ok((name.to_owned(), value.to_owned()))
        }
        Some(_) | None => Err("write it as NAME=VALUE".to_owned()),
    }
}

pub(crate) fn numbering(text: &str) -> Result<Numbering, String> {
    match text {
        "off" => return Ok(Numbering::Off),
        "keep" => return Ok(Numbering::Keep),
        _ => {}
    }
    let every = text.split_once(':').and_then(|(first, step)| {
        let (first, step) = (first.parse().ok()?, step.parse().ok()?);
        (step > 0 && first < 100_000_000 && step < 100_000_000).then_some(Numbering::Every { first, step })
    });
    every.ok_or_else(|| "write `off`, `keep`, or the first number and the step, such as 10:10".to_owned())
}

/// An M code of the source and what becomes of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MCode {
    /// Its number.
    pub number: u16,
    /// What is written for it; `None` leaves it out.
    pub written: Option<u16>,
}

impl MCode {
    /// What the command line says: `M31=drop`, `M50=carry`, `M50=M88`.
    ///
    /// # Errors
    /// It is none of these forms.
    pub fn read(text: &str) -> Result<MCode, String> {
        let number = |code: &str| {
            let digits = code.strip_prefix(['M', 'm'])?;
            (digits.len() <= 4).then(|| digits.parse::<u16>().ok()).flatten()
        };
        let (code, fate) = text.split_once('=').unwrap_or((text, ""));
        let own = number(code);
        let written = match fate {
            "drop" => Some(None),
            "carry" => own.map(Some),
            other => number(other).map(Some),
        };
        let form = || "write it as M31=drop, M31=carry or M31=M88".to_owned();
        Ok(MCode { number: own.ok_or_else(form)?, written: written.ok_or_else(form)? })
    }
}

impl fmt::Display for MCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.written {
            None => write!(f, "--m-code M{}=drop", self.number),
            Some(written) if written == self.number => write!(f, "--m-code M{}=carry", self.number),
            Some(written) => write!(f, "--m-code M{}=M{written}", self.number),
        }
    }
}

/// Assumptions that `--assume` states.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Assumed {
    /// Every program is for a mill, whatever it looks like
    Milling,
}

/// A program whose calls are left out, as the command line says it: `RAPORT=drop`, `9810=drop`, `O9810=drop`; or a
/// code that calls one, `M165=drop`.
///
/// # Errors
/// It is not of this form.
pub(crate) fn call_left_out(text: &str) -> Result<String, String> {
    let form = || "write it as RAPORT=drop or 9810=drop".to_owned();
    let name = text.strip_suffix("=drop").filter(|name| !name.is_empty()).ok_or_else(form)?;
    let fits = name.bytes().all(|b| b.is_ascii_alphanumeric() || b"_-+.".contains(&b));
    let digits = |name: &str| !name.is_empty() && name.bytes().all(|b| b.is_ascii_digit());
    let number = name.strip_prefix(['O', 'o']).filter(|rest| digits(rest)).unwrap_or(name);
    let number = if digits(number) { number.trim_start_matches('0') } else { number };
    let code = name.strip_prefix(['G', 'g', 'M', 'm']).is_some_and(digits);
    let number = if code { name.to_ascii_uppercase() } else { number.to_owned() };
    if fits && !number.is_empty() { Ok(number) } else { Err(form()) }
}

/// Words that may stand between two dialects.
pub(crate) const ARROWS: [&str; 4] = ["to", "->", "=>", "→"];

/// Whether a word can be a dialect's name: two signs or more, so that a drive letter is none.
pub fn is_name(word: &str) -> bool {
    word.len() >= 2
        && word.as_bytes()[0].is_ascii_alphabetic()
        && !ARROWS.contains(&word)
        && word[1..]
            .split('-')
            .all(|part| word.len() > 1 && part.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_'))
        && !word.ends_with('-')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbering_forms() {
        assert_eq!(numbering("10:5"), Ok(Numbering::Every { first: 10, step: 5 }));
        for wrong in ["", "10", "10:0", ":", "a:b", "-1:1", "OFF"] {
            assert!(numbering(wrong).is_err(), "{wrong}");
        }
    }
}
