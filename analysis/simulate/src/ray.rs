//! What a column of a picture shows of a part with hollows, from the front to the back: through its hollows, cells behind are seen.
//!
//! Not here: parts without hollows, of which only the upper surface is seen.

use crate::map::HeightMap;
use crate::shading::{AROUND, colour, light, of_tool, shaded};

/// Light in a hollow: so much of what falls on its floor outside, and that on its walls, from 0 to 1.
const HOLLOW: [f64; 2] = [0.75, 0.3];

/// A column of a picture, as far as it is drawn.
pub(crate) struct Ray<'m> {
    pub(crate) map: &'m HeightMap,
    /// Where the part ends below.
    pub(crate) level: f32,
    pub(crate) tool: &'m dyn Fn(u32) -> usize,
    /// Pixels a mm.
    pub(crate) scale: f64,
    /// Lines of the picture from one place to the next one behind it, at most.
    pub(crate) step: usize,
    /// Light on the side of the part, from 0 to 1.
    pub(crate) front: f64,
    /// Lines of the column that are drawn, from below.
    pub(crate) is_drawn: Vec<bool>,
    /// The cell in front.
    pub(crate) before: Option<usize>,
}

impl Ray<'_> {
    /// Draws what is seen of a cell whose floor is so high in the picture, mm, and whose upper surface rises by so much.
    pub(crate) fn meet(
        &mut self,
        [column, row]: [usize; 2],
        ground: f64,
        slope: [f64; 2],
        paint: &mut dyn FnMut(usize, [u8; 4]),
    ) {
        let (map, level, tool) = (self.map, self.level, self.tool);
        let own = row * map.grid.cells[0] + column;
        let before = self.before.replace(own);
        let side = if before.is_none() { self.front } else { HOLLOW[1] };
        let cells = [own, before.unwrap_or(own)];
        let material = map.material(own, level);
        for (n, [low, high]) in material.iter().enumerate() {
            let is_last = n + 1 == material.len();
            let [low_line, high_line] = [low, high].map(|z| {
                let at = (ground + f64::from(*z - level)) * self.scale;
                (at.round().max(0.0) as usize).min(self.is_drawn.len())
            });
            let Some(seen) = (low_line..high_line).rev().find(|line| !self.is_drawn[*line]) else { continue };
            // What is below something that is drawn is seen through a hollow; so is a wall over or behind one.
            let is_open = is_last && seen + 1 == high_line;
            let is_wall = cells.iter().any(|cell| !map.hollows.of(*cell).is_empty());
            let wall = shaded(inner(map, cells, tool), side);
            let top = match (before, is_open) {
                (None, _) => shaded(colour(map, own, tool), side),
                (Some(_), true) => shaded(colour(map, own, tool), light(slope)),
                // Its top is far above: a wall.
                (Some(_), false) if is_last && seen + 4 < high_line => wall,
                (Some(_), false) => {
                    let rise = floor_rise(map, level, [column, row], *high);
                    let by = rise.map_or(side, |rise| HOLLOW[0] * light(rise));
                    shaded(inner(map, cells, tool), by)
                }
            };
            let below = if before.is_some() && is_open && is_wall { wall } else { top };
            for line in low_line..high_line {
                if !std::mem::replace(&mut self.is_drawn[line], true) {
                    paint(line, if line + self.step >= high_line { top } else { below });
                }
            }
        }
    }
}

/// The colour of a wall or a floor of a hollow: that of the tool that came last to its cell or to the one in front of it.
fn inner(map: &HeightMap, cells: [usize; 2], tool: &dyn Fn(u32) -> usize) -> [u8; 3] {
    match cells.map(|cell| map.hollows.last(cell)) {
        [0, 0] => colour(map, cells[0], tool),
        [own, 0] => of_tool(tool(own)),
        [_, front] => of_tool(tool(front)),
    }
}

/// How steeply the floor of a hollow rises over a cell along both axes; `None` where it ends there.
fn floor_rise(map: &HeightMap, level: f32, [column, row]: [usize; 2], floor: f32) -> Option<[f64; 2]> {
    let [width, height] = map.grid.cells;
    // Farther up or down is another floor.
    let most = 6.0 * AROUND as f32 * map.grid.cell as f32;
    let near = |column: usize, row: usize| {
        let all = map.material(row * width + column, level).into_iter().map(|[_, high]| high);
        all.min_by(|a, b| (a - floor).abs().total_cmp(&(b - floor).abs()))
            .filter(|high| (high - floor).abs() < most)
    };
    let along = |at: usize, cells: usize| [at.saturating_sub(AROUND), (at + AROUND).min(cells - 1)];
    let [columns, rows] = [along(column, width), along(row, height)];
    let rise = |[low, high]: [Option<f32>; 2], [from, to]: [usize; 2]| {
        Some(f64::from(high? - low?) / ((to - from).max(1) as f64 * map.grid.cell))
    };
    let across = rise(columns.map(|column| near(column, row)), columns)?;
    Some([across, rise(rows.map(|row| near(column, row)), rows)?])
}
