//! Two makers of pieces and somebody who compares what they make.
//!
//! Each maker has a thread of its own and is a few pieces ahead at most, so that memory does not grow while both agree.
//! A host without threads, such as a page in a browser, runs one maker after the other and keeps what they make.

#![expect(clippy::disallowed_methods, reason = "the one place with threads, and with a way without")]

use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::sync::mpsc::sync_channel;
use std::thread;

use ncc_exec::halt;

/// Hands out the next piece; `None` at the end.
pub(crate) type Pieces<T> = Box<dyn FnMut() -> Option<T>>;

/// Takes a piece; breaks off where nobody wants further ones.
pub(crate) type Take<'t, T> = &'t mut dyn FnMut(T) -> ControlFlow<()>;

/// Runs both makers and hands what they make to `compare`. A maker's result is `None` if it broke off.
pub(crate) fn run<T, A, B, R, C>(
    first: A,
    second: B,
    ahead: usize,
    compare: impl FnOnce([Pieces<T>; 2]) -> C,
) -> (C, [Option<R>; 2])
where
    T: Send + 'static,
    R: Send,
    A: FnOnce(Take<T>) -> R + Send,
    B: FnOnce(Take<T>) -> R + Send,
{
    if !has_threads() {
        let (mut a, mut b) = (VecDeque::new(), VecDeque::new());
        let results = [Some(first(&mut keep(&mut a))), Some(second(&mut keep(&mut b)))];
        let pieces: [Pieces<T>; 2] = [Box::new(move || a.pop_front()), Box::new(move || b.pop_front())];
        return (compare(pieces), results);
    }
    let (to_a, from_a) = sync_channel(ahead);
    let (to_b, from_b) = sync_channel(ahead);
    let send = |to: &std::sync::mpsc::SyncSender<T>, piece: T| match to.send(piece) {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    };
    let [to_first, to_second] = [halt::own(), halt::own()];
    thread::scope(|scope| {
        let first = scope.spawn(move || halt::under(to_first, || first(&mut |piece| send(&to_a, piece))));
        let second = scope.spawn(move || halt::under(to_second, || second(&mut |piece| send(&to_b, piece))));
        let pieces: [Pieces<T>; 2] =
            [Box::new(move || from_a.recv().ok()), Box::new(move || from_b.recv().ok())];
        let compared = compare(pieces);
        (compared, [first.join().ok(), second.join().ok()])
    })
}

fn keep<T>(pieces: &mut VecDeque<T>) -> impl FnMut(T) -> ControlFlow<()> + '_ {
    |piece| {
        pieces.push_back(piece);
        ControlFlow::Continue(())
    }
}

/// Whether the host has threads.
fn has_threads() -> bool {
    static HAS: OnceLock<bool> = OnceLock::new();
    *HAS.get_or_init(|| thread::Builder::new().spawn(|| {}).is_ok_and(|thread| thread.join().is_ok()))
}
