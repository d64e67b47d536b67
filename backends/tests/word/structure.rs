//! Blocks, safe start, comments, calls, numbering, block skip.

use crate::*;
use ncc_backends::Head;
use ncc_ir::canon::ReturnLevel;
use ncc_ir::program::{Call, Frame, FrameSlot, FrameStep, ProgramName};

#[test]
fn a_port_of_the_case_study_begins_clean() {
    let stmts = blocks(vec![
        vec![Op::Comment("FACEAMENTO:".into())],
        vec![Op::ClearFrame(FrameSlot::Shift)],
        vec![Op::SetDistanceMode(Distance::Absolute)],
        vec![Op::UseLengthUnits(Units::Mm)],
        vec![Op::SelectPlane(Plane::Xy)],
        vec![Op::NoEffect("G66".into())],
        vec![rapid("Z0")],
        vec![Op::SelectTool(count("1")), Op::ChangeTool],
        vec![Op::SetSpindleSpeed(count("1263")), Op::StartSpindleClockwise],
        vec![rapid("X0. Y108.")],
        vec![Op::UseToolLengthOffset(count("1")), rapid_on("Z5.")],
        vec![Op::SetFeedRate(mm("505")), feed("Z-1.")],
        vec![on("Y-108.")],
        vec![Op::StopSpindleTurning],
        vec![Op::ProgramEnd],
    ]);
    let assumed = Modes { feed_mode: Some(FeedMode::PerMinute), work_offset: Some(1), ..Modes::default() };
    let mut w = writer("fanuc", layout());
    let head = Head {
        name: ProgramName { number: None, title: Some("teste".into()) },
        lines: vec!["ncc: mach9 teste.cn sha256 9d5c21f0, verified".into()],
    };
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    w.head(&head, &mut out, &mut diags);
    w.write(&stmts, &assumed, &mut out, &mut diags);
    w.finish(&mut out, &mut diags);
    assert_eq!(
        String::from_utf8(out).expect("text"),
        "%\n\
         O0001 (TESTE)\n\
         (NCC: MACH9 TESTE.CN SHA256 9D5C21F0, VERIFIED)\n\
         G21 G17 G90 G40 G49 G80 G94\n\
         G54\n\
         (FACEAMENTO:)\n\
         (G66)\n\
         G00 Z0.\n\
         T1 M06\n\
         S1263 M03\n\
         G00 X0. Y108.\n\
         G43 H1 Z5.\n\
         G01 Z-1. F505.\n\
         Y-108.\n\
         M05\n\
         M30\n\
         %\n"
    );
    assert_eq!(diags, []);
    let stated = w.stated();
    assert_eq!(stated, Modes { length_offset: Some(0), return_level: None, motion: None, ..metric() });
}

#[test]
fn the_same_program_stays_itself_on_its_own_control() {
    let stmts = blocks(vec![
        vec![Op::Comment("FURAÇÃO 3mm :".into())],
        vec![Op::ClearFrame(FrameSlot::Shift)],
        vec![Op::UseLengthUnits(Units::Mm)],
        vec![Op::NoEffect("G66".into())],
        vec![rapid("Z0")],
        vec![Op::SelectTool(count("1")), Op::ChangeTool],
        vec![
            Op::SetSpindleSpeed(count("1263")),
            Op::StartSpindleClockwise,
            Op::UseToolLengthOffset(count("1")),
        ],
        vec![rapid("X0. Y108.")],
        vec![rapid_on("Z5.")],
        vec![Op::SetFeedRate(mm("505")), feed("Z-1.")],
        vec![Op::ProgramEnd],
    ]);
    let mut w = writer("mach9", layout());
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    w.write(&stmts, &Modes { distance: Some(Distance::Absolute), ..Modes::default() }, &mut out, &mut diags);
    w.finish(&mut out, &mut diags);
    assert_eq!(
        String::from_utf8(out).expect("text"),
        ";FURAÇÃO 3mm :\nG99\nG71\nG66\nG0Z0\nT1M6\nO1S1263M3\nG0X0.Y108.\nZ5.\nG1Z-1.F505\nM2\n"
    );
    let o_word = Fault::AssumedOption { option: "o_word".into(), value: "offset".into() };
    assert_eq!(faults(&diags), [&o_word]);
    assert_eq!(w.stated(), Modes::default());
}

#[test]
fn the_safe_start_states_what_is_known_and_no_more() {
    let stmts = lines(vec![
        Op::UseLengthUnits(Units::Inch),
        Op::SetReturnLevel(ReturnLevel::Initial),
        Op::SelectTool(count("1")),
    ]);
    let (text, diags) = program(writer("fanuc", layout()), &Modes::default(), &stmts, &[]);
    assert_eq!(text, "G20 G40 G49 G80 G98\nT1\n%\n");
    assert_eq!(diags, []);
}

