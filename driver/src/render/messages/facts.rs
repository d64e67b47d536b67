//! Chooses the entry of `messages/` for a fault, with its values. `advice` chooses the helps.
//!
//! ```text
//! Fault::WordWithoutNumber { letter: 'X' }    NC0106, letter = X, source = fanuc, target = siemens
//! ```

use ncc_dialects::{Dialect, Meaning};
use ncc_ir::behaviour::{Behaviour, Concern};
use ncc_ir::canon::{PathMode, Turn, Units};
use ncc_ir::compensated::kind::{CompensationRefusal, Kind};
use ncc_ir::diag::{ArgumentCheck, Fault, ModeName, NoValue};
use ncc_ir::expr::value::Wrong;
use ncc_ir::geometry::offset_path::Unreachable;
use ncc_ir::syntax::Ranged;

use super::codes::{code_for, is_open, is_return, typed};
use super::context::Context;
use super::file_needs;
use super::message::Message;
use crate::render::numbers::{millimetres, numbered, signed, thousands};
use crate::render::spelled::{
    alarms_mapped, assumed_fact, character, expected_words, found_words, kept, mode, mode_value,
    path_start_short, row_meaning, work_offset,
};
use crate::render::text::{plain, plain_upto, shown};

/// So much is shown of the words of a block in a headline, in characters.
const WORDS: usize = 24;

/// So much is shown of a program of the user with its arguments, in characters.
const PROGRAM: usize = 32;

