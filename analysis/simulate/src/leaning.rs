//! Moves of a tool that leans: the cells that it goes through, and between which heights.
//!
//! Each convex part of a tool leaves a convex body on a straight way, so that it takes one piece of each cell
//! ([`slices`](crate::slices)). Arcs are cut into chords.

use crate::alarm::AlarmKind;
use crate::map::Grid;
use crate::moves::{Axes, Move, Way, turned, turned_back};
use crate::slices::{Convex, ENDLESS, Leg};
use crate::sweep::chords;
use crate::tool::{Cutter, Tool};

/// Directions in which the shadow of a leg is bounded, besides those across its way and its axis.
const AROUND: usize = 16;

/// The parts of a tool, for when it leans.
#[derive(Clone, Debug)]
pub(crate) struct Leaning {
    /// The cutting part.
    pub(crate) cutter: Vec<Convex>,
    /// The same, a little smaller on all sides.
    pub(crate) inside: Vec<Convex>,
    /// The part above the flutes, as wide as they are.
    pub(crate) above: Vec<Convex>,
    /// Above the flutes.
    pub(crate) shank: Vec<Convex>,
    /// The holder.
    pub(crate) holder: Vec<Convex>,
}

impl Leaning {
    /// Of a tool; `beside` is the clearance of the parts that are checked for collisions, mm.
    pub(crate) fn of(tool: &Tool, beside: f64) -> Leaning {
        let is_on_neck = tool.cutter.upper().is_some();
        let flute = tool.flute.filter(|_| !is_on_neck);
        let bar = |radius: f64, base: f64| {
            Convex::of(&Cutter::cylinder(radius, base).thinner(beside), ENDLESS, beside)
        };
        let base = tool.flute;
        Leaning {
            cutter: Convex::of(&tool.cutter, flute.unwrap_or(ENDLESS), 0.0),
            inside: Convex::of(&tool.cutter.thinner(beside), flute.unwrap_or(ENDLESS), beside),
            above: flute.map(|flute| bar(tool.cutter.radius(), flute)).unwrap_or_default(),
            shank: tool.shank.zip(base).map(|(radius, base)| bar(radius, base)).unwrap_or_default(),
            holder: tool.holder.map(|[radius, base]| bar(radius, base)).unwrap_or_default(),
        }
    }

    /// The parts that are looked for in material, with what it means that they are there.
    pub(crate) fn above_the_cut(&self) -> [(AlarmKind, &[Convex]); 3] {
        [(AlarmKind::Flute, &self.above), (AlarmKind::Shank, &self.shank), (AlarmKind::Holder, &self.holder)]
    }
}

/// A move of a tool that leans.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path<'m> {
    pub(crate) from: [f64; 3],
    pub(crate) own: &'m Move,
    /// The axes of its plane.
    pub(crate) axes: &'m Axes,
}

impl Path<'_> {
    /// Its straight pieces.
    fn legs(&self, shown: &mut dyn FnMut(Leg)) {
        let axis = self.axes.map(|row| row[2]);
        let (from, to) = (self.from, self.own.end);
        match self.own.way {
            Way::Away => {}
            Way::Rapid | Way::Feed => shown(Leg::new([from, to], axis)),
            Way::Arc { plane, centre, sweep } => {
                let ends = [from, to].map(|at| turned_back(self.axes, at));
                let mut last = from;
                for at in chords(ends[0], ends[1], plane.map(usize::from), centre, sweep) {
                    let at = turned(self.axes, at);
                    shown(Leg::new([last, at], axis));
                    last = at;
                }
            }
        }
    }

    /// The least height of some parts of the tool.
    pub(crate) fn lowest<'p>(&self, parts: impl Iterator<Item = &'p Convex> + Clone) -> f64 {
        let mut low = f64::INFINITY;
        self.legs(&mut |leg| {
            let down = |part: &Convex| -leg.reach(part, [0.0, 0.0, -1.0]);
            low = parts.clone().map(down).fold(low, f64::min);
        });
        low
    }

    /// Shows the cells that some parts of the tool go through between two heights.
    pub(crate) fn through(
        &self,
        grid: Grid,
        parts: &[Convex],
        between: [f64; 2],
        shown: &mut dyn FnMut(usize, [f32; 2]),
    ) {
        self.legs(&mut |leg| parts.iter().for_each(|part| one(grid, &leg, part, between, shown)));
    }
}

fn one(grid: Grid, leg: &Leg, part: &Convex, [floor, top]: [f64; 2], shown: &mut dyn FnMut(usize, [f32; 2])) {
    // The part of the tool that stays beyond both heights of the map cannot cut.
    let part = &part.up_to(leg.leaves(part, [floor, top]));
    if part.is_empty()
        || -leg.reach(part, [0.0, 0.0, -1.0]) >= top
        || leg.reach(part, [0.0, 0.0, 1.0]) <= floor
    {
        return;
    }
    let sides: Vec<_> = leg.sides(AROUND).map(|[x, y]| ([x, y], leg.reach(part, [x, y, 0.0]))).collect();
    let rows = grid.between(1, -leg.reach(part, [0.0, -1.0, 0.0]), leg.reach(part, [0.0, 1.0, 0.0]));
    for row in rows {
        let y = grid.centre(1, row);
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for ([side_x, side_y], reach) in &sides {
            let at = (reach - side_y * y) / side_x;
            if *side_x > 1e-6 {
                high = high.min(at);
            } else if *side_x < -1e-6 {
                low = low.max(at);
            }
        }
        for column in grid.between(0, low, high) {
            if let Some([low, high]) = leg.through(part, [grid.centre(0, column), y])
                && low < top
                && high > floor
            {
                shown(grid.index([column, row]), [low.max(floor) as f32, high as f32]);
            }
        }
    }
}
