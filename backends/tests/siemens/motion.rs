//! Moves, tools, frames.

use crate::*;
use ncc_ir::canon::{Axis, Distance, Fact, Plane, Turn, Units};
use ncc_ir::expr::num::Unit;
use ncc_ir::lack::{LengthsLack, ToolsLack};
use ncc_ir::program::{
    Arc, ArcForm, Centre, CentreFrom, Coord, Frame, FrameSlot, FrameStep, Op, Point, Shape,
};

fn arc(to: &str, centre: Centre, turns: u32) -> Op {
    let plane = Fact::Known(Plane::Xy);
    Op::ArcFeed(Box::new(Arc {
        plane,
        turn: Turn::Counterclockwise,
        to: point(to),
        centre,
        turns: turns.into(),
        said: true,
    }))
}

fn centre(x: &str, y: &str, from: CentreFrom) -> Centre {
    Centre::Point { words: [Some(mm(x)), Some(mm(y)), None], from }
}

fn form(to: &str, shape: Shape) -> Op {
    let plane = Fact::Known(Plane::Xy);
    Op::ArcForm(Box::new(ArcForm { plane, to: point(to), shape, turns: 0, said: true }))
}

fn degrees(text: &str) -> ncc_ir::expr::Expr {
    ncc_ir::expr::Expr::Num(num(text, Unit::Degree))
}

fn from_start(text: &str) -> Coord {
    Coord { value: mm(text), distance: Fact::Known(Distance::Incremental) }
}

fn tool(number: &str) -> Vec<Op> {
    vec![Op::SelectTool(count(number)), Op::ChangeTool]
}

fn edge(number: &str, said: bool) -> Op {
    Op::UseToolEdge { edge: count(number), said }
}

#[test]
fn a_program_opens_with_the_safe_start() {
    let mut stmts = lines(vec![Op::Comment("FACE".into()), rapid("Z0"), rapid("X0. Y108")]);
    stmts[1].comment = Some(Box::new("up".into()));
    let (text, _) = text(&stmts);
    assert_eq!(text, "; FACE\nG0 Z0 ; up\nG0 X0 Y108\n");
}

#[test]
fn a_source_in_inches_has_g700() {
    let stmts = blocks(vec![
        vec![Op::UseLengthUnits(Units::Inch)],
        vec![Op::StraightTraverse(ncc_ir::program::Move {
            to: in_unit(point("X1.5"), Unit::Inch),
            said: true,
        })],
    ]);
    assert_eq!(text(&stmts).0, "G700 G17 G90 G40 G94\nG54\nG0 X1.5\n");
}

#[test]
fn words_of_another_distance_say_so() {
    let mut mixed = point("X40. Y7.5");
    mixed.axes[1].as_mut().expect("Y").distance = Fact::Known(Distance::Incremental);
    let mixed = Op::StraightFeed(ncc_ir::program::Move { to: mixed, said: true });
    assert_eq!(clean(&lines(vec![mixed.clone()])), "G1 X40 Y=IC(7.5)\n");
    let stmts = lines(vec![Op::SetDistanceMode(Distance::Incremental), mixed]);
    assert!(text(&stmts).0.ends_with("G1 X=AC(40) Y7.5\n"));
}

#[test]
fn arcs_about_a_centre() {
    let stmts = lines(vec![
        arc("X10. Y0.", centre("5.", "0.", CentreFrom::Start), 0),
        arc("", centre("5.", "-2.5", CentreFrom::Zero), 0),
        arc("X20. Z-3.", centre("5.", "0.", CentreFrom::Start), 2),
        arc("X30. Y1.", Centre::Radius(mm("-12.5")), 0),
    ]);
    let expected = "G3 X10 Y0 I5 J0\nG3 I=AC(5) J=AC(-2.5)\nG3 X20 Z-3 I5 J0 TURN=2\nG3 X30 Y1 CR=-12.5\n";
    assert_eq!(clean(&stmts), expected);
}

#[test]
fn arcs_in_other_forms() {
    let turn = Turn::Clockwise;
    let ij = Box::new([Some(coord("5.")), Some(from_start("-1.")), None]);
    let stmts = lines(vec![
        form("X10. Y0.", Shape::Angle { turn, angle: degrees("90.") }),
        form("", Shape::AngleAbout { turn, angle: degrees("30.5"), centre: ij.clone() }),
        form("X3.", Shape::Mixed { turn, centre: ij }),
        form("X25. Y20.", Shape::Through(Box::new(point("X33. Y16.")))),
        form("X12. Y18.", Shape::Tangent),
        feed("X0."),
    ]);
    let expected = "G2 X10 Y0 AR=90\nG2 I=AC(5) J-1 AR=30.5\nG2 X3 I=AC(5) J-1\n\
        CIP X25 Y20 I1=33 J1=16\nCT X12 Y18\nG1 X0\n";
    assert_eq!(clean(&stmts), expected);
}

