//! A simulation in words: alarms as messages at their places in the source, and the account of the whole.

use std::io;

use codespan_reporting::diagnostic::Severity;
use codespan_reporting::term::termcolor::WriteColor;
use codespan_reporting::term::{self, Config};
use ncc_exec::world::Tables;
use ncc_ir::source::Span;
use ncc_simulate::{Alarm, AlarmKind, CutterFault, Shape, Stock};

use super::compare::Between;
use super::cut::{CutProgram, Uncut, Worked};
use super::path::{Path, Used};
use super::tooling::{Fitted, Known, NoCutter};
use super::unsimulated::Unsimulated;
use crate::problem::{Exit, Problem};
use crate::render::Loudness;
use crate::render::human::{MOST, boxed};
use crate::render::messages::message::{Help, Message, Part};
use crate::render::source::{Excerpt, Lines};
use crate::render::{Place, Told};
use crate::source::Source;
use crate::source::interrupted::Interrupted;
use crate::time::drive::Course;
use crate::time::duration;

/// The codes of alarms, and of a cut that is not simulated.
pub const CODES: &[u16] = &[901, 902, 903, 904, 905, 906, 907, NOT_SIMULATED];

/// The code of a cut that is not simulated.
const NOT_SIMULATED: u16 = 908;

/// The code of a kind of alarm.
pub fn code(kind: AlarmKind) -> u16 {
    match kind {
        AlarmKind::Rapid => 901,
        AlarmKind::Stopped => 902,
        AlarmKind::Flute => 903,
        AlarmKind::Shank => 904,
        AlarmKind::Holder => 905,
        AlarmKind::Fixture => 906,
        AlarmKind::Table => 907,
    }
}

fn words(form: &'static str) -> Message {
    Message::part(Part::Simulate, form)
}

/// A length in mm or a volume in mm³, with three digits after the point at most.
pub(super) fn decimal(value: f64) -> String {
    duration::short(value, 3)
}

/// `X10 Y20.5 Z-3`.
fn place(at: &[f64]) -> String {
    let words: Vec<_> =
        at.iter().zip(['X', 'Y', 'Z']).map(|(at, axis)| format!("{axis}{}", decimal(*at))).collect();
    words.join(" ")
}

/// A tool's name in messages.
fn tool(number: i64) -> String {
    match number {
        -1 => words("start-tool"),
        ..-1 => words("named-tool"),
        _ => words("tool").text("number", number.to_string()),
    }
    .headline()
}

/// The message of an alarm.
pub(super) fn message(alarm: &Alarm, cut: &CutProgram) -> Message {
    Message::new(code(alarm.kind))
        .text("tool", tool(cut.path.tools[alarm.tool].number))
        .text("depth", decimal(alarm.depth))
        .text("place", place(&alarm.place))
        .count("more", u64::from(alarm.last - alarm.first))
}

/// An alarm in a line.
pub(super) fn headline(alarm: &Alarm, cut: &CutProgram) -> String {
    let message = message(alarm, cut);
    format!("{}: {}", message.headline(), message.label())
}

/// The raw part in a line.
pub(super) fn raw_headline(cut: &CutProgram) -> String {
    let setup = cut.simulation.setup();
    let form = if setup.guessed { "guessed-raw" } else { "stated-raw" };
    words(form).text("raw", raw(&setup.stock)).headline()
}

/// Each tool in a line, with what it did.
pub(super) fn tool_headlines(cut: &CutProgram) -> Vec<String> {
    tool_rows(cut).into_iter().map(|(name, text)| format!("{name}: {text}")).collect()
}

/// What an alarm rests on that is a guess.
fn rests(alarm: &Alarm, cut: &CutProgram) -> Vec<String> {
    let on_tool = cut.tools[alarm.tool].tool.guessed;
    let on_raw =
        cut.simulation.setup().guessed && !matches!(alarm.kind, AlarmKind::Fixture | AlarmKind::Table);
    let all = [(on_raw, "rests-raw"), (on_tool, "rests-tool")];
    all.into_iter().filter(|(rests, _)| *rests).map(|(_, form)| words(form).headline()).collect()
}

