//! `ncc simulate`: the part as a program cuts it, what each tool removes, and what must not happen.
//!
//! A program goes through the pipeline of `ncc time` into a list of moves, which are cut out of the raw part. Not here:
//! stock removal (ncc-simulate), tools, guesses and words (`ncc_driver::simulate`), timing (`time`).
//!
//! ```text
//! ncc simulate part.nc --stock "X0:100 Y0:60 Z-20:0" --png part.png
//! ```

pub mod args;

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::Path;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::job::Output;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::render::{Loudness, Told};
use ncc_driver::simulate::compare::Between;
use ncc_driver::simulate::cut::{Bench, CutProgram, cut};
use ncc_driver::simulate::document::{self, About};
use ncc_driver::simulate::path::Recorder;
use ncc_driver::simulate::surroundings::Surroundings;
use ncc_driver::simulate::{files as parts, raw, told, tooling};
use ncc_driver::source::Source;
use ncc_simulate::{Fixture, HeightMap, Look, Stock};

use self::args::{Moment, Simulate, ViewName};
use crate::files::{self, Destination};
use crate::milling::{self, Voice};
use crate::project;
use crate::registry::DialectRegistry;
use crate::time::{self, Shop, args::Time};

/// A program that was cut, and its report.
struct Done {
    cut: CutProgram,
    source: Source,
    dialect: String,
    assumed: Vec<String>,
    around: Surroundings,
}

/// Runs the verb.
///
/// # Errors
/// Wrong usage, a file that cannot be read or written, or a program that cannot be cut. What is wrong with a program is reported
/// on `err`.
pub(crate) fn run(
    args: &Simulate,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    if args.schema {
        files::to_stdout(&mut |out| out.write_all(document::SCHEMA.as_bytes()))?;
        return Ok(Exit::Done);
    }
    let Some(file) = &args.file else { return Ok(Exit::Usage) };
    let outputs = outputs(args)?;
    let set_up = SetUp::of(args, file, known, err)?;
    guard(args, file, &set_up)?;
    let bench = Bench {
        guessed: set_up.stock.is_none(),
        stock: set_up.stock.as_ref().map(body).transpose()?,
        fixtures: set_up.fixtures.iter().map(fixture).collect::<Result<_, _>>()?,
        table: set_up.table,
        cells: usize::from(args.cells),
    };
    let should = args.against.as_deref().map(triangles).transpose()?;
    let Some(mut done) = carry_out(args, file, bench.clone(), None, known, err)? else {
        return Ok(Exit::Refused);
    };
    let other = match &args.compare {
        None => None,
        Some(other) => {
            // The same raw part, a guess too.
            let stock = Some(done.cut.simulation.setup().stock.clone());
            let Some(other) = carry_out(args, other, Bench { stock, ..bench }, Some(&done.cut), known, err)?
            else {
                return Ok(Exit::Refused);
            };
            Some(other)
        }
    };
    if let Some(moment) = args.at {
        let moves = match moment {
            Moment::Line(line) => done.cut.moves_behind_line(line),
            Moment::Time(time) => done.cut.moves_at(time),
        };
        done.cut.simulation.seek(moves);
    }
    let between = held_against(args, &done, other.as_ref(), should)?;
    for (what, destination) in &outputs {
        let bytes = written(*what, args, &done).map_err(|e| Problem::file("write", "the part", &e))?;
        let mut output = Output::new();
        output.push(&bytes).map_err(|e| Problem::file("write", "the part", &e))?;
        destination.release(&mut output)?;
    }
    account(args, done, other, between, err)
}

/// What is on the machine, as the call states it, and else the project file of the program.
struct SetUp {
    stock: Option<raw::Stated>,
    fixtures: Vec<raw::Stated>,
    table: Option<f64>,
}

impl SetUp {
    fn of(
        args: &Simulate,
        file: &Path,
        known: &DialectRegistry,
        err: &mut dyn WriteColor,
    ) -> Result<SetUp, Problem> {
        let mut own = SetUp { stock: args.stock.clone(), fixtures: args.fixture.clone(), table: args.table };
        let Some(row) = project::row(file, false, known, err)? else { return Ok(own) };
        let mut note = |option: &str, is_stated: bool, key: &str, value: String, line: usize| {
            if !args.telling.quiet {
                // What cannot be reported changes nothing about what is done.
                let _ = match is_stated {
                    true => writeln!(err, "{}", project::goes_before(option, &row, key, &value, line)),
                    false => writeln!(err, "{}: {}:{line}: {key} = {value}", file.display(), row.file.shown),
                };
            }
        };
        if let Some(stock) = &row.stock {
            note("--stock", own.stock.is_some(), "stock", stock.value.0.clone(), stock.line);
            own.stock.get_or_insert_with(|| stock.value.1.clone());
        }
        let stated = !own.fixtures.is_empty();
        for fixture in &row.fixtures {
            note("--fixture", stated, "fixtures", fixture.value.0.clone(), fixture.line);
            if !stated {
                own.fixtures.push(fixture.value.1.clone());
            }
        }
        if let Some(table) = &row.table {
            note("--table", own.table.is_some(), "table", table.value.to_string(), table.line);
            own.table.get_or_insert(table.value);
        }
        Ok(own)
    }
}