#[test]
fn a_point_between_obeys_the_distance_mode() {
    let mut through = point("X33. Y16.");
    through.axes[0].as_mut().expect("X").distance = Fact::Known(Distance::Incremental);
    let stmts = lines(vec![form("X25. Y20.", Shape::Through(Box::new(through)))]);
    assert_eq!(clean(&stmts), "CIP X25 Y20 I1=IC(33) J1=16\n");
}

#[test]
fn frames_stand_alone() {
    let frame = |added, step| Op::SetFrame(Box::new(Frame { added, step }));
    let mut shift = [const { None }; 6];
    (shift[0], shift[3]) = (Some(mm("-50.")), Some(degrees("90.")));
    let stmts = blocks(vec![
        vec![rapid("X0.")],
        vec![frame(false, FrameStep::Translate(Box::new(shift)))],
        vec![frame(true, FrameStep::Rotate { plane: Fact::Known(Plane::Xy), angle: degrees("-30.") })],
        vec![frame(false, FrameStep::Scale(Box::new([Some(count("0.8")), Some(count("2.")), None])))],
        vec![frame(true, FrameStep::Mirror([true, false, false]))],
        vec![Op::ClearFrame(FrameSlot::Chain)],
        vec![frame(false, FrameStep::Mirror([false; 3]))],
        vec![frame(true, FrameStep::Mirror([false; 3]))],
    ]);
    let expected = "G0 X0\nTRANS X-50 A90\nAROT RPL=-30\nSCALE X0.8 Y2\nAMIRROR X0\nTRANS\nTRANS\n";
    assert_eq!(clean(&stmts), expected);
}

#[test]
fn machine_coordinates_are_for_one_block() {
    let stmts =
        blocks(vec![vec![Op::UseMachineCoordinates { length: true }, rapid("Z0.")], vec![rapid_on("X1.")]]);
    assert_eq!(clean(&stmts), "SUPA G0 Z0\nX1\n");
}

#[test]
fn a_dwell_stands_alone() {
    let stmts = blocks(vec![vec![rapid("X0.")], vec![Op::FloodOn, Op::Dwell(seconds("1.5"))]]);
    assert_eq!(text(&stmts).0, "G0 X0\nM8\nG4 F1.5\n");
}

#[test]
fn an_edge_that_comes_with_the_tool_is_not_written() {
    let mut change = tool("1");
    change.push(edge("1", false));
    let stmts = blocks(vec![change, vec![rapid("Z5.")]]);
    assert_eq!(clean(&stmts), "T1 M6\nG0 Z5\n");
    let edge_comes = Fault::AssumedOption { option: "edge_after_change".into(), value: "1".into() };
    assert_eq!(told(&stmts).1, [edge_comes], "it rests on the option");
    let mut change = tool("1");
    change.push(edge("2", true));
    assert_eq!(clean(&blocks(vec![change])), "T1 M6 D2\n");
    assert_eq!(clean(&lines(vec![tool("1").remove(0), Op::ChangeTool, edge("1", true)])), "T1\nM6\nD1\n");
}

#[test]
fn a_length_that_the_tool_change_would_lose_is_said_before_z() {
    let none = Op::UseToolLengthOffset(count("0"));
    let stmts = blocks(vec![vec![none], tool("1"), vec![rapid("X1.")], vec![rapid("Z5.")]]);
    let (text, diags) = text(&stmts);
    assert_eq!(diags, []);
    assert!(text.ends_with("T1 M6\nG0 X1\nG0 Z5 D0\n"), "{text}");
    let stmts = blocks(vec![tool("1"), vec![rapid("Z5.")]]);
    assert_eq!(refused(&stmts), ToolsLack::ChangeKeepsLength.into());
}

#[test]
fn an_entry_of_the_table_is_the_tools_first_edge() {
    let own = Op::UseToolLengthOffset(count("7"));
    let (text, faults) = told(&blocks(vec![tool("7"), vec![own, rapid("Z5.")]]));
    assert_eq!(text, "T7 M6\nG0 Z5 D1\n");
    assert_eq!(faults, [Fault::AssumedEdge { tool: 7 }]);
    let other = Op::UseToolLengthOffset(count("8"));
    let (_, faults) = told(&blocks(vec![tool("7"), vec![other], vec![rapid("Z5.")]]));
    assert_eq!(faults, [Fault::lacks(LengthsLack::NotOwnEntry)], "told once");
}

