//! Events of the canonical stream.

use super::{Compensation, TiltedPlane};
use ncc_ir::canon::{AXES, AdviceKind, FeedMode, PathMode, Plane, Spindle, SpindleMode, Turn};
use ncc_ir::caps::Caps;
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry::arc_feed;
use ncc_ir::program::{Probe, Text, ToolValue, Toward};
use ncc_ir::source::Span;

/// One thing that the machine does.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// What it is.
    pub kind: Kind,
    /// Where the axes stand after it, machine coordinates in nanos.
    pub end: [Nanos; AXES],
    /// Feed of a cutting move in nanos of its mode's unit (mm/min, mm a turn, 1/min); 0 of others. Of a
    /// synchronised move it follows from pitch and speed, and is not compared.
    pub rate: Nanos,
    /// What is on.
    pub state: State,
    /// Whether the program was in inches; decides its resolution, not compared.
    pub inch: bool,
    /// Where it comes from.
    pub span: Span,
}

/// Kinds of events.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// Rapid, straight.
    Traverse,
    /// Straight at feed.
    Feed,
    /// Straight, synchronised with the spindle.
    Synchronised {
        /// How far it goes in one turn, nanos of a millimetre.
        pitch: Nanos,
        /// Whether a compensating chuck makes good what feed and spindle are apart.
        chuck: bool,
    },
    /// Straight at feed, until the probe triggers; the event ends where that is.
    Probe {
        /// How far it goes at most, machine coordinates.
        to: Box<[Nanos; AXES]>,
        /// What it looks for.
        probe: Probe,
    },
    /// Arc or helix at feed.
    Arc {
        /// Its plane.
        plane: Plane,
        /// Its sense, seen from the positive end of the plane's normal.
        turn: Turn,
        /// Whether start and end are one point of the plane: a whole circle.
        full: bool,
        /// Its centre in the plane, machine coordinates.
        centre: [Nanos; 2],
    },
    /// Dwell, seconds in nanos.
    Dwell(Nanos),
    /// The selected tool is put in.
    ToolChange,
    /// Oriented spindle stop, degrees in nanos.
    Orient(Nanos),
    /// Another working plane counts, or none (`None`).
    Tilt(Option<Box<TiltedPlane>>),
    /// Rotary axes turn the tool upright on it.
    OrientToolAxis(Option<Toward>),
    /// Coolant was switched.
    Coolant,
    /// Something of the machine was switched that no dialect supports.
    MachineFunction(Text),
    /// A value was put into the control's tables.
    Data(Box<Stored>),
    /// Stop.
    ProgramStop,
    /// Stop, if the operator wants it.
    OptionalProgramStop,
    /// End.
    ProgramEnd,
    /// The program begins again, and goes on so for ever: execution ends here.
    BeginAgain,
    /// The text is over, and never said so: what is still on stays on.
    TextEnd,
    /// Text for the operator.
    Message(Text),
    /// Something was written to a device.
    Output(Written),
    /// The program ends with an alarm for the operator: its number, if it has one, in nanos, and its text.
    Alarm(Option<Nanos>, Text),
    /// What sets something and moves nothing. Made only where functions are reported one by one
    /// ([`Exec::narrate`](super::Exec::narrate)), and never compared: what it sets is an attribute of
    /// the events after it.
    Attribute(Attribute),
}

/// Values in the control's tables, after a program has changed them. Numbers are those of the source.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Stored {
    /// Zero of a work offset, machine coordinates in nanos, and its turn about Z, degrees in nanos.
    Offset(u32, [Nanos; AXES], Nanos),
    /// A position stored in the control, machine coordinates in nanos.
    Position(u8, [Nanos; AXES]),
    /// The number of the tool in the spindle.
    Tool(u32),
    /// Length of an entry of the table of tools, wear included.
    Length(u32, Nanos),
    /// Another value of an entry of that table: which, whether it was added, and what was stated.
    Value(u32, ToolValue, bool, Nanos),
}

/// What was written to the device that the control has for it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Written {
    /// It was made ready.
    Opened,
    /// A line.
    Line(Text),
    /// Nothing more is.
    Closed,
}

/// A move of the axes, by its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Movement {
    /// Rapid, straight.
    Rapid,
    /// Straight at feed.
    Feed,
    /// Arc or helix at feed; its fields are those of [`Kind::Arc`].
    Arc {
        /// Its plane.
        plane: Plane,
        /// Its sense.
        turn: Turn,
        /// Whether it is a whole circle.
        full: bool,
        /// Its centre in the plane.
        centre: [Nanos; 2],
    },
}

