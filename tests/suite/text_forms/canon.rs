//! The canonical stream as text.

use ncc_backends::{Head, Layout, canon::Writer};
use ncc_dialects::Settings;
use ncc_frontends::{Batch, canon::Reader};
use ncc_ir::canon::*;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::*;
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;
use proptest::option::of;
use proptest::prelude::*;
use proptest::sample::select;

use super::any;

const TABLE_12: &str = include_str!("table12.canon");

fn settings() -> Settings {
    Settings::new(ncc_dialects::builtin("canon").unwrap())
}

fn write(stmts: &[Stmt], assumed: Modes) -> (String, Vec<Diagnostic>) {
    let mut writer = Writer::new(settings(), Layout::default());
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    let (first, second) = stmts.split_at(stmts.len() / 2);
    writer.write(first, &assumed, &mut out, &mut diags);
    writer.write(second, &assumed, &mut out, &mut diags);
    writer.finish(&mut out, &mut diags);
    (String::from_utf8(out).unwrap(), diags)
}

fn read(text: &[u8], assume: bool) -> Batch {
    let mut reader = Reader::new(settings(), assume);
    let mut batch = Batch::default();
    let mut base = 0;
    for line in text.split_inclusive(|&b| b == b'\n') {
        reader.read(line, base, &mut batch);
        base += line.len() as u32;
    }
    reader.finish(&mut batch);
    batch
}

fn mm(mantissa: i64, scale: u8) -> Num {
    Num { mantissa, scale, point: true, unit: Unit::Mm }
}

fn to(words: &[(Axis, Num)]) -> Point {
    let mut point = Point::default();
    for (axis, n) in words {
        point.set(*axis, absolute(*n));
    }
    point
}

fn stmt(op: Op) -> Stmt {
    Stmt::new(Span::default(), op)
}

fn feed(words: &[(Axis, Num)]) -> Stmt {
    stmt(Op::StraightFeed(Move { to: to(words), said: false }))
}

fn millimetres() -> Modes {
    Modes { units: Some(Units::Mm), distance: Some(Distance::Absolute), ..Modes::default() }
}

#[test]
fn table_12_is_read_and_written_as_printed() {
    let batch = read(TABLE_12.as_bytes(), true);
    let codes: Vec<_> = batch.diagnostics.iter().map(|d| d.fault.code()).collect();
    assert_eq!(codes, [301, 301, 301, 110], "{:?}", batch.diagnostics);
    assert_eq!(batch.stmts.len(), TABLE_12.lines().count());
    assert_eq!(write(&batch.stmts, batch.assumed), (TABLE_12.to_owned(), vec![]));
}

#[test]
fn modal_coordinates_are_filled_in() {
    let stmts = [
        feed(&[(Axis::X, mm(-15, 0)), (Axis::Y, mm(15588, 3))]),
        feed(&[(Axis::Z, mm(300, 2))]),
        stmt(Op::UseToolLengthOffset(Expr::int(1))),
        feed(&[(Axis::X, mm(5, 1))]),
        feed(&[(Axis::C, Num { unit: Unit::Degree, ..mm(90, 0) }), (Axis::Z, mm(0, 0))]),
        feed(&[(Axis::Y, mm(0, 0))]),
    ];
    let expected = "STRAIGHT_FEED(-15.0, 15.588, _)
STRAIGHT_FEED(-15.0, 15.588, 3.0)
USE_TOOL_LENGTH_OFFSET(1)
STRAIGHT_FEED(0.5, 15.588, _)
STRAIGHT_FEED(0.5, 15.588, 0.0, _, _, 90.0)
STRAIGHT_FEED(0.5, 0.0, 0.0, _, _, 90.0)
";
    assert_eq!(write(&stmts, millimetres()), (expected.to_owned(), vec![]));
}

