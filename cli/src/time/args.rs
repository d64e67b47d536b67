//! The command line of `ncc time`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use ncc_driver::time::drive::Stage;

use crate::args::common_args::{Reading, Setting, Verbosity};

const EXAMPLES: &str = "\
Examples:
  ncc time part.cn --machine romi-discovery-4022         how long, by tool and by operation
  ncc time *.nc --from fanuc --machine M --as markdown   several programs, with totals
  ncc time part.cn --machine M --as csv -o part.csv      every function with its time
  ncc time part.cn --machine M --as payload              the same as a JSON document
  ncc time part.cn --as payload --stage before           cycles as they are called, not made
  ncc time part.cn --machine M --as tools -o tools.csv   what each tool does: ERP, setup sheet
  ncc time --from payload part.json --as csv             the rows again, of a stored document
  ncc time --schema                                      JSON Schema of payload and ndjson

What a machine does not state is assumed, and reported. Nothing is printed of a program
that cannot be executed; of several the others are reported all the same, and those that are missing
are named. Exit codes are those of `ncc --help`; of several programs the highest.";

/// `ncc time`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Time {
    /// The programs; `-` for stdin
    #[arg(value_name = "FILE", required_unless_present = "schema")]
    pub files: Vec<PathBuf>,
    /// In which dialect they are.
    #[command(flatten, next_help_heading = "What is executed")]
    pub reading: Reading,
    /// How it is executed and timed.
    #[command(flatten)]
    pub setting: Setting,

    /// What is printed [default: summary]
    #[arg(
        long = "as",
        value_name = "FORM",
        value_enum,
        default_value_t = Form::Summary,
        hide_default_value = true,
        help_heading = "How the result looks"
    )]
    pub form: Form,
    /// Before processing, cycles and patterns are one block each; after, their moves [default: after]
    #[arg(
        long,
        value_name = "before|after",
        value_enum,
        default_value_t = StageArg::After,
        hide_default_value = true,
        hide_possible_values = true,
        help_heading = "How the result looks"
    )]
    pub stage: StageArg,
    /// Write to this file instead of stdout; it appears whole or not at all
    #[arg(short, long, value_name = "FILE", help_heading = "How the result looks")]
    pub output: Option<PathBuf>,
    /// Print the JSON Schema of payload and ndjson, and nothing else
    #[arg(long, conflicts_with = "files", help_heading = "How the result looks")]
    pub schema: bool,

    /// How much ncc reports.
    #[command(flatten)]
    pub telling: Verbosity,
}

/// What is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Form {
    /// Tables for people
    Summary,
    /// The summary, as JSON
    Json,
    /// The summary, as Markdown
    Markdown,
    /// The tools, as CSV
    Tools,
    /// Every function, as CSV
    Csv,
    /// Every function, as one JSON document
    Payload,
    /// The same, with the fields as the case study prints them
    PayloadPrinted,
    /// Every function, as JSON, one a line
    Ndjson,
    /// The canonical functions, with times in comments; not of edges above 1, nor of a move in machine
    /// coordinates for one block, for which there is no such function
    Canon,
}

impl Form {
    /// Whether it can tell of several programs.
    pub(super) fn takes_several(self) -> bool {
        match self {
            Form::Summary | Form::Json | Form::Markdown | Form::Tools => true,
            Form::Csv | Form::Payload | Form::PayloadPrinted | Form::Ndjson | Form::Canon => false,
        }
    }

    /// Whether it can tell of cycles as they are called.
    pub(super) fn takes_stages(self) -> bool {
        matches!(self, Form::Payload | Form::PayloadPrinted | Form::Ndjson)
    }

    /// Its name on the command line.
    pub(super) fn name(self) -> String {
        self.to_possible_value().map(|v| v.get_name().to_owned()).unwrap_or_default()
    }
}

/// Stages of the case study's document, as they are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StageArg {
    /// As the program states it
    Before,
    /// As the machine does it
    After,
}

impl From<StageArg> for Stage {
    fn from(stage: StageArg) -> Stage {
        match stage {
            StageArg::Before => Stage::Before,
            StageArg::After => Stage::After,
        }
    }
}
