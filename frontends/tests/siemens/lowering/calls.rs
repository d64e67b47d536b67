//! Units, subprograms, repetition.

use super::*;

/// A main program and its subprograms: their statements, and the errors.
fn units(text: &str) -> (Vec<String>, Vec<String>) {
    let out = read(text);
    let subs = out
        .procedures
        .iter()
        .map(|p| format!("{}: {}", p.name, p.body.iter().map(show::stmt).collect::<Vec<_>>().join(" | ")));
    let subs = subs.collect();
    let errors =
        diagnostics(&out, text.as_bytes()).into_iter().filter(|d| !d.starts_with("Assumed")).collect();
    (subs, errors)
}

fn with_subs(main: &str, subs: &str) -> (Vec<String>, Vec<String>) {
    units(&format!("%_N_A_MPF\n;$PATH=/_N_MPF_DIR\n{HEAD}{main}M30\n{subs}"))
}

#[test]
fn subprograms_by_number_and_name() {
    let calls = after_head("L12\nl012 P3\nNAME P=2\nCALL \"l12\"\nNAME()\n");
    assert_eq!(calls, ["CALL 12 x1", "CALL L012 x3", "CALL NAME x2", "CALL 12 x1", "CALL NAME x1"]);
    assert!(read("L12\n").whole && !read("G0\n").whole);
    let (subs, errors) =
        with_subs("L12\nL012\n", "%_N_L12_SPF\nG0 X1\nM17\n%_N_l012_SPF\nPROC L012 DISPLOF\nRET\n");
    assert_eq!(subs, ["12: TRAVERSE! X?1u | Return", "L012: Return"]);
    assert_eq!(errors, [] as [&str; 0]);
    let out = read("%_N_PLATE_MPF\nM30\n");
    assert_eq!((out.name.title.as_deref(), out.name.number), (Some("PLATE"), None));
    assert_eq!(read("%_N_0815_MPF\nM30\n").name.number, Some(815));
}

#[test]
fn ends_of_programs() {
    let goes_back = ["SetDistanceMode(Absolute)", "Return"];
    let ends = ["SetDistanceMode(Absolute)", "ProgramEnd"];
    // What a text is, its header says, its heading, or its file's name; RET by itself.
    assert_eq!(stmts(&read("PROC A_A\nG90\nRET\n")), goes_back);
    assert_eq!(stmts(&read("PROC A_A\nG90\nM17\n")), goes_back);
    assert_eq!(stmts(&read("%_N_A_SPF\nG90\nRET\n")), goes_back);
    assert_eq!(stmts(&read("%_N_A_SPF\nG90\n")), goes_back);
    assert_eq!(stmts(&read("%_N_A_SPF\nG90\nM30\n")), ends);
    assert_eq!(stmts(&read("%_N_A_MPF\nG90\nM17\n")), ends);
    let of_file = |file: &str, text: &str| {
        let mut reader = Reader::new(settings(), true);
        reader.named(file);
        let mut out = Batch::default();
        reader.read(text.as_bytes(), 0, &mut out);
        reader.finish(&mut out);
        (stmts(&out), diagnostics(&out, text.as_bytes()))
    };
    let (sub, none) = (goes_back.map(str::to_owned).to_vec(), Vec::<String>::new());
    let main = ends.map(str::to_owned).to_vec();
    assert_eq!(of_file("SLOT.spf", "G90\nM17\n"), (sub.clone(), none.clone()));
    assert_eq!(of_file("SLOT.MPF", "G90\nM17\n"), (main.clone(), none.clone()));
    let taken = |what: &str, code: &str| vec![format!("AssumedFact {{ fact: {what} }} at '{}'", code)];
    assert_eq!(of_file("SLOT.TXT", "G90\nM17\n"), (main, taken("EndsMain { code: 'M17' }", "M17")));
    assert_eq!(of_file("SLOT.MPF", "G90\nRET\n"), (sub, taken("ReturnsToCaller { code: 'RET' }", "RET")));
    let (subs, errors) = with_subs("B_B\n", "%_N_B_B_SPF\nM8\nM30\n");
    assert_eq!((subs, errors), (vec!["B_B: FloodOn | Return".to_owned()], vec![]));
    assert_eq!(units("G90\n").1, ["NoProgramEnd at 'G90'"]);
    assert_eq!(units("M30\n; c\nX1\nY1 Q1\n").1, ["TextAfterEnd at 'X1'"]);
    assert_eq!(units("\n;\n").1, ["EmptyProgram at ''"]);
}

