//! Jumps, labels and block numbers of a text, by its form alone: for somebody who looks where a program
//! that is not translated can go. Not here: what any block means.

use super::parse::parse;
use super::tree::{Address, BlockNumber, Direction, Expr, Jump, Place, Statement, Target};
use super::unit::{self, Line};
use crate::common::Source;
use crate::outline::Flow;

/// Tells every unit, block and jump of a text.
pub(crate) fn jumps(text: &[u8], found: &mut dyn FnMut(Flow)) {
    let src = Source { text, base: 0 };
    let mut base = 0;
    for line in text.split_inclusive(|b| *b == b'\n') {
        let start = base;
        base += line.len() as u32;
        let line = line.trim_ascii_end();
        match unit::line(line, start) {
            Ok(Line::Header(_)) => found(Flow::Program),
            Ok(Line::Block) if !line.is_empty() => block(line, start, src, found),
            Ok(Line::Path(_) | Line::Mark | Line::Block) | Err(_) => {}
        }
    }
}

fn block(line: &[u8], base: u32, src: Source, found: &mut dyn FnMut(Flow)) {
    // What is no block may be anything, a frame of other blocks too.
    let Ok(block) = parse(line, base) else {
        let at = ncc_ir::source::Span::new(base, base + line.len() as u32);
        return found(Flow::Block { label: None, at, says: true, frames: true });
    };
    let says = match &block.statement {
        Statement::Words { items, jumps } => !items.is_empty() || !jumps.is_empty(),
        _ => true,
    };
    let frames = !matches!(block.statement, Statement::Words { .. });
    if let Some(number) = &block.number {
        found(Flow::Block { label: Some(numbered(number)), at: block.span, says: false, frames: false });
    }
    let label = block.label.map(|label| src.text(label).to_ascii_uppercase());
    found(Flow::Block { label, at: block.span, says, frames });
    if let Statement::Words { jumps, .. } = &block.statement {
        for jump in jumps {
            let always = jump.condition.is_none() && block.skip.is_none();
            let quiet = matches!(jump.direction, Direction::BothQuietly | Direction::ToStart);
            found(Flow::Jump { to: target(jump, src), at: jump.span, always, quiet });
        }
    }
}

fn numbered(number: &BlockNumber) -> String {
    format!("N{}", number.value)
}

fn target(jump: &Jump, src: Source) -> Option<String> {
    match jump.target.as_ref()? {
        Target::Number(number) => Some(numbered(number)),
        Target::Named(Expr::Place(Place { address: Address::Name(name), index, .. })) if index.is_empty() => {
            Some(src.text(*name).to_ascii_uppercase())
        }
        // A text that is put together, or a variable of the control.
        Target::Named(_) => None,
    }
}
