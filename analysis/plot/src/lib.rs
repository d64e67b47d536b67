//! ncc-plot: pictures of an executed program.
//!
//! A [`Record`] takes the timed events one by one and keeps only what a picture can show. From it come
//! charts over time ([`charts()`]) and views of the tool path ([`view()`]) as SVG, and a page with a
//! script for a browser ([`report()`]).
//!
//! ```text
//! charts(&[&record], &[Chart::Feed], "no machine")
//! <svg width="1000" …>…<path class="curve p0" … d="M920 2060l0 -1400 …"/>…</svg>
//! ```
//!
//! Not here: reading programs, timing them, files.

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