/// Files that are read are not written over, and none is written twice.
fn guard(args: &Simulate, file: &Path, set_up: &SetUp) -> Result<(), Problem> {
    let bodies = set_up.stock.iter().chain(&set_up.fixtures).filter_map(|body| match body {
        raw::Stated::File(name) => Some(Path::new(name)),
        raw::Stated::Shape(_) => None,
    });
    let programs = [Some(file), args.compare.as_deref(), args.against.as_deref()].into_iter().flatten();
    let read: Vec<&Path> = programs.chain(bodies).collect();
    let written: Vec<&Path> =
        [&args.png, &args.svg, &args.stl].into_iter().flatten().map(|name| name.as_path()).collect();
    for (n, own) in written.iter().enumerate().filter(|(_, own)| **own != Path::new("-")) {
        let is_own = |other: &&Path| same_file::is_same_file(own, other).unwrap_or(false);
        if let Some(other) = read.iter().find(|other| is_own(other)) {
            return Err(Problem::usage(
                format!("{} would be written over {}", own.display(), other.display()),
                "name another file for the output",
            ));
        }
        if written[..n].iter().any(|other| other == own || is_own(other)) {
            return Err(Problem::usage(
                format!("{} would be written twice", own.display()),
                "name a file for each output",
            ));
        }
    }
    Ok(())
}

/// What is written to a file.
#[derive(Clone, Copy, PartialEq, Eq)]
enum What {
    Png,
    Svg,
    Stl,
}

/// The files that are written; one of them may be stdout.
fn outputs(args: &Simulate) -> Result<Vec<(What, Destination)>, Problem> {
    let all = [(What::Png, &args.png), (What::Svg, &args.svg), (What::Stl, &args.stl)];
    let mut outputs = Vec::new();
    for (what, name) in all.into_iter().filter_map(|(what, name)| Some((what, name.as_ref()?))) {
        let destination = match name.as_path() == Path::new("-") {
            true => Destination::Stdout,
            false => Destination::File(name.clone()),
        };
        destination.check()?;
        outputs.push((what, destination));
    }
    let to_stdout = outputs.iter().filter(|(_, to)| matches!(to, Destination::Stdout)).count();
    if to_stdout + usize::from(args.json) > 1 {
        return Err(Problem::usage("two outputs to stdout", "name a file for each but one"));
    }
    Ok(outputs)
}

fn body(stated: &raw::Stated) -> Result<Stock, Problem> {
    match stated {
        raw::Stated::Shape(stock) => Ok(stock.clone()),
        raw::Stated::File(name) => triangles(Path::new(name)),
    }
}

fn fixture(stated: &raw::Stated) -> Result<Fixture, Problem> {
    let name = match stated {
        raw::Stated::Shape(_) => String::new(),
        raw::Stated::File(name) => name.clone(),
    };
    Ok(Fixture { name, shape: body(stated)? })
}

fn triangles(path: &Path) -> Result<Stock, Problem> {
    let shown = path.display().to_string();
    let bytes = fs::read(path).map_err(|e| Problem::file("read", &shown, &e))?;
    let no_body = || Problem {
        exit: Exit::File,
        message: format!("{shown} is no body: no STL, cut off, or without a volume"),
        help: vec!["it needs triangles around a volume, in mm".to_owned()],
    };
    raw::body(parts::read_stl(&bytes).map_err(|_| no_body())?).ok_or_else(no_body)
}

