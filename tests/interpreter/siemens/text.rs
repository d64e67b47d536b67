//! Sinumerik text into units, blocks and words, from `reference/siemens.md` sections 1 and 2.
//!
//! A block that cannot be read is kept as such: it stops the run only if it is reached. Not here:
//! what words mean.

/// A program of the text.
pub(super) struct Unit {
    /// Upper case, without `%_N_` and the type.
    pub(super) name: String,
    /// Its type is MPF, or the text has no headers.
    pub(super) main: bool,
    /// Its blocks, each with its line.
    pub(super) blocks: Vec<(usize, Result<Block, String>)>,
}

/// A block.
pub(super) struct Block {
    /// Place of its skip level in `Setup::skip`.
    pub(super) skip: Option<usize>,
    /// Upper case.
    pub(super) label: Option<String>,
    /// Its words.
    pub(super) items: Vec<Item>,
}

/// How a number is marked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Mark {
    /// Not at all.
    None,
    /// `AC(…)`.
    Absolute,
    /// `IC(…)`.
    Incremental,
}

/// A number with its mark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Value {
    pub(super) number: f64,
    pub(super) mark: Mark,
}

/// A word or what stands in its place. Names are in upper case.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Item {
    /// One letter and a value; the digits as written.
    Word(char, Value, String),
    /// More than one letter, or a letter and a number, then `=`.
    Named(String, Value),
    /// One letter and a text behind `=`.
    Quoted(char, String),
    /// A name alone.
    Name(String),
    /// A name with arguments.
    Call(String, Vec<Argument>),
}

/// An argument of a call.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Argument {
    Empty,
    Number(f64),
    Text,
}

/// Words of the drives, of look-ahead and of tolerances: the programmed path stays.
pub(super) const ADVICE: [&str; 39] = [
    "FFWON",
    "FFWOF",
    "SOFT",
    "BRISK",
    "DRIVE",
    "COMPOF",
    "COMPON",
    "COMPCURV",
    "COMPCAD",
    "COMPSURF",
    "CFC",
    "CFTCP",
    "CFIN",
    "NORM",
    "KONT",
    "KONTC",
    "KONTT",
    "CUT2D",
    "CUT2DF",
    "CDON",
    "CDOF",
    "CDOF2",
    "DYNNORM",
    "DYNPOS",
    "DYNROUGH",
    "DYNSEMIFIN",
    "DYNFINISH",
    "DIAMOF",
    "CP",
    "SPATH",
    "UPATH",
    "STARTFIFO",
    "STOPFIFO",
    "FIFOCTRL",
    "STOPRE",
    "ORIWKS",
    "ORIMKS",
    "WALIMON",
    "WALIMOF",
];

/// Calls that show something and move nothing: the blank of the simulation, folds of the editor.
pub(super) const NOTHING: [&str; 3] = ["WORKPIECE", "GROUP_BEGIN", "GROUP_END"];

/// Parts a text.
pub(super) fn units(text: &str) -> Vec<Unit> {
    let mut units: Vec<Unit> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        if let Some((name, main)) = header(line) {
            units.push(Unit { name, main, blocks: Vec::new() });
            continue;
        }
        let bare = comment_off(line);
        let bare = bare.trim();
        if bare.is_empty() || bare == "%" {
            continue;
        }
        if units.is_empty() {
            // The heading is no part of the program on the control (section 1).
            units.push(Unit { name: String::new(), main: true, blocks: Vec::new() });
        }
        if let Some(unit) = units.last_mut() {
            unit.blocks.push((index + 1, Reader { text: bare.chars().collect(), at: 0 }.block()));
        }
    }
    units
}

/// Name of the unit that a line opens, and whether it is a main program.
fn header(line: &str) -> Option<(String, bool)> {
    let rest = line.trim().strip_prefix("%_N_")?;
    let rest: String = rest.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
    let rest = rest.to_ascii_uppercase();
    match (rest.strip_suffix("_MPF"), rest.strip_suffix("_SPF")) {
        (Some(name), _) => Some((name.to_owned(), true)),
        (_, Some(name)) => Some((name.to_owned(), false)),
        _ => Some((rest, false)),
    }
}

