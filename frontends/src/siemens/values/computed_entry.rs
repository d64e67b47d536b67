//! Entries of the control's tables whose number is computed: `$P_UIFR[R1,X,TR]` is X of the settable frame whose number
//! `R1` has (PGA, frames: the index of a settable frame is an expression). They are branches for that number, and an
//! alarm where no place has it.
//!
//! That the number is one of the table's on every path is looked at when the whole text has been read
//! ([`crate::common::saved`]); any other is refused: number 0 is another frame, and above the machine's there is
//! none.

use ncc_ir::canon::Axis;
use ncc_ir::computed::computed_code::{computed_code, of_number};
use ncc_ir::expr::{Expr, Function, Node};
use ncc_ir::program::{Data, Op, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unsupported::TableUnsupported;

use super::control::{axis_of, table_entry};
use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::lower::Lower;
use crate::siemens::text::tree::{Address, Expr as Tree, Place, Value};

/// What such a place is called in messages.
const PLACE: &str = "$P_UIFR[…]";

impl Lower {
    /// A variable, or one of the control's own, is set, where that or the value is a place of a table by a computed number;
    /// `false` if nothing in it is.
    pub(in crate::siemens) fn by_number(
        &mut self,
        place: &Place,
        value: &Value,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) -> bool {
        // Anything else that is set so is refused where the value is read.
        let sets = self.is_variable(place, src) || matches!(place.address, Address::System(_));
        if self.worth.is_some() || !sets {
            return false;
        }
        let mut found: Vec<(&Tree, u32)> = Vec::new();
        let mut each = |place| found.extend(self.computed_index(place, src));
        each(place);
        if let Value::Expr(value) = value {
            places(value, &mut each);
        }
        let Some((first, count)) = found.first().copied() else { return false };
        out.whole = true;
        let Some(number) = self.whole_index(first, src, out) else { return true };
        for (other, _) in &found[1..] {
            match self.whole_index(other, src, out) {
                Some(other) if other == number => {}
                Some(_) => {
                    let what = TableUnsupported::TwoComputed;
                    self.not_supported(PLACE, what, span, out);
                    return true;
                }
                None => return true,
            }
        }
        // Values of one work offset that stand in one block are put in at once, as where its number is written.
        let axis = match place.address {
            Address::System(_) => place.index.iter().find_map(|index| axis_of(index.as_ref())),
            Address::Letter(_) | Address::Name(_) => None,
        };
        let before = axis.and_then(|axis| self.same_number(&number, axis, out));
        let at = self.target(out).len();
        // What else stands before it in its block is a statement of its own.
        let mark = std::mem::replace(&mut self.now.mark, at);
        let (mut cases, mut first): (Vec<(i64, Op)>, Option<Stmt>) = (Vec::new(), None);
        for worth in 1..=count {
            self.worth = Some(worth);
            if let Some((stmt, ops)) = &before {
                let op = ops.get(worth as usize - 1).cloned().unwrap_or(Op::Blank);
                self.target(out).push(Stmt { op, ..stmt.clone() });
            }
            match self.is_variable(place, src) {
                true => self.assign(place, value, span, src, out),
                false => self.set_control(place, value, span, src, out),
            }
            let Some(stmt) = self.target(out).split_off(at).pop() else { break };
            cases.push((i64::from(worth), stmt.op.clone()));
            first.get_or_insert(stmt);
        }
        self.worth = None;
        if cases.len() < count as usize && !self.now.failed && !self.now.refused {
            self.not_supported(PLACE, TableUnsupported::NoValue, span, out);
        }
        self.now.mark = mark;
        if let Some(first) = first {
            self.saved.entry(span, PLACE);
            self.target(out).push(Stmt { op: of_number(&number, cases, span), ..first });
        }
        true
    }

    /// The statement before in its block, with what it does by each number, where it sets another axis of the work offset
    /// that has the same number.
    fn same_number(&mut self, number: &Expr, axis: Axis, out: &mut Batch) -> Option<(Stmt, Vec<Op>)> {
        let mark = self.now.mark;
        let last = self.target(out).get(mark..)?.last()?;
        let Op::Control(control) = &last.op else { return None };
        let code = computed_code(control)?;
        let other = |op: &Op| match op {
            Op::SetData(data) => {
                matches!(&**data, Data::Offset { words, .. } if words[axis as usize].is_none())
            }
            _ => false,
        };
        if code.number != number || !code.codes.iter().all(|(_, op)| other(op)) {
            return None;
        }
        let ops = code.codes.into_iter().map(|(_, op)| op.clone()).collect();
        Some((self.target(out).pop()?, ops))
    }

    /// The index of a place of a table, where it must be computed; and how many places there are.
    fn computed_index<'t>(&self, place: &'t Place, src: Source) -> Option<(&'t Tree, u32)> {
        let Address::System(name) = place.address else { return None };
        let name = src.text(name).to_ascii_uppercase();
        let dialect = self.settings.dialect;
        let rows = dialect.system.iter().map(|row| (&row.name, row.count));
        let data =
            dialect.data.iter().filter(|row| row.is_variable()).map(|row| (&row.name, u32::from(row.count)));
        let (row, count) = rows.chain(data).find(|(row, count)| {
            row.contains('#')
                && table_entry(row, *count, &name, place, None, src).is_none()
                && table_entry(row, *count, &name, place, Some(1), src).is_some()
        })?;
        let indices = row.split_once('[')?.1;
        let at = indices.split([',', ']']).position(|index| index == "#")?;
        let index = place.index.get(at)?.as_ref()?;
        Some((index, count))
    }

    /// The number, which is whole wherever it is one of a known range.
    fn whole_index(&mut self, index: &Tree, src: Source, out: &mut Batch) -> Option<Expr> {
        let number = self.formula(index, src, out)?.expr;
        Some(match &number {
            Expr::Node(node) => match &**node {
                Node::Call(Function::Round, of) => of.first().cloned().unwrap_or(number),
                _ => number,
            },
            Expr::Num(_) => number,
        })
    }
}

/// Shows the places in a value that are no index of another.
fn places<'t>(value: &'t Tree, seen: &mut dyn FnMut(&'t Place)) {
    match value {
        Tree::Number(..) | Tree::Bits(..) | Tree::Character(_) | Tree::Text(_) => {}
        Tree::Place(place) => seen(place),
        Tree::Call { arguments, .. } => arguments.iter().flatten().for_each(|value| places(value, seen)),
        Tree::Unary(_, value, _) | Tree::Group(value, _) => places(value, seen),
        Tree::Binary(_, both) => {
            places(&both.0, seen);
            places(&both.1, seen);
        }
    }
}
