//! What a code does besides its name, written as words where the target's control does not do the same.
//!
//! A Haas switches spindle and coolant off at M00, LinuxCNC does not:
//!
//! ```text
//! M00            M05 M09
//!           →    M00            for a control that lets them go on
//!
//! M00            M00
//! G01 X20.  →    M03            for a control that switches them off, of a source that does not
//!                G01 X20.
//! ```
//!
//! The spindle starts again before the next cut, and only there: not while somebody has a hand in the machine.
//! It is reported. Before a tool change Z goes to machine zero in words where the source's control goes there by
//! itself. What is open on the target's side is written so that it is the same under all values.
//!
//! Not here: what the executor makes of it (`exec`), and a spindle that turns on over a change (`tool_change`).

use crate::behaviour::{Behaviour, Behaviours};
use crate::canon::{AXES, Axis};
use crate::diag::{Diagnostic, Fault};
use crate::kinds::{drilling, flow, moves, polar};
use crate::num::Num;
use crate::program::{Op, Point, Procedure, Reference, ReferencePoint, Stmt};

/// What is known of a switch.
#[derive(Clone, Debug, Default, PartialEq)]
enum Switch {
    /// Off.
    #[default]
    Off,
    /// On, by these operations.
    On(Vec<Op>),
    /// Nothing: the program came from elsewhere.
    Unknown,
}

/// Writes what codes do besides their names, statement by statement.
#[derive(Clone, Debug)]
pub struct SideEffects {
    source: Behaviours,
    target: Behaviours,
    spindle: Switch,
    coolant: Switch,
    /// Switched off by the target's control alone: to be started again before the next cut.
    again: [Option<(Behaviour, Vec<Op>)>; 2],
    /// Z is at machine zero, or where the operator has left it.
    z_home: bool,
    /// The next straight move is in machine coordinates.
    machine: bool,
}

/// Spindle, coolant: what each does at a stop, at a change and at the end.
const STOP: [Behaviour; 2] = [Behaviour::SpindleAtStop, Behaviour::CoolantAtStop];
const CHANGE: [Behaviour; 2] = [Behaviour::SpindleAtChange, Behaviour::CoolantAtChange];
const END: [Behaviour; 2] = [Behaviour::SpindleAtEnd, Behaviour::CoolantAtEnd];

impl SideEffects {
    /// At the start of a main program: everything is off.
    pub fn new(source: Behaviours, target: Behaviours) -> SideEffects {
        SideEffects {
            source,
            target,
            spindle: Switch::Off,
            coolant: Switch::Off,
            again: [None, None],
            z_home: true,
            machine: false,
        }
    }

    /// Whether further statements would be rewritten.
    pub fn touches(&self, stmts: &[Stmt]) -> bool {
        self.source != self.target
            && (self.again.iter().any(Option::is_some) || stmts.iter().any(|stmt| is_code(&stmt.op)))
    }

    /// Rewrites further statements of the main procedure.
    pub fn over(&mut self, stmts: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
        if !self.touches(stmts) {
            return stmts.iter().for_each(|stmt| self.note(stmt));
        }
        let mut made: Vec<Stmt> = Vec::with_capacity(stmts.len() + 8);
        for mut stmt in std::mem::take(stmts) {
            if let Op::Control(control) = &mut stmt.op {
                self.again_before(&mut made, &mut stmt.joined, diags, stmt.span);
                for body in control.bodies_mut() {
                    self.elsewhere();
                    self.over(body, diags);
                }
                self.elsewhere();
                made.push(stmt);
                continue;
            }
            self.statement(stmt, &mut made, diags);
        }
        *stmts = made;
    }

    /// Rewrites the bodies of procedures; what their callers have switched on is not known.
    pub fn run(&mut self, procedures: &mut [Procedure], diags: &mut Vec<Diagnostic>) {
        for (at, procedure) in procedures.iter_mut().enumerate() {
            if at > 0 {
                self.elsewhere();
            }
            self.over(&mut procedure.body, diags);
        }
    }

    /// Control comes from elsewhere.
    fn elsewhere(&mut self) {
        (self.spindle, self.coolant) = (Switch::Unknown, Switch::Unknown);
        self.again = [None, None];
        (self.z_home, self.machine) = (false, false);
    }

    fn statement(&mut self, mut stmt: Stmt, made: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
        match &stmt.op {
            Op::ProgramStop => self.switch(STOP, false, &mut stmt, made, diags),
            Op::OptionalProgramStop => self.switch(STOP, true, &mut stmt, made, diags),
            Op::ChangeTool => {
                self.switch(CHANGE, false, &mut stmt, made, diags);
                self.go_home(&mut stmt, made, diags);
            }
            Op::ProgramEnd => self.switch(END, false, &mut stmt, made, diags),
            op if cuts(op) => self.again_before(made, &mut stmt.joined, diags, stmt.span),
            _ => {}
        }
        self.note(&stmt);
        made.push(stmt);
    }

