//! The text form of the neutral program.

use ncc_backends::{Head, Layout, ir::Writer};
use ncc_dialects::Settings;
use ncc_frontends::{Batch, ir::Reader};
use ncc_ir::canon::{Axis, Distance, Plane, Units};
use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Procedure, Program, Stmt};
use ncc_ir::source::Span;
use proptest::prelude::*;

use super::any;

fn settings() -> Settings {
    Settings::new(ncc_dialects::builtin("ir").unwrap())
}

fn write(program: &Program, crlf: bool) -> String {
    let mut writer = Writer::new(settings(), Layout { crlf, ..Layout::default() });
    let (mut body, mut out, mut diags) = (Vec::new(), Vec::new(), Vec::new());
    // In two pieces, as a stream comes.
    let (first, second) = program.procedures[0].body.split_at(program.procedures[0].body.len() / 2);
    writer.write(first, &program.assumed, &mut body, &mut diags);
    writer.write(second, &program.assumed, &mut body, &mut diags);
    for p in &program.procedures[1..] {
        writer.procedure(p, &mut body, &mut diags);
    }
    writer.finish(&mut body, &mut diags);
    let head = Head { name: program.name.clone(), lines: vec!["ncc: a \"head\" { line".into()] };
    writer.head(&head, &mut out, &mut diags);
    assert_eq!(diags, []);
    out.extend(body);
    String::from_utf8(out).unwrap()
}

fn read(text: &[u8], pieces: usize) -> Batch {
    let mut reader = Reader::new(settings(), true);
    let mut batch = Batch::default();
    let lines: Vec<&[u8]> = text.split_inclusive(|&b| b == b'\n').collect();
    let mut base = 0;
    for piece in lines.chunks(pieces.max(1)) {
        let piece = piece.concat();
        reader.read(&piece, base, &mut batch);
        base += piece.len() as u32;
    }
    reader.finish(&mut batch);
    batch
}

fn without_spans(stmts: &mut [Stmt]) {
    for stmt in stmts {
        stmt.span = Span::default();
        if let Op::Control(control) = &mut stmt.op {
            {
                for body in control.bodies_mut() {
                    without_spans(body);
                }
            }
        }
    }
}

fn program(batch: Batch) -> Program {
    let mut procedures = vec![Procedure { body: batch.stmts, ..Procedure::default() }];
    procedures.extend(batch.procedures);
    for p in &mut procedures {
        without_spans(&mut p.body);
    }
    Program { name: batch.name, assumed: batch.assumed, procedures }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(192))]

    #[test]
    fn a_program_is_read_back_as_it_was_written(p in any::program(), crlf: bool, pieces in 1usize..50) {
        let text = write(&p, crlf);
        let batch = read(text.as_bytes(), pieces);
        // A program without a statement is none; everything else is read without a fault.
        if batch.diagnostics.iter().any(|d| d.fault != Fault::EmptyProgram) {
            panic!("{:?}\n{text}", batch.diagnostics);
        }
        prop_assert_eq!(program(batch), p, "{}", text);
    }

    #[test]
    fn any_bytes_are_read_without_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        read(&bytes, 1);
    }

    #[test]
    fn any_words_are_read_without_panic(text in
        "((ARC_FEED|CALL|said|X|Y|inc|-|\\(|\\)|\\{|\\}|&|/|,|=|1\\.mm|N1|\"a\"|local:i|if|else|while|procedure|\n| ){1,3}){0,40}"
    ) {
        read(text.as_bytes(), 2);
    }
}

/// Faults of a text, each with the stretch that it points at.
fn faults(text: &str) -> Vec<(Fault, String)> {
    let batch = read(text.as_bytes(), 1);
    batch
        .diagnostics
        .into_iter()
        .map(|d| (d.fault, text[d.span.start as usize..d.span.end as usize].to_owned()))
        .collect()
}

