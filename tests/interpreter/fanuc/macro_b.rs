//! Custom macro B, from the section on it in `reference/fanuc.md`, the 16i operator's manual (B-63684EN, chapter
//! 16) and, for what has no value, the table of the Mitsubishi M700V manual: variables, assignments, jumps, loops
//! and calls with arguments. A block is looked at as text each time it is run.

mod formula;

use std::collections::BTreeMap;

use formula::{Formula, Worth};

use super::super::next_run::Left;
use super::super::{Halt, What};
use super::programs::{Program, TEXT};
use super::{Control, Next, Word};

/// What ROUND means in an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rounding {
    /// To a whole number: in assignments and conditions, and in words that are whole.
    Whole,
    /// To so many digits: in words.
    To(i32),
    /// It is not known.
    Open,
}

/// Local variables of a level by their numbers; place 0 is not used.
type Locals = [Option<f64>; 34];

/// A macro that is called behind each block that moves an axis (B-63684EN, 16.7.2): its program, how often, and what the
/// arguments of its block were worth.
#[derive(Clone, Debug)]
pub(super) struct Modal {
    program: String,
    times: u32,
    local: Locals,
}

/// The variables of a control.
#[derive(Clone, Debug)]
pub(super) struct Variables {
    /// The local ones of each level of macro calls, the present one last.
    local: Vec<Locals>,
    /// Those that all programs share, as far as they were set.
    shared: BTreeMap<u32, Option<f64>>,
    /// They are a Haas': by the VF series manual (96-8000, June 1999, p. 365 to 376) its macros are these, with fewer
    /// functions and variables, and the words that a macro computes are rounded (Address Substitution, diy.haascnc.com).
    haas: bool,
    /// Those of the control that a block names or may compute, as they are at its beginning.
    own: BTreeMap<u32, f64>,
}

impl Default for Variables {
    fn default() -> Variables {
        Variables { local: vec![[None; 34]], shared: BTreeMap::new(), haas: false, own: BTreeMap::new() }
    }
}

impl Variables {
    /// Those that a program finds on a Haas, or on a Fanuc.
    pub(super) fn found(haas: bool, left: &Left) -> Variables {
        let shared = left.stored.variables.iter().map(|(number, value)| (*number, Some(*value))).collect();
        Variables { haas, shared, ..Variables::default() }
    }

    /// What it leaves in those that all programs share.
    pub(super) fn left(&self) -> BTreeMap<u32, f64> {
        self.shared.iter().filter_map(|(number, value)| Some((*number, (*value)?))).collect()
    }

    fn read(&self, number: u32) -> Result<Option<f64>, String> {
        match number {
            0 => Ok(None),
            1..=33 => Ok(self.local[self.local.len() - 1][number as usize]),
            100..=199 | 500..=999 => match self.shared.get(&number) {
                Some(value) => Ok(*value),
                // What ran before may have left something in it.
                None => Err(format!("#{number} is read before it is set")),
            },
            _ => self.own.get(&number).map(|n| Some(*n)).ok_or(format!("the system variable #{number}")),
        }
    }

    fn write(&mut self, number: u32, value: Option<f64>) -> Result<(), String> {
        match number {
            600.. if self.haas => return Err(format!("#{number} of a Haas is set")),
            1..=33 => {
                let level = self.local.len() - 1;
                self.local[level][number as usize] = value;
            }
            100..=199 | 500..=999 => drop(self.shared.insert(number, value)),
            _ => return Err(format!("#{number} is set")),
        }
        Ok(())
    }
}

/// To the nearest whole number; halves go away from zero.
fn round(n: f64) -> f64 {
    round_to(n, 0)
}

/// To so many digits.
fn round_to(n: f64, digits: i32) -> f64 {
    let steps = 10f64.powi(digits);
    let scaled = n.abs() * steps;
    // Half a step and more goes up.
    let down = scaled.floor();
    let whole = if scaled - down >= 0.5 { down + 1.0 } else { down };
    n.signum() * whole / steps
}

