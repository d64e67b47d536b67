//! Chooses the helps of a fault from its entry in `messages/`. The first help serves most users.

use ncc_dialects::{
    ARC_TOLERANCE, ARC_WITHOUT_CENTRE, CALL_DEPTH, DECIMAL_POINT, Dialect, FIRST_TOOL, MACRO_DEPTH,
    STRAIGHT_LINE,
};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::diag::{ArgumentCheck, Diagnostic, Fault, ModeName, Verdict};
use ncc_ir::program::numbered::Numbered;
use ncc_ir::syntax::Found;
use ncc_ir::unexecuted::{Unexecuted, ValueUnexecuted};

use super::codes::{is_open, is_return};
use super::context::Context;
use super::facts::message;
use super::file_needs;
use super::message::{Help, Message};
use super::unsupported;
use super::unwritable;
use crate::render::numbers::millimetres;
use crate::render::text::{plain, plain_upto};
use crate::review::words::decimal;

/// Tolerances of arcs that are proposed: nanos of a millimetre, and millimetres as they are typed.
const ARC_TOLERANCES: [(u64, &str); 4] =
    [(30_000_000, "0.03"), (50_000_000, "0.05"), (100_000_000, "0.1"), (200_000_000, "0.2")];

/// Most lines that are shown of the standard error of a user's program.
const SAID: usize = 8;

/// The helps of a fault, each an action. Empty if the message suffices.
pub fn advice(fault: &Fault, at: Context) -> Vec<String> {
    message(fault, at).helps(helps(fault, at))
}

