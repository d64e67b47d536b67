//! Deliveries: claimed by a worker for a while, ended, listed, and sent again.
//!
//! One delivery of a hook is sent at a time, so that a receiver that hangs holds one worker at most. A worker that dies has its
//! delivery sent once more by another one, under the same name.

use super::super::documents::now;
use super::super::session::{Row, Session, Value, values};
use super::super::{Store, StoreError};
use super::records::HookState;
use crate::rights::Act;

/// Seconds for which a delivery is kept after its end, and after which one that nobody may send is given up.
const KEPT: i64 = 30 * 86_400;

/// A delivery that a worker has claimed.
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Due {
    number: i64,
    /// The hook.
    pub(crate) hook: String,
    /// The name of the event.
    pub(crate) id: String,
    /// The body.
    pub(crate) body: String,
    /// The attempt that begins, from 1.
    pub(crate) attempt: i64,
    /// The address.
    pub(crate) target: String,
    /// The secret that signs.
    pub(crate) secret: Vec<u8>,
}

/// The end of an attempt.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Attempt {
    /// The receiver has it.
    Delivered(u16),
    /// The receiver wants nothing more.
    Gone(u16),
    /// It has to be sent again.
    Failed {
        /// The status of the answer; none without an answer.
        status: Option<u16>,
        /// The reason for a missing answer; empty with an answer.
        reason: String,
        /// Seconds until the next attempt; none after the last one.
        pause: Option<i64>,
    },
}

/// A delivery for a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Delivery {
    /// Counted from 1 over all hooks.
    pub(crate) number: i64,
    /// The name of the event.
    pub(crate) id: String,
    /// The kind of event.
    pub(crate) event: String,
    /// The name of the translation or the job.
    pub(crate) subject: String,
    /// Time of the event, seconds since 1970 (UTC).
    pub(crate) moment: i64,
    /// `waiting`, `sending`, `failed`, `delivered`, `given-up`.
    pub(crate) state: String,
    /// Attempts that have begun.
    pub(crate) attempts: i64,
    /// Earliest time of the next attempt; none after the end.
    pub(crate) next: Option<i64>,
    /// Status of the last answer.
    pub(crate) status: Option<i64>,
    /// The reason for a missing answer; empty with one.
    pub(crate) reason: String,
    /// When it has ended.
    pub(crate) ended: Option<i64>,
}

const DELIVERY: &str =
    "SELECT number, id, event, subject, moment, state, attempts, next, status, reason, ended FROM delivery";

fn read(mut row: Row) -> Result<Delivery, StoreError> {
    let ended = row.maybe_int(10)?;
    let next = row.int(7)?;
    Ok(Delivery {
        number: row.int(0)?,
        id: row.text(1)?,
        event: row.text(2)?,
        subject: row.text(3)?,
        moment: row.int(4)?,
        state: row.text(5)?,
        attempts: row.int(6)?,
        next: ended.is_none().then_some(next),
        status: row.maybe_int(8)?,
        reason: row.text(9)?,
        ended,
    })
}

/// The statement that finds a delivery of some hooks that is due at the moment `$1`: of none that is being sent something to.
fn due(hooks: usize) -> String {
    let places = (2..hooks + 2).map(|at| format!("${at}")).collect::<Vec<_>>().join(", ");
    format!(
        "SELECT d.number FROM delivery d WHERE d.ended IS NULL AND d.hook IN ({places})
         AND (CASE WHEN d.state = 'sending' THEN d.until ELSE d.next END) <= $1
         AND NOT EXISTS (SELECT 1 FROM delivery s WHERE s.hook = d.hook AND s.state = 'sending' AND s.until > $1)
         ORDER BY d.next, d.number LIMIT 1"
    )
}

