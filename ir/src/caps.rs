//! What a target can say. Passes see these capabilities, never a dialect's name.

use std::sync::Arc;

use crate::behaviour::Behaviours;
use crate::canon::{AdviceKind, PathMode, ReturnLevel, Spindle, Turn};
use crate::compensated::Refused;
use crate::computed::computes::Computes;
use crate::expr::Expr;
use crate::expr::num::Num;
use crate::geometry::round::ArcRule;
use crate::program::cycle::{CycleKind, Shift, Tap};
use crate::program::kinds::{
    conduct, drilling, flow, machine, miscellaneous, modes, moves, polar, tooling, variables,
};
use crate::program::{FrameSlot, Op, Pitch, Probe, ReferencePoint, Slot, ToolLength};

/// Capabilities of a target, filled from its dictionary.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Caps {
    /// Cycles that it has words for, by [`crate::program::cycle::CycleKind::name`], each with the return
    /// levels that it can ask for.
    pub cycles: Vec<CycleCap>,
    /// Patterns that it has words for.
    pub circle_pattern: bool,
    /// Grids up to this many columns and rows; 0 is none.
    pub grid_pattern: u32,
    /// Lines of holes.
    pub line_pattern: bool,
    /// Lists of positions of at most so many holes; 0 is none.
    pub list_pattern: u32,
    /// A circle's first hole is at a radius and an angle (`true`) or at a position; `None` if either.
    pub circle_polar: Option<bool>,
    /// Patterns can begin at a stated position.
    pub pattern_start: bool,
    /// Patterns can begin where the tool stands, and may have no holes and no pitch; where not, the
    /// pitches of lines count positive as well.
    pub pattern_here: bool,
    /// Rows and lines at any angle.
    pub pattern_angle: bool,
    /// The way through its grids: whether every second row runs backwards; `None` if either.
    pub grid_serpentine: Option<bool>,
    /// Grids only with rows that stand at +90 degrees to the columns, both pitches counted positive.
    pub grid_square: bool,
    /// Whether the control begins a line or a grid at the end, or corner, that is nearest to where
    /// the tool stands: the order is that of the pattern only where the tool stands at its first hole.
    pub order_by_position: bool,
    /// Whether the circle's centre must be program zero and where the tool stands.
    pub circle_centre_at_zero_only: bool,
    /// Whether hole positions may be incremental while a cycle is in force.
    pub incremental_cycles: bool,
    /// Subprograms.
    pub calls: bool,
    /// Repetition of blocks.
    pub repeats: bool,
    /// Number of work offsets that it can name; 0 if it has one, without a word for it.
    pub work_offsets: u16,
    /// A word for none of its settable work offsets: number 0.
    pub work_offsets_off: bool,
    /// A word that cancels a temporary shift of the origin.
    pub clears_shift: bool,
    /// A chain of frames: translation, rotation in the plane, scale, mirror.
    pub frames: bool,
    /// A local shift, axis by axis.
    pub local_shift: bool,
    /// A shift of the origin, by the coordinates that the present point gets.
    pub origin_shift: bool,
    /// Words that suspend a shift of the origin and take it up again.
    pub suspends_shift: bool,
    /// A shift of the origin, axis by axis.
    pub stated_shift: bool,
    /// A rotation in the plane about a point.
    pub rotation: bool,
    /// Factors about a point.
    pub scale: bool,
    /// Axes mirrored at a place.
    pub mirror: bool,
    /// Moves in machine coordinates.
    pub machine_coordinates: bool,
    /// Whether the tool's length stays in such a move (`true`) or is off too; `None` if either can be said.
    pub machine_length: Option<bool>,
    /// Whether a move in machine coordinates is always rapid.
    pub machine_rapid: bool,
    /// Probing moves, by [`Caps::probe`].
    pub probes: [bool; 4],
    /// Rapid moves that do not go straight, by [`Detour`](crate::program::Detour).
    pub detours: [bool; 2],
    /// Points of the machine that have a word.
    pub references: References,
    /// Whether a rapid move to such a point can go by another point first.
    pub reference_via: bool,
    /// Whether a tool's length is surely in force behind a move to such a point; `None` if either can be
    /// said.
    pub reference_keeps_length: Option<bool>,
    /// Values of work offsets: set; added to; so that the present position reads the words.
    pub offset_data: [bool; 3],
    /// Whether a work offset can be turned.
    pub offset_turns: bool,
    /// Stored positions that can be set to where the axes stand: 1, 2.
    pub stored_positions: [bool; 2],
    /// Whether a tool's length can be stated, and whether one can be added to that in force.
    pub stated_lengths: [bool; 2],
    /// Whether the number of the tool in the spindle can be set.
    pub tool_number: bool,
    /// Values of the table of tools, in the order of [`crate::program::ToolValue::ALL`].
    pub tool_data: [bool; 6],
    /// Whether a value can be added to one of that table.
    pub tool_data_added: bool,
    /// Whether such a value leaves what is in force of the tool as it is, until the entry is called up anew.
    pub tool_data_kept: bool,
    /// Whether tools are measured where the axes stand: in the coordinates in force; in those of a work offset.
    pub measures_tools: [bool; 2],
    /// Tools by name.
    pub tool_names: bool,
    /// How it names the radius of cutter radius compensation; none of them is without compensation.
    pub radii: Radii,
    /// How control of the tool's tip is said.
    pub tip: TipForm,
    /// How tilted working planes are said.
    pub tilt: TiltForm,
    /// Lengths are those of edges of the tool in the spindle (`true`) or entries of a table; `None`
    /// if either.
    pub tool_edges: Option<bool>,
    /// Where lengths are entries of a table, that of the tool in the spindle can be called up without its number.
    pub own_length: bool,
    /// Cycles state the plane to which they return (`true`) or return to a level; `None` if either.
    pub return_planes: Option<bool>,
    /// A word can say for itself whether it is absolute or incremental.
    pub word_distance: bool,
    /// A feed can be in another unit than the lengths.
    pub feed_apart: bool,
    /// A change of units leaves it open what a feed said before means.
    pub feed_again: bool,
    /// A feed by the time of a move.
    pub feed_by_time: bool,
    /// Digits after the point of F.
    pub feed_decimals: u8,
    /// A change of units within a program stands in a block of its own.
    pub units_alone: bool,
    /// A code of what the feed counts ends the feed even where it counts that already.
    pub feed_ends_with_mode: bool,
    /// Cutter radius compensation of the active side may be switched on again without having been switched off.
    pub compensation_again: bool,
    /// Subprograms are called by numbers of at most so many digits; 0 if by name.
    pub call_digits: u32,
    /// Arcs by angle, through a point, tangent, or with words of the centre from either zero.
    pub arc_forms: bool,
    /// Repetition of blocks between labels.
    pub repeat_blocks: bool,
    /// It names both ends by their block numbers, and none stands within another.
    pub repeat_by_numbers: bool,
    /// Whether such a count includes the first pass is known of the machine.
    pub repeat_count_known: bool,
    /// Centres of arcs are said from program zero alone.
    pub centres_from_zero: bool,
    /// A length offset must stand in a block with a Z word.
    pub offset_with_z: bool,
    /// A length offset counts as soon as it is read: the tool stands at another Z.
    pub length_at_once: bool,
    /// A program begins with words for no length.
    pub starts_without_length: bool,
    /// Behind the end of a cycle no motion is in force.
    pub cycle_ends_motion: bool,
    /// Whether a subprogram cannot leave a cycle in force to its caller.
    pub cycle_ends_with_call: bool,
    /// A tool change leaves the spindle stopped.
    pub change_stops_spindle: bool,
    /// What codes of the control do besides their names.
    pub behaviours: Behaviours,
    /// The planes of a cycle are measured as the distance mode of each hole's block has it.
    pub cycles_measured_anew: bool,
    /// The initial level of a hole is where the tool stands before its block; else where it stood before the series.
    pub level_of_block: bool,
    /// Which arcs it accepts.
    pub arcs: ArcRule,
    /// What it refuses while cutter radius compensation is on.
    pub refused_compensated: Refused,
    /// Arcs by radius.
    pub arc_radius: bool,
    /// Arcs with a third axis.
    pub helix: bool,
    /// Arcs of more than one turn.
    pub arc_turns: bool,
    /// Highest block-skip level; 0 if there is no block skip.
    pub skip_levels: u8,
    /// What is said for one move may stand before its block.
    pub one_move_apart: bool,
    /// Incremental coordinates.
    pub incremental: bool,
    /// Both units of length.
    pub inch: bool,
    /// The target is a list of events: every structure is expanded, every axis named, absolute.
    pub flat: bool,
    /// Positions that a subprogram's caller gives the meaning to.
    pub inherits_motion: bool,
    /// Straight moves in step with the spindle.
    pub threads: Threads,
    /// How points by radius and angle are said.
    pub polar: PolarForm,
    /// A stop of the spindle at the control's own angle.
    pub own_stop: bool,
    /// Which way round a rotary axis goes.
    pub rotary_ways: bool,
    /// Lines by their angle and one coordinate.
    pub line_angles: bool,
    /// Rounded and chamfered corners.
    pub corners: Corners,
    /// Messages to the operator.
    pub messages: bool,
    /// Those that stand right before a program stop in its block.
    pub stop_messages: bool,
    /// Modes of taking corners, a bit each.
    pub path_modes: u16,
    /// Whether plain rounding goes as far from the path as the acceleration asks for.
    pub rounds_freely: bool,
    /// Whether the length of rounding can be another one in rapids.
    pub path_in_rapids: bool,
    /// Whether moves that the control makes one have a length of their own.
    pub path_merges: bool,
    /// Whether no other zero may be set while a rotation, factors or a mirror are in force.
    pub frames_shut: bool,
    /// How it always takes corners, where it has no word for that.
    pub only_path: Option<PathMode>,
    /// A tool is changed by hand, and the operator sets the zero of Z by it: no length of a tool is known.
    pub change_by_hand: bool,
    /// An exact stop of one move.
    pub exact_stop: bool,
    /// Advice that it has words for, each with its value.
    pub advice: Vec<(AdviceKind, u8)>,
    /// What it computes with when the program runs; `None` is nothing.
    pub computes: Option<Arc<Computes>>,
    /// What a cycle does first below its retract plane; `None` if that is the cycle's own word.
    pub approach: Option<crate::program::cycle::Approach>,
}

