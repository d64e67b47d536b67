//! What statements may need and a target may lack, a bit each: what the legaliser asks before it looks closer.
//!
//! Not here: what is done about it.

use ncc_exec::Seen;
use ncc_ir::canon::ReturnLevel;
use ncc_ir::caps::{
    Caps, CircleStart, Corners, CycleForm, GridWay, LengthThere, LengthsOf, Lift, PolarForm, Radii,
    References, ReturnsTo, TiltForm, TipForm,
};
use ncc_ir::program::kinds::{conduct, miscellaneous, variables};
use ncc_ir::program::{FrameSlot, Op, Slot, Stmt};

// What a statement may need, and a target may lack.
pub(crate) const PATTERN: u32 = 1;
pub(crate) const CYCLE: u32 = 2;
pub(crate) const LENGTH: u32 = 4;
pub(crate) const WORK: u32 = 8;
pub(crate) const ARC: u32 = 16;
pub(crate) const CONTROL: u32 = 32;
pub(crate) const MESSAGE: u32 = 64;
pub(crate) const SKIP: u32 = 128;
pub(crate) const EVERY: u32 = 256;
pub(crate) const CALL: u32 = 512;
pub(crate) const SHIFT: u32 = 1024;
pub(crate) const EDGE: u32 = 2048;
pub(crate) const FRAME: u32 = 4096;
pub(crate) const MACHINE: u32 = 8192;
pub(crate) const TABLE: u32 = 16384;
pub(crate) const MEASURE: u32 = 32768;
pub(crate) const PATH: u32 = 1 << 16;
pub(crate) const MOVE: u32 = 1 << 17;
pub(crate) const POLAR: u32 = 1 << 18;
pub(crate) const RADIUS: u32 = 1 << 19;
pub(crate) const THREAD: u32 = 1 << 20;
pub(crate) const TOOL_AXIS: u32 = 1 << 24;
pub(crate) const CORNER: u32 = 1 << 25;
pub(crate) const AT_ONCE: u32 = 1 << 26;
pub(crate) const TURN: u32 = 1 << 29;
pub(crate) const ORIENT: u32 = 1 << 30;

/// What a target lacks.
pub(crate) fn lacks(caps: &Caps) -> u32 {
    let levels = [ReturnLevel::Initial, ReturnLevel::Retract];
    let kinds = ["drill", "drill-dwell", "drill-peck", "drill-break", "bore"];
    let says_all = |kind: &str| {
        let cap = caps.holes.cycles.iter().any(|c| {
            c.kind == kind
                && c.form == CycleForm::Any
                && c.dwell
                && c.clearance
                && c.strokes
                && c.feed_out
                && c.lift == Lift::Either
        });
        cap && levels.iter().all(|level| caps.cycle(kind, Some(*level), true))
    };
    let cycles = kinds.into_iter().all(says_all)
        && caps.holes.approach.is_none()
        && caps.holes.incremental
        && caps.holes.returns == ReturnsTo::Either
        && !caps.flat;
    let patterns = caps.holes.circles
        && caps.holes.grid_upto == u32::MAX
        && caps.holes.grid_way == GridWay::Either
        && caps.holes.lines
        && caps.holes.list_upto == u32::MAX
        && caps.holes.circle_start == CircleStart::Either
        && caps.holes.pattern_start
        && caps.holes.pattern_angle
        && !caps.holes.centre_at_zero_only
        && !caps.flat;
    let mut lacks = 0;
    let mut needs = |what: u32, has: bool| {
        if !has {
            lacks |= what;
        }
    };
    needs(PATTERN, patterns);
    needs(CYCLE, cycles);
    needs(LENGTH, !caps.tools.offset_with_z);
    needs(MOVE, caps.moves.one_move_apart);
    needs(WORK, caps.frames.work_offsets == u16::MAX);
    needs(SHIFT, caps.frames.clears_shift);
    needs(ARC, caps.arcs.helix && caps.arcs.turns && caps.arcs.forms);
    needs(CONTROL, caps.flow.repeats && caps.flow.repeat_blocks);
    needs(MESSAGE, caps.modes.messages);
    needs(SKIP, caps.flow.skip_levels >= 10);
    needs(EVERY, !caps.flat);
    needs(CALL, caps.flow.calls);
    needs(EDGE, caps.tools.lengths_of != LengthsOf::Entries);
    needs(TABLE, caps.tools.lengths_of != LengthsOf::Edges && !caps.tools.change_by_hand);
    needs(RADIUS, caps.compensation.radii == Radii::ALL);
    needs(TOOL_AXIS, caps.tools.tip == TipForm::Any && caps.frames.tilt == TiltForm::Any);
    needs(FRAME, caps.says_all_frames());
    let data = caps.frames.offset_data == [true; 3] && caps.tools.data == [true; 6] && caps.tools.data_added;
    let data = data
        && caps.frames.offset_turns
        && caps.machine.stored_positions == [true; 2]
        && caps.tools.number
        && caps.tools.data_kept
        && caps.tools.measured == [true; 2]
        && caps.tools.stated_lengths == [true; 2];
    let points = caps.machine.references == References::ALL
        && caps.machine.reference_via
        && caps.machine.reference_length == LengthThere::Either;
    needs(
        MACHINE,
        caps.moves.probes == [true; 4]
            && caps.moves.detours == [true; 2]
            && caps.machine.coordinates
            && caps.machine.length == LengthThere::Either
            && data
            && points,
    );
    needs(THREAD, caps.moves.threads.any);
    needs(POLAR, caps.moves.polar == PolarForm::Any);
    needs(TURN, caps.moves.rotary_ways);
    needs(ORIENT, caps.moves.own_stop);
    needs(CORNER, caps.moves.corners == Corners::ALL);
    needs(AT_ONCE, !caps.tools.length_at_once && !caps.tools.starts_without_length && !caps.holes.end_motion);
    needs(
        PATH,
        caps.moves.exact_stop
            && caps.modes.path_in_rapids
            && caps.modes.path_merges
            && Seen::by(caps) == Seen::default(),
    );
    lacks
}

