//! The second interpreter on Sinumerik text: it runs the corpus, it reads what is hard to read, and
//! it stops where the reference notes leave a question open.

use ncc_tests::corpus;
use ncc_tests::expect::Failures;
use ncc_tests::interpreter::{Setup, What};
use ncc_tests::plain::{self, Tolerance};

/// Every program runs to its end, moves, and has no arc that misses its end point.
#[test]
fn runs_the_corpus() {
    let mut failures = Failures::default();
    let programs = corpus::of("siemens");
    assert!(programs.len() >= 30);
    for program in programs {
        for (seed, skip) in [(0, 0), (1, 0x3fe), (2, 0b10), (2, 0x7fe)] {
            let world = plain::world(seed);
            let what = format!("{} world {seed} skip {skip:x}", program.file);
            let run = plain::second("siemens", &program.text, plain::setup(&world, skip));
            let Some(machine) = failures.check(&what, run) else { continue };
            let ends = machine
                .events
                .last()
                .is_some_and(|e| matches!(e.what, What::End | What::BeginsAgain | What::TextEnd));
            let moves =
                machine.events.iter().filter(|e| matches!(e.what, What::Traverse | What::Feed)).count();
            if !ends || moves < 3 {
                failures.add(&what, "no end, or hardly a move");
            }
            let mut from = world.start.map(|n| n as f64 / 1e9);
            for event in &machine.events {
                if let What::Arc { normal, centre, .. } = event.what {
                    let (first, second) = [(1, 2), (2, 0), (0, 1)][normal];
                    let radius =
                        |at: [f64; 6]| (at[first] - centre[first]).hypot(at[second] - centre[second]);
                    if (radius(from) - radius(event.machine)).abs() > 0.005 {
                        failures.add(&what, format!("line {}: the arc misses its end point", event.line));
                    }
                }
                from = event.machine;
            }
        }
    }
    failures.finish();
}

/// Text that says the same in another way.
const SAME: &[(&str, &str)] = &[
    ("N10G1X10Y20F100", "N10 G1 X10 Y20 F100"),
    ("G01 Z-5 F100 M8\nG4F1", "G1 Z-5 F100 M08\nG4 F1.0"),
    ("g1 x=10 y = -.5 f 100", "G1 X10. Y-0.5 F100"),
    ("G1 X1EX1 Y-.1EX+2 F100", "G1 X10 Y-10 F100"),
    ("G1 F100\nNEXT: X10\nREPEAT NEXT", "G1 F100\nX10"),
    ("G1 F100\nN_A: X10\nN20 LAB1:Y5", "G1 F100\nX10\nY5"),
    (":10 G1 X10 F100\nN010 Y1", "G1 X10 F100\nY1"),
    ("MSG(\"a; b\") ; c\nG1 X10 F100 ;Y5", "MSG(\"shown\")\nG1 X10 F100"),
    ("G2 X10 CR= 5 F100", "G2 X10 CR=5 F100"),
    ("R1=2\nR1=0/R1\nG1 X=R1 F100", "G1 X0 F100"),
    ("G91 G1 X10 F100\nX=AC(5) Y2", "G90 G1 X10 F100\nX5 Y2"),
    ("T5\nM6\nG0 Z5", "T=5 M6 D1\nG0 Z5"),
    ("T5 M6 D2\nG0 Z5", "T5 M6\nD2\nG0 Z5"),
    ("G54\nTRANS X5\nROT RPL=30\nG0 X10", "G54\nROT Z30\nG0 X10"),
    ("ROT RPL=30\nTRANS\nG0 X10", "G0 X10"),
    ("G0 Z5\nTRANS X5 Y1\nAROT RPL=30\nG91 Z3", "G0 Z5\nZ8"),
    ("G0 X5\nTRANS Y1\nAMIRROR Z0\nG91 X3", "G0 X5\nX8"),
    ("G18\nROT RPL=30\nG0 X10 Z5", "G18\nROT Y30\nG0 X10 Z5"),
    ("TRANS X3\nG0 X2\nSUPA X7\nX2", "G0 X5\nG54\nG53 X7\nG54 X5"),
    ("G506 G0 X1 Y1\nG500\nX0 Y0", "G506\nG0 X1 Y1\nG500 X0 Y0"),
    ("%_N_A_SPF\nX9\nM17\n%_N_B_MPF\nG0 X1\nA_1\nM30\n%_N_A_1_SPF\nX2\nRET", "G0 X1\nX2\nM30"),
    ("G0 X1\nM17", "G0 X1\nM30"),
    ("G0\nF50\nMCALL CYCLE82(9,0,1,-2,,0)\nX1\nMCALL", "G0\nF50\nMCALL CYCLE81(9,0,1,,2)\nX1\nMCALL"),
    (
        "G17\nF50\nG0\nMCALL CYCLE81(9,0,1,-2)\nHOLES1(1,2,0,0,5,2)",
        "F50\nG0\nMCALL CYCLE81(9,,1.,-2)\nX1 Y2\nX6",
    ),
    ("/2 G0 X1\n/G0 X2", "/2 G0 X1\n/0 G0 X2"),
];

