//! What the stream has stated so far: units, plane, feed mode, tool, and where the axes are.

use ncc_ir::canon::{AXES, Axis, FeedMode, Plane, Units};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::{Coord, Move, Op, Point};
use ncc_ir::unsupported::TableUnsupported;

/// The selected tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Selected {
    None,
    Tool(i64),
    /// Its selection may have been skipped.
    Unsure,
}

/// By which form of `SET_ORIGIN_OFFSETS` the text has said the origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    None,
    /// A work offset by its number.
    Number,
    /// Machine coordinates.
    Values,
}

/// What the text has stated so far.
#[derive(Debug)]
pub(super) struct CanonState {
    pub(super) units: Option<Units>,
    /// Whether lengths are written in centimetres; `units` is then the millimetre.
    pub(super) centimetres: bool,
    pub(super) origin: Origin,
    pub(super) plane: Option<Plane>,
    pub(super) feed_mode: Option<FeedMode>,
    pub(super) selected: Selected,
    /// Where the axes stand, as far as their words say.
    pub(super) positions: [Option<Num>; AXES],
}

impl CanonState {
    /// The unit of lengths.
    #[inline]
    pub(super) fn length(&self) -> Unit {
        match self.units {
            Some(Units::Mm) => Unit::Mm,
            Some(Units::Inch) => Unit::Inch,
            None => Unit::Entry,
        }
    }

    pub(super) fn select(&mut self, tool: i64, skipped: bool) {
        self.selected = if skipped { Selected::Unsure } else { Selected::Tool(tool) };
    }

    /// Takes note of the origin of a statement. Values go into the first work offset, so a number may mean another one
    /// after them than before; and a move before them would start from what the last run left in the table.
    pub(super) fn set_origin(&mut self, op: &Op, moved: bool) -> Result<(), Fault> {
        let (form, refused) = match (op, self.origin) {
            (Op::SetOriginOffsets(_), Origin::Values) | (Op::SetData(_), Origin::Number) => {
                (self.origin, Some(TableUnsupported::OriginByBoth))
            }
            (Op::SetData(_), Origin::None) if moved => (self.origin, Some(TableUnsupported::OriginAfterMove)),
            (Op::SetOriginOffsets(_), _) => (Origin::Number, None),
            (Op::SetData(_), _) => (Origin::Values, None),
            _ => (self.origin, None),
        };
        self.origin = form;
        let fault = |what: TableUnsupported| Fault::NotSupported {
            code: "SET_ORIGIN_OFFSETS".into(),
            what: what.into(),
        };
        refused.map_or(Ok(()), |what| Err(fault(what)))
    }

    pub(super) fn check_tool(&self, tool: i64) -> Result<(), Fault> {
        match self.selected {
            Selected::None => Err(Fault::NoToolSelected),
            Selected::Tool(selected) if selected != tool => Err(Fault::CodesExclude {
                first: format!("SELECT_TOOL({selected})").into(),
                second: format!("CHANGE_TOOL({tool})").into(),
            }),
            Selected::Tool(_) | Selected::Unsure => Ok(()),
        }
    }

    /// Whether an axis is known to stand where a word sends it.
    pub(super) fn is_at(&self, axis: Axis, to: Option<&Coord>) -> bool {
        let to = to.and_then(|coord| coord.value.literal());
        let same = |a: Num, b: Num| {
            (a.trimmed().mantissa, a.trimmed().scale) == (b.trimmed().mantissa, b.trimmed().scale)
        };
        to.zip(self.positions[axis as usize]).is_some_and(|(a, b)| a.unit == b.unit && same(a, b))
    }

    /// Takes note of what a statement leaves active.
    pub(super) fn after(&mut self, op: &Op, skipped: bool) {
        fn set<T: PartialEq>(fact: &mut Option<T>, value: T, skipped: bool) {
            let value = Some(value);
            *fact = if skipped && *fact != value { None } else { value };
        }
        match op {
            Op::StraightTraverse(Move { to, .. }) | Op::StraightFeed(Move { to, .. }) => self.go(to, skipped),
            Op::ArcFeed(arc) => self.go(&arc.to, skipped),
            Op::UseLengthUnits(units) => {
                set(&mut self.units, *units, skipped);
                self.positions = [None; AXES];
            }
            Op::SetFeedMode(mode) => set(&mut self.feed_mode, *mode, skipped),
            Op::SelectPlane(plane) => set(&mut self.plane, *plane, skipped),
            Op::SetOriginOffsets(_)
            | Op::ClearFrame(_)
            | Op::SetFrame(_)
            | Op::SetSlot(_)
            | Op::SetPosition(_)
            | Op::UseOriginShift(_)
            | Op::UseMachineCoordinates { .. }
            | Op::Probe(_)
            | Op::Detour(_)
            | Op::GoToReference(_)
            | Op::SetData(_)
            | Op::UseToolLength(_)
            | Op::UseToolEdge { .. }
            | Op::ArcForm(_)
            | Op::SynchronisedFeed(_)
            | Op::SetPole(_)
            | Op::Polar(_)
            | Op::UseToolLengthOffset(_) => {
                self.positions = [None; AXES];
            }
            Op::Comment(_)
            | Op::NoEffect(_)
            | Op::Blank
            | Op::Lines(_)
            | Op::SetDistanceMode(_)
            | Op::SetReturnLevel(_)
            | Op::StartCutterRadiusCompensation { .. }
            | Op::StopCutterRadiusCompensation
            | Op::UseToolCentrePoint(_)
            | Op::OrientToolAxis(_)
            | Op::SetFeedRate(_)
            | Op::SetSpindleSpeed(_)
            | Op::SelectTool(_)
            | Op::ChangeTool
            | Op::StartSpindleClockwise
            | Op::StartSpindleCounterclockwise
            | Op::StopSpindleTurning
            | Op::SetMotionControlMode(_)
            | Op::ExactStop
            | Op::TurnRotaryAxes(_)
            | Op::Corner { .. }
            | Op::Advise(_)
            | Op::SetSpindleMode(_)
            | Op::LimitSpindleSpeed(_)
            | Op::OrientSpindle(_)
            | Op::SelectToolByName(_)
            | Op::MachineFunction(_)
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::Dwell(_)
            | Op::Position(_)
            | Op::StartCycle(_)
            | Op::Hole(_)
            | Op::Pattern(_)
            | Op::EndCycle
            | Op::ProgramStop
            | Op::OptionalProgramStop
            | Op::ProgramEnd
            | Op::BeginAgain
            | Op::Message(_)
            | Op::MessageOf(_)
            | Op::Output(_)
            | Op::Alarm(_)
            | Op::Declare(_)
            | Op::Leave
            | Op::NextTurn
            | Op::Call(_)
            | Op::Return
            | Op::RepeatBlocks(_)
            | Op::Assign(..)
            | Op::Control(_)
            | Op::Goto(_)
            | Op::Label(_) => {}
        }
    }

    #[inline]
    pub(super) fn go(&mut self, to: &Point, skipped: bool) {
        for (position, word) in self.positions.iter_mut().zip(&to.axes) {
            if let Some(coord) = word {
                *position = coord.value.literal().filter(|_| !skipped);
            }
        }
    }
}
