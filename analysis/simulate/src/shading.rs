//! Colours of tools, and light on a part.

use crate::map::HeightMap;

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

pub(crate) fn colour(map: &HeightMap, cell: usize, tool: &dyn Fn(u32) -> usize) -> [u8; 3] {
    match map.last[cell] {
        0 => RAW,
        number => of_tool(tool(number)),
    }
}

/// The colour of a tool.
pub(crate) fn of_tool(tool: usize) -> [u8; 3] {
    COLOURS[tool % COLOURS.len()]
}

/// The slope at a cell is that of the cells up to this many away. A round wall is a staircase on a grid; so it is lit as a round
/// wall.
pub(crate) const AROUND: usize = 2;
