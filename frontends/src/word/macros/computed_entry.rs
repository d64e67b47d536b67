//! Entries of the control's tables whose number is computed: `#[5201+#1*20]` is X of the fixture whose number `#1` has
//! (16-C, custom macro: the number of a variable may be an expression; system variables, work offsets, 20 apart). They are
//! branches for the one variable in the number, and an alarm where no place has it.
//!
//! A variable of the program's own that is meant by such a number stays one. That the number is one of the table's on
//! every path is looked at when the whole text has been read ([`crate::common::saved::paths`]); any other is refused, since the
//! control would take another of its variables.

use ncc_dialects::SystemRow;
use ncc_ir::computed::computed_code::of_number;
use ncc_ir::computed::computed_entry::is_entry;
use ncc_ir::diag::Fault;
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Element, Expr, Node, Target, Unary, Var};
use ncc_ir::program::Op;
use ncc_ir::source::Span;
use ncc_ir::unsupported::TableUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::saved::ANY_PLACE;
use crate::word::lower::Lower;
use crate::word::o_code::parameters::parameter;
use crate::word::o_code::statements::Setting;
use crate::word::text::block::Block;

/// A number that is a variable's, so many times, and something added.
#[derive(Clone, Debug, PartialEq)]
struct Number {
    /// The variable; none in what is always the same.
    of: Option<Var>,
    times: i64,
    more: i64,
}

impl Number {
    /// The number where the variable is worth so much.
    fn at(&self, worth: i64) -> Option<u32> {
        let number = self.times.checked_mul(worth)?.checked_add(self.more)?;
        u32::try_from(number).ok()
    }

    /// Value of the variable where the number is this one, if that is whole.
    fn worth(&self, number: u32) -> Option<i64> {
        let rest = i64::from(number).checked_sub(self.more)?;
        rest.checked_div(self.times).filter(|worth| worth.checked_mul(self.times) == Some(rest))
    }

    fn scaled(self, by: i64) -> Option<Number> {
        Some(Number { times: self.times.checked_mul(by)?, more: self.more.checked_mul(by)?, ..self })
    }

    fn plus(self, other: Number) -> Option<Number> {
        let of = match (self.of, other.of) {
            (Some(one), Some(two)) if one != two => return None,
            (one, two) => one.or(two),
        };
        let (times, more) = (self.times.checked_add(other.times)?, self.more.checked_add(other.more)?);
        Some(Number { of, times, more })
    }
}

/// An expression as such a number.
fn number(e: &Expr) -> Option<Number> {
    let node = match e {
        Expr::Num(n) => return Some(Number { of: None, times: 0, more: n.whole_number()? }),
        Expr::Node(node) => node,
    };
    match &**node {
        Node::Vacant | Node::Element(_) | Node::Call(..) => None,
        Node::Var(var) => Some(Number { of: Some(var.clone()), times: 1, more: 0 }),
        Node::Unary(Unary::Negate, a) => number(a)?.scaled(-1),
        Node::Unary(Unary::Not, _) => None,
        Node::Binary(operator, a, b) => {
            let (a, b) = (number(a)?, number(b)?);
            match operator {
                Binary::Add => a.plus(b),
                Binary::Subtract => a.plus(b.scaled(-1)?),
                Binary::Multiply if a.of.is_none() => b.scaled(a.more),
                Binary::Multiply if b.of.is_none() => a.scaled(b.more),
                _ => None,
            }
        }
    }
}

/// The place of a table that a row's variable is.
fn place_of(row: &SystemRow, at: u32) -> Option<System> {
    let Expr::Node(node) = row.value(at, "").filter(|_| row.refuse.is_none())? else { return None };
    let Node::Var(Var::System(system)) = *node else { return None };
    is_entry(&system).then_some(system)
}

/// Whether two places are of one table.
fn is_alike(one: &System, other: &System) -> bool {
    match (one, other) {
        (System::ToolTable { value, .. }, System::ToolTable { value: other, .. }) => value == other,
        (System::WorkOffset { .. }, System::WorkOffset { .. }) => true,
        _ => false,
    }
}

