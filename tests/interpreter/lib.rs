//! A second interpreter: what a program of each dialect makes the machine do.
//!
//! It is here to be compared with the compiler, so it shares nothing with it: no dictionary, no number type, no
//! geometry. It was written from the reference notes alone, reads text line by line, keeps its state in plain `f64`, and
//! is slow and simple. Where the notes leave a question open it stops with an error and does not choose.
//!
//! Not here: speed, good messages, anything beyond the scope of the corpus.

mod beside;
pub mod canon;
mod change;
mod corner;
pub mod fanuc;
pub mod grbl;
mod grblhal;
mod hole;
pub mod ir;
pub mod linuxcnc;
pub mod mach3;
pub mod mach9;
pub mod next_run;
mod pace;
pub mod setup;
pub mod siemens;
mod slots;
mod speed;
mod stored;
mod threads;
mod tilt;

pub use beside::{ArcFeed, Beside};
pub use corner::Cut;
use corner::Planned;
pub use hole::Hole;
pub use pace::{Feeds, Rotary};
pub use setup::{PowerOn, Setup};
use siemens::frame::Frame;
use slots::Slots;
use stored::Stored;
pub use tilt::{Kinematics, Plane};

/// X Y Z A B C; millimetres and degrees.
pub type Place = [f64; 6];

/// State of the spindle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Spindle {
    Stopped,
    Clockwise,
    Counterclockwise,
}

/// What a feed counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Per {
    /// Millimetres a minute.
    Minute,
    /// Millimetres a turn of the spindle.
    Turn,
    /// Moves a minute.
    Move,
}

/// How the corner at the end of a move is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corner {
    /// The program has not said it.
    Unsaid,
    /// By a stop.
    Stop,
    /// Through it.
    Through,
    /// Rounded, one way or another.
    Rounded,
}

/// What happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum What {
    /// Rapid to the event's place.
    Traverse,
    /// Straight at feed to the event's place.
    Feed,
    /// Along a circle, or a helix, to the event's place.
    Arc {
        /// 0, 1, 2: the circle's axis is X, Y, Z.
        normal: usize,
        /// Centre, machine coordinates; its place on the normal axis is that of the start.
        centre: [f64; 3],
        /// Degrees, positive counter-clockwise seen from the positive end of the axis.
        sweep: f64,
    },
    /// In step with the spindle to the event's place: millimetres a turn, and whether a chuck makes good
    /// the rest.
    Thread(f64, bool),
    /// Straight at feed until the probe says so, which is the event's place: how far it goes at most, whether
    /// it looks for the end of a contact, and whether it is an error to find nothing.
    Probe(Place, bool, bool),
    /// The spindle was stopped at an angle, degrees.
    Orient(f64),
    /// A gear of the spindle; 0 is the control's own choice.
    Gear(u32),
    /// Coolant through the spindle goes on or off.
    Through(bool),
    /// Standing still for so many seconds.
    Dwell(f64),
    /// The spindle was started, stopped or reversed.
    Spindle(Spindle),
    /// Coolant was turned on or off: flood, mist.
    Coolant(bool, bool),
    /// A tool came into the spindle.
    Tool(u32),
    /// A value was put into a table: which table, which entry, what it holds now (axis by axis).
    Data(&'static str, u32, Place),
    /// Another plane in space, or none.
    Plane(Option<Plane>),
    /// The tool stands upright on it.
    Upright,
    /// A program stop.
    Stop,
    /// The program stops the machine by an alarm, and is over.
    Alarm,
    /// A text for the operator.
    Message,
    /// The text is taken away.
    MessageCleared,
    /// An optional stop.
    OptionalStop,
    /// The end.
    End,
    /// The program begins anew, for ever.
    BeginsAgain,
    /// The end of the text, where the program has not said that it ends.
    TextEnd,
}

/// An event and everything that was in force.
#[derive(Clone, Debug)]
pub struct Event {
    /// What happened.
    pub what: What,
    /// Line of the text, from 1.
    pub line: usize,
    /// Where the machine stands after it, in machine coordinates.
    pub machine: Place,
    /// The same in the coordinates of the program.
    pub program: Place,
    /// Work offset in force.
    pub offset: u32,
    /// Entry of the length table in force.
    pub entry: u32,
    /// Feed, in millimetres.
    pub feed: Option<f64>,
    /// What it counts.
    pub per: Per,
    /// The corner at its end.
    pub corner: Corner,
    /// Speed, rev/min, or m/min of a surface.
    pub speed: Option<f64>,
    /// Of a surface speed: where the machine's X is that it is measured about, and the highest rev/min.
    pub surface: Option<(f64, Option<f64>)>,
    /// Spindle.
    pub spindle: Spindle,
    /// Tool in the spindle.
    pub tool: Option<u32>,
    /// Flood and mist.
    pub coolant: (bool, bool),
    /// Beside which side of the contour the tool goes.
    pub beside: Option<Beside>,
    /// Whether the tip is kept where it is, and whether a plane in space counts.
    pub five: [bool; 2],
    /// What the control has done by itself, and no word since.
    pub by_itself: ByItself,
    /// The feed is the time of this very move.
    pub timed: bool,
}

