//! What to type where a code is not supported.

use ncc_dialects::{
    BLOCK_WITHOUT_WAY, CodeRow, DWELL_REFUSED, Dialect, FIRST_TOOL, LOOKED_OVER, MACHINE_LENGTH,
    MACHINE_WITHOUT_AXIS, Meaning, NO_RADIUS, NOTHING, RADIUS_UNSAID, Role,
};
use ncc_exec::NOWHERE;
use ncc_ir::expr::system::System;
use ncc_passes::frames::machine_moves::FROM_MACHINE;
use ncc_passes::modes::feed_unit::ENDED;
use ncc_passes::tools::tool_edge::LENGTH_IN_USE;

/// The ways out of a block of which `name` says what is not supported; `code` is its text.
pub(super) fn help(code: &str, name: &str, from: &Dialect) -> Vec<String> {
    let own = |text: &str| vec![text.to_owned()];
    if let Some(typed) = variant(code, from).or_else(|| by_option(name, from)) {
        return typed;
    }
    match name {
        _ if name.starts_with("return in the main program") => vec![
            "to run it once: delete this block, and end the program with M30".into(),
            "if another program calls this one: delete the M30, and give it a number of its own".into(),
        ],
        "machine coordinates without an axis word" => {
            let delete = format!("delete `{code}`, or add the axis that moves: no axis is in its block");
            let option = from.option.iter().any(|row| row.name == MACHINE_WITHOUT_AXIS);
            let nothing =
                format!("if no axis moves on the control: `--from-option {MACHINE_WITHOUT_AXIS}={NOTHING}`");
            std::iter::once(delete).chain(option.then_some(nothing)).collect()
        }
        "variable of the control" => vec![format!(
            "state what it holds, if that is the same wherever the program reads it: `--value '{code}=NUMBER'`"
        )],
        _ if name.ends_with(" while a cycle is in force") => {
            own("write `G80` before this block: a call or a jump may lead here with a cycle active")
        }
        _ if name.starts_with("computed feed that may count") => own(
            "`--from-option feed_unit=inch` or `feed_unit=mm`: the basic system of the machine, which F counts where lengths \
             are those of G70 or G71",
        ),
        "variable that the program does not define" => vec![
            format!("state what it holds at the start, if a definition file has it: `--value {code}=NUMBER`"),
            format!(
                "if only programs of the control read it, leave its assignments out: `--value {code}=drop`"
            ),
        ],
        "D of a block before, of which entry is not known here" => {
            let write = format!(
                "write the D number of the tool's radius in this block: for example `{code} D1` for entry 1"
            );
            let goes_without = from.option.iter().any(|row| row.name == RADIUS_UNSAID);
            std::iter::once(write).chain(goes_without.then(without_radius)).collect()
        }
        "data input for the entry of a code in force that the program has not said" => {
            let variable = code.rsplit_once('#').map_or("", |(_, number)| number);
            vec![
                format!("state the code that is in force at the start: `--value '#{variable}=NUMBER'`"),
                "or write the number of the entry in its place: for example `P1`".into(),
            ]
        }
        _ if name.ends_with("of a block before, of which entry is not known here") => {
            let letter = name.chars().next().unwrap_or('H');
            own(&format!(
                "write the {letter} number in this block: for example `{code} {letter}1` for entry 1"
            ))
        }
        "data input for an entry whose number only the running program knows" => {
            own("write the number of the entry in its place: for example `P1`")
        }
        "VAR, or a first value, in a subprogram without its main program" => {
            own("translate the program that calls this one: `-I FOLDER` finds both")
        }
        _ if name.starts_with("time that goes on while") => own(
            "delete the blocks that set and ask the timer, if they only tell a run in graphics from one at the machine",
        ),
        "whether a probe has touched" => {
            own("probe with `G38.2`, which ends in an alarm where nothing is touched, and delete this check")
        }
        "data input of this kind" => own("delete these blocks, and set the parameter at the machine"),
        _ if code.starts_with('#') && name.starts_with("place of the control's tables whose number") => {
            own("write the number of the entry in its place: `#2001` for the length of entry 1")
        }
        "pocket milling" => own(POCKET),
        _ if name.starts_with("circular pocket") => own(POCKET),
        _ => own("write this place another way, or see to it by hand"),
    }
}

/// The ways out of a move in machine coordinates in which the tool's length counts.
pub(super) fn machine_length(from: &Dialect) -> Vec<String> {
    let own = from.option.iter().find(|row| row.name == MACHINE_LENGTH);
    let suppressed = format!(
        "if the control leaves the length out of such blocks (MD 10760 = 1): `--from-option {MACHINE_LENGTH}=suppressed`"
    );
    let cancel = "else cancel the length in this block, and activate it with the next absolute Z: for example `SUPA Z0 D0`";
    match own {
        Some(_) => vec![suppressed, cancel.to_owned()],
        None => vec!["cancel the length in this block, and activate it with the next absolute Z".to_owned()],
    }
}

