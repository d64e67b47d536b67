//! Cycles and patterns, on a control that drills with the call and on one that does not.

use crate::*;
use ncc_ir::canon::ReturnLevel;
use ncc_ir::program::Call;
use ncc_ir::program::cycle::{Along, Approach, Clearance, Cycle, CycleKind, First, Pattern, Row};

fn cycle(kind: CycleKind, depth: &str, feed: Option<&str>) -> Cycle {
    Cycle {
        kind,
        plane: Fact::Known(Plane::Xy),
        retract: coord("3."),
        depth: coord(depth),
        return_level: Fact::Known(ReturnLevel::Retract),
        return_plane: None,
        reference: None,
        approach: Approach::RaiseFirst,
        feed: feed.map(mm),
    }
}

fn peck(clearance: Clearance, dwell: Option<Expr>) -> CycleKind {
    CycleKind::DrillPeck {
        peck: mm("2."),
        first: None,
        less: None,
        clearance,
        pause: None,
        settle: None,
        dwell,
    }
}

fn start(cycle: Cycle) -> Op {
    Op::StartCycle(Box::new(cycle))
}

fn drill(depth: &str, feed: Option<&str>) -> Op {
    start(cycle(CycleKind::Drill, depth, feed))
}

fn circle() -> Pattern {
    Pattern::Circle {
        centre: None,
        first: First::At([coord("0"), coord("18.")]),
        step: Expr::Num(num("30.", Unit::Degree)),
        count: 12,
    }
}

fn row(axis: Axis, pitch: &str, count: u32) -> Row {
    Row { along: Along::Axis(axis), pitch: mm(pitch), count }
}

#[test]
fn a_call_waits_for_its_first_hole() {
    let stmts = lines(vec![
        rapid("X0. Y0."),
        drill("-6.", Some("191")),
        Op::Comment("HOLES".into()),
        hole("X0. Y18."),
        hole("X-9. Y15.588"),
        Op::EndCycle,
        rapid_on("Z0."),
    ]);
    assert_eq!(
        clean("fanuc", &stmts),
        "G00 X0. Y0.\n(HOLES)\nG99 G81 X0. Y18. Z-6. R3. F191.\nX-9. Y15.588\nG80\nG00 Z0.\n"
    );
    assert_eq!(
        clean("mach9", &stmts),
        "G0X0.Y0.\nG81Z-6.R3.F191\n;HOLES\nX0.Y18.\nX-9.Y15.588\nG80\nG0Z0.\n"
    );
}

#[test]
fn a_call_and_its_first_hole_in_one_block() {
    let stmts = blocks(vec![
        vec![rapid("X0. Y0.")],
        vec![
            Op::SetReturnLevel(ReturnLevel::Retract),
            drill("-6.", Some("100.")),
            Op::Hole(Move { to: point("X1. Y2."), said: true }),
        ],
        vec![hole("X3.")],
    ]);
    assert_eq!(clean("fanuc", &stmts), "G00 X0. Y0.\nG99 G81 X1. Y2. Z-6. R3. F100.\nX3.\n");
    let (text, diags) = text("mach9", &stmts);
    assert_eq!(text, "G0X0.Y0.\nG81Z-6.R3.F100\nX1.Y2.\nX3.\n");
    assert_eq!(faults(&diags), [&Fault::BlockSplit]);
}

#[test]
fn the_return_level_is_stated_where_the_source_does_not() {
    let again = |level| {
        let mut c = cycle(CycleKind::Drill, "-6.", None);
        c.return_level = Fact::Known(level);
        start(c)
    };
    let said = |words| Op::Hole(Move { to: point(words), said: true });
    // Known by the source's own word: not stated again.
    let stmts = lines(vec![
        rapid("X0."),
        Op::SetReturnLevel(ReturnLevel::Initial),
        again(ReturnLevel::Initial),
        said("X1."),
        again(ReturnLevel::Initial),
        said("X2."),
    ]);
    assert_eq!(clean("fanuc", &stmts), "G00 X0.\nG98\nG81 X1. Z-6. R3.\nG81 X2. Z-6. R3.\n");
    // Not known: stated with every call.
    let stmts = lines(vec![
        rapid("X0."),
        again(ReturnLevel::Retract),
        said("X1."),
        again(ReturnLevel::Initial),
        said("X2."),
        again(ReturnLevel::Initial),
        said("X3."),
    ]);
    assert_eq!(
        clean("fanuc", &stmts),
        "G00 X0.\nG99 G81 X1. Z-6. R3.\nG98 G81 X2. Z-6. R3.\nG98 G81 X3. Z-6. R3.\n"
    );
    refused("mach9", &lines(vec![rapid("X0."), again(ReturnLevel::Initial), hole("X1.")]));
}