/// The message of a fault.
pub(crate) fn message(fault: &Fault, at: Context) -> Message {
    let m = Message::new(fault.code()).text("source", at.from.id.as_str()).text("target", at.to.id.as_str());
    let control = |source: bool| if source { at.from.id.as_str() } else { at.to.id.as_str() };
    match fault {
        Fault::UnclosedComment
        | Fault::NotText
        | Fault::LetterOForZero
        | Fault::EmptyProgram
        | Fault::NoProgramEnd
        | Fault::TextAfterEnd
        | Fault::NoMotionMode
        | Fault::ArcWithoutCentre
        | Fault::ArcCentreAndRadius
        | Fault::ArcRadiusTooSmall
        | Fault::NoArc
        | Fault::ArcRadiusNoWay
        | Fault::NoToolSelected
        | Fault::NoFeed
        | Fault::NoSpeed
        | Fault::NoCycle
        | Fault::CycleUpsideDown
        | Fault::AssumedTip
        | Fault::AssumedTilt
        | Fault::RoundsFreely
        | Fault::NextRunTurned
        | Fault::OptionalStopDiffers
        | Fault::MovedAtChange
        | Fault::AssumedContourEnds
        | Fault::CutStanding
        | Fault::AssumedContourPath
        | Fault::FramesExpanded
        | Fault::Endless
        | Fault::AssumedOffsetWithZ
        | Fault::CommentReformatted
        | Fault::ArcReformatted
        | Fault::MachineCutFolded { .. }
        | Fault::PeckShortened
        | Fault::PolarExpanded
        | Fault::FeedByTime
        | Fault::CornerExpanded
        | Fault::OutputDropped
        | Fault::AlarmValues
        | Fault::NameAsComment
        | Fault::BlockSplit
        | Fault::MessageDropped
        | Fault::MessageAsComment
        | Fault::ArcVanishes
        | Fault::NotTheSame { .. } => m,

        Fault::SpindleForCycle { turn, by_target } => {
            let m = m.text("control", control(!by_target));
            m.form(match turn {
                None => "bore",
                Some(Turn::Clockwise) => "right",
                Some(Turn::Counterclockwise) => "left",
            })
        }

        Fault::UnexpectedCharacter { found } => m.text("found", character(*found)),
        Fault::BadNumber { text } => m.text("text", shown(text)),
        Fault::BlockTooLong { limit } => m.count("limit", *limit),
        Fault::WordWithoutNumber { letter } | Fault::WordTwice { letter } => m.text("letter", *letter),
        Fault::Syntax { found, expected } => {
            m.text("found", found_words(found)).text("expected", expected_words(expected))
        }
        Fault::OpeningMarkMissing { mark, follows: true } => m.form("between").text("mark", shown(mark)),
        Fault::OpeningMarkMissing { mark, follows: false } | Fault::TextBeforeStart { mark } => {
            m.text("mark", shown(mark))
        }
        Fault::LabelTwice { name } => m.text("name", plain(name)),
        Fault::ComparedLast { what } => m.text("what", shown(what)),

        Fault::UnknownCode { code } => {
            let m = m.text("code", shown(code));
            if is_open(code, at.from) { m.form("machine") } else { m }
        }
        Fault::NotSupported { code, what } => m.reason(what).text("code", shown(code)).typed(typed(at.from)),
        Fault::CodesExclude { first, second } => m.text("first", shown(first)).text("second", shown(second)),
        Fault::WordUnused { word } | Fault::PointNotAllowed { word } => m.text("word", shown(word)),
        Fault::OutOfRange { word } => out_of_range(word, m),
        // Any axis will do.
        Fault::WordMissing { code, word } if is_return(code, at.from) => {
            m.form("return").text("code", plain(code))
        }
        Fault::WordMissing { code, word } => m.text("code", shown(code)).text("word", shown(word)),
        Fault::TooManyCodes { letter, limit } => m.text("letter", *letter).count("limit", *limit),
        Fault::ArcEndOffCircle { radii: [start, end], allowed: _ }
        | Fault::ArcRadiiDiffer { radii: [start, end], allowed: _ } => {
            m.text("start", millimetres(*start)).text("end", millimetres(*end))
        }
        Fault::RefusedCompensated { what } => refused(what, m),
        Fault::CompensatedThere { kind } => m.form(kind_of_statement(*kind)),
        Fault::NoCorner { why } => m.reason(why),
        Fault::PositionUnknown { axis } => m.text("axis", *axis),
        Fault::CallUnknown { name } => m.text("name", shown(name)),
        Fault::CallsTooDeep { name, most } => m.text("name", shown(name)).count("most", *most),
        Fault::CallsDeeper { name, depth, most, macros } => m
            .text("name", shown(name))
            .text("kind", kind_of_call(*macros))
            .count("depth", *depth)
            .count("most", *most),
        Fault::CallDepth { depth, sure, macros } => {
            m.text("kind", kind_of_call(*macros)).count("depth", *depth).count("sure", *sure)
        }
        Fault::CallRecursive { name } | Fault::ProgramTwice { name } | Fault::LabelUnknown { name } => {
            m.text("name", shown(name))
        }
        Fault::MacroLanguage { what } => m.text("what", plain(what)),
        Fault::NotExecuted { what } => m.reason(what).typed(typed(at.from)),
        Fault::NoValue { why } => no_value(*why, m),
        Fault::Computes { what } => m.reason(what).typed(typed(at.from)),
        Fault::VariableUnset { name } | Fault::VariableGiven { name } | Fault::ValueNotRead { name } => {
            m.text("name", name.to_string()).text("variable", variable(name, at.from))
        }
        Fault::NotCalled { name } => m.text("name", name.to_string()),
        Fault::EntryFactNeeded { fact: ModeName::Units } => {
            let code = |units| code_for(Meaning::UseLengthUnits(units), at.from);
            m.form("units").text("mm", code(Units::Mm)).text("inch", code(Units::Inch))
        }
        Fault::BeginsOtherwise { fact } | Fault::EntryFactNeeded { fact } | Fault::ModeNotSet { fact } => {
            m.text("mode", mode(*fact))
        }
        Fault::NoEnd { steps } | Fault::Interrupted { steps } => m.text("steps", thousands(*steps)),
        Fault::RadiusUnknown { entry: Some(entry) } => m.text("entry", entry.to_string()),
        Fault::RadiusUnknown { entry: None } => m.form("edge"),
        Fault::ContourUnreachable { why } => unreachable(*why, m),

        Fault::AssumedMode { fact, value } => {
            m.text("mode", mode(*fact)).text("value", mode_value(*fact, value))
        }
        Fault::FunctionNotRun { name, program } | Fault::AssumedFunction { name, program } => {
            m.text("code", plain(name)).text("program", plain_upto(program, PROGRAM))
        }
        Fault::FunctionFailed { name, program, why, .. } => {
            m.reason(why).text("called", plain(name)).text("program", plain_upto(program, PROGRAM))
        }
        Fault::AssumedNoEffect { code } => m.text("code", shown(code)),
        Fault::CodeLeftOut { what } => m.reason(what),
        Fault::AssumedBareNumber { word, value } => m.text("word", shown(word)).text("value", plain(value)),
        Fault::AssumedWorkOffset { offset } => m.text("offset", work_offset(*offset, [at.to, at.from])),
        Fault::AssumedRow { code, meaning } => {
            m.text("code", shown(code)).text("meaning", row_meaning(code, meaning, [at.from, at.to]))
        }
        Fault::AssumedOption { option, value } => m.text("option", shown(option)).text("value", shown(value)),
        Fault::AssumedFact { fact } => {
            let [name, value] = assumed_fact(fact);
            m.text("name", name).text("value", value)
        }
        Fault::AssumedHoleOrder { pattern } => m.text("pattern", plain(pattern)),
        Fault::AssumedPath { path } => m.text("path", plain(path)),
        Fault::AssumedMilling { looks_like, .. } => m.text("looks", plain(looks_like)),
        Fault::StartedAgain { behaviour } | Fault::DoneByTarget { behaviour } => {
            m.text("behaviour", behaviour.about())
        }
        Fault::MustBeStated { behaviour } => m.text("behaviour", behaviour.about()),
        Fault::OpenBehaviour { behaviour, source, taken, other } => open_behaviour(*behaviour, m)
            .text("behaviour", behaviour.about())
            .text("option", behaviour.option())
            .text("control", control(*source))
            .text("side", side(*source))
            .text("taken", *taken)
            .text("other", *other),
        Fault::NextRunShifted { axis, source, target } => m
            .text("axis", char::from(axis.letter()))
            .text("before", signed(*source))
            .text("after", signed(*target)),
        Fault::NextRunVariables { names, source, target } => m
            .count("count", names.len() as u64)
            .text("names", names.join(", "))
            .text("before", kept(*source))
            .text("after", kept(*target)),
        Fault::FeedAtUnits { before, now } => {
            let m = if before == now { m.form("same") } else { m };
            m.text("before", millimetres(*before)).text("now", millimetres(*now))
        }
        Fault::PathAtStart { source, target } => {
            m.text("before", path_start_short(source)).text("after", path_start_short(target))
        }
        Fault::FeedOnArcs { contour_in_source: true, .. } => m.form("contour"),
        Fault::FeedOnArcs { .. } => m,
        Fault::LengthByHand { tool } | Fault::AssumedEdge { tool } => m.text("tool", tool.to_string()),
        Fault::RotaryTurnOpen { axis, by, or } => {
            m.text("axis", char::from(axis.letter())).text("by", signed(*by)).text("or", signed(*or))
        }
        Fault::AssumedToolChange { named, waiting } => {
            m.text("named", named.to_string()).text("waiting", waiting.to_string())
        }
        Fault::AssumedReturn { code, words, zero, last } => {
            let m = m.text("code", shown(code)).text("words", plain_upto(words, WORDS));
            match (last, zero) {
                (true, _) => m,
                (false, true) => m.form("straight"),
                (false, false) => m.form("incremental"),
            }
        }
        Fault::AssumedCycle { cycle, motion } => m.text("cycle", shown(cycle)).text("motion", shown(motion)),
        Fault::AssumedControl { taken, other } => m.text("taken", plain(taken)).text("other", plain(other)),
        Fault::AssumedRadius { entry } => m.text("entry", entry.to_string()),
        Fault::ToolNumbered { name, number } => {
            m.text("name", plain(name)).text("number", number.to_string())
        }
        Fault::EdgeNumbered { tool, edge, entry } => {
            m.text("tool", tool.to_string()).text("edge", edge.to_string()).text("entry", entry.to_string())
        }

        Fault::Rounded { word, written } => m.text("word", shown(word)).text("written", shown(written)),
        Fault::PatternExpanded { holes } => m.count("holes", *holes),
        Fault::CycleExpanded { kind } => m.text("kind", plain(kind)),
        Fault::CallExpanded { name, times } => m.text("name", shown(name)).count("times", *times),
        Fault::SkipLevelLost { level } => m.text("level", level.to_string()),
        Fault::NumbersLeftOut { count } => m.count("count", *count),
        Fault::RepeatExpanded { times } => m.count("times", *times),
        Fault::CycleFolded { kind, holes } => m.text("kind", plain(kind)).count("holes", *holes),
        Fault::PatternFolded { pattern, holes, .. } => {
            m.text("pattern", plain(pattern)).count("holes", *holes)
        }
        Fault::NameChanged { from, to } => m.text("before", plain(from)).text("name", plain(to)),
        Fault::PathRelaxed { from, to } => {
            path_relaxed(from, m).text("path", plain(from)).text("written", plain(to))
        }
        Fault::AdviceLeftOut { kind } => m.text("kind", plain(&kind.replace('-', " "))),
        Fault::WorkOffsetLeftOut { offset } => m.text("offset", offset.to_string()),
        Fault::Flattened { blocks } => m.count("blocks", *blocks),
        Fault::VariablesRenamed { map } => m.text("map", map.to_string()),
        Fault::AlarmsRenumbered { map } => m.text("map", alarms_mapped(map)),
        Fault::ValuesInFull { digits } => m.count("digits", *digits),
        Fault::MacroCloned { name, names } => m.text("name", plain(name)).text("names", plain(names)),
        Fault::SideEffectWritten { behaviour } => {
            let m = m.text("behaviour", behaviour.about());
            if *behaviour == Behaviour::FeedOnArcs { m.form("feed") } else { m }
        }
        Fault::MachineCutExpanded { offset } => m.text("offset", work_offset(*offset, [at.to, at.from])),
        Fault::CompensationExpanded { radius } => m.text("radius", millimetres(*radius)),

        Fault::TargetLacks { lack } => m.reason(lack).typed(typed(at.from)),
        Fault::SecondWorkOffset { first, second } => {
            m.text("first", first.to_string()).text("second", second.to_string())
        }
        Fault::TargetRange { word } => m.text("word", shown(word)),
        Fault::ProfileDenies { fact, machine } => m.text("machine", plain(machine)).text("fact", plain(fact)),
        Fault::NotInMap { what, number, name } => {
            let m = m.text("thing", numbered(*what, 1)).text("number", number.to_string());
            match name {
                Some(name) => m.form("named").text("name", plain(name)),
                None => m,
            }
        }
        Fault::NoFileOfTool { needs } => file_needs::message(*needs, m),

        Fault::NotReadBack { code } => m.text("code", format!("NC{code:04}")),
        Fault::SkipSettingsSampled { levels } => m.count("levels", *levels),
        Fault::BranchUncovered { holds, fails } => match (holds, fails) {
            (true, true) => m,
            (true, false) => m.form("false"),
            (false, _) => m.form("true"),
        },
        Fault::OutputNotTaken { blocks } => m.text("blocks", plain(blocks)),
        Fault::FactNotTried { behaviour: Some(behaviour), source } => {
            m.text("option", behaviour.option()).text("control", control(*source)).text("side", side(*source))
        }
        Fault::FactNotTried { behaviour: None, .. } => m.form("stop"),
        Fault::ArgumentNeeded { name, place, check } => {
            let m = match check {
                ArgumentCheck::NotAsked => m,
                ArgumentCheck::Nothing => m.form("null"),
                ArgumentCheck::Whole => m.form("whole"),
                ArgumentCheck::LeftOut | ArgumentCheck::Default(_) => m.form("check"),
            };
            m.text("name", name.to_string()).count("place", *place)
        }
    }
}

