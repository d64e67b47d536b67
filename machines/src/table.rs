//! Tables of a machine profile: their keys, the allowed values and their meaning.
//!
//! The macro `table!` makes the types of the schema, so the written schema and the list of facts always agree.
//! Not here: the tables themselves (`schema`).

use std::ops::Range;

use crate::fact::Fact;
use crate::takes::Takes;

/// A key of a table.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Name in the file.
    pub name: &'static str,
    /// Allowed values.
    pub takes: Takes,
    /// Meaning, in words for the user.
    pub about: &'static str,
}

/// A fact of a profile, as text for reports.
#[derive(Clone, Debug, PartialEq)]
pub struct Stated {
    /// Name of the key in its table.
    pub key: &'static str,
    /// Value as text; `None` if not stated.
    pub value: Option<String>,
    /// The manual and its page, or another source.
    pub source: String,
    /// Whether the profile marks it as assumed.
    pub assumed: bool,
    /// Byte range in the file.
    pub span: Range<usize>,
}

/// A table of a profile with its facts.
#[derive(Clone, Debug)]
pub struct Row {
    /// Heading in the file: `[times]`.
    pub head: &'static str,
    /// What it holds.
    pub about: &'static str,
    /// Its facts, in the order of the keys.
    pub facts: Vec<Stated>,
}

/// A table with a fixed set of keys.
pub trait Table {
    /// Heading in the file: `[times]`, or `[[axis]]` if several are allowed.
    const HEAD: &'static str;
    /// What it holds.
    const ABOUT: &'static str;
    /// All keys, in the order of the schema.
    const KEYS: &'static [Key];
    /// One fact for each key; keys without a value have `None`.
    fn stated(&self) -> Vec<Stated>;
}

/// A field of a table that can become a [`Stated`].
pub trait Tell {
    /// The fact under a key.
    fn tell(&self, key: &'static str) -> Stated;
    /// Byte range in the file.
    fn place(&self) -> Range<usize>;
}

/// A value as text: `true` is `yes`, a range is `0 to 500`.
pub trait Words {
    /// Text without quotes. List items are joined with ` | `.
    fn words(&self) -> String;
}

impl<T: Words> Tell for Fact<T> {
    fn tell(&self, key: &'static str) -> Stated {
        let value = self.value.as_ref().map(Words::words);
        Stated { key, value, source: self.source.clone(), assumed: self.assumed, span: self.place() }
    }

    fn place(&self) -> Range<usize> {
        self.span.clone()
    }
}

impl Words for String {
    fn words(&self) -> String {
        self.clone()
    }
}

impl Words for Vec<String> {
    fn words(&self) -> String {
        self.join(" | ")
    }
}

impl Words for f64 {
    fn words(&self) -> String {
        self.to_string()
    }
}

impl Words for u32 {
    fn words(&self) -> String {
        self.to_string()
    }
}

impl Words for bool {
    fn words(&self) -> String {
        if *self { "yes" } else { "no" }.to_owned()
    }
}

impl Words for [f64; 2] {
    fn words(&self) -> String {
        format!("{} to {}", self[0], self[1])
    }
}

/// Kebab case: `PerMinute` becomes `per-minute`.
pub(crate) fn kebab(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !text.is_empty() {
            text.push('-');
        }
        text.push(c.to_ascii_lowercase());
    }
    text
}

macro_rules! table {
    ($(#[doc = $about:literal])+ $name:ident $head:literal {
        $( $(#[doc = $doc:literal])+ $field:ident: $ty:ty = $takes:expr; )*
    }) => {
        $(#[doc = $about])+
        #[derive(Clone, Debug, Default, serde::Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct $name { $( $(#[doc = $doc])+ pub $field: $crate::fact::Fact<$ty>, )* }

        impl $crate::table::Table for $name {
            const HEAD: &'static str = $head;
            const ABOUT: &'static str = concat!($($about),+);
            const KEYS: &'static [$crate::table::Key] = &[ $( $crate::table::Key {
                name: stringify!($field),
                takes: $takes,
                about: concat!($($doc),+),
            } ),* ];
            fn stated(&self) -> Vec<$crate::table::Stated> {
                vec![ $( $crate::table::Tell::tell(&self.$field, stringify!($field)) ),* ]
            }
        }
    };
}

pub(crate) use table;