/// What to write where a code lacks a word.
pub(super) fn missing(code: &str, word: &str, from: &Dialect) -> Vec<String> {
    let add = format!("add `{}` to this block", super::text::plain(word));
    let retract = from.cycle_row(code).is_some_and(|row| row.retract.to_string() == word)
        && from.cycles.retained_by_all();
    let why = format!(
        "without {word} a control stops with an alarm, goes on with the {word} of an earlier cycle, or drills from where \
         the tool stands: its manual does not say which"
    );
    std::iter::once(add).chain(retract.then_some(why)).collect()
}

/// What to type where an option decides what a word is: its name in brackets ends the fault's.
fn by_option(name: &str, from: &Dialect) -> Option<Vec<String>> {
    let option = name.split_once("(option ")?.1.strip_suffix(')')?;
    let row = from.option.iter().find(|row| row.name == option)?;
    let values = row.values.iter().filter(|value| *value != DWELL_REFUSED);
    let typed: Vec<String> = values.map(|value| format!("`--from-option {option}={value}`")).collect();
    Some(vec![format!("state what the control does with it: {}; else delete it", typed.join(" or "))])
}

/// The options under which the source's control has a code that it refuses else.
pub(super) fn variant(code: &str, from: &Dialect) -> Option<Vec<String>> {
    let same = |row: &CodeRow| row.code == code && row.means.is_some();
    let variant = from.variant.iter().find(|variant| variant.code.iter().any(same))?;
    let holds =
        |option: &str, value: &str| from.option.iter().any(|row| row.name == option && row.default == value);
    let left = variant.when.iter().filter(|(option, value)| !holds(option, value));
    let options: Vec<String> =
        left.map(|(option, value)| format!("--from-option {option}={value}")).collect();
    let options = options.join(" ");
    (!options.is_empty()).then(|| vec![format!("if the control of this program has {code}: `{options}`")])
}

/// What can be said of an M code that the dialect refuses.
pub(super) fn open(code: &str, from: &Dialect) -> Vec<String> {
    variant(code, from).into_iter().flatten().chain([m_code(code)]).collect()
}

/// What can be said of a code that is the machine's own.
pub(super) fn m_code(code: &str) -> String {
    format!(
        "`--m-code {code}=drop` if it has no effect on the cut, `--m-code {code}=carry` if the target's machine has \
         it too, `--m-code {code}=M…` if that has another code for it; or `[[m_code]]` in the profiles"
    )
}

/// The option for a control that goes without compensation where no radius is named.
pub(super) fn without_radius() -> String {
    format!("if the control goes without compensation here: `--from-option {RADIUS_UNSAID}={NO_RADIUS}`")
}

/// Cycles of which the control computes the path.
const POCKET: &str =
    "the control computes this path by itself: post the pocket as moves, with `G01`, `G02` and `G03`";

/// The way out of a refusal of lengths and feeds, as text to type.
pub(super) fn way_out(what: &str) -> Option<&'static str> {
    match what {
        LENGTH_IN_USE => Some("set this length before the tool change"),
        FROM_MACHINE => Some("write this Z absolutely: `G90` and the Z of its end point"),
        ENDED => Some("write F again before this block: `F100.` for 100 a minute"),
        _ => None,
    }
}

/// What to do about blocks of a compensated contour that go nowhere, or not in the plane.
pub(super) fn without_way(what: &str, from: &Dialect) -> Vec<String> {
    let leave_out =
        "leave out the blocks here that move by less than the target's least increment, or not in the plane";
    let mut ways = vec![leave_out.to_owned()];
    if what == NOWHERE && from.option.iter().any(|row| row.name == BLOCK_WITHOUT_WAY) {
        let option = format!("--from-option {BLOCK_WITHOUT_WAY}={LOOKED_OVER}");
        ways.push(format!("if the control looks over blocks without a way (MD 20252): `{option}`"));
    }
    ways
}

/// What to type for a tool change before which no tool is selected.
pub(super) fn without_tool(from: &Dialect) -> Vec<String> {
    let mut ways = vec!["write the tool number in this block: `T1 M06` for tool 1".to_owned()];
    if from.option.iter().any(|row| row.name == FIRST_TOOL) {
        let waits = "if a tool waits when the program begins: `--from-option first_tool=1` for tool 1";
        ways.push(waits.to_owned());
    }
    ways
}

/// What to type for the entry of a length that is in force at the start, where a code lacks its word.
pub(super) fn length_in_force(code: &str, word: &str, from: &Dialect) -> Option<String> {
    let length =
        from.code.iter().any(|row| row.code == code && row.means == Some(Meaning::UseToolLengthOffset));
    let letter = from.letter_for(Role::LengthEntry).map(String::from);
    if !length || letter.as_deref() != Some(word) {
        return None;
    }
    let name = variable(&System::LengthEntry, from)?;
    Some(format!("or state the {word} code that is in force at the start: `--value '#{name}=NUMBER'`"))
}

/// The number of the variable by which a program asks this of the control.
fn variable(asked: &System, from: &Dialect) -> Option<String> {
    let mut all = from.system.iter().flat_map(|row| row.says());
    all.find(|(says, _)| says == asked).map(|(_, name)| name.to_string())
}
