//! Parameters and expressions, from the overview of LinuxCNC's documentation (numbered and named parameters, binary
//! operators, functions): a value is worked out as its text is read.

use std::collections::BTreeMap;

use super::super::{Halt, Per};
use super::Control;

/// The parameters of a level of calls.
#[derive(Clone, Debug, Default)]
pub(super) struct Level {
    pub(super) numbers: BTreeMap<u32, f64>,
    pub(super) names: BTreeMap<String, f64>,
    /// Whether a number that was not set is zero: an argument that was left out.
    pub(super) called: bool,
}

/// All parameters.
#[derive(Clone, Debug)]
pub(super) struct Parameters {
    pub(super) levels: Vec<Level>,
    pub(super) shared: BTreeMap<u32, f64>,
    pub(super) global: BTreeMap<String, f64>,
}

impl Parameters {
    /// Those that a program finds.
    pub(super) fn found(shared: &BTreeMap<u32, f64>) -> Parameters {
        let global = BTreeMap::from([("_VALUE".to_owned(), 0.0), ("_VALUE_RETURNED".to_owned(), 0.0)]);
        Parameters { levels: vec![Level::default()], shared: shared.clone(), global }
    }
}

/// What a setting sets.
pub(super) enum Place {
    Number(u32),
    Name(String),
}

/// Text from which values are read, in capitals and without blanks.
pub(super) struct Reading<'t> {
    pub(super) rest: &'t str,
}

impl Reading<'_> {
    fn take(&mut self, word: &str) -> bool {
        match self.rest.strip_prefix(word) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }
}

/// Operators by how firmly they bind.
const LEVELS: [&[&str]; 5] =
    [&["XOR", "AND", "OR"], &["EQ", "NE", "GT", "GE", "LT", "LE"], &["+", "-"], &["*", "/", "MOD"], &["**"]];

const FUNCTIONS: [&str; 12] =
    ["ABS", "ACOS", "ASIN", "COS", "EXP", "FIX", "FUP", "LN", "ROUND", "SIN", "SQRT", "TAN"];

/// How near two numbers are that are the same.
const SAME: f64 = 1e-6;

impl Control {
    /// A number, a parameter, a function, or an expression in brackets.
    pub(super) fn value(&self, text: &mut Reading) -> Result<f64, Halt> {
        if text.take("+") {
            return self.value(text);
        }
        if text.take("-") {
            return self.value(text).map(|n| -n);
        }
        if text.take("#") {
            let place = self.place(text)?;
            return self.read(&place);
        }
        if text.rest.starts_with('[') {
            return self.bracketed(text);
        }
        if text.take("EXISTS[#<") {
            let Some((name, behind)) = text.rest.split_once(">]") else { return self.m.halt("EXISTS") };
            let found = match name.starts_with('_') {
                true => self.parameters.global.contains_key(name),
                false => self.calls().names.contains_key(name),
            };
            text.rest = behind;
            return Ok(f64::from(u8::from(found)));
        }
        if text.take("ATAN") {
            let up = self.bracketed(text)?;
            if !text.take("/") {
                return self.m.halt("ATAN of one value");
            }
            let along = self.bracketed(text)?;
            return Ok(up.atan2(along) * 180.0 / std::f64::consts::PI);
        }
        if let Some(name) = FUNCTIONS.iter().find(|name| text.rest.starts_with(**name)) {
            text.take(name);
            let n = self.bracketed(text)?;
            return self.function(name, n);
        }
        let end = text.rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(text.rest.len());
        let Ok(number) = text.rest[..end].parse() else {
            return self.m.halt(format!("no value: {}", text.rest));
        };
        text.rest = &text.rest[end..];
        Ok(number)
    }

    fn bracketed(&self, text: &mut Reading) -> Result<f64, Halt> {
        if !text.take("[") {
            return self.m.halt("[ is missing");
        }
        let value = self.joined(text, 0)?;
        if !text.take("]") {
            return self.m.halt("] is missing");
        }
        Ok(value)
    }

