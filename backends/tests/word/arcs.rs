//! Arcs: the centre's form, radius, planes, what rounding does to them.

use crate::*;
use ncc_ir::canon::Turn;
use ncc_ir::program::{Arc, Centre, CentreFrom, Turns};

fn centre(from: CentreFrom, i: &str, j: &str, k: &str) -> Centre {
    let word = |text: &str| (!text.is_empty()).then(|| mm(text));
    Centre::Point { words: [word(i), word(j), word(k)], from }
}

fn arc(turn: Turn, to: &str, centre: Centre) -> Arc {
    Arc { plane: Fact::Known(Plane::Xy), turn, to: point(to), centre, turns: Turns::NONE, said: true }
}

fn after(start: &str, arc: Arc) -> Vec<Stmt> {
    lines(vec![rapid(start), Op::ArcFeed(Box::new(arc))])
}

use CentreFrom::{Start, Zero};
use Turn::{Clockwise, Counterclockwise};

#[test]
fn a_centre_in_the_targets_form_keeps_its_digits() {
    let a = after("X0. Y0.", arc(Clockwise, "X20. Y0.", centre(Start, "10.000", "", "")));
    assert_eq!(clean("fanuc", &a), "G00 X0. Y0.\nG02 X20. Y0. I10.000\n");
    let a = after("X0. Y0.", arc(Counterclockwise, "X20. Y0.", centre(Zero, "10.", "0", "")));
    assert_eq!(clean("mach9", &a), "G0X0.Y0.\nG3X20.Y0.I10.J0\n");
}

#[test]
fn a_centre_in_the_other_form_is_computed_from_the_written_start() {
    let a = after("X5. Y2.5", arc(Clockwise, "X15. Y2.5", centre(Zero, "10.", "2.5", "")));
    let (fanuc, diags) = text("fanuc", &a);
    assert_eq!(fanuc, "G00 X5. Y2.5\nG02 X15. Y2.5 I5. J0.\n");
    assert_eq!(faults(&diags), [&Fault::ArcReformatted]);
    let a = after("X5. Y2.5", arc(Counterclockwise, "X15. Y2.5", centre(Start, "5.", "", "")));
    let (mach9, diags) = text("mach9", &a);
    assert_eq!(mach9, "G0X5.Y2.5\nG3X15.Y2.5I10.J2.5\n");
    assert_eq!(faults(&diags), [&Fault::ArcReformatted]);
    // The start is where rounding put it: 5.0004 became 5., so that the centre is 5 away, not 4.9996.
    let a = after("X5.0004 Y0.", arc(Clockwise, "X15. Y0.", centre(Zero, "10.", "0.", "")));
    assert_eq!(text("fanuc", &a).0, "G00 X5. Y0.\nG02 X15. Y0. I5. J0.\n");
}

#[test]
fn an_unknown_start_is_refused() {
    let a = after("X5.", arc(Clockwise, "X15. Y2.5", centre(Zero, "10.", "2.5", "")));
    let (_, diags) = text("fanuc", &a);
    assert_eq!(faults(&diags), [&Fault::PositionUnknown { axis: 'Y' }]);
}

#[test]
fn inches_are_converted_exactly() {
    let inch = |words| in_unit(point(words), Unit::Inch);
    let word = |text| Some(Expr::Num(num(text, Unit::Inch)));
    let arc = Arc {
        to: inch("X1.5 Y0."),
        centre: Centre::Point { words: [word("1."), word("0.0001"), None], from: Zero },
        ..arc(Clockwise, "", centre(Zero, "", "", ""))
    };
    let stmts = lines(vec![
        Op::UseLengthUnits(Units::Inch),
        Op::StraightTraverse(Move { to: inch("X.5 Y0."), said: true }),
        Op::ArcFeed(Box::new(arc)),
    ]);
    let (text, diags) = text("fanuc", &stmts);
    assert!(text.ends_with("G00 X0.5 Y0.\nG02 X1.5 Y0. I0.5 J0.0001\n"), "{text}{diags:?}");
}

#[test]
fn a_radius_stays_where_there_is_a_word_for_it() {
    let a = after("X0. Y0.", arc(Clockwise, "X10. Y10.", Centre::Radius(mm("10."))));
    assert_eq!(clean("fanuc", &a), "G00 X0. Y0.\nG02 X10. Y10. R10.\n");
    let (mach9, diags) = text("mach9", &a);
    assert_eq!(mach9, "G0X0.Y0.\nG2X10.Y10.I10.J0.\n");
    assert_eq!(faults(&diags), [&Fault::ArcReformatted]);
    // More than half a turn.
    let a = after("X0. Y0.", arc(Clockwise, "X10. Y10.", Centre::Radius(mm("-10."))));
    assert_eq!(text("mach9", &a).0, "G0X0.Y0.\nG2X10.Y10.I0.J10.\n");
    let a = after("X0. Y0.", arc(Clockwise, "X10. Y10.", Centre::Radius(mm("1."))));
    assert_eq!(faults(&text("mach9", &a).1), [&Fault::ArcRadiusTooSmall]);
}

