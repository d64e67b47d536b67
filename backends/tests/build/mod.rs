//! Statements built by hand, for the tests of every writer.

use ncc_ir::canon::{Axis, Distance, Fact, FeedMode, Modes, Plane, Units};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::{Coord, Move, Op, Point, Stmt};
use ncc_ir::source::Span;

/// A literal as written: `12.5`, `-3.`, `0`.
pub(crate) fn num(text: &str, unit: Unit) -> Num {
    let (whole, rest) = text.split_once('.').unwrap_or((text, ""));
    let mantissa = format!("{whole}{rest}").parse().expect("digits");
    Num { mantissa, scale: rest.len() as u8, point: text.contains('.'), unit }
}

pub(crate) fn mm(text: &str) -> Expr {
    Expr::Num(num(text, Unit::Mm))
}

pub(crate) fn count(text: &str) -> Expr {
    Expr::Num(num(text, Unit::One))
}

pub(crate) fn seconds(text: &str) -> Expr {
    Expr::Num(num(text, Unit::Second))
}

pub(crate) fn coord(text: &str) -> Coord {
    Coord { value: mm(text), distance: Fact::Known(Distance::Absolute) }
}

/// Axis words, absolute, in millimetres and degrees: `X1. Y-2.5 A90.`.
pub(crate) fn point(words: &str) -> Point {
    let mut point = Point::default();
    for word in words.split_whitespace() {
        let axis = Axis::from_letter(word.as_bytes()[0]).expect("an axis");
        let unit = if axis.is_rotary() { Unit::Degree } else { Unit::Mm };
        let value = Expr::Num(num(&word[1..], unit));
        point.set(axis, Coord { value, distance: Fact::Known(Distance::Absolute) });
    }
    point
}

/// The same point in another unit of length.
pub(crate) fn in_unit(mut point: Point, unit: Unit) -> Point {
    for coord in point.axes.iter_mut().flatten() {
        if let Expr::Num(n) = &mut coord.value {
            n.unit = unit;
        }
    }
    point
}

pub(crate) fn rapid(words: &str) -> Op {
    Op::StraightTraverse(Move { to: point(words), said: true })
}

pub(crate) fn feed(words: &str) -> Op {
    Op::StraightFeed(Move { to: point(words), said: true })
}

/// A move that does not say its code.
pub(crate) fn on(words: &str) -> Op {
    Op::StraightFeed(Move { to: point(words), said: false })
}

pub(crate) fn rapid_on(words: &str) -> Op {
    Op::StraightTraverse(Move { to: point(words), said: false })
}

pub(crate) fn hole(words: &str) -> Op {
    Op::Hole(Move { to: point(words), said: false })
}

/// Blocks of statements.
pub(crate) fn blocks(blocks: Vec<Vec<Op>>) -> Vec<Stmt> {
    let mut stmts = Vec::new();
    for (at, block) in blocks.into_iter().enumerate() {
        for (place, op) in block.into_iter().enumerate() {
            let span = Span::new(at as u32 * 10, at as u32 * 10 + 9);
            stmts.push(Stmt { joined: place > 0, ..Stmt::new(span, op) });
        }
    }
    stmts
}

/// One statement a block.
pub(crate) fn lines(ops: Vec<Op>) -> Vec<Stmt> {
    blocks(ops.into_iter().map(|op| vec![op]).collect())
}

/// What every program of these tests assumes.
pub(crate) fn metric() -> Modes {
    Modes {
        units: Some(Units::Mm),
        distance: Some(Distance::Absolute),
        plane: Some(Plane::Xy),
        feed_mode: Some(FeedMode::PerMinute),
        work_offset: Some(1),
        ..Modes::default()
    }
}

/// The same with an empty remark at the end of each block, which sends it the general way.
pub(crate) fn the_general_way(stmts: &[Stmt]) -> Vec<Stmt> {
    let mut all = Vec::with_capacity(2 * stmts.len());
    for (at, stmt) in stmts.iter().enumerate() {
        all.push(stmt.clone());
        if stmts.get(at + 1).is_none_or(|next| !next.joined) {
            all.push(Stmt { joined: true, ..Stmt::new(stmt.span, Op::Comment("".into())) });
        }
    }
    all
}

/// Its text without these remarks, each of them by such signs, and without the lines that are nothing else.
pub(crate) fn without_empty_remarks(text: &str, signs: &str) -> String {
    let bare = |line: &str| {
        let (line, end) = line.strip_suffix('\r').map_or((line, ""), |line| (line, "\r"));
        let line = line.strip_suffix(signs).unwrap_or(line).trim_end();
        (!line.is_empty()).then(|| format!("{line}{end}\n"))
    };
    text.split_terminator('\n').filter_map(bare).collect()
}
