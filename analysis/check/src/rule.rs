//! The rules: their stable ids, names and severities.

/// How grave a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Severity {
    /// Worth knowing; a program with notes alone is clean.
    Note,
    /// Should be looked at before the program runs.
    Warning,
    /// The program cannot be right as it stands, or the machine will stop.
    Error,
}

macro_rules! rules {
    ($( $(#[$doc:meta])* $rule:ident = $code:literal, $name:literal, $severity:ident, $about:literal; )*) => {
        /// A rule.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Rule {
            $( $(#[$doc])* $rule, )*
        }

        impl Rule {
            /// All rules, by code.
            pub const ALL: &[Rule] = &[$( Rule::$rule, )*];
            /// Their codes.
            pub const CODES: &[u16] = &[$( $code, )*];

            /// The number of its stable code: 801 is `NC0801`.
            pub const fn code(self) -> u16 {
                match self { $( Rule::$rule => $code, )* }
            }

            /// Its name, in small letters with hyphens.
            pub const fn name(self) -> &'static str {
                match self { $( Rule::$rule => $name, )* }
            }

            /// How grave its findings are.
            pub const fn severity(self) -> Severity {
                match self { $( Rule::$rule => Severity::$severity, )* }
            }

            /// What it looks for, in one line.
            pub const fn about(self) -> &'static str {
                match self { $( Rule::$rule => $about, )* }
            }
        }
    };
}

rules! {
    /// An axis goes beyond its travel.
    AxisTravel = 801, "axis-travel", Error, "An axis goes beyond its travel.";
    /// A feed above the machine's highest.
    FeedRange = 802, "feed-range", Warning, "A feed is above the highest of the machine or of an axis.";
    /// A spindle speed above the machine's highest.
    SpeedRange = 803, "speed-range", Warning, "A spindle speed is above the machine's highest.";
    /// A feed move before any F.
    NoFeed = 804, "no-feed", Error, "A feed move comes before any F.";
    /// A feed move with the spindle stopped.
    NoSpindle = 805, "no-spindle", Warning, "A feed move is made with the spindle stopped or without a speed.";
    /// The drilling axis moves after a tool change without the tool's length.
    NoLength = 806, "no-length", Warning, "Z moves after a tool change before the tool length offset is active.";
    /// A rapid below the plane that the user has named.
    RapidBelow = 807, "rapid-below", Error, "A rapid goes below the plane that was named.";
    /// A number without a point among numbers with one.
    BareNumber = 808, "bare-number", Warning, "A number without a decimal point counts increments, and others have points.";
    /// A mode that the next program finds active.
    LeftOn = 809, "left-on", Warning, "The program ends with an active mode that the next one may find.";
    /// The spindle turns, coolant runs or a tool length offset is active at the program end.
    LeftRunning = 810, "left-running", Note, "The program ends with spindle, coolant or a length offset on.";
    /// A called program that is not in the text.
    CallNowhere = 811, "call-nowhere", Note, "A program that is called is not in the text.";
    /// A jump to a block that there is not.
    JumpNowhere = 812, "jump-nowhere", Error, "A jump or repetition goes to a block that there is not.";
    /// Blocks that are never executed.
    Unreachable = 813, "unreachable", Warning, "Blocks that are never executed.";
    /// A subprogram of the text that nothing calls.
    NeverCalled = 814, "never-called", Note, "A subprogram of the text that nothing calls.";
    /// A tap or a thread with a pitch of no standard.
    ThreadPitch = 815, "thread-pitch", Warning, "A tap is fed with a pitch that no standard thread has.";
}

impl Rule {
    /// The rule of a code.
    pub fn of(code: u16) -> Option<Rule> {
        Rule::ALL.iter().copied().find(|rule| rule.code() == code)
    }
}
