//! The value of an expression: the meaning of its operators and functions.
//!
//! Numbers are binary floats of 64 bits, as in the controls that compute; angles are degrees. What a control
//! rounds or compares in a way of its own its front-end says with the functions here. Not here: which value a
//! variable has.

use crate::expr::{Binary, Function, Unary};

/// The value of an expression or variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// Nothing: the variable was never set. As an operand it counts as zero, but `==` and `!=` tell it from
    /// zero (Fanuc's `#0`; Mitsubishi M700V manual, "undefined variables").
    Vacant,
    /// A number. A comparison is worth 1 where it holds, else 0.
    Number(f64),
}

/// Why an expression is worth nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrong {
    /// A division, or a remainder, by zero.
    DivisionByZero,
    /// A function of a number for which it is not defined.
    NotDefined,
    /// More than a number can hold.
    TooLarge,
    /// A function has another number of arguments.
    Arguments,
    /// What must have a value has none: the variable was never set.
    NothingGiven,
}

impl Value {
    /// As an operand.
    #[inline]
    pub fn number(self) -> f64 {
        match self {
            Value::Vacant => 0.0,
            Value::Number(n) => n,
        }
    }
}

fn finite(n: f64) -> Result<f64, Wrong> {
    if n.is_finite() { Ok(n) } else { Err(Wrong::TooLarge) }
}

/// From here on a number is not rounded to a whole one.
const MOST_WHOLE: f64 = i32::MAX as f64 + 0.5;

/// 10⁰ to 10⁹.
const POWERS_OF_TEN: [f64; 10] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];

/// 2⁵²: from here on a number has no fraction.
const NO_FRACTION: f64 = 4_503_599_627_370_496.0;

/// As [`f64::round`], without a call of a library.
#[inline]
fn rounded(n: f64) -> f64 {
    let size = n.abs();
    if n.is_nan() || size >= NO_FRACTION {
        return n;
    }
    // The sum has no room for a fraction: the nearest whole number, of two the even one.
    let whole = size + NO_FRACTION - NO_FRACTION;
    let up = if size - whole >= 0.5 { 1.0 } else { 0.0 };
    (whole + up).copysign(n)
}

/// `roundto`, as [`function`] says.
///
/// # Errors
/// As of [`Wrong`].
#[inline]
pub fn round_to(n: f64, digits: f64) -> Result<f64, Wrong> {
    match POWERS_OF_TEN.get(digits as usize) {
        // A part of a digit, or less than none, is none of these.
        Some(by) if digits == f64::from(digits as u8) => {
            let rounded = rounded(n * by) / by;
            if rounded.is_nan() { Err(Wrong::NotDefined) } else { finite(rounded) }
        }
        Some(_) | None => Err(Wrong::NotDefined),
    }
}

const fn truth(holds: bool) -> f64 {
    if holds { 1.0 } else { 0.0 }
}

/// An operator with one operand.
#[inline]
pub fn unary(operator: Unary, a: f64) -> f64 {
    match operator {
        Unary::Negate => -a,
        Unary::Not => truth(a == 0.0),
    }
}

/// An operator with two operands. `and`, `or` and `xor` are those of conditions; `mod` leaves the remainder of a
/// division whose quotient is cut off towards zero. `==` and `!=` are of values, not of these numbers, where one
/// may be [`Value::Vacant`].
///
/// # Errors
/// As of [`Wrong`].
#[inline]
pub fn binary(operator: Binary, a: f64, b: f64) -> Result<f64, Wrong> {
    match operator {
        Binary::Add => finite(a + b),
        Binary::Subtract => finite(a - b),
        Binary::Multiply => finite(a * b),
        Binary::Divide | Binary::Modulo if b == 0.0 => Err(Wrong::DivisionByZero),
        Binary::Divide => finite(a / b),
        Binary::Modulo => finite(a % b),
        Binary::Power => {
            let n = a.powf(b);
            if n.is_nan() { Err(Wrong::NotDefined) } else { finite(n) }
        }
        Binary::Equal => Ok(truth(a == b)),
        Binary::NotEqual => Ok(truth(a != b)),
        Binary::Less => Ok(truth(a < b)),
        Binary::LessOrEqual => Ok(truth(a <= b)),
        Binary::Greater => Ok(truth(a > b)),
        Binary::GreaterOrEqual => Ok(truth(a >= b)),
        Binary::And => Ok(truth(a != 0.0 && b != 0.0)),
        Binary::Or => Ok(truth(a != 0.0 || b != 0.0)),
        Binary::Xor => Ok(truth((a != 0.0) != (b != 0.0))),
    }
}

