//! A part as a picture: seen from above or from a corner, lit from the upper left, each tool in a colour of its own.

use crate::map::HeightMap;

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

/// Draws a part above a level, `most` pixels along the longer side. `tool` says which tool made a move, counted from 0.
pub fn draw(map: &HeightMap, level: f32, look: Look, most: usize, tool: &dyn Fn(u32) -> usize) -> Picture {
    match look {
        Look::Plan => plan(map, level, most, tool),
        Look::Corner => corner(map, level, most, tool),
    }
}

/// The light on a surface that rises by so much along X and along Y, from 0.25 to 1.
fn light(rise: [f64; 2]) -> f64 {
    let normal = [-rise[0], -rise[1], 1.0];
    let length = (normal[0] * normal[0] + normal[1] * normal[1] + 1.0).sqrt();
    let towards: f64 = normal.into_iter().zip(LIGHT).map(|(n, l)| n * l).sum();
    0.25 + 0.75 * (towards / length).max(0.0)
}

fn shaded(colour: [u8; 3], by: f64) -> [u8; 4] {
    let [r, g, b] = colour.map(|part| (f64::from(part) * by).round().clamp(0.0, 255.0) as u8);
    [r, g, b, 255]
}

/// The colour of what a move has made.
fn colour(number: u32, tool: &dyn Fn(u32) -> usize) -> [u8; 3] {
    match number {
        0 => RAW,
        number => COLOURS[tool(number) % COLOURS.len()],
    }
}

/// The slope at a cell is that of the cells up to this many away. A round wall is a staircase on a grid; so it is lit as a round
/// wall.
const AROUND: usize = 2;

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
                true => shaded(colour(map.last[cell], tool), light(rise(map, level, column, row))),
                false => [0; 4],
            };
            pixels.extend(pixel);
        }
    }
    Picture { width, height, pixels }
}

/// cos 30°: along the axes of an isometric picture.
const COS: f64 = 0.866_025_403_784_438_6;

/// The isometric picture of a map: X goes to the right and up, Y to the left and up, Z up.
struct Isometric {
    /// Sides of the map, mm.
    sides: [f64; 2],
    /// Pixels a mm.
    scale: f64,
    width: usize,
    height: usize,
}

/// A place of the map behind a column of pixels.
struct Place {
    column: usize,
    row: usize,
    /// How far up its ground is drawn, in the picture's mm.
    ground: f64,
}

impl Isometric {
    fn of(map: &HeightMap, level: f32, most: usize) -> Isometric {
        let [long, deep] = map.grid.cells.map(|cells| cells as f64 * map.grid.cell);
        let thick = f64::from(map.highest().max(level)) - f64::from(level);
        let across = (long + deep) * COS;
        let up = (long + deep) * 0.5 + thick;
        let scale = most.max(1) as f64 / across.max(up).max(1e-9);
        let [width, height] = [across, up].map(|side| ((side * scale).ceil() as usize).max(1));
        Isometric { sides: [long, deep], scale, width, height }
    }

    /// Behind a column of pixels lies a line of the part along which X and Y grow by the same: X less Y on it.
    fn line(&self, column: usize) -> f64 {
        (column as f64 + 0.5) / self.scale / COS - self.sides[1]
    }

    /// The places on that line, from the front to the back, two a cell.
    fn places(&self, map: &HeightMap, u: f64) -> impl Iterator<Item = Place> {
        let ([long, deep], cell, cells) = (self.sides, map.grid.cell, map.grid.cells);
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
        let [low, high] = [from, to].map(|at| ((at * self.scale).round().max(0.0) as usize).min(self.height));
        low..high
    }

    fn put(&self, pixels: &mut [u8], column: usize, line: usize, pixel: [u8; 4]) {
        let at = 4 * ((self.height - 1 - line) * self.width + column);
        pixels[at..at + 4].copy_from_slice(&pixel);
    }
}

/// The light on walls that look to less X, which are seen on the left, and on those that look to less Y.
const WALLS: [f64; 2] = [0.45, 0.6];

/// Draws the isometric picture, one column of pixels after the other, from the front to the back. A nearer cell hides those
/// behind it.
fn corner(map: &HeightMap, level: f32, most: usize, tool: &dyn Fn(u32) -> usize) -> Picture {
    let view = Isometric::of(map, level, most);
    let mut pixels = vec![0_u8; 4 * view.width * view.height];
    for column in 0..view.width {
        match map.hollows.is_empty() {
            true => surface_behind(map, level, &view, column, tool, &mut pixels),
            false => material_behind(map, level, &view, column, tool, &mut pixels),
        }
    }
    Picture { width: view.width, height: view.height, pixels }
}

/// Draws the upper surface behind a column of pixels.
fn surface_behind(
    map: &HeightMap,
    level: f32,
    view: &Isometric,
    column: usize,
    tool: &dyn Fn(u32) -> usize,
    pixels: &mut [u8],
) {
    let u = view.line(column);
    let mut drawn = 0.0_f64;
    for (step, Place { column: i, row: j, ground }) in view.places(map, u).enumerate() {
        let own = j * map.grid.cells[0] + i;
        let stands = f64::from(map.heights[own].max(level)) - f64::from(level);
        let seen = ground + stands;
        // The first cell shows a wall of the part down to the level.
        let from = if step == 0 { ground } else { drawn };
        if stands > 0.0 && seen > from {
            let by = match step {
                0 => WALLS[usize::from(u >= 0.0)],
                _ => light(rise(map, level, i, j)),
            };
            let pixel = shaded(colour(map.last[own], tool), by);
            view.lines(from, seen).for_each(|line| view.put(pixels, column, line, pixel));
        }
        drawn = drawn.max(seen).max(from);
    }
}

/// Draws the material behind a column of pixels where there are hollows: each piece of it hides what is behind it, and no more.
fn material_behind(
    map: &HeightMap,
    level: f32,
    view: &Isometric,
    column: usize,
    tool: &dyn Fn(u32) -> usize,
    pixels: &mut [u8],
) {
    let width = map.grid.cells[0];
    let mut hidden = vec![false; view.height];
    let (mut last, mut material) = (None, Vec::new());
    for Place { column: i, row: j, ground } in view.places(map, view.line(column)) {
        let own = j * width + i;
        let before = [(i > 0).then(|| own - 1), (j > 0).then(|| own - width)];
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
            for line in view.lines(low, high) {
                if std::mem::replace(&mut hidden[line], true) {
                    continue;
                }
                let height = (f64::from(level) + (line as f64 + 0.5) / view.scale - ground) as f32;
                // A cell shows a wall where the one before it is empty, else its top.
                let is_open = |side: &usize| before[*side].is_none_or(|cell| !is_solid(map, cell, height));
                let wall = sides.clone().find(is_open);
                let (number, by) = match wall {
                    // It is of the move that has emptied that one.
                    Some(side) => (before[side].map_or(0, |cell| emptied(map, cell, height)), WALLS[side]),
                    None if n + 1 == material.len() => (map.last[own], light(rise(map, level, i, j))),
                    None => (map.hollows.last(own), light([0.0; 2])),
                };
                view.put(pixels, column, line, shaded(colour(number, tool), by));
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
