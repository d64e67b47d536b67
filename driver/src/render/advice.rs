//! What to do about a fault: at most two lines, the first one what most people will want.

use ncc_dialects::{
    ARC_TOLERANCE, ARC_WITHOUT_CENTRE, CALL_DEPTH, CodeRow, DECIMAL_POINT, Dialect, MACRO_DEPTH,
    RADIUS_UNSAID, STRAIGHT_LINE,
};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::PathMode;
use ncc_ir::diag::{ArgumentCheck, Diagnostic, Fault, ModeName, Verdict};
use ncc_ir::program::numbered::Numbered;

use super::file_needs;
use super::numbers::{millimetres, signed};
use super::spelled::mode;
use super::text::{plain, plain_upto};
use super::unsupported::{self, m_code, without_radius, without_tool};
use super::unwritable;
use super::words::Context;
use crate::review::words::decimal;

/// Tolerances of arcs that are proposed: nanos of a millimetre, and millimetres as they are typed.
const ARC_TOLERANCES: [(u64, &str); 4] =
    [(30_000_000, "0.03"), (50_000_000, "0.05"), (100_000_000, "0.1"), (200_000_000, "0.2")];

/// What to do. Empty where the message says it already.
pub fn advice(fault: &Fault, at: Context) -> Vec<String> {
    let from = at.from.id.as_str();
    let own = |text: &str| vec![text.to_owned()];
    match fault {
        Fault::UnexpectedCharacter { found } if at.from.comment.close == found.to_string() => {
            own("a comment ends at its first closing sign: take inner brackets away")
        }
        Fault::UnexpectedCharacter { found: '\r' } => own(
            "a line ends here with CR alone: save the file with line ends LF or CR LF: `tr '\\r' '\\n' < FILE > NEW`",
        ),
        Fault::UnexpectedCharacter { .. } => {
            vec![format!("is the source really {from}? `--from auto` looks at the text and says why")]
        }
        Fault::BadNumber { .. } => own("write digits, at most one point and one sign: `-12.5`"),
        Fault::UnclosedComment => match at.from.comment.close.as_str() {
            "" => Vec::new(),
            close => vec![format!("close it with `{close}` in the same line")],
        },
        Fault::BlockTooLong { .. } => own("are the line ends still there? some transfers strip them"),
        Fault::NotText => own("choose the part program itself: a text file, one block a line"),
        Fault::WordWithoutNumber { letter } => vec![format!("if zero is meant, write `{letter}0`")],
        Fault::LetterOForZero => own(&mend(at)),
        Fault::EmptyProgram => own("the file is empty, or holds comments alone: is it the right one?"),
        // Only some dialects have comments in brackets.
        Fault::Syntax { found, .. } if **found == *"(" && !at.from.comment.open.starts_with('(') => {
            match at.from.comment.open.trim() {
                "" => Vec::new(),
                open => vec![format!("a comment of {from} begins with `{open}`")],
            }
        }
        Fault::Syntax { .. } => Vec::new(),
        Fault::NoProgramEnd => {
            own("is the file complete? if so, end the program with its end code, such as M30")
        }
        Fault::OpeningMarkMissing { mark } => {
            vec![format!("put a line with `{mark}` before the first block, or take this one away")]
        }
        Fault::TextAfterEnd => own("delete it, or move the end of the program behind it"),
        Fault::LabelTwice { .. } => own("give each block that is jumped to a number of its own"),
        Fault::TextBeforeStart { .. } => own("delete it, or make it a comment behind the program number"),
        Fault::ComparedLast { .. } => own("put each comparison in parentheses"),

        Fault::UnknownCode { code } if is_open(code, at.from) => {
            let mut all = vec![m_code(code)];
            // Of a control whose machine can have codes that call macros.
            if at.from.program.macro_b {
                all.push(format!(
                    "if it calls a macro with the words beside it: `--call {code}=drop` leaves both out"
                ));
            }
            all
        }
        Fault::NotSupported { code, .. } if is_open(code, at.from) => unsupported::open(code, at.from),
        Fault::UnknownCode { .. } => {
            vec![format!("`ncc dialects show {from}` lists what is known; nothing unknown is passed on")]
        }
        Fault::NotSupported { code, name } => unsupported::help(code, name, at.from),
        Fault::CodesExclude { .. } => {
            own("put them into blocks of their own, in the order in which they shall act")
        }
        Fault::WordUnused { .. } => own("delete the word, or add the code that it belongs to"),
        Fault::WordMissing { code, word } if &**word == "D" && matches!(&**code, "G41" | "G42") => {
            let mut all = vec![format!(
                "write the D number of the tool's radius, for example `{code} D1`: none is active here"
            )];
            match at.from.option.iter().any(|row| row.name == RADIUS_UNSAID) {
                true => all.push(without_radius()),
                false => {
                    all.push("if its H is the radius, as on a Fanuc 0, write D in the place of H".into());
                }
            }
            all
        }
        Fault::WordMissing { code, word } => {
            let mut all = unsupported::missing(code, word, at.from);
            all.extend(unsupported::length_in_force(code, word, at.from));
            all
        }
        Fault::WordTwice { .. } => own("keep one of the two"),
        Fault::TooManyCodes { .. } => own("spread the codes over several blocks"),
        Fault::PointNotAllowed { .. } => own("write it without a point"),
        Fault::OutOfRange { .. } => Vec::new(),
        Fault::NoMotionMode => own("say the motion before the first axis word: rapid, feed or arc"),
        Fault::ArcWithoutCentre if at.from.option.iter().any(|row| row.name == ARC_WITHOUT_CENTRE) => vec![
            "add the centre (I, J, K), or the radius (R)".into(),
            format!(
                "if the control goes straight to the end point (parameter 3403#5 CIR = 0): `--from-option \
                 {ARC_WITHOUT_CENTRE}={STRAIGHT_LINE}`"
            ),
        ],
        Fault::ArcWithoutCentre => match at.from.letter_for(ncc_dialects::Role::Radius) {
            Some(letter) => vec![format!("add the centre (I, J, K), or the radius ({letter})")],
            None => own("add the centre (I, J, K)"),
        },
        Fault::ArcCentreAndRadius => own("keep the centre, or the radius"),
        Fault::ArcEndOffCircle { radii, allowed } => {
            let check = match at.from.arc.centre_absolute {
                true => {
                    "check the centre: here it is measured from program zero, not from the start of the arc"
                }
                false => {
                    "check the centre: here it is measured from the start of the arc, not from program zero"
                }
            };
            vec![check.to_owned(), arc_tolerance(at.from, *radii, *allowed, "--from-option")]
        }
        Fault::RefusedCompensated { .. } | Fault::CompensatedThere { .. } => {
            own("move it before the block that switches compensation on, or behind the one that ends it")
        }
        Fault::ArcRadiiDiffer { radii, allowed } => {
            let correct = "correct the centre so that both radii are equal";
            vec![correct.to_owned(), arc_tolerance(at.to, *radii, *allowed, "--to-option")]
        }
        Fault::ArcRadiusTooSmall => own("check the radius, the end point, and where the tool stands before"),
        Fault::NoArc => {
            own("check the angle (more than 0, less than 360), and that the points do not lie on a line")
        }
        Fault::NoCorner { .. } => {
            own("check the size of the corner, and that a line or an arc of the same plane follows it")
        }
        Fault::ArcRadiusNoWay => own("write a full circle with its centre (I, J, K)"),
        Fault::PositionUnknown { axis } => vec![
            format!("say the position: an absolute {axis} word before this block"),
            format!("or, if the tool stands somewhere when the program starts: `--start {axis}100`"),
        ],
        Fault::CallUnknown { name } => {
            let numbered = at.from.program.called.first().is_some_and(|form| form.starts_with('O'))
                && name.bytes().all(|b| b.is_ascii_digit());
            let file = if numbered { format!("O{name:0>4}") } else { plain(name) };
            vec![
                format!(
                    "name the folder that has it as {file}: `-I FOLDER`; or put it into this file, after the end"
                ),
                format!("if the call has no effect on the cut, leave it out: `--call {}=drop`", plain(name)),
            ]
        }
        Fault::CallsDeeper { depth, macros, .. } => {
            let option = if *macros { MACRO_DEPTH } else { CALL_DEPTH };
            let mut ways = own("put the blocks of some subprograms into those that call them");
            let takes = |value: &String| value.parse::<u32>().is_ok_and(|value| value >= *depth);
            if at.to.option.iter().any(|row| row.name == option && row.values.iter().any(takes)) {
                ways.insert(0, format!("if your control takes {depth}: `--to-option {option}={depth}`"));
            }
            ways
        }
        Fault::CallDepth { sure, macros, .. } => {
            let option = if *macros { MACRO_DEPTH } else { CALL_DEPTH };
            vec![format!("state what your control takes: `--to-option {option}={sure}`, or more")]
        }
        Fault::CallsTooDeep { .. } => own("put some of the called blocks into the programs that call them"),
        Fault::NoEnd { .. } => own("count fewer iterations for the trial, or look whether its loops end"),
        Fault::CallRecursive { .. }
        | Fault::ProgramTwice { .. }
        | Fault::Endless
        | Fault::Interrupted { .. } => Vec::new(),
        Fault::LabelUnknown { .. } => own(
            "put the label where the block looks for it: before one that repeats, in its direction from a jump",
        ),
        Fault::AssumedHoleOrder { .. } => own("check that the order of the holes does not matter"),
        Fault::AssumedPath { .. } => own("compare corners on the machine with what the program wants"),
        Fault::PathRelaxed { from, .. } => match PathMode::named(from) {
            Some(PathMode::SlowCorners) => own("say a lower feed where the contour turns inwards"),
            Some(PathMode::Tapping) => own("leave feed hold and override alone in these blocks"),
            _ => own("check corners and their tolerance on the machine"),
        },
        Fault::AssumedMilling { .. } => own("make sure that the program is for a mill"),
        Fault::AssumedTip => own(
            "check on the machine which rotary axes there are, their senses, and whether the zero turns with the work",
        ),
        Fault::AssumedTilt => {
            own("turn onto each plane on the machine first, with the tool far off the work")
        }
        Fault::AssumedContourEnds => {
            own("look at the way onto the contour and off it on the machine, and at the radius in its table")
        }
        Fault::CutStanding => own("write `M03` before this block, with a speed: `S1000 M03`"),
        Fault::AssumedToolChange { .. } => {
            own("state what your machine does: `--from-option tool_with_change=named` or `=waiting`")
        }
        Fault::AssumedCycle { motion, .. } => {
            vec![format!(
                "leave {motion} out; or state `--from-option cycle_beside_motion=drilled` or `=cancelled`"
            )]
        }
        Fault::AssumedReturn { .. } => {
            own("state what your machine does: `--from-option return_distance=last` or `=first`")
        }
        Fault::AssumedControl { taken, other } => {
            vec![format!("name the control: `--from {}` or `--from {}`", plain(taken), plain(other))]
        }
        Fault::StartedAgain { .. } => {
            own("check at the machine that it runs before the tool touches the part")
        }
        Fault::OpenBehaviour { behaviour, source, taken, other } => {
            let side = if *source { "from" } else { "to" };
            let option = behaviour.option();
            own(&format!("state what your machine does: `--{side}-option {option}={taken}` or `={other}`"))
        }
        Fault::FeedAtUnits { .. } => own("state F behind the change of units in the source"),
        Fault::OptionalStopDiffers => {
            own("say `M03` and `M08` after `M01` in the source, as the cut needs them")
        }
        Fault::MustBeStated { behaviour } => {
            let option = behaviour.option();
            let values = behaviour.values().iter().map(|value| format!("`--from-option {option}={value}`"));
            own(&format!("state it: {}", values.collect::<Vec<_>>().join(" or ")))
        }
        Fault::PathAtStart { .. } => {
            own("program the path mode at the start: exact stop, or rounding with its tolerance")
        }
        Fault::NextRunShifted { .. } | Fault::NextRunTurned => {
            own("cancel it in the source before its end, or state it at its start")
        }
        Fault::NextRunVariables { .. } => {
            own("set the variable before the program reads it, or at the start of each shift by hand")
        }
        Fault::RoundsFreely => own(
            "state how far corners lie from the path on the source's machine, `--from-option path_tolerance=0.02`, or program a tolerance",
        ),
        Fault::FeedOnArcs { contour_in_source: true, .. } => {
            own("look at F on inner arcs: the contour is cut faster there, and slower on outer ones")
        }
        Fault::FeedOnArcs { inner: false, .. } => {
            own("look at F on outer arcs: the contour is cut faster there, and slower on inner ones")
        }
        Fault::FeedOnArcs { .. } => own("look at F on inner arcs: the contour is cut slower there"),
        Fault::LengthByHand { .. } => {
            own("touch off with this tool before the program goes on, and check its first move along Z")
        }
        Fault::MovedAtChange => own("check at the machine that the way up is free"),
        Fault::SideEffectWritten { .. } => Vec::new(),
        Fault::DoneByTarget { behaviour } => own(match behaviour {
            Behaviour::ZAtChange => "move Z where the cut begins, before it, after the tool change",
            _ => "say `M03` or `M04`, and `M08`, after this code in the source",
        }),
        Fault::AssumedContourPath => own("look at corners, and at both ends of the contour, on the machine"),
        Fault::RadiusUnknown { .. } => own(
            "state the tool's diameter in the profile of the source's machine, or the radius in the program",
        ),
        Fault::ContourUnreachable { .. } => own("take a smaller tool, or change the contour at this place"),
        Fault::CompensationExpanded { .. } => Vec::new(),
        Fault::AssumedRadius { .. } => own("give the radius entry of that number the radius of the tool"),
        Fault::AssumedEdge { .. } => {
            own("give the length-table entry of that number the length of the tool's edge 1")
        }
        Fault::FramesExpanded | Fault::CycleFolded { .. } | Fault::PatternFolded { .. } => Vec::new(),
        Fault::MacroLanguage { what } if what.strip_prefix("M#").is_some_and(is_variable) => vec![format!(
            "if the program never sets #{0}, state the code: `--value {0}=8` for M8",
            what.trim_start_matches("M#")
        )],
        Fault::MacroLanguage { .. } => own("write the values out, or see to this place by hand"),
        Fault::NoToolSelected => without_tool(at.from),
        Fault::NoFeed => own("say the feed in this block or before it"),
        Fault::NoSpeed => own("say the speed of the spindle before it"),
        Fault::NoValue { .. } => {
            own("see which values its variables have there; a control stops with an alarm")
        }
        Fault::BeginsOtherwise { fact } => {
            let text = format!("write the code of the {} at the start of the program", mode(*fact));
            own(&text)
        }
        Fault::VariableUnset { name } => {
            let value = format!("or state what it holds: `--value {name}=NUMBER`");
            vec!["set the variable before it is read".into(), value]
        }
        Fault::Computes { .. } => {
            own("`--pass flatten` executes the program, and writes the blocks that come of it")
        }
        Fault::NoCycle => own("call the cycle up before the positions"),
        Fault::CycleUpsideDown => own("check the signs of the bottom and of the retract plane"),
        Fault::EntryFactNeeded { .. } => own("say it in the subprogram itself"),
        Fault::NotExecuted { what } if what.starts_with("an unknown ") => own(
            "state it: `--from-option NAME=VALUE` where the dialect has such an option, or [options] of a machine profile",
        ),
        Fault::NotExecuted { .. } => own("write it another way; a translation with `--to ir` keeps it"),

        Fault::AssumedMode { fact, .. } => match fact {
            ModeName::WorkOffset | ModeName::LengthOffset | ModeName::OriginShift => {
                own("check that this is how the machine is set up when the program starts")
            }
            ModeName::Motion
            | ModeName::Distance
            | ModeName::Units
            | ModeName::Plane
            | ModeName::FeedMode
            | ModeName::ReturnLevel => {
                vec![format!("to be sure, say the {} at the start of the program", mode(*fact))]
            }
        },
        Fault::AssumedNoEffect { .. } => {
            own("if your manual knows an effect, do not use the output before it is seen to")
        }
        Fault::AssumedBareNumber { .. } => {
            vec![format!("write a decimal point, or see the options of `ncc dialects show {from}`")]
        }
        Fault::AssumedOffsetWithZ => own("check the first Z after it"),
        Fault::AssumedWorkOffset { .. } => own("set the machine's zero in this offset"),
        Fault::AssumedRow { .. } => {
            vec![format!("check your manual; `ncc dialects show {from}` names the source")]
        }
        Fault::AssumedOption { option, .. } => {
            let side = if at.from.option.iter().any(|o| o.name == **option) { "from" } else { "to" };
            vec![format!("decide it with `--{side}-option {option}=…`, see `ncc dialects show`")]
        }
        Fault::AssumedParameter { .. } => own("compare with the parameter on your machine"),

        Fault::CommentReformatted
        | Fault::ArcReformatted
        | Fault::Rounded { .. }
        | Fault::PatternExpanded { .. }
        | Fault::PolarExpanded
        | Fault::MachineCutExpanded { .. }
        | Fault::MachineCutFolded { .. }
        | Fault::PeckShortened
        | Fault::MacroCloned { .. }
        | Fault::CornerExpanded
        | Fault::FeedByTime
        | Fault::CycleExpanded { .. }
        | Fault::CallExpanded { .. }
        | Fault::Flattened { .. }
        | Fault::AlarmsRenumbered { .. }
        | Fault::ValuesInFull { .. }
        | Fault::AlarmValues
        | Fault::VariablesRenamed { .. }
        | Fault::RepeatExpanded { .. }
        | Fault::NumbersLeftOut { .. }
        | Fault::AdviceLeftOut { .. }
        | Fault::WorkOffsetLeftOut { .. }
        | Fault::NameAsComment
        | Fault::MessageAsComment
        | Fault::CodeLeftOut { .. }
        | Fault::ToolNumbered { .. }
        | Fault::EdgeNumbered { .. }
        | Fault::NameChanged { .. }
        | Fault::BlockSplit => Vec::new(),
        Fault::SkipLevelLost { .. } => own("the operator must not use the switches one by one any more"),
        Fault::OutputDropped => own("see that nobody waits for what was written"),
        Fault::MessageDropped => own("tell the operator on the setup sheet"),

        Fault::TargetLacks { what } => unwritable::help(what, at.from, at.to),
        Fault::RotaryTurnOpen { by, or, .. } => rotary_turn([*by, *or], at),
        Fault::SecondWorkOffset { .. } => own("make one program for each work offset"),
        Fault::NoFileOfTool { needs } => file_needs::advice(*needs),
        Fault::ModeNotSet { .. } => own("say it at the head of the program"),
        Fault::ArcVanishes => own("leave the arc out of the source: it is below the resolution"),
        Fault::TargetRange { .. } => Vec::new(),
        Fault::NotInMap { what, .. } => {
            vec![match what {
            Numbered::LengthEntry => {
                "state the entry as `length_entry` of a tool that both profiles name, or leave all names \
                 out of one of them: numbers then stay as they are"
            }
            Numbered::Tool | Numbered::WorkOffset | Numbered::Program => {
                "give it the same name in both profiles, or leave all names out of one of them: numbers \
                 then stay as they are"
            }
        }
        .to_owned()]
        }
        Fault::ProfileDenies { .. } => own("write this place another way, or correct the profile"),

        Fault::NotTheSame { .. } | Fault::NotReadBack { .. } => vec![
            "this is a fault of ncc, not of your program; nothing is released".to_owned(),
            "please report it with the program, or the lines around this place".to_owned(),
        ],
        Fault::BranchUncovered { .. } | Fault::OutputNotTaken { .. } | Fault::NotCalled { .. } => {
            own("look at what is written for it yourself")
        }
        Fault::FactNotTried { behaviour: Some(behaviour), source } => {
            let (side, option) = (if *source { "from" } else { "to" }, behaviour.option());
            own(&format!("state what your machine does: `--{side}-option {option}=VALUE`"))
        }
        Fault::FactNotTried { behaviour: None, .. } => own("look at what follows the optional stop yourself"),
        Fault::ArgumentNeeded { check, .. } => match check {
            ArgumentCheck::NotAsked => own("look at the calls of this macro: each must give it"),
            ArgumentCheck::Whole => own("look at the calls: each must give it, as a whole number"),
            ArgumentCheck::Nothing => own("look at the calls: each must give it, also where it is zero"),
            ArgumentCheck::LeftOut => {
                own("look at the calls of this macro: one that leaves it out is not translated")
            }
            ArgumentCheck::Default(value) => vec![format!(
                "look at the calls of this macro: one that counted on this default must give {}",
                decimal(value.trimmed())
            )],
        },
        Fault::SkipSettingsSampled { .. } | Fault::VariableGiven { .. } | Fault::ValueNotRead { .. } => {
            Vec::new()
        }
    }
}

