//! The command line of `ncc simulate`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use ncc_driver::simulate::compare::TOLERANCE;
use ncc_driver::simulate::described::Described;
use ncc_driver::simulate::raw::{self, NoBody};
use ncc_driver::simulate::tooling::{self, NoTool};
use ncc_simulate::Look;

use crate::args::common_args::{Reading, Setting, Verbosity};
use crate::args::typed::pair;
use crate::time::args::{Form, StageArg, Time};

const EXAMPLES: &str = "\
Examples:
  ncc simulate part.nc                                          what each tool removes; alarms; tools and raw part guessed
  ncc simulate part.nc --stock \"X0:100 Y0:60 Z-20:0\" --tool 1=flat,10 --tool 2=drill,6.8,angle=118
  ncc simulate part.nc --stock raw.stl -m vf2.toml --png part.png --stl part.stl
  ncc simulate part.nc --at 120 --png half.png                  the part when line 120 is done
  ncc simulate part.cn --compare part.nc                        the parts of a program and of its port, held against each other
  ncc simulate part.nc --against drawing.stl                    gouges and rest material

A body is a block, X0:100 Y0:60 Z-20:0, a cylinder along Z, D50 X0 Y0 Z-30:0, or a file of triangles (.stl). All
coordinates count from the work offset in which the program cuts first, in mm.

Exit code 1: an alarm that rests on no guess, or parts that differ.";

/// `ncc simulate`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Simulate {
    /// The program; `-` for stdin
    #[arg(value_name = "FILE", required_unless_present = "schema")]
    pub file: Option<PathBuf>,
    /// Dialect of the program, or `auto` to recognise it [default: the machine's, else auto]
    #[arg(long, value_name = "DIALECT", help_heading = "What is executed")]
    pub from: Option<String>,
    /// Set an option of the dialect's dictionary
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair, help_heading = "What is executed")]
    pub from_option: Vec<(String, String)>,
    /// How it is executed and timed.
    #[command(flatten)]
    pub setting: Setting,

    /// The raw part [default: a block around all cuts, which is a guess]
    #[arg(
        long,
        value_name = "BODY",
        value_parser = body,
        allow_hyphen_values = true,
        help_heading = "What is on the machine"
    )]
    pub stock: Option<raw::Stated>,
    /// What holds it, and nothing may touch [may be repeated]
    #[arg(long, value_name = "BODY", value_parser = body, help_heading = "What is on the machine")]
    pub fixture: Vec<raw::Stated>,
    /// Z of the table
    #[arg(
        long,
        value_name = "Z",
        value_parser = finite,
        allow_hyphen_values = true,
        help_heading = "What is on the machine"
    )]
    pub table: Option<f64>,
    /// A tool: number (`start` is the one in the spindle at the start), shape (flat, ball, bull-nose, drill, chamfer, taper, lollipop, t-slot), diameter, and any of corner, angle,
    /// end_diameter, flute, shank, holder, holder_from: `4=drill,6.8,angle=118` [default: the profile's; then what
    /// comments of CAM systems say; then a guess; may be repeated]
    #[arg(long, value_name = "TOOL", value_parser = tool, help_heading = "What is on the machine")]
    pub tool: Vec<(i64, Described)>,
    /// Cells along the longer side of the part [default: 1024]
    #[arg(
        long,
        value_name = "N",
        default_value = "1024",
        hide_default_value = true,
        value_parser = clap::value_parser!(u16).range(16..=8192),
        help_heading = "What is on the machine"
    )]
    pub cells: u16,

    /// The part at a moment: when a line of the program is done (`120`), or at a time (`12.5s`, `0:01:12`)
    /// [default: at the end]
    #[arg(long, value_name = "LINE|TIME", value_parser = moment, help_heading = "What is written")]
    pub at: Option<Moment>,
    /// A picture of the part
    #[arg(long, value_name = "FILE", help_heading = "What is written")]
    pub png: Option<PathBuf>,
    /// From where that picture is taken: plan, isometric [default: isometric]
    #[arg(
        long,
        value_name = "plan|isometric",
        value_enum,
        hide_possible_values = true,
        help_heading = "What is written"
    )]
    pub view: Option<ViewName>,
    /// A sheet with the part from two sides, its tools and alarms
    #[arg(long, value_name = "FILE", help_heading = "What is written")]
    pub svg: Option<PathBuf>,
    /// The part as a body of triangles
    #[arg(long, value_name = "FILE", help_heading = "What is written")]
    pub stl: Option<PathBuf>,
    /// The account as JSON, on stdout
    #[arg(long, help_heading = "What is written")]
    pub json: bool,
    /// Print the schema of that document
    #[arg(long, help_heading = "What is written")]
    pub schema: bool,

    /// Another program for the same raw part: how do both parts differ?
    #[arg(long, value_name = "FILE", help_heading = "What it is held against")]
    pub compare: Option<PathBuf>,
    /// The dialect of that program [default: auto]
    #[arg(long, value_name = "DIALECT", requires = "compare", help_heading = "What it is held against")]
    pub compare_from: Option<String>,
    /// The machine of that program
    #[arg(long, value_name = "MACHINE", requires = "compare", help_heading = "What it is held against")]
    pub compare_machine: Option<String>,
    /// The part as it should be, a file of triangles: gouges and rest material
    #[arg(long, value_name = "STL", conflicts_with = "compare", help_heading = "What it is held against")]
    pub against: Option<PathBuf>,
    /// Heights that differ by no more are the same, in mm [default: 0.001; with --against 0.01]
    #[arg(long, value_name = "MM", value_parser = from_zero, help_heading = "What it is held against")]
    pub tolerance: Option<f64>,

    /// How much ncc reports.
    #[command(flatten)]
    pub telling: Verbosity,
}

