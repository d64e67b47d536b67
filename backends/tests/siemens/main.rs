//! Statements built by hand, and the exact Sinumerik text that they become.

#[path = "../build/mod.rs"]
mod build;
mod cycles;
mod motion;
mod patterns;
mod structure;

use ncc_dialects::{Settings, builtin};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::Lack;
use ncc_ir::program::{Procedure, ProgramName, Stmt};
use ncc_ir::run_time::RunTime;

use build::*;
use ncc_backends::siemens::Writer;
use ncc_backends::{Head, Layout, Numbering};

pub(crate) const START: &str = "G710 G17 G90 G40 G94\nG54\n";

pub(crate) fn writer(layout: Layout) -> Writer {
    Writer::new(Settings::new(builtin("siemens").expect("built in")), layout)
}

/// The text of statements, without the safe start.
pub(crate) fn text(stmts: &[Stmt]) -> (String, Vec<Diagnostic>) {
    let mut w = writer(Layout::default());
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    w.write(stmts, &metric(), &mut out, &mut diags);
    let text = String::from_utf8(out).expect("text");
    (text.strip_prefix(START).unwrap_or(&text).to_owned(), diags)
}

/// The text of statements that must come through without a word, but for what rests on an option that
/// nobody chose.
pub(crate) fn clean(stmts: &[Stmt]) -> String {
    let (text, mut diags) = text(stmts);
    diags.retain(|d| !matches!(d.fault, Fault::AssumedOption { .. }));
    assert_eq!(diags, [], "{text}");
    text
}

/// What was found, besides blocks that were split.
pub(crate) fn told(stmts: &[Stmt]) -> (String, Vec<Fault>) {
    let (text, diags) = text(stmts);
    let faults = diags.into_iter().map(|d| d.fault).filter(|f| *f != Fault::BlockSplit).collect();
    (text, faults)
}

/// Asserts that statements are refused because there is no word for them.
pub(crate) fn refused(stmts: &[Stmt]) -> Lack {
    let (text, diags) = text(stmts);
    let lack = diags.iter().find_map(|d| match &d.fault {
        Fault::TargetLacks { lack } => Some(lack.clone()),
        _ => None,
    });
    lack.unwrap_or_else(|| panic!("said:\n{text}{diags:?}"))
}

/// What of a program that computes is refused.
pub(crate) fn not_computed(stmts: &[Stmt]) -> RunTime {
    let (text, diags) = text(stmts);
    let what = diags.iter().find_map(|d| match &d.fault {
        Fault::Computes { what } => Some(what.clone()),
        _ => None,
    });
    what.unwrap_or_else(|| panic!("said:\n{text}{diags:?}"))
}

/// A whole program: head, main, subprograms, end.
pub(crate) fn program(main: &[Stmt], procedures: &[Procedure], layout: Layout) -> String {
    let mut w = writer(layout);
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    w.write(main, &metric(), &mut out, &mut diags);
    for p in procedures {
        w.procedure(p, &mut out, &mut diags);
    }
    w.finish(&mut out, &mut diags);
    let mut text = Vec::new();
    let name = ProgramName { number: Some(1001), title: None };
    w.head(&Head { name, lines: vec!["ncc".into()] }, &mut text, &mut diags);
    text.append(&mut out);
    String::from_utf8(text).expect("text")
}

pub(crate) fn keep() -> Layout {
    Layout { numbering: Numbering::Keep, crlf: false }
}
