//! The longest common subsequence of two lists whose elements are compared with a tolerance.
//!
//! [`myers`] finds it exactly (E. W. Myers, "An O(ND) difference algorithm and its variations", 1986), as
//! long as few enough elements are without a partner. [`between_anchors`] is for long lists that have little
//! in common: what stands once in each of them, by its quantised value, ties them together (patience
//! diff), and only what lies between two ties is searched.

/// A stretch of pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// First element of the first list.
    pub a: usize,
    /// Its partner in the second.
    pub b: usize,
    /// Number of pairs.
    pub len: usize,
}

/// Aligns the first `n` and `m` elements of two lists exactly; `None` if more than `most` elements of
/// both together would be without a partner.
pub fn myers(
    n: usize,
    m: usize,
    most: usize,
    same: &mut dyn FnMut(usize, usize) -> bool,
) -> Option<Vec<Run>> {
    let most = most.min(n + m);
    // reach[d] is how far every diagonal goes with d edits; diagonals -d, -d+2, … d.
    let mut reach: Vec<Vec<u32>> = Vec::new();
    for d in 0..=most {
        let mut now = Vec::with_capacity(d + 1);
        for k in 0..=d {
            // Diagonal k stands for x - y = 2k - d.
            let x = match reach.last() {
                None => 0,
                Some(before) => {
                    // From the diagonal above a step down, from that below a step to the right. One that
                    // has left the lists is no way.
                    let down = before.get(k).map(|x| *x as isize);
                    let right = k.checked_sub(1).and_then(|k| before.get(k)).map(|x| *x as isize + 1);
                    down.unwrap_or(-1).max(right.unwrap_or(-1)) as usize
                }
            };
            let diagonal = 2 * k as isize - d as isize;
            let mut x = x.min(n);
            let mut y = x as isize - diagonal;
            if y < 0 {
                x = diagonal as usize;
                y = 0;
            }
            let mut y = y as usize;
            while x < n && y < m && same(x, y) {
                x += 1;
                y += 1;
            }
            if x >= n && y >= m && diagonal == n as isize - m as isize {
                return Some(way_back(&reach, n, m));
            }
            now.push(x as u32);
        }
        reach.push(now);
    }
    None
}

/// The pairs of the way that has reached the end of both lists.
fn way_back(reach: &[Vec<u32>], n: usize, m: usize) -> Vec<Run> {
    let mut runs = Vec::new();
    let (mut x, mut y) = (n as isize, m as isize);
    for d in (0..=reach.len()).rev() {
        let (mut from_x, mut from_y) = (0, 0);
        let mut step = (0, 0);
        if d > 0 {
            let before = &reach[d - 1];
            let k = ((x - y) + d as isize) / 2;
            let down = usize::try_from(k).ok().and_then(|k| before.get(k)).map(|x| *x as isize);
            let right = usize::try_from(k - 1).ok().and_then(|k| before.get(k)).map(|x| *x as isize);
            let is_down = down.unwrap_or(-1) >= right.map_or(-1, |x| x + 1);
            let diagonal = (x - y) + if is_down { 1 } else { -1 };
            from_x = if is_down { down.unwrap_or(0) } else { right.unwrap_or(0) };
            from_y = from_x - diagonal;
            step = if is_down { (0, 1) } else { (1, 0) };
        }
        let start = (from_x + step.0, from_y + step.1);
        let len = x - start.0;
        if len > 0 {
            runs.push(Run { a: start.0 as usize, b: start.1 as usize, len: len as usize });
        }
        (x, y) = (from_x, from_y);
    }
    runs.reverse();
    joined(runs)
}

/// Joins stretches that follow each other.
fn joined(runs: Vec<Run>) -> Vec<Run> {
    let mut out: Vec<Run> = Vec::with_capacity(runs.len());
    for run in runs.into_iter().filter(|run| run.len > 0) {
        match out.last_mut() {
            Some(last) if last.a + last.len == run.a && last.b + last.len == run.b => last.len += run.len,
            Some(_) | None => out.push(run),
        }
    }
    out
}

