//! Programs that a program calls and that stand in files of their own: found in the folders of `-I`, by
//! the names that the control's custom gives them (`[program] called` of the dictionary), or by the number in them, as
//! controls find programs that are called by number.
//!
//! They are put behind the text that calls them, each under its name, as a text with all of them in it
//! would have them; from there on everything reads, executes and verifies one text. Which of its places
//! stand in which file is kept beside it, so that messages name the file and its own line.
//!
//! Without `-I`, and without folders of a project file, nothing is looked for. Not here: what a call means.

use std::cell::OnceCell;
use std::collections::{BTreeSet, HashMap};
use std::io;
use std::path::{Path, PathBuf};

use ncc_dialects::{Dialect, Family, Settings};
use ncc_frontends::{Batch, Reader};
use ncc_ir::program::{Op, Stmt, Text};
use sha2::{Digest, Sha256};

use crate::problem::{Exit, Problem, problem};
use crate::source::Source;
use crate::source::called_files::{Called, CalledFile};
use crate::source::spool::Spool;

/// Programs that are put behind a text, so that nothing goes on for ever.
const MOST: usize = 1000;

/// Largest text that calls others, and largest of these, in bytes.
const LARGEST: u64 = 1 << 30;

/// Where a host keeps programs that others call.
pub trait Library {
    /// Paths of all that is in a folder, in any order; nothing of a folder that is not there.
    fn list(&self, folder: &Path) -> Vec<PathBuf>;

    /// Length of a file in bytes; `None` of what is no plain file.
    fn bytes(&self, path: &Path) -> Option<u64>;

    /// The first bytes of a file, at most so many.
    ///
    /// # Errors
    /// It cannot be read.
    fn read(&self, path: &Path, most: u64) -> io::Result<Vec<u8>>;
}

/// Appends the programs that a source calls, as far as they are found in the folders.
///
/// # Errors
/// A file cannot be read, or holds another program than the one that its name says.
pub fn load_subprograms(
    source: &mut Source,
    settings: &Settings,
    folders: &[PathBuf],
    library: &dyn Library,
) -> Result<(), Problem> {
    let dialect = settings.dialect;
    let folders: Vec<PathBuf> = folders.iter().chain(&source.include).cloned().collect();
    if folders.is_empty() || dialect.program.called.is_empty() || source.called.is_some() {
        return Ok(());
    }
    let wrong = |error: &io::Error, name: &str| Problem::file("read", name, error);
    let shown = source.shown.clone();
    if source.bytes().map_err(|e| wrong(&e, &shown))? > LARGEST {
        return Ok(());
    }
    source.rewind()?;
    let mut whole = Vec::new();
    source.file.read_to_end(&mut whole).map_err(|e| wrong(&e, &shown))?;
    source.rewind()?;
    let mut called =
        Called { sha256: Sha256::digest(&whole).into(), bytes: whole.len() as u64, files: Vec::new() };
    let Some(own) = program_of(&whole, dialect) else { return Ok(()) };
    whole.truncate(own.end);
    let mut asked: BTreeSet<Text> = BTreeSet::new();
    let folders = Folders::list(&folders, dialect, library);
    let mut lines = count(&whole);
    loop {
        let wanted: Vec<Text> =
            missing(&whole, settings).into_iter().filter(|name| asked.insert(name.clone())).collect();
        let mut more = false;
        for name in wanted {
            let Some(path) = folders.find(&name, dialect)? else { continue };
            let before = whole.len();
            let file = read(library, path, &name, dialect, &mut whole, lines)?;
            lines += count(&whole[before..]);
            called.files.push(file);
            more = true;
        }
        if !more || called.files.len() > MOST {
            break;
        }
    }
    if called.files.is_empty() {
        return Ok(());
    }
    source.file = Box::new(Spool::of(whole));
    source.called = Some(called);
    Ok(())
}

