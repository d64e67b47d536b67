//! How straight moves are packed, and unpacked.
//!
//! Not here: what is known of them without unpacking (`packed`).

use super::packed::{InForce, PackedLines};
use super::{Coord, Move, Op, Point, Stmt};
use crate::canon::{AXES, Axis, Distance, Fact};
use crate::expr::Expr;
use crate::expr::num::{Num, Unit};
use crate::source::Span;

/// Bits of a statement's first byte: two of its kind, then whether it has these, then an axis each.
const SAID: u8 = 1 << 2;
const JOINED: u8 = 1 << 3;
const NUMBERED: u8 = 1 << 4;
const AXIS: u8 = 1 << 5;

/// Kinds of statements, and of the note that the words behind it have another unit or distance.
const FEED: u8 = 0;
const TRAVERSE: u8 = 1;
const RATE: u8 = 2;
const FORM: u8 = 3;

const UNITS: [Unit; 6] = [Unit::One, Unit::Mm, Unit::Inch, Unit::Entry, Unit::Degree, Unit::Second];

const DISTANCES: [Fact<Distance>; 3] =
    [Fact::Entry, Fact::Known(Distance::Absolute), Fact::Known(Distance::Incremental)];

/// The place of a value in a list of all of them.
fn place<T: PartialEq>(all: &[T], value: &T) -> u8 {
    all.iter().position(|own| own == value).unwrap_or(0) as u8
}

/// Largest mantissa that is packed.
const MOST: u64 = 1 << 56;

fn packs_number(value: &Expr) -> bool {
    value.literal().is_some_and(|num| num.mantissa.unsigned_abs() < MOST && num.scale < 16)
}

/// Whether a statement may be packed: a straight move in X, Y and Z by literals that are no increments (moves behind a
/// stretch could not say again where it leaves the tool), or a feed, without a comment, that no switch
/// leaves out.
pub fn packs(stmt: &Stmt) -> bool {
    stmt.skip.is_none()
        && stmt.comment.is_none()
        && match &stmt.op {
            Op::StraightFeed(to) | Op::StraightTraverse(to) => {
                let (linear, rotary) = to.to.axes.split_at(Axis::A as usize);
                let mut words = linear.iter().flatten();
                let first = words.next().map(|word| (form_of(word), packs_number(&word.value)));
                let same = |word: &Coord| first.is_some_and(|(form, _)| form == form_of(word));
                let counts = |word: &Coord| word.distance != Fact::Known(Distance::Incremental);
                first.is_some_and(|(_, packs)| packs)
                    && linear.iter().flatten().all(counts)
                    && words.all(|word| packs_number(&word.value) && same(word))
                    && rotary.iter().all(Option::is_none)
            }
            Op::SetFeedRate(feed) => packs_number(feed),
            _ => false,
        }
}

fn form_of(word: &Coord) -> (u8, u8) {
    let unit = word.value.literal().map_or(Unit::One, |num| num.unit);
    (place(&UNITS, &unit), place(&DISTANCES, &word.distance))
}

