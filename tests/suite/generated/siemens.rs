//! Programs of the Sinumerik's language by chance: types, arrays, structures, jumps, parts that are repeated,
//! subprograms with parameters. All of them come to an end.

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
    /// How deep in loops, and in structures with an end.
    loops: u32,
    inside: u32,
    statements: u32,
    /// What holds a real number, a whole one, or a truth, where the statements stand.
    reals: Vec<String>,
    wholes: Vec<String>,
    truths: Vec<String>,
    /// Counters of loops that are seen here, by their depth.
    counter: &'static str,
    /// Subprograms that can be called here.
    calls: usize,
    /// Made of what every control has that computes, so that it goes into the others with its structure.
    common: bool,
    /// What the subprogram's parameters are: whether each is a whole number.
    heads: Vec<Vec<bool>>,
}

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

impl Maker {
    pub(super) fn program(seed: u64) -> String {
        let mut maker = Maker {
            dice: Rng::with_seed(seed),
            text: String::new(),
            label: 0,
            loops: 0,
            inside: 0,
            statements: 0,
            reals: names(&["R1", "R2", "R3", "R10", "AA", "BB", "FF[0]", "FF[2]"]),
            wholes: names(&["II", "KK", "NN[1]"]),
            truths: names(&["ON", "OFF"]),
            counter: "COUNT",
            calls: 0,
            common: seed.is_multiple_of(2),
            heads: Vec::new(),
        };
        for _ in 0..maker.dice.usize(..3) {
            let head = (0..maker.dice.usize(..4)).map(|_| maker.dice.bool()).collect();
            maker.heads.push(head);
        }
        maker.calls = maker.heads.len();
        maker.line("%_N_CHANCE_MPF");
        let (a, b, c) = (maker.literal(), maker.literal(), maker.literal());
        let _ = writeln!(maker.text, "DEF INT II={}, KK, COUNT1, COUNT2, COUNT3", maker.dice.u32(..9));
        let _ = writeln!(maker.text, "DEF REAL AA={a}, BB");
        let _ = writeln!(maker.text, "DEF BOOL ON=TRUE, OFF");
        let _ = writeln!(maker.text, "DEF REAL FF[4]=({b},2.5,{c})");
        let _ = writeln!(maker.text, "DEF INT NN[3]=REP({})", maker.dice.u32(..5));
        maker.text.push_str("G17 G90 G94 G71 G54\nT3 M6\nD1\nS1000 M3\nG0 X0 Y0 Z50\nF200\n");
        for variable in ["R1", "R2", "R3", "R10"] {
            let value = maker.literal();
            let _ = writeln!(maker.text, "{variable}={value}");
        }
        for _ in 0..maker.dice.u32(2..9) {
            maker.statement();
        }
        maker.text.push_str("G90 G0 Z50\nM30\n");
        for program in 0..maker.heads.len() {
            maker.subprogram(program);
        }
        maker.text
    }

