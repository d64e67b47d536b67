//! What no pass can mend, refused at its place.

use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::{ArcsLack, FlowLack, FramesLack, Lack, LengthsLack, MachineLack, TablesLack};
use ncc_ir::program::{Arc, Data, Op, Stmt};
use ncc_ir::track::Tracker;

use super::{messages, tool_data};
use crate::arcs::arc_radii;
use crate::frames::work_offset;
use crate::pass::{Moment, Pass, Shared, Step};
use crate::support::needs::{ARC, CALL, CONTROL, MACHINE, MESSAGE};
use crate::support::walk::Walk;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "refuse",
    about: "refuses what no pass can mend",
    alone: None,
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(ARC | MESSAGE | CALL | CONTROL | MACHINE),
        |l, p| refuse(l, p.stmts, &mut p.start.clone(), p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Refuses what no pass can mend.
fn refuse(shared: &Shared, stmts: &mut [Stmt], walk: &mut Walk, diags: &mut Vec<Diagnostic>) {
    let caps = &shared.target.caps;
    for stmt in &mut *stmts {
        walk.enter(stmt.skip);
        if !caps.frames.offset_turns {
            work_offset::leave_straight(&mut stmt.op);
        }
        if let (Op::ArcFeed(arc), Some(source)) = (&mut stmt.op, &shared.source_arcs) {
            match arc_radii::judge_radii(arc, walk, source, &shared.target) {
                arc_radii::Judged::Kept => {}
                arc_radii::Judged::ByCentre => {
                    diags.push(Diagnostic::new(Fault::ArcReformatted, stmt.span));
                }
                arc_radii::Judged::Refused(fault) => diags.push(Diagnostic::new(fault, stmt.span)),
            }
        }
        let mut cannot = |lack: Lack| {
            diags.push(Diagnostic::new(Fault::lacks(lack), stmt.span));
        };
        match &stmt.op {
            Op::ArcFeed(arc) if !caps.arcs.helix && is_helix(arc, &walk.at) => cannot(ArcsLack::Helix.into()),
            Op::Control(_) if !caps.flow.repeats => cannot(FlowLack::Control.into()),
            Op::Goto(_) if !caps.flow.repeats => cannot(FlowLack::Jump.into()),
            Op::Label(_) if !caps.flow.repeats && !caps.flow.repeat_blocks => cannot(FlowLack::Jump.into()),
            Op::Call(_) if !caps.flow.calls => cannot(FlowLack::Call.into()),
            Op::Return if !caps.flow.calls => cannot(FlowLack::Return.into()),
            Op::UseMachineCoordinates { .. } if !caps.machine.coordinates => {
                cannot(MachineLack::Coordinates.into());
            }
            Op::UseMachineCoordinates { length } if !caps.machine.length.says(*length) => {
                cannot(
                    if *length { MachineLack::WithToolLength } else { MachineLack::WithoutToolLength }.into(),
                );
            }
            Op::UseToolLength(length) if !caps.says_length(length) => cannot(LengthsLack::NoTable.into()),
            Op::SetData(data) => match &**data {
                Data::Offset { turn: Some(_), .. } if !caps.frames.offset_turns => {
                    cannot(FramesLack::OffsetRotation.into());
                }
                Data::Offset { mode, .. } if caps.frames.offset_data[*mode as usize] => {}
                Data::Tool { .. } | Data::Measured { .. } => {
                    if let Some(lack) = tool_data::refusal(data, &walk.at, caps) {
                        cannot(lack.into());
                    }
                }
                Data::Position(place) if caps.machine.stored_positions[usize::from(*place == 2)] => {}
                Data::ToolInSpindle(_) if caps.tools.number => {}
                Data::Position(_) => cannot(TablesLack::AxesPosition.into()),
                Data::ToolInSpindle(_) => cannot(TablesLack::ToolInSpindle.into()),
                Data::Offset { .. } => cannot(TablesLack::Value.into()),
            },
            _ => {}
        }
        walk.step(stmt);
    }
    if !caps.modes.messages {
        messages::drop_messages(stmts, caps, diags);
    }
}

/// Whether an arc has a word of the third axis that moves it.
pub(super) fn is_helix(arc: &Arc, here: &Tracker) -> bool {
    let axis = match here.plane(arc.plane) {
        Some(plane) => plane.axes().2,
        None => return true,
    };
    let now = here.position[axis as usize];
    arc.to.get(axis).is_some_and(|word| now.is_none() || here.resolve(word, now) != now)
}
