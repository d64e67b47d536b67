//! Flatten, then fold: the machine does the same, and what was there comes back.

use std::collections::BTreeMap;
use std::fmt::Write;

use ncc_exec::verify::{Comparison, Resolution};
use ncc_exec::world::World;
use ncc_exec::{Event, Exec, Runner};
use ncc_ir::canon::{Distance, FeedMode, Modes, Motion, Plane, ReturnLevel, Units};
use ncc_ir::caps::{Caps, CycleCap, CycleForm, FeedsOutTo, HoleCaps, Lift, ModeCaps};
use ncc_ir::diag::{Diagnostic, Gravity};
use ncc_ir::program::cycle::Pattern;
use ncc_ir::program::{Op, Program};
use ncc_ir::track::Tracker;
use ncc_passes::{PASSES, Target};

use super::made;

/// A target that can say everything, and writes so many digits.
pub(super) fn everything(decimals: u8) -> Target {
    let cycle = |kind: &str| CycleCap {
        kind: kind.into(),
        returns: vec![ReturnLevel::Initial, ReturnLevel::Retract],
        dwell: true,
        clearance: true,
        from_return: false,
        pause: None,
        parameter: true,
        strokes: true,
        shrinks: true,
        feed_out: true,
        lift: Lift::Either,
        form: CycleForm::Any,
        feeds_out_to: FeedsOutTo::Either,
        turns: Vec::new(),
    };
    let holes = HoleCaps {
        cycles: ["drill", "drill-dwell", "drill-peck", "drill-break", "bore"].map(cycle).into(),
        circles: true,
        grid_upto: u32::MAX,
        lines: true,
        list_upto: u32::MAX,
        pattern_start: true,
        pattern_angle: true,
        incremental: true,
        ..HoleCaps::default()
    };
    let modes = ModeCaps { incremental: true, inch: true, ..ModeCaps::default() };
    let caps = Caps { holes, modes, ..Caps::default() };
    Target { caps, decimals, ..Target::default() }
}

/// Runs passes by name.
pub(super) fn apply(names: &[&str], program: &mut Program, target: &Target) -> Result<(), String> {
    let mut found: Vec<Diagnostic> = Vec::new();
    for name in names {
        let pass = PASSES.iter().find(|p| p.name == *name).ok_or("no such pass")?;
        let entry = Tracker { modes: program.assumed, ..Tracker::default() };
        pass.alone.expect("a pass that runs alone")(program, target, &entry, &mut found);
    }
    match found.iter().find(|d| d.fault.gravity() == Gravity::Error) {
        Some(refused) => Err(format!("refused: {:?}", refused.fault)),
        None => Ok(()),
    }
}

/// A world in which the usual modes hold.
fn world(seed: u32) -> World {
    let usual = Modes {
        motion: Some(Motion::Traverse),
        distance: Some(Distance::Absolute),
        units: Some(Units::Mm),
        plane: Some(Plane::Xy),
        feed_mode: Some(FeedMode::PerMinute),
        return_level: Some(ReturnLevel::Retract),
        work_offset: Some(1),
        length_offset: Some(0),
        no_origin_shift: Some(true),
    };
    World::generate(seed, &usual)
}

/// Whether two programs make the same events, to half a unit of these digits.
pub(super) fn same(a: &Program, b: &Program, digits: u8) -> Result<(), String> {
    for (seed, skip) in [(1, 0), (2, 0), (1, 0x7fe)] {
        let run = |program: &Program| -> Result<(Vec<Event>, _), String> {
            let mut exec = Exec::new(&world(seed), skip);
            exec.assume(&program.assumed);
            let (start, mut out) = (exec.machine(), Vec::new());
            Runner::new(program)
                .run(&mut exec, usize::MAX, &mut out)
                .map_err(|d| format!("{:?}", d.fault))?;
            exec.end_of_text(&mut out);
            Ok((out, start))
        };
        let (mut source, start) = run(a)?;
        let (mut target, _) = run(b)?;
        let resolution = Resolution {
            mm: digits,
            inch: digits + 1,
            degree: digits,
            feed: 6,
            feed_inch: 6,
            second: 6,
            speed: 6,
        };
        let mut comparison = Comparison::new(resolution, start);
        comparison.advance(&mut source, &mut target, true).map_err(|d| format!("world {seed}: {d:?}"))?;
    }
    Ok(())
}

/// Cycles and patterns of a program: how many there are of each kind with so many holes.
pub(super) fn structure(program: &Program) -> BTreeMap<(String, u32), u32> {
    let mut all = BTreeMap::new();
    let mut cycle: Option<(String, u32)> = None;
    let add = |all: &mut BTreeMap<_, u32>, what: Option<(String, u32)>| {
        if let Some(what) = what.filter(|(_, holes)| *holes > 0) {
            *all.entry(what).or_default() += 1;
        }
    };
    for stmt in program.procedures.iter().flat_map(|p| &p.body) {
        match &stmt.op {
            Op::StartCycle(c) => {
                let next = Some((format!("cycle {}", c.kind.name()), 0));
                add(&mut all, std::mem::replace(&mut cycle, next));
            }
            Op::Hole(_) => cycle.iter_mut().for_each(|c| c.1 += 1),
            Op::Pattern(pattern) => {
                let (name, holes) = named(pattern);
                cycle.iter_mut().for_each(|c| c.1 += holes);
                add(&mut all, Some((format!("pattern {name}"), holes)));
            }
            Op::EndCycle | Op::StraightTraverse(_) | Op::StraightFeed(_) | Op::ArcFeed(_) => {
                add(&mut all, cycle.take());
            }
            _ => {}
        }
    }
    add(&mut all, cycle);
    all
}

