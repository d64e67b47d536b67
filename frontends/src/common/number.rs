//! Units and texts of numbers.

use ncc_ir::canon::{Fact, Units};
use ncc_ir::expr::num::{Num, Unit};

/// The unit of a length.
pub(crate) fn unit_of(units: Fact<Units>) -> Unit {
    match units {
        Fact::Known(Units::Mm) => Unit::Mm,
        Fact::Known(Units::Inch) => Unit::Inch,
        Fact::Entry => Unit::Entry,
    }
}

/// A literal for people.
pub(crate) fn spell(num: Num) -> String {
    let sign = if num.mantissa < 0 { "-" } else { "" };
    let digits = format!("{:0width$}", num.mantissa.unsigned_abs(), width = usize::from(num.scale) + 1);
    let (whole, part) = digits.split_at(digits.len() - usize::from(num.scale));
    let point = if part.is_empty() { "" } else { "." };
    let unit = match num.unit {
        Unit::One | Unit::Entry => "",
        Unit::Mm => " mm",
        Unit::Inch => " inch",
        Unit::Degree => " degrees",
        Unit::Second => " s",
    };
    format!("{sign}{whole}{point}{part}{unit}")
}
