//! Requests about the part: the moves of a program, the part that it cuts, and that part after any move.
//!
//! The program that was cut last is kept, so that going to another moment is no new work; and one whose moves were asked for, so
//! that it is executed once.

use std::collections::BTreeMap;
use std::io::{self, Write as _};

use codespan_reporting::term::termcolor::Buffer;
use ncc_driver::problem::{Exit, Problem, RequestFault};
use ncc_driver::render::{About, Loudness, Told, human};
use ncc_driver::side::Side;
use ncc_driver::simulate::compare::{Between, TOLERANCE};
use ncc_driver::simulate::cut::{Bench, CutProgram, cut};
use ncc_driver::simulate::described::Described;
use ncc_driver::simulate::modes::Watched;
use ncc_driver::simulate::path::Path;
use ncc_driver::simulate::surroundings::Surroundings;
use ncc_driver::simulate::tooling::Fitted;
use ncc_driver::simulate::{columns, document, files as parts, raw, told, tooling};
use ncc_driver::source::Source;
use ncc_driver::time::assumed;
use ncc_driver::time::drive::{Unwatched, drive};
use ncc_machines::Profile;
use ncc_machines::project::Programs;
#[cfg(not(target_arch = "wasm32"))]
use ncc_simulate::Look;
use ncc_simulate::{Face, Fixture, Stock, covered, faces};
use ncc_time::Model;

use crate::colours::Coloured;
use crate::program::{Files, Outputs, is_given, machine_of, plan, row, side, warn};
#[cfg(not(target_arch = "wasm32"))]
use crate::request::drawn::{Form, Picture, View};
use crate::request::{One, Seek, Simulate};

/// Pixels along the longer side of a picture.
#[cfg(not(target_arch = "wasm32"))]
const PIXELS: usize = 1200;

/// Programs that are kept from one request to the next.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    /// The one that was cut last.
    cut: Option<Box<CutProgram>>,
    /// The one whose moves were asked for last, with the report of its execution; forgotten when a file changes.
    executed: Option<Box<(One, Executed, Vec<u8>)>>,
    /// The one that was coloured last.
    pub(crate) coloured: Option<Coloured>,
}

impl Kept {
    /// Files, or dialects, are no longer those that a program was executed with.
    pub(crate) fn forget_moves(&mut self) {
        self.executed = None;
    }

    fn cut(&self) -> Result<&CutProgram, RequestFault> {
        self.cut.as_deref().ok_or(RequestFault::NothingCut)
    }
}

/// A program that was cut.
struct Done {
    file: String,
    cut: CutProgram,
    alarms: Vec<Told>,
    dialect: String,
    assumed: Vec<String>,
    around: Surroundings,
}

impl Done {
    /// Its row of the document.
    fn row(&self) -> (document::About<'_>, &CutProgram, &[Told]) {
        let about = document::About {
            source: &self.file,
            dialect: &self.dialect,
            assumed: &self.assumed,
            around: &self.around,
        };
        (about, &self.cut, &self.alarms)
    }
}

/// A program that was executed.
#[derive(Debug)]
struct Executed {
    path: Path,
    /// Its modes as columns.
    modes: Vec<u8>,
    source: Source,
    dialect: String,
    profile: Option<std::sync::Arc<Profile>>,
    assumed: Vec<String>,
    around: Surroundings,
}

/// Executes a program; `None` where it was refused, which has been reported.
fn execute(one: &One, files: &Files, messages: &mut Buffer) -> Result<Option<Executed>, Problem> {
    let cannot = |e: io::Error| Problem::file("time", &one.file, &e);
    let profile = machine_of(one, files)?;
    let Side { mut source, job } = side(one, files, messages)?;
    let (plan, unstated) = plan(&job, profile.as_deref(), Model::default());
    let mut recorder = Watched::new(&plan).at_most(one.most_moves);
    let course = drive(&plan, &mut source, &mut recorder, &mut Unwatched).map_err(cannot)?;
    let shown = source.shown.clone();
    let mut about = About { job: &job, name: &shown, source: &mut source.file };
    human::print(messages, &mut about, &course.diagnostics, Loudness::Usual).map_err(cannot)?;
    if course.refused {
        return Ok(None);
    }
    let mut modes = Vec::new();
    let path = recorder.finish(&mut modes).map_err(cannot)?;
    let mut assumed: Vec<String> = profile.as_deref().map(assumed::of_profile).unwrap_or_default();
    assumed.extend(assumed::of_machine(&plan, &unstated, &course));
    assumed.extend(assumed::of_run(&plan, &course));
    assumed.extend(assumed::of_program(&job, &course.diagnostics));
    assumed.extend(told::assumptions(&path, &plan.tables, &course));
    let around = Surroundings::of(&path, job.from.dialect, profile.as_deref());
    let dialect = job.from.dialect.id.clone();
    Ok(Some(Executed { path, modes, source, dialect, profile, assumed, around }))
}