#[test]
fn a_hole_where_the_tool_stands() {
    let stmts = lines(vec![rapid("X4. Y5."), drill("-6.", Some("191")), hole(""), hole("")]);
    assert_eq!(clean("fanuc", &stmts), "G00 X4. Y5.\nG99 G81 Z-6. R3. F191.\nG99 G81 Z-6. R3.\n");
    assert_eq!(clean("mach9", &stmts), "G0X4.Y5.\nG81Z-6.R3.F191\nX4.Y5.\nX4.Y5.\n");
    let (_, diags) = text("mach9", &lines(vec![rapid("X4."), drill("-6.", None), hole("")]));
    assert_eq!(faults(&diags), [&Fault::PositionUnknown { axis: 'Y' }]);
}

#[test]
fn a_change_of_the_cycle_is_written_by_what_changes() {
    let stmts = blocks(vec![
        vec![rapid("X0.")],
        vec![drill("-6.", Some("100.")), hole("X1.")],
        vec![drill("-8.", Some("100.")), hole("X2.")],
        vec![drill("-8.", Some("120.")), hole("X3.")],
        vec![
            start(cycle(
                CycleKind::Bore { dwell: None, feed_out: None, to_level: false },
                "-8.",
                Some("120."),
            )),
            hole("X4."),
        ],
    ]);
    assert_eq!(
        clean("fanuc", &stmts),
        "G00 X0.\nG99 G81 X1. Z-6. R3. F100.\nX2. Z-8.\nX3. F120.\nG99 G85 X4. Z-8. R3. F120.\n"
    );
}

#[test]
fn a_feed_after_the_call_takes_the_place_of_its_own() {
    let stmts =
        lines(vec![rapid("X0."), drill("-6.", Some("100.")), Op::SetFeedRate(mm("50.")), hole("X1.")]);
    assert_eq!(clean("fanuc", &stmts), "G00 X0.\nF50.\nG99 G81 X1. Z-6. R3.\n");
}

#[test]
fn a_cycle_without_holes_leaves_its_feed() {
    let stmts = lines(vec![rapid("X0."), drill("-6.", Some("191")), Op::EndCycle, on("X1.")]);
    assert_eq!(clean("fanuc", &stmts), "G00 X0.\nF191.\nG01 X1.\n");
    let stmts = lines(vec![rapid("X0."), drill("-6.", None), Op::EndCycle, rapid_on("X1.")]);
    assert_eq!(clean("fanuc", &stmts), "G00 X0.\nX1.\n");
    assert_eq!(clean("mach9", &stmts), "G0X0.\nG81Z-6.R3.\nG80\nG0X1.\n");
    // A cycle before it is still ended.
    let stmts =
        lines(vec![drill("-6.", None), hole("X1."), drill("-7.", None), Op::EndCycle, rapid_on("X1.")]);
    assert_eq!(clean("fanuc", &stmts), "G99 G81 X1. Z-6. R3.\nG80\nG00 X1.\n");
}

