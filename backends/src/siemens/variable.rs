//! Variables that a unit declares or is called with: definitions, values by their types, messages and alarms, and calls
//! that hand values over.
//!
//! A variable of whole numbers rounds what it is given, and a truth value is any number but 0: what a program says of
//! that is stated by the type. Subprograms with parameters are made known where they are called (`EXTERN`).
//!
//! Not here: branches and loops (`computing`), and how expressions are spelt (the word writer's).

use std::collections::{BTreeMap, BTreeSet};

use ncc_dialects::NameMeaning;
use ncc_ir::computed::assigned_variables::AssignedVariables;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::types::Types;
use ncc_ir::expr::{Binary, Expr, Function, Node, Target, Var};
use ncc_ir::lack::OperatorLack;
use ncc_ir::program::arguments;
use ncc_ir::program::cycle::Cycle;
use ncc_ir::program::{Alarm, Attribute, Call, Control, Declare, Op, Piece, Procedure, Stmt, Text, Type};
use ncc_ir::run_time::{RunTimeFlow, RunTimeValue, RunTimeWord};
use ncc_ir::source::Span;

use super::statement::LONGEST_MESSAGE;
use super::unit::tell;
use super::{Modal, Sink, Writer};
use crate::common::fault::{cannot, cannot_compute};

/// Digits after the point that a real number has in a message, zeros at their end left out.
const DIGITS: u8 = 9;

/// What calls and definitions need to know of the program.
#[derive(Clone, Debug, Default)]
pub(super) struct Variables {
    /// Types of the unit at hand.
    types: Types,
    /// What subprograms take, by name: types of parameters.
    takes: BTreeMap<Text, Vec<Parameter>>,
    /// What subprograms may change of the variables that all see.
    changed: AssignedVariables,
    /// What the call that was written last gives back, each with where it is kept meanwhile.
    back: Vec<(Target, Expr)>,
    /// Subprograms with parameters that the unit at hand calls, as far as they are not made known.
    externs: BTreeSet<Text>,
    /// Whether definitions have been written, and the safe start has not.
    heading: bool,
    /// Whether a block of the unit has been written that is no definition.
    pub(super) executed: bool,
    told_alarm: bool,
    /// What the cycle that was called last is computed from.
    cycle: Vec<Expr>,
}

/// What a subprogram takes.
#[derive(Clone, Debug)]
struct Parameter {
    kind: Type,
    /// Where one is kept that is the caller's variable itself.
    reference: Option<Var>,
}

impl Parameter {
    /// As it is made known: `INT`, `VAR REAL`.
    fn head(&self) -> String {
        let var = if self.reference.is_some() { "VAR " } else { "" };
        format!("{var}{}", word(self.kind))
    }
}

impl Variables {
    /// Another cycle is called.
    pub(super) fn cycle_begins(&mut self, cycle: &Cycle) {
        self.cycle.clear();
        arguments::each(&mut Op::StartCycle(Box::new(cycle.clone())), &mut |argument, _| {
            self.cycle.extend(argument.expr().filter(|expr| expr.literal().is_none()).cloned());
            Ok::<(), std::convert::Infallible>(())
        })
        .unwrap_or_else(|never| match never {});
    }
}

/// A number that the program writes.
fn is(expr: &Expr, whole: i64) -> bool {
    expr.literal().and_then(|n| n.whole_number()) == Some(whole)
}

/// What is rounded to a whole number.
fn rounded(expr: &Expr) -> Option<&Expr> {
    let Expr::Node(node) = expr else { return None };
    match &**node {
        Node::Call(Function::Round, arguments) => arguments.first(),
        _ => None,
    }
}

impl Writer {
    /// Takes what subprograms have for parameters.
    pub(super) fn know_parameters(&mut self, procedures: &[Procedure]) {
        self.variables.changed = AssignedVariables::by_subprograms(procedures);
        for procedure in procedures.iter().skip(1).filter(|p| !p.parameters.is_empty()) {
            let all = procedure.parameters.iter().enumerate().map(|(place, var)| Parameter {
                kind: procedure.kinds.get(place).copied().unwrap_or(Type::Real),
                reference: (!matches!(var, Var::Local(_))).then(|| var.clone()),
            });
            self.variables.takes.insert(procedure.name.clone(), all.collect());
        }
        for procedure in procedures.iter().skip(1) {
            self.names.reserve(&procedure.name);
        }
    }

