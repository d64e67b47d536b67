//! Canned cycles and their holes.

use crate::*;
use ncc_ir::canon::{Fact, Plane, ReturnLevel};
use ncc_ir::program::cycle::{Approach, Clearance, Cycle, CycleKind};
use ncc_ir::program::{Coord, Op};

pub(crate) fn cycle(kind: CycleKind) -> Cycle {
    Cycle {
        kind,
        plane: Fact::Known(Plane::Xy),
        retract: coord("3."),
        depth: coord("-6."),
        return_level: Fact::Entry,
        return_plane: Some(coord("10.")),
        reference: None,
        approach: Approach::PlaneFirst,
        feed: None,
    }
}

pub(crate) fn start(cycle: Cycle) -> Op {
    Op::StartCycle(Box::new(cycle))
}

fn drill() -> Op {
    start(cycle(CycleKind::Drill))
}

fn peck(clearance: Clearance, first: Option<&str>) -> CycleKind {
    let (pause, settle, dwell) = (Some(seconds("0.5")), Some(seconds("1.")), Some(seconds("0.5")));
    CycleKind::DrillPeck { peck: mm("2."), first: first.map(mm), less: None, clearance, pause, settle, dwell }
}

fn stated(text: &str) -> Clearance {
    Clearance::Stated(mm(text))
}

#[test]
fn a_cycle_is_called_for_the_blocks_that_follow() {
    let stmts = lines(vec![rapid("X0."), drill(), hole("X1."), hole("Y2."), Op::EndCycle, rapid("Z50.")]);
    assert_eq!(clean(&stmts), "G0 X0\nMCALL CYCLE81(10,3,0,-6)\nX1\nY2\nMCALL\nG0 Z50\n");
}

#[test]
fn return_levels_become_planes() {
    let level = |level| {
        let cycle = Cycle { return_plane: None, return_level: Fact::Known(level), ..cycle(CycleKind::Drill) };
        lines(vec![rapid("Z25."), start(cycle), hole("X1.")])
    };
    assert_eq!(clean(&level(ReturnLevel::Retract)), "G0 Z25\nMCALL CYCLE81(3,3,0,-6)\nX1\n");
    assert_eq!(clean(&level(ReturnLevel::Initial)), "G0 Z25\nMCALL CYCLE81(25,3,0,-6)\nX1\n");
    let below = Cycle { return_plane: Some(coord("1.")), ..cycle(CycleKind::Drill) };
    refused(&lines(vec![rapid("Z25."), start(below)]));
}

#[test]
fn planes_from_elsewhere_are_worked_out() {
    let incremental =
        |text: &str| Coord { value: mm(text), distance: Fact::Known(ncc_ir::canon::Distance::Incremental) };
    let cycle = Cycle { retract: incremental("-48."), depth: incremental("-10."), ..cycle(CycleKind::Drill) };
    let stmts = lines(vec![rapid("Z50."), start(cycle), hole("X1.")]);
    assert_eq!(clean(&stmts), "G0 Z50\nMCALL CYCLE81(10,2,0,-8)\nX1\n");
}

#[test]
fn the_feed_of_a_cycle_has_its_own_block_once() {
    let fed = |feed: &str| start(Cycle { feed: Some(mm(feed)), ..cycle(CycleKind::Drill) });
    let stmts = lines(vec![rapid("X0."), fed("191."), hole("X1."), fed("191."), hole("X2."), fed("90.")]);
    let call = "MCALL CYCLE81(10,3,0,-6)\n";
    assert_eq!(text(&stmts).0, format!("G0 X0\nF191\n{call}X1\n{call}X2\nF90\n{call}"));
}

#[test]
fn positions_are_reached_in_rapid() {
    let stmts = lines(vec![feed("X0."), drill(), hole("X1."), hole("X2."), Op::EndCycle, on("X3.")]);
    assert_eq!(clean(&stmts), "G1 X0\nMCALL CYCLE81(10,3,0,-6)\nG0 X1\nX2\nMCALL\nG1 X3\n");
}

#[test]
fn a_move_ends_a_cycle_that_the_program_does_not_end() {
    let stmts = lines(vec![rapid("X0."), drill(), hole("X1."), rapid("Z50."), rapid("X0.")]);
    assert_eq!(text(&stmts).0, "G0 X0\nMCALL CYCLE81(10,3,0,-6)\nX1\nMCALL\nG0 Z50\nG0 X0\n");
}

