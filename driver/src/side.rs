//! A program ready to be executed, for verbs that look at one program or hold two side by side.
//!
//! A side is a [`Job`] that translates the program into its own dialect, because that is what execution and the
//! rendering of diagnostics ask for.

use ncc_dialects::{Dialect, Settings};
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;

use crate::job::Job;
use crate::machines::pair::Machines;
use crate::source::Source;

/// A program, ready to be executed.
#[derive(Debug)]
pub struct Side {
    /// Its text.
    pub source: Source,
    /// Its dialect, options and machine; as a translation into itself.
    pub job: Job,
}

impl Side {
    /// Its dialect.
    pub fn dialect(&self) -> &'static Dialect {
        self.job.from.dialect
    }
}

impl Side {
    /// A program of a dialect with its options.
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