    /// A unit begins: its variables get their names.
    pub(super) fn begin_variables(&mut self, procedure: &Procedure, sink: &mut Sink) {
        self.variables.types = Types::of_procedure(procedure);
        (self.variables.executed, self.variables.heading) = (false, false);
        self.variables.externs.clear();
        self.words.variables.clear();
        self.names.new_variables();
        let at = procedure.body.first().map_or(Span::default(), |stmt| stmt.span);
        for parameter in &procedure.parameters {
            self.name_variable(parameter, at, sink);
        }
        self.look_for_variables(&procedure.body, sink);
        // It knows itself.
        self.variables.externs.remove(&procedure.name);
    }

    fn name_variable(&mut self, var: &Var, at: Span, sink: &mut Sink) {
        let (Var::Local(name) | Var::Common(name)) = var else { return };
        let dialect = self.dialect;
        let taken = |name: &str| dialect.name_row(name).is_some() || dialect.call_row(name).is_some();
        // After the program's name, of a parameter that is the caller's variable.
        let own = name.rsplit('.').next().unwrap_or(name);
        let text = tell(self.names.variable(own, &taken), at, sink);
        self.words.variables.insert(name.clone(), text);
    }

    fn look_for_variables(&mut self, body: &[Stmt], sink: &mut Sink) {
        for stmt in body {
            if let Op::Declare(declare) = &stmt.op {
                self.name_variable(&declare.var, stmt.span, sink);
            } else if let Op::Call(call) = &stmt.op {
                if self.variables.takes.contains_key(&call.name) {
                    self.variables.externs.insert(call.name.clone());
                }
            } else if let Op::Control(control) = &stmt.op {
                control.bodies().for_each(|body| self.look_for_variables(body, sink));
            }
        }
    }

    /// Before a statement: what is made known of subprograms stands before definitions, and these before all that is
    /// executed, the safe start too.
    pub(super) fn before_statement(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        if matches!(stmt.op, Op::Comment(_) | Op::Blank | Op::NoEffect(_)) {
            return Ok(());
        }
        let externs = std::mem::take(&mut self.variables.externs);
        if !externs.is_empty() {
            let number = self.words.block.number.take();
            for name in externs {
                let takes = self.variables.takes.get(&name).cloned().unwrap_or_default();
                let takes: Vec<String> = takes.iter().map(Parameter::head).collect();
                let name = self.program_name(&name, stmt.span, sink);
                self.alone(&format!("EXTERN {name}({})", takes.join(",")), sink)?;
                self.words.flush(false, sink);
                self.words.split = true;
            }
            self.words.block.number = number;
            self.variables.heading = true;
        }
        if matches!(stmt.op, Op::Declare(_)) {
            self.variables.heading = true;
        } else {
            self.variables.executed = true;
            if std::mem::replace(&mut self.variables.heading, false) {
                self.words.before_start(sink);
            }
        }
        Ok(())
    }

    /// The head of a subprogram with parameters or attributes.
    pub(super) fn parameters(&self, procedure: &Procedure, name: &str) -> Result<Option<String>, Fault> {
        let attributes: String = procedure
            .attributes
            .iter()
            .map(|attribute| match attribute {
                Attribute::GivesBack => " SAVE",
                Attribute::RunsThrough => " SBLOF",
                Attribute::NotShown => " DISPLOF",
            })
            .collect();
        if procedure.parameters.is_empty() {
            return Ok((!attributes.is_empty()).then(|| format!("PROC {name}{attributes}")));
        }
        let mut all = Vec::with_capacity(procedure.parameters.len());
        for parameter in &procedure.parameters {
            let (var, written) = match parameter {
                Var::Local(name) => ("", self.words.variables.get(name)),
                Var::Common(name) => ("VAR ", self.words.variables.get(name)),
                Var::Retentive(_) | Var::System(_) => ("", None),
            };
            let written = written.ok_or_else(|| cannot_compute(RunTimeFlow::ParameterCommon))?;
            all.push(format!("{var}{} {written}", word(self.variables.types.of_var(parameter))));
        }
        Ok(Some(format!("PROC {name}({}){attributes}", all.join(", "))))
    }

