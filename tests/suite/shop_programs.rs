//! Programs of the kinds that shops have on a Sinumerik and a Haas: whole ones, small, each with what the output must hold
//! or what it is refused for.

use ncc_ir::diag::Fault;
use ncc_tests::expect::Failures;
use ncc_tests::translate::{job, stopping, translate};

/// One translation: from, option of it, to, lines separated by ` / `, what becomes of it.
type Case = (&'static str, &'static str, &'static str, &'static str, Right);

/// What is right.
enum Right {
    /// Verified, and these blocks follow one another in the output.
    Says(&'static str),
    /// Refused with this code, by a diagnostic of this line.
    Refused(u16, u32),
}

use Right::{Refused, Says};

/// Compensation switched on again in each turn of a loop.
const AGAIN: &str = "G17 G71 G90 G54 G40 / T1 M6 / D1 S3000 M3 F1000 / R1=10 / G0 X0 Y0 / Z5 / G1 Z-1 / \
                     WHILE R1<=12 / G1 G41 Y=R1 / G2 X0 Y=R1 I0 J=-R1 / R1=R1+1 / ENDWHILE / G1 G40 Y30 / G0 Z50 / M30";

const SINUMERIK: &[Case] = &[
    ("siemens", "", "fanuc", AGAIN, Refused(501, 9)),
    ("siemens", "", "siemens", AGAIN, Says("G1 G41 Y=R1")),
    // A Fanuc goes on along the contour there, LinuxCNC's interpreter refuses it, of a Haas nobody says what it does.
    ("siemens", "", "linuxcnc", AGAIN, Refused(501, 9)),
    ("siemens", "", "haas", AGAIN, Refused(501, 9)),
    (
        "fanuc",
        "",
        "linuxcnc",
        "% / O1 / G21 G17 G90 G54 G40 / T1 M6 / S1000 M3 / G0 X0 Y0 / G43 H1 Z5. / \
      G41 D1 G1 X10. F100. / Y10. / G41 D1 X20. / Y30. / G40 X40. / M30 / %",
        Refused(501, 10),
    ),
    (
        "linuxcnc",
        "",
        "fanuc",
        "G21 G17 G90 G54 G40 / T1 M6 / S1000 M3 / G0 X0 Y0 / G43 H1 Z5 / \
      G41 D1 G1 X10 F100 / Y10 / G41 D1 X20 / Y30 / G40 X40 / M2",
        Refused(226, 8),
    ),
    // The block that goes nowhere is named, not the one after it.
    (
        "siemens",
        "",
        "fanuc",
        "G17 G71 G90 G54 G40 / T1 M6 / D1 S3000 M3 F100 / G0 X0 Y0 Z5 / G1 G41 X10 / X10 / Y20 / \
      G40 X0 / M30",
        Refused(501, 6),
    ),
];

const CYCLES: &[Case] = &[
    (
        "siemens",
        "",
        "fanuc",
        "G17 G71 G90 G54 G40 / T1 M6 / D1 S3000 M3 F100 / G0 X0 Y0 Z50 / MCALL CYCLE81(50,0,2,-5) / \
      CYCLE801(12,12,0,20,30,4,3,1) / MCALL / M30",
        Says(
            "G98 G81 X12. Y12. Z-5. R2. / X32. / X52. / X72. / Y42. / Y72. / X52. / X32. / X12. / Y42. / G80",
        ),
    ),
    // Two rows are all border; the grid stays one.
    (
        "siemens",
        "",
        "siemens",
        "G17 G71 G90 G54 G40 / T1 M6 / D1 S3000 M3 F100 / G0 X12 Y12 Z50 / MCALL CYCLE81(50,0,2,-5) / \
      CYCLE801(12,12,0,156,142,2,2,1,0,0,0,,,1) / MCALL / M30",
        Says("CYCLE801(12,12,0,156,142,2,2)"),
    ),
    (
        "siemens",
        "",
        "fanuc",
        "G17 G71 G90 G54 G40 / T1 M6 / D1 S3000 M3 F100 / G0 X0 Y0 Z50 / MCALL CYCLE81(50,0,2,-5) / \
      CYCLE801(12,12,0,20,30,4,3,2) / MCALL / M30",
        Refused(202, 6),
    ),
    (
        "siemens",
        "",
        "fanuc",
        "G17 G71 G90 G54 G40 / T1 M6 / D1 S3000 M3 F100 / TOFFL=0 / OFFN=0 TOFFR=0 / G0 X1 Y2 Z50 / M30",
        Says("G00 G43 H1 X1. Y2. Z50."),
    ),
    (
        "siemens",
        "",
        "fanuc",
        "G17 G71 G90 G54 G40 / T1 M6 / D1 S3000 M3 F100 / TOFFL=0.1 / G0 X1 Y2 Z50 / M30",
        Refused(202, 4),
    ),
    (
        "siemens",
        "",
        "fanuc",
        "%_N_MAIN_MPF / G17 G71 G90 G54 G40 / T1 M6 / D1 S3000 M3 F100 / G0 X1 Y2 Z50 / \
      EXTCALL \"/_N_SPF_DIR/_N_A_B_SPF\" / EXTCALL \"C:\\\\jobs\\\\a b.spf\" / M30 / %_N_A_B_SPF / G1 X3 / M17",
        Says("M98 P1001 / M98 P1001 / M30 / O1001 (A_B) / G01 X3. / M99"),
    ),
];

const FEEDS: &[Case] = &[
    (
        "haas",
        "integer-feed",
        "fanuc",
        "% / O1 / G21 G17 G90 G54 G40 G49 G80 / T1 M6 / S1000 M3 / G0 X0. Y0. / G43 H1 Z5. / \
      G1 X10. F200 / M30 / %",
        Says("G01 X10. F200."),
    ),
    (
        "haas",
        "increment",
        "fanuc",
        "% / O1 / G21 G17 G90 G54 G40 G49 G80 / T1 M6 / S1000 M3 / G0 X0. Y0. / G43 H1 Z5. / \
      G1 X10. F200 / M30 / %",
        Says("G01 X10. F0.2"),
    ),
    // Lengths stay least increments.
    (
        "haas",
        "integer-feed",
        "fanuc",
        "% / O1 / G21 G17 G90 G54 G40 G49 G80 / T1 M6 / S1000 M3 / G0 X0. Y0. / G43 H1 Z5. / \
      G1 X10000 F200 / M30 / %",
        Says("G01 X10.000 F200."),
    ),
    (
        "haas",
        "integer-feed",
        "fanuc",
        "% / O1 / G21 G17 G90 G54 G40 G49 G80 / T1 M6 / S1000 M3 / G0 X0. Y0. / G43 H1 Z5. / \
      G95 G1 X10. F1 / M30 / %",
        Refused(202, 8),
    ),
];

/// What a reader of the output would stumble over.
const OUTPUTS: &[Case] = &[
    // M05 that the optional stop has written is not written again.
    (
        "haas",
        "",
        "siemens",
        "% / O1 / G21 G17 G90 G54 G40 G49 G80 / T1 M6 / S1000 M3 / G0 X0. Y0. / G43 H1 Z5. / M1 / M5 / S2000 M3 / \
         G1 X5. F100. / M30 / %",
        Says("M5 / M1 / S2000 M3 / G1 X5 F100"),
    ),
    (
        "haas",
        "",
        "siemens",
        "% / O1 / G21 G17 G90 G54 G40 G49 G80 / T1 M6 / S1000 M3 / G0 X0. Y0. / G43 H1 Z5. / M1 / S2000 M3 / G0 X1. / M5 / \
         G0 X5. / M30 / %",
        Says("M5 / M1 / S2000 M3 / G0 X1 / M5 / G0 X5"),
    ),
    // The length that counts after a tool change stands after it.
    (
        "siemens",
        "",
        "linuxcnc",
        "G17 G71 G90 G54 G40 / T1 D1 M6 / S1000 M3 / G0 X0 Z5 / M30",
        Says("T1 M6 / G43 H1 / S1000 M3"),
    ),
    // About a tenth is not less than nothing.
    (
        "siemens",
        "",
        "fanuc",
        "G17 G71 G90 G54 G40 / T1 D1 M6 / S1000 M3 ; ~0.1 deep / G0 X0 Z5 / M30",
        Says("S1000 M03 ( 0.1 DEEP)"),
    ),
];

fn run(cases: &[Case]) {
    let mut failures = Failures::default();
    for (from, points, to, lines, right) in cases {
        let mut job = job(from, to, "part");
        if !points.is_empty() {
            job.from.choose("decimal_point", points).expect("an option of the dialect");
        }
        job.head = false;
        job.layout.numbering = ncc_backends::Numbering::Off;
        let source = format!("{}\n", lines.replace(" / ", "\n"));
        let (outcome, written) = translate(&job, source.as_bytes());
        let text = String::from_utf8_lossy(&written).replace("\r\n", "\n");
        let text = text.lines().filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" / ");
        let name = format!("{from} to {to}: {lines}");
        let line =
            |at: u32| source.as_bytes()[..at as usize].iter().filter(|b| **b == b'\n').count() as u32 + 1;
        let codes = stopping(&job, &outcome);
        match right {
            Says(words) if text.contains(words) => {}
            Says(_) => failures.add(&name, format!("says {text}, {codes:?}")),
            Refused(code, at) => {
                let found = outcome.diagnostics.iter().any(|d| {
                    d.fault.code() == *code
                        && line(d.span.start) == *at
                        && !matches!(d.fault, Fault::AssumedMode { .. })
                });
                if !found || !written.is_empty() {
                    failures.add(&name, format!("is refused with {codes:?}, or says {text}"));
                }
            }
        }
    }
    failures.finish();
}

#[test]
fn contours_begun_again() {
    run(SINUMERIK);
}

#[test]
fn frames_of_holes_and_words_that_say_nothing() {
    run(CYCLES);
}

#[test]
fn feeds_in_whole_units() {
    run(FEEDS);
}

#[test]
fn outputs_as_a_reader_wants_them() {
    run(OUTPUTS);
}

/// A spindle that is started with S0 does not turn.
#[test]
fn cuts_with_a_speed_of_nothing() {
    for (speed, noted) in [("S0 M3", true), ("S1000 M3 / S0", true), ("S0 M3 / S1000", false), ("M3", false)]
    {
        let source = format!("G17 G71 G90 G54 G40 / T1 D1 M6 / G0 X0 Y0 Z5 / {speed} / G1 X5 F100 / M30\n");
        let mut job = job("siemens", "fanuc", "part");
        job.head = false;
        let (outcome, written) = translate(&job, source.replace(" / ", "\n").as_bytes());
        let found = outcome.diagnostics.iter().any(|d| matches!(d.fault, Fault::CutStanding));
        assert!(found == noted && !written.is_empty(), "{speed}: {:?}", outcome.diagnostics);
    }
}
