//! The document of what was found: made of both programs, field by field.

use std::io::{self, SeekFrom};

use ncc_dialects::Dialect;
use ncc_exec::verify::Difference;
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault, Gravity, ModeName, Verdict as Became};
use ncc_ir::expr::num::{Nanos, POW10};
use ncc_ir::source::Span;
use sha2::{Digest, Sha256};

use super::super::pair::{Found, Verdict, job_of};
use super::{
    Asked, Assumed, Call, Choice, Compared, Deviation, Document, First, Halves, Hashed, KIND, Mistake, One,
    Place, Program, Row, VERSION, Word, finer_note, verify,
};
use crate::render::events;
use crate::render::messages::words::Context;
use crate::render::report::hex;
use crate::render::{About, spelled, summary};
use crate::review::diff::motion::motion;
use crate::review::diff::tell::{Account, Block, Blocks};
use crate::review::diff::wording::entry;
use crate::side::Side;
use crate::source::Readable;
use crate::source::called_files::CalledFile;
use crate::verify_run::WORLDS;

/// Differences that are listed; further ones are counted.
const MOST: usize = 100;
/// Errors that are listed of a program; further ones are counted.
const MOST_ERRORS: usize = 100;

impl Document {
    /// Of what was found.
    ///
    /// # Errors
    /// Reading the programs.
    pub fn of(found: &Found, sides: &mut [Side; 2], call: &Call) -> io::Result<Document> {
        let job = job_of(sides);
        let programs = [program(0, found, sides, call)?, program(1, found, sides, call)?];
        let [source, output] = programs;
        let mut document = Document {
            kind: KIND.to_owned(),
            version: VERSION,
            ncc_version: env!("CARGO_PKG_VERSION").to_owned(),
            dictionaries: call.dictionaries.clone(),
            profiles: call.profiles.clone(),
            asked: Asked {
                tolerance_mm: call.tolerance.map(millimetres),
                start: job.start.map(|at| at.map(millimetres)),
            },
            compared: compared(found, sides),
            verdict: match found.verdict {
                Verdict::Equal => Word::Equal,
                Verdict::WithinTolerance => Word::EqualWithinTolerance,
                Verdict::Different => Word::Different,
                Verdict::NotCompared => Word::NotCompared,
            },
            summary: String::new(),
            largest_deviation: None,
            first_difference: None,
            differences: Vec::new(),
            differences_not_listed: 0,
            errors: Vec::new(),
            source,
            output,
        };
        if let Some(deviation) = &found.deviation {
            let [source, output] = places(sides, [Some(deviation.source), Some(deviation.target)])?;
            let axis = char::from(deviation.axis.letter()).to_string();
            document.largest_deviation =
                Some(Deviation { mm: millimetres(deviation.by), axis, source, output });
        }
        match &found.first {
            Some((difference, skip)) => document.differ(difference, *skip, sides, call)?,
            None => document.summary = document.without_difference(found),
        }
        for side in [0, 1] {
            let mistakes = mistakes(side, &mut sides[side], &found.courses[side].diagnostics)?;
            document.errors.extend(mistakes);
        }
        Ok(document)
    }

    /// The first difference, and all of them as they show in the terms of both programs.
    fn differ(
        &mut self,
        difference: &Difference,
        skip: u16,
        sides: &mut [Side; 2],
        call: &Call,
    ) -> io::Result<()> {
        let span = |event: &Option<ncc_exec::Event>| event.as_ref().map(|event| event.span);
        let [source, output] = places(sides, [span(&difference.source), span(&difference.target)])?;
        let text = events::describe(difference);
        self.first_difference = Some(First { text, block_skip: levels(skip), source, output });
        let account = Account::of(&motion(sides, call.tolerance)?, sides)?;
        let unsaid = self.output.unsaid.join(", ");
        self.summary = match (account.equal, unsaid.is_empty()) {
            (false, _) => account.summary.clone(),
            (true, false) => verify("output-unstated").text("facts", unsaid).headline(),
            (true, true) => verify("by-machine").headline(),
        };
        let place = |block: &Block| Place { line: block.line, text: block.text.clone() };
        let one = |d: &crate::review::diff::tell::Difference| One {
            kind: d.kind.to_owned(),
            title: d.title.clone(),
            block_skip: d.skip.clone(),
            paired: d.paired,
            source: d.blocks[0].iter().map(place).collect(),
            output: d.blocks[1].iter().map(place).collect(),
            further_places: d.more != [false; 2],
        };
        self.differences = account.differences.iter().take(MOST).map(one).collect();
        let listed = self.differences.len() as u64;
        self.differences_not_listed = account.differences.len() as u64 + account.left_out - listed;
        Ok(())
    }

