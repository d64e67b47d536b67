//! Patterns of positions.

use crate::cycles::{cycle, start};
use crate::*;
use ncc_ir::canon::Axis;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Unit;
use ncc_ir::program::cycle::{Along, CycleKind, First, Pattern, Row};
use ncc_ir::program::{Coord, Op};

fn at(x: &str, y: &str) -> Option<[Coord; 2]> {
    Some([coord(x), coord(y)])
}

fn degrees(text: &str) -> Expr {
    Expr::Num(num(text, Unit::Degree))
}

fn row(along: Along, pitch: &str, count: u32) -> Row {
    Row { along, pitch: mm(pitch), count }
}

fn with(pattern: Pattern) -> Vec<ncc_ir::program::Stmt> {
    let drill = start(cycle(CycleKind::Drill));
    lines(vec![rapid("X-15. Y-65."), drill, Op::Pattern(Box::new(pattern)), Op::EndCycle])
}

/// The line of the pattern, and what was reported.
fn line(pattern: Pattern) -> (String, Vec<Fault>) {
    let (text, faults) = told(&with(pattern));
    (text.lines().nth(2).unwrap_or_default().to_owned(), faults)
}

fn circle(step: &str, count: u32) -> Pattern {
    let first = First::Polar { radius: mm("18."), angle: degrees("90.") };
    Pattern::Circle { centre: at("0.", "0."), first, step: degrees(step), count }
}

fn grid(columns: Row, rows: Row) -> Pattern {
    Pattern::Grid { start: at("-15.", "-65."), columns, rows, serpentine: true }
}

#[test]
fn circles() {
    assert_eq!(line(circle("30.", 12)), ("HOLES2(0,0,18,90,30,12)".into(), vec![]));
    assert_eq!(line(circle("-22.5", 5)).0, "HOLES2(0,0,18,90,-22.5,5)");
    // An angle with more digits than are written: the control shares the circle out.
    assert_eq!(line(circle("51.428571428", 7)), ("HOLES2(0,0,18,90,0,7)".into(), vec![]));
    let first = First::Polar { radius: mm("18."), angle: degrees("0.") };
    let here = Pattern::Circle { centre: None, first, step: degrees("90."), count: 4 };
    assert_eq!(line(here).0, "HOLES2(-15,-65,18,0,90,4)");
    refused(&with(circle("0.", 3)));
    let first = First::At([coord("18."), coord("0.")]);
    refused(&with(Pattern::Circle { centre: at("0.", "0."), first, step: degrees("90."), count: 4 }));
}

#[test]
fn a_grid_from_where_the_tool_stands() {
    let pattern = grid(row(Along::Axis(Axis::X), "30.", 2), row(Along::Axis(Axis::Y), "130.", 2));
    assert_eq!(line(pattern), ("CYCLE801(-15,-65,0,30,130,2,2)".into(), vec![]));
}

#[test]
fn the_order_is_told_where_the_control_may_choose_it() {
    let pattern = Pattern::Grid {
        start: at("0.", "0."),
        columns: row(Along::Axis(Axis::X), "30.", 2),
        rows: row(Along::Axis(Axis::Y), "130.", 2),
        serpentine: true,
    };
    let order = |pattern: &str| Fault::AssumedHoleOrder { pattern: pattern.into() };
    assert_eq!(line(pattern).1, [order("CYCLE801")]);
    let pattern =
        |start| Pattern::Line { start, angle: degrees("30."), offset: mm("0."), pitch: mm("11."), count: 4 };
    assert_eq!(line(pattern(at("10.", "30."))), ("HOLES1(10,30,30,0,11,4)".into(), vec![order("HOLES1")]));
    assert_eq!(line(pattern(None)), ("HOLES1(-15,-65,30,0,11,4)".into(), vec![]));
}

#[test]
fn grids_turn_until_their_pitches_are_positive() {
    let x = |pitch, count| row(Along::Axis(Axis::X), pitch, count);
    let y = |pitch, count| row(Along::Axis(Axis::Y), pitch, count);
    let text = |columns, rows| line(grid(columns, rows)).0;
    assert_eq!(text(x("-30.", 3), y("-10.", 2)), "CYCLE801(-15,-65,180,30,10,3,2)");
    assert_eq!(text(y("30.", 3), x("-10.", 2)), "CYCLE801(-15,-65,90,30,10,3,2)");
    assert_eq!(text(x("30.", 1), y("-10.", 4)), "CYCLE801(-15,-65,180,30,10,1,4)");
    let turned =
        grid(row(Along::Angle(degrees("20.")), "9.", 3), row(Along::Angle(degrees("110.")), "5.", 2));
    assert_eq!(line(turned).0, "CYCLE801(-15,-65,20,9,5,3,2)");
    // To the right of the columns, or askew.
    refused(&with(grid(x("30.", 3), y("-10.", 2))));
    refused(&with(grid(x("30.", 3), row(Along::Angle(degrees("80.")), "10.", 2))));
    let one_way = Pattern::Grid {
        start: at("-15.", "-65."),
        columns: x("30.", 2),
        rows: y("10.", 2),
        serpentine: false,
    };
    refused(&with(one_way));
}

#[test]
fn lists() {
    let pattern = Pattern::List(vec![point("X12. Y8."), point("X37.5"), point("Y21.25")]);
    let (text, faults) = line(pattern);
    assert_eq!(text, "CYCLE802(111111111,111111111,12,8,37.5,8,37.5,21.25)");
    assert!(matches!(faults.as_slice(), [Fault::AssumedRow { .. }]), "{faults:?}");
    refused(&with(Pattern::List(vec![point("X1. Y1."); 10])));
}

#[test]
fn a_pattern_needs_a_cycle() {
    refused(&lines(vec![rapid("X0."), Op::Pattern(Box::new(circle("30.", 12)))]));
}
