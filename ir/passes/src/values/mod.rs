//! What is computed: variables, expressions, questions, messages.
//!
//! ```text
//! common:100 = common:101 + 1       variables         R1 = R2 + 1, in the numbers that the target has
//! FIX[#1] where #1 is never below 0    arithmetic        the function of the target that is the same there
//! ```
//!
//! Not here: loops and jumps (`flow`).

pub mod alarm_numbers;
pub mod arithmetic;
pub mod assumption_check;
pub(crate) mod constant_queries;
pub mod exact_comparisons;
pub mod message_values;
pub mod unit_in_force;
pub mod variables;