impl Store {
    /// Claims the next delivery of some hooks for a worker, for so many seconds.
    pub(crate) fn claim_delivery(
        &self,
        worker: &str,
        hooks: &[String],
        seconds: i64,
    ) -> Result<Option<Due>, StoreError> {
        if hooks.is_empty() {
            return Ok(None);
        }
        let due = due(hooks.len());
        let with_time = |time: i64| -> Vec<Value> {
            std::iter::once(Value::Int(time)).chain(hooks.iter().map(Value::from)).collect()
        };
        // Most of the time there is none, and nobody waits for the writer.
        let is_due = self.database.read(|from| from.maybe_row(&due, &with_time(now())))?.is_some();
        if !is_due {
            return Ok(None);
        }
        self.database.write(|to| {
            let time = now();
            let Some(mut found) = to.maybe_row(&due, &with_time(time))? else { return Ok(None) };
            let number = found.int(0)?;
            to.change(
                "UPDATE delivery SET state = 'sending', worker = $2, until = $3, attempts = attempts + 1 WHERE number = $1",
                values![number, worker, time + seconds],
            )?;
            let mut row = to.row(
                "SELECT d.hook, d.id, d.body, d.attempts, h.target, h.secret FROM delivery d
                 JOIN hook h ON h.id = d.hook WHERE d.number = $1",
                values![number],
            )?;
            Ok(Some(Due {
                number,
                hook: row.text(0)?,
                id: row.text(1)?,
                body: row.text(2)?,
                attempt: row.int(3)?,
                target: row.text(4)?,
                secret: row.bytes(5)?,
            }))
        })
    }

    /// Ends an attempt of a worker; whether the delivery was still the worker's.
    pub(crate) fn end_attempt(&self, worker: &str, due: &Due, end: &Attempt) -> Result<bool, StoreError> {
        self.database.write(|to| {
            let time = now();
            let (state, status, reason, next) = match end {
                Attempt::Delivered(status) => ("delivered", Some(*status), "", None),
                Attempt::Gone(status) => ("given-up", Some(*status), "", None),
                Attempt::Failed { status, reason, pause: None } => ("given-up", *status, &**reason, None),
                Attempt::Failed { status, reason, pause: Some(pause) } => {
                    ("failed", *status, &**reason, Some(time + pause))
                }
            };
            let ended = next.is_none().then_some(time);
            let changed = to.change(
                "UPDATE delivery SET state = $3, status = $4, reason = $5, next = $6, ended = $7, worker = '', until = 0
                 WHERE number = $1 AND worker = $2 AND state = 'sending'",
                values![
                    due.number,
                    worker,
                    state,
                    status.map(i64::from),
                    reason,
                    next.unwrap_or(time),
                    ended
                ],
            )?;
            if changed == 0 {
                return Ok(false);
            }
            if matches!(end, Attempt::Gone(_)) {
                self.stop_hook(to, &due.hook, time)?;
            }
            Ok(true)
        })
    }

    /// Stops a hook whose receiver wants nothing more.
    fn stop_hook(&self, to: &dyn Session, hook: &str, time: i64) -> Result<(), StoreError> {
        to.change("UPDATE hook SET state = $2 WHERE id = $1", values![hook, HookState::Stopped.name()])?;
        to.change(
            "UPDATE delivery SET state = 'given-up', reason = 'the hook is stopped', ended = $2
             WHERE hook = $1 AND ended IS NULL",
            values![hook, time],
        )?;
        self.note(to, "hook.stop", hook, "its receiver has answered 410")
    }

    /// Deliveries of a hook before a number, the newest first, so many at most.
    pub(crate) fn deliveries(&self, hook: &str, before: i64, most: u32) -> Result<Vec<Delivery>, StoreError> {
        self.may(Act::Administer, "")?;
        self.database.read(|from| {
            from.row("SELECT id FROM hook WHERE id = $1", values![hook])?;
            let sql = format!("{DELIVERY} WHERE hook = $1 AND number < $2 ORDER BY number DESC LIMIT $3");
            from.read(&sql, values![hook, before, most], read)
        })
    }

    /// Has a delivery sent again, as if it had not been sent before.
    ///
    /// # Errors
    /// [`StoreError::Changed`] where it is being sent, or its hook is stopped.
    pub(crate) fn send_again(&self, hook: &str, id: &str) -> Result<Delivery, StoreError> {
        self.may(Act::Administer, "")?;
        self.database.write(|to| {
            let mut of = to.row("SELECT state FROM hook WHERE id = $1", values![hook])?;
            let is_active = of.text(0)? == HookState::Active.name();
            let one = format!("{DELIVERY} WHERE hook = $1 AND id = $2");
            let there = read(to.row(&one, values![hook, id])?)?;
            if !is_active || there.state == "sending" {
                return Err(StoreError::Changed);
            }
            to.change(
                "UPDATE delivery SET state = 'waiting', attempts = 0, next = $2, ended = NULL WHERE number = $1",
                values![there.number, now()],
            )?;
            self.note(to, "hook.send", hook, id)?;
            read(to.row(&one, values![hook, id])?)
        })
    }