/// A block as far as a macro statement is told from other blocks: what is before its first word.
struct Head<'b> {
    rest: &'b str,
    number: Option<u32>,
    skips: Vec<usize>,
}

fn head(block: &str) -> Head<'_> {
    let mut head = Head { rest: block, number: None, skips: Vec::new() };
    loop {
        if let Some(rest) = head.rest.strip_prefix('/') {
            let level = rest.chars().next().and_then(|c| c.to_digit(10)).filter(|n| *n > 0);
            head.rest = if level.is_some() { &rest[1..] } else { rest };
            head.skips.push(level.unwrap_or(1) as usize);
            continue;
        }
        let Some(rest) = head.rest.strip_prefix('N') else { return head };
        let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        head.number = rest[..end].parse().ok();
        head.rest = &rest[end..];
    }
}

/// A keyword at the front of a text, of which the control looks at the first two letters, and what is behind it.
fn keyword<'t>(text: &'t str, word: &str) -> Option<&'t str> {
    let end = text.find(|c: char| !c.is_ascii_uppercase()).unwrap_or(text.len());
    let found = &text[..end];
    if word == "DO" || word == "END" || word == "GOTO" || word == "WHILE" || word == "IF" || word == "THEN" {
        if found == word {
            return Some(&text[word.len()..]);
        }
        // DO and GOTO may stand before what is no digit.
        return text.strip_prefix(word).or_else(|| (found == &word[..2]).then(|| &text[2..]));
    }
    None
}

/// Which loop a block begins (true) or ends.
fn loop_mark(block: &str) -> Option<(bool, u32)> {
    let mut rest = head(block).rest;
    if let Some(inside) = keyword(rest, "WHILE") {
        rest = &inside[closing(inside)?..];
    }
    let (begins, digits) = match (keyword(rest, "DO"), keyword(rest, "END")) {
        (Some(digits), _) => (true, digits),
        (None, Some(digits)) => (false, digits),
        _ => return None,
    };
    Some((begins, digits.parse().ok()?))
}

/// Where the bracket that a text begins with is over.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0;
    for (at, c) in text.char_indices() {
        match c {
            '[' => depth += 1,
            ']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return (c == ']').then_some(at + 1);
        }
    }
    None
}

/// Loops of a program: where each begins and ends.
pub(super) fn loops(blocks: &[(usize, String)]) -> Result<Vec<(usize, usize)>, Halt> {
    let mut open: Vec<(u32, usize)> = Vec::new();
    let mut found = Vec::new();
    for (at, (line, block)) in blocks.iter().enumerate() {
        let halt = |why: &str| Err(Halt { line: *line, why: why.to_owned() });
        match loop_mark(block) {
            None => {}
            Some((true, number)) => {
                if !(1..=3).contains(&number) || open.iter().any(|(other, _)| *other == number) {
                    return halt("a loop in itself, or of another number than 1, 2, 3");
                }
                open.push((number, at));
            }
            Some((false, number)) => match open.pop() {
                Some((other, from)) if other == number => found.push((from, at)),
                _ => return halt("an END of another loop"),
            },
        }
    }
    match open.is_empty() {
        true => Ok(found),
        false => Err(Halt { line: 0, why: "a DO without its END".into() }),
    }
}

/// What a macro statement does to the order of blocks.
pub(super) enum Go {
    /// It is none.
    Not,
    /// On with the next block.
    On,
    /// To the block of a number.
    To(u32),
    /// Behind the end of the loop that begins here.
    Behind,
    /// Back to where the loop begins that ends here.
    Again,
    /// To the block of a computed number; an alarm where there is none.
    Perhaps(u32),
    /// Nowhere: an alarm.
    Alarm,
}

