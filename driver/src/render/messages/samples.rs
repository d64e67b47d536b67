//! Each message once, with values: every entry of `messages/` is found, has its values, and keeps its length.

use ncc_ir::alarms::{AlarmMapped, AlarmName};
use ncc_ir::syntax::{Expected, Found, Ranged};
use ncc_ir::unsupported::left_out::LeftOut;
use std::collections::BTreeSet;

use ncc_dialects::Dialect;
use ncc_ir::behaviour::{Behaviour, Kept};
use ncc_ir::canon::{Axis, Turn};
use ncc_ir::compensated::kind::{CompensationRefusal, Kind};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{ArgumentCheck, Fault, FileNeeds, ModeName};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::geometry::offset_path::Unreachable;
use ncc_ir::lack::{ExpandedContour, FramesLack, Lack, OutsideFrame, TapValue};
use ncc_ir::program::numbered::Numbered;
use ncc_ir::reason::{Reason, Values, Variants};
use ncc_ir::run_time::{ComputedFrame, RunTime, RunTimeFlow};
use ncc_ir::unexecuted::{FlowUnexecuted, NoCorner, Unexecuted, ValueUnexecuted};
use ncc_ir::unsupported::{FunctionFailure, Unsupported, ValueUnsupported};

use super::advice::advice;
use super::codes::typed;
use super::context::Context;
use super::facts::message;
use super::files::{FILES, Files};
use super::message::{Help, Message, Part};
use super::words::words;

/// A headline has at most so many characters, and a label: the form of a message, with short values.
const HEADLINE: usize = 70;
const LABEL: usize = 60;

/// Codes with an entry for each reason.
const REASONED: [u16; 6] = [501, 226, 233, 250, 202, 244];

/// A text in the samples, as short as a word of a block.
fn t() -> Box<str> {
    "X1.".into()
}

/// A dialect.
fn dialect(id: &str) -> &'static Dialect {
    ncc_dialects::builtin(id).unwrap()
}

/// Faults of each code, and of each form of a code.
fn samples() -> Vec<Fault> {
    let mut all = text_and_meaning();
    all.extend(forms_and_ranges());
    all.extend(assumed());
    all.extend(became());
    all.extend(target_and_verification());
    all
}

fn text_and_meaning() -> Vec<Fault> {
    use Fault::*;
    vec![
        UnexpectedCharacter { found: '.' },
        UnexpectedCharacter { found: '\r' },
        UnexpectedCharacter { found: ')' },
        BadNumber { text: t() },
        UnclosedComment,
        BlockTooLong { limit: 1000 },
        NotText,
        WordWithoutNumber { letter: 'X' },
        LetterOForZero,
        EmptyProgram,
        NoProgramEnd,
        TextAfterEnd,
        TextBeforeStart { mark: "%".into() },
        OpeningMarkMissing { mark: "%".into(), follows: false },
        OpeningMarkMissing { mark: "%".into(), follows: true },
        LabelTwice { name: "N10".into() },
        ComparedLast { what: "EQ".into() },
        UnknownCode { code: "G123".into() },
        UnknownCode { code: "M46".into() },
        NotSupported { code: "G12".into(), what: Unsupported::named("circular pocket, clockwise") },
        NotSupported { code: "M31".into(), what: Unsupported::named("chip conveyor forward") },
        NotSupported { code: "#3000".into(), what: ValueUnsupported::Control.into() },
        CodesExclude { first: "G90".into(), second: "G91".into() },
        WordUnused { word: t() },
        WordMissing { code: "G41".into(), word: "D".into() },
        WordMissing { code: "G43".into(), word: "H".into() },
        WordMissing { code: "G83".into(), word: "R".into() },
        WordMissing { code: "G28".into(), word: "X".into() },
        WordTwice { letter: 'X' },
        TooManyCodes { letter: 'M', limit: 1 },
        PointNotAllowed { word: "S5000.".into() },
        PointNotAllowed { word: "P1.5".into() },
        NoMotionMode,
        ArcWithoutCentre,
        ArcCentreAndRadius,
        ArcEndOffCircle { radii: [1_000_000_000, 1_020_000_000], allowed: 10_000_000 },
        ArcRadiusTooSmall,
        ArcRadiusNoWay,
        PositionUnknown { axis: 'Z' },
        CallUnknown { name: "2000".into() },
        CallRecursive { name: "2000".into() },
        CallsTooDeep { name: "2000".into(), most: 64 },
        ProgramTwice { name: "2000".into() },
        MacroLanguage { what: "POPEN".into() },
        MacroLanguage { what: "M#101".into() },
        NoToolSelected,
        NoFeed,
        NoCycle,
        CycleUpsideDown,
        EntryFactNeeded { fact: ModeName::Units },
        EntryFactNeeded { fact: ModeName::Plane },
        NotExecuted { what: ValueUnexecuted::PeckClearanceUnknown.into() },
        NotExecuted { what: FlowUnexecuted::Jump.into() },
        NoEnd { steps: 10_000_000 },
        Interrupted { steps: 1_000 },
        LabelUnknown { name: "N10".into() },
        NoArc,
        NoSpeed,
        SpindleForCycle { turn: None, by_target: true },
        SpindleForCycle { turn: Some(Turn::Clockwise), by_target: false },
        SpindleForCycle { turn: Some(Turn::Counterclockwise), by_target: false },
        NoValue { why: ncc_ir::diag::NoValue::Index },
        VariableUnset { name: "101".into() },
        Computes { what: RunTimeFlow::Jump.into() },
        Endless,
        RefusedCompensated { what: CompensationRefusal::Code { code: "G28".into() } },
        RefusedCompensated { what: CompensationRefusal::Kind(Kind::ReturnLevel) },
        BeginsOtherwise { fact: ModeName::Distance },
        RadiusUnknown { entry: Some(12) },
        RadiusUnknown { entry: None },
        ContourUnreachable { why: Unreachable::ShortLine },
        NoCorner { why: ncc_ir::unexecuted::NoCorner::NoSize },
        FunctionNotRun { name: "G200".into(), program: "python3 g200.py".into() },
        FunctionFailed {
            name: "G200".into(),
            program: "python3 g200.py".into(),
            why: FunctionFailure::NoOutput,
            said: "Traceback".into(),
        },
    ]
}