    fn without_difference(&self, found: &Found) -> String {
        match found.verdict {
            Verdict::Equal | Verdict::WithinTolerance => entry("same-cut").headline(),
            Verdict::Different => String::new(),
            Verdict::NotCompared => {
                let form = match [0, 1].map(|side: usize| found.courses[side].refused) {
                    [true, true] => "both-unexecuted",
                    [false, true] => "output-unexecuted",
                    [true, false] | [false, false] => "source-unexecuted",
                };
                verify(form).headline()
            }
        }
    }
}

fn compared(found: &Found, sides: &[Side; 2]) -> Compared {
    let half = |digits: u8, inch: bool| {
        let unit = POW10[9 - digits.min(9) as usize];
        millimetres((if inch { unit * 254 / 10 } else { unit }) / 2)
    };
    let r = &found.resolution;
    let inch = found.inches;
    let mut notes = Vec::new();
    if found.muted {
        let without = sides.iter().find(|side| !side.dialect().caps.modes.messages);
        let id = without.map_or("", |side| side.dialect().id.as_str());
        notes.push(entry("mute-control").text("dialect", id).headline());
    }
    if found.coarse && found.verdict == Verdict::Equal {
        notes.push(finer_note());
    }
    if found.parameters {
        notes.push(verify("cycle-parameters").headline());
    }
    Compared {
        events: found.events,
        worlds: WORLDS,
        skip_settings: found.settings,
        skip_levels_sampled: found.sampled,
        resolution: Halves {
            mm: half(if inch { r.inch } else { r.mm }, inch),
            degrees: half(r.degree, false),
            feed: half(if inch { r.feed_inch } else { r.feed }, inch),
            seconds: half(r.second, false),
        },
        notes,
    }
}

/// A file of a called program.
fn called_file(file: &CalledFile) -> Hashed {
    let name = std::path::Path::new(&file.name).file_name();
    let name = name.map_or(file.name.clone(), |name| name.to_string_lossy().into_owned());
    Hashed { name, file: Some(file.name.clone()), sha256: hex(&file.sha256) }
}

fn program(side: usize, found: &Found, sides: &mut [Side; 2], call: &Call) -> io::Result<Program> {
    let (bytes, sha256) = match (&sides[side].source.called, found.courses[side].bytes) {
        (Some(called), _) => (called.bytes, hex(&called.sha256)),
        (None, Some((bytes, sha256))) => (bytes, hex(&sha256)),
        (None, None) => length_and_hash(&mut *sides[side].source.file)?,
    };
    let called = sides[side].source.called.iter().flat_map(|called| &called.files).map(called_file).collect();
    let (course, program) = (&found.courses[side], &sides[side]);
    let settings = &program.job.from;
    let choice =
        |name: &str| Choice { value: settings.get(name).to_owned(), chosen: settings.is_chosen(name) };
    let mut told = Told::default();
    for diagnostic in &course.diagnostics {
        told.take(diagnostic, settings.dialect, (side == 1).then_some(&found.shared));
    }
    Ok(Program {
        project: sides[side].job.project.as_deref().cloned(),
        file: call.files[side].clone(),
        bytes,
        sha256,
        called,
        blocks: course.blocks,
        dialect: settings.dialect.id.clone(),
        machine: call.machines[side].clone(),
        options: settings.dialect.option.iter().map(|o| (o.name.clone(), choice(&o.name))).collect(),
        assumed: told.assumed,
        unconfirmed: told.unconfirmed,
        shared: told.shared,
        unsaid: told.unsaid,
    })
}

/// What was assumed of a program, each thing once.
#[derive(Default)]
struct Told {
    assumed: Vec<Assumed>,
    unconfirmed: Vec<Row>,
    shared: Vec<String>,
    unsaid: Vec<String>,
}

