//! Statements built by hand, and the exact text that they become.

mod arcs;
mod cycles;
mod numbers;
mod structure;

use ncc_dialects::{Settings, builtin};
use ncc_ir::canon::{Axis, Distance, Fact, FeedMode, Modes, Plane, Units};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::num::{Num, Unit};
use ncc_ir::program::{Coord, Move, Op, Point, Procedure, Stmt};
use ncc_ir::source::Span;

use ncc_backends::word::Writer;
use ncc_backends::{Layout, Numbering};

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

/// The same point with all words in another distance mode.
pub(crate) fn measured(mut point: Point, distance: Fact<Distance>) -> Point {
    point.axes.iter_mut().flatten().for_each(|c| c.distance = distance);
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

pub(crate) fn layout() -> Layout {
    Layout::default()
}

pub(crate) fn every(first: u32, step: u32) -> Layout {
    Layout { numbering: Numbering::Every { first, step }, crlf: false }
}

/// A writer that has no frame to write, for short tests.
pub(crate) fn writer(dialect: &str, layout: Layout) -> Writer {
    Writer::new(Settings::new(builtin(dialect).expect("built in")), layout)
}

/// What every program of these tests takes for granted.
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

/// The text of statements, without the safe start of [`metric`].
pub(crate) fn text_with(mut w: Writer, stmts: &[Stmt]) -> (String, Vec<Diagnostic>) {
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    w.write(stmts, &metric(), &mut out, &mut diags);
    let text = String::from_utf8(out).expect("text");
    let text = text.strip_prefix("G21 G17 G90 G40 G49 G80 G94\nG54\n").unwrap_or(&text);
    (text.to_owned(), diags)
}

pub(crate) fn text(dialect: &str, stmts: &[Stmt]) -> (String, Vec<Diagnostic>) {
    text_with(writer(dialect, layout()), stmts)
}

/// The text of statements that must come through without a word, but for what rests on a row of the
/// dictionary that nobody confirms.
pub(crate) fn clean(dialect: &str, stmts: &[Stmt]) -> String {
    let (text, mut diags) = text(dialect, stmts);
    diags.retain(|d| !matches!(d.fault, Fault::AssumedRow { .. }));
    assert_eq!(diags, [], "{text}");
    text
}

/// The faults, without their places.
pub(crate) fn faults(diags: &[Diagnostic]) -> Vec<&Fault> {
    diags.iter().map(|d| &d.fault).collect()
}

/// Asserts that statements are refused because there is no word for them.
pub(crate) fn refused(dialect: &str, stmts: &[Stmt]) {
    let (text, diags) = text(dialect, stmts);
    assert!(
        diags.iter().any(|d| matches!(d.fault, Fault::CannotSay { .. })),
        "{dialect} said:\n{text}{diags:?}"
    );
}

/// A whole program: head, main, subprograms, end.
pub(crate) fn program(
    mut w: Writer,
    assumed: &Modes,
    main: &[Stmt],
    procedures: &[Procedure],
) -> (String, Vec<Diagnostic>) {
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    w.write(main, assumed, &mut out, &mut diags);
    for p in procedures {
        w.procedure(p, &mut out, &mut diags);
    }
    w.finish(&mut out, &mut diags);
    (String::from_utf8(out).expect("text"), diags)
}
