//! A part as a picture: seen from above or from a corner, lit from the upper left, each tool in a colour of its own.

use crate::isometric;
use crate::map::HeightMap;
use crate::pixels::{Picture, colour, light, rise, shaded};

/// From where a part is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// From above.
    Plan,
    /// From the front, the right and above: isometric.
    Corner,
}

/// Draws a part above a level, `most` pixels along the longer side. `tool` says which tool made a move, counted from 0.
pub fn draw(map: &HeightMap, level: f32, look: Look, most: usize, tool: &dyn Fn(u32) -> usize) -> Picture {
    match look {
        Look::Plan => plan(map, level, most, tool),
        Look::Corner => isometric::draw(map, level, most, tool),
    }
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
            let cell = map.grid.index([column, row]);
            let pixel = match map.heights[cell] > level {
                true => shaded(colour(map.last[cell], tool), light(rise(map, level, column, row))),
                false => [0; 4],
            };
            pixels.extend(pixel);
        }
    }
    Picture { width, height, pixels }
}
