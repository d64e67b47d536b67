//! O words, from the chapter on them in LinuxCNC's documentation: lines are looked for by their labels, each time
//! that control goes there.

use super::super::Halt;
use super::parameters::{Level, Reading};
use super::{Control, DEEPEST, Next, Program};

/// A line with an O word: its label and what is behind that.
fn split(line: &str) -> Option<(String, String)> {
    let mut bare = String::new();
    let mut inside = false;
    for c in line.chars() {
        match c {
            ';' if !inside => break,
            '(' => inside = true,
            ')' => inside = false,
            _ if inside || c.is_whitespace() => {}
            _ => bare.push(c.to_ascii_uppercase()),
        }
    }
    // A block number may stand in front (`read_items` of its interpreter).
    let bare = match bare.strip_prefix('N') {
        Some(numbered) => numbered.trim_start_matches(|c: char| c.is_ascii_digit()),
        None => &bare,
    };
    let rest = bare.strip_prefix('O')?;
    let end = match rest.chars().next()? {
        '<' => rest.find('>')? + 1,
        '[' => closing(rest)?,
        '#' => rest.find(|c: char| !(c == '#' || c.is_ascii_digit())).unwrap_or(rest.len()),
        _ => rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len()),
    };
    let end = if rest.starts_with("#<") { rest.find('>')? + 1 } else { end };
    Some((rest[..end].to_owned(), rest[end..].to_owned()))
}

/// Where the bracket that a text begins with is closed.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0;
    for (at, c) in text.char_indices() {
        match c {
            '[' => depth += 1,
            ']' if depth == 1 => return Some(at + 1),
            ']' => depth -= 1,
            _ => {}
        }
    }
    None
}

/// The line with this label and one of these words at its front, from a place on.
fn find(lines: &[(usize, String)], label: &str, words: &[&str], from: usize) -> Option<usize> {
    (from..lines.len()).find(|at| {
        split(&lines[*at].1)
            .is_some_and(|(own, rest)| own == label && words.iter().any(|word| rest.starts_with(word)))
    })
}

/// Whether a line has an O word.
pub(super) fn has_word(line: &str) -> bool {
    split(line).is_some_and(|(_, rest)| !rest.is_empty())
}

/// Where control goes behind a line.
pub(super) enum Go {
    To(usize),
    Back,
    End,
}