/// A program of which the zero is stated, with the work offset that this is of: a run tells it.
pub(crate) fn with_datum(one: One, files: &Files) -> Result<One, Problem> {
    if one.zero.is_none() {
        return Ok(one);
    }
    let executed = execute(&one, files, &mut Buffer::no_color())?;
    let datum = executed.and_then(|own| own.path.offsets.get(own.path.datum).copied());
    Ok(One { datum: datum.map(u32::from), ..one })
}

fn moves(path: &Path) -> Result<Vec<u8>, Problem> {
    let mut bytes = Vec::new();
    columns::write(&mut bytes, path).map_err(|e| Problem::file("write", "the moves", &e))?;
    Ok(bytes)
}

/// The moves of a program.
pub(crate) fn path(
    one: &One,
    files: &Files,
    kept: &mut Kept,
    messages: &mut Buffer,
) -> Result<(Exit, Outputs), Problem> {
    kept.forget_moves();
    let mut report = Buffer::no_color();
    let executed = execute(&with_datum(one.clone(), files)?, files, &mut report);
    // A buffer in memory takes all that is written.
    let _ = messages.write_all(report.as_slice());
    let Some(executed) = executed? else { return Ok((Exit::Refused, Vec::new())) };
    let outputs = vec![("path", moves(&executed.path)?), ("modes", executed.modes.clone())];
    kept.executed = Some(Box::new((one.clone(), executed, report.into_inner())));
    Ok((Exit::Done, outputs))
}

/// Executes a program, unless its moves were asked for just before; `None` where it was refused, which has been reported.
fn executed(
    one: &One,
    files: &Files,
    kept: &mut Kept,
    messages: &mut Buffer,
) -> Result<Option<Executed>, Problem> {
    match kept.executed.take().map(|own| *own) {
        Some((own, executed, report)) if own == *one => {
            let _ = messages.write_all(&report);
            Ok(Some(executed))
        }
        _ => execute(&with_datum(one.clone(), files)?, files, messages),
    }
}

/// A body as it is stated; a file is one of the engine's.
fn body(text: &str, files: &Files) -> Result<Stock, Problem> {
    let wrong = || Problem::from(RequestFault::Body(text.to_owned()));
    match raw::stated(text).map_err(|_| wrong())? {
        raw::Stated::Shape(stock) => Ok(stock),
        raw::Stated::File(name) => {
            let bytes = files
                .get(&name)
                .ok_or_else(|| Problem::file("read", &name, &io::ErrorKind::NotFound.into()))?;
            let read = parts::read_stl(bytes).map_err(|e| Problem::file("read", &name, &e))?;
            raw::body(read).ok_or_else(wrong)
        }
    }
}

/// A body of a row of a project file; none where its file is not at hand, which has been reported.
fn stated_body(text: &str, files: &Files, messages: &mut Buffer) -> Result<Option<Stock>, Problem> {
    match raw::stated(text) {
        Ok(raw::Stated::File(name)) if !is_given(&name, files) => warn(&name, messages).map(|()| None),
        Ok(_) | Err(_) => body(text, files).map(Some),
    }
}

/// The raw part and what holds it: those of the request, or else those of a row of the project file.
fn bench(
    asked: &Simulate,
    row: Option<&Programs>,
    files: &Files,
    messages: &mut Buffer,
) -> Result<Bench, Problem> {
    let stock = match (&asked.stock, row.and_then(|row| row.stock.as_ref())) {
        (Some(text), _) => Some(body(text, files)?),
        (None, Some(text)) => stated_body(text.get_ref(), files, messages)?,
        (None, None) => None,
    };
    let mut fixtures = Vec::new();
    for text in &asked.fixtures {
        fixtures.push(Fixture { name: text.clone(), shape: body(text, files)? });
    }
    for text in row.filter(|_| asked.fixtures.is_empty()).into_iter().flat_map(|row| &row.fixtures) {
        let shape = stated_body(text.get_ref(), files, messages)?;
        fixtures.extend(shape.map(|shape| Fixture { name: text.get_ref().clone(), shape }));
    }
    Ok(Bench {
        guessed: stock.is_none(),
        stock,
        fixtures,
        table: asked.table.or(row.and_then(|row| row.table.as_ref()).map(|table| *table.get_ref())),
        cells: asked.cells.clamp(16, 8192),
    })
}

