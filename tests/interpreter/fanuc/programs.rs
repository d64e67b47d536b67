//! Programs of a text, by their numbers and names, and calls of them.

use super::super::{Halt, What};
use super::macro_b::jump;
use super::{Control, Next, Word, number};

/// A program of the text: its number or its name, and its blocks, each with its line.
pub(super) struct Program {
    name: String,
    pub(super) blocks: Vec<(usize, String)>,
}

/// Stands for a comment that the control shows.
pub(super) const TEXT: char = '"';

/// Parts the text into programs and blocks, without comments, blanks and end-of-block signs.
pub(super) fn programs(text: &str) -> Vec<Program> {
    let is_mark = |line: &str| line.trim_start().starts_with('%');
    // A mark behind which nothing comes ends the text; a control takes one without marks too.
    let framed = text.lines().skip_while(|line| !is_mark(line)).skip(1).any(|line| !line.trim().is_empty());
    let mut open = !framed;
    let mut programs: Vec<Program> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        if is_mark(line) {
            if open {
                break;
            }
            open = true;
            continue;
        }
        if !open {
            continue;
        }
        let mut bare = String::new();
        let (mut inside, mut named) = (false, false);
        for c in line.chars() {
            match c {
                '(' => {
                    inside = true;
                    // It is a text for the operator.
                    if bare.contains("#3000=") || bare.contains("#3006=") {
                        bare.push(TEXT);
                    }
                }
                ')' => inside = false,
                _ if inside || c.is_whitespace() => {}
                '<' | '>' => {
                    named = c == '<';
                    bare.push(c);
                }
                _ if named => bare.push(c),
                _ => bare.push(c.to_ascii_uppercase()),
            }
        }
        for block in bare.split(';').filter(|b| !b.is_empty()) {
            if block.starts_with(['O', ':']) {
                let digits: String = block[1..].chars().take_while(char::is_ascii_digit).collect();
                programs
                    .push(Program { name: digits.trim_start_matches('0').to_owned(), blocks: Vec::new() });
                continue;
            }
            if let Some((name, "")) = block.strip_prefix('<').and_then(|rest| rest.split_once('>')) {
                programs.push(Program { name: own_name(name), blocks: Vec::new() });
                continue;
            }
            if programs.is_empty() {
                programs.push(Program { name: String::new(), blocks: Vec::new() });
            }
            if let Some(program) = programs.last_mut() {
                program.blocks.push((index + 1, block.to_owned()));
            }
        }
    }
    programs
}

/// The name between brackets; `O` and digits is the number.
fn own_name(name: &str) -> String {
    let number = name.strip_prefix('O').filter(|rest| rest.chars().all(|c| c.is_ascii_digit()));
    number.map_or(name, |n| n.trim_start_matches('0')).to_owned()
}

/// A block without the name in it, and that name.
pub(super) fn without_name(block: &str) -> (String, Option<String>) {
    let parts = block.split_once('<').and_then(|(before, rest)| Some((before, rest.split_once('>')?)));
    match parts {
        Some((before, (name, behind))) => (format!("{before}{behind}"), Some(own_name(name))),
        None => (block.to_owned(), None),
    }
}

impl Control {
    /// M98: P is the number, with L the count; more than four digits carry the count in front. Or a name.
    pub(super) fn call(&mut self, words: &[Word], name: Option<&str>, all: &[Program]) -> Result<Next, Halt> {
        let number_of = number(words, 'P').map(|(p, _)| p as u32);
        let count = number(words, 'L').map(|(l, _)| l as u32);
        let (times, name) = match (number_of, name, count) {
            (None, Some(name), count) if !self.haas => (count.unwrap_or(1), name.to_owned()),
            (Some(p), None, Some(count)) => (count, p.to_string()),
            (Some(p), None, None) if p > 9999 && !self.haas => (p / 10000, (p % 10000).to_string()),
            (Some(p), None, None) => (1, p.to_string()),
            _ => return self.m.halt("M98 without P, or with P and a name"),
        };
        for _ in 0..times {
            if let Next::End = self.run(&name, all)? {
                return Ok(Next::End);
            }
            if times > 1 && self.on.is_some() {
                return self.m.halt("M99 with P in a program that is called several times");
            }
        }
        Ok(Next::Block)
    }

    /// M99: back to what has called the program. A first program that ends by itself as well has nobody to go back to, and
    /// begins anew.
    pub(super) fn back(&mut self, all: &[Program]) -> Next {
        let ends = |block: &str| {
            let digits = |rest: &str| rest.chars().take_while(char::is_ascii_digit).collect::<String>();
            block.split('M').skip(1).any(|rest| matches!(digits(rest).parse(), Ok(2_u32 | 30)))
        };
        let main = all.first().filter(|main| main.blocks.iter().any(|(_, block)| ends(block)));
        if self.depth > 0 || main.is_none() {
            return Next::Back;
        }
        self.m.record(What::BeginsAgain);
        Next::End
    }

    /// A Haas M97: P is a block of the same program; a Fanuc's M98 without P: Q is. L is the count.
    pub(super) fn local_call(&mut self, words: &[Word]) -> Result<Next, Halt> {
        let count = number(words, 'L').map_or(1, |(l, _)| l as u32);
        match number(words, if self.haas { 'P' } else { 'Q' }) {
            Some((block, _)) => Ok(Next::Local(block as u32, count)),
            None => self.m.halt("M97 without P"),
        }
    }

    /// Whether a code calls a block.
    pub(super) fn calls_block(&self, code: i64, words: &[Word]) -> bool {
        let program_unnamed = number(words, 'P').is_none() && number(words, 'Q').is_some();
        if self.haas { code == 97 } else { code == 98 && program_unnamed }
    }

    /// Runs the blocks that it names, from the one with the number to a return.
    pub(super) fn local(
        &mut self,
        blocks: &[(usize, String)],
        at: usize,
        (from, times): (u32, u32),
        all: &[Program],
    ) -> Result<Next, Halt> {
        let first = jump(blocks, &[], at, from).or_else(|why| self.m.halt(why))?;
        if self.depth == 4 {
            return self.m.halt("calls five deep");
        }
        self.depth += 1;
        for _ in 0..times {
            if self.program_from(blocks, first, all)? {
                return Ok(Next::End);
            }
        }
        self.depth -= 1;
        Ok(Next::Block)
    }

    /// Runs a program of the text once.
    pub(super) fn run(&mut self, name: &str, all: &[Program]) -> Result<Next, Halt> {
        let Some(program) = all.iter().skip(1).find(|program| program.name == name) else {
            return self.m.halt(format!("no program {name}"));
        };
        if self.depth == 4 {
            return self.m.halt("calls five deep");
        }
        self.depth += 1;
        let ended = self.program(&program.blocks, all)?;
        self.depth -= 1;
        Ok(if ended { Next::End } else { Next::Block })
    }
}
