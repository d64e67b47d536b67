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
pub mod exact_comparisons;
pub(crate) mod known_answers;
pub mod message_values;
pub mod otherwise;
pub mod unit_in_force;
pub mod variables;
