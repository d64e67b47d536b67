//! A program's moves on a part.

use crate::alarm::{Alarm, AlarmKind};
use crate::cut::{Cut, Hit, Removed, TOUCH, cut_between, probe_between};
use crate::cutting::{lower, probe};
use crate::history::{History, STRIDE};
use crate::leaning::{Leaning, Path};
use crate::map::HeightMap;
use crate::moves::{Axes, Move, Way};
use crate::slices::Convex;
use crate::stock::{Fixture, Stock};
use crate::sweep::chords;
use crate::tool::{Cutter, Tool};
use crate::under::through;

/// So much less radius has what is looked for in material, mm: a tool may go along the wall that it has cut itself, and places
/// are rounded.
const BESIDE: f64 = 0.002;

/// What is set up before the first move.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The raw part.
    pub stock: Stock,
    /// Whether the raw part is a guess.
    pub guessed: bool,
    /// Cells along its longer side.
    pub cells: usize,
    /// The tools.
    pub tools: Vec<Tool>,
    /// What holds the part.
    pub fixtures: Vec<Fixture>,
    /// Z of the table, mm; `None` where not known.
    pub table: Option<f64>,
    /// Where the tip is before the first move, X Y Z in mm.
    pub start: [f64; 3],
    /// The axes of tilted planes.
    pub tilts: Vec<Axes>,
}

/// What of a tool may not touch anything, above its cutter.
#[derive(Clone, Debug)]
struct Body {
    cutter: Cutter,
    shank: Option<Cutter>,
    holder: Option<Cutter>,
}

/// A part that is cut move by move.
#[derive(Clone, Debug)]
pub struct Simulation {
    setup: Setup,
    bodies: Vec<Body>,
    /// The same where the tool leans, if it ever does.
    leaning: Vec<Leaning>,
    /// No material of the raw part is lower.
    floor: f64,
    fixtures: Option<HeightMap>,
    map: HeightMap,
    /// No material is higher.
    highest: f32,
    moves: Vec<Move>,
    removed: Vec<Removed>,
    alarms: Vec<Alarm>,
    history: History,
    /// How many moves the map shows.
    shown: usize,
    /// The number of moves at which the history keeps the map next.
    next_stride: usize,
    /// Whether there are fixtures or a table.
    has_obstacles: bool,
}

impl Simulation {
    /// A part that nobody has cut.
    pub fn new(setup: Setup) -> Simulation {
        let map = setup.stock.map(setup.cells);
        let bodies = setup.tools.iter().map(|tool| Body {
            cutter: tool.cutter.thinner(BESIDE),
            shank: tool
                .shank
                .zip(tool.flute)
                .map(|(radius, base)| Cutter::cylinder(radius, base).thinner(BESIDE)),
            holder: tool.holder.map(|[radius, base]| Cutter::cylinder(radius, base).thinner(BESIDE)),
        });
        let leaning = setup.tools.iter().filter(|_| !setup.tilts.is_empty());
        Simulation {
            bodies: bodies.collect(),
            leaning: leaning.map(|tool| Leaning::of(tool, BESIDE)).collect(),
            floor: setup.stock.extent()[0][2],
            fixtures: Fixture::map(&setup.fixtures, map.grid.cell),
            highest: map.highest(),
            history: History::new(&map),
            moves: Vec::new(),
            removed: Vec::new(),
            alarms: Vec::new(),
            shown: 0,
            next_stride: STRIDE,
            has_obstacles: !setup.fixtures.is_empty() || setup.table.is_some(),
            setup,
            map,
        }
    }

    /// What was set up.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The part, after [`Simulation::shown`] moves.
    pub fn map(&self) -> &HeightMap {
        &self.map
    }

    /// How many moves the map shows.
    pub fn shown(&self) -> usize {
        self.shown
    }

    /// All moves.
    pub fn moves(&self) -> &[Move] {
        &self.moves
    }

    /// What each of them has removed.
    pub fn removed(&self) -> &[Removed] {
        &self.removed
    }

