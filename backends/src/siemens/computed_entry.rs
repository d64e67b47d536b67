//! Entries of the control's tables by a computed number: `$P_UIFR[R1,X,TR]`.
//!
//! Which numbers there can be is shown where the program is read, and again where the output is read back. A work offset
//! that is set so may be the active one, which is activated again.

use ncc_dialects::DataKind;
use ncc_ir::canon::Axis;
use ncc_ir::computed::computed_entry::{ComputedEntry, Place};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::system::System;
use ncc_ir::lack::TablesLack;
use ncc_ir::program::{Data, Op, Stmt};
use ncc_ir::source::Span;

use super::{Sink, Writer};
use crate::common::entry::number_of;
use crate::common::fault::cannot;

impl Writer {
    /// Such a statement as the control says it.
    pub(super) fn entry_of_number(
        &mut self,
        entry: &ComputedEntry,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        for place in &entry.reads {
            let name = self.read_by_number(place, entry.number, stmt.span, sink)?;
            self.words.variables.insert(place.name.clone(), name);
        }
        let done = self.entry_setting(entry, stmt.span, sink);
        entry.reads.iter().for_each(|place| drop(self.words.variables.remove(&place.name)));
        done
    }

    fn entry_setting(&mut self, entry: &ComputedEntry, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let none = || cannot(TablesLack::PlaceByNumber);
        if let Op::Assign(to, value) = &entry.op {
            return self.assign(to, value, span, sink);
        }
        let Op::SetData(data) = &entry.op else { return Err(none()) };
        let Data::Offset { words, .. } = &**data else { return Err(none()) };
        let row = self.table(|row| row.kind == DataKind::Offset).ok_or_else(none)?;
        let mut texts = Vec::with_capacity(entry.sets.len());
        for place in &entry.sets {
            let System::WorkOffset { axis, .. } = &place.first else { return Err(none()) };
            let value = words[*axis as usize].as_ref().ok_or_else(none)?;
            let name = self.by_number(&row.name, Some(*axis), place, entry.number, span, sink)?;
            texts.push(self.set(&name, *axis, value, span, sink)?);
        }
        self.tell_fine_shifts(span, sink);
        self.alone(&texts.join(" "), sink)?;
        self.call_up_again(span, sink)
    }

    /// The variable of the control that is read.
    fn read_by_number(
        &mut self,
        place: &Place,
        number: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        let none = || cannot(TablesLack::PlaceByNumber);
        let says = |name: &str| name.contains('#');
        let mut rows = self.dialect.system.iter().filter(|row| says(&row.name));
        let row = rows.find(|row| row.says().any(|(own, _)| own == place.first)).ok_or_else(none)?;
        let axis = if let System::WorkOffset { axis, .. } = &place.first { Some(*axis) } else { None };
        self.by_number(&row.name, axis, place, number, span, sink)
    }

    fn by_number(
        &mut self,
        row: &str,
        axis: Option<Axis>,
        place: &Place,
        number: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        let index = self.words.expression(&number_of(place, number), span, sink)?;
        let letter = axis.map_or(String::new(), |axis| char::from(axis.letter()).to_string());
        Ok(row.replace('@', &letter).replace('#', &index))
    }
}
