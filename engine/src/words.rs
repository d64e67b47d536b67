//! The words of a dialect for an editor: what each means, who says so, and what is refused.
//!
//! ```text
//! G43    USE_TOOL_LENGTH_OFFSET    16-C; 30i-C: with parameter 5006#6 at 0 the offset is a movement, …
//! ```
//!
//! Names of meanings are NIST's, as in the book's pages of dialects. Not here: which words stand in a program.

use ncc_dialects::Dialect;
use ncc_driver::render::dialects::spaced;
use serde_json::{Value, json};

/// What a word is: one of these names.
type Kind = &'static str;

fn row(kind: Kind, word: &str, means: &str, refused: Option<&str>, said: (bool, &str)) -> Value {
    let (sure, source) = said;
    json!({ "kind": kind, "word": word, "means": means, "refused": refused, "sure": sure, "source": source })
}

/// The document: the rows of the dictionary as a list, and the sources by the keys that rows name them with.
pub(crate) fn document(dialect: &Dialect) -> Value {
    let codes = dialect.code.iter().map(|own| {
        let means = own.means.map(|means| means.to_string()).unwrap_or_default();
        let cycle = dialect.cycle_row(&own.code).map(|cycle| format!("{means} {}", cycle.kind));
        row("code", &own.code, &cycle.unwrap_or(means), own.refuse.as_deref(), (own.sure, &own.source))
    });
    let names = dialect.name.iter().map(|own| {
        let role = || own.role.map(|role| spaced(&format!("{role:?}")));
        let means = own.means.map(|means| means.to_string()).or_else(role).unwrap_or_default();
        row("name", &own.name, &means, own.refuse.as_deref(), (own.sure, &own.source))
    });
    let calls = dialect.call.iter().map(|own| {
        let arguments: Vec<&str> = own.parameters.iter().map(|one| one.name.as_str()).collect();
        let means = format!("{}({})", spaced(&format!("{:?}", own.kind)), arguments.join(", "));
        row("call", &own.name, &means, None, (own.sure, &own.source))
    });
    let addresses = dialect.address.iter().map(|own| {
        let means = spaced(&format!("{:?}, {:?}", own.role, own.quantity));
        row("address", &own.letter.to_string(), &means, own.refuse.as_deref(), (own.sure, &own.source))
    });
    let words: Vec<Value> = codes.chain(names).chain(calls).chain(addresses).collect();
    json!({ "dialect": dialect.id, "words": words, "sources": dialect.sources })
}