    /// Spindle and coolant at a code.
    fn switch(
        &mut self,
        both: [Behaviour; 2],
        optional: bool,
        stmt: &mut Stmt,
        made: &mut Vec<Stmt>,
        diags: &mut Vec<Diagnostic>,
    ) {
        let mut off = Vec::new();
        for (at, behaviour) in both.into_iter().enumerate() {
            let state = if at == 0 { &self.spindle } else { &self.coolant };
            if *state == Switch::Off {
                continue;
            }
            let source_stops = self.source.surely(behaviour);
            // Where Z goes home in words, the spindle stops in words before that.
            let target_stops = self.target.surely(behaviour) && !(both == CHANGE && self.goes_home());
            let state = if at == 0 { &mut self.spindle } else { &mut self.coolant };
            if source_stops && !target_stops {
                off.push((behaviour, if at == 0 { Op::StopSpindleTurning } else { Op::CoolantOff }));
                // An optional stop that is not made leaves it on in the source.
                if let (true, Switch::On(ops)) = (optional, &*state) {
                    self.again[at] = Some((behaviour, ops.clone()));
                } else if !optional {
                    *state = Switch::Off;
                }
                continue;
            }
            if source_stops && !optional {
                *state = Switch::Off;
                continue;
            }
            // The source surely lets it go on, or usually; a spindle that turns over a change is refused elsewhere.
            let other = target_stops && !source_stops
                || self.target.is_open(behaviour) && !self.source.is_open(behaviour) && !source_stops;
            let restarts = behaviour != Behaviour::SpindleAtChange && both != END;
            if let (true, true, Switch::On(ops)) = (other, restarts, &*state) {
                self.again[at] = Some((behaviour, ops.clone()));
            }
        }
        let at = insertion(made, stmt);
        let found = off.iter().map(|(behaviour, _)| {
            Diagnostic::new(Fault::SideEffectWritten { behaviour: *behaviour }, stmt.span)
        });
        diags.extend(found);
        let new = off.into_iter().enumerate().map(|(place, (_, op))| Stmt {
            joined: place > 0,
            skip: stmt.skip,
            ..Stmt::new(stmt.span, op)
        });
        insert(made, stmt, at, new.collect());
    }

    /// Whether Z goes to machine zero in words before a tool change.
    fn goes_home(&self) -> bool {
        let behaviour = Behaviour::ZAtChange;
        self.source.surely(behaviour) && !self.target.surely(behaviour) && !self.z_home
    }

    /// Z at a tool change.
    fn go_home(&mut self, stmt: &mut Stmt, made: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
        let behaviour = Behaviour::ZAtChange;
        let (source, target) = (self.source.surely(behaviour), self.target.surely(behaviour));
        if target && !source && !self.z_home {
            diags.push(Diagnostic::new(Fault::MovedAtChange, stmt.span));
        }
        if self.goes_home() {
            let mut axes = [false; AXES];
            axes[Axis::Z as usize] = true;
            let home =
                Reference { point: ReferencePoint::Home, axes, via: Point::default(), keeps_length: true };
            let home = Stmt { skip: stmt.skip, ..Stmt::new(stmt.span, Op::GoToReference(Box::new(home))) };
            diags.push(Diagnostic::new(Fault::SideEffectWritten { behaviour }, stmt.span));
            let at = insertion(made, stmt);
            insert(made, stmt, at, vec![home]);
        }
        self.z_home |= source || target;
    }

    /// Starts again what the target's control alone has switched off, before a block that cuts.
    fn again_before(
        &mut self,
        made: &mut Vec<Stmt>,
        joined: &mut bool,
        diags: &mut Vec<Diagnostic>,
        span: crate::source::Span,
    ) {
        if self.again.iter().all(Option::is_none) {
            return;
        }
        let mut at = made.len();
        if *joined {
            at = (0..made.len()).rev().find(|at| !made[*at].joined).unwrap_or(0);
        }
        let mut new = Vec::new();
        for (behaviour, ops) in self.again.iter_mut().filter_map(Option::take) {
            diags.push(Diagnostic::new(Fault::StartedAgain { behaviour }, span));
            new.extend(ops.into_iter().map(|op| Stmt::new(span, op)));
        }
        for (place, stmt) in new.iter_mut().enumerate() {
            stmt.joined = place > 0;
        }
        // The block keeps its number and its jump target at the first of its statements.
        made.splice(at..at, new);
    }

