//! Entries of the control's tables of which the number is computed when the program runs, such as the zero of fixture `n`:
//! branches for one number ([`crate::computed::computed_code`]), each of which reads, or sets, the place that has it.
//!
//! Where a control has the numbers of these places equally far apart, it says all of it in one statement. Not here: which
//! numbers there can be (the front-end's, which has shown that no other reaches it), and how a control spells such a place.

use std::convert::Infallible;

use crate::canon::Axis;
use crate::computed::computed_code::ComputedCode;
use crate::expr::system::System;
use crate::expr::{Expr, Node, Var};
use crate::program::arguments;
use crate::program::{Data, DataMode, Op};

/// Places that are read or set by a computed number, in one statement.
#[derive(Clone, Debug)]
pub struct ComputedEntry<'c> {
    /// The number.
    pub number: &'c Expr,
    /// The statement of the first of the numbers, where the places that are read are local variables of these names.
    pub op: Op,
    /// What is read.
    pub reads: Vec<Place>,
    /// What is set: of a work offset, one for each of its axes.
    pub sets: Vec<Place>,
    /// The same by the number of its entry: the work offset's, the least and the greatest.
    pub entries: Option<(Place, [u16; 2])>,
}

/// One of them, by what the number is multiplied by and what is added to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The name of the variable in its place.
    pub name: Box<str>,
    /// The place that the first of the numbers has.
    pub first: System,
    /// By how much the control's own number grows where the number grows by one.
    pub step: i64,
    /// The control's own number of the place that the number 0 has, or would have.
    pub base: i64,
    /// The first of the numbers.
    pub from: i64,
}

/// Whether a place is one of many, by its number.
pub const fn is_entry(system: &System) -> bool {
    matches!(system, System::WorkOffset { .. } | System::ToolTable { .. })
}

/// Whether such branches are about table entries; else they are about modes.
pub fn is_about_entries(code: &ComputedCode<'_>) -> bool {
    code.codes.iter().any(|(_, op)| matches!(op, Op::SetData(_) | Op::Assign(..)))
}

/// The number of the entry that a place is of.
fn entry_number(system: &System) -> Option<u16> {
    match system {
        System::WorkOffset { number, .. } | System::ToolTable { entry: number, .. } => Some(*number),
        _ => None,
    }
}

/// Whether two places are one, whatever their values count in.
fn is_same(one: &System, other: &System) -> bool {
    match (one, other) {
        (System::WorkOffset { number, axis, .. }, System::WorkOffset { number: own, axis: along, .. }) => {
            number == own && axis == along
        }
        _ => false,
    }
}

/// Such a statement, where the control has all its places by numbers equally far apart; `numbers` are those of the places
/// that it can name so.
pub fn computed_entry<'c>(code: &ComputedCode<'c>, numbers: &[(System, i64)]) -> Option<ComputedEntry<'c>> {
    // A place has the same number in whatever unit its value counts.
    let number_of = |system: &System| {
        let found = numbers.iter().find(|(own, _)| own == system || is_same(own, system));
        found.map(|(_, number)| *number)
    };
    let mut ways = Vec::with_capacity(code.codes.len());
    for (own, op) in &code.codes {
        let mut op = (*op).clone();
        let set = set_by(&op)?;
        unset(&mut op);
        let read = taken(&mut op);
        ways.push((*own, op, read, set));
    }
    let (first, op, read, set) = ways.first()?;
    let same = |at: usize| ways.iter().all(|way| way.2.get(at) == read.get(at));
    let (second, ..) = ways.get(1)?;
    if ways
        .iter()
        .any(|(_, own, reads, sets)| own != op || reads.len() != read.len() || sets.len() != set.len())
    {
        return None;
    }
    type NumberOf<'n> = &'n dyn Fn(&System) -> Option<i64>;
    let place = |name: Box<str>, of: &dyn Fn(usize) -> Option<System>, number_of: NumberOf| {
        let far = second.checked_sub(*first).filter(|far| *far != 0)?;
        let at = |way: usize| number_of(&of(way)?);
        let apart = at(1)?.checked_sub(at(0)?)?;
        let step = apart.checked_div(far).filter(|step| step.checked_mul(far) == Some(apart))?;
        let base = at(0)?.checked_sub(step.checked_mul(*first)?)?;
        let fits = |way: usize| {
            let own = step.checked_mul(ways[way].0).and_then(|own| own.checked_add(base));
            own.is_some() && own == at(way)
        };
        (step != 0 && (0..ways.len()).all(fits)).then_some(())?;
        Some(Place { name, first: of(0)?, step, base, from: *first })
    };
    let by_number = (0..read.len()).filter(|at| !same(*at));
    let reads = by_number.map(|at| place(name(at), &|way| Some(ways[way].2[at].clone()), &number_of));
    let reads = reads.collect::<Option<Vec<Place>>>()?;
    let sets = (0..set.len()).map(|at| place("".into(), &|way| Some(ways[way].3[at].clone()), &number_of));
    let sets = sets.collect::<Option<Vec<Place>>>()?;
    if sets.is_empty() && reads.is_empty() {
        return None;
    }
    let own = |way: usize| entry_number(ways[way].3.first()?);
    let all = (0..ways.len()).map(own).collect::<Option<Vec<u16>>>();
    let by_entry =
        place("".into(), &|way| ways[way].3.first().cloned(), &|system| entry_number(system).map(i64::from));
    let ends = all.and_then(|all| Some([*all.iter().min()?, *all.iter().max()?]));
    let mut op = op.clone();
    // What is one place whatever the number is stays that.
    variables(&mut op, &mut |var| {
        if let Some(at) = (0..read.len()).find(|at| same(*at) && *var == Var::Local(name(*at))) {
            *var = Var::System(read[at].clone());
        }
    });
    Some(ComputedEntry { number: code.number, op, reads, sets, entries: by_entry.zip(ends) })
}

