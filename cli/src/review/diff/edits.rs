//! The edits that make one list of lines of another, for lists of any length.
//!
//! The shortest edit of two long lists with many differences costs their product. So lines that are the
//! same are passed over, and from the first that is not the shortest edit is sought in a window of both
//! lists, which grows until it ends with enough lines in common. No more than that window is at hand. Not
//! here: what lines say (`text`), and where they are read (`lines`).

use std::io;
use std::time::{Duration, Instant};

use similar::{Algorithm, DiffOp, capture_diff_slices_deadline};

/// Lines of the first window.
const WINDOW: usize = 256;
/// How much larger the next one is.
const GROWTH: usize = 4;
/// Lines in common after which the two lists are taken to go on together.
const TOGETHER: usize = 32;
/// Seconds after which the shortest edit of a window is no longer sought, only some edit.
const PATIENCE: u64 = 5;

/// Two lists that are read as far as they are needed.
pub(crate) trait Lists {
    /// Reads on until so many items of one are at hand, or there are no more; gives how many are.
    ///
    /// # Errors
    /// Reading.
    fn read_ahead(&mut self, side: usize, wanted: usize) -> io::Result<usize>;

    /// Whether the first items at hand are the same.
    fn first_are_same(&self) -> bool;

    /// So many items at hand of both: the same number for items that are the same.
    fn ids(&self, counts: [usize; 2]) -> [Vec<u32>; 2];

    /// So many items at hand are done with; they are alike or an edit.
    fn pass(&mut self, counts: [usize; 2], alike: bool);
}

/// Edits from one list to the other, in their order; neighbours of one kind are one.
///
/// # Errors
/// Reading the lists.
pub(crate) fn edits(lists: &mut impl Lists) -> io::Result<Vec<DiffOp>> {
    let until = Instant::now() + Duration::from_secs(PATIENCE);
    let mut found = Edits::default();
    let (mut i, mut j) = (0, 0);
    loop {
        let mut same = 0;
        let mut ahead = [lists.read_ahead(0, 1)?, lists.read_ahead(1, 1)?];
        while !ahead.contains(&0) && lists.first_are_same() {
            lists.pass([1, 1], true);
            same += 1;
            ahead = [lists.read_ahead(0, 1)?, lists.read_ahead(1, 1)?];
        }
        found.push(DiffOp::Equal { old_index: i, new_index: j, len: same });
        (i, j) = (i + same, j + same);
        if ahead == [0, 0] {
            return Ok(found.ops);
        }
        let mut window = WINDOW;
        loop {
            let ahead = [lists.read_ahead(0, window + 1)?, lists.read_ahead(1, window + 1)?];
            let whole = ahead.iter().all(|ahead| *ahead <= window);
            let [part_a, part_b] = lists.ids(ahead.map(|ahead| ahead.min(window)));
            let ops = capture_diff_slices_deadline(Algorithm::Myers, &part_a, &part_b, Some(until));
            let together = ops
                .iter()
                .rposition(|op| matches!(op, DiffOp::Equal { len, .. } if *len >= TOGETHER))
                .or(whole.then_some(ops.len()));
            if let Some(end) = together {
                let (from_a, from_b) = (i, j);
                for op in &ops[..end] {
                    found.push(moved(op, from_a, from_b));
                    let counts = [op.old_range().len(), op.new_range().len()];
                    lists.pass(counts, matches!(op, DiffOp::Equal { .. }));
                    (i, j) = (i + counts[0], j + counts[1]);
                }
                break;
            }
            window *= GROWTH;
        }
    }
}

/// An edit of a window, in the whole lists.
fn moved(op: &DiffOp, by_a: usize, by_b: usize) -> DiffOp {
    match *op {
        DiffOp::Equal { old_index, new_index, len } => {
            DiffOp::Equal { old_index: old_index + by_a, new_index: new_index + by_b, len }
        }
        DiffOp::Delete { old_index, old_len, new_index } => {
            DiffOp::Delete { old_index: old_index + by_a, old_len, new_index: new_index + by_b }
        }
        DiffOp::Insert { old_index, new_index, new_len } => {
            DiffOp::Insert { old_index: old_index + by_a, new_index: new_index + by_b, new_len }
        }
        DiffOp::Replace { old_index, old_len, new_index, new_len } => {
            DiffOp::Replace { old_index: old_index + by_a, old_len, new_index: new_index + by_b, new_len }
        }
    }
}

/// Edits as they are found.
#[derive(Default)]
struct Edits {
    ops: Vec<DiffOp>,
}

