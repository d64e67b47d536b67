//! Programmable frames: a matrix and a shift, from `reference/siemens.md` section 6.

/// `machine = m * p + t`, as far as work offset and tool are left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    pub(crate) m: [[f64; 3]; 3],
    pub(crate) t: [f64; 3],
}

impl Frame {
    pub(crate) const NONE: Frame =
        Frame { m: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], t: [0.0; 3] };

    pub(crate) fn shift(by: [f64; 3]) -> Frame {
        Frame { t: by, ..Frame::NONE }
    }

    /// Factors along the axes; -1 mirrors.
    pub(crate) fn factors(by: [f64; 3]) -> Frame {
        let mut frame = Frame::NONE;
        for (axis, factor) in by.into_iter().enumerate() {
            frame.m[axis][axis] = factor;
        }
        frame
    }

    /// Degrees in a plane, from its first axis towards its second.
    pub(crate) fn turn(degrees: f64, first: usize, second: usize) -> Frame {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let mut frame = Frame::NONE;
        frame.m[first][first] = cos;
        frame.m[first][second] = -sin;
        frame.m[second][first] = sin;
        frame.m[second][second] = cos;
        frame
    }

    pub(crate) fn apply(&self, p: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| self.t[i] + (0..3).map(|k| self.m[i][k] * p[k]).sum::<f64>())
    }

    /// This frame, and `inner` inside it.
    pub(crate) fn then(&self, inner: &Frame) -> Frame {
        let m = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).map(|k| self.m[i][k] * inner.m[k][j]).sum())
        });
        Frame { m, t: self.apply(inner.t) }
    }

    /// Where `apply` leads to `q` from.
    pub(crate) fn undo(&self, q: [f64; 3]) -> [f64; 3] {
        let d: [f64; 3] = std::array::from_fn(|i| q[i] - self.t[i]);
        let det = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
            a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1])
                + c[0] * (a[1] * b[2] - a[2] * b[1])
        };
        let column = |k: usize| [self.m[0][k], self.m[1][k], self.m[2][k]];
        let (a, b, c) = (column(0), column(1), column(2));
        let whole = det(a, b, c);
        [det(d, b, c) / whole, det(a, d, c) / whole, det(a, b, d) / whole]
    }

    /// Whether every place has the same coordinate of an axis here and in another frame: then a word of
    /// that axis says the same in both, from zero or from where it stands.
    pub(crate) fn agrees(&self, other: &Frame, axis: usize) -> bool {
        const FAR: f64 = 1000.0;
        [[0.0; 3], [FAR, 0.0, 0.0], [0.0, FAR, 0.0], [0.0, 0.0, FAR]]
            .into_iter()
            .all(|place| (self.undo(place)[axis] - other.undo(place)[axis]).abs() < 1e-9)
    }

    /// Whether words of one axis move more than one axis of the machine.
    pub(crate) fn turns(&self) -> bool {
        (0..3).any(|i| (0..3).any(|j| i != j && self.m[i][j].abs() > 1e-12))
    }

    /// What becomes of circles in a plane: `Some(true)` if they are run the other way round, `None`
    /// if they are no circles in that plane of the machine any more.
    pub(crate) fn reverses(&self, first: usize, second: usize, normal: usize) -> Option<bool> {
        let m = &self.m;
        let out = [first, second].iter().any(|i| m[normal][*i].abs() + m[*i][normal].abs() > 1e-12);
        let (a, b) = ((m[first][first], m[second][first]), (m[first][second], m[second][second]));
        let round = (a.0.hypot(a.1) - b.0.hypot(b.1)).abs() < 1e-9 && (a.0 * b.0 + a.1 * b.1).abs() < 1e-9;
        (!out && round).then_some(a.0 * b.1 - a.1 * b.0 < 0.0)
    }
}
