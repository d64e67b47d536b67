//! Prepares the built-in dictionaries: each is parsed, laid over its base, and kept as MessagePack in one file, so that a
//! start of ncc reads fields and no TOML.
//!
//! A file `dictionaries.rs` has the bytes of each, in the order of the texts.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::{env, fs};

use toml::Value;
use toml::de::{DeTable, DeValue};

#[allow(dead_code, unreachable_pub)]
#[path = "src/fault.rs"]
mod fault;
#[allow(dead_code, unreachable_pub)]
#[path = "src/merge.rs"]
mod merge;
#[path = "src/texts.rs"]
mod texts;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::var("OUT_DIR")?;
    let mut list = format!("[&[u8]; {}] = [\n", texts::BUILTIN.len());
    for (id, text) in texts::BUILTIN {
        let tree = plain(DeValue::Table(merged(text)?));
        let file = Path::new(&folder).join(format!("{id}.msgpack"));
        fs::write(&file, rmp_serde::to_vec(&tree)?)?;
        writeln!(list, "    include_bytes!(concat!(env!(\"OUT_DIR\"), \"/{id}.msgpack\")),")?;
    }
    list.push_str("]\n");
    Ok(fs::write(Path::new(&folder).join("dictionaries.rs"), format!("static PREPARED: {list};"))?)
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

/// A tree without the places of its values.
fn plain(value: DeValue<'_>) -> Value {
    match value {
        DeValue::Table(table) => {
            let entry = |(key, value): (toml::Spanned<_>, toml::Spanned<DeValue<'_>>)| {
                let key: std::borrow::Cow<'_, str> = key.into_inner();
                (key.into_owned(), plain(value.into_inner()))
            };
            Value::Table(table.into_iter().map(entry).collect())
        }
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
