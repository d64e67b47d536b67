//! Passwords: argon2id, with the cost that the limits state.
//!
//! A digest is computed for an account that is not there, too, so that the time of an answer does not tell which accounts
//! there are. Few are computed at once: each takes much memory on purpose.

use std::sync::{Arc, OnceLock};

use argon2::password_hash::phc::{ParamsString, PasswordHash};
use argon2::password_hash::{PasswordHasher, PasswordVerifier};
use argon2::{Algorithm, Argon2, Params, Version};
use tokio::sync::Semaphore;

use crate::Cost;

/// Bytes of a password at least, and at most.
pub(crate) const LENGTH: [usize; 2] = [10, 1024];

/// Digests that are computed at once at most.
const AT_ONCE: usize = 2;

/// Requests that wait for their turn at most.
const WAITING: usize = 30;

/// Memory of a stored digest at most, KiB, and its rounds: one that was put into the database by somebody else is not
/// allowed to use up the computer.
const HIGHEST: Cost = Cost { memory: 1 << 20, rounds: 16, lanes: 16 };

/// Reason why a password was not compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NotCompared {
    /// Too many wait.
    Busy,
    /// A digest could not be computed.
    Broken,
}

/// Computes digests of passwords.
pub(crate) struct Passwords {
    cost: Cost,
    turns: Arc<Semaphore>,
    places: Semaphore,
    /// Of a password that nobody has.
    nobody: OnceLock<String>,
}

/// Whether a password may be given to an account.
pub(crate) fn fits(password: &str) -> bool {
    (LENGTH[0]..=LENGTH[1]).contains(&password.len())
}

/// The digest of a password, a PHC string with its salt and its cost.
pub(crate) fn digest(password: &str, cost: Cost) -> Option<String> {
    let params = Params::new(cost.memory, cost.rounds, cost.lanes, None).ok()?;
    let mut salt = [0_u8; 16];
    getrandom::fill(&mut salt).ok()?;
    let argon = Argon2::new(Algorithm::Argon2id, Version::V0x13, params);
    let digest: PasswordHash = argon.hash_password_with_salt(password.as_bytes(), &salt).ok()?;
    Some(digest.to_string())
}

/// Whether a password has a digest. One of too high a cost has none.
fn has(password: &str, digest: &str) -> bool {
    let Ok(digest) = PasswordHash::new(digest) else { return false };
    if !is_affordable(&digest.params) {
        crate::observe::fault("the digest of a password in the database costs too much to be computed");
        return false;
    }
    password.len() <= LENGTH[1] && Argon2::default().verify_password(password.as_bytes(), &digest).is_ok()
}

fn is_affordable(params: &ParamsString) -> bool {
    [("m", HIGHEST.memory), ("t", HIGHEST.rounds), ("p", HIGHEST.lanes)]
        .into_iter()
        .all(|(name, highest)| params.get_decimal(name).is_some_and(|value| value <= highest))
}

impl Passwords {
    pub(crate) fn new(cost: Cost) -> Passwords {
        let turns = Arc::new(Semaphore::new(AT_ONCE));
        Passwords { cost, turns, places: Semaphore::new(AT_ONCE + WAITING), nobody: OnceLock::new() }
    }

    /// Does something with a digest, in turn, on a thread that may take its time.
    async fn in_turn<T: Send + 'static>(
        &self,
        work: impl FnOnce(Cost) -> T + Send + 'static,
    ) -> Result<T, NotCompared> {
        let _place = self.places.try_acquire().map_err(|_| NotCompared::Busy)?;
        let turn = self.turns.clone().acquire_owned().await.map_err(|_| NotCompared::Broken)?;
        let cost = self.cost;
        let done = tokio::task::spawn_blocking(move || {
            // The turn is taken until it has ended, also where nobody waits for it any more.
            let _turn = turn;
            work(cost)
        });
        done.await.map_err(|_| NotCompared::Broken)
    }

    /// The digest of a password.
    pub(crate) async fn digest(&self, password: String) -> Result<String, NotCompared> {
        self.in_turn(move |cost| digest(&password, cost)).await?.ok_or(NotCompared::Broken)
    }

    /// Whether a password has a digest; without a digest it takes as long, and it has not.
    pub(crate) async fn has(&self, password: String, of: Option<String>) -> Result<bool, NotCompared> {
        let nobody = match self.nobody.get() {
            Some(nobody) => nobody.clone(),
            None => {
                let made = self.digest("a password that nobody has".to_owned()).await?;
                self.nobody.get_or_init(|| made).clone()
            }
        };
        let is_there = of.is_some();
        let of = of.unwrap_or(nobody);
        Ok(self.in_turn(move |_| has(&password, &of)).await? && is_there)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHEAP: Cost = Cost { memory: 8, rounds: 1, lanes: 1 };

    #[test]
    fn a_password_has_its_digest() {
        let one = digest("correct horse", CHEAP).expect("a digest");
        let other = digest("correct horse", CHEAP).expect("a digest");
        assert!(one.starts_with("$argon2id$v=19$m=8,t=1,p=1$") && one != other, "{one}");
        assert!(has("correct horse", &one) && has("correct horse", &other));
        assert!(!has("correct horse ", &one) && !has("", &one) && !has("correct horse", ""));
    }

    /// A digest of another cost than is allowed is not computed: this would take 4 TiB.
    #[test]
    fn a_digest_of_too_high_a_cost_is_not_computed() {
        let cheap = digest("correct horse", CHEAP).expect("a digest");
        for (before, after) in [("m=8", "m=4294967295"), ("t=1", "t=4294967295"), ("p=1", "p=16777215")] {
            let bomb = cheap.replace(before, after);
            assert_ne!(bomb, cheap);
            assert!(!has("correct horse", &bomb), "{bomb}");
        }
        // Nor is one of another algorithm, or without a cost.
        assert!(!has("correct horse", &cheap.replace("m=8,t=1,p=1", "m=8")));
        assert!(!has("x", "$pbkdf2-sha256$i=4294967295,l=32$O+Ec$x"));
    }

    /// A password of nobody is compared with a digest of the same cost.
    #[test]
    fn a_digest_is_computed_for_nobody_too() {
        let runtime = tokio::runtime::Builder::new_current_thread().build().expect("a runtime");
        let passwords = Passwords::new(CHEAP);
        assert_eq!(runtime.block_on(passwords.has("a password that nobody has".to_owned(), None)), Ok(false));
        let nobody = passwords.nobody.get().expect("a digest").clone();
        assert!(nobody.contains("m=8,t=1,p=1") && has("a password that nobody has", &nobody));
    }
}
