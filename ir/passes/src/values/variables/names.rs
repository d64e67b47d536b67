//! Chooses the target's variable for each variable of the source.
//!
//! Common variables follow four rules. Each rule runs over all variables, in the order of the text, before the next:
//!
//! 1. A variable keeps its name if the target has the same name.
//! 2. It keeps its number, if the target has that number with the same lifetime: `#101` becomes `R101`.
//! 3. Its number moves by 100, if that number is free: `R1` becomes `#101`.
//! 4. It gets the first free common number, or a common name if the target has them.
//!
//! Local variables keep a number or a name that the target has. Else a name becomes the first free local number. A
//! number becomes a name: `V_` with the number, or with the letter of its argument. Where the target lacks local
//! variables for the main program, they become common variables by rules 2 to 4. The same holds if a called program
//! shares them and the target lacks such calls. An array becomes a run of numbers if the target lacks arrays.
//!
//! Arguments follow the target. By letters: a name of one letter, or with an underline and a letter at its end, gets
//! that letter. By position: the head of the program assigns them to its variables. By names: they keep their names.
//!
//! Refused: a variable without a free number; local variables of a caller that is itself called with its own locals;
//! variables with computed numbers, unless all of them stay or all move by 100.
//!
//! Not here: the inventory of the variables (`inventory`), and rewriting the statements.

mod reported;

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use crate::values::variables::inventory::{Inventory, Seen, number_of};
use ncc_ir::computed::computes::{ComputeFeature, Computes, Handed, LETTERS};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::{Expr, Node, Numbers, Scope, Var};
use ncc_ir::program::valid::returns_alone;
use ncc_ir::program::{Declare, Op, Procedure, Program, Stmt, Type};
use ncc_ir::run_time::RunTimeValue;
use ncc_ir::source::Span;

/// Distance by which rule 3 moves a number.
const FURTHER: u32 = 100;

/// Source variable to target variable.
pub(super) type Map = HashMap<Var, Var>;

/// Place in the target for the local variables of a procedure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Home {
    /// Local variables, one set for each call.
    Own,
    /// Common variables, which all procedures see.
    Common,
    /// No place: a program with such variables is refused.
    None,
}

/// The chosen variables of a program, and the facts for the choice.
pub(super) struct Plan<'c> {
    pub(super) from: &'c Computes,
    pub(super) computes: &'c Computes,
    inventories: Vec<Inventory>,
    /// Parameters of each procedure.
    pub(super) parameters: Vec<Vec<Var>>,
    homes: Vec<Home>,
    /// Per procedure: index of the procedure that owns its locals. Procedures that share locals have the same owner.
    roots: Vec<usize>,
    /// Map of the common variables, and of locals that become common.
    pub(super) common: Map,
    /// Map of the locals, by the index of their owner (`roots`).
    locals: Vec<Map>,
    /// Distance by which variables with computed numbers move: 0 or 100.
    pub(super) further: u32,
    /// Common numbers of the target that are in use.
    taken: BTreeSet<u32>,
}

fn among(ranges: &[[u32; 2]], n: u32) -> bool {
    ranges.iter().any(|[from, to]| (*from..=*to).contains(&n))
}

fn no_room(name: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Fault::computes(RunTimeValue::VariableWithoutRoom { name: name.into() }), at)
}

