//! The tool path from above and in isometric view, one scale for all axes.

use std::collections::HashSet;
use std::fmt::Write;

use crate::frame::{Axis, Frame};
use crate::ink::{self, BLACK, GREY, GRID, Ink, PAIR};
use crate::project::{View, project};
use crate::record::Record;
use crate::sheet::{Anchor, Face, Sheet, Style, UNIT, about_wide, cut, units};
use crate::ticks::{duration, marks, number};
use crate::way::{Extent, Stroke, Way};

const TOP: f64 = 66.0;
const LEFT: f64 = 76.0;
const BOTTOM: f64 = 58.0;
/// Where the legend stands.
const RIGHT: f64 = 150.0;
/// Greatest size of the drawing itself.
const MOST: (f64, f64) = (900.0, 720.0);
/// Least width of it: the caption is above.
const LEAST: f64 = 440.0;
const SIZE: f64 = 12.0;
/// From so many legs on, lines are hairs.
const CLOSE: usize = 4000;

/// From drawing coordinates to the page.
struct Paper {
    /// Drawing coordinates of the left lower corner.
    low: [f64; 2],
    /// Pixels in a mm.
    scale: f64,
    /// Size of the drawing, pixels.
    size: (f64, f64),
}

impl Paper {
    /// Puts a box of drawing coordinates on a page as large as it can be.
    fn of(low: [f64; 2], high: [f64; 2]) -> Paper {
        let longer = (high[0] - low[0]).max(high[1] - low[1]).max(1.0);
        let room = longer * 0.05;
        let (low, high) = (low.map(|v| v - room), high.map(|v| v + room));
        let (wide, tall) = (high[0] - low[0], high[1] - low[1]);
        let scale = (MOST.0 / wide).min(MOST.1 / tall);
        let size = ((wide * scale).max(LEAST), (tall * scale).max(160.0));
        // What is wider than the drawing lies on both sides of it.
        let low = [low[0] - (size.0 / scale - wide) / 2.0, low[1] - (size.1 / scale - tall) / 2.0];
        Paper { low, scale, size }
    }

    fn high(&self) -> [f64; 2] {
        [self.low[0] + self.size.0 / self.scale, self.low[1] + self.size.1 / self.scale]
    }

    /// Pixels of the page.
    fn at(&self, p: [f64; 2]) -> (f64, f64) {
        (LEFT + (p[0] - self.low[0]) * self.scale, TOP + self.size.1 - (p[1] - self.low[1]) * self.scale)
    }
}

/// The way of one program, or of two over each other, as SVG.
pub fn view(records: &[&Record], view: View, caption: &str) -> String {
    let mut extent = Extent::default();
    for record in records.iter().filter(|record| !record.way.extent.is_empty()) {
        extent.add(record.way.extent.low);
        extent.add(record.way.extent.high);
    }
    if extent.is_empty() {
        extent = Extent { low: [0.0; 3], high: [0.0; 3] };
    }
    let corners = extent.corners().map(|corner| project(view, corner));
    let side = |i: usize| {
        corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |a, c| (a.0.min(c[i]), a.1.max(c[i])))
    };
    let ((left, right), (lower, upper)) = (side(0), side(1));
    let paper = Paper::of([left, lower], [right, upper]);
    let page = (LEFT + paper.size.0 + RIGHT, TOP + paper.size.1 + BOTTOM);
    let mut sheet = Sheet::new(page.0.ceil() as i32, page.1.ceil() as i32);
    heading(&mut sheet, records, view, caption, page.0);
    match view {
        View::Plan => plan_frame(&mut sheet, &paper),
        View::Isometric => box_frame(&mut sheet, &paper, &extent),
    }
    for (n, record) in records.iter().enumerate() {
        let one = (records.len() > 1).then(|| PAIR[n.min(1)]);
        lines(&mut sheet, record, view, &paper, one);
        symbols(&mut sheet, record, view, &paper, one);
    }
    legend(&mut sheet, records, LEFT + paper.size.0 + 18.0);
    sheet.finish()
}