/// Executes a program and cuts it, after the first one where it is compared with that; `None` where it was refused, which has
/// been reported.
fn carry_out(
    args: &Simulate,
    file: &Path,
    bench: Bench,
    first: Option<&CutProgram>,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Option<Done>, Problem> {
    let compared = first.is_some();
    let voice = if args.telling.quiet { Voice::Quiet } else { Voice::Human };
    let mut source = milling::open(file, voice, known, err)?;
    let mut asked: Time = args.timed(compared);
    let own = time::settle(&asked, file, &mut source, known, err)?;
    if own.is_some() && (compared || args.from.is_none()) {
        asked.reading.from = None;
    }
    let shop = Shop::of(&asked, own.as_ref().map(|(profile, _)| &**profile), known, err)?;
    let job = time::job(&asked, &shop, known, &mut source, err)?;
    // The tool goes along the contour that the program says, beside it where its radius is known.
    let plan = time::plan(&asked, &shop, &job);
    let starts = args.setting.standing.start.is_some_and(|start| start[2].is_some());
    let mut recorder = Recorder::new(&plan.tables, starts);
    let course = time::execute(&asked, &plan, known, &mut source, &mut recorder, err)?;
    if course.refused {
        return Ok(None);
    }
    let path = recorder.finish();
    let mut assumed = time::assumptions(&shop, &plan, &course);
    assumed.extend(told::assumptions(&path, &plan.tables, &course));
    let stated: BTreeMap<_, _> = args.tool.iter().cloned().collect();
    if stated.len() < args.tool.len() {
        return Err(Problem::usage("a tool is stated twice", "state each tool once"));
    }
    let unused: Vec<i64> = tooling::unused(&path, &stated).collect();
    // The program that is compared may be one with fewer tools.
    if !unused.is_empty() && !compared {
        return Err(told::no_tool(&path, &unused));
    }
    let tools =
        tooling::tools(&path, &stated, shop.profile.as_ref()).map_err(|fault| told::no_cutter(&fault))?;
    let tools = match first {
        Some(first) => first.shared_tools(&path, tools),
        None => tools,
    };
    let around = Surroundings::of(&path, job.from.dialect, shop.profile.as_ref());
    let dialect = job.from.dialect.id.clone();
    match cut(path, tools, bench) {
        Ok(cut) => Ok(Some(Done { cut, source, dialect, assumed, around })),
        Err(uncut) => {
            let shown = source.shown.clone();
            match told::write_refusal(err, uncut, &mut source)
                .map_err(|e| Problem::file("read", &shown, &e))?
            {
                Some(problem) => Err(problem),
                None => Ok(None),
            }
        }
    }
}

/// What lies between the part and another one.
fn held_against(
    args: &Simulate,
    done: &Done,
    other: Option<&Done>,
    should: Option<Stock>,
) -> Result<Option<(Between, String)>, Problem> {
    let (map, floor) = (done.cut.simulation.map(), parts::floor(&done.cut));
    if let Some(other) = other {
        return Ok(Some((Between::of(map, other.cut.simulation.map(), floor), other.source.shown.clone())));
    }
    let Some(should) = should else { return Ok(None) };
    let mut drawn = HeightMap::flat(map.grid, HeightMap::NOTHING);
    should.put_on(&mut drawn);
    let name = args.against.as_ref().map(|name| name.display().to_string()).unwrap_or_default();
    Ok(Some((Between::of(map, &drawn, floor), name)))
}

/// Pixels along the longer side of a picture.
const PIXELS: usize = 1200;

fn written(what: What, args: &Simulate, done: &Done) -> std::io::Result<Vec<u8>> {
    let cut = &done.cut;
    match what {
        What::Png => parts::png(&parts::picture(cut, args.view.map_or(Look::Corner, ViewName::look), PIXELS)),
        What::Svg => Ok(parts::svg(cut, &done.source.shown)?.into_bytes()),
        What::Stl => parts::stl(cut.simulation.map(), parts::floor(cut)),
    }
}

/// Tells what was found; gives the exit code.
fn account(
    args: &Simulate,
    mut done: Done,
    mut other: Option<Done>,
    between: Option<(Between, String)>,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    let loudness = args.telling.loudness();
    let tolerance = args.tolerance();
    let mut exit = Exit::Done;
    let mut all: Vec<Vec<Told>> = Vec::new();
    for own in std::iter::once(&mut done).chain(other.as_mut()) {
        let shown = own.source.shown.clone();
        let cannot = |e: std::io::Error| Problem::file("read", &shown, &e);
        let (alarms, lines) = told::alarms(&own.cut, &mut own.source).map_err(cannot)?;
        told::write_alarms(err, &alarms, &lines, loudness).map_err(cannot)?;
        if own.cut.has_sure_alarms() {
            exit = Exit::Refused;
        }
        all.push(alarms);
    }
    if between.as_ref().is_some_and(|(between, _)| !between.is_within(tolerance)) {
        exit = Exit::Refused;
    }
    let programs: Vec<&Done> = std::iter::once(&done).chain(other.as_ref()).collect();
    let write = &mut |out: &mut dyn Write| {
        if args.json {
            let rows: Vec<_> = programs
                .iter()
                .zip(&all)
                .map(|(own, told)| {
                    let about = About {
                        source: &own.source.shown,
                        dialect: &own.dialect,
                        assumed: &own.assumed,
                        around: &own.around,
                    };
                    (about, &own.cut, told.as_slice())
                })
                .collect();
            return document::write(out, &rows, between.as_ref().map(|(between, _)| (*between, tolerance)));
        }
        for own in &programs {
            told::write_account(out, &own.cut, &own.source.shown, &own.dialect)?;
            for (n, line) in own.assumed.iter().enumerate() {
                writeln!(out, "  {:<12} {line}", if n == 0 { "assumed" } else { "" })?;
            }
        }
        match &between {
            Some((between, name)) => {
                told::write_between(out, between, [&programs[0].source.shown, name], tolerance)
            }
            None => Ok(()),
        }
    };
    if args.json || loudness != Loudness::Quiet {
        let beside = [&args.png, &args.svg, &args.stl]
            .into_iter()
            .flatten()
            .any(|name| name.as_path() == Path::new("-"));
        match beside {
            // The part itself goes to stdout.
            true => write(err).map_err(|e| Problem::file("write", "the account", &e))?,
            false => files::to_stdout(write)?,
        }
    }
    Ok(exit)
}
