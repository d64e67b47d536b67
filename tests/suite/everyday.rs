//! Subprograms without their main program, as shops keep them: what the caller has active is not stated, and the output
//! is read with it.

use ncc_ir::canon::Units;
use ncc_ir::diag::Fault;
use ncc_tests::plain::{self, Corners, Tolerance};
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

/// An arc without centre and radius is a straight line, if the source's control makes it one: in all targets, and by the
/// second interpreter.
#[test]
fn an_arc_without_centre_may_be_a_line() {
    let text = "%\nO1\nG21 G17 G90 G94 G54 G40 G49 G80\nT1 M06\nS900 M03\nG00 X0. Y0.\nG43 H1 Z5.\nG01 Z-1. F200.\n\
                G03 X10. Y4.\nX20. Y0. R12.\nX30.\nG01 X0.\nG00 Z50.\nM30\n%\n";
    let refused = translate(&job("fanuc", "haas", "line.nc"), text.as_bytes()).0;
    assert!(refused.diagnostics.iter().any(|d| d.fault == Fault::ArcWithoutCentre));
    for to in ["haas", "siemens", "linuxcnc"] {
        let mut job = job("fanuc", to, "line.nc");
        job.from.choose("arc_without_centre", "line").expect("an option of the source");
        let (outcome, out) = translate(&job, text.as_bytes());
        assert!(outcome.release.is_ok(), "{to}: {:?}", outcome.diagnostics);
        let world = plain::of_dialect(plain::world(0), "fanuc");
        let run = |dialect: &str, text: &[u8]| {
            let mut setup = plain::setup(&world, 0);
            setup.line_without_centre = dialect == "fanuc";
            let machine = plain::second(dialect, text, setup).expect("a program that runs");
            plain::of_machine(&machine, world.start.map(|n| n as f64 / 1e9))
        };
        let within =
            Tolerance { place: 0.002, feed: 0.5, corners: Corners::between("fanuc", to), arcs: false };
        plain::compare(&run("fanuc", text.as_bytes()), &run(to, &out), within).expect("the same moves");
    }
}
