//! The command line of `ncc check`.

use std::path::PathBuf;

use clap::builder::TypedValueParser;
use clap::{Args, ValueEnum};
use ncc_ir::expr::num::Nanos;

use crate::args::common_args::{Reading, Switches, VariablesArg, Verbosity};

const EXAMPLES: &str = "\
Examples:
  ncc check part.nc                                 what is wrong with it
  ncc check part.nc --machine fanuc-vmc             held against a machine's travel, feeds, speeds
  ncc check part.nc --rapid-plane 2                 no rapid below Z2
  ncc check *.nc --from fanuc --format sarif -o check.sarif
  ncc check part.nc --deny NC0811 --allow NC0805    one rule as errors, another one not at all
  ncc explain NC0806                                what a rule means

Exit code: 0 nothing but notes; 1 warnings or errors; 2 wrong usage; 4 a file could not be read or
written. ncc reports blocks that it does not read; rules that would need to know what they do
are silent until the program has stated it again, and the summary says what was not checked.";

/// `ncc check`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Check {
    /// The programs, as PATH or DIALECT:PATH; `-` for stdin
    #[arg(value_name = "FILE", required_unless_present = "schema")]
    pub files: Vec<String>,
    /// In which dialect they are.
    #[command(flatten, next_help_heading = "What is checked")]
    pub reading: Reading,
    /// The machine: a profile's name or file
    #[arg(short, long, value_name = "MACHINE", help_heading = "What is checked")]
    pub machine: Option<String>,
    /// Plane below which no rapid may go: Z in program coordinates, mm
    #[arg(long, value_name = "Z", value_parser = plane, allow_hyphen_values = true, help_heading = "What is checked")]
    pub rapid_plane: Option<Nanos>,
    /// Which of their blocks are skipped.
    #[command(flatten, next_help_heading = "What is checked")]
    pub switches: Switches,
    /// What their variables hold.
    #[command(flatten, next_help_heading = "What is checked")]
    pub holding: VariablesArg,

    /// Do not tell of these rules or messages
    #[arg(
        long,
        value_name = "IDS",
        value_delimiter = ',',
        value_parser = id(),
        help_heading = "What is accepted"
    )]
    pub allow: Vec<u16>,
    /// Tell of these rules or messages as errors
    #[arg(
        long,
        value_name = "IDS",
        value_delimiter = ',',
        value_parser = id(),
        help_heading = "What is accepted"
    )]
    pub deny: Vec<u16>,

    /// For people, or as one document of JSON or SARIF 2.1.0 [default: text]
    #[arg(
        long,
        value_name = "text|json|sarif",
        value_enum,
        default_value_t = Form::Text,
        hide_default_value = true,
        hide_possible_values = true,
        help_heading = "How the result looks"
    )]
    pub format: Form,
    /// Write to this file instead of stdout; it appears whole or not at all
    #[arg(short, long, value_name = "FILE", help_heading = "How the result looks")]
    pub output: Option<PathBuf>,
    /// Print the JSON Schema of `--format json`, and nothing else
    #[arg(long, help_heading = "How the result looks")]
    pub schema: bool,

    /// What is reported.
    #[command(flatten)]
    pub telling: Verbosity,
}

/// Forms of the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Form {
    /// For people
    Text,
    /// JSON
    Json,
    /// SARIF
    Sarif,
}

fn id() -> impl TypedValueParser<Value = u16> {
    clap::builder::StringValueParser::new().try_map(|text| {
        ncc_driver::render::explain::code(&text).ok_or("no message has this id; one looks like NC0805")
    })
}

fn plane(text: &str) -> Result<Nanos, String> {
    ncc_driver::job::initial_variables::decimal(text)
        .ok_or_else(|| "write a decimal, such as 2 or -0.5".to_owned())
}
