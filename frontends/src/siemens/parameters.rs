//! Parameters of subprograms, and what calls hand over to them.
//!
//! A subprogram stands behind its calls, as a rule: what its parameters are is put into the calls when the text has
//! been read. A value is converted as for an assignment; one that is left out is the parameter's own, or 0.
//!
//! Refused by name: the caller's variables themselves (`VAR`), arrays and texts.

use ncc_ir::diag::Fault;
use ncc_ir::expr::{Expr, Node};
use ncc_ir::program::{Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;

use super::computing::stored;
use super::formula::{Kind, Typed};
use super::lower::Lower;
use super::tree::{Expr as Tree, Parameter, Value};
use crate::Batch;
use crate::word::Source;

/// What is known of calls with arguments and of parameters.
#[derive(Debug, Default)]
pub(super) struct Handed {
    calls: Vec<Call>,
    parameters: Vec<(Text, Vec<Taken>)>,
}

/// A call with arguments, by its place.
#[derive(Debug)]
struct Call {
    name: Text,
    at: Span,
    /// What is handed over; `None` where nothing is.
    given: Vec<Option<Typed>>,
}

/// A parameter: its type, and its value where a call has none.
#[derive(Clone, Debug)]
struct Taken {
    kind: Kind,
    otherwise: Expr,
}

impl Lower {
    /// The parameters of the subprogram that is being read.
    pub(super) fn parameters(&mut self, all: &[Parameter], span: Span, src: Source, out: &mut Batch) {
        if all.is_empty() {
            return;
        }
        out.whole = true;
        let mut taken = Vec::with_capacity(all.len());
        let mut vars = Vec::with_capacity(all.len());
        for parameter in all {
            let Some(declared) = &parameter.name else { continue };
            let at = declared.place.span;
            if parameter.by_reference {
                self.not_supported("VAR", "parameter that is the caller's variable itself", at, out);
            }
            let Some(kind) = self.kind_of(parameter.kind.name, at, src, out) else { continue };
            if kind == Kind::Text || !declared.place.index.is_empty() {
                self.not_supported(&src.text(at), "array or text as a parameter", at, out);
                continue;
            }
            let otherwise = match &declared.initial {
                None => Some(Expr::int(0)),
                Some(Value::Expr(value @ Tree::Number(..))) => {
                    let typed = self.formula(value, src, out);
                    typed.and_then(|typed| self.converted(typed, kind, at, out))
                }
                Some(_) => {
                    self.not_supported(&src.text(at), "first value in another form", at, out);
                    None
                }
            };
            let (Some(var), Some(otherwise)) = (self.new_scalar(&declared.place, kind, src, out), otherwise)
            else {
                continue;
            };
            vars.push(var);
            taken.push(Taken { kind, otherwise });
        }
        match &mut self.sub {
            Some(procedure) => {
                procedure.kinds = taken.iter().map(|taken| stored(taken.kind)).collect();
                procedure.parameters = vars;
                self.handed.parameters.push((procedure.name.clone(), taken));
            }
            None => self.not_supported("PROC", "main program with parameters", span, out),
        }
    }

    /// What a call hands over, as far as it is known; `None` if it is refused (reported).
    pub(super) fn handed_over(
        &mut self,
        name: &str,
        given: &[Option<Tree>],
        at: Span,
        src: Source,
        out: &mut Batch,
    ) -> Option<Vec<Expr>> {
        if given.is_empty() {
            self.handed.calls.push(Call { name: name.into(), at, given: Vec::new() });
            return Some(Vec::new());
        }
        let mut all = Vec::with_capacity(given.len());
        for argument in given {
            all.push(match argument {
                None => None,
                Some(argument) => Some(self.formula(argument, src, out)?),
            });
        }
        let nothing = || Expr::Node(Box::new(Node::Vacant));
        let arguments = all.iter().map(|a| a.as_ref().map_or_else(nothing, |a| a.expr.clone())).collect();
        self.handed.calls.push(Call { name: name.into(), at, given: all });
        Some(arguments)
    }

    /// The text is over: each call gets the values that its subprogram takes.
    pub(super) fn hand_over(&mut self, out: &mut Batch) {
        let handed = std::mem::take(&mut self.handed);
        if handed.parameters.is_empty() && handed.calls.iter().all(|call| call.given.is_empty()) {
            return;
        }
        let mut ready: Vec<(Span, Vec<Expr>)> = Vec::new();
        for call in handed.calls {
            let takes = handed.parameters.iter().find(|(name, _)| *name == call.name);
            let takes = takes.map_or(&[][..], |(_, takes)| takes);
            if call.given.len() > takes.len() {
                // One that is not in the text is told as that.
                if !self.again.has_met(&call.name) {
                    continue;
                }
                let name = "call with more arguments than its subprogram has parameters".into();
                out.report(Fault::NotSupported { code: call.name, name }, call.at);
                continue;
            }
            let mut given = call.given.into_iter();
            let mut arguments = Vec::with_capacity(takes.len());
            for parameter in takes {
                let value = given.next().flatten();
                arguments.push(match value {
                    None => parameter.otherwise.clone(),
                    Some(value) => {
                        self.converted(value, parameter.kind, call.at, out).unwrap_or(Expr::int(0))
                    }
                });
            }
            ready.push((call.at, arguments));
        }
        let Batch { stmts, procedures, .. } = out;
        give(stmts, &ready);
        procedures.iter_mut().for_each(|Procedure { body, .. }| give(body, &ready));
    }
}

fn give(body: &mut [Stmt], ready: &[(Span, Vec<Expr>)]) {
    for stmt in body {
        match &mut stmt.op {
            Op::Call(call) => {
                if let Some((_, arguments)) = ready.iter().find(|(at, _)| *at == stmt.span) {
                    call.arguments.clone_from(arguments);
                }
            }
            Op::Control(control) => control.bodies_mut().for_each(|body| give(body, ready)),
            _ => {}
        }
    }
}
