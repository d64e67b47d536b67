//! What several verbs are asked alike: how a program is executed and timed, and how much is told of it.
//! The colour of messages is asked of all verbs at once, in `args`.

use clap::Args;
use ncc_timeline::{Model, ToolChangeOn};

use crate::args::{Start, start};
use crate::render::human::Loudness;

/// How a program is executed and timed.
#[derive(Clone, Debug, Args)]
pub struct Setting {
    /// Where the tool stands before the first block, in program coordinates, mm and degrees:
    /// `X-9,Y15.588,Z3` [default: program zero]
    #[arg(
        long,
        value_name = "AXES",
        value_parser = start,
        allow_hyphen_values = true,
        help_heading = "What is executed"
    )]
    pub start: Option<Start>,
    /// Block-skip switches that are on, by level; the others are off
    #[arg(
        long,
        value_name = "LEVELS",
        value_delimiter = ',',
        value_parser = clap::value_parser!(u8).range(1..=10),
        help_heading = "What is executed"
    )]
    pub skip: Vec<u8>,

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

/// How much is told.
#[derive(Clone, Copy, Debug, Args)]
pub struct Telling {
    /// Say everything with its place, assumptions too, not only the summary
    #[arg(short, long, conflicts_with = "quiet", help_heading = "What is reported")]
    pub verbose: bool,
    /// Say errors only, and show no progress
    #[arg(short, long, help_heading = "What is reported")]
    pub quiet: bool,
}

impl Telling {
    /// Which diagnostics are told.
    pub fn loudness(self) -> Loudness {
        match (self.quiet, self.verbose) {
            (true, _) => Loudness::Quiet,
            (false, true) => Loudness::Verbose,
            (false, false) => Loudness::Usual,
        }
    }
}

fn tool_change_on(text: &str) -> Result<ToolChangeOn, String> {
    match text {
        "select" => Ok(ToolChangeOn::Select),
        "change" => Ok(ToolChangeOn::Change),
        _ => Err("it is `select` or `change`".to_owned()),
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds.is_finite() && (0.0..1e9).contains(&seconds) => Ok(seconds),
        Ok(_) | Err(_) => Err("write seconds as a decimal, 0 or more".to_owned()),
    }
}
