//! Facts of a control or machine that ncc assumes, because the program, the options and the profile do not state them.
//!
//! ```text
//! G73 on a control whose machine has the lift    BreakLift { length: "0.5" }
//! ```
//!
//! The driver alone has the words (`messages/control-fact`). Lengths are mm, spelt.

use crate::canon::Axis;
use crate::reason::reasons;

reasons! {
    /// A fact of a control or machine.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum ControlFact {
        /// How far above the last depth a peck begins at feed.
        PeckClearance {
            /// mm.
            length: Box<str>,
        },
        /// How far chip breaking lifts the tool.
        BreakLift {
            /// mm.
            length: Box<str>,
        },
        /// A block of a compensated contour that goes nowhere counts for nothing.
        StillBlock,
        /// The tool that a tool change puts in, before a T.
        WaitingTool {
            /// Its number.
            tool: u32,
        },
        /// The code of the tool in the spindle.
        ToolCodeAtStart {
            /// T.
            letter: char,
            /// The number after it.
            number: u32,
        },
        /// The code of the length that is active at the start.
        LengthCodeAtStart {
            /// H or D.
            letter: char,
            /// The number after it.
            number: u32,
        },
        /// The increment to which computed words are rounded.
        WordIncrement {
            /// As it is spelt.
            increment: Box<str>,
        },
        /// A fact that a variable of the control's own rests on, as its dictionary has it.
        SystemVariable {
            /// The fact.
            fact: Box<str>,
        },
        /// The value of a variable at the start.
        VariableAtStart {
            /// Its name.
            name: Box<str>,
            /// Its value.
            value: Box<str>,
        },
        /// A code returns to a caller, which is not in the text.
        ReturnsToCaller {
            /// The code.
            code: &'static str,
        },
        /// A subprogram begins with the feed of its caller.
        CallersFeed,
        /// A subprogram begins with the unit of its caller.
        CallersUnit {
            /// Which.
            unit: &'static str,
        },
        /// No cycle of the caller is active where a subprogram begins.
        NoCycleOfCaller,
        /// The condition of an `elseif` can be evaluated where it is passed over.
        ElseIf,
        /// The machine has no axes U, V and W: their places are 0.
        NoSuchAxes,
        /// The work offset that the program sets to its origin is free for it.
        OriginWorkOffset {
            /// 1 is G54.
            offset: u16,
        },
        /// A code acts after the move of its block.
        AfterMove {
            /// The code.
            code: Box<str>,
        },
        /// A code ends a main program.
        EndsMain {
            /// The code.
            code: Box<str>,
        },
        /// Alarms of these numbers end the program.
        AlarmsEnd,
        /// The machine has one record of its kinematics.
        SwivelRecord {
            /// Its name.
            name: Box<str>,
        },
        /// An M code that the program does not wait for is one that it waits for.
        QuickCode,
        /// Nearly equal numbers are not less or greater.
        InexactComparison,
        /// `ROUNDUP` of a negative number goes towards zero.
        RoundUpNegative,
        /// The half of a negative number is rounded away from zero.
        HalfRounded,
        /// A computed repeat count is a whole number from 1.
        RepeatCount,
        /// An argument of a cycle has the meaning that its dictionary is not sure of.
        Argument {
            /// Its name.
            name: Box<str>,
            /// Its value.
            value: Box<str>,
        },
        /// The clearance that a control computes.
        AutomaticClearance {
            /// The argument.
            name: Box<str>,
            /// The clearance, with its unit.
            length: Box<str>,
        },
        /// The same of a hole whose depth is computed.
        ComputedClearance {
            /// The argument.
            name: Box<str>,
        },
        /// A computed radius of a hole pattern is more than 0.
        ComputedRadius {
            /// The argument.
            name: Box<str>,
        },
        /// Words without a number mean the first spindle.
        MasterSpindle,
        /// The control has more variables than this.
        ManyVariables {
            /// The highest number that is used.
            number: u32,
        },
        /// Work offsets have no fine shifts.
        FineShifts,
        /// A value that is written to a device has the digits of its place.
        DeviceValue,
        /// Compared numbers are equal or apart by more than the control's tolerance.
        NearNumbers,
        /// Compared numbers are equal to more digits than either control compares, or further apart.
        NearerNumbers,
        /// Numbers are whole where a remainder is computed.
        WholeRemainder,
        /// Numbers are not negative where they are rounded up.
        RoundedUp,
        /// Numbers are not negative where they are rounded down.
        RoundedDown,
        /// Numbers are not negative where they are divided for a remainder.
        Divided,
        /// Rounded increments add up to less than the least increment.
        RoundedIncrements,
        /// The angle of an oriented spindle stop without one.
        Orientation {
            /// Degrees.
            degrees: Box<str>,
        },
        /// Angles of the spindle count from the same zero on both machines.
        SpindleZero,
        /// In which direction fine boring shifts the tool.
        BoreShift {
            /// As the machine's profile has it.
            direction: &'static str,
        },
        /// Where an axis stands at the start.
        AxisAtStart {
            /// The axis.
            axis: Axis,
            /// Program coordinate, mm or degrees.
            place: Box<str>,
        },
        /// A value of the machine that the program asks for.
        MachineValue {
            /// What is asked.
            asked: Box<str>,
        },
    }
}