/// The message for a code or statement that the source's control refuses under cutter compensation.
fn refused(what: &CompensationRefusal, m: Message) -> Message {
    match what {
        CompensationRefusal::Code { code } => m.text("code", plain(code)),
        CompensationRefusal::Kind(kind) => m.form(kind_of_statement(*kind)),
    }
}

/// The form for a kind of statement that some controls refuse under cutter compensation.
fn kind_of_statement(kind: Kind) -> &'static str {
    match kind {
        Kind::Path => "path",
        Kind::ReturnLevel => "return-level",
        Kind::WorkOffset => "work-offset",
        Kind::Length => "length",
        Kind::LocalShift => "local-shift",
        Kind::Overrides => "overrides",
    }
}

/// Why an expression has no value.
fn no_value(why: NoValue, m: Message) -> Message {
    m.form(match why {
        NoValue::Wrong(Wrong::DivisionByZero) => "division",
        NoValue::Wrong(Wrong::NotDefined) => "not-defined",
        NoValue::Wrong(Wrong::TooLarge) => "too-large",
        NoValue::Wrong(Wrong::Arguments) => "arguments",
        NoValue::Wrong(Wrong::NothingGiven) => "empty",
        NoValue::Index => "index",
    })
}

/// `--from-option` or `--to-option`.
fn side(source: bool) -> &'static str {
    if source { "from" } else { "to" }
}

