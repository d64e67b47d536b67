//! A part as a picture: seen from above or from a corner, lit from the upper left, each tool in a colour of its own.

use crate::map::HeightMap;
use crate::ray::Ray;
use crate::shading::{AROUND, colour, light, shaded};

/// From where a part is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// From above.
    Plan,
    /// From the front, the right and above: isometric.
    Corner,
}

/// A picture: rows from the top, each of red, green, blue and opacity.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels along a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Four bytes for each pixel.
    pub pixels: Vec<u8>,
}

/// Draws a part above a level, `most` pixels along the longer side. `tool` says which tool made a move, counted from 0.
pub fn draw(map: &HeightMap, level: f32, look: Look, most: usize, tool: &dyn Fn(u32) -> usize) -> Picture {
    match look {
        Look::Plan => plan(map, level, most, tool),
        Look::Corner => corner(map, level, most, tool),
    }
}

/// How steeply the surface rises over a cell along both axes. What is below the level counts as the level.
fn rise(map: &HeightMap, level: f32, column: usize, row: usize) -> [f64; 2] {
    let [width, height] = map.grid.cells;
    let near = |at: usize, cells: usize| at.saturating_sub(AROUND)..(at + AROUND + 1).min(cells);
    let (columns, rows) = (near(column, width), near(row, height));
    // The slope of the plane that fits best.
    let (mut weights, mut sums) = ([0.0; 2], [0.0; 2]);
    let middle = |range: &std::ops::Range<usize>| (range.start + range.end - 1) as f64 / 2.0;
    let [cx, cy] = [middle(&columns), middle(&rows)];
    for j in rows {
        for i in columns.clone() {
            let z = f64::from(map.heights[j * width + i].max(level));
            let off = [i as f64 - cx, j as f64 - cy];
            for axis in 0..2 {
                weights[axis] += off[axis] * off[axis];
                sums[axis] += off[axis] * z;
            }
        }
    }
    [0, 1].map(|axis| if weights[axis] > 0.0 { sums[axis] / (weights[axis] * map.grid.cell) } else { 0.0 })
}

fn plan(map: &HeightMap, level: f32, most: usize, tool: &dyn Fn(u32) -> usize) -> Picture {
    let [columns, rows] = map.grid.cells;
    let scale = most.max(1) as f64 / columns.max(rows) as f64;
    let [width, height] = [columns, rows].map(|cells| ((cells as f64 * scale).round() as usize).max(1));
    let mut pixels = Vec::with_capacity(4 * width * height);
    for y in (0..height).rev() {
        let row = (y * rows / height).min(rows - 1);
        for x in 0..width {
            let column = (x * columns / width).min(columns - 1);
            let cell = row * columns + column;
            let pixel = match map.heights[cell] > level {
                true => shaded(colour(map, cell, tool), light(rise(map, level, column, row))),
                false => [0; 4],
            };
            pixels.extend(pixel);
        }
    }
    Picture { width, height, pixels }
}

/// cos 30°: along the axes of an isometric picture.
const COS: f64 = 0.866_025_403_784_438_6;

/// Draws the isometric picture, one column of pixels after the other, from the front to the back. A nearer cell hides those
/// behind it; through its hollows they are seen.
fn corner(map: &HeightMap, level: f32, most: usize, tool: &dyn Fn(u32) -> usize) -> Picture {
    let [columns, rows] = map.grid.cells;
    let cell = map.grid.cell;
    let [long, deep] = [columns as f64 * cell, rows as f64 * cell];
    let top = f64::from(map.highest().max(level));
    let thick = top - f64::from(level);
    // X goes to the right and up, Y to the left and up, Z up.
    let across = (long + deep) * COS;
    let up = (long + deep) * 0.5 + thick;
    let scale = most.max(1) as f64 / across.max(up).max(1e-9);
    let [width, height] = [across, up].map(|side| ((side * scale).ceil() as usize).max(1));
    let mut pixels = vec![0_u8; 4 * width * height];
    for column in 0..width {
        // Behind this column of pixels lies a line of the part along which X and Y grow by the same.
        let u = (column as f64 + 0.5) / scale / COS - deep;
        // u = x - y
        let begin = u.max(0.0);
        let end = long.min(u + deep);
        let mut drawn = 0.0_f64;
        let steps = ((end - begin) / (0.5 * cell)).ceil().max(0.0) as usize;
        let mut first = true;
        // On the left is the front, on the right the right side.
        let front = if u < 0.0 { 0.45 } else { 0.6 };
        let step = ((end - begin) / steps.max(1) as f64 * scale).ceil() as usize + 1;
        let mut ray = (!map.hollows.is_empty()).then(|| Ray {
            map,
            level,
            tool,
            scale,
            step,
            front,
            is_drawn: vec![false; height],
            before: None,
        });
        for at in 0..=steps {
            let x = (begin + (end - begin) * at as f64 / steps.max(1) as f64).min(long - 1e-9);
            let y = (x - u).clamp(0.0, deep - 1e-9);
            let [i, j] = [((x / cell) as usize).min(columns - 1), ((y / cell) as usize).min(rows - 1)];
            let own = j * columns + i;
            let stands = f64::from(map.heights[own].max(level)) - f64::from(level);
            let ground = (x + y) * 0.5;
            let seen = (ground + stands) * scale;
            let slope = rise(map, level, i, j);
            if let Some(ray) = &mut ray {
                ray.meet([i, j], ground, slope, &mut |line, pixel| {
                    let at = 4 * ((height - 1 - line) * width + column);
                    pixels[at..at + 4].copy_from_slice(&pixel);
                });
                continue;
            }
            // The first cell shows a wall of the part down to the level.
            let wall = first || seen - drawn > 3.0 && slope[0] + slope[1] > 2.0;
            let from = if first { ground * scale } else { drawn };
            first = false;
            if stands > 0.0 && seen > from {
                let by = if wall && at == 0 { front } else { light(slope) };
                let pixel = shaded(colour(map, own, tool), by);
                let [low, high] = [from, seen].map(|at| (at.round().max(0.0) as usize).min(height));
                for line in low..high {
                    let at = 4 * ((height - 1 - line) * width + column);
                    pixels[at..at + 4].copy_from_slice(&pixel);
                }
            }
            drawn = drawn.max(seen).max(from);
        }
    }
    Picture { width, height, pixels }
}