impl Lower {
    /// A value for a variable, where that or the value is a place of a table by a computed number; `None` if nothing in it
    /// is. What is refused is reported.
    pub(in crate::word) fn by_number(
        &mut self,
        to: &Target,
        value: &Expr,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) -> Option<Vec<Op>> {
        let mut all: Vec<Number> = Vec::new();
        if let Target::Element(element) = to {
            all.extend(self.of_the_control(element));
        }
        self.within(value, &mut all);
        let first = all.first()?.clone();
        let refuse = |lower: &mut Lower, what: TableUnsupported, out: &mut Batch| {
            lower.fault(Fault::not_supported(PLACE, what), block.span, out);
            Some(Vec::new())
        };
        if all.iter().any(|number| number.of != first.of) {
            return refuse(self, TableUnsupported::TwoComputedHere, out);
        }
        self.leave_motion(None, out);
        let of = first.of.clone().map(|var| Expr::Node(Box::new(Node::Var(var))))?;
        let worths = self.worths(&all);
        if worths.is_empty() {
            return refuse(self, ANY_PLACE, out);
        }
        let mut cases = Vec::with_capacity(worths.len());
        for worth in worths {
            let mut value = value.clone();
            self.put_numbers(&mut value, worth);
            let named =
                |number: &Number| number.at(worth).map(|number| System::Other(format!("#{number}").into()));
            let own = if let Target::Element(element) = to { self.of_the_control(element) } else { None };
            let to = match own.as_ref().and_then(named) {
                Some(system) => Target::Var(Var::System(system)),
                None => to.clone(),
            };
            let mut ops = self.plain_assignment(&to, &value, block, src, out);
            if self.now.failed {
                return Some(Vec::new());
            }
            match (ops.pop(), ops.is_empty()) {
                (Some(op @ (Op::Assign(..) | Op::SetData(_))), true) => cases.push((worth, op)),
                _ => {
                    return refuse(self, TableUnsupported::NoValue, out);
                }
            }
        }
        let number = self.value(&of, block.span, out);
        self.computes.saved.entry(block.span, PLACE);
        Some(vec![of_number(&number, cases, block.span)])
    }

    /// The same of a parameter that is set to a place of a table by a computed number, in a block of its own.
    pub(in crate::word) fn parameter_by_number(
        &mut self,
        set: &Setting,
        alone: bool,
        out: &mut Batch,
    ) -> Option<Op> {
        let mut all: Vec<Number> = Vec::new();
        self.within(&set.value, &mut all);
        let first = all.first()?.clone();
        let mut of = first.of.clone().map(|var| Expr::Node(Box::new(Node::Var(var))))?;
        let worths = self.worths(&all);
        let refused = match () {
            () if !alone => Some(TableUnsupported::BesideWords),
            () if all.iter().any(|number| number.of != first.of) => Some(TableUnsupported::TwoComputedHere),
            () if worths.is_empty() => Some(ANY_PLACE),
            () => None,
        };
        if let Some(what) = refused {
            self.fault(Fault::not_supported(PLACE, what), set.span, out);
            return None;
        }
        let to = self.target_of(&set.to, set.span, out)?;
        let mut cases = Vec::with_capacity(worths.len());
        for worth in worths {
            let mut value = set.value.clone();
            self.put_numbers(&mut value, worth);
            self.parameters(&mut value, set.span, out);
            cases.push((worth, Op::Assign(to.clone(), value)));
        }
        self.parameters(&mut of, set.span, out);
        self.computes.saved.entry(set.span, PLACE);
        Some(of_number(&of, cases, set.span))
    }

    /// The number of one of the control's own variables, where it is computed from one variable alone.
    fn of_the_control(&self, element: &Element) -> Option<Number> {
        let number = match &element.at[..] {
            [at] => number(at)?,
            _ => return None,
        };
        // What a value of the control's is, is not followed.
        let own = |system: &System| matches!(system, System::Other(name) if !self.is_the_controls(name));
        if matches!(&number.of, Some(Var::System(system)) if !own(system)) {
            return None;
        }
        let rules = &self.settings.dialect.formula;
        let own = [&rules.local, &rules.common, &rules.retentive];
        let most = own.into_iter().flatten().map(|[_, to]| i64::from(*to)).max().unwrap_or_default();
        // By what the variable was given last; or by what stands in the number.
        let likely = number.of.as_ref().and_then(|var| self.likely(&self.as_kept(var)));
        let likely = likely.and_then(|worth| number.at(worth)).map_or(number.more, i64::from);
        (number.times != 0 && likely > most).then_some(number)
    }

