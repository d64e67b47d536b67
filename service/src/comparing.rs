//! Each revision compared with the one before it, by background workers: the line of a list of revisions.
//!
//! Not here: who waits (`store::comparisons`), and comparisons that a request asks for (`api`).

use std::time::Duration;

use ncc_exec::halt;
use serde_json::Value;

use crate::api::compare;
use crate::facts::Next;
use crate::http::Problem;
use crate::store::{Comparison, Pair, Store, Verdict};

/// Seconds for which a revision is claimed; more than both executions may take.
const CLAIM: i64 = 90;

/// Makes the comparison that waits longest. It is done under the limit of time of the compiler's work.
///
/// # Errors
/// The store. The revision is claimed again after a while.
pub(crate) fn next(store: &Store, worker: &str, limit: Duration) -> Result<Next, Problem> {
    let Some(pair) = store.claim_comparison(worker, CLAIM)? else { return Ok(Next::Nothing) };
    let made = comparison(store, &pair, limit);
    // The halt of this work alone was asked for when its time was over; this one is that of the process.
    if halt::under(None, halt::is_asked) {
        store.give_comparison_back(worker, &pair)?;
        return Ok(Next::Stopped);
    }
    store.keep_comparison(worker, &pair, &made?)?;
    Ok(Next::Done)
}

fn comparison(store: &Store, pair: &Pair, limit: Duration) -> Result<Comparison, Problem> {
    let not_compared = |line: String| Ok(Comparison { verdict: Verdict::NotCompared, line });
    let sides =
        [store.revision(&pair.program, pair.number - 1)?, store.revision(&pair.program, pair.number)?];
    let [a, b] = &sides;
    let stated = |of: &crate::store::Revision| (of.details.dialect.clone(), of.details.machine.clone());
    if a.content.sha256 == b.content.sha256 && stated(a) == stated(b) {
        return Ok(Comparison { verdict: Verdict::Equal, line: "the same text".to_owned() });
    }
    if !pair.may_run {
        return not_compared("ncc ended while it compared the revisions".to_owned());
    }
    let compared = compare(store, sides, None);
    if halt::is_asked() {
        return not_compared(format!("it was stopped after {} s", limit.as_secs()));
    }
    match compared {
        Ok([document, _]) => {
            let document: Value = serde_json::from_slice(&document).map_err(|_| Problem::fault())?;
            let verdict = if document["equal"] == true { Verdict::Equal } else { Verdict::Different };
            Ok(Comparison { verdict, line: document["summary"].as_str().unwrap_or_default().to_owned() })
        }
        Err(problem) if problem.is_of_the_service() => Err(problem),
        Err(problem) => {
            let body = problem.body();
            let messages = body["messages"].as_str().unwrap_or_default();
            not_compared(messages.lines().next().unwrap_or(problem.detail()).trim().to_owned())
        }
    }
}