/// Looks of a level text.
fn style(size: f64, color: &'static str, anchor: Anchor) -> Style {
    Style { size, color, anchor, face: Face::Plain }
}

fn heading(sheet: &mut Sheet, records: &[&Record], view: View, caption: &str, page: f64) {
    let names: Vec<&str> = records.iter().map(|record| record.name.as_str()).collect();
    let what = match view {
        View::Plan => "plan",
        View::Isometric => "isometric",
    };
    let title = cut(&format!("{}, {what}", names.join(" and ")), 17.0, page - 40.0);
    sheet.text(&title, (20.0, 22.0), Style { face: Face::Bold, ..style(17.0, BLACK, Anchor::Left) });
    let text = match records {
        [one] => format!("{} \u{b7} {caption}", duration(one.end - one.begin)),
        _ => caption.to_owned(),
    };
    sheet.text(&cut(&text, SIZE, page - 40.0), (20.0, 44.0), style(SIZE, GREY, Anchor::Left));
}

/// X and Y with a grid of one step.
fn plan_frame(sheet: &mut Sheet, paper: &Paper) {
    let high = paper.high();
    let (wide, tall) = (high[0] - paper.low[0], high[1] - paper.low[1]);
    let most = (paper.size.0.max(paper.size.1) / 62.0) as usize;
    let (_, step) = marks(0.0, wide.max(tall), most);
    let along = |i: usize| {
        let first = (paper.low[i] / step).ceil() as i64;
        let last = (high[i] / step).floor() as i64;
        Axis { low: paper.low[i], high: high[i], marks: (first..=last).map(|n| n as f64 * step).collect() }
    };
    let ((left, upper), (right, lower)) =
        (units((LEFT, TOP)), units((LEFT + paper.size.0, TOP + paper.size.1)));
    let frame = Frame { across: (left, right), down: (upper, lower), x: along(0), y: along(1) };
    let words = |value: f64| number(value, step);
    frame.draw(sheet, Some(&words), &words);
    let upwards = Style { face: Face::Upwards, ..style(SIZE, BLACK, Anchor::Middle) };
    sheet.text("Y (mm)", (18.0, TOP + paper.size.1 / 2.0), upwards);
    let at = (LEFT + paper.size.0 / 2.0, TOP + paper.size.1 + 40.0);
    sheet.text("X (mm)", at, style(SIZE, BLACK, Anchor::Middle));
}