#[test]
fn the_kinds_have_their_words() {
    let kinds = [
        (CycleKind::DrillDwell { dwell: seconds("0.5") }, "G99 G82 X1. Z-6. R3. P500"),
        (peck(Clearance::Parameter, None), "G99 G83 X1. Z-6. R3. Q2."),
        (CycleKind::Bore { dwell: None, feed_out: None, to_level: false }, "G99 G85 X1. Z-6. R3."),
        (
            CycleKind::Bore { dwell: Some(seconds("1")), feed_out: None, to_level: false },
            "G99 G89 X1. Z-6. R3. P1000",
        ),
    ];
    for (kind, expected) in kinds {
        let stmts = lines(vec![start(cycle(kind, "-6.", None)), hole("X1.")]);
        assert_eq!(clean("fanuc", &stmts), format!("{expected}\n"));
    }
    let dwell = start(cycle(CycleKind::DrillDwell { dwell: seconds("0.5") }, "-6.", None));
    assert_eq!(clean("mach9", &lines(vec![dwell, hole("X1.")])), "G82Z-6.R3.D0.5\nX1.\n");
    let pecked =
        |clearance, dwell| lines(vec![start(cycle(peck(clearance, dwell), "-6.", None)), hole("X1.")]);
    refused("fanuc", &pecked(Clearance::Stated(mm("1.")), None));
    refused("fanuc", &pecked(Clearance::Parameter, Some(seconds("1."))));
    refused("mach9", &pecked(Clearance::Parameter, None));
    let zx = Cycle { plane: Fact::Known(Plane::Zx), ..cycle(CycleKind::Drill, "-6.", None) };
    refused("fanuc", &lines(vec![start(zx), hole("X1.")]));
}

#[test]
fn patterns_stay_patterns() {
    let grid = Pattern::Grid {
        start: None,
        columns: row(Axis::X, "30.", 2),
        rows: row(Axis::Y, "130.", 2),
        serpentine: true,
    };
    let stmts = lines(vec![
        rapid("X0 Y0"),
        drill("-6.", Some("191")),
        Op::Pattern(Box::new(circle())),
        Op::Pattern(Box::new(grid.clone())),
        Op::EndCycle,
    ]);
    assert_eq!(clean("mach9", &stmts), "G0X0Y0\nG81Z-6.R3.F191\nG24X0Y18.B30.L12\nG25X30.Y130.I2J2\nG80\n");
    refused("fanuc", &stmts);
    let mut other = Settings::new(builtin("mach9").expect("built in"));
    other.choose("g24_direction", "cw").expect("an option");
    other.choose("g25_xy", "extent").expect("an option");
    let three = Pattern::Grid {
        start: None,
        columns: row(Axis::X, "30.", 3),
        rows: row(Axis::Y, "5.5", 1),
        serpentine: false,
    };
    let stmts = lines(vec![
        rapid("X0 Y0"),
        drill("-6.", None),
        Op::Pattern(Box::new(circle())),
        Op::Pattern(Box::new(three)),
    ]);
    let (text, diags) = text_with(Writer::new(other, layout()), &stmts);
    assert_eq!(text, "G0X0Y0\nG81Z-6.R3.\nG24X0Y18.B-30.L12\nG25X60.Y0.0I3J1\n");
    assert_eq!(diags, []);
}

#[test]
fn a_cycle_is_called_up_before_a_subprogram_of_positions() {
    let call = Op::Call(Box::new(Call { name: "1002".into(), times: 1, arguments: vec![], shared: false }));
    let stmts = lines(vec![rapid("X0."), drill("-6.", Some("100.")), call, Op::EndCycle]);
    assert_eq!(clean("fanuc", &stmts), "G00 X0.\nG99 G81 Z-6. R3. F100. K0\nM98 P1002\nG80\n");
}

#[test]
fn holes_that_can_be_skipped_do_not_take_the_call_with_them() {
    let mut stmts =
        lines(vec![rapid("X0."), drill("-6.", Some("100.")), hole("X1."), hole("X2."), hole("X3.")]);
    stmts[2].skip = Some(1);
    assert_eq!(
        clean("fanuc", &stmts),
        "G00 X0.\n/G99 G81 X1. Z-6. R3. F100.\nG99 G81 X2. Z-6. R3. F100.\nX3.\n"
    );
    stmts[2].skip = None;
    stmts[1].skip = Some(1);
    refused("fanuc", &stmts);
}

#[test]
fn a_hole_without_a_cycle_is_refused() {
    refused("fanuc", &lines(vec![rapid("X0."), hole("X1.")]));
    refused("mach9", &lines(vec![rapid("X0."), Op::Pattern(Box::new(circle()))]));
}
