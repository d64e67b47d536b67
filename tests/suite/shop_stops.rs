//! What stops, tool changes, ends and places of the machine do besides their names, in both directions: small programs of
//! the kinds that shops have, each with what the output must hold and what is reported, or with what it is refused for.

use std::collections::BTreeSet;

use ncc_ir::behaviour::Behaviour;
use ncc_ir::diag::Fault;
use ncc_tests::expect::Failures;
use ncc_tests::translate::{job, stopping, translate};

/// One translation.
struct Case {
    /// From, to.
    pair: (&'static str, &'static str),
    /// Options of the source, of the target.
    options: [&'static [(&'static str, &'static str)]; 2],
    /// Blocks after the head, separated by ` / `.
    blocks: &'static str,
    /// Blocks that follow one another in the output; nothing where it is refused.
    says: &'static str,
    /// Codes of messages that must be among those reported, or that refuse it.
    told: &'static [u16],
}

const fn case(
    from: &'static str,
    to: &'static str,
    blocks: &'static str,
    says: &'static str,
    told: &'static [u16],
) -> Case {
    Case { pair: (from, to), options: [&[], &[]], blocks, says, told }
}

const fn stated(case: Case, from: &'static [(&str, &str)], to: &'static [(&str, &str)]) -> Case {
    Case { options: [from, to], ..case }
}

const HEAD: &str = "G21 G17 G90 G94 G54 G40 G49 G80 / T1 M06 / S1000 M03 / G00 X0. Y0. / G43 H1 Z10. / ";
const HEAD_S: &str = "G710 G17 G90 G94 G54 G40 / T1 M6 / D1 / S1000 M3 / G0 X0 Y0 / Z10 / ";

const CUT: &str = "M08 / G01 Z-1. F100. / M00 / G01 X20.";

/// A program stop: it stops the spindle on a Haas, does not on LinuxCNC, and is the builder's elsewhere.
const STOPS: &[Case] = &[
    case("fanuc", "haas", CUT, "M00 / M03 / M08 / G01 X20.", &[322, 323]),
    case("linuxcnc", "haas", CUT, "M00 / M03 / M08 / G01 X20.", &[322]),
    case("linuxcnc", "fanuc", CUT, "M00 / M03 / M08 / G01 X20.", &[322]),
    case("linuxcnc", "siemens", CUT, "M0 / M3 M8 / G1 X20", &[322]),
    case("siemens", "haas", "M8 / G1 Z-1 F100 / M0 / G1 X20", "M00 / M03 / M08 / G01 X20.", &[322, 323]),
    case("haas", "fanuc", CUT, "M05 / M09 / M00 / G01 X20.", &[426]),
    case("haas", "siemens", CUT, "M5 M9 / M0 / G1 X20", &[426]),
    case("haas", "linuxcnc", CUT, "M5 M9 / M0 / G1 X20", &[426]),
    // Nothing is added where the program says it, or where nothing is cut.
    case("fanuc", "haas", "G01 Z-1. F100. / M00 / S900 M03 / X20.", "M00 / S900 M03 / X20.", &[]),
    case("linuxcnc", "haas", "G01 Z-1. F100. / G00 Z50. / M00 / X20.", "M00 / X20. / M30", &[]),
    case("haas", "fanuc", "G01 Z-1. F100. / M05 / M00 / S900 M03 / X20.", "M05 / M00 / S900 M03", &[]),
    // Both controls leave it to the builder.
    case("fanuc", "siemens", CUT, "M0 / G1 X20", &[323]),
    stated(
        case("fanuc", "siemens", CUT, "M0 / M3 / G1 X20", &[322]),
        &[("spindle_at_stop", "does-not"), ("coolant_at_stop", "does-not")],
        &[("spindle_at_stop", "stops"), ("coolant_at_stop", "does-not")],
    ),
    stated(
        case("haas", "fanuc", CUT, "G01 Z-1. F100. / M00 / G01 X20.", &[]),
        &[],
        &[("spindle_at_stop", "stops"), ("coolant_at_stop", "stops")],
    ),
    // A stop that the block-skip switch leaves out stops nothing.
    case("haas", "fanuc", "G01 Z-1. F100. / /M00 / X20.", "/M05 / /M00 / X20. / M05 / M30", &[426]),
    case("haas", "siemens", "M08 / G01 Z-1. F100. / /M00 / X20.", "/M5 M9 / /M0 / X20 / M5 M9 / M30", &[426]),
    // On a path that not every run takes, and in a program whose variables are set elsewhere.
    case(
        "fanuc",
        "siemens",
        "G01 Z-1. F100. / IF [#500 NE 7.] GOTO 5 / M00 / G01 X20. / N5 G00 Z10.",
        "M0 / G1 X20",
        &[323],
    ),
    case("fanuc", "haas", "G01 Z-1. F100. X#24 / M00 / G01 X20.", "M00 / M03 / G01 X20.", &[322, 323]),
    case(
        "siemens",
        "fanuc",
        "G1 Z-1 F100 / IF R5==7 GOTOF ON / GOTOF OFF / ON: M0 / G1 X20 / OFF: G0 Z10",
        "M00",
        &[323],
    ),
    // An optional stop, which may not be made.
    case("haas", "fanuc", "G01 Z-1. F100. / M01 / X20.", "M05 / M01 / M03 / X20.", &[322, 325, 426]),
    case("linuxcnc", "haas", "G01 Z-1. F100. / M01 / X20.", "M01 / M03 / X20.", &[322]),
];

const CHANGE: &str = "G01 Z-1. F100. / G00 Z0.1 / T2 M06 / S2000 M03 / G00 X5. Y0. / G43 H2 Z5. / G01 Z-1.";

/// A tool change: a Haas stops the spindle and takes Z to machine zero first.
const CHANGES: &[Case] = &[
    case("haas", "fanuc", CHANGE, "M05 / G91 G28 Z0. / T2 M06 / S2000 M03 / G90 G00 X5. Y0.", &[426]),
    case("haas", "siemens", CHANGE, "M5 / SUPA G0 Z0 D0 / T2 M6 / D1 / S2000 M3 / G0 X5 Y0", &[426]),
    case("haas", "linuxcnc", CHANGE, "M5 / G53 G0 Z0 / T2 M6 / S2000 M3 / G0 X5 Y0", &[426]),
    stated(
        case("haas", "fanuc", CHANGE, "G00 Z0.1 / M05 / T2 M06", &[426]),
        &[],
        &[("z_at_change", "machine-zero")],
    ),
    // Z is up there already.
    case(
        "haas",
        "fanuc",
        "G01 Z-1. F100. / M05 / G91 G28 Z0. / G90 / T2 M06 / S2000 M03 / G43 H2 Z5.",
        "G28 Z0. / G90 / T2 M06",
        &[],
    ),
    case(
        "linuxcnc",
        "haas",
        "G1 Z-1 F100 / M5 / G0 Z5 / T2 M6 / S900 M3 / G0 X5 / G43 H2 Z5 / G1 Z-1",
        "T2 M06 / S900 M03 / G00 X5.",
        &[324],
    ),
    // The cut would have no spindle, or begin at another Z.
    case("fanuc", "haas", "G01 Z-1. F100. / G00 Z5. / T2 M06 / G43 H2 Z10. / G01 X20.", "", &[501]),
    case("linuxcnc", "haas", "G1 Z-1 F100 / M5 / T2 M6 / S900 M3 / G0 X5 / G1 X20", "", &[508]),
    case(
        "linuxcnc",
        "fanuc",
        "G1 Z-1 F100 / G0 Z5 / T2 M6 / S900 M3 / G43 H2 Z5 / G1 Z-1",
        "M05 / T2 M06 / S900 M03",
        &[426],
    ),
];

/// A Haas goes up at M06. A Mach-9 and a list of events have no words for that: only what needs no Z is the same.
const WAYS_UP: &[Case] = &[
    case("haas", "mach9", "G01 Z-1. F100. / G00 Z9. / T2 M06 / S900 M03 / G01 X20.", "", &[501]),
    case("haas", "canon", "G01 Z-1. F100. / G00 Z9. / T2 M06 / S900 M03 / G00 X5. / G01 X20.", "", &[501]),
    case("haas", "canon", "G01 Z-1. F100. / T2 M06 / S900 M03 / G91 X5. / G90 G00 Z9.", "", &[501]),
    case("haas", "canon", "G00 Z9. / T2 M06 / S900 M03 / /G43 H2 Z10. / G01 X20. F100.", "", &[501]),
    // A change with its own way up.
    stated(
        case(
            "haas",
            "mach9",
            "G00 Z9. / T2 M06 / S900 M03 / G01 X20. F100.",
            "T2M6 / S900M3 / G1X20.F100",
            &[426],
        ),
        &[],
        &[("z_at_change", "machine-zero")],
    ),
    // Rapid moves in the plane, and Z by an absolute word.
    case(
        "haas",
        "mach9",
        "G00 Z9. / T2 M06 / S900 M03 / G00 X5. / G43 H2 Z8. / G01 X20. F100.",
        "T2M6 / S900M3 / G0X5. / O2Z8. / G1X20.F100",
        &[323, 426],
    ),
    case(
        "haas",
        "canon",
        "G00 Z9. / T2 M06 / S900 M03 / G00 X5. / G43 H2 Z8. / G01 X20. F100.",
        "STRAIGHT_TRAVERSE(5.0, 0.0, 8.0) / SET_FEED_RATE(100.0) / STRAIGHT_FEED(20.0, 0.0, 8.0)",
        &[426],
    ),
];

/// The end of a program stops spindle and coolant on LinuxCNC and on a Haas, and is the builder's elsewhere.
const ENDS: &[Case] = &[
    case("linuxcnc", "fanuc", "M08 / G01 Z-1. F100.", "M05 / M09 / M30", &[426]),
    case("haas", "siemens", "M08 / G01 Z-1. F100.", "M5 M9 / M30", &[426]),
    case("linuxcnc", "haas", "M08 / G01 Z-1. F100.", "Z-1. F100. / M30", &[]),
    case("fanuc", "linuxcnc", "M08 / G01 Z-1. F100.", "Z-1 F100 / M2", &[]),
];

/// A local shift that is still in force at the end: a Sinumerik drops it, LinuxCNC keeps it for the next program.
const SHIFTS: &[Case] = &[
    case("siemens", "linuxcnc", "TRANS X10 / G1 X5 F100 / G0 Z100", "G0 Z100 / G52 X0 / M2", &[426]),
    case("siemens", "fanuc", "TRANS X10 / G1 X5 F100 / G0 Z100", "G52 X0. / M30", &[426]),
    case("fanuc", "linuxcnc", "G52 X5. Y5. / G01 X10. F100.", "G52 X0 Y0 / M2", &[426]),
    case("fanuc", "linuxcnc", "G52 X5. Y5. / G01 X10. F100. / G52 X0. Y0.", "G52 X0 Y0 / M2", &[]),
    case("linuxcnc", "fanuc", "G52 X5 Y5 / G1 X10 F100", "X10. F100. / M05 / M30", &[426]),
];

const TURNS: &str = "G95 G01 Z-1. F0.1 / G04 X2. / G94 X5. F100.";

/// A dwell under a feed per revolution: seconds, or turns by a Fanuc's parameter.
const DWELLS: &[Case] = &[
    case("fanuc", "linuxcnc", TURNS, "G4 P2", &[323]),
    case("fanuc", "siemens", TURNS, "G4 F2", &[323]),
    case("linuxcnc", "fanuc", "G95 G1 Z-1 F0.1 / G4 P2 / G94 X5 F100", "G04 X2.", &[323]),
    stated(case("fanuc", "linuxcnc", TURNS, "G4 P2", &[]), &[("dwell_per_revolution", "seconds")], &[]),
    case("fanuc", "linuxcnc", "G01 Z-1. F100. / G04 X2.", "G4 P2", &[]),
];

const HOME: &str = "G01 Z-1. F100. / G91 G28 Z0. / G90 G00 X50. / Z10. / G01 Z-1.";
const PLACE: &str = "G01 Z-1. F100. / G53 G00 Z0. / G00 X50. / Z10. / G01 Z-1.";

/// The length of the tool after a place of the machine.
const LENGTHS: &[Case] = &[
    case("fanuc", "haas", HOME, "", &[509]),
    stated(
        case("fanuc", "haas", HOME, "X50. / G43 H1 Z10. / G01", &[]),
        &[("length_after_return", "returns")],
        &[],
    ),
    stated(
        case("fanuc", "linuxcnc", HOME, "X50 / Z10 / G1 Z-1", &[]),
        &[("length_after_return", "returns")],
        &[],
    ),
    stated(
        case("fanuc", "linuxcnc", HOME, "X50 / G49 Z10 / G1 Z-1", &[]),
        &[("length_after_return", "cancelled")],
        &[],
    ),
    case("haas", "fanuc", HOME, "X50. / G49 Z10. / G01", &[]),
    case("linuxcnc", "fanuc", PLACE, "G53 G00 Z0. / G00 X50. / G43 H1 Z10. / G01", &[]),
    case("haas", "fanuc", PLACE, "G53 G00 Z0. / G00 X50. / G43 H1 Z10. / G01", &[]),
    case("fanuc", "haas", PLACE, "", &[509]),
    // A block that the switch leaves out calls no length up, and does not move Z with it.
    case(
        "linuxcnc",
        "fanuc",
        "G1 Z-1 F100 / G53 G0 Z0 / /G43 H1 Z20 / G0 Z10 / G1 Z-1",
        "/G43 H1 Z20. / G00 G43 H1 Z10. / G01",
        &[],
    ),
    case(
        "haas",
        "fanuc",
        "G01 Z-1. F100. / G53 G00 Z0. / /G00 Z20. / G00 Z10. / G01 Z-1.",
        "/G00 G43 H1 Z20. / G00 G43 H1 Z10. / G01",
        &[],
    ),
    // Where paths join: after a decision, in both its bodies, and in a loop that begins again.
    case(
        "linuxcnc",
        "fanuc",
        "G1 Z-1 F100 / o1 if [#100 EQ 7] / G53 G0 Z0 / o1 endif / G0 Z10 / G1 Z-1",
        "G53 G00 Z0. / N10 / G00 G43 H1 Z10. / G01",
        &[],
    ),
    case(
        "linuxcnc",
        "fanuc",
        "G1 Z-1 F100 / G53 G0 Z0 / o1 if [#5 LT 2] / G0 X50 Z10 / o1 else / G0 Z20 / o1 endif / G1 Z-1",
        "G00 G43 H1 X50. Z10. / GOTO 20 / N10 / G00 G43 H1 Z20. / N20",
        &[],
    ),
    case(
        "linuxcnc",
        "fanuc",
        "#1=0 / o1 while [#1 LT 2] / G0 Z10 / G1 Z-1 F100 / G53 G0 Z0 / #1=[#1+1] / o1 endwhile / G0 Z20",
        "G00 G43 H1 Z10. / G01 Z-1. F100. / G53 G00 Z0. / #1 = #1 + 1 / END1 / G00 G43 H1 Z20.",
        &[],
    ),
    case(
        "haas",
        "linuxcnc",
        "#1=0 / WHILE [#1 LT 2] DO1 / G00 Z10. / G01 Z-1. F100. / G91 G28 Z0. / G90 / #1=#1+1 / END1",
        "",
        &[501],
    ),
    stated(
        case(
            "fanuc",
            "haas",
            "#1=0 / WHILE [#1 LT 2] DO1 / G00 Z10. / G01 Z-1. F100. / G91 G28 Z0. / G90 / #1=#1+1 / END1",
            "DO1 / G00 G43 H1 Z10. / G01 Z-1. F100.",
            &[],
        ),
        &[("length_after_return", "returns")],
        &[],
    ),
    case(
        "fanuc",
        "haas",
        "#1=0 / WHILE [#1 LT 2] DO1 / G00 Z10. / G01 Z-1. F100. / G91 G28 Z0. / G90 / #1=#1+1 / END1",
        "",
        &[509],
    ),
    // It is called up again anyhow.
    case(
        "fanuc",
        "haas",
        "G01 Z-1. F100. / G91 G28 Z0. / G90 G43 H1 G00 Z10.",
        "G28 Z0. / G90 G00 G43 H1 Z10.",
        &[],
    ),
];

/// What F counts where a rotary axis turns in a cut: open on a Siemens, which is told in a loop as well.
const ROTARY_FEEDS: &[Case] = &[
    case("siemens", "linuxcnc", "G0 A0 / G1 Z-1 F100 / X40 A30", "X40 A30", &[323]),
    case(
        "siemens",
        "linuxcnc",
        "G0 A0 / R1=0 / WHILE R1<2 / G91 G1 X40 A30 F100 / G90 / R1=R1+1 / ENDWHILE",
        "G91 G1 X40 A30",
        &[323],
    ),
    case("siemens", "linuxcnc", "G0 A0 / G1 Z-1 F100 / G0 X40 A30", "G0 X40 A30", &[]),
];

const PRESELECTED: &str =
    "M05 / G00 Z50. / T2 / M06 T3 / S900 M03 / G00 X5. Y0. / G43 H3 Z10. / G01 Z-1. F100.";

/// A T in the block of M06 while another tool waits: put in by some machines, and selected for the next change by others.
const TOOLS: &[Case] = &[
    case("fanuc", "linuxcnc", PRESELECTED, "T2 / T3 M6 / S900 M3", &[323]),
    case("fanuc", "haas", PRESELECTED, "T2 / T3 M06 / S900 M03", &[323]),
    stated(
        case("fanuc", "linuxcnc", PRESELECTED, "T2 / T3 M6 / S900 M3", &[]),
        &[("tool_with_change", "named"), ("spindle_at_change", "does-not")],
        &[],
    ),
    // In either form of the target, the tool that waits is put in, and the next one is selected.
    stated(
        case("fanuc", "linuxcnc", PRESELECTED, "T2 / M6 / T3 / S900 M3", &[426]),
        &[("tool_with_change", "waiting")],
        &[],
    ),
    stated(
        case("fanuc", "haas", "M05 / G00 Z50. / T2 / T1 M06 G43 H2 / G00 Z10.", "T2 / M06 / T1", &[426]),
        &[("tool_with_change", "waiting")],
        &[],
    ),
    // A block of its own for each is the same on every machine.
    case("linuxcnc", "fanuc", "M5 / G0 Z50 / T2 / T3 M6 / G43 H3 Z10", "T2 / T3 / M06 / G43 H3", &[410]),
    case(
        "haas",
        "fanuc",
        "M05 / G00 Z50. / T2 / M06 T3 / G43 H3 Z10.",
        "T2 / T3 / G91 G28 Z0. / M06 / G90",
        &[410],
    ),
    // The tool that waits is the one that is named, or none waits.
    case("fanuc", "linuxcnc", "M05 / G00 Z50. / T2 / T2 M06 / G43 H2 Z10.", "T2 / T2 M6", &[]),
    case("fanuc", "linuxcnc", "M05 / G00 Z50. / T2 M06 / G43 H2 Z10.", "Z50 / T2 M6", &[]),
    case("linuxcnc", "fanuc", "M5 / G0 Z50 / T2 M6 / G43 H2 Z10", "Z50. / T2 M06", &[]),
    // In a program that is kept whole.
    case(
        "fanuc",
        "linuxcnc",
        "M05 / G00 Z50. / #1=0 / WHILE[#1LT2]DO1 / T2 / M06 T3 / G43 H3 Z10. / #1=#1+1 / END1",
        "T2 / T3 M6",
        &[323],
    ),
    // No T of the whole program waits, so that the block stays as it is.
    case(
        "linuxcnc",
        "fanuc",
        "M5 / G0 Z50 / o1 repeat [2] / T2 M6 / G43 H2 Z10 / o1 endrepeat",
        "T2 M06",
        &[323],
    ),
    // Which tool waits in a loop is known of its own T alone.
    stated(
        case(
            "fanuc",
            "linuxcnc",
            "M05 / G00 Z50. / T2 / #1=0 / WHILE[#1LT2]DO1 / M06 T3 / G43 H3 Z10. / #1=#1+1 / END1",
            "",
            &[501],
        ),
        &[("tool_with_change", "waiting")],
        &[],
    ),
];

const BARE: &str = "G01 Z5. F100. / G49 / G01 X10. / G00 Z50.";

/// A tool length in a block without Z: by a parameter of a Fanuc, Z moves by it at once.
const BARE_LENGTHS: &[Case] = &[
    case("fanuc", "linuxcnc", BARE, "G49 / G1 X10", &[323]),
    case("fanuc", "siemens", BARE, "D0 / G1 X10", &[323]),
    case("fanuc", "haas", BARE, "G01 X10. / G49 G00 Z50.", &[323]),
    case("fanuc", "linuxcnc", "G01 Z5. F100. / G43 H2 / G01 X10. / Z6.", "G43 H2 / G1 X10", &[323]),
    case("fanuc", "linuxcnc", "G01 Z5. F100. / G49 X10. / G00 Z50.", "G49", &[323]),
    case("fanuc", "linuxcnc", "G00 Z50. / G49 / M05", "G49", &[323]),
    stated(
        case("fanuc", "linuxcnc", BARE, "G49 Z5 / G1 X10", &[426]),
        &[("length_without_axis", "moves")],
        &[],
    ),
    stated(
        case("fanuc", "siemens", BARE, "Z5 D0 / G1 X10", &[426]),
        &[("length_without_axis", "moves")],
        &[],
    ),
    stated(
        case("fanuc", "haas", "G00 Z50. / G49 X10. / M05", "G49 X10. Z50.", &[426]),
        &[("length_without_axis", "moves")],
        &[],
    ),
    stated(case("fanuc", "linuxcnc", BARE, "G49 / G1 X10", &[]), &[("length_without_axis", "waits")], &[]),
    // Z moves from machine zero by a length: to no coordinate of the program that is known.
    stated(
        case("fanuc", "linuxcnc", "G91 G28 Z0. / G90 G43 H2 / G00 Z10.", "", &[501]),
        &[("length_without_axis", "moves")],
        &[],
    ),
    // At a place of the machine no length counts; with a Z in its block it moves on every machine.
    stated(
        case("fanuc", "linuxcnc", "G91 G28 Z0. / G49 / G90 G00 X5.", "G49 / G90 G0 X5", &[]),
        &[("length_after_return", "returns")],
        &[],
    ),
    case("fanuc", "linuxcnc", "G00 G49 Z50. / X10.", "G49 G0 Z50", &[]),
    // The target's parameter: where the source leaves a length, no Z may follow.
    case("linuxcnc", "fanuc", "G0 Z50 / G49 / G0 X10 / Z60", "X10. / G49 Z60.", &[]),
    case("linuxcnc", "fanuc", "G0 Z50 / G49 / G0 X10", "M05 / G49 / M30", &[323]),
];

const TWO_CODES: &str = "G01 Z-1. F100. / G00 Z10. / M05 / G91 G28 X0 Y0 Z0. G90";

/// G90 and G91 in the block of G28: by which its words are read.
const RETURNS: &[Case] = &[
    case("fanuc", "siemens", TWO_CODES, "G90 G0 X0 Y0 Z0 / SUPA G0 X0 Y0 Z0 D0", &[337]),
    stated(
        case("fanuc", "siemens", TWO_CODES, "M5 / G90 SUPA G0 X0 Y0 Z0 D0", &[]),
        &[("return_distance", "first")],
        &[],
    ),
    stated(
        case("fanuc", "haas", TWO_CODES, "M05 / G90 G28 X0. Y0. Z0.", &[]),
        &[("return_distance", "last")],
        &[],
    ),
    stated(
        case("fanuc", "linuxcnc", "G00 Z10. / M05 / G91 G28 Z5. G90", "G91 G0 Z5 / G90 G53 G0 Z0", &[]),
        &[("return_distance", "first")],
        &[],
    ),
    stated(
        case("fanuc", "linuxcnc", "G00 Z10. / M05 / G90 G30 Z0. G91 / G90", "", &[]),
        &[("return_distance", "last")],
        &[],
    ),
    // Other pairs exclude each other, and so do these on a control of which no source tells.
    case("fanuc", "siemens", "G91 G00 X5. G90", "", &[203]),
    case("fanuc", "siemens", "G90 G28 Z0. G90", "", &[203]),
    case("fanuc", "siemens", "G00 G28 Z0. G01", "", &[203]),
    case("haas", "fanuc", TWO_CODES, "", &[203]),
];

/// How corners are taken by a program that never says it.
const PATHS: &[Case] = &[
    case("fanuc", "linuxcnc", "G00 Z5. / X100. / Z-20.", "X100 / Z-20", &[326]),
    case("haas", "siemens", "G01 X20. F5000. / Y20.", "Y20", &[326]),
    case("linuxcnc", "fanuc", "G64 / G01 X20. F5000. / Y20.", "Y20.", &[]),
    // A G64 that the machine bounds, where nothing bounds it: told, or said with the length that somebody has stated.
    case("fanuc", "linuxcnc", "G64 / G01 X20. F5000.", "G64 / G1 X20", &[329]),
    case("haas", "linuxcnc", "G64 / G01 X20. F5000.", "G64 / G1 X20", &[329]),
    case("fanuc", "siemens", "G64 / G01 X20. F5000.", "G64 / G1 X20", &[329]),
    stated(
        case("fanuc", "linuxcnc", "G64 / G01 X20. F5000.", "G64 P0.02 / G1 X20", &[]),
        &[("path_tolerance", "0.02")],
        &[],
    ),
    stated(
        case("fanuc", "linuxcnc", "G01 X20. F5000. / G61 / Y20. / G64 / X0.", "G64 P0.05 / T1 M6", &[]),
        &[("path_tolerance", "0.05")],
        &[],
    ),
    stated(
        case("haas", "linuxcnc", "G01 X1. F50. / G61 / X2. / G64 / X0.", "G64 P0.01 / X0", &[]),
        &[("path_tolerance", "0.01")],
        &[],
    ),
    // It stops at each end point there: nothing is rounded.
    case("fanuc", "linuxcnc", "G61 / G01 X20. F5000.", "G61.1 / G1 X20", &[]),
    case("linuxcnc", "siemens", "G64 / G01 X20. F5000.", "G64 / G1 X20", &[]),
];

/// Digits below the least increment: of incremental words they count, or each word is cut off.
const FINE_DIGITS: &[Case] = &[
    case("fanuc", "linuxcnc", "G91 G01 X0.0005 F100. / X0.0005 / X0.0005", "X0.0005 / X0.0005", &[323]),
    case("fanuc", "siemens", "G91 G01 X0.0015 Y1. F100. / X0.0015", "G91 G1 X0.002 Y1", &[323]),
    case("haas", "linuxcnc", "G20 / G91 G01 X0.00005 F10. / X0.00005", "X0.00005", &[323]),
    case("fanuc", "haas", "G91 G01 Z-0.0015 F100. / Z-0.0015", "Z-0.00", &[323]),
    stated(
        case("fanuc", "linuxcnc", "G91 G01 X0.0015 F100. / X0.0005", "G91 G1 X0.001 F100 / X0", &[426]),
        &[("fine_digits", "cut-off")],
        &[],
    ),
    stated(
        case("fanuc", "siemens", "G91 G01 X-0.0015 F100. / G90 X1.0015", "X-0.001 F100 / G90 X1.002", &[426]),
        &[("fine_digits", "cut-off")],
        &[],
    ),
    stated(
        case("fanuc", "linuxcnc", "G91 G01 X0.0005 F100. / X0.0005", "X0.0005 F100 / X0.0005", &[]),
        &[("fine_digits", "count")],
        &[],
    ),
    // Nothing adds up in absolute words, and these have no such digits.
    case("fanuc", "linuxcnc", "G01 X0.0005 F100. / X1.0005", "X1.0005", &[]),
    case("fanuc", "siemens", "G91 G01 X0.001 F100. / X0.0010", "G91 G1 X0.001", &[]),
];

#[test]
fn fine_digits_of_incremental_words() {
    run(FINE_DIGITS);
}

#[test]
fn stops() {
    run(STOPS);
}

#[test]
fn tool_changes() {
    run(CHANGES);
    run(WAYS_UP);
}

#[test]
fn ends_of_programs() {
    run(ENDS);
}

#[test]
fn shifts_at_the_end() {
    run(SHIFTS);
}

#[test]
fn dwells_per_revolution() {
    run(DWELLS);
}

#[test]
fn lengths_after_places_of_the_machine() {
    run(LENGTHS);
}

#[test]
fn tools_beside_a_change() {
    run(TOOLS);
}

#[test]
fn lengths_without_z() {
    run(BARE_LENGTHS);
}

#[test]
fn returns_with_two_codes_of_distance() {
    run(RETURNS);
}

#[test]
fn path_modes_at_the_start() {
    run(PATHS);
}

#[test]
fn rotary_feeds_in_the_stream_and_in_loops() {
    run(ROTARY_FEEDS);
}

/// Messages that these tests are about.
const ABOUT: &[u16] = &[322, 323, 324, 325, 329, 426];

fn run(cases: &[Case]) {
    let mut failures = Failures::default();
    for Case { pair: (from, to), options, blocks, says, told } in cases {
        let mut job = job(from, to, "part");
        for (settings, options) in [(&mut job.from, options[0]), (&mut job.to, options[1])] {
            for (option, value) in options {
                settings.choose(option, value).expect("an option of the dialect");
            }
        }
        job.head = false;
        let (start, head, end) = match *from {
            "siemens" => ("", HEAD_S, "M30\n"),
            "linuxcnc" => ("", HEAD, "M2\n"),
            _ => ("%\nO1\n", HEAD, "M30\n%\n"),
        };
        let source = format!("{start}{}\n{end}", format!("{head}{blocks}").replace(" / ", "\n"));
        let (outcome, written) = translate(&job, source.as_bytes());
        let text = String::from_utf8_lossy(&written).replace("\r\n", "\n");
        let text = text.lines().collect::<Vec<_>>().join(" / ");
        let name = format!("{from} to {to}: {blocks}");
        let codes: BTreeSet<u16> = outcome.diagnostics.iter().map(|d| d.fault.code()).collect();
        let missing: Vec<&u16> = told.iter().filter(|code| !codes.contains(code)).collect();
        if !missing.is_empty() {
            failures.add(&name, format!("does not report {missing:?}, but {codes:?}"));
        }
        match says.is_empty() {
            true if outcome.release.is_ok() => failures.add(&name, format!("released: {text}")),
            true => {}
            false if outcome.release.is_err() => {
                failures.add(&name, format!("refused: {:?}", stopping(&job, &outcome)));
            }
            false if !text.contains(says) => failures.add(&name, format!("says {text}")),
            // Silence where the cut is the same on every machine.
            false if told.is_empty() => {
                let open = |d: &&ncc_ir::diag::Diagnostic| match d.fault {
                    // Where Z goes for a tool change is another matter.
                    Fault::OpenBehaviour { behaviour, .. } => behaviour != Behaviour::ZAtChange,
                    Fault::SideEffectWritten { behaviour } => {
                        !matches!(behaviour, Behaviour::SpindleAtEnd | Behaviour::CoolantAtEnd)
                    }
                    _ => ABOUT.contains(&d.fault.code()),
                };
                if let Some(d) = outcome.diagnostics.iter().find(open) {
                    failures.add(&name, format!("reports {:?}", d.fault));
                }
            }
            false => {}
        }
    }
    failures.finish();
}