    /// What operators of a level, or firmer ones, join; the left one first.
    fn joined(&self, text: &mut Reading, level: usize) -> Result<f64, Halt> {
        if level == LEVELS.len() {
            return self.value(text);
        }
        let mut left = self.joined(text, level + 1)?;
        loop {
            // A single star is none of two.
            let found = LEVELS[level].iter().find(|operator| {
                text.rest.starts_with(**operator) && !(**operator == "*" && text.rest.starts_with("**"))
            });
            let Some(operator) = found else { return Ok(left) };
            text.take(operator);
            let right = self.joined(text, level + 1)?;
            left = self.operate(operator, left, right)?;
        }
    }

    fn operate(&self, operator: &str, a: f64, b: f64) -> Result<f64, Halt> {
        let holds = |holds: bool| Ok(if holds { 1.0 } else { 0.0 });
        let (yes, also) = (a != 0.0, b != 0.0);
        let same = (a - b).abs() < SAME;
        match operator {
            "+" => Ok(a + b),
            "-" => Ok(a - b),
            "*" => Ok(a * b),
            "/" if b == 0.0 => self.m.halt("a division by zero"),
            "/" => Ok(a / b),
            "MOD" => Ok(a - b.abs() * (a / b.abs()).floor()),
            "**" if self.m.setup.last_digits_up => Ok(a.powf(b) * (1.0 + 1e-15)),
            "**" => Ok(a.powf(b)),
            "AND" => holds(yes && also),
            "OR" => holds(yes || also),
            "XOR" => holds(yes != also),
            "EQ" => holds(same),
            "NE" => holds(!same),
            "GT" => holds(a > b),
            "LT" => holds(a < b),
            "GE" => holds(a >= b || same),
            "LE" => holds(a <= b || same),
            _ => self.m.halt("an operator"),
        }
    }

    fn function(&self, name: &str, n: f64) -> Result<f64, Halt> {
        let (turn, back) = (std::f64::consts::PI / 180.0, 180.0 / std::f64::consts::PI);
        let result = match name {
            "ABS" => n.abs(),
            "ACOS" => n.acos() * back,
            "ASIN" => n.asin() * back,
            "COS" => (n * turn).cos(),
            "EXP" => n.exp(),
            "FIX" => n.floor(),
            "FUP" => n.ceil(),
            "LN" => n.ln(),
            "ROUND" if n < 0.0 => (n - 0.5).ceil(),
            "ROUND" => (n + 0.5).floor(),
            "SIN" => (n * turn).sin(),
            "SQRT" => n.sqrt(),
            _ => (n * turn).tan(),
        };
        if result.is_finite() { Ok(result) } else { self.m.halt(format!("{name} of {n}")) }
    }

    fn calls(&self) -> &Level {
        &self.parameters.levels[self.parameters.levels.len() - 1]
    }

    /// Which parameter stands behind a `#`.
    pub(super) fn place(&self, text: &mut Reading) -> Result<Place, Halt> {
        if text.take("<") {
            let Some((name, behind)) = text.rest.split_once('>') else { return self.m.halt("> is missing") };
            text.rest = behind;
            return Ok(Place::Name(name.to_owned()));
        }
        let number = self.value(text)?;
        let whole = number.round();
        if (number - whole).abs() > 1e-4 || !(1.0..5603.0).contains(&whole) {
            return self.m.halt(format!("parameter {number}"));
        }
        Ok(Place::Number(whole as u32))
    }

