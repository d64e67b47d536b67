//! What is assumed, and what stays open.

use super::*;

#[test]
fn what_a_program_never_says_is_told_where_it_relies_on_it() {
    assert_eq!(
        assumptions("X1\nZ2 F5\nG2 X5 I1\nM30\n"),
        [
            "AssumedMode { fact: Motion, value: 'feed' } at 'X1'",
            "AssumedMode { fact: Distance, value: 'absolute' } at 'X1'",
            "AssumedMode { fact: Units, value: 'mm' } at 'X1'",
            "AssumedMode { fact: WorkOffset, value: '1' } at 'X1'",
            "AssumedMode { fact: FeedMode, value: 'per minute' } at 'F5'",
            "AssumedMode { fact: LengthOffset, value: '0' } at 'Z2'",
            "AssumedMode { fact: Plane, value: 'XY' } at 'G2 X5 I1'"
        ]
    );
    let out = read("G0 X1\nM30\n");
    assert_eq!(out.assumed.no_origin_shift, Some(true));
    assert_eq!(out.assumed.motion, None);
}

#[test]
fn a_text_of_our_own_leaves_it_open() {
    let out = read_with(settings(), false, b"X1\nG0 Z2\nM30\n");
    assert_eq!(stmts(&out), ["POSITION X?1u", "TRAVERSE! Z?2u", "ProgramEnd"]);
    assert_eq!(out.diagnostics, []);
    assert_eq!(out.assumed, ncc_ir::canon::Modes::default());
}

#[test]
fn a_refused_block_still_says_its_modes() {
    assert_eq!(
        faults("G91 G147 X1\nX2\n"),
        ["NotSupported { code: 'G147', what: Code(Named { name: 'soft approach' }) } at 'G147'"]
    );
    let text = HEAD.to_owned() + "G91 G147 X1\nX2\nM30\n";
    assert!(stmts(&read(&text)).contains(&"TRAVERSE X+=2".to_owned()));
    // What it may have said is not asked for again.
    assert_eq!(
        diagnostics(&read("G1 F=R1\nX1\nM30\n"), b"G1 F=R1\nX1\nM30\n")
            .iter()
            .filter(|d| d.starts_with("NoFeed"))
            .count(),
        0
    );
}
