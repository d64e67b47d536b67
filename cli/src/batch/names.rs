//! The names of a batch's outputs: none is that of a source, no two programs have one, and none is that of
//! a subprogram which programs translated before call.
//!
//! Names that differ in capitals alone are one name: a folder on the machine may not tell them apart.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use ncc_driver::problem::{Exit, Problem};
use sha2::{Digest, Sha256};

use super::gather::{Identity, identity};

/// A name that a program's output is to have.
#[derive(Clone, Debug)]
pub(super) struct Claim {
    /// Which program.
    pub(super) by: usize,
    /// The path.
    pub(super) path: PathBuf,
    /// What several programs may have in common, if it is the same: the hash of a subprogram.
    pub(super) shared: Option<[u8; 32]>,
}

/// The programs that cannot have the names they claim, with the reason.
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
            // A program whose own parts are at odds has no other.
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

/// The programs whose subprograms have names of files that are there with something else in them. What
/// calls those was verified with them, and would call another text. A program that is there itself is
/// written again, with what it calls.
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

/// Whether a file is there, and is not a subprogram of that hash.
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