impl Kind {
    /// How the axes move, if it is a move. Here alone it is said which kinds are none.
    #[inline]
    pub fn moves(&self) -> Option<Movement> {
        match self {
            Kind::Traverse => Some(Movement::Rapid),
            Kind::Feed | Kind::Synchronised { .. } | Kind::Probe { .. } => Some(Movement::Feed),
            Kind::Arc { plane, turn, full, centre } => {
                Some(Movement::Arc { plane: *plane, turn: *turn, full: *full, centre: *centre })
            }
            Kind::Dwell(_)
            | Kind::ToolChange
            | Kind::Orient(_)
            | Kind::Tilt(_)
            | Kind::OrientToolAxis(_)
            | Kind::Coolant
            | Kind::MachineFunction(_)
            | Kind::Data(_)
            | Kind::ProgramStop
            | Kind::OptionalProgramStop
            | Kind::ProgramEnd
            | Kind::BeginAgain
            | Kind::TextEnd
            | Kind::Message(_)
            | Kind::Output(_)
            | Kind::Alarm(..)
            | Kind::Attribute(_) => None,
        }
    }
}

/// Functions that set an attribute of later events; `SELECT_PLANE` and others that say in which
/// terms the program speaks are not among them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attribute {
    /// The tool that the next change puts in.
    SelectTool(i64),
    /// Speed of the spindle, rev/min in nanos.
    SpindleSpeed(Nanos),
    /// The spindle starts.
    StartSpindle(Spindle),
    /// The spindle stops.
    StopSpindle,
    /// Feed, mm/min in nanos.
    FeedRate(Nanos),
    /// A hole begins, at the retract plane over it. No function of its own: a mark for tables.
    Hole,
    /// A comment that stands in a block of its own. No function either; its text is the statement's.
    Remark,
}

/// Bits of [`State::by_control`]: what a control does besides the name of a code, as long as the program
/// has no word of its own for it. A comparison passes over what only the target's control does so, where
/// nothing is cut.
pub mod by_control {
    /// The spindle was stopped.
    pub const SPINDLE: u8 = 1;
    /// Coolant was switched off.
    pub const COOLANT: u8 = 2;
    /// Z went to machine zero.
    pub const Z: u8 = 4;
    /// The event itself is a move of the control, before a tool change.
    pub const MOVE: u8 = 8;
    /// Z stands where the operator left it: the program has not moved it yet.
    pub const Z_AT_START: u8 = 16;
    /// The event's feed is a time, because its control counts F in a way of its own there.
    pub const TIMED: u8 = 32;
    /// Z has moved since the control took it to machine zero, by words that count from there: incremental ones, or those of
    /// a cycle. A comparison passes over nothing for it.
    pub const Z_COUNTED: u8 = 64;
    /// The spindle was stopped at the last tool change, and every move may need it. Nothing is passed over either.
    pub const SPINDLE_AT_CHANGE: u8 = 128;
}

/// Which coolants are on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Coolant {
    /// Flood coolant.
    pub flood: bool,
    /// Mist coolant.
    pub mist: bool,
}

impl State {
    /// The coolants that are on.
    pub fn coolant(&self) -> Coolant {
        Coolant { flood: self.flood, mist: self.mist }
    }
}

/// What is on while an event happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct State {
    /// Tool in the spindle; -1 is the one that was there at the start, less than that one with a name.
    pub tool: i64,
    /// Spindle speed in the unit of its mode (rev/min, m/min), nanos; counts only while the spindle
    /// turns.
    pub speed: Nanos,
    /// Advice active, three bits a kind: its value and one, or 0 where none was given.
    pub advice: u64,
    /// Highest spindle speed in thousandths of a turn a minute; counts only while the spindle turns.
    pub limit: u32,
    /// Under a surface speed, where the machine's X is from which the radius is measured; counts only while
    /// the spindle turns.
    pub centre: Nanos,
    /// Lengths that belong to the path mode, to it in rapids, to advice, to moves that are made one, and to smoothness:
    /// tenths of a micrometre.
    pub within: [i32; 5],
    /// Cutter radius compensation.
    pub compensation: Compensation,
    /// Sense of the spindle.
    pub spindle: Spindle,
    /// What the speed counts.
    pub spindle_mode: SpindleMode,
    /// What the feed counts; compared with it.
    pub feed_mode: FeedMode,
    /// How corners are taken; `None` is as at the start.
    pub path: Option<PathMode>,
    /// Whether points are those of the tool tip.
    pub tip: bool,
    /// Whether points are those of a tilted plane: the one of the last [`Kind::Tilt`].
    pub tilted: bool,
    /// Which of A, B and C turn the other way round than their angles say, two bits each: 1 towards greater
    /// ones, 2 towards smaller ones.
    pub turned: u8,
    /// Which axes reach the end of this move from one side, always the same; a bit each, X first.
    pub one_side: u8,
    /// What the control itself has switched or moved, and no word of the program since: [`by_control`].
    pub by_control: u8,
    /// Flood coolant.
    pub flood: bool,
    /// Mist coolant.
    pub mist: bool,
}

impl Default for State {
    fn default() -> State {
        State {
            tool: -1,
            speed: 0,
            advice: 0,
            limit: u32::MAX,
            centre: 0,
            within: [0; 5],
            compensation: Compensation::default(),
            spindle: Spindle::Stopped,
            spindle_mode: SpindleMode::Turns,
            feed_mode: FeedMode::PerMinute,
            path: None,
            turned: 0,
            one_side: 0,
            by_control: 0,
            tip: false,
            tilted: false,
            flood: false,
            mist: false,
        }
    }
}