/// The box around the way: a grid on its floor, and marks along three of its edges.
fn box_frame(sheet: &mut Sheet, paper: &Paper, extent: &Extent) {
    let (low, high) = (extent.low, extent.high);
    let iso = |p: [f64; 3]| paper.at(project(View::Isometric, p));
    let grid = Ink { color: GRID, width: 0.8, dash: &[] };
    let edge = Ink { color: "#888888", width: 1.0, dash: &[] };
    // A mark of an edge needs room for its number.
    let along = |i: usize| {
        let mut end = low;
        end[i] = high[i];
        let (a, b) = (iso(low), iso(end));
        let most = (a.0 - b.0).hypot(a.1 - b.1) / 28.0;
        if high[i] - low[i] < 1e-9 {
            (vec![low[i]], 1.0)
        } else if most < 2.0 {
            // The ends alone; with as many digits as they need, three at most.
            let whole = |digits: f64| [low[i], high[i]].iter().all(|v| (v * digits).fract().abs() < 1e-6);
            let digits = [1.0, 10.0, 100.0].into_iter().find(|digits| whole(*digits)).unwrap_or(1000.0);
            (if most > 0.6 { vec![low[i], high[i]] } else { vec![low[i]] }, 1.0 / digits)
        } else {
            marks(low[i], high[i], (most as usize).min(10))
        }
    };
    let ((xs, x_step), (ys, y_step), (zs, z_step)) = (along(0), along(1), along(2));
    let line = |a: [f64; 3], b: [f64; 3]| vec![units(iso(a)), units(iso(b))];
    let floor = low[2];
    let mut pieces: Vec<_> = xs.iter().map(|x| line([*x, low[1], floor], [*x, high[1], floor])).collect();
    pieces.extend(ys.iter().map(|y| line([low[0], *y, floor], [high[0], *y, floor])));
    sheet.curve("grid", grid, &pieces);
    let (a, b, c, d) = (
        [low[0], low[1], floor],
        [high[0], low[1], floor],
        [high[0], high[1], floor],
        [low[0], high[1], floor],
    );
    let top = [low[0], low[1], high[2]];
    sheet.curve("edge", edge, &[line(a, b), line(b, c), line(c, d), line(d, a), line(a, top)]);
    let mut text = |words: &str, at: (f64, f64), anchor| sheet.text(words, at, style(11.0, BLACK, anchor));
    for x in &xs {
        let at = iso([*x, low[1], floor]);
        text(&number(*x, x_step), (at.0 - 5.0, at.1 + 9.0), Anchor::Right);
    }
    for y in &ys {
        let at = iso([high[0], *y, floor]);
        text(&number(*y, y_step), (at.0 + 5.0, at.1 + 9.0), Anchor::Left);
    }
    for z in &zs {
        let at = iso([low[0], low[1], *z]);
        text(&number(*z, z_step), (at.0 - 7.0, at.1 - 2.0), Anchor::Right);
    }
    let middle = |i: usize, of: [f64; 3]| {
        let mut at = of;
        at[i] = (low[i] + high[i]) / 2.0;
        iso(at)
    };
    let (x, y, z) = (middle(0, a), middle(1, b), middle(2, a));
    text("X (mm)", (x.0 - 34.0, x.1 + 34.0), Anchor::Right);
    text("Y (mm)", (y.0 + 34.0, y.1 + 34.0), Anchor::Left);
    text("Z (mm)", (z.0 - 44.0, z.1), Anchor::Right);
}

/// The legs, kind by kind.
fn lines(sheet: &mut Sheet, record: &Record, view: View, paper: &Paper, one: Option<Ink>) {
    for stroke in Stroke::DRAWN {
        let line = ink::stroke(stroke);
        let line = match one {
            Some(pair) => {
                let width = pair.width.min(if stroke == Stroke::Rapid { 1.6 } else { 3.0 });
                Ink { dash: line.dash, width, ..pair }
            }
            // Where lines lie close, hairs show more.
            None if record.way.legs.len() > CLOSE => Ink { width: line.width * 0.4, ..line },
            None => line,
        };
        sheet.curve(stroke.name(), line, &pieces(&record.way, stroke, |p| paper.at(project(view, p))));
    }
}

/// The connected pieces of one kind of leg, in units of the page.
fn pieces(way: &Way, stroke: Stroke, place: impl Fn([f64; 3]) -> (f64, f64)) -> Vec<Vec<(i32, i32)>> {
    let mut pieces: Vec<Vec<(i32, i32)>> = Vec::new();
    let Some(mut from) = way.start.map(|start| units(place(start))) else { return pieces };
    let mut open = false;
    let mut seen = HashSet::new();
    for leg in &way.legs {
        let to = units(place(leg.to));
        // Two dashed lines over each other look like a whole one.
        let again =
            stroke == Stroke::Rapid && leg.stroke == stroke && !seen.insert((from.min(to), from.max(to)));
        if leg.stroke == stroke && !again {
            match pieces.last_mut() {
                Some(piece) if open => piece.push(to),
                Some(_) | None => pieces.push(vec![from, to]),
            }
        }
        open = leg.stroke == stroke && !again;
        from = to;
    }
    pieces
}