#[track_caller]
fn one(line: &str, code: u16, at: &str) {
    let text = format!("ncc-ir 1\nFLOOD_ON()\n{line}\nMIST_ON()\n");
    let found = faults(&text);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].0.code(), found[0].1.as_str()), (code, at), "{found:?}");
    let batch = read(text.as_bytes(), 1);
    assert_eq!(batch.stmts.len(), 2, "the lines before and after are read");
}

#[test]
fn each_fault_once_at_its_place() {
    one("FLOOD_OFF()", 201, "FLOOD_OFF");
    one("DWELL()", 109, ")");
    one("DWELL(0.5s", 109, "");
    one("STRAIGHT_FEED(X 1.mm Y 2.mm)", 109, "Y");
    one("STRAIGHT_FEED(X 1.mm, X 2.mm)", 206, "X 1.mm, X 2.mm");
    one("STRAIGHT_FEED(X 1.m)", 109, "m");
    one("SET_FEED_RATE(1.2345678901234567890)", 102, "1.2345678901234567890");
    one("COMMENT(\"open)", 103, "\"open)");
    one("COMMENT(\"a\\q\")", 109, "\"a\\q\"");
    one("/11 FLOOD_ON()", 209, "11");
    one("FLOOD_ON() § MIST_ON()", 101, "§");
    one("while local:i <", 109, "");
    one("repeat 3", 109, "repeat 3");
    one("repeat {\nDWELL(1.s)\n}", 109, "{");
    one("FLOOD_ON() {\nDWELL(1.s)\n}", 109, "FLOOD_ON()");
    one("}", 109, "}");
    one("SET_ORIGIN_OFFSETS(70000)", 209, "70000");
    one("ncc-ir 2", 202, "ncc-ir 2");
    one(
        &format!("SET_FEED_RATE(1.{})", " + 1.".repeat(2000)),
        109,
        &format!("SET_FEED_RATE(1.{})", " + 1.".repeat(2000)),
    );
}

#[test]
fn what_is_open_at_the_end_is_shown() {
    assert_eq!(faults("ncc-ir 1\nFLOOD_ON()\nloop {\nMIST_ON()\n")[0].1, "loop {");
    assert_eq!(faults("")[0].0, Fault::EmptyProgram);
    let deep = format!("ncc-ir 1\n{}", "loop {\n".repeat(500));
    assert!(faults(&deep).len() > 100);
    assert_eq!(faults("FLOOD_ON()\n").len(), 1, "the version is missing");
}

#[test]
fn a_text_by_hand() {
    let text = "ncc-ir 1
# before
assumed(units mm, plane XY)
N10 SELECT_TOOL(1) & CHANGE_TOOL() \"the mill\"
/2 said STRAIGHT_TRAVERSE(X -15.mm, Y inc 3mm) & /0 FLOOD_ON()
& MIST_ON()
";
    let batch = read(text.as_bytes(), 1);
    assert_eq!(batch.diagnostics, []);
    let marks: Vec<_> = batch.stmts.iter().map(|s| (s.number, s.skip, s.joined)).collect();
    let expected = [
        (Some(10), None, false),
        (None, None, true),
        (None, Some(2), false),
        (None, None, true),
        (None, None, true),
    ];
    assert_eq!(marks, expected);
    assert_eq!(batch.stmts[1].comment.as_ref().map(|c| &***c), Some("the mill"));
    let Op::StraightTraverse(m) = &batch.stmts[2].op else { panic!("{:?}", batch.stmts[2]) };
    let y = m.to.get(Axis::Y).unwrap();
    assert!(m.said && !y.value.literal().unwrap().point && y.distance.known().is_some());
    let span = batch.stmts[1].span;
    assert_eq!(&text[span.start as usize..span.end as usize], "CHANGE_TOOL() \"the mill\"");
}

#[test]
fn of_facts_said_twice_the_later_counts() {
    let text = "ncc-ir 1\nassumed(units mm, distance absolute, units inch)\nassumed(distance incremental, plane ZX)\n";
    let assumed = read(text.as_bytes(), 1).assumed;
    assert_eq!((assumed.units, assumed.distance), (Some(Units::Inch), Some(Distance::Incremental)));
    assert_eq!(assumed.plane, Some(Plane::Zx));
}
