//! What must hold of a whole program before it is rewritten or written.
//!
//! Not here: what only execution can find, such as calls without an end.

use crate::run_time::{RunTime, RunTimeFlow, RunTimeValue, RunTimeWord};
use std::collections::{HashMap, HashSet};

use crate::computed::computes::Computes;
use crate::diag::{Diagnostic, Fault};
use crate::program::arguments;
use crate::program::kinds::moves;
use crate::program::{Call, Control, Op, Program, Stmt};
use crate::source::Span;

/// The first statement that is computed, or decides, when the program runs, and that the target cannot say.
pub fn computing(program: &Program, computes: Option<&Computes>) -> Option<Diagnostic> {
    match computes {
        Some(computes) => anything(program).and_then(|_| computes.refusal(program)),
        None => anything(program),
    }
}

/// The first statement that is computed, or decides, when the program runs. A body that is executed a number of
/// times that is written is neither.
pub fn anything(program: &Program) -> Option<Diagnostic> {
    let found = program.procedures.iter().find_map(|procedure| computes(&procedure.body));
    found.or_else(|| {
        let with_parameters = program.procedures.iter().find(|p| !p.parameters.is_empty())?;
        let at = with_parameters.body.first()?.span;
        Some(Diagnostic::new(Fault::computes(RunTimeFlow::Subprogram), at))
    })
}

fn computes(body: &[Stmt]) -> Option<Diagnostic> {
    body.iter().find_map(|stmt| {
        let what: RunTime = match &stmt.op {
            Op::Assign(..) => RunTimeValue::Assignment.into(),
            Op::Declare(_) => RunTimeValue::Declaration.into(),
            Op::Leave | Op::NextTurn => RunTimeFlow::LoopLeft.into(),
            Op::MessageOf(_) => RunTimeWord::MessageValues.into(),
            Op::Control(control) => match &**control {
                Control::If { .. } => RunTimeFlow::Decision.into(),
                Control::Repeat { times, body } if times.literal().is_some() => return computes(body),
                Control::Repeat { .. }
                | Control::Loop { .. }
                | Control::While { .. }
                | Control::Until { .. }
                | Control::For { .. } => RunTimeFlow::Loop.into(),
            },
            Op::Goto(_) => RunTimeFlow::Jump.into(),
            Op::Call(call) if !call.arguments.is_empty() => RunTimeFlow::CallArguments.into(),
            op if arguments::computed(op) => RunTimeValue::WordWithExpression.into(),
            _ => return None,
        };
        Some(Diagnostic::new(Fault::computes(what), stmt.span))
    })
}

/// Where the main procedure returns to a program that is not there: a standalone subprogram.
pub fn returns_alone(program: &Program) -> Option<Span> {
    fn found(body: &[Stmt]) -> Option<Span> {
        body.iter().find_map(|stmt| match &stmt.op {
            Op::Return => Some(stmt.span),
            Op::Control(control) => control.bodies().find_map(|body| found(body)),
            _ => None,
        })
    }
    found(&program.procedures.first()?.body)
}

/// Whether a body moves anywhere, or calls a cycle up: what ends a cycle that was active before it.
pub fn moves(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Control(control) => control.bodies().any(|body| moves(body)),
        _ => is_move(stmt),
    })
}

/// Whether every path through a body goes over such a statement that it begins with.
pub fn begins_by_a_move(body: &[Stmt]) -> bool {
    let plain = |stmt: &&Stmt| !matches!(stmt.op, Op::Control(_) | Op::Goto(_) | Op::Return | Op::Alarm(_));
    body.iter().take_while(plain).any(|stmt| is_move(stmt) && stmt.skip.is_none())
}

/// Where a body may return while a cycle is active that it has activated: its caller would go on with it.
pub fn leaves_a_cycle(body: &[Stmt]) -> Option<Span> {
    fn follow_cycle(body: &[Stmt], held: &mut bool, at: &mut Option<Span>) {
        for stmt in body {
            match stmt.op.unwrapped() {
                Op::StartCycle(_) => *held = true,
                Op::EndCycle if stmt.skip.is_none() => *held = false,
                // What was active where it is jumped from, is.
                Op::Label(_) => *held = true,
                Op::Return if *held => *at = at.or(Some(stmt.span)),
                Op::Control(control) => {
                    let before = *held;
                    let mut behind = before;
                    for body in control.bodies() {
                        let mut inside = before;
                        follow_cycle(body, &mut inside, at);
                        // Its turns begin with what the last one leaves.
                        if inside && !before {
                            follow_cycle(body, &mut inside, at);
                        }
                        behind |= inside;
                    }
                    *held = behind;
                }
                _ => {}
            }
        }
    }
    let (mut held, mut at) = (false, None);
    if calls_up(body) {
        follow_cycle(body, &mut held, &mut at);
    }
    at
}

/// Whether a body activates a cycle.
fn calls_up(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match stmt.op.unwrapped() {
        Op::Control(control) => control.bodies().any(|body| calls_up(body)),
        op => matches!(op, Op::StartCycle(_)),
    })
}

