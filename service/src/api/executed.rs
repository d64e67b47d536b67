//! A program that is executed for an output: its revision, its machine, and the engine that has both.
//!
//! Not here: what is asked of the engine (`outputs`, `comparison`, `sheet`).

use std::collections::BTreeMap;

use ncc_engine::Engine;
use serde_json::{Value, json};

use crate::compiler::put_machine;
use crate::http::Problem;
use crate::http::query::Query;
use crate::shop::dialects;
use crate::store::{Revision, Store};
use crate::translating::{profile, run_with_called};

/// Settings of an execution, from the address.
#[derive(Debug, Default)]
pub(super) struct Reading {
    /// Its dialect; that kept with it without this.
    pub(super) dialect: Option<String>,
    /// Its machine; that kept with it without this.
    pub(super) machine: Option<String>,
    options: BTreeMap<String, String>,
    assume_milling: bool,
}

impl Reading {
    /// Names of the settings in an address.
    pub(super) const NAMES: &str = "dialect, machine, option, assume_milling";

    /// Takes the settings from an address.
    pub(super) fn of(query: &mut Query) -> Result<Reading, Problem> {
        Ok(Reading {
            dialect: query.one("dialect")?,
            machine: query.one("machine")?,
            options: query.pairs("option")?,
            assume_milling: query
                .among("assume_milling", &[("true", true), ("false", false)])?
                .unwrap_or(false),
        })
    }
}

/// A program, found, with its machine.
pub(super) struct Found {
    /// The program in its revision.
    pub(super) of: Revision,
    /// Its dialect, where it is stated.
    pub(super) dialect: Option<String>,
    /// The name of its machine, and the text of its profile where it is not one that comes with ncc.
    machine: Option<(String, Option<String>)>,
    options: BTreeMap<String, String>,
    assume_milling: bool,
}

impl Found {
    /// Finds what the address does not state: it is kept with the program.
    pub(super) fn of(store: &Store, of: Revision, reading: &Reading) -> Result<Found, Problem> {
        let kept = |name: &String| Some(name.clone()).filter(|name| !name.is_empty());
        let dialect = reading.dialect.clone().or_else(|| kept(&of.details.dialect));
        let machine = match reading.machine.clone().or_else(|| kept(&of.details.machine)) {
            None => None,
            Some(name) => {
                let text = profile(store, &name)?.0;
                Some((name, text))
            }
        };
        let (options, assume_milling) = (reading.options.clone(), reading.assume_milling);
        Ok(Found { of, dialect, machine, options, assume_milling })
    }

    /// The name of its machine.
    pub(super) fn machine(&self) -> Option<&str> {
        self.machine.as_ref().map(|(name, _)| name.as_str())
    }

    /// Puts the program and its machine into an engine; gives the fields of a request that every verb has.
    pub(super) fn put(&self, engine: &mut Engine, file: &str, text: Vec<u8>) -> Value {
        let machine = self.machine.as_ref().map(|(name, text)| put_machine(engine, name, text.as_deref()));
        engine.put(file, text);
        json!({
            "file": file,
            "from": self.dialect,
            "machine": machine,
            "from_option": self.options,
            "assume_milling": self.assume_milling,
        })
    }
}

/// A program in an engine.
pub(super) struct Ready<'s> {
    store: &'s Store,
    /// The program.
    pub(super) found: Found,
    /// The engine, with the outputs of the last request.
    pub(super) engine: Engine,
    common: Value,
}

impl Ready<'_> {
    /// Reads the text of a program into an engine.
    pub(super) fn of(store: &Store, found: Found) -> Result<Ready<'_>, Problem> {
        let mut engine = Engine::default();
        engine.know(dialects(store)?);
        let text = store.whole(&found.of.content)?;
        let common = found.put(&mut engine, &found.of.details.name, text);
        Ok(Ready { store, found, engine, common })
    }

    /// The fields of the program, with more of them.
    pub(super) fn fields(&self, more: &Value) -> Value {
        let mut fields = self.common.clone();
        for (name, value) in more.as_object().into_iter().flatten() {
            fields[name] = value.clone();
        }
        fields
    }

    /// Does a request; gives the code.
    pub(super) fn run(&mut self, request: &Value) -> Result<u8, Problem> {
        Ok(run_with_called(self.store, &self.found.of, &mut self.engine, &request.to_string())?.0)
    }

    /// Does a request of the program with fields of its own; gives the code.
    pub(super) fn ask(&mut self, verb: &str, more: &Value) -> Result<u8, Problem> {
        let mut request = self.fields(more);
        request["verb"] = verb.into();
        self.run(&request)
    }
}
