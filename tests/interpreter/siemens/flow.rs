//! In which order the blocks of a program run: structures, jumps, repeated parts and subprograms, by the chapters on
//! them in the Job Planning manual (03/2006, 1.13 to 1.16 and 2) and Fundamentals.
//!
//! Not here, for nothing says what comes of it: a jump into a structure, one out of a part that is repeated, a FOR
//! whose end is another one when the loop turns.

use super::super::{Corner, Halt, Per, What};
use super::formula::same;
use super::frame::Frame;
use super::shape;
use super::text::{self, Argument, Block, Item, Reader, Unit};
use super::variables::{self, Given, Kind, Known, Place, Worth};
use super::{Control, Motion, Next, Words};

/// Settable frames.
const FRAMES: u32 = 99;

/// More blocks than any program here runs.
const MOST: u64 = 200_000;

/// What a statement does to the order of blocks.
enum Go {
    /// It is none.
    Not,
    On,
    To(usize),
    Back,
    End,
}

impl<'a> Control<'a> {
    /// Runs the blocks from one place up to another.
    pub(super) fn blocks(&mut self, unit: &'a Unit, from: usize, to: usize) -> Result<Next, Halt> {
        let mut at = from;
        while at < to {
            let (line, block) = &unit.blocks[at];
            self.m.line = *line;
            self.steps += 1;
            if self.steps > MOST {
                return self.m.halt("no end");
            }
            if block.skip.is_some_and(|place| self.m.setup.skip[place]) {
                at += 1;
                continue;
            }
            let last = if block.rest.contains(&'$') { FRAMES } else { 0 };
            self.variables.known = Known {
                end: self.here(),
                machine: self.m.at,
                tool: self.m.tool,
                inch: self.m.inch,
                zeros: (1..=last).map(|offset| self.m.zero_of(offset)).collect(),
            };
            let next = match self.statement(unit, at, block) {
                Ok(Go::Not) => self.other(unit, at, block)?,
                Ok(Go::On) => Next::Block,
                Ok(Go::Back) => Next::Back,
                Ok(Go::End) => Next::End,
                Ok(Go::To(place)) => {
                    if !(from..=to).contains(&place) {
                        return self.m.halt("a jump out of a part that is repeated");
                    }
                    at = place;
                    continue;
                }
                Err(why) => return self.m.halt(why),
            };
            if next != Next::Block {
                return Ok(next);
            }
            at += 1;
        }
        Ok(Next::Block)
    }

    /// A block of words, or one that repeats a part of the program.
    fn other(&mut self, unit: &'a Unit, at: usize, block: &Block) -> Result<Next, Halt> {
        if let Some((word, rest)) = shape::first_word(&block.rest)
            && (word == "CALL" || word == "EXTCALL")
        {
            let mut reader = Reader::new(rest, &self.variables);
            return match reader.expression() {
                Ok(Worth::Text(name)) if reader.over() => {
                    let alone = Words { names: vec![""], ..Words::default() };
                    // A program from another memory is known by the name of its file.
                    let name = name.to_ascii_uppercase();
                    let name = name.strip_suffix(".SPF").filter(|_| word == "EXTCALL").unwrap_or(&name);
                    self.call(name, &alone, 0, &[])
                }
                Ok(_) => self.m.halt("CALL of what is no text"),
                Err(why) => self.m.halt(why),
            };
        }
        let read = text::items(&block.rest, &self.variables);
        let items = read.or_else(|why| self.m.halt(why))?;
        if let Some(Item::Name(name)) = items.first()
            && (name == "REPEAT" || name == "REPEATB")
        {
            return self.repeat(unit, at, &items, name == "REPEATB");
        }
        let sets = items.iter().filter(|item| matches!(item, Item::Set(..))).count();
        if sets > 0 {
            let result = self.assign(block, &items);
            result.or_else(|why| self.m.halt(why))?;
            if sets == items.len() {
                return Ok(Next::Block);
            }
        }
        self.block(&items)
    }

