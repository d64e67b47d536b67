//! What a target computes with other functions, and compares in another way, said with what it has.
//!
//! Comparisons to the least bit and those within a tolerance are the same of whole numbers, and become the target's
//! own there; elsewhere they stay what they are, but for those within another control's tolerance, which take the
//! target's, and that is reported. Rounding of what has no more digits anyway is left out where words do
//! not round by themselves. A function that another one is as well, but for negative numbers, becomes that where nothing
//! is negative; else it is put together, or the value assumed and reported: execution tells whether it is so.
//!
//! Not here: what a target has no way to say at all (`computes`), and variables (`variables`).

use crate::pass::Pass;
use crate::values::variables::expressions;
use ncc_ir::computed::computes::{Computes, counted};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::compared;
use ncc_ir::expr::decimals::Decimals;
use ncc_ir::expr::num::Num;
use ncc_ir::expr::{Binary, Expr, Function, Node, Unary};
use ncc_ir::program::Program;
use ncc_ir::source::Span;

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "arithmetic",
    "computes with the functions that the target has",
    |_, _| true,
    |program, own, found| run(program, own.target, own.tolerance, found),
);

/// Says what is computed with what the target has. `own` is the tolerance of the comparisons that the program's own
/// control makes, if they have one.
pub fn run(program: &mut Program, computes: &Computes, own: Option<Num>, diags: &mut Vec<Diagnostic>) {
    let mut decimals = Decimals::from_program(program);
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        decimals.within(at);
        let mut taken = Vec::new();
        expressions(&mut procedure.body, &mut |stmt, expr| {
            let mut over = Over { computes, own, decimals: &decimals, taken: None };
            over.expr(expr);
            taken.extend(over.taken.map(|assumption| (assumption, stmt.span)));
        });
        taken.into_iter().for_each(|(assumption, at)| tell(assumption, at, diags));
    }
}

/// Tells once what is assumed.
fn tell(assumption: ControlFact, at: Span, diags: &mut Vec<Diagnostic>) {
    let fault = Fault::AssumedFact { fact: assumption };
    if !diags.iter().any(|reported| reported.fault == fault) {
        diags.push(Diagnostic::new(fault, at));
    }
}

fn node(node: Node) -> Expr {
    Expr::Node(Box::new(node))
}

fn binary_node(operator: Binary, a: Expr, b: Expr) -> Expr {
    node(Node::Binary(operator, a, b))
}

fn call(function: Function, a: Expr) -> Expr {
    node(Node::Call(function, vec![a]))
}

fn is_vacant(e: &Expr) -> bool {
    matches!(e, Expr::Node(node) if **node == Node::Vacant)
}

/// A comparison that finds equal what is less than so far apart.
fn within(operator: Binary, a: Expr, b: Expr, tolerance: Num) -> Expr {
    let below = Num { mantissa: -tolerance.mantissa, ..tolerance };
    let apart = binary_node(Binary::Subtract, a, b);
    match operator {
        Binary::Equal => binary_node(Binary::Less, call(Function::Abs, apart), Expr::Num(tolerance)),
        Binary::NotEqual => {
            binary_node(Binary::GreaterOrEqual, call(Function::Abs, apart), Expr::Num(tolerance))
        }
        Binary::LessOrEqual => binary_node(Binary::Less, apart, Expr::Num(tolerance)),
        _ => binary_node(Binary::Greater, apart, Expr::Num(below)),
    }
}

struct Over<'c> {
    computes: &'c Computes,
    own: Option<Num>,
    decimals: &'c Decimals,
    /// The fact of the control on which the result depends.
    taken: Option<ControlFact>,
}