/// All alarms, as messages at their places.
///
/// # Errors
/// Reading the source.
pub fn alarms(cut: &CutProgram, source: &mut Source) -> io::Result<(Vec<Told>, Lines)> {
    let span = |alarm: &Alarm| cut.path.spans[alarm.first as usize - 1];
    let mut lines =
        Lines::find(&mut source.file, cut.alarms().iter().map(|alarm| span(alarm).start).collect())?;
    lines.own_numbers(source.called.as_ref());
    let tell = |alarm: &Alarm| {
        let severity = if alarm.guessed { Severity::Warning } else { Severity::Error };
        at_place(&message(alarm, cut), severity, span(alarm), rests(alarm, cut), source, &lines)
    };
    let told = cut.alarms().iter().map(tell).collect::<io::Result<_>>()?;
    Ok((told, lines))
}

fn at_place(
    message: &Message,
    severity: Severity,
    span: Span,
    details: Vec<String>,
    source: &mut Source,
    lines: &Lines,
) -> io::Result<Told> {
    let file = source.called.as_ref().and_then(|called| called.file(span.start));
    let shown = file.map_or_else(|| source.shown.clone(), |file| file.name.clone());
    let excerpt = Excerpt::read(&mut source.file, lines, &shown, &[span])?;
    let start = excerpt.location(lines, span.start).unwrap_or((1, 1));
    let text = excerpt.snippet(lines, span).to_owned();
    let end = (start.0, start.1 + text.chars().count() as u64);
    let entry = message.entry();
    Ok(Told {
        code: entry.split('-').next().unwrap_or_default().to_owned(),
        severity,
        verdict: None,
        rank: None,
        message: message.headline(),
        values: message.values(),
        entry,
        place: Place { span, start, end, text, label: message.label() },
        related: Vec::new(),
        details,
        advice: message.helps(None),
        excerpt,
    })
}

/// Writes alarms in boxes; of each code so many, and how many more there are.
///
/// # Errors
/// Writing.
pub fn write_alarms(
    out: &mut dyn WriteColor,
    told: &[Told],
    lines: &Lines,
    loudness: Loudness,
) -> io::Result<()> {
    let mut met = std::collections::BTreeMap::new();
    for own in told {
        if loudness == Loudness::Quiet && own.severity != Severity::Error {
            continue;
        }
        let count: &mut usize = met.entry(own.code.as_str()).or_default();
        *count += 1;
        if *count <= MOST || loudness == Loudness::Verbose {
            term::emit_to_write_style(out, &Config::default(), &own.excerpt, &boxed(own, lines))
                .map_err(io::Error::other)?;
        }
    }
    for (code, count) in met.into_iter().filter(|(_, count)| *count > MOST && loudness != Loudness::Verbose) {
        writeln!(out, "… and {} more of {code} (-v shows them)\n", count - MOST)?;
    }
    Ok(())
}

/// Tells why a program is not cut.
///
/// # Errors
/// Reading the source, or writing.
pub fn write_refusal(
    out: &mut dyn WriteColor,
    uncut: Uncut,
    source: &mut Source,
) -> io::Result<Option<Problem>> {
    let (why, span) = match uncut {
        Uncut::Unsimulated(why, span) => (why, span),
        Uncut::NoCut => {
            let message = words("no-cut").text("program", source.shown.clone());
            return Ok(Some(Problem::of(Exit::Refused, &message, None)));
        }
        Uncut::Halted(line) => {
            let error = io::Error::other(Interrupted { line: Some(u64::from(line)) });
            return Ok(Some(Problem::file("read", &source.shown, &error)));
        }
    };
    let message = match why {
        Unsimulated::Rotary => Message::new(NOT_SIMULATED),
        Unsimulated::Leaning => Message::new(NOT_SIMULATED).form("leaning"),
        Unsimulated::Tilted => Message::new(NOT_SIMULATED).form("tilted"),
        Unsimulated::Unplaced => Message::new(NOT_SIMULATED).form("unplaced"),
    };
    let mut lines = Lines::find(&mut source.file, vec![span.start])?;
    lines.own_numbers(source.called.as_ref());
    let told = at_place(&message, Severity::Error, span, Vec::new(), source, &lines)?;
    write_alarms(out, &[told], &lines, Loudness::Usual)?;
    Ok(None)
}

