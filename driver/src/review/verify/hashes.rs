//! SHA-256 of dictionaries and profiles that a verdict rests on.

use std::io;

use sha2::{Digest, Sha256};

use super::document::Hashed;
use crate::render::report::hex;
use crate::side::Side;

/// A text by its name and, if it is not one that comes with ncc, its file.
pub fn hashed(name: &str, file: Option<String>, text: &[u8]) -> Hashed {
    Hashed { name: name.to_owned(), file, sha256: hex(&Sha256::digest(text)) }
}

/// The text of a built-in dialect.
pub fn built_in(id: &str) -> Option<Hashed> {
    let at = ncc_dialects::builtin_ids().position(|other| other == id)?;
    let (name, sha256) = ncc_dialects::builtin_sha256(at)?;
    Some(Hashed { name: name.to_owned(), file: None, sha256: hex(sha256) })
}

/// The dictionaries of both sides, each with what it builds on, each once; `hashes` has those of a dialect.
pub fn dictionaries(sides: &[Side; 2], hashes: &dyn Fn(&str) -> Vec<Hashed>) -> Vec<Hashed> {
    let mut all: Vec<Hashed> = Vec::new();
    for own in sides.iter().flat_map(|side| hashes(&side.dialect().id)) {
        if all.iter().all(|other| other.name != own.name) {
            all.push(own);
        }
    }
    all
}

/// Inputs and answers of the user's programs for custom functions: a row for each dialect with such programs.
pub fn answers(sides: &[Side; 2]) -> Vec<Hashed> {
    let mut all: Vec<Hashed> = Vec::new();
    for dialect in sides.iter().map(Side::dialect) {
        let digest = dialect.function_host.as_ref().and_then(|host| host.digest());
        let name = format!("{} functions", dialect.id);
        if let Some(digest) = digest.filter(|_| all.iter().all(|other| other.name != name)) {
            all.push(Hashed { name, file: None, sha256: hex(&digest) });
        }
    }
    all
}

/// The profiles of both sides, by the names that they were called by; each once. `read` has the file of one that does
/// not come with ncc.
///
/// # Errors
/// Reading the file of one.
pub fn profiles(
    names: [Option<&str>; 2],
    sides: &[Side; 2],
    read: &dyn Fn(&str) -> io::Result<Vec<u8>>,
) -> io::Result<Vec<Hashed>> {
    let projects = sides.iter().filter_map(|side| side.job.project.as_deref());
    let of_projects = projects.flat_map(|used| used.profiles.iter().map(String::as_str));
    let mut all: Vec<Hashed> = Vec::new();
    for name in names.into_iter().flatten().chain(of_projects) {
        if all.iter().any(|other| other.name == name) {
            continue;
        }
        // The shipped ones first, as where a profile is looked for.
        all.push(match ncc_machines::shipped_text(name) {
            Some(text) => hashed(name, None, text.as_bytes()),
            None => hashed(name, Some(name.to_owned()), &read(name)?),
        });
    }
    Ok(all)
}
