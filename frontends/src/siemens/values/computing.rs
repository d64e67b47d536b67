//! Lowering of variables: their definitions, assignments, and words whose value is computed.
//!
//! A named variable belongs to the program that defines it. R parameters belong to the control; all programs see them.
//! A definition sets its initial value each time the program runs. ncc refuses a word that reads a variable which the
//! same block sets, as in `R1=5 X=R1`: a control may read the word before or after the assignment.
//!
//! Not here: text variables (`texts`).
//!
//! Refused: variables without a definition, unless the user names them; characters, axes and frames as variables.

mod definitions;

use ncc_dialects::Quantity;
use ncc_ir::canon::Fact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Element, Expr, Many, Node, Numbers, Scope, Target, Var};
use ncc_ir::program::arguments;
use ncc_ir::program::{Op, Type as Stored};
use ncc_ir::source::Span;
use ncc_ir::unsupported::left_out::LeftOut;
use ncc_ir::unsupported::{CodeUnsupported, Unsupported, ValueUnsupported};

use super::formula::{ANY_R, is_r, may_be_one, r_parameter, reads};
use super::typed::{Kind, Typed};
use crate::batch::Batch;
use crate::common::Source;
use crate::common::number::unit_of;
use crate::common::words::Digits;
use crate::siemens::block_words::Given;
use crate::siemens::lower::Lower;
use crate::siemens::siemens_state::ModalCall;
use crate::siemens::text::tree::{Address, Expr as Tree, Place, Value};

/// Highest R parameter that ncc accepts. Machine data of the control may allow fewer.
pub(in crate::siemens) const LAST_R: u32 = 999;

/// The target of an assignment, or the source of a read.
struct Kept {
    target: Target,
    kind: Kind,
    /// Name for the comparison of variables: `R5`, the defined name, or [`ANY_R`] for a computed R number.
    name: Box<str>,
}

/// The values of `SET(…)`, `(…)` or `REP(…)`.
#[derive(Clone, Copy)]
struct Several<'t> {
    values: &'t [Option<Tree>],
    /// `REP`: the first value fills all elements.
    all: bool,
}

pub(in crate::siemens) fn array(name: &str, sizes: &[u32]) -> Many {
    Many::Array { var: Var::Local(name.into()), sizes: sizes.into() }
}

impl Lower {
    /// Reads a variable or a named constant; `None` if it is refused (reported).
    pub(in crate::siemens) fn read(&mut self, place: &Place, src: Source, out: &mut Batch) -> Option<Typed> {
        if let Address::System(name) = place.address {
            let text = src.text(place.span).to_ascii_uppercase();
            return match Lower::named_constant(&text) {
                Some(constant) => Some(constant),
                None => self.of_control(name, place, src, out),
            };
        }
        if let Address::Name(name) = place.address
            && place.index.is_empty()
            && let Some(constant) = Lower::named_constant(&src.text(name).to_ascii_uppercase())
        {
            return Some(constant);
        }
        let kept = self.kept(place, src, out)?;
        if kept.kind == Kind::Text {
            self.not_supported(&src.text(place.span), ValueUnsupported::Text, place.span, out);
            return None;
        }
        let node = match kept.target {
            Target::Var(var) => Node::Var(var),
            Target::Element(element) => Node::Element(*element),
        };
        Some(Typed::new(node, kept.kind))
    }

    /// Finds the variable of a place in the text; `None` if it is refused (reported).
    fn kept(&mut self, place: &Place, src: Source, out: &mut Batch) -> Option<Kept> {
        let span = place.span;
        if is_r(place) {
            return self.r(place, src, out);
        }
        let Address::Name(name) = place.address else {
            self.not_supported(&src.text(span), ValueUnsupported::Address, span, out);
            return None;
        };
        let name = src.text(name).to_ascii_uppercase();
        let elsewhere = self.settings.dialect.program.variables_elsewhere.iter();
        if !self.variables.contains_key(&*name)
            && place.index.is_empty()
            && elsewhere.clone().any(|row| row.name == name && !row.left_out)
        {
            // The user names it as a variable of a definition file. It is common, and ncc assumes REAL.
            let target = Target::Var(Var::Common(name.as_str().into()));
            return Some(Kept { target, kind: Kind::Real, name: name.into() });
        }
        let Some(variable) = self.variables.get(&*name).cloned() else {
            let refuse = self.settings.dialect.name_row(&name).and_then(|row| row.refuse.as_deref());
            let what = refuse.map_or(ValueUnsupported::Undefined.into(), Unsupported::named);
            self.not_supported(&name, what, span, out);
            return None;
        };
        if variable.sizes.len() != place.index.len() {
            let what = ValueUnsupported::Indices;
            self.not_supported(&src.text(span), what, span, out);
            return None;
        }
        let target = if let Some(var) = variable.reference {
            let var = self.of_caller(var, &variable.sizes, place, src, out)?;
            let name = var.name().into();
            return Some(Kept { target: Target::Var(var), kind: variable.kind, name });
        } else if variable.sizes.is_empty() {
            Target::Var(Var::Local(name.as_str().into()))
        } else {
            let at = self.indices(place, src, out)?;
            Target::Element(Box::new(Element { of: array(&name, &variable.sizes), at }))
        };
        Some(Kept { target, kind: variable.kind, name: name.into() })
    }

