//! A program lowered for execution: a flat list of steps with resolved jump targets.
//!
//! Names of procedures, labels and variables are looked up here, once. Not here: running (`run`).

use std::collections::HashMap;
use std::rc::Rc;

use crate::run::repeated;
use crate::run::term::{Indexed, Names, Place, Term};
use ncc_ir::expr::{Expr, Target};
use ncc_ir::program::arguments;
use ncc_ir::program::packed::PackedLines;
use ncc_ir::program::shapes::{WordRole, WordShape};
use ncc_ir::program::{Call, Control, Declare, Op, Procedure, Program, Stmt};

/// The place of a step in [`Code::steps`].
pub(crate) type At = u32;

/// A step. One stands for each statement, so it is kept small.
#[derive(Clone, Debug)]
pub(crate) enum Step<'p> {
    /// A statement that is executed by itself.
    Do(&'p Stmt),
    /// Straight moves and feeds that are packed, and the place of their shapes in [`Code::shapes`].
    Lines(&'p Stmt, &'p PackedLines, u32),
    /// One of which arguments are computed first: its place in [`Code::computed`].
    Compute(&'p Stmt, u32),
    /// A value for a variable; without a place it is one of the control's own.
    Assign(&'p Stmt, Box<(Option<Place>, Term)>),
    /// A value for one of many variables; `None` is an array that there cannot be.
    AssignElement(&'p Stmt, Box<(Option<Indexed>, Term)>),
    /// First values.
    Declare(&'p Stmt, Box<Declared>),
    /// Goes there, past a body, while the switch of the statement's level is on.
    Unskipped(&'p Stmt, At),
    /// Goes there unless this holds.
    Unless(&'p Stmt, Box<Term>, At),
    /// Goes there if a counter is beyond its end.
    UnlessCounted(&'p Stmt, Box<Counter>, At),
    /// Adds the pace to the counter.
    Count(&'p Stmt, Box<Counter>),
    /// Begins a body that is executed so many times; after it, there.
    Turns(&'p Stmt, Box<Term>, At),
    /// Another iteration of the body that begins there, if any are left.
    Again(&'p Stmt, At),
    /// Goes there.
    Jump(&'p Stmt, At),
    /// A jump of the program to a step, in so many open bodies that are counted; `None` is a label that it
    /// does not have.
    Goto(&'p Stmt, Option<(At, u32)>),
    /// A call.
    Call(&'p Stmt, Box<Called<'p>>),
    /// Back to the caller.
    Return(&'p Stmt),
    /// Steps that are executed again.
    Blocks(&'p Stmt, Box<Again>),
    /// The end of a procedure.
    End,
}

/// Variables that are made known, and their first values.
#[derive(Clone, Debug)]
pub(crate) struct Declared {
    /// The first and how many; `None` where there cannot be so many.
    pub(crate) places: Option<(Place, u32)>,
    /// What has none is zero.
    pub(crate) values: Box<[Option<Term>]>,
}

/// A counter, and where its end and its pace are kept.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counter {
    pub(crate) place: Place,
    pub(crate) end: Place,
    pub(crate) pace: Place,
}

/// Steps that are executed again.
#[derive(Clone, Debug)]
pub(crate) struct Again {
    /// From one to before another; `None` is a label that there is not.
    pub(crate) steps: Option<(At, At)>,
    pub(crate) times: Term,
    pub(crate) computed: bool,
    /// How many bodies of the procedure that are counted are open there.
    pub(crate) counted: u32,
}

/// What a call calls.
#[derive(Clone, Debug)]
pub(crate) struct Called<'p> {
    pub(crate) call: &'p Call,
    /// Where it begins; `None` is a procedure that the program does not have, or that has not as many
    /// parameters.
    pub(crate) entry: Option<At>,
    /// Values of its parameters.
    pub(crate) arguments: Vec<Term>,
    /// Where it has them.
    pub(crate) parameters: Rc<[Place]>,
}

/// A statement of which arguments are computed.
#[derive(Clone, Debug)]
pub(crate) struct Computed<'p> {
    pub(crate) stmt: &'p Stmt,
    /// In the order of [`arguments::each`]; what is written has none.
    pub(crate) terms: Box<[Option<Term>]>,
}

impl<'p> Step<'p> {
    /// The statement that it comes from; the end of a procedure comes from none.
    #[inline]
    pub(crate) fn stmt(&self) -> Option<&'p Stmt> {
        match self {
            Step::Do(stmt)
            | Step::Lines(stmt, ..)
            | Step::Compute(stmt, _)
            | Step::Assign(stmt, _)
            | Step::AssignElement(stmt, _)
            | Step::Declare(stmt, _)
            | Step::Unskipped(stmt, _)
            | Step::Unless(stmt, ..)
            | Step::UnlessCounted(stmt, ..)
            | Step::Count(stmt, _)
            | Step::Turns(stmt, ..)
            | Step::Goto(stmt, _)
            | Step::Call(stmt, _)
            | Step::Return(stmt)
            | Step::Blocks(stmt, ..)
            | Step::Jump(stmt, _)
            | Step::Again(stmt, _) => Some(stmt),
            Step::End => None,
        }
    }
}

/// A program made ready.
#[derive(Clone, Debug)]
pub(crate) struct Code<'p> {
    pub(crate) steps: Vec<Step<'p>>,
    pub(crate) computed: Vec<Computed<'p>>,
    /// Shapes of words of packed moves.
    pub(crate) shapes: Vec<Box<[(Term, WordRole)]>>,
    pub(crate) names: Names,
}

/// Where a label stands: its step, the bodies that it is in, and how many of them are counted.
type Labels<'p> = HashMap<&'p str, Vec<(At, Vec<u32>, u32)>>;

struct Maker<'p> {
    code: Code<'p>,
    /// Procedures by name, each with where it begins.
    entries: HashMap<&'p str, (At, &'p Procedure)>,
    calls: Vec<At>,
    // Of the procedure at hand.
    labels: Labels<'p>,
    jumps: Vec<(At, &'p str, Vec<u32>)>,
    /// Bodies that are open, each by its number.
    bodies: Vec<u32>,
    counted: u32,
    next_body: u32,
    /// Bodies that are executed again and again, the innermost last.
    turning: Vec<Turning>,
}

/// Steps that leave a body, or go to its next turn, and how many counted bodies were open outside and inside it.
#[derive(Debug, Default)]
struct Turning {
    leave: Vec<At>,
    next: Vec<At>,
    outside: u32,
    inside: u32,
}

impl<'p> Code<'p> {
    pub(crate) fn new(program: &'p Program) -> Code<'p> {
        let length = program.procedures.iter().map(|p| p.body.len() + 1).sum();
        let (steps, computed, shapes) = (Vec::with_capacity(length), Vec::new(), Vec::new());
        let code = Code { steps, computed, shapes, names: Names::default() };
        let mut maker = Maker {
            code,
            entries: HashMap::new(),
            calls: Vec::new(),
            labels: HashMap::new(),
            jumps: Vec::new(),
            bodies: Vec::new(),
            counted: 0,
            next_body: 0,
            turning: Vec::new(),
        };
        for (place, procedure) in program.procedures.iter().enumerate() {
            if place > 0 {
                let here = maker.here();
                maker.entries.entry(&procedure.name).or_insert((here, procedure));
            }
            maker.procedure(procedure);
        }
        if program.procedures.is_empty() {
            maker.code.steps.push(Step::End);
        }
        maker.join_calls();
        maker.code
    }
}

impl<'p> Maker<'p> {
    fn procedure(&mut self, procedure: &'p Procedure) {
        self.labels.clear();
        self.jumps.clear();
        self.turning.clear();
        self.body(&procedure.body);
        self.code.steps.push(Step::End);
        for (at, name, from) in std::mem::take(&mut self.jumps) {
            let there = self.labels.get(name).map_or(&[][..], |labels| labels);
            // Into a body there is no way but its beginning.
            let mut reached = there.iter().filter(|(_, bodies, _)| from.starts_with(bodies));
            let forward = reached.clone().find(|(to, ..)| *to > at);
            let found = forward.or_else(|| reached.next()).map(|(to, _, counted)| (*to, *counted));
            if let Step::Goto(_, to) = &mut self.code.steps[at as usize] {
                *to = found;
            }
        }
    }

    fn join_calls(&mut self) {
        let Code { steps, names, .. } = &mut self.code;
        for at in std::mem::take(&mut self.calls) {
            if let Step::Call(_, called) = &mut steps[at as usize]
                && let Some((entry, procedure)) = self.entries.get(&*called.call.name)
                && called.arguments.len() <= procedure.parameters.len()
            {
                let places = procedure.parameters.iter().map(|parameter| names.place(parameter));
                if let Some(places) = places.collect() {
                    called.parameters = places;
                    called.entry = Some(*entry);
                }
            }
        }
    }

    fn here(&self) -> At {
        At::try_from(self.code.steps.len()).unwrap_or(At::MAX)
    }

    fn body(&mut self, body: &'p [Stmt]) {
        self.bodies.push(self.next_body);
        self.next_body += 1;
        // Where each statement begins.
        let mut begins = Vec::with_capacity(body.len());
        for (place, stmt) in body.iter().enumerate() {
            begins.push(self.here());
            self.stmt(stmt, body, place, &begins);
        }
        self.bodies.pop();
    }

    fn stmt(&mut self, stmt: &'p Stmt, body: &'p [Stmt], place: usize, begins: &[At]) {
        let at = self.here();
        let step = match &stmt.op {
            Op::Control(control) => return self.control(stmt, control),
            Op::Assign(Target::Var(to), value) => {
                let to = self.code.names.place(to);
                Step::Assign(stmt, Box::new((to, self.code.names.term(value))))
            }
            Op::Assign(Target::Element(to), value) => {
                let to = self.code.names.element(to);
                Step::AssignElement(stmt, Box::new((to, self.code.names.term(value))))
            }
            Op::Declare(declare) => Step::Declare(stmt, Box::new(self.declare(declare))),
            Op::Leave => {
                if let Some(turning) = self.turning.last_mut() {
                    turning.leave.push(at);
                }
                Step::Goto(stmt, None)
            }
            Op::NextTurn => {
                if let Some(turning) = self.turning.last_mut() {
                    turning.next.push(at);
                }
                Step::Goto(stmt, None)
            }
            Op::Goto(label) => {
                self.jumps.push((at, label, self.bodies.clone()));
                Step::Goto(stmt, None)
            }
            Op::Label(name) => {
                self.labels.entry(name).or_default().push((at, self.bodies.clone(), self.counted));
                Step::Do(stmt)
            }
            Op::Call(call) => {
                let arguments = call.arguments.iter().map(|value| self.code.names.term(value)).collect();
                self.calls.push(at);
                Step::Call(stmt, Box::new(Called { call, entry: None, arguments, parameters: Rc::new([]) }))
            }
            Op::Return => Step::Return(stmt),
            Op::Lines(lines) => {
                let names = &mut self.code.names;
                let term = |shape: &WordShape| (names.term(shape.expr()), shape.role());
                let shapes = lines.shapes().iter().map(term).collect();
                self.code.shapes.push(shapes);
                Step::Lines(stmt, lines, self.code.shapes.len() as u32 - 1)
            }
            Op::RepeatBlocks(repeat) => {
                let blocks = repeated::blocks_again(body, place, &repeat.from, repeat.to.as_deref());
                let steps = blocks.map(|blocks| (begins[blocks.start], begins[blocks.end]));
                let computed = repeat.times.literal().is_none();
                let times = self.code.names.term(&repeat.times);
                Step::Blocks(stmt, Box::new(Again { steps, times, computed, counted: self.counted }))
            }
            op if arguments::computed(op) => {
                let mut terms = Vec::new();
                let names = &mut self.code.names;
                arguments::each(&mut op.clone(), &mut |argument, _| {
                    let node = argument.expr().filter(|e| matches!(e, Expr::Node(_)));
                    terms.push(node.map(|e| names.term(e)));
                    Ok::<(), std::convert::Infallible>(())
                })
                .unwrap_or_else(|never| match never {});
                self.code.computed.push(Computed { stmt, terms: terms.into() });
                Step::Compute(stmt, self.code.computed.len() as u32 - 1)
            }
            _ => Step::Do(stmt),
        };
        self.code.steps.push(step);
    }

    fn declare(&mut self, declare: &Declare) -> Declared {
        let names = &mut self.code.names;
        let places = match &*declare.sizes {
            [] => names.place(&declare.var).map(|place| (place, 1)),
            sizes => names.array(&declare.var, sizes),
        };
        let values = declare.initial.iter().map(|value| value.as_ref().map(|value| names.term(value)));
        Declared { places, values: values.collect() }
    }

    /// A body that is executed again and again; `counted` if its turns are.
    fn turns(&mut self, body: &'p [Stmt], counted: bool) {
        let outside = self.counted;
        self.counted += u32::from(counted);
        let inside = self.counted;
        self.turning.push(Turning { outside, inside, ..Turning::default() });
        self.body(body);
        self.counted = outside;
    }

    /// The next iteration of the body begins here.
    fn next_turn_here(&mut self) {
        let here = self.here();
        if let Some(turning) = self.turning.last_mut() {
            let inside = turning.inside;
            for at in std::mem::take(&mut turning.next) {
                self.goes(at, here, inside);
            }
        }
    }

    /// After the body; the next turn is begun at `head`, if it was not said where.
    fn left_here(&mut self, head: At) {
        let here = self.here();
        if let Some(turning) = self.turning.pop() {
            turning.next.iter().for_each(|at| self.goes(*at, head, turning.inside));
            turning.leave.iter().for_each(|at| self.goes(*at, here, turning.outside));
        }
    }

    fn goes(&mut self, at: At, there: At, counted: u32) {
        if let Step::Goto(_, to) = &mut self.code.steps[at as usize] {
            *to = Some((there, counted));
        }
    }

    fn control(&mut self, stmt: &'p Stmt, control: &'p Control) {
        let switch = stmt.skip.map(|_| self.push(Step::Unskipped(stmt, 0)));
        match control {
            Control::Repeat { times, body } => {
                let times = self.code.names.term(times);
                let head = self.push(Step::Turns(stmt, Box::new(times), 0));
                self.turns(body, true);
                self.next_turn_here();
                self.push(Step::Again(stmt, head + 1));
                self.ends_here(head);
                self.left_here(head);
            }
            Control::Loop { body } => {
                let head = self.here();
                self.turns(body, false);
                self.push(Step::Jump(stmt, head));
                self.left_here(head);
            }
            Control::While { condition, body } => {
                let condition = self.code.names.term(condition);
                let head = self.push(Step::Unless(stmt, Box::new(condition), 0));
                self.turns(body, false);
                self.push(Step::Jump(stmt, head));
                self.ends_here(head);
                self.left_here(head);
            }
            Control::Until { condition, body } => {
                let head = self.here();
                self.turns(body, false);
                self.next_turn_here();
                let condition = self.code.names.term(condition);
                self.push(Step::Unless(stmt, Box::new(condition), head));
                self.left_here(head);
            }
            Control::For { variable, from, to, step, body } => {
                let place = self.code.names.place(variable);
                let end = Place::Local(self.code.names.unnamed());
                let pace = Place::Local(self.code.names.unnamed());
                for (place, value) in [(place, from), (Some(end), to), (Some(pace), step)] {
                    let value = self.code.names.term(value);
                    self.push(Step::Assign(stmt, Box::new((place, value))));
                }
                // One of the control's own is refused where it is set.
                let counter = Box::new(Counter { place: place.unwrap_or(end), end, pace });
                let head = self.push(Step::UnlessCounted(stmt, counter.clone(), 0));
                self.turns(body, false);
                self.next_turn_here();
                self.push(Step::Count(stmt, counter));
                self.push(Step::Jump(stmt, head));
                self.ends_here(head);
                self.left_here(head);
            }
            Control::If { condition, then, otherwise } => {
                let condition = self.code.names.term(condition);
                let head = self.push(Step::Unless(stmt, Box::new(condition), 0));
                self.body(then);
                if otherwise.is_empty() {
                    self.ends_here(head);
                } else {
                    let over = self.push(Step::Jump(stmt, 0));
                    self.ends_here(head);
                    self.body(otherwise);
                    self.ends_here(over);
                }
            }
        }
        if let Some(switch) = switch {
            self.ends_here(switch);
        }
    }

    fn push(&mut self, step: Step<'p>) -> At {
        self.code.steps.push(step);
        self.here() - 1
    }

    /// Lets a step that goes somewhere go to what comes next.
    fn ends_here(&mut self, at: At) {
        let here = self.here();
        match &mut self.code.steps[at as usize] {
            Step::Unskipped(_, to)
            | Step::Unless(_, _, to)
            | Step::UnlessCounted(_, _, to)
            | Step::Turns(_, _, to)
            | Step::Jump(_, to) => *to = here,
            Step::Do(_)
            | Step::Lines(..)
            | Step::Compute(..)
            | Step::Assign(..)
            | Step::AssignElement(..)
            | Step::Declare(..)
            | Step::Count(..)
            | Step::Again(..)
            | Step::Goto(..)
            | Step::Call(..)
            | Step::Return(_)
            | Step::Blocks(..)
            | Step::End => {}
        }
    }
}
