//! The chain of frames between program and work offset: its matrix, and points through it.
//!
//! A chain of translations stays exact; with rotations or factors, positions pass through floats
//! and are rounded to a nano. Rotations are in a plane of two axes; others are refused.

use ncc_ir::canon::{AXES, Fact, Plane, Turn};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::geometry;
use ncc_ir::program::FrameStep;

/// Frames active: what the program calls `p` is `turn · p + shift` in the work offset.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// `None` is no rotation, factor or mirror.
    turn: Option<[[f64; 3]; 3]>,
    shift: [Nanos; AXES],
}

const STRAIGHT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Chain {
    /// Nothing turned and nothing shifted.
    pub const NONE: Chain = Chain { turn: None, shift: [0; AXES] };

    /// A translation.
    pub fn by(shift: [Nanos; AXES]) -> Chain {
        Chain { turn: None, shift }
    }

    /// A point of the program in the work offset.
    pub fn place(&self, p: &[Nanos; AXES]) -> [Nanos; AXES] {
        let mut out = *p;
        if let Some(turn) = &self.turn {
            for (out, row) in out.iter_mut().zip(turn) {
                *out = (row[0] * p[0] as f64 + row[1] * p[1] as f64 + row[2] * p[2] as f64).round() as Nanos;
            }
        }
        for (out, shift) in out.iter_mut().zip(&self.shift) {
            *out = out.wrapping_add(*shift);
        }
        out
    }

    /// A point of the work offset in the program.
    pub fn unplace(&self, p: &[Nanos; AXES]) -> [Nanos; AXES] {
        let mut q: [Nanos; AXES] = std::array::from_fn(|i| p[i].wrapping_sub(self.shift[i]));
        if let Some(turn) = &self.turn {
            let x = [q[0] as f64, q[1] as f64, q[2] as f64];
            let back = inverse(turn);
            for (q, row) in q.iter_mut().zip(back) {
                *q = (row[0] * x[0] + row[1] * x[1] + row[2] * x[2]).round() as Nanos;
            }
        }
        q
    }

    /// Adds a step of a program.
    ///
    /// # Errors
    /// What `plane`, `value` and `out_of_range` give.
    pub fn add<E>(
        &mut self,
        step: &FrameStep,
        plane: impl Fn(Fact<Plane>) -> Result<Plane, E>,
        value: impl Fn(&Expr) -> Result<Nanos, E>,
        out_of_range: impl Fn() -> E,
    ) -> Result<(), E> {
        match step {
            FrameStep::Translate(words) => {
                let mut by = [0; AXES];
                for (by, word) in by.iter_mut().zip(words.iter()) {
                    if let Some(word) = word {
                        *by = value(word)?;
                    }
                }
                self.shift = self.place(&by);
            }
            FrameStep::Rotate { plane: p, angle } => {
                let (f, s, _) = plane(*p)?.axes();
                let (sin, cos) = geometry::sin_cos(value(angle)?);
                let mut step = STRAIGHT;
                let (f, s) = (f as usize, s as usize);
                (step[f][f], step[f][s], step[s][f], step[s][s]) = (cos, -sin, sin, cos);
                self.append(step);
            }
            FrameStep::Scale(words) => {
                let mut step = STRAIGHT;
                for (i, word) in words.iter().enumerate() {
                    if let Some(word) = word {
                        let factor = value(word)?;
                        if factor <= 0 {
                            return Err(out_of_range());
                        }
                        step[i][i] = factor as f64 / ONE as f64;
                    }
                }
                self.append(step);
            }
            FrameStep::Mirror(axes) => {
                let mut step = STRAIGHT;
                for (i, axis) in axes.iter().enumerate() {
                    if *axis {
                        step[i][i] = -1.0;
                    }
                }
                self.append(step);
            }
        }
        Ok(())
    }

    /// Rotation, factors and mirrors of X, Y and Z; `None` if there are none.
    pub fn turn(&self) -> Option<&[[f64; 3]; 3]> {
        self.turn.as_ref()
    }

    /// Translation, in the work offset.
    pub fn shift(&self) -> &[Nanos; AXES] {
        &self.shift
    }

    /// As [`Chain::place`], of a point of which not every axis is known.
    pub fn place_known(&self, p: &[Option<Nanos>; AXES]) -> [Option<Nanos>; AXES] {
        let placed = self.place(&p.map(Option::unwrap_or_default));
        known(self.turn.as_ref(), p, placed)
    }

    /// As [`Chain::unplace`], of a point of which not every axis is known.
    pub fn unplace_known(&self, p: &[Option<Nanos>; AXES]) -> [Option<Nanos>; AXES] {
        let placed = self.unplace(&p.map(Option::unwrap_or_default));
        known(self.turn.as_ref().map(inverse).as_ref(), p, placed)
    }

    /// Appends a step as the innermost one.
    pub(crate) fn append(&mut self, step: [[f64; 3]; 3]) {
        let turn = self.turn.unwrap_or(STRAIGHT);
        let product =
            std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| turn[i][k] * step[k][j]).sum()));
        self.turn = (product != STRAIGHT).then_some(product);
    }

    /// These frames with others inside.
    pub fn then(mut self, inner: &Chain) -> Chain {
        self.shift = self.place(&inner.shift);
        if let Some(turn) = inner.turn {
            self.append(turn);
        }
        self
    }

    /// The sense that an arc of a plane has outside, if it is an arc of the same plane there.
    pub fn sense(&self, plane: Plane, turn: Turn) -> Option<Turn> {
        let Some(m) = &self.turn else { return Some(turn) };
        let (f, s, n) = plane.axes();
        let (f, s, n) = (f as usize, s as usize, n as usize);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        let flat = [m[n][f], m[n][s], m[f][n], m[s][n]].into_iter().all(|v| near(v, 0.0));
        let straight = near(m[f][f], m[s][s]) && near(m[f][s], -m[s][f]);
        let mirrored = near(m[f][f], -m[s][s]) && near(m[f][s], m[s][f]);
        match (flat, straight, mirrored) {
            (true, true, _) => Some(turn),
            (true, false, true) => Some(match turn {
                Turn::Clockwise => Turn::Counterclockwise,
                Turn::Counterclockwise => Turn::Clockwise,
            }),
            _ => None,
        }
    }
}

/// What is known of a point that comes from one of which not every axis is known.
fn known(
    turn: Option<&[[f64; 3]; 3]>,
    from: &[Option<Nanos>; AXES],
    to: [Nanos; AXES],
) -> [Option<Nanos>; AXES] {
    std::array::from_fn(|i| match turn.and_then(|turn| turn.get(i)) {
        None => from[i].map(|_| to[i]),
        Some(row) => {
            let all = (0..3).all(|j| from[j].is_some() || row[j].abs() < 1e-12);
            all.then_some(to[i])
        }
    })
}

/// The inverse of a matrix that has one.
fn inverse(m: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let minor = |i: usize, j: usize| {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        let (c, d) = ((j + 1) % 3, (j + 2) % 3);
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let det: f64 = (0..3).map(|j| m[0][j] * minor(0, j)).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| minor(j, i) / det))
}
