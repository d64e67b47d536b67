//! Writes a workload to standard output: `workload surfacing 50` is about 50 MB.

use std::io::{self, Write};
use std::process::ExitCode;

#[path = "../benches/workload.rs"]
mod workload;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_default();
    let kind = workload::Workload::ALL.into_iter().find(|w| w.to_string() == name);
    let megabytes = arguments.next().and_then(|text| text.parse::<f64>().ok());
    let (Some(kind), Some(megabytes)) = (kind, megabytes) else {
        // The one place besides the command line itself that talks to a person.
        let _ = writeln!(io::stderr(), "usage: workload surfacing|arcs|drilling MEGABYTES");
        return ExitCode::from(2);
    };
    let mut out = io::BufWriter::with_capacity(1 << 20, io::stdout().lock());
    match kind.write((megabytes * 1e6) as u64, &mut out).and_then(|()| out.flush()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(_) => ExitCode::from(4),
    }
}
