//! `ncc diff` and the driver of `git diff`: their arguments.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::args::common_args::{StartPosition, Tolerance, VariablesArg, Verbosity};
use crate::args::typed::pair;

const EXAMPLES: &str = "\
Examples:
  ncc diff old.nc new.nc                      do both make the same cut? what differs
  ncc diff mach9:a.cn fanuc:b.nc --summary    across dialects, in one line
  ncc diff a.nc b.nc --side-by-side --all     every difference, in two columns
  ncc diff a.nc b.nc --html review.html       a page to send to somebody
  ncc diff a.nc b.nc --text --ignore all      only what the text says otherwise

Both programs are executed in three worlds: one in which offsets and lengths are nothing, and two
with odd ones, so that a lost work offset shows; under every setting of the block-skip switches. Each
takes for granted what its dialect does; -v says what. Exit code: 0 the same, 1 different, 2 wrong
usage, 4 a file could not be read, 5 could not be compared, because a program has errors.";

/// `ncc diff`.
#[derive(Debug, Args)]
#[command(
    after_help = EXAMPLES,
    mut_arg("start", |start| start.help(
        "Where the tool stands before the first block of both, in program coordinates"
    ))
)]
pub struct Diff {
    /// The first program, as `PATH` or `DIALECT:PATH`; `-` for stdin
    #[arg(value_name = "A", required_unless_present = "schema")]
    pub a: Option<String>,
    /// The second program
    #[arg(value_name = "B", required_unless_present = "schema")]
    pub b: Option<String>,
    /// Dialect of what does not name one [default: recognised]
    #[arg(long, value_name = "DIALECT", help_heading = "What is compared")]
    pub from: Option<String>,
    /// The machine of A: a profile by its name or file, which names the dialect too
    #[arg(long, value_name = "MACHINE", help_heading = "What is compared")]
    pub a_machine: Option<String>,
    /// The machine of B
    #[arg(long, value_name = "MACHINE", help_heading = "What is compared")]
    pub b_machine: Option<String>,
    /// Set an option of the dictionary of A
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair, help_heading = "What is compared")]
    pub a_option: Vec<(String, String)>,
    /// Set an option of the dictionary of B
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair, help_heading = "What is compared")]
    pub b_option: Vec<(String, String)>,
    /// Where both begin.
    #[command(flatten, next_help_heading = "What is compared")]
    pub standing: StartPosition,
    /// What the variables of both hold.
    #[command(flatten, next_help_heading = "What is compared")]
    pub holding: VariablesArg,
    /// What counts as the same.
    #[command(flatten, next_help_heading = "What is compared")]
    pub nearness: Tolerance,
    /// Compare the text, block by block, instead of what it does
    #[arg(long, help_heading = "What is compared")]
    pub text: bool,
    /// What counts for nothing in a text: numbers (of blocks), blanks, comments, case,
    /// number-format, or all
    #[arg(
        long,
        value_name = "LIST",
        value_enum,
        value_delimiter = ',',
        requires = "text",
        hide_possible_values = true,
        help_heading = "What is compared"
    )]
    pub ignore: Vec<Ignore>,

    /// Say in one line what differs
    #[arg(long, conflicts_with_all = ["side_by_side", "format"], help_heading = "How the result looks")]
    pub summary: bool,
    /// Both texts in two columns
    #[arg(long, conflicts_with = "format", help_heading = "How the result looks")]
    pub side_by_side: bool,
    /// Show every difference, not only the first ten
    #[arg(long, help_heading = "How the result looks")]
    pub all: bool,
    /// For people, or as JSON [default: human]
    #[arg(
        long,
        value_name = "human|json",
        value_enum,
        default_value_t = Form::Human,
        hide_possible_values = true,
        hide_default_value = true,
        help_heading = "How the result looks"
    )]
    pub format: Form,
    /// Write a page with everything to this file
    #[arg(long, value_name = "FILE", help_heading = "How the result looks")]
    pub html: Option<PathBuf>,
    /// Print the JSON Schema of `--format json`, and nothing else
    #[arg(long, help_heading = "How the result looks")]
    pub schema: bool,

    /// How much ncc reports.
    #[command(flatten)]
    pub telling: Verbosity,
}

/// Form of the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Form {
    /// For people
    Human,
    /// One JSON document
    Json,
}

/// What counts for nothing in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Ignore {
    /// Block numbers
    Numbers,
    /// Blanks, and lines without anything else
    Blanks,
    /// Comments
    Comments,
    /// Capitals and small letters
    Case,
    /// How a number is written, where its value is the same
    NumberFormat,
    /// All of these
    All,
}

/// `ncc git-diff`.
#[derive(Debug, Args)]
#[command(
    override_usage = "ncc git-diff [OPTIONS] PATH OLD OLD-HEX OLD-MODE NEW NEW-HEX NEW-MODE [RENAMED …]"
)]
pub struct GitDiff {
    /// Path in the repository, then file, hash and mode of the old and of the new version
    #[arg(value_name = "GIT", num_args = 1.., required = true)]
    pub git: Vec<String>,
    /// Dialect of the programs [default: recognised]
    #[arg(long, value_name = "DIALECT")]
    pub from: Option<String>,
    /// Set an option of the dialect's dictionary
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    pub from_option: Vec<(String, String)>,
    /// Show every difference, not only the first ten
    #[arg(long)]
    pub all: bool,
}
