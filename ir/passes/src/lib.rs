//! ncc-passes: rewriting a program so that a target can say it, with the machine doing the same.
//!
//! A pass is a plain function on a program, listed in [`PASSES`] and runnable alone. Which ones a
//! target needs follows from its capabilities; [`Legaliser`] picks them and runs them on a program
//! that streams through in pieces. A pass never names a dialect, and never changes what the machine
//! does: what it cannot mend it refuses.
//!
//! ```text
//! --print-after all    shows the program after each pass that changed it
//! ```
//!
//! Not here: reading, writing, executing.

pub mod arcs;
pub mod flow;
pub mod fold;
pub mod frames;
pub mod holes;
mod legalise;
pub mod modes;
pub mod parametric;
pub mod pass;
pub mod support;
mod table;
mod target;
pub mod threads;
pub mod tools;
pub mod values;
pub mod watch;

pub use frames::machine_moves::retract;
pub use legalise::messages::{leave_out_output, leave_out_values, output_elsewhere};
pub use legalise::{Legaliser, Touch};
pub use pass::Pass;
pub use table::{FOLDS, FOLDS_OF_EVENTS, PASSES};
pub use target::{Compensating, Target};