/// What a statement may need.
#[inline]
pub(crate) fn interest(stmt: &Stmt) -> u32 {
    let skip = if stmt.skip.is_some() { SKIP } else { 0 };
    skip | interest_of(&stmt.op)
}

fn interest_of(op: &Op) -> u32 {
    match op {
        Op::StraightTraverse(_) | Op::StraightFeed(_) | Op::SetFeedRate(_) => 0,
        Op::ArcFeed(_) | Op::ArcForm(_) => ARC,
        Op::SynchronisedFeed(_) => THREAD,
        Op::StartCycle(_) | Op::Hole(_) | Op::Position(_) => CYCLE,
        Op::EndCycle => CYCLE | AT_ONCE,
        miscellaneous!() if matches!(op, Op::OrientSpindle(_)) => ORIENT,
        Op::SetPole(_) => POLAR,
        Op::Polar(polar) => POLAR | interest_of(&polar.op),
        Op::Pattern(_) => PATTERN | CYCLE,
        Op::UseToolLengthOffset(_) => LENGTH | TABLE | AT_ONCE,
        Op::UseToolEdge { .. } => LENGTH | EDGE | AT_ONCE,
        Op::ChangeTool => TABLE,
        Op::UseMachineCoordinates { .. } | Op::Probe(_) | Op::Detour(_) => MACHINE,
        Op::GoToReference(_) | Op::SetData(_) => MACHINE,
        Op::UseToolLength(_) => MACHINE | LENGTH | TABLE | AT_ONCE,
        Op::SetOriginOffsets(_) => WORK,
        Op::ClearFrame(FrameSlot::Shift) | Op::UseOriginShift(_) => SHIFT | FRAME,
        Op::UseToolCentrePoint(_) | Op::OrientToolAxis(_) | Op::ClearFrame(FrameSlot::Tilt) => TOOL_AXIS,
        Op::SetSlot(slot) if matches!(**slot, Slot::Tilt(_)) => TOOL_AXIS,
        Op::ClearFrame(_) | Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_) => FRAME,
        Op::Control(_) | Op::Goto(_) | Op::Label(_) | Op::Leave | Op::NextTurn | Op::RepeatBlocks(_) => {
            CONTROL
        }
        Op::Call(_) | Op::Return => CALL,
        miscellaneous!()
            if matches!(op, Op::Message(_) | Op::MessageOf(_) | Op::Output(_) | Op::Alarm(_)) =>
        {
            MESSAGE
        }
        conduct!() if matches!(op, Op::Corner { .. }) => CORNER | MOVE,
        conduct!() if matches!(op, Op::TurnRotaryAxes(_)) => TURN,
        conduct!() => PATH | MOVE,
        Op::SetFeedMode(_) => MOVE,
        miscellaneous!() if matches!(op, Op::StartCutterRadiusCompensation { .. }) => RADIUS,
        Op::SelectTool(_)
        | Op::SelectToolByName(_)
        | Op::ProgramEnd
        | Op::BeginAgain
        | variables!()
        | Op::UseLengthUnits(_)
        | Op::SetDistanceMode(_)
        | Op::SelectPlane(_)
        | Op::SetReturnLevel(_)
        | miscellaneous!() => 0,
    }
}
