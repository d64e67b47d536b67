//! The dialects that a call knows: the built-in ones, and those of the files named by `--dialect`.
//!
//! A dictionary of a shop lives as long as the process, as the built-in ones do. What is wrong with it
//! is reported here, at its place in the file. Not here: what a dictionary means.

pub mod dictionary_test;
mod functions;
pub(crate) mod recognised;

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::{fs, io};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::{
    Dialect, DialectError, DialectFault, ElsewhereRow, FunctionHost, Place, Text, builtin, builtin_ids,
    builtins, load,
};
use ncc_driver::functions::Functions;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::render::dictionary::fault::{Fault, boxed, fault};
use ncc_driver::review::verify::document::Hashed;
use ncc_driver::review::verify::hashes::{built_in, hashed};
use ncc_ir::canon::Units;
use ncc_ir::expr::num::Num;
use ncc_machines::reading::Side;

use crate::args::typed::{MCode, is_name};
use crate::project::projects::Projects;

/// A dictionary that was made of the one at an address, for one side.
type Derived = (usize, Side, &'static Dialect);

/// Every dialect that can be named in this call. Of the built-in ones, those are read that are asked for.
#[derive(Clone, Debug, Default)]
pub struct DialectRegistry {
    shops: Vec<&'static Dialect>,
    /// Files of those, and their texts, in the same order.
    texts: Vec<(PathBuf, String)>,
    /// Folders in which called programs are looked for.
    folders: Vec<PathBuf>,
    /// Whether every program is taken for a milling program.
    all_for_mills: bool,
    /// Whether ncc's own readings are taken where a program has two.
    assumes: bool,
    /// Units of lengths of sources that never state them, as far as the user has stated them.
    units: Option<Units>,
    /// What becomes of M codes that dialects do not know.
    m_codes: Vec<MCode>,
    /// Programs whose calls are left out.
    calls_left_out: Vec<String>,
    /// Whether programs of the user may be started for custom functions.
    run_functions: bool,
    /// Variables of definition files.
    variables_elsewhere: Vec<ElsewhereRow>,
    /// Project files; `None` if none counts.
    projects: Option<Arc<Projects>>,
    /// Dictionaries with these put in, each with the address of the one that it was made of.
    derived: Arc<Mutex<Vec<Derived>>>,
}

impl DialectRegistry {
    /// The built-in dialects.
    pub fn built_in() -> DialectRegistry {
        DialectRegistry::default()
    }

    /// Lets programs be started for the custom functions of dictionaries that are added from here on.
    pub fn run_functions(&mut self) {
        self.run_functions = true;
    }

    /// Gives each custom function the folder of its dictionary, and, where the user has agreed, somebody who starts programs.
    fn bind_functions(&self, dialect: &mut Dialect, files: &[PathBuf]) -> io::Result<()> {
        for row in dialect.functions.values_mut() {
            let file = row.file.and_then(|at| files.get(at)).map_or(Path::new(""), PathBuf::as_path);
            let folder = std::path::absolute(file)?;
            row.folder = folder.parent().unwrap_or(&folder).to_owned();
        }
        if self.run_functions && !dialect.functions.is_empty() {
            let host = Functions::new(Box::new(functions::Processes));
            dialect.function_host = Some(FunctionHost::new(Arc::new(host)));
        }
        Ok(())
    }

    /// Adds what files define, and gives it. What is read is kept as long as the process lives.
    ///
    /// # Errors
    /// A file cannot be read, or is no dictionary; with `out`, the latter has been reported there, with
    /// its place, and the problem has no words of its own.
    pub fn add(
        &mut self,
        files: &[PathBuf],
        out: Option<&mut dyn WriteColor>,
    ) -> Result<Vec<&'static Dialect>, Problem> {
        if files.is_empty() {
            return Ok(Vec::new());
        }
        let texts = files.iter().map(|file| read(file)).collect::<Result<Vec<_>, _>>()?;
        let borrowed: Vec<&str> = texts.iter().map(String::as_str).collect();
        let loaded = load(&borrowed).and_then(|loaded| match verbs_named(&loaded) {
            Some(at) => Err(verb(at, &loaded[at].id)),
            None => Ok(loaded),
        });
        match loaded {
            Ok(mut loaded) => {
                for dialect in &mut loaded {
                    self.bind_functions(dialect, files)
                        .map_err(|e| Problem::file("read", &dialect.id, &e))?;
                }
                let loaded: Vec<&'static Dialect> =
                    loaded.into_iter().map(|dialect| &*Box::leak(Box::new(dialect))).collect();
                self.shops.extend(&loaded);
                self.texts.extend(files.iter().cloned().zip(texts));
                Ok(loaded)
            }
            Err(error) => {
                let names: Vec<String> = files.iter().map(|f| f.display().to_string()).collect();
                Err(report_fault(&error, &names, &borrowed, out))
            }
        }
    }

    /// Says where called programs are looked for.
    ///
    /// # Errors
    /// One is no folder.
    pub fn look_in(&mut self, folders: &[PathBuf]) -> Result<(), Problem> {
        if let Some(none) = folders.iter().find(|folder| !folder.is_dir()) {
            let message = format!("-I {}: there is no such folder", none.display());
            return Err(Problem::usage(
                message,
                "name a folder with called programs, each in a file of its own",
            ));
        }
        self.folders = folders.to_vec();
        Ok(())
    }

    /// Says in which units sources are that never state them.
    pub fn state_units(&mut self, units: Option<Units>) {
        self.units = units;
    }

    /// Units of sources that never state them, as far as the user has stated them.
    pub fn units(&self) -> Option<Units> {
        self.units
    }

    /// Says what becomes of M codes that dialects do not know.
    pub fn state_m_codes(&mut self, codes: &[MCode]) {
        self.m_codes = codes.to_vec();
    }

    /// What becomes of M codes that dialects do not know.
    pub fn m_codes(&self) -> &[MCode] {
        &self.m_codes
    }

    /// Says which programs' calls are left out.
    pub fn leave_calls_out(&mut self, names: &[String]) {
        self.calls_left_out = names.to_vec();
    }

    /// Programs whose calls are left out.
    pub fn calls_left_out(&self) -> &[String] {
        &self.calls_left_out
    }

    /// Says which variables no program defines.
    pub(crate) fn state_variables(&mut self, values: &[(String, Option<Num>)]) {
        let row = |(name, holds): &(String, Option<Num>)| ElsewhereRow {
            name: name.to_ascii_uppercase(),
            left_out: holds.is_none(),
        };
        self.variables_elsewhere = values.iter().map(row).collect();
    }

    /// Variables that no program defines.
    pub(crate) fn variables_elsewhere(&self) -> &[ElsewhereRow] {
        &self.variables_elsewhere
    }

    /// A dictionary with something put in, made once for each and side; it lives as long as the process.
    pub(crate) fn derived(
        &self,
        of: &'static Dialect,
        side: Side,
        put: impl FnOnce(&mut Dialect),
    ) -> &'static Dialect {
        let address = std::ptr::from_ref(of) as usize;
        let mut made = self.derived.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((.., dialect)) = made.iter().find(|(from, on, _)| (*from, *on) == (address, side)) {
            return dialect;
        }
        let mut dialect = of.clone();
        put(&mut dialect);
        let dialect: &'static Dialect = Box::leak(Box::new(dialect));
        made.push((address, side, dialect));
        dialect
    }

    /// Lets project files count.
    pub(crate) fn use_projects(&mut self) {
        self.projects = Some(Arc::default());
    }

    /// Project files, where they count.
    pub(crate) fn projects(&self) -> Option<&Projects> {
        self.projects.as_deref()
    }

    /// Folders in which called programs are looked for.
    pub fn folders(&self) -> &[PathBuf] {
        &self.folders
    }

    /// Takes every program for a milling program, whatever it looks like.
    pub fn assume_milling(&mut self) {
        self.all_for_mills = true;
    }

    /// Takes ncc's own readings where a program has two.
    pub fn assume_readings(&mut self) {
        self.assumes = true;
    }

    /// Whether ncc's own readings are taken where a program has two.
    pub fn assumes(&self) -> bool {
        self.assumes
    }

    /// Whether every program is taken for a milling program.
    pub fn all_for_mills(&self) -> bool {
        self.all_for_mills
    }

    /// All of them, the built-in ones first. All are read for that.
    pub fn all(&self) -> Vec<&'static Dialect> {
        builtins().chain(self.shops.iter().copied()).collect()
    }

    /// Their names, in the same order.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        builtin_ids().chain(self.shops.iter().map(|d| d.id.as_str()))
    }

    /// A dialect by its name.
    pub fn get(&self, id: &str) -> Option<&'static Dialect> {
        builtin(id).or_else(|| self.shops.iter().find(|d| d.id == id).copied())
    }

    /// A dialect by its name.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn dialect(&self, id: &str) -> Result<&'static Dialect, Problem> {
        self.get(id).ok_or_else(|| {
            let near = self.names().find(|name| name.eq_ignore_ascii_case(id) || close(name, id));
            let help = match near {
                Some(name) => format!("did you mean {name}? there are: {}", self.ids()),
                None => format!("there are: {}", self.ids()),
            };
            let mut problem = Problem::usage(format!("there is no dialect `{id}`"), help);
            if std::path::Path::new(id).is_file() {
                problem.help.push(format!("for the dictionary in {id}: --dialect {id}, and the name in it"));
            }
            problem
        })
    }

    /// Hashes of the texts that a dialect is made of: its own, then its base's and so on; each with the dialect's
    /// name and, of a shop's, its file.
    pub fn hashes(&self, id: &str) -> Vec<Hashed> {
        let mut all = Vec::new();
        let mut next = self.get(id);
        while let Some(dialect) = next {
            let shop = self.shops.iter().position(|shop| shop.id == dialect.id);
            let own = match shop.and_then(|at| self.texts.get(at)) {
                Some((file, text)) => {
                    Some(hashed(&dialect.id, Some(file.display().to_string()), text.as_bytes()))
                }
                None => built_in(&dialect.id),
            };
            all.extend(own);
            // A base of itself is refused where dictionaries are read.
            next = dialect.base.as_deref().and_then(|base| self.get(base));
        }
        all
    }

    /// Their names, for a message.
    pub fn ids(&self) -> String {
        self.names().collect::<Vec<_>>().join(", ")
    }
}

