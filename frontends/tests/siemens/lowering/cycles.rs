//! Drilling cycles, once and after each move.

use super::*;

/// The cycle of a call after the head.
fn cycle(call: &str) -> String {
    after_head(&format!("MCALL {call}\n")).remove(0)
}

#[test]
fn once_and_modal() {
    assert_eq!(
        after_head("CYCLE81(10,0,2,-5)\nX3\n"),
        ["CYCLE drill Xy R2 Z-5 back 10", "& HOLE", "& EndCycle", "TRAVERSE X3"]
    );
    assert_eq!(
        after_head("MCALL CYCLE81(10,0,2,-5)\nX3\nG0 Y4 F50\nMCALL\nX5\n"),
        ["CYCLE drill Xy R2 Z-5 back 10", "HOLE X3", "F50", "& HOLE Y4", "EndCycle", "TRAVERSE X5"]
    );
}

#[test]
fn other_moves_are_made_with_the_cycle_off() {
    let on = "& CYCLE drill Xy R2 Z-5 back 10";
    assert_eq!(
        after_head("MCALL CYCLE81(10,0,2,-5)\nX3 Z8\nG1 X4\nG0 A90\nSUPA X0\nG2 X5 I1\n"),
        [
            "CYCLE drill Xy R2 Z-5 back 10",
            "EndCycle",
            "& TRAVERSE X3 Z8",
            on,
            "& HOLE",
            "EndCycle",
            "& FEED! X4",
            on,
            "& HOLE",
            "EndCycle",
            "& TRAVERSE! A90deg",
            on,
            "& HOLE",
            "EndCycle",
            "& UseMachineCoordinates { length: true }",
            "& TRAVERSE X0",
            on,
            "& HOLE",
            "EndCycle",
            "& ARC! Xy Clockwise X5 I1",
            on,
            "& HOLE"
        ]
    );
}

#[test]
fn depths_and_planes() {
    assert_eq!(cycle("CYCLE81(10,1.5,1,,4.5)"), "CYCLE drill Xy R2.5 Z-3.0 back 10");
    assert_eq!(cycle("CYCLE82( 10, , 2, -7,, .3)"), "CYCLE drill-dwell dwell 0.3s Xy R2 Z-7 back 10");
    assert_eq!(cycle("CYCLE82(10,0,,-4.,,0)"), "CYCLE drill Xy R0 Z-4. back 10");
    assert_eq!(cycle("CYCLE81(10,+.5,0.25,-.75,)"), "CYCLE drill Xy R0.75 Z-0.75 back 10");
    assert_eq!(cycle("CYCLE81(10,0,2,-3,3)"), "CYCLE drill Xy R2 Z-3 back 10");
    assert_eq!(cycle("CYCLE81(10,0,2,0)"), "CYCLE drill Xy R2 Z0 back 10");
    assert_eq!(cycle("CYCLE81(10,0,2,-3,,0,0,0,10)"), "CYCLE drill Xy R2 Z-3 back 10");
}

#[test]
fn deep_holes() {
    let long = "CYCLE83(5,0,1,-42,,-8,,0,0.5,1,1,1)";
    assert_eq!(
        cycle(long),
        "CYCLE drill-peck 8 first 9 ahead 0.84 pause 0.5s settle 1s dwell 0.5s Xy R1 Z-42 back 5"
    );
    assert_eq!(
        cycle("CYCLE83(5,0,0,-12,,,8,0,,,,1,3,,,1.5,1.2)"),
        "CYCLE drill-peck 8 ahead 1.2 dwell 1.5s Xy R0 Z-12 back 5"
    );
    assert_eq!(
        cycle("CYCLE83(4,0,1,-15,,-4,,0,0,0,1,0)"),
        "CYCLE drill-break 4 first 5 lift 1 Xy R1 Z-15 back 4"
    );
    assert_eq!(
        cycle("CYCLE83(4,0,1,,12,,4,0,0.25,,1,0,,,0.4,0.75)"),
        "CYCLE drill-break 4 first 5 lift 0.4 pause 0.25s dwell 0.75s Xy R1 Z-12 back 4"
    );
    let text = HEAD.to_owned() + long + "\n" + long + "\nM30\n";
    assert_eq!(
        assumptions(&text),
        [
            "AssumedRow { code: 'CYCLE83', meaning: 'START_CYCLE' } at 'CYCLE83'".to_owned(),
            format!(
                "AssumedFact {{ fact: AutomaticClearance {{ name: '_DIS1', length: '0.84 mm' }} }} at '{long}'"
            )
        ]
    );
}

