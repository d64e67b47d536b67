//! Arcs in all their forms.

use super::*;

#[test]
fn centres_are_from_the_start_unless_they_say_otherwise() {
    assert_eq!(
        after_head("G2 X10 Y0 I5\nG3 X1 Y2 I=IC(3) J4 TURN=2\nG91 G2 X1 I1 J0\n"),
        [
            "ARC! Xy Clockwise X10 Y0 I5",
            "ARC! Xy Counterclockwise X1 Y2 I3 J4 turns 2",
            "SetDistanceMode(Incremental)",
            "& ARC! Xy Clockwise X+=1 I1 J0"
        ]
    );
    assert_eq!(
        after_head("G3 I=AC(0) J=AC(92.07)\nX1 Y1 I=AC(0) J3\nG2 X3 I=AC(2)\n"),
        [
            "ARC! Xy Counterclockwise I=0 J=92.07",
            "ARC Xy X1 Y1 Counterclockwise about I0 J+=3",
            "ARC! Xy X3 Clockwise about I2"
        ]
    );
}

#[test]
fn by_radius_and_by_angle() {
    assert_eq!(
        after_head("G2 X10 CR=5\nG3 X0 CR=-7.5\nG2 X10 Y10 AR=90\nG3 I5 AR=120.5\nG3 I=AC(1) J2 AR=10 Z3\n"),
        [
            "ARC! Xy Clockwise X10 R5",
            "ARC! Xy Counterclockwise X0 R-7.5",
            "ARC! Xy X10 Y10 Clockwise by 90deg",
            "ARC! Xy Counterclockwise by 120.5deg about I+=5",
            "ARC! Xy Z3 Counterclockwise by 10deg about I1 J+=2"
        ]
    );
}

#[test]
fn through_a_point_and_tangent() {
    assert_eq!(
        after_head("CIP X50 Y40 I1=40 J1=45\nX70 Y0 I1=IC(9) J1=2\nCT X80 Y8\nX90\nG1 X0\n"),
        [
            "ARC! Xy X50 Y40 through X40 Y45",
            "ARC Xy X70 Y0 through X+=9 Y2",
            "ARC! Xy X80 Y8 tangent",
            "ARC Xy X90 tangent",
            "FEED! X0"
        ]
    );
}

#[test]
fn the_plane_decides_which_words_count() {
    assert_eq!(
        after_head("G18 G2 X1 Z2 I3 K4\nG19 G3 J1 K2 X5\n"),
        [
            "SelectPlane(Zx)",
            "& ARC! Zx Clockwise X1 Z2 I3 K4",
            "SelectPlane(Yz)",
            "& ARC! Yz Counterclockwise X5 J1 K2"
        ]
    );
    assert_eq!(faults("G2 X1 I2 K3\n"), ["WordUnused { word: 'K3' } at 'K3'"]);
}

#[test]
fn arcs_that_are_none() {
    assert_eq!(faults("G2 X5\n"), ["ArcWithoutCentre at 'G2 X5'"]);
    assert_eq!(faults("G2 CR=5\n"), ["ArcRadiusNoWay at 'G2 CR=5'"]);
    assert_eq!(faults("G2 X5 I1 CR=5\n"), ["ArcCentreAndRadius at 'CR=5'"]);
    assert_eq!(faults("G2 X5 I1 AR=5\n"), ["ArcCentreAndRadius at 'AR=5'"]);
    assert_eq!(faults("G2 AR=5\n"), ["ArcWithoutCentre at 'AR=5'"]);
    assert_eq!(faults("G2 X5 AR=360\n"), ["OutOfRange { word: Word('AR=360') } at 'AR=360'"]);
    assert_eq!(faults("G2 X5 CR=0\n"), ["OutOfRange { word: Word('CR=0') } at 'CR=0'"]);
    assert_eq!(faults("G2 I5 TURN=1000\n"), ["OutOfRange { word: Word('TURN=1000') } at 'TURN=1000'"]);
    assert_eq!(faults("G2 I5 TURN=1.\n"), ["PointNotAllowed { word: 'TURN=1.' } at 'TURN=1.'"]);
    assert_eq!(faults("CIP X5 Y2 I1=3\n"), ["WordMissing { code: 'CIP', word: 'J1' } at 'CIP X5 Y2 I1=3'"]);
    assert_eq!(faults("CT X5 I1\n"), ["WordUnused { word: 'I1' } at 'I1'"]);
    assert_eq!(faults("G1 X5 CR=5\n"), ["WordUnused { word: 'CR=5' } at 'CR=5'"]);
}
