//! A law: whatever becomes of a program's loops, decisions and jumps, the machine does the same.
//!
//! Programs are generated as trees: loops of every kind in one another, with ends and paces that their bodies change,
//! words that leave them, decisions, jumps ahead out of them, labels of one name, calls that share variables. They are
//! said in the forms of targets that have much, little and nearly nothing, and executed before and after.

use fastrand::Rng;
use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::computed::computes::{ComputeFeature, Computes};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Binary, Expr, Function, Node, Unary, Var};
use ncc_ir::program::{Call, Control, Coord, Move, Op, Procedure, Program, Stmt};
use ncc_ir::source::Span;
use ncc_passes::flow::control_forms;

use super::{same_events, told, write};

/// Programs of a run.
const MANY: u64 = 1000;

const VARIABLES: [&str; 4] = ["A", "B", "C", "D"];

/// Functions that targets have or have not; they cut off all the same.
const FUNCTIONS: [Function; 4] = [Function::Min, Function::Max, Function::RoundUp, Function::Ceiling];

/// Turns of all loops after which a program ends.
const FUEL: i64 = 60;

fn value(name: &str) -> Expr {
    Expr::Node(Box::new(Node::Var(Var::Local(name.into()))))
}

fn binary(operator: Binary, a: Expr, b: Expr) -> Expr {
    Expr::Node(Box::new(Node::Binary(operator, a, b)))
}

fn assign(name: &str, value: Expr) -> Stmt {
    Stmt::new(Span::default(), Op::Assign(Var::Local(name.into()).into(), value))
}

fn control(control: Control) -> Stmt {
    Stmt::new(Span::default(), Op::Control(Box::new(control)))
}

fn goto(name: &str) -> Stmt {
    Stmt::new(Span::default(), Op::Goto(name.into()))
}

fn when(condition: Expr, then: Vec<Stmt>) -> Stmt {
    control(Control::If { condition, then, otherwise: Vec::new() })
}

struct Maker {
    dice: Rng,
    /// Loops that are open, and labels ahead.
    loops: u32,
    labels: Vec<&'static str>,
    calls: bool,
    /// Whether there are jumps back.
    back: bool,
}

impl Maker {
    fn program(seed: u64, back: bool) -> Program {
        let mut maker =
            Maker { dice: Rng::with_seed(seed), loops: 0, labels: vec!["STOP"], calls: true, back };
        let mut body = vec![Stmt::new(Span::default(), Op::SetFeedRate(Expr::Num(Num::int(100, Unit::Mm))))];
        body.push(assign("FUEL", Expr::int(FUEL)));
        for name in VARIABLES {
            let value = maker.literal();
            body.push(assign(name, value));
        }
        maker.body(3, &mut body);
        maker.body(3, &mut body);
        body.push(Stmt::new(Span::default(), Op::Label("STOP".into())));
        for name in VARIABLES {
            body.push(maker.to(value(name)));
        }
        body.push(Stmt::new(Span::default(), Op::ProgramEnd));
        let main = Procedure { body, ..Procedure::default() };
        let mut called = Vec::new();
        (maker.calls, maker.labels) = (false, vec!["STOP"]);
        maker.body(1, &mut called);
        called.push(Stmt::new(Span::default(), Op::Label("STOP".into())));
        called.push(Stmt::new(Span::default(), Op::Return));
        let called = Procedure { name: "CALLED".into(), body: called, ..Procedure::default() };
        Program { procedures: vec![main, called], ..Program::default() }
    }

    fn literal(&mut self) -> Expr {
        let mut n = Num::int(self.dice.i64(-8..12), Unit::One);
        if self.dice.u8(..4) == 0 {
            n.scale = 1;
        }
        Expr::Num(n)
    }

    fn number(&mut self, depth: u32) -> Expr {
        match self.dice.u8(..8) {
            0 | 1 => value(VARIABLES[self.dice.usize(..4)]),
            2 if depth > 0 => {
                let operator = [Binary::Add, Binary::Subtract, Binary::Multiply][self.dice.usize(..3)];
                binary(operator, self.number(depth - 1), self.number(depth - 1))
            }
            3 if depth > 0 => Expr::Node(Box::new(Node::Unary(Unary::Negate, self.number(depth - 1)))),
            6 if depth > 0 => {
                let function = FUNCTIONS[self.dice.usize(..FUNCTIONS.len())];
                let both = matches!(function, Function::Min | Function::Max);
                let arguments = (0..=usize::from(both)).map(|_| self.number(depth - 1)).collect();
                Expr::Node(Box::new(Node::Call(function, arguments)))
            }
            7 if depth > 0 => {
                let power = Expr::int(self.dice.i64(0..4));
                match self.dice.bool() {
                    true => binary(Binary::Power, self.number(depth - 1), power),
                    false => self.condition(0),
                }
            }
            _ => self.literal(),
        }
    }

