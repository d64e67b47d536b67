//! `ncc verify` and the text that git shows of a program: their arguments.

use std::path::PathBuf;

use clap::Args;

use crate::args::common_args::{StartPosition, Tolerance, VariablesArg, Verbosity};
use crate::args::typed::{Format, pair};

const EXAMPLES: &str = "\
Examples:
  ncc verify part.cn part.nc                          the same cut?
  ncc verify mach9:part.cn fanuc:part.nc --tolerance 0.01
  ncc verify part.cn part.nc --cert part.json         and a certificate of it
  ncc verify --cert part.json                         does the certificate hold?
  ncc verify --cert part.json --recheck a.cn b.nc     the same, of files that have other names now

Both programs are executed in generated test set-ups. Each has other offsets, lengths and modes at
power-on, under every setting of the block-skip switches. What SRC relies on and never states is
assumed, as its dialect or the profile of its machine has it, and reported. What OUT relies on and
never states is not: unless its dialect or the profile of its machine settles it, the set-ups
disagree about it, and OUT is not equal. Only what a translation into its dialect would not state
either, and what neither of two programs for one control states, holds for OUT as for SRC; ncc
reports that too.

Exit code: 0 equal, or equal within the tolerance, and if a certificate is checked, all of it holds;
1 different, or the certificate does not hold; 2 wrong usage; 4 a file could not be read or written;
5 could not be compared, because a program has errors.";

/// `ncc verify`.
#[derive(Debug, Args)]
#[command(
    after_help = EXAMPLES,
    override_usage = "ncc verify [OPTIONS] SRC OUT\n       ncc verify --cert FILE [--recheck SRC OUT]",
    mut_arg("start", |start| start.help(
        "Where the tool stands before the first block, in the coordinates of SRC, mm and degrees"
    ))
)]
pub struct Verify {
    /// What was meant, and what shall do the same: `PATH` or `DIALECT:PATH`; `-` for stdin
    #[arg(value_name = "SRC OUT", num_args = 0..=2, required_unless_present_any = ["schema", "cert"])]
    pub files: Vec<String>,
    /// Dialect of SRC, where it is not named with the file [default: recognised]
    #[arg(long, value_name = "DIALECT", help_heading = "What is compared")]
    pub from: Option<String>,
    /// Dialect of OUT, likewise
    #[arg(long, value_name = "DIALECT", help_heading = "What is compared")]
    pub to: Option<String>,
    /// The machine of SRC: a profile by its name or file, which names the dialect too
    #[arg(long, value_name = "MACHINE", help_heading = "What is compared")]
    pub machine_from: Option<String>,
    /// The machine of OUT; with both, tools, offsets and lengths are the same by their names
    #[arg(long, value_name = "MACHINE", help_heading = "What is compared")]
    pub machine_to: Option<String>,
    /// Set an option of the dictionary of SRC
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair, help_heading = "What is compared")]
    pub from_option: Vec<(String, String)>,
    /// Set an option of the dictionary of OUT
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair, help_heading = "What is compared")]
    pub to_option: Vec<(String, String)>,
    /// Where SRC begins.
    #[command(flatten, next_help_heading = "What is compared")]
    pub standing: StartPosition,
    /// What the variables of both hold.
    #[command(flatten, next_help_heading = "What is compared")]
    pub holding: VariablesArg,
    /// What counts as the same.
    #[command(flatten, next_help_heading = "What is compared")]
    pub nearness: Tolerance,

    /// With SRC and OUT, write a certificate to this file; without, check the certificate in it again
    #[arg(long, value_name = "FILE", help_heading = "Certificates")]
    pub cert: Option<PathBuf>,
    /// Check the certificate for SRC and OUT, which have other names or places than it says
    #[arg(long, requires = "cert", help_heading = "Certificates")]
    pub recheck: bool,

    /// For people, or as JSON, the same document as the certificate [default: human]
    #[arg(
        long,
        value_name = "human|json",
        value_enum,
        default_value_t = Format::Human,
        hide_possible_values = true,
        hide_default_value = true,
        help_heading = "What is reported"
    )]
    pub format: Format,
    /// Print the JSON Schema of the certificate, and nothing else
    #[arg(long, help_heading = "What is reported")]
    pub schema: bool,
    /// How much ncc reports.
    #[command(flatten)]
    pub telling: Verbosity,
}

/// `ncc git-textconv`.
#[derive(Debug, Args)]
pub struct Textconv {
    /// The program, as `PATH` or `DIALECT:PATH`
    #[arg(value_name = "FILE")]
    pub file: String,
    /// Its dialect, where it is not named with the file [default: recognised]
    #[arg(long, value_name = "DIALECT")]
    pub from: Option<String>,
    /// Set an option of the dialect's dictionary
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    pub from_option: Vec<(String, String)>,
}