/// How a target says that points are those of the tool's tip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TipForm {
    /// Not at all.
    #[default]
    None,
    /// By the word that takes the length up; the word that ends the length ends it.
    WithLength,
    /// By words of its own; the length stays what it is.
    Apart,
    /// As the text form does.
    Any,
}

/// How a target says a tilted working plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TiltForm {
    /// Not at all.
    #[default]
    None,
    /// By turns about Z, the new X, and the new Z; the tool is turned by a word of its own.
    Euler,
    /// By turns about three different axes, each about the new one, in any order; the tool is turned by
    /// the same word, towards a side that it names.
    AxisByAxis,
    /// As the text form does.
    Any,
}

/// Corners that a target has words for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Corners {
    /// Rounded, by their radius.
    pub round: bool,
    /// Chamfered, by how far the chamfer begins before the corner.
    pub leg: bool,
    /// Chamfered, by the length of the chamfer.
    pub length: bool,
    /// Beside arcs too.
    pub arcs: bool,
}

impl Corners {
    /// All there are.
    pub const ALL: Corners = Corners { round: true, leg: true, length: true, arcs: true };
}

/// Straight moves in step with the spindle that a target has words for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Threads {
    /// As the spindle turns.
    pub plain: bool,
    /// As the spindle turns, and back to where it began.
    pub back: bool,
    /// With a spindle that the control turns itself; it must have been stopped at an angle before.
    pub turned: bool,
    /// With a compensating chuck, at feed and speed in force.
    pub chuck: bool,
    /// The feed word says the pitch, and no feed is known after it.
    pub by_feed: bool,
    /// Whatever there is.
    pub any: bool,
}

