//! Tools and their edges.
//!
//! A tool change makes edge 1 active by itself. Where the program has another length active, that
//! is stated before the drilling axis moves; where it says an edge in time, nothing is to be added.

use ncc_dialects::Role;
use ncc_ir::canon::Axis;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::lack::{LengthsLack, ToolsLack};
use ncc_ir::program::{Point, Stmt};
use ncc_ir::source::Span;

use super::{Sink, Writer};
use crate::common::block::{Need, Part, Rank};
use crate::common::fault::cannot;

impl Writer {
    pub(super) fn change_tool(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        self.words.statement(stmt, sink)?;
        self.tool_waits_for_edge();
        Ok(())
    }

    /// A tool by its name, in quotation marks.
    pub(super) fn tool_by_name(&mut self, name: &str, sink: &mut Sink) -> Result<(), Fault> {
        let row = self.dialect.address.iter().find(|row| row.role == Role::Tool && row.named);
        let plain = !name.is_empty() && !name.chars().any(|c| c == '"' || c.is_control());
        let row = row.filter(|_| plain).ok_or_else(|| cannot(ToolsLack::Name { name: name.into() }))?;
        self.words.admit(&Need::new(Rank::Tool).letter(row.letter as u8), sink)?;
        self.words.block.text(Part::Tail, &format!("{}=\"{name}\"", row.letter));
        Ok(())
    }

    /// A tool change makes an edge active.
    fn tool_waits_for_edge(&mut self) {
        let level = self.words.block.skip;
        let alone = !self.standing.edge_waits || self.standing.edge_level == level;
        self.standing.edge_level = level.filter(|_| alone);
        self.standing.edge_waits = self.edge_with_tool;
        self.standing.edge_of_call = false;
    }

    /// The same in a subprogram that was called.
    pub(super) fn edge_waits_after(&mut self, called: &str) {
        if self.edge_with_tool && self.leave_edge.contains(called) {
            self.standing.edge_waits = true;
            self.standing.edge_of_call = true;
            self.standing.edge_level = None;
        }
    }

    /// An edge of the tool in the spindle.
    pub(super) fn edge(&mut self, edge: &Expr, said: bool, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let first = edge.literal().and_then(|n| n.whole_number()) == Some(1);
        let comes_with_tool = first && !said && self.standing.edge_waits;
        self.standing.edge_waits = false;
        if comes_with_tool {
            self.words.rely("edge_after_change", span, sink);
            return Ok(());
        }
        self.edge_word(edge, span, sink)
    }

    fn edge_word(&mut self, edge: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let row = self.dialect.address.iter().find(|row| row.role == Role::ToolEdge);
        let row = row.ok_or_else(|| cannot(ToolsLack::Edge))?;
        let letter = self.letter(&row.letter.to_string(), row.quantity);
        let edge = self.words.number(&letter, edge, span, sink)?;
        if !(0..=9).contains(&edge.mantissa) {
            return Err(Fault::TargetRange { word: format!("{}{}", row.letter, edge.mantissa).into() });
        }
        self.words.admit(&Need::new(Rank::Offset).letter(letter.letter), sink)?;
        self.words.block.word(Part::Tail, letter.letter, edge);
        Ok(())
    }

    /// An entry of a length table: none, or the one of the tool in the spindle.
    pub(super) fn length_offset(&mut self, entry: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let entry = entry.literal().and_then(|n| n.whole_number());
        // The program says a length after the change; one that is refused is not missed once more.
        self.standing.edge_waits = false;
        match (entry, self.words.tracker.tool) {
            (Some(0), _) => self.edge_word(&Expr::int(0), span, sink),
            (Some(entry), Some(tool)) if entry == tool => {
                self.tell_edge(tool, span, sink);
                self.edge_word(&Expr::int(1), span, sink)
            }
            _ => Err(cannot(LengthsLack::NotOwnEntry)),
        }
    }

    fn tell_edge(&mut self, tool: i64, span: Span, sink: &mut Sink) {
        if let Ok(tool) = u32::try_from(tool) {
            sink.report(Fault::AssumedEdge { tool }, span);
        }
    }

    /// Says the length that the program has active, if a tool change has made another active and
    /// the drilling axis is about to move.
    pub(super) fn settle_edge(&mut self, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if !std::mem::replace(&mut self.standing.edge_waits, false) {
            return Ok(());
        }
        let at_start = self.words.assumed.length_offset.filter(|_| !self.standing.edge_of_call);
        let in_force = self.words.tracker.modes.length_offset.or(at_start);
        match (in_force, self.words.tracker.tool) {
            (Some(0), _) => self.edge_word(&Expr::int(0), span, sink),
            (Some(entry), Some(tool)) if i64::from(entry) == tool => {
                self.tell_edge(tool, span, sink);
                Ok(())
            }
            _ => Err(cannot(ToolsLack::ChangeKeepsLength)),
        }
    }

    /// The same before a move to a point.
    pub(super) fn settle_edge_for(&mut self, to: &Point, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        match to.get(Axis::Z) {
            Some(_) => self.settle_edge(span, sink),
            None => Ok(()),
        }
    }
}
