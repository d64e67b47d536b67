//! Work of the compiler: a few pieces at once, each with a limit of time.
//!
//! A piece is asked to stop when its time is over, and when nobody waits for its answer any more. Not here: what is done.

use std::sync::Arc;
use std::time::Duration;

use ncc_exec::halt::{self, Halt};
use tokio::sync::Semaphore;

/// Reason why a piece of work has no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NotDone {
    /// Too many pieces wait already.
    Busy,
    /// Its time was over.
    TooLong,
    /// It ended by a fault of ncc.
    Broken,
}

/// Threads that compile.
pub(crate) struct Pool {
    threads: Arc<Semaphore>,
    places: Semaphore,
    limit: Duration,
    /// Number of threads.
    count: usize,
    /// Pieces of work at most, with those that wait.
    most: usize,
}

/// Asks the work to stop when it is dropped: with its request, when its time is over, or after its end without effect.
struct Waiting(Halt);

impl Drop for Waiting {
    fn drop(&mut self) {
        self.0.ask();
    }
}

impl Pool {
    /// So many threads; as many pieces of work for each of them wait at most.
    pub(crate) fn new(threads: usize, waiting: usize, limit: Duration) -> Pool {
        let most = threads * (1 + waiting);
        let places = Semaphore::new(most);
        Pool { threads: Arc::new(Semaphore::new(threads)), places, limit, count: threads, most }
    }

    /// Pieces of work that run, and that wait for a thread.
    pub(crate) fn load(&self) -> [usize; 2] {
        let running = self.count - self.threads.available_permits();
        let inside = self.most - self.places.available_permits();
        [running, inside.saturating_sub(running)]
    }

    /// Time limit of a piece of work.
    pub(crate) fn limit(&self) -> Duration {
        self.limit
    }

    /// Does a piece of work. One that ends well although its time was over is done: it may have been stored.
    pub(crate) async fn run<T: Send + 'static, E: Send + 'static>(
        &self,
        work: impl FnOnce() -> Result<T, E> + Send + 'static,
    ) -> Result<Result<T, E>, NotDone> {
        let _place = self.places.try_acquire().map_err(|_| NotDone::Busy)?;
        self.run_in_turn(work).await
    }

    /// The same as soon as a thread is free, however many wait.
    pub(crate) async fn run_in_turn<T: Send + 'static, E: Send + 'static>(
        &self,
        work: impl FnOnce() -> Result<T, E> + Send + 'static,
    ) -> Result<Result<T, E>, NotDone> {
        let thread = self.threads.clone().acquire_owned().await.map_err(|_| NotDone::Broken)?;
        let waiting = Waiting(Halt::default());
        let halt = waiting.0.clone();
        let mut done = tokio::task::spawn_blocking(move || {
            // Its thread is taken until it has stopped, also where nobody waits for it any more.
            let _thread = thread;
            halt::under(Some(halt), work)
        });
        if let Ok(done) = tokio::time::timeout(self.limit, &mut done).await {
            return done.map_err(|_| NotDone::Broken);
        }
        waiting.0.ask();
        match done.await {
            Ok(Ok(done)) => Ok(Ok(done)),
            Ok(Err(_)) => Err(NotDone::TooLong),
            Err(_) => Err(NotDone::Broken),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::Instant;

    use super::*;

    fn runtime() -> tokio::runtime::Runtime {
        tokio::runtime::Builder::new_multi_thread().enable_time().build().expect("a runtime")
    }

    fn until_asked() -> Result<(), ()> {
        let begun = Instant::now();
        while !halt::is_asked() && begun.elapsed() < Duration::from_secs(20) {
            std::thread::sleep(Duration::from_millis(1));
        }
        Err(())
    }

    #[test]
    fn work_that_takes_too_long_is_stopped() {
        let pool = Pool::new(1, 1, Duration::from_millis(30));
        let begun = Instant::now();
        assert_eq!(runtime().block_on(pool.run(until_asked)), Err(NotDone::TooLong));
        assert!(begun.elapsed() < Duration::from_secs(10));
    }

    #[test]
    fn work_that_was_done_all_the_same_is_told_so() {
        let pool = Pool::new(1, 1, Duration::from_millis(30));
        let deaf = || {
            std::thread::sleep(Duration::from_millis(200));
            Ok::<_, ()>(1)
        };
        assert_eq!(runtime().block_on(pool.run(deaf)), Ok(Ok(1)));
    }

    #[test]
    fn a_thread_is_taken_until_its_work_has_stopped() {
        let pool = Pool::new(1, 1, Duration::from_secs(10));
        let ended = Arc::new(AtomicBool::new(false));
        let seen = runtime().block_on(async {
            let deaf = ended.clone();
            let first = pool.run(move || {
                std::thread::sleep(Duration::from_millis(300));
                deaf.store(true, Ordering::SeqCst);
                Ok::<_, ()>(())
            });
            // Nobody waits for the first any more.
            let gone = tokio::time::timeout(Duration::from_millis(50), first).await;
            assert!(gone.is_err());
            pool.run(move || Ok::<_, ()>(ended.load(Ordering::SeqCst))).await
        });
        assert_eq!(seen, Ok(Ok(true)));
    }

    #[test]
    fn a_full_pool_takes_no_more() {
        let pool = Pool::new(1, 1, Duration::from_secs(10));
        let done = runtime().block_on(async {
            let first = pool.run(|| {
                std::thread::sleep(Duration::from_millis(50));
                Ok::<_, ()>(())
            });
            let second = pool.run(|| Ok::<_, ()>(()));
            let third = pool.run(|| Ok::<_, ()>(()));
            tokio::join!(first, second, third)
        });
        assert_eq!(done, (Ok(Ok(())), Ok(Ok(())), Err(NotDone::Busy)));
    }

    #[test]
    fn a_panic_is_the_end_of_its_own_work_alone() {
        let pool = Pool::new(1, 1, Duration::from_secs(10));
        let runtime = runtime();
        assert_eq!(
            runtime.block_on(pool.run(|| -> Result<u8, ()> { panic!("on purpose") })),
            Err(NotDone::Broken)
        );
        assert_eq!(runtime.block_on(pool.run(|| Ok::<_, ()>(1))), Ok(Ok(1)));
    }
}
