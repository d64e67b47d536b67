//! SHA-256 of everything that a verdict rests on: programs, dictionaries, profiles.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};

use sha2::{Digest, Sha256};

use super::document::Hashed;
use crate::known::Known;
use crate::report::hex;
use crate::review::side::Side;

/// Length and hash of a file.
///
/// # Errors
/// Reading it.
pub(crate) fn of_file(file: &mut File) -> io::Result<(u64, String)> {
    file.seek(SeekFrom::Start(0))?;
    let (mut hash, mut bytes) = (Sha256::new(), 0);
    let mut piece = vec![0; 1 << 16];
    loop {
        match file.read(&mut piece)? {
            0 => return Ok((bytes, hex(&hash.finalize()))),
            n => {
                hash.update(&piece[..n]);
                bytes += n as u64;
            }
        }
    }
}

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