    /// The head of a standalone subprogram, with parameters.
    #[cold]
    pub(super) fn main_parameters(&mut self, main: &Procedure, sink: &mut Sink) {
        let span = main.body.first().map_or(Span::default(), |stmt| stmt.span);
        let name = self.program_name(&main.name, span, sink);
        match self.parameters(main, &name) {
            Ok(head) => {
                sink.out.extend_from_slice(head.unwrap_or_default().as_bytes());
                sink.out.extend_from_slice(self.words.eol);
                if let Some(trace) = &mut self.words.trace {
                    trace.frame(sink.out);
                }
            }
            Err(fault) => sink.report(fault, span),
        }
    }

    /// A call's arguments, each as its parameter takes it.
    pub(super) fn arguments(&mut self, call: &Call, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        self.variables.back.clear();
        if call.arguments.is_empty() {
            return Ok(String::new());
        }
        let takes = self.variables.takes.get(&call.name).cloned().unwrap_or_default();
        // One that is left out after the others is zero (PGA, calls with parameters); a variable of the caller's is not.
        let left_out = takes.get(call.arguments.len()..);
        if left_out.is_none_or(|left_out| left_out.iter().any(|parameter| parameter.reference.is_some())) {
            return Err(cannot_compute(RunTimeFlow::CallOtherArguments));
        }
        let by_reference = takes.iter().any(|parameter| parameter.reference.is_some());
        let changed = |value: &Expr| common(value) && (by_reference || !self.variables.changed.keeps(value));
        if call.times > 1 && call.arguments.iter().any(changed) {
            let what = RunTimeFlow::CallChangesValues;
            return Err(cannot_compute(what));
        }
        let mut arguments = Vec::with_capacity(takes.len());
        for (value, parameter) in call.arguments.iter().zip(takes) {
            arguments.push(match parameter.reference {
                None => self.of_type(parameter.kind, value, span, sink)?,
                Some(kept) => {
                    let to =
                        given_back(value).filter(|_| self.variables.types.type_of(value) == parameter.kind);
                    let to = to.ok_or_else(|| {
                        cannot_compute(match value {
                            Expr::Node(node) if matches!(**node, Node::Element(_)) => {
                                RunTimeFlow::ParameterArray
                            }
                            _ => RunTimeFlow::ParameterOtherType,
                        })
                    })?;
                    self.variables.back.push((to, Expr::Node(Box::new(Node::Var(kept)))));
                    self.words.expression(value, span, sink)?
                }
            });
        }
        Ok(format!("({})", arguments.join(",")))
    }

    /// A value for a variable of a type.
    ///
    /// # Errors
    /// The variable would make another value of it.
    fn of_type(&mut self, kind: Type, value: &Expr, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        let types = &self.variables.types;
        let value = match kind {
            Type::Real => value,
            Type::Int => match rounded(value) {
                Some(inner) => inner,
                None if types.are_whole(value) => value,
                None if value.literal().is_some_and(|n| n.whole_number().is_some()) => value,
                None => {
                    return Err(cannot_compute(RunTimeValue::NotWholeInInteger));
                }
            },
            Type::Bool => {
                if is(value, 1) || is(value, 0) {
                    return Ok(if is(value, 1) { "TRUE" } else { "FALSE" }.to_owned());
                }
                match not_zero(value) {
                    Some(number) => number,
                    None if types.type_of(value) == Type::Bool => value,
                    None => return Err(cannot_compute(RunTimeValue::NumberInTruth)),
                }
            }
        };
        let text = self.words.expression(value, span, sink)?;
        self.tell_comparison(&text, span, sink);
        Ok(text)
    }