impl Control {
    /// Runs the line at a place.
    pub(super) fn o_word(
        &mut self,
        lines: &[(usize, String)],
        at: usize,
        all: &[Program],
    ) -> Result<Go, Halt> {
        let Some((label, rest)) = split(&lines[at].1) else { return Ok(Go::To(at + 1)) };
        let next = Ok(Go::To(at + 1));
        let past = |found: Option<usize>| found.map_or(lines.len(), |found| found + 1);
        let ends = ["ENDWHILE", "WHILE"];
        if rest.starts_with("SUB") {
            return Ok(Go::To(past(find(lines, &label, &["ENDSUB"], at))));
        }
        if let Some(value) = rest.strip_prefix("ENDSUB").or_else(|| rest.strip_prefix("RETURN")) {
            let returned = !value.is_empty();
            let value = if returned { self.value(&mut Reading { rest: value })? } else { 0.0 };
            self.parameters.global.insert("_VALUE".into(), value);
            self.parameters.global.insert("_VALUE_RETURNED".into(), f64::from(u8::from(returned)));
            return Ok(Go::Back);
        }
        if let Some(arguments) = rest.strip_prefix("CALL") {
            return self.o_call(&label, arguments, all).map(|ended| match ended {
                true => Go::End,
                false => Go::To(at + 1),
            });
        }
        if let Some(condition) = rest.strip_prefix("IF") {
            let mut holds = self.value(&mut Reading { rest: condition })? != 0.0;
            let mut place = at;
            while !holds {
                let Some(found) = find(lines, &label, &["ELSE", "ENDIF"], place + 1) else {
                    return self.m.halt("IF without ENDIF");
                };
                place = found;
                let rest = split(&lines[place].1).map_or(String::new(), |(_, rest)| rest);
                holds = match rest.strip_prefix("ELSEIF") {
                    Some(condition) => self.value(&mut Reading { rest: condition })? != 0.0,
                    None => true,
                };
            }
            return Ok(Go::To(place + 1));
        }
        if rest.starts_with("ELSE") {
            // The end of what was executed. What it passes over it works out.
            let mut passed = Some(at);
            while let Some(at) = passed {
                let rest = split(&lines[at].1).map_or(String::new(), |(_, rest)| rest);
                if let Some(condition) = rest.strip_prefix("ELSEIF")
                    && let Err(why) = self.value(&mut Reading { rest: condition })
                {
                    return self.m.halt(format!("an elseif that is passed over: {}", why.why));
                }
                passed =
                    find(lines, &label, &["ELSE", "ENDIF"], at + 1).filter(|_| !rest.starts_with("ENDIF"));
            }
            return Ok(Go::To(past(find(lines, &label, &["ENDIF"], at))));
        }
        if rest.starts_with("ENDIF") || rest.starts_with("DO") {
            return next;
        }
        if rest.starts_with("ENDWHILE") {
            return Ok(Go::To(find(lines, &label, &["WHILE"], 0).unwrap_or(lines.len())));
        }
        if let Some(condition) = rest.strip_prefix("WHILE") {
            let holds = self.value(&mut Reading { rest: condition })? != 0.0;
            return Ok(Go::To(match (find(lines, &label, &["DO"], 0), holds) {
                (Some(head), true) => head + 1,
                (Some(_), false) | (None, true) => at + 1,
                (None, false) => past(find(lines, &label, &["ENDWHILE"], at)),
            }));
        }
        if let Some(times) = rest.strip_prefix("REPEAT") {
            let times = self.value(&mut Reading { rest: times })?.round();
            if times < 1.0 {
                return Ok(Go::To(past(find(lines, &label, &["ENDREPEAT"], at))));
            }
            self.repeats.push((label, times as u64));
            return next;
        }
        if rest.starts_with("ENDREPEAT") {
            let Some((own, left)) = self.repeats.last_mut() else { return self.m.halt("ENDREPEAT") };
            *left -= 1;
            if *own != label {
                return self.m.halt("ENDREPEAT of another loop");
            }
            if *left > 0 {
                return Ok(Go::To(past(find(lines, &label, &["REPEAT"], 0))));
            }
            self.repeats.pop();
            return next;
        }
        if rest == "BREAK" {
            return Ok(Go::To(past(find(lines, &label, &ends, at))));
        }
        if rest == "CONTINUE" {
            return Ok(Go::To(find(lines, &label, &ends, at).unwrap_or(lines.len())));
        }
        self.m.halt(format!("O{label}{rest}"))
    }

    fn o_call(&mut self, label: &str, mut rest: &str, all: &[Program]) -> Result<bool, Halt> {
        let mut level = Level { called: true, ..Level::default() };
        for number in 1.. {
            if rest.is_empty() {
                break;
            }
            let mut reading = Reading { rest };
            level.numbers.insert(number, self.value(&mut reading)?);
            rest = reading.rest;
        }
        let label = match label.starts_with(['#', '[']) {
            true => (self.value(&mut Reading { rest: label })?.round() as i64).to_string(),
            false => label.to_owned(),
        };
        let found = all.iter().find_map(|p| Some((&p.lines, find(&p.lines, &label, &["SUB"], 0)?)));
        let Some((lines, head)) = found else { return self.m.halt(format!("no O{label} SUB")) };
        if self.depth == DEEPEST {
            return self.m.halt("calls too deep");
        }
        let end = find(lines, &label, &["ENDSUB"], head).map_or(lines.len(), |end| end + 1);
        let repeats = std::mem::take(&mut self.repeats);
        self.parameters.levels.push(level);
        self.depth += 1;
        let ended = self.program(&lines[head + 1..end], all);
        self.depth -= 1;
        self.parameters.levels.pop();
        self.repeats = repeats;
        match ended? {
            Next::End => Ok(true),
            Next::Block | Next::Back => Ok(false),
        }
    }
}
