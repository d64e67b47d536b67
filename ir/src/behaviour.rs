//! Facts of a control that no program states: what a code does besides its name.
//!
//! A Haas stops the spindle at M00, LinuxCNC does not, and on a Fanuc the machine builder decides.
//! The dictionary names the value of each fact with its source, or leaves it open. The executor
//! applies the values of its side, so that a difference between two controls is a difference of events.
//! An open fact is a dimension of the test set-ups: where a program touches it, the other value is
//! executed too.
//!
//! Not here: which control has which value (the dictionaries), and what is executed (`exec`).

use crate::expr::Var;

/// How much an open fact matters to somebody at the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Concern {
    /// The cut, the spindle or a path may be another one: check it at the machine.
    Machine,
    /// The cut is the same under all values.
    Nothing,
    /// The first run cuts the same under all values, the next one may begin otherwise.
    AtEnd,
}

macro_rules! behaviours {
    ($( $(#[$doc:meta])* $name:ident = $key:literal, $about:literal, [$($value:literal),+], $concern:ident; )*) => {
        /// A fact of a control that no program states.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Behaviour { $( $(#[$doc])* $name ),* }

        impl Behaviour {
            /// All of them.
            pub const ALL: &'static [Behaviour] = &[ $( Behaviour::$name ),* ];

            /// Its name in dictionaries: `spindle-at-stop`.
            pub const fn name(self) -> &'static str {
                match self { $( Behaviour::$name => $key ),* }
            }

            /// What it decides, in a few words: `spindle at a program stop`.
            pub const fn about(self) -> &'static str {
                match self { $( Behaviour::$name => $about ),* }
            }

            /// Names of its values. The first one is that of a code which does no more than its name says.
            pub const fn values(self) -> &'static [&'static str] {
                match self { $( Behaviour::$name => &[$($value),+] ),* }
            }

            /// How much it matters where it is open.
            pub const fn concern(self) -> Concern {
                match self { $( Behaviour::$name => Concern::$concern ),* }
            }
        }
    };
}

