//! Tests of the Sinumerik's reader: text in, statements and diagnostics out.
//!
//! Statements are compared in a short rendering of their own (`show`); diagnostics with the very
//! text that they point at.

mod arcs;
mod calls;
mod corpus;
mod cycles;
mod facts;
mod faults;
mod frames;
mod laws;
mod patterns;
mod show;
mod words;

use ncc_dialects::{Settings, builtin};

use super::super::Reader;
use crate::Batch;

/// The dialect with the working choices.
fn settings() -> Settings {
    Settings::new(builtin("siemens").expect("a built-in dialect"))
}

fn read_with(settings: Settings, assume: bool, text: &[u8]) -> Batch {
    let mut reader = Reader::new(settings, assume);
    let mut out = Batch::default();
    reader.read(text, 0, &mut out);
    reader.finish(&mut out);
    out
}

/// Reads a user's source.
fn read(text: &str) -> Batch {
    read_with(settings(), true, text.as_bytes())
}

/// The statements of main, a line each; a block's further statements are marked.
fn stmts(out: &Batch) -> Vec<String> {
    out.stmts.iter().map(show::stmt).collect()
}

/// The diagnostics, each with the text that it points at.
fn diagnostics(out: &Batch, text: &[u8]) -> Vec<String> {
    let place = |d: &ncc_ir::diag::Diagnostic| {
        let bytes = &text[d.span.start as usize..d.span.end as usize];
        format!("{:?} at {:?}", d.fault, String::from_utf8_lossy(bytes))
            .replace("\\\"", "'")
            .replace('"', "'")
    };
    out.diagnostics.iter().map(place).collect()
}

/// Says every mode, a tool, a feed, and where the tool is.
const HEAD: &str = "G710 G17 G90 G94 G54\nT1 M6 D1\nF100\nG0 X0 Y0 Z5\n";

/// Faults of a piece after the head, without assumptions, the missing end and subprograms that are
/// not there.
fn faults(piece: &str) -> Vec<String> {
    let text = HEAD.to_owned() + piece;
    let all = diagnostics(&read(&text), text.as_bytes());
    let beside = ["NoProgramEnd", "Assumed", "CallUnknown"];
    all.into_iter().filter(|d| !beside.iter().any(|b| d.starts_with(b))).collect()
}

/// What a piece of a program means after the head, which is well.
fn after_head(piece: &str) -> Vec<String> {
    let errors = faults(piece);
    assert!(errors.is_empty(), "{errors:?}");
    let skip = read(HEAD).stmts.len();
    stmts(&read(&(HEAD.to_owned() + piece))).split_off(skip)
}

/// The assumptions of a whole program.
fn assumptions(text: &str) -> Vec<String> {
    let all = diagnostics(&read(text), text.as_bytes());
    all.into_iter().filter(|d| d.starts_with("Assumed")).collect()
}