#[test]
fn a_hole_where_the_tool_stands() {
    let here = || hole("");
    let once = blocks(vec![vec![rapid("X1. Y2.")], vec![drill(), here(), Op::EndCycle], vec![rapid("X3.")]]);
    assert_eq!(clean(&once), "G0 X1 Y2\nCYCLE81(10,3,0,-6)\nG0 X3\n");
    let stmts = lines(vec![rapid("X1. Y2."), drill(), here(), hole("X3."), Op::EndCycle]);
    assert_eq!(clean(&stmts), "G0 X1 Y2\nMCALL CYCLE81(10,3,0,-6)\nX1 Y2\nX3\nMCALL\n");
    let stmts = lines(vec![rapid("X1."), drill(), here()]);
    assert_eq!(clean(&stmts), "G0 X1\nMCALL CYCLE81(10,3,0,-6)\nX1 Y=IC(0)\n");
}

#[test]
fn dwell_and_bore() {
    let dwell = start(cycle(CycleKind::DrillDwell { dwell: seconds("0.6") }));
    assert_eq!(clean(&lines(vec![rapid("X0."), dwell])), "G0 X0\nMCALL CYCLE82(10,3,0,-6,,0.6)\n");
    let bore = |feed: Option<&str>, out: Option<&str>| {
        let kind = CycleKind::Bore { dwell: None, feed_out: out.map(mm), to_level: false };
        start(Cycle { feed: feed.map(mm), ..cycle(kind) })
    };
    let stmts = lines(vec![rapid("X0."), bore(Some("60."), Some("120.")), hole("X1.")]);
    assert_eq!(clean(&stmts), "G0 X0\nMCALL CYCLE85(10,3,0,-6,,,60,120)\nX1\n");
    refused(&lines(vec![rapid("X0."), bore(None, None)]));
}

#[test]
fn the_feed_is_said_again_after_boring() {
    let bore = start(cycle(CycleKind::Bore { dwell: None, feed_out: None, to_level: false }));
    let stmts = lines(vec![
        Op::SetFeedRate(mm("80.")),
        feed("X0."),
        bore,
        hole("X1."),
        Op::EndCycle,
        rapid("X2."),
        feed("X3."),
        feed("X4."),
    ]);
    let (text, _) = text(&stmts);
    assert_eq!(text, "F80\nG1 X0\nMCALL CYCLE85(10,3,0,-6,,,80,80)\nG0 X1\nMCALL\nG0 X2\nG1 X3 F80\nG1 X4\n");
}

#[test]
fn pecks() {
    let deep = |kind| lines(vec![rapid("X0."), start(cycle(kind))]);
    let (text, faults) = told(&deep(peck(stated("0.6"), None)));
    assert_eq!(text, "G0 X0\nMCALL CYCLE83(10,3,0,-6,,,2,0,0.5,1,1,1,,,,,0.6)\n");
    assert!(matches!(faults.as_slice(), [Fault::AssumedRow { .. }]), "{faults:?}");
    // A longer first peck stands the two planes apart.
    let (text, _) = told(&deep(peck(stated("0.6"), Some("3.5"))));
    assert_eq!(text, "G0 X0\nMCALL CYCLE83(10,1.5,1.5,-6,,,2,0,0.5,1,1,1,,,,,0.6)\n");
    refused(&deep(peck(stated("0.6"), Some("1."))));
    refused(&deep(peck(Clearance::Parameter, None)));
    refused(&deep(peck(stated("0."), None)));
    let chips = |dwell: Option<&str>, at_feed| CycleKind::DrillBreak {
        peck: mm("2."),
        first: None,
        less: None,
        lift: stated("1."),
        lift_at_feed: at_feed,
        pause: None,
        dwell: dwell.map(seconds),
    };
    let (text, _) = told(&deep(chips(None, true)));
    assert_eq!(text, "G0 X0\nMCALL CYCLE83(10,3,0,-6,,,2,0,,,1,0,,,1)\n");
    let (text, _) = told(&deep(chips(Some("0.3"), true)));
    assert_eq!(text, "G0 X0\nMCALL CYCLE83(10,3,0,-6,,,2,0,,,1,0,,,1,0.3)\n");
    refused(&deep(chips(None, false)));
}

#[test]
fn a_cycle_in_a_block_that_can_be_skipped() {
    let mut stmts = lines(vec![rapid("X0."), drill(), hole("X1."), rapid("X2.")]);
    (stmts[1].skip, stmts[2].skip) = (Some(1), Some(1));
    assert_eq!(text(&stmts).0, "G0 X0\n/MCALL CYCLE81(10,3,0,-6)\n/X1\nMCALL\nG0 X2\n");
}

