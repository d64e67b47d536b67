//! What a Sinumerik does that no word of a program says, in both directions: small programs of the kinds that shops have,
//! each with what the output must hold, or with what it is refused for.

use std::collections::BTreeSet;

use ncc_ir::behaviour::Concern;
use ncc_ir::diag::Fault;
use ncc_passes::PASSES;
use ncc_tests::expect::Failures;
use ncc_tests::translate::{job, stopping, translate};

/// One translation.
struct Case {
    /// From, and options of it.
    from: (&'static str, &'static [(&'static str, &'static str)]),
    /// To, and options of it.
    to: (&'static str, &'static [(&'static str, &'static str)]),
    /// Blocks between head and end, separated by ` / `.
    blocks: &'static str,
    /// What becomes of it.
    right: Right,
}

/// What is right.
enum Right {
    /// Verified, and these blocks follow one another in the output.
    Says(&'static str),
    /// The same, with facts reported that would make another cut: their names.
    SaysIf(&'static str, &'static [&'static str]),
    /// The same, with F on arcs under compensation reported, which no word of the target changes.
    SaysFed(&'static str),
    /// Refused with this code.
    Refused(u16),
}

use Right::{Refused, Says, SaysFed, SaysIf};

/// A head of word-address controls, with a tool and its length.
const HEAD: &str = "G21 G17 G90 G94 G54 G40 G49 G80 / T1 M6 / S1000 M3 / G0 X10. Y0 / G43 H1 Z50. / ";
/// The same in a Sinumerik's words.
const HEAD_S: &str = "G710 G17 G90 G94 G54 G40 / T1 M6 / D1 / S1000 M3 / G0 X10 Y0 / Z50 / ";

const WITHOUT: &[(&str, &str)] = &[("frame_offset_incremental", "excluded")];
const WITH: &[(&str, &str)] = &[("frame_offset_incremental", "included")];

/// SD 42440: a change of frame or work offset in the incremental words after it.
const FRAMES: &[Case] = &[
    case("fanuc", "siemens", "G52 X3. / G91 G1 X5. F100.", Says("TRANS X3 / G91 G1 X=AC(12) F100")),
    case(
        "haas",
        "siemens",
        "G52 X3. Y1. / G91 G1 X5. F100. / X5. Y2.",
        Says("G91 G1 X=AC(12) F100 / X5 Y=AC(1)"),
    ),
    case(
        "linuxcnc",
        "siemens",
        "G52 Z3 / G91 G1 Z-5 F100 / Z-1",
        Says("TRANS Z3 / F100 / G91 G1 Z=AC(42) / Z-1"),
    ),
    case(
        "fanuc",
        "siemens",
        "G92 X0 Y0 / G91 G1 X5. F100. / Y2.",
        Says("TRANS X10 / G91 G1 X=AC(5) F100 / Y=AC(2)"),
    ),
    // No axis but those of the frame needs it, and none that has had an absolute word.
    case("fanuc", "siemens", "G52 X3. / G91 G1 Y5. F100.", Says("TRANS X3 / G91 G1 Y5 F100")),
    case(
        "fanuc",
        "siemens",
        "G52 X3. / G0 X1. / G91 G1 X5. F100.",
        Says("TRANS X3 / G0 X1 / G91 G1 X5 F100"),
    ),
    case("fanuc", "siemens", "G55 / G1 X1. F100. / G91 X5.", Says("G55 / G1 X1 F100 / G91 X5")),
    // An arc, and a hole.
    case(
        "fanuc",
        "siemens",
        "G52 X3. / G91 G2 X4. Y0. R2. F100.",
        Says("TRANS X3 / G91 G2 X=AC(11) Y0 CR=2 F100"),
    ),
    case("fanuc", "siemens", "G52 X3. / G91 G28 Z0. / G90 G0 X1.", Says("TRANS X3")),
    // Where the place is not known in the other frame.
    case("fanuc", "siemens", "G55 / G91 G1 X5. F100.", Refused(501)),
    case("haas", "siemens", "G10 L2 P1 X10. / G91 G1 X5. F100.", Refused(501)),
    case("fanuc", "siemens", "G51.1 X0 / G91 G1 X5. F100.", Refused(501)),
    case("fanuc", "siemens", "G51 X0 Y0 Z0 P2. / G91 G1 X5. F100.", Refused(501)),
    case("linuxcnc", "siemens", "G59.3 / G91 G1 Y5 F100", Refused(501)),
    stated("fanuc", &[], "siemens", WITHOUT, "G55 / G91 G1 X5. F100.", Says("G55 / G91 G1 X5 F100")),
    stated(
        "fanuc",
        &[],
        "siemens",
        WITHOUT,
        "G51.1 X0 / G91 G1 X5. F100.",
        Says("MIRROR X0 / G91 G1 X5 F100"),
    ),
    stated("fanuc", &[], "siemens", WITH, "G55 / G91 G1 X5. F100.", Refused(501)),
    // A Sinumerik's own.
    case("siemens", "fanuc", "TRANS X3 / G91 G1 X5 F100", SaysIf("G52 X3. / G91 / G90 G01 X15. F100.", OPEN)),
    case("siemens", "linuxcnc", "G55 / G1 X=IC(5) F100", SaysIf("G55 / G1 X15 F100", OPEN)),
    case("siemens", "haas", "MIRROR X0 / G0 X=IC(4) / X=IC(1)", SaysIf("G00 X-14. / G91 X-1.", OPEN)),
    stated(
        "siemens",
        WITHOUT,
        "fanuc",
        &[],
        "TRANS X3 / G91 G1 X5 F100",
        Says("G52 X3. / G91 G01 X5. F100."),
    ),
    stated(
        "siemens",
        WITH,
        "fanuc",
        &[],
        "TRANS X3 / G91 G1 X5 F100",
        Says("G52 X3. / G91 / G90 G01 X15. F100."),
    ),
    case("siemens", "siemens", "TRANS X3 / G91 G1 X5 F100", Says("TRANS X3 / G91 G1 X5 F100")),
    case("siemens", "fanuc", "ROT RPL=30 / G0 X=IC(4)", Refused(226)),
    case("siemens", "fanuc", "TRANS X5 / G0 X20 / X=IC(2)", Says("G52 X5. / G00 X20. / G91 X2.")),
];

const OPEN: &[&str] = &["frame-offset-incremental"];

/// Edges of tools that are in force already, and none.
const EDGES: &[Case] = &[
    case("siemens", "fanuc", "D1 X5 / X6", Says("X5. / X6.")),
    case("siemens", "haas", "G0 X5 D1", Says("X5.")),
    case("siemens", "fanuc", "T0 M6 / G0 Z5", Says("T0 M06 / G49 G00 Z5.")),
    case("siemens", "linuxcnc", "M5 / T0 M6 D1 / G0 Z5 / X1", Says("T0 M6 / G49 / G0 Z5 / X1")),
    case("siemens", "fanuc", "D1 X5 / Z40", Says("X5. / G43 H1 Z40.")),
];

/// Pitches of threads in inches.
const PITCHES: &[Case] = &[
    case(
        "fanuc",
        "siemens",
        "G20 / G0 Z2. / M29 S500 / G98 G84 X1. Z-0.5 R0.2 F25. / G80",
        Says("MCALL CYCLE84(2,0.2,0,-0.5,,,5,,0.05,,500,500,,3)"),
    ),
    case(
        "haas",
        "siemens",
        "G20 / G0 Z1. / G98 G84 X1. Z-0.5 R0.1 F50. / G80",
        Says("CYCLE84(1,0.1,0,-0.5,,,5,,0.05,,1000,1000,,3)"),
    ),
    case(
        "fanuc",
        "siemens",
        "G0 Z20. / M29 S500 / G98 G84 X1. Z-5. R2. F500. / G80",
        Says("CYCLE84(20,2,0,-5,,,5,,1,,500,500)"),
    ),
    case(
        "siemens",
        "haas",
        "G700 / F50 / G0 Z1 / MCALL CYCLE84(1,0.1,0,-0.5,,,3,,0.05,,1000,1000,,3) / X1 / MCALL",
        Says("G84 X1. Z-0.5 R0.1 F50."),
    ),
    stated(
        "siemens",
        &[("pitch_unit", "in-force")],
        "siemens",
        &[],
        "G700 / F50 / G0 Z1 / MCALL CYCLE84(1,0.1,0,-0.5,,,3,,0.05,,1000,1000) / X1 / MCALL",
        Says("CYCLE84(1,0.1,0,-0.5,,,3,,0.05,,1000,1000,,3)"),
    ),
    // Both units in one program, and a rigid tap whose code stands in another program than its cycle.
    case(
        "fanuc",
        "siemens",
        "G20 / M29 S500 / G98 G84 X1. Z-0.5 R0.2 F25. / G80 / G21 / M29 S500 / G84 X1. Z-5. R2. F500. / G80",
        Says("-0.5,,,5,,0.05,,500,500,,3)"),
    ),
    case(
        "fanuc",
        "siemens",
        "M29 S500 / M98 P2 / G84 X1. Z-5. R2. F500. / G80 / M30 / O2 / X2. / M99",
        Refused(202),
    ),
    case(
        "fanuc",
        "siemens",
        "IF [#500 GT 2.] GOTO 5 / M29 S500 / N5 G98 G84 X1. Z-5. R2. F500. / G80",
        Refused(202),
    ),
    // Without a word of its unit it is in millimetres where the machine is.
    case(
        "siemens",
        "siemens",
        "G700 / F50 / G0 Z1 / MCALL CYCLE84(1,0.1,0,-0.5,,,3,,1.25,,1000,1000) / X1 / MCALL",
        Says("CYCLE84(1,0.1,0,-0.5,,,3,,1.25,,1000,1000,,1)"),
    ),
];

const AFTER: &[(&str, &str)] = &[("change_in_block", "after-motion")];
const BEFORE: &[(&str, &str)] = &[("change_in_block", "before-motion")];

/// A tool change in one block with axis words.
const CHANGES: &[Case] = &[
    case("fanuc", "siemens", "T2 M6 G43 H2 Z20.", Says("T2 M6 D1 / Z20")),
    case("haas", "fanuc", "T2 M6 G43 H2 X1. Z20.", Says("T2 M06 / G90 G43 H2 X1. Z20.")),
    case("linuxcnc", "haas", "M5 / T2 M6 G43 H2 Z20", Says("T2 M06 / G43 H2 Z20.")),
    case("linuxcnc", "siemens", "M5 / G1 X4 F100 T2 M6", Says("M6 / G1 X4")),
    case("fanuc", "linuxcnc", "M5 / T2 M6 G43 H2 Z20.", Says("T2 M6 / G43 H2 Z20")),
    stated(
        "fanuc",
        AFTER,
        "linuxcnc",
        &[],
        "M5 / X20. T2 M6 / G43 H2 Z20.",
        Says("X20 T2 / M6 / G43 H2 Z20"),
    ),
    stated("fanuc", AFTER, "siemens", &[], "X20. T2 M6 / G43 H2 Z20.", Says("X20 T2 / M6 / D1 / Z20")),
    case("siemens", "fanuc", "Z80 T2 M6 / X5 Z20", Says("Z80. T2 / M06 / G43 H2 X5. Z20.")),
    stated("siemens", BEFORE, "fanuc", &[], "Z80 T2 M6 D1 / X5", Says("T2 M06 / G43 H2 Z80. / X5.")),
    case("siemens", "fanuc", "Z80 T2 M6 D1 / X5", Refused(202)),
    case("siemens", "siemens", "T2 M6 D1 / X5", Says("T2 M6 D1 / X5")),
];

const NORMAL: &[(&str, &str)] = &[("length_axis_in_plane", "normal")];
const ALONG_Z: &[(&str, &str)] = &[("length_axis_in_plane", "z")];
const CALLED: &[(&str, &str)] = &[("length_axis_at_call", "normal")];

/// SD 42940, and a Fanuc's parameter 5001: where the length of a tool lies in G18 and G19.
const LENGTHS: &[Case] = &[
    case("fanuc", "siemens", "G18 / G2 X20. Z40. R10. F100. / G17 / G0 Z50.", SaysIf("G2 X20 Z40", AXIS)),
    case("haas", "siemens", "G19 / G1 Y20. Z40. F100. / G17 / G0 Z50.", SaysIf("G1 Y20 Z40", AXIS)),
    case("linuxcnc", "siemens", "G18 / G1 X20 F100 / Z40 / G17 / G0 Z50", SaysIf("G1 X20", AXIS)),
    // In a program with variables, in a loop, and in an arc that the control would refuse then.
    case(
        "fanuc",
        "siemens",
        "#1=1 / G18 / G01 X20. Z-10. F100. / G17 / G00 Z50.",
        SaysIf("G18 / G1 X20 Z-10", AXIS),
    ),
    case(
        "haas",
        "siemens",
        "#1=1 / G18 / G02 X30. Z30. R20. F100. / G17 / G00 Z50.",
        SaysIf("G18 / G2 X30 Z30 CR=20", AXIS),
    ),
    case(
        "fanuc",
        "siemens",
        "#1=0 / WHILE [#1 LT 2] DO1 / G18 / G01 Z-10. F100. / G17 / G00 Z10. / #1=#1+1 / END1",
        SaysIf("G18 / G1 Z-10", AXIS),
    ),
    // Nothing in the other plane, or no length.
    case("fanuc", "siemens", "G18 / G17 / G1 X20. F100.", Says("G18 / G17 / G1 X20 F100")),
    case("fanuc", "siemens", "G49 Z60. / G18 / G2 X20. Z50. R10. F100.", Says("G2 X20 Z50")),
    stated("fanuc", &[], "siemens", ALONG_Z, "G18 / G2 X20. Z40. R10. F100.", Says("G18 / G2 X20 Z40")),
    stated("fanuc", &[], "siemens", NORMAL, "G18 / G2 X20. Z40. R10. F100.", Refused(501)),
    stated("fanuc", &[], "siemens", NORMAL, "G1 X20. F100. / Z40.", Says("G1 X20 F100 / Z40")),
    case("siemens", "linuxcnc", "G18 / G1 X20 F100 / Z40", SaysIf("G1 X20", AXIS)),
    stated("siemens", NORMAL, "fanuc", &[], "G18 / G1 X20 F100 / Z40", Refused(501)),
    stated("siemens", ALONG_Z, "fanuc", &[], "G18 / G1 X20 F100 / Z40", Says("G01 X20. F100.")),
    case("fanuc", "linuxcnc", "G18 / G43 H1 Y10. Z40.", SaysIf("G43 H1", &["length-axis-at-call"])),
    stated("fanuc", CALLED, "linuxcnc", &[], "G18 / G43 H1 Y10.", Refused(501)),
];

const AXIS: &[&str] = &["length-axis-in-plane"];

const SHORTEST: &[(&str, &str)] = &[("rotary_turn", "shortest")];
const NUMBER: &[(&str, &str)] = &[("rotary_turn", "as-programmed")];
const SIGN: &[(&str, &str)] = &[("rotary_turn", "sign")];

/// How far, and which way round, an absolute word turns a rotary axis.
const TURNS: &[Case] = &[
    case("linuxcnc", "fanuc", "G0 X0 A0 / G1 X20 A28800 F500 / G0 A0", Refused(522)),
    case("fanuc", "linuxcnc", "G0 X0 A0 / G1 A200. F500.", Refused(522)),
    case("fanuc", "siemens", "G0 A0 / G0 A170. / A200. / A20.", Refused(522)),
    stated(
        "linuxcnc",
        NUMBER,
        "fanuc",
        NUMBER,
        "G0 A0 / G1 X20 A28800 F500",
        Says("G93 G01 X20. A28800. F50."),
    ),
    stated(
        "fanuc",
        SHORTEST,
        "siemens",
        SHORTEST,
        "G0 A0 / G1 A200. F500.",
        SaysIf("G1 A200 F500", &["rotary-feed"]),
    ),
    stated("fanuc", SHORTEST, "siemens", NUMBER, "G0 A0 / G1 A200. F500.", Refused(522)),
    stated(
        "fanuc",
        SHORTEST,
        "siemens",
        NUMBER,
        "G0 A0 / G1 A170. F500. / A20.",
        SaysIf("G1 A170 F500 / A20", &["rotary-feed"]),
    ),
    stated("linuxcnc", SIGN, "siemens", NUMBER, "G0 A20 / G1 A10 F500", Refused(522)),
    stated(
        "linuxcnc",
        SIGN,
        "siemens",
        NUMBER,
        "G0 A20 / G1 A90 F500",
        SaysIf("G1 A90 F500", &["rotary-feed"]),
    ),
    // Less than half a turn, an increment, or from where nobody knows.
    case(
        "fanuc",
        "siemens",
        "G0 A0 / G1 A170. F500. / A20. / G91 A-300.",
        SaysIf("G1 A170 F500 / A20 / G91 A-300", &["rotary-feed"]),
    ),
    case("fanuc", "siemens", "G0 A270. / A190.", Says("A270 / A190")),
    // With the block-skip switch on, or in a loop, by computed numbers.
    case(
        "linuxcnc",
        "fanuc",
        "G0 A0 / /G0 A170 / G0 A200",
        SaysIf("/G00 A170. / G00 A200.", &["rotary-turn"]),
    ),
    case(
        "linuxcnc",
        "fanuc",
        "G0 A0 / #1=0 / o1 while [#1 LT 3] / G0 A[#1*300] / #1=[#1+1] / o1 endwhile",
        SaysIf("G00 A[#1 * 300]", &["rotary-turn"]),
    ),
    // A control's own program stays what it is.
    case("fanuc", "fanuc", "G0 A0 / G1 A200. F500.", Says("A0. / G01 A200. F500.")),
];

/// MD 28080: work offsets behind G57.
const OFFSETS: &[Case] = &[
    case("fanuc", "siemens", "G54.1 P1 / G0 X5.", Says("G507 / G0 X5")),
    stated("fanuc", &[], "siemens", &[("user_frames", "5")], "G58 / G0 X5.", Refused(504)),
    stated("haas", &[], "siemens", &[("user_frames", "8")], "G154 P1 / G0 X5.", Says("G507 / G0 X5")),
    stated("fanuc", &[], "siemens", &[("user_frames", "5")], "G57 / G0 X5.", Says("G57 / G0 X5")),
];

const AT_CENTRE: &[(&str, &str)] = &[("feed_on_compensated_arcs", "centre")];
const ON_CONTOUR: &[(&str, &str)] = &[("feed_on_compensated_arcs", "contour")];
const INSIDE: &[(&str, &str)] = &[("feed_on_compensated_arcs", "inside")];

/// Group 16: what F counts on arcs under cutter compensation.
const COMPENSATED: &[Case] = &[
    // An outer arc.
    case(
        "fanuc",
        "siemens",
        "G41 D1 G1 X10. Y10. F100. / Y20. / G02 X10.5 Y20.5 R0.5 / G1 X30. / G40 X50.",
        Says("CFTCP / G1 G41 X10 Y10 F100 / Y20 / G2 X10.5 Y20.5 CR=0.5"),
    ),
    case(
        "linuxcnc",
        "siemens",
        "G42 D1 G1 X20 Y0 F100 / G2 I-20 J0 / G40 G1 X0 Y0",
        Says("CFTCP / G1 G42 X20 Y0 F100 / G2 I-20 J0"),
    ),
    // Inner arcs, on which a parameter or a setting of these controls lowers F.
    case(
        "fanuc",
        "siemens",
        "G41 D1 G1 X20. Y0. F100. / G3 I-20. J0. / G40 G1 X0. Y0.",
        SaysIf("CFTCP / G1 G41 X20 Y0 F100 / G3 I-20 J0", &["feed-on-compensated-arcs"]),
    ),
    case(
        "haas",
        "siemens",
        "G41 D1 G1 X20. Y0. F100. / G3 I-20. J0. / G40 G1 X0. Y0.",
        SaysIf("CFTCP / G1 G41 X20 Y0 F100 / G3 I-20 J0", &["feed-on-compensated-arcs"]),
    ),
    case(
        "fanuc",
        "linuxcnc",
        "G41 D1 G1 X20. Y0. F100. / G3 I-20. J0. / G40 G1 X0. Y0.",
        SaysIf("G1 G41 D1 X20 Y0 F100 / G3 I-20 J0", &["feed-on-compensated-arcs"]),
    ),
    stated(
        "haas",
        INSIDE,
        "siemens",
        &[],
        "G41 D1 G1 X20. Y0. F100. / G3 I-20. J0. / G40 G1 X0. Y0.",
        Says("CFIN / G1 G41 X20 Y0 F100 / G3 I-20 J0"),
    ),
    stated(
        "haas",
        INSIDE,
        "linuxcnc",
        &[],
        "G41 D1 G1 X20. Y0. F100. / G3 I-20. J0. / G40 G1 X0. Y0.",
        SaysFed("G1 G41 D1 X20 Y0 F100 / G3 I-20 J0"),
    ),
    // Once, however often compensation starts; the meaning is what counts, not who has it.
    case(
        "fanuc",
        "siemens",
        "G41 D1 G1 X10. Y10. F100. / X30. / G40 X50. / G42 D1 Y10. / X30. / G40 X50.",
        Says("CFTCP / G1 G41 X10 Y10 F100 / X30 / G40 X50 / G42 Y10 / X30 / G40 X50"),
    ),
    stated(
        "fanuc",
        &[],
        "siemens",
        AT_CENTRE,
        "G41 D1 G1 X10. Y10. F100. / G2 X20. Y20. R10. / G40 G1 X50.",
        Says("Z50 / G1 G41 X10 Y10 F100 / G2 X20 Y20 CR=10"),
    ),
    // An arc in a subprogram, under the compensation of its caller.
    case(
        "fanuc",
        "siemens",
        "G41 D1 G1 X10. Y10. F100. / M98 P100 / G40 X50. / M30 / O100 / G2 X20. Y20. R10. / G1 X30. / M99",
        Says("CFTCP / G1 G41 X10 Y10 F100"),
    ),
    // The other way.
    case(
        "siemens",
        "fanuc",
        "G41 G1 X10 Y10 F100 / Y20 / G2 X10.5 Y20.5 CR=0.5 / G1 X30 / G40 X50",
        SaysFed("G01 G41 D1 X10. Y10. F100. / Y20. / G02 X10.5 Y20.5 R0.5"),
    ),
    case(
        "siemens",
        "haas",
        "G42 G1 X20 Y0 F100 / G2 I-20 J0 / G40 G1 X0 Y0",
        SaysFed("G01 G42 D1 X20. Y0. F100. / G02 I-20. J0."),
    ),
    case(
        "siemens",
        "linuxcnc",
        "G41 G1 X10 Y10 F100 / CHANGE: G3 X20 Y20 CR=10 / G1 Y30 / G40 X50",
        SaysFed("G3 X20 Y20 R10"),
    ),
    case("siemens", "fanuc", "G41 G1 X10 Y10 F100 / Y20 / X30 / G40 X50", Says("G01 G41 D1 X10. Y10. F100.")),
    // A program that states it.
    case(
        "siemens",
        "fanuc",
        "CFTCP / G41 G1 X10 Y10 F100 / Y20 / G2 X20 Y30 CR=10 / G1 X30 / G40 X50",
        SaysIf("Y20. / G02 X20. Y30. R10.", &[]),
    ),
    case(
        "siemens",
        "fanuc",
        "CFIN / G41 G1 X10 Y10 F100 / Y20 / G2 X20 Y30 CR=10 / G1 X30 / G40 X50",
        Says("Y20. / G02 X20. Y30. R10."),
    ),
    case(
        "siemens",
        "linuxcnc",
        "CFIN / G41 G1 X20 Y0 F100 / G3 I-20 J0 / G40 G1 X0 Y0",
        SaysFed("G3 I-20 J0"),
    ),
    stated(
        "siemens",
        AT_CENTRE,
        "linuxcnc",
        &[],
        "G41 G1 X20 Y0 F100 / G3 I-20 J0 / G40 G1 X0 Y0",
        Says("G3 I-20 J0"),
    ),
    // Two machines of one kind.
    stated(
        "siemens",
        ON_CONTOUR,
        "siemens",
        AT_CENTRE,
        "G41 G1 X20 Y0 F100 / G3 I-20 J0 / G40 G1 X0 Y0",
        Says("CFC / G1 G41 X20 Y0 F100 / G3 I-20 J0"),
    ),
];

const fn case(from: &'static str, to: &'static str, blocks: &'static str, right: Right) -> Case {
    Case { from: (from, &[]), to: (to, &[]), blocks, right }
}

const fn stated(
    from: &'static str,
    own: &'static [(&'static str, &'static str)],
    to: &'static str,
    other: &'static [(&'static str, &'static str)],
    blocks: &'static str,
    right: Right,
) -> Case {
    Case { from: (from, own), to: (to, other), blocks, right }
}

fn run(cases: &[Case]) {
    let mut failures = Failures::default();
    for Case { from, to, blocks, right } in cases {
        let mut job = job(from.0, to.0, "part");
        for (settings, options) in [(&mut job.from, from.1), (&mut job.to, to.1)] {
            for (option, value) in options {
                settings.choose(option, value).expect("an option of the dialect");
            }
        }
        job.head = false;
        job.layout.numbering = ncc_backends::Numbering::Off;
        let (head, end) = match from.0 {
            "siemens" => (HEAD_S, "M30\n"),
            "linuxcnc" => (HEAD, "M2\n"),
            _ => (HEAD, "M30\n%\n"),
        };
        let start = if matches!(from.0, "fanuc" | "haas") { "%\nO1\n" } else { "" };
        let source = format!("{start}{}\n{end}", format!("{head}{blocks}").replace(" / ", "\n"));
        let (outcome, written) = translate(&job, source.as_bytes());
        let codes = stopping(&job, &outcome);
        let open: BTreeSet<&str> = outcome
            .diagnostics
            .iter()
            .filter_map(|d| match d.fault {
                // What a shift that is left in force does to the next run, `twice` has.
                Fault::OpenBehaviour { behaviour, .. } if behaviour.concern() != Concern::AtEnd => {
                    Some(behaviour.name())
                }
                _ => None,
            })
            .collect();
        let text = String::from_utf8_lossy(&written).replace("\r\n", "\n");
        let text = text.lines().collect::<Vec<_>>().join(" / ");
        let name = format!("{} to {}: {blocks}", from.0, to.0);
        let fed = outcome.diagnostics.iter().any(|d| matches!(d.fault, Fault::FeedOnArcs { .. }));
        let mut says = |words: &str, facts: &[&str]| {
            // What a tool change does is another matter.
            let told: Vec<&str> = open.iter().copied().filter(|name| !name.ends_with("-at-change")).collect();
            if !text.contains(words) {
                failures.add(&name, format!("says {text}, {codes:?}"));
            } else if told != facts {
                failures.add(&name, format!("reports {told:?}"));
            } else if fed != matches!(right, SaysFed(_)) {
                failures.add(&name, "F on arcs under compensation is reported, or should be");
            }
        };
        match right {
            Says(words) | SaysFed(words) => says(words, &[]),
            SaysIf(words, facts) => says(words, facts),
            Refused(code) if codes.contains(code) && written.is_empty() => {}
            Refused(_) => failures.add(&name, format!("is refused with {codes:?}, or says {text}")),
        }
    }
    failures.finish();
}

#[test]
fn changes_of_frames_in_incremental_words() {
    run(FRAMES);
}

#[test]
fn pitches_in_inches() {
    run(PITCHES);
}

#[test]
fn tool_changes_beside_axis_words() {
    run(CHANGES);
}

#[test]
fn lengths_in_other_planes() {
    run(LENGTHS);
}

#[test]
fn turns_of_rotary_axes() {
    run(TURNS);
}

#[test]
fn work_offsets_that_a_machine_may_lack() {
    run(OFFSETS);
}

#[test]
fn edges_that_are_in_force() {
    run(EDGES);
}

#[test]
fn feeds_on_arcs_under_compensation() {
    run(COMPENSATED);
}

/// Where compensation is worked out, arcs get the F of the tool centre, unless the control or the program counts there.
#[test]
fn feeds_of_the_tool_centre_where_compensation_is_worked_out() {
    let pass = PASSES.iter().find(|pass| pass.name == "expand-compensation").expect("the pass");
    let contour = "$TC_DP6[1,1]=4 / G41 X20 Y0 F100 / G3 X-20 Y0 CR=20 / G1 X-30 / G2 X-40 Y-10 CR=10 F150 / G1 Y-30 / G40 X-50";
    for (code, option, feeds) in [
        ("", "contour", ["F80", "F100", "F210", "F150"]),
        ("CFC / ", "centre", ["F80", "F100", "F210", "F150"]),
        ("CFTCP / ", "contour", ["F100", "", "F150", ""]),
        ("", "centre", ["F100", "", "F150", ""]),
        ("CFIN / ", "contour", ["F80", "F100", "F150", ""]),
    ] {
        let mut job = job("siemens", "linuxcnc", "part");
        job.from.choose("feed_on_compensated_arcs", option).expect("an option of the dialect");
        job.head = false;
        job.passes.push(pass);
        let source = format!("{HEAD_S}G1 / {code}{contour} / M30\n").replace(" / ", "\n");
        let (outcome, written) = translate(&job, source.as_bytes());
        let text = String::from_utf8_lossy(&written);
        let said: Vec<&str> =
            text.split_whitespace().filter(|word| word.starts_with('F') && *word != "F100").collect();
        let want: Vec<&str> = feeds.into_iter().filter(|feed| !feed.is_empty() && *feed != "F100").collect();
        assert_eq!(said, want, "{code} {option}: {text} {:?}", stopping(&job, &outcome));
    }
}
