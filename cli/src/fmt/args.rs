//! The command line of `ncc fmt`.

use clap::Args;
use ncc_backends::Numbering;

use crate::args::common_args::{Lines, Reading, StartPosition, Verbosity};
use crate::args::typed::numbering;

const EXAMPLES: &str = "\
Examples:
  ncc fmt part.nc                          lay it out, in place
  ncc fmt --check *.nc                     list the files that would change; exit code 1 if any
  ncc fmt --diff part.nc                   show what would change
  ncc fmt part.nc --number 10:10           renumber the blocks, jumps with them
  ncc fmt fanuc:- --stdout < part.nc       from stdin to stdout

Words, comments and blank lines stay where they are, and the digits of numbers stay; what changes is
blanks, capitals, zeros and signs in front, the written form of codes, line ends. Before anything is
written, the result is read again and shown to have the same words; where the program can be executed,
it is executed before and after, and does the same. Lines that ncc cannot take apart stay as they are.

Exit code: 0 done; 1 a file would change (--check), or is refused; 2 wrong usage; 3 the result was not
shown to be the same, and is not written; 4 a file could not be read or written.";

/// `ncc fmt`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Fmt {
    /// The programs, as PATH or DIALECT:PATH; `-` for stdin, which goes to stdout
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<String>,
    /// In which dialect they are.
    #[command(flatten, next_help_heading = "What is laid out")]
    pub reading: Reading,
    /// The machine: a profile's name or file; its blanks, line ends and block numbers are used
    #[arg(short, long, value_name = "MACHINE", help_heading = "What is laid out")]
    pub machine: Option<String>,
    /// Where they begin.
    #[command(flatten, next_help_heading = "What is laid out")]
    pub standing: StartPosition,

    /// Write nothing; list the files that would change, and exit with 1 if there is one
    #[arg(long, help_heading = "What is written")]
    pub check: bool,
    /// Write nothing; show what would change
    #[arg(long, help_heading = "What is written")]
    pub diff: bool,
    /// Write to stdout instead of in place
    #[arg(long, conflicts_with_all = ["check", "diff"], help_heading = "What is written")]
    pub stdout: bool,
    /// Write only what could be executed before and after; else exit with 1
    #[arg(long, help_heading = "What is written")]
    pub executed: bool,

    /// Block numbers: none but those that something leads to, those of the source, or new ones, with
    /// jumps and calls of blocks following [default: keep]
    #[arg(
        long,
        value_name = "off|keep|FIRST:STEP",
        value_parser = numbering,
        help_heading = "How the result looks"
    )]
    pub number: Option<Numbering>,
    /// Their lines.
    #[command(flatten, next_help_heading = "How the result looks")]
    pub lines: Lines,

    /// How much ncc reports.
    #[command(flatten)]
    pub telling: Verbosity,
}
