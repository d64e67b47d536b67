//! Entries of the control's tables by a computed number: `#[5201 + #1 * 20]`.
//!
//! Which numbers there can be is shown where the program is read, and again where the output is read back.

use ncc_dialects::DataKind;
use ncc_ir::computed::computed_entry::{ComputedEntry, Place};
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Element, Expr, Many, Node, Target, Var};
use ncc_ir::program::{Data, Op, Stmt};
use ncc_ir::run_time::RunTimeWord;

use crate::common::Sink;
use crate::common::codes::DataCode;
use crate::common::entry::number_of;
use crate::common::fault::cannot_compute;
use crate::word::Writer;

impl Writer {
    /// Such a statement as the control says it.
    pub(in crate::word) fn entry_of_number(
        &mut self,
        entry: &ComputedEntry,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        for place in &entry.reads {
            let spelt = self.place_by_number(place, entry.number)?;
            self.words.rely_on(
                &Expr::Node(Box::new(Node::Var(Var::System(place.first.clone())))),
                stmt.span,
                sink,
            );
            self.words.variables.insert(place.name.clone(), spelt);
        }
        let done = self.entry_setting(entry, stmt, sink);
        entry.reads.iter().for_each(|place| drop(self.words.variables.remove(&place.name)));
        done
    }

    fn entry_setting(&mut self, entry: &ComputedEntry, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        if let Op::Assign(to, value) = &entry.op {
            let text = self.assignment(to, value, stmt.span, sink)?;
            return self.statement_alone(&text, sink);
        }
        let Op::SetData(data) = &entry.op else {
            return Err(cannot_compute(RunTimeWord::TablePlace));
        };
        if let ([place], true) = (&entry.sets[..], self.dialect.program.macro_b) {
            let name = self.place_by_number(place, entry.number)?;
            if let Some(text) = self.data_setting_of(&name, &place.first, data, stmt.span, sink)? {
                return self.statement_alone(&text, sink);
            }
        }
        self.entry_words(data, entry, stmt, sink)
    }

    /// By the code of data input: `G10 L2 P#1 X5.`
    fn entry_words(
        &mut self,
        data: &Data,
        entry: &ComputedEntry,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let none = || cannot_compute(RunTimeWord::TablePlaceValues);
        let (Data::Offset { words, .. }, Some((place, ends))) = (data, &entry.entries) else {
            return Err(none());
        };
        let has = |table: &&DataCode| {
            let row = table.row;
            let of = |offset: &u16| offset.checked_sub(row.first).is_some_and(|n| n < row.count);
            row.kind == DataKind::Offset && ends.iter().all(of)
        };
        let table = self.words.codes.tables.iter().find(has).ok_or_else(none)?.clone();
        let own = self.words.along(&words[..])?;
        let base = place.base - i64::from(table.row.first) + 1;
        let number = number_of(&Place { base, ..place.clone() }, entry.number);
        let number = self.words.behind(&number, None, stmt.span, sink)?;
        self.stored(&table, &number, false, &own, stmt.span, sink)
    }

    /// The variable that a place is.
    fn place_by_number(&self, place: &Place, number: &Expr) -> Result<String, Fault> {
        // As they are stated one by one, or not at all.
        self.words.spelling(None)?.target(&Target::Var(Var::System(place.first.clone())))?;
        let at = vec![number_of(place, number)];
        let element = Element { of: Many::Numbered(Box::new([])), at };
        self.words.spelling(None)?.target(&Target::Element(Box::new(element)))
    }
}
