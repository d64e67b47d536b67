//! How straight moves are packed, and unpacked.
//!
//! Not here: what is known of them without unpacking (`packed`).

use std::convert::Infallible;

use super::packed::{InForce, PackedLines};
use super::shapes::{MOST_NUMBERS, WordRole, WordShape, each_number, has_shape, packs_num};
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

/// Kinds of statements, and of the note that the words after it have another unit or distance; with [`SAID`], that they
/// have other shapes.
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

/// Words that may be computed: three axes, and the feed.
const WORDS: usize = 4;
/// Place of the feed among them.
const FEED_WORD: usize = Axis::A as usize;

/// Most shapes of a stretch; 0 is that of a literal.
const MOST_SHAPES: usize = 255;

fn packs_number(value: &Expr) -> bool {
    value.literal().is_some_and(packs_num)
}

/// Whether a statement may be packed: a straight move in X, Y and Z by words that are no increments (moves after a
/// stretch could not say again where it leaves the tool), literals or computed ones that have a shape, or a feed by
/// such a word, without a comment, that no switch leaves out.
pub fn packs(stmt: &Stmt) -> bool {
    stmt.skip.is_none()
        && stmt.comment.is_none()
        && match &stmt.op {
            Op::StraightFeed(to) | Op::StraightTraverse(to) => {
                let (linear, rotary) = to.to.axes.split_at(Axis::A as usize);
                let mut words = linear.iter().flatten();
                let first = words.next().map(|word| word.distance);
                let unit = unit_of(linear);
                let packs = |word: &Coord| match &word.value {
                    Expr::Num(num) => packs_num(*num) && Some(num.unit) == unit,
                    value => has_shape(value),
                };
                first.is_some_and(|first| {
                    first != Fact::Known(Distance::Incremental) && words.all(|word| word.distance == first)
                }) && linear.iter().flatten().all(packs)
                    && rotary.iter().all(Option::is_none)
            }
            Op::SetFeedRate(feed) => packs_number(feed) || has_shape(feed),
            _ => false,
        }
}

/// The unit of the first word that is a literal.
fn unit_of(axes: &[Option<Coord>]) -> Option<Unit> {
    axes.iter().flatten().find_map(|word| word.value.literal()).map(|num| num.unit)
}

/// The unit of literals and the distance of words; where there is no literal, the unit stays.
fn form_of(axes: &[Option<Coord>], before: (u8, u8)) -> (u8, u8) {
    let distance = axes.iter().flatten().next().map_or(before.1, |word| place(&DISTANCES, &word.distance));
    (unit_of(axes).map_or(before.0, |unit| place(&UNITS, &unit)), distance)
}

