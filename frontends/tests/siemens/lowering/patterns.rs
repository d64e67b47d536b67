//! Patterns of positions.

use super::*;

const DRILL: &str = "MCALL CYCLE81(5,0,2,-3)\n";

fn pattern(call: &str) -> String {
    after_head(&format!("{DRILL}{call}\n")).remove(1)
}

#[test]
fn lines_circles_grids_and_lists() {
    assert_eq!(pattern("HOLES1(10,-5.5,30,5,11,4)"), "LINE 4 from 10 -5.5 at 30deg offset 5 pitch 11");
    assert_eq!(pattern("HOLES1(10,20,,,11,4)"), "LINE 4 from 10 20 at 0deg offset 0 pitch 11");
    assert_eq!(pattern("HOLES2(0,0,18,90,30,12)"), "CIRCLE 12 about 0 0 radius 18 at 90deg step 30deg");
    assert_eq!(pattern("HOLES2(1,2,18,0,0,8)"), "CIRCLE 8 about 1 2 radius 18 at 0deg step 45.deg");
    assert_eq!(pattern("HOLES2(1,2,18,0,-22.5,3)"), "CIRCLE 3 about 1 2 radius 18 at 0deg step -22.5deg");
    assert_eq!(pattern("CYCLE801(-15,-65,0,30,130,2,3)"), "GRID from -15 -65 2xX30 3xY130 serpentine");
    assert_eq!(pattern("CYCLE801(0,0,20,12,9,3,4)"), "GRID from 0 0 3@20deg:12 4@110deg:9 serpentine");
    assert_eq!(pattern("CYCLE801(0,0,0,,17.5,1,3)"), "GRID from 0 0 1xX0 3xY17.5 serpentine");
    assert_eq!(pattern("CYCLE802(111111111,111111111,12,8,37.5,8)"), "LIST X12 Y8; X37.5 Y8;");
}

#[test]
fn the_plane_s_axes() {
    assert_eq!(
        after_head(&format!("G18\n{DRILL}CYCLE801(1,2,0,3,4,2,2)\n"))[2],
        "GRID from 1 2 2xZ3 2xX4 serpentine"
    );
    assert_eq!(after_head(&format!("G19\n{DRILL}CYCLE802(111111111,111111111,1,2)\n"))[2], "LIST Y1 Z2;");
}

#[test]
fn the_order_of_holes_is_told_unless_the_tool_stands_at_the_first() {
    let told = |piece: &str| {
        let all = assumptions(&(HEAD.to_owned() + DRILL + piece + "M30\n"));
        all.into_iter().filter(|d| d.starts_with("AssumedHoleOrder")).collect::<Vec<_>>()
    };
    assert_eq!(
        told("CYCLE801(10,20,0,3,4,2,2)\n"),
        ["AssumedHoleOrder { pattern: 'CYCLE801' } at 'CYCLE801(10,20,0,3,4,2,2)'"]
    );
    assert_eq!(
        told("HOLES1(1,0,0,0,4,2)\n"),
        ["AssumedHoleOrder { pattern: 'HOLES1' } at 'HOLES1(1,0,0,0,4,2)'"]
    );
    // The head leaves the tool at X0 Y0.
    assert_eq!(told("CYCLE801(0,0.0,0,3,4,2,2)\n"), [] as [&str; 0]);
    assert_eq!(told("HOLES1(0,5,-90,5,4,2)\n"), [] as [&str; 0]);
    assert_eq!(told("X10\nY=AC(20)\nCYCLE801(10,20,0,3,4,2,2)\n"), [] as [&str; 0]);
    assert_eq!(told("X=IC(10)\nCYCLE801(10,0,0,3,4,2,2)\n").len(), 1);
    assert_eq!(told("CYCLE801(10,20,0,,,1,1)\n"), [] as [&str; 0]);
    assert_eq!(told("HOLES2(1,2,18,0,0,8)\n"), [] as [&str; 0]);
}

#[test]
fn patterns_that_are_none() {
    let one = |call: &str| faults(&format!("{DRILL}{call}\n")).remove(0);
    assert_eq!(faults("HOLES2(0,0,18,0,0,8)\n"), ["NoCycle at 'HOLES2(0,0,18,0,0,8)'"]);
    assert_eq!(
        one("HOLES2(0,0,18,0,0)"),
        "WordMissing { code: 'HOLES2', word: 'NUM' } at 'HOLES2(0,0,18,0,0)'"
    );
    assert_eq!(one("HOLES2(0,0,0,0,0,8)"), "OutOfRange { word: Word('RAD') } at '0'");
    assert_eq!(one("HOLES2(0,0,5,0,0,2.5)"), "PointNotAllowed { word: '2.5' } at '2.5'");
    assert_eq!(one("HOLES1(0,0,0,0,5,0)"), "OutOfRange { word: Word('NUM') } at '0'");
    // It is shared out where that is 0, which is known for what is never 0.
    assert_eq!(
        one("HOLES2(0,0,5,0,R1,2)"),
        "NotSupported { code: 'HOLES2', what: Cycle(StepComputed { parameter: 'INDA' }) } at 'R1'"
    );
    assert_eq!(faults(&format!("{DRILL}HOLES2(R1,R2,R3,R4,-(360/R5),4)\n")), [] as [&str; 0]);
    let counted = |at: &str| format!("NotSupported {{ code: '{at}', what: Code(ComputedWord) }} at '{at}'");
    assert_eq!(one("HOLES2(0,0,5,0,0,R1)"), counted("R1"));
    assert_eq!(one("CYCLE801(R1,0,0,5,5,2,2)"), counted("R1"));
    assert_eq!(
        one("CYCLE801(0,0,0,5,5,2,2,2)"),
        "NotSupported { code: 'CYCLE801', what: Cycle(PatternOrder { parameter: '_VARI' }) } at '2'"
    );
    assert_eq!(
        one("CYCLE802(111111112,111111111,1,2)"),
        "NotSupported { code: 'CYCLE802', what: Cycle(PointsNotAbsolute) } at 'CYCLE802(111111112,111111111,1,2)'"
    );
    assert_eq!(
        one("CYCLE802(111111111,111111111,1,2,,,3,4)"),
        "NotSupported { code: 'CYCLE802', what: Cycle(PointsGap) } at '3'"
    );
    assert_eq!(
        one("MCALL HOLES2(0,0,5,0,0,2)"),
        "NotSupported { code: 'HOLES2', what: Call(ModalPattern) } at 'HOLES2(0,0,5,0,0,2)'"
    );
}
