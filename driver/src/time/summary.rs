//! The summary: how long, by tool and by operation, with the model and what it assumes.
//!
//! One report, in three forms: tables for people, Markdown, JSON; and the tools alone as CSV.

use std::fmt::Write;
use std::io;

use ncc_time::Model;
use serde::Serialize;

use super::columns::micro;
use super::drive::{Course, Plan};
use super::duration::{hms, short};
use super::grid::{Grid, escaped};
use super::tally::{Account, Operation, Tally, Tool};
use crate::render::messages::message::{Message, Part};

/// All programs of a call.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Version of the form; it changes when a field changes its meaning or goes.
    pub ncc_time: u32,
    /// Version of ncc.
    pub ncc_version: &'static str,
    /// Name of the model.
    pub model: &'static str,
    /// The machine's name on the command line, if one was named.
    pub machine: Option<String>,
    /// What it is.
    pub machine_name: String,
    /// Each program.
    pub programs: Vec<Timing>,
    /// Names of those that could not be executed; they are not in the total.
    pub not_timed: Vec<String>,
    /// All of them together.
    pub total: Tally,
}

/// A program.
#[derive(Debug, Serialize)]
pub struct Timing {
    /// Name of the file.
    pub prog_name: String,
    /// Its dialect.
    pub dialect: String,
    /// Blocks that say something.
    pub blocks: u64,
    /// Canonical functions that were carried out.
    pub functions: u64,
    /// Seconds on the clock before and after it.
    pub clock: [f64; 2],
    /// Seconds that it takes at least and at most, where the model gives bounds.
    pub bounds: Option<[f64; 2]>,
    /// Facts of machine and control that the times assume, a line each.
    pub assumed: Vec<String>,
    /// All of it.
    pub total: Tally,
    /// By tool, in the order of first use.
    pub tools: Vec<Tool>,
    /// By operation, in the order of the program.
    pub operations: Vec<Operation>,
}

impl Timing {
    /// The summary of a program that was executed.
    pub fn of(name: &str, plan: &Plan, course: &Course, assumed: Vec<String>, account: Account) -> Timing {
        let mut timing = Timing {
            prog_name: name.to_owned(),
            dialect: plan.job.from.dialect.id.clone(),
            blocks: course.blocks,
            functions: account.functions,
            clock: [plan.start_time, course.end].map(micro),
            bounds: course.bounds.map(|bounds| bounds.map(micro)),
            assumed,
            total: account.total.rounded(),
            tools: account.tools,
            operations: account.operations,
        };
        for tally in timing.tools.iter_mut().map(|t| &mut t.tally) {
            *tally = tally.rounded();
        }
        for operation in &mut timing.operations {
            operation.tally = operation.tally.rounded();
            operation.start = micro(operation.start);
        }
        timing
    }
}

/// What a model leaves out, in a few words.
pub fn model_about(model: Model) -> String {
    let form = match model {
        Model::Ideal => "model-ideal",
        Model::Trapezoidal => "model-trapezoidal",
        Model::JerkLimited => "model-jerk-limited",
    };
    Message::part(Part::Time, form).headline()
}

impl Report {
    /// For people.
    pub fn plain(&self, model: Model) -> String {
        let mut out = String::new();
        for (i, timing) in self.programs.iter().enumerate() {
            if i > 0 {
                out.push('\n');
            }
            let _ = writeln!(out, "{} ({}) on {}\n", timing.prog_name, timing.dialect, self.on());
            shares(&timing.total).plain(&mut out);
            for grid in [tools(&timing.tools), cuts(&timing.tools), operations(&timing.operations)] {
                if !grid.rows.is_empty() {
                    out.push('\n');
                    grid.plain(&mut out);
                }
            }
            let _ = writeln!(out, "\n  model {}: {}", model.name(), model_about(model));
            if let Some([least, most]) = timing.bounds {
                let _ = writeln!(out, "  at least {}, at most {}", hms(least), hms(most));
            }
            for (i, line) in timing.assumed.iter().enumerate() {
                let head = if i == 0 { "assumed" } else { "" };
                let _ = writeln!(out, "  {head:<8}{line}");
            }
        }
        if self.several() {
            out.push('\n');
            self.all().plain(&mut out);
        }
        out
    }