    /// Finds an R parameter: `R5`, `R[R1+2]`. Range 0 to [`LAST_R`].
    fn r(&mut self, place: &Place, src: Source, out: &mut Batch) -> Option<Kept> {
        let span = place.span;
        let number = match (place.extension, &place.index[..]) {
            (Some(number), []) => number,
            (None, [Some(_)]) => {
                let at = self.indices(place, src, out)?;
                match at
                    .first()
                    .and_then(Expr::literal)
                    .map(|n| n.whole_number().and_then(|n| n.try_into().ok()))
                {
                    Some(Some(number)) => number,
                    Some(None) => {
                        return self.refuse(Fault::OutOfRange { word: src.text(span).into() }, span, out);
                    }
                    None => {
                        let all = Numbers { scope: Scope::Common, prefix: "R".into(), from: 0, to: LAST_R };
                        let of = Many::Numbered(Box::new([all]));
                        let target = Target::Element(Box::new(Element { of, at }));
                        return Some(Kept { target, kind: Kind::Real, name: ANY_R.into() });
                    }
                }
            }
            _ => {
                self.not_supported(&src.text(span), ValueUnsupported::RWithoutNumber, span, out);
                return None;
            }
        };
        if number > LAST_R {
            return self.refuse(Fault::OutOfRange { word: src.text(span).into() }, span, out);
        }
        let var = r_parameter(number);
        let name = var.name().into();
        Some(Kept { target: Target::Var(var), kind: Kind::Real, name })
    }

    pub(in crate::siemens) fn indices(
        &mut self,
        place: &Place,
        src: Source,
        out: &mut Batch,
    ) -> Option<Vec<Expr>> {
        let mut at = Vec::with_capacity(place.index.len());
        for index in &place.index {
            let Some(index) = index else {
                self.not_supported(&src.text(place.span), ValueUnsupported::IndexLeftOut, place.span, out);
                return None;
            };
            let value = self.formula(index, src, out)?;
            at.push(self.whole_number(value, index.span(), out));
        }
        Some(at)
    }

    /// Whether the left side of `=` is a variable: an R parameter, a defined name, or a name without another meaning.
    pub(in crate::siemens) fn is_variable(&self, place: &Place, src: Source) -> bool {
        match place.address {
            Address::Letter(letter) => letter == b'R',
            Address::System(_) => false,
            Address::Name(name) => {
                let name = src.text(name).to_ascii_uppercase();
                self.variables.contains_key(&*name) || self.settings.dialect.name_row(&name).is_none()
            }
        }
    }

    /// Lowers an assignment of one value, several values or a text.
    pub(in crate::siemens) fn assign(
        &mut self,
        place: &Place,
        value: &Value,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) {
        if self.is_left_out(place, src, out) {
            return;
        }
        out.whole = true;
        if let Some(name) = self.text_variable(place, src) {
            return self.set_text(&name, value, span, src, out);
        }
        if let Some(several) = several_values(value, src) {
            return self.assign_several(place, several, span, src, out);
        }
        let Value::Expr(value) = value else {
            return self.not_supported(&src.text(span), ValueUnsupported::Form, span, out);
        };
        let value = self.formula(value, src, out);
        let Some(kept) = self.kept(place, src, out) else {
            self.now.refused = true;
            return;
        };
        let Some(value) = value else {
            self.now.refused = true;
            return;
        };
        if let Some(value) = self.converted(value, kept.kind, span, out) {
            self.put(kept, value, span, out);
        }
    }

    /// Whether the user has ncc leave out assignments to this undefined variable. Reports it once for each name.
    fn is_left_out(&mut self, place: &Place, src: Source, out: &mut Batch) -> bool {
        let Address::Name(name) = place.address else { return false };
        let name = src.text(name).to_ascii_uppercase();
        let elsewhere = &self.settings.dialect.program.variables_elsewhere;
        let left_out = elsewhere.iter().find(|row| row.name == name).is_some_and(|row| row.left_out);
        if !left_out || self.variables.contains_key(&*name) {
            return false;
        }
        if self.first_time(&name) {
            out.report(
                Fault::CodeLeftOut { what: LeftOut::Assignment { name: name.as_str().into() } },
                place.span,
            );
        }
        true
    }

