//! Labels in a list of statements, and the jumps that go to them.

use std::collections::BTreeSet;

use ncc_ir::program::{Op, Stmt, Text};

/// Labels to which jumps go from anywhere within.
pub(super) fn targets(body: &[Stmt]) -> BTreeSet<Text> {
    fn look(body: &[Stmt], found: &mut BTreeSet<Text>) {
        for stmt in body {
            match &stmt.op {
                Op::Goto(name) => {
                    found.insert(name.clone());
                }
                Op::Control(control) => control.bodies().for_each(|body| look(body, found)),
                _ => {}
            }
        }
    }
    let mut found = BTreeSet::new();
    look(body, &mut found);
    found
}

/// How many jumps to a label there are in a statement.
pub(super) fn times(stmt: &Stmt, name: &Text) -> usize {
    match &stmt.op {
        Op::Goto(own) => {
            usize::from(own == name && stmt.skip.is_none()) + 2 * usize::from(stmt.skip.is_some())
        }
        Op::Control(control) => control.bodies().flatten().map(|stmt| times(stmt, name)).sum(),
        _ => 0,
    }
}

pub(super) fn of_stmt(stmt: &Stmt) -> BTreeSet<Text> {
    targets(std::slice::from_ref(stmt))
}

/// Labels that stand in a list itself.
pub(super) fn labels(body: &[Stmt]) -> BTreeSet<Text> {
    let label = |stmt: &Stmt| match &stmt.op {
        Op::Label(name) => Some(name.clone()),
        _ => None,
    };
    body.iter().filter_map(label).collect()
}

pub(super) fn position(body: &[Stmt], name: &str) -> Option<usize> {
    body.iter().position(|stmt| matches!(&stmt.op, Op::Label(own) if **own == *name))
}

/// The place of a label, of which there is one: looked for from a place on, as a rule it is near.
pub(super) fn position_from(body: &[Stmt], from: usize, name: &str) -> Option<usize> {
    let (before, rest) = body.split_at(from.min(body.len()));
    position(rest, name).map(|at| before.len() + at).or_else(|| position(before, name))
}

/// Labels that stand where a place of a list is, and those after the list if it is its end.
pub(super) fn at_place(body: &[Stmt], place: usize, behind: &BTreeSet<Text>) -> BTreeSet<Text> {
    let rest = &body[place.min(body.len())..];
    let here = rest.iter().take_while(|stmt| matches!(stmt.op, Op::Label(_))).count();
    let mut found = labels(&rest[..here]);
    if here == rest.len() {
        found.extend(behind.iter().cloned());
    }
    found
}

/// Takes labels away to which nothing goes any more; their numbers and comments stay.
pub(super) fn without_labels(body: &mut Vec<Stmt>, targets: &BTreeSet<Text>) {
    if body.iter().any(|stmt| matches!(stmt.op, Op::RepeatBlocks(_))) {
        return;
    }
    let mut out: Vec<Stmt> = Vec::with_capacity(body.len());
    let mut begins: Option<Option<u32>> = None;
    for mut stmt in std::mem::take(body) {
        if let Some(number) = begins.take() {
            stmt.joined = false;
            stmt.number = stmt.number.or(number);
        }
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| without_labels(body, targets));
        }
        match &stmt.op {
            Op::Label(name) if !targets.contains(name) => {
                if let Some(comment) = stmt.comment.take() {
                    out.push(Stmt { op: Op::Comment(*comment), ..stmt });
                } else if !stmt.joined {
                    begins = Some(stmt.number);
                }
            }
            _ => out.push(stmt),
        }
    }
    *body = out;
}
