//! Moves: rapid and straight, arcs, and compensation for the cutter's radius.

use crate::compensated::Refused;
use crate::geometry::arc_solver::ArcRule;

/// What a target can say of moves, but for arcs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MoveCaps {
    /// Probing moves, by [`Caps::probe`](super::Caps::probe).
    pub probes: [bool; 4],
    /// Rapid moves that do not go straight, by [`Detour`](crate::program::Detour).
    pub detours: [bool; 2],
    /// Direction in which a rotary axis turns.
    pub rotary_ways: bool,
    /// Lines by their angle and one coordinate.
    pub line_angles: bool,
    /// Form of polar points.
    pub polar: PolarForm,
    /// Rounded and chamfered corners.
    pub corners: Corners,
    /// An exact stop of one move.
    pub exact_stop: bool,
    /// What is stated for one move may stand before its block.
    pub one_move_apart: bool,
    /// Straight spindle-synchronised moves.
    pub threads: Threads,
    /// A stop of the spindle at the control's own angle.
    pub own_stop: bool,
}

/// What a target can say of arcs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArcCaps {
    /// Which arcs it accepts.
    pub rule: ArcRule,
    /// Arcs by angle, through a point, tangent, or with words of the centre from either zero.
    pub forms: bool,
    /// Arcs by radius.
    pub by_radius: bool,
    /// Arcs with a third axis.
    pub helix: bool,
    /// Arcs of more than one turn.
    pub turns: bool,
    /// Centres of arcs count from program zero alone.
    pub centres_from_zero: bool,
}

/// What a target can say of cutter radius compensation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CompensationCaps {
    /// How it names the radius of cutter radius compensation; none of them is without compensation.
    pub radii: Radii,
    /// Cutter radius compensation of the active side may be switched on again without having been switched off.
    pub again: bool,
    /// What it refuses while cutter radius compensation is on.
    pub refused: Refused,
}

/// Corners that a target supports.
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

/// Straight spindle-synchronised moves that a target supports.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Threads {
    /// As the spindle turns.
    pub plain: bool,
    /// As the spindle turns, and back to where it began.
    pub back: bool,
    /// With a spindle that the control turns itself; it must have been oriented before.
    pub turned: bool,
    /// With a compensating chuck, at feed and speed active.
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
