//! A program that computes, said with what the target computes with: forms of control, functions, known facts, and
//! variables.

use std::collections::HashMap;

use ncc_dialects::{
    BREAK_LIFT, CALL_DEPTH, CodeRow, MACRO_DEPTH, PATH_TOLERANCE, PECK_CLEARANCE, Quantity, SystemRow,
};
use ncc_ir::canon::Modes;
use ncc_ir::computed::computes::{ComputeFeature, Computes};
use ncc_ir::computed::free_variables::free_variables;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Num;
use ncc_ir::expr::{self, Expr};
use ncc_ir::program::valid::{deeper_calls, labels_twice};
use ncc_ir::program::{Call, Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;
use ncc_passes::modes::word_distance;
use ncc_passes::parametric::Parametric;
use ncc_passes::support::mode_analysis::{self, Known};
use ncc_passes::values::alarm_numbers;
use ncc_passes::values::variables::renamed::{Digits, Renamed};
use ncc_passes::watch::ran_whole;
use ncc_passes::{Target, leave_out_output, output_elsewhere};

use crate::job::Job;
use crate::job::parameters::{bore_shift, orientation, parameter};

/// A number as it is typed.
fn decimal(num: Num) -> String {
    let digits = format!("{:0>width$}", num.mantissa.unsigned_abs(), width = usize::from(num.scale) + 1);
    let (whole, behind) = digits.split_at(digits.len() - usize::from(num.scale));
    let sign = if num.mantissa < 0 { "-" } else { "" };
    if behind.is_empty() { format!("{sign}{whole}") } else { format!("{sign}{whole}.{behind}") }
}

/// Has the output set at its start what the user states that variables hold there, which the program reads before it
/// sets them.
pub fn begin_with(job: &Job, program: &mut Program) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    if job.values.is_empty() {
        return found;
    }
    let open = free_variables(program);
    let Some(main) = program.procedures.first_mut() else { return found };
    let at = main.body.first().map_or(Span::default(), |first| first.span);
    let mut sets = Vec::new();
    for (var, read) in open {
        let name = var.name();
        let Some((_, value)) = job.values.iter().find(|(own, _)| job.given.is_name(own, &name)) else {
            continue;
        };
        let assumption =
            ControlFact::VariableAtStart { name: name.as_ref().into(), value: decimal(*value).into() };
        found.push(Diagnostic::new(Fault::AssumedFact { fact: assumption }, read));
        sets.push(Stmt::new(at, Op::Assign(expr::Target::Var(var), Expr::Num(*value))));
    }
    let at = behind_the_modes(&main.body);
    main.body.splice(at..at, sets);
    ran_whole("values-at-start", program);
    found
}

/// The place of the first block that does more than state modes.
fn behind_the_modes(body: &[Stmt]) -> usize {
    let states = |stmt: &Stmt| {
        let plain = matches!(
            stmt.op,
            Op::UseLengthUnits(_)
                | Op::SetDistanceMode(_)
                | Op::SelectPlane(_)
                | Op::SetFeedMode(_)
                | Op::SetReturnLevel(_)
                | Op::SetOriginOffsets(_)
                | Op::EndCycle
                | Op::StopCutterRadiusCompensation
                | Op::UseToolLengthOffset(Expr::Num(_))
                | Op::Comment(_)
                | Op::Blank
        );
        plain && stmt.skip.is_none()
    };
    let first = body.iter().position(|stmt| !states(stmt)).unwrap_or(body.len());
    (0..=first).rev().find(|at| body.get(*at).is_none_or(|stmt| !stmt.joined)).unwrap_or(0)
}

/// Digits after the point to which computed positions are rounded: the target's, in mm.
pub fn decimals(job: &Job) -> u8 {
    job.to.dialect.numbers(Quantity::Length).decimals
}

/// Jumps of the source to labels that stand several times; calls of the written program that go deeper within one
/// another than the target takes, or than each such control does.
pub fn calls_and_jumps(job: &Job, [source, program]: [&Program; 2], found: &mut Vec<Diagnostic>) {
    found.extend(labels_twice(source));
    // A control that counts calls of macros counts them apart.
    let apart = job.to.call_depth(MACRO_DEPTH).is_some();
    for (option, macros) in [(CALL_DEPTH, false), (MACRO_DEPTH, true)] {
        let Some([most, sure]) = job.to.call_depth(option) else { continue };
        let counts: fn(&Call) -> bool = match (macros, apart) {
            (true, _) => |call| !call.shared,
            (false, true) => |call| call.shared,
            (false, false) => |_| true,
        };
        let beyond = |limit: u32| deeper_calls(program, limit as usize, counts);
        let fault = match (beyond(most), beyond(sure)) {
            (Some((depth, name, span)), _) => {
                let (name, depth) = (name.into(), depth as u32);
                Diagnostic::new(Fault::CallsDeeper { name, depth, most, macros }, span)
            }
            (None, Some((depth, _, span))) => {
                Diagnostic::new(Fault::CallDepth { depth: depth as u32, sure, macros }, span)
            }
            (None, None) => continue,
        };
        found.push(fault);
    }
}