/// What a control has done besides the name of a code, and no word of the program since.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ByItself {
    /// The spindle was stopped.
    pub spindle: bool,
    /// Coolant was switched off.
    pub coolant: bool,
    /// Z went up for a tool change.
    pub z: bool,
    /// This very move goes up for it.
    pub moves: bool,
    /// Z has been moved, so that it is not where the operator has left it.
    pub z_moved: bool,
}

/// Why a program was not run to its end.
#[derive(Clone, Debug)]
pub struct Halt {
    /// Line of the text, from 1.
    pub line: usize,
    /// What is wrong, or undecided.
    pub why: String,
}

/// The machine, as far as programs see it.
pub struct Machine {
    /// What F counts, where controls differ.
    pub feeds: Feeds,
    /// Its tables and switches.
    pub setup: Setup,
    /// What the program has put into its tables.
    stored: Stored,
    /// How far up the operator has moved the zero of Z by the tool that was put in.
    zero_moved: f64,
    /// Where it stands, machine coordinates.
    pub at: Place,
    /// Where the probe touched last, as the program counted then.
    pub touched: Option<Place>,
    /// How high the end of the spindle was then, above what the program counts from.
    pub touched_above: Option<f64>,
    /// Shifts, rotation, scale and mirror of a control that has them in slots.
    slots: Slots,
    /// What rotation, scale and mirror amount to.
    turn: Frame,
    /// What the slots shift, as long as they are what they were.
    slot_shift: Place,
    /// Whether each axis was moved to a programmed position since its offset last changed. An
    /// incremental word of an axis that was not is undecided.
    pub settled: [bool; 6],
    /// Inches.
    pub inch: bool,
    /// Absolute words.
    pub absolute: bool,
    /// 17, 18, 19.
    pub plane: u32,
    /// Work offset.
    pub offset: u32,
    /// Length entry.
    pub entry: u32,
    /// Millimetres, or moves a minute.
    pub feed: Option<f64>,
    /// What it counts.
    pub per: Per,
    /// How corners are taken.
    pub corners: Corner,
    /// The moves of this block end in a stop.
    pub stop_once: bool,
    /// rev/min.
    pub speed: Option<f64>,
    /// The speed is a surface's, in metres a minute.
    pub surface: bool,
    /// The highest rev/min of a surface speed.
    pub fastest: Option<f64>,
    /// Spindle.
    pub spindle: Spindle,
    /// In the spindle.
    pub tool: Option<u32>,
    /// Selected for the next change.
    pub selected: Option<u32>,
    /// Flood and mist.
    pub coolant: (bool, bool),
    /// Cutter radius compensation.
    pub beside: Option<Beside>,
    /// Whether its first move, or the one that leaves it, is still to come.
    pub lead: bool,
    /// Whether the tip is kept where it is while rotary axes turn.
    pub tip: bool,
    /// Whether a plane in space counts.
    pub plane_set: bool,
    /// What the control has done by itself.
    pub by_itself: ByItself,
    /// Line of the text.
    pub line: usize,
    /// What the corner behind the next move becomes.
    pub asked: Option<Cut>,
    /// Behind which events corners are cut.
    cuts: Vec<Planned>,
    /// The radius of every corner (RNDM), millimetres.
    pub round_all: Option<f64>,
    /// What happened so far.
    pub events: Vec<Event>,
}

impl Machine {
    /// A machine that was just switched on.
    pub fn new(mut setup: Setup) -> Machine {
        let modes = setup.power_on;
        let next_run::Left { stored, slots } = std::mem::take(&mut setup.left);
        Machine {
            at: setup.start,
            touched: None,
            touched_above: None,
            setup,
            stored,
            zero_moved: 0.0,
            turn: slots.turn(),
            slot_shift: slots.shift(),
            slots,
            settled: [true; 6],
            inch: modes.inch,
            absolute: modes.absolute,
            plane: modes.plane,
            offset: modes.offset,
            entry: modes.entry,
            feed: None,
            per: Per::Minute,
            corners: Corner::Unsaid,
            stop_once: false,
            speed: None,
            surface: false,
            fastest: None,
            spindle: Spindle::Stopped,
            tool: None,
            selected: None,
            coolant: (false, false),
            beside: None,
            lead: false,
            tip: false,
            plane_set: false,
            by_itself: ByItself::default(),
            feeds: Feeds::default(),
            line: 0,
            asked: None,
            cuts: Vec::new(),
            round_all: None,
            events: Vec::new(),
        }
    }

