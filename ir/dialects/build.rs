//! Prepares the built-in dictionaries: each is parsed, laid over its base, and kept as MessagePack, so that a start of ncc
//! reads fields and no TOML.
//!
//! The tables of all dictionaries are in one file, those of one name side by side: most rows of a dictionary are its base's,
//! and what compresses a program finds them again only where they are near. A table that two have in common is there once.
//! A file `dictionaries.rs` has the pieces of each, and the SHA-256 of its text, in the order of the texts.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::error::Error;
use std::ops::Range;
use std::path::Path;
use std::{env, fs};

use sha2::{Digest, Sha256};
use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

#[allow(dead_code, unreachable_pub)]
#[path = "src/fault.rs"]
mod fault;
#[allow(dead_code, unreachable_pub)]
#[path = "src/load/merge.rs"]
mod merge;
#[allow(dead_code)]
#[path = "src/load/texts.rs"]
mod texts;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::var("OUT_DIR")?;
    let mut trees: Vec<Table> = Vec::new();
    for (_, text) in texts::BUILTIN {
        trees.push(merged(text)?.into_iter().map(entry).collect());
    }
    let mut bytes = Vec::new();
    let mut pieces: Vec<Vec<Range<usize>>> = Vec::new();
    for tree in &trees {
        pieces.push(vec![put(&mut bytes, &head(tree)?)]);
    }
    let names: BTreeSet<&String> = trees.iter().flat_map(Table::keys).collect();
    for name in names {
        let mut before: Vec<Range<usize>> = Vec::new();
        for (tree, pieces) in trees.iter().zip(&mut pieces) {
            let Some(value) = tree.get(name) else { continue };
            let piece = [rmp_serde::to_vec(name)?, rmp_serde::to_vec(value)?].concat();
            let same = before.iter().find(|range| bytes[Range::clone(range)] == piece).cloned();
            let range = same.unwrap_or_else(|| put(&mut bytes, &piece));
            before.push(range.clone());
            pieces.push(range);
        }
    }
    let folder = Path::new(&folder);
    fs::write(folder.join("dictionaries.msgpack"), &bytes)?;
    let count = trees.len();
    let pieces: Vec<String> = pieces.iter().map(|own| format!("&{own:?}")).collect();
    let hashes = texts::BUILTIN.map(|(_, text)| format!("{:?}", &Sha256::digest(text)[..]));
    let code = format!(
        "static TABLES: &[u8] = include_bytes!(concat!(env!(\"OUT_DIR\"), \"/dictionaries.msgpack\"));\n\
         static PREPARED: [&[Range<usize>]; {count}] = [{}];\n\
         static HASHES: [[u8; 32]; {count}] = [{}];\n",
        pieces.join(", "),
        hashes.join(", "),
    );
    Ok(fs::write(folder.join("dictionaries.rs"), code)?)
}

/// Puts bytes behind the others; where they are.
fn put(bytes: &mut Vec<u8>, more: &[u8]) -> Range<usize> {
    let from = bytes.len();
    bytes.extend_from_slice(more);
    from..bytes.len()
}

/// What stands before the entries of a table: how many there are.
fn head(tree: &Table) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut all = rmp_serde::to_vec(tree)?;
    let mut entries = 0;
    for (name, value) in tree {
        entries += rmp_serde::to_vec(name)?.len() + rmp_serde::to_vec(value)?.len();
    }
    all.truncate(all.len() - entries);
    Ok(all)
}

/// A dictionary over its base, and so on.
fn merged(text: &'static str) -> Result<DeTable<'static>, Box<dyn Error>> {
    let over = DeTable::parse(text)?.into_inner();
    let Some((base, _)) = merge::key_of(&over, "base") else { return lay(DeTable::new(), over) };
    let (_, base) = texts::BUILTIN.iter().find(|(id, _)| *id == base).ok_or("a base that is not built in")?;
    let mut under = merged(base)?;
    for own in merge::OWN {
        under.remove(own);
    }
    lay(under, over)
}

fn lay(mut under: DeTable<'static>, over: DeTable<'static>) -> Result<DeTable<'static>, Box<dyn Error>> {
    merge::merge(&mut under, over).map_err(|(fault, at)| format!("{fault:?} at {at:?}"))?;
    Ok(under)
}

/// An entry of a tree without its places.
fn entry((name, value): (toml::Spanned<Cow<'_, str>>, toml::Spanned<DeValue<'_>>)) -> (String, Value) {
    (name.into_inner().into_owned(), plain(value.into_inner()))
}

/// A tree without the places of its values.
fn plain(value: DeValue<'_>) -> Value {
    match value {
        DeValue::Table(table) => Value::Table(table.into_iter().map(entry).collect()),
        DeValue::Array(array) => Value::Array(array.into_iter().map(|v| plain(v.into_inner())).collect()),
        DeValue::String(text) => Value::String(text.into_owned()),
        DeValue::Integer(number) => Value::Integer(
            i64::from_str_radix(number.as_str(), number.radix()).expect("a dictionary's integer fits"),
        ),
        DeValue::Float(number) => Value::Float(number.as_str().parse().expect("a dictionary's number")),
        DeValue::Boolean(truth) => Value::Boolean(truth),
        DeValue::Datetime(moment) => Value::Datetime(moment),
    }
}
