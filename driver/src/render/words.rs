//! What every fault is called: its message, and the words at its place.
//!
//! A message says what is wrong in a line; the label says why this very place. What to do about it
//! is in `advice`, the background on the fault's page in `pages/`.

mod at_machine;
mod further;
mod verified;

use ncc_dialects::Dialect;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::diag::Fault;

use super::file_needs;
use super::numbers::{calls, given_number, millimetres, numbered, plural, rotary_turn, thousands};
use super::spelled::{
    Counted, character, found_words, kept, mode, radii_of, radius_unknown, return_path, variables,
    work_offset,
};
use super::text::{plain, quoted};

/// What the wording may name besides the fault's own data.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// The source's dialect.
    pub from: &'a Dialect,
    /// The target's dialect.
    pub to: &'a Dialect,
    /// The text that the diagnostic points at.
    pub snippet: &'a str,
    /// What stands directly before and after it.
    pub beside: (&'a str, &'a str),
}

/// The words of a fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Words {
    /// What is wrong, in one line.
    pub message: String,
    /// Why this place.
    pub label: String,
    /// What the related places are.
    pub related: &'static str,
}

/// The words of a fault.
pub fn words(fault: &Fault, at: Context) -> Words {
    let from = at.from.id.as_str();
    let to = at.to.id.as_str();
    let (message, label): (String, String) = match fault {
        Fault::UnexpectedCharacter { found } => (
            format!("unexpected character {}", character(*found)),
            format!("nothing in {from} begins with it"),
        ),
        Fault::BadNumber { text } => {
            (format!("{} is not a number", quoted(text)), "a decimal of at most 18 digits".into())
        }
        Fault::UnclosedComment => {
            ("comment is not closed".into(), "opened here, and still open at the end of the line".into())
        }
        Fault::BlockTooLong { limit } => {
            (format!("block is longer than {limit} bytes"), "this block, or line".into())
        }
        Fault::NotText => ("this is not a part program".into(), "bytes that no text contains".into()),
        Fault::WordWithoutNumber { letter } => {
            (format!("`{letter}` without a number"), format!("{from} does not read this as zero"))
        }
        Fault::LetterOForZero => ("letter O where a zero is meant".into(), "this is the letter".into()),
        Fault::EmptyProgram => ("nothing to translate".into(), "the main program has no blocks".into()),
        Fault::Syntax { found, expected } => {
            (format!("{} is not expected here", found_words(found)), format!("expected {}", plain(expected)))
        }
        Fault::NoProgramEnd => ("the program does not say that it ends".into(), "the text ends here".into()),
        Fault::OpeningMarkMissing { mark } => (
            format!("the program stands before the only {}", quoted(mark)),
            "a control reads from here, and finds nothing".into(),
        ),
        Fault::TextAfterEnd => {
            ("text after the end of the program".into(), "the control never comes here".into())
        }
        Fault::LabelTwice { name } => (
            format!("{} stands more than once in this program", plain(name)),
            "the control goes to the first one that it finds".into(),
        ),
        Fault::TextBeforeStart { mark } => (
            format!("text before the first {}", quoted(mark)),
            "the control does not read it, and neither does ncc".into(),
        ),
        Fault::ComparedLast { what } => (
            format!("{} compares last of all", quoted(what)),
            "AND, OR, XOR and NOT come before comparisons here".into(),
        ),

        Fault::UnknownCode { code } => {
            (format!("{} is unknown", quoted(code)), format!("not in the dictionary of {from}"))
        }
        Fault::NotSupported { code, name } => (
            format!("{} is not supported: {}", quoted(code), plain(name)),
            "this version does nothing with it".into(),
        ),
        Fault::CodesExclude { first, second } => (
            format!("{} and {} in one block", quoted(first), quoted(second)),
            "each would cancel the other: they are of one modal group".into(),
        ),
        Fault::WordUnused { word } => {
            (format!("nothing in this block uses {}", quoted(word)), "no code here takes this word".into())
        }
        Fault::WordMissing { code, word } => (
            format!("{} without {}", quoted(code), quoted(word)),
            format!("needs {} in the same block", quoted(word)),
        ),
        Fault::WordTwice { letter } => (format!("`{letter}` twice in one block"), "again".into()),
        Fault::TooManyCodes { letter, limit } => (
            format!("too many {letter} codes in one block"),
            format!("{from} takes {limit} {letter} {} in a block", plural(u64::from(*limit), "code")),
        ),
        Fault::PointNotAllowed { word } => {
            (format!("decimal point in {}", quoted(word)), "a whole number is expected".into())
        }
        Fault::OutOfRange { word } => {
            (format!("{} is out of range", quoted(word)), "no such value can be used here".into())
        }
        Fault::NoMotionMode => {
            ("axis words without a motion code".into(), "rapid, feed or arc? none has been said".into())
        }
        Fault::ArcWithoutCentre => ("arc without centre or radius".into(), "where is its centre?".into()),
        Fault::ArcCentreAndRadius => {
            ("arc with both centre and radius".into(), "one of the two is too many".into())
        }
        Fault::ArcEndOffCircle { radii, allowed: _ } => {
            ("the end of the arc is not on its circle".into(), radii_of(*radii))
        }
        Fault::RefusedCompensated { what } => (
            format!("{from} refuses {} under cutter compensation", plain(what)),
            "the control stops here: compensation is on".into(),
        ),
        Fault::CompensatedThere { what } => (
            format!("{to} refuses {} under cutter compensation", plain(what)),
            "compensation is on here, or may be".into(),
        ),
        Fault::ArcRadiiDiffer { radii, allowed: _ } => {
            (format!("{to} does not accept the two radii of this arc"), radii_of(*radii))
        }
        Fault::ArcRadiusTooSmall => (
            "the radius is too small for this arc".into(),
            "less than half the distance from start to end".into(),
        ),
        Fault::NoArc => ("no arc fits these words".into(), "this arc".into()),
        Fault::NoCorner { what } => (format!("this corner cannot be made: {what}"), "this corner".into()),
        Fault::ArcRadiusNoWay => (
            "arc by radius, with its end where the tool stands".into(),
            "any number of circles would fit".into(),
        ),
        Fault::PositionUnknown { axis } => (
            format!("it is not known where {axis} stands"),
            format!("this depends on the position of {axis}"),
        ),
        Fault::CallUnknown { name } => {
            (format!("program {} is not in this file", quoted(name)), "called here".into())
        }
        Fault::CallsTooDeep { name, most } => (
            format!("the call of {} stands within {most} others", quoted(name)),
            "no control calls that deep: it ends with an alarm".into(),
        ),
        Fault::CallsDeeper { name, depth, most, macros } => (
            format!("{} go {depth} deep, {to} takes {most}", calls(*macros)),
            format!("the call of {} is the first too many", quoted(name)),
        ),
        Fault::CallDepth { depth, sure, macros } => (
            format!("{} go {depth} deep; older controls take {sure}", calls(*macros)),
            "the control ends the program with an alarm if it takes fewer".into(),
        ),
        Fault::CallRecursive { name } => {
            (format!("program {} calls itself", quoted(name)), "this call never comes to an end".into())
        }
        Fault::ProgramTwice { name } => {
            (format!("two programs are called {}", quoted(name)), "the second one".into())
        }
        Fault::MacroLanguage { what } => (
            format!("the macro language is not supported: {}", plain(what)),
            "a variable, an expression or a jump".into(),
        ),
        Fault::NoToolSelected => {
            ("tool change without a tool".into(), "no tool number has been said before".into())
        }
        Fault::NoFeed => (
            "move at feed without a feed".into(),
            "none has been said in the feed mode that is in force".into(),
        ),
        Fault::NoSpeed => ("a thread without a speed".into(), "no spindle speed has been said before".into()),
        Fault::NoValue { what } => ("an expression without a value".into(), format!("this is {what}")),
        Fault::VariableUnset { name } => (
            format!("variable {name} is read and was never set"),
            "what it holds, the control alone knows".into(),
        ),
        Fault::BeginsOtherwise { fact } => (
            format!("{} at the end is not that of the start", mode(*fact)),
            "the program begins again here with other modes".into(),
        ),
        Fault::Computes { what } => (
            format!("what is computed when the program runs is not written for {to}"),
            format!("this is {what}"),
        ),
        Fault::NoCycle => {
            ("hole positions without a cycle".into(), "no cycle is in force to be made here".into())
        }
        Fault::CycleUpsideDown => (
            "the retract plane is below the bottom of the hole".into(),
            "the tool would drill upwards".into(),
        ),
        Fault::EntryFactNeeded { fact } => (
            format!("this depends on the {}, which only the caller knows", mode(*fact)),
            "never said in this program".into(),
        ),
        Fault::NotExecuted { what } => (
            format!("{} cannot be executed", plain(what)),
            "can be written down, but not executed by this version".into(),
        ),
        Fault::LabelUnknown { name } => (
            format!("label {} does not stand where this block looks for it", quoted(name)),
            "meant here".into(),
        ),
        Fault::AssumedHoleOrder { pattern } => (
            format!("{}: order of the holes as written assumed", plain(pattern)),
            "a control may begin at another corner or end, by where the tool stands".into(),
        ),
        Fault::AssumedPath { path } => (
            format!("corners taken by {} assumed", plain(path)),
            format!("{to} has no word for it, and is taken to do it always"),
        ),
        Fault::AssumedMilling { looks_like, .. } => {
            (format!("a milling program assumed; it looks like {}", plain(looks_like)), "the sign".into())
        }
        Fault::AssumedTip => (
            "points of the tool's tip: rotary axes and zero as on the other control assumed".into(),
            "names, senses and zeros of the rotary axes are the machine's, and what the zero turns with"
                .into(),
        ),
        Fault::AssumedTilt => (
            "tilted plane: the tool turned onto it as on the other control assumed".into(),
            "which way the rotary axes go, and the linear axes with them, is the machine's".into(),
        ),
        Fault::StartedAgain { behaviour } => (
            format!("{}: started again before this cut", behaviour.about()),
            format!("{to} may have switched it off by itself, {from} has not"),
        ),
        Fault::OpenBehaviour { behaviour, source, other, .. } => {
            at_machine::open_behaviour(*behaviour, other, if *source { from } else { to })
        }
        Fault::NextRunShifted { axis, source, target } => {
            at_machine::next_run_shifted(*axis, [(from, *source), (to, *target)])
        }
        Fault::RoundsFreely => (
            "check at the machine: corners are rounded without a tolerance".into(),
            format!(
                "{from} rounds them by what its axes lag behind, {to} as far as the acceleration asks for"
            ),
        ),
        Fault::NextRunTurned => (
            "check at the machine: the next run begins in another frame".into(),
            "one control keeps a rotation, scale or mirror at the end of the program, the other does not"
                .into(),
        ),
        Fault::NextRunVariables { names, source, target } => (
            format!("check at the machine: the next run reads other values: {}", variables(names)),
            format!("kept {} on {from}, {} on {to}", kept(*source), kept(*target)),
        ),
        Fault::FeedAtUnits { before, now } => at_machine::feed_at_units(*before, *now, from),
        Fault::OptionalStopDiffers => (
            "check at the machine: the cut after an optional stop".into(),
            format!("with the switch on, {from} and {to} do not do the same here"),
        ),
        Fault::PathAtStart { source, target } => (
            "check at the machine: the program sets no path mode".into(),
            format!("corners: {source} on {from}, {target} on {to}"),
        ),
        Fault::FeedOnArcs { contour_in_source, .. } => {
            at_machine::feed_on_arcs(*contour_in_source, [from, to])
        }
        Fault::LengthByHand { tool } => (
            format!("check at the machine: set the zero of Z by tool {tool} when it is put in"),
            format!("{to} has no tool lengths; the change is by hand"),
        ),
        Fault::MovedAtChange => (
            "check at the machine: this tool change takes Z to machine zero".into(),
            format!("{to} goes there by itself, {from} does not"),
        ),
        Fault::SideEffectWritten { behaviour: behaviour @ Behaviour::FeedOnArcs } => (
            format!("{}, written as a code", behaviour.about()),
            format!("{from} and {to} begin with another meaning of F there"),
        ),
        Fault::SideEffectWritten { behaviour } => {
            (format!("{}, written as words", behaviour.about()), format!("{from} does it by itself here"))
        }
        Fault::RotaryTurnOpen { axis, by, or } => (
            rotary_turn(*axis, *by, *or),
            format!("a setting of each machine decides, on {from} and on {to}"),
        ),
        Fault::MustBeStated { behaviour } => (
            format!("{}: what does {from} do here?", behaviour.about()),
            format!("a parameter of the machine decides; {to} must be told"),
        ),
        Fault::DoneByTarget { behaviour } => (
            format!("{}: {to} does more here than {from}", behaviour.about()),
            "the source cuts with what this control has switched or moved".into(),
        ),
        Fault::AssumedContourEnds => (
            "cutter radius compensation: the same way onto the contour and off it assumed".into(),
            "each control has a way of its own; the contour between is the same".into(),
        ),
        Fault::CutStanding => (
            "feed move with the spindle stopped".into(),
            "no M03 or M04 with a speed is active at this move".into(),
        ),
        Fault::AssumedToolChange { named, waiting } => (
            format!("T{named} beside M06 taken for the tool that is put in"),
            format!("T{waiting} waits since an earlier block, and the next H is H{waiting}"),
        ),
        Fault::AssumedReturn { code, words, zero, last } => (
            format!(
                "{} {}",
                quoted(code),
                return_path(words, *zero, if *last { Counted::OfPart } else { Counted::FromHere })
            ),
            "G90 and G91 in one block: the last one counts".into(),
        ),
        Fault::AssumedCycle { cycle, motion } => (
            format!("{} beside {} drills", quoted(cycle), quoted(motion)),
            "manuals of other controls: the motion cancels the cycle".into(),
        ),
        Fault::AssumedControl { taken, other } => (
            format!("read as {}; {} reads it otherwise", plain(taken), plain(other)),
            "both readings differ here first".into(),
        ),
        Fault::AssumedContourPath => (
            "cutter radius compensation worked out as RS274/NGC describes it".into(),
            "corners, the way onto the contour and off it are each control's own".into(),
        ),
        Fault::RadiusUnknown { entry } => {
            (radius_unknown(*entry), "the path of the tool's centre cannot be worked out".into())
        }
        Fault::ContourUnreachable { why } => {
            (format!("this contour cannot be gone along: {why}"), "the tool would cut into it".into())
        }
        Fault::CompensationExpanded { radius } => (
            "compensated contour written as the path of the tool's centre".into(),
            format!("by the radius {} mm", millimetres(*radius)),
        ),
        Fault::AssumedRadius { entry } => (
            format!("radius entry {entry} = the radius with the tool or length {entry} assumed"),
            "one control has radii in entries of their own, the other with the tool".into(),
        ),
        Fault::AssumedEdge { tool } => (
            format!("edge 1 of tool {tool} = entry {tool} of the length table assumed"),
            "one control has lengths by edge, the other by entry".into(),
        ),
        Fault::FramesExpanded => {
            ("frame worked into the coordinates".into(), "the target has no words for it".into())
        }
        Fault::CycleFolded { kind, holes } => {
            (format!("{holes} holes written as the cycle {}", plain(kind)), "long-hand moves here".into())
        }
        Fault::PatternFolded { pattern, holes, .. } => {
            (format!("{holes} positions written as a {}", plain(pattern)), "positions here".into())
        }
        Fault::Endless => (
            "this loop is never left".into(),
            "here all is as it was a turn before: the program comes round again and again".into(),
        ),
        Fault::NoEnd { steps } => {
            let steps = thousands(*steps);
            (
                "the program runs for too long to be executed".into(),
                format!("still running after {steps} blocks"),
            )
        }
        Fault::Interrupted { steps } => {
            ("interrupted".into(), format!("the program was here, after {} blocks", thousands(*steps)))
        }

        Fault::AssumedMode { fact, value } => (
            format!("{}: {} assumed", mode(*fact), plain(value)),
            "the program relies on it here and never says it".into(),
        ),
        Fault::AssumedNoEffect { code } => (
            format!("{} assumed to have no effect", quoted(code)),
            "no source tells of any effect; kept as a comment".into(),
        ),
        Fault::AssumedBareNumber { word, value } => (
            format!("{} read as {}", quoted(word), plain(value)),
            "no decimal point: the control's setting decides".into(),
        ),
        Fault::AssumedOffsetWithZ => (
            "length offset taken up with the next Z".into(),
            "stands alone here; written into the next block with a Z".into(),
        ),
        Fault::AssumedWorkOffset { offset } => (
            format!("the only work offset taken for {}", work_offset(*offset, [at.to, at.from])),
            "here it is first relied on".into(),
        ),
        Fault::AssumedRow { code, meaning } => (
            format!("{} assumed to mean {}", quoted(code), plain(meaning)),
            "no manual confirms this row of the dictionary".into(),
        ),
        Fault::AssumedOption { option, value } => (
            format!("{} assumed to be {}", quoted(option), quoted(value)),
            "the sources leave it open".into(),
        ),
        Fault::AssumedParameter { parameter, value } => (
            format!("{} assumed to be {}", plain(parameter), plain(value)),
            "a parameter of the machine decides".into(),
        ),

        Fault::CommentReformatted => {
            ("comment rewritten".into(), format!("in the characters that {to} can show"))
        }
        Fault::ArcReformatted => {
            ("centre of the arc rewritten".into(), format!("in the form that {to} takes"))
        }
        Fault::Rounded { word, written } => {
            (format!("{} rounded to {}", quoted(word), quoted(written)), format!("finer than {to} resolves"))
        }
        Fault::PatternExpanded { holes } => (
            format!("pattern written out as {holes} {}", plural(u64::from(*holes), "position")),
            format!("{to} has no word for it"),
        ),
        Fault::MachineCutExpanded { offset } => (
            "cut in machine coordinates written in the work offset".into(),
            format!(
                "{to} goes there rapidly alone; less the offsets, it is the same place in {}",
                work_offset(*offset, [at.to, at.from])
            ),
        ),
        Fault::MachineCutFolded { .. } => (
            "written as a cut in machine coordinates".into(),
            format!("{to} has a word for a place less the offsets in force"),
        ),
        Fault::MacroCloned { name, names } => (
            format!("the macro {} is written as {}", plain(name), plain(names)),
            format!("calls give it different arguments, and {to} does not know which are given"),
        ),
        Fault::PeckShortened => (
            "peck as long as its hole".into(),
            format!("a longer first peck is an alarm on {to}: the hole is made in one go"),
        ),
        Fault::PolarExpanded => (
            "point by radius and angle written by its coordinates".into(),
            format!("{to} does not say it so"),
        ),
        Fault::FeedByTime => (
            "feed of linear and rotary axes together, written by time".into(),
            format!("{from} and {to} count F otherwise here"),
        ),
        Fault::CornerExpanded => (
            "corner written out as an arc or a line".into(),
            format!("{to} has no word for it, or none for this one"),
        ),
        Fault::CycleExpanded { kind } => {
            (format!("{} cycle written out as moves", plain(kind)), format!("{to} has no word for it"))
        }
        Fault::CallExpanded { name, times } => (
            format!("program {} written out {times} {}", quoted(name), plural(u64::from(*times), "time")),
            "where it is called".into(),
        ),
        Fault::Flattened { blocks } => (
            format!("executed, and written as {blocks} straight blocks"),
            "variables, loops, jumps and subprograms are gone, with the comments beside them".into(),
        ),
        Fault::AlarmsRenumbered { map } => ("alarms have other numbers".into(), format!("in {to}, {map}")),
        Fault::OutputDropped => {
            ("text for a device left out".into(), format!("{to} does not write it; a comment is left"))
        }
        Fault::AlarmValues => {
            ("values in an alarm left out".into(), "its text has three points in their place".into())
        }
        Fault::ValuesInFull { digits } => (
            format!("a value in a message has {digits} digits behind its point"),
            format!("{to} does not leave out the zeros at its end"),
        ),
        Fault::VariablesRenamed { map } => ("variables have other names".into(), format!("in {to}, {map}")),
        Fault::SkipLevelLost { level } => (
            format!("block-skip level {level} lost"),
            format!("{to} cannot tell this switch from the others"),
        ),
        Fault::PathRelaxed { from, to: mode } => at_machine::path_relaxed(from, mode, to),
        Fault::AdviceLeftOut { kind } => (
            format!("{} left out: no effect on the cut", plain(&kind.replace('-', " "))),
            format!("{to} has no word of this kind; the programmed moves stay"),
        ),
        Fault::WorkOffsetLeftOut { offset } => (
            format!("work offset {offset} left out"),
            format!("{to} has no word for it; nothing moves before the next one"),
        ),
        Fault::NumbersLeftOut { count } => (
            format!("{count} block {} left out", plural(u64::from(*count), "number")),
            "the first one".into(),
        ),
        Fault::NameAsComment => {
            ("program name kept as a comment".into(), format!("{to} has no place for it"))
        }
        Fault::NameChanged { from, to: name } => {
            (format!("{} is called {}", plain(from), plain(name)), format!("{to} cannot have the name"))
        }
        Fault::BlockSplit => ("block written as several".into(), "this block".into()),
        Fault::MessageDropped => {
            ("message to the operator lost".into(), format!("{to} cannot show a message"))
        }
        Fault::CodeLeftOut { code } => {
            (format!("{} left out", quoted(code)), "stated to have no effect on the cut".into())
        }
        Fault::ToolNumbered { .. } | Fault::EdgeNumbered { .. } => {
            (given_number(fault), "numbered in the order of use: put it into this place".into())
        }
        Fault::MessageAsComment => {
            ("message kept as a comment".into(), format!("{to} shows none while the program runs"))
        }
        Fault::RepeatExpanded { times } => (
            format!("repetition written out {times} {}", plural(u64::from(*times), "time")),
            format!("{to} has no word for it"),
        ),

        Fault::TargetLacks { what } => {
            (format!("{to} has no words for this: {}", plain(what)), "cannot be written".into())
        }
        Fault::SecondWorkOffset { first, second } => (
            format!("a second work offset, and {to} has one"),
            format!("offset {second} here; the program began with offset {first}"),
        ),
        Fault::NoFileOfTool { needs } => {
            ("a tool cannot have a file of its own here".into(), file_needs::label(*needs))
        }
        Fault::ModeNotSet { fact } => (
            format!("the program never says its {}", mode(*fact)),
            format!("{to} always begins with one of its own, so this would not be the same there"),
        ),
        Fault::ArcVanishes => (
            "the arc is too small to be written".into(),
            format!("its ends become one point when rounded to the digits of {to}"),
        ),
        Fault::ProfileDenies { fact, machine } => (
            format!("the profile of {} says otherwise", plain(machine)),
            format!("this rests on {}", plain(fact)),
        ),
        Fault::NotInMap { what, number, name } => (
            format!("the other machine's number of {} {number} is not known", numbered(*what, 1)),
            match name {
                Some(name) => format!("the target's profile has nothing named {}", plain(name)),
                None => "the source's profile has no name for it".into(),
            },
        ),
        Fault::TargetRange { word } => {
            (format!("{} cannot be written", quoted(word)), format!("out of the range of {to}"))
        }

        Fault::NotTheSame { .. } => (
            "the output does not do the same as the source".into(),
            "the first difference is made here".into(),
        ),
        Fault::NotReadBack { code } => (
            "the output cannot be read back".into(),
            format!("reading what was written for this gives NC{code:04}"),
        ),
        Fault::VariableGiven { name } => (
            format!("the variable {name} is read before the program sets it"),
            "values were made up for it, the same for both programs".into(),
        ),
        Fault::ValueNotRead { name } => (
            format!("a value is stated for the variable {name}, and the program does not rely on it"),
            "it is read nowhere before the program sets it".into(),
        ),
        Fault::NotCalled { name } => (
            format!("nothing in the program calls the subprogram {name}"),
            "it was written, and not executed when the program was verified".into(),
        ),
        Fault::ArgumentNeeded { name, place, check } => verified::argument_needed(name, *place, check),
        Fault::BranchUncovered { holds, fails } => verified::not_taken([*holds, *fails]),
        Fault::OutputNotTaken { blocks } => (
            "not all of the output was executed when it was verified".into(),
            format!("it decides more often than the source; not both ways were gone of: {}", plain(blocks)),
        ),
        Fault::FactNotTried { behaviour, source } => {
            verified::fact_not_tried(*behaviour, if *source { from } else { to })
        }
        Fault::SkipSettingsSampled { levels } => (
            format!("not every setting of {levels} block-skip switches was tried"),
            "each switch alone and every pair were".into(),
        ),
    };
    Words { message, label, related: further::related(fault) }
}