/// Programs that a text calls and does not have, in the order of their first calls.
fn missing(text: &[u8], settings: &Settings) -> Vec<Text> {
    let mut reader = Reader::new(settings.clone(), true);
    let mut batch = Batch::default();
    let mut calls = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let least = rest.len().min(1 << 16);
        let end = memchr::memchr(b'\n', &rest[least - 1..]).map_or(rest.len(), |n| least + n);
        reader.read(&rest[..end], at as u32, &mut batch);
        names(&batch.stmts, &mut calls);
        batch.stmts.clear();
        batch.diagnostics.clear();
        at += end;
    }
    reader.finish(&mut batch);
    names(&batch.stmts, &mut calls);
    let mut known: BTreeSet<Text> = batch.name.number.map(|n| n.to_string().into()).into_iter().collect();
    for procedure in &batch.procedures {
        names(&procedure.body, &mut calls);
        known.insert(procedure.name.clone());
    }
    calls.retain(|name| known.insert(name.clone()));
    calls
}

/// What statements call.
fn names(stmts: &[Stmt], found: &mut Vec<Text>) {
    for stmt in stmts {
        match &stmt.op {
            Op::Call(call) => found.push(call.name.clone()),
            Op::Control(control) => control.bodies().for_each(|body| names(body, found)),
            _ => {}
        }
    }
}

/// Folders in which called programs are looked for.
struct Folders<'l>(Vec<Folder<'l>>);

/// Files of one of them.
struct Folder<'l> {
    library: &'l dyn Library,
    /// By their names without extension in small letters.
    named: HashMap<String, PathBuf>,
    /// All of them, in the order of their names.
    files: Vec<PathBuf>,
    /// By the numbers of their programs, found out when one is first asked for for which no file is named.
    numbered: OnceCell<HashMap<String, Vec<PathBuf>>>,
}

impl<'l> Folders<'l> {
    /// Lists them once. Of several files with one name the first counts, in the order of their full names.
    fn list(folders: &[PathBuf], dialect: &Dialect, library: &'l dyn Library) -> Folders<'l> {
        let listed = |folder: &PathBuf| {
            let mut files = library.list(folder);
            files.sort();
            let mut named = HashMap::with_capacity(files.len());
            // As a program is called whose file has other signs in its name than a program can have.
            let mut plain = Vec::new();
            for path in &files {
                let own = path.extension().map(|own| own.to_string_lossy().into_owned());
                let fits =
                    own.is_none_or(|own| dialect.extensions.iter().any(|e| e.eq_ignore_ascii_case(&own)));
                if let Some(stem) = path.file_stem().filter(|_| fits && library.bytes(path).is_some()) {
                    let stem = stem.to_string_lossy().to_ascii_lowercase();
                    if dialect.family == Family::Sinumerik {
                        plain.push((stem.replace(|c: char| !c.is_ascii_alphanumeric(), "_"), path.clone()));
                    }
                    named.entry(stem).or_insert_with(|| path.clone());
                }
            }
            for (stem, path) in plain {
                named.entry(stem).or_insert(path);
            }
            Folder { library, named, files, numbered: OnceCell::new() }
        };
        Folders(folders.iter().map(listed).collect())
    }

    /// The file of a program: the first folder that has one counts, and in it the first of the names; then, as controls
    /// find a program by its number, the file whose program has it.
    ///
    /// # Errors
    /// Two files of a folder hold a program of this number.
    fn find(&self, name: &str, dialect: &Dialect) -> Result<Option<&Path>, Problem> {
        let stems = dialect.program.called.iter().filter_map(|form| stem(form, name));
        let stems: Vec<String> = stems.map(|stem| stem.to_ascii_lowercase()).collect();
        for folder in &self.0 {
            let named = stems.iter().find_map(|stem| folder.named.get(stem));
            let numbered = || folder.of_number(name, dialect);
            match (named, named.is_none().then(numbered).flatten()) {
                (Some(path), _) | (None, Some([path])) => return Ok(Some(path)),
                (None, Some([first, second, ..])) => return Err(both(name, [first, second], dialect)),
                (None, _) => {}
            }
        }
        Ok(None)
    }
}

impl Folder<'_> {
    /// Files that begin with the program of a number, where programs have numbers.
    fn of_number(&self, name: &str, dialect: &Dialect) -> Option<&[PathBuf]> {
        let numbers = dialect.program.number.is_some() && !dialect.program.o_words;
        if !numbers || !name.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let numbered = self.numbered.get_or_init(|| {
            let mut found: HashMap<String, Vec<PathBuf>> = HashMap::new();
            for path in &self.files {
                if let Some(number) = number_in(self.library, path, dialect) {
                    found.entry(number).or_default().push(path.clone());
                }
            }
            found
        });
        numbered.get(name).map(Vec::as_slice)
    }
}

