//! Parameters of subprograms, and what calls hand over to them.
//!
//! A subprogram stands after its calls, as a rule: what its parameters are is put into the calls when the text has
//! been read. A value is converted as for an assignment; one that is left out is the parameter's own, or 0.
//!
//! A parameter that is the caller's variable itself (`VAR`; Job planning 03/2006, 1.18 and 1.19) is a variable that all
//! programs see, of that subprogram alone: the call gives it the value of the caller's, which gets its value back after
//! the call. That is the same as long as the subprogram can reach the caller's variable in no other way.
//!
//! An array as such a parameter is one of these for each of its elements.
//!
//! Refused: texts, other arrays, computed indices of arrays that are the caller's own; for `VAR` a value that is no variable or is of another type, one that is left out,
//! one variable twice, an R parameter that the subprogram uses by its own name, a call that is made several times, and
//! subprograms that call themselves.

use std::collections::BTreeSet;

use ncc_ir::canon::{self, Modes};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::{Element, Expr, Many, Node, Target, Var};
use ncc_ir::program::{Attribute, Control, Op, Procedure, Program, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;
use ncc_ir::unsupported::CallUnsupported;
use ncc_passes::flow::restored_modes;

use super::calls::Handing;
use super::handed::{Argument, Call, Taken};
use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::lower::Lower;
use crate::siemens::siemens_state::Motion;
use crate::siemens::text::tree::{Address, Expr as Tree, Parameter, Place, Value};
use crate::siemens::values::computing::{array, stored};
use crate::siemens::values::formula::{may_be_one, reads, several};
use crate::siemens::values::typed::{Kind, Typed};

/// Where an element is kept of an array that is the caller's own.
pub(super) fn element_of(reference: &Var, at: &[u32]) -> Var {
    let mut name = reference.name().to_string();
    at.iter().for_each(|at| name.push_str(&format!(".{at}")));
    Var::Common(name.into())
}

/// The indices of all elements of an array, the last one fastest.
pub(super) fn all_indices(sizes: &[u32]) -> Vec<Vec<u32>> {
    let more = |all: Vec<Vec<u32>>, size: &u32| {
        let with = |at: Vec<u32>| (0..*size).map(move |next| [&at[..], &[next]].concat());
        all.into_iter().flat_map(with).collect()
    };
    sizes.iter().fold(vec![Vec::new()], more)
}

/// What a call hands over.
struct Ready {
    at: Span,
    arguments: Vec<Expr>,
    /// The caller's variables that it gives, and where they are kept meanwhile.
    back: Vec<(Target, Var)>,
}

impl Lower {
    /// The parameters of the subprogram that is being read.
    pub(in crate::siemens) fn parameters(
        &mut self,
        all: &[Parameter],
        name: Span,
        src: Source,
        out: &mut Batch,
    ) {
        if all.is_empty() {
            return;
        }
        out.whole = true;
        let mut taken = Vec::with_capacity(all.len());
        let mut vars = Vec::with_capacity(all.len());
        for parameter in all {
            let Some(declared) = &parameter.name else { continue };
            let at = declared.place.span;
            let Some(kind) = self.kind_of(parameter.kind.name, at, src, out) else { continue };
            let alone = self.sub.is_none();
            let by_value = !declared.place.index.is_empty() && !parameter.by_reference;
            if kind == Kind::Text || by_value {
                let what =
                    if by_value { CallUnsupported::ArrayByValue } else { CallUnsupported::TextParameter };
                self.not_supported(&src.text(at), what, at, out);
                continue;
            }
            let otherwise = match &declared.initial {
                _ if alone && (parameter.by_reference || declared.initial.is_some()) => {
                    let what = CallUnsupported::SubAlone;
                    self.not_supported("PROC", what, at, out);
                    None
                }
                Some(_) if parameter.by_reference => {
                    self.not_supported("VAR", CallUnsupported::DefaultOfReference, at, out);
                    None
                }
                None => Some(Expr::int(0)),
                Some(Value::Expr(value @ Tree::Number(..))) => {
                    let typed = self.formula(value, src, out);
                    typed.and_then(|typed| self.converted(typed, kind, at, out))
                }
                Some(_) => {
                    self.not_supported(&src.text(at), CallUnsupported::DefaultForm, at, out);
                    None
                }
            };
            let var = self.new_parameter(&declared.place, kind, parameter.by_reference, src, out);
            let (Some((var, sizes)), Some(otherwise)) = (var, otherwise) else { continue };
            let reference = parameter.by_reference.then(|| var.clone());
            match sizes.is_empty() {
                true => vars.push(var),
                false => vars.extend(all_indices(&sizes).iter().map(|at| element_of(&var, at))),
            }
            taken.push(Taken { kind, otherwise, reference, sizes });
        }
        let kinds = |taken: &[Taken]| {
            taken.iter().flat_map(|taken| vec![stored(taken.kind); all_indices(&taken.sizes).len()]).collect()
        };
        match &mut self.sub {
            Some(procedure) => {
                procedure.kinds = kinds(&taken);
                procedure.parameters = vars;
                self.handed.parameters.push((procedure.name.clone(), taken));
            }
            None => {
                let kinds = kinds(&taken);
                let name = src.text(name).to_ascii_uppercase().into();
                let heading = Procedure { name, parameters: vars, kinds, ..Procedure::default() };
                out.heading = Some(Box::new(heading));
            }
        }
    }

    /// What a call hands over, as far as it is known; `None` if it is refused (reported).
    pub(in crate::siemens) fn handed_over(
        &mut self,
        name: &str,
        given: Handing,
        at: Span,
        src: Source,
        out: &mut Batch,
    ) -> Option<Vec<Expr>> {
        let all = match given {
            Handing::AfterMove(given) => given.iter().map(|given| given.clone().map(Argument::One)).collect(),
            Handing::Written(given) => {
                let mut all = Vec::with_capacity(given.len());
                for argument in given {
                    all.push(match argument {
                        None => None,
                        Some(argument) => Some(match self.whole_array(argument, src) {
                            Some((sizes, elements)) => Argument::Array(sizes, elements),
                            None => Argument::One(self.formula(argument, src, out)?),
                        }),
                    });
                }
                all
            }
        };
        let nothing = || Expr::Node(Box::new(Node::Vacant));
        let shown = |argument: &Option<Argument>| match argument {
            Some(Argument::One(typed)) => typed.expr.clone(),
            Some(Argument::Array(..)) | None => nothing(),
        };
        let arguments = all.iter().map(shown).collect();
        let modal = matches!(given, Handing::AfterMove(_));
        self.handed.calls.push(Call { name: name.into(), at, given: all, modal });
        Some(arguments)
    }

    /// A variable of the caller, or the element of an array of its own; `None` if it is refused (reported).
    pub(in crate::siemens) fn of_caller(
        &mut self,
        var: Var,
        sizes: &[u32],
        place: &Place,
        src: Source,
        out: &mut Batch,
    ) -> Option<Var> {
        if sizes.is_empty() {
            return Some(var);
        }
        let mut found = Vec::with_capacity(sizes.len());
        for (at, size) in self.indices(place, src, out)?.iter().zip(sizes) {
            let Some(at) = at.literal() else {
                let what = CallUnsupported::ArrayIndexComputed;
                self.not_supported(&src.text(place.span), what, place.span, out);
                return None;
            };
            match at.whole_number().and_then(|at| u32::try_from(at).ok()).filter(|at| at < size) {
                Some(at) => found.push(at),
                None => {
                    return self.refuse(
                        Fault::OutOfRange { word: src.text(place.span).into() },
                        place.span,
                        out,
                    );
                }
            }
        }
        Some(element_of(&var, &found))
    }

    /// The elements of an array that an argument names as a whole.
    pub(in crate::siemens) fn whole_array(
        &self,
        value: &Tree,
        src: Source,
    ) -> Option<(Box<[u32]>, Vec<Typed>)> {
        let Tree::Place(place) = value else { return None };
        let Address::Name(name) = place.address else { return None };
        let name = src.text(name).to_ascii_uppercase();
        let variable = self.variables.get(&*name)?;
        if variable.sizes.is_empty() || !place.index.is_empty() {
            return None;
        }
        let element = |at: Vec<u32>| {
            let node = match &variable.reference {
                Some(own) => Node::Var(element_of(own, &at)),
                None => {
                    let at = at.into_iter().map(|at| Expr::int(i64::from(at))).collect();
                    Node::Element(Element { of: array(&name, &variable.sizes), at })
                }
            };
            Typed::new(node, variable.kind)
        };
        Some((variable.sizes.clone(), all_indices(&variable.sizes).into_iter().map(element).collect()))
    }

    /// Notes what holds where further text begins. Of what was `before` it, what the state does not say is not known.
    pub(in crate::siemens) fn note_stand(&mut self, before: bool) {
        let state = &self.state;
        let framed = state.in_frame.contains(&true);
        self.handed.stood = Tracker {
            modes: Modes {
                motion: match state.modes.motion.value() {
                    Some(Motion::Traverse) => Some(canon::Motion::Traverse),
                    Some(Motion::Feed) => Some(canon::Motion::Feed),
                    Some(Motion::Arc(_) | Motion::Through | Motion::Tangent | Motion::Thread(_)) | None => {
                        None
                    }
                },
                distance: state.modes.distance.value(),
                units: state.modes.units.value(),
                plane: state.modes.plane.value(),
                feed_mode: state.modes.feed_mode.value(),
                work_offset: state.modes.work_offset.value(),
                ..Modes::default()
            },
            framed,
            chained: framed,
            turned: framed,
            chain_turned: framed,
            compensated: before,
            ..Tracker::default()
        };
    }

    /// The text is over: writes the restored modes after the calls of a subprogram with SAVE.
    pub(in crate::siemens) fn give_back(&mut self, out: &mut Batch) {
        let gives = |procedure: &Procedure| procedure.attributes.contains(&Attribute::GivesBack);
        if !out.procedures.iter().any(gives) {
            return;
        }
        let mut entry = std::mem::take(&mut self.handed.stood);
        entry.modes = entry.modes.or(out.assumed);
        let mut procedures = vec![Procedure { body: std::mem::take(&mut out.stmts), ..Procedure::default() }];
        procedures.append(&mut out.procedures);
        let mut program = Program { procedures, ..Program::default() };
        restored_modes::run(&mut program, &entry, "SAVE", &mut out.diagnostics);
        out.stmts = program.procedures.remove(0).body;
        out.procedures = program.procedures;
    }

    /// The text is over: each call gets the values that its subprogram takes.
    pub(in crate::siemens) fn hand_over(&mut self, out: &mut Batch) {
        let handed = std::mem::take(&mut self.handed);
        if handed.parameters.is_empty() && handed.calls.iter().all(|call| call.given.is_empty()) {
            return;
        }
        let mut ready: Vec<Ready> = Vec::new();
        for call in handed.calls {
            let takes = handed.parameters.iter().find(|(name, _)| *name == call.name);
            let takes = takes.map_or(&[][..], |(_, takes)| takes);
            if call.given.len() > takes.len() {
                // One that is not in the text is reported as that.
                if !self.repeated_blocks.has_met(&call.name) {
                    continue;
                }
                let what = CallUnsupported::MoreArguments.into();
                out.report(Fault::NotSupported { code: call.name, what }, call.at);
                continue;
            }
            let mut given = call.given.into_iter();
            let mut arguments = Vec::with_capacity(takes.len());
            let mut back: Vec<(Target, Var)> = Vec::new();
            for parameter in takes {
                let value = given.next().flatten();
                let refuse = |what: CallUnsupported, out: &mut Batch| {
                    out.report(Fault::not_supported("VAR", what), call.at);
                };
                let Some(reference) = &parameter.reference else {
                    arguments.push(match value {
                        None => parameter.otherwise.clone(),
                        Some(Argument::One(value)) => {
                            self.converted(value, parameter.kind, call.at, out).unwrap_or(Expr::int(0))
                        }
                        Some(Argument::Array(..)) => {
                            let what = CallUnsupported::ArrayToOne.into();
                            out.report(Fault::NotSupported { code: call.name.clone(), what }, call.at);
                            Expr::int(0)
                        }
                    });
                    continue;
                };
                if call.modal {
                    refuse(CallUnsupported::VarInModal, out);
                }
                let (sizes, values) = match value {
                    Some(Argument::One(value)) => (Box::default(), vec![value]),
                    Some(Argument::Array(sizes, values)) => (sizes, values),
                    None => (Box::default(), Vec::new()),
                };
                let places: Vec<Var> = match parameter.sizes.is_empty() {
                    true => vec![reference.clone()],
                    false => {
                        all_indices(&parameter.sizes).iter().map(|at| element_of(reference, at)).collect()
                    }
                };
                let targets: Option<Vec<Target>> = values
                    .iter()
                    .map(|value| Some(value).filter(|value| value.kind == parameter.kind).and_then(variable))
                    .collect();
                let targets = targets.filter(|all| sizes == parameter.sizes && all.len() == places.len());
                match targets {
                    Some(all) if all.iter().any(|var| back.iter().any(|(other, _)| other == var)) => {
                        refuse(CallUnsupported::VarTwice, out);
                    }
                    Some(all) => back.extend(all.into_iter().zip(places.iter().cloned())),
                    None if parameter.sizes.is_empty() => {
                        refuse(CallUnsupported::VarType, out);
                    }
                    None => refuse(CallUnsupported::VarArray, out),
                }
                let mut values = values.into_iter();
                arguments
                    .extend(places.iter().map(|_| values.next().map_or(Expr::int(0), |value| value.expr)));
            }
            if let Some(what) = refused(&call.name, &back, out) {
                out.report(Fault::not_supported("VAR", what), call.at);
            }
            ready.push(Ready { at: call.at, arguments, back });
        }
        let Batch { stmts, procedures, diagnostics: diags, .. } = out;
        give(stmts, &ready, diags);
        procedures.iter_mut().for_each(|Procedure { body, .. }| give(body, &ready, diags));
    }
}

/// The variable that an argument is, or the element of an array by its own number.
fn variable(value: &Typed) -> Option<Target> {
    let Expr::Node(node) = &value.expr else { return None };
    match &**node {
        Node::Var(var @ (Var::Local(_) | Var::Common(_))) => Some(Target::Var(var.clone())),
        Node::Element(element)
            if matches!(element.of, Many::Array { .. })
                && element.at.iter().all(|at| at.literal().is_some()) =>
        {
            Some(Target::Element(Box::new(element.clone())))
        }
        _ => None,
    }
}

/// Why a call cannot give its caller's own variables; `None` if it can.
fn refused(name: &Text, back: &[(Target, Var)], out: &Batch) -> Option<CallUnsupported> {
    if back.is_empty() {
        return None;
    }
    // All that runs in it.
    let mut within = BTreeSet::new();
    let mut open = vec![name];
    while let Some(next) = open.pop() {
        for procedure in out.procedures.iter().filter(|procedure| procedure.name == *next) {
            each(&procedure.body, &mut |stmt| {
                if let Op::Call(call) = &stmt.op
                    && within.insert(&call.name)
                {
                    open.push(&call.name);
                }
            });
        }
    }
    if within.contains(name) {
        return Some(CallUnsupported::VarRecursive);
    }
    let mut found = false;
    for procedure in out.procedures.iter().filter(|p| p.name == *name || within.contains(&p.name)) {
        let mut one = |name: &str| {
            let is_it = |own: &Target| matches!(own, Target::Var(Var::Common(own)) if may_be_one(own, name));
            found |= back.iter().any(|(own, _)| is_it(own));
        };
        each(&procedure.body, &mut |stmt| match &stmt.op {
            Op::Assign(Target::Var(var), _) => one(&var.name()),
            Op::Assign(Target::Element(element), _) => one(&several(&element.of)),
            Op::Control(control) => {
                if let Control::For { variable, .. } = &**control {
                    one(&variable.name());
                }
            }
            _ => {}
        });
        let mut body = procedure.body.clone();
        ncc_passes::values::variables::expressions(&mut body, &mut |_, value| reads(value, &mut one));
    }
    found.then_some(CallUnsupported::VarUsed)
}

/// Shows every statement.
fn each<'b>(body: &'b [Stmt], seen: &mut dyn FnMut(&'b Stmt)) {
    for stmt in body {
        seen(stmt);
        if let Op::Control(control) = &stmt.op {
            control.bodies().for_each(|body| each(body, seen));
        }
    }
}

fn give(body: &mut Vec<Stmt>, ready: &[Ready], diags: &mut Vec<Diagnostic>) {
    let mut at = 0;
    while at < body.len() {
        let stmt = &mut body[at];
        at += 1;
        match &mut stmt.op {
            Op::Call(call) => {
                let Some(Ready { arguments, back, .. }) = ready.iter().find(|ready| ready.at == stmt.span)
                else {
                    continue;
                };
                call.arguments.clone_from(arguments);
                if !back.is_empty() && call.times > 1 {
                    let what = CallUnsupported::VarRepeated.into();
                    diags.push(Diagnostic::new(Fault::NotSupported { code: "VAR".into(), what }, stmt.span));
                }
                for (var, kept) in back {
                    let value = Expr::Node(Box::new(Node::Var(kept.clone())));
                    let was = &mut body[at - 1];
                    let mut stmt = Stmt::new(was.span, Op::Assign(var.clone(), value));
                    (stmt.joined, stmt.skip, stmt.comment) = (true, was.skip, was.comment.take());
                    body.insert(at, stmt);
                    at += 1;
                }
            }
            Op::Control(control) => control.bodies_mut().for_each(|body| give(body, ready, diags)),
            _ => {}
        }
    }
}