    /// As Markdown.
    pub fn markdown(&self, model: Model) -> String {
        let mut out = String::new();
        for timing in &self.programs {
            let _ = writeln!(out, "# {}\n", escaped(&timing.prog_name));
            let (dialect, on) = (escaped(&timing.dialect), escaped(&self.on()));
            let _ = writeln!(out, "{dialect} on {on}\n");
            shares(&timing.total).markdown(&mut out);
            let parts = [
                ("Tools", tools(&timing.tools)),
                ("Cuts", cuts(&timing.tools)),
                ("Operations", operations(&timing.operations)),
            ];
            for (title, grid) in parts.into_iter().filter(|(_, grid)| !grid.rows.is_empty()) {
                let _ = writeln!(out, "\n## {title}\n");
                grid.markdown(&mut out);
            }
            let _ = writeln!(out, "\n## Model and assumptions\n");
            let _ = writeln!(out, "- model {}: {}", model.name(), model_about(model));
            if let Some([least, most]) = timing.bounds {
                let _ = writeln!(out, "- at least {}, at most {}", hms(least), hms(most));
            }
            for line in &timing.assumed {
                let _ = writeln!(out, "- assumed: {}", escaped(line));
            }
            out.push('\n');
        }
        if self.several() {
            let _ = writeln!(out, "# All programs\n");
            self.all().markdown(&mut out);
        } else {
            out.pop();
        }
        out
    }

    /// As JSON.
    ///
    /// # Errors
    /// Writing.
    pub fn json(&self, out: &mut dyn io::Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *out, self)?;
        out.write_all(b"\n")
    }

    /// The tools as CSV: what a setup sheet or an ERP takes.
    ///
    /// # Errors
    /// Writing.
    pub fn tool_list(&self, out: &mut dyn io::Write) -> io::Result<()> {
        let mut csv = csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(out);
        csv.write_record([
            "program",
            "position",
            "tool",
            "operations",
            "cut_offsets",
            "changes",
            "time",
            "cutting_time",
            "cutting_distance",
            "holes",
            "feed_min",
            "feed_max",
            "speed_min",
            "speed_max",
            "x_min",
            "x_max",
            "y_min",
            "y_max",
            "z_min",
            "z_max",
        ])?;
        for timing in &self.programs {
            for (position, tool) in timing.tools.iter().enumerate() {
                let t = &tool.tally;
                let pair = |p: Option<[f64; 2]>| {
                    p.map_or([String::new(), String::new()], |p| p.map(|v| short(v, 3)))
                };
                let offsets: Vec<String> = tool.cut_offsets.iter().map(u32::to_string).collect();
                let mut row = vec![
                    timing.prog_name.clone(),
                    (position + 1).to_string(),
                    tool.tool.map(|t| t.to_string()).unwrap_or_default(),
                    tool.operations.join("; "),
                    offsets.join(" "),
                    tool.changes.to_string(),
                    format!("{:.3}", t.time),
                    format!("{:.3}", t.cutting),
                    short(t.cutting_distance, 3),
                    t.holes.to_string(),
                ];
                row.extend(pair(t.feed));
                row.extend(pair(t.speed));
                for axis in 0..3 {
                    row.extend(pair(t.extents.map(|e| e[axis])));
                }
                csv.write_record(row)?;
            }
        }
        csv.flush()
    }

    /// The machine in words.
    fn on(&self) -> String {
        match self.machine_name.as_str() {
            "" => "no machine".to_owned(),
            name => name.to_owned(),
        }
    }

    /// Whether the call is about several programs.
    fn several(&self) -> bool {
        self.programs.len() + self.not_timed.len() > 1
    }

    /// One row a program, and all together.
    fn all(&self) -> Grid {
        let row = |name: &str, t: &Tally| {
            [
                vec![name.to_owned()],
                times(t),
                vec![t.holes.to_string(), short(t.cutting_distance, 1), short(t.rapid_distance, 1)],
            ]
            .concat()
        };
        let mut rows: Vec<Vec<String>> = self.programs.iter().map(|p| row(&p.prog_name, &p.total)).collect();
        let head = vec!["program", "time", "cutting", "rapid", "idle", "holes", "cut mm", "rapid mm"];
        rows.extend(self.not_timed.iter().map(|name| {
            let mut cells = vec![name.clone(), "not timed".to_owned()];
            cells.resize(head.len(), String::new());
            cells
        }));
        let all = self.programs.len() + self.not_timed.len();
        let count = if self.not_timed.is_empty() {
            format!("{all} programs")
        } else {
            format!("{} of {all} programs", self.programs.len())
        };
        rows.push(row(&count, &self.total));
        Grid { head, rows, left: 1 }
    }
}

