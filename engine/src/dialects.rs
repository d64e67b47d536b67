//! Dialects that requests know: the built-in ones, and those of a shop's dictionaries.
//!
//! A dictionary lives as long as the process, as the built-in ones do, so each text is read once for all engines, and
//! their number is bounded. A dialect of a shop is named, by a request or a profile, and never recognised: a dictionary
//! that is new changes nothing for programs that do not name it.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use ncc_dialects::{Dialect, DialectError, builtin, builtin_ids, builtins, load_one};
use ncc_driver::review::verify::document::Hashed;
use ncc_driver::review::verify::hashes::{built_in, hashed};

/// Dictionaries that one process keeps at most.
pub const MOST: usize = 256;

/// Dictionaries that are kept, by their texts: of one that builds on another of its shop, with all texts of the shop.
static KEPT: Mutex<BTreeMap<Vec<String>, &'static Dialect>> = Mutex::new(BTreeMap::new());

/// The dictionaries of the last call, for the next one.
static LAST: Mutex<Option<(Vec<Dictionary>, Shop)>> = Mutex::new(None);

/// A dictionary of a shop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dictionary {
    /// The name of its file, for people.
    pub file: String,
    /// Its text.
    pub text: String,
}

/// The reason why a dictionary is not known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotKnown {
    /// It has a fault, or one that it builds on has.
    Faulty(Box<DialectError>),
    /// This process keeps [`MOST`] others.
    TooMany,
}

/// Dictionaries of a shop, read.
#[derive(Clone, Debug, Default)]
pub struct Shop {
    /// The dialects that are known.
    pub dialects: Dialects,
    /// For each dictionary the reason why it is not known, if it is not.
    pub not_known: Vec<Option<NotKnown>>,
}

/// A dialect of a shop.
#[derive(Clone, Debug)]
struct Own {
    dialect: &'static Dialect,
    hashed: Hashed,
}

/// The built-in dialects, and those of a shop.
#[derive(Clone, Debug, Default)]
pub struct Dialects {
    own: Arc<[Own]>,
}

impl Shop {
    /// Reads dictionaries, which may build on built-in ones and on each other.
    pub fn of(dictionaries: Vec<Dictionary>) -> Shop {
        let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, shop)) = last.as_ref().filter(|(before, _)| *before == dictionaries) {
            return shop.clone();
        }
        let shop = Shop::read(&dictionaries);
        *last = Some((dictionaries, shop.clone()));
        shop
    }

    fn read(dictionaries: &[Dictionary]) -> Shop {
        let texts: Vec<&str> = dictionaries.iter().map(|own| own.text.as_str()).collect();
        let faulty = |fault| NotKnown::Faulty(Box::new(fault));
        let read: Vec<Result<Dialect, NotKnown>> =
            (0..texts.len()).map(|at| load_one(&texts, at).map_err(faulty)).collect();
        let (mut own, mut not_known) = (Vec::new(), Vec::new());
        for (at, dictionary) in dictionaries.iter().enumerate() {
            let kept =
                read[at].as_ref().map_err(NotKnown::clone).and_then(|dialect| kept(dialect, at, &texts));
            not_known.push(kept.as_ref().err().cloned());
            own.extend(kept.ok().map(|dialect| {
                let hashed = hashed(&dialect.id, Some(dictionary.file.clone()), dictionary.text.as_bytes());
                Own { dialect, hashed }
            }));
        }
        Shop { dialects: Dialects { own: own.into() }, not_known }
    }
}

/// The same dictionary, kept as long as the process lives; its text has this place among those of its shop.
fn kept(dialect: &Dialect, at: usize, texts: &[&str]) -> Result<&'static Dialect, NotKnown> {
    let is_alone = dialect.base.as_deref().is_none_or(|base| builtin(base).is_some());
    let others = if is_alone { &[] } else { texts };
    let key: Vec<String> = [texts[at]].iter().chain(others).map(|text| (*text).to_owned()).collect();
    let mut all = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(dialect) = all.get(&key) {
        return Ok(dialect);
    }
    if all.len() >= MOST {
        return Err(NotKnown::TooMany);
    }
    let dialect: &'static Dialect = Box::leak(Box::new(dialect.clone()));
    all.insert(key, dialect);
    Ok(dialect)
}

impl Dialects {
    /// A dialect by its name.
    pub fn get(&self, id: &str) -> Option<&'static Dialect> {
        builtin(id).or_else(|| self.own(id).map(|own| own.dialect))
    }

    /// All of them, the built-in ones first.
    pub fn all(&self) -> impl Iterator<Item = &'static Dialect> {
        builtins().chain(self.own.iter().map(|own| own.dialect))
    }

    /// Their names, in the same order.
    pub fn ids(&self) -> impl Iterator<Item = &'static str> {
        builtin_ids().chain(self.own.iter().map(|own| own.dialect.id.as_str()))
    }

    /// Hashes of the texts that a dialect is made of: its own, then its base's and so on; empty of one that is not known.
    pub fn hashes(&self, id: &str) -> Vec<Hashed> {
        let mut all = Vec::new();
        let mut next = self.get(id);
        while let Some(dialect) = next {
            let own = self.own(&dialect.id).map(|own| own.hashed.clone());
            all.extend(own.or_else(|| built_in(&dialect.id)));
            // A base of itself is refused where dictionaries are read.
            next = dialect.base.as_deref().and_then(|base| self.get(base));
        }
        all
    }

    fn own(&self, id: &str) -> Option<&Own> {
        self.own.iter().find(|own| own.dialect.id == id)
    }
}
