//! What is computed: variables, expressions, questions, messages.

pub mod alarm_numbers;
pub mod arithmetic;
pub mod exact_comparisons;
pub(crate) mod known_answers;
pub mod message_values;
pub mod otherwise;
pub mod unit_in_force;
pub mod variables;
