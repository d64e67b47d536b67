//! Programs that compute: points of two loops within each other, each with a sine and a cosine, executed, and
//! inlined and unrolled. Beside them the same points as literals.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use ncc_exec::world::World;
use ncc_exec::{Exec, Progress, Runner};
use ncc_ir::canon::{Distance, Fact, Units};
use ncc_ir::expr::{Binary, Expr, Function, Node, Var};
use ncc_ir::program::{Control, Coord, Move, Op, Procedure, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;
use ncc_passes::Target;
use ncc_passes::flow::flatten;

/// Turns of each loop.
const TURNS: i64 = 300;

fn main() {
    divan::main();
}

fn var(name: &str) -> Var {
    Var::Common(name.into())
}

fn read(name: &str) -> Expr {
    Expr::Node(Box::new(Node::Var(var(name))))
}

fn two(operator: Binary, a: Expr, b: Expr) -> Expr {
    Expr::Node(Box::new(Node::Binary(operator, a, b)))
}

fn call_node(f: Function, a: Expr) -> Expr {
    Expr::Node(Box::new(Node::Call(f, vec![a])))
}

fn stmt(op: Op) -> Stmt {
    Stmt::new(Span::default(), op)
}

fn set(name: &str, value: Expr) -> Stmt {
    stmt(Op::Assign(var(name).into(), value))
}

/// While a counter is less than `TURNS`, the body, and the counter goes up by one.
fn counted(name: &str, mut body: Vec<Stmt>) -> Stmt {
    body.push(set(name, two(Binary::Add, read(name), Expr::int(1))));
    let condition = two(Binary::Less, read(name), Expr::int(TURNS));
    stmt(Op::Control(Box::new(Control::While { condition, body })))
}

/// A point on a circle of which the radius and the angle are counted.
fn program() -> Program {
    let mut to = Move { said: true, ..Move::default() };
    for (axis, f) in [(0, Function::Cos), (1, Function::Sin)] {
        let value = two(Binary::Multiply, read("1"), call_node(f, read("2")));
        to.to.axes[axis] = Some(Coord { value, distance: Fact::Known(Distance::Absolute) });
    }
    let inner = vec![stmt(Op::StraightTraverse(to))];
    let outer = vec![set("2", Expr::int(0)), counted("2", inner)];
    let body = vec![stmt(Op::UseLengthUnits(Units::Mm)), set("1", Expr::int(0)), counted("1", outer)];
    Program { procedures: vec![Procedure { body, ..Procedure::default() }], ..Program::default() }
}

fn run(program: &Program) -> usize {
    let mut exec = Exec::new(&World::generate(1, &Default::default()), 0);
    let mut runner = Runner::new(program);
    let (mut events, mut count) = (Vec::new(), 0);
    loop {
        events.clear();
        match runner.run(&mut exec, 4096, &mut events) {
            Ok(Progress::More) => count += events.len(),
            Ok(Progress::Done) => return count + events.len(),
            Err(_) => return 0,
        }
    }
}

fn flat() -> Program {
    let mut program = program();
    let target = Target { decimals: 3, ..Target::default() };
    flatten::run(&mut program, &target, &Tracker::default(), &mut Vec::new());
    program
}

#[divan::bench]
fn executed(bencher: Bencher) {
    let program = program();
    bencher.counter(ItemsCount::new((TURNS * TURNS) as u64)).bench_local(|| run(black_box(&program)));
}

#[divan::bench]
fn executed_as_literals(bencher: Bencher) {
    let program = flat();
    bencher.counter(ItemsCount::new((TURNS * TURNS) as u64)).bench_local(|| run(black_box(&program)));
}

#[divan::bench]
fn flattened(bencher: Bencher) {
    bencher.counter(ItemsCount::new((TURNS * TURNS) as u64)).bench_local(flat);
}