/// Whether the arguments have `--run-functions`, before they are parsed.
pub fn runs_functions(arguments: &[OsString]) -> bool {
    arguments.iter().skip(1).take_while(|a| *a != "--").any(|a| a == "--run-functions")
}

/// The files that `--dialect` names, before the arguments are parsed.
pub fn files(arguments: &[OsString]) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut arguments = arguments.iter().skip(1).take_while(|a| *a != "--");
    while let Some(argument) = arguments.next() {
        match argument.to_str() {
            Some("--dialect") => files.extend(arguments.next().map(PathBuf::from)),
            Some(text) => files.extend(text.strip_prefix("--dialect=").map(PathBuf::from)),
            None => {}
        }
    }
    files
}

fn read(file: &Path) -> Result<String, Problem> {
    let shown = file.display().to_string();
    let bytes = fs::read(file).map_err(|e| Problem::file("read", &shown, &e))?;
    String::from_utf8(bytes).map_err(|_| Problem {
        exit: Exit::File,
        message: format!("cannot read {shown}: it is not UTF-8"),
        help: vec!["a dictionary is a TOML file, in UTF-8".to_owned()],
    })
}

/// The first dialect whose name means something else on the command line.
fn verbs_named(loaded: &[Dialect]) -> Option<usize> {
    use clap::CommandFactory;
    let command = crate::args::Cli::command();
    let taken = |id: &str| {
        ["auto", "help", "to"].contains(&id) || command.get_subcommands().any(|verb| verb.get_name() == id)
    };
    loaded.iter().position(|dialect| taken(&dialect.id) || !is_name(&dialect.id))
}

