//! `ncc dialects test`: the dictionaries that the command line names, each tested row by row.

use std::path::PathBuf;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::dialect_test::{table, test};
use ncc_driver::problem::{Exit, Problem};

use crate::files;
use crate::registry::DialectRegistry;

/// Tests dictionaries, those of files and those that are known by name, and prints the failures and counts, with `all` every row.
///
/// # Errors
/// A file cannot be read or is no dictionary, there is no dialect of a name, or printing.
pub fn run(
    mut known: DialectRegistry,
    what: &[PathBuf],
    all: bool,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    let named = |path: &PathBuf| path.to_str().and_then(|id| known.get(id));
    let unknown: Vec<PathBuf> = what.iter().filter(|path| named(path).is_none()).cloned().collect();
    let ids: Vec<String> = what.iter().filter_map(|path| Some(named(path)?.id.clone())).collect();
    if let Some(word) = unknown.iter().find(|f| f.extension().is_none() && !f.exists()) {
        known.dialect(&word.display().to_string())?;
    }
    let refused = |problem: Problem| match problem.exit {
        // What is no dictionary has failed its test.
        Exit::Usage => Problem { exit: Exit::Refused, ..problem },
        _ => problem,
    };
    let mut loaded = known.add(&unknown, Some(err)).map_err(refused)?.into_iter();
    let mut ids = ids.into_iter();
    let mut failed = false;
    let mut text = String::new();
    for path in what {
        let dialect = match unknown.contains(path) {
            true => loaded.next(),
            false => ids.next().and_then(|id| known.get(&id)),
        };
        let Some(dialect) = dialect else { continue };
        let rows = test(dialect);
        failed |= rows.iter().any(|row| row.failed.is_some());
        if !text.is_empty() {
            text.push('\n');
        }
        text.push_str(&table(dialect, &rows, all));
    }
    files::to_stdout(&mut |out| out.write_all(text.as_bytes()))?;
    Ok(if failed { Exit::Refused } else { Exit::Done })
}
