//! Programs of a Fanuc's custom macro B by chance: expressions, decisions, loops and calls, all of which come to an
//! end.

use std::fmt::Write;

use fastrand::Rng;

/// Makes a program.
pub(super) struct Maker {
    dice: Rng,
    text: String,
    /// The next block number.
    number: u32,
    /// How deep in loops.
    loops: u32,
    blocks: u32,
    /// Which program: each counts its turns in variables of its own, which a subprogram shares with its caller.
    program: u32,
    /// Made of what every control has that computes, so that it goes into the others with its structure.
    common: bool,
    /// The first so many variables are in use.
    variables: usize,
}

/// Variables that hold something, of every kind; `#20` and `#21` never get a value.
const VARIABLES: [&str; 9] = ["#101", "#102", "#500", "#1", "#2", "#3", "#4", "#5", "#6"];

/// How many of them are common to all levels.
const SHARED: usize = 3;

impl Maker {
    pub(super) fn program(seed: u64) -> String {
        let mut maker = Maker {
            dice: Rng::with_seed(seed),
            text: String::new(),
            number: 100,
            loops: 0,
            blocks: 0,
            program: 0,
            common: seed.is_multiple_of(2),
            variables: VARIABLES.len(),
        };
        let inches = maker.dice.u8(..5) == 0;
        let unit = if inches { "G20" } else { "G21" };
        let _ = write!(
            maker.text,
            "%\nO1\n{unit} G17 G40 G49 G80 G94\nT3 M6\nG90 G54 G0 X0 Y0 S1000 M3\nG43 H3 Z50.\nF200.\n"
        );
        for variable in VARIABLES {
            let value = maker.literal();
            let _ = writeln!(maker.text, "{variable} = {value}");
        }
        for _ in 0..maker.dice.u32(2..9) {
            maker.statement(2);
        }
        if maker.common {
            // What nothing calls has parameters of which nothing is known.
            maker.macro_call(8101);
            maker.macro_call(8102);
            maker.line("M98 P8103");
        }
        maker.text.push_str("G90 G0 Z50.\nM30\n");
        for macro_number in [8101, 8102, 8103] {
            let _ = writeln!(maker.text, "O{macro_number}");
            if macro_number == 8103 && maker.common {
                // Called by M98 alone, where a level of its own has other variables than its caller's.
                maker.variables = SHARED;
            }
            maker.number = 100;
            maker.program += 1;
            for _ in 0..maker.dice.u32(1..5) {
                // No call within: they end.
                maker.statement(0);
            }
            maker.text.push_str("M99\n");
        }
        maker.text.push_str("%\n");
        maker.text
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

    fn variable(&mut self) -> &'static str {
        match self.dice.u8(..12) {
            0 if !self.common => ["#20", "#21", "#0"][self.dice.usize(..3)],
            _ => VARIABLES[self.dice.usize(..self.variables)],
        }
    }

    fn bare(&mut self) -> String {
        match self.dice.u8(..3) {
            // A sign stands in front of a whole expression alone.
            0 => self.literal().trim_start_matches('-').to_owned(),
            _ => self.variable().to_owned(),
        }
    }

    fn operand(&mut self, deep: u32) -> String {
        if deep == 0 {
            return self.bare();
        }
        match self.dice.u8(..9) {
            0..4 => self.bare(),
            4 => format!("[{} + {}]", self.expression(deep - 1), self.bare()),
            5 => {
                let name = ["SIN", "COS", "ABS", "ROUND", "FIX", "FUP"]
                    [self.dice.usize(..if self.common { 4 } else { 6 })];
                format!("{name}[{}]", self.expression(deep - 1))
            }
            6 => format!("SQRT[ABS[{}]]", self.expression(0)),
            7 if !self.common => format!("ATAN[{}]/[{}]", self.expression(deep - 1), 1 + self.dice.u32(..9)),
            _ => format!("[{} MOD {}]", self.dice.u32(..40), 1 + self.dice.u32(..9)),
        }
    }

