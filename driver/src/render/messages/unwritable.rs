//! Help lines of NC0501: the help of the reason, and an option that solves the problem.
//!
//! Not here: the texts (`driver/messages/NC0501`).

use ncc_dialects::{
    BLOCK_SKIP, BLOCK_WITHOUT_WAY, Dialect, FURTHER_POINT, LEFT_OUT, LOOKED_OVER, MACHINE_LENGTH,
    STORED_POSITION, TAP_DWELL,
};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::lack::{CompensationLack, FlowLack, FramesLack, Lack, MachineLack, ThreadsLack, ToolsLack};

use super::context::Context;
use super::message::Help;

/// Help lines for a capability that the target lacks: `help-option` first, if a dialect has a fitting option, then
/// the help of the reason.
pub(super) fn helps(lack: &Lack, at: Context) -> Vec<Help> {
    let option = option(lack, at)
        .map(|(option, value)| Help::new("help-option").text("option", option).text("value", value));
    option.into_iter().chain([Help::new("help")]).collect()
}

/// Option, with its value, that states the fact ncc does not know; `None` if no option helps.
fn option(lack: &Lack, at: Context) -> Option<(String, &'static str)> {
    match lack {
        Lack::Machine(MachineLack::WithToolLength) => of(at.from, MACHINE_LENGTH, "suppressed"),
        Lack::Machine(MachineLack::StoredPosition) => of(at.from, STORED_POSITION, "zero"),
        Lack::Machine(MachineLack::FurtherPoint) => of(at.from, FURTHER_POINT, "zero"),
        Lack::Machine(MachineLack::ZAfterToolChange) => open(at.to, Behaviour::ZAtChange, 1),
        Lack::Frames(FramesLack::IncrementAfterChange) => open(at.to, Behaviour::FrameOffsetIncremental, 0),
        Lack::Threads(ThreadsLack::BeforeReturn) => of(at.from, TAP_DWELL, LEFT_OUT),
        Lack::Compensation(CompensationLack::WithoutMotion) => of(at.from, BLOCK_WITHOUT_WAY, LOOKED_OVER),
        Lack::Flow(FlowLack::SkippedDecision) => of(at.from, BLOCK_SKIP, "on"),
        Lack::Tools(ToolsLack::SpindleTurnsAtChange) => {
            of(at.from, Behaviour::SpindleAtChange.option(), "stops")
        }
        _ => None,
    }
}

/// An option with its value; `None` if the dialect lacks the option.
fn of(dialect: &Dialect, option: impl Into<String>, value: &'static str) -> Option<(String, &'static str)> {
    let option = option.into();
    dialect.option.iter().any(|row| row.name == option).then_some((option, value))
}

/// Option of a behaviour with its value at index `value`; `None` if the manuals of the dialect settle it.
fn open(dialect: &Dialect, behaviour: Behaviour, value: usize) -> Option<(String, &'static str)> {
    let open = dialect.behaviour_row(behaviour).is_some_and(|row| row.open);
    open.then_some((behaviour.option(), behaviour.values()[value]))
}
