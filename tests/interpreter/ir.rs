//! Programs in the text form of the neutral program, as its own description has it: the functions
//! with their arguments, procedures, cycles and patterns. No expressions, no loops.

use std::collections::HashMap;

use super::{Halt, Hole, Machine, Setup, Spindle, What};

/// Runs a program.
///
/// # Errors
/// The program is wrong, or out of scope.
pub fn run(text: &[u8], setup: Setup) -> Result<Machine, Halt> {
    let text = String::from_utf8_lossy(text);
    let mut control = Control {
        motion: setup.power_on.motion,
        return_initial: setup.power_on.return_initial,
        m: Machine::new(setup),
        cycle: None,
        procedures: HashMap::new(),
        depth: 0,
    };
    let mut main = Vec::new();
    let mut open: Option<(String, Vec<Line>)> = None;
    let mut nested = 0;
    for (index, line) in text.lines().enumerate() {
        control.m.line = index + 1;
        let tokens = control.tokens(line)?;
        let Some(first) = tokens.first() else { continue };
        match (first, &mut open) {
            (Token::Name(n), _) if n == "ncc-ir" || n == "program" => {}
            (Token::Name(n), _) if n == "assumed" => control.assume(&tokens)?,
            (Token::Name(n), None) if n == "procedure" => {
                let name = match tokens.get(1) {
                    Some(Token::Number(value, _)) => value.to_string(),
                    Some(Token::Text(text)) => text.clone(),
                    _ => return control.m.halt("a procedure without a name"),
                };
                open = Some((name, Vec::new()));
            }
            (Token::Sign('}'), Some(_)) if nested == 0 => {
                if let Some((name, body)) = open.take() {
                    control.procedures.insert(name, body);
                }
            }
            (first, open) => {
                nested += i32::from(tokens.last() == Some(&Token::Sign('{')));
                nested -= i32::from(*first == Token::Sign('}'));
                let body = open.as_mut().map_or(&mut main, |(_, body)| body);
                body.push((index + 1, tokens));
            }
        }
    }
    if !matches!(control.body(&main)?, Next::End) {
        control.m.record(What::TextEnd);
    }
    Ok(control.m)
}

/// A line: its number and its words.
type Line = (usize, Vec<Token>);

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Name(String),
    Number(f64, String),
    Text(String),
    Sign(char),
}

enum Next {
    On,
    Back,
    End,
}

struct Cycle {
    hole: Hole,
    retract: f64,
    depth: f64,
    initial: f64,
    back_initial: Option<bool>,
    raise_first: bool,
}

struct Control {
    m: Machine,
    motion: u32,
    return_initial: bool,
    cycle: Option<Cycle>,
    procedures: HashMap<String, Vec<Line>>,
    depth: u32,
}

impl Control {
    fn tokens(&self, line: &str) -> Result<Vec<Token>, Halt> {
        let mut tokens = Vec::new();
        let mut chars = line.chars().peekable();
        while let Some(&c) = chars.peek() {
            if c.is_whitespace() {
                chars.next();
            } else if c == '#' {
                break;
            } else if c == '"' {
                chars.next();
                let mut text = String::new();
                loop {
                    match chars.next() {
                        Some('"') => break,
                        Some('\\') => text.extend(chars.next()),
                        Some(c) => text.push(c),
                        None => return self.m.halt("a text that does not end"),
                    }
                }
                tokens.push(Token::Text(text));
            } else if c.is_ascii_digit() || c == '.' || c == '-' {
                let mut number = String::new();
                while let Some(&c) = chars
                    .peek()
                    .filter(|c| c.is_ascii_digit() || **c == '.' || (number.is_empty() && **c == '-'))
                {
                    number.push(c);
                    chars.next();
                }
                let mut unit = String::new();
                while let Some(&c) = chars.peek().filter(|c| c.is_ascii_lowercase()) {
                    unit.push(c);
                    chars.next();
                }
                let Ok(value) = number.parse() else { return self.m.halt(format!("no number: {number}")) };
                tokens.push(Token::Number(value, unit));
            } else if c.is_alphabetic() {
                let mut name = String::new();
                while let Some(&c) = chars.peek().filter(|c| c.is_alphanumeric() || "_-".contains(**c)) {
                    name.push(c);
                    chars.next();
                }
                tokens.push(Token::Name(name));
            } else {
                tokens.push(Token::Sign(c));
                chars.next();
            }
        }
        Ok(tokens)
    }

