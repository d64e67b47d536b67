//! Rates by account or address: a bucket of tokens for each, refilled as time goes on.
//!
//! The buckets are those of a process, and their number is bounded: when there are too many, full ones go first, as they say
//! nothing, and then those that were used least.

use std::collections::HashMap;
use std::net::IpAddr;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::Rate;

/// Buckets at most; each has some 100 bytes.
const MOST: usize = 10_000;

/// The holder of a bucket.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Holder {
    /// An account.
    Account(String),
    /// An address; of IPv6 the network, as a client has as many addresses there as it likes.
    Address(IpAddr),
}

impl Holder {
    /// The holder of an address.
    pub(crate) fn at(address: IpAddr) -> Holder {
        Holder::Address(match address {
            IpAddr::V4(_) => address,
            IpAddr::V6(own) => match own.to_ipv4_mapped() {
                Some(mapped) => mapped.into(),
                None => {
                    let [a, b, c, d, ..] = own.segments();
                    IpAddr::from([a, b, c, d, 0, 0, 0, 0])
                }
            },
        })
    }
}

/// Tokens, and when they were counted.
#[derive(Clone, Copy, Debug)]
struct Bucket {
    tokens: f64,
    at: Instant,
}

/// All buckets of a kind.
pub(crate) struct Buckets {
    rate: Rate,
    all: Mutex<HashMap<Holder, Bucket>>,
}

impl Buckets {
    pub(crate) fn new(rate: Rate) -> Buckets {
        Buckets { rate, all: Mutex::default() }
    }

    /// Takes a token.
    ///
    /// # Errors
    /// There is none: the time until the next one.
    pub(crate) fn take(&self, holder: &Holder) -> Result<(), Duration> {
        self.take_at(holder, Instant::now())
    }

    fn take_at(&self, holder: &Holder, now: Instant) -> Result<(), Duration> {
        let mut all = self.all.lock().unwrap_or_else(PoisonError::into_inner);
        if all.len() >= MOST && !all.contains_key(holder) {
            self.make_room(&mut all, now);
        }
        let full = Bucket { tokens: self.burst(), at: now };
        let bucket = all.entry(holder.clone()).or_insert(full);
        *bucket = self.refilled(*bucket, now);
        if bucket.tokens >= 1.0 {
            bucket.tokens -= 1.0;
            return Ok(());
        }
        Err(Duration::from_secs_f64((1.0 - bucket.tokens) * self.rate.every.as_secs_f64()))
    }

    /// Gives a token back that was taken for nothing.
    pub(crate) fn give_back(&self, holder: &Holder) {
        let mut all = self.all.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(bucket) = all.get_mut(holder) {
            bucket.tokens = (bucket.tokens + 1.0).min(self.burst());
        }
    }

    fn burst(&self) -> f64 {
        f64::from(self.rate.burst.max(1))
    }

    fn refilled(&self, bucket: Bucket, now: Instant) -> Bucket {
        let passed = now.saturating_duration_since(bucket.at).as_secs_f64();
        let new = passed / self.rate.every.as_secs_f64().max(1e-9);
        Bucket { tokens: (bucket.tokens + new).min(self.burst()), at: now }
    }

    fn make_room(&self, all: &mut HashMap<Holder, Bucket>, now: Instant) {
        all.retain(|_, bucket| self.refilled(*bucket, now).tokens < self.burst());
        if all.len() < MOST {
            return;
        }
        let mut left: Vec<f64> = all.values().map(|bucket| self.refilled(*bucket, now).tokens).collect();
        left.sort_unstable_by(f64::total_cmp);
        let middle = left.get(left.len() / 2).copied().unwrap_or_default();
        all.retain(|_, bucket| self.refilled(*bucket, now).tokens < middle);
        if all.len() >= MOST {
            all.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn account(name: &str) -> Holder {
        Holder::Account(name.to_owned())
    }

    #[test]
    fn a_bucket_is_emptied_and_refilled() {
        let buckets = Buckets::new(Rate { burst: 2, every: Duration::from_secs(10) });
        let begin = Instant::now();
        let after = |seconds| begin + Duration::from_secs(seconds);
        let ana = account("ana");
        assert!(buckets.take_at(&ana, begin).is_ok() && buckets.take_at(&ana, begin).is_ok());
        assert_eq!(buckets.take_at(&ana, after(4)), Err(Duration::from_secs(6)));
        assert!(buckets.take_at(&account("ben"), after(4)).is_ok());
        assert!(buckets.take_at(&ana, after(10)).is_ok());
        assert!(buckets.take_at(&ana, after(10)).is_err());
        buckets.give_back(&ana);
        assert!(buckets.take_at(&ana, after(10)).is_ok());
        // It never has more than its burst.
        let later = after(100_000);
        assert!(buckets.take_at(&ana, later).is_ok() && buckets.take_at(&ana, later).is_ok());
        assert!(buckets.take_at(&ana, later).is_err());
    }

    #[test]
    fn the_number_of_buckets_is_bounded_and_the_emptiest_stay() {
        let buckets = Buckets::new(Rate { burst: 3, every: Duration::from_secs(1000) });
        let now = Instant::now();
        let guessed = account("guessed");
        while buckets.take_at(&guessed, now).is_ok() {}
        for number in 0..MOST * 3 {
            let _ = buckets.take_at(&account(&number.to_string()), now);
            assert!(buckets.all.lock().expect("a lock").len() <= MOST);
        }
        assert!(buckets.take_at(&guessed, now).is_err());
    }

    #[test]
    fn a_network_is_one_holder() {
        let at = |text: &str| Holder::at(text.parse().expect("an address"));
        assert_eq!(at("2001:db8:1:2::1"), at("2001:db8:1:2:ffff::9"));
        assert_ne!(at("2001:db8:1:2::1"), at("2001:db8:1:3::1"));
        assert_eq!(at("::ffff:10.0.0.1"), at("10.0.0.1"));
        assert_ne!(at("10.0.0.1"), at("10.0.0.2"));
    }
}