fn forms_and_ranges() -> Vec<Fault> {
    use Fault::*;
    vec![
        Syntax { found: "(".into(), expected: Expected::Word },
        Syntax { found: Found::EndOfLine, expected: Expected::Word },
        Syntax { found: Found::EndOfBlock, expected: Expected::Word },
        Syntax { found: Found::EndOfText, expected: Expected::Word },
        Syntax { found: Found::Line, expected: Expected::Word },
        Syntax { found: Found::ManyWords, expected: Expected::Word },
        Syntax { found: "5".into(), expected: Expected::Text("]".into()) },
        Syntax { found: "5".into(), expected: Expected::Word },
        Syntax { found: "5".into(), expected: Expected::WordOrNumber },
        Syntax { found: "5".into(), expected: Expected::Number },
        Syntax { found: "5".into(), expected: Expected::NumberOrNothing },
        Syntax { found: "5".into(), expected: Expected::WholeNumber },
        Syntax { found: "5".into(), expected: Expected::QuotedText },
        Syntax { found: "5".into(), expected: Expected::PlainEscapes },
        Syntax { found: "5".into(), expected: Expected::Name },
        Syntax { found: "5".into(), expected: Expected::OneOf("on, off".into()) },
        Syntax { found: "5".into(), expected: Expected::Path },
        Syntax { found: "5".into(), expected: Expected::Type },
        Syntax { found: "5".into(), expected: Expected::Jump },
        Syntax { found: "5".into(), expected: Expected::Expression },
        Syntax { found: "5".into(), expected: Expected::Statement },
        Syntax { found: "5".into(), expected: Expected::Block },
        Syntax { found: "5".into(), expected: Expected::OperatorOrEnd },
        Syntax { found: "5".into(), expected: Expected::EndOfBlock },
        Syntax { found: "5".into(), expected: Expected::EndOfLine },
        Syntax { found: "5".into(), expected: Expected::BodyAtEnd },
        Syntax { found: "5".into(), expected: Expected::EndOfBody },
        Syntax { found: "5".into(), expected: Expected::EndOfBodyAlone },
        Syntax { found: "5".into(), expected: Expected::Words { most: 9 } },
        Syntax { found: "5".into(), expected: Expected::Bodies { most: 9 } },
        Syntax { found: "5".into(), expected: Expected::PointOfPlane },
        Syntax { found: "5".into(), expected: Expected::RotaryAxis },
        Syntax { found: "5".into(), expected: Expected::StraightMove },
        OutOfRange { word: t().into() },
        OutOfRange { word: Ranged::Unnamed },
        OutOfRange { word: Ranged::TooLarge { about: 2_745_678 } },
        OutOfRange { word: Ranged::Turns },
        OutOfRange { word: Ranged::Holes },
        OutOfRange { word: Ranged::PeckDepth },
        OutOfRange { word: Ranged::LengthSum },
        OutOfRange { word: Ranged::TurnAngle },
        OutOfRange { word: Ranged::HighestSpeed },
        OutOfRange { word: Ranged::PointNumber },
        OutOfRange { word: Ranged::StoredPosition },
        OutOfRange { word: Ranged::SkipLevel },
    ]
}