    /// The same within brackets: whether what has no value has none there, nothing tells.
    fn bracketed(&mut self, deep: u32) -> String {
        let text = self.expression(deep);
        if text.starts_with('#') && !text.contains(' ') { format!("{text} + 0") } else { text }
    }

    /// An expression with up to four operands, in every order of priorities.
    fn expression(&mut self, deep: u32) -> String {
        let mut text = if self.dice.u8(..6) == 0 { "-".to_owned() } else { String::new() };
        text.push_str(&self.operand(deep));
        for _ in 0..self.dice.u32(..3) {
            let sign = ["+", "-", "*", "/", "+", "*"][self.dice.usize(..6)];
            let operand = match sign {
                // Seldom by what may be nothing.
                "/" if self.dice.u8(..20) > 0 => format!("{}.", 1 + self.dice.u32(..9)),
                _ => self.operand(deep),
            };
            let _ = write!(text, " {sign} {operand}");
        }
        text
    }

    fn condition(&mut self) -> String {
        let how = ["EQ", "NE", "GT", "GE", "LT", "LE"][self.dice.usize(..6)];
        let one = match self.dice.u8(..4) {
            0 if !self.common => format!("{} {how} #0", self.variable()),
            1 => format!("{} {how} {}", self.variable(), self.literal().trim_start_matches('-')),
            _ => format!("{} {how} {}", self.expression(1), self.expression(1)),
        };
        if self.dice.u8(..5) > 0 {
            return one;
        }
        let and = ["AND", "OR", "XOR"][self.dice.usize(..3)];
        format!("[{one}] {and} [{} LT {}]", self.variable(), self.bare())
    }

    /// A word of an axis, of which the value is not too large.
    fn word(&mut self, letter: char) -> String {
        match self.dice.u8(..5) {
            0 => format!("{letter}{}", self.variable()),
            1 => format!("{letter}-{}", self.variable()),
            2 => format!("{letter}[10 * SIN[{}]]", self.expression(2)),
            3 => format!("{letter}-[{}]", self.bracketed(1)),
            _ => format!("{letter}[{}]", self.bracketed(2)),
        }
    }

    fn assignment(&mut self) -> String {
        let to = VARIABLES[self.dice.usize(..self.variables)];
        format!("{to} = {}", self.expression(2))
    }

    fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    fn next_number(&mut self) -> u32 {
        self.number += 10;
        self.number
    }

    /// A statement; `calls` says how deep it may call.
    fn statement(&mut self, calls: u32) {
        self.blocks += 1;
        if self.blocks > 60 {
            return self.movement();
        }
        match self.dice.u8(..12) {
            0 | 1 => {
                let text = self.assignment();
                self.line(&text);
            }
            2 => {
                let text = format!("IF [{}] THEN {}", self.condition(), self.assignment());
                self.line(&text);
            }
            3 => {
                // Over some blocks.
                let number = self.next_number();
                let text = format!("IF [{}] GOTO {number}", self.condition());
                self.line(&text);
                for _ in 0..self.dice.u32(1..3) {
                    self.statement(calls);
                }
                let behind = if self.dice.bool() { self.assignment() } else { String::new() };
                self.line(&format!("N{number} {behind}"));
            }
            4 => {
                // One or the other.
                let (other, end) = (self.next_number(), self.next_number());
                let text = format!("IF [{}] GOTO {other}", self.condition());
                self.line(&text);
                self.statement(calls);
                self.line(&format!("GOTO {end}"));
                self.line(&format!("N{other}"));
                self.statement(calls);
                self.line(&format!("N{end}"));
            }
            5 | 6 if self.loops < 3 => self.turns(calls),
            7 if self.loops < 2 => {
                // A loop by a jump back; its turns are counted in a variable of this level alone.
                let counter = self.counter(27, 2) + self.loops;
                let number = self.next_number();
                self.line(&format!("#{counter} = 0"));
                self.line(&format!("N{number} #{counter} = #{counter} + 1"));
                self.loops += 1;
                self.statement(calls);
                self.loops -= 1;
                let turns = self.dice.u32(1..4);
                self.line(&format!("IF [#{counter} LT {turns}] GOTO {number}"));
            }
            8 if calls > 0 => self.call(),
            _ => self.movement(),
        }
    }