/// How a target says points by radius and angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PolarForm {
    /// Not at all.
    #[default]
    None,
    /// In a mode of its own, about program zero, with one way of measuring for all words of a block. A word
    /// that is missing or added counts from the polar point before, if nothing has moved since. Arcs by
    /// radius.
    Modal,
    /// About a pole that a block of its own sets. Arcs about the pole. A radius is no increment.
    Pole,
    /// In any way.
    Any,
}

/// Points of the machine that a target has words for, each up to which number; 0 is none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)] // As [`crate::program::ReferencePoint`].
pub struct References {
    pub home: bool,
    pub further: u8,
    pub fixed: u8,
    pub stored: u8,
}

impl References {
    /// All there are.
    pub const ALL: References = References { home: true, further: 4, fixed: 4, stored: 2 };

    /// Whether a point has a word.
    pub fn has(&self, point: ReferencePoint) -> bool {
        match point {
            ReferencePoint::Home => self.home,
            ReferencePoint::Further(n) => n <= self.further,
            ReferencePoint::Fixed(n) => n <= self.fixed,
            ReferencePoint::Stored(n) => n <= self.stored,
        }
    }
}

/// Ways of naming the radius of cutter radius compensation, as of [`crate::program::CutterRadius`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)] // As there.
pub struct Radii {
    pub entry: bool,
    pub tool: bool,
    pub in_force: bool,
    pub diameter: bool,
}

impl Radii {
    /// All there are.
    pub const ALL: Radii = Radii { entry: true, tool: true, in_force: true, diameter: true };
}

/// How a cycle that drives the spindle is said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CycleForm {
    /// In any way.
    #[default]
    Any,
    /// By the spindle, feed and speed in force and parameters of the control: the spindle turns as it
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

