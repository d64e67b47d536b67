//! Programs of O words by chance: parameters with numbers and with names, structures, loops that are left, subprograms
//! with arguments and results. All of them come to an end.

use std::fmt::Write;

use fastrand::Rng;

/// Statements of a program, about.
const MOST: u32 = 50;

/// Makes a program.
pub(super) struct Maker {
    dice: Rng,
    text: String,
    /// The next label.
    label: u32,
    /// How deep in loops.
    loops: u32,
    statements: u32,
    /// Of repeats, which no return leaves.
    repeats: u32,
    /// Whether loops of `do` are made; else some loops are left. One text cannot have both (`break` looks for the end
    /// of its loop from where it stands).
    tested_behind: bool,
    /// What has a value where the statements stand.
    known: Vec<&'static str>,
    /// Made of what every control has that computes, so that it goes into the others with its structure.
    common: bool,
    /// The subprogram that the statements are of, if any, and those that can be called.
    within: Option<usize>,
    calls: usize,
}

const SUBPROGRAMS: [&str; 2] = ["o8101", "o<ring>"];

impl Maker {
    pub(super) fn program(seed: u64) -> String {
        let mut maker = Maker {
            dice: Rng::with_seed(seed),
            text: String::new(),
            label: 100,
            loops: 0,
            repeats: 0,
            tested_behind: seed.is_multiple_of(2),
            common: seed % 4 < 2,
            statements: 0,
            known: Vec::new(),
            within: None,
            calls: 0,
        };
        let inches = maker.dice.u8(..6) == 0;
        let unit = if inches { "G20" } else { "G21" };
        let _ = write!(
            maker.text,
            "{unit} G17 G40 G49 G80 G90 G94 G54\nT3 M6\nS1000 M3\nG43 H3\nG0 X0 Y0 Z50\nF200\n"
        );
        for shared in ["#101", "#102", "#<_deep>"] {
            let value = maker.literal();
            let _ = writeln!(maker.text, "{shared} = {value}");
        }
        for program in 0..maker.dice.usize(..=SUBPROGRAMS.len()) {
            maker.subprogram(program);
            maker.calls = program + 1;
        }
        maker.known = vec!["#1", "#2", "#3", "#4", "#<size>", "#<far_up>"];
        for variable in maker.known.clone() {
            let value = maker.literal();
            let _ = writeln!(maker.text, "{variable} = {value}");
        }
        maker.known.extend(["#101", "#102", "#<_deep>"]);
        maker.statements = 0;
        for _ in 0..maker.dice.u32(2..9) {
            maker.statement();
        }
        maker.text.push_str("G90 G0 Z50\nM2\n");
        maker.text
    }

    fn subprogram(&mut self, program: usize) {
        let name = SUBPROGRAMS[program];
        self.line(&format!("{name} sub"));
        self.known = vec!["#1", "#2", "#3", "#<own>", "#101", "#102", "#<_deep>"];
        let value = self.literal();
        self.line(&format!("#<own> = [#1 + {}]", value.trim_start_matches('-')));
        (self.within, self.statements) = (Some(program), MOST / 2);
        for _ in 0..self.dice.u32(1..5) {
            self.statement();
        }
        self.within = None;
        match self.dice.bool() {
            true => self.line(&format!("{name} endsub")),
            false => {
                let value = self.expression(1);
                self.line(&format!("{name} endsub [{value}]"));
            }
        }
    }

    fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    fn literal(&mut self) -> String {
        match self.dice.u8(..5) {
            0 => self.dice.u32(..12).to_string(),
            1 => format!("{}.", self.dice.u32(..60)),
            2 => format!("-{}.{}", self.dice.u32(..20), self.dice.u32(..10)),
            3 => format!("{}.{:03}5", self.dice.u32(..9), self.dice.u32(..1000)),
            _ => format!("{}.{:02}", self.dice.u32(..30), self.dice.u32(..100)),
        }
    }

