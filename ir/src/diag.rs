//! Diagnostics: typed faults, losses and assumptions, with their places.
//!
//! A [`Fault`] carries data, no prose: the words, labels and advice are rendered by the command
//! line alone. Codes are stable, are never used again for something else, and each has a page.

use crate::alarms::AlarmMapped;
use crate::behaviour::{Behaviour, Kept};
use crate::canon::{Axis, Turn};
use crate::compensated::kind::{CompensationRefusal, Kind};
use crate::control_fact::ControlFact;
use crate::expr::num::Num;
use crate::expr::value::Wrong;
use crate::geometry::offset_path::Unreachable;
use crate::lack::Lack;
use crate::program::numbered::Numbered;
use crate::run_time::RunTime;
use crate::source::Span;
use crate::syntax::{Expected, Found, Ranged};
use crate::unexecuted::{NoCorner, Unexecuted};
use crate::unsupported::left_out::LeftOut;
use crate::unsupported::{FunctionFailure, Unsupported};

/// What was found, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// What it is.
    pub fault: Fault,
    /// Where, in the source.
    pub span: Span,
    /// Other places that belong to it.
    pub related: Vec<Span>,
}

impl Diagnostic {
    /// A diagnostic at one place.
    pub fn new(fault: Fault, span: Span) -> Diagnostic {
        Diagnostic { fault, span, related: Vec::new() }
    }
}

/// What the file of a tool would need of the program before it, and cannot state by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileNeeds {
    /// Its first move relies on the place of this axis at the tool change, which is not known.
    Place(Axis),
    /// The same, and inches cannot state the place exactly.
    PlaceInInches(Axis),
    /// It comes before the first tool change, and would be executed with the tool of the first file in the spindle.
    AnotherTool,
    /// The feed that another tool has set, where that is not known.
    Feed,
    /// The spindle speed that another tool has set, where that is not known.
    Speed,
    /// A shift of program zero that is active at the tool change.
    Shift,
    /// A tool length that is active at the tool change.
    Length,
    /// A canned cycle that is active at the tool change.
    Cycle,
    /// Cutter compensation that is active at the tool change.
    Compensation,
    /// A value that stays in the control's tables.
    TableValue,
    /// A setting that lasts beyond its tool.
    Setting,
    /// A block that a switch of the operator decides.
    Switch,
    /// The number of a tool that is computed.
    ToolNumber,
    /// Calls, labels or loops of the output.
    Control,
}

/// Why an expression has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoValue {
    /// A function or an operator has none.
    Wrong(Wrong),
    /// No element has this index.
    Index,
}

/// What becomes of the question of a macro whether it is given an argument, where every call gives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArgumentCheck {
    /// It does not ask.
    NotAsked,
    /// Nor needs it to, since one that is left out is zero there, and nothing at all in the output.
    Nothing,
    /// The same, and it must be a whole number: a word is made of it that the output's control rounds.
    Whole,
    /// The question is left out, with what is done where the answer is no.
    LeftOut,
    /// That is the value which the argument has then.
    Default(Num),
}

/// How well a construct came through. The order is from harmless to loss; everything from
/// [`Verdict::Changed`] on stops the translation unless it is allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Verdict {
    /// The same construct, the same digits.
    Exact,
    /// The same construct, written another way.
    Reformatted,
    /// Rounded to the target's resolution.
    WithinTolerance,
    /// The same events, the structure is gone.
    Expanded,
    /// Holds if a fact about a control holds that the program does not state.
    Assumed,
    /// Other events.
    Changed,
    /// A person must finish it.
    Manual,
    /// Gone.
    Dropped,
}

impl Verdict {
    /// All verdicts, from harmless to loss.
    pub const ALL: [Verdict; 8] = [
        Verdict::Exact,
        Verdict::Reformatted,
        Verdict::WithinTolerance,
        Verdict::Expanded,
        Verdict::Assumed,
        Verdict::Changed,
        Verdict::Manual,
        Verdict::Dropped,
    ];

