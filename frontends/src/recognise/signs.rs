//! The signs by which a program that is not for a mill gives itself away: one row each.
//!
//! The weights: 3 is alone enough, 2 is strong, 1 a hint. What a mill does too has a low weight, or a condition.

use super::sources::{
    EDM, FANUC_T, HAAS_T, HEIDENHAIN, LINUXCNC_T, MARLIN, MAZATROL, OKUMA, SIEMENS_T, WRITTEN,
};
use std::ops::Range;
use std::sync::LazyLock;

use super::blocks::{Block, bit};

/// What a text may be instead of a milling program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// The conversational language of Heidenhain controls, or their DIN/ISO form.
    Heidenhain,
    /// Okuma OSP, mill or lathe.
    Okuma,
    /// A Mazatrol program as it is printed or exported.
    Mazatrol,
    /// A wire electrical discharge machine.
    WireEdm,
    /// A 3-D printer.
    Printer,
    /// A lathe.
    Lathe,
    /// Words and sentences.
    Text,
}

impl Kind {
    /// All kinds; of two with the same weight, the first is named.
    pub const ALL: [Kind; 7] = [
        Kind::Heidenhain,
        Kind::Okuma,
        Kind::Mazatrol,
        Kind::WireEdm,
        Kind::Printer,
        Kind::Lathe,
        Kind::Text,
    ];
}

/// A control, or the set of codes of a control, that a sign belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum System {
    /// FANUC lathe, G code system A: G90, G92 and G94 are turning cycles.
    FanucA,
    /// FANUC lathe, G code system B: G77, G78 and G79 are.
    FanucB,
    /// FANUC lathe, G code system C: G20, G21 and G24 are.
    FanucC,
    /// Haas lathe.
    Haas,
    /// Sinumerik lathe.
    Sinumerik,
    /// LinuxCNC lathe.
    LinuxCnc,
}

impl System {
    /// All of them.
    pub const ALL: [System; 6] =
        [System::FanucA, System::FanucB, System::FanucC, System::Haas, System::Sinumerik, System::LinuxCnc];
}

