//! A project file: which programs of a folder are for which machines.
//!
//! ```toml
//! [[programs]]
//! files = "old/*.nc"
//! machine = "haas-vf2.toml"
//! to = { dialect = "siemens" }
//! ```
//!
//! A machine in the file has the keys of a profile, and is read and checked as one (`profile`). Paths and patterns are
//! relative to the folder of the file; this reader opens none of them.

use std::fmt;
use std::ops::Range;

use globset::{GlobBuilder, GlobMatcher};
use ncc_dialects::Dialect;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use toml::Spanned;

use crate::profile::{Profile, form};
use crate::schema::Schema;
use crate::table::Key;
use crate::takes::Takes;
use crate::wrong::{PatternFault, ProfileError, Wrong};

/// Name of the file.
pub const NAME: &str = "ncc.toml";

/// Keys of a row.
pub const KEYS: &[Key] = &[
    Key { name: "files", takes: Takes::Patterns, about: "The programs that the row is about." },
    Key {
        name: "machine",
        takes: Takes::Machine,
        about: "The machine that they were written for, or that reads them.",
    },
    Key { name: "to", takes: Takes::Machine, about: "The machine that they are translated for." },
    Key {
        name: "include",
        takes: Takes::Folders,
        about: "Where called programs are looked for, after the folders of `-I`.",
    },
    Key {
        name: "output",
        takes: Takes::Folder,
        about: "Where translations go without `-o`. It is made where there is none.",
    },
    Key {
        name: "stock",
        takes: Takes::Body,
        about: "The raw part that `ncc simulate` cuts, in mm, from the work offset in which the program cuts first.",
    },
    Key { name: "fixtures", takes: Takes::Bodies, about: "What holds it, and nothing may touch; likewise." },
    Key { name: "table", takes: Takes::Number, about: "Z of the table, mm; likewise." },
];

/// A project file that has been read and checked.
#[derive(Clone, Debug)]
pub struct Project {
    /// Its rows, in the order of the file.
    pub rows: Vec<Programs>,
}

/// A row: programs, and what is stated of them.
#[derive(Clone, Debug)]
pub struct Programs {
    /// Which programs; at least one pattern.
    pub files: Vec<Pattern>,
    /// The machine that they were written for.
    pub machine: Option<MachineRef>,
    /// The machine to translate for.
    pub to: Option<MachineRef>,
    /// Folders of called programs.
    pub include: Vec<Spanned<String>>,
    /// The folder of the outputs.
    pub output: Option<Spanned<String>>,
    /// The raw part, as it is written.
    pub stock: Option<Spanned<String>>,
    /// Fixtures, as they are written.
    pub fixtures: Vec<Spanned<String>>,
    /// Z of the table, mm.
    pub table: Option<Spanned<f64>>,
}

/// A pattern of file names, relative to the folder of the file. Small letters count as capitals.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// As it is written, with its place.
    pub text: Spanned<String>,
    path: GlobMatcher,
    /// Its last part, for a name without folders.
    name: GlobMatcher,
}

/// A machine of a row.
#[derive(Clone, Debug)]
pub enum MachineRef {
    /// A shipped profile's name, or a file.
    Named(Spanned<String>),
    /// The profile itself, with its place.
    Inline(Box<Profile>, Range<usize>),
}

impl Project {
    /// Reads a project file. `dialect` finds a dictionary by its name.
    ///
    /// # Errors
    /// Everything that is wrong with it, in the order of the file; only the first fault of its form.
    pub fn parse(
        text: &str,
        dialect: &dyn Fn(&str) -> Option<&'static Dialect>,
    ) -> Result<Project, Vec<ProfileError>> {
        let file: File = toml::from_str(text).map_err(|error| vec![form(&error, text)])?;
        if file.programs.is_empty() {
            return Err(vec![ProfileError::new(Wrong::NoRows, 0..0)]);
        }
        let mut wrong = Vec::new();
        let rows = file.programs.into_iter().map(|row| row.checked(dialect, &mut wrong)).collect();
        if wrong.is_empty() {
            return Ok(Project { rows });
        }
        wrong.sort_by_key(|error| error.span.start);
        Err(wrong)
    }

    /// The row of a program, by its path from the folder of the file, with `/` between folders.
    ///
    /// # Errors
    /// Two rows match it.
    pub fn row(&self, path: &str) -> Result<Option<usize>, ProfileError> {
        let mut found: Option<(usize, Range<usize>)> = None;
        for (at, row) in self.rows.iter().enumerate() {
            let Some(pattern) = row.files.iter().find(|pattern| pattern.matches(path)) else { continue };
            if let Some((_, first)) = found {
                let wrong = Wrong::TwoRows { program: path.to_owned() };
                return Err(ProfileError {
                    related: Some(first),
                    ..ProfileError::new(wrong, pattern.text.span())
                });
            }
            found = Some((at, pattern.text.span()));
        }
        Ok(found.map(|(at, _)| at))
    }

