//! NC0808: a number without a decimal point that counts increments, in a program whose other numbers
//! have points. Where no number has one, that is the programmer's habit, and nothing is found; nor of a
//! number that would be absurd with a point (a metre and more, a feed of 20 m/min and more).

use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::source::Span;

use crate::finding::What;
use crate::rule::Rule;
use crate::watched::Watched;

/// So many numbers are kept; further ones are counted.
const MOST: usize = 1000;

/// A block may be looked at twice: so many numbers back, the same one is looked for.
const BACK: usize = 16;

/// A number without a point.
pub(crate) fn note(checker: &mut Watched, span: Span, read: Num, with_point: Num, feed: bool) {
    // What would be absurd with a point is meant as increments.
    let most = match (with_point.unit, feed) {
        (Unit::Inch, false) => 100,
        (Unit::Inch, true) => 1000,
        (_, false) => 1000,
        (_, true) => 20_000,
    };
    if with_point.mantissa.unsigned_abs() >= most {
        return;
    }
    let met = &mut checker.points;
    if met.last.contains(&span) {
        return;
    }
    if met.last.len() == BACK {
        met.last.pop_front();
    }
    met.last.push_back(span);
    match met.bare.len() < MOST {
        true => met.bare.push((span, read, with_point)),
        false => met.more += 1,
    }
}

/// The program is over.
pub(crate) fn finish(checker: &mut Watched) {
    if checker.points.pointed {
        for (span, read, with_point) in std::mem::take(&mut checker.points.bare) {
            checker.find(What::BareNumber { read, with_point }, span);
        }
        checker.findings.count(Rule::BareNumber, checker.points.more);
    }
}
