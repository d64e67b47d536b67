//! Numbers in words: digits, rounding, units, distance modes.

use crate::*;

#[test]
fn digits_stay_as_they_were_written() {
    let stmts = lines(vec![rapid("X0 Y-0.5 Z12.500"), on("X7 Y0. Z-3.")]);
    assert_eq!(clean("fanuc", &stmts), "G00 X0. Y-0.5 Z12.500\nG01 X7. Y0. Z-3.\n");
    assert_eq!(clean("mach9", &stmts), "G0X0Y-0.5Z12.500\nG1X7.Y0.Z-3.\n");
    let f = blocks(vec![
        vec![Op::SetFeedRate(mm("505")), feed("X1.")],
        vec![Op::SetFeedRate(mm("12.5")), on("X2.")],
    ]);
    assert_eq!(clean("fanuc", &f), "G01 X1. F505.\nX2. F12.5\n");
    assert_eq!(clean("mach9", &f), "G1X1.F505\nX2.F12.5\n");
}

#[test]
fn finer_digits_are_rounded_and_reported() {
    let (text, diags) = text("fanuc", &lines(vec![rapid("X12.34567"), on("Y-0.0004")]));
    assert_eq!(text, "G00 X12.346\nG01 Y0.\n");
    assert_eq!(
        faults(&diags),
        [
            &Fault::Rounded { word: "X12.34567".into(), written: "X12.346".into() },
            &Fault::Rounded { word: "Y-0.0004".into(), written: "Y0.".into() }
        ]
    );
}

#[test]
fn rounding_of_incremental_words_does_not_add_up() {
    let step = || {
        let to = measured(point("X0.3333333"), Fact::Known(Distance::Incremental));
        Op::StraightFeed(Move { to, said: false })
    };
    let mut ops = vec![rapid("X0."), Op::SetDistanceMode(Distance::Incremental)];
    ops.extend((0..6).map(|_| step()));
    let (text, diags) = text("fanuc", &lines(ops));
    // 6 × 0.3333333 is 1.9999998; written are 0.333 × 4 and 0.334 × 2, which is 2.
    assert_eq!(text, "G00 X0.\nG91\nG01 X0.333\nX0.334\nX0.333\nX0.333\nX0.334\nX0.333\n");
    assert_eq!(diags.len(), 6);
    // Absolute words begin again.
    let stmts = lines(vec![rapid("X0.00049"), on("X1.00049"), on("X2.")]);
    assert_eq!(crate::text("fanuc", &stmts).0, "G00 X0.\nG01 X1.\nX2.\n");
}

#[test]
fn out_of_range_is_refused() {
    for words in ["X100000.", "X-123456.789"] {
        let (_, diags) = text("fanuc", &lines(vec![rapid(words)]));
        assert_eq!(faults(&diags), [&Fault::TargetRange { word: words.into() }]);
    }
    let (_, diags) = text("fanuc", &lines(vec![Op::SetSpindleSpeed(count("-5"))]));
    assert_eq!(faults(&diags), [&Fault::TargetRange { word: "S-5".into() }]);
}

#[test]
fn inches_need_inches_in_force() {
    let inch = |words| Op::StraightTraverse(Move { to: in_unit(point(words), Unit::Inch), said: true });
    refused("fanuc", &lines(vec![inch("X1.")]));
    let stmts = lines(vec![Op::UseLengthUnits(Units::Inch), inch("X1.2345")]);
    let (text, diags) = program(writer("fanuc", layout()), &Modes::default(), &stmts, &[]);
    assert_eq!(text, "G20 G40 G49 G80\nG90 G00 X1.2345\n%\n");
    assert_eq!(diags, []);
    refused("mach9", &lines(vec![Op::UseLengthUnits(Units::Inch), rapid("X1.")]));
}

#[test]
fn a_unit_that_no_one_has_said_is_refused() {
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    writer("mach9", layout()).write(&lines(vec![rapid("X1.")]), &Modes::default(), &mut out, &mut diags);
    assert!(matches!(diags[0].fault, Fault::TargetLacks { .. }));
    // A literal without a unit is written digit for digit.
    out.clear();
    diags.clear();
    let to = measured(in_unit(point("X1.2345"), Unit::Entry), Fact::Entry);
    let stmts = lines(vec![Op::StraightTraverse(Move { to, said: true })]);
    writer("fanuc", layout()).write(&stmts, &Modes::default(), &mut out, &mut diags);
    assert_eq!(String::from_utf8_lossy(&out), "G40 G49 G80\nG00 X1.2345\n");
    assert_eq!(diags, []);
}