/// Where subprograms may end a cycle that their caller has activated, the first place of each: by a code, a move or a
/// cycle of their own.
pub fn ends_callers_cycle(program: &Program) -> Vec<Span> {
    struct Look<'p> {
        places: HashMap<&'p str, usize>,
        /// Procedures that may be called while a cycle is active.
        under: Vec<bool>,
        grown: bool,
    }
    /// What may be active: a cycle, and the caller's.
    #[derive(Clone, Copy, PartialEq)]
    struct Held {
        any: bool,
        callers: bool,
    }
    impl Look<'_> {
        /// `led` is what may be active where a jump leads to.
        fn follow_calls(&mut self, body: &[Stmt], led: Held, held: &mut Held, at: &mut Option<Span>) {
            for stmt in body {
                let op = stmt.op.unwrapped();
                match op {
                    Op::StartCycle(_) | Op::EndCycle | moves!() => {
                        if held.callers && at.is_none() {
                            *at = Some(stmt.span);
                        }
                        if stmt.skip.is_none() {
                            *held = Held { any: false, callers: false };
                        }
                        held.any |= matches!(op, Op::StartCycle(_));
                    }
                    Op::Call(call) if held.any => {
                        if let Some(place) = self.places.get(&*call.name) {
                            self.grown |= !std::mem::replace(&mut self.under[*place], true);
                        }
                    }
                    Op::Label(_) => {
                        *held = Held { any: held.any || led.any, callers: held.callers || led.callers };
                    }
                    Op::Control(control) => {
                        let before = *held;
                        for body in control.bodies() {
                            let mut inside = before;
                            self.follow_calls(body, led, &mut inside, at);
                            // Its turns begin with what the last one leaves.
                            if inside.any && !before.any {
                                self.follow_calls(body, led, &mut inside, at);
                            }
                            held.any |= inside.any;
                            held.callers |= inside.callers;
                        }
                    }
                    _ => {}
                }
            }
        }
    }
    let count = program.procedures.len();
    let mut look = Look { places: program.by_name(), under: vec![false; count], grown: true };
    let mut found = Vec::new();
    while std::mem::take(&mut look.grown) {
        found.clear();
        for (place, procedure) in program.procedures.iter().enumerate() {
            let under = look.under[place];
            let mut held = Held { any: under, callers: under };
            let led = Held { any: under || calls_up(&procedure.body), callers: under };
            let mut at = None;
            look.follow_calls(&procedure.body, led, &mut held, &mut at);
            found.extend(at);
        }
    }
    found
}

fn is_move(stmt: &Stmt) -> bool {
    matches!(stmt.op.unwrapped(), moves!() | Op::StartCycle(_))
}

/// Calls of procedures and jumps to labels that the program does not have, in the order of its text. A jump finds
/// labels of its own procedure. Where there are none, a call that stands too deep within others.
pub fn leads_nowhere(program: &Program) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let names: HashSet<&str> = program.procedures.iter().skip(1).map(|p| &*p.name).collect();
    for procedure in &program.procedures {
        let mut labels = HashSet::new();
        labels_of(&procedure.body, &mut labels);
        within(&names, &procedure.body, &labels, &mut found);
    }
    if found.is_empty() {
        let deep = deeper_calls(program, DEEPEST, |_| true);
        let fault = |name: &str| Fault::CallsTooDeep { name: name.into(), most: DEEPEST as u32 };
        found.extend(deep.map(|(_, name, span)| Diagnostic::new(fault(name), span)));
    }
    found
}

/// Jumps to labels that stand several times in their procedure, each label once.
pub fn labels_twice(program: &Program) -> Vec<Diagnostic> {
    fn collect_labels<'p>(
        body: &'p [Stmt],
        labels: &mut HashMap<&'p str, Vec<Span>>,
        jumps: &mut Vec<(&'p str, Span)>,
    ) {
        for stmt in body {
            match &stmt.op {
                Op::Label(name) => labels.entry(name).or_default().push(stmt.span),
                Op::Goto(name) => jumps.push((name, stmt.span)),
                Op::Control(control) => control.bodies().for_each(|body| collect_labels(body, labels, jumps)),
                _ => {}
            }
        }
    }
    let mut found = Vec::new();
    for procedure in &program.procedures {
        let (mut labels, mut jumps) = (HashMap::new(), Vec::new());
        collect_labels(&procedure.body, &mut labels, &mut jumps);
        for (name, span) in jumps {
            if let Some(places) = labels.get_mut(name).filter(|places| places.len() > 1) {
                let fault = Fault::LabelTwice { name: name.into() };
                found.push(Diagnostic { fault, span, related: std::mem::take(places) });
            }
        }
    }
    found
}

/// A call: the place of its procedure, its name, where it stands, and how much it counts.
type Step<'p> = (usize, &'p str, Span, usize);