    /// The row of a program of which only the name is known, without folders: the one that alone can be about it.
    pub fn row_by_name(&self, name: &str) -> Option<usize> {
        let mut fit =
            self.rows.iter().enumerate().filter(|(_, row)| row.files.iter().any(|p| p.name.is_match(name)));
        let (at, _) = fit.next()?;
        fit.next().is_none().then_some(at)
    }
}

impl Pattern {
    /// Whether it matches a path from the folder of the file.
    pub fn matches(&self, path: &str) -> bool {
        self.path.is_match(path)
    }

    fn of(text: Spanned<String>) -> Result<Pattern, ProfileError> {
        let wrong = |why: PatternFault| ProfileError::new(Wrong::Pattern { why }, text.span());
        let own = text.get_ref().strip_prefix("./").unwrap_or(text.get_ref());
        if own.is_empty() {
            return Err(wrong(PatternFault::Empty));
        }
        if own.contains('\\') {
            return Err(wrong(PatternFault::Backslash));
        }
        if own.starts_with('/')
            || own.as_bytes().get(1) == Some(&b':')
            || own.split('/').any(|part| part == "..")
        {
            return Err(wrong(PatternFault::Outside));
        }
        let glob = |pattern: &str| {
            let glob = GlobBuilder::new(pattern).literal_separator(true).case_insensitive(true).build();
            glob.map(|glob| glob.compile_matcher())
                .map_err(|error| wrong(PatternFault::Unread { reader: error.kind().to_string() }))
        };
        let path = glob(own)?;
        // Where the last part alone is no pattern, as of `{a/b,c}`, no name alone matches.
        let last = own.rsplit('/').next().unwrap_or(own);
        let name = glob(last).unwrap_or_else(|_| path.clone());
        Ok(Pattern { text, path, name })
    }
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default)]
    programs: Vec<Row>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    files: Texts,
    machine: Option<Spanned<Machine>>,
    to: Option<Spanned<Machine>>,
    #[serde(default)]
    include: Texts,
    output: Option<Spanned<String>>,
    stock: Option<Spanned<String>>,
    #[serde(default)]
    fixtures: Texts,
    table: Option<Spanned<f64>>,
}

impl Row {
    fn checked(
        self,
        dialect: &dyn Fn(&str) -> Option<&'static Dialect>,
        wrong: &mut Vec<ProfileError>,
    ) -> Programs {
        let mut machine = |machine: Option<Spanned<Machine>>| {
            let machine = machine?;
            let span = machine.span();
            match machine.into_inner() {
                Machine::Named(name) => Some(MachineRef::Named(Spanned::new(span, name))),
                Machine::Inline(mut schema) => {
                    if schema.id.get_ref().is_empty() {
                        schema.id = Spanned::new(schema.id.span(), NAME.to_owned());
                    }
                    if schema.title.is_empty() {
                        schema.title = format!("machine of {NAME}");
                    }
                    match Profile::of(*schema, dialect) {
                        Ok(profile) => Some(MachineRef::Inline(Box::new(profile), span)),
                        Err(errors) => {
                            wrong.extend(errors);
                            None
                        }
                    }
                }
            }
        };
        let (from, to) = (machine(self.machine), machine(self.to));
        let mut files = Vec::new();
        for pattern in self.files.texts {
            match Pattern::of(pattern) {
                Ok(pattern) => files.push(pattern),
                Err(error) => wrong.push(error),
            }
        }
        if files.is_empty() && wrong.is_empty() {
            let why = PatternFault::NoneInList;
            wrong.push(ProfileError::new(Wrong::Pattern { why }, self.files.span));
        }
        Programs {
            files,
            machine: from,
            to,
            include: self.include.texts,
            output: self.output,
            stock: self.stock,
            fixtures: self.fixtures.texts,
            table: self.table,
        }
    }
}

/// A text or a list of texts, with their places.
#[derive(Default)]
struct Texts {
    texts: Vec<Spanned<String>>,
    span: Range<usize>,
}

enum OneOrMany {
    One(String),
    Many(Vec<Spanned<String>>),
}

impl<'de> Deserialize<'de> for Texts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Texts, D::Error> {
        let own = Spanned::<OneOrMany>::deserialize(deserializer)?;
        let span = own.span();
        let texts = match own.into_inner() {
            OneOrMany::One(text) => vec![Spanned::new(span.clone(), text)],
            OneOrMany::Many(texts) => texts,
        };
        Ok(Texts { texts, span })
    }
}

impl<'de> Deserialize<'de> for OneOrMany {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<OneOrMany, D::Error> {
        struct Any;
        impl<'de> Visitor<'de> for Any {
            type Value = OneOrMany;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(Takes::Texts.expected())
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<OneOrMany, E> {
                Ok(OneOrMany::One(text.to_owned()))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<OneOrMany, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(list)).map(OneOrMany::Many)
            }
        }
        deserializer.deserialize_any(Any)
    }
}

/// A machine as it is written.
enum Machine {
    Named(String),
    Inline(Box<Schema>),
}

