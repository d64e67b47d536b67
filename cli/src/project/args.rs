//! `ncc config` and `ncc init`: their arguments.

use std::path::PathBuf;

use clap::Args;

use crate::args::typed::pair;

const CONFIG_EXAMPLES: &str = "\
Examples:
  ncc config                   the rows of the `ncc.toml` that counts here
  ncc config old/part.nc       what it states of a program, each with its line
  ncc config --schema          the form of the file: every key and what it takes";

/// `ncc config`.
#[derive(Debug, Args)]
#[command(after_help = CONFIG_EXAMPLES)]
pub struct Config {
    /// The program; without, all rows of the file that counts in this folder
    #[arg(value_name = "PROGRAM")]
    pub program: Option<PathBuf>,
    /// Print the form of the file: every key and what it takes
    #[arg(long, conflicts_with = "program")]
    pub schema: bool,
}

const INIT_EXAMPLES: &str = "\
Examples:
  ncc init part.nc --to siemens               writes `ncc.toml` beside the program
  ncc init part.nc --from haas --to siemens   the same, where the dialect cannot be recognised
  ncc to siemens part.nc                      what is in the file needs no option any more";

/// `ncc init`.
#[derive(Debug, Args)]
#[command(after_help = INIT_EXAMPLES)]
pub struct Init {
    /// A program of the folder
    #[arg(value_name = "PROGRAM")]
    pub program: PathBuf,
    /// Dialect to translate into
    #[arg(long, value_name = "DIALECT")]
    pub to: Option<String>,
    /// Dialect of the program, or `auto` to recognise it [default: the machine's, else auto]
    #[arg(long, value_name = "DIALECT")]
    pub from: Option<String>,
    /// The machine that the program was written for: a profile's name or file
    #[arg(long, value_name = "MACHINE")]
    pub machine_from: Option<String>,
    /// The machine to translate for
    #[arg(long, value_name = "MACHINE")]
    pub machine_to: Option<String>,
    /// Set an option of the program's dictionary
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    pub from_option: Vec<(String, String)>,
}