/// How deep the calls of a procedure go, and by which of them.
type Deep<'p> = (usize, Option<Step<'p>>);

/// Calls within one another that are followed; no control has so many.
const DEEPEST: usize = 64;

/// How deep the calls of the main program go within one another, and the first call beyond `most` of them: its name and
/// its place. Only calls that `counts` are counted. `None` where none goes that deep; calls that come back to their own
/// program are reported by what executes them.
pub fn deeper_calls(
    program: &Program,
    most: usize,
    counts: fn(&Call) -> bool,
) -> Option<(usize, &str, Span)> {
    fn calls<'p>(body: &'p [Stmt], found: &mut Vec<(&'p Call, Span)>) {
        for stmt in body {
            match &stmt.op {
                Op::Call(call) => found.push((call, stmt.span)),
                Op::Control(control) => control.bodies().for_each(|body| calls(body, found)),
                _ => {}
            }
        }
    }
    let mut places = HashMap::new();
    for (at, procedure) in program.procedures.iter().enumerate().skip(1) {
        places.entry(&*procedure.name).or_insert(at);
    }
    let calls_of = |at: usize| {
        let mut found = Vec::new();
        calls(&program.procedures[at].body, &mut found);
        let known = found.into_iter().filter_map(|(call, span)| {
            Some((*places.get(&*call.name)?, &*call.name, span, usize::from(counts(call))))
        });
        let mut known: Vec<Step> = known.collect();
        known.sort_by_key(|(to, _, _, counted)| (*to, *counted));
        known.dedup_by_key(|(to, _, _, counted)| (*to, *counted));
        known
    };
    // How deep the calls of each go, and by which of them; on the way to one, none is known of it.
    let mut deep: Vec<Option<Deep>> = vec![None; program.procedures.len()];
    let mut entered = vec![false; program.procedures.len()];
    let mut ahead = if deep.is_empty() { Vec::new() } else { vec![(0, None)] };
    while let Some((at, own)) = ahead.pop() {
        let Some(own) = own else {
            if !std::mem::replace(&mut entered[at], true) {
                let own = calls_of(at);
                let further: Vec<_> = own.iter().map(|(to, ..)| (*to, None)).collect();
                ahead.push((at, Some(own)));
                ahead.extend(further);
            }
            continue;
        };
        let below = own.iter().map(|call| (deep[call.0].map_or(0, |(deep, _)| deep) + call.3, Some(*call)));
        deep[at] = Some(below.max_by_key(|(deep, _)| *deep).unwrap_or((0, None)));
    }
    let mut at = deep.first().copied().flatten()?;
    let depth = at.0;
    if depth <= most {
        return None;
    }
    let mut steps = 0;
    while let Some((to, name, span, counted)) = at.1 {
        steps += counted;
        if steps > most {
            return Some((depth, name, span));
        }
        at = deep[to]?;
    }
    None
}

/// Procedures that nothing leads to from where the program begins, by their places: other programs may call them.
pub fn not_called(program: &Program) -> Vec<usize> {
    fn called<'p>(body: &'p [Stmt], names: &mut Vec<&'p str>) {
        for stmt in body {
            match &stmt.op {
                Op::Call(call) => names.push(&call.name),
                Op::Control(control) => control.bodies().for_each(|body| called(body, names)),
                _ => {}
            }
        }
    }
    let all = &program.procedures;
    let mut reached = vec![false; all.len()];
    let mut places: HashMap<&str, Vec<usize>> = HashMap::new();
    for (at, procedure) in all.iter().enumerate().skip(1) {
        places.entry(&procedure.name).or_default().push(at);
    }
    let mut ahead = if all.is_empty() { Vec::new() } else { vec![0] };
    while let Some(at) = ahead.pop() {
        if std::mem::replace(&mut reached[at], true) {
            continue;
        }
        let mut names = Vec::new();
        called(&all[at].body, &mut names);
        ahead.extend(names.into_iter().flat_map(|name| places.get(name).into_iter().flatten()));
    }
    (0..all.len()).filter(|at| !reached[*at]).collect()
}

fn labels_of<'p>(body: &'p [Stmt], labels: &mut HashSet<&'p str>) {
    for stmt in body {
        match &stmt.op {
            Op::Label(name) => _ = labels.insert(name),
            Op::Control(control) => control.bodies().for_each(|body| labels_of(body, labels)),
            _ => {}
        }
    }
}

fn within(names: &HashSet<&str>, body: &[Stmt], labels: &HashSet<&str>, found: &mut Vec<Diagnostic>) {
    for stmt in body {
        let missing = match &stmt.op {
            Op::Call(call) if !names.contains(&*call.name) => Fault::CallUnknown { name: call.name.clone() },
            Op::Goto(label) if !labels.contains(&**label) => Fault::LabelUnknown { name: label.clone() },
            Op::Control(control) => {
                control.bodies().for_each(|body| within(names, body, labels, found));
                continue;
            }
            _ => continue,
        };
        found.push(Diagnostic::new(missing, stmt.span));
    }
}
