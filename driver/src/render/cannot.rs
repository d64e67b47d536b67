//! What to type where the target has no words for something, and where a word is missing that the start may have.

use ncc_dialects::{BLOCK_SKIP, Dialect, FURTHER_POINT, LEFT_OUT, Meaning, Role, STORED_POSITION, TAP_DWELL};
use ncc_exec::{NOWHERE, STILL};
use ncc_ir::expr::system::System;

use super::words::Context;

/// The ways out of what cannot be written; `None` if there is none to name here.
pub(super) fn help(what: &str, at: Context) -> Option<Vec<String>> {
    let to = at.to.id.as_str();
    let own = |text: &str| vec![text.to_owned()];
    let help = match what {
        _ if what.ends_with("that is measured with the tool's length") => {
            own("cancel the length in this block, and activate it with the next absolute Z")
        }
        _ if what.starts_with("a tool called ") => {
            vec![
                "name it in the profile of the machine that it is for: `[[tool]]` with `number` and `name`"
                    .into(),
            ]
        }
        _ if what.starts_with("a canned cycle that stays active over a tool change") => {
            own("write `G80` before the tool change, and the whole cycle again after it")
        }
        _ if what == "control of the tool's tip" => {
            vec![format!("{to} has none: post the program again for the axes of the machine")]
        }
        _ if what.starts_with("edge ") && what.ends_with(" of a tool") => {
            vec![
                format!("{to} has a number for edge 1 alone: give this edge a tool of its own"),
                "or state its entry in the profile of the target's machine: `[[edge]]` with `tool`, `edge` and \
                 `length_entry`"
                    .into(),
            ]
        }
        _ if what == "mist coolant" => {
            own("`--m-code M07=M08` for flood coolant in its place, `--m-code M07=drop` for none")
        }
        _ if what.starts_with("a rigid thread with something else before its way back") => {
            rigid_dwell(at.from)
        }
        _ if [NOWHERE, STILL].contains(&what) => own(
            "leave out the blocks here that move by less than the target's least increment, or not in the plane",
        ),
        _ if what.starts_with("a pitch with so many digits") => {
            own("write the feed by the minute before the cycle: `G94`, and F = pitch × S")
        }
        _ if what.starts_with("fine boring whose direction") => own(
            "state the parameter of the source's control: `--from-option bore_shift=+1` (`-1`, `+2`, `-2`: along the \
             first or second axis of the plane)",
        ),
        _ if what.starts_with("entry ") && what.contains("of the length table with tool") => {
            vec![
                "state in the profile of the source's machine that the entry is this tool's: `[[tool]]` with `number`, \
                 `name` and `length_entry`, and the same `name` in the target's; `ncc doctor` writes both"
                    .into(),
            ]
        }
        _ if let Some(option) = place_option(what, at.from) => {
            vec![
                format!("if that point is the machine's zero: `--from-option {option}=zero`"),
                "else write the move in machine coordinates, with G53".into(),
            ]
        }
        _ if what == "a program that begins again" => {
            own("write `M30` in its place: the program then runs once")
        }
        _ if what == "an optional stop" => {
            own("`--m-code M1=drop` leaves it out: the program never stops there, as with the switch off")
        }
        _ if what.starts_with("a tool change by hand, which") => {
            own("`--to-option tool_change=manual` writes a block that stops the program for it")
        }
        _ if what.starts_with("a block that can be skipped and decides")
            && at.from.option.iter().any(|row| row.name == BLOCK_SKIP) =>
        {
            own("state how the block-skip switch stands: `--from-option block_skip=on` or `=off`")
        }
        _ if what.starts_with("an arc so short") => {
            own("leave this arc out where it is shorter than the target's least increment")
        }
        _ if what == "a tool change while a canned cycle is active" => own("write `G80` before this block"),
        _ if what == "a tool change that keeps the length of another tool" => {
            own("state the tool length offset between the tool change and this move: `G43` with its H number")
        }
        _ if what.starts_with("a feed of linear and rotary axes together from a place that is not known") => {
            own(
                "move its axes to a place before, or state where they stand at the start, if no work offset is selected before: \
             `--start A0` for A at 0 degrees",
            )
        }
        _ => return None,
    };
    Some(help)
}

/// The option of the source's dialect that states where a point of the machine is, which the target has no word for.
fn place_option(what: &str, from: &Dialect) -> Option<&'static str> {
    let option = match what {
        "a move to a position that is stored in the control" => STORED_POSITION,
        "a move to this point of the machine" => FURTHER_POINT,
        _ => return None,
    };
    from.option.iter().any(|row| row.name == option).then_some(option)
}

/// The ways out of a rigid tap that dwells.
fn rigid_dwell(from: &Dialect) -> Vec<String> {
    let leave = "leave out the dwell of the tapping cycle (P), if the spindle may turn back at once";
    match from.option.iter().any(|row| row.name == TAP_DWELL) {
        true => vec![format!(
            "`--from-option {TAP_DWELL}={LEFT_OUT}`, if the spindle may turn back at once: it stands during P, and cuts \
             nothing"
        )],
        false => vec![leave.to_owned()],
    }
}

/// The ways out of a code without a word that it needs.
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
    from.system.iter().flat_map(|row| row.says()).find(|(says, _)| says == asked).map(|(_, name)| name)
}