#[test]
fn reads_what_is_hard_to_read() {
    let mut failures = Failures::default();
    for (a, b) in SAME {
        for (seed, skip) in [(0, 0), (1, 0), (2, 0b10), (1, 0b100)] {
            let world = plain::world(seed);
            let start = world.start.map(|n| n as f64 / 1e9);
            let list = |text: &str| {
                // From a place that the program names, so that arcs do not depend on the start.
                let text = if text.contains("MPF") {
                    text.to_owned()
                } else {
                    format!("G90 G54 G0 X0 Y0 Z0\n{text}")
                };
                let text = text.replace("_MPF\n", "_MPF\nG90 G54 G0 X0 Y0 Z0\n");
                let machine = plain::second("siemens", text.as_bytes(), plain::setup(&world, skip))?;
                Ok::<_, String>(plain::of_machine(&machine, start))
            };
            let result = list(a).and_then(|a| plain::compare(&a, &list(b)?, Tolerance::SAME));
            failures.check(format!("{a}\nworld {seed} skip {skip:b}"), result);
        }
    }
    failures.finish();
}

/// Programs that it must not run, and a word of the reason.
const STOPS: &[(&str, &str)] = &[
    ("X10", "no code"),
    ("G1 X10", "no F"),
    ("G1 X10 F100\nG700 X1", "no F"),
    ("G0 X10 M5", "M5 or M9"),
    ("G54\nG91 G0 X0\nG55\nX1", "incremental"),
    ("G91\nTRANS X1\nG0 X1", "incremental"),
    ("G0 X1 Y1 Z1\nROT RPL=30\nG91 Y1", "incremental"),
    ("G0 X1 Y1 Z1\nMIRROR Z0\nG91 Z1", "incremental"),
    ("G0 X1 Y1 Z1\nTRANS Z5\nROT RPL=30\nG91 Z1", "incremental"),
    ("G0 SUPA X=IC(1)", "incremental"),
    ("G2 X10 F100", "too few"),
    ("G2 X10 I5 CR=5 F100", "too few words or too many"),
    ("G2 X10 CR=4 F100", "does not reach"),
    ("G2 CR=4 F100", "too few"),
    ("G2 X10 I5 AR=90 F100", "too few"),
    ("G2 X10 I4 F100", "radius"),
    ("G3 X10 AR=360 F100", "AR="),
    ("CIP X10 I1=5 F100", "line"),
    ("CIP X10 Y5 I1=5 F100", "not said whole"),
    ("CIP X10 Y5 Z5 I1=5 J1=8 K1=1 F100", "no plane"),
    ("G1 Z5 F100\nCT X10", "no move at feed"),
    ("G0 X5\nCT X10 Y5 F100", "no move at feed"),
    ("G1 X5 F100\nCT X2", "straight back"),
    ("ROT X30", "out of the plane"),
    ("TRANS X1 G0", "TRANS and G"),
    ("SCALE X2\nG2 X10 I5 F100", "ellipse"),
    ("ROT RPL=10\nG18 G2 X10 I5 F100", "out of its plane"),
    ("G0 G1 X5", "two codes"),
    ("X5 X6", "twice"),
    ("G41 X5", "no radius"),
    ("G962 S100", "G962"),
    ("G0 X=R1", "before it is set"),
    ("X1=5", "X1"),
    ("F=\"FAST\"", "F with a text"),
    ("M2=3", "M2"),
    ("NOWHERE", "no subprogram"),
    ("RET", "main program"),
    ("REPEAT AA", "no label"),
    ("A1: G0 X1\nREPEAT A1", "unexpected"),
    ("AA: G0 X1\nAA: X2\nREPEAT AA", "several"),
    ("AA: G0 X1\nREPEAT AA BB\nBB: X2", "itself"),
    ("HOLES1(0,0,0,0,5,2)", "no cycle in force"),
    ("MCALL CYCLE81(5,0,1)", "DP and DPR"),
    ("MCALL CYCLE81(5,0,1,-3,3)", "DP and DPR"),
    ("MCALL CYCLE81(5,5,1,,3)", "61101"),
    ("MCALL CYCLE81(5,6,1,0)", "61101"),
    ("MCALL CYCLE81(5,0,1,2)", "61101"),
    ("MCALL CYCLE82(5,0,1,-2,,-3)", "revolutions"),
    ("MCALL CYCLE83(5,0,1,-9,,-3,,1,0,0,1,1)", "DAM"),
    ("MCALL CYCLE83(5,0,1,-9,,-3,,0,0,0,.5,1)", "FRF"),
    ("MCALL CYCLE83(5,0,1,-9,,-13,,0,0,0,1,1)", "61107"),
    ("MCALL CYCLE84(5,0,1,-9)", "CYCLE84 without"),
    ("MCALL CYCLE85(5,0,1,-9)", "FFR"),
    ("F50 G0\nCYCLE85(5,0,1,-9,,,50,50)\nG1 X5", "no F"),
    ("F50 G0\nMCALL CYCLE81(5,0,1,-9)\nG18\nX5", "another plane"),
    ("F50 G0\nMCALL CYCLE81(5,0,1,-9)\nG70\nX5", "unit"),
    ("F50 G0\nMCALL CYCLE81(5,0,1,-9)\nCYCLE801(0,0,0,5,5,2,2,2)", "appended"),
    ("F50 G0\nMCALL CYCLE81(5,0,1,-9)\nCYCLE802(211111111,111111111,1,1)", "absolute"),
];

#[test]
fn stops_where_it_would_have_to_choose() {
    let mut failures = Failures::default();
    for (text, why) in STOPS {
        match plain::second("siemens", text.as_bytes(), Setup::plain()) {
            Ok(_) => failures.add(*text, "it ran"),
            Err(said) if said.contains(why) => {}
            Err(said) => failures.add(*text, format!("{said}, not {why}")),
        }
    }
    failures.finish();
}
