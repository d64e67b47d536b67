//! Subprograms without their main program, as shops keep them: what the caller has active is not stated, and the output
//! is read with it.

use ncc_ir::canon::Units;
use ncc_ir::diag::Fault;
use ncc_tests::translate::{job, translate};

const SUB: &str =
    "%\nO1002\nG91 G01 Z-.08\nG90\nG00 X-.5 Y.125\nG01 X.625\nG02 X1.375 I.375 J0.\nG00 X-.5\nM99\n%\n";

/// The output states neither the unit nor the feed, whatever unit the target begins with.
#[test]
fn a_subprogram_has_its_callers_unit_and_feed() {
    for (from, to) in [("haas", "fanuc"), ("fanuc", "haas"), ("haas", "siemens"), ("fanuc", "siemens")] {
        for units in [Units::Mm, Units::Inch] {
            let mut job = job(from, to, "sub.nc");
            job.head = false;
            assert!(job.from.state_units(units));
            let (outcome, text) = translate(&job, SUB.as_bytes());
            let text = String::from_utf8_lossy(&text).into_owned();
            assert!(outcome.release.is_ok(), "{from} to {to}, {units:?}: {:?}", outcome.diagnostics);
            for stated in ["F", "G20", "G21", "G70", "G71", "G700", "G710"] {
                assert!(
                    !text.split_whitespace().any(|word| word.starts_with(stated)),
                    "{from} to {to}: {text}"
                );
            }
        }
    }
}

/// A main program that moves at feed before any F is refused: it has no caller.
#[test]
fn a_main_program_states_its_feed() {
    let text = SUB.replace("M99", "M30");
    for from in ["haas", "fanuc"] {
        let (outcome, _) = translate(&job(from, "siemens", "main.nc"), text.as_bytes());
        assert!(outcome.diagnostics.iter().any(|d| d.fault == Fault::NoFeed), "{from}");
    }
}
