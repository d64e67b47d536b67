//! Functions gathered into the record that pictures over time are drawn from.
//!
//! Not here: drawing (`ncc_plot`).

use std::io;

use ncc_plot::Record;
use ncc_time::Timed;

use super::drive::{Said, Sink};

/// Takes functions into a record.
pub struct Recorder(pub Record);

impl Sink for Recorder {
    fn wants_turns(&self) -> bool {
        true
    }

    fn function(&mut self, timed: &Timed, said: &Said) -> io::Result<()> {
        self.0.push(timed, said.turned.as_deref());
        Ok(())
    }
}
