//! SHA-256 of dictionaries and profiles that a verdict rests on.

use std::{fs, io};

use ncc_driver::render::report::hex;
use ncc_driver::review::verify::document::Hashed;
use ncc_driver::side::Side;
use sha2::{Digest, Sha256};

use crate::known::Known;

/// The dictionaries of both sides, each with what it builds on, each once.
pub(crate) fn dictionaries(sides: &[Side; 2], known: &Known) -> Vec<Hashed> {
    let mut all: Vec<Hashed> = Vec::new();
    for side in sides {
        for (name, file, text) in known.texts(&side.dialect().id) {
            if all.iter().all(|other| other.name != name) {
                let file = file.map(|file| file.display().to_string());
                all.push(Hashed { name: name.to_owned(), file, sha256: hex(&Sha256::digest(text)) });
            }
        }
    }
    all
}

/// The profiles of both sides, by the names that they were called by; each once.
///
/// # Errors
/// Reading the file of one.
pub(crate) fn profiles(names: [Option<&str>; 2], sides: &[Side; 2]) -> io::Result<Vec<Hashed>> {
    let projects = sides.iter().filter_map(|side| side.job.project.as_deref());
    let of_projects = projects.flat_map(|used| used.profiles.iter().map(String::as_str));
    let mut all: Vec<Hashed> = Vec::new();
    for name in names.into_iter().flatten().chain(of_projects) {
        if all.iter().any(|other| other.name == name) {
            continue;
        }
        // As `machines::find` goes: the shipped ones first.
        let (file, text) = match ncc_machines::shipped_text(name) {
            Some(text) => (None, text.as_bytes().to_vec()),
            None => (Some(name.to_owned()), fs::read(name)?),
        };
        all.push(Hashed { name: name.to_owned(), file, sha256: hex(&Sha256::digest(text)) });
    }
    Ok(all)
}
