//! `ncc plot`: what a program does over time and the way of its tool, as pictures.
//!
//! A program goes through the pipeline of `ncc time` into a record, which keeps what can be seen of
//! it; from that a picture is drawn. Not here: drawing (ncc-plot), timing (`time`).
//!
//! ```text
//! ncc plot --from mach9 part.cn -o part.svg    the tool path, seen from above
//! ```

pub mod args;

use std::io::{self, BufReader, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::job::Output;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::source::Source;
use ncc_driver::time::drive::Plan;
use ncc_driver::time::recorder::Recorder;
use ncc_plot::{Listing, Page, Record, charts, report, view};

use self::args::Plot;
use crate::files::Destination;
use crate::milling::{self, Voice};
use crate::registry::DialectRegistry;
use crate::time::{self, Shop};

/// What a file is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Svg,
    Html,
}

/// Runs the verb.
///
/// # Errors
/// Wrong usage, a file that cannot be read or written, or a program without a way to draw. What is
/// wrong with a program is reported on `err`.
pub(crate) fn run(args: &Plot, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    let form = check(args)?;
    let voice = if args.telling.quiet { Voice::Quiet } else { Voice::Human };
    let opened = args.files.iter().map(|path| milling::open(path, voice, known, err));
    let mut sources = opened.collect::<Result<Vec<_>, _>>()?;
    let name = args.output.as_ref().filter(|name| *name != Path::new("-"));
    for source in &sources {
        source.guard(name.map(PathBuf::as_path))?;
    }
    let destination = name.map_or(Destination::Stdout, |name| Destination::File(name.clone()));
    destination.check()?;
    let mut pages = Vec::new();
    let mut caption = String::new();
    for (n, source) in sources.iter_mut().enumerate() {
        let mut asked = args.timed(n);
        let own = time::settle(&asked, &args.files[n], source, known, err)?;
        if own.is_some() && args.from.is_empty() {
            asked.reading.from = None;
        }
        let shop = Shop::of(&asked, own.as_ref().map(|(profile, _)| &**profile), known, err)?;
        let job = time::job(&asked, &shop, known, source, err)?;
        // The picture is that of the contour.
        let plan = Plan { centre: false, ..time::plan(&asked, &shop, &job) };
        let mut recorder = Recorder(Record::new(&source.name));
        let course = time::execute(&asked, &plan, known, source, &mut recorder, err)?;
        if course.refused {
            return Ok(Exit::Refused);
        }
        if !args.telling.quiet {
            let _ = time::say(&asked, &shop, &plan, &course, &source.shown, err);
        }
        let mut record = recorder.0;
        record.finish();
        let on = if shop.title().is_empty() { "no machine" } else { shop.title() };
        caption = format!("{on} \u{b7} model {}", args.setting.model.name());
        pages.push(Page {
            record,
            facts: vec![
                ("Dialect".to_owned(), job.from.dialect.id.clone()),
                ("Machine".to_owned(), on.to_owned()),
                ("Model".to_owned(), args.setting.model.name().to_owned()),
            ],
            assumed: time::assumptions(&shop, &plan, &course),
            listing: Listing::default(),
        });
    }
    if form == Form::Html {
        for (page, source) in pages.iter_mut().zip(&mut sources) {
            page.listing = listing(&page.record, source)?;
        }
    }
    if args.view.is_some() && pages.iter().all(|page| page.record.stands_still()) {
        return Err(Problem {
            exit: Exit::Refused,
            message: "X, Y and Z stand still: the tool has no way that could be drawn".to_owned(),
            help: vec!["without --view there are charts over time".to_owned()],
        });
    }
    let picture = draw(args, form, &pages, &caption);
    let mut output = Output::new();
    output.push(picture.as_bytes()).map_err(|e| Problem::file("write", "the picture", &e))?;
    destination.release(&mut output)?;
    Ok(Exit::Done)
}

/// What options mean together.
fn check(args: &Plot) -> Result<Form, Problem> {
    if args.from.len() > args.files.len() {
        return Err(Problem::usage(
            format!("{} dialects for {} programs", args.from.len(), args.files.len()),
            "name one for each, or one for all",
        ));
    }
    if args.files.len() > 1 && !args.from_option.is_empty() {
        return Err(Problem::usage(
            "--from-option with two programs",
            "an option belongs to one dialect; state it in a machine profile or a dictionary of your own",
        ));
    }
    if args.files.iter().filter(|file| *file == Path::new("-")).count() > 1 {
        return Err(Problem::usage("stdin can be read only once", "name a file"));
    }
    let Some(name) = args.output.as_ref().filter(|name| *name != Path::new("-")) else {
        return Ok(Form::Svg);
    };
    let ending = name.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("svg") => Ok(Form::Svg),
        Some("html" | "htm") if args.chart.is_empty() && args.view.is_none() => Ok(Form::Html),
        Some("html" | "htm") => Err(Problem::usage(
            "--chart and --view choose what an SVG shows; a report has all of it",
            "leave them out, or write to a file whose name ends with .svg",
        )),
        Some(_) | None => Err(Problem::usage(
            format!("what is {} to be?", name.display()),
            "the name of the file says it: .svg or .html",
        )),
    }
}

fn draw(args: &Plot, form: Form, pages: &[Page], caption: &str) -> String {
    let records: Vec<&Record> = pages.iter().map(|page| &page.record).collect();
    match (form, args.view) {
        (Form::Html, _) => report(pages, env!("CARGO_PKG_VERSION")),
        (Form::Svg, Some(name)) => view(&records, name.view(), caption),
        (Form::Svg, None) => charts(&records, &args.charts(), caption),
    }
}

/// The lines of a source that a report shows.
fn listing(record: &Record, source: &mut Source) -> Result<Listing, Problem> {
    let cannot = |e: &io::Error| Problem::file("read", &source.shown, e);
    source.file.seek(SeekFrom::Start(0)).map_err(|e| cannot(&e))?;
    Listing::read(record, &mut BufReader::new(&mut source.file)).map_err(|e| cannot(&e))
}