/// What a sign looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// A block with all of these words and none of those after a `!`: `G71 P Q !Y`. A letter alone is a word with
    /// any value. `only` as the first word: a block without any other word, block numbers aside.
    Block(&'static str),
    /// A name: a word of several letters, whole.
    Name(&'static str),
    /// The line begins with these words after its block number; a blank stands for any number of them.
    Begins(&'static str),
    /// The line contains this somewhere, its comments too.
    Says(&'static str),
    /// Several blocks together show it.
    Course(Sort),
}

/// What several blocks together show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sort {
    /// A T word of three or four digits in a text without M06.
    ToolWithOffset,
    /// The same tool called with an offset and later with offset 00.
    OffsetCancelled,
    /// A block with this G code, X, Z and F, followed by blocks with an X or a Z alone; no G91 in the text.
    RepeatedCycle(u32),
    /// G98 or G99 before any canned cycle, and feeds as low as per revolution.
    FeedPerTurn,
    /// G95 with feeds as low as that, moves of X and Z, and neither a Y nor a canned cycle.
    TurnedFeed,
    /// Feeds as low as per revolution while nothing says that they count revolutions.
    LowFeed,
    /// Moves of X and Z, and never a Y.
    NoY,
    /// Several tools and no M06, and never a Y.
    Turret,
    /// G96 or G97 with a speed, and never a Y.
    SurfaceSpeed,
    /// A word in a comment that turners use.
    TurnersWord,
    /// X and Y moves with an E word, several of them.
    Extrusion,
    /// A program in X and Y alone that sets its origin by G92.
    OriginWithoutZ,
    /// A word E of four digits without a point, more than one.
    CuttingCondition,
    /// A value given to an offset by its H: `H001=+0.125`.
    OffsetAssigned,
    /// A block number with a name: `NLAP1 G81`.
    NamedBlock,
    /// A call by a name of O and a number: `CALL O1000`, `CALL OO88`.
    OkumaCall,
    /// A common variable of an Okuma: `VC12=`.
    CommonVariable,
    /// A system variable of an Okuma: `VZOFZ[1]`, `VTLCN`.
    SystemVariable,
    /// A first line of O and letters alone: `OPULL`.
    LetteredProgram,
    /// A tool word of six digits.
    SixDigitTool,
    /// A first line such as `%NAME G71 *`.
    IsoHeading,
    /// Straight moves with `FMAX`, or with a compensation as their last word: `L X+10 R0`.
    ConversationalMove,
    /// Sentences, and no block.
    Prose,
}

/// A row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sign {
    /// What it is a sign of.
    pub kind: Kind,
    /// 3 alone enough, 2 strong, 1 a hint.
    pub weight: i8,
    /// What it looks like.
    pub shape: Pattern,
    /// Whose sign it is; empty is nobody's in particular.
    pub systems: &'static [System],
    /// What it is there, in at most 60 characters.
    pub label: &'static str,
    /// Where this is known from.
    pub source: &'static str,
}

const AH: &[System] = &[System::FanucA, System::Haas];
const ABH: &[System] = &[System::FanucA, System::FanucB, System::Haas];
const B: &[System] = &[System::FanucB];
const C: &[System] = &[System::FanucC];
const BC: &[System] = &[System::FanucB, System::FanucC];
const HAAS: &[System] = &[System::Haas];
const ANY: &[System] = &[];
const SIEMENS: &[System] = &[System::Sinumerik];
const LINUXCNC: &[System] = &[System::LinuxCnc];

const fn sign(
    kind: Kind,
    weight: i8,
    shape: Pattern,
    systems: &'static [System],
    label: &'static str,
    source: &'static str,
) -> Sign {
    Sign { kind, weight, shape, systems, label, source }
}

use Kind::{Heidenhain, Lathe, Mazatrol, Okuma, Printer, Text, WireEdm};
use Pattern::{Begins, Block as Words, Course, Name, Says};

/// The table.
#[rustfmt::skip]
pub const SIGNS: &[Sign] = &[
    // Lathes: cycles that no mill has in these words.
    sign(Lathe, 3, Words("G71 P Q !Y"), ABH, "G71 P Q is a roughing cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G72 P Q !Y"), ABH, "G72 P Q is a facing cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G73 P Q U !Y"), ABH, "G73 P Q U is a pattern-repeating cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G73 P Q W !Y"), ABH, "G73 P Q W is a pattern-repeating cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G70 P Q !Y"), ABH, "G70 P Q is a finishing cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G71 U R !Y !X"), ABH, "G71 U R is a roughing cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G72 W R !Y !X"), ABH, "G72 W R is a facing cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G73 U W R !Y !X"), ABH, "G73 U W R is a pattern-repeating cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G71 P Q D !Y"), HAAS, "G71 P Q D is a roughing cycle of a Haas lathe", HAAS_T),
    sign(Lathe, 3, Words("G76 X Z P Q F !Y !R"), ABH, "G76 X Z P Q F is a threading cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G76 P Q R !X !Y !Z !F"), ABH, "G76 P Q R begins a threading cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G76 X Z K D F !Y"), HAAS, "G76 X Z K D F is a threading cycle of a Haas lathe", HAAS_T),
    sign(Lathe, 3, Words("G76 P Z I J K !Y"), LINUXCNC, "G76 P Z I J K is a threading cycle of a lathe", LINUXCNC_T),
    sign(Lathe, 3, Words("G92 X Z F !Y !S"), AH, "G92 X Z F is a threading cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G92 X W F !Y !S"), AH, "G92 X W F is a threading cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G77 X Z F !Y !R !I !J !L"), B, "G77 X Z F is a turning cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G78 X Z F !Y !R !I !J !L"), B, "G78 X Z F is a threading cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G79 X Z F !Y !R !I !J !L"), B, "G79 X Z F is a facing cycle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G24 X Z F !Y"), C, "G24 X Z F is a facing cycle of a lathe", FANUC_T),
    sign(Lathe, 2, Course(Sort::RepeatedCycle(900)), AH, "G90 X Z F, then X or Z alone: a turning cycle", FANUC_T),
    sign(Lathe, 2, Course(Sort::RepeatedCycle(940)), AH, "G94 X Z F, then X or Z alone: a facing cycle", FANUC_T),
    sign(Lathe, 2, Course(Sort::RepeatedCycle(200)), C, "G20 X Z F, then X or Z alone: a turning cycle", FANUC_T),
    sign(Lathe, 2, Course(Sort::RepeatedCycle(210)), C, "G21 X Z F, then X or Z alone: a threading cycle", FANUC_T),
    sign(Lathe, 2, Words("G74 Z Q F !Y !R"), ABH, "G74 Z Q F is a drilling cycle of a lathe", FANUC_T),
    sign(Lathe, 2, Words("G75 X F !Y !J"), ABH, "G75 X F is a grooving cycle of a lathe", FANUC_T),
    sign(Lathe, 2, Words("G75 X I !Y !J"), HAAS, "G75 X I is a grooving cycle of a Haas lathe", HAAS_T),
    sign(Lathe, 3, Words("G32 Z F !Y"), AH, "G32 Z F cuts a thread on a lathe", FANUC_T),
    sign(Lathe, 2, Words("G33 Z F X !Y"), BC, "G33 X Z F cuts a thread on a lathe", FANUC_T),
    // Lathes: words.
    sign(Lathe, 3, Words("G50 S !X !Y !Z"), AH, "G50 S limits the spindle of a lathe", FANUC_T),
    sign(Lathe, 2, Words("G92 S !X !Y !Z"), BC, "G92 S limits the spindle of a lathe", FANUC_T),
    sign(Lathe, 3, Words("G28 U W !Y"), AH, "U and W are the lathe's incremental X and Z", FANUC_T),
    sign(Lathe, 3, Words("G28 U !Y !V"), AH, "G28 U is the lathe's X to its reference point", FANUC_T),
    sign(Lathe, 3, Words("G30 U W !Y"), AH, "U and W are the lathe's incremental X and Z", FANUC_T),
    sign(Lathe, 3, Words("G30 U !Y !V"), AH, "G30 U is the lathe's X to a reference point", FANUC_T),
    sign(Lathe, 3, Words("U W X !Y !V !G10"), AH, "U and W are the lathe's incremental X and Z", FANUC_T),
    sign(Lathe, 2, Words("U Z !Y !V !G10"), AH, "U is the lathe's incremental X", FANUC_T),
    sign(Lathe, 2, Words("W X !Y !V !G10"), AH, "W is the lathe's incremental Z", FANUC_T),
    sign(Lathe, 3, Course(Sort::OffsetCancelled), ANY, "the tool's offset is cancelled by T with 00, as on a lathe", FANUC_T),
    sign(Lathe, 2, Course(Sort::ToolWithOffset), ANY, "a T word with tool and offset, and never M06", FANUC_T),
    sign(Lathe, 2, Course(Sort::Turret), ANY, "several tools, never M06 and never a Y: a turret", WRITTEN),
    sign(Lathe, 2, Course(Sort::SurfaceSpeed), ANY, "G96 or G97 and never a Y: a turned part", FANUC_T),
    sign(Lathe, 2, Course(Sort::FeedPerTurn), AH, "G98 or G99 with such a feed counts revolutions", FANUC_T),
    sign(Lathe, 3, Course(Sort::TurnedFeed), ANY, "G95 with X and Z, and never a Y: a turned part", WRITTEN),
    sign(Lathe, 2, Course(Sort::LowFeed), ANY, "a feed as low as this counts revolutions", WRITTEN),
    sign(Lathe, 3, Name("DIAMON"), SIEMENS, "DIAMON: X counts the diameter", SIEMENS_T),
    sign(Lathe, 3, Name("DIAM90"), SIEMENS, "DIAM90: X counts the diameter", SIEMENS_T),
    sign(Lathe, 2, Name("LIMS"), SIEMENS, "LIMS limits the spindle of a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE93"), SIEMENS, "CYCLE93 cuts a groove on a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE94"), SIEMENS, "CYCLE94 cuts an undercut on a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE95"), SIEMENS, "CYCLE95 is a roughing cycle of a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE96"), SIEMENS, "CYCLE96 cuts an undercut on a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE97"), SIEMENS, "CYCLE97 is a threading cycle of a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE98"), SIEMENS, "CYCLE98 is a threading cycle of a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE99"), SIEMENS, "CYCLE99 is a threading cycle of a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE930"), SIEMENS, "CYCLE930 cuts a groove on a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE940"), SIEMENS, "CYCLE940 cuts an undercut on a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE951"), SIEMENS, "CYCLE951 is a roughing cycle of a lathe", SIEMENS_T),
    sign(Lathe, 3, Name("CYCLE952"), SIEMENS, "CYCLE952 is a roughing cycle of a lathe", SIEMENS_T),
    sign(Lathe, 3, Words("G7 !X !Y !Z !A !B !C !P"), LINUXCNC, "G7: X counts the diameter", LINUXCNC_T),
    sign(Lathe, 3, Words("G8 !X !Y !Z !A !B !C !P"), LINUXCNC, "G8: X counts the radius of a lathe", LINUXCNC_T),
    // Lathes: hints.
    sign(Lathe, 1, Words("G18 !G17 !G19 !G2 !G3"), ANY, "G18 is the plane of a lathe", FANUC_T),
    sign(Lathe, 1, Course(Sort::NoY), ANY, "moves of X and Z, and never a Y", WRITTEN),
    sign(Lathe, 1, Course(Sort::TurnersWord), ANY, "the comment speaks of turning", WRITTEN),

    // Heidenhain.
    sign(Heidenhain, 3, Begins("BEGIN PGM"), ANY, "BEGIN PGM begins a Heidenhain program", HEIDENHAIN),
    sign(Heidenhain, 3, Begins("END PGM"), ANY, "END PGM ends a Heidenhain program", HEIDENHAIN),
    sign(Heidenhain, 3, Begins("TOOL CALL"), ANY, "TOOL CALL is a Heidenhain block", HEIDENHAIN),
    sign(Heidenhain, 3, Begins("TOOL DEF"), ANY, "TOOL DEF is a Heidenhain block", HEIDENHAIN),
    sign(Heidenhain, 3, Begins("CYCL DEF"), ANY, "CYCL DEF is a Heidenhain cycle", HEIDENHAIN),
    sign(Heidenhain, 3, Begins("CYCL CALL"), ANY, "CYCL CALL is a Heidenhain block", HEIDENHAIN),
    sign(Heidenhain, 3, Begins("BLK FORM"), ANY, "BLK FORM is a Heidenhain block", HEIDENHAIN),
    sign(Heidenhain, 3, Begins("CALL LBL"), ANY, "CALL LBL is a Heidenhain block", HEIDENHAIN),
    sign(Heidenhain, 3, Begins("CALL PGM"), ANY, "CALL PGM is a Heidenhain block", HEIDENHAIN),
    sign(Heidenhain, 2, Begins("LBL "), ANY, "LBL is a Heidenhain label", HEIDENHAIN),
    sign(Heidenhain, 2, Begins("FN 0:"), ANY, "FN 0 is a Heidenhain function", HEIDENHAIN),
    sign(Heidenhain, 2, Begins("FN0:"), ANY, "FN 0 is a Heidenhain function", HEIDENHAIN),
    sign(Heidenhain, 3, Course(Sort::ConversationalMove), ANY, "L X+ with R0 or FMAX is a Heidenhain move", HEIDENHAIN),
    sign(Heidenhain, 3, Course(Sort::IsoHeading), ANY, "this heading is Heidenhain's DIN/ISO", HEIDENHAIN),

    // Okuma.
    sign(Okuma, 3, Says(".MIN%"), ANY, "a heading with .MIN% is Okuma's", OKUMA),
    sign(Okuma, 3, Course(Sort::OkumaCall), ANY, "CALL O calls a subprogram of an Okuma", OKUMA),
    sign(Okuma, 2, Begins("RTS"), ANY, "RTS ends a subprogram of an Okuma", OKUMA),
    sign(Okuma, 3, Begins("MODIN O"), ANY, "MODIN is a modal call of an Okuma", OKUMA),
    sign(Okuma, 3, Name("MODOUT"), ANY, "MODOUT ends a modal call of an Okuma", OKUMA),
    sign(Okuma, 3, Name("NOEX"), ANY, "NOEX is a word of an Okuma", OKUMA),
    sign(Okuma, 3, Name("SB"), ANY, "SB= is the speed of an Okuma's driven tool", OKUMA),
    sign(Okuma, 3, Says("G20 HP="), ANY, "G20 HP= is an Okuma's home position", OKUMA),
    sign(Okuma, 3, Begins("DEF WORK"), ANY, "DEF WORK describes an Okuma's blank", OKUMA),
    sign(Okuma, 2, Course(Sort::CommonVariable), ANY, "VC is a common variable of an Okuma", OKUMA),
    sign(Okuma, 3, Course(Sort::SystemVariable), ANY, "this is a system variable of an Okuma", OKUMA),
    sign(Okuma, 2, Course(Sort::LetteredProgram), ANY, "O with letters names a program of an Okuma", OKUMA),
    sign(Okuma, 3, Course(Sort::NamedBlock), ANY, "a block with a name is an Okuma's", OKUMA),
    sign(Okuma, 2, Course(Sort::SixDigitTool), ANY, "T with six digits: nose radius, tool and offset", OKUMA),
    sign(Okuma, 3, Words("G15 H !G43 !G44"), ANY, "G15 H is an Okuma's work offset", OKUMA),
    sign(Okuma, 3, Words("G16 H !G43 !G44"), ANY, "G16 H is an Okuma's work offset", OKUMA),

    // Mazatrol.
    sign(Mazatrol, 3, Name("MAZATROL"), ANY, "the text names Mazatrol", MAZATROL),
    sign(Mazatrol, 3, Begins("UNO. UNIT"), ANY, "UNo. UNIT heads a unit of Mazatrol", MAZATROL),
    sign(Mazatrol, 3, Begins("UNO UNIT"), ANY, "UNo. UNIT heads a unit of Mazatrol", MAZATROL),
    sign(Mazatrol, 3, Begins("UNO. MAT."), ANY, "UNo. MAT. heads a Mazatrol program", MAZATROL),
    sign(Mazatrol, 2, Begins("SNO. "), ANY, "SNo. heads a tool sequence of Mazatrol", MAZATROL),
    sign(Mazatrol, 2, Begins("FIG "), ANY, "FIG heads a shape sequence of Mazatrol", MAZATROL),

    // Wire EDM.
    sign(WireEdm, 3, Words("M80 M82 M84"), ANY, "M80 M82 M84 start wire and dielectric", EDM),
    sign(WireEdm, 3, Words("T84 T86"), ANY, "T84 T86 start pump and wire", EDM),
    sign(WireEdm, 2, Words("only T84"), ANY, "T84 starts the pump of a wire EDM", EDM),
    sign(WireEdm, 2, Words("only T86"), ANY, "T86 starts the wire", EDM),
    sign(WireEdm, 2, Words("only G38"), ANY, "G38 alone: corners of a wire EDM", EDM),
    sign(WireEdm, 2, Words("only G39"), ANY, "G39 alone: corners of a wire EDM", EDM),
    sign(WireEdm, 2, Course(Sort::OffsetAssigned), ANY, "an offset is given its value by H=", EDM),
    sign(WireEdm, 2, Course(Sort::CuttingCondition), ANY, "E with four digits names a cutting condition", EDM),
    sign(WireEdm, 1, Course(Sort::OriginWithoutZ), ANY, "G92 X Y and never a Z", EDM),
    sign(WireEdm, 3, Says("ON OFF IP HRP"), ANY, "a table of cutting conditions of a wire EDM", EDM),
    sign(WireEdm, 2, Says("WIRE EDM"), ANY, "the comment names a wire EDM", EDM),
    sign(WireEdm, 2, Words("G50 A !X !Z"), ANY, "G50 A ends a wire's taper", EDM),
    sign(WireEdm, 2, Words("G51 A !Z !P !I"), ANY, "G51 A tilts the wire", EDM),
    sign(WireEdm, 2, Words("G52 A !Z"), ANY, "G52 A tilts the wire", EDM),

    // 3-D printers.
    sign(Printer, 3, Words("M104 S"), ANY, "M104 S heats a nozzle", MARLIN),
    sign(Printer, 3, Words("M109 S"), ANY, "M109 S waits for a nozzle's temperature", MARLIN),
    sign(Printer, 3, Words("M109 R"), ANY, "M109 R waits for a nozzle's temperature", MARLIN),
    sign(Printer, 3, Words("M140 S"), ANY, "M140 S heats a printer's bed", MARLIN),
    sign(Printer, 3, Words("M190 S"), ANY, "M190 S waits for a bed's temperature", MARLIN),
    sign(Printer, 3, Words("M190 R"), ANY, "M190 R waits for a bed's temperature", MARLIN),
    sign(Printer, 3, Words("G92 E !X !Y"), ANY, "G92 E sets the extruder's place", MARLIN),
    sign(Printer, 2, Words("only M82"), ANY, "M82 alone: the extruder's E is absolute", MARLIN),
    sign(Printer, 2, Words("only M83"), ANY, "M83 alone: the extruder's E is relative", MARLIN),
    sign(Printer, 2, Words("M106 S"), ANY, "M106 S sets the speed of a fan", MARLIN),
    sign(Printer, 1, Words("only M107"), ANY, "M107 alone stops a fan", MARLIN),
    sign(Printer, 1, Words("only M84"), ANY, "M84 alone releases the motors", MARLIN),
    sign(Printer, 3, Course(Sort::Extrusion), ANY, "X Y E: the extruder moves with the axes", MARLIN),
    sign(Printer, 3, Says(";FLAVOR:"), ANY, "a slicer wrote this line", MARLIN),
    sign(Printer, 3, Says(";LAYER:"), ANY, "a slicer wrote this line", MARLIN),
    sign(Printer, 3, Says(";LAYER_CHANGE"), ANY, "a slicer wrote this line", MARLIN),
    sign(Printer, 2, Says("FILAMENT"), ANY, "the text speaks of filament", MARLIN),

    // Sentences.
    sign(Text, 3, Course(Sort::Prose), ANY, "words, and no block of a program", WRITTEN),
];

