//! The command line of `ncc plot`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use ncc_plot::{Chart, View};

use crate::args::common_args::{Reading, Setting, Verbosity};
use crate::args::typed::pair;
use crate::time::args::{Form, StageArg, Time};

const EXAMPLES: &str = "\
Examples:
  ncc plot part.cn --machine M -o part.svg                      charts over time, as SVG
  ncc plot part.cn --machine M --chart speed,tool -o part.svg   some of them
  ncc plot part.cn --view isometric -o way.svg                  the way of the tool
  ncc plot part.cn --machine M -o part.html                     all of it, with the source, for a browser
  ncc plot part.cn part.nc --machine M -o both.svg              a program and its port over each other

The HTML file needs nothing else and no network. Of a large program, pictures keep what can be seen:
the least and greatest value of every moment, and the way to within a pixel of the whole; the legend
says how much that is.";

/// `ncc plot`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Plot {
    /// The program, or two to compare; `-` for stdin
    #[arg(value_name = "FILE", required = true, num_args = 1..=2)]
    pub files: Vec<PathBuf>,
    /// Dialect of the program, or `auto` to recognise it; of two programs, `A,B` [default: of one
    /// program the machine's, else auto]
    #[arg(long, value_name = "DIALECT", value_delimiter = ',', help_heading = "What is executed")]
    pub from: Vec<String>,
    /// Set an option of the dialect's dictionary; of one program only
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair, help_heading = "What is executed")]
    pub from_option: Vec<(String, String)>,
    /// How it is executed and timed.
    #[command(flatten)]
    pub setting: Setting,

    /// Charts over time, from top to bottom: speed, tool, feed, position [default: all]
    #[arg(
        long,
        value_name = "LIST",
        value_enum,
        value_delimiter = ',',
        hide_possible_values = true,
        conflicts_with = "view",
        help_heading = "What is drawn"
    )]
    pub chart: Vec<ChartName>,
    /// The tool path instead: plan, isometric
    #[arg(
        long,
        value_name = "plan|isometric",
        value_enum,
        hide_possible_values = true,
        help_heading = "What is drawn"
    )]
    pub view: Option<ViewName>,
    /// Write to this file instead of stdout; its name ends with .svg or .html and says what it is
    #[arg(short, long, value_name = "FILE", help_heading = "What is drawn")]
    pub output: Option<PathBuf>,

    /// How much ncc reports.
    #[command(flatten)]
    pub telling: Verbosity,
}

impl Plot {
    /// What `ncc time` would be asked of a program; `n` counts them.
    pub(super) fn timed(&self, n: usize) -> Time {
        let from = match self.from.as_slice() {
            // Two programs are rarely of one dialect.
            [] if self.files.len() > 1 => Some("auto".to_owned()),
            [] => None,
            [one] => Some(one.clone()),
            several => several.get(n).cloned(),
        };
        Time {
            files: Vec::new(),
            reading: Reading { from, from_option: self.from_option.clone() },
            setting: self.setting.clone(),
            form: Form::Summary,
            stage: StageArg::After,
            output: None,
            schema: false,
            telling: self.telling,
        }
    }

    /// The charts that are asked for.
    pub(super) fn charts(&self) -> Vec<Chart> {
        match self.chart.as_slice() {
            [] => Chart::ALL.to_vec(),
            some => some.iter().map(|name| name.chart()).collect(),
        }
    }
}

/// Charts by their names on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ChartName {
    /// Speed of the spindle
    Speed,
    /// Tool in the spindle
    Tool,
    /// Rate of the moves
    Feed,
    /// Where the axes are
    Position,
}

impl ChartName {
    fn chart(self) -> Chart {
        match self {
            ChartName::Speed => Chart::Speed,
            ChartName::Tool => Chart::Tool,
            ChartName::Feed => Chart::Feed,
            ChartName::Position => Chart::Position,
        }
    }
}

/// Views by their names on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ViewName {
    /// From above
    Plan,
    /// From the right, the front and above
    Isometric,
}

impl ViewName {
    pub(super) fn view(self) -> View {
        match self {
            ViewName::Plan => View::Plan,
            ViewName::Isometric => View::Isometric,
        }
    }
}
