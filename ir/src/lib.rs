//! ncc-ir: what a part program says, without the name of any control.
//!
//! [`program::Program`] is what passes rewrite: procedures of statements, each with its place in the source. A statement
//! is a canonical machining function, a cycle, a pattern of holes, control, or an assignment; its arguments are
//! expressions ([`expr`]), and a literal is an exact decimal ([`expr::num`]) with its unit. Binary floats live in
//! [`geometry`] alone. What a target can say of it are capabilities ([`caps`]), and of what computes [`computed`]. What is
//! wrong with a program, or lost of it, is a typed value with a place ([`diag`]).
//!
//! ```text
//! N10 G01 X10. F200     SET_FEED_RATE(200.mm) & STRAIGHT_FEED(X 10.mm)
//! ```
//!
//! Not here: what the machine does (`ncc-exec`), rewriting (`ncc-passes`), how a control spells it (`ncc-dialects`). This
//! crate names no dialect, reads no file and prints nothing.

pub mod alarms;
pub mod behaviour;
pub mod canon;
pub mod caps;
pub mod compensated;
pub mod computed;
pub mod diag;
pub mod expr;
pub mod geometry;
pub mod letters;
pub mod program;
pub mod rank;
pub mod shown;
pub mod source;
pub mod track;