#[test]
fn what_the_source_says_before_its_first_event_is_not_written_twice() {
    let stmts = blocks(vec![
        vec![
            Op::UseLengthUnits(Units::Mm),
            Op::SelectPlane(Plane::Xy),
            Op::SetDistanceMode(Distance::Absolute),
            Op::StopCutterRadiusCompensation,
            Op::UseToolLengthOffset(count("0")),
            Op::EndCycle,
        ],
        vec![Op::SetOriginOffsets(2), rapid("X0.")],
        vec![Op::SetDistanceMode(Distance::Absolute)],
        vec![Op::SetOriginOffsets(2)],
    ]);
    let (text, diags) = program(writer("fanuc", layout()), &Modes::default(), &stmts, &[]);
    assert_eq!(text, "G21 G17 G90 G40 G49 G80\nG55\nG00 X0.\nG90\nG55\n%\n");
    assert_eq!(diags, []);
}

#[test]
fn comments_and_empty_lines_keep_their_place() {
    let mut stmts = lines(vec![
        Op::Comment("ONE".into()),
        Op::Blank,
        rapid("X1."),
        Op::Comment("TWO".into()),
        Op::Blank,
        on("X2."),
    ]);
    stmts[2].comment = Some(Box::new("AT X1".into()));
    assert_eq!(clean("fanuc", &stmts), "(ONE)\n\nG00 X1. (AT X1)\n(TWO)\n\nG01 X2.\n");
    assert_eq!(clean("mach9", &stmts), ";ONE\n\nG0X1.;AT X1\n;TWO\n\nG1X2.\n");
}

#[test]
fn a_comment_in_other_characters_is_reported_once() {
    let mut stmts = lines(vec![rapid("X1.")]);
    stmts[0].comment = Some(Box::new("Furação (8)".into()));
    let (text, diags) = text("fanuc", &stmts);
    assert_eq!(text, "G00 X1. (FURACAO - 8)\n");
    assert_eq!(faults(&diags), [&Fault::CommentReformatted]);
    let long = lines(vec![rapid("X1."), Op::Comment("A".repeat(61).into())]);
    let (text, diags) = crate::text("fanuc", &long);
    assert_eq!(text, format!("G00 X1.\n({})\n(A)\n", "A".repeat(60)));
    assert_eq!(faults(&diags), [&Fault::CommentReformatted]);
}

#[test]
fn a_program_without_events_has_no_safe_start_of_its_own() {
    let stmts = lines(vec![Op::Comment("ONLY".into())]);
    let (text, _) = program(writer("fanuc", layout()), &metric(), &stmts, &[]);
    assert_eq!(text, "(ONLY)\n%\n");
    let stmts = lines(vec![Op::Comment("ONLY".into()), Op::UseLengthUnits(Units::Inch)]);
    let (text, _) = program(writer("fanuc", layout()), &Modes::default(), &stmts, &[]);
    assert_eq!(text, "G20 G40 G49 G80\n(ONLY)\n%\n");
}

#[test]
fn words_stand_in_the_order_of_posts() {
    let stmts = blocks(vec![vec![
        Op::SetDistanceMode(Distance::Absolute),
        Op::SetOriginOffsets(1),
        Op::SetFeedRate(mm("100.")),
        Op::SetSpindleSpeed(count("3000")),
        Op::SelectTool(count("2")),
        Op::StartSpindleClockwise,
        Op::UseToolLengthOffset(count("3")),
        feed("C1. A2. Z3. Y4. X5."),
    ]]);
    let mut stmts_after = lines(vec![rapid("X0.")]);
    stmts_after.extend(stmts);
    assert_eq!(
        clean("fanuc", &stmts_after),
        "G00 X0.\nG90 G54 G01 G43 H3 X5. Y4. Z3. A2. C1. F100. S3000 T2 M03\n"
    );
}