#[test]
fn a_rotary_axis_keeps_its_word() {
    let mut to = Point::default();
    to.set(Axis::A, Coord { value: degrees("45.5"), distance: Fact::Known(Distance::Absolute) });
    let stmts = lines(vec![Op::StraightTraverse(ncc_ir::program::Move { to, said: true })]);
    assert_eq!(clean(&stmts), "G0 A45.5\n");
}

#[test]
fn plain_moves_and_the_general_way_write_the_same() {
    let about = |x: &str, y: &str| centre(x, y, CentreFrom::Start);
    let round = |to: &str, centre: Centre| arc(to, centre, 0);
    let mut stmts = lines(vec![
        feed("X1.5 Y-2."),
        on("X3."),
        rapid("Z10."),
        rapid_on("X0.25 Y100."),
        Op::SetFeedRate(mm("100")),
        feed("X0. Y0."),
        round("X10. Y10.", about("10.", "0")),
        round("Y0.5 Z-3.", about("0.", "-4.75")),
        round("X0. Y0.", Centre::Radius(mm("20."))),
        round("X-0.5 Y-0.5", Centre::Radius(mm("-7.125"))),
        // Rounded: the start, the end, the centre, the radius.
        round("X5.00049 Y0.", about("2.5", "0.")),
        round("X10. Y0.", about("2.50049", "0.")),
        round("X12. Y0.", about("1.", "0.0001")),
        round("X14. Y0.", Centre::Radius(mm("3.00001"))),
        round("X14.0001 Y0.0001", Centre::Radius(mm("3."))),
        // A circle, and an arc of several turns.
        round("X14. Y0.", about("5.", "0")),
        arc("X14. Y0.", about("5.", "0"), 2),
        round("X14. Y0. Z-4.", centre("20.", "0", CentreFrom::Zero)),
        on("X1."),
    ]);
    for numbers in [false, true] {
        for remarks in ["", "c", "A remark (in brackets)", "; another"] {
            for (at, stmt) in stmts.iter_mut().enumerate() {
                stmt.comment = (at % 2 == 0 && !remarks.is_empty()).then(|| Box::new(remarks.into()));
                stmt.number = numbers.then_some(10 * at as u32);
            }
            let (fast, told) = text(&stmts);
            let (general, told_there) = text(&the_general_way(&stmts));
            assert_eq!(fast, without_empty_remarks(&general, ";"));
            assert_eq!(told, told_there);
        }
    }
}

#[test]
fn no_length_belongs_to_the_start() {
    let stmts = blocks(vec![vec![Op::SelectPlane(Plane::Xy), edge("0", true)], vec![rapid("X0.")]]);
    assert_eq!(text(&stmts).0, "G710 G17 G90 G40 G94 D0\nG54\nG0 X0\n");
}

#[test]
fn a_metric_feed_among_inches_has_its_own_code_of_units() {
    let inch = |words: &str| ncc_ir::program::Move { to: in_unit(point(words), Unit::Inch), said: true };
    let feed_in = |text: &str| Op::SetFeedRate(ncc_ir::expr::Expr::Num(num(text, Unit::Inch)));
    let stmts = blocks(vec![
        vec![Op::UseLengthUnits(Units::Inch)],
        vec![Op::SetFeedRate(mm("125.")), Op::StraightFeed(inch("X1."))],
        vec![Op::StraightFeed(inch("X2."))],
        vec![feed_in("9.5"), Op::StraightFeed(inch("X3."))],
    ]);
    let expected = "G700 G17 G90 G40 G94\nG54\nG70 G1 X1 F125\nG1 X2\nG700 G1 X3 F9.5\n";
    assert_eq!(clean(&stmts), expected);
    let basic = Fault::AssumedOption { option: "feed_unit".into(), value: "mm".into() };
    assert_eq!(told(&stmts).1, [basic], "it rests on the option");
}

#[test]
fn no_work_offset_is_g500() {
    let stmts =
        blocks(vec![vec![rapid("X0.")], vec![Op::SetOriginOffsets(0)], vec![Op::SetOriginOffsets(99)]]);
    assert_eq!(clean(&stmts), "G0 X0\nG500\nG599\n");
}

#[test]
fn what_is_turned_off_stands_behind_the_move() {
    let stmts =
        blocks(vec![vec![rapid("Z50"), Op::StopSpindleTurning, Op::CoolantOff], vec![Op::ProgramEnd]]);
    let (text, _) = text(&stmts);
    assert_eq!(text, "G0 Z50\nM5 M9\nM30\n");
}
