//! One program, ready for execution: for commands that inspect one program or compare two.
//!
//! A side has a [`Job`] with its own dialect as source and target. Execution and diagnostics need a job.
//! Not here: the execution and the comparison.

use ncc_dialects::{Dialect, Settings};
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;

use crate::job::Job;
use crate::machines::pair::Machines;
use crate::source::Source;

/// A program, ready to be executed.
#[derive(Debug)]
pub struct Side {
    /// Text and name, with the files that it calls.
    pub source: Source,
    /// Dialect, options and machine. Source and target are equal.
    pub job: Job,
}

impl Side {
    /// Dialect of the program.
    pub fn dialect(&self) -> &'static Dialect {
        self.job.from.dialect
    }
}

impl Side {
    /// Makes a side. `start` is the start position in nanos; an axis with `None` is not stated.
    pub fn of(
        source: Source,
        from: Settings,
        machines: Machines,
        start: Option<[Option<Nanos>; AXES]>,
    ) -> Side {
        let job = Job {
            machines,
            start: start.unwrap_or_default(),
            called: source.called.clone(),
            project: source.project.clone(),
            ..Job::new(from.clone(), from, &source.name)
        };
        Side { source, job }
    }
}