    /// What went wrong, in order.
    pub fn alarms(&self) -> &[Alarm] {
        &self.alarms
    }

    /// Bytes that it takes besides the map.
    pub fn bytes(&self) -> usize {
        self.history.bytes() + self.moves.len() * (size_of::<Move>() + size_of::<Removed>())
    }

    /// Where the tip is before a move, counted from 0.
    pub fn before(&self, at: usize) -> [f64; 3] {
        at.checked_sub(1).and_then(|at| self.moves.get(at)).map_or(self.setup.start, |last| last.end)
    }

    /// Makes the next move.
    ///
    /// # Panics
    /// Where its tool or its tilted plane is none of the set-up.
    pub fn push(&mut self, own: Move) {
        assert!(own.tool < self.setup.tools.len(), "a move with a tool that is not set up");
        assert!(usize::from(own.tilt) <= self.setup.tilts.len(), "a move on a plane that is not set up");
        let count = self.moves.len();
        self.seek(count);
        let (from, continues) = self.start(count, &own);
        let low = lowest(&from, &own);
        if own.way == Way::Rapid || self.has_obstacles {
            self.look(from, &own, low);
        }
        let mut cut = Cut::default();
        self.cut((&from, continues), &own, count, low, &mut cut);
        self.moves.push(own);
        self.removed.push(cut.removed(self.map.grid.cell));
        self.shown = count + 1;
        if !matches!(own.way, Way::Away) {
            self.judge(from, &own, &cut);
        }
        if self.shown == self.next_stride {
            self.next_stride += STRIDE;
            self.history.keep(&self.map);
        }
    }

    /// Shows the part after so many moves, or after all of them where there are fewer.
    #[inline]
    pub fn seek(&mut self, moves: usize) {
        let moves = moves.min(self.moves.len());
        if moves != self.shown {
            self.show(moves);
        }
    }

    #[cold]
    fn show(&mut self, moves: usize) {
        let stride = (moves / STRIDE).min(self.history.len());
        // What has been made of a stride is gone on with.
        if !(self.history.at() == Some(stride) && moves > self.shown) {
            self.history.show(&mut self.map, stride);
            self.shown = stride * STRIDE;
        }
        while self.shown < moves {
            let own = self.moves[self.shown];
            let (from, continues) = self.start(self.shown, &own);
            self.cut((&from, continues), &own, self.shown, lowest(&from, &own), &mut Cut::default());
            self.shown += 1;
        }
    }

    /// The place of the tip before a move, counted from 0, and whether the tool has cut all that it cuts there.
    #[inline(always)]
    fn start(&self, at: usize, own: &Move) -> ([f64; 3], bool) {
        match at.checked_sub(1).and_then(|at| self.moves.get(at)) {
            Some(last) => {
                let is_as_before = last.tool == own.tool && last.tilt == own.tilt;
                (last.end, is_as_before && last.way != Way::Away)
            }
            None => (self.setup.start, false),
        }
    }

    /// Cuts; `number` counts from 0, `low` is the least Z.
    #[inline(always)]
    fn cut(
        &mut self,
        (from, continues): (&[f64; 3], bool),
        own: &Move,
        number: usize,
        low: f64,
        cut: &mut Cut,
    ) {
        if own.tilt != 0 {
            *cut = self.cut_leaning(*from, own, number);
            return;
        }
        let tool = &self.setup.tools[own.tool];
        if low >= f64::from(self.highest) {
            return;
        }
        if tool.cutter.upper().is_some() {
            *cut = self.cut_under(*from, own, number);
            return;
        }
        let number = number as u32 + 1;
        lower(&mut self.map, number, &tool.cutter, [from, &own.end], &own.way, continues, cut);
        self.history.touch(&cut.columns, &cut.rows);
    }

    /// The same with a tool that cuts under what stays.
    #[cold]
    fn cut_under(&mut self, from: [f64; 3], own: &Move, number: usize) -> Cut {
        let (cutter, grid) = (&self.setup.tools[own.tool].cutter, self.map.grid);
        let cut = cut_between(&mut self.map, number as u32 + 1, |shown| {
            through(grid, cutter, from, own.end, &own.way, shown);
        });
        self.history.touch(&cut.columns, &cut.rows);
        cut
    }