/// From where a picture is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ViewName {
    /// From above
    Plan,
    /// From the right, the front and above
    Isometric,
}

impl ViewName {
    pub(super) fn look(self) -> Look {
        match self {
            ViewName::Plan => Look::Plan,
            ViewName::Isometric => Look::Corner,
        }
    }
}

/// A moment of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment {
    /// When a line of the source is done.
    Line(u32),
    /// Seconds on the clock.
    Time(f64),
}

impl Simulate {
    /// What `ncc time` would be asked of the program, or of the one that it is compared with.
    pub(super) fn timed(&self, compared: bool) -> Time {
        let (from, from_option) = match compared {
            true => (Some(self.compare_from.clone().unwrap_or_else(|| "auto".to_owned())), Vec::new()),
            false => (self.from.clone(), self.from_option.clone()),
        };
        let mut setting = self.setting.clone();
        if compared {
            setting.machine = self.compare_machine.clone();
        }
        Time {
            files: Vec::new(),
            reading: Reading {
                from: from.filter(|from| !compared || self.compare_machine.is_none() || from != "auto"),
                from_option,
            },
            setting,
            form: Form::Summary,
            stage: StageArg::After,
            output: None,
            schema: false,
            telling: self.telling,
        }
    }

    /// The tolerance of the comparison, mm.
    pub(super) fn tolerance(&self) -> f64 {
        self.tolerance.unwrap_or(if self.against.is_some() { 0.01 } else { TOLERANCE })
    }
}

fn body(text: &str) -> Result<raw::Stated, String> {
    raw::stated(text).map_err(|fault| match fault {
        NoBody::Form => "write X0:100 Y0:60 Z-20:0, or D50 Z-30:0, or the name of a .stl file".to_owned(),
        NoBody::Range => "each range goes from the lower to the higher value, in mm".to_owned(),
    })
}

fn tool(text: &str) -> Result<(i64, Described), String> {
    tooling::stated(text).map_err(|fault| match fault {
        NoTool::Form => {
            "write number=shape,diameter, and what the shape has: 4=drill,6.8,angle=118".to_owned()
        }
        NoTool::Incomplete => "a shank needs `flute`, a holder needs `holder_from`".to_owned(),
        NoTool::Value => "a length or an angle is above 0 and at most 10000".to_owned(),
    })
}

fn finite(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|value: &f64| value.abs() <= 1e6)
        .ok_or_else(|| "write mm as a decimal".to_owned())
}

fn from_zero(text: &str) -> Result<f64, String> {
    finite(text).and_then(|value| {
        if value >= 0.0 { Ok(value) } else { Err("write mm as a decimal, 0 or more".to_owned()) }
    })
}

fn moment(text: &str) -> Result<Moment, String> {
    let wrong = || "write a line, 120, or a time, 12.5s or 0:01:12".to_owned();
    if let Ok(line) = text.parse() {
        return Ok(Moment::Line(line));
    }
    let seconds = match text.strip_suffix('s') {
        Some(seconds) => seconds.parse::<f64>().ok(),
        None => text.contains(':').then_some(text).and_then(|text| {
            text.split(':').try_fold(0.0, |sum, part| {
                let part: f64 = part.parse().ok()?;
                (part >= 0.0).then_some(sum * 60.0 + part)
            })
        }),
    };
    seconds.filter(|seconds| seconds.is_finite() && *seconds >= 0.0).map(Moment::Time).ok_or_else(wrong)
}
