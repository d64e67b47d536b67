//! Subprograms under a cycle of their caller, for a control whose cycles they cannot end.

use super::*;

/// A Fanuc program whose subprogram has a first block, called while a cycle is in force or not.
fn program(before: &str, first: &str) -> String {
    format!(
        "%\nO1\nG21 G17 G90 G94 G54 G40 G49 G80\nT1 M06\nS500 M03\nG00 X0. Y0.\nG43 H1 Z10.\n{before}\nM98 P2\n\
         G00 Z10.\nX50. Y50.\nM05\nM30\nO2\n{first}\nZ20.\nX5.\nM99\n%\n"
    )
}

fn translated(text: &str) -> Done {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("part.nc"), text).unwrap();
    ncc(folder.path(), &["fanuc", "to", "siemens", "part.nc", "--no-head", "-q"])
}

#[test]
fn one_that_ends_its_callers_cycle_is_written_out() {
    let cycle = "G99 G81 X10. Y10. Z-5. R2. F100.";
    for first in ["G80\nG00 Z20.", "G01 X30. F100.", "G00 X30."] {
        let done = translated(&program(cycle, first)).exits(0);
        assert!(done.out.contains("MCALL CYCLE81") && !done.out.contains("_SPF"), "{first}: {}", done.out);
    }
}

#[test]
fn one_that_no_cycle_reaches_stays() {
    let done = translated(&program("G01 X10. F100.", "G80\nG00 Z20.")).exits(0);
    assert!(done.out.contains("_SPF"), "{}", done.out);
}