    /// Assignments of a block. Whether what stands beside one is read before it or after it is open: it must be the
    /// same.
    fn assign(&mut self, block: &Block, items: &[Item]) -> Result<(), String> {
        let mut after = self.variables.clone();
        let in_order = text::items_in_order(&block.rest, &mut after)?;
        let words = |items: &[Item]| {
            items.iter().filter(|item| !matches!(item, Item::Set(..))).cloned().collect::<Vec<_>>()
        };
        let beside = words(items);
        let the_same = || text::items(&block.rest, &after).map(|items| words(&items) == beside);
        if in_order != items || !beside.is_empty() && !the_same()? {
            return Err("a block that reads what it sets itself".into());
        }
        self.variables = after;
        Ok(())
    }

    /// Runs a block that is a statement of the language.
    fn statement(&mut self, unit: &Unit, at: usize, block: &Block) -> Result<Go, String> {
        let Some((word, rest)) = shape::first_word(&block.rest) else { return Ok(Go::Not) };
        let shape = unit.shape.as_ref().map_err(String::clone)?;
        // What stands in the shape was found there.
        let end = shape.end(at).unwrap_or(at);
        let begin = shape.begin(at).unwrap_or(at);
        let alone = |go| if rest.is_empty() { Ok(go) } else { Err(format!("{word} and other words")) };
        match word.as_str() {
            "IF" if shape::jumps(rest) => self.jump_if(unit, at, &block.rest),
            "IF" | "WHILE" => match self.condition(rest)? {
                true => Ok(Go::On),
                false => Ok(Go::To(end + 1)),
            },
            // Come to from the other branch.
            "ELSE" => alone(Go::To(end)),
            "LOOP" | "ENDIF" => alone(Go::On),
            "REPEAT" if rest.is_empty() => Ok(Go::On),
            "ENDLOOP" | "ENDWHILE" => alone(Go::To(begin)),
            "UNTIL" => match self.condition(rest)? {
                true => Ok(Go::On),
                false => Ok(Go::To(begin)),
            },
            "FOR" => self.count(rest, at, end, true),
            "ENDFOR" => {
                let head = shape::first_word(&unit.blocks[begin].1.rest).ok_or("no FOR")?;
                self.count(head.1, begin, at, false)
            }
            "GOTO" | "GOTOF" | "GOTOB" | "GOTOC" => {
                let mut reader = Reader::new(&block.rest, &self.variables);
                let found = destination(&mut reader, unit, at)?;
                if reader.over() {
                    found.map_or(Ok(Go::On), |to| into(unit, at, to))
                } else {
                    Err("GOTO and more".into())
                }
            }
            "CASE" => self.case(unit, at, rest),
            "DEF" => variables::definitions(rest, &mut self.variables).map(|()| Go::On),
            // The heading of a subprogram, read at its call; what others there are.
            "PROC" | "EXTERN" => Ok(Go::On),
            "SETAL" => self.alarm(rest),
            "GOTOS" if rest.is_empty() && self.depth == 0 => {
                self.m.record(What::BeginsAgain);
                Ok(Go::End)
            }
            "RET" if rest.is_empty() && self.depth > 0 => Ok(Go::Back),
            _ => Ok(Go::Not),
        }
    }

    /// A condition that is a whole text.
    fn condition(&self, text: &[char]) -> Result<bool, String> {
        let mut reader = Reader::new(text, &self.variables);
        let holds = reader.expression()?.holds()?;
        if reader.over() { Ok(holds) } else { Err("something behind a condition".into()) }
    }

    /// `IF R1==0 GOTOB ONE IF R1==1 GOTOF TWO`
    fn jump_if(&self, unit: &Unit, at: usize, text: &[char]) -> Result<Go, String> {
        let mut reader = Reader::new(text, &self.variables);
        while !reader.over() {
            if reader.name().as_deref() != Some("IF") {
                return Err("something behind a jump".into());
            }
            let holds = reader.expression()?.holds()?;
            reader.blanks();
            let found = destination(&mut reader, unit, at);
            if holds && let Some(to) = found? {
                return into(unit, at, to);
            }
        }
        Ok(Go::On)
    }