/// Cuts a program.
pub(crate) fn simulate(
    asked: &Simulate,
    files: &Files,
    kept: &mut Kept,
    messages: &mut Buffer,
) -> Result<(Exit, Outputs), Problem> {
    kept.cut = None;
    let read = |text: &String| tooling::stated(text).map_err(|_| RequestFault::Tool(text.clone()));
    let stated = asked.tools.iter().map(read).collect::<Result<BTreeMap<_, _>, _>>()?;
    let row = row(asked.project.as_deref(), &asked.file, files)?;
    let bench = bench(asked, row.as_ref(), files, messages)?;
    let one = asked.one();
    let Some(mut executed) = executed(&one, files, kept, messages)? else {
        return Ok((Exit::Refused, Vec::new()));
    };
    let (path, modes) = (moves(&executed.path)?, std::mem::take(&mut executed.modes));
    let fitted = tooling::tools(&executed.path, &stated, executed.profile.as_deref())
        .map_err(|fault| told::no_cutter(&fault))?;
    let Some(done) = carry_out(&one, executed, fitted, bench.clone(), messages)? else {
        // Its way can be drawn all the same.
        return Ok((Exit::Refused, vec![("path", path), ("modes", modes)]));
    };
    let mut all = vec![done];
    if let Some(other) = &asked.compare {
        let Some(other) = held_against(other, &all[0], &stated, bench, files, messages)? else {
            return Ok((Exit::Refused, vec![("path", path), ("modes", modes)]));
        };
        all.push(other);
    }
    let between = all.get(1).map(|other| {
        let (own, floor) = (all[0].cut.simulation.map(), parts::floor(&all[0].cut));
        Between::of(own, other.cut.simulation.map(), floor)
    });
    let programs: Vec<_> = all.iter().map(Done::row).collect();
    let mut document = Vec::new();
    document::write(&mut document, &programs, between.map(|between| (between, TOLERANCE)))
        .map_err(|e| Problem::file("write", "the document", &e))?;
    let is_same = between.is_none_or(|between| between.is_within(TOLERANCE));
    let is_sound = is_same && !all.iter().any(|done| done.cut.has_sure_alarms());
    let done = all.swap_remove(0).cut;
    let mut outputs = vec![("document", document), ("path", path), ("modes", modes)];
    outputs.extend(part(&done));
    kept.cut = Some(Box::new(done));
    Ok((if is_sound { Exit::Done } else { Exit::Refused }, outputs))
}

/// Cuts a program that was executed and tells its alarms; `None` where it was refused, which has been reported.
fn carry_out(
    one: &One,
    mut executed: Executed,
    fitted: Vec<Fitted>,
    bench: Bench,
    messages: &mut Buffer,
) -> Result<Option<Done>, Problem> {
    let cannot = |e: io::Error| Problem::file("read", &one.file, &e);
    let cut = match cut(executed.path, fitted, bench) {
        Ok(cut) => cut,
        Err(uncut) => {
            return match told::write_refusal(messages, uncut, &mut executed.source).map_err(cannot)? {
                Some(problem) => Err(problem),
                None => Ok(None),
            };
        }
    };
    let (alarms, lines) = told::alarms(&cut, &mut executed.source).map_err(cannot)?;
    told::write_alarms(messages, &alarms, &lines, Loudness::Usual).map_err(cannot)?;
    let Executed { dialect, assumed, around, .. } = executed;
    Ok(Some(Done { file: one.file.clone(), cut, alarms, dialect, assumed, around }))
}

/// Cuts the other program from the same raw part, with the same tools: guesses too, so that only the ways differ.
fn held_against(
    one: &One,
    done: &Done,
    stated: &BTreeMap<i64, Described>,
    bench: Bench,
    files: &Files,
    messages: &mut Buffer,
) -> Result<Option<Done>, Problem> {
    let Some(executed) = execute(one, files, messages)? else { return Ok(None) };
    let fitted = tooling::tools(&executed.path, stated, executed.profile.as_deref())
        .map_err(|fault| told::no_cutter(&fault))?;
    let fitted = done.cut.shared_tools(&executed.path, fitted);
    let stock = Some(done.cut.simulation.setup().stock.clone());
    carry_out(one, executed, fitted, Bench { stock, ..bench }, messages)
}