/// A tool that has no cutter, as a problem of the call.
pub fn no_cutter(fault: &NoCutter) -> Problem {
    let form = match &fault.fault {
        CutterFault::Value(name, value) => {
            words("no-cutter").text("name", *name).text("value", decimal(*value))
        }
        CutterFault::Corner { corner, radius } => {
            words("no-cutter-corner").text("corner", decimal(*corner)).text("radius", decimal(*radius))
        }
        CutterFault::Neck { neck, diameter } => {
            words("no-cutter-neck").text("neck", decimal(*neck)).text("diameter", decimal(*diameter))
        }
        CutterFault::Undercut => words("undercut"),
    };
    let number = fault.number.to_string();
    let help = Help::new("help").text("tool", number.clone());
    Problem::of(Exit::Usage, &form.text("tool", number), Some(vec![help]))
}

/// Stated tools that a program does not have, as a problem of the call.
pub fn no_tool(path: &Path, unused: &[i64]) -> Problem {
    let names = |all: &mut dyn Iterator<Item = i64>| all.map(tool).collect::<Vec<_>>().join(", ");
    let unused = names(&mut unused.iter().copied());
    let used = names(&mut path.tools.iter().map(|own| own.number));
    Problem::of(Exit::Usage, &words("no-tool").text("unused", unused).text("used", used), None)
}

/// A raw part in words.
fn raw(stock: &Stock) -> String {
    let [low, high] = stock.extent();
    let form = match stock {
        Stock::Block { .. } => words("block"),
        Stock::Cylinder { axis, radius, .. } => {
            let own = words("cylinder").text("d", decimal(2.0 * radius));
            return own
                .text("x", decimal(axis[0]))
                .text("y", decimal(axis[1]))
                .text("z0", decimal(low[2]))
                .text("z1", decimal(high[2]))
                .headline();
        }
        Stock::Body(_) => words("body"),
    };
    let names = [["x0", "x1"], ["y0", "y1"], ["z0", "z1"]];
    let form =
        names.into_iter().zip(low.into_iter().zip(high)).fold(form, |form, ([least, most], (low, high))| {
            form.text(least, decimal(low)).text(most, decimal(high))
        });
    form.headline()
}

/// A shape in words.
fn shape(own: &Shape) -> String {
    let degrees = |form, angle: f64| words(form).text("angle", decimal(angle));
    match own {
        Shape::Flat => words("shape-flat"),
        Shape::Ball => words("shape-ball"),
        Shape::BullNose { corner } => words("shape-bull-nose").text("corner", decimal(*corner)),
        Shape::Drill { point } => degrees("shape-drill", *point),
        Shape::Chamfer { angle, .. } => degrees("shape-chamfer", *angle),
        Shape::Taper { angle, .. } => degrees("shape-taper", *angle),
        Shape::Profile(_) => words("shape-profile"),
        Shape::Lollipop => words("shape-lollipop"),
        Shape::TSlot => words("shape-t-slot"),
    }
    .headline()
}

/// What a simulation assumes besides what the times do: a line each.
pub fn assumptions(path: &Path, tables: &Tables, course: &Course) -> Vec<String> {
    let mut lines = Vec::new();
    if !course.as_programmed.is_empty() {
        lines.push(words("contours").headline());
    }
    if path.has_unknown_heights {
        lines.push(words("heights").headline());
    }
    if !path.tilts.is_empty() {
        lines.push(words("after-planes").headline());
    }
    if path.straightened {
        lines.push(words("straightened").headline());
    }
    let unstated = path.offsets.iter().filter(|offset| !tables.work_offsets.contains_key(offset));
    let names: Vec<_> = unstated.map(ToString::to_string).collect();
    if names.len() > 1 {
        lines.push(words("offsets").text("offsets", names.join(", ")).headline());
    }
    lines
}