    /// The same with a tool that leans.
    #[cold]
    fn cut_leaning(&mut self, from: [f64; 3], own: &Move, number: usize) -> Cut {
        let path = Path { from, own, axes: &self.setup.tilts[usize::from(own.tilt) - 1] };
        let (grid, between) = (self.map.grid, [self.floor, f64::from(self.highest)]);
        let parts = &self.leaning[own.tool].cutter;
        let cut = cut_between(&mut self.map, number as u32 + 1, |shown| {
            path.through(grid, parts, between, shown);
        });
        self.history.touch(&cut.columns, &cut.rows);
        cut
    }

    /// How deep parts of a tool that leans are in material.
    fn probe_leaning(&self, path: &Path, parts: &[Convex]) -> Option<Hit> {
        let between = [self.floor, f64::from(self.highest)];
        probe_between(&self.map, |shown| path.through(self.map.grid, parts, between, shown))
    }

    /// As [`Simulation::look`], of a tool that leans.
    #[cold]
    fn look_leaning(&mut self, from: [f64; 3], own: &Move) {
        let path = Path { from, own, axes: &self.setup.tilts[usize::from(own.tilt) - 1] };
        let tool = &self.leaning[own.tool];
        let parts = || [&tool.inside, &tool.above, &tool.shank, &tool.holder].into_iter().flatten();
        let mut found = Vec::new();
        if own.way == Way::Rapid {
            found.extend(self.probe_leaning(&path, &tool.inside).map(|hit| (AlarmKind::Rapid, hit)));
        }
        if let Some(fixtures) = &self.fixtures {
            let all: Vec<Convex> = parts().cloned().collect();
            let between = [f64::NEG_INFINITY, f64::from(fixtures.highest())];
            let hit = probe_between(fixtures, |shown| path.through(fixtures.grid, &all, between, shown));
            found.extend(hit.map(|hit| (AlarmKind::Fixture, hit)));
        }
        let low = path.lowest(parts());
        if let Some(table) = self.setup.table.filter(|table| low < *table - f64::from(TOUCH)) {
            let [x, y, _] = if own.end[2] <= from[2] { own.end } else { from };
            found.push((AlarmKind::Table, Hit { place: [x, y, low], depth: (table - low) as f32 }));
        }
        for (kind, hit) in found {
            self.alarm(kind, own, self.moves.len() as u32 + 1, hit);
        }
    }

    /// Obstacles that a move may meet before it cuts. `low` is the least Z of the move, mm.
    #[cold]
    fn look(&mut self, from: [f64; 3], own: &Move, low: f64) {
        if matches!(own.way, Way::Away) {
            return;
        }
        if own.tilt != 0 {
            return self.look_leaning(from, own);
        }
        let body = &self.bodies[own.tool];
        let mut found = Vec::new();
        if own.way == Way::Rapid && low < f64::from(self.highest) {
            let hit = match body.cutter.upper() {
                Some(_) => probe_between(&self.map, |shown| {
                    through(self.map.grid, &body.cutter, from, own.end, &own.way, shown);
                }),
                None => probe(&self.map, &body.cutter, from, own),
            };
            found.extend(hit.map(|hit| (AlarmKind::Rapid, hit)));
        }
        if let Some(fixtures) = &self.fixtures {
            let parts = [Some(&body.cutter), body.shank.as_ref(), body.holder.as_ref()];
            let hits = parts.into_iter().flatten().filter_map(|part| probe(fixtures, part, from, own));
            let worst = hits.max_by(|one, other| one.depth.total_cmp(&other.depth));
            found.extend(worst.map(|hit| (AlarmKind::Fixture, hit)));
        }
        if let Some(table) = self.setup.table.filter(|table| low < *table - f64::from(TOUCH)) {
            let place = if own.end[2] <= from[2] { own.end } else { from };
            found.push((AlarmKind::Table, Hit { place, depth: (table - low) as f32 }));
        }
        for (kind, hit) in found {
            self.alarm(kind, own, self.moves.len() as u32 + 1, hit);
        }
    }