#[test]
fn increments_are_summed_and_units_kept_apart() {
    let by = |n: Num| Coord { value: n.into(), distance: Fact::Known(Distance::Incremental) };
    let mut point = to(&[(Axis::X, mm(1, 1))]);
    point.set(Axis::Y, by(mm(2, 1)));
    let inch = |mantissa| Num { unit: Unit::Inch, ..mm(mantissa, 0) };
    let stmts = [
        feed(&[(Axis::X, mm(0, 0)), (Axis::Y, mm(1, 1)), (Axis::Z, mm(254, 1))]),
        stmt(Op::StraightTraverse(Move { to: point, said: true })),
        feed(&[(Axis::X, inch(3))]),
    ];
    let (text, diags) = write(&stmts, millimetres());
    // 0.3 mm is no inch of seven digits: the axis is left where it stands.
    let expected = "STRAIGHT_FEED(0.0, 0.1, 25.4)
STRAIGHT_TRAVERSE(0.1, 0.3, 25.4)
USE_LENGTH_UNITS(CANON_UNITS_INCHES)
STRAIGHT_FEED(3.0, _, 1.0)
";
    assert_eq!((text.as_str(), diags), (expected, vec![]));
    let nowhere = Stmt { span: Span::new(3, 9), ..stmts[1].clone() };
    let diags = write(&[nowhere], millimetres()).1;
    assert_eq!(diags, [Diagnostic::new(Fault::PositionUnknown { axis: 'Y' }, Span::new(3, 9))]);
}

#[test]
fn arcs_by_start_by_radius_and_in_each_plane() {
    let arc = |plane, turn, words: &[(Axis, Num)], centre, turns: u32| {
        let said = true;
        stmt(Op::ArcFeed(Box::new(Arc {
            plane: Fact::Known(plane),
            turn,
            to: to(words),
            centre,
            turns: turns.into(),
            said,
        })))
    };
    let from_start = |i: Option<i64>, j: Option<i64>, k: Option<i64>| Centre::Point {
        words: [i, j, k].map(|n| n.map(|n| mm(n, 0).into())),
        from: CentreFrom::Start,
    };
    let stmts = [
        feed(&[(Axis::X, mm(10, 0)), (Axis::Y, mm(0, 0)), (Axis::Z, mm(5, 0))]),
        arc(
            Plane::Xy,
            Turn::Counterclockwise,
            &[(Axis::X, mm(0, 0)), (Axis::Y, mm(10, 0))],
            from_start(Some(-10), None, None),
            0,
        ),
        arc(Plane::Xy, Turn::Clockwise, &[], from_start(None, Some(-10), None), 0),
        arc(
            Plane::Xy,
            Turn::Clockwise,
            &[(Axis::X, mm(10, 0)), (Axis::Y, mm(0, 0)), (Axis::Z, mm(1, 0))],
            Centre::Radius(mm(10, 0).into()),
            2,
        ),
        arc(
            Plane::Zx,
            Turn::Counterclockwise,
            &[(Axis::Z, mm(11, 0))],
            from_start(Some(0), None, Some(5)),
            0,
        ),
    ];
    let (text, diags) = write(&stmts, millimetres());
    let expected = "STRAIGHT_FEED(10.0, 0.0, 5.0)
ARC_FEED(0.0, 10.0, 0.0, 0.0, 1, 5.0)
ARC_FEED(0.0, 10.0, 0.0, 0.0, -1, 5.0)
ARC_FEED(10.0, 0.0, 0.0, 0.0, -3, 1.0)
SELECT_PLANE(CANON_PLANE_XZ)
ARC_FEED(11.0, 10.0, 6.0, 10.0, 1, 0.0)
";
    assert_eq!(text, expected);
    assert!(diags.iter().all(|d| d.fault == Fault::ArcReformatted) && diags.len() == 4, "{diags:?}");
    let again = read(text.as_bytes(), false);
    assert_eq!(again.diagnostics, []);
    // A flat arc is read without a word for its normal, a helix with one.
    let normals: Vec<bool> = again
        .stmts
        .iter()
        .filter_map(|s| match &s.op {
            Op::ArcFeed(arc) => Some(arc.to.get(arc.plane.known()?.axes().2).is_some()),
            _ => None,
        })
        .collect();
    assert_eq!(normals, [false, false, true, false]);
    assert_eq!(write(&again.stmts, Modes::default()), (text, vec![]));
}

#[test]
fn a_stated_start_fills_the_first_move() {
    let mut writer = Writer::new(settings(), Layout::default());
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    writer.stand_at(&[None, Some(15_588_000_000), Some(3_000_000_000), None, None, None]);
    writer.write(&[feed(&[(Axis::X, mm(-15, 0))])], &millimetres(), &mut out, &mut diags);
    assert_eq!(String::from_utf8(out).unwrap(), "STRAIGHT_FEED(-15.0, 15.588, 3.0)\n");
}

