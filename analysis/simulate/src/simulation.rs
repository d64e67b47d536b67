//! A program's moves on a part.

use std::ops::Range;

use wide::{CmpGt, CmpLt, f32x4};

use crate::alarm::{Alarm, AlarmKind};
use crate::cut::{Cut, Hit, Removed, TOUCH, cut_between, probe_between, take};
use crate::history::{History, STRIDE};
use crate::leaning::{Leaning, Path};
use crate::map::{Grid, HeightMap};
use crate::moves::{Axes, Move, Way};
use crate::slices::Convex;
use crate::stock::{Fixture, Stock};
use crate::surface::{COUNT, Cells, LANES, Surface};
use crate::sweep::{chords, sweep};
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
        self.seek(self.moves.len());
        let from = self.before(self.moves.len());
        if own.way != Way::Away {
            self.look(from, &own);
        }
        let removed = self.cut(from, &own, self.moves.len());
        self.moves.push(own);
        self.removed.push(removed.removed);
        self.shown = self.moves.len();
        if own.way != Way::Away {
            self.judge(&own, &removed);
        }
        if self.moves.len().is_multiple_of(STRIDE) {
            self.history.keep(&self.map);
        }
    }

    /// Shows the part after so many moves, or after all of them where there are fewer.
    pub fn seek(&mut self, moves: usize) {
        let moves = moves.min(self.moves.len());
        if moves == self.shown {
            return;
        }
        let stride = (moves / STRIDE).min(self.history.len());
        // What has been made of a stride is gone on with.
        if !(stride == self.history.at() && moves > self.shown) {
            self.history.show(&mut self.map, stride);
            self.shown = stride * STRIDE;
        }
        while self.shown < moves {
            let (from, own) = (self.before(self.shown), self.moves[self.shown]);
            self.cut(from, &own, self.shown);
            self.shown += 1;
        }
    }

    /// Cuts; `number` counts from 0.
    fn cut(&mut self, from: [f64; 3], own: &Move, number: usize) -> Cut {
        if own.tilt != 0 {
            return self.cut_leaning(from, own, number);
        }
        let tool = &self.setup.tools[own.tool];
        if lowest(from, own) >= f64::from(self.highest) {
            return Cut::default();
        }
        if tool.cutter.upper().is_some() {
            let (grid, to) = (self.map.grid, own.end);
            let cut = cut_between(&mut self.map, number as u32 + 1, |shown| {
                through(grid, &tool.cutter, from, to, &own.way, shown);
            });
            self.history.touch(&cut.columns, &cut.rows);
            return cut;
        }
        let before = number.checked_sub(1).map(|before| &self.moves[before]);
        let continues = before.is_some_and(|before| before.tool == own.tool && before.way != Way::Away);
        let mut cutting = Cutting {
            map: &mut self.map,
            number: number as u32 + 1,
            cut: Cut::default(),
            cells: 0.0,
            sums: Sums::default(),
        };
        sweep(&mut cutting, &tool.cutter, [from, own.end], &own.way, continues);
        cutting.add_up();
        let Cutting { mut cut, cells, .. } = cutting;
        cut.removed.volume = (cells * self.map.grid.cell * self.map.grid.cell) as f32;
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

    /// What must be asked before a move cuts: what is in its way.
    fn look(&mut self, from: [f64; 3], own: &Move) {
        if own.tilt != 0 {
            return self.look_leaning(from, own);
        }
        let body = &self.bodies[own.tool];
        let low = lowest(from, own);
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
    fn judge(&mut self, own: &Move, cut: &Cut) {
        let number = self.moves.len() as u32;
        let from = self.before(self.moves.len() - 1);
        let depth = cut.removed.depth;
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
        let body = &self.bodies[own.tool];
        if own.tilt == 0 && body.shank.is_none() && body.holder.is_none() {
            return;
        }
        for (kind, hit) in self.above_the_cut(from, own) {
            self.alarm(kind, own, number, hit);
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
        let (grid, width) = (self.map.grid, self.map.grid.cells[0]);
        cut.rows.clone().find_map(|row| {
            let last = |cell: usize| [self.map.last[cell], self.map.hollows.last(cell)];
            let column = cut.columns.clone().find(|column| last(row * width + column).contains(&number))?;
            let cell = row * width + column;
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

/// The least Z of a move.
fn lowest(from: [f64; 3], own: &Move) -> f64 {
    let ends = from[2].min(own.end[2]);
    match own.way {
        // An arc in another plane may go below both of its ends.
        Way::Arc { plane, centre, sweep } if plane[2] != 2 => {
            chords(from, own.end, plane.map(usize::from), centre, sweep).map(|at| at[2]).fold(ends, f64::min)
        }
        Way::Away => f64::INFINITY,
        Way::Rapid | Way::Feed | Way::Arc { .. } => ends,
    }
}

/// Lowers a map.
struct Cutting<'m> {
    map: &'m mut HeightMap,
    number: u32,
    cut: Cut,
    /// What was removed, in heights of cells.
    cells: f64,
    sums: Sums,
}

impl Cutting<'_> {
    /// As [`Cells::row`], cell by cell.
    #[cold]
    fn row_with_hollows(&mut self, row: usize, columns: Range<usize>, surface: impl Surface) {
        let start = row * self.map.grid.cells[0];
        for first in columns.clone().step_by(LANES) {
            let new = surface.at(f32x4::splat((first - columns.start) as f32) + COUNT).to_array();
            for (column, new) in (first..columns.end).zip(new) {
                let taken = take(self.map, start + column, [new, f32::INFINITY], self.number);
                self.cells += f64::from(taken);
                self.cut.removed.depth = self.cut.removed.depth.max(taken);
            }
        }
    }

    /// As [`Cells::row`], of the last cells of the map, which are too few for a whole group.
    #[cold]
    fn last_row(&mut self, begin: usize, count: usize, surface: impl Surface) {
        let (heights, last) =
            (&mut self.map.heights[begin..begin + count], &mut self.map.last[begin..begin + count]);
        for (n, (heights, last)) in heights.chunks_mut(LANES).zip(last.chunks_mut(LANES)).enumerate() {
            let (mut few, mut of) = ([HeightMap::NOTHING; LANES], [0; LANES]);
            few[..heights.len()].copy_from_slice(heights);
            of[..last.len()].copy_from_slice(last);
            let new = surface.at(COUNT + f32x4::splat((n * LANES) as f32));
            self.sums.lower(&mut few, &mut of, new.to_array(), self.number);
            heights.copy_from_slice(&few[..heights.len()]);
            last.copy_from_slice(&of[..last.len()]);
        }
    }

    /// Adds what was removed since the last time: single precision is fine enough for so much.
    fn add_up(&mut self) {
        let Sums { volumes, depths } = std::mem::take(&mut self.sums);
        self.cells += f64::from(volumes.into_iter().sum::<f32>());
        self.cut.removed.depth = depths.into_iter().fold(self.cut.removed.depth, f32::max);
    }
}

/// What was removed in some cells, in as many sums.
#[derive(Clone, Copy, Default)]
struct Sums {
    volumes: [f32; LANES],
    depths: [f32; LANES],
}

impl Sums {
    /// Lowers cells to a surface, where that is lower. Without a branch, which the next cells could not be waited for.
    #[inline(always)]
    fn lower(&mut self, heights: &mut [f32; LANES], last: &mut [u32; LANES], new: [f32; LANES], number: u32) {
        for lane in 0..LANES {
            let old = heights[lane];
            let mask = if new[lane] < old { u32::MAX } else { 0 };
            // Nothing less nothing is no number; it is masked out.
            let depth = f32::from_bits((old - new[lane]).to_bits() & mask);
            heights[lane] = if new[lane] < old { new[lane] } else { old };
            last[lane] = last[lane] & !mask | number & mask;
            self.volumes[lane] += depth;
            self.depths[lane] = if depth > self.depths[lane] { depth } else { self.depths[lane] };
        }
    }
}

impl Cells for Cutting<'_> {
    #[inline]
    fn grid(&self) -> Grid {
        self.map.grid
    }

    fn reaches(&mut self, rows: &Range<usize>, columns: &Range<usize>) {
        self.cut.reaches(rows, columns);
        self.add_up();
    }

    #[inline(always)]
    fn row(&mut self, row: usize, columns: Range<usize>, surface: impl Surface) {
        if !self.map.hollows.is_empty() {
            self.row_with_hollows(row, columns, surface);
            return;
        }
        let begin = row * self.map.grid.cells[0] + columns.start;
        let whole = begin..begin + columns.len().next_multiple_of(LANES);
        let Some(heights) = self.map.heights.get_mut(whole.clone()) else {
            self.last_row(begin, columns.len(), surface);
            return;
        };
        let last = &mut self.map.last[whole];
        let mut sums = self.sums;
        let least = f32x4::splat(surface.least(columns.len()));
        let (count, mut at) = (f32x4::splat(columns.len() as i32 as f32), COUNT);
        for (heights, last) in heights.as_chunks_mut().0.iter_mut().zip(last.as_chunks_mut().0) {
            let old = f32x4::new(*heights);
            // Most of what a tool goes over is cut already: the surface is looked at where it may be lower, and cells are
            // written where it is. Cells behind the last one are those of the next row, and stay.
            if old.cmp_gt(least).any() {
                let new = at.cmp_lt(count).blend(surface.at(at), f32x4::splat(f32::INFINITY));
                if new.cmp_lt(old).any() {
                    sums.lower(heights, last, new.to_array(), self.number);
                }
            }
            at += f32x4::splat(LANES as f32);
        }
        self.sums = sums;
    }
}

/// How deep a part of a tool goes into a map along a move, where it does.
fn probe(map: &HeightMap, part: &Cutter, from: [f64; 3], own: &Move) -> Option<Hit> {
    let mut probing = Probing { map, worst: None };
    sweep(&mut probing, part, [from, own.end], &own.way, false);
    probing.worst
}

/// Looks at a map.
struct Probing<'m> {
    map: &'m HeightMap,
    worst: Option<Hit>,
}

impl Cells for Probing<'_> {
    fn grid(&self) -> Grid {
        self.map.grid
    }

    fn reaches(&mut self, _rows: &Range<usize>, _columns: &Range<usize>) {}

    fn row(&mut self, row: usize, columns: Range<usize>, surface: impl Surface) {
        let (grid, start) = (self.map.grid, row * self.map.grid.cells[0]);
        for first in columns.clone().step_by(LANES) {
            let tools = surface.at(f32x4::splat((first - columns.start) as f32) + COUNT).to_array();
            for (column, tool) in (first..columns.end).zip(tools) {
                let depth = self.map.heights[start + column] - tool;
                if depth > self.worst.map_or(TOUCH, |worst| worst.depth) {
                    let place = [grid.centre(0, column), grid.centre(1, row), f64::from(tool)];
                    self.worst = Some(Hit { place, depth });
                }
            }
        }
    }
}