/// Where what is known of a tool comes from.
fn known(own: &Fitted) -> String {
    let known = match own.known {
        Known::Stated => words("stated"),
        Known::Profile => words("profile"),
        Known::Comment(line) => words("comment").text("line", line.to_string()),
        Known::Guess => return words("guess").headline(),
    };
    match own.shape_guessed {
        true => words("shape-guessed").text("known", known.headline()).headline(),
        false => known.headline(),
    }
}

/// The names of the tools, and what each is and did.
fn tool_rows(cut: &CutProgram) -> Vec<(String, String)> {
    let row = |((used, own), worked): ((&Used, &Fitted), &Worked)| {
        let line = words("worked")
            .text("volume", decimal(worked.volume))
            .text("time", duration::hms(worked.cutting))
            .text("shape", shape(&own.shape))
            .text("diameter", decimal(own.diameter))
            .text("known", known(own));
        (tool(used.number), line.headline())
    };
    cut.path.tools.iter().zip(&cut.tools).zip(&cut.worked).map(row).collect()
}

/// Writes the account of a simulation.
///
/// # Errors
/// Writing.
pub fn write_account(
    out: &mut dyn io::Write,
    cut: &CutProgram,
    program: &str,
    dialect: &str,
) -> io::Result<()> {
    let of = words("of").text("program", program).text("dialect", dialect);
    writeln!(out, "{}", of.count("alarms", cut.alarms().len() as u64).headline())?;
    let setup = cut.simulation.setup();
    let mut rows = vec![
        (words("raw").headline(), raw_headline(cut)),
        (words("time").headline(), duration::hms(cut.path.end)),
    ];
    let tilts = setup.tilts.len() as u64;
    if tilts > 0 {
        let text = words("planes-tilted").count("planes", tilts).headline();
        rows.push((words("planes").headline(), text));
    }
    rows.extend(tool_rows(cut));
    let all = setup.stock.volume(setup.cells);
    let removed = words("of-raw").text("volume", decimal(cut.volume())).text("all", decimal(all));
    rows.push((words("removed").headline(), removed.headline()));
    let under = cut.simulation.map().hollows_above(setup.stock.extent()[0][2]);
    if under > 0.0 {
        rows.push((
            words("under").headline(),
            words("under-volume").text("volume", decimal(under)).headline(),
        ));
    }
    let grid = cut.simulation.map().grid;
    let cells = words("grid")
        .text("columns", grid.cells[0].to_string())
        .text("rows", grid.cells[1].to_string())
        .text("cell", decimal(grid.cell));
    rows.push((words("cells").headline(), cells.headline()));
    if let Some((thin, cells)) = cut.coarse() {
        let names: Vec<_> = thin.into_iter().map(tool).collect();
        let coarse = words("coarse").text("tools", names.join(", ")).text("cells", cells.to_string());
        rows.push((words("coarse-name").headline(), coarse.headline()));
    }
    if cut.volume() == 0.0 {
        rows.push((words("untouched-name").headline(), words("untouched").headline()));
    }
    for (name, text) in rows {
        writeln!(out, "  {name:<12} {text}")?;
    }
    Ok(())
}

/// Writes what lies between two parts.
///
/// # Errors
/// Writing.
pub fn write_between(
    out: &mut dyn io::Write,
    between: &Between,
    names: [&str; 2],
    tolerance: f64,
) -> io::Result<()> {
    let name = words("between").headline();
    if between.is_within(tolerance) {
        let same = words("same").text("tolerance", decimal(tolerance));
        return writeln!(out, "{name}: {}", same.headline());
    }
    let differs = words("differs")
        .text("first", names[0])
        .text("second", names[1])
        .text("more", decimal(between.more))
        .text("less", decimal(between.less));
    writeln!(out, "{name}: {}", differs.headline())?;
    for (form, most) in [("above", between.highest), ("below", between.deepest)] {
        let Some((at, by)) = most else { continue };
        writeln!(out, "  {}", words(form).text("by", decimal(by)).text("place", place(&at)).headline())?;
    }
    Ok(())
}