    /// A value for a variable.
    pub(super) fn assign(
        &mut self,
        to: &Target,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        // The call says that by itself.
        if let Some(at) = self.variables.back.iter().position(|(var, kept)| var == to && kept == value) {
            self.variables.back.remove(at);
            return Ok(());
        }
        if self.standing.modal != Modal::Off && self.variables.cycle.iter().any(|expr| expr.reads(to)) {
            return Err(cannot_compute(RunTimeWord::CycleSourceAssigned));
        }
        let kind = match to {
            Target::Var(var) => self.variables.types.of_var(var),
            Target::Element(element) => self.variables.types.of_many(&element.of),
        };
        let element = matches!(to, Target::Element(_));
        let to = self.words.spelling(None)?.target(to)?;
        let mut value = self.of_type(kind, value, span, sink)?;
        if element && value.starts_with('(') {
            // After an element of an array, brackets hold the values of several (PGA, arrays: FIELD[0]=(1,2,3)).
            value.insert_str(0, "0 + ");
        }
        self.tell_number(&to, span, sink);
        self.alone(&format!("{to}={value}"), sink)
    }

    /// Definitions of one type that stand in one block.
    pub(super) fn declare(&mut self, rest: &[Stmt], sink: &mut Sink) -> Result<(), Fault> {
        let mut text = String::new();
        for stmt in rest {
            let Op::Declare(declare) = &stmt.op else { continue };
            if self.variables.executed {
                return Err(cannot_compute(RunTimeValue::DeclarationAfterBlocks));
            }
            if stmt.skip.is_some() {
                return Err(cannot_compute(RunTimeValue::DeclarationSkipped));
            }
            let one = self.definition(declare, stmt.span, sink)?;
            text = if text.is_empty() {
                format!("DEF {} {one}", word(declare.kind))
            } else {
                text + ", " + &one
            };
        }
        self.alone(&text, sink)
    }

    fn definition(&mut self, declare: &Declare, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        let name = match &declare.var {
            Var::Local(name) => self.words.variables.get(name).cloned(),
            Var::Common(_) | Var::Retentive(_) | Var::System(_) => None,
        };
        let name = name.ok_or_else(|| cannot_compute(RunTimeValue::DeclarationCommon))?;
        let sizes: Vec<String> = declare.sizes.iter().map(u32::to_string).collect();
        let sizes = if sizes.is_empty() { String::new() } else { format!("[{}]", sizes.join(",")) };
        let mut values = Vec::with_capacity(declare.initial.len());
        for value in &declare.initial {
            values.push(match value {
                Some(value) => self.of_type(declare.kind, value, span, sink)?,
                None => String::new(),
            });
        }
        let total = declare.sizes.iter().fold(1usize, |all, size| all.saturating_mul(*size as usize));
        let initial = match &values[..] {
            [] => String::new(),
            [value] if declare.sizes.is_empty() => format!("={value}"),
            _ if declare.sizes.is_empty() => {
                return Err(cannot_compute(RunTimeValue::SeveralFirstValues));
            }
            [first, rest @ ..] if rest.len() + 1 == total && total > 1 && rest.iter().all(|v| v == first) => {
                format!("=REP({first})")
            }
            values => format!("=SET({})", values.join(",")),
        };
        Ok(format!("{name}{sizes}{initial}"))
    }

    /// A message with values in it.
    pub(super) fn message_of(&mut self, pieces: &[Piece], span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let row = self.dialect.name_for(NameMeaning::Message).ok_or_else(|| cannot(OperatorLack::Message))?;
        let mut texts = Vec::with_capacity(pieces.len() + 1);
        let mut long = 0;
        for piece in pieces {
            match piece {
                Piece::Text(text) => {
                    if text.contains('"') || text.chars().any(char::is_control) {
                        return Err(cannot(OperatorLack::MessageQuotation));
                    }
                    long += text.chars().count();
                    texts.push(format!("\"{text}\""));
                }
                Piece::Value { value, digits, short, places: _ } => {
                    let fits = match self.variables.types.type_of(value) {
                        Type::Int => *short || *digits == 0,
                        Type::Real => *short && *digits == DIGITS,
                        Type::Bool => false,
                    };
                    if !fits {
                        return Err(cannot_compute(RunTimeWord::MessageDigits));
                    }
                    if texts.is_empty() {
                        texts.push("\"\"".into());
                    }
                    texts.push(self.words.expression(value, span, sink)?);
                }
            }
        }
        if long > LONGEST_MESSAGE {
            return Err(cannot(OperatorLack::MessageLength));
        }
        self.alone(&format!("{}({})", row.name, texts.join("<<")), sink)
    }