fn comment_off(line: &str) -> String {
    let mut inside = false;
    line.chars()
        .take_while(|c| {
            inside ^= *c == '"';
            inside || *c != ';'
        })
        .collect()
}

struct Reader {
    text: Vec<char>,
    at: usize,
}

impl Reader {
    fn peek(&self, ahead: usize) -> char {
        self.text.get(self.at + ahead).copied().unwrap_or('\0')
    }

    fn blanks(&mut self) {
        while self.peek(0).is_ascii_whitespace() {
            self.at += 1;
        }
    }

    fn take(&mut self, c: char) -> bool {
        self.blanks();
        let found = self.peek(0) == c;
        self.at += usize::from(found);
        found
    }

    fn digits(&mut self) -> String {
        let mut digits = String::new();
        while self.peek(0).is_ascii_digit() {
            digits.push(self.peek(0));
            self.at += 1;
        }
        digits
    }

    /// Two letters or underscores, then also digits.
    fn name(&mut self) -> Option<String> {
        let letter = |c: char| c.is_ascii_alphabetic() || c == '_';
        if !(letter(self.peek(0)) && letter(self.peek(1))) {
            return None;
        }
        let mut name = String::new();
        while letter(self.peek(0)) || self.peek(0).is_ascii_digit() {
            name.push(self.peek(0).to_ascii_uppercase());
            self.at += 1;
        }
        Some(name)
    }

    fn label(&mut self) -> Option<String> {
        let start = self.at;
        let name = self.name();
        if name.is_some() && self.take(':') {
            return name;
        }
        self.at = start;
        None
    }

    fn block(mut self) -> Result<Block, String> {
        let mut skip = None;
        if self.take('/') {
            // `/` is `/0`, the first level; `/1` is one of its own behind the others.
            skip = Some(match self.peek(0).to_digit(10) {
                None => 1,
                Some(digit) => {
                    self.at += 1;
                    [1, 10, 2, 3, 4, 5, 6, 7, 8, 9][digit as usize]
                }
            });
            self.blanks();
        }
        let mut label = self.label();
        let numbered = self.peek(0) == ':' || self.peek(0).eq_ignore_ascii_case(&'N');
        if label.is_none() && numbered && self.peek(1).is_ascii_digit() {
            self.at += 1;
            self.digits();
            self.blanks();
            label = self.label();
        }
        let mut items = Vec::new();
        loop {
            self.blanks();
            if self.at == self.text.len() {
                return Ok(Block { skip, label, items });
            }
            items.push(self.item()?);
        }
    }

    fn item(&mut self) -> Result<Item, String> {
        if let Some(name) = self.name() {
            self.blanks();
            return match self.peek(0) {
                '(' if NOTHING.contains(&name.to_ascii_uppercase().as_str()) => {
                    self.parentheses()?;
                    Ok(Item::Call(name, Vec::new()))
                }
                '(' => Ok(Item::Call(name, self.arguments()?)),
                '=' => Ok(Item::Named(name, self.assigned()?)),
                _ => Ok(Item::Name(name)),
            };
        }
        let letter = self.peek(0).to_ascii_uppercase();
        if !letter.is_ascii_uppercase() {
            return Err(format!("unexpected {letter}"));
        }
        self.at += 1;
        self.blanks();
        if self.peek(0) == '=' {
            let start = self.at;
            self.take('=');
            self.blanks();
            if let Some(text) = self.quoted() {
                return Ok(Item::Quoted(letter, text));
            }
            self.at = start;
            return Ok(Item::Word(letter, self.assigned()?, String::new()));
        }
        let start = self.at;
        let digits = self.digits();
        self.blanks();
        // The first spindle is the master spindle.
        if digits == "1" && self.peek(0) == '=' && "SMT".contains(letter) {
            self.take('=');
            self.blanks();
            return match self.quoted() {
                Some(text) => Ok(Item::Quoted(letter, text)),
                None => {
                    Ok(Item::Word(letter, Value { number: self.number()?, mark: Mark::None }, String::new()))
                }
            };
        }
        if !digits.is_empty() && self.peek(0) == '=' {
            return Ok(Item::Named(format!("{letter}{digits}"), self.assigned()?));
        }
        self.at = start;
        let number = self.number()?;
        let written = self.text[start..self.at].iter().collect();
        Ok(Item::Word(letter, Value { number, mark: Mark::None }, written))
    }

