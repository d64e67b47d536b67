//! What is not the same, typed: changes, gathered into groups while both streams go by.
//!
//! Pairs that only differ in what they are done with make one group for each such change and tool,
//! wherever they are. What has no partner stands in gaps; there, moves that are one move at another
//! place are paired. Groups keep places of both texts, so many at most that memory does not grow.

use std::collections::HashMap;

use ncc_exec::{Compensation, Coolant};
use ncc_ir::canon::{AXES, Spindle, SpindleMode};
use ncc_ir::expr::num::Nanos;

use crate::measure::{Measure, Shift, bits};
use crate::record::{Length, Record, Still, Style, What};
use crate::tape::Tape;

/// Groups that are kept; further ones are counted.
pub const MOST_GROUPS: usize = 20_000;
/// Blocks of each side that a group keeps.
pub const MOST_BLOCKS: usize = 8;
/// Gaps up to so many pairs are searched for the best partners.
const MOST_PARTNERS: usize = 250_000;
/// Moves of which one is the other at another place are not further apart than this, in nanos of a
/// millimetre, where both sides have not the same number of them.
const FAR: Nanos = 20_000_000_000;

/// What is not the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Change {
    /// Feed, mm/min in nanos.
    Feed(Nanos, Nanos),
    /// Speed of the spindle, in nanos of what it counts: rev/min, or m/min of a surface speed.
    Speed((Nanos, SpindleMode), (Nanos, SpindleMode)),
    /// Highest speed of the spindle, thousandths of a rev/min; `None` is no limit of the program.
    SpeedLimit(Option<u32>, Option<u32>),
    /// Sense of the spindle.
    Spindle(Spindle, Spindle),
    /// Tool.
    Tool(i64, i64),
    /// Coolant.
    Coolant(Coolant, Coolant),
    /// Cutter radius compensation.
    Compensation(Compensation, Compensation),
    /// Work offset active.
    WorkOffset(u16, u16),
    /// Tool length active.
    Length(Length, Length),
    /// The program's coordinates agree, those of the machine do not.
    Frame,
    /// The same move to another place: the second less the first.
    Moved([Nanos; AXES]),
    /// An arc to the same place about another centre, or the other way round.
    Arc,
    /// Another kind of move to the same place.
    Kind(What, What),
    /// The spindle stopped at another angle, degrees in nanos.
    Orient(Nanos, Nanos),
    /// A dwell of other length, seconds in nanos.
    Dwell(Nanos, Nanos),
    /// Another text for the operator, or another function of the machine.
    Text,
    /// What only one side has, or what both have instead of each other.
    Gap,
    /// Everything from here on is shifted: the second less the first.
    Shift([Nanos; AXES]),
}

/// Changes of one kind that belong together.
#[derive(Clone, Debug)]
pub struct Group {
    /// What they are.
    pub change: Change,
    /// The tool of the first side, or of the second if the first has nothing; -1 is that at the start.
    pub tool: i64,
    /// Number of pairs, or of records of both sides in a gap.
    pub count: [u64; 2],
    /// Moves among them.
    pub moves: [u64; 2],
    /// Holes among them.
    pub holes: [u64; 2],
    /// First blocks of both sides; of pairs, those that stand at the same index belong together.
    pub blocks: [Vec<u32>; 2],
    /// Whether there are further blocks.
    pub more_blocks: [bool; 2],
    /// Whether each index of blocks is a pair.
    pub paired: bool,
    /// Block-skip switches under which it shows; 0 is also without any.
    pub skip: u16,
    /// Whether it shows in a generated world alone.
    pub world: bool,
    /// Where the other side has nothing, the block before it.
    pub beside: [Option<u32>; 2],
    last_block: [Option<u32>; 2],
    last_hole: [u32; 2],
    /// Number of pairs and gaps before its last one, to tell whether a further one follows directly.
    end: u64,
}