fn assumed() -> Vec<Fault> {
    use Fault::*;
    vec![
        AssumedMode { fact: ModeName::Plane, value: "G17".into() },
        AssumedMode { fact: ModeName::WorkOffset, value: "G54".into() },
        AssumedNoEffect { code: "M46".into() },
        AssumedFunction { name: "G200".into(), program: "python3 g200.py".into() },
        AssumedBareNumber { word: "X100".into(), value: "100 mm".into() },
        AssumedOffsetWithZ,
        AssumedWorkOffset { offset: 1 },
        AssumedRow { code: "G12".into(), meaning: "pocket".into() },
        AssumedOption { option: "first_tool".into(), value: "none".into() },
        AssumedFact { fact: ControlFact::InexactComparison },
        AssumedHoleOrder { pattern: "grid".into() },
        AssumedEdge { tool: 12 },
        AssumedPath { path: "exact stop".into() },
        AssumedContourEnds,
        AssumedRadius { entry: 12 },
        AssumedTip,
        AssumedTilt,
        AssumedControl { taken: "fanuc".into(), other: "haas".into() },
        AssumedToolChange { named: 2, waiting: 3 },
        AssumedReturn { code: "G28".into(), words: t(), zero: false, last: true },
        AssumedReturn { code: "G28".into(), words: t(), zero: false, last: false },
        AssumedReturn { code: "G28".into(), words: t(), zero: true, last: false },
        CallDepth { depth: 6, sure: 4, macros: false },
        CallDepth { depth: 6, sure: 4, macros: true },
        AssumedCycle { cycle: "G81".into(), motion: "G00".into() },
        StartedAgain { behaviour: Behaviour::SpindleAtChange },
        OpenBehaviour {
            behaviour: Behaviour::SpindleAtChange,
            source: true,
            taken: "stops",
            other: "goes-on",
        },
        OpenBehaviour { behaviour: Behaviour::VariablesAtEnd, source: true, taken: "kept", other: "lost" },
        MovedAtChange,
        OptionalStopDiffers,
        PathAtStart { source: "exact-stop", target: "rounded" },
        PathAtStart { source: "within", target: "blended" },
        NextRunShifted { axis: Axis::X, source: 0, target: 10_000_000_000 },
        NextRunTurned,
        NextRunVariables { names: ["500".into()].into(), source: Kept::Always, target: Kept::UntilEnd },
        RoundsFreely,
        FeedOnArcs { contour_in_source: true, inner: true },
        FeedOnArcs { contour_in_source: false, inner: true },
        FeedOnArcs { contour_in_source: false, inner: false },
        FeedAtUnits { before: 1_000_000_000, now: 1_000_000_000 },
        FeedAtUnits { before: 1_000_000_000, now: 25_400_000_000 },
        AssumedContourPath,
        LengthByHand { tool: 12 },
        AssumedMilling { looks_like: "a lathe program".into(), line: 3 },
        ToolNumbered { name: "DRILL".into(), number: 3 },
        EdgeNumbered { tool: 12, edge: 2, entry: 41 },
    ]
}