    fn assume(&mut self, tokens: &[Token]) -> Result<(), Halt> {
        for pair in tokens.windows(2) {
            let Token::Name(fact) = &pair[0] else { continue };
            match (fact.as_str(), &pair[1]) {
                ("distance", Token::Name(v)) => self.m.absolute = v == "absolute",
                ("units", Token::Name(v)) => self.m.inch = v == "inch",
                ("plane", Token::Name(v)) => self.m.plane = self.plane(v)?,
                ("return-level", Token::Name(v)) => self.return_initial = v == "initial",
                ("work-offset", Token::Number(v, _)) => self.m.offset = *v as u32,
                ("length-offset", Token::Number(v, _)) => self.m.entry = *v as u32,
                ("motion", Token::Name(v)) => self.motion = u32::from(v == "feed"),
                _ => {}
            }
        }
        Ok(())
    }

    fn plane(&self, name: &str) -> Result<u32, Halt> {
        match name {
            "XY" => Ok(17),
            "ZX" => Ok(18),
            "YZ" => Ok(19),
            "entry" => Ok(self.m.plane),
            _ => self.m.halt(format!("no plane: {name}")),
        }
    }

    fn body(&mut self, lines: &[Line]) -> Result<Next, Halt> {
        let mut skip = 0;
        let mut lines = lines;
        while let [(line, tokens), after @ ..] = lines {
            lines = after;
            self.m.line = *line;
            let mut rest = &tokens[..];
            if let [Token::Name(n), Token::Number(times, _), Token::Sign('{')] = rest
                && n == "repeat"
            {
                let mut depth = 1;
                let Some(end) = lines.iter().position(|(_, tokens)| {
                    depth += i32::from(tokens.last() == Some(&Token::Sign('{')));
                    depth -= i32::from(tokens.first() == Some(&Token::Sign('}')));
                    depth == 0
                }) else {
                    return self.m.halt("a body that does not end");
                };
                for _ in 0..*times as u32 {
                    match self.body(&lines[..end])? {
                        Next::On => {}
                        other => return Ok(other),
                    }
                }
                lines = &lines[end + 1..];
                continue;
            }
            let mut joined = false;
            while !rest.is_empty() {
                if let [Token::Sign('&'), after @ ..] = rest {
                    joined = true;
                    rest = after;
                }
                let mut level = if joined { skip } else { 0 };
                if let [Token::Sign('/'), after @ ..] = rest {
                    (level, rest) = match after {
                        [Token::Number(n, _), after @ ..] => (*n as usize, after),
                        after => (1, after),
                    };
                }
                if let [Token::Name(n), after @ ..] = rest
                    && n.starts_with('N')
                    && n[1..].chars().all(|c| c.is_ascii_digit())
                {
                    rest = after;
                }
                if let [Token::Name(n), after @ ..] = rest
                    && n == "said"
                {
                    rest = after;
                }
                let [Token::Name(name), Token::Sign('('), after @ ..] = rest else {
                    return self.m.halt("no function");
                };
                let mut depth = 1;
                let Some(end) = after.iter().position(|t| {
                    depth += match t {
                        Token::Sign('(') => 1,
                        Token::Sign(')') => -1,
                        _ => 0,
                    };
                    depth == 0
                }) else {
                    return self.m.halt("a function without its end");
                };
                let arguments = &after[..end];
                rest = &after[end + 1..];
                if let [Token::Text(_), after @ ..] = rest {
                    rest = after;
                }
                skip = level;
                if level == 0 || !self.m.setup.skip[level] {
                    match self.call(name, arguments)? {
                        Next::On => {}
                        other => return Ok(other),
                    }
                }
                if !rest.is_empty() && rest[0] != Token::Sign('&') {
                    return self.m.halt("words after a function");
                }
            }
        }
        Ok(Next::On)
    }

