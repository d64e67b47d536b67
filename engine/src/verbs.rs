//! Requests done: each verb is a few calls of the driver, and outputs by name.

use std::io;
use std::path::PathBuf;

use codespan_reporting::term::termcolor::Buffer;
use ncc_backends::Layout;
use ncc_driver::check::{self, told};
use ncc_driver::guess::recognise;
use ncc_driver::job::initial_variables::{self, InitialVariables};
use ncc_driver::job::options::choose;
use ncc_driver::job::{Job, file_per_tool};
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::{Exit, Problem, RequestFault};
use ncc_driver::provenance::pairs::pairs as line_pairs;
use ncc_driver::provenance::trace::Asked;
use ncc_driver::questions::Policy;
use ncc_driver::render::{About, explain, report, tell};
use ncc_driver::render::{Loudness, human};
use ncc_driver::review::diff::tell::Account;
use ncc_driver::review::diff::{json, motion};
use ncc_driver::review::stream::Course;
use ncc_driver::review::verify::document::{Call, Document, Word};
use ncc_driver::review::verify::hashes;
use ncc_driver::review::verify::pair;
use ncc_driver::side::Side;
use ncc_driver::source::include_path::load_subprograms;
use ncc_driver::translate::{rewrite, tools_by_name, translate_recording};
use ncc_ir::diag::Verdict;
use ncc_machines::Profile;
use ncc_machines::project::Programs;
use ncc_machines::reading::Side as Whose;

use crate::colours::{self, Coloured};
use crate::editing;
use crate::program::{
    Files, InMemory, Outputs, machine, machine_of, open, pairs, row, settings, side, stands, tell_absent,
};
use crate::project;
use crate::request::{Colours, Explain, One, Request, Translate, Two, Words};
use crate::simulate::{self, Kept};
use crate::time;
use crate::words;

/// Does a request.
pub(crate) fn run(request: &str, files: &Files, kept: &mut Kept) -> (u8, Outputs) {
    let mut messages = Buffer::no_color();
    let done = match serde_json::from_str(request) {
        Ok(request) => verb(&request, files, kept, &mut messages),
        Err(error) => Err(RequestFault::Unread(error.to_string()).into()),
    };
    let (exit, mut outputs) = done.unwrap_or_else(|problem| {
        // Into memory everything can be written.
        let _ = problem.print(&mut messages, false);
        (problem.exit, Vec::new())
    });
    outputs.push(("messages", messages.into_inner()));
    (exit as u8, outputs)
}

fn verb(
    request: &Request,
    files: &Files,
    kept: &mut Kept,
    messages: &mut Buffer,
) -> Result<(Exit, Outputs), Problem> {
    match request {
        Request::Translate(asked) => translated(asked, files, messages),
        Request::Check(one) => checked(&simulate::with_datum(one.clone(), files)?, files, messages),
        Request::Time(asked) => time::timed(asked, files, messages),
        Request::Summary(asked) => time::summed_up(asked, files, messages),
        Request::Diff(two) => differ(two, files, messages),
        Request::Verify(two) => verified(two, files, messages),
        Request::Explain(Explain { code }) => match explain::page(code) {
            Some(page) => Ok((Exit::Done, vec![("output", page.as_bytes().to_vec())])),
            None => Err(RequestFault::NoMessage(code.clone()).into()),
        },
        Request::Colours(asked) => coloured(asked, files, kept),
        Request::Words(Words { dialect }) => {
            let dialect = files.named(Some(dialect))?.ok_or(RequestFault::NoTarget)?;
            let document = serde_json::to_vec(&words::document(dialect)).unwrap_or_default();
            Ok((Exit::Done, vec![("document", document)]))
        }
        Request::Machines(_) => {
            let machine = |profile: &Profile| {
                let title = &profile.schema.title;
                serde_json::json!({ "id": profile.id(), "title": title, "dialect": profile.dialect.id })
            };
            let all: Vec<_> = ncc_machines::shipped().iter().map(machine).collect();
            Ok((Exit::Done, vec![("document", serde_json::to_vec_pretty(&all).unwrap_or_default())]))
        }
        Request::Layout(asked) => editing::layout(asked, files, messages),
        Request::Names(one) => editing::names(one, files, messages),
        Request::Called(asked) => editing::called(asked, files, messages),
        Request::Rename(asked) => editing::renamed(asked, files, messages),
        Request::Project(asked) => project::project(asked, files, messages),
        Request::Stated(asked) => project::stated(asked, files),
        Request::Path(one) => simulate::path(one, files, kept, messages),
        Request::Simulate(asked) => simulate::simulate(asked, files, kept, messages),
        Request::Seek(asked) => simulate::seek(*asked, kept),
        Request::Stl(_) => simulate::stl(kept),
        #[cfg(not(target_arch = "wasm32"))]
        Request::Chart(asked) => time::drawn::chart(asked, files, messages),
        #[cfg(not(target_arch = "wasm32"))]
        Request::Picture(asked) => simulate::picture(asked, kept),
        #[cfg(not(target_arch = "wasm32"))]
        Request::Sheet(asked) => time::drawn::sheet(asked, files, messages),
        Request::Dialects(_) => {
            let all: Vec<_> = files
                .dialects
                .all()
                .map(|dialect| serde_json::json!({ "id": dialect.id, "title": dialect.title }))
                .collect();
            Ok((Exit::Done, vec![("document", serde_json::to_vec_pretty(&all).unwrap_or_default())]))
        }
    }
}