    /// Where the counters of this program begin, of a kind of which each has so many: locals from there on, or common.
    fn counter(&self, first: u32, many: u32) -> u32 {
        match self.program {
            3 => 110 + first,
            program => first + many * program,
        }
    }

    /// WHILE, or DO that is left by a jump.
    fn turns(&mut self, calls: u32) {
        self.loops += 1;
        let (level, counter) = (self.loops, self.counter(10, 3) + self.loops);
        let turns = self.dice.u32(..4);
        self.line(&format!("#{counter} = 0"));
        let end = self.next_number();
        let left = self.dice.u8(..3) == 0;
        match left {
            true => {
                self.line(&format!("DO{level}"));
                self.line(&format!("IF [#{counter} GE {turns}] GOTO {end}"));
            }
            false => self.line(&format!("WHILE [#{counter} LT {turns}] DO{level}")),
        }
        for _ in 0..self.dice.u32(1..3) {
            self.statement(calls);
        }
        self.line(&format!("#{counter} = #{counter} + 1"));
        self.line(&format!("END{level}"));
        if left {
            self.line(&format!("N{end}"));
        }
        self.loops -= 1;
    }

    fn call(&mut self) {
        if self.dice.u8(..3) == 0 {
            let number = if self.common { 8103 } else { 8101 + self.dice.u32(..3) };
            let text = if self.dice.bool() { format!("M98 P{number}") } else { format!("M98 P2{number}") };
            return self.line(&text);
        }
        let number = 8101 + self.dice.u32(..2);
        self.macro_call(number);
    }

    fn macro_call(&mut self, number: u32) {
        let mut text = format!("G65 P{number}");
        if self.dice.u8(..4) == 0 {
            text.push_str(" L2");
        }
        // What is read must be set before: `A` to `C`, and two sets of `I`, `J` and `K`.
        for letter in ['A', 'B', 'C', 'I', 'J', 'K', 'I', 'J', 'D', 'Z', 'X'] {
            let read = matches!(letter, 'A' | 'B' | 'C' | 'I' | 'J' | 'K');
            if !(self.common && read) && self.dice.u8(..3) == 0 {
                continue;
            }
            let value = match self.dice.u8(..4) {
                0 => self.variable().to_owned(),
                // `ROUND` as an argument is open.
                1 => format!("[{} * {}]", self.bare(), self.bare()),
                2 => format!("-{}", self.variable()),
                _ => format!("{}.{}", self.dice.u32(..20), self.dice.u32(..100)),
            };
            let _ = write!(text, " {letter}{value}");
        }
        self.line(&text);
    }

    fn movement(&mut self) {
        let code = ["", "G0 ", "G1 ", "G91 G1 ", "G90 ", "G90 G0 "][self.dice.usize(..6)];
        let mut text = code.to_owned();
        for letter in ['X', 'Y', 'Z'] {
            if self.dice.u8(..3) > 0 {
                let word = self.word(letter);
                let _ = write!(text, "{word} ");
            }
        }
        // A code without a move is seldom: behind it, axis words alone are refused at a jump.
        if text == code && self.dice.u8(..40) > 0 {
            let _ = write!(text, "X{} ", self.literal());
        }
        if self.dice.u8(..8) == 0 {
            let _ = write!(text, "F[{} + 5 * ABS[SIN[{}]]]", 20 + self.dice.u32(..200), self.variable());
        }
        // A Haas does not say what a computed one counts.
        if self.dice.u8(..if self.common { 80 } else { 12 }) == 0 {
            text = format!("G4 P[{} + 100 * ABS[COS[{}]]]", 1 + self.dice.u32(..500), self.expression(1));
        }
        if !text.trim().is_empty() {
            self.line(text.trim_end());
        }
    }
}
