//! `flatten`: executes what computes and decides, and writes the straight blocks that come of it.
//!
//! Subprograms, loops, jumps and variables are gone afterwards; cycles and patterns are kept as they are executed.
//! Numbers are rounded to the target's digits; what a rounded move is short of the program's point, the next incremental
//! word of the axis makes good, so that nothing adds up. Comments stand wherever their blocks are executed. Refused are
//! flow and variables in blocks that a switch can take out, and programs that do not end.

use crate::pass::Pass;
use std::collections::HashSet;

use crate::support::settle::settle;
use crate::support::walk::Walk;
use crate::target::{MOST_STATEMENTS, Target};
use ncc_exec::world::World;
use ncc_exec::{Exec, Runner};
use ncc_ir::canon::{AXES, Distance, Units};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, POW10, Unit};
use ncc_ir::expr::value::Value;
use ncc_ir::geometry::arc_solver::ArcRule;
use ncc_ir::lack::FlowLack;
use ncc_ir::program::arguments::{self, Argument};
use ncc_ir::program::kinds::{flow, variables};
use ncc_ir::program::valid;
use ncc_ir::program::{Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass =
    Pass::named("flatten", "executes what computes and decides, and writes straight blocks", Some(run));

/// Executes the program; only a main procedure of straight blocks is left.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    run_packing(program, target, entry, diags, &mut |_, _| {});
}

/// As [`run`]; `pack` may pack the statements that are there after each of them, and learns which is the last one, so that few
/// are in memory at once.
pub fn run_packing(
    program: &mut Program,
    target: &Target,
    entry: &Tracker,
    diags: &mut Vec<Diagnostic>,
    pack: &mut dyn FnMut(&mut Vec<Stmt>, bool),
) {
    if let Err(fault) = program.procedures.iter().try_for_each(|p| no_switch(&p.body)) {
        return diags.push(fault);
    }
    let mut walk = Walk::new(entry.clone());
    // What two machines that differ in all that the program has not said agree about, it has said itself.
    let modes = walk.at.modes;
    let control = |seed, skip| {
        let mut world = World::generate(seed, &modes).with_external();
        // The source is judged by its own execution.
        world.arcs = ArcRule::UNTESTED;
        let mut exec = Exec::new(&world, skip);
        exec.assume(&modes);
        exec
    };
    match straight(program, target, &mut walk, (control(1, 0), Some(control(2, u16::MAX))), pack) {
        Ok((mut body, blocks)) => {
            pack(&mut body, true);
            if let Some(first) = body.first() {
                diags.push(Diagnostic::new(Fault::Flattened { blocks }, first.span));
            }
            let title = program.procedures.first().and_then(|main| main.title.clone());
            let name = program.procedures.first().map(|main| main.name.clone()).unwrap_or_default();
            program.procedures = vec![Procedure { name, title, body, ..Procedure::default() }];
        }
        Err(fault) => diags.push(fault),
    }
}

/// The program as a certain control executes it, numbers to nine digits; `None` where it computes and calls
/// nothing.
///
/// # Errors
/// As of the pass.
pub fn by(program: &Program, entry: &Tracker, control: Exec) -> Result<Option<Program>, Diagnostic> {
    if valid::anything(program).is_none() && program.procedures.len() < 2 {
        return Ok(None);
    }
    program.procedures.iter().try_for_each(|p| no_switch(&p.body))?;
    let target = Target { decimals: 9, ..Target::default() };
    let (body, _) =
        straight(program, &target, &mut Walk::new(entry.clone()), (control, None), &mut |_, _| {})?;
    let main = Procedure { body, ..Procedure::default() };
    Ok(Some(Program { procedures: vec![main], ..program.clone() }))
}

/// The blocks that are executed, one after the other, and how many there are. What a program asks of the control, these
/// two have to agree about.
fn straight(
    program: &Program,
    target: &Target,
    walk: &mut Walk,
    (mut exec, mut other): (Exec, Option<Exec>),
    pack: &mut dyn FnMut(&mut Vec<Stmt>, bool),
) -> Result<(Vec<Stmt>, u64), Diagnostic> {
    let mut out: Vec<Stmt> = Vec::new();
    let (mut statements, mut blocks) = (0, 0);
    let mut numbered = HashSet::new();
    let mut runner = Runner::new(program);
    runner.give(&mut |var| {
        target.given.get(&*var.name().to_ascii_lowercase()).map(|value| Value::Number(*value))
    });
    // Else what is executed depends on nothing of the machine; what a feed counts depends on the program.
    let asks = runner.asks();
    let mut unseen = Vec::new();
    let mut steps = 0;
    let mut inches = walk.at.modes.units == Some(Units::Inch);
    let mut short = [Some(0); AXES];
    let most = target.tried_upto.map_or(MOST_STATEMENTS, |most| most as usize);
    loop {
        let Some(stmt) = runner.next_of(&exec, other.as_ref())? else {
            if let Some(at) = valid::returns_alone(program) {
                out.push(Stmt::new(at, Op::Return));
                blocks += 1;
            }
            return Ok((out, blocks));
        };
        let mut stmt = stmt.clone();
        let before = std::mem::replace(&mut steps, runner.steps());
        // After a step that has left nothing a block begins again.
        stmt.joined &= steps == before + 1 && !out.is_empty();
        stmt.number = stmt.number.filter(|number| numbered.insert(*number) && !stmt.joined);
        let over = matches!(stmt.op, Op::ProgramEnd | Op::BeginAgain | Op::Alarm(_)) && stmt.skip.is_none();
        if asks {
            for exec in [&mut exec].into_iter().chain(&mut other).filter(|_| !over) {
                exec.step(&stmt, &mut unseen)?;
                unseen.clear();
            }
        } else if let Op::SetFeedMode(_) = stmt.op {
            exec.step(&stmt, &mut unseen)?;
        }
        if let Op::UseLengthUnits(units) = stmt.op {
            if (units == Units::Inch) != inches {
                let by = |n: &mut i64| *n = if inches { *n * 254 / 10 } else { *n * 10 / 254 };
                short[..3].iter_mut().flatten().for_each(by);
            }
            inches = units == Units::Inch;
        }
        if matches!(stmt.op, Op::Label(_)) {
            // What follows in its block begins that again.
            steps = 0;
            continue;
        }
        make_good(&mut stmt.op, target, inches, walk.at.modes.distance, &mut short);
        round(&mut stmt, target, inches)?;
        walk.enter(stmt.skip);
        settle(&mut stmt.op, &walk.at);
        walk.step(&stmt);
        if statements >= most || target.tried_upto.is_some_and(|most| runner.steps() > u64::from(most)) {
            return Err(Diagnostic::new(Fault::lacks(FlowLack::TooManyBlocks), stmt.span));
        }
        statements += 1;
        blocks += u64::from(!stmt.joined);
        out.push(stmt);
        pack(&mut out, false);
        if over {
            return Ok((out, blocks));
        }
    }
}