#[test]
fn a_block_is_split_only_where_it_must_be() {
    // One M code a block; a dwell and a move share the letter X; order of functions.
    let m = vec![vec![rapid("X0.")], vec![Op::FloodOn, rapid_on("X1."), Op::StopSpindleTurning]];
    let (text, diags) = text("fanuc", &blocks(m));
    assert_eq!(text, "G00 X0.\nX1. M08\nM05\n");
    assert_eq!(faults(&diags), [&Fault::BlockSplit]);
    assert_eq!(diags[0].span, Span::new(10, 19));
    let dwell = blocks(vec![vec![rapid("X0.")], vec![Op::Dwell(seconds("1.5")), feed("X1.")]]);
    let (text, diags) = crate::text("fanuc", &dwell);
    assert_eq!(text, "G00 X0.\nG04 X1.5\nG01 X1.\n");
    assert_eq!(faults(&diags), [&Fault::BlockSplit]);
    // One G code a block, and the feed goes with its move.
    let g = blocks(vec![vec![
        Op::SetDistanceMode(Distance::Absolute),
        Op::SelectPlane(Plane::Xy),
        Op::SetFeedRate(mm("200.")),
        feed("X1."),
    ]]);
    let (text, diags) = crate::text("mach9", &g);
    assert_eq!(text, "G90\nG17\nG1X1.F200\n");
    assert_eq!(faults(&diags), [&Fault::BlockSplit]);
    // What fits stays.
    let stays = blocks(vec![
        vec![Op::SelectTool(count("3")), Op::ChangeTool],
        vec![Op::SetSpindleSpeed(count("900")), Op::StartSpindleCounterclockwise],
        vec![rapid("X0."), Op::CoolantOff],
    ]);
    assert_eq!(clean("fanuc", &stays), "T3 M06\nS900 M04\nG00 X0. M09\n");
    assert_eq!(clean("mach9", &stays), "T3M6\nS900M4\nG0X0.M9\n");
}

#[test]
fn functions_and_stops_have_their_codes() {
    let stmts = lines(vec![
        Op::MistOn,
        Op::FloodOn,
        Op::CoolantOff,
        Op::Dwell(seconds("5")),
        Op::ProgramStop,
        Op::OptionalProgramStop,
        Op::UseToolLengthOffset(count("0")),
        Op::ProgramEnd,
    ]);
    assert_eq!(clean("fanuc", &stmts), "M07\nM08\nM09\nG04 X5.\nM00\nM01\nG49\nM30\n");
    assert_eq!(clean("mach9", &stmts), "M7\nM8\nM9\nG4D5.\nM0\nM1\nO0\nM2\n");
}