fn became() -> Vec<Fault> {
    use Fault::*;
    vec![
        CommentReformatted,
        ArcReformatted,
        Rounded { word: t(), written: t() },
        PatternExpanded { holes: 6 },
        CycleExpanded { kind: "peck drilling".into() },
        CallExpanded { name: "2000".into(), times: 1 },
        SkipLevelLost { level: 2 },
        NumbersLeftOut { count: 12 },
        NameAsComment,
        BlockSplit,
        MessageDropped,
        CodeLeftOut { what: LeftOut::Code { code: t() } },
        CodeLeftOut { what: LeftOut::RapidRate { code: t() } },
        CodeLeftOut { what: LeftOut::ReadAs { code: t(), other: t() } },
        CodeLeftOut { what: LeftOut::WithoutAxis { code: t() } },
        CodeLeftOut { what: LeftOut::WithoutLetter { code: t(), letter: 'D' } },
        CodeLeftOut { what: LeftOut::Call { name: t() } },
        CodeLeftOut { what: LeftOut::Dwell { code: t() } },
        CodeLeftOut { what: LeftOut::Assignment { name: t() } },
        MessageAsComment,
        RepeatExpanded { times: 3 },
        FramesExpanded,
        CycleFolded { kind: "G83".into(), holes: 12 },
        PatternFolded { pattern: "bolt circle".into(), holes: 6, digits: 3, inch: false },
        NameChanged { from: "O1".into(), to: "PART".into() },
        PathRelaxed { from: "exact-stop".into(), to: "blended".into() },
        PathRelaxed { from: "slow-corners".into(), to: "blended".into() },
        PathRelaxed { from: "tapping".into(), to: "blended".into() },
        AdviceLeftOut { kind: "look-ahead".into() },
        WorkOffsetLeftOut { offset: 7 },
        Flattened { blocks: 1000 },
        VariablesRenamed { map: "#1 is R1".into() },
        AlarmsRenumbered {
            map: [AlarmMapped { from: AlarmName::Number(1), to: AlarmName::Number(65_001), text: None }]
                .into(),
        },
        AlarmsRenumbered {
            map: [AlarmMapped { from: AlarmName::Text(t()), to: AlarmName::Number(1), text: Some(t()) }]
                .into(),
        },
        ValuesInFull { digits: 3 },
        OutputDropped,
        MacroCloned { name: "O9010".into(), names: "O9010 and O9011".into() },
        AlarmValues,
        SideEffectWritten { behaviour: Behaviour::FeedOnArcs },
        SideEffectWritten { behaviour: Behaviour::SpindleAtChange },
        MachineCutExpanded { offset: 1 },
        MachineCutFolded { digits: 3, inch: false },
        PeckShortened,
        PolarExpanded,
        CompensationExpanded { radius: 5_000_000_000 },
        FeedByTime,
        CornerExpanded,
    ]
}

fn target_and_verification() -> Vec<Fault> {
    use Fault::*;
    let needs = [
        FileNeeds::Place(Axis::Y),
        FileNeeds::PlaceInInches(Axis::Y),
        FileNeeds::AnotherTool,
        FileNeeds::Feed,
        FileNeeds::Speed,
        FileNeeds::Shift,
        FileNeeds::Length,
        FileNeeds::Cycle,
        FileNeeds::Compensation,
        FileNeeds::TableValue,
        FileNeeds::Setting,
        FileNeeds::Switch,
        FileNeeds::ToolNumber,
        FileNeeds::Control,
    ];
    let checks = [
        ArgumentCheck::NotAsked,
        ArgumentCheck::Nothing,
        ArgumentCheck::Whole,
        ArgumentCheck::LeftOut,
        ArgumentCheck::Default(Num::int(5, Unit::One)),
    ];
    let mut all = vec![
        TargetLacks { lack: FramesLack::Mirror.into() },
        SecondWorkOffset { first: 1, second: 2 },
        ArcVanishes,
        TargetRange { word: t() },
        ProfileDenies { fact: "metric".into(), machine: "mill".into() },
        NotInMap { what: Numbered::Tool, number: 12, name: None },
        NotInMap { what: Numbered::LengthEntry, number: 12, name: Some("DRILL".into()) },
        DoneByTarget { behaviour: Behaviour::ZAtChange },
        DoneByTarget { behaviour: Behaviour::SpindleAtChange },
        MustBeStated { behaviour: Behaviour::SpindleAtChange },
        ModeNotSet { fact: ModeName::Plane },
        RotaryTurnOpen { axis: Axis::A, by: 350_000_000_000, or: -10_000_000_000 },
        CallsDeeper { name: "2000".into(), depth: 6, most: 4, macros: false },
        CallsDeeper { name: "2000".into(), depth: 6, most: 4, macros: true },
        ArcRadiiDiffer { radii: [1_000_000_000, 1_020_000_000], allowed: 10_000_000 },
        CompensatedThere { kind: Kind::WorkOffset },
        NotTheSame { difference: "X".into() },
        NotReadBack { code: 101 },
        SkipSettingsSampled { levels: 8 },
        VariableGiven { name: "500".into() },
        BranchUncovered { holds: true, fails: true },
        BranchUncovered { holds: true, fails: false },
        BranchUncovered { holds: false, fails: true },
        OutputNotTaken { blocks: "N10".into() },
        FactNotTried { behaviour: Some(Behaviour::SpindleAtChange), source: true },
        FactNotTried { behaviour: None, source: true },
        ValueNotRead { name: "500".into() },
        NotCalled { name: "O2000".into() },
        CutStanding,
    ];
    all.extend(needs.map(|needs| NoFileOfTool { needs }));
    all.extend(checks.map(|check| ArgumentNeeded { name: "#9".into(), place: 0, check }));
    all
}

