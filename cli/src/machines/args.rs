//! The command line of `ncc machines`.

use clap::{Args, Subcommand};

/// `ncc machines`.
#[derive(Debug, Args)]
pub struct Machines {
    /// What about them; without, a list.
    #[command(subcommand)]
    pub what: Option<What>,
}

/// What about machines.
#[derive(Debug, Subcommand)]
pub enum What {
    /// Show a profile: every fact with its source, what is assumed, what is not stated
    Show {
        /// Its name, as `ncc machines` lists it, or its file
        machine: String,
    },
    /// Test profiles: the form, the sense, and programs written for them and read back
    Test {
        /// Their names or files
        #[arg(required = true)]
        machines: Vec<String>,
    },
    /// Print the schema of profiles: every key and what it takes
    Schema,
}
