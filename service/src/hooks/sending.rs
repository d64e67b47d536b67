//! Sends messages that are due, a few at once, until the process is asked to stop.
//!
//! A message is claimed for a while, sent under a limit of time, and ended by what the receiver answers: 2xx is the end, 410 that of the
//! hook, and everything else is tried again later. A process that is killed in between leaves its claim, which another one takes over:
//! the receiver may get a message twice, under one name.

use std::sync::Arc;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use tokio::sync::{Semaphore, watch};
use tokio::task::JoinSet;

use super::Targets;
use super::targets::Message;
use crate::Shared;
use crate::access::Caller;
use crate::http::Problem;
use crate::observe;
use crate::rights::Who;
use crate::store::{Attempt, Due, Store};
use crate::workers::Pauses;

/// Seconds for which a message is claimed; more than its attempt may take.
const CLAIM: i64 = 60;

/// Messages that a process sends at once. One receiver gets one at a time.
const AT_ONCE: usize = 4;

/// The status of a receiver that wants nothing more.
const GONE: u16 = 410;

/// Interval in which messages of long ago are looked for.
const TIDY: Duration = Duration::from_secs(3600);

/// Pause after a fault of the store.
const FAULT: Duration = Duration::from_secs(5);

/// A message that this process has claimed, and the name by which it has.
struct Claimed {
    worker: String,
    due: Due,
}

/// Claims the next message to an address that this process may send to.
fn claim(store: &Store, targets: &Targets) -> Result<Option<Claimed>, Problem> {
    let hooks = store.active_hooks()?.into_iter();
    let hooks: Vec<String> =
        hooks.filter(|hook| targets.allowed(&hook.target).is_ok()).map(|hook| hook.id).collect();
    let worker = crate::api::new_id()?;
    Ok(store.claim_delivery(&worker, &hooks, CLAIM)?.map(|due| Claimed { worker, due }))
}

/// Sends messages until the process is asked to stop; those that are being sent end first. Without targets it sends nothing.
pub(crate) async fn run(shared: Arc<Shared>, mut stop: watch::Receiver<bool>) {
    if shared.targets.get().is_none() {
        return;
    }
    let ncc = Caller::of(Who::service());
    let places = Arc::new(Semaphore::new(AT_ONCE));
    let mut sending = JoinSet::new();
    let mut pauses = Pauses::of(&shared.hook_bell);
    while !*stop.borrow() {
        while sending.try_join_next().is_some() {}
        let place = tokio::select! {
            place = Arc::clone(&places).acquire_owned() => place,
            _ = stop.changed() => break,
        };
        let own = Arc::clone(&shared);
        let next = move |store: &Store| own.targets.get().map_or(Ok(None), |targets| claim(store, targets));
        match shared.store(&ncc, next).await {
            Ok(Some(claimed)) => {
                pauses.reset();
                let (shared, ncc) = (Arc::clone(&shared), ncc.clone());
                sending.spawn(async move {
                    deliver(&shared, &ncc, claimed).await;
                    drop(place);
                    // The next message to the same receiver may be sent now.
                    shared.hook_bell.ring();
                });
            }
            Ok(None) => {
                drop(place);
                pauses.wait(&mut stop).await;
            }
            Err(problem) => {
                observe::fault(&format!("hooks are told of nothing: {}", problem.detail()));
                let _ = tokio::time::timeout(FAULT, stop.changed()).await;
            }
        }
    }
    while sending.join_next().await.is_some() {}
}

/// Sends a message, and notes what became of it.
async fn deliver(shared: &Arc<Shared>, ncc: &Caller, claimed: Claimed) {
    let own = Arc::clone(shared);
    let Claimed { worker, due } = claimed;
    let sent = due.clone();
    let end = tokio::task::spawn_blocking(move || own.targets.get().map(|targets| attempt(targets, &sent)));
    // A fault of ncc leaves the claim, and so the message, to the next attempt.
    let Ok(Some(end)) = end.await else {
        observe::fault(&format!("the message {} of the hook {} broke off", due.id, due.hook));
        return;
    };
    let name = match &end {
        Attempt::Delivered(_) => "delivered",
        Attempt::Failed { pause: Some(_), .. } => "failed",
        Attempt::Failed { .. } | Attempt::Gone(_) => "given-up",
    };
    let told = format!("the message {} of the hook {} was given up", due.id, due.hook);
    match shared.store(ncc, move |store| Ok(store.end_attempt(&worker, &due, &end)?)).await {
        Ok(true) => {
            shared.counters.count_delivery(name);
            if name == "given-up" {
                observe::fault(&told);
            }
        }
        // Another process has taken it over.
        Ok(false) => {}
        Err(problem) => observe::fault(&format!("a message of a hook was not ended: {}", problem.detail())),
    }
}

/// Tries to send a message once. Its address is held against the targets of this process again: the hook may have been made under
/// others.
fn attempt(targets: &Targets, due: &Due) -> Attempt {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    let timestamp = since.map_or(0, |since| i64::try_from(since.as_secs()).unwrap_or(0));
    let message = Message { id: &due.id, timestamp, body: &due.body, secret: &due.secret };
    let answer =
        targets.allowed(&due.target).map_err(str::to_owned).and_then(|to| targets.send(&to, &message));
    let pause =
        targets.pause_after(due.attempt).map(|pause| i64::try_from(pause.as_secs()).unwrap_or(i64::MAX));
    match answer {
        Ok(status @ 200..300) => Attempt::Delivered(status),
        Ok(GONE) => Attempt::Gone(GONE),
        Ok(status) => Attempt::Failed { status: Some(status), reason: String::new(), pause },
        Err(reason) => Attempt::Failed { status: None, reason, pause },
    }
}

/// Lets go of messages of long ago, in a process without targets too, until it is asked to stop.
pub(crate) async fn tidy(shared: Arc<Shared>, mut stop: watch::Receiver<bool>) {
    let ncc = Caller::of(Who::service());
    while !*stop.borrow() {
        if let Err(problem) = shared.store(&ncc, |store| Ok(store.tidy_deliveries()?)).await {
            observe::fault(&format!("messages of long ago stay: {}", problem.detail()));
        }
        let _ = tokio::time::timeout(TIDY, stop.changed()).await;
    }
}