    /// What a statement leaves on.
    fn note(&mut self, stmt: &Stmt) {
        let sure = stmt.skip.is_none();
        let [spindle, coolant] = &mut self.again;
        match &stmt.op {
            op @ (Op::StartSpindleClockwise | Op::StartSpindleCounterclockwise) => {
                self.spindle = if sure { Switch::On(vec![op.clone()]) } else { Switch::Unknown };
                *spindle = spindle.take().filter(|_| !sure);
            }
            Op::StopSpindleTurning | Op::OrientSpindle(_) => {
                self.spindle = if sure { Switch::Off } else { Switch::Unknown };
                *spindle = spindle.take().filter(|_| !sure);
            }
            Op::StartCycle(cycle) if cycle.kind.drives_spindle() => self.spindle = Switch::Unknown,
            op @ (Op::FloodOn | Op::MistOn) => {
                self.coolant = match (std::mem::take(&mut self.coolant), sure) {
                    (Switch::Off, true) => Switch::On(vec![op.clone()]),
                    (Switch::On(mut ops), true) => {
                        if !ops.contains(op) {
                            ops.push(op.clone());
                        }
                        Switch::On(ops)
                    }
                    (Switch::Unknown, _) | (_, false) => Switch::Unknown,
                };
                *coolant = coolant.take().filter(|_| !sure);
            }
            Op::CoolantOff => {
                self.coolant = if sure { Switch::Off } else { Switch::Unknown };
                *coolant = coolant.take().filter(|_| !sure);
            }
            Op::ProgramEnd if sure => (self.spindle, self.coolant) = (Switch::Off, Switch::Off),
            flow!() => self.elsewhere(),
            _ => {}
        }
        self.note_z(stmt);
    }

    fn note_z(&mut self, stmt: &Stmt) {
        let sure = stmt.skip.is_none();
        match &stmt.op {
            Op::GoToReference(to) if to.axes[Axis::Z as usize] => {
                self.z_home = sure && to.point == ReferencePoint::Home;
            }
            Op::UseMachineCoordinates { length: false } => {
                self.machine = sure;
                return;
            }
            Op::StraightTraverse(to) if self.machine && to.to.get(Axis::Z).is_some() => {
                let zero = |n: Num| n.mantissa == 0;
                let word = to.to.get(Axis::Z).and_then(|word| word.value.literal());
                self.z_home = word.is_some_and(zero);
            }
            op if commands_z(op) => self.z_home = false,
            _ => {}
        }
        self.machine = false;
    }
}

/// Whether a code does something besides its name on some control.
fn is_code(op: &Op) -> bool {
    match op {
        Op::ProgramStop | Op::OptionalProgramStop | Op::ChangeTool | Op::ProgramEnd => true,
        Op::Control(control) => control.bodies().any(|body| body.iter().any(|stmt| is_code(&stmt.op))),
        _ => false,
    }
}

/// Whether a statement cuts, or may.
fn cuts(op: &Op) -> bool {
    !matches!(op, Op::StraightTraverse(_) | Op::SetPole(_))
        && matches!(op, Op::Position(_) | drilling!() | moves!() | polar!() | flow!())
}

/// Whether a statement commands Z, or may.
fn commands_z(op: &Op) -> bool {
    match op {
        Op::StraightTraverse(to) | Op::StraightFeed(to) | Op::Position(to) => to.to.get(Axis::Z).is_some(),
        Op::GoToReference(to) => to.axes[Axis::Z as usize] || to.via.get(Axis::Z).is_some(),
        op => cuts(op),
    }
}

/// Where statements before a code go: before its block, where nothing of that happens before it but the selection of a
/// tool; else right before it.
fn insertion(made: &[Stmt], stmt: &Stmt) -> usize {
    if !stmt.joined {
        return made.len();
    }
    let first = (0..made.len()).rev().find(|at| !made[*at].joined).unwrap_or(0);
    let selects =
        |op: &Op| matches!(op, Op::SelectTool(_) | Op::SelectToolByName(_) | Op::Comment(_) | Op::Blank);
    match made[first..].iter().all(|stmt| selects(&stmt.op)) {
        true => first,
        false => made.len(),
    }
}

/// Puts new blocks in. A block that is cut there goes on in one of its own.
fn insert(made: &mut Vec<Stmt>, stmt: &mut Stmt, at: usize, new: Vec<Stmt>) {
    if new.is_empty() {
        return;
    }
    if at == made.len() {
        stmt.joined = false;
    }
    made.splice(at..at, new);
}