    fn one<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.dice.usize(..of.len())]
    }

    fn variable(&mut self) -> &'static str {
        self.known[self.dice.usize(..self.known.len())]
    }

    fn bare(&mut self) -> String {
        match self.dice.u8(..3) {
            0 => self.literal(),
            _ => self.variable().to_owned(),
        }
    }

    fn operand(&mut self, deep: u32) -> String {
        if deep == 0 {
            return self.bare();
        }
        let inner = deep - 1;
        match if self.common { self.dice.u8(..11) } else { self.dice.u8(..17) } {
            0..6 => self.bare(),
            6 => format!("[{} + {}]", self.expression(inner), self.bare()),
            7 => format!("{}[{}]", self.one(&["SIN", "COS"]), self.expression(inner)),
            8 if self.common => format!("ABS[{}]", self.expression(inner)),
            8 => format!("{}[{}]", self.one(&["ABS", "FIX", "FUP", "ROUND"]), self.expression(inner)),
            9 => format!("SQRT[ABS[{}]]", self.expression(0)),
            10 if self.common => format!("[{} - {}]", self.bare(), self.bare()),
            10 => format!("ATAN[{}]/[{}]", self.expression(inner), 1 + self.dice.u32(..9)),
            11 => format!("[{} MOD {}]", self.expression(inner), 1 + self.dice.u32(..9)),
            12 => format!("[[{} / 10] ** {}]", self.bare(), self.dice.u32(..4)),
            13 => match self.dice.u8(..5) {
                0 => format!("TAN[40 * SIN[{}]]", self.expression(0)),
                1 => format!("{}[SIN[{}]]", self.one(&["ASIN", "ACOS"]), self.expression(0)),
                2 => format!("LN[1 + ABS[{}]]", self.expression(0)),
                3 => format!("EXP[SIN[{}]]", self.expression(0)),
                _ => "EXISTS[#<size>]".to_owned(),
            },
            14 => format!("[{}]", self.condition()),
            _ => format!("[{} {} {}]", self.bare(), self.one(&["AND", "OR", "XOR"]), self.bare()),
        }
    }

    /// An expression with up to four operands, in every order of priorities.
    fn expression(&mut self, deep: u32) -> String {
        let mut text = self.operand(deep);
        for _ in 0..self.dice.u32(..3) {
            let signs = ["+", "-", "*", "/", "+", "*", "MOD"];
            let sign = self.one(&signs[..if self.common { 6 } else { 7 }]).to_owned();
            let operand = match &*sign {
                // Seldom by what may be nothing.
                "/" | "MOD" if self.dice.u8(..20) > 0 => format!("{}.", 1 + self.dice.u32(..9)),
                _ => self.operand(deep),
            };
            let _ = write!(text, " {sign} {operand}");
        }
        text
    }

    /// A condition that leaves a block short enough.
    fn condition(&mut self) -> String {
        loop {
            let condition = self.any_condition();
            if condition.len() < 150 {
                return condition;
            }
        }
    }

    fn any_condition(&mut self) -> String {
        let how = self.one(&["EQ", "NE", "GT", "GE", "LT", "LE"]).to_owned();
        let one = match self.dice.u8(..6) {
            0 => self.variable().to_owned(),
            1 => format!("{} {how} {}", self.variable(), self.literal()),
            _ => format!("{} {how} {}", self.expression(1), self.expression(1)),
        };
        if self.dice.u8(..5) > 0 {
            return one;
        }
        let and = self.one(&["AND", "OR", "XOR"]).to_owned();
        format!("[{one}] {and} [{} LT {}]", self.variable(), self.bare())
    }

    /// A word that leaves a block short enough.
    fn word(&mut self, letter: char) -> String {
        loop {
            let word = self.any_word(letter);
            if word.len() < 55 {
                return word;
            }
        }
    }

    fn any_word(&mut self, letter: char) -> String {
        match self.dice.u8(..6) {
            0 => format!("{letter}{}", self.variable()),
            1 => format!("{letter}-{}", self.variable()),
            2 => format!("{letter}[10 * SIN[{}]]", self.expression(2)),
            3.. if self.common => format!("{letter}[30 * COS[{}]]", self.expression(1)),
            3 => format!("{letter}-[[{}] MOD 70]", self.expression(1)),
            4 => format!("{letter}[{}]", self.operand(1)),
            _ => format!("{letter}[[{}] MOD 90]", self.expression(2)),
        }
    }

    fn assignment(&mut self) -> String {
        let (to, mut value) = (self.variable(), self.expression(2));
        while value.len() > 200 {
            value = self.expression(2);
        }
        // In a loop it would grow.
        if self.common {
            return format!("{to} = [40 * SIN[{value}]]");
        }
        match self.loops > 0 || self.within.is_some() || self.dice.bool() {
            true => format!("{to} = [[{value}] MOD {}]", 20 + self.dice.u32(..60)),
            false => format!("{to} = [{value}]"),
        }
    }

    fn next_label(&mut self) -> u32 {
        self.label += 1;
        self.label
    }

    fn some(&mut self, most: u32) {
        for _ in 0..self.dice.u32(1..=most) {
            self.statement();
        }
    }

    fn statement(&mut self) {
        self.statements += 1;
        if self.statements > MOST {
            return self.movement();
        }
        match self.dice.u8(..16) {
            0..3 => {
                let text = self.assignment();
                self.line(&text);
            }
            3..6 => {
                let (label, condition) = (self.next_label(), self.condition());
                self.line(&format!("o{label} if [{condition}]"));
                self.some(2);
                for _ in 0..self.dice.u32(..5).saturating_sub(2) {
                    let condition = self.condition();
                    self.line(&format!("o{label} elseif [{condition}]"));
                    self.some(1);
                }
                if self.dice.bool() {
                    self.line(&format!("o{label} else"));
                    self.some(2);
                }
                self.line(&format!("o{label} endif"));
            }
            6..9 if self.loops < 3 => self.turns(),
            9 | 10 if self.calls > 0 => self.call(),
            11 if self.within.is_some() && self.repeats == 0 && self.dice.u8(..3) == 0 => {
                let (label, condition) = (self.next_label(), self.condition());
                let name = SUBPROGRAMS[self.within.unwrap_or_default()];
                let value =
                    if self.dice.bool() { format!(" [{}]", self.expression(0)) } else { String::new() };
                self.line(&format!("o{label} if [{condition}]\n{name} return{value}\no{label} endif"));
            }
            _ => self.movement(),
        }
    }

    fn turns(&mut self) {
        let label = self.next_label();
        if self.dice.u8(..4) == 0 {
            let times = match self.dice.bool() {
                true => self.dice.u32(..4).to_string(),
                false => format!("[3 * ABS[SIN[{}]]]", self.expression(0)),
            };
            (self.loops, self.repeats) = (self.loops + 1, self.repeats + 1);
            self.line(&format!("o{label} repeat [{times}]"));
            self.some(2);
            self.line(&format!("o{label} endrepeat"));
            (self.loops, self.repeats) = (self.loops - 1, self.repeats - 1);
            return;
        }
        self.loops += 1;
        let counter = match self.dice.bool() {
            true => format!("#{}", 20 + self.loops),
            false => format!("#<turn{}>", self.loops),
        };
        let turns = self.dice.u32(..4);
        self.line(&format!("{counter} = 0"));
        let tested_behind = self.tested_behind && self.dice.u8(..3) == 0;
        match tested_behind {
            true => self.line(&format!("o{label} do")),
            false => self.line(&format!("o{label} while [{counter} LT {turns}]")),
        }
        self.line(&format!("{counter} = [{counter} + 1]"));
        self.some(2);
        if !self.tested_behind && self.dice.u8(..3) == 0 {
            let (inner, condition) = (self.next_label(), self.condition());
            let how = self.one(&["break", "continue"]).to_owned();
            self.line(&format!("o{inner} if [{condition}]\no{label} {how}\no{inner} endif"));
            self.some(1);
        }
        match tested_behind {
            true => self.line(&format!("o{label} while [{counter} LT {turns}]")),
            false => self.line(&format!("o{label} endwhile")),
        }
        self.loops -= 1;
    }

    fn call(&mut self) {
        let name = SUBPROGRAMS[self.dice.usize(..self.calls)];
        let mut text = format!("{name} call");
        for _ in 0..self.dice.u32(..4) {
            let _ = match self.common {
                true => write!(text, " [50 * SIN[{}]]", self.expression(1)),
                false => write!(text, " [[{}] MOD 60]", self.expression(1)),
            };
        }
        self.line(&text);
        if self.dice.u8(..3) == 0 {
            let to = self.variable();
            self.line(&format!("{to} = [#<_value> + 1]"));
        }
    }

    fn movement(&mut self) {
        let codes = ["G0 ", "G1 ", "G90 G1 ", "G90 G0 ", "G91 G1 "];
        let code = self.one(&codes[..if self.common { 4 } else { 5 }]).to_owned();
        let mut text = code.clone();
        for letter in ['X', 'Y', 'Z'] {
            if self.dice.u8(..3) > 0 {
                let word = self.word(letter);
                let _ = write!(text, "{word} ");
            }
        }
        if text == code {
            let _ = write!(text, "X{} ", self.literal());
        }
        if self.dice.u8(..8) == 0 {
            let _ = write!(text, "F[{} + 5 * ABS[SIN[{}]]]", 20 + self.dice.u32(..200), self.variable());
        }
        if self.dice.u8(..14) == 0 {
            text = format!("G4 P[{} + ABS[COS[{}]]]", 1 + self.dice.u32(..5), self.expression(1));
        }
        self.line(text.trim_end());
    }
}