/// The helps of a fault where some of them depend on more than the fault's code: on the dialects, on the text, on the
/// fault's data. `None`: the help of its entry, if it has one.
fn helps(fault: &Fault, at: Context) -> Option<Vec<Help>> {
    let has = |dialect: &Dialect, option: &str| dialect.option.iter().any(|row| row.name == option);
    let all = match fault {
        Fault::UnexpectedCharacter { found } if at.from.comment.close == found.to_string() => {
            vec![Help::new("help-bracket")]
        }
        Fault::UnexpectedCharacter { found: '\r' } => vec![Help::new("help-line-ends")],
        Fault::UnclosedComment => match at.from.comment.close.as_str() {
            "" => Vec::new(),
            close => vec![Help::new("help-close").text("close", close)],
        },
        Fault::LetterOForZero => vec![mend(at)],
        // Only some dialects have comments in brackets.
        Fault::Syntax { found, .. }
            if matches!(found, Found::Text(text) if **text == *"(")
                && !at.from.comment.open.starts_with('(') =>
        {
            match at.from.comment.open.trim() {
                "" => Vec::new(),
                open => vec![Help::new("help-comment").text("open", open)],
            }
        }
        Fault::UnknownCode { code } if is_open(code, at.from) => {
            // Of a control whose machine can have codes that call macros.
            let call = at.from.program.macro_b.then(|| Help::new("help-call"));
            unsupported::m_code().into_iter().chain(call).collect()
        }
        Fault::NotSupported { code, .. } if is_open(code, at.from) => unsupported::open(code, at.from),
        Fault::OpeningMarkMissing { follows: true, .. } => {
            return Some(vec![Help::new("help"), Help::new("help-delete")]);
        }
        Fault::NotSupported { code, what } => return unsupported::helps(code, what, at.from),
        Fault::WordMissing { code, .. } if is_return(code, at.from) => return None,
        Fault::WordMissing { code, word } => unsupported::missing(code, word, at.from),
        Fault::ArcWithoutCentre if has(at.from, ARC_WITHOUT_CENTRE) => vec![
            Help::new("help-radius").text("letter", "R"),
            Help::new("help-straight").text("option", ARC_WITHOUT_CENTRE).text("value", STRAIGHT_LINE),
        ],
        Fault::ArcWithoutCentre => match at.from.letter_for(ncc_dialects::Role::Radius) {
            Some(letter) => vec![Help::new("help-radius").text("letter", letter)],
            None => vec![Help::new("help-centre")],
        },
        Fault::ArcEndOffCircle { radii, allowed } => {
            let centre = if at.from.arc.centre_absolute { "help-absolute" } else { "help-incremental" };
            vec![Help::new(centre), arc_tolerance(at.from, *radii, *allowed, "--from-option")]
        }
        Fault::ArcRadiiDiffer { radii, allowed } => {
            vec![Help::new("help"), arc_tolerance(at.to, *radii, *allowed, "--to-option")]
        }
        // A function of a user's program does not know a start that is stated.
        Fault::PositionUnknown { .. } if !at.from.functions.is_empty() => vec![Help::new("help")],
        Fault::PositionUnknown { .. } => vec![Help::new("help"), Help::new("help-start")],
        Fault::CallUnknown { name } => {
            let numbered = at.from.program.called.first().is_some_and(|form| form.starts_with('O'))
                && name.bytes().all(|b| b.is_ascii_digit());
            let file = if numbered { format!("O{name:0>4}") } else { plain(name) };
            vec![Help::new("help").text("file", file), Help::new("help-drop")]
        }
        Fault::CallsDeeper { depth, macros, .. } => {
            let option = call_depth(*macros);
            let takes = |value: &String| value.parse::<u32>().is_ok_and(|value| value >= *depth);
            let open = at.to.option.iter().any(|row| row.name == option && row.values.iter().any(takes));
            let state = open.then(|| Help::new("help-option").text("option", option));
            state.into_iter().chain([Help::new("help")]).collect()
        }
        Fault::CallDepth { macros, .. } => vec![Help::new("help").text("option", call_depth(*macros))],
        Fault::AssumedMode { fact, .. } => vec![Help::new(match fact {
            ModeName::WorkOffset | ModeName::LengthOffset | ModeName::OriginShift => "help-machine",
            ModeName::Motion
            | ModeName::Distance
            | ModeName::Units
            | ModeName::Plane
            | ModeName::FeedMode
            | ModeName::ReturnLevel => "help-program",
        })],
        Fault::AssumedOption { option, .. } => {
            let side = if has(at.from, option) { "from" } else { "to" };
            vec![Help::new("help").text("side", side)]
        }
        Fault::MustBeStated { behaviour } => {
            let option = behaviour.option();
            let values = behaviour.values().iter().map(|value| format!("`--from-option {option}={value}`"));
            vec![Help::new("help").text("options", values.collect::<Vec<_>>().join(" or "))]
        }
        Fault::FeedOnArcs { contour_in_source: false, inner } => {
            vec![Help::new(if *inner { "help-inner" } else { "help-outer" })]
        }
        Fault::DoneByTarget { behaviour } => vec![Help::new(match behaviour {
            Behaviour::ZAtChange => "help-z",
            _ => "help-switch",
        })],
        Fault::MacroLanguage { what }
            if let Some(variable) = what.strip_prefix("M#").filter(|v| is_variable(v)) =>
        {
            vec![Help::new("help-code").text("variable", variable)]
        }
        Fault::PointNotAllowed { word } => {
            let whole = word.split_once('.').filter(|(_, digits)| digits.bytes().all(|digit| digit == b'0'));
            vec![
                whole.map_or(Help::new("help"), |(whole, _)| {
                    Help::new("help-whole").text("whole", plain(whole))
                }),
            ]
        }
        Fault::NoToolSelected => {
            let preselected =
                has(at.from, FIRST_TOOL).then(|| Help::new("help-first-tool").text("option", FIRST_TOOL));
            [Help::new("help")].into_iter().chain(preselected).collect()
        }
        Fault::VariableUnset { .. } => vec![Help::new("help"), Help::new("help-value")],
        Fault::NotExecuted {
            what: Unexecuted::Value(ValueUnexecuted::PeckClearanceUnknown | ValueUnexecuted::BreakLiftUnknown),
        } => vec![Help::new("help-option")],
        Fault::TargetLacks { lack } => unwritable::helps(lack, at),
        Fault::RotaryTurnOpen { .. } => rotary_turn(at),
        Fault::NoFileOfTool { needs } => file_needs::helps(*needs),
        Fault::NotInMap { what, .. } => vec![Help::new(match what {
            Numbered::LengthEntry => "help-entry",
            Numbered::Tool | Numbered::WorkOffset | Numbered::Program => "help-name",
        })],
        Fault::NotTheSame { .. } | Fault::NotReadBack { .. } => {
            vec![Help::new("help"), Help::new("help-report")]
        }
        Fault::ArgumentNeeded { check, .. } => vec![match check {
            ArgumentCheck::NotAsked => Help::new("help"),
            ArgumentCheck::Whole => Help::new("help-whole"),
            ArgumentCheck::Nothing => Help::new("help-zero"),
            ArgumentCheck::LeftOut => Help::new("help-left-out"),
            ArgumentCheck::Default(value) => {
                Help::new("help-default").text("value", decimal(value.trimmed()))
            }
        }],
        _ => return None,
    };
    Some(all)
}

