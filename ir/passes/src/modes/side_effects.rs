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

mod again;
mod arc_feed;
mod beside;
mod cycle_at_change;
mod insert;
mod joins;
mod kinds;
mod length;
mod way_up;

use crate::modes::fine_digits;
use crate::pass::Pass;
use crate::support::mode_analysis::Known;
use crate::tools::tool_words::ToolWords;
use ncc_exec::Increments;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::{AXES, Axis, Spindle};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Num;
use ncc_ir::geometry::arc_feed::ArcFeed;
use ncc_ir::lack::CompensationLack;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{
    Control, FrameSlot, Lines, Op, Point, Procedure, Reference, ReferencePoint, Slot, Stmt,
};
use ncc_ir::source::Span;

use arc_feed::{compensated, states};
use beside::stands_alone;
use cycle_at_change::Cycle;
use insert::{insert, insertion};
use joins::{KeepsLength, LeftAtPlace, Length, either, only_sense};
use kinds::{at_end, commands_z, cuts, is_code, is_zero, starts_spindle, switches};
use way_up::WayUp;

/// This pass.
pub(crate) const PASS: Pass = Pass::named(
    "side-effects",
    "writes in words what codes of the source's control do besides their names",
    None,
);

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
    /// Shifts that may be active.
    shifts: Vec<FrameSlot>,
    /// What activates the active length; `None` is none.
    length: Option<Op>,
    /// Whether the active length is known.
    length_known: bool,
    /// What the length needs before the next move of Z.
    length_next: Option<LengthNext>,
    /// The operation that starts the spindle, where a whole program has no other one: a spindle that may turn turns by
    /// this.
    only_sense: Option<Op>,
    /// Digits that the source's control cuts off.
    fine: fine_digits::FineDigitsState,
    tools: ToolWords,
    /// What F counts on arcs in the source, to be stated before compensation starts; `None`: the same in the target, or the
    /// target has no code for it.
    arc_feed: Option<ArcFeed>,
    /// Whether a code states it on every path to here.
    arc_feed_said: bool,
    /// Whether it is stated where the program begins.
    arc_feed_at_head: bool,
    /// Procedures that end at a place of the machine along Z.
    left_at_place: LeftAtPlace,
    /// Procedures that leave the length of their caller active.
    keeps_length: KeepsLength,
    way_up: WayUp,
    /// Whether cutter radius compensation may be on.
    beside: bool,
    /// What holds after each call and label of a program with compensation that is kept whole.
    entries: Option<Known>,
    /// Control has come from elsewhere to the next statement.
    entered: bool,
    /// An optional stop that stops a spindle of which it is not known whether it turns, and no spindle code since.
    lost_stop: Option<Span>,
    /// Words of this pass have stopped the spindle before a stop, and nothing starts it since: M05 of the program is one
    /// too many.
    stopped_in_words: bool,
    /// The statement that began the block at hand was left out.
    opens: bool,
    /// The canned cycle, at a tool change.
    cycle: Cycle,
}

/// What the length of the tool needs before the next move of Z, after a place of the machine.
#[derive(Clone, Debug)]
enum LengthNext {
    /// To be stated, by this operation.
    Say(Op),
    /// To be asked of the source's control.
    Ask(Behaviour, Span),
    /// To be stated, and it is not known which it is.
    Lost(Span),
}

/// Spindle, coolant: what each does at a stop, at a change and at the end.
const STOP: [Behaviour; 2] = [Behaviour::SpindleAtStop, Behaviour::CoolantAtStop];
const CHANGE: [Behaviour; 2] = [Behaviour::SpindleAtChange, Behaviour::CoolantAtChange];
const END: [Behaviour; 2] = [Behaviour::SpindleAtEnd, Behaviour::CoolantAtEnd];

impl SideEffects {
    /// At the start of a main program: everything is off. `increments` are the source's.
    pub fn new(source: Behaviours, target: Behaviours, increments: Option<Increments>) -> SideEffects {
        SideEffects {
            source,
            target,
            spindle: Switch::Off,
            coolant: Switch::Off,
            again: [None, None],
            z_home: true,
            machine: false,
            shifts: Vec::new(),
            length: None,
            length_known: true,
            length_next: None,
            only_sense: None,
            fine: fine_digits::FineDigitsState::new(&source, &target, increments),
            tools: ToolWords::default(),
            arc_feed: None,
            arc_feed_said: false,
            arc_feed_at_head: false,
            left_at_place: LeftAtPlace::new(),
            keeps_length: KeepsLength::new(),
            way_up: WayUp::default(),
            beside: false,
            entries: None,
            entered: false,
            lost_stop: None,
            stopped_in_words: false,
            opens: false,
            cycle: Cycle::default(),
        }
    }