/// Lists up to so long together are aligned exactly between two anchors.
const SHORT: usize = 4096;
/// Elements without a partner that a search between two anchors allows.
const MOST_EDITS: usize = 800;
/// How often what lies between two anchors is searched for further ones.
const DEEPEST: u8 = 4;

/// Aligns two lists of any length, not always the best way. `keys` are values of their elements; equal
/// elements should have equal ones, but need not always.
pub fn between_anchors(keys: [&[u64]; 2], same: &mut dyn FnMut(usize, usize) -> bool) -> Vec<Run> {
    let mut runs = Vec::new();
    between(keys, [0, 0], [keys[0].len(), keys[1].len()], 0, same, &mut runs);
    joined(runs)
}

fn between(
    keys: [&[u64]; 2],
    from: [usize; 2],
    to: [usize; 2],
    depth: u8,
    same: &mut dyn FnMut(usize, usize) -> bool,
    runs: &mut Vec<Run>,
) {
    let ([mut a, mut b], [mut to_a, mut to_b]) = (from, to);
    let start = Run { a, b, len: 0 };
    while a < to_a && b < to_b && same(a, b) {
        a += 1;
        b += 1;
    }
    runs.push(Run { len: a - start.a, ..start });
    let mut tail = 0;
    while a < to_a && b < to_b && same(to_a - 1, to_b - 1) {
        to_a -= 1;
        to_b -= 1;
        tail += 1;
    }
    if a < to_a && b < to_b {
        let (n, m) = (to_a - a, to_b - b);
        let exact = (n + m <= SHORT).then(|| myers(n, m, MOST_EDITS, &mut |i, j| same(a + i, b + j)));
        match exact.flatten() {
            Some(found) => runs.extend(found.iter().map(|run| Run { a: run.a + a, b: run.b + b, ..*run })),
            None if depth < DEEPEST => {
                let mut at = [a, b];
                for [i, j] in anchors(keys, [a, b], [to_a, to_b], same) {
                    if i >= at[0] && j >= at[1] {
                        between(keys, at, [i, j], depth + 1, same, runs);
                        // What goes on alike behind it needs no further anchors.
                        let mut len = 1;
                        while i + len < to_a && j + len < to_b && same(i + len, j + len) {
                            len += 1;
                        }
                        runs.push(Run { a: i, b: j, len });
                        at = [i + len, j + len];
                    }
                }
                if at != [a, b] {
                    between(keys, at, [to_a, to_b], depth + 1, same, runs);
                }
            }
            None => {}
        }
    }
    runs.push(Run { a: to_a, b: to_b, len: tail });
}

/// Pairs of elements that stand once in each list, in the longest order that both have.
fn anchors(
    keys: [&[u64]; 2],
    from: [usize; 2],
    to: [usize; 2],
    same: &mut dyn FnMut(usize, usize) -> bool,
) -> Vec<[usize; 2]> {
    let once = |side: usize| {
        let mut all: Vec<(u64, u32)> =
            (from[side]..to[side]).map(|i| (keys[side][i], (i - from[side]) as u32)).collect();
        all.sort_unstable();
        let lone = |i: usize| {
            (i == 0 || all[i - 1].0 != all[i].0) && (i + 1 == all.len() || all[i + 1].0 != all[i].0)
        };
        let lone: Vec<(u64, u32)> = (0..all.len()).filter(|i| lone(*i)).map(|i| all[i]).collect();
        lone
    };
    let (first, second) = (once(0), once(1));
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    let (mut i, mut j) = (0, 0);
    while i < first.len() && j < second.len() {
        match first[i].0.cmp(&second[j].0) {
            std::cmp::Ordering::Less => i += 1,
            std::cmp::Ordering::Greater => j += 1,
            std::cmp::Ordering::Equal => {
                if same(from[0] + first[i].1 as usize, from[1] + second[j].1 as usize) {
                    pairs.push([first[i].1, second[j].1]);
                }
                i += 1;
                j += 1;
            }
        }
    }
    drop((first, second));
    pairs.sort_unstable();
    in_order(&pairs).into_iter().map(|[i, j]| [from[0] + i as usize, from[1] + j as usize]).collect()
}