#[test]
fn a_cycle_once_is_called_for_more_only_if_more_holes_follow() {
    let here = || vec![drill(), hole("")];
    let stmts = blocks(vec![
        vec![feed("X1.")],
        here(),
        vec![Op::EndCycle, feed("X2.")],
        here(),
        vec![hole("Y1.")],
        vec![Op::EndCycle],
        vec![rapid("X3.")],
    ]);
    let call = "CYCLE81(10,3,0,-6)";
    let expected = format!("G1 X1\n{call}\nG1 X2\n{call}\nMCALL {call}\nG0 Y1\nMCALL\nG0 X3\n");
    assert_eq!(text(&stmts).0, expected);
    // Nor may a switch decide whether it is active.
    let mut stmts = blocks(vec![vec![rapid("X1.")], here(), vec![hole("Y1.")], vec![hole("Y2.")]]);
    stmts[3].skip = Some(1);
    assert_eq!(text(&stmts).0, format!("G0 X1\n{call}\nMCALL {call}\n/Y1\nY2\n"));
}

#[test]
fn dwells_have_no_zeros_that_nobody_wrote() {
    let dwell = start(cycle(CycleKind::DrillDwell { dwell: seconds("0.300") }));
    assert_eq!(clean(&lines(vec![rapid("X0."), dwell])), "G0 X0\nMCALL CYCLE82(10,3,0,-6,,0.3)\n");
}

#[test]
fn a_first_peck_is_reckoned_in_the_programs_own_unit() {
    let entry = |text: &str| ncc_ir::expr::Expr::Num(num(text, ncc_ir::expr::num::Unit::Entry));
    let level = |text: &str| Coord { value: entry(text), distance: coord("0.").distance };
    let kind = CycleKind::DrillPeck {
        peck: entry("10."),
        first: Some(entry("12.5")),
        less: None,
        clearance: Clearance::Stated(entry("0.6")),
        pause: None,
        settle: None,
        dwell: None,
    };
    let cycle =
        Cycle { retract: level("2."), depth: level("-25."), return_plane: Some(level("5.")), ..cycle(kind) };
    let (text, _) = told(&lines(vec![rapid("X0."), start(cycle)]));
    assert_eq!(text, "G0 X0\nMCALL CYCLE83(5,-0.5,2.5,-25,,,10,0,,,1,1,,,,,0.6)\n");
}

#[test]
fn a_feed_goes_with_its_move_and_not_before_the_end_of_a_cycle() {
    let stmts = blocks(vec![
        vec![rapid("X0.")],
        vec![drill()],
        vec![hole("X1.")],
        vec![Op::EndCycle, Op::SetFeedRate(mm("200.")), feed("X2.")],
        vec![drill()],
        vec![Op::SetFeedRate(mm("90.")), feed("X3.")],
    ]);
    let call = "MCALL CYCLE81(10,3,0,-6)\n";
    assert_eq!(text(&stmts).0, format!("G0 X0\n{call}X1\nMCALL\nG1 X2 F200\n{call}MCALL\nG1 X3 F90\n"));
}

/// Holes that are nothing but their places are written without the general way, and leave the same state.
#[test]
fn plain_holes_and_the_general_way_write_the_same() {
    let holes = ["X1. Y2.", "X3.5", "Y-4.25", "", "X1. Z5.", "X0.12345 Y2.", "X1.", "X2."].map(hole);
    let level = |level| Op::SetReturnLevel(level);
    let return_level = Fact::Known(ReturnLevel::Initial);
    let to_initial = Cycle { return_plane: None, return_level, ..cycle(CycleKind::Drill) };
    let tails = [
        vec![Op::EndCycle, rapid("Z50."), drill(), hole("X1.")],
        vec![level(ReturnLevel::Initial), hole("X7."), drill(), hole("X8.")],
        // Another cycle begins where the holes have left the tool.
        vec![Op::EndCycle, start(to_initial), hole("X1.")],
        vec![feed("X9.")],
        vec![rapid_on("X9."), hole("X1.")],
        vec![Op::SelectPlane(Plane::Zx), hole("X1."), drill(), hole("X2. Z3.")],
    ];
    for tail in tails {
        for cut in 0..holes.len() {
            let head = vec![rapid("X0. Y0. Z50."), Op::SetFeedRate(mm("100")), level(ReturnLevel::Retract)];
            let ops = head.into_iter().chain([drill()]).chain(holes[cut..].iter().cloned());
            let mut stmts = lines(ops.chain(tail.iter().cloned()).collect());
            stmts[5].comment = Some(Box::new("a remark".into()));
            let (fast, told) = text(&stmts);
            let (general, told_there) = text(&the_general_way(&stmts));
            assert_eq!((fast, told), (without_empty_remarks(&general, ";"), told_there));
        }
    }
}
