//! Moves folded back into cycles, and holes into patterns.

pub mod fold_cycles;
pub mod fold_patterns;
