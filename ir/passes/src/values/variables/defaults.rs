//! Values that a macro gives the arguments that were left out, first of all: its calls give them.
//!
//! `IF [#7 EQ #0] THEN #7 = 1.5`, or a jump over the assignment where the argument has a value. Only literals, and
//! only where every call tells by itself whether there is a value. What is in front of it may refuse the call, by an
//! alarm or a return, for want of another argument.

use std::collections::{HashMap, HashSet};

use crate::values::variables::empty_variables::may::{Known, May, calls, is_nothing, may};
use ncc_ir::expr::num::Num;
use ncc_ir::expr::{Binary, Expr, Node, Target, Var};
use ncc_ir::program::{Control, Op, Program, Stmt, Text};

/// Lets calls give these values.
pub(super) fn hand_over(program: &mut Program) {
    // Which arguments every call tells of.
    let mut reported: HashMap<Text, Vec<bool>> = HashMap::new();
    let mut shared: HashSet<Text> = HashSet::new();
    for procedure in &mut program.procedures {
        calls(&mut procedure.body, &mut |call| {
            if call.shared {
                shared.insert(call.name.clone());
            }
            let tells = |value: &Expr| is_nothing(value) || may(value, &Known::default()) == May::Number;
            let own: Vec<bool> = call.arguments.iter().map(tells).collect();
            let all = reported.entry(call.name.clone()).or_insert_with(|| own.clone());
            all.truncate(own.len());
            all.iter_mut().zip(&own).for_each(|(all, own)| *all &= own);
        });
    }
    let mut given: HashMap<Text, Vec<(usize, Num)>> = HashMap::new();
    for procedure in program.procedures.iter_mut().skip(1).filter(|p| !shared.contains(&p.name)) {
        let reported = reported.get(&procedure.name).map(Vec::as_slice).unwrap_or_default();
        let mut own: Vec<(usize, Num)> = Vec::new();
        let mut begin = 0;
        while let Some(found) = Default::at(&procedure.body, begin) {
            let place =
                procedure.parameters.iter().position(|p| matches!(p, Var::Local(own) if *own == found.name));
            let place = place.filter(|at| reported.get(*at).is_some_and(|reported| *reported));
            let Some(place) = place.filter(|place| own.iter().all(|(known, _)| known != place)) else {
                begin = found.from + found.count;
                continue;
            };
            own.push((place, found.value));
            let gone = procedure.body.drain(found.from..found.from + found.count);
            let comments = gone.filter_map(|stmt| Some(Stmt::new(stmt.span, Op::Comment(*stmt.comment?))));
            let comments: Vec<Stmt> = comments.collect();
            begin = found.from + comments.len();
            procedure.body.splice(found.from..found.from, comments);
        }
        if !own.is_empty() {
            given.insert(procedure.name.clone(), own);
        }
    }
    for procedure in &mut program.procedures {
        calls(&mut procedure.body, &mut |call| {
            for (place, value) in given.get(&call.name).into_iter().flatten() {
                if let Some(argument) = call.arguments.get_mut(*place).filter(|value| is_nothing(value)) {
                    *argument = Expr::Num(*value);
                }
            }
        });
    }
}

/// The value that a local variable is given where it has none, and the statements that say so.
struct Default {
    name: Text,
    value: Num,
    from: usize,
    count: usize,
}

impl Default {
    /// The next one of a body, after nothing but others and refusals.
    fn at(body: &[Stmt], begin: usize) -> Option<Default> {
        let idle = |stmt: &Stmt| match &stmt.op {
            Op::Comment(_) | Op::Blank => true,
            Op::Label(name) => !jumps_to(body, name),
            _ => false,
        };
        let from = begin
            + body.get(begin..)?.iter().position(|stmt| !idle(stmt) && refusal(stmt, body).is_none())?;
        let (name, value, count) = given(&body[from..])?;
        // There the argument that is refused for is looked at, and no other.
        let own = Target::Var(Var::Local(name.clone()));
        if body[..from].iter().filter_map(|stmt| refusal(stmt, body)).any(|asks| asks.reads(&own)) {
            return None;
        }
        Some(Default { name: name.clone(), value, from, count })
    }
}

/// The local variable that the first statements give a literal where it has no value.
pub(super) fn given_at(stmts: &[Stmt]) -> Option<(&Text, Num)> {
    given(stmts).map(|(name, value, _)| (name, value))
}

/// The same, and how many statements say so.
fn given(stmts: &[Stmt]) -> Option<(&Text, Num, usize)> {
    let first = stmts.first()?;
    let Op::Control(control) = &first.op else { return None };
    let Control::If { condition: Expr::Node(condition), then, otherwise } = &**control else {
        return None;
    };
    let Node::Binary(operator, Expr::Node(a), b) = &**condition else { return None };
    let Node::Var(Var::Local(name)) = &**a else { return None };
    if !is_nothing(b) || !otherwise.is_empty() || first.skip.is_some() {
        return None;
    }
    let assigned = |stmt: &Stmt| match &stmt.op {
        Op::Assign(Target::Var(Var::Local(own)), Expr::Num(n)) if own == name => {
            (stmt.skip.is_none()).then_some(*n)
        }
        _ => None,
    };
    match (operator, &then[..]) {
        (Binary::Equal, [only]) => Some((name, assigned(only)?, 1)),
        (Binary::NotEqual, [Stmt { op: Op::Goto(label), .. }]) => {
            let behind = matches!(&stmts.get(2)?.op, Op::Label(own) if own == label);
            Some((name, assigned(stmts.get(1)?).filter(|_| behind)?, 2))
        }
        _ => None,
    }
}

/// What a statement decides by, that does nothing else than to end the call: by what it has in it, or by a jump to the
/// end of the body.
fn refusal<'b>(stmt: &'b Stmt, body: &[Stmt]) -> Option<&'b Expr> {
    let ends = |stmts: &[Stmt]| {
        let quiet = |stmt: &Stmt| {
            matches!(
                stmt.op,
                Op::Alarm(_)
                    | Op::Comment(_)
                    | Op::Blank
                    | Op::Label(_)
                    | Op::Return
                    | Op::ProgramEnd
                    | Op::BeginAgain
            )
        };
        let over =
            |stmt: &Stmt| matches!(stmt.op, Op::Alarm(_) | Op::Return | Op::ProgramEnd | Op::BeginAgain);
        stmts.iter().all(quiet) && stmts.iter().any(over) && stmts.iter().all(|stmt| stmt.skip.is_none())
    };
    let Op::Control(control) = &stmt.op else { return None };
    let Control::If { condition, then, otherwise } = &**control else { return None };
    if stmt.skip.is_some() || !otherwise.is_empty() {
        return None;
    }
    let ended = match &then[..] {
        [Stmt { op: Op::Goto(label), skip: None, .. }] => {
            let at = body.iter().position(|stmt| matches!(&stmt.op, Op::Label(own) if own == label))?;
            ends(&body[at..])
        }
        then => ends(then),
    };
    ended.then_some(condition)
}

/// Whether anything jumps to a label.
fn jumps_to(body: &[Stmt], label: &str) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Goto(name) => **name == *label,
        Op::RepeatBlocks(repeat) => *repeat.from == *label || repeat.to.as_deref() == Some(label),
        Op::Control(control) => control.bodies().any(|body| jumps_to(body, label)),
        _ => false,
    })
}
