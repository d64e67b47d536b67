//! Sinumerik text into units, blocks and words, from `reference/siemens.md` sections 1 and 2.
//!
//! What stands behind a block's label is read each time that it runs, with the values that variables have then: a
//! block that cannot be read stops the run only if it is reached. Not here: what words mean.

use super::shape::{self, Shape};
use super::variables::{Place, Variables, Worth};

/// A program of the text.
pub(super) struct Unit {
    /// Upper case, without `%_N_` and the type.
    pub(super) name: String,
    /// Its type is MPF, or the text has no headers.
    pub(super) main: bool,
    /// Its blocks, each with its line.
    pub(super) blocks: Vec<(usize, Block)>,
    /// Where its structures begin and end.
    pub(super) shape: Result<Shape, String>,
}

/// A block.
pub(super) struct Block {
    /// Place of its skip level in `Setup::skip`.
    pub(super) skip: Option<usize>,
    /// Upper case.
    pub(super) label: Option<String>,
    /// Its number with the letter or the colon, without zeros in front.
    pub(super) number: Option<String>,
    /// What stands behind that.
    pub(super) rest: Vec<char>,
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
    /// A variable gets a value, or several places from it on get theirs.
    Set(Place, Vec<Option<Worth>>),
    /// A variable of the control gets a value: its name, what stands in brackets, the value.
    Table(String, Vec<String>, f64),
}

/// An argument of a call.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Argument {
    Empty,
    /// With its place, if it is a variable alone.
    Number(f64, Option<Place>),
    /// An array as a whole, by its name.
    Array(String),
    Text,
}

/// Words of the drives, of look-ahead and of tolerances: the programmed path stays.
pub(super) const ADVICE: [&str; 40] = [
    "FFWON",
    "FNORM",
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
            units.push(Unit { name, main, blocks: Vec::new(), shape: Ok(Shape::default()) });
            continue;
        }
        let bare = comment_off(line);
        let bare = bare.trim();
        if bare.is_empty() || bare == "%" {
            continue;
        }
        if units.is_empty() {
            // The heading is no part of the program on the control (section 1).
            units.push(Unit {
                name: String::new(),
                main: true,
                blocks: Vec::new(),
                shape: Ok(Shape::default()),
            });
        }
        if let Some(unit) = units.last_mut() {
            unit.blocks.push((index + 1, block(bare)));
        }
    }
    for unit in &mut units {
        unit.shape = shape::of(&unit.blocks);
    }
    units
}

/// Parts a block from its head.
fn block(text: &str) -> Block {
    let none = Variables::default();
    let mut reader = Reader { text: &text.chars().collect::<Vec<_>>(), at: 0, variables: &none };
    let mut skip = None;
    if reader.take('/') {
        // `/` is `/0`, the first level; `/1` is one of its own behind the others.
        skip = Some(match reader.peek(0).to_digit(10) {
            None => 1,
            Some(digit) => {
                reader.at += 1;
                [1, 10, 2, 3, 4, 5, 6, 7, 8, 9][digit as usize]
            }
        });
        reader.blanks();
    }
    let mut label = reader.label();
    let mut number = None;
    let letter = reader.peek(0).to_ascii_uppercase();
    if label.is_none() && matches!(letter, ':' | 'N') && reader.peek(1).is_ascii_digit() {
        reader.at += 1;
        number = Some(format!("{letter}{}", reader.digits().trim_start_matches('0')));
        reader.blanks();
        label = reader.label();
    }
    reader.blanks();
    Block { skip, label, number, rest: reader.text[reader.at..].to_vec() }
}

/// The words of a block; variables have the values that they have before it.
pub(super) fn items(text: &[char], variables: &Variables) -> Result<Vec<Item>, String> {
    let mut reader = Reader { text, at: 0, variables };
    let mut items = Vec::new();
    while !reader.over() {
        items.push(reader.item()?);
    }
    Ok(items)
}

/// The words of a block; variables have the values that the words in front of each leave.
pub(super) fn items_in_order(text: &[char], variables: &mut Variables) -> Result<Vec<Item>, String> {
    let mut at = 0;
    let mut items = Vec::new();
    loop {
        let mut reader = Reader { text, at, variables };
        if reader.over() {
            return Ok(items);
        }
        let item = reader.item()?;
        at = reader.at;
        if let Item::Set(place, values) = &item {
            variables.set(place, values)?;
        }
        items.push(item);
    }
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

/// Reads a text, sign by sign.
pub(super) struct Reader<'t> {
    pub(super) text: &'t [char],
    pub(super) at: usize,
    pub(super) variables: &'t Variables,
}