/// Gathers changes.
#[derive(Debug, Default)]
pub struct Collector {
    /// Groups in the order of their first place.
    pub groups: Vec<Group>,
    /// Groups that were too many.
    pub left_out: u64,
    /// Pairs that are the same event at the same place.
    pub pairs: u64,
    /// Moves among them.
    pub moves: u64,
    /// Records that have no such partner.
    pub unmatched: [u64; 2],
    /// Whether streams were too long to be brought together where they had nothing in common.
    pub lost: bool,
    /// Whether moves that are off are in inches on one side and in millimetres on the other.
    pub units: bool,
    /// Block-skip switches of this run.
    pub skip: u16,
    by_change: HashMap<(Change, i64), usize>,
    /// Pairs and gaps so far.
    clock: u64,
    shift: Option<usize>,
    before: [Option<u32>; 2],
    /// Differences that an earlier run has told: places and what.
    reported: std::collections::HashSet<(Change, u32, u32)>,
}

type Tapes<'a, 't> = [&'a Tape<'t>; 2];

impl Collector {
    /// Begins another run, under other block-skip switches. Each difference is reported once over all runs.
    pub fn again(&mut self, skip: u16) {
        self.skip = skip;
        self.by_change.clear();
        self.shift = None;
        self.before = [None; 2];
        for group in &self.groups {
            let at = |side: usize| group.blocks[side].first().copied().unwrap_or(u32::MAX);
            self.reported.insert((group.change, at(0), at(1)));
        }
    }

    /// Whether nothing differs.
    pub fn equal(&self) -> bool {
        self.groups.is_empty() && self.left_out == 0
    }

    /// A pair that is the same event at the same place; `differs` are the respects in which it is not
    /// the same.
    #[inline]
    pub(crate) fn pair(&mut self, a: &Record, b: &Record, differs: u8, tapes: Tapes) {
        self.pairs += 1;
        self.clock += 1;
        self.moves += u64::from(a.what.moves());
        self.before = [Some(a.at), Some(b.at)];
        if let Some(shift) = self.shift
            && let Some(group) = self.groups.get_mut(shift)
        {
            group.count = [group.count[0] + 1, group.count[1] + 1];
            let moves = u64::from(a.what.moves());
            group.moves = [group.moves[0] + moves, group.moves[1] + moves];
        }
        if differs != 0 {
            self.attributes(a, b, differs, tapes);
        }
    }

    #[cold]
    fn attributes(&mut self, a: &Record, b: &Record, differs: u8, [first, second]: Tapes) {
        let (Some(s), Some(t)) = (first.styles.get(a.style as usize), second.styles.get(b.style as usize))
        else {
            return;
        };
        for bit in [
            bits::TOOL,
            bits::FRAME,
            bits::FEED,
            bits::SPEED,
            bits::LIMIT,
            bits::SPINDLE,
            bits::COOLANT,
            bits::COMPENSATION,
        ] {
            if differs & bit != 0 {
                let change = attribute(bit, s, t);
                // A tool that is another one says so itself.
                let tool = if bit == bits::TOOL { 0 } else { s.state.tool };
                self.attribute(change, tool, a, b);
            }
        }
    }

    fn attribute(&mut self, change: Change, tool: i64, a: &Record, b: &Record) {
        let clock = self.clock;
        let key = (change, tool);
        match self.by_change.get(&key).and_then(|at| self.groups.get_mut(*at)) {
            Some(group) => {
                // What goes on from the pair before is not told again.
                let follows = clock - group.end <= 1;
                group.add_pair(a, b, !follows);
                group.end = clock;
            }
            None => {
                if let Some(at) = self.group(change, tool, Some(a), Some(b)) {
                    self.by_change.insert(key, at);
                    self.groups[at].paired = true;
                    self.groups[at].add_pair(a, b, true);
                    self.groups[at].end = clock;
                }
            }
        }
    }