#[test]
fn units_that_are_refused() {
    let refused = |code: &str, what: &str, at: &str| {
        format!("NotSupported {{ code: '{code}', what: {what} }} at '{at}'")
    };
    assert_eq!(with_subs("", "%_N_B_MPF\nX5\n").1, [refused("%_N_B_MPF", "Text(SecondMain)", "%_N_B_MPF")]);
    assert_eq!(with_subs("", "%_N_B_INI\n$X=5\n").1, [refused("%_N_B_INI", "Text(NoProgram)", "%_N_B_INI")]);
    assert_eq!(with_subs("", "%_N_12_SPF\nM17\n").1, [refused("12", "Text(ByPathOnly)", "12")]);
    assert_eq!(with_subs("", "%_N_L1_SPF\nM17\n%_N_L1_SPF\nM17\n").1, ["ProgramTwice { name: '1' } at 'L1'"]);
    assert_eq!(
        units("%_X\nM30\n").1[0],
        "Syntax { found: Text('%_X'), expected: Text('%_N_NAME_MPF') } at '%_X'"
    );
    assert_eq!(units("%\nM30\n").1, [] as [&str; 0]);
}

#[test]
fn subprograms_that_are_not_there_are_told_where_they_are_called_first() {
    let (_, errors) = with_subs("L77\nL1\nDRILL_ALL\nL77\n", "%_N_L1_SPF\nM17\n");
    assert_eq!(
        errors,
        ["CallUnknown { name: 'L77' } at 'L77'", "CallUnknown { name: 'DRILL_ALL' } at 'DRILL_ALL'"]
    );
}

#[test]
fn a_call_loses_every_fact() {
    assert_eq!(after_head("L12\nX5\nG0 X6\n"), ["CALL 12 x1", "POSITION X?5u", "TRAVERSE! X?6u"]);
}

#[test]
fn a_motion_that_was_only_said_is_handed_on() {
    assert_eq!(after_head("G1\nL12\n"), ["Blank", "FEED!", "& CALL 12 x1"]);
    assert_eq!(after_head("G1 X1\nL12\n"), ["FEED! X1", "CALL 12 x1"]);
}

#[test]
fn positions_of_a_subprogram_under_a_cycle_of_its_caller() {
    let drill = "MCALL CYCLE81(5,0,2,-3)\nL1\nX9\nMCALL\n";
    let (subs, errors) = with_subs(drill, "%_N_L1_SPF\nX1 Y2\nG0 X3\nM17\n");
    assert_eq!(errors, [] as [&str; 0]);
    assert_eq!(subs, ["1: POSITION X?1u Y?2u | POSITION X?3u | Return"]);
    assert_eq!(after_head(drill)[2], "HOLE X?9u");
    let refused = |sub: &str| with_subs(drill, &format!("%_N_L1_SPF\n{sub}\nM17\n")).1.remove(0);
    assert_eq!(refused("G1 X1"), "NotSupported { code: 'G1', what: Move(FeedInCallersCycle) } at 'G1'");
    assert_eq!(refused("Z1"), "NotSupported { code: 'Z1', what: Move(NoPosition) } at 'Z1'");
    assert_eq!(refused("MCALL"), "NotSupported { code: 'MCALL', what: Call(CycleLeft) } at 'M17'");
    // The feed of its own is not the subprogram's.
    let bore = "MCALL CYCLE85(5,0,2,-3,,,9,9)\nL1\nMCALL\n";
    assert_eq!(
        with_subs(bore, "%_N_L1_SPF\nX1 F5\nM17\n").1,
        ["NotSupported { code: 'F5', what: Move(FeedInCallersCycleWord) } at 'F5'"]
    );
    assert_eq!(faults("MCALL CYCLE85(5,0,2,-3,,,9,9)\nL1\nMCALL\nG1 X1\n"), ["NoFeed at 'G1 X1'"]);
    assert_eq!(
        faults("G1 X1\nMCALL CYCLE81(5,0,2,-3)\nL1\n"),
        ["NotSupported { code: 'L1', what: Call(UnderCycleMotion) } at 'L1'"]
    );
}

