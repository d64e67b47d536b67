//! A program among the files of an engine: opened, with its dialect and its machine.

use std::collections::BTreeMap;
use std::io::{self, Cursor};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use codespan_reporting::term::termcolor::Buffer;
use ncc_dialects::{Dialect, Settings};
use ncc_driver::guess::recognise;
use ncc_driver::job::options::{choose, state_units};
use ncc_driver::job::start::position;
use ncc_driver::job::{Job, project_file};
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::{Exit, Problem, RequestFault};
use ncc_driver::side::Side;
use ncc_driver::source::include_path::{Library, load_subprograms};
use ncc_driver::source::{Source, not_milling};
use ncc_driver::time::drive::{Plan, Stage};
use ncc_ir::canon::{AXES, Units};
use ncc_ir::expr::num::Nanos;
use ncc_machines::project::{MachineRef, Programs};
use ncc_machines::reading::Side as Whose;
use ncc_machines::schema::{Schema, WorkOffsetRow};
use ncc_machines::{Fact, Profile, ProfileError};
use ncc_time::{AssumedFact, Model};
use toml::Spanned;

use crate::dialects::Dialects;
use crate::request::{self, One};

/// Outputs by their names.
pub(crate) type Outputs = Vec<(&'static str, Vec<u8>)>;

/// The bytes of a file, which its readers share: a program may have hundreds of megabytes.
#[derive(Clone, Debug)]
pub(crate) struct Shared(Arc<Vec<u8>>);

impl Shared {
    /// Whether it is the same file, and not another with the same bytes.
    pub(crate) fn is(&self, other: &Shared) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl AsRef<[u8]> for Shared {
    fn as_ref(&self) -> &[u8] {
        &self.0
    }
}

/// Files by their names, and the dialects that are known.
#[derive(Debug, Default)]
pub(crate) struct Files {
    all: BTreeMap<String, Shared>,
    /// The built-in dialects, and those of a shop.
    pub(crate) dialects: Dialects,
}

impl Files {
    /// Keeps a file, in the place of another of its name.
    pub(crate) fn put(&mut self, name: &str, bytes: Vec<u8>) {
        self.all.insert(name.to_owned(), Shared(Arc::new(bytes)));
    }

    /// The bytes of a file.
    pub(crate) fn get(&self, name: &str) -> Option<&Vec<u8>> {
        self.all.get(name).map(|file| &*file.0)
    }

    /// A file that there must be.
    pub(crate) fn shared(&self, name: &str) -> Result<&Shared, Problem> {
        self.all.get(name).ok_or_else(|| Problem::file("read", name, &io::ErrorKind::NotFound.into()))
    }

    /// A dialect by its name; of no name and of `auto`, none.
    pub(crate) fn named(&self, id: Option<&str>) -> Result<Option<&'static Dialect>, Problem> {
        let dialect = |id: &str| {
            let none = || RequestFault::NoDialect(id.to_owned(), self.dialects.ids().collect()).into();
            self.dialects.get(id).ok_or_else(none)
        };
        id.filter(|id| *id != "auto").map(dialect).transpose()
    }
}

/// Called programs among the files of an engine, all in one folder.
pub(crate) struct InMemory<'f>(pub(crate) &'f Files);

impl Library for InMemory<'_> {
    fn list(&self, _folder: &Path) -> Vec<PathBuf> {
        self.0.all.keys().map(PathBuf::from).collect()
    }

    fn bytes(&self, path: &Path) -> Option<u64> {
        self.0.get(path.to_str()?).map(|text| text.len() as u64)
    }

    fn read(&self, path: &Path, most: u64) -> io::Result<Vec<u8>> {
        let text = path.to_str().and_then(|name| self.0.get(name)).ok_or(io::ErrorKind::NotFound)?;
        Ok(text[..text.len().min(usize::try_from(most).unwrap_or(usize::MAX))].to_vec())
    }
}

/// A file as a source; one that is for no mill is refused, unless the user says that it is for one.
pub(crate) fn open(
    name: &str,
    milling: bool,
    files: &Files,
    messages: &mut Buffer,
) -> Result<Source, Problem> {
    let mut source = Source::of(Cursor::new(files.shared(name)?.clone()), name);
    let Some(refusal) = not_milling::refusal(&mut source, milling)? else { return Ok(source) };
    refusal.print(messages).map_err(|e| Problem::file("read", name, &e))?;
    // It has been reported.
    Err(Problem { exit: Exit::Refused, message: String::new(), help: Vec::new() })
}

/// A machine's profile by the name of one that comes with ncc, or of a file.
pub(crate) fn profile(name: Option<&str>, files: &Files) -> Result<Option<Arc<Profile>>, Problem> {
    let Some(name) = name else { return Ok(None) };
    if let Some(profile) = ncc_machines::find(name) {
        return Ok(Some(Arc::new(profile.clone())));
    }
    let text = file_text(name, files).ok_or_else(|| RequestFault::NoMachine(name.to_owned()))?;
    parsed(name, Profile::parse(text, &|id| files.dialects.get(id))).map(Some)
}

