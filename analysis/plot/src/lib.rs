//! ncc-plot: what a program does, to look at.
//!
//! Functions with their times go into a [`Record`], which keeps what a picture can show and no more.
//! From it come charts over time ([`charts()`]), views of the tool's way ([`view()`]) and a report that a
//! browser shows ([`report()`]). Not here: reading programs, timing them, files.

mod charts;
mod chord;
mod frame;
mod ink;
mod listing;
mod project;
mod record;
mod report;
mod series;
mod sheet;
mod ticks;
mod view;
mod way;

pub use charts::{Chart, charts, later};
pub use chord::Turned;
pub use listing::Listing;
pub use project::{View, project};
pub use record::{Hole, Record, Stamps, Stretch, Sums};
pub use report::{Page, report};
pub use series::{Bin, Course, Series};
pub use view::view;
pub use way::{Extent, Leg, MOST, Stroke, Way, distance, simplify};