#[test]
fn what_the_stream_cannot_say_is_refused() {
    let refused = |op: Op| write(&[stmt(op)], millimetres());
    for op in [
        Op::Goto("1".into()),
        Op::Label("1".into()),
        Op::Return,
        Op::Hole(Move::default()),
        Op::SetFrame(Box::new(Frame { added: true, step: FrameStep::Mirror([true, false, false]) })),
        Op::UseMachineCoordinates { length: true },
        Op::Control(Box::new(Control::Loop { body: vec![] })),
        Op::Call(Box::new(Call { name: "1".into(), times: 1, arguments: vec![], shared: false })),
    ] {
        let (text, diags) = refused(op);
        assert_eq!(text, "");
        assert!(matches!(diags[..], [Diagnostic { fault: Fault::TargetLacks { .. }, .. }]), "{diags:?}");
    }
    assert_eq!(refused(Op::EndCycle), (String::new(), vec![]));
    let long = Num { scale: 9, ..mm(1_234_567_899, 0) };
    let (text, diags) = write(&[feed(&[(Axis::X, long)])], millimetres());
    assert_eq!(text, "STRAIGHT_FEED(1.234568, _, _)\n");
    assert_eq!(diags[0].fault, Fault::Rounded { word: "X".into(), written: "1.234568".into() });
    let nineteen_digits = mm(-1_000_000_000_000_000_201, 1);
    let (text, diags) = write(&[feed(&[(Axis::X, nineteen_digits)])], millimetres());
    assert_eq!((text.as_str(), &diags[0].fault), ("", &Fault::TargetRange { word: "X".into() }));
}

#[test]
fn the_head_is_comments() {
    let writer = Writer::new(settings(), Layout { crlf: true, ..Layout::default() });
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    let head = Head { lines: vec!["ncc: \"a\"".into()], ..Head::default() };
    writer.head(&head, &mut out, &mut diags);
    assert_eq!(String::from_utf8(out).unwrap(), "COMMENT(\"ncc: \\\"a\\\"\")\r\n");
}

#[track_caller]
fn one(line: &str, code: u16, at: &str) {
    let text = format!("SELECT_TOOL(3)\n{line}\r\nPROGRAM_END()\n");
    let batch = read(text.as_bytes(), false);
    let found: Vec<_> = batch
        .diagnostics
        .iter()
        .map(|d| (d.fault.code(), &text[d.span.start as usize..d.span.end as usize]))
        .collect();
    assert_eq!(found, [(code, at)], "{:?}", batch.diagnostics);
    assert_eq!(batch.stmts.len(), 2, "the lines before and after are read");
}

#[test]
fn each_fault_once_at_its_place() {
    one("FLOOD_OFF()", 201, "FLOOD_OFF");
    one("STRAIGHT_FEED(1.0, 2.0)", 205, ")");
    one("STRAIGHT_FEED(1.0, 2.0, 3.0, 4.0)", 205, ")");
    one("STRAIGHT_FEED(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0)", 109, "7.0");
    one("STRAIGHT_FEED(1.0, 2.0 3.0)", 109, "3.0");
    one("STRAIGHT_FEED(1.0, 2.0, \"3.0\")", 109, "\"3.0\"");
    one("STRAIGHT_FEED(1.0, 2.0, 3.0", 109, "");
    one("STRAIGHT_FEED(1.0, 2.0, 1234567890123456789.0)", 102, "1234567890123456789.0");
    one("STRAIGHT_FEED 1.0, 2.0, 3.0", 109, "1.0");
    one("ARC_FEED(1.0, 2.0, 3.0, _, 1, 0.0)", 109, "_");
    one("ARC_FEED(1.0, 2.0, 3.0, 4.0, 0, 0.0)", 209, "0");
    one("ARC_FEED(1.0, 2.0, 3.0, 4.0, 1.5, 0.0)", 209, "1.5");
    one("CHANGE_TOOL(4)", 203, "4");
    one("SELECT_TOOL(1.0)", 209, "1.0");
    one("SET_ORIGIN_OFFSETS(1.0, 2.0)", 205, ")");
    one("SET_ORIGIN_OFFSETS(1.0, 2.0, 3.0, 4.0)", 205, ")");
    one("SET_ORIGIN_OFFSETS(1.0)", 209, "1.0");
    one("SELECT_PLANE(CANON_PLANE_UV)", 109, "CANON_PLANE_UV");
    one("USE_LENGTH_UNITS()", 205, ")");
    one("COMMENT(\"open)", 103, "\"open)");
    one("COMMENT(text)", 109, "text");
    one("PROGRAM_STOP(1)", 109, "1");
    one("/0 PROGRAM_STOP()", 209, "0");
    one("SET_FEED_RATE(10 %)", 101, "%");
    one(&format!("COMMENT({})", "1,".repeat(100)), 109, &format!("COMMENT({})", "1,".repeat(100)));
}