impl State {
    /// Turns a minute with X at this place of the machine, in nanos: of a surface speed those by the radius
    /// there, up to the limit. In the middle, without a limit, they are not known: 0.
    pub fn turns(&self, x: Nanos) -> Nanos {
        if self.spindle_mode == SpindleMode::Turns {
            return self.speed;
        }
        let limit = Nanos::from(self.limit).saturating_mul(1_000_000);
        let radius = x.abs_diff(self.centre) as f64;
        // Metres to nanos of a millimetre, and turns to their nanos.
        let turns = self.speed as f64 * 1000.0 / (std::f64::consts::TAU * radius) * 1e9;
        match turns < limit as f64 {
            true => turns as Nanos,
            false if self.limit == u32::MAX => 0,
            false => limit,
        }
    }

    /// Whether two states are the same to the machine: the speed of a stopped spindle is nothing.
    #[inline]
    pub fn same(&self, other: &State) -> bool {
        self.tool == other.tool
            && self.spindle == other.spindle
            && (self.spindle == Spindle::Stopped
                || self.speed == other.speed
                    && self.spindle_mode == other.spindle_mode
                    && self.limit == other.limit
                    && self.centre == other.centre)
            && self.flood == other.flood
            && self.mist == other.mist
            && (self.tip, self.tilted) == (other.tip, other.tilted)
            && (self.turned, self.one_side) == (other.turned, other.one_side)
            && self.path == other.path
            && self.compensation == other.compensation
            // What F counts on arcs is compared on each of them.
            && (self.advice ^ other.advice) & !arc_feed::ADVICE == 0
            && self.within == other.within
    }
}

/// What of a [`State`] a control supports: the rest does not count in a comparison with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    /// Modes of taking corners that are distinguished from others, a bit each, with the lengths that belong to them.
    pub modes: u16,
    /// Whether the length of rounding in rapids is distinguished from that of cuts.
    pub in_rapids: bool,
    /// Whether the length within which moves are made one is distinguished from that of corners.
    pub merges: bool,
    /// Whether an exact stop is distinguished from rounding at all.
    pub path: bool,
    /// Kinds of advice, three bits each.
    pub advice: u64,
}

impl Default for Seen {
    fn default() -> Seen {
        Seen { modes: u16::MAX, in_rapids: true, merges: true, path: true, advice: u64::MAX }
    }
}

impl Seen {
    /// What the words of a control tell apart.
    pub fn by(caps: &Caps) -> Seen {
        Seen {
            modes: caps.modes.path,
            in_rapids: caps.modes.path_in_rapids,
            merges: caps.modes.path_merges,
            path: true,
            advice: seen_advice(caps),
        }
    }

    /// What both of two controls support.
    pub fn both(self, other: Seen) -> Seen {
        Seen {
            modes: self.modes & other.modes,
            in_rapids: self.in_rapids && other.in_rapids,
            merges: self.merges && other.merges,
            path: self.path && other.path,
            advice: self.advice & other.advice,
        }
    }

    /// What is seen of a state.
    pub fn as_seen(&self, state: &State) -> State {
        let seen = |mode: PathMode| self.modes >> mode as u16 & 1 == 1;
        let path = state.path.map(|mode| match mode.plain() {
            _ if seen(mode) => mode,
            PathMode::ExactPath if !seen(PathMode::ExactPath) => PathMode::ExactStop,
            plain => plain,
        });
        let tolerance = AdviceKind::PathTolerance.bits();
        let smoothness = AdviceKind::Smoothness.bits();
        // An exact stop of one move leaves the lengths of the mode around it as they are, without a use for them.
        let lengths = self.path && state.path.is_some_and(|mode| seen(mode) && mode != PathMode::ExactStop);
        let mut compensation = state.compensation;
        compensation.on_contour &= self.advice & arc_feed::ADVICE == arc_feed::ADVICE;
        State {
            compensation,
            path: path.filter(|_| self.path),
            advice: state.advice & self.advice,
            within: [
                if lengths { state.within[0] } else { 0 },
                if lengths && self.in_rapids { state.within[1] } else { 0 },
                if self.advice >> tolerance & 7 == 7 { state.within[2] } else { 0 },
                if lengths && self.merges { state.within[3] } else { 0 },
                if self.advice >> smoothness & 7 == 7 { state.within[4] } else { 0 },
            ],
            ..*state
        }
    }
}

/// Bits of the advice that a target supports, as [`State::advice`] has
/// them.
fn seen_advice(caps: &Caps) -> u64 {
    let kinds = AdviceKind::ALL.into_iter().map(|(kind, _)| kind);
    // Of a kind of which it has not all values, what is left out cannot be told from what stays.
    let whole = |kind: &AdviceKind| (0..kind.values().len() as u8).all(|value| caps.advises(*kind, value));
    kinds.filter(whole).fold(0, |bits, kind| bits | 7 << kind.bits())
}
