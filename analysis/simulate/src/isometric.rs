//! The isometric picture of a part, column by column, from front to back. A nearer cell hides a farther one.

use crate::map::HeightMap;
use crate::pixels::{Picture, colour, light, rise, shaded};

/// cos 30°: along the axes of an isometric picture.
const COS: f64 = 0.866_025_403_784_438_6;

/// The light on walls that look to less X, which are seen on the left, and on those that look to less Y.
const WALLS: [f64; 2] = [0.45, 0.6];

/// Draws a part above a level.
pub(crate) fn draw(map: &HeightMap, level: f32, most: usize, tool: &dyn Fn(u32) -> usize) -> Picture {
    let mut view = Isometric::of(map, level, most, tool);
    for column in 0..view.picture.width {
        // Without hollows a round wall is lit as one; with them it is a staircase.
        match map.hollows.is_empty() {
            true => view.surface_behind(column),
            false => view.material_behind(column),
        }
    }
    view.picture
}

/// The picture of a map: X goes to the right and up, Y to the left and up, Z up.
struct Isometric<'m> {
    map: &'m HeightMap,
    /// The part ends at this height below, mm.
    level: f32,
    /// The tool of a move, from 0.
    tool: &'m dyn Fn(u32) -> usize,
    /// Sides of the map, mm.
    sides: [f64; 2],
    /// Pixels a mm.
    scale: f64,
    picture: Picture,
}

/// A place of the map behind a column of pixels.
struct Place {
    column: usize,
    row: usize,
    /// How far up its ground is drawn, in the picture's mm.
    ground: f64,
}

impl<'m> Isometric<'m> {
    fn of(map: &'m HeightMap, level: f32, most: usize, tool: &'m dyn Fn(u32) -> usize) -> Isometric<'m> {
        let [long, deep] = map.grid.cells.map(|cells| cells as f64 * map.grid.cell);
        let thick = f64::from(map.highest().max(level)) - f64::from(level);
        let across = (long + deep) * COS;
        let up = (long + deep) * 0.5 + thick;
        let scale = most.max(1) as f64 / across.max(up).max(1e-9);
        let [width, height] = [across, up].map(|side| ((side * scale).ceil() as usize).max(1));
        let picture = Picture { width, height, pixels: vec![0; 4 * width * height] };
        Isometric { map, level, tool, sides: [long, deep], scale, picture }
    }

    /// Behind a column of pixels lies a line of the part along which X and Y grow by the same: X less Y on it.
    fn line(&self, column: usize) -> f64 {
        (column as f64 + 0.5) / self.scale / COS - self.sides[1]
    }

    /// The places on that line, from the front to the back, two a cell.
    fn places(&self, u: f64) -> impl Iterator<Item = Place> + use<> {
        let ([long, deep], cell, cells) = (self.sides, self.map.grid.cell, self.map.grid.cells);
        let (begin, end) = (u.max(0.0), long.min(u + deep));
        let steps = ((end - begin) / (0.5 * cell)).ceil().max(0.0) as usize;
        (0..=steps).map(move |step| {
            let x = (begin + (end - begin) * step as f64 / steps.max(1) as f64).min(long - 1e-9);
            let y = (x - u).clamp(0.0, deep - 1e-9);
            let [column, row] = [x, y].map(|at| (at / cell) as usize);
            Place { column: column.min(cells[0] - 1), row: row.min(cells[1] - 1), ground: (x + y) * 0.5 }
        })
    }

    /// The rows of pixels, from below, between two heights of the picture in mm.
    fn lines(&self, from: f64, to: f64) -> std::ops::Range<usize> {
        let [low, high] =
            [from, to].map(|at| ((at * self.scale).round().max(0.0) as usize).min(self.picture.height));
        low..high
    }

    fn put(&mut self, column: usize, line: usize, pixel: [u8; 4]) {
        let at = 4 * ((self.picture.height - 1 - line) * self.picture.width + column);
        self.picture.pixels[at..at + 4].copy_from_slice(&pixel);
    }

    /// Draws the upper surface behind a column of pixels.
    fn surface_behind(&mut self, column: usize) {
        let (map, level) = (self.map, self.level);
        let u = self.line(column);
        let mut drawn = 0.0_f64;
        for (step, Place { column: i, row: j, ground }) in self.places(u).enumerate() {
            let own = map.grid.index([i, j]);
            let stands = f64::from(map.heights[own].max(level)) - f64::from(level);
            let seen = ground + stands;
            // The first cell shows a wall of the part down to the level.
            let from = if step == 0 { ground } else { drawn };
            if stands > 0.0 && seen > from {
                let by = match step {
                    0 => WALLS[usize::from(u >= 0.0)],
                    _ => light(rise(map, level, i, j)),
                };
                let pixel = shaded(colour(map.last[own], self.tool), by);
                self.lines(from, seen).for_each(|line| self.put(column, line, pixel));
            }
            drawn = drawn.max(seen).max(from);
        }
    }

    /// Draws a column of pixels of a part with hollows: a piece of material hides only the pixels that it covers.
    fn material_behind(&mut self, column: usize) {
        let (map, level) = (self.map, self.level);
        let mut hidden = vec![false; self.picture.height];
        let (mut last, mut material) = (None, Vec::new());
        for Place { column: i, row: j, ground } in self.places(self.line(column)) {
            let own = map.grid.index([i, j]);
            let before = [(i > 0).then(|| own - 1), (j > 0).then(|| map.grid.index([i, j - 1]))];
            // By which sides the line comes into the cell.
            let sides = match last.replace([i, j]) {
                Some(last) if last == [i, j] => 0..0,
                Some([column, _]) if column == i => 1..2,
                Some([_, row]) if row == j => 0..1,
                Some(_) => 0..2,
                None => usize::from(i > 0)..2,
            };
            if !sides.is_empty() {
                material = map.material(own, level);
            }
            for (n, [low, high]) in material.iter().enumerate() {
                let [low, high] = [low, high].map(|at| ground + f64::from(at - level));
                for line in self.lines(low, high) {
                    if std::mem::replace(&mut hidden[line], true) {
                        continue;
                    }
                    let height = (f64::from(level) + (line as f64 + 0.5) / self.scale - ground) as f32;
                    // A cell shows a wall where the one before it is empty, else its top.
                    let is_open =
                        |side: &usize| before[*side].is_none_or(|cell| !is_solid(map, cell, height));
                    let wall = sides.clone().find(is_open);
                    let (number, by) = match wall {
                        // It is of the move that has emptied that one.
                        Some(side) => {
                            (before[side].map_or(0, |cell| emptied(map, cell, height)), WALLS[side])
                        }
                        None if n + 1 == material.len() => (map.last[own], light(rise(map, level, i, j))),
                        None => (map.hollows.last(own), light([0.0; 2])),
                    };
                    self.put(column, line, shaded(colour(number, self.tool), by));
                }
            }
        }
    }
}

/// The move that was the last to take the material of a cell at a height.
fn emptied(map: &HeightMap, cell: usize, height: f32) -> u32 {
    if height >= map.heights[cell] { map.last[cell] } else { map.hollows.last(cell) }
}

/// Whether a cell has material at a height.
fn is_solid(map: &HeightMap, cell: usize, height: f32) -> bool {
    let is_within = |[low, high]: &[f32; 2]| *low < height && height < *high;
    height < map.heights[cell] && !map.hollows.of(cell).iter().any(is_within)
}
