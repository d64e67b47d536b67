//! Modes that a subprogram restores ([`Attribute::GivesBack`]): after each of its calls stand statements that activate
//! what was so before, as far as the subprogram changes it.
//!
//! A Sinumerik has them by the word SAVE (Job planning 06/2009, subprograms with SAVE; K2 08/2005, 2.4.10): modal G
//! functions, the active work offset if it is another one, and the programmable frame. Feeds, speeds, tools and
//! values in tables stay as the subprogram leaves them.
//!
//! Refused, each with what it is: what was active where it is not known; a frame of the caller's where the subprogram
//! has one; a subprogram that changes the unit, what feeds and speeds count, compensation or advice; a call that is
//! made several times.
//!
//! Not here: which statement is written how.

use std::collections::{HashMap, HashSet};

use crate::support::mode_analysis::{At, at_calls};
use ncc_ir::canon::{FeedMode, Motion, SpindleMode, Units};
use ncc_ir::caps::Caps;
use ncc_ir::computed::computes::ComputeFeature;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::kinds::{drilling, flow, moves, polar, tooling, variables};
use ncc_ir::program::{Attribute, Data, FrameSlot, Move, Op, Procedure, Program, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;
use ncc_ir::unsupported::SaveUnsupported;

/// Puts the statements after the calls. `entry` is what holds where the statements of the main procedure begin; `word`
/// names the attribute in refusals.
pub fn run(program: &mut Program, entry: &Tracker, word: &str, diags: &mut Vec<Diagnostic>) {
    let gives = |procedure: &&Procedure| procedure.attributes.contains(&Attribute::GivesBack);
    if !program.procedures.iter().skip(1).any(|procedure| gives(&procedure)) {
        return;
    }
    let Some(at) = at_calls(program, entry) else {
        let what = SaveUnsupported::Unknown;
        return diags.push(refused(word, what, Span::default()));
    };
    let mut changes: HashMap<Text, Changes> = HashMap::new();
    let places = program.by_name();
    for procedure in program.procedures.iter().skip(1).filter(gives) {
        let mut look = Changes::default();
        look.body(&procedure.body, program, &places, &mut HashSet::from([&*procedure.name]));
        changes.insert(procedure.name.clone(), look);
    }
    for procedure in &mut program.procedures {
        behind_calls(&mut procedure.body, &changes, &at, word, diags);
    }
}

/// Tells which attributes a target does not say that are advice.
pub fn left_out(program: &Program, target: &Caps) -> Vec<Diagnostic> {
    let says = target.flow.computes.as_ref().is_some_and(|computes| computes.has(ComputeFeature::Attributes));
    let mut reported = Vec::new();
    for procedure in program.procedures.iter().filter(|_| !says) {
        let at = procedure.body.first().map_or(Span::default(), |stmt| stmt.span);
        reported.extend(procedure.attributes.iter().filter_map(|attribute| {
            let kind = match attribute {
                Attribute::GivesBack => return None,
                Attribute::RunsThrough => "single-blocks",
                Attribute::NotShown => "what-is-shown",
            };
            Some(Diagnostic::new(Fault::AdviceLeftOut { kind: kind.into() }, at))
        }));
    }
    reported
}

fn refused(word: &str, what: SaveUnsupported, span: Span) -> Diagnostic {
    Diagnostic::new(Fault::not_supported(word, what), span)
}

/// What a subprogram changes, with all that it calls and that gives nothing back itself.
#[derive(Clone, Debug, Default)]
struct Changes {
    motion: bool,
    distance: bool,
    plane: bool,
    offset: bool,
    frame: bool,
    path: bool,
    data: bool,
    units: Vec<Units>,
    feeds: Vec<FeedMode>,
    speeds: Vec<SpindleMode>,
    compensation: bool,
    /// What is refused, whatever is active.
    refused: Option<SaveUnsupported>,
}

impl Changes {
    /// `places` is where procedures stand by name; `seen` are those that were looked into.
    fn body<'p>(
        &mut self,
        body: &'p [Stmt],
        program: &'p Program,
        places: &HashMap<&str, usize>,
        seen: &mut HashSet<&'p str>,
    ) {
        for stmt in body {
            match &stmt.op {
                Op::Control(control) => {
                    control.bodies().for_each(|body| self.body(body, program, places, seen))
                }
                Op::Call(call) => {
                    let called = places.get(&*call.name).map(|place| &program.procedures[*place]);
                    if let Some(called) = called
                        && !called.attributes.contains(&Attribute::GivesBack)
                        && seen.insert(&called.name)
                    {
                        self.body(&called.body, program, places, seen);
                    }
                }
                op => self.op(op),
            }
        }
    }

    fn op(&mut self, op: &Op) {
        match op {
            Op::UseLengthUnits(units) => self.units.push(*units),
            Op::SetFeedMode(mode) => self.feeds.push(*mode),
            Op::SetSpindleMode(mode) => self.speeds.push(*mode),
            Op::SetDistanceMode(_) => self.distance = true,
            Op::SelectPlane(_) => self.plane = true,
            Op::SetOriginOffsets(_) => self.offset = true,
            Op::SetMotionControlMode(_) => self.path = true,
            Op::SetFrame(_) | Op::ClearFrame(FrameSlot::Chain) => self.frame = true,
            Op::StartCutterRadiusCompensation { .. } | Op::StopCutterRadiusCompensation => {
                self.compensation = true;
            }
            Op::SetReturnLevel(_)
            | Op::ClearFrame(_)
            | Op::SetSlot(_)
            | Op::SetPosition(_)
            | Op::UseOriginShift(_) => self.refused = Some(SaveUnsupported::OtherFrame),
            Op::Advise(_) => self.refused = Some(SaveUnsupported::Advice),
            Op::SetData(data) => self.data |= matches!(**data, Data::Offset { .. }),
            moves!() | drilling!() | polar!() | Op::Position(_) | Op::EndCycle => self.motion = true,
            Op::UseToolCentrePoint(_)
            | Op::UseMachineCoordinates { .. }
            | Op::Probe(_)
            | Op::Detour(_)
            | Op::ExactStop
            | Op::TurnRotaryAxes(_)
            | Op::Corner { .. }
            | Op::SetFeedRate(_)
            | Op::ProgramEnd
            | Op::BeginAgain
            | Op::GoToReference(_)
            | Op::OrientToolAxis(_)
            | tooling!()
            | Op::Comment(_)
            | Op::Message(_)
            | Op::MessageOf(_)
            | Op::Output(_)
            | Op::Alarm(_)
            | Op::NoEffect(_)
            | Op::Blank
            | Op::Lines(_)
            | Op::SetSpindleSpeed(_)
            | Op::LimitSpindleSpeed(_)
            | Op::StartSpindleClockwise
            | Op::StartSpindleCounterclockwise
            | Op::StopSpindleTurning
            | Op::OrientSpindle(_)
            | Op::MachineFunction(_)
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::Dwell(_)
            | Op::ProgramStop
            | Op::OptionalProgramStop
            | variables!()
            | flow!() => {}
        }
    }

    /// The statements that activate again what was so at a call; else what is against them.
    fn undone(&self, at: Option<&At>) -> Result<Vec<Op>, SaveUnsupported> {
        let mut ops = Vec::new();
        if let Some(refused) = self.refused {
            return Err(refused);
        }
        // A call to which no way leads.
        let Some(At { before, path, behind }) = at else { return Ok(ops) };
        let modes = &before.modes;
        let same = |set: bool, what: SaveUnsupported| if set { Ok(()) } else { Err(what) };
        same(self.units.iter().all(|units| modes.units == Some(*units)), SaveUnsupported::Units)?;
        same(self.feeds.iter().all(|mode| modes.feed_mode == Some(*mode)), SaveUnsupported::FeedMode)?;
        same(self.speeds.is_empty(), SaveUnsupported::SpeedMode)?;
        let beside = before.compensated || behind.as_ref().is_none_or(|behind| behind.compensated);
        same(!self.compensation || !beside, SaveUnsupported::Compensation)?;
        same(!self.offset || !self.data, SaveUnsupported::OffsetChanged)?;
        if self.plane {
            ops.push(Op::SelectPlane(modes.plane.ok_or(SaveUnsupported::Plane)?));
        }
        if self.distance {
            let distance = modes.distance.ok_or(SaveUnsupported::Distance)?;
            ops.push(Op::SetDistanceMode(distance));
        }
        if self.offset {
            let offset = modes.work_offset.ok_or(SaveUnsupported::Offset)?;
            ops.push(Op::SetOriginOffsets(offset));
        }
        if self.frame {
            same(!before.framed && !before.turned, SaveUnsupported::CallersFrame)?;
            ops.push(Op::ClearFrame(FrameSlot::Chain));
        }
        if self.path {
            let path = path.clone().ok_or(SaveUnsupported::Path)?;
            ops.push(Op::SetMotionControlMode(path));
        }
        if self.motion {
            let nowhere = Move { said: true, ..Move::default() };
            ops.push(match modes.motion {
                Some(Motion::Traverse) => Op::StraightTraverse(nowhere),
                Some(Motion::Feed) => Op::StraightFeed(nowhere),
                Some(_) | None => return Err(SaveUnsupported::Motion),
            });
        }
        Ok(ops)
    }
}

