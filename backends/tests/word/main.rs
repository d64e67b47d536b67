//! Statements built by hand, and the exact text that they become.

mod arcs;
#[path = "../build/mod.rs"]
mod build;
mod cycles;
mod numbers;
mod structure;

use ncc_dialects::{Settings, builtin};
use ncc_ir::canon::{Axis, Distance, Fact, FeedMode, Modes, Plane, Units};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Unit;
use ncc_ir::program::{Coord, Move, Op, Point, Procedure, Stmt};
use ncc_ir::source::Span;

use build::*;
use ncc_backends::word::Writer;
use ncc_backends::{Layout, Numbering};

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
/// dictionary that nobody confirms, or on an option that nobody chose.
pub(crate) fn clean(dialect: &str, stmts: &[Stmt]) -> String {
    let (text, mut diags) = text(dialect, stmts);
    diags.retain(|d| !matches!(d.fault, Fault::AssumedRow { .. } | Fault::AssumedOption { .. }));
    assert_eq!(diags, [], "{text}");
    text
}

/// The same point with all words in another distance mode.
pub(crate) fn measured(mut point: Point, distance: Fact<Distance>) -> Point {
    point.axes.iter_mut().flatten().for_each(|c| c.distance = distance);
    point
}

/// The faults, without their places.
pub(crate) fn faults(diags: &[Diagnostic]) -> Vec<&Fault> {
    diags.iter().map(|d| &d.fault).collect()
}

/// Asserts that statements are refused because there is no word for them, at the end of the text at the latest.
pub(crate) fn refused(dialect: &str, stmts: &[Stmt]) {
    let mut w = writer(dialect, layout());
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    w.write(stmts, &metric(), &mut out, &mut diags);
    w.finish(&mut out, &mut diags);
    let text = String::from_utf8_lossy(&out);
    assert!(
        diags.iter().any(|d| matches!(d.fault, Fault::TargetLacks { .. } | Fault::Computes { .. })),
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