/// Holes, start and end.
fn symbols(sheet: &mut Sheet, record: &Record, view: View, paper: &Paper, one: Option<Ink>) {
    let color = |own: &'static str| one.map_or(own, |ink| ink.color);
    let many = record.holes.len() > 400;
    let hole = Ink { color: color("#a03c00"), width: if many { 0.7 } else { 1.2 }, dash: &[] };
    let radius = if many { 2.5 } else { 4.5 };
    let mut d = String::new();
    for hole in &record.holes {
        circle(&mut d, paper.at(project(view, hole.at)), radius);
    }
    if !d.is_empty() {
        sheet.path("holes", hole, "none", &d);
    }
    if let Some(start) = record.way.start {
        let ink = Ink { color: color("#000000"), width: 1.6, dash: &[] };
        sheet.path("start", ink, "none", &diamond(paper.at(project(view, start)), 8.0));
        if let Some(end) = record.way.here() {
            sheet.path("end", ink, color("#000000"), &square(paper.at(project(view, end)), 3.5));
        }
    }
}

fn circle(d: &mut String, at: (f64, f64), radius: f64) {
    let ((x, y), r) = (units((at.0 - radius, at.1)), (radius * f64::from(UNIT)) as i32);
    let _ = write!(d, "M{x} {y}a{r} {r} 0 1 0 {} 0a{r} {r} 0 1 0 -{} 0", 2 * r, 2 * r);
}

fn diamond(at: (f64, f64), radius: f64) -> String {
    let ((x, y), r) = (units((at.0, at.1 - radius)), (radius * f64::from(UNIT)) as i32);
    format!("M{x} {y}l{r} {r} -{r} {r} -{r} -{r}z")
}

fn square(at: (f64, f64), radius: f64) -> String {
    let ((x, y), side) = (units((at.0 - radius, at.1 - radius)), (2.0 * radius * f64::from(UNIT)) as i32);
    format!("M{x} {y}h{side}v{side}h-{side}z")
}

/// What the lines and symbols mean: those that occur.
fn legend(sheet: &mut Sheet, records: &[&Record], left: f64) {
    let mut top = TOP + 12.0;
    let text = |sheet: &mut Sheet, words: &str, top: f64| {
        sheet.text(&cut(words, SIZE, RIGHT - 62.0), (left + 38.0, top), style(SIZE, BLACK, Anchor::Left));
    };
    let sample = |top: f64| vec![units((left, top)), units((left + 30.0, top))];
    let occurs =
        |stroke: Stroke| records.iter().any(|record| record.way.legs.iter().any(|leg| leg.stroke == stroke));
    let black = Ink { color: "#000000", width: 1.6, dash: &[] };
    match records {
        [_, _] => {
            for (record, ink) in records.iter().zip(PAIR) {
                let width = ink.width.min(3.0);
                sheet.curve("key", Ink { width, ..ink }, &[sample(top)]);
                text(sheet, &record.name, top);
                top += 20.0;
            }
            sheet.curve(
                "key",
                Ink { width: 1.2, dash: ink::stroke(Stroke::Rapid).dash, ..black },
                &[sample(top)],
            );
            text(sheet, "rapid", top);
            top += 20.0;
        }
        _ => {
            for stroke in Stroke::DRAWN.into_iter().filter(|stroke| occurs(*stroke)) {
                sheet.curve("key", ink::stroke(stroke), &[sample(top)]);
                if stroke == Stroke::Hole {
                    let mut d = String::new();
                    circle(&mut d, (left + 15.0, top), 4.5);
                    sheet.path("key", ink::stroke(stroke), "none", &d);
                }
                text(sheet, stroke.name(), top);
                top += 20.0;
            }
        }
    }
    if records.iter().any(|record| record.way.start.is_some()) {
        sheet.path("key", black, "none", &diamond((left + 15.0, top), 8.0));
        text(sheet, "start", top);
        top += 20.0;
        sheet.path("key", black, "#000000", &square((left + 15.0, top), 3.5));
        text(sheet, "end", top);
        top += 20.0;
    } else {
        text(sheet, "no moves", top);
        top += 20.0;
    }
    let off = records.iter().map(|record| record.way.off).fold(0.0, f64::max);
    if off > 0.0 {
        let words = format!("true to {} mm", number(off, off));
        debug_assert!(about_wide(&words, SIZE) < RIGHT);
        sheet.text(&words, (left, top), style(11.0, GREY, Anchor::Left));
    }
}
