//! Holes: cycles, and patterns of positions.

use crate::canon::{ReturnLevel, Spindle, Turn};
use crate::expr::Expr;
use crate::expr::num::Num;
use crate::program::Pitch;
use crate::program::cycle::{Approach, CycleKind, Shift, Tap};

/// What a target can say of holes: its cycles and patterns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HoleCaps {
    /// Cycles that it supports, by [`crate::program::cycle::CycleKind::name`], each with the return
    /// levels that it can ask for.
    pub cycles: Vec<CycleCap>,
    /// Circles of holes.
    pub circles: bool,
    /// Form of a circle's first hole.
    pub circle_start: CircleStart,
    /// Whether the circle's centre must be program zero and where the tool is.
    pub centre_at_zero_only: bool,
    /// Grids up to this many columns and rows; 0 is none.
    pub grid_upto: u32,
    /// The way through its grids.
    pub grid_way: GridWay,
    /// Grids only with rows that stand at +90 degrees to the columns, both pitches counted positive.
    pub grid_square: bool,
    /// Lines of holes.
    pub lines: bool,
    /// Lists of positions of at most so many holes; 0 is none.
    pub list_upto: u32,
    /// Patterns can begin at a stated position.
    pub pattern_start: bool,
    /// Patterns can begin where the tool is, and may have no holes and no pitch; where not, the
    /// pitches of lines count positive as well.
    pub pattern_here: bool,
    /// Rows and lines at any angle.
    pub pattern_angle: bool,
    /// Whether the control begins a line or a grid at the end, or corner, that is nearest to where the tool is:
    /// the order is that of the pattern only where the tool is at its first hole.
    pub order_by_position: bool,
    /// Whether hole positions may be incremental while a cycle is active.
    pub incremental: bool,
    /// How a cycle says to where it returns.
    pub returns: ReturnsTo,
    /// The planes of a cycle are measured as the distance mode of each hole's block has it.
    pub measured_anew: bool,
    /// The initial level of a hole is where the tool is before its block; else where it stood before the series.
    pub level_of_block: bool,
    /// After the end of a cycle no motion is active.
    pub end_motion: bool,
    /// Whether a subprogram cannot leave an active cycle to its caller.
    pub end_with_call: bool,
    /// Whether a boring cycle that stops the spindle is an error of the control unless the spindle turns.
    pub bore_needs_spindle: bool,
    /// What a cycle does first below its retract plane; `None` if that is the cycle's own word.
    pub approach: Option<Approach>,
}

/// Form of the first hole of a circle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CircleStart {
    /// Either.
    #[default]
    Either,
    /// By a radius and an angle.
    Polar,
    /// By its position.
    Cartesian,
}

sides!(CircleStart, Polar, Cartesian, polar);

/// The way through a grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GridWay {
    /// Either.
    #[default]
    Either,
    /// Every second row runs backwards.
    Serpentine,
    /// All rows run the same way.
    SameWay,
}

sides!(GridWay, Serpentine, SameWay, serpentine);

/// How a cycle says to where it returns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ReturnsTo {
    /// Either.
    #[default]
    Either,
    /// By a plane that it states.
    Plane,
    /// By a level: the initial or the retract plane.
    Level,
}

sides!(ReturnsTo, Plane, Level, plane);

/// A cycle that a target supports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CycleCap {
    /// Its kind.
    pub kind: String,
    /// Where it can leave the tool.
    pub returns: Vec<ReturnLevel>,
    /// Whether it can dwell at the bottom.
    pub dwell: bool,
    /// Whether it can say the clearance of a peck, or the lift that breaks a chip; else that is a
    /// parameter of the control.
    pub clearance: bool,
    /// Whether that can be left to a parameter of the control.
    pub parameter: bool,
    /// Whether each of its pecks goes out to where the tool is left, and down at feed.
    pub from_return: bool,
    /// Seconds that the control dwells by itself after each peck, at the bottom too.
    pub pause: Option<Num>,
    /// Whether it can say another first peck, and dwells between pecks.
    pub strokes: bool,
    /// Whether it can say pecks that decrease from the first one to a least one.
    pub shrinks: bool,
    /// Whether it can say another feed on the way out.
    pub feed_out: bool,
    /// Form of tapping and of the boring cycles that stop the spindle.
    pub form: CycleForm,
    /// Senses of the threads that it cuts.
    pub turns: Vec<Turn>,
    /// How the lift that breaks a chip goes.
    pub lift: Lift,
    /// Where a feed out ends.
    pub feeds_out_to: FeedsOutTo,
}