    /// A new group; `None` if there are too many, or if it was reported before.
    fn group(&mut self, change: Change, tool: i64, a: Option<&Record>, b: Option<&Record>) -> Option<usize> {
        let at = |record: Option<&Record>| record.map_or(u32::MAX, |record| record.at);
        if self.reported.contains(&(change, at(a), at(b))) {
            return None;
        }
        if self.groups.len() >= MOST_GROUPS {
            self.left_out += 1;
            return None;
        }
        self.groups.push(Group {
            change,
            tool,
            count: [0; 2],
            moves: [0; 2],
            holes: [0; 2],
            blocks: [Vec::new(), Vec::new()],
            more_blocks: [false; 2],
            paired: false,
            skip: self.skip,
            world: a.or(b).is_some_and(|record| record.world > 1),
            beside: self.before,
            last_block: [None; 2],
            last_hole: [0; 2],
            end: self.clock,
        });
        Some(self.groups.len() - 1)
    }

    /// A group for a step of a gap: holes that are off alike make one group, wherever they are.
    fn resumed(
        &mut self,
        change: Change,
        tool: i64,
        a: Option<&Record>,
        b: Option<&Record>,
    ) -> Option<usize> {
        let holes =
            matches!((change, a, b), (Change::Moved(_), Some(a), Some(b)) if a.hole != 0 && b.hole != 0);
        if !holes {
            return self.group(change, tool, a, b);
        }
        if let Some(at) = self.by_change.get(&(change, tool)) {
            return Some(*at);
        }
        let at = self.group(change, tool, a, b)?;
        self.by_change.insert((change, tool), at);
        Some(at)
    }

    /// From here on, the second stream is shifted otherwise.
    pub(crate) fn shifted(&mut self, shift: &Shift, heads: [Option<Record>; 2], _: Tapes) {
        self.shift = None;
        if !shift.on {
            return;
        }
        let [a, b] = &heads;
        if let Some(at) = self.group(Change::Shift(shift.by), 0, a.as_ref(), b.as_ref()) {
            if let (Some(a), Some(b)) = (a, b) {
                self.groups[at].paired = true;
                self.groups[at].block(0, a.at);
                self.groups[at].block(1, b.at);
            }
            self.shift = Some(at);
        }
    }

    /// What has no partner at its place.
    pub(crate) fn gap(&mut self, a: &[Record], b: &[Record], measure: &Measure, shift: &Shift, tapes: Tapes) {
        self.clock += 1;
        self.unmatched[0] += a.len() as u64;
        self.unmatched[1] += b.len() as u64;
        // The group that the step before went to, if this one can go there too.
        let mut open: Option<usize> = None;
        for step in partners(a, b, measure, shift, tapes) {
            let (first, second) = (step.0.map(|i| &a[i]), step.1.map(|j| &b[j]));
            let tool = first.map(|r| tool(r, tapes[0])).or(second.map(|r| tool(r, tapes[1]))).unwrap_or(-1);
            let change = match (first, second) {
                (Some(a), Some(b)) => between(a, b, measure, shift, tapes),
                (Some(_), None) | (None, Some(_)) | (None, None) => Change::Gap,
            };
            let fits = |group: &Group| group.change == change && group.tool == tool;
            let at = match open.filter(|at| self.groups.get(*at).is_some_and(fits)) {
                Some(at) => Some(at),
                None => self.resumed(change, tool, first, second),
            };
            if let Some(group) = at.and_then(|at| self.groups.get_mut(at)) {
                match (first, second) {
                    (Some(a), Some(b)) => {
                        group.paired = true;
                        group.add_pair(a, b, true);
                    }
                    (Some(a), None) => group.add(0, a),
                    (None, Some(b)) => group.add(1, b),
                    (None, None) => {}
                }
            }
            if at.is_some() {
                open = at;
            }
            if let (Some(a), Some(b)) = (first, second) {
                self.units |= a.what.moves() && a.inch() != b.inch();
                let style = |r: &Record, side: usize| tapes[side].styles.get(r.style as usize);
                if let (Some(s), Some(t)) = (style(a, 0), style(b, 1)) {
                    // Positions are reported already.
                    let differs = measure.styles(s, t, a.inch() || b.inch()) & !bits::FRAME;
                    if differs != 0 {
                        self.attributes(a, b, differs, tapes);
                    }
                }
            }
            self.before = [first.map(|r| r.at).or(self.before[0]), second.map(|r| r.at).or(self.before[1])];
        }
    }

