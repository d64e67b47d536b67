//! Reading dictionaries, and the ones that are built in.
//!
//! A dictionary may build on another (`base`), which is laid under it before any field is read
//! (`merge`); what is wrong is reported with its place, also if that lies in the base's text.

pub(crate) mod merge;
mod texts;

use std::ops::Range;
use std::sync::OnceLock;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use crate::caps::caps;
use crate::check::{self, Places};
use crate::codes::CodeIndex;
use crate::fault::{DialectError, DialectFault, Place, Text};
use crate::schema::Dialect;

use self::texts::{BUILTIN, IDS};

// Dictionaries as the build script has prepared them, in the order of their texts.
include!(concat!(env!("OUT_DIR"), "/dictionaries.rs"));

static DIALECTS: Shelf = Shelf::new();

/// The built-in dialects, each read when it is asked for: a call of ncc needs two of them, rarely more.
struct Shelf {
    dialects: [OnceLock<Dialect>; IDS.len()],
}

impl Shelf {
    const fn new() -> Shelf {
        Shelf { dialects: [const { OnceLock::new() }; IDS.len()] }
    }

    fn get(&self, id: &str) -> Option<&Dialect> {
        let at = IDS.iter().position(|other| *other == id)?;
        let read = || prepared(at).unwrap_or_else(|e| panic!("built-in dictionary: {e}"));
        Some(self.dialects[at].get_or_init(read))
    }
}

/// A built-in dictionary by its place among the texts, from what the build script has prepared of it. Its rows are not
/// checked at each start: a test reads every text, with all checks, and compares.
fn prepared(at: usize) -> Result<Dialect, DialectError> {
    let tables: Vec<&[u8]> = PREPARED[at].iter().map(|piece| &TABLES[piece.clone()]).collect();
    let read = rmp_serde::from_slice(&tables.concat());
    let mut dialect: Dialect = read.map_err(|e| DialectFault::Form(e.to_string()).at(None))?;
    check::spread(&mut dialect, &mut Places::default()).map_err(|(fault, _)| fault.at(None))?;
    let wrong = |wrong| DialectFault::Form(format!("{wrong:?}")).at(None);
    dialect.index = CodeIndex::of(&dialect).map_err(wrong)?;
    dialect.caps = caps(&dialect);
    Ok(dialect)
}

/// The built-in dialects, in the order of `ncc dialects`; each is read when the iterator reaches it.
pub fn builtins() -> impl Iterator<Item = &'static Dialect> {
    builtin_ids().filter_map(builtin)
}

/// Their names; none is read for that.
pub fn builtin_ids() -> impl Iterator<Item = &'static str> {
    IDS.into_iter()
}

/// A built-in dialect by its id; it is read if nobody has asked for it before.
pub fn builtin(id: &str) -> Option<&'static Dialect> {
    DIALECTS.get(id)
}

/// Name and data file of a built-in dialect, by its place among [`builtins`].
pub fn builtin_text(at: usize) -> Option<(&'static str, &'static str)> {
    BUILTIN.get(at).copied()
}

/// Name and SHA-256 of the data file of a built-in dialect, by its place among [`builtins`].
pub fn builtin_sha256(at: usize) -> Option<(&'static str, &'static [u8; 32])> {
    Some((*IDS.get(at)?, HASHES.get(at)?))
}

/// Reads a dictionary, which may build on a built-in one.
///
/// # Errors
/// The text is not a dictionary, or its rows contradict each other.
pub fn parse(text: &str) -> Result<Dialect, DialectError> {
    Texts::new(&[text]).dialect(Text::File(0))
}

/// Reads the dictionaries of a shop, which may build on built-in ones and on each other, in any order.
///
/// # Errors
/// The first fault: a text is not a dictionary, redefines a built-in dialect, builds on none or on
/// itself, or its rows contradict each other.
pub fn load(texts: &[&str]) -> Result<Vec<Dialect>, DialectError> {
    let texts = Texts::new(texts);
    let all = 0..texts.files.len();
    let ids: Vec<(String, Place)> = all.clone().map(|i| texts.id(Text::File(i))).collect::<Result<_, _>>()?;
    for (at, (id, place)) in ids.iter().enumerate() {
        fits(id, place, ids[..at].iter().map(|(other, _)| other.as_str()))?;
    }
    all.map(|i| texts.dialect(Text::File(i))).collect()
}

/// Reads one dictionary of a shop, the text of this place among all of them; faults of those on which it does not build are
/// passed over.
///
/// # Errors
/// As of [`load`]. Of two texts with one name, the later one is at fault.
pub fn load_one(texts: &[&str], at: usize) -> Result<Dialect, DialectError> {
    let texts = Texts::new(texts);
    let (id, place) = texts.id(Text::File(at))?;
    let before: Vec<String> = (0..at).filter_map(|i| Some(texts.id(Text::File(i)).ok()?.0)).collect();
    fits(&id, &place, before.iter().map(String::as_str))?;
    texts.dialect(Text::File(at))
}

