//! Dialects and machines of a shop, as the compiler takes them from dictionaries and profiles.

use ncc_dialects::Dialect;
use ncc_engine::dialects::{Dialects, Dictionary, Shop};
use ncc_machines::{Profile, ProfileError};

use crate::http::Problem;
use crate::store::{ShopText, Sort, Store, StoreError, digest};

/// The name by which messages and certificates call a dictionary.
pub(super) fn file(name: &str) -> String {
    format!("dialect {name}")
}

/// Dictionaries as the compiler takes them.
fn dictionaries(texts: Vec<ShopText>) -> Vec<Dictionary> {
    texts.into_iter().map(|own| Dictionary { file: file(&own.name), text: own.text }).collect()
}

/// The dictionaries of a shop, read.
pub(super) fn shop(store: &Store) -> Result<(Vec<ShopText>, Shop), StoreError> {
    let texts = store.shop_texts(Sort::Dialect)?;
    let shop = Shop::of(dictionaries(texts.clone()));
    Ok((texts, shop))
}

/// The built-in dialects and those of these dictionaries.
pub(crate) fn of_texts(texts: Vec<ShopText>) -> Dialects {
    if texts.is_empty() { Dialects::default() } else { Shop::of(dictionaries(texts)).dialects }
}

/// The built-in dialects and those of the shop.
pub(crate) fn dialects(store: &Store) -> Result<Dialects, StoreError> {
    Ok(of_texts(store.shop_texts(Sort::Dialect)?))
}

/// A profile in either form.
pub(crate) fn profile(text: &str, dialects: &Dialects) -> Result<Profile, Vec<ProfileError>> {
    match text.trim_start().starts_with('{') {
        true => Profile::parse_machine_json(text),
        false => Profile::parse(text, &|id| dialects.get(id)),
    }
}

/// The dialect of a program by the one that is stated with it, and else by the profile of its machine.
pub(crate) fn stated_dialect(
    dialects: &Dialects,
    stated: Option<&str>,
    own: Option<&str>,
) -> Option<&'static Dialect> {
    match stated {
        Some(id) => dialects.get(id),
        None => {
            let profile = profile(own?, dialects).ok()?;
            Some(profile.dialect).filter(|_| !profile.any_control)
        }
    }
}

/// A digest of the dictionary that a program depends on, with those that it builds on; none where the dialect is recognised, or
/// where a machine names a built-in one.
pub(crate) fn dictionary(dialects: &Dialects, stated: Option<&str>, own: Option<&str>) -> Option<String> {
    let dialect = stated_dialect(dialects, stated, own)?;
    if stated.is_none() && ncc_dialects::builtin(&dialect.id).is_some() {
        return None;
    }
    let hashes: Vec<String> = dialects.hashes(&dialect.id).into_iter().map(|own| own.sha256).collect();
    Some(digest(&hashes.iter().map(String::as_bytes).collect::<Vec<_>>()))
}

/// The dialect of a name; of an empty one, none.
///
/// # Errors
/// There is none of this name.
pub(crate) fn named(store: &Store, name: &str) -> Result<Option<&'static Dialect>, Problem> {
    if name.is_empty() {
        return Ok(None);
    }
    if let Some(dialect) = ncc_dialects::builtin(name) {
        return Ok(Some(dialect));
    }
    let dialects = dialects(store)?;
    dialects.get(name).map(Some).ok_or_else(|| {
        let all: Vec<_> = dialects.ids().collect();
        Problem::request(format!("there is no dialect `{name}`"))
            .help(format!("there are: {}", all.join(", ")))
    })
}