    /// Both streams are over.
    pub(crate) fn end(&mut self, _: Tapes) {
        self.shift = None;
        self.by_change.clear();
    }
}

impl Group {
    fn block(&mut self, side: usize, at: u32) {
        if self.last_block[side] == Some(at) {
            return;
        }
        self.last_block[side] = Some(at);
        if self.blocks[side].len() < MOST_BLOCKS {
            self.blocks[side].push(at);
        } else {
            self.more_blocks[side] = true;
        }
    }

    fn add(&mut self, side: usize, record: &Record) {
        self.count[side] += 1;
        self.moves[side] += u64::from(record.what.moves());
        if record.hole != 0 && record.hole != self.last_hole[side] {
            self.last_hole[side] = record.hole;
            self.holes[side] += 1;
        }
        self.block(side, record.at);
    }

    /// A pair; its blocks are kept if it stands where something new begins.
    fn add_pair(&mut self, a: &Record, b: &Record, shown: bool) {
        for (side, record) in [a, b].into_iter().enumerate() {
            self.count[side] += 1;
            self.moves[side] += u64::from(record.what.moves());
            if record.hole != 0 && record.hole != self.last_hole[side] {
                self.last_hole[side] = record.hole;
                self.holes[side] += 1;
            }
        }
        if !shown || self.last_block == [Some(a.at), Some(b.at)] {
            return;
        }
        self.last_block = [Some(a.at), Some(b.at)];
        if self.blocks[0].len() < MOST_BLOCKS {
            self.blocks[0].push(a.at);
            self.blocks[1].push(b.at);
        } else {
            self.more_blocks = [true; 2];
        }
    }
}

fn tool(record: &Record, tape: &Tape) -> i64 {
    tape.styles.get(record.style as usize).map_or(-1, |style| style.state.tool)
}

/// What differs in one respect.
fn attribute(bit: u8, a: &Style, b: &Style) -> Change {
    let (s, t) = (&a.state, &b.state);
    match bit {
        bits::TOOL => Change::Tool(s.tool, t.tool),
        bits::FEED => Change::Feed(a.rate, b.rate),
        bits::SPEED => Change::Speed((s.speed, s.spindle_mode), (t.speed, t.spindle_mode)),
        bits::LIMIT => {
            let limit = |state: &Still| (state.limit != u32::MAX).then_some(state.limit);
            Change::SpeedLimit(limit(s), limit(t))
        }
        bits::SPINDLE => Change::Spindle(s.spindle, t.spindle),
        bits::COOLANT => Change::Coolant(s.coolant(), t.coolant()),
        bits::COMPENSATION => Change::Compensation(s.compensation, t.compensation),
        _ if a.offset != b.offset => Change::WorkOffset(a.offset, b.offset),
        _ if a.length != b.length => Change::Length(a.length, b.length),
        _ => Change::Frame,
    }
}

/// What is between two records that belong together.
fn between(a: &Record, b: &Record, measure: &Measure, shift: &Shift, [first, second]: Tapes) -> Change {
    let (p, q) = (first.place(a), second.place(b));
    let by: [Nanos; AXES] = std::array::from_fn(|axis| {
        let off = q[axis].wrapping_sub(p[axis]).wrapping_sub(shift.by[axis]);
        let most = if axis < 3 { measure.length(a, b) } else { measure.degrees };
        if off.abs() <= most { 0 } else { off }
    });
    match (a.what, b.what) {
        (What::Orient, What::Orient) => Change::Orient(a.more[0], b.more[0]),
        (What::Dwell, What::Dwell) => Change::Dwell(a.more[0], b.more[0]),
        (x, y) if x != y => Change::Kind(x, y),
        (x, _) if !x.moves() => Change::Text,
        _ if by == [0; AXES] => Change::Arc,
        _ => Change::Moved(by),
    }
}