#[test]
fn planes_have_their_own_letters() {
    let zx =
        Arc { plane: Fact::Known(Plane::Zx), ..arc(Clockwise, "X10. Z0.", centre(Start, "5.", "", "0.")) };
    let stmts =
        lines(vec![rapid("X0. Y0. Z0."), Op::SelectPlane(Plane::Zx), Op::ArcFeed(Box::new(zx.clone()))]);
    assert_eq!(clean("fanuc", &stmts), "G00 X0. Y0. Z0.\nG18\nG02 X10. Z0. I5. K0.\n");
    let (mach9, _) = text("mach9", &stmts);
    assert_eq!(mach9, "G0X0.Y0.Z0.\nG18\nG2X10.Z0.I5.K0.\n");
    // A plane that is not active is put in, and one word outside the plane is no centre.
    let yz = Arc { plane: Fact::Known(Plane::Yz), centre: centre(Start, "9.", "5.", ""), ..zx };
    let yz = Arc { to: point("Y10. Z0."), ..yz };
    let stmts = lines(vec![rapid("Y0. Z0."), Op::ArcFeed(Box::new(yz))]);
    assert_eq!(clean("fanuc", &stmts), "G00 Y0. Z0.\nG19 G02 Y10. Z0. J5.\n");
}

#[test]
fn full_circles_and_helices() {
    let full = after("X0. Y0.", arc(Clockwise, "", centre(Start, "10.", "0.", "")));
    assert_eq!(clean("fanuc", &full), "G00 X0. Y0.\nG02 I10. J0.\n");
    assert_eq!(text("mach9", &full).0, "G0X0.Y0.\nG2I10.J0.\n");
    let helix = after("X0. Y0. Z0.", arc(Clockwise, "X20. Y0. Z-5.", centre(Start, "10.", "0.", "")));
    assert_eq!(clean("fanuc", &helix), "G00 X0. Y0. Z0.\nG02 X20. Y0. Z-5. I10. J0.\n");
    refused("mach9", &helix);
    let turns = Arc { turns: Turns::from(2), ..arc(Clockwise, "", centre(Start, "10.", "0.", "")) };
    refused("fanuc", &after("X0. Y0.", turns));
}

#[test]
fn an_arc_that_rounding_closes_is_a_line_a_circle_or_refused() {
    let from = |to: &str, about: [&str; 2]| {
        let a = arc(Clockwise, to, centre(Start, about[0], about[1], ""));
        text("fanuc", &after("X0. Y0.", a))
    };
    // A little one goes nowhere, and one that goes nearly round is a full circle.
    let (little, diags) = from("X0. Y0.0004", ["10.", "0."]);
    assert_eq!(little, "G00 X0. Y0.\nG01 X0. Y0.\n");
    assert!(!faults(&diags).contains(&&Fault::ArcVanishes));
    let (nearly, diags) = from("X0. Y-0.0004", ["10.", "0."]);
    assert_eq!(nearly, "G00 X0. Y0.\nG02 X0. Y0. I10. J0.\n");
    assert!(!faults(&diags).contains(&&Fault::ArcVanishes));
    // Half a turn of so small a radius is neither.
    let (_, diags) = from("X0.0004 Y0.", ["0.0002", "0."]);
    assert!(faults(&diags).contains(&&Fault::ArcVanishes));
    let a = after("X0. Y0.", arc(Clockwise, "X0.0006 Y0.", centre(Start, "10.", "0.", "")));
    let (text, diags) = text("fanuc", &a);
    assert_eq!(text, "G00 X0. Y0.\nG02 X0.001 Y0. I10. J0.\n");
    assert!(!faults(&diags).contains(&&Fault::ArcVanishes));
}

#[test]
fn plain_moves_before_an_arc_are_followed() {
    let by = |words| {
        let to = measured(point(words), Fact::Known(Distance::Incremental));
        Op::StraightFeed(Move { to, said: true })
    };
    let half = Arc {
        to: measured(point("X10."), Fact::Known(Distance::Incremental)),
        ..arc(Clockwise, "", centre(Zero, "8.", "1.", ""))
    };
    let stmts = lines(vec![
        rapid("X0. Y0."),
        rapid("X1. Y1."),
        Op::SetDistanceMode(Distance::Incremental),
        by("X1."),
        by("X0.5 Y0."),
        by("X0.5"),
        Op::ArcFeed(Box::new(half)),
    ]);
    let (text, _) = text("fanuc", &stmts);
    assert!(text.ends_with("G01 X0.5\nG02 X10. I5. J0.\n"), "{text}");
}