#[test]
fn a_subprograms_unit_must_be_the_only_one() {
    let body = lines(vec![rapid("X1.")]);
    let sub = |body| Procedure { name: "1".into(), body, ..Procedure::default() };
    let main = lines(vec![rapid("X0."), Op::ProgramEnd]);
    let (_, diags) = program(writer("fanuc", layout()), &metric(), &main, &[sub(body.clone())]);
    assert_eq!(diags, []);
    let other = lines(vec![Op::UseLengthUnits(Units::Inch)]);
    let subs = [sub(body), Procedure { name: "2".into(), ..sub(other) }];
    let (_, diags) = program(writer("fanuc", layout()), &metric(), &main, &subs);
    assert!(matches!(faults(&diags)[..], [Fault::TargetLacks { .. }]));
}

#[test]
fn a_distance_mode_that_is_not_in_force_is_put_in() {
    let inc = |words| {
        let to = measured(point(words), Fact::Known(Distance::Incremental));
        Op::StraightTraverse(Move { to, said: false })
    };
    let stmts = lines(vec![rapid("X0."), inc("X1."), inc("X1."), rapid_on("X5.")]);
    assert_eq!(clean("fanuc", &stmts), "G00 X0.\nG91 X1.\nX1.\nG90 X5.\n");
    // With one G code a block, the mode and a said motion are two blocks.
    let said = lines(vec![rapid("X0."), inc("X1."), rapid("X5.")]);
    let (text, diags) = text("mach9", &said);
    assert_eq!(text, "G0X0.\nG91X1.\nG90\nG0X5.\n");
    assert_eq!(faults(&diags), [&Fault::BlockSplit]);
    let mut mixed = point("X1. Y1.");
    mixed.set(Axis::Y, Coord { value: mm("1."), distance: Fact::Known(Distance::Incremental) });
    refused("fanuc", &lines(vec![Op::StraightTraverse(Move { to: mixed, said: true })]));
    // After a mode of ours, words in the source's own mode cannot be written.
    let entry = measured(point("X1."), Fact::Entry);
    let entry = Op::StraightTraverse(Move { to: entry, said: true });
    refused("fanuc", &lines(vec![rapid("X0."), inc("X1."), entry]));
}

#[test]
fn the_plain_way_and_the_general_way_write_the_same() {
    let ops = || {
        vec![
            vec![rapid("X0. Y0. Z5.")],
            vec![Op::SetFeedRate(mm("600")), feed("Z-1.25")],
            vec![on("X12.345 Y-0.5 Z3.21")],
            vec![on("X-99999.999 A-0.001 C360")],
            vec![Op::SetFeedRate(mm("0.5")), on("Y0.100")],
            vec![feed("Y1234.56")],
            vec![rapid_on("Z100.")],
        ]
    };
    for dialect in ["fanuc", "mach9"] {
        for layout in [layout(), every(1, 1), Layout { numbering: Numbering::Keep, crlf: true }] {
            let mut plain = blocks(ops());
            if dialect == "mach9" {
                plain.retain(|s| !matches!(&s.op, Op::StraightFeed(m) if m.to.get(Axis::A).is_some()));
            }
            for (at, stmt) in plain.iter_mut().enumerate().filter(|(_, s)| !s.joined) {
                stmt.number = Some(at as u32 * 100);
            }
            for remark in [None, Some("A remark"), Some("(in brackets)")] {
                let last = plain.len() - 1;
                for at in [1, last] {
                    plain[at].comment = remark.map(|remark| Box::new(remark.into()));
                }
                let general = the_general_way(&plain);
                let (plain, diags) = text_with(writer(dialect, layout.clone()), &plain);
                let (general, there) = text_with(writer(dialect, layout.clone()), &general);
                assert_eq!(diags, there);
                assert_eq!(
                    plain,
                    without_empty_remarks(&general, if dialect == "fanuc" { "()" } else { ";" })
                );
            }
        }
    }
}
