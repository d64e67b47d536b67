//! What ncc does not translate: custom functions of a user's program, by where they are called; and why a program's answer
//! is refused.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: custom functions of a user's program, by where they are called.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum FunctionUnsupported {
        /// A computed word in the block.
        Computed,
        /// The function in a loop or a branch.
        InStructure,
        /// The function with cutter compensation active.
        Compensated,
        /// The function while a canned cycle may be active.
        InCycle,
        /// The function in a tilted plane, or with tool centre point control.
        Tilted,
        /// The function while axis words are polar coordinates.
        Polar,
        /// The function with another feed than per minute.
        FeedMode,
        /// The function before the first move in a new rotation, scale or mirror.
        BeforePlaced,
        /// Another code or statement in the block.
        BesideCodes,
        /// A block with block skip among blocks that are handed over together.
        Skipped,
        /// A jump may arrive among blocks that are handed over together.
        JumpTarget,
        /// No block ends the function.
        NotEnded {
            /// The code that ends it.
            until: Box<str>,
        },
        /// The code ends a function that has not begun.
        NotBegun {
            /// The function that it ends.
            name: Box<str>,
        },
        /// The function in blocks that are called by their numbers.
        InCalledBlocks,
    }
}

reasons! {
    /// Reasons for which the answer of a user's program is refused.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum FunctionFailure {
        /// The program cannot be started.
        NotStarted {
            /// The words of the system.
            reason: Box<str>,
        },
        /// The files for it cannot be written.
        NoFolder {
            /// The words of the system.
            reason: Box<str>,
        },
        /// It has not ended in time.
        TimeLimit {
            /// Seconds.
            seconds: u32,
        },
        /// It has ended with an exit code other than 0.
        Ended {
            /// The code.
            code: i64,
        },
        /// A signal has ended it.
        Killed,
        /// The user has stopped ncc.
        Interrupted,
        /// It has written no file.
        NoOutput,
        /// The output is no plain file.
        NoFile,
        /// The output is empty.
        Empty,
        /// The output is no text.
        NotText,
        /// It has written too much.
        TooLarge {
            /// Most bytes.
            limit: u32,
        },
        /// The output is no list of blocks.
        NotBlocks {
            /// Line, from 1.
            line: usize,
            /// Column, from 1.
            column: usize,
            /// The words of the reader.
            reason: Box<str>,
        },
        /// The output has too many blocks.
        TooMany {
            /// Most of them.
            most: u32,
        },
        /// A canonical function that ncc does not take from a program.
        Function {
            /// The block, counted from 1.
            block: usize,
            /// The function.
            function: Box<str>,
        },
        /// A block that starts elsewhere than the one before it ends.
        Start {
            /// The block, counted from 1.
            block: usize,
            /// The axis.
            axis: char,
        },
        /// A block moves, and its function does not.
        Moves {
            /// The block, counted from 1.
            block: usize,
            /// The function.
            function: Box<str>,
        },
        /// A move at feed without a feed.
        NoFeed {
            /// The block, counted from 1.
            block: usize,
        },
        /// A parameter that is missing, or of another form.
        Parameter {
            /// The block, counted from 1.
            block: usize,
            /// The parameter.
            parameter: Box<str>,
        },
        /// An arc in another plane than the active one.
        Plane {
            /// The block, counted from 1.
            block: usize,
        },
        /// A number that is too large.
        TooLong {
            /// The block, counted from 1.
            block: usize,
        },
    }
}