    /// What separates program from machine coordinates on an axis.
    pub fn shift(&self, axis: usize) -> f64 {
        let length = if axis == 2 { self.length_of(self.entry) } else { self.aside(axis) };
        self.zero_of(self.offset)[axis] + length + self.slots.shift()[axis] + self.apart(axis)
    }

    /// Where the machine stands, counted from the work offset.
    fn in_offset(&self) -> Place {
        let slots = self.slots.shift();
        std::array::from_fn(|axis| self.at[axis] - self.shift(axis) + slots[axis])
    }

    /// After the slots have changed; these axes are where they were, and an incremental word of one that
    /// is called something else is undecided.
    fn use_slots(&mut self, axes: [bool; 6]) {
        let (turn, shift) = (self.slots.turn(), self.slots.shift());
        let whole = |turn: &Frame, shift: &Place| Frame::shift([shift[0], shift[1], shift[2]]).then(turn);
        let (before, after) = (whole(&self.turn, &self.slot_shift), whole(&turn, &shift));
        for (axis, named) in axes.into_iter().enumerate() {
            let linear = axis < 3;
            let other =
                if linear { !after.agrees(&before, axis) } else { shift[axis] != self.slot_shift[axis] };
            // In a turned frame a shift along one axis is one along others as well.
            let named = named || linear && turn != Frame::NONE;
            self.settled[axis] &= !(named && other);
        }
        (self.turn, self.slot_shift) = (turn, shift);
    }

    /// Stops with a reason.
    pub fn halt<T>(&self, why: impl Into<String>) -> Result<T, Halt> {
        Err(Halt { line: self.line, why: why.into() })
    }

    /// Another work offset: nothing moves.
    pub fn use_offset(&mut self, number: u32) {
        if number != self.offset {
            self.settled = [false; 6];
        }
        self.offset = number;
    }

    /// Another length entry: nothing moves.
    pub fn use_length(&mut self, entry: u32) {
        self.use_aside(self.stored.aside_of(entry));
        if entry != self.entry {
            self.settled[2] = false;
            // In a frame that turns Z, the length is one along others as well.
            for axis in 0..2 {
                self.settled[axis] &= self.turn.m[axis][2] == 0.0 && self.turn.m[2][axis] == 0.0;
            }
        }
        self.entry = entry;
    }

    /// First and second axis of the plane, then its normal.
    pub fn axes(&self) -> (usize, usize, usize) {
        match self.plane {
            17 => (0, 1, 2),
            18 => (2, 0, 1),
            _ => (1, 2, 0),
        }
    }

    /// Where axis words (mm, degrees) lead to, in machine coordinates.
    pub fn target(&mut self, words: [Option<f64>; 6]) -> Result<Place, Halt> {
        let mut to = self.at;
        if self.turn != Frame::NONE {
            let xyz = self.turn.undo(std::array::from_fn(|axis| self.at[axis] - self.shift(axis)));
            let mut xyz = xyz;
            for axis in 0..3 {
                let mixed = (0..3)
                    .any(|other| other != axis && words[other].is_some() && self.turn.m[other][axis] != 0.0);
                match (words[axis], self.absolute) {
                    (None, _) if mixed && !self.settled[axis] => {
                        return self.halt("an axis left out after a change of frames or lengths");
                    }
                    (None, _) => {}
                    (Some(value), true) => {
                        xyz[axis] = value;
                        self.settled[axis] = true;
                    }
                    (Some(value), false) if self.settled[axis] => xyz[axis] += value,
                    (Some(_), false) => return self.halt("an incremental word after a change of frames"),
                }
            }
            if words[..3].iter().any(Option::is_some) {
                let xyz = self.turn.apply(xyz);
                for axis in 0..3 {
                    to[axis] = xyz[axis] + self.shift(axis);
                }
            }
        }
        for axis in if self.turn == Frame::NONE { 0..6 } else { 3..6 } {
            let Some(value) = words[axis] else { continue };
            if self.absolute {
                to[axis] = value + self.shift(axis);
                self.settled[axis] = true;
            } else if self.settled[axis] || value == 0.0 {
                to[axis] = self.at[axis] + value;
            } else {
                return self.halt("an incremental word after a change of offsets");
            }
        }
        Ok(to)
    }