/// The place of a word's shape among those that are known, from 1 on; `None` where there are too many.
fn shape_of(role: WordRole, word: &Expr, shapes: &mut Vec<WordShape>) -> Option<u8> {
    if let Some(at) = shapes.iter().position(|shape| shape.fits(role, word)) {
        return Some(at as u8 + 1);
    }
    shapes.push(WordShape::of(role, word)?);
    (shapes.len() <= MOST_SHAPES).then_some(shapes.len() as u8)
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

/// Statements that are being packed, one after the other.
#[derive(Debug, Default)]
pub struct Packing {
    bytes: Vec<u8>,
    shapes: Vec<WordShape>,
    end: u32,
    number: u32,
    form: (u8, u8),
    shaped: [u8; WORDS],
    last: Span,
    statements: u32,
    blocks: u32,
}

impl Packing {
    /// How many bytes those so far take.
    pub fn len(&self) -> usize {
        self.bytes.len()
    }

    /// Whether none is packed yet.
    pub fn is_empty(&self) -> bool {
        self.statements == 0
    }

    /// Adds a statement; `false`, and then nothing was done, where it cannot be packed ([`packs`]).
    pub fn push(&mut self, stmt: &Stmt) -> bool {
        let before = self.bytes.len();
        let pushed = packs(stmt) && self.try_push(stmt).is_some();
        if !pushed {
            self.bytes.truncate(before);
        }
        pushed
    }

    fn try_push(&mut self, stmt: &Stmt) -> Option<()> {
        let (kind, words, said) = match &stmt.op {
            Op::StraightFeed(to) => (FEED, Some(&to.to), to.said),
            Op::StraightTraverse(to) => (TRAVERSE, Some(&to.to), to.said),
            _ => (RATE, None, false),
        };
        let axes = words.map_or(&[][..], |to| &to.axes[..Axis::A as usize]);
        let mut shaped = self.shaped;
        for (shaped, word) in shaped.iter_mut().zip(axes) {
            let Some(word) = word else { continue };
            *shaped = match &word.value {
                Expr::Num(_) => 0,
                value => shape_of(WordRole::Axis, value, &mut self.shapes)?,
            };
        }
        if let Op::SetFeedRate(feed) = &stmt.op {
            shaped[FEED_WORD] = match feed {
                Expr::Num(_) => 0,
                value => shape_of(WordRole::Feed, value, &mut self.shapes)?,
            };
        }
        let form = form_of(axes, self.form);
        let bytes = &mut self.bytes;
        if form != self.form {
            bytes.extend([FORM, form.0, form.1]);
            self.form = form;
        }
        if shaped != self.shaped {
            bytes.push(FORM | SAID);
            bytes.extend(shaped);
            self.shaped = shaped;
        }
        let named = (0u8..).zip(axes).filter(|(_, word)| word.is_some());
        let bit = |has: bool, bit: u8| if has { bit } else { 0 };
        bytes.push(
            kind | bit(said, SAID)
                | bit(stmt.joined, JOINED)
                | bit(stmt.number.is_some(), NUMBERED)
                | named.fold(0, |bits, (axis, _)| bits | AXIS << axis),
        );
        put_signed(bytes, i64::from(stmt.span.start) - i64::from(self.end));
        put(bytes, u64::from(stmt.span.end.saturating_sub(stmt.span.start)));
        self.end = stmt.span.end;
        if let Some(own) = stmt.number {
            put_signed(bytes, i64::from(own) - i64::from(self.number));
            self.number = own;
        }
        for word in axes.iter().flatten() {
            match &word.value {
                Expr::Num(num) => put_number(bytes, *num),
                value => each_number(value, &mut |num| put_number(bytes, num)),
            }
        }
        match &stmt.op {
            Op::SetFeedRate(Expr::Num(num)) => {
                bytes.push(place(&UNITS, &num.unit));
                put_number(bytes, *num);
            }
            Op::SetFeedRate(feed) => each_number(feed, &mut |num| put_number(bytes, num)),
            _ => {}
        }
        self.last = stmt.span;
        self.statements += 1;
        self.blocks += u32::from(!stmt.joined);
        Some(())
    }

    /// The packed moves, for which so many statements in front stand.
    pub fn finish(self, probes: u32) -> PackedLines {
        let in_force = InForce { unit: Unit::Entry, distance: Fact::Entry };
        let Packing { bytes, shapes, last, statements, blocks, .. } = self;
        let (bytes, shapes) = (bytes.into(), shapes.into());
        PackedLines { bytes, shapes, last, in_force, probes, statements, blocks }
    }
}

impl PackedLines {
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
        Unpack {
            rest: &self.bytes,
            shapes: &self.shapes,
            end: 0,
            number: 0,
            form: (0, 0),
            shaped: [0; WORDS],
            in_force: self.in_force,
        }
    }
}

/// Statements that are unpacked one after the other.
#[derive(Clone, Debug)]
pub struct Unpack<'p> {
    rest: &'p [u8],
    shapes: &'p [WordShape],
    end: u32,
    number: u32,
    form: (u8, u8),
    shaped: [u8; WORDS],
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

    /// The numbers of a computed word, as many as its shape has.
    fn numbers(&mut self, shape: usize) -> Option<([Num; MOST_NUMBERS], usize)> {
        let mut numbers = [Num::int(0, Unit::One); MOST_NUMBERS];
        let many = self.shapes.get(shape).map_or(0, WordShape::numbers);
        for number in &mut numbers[..many] {
            *number = self.num(Unit::One)?;
        }
        Some((numbers, many))
    }

    /// The next statement. What the words are that are computed, `word` says of their shape's place and their numbers;
    /// `None` leaves them out, and of a feed alone [`Op::Blank`] is left.
    ///
    /// # Errors
    /// The first of `word`, with the statement's place.
    #[inline]
    pub fn next_by<E>(
        &mut self,
        word: &mut impl FnMut(usize, &[Num]) -> Result<Option<Expr>, E>,
    ) -> Result<Option<Stmt>, (Span, E)> {
        let Some((first, span, number)) = self.head() else { return Ok(None) };
        let op = if first & 3 == RATE {
            match self.shaped[FEED_WORD] {
                0 => {
                    let feed = self.byte().and_then(|unit| self.num(UNITS[usize::from(unit)]));
                    let Some(mut feed) = feed else { return Ok(None) };
                    feed.unit = self.in_force.unit(feed.unit);
                    Op::SetFeedRate(feed.into())
                }
                shape => {
                    let shape = usize::from(shape) - 1;
                    let Some((numbers, many)) = self.numbers(shape) else { return Ok(None) };
                    let feed = word(shape, &numbers[..many]).map_err(|why| (span, why))?;
                    feed.map_or(Op::Blank, Op::SetFeedRate)
                }
            }
        } else {
            let unit = self.in_force.unit(UNITS[usize::from(self.form.0)]);
            let distance = self.in_force.distance(DISTANCES[usize::from(self.form.1)]);
            let mut axes: [Option<Coord>; AXES] = Default::default();
            for (axis, to) in axes[..Axis::A as usize].iter_mut().enumerate() {
                if first & AXIS << axis == 0 {
                    continue;
                }
                let value = match self.shaped[axis] {
                    0 => {
                        let Some(num) = self.num(unit) else { return Ok(None) };
                        Some(Expr::Num(num))
                    }
                    shape => {
                        let shape = usize::from(shape) - 1;
                        let Some((numbers, many)) = self.numbers(shape) else { return Ok(None) };
                        word(shape, &numbers[..many]).map_err(|why| (span, why))?
                    }
                };
                *to = value.map(|value| Coord { value, distance });
            }
            let to = Move { to: Point { axes }, said: first & SAID != 0 };
            if first & 3 == FEED { Op::StraightFeed(to) } else { Op::StraightTraverse(to) }
        };
        Ok(Some(Stmt { span, number, skip: None, joined: first & JOINED != 0, comment: None, op }))
    }

    /// The first byte of a statement, and where it stands.
    #[inline]
    fn head(&mut self) -> Option<(u8, Span, Option<u32>)> {
        let mut first = self.byte()?;
        while first & 3 == FORM {
            if first & SAID == 0 {
                self.form = (self.byte()?, self.byte()?);
            } else {
                self.shaped = [self.byte()?, self.byte()?, self.byte()?, self.byte()?];
            }
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
        Some((first, span, number))
    }
}

