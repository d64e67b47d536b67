//! Units, calls, labels, skips, numbers, messages, comments.

use crate::cycles::{cycle, start};
use crate::*;
use ncc_ir::expr::Expr;
use ncc_ir::program::cycle::CycleKind;
use ncc_ir::program::{Call, Control, Move, Op, RepeatBlocks};
use ncc_ir::run_time::RunTimeFlow;

fn call(name: &str, times: u32) -> Op {
    Op::Call(Box::new(Call { name: name.into(), times, arguments: Vec::new(), shared: false }))
}

fn sub(name: &str, body: Vec<Op>) -> Procedure {
    Procedure { name: name.into(), body: lines(body), ..Procedure::default() }
}

#[test]
fn subprograms_are_units_and_so_is_the_main_program() {
    let main = lines(vec![rapid("X0."), call("1001", 1), call("POCKET", 3), Op::ProgramEnd]);
    let subs = [sub("1001", vec![rapid("X1."), Op::Return]), sub("POCKET", vec![rapid("X2.")])];
    let expected = format!(
        "%_N_P_1001_MPF\n; 1001\n; ncc\n{START}G0 X0\nL1001\nPOCKET P3\nM30\n\
         %_N_L1001_SPF\nG90 G0 X1\nM17\n%_N_POCKET_SPF\nG90 G0 X2\nM17\n"
    );
    assert_eq!(program(&main, &subs, Layout::default()), expected);
    let alone = lines(vec![rapid("X0."), Op::ProgramEnd]);
    assert_eq!(program(&alone, &[], Layout::default()), format!("; 1001\n; ncc\n{START}G0 X0\nM30\n"));
}

#[test]
fn positions_of_a_caller_stay_words() {
    let drill = start(cycle(CycleKind::Drill));
    let main = lines(vec![feed("X0."), drill, call("L100", 1), Op::EndCycle, Op::ProgramEnd]);
    let position = Op::Position(Move { to: point("X10. Y10."), said: false });
    let text = program(&main, &[sub("L100", vec![position, rapid("Z5.")])], Layout::default());
    // The caller sees to it that they are rapid; a move of another kind ends the cycle first.
    let expected = "G1 X0\nMCALL CYCLE81(10,3,0,-6)\nG0\nL100\nMCALL\nM30\n\
        %_N_L100_SPF\nG90 X10 Y10\nMCALL\nG0 Z5\nM17\n";
    assert!(text.ends_with(expected), "{text}");
}

#[test]
fn labels_and_repetitions() {
    let repeat = |from: &str, to: Option<&str>, times: u32| {
        Op::RepeatBlocks(Box::new(RepeatBlocks {
            from: from.into(),
            to: to.map(Into::into),
            times: Expr::int(times.into()),
        }))
    };
    let stmts = blocks(vec![
        vec![rapid("X0.")],
        vec![Op::Label("PASS".into()), feed("X30.")],
        vec![Op::Label("120".into())],
        vec![repeat("PASS", None, 4)],
        vec![repeat("PASS", Some("120"), 1)],
    ]);
    assert_eq!(text(&stmts).0, "G0 X0\nPASS: G90 G1 X30\nL_120:\nREPEAT PASS P=4\nREPEAT PASS L_120\n");
    let changed = Fault::NameChanged { from: "120".into(), to: "L_120".into() };
    assert_eq!(told(&stmts).1, [changed]);
    let body = lines(vec![feed("X1."), rapid("X0.")]);
    let control = Op::Control(Box::new(Control::Repeat { times: Expr::int(3), body }));
    assert_eq!(text(&lines(vec![control])).0, "AGAIN_1:\nG90 G1 X1\nG0 X0\nREPEAT AGAIN_1 P=2\n");
    assert_eq!(text(&lines(vec![rapid("X0."), Op::Goto("PASS".into())])).0, "G0 X0\nGOTOF PASS\n");
    let endless = Op::Control(Box::new(Control::Loop { body: Vec::new() }));
    assert_eq!(text(&lines(vec![rapid("X0."), endless])).0, "G0 X0\nLOOP\nENDLOOP\n");
    let counted = |step| {
        let variable = ncc_ir::expr::Var::Common("R1".into());
        let (from, to, step, body) = (Expr::int(1), Expr::int(2), Expr::int(step), Vec::new());
        Op::Control(Box::new(Control::For { variable, from, to, step, body }))
    };
    assert_eq!(text(&lines(vec![rapid("X0."), counted(1)])).0, "G0 X0\nFOR R1=1 TO 2\nENDFOR\n");
    let by_twos = not_computed(&lines(vec![rapid("X0."), counted(2)]));
    assert_eq!(by_twos, RunTimeFlow::LoopCountsOtherwise.into());
}

#[test]
fn messages() {
    let message = |text: &str| Op::Message(text.into());
    let stmts = lines(vec![rapid("X0."), message("Turn over; (2 screws)"), message("")]);
    assert_eq!(clean(&stmts), "G0 X0\nMSG(\"Turn over; (2 screws)\")\nMSG()\n");
    refused(&lines(vec![message("a \"b\"")]));
    refused(&lines(vec![message(&"x".repeat(201))]));
}

#[test]
fn skips_and_numbers() {
    let mut stmts = lines(vec![rapid("X0."), rapid("X1."), rapid("X2."), rapid("X3."), rapid("X4.")]);
    for (stmt, skip) in stmts.iter_mut().zip([None, Some(1), Some(2), Some(9), Some(10)]) {
        stmt.skip = skip;
        stmt.number = Some(10);
    }
    let mut w = writer(keep());
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    w.write(&stmts, &metric(), &mut out, &mut diags);
    let text = String::from_utf8(out).expect("text");
    let expected = "N10 G0 X0\n/N10 G0 X1\n/2 N10 G0 X2\n/9 N10 G0 X3\n/1 N10 G0 X4\n";
    assert_eq!(text.strip_prefix(START), Some(expected));
}

#[test]
fn comments_keep_their_characters_and_stand_last() {
    let mut stmts = blocks(vec![vec![Op::FloodOn, rapid("X0.")]]);
    stmts[0].comment = Some(Box::new("Kühlung (an)".into()));
    assert_eq!(clean(&stmts), "G0 X0 M8 ; Kühlung (an)\n");
    stmts[0].comment = Some(Box::new(" an".into()));
    assert_eq!(clean(&stmts), "G0 X0 M8 ; an\n");
}

#[test]
fn a_word_without_effect_stays_a_word_if_it_is_one() {
    let stmts = lines(vec![rapid("X0."), Op::NoEffect("DIAMOF".into()), Op::NoEffect("G66".into())]);
    assert_eq!(clean(&stmts), "G0 X0\nDIAMOF\n; G66\n");
}