    /// What is known of a move when it has cut.
    #[inline]
    fn judge(&mut self, from: [f64; 3], own: &Move, cut: &Cut) {
        let is_without_flute = self.setup.tools[own.tool].flute.is_none();
        if cut.depth > TOUCH && !(own.turns && is_without_flute) {
            self.judge_depth(own, cut);
        }
        let body = &self.bodies[own.tool];
        if own.tilt != 0 || body.shank.is_some() || body.holder.is_some() {
            for (kind, hit) in self.above_the_cut(from, own) {
                self.alarm(kind, own, self.moves.len() as u32, hit);
            }
        }
    }

    /// Whether a move may cut, and so deep.
    fn judge_depth(&mut self, own: &Move, cut: &Cut) {
        let number = self.moves.len() as u32;
        let depth = cut.depth;
        let is_on_neck = self.bodies[own.tool].cutter.upper().is_some();
        // What a tool on a neck takes is never longer than it is.
        let flute = self.setup.tools[own.tool].flute.filter(|_| !is_on_neck && own.tilt == 0);
        let over = flute.map_or(0.0, |flute| depth - flute as f32);
        let faults = [
            (AlarmKind::Stopped, if own.turns || own.way == Way::Rapid { 0.0 } else { depth }),
            (AlarmKind::Flute, over),
        ];
        for (kind, depth) in faults.into_iter().filter(|(_, depth)| *depth > TOUCH) {
            let place = self.where_cut(number, cut).unwrap_or(own.end);
            self.alarm(kind, own, number, Hit { place, depth });
        }
    }

    /// Where shank and holder are in what a move leaves; of a tool that leans, what is above its flutes, too.
    #[cold]
    fn above_the_cut(&self, from: [f64; 3], own: &Move) -> Vec<(AlarmKind, Hit)> {
        if own.tilt != 0 {
            let path = Path { from, own, axes: &self.setup.tilts[usize::from(own.tilt) - 1] };
            let parts = self.leaning[own.tool].above_the_cut().into_iter();
            return parts.filter_map(|(kind, part)| Some((kind, self.probe_leaning(&path, part)?))).collect();
        }
        let body = &self.bodies[own.tool];
        let parts = [(AlarmKind::Shank, &body.shank), (AlarmKind::Holder, &body.holder)];
        parts
            .into_iter()
            .filter_map(|(kind, part)| Some((kind, probe(&self.map, part.as_ref()?, from, own)?)))
            .collect()
    }

    /// A place that a move has cut.
    fn where_cut(&self, number: u32, cut: &Cut) -> Option<[f64; 3]> {
        let grid = self.map.grid;
        cut.rows.clone().find_map(|row| {
            let last = |cell: usize| [self.map.last[cell], self.map.hollows.last(cell)];
            let is_of = |column: &usize| last(grid.index([*column, row])).contains(&number);
            let column = cut.columns.clone().find(is_of)?;
            let cell = grid.index([column, row]);
            let under = self.map.hollows.of(cell).first().filter(|_| self.map.last[cell] != number);
            let height = f64::from(under.map_or(self.map.heights[cell], |own| own[0]));
            Some([grid.centre(0, column), grid.centre(1, row), height])
        })
    }

    /// Adds an alarm, to the last one where that goes on.
    fn alarm(&mut self, kind: AlarmKind, own: &Move, number: u32, hit: Hit) {
        let depth = f64::from(hit.depth);
        let before = self
            .alarms
            .iter_mut()
            .rev()
            .take(AlarmKind::ALL.len())
            .find(|alarm| alarm.kind == kind && alarm.tool == own.tool && alarm.last + 1 >= number);
        match before {
            Some(alarm) => {
                alarm.last = number;
                if depth > alarm.depth {
                    (alarm.depth, alarm.place) = (depth, hit.place);
                }
            }
            None => self.alarms.push(Alarm {
                kind,
                first: number,
                last: number,
                tool: own.tool,
                line: own.line,
                time: own.time,
                place: hit.place,
                depth,
                guessed: self.setup.guessed && !matches!(kind, AlarmKind::Fixture | AlarmKind::Table)
                    || self.setup.tools[own.tool].guessed,
            }),
        }
    }
}