/// Bytes at the beginning of a file in which its program's number is looked for.
const BEGINNING: u64 = 1 << 16;

/// The number of the program that a file begins with; none of one that is no text, or too large for a called program.
fn number_in(library: &dyn Library, path: &Path, dialect: &Dialect) -> Option<String> {
    library.bytes(path).filter(|bytes| *bytes <= LARGEST)?;
    let text = library.read(path, BEGINNING).ok()?;
    if text.contains(&0) {
        return None;
    }
    let name = program_of(&text, dialect)?.name?;
    name.bytes().all(|b| b.is_ascii_digit()).then_some(name)
}

/// Two files with one program.
fn both(name: &str, files: [&PathBuf; 2], dialect: &Dialect) -> Problem {
    let [first, second] = files.map(|file| file.display().to_string());
    let own = dialect.program.called.iter().find_map(|form| stem(form, name)).unwrap_or_default();
    let extension = dialect.extensions.first().map(|e| e.to_ascii_lowercase()).unwrap_or_default();
    let message = problem("two-files")
        .text("name", name)
        .text("first", first)
        .text("second", second)
        .text("file", format!("{own}.{extension}"));
    Problem::of(Exit::Refused, &message, None)
}

/// A name by its form: `{}` is the name, `{4}` its number with at least so many digits.
fn stem(form: &str, name: &str) -> Option<String> {
    let (before, rest) = form.split_once('{')?;
    let (digits, behind) = rest.split_once('}')?;
    let name = match digits {
        // A number is no name: its programs are called by number.
        "" if name.bytes().all(|b| b.is_ascii_digit()) => return None,
        "" => name.to_owned(),
        digits => format!("{:0wide$}", name.parse::<u32>().ok()?, wide = digits.parse().ok()?),
    };
    Some(format!("{before}{name}{behind}"))
}

/// Whether a control finds the programs that another calls by the names of their files.
pub fn by_files(dialect: &Dialect) -> bool {
    dialect.program.sub_extension.is_some() || dialect.program.o_words
}

/// The file in which such a control looks for a program by itself. A LinuxCNC's is the name of the call, in small
/// letters (2.9, gcode/o-code.html, Calling Files).
pub fn file_of(dialect: &Dialect, name: &str) -> Option<String> {
    if dialect.program.o_words {
        return Some(format!("{}.{}", name.to_ascii_lowercase(), dialect.extensions.first()?));
    }
    let extension = dialect.program.sub_extension.as_ref()?;
    let stem = dialect.program.called.iter().find_map(|form| stem(form, name))?;
    Some(format!("{}.{extension}", stem.to_ascii_uppercase()))
}

/// The name of the program in a file, by which others call it: `L300` is 300.
pub fn program_in(dialect: &Dialect, file: &str) -> Text {
    let number = dialect.program.called.iter().find_map(|form| {
        let (before, rest) = form.split_once('{')?;
        let (digits, behind) = rest.split_once('}')?;
        let named =
            |from: usize, with: &str| file.get(from..).is_some_and(|own| own.eq_ignore_ascii_case(with));
        let end = file.len().checked_sub(behind.len())?;
        let own = file.get(before.len()..end).filter(|_| named(end, behind) && !digits.is_empty())?;
        let fits =
            file[..before.len()].eq_ignore_ascii_case(before) && own.bytes().all(|b| b.is_ascii_digit());
        own.parse::<u32>().ok().filter(|_| fits)
    });
    number.map_or_else(|| file.into(), |number| number.to_string().into())
}

/// Lines that end in a text.
fn count(text: &[u8]) -> u64 {
    memchr::memchr_iter(b'\n', text).count() as u64
}

