//! Definitions of variables and of parameters.

use ncc_ir::diag::Fault;
use ncc_ir::expr::Var;
use ncc_ir::program::{Declare, Op};
use ncc_ir::source::Span;
use ncc_ir::unsupported::ValueUnsupported;

use super::super::typed::Kind;
use super::{several_values, stored};
use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::lower::Lower;
use crate::siemens::text::tree::{Address, Declaration, Declared, Expr as Tree, Place, TypeName, Value};
use crate::siemens::values::variables::{TextOf, Variable};

/// Most dimensions of an array.
const DIMENSIONS: usize = 3;

/// Most elements of an array.
const MOST_ELEMENTS: u32 = 100_000;

impl Lower {
    /// `DEF REAL DEPTH=2.5, FIELD[3]=SET(1,2,3)`
    pub(in crate::siemens) fn define(
        &mut self,
        definition: &Declaration,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) {
        out.whole = true;
        self.now.heading = true;
        if let Some(scope) = definition.scope.first() {
            return self.not_supported(&src.text(*scope), ValueUnsupported::ForAllPrograms, *scope, out);
        }
        if let Some((attribute, _)) = definition.attributes.first() {
            return self.not_supported(
                &src.text(*attribute),
                ValueUnsupported::VariableAttribute,
                *attribute,
                out,
            );
        }
        if self.skipped() {
            return self.not_supported("DEF", ValueUnsupported::DefSkipped, span, out);
        }
        if self.executed {
            return self.not_supported("DEF", ValueUnsupported::DefLate, span, out);
        }
        let Some(kind) = self.kind_of(definition.kind.name, span, src, out) else { return };
        let longest = match definition.kind.size.first() {
            Some(Some(Tree::Number(digits, _))) if digits.scale == 0 => usize::try_from(digits.mantissa).ok(),
            _ => None,
        };
        for declared in &definition.names {
            self.define_one(declared, kind, longest, src, out);
        }
    }

    /// A type that variables can have here; `None` if it is refused (reported).
    pub(in crate::siemens) fn kind_of(
        &mut self,
        name: TypeName,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) -> Option<Kind> {
        let refuse = match name {
            TypeName::Real => return Some(Kind::Real),
            TypeName::Int => return Some(Kind::Int),
            TypeName::Bool => return Some(Kind::Bool),
            TypeName::String => return Some(Kind::Text),
            TypeName::Char => ValueUnsupported::Character,
            TypeName::Axis => ValueUnsupported::AxisVariable,
            TypeName::Frame => ValueUnsupported::FrameVariable,
        };
        self.not_supported(&src.text(span), refuse, span, out);
        None
    }

    /// The name of a variable that is defined, and the sizes of an array; `None` if it is refused (reported).
    pub(in crate::siemens) fn new_variable(
        &mut self,
        place: &Place,
        src: Source,
        out: &mut Batch,
    ) -> Option<(String, Box<[u32]>)> {
        let span = place.span;
        let Address::Name(name) = place.address else {
            self.not_supported(&src.text(span), ValueUnsupported::VariableName, span, out);
            return None;
        };
        let name = src.text(name).to_ascii_uppercase();
        let dialect = self.settings.dialect;
        let taken = if dialect.name_row(&name).is_some() || dialect.call_row(&name).is_some() {
            Some(ValueUnsupported::ReservedName)
        } else if self.variables.contains_key(&*name) || Lower::named_constant(&name).is_some() {
            Some(ValueUnsupported::DefinedTwice)
        } else if place.index.len() > DIMENSIONS {
            Some(ValueUnsupported::Dimensions)
        } else {
            None
        };
        if let Some(taken) = taken {
            self.not_supported(&name, taken, span, out);
            return None;
        }
        let mut sizes = Vec::with_capacity(place.index.len());
        for size in &place.index {
            let size = match size {
                Some(Tree::Number(digits, _)) if digits.scale == 0 => u32::try_from(digits.mantissa).ok(),
                _ => None,
            };
            match size.filter(|size| (1..=MOST_ELEMENTS).contains(size)) {
                Some(size) => sizes.push(size),
                None => return self.refuse(Fault::OutOfRange { word: src.text(span).into() }, span, out),
            }
        }
        let total = sizes.iter().try_fold(1u32, |all, size| all.checked_mul(*size));
        if total.is_none_or(|total| total > MOST_ELEMENTS) {
            return self.refuse(Fault::OutOfRange { word: src.text(span).into() }, span, out);
        }
        Some((name, sizes.into()))
    }

    /// A variable that is given its value from elsewhere, and the sizes of an array.
    pub(in crate::siemens) fn new_parameter(
        &mut self,
        place: &Place,
        kind: Kind,
        by_reference: bool,
        src: Source,
        out: &mut Batch,
    ) -> Option<(Var, Box<[u32]>)> {
        let (name, sizes) = self.new_variable(place, src, out)?;
        let program = self.sub.as_ref().map_or("", |procedure| &procedure.name);
        let reference = by_reference.then(|| Var::Common(format!("{program}.{name}").into()));
        let var = reference.clone().unwrap_or_else(|| Var::Local(name.as_str().into()));
        let text = TextOf::default();
        self.variables.insert(name.into(), Variable { kind, sizes: sizes.clone(), text, reference });
        Some((var, sizes))
    }

    fn define_one(
        &mut self,
        declared: &Declared,
        kind: Kind,
        longest: Option<usize>,
        src: Source,
        out: &mut Batch,
    ) {
        let place = &declared.place;
        let span = place.span;
        let Some((name, sizes)) = self.new_variable(place, src, out) else { return };
        let text = if kind == Kind::Text { TextOf::empty(longest) } else { TextOf::default() };
        let variable = Variable { kind, sizes: sizes.clone(), text, reference: None };
        if kind == Kind::Text {
            if !sizes.is_empty() {
                return self.not_supported(&src.text(span), ValueUnsupported::TextArray, span, out);
            }
            self.variables.insert(name.as_str().into(), variable);
            if let Some(value) = &declared.initial {
                self.set_text(&name, value, span, src, out);
                if let Some(Variable { text, .. }) = self.variables.get_mut(name.as_str()) {
                    text.first.clone_from(&text.now);
                }
            }
            return;
        }
        let total: u32 = sizes.iter().product();
        let initial = match &declared.initial {
            None => Some(Vec::new()),
            Some(value) => match (several_values(value, src), value) {
                (Some(several), _) if !sizes.is_empty() => self.values(several, kind, total, span, src, out),
                (None, Value::Expr(value)) if sizes.is_empty() => self
                    .formula(value, src, out)
                    .and_then(|typed| self.converted(typed, kind, span, out))
                    .map(|value| vec![Some(value)]),
                _ => {
                    self.not_supported(&src.text(span), ValueUnsupported::FirstValueForm, span, out);
                    None
                }
            },
        };
        // One whose first value is refused is known all the same.
        self.variables.insert(name.as_str().into(), variable);
        let Some(initial) = initial else { return };
        let declare = Declare { var: Var::Local(name.into()), kind: stored(kind), sizes, initial };
        self.push(span, Op::Declare(Box::new(declare)), out);
    }
}