    /// A variable as a statement has it.
    fn as_kept(&self, var: &Var) -> Expr {
        let kept = match var {
            Var::System(System::Other(name)) => {
                match name.strip_prefix("#<").and_then(|name| name.strip_suffix('>')) {
                    Some(name) if name.starts_with('_') => Var::Common(name.into()),
                    Some(name) => Var::Local(name.into()),
                    None => parameter(name.trim_start_matches('#')),
                }
            }
            var => var.clone(),
        };
        Expr::Node(Box::new(Node::Var(kept)))
    }

    /// Whether a name is one of the control's own values.
    fn is_the_controls(&self, name: &str) -> bool {
        let word = name.strip_prefix("#<").and_then(|word| word.strip_suffix('>'));
        let rows = &self.settings.dialect.system;
        match word {
            Some(word) => rows.iter().any(|row| row.name == word),
            None => !self.settings.dialect.program.o_words || self.row_of(name).is_some(),
        }
    }

    /// Refuses such a place anywhere but in an assignment.
    pub(in crate::word) fn no_place_here(&mut self, element: &Element, at: Span, out: &mut Batch) {
        if self.of_the_control(element).is_some() {
            let what = TableUnsupported::InWord;
            self.fault(Fault::NotSupported { code: PLACE.into(), what: what.into() }, at, out);
        }
    }

    /// All such numbers in an expression.
    fn within(&self, e: &Expr, found: &mut Vec<Number>) {
        if let Expr::Node(node) = e
            && let Node::Element(element) = &**node
            && let Some(number) = self.of_the_control(element)
        {
            return found.push(number);
        }
        e.parts().for_each(|part| self.within(part, found));
    }

    /// Puts the variables that they are in their places, where the one variable is worth so much.
    fn put_numbers(&self, e: &mut Expr, worth: i64) {
        if let Expr::Node(node) = e
            && let Node::Element(element) = &**node
            && let Some(number) = self.of_the_control(element).and_then(|number| number.at(worth))
        {
            **node = Node::Var(Var::System(System::Other(format!("#{number}").into())));
            return;
        }
        e.parts_mut().for_each(|part| self.put_numbers(part, worth));
    }

    /// The place of a table that a variable of this number is.
    fn table_place(&self, number: u32) -> Option<System> {
        let (row, at) = self.row_of(&format!("#{number}"))?;
        place_of(row, at)
    }

    /// Value of the variable for each place of the table that a number is likely to be of: the one nearest to what
    /// the variable was given last.
    fn worths(&self, numbers: &[Number]) -> Vec<i64> {
        let Some(number) = numbers.first() else { return Vec::new() };
        let rows = self.settings.dialect.system.iter().filter(|row| row.counts(&self.settings));
        let all: Vec<(i64, System)> = rows
            .flat_map(|row| row.numbers().map(move |own| (row, own)))
            .filter_map(|(row, own)| Some((number.worth(own)?, place_of(row, own - row.number)?)))
            .collect();
        let likely = number.of.as_ref().and_then(|var| self.likely(&self.as_kept(var))).unwrap_or(1);
        let Some((_, one)) = all.iter().min_by_key(|(worth, _)| worth.abs_diff(likely)) else {
            return Vec::new();
        };
        let mut worths: Vec<i64> =
            all.iter().filter(|(_, own)| is_alike(own, one)).map(|(worth, _)| *worth).collect();
        // One that is no place of a table has no branch: it must not reach that.
        worths.retain(|worth| {
            numbers
                .iter()
                .all(|number| number.at(*worth).and_then(|number| self.table_place(number)).is_some())
        });
        worths.sort_unstable();
        worths.dedup();
        worths
    }
}

/// What such a variable is called in messages.
const PLACE: &str = "#[…]";
