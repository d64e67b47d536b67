//! What a table of a profile has: its keys, what each takes, what it means. The types of the schema
//! are made with `table!`, so that the written schema and the list of facts follow from them.

use std::ops::Range;

use crate::fact::Fact;
use crate::takes::Takes;

/// A key of a table.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// The values that it takes.
    pub takes: Takes,
    /// The thing that it states.
    pub about: &'static str,
}

/// A fact of a profile, for people.
#[derive(Clone, Debug, PartialEq)]
pub struct Stated {
    /// The key.
    pub key: &'static str,
    /// The value; `None` is not stated.
    pub value: Option<String>,
    /// The manual and its page, or another source.
    pub source: String,
    /// Whether it is marked as assumed.
    pub assumed: bool,
    /// Its place in the file, in bytes.
    pub span: Range<usize>,
}

/// A table of a profile with what is stated in it.
#[derive(Clone, Debug)]
pub struct Row {
    /// How it is headed in the file.
    pub head: &'static str,
    /// What it holds.
    pub about: &'static str,
    /// Its keys and values.
    pub facts: Vec<Stated>,
}

/// A table with a fixed set of keys.
pub trait Table {
    /// How it is headed in the file: `[times]`, or `[[axis]]` if there may be several.
    const HEAD: &'static str;
    /// What it holds.
    const ABOUT: &'static str;
    /// Its keys.
    const KEYS: &'static [Key];
    /// Every key with what is stated for it.
    fn stated(&self) -> Vec<Stated>;
}

/// A value that a table shows.
pub trait Tell {
    /// What is stated under a key.
    fn tell(&self, key: &'static str) -> Stated;
    /// Its place in the file.
    fn place(&self) -> Range<usize>;
}

/// A value in words.
pub trait Words {
    /// The value as a profile has it, without quotes.
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

/// `PerMinute` as `per-minute`.
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