    /// A text in quotation marks.
    fn quoted(&mut self) -> Option<String> {
        let end = (self.at + 1..self.text.len()).find(|at| self.text[*at] == '"');
        let end = end.filter(|_| self.peek(0) == '"')?;
        let text = self.text[self.at + 1..end].iter().collect();
        self.at = end + 1;
        Some(text)
    }

    fn assigned(&mut self) -> Result<Value, String> {
        self.take('=');
        self.blanks();
        let mark = match self.name().as_deref() {
            None => return Ok(Value { number: self.number()?, mark: Mark::None }),
            // Which way round an axis goes leads to the same angle.
            Some("AC" | "DC" | "ACP" | "ACN") => Mark::Absolute,
            Some("IC") => Mark::Incremental,
            Some(other) => return Err(format!("an expression: {other}")),
        };
        if !self.take('(') {
            return Err("AC or IC without parentheses".into());
        }
        self.blanks();
        let number = self.number()?;
        if !self.take(')') {
            return Err("an expression in parentheses".into());
        }
        Ok(Value { number, mark })
    }

    /// What stands in parentheses, whatever it is.
    fn parentheses(&mut self) -> Result<(), String> {
        let (mut depth, mut quoted) = (0, false);
        while self.at < self.text.len() {
            let sign = self.peek(0);
            self.at += 1;
            quoted ^= sign == '"';
            match sign {
                '(' if !quoted => depth += 1,
                ')' if !quoted && depth == 1 => return Ok(()),
                ')' if !quoted => depth -= 1,
                _ => {}
            }
        }
        Err("no end of arguments".into())
    }

    fn arguments(&mut self) -> Result<Vec<Argument>, String> {
        self.take('(');
        let mut arguments = Vec::new();
        loop {
            self.blanks();
            arguments.push(match self.peek(0) {
                ',' | ')' => Argument::Empty,
                '"' => {
                    self.at += 1;
                    while self.peek(0) != '"' {
                        if self.at >= self.text.len() {
                            return Err("a string without an end".into());
                        }
                        self.at += 1;
                    }
                    self.at += 1;
                    Argument::Text
                }
                // A constant by its name.
                '_' => {
                    let named = self.name().is_some();
                    if named { Argument::Text } else { return Err("a name of one sign".into()) }
                }
                _ => Argument::Number(self.number()?),
            });
            if self.take(')') {
                return Ok(arguments);
            }
            if !self.take(',') {
                return Err("an expression as an argument, or no end of arguments".into());
            }
        }
    }

    fn number(&mut self) -> Result<f64, String> {
        let mut text = String::new();
        if matches!(self.peek(0), '+' | '-') {
            text.push(self.peek(0));
            self.at += 1;
        }
        text.push_str(&self.digits());
        if self.peek(0) == '.' {
            self.at += 1;
            text.push('.');
            text.push_str(&self.digits());
        }
        if self.peek(0).eq_ignore_ascii_case(&'E') && self.peek(1).eq_ignore_ascii_case(&'X') {
            self.at += 2;
            text.push('e');
            if matches!(self.peek(0), '+' | '-') {
                text.push(self.peek(0));
                self.at += 1;
            }
            text.push_str(&self.digits());
        }
        text.parse().map_err(|_| format!("no number: {text}{}", self.peek(0)))
    }
}