    /// Words of one side move Z to machine zero before each tool change, the first one included.
    #[must_use]
    pub fn with_words_at_change(mut self) -> SideEffects {
        self.z_home = false;
        self
    }

    /// Passes over statements that go along lines alone, if none of them would be rewritten.
    pub fn passes(&mut self, lines: Lines) -> bool {
        let busy = self.fine.is_used()
            || self.machine
            || self.length_next.is_some()
            || self.way_up.is_up()
            || self.lost_stop.is_some()
            || self.again.iter().any(Option::is_some);
        if !busy {
            self.z_home &= !lines.names(Axis::Z);
        }
        !busy
    }

    /// Whether further statements would be rewritten.
    pub fn touches(&self, stmts: &[Stmt]) -> bool {
        self.fine.touches(stmts)
            || self.way_up.concerns(stmts)
            || self.source != self.target
                && (self.again.iter().any(Option::is_some)
                    || self.lost_stop.is_some()
                    || self.length_next.is_some()
                    || self.cycle.is_busy()
                    || self.states_arc_feed(stmts)
                    || stmts.iter().any(|stmt| is_code(&stmt.op)))
    }

    /// Rewrites further statements of the main procedure.
    pub fn write_effects(&mut self, stmts: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
        self.way_up.check(stmts, &[], diags);
        self.rewrite(stmts, diags);
    }

    fn rewrite(&mut self, stmts: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
        self.fine.cut_digits(stmts, diags);
        if !self.touches(stmts) {
            return stmts.iter().for_each(|stmt| self.note(stmt));
        }
        let mut made: Vec<Stmt> = Vec::with_capacity(stmts.len() + 8);
        let unread = joins::unread_at_labels(stmts);
        for mut stmt in std::mem::take(stmts) {
            if unread.contains(&stmt.span.start) {
                self.length_next = None;
            }
            self.tools.before(&stmt, &mut made);
            self.needs_cycle(&stmt.op, diags);
            if let Op::Control(control) = &mut stmt.op {
                self.again_before(&mut made, &mut stmt.joined, diags, (stmt.span, false));
                if let Some(at) = control.bodies().find_map(|body| compensated(body)) {
                    self.state_arc_feed(&mut stmt.joined, at, &mut made, diags);
                }
                let Op::Control(control) = &mut stmt.op else { continue };
                let keeps = !control.bodies().any(|body| body.iter().any(|stmt| switches(&stmt.op)));
                let length = self.length_into(control, stmt.span);
                let mut left = [None, None];
                let mut after = (!matches!(&**control, Control::If { .. })).then(|| length.next.clone());
                for body in control.bodies_mut() {
                    self.enter(keeps);
                    self.take_length(&length);
                    self.rewrite(body, diags);
                    // What a stop in a body has switched off may be off after it.
                    for (left, own) in left.iter_mut().zip(&mut self.again) {
                        *left = left.take().or(own.take());
                    }
                    let own = self.length_next.take();
                    after = Some(match after {
                        None => own,
                        Some(other) => either(own, other, &length, stmt.span),
                    });
                }
                self.enter(keeps);
                self.again = left;
                self.take_length(&Length { next: after.flatten(), ..length });
                made.push(stmt);
                continue;
            }
            self.statement(stmt, &mut made, diags);
        }
        self.tools.finish(&mut made);
        *stmts = made;
    }

    /// Rewrites the bodies of procedures; what their callers have switched on is not known.
    pub fn run(&mut self, procedures: &mut [Procedure], diags: &mut Vec<Diagnostic>) {
        self.only_sense = only_sense(procedures);
        self.tools.survey(procedures);
        self.arc_feed_at_head(procedures, diags);
        self.left_at_place = joins::left_at_place(procedures);
        self.keeps_length = joins::keeps_length(procedures);
        if let Some((main, _)) = procedures.split_first() {
            self.way_up.check(&main.body, procedures, diags);
        }
        self.entries = self.entries_of(procedures);
        for (at, procedure) in procedures.iter_mut().enumerate() {
            if at > 0 {
                self.elsewhere();
            }
            // What the length needs at its end, it needs at the caller's next move of Z.
            let end = procedure.body.pop_if(|stmt| at > 0 && matches!(stmt.op, Op::Return) && !stmt.joined);
            self.rewrite(&mut procedure.body, diags);
            if at > 0 {
                let span = procedure.body.last().map_or(Span::default(), |stmt| stmt.span);
                self.again_before(&mut procedure.body, &mut false, diags, (span, false));
            }
            procedure.body.extend(end);
        }
    }

    /// A body begins, or ends, that may be executed several times or not at all; `keeps`: it switches nothing.
    fn enter(&mut self, keeps: bool) {
        (self.entered, self.stopped_in_words) = (true, false);
        if keeps {
            (self.z_home, self.machine) = (false, false);
        } else {
            self.elsewhere();
        }
    }

