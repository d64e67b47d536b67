//! Finds the map of a program and the source that it names; where there is no map, makes one.
//!
//! A program or a source that is not the one of the map, byte for byte, is refused: what would be reported of
//! it need not be true.

use std::fs::File;
use std::io::{self, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_backends::Layout;
use ncc_dialects::Dialect;
use ncc_driver::job::Job;
use ncc_driver::job::options::choose;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::provenance::map;
use ncc_driver::provenance::trace::Asked;
use ncc_driver::questions::Policy;
use ncc_driver::render::About;
use ncc_driver::render::report::hex;
use ncc_driver::source::spool::Spool;
use ncc_driver::source::{Source, include_path};
use ncc_driver::translate::translate_recording;

use super::args::Why;
use super::read::{Document, own_settings, read};
use crate::files;
use crate::milling::{self, Voice};
use crate::registry::DialectRegistry;
use crate::registry::recognised::recognise;

/// A map with the source that it was made of.
pub(crate) struct Found {
    pub(crate) document: Document,
    pub(crate) source: Source,
}

/// Finds the map of a program of this hash.
///
/// # Errors
/// There is none, it is of another program, or its source is not there or not the same any more.
pub(crate) fn find(
    args: &Why,
    output: &mut Source,
    sha256: &[u8],
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Found, Problem> {
    let (out, line) = &args.place;
    let beside = PathBuf::from(format!("{}.map.json", out.display()));
    let name = match &args.map {
        Some(name) => name.clone(),
        None if beside.is_file() => beside,
        None => match &args.from_source {
            Some(source) => return again(args, source, output, sha256, known, err),
            None => {
                return Err(Problem::usage(
                    format!("there is no {}", beside.display()),
                    format!(
                        "translate with --map {}, name a map with --map, or the source with --from-source",
                        beside.display()
                    ),
                ));
            }
        },
    };
    let shown = name.display().to_string();
    let file = File::open(&name).map_err(|e| Problem::file("read", &shown, &e))?;
    if file.metadata().is_ok_and(|metadata| metadata.is_dir()) {
        return Err(Problem::file("read", &shown, &io::ErrorKind::IsADirectory.into()));
    }
    let document = read(file, *line).map_err(|e| Problem {
        exit: Exit::File,
        message: format!("{shown} is no map that can be read: {e}"),
        help: vec!["`ncc translate --map` writes one".to_owned()],
    })?;
    if document.output.sha256 != hex(sha256) {
        return Err(changed(&output.shown, &shown, "translate again, with --map"));
    }
    let source = source_of(args, &document, out, &name, known)?;
    Ok(Found { document, source })
}

fn changed(file: &str, map: &str, help: &str) -> Problem {
    Problem {
        exit: Exit::Refused,
        message: format!("{file} is not what {map} was made of: it has another hash"),
        help: vec![help.to_owned()],
    }
}

/// A source with the programs after it that it calls from files of their own.
fn with_called(
    mut source: Source,
    document: &Document,
    map: &Path,
    known: &DialectRegistry,
) -> Result<Source, Problem> {
    let side = &document.source;
    let Some(settings) = own_settings(side, known).filter(|_| !side.called.is_empty()) else {
        return Ok(source);
    };
    let folder = |file: &str| Path::new(file).parent().map(Path::to_owned).unwrap_or_default();
    let mut folders: Vec<PathBuf> = known.folders().to_vec();
    for file in &side.called {
        let folder = folder(&file.file);
        let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder };
        if !folders.contains(&folder) {
            folders.push(folder);
        }
    }
    include_path::load_subprograms(&mut source, &settings, &folders, &files::Disk)?;
    let found: Vec<String> =
        source.called.iter().flat_map(|called| &called.files).map(|file| hex(&file.sha256)).collect();
    let other = side.called.iter().enumerate().find(|(at, file)| found.get(*at) != Some(&file.sha256));
    match other {
        None => Ok(source),
        Some((_, file)) => {
            let help = "name the folder with the called programs with -I";
            Err(changed(&file.file, &map.display().to_string(), help))
        }
    }
}

/// The source of a map: the one that was named, else where it was, else beside the program or the map.
fn source_of(
    args: &Why,
    document: &Document,
    out: &Path,
    map: &Path,
    known: &DialectRegistry,
) -> Result<Source, Problem> {
    let side = &document.source;
    let beside = |path: &Path| path.parent().map(|folder| folder.join(&side.name));
    let candidates = match &args.from_source {
        Some(source) => vec![source.clone()],
        None if side.name == "-" => Vec::new(),
        None => {
            let all = [Some(PathBuf::from(&side.file)), beside(out), beside(map)];
            all.into_iter().flatten().filter(|path| path.is_file()).collect()
        }
    };
    let mut other = None;
    for path in &candidates {
        let mut source = files::open(path)?;
        let (_, sha256) = ncc_driver::provenance::text::Text::hashed(&mut source.file)
            .map_err(|e| Problem::file("read", &path.display().to_string(), &e))?;
        if hex(&sha256) == side.sha256 {
            return with_called(source, document, map, known);
        }
        other.get_or_insert(path);
    }
    let help = "name the source with --from-source";
    match other {
        Some(path) => Err(changed(&path.display().to_string(), &map.display().to_string(), help)),
        None => Err(Problem {
            exit: Exit::File,
            message: format!("the source of {}, {}, is not there", out.display(), side.file),
            help: vec![help.to_owned()],
        }),
    }
}

/// Translates the source again, as `translate` does where nothing else is asked.
fn again(
    args: &Why,
    path: &Path,
    output: &mut Source,
    sha256: &[u8],
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Found, Problem> {
    let mut source = milling::open(path, Voice::Quiet, known, err)?;
    let dialect = |id: &Option<String>, of: &mut Source, err: &mut dyn WriteColor| match id.as_deref() {
        None | Some("auto") => recognise(of, false, known, err),
        Some(id) => known.dialect(id),
    };
    let from: &'static Dialect = dialect(&args.from, &mut source, err)?;
    let to: &'static Dialect = dialect(&args.to, output, err)?;
    let crlf = output.is_crlf()?;
    let own = |dialect: &'static Dialect| choose(ncc_dialects::Settings::new(dialect), &[]);
    let job = Job {
        layout: Layout { crlf, ..Layout::default() },
        questions: Policy::Skip,
        ..Job::new(own(from)?, own(to)?, &source.name)
    };
    source.rewind()?;
    let wrong = |e: &io::Error| Problem::file("translate", &path.display().to_string(), e);
    let asked = Asked { map: true, annotate: false };
    let (mut outcome, record) = translate_recording(&job, asked, &mut source.file).map_err(|e| wrong(&e))?;
    let other = || Problem {
        exit: Exit::Refused,
        message: format!(
            "{} translated from {} to {} is not {}",
            path.display(),
            from.id,
            to.id,
            output.shown
        ),
        help: vec![format!(
            "translate it as it was translated, with --map {}.map.json, and ask again",
            output.shown
        )],
    };
    let Some(record) = record else { return Err(other()) };
    let mut file = Spool::default();
    let shown = path.display().to_string();
    let mut about = About { job: &job, name: &shown, source: &mut source.file };
    let name = output.name.clone();
    map::write(&mut file, &mut about, &name, &mut outcome, record).map_err(|e| wrong(&e))?;
    file.seek(SeekFrom::Start(0)).map_err(|e| wrong(&e))?;
    let document = read(file, args.place.1).map_err(|e| wrong(&e.into()))?;
    if document.output.sha256 != hex(sha256) {
        return Err(other());
    }
    Ok(Found { document, source })
}