#[test]
fn a_subprogram_keeps_to_what_it_was_read_under() {
    let both = "L1\nMCALL CYCLE81(5,0,2,-3)\nL1\nMCALL\n";
    // Without a motion code it is whatever is active; with one it is not known.
    assert_eq!(with_subs(both, "%_N_L1_SPF\nX1\nM17\n").1, [] as [&str; 0]);
    assert_eq!(
        with_subs(both, "%_N_L1_SPF\nG0 X1\nM17\n").1,
        ["EntryFactNeeded { fact: Motion } at 'G0 X1'"]
    );
    let late = "%_N_L1_SPF\nG0 X1\nM17\n%_N_L2_SPF\nMCALL CYCLE81(5,0,2,-3)\nL1\nMCALL\nM17\n";
    assert_eq!(
        with_subs("L1\nL2\n", late).1,
        ["NotSupported { code: 'L1', what: Call(UnderOtherCycle) } at 'L1'"]
    );
    let open = with_subs("L2\n", "%_N_L2_SPF\nMCALL CYCLE81(5,0,2,-3)\nX1\nM17\n").1;
    assert_eq!(open, ["NotSupported { code: 'MCALL', what: Call(CycleLeft) } at 'M17'"]);
}

#[test]
fn the_plane_of_a_cycle_in_a_subprogram() {
    let drill = "%_N_L1_SPF\nMCALL CYCLE81(5,0,2,-3)\nX1 Y2\nMCALL\nM17\n";
    let (subs, errors) = with_subs("L1\n", drill);
    assert_eq!(errors, [] as [&str; 0]);
    assert_eq!(subs, ["1: CYCLE drill ? R2u Z-3u back 5u | HOLE X?1u Y?2u | EndCycle | Return"]);
    assert_eq!(with_subs("G18\nL1\n", drill).1, ["EntryFactNeeded { fact: Plane } at 'X1 Y2'"]);
    // Said only afterwards.
    assert_eq!(
        with_subs("L1\n", &format!("{drill}%_N_L2_SPF\nG19\nM17\n")).1,
        ["EntryFactNeeded { fact: Plane } at 'X1 Y2'"]
    );
}

#[test]
fn the_unit_of_a_feed_in_a_subprogram() {
    let feed = "%_N_L1_SPF\nF50\nM17\n";
    assert_eq!(with_subs("L1\n", feed).0, ["1: F50u | Return"]);
    assert_eq!(units(&format!("G70\nL1\nM30\n{feed}")).0, ["1: F50 | Return"]);
    assert_eq!(units(&format!("G71\nL1\nM30\n{feed}")).0, ["1: F50u | Return"]);
    assert_eq!(units(&format!("G70\nG700\nL1\nM30\n{feed}")).1, ["EntryFactNeeded { fact: Units } at 'F50'"]);
    assert_eq!(
        units(&format!("G700\nL1\nM30\n{feed}%_N_L2_SPF\nG70\nM17\n")).1,
        ["EntryFactNeeded { fact: Units } at 'F50'"]
    );
}