/// What kind of calls are counted.
fn kind_of_call(macros: bool) -> &'static str {
    if macros { "macro" } else { "call" }
}

/// What is another one where a control does something else than it was taken to do: the cut, or the next run.
fn open_behaviour(behaviour: Behaviour, m: Message) -> Message {
    match (behaviour.concern(), behaviour) {
        (Concern::Machine | Concern::Nothing, _) => m,
        (Concern::AtEnd, Behaviour::VariablesAtEnd | Behaviour::VariablesWhenOff) => m.form("values"),
        (Concern::AtEnd, _) => m.form("position"),
    }
}

/// What is lost of a path mode.
fn path_relaxed(before: &str, m: Message) -> Message {
    match PathMode::named(before) {
        Some(PathMode::SlowCorners) => m.form("inner"),
        Some(PathMode::Tapping) => m.form("tapping"),
        Some(_) | None => m,
    }
}

/// Why the tool cannot follow a contour.
pub(super) fn unreachable(why: Unreachable, m: Message) -> Message {
    m.form(match why {
        Unreachable::Entry => "entry",
        Unreachable::SmallArc => "small-arc",
        Unreachable::ShortLine => "short-line",
        Unreachable::ShortArc => "short-arc",
        Unreachable::NoMeeting => "no-meeting",
        Unreachable::TurnedBack => "turned-back",
    })
}

