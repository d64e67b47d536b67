//! Web hooks, the events that they tell of, and the deliveries of these events.
//!
//! `events` writes a delivery for each hook in the transaction of a change, so that no event is lost, and none is told that has not
//! happened. `deliveries` has them claimed, ended and listed. Not here: signatures and the network (`crate::hooks`).

mod deliveries;
pub(super) mod events;
mod records;

pub(crate) use self::deliveries::{Attempt, Delivery, Due};
pub(crate) use self::records::{EventKind, Hook, HookState};
