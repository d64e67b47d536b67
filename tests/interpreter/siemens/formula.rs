//! Expressions of a Sinumerik, by the chapter on arithmetic of the Job Planning manual (03/2006, 1.5 to 1.9).
//!
//! From the tightest operators to the weakest: NOT and B_NOT; `*` `/` DIV MOD; `+` `-`; B_AND; B_XOR; B_OR; AND; XOR;
//! OR; `<<`; comparisons. Of the same priority the left one comes first. Real numbers are equal that differ by less
//! than 10^-12 of the greater one. Not here: operators of frames, DIV and MOD of numbers below zero where nothing
//! says of which sign the remainder is.

use super::text::Reader;
use super::variables::{Kind, Worth, whole};

/// Operators from the weakest to the tightest.
const PRIORITIES: [&[&str]; 10] = [
    &["==", "<>", ">=", "<=", ">", "<"],
    &["<<"],
    &["OR"],
    &["XOR"],
    &["AND"],
    &["B_OR"],
    &["B_XOR"],
    &["B_AND"],
    &["+", "-"],
    &["*", "/", "DIV", "MOD"],
];

impl Reader<'_> {
    /// An expression, as far as it goes.
    pub(super) fn expression(&mut self) -> Result<Worth, String> {
        self.level(0)
    }

    /// The number that an expression is.
    pub(super) fn amount(&mut self) -> Result<f64, String> {
        self.expression()?.number()
    }

    fn level(&mut self, level: usize) -> Result<Worth, String> {
        let Some(operators) = PRIORITIES.get(level) else { return self.signed() };
        // `<<` before the first of them makes a text of it.
        let alone = operators.contains(&"<<") && self.operator(operators).is_some();
        let mut left = self.level(level + 1)?;
        if alone {
            left = Worth::Text(shown(&left));
        }
        while let Some(operator) = self.operator(operators) {
            let right = self.level(level + 1)?;
            left = apply(operator, &left, &right)?;
        }
        Ok(left)
    }

    /// One of these operators, if it is next.
    fn operator(&mut self, of: &[&'static str]) -> Option<&'static str> {
        self.blanks();
        let start = self.at;
        if let Some(name) = self.name() {
            let found = of.iter().find(|operator| **operator == name).copied();
            self.at = if found.is_some() { self.at } else { start };
            return found;
        }
        let signs: String = self.text[start..].iter().take(2).collect();
        // `<<` and `<>` are no `<`.
        let long = PRIORITIES.iter().copied().flatten().find(|o| o.len() == 2 && **o == signs);
        let next = long.copied().or_else(|| of.iter().copied().find(|o| signs.starts_with(*o)))?;
        let found = of.contains(&next) && !next.starts_with(|c: char| c.is_ascii_alphabetic());
        self.at += if found { next.len() } else { 0 };
        found.then_some(next)
    }

    fn signed(&mut self) -> Result<Worth, String> {
        self.blanks();
        let start = self.at;
        match self.name().as_deref() {
            Some("NOT") => return Ok(truth(!self.signed()?.holds()?)),
            Some("B_NOT") => {
                let bits = !bits(self.signed()?.number()?)?;
                return Ok(Worth::Number(f64::from(bits), Kind::Int));
            }
            _ => self.at = start,
        }
        if self.take('-') {
            return match self.signed()? {
                Worth::Number(number, kind) => Ok(Worth::Number(-number, of_numbers(kind))),
                Worth::Text(_) => Err("a text below zero".into()),
            };
        }
        if self.take('+') {
            return self.signed();
        }
        self.operand()
    }

    fn operand(&mut self) -> Result<Worth, String> {
        self.blanks();
        match self.peek(0) {
            '(' => {
                self.take('(');
                let inside = self.expression()?;
                return if self.take(')') { Ok(inside) } else { Err("no end of parentheses".into()) };
            }
            '"' => return self.quoted().map(Worth::Text).ok_or_else(|| "a text without an end".into()),
            '\'' => return self.in_quotes(),
            '$' => return self.of_control(),
            'R' | 'r' if self.peek(1).is_ascii_digit() || self.peek(1) == '[' => {
                let place = self.place()?;
                return self.variables.get(&place);
            }
            c if c.is_ascii_digit() || c == '.' => {
                let start = self.at;
                let number = self.number()?;
                let digits = self.text[start..self.at].iter().all(char::is_ascii_digit);
                return Ok(Worth::Number(number, if digits { Kind::Int } else { Kind::Real }));
            }
            _ => {}
        }
        let start = self.at;
        let Some(name) = self.name() else { return Err(format!("no number, but {}", self.peek(0))) };
        if self.variables.has(&name) {
            self.at = start;
            let place = self.place()?;
            return self.variables.get(&place);
        }
        match name.as_str() {
            "TRUE" => Ok(truth(true)),
            "FALSE" => Ok(truth(false)),
            _ if self.take('(') => {
                let mut given = vec![self.expression()?];
                while self.take(',') {
                    given.push(self.expression()?);
                }
                if !self.take(')') {
                    return Err(format!("no end of the arguments of {name}"));
                }
                function(&name, &given)
            }
            _ => Err(format!("no variable {name}")),
        }
    }

    /// `'HF'` and `'B101'`.
    fn in_quotes(&mut self) -> Result<Worth, String> {
        self.at += 1;
        let start = self.at;
        while self.peek(0) != '\'' {
            if self.at >= self.text.len() {
                return Err("a number in quotes without an end".into());
            }
            self.at += 1;
        }
        let text: String = self.text[start..self.at].iter().collect();
        self.at += 1;
        let (radix, digits) = match text.split_at_checked(1) {
            Some(("H" | "h", digits)) => (16, digits),
            Some(("B" | "b", digits)) => (2, digits),
            _ => return Err(format!("the sign '{text}'")),
        };
        match u32::from_str_radix(digits, radix) {
            Ok(number) => Ok(Worth::Number(f64::from(number), Kind::Int)),
            Err(_) => Err(format!("no number: '{text}'")),
        }
    }

    /// `[1,X,TR]` and `[R1+1,X,TR]`: the number of a settable frame, and an axis of it.
    pub(super) fn frame_index(&mut self) -> Result<(u32, usize), String> {
        let wrong = || "the index of a settable frame".to_string();
        if !self.take('[') {
            return Err(wrong());
        }
        let number = self.expression()?.number()?.round();
        if !self.take(',') || !(1.0..=99.0).contains(&number) {
            return Err(wrong());
        }
        self.blanks();
        let axis = "XYZABC".find(self.peek(0).to_ascii_uppercase()).ok_or_else(wrong)?;
        self.at += 1;
        let rest = self.take(',') && self.name().as_deref() == Some("TR") && self.take(']');
        if rest { Ok((number as u32, axis)) } else { Err(wrong()) }
    }

    /// `$P_EP[X]` and its like.
    fn of_control(&mut self) -> Result<Worth, String> {
        self.at += 1;
        let name = self.name().ok_or("a $ alone")?;
        let known = &self.variables.known;
        match name.as_str() {
            "PI" => return Ok(Worth::Number(std::f64::consts::PI, Kind::Real)),
            "P_TOOLNO" => {
                let tool = known.tool.ok_or("the tool, and none is known")?;
                return Ok(Worth::Number(f64::from(tool), Kind::Int));
            }
            _ => {}
        }
        if name == "P_UIFR" {
            let (index, axis) = self.frame_index()?;
            let zero = known.zeros.get((index as usize).wrapping_sub(1)).filter(|_| !known.inch);
            let zero = zero.ok_or_else(|| format!("$P_UIFR[{index}] where it is not known"))?;
            return Ok(Worth::Number(zero[axis], Kind::Real));
        }
        let axis = if self.take('[') { "XYZABC".find(self.peek(0).to_ascii_uppercase()) } else { None };
        self.at += 1;
        let (Some(axis), true, false) = (axis, self.take(']'), known.inch) else {
            return Err(format!("${name}"));
        };
        match name.as_str() {
            "P_EP" | "AA_IW" => Ok(Worth::Number(known.end[axis], Kind::Real)),
            "AA_IM" => Ok(Worth::Number(known.machine[axis], Kind::Real)),
            _ => Err(format!("${name}")),
        }
    }
}

fn truth(holds: bool) -> Worth {
    Worth::Number(f64::from(u8::from(holds)), Kind::Bool)
}

/// A BOOL counts as a whole number.
fn of_numbers(kind: Kind) -> Kind {
    if kind == Kind::Real { Kind::Real } else { Kind::Int }
}

/// 32 of them.
fn bits(number: f64) -> Result<i32, String> {
    let number = whole(number)?;
    if number.abs() < 2f64.powi(31) { Ok(number as i32) } else { Err(format!("the bits of {number}")) }
}

/// Whether two numbers count as equal.
pub(super) fn same(left: &Worth, right: &Worth) -> Result<bool, String> {
    let (Worth::Number(a, one), Worth::Number(b, other)) = (left, right) else {
        return Ok(left == right);
    };
    if *one == Kind::Real || *other == Kind::Real {
        return Ok((a - b).abs() <= a.abs().max(b.abs()) * 1e-12);
    }
    Ok(a == b)
}

fn apply(operator: &str, left: &Worth, right: &Worth) -> Result<Worth, String> {
    match operator {
        "<<" => return Ok(Worth::Text(format!("{}{}", shown(left), shown(right)))),
        "==" => return same(left, right).map(truth),
        "<>" => return same(left, right).map(|same| truth(!same)),
        "OR" => return Ok(truth(left.holds()? | right.holds()?)),
        "XOR" => return Ok(truth(left.holds()? != right.holds()?)),
        "AND" => return Ok(truth(left.holds()? & right.holds()?)),
        _ => {}
    }
    let (Worth::Number(a, one), Worth::Number(b, other)) = (left, right) else {
        return Err(format!("{operator} of texts"));
    };
    let same = same(left, right)?;
    let kind = if *one == Kind::Real || *other == Kind::Real { Kind::Real } else { Kind::Int };
    let number = match operator {
        ">=" => return Ok(truth(same || a > b)),
        "<=" => return Ok(truth(same || a < b)),
        ">" => return Ok(truth(!same && a > b)),
        "<" => return Ok(truth(!same && a < b)),
        "B_OR" => f64::from(bits(*a)? | bits(*b)?),
        "B_XOR" => f64::from(bits(*a)? ^ bits(*b)?),
        "B_AND" => f64::from(bits(*a)? & bits(*b)?),
        "+" => a + b,
        "-" => a - b,
        "*" => a * b,
        "/" | "DIV" | "MOD" if *b == 0.0 => return Err("a division by zero".into()),
        // Of whole numbers too it is a real one.
        "/" => return Ok(Worth::Number(a / b, Kind::Real)),
        "DIV" => (a / b).trunc(),
        "MOD" if *a < 0.0 || *b < 0.0 => return Err("MOD of a number below zero".into()),
        "MOD" => a - b * (a / b).trunc(),
        _ => return Err(format!("the operator {operator}")),
    };
    if !number.is_finite() {
        return Err(format!("{a} {operator} {b}"));
    }
    Ok(Worth::Number(number, if operator.starts_with("B_") { Kind::Int } else { kind }))
}

/// As part of a text; how many digits a real number has there is no matter of a move.
fn shown(worth: &Worth) -> String {
    match worth {
        Worth::Text(text) => text.clone(),
        Worth::Number(number, Kind::Real) => format!("{number} "),
        Worth::Number(number, _) => format!("{number}"),
    }
}

fn function(name: &str, given: &[Worth]) -> Result<Worth, String> {
    let numbers = given.iter().map(Worth::number).collect::<Result<Vec<f64>, _>>()?;
    let number = match (name, &numbers[..]) {
        ("SIN", [a]) => a.to_radians().sin(),
        ("COS", [a]) => a.to_radians().cos(),
        ("TAN", [a]) => a.to_radians().sin() / a.to_radians().cos(),
        ("ASIN", [a]) if a.abs() <= 1.0 => a.asin().to_degrees(),
        ("ACOS", [a]) if a.abs() <= 1.0 => a.acos().to_degrees(),
        // From -180 to 180 degrees, the first one along the second axis.
        ("ATAN2", [a, b]) if *a != 0.0 || *b != 0.0 => a.atan2(*b).to_degrees(),
        ("SQRT", [a]) if *a >= 0.0 => a.sqrt(),
        ("POT", [a]) => a * a,
        ("ABS", [a]) => a.abs(),
        ("LN", [a]) if *a > 0.0 => a.ln(),
        ("EXP", [a]) => a.exp(),
        ("TRUNC", [a]) => a.trunc(),
        ("ROUND", [a]) => whole(*a)?,
        // Below zero, the manual's words go one way (the next smaller) and its examples the other.
        ("ROUNDUP", [a]) if *a < 0.0 && *a != a.trunc() => {
            return Err("ROUNDUP of a number below zero is open".into());
        }
        ("ROUNDUP", [a]) => a.ceil(),
        ("MINVAL", [a, b]) => a.min(*b),
        ("MAXVAL", [a, b]) => a.max(*b),
        ("BOUND", [low, high, a]) if low <= high => a.max(*low).min(*high),
        _ => return Err(format!("the function {name} of {numbers:?}")),
    };
    let real = given.iter().any(|worth| matches!(worth, Worth::Number(_, Kind::Real)));
    // Whole numbers stay such where nothing is computed of them.
    let same_kind = matches!(name, "ABS" | "MINVAL" | "MAXVAL" | "BOUND") && !real;
    if !number.is_finite() {
        return Err(format!("{name} of {numbers:?}"));
    }
    Ok(Worth::Number(number, if same_kind { Kind::Int } else { Kind::Real }))
}
