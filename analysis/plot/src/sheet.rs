//! A page of SVG as plain text.
//!
//! All coordinates are whole tenths of a pixel, so a picture has the same bytes on every system.
//! A page has two layers: frames, grids and texts lie under curves and symbols.
//!
//! ```text
//! sheet.text("X (mm)", (480.0, 100.0), Style { size: 12.0, color: BLACK, anchor: Anchor::Middle, face: Face::Plain })
//! <text x="4800" y="1000" dy="0.5ex" text-anchor="middle" font-size="120" fill="#222222">X (mm)</text>
//! ```
//!
//! Not here: axes ([`crate::frame`]), and what a picture shows.

use std::fmt::Write;

use crate::ink::Ink;

/// Units of a drawing in a pixel.
pub(crate) const UNIT: i32 = 10;

/// Position of a text relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    /// Starts at the point.
    Left,
    /// Centred on the point.
    Middle,
    /// Ends at the point.
    Right,
    /// Centred, hangs below the point.
    Below,
}

/// Face and direction of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Face {
    /// Level, normal weight.
    Plain,
    /// Level, bold.
    Bold,
    /// Runs upwards, normal weight.
    Upwards,
}

/// Looks of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Style {
    /// Font size, pixels.
    pub(crate) size: f64,
    /// Colour as SVG spells it.
    pub(crate) color: &'static str,
    /// Position relative to its point.
    pub(crate) anchor: Anchor,
    /// Face and direction.
    pub(crate) face: Face,
}

/// The page while it is drawn.
#[derive(Debug)]
pub(crate) struct Sheet {
    /// Width and height, pixels.
    size: (i32, i32),
    /// Frames, grids and texts.
    under: String,
    /// Curves and symbols.
    over: String,
}

// Writing to a string cannot fail: the results of `write!` are not looked at here.
impl Sheet {
    /// An empty white page of so many pixels.
    pub(crate) fn new(width: i32, height: i32) -> Sheet {
        Sheet { size: (width, height), under: String::new(), over: String::new() }
    }

    /// The whole document.
    pub(crate) fn finish(self) -> String {
        let ((width, height), Sheet { under, over, .. }) = (self.size, &self);
        let (w, h) = (width * UNIT, height * UNIT);
        format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {w} {h}\" font-family=\"sans-serif\" \
             xmlns=\"http://www.w3.org/2000/svg\">\n\
             <rect x=\"0\" y=\"0\" width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n{under}{over}</svg>\n"
        )
    }

    /// Writes a text at a point, pixels.
    pub(crate) fn text(&mut self, words: &str, at: (f64, f64), style: Style) {
        let (x, y) = units(at);
        let (anchor, down) = match style.anchor {
            Anchor::Left => ("start", "0.5ex"),
            Anchor::Middle => ("middle", "0.5ex"),
            Anchor::Right => ("end", "0.5ex"),
            Anchor::Below => ("middle", "0.76em"),
        };
        let face = match style.face {
            Face::Plain => String::new(),
            Face::Bold => " font-weight=\"bold\"".to_owned(),
            Face::Upwards => format!(" transform=\"rotate(270, {x}, {y})\""),
        };
        let _ = writeln!(
            self.under,
            "<text x=\"{x}\" y=\"{y}\" dy=\"{down}\" text-anchor=\"{anchor}\" font-size=\"{}\" \
             fill=\"{}\"{face}>{}</text>",
            length(style.size),
            style.color,
            escape(words)
        );
    }

    /// Fills a rectangle under the curves; corners in units.
    pub(crate) fn bar(&mut self, class: &str, from: (i32, i32), to: (i32, i32), color: &str) {
        let (x, y) = (from.0.min(to.0), from.1.min(to.1));
        let (wide, high) = ((to.0 - from.0).abs(), (to.1 - from.1).abs());
        let _ = writeln!(
            self.under,
            "<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{wide}\" height=\"{high}\" fill=\"{color}\"/>"
        );
    }

    /// Straight lines under the curves, in units.
    pub(crate) fn rule(&mut self, class: &str, ink: Ink, lines: &[Vec<(i32, i32)>]) {
        stroke(&mut self.under, class, ink, "none", &traced(lines));
    }

    /// A curve of several pieces, in units, with a class to find it by.
    pub(crate) fn curve(&mut self, class: &str, ink: Ink, pieces: &[Vec<(i32, i32)>]) {
        stroke(&mut self.over, class, ink, "none", &traced(pieces));
    }

    /// A path over the frames: `d` is its data as SVG spells it, in units.
    pub(crate) fn path(&mut self, class: &str, ink: Ink, fill: &str, d: &str) {
        stroke(&mut self.over, class, ink, fill, d);
    }
}

/// Writes an element for a path; none for a path without points.
fn stroke(layer: &mut String, class: &str, ink: Ink, fill: &str, d: &str) {
    if d.is_empty() {
        return;
    }
    let dash: Vec<String> = ink.dash.iter().map(|pixels| length(*pixels)).collect();
    let dash =
        if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{}\"", dash.join(" ")) };
    let _ = writeln!(
        layer,
        "<path class=\"{class}\" fill=\"{fill}\" stroke=\"{}\" stroke-width=\"{}\" \
         stroke-linejoin=\"round\"{dash} d=\"{d}\"/>",
        ink.color,
        length(ink.width)
    );
}

/// Path data of several pieces.
fn traced(pieces: &[Vec<(i32, i32)>]) -> String {
    let mut d = String::new();
    for piece in pieces {
        trace(piece, &mut d);
    }
    d
}

/// Path data of one piece, each point relative to the one before. A line of no length is left out,
/// and so is a point within a straight upright or level line.
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

/// A length of so many pixels in units: hundredths at most, no zeros at the end.
fn length(pixels: f64) -> String {
    let hundredths = (pixels * f64::from(UNIT) * 100.0).round() as i64;
    let text = format!("{}.{:02}", hundredths / 100, hundredths % 100);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Text that XML takes for text. Characters that XML does not allow become U+FFFD.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '\t' | '\n' | '\r' => out.push(' '),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            other => out.push(other),
        }
    }
    out
}

/// Units of pixels.
pub(crate) fn units(at: (f64, f64)) -> (i32, i32) {
    ((at.0 * f64::from(UNIT)).round() as i32, (at.1 * f64::from(UNIT)).round() as i32)
}

/// Estimated width of a text, pixels: letters of a plain face are a little over half as wide as high.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_few_digits() {
        assert_eq!([1.4, 0.7 * 0.8, 12.0, 0.0].map(length), ["14", "5.6", "120", "0"]);
    }

    #[test]
    fn text_stays_text() {
        assert_eq!(escape("a<b> & \u{1}\tc"), "a&lt;b&gt; &amp; \u{fffd} c");
    }
}
