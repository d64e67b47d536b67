//! A recogniser for straight moves as the writer prints them, in front of the grammar.
//!
//! It takes `STRAIGHT_FEED(x, y, z)` and its kin with one blank after each comma and nothing else
//! on the line, and leaves everything else untouched. A test holds it against the grammar.

use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::Point;
use ncc_ir::program::cycle::absolute;

/// A straight move that was recognised.
pub(super) struct Straight {
    /// Rapid, or at feed.
    pub(super) traverse: bool,
    /// End point, in program coordinates.
    pub(super) to: Point,
    /// Length of the call.
    pub(super) length: usize,
    /// Length of the call with its line end.
    pub(super) line: usize,
}

/// Recognises a straight move at the start of the text; its lengths have this unit.
#[inline]
pub(super) fn straight(text: &[u8], unit: Unit) -> Option<Straight> {
    let (traverse, mut at) = if text.starts_with(b"STRAIGHT_FEED(") {
        (false, 14)
    } else if text.starts_with(b"STRAIGHT_TRAVERSE(") {
        (true, 18)
    } else {
        return None;
    };
    let mut to = Point::default();
    let mut count = 0;
    loop {
        let slot = to.axes.get_mut(count)?;
        if text.get(at) == Some(&b'_') {
            at += 1;
        } else {
            let (n, length) = number(text.get(at..)?, if count < 3 { unit } else { Unit::Degree })?;
            *slot = Some(absolute(n));
            at += length;
        }
        count += 1;
        match text.get(at)? {
            b',' if text.get(at + 1) == Some(&b' ') => at += 2,
            b')' => break,
            _ => return None,
        }
    }
    let length = at + 1;
    let line = match text.get(length..)? {
        [b'\n', ..] => length + 1,
        [b'\r', b'\n', ..] => length + 2,
        _ => return None,
    };
    (count == 3 || count == 6).then_some(Straight { traverse, to, length, line })
}

/// A number with digits before the point and after it.
#[inline]
fn number(text: &[u8], unit: Unit) -> Option<(Num, usize)> {
    let negative = text.first() == Some(&b'-');
    let start = usize::from(negative);
    let mut at = start;
    let mut mantissa = 0i64;
    while let Some(digit @ b'0'..=b'9') = text.get(at) {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(i64::from(digit - b'0'));
        at += 1;
    }
    if at == start || text.get(at) != Some(&b'.') {
        return None;
    }
    at += 1;
    let point = at;
    while let Some(digit @ b'0'..=b'9') = text.get(at) {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(i64::from(digit - b'0'));
        at += 1;
    }
    let scale = at - point;
    // 18 digits cannot overflow; rarer numbers are the grammar's.
    if scale == 0 || at - start > 19 {
        return None;
    }
    let mut n = Num { mantissa, scale: scale as u8, point: true, unit };
    if scale == 1 && text[at - 1] == b'0' {
        n.mantissa /= 10;
        n.scale = 0;
    }
    if negative {
        n.mantissa = -n.mantissa;
    }
    Some((n, at))
}