fn file_text<'f>(name: &str, files: &'f Files) -> Option<&'f str> {
    files.get(name).and_then(|text| std::str::from_utf8(text).ok())
}

fn parsed(name: &str, profile: Result<Profile, Vec<ProfileError>>) -> Result<Arc<Profile>, Problem> {
    profile.map(Arc::new).map_err(|wrong| RequestFault::Profile(name.to_owned(), wrong.len()).into())
}

/// The machine of a program that is timed: that of [`machine_of`], or the case study's machine file.
pub(crate) fn machine_for_times(one: &One, files: &Files) -> Result<Option<Arc<Profile>>, Problem> {
    let name = one.machine.as_deref().filter(|name| ncc_machines::find(name).is_none());
    let text = name.and_then(|name| Some((name, file_text(name, files)?)));
    match text.filter(|(_, text)| text.trim_start().starts_with('{')) {
        Some((name, text)) => parsed(name, Profile::parse_machine_json(text)).map(Some),
        None => machine_of(one, files),
    }
}

/// What a project file among the files says of a program, if it does.
pub(crate) fn row(project: Option<&str>, file: &str, files: &Files) -> Result<Option<Programs>, Problem> {
    let Some(name) = project else { return Ok(None) };
    let text = files.get(name).ok_or_else(|| Problem::file("read", name, &io::ErrorKind::NotFound.into()))?;
    project_file::row(&String::from_utf8_lossy(text), file, &|id| files.dialects.get(id))
}

/// Whether a file is at hand: a host puts an empty one in the place of one that is gone.
pub(crate) fn is_given(name: &str, files: &Files) -> bool {
    files.get(name).is_some_and(|text| !text.is_empty())
}

/// The name of a machine of a row whose profile is not at hand: nothing else that is asked shall fail with it.
fn absent(row: Option<&MachineRef>, files: &Files) -> Option<String> {
    match row? {
        MachineRef::Named(name) => {
            let is_known = ncc_machines::find(name.get_ref()).is_some() || is_given(name.get_ref(), files);
            (!is_known).then(|| name.get_ref().clone())
        }
        MachineRef::Inline(..) => None,
    }
}

/// Tells which machine of a row is not at hand, where the request names none in its place.
pub(crate) fn tell_absent(
    machine: Option<&str>,
    row: Option<&MachineRef>,
    files: &Files,
    messages: &mut Buffer,
) -> Result<(), Problem> {
    let Some(name) = absent(row, files).filter(|_| machine.is_none()) else { return Ok(()) };
    warn(&name, messages)
}

/// Tells that a file which a row names is not at hand.
pub(crate) fn warn(name: &str, messages: &mut Buffer) -> Result<(), Problem> {
    project_file::absent(name).warn(messages).map_err(|e| Problem::file("read", name, &e))
}

/// The machine that a request names, or else that of a row of the project file, unless the request names another dialect; none
/// where that of the row is not at hand ([`tell_absent`]).
pub(crate) fn machine(
    machine: Option<&str>,
    dialect: Option<&str>,
    row: Option<&MachineRef>,
    files: &Files,
) -> Result<Option<Arc<Profile>>, Problem> {
    let own = match row.filter(|_| machine.is_none()) {
        None => return profile(machine, files),
        own if absent(own, files).is_some() => return Ok(None),
        Some(MachineRef::Named(name)) => profile(Some(name.get_ref()), files)?,
        Some(MachineRef::Inline(profile, _)) => Some(Arc::new(Profile::clone(profile))),
    };
    let dialect = files.named(dialect)?;
    Ok(own.filter(|own| dialect.is_none_or(|dialect| dialect.id == own.dialect.id)))
}

/// The machine of a program.
pub(crate) fn machine_of(one: &One, files: &Files) -> Result<Option<Arc<Profile>>, Problem> {
    let row = row(one.project.as_deref(), &one.file, files)?;
    let own = row.as_ref().and_then(|row| row.machine.as_ref());
    let mut machine = machine(one.machine.as_deref(), one.from.as_deref(), own, files)?;
    if let (Some(machine), Some(zero), Some(number)) = (&mut machine, one.zero, one.datum) {
        put_zero(&mut Arc::make_mut(machine).schema, number, zero);
    }
    Ok(machine)
}

/// Puts the zero of a work offset into a profile; the name and the rotary axes of its row stay.
fn put_zero(schema: &mut Schema, number: u32, zero: [f64; 3]) {
    fn fact<T>(value: T) -> Fact<T> {
        Fact { value: Some(value), source: String::new(), assumed: false, span: 0..0 }
    }
    let all = &mut schema.work_offset;
    let at = all.iter().position(|row| row.get_ref().number.get() == Some(number)).unwrap_or_else(|| {
        let row = WorkOffsetRow { number: fact(number), ..WorkOffsetRow::default() };
        all.push(Spanned::new(0..0, row));
        all.len() - 1
    });
    let row = all[at].get_mut();
    [row.x, row.y, row.z] = zero.map(fact);
}