behaviours! {
    /// The spindle at M00, and at M01 with its switch on.
    SpindleAtStop = "spindle-at-stop", "spindle at a program stop", ["does-not", "stops"], Machine;
    /// Coolant at M00, and at M01 with its switch on.
    CoolantAtStop = "coolant-at-stop", "coolant at a program stop", ["does-not", "stops"], Machine;
    /// The spindle at M06.
    SpindleAtChange = "spindle-at-change", "spindle at a tool change", ["does-not", "stops"], Machine;
    /// Coolant at M06.
    CoolantAtChange = "coolant-at-change", "coolant at a tool change", ["does-not", "stops"], Machine;
    /// Where Z goes before M06 changes the tool, and stays: nowhere, or to machine zero.
    ZAtChange = "z-at-change", "Z at a tool change", ["stays", "machine-zero"], Machine;
    /// The length of the tool after a return to the reference point along Z: it counts again with the next move of Z, or
    /// not before it is activated again.
    LengthAfterReturn = "length-after-return", "tool length after a reference point return", ["returns", "cancelled"], Machine;
    /// The same after a move in machine coordinates along Z.
    LengthAfterMachineMove = "length-after-machine-move", "tool length after a move in machine coordinates", ["returns", "cancelled"], Machine;
    /// What a dwell counts under a feed per revolution: seconds, or turns of the spindle.
    DwellPerRevolution = "dwell-per-revolution", "dwell under a feed per revolution", ["seconds", "turns"], Machine;
    /// A local shift (G52, TRANS) that is active at M02 and M30: the next program begins with it, or without.
    ShiftAtEnd = "shift-at-end", "local shift at the program end", ["kept", "cancelled"], AtEnd;
    /// The same of a G92 shift.
    OriginAtEnd = "origin-at-end", "G92 shift at the program end", ["kept", "cancelled"], AtEnd;
    /// The same of a rotation, scale and mirror that a program has programmed (G68, G51, G51.1).
    RotationAtEnd = "rotation-at-end", "rotation, scale and mirror at the program end", ["kept", "cancelled"], AtEnd;
    /// The spindle at M02 and M30.
    SpindleAtEnd = "spindle-at-end", "spindle at the program end", ["does-not", "stops"], Nothing;
    /// The active F after a change between millimetres and inches: the same feed, or the same number in the new unit.
    FeedAtUnits = "feed-at-units", "F after a change of units", ["same-feed", "same-number"], Machine;
    /// What F counts where linear and rotary axes move together: the way of X, Y and Z; a degree as a unit of length; or
    /// the way of the rotary axis at a diameter that is set on the machine.
    RotaryFeed = "rotary-feed", "feed of linear and rotary axes together", ["linear-axes", "degrees-as-lengths", "diameter"], Machine;
    /// What F counts on an arc under inverse time: one over the minutes of the block, or the feed over the radius.
    ArcByTime = "arc-by-time", "F on arcs under inverse time", ["time", "radius"], Machine;
    /// The speed of what F is on an arc under cutter compensation, in a program that has no code for it: that of the tool
    /// centre; that of the contour, so that the centre goes faster on outer arcs and slower on inner ones; or that of the
    /// contour on inner arcs alone.
    FeedOnArcs = "feed-on-compensated-arcs", "F on arcs under cutter compensation", ["centre", "contour", "inside"], Machine;
    /// Coolant at M02 and M30.
    CoolantAtEnd = "coolant-at-end", "coolant at the program end", ["does-not", "stops"], Nothing;
    /// Along which axis the length of a tool lies: Z whatever the plane, or the one at right angles to the active plane.
    LengthAxisInPlane = "length-axis-in-plane", "tool length in G18 and G19", ["z", "normal"], Machine;
    /// Along which axis a length takes effect: Z, or the one at right angles to the plane in which it is activated.
    LengthAxisAtCall = "length-axis-at-call", "tool length activated in G18 or G19", ["z", "normal"], Machine;
    /// How far and in which direction an absolute word turns a rotary axis: as far as its number says, the shortest way to
    /// that angle, or to that angle in the direction of the sign.
    RotaryTurn = "rotary-turn", "turn of a rotary axis by an absolute word", ["as-programmed", "shortest", "sign"], Machine;
    /// Digits of an incremental word below the least increment: they count, or are cut off word by word.
    FineDigits = "fine-digits", "digits below the least increment in incremental words", ["count", "cut-off"], Machine;
    /// Whether the first incremental word of an axis after a change of frame or work offset includes the change: it
    /// counts from the coordinate that the axis was programmed to before, else from where the axis stands.
    FrameOffsetIncremental = "frame-offset-incremental", "change of frame in an incremental word", ["excluded", "included"], Machine;
    /// Which tool M06 puts in where a T is in its block and another tool waits since an earlier T: the one that the
    /// block names, or the one that waits. Then the T of the block selects the next.
    ToolWithChange = "tool-with-change", "T in the block of M06", ["named", "waiting"], Machine;
    /// A tool length that is activated or cancelled in a block without a word of its axis: the next word is measured
    /// with it, or the axis moves by the difference at once. At a place of the machine no length counts.
    LengthWithoutAxis = "length-without-axis", "tool length in a block without Z", ["waits", "moves"], Machine;
    /// Common variables at M02 and M30: the next program finds in them what this one has left, or nothing.
    VariablesAtEnd = "variables-at-end", "common variables at the program end", ["kept", "vacant"], AtEnd;
    /// The same when the control is switched off. Retentive variables are kept by their name.
    VariablesWhenOff = "variables-when-off", "common variables when the control is switched off", ["kept", "lost"], AtEnd;
}

/// How long a control keeps what a program leaves in a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kept {
    /// Until the program ends.
    UntilEnd,
    /// Until the control is switched off.
    UntilOff,
    /// For ever.
    Always,
}

/// Number of behaviours.
const COUNT: usize = Behaviour::ALL.len();

impl Behaviour {
    /// Its name as an option: `spindle_at_stop`.
    pub fn option(self) -> String {
        self.name().replace('-', "_")
    }

