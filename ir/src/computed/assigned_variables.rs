//! Which variables blocks may change.

use std::collections::HashSet;

use crate::expr::{Expr, Node, Target, Var};
use crate::program::{Control, Op, Procedure, Stmt};

/// What blocks may change.
#[derive(Clone, Debug, Default)]
pub struct AssignedVariables {
    /// Variables that are set.
    pub variables: HashSet<Var>,
    /// Programs that are called, which may change what all see.
    pub calls: bool,
    /// Programs that see their caller's own variables.
    pub shared: bool,
    /// Variables whose number is computed.
    pub any: bool,
}

impl AssignedVariables {
    /// What the subprograms of a program may change of the variables that all see.
    pub fn by_subprograms(procedures: &[Procedure]) -> AssignedVariables {
        let mut all = AssignedVariables::default();
        procedures.iter().skip(1).for_each(|procedure| all.look(&procedure.body));
        all.variables.retain(|var| !matches!(var, Var::Local(_)));
        (all.calls, all.shared) = (false, false);
        all
    }

    /// Looks at further blocks.
    pub fn look(&mut self, body: &[Stmt]) {
        for stmt in body {
            match &stmt.op {
                Op::Assign(Target::Var(var), _) => {
                    self.variables.insert(var.clone());
                }
                Op::Assign(Target::Element(_), _) => self.any = true,
                Op::Declare(declare) => {
                    self.variables.insert(declare.var.clone());
                }
                Op::Call(call) => {
                    self.calls = true;
                    self.shared |= call.shared;
                }
                Op::Control(control) => {
                    if let Control::For { variable, .. } = &**control {
                        self.variables.insert(variable.clone());
                    }
                    control.bodies().for_each(|body| self.look(body));
                }
                _ => {}
            }
        }
    }

    /// Whether an expression has the same value before every iteration.
    pub fn keeps(&self, value: &Expr) -> bool {
        let Expr::Node(node) = value else { return true };
        match &**node {
            Node::Var(Var::System(_)) => false,
            Node::Var(var @ Var::Local(_)) => !self.any && !self.shared && !self.variables.contains(var),
            Node::Var(var) => !self.any && !self.calls && !self.variables.contains(var),
            Node::Element(_) => false,
            Node::Vacant | Node::Unary(..) | Node::Binary(..) | Node::Call(..) => {
                value.parts().all(|part| self.keeps(part))
            }
        }
    }
}