type Step = (Option<usize>, Option<usize>);

/// Which records of a gap belong together, in order.
fn partners(a: &[Record], b: &[Record], measure: &Measure, shift: &Shift, tapes: Tapes) -> Vec<Step> {
    let alone = || {
        let first = (0..a.len()).map(|i| (Some(i), None));
        first.chain((0..b.len()).map(|j| (None, Some(j)))).collect::<Vec<Step>>()
    };
    if a.is_empty() || b.is_empty() {
        return alone();
    }
    if a.len() == b.len()
        && a.len() <= 512
        && a.iter().zip(b).all(|(a, b)| a.what == b.what && a.world == b.world)
    {
        return (0..a.len()).map(|i| (Some(i), Some(i))).collect();
    }
    if a.len() * b.len() > MOST_PARTNERS {
        // Long stretches of the same kinds may be one, as a whole at another place.
        let alike = a.len() == b.len() && {
            let by = |i: usize| between(&a[i], &b[i], measure, shift, tapes);
            let first = by(0);
            a.iter().zip(b).all(|(a, b)| a.what == b.what) && (0..a.len()).all(|i| by(i) == first)
        };
        return if alike { (0..a.len()).map(|i| (Some(i), Some(i))).collect() } else { alone() };
    }
    // The cheapest way to turn one into the other; a record alone costs a thousand.
    const ALONE: u32 = 1000;
    let cost = |a: &Record, b: &Record| -> Option<u32> {
        if a.world != b.world {
            return None;
        }
        match (a.what, b.what) {
            (x, y) if x.moves() && y.moves() => {
                let off = (0..3).map(|i| b.end[i].wrapping_sub(a.end[i]).wrapping_sub(shift.by[i]));
                let far = off.fold(0u64, |far, off| far.max(off.unsigned_abs()));
                let near = far <= measure.length(a, b) as u64;
                match (x == y, near) {
                    (true, true) => Some(200),
                    (false, true) => Some(500),
                    (true, false) if far <= FAR as u64 => Some(300 + (far * 1600 / FAR as u64) as u32),
                    (true | false, false) => None,
                }
            }
            (x, y) => (x == y).then_some(300),
        }
    };
    let (n, m) = (a.len(), b.len());
    let mut table = vec![0u32; (n + 1) * (m + 1)];
    let at = |i: usize, j: usize| i * (m + 1) + j;
    for i in (0..=n).rev() {
        for j in (0..=m).rev() {
            let mut best = u32::MAX;
            if i < n {
                best = best.min(table[at(i + 1, j)] + ALONE);
            }
            if j < m {
                best = best.min(table[at(i, j + 1)] + ALONE);
            }
            if i < n
                && j < m
                && let Some(cost) = cost(&a[i], &b[j])
            {
                best = best.min(table[at(i + 1, j + 1)] + cost);
            }
            table[at(i, j)] = if i == n && j == m { 0 } else { best };
        }
    }
    let (mut i, mut j) = (0, 0);
    let mut steps = Vec::with_capacity(n.max(m));
    while i < n || j < m {
        let here = table[at(i, j)];
        let pair = (i < n && j < m).then(|| cost(&a[i], &b[j])).flatten();
        if pair.is_some_and(|cost| table[at(i + 1, j + 1)] + cost == here) {
            steps.push((Some(i), Some(j)));
            i += 1;
            j += 1;
        } else if i < n && table[at(i + 1, j)] + ALONE == here {
            steps.push((Some(i), None));
            i += 1;
        } else {
            steps.push((None, Some(j)));
            j += 1;
        }
    }
    steps
}
