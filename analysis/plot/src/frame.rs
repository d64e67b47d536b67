//! A frame with two linear axes: grid, marks and their numbers.

use crate::ink::{BLACK, GREY, GRID, Ink};
use crate::sheet::{Anchor, Face, Sheet, Style, UNIT};

/// Lines of the grid.
const LINES: Ink = Ink { color: GRID, width: 0.8, dash: &[] };
/// Axes and their marks.
const AXES: Ink = Ink { color: GREY, width: 1.0, dash: &[] };
/// Length of a mark, units.
const MARK: i32 = 4 * UNIT;
/// Size of the numbers, pixels.
const SIZE: f64 = 12.0;

/// A linear axis with its marks.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    /// Value at its beginning.
    pub(crate) low: f64,
    /// Value at its end, greater than `low`.
    pub(crate) high: f64,
    /// Values with marks.
    pub(crate) marks: Vec<f64>,
}

impl Axis {
    /// Position of a value between two positions in units.
    fn place(&self, value: f64, (from, to): (i32, i32)) -> i32 {
        let part = (value - self.low) / (self.high - self.low);
        (f64::from(from) + part * f64::from(to - from)).round() as i32
    }
}

/// Spells the number at a mark.
pub(crate) type Words<'w> = &'w dyn Fn(f64) -> String;

/// A frame on the page.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    /// Left and right edge, units.
    pub(crate) across: (i32, i32),
    /// Upper and lower edge, units.
    pub(crate) down: (i32, i32),
    /// The level axis.
    pub(crate) x: Axis,
    /// The upright axis; its beginning is at the lower edge.
    pub(crate) y: Axis,
}

impl Frame {
    /// Units of a point in the axes' values.
    pub(crate) fn place(&self, (x, y): (f64, f64)) -> (i32, i32) {
        (self.x.place(x, self.across), self.y.place(y, (self.down.1, self.down.0)))
    }

    /// Draws the grid, the upright axis, and the level axis where it has numbers.
    pub(crate) fn draw(&self, sheet: &mut Sheet, x_words: Option<Words<'_>>, y_words: Words<'_>) {
        let ((left, right), (top, bottom)) = (self.across, self.down);
        let xs: Vec<(f64, i32)> =
            self.x.marks.iter().map(|mark| (*mark, self.x.place(*mark, (left, right)))).collect();
        let ys: Vec<(f64, i32)> =
            self.y.marks.iter().map(|mark| (*mark, self.y.place(*mark, (bottom, top)))).collect();
        let mut lines: Vec<_> = xs.iter().map(|&(_, x)| vec![(x, bottom), (x, top)]).collect();
        lines.extend(ys.iter().map(|&(_, y)| vec![(left, y), (right, y)]));
        sheet.rule("grid", LINES, &lines);
        let mut axes = vec![vec![(left, top), (left, bottom)]];
        axes.extend(ys.iter().map(|&(_, y)| vec![(left - MARK, y), (left, y)]));
        if x_words.is_some() {
            axes.push(vec![(left, bottom), (right, bottom)]);
            axes.extend(xs.iter().map(|&(_, x)| vec![(x, bottom), (x, bottom + MARK)]));
        }
        sheet.rule("axis", AXES, &axes);
        let style = |anchor| Style { size: SIZE, color: BLACK, anchor, face: Face::Plain };
        let pixels = |x: i32, y: i32| (f64::from(x) / f64::from(UNIT), f64::from(y) / f64::from(UNIT));
        for (mark, y) in ys {
            sheet.text(&y_words(mark), pixels(left - 2 * MARK, y), style(Anchor::Right));
        }
        if let Some(words) = x_words {
            for (mark, x) in xs {
                sheet.text(&words(mark), pixels(x, bottom + 2 * MARK), style(Anchor::Below));
            }
        }
    }
}