#[test]
fn reaming_takes_its_own_feeds_and_leaves_none() {
    assert_eq!(
        after_head("MCALL CYCLE85(5,0,2,-18,,0.5,70,140)\nX1\nF30\nX2\nMCALL\nG1 X3 F20\n"),
        [
            "CYCLE bore dwell 0.5s out 140 Xy R2 Z-18 back 5 F70",
            "HOLE X1",
            "F30",
            "CYCLE bore dwell 0.5s out 140 Xy R2 Z-18 back 5 F70",
            "& HOLE X2",
            "EndCycle",
            "F20",
            "& FEED! X3"
        ]
    );
    assert_eq!(cycle("CYCLE85(5,0,2,-18,,0,70,70.0)"), "CYCLE bore Xy R2 Z-18 back 5 F70");
    assert_eq!(faults("CYCLE85(5,0,2,-18,,0,70,140)\nG1 X3\n"), ["NoFeed at 'G1 X3'"]);
    assert_eq!(
        faults("CYCLE85(5,0,2,-18,,0,70,140)\nCYCLE81(5,0,2,-3)\n"),
        ["NoFeed at 'CYCLE81(5,0,2,-3)'"]
    );
    assert_eq!(
        faults("CYCLE85(5,0,2,-18)\n"),
        ["WordMissing { code: 'CYCLE85', word: 'FFR' } at 'CYCLE85(5,0,2,-18)'"]
    );
}

#[test]
fn cycles_that_are_none() {
    let one = |call: &str| faults(&format!("{call}\n")).remove(0);
    assert_eq!(one("CYCLE81(,0,2,-5)"), "WordMissing { code: 'CYCLE81', word: 'RTP' } at 'CYCLE81(,0,2,-5)'");
    assert_eq!(one("CYCLE81(5,0,2)"), "WordMissing { code: 'CYCLE81', word: 'DP' } at 'CYCLE81(5,0,2)'");
    assert_eq!(one("CYCLE81(5,6,2,-5)"), "OutOfRange { word: Word('RTP') } at '5'");
    assert_eq!(one("CYCLE81(5,5,2,,3)"), "OutOfRange { word: Word('RTP') } at '5'");
    assert_eq!(one("CYCLE81(5,0,-2,-3)"), "OutOfRange { word: Word('SDIS') } at '-2'");
    assert_eq!(one("CYCLE81(5,0,2,3)"), "CycleUpsideDown at 'CYCLE81(5,0,2,3)'");
    assert_eq!(
        one("CYCLE81(5,0,2,-3,4)"),
        "NotSupported { code: 'CYCLE81', what: Cycle(TwoDepths { first: 'DP', second: 'DPR' }) } at '4'"
    );
    assert_eq!(
        one("CYCLE81(5,0,2,-3,,2)"),
        "NotSupported { code: 'CYCLE81', what: Cycle(RefusedArgument { parameter: 'DTB', name: 'dwell at the bottom' }) } at '2'"
    );
    assert_eq!(one("CYCLE82(5,0,2,-3,,-2)"), "OutOfRange { word: Word('-2') } at '-2'");
    assert_eq!(
        one("CYCLE82(5,0,2,-3,,,,,11)"),
        "NotSupported { code: 'CYCLE82', what: Cycle(DepthMode { parameter: '_AMODE' }) } at '11'"
    );
    assert_eq!(
        one("CYCLE82(5,0,2,,3,,,,12)"),
        "NotSupported { code: 'CYCLE82', what: Cycle(DepthMode { parameter: '_AMODE' }) } at '12'"
    );
    assert_eq!(
        one("CYCLE82(5,0,2,-3,,,,,22)"),
        "NotSupported { code: 'CYCLE82', what: Cycle(DepthMode { parameter: '_AMODE' }) } at '22'"
    );
    assert_eq!(
        one("CYCLE82(5,0,2,-3,,,,2,12)"),
        "NotSupported { code: 'CYCLE82', what: Cycle(ArgumentPlane { parameter: '_DMODE' }) } at '2'"
    );
    assert_eq!(
        one("G18\nCYCLE82(5,0,2,-3,,,,2,12)\nCYCLE82(5,0,2,-3,,,,1,12)"),
        "NotSupported { code: 'CYCLE82', what: Cycle(ArgumentPlane { parameter: '_DMODE' }) } at '1'"
    );
    assert_eq!(
        one("CYCLE82(5,0,2,-3,,,,11,12)"),
        "NotSupported { code: 'CYCLE82', what: Cycle(DisplayMode { parameter: '_DMODE' }) } at '11'"
    );
    assert_eq!(
        one("CYCLE83(5,0,1,-20,,-8,,2,,,1,1)"),
        "NotSupported { code: 'CYCLE83', what: Cycle(RefusedArgument { parameter: 'DAM', name: 'degression of pecks' }) } at '2'"
    );
    assert_eq!(
        one("CYCLE83(5,0,1,-20,,-8,,,,,.5,1)"),
        "NotSupported { code: 'CYCLE83', what: Cycle(RefusedArgument { parameter: 'FRF', name: 'another feed for the first peck' }) } at '.5'"
    );
    assert_eq!(one("CYCLE83(5,0,1,-20,,-30)"), "OutOfRange { word: Word('FDEP') } at '-30'");
    assert_eq!(
        one("CYCLE83(5,0,1,-20,,,,,,,,1)"),
        "WordMissing { code: 'CYCLE83', word: 'FDEP' } at 'CYCLE83(5,0,1,-20,,,,,,,,1)'"
    );
    assert_eq!(one("CYCLE83(5,0,1,-20,,-8,,,,,,2)"), "OutOfRange { word: Word('VARI') } at '2'");
    assert_eq!(one("CYCLE81(10,0,R1,-5)"), "NotSupported { code: 'R1', what: Code(ComputedWord) } at 'R1'");
    assert_eq!(one("CYCLE81(5,0,2,-5,,,,,,7)"), "WordUnused { word: '7' } at '7'");
    assert_eq!(
        one("CYCLE84(5,0,2,-5)"),
        "WordMissing { code: 'CYCLE84', word: 'PIT' } at 'CYCLE84(5,0,2,-5)'"
    );
    assert_eq!(
        one("MCALL CYCLE830(5,0,2,-5)"),
        "NotSupported { code: 'CYCLE830', what: Code(Named { name: 'deep-hole drilling of the newer kind' }) } at 'CYCLE830(5,0,2,-5)'"
    );
    assert_eq!(
        one("G0 X5 CYCLE81(5,0,2,-5)"),
        "NotSupported { code: 'CYCLE81', what: Call(BesideWords) } at 'G0 X5 CYCLE81(5,0,2,-5)'"
    );
    assert_eq!(
        one("MCALL CYCLE81(5,0,2,-5)\nCYCLE81(5,0,2,-5)"),
        "NotSupported { code: 'CYCLE81', what: Cycle(InModalCycle) } at 'CYCLE81(5,0,2,-5)'"
    );
    assert_eq!(
        one("MCALL CYCLE81(5,0,2,-5)\nG18"),
        "NotSupported { code: 'G18', what: Move(PlaneInCycle) } at 'G18'"
    );
}

