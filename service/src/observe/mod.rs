//! Observation of the service: a name for each request, one line of the log, and counters for Prometheus.
//!
//! ```text
//! GET /metrics    counters and times of requests, OpenMetrics
//! ```
//!
//! No query, body or header is in the log or in a counter: these may hold secrets.

mod counters;
mod names;
mod requests;

pub use self::requests::{Form, Level, log};

pub(crate) use self::counters::{Counters, routes};
pub(crate) use self::names::RequestName;
pub(crate) use self::requests::pass;

/// A fault that no answer can report.
pub(crate) fn fault(words: &str) {
    tracing::error!("{words}");
}