impl Edits {
    fn push(&mut self, op: DiffOp) {
        if op.old_range().is_empty() && op.new_range().is_empty() {
            return;
        }
        if let (Some(DiffOp::Equal { len: before, .. }), DiffOp::Equal { len, .. }) =
            (self.ops.last_mut(), op)
        {
            *before += len;
            return;
        }
        self.ops.push(op);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lists in memory, of which so many items were passed.
    struct Slices<'l>([&'l [u32]; 2]);

    impl Lists for Slices<'_> {
        fn read_ahead(&mut self, side: usize, wanted: usize) -> io::Result<usize> {
            Ok(self.0[side].len().min(wanted))
        }

        fn first_are_same(&self) -> bool {
            self.0[0].first() == self.0[1].first()
        }

        fn ids(&self, counts: [usize; 2]) -> [Vec<u32>; 2] {
            [0, 1].map(|side| self.0[side][..counts[side]].to_vec())
        }

        fn pass(&mut self, counts: [usize; 2], alike: bool) {
            let [a, b] = [0, 1].map(|side| self.0[side].split_at(counts[side]));
            assert!(!alike || a.0 == b.0);
            self.0 = [a.1, b.1];
        }
    }

    fn edits(a: &[u32], b: &[u32]) -> Vec<DiffOp> {
        super::edits(&mut Slices([a, b])).expect("memory")
    }

    fn rng(state: &mut u32) -> u32 {
        *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        *state >> 8
    }

    /// A list, another that is edited in so many places, and how many lines the edits touch.
    fn pair(lines: u32, places: u32, seed: u32, kinds: u32) -> (Vec<u32>, Vec<u32>, usize) {
        let mut state = seed;
        let a: Vec<u32> = (0..lines).map(|n| if kinds == 0 { n } else { rng(&mut state) % kinds }).collect();
        let mut b = a.clone();
        let mut touched = 0;
        for _ in 0..places {
            let at = rng(&mut state) as usize % b.len();
            touched += 1;
            match rng(&mut state) % 3 {
                0 => b[at] = u32::MAX - rng(&mut state) % 1000,
                1 => drop(b.remove(at)),
                _ => b.insert(at, u32::MAX - rng(&mut state) % 1000),
            }
        }
        (a, b, touched)
    }

    /// What the edits make of the first list.
    fn applied(ops: &[DiffOp], a: &[u32], b: &[u32]) -> Vec<u32> {
        let mut out = Vec::new();
        let (mut i, mut j) = (0, 0);
        for op in ops {
            assert_eq!((op.old_range().start, op.new_range().start), (i, j), "without a gap");
            match op {
                DiffOp::Equal { .. } => {
                    assert_eq!(a[op.old_range()], b[op.new_range()]);
                    out.extend_from_slice(&a[op.old_range()]);
                }
                DiffOp::Delete { .. } => {}
                DiffOp::Insert { .. } | DiffOp::Replace { .. } => out.extend_from_slice(&b[op.new_range()]),
            }
            (i, j) = (op.old_range().end, op.new_range().end);
        }
        assert_eq!((i, j), (a.len(), b.len()));
        out
    }

    #[test]
    fn edits_make_the_second_list_of_the_first() {
        for (lines, places, kinds) in
            [(1, 1, 0), (40, 5, 0), (3000, 40, 0), (3000, 40, 5), (3000, 900, 3), (20_000, 1, 2)]
        {
            for seed in 0..20 {
                let (a, b, touched) = pair(lines, places, seed, kinds);
                let ops = edits(&a, &b);
                assert_eq!(applied(&ops, &a, &b), b, "{lines} {places} {kinds} {seed}");
                let gone: usize = ops
                    .iter()
                    .filter(|op| !matches!(op, DiffOp::Equal { .. }))
                    .map(|op| op.old_range().len().max(op.new_range().len()))
                    .sum();
                // Lines that are one of a kind leave no choice.
                assert!(kinds > 0 || gone <= touched, "{gone} > {touched}: {lines} {places} {seed}");
            }
        }
    }

    #[test]
    fn nothing_and_all() {
        assert!(edits(&[], &[]).is_empty());
        assert_eq!(edits(&[1, 2], &[1, 2]).len(), 1);
        assert_eq!(applied(&edits(&[1, 2], &[]), &[1, 2], &[]), Vec::<u32>::new());
        assert_eq!(applied(&edits(&[], &[1, 2]), &[], &[1, 2]), [1, 2]);
        let (a, b): (Vec<u32>, Vec<u32>) = ((0..5000).collect(), (10_000..14_000).collect());
        assert_eq!(applied(&edits(&a, &b), &a, &b), b);
    }
}