/// How to state which way machines turn a rotary axis: by the number, or the shortest way; nanos of a degree.
fn rotary_turn([by, or]: [i64; 2], at: Context) -> Vec<String> {
    let way = Behaviour::RotaryTurn;
    let values = way.values();
    let open = [("from", at.from), ("to", at.to)]
        .into_iter()
        .filter(|(_, dialect)| dialect.behaviour_row(way).is_some_and(|row| row.open));
    let state = open.map(|(side, dialect)| {
        let option = way.option();
        format!(
            "state how {} turns it: `--{side}-option {option}={}` (by {}) or `={}` (by {})",
            dialect.id,
            values[0],
            signed(by),
            values[1],
            signed(or)
        )
    });
    let mut all: Vec<String> = state.collect();
    all.push("or turn it by less than half a turn in each block".to_owned());
    all
}

/// What a control accepts of the radii of an arc, and how a machine states another tolerance where its dialect has an
/// option for that.
fn arc_tolerance(dialect: &Dialect, radii: [i64; 2], allowed: i64, option: &str) -> String {
    let accepts = format!("{} accepts a difference of {} mm here", dialect.id, millimetres(allowed));
    let off = radii[0].abs_diff(radii[1]);
    // What rounding makes; more is another centre.
    let next = ARC_TOLERANCES.into_iter().find(|(nanos, _)| *nanos >= off).map_or("MM", |(_, text)| text);
    match dialect.option.iter().find(|row| row.name == ARC_TOLERANCE) {
        Some(row) => format!("{accepts}; if your machine accepts more: `{option} {}={next}`", row.name),
        None => accepts,
    }
}

