//! First in, first out, in one piece of memory.
//!
//! What has gone leaves a gap at the front, which is closed when it is at least as long as what is
//! left: so each item is moved once at most, on the average, and a queue can be looked at as a slice. A
//! ring would be no shorter, and every look at it would have two parts.

/// Items that have gone before their gap is worth closing.
const GAP: usize = 16;

/// A queue.
#[derive(Clone, Debug)]
pub(crate) struct Queue<T> {
    /// The first `gone` of them have gone.
    items: Vec<T>,
    gone: usize,
}

impl<T> Default for Queue<T> {
    fn default() -> Queue<T> {
        Queue { items: Vec::new(), gone: 0 }
    }
}

impl<T> Queue<T> {
    pub(crate) fn len(&self) -> usize {
        self.items.len() - self.gone
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(crate) fn push(&mut self, item: T) {
        self.items.push(item);
    }

    pub(crate) fn last(&self) -> Option<&T> {
        if self.is_empty() { None } else { self.items.last() }
    }

    /// All of them, the first first.
    pub(crate) fn all(&mut self) -> &mut [T] {
        self.items.get_mut(self.gone..).unwrap_or_default()
    }

    /// The last goes.
    pub(crate) fn drop_last(&mut self) {
        if !self.is_empty() {
            self.items.pop();
        }
    }

    /// So many of the first go; no more than there are.
    pub(crate) fn drop_first(&mut self, count: usize) {
        self.gone = (self.gone + count).min(self.items.len());
        if self.gone >= GAP && 2 * self.gone >= self.items.len() {
            self.items.drain(..self.gone);
            self.gone = 0;
        }
    }

    /// All go.
    pub(crate) fn clear(&mut self) {
        self.items.clear();
        self.gone = 0;
    }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;

    use super::Queue;

    #[test]
    fn it_is_a_queue() {
        let mut queue = Queue::default();
        let mut model = VecDeque::new();
        let mut random = fastrand::Rng::with_seed(1);
        for i in 0..20_000 {
            // It grows for a while, and shrinks for a while.
            let busy = if i / 500 % 2 == 0 { 6 } else { 3 };
            match random.u32(0..8) {
                n if n < busy => {
                    queue.push(i);
                    model.push_back(i);
                }
                7 => {
                    queue.drop_last();
                    model.pop_back();
                }
                _ => {
                    let count = random.usize(0..4).min(model.len());
                    queue.drop_first(count);
                    model.drain(..count);
                    // The gap is shorter than what is left, or short.
                    assert!(queue.gone < queue.len().max(super::GAP));
                }
            }
            assert_eq!(queue.len(), model.len());
            assert_eq!(queue.last(), model.back());
            assert_eq!(queue.all(), model.make_contiguous());
        }
        queue.clear();
        assert!(queue.is_empty() && queue.last().is_none() && queue.all().is_empty());
    }
}
