//! Programs of Mach3, whose interpreter comes from NIST's as LinuxCNC's does: what is another way in the reference notes
//! (chapter 3) is put into the words of that, and what Mach3 lacks is refused. Variables and flow are out of scope.

use super::{Halt, Machine, Setup, linuxcnc};

/// G codes of LinuxCNC that Mach3 does not have, or has for something else, in tenths.
const OTHERS: [u32; 32] = [
    50, 51, 52, 53, 70, 80, 281, 301, 330, 331, 382, 383, 384, 385, 411, 421, 431, 432, 591, 592, 593, 611,
    740, 760, 840, 870, 880, 960, 970, 171, 181, 191,
];

/// M codes of LinuxCNC that Mach3 does not have.
const OTHER_MS: [u32; 14] = [19, 50, 51, 52, 53, 60, 61, 62, 63, 64, 65, 66, 67, 68];

/// Runs a text.
///
/// # Errors
/// The program is wrong, out of scope, or says something that the notes leave open.
pub fn run(text: &[u8], setup: Setup) -> Result<Machine, Halt> {
    let mut state = State { normal: b'K', arc: false };
    let mut rewritten = String::new();
    for (index, line) in super::characters(text).lines().enumerate() {
        // It counts for nothing, wherever it stands.
        if !line.trim_start().starts_with('%') {
            let own = state.line(line).map_err(|why| Halt { line: index + 1, why })?;
            rewritten.push_str(&own);
        }
        rewritten.push('\n');
    }
    linuxcnc::run(rewritten.as_bytes(), setup)
}

/// What the words of an arc depend on.
struct State {
    /// The centre word along the normal of the plane in force.
    normal: u8,
    /// Whether an arc is the motion in force.
    arc: bool,
}

impl State {
    fn line(&mut self, line: &str) -> Result<String, String> {
        let (mut words, mut rest) = (Vec::new(), String::new());
        let mut chars = line.chars().peekable();
        while let Some(c) = chars.next() {
            match c {
                '(' => {
                    rest.push(c);
                    for c in chars.by_ref() {
                        rest.push(c);
                        if c == ')' {
                            break;
                        }
                    }
                }
                ';' => {
                    rest.push(c);
                    rest.extend(chars.by_ref());
                }
                '#' | '[' | ']' | '=' | '@' | '^' | '<' => return Err(format!("{c}: no words alone")),
                c if c.is_whitespace() => {}
                '/' => words.push((c, String::new())),
                letter if letter.is_ascii_alphabetic() => {
                    let mut number = String::new();
                    while let Some(c) = chars.next_if(|c| c.is_ascii_digit() || "+-. ".contains(*c)) {
                        number.push(c);
                    }
                    words.push((letter.to_ascii_uppercase(), number.replace(' ', "")));
                }
                c => return Err(format!("{c} is no word")),
            }
        }
        self.modes(&words)?;
        let kept = words.into_iter().filter_map(|(letter, number)| self.word(letter, number));
        Ok(kept.collect::<String>() + &rest)
    }

    /// Modes that a block sets for its own words, and codes that are not Mach3's.
    fn modes(&mut self, words: &[(char, String)]) -> Result<(), String> {
        let mut table = false;
        for (letter, number) in words {
            let value: f64 = number.parse().unwrap_or(0.0);
            let tenths = (value * 10.0).round() as u32;
            match (letter, tenths) {
                ('G', code) if OTHERS.contains(&code) => return Err(format!("G{value}")),
                ('M', _) if OTHER_MS.contains(&(value as u32)) => return Err(format!("M{value}")),
                ('E' | 'U' | 'V' | 'W', _) => return Err(format!("{letter} is no word")),
                ('G', 170) => self.normal = b'K',
                ('G', 180) => self.normal = b'J',
                ('G', 190) => self.normal = b'I',
                ('G', 20 | 30) => self.arc = true,
                ('G', 0 | 10 | 730 | 800..=890) => self.arc = false,
                ('G', 100) => table = true,
                ('L', code) if table && code != 20 => return Err("G10 of another kind".to_owned()),
                ('P', _) if self.arc && !words.iter().any(|word| matches!(word.0, 'G' | 'M' | 'L')) => {
                    return Err("P of an arc".to_owned());
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// A word in LinuxCNC's terms; none if it counts for nothing.
    fn word(&self, letter: char, number: String) -> Option<String> {
        let value: f64 = number.parse().unwrap_or(f64::NAN);
        match (letter, (value * 10.0).round() as i64) {
            ('G', 700) => Some("G20 ".to_owned()),
            ('G', 710) => Some("G21 ".to_owned()),
            // Ends a scale, which no program here sets (chapter 3: G51 is out of scope).
            ('G', 500) => None,
            // Exact stop and constant velocity are its two modes.
            ('G', 610) => Some("G61.1 ".to_owned()),
            (letter, 0) if self.arc && letter as u32 == u32::from(self.normal) => None,
            _ => Some(format!("{letter}{number} ")),
        }
    }
}