#[test]
fn labels_and_repetition() {
    assert_eq!(after_head("N5 A_B: X1\nREPEAT a_b P=3\n"), ["N5 A_B:", "& TRAVERSE X1", "REPEAT A_B x3"]);
    assert_eq!(after_head("AA: X1\nBB: X2\nREPEAT AA BB\n")[4], "REPEAT AA to BB x1");
    // What is relied on after a label, by lines that are read the short way too, is another the second time.
    for (mode, line) in [("G1 F100", "X1"), ("G91", "X1"), ("G18", "G2 X1 Y0 I1 J0"), ("G70", "X1")] {
        let text = format!("G71 G90 G17 G0 X0 Y0 F100\nAA:\n{line}\n{line}\n{mode} Z3\nREPEAT AA\n");
        let faults = faults(&text);
        assert!(faults.iter().any(|fault| fault.contains("RepeatDiffers")), "{mode}: {faults:?}");
    }
    assert_eq!(faults("REPEAT AA\n"), ["LabelUnknown { name: 'AA' } at 'AA'"]);
    assert_eq!(faults("AA: X1\nREPEAT AA BB\n"), ["LabelUnknown { name: 'BB' } at 'BB'"]);
    assert_eq!(
        faults("AA: X1\nREPEAT AA P=0\n"),
        ["OutOfRange { word: Word('REPEAT AA P=0') } at 'REPEAT AA P=0'"]
    );
    assert_eq!(after_head("AA: X1\nREPEAT AA P=R1\n")[2], r#"REPEAT AA xNode(Var(Common("R1")))"#);
    assert_eq!(faults("AA: X1\nREPEAT AA P=\"A\"\n").len(), 1);
    assert_eq!(after_head("AA: X1\nX2\nREPEATB AA P=2\n")[3], "REPEAT AA to AA x2");
    assert_eq!(after_head("ENDLABEL:\n"), ["ENDLABEL_1:"]);
    // The end that stands first after the label counts; a label of that name is another one.
    let ends = after_head("AA: X1\nENDLABEL_1: X2\nENDLABEL:\nX3\nENDLABEL:\nREPEAT AA\n");
    assert_eq!(ends.last().map(String::as_str), Some("REPEAT AA to ENDLABEL_2 x1"));
    assert_eq!(after_head("ENDLABEL:\nAA: X1\nREPEAT AA\n")[3], "REPEAT AA x1");
}

#[test]
fn a_subprogram_after_each_move() {
    let calls = after_head("MCALL L70\nG0 X1\nF100\nN5 X2\n/ X3\nMCALL\nX4\n");
    assert_eq!(
        calls,
        [
            "TRAVERSE! X1",
            "CALL 70 x1",
            "F100u",
            "N5 POSITION X?2u",
            "CALL 70 x1",
            "/1 POSITION X?3u",
            "/1 CALL 70 x1",
            "POSITION X?4u"
        ]
    );
    assert_eq!(after_head("MCALL CYCLE81(5,0,2,-3)\nMCALL POCKET\nMCALL\n")[1..], ["EndCycle"]);
    let refused = |what: &str, at: &str, code: &str| {
        [format!("NotSupported {{ code: '{code}', what: {what} }} at '{at}'")]
    };
    assert_eq!(faults("MCALL L70\nL80\n"), refused("Call(WhileModal)", "L80", "L80"));
    assert_eq!(faults("MCALL SUB(R1)\n"), refused("Call(ModalShared)", "SUB(R1)", "SUB(R1)"));
    assert_eq!(faults("/MCALL L70\n"), refused("Call(ModalSkipped)", "L70", "L70"));
    assert_eq!(faults("MCALL L70\n/MCALL\n"), refused("Cycle(CallEndSkipped)", "/MCALL", "MCALL"));
    assert_eq!(
        faults("MCALL L70\nHOLES2(0,0,5,0,0,2)\n"),
        refused("Cycle(PatternOfSubprogram)", "HOLES2(0,0,5,0,0,2)", "HOLES2")
    );
}

#[test]
fn repeated_blocks_find_what_they_found_the_first_time() {
    let refused = ["NotSupported { code: 'REPEAT', what: Call(RepeatDiffers) } at 'REPEAT AA'"];
    assert_eq!(faults("AA: X1\nG91\nREPEAT AA\n"), refused);
    assert_eq!(faults("AA: G90 X1\nG91\nREPEAT AA\n"), [] as [&str; 0]);
    assert_eq!(faults("AA: X1\nG1 X2\nREPEAT AA\n"), refused);
    assert_eq!(faults("AA: G0 X1\nG1 X2\nREPEAT AA\n"), [] as [&str; 0]);
    assert_eq!(faults("AA: G0 X1\nMCALL CYCLE81(5,0,2,-3)\nREPEAT AA\n"), refused);
    assert_eq!(faults("AA: G2 X1 I1\nG18\nREPEAT AA\n"), refused);
    // What was assumed in passing is no other mode.
    assert_eq!(units("AA: G0 X1\nREPEAT AA\nM30\n").1, [] as [&str; 0]);
    // After it, the modes of either end.
    assert_eq!(after_head("AA: G91 X1\nBB: X2\nG90\nREPEAT AA BB\nX3\n").pop(), Some("TRAVERSE X?3".into()));
}

#[test]
fn ways_in_which_feeds_count_leave_their_subprogram() {
    let errors = |main: &str, sub: &str| with_subs(main, &format!("%_N_L1_SPF\n{sub}\nM17\n")).1;
    let none = Vec::<String>::new();
    // A time is one move's; what a feed said before does not count any more.
    assert_eq!(errors("G94 F9\nL1\nG1 X1 F2\n", "G93"), none);
    assert_eq!(errors("G94 F9\nL1\nG1 X1 F2\n", "G93\nG1 X2 F3\nG94"), none);
    // Which feed is active after a cycle that has its own is not known; nor one that is stated for no move.
    let last = ["NoFeed at 'M17'"];
    assert_eq!(errors("L1\nG1 X1 F2\n", "G93\nG94\nF5\nCYCLE85(5,0,2,-3,,,9,9)"), last);
    assert_eq!(errors("L1\nG1 X1 F2\n", "G93 F5\nM8"), last);
}
