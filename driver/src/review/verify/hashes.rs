//! SHA-256 of dictionaries and profiles that a verdict rests on.

use std::io;

use sha2::{Digest, Sha256};

use super::document::Hashed;
use crate::render::report::hex;
use crate::side::Side;

/// A text with its name and, if it is not one that comes with ncc, its file.
pub type Named<'t> = (&'t str, Option<String>, &'t str);

fn hashed(name: &str, file: Option<String>, text: &[u8]) -> Hashed {
    Hashed { name: name.to_owned(), file, sha256: hex(&Sha256::digest(text)) }
}

/// The dictionaries of both sides, each with what it builds on, each once; `texts` has those of a dialect.
pub fn dictionaries<'t>(sides: &[Side; 2], texts: &dyn Fn(&str) -> Vec<Named<'t>>) -> Vec<Hashed> {
    let mut all: Vec<Hashed> = Vec::new();
    for side in sides {
        for (name, file, text) in texts(&side.dialect().id) {
            if all.iter().all(|other| other.name != name) {
                all.push(hashed(name, file, text.as_bytes()));
            }
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
