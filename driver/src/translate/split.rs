//! Main program and subprograms as files of their own, where the target's control keeps them so.
//!
//! A Sinumerik's programs are files with a name; the line `%_N_NAME_SPF` stands before each only where
//! several go through one transfer (SINUMERIK 840D/840Di/810D Operator's Guide HMI Advanced, 03.04, 7.3:
//! PC format and punched-tape format; SINUMERIK ONE NC programming, 12/2019, 2.2.1). A Fanuc's file
//! begins with `%` and the number and ends with `%`, and is named by its number (FANUC B-64014EN/03,
//! 2.3 and 2.5). What is split is text of ncc's own writers that was verified as a whole; it is given
//! back by [`join`], byte for byte, or nothing is.

use ncc_dialects::{Dialect, Family};

/// How programs of a dialect are kept apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Custom {
    /// Without the line that names each in a transfer.
    Named,
    /// Each in a frame of its own, with the letter that its number has.
    Numbered(char),
}

/// A program of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its name as a unit of the whole: `POCKET_SPF`, `O0300`.
    unit: String,
    /// What is in its file.
    pub text: Vec<u8>,
}

impl Part {
    /// The name of a subprogram's file without its extension.
    pub fn stem(&self) -> &str {
        self.unit.rsplit_once('_').map_or(&self.unit, |(stem, _)| stem)
    }

    /// The extension that goes with the unit itself.
    pub fn extension(&self) -> Option<&str> {
        self.unit.rsplit_once('_').map(|(_, kind)| kind)
    }
}

fn custom(to: &Dialect) -> Option<Custom> {
    match to.family {
        Family::Sinumerik => Some(Custom::Named),
        Family::Word if to.program.subprograms => to.program.number.map(Custom::Numbered),
        Family::Word | Family::Canon | Family::Ir => None,
    }
}

/// Whether subprograms can be files of their own there.
pub fn can(to: &Dialect) -> bool {
    custom(to).is_some()
}

/// Whether that is the custom, and one text of several is for a transfer only.
pub fn usual(to: &Dialect) -> bool {
    custom(to) == Some(Custom::Named)
}

/// The programs of a text, the main one first; `None` if there is but one.
pub fn apart(to: &Dialect, text: &[u8]) -> Option<Vec<Part>> {
    let custom = custom(to)?;
    let frame = to.program.frame.as_bytes();
    let lines: Vec<&[u8]> = text.split_inclusive(|b| *b == b'\n').collect();
    let framed = |line: &&&[u8]| !frame.is_empty() && line.trim_ascii_end() == frame;
    let opening = lines.first().filter(framed).copied().unwrap_or_default();
    let closing = lines.last().filter(framed).copied().unwrap_or_default();
    let body = lines.get(usize::from(!opening.is_empty())..lines.len() - usize::from(!closing.is_empty()))?;
    let mut parts: Vec<Part> = Vec::new();
    for line in body {
        match (custom, unit(custom, line)) {
            (Custom::Named, Some(unit)) => parts.push(Part { unit, text: Vec::new() }),
            (Custom::Numbered(_), Some(unit)) => {
                parts.push(Part { unit, text: [opening, line].concat() });
            }
            (_, None) => parts.last_mut()?.text.extend_from_slice(line),
        }
    }
    for part in &mut parts {
        part.text.extend_from_slice(closing);
    }
    (parts.len() > 1).then_some(parts)
}

/// The name of the unit that a line opens.
fn unit(custom: Custom, line: &[u8]) -> Option<String> {
    let line = std::str::from_utf8(line).ok()?.trim_ascii_end();
    match custom {
        Custom::Named => line.strip_prefix("%_N_").map(str::to_owned),
        Custom::Numbered(letter) => {
            let digits = line.strip_prefix(letter)?.bytes().take_while(u8::is_ascii_digit).count();
            (digits > 0).then(|| line[..letter.len_utf8() + digits].to_owned())
        }
    }
}

/// The text that the parts came from, made again of their names and what is in their files.
pub fn join(to: &Dialect, parts: &[Part]) -> Vec<u8> {
    let mut whole = Vec::new();
    let frame = to.program.frame.as_bytes();
    let last = parts.len().saturating_sub(1);
    for (at, part) in parts.iter().enumerate() {
        let mut text = part.text.as_slice();
        match custom(to) {
            Some(Custom::Named) => {
                let crlf = text.split(|b| *b == b'\n').next().is_some_and(|line| line.ends_with(b"\r"));
                whole.extend_from_slice(format!("%_N_{}", part.unit).as_bytes());
                whole.extend_from_slice(if crlf { b"\r\n" } else { b"\n" });
            }
            Some(Custom::Numbered(_)) if !frame.is_empty() => {
                let end = |text: &[u8]| text.iter().position(|b| *b == b'\n').map_or(text.len(), |at| at + 1);
                if at > 0 && text.starts_with(frame) {
                    text = &text[end(text)..];
                }
                let trimmed = text.trim_ascii_end();
                if at < last && trimmed.ends_with(frame) {
                    text = &text[..trimmed.len() - frame.len()];
                }
            }
            Some(Custom::Numbered(_)) | None => {}
        }
        whole.extend_from_slice(text);
    }
    whole
}

#[cfg(test)]
mod tests {
    use ncc_dialects::builtin;

    use super::*;

    fn parts(to: &str, text: &str) -> Vec<(String, String)> {
        let to = builtin(to).unwrap();
        let parts = apart(to, text.as_bytes()).unwrap_or_default();
        if !parts.is_empty() {
            assert_eq!(String::from_utf8(join(to, &parts)).unwrap(), text);
        }
        let text = |part: &Part| String::from_utf8(part.text.clone()).unwrap();
        parts.iter().map(|part| (part.unit.clone(), text(part))).collect()
    }

    #[test]
    fn units_lose_the_line_of_the_transfer() {
        for eol in ["\n", "\r\n"] {
            let text = "%_N_P_1_MPF\n; %_N_X\nL30\nM30\n%_N_L30_SPF\nG0 X1\nM17\n".replace('\n', eol);
            let expected = [("P_1_MPF", "; %_N_X\nL30\nM30\n"), ("L30_SPF", "G0 X1\nM17\n")];
            assert_eq!(parts("siemens", &text), expected.map(|(n, t)| (n.to_owned(), t.replace('\n', eol))));
        }
        assert_eq!(parts("siemens", "G0 X1\nM30\n"), []);
        assert_eq!(parts("siemens", "%_N_A_MPF\nM30\n"), []);
    }

    #[test]
    fn numbered_programs_get_frames_of_their_own() {
        let text = "%\nO0001 (A)\n(O2)\nM98 P300\nM30\nO0300\nM99\nO0301 (B)\nM99\n%\n";
        let expected = [
            ("O0001", "%\nO0001 (A)\n(O2)\nM98 P300\nM30\n%\n"),
            ("O0300", "%\nO0300\nM99\n%\n"),
            ("O0301", "%\nO0301 (B)\nM99\n%\n"),
        ];
        assert_eq!(parts("fanuc", text), expected.map(|(n, t)| (n.to_owned(), t.to_owned())));
        assert_eq!(parts("fanuc", "%\nO0001\nM30\n%\n"), []);
    }

    #[test]
    fn where_subprograms_are_no_files_nothing_is_split() {
        assert!(["mach9", "canon", "ir"].iter().all(|id| !can(builtin(id).unwrap())));
        assert!(usual(builtin("siemens").unwrap()) && !usual(builtin("fanuc").unwrap()));
    }
}
