//! The corpus, flattened and folded.

use ncc_dialects::builtin;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::Program;
use ncc_ir::program::valid::anything;
use ncc_passes::Target;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::Failures;
use ncc_tests::translate;

use super::law::{Table, apply, everything, same};

/// What flattens a program.
const FLATTEN: [&str; 2] = ["expand-patterns", "expand-cycles"];

/// Why boring with a stopped spindle does not come back.
const STOPPED: &str = "no statement of the spindle is read as part of a hole: what it turns after the last \
    hole is the program's business too, and one stop more or less of it is another program";

/// Why a cycle in a tilted plane does not come back.
const TILTED: &str = "nothing is folded in a tilted plane";

/// Why pecks that decrease do not come back.
const DECREASING: &str = "pecks are folded where all but the first and the last are of one depth";

/// Why a peck that is longer than its hole does not come back.
const IN_ONE_GO: &str = "a hole that is made in one go is drilled";

/// What cannot come back, besides cycles of one plain hole: program, what, why.
const LOST: [(&str, &str, &str); 25] = [
    ("haas/decreasing-pecks.nc", "cycle drill-peck of 1", DECREASING),
    ("haas/decreasing-pecks.nc", "cycle drill-peck of 2", DECREASING),
    ("haas/decreasing-pecks.nc", "cycle drill-break of 2", DECREASING),
    ("fanuc/shallow-pecks.nc", "cycle drill-peck of 1", IN_ONE_GO),
    ("fanuc/shallow-pecks.nc", "cycle drill-break of 1", IN_ONE_GO),
    ("fanuc/five-axes.nc", "cycle drill of 3", TILTED),
    ("siemens/five-axes.mpf", "cycle drill of 2", TILTED),
    ("siemens/swivel-post.mpf", "cycle drill of 2", TILTED),
    ("fanuc/holes-both-ways.nc", "cycle drill of 8", "its distance mode changes between the holes"),
    ("fanuc/g86.nc", "cycle bore-stop of 1", STOPPED),
    ("fanuc/g86.nc", "cycle bore-stop of 2", STOPPED),
    ("siemens/boring-stop.mpf", "cycle bore-stop of 1", STOPPED),
    ("linuxcnc/g86.ngc", "cycle bore-stop of 2", STOPPED),
    ("mach3/bores.tap", "cycle bore-stop of 2", STOPPED),
    ("mach3/bores.tap", "cycle bore of 2", "its feed out goes on beyond R, as none is read that way"),
    (
        "linuxcnc/g89-initial.ngc",
        "cycle bore of 2",
        "its feed out goes on beyond R, as none is read that way",
    ),
    ("siemens/fine-boring.mpf", "cycle bore-fine of 1", STOPPED),
    (
        "siemens/cycle-args.mpf",
        "cycle drill of 2",
        "a dwell stands between the two, so that each is one hole",
    ),
    ("siemens/cycle-feed.mpf", "cycle drill-dwell of 4", "its positions are reached at feed"),
    ("siemens/holes1.mpf", "pattern line of 2", "two positions are no pattern"),
    ("siemens/holes2.mpf", "pattern circle of 1", "one position is no pattern"),
    ("siemens/nested.mpf", "cycle drill-dwell of 4", "a feed in a block of its own follows its first hole"),
    (
        "siemens/offsets-under-a-cycle.mpf",
        "cycle drill-dwell of 4",
        "its work offset changes between the holes",
    ),
    ("siemens/points.mpf", "pattern list of 2", "two positions are no pattern"),
    ("siemens/points.mpf", "pattern list of 9", "eight of them lie in a grid"),
];

/// Every program of the corpus that can be flattened makes the same moves folded, for a target that
/// can say everything and for each dialect. What does not come back are cycles of one plain hole.
#[test]
fn the_corpus_flattened_and_folded() {
    let mut failures = Failures::default();
    let (mut table, mut done, mut refused) = (Table::default(), 0, Vec::new());
    let one = Some(Num { mantissa: 1, scale: 0, point: true, unit: Unit::Mm });
    let flat = Target { decimals: 3, peck_clearance: one, break_lift: one, ..Target::default() };
    for program in corpus::all() {
        let name = format!("{}/{}", program.dialect, program.file);
        let Ok(mut before) = translate::read(program.dialect, &program.text) else {
            refused.push(name);
            continue;
        };
        // Holes at a call's positions are the cycle's where they are written out.
        let calls = ["expand-calls", "expand-repeats"];
        let calls = if anything(&before).is_some() { &["flatten"][..] } else { &calls };
        let written_out = apply(calls, &mut before, &flat);
        let mut long_hand = before.clone();
        if written_out.is_err() || apply(&FLATTEN, &mut long_hand, &flat).is_err() {
            refused.push(name);
            continue;
        }
        done += 1;
        let folded = |target: &Target| -> Result<Program, String> {
            let mut after = long_hand.clone();
            apply(&["fold-cycles", "fold-patterns"], &mut after, target)?;
            same(&long_hand, &after, 3)?;
            Ok(after)
        };
        if let Some(after) = failures.check(&name, folded(&everything(8))) {
            let missed = table.count(&before, &after);
            if !missed.is_empty() {
                println!("{name}: {}", missed.join(", "));
            }
            let lost = |what: &str| LOST.iter().any(|l| l.0 == name && l.1 == what);
            let others = missed.iter().filter(|what| *what != "cycle drill of 1" && !lost(what));
            let others: Vec<&String> = others.collect();
            failures.check(&name, if others.is_empty() { Ok(()) } else { Err(format!("{others:?}")) });
        }
        for dialect in DIALECTS {
            let caps = builtin(dialect).map(|d| d.caps.clone()).unwrap_or_default();
            let target = Target { caps, decimals: 3, ..Target::default() };
            failures.check(format!("{name} for {dialect}"), folded(&target));
        }
    }
    println!("{done} programs, not flattened: {}\n{}", refused.join(" "), table.show());
    failures.finish();
    assert!(done > refused.len(), "most of the corpus is flattened");
}