#[test]
fn faults_of_the_whole_text() {
    let faults = |text: &str| -> Vec<u16> {
        read(text.as_bytes(), true).diagnostics.iter().map(|d| d.fault.code()).collect()
    };
    assert_eq!(faults(""), [108]);
    assert_eq!(faults("FLOOD_ON()\n"), [110]);
    assert_eq!(faults("PROGRAM_END()\n\nCOMMENT(\"x\")\nFLOOD_ON()\nMIST_ON()\n"), [111]);
    assert_eq!(faults("CHANGE_TOOL(1)\nPROGRAM_END()\n"), [221]);
    assert_eq!(faults("/PROGRAM_END()\nFLOOD_ON()\nPROGRAM_END()\n"), Vec::<u16>::new());
}

/// NIST's own forms (`canon.hh`): an origin in machine coordinates is work offset 1 with these values; a length is known
/// by its decimal point; a rate of rapid moves is left out. That work offset 1 is overwritten is reported at each place.
#[test]
fn forms_of_nist() {
    let text = "USE_LENGTH_UNITS(CANON_UNITS_CM)\nSET_ORIGIN_OFFSETS(-30.0, 5, 1.25, 90.0, 0.0, 0.0)\n\
                USE_TOOL_LENGTH_OFFSET(8.25)\nSET_TRAVERSE_RATE(1500)\nSTRAIGHT_TRAVERSE(1.5, 2, 0.12)\n\
                SET_ORIGIN_OFFSETS(1.0, 2.0, 3.0)\nPROGRAM_END()\n";
    let batch = read(text.as_bytes(), true);
    let found: Vec<_> = batch.diagnostics.iter().map(|d| d.fault.code()).collect();
    assert_eq!(found, [308, 444, 301, 308]);
    let values = |words: [Option<Num>; AXES]| {
        let words = Box::new(words.map(|word| word.map(Expr::Num)));
        Op::SetData(Box::new(Data::Offset { offset: 1, mode: DataMode::Set, words, turn: None }))
    };
    let degrees = |n| Some(Num { unit: Unit::Degree, ..mm(n, 0) });
    let whole = |n| Num { point: false, ..mm(n, 0) };
    let first = [Some(mm(-300, 0)), Some(whole(50)), Some(mm(125, 1)), degrees(90), degrees(0), degrees(0)];
    let second = [Some(mm(10, 0)), Some(mm(20, 0)), Some(mm(30, 0)), None, None, None];
    let mut place = to(&[(Axis::X, mm(15, 0)), (Axis::Z, mm(12, 1))]);
    place.set(Axis::Y, absolute(whole(20)));
    let ops: Vec<_> = batch.stmts.iter().map(|s| (s.op.clone(), s.joined)).collect();
    assert_eq!(
        ops,
        [
            (Op::UseLengthUnits(Units::Mm), false),
            (values(first), false),
            (Op::SetOriginOffsets(1), true),
            (Op::UseToolLength(Box::new(ToolLength::Value(mm(825, 1).into()))), false),
            (Op::NoEffect("SET_TRAVERSE_RATE(1500)".into()), false),
            (Op::StraightTraverse(Move { to: place, said: false }), false),
            (values(second), false),
            (Op::SetOriginOffsets(1), true),
            (Op::ProgramEnd, false),
        ]
    );
    assert_eq!(batch.assumed.work_offset, None);
}

