//! Workers: those of jobs, of which each claims a task, does it, and ends it; and those that compute facts of programs
//! and compare revisions.
//!
//! A worker that is asked to stop gives its task back. One that is killed cannot: its task is claimed again after a while.

use std::sync::Arc;
use std::time::Duration;

use axum::extract::{Request, State};
use axum::http::Method;
use axum::middleware::Next as Handler;
use axum::response::Response;
use serde_json::{Value, json};
use tokio::sync::watch;

use crate::Shared;
use crate::access::{Caller, guard};
use crate::comparing;
use crate::facts::{self, Next};
use crate::http::Problem;
use crate::rights::Who;
use crate::store::{End, Store, Task};
use crate::translating::{Asked, translate};

/// Seconds for which a task is claimed; more than it may take.
const CLAIM: i64 = 60;

/// Interval in which a worker looks for a task, and a busy worker for a cancelled job.
const GLANCE: Duration = Duration::from_millis(250);

/// Longest interval of a worker that finds none for a while. Tasks of other processes wait as long.
const REST: Duration = Duration::from_secs(2);

/// Wakes the workers of this process.
pub(crate) struct Bell(watch::Sender<()>);

impl Bell {
    pub(crate) fn new() -> Bell {
        Bell(watch::Sender::new(()))
    }

    /// Wakes them.
    pub(crate) fn ring(&self) {
        self.0.send_replace(());
    }
}

/// Wakes the workers after each request that may have made a task, or an event for a hook.
pub(crate) async fn ring(State(shared): State<Arc<Shared>>, request: Request, next: Handler) -> Response {
    // Documents of the case study make none.
    let reads = matches!(*request.method(), Method::GET | Method::HEAD);
    let makes_none = reads || !request.uri().path().starts_with("/api/v1/");
    let answer = next.run(request).await;
    if !makes_none {
        shared.bell.ring();
        shared.hook_bell.ring();
    }
    answer
}

/// The pauses of an idle worker: longer and longer, until there is something to do.
pub(crate) struct Pauses {
    bell: watch::Receiver<()>,
    next: Duration,
}

impl Pauses {
    /// Of a worker that a bell wakes.
    pub(crate) fn of(bell: &Bell) -> Pauses {
        Pauses { bell: bell.0.subscribe(), next: GLANCE }
    }

    /// There is something to do.
    pub(crate) fn reset(&mut self) {
        self.next = GLANCE;
    }

    /// Waits until the pause is over, the bell rings, or the worker is asked to stop.
    pub(crate) async fn wait(&mut self, stop: &mut watch::Receiver<bool>) {
        let pause = self.next;
        self.next = (pause * 2).min(REST);
        tokio::select! {
            () = tokio::time::sleep(pause) => {}
            _ = stop.changed() => {}
            Ok(()) = self.bell.changed() => self.reset(),
        }
    }
}

/// Reason why a task has no result.
enum Left {
    Cancelled,
    Stopped,
}

/// Works until it is asked to stop.
pub(crate) async fn work(shared: Arc<Shared>, mut stop: watch::Receiver<bool>) {
    let ncc = Caller::of(Who::service());
    let Ok(name) = crate::api::new_id() else {
        crate::observe::fault("a worker has no name: the system gives no random bytes");
        return;
    };
    let mut pauses = Pauses::of(&shared.bell);
    while !*stop.borrow() {
        let worker = name.clone();
        let claimed = shared.store(&ncc, move |store| Ok(store.claim(&worker, CLAIM)?)).await;
        let task = match claimed {
            Ok(Some(task)) => task,
            Ok(None) => {
                pauses.wait(&mut stop).await;
                continue;
            }
            Err(problem) => {
                crate::observe::fault(&format!("a worker finds no task: {}", problem.detail()));
                let _ = tokio::time::timeout(GLANCE * 20, stop.changed()).await;
                continue;
            }
        };
        pauses.reset();
        let done = do_task(&shared, &ncc, &task, &mut stop).await;
        let worker = name.clone();
        let ended = shared
            .store(&ncc, move |store| {
                match done {
                    Ok((end, result)) => {
                        store.end_task(&worker, &task, end, &result.to_string())?;
                    }
                    Err(Left::Cancelled) => {
                        store.end_task(&worker, &task, End::Cancelled, "")?;
                    }
                    Err(Left::Stopped) => store.give_back(&worker, &task)?,
                }
                Ok(())
            })
            .await;
        match ended {
            // It may have been the last one of its job.
            Ok(()) => shared.hook_bell.ring(),
            Err(problem) => {
                crate::observe::fault(&format!("a task was not ended: {}", problem.detail()));
            }
        }
    }
}

