//! What to type where the target has no words for something.

use ncc_dialects::{BLOCK_SKIP, Dialect, FURTHER_POINT, LEFT_OUT, STORED_POSITION, TAP_DWELL};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::lack::{
    ArcsLack, CompensationLack, FeedsLack, FlowLack, FramesLack, HolesLack, Lack, LengthsLack, MachineLack,
    SpindleLack, ThreadsLack, ToolsLack,
};

use super::unsupported;

/// The ways out of what cannot be written.
pub(super) fn help(lack: &Lack, from: &Dialect, to: &Dialect) -> Vec<String> {
    let own = |text: &str| vec![text.to_owned()];
    let id = to.id.as_str();
    match lack {
        Lack::Machine(MachineLack::WithToolLength) => unsupported::machine_length(from),
        Lack::Tools(ToolsLack::Name { .. }) => {
            vec![
                "name it in the profile of the machine that it is for: `[[tool]]` with `number` and `name`"
                    .into(),
            ]
        }
        Lack::Holes(HolesLack::ActiveOverToolChange) => {
            own("write `G80` before the tool change, and the whole cycle again after it")
        }
        Lack::Tools(ToolsLack::TipControl) => {
            vec![format!("{id} has none: post the program again for the axes of the machine")]
        }
        Lack::Tools(ToolsLack::EdgeNumber { .. }) => {
            vec![
                format!("{id} has a number for edge 1 alone: give this edge a tool of its own"),
                "or state its entry in the profile of the target's machine: `[[edge]]` with `tool`, `edge` and \
                 `length_entry`"
                    .into(),
            ]
        }
        Lack::Spindle(SpindleLack::Mist) => {
            own("`--m-code M07=M08` for flood coolant in its place, `--m-code M07=drop` for none")
        }
        Lack::Threads(ThreadsLack::BeforeReturn) => rigid_dwell(from),
        Lack::Compensation(
            still @ (CompensationLack::WithoutMotion | CompensationLack::TwoWithoutMotion),
        ) => unsupported::without_way(*still, from),
        _ if let Some(way) = unsupported::way_out(lack) => own(way),
        Lack::Feeds(FeedsLack::RotaryStartUnknown) => own(
            "move its axes to a place before, or state where they stand at the start, if no work offset is selected before: \
             `--start A0` for A at 0 degrees",
        ),
        Lack::Threads(ThreadsLack::PitchDigits) => {
            own("write the feed by the minute before the cycle: `G94`, and F = pitch × S")
        }
        Lack::Holes(HolesLack::ShiftDirection) => own(
            "state the parameter of the source's control: `--from-option bore_shift=+1` (`-1`, `+2`, `-2`: along the \
             first or second axis of the plane)",
        ),
        Lack::Lengths(LengthsLack::EntryWithTool { .. }) => {
            vec![
                "state in the profile of the source's machine that the entry is this tool's: `[[tool]]` with `number`, \
                 `name` and `length_entry`, and the same `name` in the target's; `ncc doctor` writes both"
                    .into(),
            ]
        }
        _ if let Some(option) = place_option(lack, from) => {
            vec![
                format!("if that point is the machine's zero: `--from-option {option}=zero`"),
                "else write the move in machine coordinates, with G53".into(),
            ]
        }
        Lack::Flow(FlowLack::ProgramBeginsAgain) => {
            own("write `M30` in its place: the program then runs once")
        }
        Lack::Flow(FlowLack::OptionalStop) => {
            own("`--m-code M1=drop` leaves it out: the program never stops there, as with the switch off")
        }
        Lack::Tools(ToolsLack::ChangeByHand) => {
            own("`--to-option tool_change=manual` writes a block that stops the program for it")
        }
        Lack::Flow(FlowLack::SkippedDecision) if from.option.iter().any(|row| row.name == BLOCK_SKIP) => {
            own("state how the block-skip switch stands: `--from-option block_skip=on` or `=off`")
        }
        Lack::Arcs(ArcsLack::ShortAfterRounding) => {
            own("leave this arc out where it is shorter than the target's least increment")
        }
        Lack::Holes(HolesLack::ToolChangeInCycle) => own("write `G80` before this block"),
        Lack::Tools(ToolsLack::ChangeKeepsLength) => {
            own("state the tool length offset between the tool change and this move: `G43` with its H number")
        }
        Lack::Tools(ToolsLack::SpindleTurnsAtChange) => {
            let mut all = own("stop the spindle before the change, or start it right behind");
            let option = Behaviour::SpindleAtChange.option();
            if from.option.iter().any(|row| row.name == option) {
                let own = format!("if the machine's change stops it: `--from-option {option}=stops`");
                all.push(own);
            }
            all
        }
        Lack::Frames(FramesLack::IncrementAfterChange) => {
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
        Lack::Machine(MachineLack::ZAfterToolChange) => {
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
fn place_option(lack: &Lack, from: &Dialect) -> Option<&'static str> {
    let option = match lack {
        Lack::Machine(MachineLack::StoredPosition) => STORED_POSITION,
        Lack::Machine(MachineLack::FurtherPoint) => FURTHER_POINT,
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