/// A part as numbers: heights in mm, and the number of the move that cut last, of each cell; little-endian.
///
/// Of a part with hollows, too: `hollows`, sixteen bytes each: the cell, the move that cut last there, the lower and the upper end; `covered`, one byte a
/// cell, 1 where `faces` have the surface; `faces`, sixteen bytes each: the cell, the side and 256 times the length, from and to
/// which height.
fn part(cut: &CutProgram) -> Outputs {
    let map = cut.simulation.map();
    let grid = map.grid;
    // Rows of the page follow each other, without what lies between them in a map.
    let number = |cell: usize| {
        let [column, row] = grid.place(cell);
        (row * grid.cells[0] + column) as u32
    };
    let heights = bytes(grid.cells, grid.rows().map(|row| &map.heights[row]), |own| own.to_le_bytes());
    let last = bytes(grid.cells, grid.rows().map(|row| &map.last[row]), |own| own.to_le_bytes());
    let mut outputs = vec![("heights", heights), ("last", last)];
    let covered = covered(map);
    if !covered.is_empty() {
        let all = map.hollows.iter().flat_map(|(cell, own)| own.iter().map(move |ends| (cell, *ends)));
        outputs.push((
            "hollows",
            all.flat_map(|(cell, ends)| words([number(cell), map.hollows.last(cell)], ends)).collect(),
        ));
        let of = |face: &Face| {
            let kind = u32::from(face.length) << 8 | face.side as u32;
            words([number(face.cell as usize), kind], face.between)
        };
        outputs.push(("faces", faces(map, &covered, parts::floor(cut)).iter().flat_map(of).collect()));
        let rows = grid.rows().flat_map(|row| &covered[row]);
        outputs.push(("covered", rows.map(|own| u8::from(*own)).collect()));
    }
    outputs
}

/// The bytes of the numbers in rows, little-endian by `bytes_of`. Row by row: parts have a million cells.
fn bytes<'m, T: Copy + 'm>(
    [columns, rows]: [usize; 2],
    all: impl Iterator<Item = &'m [T]>,
    bytes_of: impl Fn(T) -> [u8; 4],
) -> Vec<u8> {
    let mut bytes = vec![0; 4 * columns * rows];
    for (places, row) in bytes.as_chunks_mut().0.chunks_mut(columns).zip(all) {
        places.iter_mut().zip(row).for_each(|(place, own)| *place = bytes_of(*own));
    }
    bytes
}

fn words([a, b]: [u32; 2], [low, high]: [f32; 2]) -> impl Iterator<Item = u8> {
    [a, b, low.to_bits(), high.to_bits()].into_iter().flat_map(u32::to_le_bytes)
}

/// Shows the part after so many moves.
pub(crate) fn seek(asked: Seek, kept: &mut Kept) -> Result<(Exit, Outputs), Problem> {
    let cut = kept.cut.as_mut().ok_or(RequestFault::NothingCut)?;
    cut.simulation.seek(asked.moves);
    Ok((Exit::Done, part(cut)))
}

/// The part that is shown, as a body of triangles.
pub(crate) fn stl(kept: &Kept) -> Result<(Exit, Outputs), Problem> {
    let cut = kept.cut()?;
    let bytes = parts::stl(cut.simulation.map(), parts::floor(cut));
    let bytes = bytes.map_err(|e| Problem::file("write", "the part", &e))?;
    Ok((Exit::Done, vec![("stl", bytes)]))
}

/// A picture of the part that is shown.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn picture(asked: &Picture, kept: &Kept) -> Result<(Exit, Outputs), Problem> {
    let cut = kept.cut()?;
    let drawn = match (asked.form, asked.view) {
        (Form::Svg, _) => parts::svg(cut, &asked.title).map(String::into_bytes),
        (Form::Png, View::Plan) => parts::png(&parts::picture(cut, Look::Plan, PIXELS)),
        (Form::Png, View::Corner) => parts::png(&parts::picture(cut, Look::Corner, PIXELS)),
    };
    let drawn = drawn.map_err(|e| Problem::file("write", "the picture", &e))?;
    Ok((Exit::Done, vec![("picture", drawn)]))
}