/// Where a jump leads: forward first, then from the top; never into a loop.
pub(super) fn jump(
    blocks: &[(usize, String)],
    loops: &[(usize, usize)],
    from: usize,
    number: u32,
) -> Result<usize, String> {
    let named = |at: &usize| head(&blocks[*at].1).number == Some(number);
    let Some(to) = (from + 1..blocks.len()).chain(0..from + 1).find(named) else {
        return Err(format!("no block {number}"));
    };
    // A jump to the head of a loop begins it; one to its end is within.
    let within = |at: usize, (begin, end): &(usize, usize)| (begin + 1..=*end).contains(&at);
    match loops.iter().any(|l| within(to, l) && !within(from, l)) {
        true => Err(format!("a jump into a loop, to {number}")),
        false => Ok(to),
    }
}

/// The numbers of system variables that a block names; where it computes one, those of all work offsets.
fn named(block: &str) -> Vec<u32> {
    let computed = if block.contains("#[") { vec![5221..=5333, 7001..=7953] } else { Vec::new() };
    let parts = block.split('#').skip(1);
    let digits = |part: &str| part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len());
    let written = parts.filter_map(|part| part[..digits(part)].parse().ok()).filter(|n| *n >= 1000);
    written.chain(computed.into_iter().flatten()).collect()
}

impl Control {
    /// Looks at the system variables that a block names.
    pub(super) fn look(&mut self, block: &str) {
        if block.contains('#') {
            self.variables.own =
                named(block).into_iter().filter_map(|number| Some((number, self.own(number)?))).collect();
        }
    }

    fn formula<'t>(&'t self, text: &'t str) -> Formula<'t> {
        Formula::new(text, &self.variables, Rounding::Whole)
    }

    /// Runs a block that is a macro statement.
    pub(super) fn statement(&mut self, block: &str) -> Result<Go, Halt> {
        let head = head(block);
        let rest = head.rest;
        let own = rest.starts_with('#')
            || ["IF", "WHILE", "DO", "END", "GOTO"].iter().any(|word| keyword(rest, word).is_some());
        if !own {
            return Ok(Go::Not);
        }
        if head.skips.iter().any(|level| self.m.setup.skip[*level]) {
            if loop_mark(block).is_some() {
                return self.m.halt("a loop that is skipped");
            }
            return Ok(Go::On);
        }
        self.do_statement(rest).or_else(|why| self.m.halt(why))
    }

    fn do_statement(&mut self, text: &str) -> Result<Go, String> {
        if text.starts_with('#') {
            return self.assign(text);
        }
        if let Some(rest) = keyword(text, "IF") {
            let (holds, rest) = self.holds(rest)?;
            if let Some(to) = keyword(rest, "GOTO") {
                return if holds { self.go_to(to) } else { Ok(Go::On) };
            }
            let Some(then) = keyword(rest, "THEN") else { return Err("IF without GOTO or THEN".into()) };
            if !then.starts_with('#') {
                return Err("THEN without an assignment".into());
            }
            return if holds { self.assign(then) } else { Ok(Go::On) };
        }
        if let Some(rest) = keyword(text, "WHILE") {
            let (holds, rest) = self.holds(rest)?;
            return match keyword(rest, "DO") {
                Some(_) if holds => Ok(Go::On),
                Some(_) => Ok(Go::Behind),
                None => Err("WHILE without DO".into()),
            };
        }
        if keyword(text, "DO").is_some() {
            return Ok(Go::On);
        }
        if keyword(text, "END").is_some() {
            return Ok(Go::Again);
        }
        match keyword(text, "GOTO") {
            Some(to) => self.go_to(to),
            None => Err(format!("the statement {text}")),
        }
    }