    fn subprogram(&mut self, program: usize) {
        let _ = writeln!(self.text, "%_N_SUB{program}_SPF");
        let head = self.heads[program].clone();
        self.reals = names(&["R1", "R2", "R3", "OWN"]);
        self.wholes = names(&["LAST"]);
        self.truths = names(&["FLAG"]);
        let mut parameters = Vec::new();
        for (place, whole) in head.iter().enumerate() {
            let name = format!("PAR{place}");
            parameters.push(format!("{} {name}", if *whole { "INT" } else { "REAL" }));
            if *whole { &mut self.wholes } else { &mut self.reals }.push(name);
        }
        match parameters.is_empty() {
            true => self.line(&format!("PROC SUB{program}")),
            false => self.line(&format!("PROC SUB{program}({})", parameters.join(", "))),
        }
        let value = self.literal();
        self.line(&format!("DEF REAL OWN={value}"));
        self.line("DEF INT LAST, OWNCOUNT1, OWNCOUNT2, OWNCOUNT3");
        self.line("DEF BOOL FLAG");
        // No one calls itself.
        (self.calls, self.counter, self.statements) = (program, "OWNCOUNT", MOST / 2);
        for _ in 0..self.dice.u32(1..5) {
            self.statement();
        }
        let end = self.one(&["RET", "M17"]);
        self.line(end);
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

    fn real_variable(&mut self) -> String {
        self.reals[self.dice.usize(..self.reals.len())].clone()
    }

    fn whole_variable(&mut self) -> String {
        self.wholes[self.dice.usize(..self.wholes.len())].clone()
    }

    fn truth_variable(&mut self) -> String {
        self.truths[self.dice.usize(..self.truths.len())].clone()
    }

    /// A whole number.
    fn whole(&mut self, deep: u32) -> String {
        if deep == 0 || self.dice.u8(..3) == 0 {
            return if self.dice.bool() { self.whole_variable() } else { self.dice.u32(..12).to_string() };
        }
        let (a, b) = (self.whole(deep - 1), self.whole(deep - 1));
        match if self.common { self.dice.u8(..3) } else { self.dice.u8(..11) } {
            0 => format!("({a}+{b})"),
            1 => format!("({a}-{b})"),
            2 => format!("{a}*{}", self.dice.u32(..4)),
            3 => format!("ABS({a}) DIV {}", 1 + self.dice.u32(..4)),
            4 => format!("ABS({a}) MOD {}", 1 + self.dice.u32(..9)),
            5 => format!("MINVAL({a},{b})"),
            6 => format!("MAXVAL({a},{b})"),
            7 => format!("BOUND(-3,{},{a})", 2 + self.dice.u32(..9)),
            8 => format!("(ABS({a}) {} ABS({b}))", self.one(&["B_AND", "B_OR", "B_XOR"])),
            9 => format!("-{}", self.whole_variable()),
            _ => format!("(7 {} {})", self.one(&["DIV", "MOD"]), 1 + self.dice.u32(..9)),
        }
    }

    /// A part of an expression.
    fn operand(&mut self, deep: u32) -> String {
        if deep == 0 {
            return match self.dice.u8(..6) {
                0 | 1 => self.literal().trim_start_matches('-').to_owned(),
                2 => self.whole_variable(),
                3 if self.dice.u8(..3) == 0 => self.truth_variable(),
                _ => self.real_variable(),
            };
        }
        let inner = deep - 1;
        match if self.common { self.dice.u8(..9) } else { self.dice.u8(..16) } {
            0..5 => self.operand(0),
            5 => format!("({}+{})", self.real(inner), self.operand(inner)),
            6 => format!("{}({})", self.one(&["SIN", "COS"]), self.real(inner)),
            7 => format!(
                "{}({})",
                self.one(if self.common { &["ABS"] } else { &["ABS", "TRUNC", "ROUND"] }),
                self.real(inner)
            ),
            8 => format!("SQRT(ABS({}))", self.real(0)),
            9 => format!("ATAN2({},{})", self.real(inner), 1 + self.dice.u32(..9)),
            10 => format!("POT({}/10)", self.operand(inner)),
            11 => match self.dice.u8(..5) {
                0 => format!("TAN(40*SIN({}))", self.real(0)),
                1 => format!("{}(SIN({}))", self.one(&["ASIN", "ACOS"]), self.real(0)),
                2 => format!("LN(1+ABS({}))", self.real(0)),
                3 => format!("EXP(SIN({}))", self.real(0)),
                _ => format!("ROUNDUP({})", self.real(0)),
            },
            12 => format!("{}({},{})", self.one(&["MINVAL", "MAXVAL"]), self.real(inner), self.operand(0)),
            13 => format!("BOUND(-20,30,{})", self.real(inner)),
            14 => format!("(ABS({}) {} {})", self.real(0), self.one(&["DIV", "MOD"]), 1 + self.dice.u32(..9)),
            _ => match self.dice.u8(..3) {
                0 => format!("({}{}{})", self.operand(0), self.one(&["<", ">", "<=", ">="]), self.operand(0)),
                1 => "$PI".to_owned(),
                _ => self.whole(inner),
            },
        }
    }

    /// A number, of any type.
    fn real(&mut self, deep: u32) -> String {
        let mut text = if self.dice.u8(..6) == 0 { "-".to_owned() } else { String::new() };
        text.push_str(&self.operand(deep));
        for _ in 0..self.dice.u32(..3) {
            let sign = self.one(&["+", "-", "*", "/", "+", "*"]).to_owned();
            let operand = match &*sign {
                // Seldom by what may be nothing.
                "/" if self.dice.u8(..20) > 0 => format!("{}", 1 + self.dice.u32(..9)),
                _ => self.operand(deep),
            };
            let _ = write!(text, "{sign}{operand}");
        }
        text
    }

    fn condition(&mut self) -> String {
        let how = self.one(&["==", "<>", ">", ">=", "<", "<="]).to_owned();
        let one = match self.dice.u8(..7) {
            0 => self.truth_variable(),
            1 => format!("{}{how}{}", self.whole(1), self.whole(1)),
            2 => format!("{}{how}{}", self.real_variable(), self.literal()),
            3 => format!("NOT {}", self.truth_variable()),
            _ => format!("{}{how}{}", self.real(1), self.real(1)),
        };
        if self.dice.u8(..5) > 0 {
            return one;
        }
        let and = self.one(&["AND", "OR", "XOR"]).to_owned();
        format!("({one}) {and} ({}<{})", self.real_variable(), self.operand(0))
    }

    fn assignment(&mut self) -> String {
        match self.dice.u8(..8) {
            0..6 if self.common => format!("{}=20*SIN({})", self.real_variable(), self.real(1)),
            6 if self.common => format!("{}=20*COS({})", self.whole_variable(), self.real(1)),
            0..4 => {
                let (to, mut value) = (self.real_variable(), self.real(2));
                if value.starts_with('(') && to.ends_with(']') {
                    // Else the brackets are those of several values.
                    value.insert_str(0, "0+");
                }
                if self.loops > 0 || self.dice.bool() {
                    format!("{to}=BOUND(-90,90,{value})")
                } else {
                    format!("{to}={value}")
                }
            }
            4 | 5 => format!("{}=BOUND(-50,50,{})", self.whole_variable(), self.whole(2)),
            // Rounded where it is set.
            6 => format!("{}=BOUND(-50,50,{})", self.whole_variable(), self.real(1)),
            _ => {
                let (to, value) = (self.truth_variable(), self.condition());
                format!("{to}=({value})")
            }
        }
    }

    fn word(&mut self, letter: char) -> String {
        match self.dice.u8(..6) {
            0 => format!("{letter}={}", self.real_variable()),
            1 => format!("{letter}=-{}", self.real_variable()),
            2 => format!("{letter}=10*SIN({})", self.real(2)),
            3 => format!("{letter}={}", self.whole(1)),
            _ if self.common => format!("{letter}=30*COS({})", self.real(1)),
            4 => format!("{letter}=BOUND(-99,99,{})", self.real(1)),
            _ => format!("{letter}=BOUND(-80,80,{})", self.real(2)),
        }
    }

    fn next_label(&mut self) -> String {
        self.label += 1;
        format!("LABEL_{}", self.label)
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
        match self.dice.u8(..20) {
            0..3 => {
                let text = self.assignment();
                self.line(&text);
            }
            3 | 4 => {
                let condition = self.condition();
                self.line(&format!("IF {condition}"));
                self.inside += 1;
                self.some(2);
                if self.dice.bool() {
                    self.line("ELSE");
                    self.some(2);
                }
                self.line("ENDIF");
                self.inside -= 1;
            }
            5 => {
                // Over some blocks.
                let (label, condition) = (self.next_label(), self.condition());
                let how = self.one(&["GOTOF", "GOTO"]).to_owned();
                self.line(&format!("IF {condition} {how} {label}"));
                self.some(2);
                let behind = if self.dice.bool() { self.assignment() } else { String::new() };
                self.line(&format!("{label}: {behind}"));
            }
            6 => {
                // One or the other.
                let (other, end) = (self.next_label(), self.next_label());
                let condition = self.condition();
                self.line(&format!("IF {condition} GOTOF {other}"));
                self.some(1);
                self.line(&format!("GOTOF {end}"));
                self.line(&format!("{other}:"));
                self.some(1);
                self.line(&format!("{end}:"));
            }
            7 => self.case(),
            8..12 if self.loops < 3 => self.turns(),
            12 if self.loops == 0 && self.inside == 0 => self.again(),
            13 | 14 if self.calls > 0 => self.call(),
            _ => self.movement(),
        }
    }

    fn case(&mut self) {
        let labels = [self.next_label(), self.next_label(), self.next_label(), self.next_label()];
        let what = self.whole(1);
        let [one, two, other, end] = &labels;
        let (a, b) = (self.dice.u32(..3), 3 + self.dice.u32(..3));
        let default = if self.dice.bool() { format!(" DEFAULT GOTOF {other}") } else { String::new() };
        self.line(&format!("CASE ({what}) OF {a} GOTOF {one} {b} GOTOF {two}{default}"));
        for label in [one, two] {
            self.some(1);
            self.line(&format!("GOTOF {end}"));
            self.line(&format!("{label}:"));
        }
        self.some(1);
        self.line(&format!("{other}:"));
        self.some(1);
        self.line(&format!("{end}:"));
    }

    fn turns(&mut self) {
        self.loops += 1;
        let counter = format!("{}{}", self.counter, self.loops);
        let turns = self.dice.u32(..4);
        // Seen in expressions while it counts; set by nothing else.
        let kind = self.dice.u8(..6);
        if kind == 0 {
            let (from, to) = (self.dice.u32(..3), self.dice.u32(..5));
            self.line(&format!("FOR {counter}={from} TO {to}"));
            self.inside += 1;
            self.movement_by(&counter);
            self.some(2);
            self.line("ENDFOR");
            self.inside -= 1;
        } else {
            self.line(&format!("{counter}=0"));
            let label = self.next_label();
            let (begin, end) = match kind {
                1 | 2 => (format!("WHILE {counter}<{turns}"), "ENDWHILE".to_owned()),
                3 => ("REPEAT".to_owned(), format!("UNTIL {counter}>={turns}")),
                4 => (format!("LOOP\nIF {counter}>={turns} GOTOF {label}"), format!("ENDLOOP\n{label}:")),
                _ => (format!("{label}:"), format!("IF {counter}<{turns} GOTOB {label}")),
            };
            self.line(&begin);
            self.inside += 1;
            self.some(2);
            self.inside -= 1;
            self.line(&format!("{counter}={counter}+1"));
            self.line(&end);
        }
        self.loops -= 1;
    }

    /// A part of the program that is repeated.
    fn again(&mut self) {
        let (first, last) = (self.next_label(), self.next_label());
        let far = self.dice.u32(..20);
        self.line(&format!("{first}: G90 G1 X={far}"));
        // No label within, and no loop: nothing leads out of it. It finds the modes in force that it leaves.
        for _ in 0..self.dice.u32(1..4) {
            if self.dice.bool() {
                let text = self.assignment();
                self.line(&text);
            } else {
                self.movement_in("G90 G1 ");
            }
        }
        let (deep, times) = (self.dice.u32(..20), 1 + self.dice.u32(..2));
        self.line(&format!("{last}: G90 G1 Z={deep}"));
        self.movement_in("G90 G1 ");
        match self.dice.u8(..3) {
            0 => self.line(&format!("REPEATB {last} P={times}")),
            _ => self.line(&format!("REPEAT {first} {last} P={times}")),
        }
    }

    fn call(&mut self) {
        let program = self.dice.usize(..self.calls);
        let mut arguments = Vec::new();
        for whole in self.heads[program].clone() {
            arguments.push(match whole {
                true => self.whole(1),
                false => format!("40*SIN({})", self.real(1)),
            });
        }
        match arguments.is_empty() {
            true => self.line(&format!("SUB{program}")),
            false => self.line(&format!("SUB{program}({})", arguments.join(","))),
        }
    }

    fn movement_by(&mut self, counter: &str) {
        let far = self.literal();
        self.line(&format!("G1 X={counter}*{}", far.trim_start_matches('-')));
    }

    fn movement(&mut self) {
        let codes = ["", "G0 ", "G1 ", "G90 ", "G90 G0 ", "G91 G1 "];
        let code = self.one(&codes[..if self.common { 5 } else { 6 }]).to_owned();
        self.movement_in(&code);
    }

    fn movement_in(&mut self, code: &str) {
        let mut text = code.to_owned();
        for letter in ['X', 'Y', 'Z'] {
            if self.dice.u8(..3) > 0 {
                let word = self.word(letter);
                let _ = match self.dice.u8(..12) {
                    _ if self.common => write!(text, "{word} "),
                    0 => write!(text, "{} ", word.replacen('=', "=IC(", 1) + ")"),
                    1 => write!(text, "{} ", word.replacen('=', "=AC(", 1) + ")"),
                    _ => write!(text, "{word} "),
                };
            }
        }
        if text == code && self.dice.u8(..20) > 0 {
            let _ = write!(text, "X{} ", self.literal());
        }
        if self.dice.u8(..8) == 0 {
            let _ = write!(text, "F={}+5*ABS(SIN({}))", 20 + self.dice.u32(..200), self.real_variable());
        }
        if self.dice.u8(..14) == 0 {
            text = format!("G4 F={}+ABS(COS({}))", 1 + self.dice.u32(..5), self.real(1));
        }
        if !text.trim().is_empty() {
            self.line(text.trim_end());
        }
    }
}