    /// Gives up deliveries that no process may send, and lets go of those that have ended long ago.
    pub(crate) fn tidy_deliveries(&self) -> Result<(), StoreError> {
        let before = now() - KEPT;
        let old = "SELECT number FROM delivery WHERE ended < $1 OR ended IS NULL AND moment < $1 AND next < $1 LIMIT 1";
        // A full disk is no reason to write in vain.
        if self.database.read(|from| from.maybe_row(old, values![before]))?.is_none() {
            return Ok(());
        }
        self.database.write(|to| {
            to.change("DELETE FROM delivery WHERE ended < $1", values![before])?;
            to.change(
                "UPDATE delivery SET state = 'given-up', reason = 'no process may send to its target', ended = $2
                 WHERE ended IS NULL AND moment < $1 AND next < $1 AND state <> 'sending'",
                values![before, now()],
            )?;
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::Place;
    use super::super::{EventKind, Hook};
    use super::*;

    const SECRET: &[u8] = b"secret";

    /// A store with hooks that are told of jobs.
    fn store(hooks: &[&str]) -> (tempfile::TempDir, Store) {
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store::open(&Place::File(folder.path().join("a.sqlite"))).expect("a store");
        for id in hooks {
            let hook = Hook {
                id: (*id).to_owned(),
                target: format!("http://127.0.0.1:1/{id}"),
                events: vec![EventKind::Job],
                folder: String::new(),
                state: HookState::Active,
                author: "ana".to_owned(),
                made: 0,
            };
            store.create_hook(&hook, SECRET, "").expect("a hook");
        }
        (folder, store)
    }

    /// An event: a job without programs has ended when it is made.
    fn event(store: &Store, job: &str) {
        store.create_job(job, "{}", "ana", &[]).expect("a job");
    }

    fn claim(store: &Store, worker: &str, seconds: i64) -> Option<Due> {
        store.claim_delivery(worker, &["a".to_owned(), "b".to_owned()], seconds).expect("a store")
    }

    fn only(store: &Store, hook: &str) -> Delivery {
        let all = store.deliveries(hook, i64::MAX, 10).expect("a list");
        assert_eq!(all.len(), 1, "{all:?}");
        all[0].clone()
    }

    fn failed(pause: Option<i64>) -> Attempt {
        Attempt::Failed { status: Some(500), reason: String::new(), pause }
    }

    #[test]
    fn a_delivery_of_a_worker_that_has_died_is_sent_by_another_under_the_same_name() {
        let (_folder, store) = store(&["a"]);
        event(&store, "j");
        // Its time is over before it begins.
        let dead = claim(&store, "dead", -1).expect("a delivery");
        let alive = claim(&store, "alive", 60).expect("the delivery again");
        assert_eq!((&dead.id, &dead.body, dead.attempt + 1), (&alive.id, &alive.body, alive.attempt));
        assert!(claim(&store, "third", 60).is_none());
        assert!(!store.end_attempt("dead", &dead, &Attempt::Delivered(200)).expect("a store"));
        assert!(store.end_attempt("alive", &alive, &Attempt::Delivered(204)).expect("a store"));
        assert!(!store.end_attempt("alive", &alive, &failed(None)).expect("a store"));
        let ended = only(&store, "a");
        assert_eq!((ended.state.as_str(), ended.status, ended.attempts), ("delivered", Some(204), 2));
        assert!(claim(&store, "third", 60).is_none());
    }

    #[test]
    fn one_delivery_of_a_hook_is_sent_at_a_time() {
        let (_folder, store) = store(&["a", "b"]);
        event(&store, "j");
        event(&store, "k");
        let first = claim(&store, "w", 60).expect("a delivery");
        let second = claim(&store, "w", 60).expect("a delivery");
        assert_ne!(first.hook, second.hook);
        // Both hooks are told of the same event.
        assert_eq!(first.id, second.id);
        assert!(claim(&store, "w", 60).is_none());
        store.end_attempt("w", &first, &Attempt::Delivered(200)).expect("a store");
        let third = claim(&store, "w", 60).expect("a delivery");
        assert_eq!(third.hook, first.hook);
        assert_ne!(third.id, first.id);
    }

    #[test]
    fn a_failed_delivery_waits_for_its_time_and_is_given_up_at_last() {
        let (_folder, store) = store(&["a"]);
        event(&store, "j");
        let due = claim(&store, "w", 60).expect("a delivery");
        store.end_attempt("w", &due, &failed(Some(1000))).expect("a store");
        let waits = only(&store, "a");
        assert_eq!((waits.state.as_str(), waits.ended), ("failed", None));
        assert!(waits.next.is_some_and(|next| next >= now() + 900));
        assert!(claim(&store, "w", 60).is_none());
        // Somebody does not want to wait.
        assert_eq!(store.send_again("a", &due.id).expect("a store").state, "waiting");
        let again = claim(&store, "w", 60).expect("the delivery");
        assert_eq!((again.attempt, &again.id), (1, &due.id));
        assert!(matches!(store.send_again("a", &due.id), Err(StoreError::Changed)), "it is being sent");
        store.end_attempt("w", &again, &failed(None)).expect("a store");
        let over = only(&store, "a");
        assert_eq!((over.state.as_str(), over.next, over.status), ("given-up", None, Some(500)));
        assert!(claim(&store, "w", 60).is_none());
    }

    #[test]
    fn a_hook_that_is_stopped_is_told_of_nothing() {
        let (_folder, store) = store(&["a", "b"]);
        event(&store, "j");
        let due = store.claim_delivery("w", &["a".to_owned()], 60).expect("a store").expect("a delivery");
        event(&store, "k");
        store.end_attempt("w", &due, &Attempt::Gone(410)).expect("a store");
        event(&store, "l");
        let all = store.deliveries("a", i64::MAX, 10).expect("a list");
        let states: Vec<_> = all.iter().map(|own| (own.subject.as_str(), own.state.as_str())).collect();
        assert_eq!(states, [("k", "given-up"), ("j", "given-up")]);
        assert_eq!(store.hook("a").expect("a hook").state, HookState::Stopped);
        assert_eq!(store.active_hooks().expect("hooks").len(), 1);
        assert!(matches!(store.send_again("a", &due.id), Err(StoreError::Changed)));
        assert_eq!(store.deliveries("b", i64::MAX, 10).expect("a list").len(), 3);
        let audit = store.audit(&super::super::super::Filter::default(), i64::MAX, 10).expect("an audit");
        assert!(audit.iter().any(|entry| entry.action == "hook.stop" && entry.subject == "a"));
    }

    #[test]
    fn deliveries_of_long_ago_are_gone_and_those_that_nobody_sends_are_given_up() {
        let (_folder, store) = store(&["a"]);
        for job in ["ended", "waiting", "young"] {
            event(&store, job);
        }
        let sql = |sql: &str, moment: i64| {
            store.database.write(|to| to.change(sql, values![moment])).expect("a change")
        };
        let long_ago = now() - KEPT - 1;
        sql("UPDATE delivery SET state = 'delivered', ended = $1 WHERE subject = 'ended'", long_ago);
        sql("UPDATE delivery SET moment = $1, next = $1 WHERE subject = 'waiting'", long_ago);
        sql("UPDATE delivery SET moment = $1, next = $1 WHERE subject = 'young'", now() - KEPT + 1000);
        store.tidy_deliveries().expect("a store");
        let all = store.deliveries("a", i64::MAX, 10).expect("a list");
        let states: Vec<_> = all.iter().map(|own| (own.subject.as_str(), own.state.as_str())).collect();
        assert_eq!(states, [("young", "waiting"), ("waiting", "given-up")]);
    }

    #[test]
    fn there_are_not_more_hooks_than_there_may_be() {
        let names: Vec<String> = (0..100).map(|number| format!("h{number:03}")).collect();
        let (_folder, store) = store(&names.iter().map(String::as_str).collect::<Vec<_>>());
        let one_more = Hook { id: "x".to_owned(), ..store.hook("h000").expect("a hook") };
        assert!(matches!(store.create_hook(&one_more, SECRET, ""), Err(StoreError::TooMany)));
        assert_eq!(store.hooks("h097", 10).expect("a list").len(), 2);
    }
}