    /// `CASE R1 OF 1 GOTOF ONE 2 GOTOB TWO DEFAULT GOTOF OTHER`
    fn case(&self, unit: &Unit, at: usize, text: &[char]) -> Result<Go, String> {
        let mut reader = Reader::new(text, &self.variables);
        let worth = reader.expression()?;
        reader.blanks();
        if reader.name().as_deref() != Some("OF") {
            return Err("CASE without OF".into());
        }
        while !reader.over() {
            let start = reader.at;
            let fits = reader.name().as_deref() == Some("DEFAULT") || {
                reader.at = start;
                same(&worth, &reader.expression()?)?
            };
            reader.blanks();
            let found = destination(&mut reader, unit, at);
            if fits {
                return found?.map_or(Ok(Go::On), |to| into(unit, at, to));
            }
        }
        Ok(Go::On)
    }

    /// `FOR II=1 TO 5`, where the loop begins or turns.
    fn count(&mut self, text: &[char], begin: usize, end: usize, first: bool) -> Result<Go, String> {
        let mut reader = Reader::new(text, &self.variables);
        let Item::Set(place, values) = reader.assignment()? else { return Err("FOR of nothing".into()) };
        reader.blanks();
        if reader.name().as_deref() != Some("TO") {
            return Err("FOR without TO".into());
        }
        let last = reader.expression()?;
        if !reader.over() {
            return Err("something behind FOR".into());
        }
        let bound = (last.number()?, self.bounds.get(&(self.depth, begin)).copied());
        if first {
            self.variables.set(&place, &values)?;
            self.bounds.insert((self.depth, begin), bound.0);
        } else {
            if bound.1 != Some(bound.0) {
                return Err("a FOR whose end is another one when it turns".into());
            }
            let next = self.variables.get(&place)?.number()? + 1.0;
            self.variables.set(&place, &[Some(Worth::Number(next, Kind::Real))])?;
        }
        let count = self.variables.get(&place)?;
        let goes_on = count.number()? < bound.0 || same(&count, &last)?;
        // The first value can make the end another one.
        let mut again = Reader::new(text, &self.variables);
        again.assignment()?;
        again.blanks();
        again.name();
        if again.expression()? != last {
            return Err("a FOR whose end is another one when it begins".into());
        }
        Ok(if goes_on { Go::To(begin + 1) } else { Go::To(end + 1) })
    }

    /// `SETAL(65000,"TEXT")`: of these numbers it is told that the program is over.
    fn alarm(&mut self, text: &[char]) -> Result<Go, String> {
        let mut reader = Reader::new(text, &self.variables);
        let arguments = reader.arguments()?;
        match (&arguments[..], reader.over()) {
            ([Argument::Number(number, _)] | [Argument::Number(number, _), Argument::Text], true)
                if (61_000.0..62_000.0).contains(number) || (65_000.0..67_000.0).contains(number) =>
            {
                self.m.record(What::Alarm);
                Ok(Go::End)
            }
            _ => Err("SETAL of a number of which it is not known what it does".into()),
        }
    }

    /// `REPEAT LABEL P=n`, `REPEAT FIRST LAST P=n` and `REPEATB LABEL P=n`, of that block `alone`.
    fn repeat(&mut self, unit: &'a Unit, at: usize, items: &[Item], alone: bool) -> Result<Next, Halt> {
        let mut labels = Vec::new();
        let mut times = 1;
        for item in &items[1..] {
            match item {
                Item::Name(name) => labels.push(name.as_str()),
                Item::Named(name, value) if name == "P" => times = self.whole(value.number)?,
                Item::Word('P', value, _) => times = self.whole(value.number)?,
                _ => return self.m.halt("REPEAT and other words"),
            }
        }
        let place = |label: &str| -> Result<usize, Halt> {
            let mut found =
                (0..unit.blocks.len()).filter(|k| unit.blocks[*k].1.label.as_deref() == Some(label));
            match (found.next(), found.next()) {
                (Some(place), None) => Ok(place),
                _ => self.m.halt(format!("no label {label}, or several")),
            }
        };
        let (from, to) = match labels[..] {
            [label] => {
                let from = place(label)?;
                if from > at {
                    return self.m.halt("REPEAT of a label further on");
                }
                let ends = |k: &usize| unit.blocks[*k].1.label.as_deref() == Some("ENDLABEL");
                let to = (from..at).find(ends).map_or(at, |end| end + 1);
                (from, if alone { from + 1 } else { to })
            }
            [first, last] if !alone => (place(first)?, place(last)? + 1),
            _ => return self.m.halt("REPEAT of one label or two"),
        };
        if from >= to || (from..to).contains(&at) {
            return self.m.halt("REPEAT of itself");
        }
        for _ in 0..times {
            let next = self.blocks(unit, from, to)?;
            if next != Next::Block {
                return Ok(next);
            }
        }
        Ok(Next::Block)
    }