/// A variable: by its number as the source writes it (`#500`, `R500`), or its name in backquotes.
fn variable(name: &str, dialect: &Dialect) -> String {
    let rules = &dialect.formula;
    let bare = name.trim_start_matches('#');
    match bare.starts_with(|sign: char| sign.is_ascii_digit()) {
        true => format!("{}{}{bare}", rules.variable, rules.prefix),
        false => format!("`{}`", plain(name)),
    }
}

/// The entry of NC0209: a value is out of its range.
fn out_of_range(what: &Ranged, m: Message) -> Message {
    match what {
        Ranged::Word(word) => m.text("word", shown(word)),
        Ranged::Unnamed => m.form("unnamed"),
        Ranged::TooLarge { about } => m.form("too-large").text("value", about.to_string()),
        Ranged::Turns => m.form("turns"),
        Ranged::Holes => m.form("holes"),
        Ranged::PeckDepth => m.form("peck-depth"),
        Ranged::LengthSum => m.form("length-sum"),
        Ranged::TurnAngle => m.form("turn-angle"),
        Ranged::HighestSpeed => m.form("highest-speed"),
        Ranged::PointNumber => m.form("point-number"),
        Ranged::StoredPosition => m.form("stored-position"),
        Ranged::SkipLevel => m.form("skip-level"),
    }
}
