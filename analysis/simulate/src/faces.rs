//! The faces of a part around its hollows, for pictures: the upper surface alone hides them.
//!
//! The part is made of upright blocks there, one a cell. Faces of neighbours in one plane are joined.

use crate::hollows::without;
use crate::map::{Grid, HeightMap};

/// How far from a hollow the part is made of blocks, cells. A picture draws the upper surface from point to point, these up to
/// four cells apart; a wall between two such points must not close a hollow.
const REACH: usize = 4;

/// The direction of a face, from the material outwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Side {
    /// Up: the top of material.
    Up,
    /// Down: the ceiling of a hollow.
    Down,
    /// To less Y.
    Front,
    /// To more X.
    Right,
    /// To more Y.
    Back,
    /// To less X.
    Left,
}

/// A rectangle of the part's surface: one side of blocks in a row. The row goes along Y where it looks right or left, else
/// along X.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// The first cell of the row, by [`Grid::index`].
    pub cell: u32,
    /// Its direction.
    pub side: Side,
    /// How many cells.
    pub length: u16,
    /// From and to which height, mm; the same of one that looks up or down.
    pub between: [f32; 2],
}

/// The cells, by [`Grid::index`], of which [`faces`] has the surface: all near a hollow. Empty of a part without hollows.
pub fn covered(map: &HeightMap) -> Vec<bool> {
    if map.hollows.is_empty() {
        return Vec::new();
    }
    let [width, height] = map.grid.cells;
    let mut all = vec![false; map.grid.len()];
    for (cell, _) in map.hollows.iter() {
        let near = |at: usize, cells: usize| at.saturating_sub(REACH)..(at + REACH + 1).min(cells);
        let [column, row] = map.grid.place(cell);
        for row in near(row, height) {
            let columns = near(column, width);
            all[map.grid.index([columns.start, row])..map.grid.index([columns.end, row])].fill(true);
        }
    }
    all
}

/// The faces of the cells that are covered, and the walls of those beside them towards these. `level` is where the part ends
/// below, mm; no face is drawn of its underside.
pub fn faces(map: &HeightMap, covered: &[bool], level: f32) -> Vec<Face> {
    let [width, height] = map.grid.cells;
    let mut all = Vec::new();
    if covered.is_empty() {
        return all;
    }
    let is_covered = |at: [usize; 2]| covered[map.grid.index(at)];
    let material = |at: [usize; 2]| map.material(map.grid.index(at), level);
    let mut rows = Rows { grid: map.grid, open: Vec::new(), all: &mut all };
    for row in 0..height {
        for column in (0..width).filter(|column| is_covered([*column, row])) {
            let own = material([column, row]);
            for [low, high] in &own {
                rows.add([column, row], Side::Up, [*high; 2]);
                if *low > level {
                    rows.add([column, row], Side::Down, [*low; 2]);
                }
            }
        }
        // A wall is drawn where one of the two cells beside it is covered.
        if row + 1 < height {
            for column in 0..width {
                let [own, other] = [[column, row], [column, row + 1]];
                if is_covered(own) || is_covered(other) {
                    let [own_has, other_has] = [own, other].map(material);
                    without(&own_has, &other_has)
                        .into_iter()
                        .for_each(|wall| rows.add(own, Side::Back, wall));
                    without(&other_has, &own_has)
                        .into_iter()
                        .for_each(|wall| rows.add(other, Side::Front, wall));
                }
            }
        }
        rows.end();
    }
    for column in 0..width.saturating_sub(1) {
        for row in 0..height {
            let [own, other] = [[column, row], [column + 1, row]];
            if is_covered(own) || is_covered(other) {
                let [own_has, other_has] = [own, other].map(material);
                without(&own_has, &other_has).into_iter().for_each(|wall| rows.add(own, Side::Right, wall));
                without(&other_has, &own_has).into_iter().for_each(|wall| rows.add(other, Side::Left, wall));
            }
        }
        rows.end();
    }
    borders(map, covered, level, &mut rows);
    all
}

/// The walls at the border of the map.
fn borders(map: &HeightMap, covered: &[bool], level: f32, rows: &mut Rows) {
    let [width, height] = map.grid.cells;
    let mut side = |side: Side, cells: &mut dyn Iterator<Item = [usize; 2]>| {
        for [column, row] in cells {
            let cell = map.grid.index([column, row]);
            if covered[cell] {
                map.material(cell, level).into_iter().for_each(|wall| rows.add([column, row], side, wall));
            }
        }
        rows.end();
    };
    side(Side::Front, &mut (0..width).map(|column| [column, 0]));
    side(Side::Back, &mut (0..width).map(|column| [column, height - 1]));
    side(Side::Left, &mut (0..height).map(|row| [0, row]));
    side(Side::Right, &mut (0..height).map(|row| [width - 1, row]));
}

/// Makes long faces of short ones.
struct Rows<'a> {
    grid: Grid,
    /// Those that the next cell may go on with.
    open: Vec<Face>,
    all: &'a mut Vec<Face>,
}

impl Rows<'_> {
    fn add(&mut self, [column, row]: [usize; 2], side: Side, between: [f32; 2]) {
        let cell = self.grid.index([column, row]);
        let step = match side {
            Side::Right | Side::Left => self.grid.pitch(),
            Side::Up | Side::Down | Side::Front | Side::Back => 1,
        };
        let goes_on = |face: &&mut Face| {
            face.side == side
                && face.between == between
                && face.length < u16::MAX
                && face.cell as usize + usize::from(face.length) * step == cell
        };
        match self.open.iter_mut().find(goes_on) {
            Some(face) => face.length += 1,
            None => {
                let behind = |face: &Face| face.cell as usize + usize::from(face.length) * step < cell;
                self.all.extend(self.open.extract_if(.., |face| face.side == side && behind(face)));
                self.open.push(Face { cell: cell as u32, side, length: 1, between });
            }
        }
    }

    /// The row ends here.
    fn end(&mut self) {
        self.all.append(&mut self.open);
    }
}
