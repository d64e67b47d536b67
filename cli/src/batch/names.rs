//! Checks the output names of a batch, so that no output replaces a file that somebody needs.
//!
//! An output may not have the name of a source or of another output. It may not replace a different subprogram
//! that earlier programs in the folder call. Names that differ only in case are equal: `a.nc` and `A.NC` clash,
//! because a file system may ignore case.
//!
//! Not here: the choice of the names, and writing the files.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use ncc_driver::problem::{Exit, Problem};
use sha2::{Digest, Sha256};

use super::gather::{Identity, identity};

/// A path that one program wants for an output file.
#[derive(Clone, Debug)]
pub(super) struct Claim {
    /// Index of the program in the batch.
    pub(super) by: usize,
    /// Path of the output file.
    pub(super) path: PathBuf,
    /// SHA-256 of a subprogram: programs may share its file if the hash is equal. `None` for the program itself.
    pub(super) shared: Option<[u8; 32]>,
}

/// Programs with a claim on a source or on another program's output, each with its problem.
pub(super) fn refused(
    claims: &[Claim],
    sources: &BTreeSet<Identity>,
    shown: &dyn Fn(usize) -> String,
) -> BTreeMap<usize, Problem> {
    let mut refused = BTreeMap::new();
    let mut owners: BTreeMap<String, Vec<&Claim>> = BTreeMap::new();
    for claim in claims {
        owners.entry(key(&claim.path)).or_default().push(claim);
        if identity(&claim.path).is_some_and(|own| sources.contains(&own)) {
            let message = format!(
                "{}: its output {} is a source, and is never written over",
                shown(claim.by),
                claim.path.display()
            );
            refused.insert(claim.by, usage(message, "choose another folder for the outputs"));
        }
    }
    for claims in owners.values() {
        let Some(first) = claims.first() else { continue };
        let same = |claim: &&Claim| claim.shared.is_some() && claim.shared == first.shared;
        if claims.len() < 2 || claims.iter().all(same) {
            continue;
        }
        for claim in claims {
            // Two files of the same program may clash: then the message names this program twice.
            let other = claims.iter().find(|c| c.by != claim.by).unwrap_or(claim);
            let message = format!(
                "{}: its output {} would also be that of {}",
                shown(claim.by),
                claim.path.display(),
                shown(other.by)
            );
            let help = "translate them into folders of their own, or rename one of them";
            refused.entry(claim.by).or_insert_with(|| usage(message, help));
        }
    }
    refused
}

/// Programs whose subprogram would replace a different file in the folder, each with its problem. Other programs in
/// the folder may call that file, and were verified with it. ncc may replace it if the folder already has a main
/// program that calls it and that this batch writes again.
pub(super) fn at_odds_with_the_folder(
    claims: &[Claim],
    shown: &dyn Fn(usize) -> String,
) -> BTreeMap<usize, Problem> {
    let there = claims.iter().filter(|claim| claim.shared.is_none() && claim.path.exists());
    let again: BTreeSet<usize> = there.map(|claim| claim.by).collect();
    let theirs = claims.iter().filter(|claim| again.contains(&claim.by));
    let rewritten: BTreeSet<String> = theirs.map(|claim| key(&claim.path)).collect();
    let mut refused = BTreeMap::new();
    for claim in claims.iter().filter(|claim| !rewritten.contains(&key(&claim.path))) {
        if !claim.shared.is_some_and(|own| holds_another(&claim.path, &own)) {
            continue;
        }
        let message = format!(
            "{}: its subprogram {} is there already, and is another",
            shown(claim.by),
            claim.path.display()
        );
        let help = "programs of that folder may call it; translate into another one, or take it away first";
        refused.entry(claim.by).or_insert_with(|| usage(message, help));
    }
    refused
}

/// Whether the file exists with another SHA-256 than `own`.
pub(super) fn holds_another(path: &Path, own: &[u8; 32]) -> bool {
    fs::read(path).is_ok_and(|text| Sha256::digest(&text)[..] != own[..])
}

fn usage(message: String, help: &str) -> Problem {
    Problem { exit: Exit::Usage, message, help: vec![help.to_owned()] }
}

pub(super) fn key(path: &Path) -> String {
    path.to_string_lossy().to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claim(by: usize, path: &str, shared: Option<u8>) -> Claim {
        Claim { by, path: path.into(), shared: shared.map(|byte| [byte; 32]) }
    }

    fn who(claims: &[Claim]) -> Vec<usize> {
        refused(claims, &BTreeSet::new(), &|by| by.to_string()).into_keys().collect()
    }

    #[test]
    fn a_name_is_one_programs_own() {
        assert_eq!(who(&[claim(0, "o/a.nc", None), claim(1, "o/b.nc", None)]), [] as [usize; 0]);
        assert_eq!(
            who(&[claim(0, "o/a.nc", None), claim(1, "o/A.NC", None), claim(2, "o/b.nc", None)]),
            [0, 1]
        );
    }

    #[test]
    fn a_subprogram_of_others_is_not_written_over() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let hash = |text: &[u8]| Some(Sha256::digest(text).into());
        let claims = |new: &str, text: &[u8]| {
            let main = Claim { by: 0, path: path(new), shared: None };
            vec![main, Claim { by: 0, path: path("L1.SPF"), shared: hash(text) }]
        };
        let odds = |claims: &[Claim]| at_odds_with_the_folder(claims, &|by| by.to_string()).len();
        assert_eq!(odds(&claims("B.MPF", b"new")), 0);
        fs::write(path("A.MPF"), "").unwrap();
        fs::write(path("L1.SPF"), "old").unwrap();
        assert_eq!(odds(&claims("B.MPF", b"old")), 0, "the same");
        assert_eq!(odds(&claims("B.MPF", b"new")), 1);
        assert_eq!(odds(&claims("A.MPF", b"new")), 0, "its own");
        // A program that is there takes along one that is new, where both have the subprogram.
        let mut both = claims("A.MPF", b"new");
        both.extend(claims("B.MPF", b"new").into_iter().map(|claim| Claim { by: 1, ..claim }));
        assert_eq!(odds(&both), 0);
    }

    #[test]
    fn a_subprogram_that_is_the_same_may_be_in_common() {
        assert_eq!(who(&[claim(0, "L1.SPF", Some(1)), claim(1, "L1.SPF", Some(1))]), [] as [usize; 0]);
        assert_eq!(who(&[claim(0, "L1.SPF", Some(1)), claim(1, "L1.SPF", Some(2))]), [0, 1]);
        assert_eq!(who(&[claim(0, "L1.SPF", Some(1)), claim(1, "L1.SPF", None)]), [0, 1]);
    }
}
