//! Circles and lines of holes of which numbers are computed when the program runs become their positions, each as what
//! it is computed from, for a target without them.
//!
//! A pattern stays as it is that is a grid or a list, a circle by its first hole, that does not say from program zero
//! where it is, or that stands in a program with several planes: it is refused where it cannot be written.

use ncc_ir::canon::{Axis, Distance, Fact, Plane};
use ncc_ir::caps::Caps;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, Num, ONE};
use ncc_ir::expr::{Binary, Expr, Function, Node, Unary};
use ncc_ir::program::arguments;
use ncc_ir::program::cycle::{First, Pattern, absolute};
use ncc_ir::program::{Coord, Move, Op, Point, Program, Stmt};

use crate::holes::pattern_forms;
use crate::pass::Pass;
use crate::support::write::rebuild;

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "computed-holes",
    "writes circles and lines of holes whose sizes are computed by their positions",
    |_, _| true,
    |program, own, found| run(program, own.caps, found),
);

/// Degrees of a quarter turn, in nanos.
const QUARTER: Nanos = 90 * ONE;

/// Says the patterns of a program that computes by their positions, where the target lacks them.
pub fn run(program: &mut Program, caps: &Caps, diags: &mut Vec<Diagnostic>) {
    let mut planes = Vec::from_iter(program.assumed.plane);
    program.procedures.iter().for_each(|procedure| planes_of(&procedure.body, &mut planes));
    let [plane] = planes[..] else { return };
    program
        .procedures
        .iter_mut()
        .for_each(|procedure| expand_computed_holes(&mut procedure.body, plane, caps, diags));
}

/// The planes that a body says, each once.
fn planes_of(body: &[Stmt], planes: &mut Vec<Plane>) {
    for stmt in body {
        let said = match &stmt.op {
            Op::SelectPlane(plane) => Some(*plane),
            Op::StartCycle(cycle) => cycle.plane.known(),
            Op::Control(control) => {
                control.bodies().for_each(|body| planes_of(body, planes));
                None
            }
            _ => None,
        };
        planes.extend(said.filter(|plane| !planes.contains(plane)));
    }
}

fn expand_computed_holes(body: &mut Vec<Stmt>, plane: Plane, caps: &Caps, diags: &mut Vec<Diagnostic>) {
    rebuild(body, |mut stmt, made| {
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| expand_computed_holes(body, plane, caps, diags));
        }
        let holes = match &stmt.op {
            op @ Op::Pattern(pattern)
                if arguments::computed(op) && !pattern_forms::says_computed(pattern, plane, caps) =>
            {
                holes(pattern, plane)
            }
            _ => None,
        };
        let Some(holes) = holes else { return made.push(stmt) };
        let fault = Fault::PatternExpanded { holes: u32::try_from(holes.len()).unwrap_or(u32::MAX) };
        diags.push(Diagnostic::new(fault, stmt.span));
        made.replace(stmt, holes.into_iter().map(|to| (false, Op::Hole(Move { to, said: false }))));
    });
}

/// The positions of a pattern in a plane.
fn holes(pattern: &Pattern, plane: Plane) -> Option<Vec<Point>> {
    let (first, second, _) = plane.axes();
    let place: Box<dyn Fn(u32) -> [Expr; 2]>;
    let (start, count) = match pattern {
        Pattern::Circle { centre, first: First::Polar { radius, angle }, step, count } => {
            place = Box::new(move |k| [radius.clone(), sum(angle, times(step, k))]);
            (centre.as_ref()?, *count)
        }
        Pattern::Line { start, angle, offset, pitch, count } => {
            place = Box::new(move |k| [sum(offset, times(pitch, k)), angle.clone()]);
            (start.as_ref()?, *count)
        }
        Pattern::Circle { .. } | Pattern::List(_) | Pattern::Grid { .. } => return None,
    };
    if start.iter().any(|word| word.distance != Fact::Known(Distance::Absolute)) {
        return None;
    }
    let hole = |k| {
        let [way, angle] = place(k);
        let mut to = Point::default();
        let axes: [(Axis, Function); 2] = [(first, Function::Cos), (second, Function::Sin)];
        for ((axis, function), from) in axes.into_iter().zip(start) {
            to.set(axis, coord(from, along(&way, &angle, function)));
        }
        to
    };
    Some((0..count).map(hole).collect())
}

fn coord(from: &Coord, way: Expr) -> Coord {
    absolute(sum(&from.value, way))
}

fn nanos(value: &Expr) -> Option<Nanos> {
    value.literal()?.nanos(false)
}

fn sum(a: &Expr, b: Expr) -> Expr {
    match (nanos(a), nanos(&b)) {
        (_, Some(0)) => return a.clone(),
        (Some(0), _) => return b,
        _ => {}
    }
    match &b {
        Expr::Num(n) if n.mantissa < 0 => a.minus(&Num { mantissa: -n.mantissa, ..*n }.into()),
        Expr::Num(_) => a.plus(&b),
        Expr::Node(node) => match &**node {
            Node::Unary(Unary::Negate, less) => a.minus(less),
            _ => a.plus(&b),
        },
    }
}

fn times(step: &Expr, k: u32) -> Expr {
    match (step.literal().and_then(|n| n.times(k.into())), k) {
        (_, 0) => Expr::int(0),
        (_, 1) => step.clone(),
        (Some(n), _) => n.trimmed().into(),
        (None, _) => Expr::binary(Binary::Multiply, Expr::int(k.into()), step.operand()),
    }
}

/// A way along one axis of the plane.
fn along(way: &Expr, angle: &Expr, function: Function) -> Expr {
    let quarters = nanos(angle).filter(|a| a % QUARTER == 0).map(|a| (a / QUARTER).rem_euclid(4));
    let turned = match function {
        Function::Sin => quarters.map(|q| (q + 3) % 4),
        _ => quarters,
    };
    let way = way.operand();
    if nanos(&way) == Some(0) {
        return way;
    }
    match turned {
        Some(0) => way,
        Some(2) => match way {
            Expr::Num(n) => Expr::Num(Num { mantissa: -n.mantissa, ..n }),
            Expr::Node(_) => Expr::Node(Box::new(Node::Unary(Unary::Negate, way))),
        },
        Some(_) => Expr::int(0),
        None => {
            let turned = Expr::Node(Box::new(Node::Call(function, vec![angle.operand()])));
            Expr::binary(Binary::Multiply, way, turned)
        }
    }
}