/// Puts a file's program behind a text of so many lines.
fn read(
    library: &dyn Library,
    path: &Path,
    name: &str,
    dialect: &Dialect,
    whole: &mut Vec<u8>,
    lines: u64,
) -> Result<CalledFile, Problem> {
    let shown = path.display().to_string();
    let text = library.read(path, LARGEST + 1).map_err(|e| Problem::file("read", &shown, &e))?;
    let no_program = || {
        let message = problem("no-program").text("file", &shown).text("name", name);
        Problem::of(Exit::Refused, &message.text("dialect", &dialect.id), None)
    };
    if text.contains(&0) || whole.len() as u64 + text.len() as u64 > LARGEST {
        return Err(no_program());
    }
    let own = match sub_of(&text, name, dialect) {
        Some(own) => own,
        None => program_of(&text, dialect).ok_or_else(no_program)?,
    };
    if let Some(other) = own.name.as_deref().filter(|own| !own.eq_ignore_ascii_case(name)) {
        let message = problem("other-program").text("file", &shown).text("name", name).text("other", other);
        return Err(Problem::of(Exit::Refused, &message, None));
    }
    let end_line = |whole: &mut Vec<u8>| {
        if whole.last().is_some_and(|b| *b != b'\n') {
            whole.push(b'\n');
        }
    };
    let before = whole.len();
    end_line(whole);
    if own.name.is_none() {
        whole.extend_from_slice(heading(name, dialect).as_bytes());
    }
    let lines_before = (lines + count(&whole[before..])).saturating_sub(count(&text[..own.start]));
    let start = whole.len() as u32;
    whole.extend_from_slice(&text[own.start..own.end]);
    let places = (start, whole.len() as u32);
    end_line(whole);
    Ok(CalledFile {
        name: shown,
        sha256: Sha256::digest(&text).into(),
        bytes: text.len() as u64,
        places,
        lines_before,
    })
}

/// The line that heads a subprogram.
fn heading(name: &str, dialect: &Dialect) -> String {
    match (dialect.family, dialect.program.number) {
        (Family::Sinumerik, _) if name.bytes().all(|b| b.is_ascii_digit()) => format!("%_N_L{name}_SPF\n"),
        (Family::Sinumerik, _) => format!("%_N_{name}_SPF\n"),
        (_, Some(_)) if !name.bytes().all(|b| b.is_ascii_digit()) => format!("<{name}>\n"),
        (_, Some(letter)) => format!("{letter}{name}\n"),
        (_, None) => String::new(),
    }
}

/// What of a text is its program, and how that is named there.
struct Own {
    start: usize,
    end: usize,
    name: Option<String>,
}

/// The part of a text between its marks; `None` if they are not as they should be.
fn program_of(text: &[u8], dialect: &Dialect) -> Option<Own> {
    let mark = dialect.program.frame.as_bytes();
    let lines = |from: usize| {
        let mut at = from;
        text[from..].split_inclusive(|b| *b == b'\n').map(move |line| {
            let start = at;
            at += line.len();
            (start, line.trim_ascii())
        })
    };
    let (mut start, mut end) = (0, text.len());
    if !mark.is_empty() {
        let mut marks = lines(0).filter(|(_, line)| line.starts_with(mark));
        if let Some((first, _)) = marks.next() {
            if !text[..first].trim_ascii().is_empty() && !text[..first].starts_with(b"\xEF\xBB\xBF") {
                return None;
            }
            start = memchr::memchr(b'\n', &text[first..]).map_or(text.len(), |n| first + n + 1);
            end = marks.next().map_or(text.len(), |(at, _)| at);
        }
    }
    let first = lines(start).take_while(|(at, _)| *at < end).find(|(_, line)| {
        let comment = line.starts_with(b"(") && line.ends_with(b")");
        !(line.is_empty() || line.starts_with(b";") || comment)
    });
    let name = first.and_then(|(_, line)| name_of(line, dialect));
    // The main text keeps its opening mark: places in it are those of its file.
    Some(Own { start, end, name })
}

/// The subprogram of O words that a file is named by: what stands beside it there, the control passes by where it is
/// called (LinuxCNC 2.9, gcode/o-code.html, Calling files).
fn sub_of(text: &[u8], name: &str, dialect: &Dialect) -> Option<Own> {
    if !dialect.program.o_words {
        return None;
    }
    let letter = dialect.program.number?;
    let mut at = 0;
    let mut start = None;
    for line in text.split_inclusive(|b| *b == b'\n') {
        let own = at;
        at += line.len();
        let Some((label, word)) = o_word(line, letter) else { continue };
        if !label.eq_ignore_ascii_case(name) {
            continue;
        }
        match (word.as_str(), start) {
            ("sub", None) => start = Some(own),
            ("endsub", Some(start)) => return Some(Own { start, end: at, name: Some(label) }),
            _ => {}
        }
    }
    None
}

