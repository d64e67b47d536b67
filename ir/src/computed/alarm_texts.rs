//! Texts of the alarms that ncc makes itself. A program carries them, and ncc knows its own alarms by them.

/// The alarm of a control where a jump names no block.
pub const NO_SUCH_BLOCK: &str = "no such block";

/// The alarm where no program has the number, or none is to be called.
pub const NO_SUCH_PROGRAM: &str = "no such program";

/// The alarm where no code has the number. No value reaches it: who makes such branches has shown that the number is
/// that of one of the codes on every path.
pub const NO_SUCH_CODE: &str = "no such code";