/// Formatting checks by itself that an entry is there, parses, and has a value for each of its variables.
#[test]
fn every_fault_has_its_words() {
    let mut codes: Vec<u16> = Vec::new();
    let mut long = Vec::new();
    for fault in samples() {
        for (from, to) in
            [("fanuc", "siemens"), ("siemens", "fanuc"), ("mach9", "linuxcnc"), ("haas", "mach9")]
        {
            let at = Context { from: dialect(from), to: dialect(to), snippet: "GO", beside: ("", "X1.") };
            let said = words(&fault, at);
            assert!(!said.message.is_empty() && !said.label.is_empty(), "{fault:?}");
            let told = message(&fault, at);
            for words in [&said.message, &said.label, &told.account()].into_iter().chain(&advice(&fault, at))
            {
                assert!(!words.contains('\n') && !words.contains("  "), "{told:?}: {words}");
            }
            if from == "fanuc" {
                for (words, most) in [(&said.message, HEADLINE), (&said.label, LABEL)] {
                    if words.chars().count() > most {
                        long.push(format!("{} {words}", words.chars().count()));
                    }
                }
            }
        }
        codes.push(fault.code());
    }
    codes.sort_unstable();
    codes.dedup();
    let mut known = Fault::CODES.to_vec();
    known.sort_unstable();
    assert_eq!(codes, known, "a code without a sample");
    assert_eq!(long, [""; 0], "longer than the form of a message allows");
}

/// An entry is of its own code, and every attribute is one that something shows.
#[test]
fn entries_belong_to_their_code() {
    for Files { code, words, .. } in FILES {
        let id = format!("NC{code:04}");
        for line in words.lines().filter(|line| line.starts_with(|c: char| !c.is_whitespace() && c != '#')) {
            assert!(line.starts_with(&id), "{id}: {line}");
        }
    }
}

