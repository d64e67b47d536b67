//! A page of SVG.
//!
//! Frames, axes, marks and texts are drawn by plotters, in tenths of a pixel, as its places are whole
//! numbers. Curves are put in as paths of the SVG itself: it knows dashes, plotters' backend does not,
//! and one element holds as many pieces as are wanted.

use std::fmt::{self, Write};

use plotters::backend::SVGBackend;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::Text;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontFamily, FontStyle, FontTransform, IntoFont, RGBColor, TextStyle, WHITE};

use crate::ink::Ink;

/// Units of a drawing in a pixel.
pub(crate) const UNIT: i32 = 10;

/// The page, or a part of it.
pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Undrawn(pub String);

impl fmt::Display for Undrawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the picture cannot be drawn: {}", self.0)
    }
}

impl std::error::Error for Undrawn {}

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for Undrawn {
    fn from(error: DrawingAreaErrorKind<E>) -> Undrawn {
        Undrawn(error.to_string())
    }
}

/// Curves and symbols that lie on the frame, as elements of SVG.
#[derive(Debug, Default)]
pub(crate) struct Layer(String);

impl Layer {
    /// A curve of several pieces, in units, with a class to find it by.
    pub(crate) fn curve(&mut self, class: &str, ink: Ink, pieces: &[Vec<(i32, i32)>]) {
        let mut d = String::new();
        for piece in pieces {
            trace(piece, &mut d);
        }
        if !d.is_empty() {
            self.path(class, ink, "none", &d);
        }
    }

    /// A path as SVG says it.
    pub(crate) fn path(&mut self, class: &str, ink: Ink, fill: &str, d: &str) {
        let dash: Vec<String> =
            ink.dash.iter().map(|length| format!("{}", length * f64::from(UNIT))).collect();
        let dash =
            if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{}\"", dash.join(" ")) };
        let (color, width) = (ink.color, ink.width * f64::from(UNIT));
        // Writing to a string cannot fail.
        let _ = writeln!(
            self.0,
            "<path class=\"{class}\" fill=\"{fill}\" stroke=\"{color}\" stroke-width=\"{width}\" \
             stroke-linejoin=\"round\"{dash} d=\"{d}\"/>"
        );
    }
}

/// The pieces of a path, each place from the one before. What goes nowhere is left out, and points
/// within a straight upright or level line are.
fn trace(points: &[(i32, i32)], d: &mut String) {
    let Some(&first) = points.first() else { return };
    let mut kept = vec![first];
    for &point in &points[1..] {
        if kept.last() == Some(&point) {
            continue;
        }
        if let [.., a, b] = kept.as_slice() {
            let on = |a: i32, b: i32, c: i32| (a < b && b < c) || (a > b && b > c);
            let upright = a.0 == b.0 && b.0 == point.0 && on(a.1, b.1, point.1);
            let level = a.1 == b.1 && b.1 == point.1 && on(a.0, b.0, point.0);
            if upright || level {
                kept.pop();
            }
        }
        kept.push(point);
    }
    if kept.len() < 2 {
        return;
    }
    let _ = write!(d, "M{} {}", first.0, first.1);
    let mut command = 'l';
    for pair in kept.windows(2) {
        let (x, y) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        let _ = write!(d, "{command}{x}{}{y}", if y < 0 { "" } else { " " });
        // A further pair needs no letter, only something between the numbers.
        command = ' ';
    }
}

/// Draws a page of so many pixels.
///
/// # Errors
/// As plotters says.
pub(crate) fn sheet(
    (width, height): (i32, i32),
    draw: impl FnOnce(&Area<'_>, &mut Layer) -> Result<(), Undrawn>,
) -> Result<String, Undrawn> {
    let size = [width, height].map(|side| (side * UNIT) as u32);
    let (mut text, mut layer) = (String::new(), Layer::default());
    {
        let area = SVGBackend::with_string(&mut text, (size[0], size[1])).into_drawing_area();
        area.fill(&WHITE)?;
        draw(&area, &mut layer)?;
        area.present()?;
    }
    let shown = format!("<svg width=\"{}\" height=\"{}\"", size[0], size[1]);
    let text = text.replacen(&shown, &format!("<svg width=\"{width}\" height=\"{height}\""), 1);
    let inside = text.trim_end().strip_suffix("</svg>").unwrap_or(&text);
    Ok(format!("{inside}{}</svg>\n", layer.0))
}

/// How a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    /// To the right of it.
    Left,
    /// Around it.
    Middle,
    /// To the left of it.
    Right,
}

/// The style of a text of so many pixels.
pub(crate) fn style<'a>(size: f64, color: RGBColor, anchor: Anchor) -> TextStyle<'a> {
    let across = match anchor {
        Anchor::Left => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::Right => HPos::Right,
    };
    // The backend divides by this.
    let size = size * 1.24 * f64::from(UNIT);
    let font = (FontFamily::SansSerif, size, FontStyle::Normal).into_font();
    let mut style = TextStyle::from(font).pos(Pos::new(across, VPos::Center));
    style.color = color.to_backend_color();
    style
}

/// Writes a text at a place in pixels.
///
/// # Errors
/// As plotters says.
pub(crate) fn write(
    area: &Area<'_>,
    text: &str,
    at: (f64, f64),
    style: TextStyle<'_>,
) -> Result<(), Undrawn> {
    area.draw(&Text::new(text.to_owned(), units(at), style))?;
    Ok(())
}

/// The same, bold.
///
/// # Errors
/// As plotters says.
pub(crate) fn write_bold(area: &Area<'_>, text: &str, at: (f64, f64), size: f64) -> Result<(), Undrawn> {
    let mut bold = style(size, crate::ink::BLACK, Anchor::Left);
    bold.font = bold.font.style(FontStyle::Bold);
    write(area, text, at, bold)
}

/// A text that runs upwards, around its place.
///
/// # Errors
/// As plotters says.
pub(crate) fn write_up(area: &Area<'_>, text: &str, at: (f64, f64), size: f64) -> Result<(), Undrawn> {
    let mut up = style(size, crate::ink::BLACK, Anchor::Middle);
    up.font = up.font.transform(FontTransform::Rotate270);
    write(area, text, at, up)
}

/// Units of pixels.
pub(crate) fn units(at: (f64, f64)) -> (i32, i32) {
    ((at.0 * f64::from(UNIT)).round() as i32, (at.1 * f64::from(UNIT)).round() as i32)
}

/// How wide a text is about, pixels: letters of a plain face are a little over half as wide as high.
pub(crate) fn about_wide(text: &str, size: f64) -> f64 {
    0.58 * size * text.chars().count() as f64
}

/// A text cut to a width in pixels.
pub(crate) fn cut(text: &str, size: f64, width: f64) -> String {
    if about_wide(text, size) <= width {
        return text.to_owned();
    }
    let keep = (width / (0.58 * size)).max(2.0) as usize - 1;
    let mut short: String = text.chars().take(keep).collect();
    short.push('\u{2026}');
    short
}