/// Time in all, at feed, in rapids, and idle.
fn times(t: &Tally) -> Vec<String> {
    [t.time, t.cutting, t.rapid, t.idle].map(hms).into()
}

/// Shares of the whole.
fn shares(t: &Tally) -> Grid {
    let share = |part: f64| match t.time {
        0.0 => String::new(),
        whole => format!("{:.1} %", part / whole * 100.0),
    };
    let row = |name: &str, seconds: f64, length: Option<f64>| {
        let length = length.map(|mm| format!("{} mm", short(mm, 1))).unwrap_or_default();
        vec![name.to_owned(), hms(seconds), share(seconds), length]
    };
    let mut rows = vec![
        row("time", t.time, None),
        row("cutting", t.cutting, Some(t.cutting_distance)),
        row("rapid", t.rapid, Some(t.rapid_distance)),
        row("idle", t.idle, None),
    ];
    let parts =
        [("tool change", t.tool_change), ("spindle", t.spindle), ("dwell", t.dwell), ("other", t.other)];
    rows.extend(
        parts.into_iter().filter(|(_, s)| *s > 0.0).map(|(name, s)| row(&format!("of it {name}"), s, None)),
    );
    Grid { head: vec!["", "h:mm:ss", "share", "way"], rows, left: 1 }
}

/// `T3`, or that nobody knows.
fn tool_name(tool: Option<i64>) -> String {
    tool.map_or_else(|| "(at start)".to_owned(), |tool| format!("T{tool}"))
}

/// Time by tool.
fn tools(tools: &[Tool]) -> Grid {
    let rows = tools
        .iter()
        .map(|tool| {
            let t = &tool.tally;
            let name = vec![tool_name(tool.tool)];
            let rest = vec![t.holes.to_string(), short(t.cutting_distance, 1), short(t.rapid_distance, 1)];
            [name, times(t), rest].concat()
        })
        .collect();
    let head = vec!["tool", "time", "cutting", "rapid", "idle", "holes", "cut mm", "rapid mm"];
    Grid { head, rows, left: 1 }
}

/// `186`, or `186…505`.
fn range(pair: Option<[f64; 2]>) -> String {
    match pair.map(|p| p.map(|v| short(v, 3))) {
        None => "-".to_owned(),
        Some([least, most]) if least == most => least,
        Some([least, most]) => format!("{least}…{most}"),
    }
}

/// What each tool cuts: feeds, speeds, extents.
fn cuts(tools: &[Tool]) -> Grid {
    let rows = tools
        .iter()
        .filter(|tool| tool.tally.cuts > 0)
        .map(|tool| {
            let t = &tool.tally;
            let mut row = vec![tool_name(tool.tool), range(t.feed), range(t.speed)];
            row.extend((0..3).map(|axis| range(t.extents.map(|e| e[axis]))));
            row
        })
        .collect();
    Grid { head: vec!["tool", "mm/min", "rev/min", "X mm", "Y mm", "Z mm"], rows, left: 1 }
}

/// Time by operation.
fn operations(operations: &[Operation]) -> Grid {
    let rows = operations
        .iter()
        .map(|o| {
            let head = vec![o.name.clone(), tool_name(o.tool)];
            let place = vec![o.line.to_string(), hms(o.start)];
            [head, place, times(&o.tally), vec![o.tally.holes.to_string()]].concat()
        })
        .collect();
    let head = vec!["operation", "tool", "line", "begins", "time", "cutting", "rapid", "idle", "holes"];
    Grid { head, rows, left: 2 }
}
