//! The second interpreter: it runs the corpus, and its events are the compiler's.

use ncc_ir::canon::Units;
use ncc_ir::diag::Fault;
use ncc_ir::program::Op;
use ncc_tests::besides;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::Failures;
use ncc_tests::interpreter::Setup;
use ncc_tests::plain::{self, Corners, Tolerance};
use ncc_tests::translate;

use crate::twice::next_runs_alike;

/// Every program of the corpus is in the second interpreter's scope.
#[test]
fn runs_the_corpus() {
    let mut failures = Failures::default();
    for program in corpus::all() {
        let what = format!("{}/{}", program.dialect, program.file);
        failures.check(&what, plain::second(program.dialect, &program.text, Setup::plain()));
    }
    failures.finish();
}

/// The compiler's reader and execution, and the second interpreter: the same events, in machine
/// coordinates, in the plain world and in generated ones, with all skip switches off and all on.
#[test]
fn agrees_with_the_compiler_on_the_corpus() {
    let mut failures = Failures::default();
    for program in corpus::all() {
        let what = format!("{}/{}", program.dialect, program.file);
        let Some(read) = failures.check(&what, translate::read(program.dialect, &program.text)) else {
            continue;
        };
        for world in [0, 1, 2].map(|seed| plain::of_dialect(plain::world(seed), program.dialect)) {
            for skip in [0, 0b10, 0x7fe] {
                let second = plain::second(program.dialect, &program.text, plain::setup(&world, skip));
                let start = world.start.map(|n| n as f64 / 1e9);
                let result = second.and_then(|machine| {
                    let events = translate::execute(&read, &world, skip)?;
                    let a = plain::of_machine(&machine, start);
                    let b = plain::of_events(&events, start);
                    plain::compare(&a, &b, Tolerance::SAME)
                });
                failures.check(format!("{what} world {} skip {skip:b}", world.seed), result);
            }
        }
    }
    failures.finish();
}

/// What was emitted makes the source's moves: judged by the second interpreter alone.
#[test]
fn emitted_programs_make_the_same_moves() {
    let mut failures = Failures::default();
    let (mut pairs, mut twice) = (0, 0);
    for program in corpus::all() {
        for to in DIALECTS {
            let what = format!("{}/{} to {to}", program.dialect, program.file);
            let job = translate::straight_job(&program, to);
            let (outcome, text) = translate::translate(&job, &program.text);
            if outcome.release.is_err() {
                continue;
            }
            pairs += 1;
            // The one work offset of a control without words for it is the one that is named.
            let only = outcome.diagnostics.iter().find_map(|d| match d.fault {
                Fault::AssumedWorkOffset { offset } if job.to.dialect.caps.frames.work_offsets == 0 => {
                    Some(offset)
                }
                _ => None,
            });
            let within = Tolerance {
                corners: Corners::between(program.dialect, to),
                arcs: plain::says_arcs(to),
                ..rounded(&program)
            };
            for world in [0, 1, 2].map(plain::world) {
                // Where a peck cycle was written out, this is what the head says was assumed.
                let world = plain::of_dialect(world, program.dialect);
                // Where tools are put in by hand, the zero of Z is set by each.
                let world = besides::zeroed(world, [program.dialect, to]);
                let start = world.start.map(|n| n as f64 / 1e9);
                let list = |dialect: &str, text: &[u8], skip, offset: Option<u16>| {
                    let mut setup = plain::setup(&world, skip);
                    setup.power_on.offset = offset.map_or(setup.power_on.offset, u32::from);
                    let machine = plain::second(dialect, text, setup)?;
                    Ok::<_, String>(plain::of_machine(&machine, start))
                };
                for skip in [0, 0x7fe] {
                    let result = list(program.dialect, &program.text, skip, None)
                        .map(|list| besides::for_target(list, &job))
                        .and_then(|source| plain::compare(&source, &list(to, &text, skip, only)?, within));
                    let result = result.and_then(|()| {
                        if (world.seed, skip) == (1, 0) {
                            let to = (to, &text[..]);
                            twice += u32::from(next_runs_alike(&program, to, &world, within, &outcome)?);
                        }
                        Ok(())
                    });
                    if let Err(fault) = result {
                        failures.add(&what, format!("{fault}\n{}", String::from_utf8_lossy(&text)));
                    }
                }
            }
        }
    }
    println!("{pairs} pairs; {twice} of them leave something to their next run");
    failures.finish();
    assert!(twice > 10, "{twice}");
}

/// How far an output may be off: a feed in inches has three digits.
fn rounded(program: &corpus::Program) -> Tolerance {
    let in_inches = translate::read(program.dialect, &program.text).is_ok_and(|read| {
        let mut stmts = read.procedures.iter().flat_map(|p| &p.body);
        stmts.any(|s| s.op == Op::UseLengthUnits(Units::Inch))
    });
    let feed = if in_inches { 0.0005 * 25.4 + 0.002 } else { Tolerance::ROUNDED.feed };
    Tolerance { feed, ..Tolerance::ROUNDED }
}