fn behind_calls(
    body: &mut Vec<Stmt>,
    changes: &HashMap<Text, Changes>,
    at: &HashMap<u32, At>,
    word: &str,
    diags: &mut Vec<Diagnostic>,
) {
    let mut place = 0;
    while place < body.len() {
        let stmt = &mut body[place];
        place += 1;
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| behind_calls(body, changes, at, word, diags));
        }
        let Op::Call(call) = &stmt.op else { continue };
        let Some(changes) = changes.get(&call.name) else { continue };
        let (span, skip, times) = (stmt.span, stmt.skip, call.times);
        // What the call gives back to the caller's variables stands in its block.
        while body.get(place).is_some_and(|stmt| stmt.joined && matches!(stmt.op, Op::Assign(..))) {
            place += 1;
        }
        match changes.undone(at.get(&span.start)) {
            Err(what) => diags.push(refused(word, what, span)),
            Ok(ops) if !ops.is_empty() && times > 1 => {
                diags.push(refused(word, SaveUnsupported::Repeated, span));
            }
            Ok(ops) => {
                for (joined, op) in ops.into_iter().enumerate().map(|(k, op)| (k > 0, op)) {
                    body.insert(place, Stmt { joined, skip, ..Stmt::new(span, op) });
                    place += 1;
                }
            }
        }
    }
}