impl Function {
    /// How many arguments it has.
    pub const fn arguments(self) -> usize {
        match self {
            Function::Near | Function::NearRatio => 3,
            Function::Atan2
            | Function::RoundTo
            | Function::Min
            | Function::Max
            | Function::Remainder
            | Function::BitAnd
            | Function::BitOr
            | Function::BitXor => 2,
            Function::Sin
            | Function::Cos
            | Function::Tan
            | Function::Asin
            | Function::Acos
            | Function::Sqrt
            | Function::Abs
            | Function::Round
            | Function::RoundUp
            | Function::Floor
            | Function::Ceiling
            | Function::Truncate
            | Function::Ln
            | Function::Exp
            | Function::Given => 1,
        }
    }
}

/// A function, of two numbers where it has two arguments. `asin` and `atan2` give -90 to 90 and more than -180 to 180
/// degrees, `acos` 0 to 180; `atan2` has the second axis first; `round` goes to the nearest whole number, halves away
/// from zero, `floor` down, `ceiling` up, `truncate` towards zero, `roundup` away from zero (Fanuc's `FUP`). `roundto`
/// rounds, halves away from zero, to as many digits after the point as its second argument says. `remainder` is that of
/// a division by the second argument, never negative (RS274/NGC's `MOD`; `mod` has the sign of what is divided).
/// `given` is its argument, which must have a value: nothing is an error there (a named parameter of RS274/NGC).
/// `bitand`, `bitor` and `bitxor` are of whole numbers, bit by bit. Those of three numbers are in [`near`].
///
/// # Errors
/// As of [`Wrong`].
#[inline]
pub fn function(function: Function, a: f64, b: f64) -> Result<f64, Wrong> {
    let n = match function {
        Function::Sin => a.to_radians().sin(),
        Function::Cos => a.to_radians().cos(),
        Function::Tan => a.to_radians().tan(),
        Function::Asin => a.asin().to_degrees(),
        Function::Acos => a.acos().to_degrees(),
        Function::Atan2 if a == 0.0 && b == 0.0 => f64::NAN,
        Function::Atan2 => a.atan2(b).to_degrees(),
        Function::Sqrt => a.sqrt(),
        Function::Abs => a.abs(),
        // What a control has for whole numbers ends there: LinuxCNC's interpreter gives the least of 32 bits for all
        // that lies beyond, a Sinumerik's INT has them too.
        Function::Round if a.abs() >= MOST_WHOLE => f64::NAN,
        Function::Round => rounded(a),
        Function::RoundTo => return round_to(a, b),
        Function::RoundUp => a.abs().ceil().copysign(a),
        Function::Floor => a.floor(),
        Function::Ceiling => a.ceil(),
        Function::Truncate => a.trunc(),
        Function::Ln if a == 0.0 => f64::NAN,
        Function::Ln => a.ln(),
        Function::Exp => a.exp(),
        Function::Given => a,
        Function::Min => a.min(b),
        Function::Max => a.max(b),
        Function::Remainder if b == 0.0 => return Err(Wrong::DivisionByZero),
        Function::Remainder => a.rem_euclid(b),
        Function::BitAnd => (bits(a)? & bits(b)?) as f64,
        Function::BitOr => (bits(a)? | bits(b)?) as f64,
        Function::BitXor => (bits(a)? ^ bits(b)?) as f64,
        Function::Near | Function::NearRatio => return Err(Wrong::Arguments),
    };
    if n.is_nan() { Err(Wrong::NotDefined) } else { finite(n) }
}

/// Whether two numbers are the same to within a tolerance: `near` to within that amount, `nearratio` to within that
/// part of the greater one. Worth 1 or 0, as a comparison is.
///
/// # Errors
/// A function of another number of arguments.
pub fn near(function: Function, a: f64, b: f64, tolerance: f64) -> Result<f64, Wrong> {
    let within = match function {
        Function::Near => tolerance,
        Function::NearRatio => tolerance * a.abs().max(b.abs()),
        _ => return Err(Wrong::Arguments),
    };
    Ok(truth((a - b).abs() <= within))
}

