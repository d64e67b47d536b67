//! Work on several threads, of which the results come in the order of the work.

use std::collections::BTreeMap;
use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// The stack of a thread, in bytes: that of a program's first thread.
const STACK: usize = 8 << 20;

/// Does `work` for each of 0 to `count`, on at most `jobs` threads. `ended` is called whenever one has
/// ended, `done` with their results, in their order. Both are called on this thread.
///
/// # Errors
/// Not a single thread could be started.
pub(super) fn each<T: Send>(
    count: usize,
    jobs: usize,
    work: impl Fn(usize) -> T + Sync,
    mut ended: impl FnMut(),
    mut done: impl FnMut(usize, T),
) -> io::Result<()> {
    let next = AtomicUsize::new(0);
    let (send, receive) = mpsc::channel();
    thread::scope(|scope| {
        for started in 0..jobs.min(count) {
            let (send, next, work) = (send.clone(), &next, &work);
            let one = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, move || {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    if at >= count || send.send((at, work(at))).is_err() {
                        return;
                    }
                }
            });
            match one {
                Ok(_) => {}
                Err(error) if started == 0 => return Err(error),
                // Fewer threads do the same.
                Err(_) => break,
            }
        }
        drop(send);
        let mut early = BTreeMap::new();
        let mut turn = 0;
        for (at, result) in receive {
            ended();
            early.insert(at, result);
            while let Some(result) = early.remove(&turn) {
                done(turn, result);
                turn += 1;
            }
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn results_come_in_order_however_long_each_takes() {
        for jobs in [1, 3, 50] {
            let mut order = Vec::new();
            let mut ended = 0;
            let slow_first = |at: usize| {
                thread::sleep(Duration::from_millis(if at == 0 { 30 } else { 0 }));
                at * 2
            };
            each(20, jobs, slow_first, || ended += 1, |at, result| order.push((at, result))).unwrap();
            assert_eq!(order, (0..20).map(|at| (at, at * 2)).collect::<Vec<_>>(), "{jobs} jobs");
            assert_eq!(ended, 20);
        }
        each(0, 4, |_| (), || {}, |_, ()| panic!("there is nothing to do")).unwrap();
    }
}