/// Says the alarms of a program as the target has them, and leaves out what it has no device for.
pub fn alarms(job: &Job, program: &mut Program, found: &mut Vec<Diagnostic>) {
    let caps = job.to.caps();
    leave_out_output(program, &caps, found);
    ran_whole("leave-out-output", program);
    let opens = caps.flow.computes.as_ref().is_some_and(|target| target.output_opened);
    if job.from.dialect.id != job.to.dialect.id {
        found.extend(output_elsewhere(program, opens));
    }
    let Some(computes) = caps.flow.computes else { return };
    let Some(alarms) = &computes.alarms else { return };
    alarm_numbers::in_its_characters(program, alarms, found);
    ran_whole("alarm-texts", program);
    if job.from.dialect.id != job.to.dialect.id {
        alarm_numbers::run(program, alarms, computes.has(ComputeFeature::CallOf), found);
        ran_whole("alarm-numbers", program);
    }
}

/// Legalises a program that computes for the target. `start` holds the modes active at its first statement. Returns the
/// facts of its statements, and the renamed variables.
pub fn legalise_parametric(
    job: &Job,
    program: &mut Program,
    target: &Computes,
    start: &Tracker,
    found: &mut Vec<Diagnostic>,
) -> (Known, Renamed) {
    let (from, to) = (job.from.dialect, job.to.dialect);
    let (source, caps) = (job.from.caps(), job.to.caps());
    let mut entry = start.clone();
    entry.modes = entry.modes.or(program.assumed);
    let computes = source.flow.computes.unwrap_or_default();
    let lengths = to.numbers(Quantity::Length);
    let inch = lengths.increment_inch.unwrap_or(lengths.increment);
    let both = |row: &CodeRow| row.dwell.iter().any(|word| word.quantity == Quantity::Milliseconds);
    let seconds = to.code.iter().any(both).then(|| to.numbers(Quantity::Seconds).increment);
    let rows = || to.system.iter().filter(|row| row.counts(&job.to));
    let mut own = Parametric {
        caps: &caps,
        target,
        source: &computes,
        word_distance: source.modes.word_distance,
        others: from.id != to.id,
        keeps_words: to.program.o_words && from.id == to.id,
        tolerance: from.formula.tolerance(),
        digits: Digits { decimals: lengths.decimals, increments: [lengths.increment, inch], seconds },
        tells: &|asked| rows().flat_map(SystemRow::says).any(|(said, _)| said == *asked),
        entry,
        known: Known::default(),
        renamed: Renamed::default(),
    };
    own.say(program, found);
    (own.known, own.renamed)
}

/// The modes active at the start of each basic block of a program with subprograms. Empty if a word has a distance mode
/// of its own. `at` holds the modes active at its first statement.
pub fn entry_modes(program: &Program, at: &Tracker) -> HashMap<u32, Modes> {
    if program.procedures.len() < 2 {
        return HashMap::new();
    }
    let mut entry = at.clone();
    entry.modes = entry.modes.or(program.assumed);
    let known = mode_analysis::run(&mut program.clone(), &entry, false);
    if word_distance::others(program, &known).is_empty() { known.modes() } else { HashMap::new() }
}

/// The target as the passes see it.
pub fn target(job: &Job) -> Target {
    let caps = job.to.caps();
    Target {
        caps,
        decimals: decimals(job),
        peck_clearance: parameter(job, PECK_CLEARANCE),
        break_lift: parameter(job, BREAK_LIFT),
        bore_shift: bore_shift(job),
        orientation: orientation(job),
        compensating: job.compensating(),
        tried_upto: job.tried_upto,
        given: job.given.names().filter_map(|name| Some((name.into(), job.given.only(name)?))).collect(),
        // What is asked for by name is done in the source's numbers.
        ..Target::default()
    }
}

/// How the two controls take corners that no program speaks of, where that is not the same.
pub fn path_at_start(job: &Job) -> Option<Diagnostic> {
    let [from, to] =
        [&job.from, &job.to].map(|side| side.dialect.power_on.path.as_ref().map(|fact| fact.value));
    let (from, to) = (from?, to?);
    let fault = Fault::PathAtStart { source: from.name(), target: to.name() };
    let stated = job.from.length(PATH_TOLERANCE).is_some_and(|within| within.mantissa > 0);
    (job.between_controls() && from != to && !stated).then(|| Diagnostic::new(fault, Span::default()))
}

/// Whether a body says how corners are taken, at any depth.
pub fn sets_path(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::SetMotionControlMode(_) => true,
        Op::Control(control) => control.bodies().any(|body| sets_path(body)),
        _ => false,
    })
}
