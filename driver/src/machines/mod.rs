//! Profiles of machines as a translation takes them, and what there is to tell of one.
//!
//! [`pair`] holds the profiles of both sides, [`show`] lists facts with their sources, [`test`](mod@test) translates a
//! sample for a machine and back, [`words`] has the messages. Not here: the form of a profile (`ncc_machines`).
//!
//! ```text
//! profiles of both sides, a fault    pair    whether a profile answers it
//! ```

pub mod pair;
pub mod show;
pub mod test;
pub mod words;

use crate::render::messages::message::{Message, Part};

/// An entry about a machine.
fn machine(form: &'static str) -> Message {
    Message::part(Part::Machine, form)
}
