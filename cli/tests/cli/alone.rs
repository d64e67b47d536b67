//! Subprograms that are files of their own, known by the extension of their names.

use std::fs;

use super::*;

const SLOT: &str = "G90 G0 X5 Y5\nG1 X10 F100\nM17\n";

#[test]
fn a_sinumerik_knows_a_subprogram_by_its_extension() {
    let folder = folder();
    let folder = folder.path();
    for name in ["slot.spf", "slot.mpf", "slot.txt"] {
        fs::write(folder.join(name), SLOT).unwrap();
    }
    // It says nothing that would be its caller's, and goes back to that.
    let sub = ncc(folder, &["siemens", "to", "fanuc", "slot.spf"]).exits(0).out;
    assert!(sub.contains("\nM99\n") && !sub.contains("M30") && !sub.contains("\nG54"), "{sub}");
    let main = ncc(folder, &["siemens", "to", "fanuc", "slot.mpf"]).exits(0).out;
    assert!(main.contains("\nM30\n") && main.contains("\nG54\n"), "{main}");
    let told = ncc(folder, &["siemens", "to", "fanuc", "slot.txt"]).exits(0);
    assert!(told.out.contains("\nM30\n"), "{}", told.out);
    told.says("M17 ends a main program = yes");
    // Back again, and into a control that has no such text.
    let again = ncc(folder, &["siemens", "to", "siemens", "slot.spf"]).exits(0).out;
    assert!(again.ends_with("\nM17\n") && !again.contains("\nG54"), "{again}");
    ncc(folder, &["siemens", "to", "linuxcnc", "slot.spf"]).exits(1).says("without its main program");
    // One of a Fanuc goes back too.
    fs::write(folder.join("slot.nc"), "%\nO9001\nG90 G0 X5. Y5.\nG1 X10. F100.\nM99\n%\n").unwrap();
    let other = ncc(folder, &["fanuc", "to", "siemens", "slot.nc"]).exits(0).out;
    assert!(other.ends_with("\nM17\n") && !other.contains("\nG54"), "{other}");
}