/// The option for how deep calls may go.
fn call_depth(macros: bool) -> &'static str {
    if macros { MACRO_DEPTH } else { CALL_DEPTH }
}

/// How to state which way machines turn a rotary axis: by the number, or the shortest way.
fn rotary_turn(at: Context) -> Vec<Help> {
    let way = Behaviour::RotaryTurn;
    let values = way.values();
    let open = [("from", at.from), ("to", at.to)]
        .into_iter()
        .filter(|(_, dialect)| dialect.behaviour_row(way).is_some_and(|row| row.open));
    let state = open.map(|(side, dialect)| {
        Help::new("help-state")
            .text("control", dialect.id.as_str())
            .text("side", side)
            .text("option", way.option())
            .text("value", values[0])
            .text("other", values[1])
    });
    state.chain([Help::new("help")]).collect()
}

/// What a control accepts of the radii of an arc, and how a machine states another tolerance where its dialect has an
/// option for that.
fn arc_tolerance(dialect: &Dialect, radii: [i64; 2], allowed: i64, option: &str) -> Help {
    let off = radii[0].abs_diff(radii[1]);
    // What rounding makes; more is another centre.
    let next = ARC_TOLERANCES.into_iter().find(|(nanos, _)| *nanos >= off).map_or("MM", |(_, text)| text);
    let help = match dialect.option.iter().find(|row| row.name == ARC_TOLERANCE) {
        Some(row) => Help::new("help-tolerance-option")
            .text("option", format!("{option} {}", row.name))
            .text("value", next),
        None => Help::new("help-tolerance"),
    };
    help.text("control", dialect.id.as_str()).text("allowed", millimetres(allowed))
}

/// What else may be the cause of a fault, by what was found beside it: an arc does not close where numbers without a point
/// count otherwise on the control that the program was written for.
pub fn beside(fault: &Fault, all: &[Diagnostic], at: Context) -> Option<String> {
    if !matches!(fault, Fault::ArcEndOffCircle { .. } | Fault::ArcRadiusTooSmall) {
        return None;
    }
    let option = at.from.option.iter().find(|option| option.name == DECIMAL_POINT)?;
    let other = option.values.iter().find(|value| **value != option.default)?;
    let help = all.iter().find_map(|d| match &d.fault {
        Fault::AssumedBareNumber { word, value } if !word.starts_with(['F', 'S', 'P']) => Some(
            Help::new("help-decimal-point")
                .text("word", plain(word))
                .text("value", plain(value))
                .text("option", format!("--from-option {DECIMAL_POINT}={other}")),
        ),
        _ => None,
    })?;
    message(fault, at).helps(Some(vec![help])).pop()
}

/// Facts that are too long for a label, a line each.
pub fn details(fault: &Fault) -> Vec<String> {
    match fault {
        Fault::NotTheSame { difference } => {
            plain_upto(difference, 600).split("; ").map(str::to_owned).collect()
        }
        // The end of what it wrote says most.
        Fault::FunctionFailed { said, .. } => {
            let lines: Vec<String> = said
                .lines()
                .filter(|line| !line.trim().is_empty())
                .map(|line| plain_upto(line, 160))
                .collect();
            lines[lines.len().saturating_sub(SAID)..].to_vec()
        }
        _ => Vec::new(),
    }
}

/// What to say of a verdict that stops a translation.
pub fn stopped(verdict: Verdict, denied: bool) -> String {
    let form = if denied { "deny" } else { "allow" };
    Message::common(form).text("verdict", verdict.name()).headline()
}

/// The text with the digit 0 for the letter O that the diagnostic points at; where that is a whole
/// word, for every O in it but a leading one, which is its address.
fn mend(at: Context) -> Help {
    let (before, after) = at.beside;
    let whole = [before, at.snippet, after].concat();
    if whole.chars().count() > 40 || at.snippet.is_empty() || whole.chars().count() < 2 {
        return Help::new("help-zero");
    }
    let zeros = |text: &str| text.replace(['O', 'o'], "0");
    let mended = match at.snippet.chars().nth(1) {
        None => zeros(at.snippet),
        Some(_) => {
            let address = at.snippet.chars().next().map_or(0, char::len_utf8);
            [&at.snippet[..address], &zeros(&at.snippet[address..])].concat()
        }
    };
    Help::new("help-word").text("mended", format!("{before}{mended}{after}"))
}

/// Whether a text is the number or the name of a variable.
fn is_variable(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}