impl Told {
    /// `shared` are the facts that hold of an output which does not say them; of a source, all do.
    fn take(&mut self, diagnostic: &Diagnostic, dialect: &Dialect, shared: Option<&Modes>) {
        let fault = &diagnostic.fault;
        if fault.gravity() != Gravity::Verdict(Became::Assumed) {
            return;
        }
        if let Fault::AssumedRow { code, meaning } = fault {
            match self.unconfirmed.iter_mut().find(|row| row.code == **code) {
                Some(row) => row.uses += 1,
                None => {
                    let (code, meaning) = (code.to_string(), meaning.to_string());
                    self.unconfirmed.push(Row { code, meaning, uses: 1 });
                }
            }
            return;
        }
        if let (Some(shared), Some(fact)) = (shared, fact(fault)) {
            let list = if holds(shared, fact) { &mut self.shared } else { &mut self.unsaid };
            let name = spelled::mode(fact);
            if !list.contains(&name) {
                list.push(name);
            }
            return;
        }
        let text =
            summary::phrase(fault, Context { from: dialect, to: dialect, snippet: "", beside: ("", "") });
        match self.assumed.iter_mut().find(|assumed| assumed.text == text) {
            Some(assumed) => assumed.uses += 1,
            None => self.assumed.push(Assumed { code: code(fault), text, uses: 1 }),
        }
    }
}

/// The fact at power-on that is assumed.
fn fact(fault: &Fault) -> Option<ModeName> {
    match fault {
        Fault::AssumedMode { fact, .. } => Some(*fact),
        Fault::AssumedWorkOffset { .. } => Some(ModeName::WorkOffset),
        _ => None,
    }
}

fn holds(facts: &Modes, fact: ModeName) -> bool {
    match fact {
        ModeName::Motion => facts.motion.is_some(),
        ModeName::Distance => facts.distance.is_some(),
        ModeName::Units => facts.units.is_some(),
        ModeName::Plane => facts.plane.is_some(),
        ModeName::FeedMode => facts.feed_mode.is_some(),
        ModeName::ReturnLevel => facts.return_level.is_some(),
        ModeName::WorkOffset => facts.work_offset.is_some(),
        ModeName::LengthOffset => facts.length_offset.is_some(),
        ModeName::OriginShift => facts.no_origin_shift.is_some(),
    }
}

/// The first errors of a program.
fn mistakes(side: usize, program: &mut Side, diagnostics: &[Diagnostic]) -> io::Result<Vec<Mistake>> {
    let errors = diagnostics.iter().filter(|d| d.fault.gravity() == Gravity::Error);
    let errors: Vec<&Diagnostic> = errors.take(MOST_ERRORS).collect();
    let name = program.source.shown.clone();
    let mut about = About { job: &program.job, name: &name, source: &mut program.source.file };
    let lines = about.lines(errors.iter().copied())?;
    let mut mistakes = Vec::new();
    for diagnostic in errors {
        let told = about.tell(&lines, diagnostic)?;
        mistakes.push(Mistake {
            program: ["source", "output"][side.min(1)].to_owned(),
            code: told.code,
            message: told.message,
            place: Place { line: told.place.start.0, text: told.place.text },
        });
    }
    Ok(mistakes)
}

/// The blocks of both sides.
fn places(sides: &mut [Side; 2], spans: [Option<Span>; 2]) -> io::Result<[Option<Place>; 2]> {
    let mut places = [None, None];
    for ((side, span), place) in sides.iter_mut().zip(spans).zip(&mut places) {
        let Some(span) = span else { continue };
        let blocks = Blocks::read(&mut side.source, vec![span.start])?;
        *place = blocks.get(span.start).map(|block| Place { line: block.line, text: block.text });
    }
    Ok(places)
}

fn code(fault: &Fault) -> String {
    format!("NC{:04}", fault.code())
}

fn levels(skip: u16) -> Vec<u8> {
    (1..16u8).filter(|level| skip >> level & 1 == 1).collect()
}

fn millimetres(nanos: Nanos) -> f64 {
    nanos as f64 / 1e9
}

/// Length and hash of a file.
///
/// # Errors
/// Reading it.
fn length_and_hash(file: &mut dyn Readable) -> io::Result<(u64, String)> {
    file.seek(SeekFrom::Start(0))?;
    let (mut hash, mut bytes) = (Sha256::new(), 0);
    let mut piece = vec![0; 1 << 16];
    loop {
        match file.read(&mut piece)? {
            0 => return Ok((bytes, hex(&hash.finalize()))),
            n => {
                hash.update(&piece[..n]);
                bytes += n as u64;
            }
        }
    }
}
