//! What several verbs are asked alike: how a program is read, executed and timed, and how much is reported of
//! it. A heading of the help is the verb's. The colour of messages is asked of all verbs at once, in `args`.

use std::path::PathBuf;

use clap::Args;
use ncc_driver::job::initial_variables::{InitialVariables, decimal};
use ncc_driver::job::start::position;
use ncc_driver::problem::Problem;
use ncc_driver::render::Loudness;
use ncc_ir::expr::num::Nanos;
use ncc_time::{Model, ToolChangeOn};

use crate::args::typed::{Eol, Start, pair};
use crate::files;

/// In which dialect programs are read.
#[derive(Clone, Debug, Args)]
pub struct Reading {
    /// Dialect of the programs, or `auto` to recognise each [default: the machine's, else auto]
    #[arg(long, value_name = "DIALECT")]
    pub from: Option<String>,
    /// Set an option of the dialect's dictionary
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    pub from_option: Vec<(String, String)>,
}

/// Where a program begins. What is assumed without, a verb adds to the help.
#[derive(Clone, Copy, Debug, Args)]
pub struct StartPosition {
    /// Where the tool stands before the first block, in program coordinates, mm and degrees:
    /// `X-9,Y15.588,Z3`
    #[arg(long, value_name = "AXES", value_parser = start, allow_hyphen_values = true)]
    pub start: Option<Start>,
}

/// What variables hold before a program that is executed once.
#[derive(Clone, Debug, Args)]
pub struct VariablesArg {
    /// What variables hold before the program begins, one value each: a TOML file
    #[arg(long, value_name = "FILE")]
    pub args: Option<PathBuf>,
}

impl VariablesArg {
    /// Reads the file.
    ///
    /// # Errors
    /// It cannot be read; as of [`InitialVariables::one_of_file`].
    pub(crate) fn read(&self) -> Result<InitialVariables, Problem> {
        let read =
            |path| files::text(path).and_then(|(name, text)| InitialVariables::one_of_file(&name, &text));
        Ok(self.args.as_deref().map(read).transpose()?.unwrap_or_default())
    }
}

/// How the control's switches stand.
#[derive(Clone, Debug, Args)]
pub struct Switches {
    /// Block-skip switches that are on, by level; the others are off
    #[arg(
        long,
        value_name = "LEVELS",
        value_delimiter = ',',
        value_parser = clap::value_parser!(u8).range(1..=10)
    )]
    pub skip: Vec<u8>,
}

impl Switches {
    /// The levels that are on, a bit each.
    pub(crate) fn on(&self) -> u16 {
        self.skip.iter().fold(0, |on, level| on | 1 << level)
    }
}

/// What counts as the same.
#[derive(Clone, Copy, Debug, Args)]
pub struct Tolerance {
    /// How far lengths may be apart, in mm [default: half the coarser side's least increment]
    #[arg(long, value_name = "MM", value_parser = millimetres)]
    pub tolerance: Option<Nanos>,
}

/// The lines of a program that is written.
#[derive(Clone, Copy, Debug, Args)]
pub struct Lines {
    /// Line ends; `keep` is those of the source's first line [default: keep]
    #[arg(long, value_name = "keep|lf|crlf", value_enum, hide_possible_values = true)]
    pub eol: Option<Eol>,
}

/// How a program is executed and timed.
#[derive(Clone, Debug, Args)]
#[command(mut_arg("start", |start| start.help(
    "Where the tool stands before the first block, in program coordinates, mm and degrees: \
     `X-9,Y15.588,Z3` [default: program zero]"
)))]
pub struct Setting {
    /// Where it begins.
    #[command(flatten, next_help_heading = "What is executed")]
    pub standing: StartPosition,
    /// Which of its blocks are skipped.
    #[command(flatten, next_help_heading = "What is executed")]
    pub switches: Switches,

    /// What its variables hold.
    #[command(flatten, next_help_heading = "What is executed")]
    pub holding: VariablesArg,

    /// The machine: a profile's name or file
    #[arg(short, long, value_name = "MACHINE", help_heading = "How it is timed")]
    pub machine: Option<String>,
    /// How moves are timed: ideal (rates alone), trapezoidal (accelerations, look-ahead),
    /// jerk-limited [default: ideal]
    #[arg(
        long,
        value_name = "MODEL",
        default_value = "ideal",
        hide_default_value = true,
        help_heading = "How it is timed"
    )]
    pub model: Model,
    /// The function that takes the time of a tool change [default: the machine's]
    #[arg(long, value_name = "select|change", value_parser = tool_change_on, help_heading = "How it is timed")]
    pub tool_change_on: Option<ToolChangeOn>,
    /// Seconds on the clock before the first block
    #[arg(
        long,
        value_name = "SECONDS",
        default_value = "0",
        hide_default_value = true,
        value_parser = seconds,
        allow_hyphen_values = true,
        help_heading = "How it is timed"
    )]
    pub start_time: f64,
}

/// How much ncc reports.
#[derive(Clone, Copy, Debug, Args)]
pub struct Verbosity {
    /// Report everything with its place, assumptions too, not only the summary
    #[arg(short, long, conflicts_with = "quiet", help_heading = "What is reported")]
    pub verbose: bool,
    /// Say errors only, and show no progress
    #[arg(short, long, help_heading = "What is reported")]
    pub quiet: bool,
}

impl Verbosity {
    /// Which diagnostics are reported.
    pub fn loudness(self) -> Loudness {
        match (self.quiet, self.verbose) {
            (true, _) => Loudness::Quiet,
            (false, true) => Loudness::Verbose,
            (false, false) => Loudness::Usual,
        }
    }
}

fn start(text: &str) -> Result<Start, String> {
    position(text).map_err(|wrong| wrong.words())
}

fn tool_change_on(text: &str) -> Result<ToolChangeOn, String> {
    match text {
        "select" => Ok(ToolChangeOn::Select),
        "change" => Ok(ToolChangeOn::Change),
        _ => Err("it is `select` or `change`".to_owned()),
    }
}

fn millimetres(text: &str) -> Result<Nanos, String> {
    match decimal(text) {
        Some(nanos) if (0..=1_000_000_000_000).contains(&nanos) => Ok(nanos),
        Some(_) | None => Err("write millimetres as a decimal, 0 to 1000".to_owned()),
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds.is_finite() && (0.0..1e9).contains(&seconds) => Ok(seconds),
        Ok(_) | Err(_) => Err("write seconds as a decimal, 0 or more".to_owned()),
    }
}