    /// Millimetres, degrees, seconds, or the bare number.
    fn base(&self, value: f64, unit: &str) -> f64 {
        let inch = unit == "in" || (unit == "u" && self.m.inch);
        if inch { value * 25.4 } else { value }
    }

    /// The number after a word.
    fn after(&self, tokens: &[Token], word: &str) -> Option<f64> {
        let at = tokens.iter().position(|t| matches!(t, Token::Name(n) if n == word))?;
        match tokens.get(at + 1..)? {
            [Token::Number(v, u), ..] => Some(self.base(*v, u)),
            _ => None,
        }
    }

    fn first(&self, tokens: &[Token]) -> Result<f64, Halt> {
        match tokens {
            [Token::Number(v, u)] => Ok(self.base(*v, u)),
            _ => self.m.halt("one number is needed"),
        }
    }

    fn word<'t>(&self, tokens: &'t [Token]) -> Result<&'t str, Halt> {
        match tokens {
            [Token::Name(n)] => Ok(n),
            _ => self.m.halt("one word is needed"),
        }
    }

    /// Axis words, each with its own measure: `X 1.mm`, `Y inc 2.mm`, `Z entry 3.mm`.
    fn target(&mut self, tokens: &[Token]) -> Result<(super::Place, [bool; 6]), Halt> {
        let absolute_mode = self.m.absolute;
        let mut to = self.m.at;
        let mut named = [false; 6];
        let mut rest = tokens;
        while !rest.is_empty() {
            if let [Token::Sign(','), after @ ..] = rest {
                rest = after;
            }
            let [Token::Name(letter), after @ ..] = rest else { return self.m.halt("no axis") };
            let Some(axis) = ["X", "Y", "Z", "A", "B", "C"].iter().position(|a| a == letter) else {
                return self.m.halt(format!("no axis: {letter}"));
            };
            let (absolute, after) = match after {
                [Token::Name(n), after @ ..] if n == "inc" => (false, after),
                [Token::Name(n), after @ ..] if n == "entry" => (absolute_mode, after),
                _ => (true, after),
            };
            let [Token::Number(v, u), after @ ..] = after else { return self.m.halt("no number") };
            let mut words = [None; 6];
            words[axis] = Some(self.base(*v, u));
            self.m.absolute = absolute;
            let moved = self.m.target(words);
            self.m.absolute = absolute_mode;
            to[axis] = moved?[axis];
            named[axis] = true;
            rest = after;
        }
        Ok((to, named))
    }

    fn call(&mut self, name: &str, a: &[Token]) -> Result<Next, Halt> {
        match name {
            "COMMENT" | "NO_EFFECT" | "BLANK" | "CLEAR_FRAME" | "STOP_CUTTER_RADIUS_COMPENSATION" => {}
            "SET_FEED_MODE" if self.word(a)? == "per-minute" => {}
            "USE_LENGTH_UNITS" => self.m.inch = self.word(a)? == "inch",
            "SET_DISTANCE_MODE" => self.m.absolute = self.word(a)? == "absolute",
            "SELECT_PLANE" => self.m.plane = self.plane(self.word(a)?)?,
            "SET_RETURN_LEVEL" => self.return_initial = self.word(a)? == "initial",
            "SET_ORIGIN_OFFSETS" => {
                let number = self.first(a)? as u32;
                self.m.use_offset(number);
            }
            "SET_FEED_RATE" => self.m.feed = Some(self.first(a)?),
            "SET_SPINDLE_SPEED" => self.m.speed = Some(self.first(a)?),
            "SELECT_TOOL" => self.m.selected = Some(self.first(a)? as u32),
            "CHANGE_TOOL" => self.m.change_tool()?,
            "USE_TOOL_LENGTH_OFFSET" => {
                let entry = self.first(a)? as u32;
                self.m.use_length(entry);
            }
            "START_SPINDLE_CLOCKWISE" => self.m.turn(Spindle::Clockwise),
            "START_SPINDLE_COUNTERCLOCKWISE" => self.m.turn(Spindle::Counterclockwise),
            "STOP_SPINDLE_TURNING" => self.m.turn(Spindle::Stopped),
            "FLOOD_ON" => self.m.cool(true, self.m.coolant.1),
            "MIST_ON" => self.m.cool(self.m.coolant.0, true),
            "COOLANT_OFF" => self.m.cool(false, false),
            "DWELL" => {
                let seconds = self.first(a)?;
                self.m.record(What::Dwell(seconds));
            }
            "STRAIGHT_TRAVERSE" | "STRAIGHT_FEED" => {
                self.motion = u32::from(name == "STRAIGHT_FEED");
                self.cycle = None;
                self.go(a)?;
            }
            "POSITION" if self.cycle.is_some() => self.hole_word(a)?,
            "POSITION" => self.go(a)?,
            "ARC_FEED" => self.arc(a)?,
            "START_CYCLE" => self.start(a)?,
            "HOLE" => self.hole_word(a)?,
            "CIRCLE_PATTERN" => self.circle(a)?,
            "RECTANGULAR_LAYOUT" => self.grid(a)?,
            "END_CYCLE" => self.cycle = None,
            "MESSAGE" => self.m.record(What::Message),
            "PROGRAM_STOP" => self.m.record(What::Stop),
            "OPTIONAL_PROGRAM_STOP" => self.m.record(What::OptionalStop),
            "PROGRAM_END" => {
                self.m.record(What::End);
                return Ok(Next::End);
            }
            "RETURN" => return Ok(Next::Back),
            "CALL" => return self.procedure(a),
            _ => return self.m.halt(format!("the function {name}")),
        }
        Ok(Next::On)
    }

    fn procedure(&mut self, a: &[Token]) -> Result<Next, Halt> {
        let name = match a.first() {
            Some(Token::Number(v, _)) => v.to_string(),
            Some(Token::Text(t)) => t.clone(),
            _ => return self.m.halt("a call without a name"),
        };
        let Some(body) = self.procedures.get(&name).cloned() else {
            return self.m.halt(format!("no procedure {name}"));
        };
        if self.depth == 20 {
            return self.m.halt("calls too deep");
        }
        for _ in 0..self.after(a, "times").unwrap_or(1.0) as u32 {
            self.depth += 1;
            let next = self.body(&body)?;
            self.depth -= 1;
            if matches!(next, Next::End) {
                return Ok(Next::End);
            }
        }
        Ok(Next::On)
    }

    fn go(&mut self, a: &[Token]) -> Result<(), Halt> {
        let (to, named) = self.target(a)?;
        if !named.contains(&true) {
            return Ok(());
        }
        match self.motion {
            0 => self.m.traverse(to),
            1 => self.m.straight(to)?,
            _ => return self.m.halt("a position while an arc is in force"),
        }
        Ok(())
    }

    fn arc(&mut self, a: &[Token]) -> Result<(), Halt> {
        let mut parts = split(a).into_iter();
        let (Some([Token::Name(plane)]), Some([Token::Name(turn)])) = (parts.next(), parts.next()) else {
            return self.m.halt("an arc without plane or turn");
        };
        let clockwise = turn == "clockwise";
        let plane_before = self.m.plane;
        let plane = self.plane(plane)?;
        self.cycle = None;
        self.motion = if clockwise { 2 } else { 3 };
        let (mut words, mut centre, mut radius, mut turns): (Vec<Token>, Option<&[Token]>, _, _) =
            (Vec::new(), None, None, 0.0);
        for part in parts {
            match part {
                [Token::Name(n), Token::Sign('('), inner @ .., Token::Sign(')')] if n == "centre" => {
                    centre = Some(inner);
                }
                [Token::Name(n), Token::Number(v, u)] if n == "radius" => radius = Some(self.base(*v, u)),
                [Token::Name(n), Token::Number(v, _)] if n == "turns" => turns = *v,
                part => {
                    if !words.is_empty() {
                        words.push(Token::Sign(','));
                    }
                    words.extend_from_slice(part);
                }
            }
        }
        let (to, _) = self.target(&words)?;
        self.m.plane = plane;
        let (first, second, _) = self.m.axes();
        let middle = match (centre, radius) {
            (Some(inner), None) => {
                let from_start = matches!(inner.first(), Some(Token::Name(n)) if n == "start");
                let letters = ["I", "J", "K"];
                let place = |c: &Control, axis: usize| {
                    let word = c.after(inner, letters[axis]);
                    match from_start {
                        true => c.m.at[axis] + word.unwrap_or(0.0),
                        false => word.map_or(c.m.at[axis], |w| w + c.m.shift(axis)),
                    }
                };
                (place(self, first), place(self, second))
            }
            (None, Some(r)) => self.m.centre_by_radius(to, r, clockwise)?,
            _ => return self.m.halt("an arc without a centre"),
        };
        self.m.arc_of_turns(to, middle, clockwise, turns as u32)?;
        self.m.plane = plane_before;
        Ok(())
    }

    fn start(&mut self, a: &[Token]) -> Result<(), Halt> {
        let parts = split(a);
        let [kind, [Token::Name(plane)], ..] = &parts[..] else { return self.m.halt("no cycle") };
        if self.plane(plane)? != 17 {
            return self.m.halt("a cycle out of XY");
        }
        let Some(Token::Name(name)) = kind.first() else { return self.m.halt("no cycle") };
        let dwell = self.after(kind, "dwell");
        let hole = match (name.as_str(), dwell, self.after(kind, "peck")) {
            ("drill", ..) => Hole::Drill,
            ("drill-dwell", Some(d), _) => Hole::DrillDwell(d),
            ("drill-peck", None, Some(q)) => {
                if let Some(clearance) = self.after(kind, "clearance") {
                    self.m.setup.peck_clearance = clearance;
                }
                Hole::Peck(q)
            }
            ("bore", d, _) => Hole::Bore(d.unwrap_or(0.0)),
            _ => return self.m.halt("a cycle of another kind"),
        };
        let initial = match &self.cycle {
            Some(cycle) => cycle.initial,
            None if self.m.settled[2] => self.m.at[2],
            None => return self.m.halt("the initial level is not known"),
        };
        let (mut retract, mut depth, mut back_initial, mut raise_first) = (None, None, None, false);
        for part in &parts[2..] {
            let level = |from: f64, rest: &[Token]| match rest {
                [Token::Number(v, u)] => Some(self.base(*v, u) + self.m.shift(2)),
                [Token::Name(n), Token::Number(v, u)] if n == "inc" => Some(from + self.base(*v, u)),
                [Token::Name(n), Token::Number(v, u)] if n == "entry" => Some(match self.m.absolute {
                    true => self.base(*v, u) + self.m.shift(2),
                    false => from + self.base(*v, u),
                }),
                _ => None,
            };
            match part {
                [Token::Name(n), rest @ ..] if n == "retract" => retract = level(initial, rest),
                [Token::Name(n), rest @ ..] if n == "depth" => depth = level(retract.unwrap_or(0.0), rest),
                [Token::Name(n), Token::Name(v)] if n == "return" => {
                    back_initial = (v != "entry").then(|| v == "initial");
                }
                [Token::Name(n)] => raise_first = n == "raise-first",
                [Token::Name(n), Token::Number(v, u)] if n == "feed" => {
                    self.m.feed = Some(self.base(*v, u));
                }
                _ => return self.m.halt("another word in a cycle"),
            }
        }
        let (Some(retract), Some(depth)) = (retract, depth) else {
            return self.m.halt("a cycle without its levels");
        };
        self.cycle = Some(Cycle { hole, retract, depth, initial, back_initial, raise_first });
        Ok(())
    }

    fn hole_word(&mut self, a: &[Token]) -> Result<(), Halt> {
        let (to, _) = self.target(a)?;
        self.hole_at(to)
    }

    fn hole_at(&mut self, mut to: super::Place) -> Result<(), Halt> {
        let Some(cycle) = &self.cycle else { return self.m.halt("a hole without a cycle") };
        let (hole, r, z) = (cycle.hole, cycle.retract, cycle.depth);
        let back = if cycle.back_initial.unwrap_or(self.return_initial) { cycle.initial } else { r };
        if cycle.raise_first && self.m.at[2] < r {
            let mut up = self.m.at;
            up[2] = r;
            self.m.traverse(up);
        }
        to[2] = self.m.at[2];
        self.m.traverse(to);
        self.m.hole(hole, r, z, back)
    }

    fn circle(&mut self, a: &[Token]) -> Result<(), Halt> {
        let pair = |c: &Control, part: &[Token]| match part {
            [
                _,
                Token::Sign('('),
                Token::Number(x, xu),
                Token::Sign(','),
                Token::Number(y, yu),
                Token::Sign(')'),
            ] => Some((c.base(*x, xu) + c.m.shift(0), c.base(*y, yu) + c.m.shift(1))),
            _ => None,
        };
        let parts = split(a);
        let [centre, first, step, count] = &parts[..] else { return self.m.halt("no circle") };
        let here = (self.m.at[0], self.m.at[1]);
        let centre = pair(self, centre).unwrap_or(here);
        let (Some(first), Some(step), Some(count)) =
            (pair(self, first), self.after(step, "step"), self.after(count, "count"))
        else {
            return self.m.halt("no circle");
        };
        for k in 0..count as u32 {
            let (sin, cos) = (f64::from(k) * step).to_radians().sin_cos();
            let (dx, dy) = (first.0 - centre.0, first.1 - centre.1);
            let mut to = self.m.at;
            to[0] = centre.0 + dx * cos - dy * sin;
            to[1] = centre.1 + dx * sin + dy * cos;
            self.hole_at(to)?;
        }
        Ok(())
    }

    fn grid(&mut self, a: &[Token]) -> Result<(), Halt> {
        let row = |c: &Control, part: &[Token]| match part {
            [
                _,
                Token::Sign('('),
                Token::Name(axis),
                Token::Sign(','),
                Token::Number(p, u),
                Token::Sign(','),
                Token::Number(n, _),
                Token::Sign(')'),
            ] => Some((usize::from(axis == "Y"), c.base(*p, u), *n as u32)),
            _ => None,
        };
        let parts = split(a);
        let (Some(columns), Some(rows)) =
            (parts.first().and_then(|p| row(self, p)), parts.get(1).and_then(|p| row(self, p)))
        else {
            return self.m.halt("no grid");
        };
        let serpentine = parts.len() == 3;
        let from = self.m.at;
        for j in 0..rows.2 {
            for i in 0..columns.2 {
                let i = if serpentine && j % 2 == 1 { columns.2 - 1 - i } else { i };
                let mut to = self.m.at;
                (to[0], to[1]) = (from[0], from[1]);
                to[columns.0] += f64::from(i) * columns.1;
                to[rows.0] += f64::from(j) * rows.1;
                self.hole_at(to)?;
            }
        }
        Ok(())
    }
}

/// Arguments, parted at the commas that stand in no inner parentheses.
fn split(tokens: &[Token]) -> Vec<&[Token]> {
    let mut parts = Vec::new();
    let (mut depth, mut from) = (0, 0);
    for (at, token) in tokens.iter().enumerate() {
        match token {
            Token::Sign('(') => depth += 1,
            Token::Sign(')') => depth -= 1,
            Token::Sign(',') if depth == 0 => {
                parts.push(&tokens[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    if from < tokens.len() {
        parts.push(&tokens[from..]);
    }
    parts
}