/// A pattern made ready.
#[derive(Debug)]
pub(super) enum Shape {
    /// As of [`Pattern::Block`].
    Block {
        /// Letters that must be there, those of the codes too.
        letters: u32,
        /// Letters that must not.
        none: u32,
        /// Codes that must be there, in tenths.
        codes: Vec<(u8, u32)>,
        /// Codes that must not.
        not: Vec<(u8, u32)>,
        /// Whether there must be no other word.
        only: bool,
    },
    /// As of [`Pattern::Name`].
    Name(&'static str),
    /// As of [`Pattern::Begins`].
    Begins(&'static str),
    /// As of [`Pattern::Says`].
    Says(Box<memchr::memmem::Finder<'static>>, usize),
    /// Nothing that a block alone can show.
    Course,
}

/// The patterns of the table, in its order.
pub(super) fn shapes() -> &'static [Shape] {
    static SHAPES: LazyLock<Vec<Shape>> =
        LazyLock::new(|| SIGNS.iter().map(|sign| Shape::from_pattern(sign.shape)).collect());
    &SHAPES
}

impl Shape {
    fn from_pattern(pattern: Pattern) -> Shape {
        let words = match pattern {
            Pattern::Block(words) => words,
            Pattern::Name(name) => return Shape::Name(name),
            Pattern::Begins(text) => return Shape::Begins(text),
            Pattern::Says(text) => {
                return Shape::Says(Box::new(memchr::memmem::Finder::new(text)), text.len());
            }
            Pattern::Course(_) => return Shape::Course,
        };
        let (mut letters, mut none, mut only) = (0, 0, false);
        let (mut codes, mut not) = (Vec::new(), Vec::new());
        for word in words.split(' ') {
            let (refused, word) = word.strip_prefix('!').map_or((false, word), |word| (true, word));
            let letter = word.as_bytes()[0];
            let code = word[1..].parse::<u32>().ok().map(|number| (letter, number * 10));
            match (refused, code) {
                _ if word == "only" => only = true,
                (false, Some(code)) => {
                    letters |= bit(letter);
                    codes.push(code);
                }
                (true, Some(code)) => not.push(code),
                (false, None) => letters |= bit(letter),
                (true, None) => none |= bit(letter),
            }
        }
        Shape::Block { letters, none, codes, not, only }
    }

    /// Whether it is of words, and a block with these letters may show it.
    pub(super) fn fits(&self, own: u32) -> bool {
        matches!(self, Shape::Block { letters, none, .. } if own & letters == *letters && own & none == 0)
    }

    /// Its place in a block that shows it.
    pub(super) fn place(&self, block: &Block) -> Option<Range<usize>> {
        match self {
            Shape::Block { letters, none, codes, not, only } => {
                let fits = block.letters & letters == *letters
                    && block.letters & none == 0
                    && codes.iter().all(|(letter, code)| block.code(*letter, *code))
                    && !not.iter().any(|(letter, code)| block.code(*letter, *code))
                    && (!only
                        || block.words.iter().filter(|word| word.letter != b'N').count() == codes.len());
                if !fits {
                    return None;
                }
                let shown = block.words.iter().filter(|word| letters & bit(word.letter) != 0);
                let shown: Vec<&Range<usize>> = shown.map(|word| &word.place).collect();
                Some(shown.first()?.start..shown.last()?.end)
            }
            Shape::Name(name) => {
                block.names.iter().find(|(own, _)| own == name.as_bytes()).map(|(_, place)| place.clone())
            }
            Shape::Begins(text) => {
                let numbered = |b: &&u8| b.is_ascii_digit() || b.is_ascii_whitespace();
                let mut rest = &block.text[..];
                if let [b'N', b'0'..=b'9', ..] = rest {
                    rest = &rest[1..];
                }
                let skipped = block.text.len() - rest.len() + rest.iter().take_while(numbered).count();
                let length = begins(&block.text[skipped..], text.as_bytes())?;
                let start = block.place.start + skipped;
                Some(start..start + length)
            }
            Shape::Says(finder, length) => {
                let at = block.place.start + finder.find(&block.text)?;
                Some(at..at + length)
            }
            Shape::Course => None,
        }
    }
}

/// Whether a line begins with words; a blank in them stands for one or more. Gives how far they go.
fn begins(line: &[u8], words: &[u8]) -> Option<usize> {
    let mut at = 0;
    for byte in words {
        if *byte == b' ' {
            let blanks = line[at..].iter().take_while(|b| b.is_ascii_whitespace()).count();
            if blanks == 0 {
                return None;
            }
            at += blanks;
        } else {
            if line.get(at) != Some(byte) {
                return None;
            }
            at += 1;
        }
    }
    // A name that goes on is another one; after `CALL O` its number follows.
    let goes_on = line.get(at).is_some_and(u8::is_ascii_alphabetic) && words.last() != Some(&b'O');
    (!goes_on || words.last() == Some(&b' ')).then_some(at)
}