fn put(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

/// A difference, small whichever way it goes.
fn put_signed(bytes: &mut Vec<u8>, value: i64) {
    put(bytes, (value << 1 ^ value >> 63) as u64);
}

fn put_number(bytes: &mut Vec<u8>, num: Num) {
    let digits = u64::from(num.scale) | u64::from(num.point) << 4 | u64::from(num.mantissa < 0) << 5;
    put(bytes, num.mantissa.unsigned_abs() << 6 | digits);
}

impl PackedLines {
    /// Packs statements; `None` where one of them cannot be ([`packs`]).
    pub fn new(stmts: &[Stmt]) -> Option<PackedLines> {
        let mut bytes = Vec::new();
        let (mut end, mut number, mut form) = (0u32, 0u32, (0, 0));
        for stmt in stmts {
            if !packs(stmt) {
                return None;
            }
            let (kind, words, said) = match &stmt.op {
                Op::StraightFeed(to) => (FEED, Some(&to.to), to.said),
                Op::StraightTraverse(to) => (TRAVERSE, Some(&to.to), to.said),
                _ => (RATE, None, false),
            };
            let axes = words.map_or(&[][..], |to| &to.axes[..Axis::A as usize]);
            if let Some(own) = axes.iter().flatten().next().map(form_of).filter(|own| *own != form) {
                bytes.extend([FORM, own.0, own.1]);
                form = own;
            }
            let named = (0u8..).zip(axes).filter(|(_, word)| word.is_some());
            let bit = |has: bool, bit: u8| if has { bit } else { 0 };
            bytes.push(
                kind | bit(said, SAID)
                    | bit(stmt.joined, JOINED)
                    | bit(stmt.number.is_some(), NUMBERED)
                    | named.fold(0, |bits, (axis, _)| bits | AXIS << axis),
            );
            put_signed(&mut bytes, i64::from(stmt.span.start) - i64::from(end));
            put(&mut bytes, u64::from(stmt.span.end.saturating_sub(stmt.span.start)));
            end = stmt.span.end;
            if let Some(own) = stmt.number {
                put_signed(&mut bytes, i64::from(own) - i64::from(number));
                number = own;
            }
            for num in axes.iter().flatten().filter_map(|word| word.value.literal()) {
                put_number(&mut bytes, num);
            }
            if let Op::SetFeedRate(feed) = &stmt.op {
                let num = feed.literal()?;
                bytes.push(place(&UNITS, &num.unit));
                put_number(&mut bytes, num);
            }
        }
        let last = stmts.last().map_or(Span::default(), |stmt| stmt.span);
        let in_force = InForce { unit: Unit::Entry, distance: Fact::Entry };
        Some(PackedLines { bytes: bytes.into(), last, in_force })
    }

    /// Puts into another move what was put into these.
    pub fn settle_as_these(&self, stmt: &mut Stmt) {
        let settle = |value: &mut Expr| {
            if let Expr::Num(num) = value {
                num.unit = self.in_force.unit(num.unit);
            }
        };
        match &mut stmt.op {
            Op::StraightFeed(to) | Op::StraightTraverse(to) => {
                for word in to.to.axes.iter_mut().flatten() {
                    settle(&mut word.value);
                    word.distance = self.in_force.distance(word.distance);
                }
            }
            Op::SetFeedRate(feed) => settle(feed),
            _ => {}
        }
    }

    /// Its statements, one after the other.
    pub fn unpack(&self) -> Unpack<'_> {
        Unpack { rest: &self.bytes, end: 0, number: 0, form: (0, 0), in_force: self.in_force }
    }
}

/// Statements that are unpacked one after the other.
#[derive(Clone, Debug)]
pub struct Unpack<'p> {
    rest: &'p [u8],
    end: u32,
    number: u32,
    form: (u8, u8),
    in_force: InForce,
}

impl Unpack<'_> {
    /// Whether all are unpacked.
    pub fn is_done(&self) -> bool {
        self.rest.is_empty()
    }

    fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(*first)
    }

    #[inline]
    fn value(&mut self) -> Option<u64> {
        let (mut value, mut shift) = (0, 0);
        loop {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7F) << shift;
            if byte < 0x80 {
                return Some(value);
            }
            shift += 7;
        }
    }

    fn signed(&mut self) -> Option<i64> {
        let value = self.value()?;
        Some((value >> 1) as i64 ^ -((value & 1) as i64))
    }

    #[inline]
    fn num(&mut self, unit: Unit) -> Option<Num> {
        let value = self.value()?;
        let mantissa = (value >> 6) as i64;
        let mantissa = if value >> 5 & 1 == 1 { -mantissa } else { mantissa };
        Some(Num { mantissa, scale: (value & 15) as u8, point: value >> 4 & 1 == 1, unit })
    }
}