/// What else may be the cause of a fault, by what was found beside it: an arc does not close where numbers without a point
/// count otherwise on the control that the program was written for.
pub fn beside(fault: &Fault, all: &[Diagnostic], at: Context) -> Option<String> {
    if !matches!(fault, Fault::ArcEndOffCircle { .. } | Fault::ArcRadiusTooSmall) {
        return None;
    }
    let option = at.from.option.iter().find(|option| option.name == DECIMAL_POINT)?;
    let other = option.values.iter().find(|value| **value != option.default)?;
    all.iter().find_map(|d| match &d.fault {
        Fault::AssumedBareNumber { word, value } if !word.starts_with(['F', 'S', 'P']) => Some(format!(
            "or is `{}`, read as {}, meant in whole units? then add `--from-option {DECIMAL_POINT}={other}`",
            plain(word),
            plain(value),
        )),
        _ => None,
    })
}

/// Facts that are too long for a label, a line each.
pub fn details(fault: &Fault) -> Vec<String> {
    match fault {
        Fault::NotTheSame { difference } => {
            plain_upto(difference, 600).split("; ").map(str::to_owned).collect()
        }
        _ => Vec::new(),
    }
}

/// What to say of a verdict that stops a translation.
pub fn stopped(verdict: Verdict, denied: bool) -> String {
    match denied {
        true => format!("stopped because of `--deny {}`", verdict.name()),
        false => format!("to accept this loss, add `--allow {}`", verdict.name()),
    }
}