/// Whether a dictionary may have this name, where others have theirs.
fn fits<'n>(id: &str, place: &Place, mut others: impl Iterator<Item = &'n str>) -> Result<(), DialectError> {
    let fault = if !is_id(id) {
        DialectFault::BadId { id: id.to_owned() }
    } else if builtin_ids().any(|b| b == id) {
        DialectFault::BuiltInId { id: id.to_owned() }
    } else if others.any(|other| other == id) {
        DialectFault::IdTwice { id: id.to_owned() }
    } else {
        return Ok(());
    };
    Err(fault.at(Some(place.clone())))
}

/// Whether a word can name a dialect.
fn is_id(id: &str) -> bool {
    id.len() >= 2
        && id.as_bytes()[0].is_ascii_alphabetic()
        && !id.ends_with('-')
        && !id.contains("--")
        && id.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-'))
}

/// The built-in texts and the given ones, laid end to end so that one number is a place.
struct Texts<'t> {
    files: &'t [&'t str],
}

impl<'t> Texts<'t> {
    fn new(files: &'t [&'t str]) -> Texts<'t> {
        Texts { files }
    }

    fn all(&self) -> impl Iterator<Item = (Text, &'t str)> {
        let built_in = BUILTIN.iter().enumerate().map(|(i, (_, text))| (Text::BuiltIn(i), *text));
        built_in.chain(self.files.iter().enumerate().map(|(i, text)| (Text::File(i), *text)))
    }

    /// A text, and where it begins.
    fn get(&self, wanted: Text) -> (usize, &'t str) {
        let mut start = 0;
        for (which, text) in self.all() {
            if which == wanted {
                return (start, text);
            }
            start += text.len() + 1;
        }
        (start, "")
    }

    /// The text in which a place lies.
    fn place(&self, span: Range<usize>) -> Option<Place> {
        let mut start = 0;
        for (which, text) in self.all() {
            if span.start <= start + text.len() {
                let end = span.end.saturating_sub(start).min(text.len());
                return Some(Place { text: which, span: span.start - start..end.max(span.start - start) });
            }
            start += text.len() + 1;
        }
        None
    }

    fn tree(&self, which: Text) -> Result<Spanned<DeTable<'t>>, DialectError> {
        let (start, text) = self.get(which);
        let tree = DeTable::parse(text).map_err(|e| self.form(&e, start))?;
        let span = tree.span();
        Ok(Spanned::new(span.start + start..span.end + start, merge::shift(tree.into_inner(), start)))
    }

    fn form(&self, error: &toml::de::Error, start: usize) -> DialectError {
        let place = error.span().and_then(|span| self.place(span.start + start..span.end + start));
        DialectFault::Form(error.message().to_owned()).at(place)
    }

    /// The name that a text defines, and its place.
    fn id(&self, which: Text) -> Result<(String, Place), DialectError> {
        self.id_of(which, self.tree(which)?.get_ref())
    }

    fn id_of(&self, which: Text, tree: &DeTable) -> Result<(String, Place), DialectError> {
        let missing = || DialectFault::Missing { field: "id" }.at(Some(Place { text: which, span: 0..0 }));
        let (id, span) = merge::key_of(tree, "id").ok_or_else(missing)?;
        Ok((id, self.place(span).ok_or_else(missing)?))
    }

    /// The text that defines a name.
    fn named(&self, id: &str) -> Option<Text> {
        let file = |i: usize| self.id(Text::File(i)).is_ok_and(|(other, _)| other == id);
        let built_in = BUILTIN.iter().position(|(b, _)| *b == id).map(Text::BuiltIn);
        built_in.or_else(|| (0..self.files.len()).find(|i| file(*i)).map(Text::File))
    }

    /// A text's tree over that of its base, and so on; `above` are the names that build on it.
    fn merged(&self, which: Text, above: &mut Vec<String>) -> Result<Spanned<DeTable<'t>>, DialectError> {
        let over = self.tree(which)?;
        let Some((base, at)) = merge::key_of(over.get_ref(), "base") else {
            return match over.get_ref().get("base") {
                Some(other) => {
                    let place = self.place(other.span());
                    Err(DialectFault::BaseNoText.at(place))
                }
                // A word about a base that there is not is reported as any other.
                None => self.lay(Spanned::new(over.span(), DeTable::new()), over),
            };
        };
        above.push(self.id_of(which, over.get_ref())?.0);
        let place = self.place(at);
        if above.contains(&base) {
            above.push(base);
            return Err(DialectFault::BaseCycle { chain: std::mem::take(above) }.at(place));
        }
        let Some(under) = self.named(&base) else {
            return Err(DialectFault::NoBase { base }.at(place));
        };
        let mut under = self.merged(under, above)?;
        for own in merge::OWN {
            under.get_mut().remove(own);
        }
        let family = |t: &DeTable| t.get("family").and_then(|f| f.get_ref().as_str().map(str::to_owned));
        if let Some(own) = over.get_ref().get("family")
            && family(over.get_ref()) != family(under.get_ref())
        {
            return Err(DialectFault::OtherFamily.at(self.place(own.span())));
        }
        self.lay(under, over)
    }

    fn lay(
        &self,
        mut under: Spanned<DeTable<'t>>,
        over: Spanned<DeTable<'t>>,
    ) -> Result<Spanned<DeTable<'t>>, DialectError> {
        let span = over.span();
        merge::merge(under.get_mut(), over.into_inner()).map_err(|(fault, at)| fault.at(self.place(at)))?;
        Ok(Spanned::new(span, under.into_inner()))
    }

    /// Reads a text's dictionary.
    fn dialect(&self, which: Text) -> Result<Dialect, DialectError> {
        let tree = self.merged(which, &mut Vec::new())?;
        let base = tree.get_ref().get("base").and_then(|base| self.place(base.span()));
        let mut places = places(tree.get_ref());
        let reported = |mut error: DialectError| {
            if error.place.as_ref().is_some_and(|place| place.text != which) {
                error.inherited_by.clone_from(&base);
            }
            error
        };
        let mut dialect =
            Dialect::deserialize(Deserializer::from(tree)).map_err(|e| reported(self.form(&e, 0)))?;
        let wrong = |(fault, at): check::Fault| reported(fault.at(at.and_then(|span| self.place(span))));
        check::spread(&mut dialect, &mut places).map_err(wrong)?;
        for (name, row) in &mut dialect.functions {
            let place = places.functions.get(name).and_then(|span| self.place(span.clone()));
            if let Some(Text::File(at)) = place.map(|place| place.text) {
                row.file = Some(at);
            }
        }
        dialect.index = check::index(&dialect, &places).map_err(wrong)?;
        check::variants(&dialect, &places).map_err(wrong)?;
        dialect.caps = caps(&dialect);
        Ok(dialect)
    }
}