/// A whole number by its bits.
fn bits(n: f64) -> Result<i64, Wrong> {
    // Beyond it a number does not hold each whole one.
    if n == n.trunc() && n.abs() <= 9_007_199_254_740_992.0 { Ok(n as i64) } else { Err(Wrong::NotDefined) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_value_is_refused() {
        assert_eq!(binary(Binary::Divide, 1.0, 0.0), Err(Wrong::DivisionByZero));
        assert_eq!(binary(Binary::Modulo, 1.0, 0.0), Err(Wrong::DivisionByZero));
        assert_eq!(function(Function::Sqrt, -1.0, 0.0), Err(Wrong::NotDefined));
        assert_eq!(function(Function::Asin, 1.5, 0.0), Err(Wrong::NotDefined));
        assert_eq!(function(Function::Ln, 0.0, 0.0), Err(Wrong::NotDefined));
        assert_eq!(function(Function::Atan2, 0.0, 0.0), Err(Wrong::NotDefined));
        assert_eq!(function(Function::Exp, 1000.0, 0.0), Err(Wrong::TooLarge));
        assert_eq!(binary(Binary::Power, -8.0, 0.5), Err(Wrong::NotDefined));
    }

    /// Bit for bit what the library's functions give.
    #[test]
    fn rounding_is_that_of_the_library() {
        let ends =
            [0.0, 0.5, 1.5, 2.5, 1e9 + 0.5, NO_FRACTION - 0.5, NO_FRACTION, NO_FRACTION * 2.0 + 2.0, 1e300];
        let near = |n: f64| [n, n.next_up(), n.next_down()];
        let mut seed = 1u64;
        let made = (0..200_000).map(|_| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 20) as f64 / 10f64.powi((seed >> 60) as i32)
        });
        for n in ends.into_iter().flat_map(near).chain(made).flat_map(|n| [n, -n]) {
            assert_eq!(rounded(n).to_bits(), n.round().to_bits(), "{n}");
            for digits in [0u8, 3, 4, 9] {
                let by = 10f64.powi(digits.into());
                let usual = (n * by).round() / by;
                let of = function(Function::RoundTo, n, digits.into());
                assert_eq!(of.map(f64::to_bits), finite(usual).map(f64::to_bits), "{n} {digits}");
            }
        }
    }

    #[test]
    fn rounding_goes_where_its_name_says() {
        let of = |f, n| function(f, n, 0.0);
        assert_eq!(of(Function::Round, -2.5), Ok(-3.0));
        assert_eq!(of(Function::Floor, -2.5), Ok(-3.0));
        assert_eq!(of(Function::Ceiling, -2.5), Ok(-2.0));
        assert_eq!(of(Function::Truncate, -2.5), Ok(-2.0));
        assert_eq!(of(Function::RoundUp, -2.1), Ok(-3.0));
        assert_eq!(of(Function::RoundUp, 2.1), Ok(3.0));
        assert_eq!(function(Function::RoundTo, 12.3456, 3.0), Ok(12.346));
        assert_eq!(function(Function::RoundTo, -0.5, 0.0), Ok(-1.0));
        for digits in [0.5, -1.0, 10.0, f64::NAN, f64::INFINITY] {
            assert_eq!(function(Function::RoundTo, 1.0, digits), Err(Wrong::NotDefined));
        }
        assert_eq!(function(Function::RoundTo, 1e300, 9.0), Err(Wrong::TooLarge));
        assert_eq!(function(Function::Round, -2_147_483_647.4, 0.0), Ok(-2_147_483_647.0));
        assert_eq!(function(Function::Round, 2_147_483_647.5, 0.0), Err(Wrong::NotDefined));
        assert_eq!(binary(Binary::Modulo, -7.0, 3.0), Ok(-1.0));
        assert_eq!(function(Function::Remainder, -7.0, 3.0), Ok(2.0));
        assert_eq!(function(Function::Remainder, -7.0, 0.0), Err(Wrong::DivisionByZero));
    }

    #[test]
    fn tolerances_and_bits() {
        assert_eq!(near(Function::Near, 1.0, 1.000_001, 1e-5), Ok(1.0));
        assert_eq!(near(Function::Near, 1.0, 1.1, 1e-5), Ok(0.0));
        assert_eq!(near(Function::NearRatio, 1e9, 1e9 + 1.0, 1e-8), Ok(1.0));
        assert_eq!(near(Function::NearRatio, 1.0, 2.0, 1e-8), Ok(0.0));
        assert_eq!(function(Function::BitAnd, 6.0, 3.0), Ok(2.0));
        assert_eq!(function(Function::BitOr, 6.0, 3.0), Ok(7.0));
        assert_eq!(function(Function::BitXor, 6.0, 3.0), Ok(5.0));
        assert_eq!(function(Function::BitAnd, 0.5, 3.0), Err(Wrong::NotDefined));
    }
}
