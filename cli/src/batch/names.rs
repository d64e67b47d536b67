//! The names of a batch's outputs: none is that of a source, and no two programs have one.
//!
//! Names that differ in capitals alone are one name: a folder on the machine may not tell them apart.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::gather::{Identity, identity};
use crate::problem::{Exit, Problem};

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

fn usage(message: String, help: &str) -> Problem {
    Problem { exit: Exit::Usage, message, help: vec![help.to_owned()] }
}

fn key(path: &Path) -> String {
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
    fn a_subprogram_that_is_the_same_may_be_in_common() {
        assert_eq!(who(&[claim(0, "L1.SPF", Some(1)), claim(1, "L1.SPF", Some(1))]), [] as [usize; 0]);
        assert_eq!(who(&[claim(0, "L1.SPF", Some(1)), claim(1, "L1.SPF", Some(2))]), [0, 1]);
        assert_eq!(who(&[claim(0, "L1.SPF", Some(1)), claim(1, "L1.SPF", None)]), [0, 1]);
    }
}
