//! ncc-time: start and duration of every event.
//!
//! A [`Clock`] takes the events of an executed program ([`Act`]) one by one, computes their times with
//! the [`Model`] that the caller chooses, and gives them back in the same order ([`Timed`]). An event
//! leaves the clock as soon as no later event can change its time.
//!
//! ```text
//! G0 X100.           starts at  0.000 s, takes  0.200 s    ideal model, rapid rate 30000 mm/min
//! G1 X0. F600.       starts at  0.200 s, takes 10.000 s
//! ```
//!
//! Not here: reading programs, machine profiles as files, tables and pictures, any dialect's name.

mod act;
mod ahead;
mod assumed;
mod clock;
mod corner;
mod fixed;
mod ideal;
mod junction;
mod limits;
mod longest;
mod machine;
mod model;
mod path;
mod plan;
mod profile;
mod queue;
mod ramp;
mod smooth;

pub use act::{Act, Place};
pub use assumed::{AssumedFact, Fact, WHOLE_PATH};
pub use clock::{Clock, Timed};
pub use longest::Longest;
pub use machine::{AxisFacts, Machine, ToolChangeOn};
pub use model::{Model, UnknownModel};
pub use path::{Path, path};
pub use profile::Profile;