    fn read(&self, place: &Place) -> Result<f64, Halt> {
        let found = match place {
            Place::Number(n @ 1..=30) => match self.calls().numbers.get(n) {
                None if self.calls().called => Some(0.0),
                found => found.copied(),
            },
            Place::Number(n @ 31..=5000) => self.parameters.shared.get(n).copied(),
            Place::Number(n @ 5420..=5425) => self.stands((n - 5420) as usize),
            // In millimetres, the machine's unit.
            Place::Number(n @ 5401..=5403) => self.m.stored_offset((n - 5401) as usize),
            Place::Number(5410) => self.m.stored_diameter(),
            // In the coordinates that the probing move had, in the unit in force.
            Place::Number(n @ 5061..=5066) => {
                let unit = if *n < 5064 { self.unit() } else { 1.0 };
                self.m.touched.filter(|_| !self.offset_turned()).map(|at| at[(n - 5061) as usize] / unit)
            }
            Place::Number(5067..=5069) => Some(0.0),
            // Coordinate systems: twenty numbers for each, lengths in millimetres, the machine's unit.
            Place::Number(n @ 5221..=5390) => {
                let (system, axis) = ((n - 5221) / 20 + 1, (n - 5221) % 20);
                match axis {
                    0..=5 => Some(self.m.zero_of(system)[axis as usize]),
                    6..=8 => Some(0.0),
                    9 => Some(self.m.turn_of(system)),
                    _ => None,
                }
            }
            Place::Number(5220) => Some(f64::from(self.m.offset)),
            Place::Number(_) => None,
            Place::Name(name) if !name.starts_with('_') => self.calls().names.get(name).copied(),
            Place::Name(name) => match self.parameters.global.get(name) {
                Some(value) => Some(*value),
                None => self.known(name),
            },
        };
        match (found, place) {
            (Some(value), _) => Ok(value),
            (None, Place::Number(n)) => self.m.halt(format!("#{n} is not known")),
            (None, Place::Name(name)) => self.m.halt(format!("#<{name}> is not known")),
        }
    }

    /// Whether the work offset in force is turned.
    fn offset_turned(&self) -> bool {
        self.m.turn_of(self.m.offset) != 0.0
    }

    /// Where the tool stands along an axis, in the unit in force.
    fn stands(&self, axis: usize) -> Option<f64> {
        if self.offset_turned() || self.m.beside.is_some() {
            return None;
        }
        let unit = if axis < 3 { self.unit() } else { 1.0 };
        Some((self.m.at[axis] - self.m.shift(axis)) / unit)
    }

    /// Names that the control itself has.
    fn known(&self, name: &str) -> Option<f64> {
        let holds = |holds: bool| Some(if holds { 1.0 } else { 0.0 });
        match name {
            "_CURRENT_TOOL" => self.m.tool.map(f64::from),
            "_METRIC" => holds(!self.m.inch),
            "_IMPERIAL" => holds(self.m.inch),
            "_ABSOLUTE" => holds(self.m.absolute),
            "_INCREMENTAL" => holds(!self.m.absolute),
            "_RETRACT_OLD_Z" => holds(self.return_initial),
            "_RETRACT_R_PLANE" => holds(!self.return_initial),
            "_INVERSE_TIME" => holds(self.m.per == Per::Move),
            "_UNITS_PER_MINUTE" => holds(self.m.per == Per::Minute),
            "_UNITS_PER_REV" => holds(self.m.per == Per::Turn),
            "_RPM" => self.m.speed.filter(|_| !self.m.surface),
            "_SELECTED_TOOL" => self.m.selected.map(f64::from),
            "_FEED" => self.m.feed.map(|feed| feed / self.unit()),
            _ => {
                let axis = ["_X", "_Y", "_Z", "_A", "_B", "_C"].iter().position(|axis| *axis == name)?;
                self.stands(axis)
            }
        }
    }

    /// Gives a parameter a value.
    pub(super) fn set(&mut self, place: Place, value: f64) -> Result<(), Halt> {
        let last = self.parameters.levels.len() - 1;
        match place {
            Place::Number(n @ 1..=30) => drop(self.parameters.levels[last].numbers.insert(n, value)),
            Place::Number(n @ 31..=5000) => drop(self.parameters.shared.insert(n, value)),
            Place::Number(n) => return self.m.halt(format!("#{n} is set")),
            Place::Name(name) if name.starts_with('_') => drop(self.parameters.global.insert(name, value)),
            Place::Name(name) => drop(self.parameters.levels[last].names.insert(name, value)),
        }
        Ok(())
    }
}
