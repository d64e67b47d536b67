//! A fact of a profile: a value, or nothing, with its source.
//!
//! A fact is written as a plain value (`5`, `"mm"`, `true`) or as a table
//! (`{ value = 5, source = "data sheet", assumed = true }`). The empty text `""` and a key that is
//! left out are one thing: not stated. Nothing here fills a fact in.

use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

use serde::de::value::{BoolDeserializer, F64Deserializer, I64Deserializer, StrDeserializer};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, Deserialize, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor};

use crate::takes::Takes;

/// A fact that may be stated, with its place in the file.
#[derive(Clone, Debug)]
pub struct Fact<T> {
    /// The value; `None` is not stated.
    pub value: Option<T>,
    /// The manual and its page, or another source; empty if the profile does not tell.
    pub source: String,
    /// Whether the profile itself marks it as assumed.
    pub assumed: bool,
    /// Its place in the file, in bytes.
    pub span: Range<usize>,
}

impl<T> Default for Fact<T> {
    fn default() -> Fact<T> {
        Fact { value: None, source: String::new(), assumed: false, span: 0..0 }
    }
}

impl<T: Copy> Fact<T> {
    /// The value.
    pub fn get(&self) -> Option<T> {
        self.value
    }
}

/// What a fact is made of, without its place.
struct Said<T> {
    value: Option<T>,
    source: String,
    assumed: bool,
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Fact<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Fact<T>, D::Error> {
        let spanned = toml::Spanned::<Said<T>>::deserialize(deserializer)?;
        let span = spanned.span();
        let Said { value, source, assumed } = spanned.into_inner();
        Ok(Fact { value, source, assumed, span })
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Said<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Said<T>, D::Error> {
        deserializer.deserialize_any(SaidVisitor(PhantomData))
    }
}

struct SaidVisitor<T>(PhantomData<T>);

/// The table form of a fact.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "T: Deserialize<'de>"))]
struct Table<T> {
    #[serde(default = "nothing")]
    value: Plain<T>,
    #[serde(default)]
    source: String,
    #[serde(default)]
    assumed: bool,
}

fn nothing<T>() -> Plain<T> {
    Plain(None)
}

/// A value, or the empty text for none.
struct Plain<T>(Option<T>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Plain<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Plain<T>, D::Error> {
        deserializer.deserialize_any(PlainVisitor(PhantomData))
    }
}

struct PlainVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for PlainVisitor<T> {
    type Value = Plain<T>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(Takes::Fact.expected())
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Plain<T>, E> {
        if text.is_empty() {
            return Ok(Plain(None));
        }
        let deserializer: StrDeserializer<E> = text.into_deserializer();
        T::deserialize(deserializer).map(|value| Plain(Some(value)))
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Plain<T>, E> {
        let deserializer: I64Deserializer<E> = number.into_deserializer();
        T::deserialize(deserializer).map(|value| Plain(Some(value)))
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<Plain<T>, E> {
        let deserializer: F64Deserializer<E> = number.into_deserializer();
        T::deserialize(deserializer).map(|value| Plain(Some(value)))
    }

    fn visit_bool<E: de::Error>(self, yes: bool) -> Result<Plain<T>, E> {
        let deserializer: BoolDeserializer<E> = yes.into_deserializer();
        T::deserialize(deserializer).map(|value| Plain(Some(value)))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Plain<T>, A::Error> {
        T::deserialize(SeqAccessDeserializer::new(list)).map(|value| Plain(Some(value)))
    }
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for SaidVisitor<T> {
    type Value = Said<T>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(Takes::Fact.expected())
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Said<T>, E> {
        PlainVisitor(PhantomData).visit_str(text).map(Said::from)
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Said<T>, E> {
        PlainVisitor(PhantomData).visit_i64(number).map(Said::from)
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<Said<T>, E> {
        PlainVisitor(PhantomData).visit_f64(number).map(Said::from)
    }

    fn visit_bool<E: de::Error>(self, yes: bool) -> Result<Said<T>, E> {
        PlainVisitor(PhantomData).visit_bool(yes).map(Said::from)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Said<T>, A::Error> {
        PlainVisitor(PhantomData).visit_seq(list).map(Said::from)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Said<T>, A::Error> {
        let table = Table::<T>::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Said { value: table.value.0, source: table.source, assumed: table.assumed })
    }
}

impl<T> From<Plain<T>> for Said<T> {
    fn from(plain: Plain<T>) -> Said<T> {
        Said { value: plain.0, source: String::new(), assumed: false }
    }
}