impl<'de> Deserialize<'de> for Machine {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Machine, D::Error> {
        struct Any;
        impl<'de> Visitor<'de> for Any {
            type Value = Machine;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(Takes::Machine.expected())
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Machine, E> {
                Ok(Machine::Named(text.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Machine, A::Error> {
                let schema = Schema::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Machine::Inline(Box::new(schema)))
            }
        }
        deserializer.deserialize_any(Any)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ncc_dialects::builtin;

    fn read(text: &str) -> Result<Project, Vec<ProfileError>> {
        Project::parse(text, &builtin)
    }

    #[test]
    fn the_keys_are_those_of_a_row() {
        let Err(wrong) = read("[[programs]]\nfiles = \"*\"\nnothing = 1\n") else { panic!("a key too many") };
        let names: Vec<String> = KEYS.iter().map(|key| format!("`{}`", key.name)).collect();
        let message = format!("unknown field `nothing`, expected one of {}", names.join(", "));
        assert_eq!(wrong[0].wrong, Wrong::Form { message });
    }

    #[test]
    fn examples_of_the_document_are_project_files() {
        let document = include_str!("../../docs/book/src/reference/project-file.md");
        let examples: Vec<&str> =
            document.split("```toml\n").skip(1).filter_map(|e| e.split("```").next()).collect();
        assert_eq!(examples.len(), 2);
        for example in examples {
            assert!(read(example).is_ok(), "{:?}\n{example}", read(example));
        }
    }

    #[test]
    fn patterns_match_paths_below_the_file() {
        let text = "[[programs]]\nfiles = [\"*.nc\", \"old/*.NC\", \"./deep/**/{a,b}[0-9].nc\"]\n";
        let project = read(text).expect("a project");
        for (path, matches) in [
            ("a.nc", true),
            ("A.NC", true),
            ("new/a.nc", false),
            ("old/a.nc", true),
            ("old/sub/a.nc", false),
            ("deep/a1.nc", true),
            ("deep/x/y/b2.nc", true),
            ("deep/c1.nc", false),
            (".nc", true),
        ] {
            assert_eq!(project.row(path).expect("one row").is_some(), matches, "{path}");
        }
        assert_eq!((project.row_by_name("b7.nc"), project.row_by_name("b7.mpf")), (Some(0), None));
    }

    #[test]
    fn a_machine_in_the_file_is_a_profile() {
        let text = "[[programs]]\nfiles = \"*\"\nto = \"haas-vf2\"\n[programs.machine]\ndialect = \"fanuc\"\n\
                    [programs.machine.power_on]\nunits = \"inch\"\n[[programs.machine.tool]]\nnumber = 3\n";
        let project = read(text).expect("a project");
        let Some(MachineRef::Inline(profile, _)) = &project.rows[0].machine else { panic!("a profile") };
        assert_eq!((profile.id(), profile.dialect.id.as_str()), ("ncc.toml", "fanuc"));
        let units = profile.rows()[0].facts[0].clone();
        assert_eq!((units.value.as_deref(), &text[units.span]), (Some("inch"), "\"inch\""));
        assert!(matches!(&project.rows[0].to, Some(MachineRef::Named(name)) if name.get_ref() == "haas-vf2"));
    }

    #[test]
    fn what_is_wrong_has_its_place() {
        let row = "[[programs]]\nfiles = ";
        for (text, code, at) in [
            (String::new(), 718, ""),
            ("[programs]\n".to_owned(), 701, "[programs]"),
            (format!("{row}[]\n"), 715, "[]"),
            (format!("{row}\"a[\"\n"), 715, "\"a[\""),
            (format!("{row}\"../a\"\n"), 715, "\"../a\""),
            (format!("{row}\"/a\"\n"), 715, "\"/a\""),
            (format!("{row}'a\\b'\n"), 715, "'a\\b'"),
            (format!("{row}\"*\"\nmachine = {{ dialect = \"fanuk\" }}\n"), 702, "\"fanuk\""),
            (
                format!("{row}\"*\"\nmachine = {{ dialect = \"fanuc\", options = {{ peck = 1 }} }}\n"),
                703,
                "peck",
            ),
            (format!("{row}\"*\"\nmachine = {{ dialect = \"fanuc\", unit = 1 }}\n"), 701, "unit"),
            (format!("{row}\"*\"\nmachine = 5\n"), 701, "5"),
        ] {
            let Err(wrong) = read(&text) else { panic!("{text} is no project") };
            assert_eq!((wrong[0].wrong.code(), &text[wrong[0].span.clone()]), (code, at), "{text}");
        }
        let two = format!("{row}\"*.nc\"\n{row}\"a.*\"\n");
        let wrong = read(&two).expect("a project").row("a.nc").expect_err("two rows");
        assert_eq!((wrong.wrong.code(), &two[wrong.span]), (716, "\"a.*\""));
        assert_eq!(&two[wrong.related.expect("the first")], "\"*.nc\"");
    }
}