fn verb(at: usize, id: &str) -> DialectError {
    let place = Place { text: Text::File(at), span: 0..0 };
    DialectError { fault: DialectFault::BadId { id: id.to_owned() }, place: Some(place), inherited_by: None }
}

/// Whether two words differ by one letter at most.
fn close(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let (short, long) = if a.len() <= b.len() { (a, b) } else { (b, a) };
    let same = short.iter().zip(long).take_while(|(x, y)| x == y).count();
    let rest = &short[same..];
    match long.len() - short.len() {
        0 => rest.is_empty() || rest[1..] == long[same + 1..],
        1 => *rest == long[same + 1..],
        _ => false,
    }
}

/// Tells what is wrong with a dictionary: as a box with the offending row where `out` can take one,
/// else in the problem's own words.
fn report_fault(
    error: &DialectError,
    names: &[String],
    texts: &[&str],
    out: Option<&mut dyn WriteColor>,
) -> Problem {
    let silent = Problem { exit: Exit::Usage, message: String::new(), help: Vec::new() };
    if let Some(out) = out
        && boxed(error, names, texts, out).is_ok_and(|has_place| has_place)
    {
        return silent;
    }
    let Fault { place, inherited_by, words } = fault(error, names, texts);
    let at = place.map(|(name, line, column)| format!("{name}:{line}:{column}: ")).unwrap_or_default();
    let inherited = inherited_by.map(|name| format!(" (the base of {name})")).unwrap_or_default();
    Problem { message: format!("{at}{}{inherited}", words.headline), help: words.helps, ..silent }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_among_arguments() {
        let args = |line: &str| line.split(' ').map(OsString::from).collect::<Vec<_>>();
        let found = files(&args("ncc shop - a.nc --dialect a.toml --dialect=b.toml -- --dialect c.toml"));
        assert_eq!(found, [PathBuf::from("a.toml"), PathBuf::from("b.toml")]);
    }

    #[test]
    fn a_fault_is_told_in_one_line_where_there_is_no_box() {
        let text =
            "id = \"shop\"\ntitle = \"\"\nbase = \"fanuc\"\n[[cycle]]\ncode = \"G81\"\nremove = true\n";
        let error = load(&[text]).unwrap_err();
        let problem = report_fault(&error, &["shop.toml".to_owned()], &[text], None);
        assert!(problem.message.starts_with("fanuc (built in):"), "{}", problem.message);
        assert!(problem.message.ends_with(": row G81: has no [[cycle]] row (the base of shop.toml)"));
        let text = "id = \"shop\"\ntitle = \"\"\nbase = \"fanuc\"\n[block]\nblank = true\n";
        let problem = report_fault(&load(&[text]).unwrap_err(), &["shop.toml".to_owned()], &[text], None);
        assert!(problem.message.starts_with("shop.toml:5:1: unknown field `blank`"), "{}", problem.message);
    }
}