#[test]
fn forms_of_nist_that_would_cut_elsewhere_are_refused() {
    let refused = |text: &str| -> Vec<String> {
        let all = read(text.as_bytes(), true).diagnostics;
        all.into_iter()
            .filter_map(|d| match d.fault {
                Fault::NotSupported { what, .. } => Some(format!("{what:?}")),
                _ => None,
            })
            .collect()
    };
    let origin = "SET_ORIGIN_OFFSETS(1.0, 2.0, 3.0)\n";
    let by_number = "SET_ORIGIN_OFFSETS(2)\n";
    let to_origin = "STRAIGHT_TRAVERSE(0.0, 0.0, 0.0)\n";
    assert_eq!(refused(&format!("{to_origin}{origin}")), ["Table(OriginAfterMove)"]);
    assert_eq!(refused(&format!("{by_number}{origin}")), ["Table(OriginByBoth)"]);
    assert_eq!(refused(&format!("{origin}{to_origin}{by_number}")), ["Table(OriginByBoth)"]);
    assert_eq!(refused(&format!("/{origin}")), ["Code(Skipped)"]);
    assert_eq!(refused("/USE_LENGTH_UNITS(CANON_UNITS_CM)\n"), ["Code(Skipped)"]);
    let back = "USE_LENGTH_UNITS(CANON_UNITS_CM)\n/USE_LENGTH_UNITS(CANON_UNITS_MM)\n";
    assert_eq!(refused(back), ["Code(Skipped)"]);
    assert_eq!(refused(&format!("{origin}{to_origin}{origin}")), [""; 0]);
}

/// Digits and unit that the text keeps.
fn number(unit: Unit) -> impl Strategy<Value = Num> {
    (-9_999_999i64..9_999_999, 0u8..=6).prop_map(move |(mantissa, scale)| Num {
        mantissa,
        scale,
        point: true,
        unit,
    })
}

fn point() -> impl Strategy<Value = Point> {
    let word = |axis: Axis| {
        let unit = if axis.is_rotary() { Unit::Degree } else { Unit::Mm };
        let some = if axis.is_rotary() { 0.1 } else { 0.7 };
        let distance = select(vec![Distance::Absolute, Distance::Absolute, Distance::Incremental]);
        proptest::option::weighted(some, (number(unit), distance)).prop_map(|word| {
            word.map(|(n, distance)| Coord { value: n.into(), distance: Fact::Known(distance) })
        })
    };
    Axis::ALL.map(word).prop_map(|axes| Point { axes })
}