    /// A condition in brackets, and what is behind it.
    fn holds<'t>(&self, text: &'t str) -> Result<(bool, &'t str), String> {
        let end = closing(text).ok_or("a condition without its brackets")?;
        let mut formula = self.formula(&text[1..end - 1]);
        match (formula.condition()?, formula.rest) {
            (Worth::Truth(holds), "") => Ok((holds, &text[end..])),
            (_, rest) => Err(format!("no condition, or {rest} behind it")),
        }
    }

    fn go_to(&self, text: &str) -> Result<Go, String> {
        if let Ok(number) = text.parse::<u32>() {
            return if (1..=99999).contains(&number) { Ok(Go::To(number)) } else { Err("GOTO".into()) };
        }
        let number = self.number_of(text, Rounding::Whole)?.unwrap_or(0.0);
        let whole = number == number.floor() && (1.0..=99999.0).contains(&number);
        Ok(if whole { Go::Perhaps(number as u32) } else { Go::Alarm })
    }

    fn assign(&mut self, text: &str) -> Result<Go, String> {
        let shown = text.contains(TEXT);
        let text = &*text.replace(TEXT, "");
        let mut left = self.formula(&text[1..]);
        let number = left.variable_number()?;
        let Some(right) = left.rest.strip_prefix('=') else { return Err("a variable without =".into()) };
        let value = self.number_of(right, Rounding::Whole)?;
        match number {
            // 3000: an alarm. 3006: the control stops and shows the text.
            3000 => return Ok(Go::Alarm),
            3006 => {
                if shown {
                    self.m.record(What::Message);
                }
                self.m.record(What::Stop);
            }
            1000.. => self.set_own(number, value).map_err(|halt| halt.why)?,
            number => self.variables.write(number, value)?,
        }
        Ok(Go::On)
    }

    /// What an expression is worth that is a whole text.
    fn number_of(&self, text: &str, rounding: Rounding) -> Result<Option<f64>, String> {
        let mut formula = Formula::new(text, &self.variables, rounding);
        match (formula.condition()?, formula.rest) {
            (Worth::Number(n), "") => Ok(n),
            (_, rest) => Err(format!("a condition in place of a number, or {rest} behind it")),
        }
    }

    /// The value of a computed word: its sign, then a variable or a bracket. Nothing of a variable that was never
    /// set. It is rounded as its address counts.
    pub(super) fn computed(&self, text: &str, rounding: Rounding) -> Result<Option<f64>, String> {
        let bare = text.trim_start_matches(['+', '-']);
        let signs = &text[..text.len() - bare.len()];
        if signs.len() > 1 {
            return Err(format!("a word {text}"));
        }
        let sign = if signs == "-" { -1.0 } else { 1.0 };
        Ok(self.number_of(bare, rounding)?.map(|n| sign * n))
    }

    /// What words of an address are rounded to; the blocks that say other units, or angles by lengths' letters, are
    /// told by `other`.
    fn address(&self, letter: char, other: bool) -> Result<Rounding, String> {
        let length = Rounding::To(if self.m.inch { 4 } else { 3 });
        match letter {
            'A' | 'B' | 'C' => Ok(Rounding::To(3)),
            'X' | 'Y' | 'Z' | 'I' | 'J' | 'K' | 'R' | 'Q' | 'r' | 'c' if !other => Ok(length),
            'D' | 'G' | 'H' | 'L' | 'M' | 'P' | 'S' | 'T' => Ok(Rounding::Whole),
            'F' => Ok(Rounding::Open),
            _ => Err(format!("the computed word {letter}, in a block where it counts otherwise")),
        }
    }

    /// Words with their values; those without one are left out. All that has a point or was computed counts whole
    /// units.
    pub(super) fn values(&self, raw: &[(char, &str)]) -> Result<Vec<Word>, String> {
        let code = |codes: &[&str]| raw.iter().any(|(l, v)| *l == 'G' && codes.contains(v));
        // A block that says its unit, or seconds and angles where lengths are in inches.
        let other = code(&["20", "21"])
            || self.m.inch && (self.polar.is_some() || code(&["4", "04", "16", "68", "68.2"]));
        if code(&["51"]) && raw.iter().any(|(_, text)| text.contains(['#', '['])) {
            return Err("a computed scale".into());
        }
        let mut words = Vec::new();
        for (letter, text) in raw.iter().copied() {
            if text.contains(['#', '[']) {
                if letter == 'P' && self.variables.haas && code(&["4", "04", "82", "86", "89"]) {
                    return Err("a computed dwell, without a point to tell what it counts".into());
                }
                // A dwell by X is in seconds, of which the least is a millisecond.
                let rounding = match (letter, code(&["4", "04"]) && !self.variables.haas) {
                    ('X', true) => Rounding::To(3),
                    _ => self.address(letter, other)?,
                };
                let Some(value) = self.computed(text, rounding)? else { continue };
                let value = if self.m.setup.last_digits_up { value * (1.0 + 1e-15) } else { value };
                let value = match rounding {
                    Rounding::To(digits) => round_to(value, digits),
                    Rounding::Whole => round(value),
                    Rounding::Open => value,
                };
                words.push((letter, value, rounding != Rounding::Whole));
            } else {
                let Ok(value) = text.parse::<f64>() else { return Err(format!("no number: {letter}{text}")) };
                words.push((letter, value, text.contains('.')));
            }
        }
        Ok(words)
    }

    /// G65: the arguments become the local variables of a new level.
    pub(super) fn macro_call(
        &mut self,
        raw: &[(char, &str)],
        name: Option<&str>,
        all: &[Program],
    ) -> Result<Next, Halt> {
        let (program, times, local) = match self.arguments(raw) {
            Ok(found) => found,
            Err(why) => return self.m.halt(why),
        };
        let name = match (name, program) {
            (Some(name), None) => name.to_owned(),
            (None, Some(number)) => number.to_string(),
            _ => return self.m.halt("G65 without a program, or with two"),
        };
        // Whole arguments count increments there, which ones the letter says, and zero is zero in any; a call that is
        // repeated keeps its variables.
        let counts =
            |text: &str| !text.contains(['.', '#', '[']) && text.contains(|c| matches!(c, '1'..='9'));
        let whole = raw.iter().any(|(letter, text)| !"GPL".contains(*letter) && counts(text));
        if self.haas && (whole || times > 1) {
            return self.m.halt("G65 on a Haas with an argument without a point, or several times");
        }
        for _ in 0..times {
            self.variables.local.push(local);
            let next = self.run(&name, all)?;
            self.variables.local.pop();
            if let Next::End = next {
                return Ok(Next::End);
            }
        }
        Ok(Next::Block)
    }

    /// G66: no call by itself; what its arguments are worth stays.
    pub(super) fn begin_modal(&mut self, raw: &[(char, &str)]) -> Result<Next, Halt> {
        if self.modal.is_some() || self.in_modal {
            return self.m.halt("G66 within another");
        }
        // Its arguments are those of the other call.
        let (program, times, local) = match self.arguments(raw) {
            Ok((Some(program), times, local)) => (program.to_string(), times, local),
            Ok(_) => return self.m.halt("G66 without a program"),
            Err(why) => return self.m.halt(why),
        };
        self.modal = Some(Modal { program, times, local });
        Ok(Next::Block)
    }

    /// G66.1: from here on the words of a block are arguments, and those of its own are.
    pub(super) fn begin_words(&mut self, raw: &[(char, &str)], all: &[Program]) -> Result<Next, Halt> {
        if self.modal.is_some() || self.in_modal || self.by_words.is_some() {
            return self.m.halt("G66.1 within another");
        }
        let (program, times) = match self.arguments(raw) {
            Ok((Some(program), times, _)) => (program.to_string(), times),
            Ok(_) => return self.m.halt("G66.1 without a program"),
            Err(why) => return self.m.halt(why),
        };
        self.by_words = Some((program, times));
        let own: Vec<(char, &str)> =
            raw.iter().copied().filter(|(letter, _)| !"GPL".contains(*letter)).collect();
        self.words_call(&own, all)
    }

    /// A block under it.
    pub(super) fn words_call(&mut self, raw: &[(char, &str)], all: &[Program]) -> Result<Next, Halt> {
        let Some((program, times)) = self.by_words.take() else { return Ok(Next::Block) };
        if raw.contains(&('G', "67")) {
            return Ok(Next::Block);
        }
        if raw.iter().any(|(letter, _)| "GMSTPLO".contains(*letter)) {
            return self.m.halt("a function under G66.1");
        }
        let own = raw.iter().copied().filter(|(letter, _)| *letter != 'N');
        let handed: Vec<(char, &str)> = std::iter::once(('G', "66.1")).chain(own).collect();
        let next = match self.arguments(&handed) {
            Err(why) => return self.m.halt(why),
            Ok((.., local)) => {
                let mut next = Next::Block;
                for _ in 0..times {
                    self.variables.local.push(local);
                    next = self.run(&program, all)?;
                    self.variables.local.pop();
                }
                next
            }
        };
        self.by_words = Some((program, times));
        Ok(if let Next::End = next { Next::End } else { Next::Block })
    }

    /// A block, and behind it the macro of G66 if it has moved.
    pub(super) fn block_and_macro(&mut self, block: &str, all: &[Program]) -> Result<Next, Halt> {
        self.moved = false;
        let next = self.block(block, all)?;
        let Some(modal) = self.modal.clone().filter(|_| self.moved) else { return Ok(next) };
        if !matches!(next, Next::Block) {
            return self.m.halt("a move under G66 in a block that ends a program");
        }
        // Its own moves call nothing.
        self.modal = None;
        self.in_modal = true;
        for _ in 0..modal.times {
            self.variables.local.push(modal.local);
            let next = self.run(&modal.program, all)?;
            self.variables.local.pop();
            if let Next::End = next {
                return Ok(Next::End);
            }
        }
        self.modal = Some(modal);
        self.in_modal = false;
        Ok(Next::Block)
    }

    /// The program, how often, and its first variables.
    fn arguments(&self, raw: &[(char, &str)]) -> Result<(Option<u32>, u32, Locals), String> {
        let (mut program, mut times) = (None, 1);
        let mut local = [None; 34];
        let (mut set, mut last) = (0, None);
        if raw.first().is_none_or(|first| first.0 != 'G') {
            return Err("words before G65".into());
        }
        for (letter, text) in raw[1..].iter().copied() {
            let place = match letter {
                'P' | 'L' => {
                    let whole = match text.parse::<u32>() {
                        Ok(number) => number,
                        Err(_) => {
                            round(self.computed(text, Rounding::Whole)?.ok_or("P or L of nothing")?) as u32
                        }
                    };
                    match letter {
                        'P' => program = Some(whole),
                        _ => times = whole,
                    }
                    continue;
                }
                'I' | 'J' | 'K' => {
                    // The same or an earlier letter begins the next set.
                    let place = letter as usize - 'I' as usize;
                    if last.is_some_and(|last| place <= last) {
                        set += 1;
                    }
                    last = Some(place);
                    4 + 3 * set + place
                }
                'A'..='C' => 1 + letter as usize - 'A' as usize,
                'D'..='F' => 7 + letter as usize - 'D' as usize,
                'H' => 11,
                'M' => 13,
                'Q'..='Z' => 17 + letter as usize - 'Q' as usize,
                _ => return Err(format!("the argument {letter}")),
            };
            if place > 33 {
                return Err("eleven sets of I, J, K".into());
            }
            local[place] = if text.contains(['#', '[']) {
                self.computed(text, Rounding::Open)?
            } else {
                let number: f64 = text.parse().map_err(|_| format!("no number: {letter}{text}"))?;
                let step = match letter {
                    _ if text.contains('.') || number == 0.0 => 1.0,
                    'D' | 'H' | 'M' | 'S' | 'T' => 1.0,
                    'E' | 'F' => return Err("a feed without a point as argument".into()),
                    'A' | 'B' | 'C' if self.m.inch => {
                        return Err("an angle without a point as argument".into());
                    }
                    _ if self.m.inch => 0.0001,
                    _ => 0.001,
                };
                Some(number * step)
            };
        }
        Ok((program, times, local))
    }
}
