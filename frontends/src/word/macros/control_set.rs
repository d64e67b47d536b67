//! Variables of the control's own: their values, and those that a program sets: zeros of work
//! offsets and lengths of tools, which is the data input of them, and those by which it gives an alarm, or stops with a message. The
//! comment of the block is the text (16-C, custom macro, system variables, alarms: `#3000 = n (MESSAGE)`; B-63684EN,
//! stop with a message: `#3006 = 1 (MESSAGE)`).
//!
//! Which numbers they have is in the dictionary, `[[system]]`.

use ncc_dialects::{Quantity, SystemRow};
use ncc_ir::canon::{AXES, Axis};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Expr, Function, Node, Var};
use ncc_ir::program::{Alarm, Data, DataMode, Op, Text, ToolValue};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{TableUnsupported, TextUnsupported, Unsupported, ValueUnsupported};

use crate::batch::Batch;
use crate::common::Source;
use crate::common::text::decode;
use crate::word::lower::Lower;
use crate::word::text::block::Block;
use crate::word::word_state::CycleState;

impl Lower {
    /// What setting a variable of the control's own does; nothing is refused.
    pub(in crate::word) fn control_set(
        &mut self,
        to: &System,
        value: Expr,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) -> Vec<Op> {
        let name = to.to_string();
        let found = self.row_of(&name);
        if let Some((row, place)) = found.filter(|(row, _)| row.refuse.is_none())
            && let Some(Expr::Node(node)) = row.value(place, "")
            && let Node::Var(Var::System(system)) = *node
        {
            match system {
                System::WorkOffset { number, axis, .. } => {
                    return self.offset_set(number, axis, value, block.span, out);
                }
                System::ToolTable { value: which, entry } => {
                    self.rely_on_row(row, block.span, out);
                    return self.tool_set(which, entry, value, block.span, out);
                }
                _ => {}
            }
        }
        let row = found.map(|(row, _)| row);
        match row.map(|row| &*row.means) {
            Some("alarm") => {
                let text = self.text_of(block, src, out).unwrap_or_default();
                vec![Op::Alarm(Box::new(Alarm { number: Some(value), text }))]
            }
            // Whether single block stops between blocks is the operator's, as long as functions are waited for.
            Some("single-block")
                if value.literal().is_some_and(|n| n.scale == 0 && matches!(n.mantissa, 0 | 1)) =>
            {
                let said = if value.literal().is_some_and(|n| n.mantissa == 1) { 1 } else { 0 };
                if self.assume {
                    out.report(Fault::AssumedNoEffect { code: name.as_str().into() }, block.span);
                }
                vec![Op::NoEffect(format!("{name}={said}").into())]
            }
            Some("stop") => {
                let text = self.text_of(block, src, out);
                text.map(Op::Message).into_iter().chain([Op::ProgramStop]).collect()
            }
            _ => {
                let told = row.and_then(|row| row.refuse.as_deref());
                let what = told.map_or(ValueUnsupported::ControlOwnSet.into(), Unsupported::named);
                let fault = Fault::NotSupported { code: name.into(), what };
                self.fault(fault, block.span, out);
                Vec::new()
            }
        }
    }

    /// The row of a variable of the control's own, and which of the row's it is.
    pub(in crate::word) fn row_of(&self, name: &str) -> Option<(&'static SystemRow, u32)> {
        let number: u32 = name.strip_prefix('#')?.parse().ok()?;
        let row = self.settings.dialect.system.iter();
        let row = row.filter(|row| row.counts(&self.settings)).find(|row| row.numbers().contains(&number))?;
        Some((row, number - row.number))
    }

    /// Value of a variable of the control's own, by its name; what is not known is refused.
    pub(in crate::word) fn control_value(&mut self, name: &str, at: Span, out: &mut Batch) -> Option<Expr> {
        let found = self.row_of(name);
        if let Some((row, place)) = found
            && row.refuse.is_none()
            && let Some(value) = self.value_of(row, place, at, out)
        {
            self.rely_on_row(row, at, out);
            let asked = match &value {
                Expr::Node(node) => match &**node {
                    Node::Var(Var::System(asked)) => Some(asked.clone()),
                    _ => None,
                },
                Expr::Num(_) => None,
            };
            let stated = asked.and_then(|asked| self.stated_at_start(&asked, at, out));
            return Some(stated.map_or(value, |stated| Expr::int(i64::from(stated))));
        }
        let told = found.and_then(|(row, _)| row.refuse.as_deref());
        let what = told.map_or(ValueUnsupported::ControlOwn.into(), Unsupported::named);
        self.refuse(Fault::NotSupported { code: name.into(), what }, at, out)
    }

    /// What is assumed where a variable of the control's own is used.
    fn rely_on_row(&mut self, row: &'static SystemRow, at: Span, out: &mut Batch) {
        if !row.option.is_empty() {
            self.option(&row.option, at, out);
        }
        let told = &mut self.reported.values;
        if self.assume && !row.assumes.is_empty() && !told.contains(&&*row.assumes) {
            told.push(&row.assumes);
            let assumption = ControlFact::SystemVariable { fact: row.assumes.as_str().into() };
            out.report(Fault::AssumedFact { fact: assumption }, at);
        }
    }

    /// A value of the table of tools, as the code of data input sets it.
    fn tool_set(&mut self, which: ToolValue, entry: u16, value: Expr, at: Span, out: &mut Batch) -> Vec<Op> {
        self.check_no_cycle(at, out);
        let Some(value) = self.stored_length(value, at, out) else { return Vec::new() };
        let data = Data::Tool { entry: u32::from(entry), which, added: false, kept: false, value };
        vec![Op::SetData(Box::new(data))]
    }

    /// No data goes in while a cycle is active.
    fn check_no_cycle(&mut self, at: Span, out: &mut Batch) {
        if let CycleState::Active(_) = self.state.cycle {
            let what = TableUnsupported::InCycle.into();
            self.fault(Fault::NotSupported { code: "#".into(), what }, at, out);
        }
    }

    /// A length as tables have it, to the least increment.
    fn stored_length(&mut self, value: Expr, at: Span, out: &mut Batch) -> Option<Expr> {
        let digits = self.digits_of(Quantity::Length, at, out)?;
        Some(match value {
            Expr::Num(num) => self.written(Expr::Num(num.rounded(digits)), Quantity::Length, at, out),
            value => {
                let rounded = Node::Call(Function::RoundTo, vec![value, Expr::int(i64::from(digits))]);
                Expr::Node(Box::new(rounded))
            }
        })
    }

    /// The zero of a work offset along an axis, as the code of data input sets it.
    fn offset_set(&mut self, offset: u16, axis: Axis, value: Expr, at: Span, out: &mut Batch) -> Vec<Op> {
        self.check_no_cycle(at, out);
        let Some(value) = self.stored_length(value, at, out) else { return Vec::new() };
        let mut words = [const { None }; AXES];
        words[axis as usize] = Some(value);
        let data = Data::Offset { offset, mode: DataMode::Set, words: Box::new(words), turn: None };
        vec![Op::SetData(Box::new(data))]
    }

    /// The text of an alarm or a stop: the comment of its block.
    fn text_of(&mut self, block: &Block, src: Source, out: &mut Batch) -> Option<Text> {
        match &block.comments[..] {
            [] => None,
            [one] => {
                self.now.message = true;
                Some(decode(src.bytes(*one)))
            }
            [_, more, ..] => {
                let code = src.text(*more);
                let what = TextUnsupported::SecondComment.into();
                self.refuse(Fault::NotSupported { code, what }, *more, out)
            }
        }
    }
}
