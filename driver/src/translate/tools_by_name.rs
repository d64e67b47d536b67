//! Tools that a source calls by name, for a target that calls them by number: those that no profile numbers get the next
//! free numbers, in the order in which the program names them. Edges of tools other than the first, for a target with a
//! table of lengths: each gets an entry of its own.
//!
//! ```text
//! T="MILL_10" M6      T1 M06
//! D3                  G43 H31
//! ```
//!
//! The text is looked through once before, and only where it may name tools.

use std::collections::BTreeSet;
use std::io::{self, Read, Seek};

use memchr::memmem;
use ncc_dialects::Role;
use ncc_frontends::Batch;
use ncc_ir::caps::LengthsOf;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::{Op, Stmt, Text};
use ncc_ir::source::Span;

use crate::job::{FurtherEdge, Job};
use crate::source::Readable;
use crate::source::chunks::{Chunk, Chunks};

/// A tool as the source calls it.
#[derive(Clone, Debug, PartialEq)]
enum Called {
    Name(Text),
    Number(u32),
}

/// What the text says of tools.
#[derive(Debug, Default)]
struct Tools {
    named: Vec<(Text, Span)>,
    numbers: BTreeSet<u32>,
    /// Edges other than the first.
    edges: Vec<(Called, u32, Span)>,
    /// Whether a tool has a computed number.
    computed: bool,
    selected: Option<Called>,
    in_spindle: Option<Called>,
}

impl Tools {
    fn see(&mut self, stmts: &[Stmt]) {
        for stmt in stmts {
            match &stmt.op {
                Op::SelectToolByName(name) => {
                    if !self.named.iter().any(|(known, _)| known == name) {
                        self.named.push((name.clone(), stmt.span));
                    }
                    self.selected = Some(Called::Name(name.clone()));
                }
                Op::SelectTool(tool) => {
                    let number = tool.literal().and_then(|number| number.whole_number());
                    let number = number.and_then(|number| u32::try_from(number).ok());
                    self.numbers.extend(number);
                    self.computed |= number.is_none();
                    self.selected = number.map(Called::Number);
                }
                Op::ChangeTool => self.in_spindle = self.selected.clone(),
                Op::UseToolEdge { edge, .. } => {
                    let edge = edge.literal().and_then(|edge| edge.whole_number());
                    let edge =
                        edge.and_then(|edge| u32::try_from(edge).ok()).filter(|edge| (2..=9).contains(edge));
                    if let (Some(edge), Some(tool)) = (edge, &self.in_spindle)
                        && !self.edges.iter().any(|(own, n, _)| own == tool && *n == edge)
                    {
                        self.edges.push((tool.clone(), edge, stmt.span));
                    }
                }
                Op::Control(control) => control.bodies().for_each(|body| self.see(body)),
                _ => {}
            }
        }
    }
}

/// Gives numbers to the tools of a source that need them, and entries of the length table to their edges, and says so
/// among the job's assumptions.
///
/// # Errors
/// The source cannot be read.
pub fn number<F: Read + Seek>(job: &mut Job, source: &mut F) -> io::Result<()> {
    let (from, to) = (job.from.dialect, job.to.dialect);
    let tools = job.to.caps().tools;
    let by_name = from.address.iter().any(|row| row.role == Role::Tool && row.named) && !tools.names;
    let by_edge = from.letter_for(Role::ToolEdge).is_some() && tools.lengths_of == LengthsOf::Entries;
    if !by_name && !by_edge || to.can.flat || to.can.everything {
        return Ok(());
    }
    let names = |text: &[u8]| by_name && memmem::find(text, b"=\"").is_some() || by_edge && names_edge(text);
    source.rewind()?;
    let met = begins_with(source, names)?;
    source.rewind()?;
    if !met {
        return Ok(());
    }
    let tools = tools_of(job, source)?;
    source.rewind()?;
    let maps = job.machines.maps(to);
    let of_maps = maps.tool_names.values().chain(maps.tools.iter().flat_map(|map| map.values()));
    let mut taken: BTreeSet<u32> = of_maps.copied().chain(tools.numbers.iter().copied()).collect();
    if by_name {
        number_tools(job, &tools, &mut taken);
    }
    if by_edge {
        taken.extend(maps.edge_entries.values());
        number_edges(job, &tools, taken);
    }
    Ok(())
}

