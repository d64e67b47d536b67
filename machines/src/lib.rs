//! ncc-machines: what a shop knows of its machines.
//!
//! A profile is a data file: the dialect and the parameters of a control, rates and times of the
//! machine, tables, and the shop's choices for emitted programs. Every fact may be left out; what is
//! not stated is asked for or told as assumed, never filled in. A profile is checked as a whole, and
//! what is wrong with it is reported with its place.
//!
//! ```text
//! [power_on]            what is active when the control starts
//! units = "mm"
//! [[tool]]              a row of its tool table
//! number = 3
//! ```
//!
//! Not here: reading files, printing, and what a translation or a timeline does with the facts.

mod check;
mod control;
mod fact;
mod machine_json;
mod maps;
mod profile;
pub mod project;
pub mod reading;
pub mod schema;
mod shipped;
pub mod table;
mod takes;
mod wrong;

pub use control::Layout;
pub use fact::Fact;
pub use maps::{counterpart, maps, nameless, renaming};
pub use profile::Profile;
pub use shipped::{find, shipped, shipped_text};
pub use table::Row;
pub use takes::Takes;
pub use wrong::{Lacks, Needs, PatternFault, ProfileError, Twice, Wrong};
