//! What `ncc time` and `ncc plot` are asked alike: how a program is executed and timed, and what is
//! told of it.

use clap::Args;
use ncc_timeline::{Model, ToolChangeOn};

use crate::args::{Color, Start, start};

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

/// What is told, and how.
#[derive(Clone, Copy, Debug, Args)]
pub struct Telling {
    /// Say every assumption with its place, not only the account
    #[arg(short, long, conflicts_with = "quiet", help_heading = "What is reported")]
    pub verbose: bool,
    /// Say errors only, and show no progress
    #[arg(short, long, help_heading = "What is reported")]
    pub quiet: bool,
    /// Colour of the messages; `auto` is if stderr is a terminal and NO_COLOR is not set
    #[arg(
        long,
        value_name = "auto|always|never",
        value_enum,
        default_value_t = Color::Auto,
        hide_possible_values = true,
        hide_default_value = true,
        help_heading = "What is reported"
    )]
    pub color: Color,
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
