//! The log of the service: lines on stderr.

use std::io::Write;

/// A fault that no request can be told of.
pub(crate) fn fault(words: &str) {
    // A log that cannot be written changes nothing about what is done.
    let _ = writeln!(std::io::stderr(), "ncc serve: {words}");
}