    /// An alarm of the numbers that end a program.
    pub(super) fn alarm(&mut self, alarm: &Alarm, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let number = alarm.number.as_ref().and_then(|n| n.literal()).and_then(|n| n.whole_number());
        let number = number.filter(|number| matches!(number, 61_000..=61_999 | 65_000..=66_999));
        let number = number.ok_or_else(|| cannot_compute(RunTimeWord::AlarmRange))?;
        if alarm.text.contains('"') || alarm.text.chars().any(char::is_control) {
            return Err(cannot(OperatorLack::AlarmQuotation));
        }
        if !std::mem::replace(&mut self.variables.told_alarm, true) {
            sink.report(Fault::AssumedFact { fact: ControlFact::AlarmsEnd }, span);
        }
        let text = if alarm.text.is_empty() { String::new() } else { format!(",\"{}\"", alarm.text) };
        self.alone(&format!("SETAL({number}{text})"), sink)
    }

    /// The head of a loop that counts by ones.
    pub(super) fn counted(
        &mut self,
        control: &Control,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        let Control::For { variable, from, to, step, .. } = control else {
            return Err(cannot_compute(RunTimeFlow::LoopOtherKind));
        };
        if !is(step, 1) {
            return Err(cannot_compute(RunTimeFlow::LoopCountsOtherwise));
        }
        let from = self.of_type(Type::Int, from, span, sink)?;
        let to = self.words.expression(to, span, sink)?;
        let counter = self.words.spelling(None)?.target(&Target::Var(variable.clone()))?;
        self.tell_number(&counter, span, sink);
        Ok(format!("FOR {counter}={from} TO {to}"))
    }
}

/// The variable that a call gives, and gets back.
fn given_back(value: &Expr) -> Option<Target> {
    let Expr::Node(node) = value else { return None };
    match &**node {
        Node::Var(var @ (Var::Local(_) | Var::Common(_))) => Some(Target::Var(var.clone())),
        _ => None,
    }
}

/// How many statements are definitions of one type in one block.
pub(super) fn defined_together(rest: &[Stmt]) -> usize {
    let kind = |stmt: &Stmt| if let Op::Declare(declare) = &stmt.op { Some(declare.kind) } else { None };
    let first = rest.first().and_then(kind);
    let more = rest.iter().skip(1).take_while(|stmt| first.is_some() && kind(stmt) == first).count();
    if first.is_some() { more + 1 } else { 0 }
}

/// The word of a type.
fn word(kind: Type) -> &'static str {
    match kind {
        Type::Real => "REAL",
        Type::Int => "INT",
        Type::Bool => "BOOL",
    }
}

/// What is looked at whether it is zero, where that is a literal.
fn not_zero(expr: &Expr) -> Option<&Expr> {
    let Expr::Node(node) = expr else { return None };
    match &**node {
        Node::Binary(Binary::NotEqual, number, zero) if number.literal().is_some() && is(zero, 0) => {
            Some(number)
        }
        _ => None,
    }
}

/// Whether a value follows from variables that other programs see.
fn common(expr: &Expr) -> bool {
    expr.has(&|node| match node {
        Node::Var(var) => !matches!(var, Var::Local(_)),
        Node::Element(element) => {
            !matches!(&element.of, ncc_ir::expr::Many::Array { var: Var::Local(_), .. })
        }
        Node::Vacant | Node::Unary(..) | Node::Binary(..) | Node::Call(..) => false,
    })
}