fn named(pattern: &Pattern) -> (&'static str, u32) {
    match pattern {
        Pattern::Circle { count, step, .. } => {
            let turn = step.literal().map_or(0, |n| n.mantissa);
            (if turn < 0 { "circle clockwise" } else { "circle" }, *count)
        }
        Pattern::Line { count, .. } => ("line", *count),
        Pattern::Grid { columns, rows, .. } if columns.count == 1 || rows.count == 1 => {
            ("line", columns.count * rows.count)
        }
        Pattern::Grid { columns, rows, serpentine, .. } => {
            (if *serpentine { "grid serpentine" } else { "grid" }, columns.count * rows.count)
        }
        Pattern::List(points) => ("list", points.len() as u32),
    }
}

/// How many of a kind were removed, and how many did not come back.
#[derive(Default)]
pub(super) struct Table(BTreeMap<String, [u32; 2]>);

impl Table {
    pub(super) fn count(&mut self, before: &Program, after: &Program) -> Vec<String> {
        let (before, mut after) = (structure(before), structure(after));
        let mut missing = Vec::new();
        for ((kind, holes), count) in before {
            let back = after.remove(&(kind.clone(), holes)).unwrap_or(0).min(count);
            let row = self.0.entry(kind.clone()).or_default();
            row[0] += count;
            row[1] += count - back;
            if back < count {
                missing.push(format!("{kind} of {holes}"));
            }
        }
        missing
    }

    /// Removed, and missed.
    pub(super) fn sum(&self) -> [u32; 2] {
        self.0.values().fold([0, 0], |sum, row| [sum[0] + row[0], sum[1] + row[1]])
    }

    pub(super) fn show(&self) -> String {
        let mut out = String::new();
        for (kind, [removed, missed]) in &self.0 {
            let _ = writeln!(out, "{kind:26} {removed:6} removed {missed:4} missed");
        }
        let [removed, missed] = self.sum();
        let back = 100.0 * f64::from(removed - missed) / f64::from(removed.max(1));
        let _ = writeln!(out, "all {removed}, missed {missed}: {back:.2} % came back");
        out
    }
}

/// Ways in which flattened text is written: as the expansion leaves it, without what changes nothing,
/// every word of every axis.
const STYLES: [&[&str]; 3] = [&[], &["drop-redundant"], &["flatten-facts"]];

/// A program of a seed, flattened, and folded again.
pub(super) fn steps(seed: u64) -> Result<(Program, Program, Program), String> {
    // A target of three digits cannot say every step of a whole circle.
    let decimals = if seed.is_multiple_of(2) { 3 } else { 8 };
    let before = made::program(seed, decimals);
    let flat = Target { decimals: 3, ..Target::default() };
    let mut long_hand = before.clone();
    apply(&["expand-patterns", "expand-cycles"], &mut long_hand, &flat)?;
    apply(STYLES[(seed % 3) as usize], &mut long_hand, &flat)?;
    if !structure(&long_hand).is_empty() {
        return Err("not flat".into());
    }
    let mut after = long_hand.clone();
    apply(&["fold-cycles", "fold-patterns"], &mut after, &everything(decimals))?;
    Ok((before, long_hand, after))
}

/// What did not come back of the program of a seed.
fn one(seed: u64, table: &mut Table) -> Result<Vec<String>, String> {
    let (before, long_hand, after) = steps(seed)?;
    same(&before, &long_hand, 3).map_err(|e| format!("flattened: {e}"))?;
    same(&long_hand, &after, 3)?;
    Ok(table.count(&before, &after))
}

/// How many programs are tried: `NCC_FOLD_PROGRAMS`, else a few hundred.
fn programs() -> u64 {
    std::env::var("NCC_FOLD_PROGRAMS").ok().and_then(|n| n.parse().ok()).unwrap_or(500)
}

#[test]
fn flattened_and_folded() {
    let mut table = Table::default();
    let mut faults = Vec::new();
    let mut missing = Vec::new();
    let all = programs();
    for seed in 0..all {
        match one(seed, &mut table) {
            Ok(missed) if missed.is_empty() => {}
            Ok(missed) => missing.push(format!("{seed}: {}", missed.join(", "))),
            Err(fault) => faults.push(format!("{seed}: {fault}")),
        }
    }
    println!("{all} programs, {} with another stream\n{}", faults.len(), table.show());
    println!("{}", missing.iter().take(60).cloned().collect::<Vec<_>>().join("\n"));
    let [removed, missed] = table.sum();
    assert!(faults.is_empty(), "{}", faults.iter().take(5).cloned().collect::<Vec<_>>().join("\n"));
    assert!(missed * 100 <= removed, "more than 1 % missed");
}
