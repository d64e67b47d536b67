//! Programmed frames.

use super::*;

#[test]
fn frames_replace_and_append() {
    assert_eq!(
        after_head(
            "TRANS X10 Z-1.5 A30\nATRANS Y=5\nROT RPL=30\nAROT Z-12.5\nSCALE X2 Y.5\nAMIRROR X0 Y1\nTRANS\nROT\n"
        ),
        [
            "SHIFT X10 Z-1.5 A30deg",
            "+SHIFT Y5",
            "TURN Xy 30deg",
            "+TURN Xy -12.5deg",
            "SCALE X2 Y0.5",
            "+MIRROR XY",
            "ClearFrame(Chain)",
            "ClearFrame(Chain)"
        ]
    );
    assert_eq!(after_head("G18\nROT X0 Y20\n")[1], "TURN Zx 20deg");
}

#[test]
fn frames_that_are_refused() {
    let refused = |code: &str, what: &str, at: &str| {
        [format!("NotSupported {{ code: '{code}', what: {what} }} at '{at}'")]
    };
    assert_eq!(faults("ROT X30\n"), refused("ROT", "Frame(RotationAboutPlaneAxis)", "X30"));
    assert_eq!(faults("ATRANS\n"), refused("ATRANS", "Frame(AppendedNothing)", "ATRANS"));
    assert_eq!(faults("TRANS X5 G0\n"), refused("TRANS", "Frame(BesideFunctions)", "TRANS"));
    assert_eq!(faults("TRANS X=IC(5)\n"), refused("X=IC(5)", "Frame(FrameDistance)", "X=IC(5)"));
    assert_eq!(faults("TRANS X5 F9\n"), ["WordUnused { word: 'F9' } at 'F9'"]);
    assert_eq!(faults("SCALE X0\n"), ["OutOfRange { word: Word('X0') } at 'X0'"]);
    assert_eq!(faults("SCALE X-1\n"), ["OutOfRange { word: Word('X-1') } at 'X-1'"]);
    assert_eq!(faults("G58 X5\n"), refused("G58", "Code(Named { name: 'axial absolute shift' })", "G58"));
    assert_eq!(
        faults("ROTS X5 Y5\n"),
        refused("ROTS", "Code(Named { name: 'rotation by solid angles' })", "ROTS")
    );
}