/// Computes facts of programs that wait for them, and then comparisons of revisions, until it is asked to stop.
pub(crate) async fn compute_facts(shared: Arc<Shared>, mut stop: watch::Receiver<bool>) {
    let Ok(name) = crate::api::new_id() else {
        crate::observe::fault("a worker has no name: the system gives no random bytes");
        return;
    };
    // Facts are those of all programs; who reads them is asked when they are searched.
    let caller = Caller::of(Who::service());
    let limit = shared.pool.limit();
    let mut pauses = Pauses::of(&shared.bell);
    while !*stop.borrow() {
        let worker = name.clone();
        // A thread of the compiler is taken only where there is something to do, and the claim begins with it.
        let wait = |store: &Store| Ok([store.facts_wait()?, store.comparisons_wait()?]);
        let done = match shared.store(&caller, wait).await {
            Ok([false, false]) => Ok(Next::Nothing),
            Ok([true, _]) => {
                shared.compile_in_turn(&caller, move |store| facts::next(store, &worker, limit)).await
            }
            Ok([false, true]) => {
                shared.compile_in_turn(&caller, move |store| comparing::next(store, &worker, limit)).await
            }
            Err(problem) => Err(problem),
        };
        match done {
            Ok(Next::Done) => {
                pauses.reset();
                // A translation may have become stale.
                shared.hook_bell.ring();
            }
            Ok(Next::Nothing) => pauses.wait(&mut stop).await,
            Ok(Next::Stopped) => return,
            Err(problem) => {
                crate::observe::fault(&format!(
                    "facts or a comparison of a program were not computed: {}",
                    problem.detail()
                ));
                let _ = tokio::time::timeout(GLANCE * 20, stop.changed()).await;
            }
        }
    }
}

/// Does a task, unless its job is cancelled or the worker asked to stop meanwhile.
async fn do_task(
    shared: &Arc<Shared>,
    ncc: &Caller,
    task: &Task,
    stop: &mut watch::Receiver<bool>,
) -> Result<(End, Value), Left> {
    let own = task.clone();
    let author = match guard::author(shared, &task.author).await {
        Ok(author) => author,
        Err(problem) => return Ok((End::Refused, told(&problem))),
    };
    let mut work = std::pin::pin!(shared.compile_in_turn(&author, move |store| Ok(translated(store, &own))));
    loop {
        tokio::select! {
            done = &mut work => {
                // A stop of the process has stopped the work too.
                let ended = done.unwrap_or_else(|problem| (End::Refused, told(&problem)));
                return if ncc_exec::halt::is_asked() { Err(Left::Stopped) } else { Ok(ended) };
            }
            _ = stop.wait_for(|stop| *stop) => return Err(Left::Stopped),
            () = tokio::time::sleep(GLANCE) => {}
        }
        let job = task.job.clone();
        if shared.store(ncc, move |store| Ok(store.job(&job)?.is_cancelled)).await.unwrap_or(false) {
            return Err(Left::Cancelled);
        }
    }
}

/// Translates the program of a task.
fn translated(store: &Store, task: &Task) -> (End, Value) {
    let asked: Result<Asked, _> = serde_json::from_str(&task.asked);
    let Ok(mut asked) = asked else { return (End::Refused, told(&Problem::fault())) };
    (asked.program, asked.revision) = (task.program.clone(), Some(task.revision));
    let made = crate::api::new_id().and_then(|id| translate(store, asked, id, &task.author));
    match made {
        Ok((made, is_new)) => (End::Done, json!({ "translation": made.id, "new": is_new })),
        Err(problem) => (End::Refused, told(&problem)),
    }
}

fn told(problem: &Problem) -> Value {
    json!({ "problem": problem.body() })
}
