//! Pixels of pictures of a part: lit from the upper left, each tool in a colour of its own.

use crate::map::HeightMap;

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

/// Colours of tools, in the order in which they come first: easy to tell apart for people who see few colours (Okabe, Ito).
pub const COLOURS: [[u8; 3]; 7] = [
    [0x56, 0xb4, 0xe9],
    [0xe6, 0x9f, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xf0, 0xe4, 0x42],
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
];

/// The colour of what no tool has touched.
pub const RAW: [u8; 3] = [0xb8, 0xbc, 0xc2];

/// Direction to the light, a unit vector.
const LIGHT: [f64; 3] = [-0.408_248_3, -0.408_248_3, 0.816_496_6];

/// The light on a surface that rises by so much along X and along Y, from 0.25 to 1.
pub(crate) fn light(rise: [f64; 2]) -> f64 {
    let normal = [-rise[0], -rise[1], 1.0];
    let length = (normal[0] * normal[0] + normal[1] * normal[1] + 1.0).sqrt();
    let towards: f64 = normal.into_iter().zip(LIGHT).map(|(n, l)| n * l).sum();
    0.25 + 0.75 * (towards / length).max(0.0)
}

pub(crate) fn shaded(colour: [u8; 3], by: f64) -> [u8; 4] {
    let [r, g, b] = colour.map(|part| (f64::from(part) * by).round().clamp(0.0, 255.0) as u8);
    [r, g, b, 255]
}

/// The colour of what a move has made.
pub(crate) fn colour(number: u32, tool: &dyn Fn(u32) -> usize) -> [u8; 3] {
    match number {
        0 => RAW,
        number => COLOURS[tool(number) % COLOURS.len()],
    }
}

/// The slope at a cell is that of the cells up to this many away. A round wall is a staircase on a grid; so it is lit as a round
/// wall.
const AROUND: usize = 2;

/// How steeply the surface rises over a cell along both axes. What is below the level counts as the level.
pub(crate) fn rise(map: &HeightMap, level: f32, column: usize, row: usize) -> [f64; 2] {
    let [width, height] = map.grid.cells;
    let near = |at: usize, cells: usize| at.saturating_sub(AROUND)..(at + AROUND + 1).min(cells);
    let (columns, rows) = (near(column, width), near(row, height));
    // The slope of the plane that fits best.
    let (mut weights, mut sums) = ([0.0; 2], [0.0; 2]);
    let middle = |range: &std::ops::Range<usize>| (range.start + range.end - 1) as f64 / 2.0;
    let [cx, cy] = [middle(&columns), middle(&rows)];
    for j in rows {
        for i in columns.clone() {
            let z = f64::from(map.heights[map.grid.index([i, j])].max(level));
            let off = [i as f64 - cx, j as f64 - cy];
            for axis in 0..2 {
                weights[axis] += off[axis] * off[axis];
                sums[axis] += off[axis] * z;
            }
        }
    }
    [0, 1].map(|axis| if weights[axis] > 0.0 { sums[axis] / (weights[axis] * map.grid.cell) } else { 0.0 })
}
