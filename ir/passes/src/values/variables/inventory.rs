//! Which variables a program has, in the order of its text; and results of subprograms that nobody reads.

use std::collections::{BTreeSet, HashMap, HashSet};

use crate::values::variables::each_value;
use ncc_ir::computed::computes::Computes;
use ncc_ir::expr::{Binary, Element, Expr, Many, Node, Numbers, Target, Var};
use ncc_ir::program::{Control, Op, Program, Stmt, Text};
use ncc_ir::source::Span;

/// A variable of a procedure, or an array.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub(super) var: Var,
    /// How many elements, of an array.
    pub(super) elements: Option<u32>,
    pub(super) at: Span,
}

/// What a body reads and gives values, in the order of the text.
#[derive(Default)]
pub(super) struct Inventory {
    pub(super) seen: Vec<Seen>,
    /// Where each variable stands in `seen`.
    places: HashMap<Var, usize>,
    /// Names of common variables that are read.
    read: BTreeSet<Text>,
    /// Variables whose number is computed.
    pub(super) numbered: Vec<(Numbers, Span)>,
    /// Variables that the program makes known.
    pub(super) declared: BTreeSet<Text>,
}

impl Inventory {
    pub(super) fn body(&mut self, body: &[Stmt]) {
        for stmt in body {
            let at = stmt.span;
            match &stmt.op {
                Op::Assign(to, value) => {
                    self.expr(value, at);
                    match to {
                        Target::Var(var) => self.var(var, None, at),
                        Target::Element(element) => self.element(element, at),
                    }
                }
                Op::Declare(declare) => {
                    declare.initial.iter().flatten().for_each(|value| self.expr(value, at));
                    let many = declare.sizes.iter().product();
                    self.var(&declare.var, (!declare.sizes.is_empty()).then_some(many), at);
                    self.declared.insert(declare.var.name().as_ref().into());
                }
                Op::Control(control) => {
                    if let Control::For { variable, .. } = &**control {
                        self.var(variable, None, at);
                    }
                    match &**control {
                        Control::Repeat { times: value, .. }
                        | Control::While { condition: value, .. }
                        | Control::Until { condition: value, .. }
                        | Control::If { condition: value, .. } => self.expr(value, at),
                        Control::For { from, to, step, .. } => {
                            [from, to, step].into_iter().for_each(|value| self.expr(value, at));
                        }
                        Control::Loop { .. } => {}
                    }
                    control.bodies().for_each(|body| self.body(body));
                }
                Op::Call(call) => call.arguments.iter().for_each(|value| self.expr(value, at)),
                op => each_value(&mut op.clone(), &mut |value, _| self.expr(value, at)),
            }
        }
    }

    fn var(&mut self, var: &Var, elements: Option<u32>, at: Span) {
        match self.places.get(var) {
            Some(place) => self.seen[*place].elements = self.seen[*place].elements.or(elements),
            None => {
                self.places.insert(var.clone(), self.seen.len());
                self.seen.push(Seen { var: var.clone(), elements, at });
            }
        }
    }

    fn element(&mut self, element: &Element, at: Span) {
        match &element.of {
            Many::Array { var, sizes } => self.var(var, Some(sizes.iter().product()), at),
            Many::Numbered(rows) => self.numbered.extend(rows.iter().map(|row| (row.clone(), at))),
        }
        element.at.iter().for_each(|index| self.expr(index, at));
    }

    fn expr(&mut self, e: &Expr, at: Span) {
        let Expr::Node(node) = e else { return };
        match &**node {
            Node::Var(var) => {
                if let Var::Common(name) = var {
                    self.read.insert(name.clone());
                }
                self.var(var, None, at);
            }
            Node::Element(element) => self.element(element, at),
            Node::Vacant | Node::Unary(..) | Node::Binary(..) | Node::Call(..) => {
                e.parts().for_each(|part| self.expr(part, at));
            }
        }
    }
}

/// What a subprogram leaves as its result is left out where nothing reads it, and the target has no such name.
pub(super) fn leave_out_results(program: &mut Program, from: &Computes, computes: &Computes) {
    let mut read = BTreeSet::new();
    let mut all = Vec::new();
    for procedure in &program.procedures {
        let mut inventory = Inventory::default();
        inventory.body(&procedure.body);
        read.extend(inventory.read);
        all.extend(inventory.seen);
    }
    let unread: HashSet<Var> = all
        .into_iter()
        .map(|seen| seen.var)
        .filter(|var| matches!(var, Var::Common(name) if !read.contains(&**name)))
        // What has a number, other programs may read.
        .filter(|var| number_of(var, from).is_none())
        .filter(|var| !computes.says(var))
        .collect();
    if unread.is_empty() {
        return;
    }
    let drop = |op: &Op| match op {
        Op::Assign(Target::Var(var), value) => unread.contains(var) && always_has_a_value(value),
        _ => false,
    };
    program.procedures.iter_mut().for_each(|procedure| leave_out(&mut procedure.body, &drop));
}

fn always_has_a_value(e: &Expr) -> bool {
    let Expr::Node(node) = e else { return true };
    match &**node {
        Node::Var(Var::Local(_)) | Node::Vacant => true,
        Node::Unary(_, a) => always_has_a_value(a),
        Node::Binary(Binary::Add | Binary::Subtract | Binary::Multiply, a, b) => {
            always_has_a_value(a) && always_has_a_value(b)
        }
        Node::Var(_) | Node::Element(_) | Node::Binary(..) | Node::Call(..) => false,
    }
}

fn leave_out(body: &mut Vec<Stmt>, drop: &dyn Fn(&Op) -> bool) {
    let mut out = Vec::with_capacity(body.len());
    let mut first: Option<Option<u32>> = None;
    for mut stmt in std::mem::take(body) {
        if let Some(number) = first.take()
            && stmt.joined
        {
            (stmt.joined, stmt.number) = (false, number);
        }
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| leave_out(body, drop));
        }
        if !drop(&stmt.op) {
            out.push(stmt);
            continue;
        }
        if !stmt.joined {
            first = Some(stmt.number);
        }
        if let Some(comment) = stmt.comment {
            match out.last_mut() {
                Some(last) if stmt.joined && last.comment.is_none() => last.comment = Some(comment),
                _ => out.push(Stmt::new(stmt.span, Op::Comment(*comment))),
            }
        }
    }
    *body = out;
}

/// The number of a variable by the names of its control.
pub(super) fn number_of(var: &Var, computes: &Computes) -> Option<u32> {
    let name = var.name();
    let digits = name.strip_prefix(&*computes.prefix)?;
    digits.parse().ok().filter(|n: &u32| n.to_string() == digits)
}