    /// The behaviour with this name as an option, if there is one.
    pub fn of_option(option: &str) -> Option<Behaviour> {
        let letter = |byte| if byte == b'-' { b'_' } else { byte };
        let is = |behaviour: &Behaviour| behaviour.name().bytes().map(letter).eq(option.bytes());
        Behaviour::ALL.iter().copied().find(is)
    }

    /// The behaviour with this name, if there is one.
    pub fn named(name: &str) -> Option<Behaviour> {
        Behaviour::ALL.iter().copied().find(|behaviour| behaviour.name() == name)
    }

    /// The value with this name, if it has one.
    pub fn value(self, name: &str) -> Option<u8> {
        self.values().iter().position(|value| *value == name).map(|at| at as u8)
    }

    /// Whether a value counts only where it is stated: few machines have it.
    pub fn is_rare(self, value: u8) -> bool {
        self == Behaviour::RotaryTurn && self.values().get(usize::from(value)) == Some(&"sign")
    }

    /// As a bit of a set.
    pub const fn bit(self) -> u64 {
        1 << self as u8
    }
}

/// The behaviours of one control: a value for each, and which values are open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Behaviours {
    values: [u8; COUNT],
    open: u64,
    /// Values that this control can have besides the usual one, a bit each; 0 is all that are not rare.
    others: [u8; COUNT],
}

impl Behaviours {
    /// Index of the value that counts: of an open one, the usual value.
    #[inline]
    pub const fn get(&self, behaviour: Behaviour) -> u8 {
        self.values[behaviour as usize]
    }

    /// Whether the value is another one than that of a code which does no more than its name says.
    #[inline]
    pub const fn does(&self, behaviour: Behaviour) -> bool {
        self.get(behaviour) != 0
    }

    /// Whether a parameter, a machine datum or the builder decides it, and nobody has said how.
    pub const fn is_open(&self, behaviour: Behaviour) -> bool {
        self.open & behaviour.bit() != 0
    }

    /// Whether it surely has another value than the first one.
    pub const fn surely(&self, behaviour: Behaviour) -> bool {
        self.does(behaviour) && !self.is_open(behaviour)
    }

    /// Open behaviours, a bit each.
    pub const fn open(&self) -> u64 {
        self.open
    }

    /// Sets a value, which is known, or the usual one of an open behaviour.
    pub fn set(&mut self, behaviour: Behaviour, value: u8, open: bool) {
        self.values[behaviour as usize] = value;
        self.open = if open { self.open | behaviour.bit() } else { self.open & !behaviour.bit() };
    }

    /// The control can have these values alone besides the usual one, a bit each; 0 is all that are not rare.
    pub fn set_others(&mut self, behaviour: Behaviour, others: u8) {
        self.others[behaviour as usize] = others;
    }

    /// Values of an open behaviour that a run tries besides the usual one.
    pub fn others(&self, behaviour: Behaviour) -> impl Iterator<Item = u8> + use<> {
        let (usual, others) = (self.get(behaviour), self.others[behaviour as usize]);
        let can = move |value: u8| match others {
            0 => !behaviour.is_rare(value),
            others => others >> value & 1 == 1,
        };
        (0..behaviour.values().len() as u8).filter(move |value| *value != usual && can(*value))
    }

    /// How long a variable is kept.
    pub fn keeps(&self, var: &Var) -> Kept {
        match var {
            Var::Local(_) | Var::System(_) => Kept::UntilEnd,
            Var::Retentive(_) => Kept::Always,
            Var::Common(_) if self.does(Behaviour::VariablesAtEnd) => Kept::UntilEnd,
            Var::Common(_) if self.does(Behaviour::VariablesWhenOff) => Kept::UntilOff,
            Var::Common(_) => Kept::Always,
        }
    }

    /// The same with another value of one behaviour.
    #[must_use]
    pub fn with(mut self, behaviour: Behaviour, value: u8) -> Behaviours {
        self.values[behaviour as usize] = value;
        self
    }
}
