//! ncc-time: when everything happens.
//!
//! Execution says what a machine does; here every function gets its start and its duration, by a
//! model of the machine that the caller chooses. Functions come in one by one and leave in the same
//! order, as soon as nothing that follows can change their time.
//!
//! Not here: reading programs, machine profiles as files, tables and pictures. No dialect's name.

mod act;
mod ahead;
mod assumed;
mod clock;
mod corner;
mod fixed;
mod ideal;
mod junction;
mod limits;
mod machine;
mod path;
mod plan;
mod profile;
mod queue;
mod ramp;
mod smooth;

pub use act::{Act, Place};
pub use assumed::{AssumedFact, Fact, WHOLE_PATH};
pub use clock::{Clock, Model, Timed, UnknownModel};
pub use machine::{AxisFacts, Machine, ToolChangeOn};
pub use path::{Path, path};
pub use profile::Profile;