impl CycleCap {
    /// Whether it ends a cycle's feed out where the cycle does; `level` is where the tool is left.
    pub fn ends_feed(&self, kind: &CycleKind, level: Option<ReturnLevel>) -> bool {
        let feeds_out = matches!(kind, CycleKind::Bore { .. } | CycleKind::Tap(_));
        !feeds_out || level == Some(ReturnLevel::Retract) || self.feeds_out_to.says(kind.feeds_to_level())
    }
}

/// How the lift that breaks a chip goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lift {
    /// Either.
    #[default]
    Either,
    /// At feed.
    Feed,
    /// Rapid.
    Rapid,
}

sides!(Lift, Feed, Rapid, at_feed);

/// Where a feed out of a hole ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FeedsOutTo {
    /// Either.
    #[default]
    Either,
    /// Where the tool is left.
    Level,
    /// At the retract plane.
    Retract,
}

sides!(FeedsOutTo, Level, Retract, to_level);

/// Form of a cycle that drives the spindle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CycleForm {
    /// In any way.
    #[default]
    Any,
    /// By the spindle, feed and speed active and parameters of the control: the spindle turns as it
    /// does; a tap's pitch follows from feed and speed; a bore is left in the control's own direction at
    /// its own angle. After a rigid tap the spindle stands.
    Control(Own),
    /// By its words: sense, angle, shift and pitch; the dwell is at the bottom alone; after boring the
    /// spindle stands.
    Stated,
}

/// What a control's own cycles do of themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Own {
    /// The dwell of a tap is at the bottom alone, when the spindle has turned round; else at both ends,
    /// before it does.
    pub dwells_turned: bool,
    /// After boring the spindle turns as it did before; else clockwise.
    pub turns_on: bool,
}

impl Own {
    /// What the spindle does after boring.
    pub fn after(self) -> Option<Spindle> {
        (!self.turns_on).then_some(Spindle::Clockwise)
    }
}

impl CycleForm {
    /// Whether a cycle is said so, but for what [`CycleCap`] says of its kind; the pitch is another
    /// matter, since one follows from the other.
    pub fn says(self, kind: &CycleKind) -> bool {
        // Of no seconds it is none.
        let zero = |dwell: &Expr| dwell.literal().is_some_and(Num::is_zero);
        let none = |dwell: &Option<Expr>| dwell.as_ref().is_none_or(zero);
        let tap = |tap: &Tap| {
            let after = match (self, tap.chuck) {
                (CycleForm::Control(_), false) => tap.after == Spindle::Stopped,
                (CycleForm::Control(_), true) => tap.after == tap.turn.spindle(),
                (CycleForm::Stated | CycleForm::Any, _) => true,
            };
            let dwells = match self {
                CycleForm::Control(Own { dwells_turned: false, .. }) => {
                    tap.settle == tap.dwell && none(&tap.back)
                }
                CycleForm::Control(_) => none(&tap.dwell) && none(&tap.settle),
                CycleForm::Stated => none(&tap.settle) && none(&tap.back),
                CycleForm::Any => true,
            };
            let pitch = match self {
                CycleForm::Control(_) => tap.pitch == Pitch::Feed,
                CycleForm::Stated => tap.chuck || tap.pitch != Pitch::Feed,
                CycleForm::Any => true,
            };
            after && dwells && pitch
        };
        let turns = |turn: Option<Turn>, after: Option<Spindle>| match self {
            CycleForm::Any => true,
            CycleForm::Control(own) => turn.is_none() && after == own.after(),
            CycleForm::Stated => turn.is_some() && after == Some(Spindle::Stopped),
        };
        match kind {
            CycleKind::Tap(t) => tap(t),
            CycleKind::FineBore(bore) => {
                turns(bore.turn, bore.after)
                    && match self {
                        CycleForm::Any => true,
                        CycleForm::Control(_) => {
                            bore.angle.is_none() && matches!(bore.shift, Shift::Parameter(_))
                        }
                        CycleForm::Stated => bore.angle.is_some() && matches!(bore.shift, Shift::Stated(_)),
                    }
            }
            CycleKind::BoreStop(bore) => {
                turns(bore.turn, bore.after)
                    && (self == CycleForm::Any || bore.stop == (self == CycleForm::Stated))
            }
            CycleKind::Drill
            | CycleKind::DrillDwell { .. }
            | CycleKind::DrillPeck { .. }
            | CycleKind::DrillBreak { .. }
            | CycleKind::Bore { .. } => true,
        }
    }
}