    pub(super) fn has_program(&self, name: &str) -> bool {
        self.units.iter().any(|unit| !unit.main && unit.name == name)
    }

    /// A subprogram of the same text, P times; `letters` other words belong to the call.
    pub(super) fn call(
        &mut self,
        name: &str,
        w: &Words,
        letters: usize,
        arguments: &[Argument],
    ) -> Result<Next, Halt> {
        let times = w.letter('P').or(w.named("P"));
        let beside = w.letters.len() + w.named.len() - letters - usize::from(times.is_some());
        let called = usize::from(w.call.is_some());
        if beside != 0 || w.names.len() + letters + called != 1 {
            return self.m.halt(format!("other words beside the call of {name}"));
        }
        let times = times.map_or(Ok(1), |p| self.whole(p.number))?;
        let units = self.units;
        let mut found = units.iter().filter(|unit| !unit.main && unit.name == name);
        let (Some(unit), None) = (found.next(), found.next()) else {
            return self.m.halt(format!("no subprogram {name}, or several"));
        };
        if self.depth == 11 || times == 0 {
            return self.m.halt("calls too deep, or P0");
        }
        let mut given = Vec::new();
        for argument in arguments {
            given.push(match argument {
                Argument::Empty => None,
                Argument::Number(number, None) => Some(Given::One(Worth::Number(*number, Kind::Real), None)),
                Argument::Array(name) => self.variables.array(name),
                Argument::Number(_, Some(place)) => match self.variables.get(place) {
                    Ok(value) => Some(Given::One(value, Some(place.clone()))),
                    Err(why) => return self.m.halt(why),
                },
                Argument::Text => return self.m.halt("a text for a subprogram"),
            });
        }
        if given == [None] {
            given.clear();
        }
        for _ in 0..times {
            let line = self.m.line;
            self.depth += 1;
            self.variables.enter();
            let before = self.saved();
            let heading = unit.blocks.first().and_then(|(_, block)| shape::first_word(&block.rest));
            let taken = match &heading {
                Some((word, rest)) if word == "PROC" => {
                    variables::parameters(rest, &given, &mut self.variables)
                }
                _ if given.is_empty() => Ok(Vec::new()),
                _ => Err(format!("{name} takes nothing")),
            };
            let references = match taken {
                Ok(references) => references,
                Err(why) => return self.m.halt(why),
            };
            // Seen in two ways, a variable would have two values for a while.
            let twice = |at: usize| references[at + 1..].iter().any(|(_, other)| *other == references[at].1);
            if (0..references.len()).any(twice) {
                return self.m.halt("a variable given twice by VAR");
            }
            // M30 in a subprogram leads back too; an alarm does not.
            let next = self.blocks(unit, 0, unit.blocks.len())?;
            self.depth -= 1;
            if let Err(why) = self.variables.leave(&references) {
                return self.m.halt(why);
            }
            if heading.is_some_and(|(word, rest)| word == "PROC" && saves(rest)) {
                self.restore(&before);
            }
            self.m.line = line;
            if next == Next::End && self.m.events.last().is_some_and(|e| e.what == What::Alarm) {
                return Ok(Next::End);
            }
        }
        Ok(Next::Block)
    }
}