/// Finds a dictionary's rows and capabilities again after its rows have been changed.
///
/// # Errors
/// Rows contradict each other.
pub fn renew(dialect: &mut Dialect) -> Result<(), DialectError> {
    let mut places = Places::default();
    let wrong = |(fault, _): check::Fault| fault.at(None);
    check::spread(dialect, &mut places).map_err(wrong)?;
    dialect.index = check::index(dialect, &places).map_err(wrong)?;
    dialect.caps = caps(dialect);
    Ok(())
}

/// Where the rows of a tree stand: the value by which each is distinguished from the others.
fn places(tree: &DeTable<'_>) -> Places {
    let rows = |table: &str| {
        let field = merge::row_key(table).unwrap_or_default();
        let rows = tree.get(table).and_then(|rows| rows.get_ref().as_array());
        let place = |row: &Spanned<DeValue<'_>>| {
            let key = row.get_ref().as_table().and_then(|row| merge::key_of(row, field));
            key.map_or_else(|| row.span(), |(_, place)| place)
        };
        rows.map(|rows| rows.iter().map(place).collect()).unwrap_or_default()
    };
    let functions = tree.get("functions").and_then(|table| table.get_ref().as_table());
    let functions = functions.into_iter().flatten();
    Places {
        functions: functions.map(|(name, _)| (name.get_ref().to_string(), name.span())).collect(),
        address: rows("address"),
        cycle: rows("cycle"),
        pattern: rows("pattern"),
        code: rows("code"),
        name: rows("name"),
        call: rows("call"),
        option: rows("option"),
        behaviour: rows("behaviour"),
        data: rows("data"),
        variant: rows("variant"),
    }
}

#[cfg(test)]
mod tests {
    use sha2::{Digest, Sha256};

    use super::*;

    #[test]
    fn built_in_dictionaries_load() {
        let ids: Vec<_> = builtins().map(|d| d.id.as_str()).collect();
        assert_eq!(ids, builtin_ids().collect::<Vec<_>>());
    }

    #[test]
    fn prepared_dictionaries_are_those_of_the_texts() {
        for (at, (id, _)) in BUILTIN.iter().enumerate() {
            let of_text = Texts::new(&[]).dialect(Text::BuiltIn(at)).unwrap_or_else(|e| panic!("{id}: {e}"));
            assert_eq!(format!("{:#?}", prepared(at).unwrap()), format!("{of_text:#?}"), "{id}");
            let (name, text) = builtin_text(at).unwrap();
            assert_eq!(builtin_sha256(at), Some((name, &Sha256::digest(text).into())), "{id}");
        }
    }

    #[test]
    fn a_dictionary_is_read_when_it_is_asked_for() {
        let shelf = Shelf::new();
        let read = || -> Vec<&str> {
            shelf.dialects.iter().filter_map(OnceLock::get).map(|d| d.id.as_str()).collect()
        };
        assert!(shelf.get("nope").is_none() && read().is_empty());
        // Its base is laid under it, and is no dialect that was asked for.
        assert_eq!(shelf.get("haas").unwrap().base.as_deref(), Some("fanuc"));
        assert_eq!(read(), ["haas"]);
        assert!(std::ptr::eq(shelf.get("haas").unwrap(), shelf.get("haas").unwrap()));
    }
}