/// The longest subsequence in which the second places rise too.
fn in_order(pairs: &[[u32; 2]]) -> Vec<[u32; 2]> {
    // ends[l] is the pair that ends the subsequence of length l + 1 at the least second place.
    let mut ends: Vec<usize> = Vec::new();
    let mut before: Vec<usize> = Vec::with_capacity(pairs.len());
    for (i, pair) in pairs.iter().enumerate() {
        let at = ends.partition_point(|end| pairs[*end][1] < pair[1]);
        before.push(if at > 0 { ends[at - 1] } else { usize::MAX });
        match ends.get_mut(at) {
            Some(end) => *end = i,
            None => ends.push(i),
        }
    }
    let mut out = Vec::with_capacity(ends.len());
    let mut at = ends.last().copied().unwrap_or(usize::MAX);
    while let Some(pair) = pairs.get(at) {
        out.push(*pair);
        at = before[at];
    }
    out.reverse();
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The longest common subsequence by the book, in O(nm).
    fn longest(a: &[u8], b: &[u8], same: impl Fn(u8, u8) -> bool) -> usize {
        let mut table = vec![vec![0usize; b.len() + 1]; a.len() + 1];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                table[i + 1][j + 1] =
                    if same(*x, *y) { table[i][j] + 1 } else { table[i][j + 1].max(table[i + 1][j]) };
            }
        }
        table[a.len()][b.len()]
    }

    fn sound(runs: &[Run], a: &[u8], b: &[u8]) -> usize {
        let mut at = (0, 0);
        for run in runs {
            assert!(run.a >= at.0 && run.b >= at.1 && run.len > 0, "{runs:?}");
            assert_eq!(a[run.a..run.a + run.len], b[run.b..run.b + run.len]);
            at = (run.a + run.len, run.b + run.len);
        }
        runs.iter().map(|run| run.len).sum()
    }

    proptest! {
        #[test]
        fn myers_finds_the_longest(a in prop::collection::vec(0u8..5, 0..40), b in prop::collection::vec(0u8..5, 0..40)) {
            let runs = myers(a.len(), b.len(), 100, &mut |i, j| a[i] == b[j]).expect("within bounds");
            prop_assert_eq!(sound(&runs, &a, &b), longest(&a, &b, |x, y| x == y));
            let without = a.len() + b.len() - 2 * longest(&a, &b, |x, y| x == y);
            if without > 0 {
                prop_assert!(myers(a.len(), b.len(), without - 1, &mut |i, j| a[i] == b[j]).is_none());
            }
        }

        #[test]
        fn anchors_lie(a in prop::collection::vec(0u8..60, 0..200), b in prop::collection::vec(0u8..60, 0..200)) {
            let keys: [Vec<u64>; 2] = [&a, &b].map(|list| list.iter().map(|x| u64::from(*x)).collect());
            let runs = between_anchors([&keys[0], &keys[1]], &mut |i, j| a[i] == b[j]);
            sound(&runs, &a, &b);
        }
    }

    #[test]
    fn a_long_list_is_tied_at_what_stands_once() {
        let a: Vec<u64> = (0..20_000).collect();
        let mut b = a.clone();
        b.drain(5_000..9_000);
        b.splice(100..100, (0..3_000).map(|i| 1_000_000 + i));
        let runs = between_anchors([&a, &b], &mut |i, j| a[i] == b[j]);
        assert_eq!(
            runs,
            [
                Run { a: 0, b: 0, len: 100 },
                Run { a: 100, b: 3_100, len: 4_900 },
                Run { a: 9_000, b: 8_000, len: 11_000 }
            ]
        );
    }
}