    fn condition(&mut self, depth: u32) -> Expr {
        let both = [Binary::And, Binary::Or, Binary::Xor][self.dice.usize(..3)];
        let comparison = [
            Binary::Equal,
            Binary::NotEqual,
            Binary::Less,
            Binary::LessOrEqual,
            Binary::Greater,
            Binary::GreaterOrEqual,
        ][self.dice.usize(..6)];
        match self.dice.u8(..8) {
            0 | 1 if depth > 0 => binary(both, self.condition(depth - 1), self.condition(depth - 1)),
            2 if depth > 0 => Expr::Node(Box::new(Node::Unary(Unary::Not, self.condition(depth - 1)))),
            3 => self.number(1),
            4 if depth > 1 => self.literal(),
            _ => binary(comparison, self.number(1), self.number(1)),
        }
    }

    fn to(&mut self, to: Expr) -> Stmt {
        let axis = [Axis::X, Axis::Y, Axis::Z][self.dice.usize(..3)];
        let mut m = Move { said: true, ..Move::default() };
        // Small enough to be told apart, and to be written.
        let value = binary(Binary::Modulo, to, Expr::int(1000));
        m.to.set(axis, Coord { value, distance: Fact::Known(Distance::Absolute) });
        Stmt::new(Span::default(), Op::StraightFeed(m))
    }

    fn body(&mut self, depth: u32, out: &mut Vec<Stmt>) {
        for _ in 0..self.dice.u32(1..5) {
            self.statement(depth, out);
        }
    }

    fn block(&mut self, depth: u32) -> Vec<Stmt> {
        let mut out = Vec::new();
        // Not every block has a statement.
        if self.dice.u8(..10) > 0 {
            self.body(depth, &mut out);
        }
        out
    }

    /// The body of a loop, which ends the program at last.
    fn turns(&mut self, depth: u32) -> Vec<Stmt> {
        let less = binary(Binary::Subtract, value("FUEL"), Expr::int(1));
        let over = binary(Binary::Less, value("FUEL"), Expr::int(0));
        let mut out = vec![assign("FUEL", less), when(over, vec![goto("STOP")])];
        self.loops += 1;
        out.append(&mut self.block(depth));
        self.loops -= 1;
        out
    }

    fn statement(&mut self, depth: u32, out: &mut Vec<Stmt>) {
        let name = VARIABLES[self.dice.usize(..4)];
        let deeper = depth.saturating_sub(1);
        match self.dice.u8(..18) {
            0..3 => {
                let value = binary(Binary::Modulo, self.number(2), Expr::int(50));
                out.push(assign(name, value));
            }
            3..6 => {
                let to = self.number(1);
                out.push(self.to(to));
            }
            6 if self.loops > 0 => {
                let op = if self.dice.bool() { Op::Leave } else { Op::NextTurn };
                let condition = self.condition(1);
                out.push(when(condition, vec![Stmt::new(Span::default(), op)]));
            }
            7 => {
                let (condition, name) =
                    (self.condition(1), self.labels[self.dice.usize(..self.labels.len())]);
                out.push(when(condition, vec![goto(name)]));
            }
            8 if self.calls => {
                let call = Call { name: "CALLED".into(), times: 1, arguments: Vec::new(), shared: true };
                out.push(Stmt::new(Span::default(), Op::Call(Box::new(call))));
            }
            9 if depth > 0 => {
                // A label ahead, of a name that others have too.
                let label = ["L1", "L2"][self.dice.usize(..2)];
                self.labels.push(label);
                self.body(deeper, out);
                self.labels.pop();
                out.push(Stmt::new(Span::default(), Op::Label(label.into())));
            }
            16 if depth > 0 && self.back => {
                // Gone back to, and perhaps come into from before.
                if self.dice.u8(..3) == 0 {
                    let condition = self.condition(1);
                    out.push(when(condition, vec![goto("M1")]));
                }
                let label = ["B1", "B2"][self.dice.usize(..2)];
                out.push(Stmt::new(Span::default(), Op::Label(label.into())));
                let less = binary(Binary::Subtract, value("FUEL"), Expr::int(1));
                let over = binary(Binary::Less, value("FUEL"), Expr::int(0));
                out.extend([assign("FUEL", less), when(over, vec![goto("STOP")])]);
                self.labels.push(label);
                self.body(deeper, out);
                out.push(Stmt::new(Span::default(), Op::Label("M1".into())));
                self.body(deeper, out);
                self.labels.pop();
                let condition = self.condition(1);
                out.push(when(condition, vec![goto(label)]));
            }
            10 | 11 if depth > 0 => {
                let condition = self.condition(2);
                let then = self.block(deeper);
                let otherwise = if self.dice.bool() { self.block(deeper) } else { Vec::new() };
                out.push(control(Control::If { condition, then, otherwise }));
            }
            12 if depth > 0 => {
                let condition = self.condition(1);
                let body = self.turns(deeper);
                out.push(control(Control::While { condition, body }));
            }
            13 if depth > 0 => {
                let body = self.turns(deeper);
                let condition = self.condition(1);
                out.push(match self.dice.bool() {
                    true => control(Control::Until { condition, body }),
                    false => control(Control::Loop { body }),
                });
            }
            14 if depth > 0 => {
                let [from, to] = [self.number(1), self.number(1)];
                let step = if self.dice.bool() { Expr::int(1) } else { self.number(1) };
                let body = self.turns(deeper);
                let variable = Var::Local(name.into());
                out.push(control(Control::For { variable, from, to, step, body }));
            }
            15 if depth > 0 => {
                let times = match self.dice.bool() {
                    true => Expr::int(self.dice.i64(0..4)),
                    false => binary(Binary::Multiply, self.condition(0), Expr::int(3)),
                };
                let body = self.turns(deeper);
                out.push(control(Control::Repeat { times, body }));
            }
            _ => {
                let to = self.number(2);
                out.push(self.to(to));
            }
        }
    }
}

