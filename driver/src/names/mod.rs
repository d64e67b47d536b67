//! Names in a text and their places: block numbers that something leads to, labels, programs, loops, variables.
//!
//! ```text
//! N10 … GOTO 10        block 10: defined, then used
//! M98 P1000 … O1000    program 1000: used, then defined
//! #100=1 … X#100       variable #100
//! ```
//!
//! Places are those of the dialect's own lexer, and of block numbers those by which `fmt` renumbers. [`rename`] gives a name
//! another. Not here: what a name's value is.

mod look;
pub mod rename;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use ncc_dialects::Settings;
use serde::Serialize;

use crate::fmt::number::Numbers;
use crate::fmt::references;

/// What a name is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sort {
    /// A block, by its number.
    Block,
    /// A block, by a name.
    Label,
    /// A program or subprogram.
    Program,
    /// A loop or a branch.
    Loop,
    /// A variable.
    Variable,
}

/// Where a name stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The name alone, in bytes of the text.
    pub range: Range<usize>,
    /// The line, from 1.
    pub line: u32,
    /// Whether the name gets its meaning there: of a variable, a value.
    pub defines: bool,
}

/// A name with all its places, in the order of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// What it is of.
    pub sort: Sort,
    /// In which part of the text it holds; `None` is everywhere.
    pub scope: Option<usize>,
    /// As the text has it, in capitals.
    pub text: String,
    /// Where it stands.
    pub places: Vec<Place>,
}

impl Name {
    /// Whether programs in other files may use it too: what is done here is not done there.
    pub fn is_shared(&self) -> bool {
        self.scope.is_none() && matches!(self.sort, Sort::Program | Sort::Variable)
    }
}

/// A name that may be meant where nobody sees it.
#[derive(Clone, Debug, PartialEq)]
struct Doubt {
    sort: Sort,
    what: String,
}

/// What was found in a text.
#[derive(Debug, Default)]
pub struct Names {
    /// The names.
    pub names: Vec<Name>,
    doubts: Vec<Doubt>,
    /// Numbers of blocks, of which some have no name: nothing leads there.
    numbers: BTreeSet<(usize, u32)>,
}

/// Looks through a text.
pub fn find(settings: &Settings, text: &[u8]) -> Names {
    let found = references::find(settings, text);
    let mut all = look::find(settings, text, &found);
    blocks(&found, &mut all);
    for name in all.names.values_mut() {
        name.places.sort_by_key(|place| place.range.start);
        name.places.dedup_by_key(|place| place.range.start);
    }
    let mut names: Vec<Name> = all.names.into_values().collect();
    names.sort_by_key(|name| name.places.first().map(|place| place.range.start));
    let numbers = Numbers::of(&found).blocks.into_keys().collect();
    Names { names, doubts: all.doubts, numbers }
}

/// Names by what tells them apart.
type Key = (Sort, Option<usize>, String);

#[derive(Default)]
struct All {
    names: BTreeMap<Key, Name>,
    doubts: Vec<Doubt>,
}

impl All {
    fn put(&mut self, sort: Sort, scope: Option<usize>, text: &str, place: Place) {
        let text = text.to_ascii_uppercase();
        let new = || Name { sort, scope, text: text.clone(), places: Vec::new() };
        self.names.entry((sort, scope, text.clone())).or_insert_with(new).places.push(place);
    }
}

/// Block numbers that something leads to.
fn blocks(found: &references::Found, all: &mut All) {
    let numbers = Numbers::of(found);
    for doubt in &found.doubts {
        let counts = doubt.only.is_none_or(|number| numbers.blocks.contains_key(&number));
        if counts {
            all.doubts.push(Doubt { sort: Sort::Block, what: doubt.what.clone() });
        }
    }
    for reference in &found.references {
        let targets = match numbers.targets(found, reference) {
            Ok(targets) => targets,
            Err(refused) => {
                all.doubts.push(Doubt { sort: Sort::Block, what: refused.what });
                Vec::new()
            }
        };
        for at in targets {
            let block = &found.blocks[at];
            let Some(number) = &block.number else { continue };
            let (scope, text) = (Some(block.scope), number.value.to_string());
            let of = |range: &Range<usize>, line, defines| Place { range: range.clone(), line, defines };
            all.put(Sort::Block, scope, &text, of(&number.digits, block.line, true));
            all.put(Sort::Block, scope, &text, of(&reference.digits, reference.line, false));
        }
    }
}
