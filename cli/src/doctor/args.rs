//! `ncc doctor`: its arguments.

use std::path::PathBuf;

use clap::Args;

use crate::args::common_args::{StartPosition, Verbosity};
use crate::args::typed::pair;

const EXAMPLES: &str = "\
Examples:
  ncc doctor part.cn --from mach9 --to fanuc                      what the translation depends on
  ncc doctor part.cn --to fanuc --write-from a.toml --write-to b.toml
                                                                  the same, as profiles to be filled in
  ncc translate part.cn --machine-from a.toml --machine-to b.toml
                                                                  what is filled in is no assumption any more";

/// `ncc doctor`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Doctor {
    /// The program; `-` for stdin
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Dialect of the source, or `auto` to recognise it [default: the machine's, else auto]
    #[arg(long, value_name = "DIALECT")]
    pub from: Option<String>,
    /// Dialect to translate into
    #[arg(long, value_name = "DIALECT")]
    pub to: Option<String>,
    /// What is known of the machine that the program was written for: a profile's name or file
    #[arg(long, value_name = "MACHINE")]
    pub machine_from: Option<String>,
    /// What is known of the machine to translate for
    #[arg(long, value_name = "MACHINE")]
    pub machine_to: Option<String>,
    /// Set an option of the source's dictionary
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    pub from_option: Vec<(String, String)>,
    /// Set an option of the target's dictionary
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    pub to_option: Vec<(String, String)>,
    /// Where it begins.
    #[command(flatten)]
    pub standing: StartPosition,
    /// Write a profile of the source's machine with the questions, to be filled in; a new file
    #[arg(long, value_name = "FILE")]
    pub write_from: Option<PathBuf>,
    /// Write a profile of the target's machine with the questions; a new file
    #[arg(long, value_name = "FILE")]
    pub write_to: Option<PathBuf>,

    /// How much ncc reports.
    #[command(flatten)]
    pub telling: Verbosity,
}