/// The variable that stands for what is read there: no program has one of this name.
fn name(at: usize) -> Box<str> {
    format!("entry {at}").into()
}

/// The places that a statement sets; `None` where it does something else with them, or is about something else.
fn set_by(op: &Op) -> Option<Vec<System>> {
    let data = match op {
        Op::SetData(data) => data,
        Op::Assign(..) => return Some(Vec::new()),
        _ => return None,
    };
    match &**data {
        Data::Offset { offset, mode: DataMode::Set, words, turn: None } => {
            let said = Axis::ALL.into_iter().filter(|axis| words[*axis as usize].is_some());
            Some(said.map(|axis| System::WorkOffset { number: *offset, axis, unit: None }).collect())
        }
        Data::Tool { entry, which, added: false, .. } => {
            let entry = u16::try_from(*entry).ok()?;
            Some(vec![System::ToolTable { value: *which, entry }])
        }
        Data::Offset { .. }
        | Data::Tool { .. }
        | Data::Measured { .. }
        | Data::Position(_)
        | Data::ToolInSpindle(_) => None,
    }
}

/// The same statement, whatever place it sets.
fn unset(op: &mut Op) {
    if let Op::SetData(data) = op {
        match &mut **data {
            Data::Offset { offset, .. } => *offset = 0,
            Data::Tool { entry, .. } => *entry = 0,
            Data::Measured { .. } | Data::Position(_) | Data::ToolInSpindle(_) => {}
        }
    }
}

/// The places that a statement reads, for which variables stand in it then.
fn taken(op: &mut Op) -> Vec<System> {
    let mut found = Vec::new();
    variables(op, &mut |var| {
        if let Var::System(system) = var
            && is_entry(system)
        {
            found.push(system.clone());
            *var = Var::Local(name(found.len() - 1));
        }
    });
    found
}

/// Shows the variables of what a statement is given, to be changed.
fn variables(op: &mut Op, seen: &mut dyn FnMut(&mut Var)) {
    match op {
        Op::Assign(_, value) => in_value(value, seen),
        Op::SetData(_) => {
            let each = arguments::each(op, &mut |argument, _| {
                argument.expr_mut().into_iter().for_each(|value| in_value(value, seen));
                Ok::<(), Infallible>(())
            });
            each.unwrap_or_else(|never| match never {});
        }
        _ => {}
    }
}

fn in_value(value: &mut Expr, seen: &mut dyn FnMut(&mut Var)) {
    if let Expr::Node(node) = value
        && let Node::Var(var) = &mut **node
    {
        return seen(var);
    }
    value.parts_mut().for_each(|part| in_value(part, seen));
}
