//! Expressions of custom macro B, worked out from their text each time they are met.
//!
//! Functions come first, then `* / AND MOD`, then `+ - OR XOR`, then comparisons, each from left to right; a sign
//! stands in front of a whole expression or bracket. Angles are degrees. What no manual settles stops.

use super::{Rounding, Variables};

/// What a piece of an expression is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Worth {
    /// A number, or nothing where a variable that was never set stands alone.
    Number(Option<f64>),
    /// Whether a condition holds.
    Truth(bool),
}

/// Reads an expression from the front of a text.
pub(super) struct Formula<'t> {
    pub(super) rest: &'t str,
    variables: &'t Variables,
    /// What ROUND does where the expression stands.
    rounding: Rounding,
    depth: u32,
}

impl<'t> Formula<'t> {
    pub(super) fn new(text: &'t str, variables: &'t Variables, rounding: Rounding) -> Formula<'t> {
        Formula { rest: text, variables, rounding, depth: 0 }
    }

    fn take(&mut self, sign: &str) -> bool {
        let Some(rest) = self.rest.strip_prefix(sign) else { return false };
        self.rest = rest;
        true
    }

    fn one_of<'s>(&mut self, signs: &[&'s str]) -> Option<&'s str> {
        signs.iter().copied().find(|sign| self.take(sign))
    }

    /// A sum, or a comparison of two.
    pub(super) fn condition(&mut self) -> Result<Worth, String> {
        let left = self.sum()?;
        let Some(how) = self.one_of(&["EQ", "NE", "GT", "GE", "LT", "LE"]) else { return Ok(left) };
        let right = self.sum()?;
        let (Worth::Number(a), Worth::Number(b)) = (left, right) else {
            return Err("a comparison of conditions".into());
        };
        // Only EQ and NE tell nothing from zero.
        let (x, y) = (a.unwrap_or(0.0), b.unwrap_or(0.0));
        let same = a.is_some() == b.is_some() && x == y;
        Ok(Worth::Truth(match how {
            "EQ" => same,
            "NE" => !same,
            "GT" => x > y,
            "GE" => x >= y,
            "LT" => x < y,
            _ => x <= y,
        }))
    }

    fn sum(&mut self) -> Result<Worth, String> {
        let sign = self.one_of(&["+", "-"]);
        let mut left = self.product()?;
        if sign == Some("-") {
            left = match left {
                Worth::Number(n) => Worth::Number(Some(-n.unwrap_or(0.0))),
                Worth::Truth(_) => return Err("the negative of a condition".into()),
            };
        }
        while let Some(how) = self.one_of(&["+", "-", "OR", "XOR"]) {
            let right = self.product()?;
            left = apply(how, left, right)?;
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Worth, String> {
        let mut left = self.operand()?;
        while let Some(how) = self.one_of(&["*", "/", "AND", "MOD"]) {
            let right = self.operand()?;
            left = apply(how, left, right)?;
        }
        Ok(left)
    }

    fn bracket(&mut self) -> Result<Worth, String> {
        match self.brackets()? {
            (worth, None) => Ok(worth),
            (_, Some(_)) => Err("a comma in a bracket".into()),
        }
    }

    /// What a bracket comes to, and what stands behind a comma in it.
    fn brackets(&mut self) -> Result<(Worth, Option<Worth>), String> {
        if !self.take("[") {
            return Err(format!("a bracket is missing before {}", self.rest));
        }
        self.depth += 1;
        if self.depth > 5 {
            return Err("brackets six deep".into());
        }
        let worth = self.condition()?;
        let second = if self.take(",") { Some(self.condition()?) } else { None };
        self.depth -= 1;
        if !self.take("]") {
            return Err(format!("a bracket is not closed before {}", self.rest));
        }
        Ok((worth, second))
    }

    /// A bracket with a number in it.
    fn argument(&mut self) -> Result<f64, String> {
        worth_of(self.bracket()?)
    }

    /// A bracket with one number in it, or two.
    fn arguments(&mut self) -> Result<(f64, Option<f64>), String> {
        let (first, second) = self.brackets()?;
        Ok((worth_of(first)?, second.map(worth_of).transpose()?))
    }

    /// A variable by its number, or by an expression that is rounded to it.
    pub(super) fn variable_number(&mut self) -> Result<u32, String> {
        let end = self.rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(self.rest.len());
        if end > 0 {
            let (digits, rest) = self.rest.split_at(end);
            self.rest = rest;
            return digits.parse().map_err(|_| format!("a variable {digits}"));
        }
        let rounding = std::mem::replace(&mut self.rounding, Rounding::Whole);
        let number = self.argument()?;
        self.rounding = rounding;
        let number = super::round(number);
        if (0.0..1e6).contains(&number) { Ok(number as u32) } else { Err(format!("a variable {number}")) }
    }

    fn operand(&mut self) -> Result<Worth, String> {
        if self.rest.starts_with('[') {
            // Whether what has no value still has none within brackets, nothing tells.
            return match self.bracket()? {
                Worth::Number(None) => Err("a variable without a value alone in brackets".into()),
                worth => Ok(worth),
            };
        }
        if self.take("#") {
            let number = self.variable_number()?;
            return self.variables.read(number).map(Worth::Number);
        }
        let digits = self.rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(self.rest.len());
        if digits > 0 {
            let (text, rest) = self.rest.split_at(digits);
            self.rest = rest;
            return text.parse().map(|n| Worth::Number(Some(n))).map_err(|_| format!("no number: {text}"));
        }
        self.function().map(|n| Worth::Number(Some(n)))
    }

    /// A function; the control looks at the first two letters of its name.
    fn function(&mut self) -> Result<f64, String> {
        let end = self.rest.find(|c: char| !c.is_ascii_uppercase()).unwrap_or(self.rest.len());
        let (name, rest) = self.rest.split_at(end);
        self.rest = rest;
        let full = [
            "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "SQRT", "ABS", "ROUND", "FIX", "FUP", "LN", "EXP",
            "POW",
        ];
        let full = full.iter().find(|full| name == **full || name.len() == 2 && full.starts_with(name));
        let Some(name) = full.copied().or((name == "SQR").then_some("SQRT")) else {
            return Err(format!("the function {name}"));
        };
        // The others are in no list of its functions, and of these two the range or the arguments are open.
        if self.variables.haas && matches!(name, "FUP" | "LN" | "EXP" | "ASIN" | "ATAN" | "POW") {
            return Err(format!("{name} on a Haas"));
        }
        let (a, second) = self.arguments()?;
        if second.is_some() != (name == "POW") && name != "ATAN" {
            return Err(format!("{name} of another number of arguments"));
        }
        let n = match name {
            "SIN" => a.to_radians().sin(),
            "COS" => a.to_radians().cos(),
            "TAN" => a.to_radians().sin() / a.to_radians().cos(),
            // From 270 over 0 to 90 degrees.
            "ASIN" if a.abs() <= 1.0 => from_zero(a.asin().to_degrees()),
            "ACOS" if a.abs() <= 1.0 => a.acos().to_degrees(),
            "ATAN" => {
                let b = match second {
                    Some(b) => b,
                    None if self.take("/") => self.argument()?,
                    None => return Err("ATAN of one number".into()),
                };
                if a == 0.0 && b == 0.0 {
                    return Err("ATAN of no direction".into());
                }
                from_zero(a.atan2(b).to_degrees())
            }
            "SQRT" if a >= 0.0 => a.sqrt(),
            "ABS" => a.abs(),
            "ROUND" => match self.rounding {
                Rounding::Whole => super::round(a),
                Rounding::To(digits) => super::round_to(a, digits),
                Rounding::Open => return Err("ROUND where nothing says to what".into()),
            },
            // By how large a number is, whatever its sign.
            "FIX" => a.signum() * a.abs().floor(),
            "FUP" => a.signum() * a.abs().ceil(),
            "LN" if a > 0.0 => a.ln(),
            "EXP" => a.exp(),
            "POW" => a.powf(second.unwrap_or(f64::NAN)),
            _ => return Err(format!("{name} of {a}")),
        };
        if n.is_finite() { Ok(n) } else { Err(format!("{name} of {a}")) }
    }
}

fn worth_of(argument: Worth) -> Result<f64, String> {
    match argument {
        Worth::Number(n) => Ok(n.unwrap_or(0.0)),
        Worth::Truth(_) => Err("a function of a condition".into()),
    }
}

/// An angle between 0 and 360 degrees.
fn from_zero(angle: f64) -> f64 {
    if angle < 0.0 { angle + 360.0 } else { angle }
}

fn apply(how: &str, left: Worth, right: Worth) -> Result<Worth, String> {
    let (a, b) = match (left, right) {
        (Worth::Number(a), Worth::Number(b)) => (a.unwrap_or(0.0), b.unwrap_or(0.0)),
        (Worth::Truth(a), Worth::Truth(b)) => {
            return Ok(Worth::Truth(match how {
                "AND" => a && b,
                "OR" => a || b,
                "XOR" => a != b,
                _ => return Err(format!("{how} of conditions")),
            }));
        }
        _ => return Err(format!("{how} of a condition and a number")),
    };
    let bits = || {
        let bits =
            |n: f64| if n >= 0.0 && n < 2f64.powi(31) && n == n.floor() { Ok(n as u32) } else { Err(()) };
        match (bits(a), bits(b)) {
            (Ok(a), Ok(b)) => Ok((a, b)),
            _ => Err(format!("{how} of {a} and {b}, which are no whole numbers of 31 bits")),
        }
    };
    let n = match how {
        "+" => a + b,
        "-" => a - b,
        "*" => a * b,
        "/" if b != 0.0 => a / b,
        // Operands that are not whole are rounded first on some controls, and not on others.
        "MOD" if b != 0.0 && a == a.floor() && b == b.floor() => a - b * (a / b).trunc(),
        "MOD" if b != 0.0 => return Err("MOD of numbers that are not whole".into()),
        "AND" => bits().map(|(a, b)| f64::from(a & b))?,
        "OR" => bits().map(|(a, b)| f64::from(a | b))?,
        "XOR" => bits().map(|(a, b)| f64::from(a ^ b))?,
        _ => return Err("a division by zero".into()),
    };
    if n.is_finite() { Ok(Worth::Number(Some(n))) } else { Err(format!("{a} {how} {b}")) }
}
