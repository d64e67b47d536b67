//! Moves folded back into cycles, and holes into patterns.
//!
//! ```text
//! down and up at X 10mm, the same at X 20mm    fold-cycles      START_CYCLE(drill, …), HOLE(X 10mm), HOLE(X 20mm)
//! HOLE(X 10mm), HOLE(X 20mm), HOLE(X 30mm)     fold-patterns    LINE_PATTERN(…)
//! ```
//!
//! Not here: the moves of a cycle: a fold is kept only if expanding it (`holes`) gives the same events.

pub mod fold_cycles;
pub mod fold_patterns;
