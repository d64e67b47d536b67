//! A file per tool: where the files may be written, and which files are left from an earlier run.
//!
//! ```text
//! ncc haas to grbl part.nc --to-option tool_change=file-per-tool -o out/     out/part-1-T3.nc, out/part-2-T5.nc
//! ```
//!
//! Not here: the text of the files (`ncc_driver::translate`), and how they are written (`work`).

use std::fs;
use std::path::{Path, PathBuf};

use ncc_dialects::Dialect;
use ncc_driver::problem::Problem;

use crate::args::Translate;

/// Refuses places that cannot hold several files, and options that concern one file.
///
/// # Errors
/// A place or option that is refused.
pub(crate) fn check(
    args: &Translate,
    folder: Option<&Path>,
    arrow: Option<&'static Dialect>,
) -> Result<(), Problem> {
    let several = "`tool_change=file-per-tool` writes several files";
    let usage = |what: &str, help: &str| Err(Problem::usage(format!("{several}: {what}"), help));
    if arrow.is_some() {
        return usage("the shell's redirection takes one", "write `to` for the arrow, and `-o FOLDER`");
    }
    if args.map.is_some() {
        return usage(
            "--map is about one",
            "leave it out: the head of each file names its lines of the source",
        );
    }
    if args.report.is_some() {
        return usage("--report is about one", "`--format json` prints one document about all of them");
    }
    let named = args.output.as_deref().filter(|name| *name != Path::new("-"));
    let named = match (named, &args.output) {
        (Some(name), _) => name,
        (None, None) if folder.is_some() => return Ok(()),
        (None, _) => return usage("standard output takes one", "name a folder for them: `-o FOLDER`"),
    };
    let text = named.as_os_str().to_string_lossy();
    if named.is_dir() || text.ends_with(std::path::is_separator) && !named.exists() {
        return Ok(());
    }
    usage(&format!("{text} is no folder"), "name one for them, with a slash if it is new: `-o FOLDER/`")
}

/// Files of an earlier run: named after the same program and a tool, and not written by this run. (A name
/// without a tool may belong to another program.)
pub(crate) fn left_over(written: &[PathBuf]) -> Vec<PathBuf> {
    let Some(Named { folder, program, extension, .. }) = written.first().and_then(|path| named(path)) else {
        return Vec::new();
    };
    let entries = fs::read_dir(if folder.as_os_str().is_empty() { Path::new(".") } else { &folder });
    let of_program = |path: &PathBuf| {
        let own = named(path);
        own.is_some_and(|own| own.tool && own.program == program && own.extension == extension)
            && !written.contains(path)
    };
    let paths = entries.into_iter().flatten().filter_map(|entry| Some(folder.join(entry.ok()?.file_name())));
    let mut found: Vec<PathBuf> = paths.filter(of_program).collect();
    found.sort();
    found
}

/// The name of a file per tool.
struct Named {
    folder: PathBuf,
    program: String,
    extension: String,
    /// Whether the name contains a tool.
    tool: bool,
}

fn named(path: &Path) -> Option<Named> {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let stem = path.file_stem()?.to_str()?;
    let extension = path.extension().unwrap_or_default().to_string_lossy().into_owned();
    let of_tool = stem.rsplit_once("-T").filter(|(_, tool)| is_number(tool));
    let (program, number) = of_tool.map_or(stem, |(rest, _)| rest).rsplit_once('-')?;
    let named = || Named { folder, program: program.to_owned(), extension, tool: of_tool.is_some() };
    is_number(number).then(named)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_one_program_are_known_by_their_names() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        for name in [
            "part-1-T3.gcode",
            "part-2-T5.gcode",
            "part-2.gcode",
            "other-1-T3.gcode",
            "part.gcode",
            "part-1-T3.nc",
        ] {
            fs::write(path(name), "").unwrap();
        }
        assert_eq!(left_over(&[path("part-1-T3.gcode")]), [path("part-2-T5.gcode")]);
        assert_eq!(left_over(&[]), [] as [PathBuf; 0]);
    }
}