impl Iterator for Unpack<'_> {
    type Item = Stmt;

    fn next(&mut self) -> Option<Stmt> {
        let shapes = self.shapes;
        let mut word = |shape: usize, numbers: &[Num]| {
            Ok::<_, Infallible>(shapes.get(shape).map(|shape| shape.with(numbers)))
        };
        match self.next_by(&mut word) {
            Ok(stmt) => stmt,
            Err((_, never)) => match never {},
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::shapes::MOST;
    use super::*;
    use crate::canon::Units;
    use crate::expr::{Binary, Function, Node, Unary, Var};

    /// A word with a number, of one of a few shapes.
    fn shaped(shape: u8, num: Num) -> Expr {
        let node = |node: Node| Expr::Node(Box::new(node));
        let var = |name: &str| node(Node::Var(Var::Local(name.into())));
        match shape {
            0 => Expr::binary(Binary::Add, Expr::Num(num), var("1")),
            1 => node(Node::Unary(Unary::Negate, Expr::binary(Binary::Multiply, var("2"), Expr::Num(num)))),
            2 => node(Node::Call(Function::RoundTo, vec![shaped(0, num), Expr::int(3)])),
            _ => node(Node::Call(Function::RoundTo, vec![shaped(1, num), Expr::int(4)])),
        }
    }

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
            shapes in prop::array::uniform3(prop::option::of(0u8..4)),
            (kind, unit, distance) in (0u8..3, 0usize..6, 0usize..3),
            (said, joined, number) in (any::<bool>(), any::<bool>(), prop::option::of(0u32..100_000)),
            (start, length) in (0u32..1_000_000, 0u32..300),
        ) -> Stmt {
            let mut axes: [Option<Coord>; AXES] = Default::default();
            for ((axis, word), shape) in axes.iter_mut().zip(words).zip(shapes) {
                let value = |num: Num| match shape {
                    Some(shape) => shaped(shape, num),
                    None => Expr::Num(Num { unit: UNITS[unit], ..num }),
                };
                *axis = word.map(|num| Coord { value: value(num), distance: DISTANCES[distance] });
            }
            let literal = words[0].map_or(Num::int(1, Unit::Mm), |num| Num { unit: UNITS[unit], ..num });
            let rate = match (words[1], shapes[1]) {
                (Some(num), Some(shape)) => shaped(shape, num),
                _ => literal.into(),
            };
            let to = Move { to: Point { axes }, said };
            let op = match kind {
                FEED => Op::StraightFeed(to),
                TRAVERSE => Op::StraightTraverse(to),
                _ => Op::SetFeedRate(rate),
            };
            Stmt { span: Span::new(start, start + length), number, skip: None, joined, comment: None, op }
        }
    }

    proptest! {
        #[test]
        fn what_is_unpacked_is_what_was_packed(stmts in prop::collection::vec(stmt(), 0..40)) {
            let stmts: Vec<Stmt> = stmts.into_iter().filter(packs).collect();
            let mut packing = Packing::default();
            prop_assert!(stmts.iter().all(|stmt| packing.push(stmt)));
            let packed = packing.finish(0);
            let blocks = stmts.iter().filter(|stmt| !stmt.joined).count();
            prop_assert_eq!(packed.counts(), (stmts.len(), blocks));
            prop_assert_eq!(&packed.unpack().collect::<Vec<_>>(), &stmts);
            // What is active comes to them as it does to their statements.
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
        let computed = |value: Expr| {
            let mut to = Move::default();
            to.to.axes[0] = Some(Coord { value, distance: Fact::Entry });
            Op::StraightFeed(to)
        };
        let num = Num::int(1, Unit::One);
        assert!(packed(computed(shaped(2, num))) && packed(Op::SetFeedRate(shaped(2, num))));
        assert!(!packed(computed(shaped(2, Num { unit: Unit::Mm, ..num }))));
        assert!(!packed(computed(Expr::Node(Box::new(Node::Call(Function::Sin, vec![shaped(0, num)]))))));
    }
}
