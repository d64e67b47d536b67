//! Tools that a source calls by name, for a target that calls them by number: those that no profile numbers get the next
//! free numbers, in the order in which the program names them.
//!
//! The text is looked through once before, and only where it may name tools.

use std::collections::BTreeSet;
use std::io::{self, Read, Seek};

use memchr::memmem;
use ncc_dialects::Role;
use ncc_frontends::Batch;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::{Op, Stmt, Text};
use ncc_ir::source::Span;

use crate::job::Job;
use crate::source::chunks::{Chunk, Chunks};

/// What the text says of tools.
#[derive(Debug, Default)]
struct Tools {
    named: Vec<(Text, Span)>,
    numbers: BTreeSet<u32>,
}

impl Tools {
    fn see(&mut self, stmts: &[Stmt]) {
        for stmt in stmts {
            match &stmt.op {
                Op::SelectToolByName(name) if !self.named.iter().any(|(known, _)| known == name) => {
                    self.named.push((name.clone(), stmt.span));
                }
                Op::SelectTool(tool) => {
                    let number = tool.literal().and_then(|number| number.whole());
                    self.numbers.extend(number.and_then(|number| u32::try_from(number).ok()));
                }
                Op::Control(control) => control.bodies().for_each(|body| self.see(body)),
                _ => {}
            }
        }
    }
}

/// Gives numbers to the tools of a source that need them, and says so among the job's assumptions.
///
/// # Errors
/// The source cannot be read.
pub fn number<F: Read + Seek>(job: &mut Job, source: &mut F) -> io::Result<()> {
    let by_name = job.from.dialect.address.iter().any(|row| row.role == Role::Tool && row.named);
    let to = &job.to.dialect;
    if !by_name || job.to.caps().tools.names || to.can.flat || to.can.everything {
        return Ok(());
    }
    source.rewind()?;
    let mut whole = Vec::new();
    let mut reader = job.reader(false);
    let (mut batch, mut tools, mut names) = (Batch::default(), Tools::default(), false);
    {
        let mut chunks = Chunks::new(source);
        loop {
            match chunks.take()? {
                Chunk::Lines(_, range) => {
                    let text = chunks.text(range);
                    names |= memmem::find(text, b"=\"").is_some();
                    whole.extend_from_slice(text);
                }
                Chunk::TooLong(..) => {}
                Chunk::End => break,
            }
            // A long text without a name at its beginning has none.
            if !names && whole.len() > WITHOUT {
                break;
            }
        }
    }
    source.rewind()?;
    if !names {
        return Ok(());
    }
    reader.read(&whole, 0, &mut batch);
    reader.finish(&mut batch);
    tools.see(&batch.stmts);
    batch.procedures.iter().for_each(|procedure| tools.see(&procedure.body));
    let maps = job.machines.maps(to);
    let taken =
        maps.tool_names.values().copied().chain(maps.tools.iter().flat_map(|map| map.values().copied()));
    let mut taken: BTreeSet<u32> = taken.chain(tools.numbers).collect();
    let mut next = 1;
    for (name, span) in tools.named {
        if maps.tool_names.contains_key(&name) {
            continue;
        }
        while taken.contains(&next) {
            next += 1;
        }
        taken.insert(next);
        job.assumed.push(Diagnostic::new(Fault::ToolNumbered { name: (*name).into(), number: next }, span));
        job.numbered_tools.push((name, next));
    }
    Ok(())
}

/// Bytes of a text after which it is taken to name no tools if it has named none.
const WITHOUT: usize = 1 << 20;
