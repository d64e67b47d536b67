//! A second judge of alignment: the longest common subsequence by the book.

use proptest::prelude::*;

use ncc_exec::verify::Resolution;

use crate::change::Collector;
use crate::measure::{Measure, Shift};
use crate::record::{Batch, Record, Recorder, WORLDS};
use crate::resync::{Rules, compare};
use crate::tape::Tape;
use ncc_exec::world::World;
use ncc_exec::{Event, Exec, Kind, State};
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::ONE;
use ncc_ir::source::Span;

/// A step of a random program: a kind, a place of a few, a feed.
type Step = (bool, i64, i64, u8);

fn events(steps: &[Step]) -> Vec<Event> {
    let make = |(i, (rapid, x, y, feed)): (usize, &Step)| Event {
        kind: if *rapid { Kind::Traverse } else { Kind::Feed },
        end: [*x * ONE, *y * ONE, 0, 0, 0, 0],
        rate: if *rapid { 0 } else { i64::from(*feed) * ONE },
        state: State::default(),
        inch: false,
        span: Span::new(i as u32, i as u32),
    };
    steps.iter().enumerate().map(make).collect()
}

fn batch(steps: &[Step]) -> Batch {
    let plain = Exec::new(&World::generate(0, &ncc_ir::canon::Modes::default()), 0);
    let mut recorder = Recorder::new([[0; AXES]; 1 + WORLDS]);
    for event in events(steps) {
        let one = [event];
        recorder.record(&plain, [&one; 1 + WORLDS], false);
    }
    recorder.take()
}

fn measure() -> Measure {
    let resolution = Resolution { mm: 3, inch: 4, degree: 3, feed: 0, feed_inch: 1, second: 3, speed: 0 };
    Measure::of(&resolution, &resolution)
}

fn compared(a: &Batch, b: &Batch) -> Collector {
    let tape = |batch: &Batch| {
        let mut once = Some(batch.clone());
        Tape::new(Box::new(move || once.take()))
    };
    let mut found = Collector::default();
    compare(tape(a), tape(b), Rules { measure: measure(), shifts: false }, &mut found);
    found
}

/// Pairs of the longest common subsequence.
fn longest(a: &[Record], b: &[Record]) -> u64 {
    let measure = measure();
    let mut table = vec![vec![0u64; b.len() + 1]; a.len() + 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            table[i + 1][j + 1] = match measure.same(x, y, &Shift::default()) {
                true => table[i][j] + 1,
                false => table[i][j + 1].max(table[i + 1][j]),
            };
        }
    }
    table[a.len()][b.len()]
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    prop::collection::vec((any::<bool>(), 0..4i64, 0..4i64, 1..3u8), 0..60)
}

proptest! {
    #[test]
    fn as_many_pairs_as_by_the_book(a in steps(), b in steps()) {
        let (a, b) = (batch(&a), batch(&b));
        let found = compared(&a, &b);
        prop_assert_eq!(found.pairs, longest(&a.records, &b.records));
        let back = compared(&b, &a);
        prop_assert_eq!(back.pairs, found.pairs);
        prop_assert_eq!([back.unmatched[1], back.unmatched[0]], found.unmatched);
        prop_assert_eq!(found.equal(), back.equal());
    }

    #[test]
    fn a_stream_is_itself(a in steps()) {
        let a = batch(&a);
        let found = compared(&a, &a);
        prop_assert!(found.equal() && found.pairs == a.records.len() as u64);
    }

    /// An event that is put in, taken out or moved is reported as that and nothing else.
    #[test]
    fn one_edit_is_one_group(a in steps(), at in 0usize..60, kind in 0..3) {
        prop_assume!(!a.is_empty());
        let at = at % a.len();
        let mut b = a.clone();
        match kind {
            0 => b.insert(at, (true, 90, 91, 1)),
            1 => { b[at] = (b[at].0, 90, 91, b[at].3); }
            _ => { b.remove(at); }
        }
        let (first, second) = (batch(&a), batch(&b));
        let found = compared(&first, &second);
        let groups = found.groups.len();
        // Taking out a move may bring two of one place together, of which one then goes nowhere.
        prop_assert!(groups <= 2, "{:?}", found.groups);
        if kind < 2 {
            let same = longest(&first.records, &second.records);
            prop_assert_eq!(found.unmatched[0], first.records.len() as u64 - same);
            prop_assert!(groups >= 1);
        }
    }
}
