//! Two places of documents: the store of this process, or another service.

use std::sync::Arc;

use ncc_engine::dialects::Dialects;

use super::Remote;
use super::document::Whole;
use crate::access::Caller;
use crate::http::Problem;
use crate::shop::of_texts;
use crate::store::{Condition, Listed, Parts, ShopText, Sort, Store};

/// The place of documents.
#[derive(Clone)]
pub(crate) enum Shelf {
    /// In the store of this process.
    Here(Store),
    /// By a PERSISTENCE elsewhere.
    There(Arc<Remote>),
}

/// Parts of a document that was asked for.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    /// The document's tag.
    pub(crate) tag: String,
    /// The short name of its machine.
    pub(crate) machine: String,
    /// The name of its dialect.
    pub(crate) dialect: String,
    /// Those parts that are wanted and there.
    pub(crate) parts: Parts,
}

/// Nothing is changed for a request that has been stopped.
fn heed() -> Result<(), Problem> {
    if ncc_exec::halt::is_asked() { Err(Problem::busy("the request has been stopped")) } else { Ok(()) }
}

impl Shelf {
    /// The same shelf for a user.
    pub(crate) fn of(&self, caller: &Caller) -> Shelf {
        match self {
            Shelf::Here(store) => Shelf::Here(store.of(caller.who())),
            Shelf::There(remote) => Shelf::There(Arc::new(remote.with(caller.bearer()))),
        }
    }

    /// Keeps a document under a name that is free; gives its tag.
    pub(crate) fn create(&self, name: &str, of: &[String; 2], parts: Parts) -> Result<String, Problem> {
        heed()?;
        match self {
            Shelf::Here(store) => Ok(store.create(name, [&of[0], &of[1]], &parts)?),
            Shelf::There(remote) => remote.create(name, &whole(of, parts)?),
        }
    }

    /// Keeps a document in the place of the one under a name; gives its tag.
    pub(crate) fn replace(
        &self,
        name: &str,
        of: &[String; 2],
        parts: Parts,
        over: &Condition,
    ) -> Result<String, Problem> {
        heed()?;
        match self {
            Shelf::Here(store) => Ok(store.replace(name, [&of[0], &of[1]], &parts, over)?),
            Shelf::There(remote) => remote.replace(name, &whole(of, parts)?, over),
        }
    }

    /// Lets go of a document.
    pub(crate) fn delete(&self, name: &str, over: &Condition) -> Result<(), Problem> {
        match self {
            Shelf::Here(store) => Ok(store.delete(name, over)?),
            Shelf::There(remote) => remote.delete(name, over),
        }
    }

    /// A document, with those of its parts that are wanted.
    pub(crate) fn find(&self, name: &str, wanted: &[&str]) -> Result<Found, Problem> {
        match self {
            Shelf::Here(store) => {
                let (about, parts) = store.parts(name, wanted)?;
                Ok(Found { tag: about.tag, machine: about.machine, dialect: about.dialect, parts })
            }
            Shelf::There(remote) => {
                let (tag, whole) = remote.find(name)?;
                let parts = whole.parts.into_iter().filter(|(part, _)| wanted.contains(&part.as_str()));
                let parts = parts.map(|(part, text)| (part, text.into_bytes())).collect();
                Ok(Found { tag, machine: whole.machine, dialect: whole.dialect, parts })
            }
        }
    }

    /// Documents in the order of their names, those after a name, so many at most.
    pub(crate) fn list(&self, after: &str, most: u32) -> Result<Vec<Listed>, Problem> {
        match self {
            Shelf::Here(store) => Ok(store.list(after, most)?),
            Shelf::There(remote) => remote.list(after, most),
        }
    }

    /// The profile of a machine.
    pub(crate) fn machine(&self, name: &str) -> Result<ShopText, Problem> {
        match self {
            Shelf::Here(store) => Ok(store.shop_text(Sort::Machine, name)?),
            Shelf::There(remote) => remote.machine(name),
        }
    }

    /// The built-in dialects, and those of the shop.
    pub(crate) fn dialects(&self) -> Result<Dialects, Problem> {
        Ok(of_texts(match self {
            Shelf::Here(store) => store.shop_texts(Sort::Dialect)?,
            Shelf::There(remote) => remote.dialects()?,
        }))
    }
}

/// A document as it is sent.
pub(crate) fn whole([machine, dialect]: &[String; 2], parts: Parts) -> Result<Whole, Problem> {
    let text = |(part, bytes)| Some((part, String::from_utf8(bytes).ok()?));
    let parts = parts.into_iter().map(text).collect::<Option<_>>();
    let parts = parts.ok_or_else(|| Problem::content("a part is no text"))?;
    Ok(Whole { machine: machine.clone(), dialect: dialect.clone(), parts })
}