/// The least Z of a move; endless where it cuts nothing.
#[inline]
fn lowest(from: &[f64; 3], own: &Move) -> f64 {
    let ends = if from[2] < own.end[2] { from[2] } else { own.end[2] };
    match own.way {
        Way::Away => f64::INFINITY,
        // An arc in another plane may go below both of its ends.
        Way::Arc { plane, centre, sweep } if plane[2] != 2 => {
            chords(*from, own.end, plane.map(usize::from), centre, sweep).map(|at| at[2]).fold(ends, f64::min)
        }
        Way::Rapid | Way::Feed | Way::Arc { .. } => ends,
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use fearless_simd::Level;

    use super::{Setup, Simulation};
    use crate::moves::{Move, Way};
    use crate::stock::Stock;
    use crate::surface::with_level;
    use crate::tool::{Cutter, Shape, Tool};

    /// The part that a tool of 4 mm diameter leaves, on cells of 0.2 mm: lines that climb and fall, and arcs.
    fn part(shape: &Shape) -> Simulation {
        let tool = Tool {
            number: 1,
            cutter: Cutter::new(shape, 4.0, 10.0).expect("a tool"),
            flute: None,
            shank: None,
            holder: None,
            guessed: false,
        };
        let mut part = Simulation::new(Setup {
            stock: Stock::Block { low: [0.0, 0.0, -10.0], high: [20.0, 20.0, 0.0] },
            guessed: false,
            cells: 100,
            tools: vec![tool],
            fixtures: Vec::new(),
            table: None,
            start: [2.0, 2.0, 1.0],
            tilts: Vec::new(),
        });
        let mut rng = fastrand::Rng::with_seed(1);
        for n in 0..300 {
            let end = [rng.f64() * 22.0 - 1.0, rng.f64() * 22.0 - 1.0, -8.0 * rng.f64()];
            let from = part.before(n);
            // Short moves, as of surfacing, and long ones.
            let near = if n % 3 == 0 { 1.0 } else { 0.05 };
            let mut end: [f64; 3] = std::array::from_fn(|axis| from[axis] + near * (end[axis] - from[axis]));
            let way = match n % 7 {
                0 => {
                    end = from;
                    Way::Arc { plane: [0, 1, 2], centre: [from[0] - 3.0, from[1]], sweep: 7.0 }
                }
                _ => Way::Feed,
            };
            part.push(Move { way, end, tool: 0, tilt: 0, turns: true, time: 0.0, line: 0 });
        }
        part
    }

    /// A program leaves the same part on every processor.
    #[test]
    fn all_instruction_sets_give_the_same_bits() {
        let best = Level::new();
        let levels: Vec<Level> = [
            best.as_sse2().map(Level::Sse2),
            best.as_sse4_2().map(Level::Sse4_2),
            best.as_avx2().map(Level::Avx2),
            Some(best),
        ]
        .into_iter()
        .flatten()
        .collect();
        let shapes = [
            Shape::Flat,
            Shape::Ball,
            Shape::BullNose { corner: 0.5 },
            Shape::Drill { point: 118.0 },
            Shape::Taper { corner: 0.5, angle: 10.0 },
        ];
        for shape in shapes {
            let all: Vec<Simulation> =
                levels.iter().map(|level| with_level(*level, || part(&shape))).collect();
            for pair in all.windows(2) {
                assert_eq!(pair[0].map(), pair[1].map(), "{shape:?}");
                assert_eq!(pair[0].removed(), pair[1].removed(), "{shape:?}");
            }
        }
    }
}