#[test]
fn a_row_that_nobody_confirms_is_told_once() {
    let stmts = lines(vec![Op::FloodOn, Op::CoolantOff, Op::FloodOn, Op::UseToolLengthOffset(count("0"))]);
    let (_, told) = text("mach9", &stmts);
    let codes: Vec<&str> = faults(&told)
        .into_iter()
        .map(|fault| match fault {
            Fault::AssumedRow { code, .. } => &**code,
            Fault::AssumedOption { option, .. } => &**option,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(codes, ["M8", "M9", "o_word", "O0"]);
    assert_eq!(text("fanuc", &stmts).1, []);
}

#[test]
fn an_option_that_decides_is_told_once_and_only_if_nobody_chose_it() {
    let offset = || Op::UseToolLengthOffset(count("3"));
    let stmts = lines(vec![offset(), rapid("X0."), offset()]);
    let o_word = Fault::AssumedOption { option: "o_word".into(), value: "offset".into() };
    assert_eq!(faults(&text("mach9", &stmts).1), [&o_word]);
    let mut chosen = Settings::new(builtin("mach9").expect("built in"));
    chosen.choose("o_word", "offset").expect("an option");
    assert_eq!(text_with(Writer::new(chosen, layout()), &stmts).1, []);
}

#[test]
fn a_function_of_the_machine_stands_alone_and_has_its_own_code() {
    let function = |name: &str| Op::MachineFunction(name.into());
    let row = |code: &str, name: &str| {
        format!("[[code]]\ncode = {code:?}\nmeans = \"MACHINE_FUNCTION {name}\"\nsource = \"shop\"\n")
    };
    let (air, conveyor) = (row("M70", "air-on"), row("M71", "conveyor-on"));
    let text = format!("id = \"shop\"\ntitle = \"\"\nbase = \"fanuc\"\n{air}{conveyor}");
    let dialect = ncc_dialects::load(&[&text]).expect("a dictionary").remove(0);
    let settings = Settings::new(Box::leak(Box::new(dialect)));
    let block = blocks(vec![vec![Op::FloodOn, function("conveyor-on"), Op::MistOn, rapid_on("X1.")]]);
    let (out, told) = text_with(Writer::new(settings, layout()), &block);
    assert_eq!(out, "M08\nM71\nG00 X1. M07\n");
    assert!(faults(&told).iter().all(|fault| **fault == Fault::BlockSplit), "{told:?}");
    refused("fanuc", &lines(vec![function("air-on")]));
}

#[test]
fn facts_that_a_control_has_alone_need_no_word() {
    let stmts = lines(vec![
        rapid("X0."),
        Op::SetFeedMode(FeedMode::PerMinute),
        Op::SetReturnLevel(ReturnLevel::Initial),
        Op::SetOriginOffsets(1),
        rapid("X1."),
    ]);
    assert_eq!(clean("mach9", &stmts), "G0X0.\nG0X1.\n");
    assert_eq!(clean("fanuc", &stmts), "G00 X0.\nG94\nG98\nG54\nG00 X1.\n");
    let shift = lines(vec![rapid("X0."), Op::ClearFrame(FrameSlot::Shift), rapid("X1.")]);
    assert_eq!(clean("fanuc", &shift), "G00 X0.\nG00 X1.\n");
}

#[test]
fn what_has_no_word_is_refused() {
    let per_turn = lines(vec![rapid("X0."), Op::SetFeedMode(FeedMode::PerRevolution)]);
    assert_eq!(clean("fanuc", &per_turn), "G00 X0.\nG95\n");
    refused("mach9", &per_turn);
    let turned_back = lines(vec![rapid("X0."), Op::ClearFrame(FrameSlot::Rotation)]);
    assert_eq!(clean("fanuc", &turned_back), "G00 X0.\nG69\n");
    refused("mach9", &turned_back);
    for op in [
        Op::SetFrame(Box::new(Frame { added: true, step: FrameStep::Mirror([true, false, false]) })),
        Op::UseMachineCoordinates { length: true },
        Op::UseToolEdge { edge: count("1"), said: true },
        Op::Message("CHECK".into()),
        Op::Assign(ncc_ir::expr::Var::Local("1".into()).into(), mm("1.")),
        Op::SelectTool(Expr::Node(Box::new(ncc_ir::expr::Node::Vacant))),
        Op::SelectTool(count("1.5")),
    ] {
        refused("fanuc", &lines(vec![rapid("X0."), op.clone()]));
        refused("mach9", &lines(vec![rapid("X0."), op]));
    }
    // A jump to a block that there is not.
    let nowhere = lines(vec![rapid("X0."), Op::Goto("10".into())]);
    assert_eq!(faults(&text("fanuc", &nowhere).1), [&Fault::LabelUnknown { name: "10".into() }]);
    refused("mach9", &nowhere);
    let label = lines(vec![rapid("X0."), Op::Label("10".into())]);
    // Nothing comes back to it.
    assert_eq!(clean("fanuc", &label), "G00 X0.\n");
    assert_eq!(clean("mach9", &label), "G0X0.\n");
    let further = lines(vec![rapid("X0."), Op::SetOriginOffsets(54)]);
    assert_eq!(clean("fanuc", &further), "G00 X0.\nG54.1 P48\n");
    refused("fanuc", &lines(vec![rapid("X0."), Op::SetOriginOffsets(55)]));
    let by_time = lines(vec![Op::SetFeedMode(FeedMode::InverseTime), rapid("X0.")]);
    assert_eq!(clean("fanuc", &by_time), "G21 G17 G90 G40 G49 G80 G93\nG54\nG00 X0.\n");
    refused("mach9", &by_time);
    refused("mach9", &lines(vec![rapid("A90.")]));
    // A length offset of a control that may move by it at once.
    refused("fanuc", &lines(vec![rapid("X0."), Op::UseToolLengthOffset(count("1")), rapid("Z1.")]));
    let mut ignore = Settings::new(builtin("mach9").expect("built in"));
    ignore.choose("o_word", "ignore").expect("an option");
    let (_, diags) =
        text_with(Writer::new(ignore, layout()), &lines(vec![Op::UseToolLengthOffset(count("1"))]));
    assert_eq!(diags.len(), 1);
}

#[test]
fn motion_codes_are_written_when_said_or_not_known() {
    let stmts = lines(vec![
        feed("X0."),
        on("X1."),
        feed("X2."),
        rapid_on("X3."),
        rapid_on("X4."),
        Op::EndCycle,
        rapid_on("X5."),
    ]);
    assert_eq!(clean("fanuc", &stmts), "G01 X0.\nX1.\nG01 X2.\nG00 X3.\nX4.\nG80\nG00 X5.\n");
}

#[test]
fn what_a_skipped_block_changes_is_not_known_after_it() {
    let mut stmts = lines(vec![feed("X0."), rapid("X1."), rapid_on("X2."), on("X3."), Op::FloodOn]);
    stmts[1].skip = Some(1);
    stmts[3].skip = Some(2);
    stmts[4].skip = Some(1);
    assert_eq!(clean("fanuc", &stmts), "G01 X0.\n/G00 X1.\nG00 X2.\n/2 G01 X3.\n/M08\n");
    // A block that says what is active leaves it known.
    let mut same = lines(vec![feed("X0."), on("X1."), on("X2.")]);
    same[1].skip = Some(1);
    assert_eq!(clean("mach9", &same), "G1X0.\n/X1.\nX2.\n");
    let mut level = lines(vec![feed("X0."), on("X1.")]);
    level[1].skip = Some(2);
    refused("mach9", &level);
}

#[test]
fn skipped_settings_are_no_part_of_the_safe_start() {
    let mut stmts = lines(vec![Op::SetDistanceMode(Distance::Absolute), rapid("X0.")]);
    stmts[0].skip = Some(1);
    let (text, _) = program(writer("fanuc", layout()), &Modes::default(), &stmts, &[]);
    assert_eq!(text.lines().take(2).collect::<Vec<_>>(), ["G40 G49 G80", "/G90"]);
}

#[test]
fn block_numbers() {
    let mut stmts = lines(vec![rapid("X0."), Op::Comment("C".into()), on("X1.")]);
    stmts[0].number = Some(5);
    stmts[2].number = Some(70);
    let (text, diags) = program(writer("fanuc", layout()), &metric(), &stmts, &[]);
    assert!(text.ends_with("G00 X0.\n(C)\nG01 X1.\n%\n"));
    assert_eq!(faults(&diags), [&Fault::NumbersLeftOut { count: 2 }]);
    let keep = Layout { numbering: Numbering::Keep, crlf: false };
    assert_eq!(text_with(writer("fanuc", keep.clone()), &stmts).0, "N5 G00 X0.\n(C)\nN70 G01 X1.\n");
    assert_eq!(text_with(writer("mach9", keep), &stmts).0, "N5G0X0.\n;C\nN70G1X1.\n");
    let (text, _) = text_with(writer("fanuc", every(10, 10)), &stmts);
    assert_eq!(text, "N10 G21 G17 G90 G40 G49 G80 G94\nN20 G54\nN30 G00 X0.\n(C)\nN40 G01 X1.\n");
    let (text, _) = text_with(writer("mach9", every(99_999, 1)), &stmts);
    assert_eq!(text, "N99999G0X0.\n;C\nN99999G1X1.\n");
}

#[test]
fn subprograms_follow_the_main_program() {
    let main = lines(vec![
        rapid("X0."),
        Op::Call(Box::new(Call { name: "12".into(), times: 1, arguments: vec![], shared: false })),
        Op::Call(Box::new(Call { name: "12".into(), times: 5, arguments: vec![], shared: false })),
        rapid_on("X1."),
        Op::ProgramEnd,
    ]);
    let entry = |words| measured(in_unit(point(words), Unit::Entry), Fact::Entry);
    let body = lines(vec![Op::Position(Move { to: entry("X10. Y12.5"), said: false }), rapid("Z5.")]);
    let sub = Procedure { name: "12".into(), title: Some("Holes".into()), body, ..Procedure::default() };
    let (text, diags) = program(writer("fanuc", layout()), &metric(), &main, std::slice::from_ref(&sub));
    assert_eq!(
        text,
        "G21 G17 G90 G40 G49 G80 G94\nG54\n\
         G00 X0.\nM98 P12\nM98 P50012\nG90 G00 X1.\nM30\n\
         O0012 (HOLES)\nX10. Y12.5\nG90 G00 Z5.\nM99\n%\n"
    );
    assert_eq!(diags, []);
    refused("mach9", &main);
    let call = |name: &str, times| {
        lines(vec![Op::Call(Box::new(Call { name: name.into(), times, arguments: vec![], shared: false }))])
    };
    refused("fanuc", &call("12345", 1));
    refused("fanuc", &call("holes", 1));
    let (_, diags) = crate::text("fanuc", &call("12", 10_000));
    assert!(matches!(diags[0].fault, Fault::TargetRange { .. }));
}

#[test]
fn a_title_without_a_place_becomes_a_comment() {
    let head = Head {
        name: ProgramName { number: Some(1234), title: Some("Flange".into()) },
        lines: vec!["ncc".into()],
    };
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    writer("mach9", layout()).head(&head, &mut out, &mut diags);
    assert_eq!(String::from_utf8_lossy(&out), ";1234 Flange\n;ncc\n");
    assert_eq!(faults(&diags), [&Fault::NameAsComment]);
    out.clear();
    let windows = Layout { crlf: true, ..layout() };
    writer("fanuc", windows).head(&head, &mut out, &mut diags);
    assert_eq!(String::from_utf8_lossy(&out), "%\r\nO1234 (FLANGE)\r\n(NCC)\r\n");
}
