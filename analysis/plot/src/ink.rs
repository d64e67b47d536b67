//! Colours and lines. Each is distinguished from the others by more than its colour: by dashes, width, or how
//! dark it is, so that a grey print and any reader's eyes are enough. Colours are those of Okabe and
//! Ito's set for all kinds of colour vision.

use crate::way::Stroke;

/// A line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ink {
    /// Colour as SVG and CSS have it.
    pub(crate) color: &'static str,
    /// Width, pixels.
    pub(crate) width: f64,
    /// Dash and gap, pixels; none is a whole line.
    pub(crate) dash: &'static [f64],
}

/// Text and axes.
pub(crate) const BLACK: &str = "#222222";
/// Less important text.
pub(crate) const GREY: &str = "#666666";
/// Lines of a grid.
pub(crate) const GRID: &str = "#dddddd";

/// The line of a kind of leg.
pub(crate) fn stroke(stroke: Stroke) -> Ink {
    match stroke {
        Stroke::Rapid => Ink { color: "#9a9a9a", width: 0.8, dash: &[4.0, 3.0] },
        Stroke::Feed | Stroke::Still | Stroke::Unseen => Ink { color: "#0072b2", width: 1.4, dash: &[] },
        Stroke::Arc => Ink { color: "#e69f00", width: 1.8, dash: &[] },
        Stroke::Hole => Ink { color: "#a03c00", width: 1.4, dash: &[] },
    }
}

/// The curve of an axis.
pub(crate) fn axis(at: usize) -> Ink {
    match at % 3 {
        0 => Ink { color: "#0072b2", width: 1.5, dash: &[] },
        1 => Ink { color: "#d55e00", width: 1.5, dash: &[7.0, 3.0] },
        _ => Ink { color: "#111111", width: 1.5, dash: &[1.5, 2.5] },
    }
}

/// The only curve of a chart.
pub(crate) const CURVE: Ink = Ink { color: "#0072b2", width: 1.5, dash: &[] };

/// The curves of two programs: a light broad one, and a dark narrow one that lies on it where they
/// agree.
pub(crate) const PAIR: [Ink; 2] =
    [Ink { color: "#7cc4ee", width: 4.0, dash: &[] }, Ink { color: "#8a2d00", width: 1.2, dash: &[] }];