    /// Control comes from elsewhere.
    fn elsewhere(&mut self) {
        (self.entered, self.stopped_in_words) = (true, false);
        (self.spindle, self.coolant) = (Switch::Unknown, Switch::Unknown);
        self.again = [None, None];
        self.tools.elsewhere();
        (self.z_home, self.machine) = (false, false);
        (self.length, self.length_known, self.length_next) = (None, false, None);
    }

    fn statement(&mut self, mut stmt: Stmt, made: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
        if std::mem::take(&mut self.opens) {
            stmt.joined = false;
        }
        let bare = stmt.skip.is_none() && stmt.number.is_none() && stmt.comment.is_none();
        if self.stopped_in_words && bare && matches!(stmt.op, Op::StopSpindleTurning) {
            self.opens = !stmt.joined;
            return self.note(&stmt);
        }
        if std::mem::take(&mut self.entered)
            && let Some(at) = self.entries.as_ref().and_then(|known| known.before(&stmt))
        {
            self.beside = at.compensated;
            if at.spindle == Some(Spindle::Stopped) && self.spindle == Switch::Unknown {
                self.spindle = Switch::Off;
            }
        }
        self.length_before(&mut stmt, made, diags);
        match &stmt.op {
            Op::ProgramStop => self.switch(STOP, false, &mut stmt, made, diags),
            Op::OptionalProgramStop => self.switch(STOP, true, &mut stmt, made, diags),
            Op::ChangeTool => {
                self.tools.change([&self.source, &self.target], &mut stmt, made, diags);
                self.cancel_cycle(&mut stmt, made);
                self.switch(CHANGE, false, &mut stmt, made, diags);
                self.go_home(&mut stmt, made, diags);
            }
            Op::ProgramEnd => {
                self.switch(END, false, &mut stmt, made, diags);
                self.cancel_shifts(&mut stmt, made, diags);
            }
            Op::StartCutterRadiusCompensation { .. } => {
                self.state_arc_feed(&mut stmt.joined, stmt.span, made, diags);
            }
            op @ (Op::FloodOn | Op::MistOn) => {
                let op = op.clone();
                self.other_coolant_before(&op, &stmt, made, diags);
            }
            op if cuts(op) => {
                let label = matches!(op, Op::Label(_));
                self.again_before(made, &mut stmt.joined, diags, (stmt.span, label));
            }
            _ => {}
        }
        let length = (self.length.clone(), self.length_known);
        self.note(&stmt);
        self.after_call(&stmt, length);
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
        // A code that is skipped stops nothing.
        let stopped = if stmt.skip.is_none() { Switch::Off } else { Switch::Unknown };
        for (at, behaviour) in both.into_iter().enumerate() {
            let state = if at == 0 { &self.spindle } else { &self.coolant };
            if *state == Switch::Off {
                continue;
            }
            // Where the source's control leaves it open, its usual value counts.
            let source_stops = self.source.does(behaviour);
            // Where Z goes home in words, the spindle stops in words before that.
            let target_stops = self.target.surely(behaviour) && !(both == CHANGE && self.goes_home());
            let state = if at == 0 { &mut self.spindle } else { &mut self.coolant };
            if source_stops && !target_stops {
                if optional && at == 0 && *state == Switch::Unknown {
                    // With the switch off it goes on as it was, which nobody knows here.
                    self.lost_stop = Some(stmt.span);
                }
                off.push((behaviour, if at == 0 { Op::StopSpindleTurning } else { Op::CoolantOff }));
                // An optional stop that is not made leaves it on in the source.
                if let (true, Switch::On(ops)) = (optional, &*state) {
                    self.again[at] = Some((behaviour, ops.clone()));
                } else if !optional {
                    *state = stopped.clone();
                    self.again[at].take_if(|_| stopped == Switch::Off);
                }
                continue;
            }
            if source_stops && !optional {
                *state = stopped.clone();
                // What an optional stop before it has switched off stays off after it.
                self.again[at].take_if(|_| stopped == Switch::Off);
                continue;
            }
            // The source surely lets it go on, or usually; a spindle that turns over a change is refused elsewhere.
            let other = target_stops && !source_stops
                || self.target.is_open(behaviour) && !self.source.is_open(behaviour) && !source_stops;
            let restarts = behaviour != Behaviour::SpindleAtChange && both != END;
            let ops = match &*state {
                Switch::On(ops) => Some(ops.clone()),
                Switch::Unknown if at == 0 => self.only_sense.clone().map(|op| vec![op]),
                Switch::Unknown => None,
                Switch::Off => None,
            };
            if let (true, true, Some(ops)) = (other, restarts, ops) {
                self.again[at] = Some((behaviour, ops));
            }
        }
        let again = self.again.iter().any(Option::is_some);
        if self.beside && (!off.is_empty() || again && stands_alone(made, stmt)) {
            // With the block that switches, two still blocks stand in a row: the corner is each control's own.
            self.again = [None, None];
            let fault = Fault::lacks(CompensationLack::StopBeside);
            return diags.push(Diagnostic::new(fault, stmt.span));
        }
        self.stopped_in_words |=
            stmt.skip.is_none() && off.iter().any(|(_, op)| matches!(op, Op::StopSpindleTurning));
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

    /// Shifts and frames at the end of the program, where the source's control cancels them and the target's may keep
    /// them.
    fn cancel_shifts(&mut self, stmt: &mut Stmt, made: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
        let mut new = Vec::new();
        for slot in self.shifts.drain(..) {
            let Some(behaviour) = at_end(slot) else { continue };
            if !self.source.does(behaviour) || self.target.surely(behaviour) {
                continue;
            }
            let reported = |d: &Diagnostic| d.fault == Fault::SideEffectWritten { behaviour };
            if !diags.iter().any(|d| d.span == stmt.span && reported(d)) {
                diags.push(Diagnostic::new(Fault::SideEffectWritten { behaviour }, stmt.span));
            }
            new.push(Stmt { skip: stmt.skip, ..Stmt::new(stmt.span, Op::ClearFrame(slot)) });
        }
        self.insert_after_cycle(stmt, made, new);
    }

    /// Whether Z goes to machine zero in words before a tool change.
    fn goes_home(&self) -> bool {
        let behaviour = Behaviour::ZAtChange;
        self.source.surely(behaviour) && !self.target.does(behaviour) && !self.z_home
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
        self.z_home |= (source || target) && stmt.skip.is_none();
    }

    /// What a statement leaves on.
    fn note(&mut self, stmt: &Stmt) {
        let sure = stmt.skip.is_none();
        self.tools.note(stmt);
        self.cycle.note(stmt);
        self.stopped_in_words &= !starts_spindle(&stmt.op);
        let [spindle, coolant] = &mut self.again;
        match &stmt.op {
            op @ (Op::StartSpindleClockwise | Op::StartSpindleCounterclockwise) => {
                self.spindle = if sure { Switch::On(vec![op.clone()]) } else { Switch::Unknown };
                *spindle = spindle.take().filter(|_| !sure);
                self.lost_stop.take_if(|_| sure);
            }
            Op::StartCutterRadiusCompensation { .. } => self.beside = true,
            Op::StopCutterRadiusCompensation => self.beside &= !sure,
            Op::StopSpindleTurning | Op::OrientSpindle(_) => {
                self.spindle = if sure { Switch::Off } else { Switch::Unknown };
                *spindle = spindle.take().filter(|_| !sure);
                self.lost_stop.take_if(|_| sure);
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
            Op::ProgramEnd if sure => {
                (self.spindle, self.coolant) = (Switch::Off, Switch::Off);
                self.length_next = None;
            }
            Op::SetSlot(slot) => {
                let (own, none) = match &**slot {
                    Slot::Shift { origin: false, axes } => {
                        (FrameSlot::Local, axes.iter().flatten().all(is_zero))
                    }
                    Slot::Shift { origin: true, axes } => {
                        (FrameSlot::Shift, axes.iter().all(|word| word.as_ref().is_some_and(is_zero)))
                    }
                    Slot::Rotation { angle, .. } => (FrameSlot::Rotation, is_zero(&angle.value)),
                    Slot::Scale { .. } => (FrameSlot::Scale, false),
                    Slot::Mirror(_) => (FrameSlot::Mirror, false),
                    Slot::NoMirror(axes) => (FrameSlot::Mirror, *axes == [true; 3]),
                    Slot::Tilt(_) => (FrameSlot::Tilt, true),
                };
                match sure && none {
                    true => self.shifts.retain(|other| *other != own),
                    false => self.shifted(own),
                }
            }
            Op::SetFrame(_) => self.shifted(FrameSlot::Chain),
            Op::SetPosition(_) => self.shifted(FrameSlot::Shift),
            Op::ClearFrame(slot) if sure => self.shifts.retain(|own| own != slot),
            Op::Advise(_) if states(stmt) => self.arc_feed_said = true,
            flow!() => {
                self.elsewhere();
                self.arc_feed_said &= self.arc_feed_at_head;
            }
            _ => {}
        }
        self.note_z(stmt);
    }

    fn shifted(&mut self, slot: FrameSlot) {
        if !self.shifts.contains(&slot) {
            self.shifts.push(slot);
        }
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