impl<'c> Plan<'c> {
    pub(super) fn new(program: &Program, from: &'c Computes, computes: &'c Computes) -> Plan<'c> {
        let inventories = program.procedures.iter().map(|procedure| {
            let mut inventory = Inventory::default();
            inventory.body(&procedure.body);
            inventory
        });
        Plan {
            from,
            computes,
            inventories: inventories.collect(),
            parameters: program.procedures.iter().map(|p| p.parameters.clone()).collect(),
            homes: Vec::new(),
            roots: Vec::new(),
            common: Map::new(),
            locals: vec![Map::new(); program.procedures.len()],
            further: 0,
            taken: BTreeSet::new(),
        }
    }

    /// Whether a procedure has parameters or local variables.
    pub(super) fn has_own(&self, at: usize) -> bool {
        let local = |seen: &Seen| matches!(seen.var, Var::Local(_));
        let by_number = |(row, _): &(Numbers, Span)| row.scope == Scope::Local;
        !self.parameters[at].is_empty()
            || self.inventories[at].seen.iter().any(local)
            || self.inventories[at].numbered.iter().any(by_number)
    }

    pub(super) fn locals_of(&self, at: usize) -> &Map {
        &self.locals[self.roots[at]]
    }

    pub(super) fn make(&mut self, program: &Program) -> Result<(), Diagnostic> {
        self.find_homes(program);
        let own_numbers = !self.computes.local.is_empty();
        for at in 0..self.inventories.len() {
            if self.homes[at] == Home::None
                && let Some(seen) = self.inventories[at].seen.iter().find(|s| matches!(s.var, Var::Local(_)))
            {
                let what = RunTimeValue::VariableOfCaller { name: seen.var.name().into() };
                return Err(Diagnostic::new(Fault::computes(what), seen.at));
            }
        }
        self.go_further()?;
        // Common variables, in the order of the text.
        let mut all: Vec<Seen> = Vec::new();
        let mut places: HashMap<Var, usize> = HashMap::new();
        for (at, inventory) in self.inventories.iter().enumerate() {
            for seen in &inventory.seen {
                let common = match &seen.var {
                    Var::Common(_) | Var::Retentive(_) => true,
                    Var::Local(_) => match self.homes[at] {
                        Home::Common => true,
                        Home::Own if at == 0 && !self.main_is_called(program) => {
                            !self.stays_with_main(seen, own_numbers)
                        }
                        Home::Own | Home::None => false,
                    },
                    Var::System(_) => false,
                };
                match places.get(&seen.var) {
                    Some(at) => all[*at].elements = all[*at].elements.or(seen.elements),
                    None if common => {
                        places.insert(seen.var.clone(), all.len());
                        all.push(seen.clone());
                    }
                    None => {}
                }
            }
        }
        self.place_common(&all)?;
        for at in 0..self.inventories.len() {
            if self.homes[at] == Home::Own && self.roots[at] == at {
                self.place_own(at)?;
            }
        }
        Ok(())
    }

    /// Whether the main procedure is a subprogram with an unknown caller, which has other variables.
    fn main_is_called(&self, program: &Program) -> bool {
        let alone = self.computes.handed == Handed::Places && returns_alone(program).is_some();
        alone || !program.procedures[0].parameters.is_empty()
    }

    /// Whether a local variable of the main procedure stays local in the target; else it becomes common.
    fn stays_with_main(&self, seen: &Seen, own_numbers: bool) -> bool {
        let number = number_of(&seen.var, self.from);
        match (number, &self.computes.named) {
            _ if self.computes.says(&seen.var) => true,
            (Some(n), _) if own_numbers => among(&self.computes.local, n),
            (Some(_), _) => false,
            (None, named) => named.is_some(),
        }
    }

    /// Finds the owner of each procedure's locals, and their place in the target.
    fn find_homes(&mut self, program: &Program) {
        let count = program.procedures.len();
        let by_name = program.by_name();
        let index = |name: &str| by_name.get(name).copied();
        let mut shared: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); count];
        let mut begins = BTreeSet::from([0]);
        for (at, procedure) in program.procedures.iter().enumerate() {
            each_call(&procedure.body, &mut |name, own| {
                let Some(called) = index(name) else { return };
                if own {
                    begins.insert(called);
                } else {
                    shared[at].insert(called);
                }
            });
        }
        let group = |root: usize| {
            let mut group = BTreeSet::from([root]);
            let mut ahead = vec![root];
            while let Some(at) = ahead.pop() {
                ahead.extend(shared[at].iter().filter(|next| group.insert(**next)));
            }
            group
        };
        let groups: BTreeMap<usize, BTreeSet<usize>> =
            begins.iter().map(|root| (*root, group(*root))).collect();
        self.homes = vec![Home::Own; count];
        self.roots = (0..count).collect();
        let mut roots: Vec<Vec<usize>> = vec![Vec::new(); count];
        for (root, group) in &groups {
            group.iter().for_each(|at| roots[*at].push(*root));
        }
        let users: BTreeMap<usize, usize> = groups
            .iter()
            .map(|(root, group)| (*root, group.iter().filter(|p| self.has_own(**p)).count()))
            .collect();
        for (at, of) in roots.into_iter().enumerate() {
            if let Some(root) = of.first() {
                self.roots[at] = *root;
            }
            if self.computes.shares || !self.has_own(at) {
                continue;
            }
            self.homes[at] = match of.as_slice() {
                [] => Home::Own,
                [root] if *root == at && users[root] == 1 => Home::Own,
                [0] => Home::Common,
                _ => Home::None,
            };
        }
    }

    /// Finds one distance for all variables with computed numbers (`further`). Refuses them if neither 0 nor 100 fits.
    fn go_further(&mut self) -> Result<(), Diagnostic> {
        let rows: Vec<&(Numbers, Span)> =
            self.inventories.iter().flat_map(|inventory| &inventory.numbered).collect();
        let Some((_, at)) = rows.first().copied().cloned() else { return Ok(()) };
        let refused = || Diagnostic::new(Fault::computes(RunTimeValue::ComputedNumberAmongRenamed), at);
        let keeps_own = !self.computes.local.is_empty();
        for (at, inventory) in self.inventories.iter().enumerate() {
            let own = inventory.numbered.iter().any(|(row, _)| row.scope == Scope::Local);
            // The target has only names for locals: a computed number cannot select one.
            if own && !keeps_own && at > 0 && self.homes[at] == Home::Own {
                return Err(refused());
            }
        }
        let used: Vec<u32> = self
            .inventories
            .iter()
            .flat_map(|inventory| &inventory.seen)
            .filter(|seen| !matches!(seen.var, Var::System(_)))
            .filter_map(|seen| number_of(&seen.var, self.from))
            .collect();
        let has = |n: u32| {
            [&self.computes.local, &self.computes.common, &self.computes.retentive]
                .iter()
                .any(|ranges| among(ranges, n))
        };
        let first = rows.iter().map(|(row, _)| row.from).min().unwrap_or_default();
        let stays = has(first) && used.iter().all(|n| has(*n))
            || !used.is_empty() && used.iter().all(|n| among(&self.computes.common, *n));
        self.further = match stays {
            true => 0,
            false if used.iter().all(|n| among(&self.computes.common, n + FURTHER)) => FURTHER,
            false => return Err(refused()),
        };
        // The program may use each number of the range. The range is cut at 10 000 numbers.
        for (row, _) in rows {
            if row.scope != Scope::Local || !keeps_own {
                self.taken.extend((row.from..=row.to.min(row.from + 9999)).map(|n| n + self.further));
            }
        }
        Ok(())
    }

    fn common_var(&self, n: u32, kept: bool) -> Option<Var> {
        let name = || format!("{}{n}", self.computes.prefix).into();
        let common = among(&self.computes.common, n).then(|| Var::Common(name()));
        let retentive = among(&self.computes.retentive, n).then(|| Var::Retentive(name()));
        if kept { retentive.or(common) } else { common }
    }

    fn place_common(&mut self, all: &[Seen]) -> Result<(), Diagnostic> {
        let by_number = self.inventories.iter().any(|inventory| !inventory.numbered.is_empty());
        let take = |plan: &mut Plan, seen: &Seen, to: Var| {
            plan.taken.extend(number_of(&to, plan.computes));
            plan.common.insert(seen.var.clone(), to);
        };
        let mut left: Vec<&Seen> = Vec::new();
        for seen in all {
            // Arrays get numbers last, if the target lacks them.
            let stays = match seen.elements {
                Some(_) => self.computes.has(ComputeFeature::Array) && self.computes.says(&seen.var),
                None => self.computes.says(&seen.var) && !matches!(seen.var, Var::Local(_)),
            };
            if stays && (!by_number || self.further == 0 || number_of(&seen.var, self.from).is_none()) {
                take(self, seen, seen.var.clone());
            } else {
                left.push(seen);
            }
        }
        // With computed numbers, all variables move by the same distance.
        let steps: &[u32] = if by_number { &[self.further] } else { &[0, FURTHER] };
        for step in steps {
            for seen in std::mem::take(&mut left) {
                let number = number_of(&seen.var, self.from).filter(|_| seen.elements.is_none());
                let kept = matches!(seen.var, Var::Retentive(_));
                let to = number.and_then(|n| self.common_var(n + step, kept));
                let free = |var: &Var, plan: &Plan| {
                    let number = number_of(var, plan.computes);
                    by_number || number.is_none_or(|n| !plan.taken.contains(&n))
                };
                match to {
                    Some(to) if free(&to, self) => take(self, seen, to),
                    _ => left.push(seen),
                }
            }
        }
        let mut used: HashSet<Var> = self.common.values().cloned().collect();
        for seen in left {
            let name = seen.var.name();
            let common = !matches!(seen.var, Var::Local(_));
            let named = self
                .computes
                .named
                .as_ref()
                .filter(|named| named.common.is_some() && seen.elements.is_none());
            if let (Some(named), true) = (named, number_of(&seen.var, self.from).is_none()) {
                let made = |name: &str| Var::Common(named.adapted(name, true));
                let to = unlike(&name, |name| Some(made(name)).filter(|var| !used.contains(var)));
                if let Some(to) = to.filter(|_| common || named.common.is_some()) {
                    used.insert(to.clone());
                    take(self, seen, to);
                    continue;
                }
            }
            let count = seen.elements.unwrap_or(1).max(1);
            // A variable that survives power-off becomes one that does so in the target, if the target has any.
            let kept = matches!(seen.var, Var::Retentive(_)) && !self.computes.retentive.is_empty();
            let ranges = if kept { &self.computes.retentive } else { &self.computes.common };
            let run = run(ranges, &self.taken, count).ok_or_else(|| no_room(&name, seen.at))?;
            self.taken.extend(run..run + count);
            let to = self.common_var(run, kept).ok_or_else(|| no_room(&name, seen.at))?;
            used.insert(to.clone());
            self.common.insert(seen.var.clone(), to);
        }
        Ok(())
    }

    /// Chooses the target's variables for the locals of the owner `at`.
    fn place_own(&mut self, at: usize) -> Result<(), Diagnostic> {
        // Includes the locals of all procedures with the same owner.
        let mut all: Vec<Seen> = Vec::new();
        let parameters = &self.parameters[at];
        let first = self.inventories[at].seen.first().map_or(Span::default(), |seen| seen.at);
        all.extend(parameters.iter().map(|var| Seen { var: var.clone(), elements: None, at: first }));
        let mut places: HashMap<Var, usize> =
            all.iter().enumerate().rev().map(|(place, seen)| (seen.var.clone(), place)).collect();
        let same = |other: &usize| self.roots[*other] == at && self.homes[*other] == Home::Own;
        for (other, inventory) in self.inventories.iter().enumerate().filter(|(other, _)| same(other)) {
            let local = inventory.seen.iter().filter(|seen| matches!(seen.var, Var::Local(_)));
            for seen in local.filter(|seen| other > 0 || !self.common.contains_key(&seen.var)) {
                match places.get(&seen.var) {
                    Some(at) => all[*at].elements = all[*at].elements.or(seen.elements),
                    None => {
                        places.insert(seen.var.clone(), all.len());
                        all.push(seen.clone());
                    }
                }
            }
        }
        let mut map = Map::new();
        let mut numbers = BTreeSet::new();
        for seen in &all {
            let array = seen.elements.is_some() && !self.computes.has(ComputeFeature::Array);
            if self.computes.says(&seen.var) && !array {
                numbers.extend(number_of(&seen.var, self.computes));
                map.insert(seen.var.clone(), seen.var.clone());
            }
        }
        let letters = self.computes.handed == Handed::Letters;
        let by_number = self.inventories[at].numbered.iter().any(|(row, _)| row.scope == Scope::Local);
        if by_number {
            numbers.extend(self.computes.local.iter().flat_map(|[from, to]| *from..=*to));
        }
        let own = |n: u32, computes: &Computes| Var::Local(format!("{}{n}", computes.prefix).into());
        if letters {
            for parameter in parameters.iter().filter(|p| number_of(p, self.from).is_none()) {
                let n = letter_for(&parameter.name(), &numbers)
                    .ok_or_else(|| no_room(&parameter.name(), first))?;
                numbers.insert(n);
                map.insert(parameter.clone(), own(n, self.computes));
            }
        }
        let mut used: HashSet<Var> = map.values().cloned().collect();
        for seen in all {
            if map.contains_key(&seen.var) {
                continue;
            }
            let name = seen.var.name();
            let number = number_of(&seen.var, self.from);
            let array = seen.elements.is_some() && !self.computes.has(ComputeFeature::Array);
            if let Some(named) = self.computes.named.as_ref().filter(|_| !array) {
                let is_parameter = self.parameters[at].contains(&seen.var);
                let wanted = match number {
                    Some(n) => {
                        let letter =
                            LETTERS.iter().find(|(_, own)| *own == n).map(|(letter, _)| char::from(*letter));
                        let letter = letter.filter(|_| is_parameter && self.from.handed == Handed::Letters);
                        letter.map_or_else(|| format!("V_{n}"), |letter| format!("V_{letter}"))
                    }
                    None => name.to_string(),
                };
                let made = |name: &str| Var::Local(named.adapted(name, false));
                let to = unlike(&wanted, |name| Some(made(name)).filter(|var| !used.contains(var)));
                let to = to.ok_or_else(|| no_room(&name, seen.at))?;
                used.insert(to.clone());
                map.insert(seen.var.clone(), to);
                continue;
            }
            let count = seen.elements.unwrap_or(1).max(1);
            let run = run(&self.computes.local, &numbers, count).ok_or_else(|| no_room(&name, seen.at))?;
            numbers.extend(run..run + count);
            used.insert(own(run, self.computes));
            map.insert(seen.var.clone(), own(run, self.computes));
        }
        self.locals[at] = map;
        Ok(())
    }

    /// Renames the parameters of a procedure. Inserts at its head their comment or assignments, and declarations.
    pub(super) fn head(&self, at: usize, procedure: &mut Procedure) {
        let span = procedure.body.first().map_or(Span::default(), |stmt| stmt.span);
        let locals = self.locals_of(at);
        for parameter in &mut procedure.parameters {
            if let Some(to) = locals.get(parameter) {
                *parameter = to.clone();
            }
        }
        let mut head: Vec<Stmt> = Vec::new();
        let mark = &self.computes.mark;
        let names = self.parameters[at].iter().zip(&procedure.parameters).filter_map(|(old, new)| {
            let lost = number_of(old, self.from).is_none() && number_of(new, self.computes).is_some();
            lost.then(|| format!("{mark}{} {}", new.name(), old.name()))
        });
        let names: Vec<String> = names.collect();
        if !names.is_empty() && self.computes.handed == Handed::Letters {
            head.push(Stmt::new(span, Op::Comment(names.join(", ").into())));
        }
        if self.computes.handed == Handed::Places {
            for (place, parameter) in procedure.parameters.iter_mut().enumerate().rev() {
                let own = Var::Local((place + 1).to_string().into());
                if *parameter != own {
                    let value = Expr::Node(Box::new(Node::Var(own.clone())));
                    let to = std::mem::replace(parameter, own);
                    head.push(Stmt::new(span, Op::Assign(to.into(), value)));
                }
            }
        }
        if self.computes.has(ComputeFeature::Declare) && self.roots.get(at) == Some(&at) {
            let declared = &self.inventories[at].declared;
            for seen in &self.inventories[at].seen {
                let Some(new) = locals.get(&seen.var) else { continue };
                let known = declared.contains(&*seen.var.name()) || procedure.parameters.contains(new);
                if !known && number_of(new, self.computes).is_none() {
                    let (kind, sizes, initial) = (Type::Real, Box::default(), Vec::new());
                    let declare = Declare { var: new.clone(), kind, sizes, initial };
                    head.push(Stmt::new(span, Op::Declare(Box::new(declare))));
                }
            }
        }
        procedure.body.splice(0..0, head);
    }
}