impl Over<'_> {
    fn has(&self, function: Function) -> bool {
        self.computes.functions.contains(&function)
    }

    fn expr(&mut self, e: &mut Expr) {
        e.parts_mut().for_each(|part| self.expr(part));
        let Expr::Node(inner) = e else { return };
        let made = match &**inner {
            Node::Binary(operator, a, b) => self.operator(*operator, a, b),
            Node::Call(function, arguments) => self.function(*function, arguments),
            Node::Unary(Unary::Not, a) => self.other(a),
            Node::Var(_) | Node::Vacant | Node::Element(_) | Node::Unary(..) => None,
        };
        if let Some(made) = made {
            *e = made;
        }
    }

    /// The opposite of a comparison within the target's tolerance, if it is one as well.
    fn other(&self, a: &Expr) -> Option<Expr> {
        let tolerance = self.computes.equal_within?;
        let Expr::Node(node) = a else { return None };
        let Node::Binary(how, by, Expr::Num(limit)) = &**node else { return None };
        match compared(*how, by, *limit)? {
            (Binary::Equal, a, b) => Some(within(Binary::NotEqual, a.clone(), b.clone(), tolerance)),
            (Binary::NotEqual, a, b) => Some(within(Binary::Equal, a.clone(), b.clone(), tolerance)),
            _ => None,
        }
    }

    fn operator(&mut self, operator: Binary, a: &Expr, b: &Expr) -> Option<Expr> {
        // Within a tolerance already.
        let own =
            |operator, a, b: &Expr| b.literal().is_some_and(|limit| compared(operator, a, limit).is_some());
        let whole = |a, b| self.decimals.is_whole(a) && self.decimals.is_whole(b);
        match (operator, self.computes.equal_within) {
            (
                Binary::Equal | Binary::NotEqual | Binary::LessOrEqual | Binary::GreaterOrEqual,
                Some(tolerance),
            ) if !is_vacant(a) && !is_vacant(b) && !own(operator, a, b) => {
                whole(a, b).then(|| within(operator, a.clone(), b.clone(), tolerance))
            }
            (Binary::Less | Binary::Greater | Binary::GreaterOrEqual, None) => {
                let limit = b.literal()?;
                let own = self.own?;
                if (limit.mantissa.abs(), limit.scale) != (own.mantissa, own.scale) {
                    return None;
                }
                let (found, a, b) = compared(operator, a, limit)?;
                whole(a, b).then(|| binary_node(found, a.clone(), b.clone()))
            }
            (Binary::And | Binary::Or, Some(_)) => self.joined(operator, a, b),
            (Binary::Modulo, _) if !self.computes.operators.contains(&operator) => {
                if !self.has(Function::Remainder) {
                    return None;
                }
                let remainder = |a| node(Node::Call(Function::Remainder, vec![a, b.clone()]));
                Some(match self.decimals.may_be_negative(a) {
                    false => remainder(a.clone()),
                    true => {
                        let twice = binary_node(Binary::Multiply, Expr::int(2), below_zero(a));
                        let sign = binary_node(Binary::Subtract, Expr::int(1), twice);
                        binary_node(Binary::Multiply, remainder(call(Function::Abs, a.clone())), sign)
                    }
                })
            }
            (Binary::Power, _) if !self.computes.operators.contains(&operator) => {
                let times = b.literal()?.whole_number().filter(|n| (2..=4).contains(n))?;
                let simple = |node: &Node| matches!(node, Node::Var(_));
                if matches!(a, Expr::Node(node) if !simple(node)) {
                    return None;
                }
                Some((1..times).fold(a.clone(), |all, _| binary_node(Binary::Multiply, all, a.clone())))
            }
            _ => None,
        }
    }

    fn function(&mut self, function: Function, arguments: &[Expr]) -> Option<Expr> {
        if self.has(function) {
            return None;
        }
        match (function, arguments) {
            (Function::RoundTo, [a, Expr::Num(to)]) if !self.computes.rounds => {
                let to = u8::try_from(to.whole_number()?).ok()?;
                self.decimals.digits(a).filter(|digits| *digits <= to)?;
                Some(a.clone())
            }
            (Function::Near, [a, b, tolerance]) => {
                let apart = binary_node(Binary::Subtract, a.clone(), b.clone());
                let limit = tolerance.literal().filter(|n| n.mantissa > 0)?;
                let one = 10_i64.checked_pow(limit.scale.into())?;
                if self.decimals.is_whole(a) && self.decimals.is_whole(b) && limit.mantissa < one {
                    let equal = binary_node(Binary::Equal, a.clone(), b.clone());
                    return Some(match self.computes.equal_within {
                        Some(tolerance) => within(Binary::Equal, a.clone(), b.clone(), tolerance),
                        None => equal,
                    });
                }
                Some(binary_node(Binary::LessOrEqual, call(Function::Abs, apart), tolerance.clone()))
            }
            (Function::NearRatio, [a, b, _]) if !self.computes.near => {
                let tolerance = self.computes.equal_within?;
                if !self.decimals.is_whole(a) || !self.decimals.is_whole(b) {
                    self.taken.get_or_insert(ControlFact::NearerNumbers);
                }
                Some(within(Binary::Equal, a.clone(), b.clone(), tolerance))
            }
            (Function::Given, [a]) => Some(a.clone()),
            (Function::Truncate | Function::RoundUp, [a]) if self.both_ways() => {
                let (down, up) = (call(Function::Floor, a.clone()), call(Function::Ceiling, a.clone()));
                let toward_zero = function == Function::Truncate;
                let usual = if toward_zero { &down } else { &up };
                if !self.decimals.may_be_negative(a) {
                    return Some(usual.clone());
                }
                let apart = binary_node(Binary::Subtract, up.clone(), down.clone());
                let below = binary_node(Binary::Multiply, below_zero(a), apart);
                let operator = if toward_zero { Binary::Add } else { Binary::Subtract };
                Some(binary_node(operator, usual.clone(), below))
            }
            // One of them times 1 and the other times 0, to the least bit; how often a loop turns stays as it is.
            (Function::Min | Function::Max, [a, b])
                if self.computes.worth && !is_count(function, arguments) =>
            {
                let second = match function {
                    Function::Max => binary_node(Binary::Less, a.clone(), b.clone()),
                    _ => binary_node(Binary::Less, b.clone(), a.clone()),
                };
                let first = node(Node::Unary(Unary::Not, second.clone()));
                let one = binary_node(Binary::Multiply, second, b.clone());
                Some(binary_node(Binary::Add, one, binary_node(Binary::Multiply, first, a.clone())))
            }
            (Function::Floor, [a]) if self.has(Function::Truncate) => {
                self.never_negative(a, ControlFact::RoundedDown);
                Some(call(Function::Truncate, a.clone()))
            }
            (Function::Ceiling, [a]) if self.has(Function::RoundUp) => {
                self.never_negative(a, ControlFact::RoundedUp);
                Some(call(Function::RoundUp, a.clone()))
            }
            (Function::Remainder, [a, b]) => {
                self.never_negative(a, ControlFact::Divided);
                Some(binary_node(Binary::Modulo, a.clone(), b.clone()))
            }
            _ => None,
        }
    }

    /// Whether it rounds up and down, and a condition is worth 1 or 0 in an expression.
    fn both_ways(&self) -> bool {
        self.computes.worth && self.has(Function::Floor) && self.has(Function::Ceiling)
    }

    fn never_negative(&mut self, a: &Expr, assumption: ControlFact) {
        if self.decimals.may_be_negative(a) {
            self.taken.get_or_insert(assumption);
        }
    }

    /// Two conditions, one of which says whether two numbers are the same and the other which is greater, where
    /// one comparison says both.
    fn joined(&self, operator: Binary, a: &Expr, b: &Expr) -> Option<Expr> {
        let tolerance = self.computes.equal_within?;
        let (Expr::Node(first), Expr::Node(second)) = (a, b) else { return None };
        let Node::Binary(how, c, Expr::Num(limit)) = &**second else { return None };
        let (same, x, y) = compared(*how, c, *limit)?;
        let Node::Binary(greater, p, q) = &**first else { return None };
        let (greater, p, q) = match q {
            Expr::Num(limit) => compared(*greater, p, *limit).unwrap_or((*greater, p, q)),
            Expr::Node(_) => (*greater, p, q),
        };
        if (p, q) != (x, y) {
            return None;
        }
        match (operator, greater, same) {
            (Binary::Or, Binary::LessOrEqual | Binary::GreaterOrEqual, Binary::Equal) => {
                Some(within(greater, p.clone(), q.clone(), tolerance))
            }
            (Binary::And, Binary::Less | Binary::Greater, Binary::NotEqual)
                if self.decimals.is_whole(p) && self.decimals.is_whole(q) =>
            {
                Some(a.clone())
            }
            _ => None,
        }
    }
}

/// Whether it is how many times a body is executed: rounded, and not less than none.
fn is_count(function: Function, arguments: &[Expr]) -> bool {
    let whole = call_of(function, arguments);
    counted(&whole) != &whole
}

fn call_of(function: Function, arguments: &[Expr]) -> Expr {
    node(Node::Call(function, arguments.to_vec()))
}

/// 1 where something is less than zero, else 0.
fn below_zero(a: &Expr) -> Expr {
    binary_node(Binary::Less, a.clone(), Expr::int(0))
}