fn statement() -> impl Strategy<Value = Stmt> {
    let turn = select(vec![Turn::Clockwise, Turn::Counterclockwise]);
    let planes = || select(vec![Plane::Xy, Plane::Zx, Plane::Yz]);
    let centre = [number(Unit::Mm), number(Unit::Mm), number(Unit::Mm)]
        .prop_map(|n| Centre::Point { words: n.map(|n| Some(n.into())), from: CentreFrom::Zero });
    let op = prop_oneof![
        4 => point().prop_map(|to| Op::StraightFeed(Move { to, said: false })),
        2 => point().prop_map(|to| Op::StraightTraverse(Move { to, said: true })),
        2 => (planes(), turn, point(), centre, 0u32..3).prop_map(|(plane, turn, to, centre, turns)| {
            Op::ArcFeed(Box::new(Arc { plane: Fact::Known(plane), turn, to, centre, turns: turns.into(), said: true }))
        }),
        1 => planes().prop_map(Op::SelectPlane),
        1 => number(Unit::Mm).prop_map(|n| Op::SetFeedRate(n.into())),
        1 => number(Unit::Second).prop_map(|n| Op::Dwell(n.into())),
        1 => (0i64..99).prop_map(|n| Op::SelectTool(Expr::int(n))),
        1 => (0i64..99).prop_map(|n| Op::UseToolLengthOffset(Expr::int(n))),
        1 => number(Unit::Mm).prop_map(|n| Op::UseToolLength(Box::new(ToolLength::Value(n.into())))),
        1 => (1u16..9).prop_map(Op::SetOriginOffsets),
        1 => (any::<bool>(), 0i64..99).prop_map(|(left, entry)| Op::StartCutterRadiusCompensation {
            side: if left { Side::Left } else { Side::Right },
            radius: CutterRadius::Entry(Expr::int(entry)),
        }),
        1 => any::text().prop_map(Op::Comment),
        1 => any::text().prop_map(Op::Message),
        2 => select(vec![
            Op::Blank, Op::FloodOn, Op::MistOn, Op::CoolantOff, Op::StartSpindleClockwise,
            Op::StartSpindleCounterclockwise, Op::StopSpindleTurning, Op::ProgramStop, Op::OptionalProgramStop,
            Op::StopCutterRadiusCompensation, Op::ClearFrame(FrameSlot::Shift), Op::EndCycle,
            Op::SetDistanceMode(Distance::Incremental), Op::SetReturnLevel(ReturnLevel::Initial),
        ]),
    ];
    (
        op,
        proptest::option::weighted(0.1, 1u8..=9),
        of(any::<u32>()),
        proptest::option::weighted(0.1, any::text()),
    )
        .prop_map(|(op, skip, number, comment)| {
            let comment = comment.map(Box::new);
            Stmt { skip: skip.filter(|_| op != Op::Blank), number, comment, ..stmt(op) }
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn what_is_written_is_read_back(mut stmts in prop::collection::vec(statement(), 0..30)) {
        // The tool stands somewhere, so that increments have a sum.
        stmts.insert(0, feed(&Axis::ALL.map(|axis| {
            (axis, Num { unit: if axis.is_rotary() { Unit::Degree } else { Unit::Mm }, ..mm(1, 0) })
        })[..3]));
        let (text, _) = loop {
            for (place, s) in stmts.iter_mut().enumerate() {
                s.span = Span::new(place as u32, place as u32);
            }
            let (text, diags) = write(&stmts, millimetres());
            // An increment from an unknown place is refused; go on without the last such one.
            match diags.iter().rfind(|d| matches!(d.fault, Fault::PositionUnknown { .. })) {
                Some(d) => drop(stmts.remove(d.span.start as usize)),
                None => break (text, diags),
            }
        };
        let batch = read(text.as_bytes(), false);
        prop_assert_eq!(&batch.diagnostics, &vec![], "{}", text);
        let (again, _) = write(&batch.stmts, millimetres());
        prop_assert_eq!(&again, &text);
        // Wherever the text knows where the tool ends, it is where the program ends.
        let end = |stmts: &[Stmt]| {
            let mut at = Tracker::new(millimetres());
            stmts.iter().for_each(|s| at.step(s));
            at.position
        };
        prop_assert_eq!(end(&stmts), end(&batch.stmts), "{}", text);
    }

    #[test]
    fn the_recogniser_agrees_with_the_grammar(
        line in "STRAIGHT_(FEED|TRAVERSE)\\((-?[0-9]{0,3}(\\.[0-9]{0,20})?|_)(, ?(-?[0-9]{1,4}\\.[0-9]{1,4}|_|-?[0-9]{0,20}\\.[0-9]{1,3})){0,7}\\)"
    ) {
        // The blank in front is the grammar's.
        let fast = read(format!("{line}\n").as_bytes(), false);
        let slow = read(format!(" {line}\n").as_bytes(), false);
        let ops = |b: &Batch| b.stmts.iter().map(|s| (s.op.clone(), s.span.end - s.span.start)).collect::<Vec<_>>();
        prop_assert_eq!(ops(&fast), ops(&slow));
        prop_assert_eq!(fast.diagnostics.len(), slow.diagnostics.len());
    }

    #[test]
    fn any_bytes_are_read_without_panic(bytes in prop::collection::vec(any::<u8>(), 0..300), assume: bool) {
        read(&bytes, assume);
    }

    #[test]
    fn any_words_are_read_without_panic(
        text in "((ARC_FEED|STRAIGHT_FEED|SELECT_TOOL|DWELL|_|\\(|\\)|/|,|-1\\.0|1|\"a\"|\n| ){1,3}){0,40}"
    ) {
        read(text.as_bytes(), true);
    }

    #[test]
    fn any_program_is_written_without_panic(body in any::body()) {
        let (text, _) = write(&body, Modes::default());
        let batch = read(text.as_bytes(), false);
        prop_assert_eq!(&batch.diagnostics, &vec![], "{}", text);
    }
}
