//! What to type where the target has no words for something.

use ncc_dialects::{BLOCK_SKIP, Dialect, FURTHER_POINT, LEFT_OUT, STORED_POSITION, TAP_DWELL};
use ncc_exec::{NOWHERE, STILL};
use ncc_ir::behaviour::Behaviour;
use ncc_passes::frames::frame_increments;
use ncc_passes::modes::side_effects::NEEDS_Z;

use super::unsupported;

/// The ways out of what cannot be written: `what` names it.
pub(super) fn help(what: &str, from: &Dialect, to: &Dialect) -> Vec<String> {
    let own = |text: &str| vec![text.to_owned()];
    let id = to.id.as_str();
    match what {
        _ if what.ends_with("that is measured with the tool's length") => unsupported::machine_length(from),
        _ if what.starts_with("a tool called ") => {
            vec![
                "name it in the profile of the machine that it is for: `[[tool]]` with `number` and `name`"
                    .into(),
            ]
        }
        _ if what.starts_with("a canned cycle that stays active over a tool change") => {
            own("write `G80` before the tool change, and the whole cycle again after it")
        }
        "control of the tool's tip" => {
            vec![format!("{id} has none: post the program again for the axes of the machine")]
        }
        _ if what.starts_with("edge ") && what.ends_with(" of a tool") => {
            vec![
                format!("{id} has a number for edge 1 alone: give this edge a tool of its own"),
                "or state its entry in the profile of the target's machine: `[[edge]]` with `tool`, `edge` and \
                 `length_entry`"
                    .into(),
            ]
        }
        "mist coolant" => {
            own("`--m-code M07=M08` for flood coolant in its place, `--m-code M07=drop` for none")
        }
        _ if what.starts_with("a rigid thread with something else before its way back") => rigid_dwell(from),
        _ if [NOWHERE, STILL].contains(&what) => unsupported::without_way(what, from),
        _ if let Some(way) = unsupported::way_out(what) => own(way),
        _ if what.starts_with("a feed of linear and rotary axes together from a place that is not known") => {
            own(
                "move its axes to a place before, or state where they stand at the start, if no work offset is selected before: \
             `--start A0` for A at 0 degrees",
            )
        }
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
        _ if let Some(option) = place_option(what, from) => {
            vec![
                format!("if that point is the machine's zero: `--from-option {option}=zero`"),
                "else write the move in machine coordinates, with G53".into(),
            ]
        }
        "a program that begins again" => own("write `M30` in its place: the program then runs once"),
        "an optional stop" => {
            own("`--m-code M1=drop` leaves it out: the program never stops there, as with the switch off")
        }
        _ if what.starts_with("a tool change by hand, which") => {
            own("`--to-option tool_change=manual` writes a block that stops the program for it")
        }
        _ if what.starts_with("a block that can be skipped and decides")
            && from.option.iter().any(|row| row.name == BLOCK_SKIP) =>
        {
            own("state how the block-skip switch stands: `--from-option block_skip=on` or `=off`")
        }
        _ if what.starts_with("an arc so short") => {
            own("leave this arc out where it is shorter than the target's least increment")
        }
        "a tool change while a canned cycle is active" => own("write `G80` before this block"),
        "a tool change that keeps the length of another tool" => {
            own("state the tool length offset between the tool change and this move: `G43` with its H number")
        }
        _ if what.starts_with("a spindle that goes on turning") => {
            let mut all = own("stop the spindle before the change, or start it right behind");
            let option = Behaviour::SpindleAtChange.option();
            if from.option.iter().any(|row| row.name == option) {
                let own = format!("if the machine's change stops it: `--from-option {option}=stops`");
                all.push(own);
            }
            all
        }
        _ if what.starts_with(frame_increments::REFUSED) => {
            let mut all = own("give the axis its first word after the change in G90");
            let included = Behaviour::FrameOffsetIncremental;
            if to.behaviour_row(included).is_some_and(|row| row.open) {
                let other = format!(
                    "if the target's control moves by the word alone: `--to-option {}={}`",
                    included.option(),
                    included.values()[0]
                );
                all.push(other);
            }
            all
        }
        NEEDS_Z => {
            let mut all = own("after the tool change, move Z in G90 with a rapid move, before this block");
            let change = Behaviour::ZAtChange;
            if to.behaviour_row(change).is_some_and(|row| row.open) {
                let up = change.values()[1];
                let option = change.option();
                all.push(format!("if the target's control goes up there: `--to-option {option}={up}`"));
            }
            all
        }
        _ => {
            vec![format!("write it in a way that {id} has words for: `ncc dialects show {id}`")]
        }
    }
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
