//! The layout of a program within its dialect, and nothing but the layout.
//!
//! [`text`] takes a program apart line by line and writes it again ([`layout`]), and has each line judged ([`same`]);
//! [`number`] gives blocks new numbers and whatever names them ([`references`]); [`events`] executes the text before and
//! after; [`calls`] is for texts that are lists of calls. Not here: what words mean.
//!
//! ```text
//! `g1x10y5`    `G1 X10 Y5`, executed before and after: the same events
//! ```

pub mod calls;
pub mod events;
pub mod layout;
pub mod number;
pub mod references;
pub mod same;
pub mod shown;
#[cfg(test)]
mod tests;
pub mod text;
pub mod whole;