    fn put(&mut self, kept: Kept, value: Expr, span: Span, out: &mut Batch) {
        if !self.is_free_to_change(&kept.name, span, out) {
            return;
        }
        self.now.set.push(kept.name);
        self.push(span, Op::Assign(kept.target, value), out);
    }

    /// Whether an assignment to this variable leaves the active `MCALL` unchanged. Reports it if an argument of `MCALL`
    /// reads the variable: no source says whether the new value counts.
    pub(in crate::siemens) fn is_free_to_change(&mut self, name: &str, span: Span, out: &mut Batch) -> bool {
        let mut found = false;
        let mut one = |expr: &Expr| reads(expr, &mut |read| found |= may_be_one(read, name));
        let refuse = match &self.state.cycle {
            ModalCall::Active(cycle) => {
                let op = &mut Op::StartCycle(cycle.clone());
                arguments::each(op, &mut |argument, _| {
                    argument.expr().into_iter().for_each(&mut one);
                    Ok::<(), std::convert::Infallible>(())
                })
                .unwrap_or_else(|never| match never {});
                ValueUnsupported::SetInCycle
            }
            ModalCall::Subprogram(after) => {
                after.given.iter().flatten().for_each(|typed| one(&typed.expr));
                ValueUnsupported::SetInModal
            }
            ModalCall::None | ModalCall::Inherited { .. } | ModalCall::Lost { .. } | ModalCall::Refused => {
                return true;
            }
        };
        if found {
            self.not_supported(name, refuse, span, out);
        }
        !found
    }

