//! Words of a line: letters with values, settings of parameters, remarks.

use super::super::{Halt, What};
use super::Control;
use super::parameters::Reading;

/// Letters and numbers of a block, and whether its last remark is for the operator, or ends the program.
pub(super) struct Words {
    pub(super) words: Vec<(char, f64)>,
    pub(super) message: Option<What>,
    pub(super) alarm: bool,
}

impl Words {
    pub(super) fn get(&self, letter: char) -> Option<f64> {
        self.words.iter().find(|w| w.0 == letter).map(|w| w.1)
    }

    pub(super) fn codes(&self, letter: char) -> Vec<u32> {
        self.words.iter().filter(|w| w.0 == letter).map(|w| (w.1 * 10.0).round() as u32).collect()
    }
}

impl Control {
    /// Words of a line; `None` if it is left out.
    pub(super) fn words(&mut self, line: &str) -> Result<Option<Words>, Halt> {
        let mut bare = String::new();
        let (mut message, mut alarm) = (None, false);
        let mut rest = line;
        while let Some(c) = rest.chars().next() {
            rest = &rest[c.len_utf8()..];
            match c {
                ';' => break,
                '(' => {
                    let Some(end) = rest.find(')') else { return self.m.halt("a remark without an end") };
                    let said: String = rest[..end].split_whitespace().collect::<String>().to_uppercase();
                    let shown = ["DEBUG,", "PRINT,"].iter().any(|word| said.starts_with(word));
                    message = match said == "MSG," {
                        true => Some(What::MessageCleared),
                        false => (said.starts_with("MSG,") || shown).then_some(What::Message),
                    };
                    alarm = said.starts_with("ABORT,");
                    rest = &rest[end + 1..];
                }
                _ if c.is_whitespace() => {}
                _ => bare.push(c.to_ascii_uppercase()),
            }
        }
        let mut rest = &bare[..];
        if let Some(after) = rest.strip_prefix('/') {
            if self.m.setup.skip[1] {
                return Ok(None);
            }
            rest = after;
        }
        let mut words = Vec::new();
        let mut first = true;
        // Settings count when the whole line has been read.
        let mut settings = Vec::new();
        while let Some(letter) = rest.chars().next() {
            if letter == '#' {
                let mut reading = Reading { rest: &rest[1..] };
                let place = self.place(&mut reading)?;
                let Some(behind) = reading.rest.strip_prefix('=') else { return self.m.halt("no setting") };
                let mut reading = Reading { rest: behind };
                settings.push((place, self.value(&mut reading)?));
                rest = reading.rest;
                first = false;
                continue;
            }
            if !"ABCDFGHIJKLMNPQRSTXYZ@^".contains(letter) || letter == 'N' && !first {
                return self.m.halt(format!("unexpected {letter}"));
            }
            rest = &rest[1..];
            let mut reading = Reading { rest };
            let value = self.value(&mut reading)?;
            rest = reading.rest;
            first = false;
            let once = words.iter().any(|(l, _)| *l == letter) && !matches!(letter, 'G' | 'M');
            if once {
                return self.m.halt(format!("{letter} twice"));
            }
            if letter != 'N' {
                words.push((letter, value));
            }
        }
        for (place, value) in settings {
            self.set(place, value)?;
        }
        Ok(Some(Words { words, message, alarm }))
    }
}