impl Iterator for Unpack<'_> {
    type Item = Stmt;

    fn next(&mut self) -> Option<Stmt> {
        let mut first = self.byte()?;
        if first == FORM {
            self.form = (self.byte()?, self.byte()?);
            first = self.byte()?;
        }
        let start = (i64::from(self.end) + self.signed()?) as u32;
        let span = Span::new(start, start + self.value()? as u32);
        self.end = span.end;
        let number = match first & NUMBERED {
            0 => None,
            _ => Some((i64::from(self.number) + self.signed()?) as u32),
        };
        self.number = number.unwrap_or(self.number);
        let op = if first & 3 == RATE {
            let unit = self.in_force.unit(UNITS[usize::from(self.byte()?)]);
            Op::SetFeedRate(self.num(unit)?.into())
        } else {
            let unit = self.in_force.unit(UNITS[usize::from(self.form.0)]);
            let distance = self.in_force.distance(DISTANCES[usize::from(self.form.1)]);
            let mut axes: [Option<Coord>; AXES] = Default::default();
            for (axis, word) in axes[..Axis::A as usize].iter_mut().enumerate() {
                if first & AXIS << axis != 0 {
                    *word = Some(Coord { value: Expr::Num(self.num(unit)?), distance });
                }
            }
            let to = Move { to: Point { axes }, said: first & SAID != 0 };
            if first & 3 == FEED { Op::StraightFeed(to) } else { Op::StraightTraverse(to) }
        };
        Some(Stmt { span, number, skip: None, joined: first & JOINED != 0, comment: None, op })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::canon::Units;

    fn num() -> impl Strategy<Value = Num> {
        (-(MOST as i64) + 1..MOST as i64, 0u8..16, any::<bool>()).prop_map(|(mantissa, scale, point)| Num {
            mantissa,
            scale,
            point,
            unit: Unit::One,
        })
    }

    prop_compose! {
        fn stmt()(
            words in prop::array::uniform3(prop::option::of(num())),
            (kind, unit, distance) in (0u8..3, 0usize..6, 0usize..3),
            (said, joined, number) in (any::<bool>(), any::<bool>(), prop::option::of(0u32..100_000)),
            (start, length) in (0u32..1_000_000, 0u32..300),
        ) -> Stmt {
            let mut axes: [Option<Coord>; AXES] = Default::default();
            for (axis, word) in axes.iter_mut().zip(words) {
                let value = |num: Num| Expr::Num(Num { unit: UNITS[unit], ..num });
                *axis = word.map(|num| Coord { value: value(num), distance: DISTANCES[distance] });
            }
            let rate = words[0].map_or(Num::int(1, Unit::Mm), |num| Num { unit: UNITS[unit], ..num });
            let to = Move { to: Point { axes }, said };
            let op = match kind {
                FEED => Op::StraightFeed(to),
                TRAVERSE => Op::StraightTraverse(to),
                _ => Op::SetFeedRate(rate.into()),
            };
            Stmt { span: Span::new(start, start + length), number, skip: None, joined, comment: None, op }
        }
    }

    proptest! {
        #[test]
        fn what_is_unpacked_is_what_was_packed(stmts in prop::collection::vec(stmt(), 0..40)) {
            let stmts: Vec<Stmt> = stmts.into_iter().filter(packs).collect();
            let packed = PackedLines::new(&stmts).expect("each of them can be packed");
            prop_assert_eq!(&packed.unpack().collect::<Vec<_>>(), &stmts);
            // What is in force comes to them as it does to their statements.
            let mut settled = packed.clone();
            settled.settle(Some(Units::Inch), Some(Distance::Absolute));
            let mut own = stmts;
            own.iter_mut().for_each(|stmt| settled.settle_as_these(stmt));
            prop_assert!(settled.are_moves_of(&packed));
            prop_assert_eq!(settled.unpack().collect::<Vec<_>>(), own);
        }
    }

    #[test]
    fn what_is_more_than_a_plain_move_is_not_packed() {
        let packed = |op: Op| packs(&Stmt::new(Span::default(), op));
        let word = || Some(Coord { value: Expr::Num(Num::int(1, Unit::Mm)), distance: Fact::Entry });
        let to = |axis: Axis| {
            let mut to = Move::default();
            to.to.axes[axis as usize] = word();
            to
        };
        assert!(packed(Op::StraightFeed(to(Axis::Z))));
        assert!(!packed(Op::StraightFeed(to(Axis::A))) && !packed(Op::StraightFeed(Move::default())));
        assert!(!packed(Op::Blank));
        let skipped = Stmt { skip: Some(1), ..Stmt::new(Span::default(), Op::StraightFeed(to(Axis::X))) };
        assert!(!packs(&skipped));
    }
}