/// Calls `seen` for every call of a body, with the called name and whether the call has its own locals.
fn each_call(body: &[Stmt], seen: &mut dyn FnMut(&str, bool)) {
    for stmt in body {
        match &stmt.op {
            Op::Call(call) => seen(&call.name, !call.shared || !call.arguments.is_empty()),
            Op::Control(control) => control.bodies().for_each(|body| each_call(body, seen)),
            _ => {}
        }
    }
}

/// Local number of the argument letter for a parameter: its own letter if free, else the first free one but M, S, T.
fn letter_for(name: &str, taken: &BTreeSet<u32>) -> Option<u32> {
    let mut last = name.bytes().rev();
    let own = match (last.next(), last.next()) {
        (Some(letter), None | Some(b'_')) => Some(letter.to_ascii_uppercase()),
        _ => None,
    };
    let own = LETTERS.iter().find(|(letter, _)| own == Some(*letter)).map(|(_, n)| *n);
    let plain = LETTERS.iter().filter(|(letter, _)| !b"MST".contains(letter)).map(|(_, n)| *n);
    own.into_iter().chain(plain).find(|n| !taken.contains(n))
}

/// First number of a run of `count` free numbers; `None` if no range has such a run.
fn run(ranges: &[[u32; 2]], taken: &BTreeSet<u32>, count: u32) -> Option<u32> {
    ranges.iter().find_map(|[from, to]| {
        let last = (to + 1).checked_sub(count)?;
        (*from..=last).find(|first| (*first..first + count).all(|n| !taken.contains(&n)))
    })
}

/// A free name: `name` itself, else `name_2` to `name_999`.
fn unlike(name: &str, made: impl Fn(&str) -> Option<Var>) -> Option<Var> {
    made(name).or_else(|| (2..1000).find_map(|more| made(&format!("{name}_{more}"))))
}