/// A target that has some of it, and jumps.
fn target(dice: &mut Rng) -> Computes {
    let all = [
        ComputeFeature::Endless,
        ComputeFeature::Until,
        ComputeFeature::Count,
        ComputeFeature::Times,
        ComputeFeature::Leave,
        ComputeFeature::NextTurn,
    ];
    if dice.u8(..3) == 0 {
        // As RS274/NGC: words that leave a loop, and no jumps.
        let statements = vec![
            ComputeFeature::Until,
            ComputeFeature::Times,
            ComputeFeature::Leave,
            ComputeFeature::NextTurn,
        ];
        return Computes { statements, blocks: true, loops: u8::MAX, ..Computes::default() };
    }
    let statements = all.into_iter().filter(|_| dice.bool()).chain([ComputeFeature::Jump]).collect();
    Computes {
        statements,
        functions: FUNCTIONS.into_iter().filter(|_| dice.bool()).chain([Function::Truncate]).collect(),
        opposite: dice.bool(),
        blocks: dice.bool(),
        loops: dice.u8(..4),
        ..Computes::default()
    }
}

/// What the target has not, nothing is left of.
fn is_left(body: &[Stmt], computes: &Computes, open: u8) -> Option<&'static str> {
    body.iter().find_map(|stmt| match &stmt.op {
        Op::Goto(_) if !computes.has(ComputeFeature::Jump) => Some("GOTO"),
        Op::Leave if !computes.has(ComputeFeature::Leave) => Some("LEAVE"),
        Op::NextTurn if !computes.has(ComputeFeature::NextTurn) => Some("NEXT_TURN"),
        Op::Control(control) => {
            let (lacking, turns) = match &**control {
                Control::Loop { .. } => (!computes.has(ComputeFeature::Endless), 1),
                Control::Until { .. } => (!computes.has(ComputeFeature::Until), 1),
                Control::For { .. } => (!computes.has(ComputeFeature::Count), 1),
                Control::Repeat { .. } => (!computes.has(ComputeFeature::Times), 1),
                Control::While { .. } => (open >= computes.loops, 1),
                Control::If { then, otherwise, .. } => {
                    let plain = matches!(&then[..], [one] if matches!(one.op, Op::Goto(_) | Op::Assign(..)));
                    (!(computes.blocks || plain && otherwise.is_empty()), 0)
                }
            };
            match lacking {
                true => Some(stmt.op.name()),
                false => control.bodies().find_map(|body| is_left(body, computes, open + turns)),
            }
        }
        _ => None,
    })
}

#[test]
fn control_in_other_forms_does_the_same() {
    let plain = told("").expect("nothing is told");
    let mut executed = 0;
    for seed in 0..MANY {
        let before = Maker::program(seed, seed.is_multiple_of(2));
        if same_events(&before, &before, &plain).is_err() {
            continue;
        }
        executed += 1;
        let mut dice = Rng::with_seed(seed ^ 0xc0de);
        let computes = target(&mut dice);
        let mut after = before.clone();
        control_forms::run(&mut after, &computes);
        let shown = || {
            let [before, after] = [&before, &after].map(|program| write(program).unwrap_or_default());
            format!("seed {seed}\n{computes:?}\n{before}\n--- becomes\n{after}")
        };
        for procedure in &after.procedures {
            if let Some(left) = is_left(&procedure.body, &computes, 0) {
                panic!("{left} is left\n{}", shown());
            }
        }
        if let Err(why) = same_events(&before, &after, &plain) {
            panic!("{why}\n{}", shown());
        }
    }
    assert!(executed > MANY / 2, "only {executed} of {MANY} can be executed");
}
