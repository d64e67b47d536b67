//! From space to paper.

/// From where one looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// From above: X to the right, Y up.
    Plan,
    /// From the right, the front and above alike: X down to the right, Y up to the right, Z up.
    Isometric,
}

/// A point on paper, right and up, in mm. Lengths never grow: both are orthogonal projections.
pub fn project(view: View, p: [f64; 3]) -> [f64; 2] {
    match view {
        View::Plan => [p[0], p[1]],
        View::Isometric => {
            let (right, up) = (0.5f64.sqrt(), (1.0 / 6.0f64).sqrt());
            [right * (p[0] + p[1]), up * (p[1] - p[0] + 2.0 * p[2])]
        }
    }
}