/// The dialect of a source, with what was chosen of it; and others that explain it as well.
pub(crate) fn settings(
    source: &mut Source,
    files: &Files,
    from: Option<&str>,
    machines: &Machines,
    options: &BTreeMap<String, String>,
    units: Option<request::Units>,
) -> Result<(Settings, Vec<&'static Dialect>), Problem> {
    let own = files.named(from)?.or(machines.from.as_ref().map(|profile| profile.dialect));
    let (dialect, rivals) = match own {
        Some(dialect) => (dialect, Vec::new()),
        None => {
            let all: Vec<_> = ncc_dialects::builtins().collect();
            let found = recognise(source, &all)?;
            (found.dialect, found.rivals)
        }
    };
    let mut settings = choose(machines.settings(Whose::From, dialect), &pairs(options))?;
    state_units(&mut settings, units.map(unit))?;
    Ok((settings, rivals))
}

/// Position of the tool before the first block, program coordinates: `X-9,Y15.588,Z3`.
pub(crate) fn stands(start: Option<&str>) -> Result<[Option<Nanos>; AXES], Problem> {
    let read =
        start.map(|text| position(text).map_err(|why| RequestFault::Start(text.to_owned(), why.words())));
    Ok(read.transpose()?.unwrap_or_default())
}

pub(crate) fn pairs(options: &BTreeMap<String, String>) -> Vec<(String, String)> {
    options.iter().map(|(name, value)| (name.clone(), value.clone())).collect()
}

pub(crate) fn unit(units: request::Units) -> Units {
    match units {
        request::Units::Mm => Units::Mm,
        request::Units::Inch => Units::Inch,
    }
}

/// A program that is executed, with those that it calls.
pub(crate) fn side(one: &One, files: &Files, messages: &mut Buffer) -> Result<Side, Problem> {
    side_with(one, machine_of(one, files)?, [files, files], messages)
}

/// The same on this machine.
pub(crate) fn side_on(
    machine: Option<Arc<Profile>>,
    one: &One,
    files: &Files,
    messages: &mut Buffer,
) -> Result<Side, Problem> {
    side_with(one, machine, [files, files], messages)
}

/// The text of a program alone, whatever it calls: for who changes it.
pub(crate) fn side_alone(one: &One, files: &Files, messages: &mut Buffer) -> Result<Side, Problem> {
    side_with(one, machine_of(one, files)?, [files, &Files::default()], messages)
}

fn side_with(
    one: &One,
    machine: Option<Arc<Profile>>,
    [files, called]: [&Files; 2],
    messages: &mut Buffer,
) -> Result<Side, Problem> {
    let mut source = open(&one.file, one.assume_milling, files, messages)?;
    let stated = row(one.project.as_deref(), &one.file, files)?.and_then(|row| row.machine);
    tell_absent(one.machine.as_deref(), stated.as_ref(), files, messages)?;
    let profile = machine.filter(|machine| !machine.any_control);
    let machines = Machines { from: profile.clone(), to: profile };
    let (from, rivals) =
        settings(&mut source, files, one.from.as_deref(), &machines, &one.from_option, one.units)?;
    // What a profile states of its control holds for programs in that control's language.
    let own = machines.from.as_ref().is_some_and(|profile| profile.dialect.id == from.dialect.id);
    load_subprograms(&mut source, &from, &[PathBuf::new()], &InMemory(called))?;
    source.rewind()?;
    let mut side = Side::of(source, from, if own { machines } else { Machines::default() }, None);
    side.job.rivals = rivals;
    Ok(side)
}

/// How a program is executed and timed, and what that assumes of its machine.
pub(crate) fn plan<'p>(
    job: &'p Job,
    profile: Option<&Profile>,
    model: Model,
) -> (Plan<'p>, Vec<AssumedFact>) {
    let (machine, assumed) = profile.map(Profile::machine).unwrap_or_default().assumed(model);
    let plan = Plan {
        job,
        machine,
        tables: profile.map(Profile::tables).unwrap_or_default(),
        parameters: [None; 2],
        model,
        skip: 0,
        start_time: 0.0,
        stage: Stage::After,
        centre: true,
    };
    (plan, assumed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stated_zero_keeps_the_rest_of_the_row() {
        let mut schema = ncc_machines::find("fanuc-vmc").expect("a profile").schema.clone();
        schema.work_offset.clear();
        put_zero(&mut schema, 1, [0.0; 3]);
        let row = schema.work_offset[0].get_mut();
        (row.name.value, row.a.value) = (Some("vice".to_owned()), Some(30.0));
        put_zero(&mut schema, 1, [-5.0, -6.0, -7.0]);
        put_zero(&mut schema, 2, [0.0; 3]);
        let [row, other] = &schema.work_offset[..] else { panic!("{:?}", schema.work_offset) };
        let row = row.get_ref();
        assert_eq!([&row.x, &row.y, &row.z, &row.a].map(Fact::get), [-5.0, -6.0, -7.0, 30.0].map(Some));
        assert_eq!(row.name.value.as_deref(), Some("vice"));
        assert_eq!(other.get_ref().number.get(), Some(2));
    }
}