    /// Records an event at the present place.
    pub fn record(&mut self, what: What) {
        assert!(self.events.len() < 1_000_000, "line {}: a program without an end", self.line);
        if let Some(cut) = self.asked.take() {
            self.cuts.push((self.events.len(), cut, self.axes(), self.feeds.arcs));
        }
        let mut program = self.at;
        for (axis, value) in program.iter_mut().enumerate() {
            *value -= self.shift(axis);
        }
        self.events.push(Event {
            line: self.line,
            machine: self.at,
            program,
            offset: self.offset,
            entry: self.entry,
            feed: self.feed,
            per: self.per,
            corner: if self.stop_once { Corner::Stop } else { self.corners },
            speed: self.speed,
            surface: self.surface.then(|| (self.shift(0), self.fastest)),
            spindle: self.spindle,
            tool: self.tool,
            coolant: self.coolant,
            beside: self.fed(self.beside, &what),
            what,
            five: [self.tip, self.plane_set],
            by_itself: self.by_itself,
            timed: false,
        });
        self.begun();
    }

    /// Rapid.
    pub fn traverse(&mut self, to: Place) {
        self.lead_straight(to);
        if (to[2] - self.at[2]).abs() > 1e-6 && !self.by_itself.moves {
            self.by_itself.z = false;
            self.by_itself.z_moved = true;
        }
        self.at = to;
        self.record(What::Traverse);
    }

    /// Straight at feed.
    pub fn straight(&mut self, to: Place) -> Result<(), Halt> {
        if self.feed.is_none() {
            return self.halt("a move at feed and no F");
        }
        self.lead_straight(to);
        let moved = (to[2] - self.at[2]).abs() > 1e-6;
        let minutes = self.minutes(self.at, to);
        self.at = to;
        self.record(What::Feed);
        if let Some(minutes) = minutes {
            self.take(minutes);
        }
        if moved {
            self.by_itself.z = false;
            self.by_itself.z_moved = true;
        }
        Ok(())
    }