impl<'t> Reader<'t> {
    pub(super) fn new(text: &'t [char], variables: &'t Variables) -> Reader<'t> {
        Reader { text, at: 0, variables }
    }

    /// Nothing but blanks is left.
    pub(super) fn over(&mut self) -> bool {
        self.blanks();
        self.at >= self.text.len()
    }

    pub(super) fn peek(&self, ahead: usize) -> char {
        self.text.get(self.at + ahead).copied().unwrap_or('\0')
    }

    pub(super) fn blanks(&mut self) {
        while self.peek(0).is_ascii_whitespace() {
            self.at += 1;
        }
    }

    pub(super) fn take(&mut self, c: char) -> bool {
        self.blanks();
        let found = self.peek(0) == c;
        self.at += usize::from(found);
        found
    }

    pub(super) fn digits(&mut self) -> String {
        let mut digits = String::new();
        while self.peek(0).is_ascii_digit() {
            digits.push(self.peek(0));
            self.at += 1;
        }
        digits
    }

    /// Two letters or underscores, then also digits.
    pub(super) fn name(&mut self) -> Option<String> {
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

    /// `$P_UIFR[1,X,TR]=100`
    fn table(&mut self) -> Result<Item, String> {
        self.at += 1;
        let name = self.name().ok_or("a $ alone")?;
        let mut which = Vec::new();
        if name == "P_UIFR" {
            let (number, axis) = self.frame_index()?;
            which = vec![number.to_string(), "XYZABC"[axis..=axis].to_owned(), "TR".to_owned()];
        } else if self.take('[') {
            loop {
                let mut one = String::new();
                self.blanks();
                while self.peek(0).is_ascii_alphanumeric() {
                    one.push(self.peek(0).to_ascii_uppercase());
                    self.at += 1;
                }
                which.push(one);
                if self.take(']') {
                    break;
                }
                if !self.take(',') {
                    return Err(format!("${name} without the end of its brackets"));
                }
            }
        }
        if !self.take('=') {
            return Err(format!("${name} alone"));
        }
        let value = self.expression()?.number()?;
        Ok(Item::Table(name, which, value))
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

    fn item(&mut self) -> Result<Item, String> {
        let start = self.at;
        if let Some(name) = self.name() {
            self.blanks();
            if self.variables.has(&name) {
                self.at = start;
                return self.assignment();
            }
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
        if self.peek(0) == '$' {
            return self.table();
        }
        let letter = self.peek(0).to_ascii_uppercase();
        if !letter.is_ascii_uppercase() {
            return Err(format!("unexpected {letter}"));
        }
        if letter == 'R' && (self.peek(1).is_ascii_digit() || self.peek(1) == '[') {
            return self.assignment();
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
        // `L20(7)`: as they are written, for zeros in front count.
        if letter == 'L' && !digits.is_empty() && self.peek(0) == '(' {
            return Ok(Item::Call(format!("L{digits}"), self.arguments()?));
        }
        // The first spindle is the master spindle.
        if digits == "1" && self.peek(0) == '=' && "SMT".contains(letter) {
            self.take('=');
            self.blanks();
            return match self.quoted() {
                Some(text) => Ok(Item::Quoted(letter, text)),
                None => {
                    let value = Value { number: self.amount()?, mark: Mark::None };
                    Ok(Item::Word(letter, value, String::new()))
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

    /// A variable's name is next.
    pub(super) fn names_variable(&mut self) -> bool {
        let start = self.at;
        let name = self.name();
        self.at = start;
        name.is_some_and(|name| self.variables.has(&name))
    }

    /// A text in quotation marks.
    pub(super) fn quoted(&mut self) -> Option<String> {
        let end = (self.at + 1..self.text.len()).find(|at| self.text[*at] == '"');
        let end = end.filter(|_| self.peek(0) == '"')?;
        let text = self.text[self.at + 1..end].iter().collect();
        self.at = end + 1;
        Some(text)
    }

    /// What stands behind `=`.
    fn assigned(&mut self) -> Result<Value, String> {
        self.take('=');
        self.blanks();
        let start = self.at;
        let mark = match self.name().as_deref() {
            // Which way round an axis goes leads to the same angle.
            Some("AC" | "DC" | "ACP" | "ACN") => Mark::Absolute,
            Some("IC") => Mark::Incremental,
            // An auxiliary function that is not waited for.
            Some("QU") => Mark::None,
            _ => {
                self.at = start;
                return Ok(Value { number: self.amount()?, mark: Mark::None });
            }
        };
        if !self.take('(') {
            return Err("AC or IC without parentheses".into());
        }
        let number = self.amount()?;
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

    pub(super) fn arguments(&mut self) -> Result<Vec<Argument>, String> {
        self.take('(');
        let mut arguments = Vec::new();
        loop {
            self.blanks();
            let start = self.at;
            arguments.push(match self.peek(0) {
                ',' | ')' => Argument::Empty,
                // A constant by its name.
                '_' if !self.names_variable() => {
                    let named = self.name().is_some();
                    if named { Argument::Text } else { return Err("a name of one sign".into()) }
                }
                _ if let Some(name) = self.array_alone() => Argument::Array(name),
                _ => match self.expression()? {
                    Worth::Number(number, _) => Argument::Number(number, self.only_place(start)),
                    Worth::Text(text) if text.is_empty() => Argument::Empty,
                    Worth::Text(_) => Argument::Text,
                },
            });
            if self.take(')') {
                return Ok(arguments);
            }
            if !self.take(',') {
                return Err("no end of arguments".into());
            }
        }
    }

    pub(super) fn number(&mut self) -> Result<f64, String> {
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