/// Whether SAVE stands in the heading of a subprogram, behind what it takes.
fn saves(heading: &[char]) -> bool {
    let text: String = heading.iter().collect::<String>().to_ascii_uppercase();
    let behind = text.rsplit(')').next().unwrap_or(&text);
    behind.split_whitespace().any(|word| word == "SAVE")
}

/// What SAVE brings back: the G functions that are modal, and the frame that is programmed. Of a settable frame that
/// is still the one called up, new values stay (K2 08/2005, 2.4.10).
struct Modes {
    motion: Option<Motion>,
    frame: Frame,
    feed_inch: bool,
    inch: bool,
    absolute: bool,
    plane: u32,
    offset: u32,
    per: Per,
    surface: bool,
    corners: Corner,
}

impl Control<'_> {
    fn saved(&self) -> Modes {
        let m = &self.m;
        Modes {
            motion: self.motion,
            frame: self.frame,
            feed_inch: self.feed_inch,
            inch: m.inch,
            absolute: m.absolute,
            plane: m.plane,
            offset: m.offset,
            per: m.per,
            surface: m.surface,
            corners: m.corners,
        }
    }

    fn restore(&mut self, modes: &Modes) {
        let frame = std::mem::replace(&mut self.frame, modes.frame);
        for axis in 0..3 {
            self.m.settled[axis] &= frame.agrees(&modes.frame, axis);
        }
        if self.m.offset != modes.offset {
            self.m.settled = [false; 6];
        }
        (self.motion, self.feed_inch) = (modes.motion, modes.feed_inch);
        let m = &mut self.m;
        (m.inch, m.absolute, m.plane, m.offset) = (modes.inch, modes.absolute, modes.plane, modes.offset);
        (m.per, m.surface, m.corners) = (modes.per, modes.surface, modes.corners);
    }
}

/// A jump that is allowed.
fn into(unit: &Unit, from: usize, to: usize) -> Result<Go, String> {
    match &unit.shape {
        Ok(shape) if shape.enters(from, to) => Err("a jump into a structure".into()),
        _ => Ok(Go::To(to)),
    }
}

/// `GOTOF LABEL`, `GOTOB N100`: the block that is nearest in the direction of the jump; none where a GOTOC finds nothing.
fn destination(reader: &mut Reader, unit: &Unit, at: usize) -> Result<Option<usize>, String> {
    let Some(word) = reader.name() else { return Err("no GOTO".into()) };
    reader.blanks();
    let letter = reader.peek(0).to_ascii_uppercase();
    let (label, number) = if letter == '"' {
        match reader.expression()? {
            Worth::Text(text) => (Some(text.to_ascii_uppercase()), None),
            Worth::Number(..) => return Err("a GOTO to a number that is computed".into()),
        }
    } else if matches!(letter, 'N' | ':') && reader.peek(1).is_ascii_digit() {
        reader.at += 1;
        (None, Some(format!("{letter}{}", reader.digits().trim_start_matches('0'))))
    } else {
        let name = reader.name().ok_or("a GOTO to something computed")?;
        match reader.variables.get(&Place::Of(name.clone(), 0)) {
            Ok(Worth::Text(text)) => (Some(text.to_ascii_uppercase()), None),
            _ => (Some(name), None),
        }
    };
    let is_it = |k: &usize| {
        let block = &unit.blocks[*k].1;
        label.as_ref().is_some_and(|label| block.label.as_ref() == Some(label))
            || number.as_ref().is_some_and(|number| block.number.as_ref() == Some(number))
    };
    let forward = (at + 1..unit.blocks.len()).find(is_it);
    let backward = (0..=at).rev().find(is_it);
    let found = match word.as_str() {
        "GOTOF" => forward,
        "GOTOB" => backward,
        "GOTO" | "GOTOC" if forward.is_none() => {
            if (0..=at).filter(is_it).count() > 1 {
                return Err("a GOTO back, and labels twice".into());
            }
            backward
        }
        "GOTO" | "GOTOC" => forward,
        other => return Err(format!("the jump {other}")),
    };
    match found {
        None if word != "GOTOC" => Err(format!("{word} finds nothing")),
        found => Ok(found),
    }
}