/// The label of an O word and the word after it, in small letters and without blanks.
fn o_word(line: &[u8], letter: char) -> Option<(String, String)> {
    let line: String = std::str::from_utf8(line).ok()?.chars().filter(|c| !c.is_whitespace()).collect();
    let line = line.to_ascii_lowercase();
    let numbered = line.strip_prefix('n').map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    let rest = numbered.unwrap_or(&line).strip_prefix(letter.to_ascii_lowercase())?;
    let (label, word) = match rest.strip_prefix('<') {
        Some(rest) => rest.split_once('>')?,
        None => rest.split_at(rest.find(|c: char| !c.is_ascii_digit())?),
    };
    let word = word.split(|c: char| !c.is_ascii_alphabetic()).next()?;
    let number = label.bytes().all(|b| b.is_ascii_digit());
    let label = if number { label.trim_start_matches('0') } else { label };
    Some((label.to_owned(), word.to_owned()))
}

/// The name that a line gives the program that begins with it.
fn name_of(line: &[u8], dialect: &Dialect) -> Option<String> {
    if dialect.family == Family::Sinumerik {
        let line = std::str::from_utf8(line).ok()?.to_ascii_uppercase();
        let name = line.strip_prefix("%_N_")?;
        let (name, _) = name.rsplit_once('_')?;
        let number = name
            .strip_prefix('L')
            .filter(|n| !n.is_empty() && !n.starts_with('0') && n.bytes().all(|b| b.is_ascii_digit()));
        return Some(number.unwrap_or(name).to_owned());
    }
    if dialect.program.names && line.starts_with(b"<") {
        let name = std::str::from_utf8(&line[1..]).ok()?.split_once('>')?.0;
        let number = name.strip_prefix('O').filter(|n| n.bytes().all(|b| b.is_ascii_digit()));
        return Some(number.map_or(name, |n| n.trim_start_matches('0')).to_owned());
    }
    let (letter, rest) = line.split_first()?;
    let sign = char::from(*letter).to_ascii_uppercase();
    let signs = [dialect.program.number, dialect.program.number_also];
    if !signs.contains(&Some(sign)) {
        return None;
    }
    let rest = rest.trim_ascii_start();
    let digits = rest.iter().take_while(|b| b.is_ascii_digit()).count();
    let digits = std::str::from_utf8(&rest[..digits]).ok()?.trim_start_matches('0');
    (!digits.is_empty()).then(|| digits.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ncc_dialects::builtin;

    #[test]
    fn names_of_files() {
        assert_eq!(stem("O{4}", "12").as_deref(), Some("O0012"));
        assert_eq!(stem("{}", "LOCH").as_deref(), Some("LOCH"));
        assert_eq!(stem("L{1}", "12").as_deref(), Some("L12"));
        assert_eq!(stem("O{4}", "LOCH"), None);
    }

    #[test]
    fn programs_between_their_marks() {
        let fanuc = builtin("fanuc").unwrap();
        let own = |text: &str| {
            program_of(text.as_bytes(), fanuc).map(|own| (text[own.start..own.end].to_owned(), own.name))
        };
        let some = |text: &str, name: Option<&str>| Some((text.to_owned(), name.map(str::to_owned)));
        assert_eq!(own("%\n(A)\nO0012(B)\nX1\n%\nrest"), some("(A)\nO0012(B)\nX1\n", Some("12")));
        assert_eq!(own("X1\nM99\n"), some("X1\nM99\n", None));
        assert_eq!(own("X1\n%\n"), None);
        let siemens = builtin("siemens").unwrap();
        let name = |line: &str| name_of(line.as_bytes(), siemens);
        assert_eq!(name("%_N_L12_SPF").as_deref(), Some("12"));
        assert_eq!(name("%_N_l012_SPF").as_deref(), Some("L012"));
        assert_eq!(name("%_N_LOCH_A_SPF").as_deref(), Some("LOCH_A"));
        assert_eq!(name("G0 X1"), None);
    }
}
