//! Converts triangles to a height map (`rasterise`), and a height map to a closed body of triangles (`mesh`).
//!
//! Not here: cutting (`cut`), and reading or writing of mesh files.

use crate::hollows::without;
use crate::map::HeightMap;

/// Three corners, X Y Z in mm; counterclockwise as seen from outside.
pub type Triangle = [[f32; 3]; 3];

/// Raises the cells of a map to the upper surface of a body. It raises each cell with its centre under a triangle.
pub fn rasterise(triangles: &[Triangle], map: &mut HeightMap) {
    let grid = map.grid;
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| corner.map(f64::from));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 || !area.is_finite() {
            continue;
        }
        let least = |axis: usize| a[axis].min(b[axis]).min(c[axis]);
        let most = |axis: usize| a[axis].max(b[axis]).max(c[axis]);
        for row in grid.between(1, least(1), most(1)) {
            let y = grid.centre(1, row);
            for column in grid.between(0, least(0), most(0)) {
                let x = grid.centre(0, column);
                let part = |p: [f64; 3], q: [f64; 3]| {
                    ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / area
                };
                let [of_c, of_a, of_b] = [part(a, b), part(b, c), part(c, a)];
                // A centre on a shared edge belongs to both triangles.
                if of_a.min(of_b).min(of_c) >= -1e-9 {
                    let height = (of_a * a[2] + of_b * b[2] + of_c * c[2]) as f32;
                    let own = &mut map.heights[grid.index([column, row])];
                    *own = own.max(height);
                }
            }
        }
    }
}

/// Passes the closed body between `level` (Z, mm) and the heights of a map to `triangle`. Corners lie at the centre of
/// every `step`th cell. Cells without material above the level give no triangles.
///
/// A wall is as wide as the distance between two corners. A map with hollows gives upright blocks instead, each
/// `step` cells wide: its walls are steps.
pub fn mesh(map: &HeightMap, level: f32, step: usize, triangle: &mut dyn FnMut(Triangle)) {
    let [width, height] = map.grid.cells;
    let step = step.max(1);
    if !map.hollows.is_empty() {
        blocks(map, level, step, triangle);
        return;
    }
    let places = |cells: usize| -> Vec<usize> {
        let mut all: Vec<usize> = (0..cells).step_by(step).collect();
        if all.last() != Some(&(cells - 1)) {
            all.push(cells - 1);
        }
        all
    };
    let (columns, rows) = (places(width), places(height));
    // The outermost corners lie on the border of the map, not half a cell within it.
    let along = |axis: usize, all: &[usize], n: usize| {
        let side = map.grid.cell / 2.0;
        let off = if n == 0 {
            -side
        } else if n + 1 == all.len() {
            side
        } else {
            0.0
        };
        (map.grid.centre(axis, all[n]) + off) as f32
    };
    let top = |i: usize, j: usize| map.heights[map.grid.index([columns[i], rows[j]])].max(level);
    let corner = |i: usize, j: usize, z: f32| [along(0, &columns, i), along(1, &rows, j), z];
    let solid = |i: usize, j: usize| {
        i + 1 < columns.len()
            && j + 1 < rows.len()
            && [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].iter().any(|(i, j)| top(*i, *j) > level)
    };
    for j in 0..rows.len().saturating_sub(1) {
        for i in 0..columns.len().saturating_sub(1) {
            if !solid(i, j) {
                continue;
            }
            let up = |i: usize, j: usize| corner(i, j, top(i, j));
            let down = |i: usize, j: usize| corner(i, j, level);
            triangle([up(i, j), up(i + 1, j), up(i + 1, j + 1)]);
            triangle([up(i, j), up(i + 1, j + 1), up(i, j + 1)]);
            triangle([down(i, j), down(i + 1, j + 1), down(i + 1, j)]);
            triangle([down(i, j), down(i, j + 1), down(i + 1, j + 1)]);
            let sides = [
                (j == 0 || !solid(i, j - 1), (i, j), (i + 1, j)),
                (!solid(i + 1, j), (i + 1, j), (i + 1, j + 1)),
                (!solid(i, j + 1), (i + 1, j + 1), (i, j + 1)),
                (i == 0 || !solid(i - 1, j), (i, j + 1), (i, j)),
            ];
            for (open, (i0, j0), (i1, j1)) in sides {
                if !open {
                    continue;
                }
                let [a, b] = [down(i0, j0), down(i1, j1)];
                let [c, d] = [up(i1, j1), up(i0, j0)];
                // Leave out a wall without height.
                if c[2] > level {
                    triangle([a, b, c]);
                }
                if d[2] > level {
                    triangle([a, c, d]);
                }
            }
        }
    }
}

/// The body as upright blocks: tops, bottoms, and walls where the next block has no material.
fn blocks(map: &HeightMap, level: f32, step: usize, triangle: &mut dyn FnMut(Triangle)) {
    let [width, height] = map.grid.cells;
    let [columns, rows] = [width.div_ceil(step), height.div_ceil(step)];
    // The middle cell gives the material of a block.
    let middle = |n: usize, cells: usize| (n * step + step / 2).min(cells - 1);
    let of = |i: usize, j: usize| map.material(map.grid.index([middle(i, width), middle(j, height)]), level);
    let place = |axis: usize, n: usize, cells: usize| {
        (map.grid.low[axis] + (n * step).min(cells) as f64 * map.grid.cell) as f32
    };
    let mut quad = |[a, b, c, d]: [[f32; 3]; 4]| {
        triangle([a, b, c]);
        triangle([a, c, d]);
    };
    for j in 0..rows {
        let [y0, y1] = [j, j + 1].map(|n| place(1, n, height));
        for i in 0..columns {
            let [x0, x1] = [i, i + 1].map(|n| place(0, n, width));
            let own = of(i, j);
            for [low, high] in &own {
                quad([[x0, y0, *high], [x1, y0, *high], [x1, y1, *high], [x0, y1, *high]]);
                quad([[x0, y0, *low], [x0, y1, *low], [x1, y1, *low], [x1, y0, *low]]);
            }
            let beside = |is_there: bool, i: usize, j: usize| if is_there { of(i, j) } else { Vec::new() };
            let walls = [
                (beside(j > 0, i, j.wrapping_sub(1)), [x0, y0], [x1, y0]),
                (beside(i + 1 < columns, i + 1, j), [x1, y0], [x1, y1]),
                (beside(j + 1 < rows, i, j + 1), [x1, y1], [x0, y1]),
                (beside(i > 0, i.wrapping_sub(1), j), [x0, y1], [x0, y0]),
            ];
            for (other, [ax, ay], [bx, by]) in walls {
                for [low, high] in without(&own, &other) {
                    quad([[ax, ay, low], [bx, by, low], [bx, by, high], [ax, ay, high]]);
                }
            }
        }
    }
}
