//! Tests of the reader: text in, statements and diagnostics out.
//!
//! Statements are compared in a short rendering of their own, so that a test reads like a page of
//! a manual; diagnostics with the very text that they point at.

mod calls;
mod cycles;
mod facts;
mod faults;
mod frame;
mod functions;
mod laws;
mod motion;
mod repeated_blocks;
mod show;

use ncc_dialects::{Settings, builtin};

use super::Reader;
use crate::Batch;

/// A dialect with the working choices.
pub(crate) fn settings(id: &str) -> Settings {
    Settings::new(builtin(id).expect("a built-in dialect"))
}

/// Reads a user's source.
fn read(id: &str, text: &str) -> Batch {
    read_with(settings(id), true, text.as_bytes())
}

fn read_with(settings: Settings, assume: bool, text: &[u8]) -> Batch {
    let mut reader = Reader::new(settings, assume);
    let mut out = Batch::default();
    reader.read(text, 0, &mut out);
    reader.finish(&mut out);
    out
}

/// The statements of main, a line each; a block's further statements are indented.
fn stmts(out: &Batch) -> Vec<String> {
    out.stmts.iter().map(show::stmt).collect()
}

/// What a piece of a program means after a head that settles every mode.
fn after_head(id: &str, piece: &str) -> Vec<String> {
    let out = read(id, &(head(id).to_owned() + piece));
    let skip = read(id, head(id)).stmts.len();
    let errors: Vec<_> = diagnostics(&out, &(head(id).to_owned() + piece))
        .into_iter()
        .filter(|d| !d.starts_with("NoProgramEnd") && !d.starts_with("Assumed"))
        .collect();
    assert!(errors.is_empty(), "{errors:?}");
    stmts(&out).split_off(skip)
}

/// Says every mode, a tool, a feed, and where the tool is.
fn head(id: &str) -> &'static str {
    match id {
        "mach9" => "G99\nG90\nG71\nG17\nT1M6\nO1\nG1X0.Y0.Z5.F100\nG0X0.\n",
        _ => "G21 G17 G90 G94 G98 G54\nT1 M6\nG43 H1 Z5. G0 X0. Y0. F100.\n",
    }
}

/// The diagnostics, each with the text that it points at.
fn diagnostics(out: &Batch, text: &str) -> Vec<String> {
    let place = |d: &ncc_ir::diag::Diagnostic| {
        let bytes = &text.as_bytes()[d.span.start as usize..d.span.end as usize];
        format!("{:?} at {:?}", d.fault, String::from_utf8_lossy(bytes)).replace('"', "'")
    };
    out.diagnostics.iter().map(place).collect()
}

/// The diagnostics of a piece after the head, without assumptions and the missing end.
fn faults(id: &str, piece: &str) -> Vec<String> {
    let text = head(id).to_owned() + piece;
    let out = read(id, &text);
    diagnostics(&out, &text)
        .into_iter()
        .filter(|d| !d.starts_with("NoProgramEnd") && !d.starts_with("Assumed"))
        .collect()
}

/// The assumptions of a whole program.
fn assumptions(id: &str, text: &str) -> Vec<String> {
    let out = read(id, text);
    diagnostics(&out, text).into_iter().filter(|d| d.starts_with("Assumed")).collect()
}