/// Each reason has an entry with the values of its fields, in the form of a message; no entry is without a reason.
#[test]
fn every_reason_has_its_words() {
    let wings = |code: u16, wings: &[(&'static str, Variants)]| -> Vec<Named> {
        let named = |(wing, variants): &(&str, Variants)| {
            variants
                .iter()
                .map(|(name, fields)| Named { code, name: format!("{wing}-{name}"), fields })
                .collect()
        };
        wings.iter().flat_map::<Vec<Named>, _>(named).collect()
    };
    let mut all = wings(501, Lack::WINGS);
    all.extend(wings(226, Unexecuted::WINGS));
    all.extend(wings(233, RunTime::WINGS));
    all.extend(wings(202, Unsupported::WINGS));
    all.extend(NoCorner::VARIANTS.iter().map(|(name, fields)| Named {
        code: 250,
        name: (*name).to_owned(),
        fields,
    }));
    all.extend(FunctionFailure::VARIANTS.iter().map(|(name, fields)| Named {
        code: 244,
        name: (*name).to_owned(),
        fields,
    }));
    let mut long = Vec::new();
    for reason in &all {
        // Each reason within a reason has words of its own, not those of the default.
        let mut headlines = BTreeSet::new();
        for what in reason.values_of_nested() {
            let at = dialect("fanuc");
            let mut message = Message::new(reason.code)
                .reason(&Sample { name: &reason.name, fields: reason.fields, nested: what })
                .text("source", "fanuc")
                .text("code", "G68")
                .text("target", "siemens")
                .text("program", "python3 g200.py")
                .text("called", "G200")
                .typed(typed(at));
            if what.is_some_and(|what| what.contains("Function") || what == "BeforeLeadOut") {
                message = message.text("function", "G4");
            }
            assert!(headlines.insert(message.headline()), "{reason:?}: {what:?} has the words of another");
            for (words, most) in [(message.headline(), HEADLINE), (message.label(), LABEL)] {
                assert!(
                    !words.is_empty() && !words.contains('\n') && !words.contains("  "),
                    "{reason:?}: {words:?}"
                );
                if words.chars().count() > most {
                    long.push(format!("{} {}: {words}", words.chars().count(), reason.name));
                }
            }
            let option = |help: Help| {
                help.text("option", "tap_dwell").text("value", "left-out").text("options", "`M5`")
            };
            assert!(message.helps(Some(vec![Help::new("help")])).iter().all(|help| !help.is_empty()));
            if message.has("help-option") {
                message.helps(Some(vec![option(Help::new("help-option"))]));
            }
        }
    }
    assert_eq!(long, [""; 0], "longer than the form of a message allows");

    let mut known: Vec<String> =
        all.iter().map(|reason| format!("NC{:04}-{}", reason.code, reason.name)).collect();
    known.extend(REASONED.map(|code| format!("NC{code:04}")));
    let entries = FILES.iter().filter(|files| REASONED.contains(&files.code));
    let entries = entries.flat_map(|files| files.words.lines()).filter(|line| line.starts_with("NC"));
    let mut entries: Vec<String> =
        entries.map(|line| line.split(' ').next().unwrap_or("").to_owned()).collect();
    known.sort_unstable();
    entries.sort_unstable();
    assert_eq!(entries, known);
}

/// Each fact of a control that ncc may assume has its words and a value, and both fit into NC0308; no entry is without one.
#[test]
fn every_control_fact_has_its_words() {
    let words = include_str!("../../../messages/control-fact/en.ftl");
    let mut entries: Vec<&str> =
        words.lines().filter_map(|line| line.strip_prefix("control-fact-")).collect();
    entries.iter_mut().for_each(|line| *line = line.split(' ').next().unwrap_or_default());
    let mut known: Vec<&str> = ControlFact::VARIANTS.iter().map(|(name, _)| *name).collect();
    entries.sort_unstable();
    known.sort_unstable();
    assert_eq!(entries, known);
    for (name, fields) in ControlFact::VARIANTS {
        let entry = Message::part(Part::ControlFact, "").reason(&Sample { name, fields, nested: None });
        let shown = Message::new(308).text("name", entry.headline()).text("value", entry.attribute("value"));
        let lengths = [shown.headline(), shown.label()].map(|words| words.chars().count());
        assert!(lengths[0] <= HEADLINE && lengths[1] <= LABEL, "{name}: {lengths:?}");
        assert!(!entry.attribute("value").is_empty(), "{name}");
    }
}

/// A reason by its name.
#[derive(Debug)]
struct Named {
    code: u16,
    name: String,
    fields: &'static [&'static str],
}

impl Named {
    /// The names of the reason within this one, if it has one: each has words of its own.
    fn values_of_nested(&self) -> Vec<Option<&'static str>> {
        let nested = match &*self.name {
            "Compensation-Expanded" => ExpandedContour::VARIANTS,
            "Frames-UnderTurnedFrame" => OutsideFrame::VARIANTS,
            "Threads-TapUnknown" => TapValue::VARIANTS,
            "Word-Frame" => ComputedFrame::VARIANTS,
            _ => return vec![None],
        };
        nested.iter().map(|(name, _)| Some(*name)).collect()
    }
}

/// A reason with short values.
struct Sample<'a> {
    name: &'a str,
    fields: &'static [&'static str],
    nested: Option<&'static str>,
}

impl Reason for Sample<'_> {
    fn name(&self) -> String {
        self.name.to_owned()
    }

    fn values(&self, values: &mut Values) {
        let short = |name: &'static str| match name {
            "axis" => "A",
            "kind" => "peck-drilling",
            "function" => "SET_FEED_MODE",
            _ => "12",
        };
        values.extend(self.fields.iter().map(|name| (*name, self.nested.unwrap_or(short(name)).to_owned())));
    }
}

/// How deep calls may go is a fact of the target, also where it is assumed.
#[test]
fn the_depth_of_calls_is_stated_for_the_target() {
    let at = Context { from: dialect("mach9"), to: dialect("linuxcnc"), snippet: "", beside: ("", "") };
    for fault in [
        Fault::CallDepth { depth: 6, sure: 4, macros: false },
        Fault::CallsDeeper { name: "2000".into(), depth: 10, most: 4, macros: false },
    ] {
        let help = advice(&fault, at);
        assert!(help.iter().all(|help| !help.contains("--from-option")), "{help:?}");
    }
}