/// Whether such a line is among the first of a text.
fn begins_with(source: &mut dyn Readable, such: impl Fn(&[u8]) -> bool) -> io::Result<bool> {
    let (mut chunks, mut passed) = (Chunks::new(source), 0);
    while passed <= WITHOUT {
        match chunks.take()? {
            Chunk::Lines(_, range) if such(chunks.text(range.clone())) => return Ok(true),
            Chunk::Lines(_, range) => passed += range.len(),
            Chunk::TooLong(..) => {}
            Chunk::End => break,
        }
    }
    Ok(false)
}

/// What a text says of tools. A text that streams is looked at piece by piece, so that memory does not grow with it.
fn tools_of(job: &Job, source: &mut dyn Readable) -> io::Result<Tools> {
    let (mut reader, mut batch, mut tools) = (job.reader(false), Batch::default(), Tools::default());
    let mut chunks = Chunks::new(source);
    loop {
        match chunks.take()? {
            Chunk::Lines(base, range) => reader.read(chunks.text(range), base, &mut batch),
            Chunk::TooLong(..) => {}
            Chunk::End => break,
        }
        if !batch.whole {
            tools.see(&batch.stmts);
            batch.stmts.clear();
            batch.diagnostics.clear();
        }
    }
    reader.finish(&mut batch);
    tools.see(&batch.stmts);
    batch.procedures.iter().for_each(|procedure| tools.see(&procedure.body));
    Ok(tools)
}

/// Gives tools the next free numbers.
fn number_tools(job: &mut Job, tools: &Tools, taken: &mut BTreeSet<u32>) {
    let known = job.maps().tool_names;
    let mut next = 1;
    for (name, span) in &tools.named {
        if known.contains_key(name) {
            continue;
        }
        while taken.contains(&next) {
            next += 1;
        }
        taken.insert(next);
        job.assumed.push(Diagnostic::new(Fault::ToolNumbered { name: (**name).into(), number: next }, *span));
        job.numbered_tools.push((name.clone(), next));
    }
}

/// Gives edges other than the first the entries that the profile of the target's machine has for them, or free ones.
fn number_edges(job: &mut Job, tools: &Tools, mut taken: BTreeSet<u32>) {
    let maps = job.maps();
    let tools_of_program = taken.clone();
    let stated: Vec<(u32, u32, u32)> = job.machines.to.iter().flat_map(|machine| machine.edges()).collect();
    taken.extend(stated.iter().map(|(.., entry)| *entry));
    for (tool, edge, span) in &tools.edges {
        let number = match tool {
            Called::Name(name) => maps.tool_names.get(name).copied(),
            Called::Number(number) => maps.tool(*number),
        };
        let Some(number) = number else { continue };
        let known = stated.iter().find(|(own, n, _)| *own == number && n == edge).map(|(.., entry)| *entry);
        // Of a tool with a computed number, nobody knows which entries are its.
        if known.is_none() && tools.computed || known.is_some_and(|known| tools_of_program.contains(&known)) {
            continue;
        }
        let entry = known.unwrap_or_else(|| {
            let mut free = number + 10 * edge;
            while taken.contains(&free) {
                free += 1;
            }
            job.assumed
                .push(Diagnostic::new(Fault::EdgeNumbered { tool: number, edge: *edge, entry: free }, *span));
            free
        });
        taken.insert(entry);
        let name = match tool {
            Called::Name(name) => Some(name.clone()),
            Called::Number(_) => None,
        };
        let own = match tool {
            Called::Number(own) => *own,
            Called::Name(_) => number,
        };
        job.further_edges.push(FurtherEdge { name, own, number, edge: *edge, entry });
    }
}

/// Whether a text may activate another edge than the first.
fn names_edge(text: &[u8]) -> bool {
    let edge = |behind: &[u8]| matches!(behind, [b'2'..=b'9', ..] | [b'=', b'2'..=b'9', ..]);
    memchr::memchr2_iter(b'D', b'd', text).any(|at| edge(&text[at + 1..]))
}

/// Bytes of a text after which it is taken to name no tools if it has named none.
const WITHOUT: usize = 1 << 20;