    /// Its name on the command line and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Verdict::Exact => "exact",
            Verdict::Reformatted => "reformatted",
            Verdict::WithinTolerance => "within-tolerance",
            Verdict::Expanded => "expanded",
            Verdict::Assumed => "assumed",
            Verdict::Changed => "changed",
            Verdict::Manual => "manual",
            Verdict::Dropped => "dropped",
        }
    }

    /// Whether it stops a translation that does not allow it.
    pub const fn stops(self) -> bool {
        matches!(self, Verdict::Changed | Verdict::Manual | Verdict::Dropped)
    }
}

/// How grave a diagnostic is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Gravity {
    /// The program is refused.
    Error,
    /// Worth reading; nothing is refused.
    Warning,
    /// Part of the translation's account of itself.
    Verdict(Verdict),
}

/// A modal fact that was assumed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)] // The names are those of `Modes`.
pub enum ModeName {
    Motion,
    Distance,
    Units,
    Plane,
    FeedMode,
    ReturnLevel,
    WorkOffset,
    LengthOffset,
    OriginShift,
}

macro_rules! faults {
    ($( $(#[$doc:meta])* $name:ident $({ $($(#[$fdoc:meta])* $field:ident : $ty:ty),* $(,)? })? = $code:literal, $gravity:expr; )*) => {
        /// What was found.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Fault {
            $( $(#[$doc])* #[allow(missing_docs)] $name $({ $($(#[$fdoc])* $field: $ty),* })?, )*
        }

        impl Fault {
    /// Whether a long program may have one of it in every block, and each says no more than what became of a word there:
    /// of very many, the number is enough.
    pub const fn is_of_a_word(&self) -> bool {
        matches!(self, Fault::Rounded { .. } | Fault::CommentReformatted | Fault::ArcReformatted)
    }

            /// The number of its stable code: 107 is `NC0107`.
            pub const fn code(&self) -> u16 {
                match self { $( Fault::$name { .. } => $code, )* }
            }

            /// The fault of what a target lacks.
            pub fn lacks(lack: impl Into<Lack>) -> Fault {
                Fault::TargetLacks { lack: lack.into() }
            }

            /// The fault of what ncc does not execute.
            pub fn not_executed(what: impl Into<Unexecuted>) -> Fault {
                Fault::NotExecuted { what: what.into() }
            }

            /// The fault of what ncc does not translate; `code` is its text.
            pub fn not_supported(code: impl Into<Box<str>>, what: impl Into<Unsupported>) -> Fault {
                Fault::NotSupported { code: code.into(), what: what.into() }
            }

            /// The fault of what a target cannot compute when the program runs.
            pub fn computes(what: impl Into<RunTime>) -> Fault {
                Fault::Computes { what: what.into() }
            }

            /// How grave it is.
            pub const fn gravity(&self) -> Gravity {
                match self { $( Fault::$name { .. } => $gravity, )* }
            }

            /// Every code, in the order of this list.
            pub const CODES: &'static [u16] = &[ $( $code, )* ];
        }
    };
}

use Gravity::{Error, Warning};

const fn verdict(v: Verdict) -> Gravity {
    Gravity::Verdict(v)
}

faults! {
    // NC01xx: the text.
    /// A character that no word, comment or sign begins with.
    UnexpectedCharacter { found: char } = 101, Error;
    /// A number that is no decimal, or has more than 18 digits.
    BadNumber { text: Box<str> } = 102, Error;
    /// A comment that is not closed before the end of its line.
    UnclosedComment = 103, Error;
    /// A block longer than a control can hold.
    BlockTooLong { limit: u32 } = 104, Error;
    /// NUL bytes, or other signs that this is no text.
    NotText = 105, Error;
    /// A letter without its number, where the dialect does not read that as zero.
    WordWithoutNumber { letter: char } = 106, Error;
    /// The letter O where a zero is meant: `GOX-15.`, `GZO`.
    LetterOForZero = 107, Error;
    /// Nothing to translate.
    EmptyProgram = 108, Error;
    /// Words that do not make a block.
    Syntax { found: Found, expected: Expected } = 109, Error;
    /// The text ends before the program says that it ends.
    NoProgramEnd = 110, Warning;
    /// Text after the end of the program.
    TextAfterEnd = 111, Warning;
    /// Text before the mark that opens the program, which the control does not read.
    TextBeforeStart { mark: Box<str> } = 114, Warning;

    /// Blocks before the first mark of the text: a control takes them for a leader and skips them. Whether blocks
    /// follow the mark, which the control executes instead.
    OpeningMarkMissing { mark: Box<str>, follows: bool } = 112, Error;
    /// A jump to a label that stands several times in its program: the control goes to one of them.
    LabelTwice { name: Box<str> } = 115, Warning;
    /// A comparison beside a logical operator without parentheses, where comparisons are made last.
    ComparedLast { what: Box<str> } = 113, Warning;

    // NC02xx: the meaning.
    /// A code that the dialect's dictionary does not have.
    UnknownCode { code: Box<str> } = 201, Error;
    /// A code that the dictionary names, and that is not translated.
    NotSupported { code: Box<str>, what: Unsupported } = 202, Error;
    /// Two codes of one modal group in a block.
    CodesExclude { first: Box<str>, second: Box<str> } = 203, Error;
    /// A word that nothing in the block uses.
    WordUnused { word: Box<str> } = 204, Error;
    /// A word that the code needs.
    WordMissing { code: Box<str>, word: Box<str> } = 205, Error;
    /// The same address twice in a block.
    WordTwice { letter: char } = 206, Error;
    /// More codes in a block than the control takes.
    TooManyCodes { letter: char, limit: u8 } = 207, Error;
    /// A decimal point where only a whole number is allowed.
    PointNotAllowed { word: Box<str> } = 208, Error;
    /// A value outside the range of the word.
    OutOfRange { word: Ranged } = 209, Error;
    /// Axis words, and no motion code has been stated.
    NoMotionMode = 210, Error;
    /// An arc without centre or radius.
    ArcWithoutCentre = 211, Error;
    /// An arc with both.
    ArcCentreAndRadius = 212, Error;
    /// The radii of an arc at start and end differ by more than its control accepts; nanos of a millimetre.
    ArcEndOffCircle { radii: [i64; 2], allowed: i64 } = 213, Error;
    /// The radius cannot reach the end point.
    ArcRadiusTooSmall = 214, Error;
    /// A radius and no way to go.
    ArcRadiusNoWay = 215, Error;
    /// An axis word is needed that is not known here.
    PositionUnknown { axis: char } = 216, Error;
    /// A called program is not in the text.
    CallUnknown { name: Box<str> } = 217, Error;
    /// A subprogram calls itself.
    CallRecursive { name: Box<str> } = 218, Error;
    /// Calls within calls, deeper than any control allows.
    CallsTooDeep { name: Box<str>, most: u32 } = 236, Error;
    /// Two programs of one name.
    ProgramTwice { name: Box<str> } = 219, Error;
    /// Variables, expressions or control of the program's flow: not translated.
    MacroLanguage { what: Box<str> } = 220, Error;
    /// A tool change and no tool was selected.
    NoToolSelected = 221, Error;
    /// A move at feed and no feed was stated.
    NoFeed = 222, Error;
    /// Holes without an active cycle.
    NoCycle = 223, Error;
    /// The retract plane lies below the bottom of the hole.
    CycleUpsideDown = 224, Error;
    /// A cycle in a procedure that does not say what it depends on.
    EntryFactNeeded { fact: ModeName } = 225, Error;
    /// A statement that only the text form can carry, and that is not executed.
    NotExecuted { what: Unexecuted } = 226, Error;
    /// A program that does not end.
    NoEnd { steps: u64 } = 227, Error;
    /// The user has stopped ncc while it executed the program.
    Interrupted { steps: u64 } = 237, Error;

    /// A label that stands nowhere before the block that repeats from it.
    LabelUnknown { name: Box<str> } = 228, Error;
    /// An arc by angle, through a point or tangent, and no circle fits its words.
    NoArc = 229, Error;
    /// A move synchronised with a spindle that has no speed.
    NoSpeed = 230, Error;
    /// A cycle whose control refuses it unless the spindle turns, for a tap to one side.
    SpindleForCycle { turn: Option<Turn>, by_target: bool } = 242, Error;
    /// An expression that is worth nothing.
    NoValue { why: NoValue } = 231, Error;
    /// A variable is read that the program has not set.
    VariableUnset { name: Box<str> } = 232, Error;
    /// What is computed when the program runs, where no target is given variables, expressions or jumps.
    Computes { what: RunTime } = 233, Error;
    /// A loop that is never left: an iteration changes nothing that its condition reads.
    Endless = 234, Error;
    /// Its control refuses it while cutter radius compensation is on.
    RefusedCompensated { what: CompensationRefusal } = 235, Error;
    /// A program that begins again takes a mode for granted at its start that is another at its end.
    BeginsOtherwise { fact: ModeName } = 238, Error;

    /// A contour is to be computed beside which the tool goes, and nobody has said by which radius: that
    /// of an entry, or of an edge.
    RadiusUnknown { entry: Option<u32> } = 240, Error;
    /// A contour along which the tool cannot go without cutting into it.
    ContourUnreachable { why: Unreachable } = 241, Error;
    /// A custom function, the program of the user that processes it, and nobody has agreed that ncc starts it.
    FunctionNotRun { name: Box<str>, program: Box<str> } = 243, Error;
    /// A program of the user fails, or ncc does not take its answer; `said` is the text of its standard error.
    FunctionFailed { name: Box<str>, program: Box<str>, why: FunctionFailure, said: Box<str> } = 244, Error;
    /// A corner that cannot be rounded or chamfered.
    NoCorner { why: NoCorner } = 250, Error;

    // NC03xx: assumptions.
    /// The program relies on a state at power-on that it never says.
    AssumedMode { fact: ModeName, value: Box<str> } = 301, verdict(Verdict::Assumed);
    /// A word of which no effect is known.
    AssumedNoEffect { code: Box<str> } = 302, verdict(Verdict::Assumed);
    /// A number without a decimal point was read by the dialect's rule.
    AssumedBareNumber { word: Box<str>, value: Box<str> } = 303, verdict(Verdict::Assumed);
    /// A length offset on a block without a drilling-axis word takes effect with the next.
    AssumedOffsetWithZ = 304, verdict(Verdict::Assumed);
    /// The one work offset of a control without work-offset words is the one that is named.
    AssumedWorkOffset { offset: u16 } = 305, verdict(Verdict::Assumed);
    /// A dictionary row that no manual confirms.
    AssumedRow { code: Box<str>, meaning: Box<str> } = 306, verdict(Verdict::Assumed);
    /// A dictionary option decides.
    AssumedOption { option: Box<str>, value: Box<str> } = 307, verdict(Verdict::Assumed);
    /// A fact of the control or the machine that nothing states.
    AssumedFact { fact: ControlFact } = 308, verdict(Verdict::Assumed);

    /// A pattern whose order of holes a control may choose by where the tool is is made in the
    /// order of its parameters.
    AssumedHoleOrder { pattern: Box<str> } = 309, verdict(Verdict::Assumed);
    /// The length of edge 1 of a tool is the entry of the length table with the tool's number.
    AssumedEdge { tool: u32 } = 310, verdict(Verdict::Assumed);

    /// The target lacks how corners are taken: it is taken to do it always in this way.
    AssumedPath { path: Box<str> } = 311, verdict(Verdict::Assumed);

    /// The tool goes onto a compensated contour, and leaves it, in the same way on both controls.
    AssumedContourEnds = 312, verdict(Verdict::Assumed);
    /// One control has radii in a table by entries of their own, the other with the tool or its length: the
    /// entry of that number was taken.
    AssumedRadius { entry: u32 } = 313, verdict(Verdict::Assumed);

    /// A custom function means what a program of the user has made of its blocks.
    AssumedFunction { name: Box<str>, program: Box<str> } = 314, verdict(Verdict::Assumed);
    /// Rotary axes, and the zero that points of the tool tip count from, are the same on both controls.
    AssumedTip = 320, verdict(Verdict::Assumed);
    /// The tool is swivelled to a tilted plane in the same way on both controls.
    AssumedTilt = 321, verdict(Verdict::Assumed);
    /// The source's control was recognised by its text, which fits another one as well, and that one reads it otherwise.
    AssumedControl { taken: Box<str>, other: Box<str> } = 330, verdict(Verdict::Assumed);
    /// The T beside M06 is taken for the tool that is put in, though another one waits of which the length is activated.
    AssumedToolChange { named: u32, waiting: u32 } = 336, verdict(Verdict::Assumed);
    /// A return to a reference point with G90 and G91 in its block: its words are read by the last one, which is
    /// absolute or not; `zero`: all of them are nothing.
    AssumedReturn { code: Box<str>, words: Box<str>, zero: bool, last: bool } = 337, verdict(Verdict::Assumed);
    /// Calls within one another that not every control of this kind takes: how deep they go, and what each one takes.
    CallDepth { depth: u32, sure: u32, macros: bool } = 339, verdict(Verdict::Assumed);
    /// A code of motion beside a cycle's code: the hole is drilled, or the motion cancels the cycle; the first is taken.
    AssumedCycle { cycle: Box<str>, motion: Box<str> } = 338, verdict(Verdict::Assumed);
    /// A stop or a tool change of the target's control switches something off that the source's control lets go on:
    /// it is started again before the next cut.
    StartedAgain { behaviour: Behaviour } = 322, verdict(Verdict::Assumed);
    /// The cut is another one where the control does something else at a code than it was taken to do; `source` is
    /// whose control.
    OpenBehaviour { behaviour: Behaviour, source: bool, taken: &'static str, other: &'static str } = 323, verdict(Verdict::Assumed);
    /// The target's control takes Z to machine zero before it changes the tool, and the source's does not.
    MovedAtChange = 324, verdict(Verdict::Assumed);
    /// The cut is another one where the switch for optional stops is on.
    OptionalStopDiffers = 325, verdict(Verdict::Assumed);
    /// The program never says how corners are taken, and the two controls begin otherwise: how each does.
    PathAtStart { source: &'static str, target: &'static str } = 326, verdict(Verdict::Assumed);
    /// The program leaves an active shift that one control keeps for its next run, before it shifts the axis itself:
    /// by how much each begins it shifted, nanos of a millimetre or a degree.
    NextRunShifted { axis: Axis, source: i64, target: i64 } = 327, verdict(Verdict::Assumed);
    /// The same of a rotation, a scale or a mirror.
    NextRunTurned = 328, verdict(Verdict::Assumed);
    /// The program reads variables before it sets them, and one control keeps their values longer than the other: for how
    /// long each does.
    NextRunVariables { names: Box<[Box<str>]>, source: Kept, target: Kept } = 343, verdict(Verdict::Assumed);
    /// Plain rounding of corners has no bound on the target's control, and one on the source's.
    RoundsFreely = 329, verdict(Verdict::Assumed);
    /// An arc under cutter compensation on which F counts otherwise in the output: whether it counts along the contour in the
    /// source, or there in the output, and whether it is an inner arc.
    FeedOnArcs { contour_in_source: bool, inner: bool } = 332, verdict(Verdict::Assumed);
    /// A cut at a feed that was stated before the units changed: what it was, and what the source's control makes of it;
    /// nanos of a millimetre.
    FeedAtUnits { before: i64, now: i64 } = 331, verdict(Verdict::Assumed);
    /// The control goes beside the contour, onto it and off it, as RS274/NGC describes it.
    AssumedContourPath = 340, verdict(Verdict::Assumed);
    /// A tool's length left out for a control whose tools are changed by hand: the operator sets the zero of Z by it.
    LengthByHand { tool: u32 } = 345, verdict(Verdict::Assumed);
    /// The program looks like something else than a milling program, and the user says that it is one; in
    /// which line the sign stands that decides.
    AssumedMilling { looks_like: Box<str>, line: u64 } = 350, verdict(Verdict::Assumed);

    // NC04xx: what became of it.
    /// A comment in the target's characters.
    CommentReformatted = 401, verdict(Verdict::Reformatted);
    /// An arc's centre in the target's form.
    ArcReformatted = 402, verdict(Verdict::Reformatted);
    /// A number rounded to the target's digits.
    Rounded { word: Box<str>, written: Box<str> } = 403, verdict(Verdict::WithinTolerance);
    /// A pattern written as its positions.
    PatternExpanded { holes: u32 } = 404, verdict(Verdict::Expanded);
    /// A cycle written as its moves.
    CycleExpanded { kind: Box<str> } = 405, verdict(Verdict::Expanded);
    /// An inlined subprogram.
    CallExpanded { name: Box<str>, times: u32 } = 406, verdict(Verdict::Expanded);
    /// A block-skip level that the target lacks: its block has the first level.
    SkipLevelLost { level: u8 } = 407, verdict(Verdict::Changed);
    /// Block numbers left out.
    NumbersLeftOut { count: u32 } = 408, verdict(Verdict::Reformatted);
    /// The program's name kept as a comment.
    NameAsComment = 409, verdict(Verdict::Reformatted);
    /// A block written as several.
    BlockSplit = 410, verdict(Verdict::Reformatted);
    /// A message that the target cannot show.
    MessageDropped = 411, verdict(Verdict::Dropped);
    /// A tool that the source calls by name, and the number that it got, in the order of use.
    ToolNumbered { name: Box<str>, number: u32 } = 342, verdict(Verdict::Assumed);
    /// An edge of a tool other than the first, by the target's number of the tool, and the entry of the length table that
    /// it got.
    EdgeNumbered { tool: u32, edge: u32, entry: u32 } = 346, verdict(Verdict::Assumed);
    /// A code of the machine that has no effect on the cut, as its user has stated.
    CodeLeftOut { what: LeftOut } = 444, verdict(Verdict::Reformatted);
    /// A message that is shown while the program goes on, which the target cannot do: it is a comment there.
    MessageAsComment = 443, verdict(Verdict::Reformatted);
    /// An unrolled repetition.
    RepeatExpanded { times: u32 } = 412, verdict(Verdict::Expanded);

    /// A chain of frames worked into the coordinates.
    FramesExpanded = 413, verdict(Verdict::Expanded);
    /// Long-hand moves folded into a cycle.
    CycleFolded { kind: Box<str>, holes: u32 } = 414, verdict(Verdict::Reformatted);
    /// Positions folded into a pattern that meets each to half a unit of the last of its `digits`
    /// after the point, of an inch or of a millimetre.
    PatternFolded { pattern: Box<str>, holes: u32, digits: u8, inch: bool } = 415, verdict(Verdict::Reformatted);

    /// A subprogram or a label whose name the target cannot have.
    NameChanged { from: Box<str>, to: Box<str> } = 416, verdict(Verdict::Reformatted);

    /// A way of taking corners that the target lacks, and the one that was written for it.
    PathRelaxed { from: Box<str>, to: Box<str> } = 417, verdict(Verdict::WithinTolerance);
    /// Advice to the control of a kind that the target lacks.
    AdviceLeftOut { kind: Box<str> } = 418, verdict(Verdict::Reformatted);
    /// A work offset that the target cannot name, and in which nothing moves.
    WorkOffsetLeftOut { offset: u16 } = 419, verdict(Verdict::Reformatted);
    /// What computes and decides was executed, and the blocks that come of it were written.
    Flattened { blocks: u64 } = 420, verdict(Verdict::Expanded);
    /// Variables have other names in the target; which is which.
    VariablesRenamed { map: Box<str> } = 421, verdict(Verdict::Reformatted);
    /// Alarms have other numbers in the target, or their number in the text; which is which.
    AlarmsRenumbered { map: Box<[AlarmMapped]> } = 422, verdict(Verdict::Reformatted);
    /// Values in messages have other digits in the target: so many after the point.
    ValuesInFull { digits: u8 } = 423, verdict(Verdict::Reformatted);
    /// Text for a device that the target does not write to.
    OutputDropped = 424, verdict(Verdict::Reformatted);
    /// A macro whose calls give different arguments written as several, one for each set; under these names.
    MacroCloned { name: Box<str>, names: Box<str> } = 425, verdict(Verdict::Expanded);
    /// The text of an alarm has values in it, which no alarm of the output shows.
    AlarmValues = 427, verdict(Verdict::Reformatted);
    /// What the source's control does by itself at a code, written before it as words.
    SideEffectWritten { behaviour: Behaviour } = 426, verdict(Verdict::Reformatted);
    /// A cut in machine coordinates written in the active work offset, less the offsets.
    MachineCutExpanded { offset: u16 } = 431, verdict(Verdict::Expanded);
    /// Words less the active offsets written as a cut in machine coordinates; the source's control rounds them to so
    /// many digits, of an inch or of a millimetre.
    MachineCutFolded { digits: u8, inch: bool } = 432, verdict(Verdict::Reformatted);
    /// A peck that is longer than its hole written as long as the hole is.
    PeckShortened = 433, verdict(Verdict::Reformatted);
    /// A point by radius and angle written by its coordinates.
    PolarExpanded = 430, verdict(Verdict::Expanded);

    /// A compensated contour written as the tool centre path; the radius in nanos of a millimetre.
    CompensationExpanded { radius: i64 } = 440, verdict(Verdict::Expanded);
    /// Linear and rotary axes together, written by the time that the move takes.
    FeedByTime = 442, verdict(Verdict::Reformatted);
    /// A rounded or chamfered corner written as an arc or a line.
    CornerExpanded = 450, verdict(Verdict::Expanded);

    // NC05xx: what the target cannot say.
    /// The target lacks it.
    TargetLacks { lack: Lack } = 501, Error;
    /// A second work offset for a control that has one.
    SecondWorkOffset { first: u16, second: u16 } = 502, Error;
    /// The arc is gone after rounding to the target's digits.
    ArcVanishes = 503, Error;
    /// A number outside the target's range.
    TargetRange { word: Box<str> } = 504, Error;
    /// What the translation would assume is denied by the profile of a machine: which fact,
    /// and whose.
    ProfileDenies { fact: Box<str>, machine: Box<str> } = 505, Error;
    /// A number that the program uses and the map between two machines does not have: the target's
    /// machine has nothing of the name that the source's has for it, or the source's has no name.
    NotInMap { what: Numbered, number: u32, name: Option<Box<str>> } = 506, Error;

    /// A file per tool is asked for, and one of them could not state this by itself.
    NoFileOfTool { needs: FileNeeds } = 510, Error;

    /// What the target's control does by itself at a code, and the source's does not, and what comes after it needs.
    DoneByTarget { behaviour: Behaviour } = 508, Error;

    /// What the source's control does besides the name of a code decides the cut, and must be stated.
    MustBeStated { behaviour: Behaviour } = 509, Error;
    /// A fact that the program leaves to what was active before it, and that the target's control always
    /// begins with a value of its own for.
    ModeNotSet { fact: ModeName } = 507, Error;
    /// By how many degrees a rotary axis turns is left to the two controls: by what the number says, or another way;
    /// nanos.
    RotaryTurnOpen { axis: Axis, by: i64, or: i64 } = 522, Error;
    /// Calls deeper within one another than the target takes.
    CallsDeeper { name: Box<str>, depth: u32, most: u32, macros: bool } = 523, Error;
    /// The radii of an arc at start and end differ by more than the target's control accepts; nanos of a millimetre.
    ArcRadiiDiffer { radii: [i64; 2], allowed: i64 } = 520, Error;
    /// The target's control refuses it while cutter radius compensation is on.
    CompensatedThere { kind: Kind } = 521, Error;

    // NC06xx: verification.
    /// Source and output do not make the same events: a fault of this compiler.
    NotTheSame { difference: Box<str> } = 601, Error;
    /// The output could not be read back: a fault of this compiler.
    NotReadBack { code: u16 } = 602, Error;
    /// Not every setting of the block-skip switches was tried.
    SkipSettingsSampled { levels: u8 } = 603, Warning;
    /// A variable is read that the program may not have set: it was given values, the same on both sides.
    VariableGiven { name: Box<str> } = 604, Warning;
    /// An uncovered branch of the program against the output: where the condition holds, where
    /// it does not, or both.
    BranchUncovered { holds: bool, fails: bool } = 605, Warning;
    /// The output has more branches than the source, and some are uncovered; their blocks.
    OutputNotTaken { blocks: Box<str> } = 609, Warning;
    /// A run with another value of an open fact was left before the program's end; `None` is the switch for optional
    /// stops. `source` is whose control.
    FactNotTried { behaviour: Option<Behaviour>, source: bool } = 610, Warning;
    /// A value was stated for a variable, and the program does not rely on it.
    ValueNotRead { name: Box<str> } = 606, Warning;
    /// Nothing in the program calls a subprogram of it, which was therefore not run against the output.
    NotCalled { name: Box<str> } = 607, Warning;
    /// A macro stands alone, and every call must give it an argument that its own control lets a call leave out; where
    /// calls give their arguments one after the other, in which place (from 1; else 0).
    ArgumentNeeded { name: Box<str>, place: u32, check: ArgumentCheck } = 608, Warning;

    // NC08xx: what a check of a program finds, and a translation reports too.
    /// A move at feed with the spindle stopped, of a program that has said a speed before.
    CutStanding = 805, Warning;
}