    /// Lowers `FIELD[0]=SET(1,2,3)` and `FIELD[0]=REP(0)` to one assignment per element, from this element on.
    fn assign_several(&mut self, place: &Place, several: Several, span: Span, src: Source, out: &mut Batch) {
        let refuse = |lower: &mut Lower, what: ValueUnsupported, out: &mut Batch| {
            lower.not_supported(&src.text(span), what, span, out);
        };
        let Address::Name(name) = place.address else {
            return refuse(self, ValueUnsupported::SeveralForOne, out);
        };
        let name = src.text(name).to_ascii_uppercase();
        let Some(variable) = self.variables.get(&*name).cloned().filter(|v| !v.sizes.is_empty()) else {
            return refuse(self, ValueUnsupported::SeveralForNoArray, out);
        };
        if place.index.len() != variable.sizes.len() {
            return refuse(self, ValueUnsupported::Indices, out);
        }
        let Some(at) = self.indices(place, src, out) else { return };
        let mut first = 0u32;
        for (at, size) in at.iter().zip(&variable.sizes) {
            let whole = at.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok());
            match whole {
                Some(at) if at < *size => first = first * size + at,
                Some(_) => return self.fault(Fault::OutOfRange { word: src.text(span).into() }, span, out),
                None => return refuse(self, ValueUnsupported::SeveralComputed, out),
            }
        }
        let total: u32 = variable.sizes.iter().product();
        let Some(values) = self.values(several, variable.kind, total - first, span, src, out) else {
            return;
        };
        for (place, value) in (first..).zip(values) {
            let Some(value) = value else { continue };
            let mut rest = place;
            let mut at: Vec<Expr> = Vec::with_capacity(variable.sizes.len());
            for size in variable.sizes.iter().rev() {
                at.push(Expr::int(i64::from(rest % size)));
                rest /= size;
            }
            at.reverse();
            let target = Target::Element(Box::new(Element { of: array(&name, &variable.sizes), at }));
            let kept = Kept { target, kind: variable.kind, name: name.as_str().into() };
            self.put(kept, value, span, out);
        }
    }

    /// Values of `SET` or `REP`, at most `room`. More values are refused (reported).
    fn values(
        &mut self,
        Several { values, all }: Several,
        kind: Kind,
        room: u32,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) -> Option<Vec<Option<Expr>>> {
        if !all {
            if values.len() > room as usize {
                return self.refuse(Fault::OutOfRange { word: src.text(span).into() }, span, out);
            }
            let mut found = Vec::with_capacity(values.len());
            for value in values {
                found.push(match value {
                    None => None,
                    Some(value) => {
                        let typed = self.formula(value, src, out)?;
                        self.converted(typed, kind, value.span(), out)
                    }
                });
            }
            return Some(found);
        }
        let (Some(Some(value)), true) = (values.first(), values.len() <= 2) else {
            self.not_supported(&src.text(span), ValueUnsupported::RepWithoutValue, span, out);
            return None;
        };
        let typed = self.formula(value, src, out)?;
        let value = self.converted(typed, kind, value.span(), out)?;
        let count = match values.get(1) {
            None | Some(None) => room,
            Some(Some(Tree::Number(digits, _))) if digits.scale == 0 && !digits.point => {
                match u32::try_from(digits.mantissa) {
                    Ok(count) if count <= room => count,
                    _ => return self.refuse(Fault::OutOfRange { word: src.text(span).into() }, span, out),
                }
            }
            Some(Some(_)) => {
                self.not_supported(&src.text(span), ValueUnsupported::RepComputed, span, out);
                return None;
            }
        };
        Some(vec![Some(value); count as usize])
    }

    /// The value of a word or an argument: a number, or the index of an expression in `exprs`.
    pub(in crate::siemens) fn given(&mut self, typed: Typed, span: Span) -> Given {
        let plain = Digits { mantissa: 0, scale: 0, point: false };
        match typed.expr.literal() {
            Some(Num { mantissa, scale, point, .. }) => {
                let digits = Digits { mantissa, scale, point };
                Given { digits, distance: None, way: None, computed: None, span }
            }
            None => {
                // A line is too short for more than `u16::MAX` expressions.
                let place = u16::try_from(self.exprs.len()).unwrap_or(u16::MAX);
                self.exprs.push(typed);
                Given { digits: plain, distance: None, way: None, computed: Some(place), span }
            }
        }
    }

    /// The value of a word in the unit of `quantity`; `None` if it is refused (reported).
    pub(in crate::siemens) fn amount(
        &mut self,
        given: Given,
        quantity: Quantity,
        src: Source,
        out: &mut Batch,
    ) -> Option<Expr> {
        let Some(place) = given.computed else {
            return self.number(given, quantity, src, out).map(Expr::Num);
        };
        let typed = self.exprs.get(usize::from(place)).cloned()?;
        out.whole = true;
        match quantity {
            Quantity::Length => {
                self.units(given.span, out);
            }
            Quantity::Feed => {
                // A computed feed has the unit of lengths.
                let feed = self.feed_unit(given.span, out)?;
                let lengths = self.units(given.span, out);
                if feed != Unit::Entry && (lengths == Fact::Entry || feed != unit_of(lengths)) {
                    let what = ValueUnsupported::FeedUnit;
                    self.not_supported(&src.text(given.span), what, given.span, out);
                    return None;
                }
            }
            Quantity::Integer => return Some(self.whole_number(typed, given.span, out)),
            Quantity::Angle | Quantity::Seconds | Quantity::Speed | Quantity::Factor => {}
            Quantity::Milliseconds => {
                self.not_supported(&src.text(given.span), CodeUnsupported::ComputedWord, given.span, out);
                return None;
            }
        }
        Some(typed.expr)
    }

    /// Refuses a block in which a word reads a variable that an assignment of the block sets.
    pub(in crate::siemens) fn no_word_reads_what_is_set(&mut self, src: Source, out: &mut Batch) {
        if self.now.set.is_empty() {
            return;
        }
        let set = std::mem::take(&mut self.now.set);
        let mut found = false;
        for typed in &self.exprs {
            reads(&typed.expr, &mut |name| found |= set.iter().any(|set| may_be_one(name, set)));
        }
        self.now.set = set;
        if found {
            let at = self.now.span;
            let what = ValueUnsupported::ReadsOwn;
            self.not_supported(&src.text(at), what, at, out);
        }
    }
}

/// Type of the variable in the program. Texts have no variable there; they give `Bool`.
pub(in crate::siemens) fn stored(kind: Kind) -> Stored {
    match kind {
        Kind::Real => Stored::Real,
        Kind::Int => Stored::Int,
        Kind::Bool | Kind::Text => Stored::Bool,
    }
}

/// The values of `SET(…)`, `(…)` or `REP(…)`; `None` for any other value.
fn several_values<'t>(value: &'t Value, src: Source) -> Option<Several<'t>> {
    match value {
        Value::List(values) => Some(Several { values, all: false }),
        Value::Expr(Tree::Call { name, arguments, .. }) => {
            let name = src.text(*name);
            let all = name.eq_ignore_ascii_case("REP");
            (all || name.eq_ignore_ascii_case("SET")).then_some(Several { values: arguments, all })
        }
        Value::Expr(_) | Value::Qualified(..) => None,
    }
}