    /// Straight at feed until the probe says so.
    pub fn probe(&mut self, to: Place, away: bool, error: bool) -> Result<(), Halt> {
        if self.feed.is_none() || self.beside.is_some() || to == self.at {
            return self.halt("probing without F or a way, or under compensation");
        }
        let (from, part) = (self.at, self.setup.touched);
        self.at = std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * part);
        self.touched = Some(std::array::from_fn(|axis| self.at[axis] - self.shift(axis)));
        self.touched_above = Some(self.at[2] - self.shift(2) + self.length_of(self.entry));
        self.record(What::Probe(to, away, error));
        Ok(())
    }

    /// Along a circle about `centre` (machine coordinates of the plane's two axes).
    pub fn arc(&mut self, to: Place, centre: (f64, f64), clockwise: bool) -> Result<(), Halt> {
        self.arc_of_turns(to, centre, clockwise, 0)
    }

    /// The same, with so many full turns before the last, partial one; an event each. The other
    /// axes move in proportion to the angle.
    pub fn arc_of_turns(
        &mut self,
        to: Place,
        centre: (f64, f64),
        clockwise: bool,
        turns: u32,
    ) -> Result<(), Halt> {
        if self.feed.is_none() {
            return self.halt("a move at feed and no F");
        }
        self.lead_arc()?;
        let (first, second, normal) = self.axes();
        let (a0, b0) = (self.at[first] - centre.0, self.at[second] - centre.1);
        let (a1, b1) = (to[first] - centre.0, to[second] - centre.1);
        let (r0, r1) = (a0.hypot(b0), a1.hypot(b1));
        if r0 < 0.0005 || (r0 - r1).abs() > 0.02 {
            return self.halt(format!("radius {r0} at the start, {r1} at the end"));
        }
        let mut sweep = (b1.atan2(a1) - b0.atan2(a0)).to_degrees();
        let closed = (a0 - a1).abs() < 1e-9 && (b0 - b1).abs() < 1e-9;
        if closed {
            sweep = if clockwise { -360.0 } else { 360.0 };
        } else if clockwise && sweep > 0.0 {
            sweep -= 360.0;
        } else if !clockwise && sweep < 0.0 {
            sweep += 360.0;
        }
        let total = sweep.abs() + 360.0 * f64::from(turns);
        let from = self.at;
        for turn in 1..=turns {
            let part = 360.0 * f64::from(turn) / total;
            for axis in 0..6 {
                if axis != first && axis != second {
                    self.at[axis] = from[axis] + (to[axis] - from[axis]) * part;
                }
            }
            let mut middle = [0.0; 3];
            middle[first] = centre.0;
            middle[second] = centre.1;
            let whole = if clockwise { -360.0 } else { 360.0 };
            self.record(What::Arc { normal, centre: middle, sweep: whole });
        }
        let mut full = [0.0; 3];
        full[first] = centre.0;
        full[second] = centre.1;
        full[normal] = self.at[normal];
        self.at = to;
        self.record(What::Arc { normal, centre: full, sweep });
        self.time_of_arc(sweep);
        Ok(())
    }

    /// The centre of an arc of radius `r` (negative for more than half a circle).
    pub fn centre_by_radius(&self, to: Place, r: f64, clockwise: bool) -> Result<(f64, f64), Halt> {
        let (first, second, _) = self.axes();
        let (x0, y0, x1, y1) = (self.at[first], self.at[second], to[first], to[second]);
        let (dx, dy) = (x1 - x0, y1 - y0);
        let half = dx.hypot(dy) / 2.0;
        if half < 1e-9 {
            return self.halt("a radius and no way to go");
        }
        let beyond = r * r - half * half;
        if beyond < -0.01 {
            return self.halt("the radius does not reach");
        }
        let height = beyond.max(0.0).sqrt();
        // The centre of a short counter-clockwise arc lies to the left of the chord.
        let left = if clockwise == (r > 0.0) { -1.0 } else { 1.0 };
        let (nx, ny) = (-dy / (2.0 * half), dx / (2.0 * half));
        Ok(((x0 + x1) / 2.0 + left * height * nx, (y0 + y1) / 2.0 + left * height * ny))
    }

    /// In step with the spindle.
    pub fn thread(&mut self, to: Place, pitch: f64, chuck: bool) {
        self.at = to;
        self.record(What::Thread(pitch, chuck));
    }

    fn stay(&mut self, seconds: f64) {
        if seconds > 0.0 {
            self.record(What::Dwell(seconds));
        }
    }

    /// Another unit of the feed: what was said in the one before says nothing in it.
    pub fn count_feed(&mut self, per: Per) {
        if self.per != per {
            self.feed = None;
        }
        self.per = per;
    }

    /// What is said for one block, or one move, is over: a stop, and a feed that counts moves.
    pub fn begin_block(&mut self) {
        self.stop_once = false;
        if self.per == Per::Move {
            self.feed = None;
        }
    }

    /// The spindle stops at an angle: where nothing is said, the control's own.
    pub fn orient(&mut self, angle: Option<f64>) {
        self.by_itself.spindle = false;
        self.spindle = Spindle::Stopped;
        self.record(What::Orient(angle.unwrap_or(self.setup.orientation)));
    }

    /// A rapid by so much along X, Y, Z.
    pub fn shift_tool(&mut self, by: [f64; 3]) {
        let mut to = self.at;
        for (to, by) in to.iter_mut().zip(by) {
            *to += by;
        }
        self.traverse(to);
    }

    /// Spindle words.
    pub fn turn(&mut self, state: Spindle) {
        self.by_itself.spindle = false;
        if self.spindle != state {
            self.spindle = state;
            self.record(What::Spindle(state));
        }
    }

    /// Coolant words.
    pub fn cool(&mut self, flood: bool, mist: bool) {
        if self.coolant != (flood, mist) {
            self.coolant = (flood, mist);
            self.record(What::Coolant(flood, mist));
        }
        self.by_itself.coolant = false;
    }

    /// The control stops the spindle and switches coolant off by itself, as a Haas does at M00 and M30 (manual of 2014,
    /// p. 322 and 326), and LinuxCNC at M2 and M30 (RS274/NGC, 3.6.1).
    pub fn switch_off(&mut self) {
        if self.spindle != Spindle::Stopped {
            self.spindle = Spindle::Stopped;
            self.by_itself.spindle = true;
        }
        if self.coolant != (false, false) {
            self.coolant = (false, false);
            self.by_itself.coolant = true;
        }
    }
}

/// A function of the machine by its name.
pub fn function(name: &str) -> Option<What> {
    match name.strip_prefix("coolant through the spindle ") {
        Some("on") => Some(What::Through(true)),
        Some("off") => Some(What::Through(false)),
        _ => gear(name).map(What::Gear),
    }
}

/// The gear that a function of the machine names.
fn gear(name: &str) -> Option<u32> {
    match name.strip_prefix("spindle gear ") {
        Some(number) => number.parse().ok(),
        None => (name == "automatic spindle gear").then_some(0),
    }
}

/// Text of bytes, each byte a character: comments are skipped anyway.
pub fn characters(bytes: &[u8]) -> String {
    bytes.iter().map(|b| *b as char).collect()
}