#[test]
fn a_cycle_needs_a_feed_when_it_makes_a_hole() {
    let head = "G710 G17 G90 G94 G54\nT1 M6 D1\nG0 X0 Y0 Z5\n";
    let errors = |piece: &str| {
        let text = head.to_owned() + piece;
        let all = diagnostics(&read(&text), text.as_bytes());
        all.into_iter().filter(|d| d.starts_with("NoFeed")).collect::<Vec<_>>()
    };
    assert_eq!(errors("MCALL CYCLE81(5,0,2,-5)\nX5\nM30\n"), ["NoFeed at 'X5'"]);
    assert_eq!(errors("MCALL CYCLE81(5,0,2,-5)\nX5 F9\nM30\n"), [] as [&str; 0]);
    assert_eq!(errors("MCALL CYCLE85(5,0,2,-5,,,7,7)\nX5\nM30\n"), [] as [&str; 0]);
}

#[test]
fn a_cycle_behind_a_switch_leaves_open_what_a_position_is() {
    assert_eq!(faults("/ MCALL CYCLE81(5,0,2,-5)\nX5\n"), ["EntryFactNeeded { fact: Motion } at 'X5'"]);
    assert_eq!(faults("/ MCALL CYCLE81(5,0,2,-5)\n/ X5\n/ MCALL\nX6\n"), [] as [&str; 0]);
}

#[test]
fn a_refused_cycle_is_refused_once() {
    let follow = "X10\nG1 X5\nHOLES2(0,0,5,0,0,3)\nL1\nF5\nMCALL\nX1\n";
    for call in ["CYCLE81(5,0,2)", "CYCLE84(5,0,2,-5)", "CYCLE81(5,0,2,-3,4)", "L70(R1)"] {
        assert_eq!(faults(&format!("MCALL {call}\n{follow}")).len(), 1, "{call}");
    }
}