fn verdicts(names: &[String]) -> Result<Vec<Verdict>, Problem> {
    let verdict = |name: &String| {
        let found = Verdict::ALL.into_iter().find(|verdict| verdict.name() == name);
        found.ok_or_else(|| RequestFault::NoVerdict(name.clone()).into())
    };
    names.iter().map(verdict).collect()
}

fn translated(asked: &Translate, files: &Files, messages: &mut Buffer) -> Result<(Exit, Outputs), Problem> {
    let cannot = |e: io::Error| Problem::file("translate", &asked.file, &e);
    let mut source = open(&asked.file, asked.assume_milling, files, messages)?;
    let row = row(asked.project.as_deref(), &asked.file, files)?;
    let [from, to] = [|row: &Programs| row.machine.clone(), |row: &Programs| row.to.clone()]
        .map(|side| row.as_ref().and_then(side));
    tell_absent(asked.machine_from.as_deref(), from.as_ref(), files, messages)?;
    tell_absent(asked.machine_to.as_deref(), to.as_ref(), files, messages)?;
    let machines = Machines {
        from: machine(asked.machine_from.as_deref(), asked.from.as_deref(), from.as_ref(), files)?,
        to: machine(asked.machine_to.as_deref(), asked.to.as_deref(), to.as_ref(), files)?,
    };
    let to = files.named(asked.to.as_deref())?.or(machines.to.as_ref().map(|profile| profile.dialect));
    let to = to.ok_or(RequestFault::NoTarget)?;
    let to = choose(machines.settings(Whose::To, to), &pairs(&asked.to_option))?;
    let (from, rivals) =
        settings(&mut source, files, asked.from.as_deref(), &machines, &asked.from_option, asked.units)?;
    let crlf = source.is_crlf()?;
    load_subprograms(&mut source, &from, &[PathBuf::new()], &InMemory(files))?;
    let (mut given, mut values) = (InitialVariables::default(), Vec::new());
    for (name, value) in &asked.value {
        let wrong = |why| RequestFault::Value(name.clone(), why);
        let (name, value) = initial_variables::value(&format!("{name}={value}")).map_err(wrong)?;
        if let Some(value) = value {
            given.put(&name, value);
            values.push((name, value));
        }
    }
    let pass = |name: &String| rewrite::pass(name).ok_or_else(|| RequestFault::NoPass(name.clone()));
    let mut job = Job {
        layout: Layout { numbering: machines.numbering(), crlf },
        machines,
        passes: asked.pass.iter().map(pass).collect::<Result<_, _>>()?,
        verify: !asked.no_verify,
        head: !asked.no_head,
        given,
        values,
        program_number: asked.program_number,
        start: stands(asked.start.as_deref())?,
        called: source.called.clone(),
        assumed: source.assumed.clone(),
        rivals,
        questions: if asked.assume { Policy::Assume } else { Policy::Ask },
        allow: verdicts(&asked.allow)?,
        deny: verdicts(&asked.deny)?,
        ..Job::new(from, to, &source.name)
    };
    if file_per_tool(&job.to) {
        return Err(RequestFault::SeveralFiles.into());
    }
    tools_by_name::number(&mut job, &mut source.file).map_err(cannot)?;
    source.rewind()?;
    let recording = Asked { map: asked.map, annotate: false };
    let (mut outcome, record) = translate_recording(&job, recording, &mut source.file).map_err(cannot)?;
    let mut about = About { job: &job, name: &source.shown, source: &mut source.file };
    tell(messages, &mut about, &outcome, Loudness::Usual).map_err(cannot)?;
    let mut told = Vec::new();
    report::write(&mut told, &mut about, &outcome).map_err(cannot)?;
    let mut outputs = vec![("report", told)];
    if outcome.release.is_ok() {
        outputs.insert(0, ("output", outcome.output.to_vec().map_err(cannot)?));
        if let Some(record) = record {
            let lines = line_pairs(&mut *source.file, &mut outcome, record).map_err(cannot)?;
            outputs.push(("lines", lines.into_iter().flat_map(u32::to_le_bytes).collect()));
        }
    }
    Ok((outcome.exit(), outputs))
}