/// A cycle that a target has words for.
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
    /// How tapping and the boring cycles that stop the spindle are said.
    pub form: CycleForm,
    /// Senses of the threads that it cuts.
    pub turns: Vec<Turn>,
    /// Whether the lift that breaks a chip is at feed (`true`) or rapid; `None` if either.
    pub lift_at_feed: Option<bool>,
    /// Whether a feed out goes on to where the tool is left (`true`) or ends at the retract plane; `None`
    /// if either.
    pub to_level: Option<bool>,
}

impl CycleCap {
    /// Whether it ends a cycle's feed out where the cycle does; `level` is where the tool is left.
    pub fn ends_feed(&self, kind: &CycleKind, level: Option<ReturnLevel>) -> bool {
        let feeds_out = matches!(kind, CycleKind::Bore { .. } | CycleKind::Tap(_));
        !feeds_out
            || level == Some(ReturnLevel::Retract)
            || self.to_level.is_none_or(|to_level| to_level == kind.feeds_to_level())
    }
}

impl Caps {
    /// Place of a kind of probing move in [`Caps::probes`].
    pub fn probe(probe: Probe) -> usize {
        usize::from(probe.away) * 2 + usize::from(probe.error)
    }

    /// Whether a mode of taking corners can be written.
    pub fn says_path(&self, mode: PathMode) -> bool {
        self.path_modes >> mode as u16 & 1 == 1
    }

    /// Whether advice can be written.
    pub fn advises(&self, kind: AdviceKind, value: u8) -> bool {
        self.advice.contains(&(kind, value))
    }

    /// Whether it shows what a program stop says.
    pub fn shows_at_stops(&self) -> bool {
        self.messages || self.stop_messages
    }

    /// Whether a length that stands in no table can be written.
    pub fn says_length(&self, length: &ToolLength) -> bool {
        let [stated, added] = self.stated_lengths;
        match length {
            ToolLength::Value(_) => stated,
            ToolLength::Added(_) | ToolLength::AddedEntry(_) => added,
            // Who has them in the table can state them.
            ToolLength::Offsets { added: adds, .. } => {
                let [.., x, y] = self.tool_data;
                x && y && if *adds { added } else { stated }
            }
        }
    }

    /// Whether a statement that changes a frame can be written as it is. Anything else can.
    pub fn says_frame(&self, op: &Op) -> bool {
        match op {
            Op::SetFrame(_) | Op::ClearFrame(FrameSlot::Chain) => self.frames,
            Op::SetPosition(_) => self.origin_shift,
            Op::UseOriginShift(_) => self.suspends_shift,
            Op::SetSlot(slot) => match **slot {
                Slot::Shift { origin: true, .. } => self.stated_shift,
                Slot::Shift { origin: false, .. } => self.local_shift,
                Slot::Rotation { .. } => self.rotation,
                Slot::Scale { .. } => self.scale,
                Slot::Mirror(_) | Slot::NoMirror(_) => self.mirror,
                Slot::Tilt(_) => self.tilt != TiltForm::None,
            },
            Op::ClearFrame(FrameSlot::Shift) => self.clears_shift,
            Op::ClearFrame(FrameSlot::Local) => self.local_shift,
            Op::ClearFrame(FrameSlot::Rotation) => self.rotation,
            Op::ClearFrame(FrameSlot::Scale) => self.scale,
            Op::ClearFrame(FrameSlot::Mirror) => self.mirror,
            Op::ClearFrame(FrameSlot::Tilt) => self.tilt != TiltForm::None,
            Op::ClearFrame(FrameSlot::Polar)
            | Op::SetOriginOffsets(_)
            | Op::UseToolCentrePoint(_)
            | Op::UseMachineCoordinates { .. }
            | Op::SetFeedRate(_)
            | Op::Position(_)
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | machine!()
            | miscellaneous!()
            | conduct!()
            | modes!()
            | tooling!()
            | moves!()
            | drilling!()
            | polar!()
            | flow!()
            | Op::Probe(_)
            | Op::Detour(_) => true,
        }
    }

    /// Whether every frame can be written as it is.
    pub fn says_all_frames(&self) -> bool {
        self.frames
            && self.local_shift
            && self.origin_shift
            && self.stated_shift
            && self.suspends_shift
            && self.rotation
            && self.scale
            && self.mirror
    }

    /// Whether a cycle of this kind can be written, returning there.
    pub fn cycle(&self, kind: &str, level: Option<ReturnLevel>, dwell: bool) -> bool {
        self.cycles
            .iter()
            .any(|c| c.kind == kind && (c.dwell || !dwell) && level.is_none_or(|l| c.returns.contains(&l)))
    }
}
