//! `cutter-radius`: by which radius a contour is compensated, in the words that the target has.
//!
//! A control takes the radius of an entry that the block names, that of the entry with the tool's
//! number, or that of the edge (or entry) whose length is active. One stands for another where the
//! program itself shows that they are the same place of the tables; otherwise it is refused. How the
//! tool goes onto the contour and leaves it is each control's own: between two of them it is taken to
//! be the same, and reported once.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::RADIUS;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, rebuild};
use crate::target::Target;
use ncc_ir::caps::Radii;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::lack::CompensationLack;
use ncc_ir::program::{CutterRadius, Op, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "cutter-radius",
    about: "names the radius of cutter radius compensation as the target does",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(RADIUS),
        |l, p| {
            convert_radius(
                p.stmts,
                &mut p.start.clone(),
                l.states.state_mut::<CutterRadiusState>(),
                &l.target,
                p.diags,
            )
        },
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a program.
#[derive(Clone, Debug, Default)]
pub(crate) struct CutterRadiusState {
    /// Whether entry and exit were reported.
    reported: bool,
    /// Entries of the tables that were reported.
    entries: Vec<u32>,
}

/// Names radii as the target does.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    let mut state = CutterRadiusState::default();
    each_body(program, entry, |body, walk| convert_radius(body, walk, &mut state, target, diags));
}

/// The same for one piece of a body.
pub(crate) fn convert_radius(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut CutterRadiusState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    rebuild(body, |mut stmt, made: &mut Rebuild| {
        walk.enter(stmt.skip);
        let span = stmt.span;
        if let Op::StartCutterRadiusCompensation { radius, .. } = &mut stmt.op {
            match named(radius, &target.caps.compensation.radii, &walk.at) {
                Ok((own, entry)) => {
                    *radius = own;
                    if let Some(entry) = entry.filter(|_| target.other_control)
                        && !state.entries.contains(&entry)
                    {
                        state.entries.push(entry);
                        diags.push(Diagnostic::new(Fault::AssumedRadius { entry }, span));
                    }
                }
                Err(fault) => diags.push(Diagnostic::new(fault, span)),
            }
            if target.other_control && !std::mem::replace(&mut state.reported, true) {
                diags.push(Diagnostic::new(Fault::AssumedContourEnds, span));
            }
        }
        walk.step(&stmt);
        made.push(stmt);
    });
}

fn number(n: i64) -> Option<u32> {
    u32::try_from(n).ok().filter(|n| *n > 0)
}

/// A radius as the target names it, and the entry that it is taken for where that is another way.
fn named(radius: &CutterRadius, radii: &Radii, at: &Tracker) -> Result<(CutterRadius, Option<u32>), Fault> {
    let cannot = |lack: CompensationLack| Err(Fault::lacks(lack));
    if *radii == Radii::default() {
        return cannot(CompensationLack::Compensation);
    }
    let tool = at.tool.and_then(number);
    let length = at.modes.length_offset.filter(|n| *n > 0);
    // Where the tables have it, as far as the program shows.
    let (entry, can) = match radius {
        CutterRadius::Entry(entry) => {
            (entry.literal().and_then(|n| n.whole_number()).and_then(number), radii.entry)
        }
        CutterRadius::Tool => (tool, radii.tool),
        CutterRadius::InForce => (length, radii.in_force),
        CutterRadius::Diameter(_) => (None, radii.diameter),
    };
    // What has no radius is refused where it is executed.
    let none = match radius {
        CutterRadius::Entry(entry) => entry.literal().is_some_and(|n| n.is_zero()),
        CutterRadius::Tool | CutterRadius::Diameter(_) => false,
        CutterRadius::InForce => at.modes.length_offset == Some(0),
    };
    if can || none {
        return Ok((radius.clone(), None));
    }
    let Some(entry) = entry else {
        return cannot(match radius {
            CutterRadius::Entry(_) => CompensationLack::ComputedEntry,
            CutterRadius::Tool => CompensationLack::ToolUnknown,
            CutterRadius::InForce => CompensationLack::EdgeWithoutEntry,
            CutterRadius::Diameter(_) => CompensationLack::StatedDiameter,
        });
    };
    let own = match () {
        () if radii.entry => CutterRadius::Entry(Expr::int(i64::from(entry))),
        () if radii.in_force && length == Some(entry) => CutterRadius::InForce,
        () if radii.tool && tool == Some(entry) => CutterRadius::Tool,
        () => {
            return cannot(match length {
                Some(length) => CompensationLack::EntryWithLength { entry, length },
                None => CompensationLack::EntryWithUnknownLength { entry },
            });
        }
    };
    Ok((own, Some(entry)))
}