/// Adds to computed incremental words what the axes are short of the program's point, to a billionth of the unit, and
/// tells what they are short of it when the words have been rounded; nothing where the writer keeps account of that.
fn make_good(
    op: &mut Op,
    target: &Target,
    inches: bool,
    in_force: Option<Distance>,
    short: &mut [Option<i64>; AXES],
) {
    let point = match op {
        Op::StraightTraverse(to) | Op::StraightFeed(to) | Op::Position(to) | Op::Hole(to) => &mut to.to,
        Op::SynchronisedFeed(to) => &mut to.to,
        Op::ArcFeed(arc) => &mut arc.to,
        Op::GoToReference(reference) => {
            // The same point on both sides.
            let named = reference.via.axes.iter().zip(short).filter(|(word, _)| word.is_some());
            return named.for_each(|(_, short)| *short = Some(0));
        }
        _ => return,
    };
    for (word, short) in point.axes.iter_mut().zip(short) {
        let Some(word) = word else { continue };
        let Some(n) = word.value.literal() else { continue };
        let incremental = word.distance.known().or(in_force) == Some(Distance::Incremental);
        let decimals = target.decimals + u8::from(inches && n.unit == Unit::Entry);
        let Some(own) =
            9u8.checked_sub(n.scale).map(|more| n.mantissa.saturating_mul(POW10[usize::from(more)]))
        else {
            continue;
        };
        // What the program has written the writer rounds, and keeps account of.
        let finer = n.scale > decimals;
        let computed = n.scale >= 8 && finer;
        match (computed, incremental, *short) {
            (false, false, _) => *short = (!finer).then_some(0),
            (false, true, Some(left)) if finer && left != 0 => {
                word.value = to_seven(own.saturating_add(left), n.unit);
                *short = None;
            }
            (false, true, _) if finer => *short = None,
            (false, true, _) => {}
            (true, true, None) => word.value = to_seven(own, n.unit),
            (true, ..) => {
                let before = short.filter(|_| incremental).unwrap_or(0);
                let all = own.saturating_add(before);
                let by = POW10[usize::from(9 - decimals)];
                let half = if all < 0 { -by / 2 } else { by / 2 };
                let said = all.saturating_add(half) / by * by;
                *short = Some(all - said);
                if before != 0 {
                    word.value = Expr::Num(Num { mantissa: said, scale: 9, point: true, unit: n.unit });
                }
            }
        }
    }
}

/// A number of billionths with as many digits as a program may have written.
fn to_seven(billionths: i64, unit: Unit) -> Expr {
    let half = if billionths < 0 { -50 } else { 50 };
    Expr::Num(Num { mantissa: billionths.saturating_add(half) / 100, scale: 7, point: true, unit })
}

/// Rounds what was computed to the target's digits; a length in inches has one more.
fn round(stmt: &mut Stmt, target: &Target, inches: bool) -> Result<(), Diagnostic> {
    // The writer rounds a feed, a time or a value of a table, once, to the digits that those have.
    let feed = matches!(stmt.op, Op::SetData(_) | Op::SetFeedRate(_) | Op::Dwell(_));
    arguments::each(&mut stmt.op, &mut |argument: Argument, unit| {
        let Some(n) = argument.expr().and_then(Expr::literal) else { return Ok(()) };
        let decimals = target.decimals + u8::from(inches && n.unit == Unit::Entry);
        if n.scale < 8 {
            return Ok(());
        }
        if n.scale <= decimals || unit == Unit::One || feed {
            argument.set(Expr::Num(n.trimmed()));
            return Ok(());
        }
        let by = POW10[usize::from(n.scale - decimals)];
        let half = if n.mantissa < 0 { -by / 2 } else { by / 2 };
        let mantissa = n.mantissa.saturating_add(half) / by;
        argument.set(Expr::Num(Num { mantissa, scale: decimals, point: true, unit: n.unit }.trimmed()));
        Ok(())
    })
}

/// Whether a switch of the control can decide which way the program goes.
fn no_switch(body: &[Stmt]) -> Result<(), Diagnostic> {
    for stmt in body {
        if stmt.skip.is_some() && matches!(stmt.op, flow!() | variables!()) {
            return Err(Diagnostic::new(Fault::lacks(FlowLack::SkippedDecision), stmt.span));
        }
        let Op::Control(control) = &stmt.op else { continue };
        for body in control.bodies() {
            no_switch(body)?;
        }
    }
    Ok(())
}