/// The text with the digit 0 for the letter O that the diagnostic points at; where that is a whole
/// word, for every O in it but a leading one, which is its address.
fn mend(at: Context) -> String {
    let (before, after) = at.beside;
    let whole = [before, at.snippet, after].concat();
    if whole.chars().count() > 40 || at.snippet.is_empty() || whole.chars().count() < 2 {
        return "write the digit 0".to_owned();
    }
    let zeros = |text: &str| text.replace(['O', 'o'], "0");
    let mended = match at.snippet.chars().nth(1) {
        None => zeros(at.snippet),
        Some(_) => {
            let address = at.snippet.chars().next().map_or(0, char::len_utf8);
            [&at.snippet[..address], &zeros(&at.snippet[address..])].concat()
        }
    };
    format!("write the digit 0: `{before}{mended}{after}`")
}

/// Whether a code is an M code that the user may say something of: the dialect does not have it, or refuses it.
fn is_open(code: &str, dialect: &Dialect) -> bool {
    let number = code.strip_prefix('M').and_then(|number| number.parse::<u32>().ok());
    number.is_some_and(|number| may_be_stated(dialect.code_row(b'M', number.saturating_mul(10))))
}

/// Whether what a code does may be stated by the user: the dialect does not have it, or refuses it, and it does not name
/// blocks to go on at.
pub fn may_be_stated(row: Option<&CodeRow>) -> bool {
    row.is_none_or(|row| row.means.is_none() && row.blocks.is_empty())
}

/// Whether a text is the number or the name of a variable.
fn is_variable(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}