fn coloured(asked: &Colours, files: &Files, kept: &mut Kept) -> Result<(Exit, Outputs), Problem> {
    let text = files.shared(&asked.file)?;
    let dialect = match files.named(asked.from.as_deref())? {
        Some(dialect) => dialect,
        None => {
            let mut source = open(&asked.file, true, files, &mut Buffer::no_color())?;
            let all: Vec<_> = ncc_dialects::builtins().collect();
            let found = recognise(&mut source, &all).ok().map(|found| found.dialect).or_else(colours::any);
            found.ok_or(RequestFault::NoTarget)?
        }
    };
    let own = kept.coloured.take().filter(|own| own.is_of(text, dialect));
    let own = kept.coloured.insert(own.unwrap_or_else(|| Coloured::new(text.clone(), dialect)));
    let document = own.document(asked.first, asked.lines);
    Ok((Exit::Done, vec![("document", serde_json::to_vec(&document).unwrap_or_default())]))
}

fn checked(one: &One, files: &Files, messages: &mut Buffer) -> Result<(Exit, Outputs), Problem> {
    let cannot = |e: io::Error| Problem::file("read", &one.file, &e);
    let profile = machine_of(one, files)?;
    let Side { mut source, job } = side(one, files, messages)?;
    let limits = check::limits(profile.as_deref(), None);
    let course = check::drive::drive(&job, limits, 0, &mut source).map_err(cannot)?;
    let program = told::tell(&told::Graded::default(), &job, &mut source, course).map_err(cannot)?;
    let found = program.has_findings();
    check::text::write(messages, &program, Loudness::Usual).map_err(cannot)?;
    let mut findings = Vec::new();
    check::json::write(&mut findings, vec![program]).map_err(cannot)?;
    Ok((if found { Exit::Refused } else { Exit::Done }, vec![("findings", findings)]))
}

/// Both programs of a comparison, and how far lengths may be apart.
fn sides(two: &Two, files: &Files, messages: &mut Buffer) -> Result<([Side; 2], Option<i64>), Problem> {
    let wrong = || RequestFault::NoTolerance;
    let tolerance = two
        .tolerance
        .as_deref()
        .map(|text| initial_variables::decimal(text).ok_or_else(wrong))
        .transpose()?;
    Ok(([side(&two.a, files, messages)?, side(&two.b, files, messages)?], tolerance))
}

/// Tells what keeps programs from being compared.
fn not_compared(messages: &mut Buffer, sides: &mut [Side; 2], courses: &[Course; 2]) -> io::Result<()> {
    for (side, course) in sides.iter_mut().zip(courses).filter(|(_, course)| course.refused) {
        let shown = side.source.shown.clone();
        let mut about = About { job: &side.job, name: &shown, source: &mut side.source.file };
        human::print(messages, &mut about, &course.diagnostics, Loudness::Usual)?;
    }
    Ok(())
}

fn differ(two: &Two, files: &Files, messages: &mut Buffer) -> Result<(Exit, Outputs), Problem> {
    let cannot = |e: io::Error| Problem::file("compare", "the programs", &e);
    let (mut sides, tolerance) = sides(two, files, messages)?;
    let found = motion::motion(&mut sides, tolerance).map_err(cannot)?;
    if found.refused() {
        not_compared(messages, &mut sides, &found.courses).map_err(cannot)?;
        return Ok((Exit::NotCompared, Vec::new()));
    }
    let account = Account::of(&found, &mut sides).map_err(cannot)?;
    let mut document = Vec::new();
    json::write(&mut document, &account).map_err(cannot)?;
    #[cfg_attr(
        target_arch = "wasm32",
        expect(unused_mut, reason = "a page of its own is for the other hosts")
    )]
    let mut outputs = vec![("document", document)];
    #[cfg(not(target_arch = "wasm32"))]
    {
        let mut page = Vec::new();
        ncc_driver::review::diff::html::write(&mut page, &account).map_err(cannot)?;
        outputs.push(("page", page));
    }
    Ok((if account.equal { Exit::Done } else { Exit::Refused }, outputs))
}

fn verified(two: &Two, files: &Files, messages: &mut Buffer) -> Result<(Exit, Outputs), Problem> {
    let cannot = |e: io::Error| Problem::file("compare", "the programs", &e);
    let (mut sides, tolerance) = sides(two, files, messages)?;
    let found = pair::compare(&mut sides, tolerance.unwrap_or_default()).map_err(cannot)?;
    not_compared(messages, &mut sides, &found.courses).map_err(cannot)?;
    let machines = [two.a.machine.as_deref(), two.b.machine.as_deref()];
    let read = |name: &str| files.get(name).cloned().ok_or_else(|| io::ErrorKind::NotFound.into());
    let call = Call {
        files: [two.a.file.clone(), two.b.file.clone()],
        machines: machines.map(|name| name.map(str::to_owned)),
        tolerance,
        dictionaries: hashes::dictionaries(&sides, &|id| files.dialects.hashes(id)),
        profiles: hashes::profiles(machines, &sides, &read).map_err(cannot)?,
    };
    let document = Document::of(&found, &mut sides, &call).map_err(cannot)?;
    let exit = match document.verdict() {
        Word::Equal | Word::EqualWithinTolerance => Exit::Done,
        Word::Different => Exit::Refused,
        Word::NotCompared => Exit::NotCompared,
    };
    let mut text = serde_json::to_vec_pretty(&document).unwrap_or_default();
    text.push(b'\n');
    Ok((exit, vec![("document", text)]))
}
