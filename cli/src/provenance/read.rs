//! Reads one line of a map: the document goes by, and what is not asked for is not kept.

use std::collections::BTreeMap;
use std::fmt;
use std::io::Read;

use ncc_dialects::Settings;
use ncc_driver::provenance::map::VERSION;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};

use crate::registry::DialectRegistry;

/// One of both sides, as the map names it.
#[derive(Clone, Debug, Default, Deserialize)]
pub(crate) struct Side {
    pub(crate) name: String,
    #[serde(default)]
    pub(crate) file: String,
    pub(crate) dialect: String,
    #[serde(default)]
    pub(crate) options: BTreeMap<String, String>,
    pub(crate) sha256: String,
    /// Files of called programs.
    #[serde(default)]
    pub(crate) called: Vec<CalledFile>,
}

/// A file of a called program.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct CalledFile {
    pub(crate) file: String,
    pub(crate) sha256: String,
}

/// A line's entry.
#[derive(Clone, Debug, Default, Deserialize)]
pub(crate) struct Entry {
    pub(crate) line: usize,
    pub(crate) from: String,
    #[serde(default)]
    pub(crate) source: Vec<Place>,
    #[serde(default)]
    pub(crate) also: Vec<Place>,
    #[serde(default)]
    pub(crate) events: Vec<Events>,
    #[serde(default)]
    pub(crate) more_events: u64,
    #[serde(default)]
    pub(crate) rows: Vec<usize>,
    #[serde(default)]
    pub(crate) source_rows: Vec<usize>,
}

/// A place of the source.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(crate) struct Place {
    pub(crate) start: u32,
    pub(crate) end: u32,
}

/// Events that follow one another.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct Events {
    pub(crate) first: u64,
    pub(crate) last: u64,
    pub(crate) kinds: Vec<String>,
}

/// A row of a dictionary.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct Row {
    pub(crate) id: String,
    pub(crate) dialect: String,
    pub(crate) meaning: String,
    pub(crate) source: String,
    pub(crate) sure: bool,
}

/// What was read.
#[derive(Clone, Debug, Default)]
pub(crate) struct Document {
    pub(crate) source: Side,
    pub(crate) output: Side,
    /// The line that was asked for.
    pub(crate) entry: Option<Entry>,
    pub(crate) rows: Vec<Row>,
    pub(crate) source_rows: Vec<Row>,
}

/// Reads a map for one line.
///
/// # Errors
/// It is no map, or one of another version.
pub(crate) fn read(from: impl Read, line: usize) -> Result<Document, serde_json::Error> {
    let mut json = serde_json::Deserializer::from_reader(std::io::BufReader::new(from));
    let document = json.deserialize_map(Wanted(line))?;
    json.end()?;
    Ok(document)
}

/// The document, of which one line is wanted.
struct Wanted(usize);

impl<'de> Visitor<'de> for Wanted {
    type Value = Document;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a map of a translation")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Document, A::Error> {
        let mut document = Document::default();
        let mut version = None;
        let (mut source, mut output) = (None, None);
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "version" => {
                    let found: u64 = map.next_value()?;
                    if found != VERSION {
                        return Err(A::Error::custom(format!("version {found} of maps is not known")));
                    }
                    version = Some(found);
                }
                "source" => source = Some(map.next_value()?),
                "output" => output = Some(map.next_value()?),
                "lines" => document.entry = map.next_value_seed(LineSeed(self.0))?,
                "rows" => document.rows = map.next_value()?,
                "source_rows" => document.source_rows = map.next_value()?,
                _ => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        version.ok_or_else(|| A::Error::missing_field("version"))?;
        document.source = source.ok_or_else(|| A::Error::missing_field("source"))?;
        document.output = output.ok_or_else(|| A::Error::missing_field("output"))?;
        Ok(document)
    }
}

/// The list of lines, of which one is kept.
struct LineSeed(usize);

impl<'de> DeserializeSeed<'de> for LineSeed {
    type Value = Option<Entry>;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Option<Entry>, D::Error> {
        from.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for LineSeed {
    type Value = Option<Entry>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the lines of a map")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Option<Entry>, A::Error> {
        // Entries stand in the order of their lines, from 1.
        for _ in 1..self.0 {
            if list.next_element::<IgnoredAny>()?.is_none() {
                return Ok(None);
            }
        }
        let entry: Option<Entry> = list.next_element()?;
        if let Some(entry) = entry.as_ref().filter(|entry| entry.line != self.0) {
            return Err(A::Error::custom(format!("line {} is in the place of line {}", entry.line, self.0)));
        }
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(entry)
    }
}

/// The output's dialect with the options that it was written with; `None` if there is no such dialect here.
pub(super) fn own_settings(side: &Side, known: &DialectRegistry) -> Option<Settings> {
    let mut settings = Settings::new(known.get(&side.dialect)?);
    for (option, value) in &side.options {
        settings.choose(option, value).ok()?;
    }
    Some(settings)
}
