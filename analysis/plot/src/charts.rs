//! Charts over time, one below the other with one axis of time.

use crate::frame::{Axis, Frame};
use crate::ink::{self, BLACK, CURVE, GREY, Ink, PAIR};
use crate::record::Record;
use crate::series::Series;
use crate::sheet::{Anchor, Face, Sheet, Style, UNIT, about_wide, cut, units};
use crate::ticks::{clock, clock_marks, duration, in_seconds, marks, number, power_marks};

/// What a chart shows over time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chart {
    /// Speed of the spindle.
    Speed,
    /// Tool in the spindle.
    Tool,
    /// Rate of the moves.
    Feed,
    /// Where the axes are.
    Position,
}

impl Chart {
    /// All, from top to bottom.
    pub const ALL: [Chart; 4] = [Chart::Speed, Chart::Tool, Chart::Feed, Chart::Position];

    /// Its name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Chart::Speed => "speed",
            Chart::Tool => "tool",
            Chart::Feed => "feed",
            Chart::Position => "position",
        }
    }
}

const WIDTH: f64 = 1000.0;
const LEFT: f64 = 92.0;
const RIGHT: f64 = 64.0;
const TOP: f64 = 66.0;
const BOTTOM: f64 = 58.0;
const GAP: f64 = 16.0;
/// Size of most texts, pixels.
const SIZE: f64 = 12.0;
/// From so many points on, curves are hairs.
const CLOSE: usize = 2500;

/// One frame of the page.
struct Panel<'r> {
    title: String,
    height: f64,
    show: Show<'r>,
}

enum Show<'r> {
    /// Curves of one program with their names, or one curve of each program.
    Curves { curves: Vec<(String, Ink, &'r Series)>, powers: bool },
    /// Which tool is in, by program.
    Tools(&'r [&'r Record]),
    /// How much later the second program is than the first.
    Later(Vec<(f64, f64)>),
}

/// Charts of one program, or of two over each other, as SVG. A caption says what they are of: the
/// machine, the model, what is assumed.
pub fn charts(records: &[&Record], which: &[Chart], caption: &str) -> String {
    let panels = panels(records, which);
    let all: f64 = panels.iter().map(|panel| panel.height + GAP).sum();
    let keys = if records.len() > 1 { 20.0 } else { 0.0 };
    let height = TOP + keys + all - GAP + BOTTOM;
    let begin = records.iter().map(|record| record.begin).fold(f64::INFINITY, f64::min);
    let end = records.iter().map(|record| record.end).fold(0.0, f64::max);
    let begin = if begin.is_finite() { begin } else { 0.0 };
    // A program that takes no time still has an axis.
    let span = (begin, if end > begin { end } else { begin + 1.0 });
    let mut sheet = Sheet::new(WIDTH as i32, height.ceil() as i32);
    heading(&mut sheet, records, caption);
    let mut top = TOP + keys;
    for (i, panel) in panels.iter().enumerate() {
        draw(&mut sheet, panel, top, span, i + 1 == panels.len());
        top += panel.height + GAP;
    }
    sheet.finish()
}

/// Looks of a level text.
fn style(size: f64, color: &'static str, anchor: Anchor) -> Style {
    Style { size, color, anchor, face: Face::Plain }
}

fn heading(sheet: &mut Sheet, records: &[&Record], caption: &str) {
    let names: Vec<&str> = records.iter().map(|record| record.name.as_str()).collect();
    let title = cut(&names.join(" and "), 17.0, WIDTH - 40.0);
    sheet.text(&title, (20.0, 22.0), Style { face: Face::Bold, ..style(17.0, BLACK, Anchor::Left) });
    let long = match records {
        [one] => format!("{} \u{b7} {caption}", duration(one.end - one.begin)),
        _ => caption.to_owned(),
    };
    sheet.text(&cut(&long, SIZE, WIDTH - 40.0), (20.0, 44.0), style(SIZE, GREY, Anchor::Left));
    let [a, b] = records else { return };
    let mut at = 20.0;
    for (record, ink) in [a, b].into_iter().zip(PAIR) {
        let text = format!("{}: {}", cut(&record.name, SIZE, 260.0), duration(record.end - record.begin));
        sheet.curve("key", ink, &[vec![units((at, 66.0)), units((at + 28.0, 66.0))]]);
        sheet.text(&text, (at + 35.0, 66.0), style(SIZE, BLACK, Anchor::Left));
        at += 60.0 + about_wide(&text, SIZE);
    }
    let later = (b.end - b.begin) - (a.end - a.begin);
    let long = duration(later.abs());
    // What is not seen in the digits has no sign.
    let sign = match later {
        _ if long == duration(0.0) => "",
        ..0.0 => "\u{2212}",
        _ => "+",
    };
    let text = format!("difference {sign}{long}");
    sheet.text(&text, (at, 66.0), style(SIZE, BLACK, Anchor::Left));
}

fn panels<'r>(records: &'r [&'r Record], which: &[Chart]) -> Vec<Panel<'r>> {
    let one = |title: &str, height: f64, of: &dyn Fn(&'r Record) -> &'r Series| Panel {
        title: title.to_owned(),
        height,
        show: Show::Curves {
            curves: match records {
                [only] => vec![(String::new(), CURVE, of(only))],
                _ => records.iter().zip(PAIR).map(|(r, ink)| (String::new(), ink, of(r))).collect(),
            },
            powers: false,
        },
    };
    let mut panels = Vec::new();
    for chart in which {
        match chart {
            Chart::Speed => panels.push(one("Spindle (rev/min)", 140.0, &|r| &r.speed)),
            Chart::Tool => {
                let rows = rows(records).len().max(1) as f64;
                let height = (rows * 24.0 + 8.0).clamp(56.0, 300.0);
                panels.push(Panel { title: "Tool".to_owned(), height, show: Show::Tools(records) });
            }
            Chart::Feed => {
                let mut panel = one("", 160.0, &|r| &r.feed);
                if let Show::Curves { curves, powers } = &mut panel.show {
                    *powers = wants_powers(curves);
                    let log = if *powers { ", log" } else { "" };
                    panel.title = format!("Feed ({}{log})", feed_unit(records.iter().copied()));
                }
                panels.push(panel);
            }
            Chart::Position => positions(records, &one, &mut panels),
        }
    }
    if let [a, b] = records
        && let Some(later) = later(a, b)
    {
        panels.push(Panel { title: "Later by (s)".to_owned(), height: 110.0, show: Show::Later(later) });
    }
    panels
}

type One<'r, 'f> = dyn Fn(&str, f64, &dyn Fn(&'r Record) -> &'r Series) -> Panel<'r> + 'f;

fn positions<'r>(records: &'r [&'r Record], one: &One<'r, '_>, panels: &mut Vec<Panel<'r>>) {
    const LETTERS: [&str; 6] = ["X", "Y", "Z", "A", "B", "C"];
    let moved = |axis: usize| records.iter().any(|record| record.moved[axis]);
    for (axes, unit) in [([0, 1, 2], "mm"), ([3, 4, 5], "\u{b0}")] {
        let shown: Vec<usize> = axes.into_iter().filter(|axis| *axis < 3 || moved(*axis)).collect();
        match records {
            _ if shown.is_empty() => {}
            [only] => {
                let curve = |axis: usize| (LETTERS[axis].to_owned(), ink::axis(axis), &only.axes[axis]);
                let curves = shown.into_iter().map(curve).collect();
                panels.push(Panel {
                    title: format!("Position ({unit})"),
                    height: if unit == "mm" { 230.0 } else { 140.0 },
                    show: Show::Curves { curves, powers: false },
                });
            }
            _ => {
                for axis in shown {
                    let title = format!("{} ({unit})", LETTERS[axis]);
                    panels.push(one(&title, 120.0, &|r| &r.axes[axis]));
                }
            }
        }
    }
}

/// The unit of the rates along the path.
pub(crate) fn feed_unit<'r>(records: impl IntoIterator<Item = &'r Record>) -> &'static str {
    let rates = records.into_iter().fold([false; 2], |all, r| [all[0] | r.rates[0], all[1] | r.rates[1]]);
    match rates {
        [false, true] => "\u{b0}/min",
        [true, true] => "mm/min, \u{b0}/min",
        [_, false] => "mm/min",
    }
}

/// How much later the second program has done the same number of moves; `None` where they do not make
/// the same number.
pub fn later(a: &Record, b: &Record) -> Option<Vec<(f64, f64)>> {
    if a.sums.moves != b.sums.moves {
        return None;
    }
    let (mut x, mut y) = (a.stamps.clone(), b.stamps.clone());
    while x.every < y.every {
        x.widen();
    }
    while y.every < x.every {
        y.widen();
    }
    let ends = (a.end, (b.end - b.begin) - (a.end - a.begin));
    let moves = x.times.iter().zip(&y.times).map(|(s, t)| (*s, (t - b.begin) - (s - a.begin)));
    Some(moves.chain([ends]).collect())
}

/// Whether rates differ so much that the small ones would lie on the axis.
fn wants_powers(curves: &[(String, Ink, &Series)]) -> bool {
    let (least, most) = above_zero(curves);
    most > 20.0 * least
}

/// Least and greatest value above 0; an infinite and no one where there is none.
fn above_zero(curves: &[(String, Ink, &Series)]) -> (f64, f64) {
    let values = curves.iter().flat_map(|curve| curve.2.polyline(0.0));
    let values = values.map(|point| point.1).filter(|value| *value > 0.0);
    values.fold((f64::INFINITY, 0.0), |(least, most), v| (least.min(v), most.max(v)))
}

/// Tools in the order in which they come first.
fn rows(records: &[&Record]) -> Vec<i64> {
    let mut rows = Vec::new();
    for stretch in records.iter().flat_map(|record| &record.tools) {
        if stretch.end > stretch.start && !rows.contains(&stretch.tool) {
            rows.push(stretch.tool);
        }
    }
    rows
}

/// The name of a tool.
pub(crate) fn tool_name(tool: i64) -> String {
    if tool < 0 { "first".to_owned() } else { format!("T{tool}") }
}

fn draw(sheet: &mut Sheet, panel: &Panel<'_>, top: f64, span: (f64, f64), last: bool) {
    let across = WIDTH - LEFT - RIGHT;
    let scale = Scale::of(panel);
    let (x_marks, x_step) = clock_marks(span.0, span.1, 10);
    let long = span.1;
    let ((left, upper), (right, lower)) = (units((LEFT, top)), units((WIDTH - RIGHT, top + panel.height)));
    let frame = Frame {
        across: (left, right),
        down: (upper, lower),
        x: Axis { low: span.0, high: span.1, marks: x_marks },
        y: Axis { low: scale.low, high: scale.high, marks: scale.marks.clone() },
    };
    let times = |value: f64| clock(value, x_step, long);
    // All frames have one axis of time, below the last.
    frame.draw(sheet, if last { Some(&times) } else { None }, &|value| scale.words(value));
    let upwards = Style { face: Face::Upwards, ..style(SIZE, BLACK, Anchor::Middle) };
    sheet.text(&panel.title, (18.0, top + panel.height / 2.0), upwards);
    if last {
        let unit = if in_seconds(long) { "Time (s)" } else { "Time (h:mm:ss)" };
        let at = (LEFT + across / 2.0, top + panel.height + 40.0);
        sheet.text(unit, at, style(SIZE, BLACK, Anchor::Middle));
    }
    match &panel.show {
        Show::Curves { curves, .. } => {
            for (i, (name, ink, series)) in curves.iter().enumerate() {
                let line = series.polyline(span.1.min(series_end(series, span.1)));
                let place = |&(time, value): &(f64, f64)| frame.place((time, scale.at(value)));
                let class = if name.is_empty() { format!("curve p{i}") } else { format!("curve {name}") };
                // Where a curve goes up and down in every pixel, a hair shows more.
                let width = if line.len() > CLOSE { ink.width * 0.5 } else { ink.width };
                sheet.curve(&class, Ink { width, ..*ink }, &[line.iter().map(place).collect()]);
                if !name.is_empty() {
                    let y = top + 14.0 + 18.0 * i as f64;
                    let x = WIDTH - RIGHT + 10.0;
                    sheet.curve("key", *ink, &[vec![units((x, y)), units((x + 26.0, y))]]);
                    sheet.text(name, (x + 32.0, y), style(SIZE, BLACK, Anchor::Left));
                }
            }
        }
        Show::Tools(records) => tools(sheet, &frame, records, &scale, span),
        Show::Later(line) => {
            let place = |&(time, value): &(f64, f64)| frame.place((time, value));
            sheet.curve("curve later", CURVE, &[line.iter().map(place).collect()]);
        }
    }
}

/// When a curve ends: its program's end, where that is before the other's.
fn series_end(series: &Series, end: f64) -> f64 {
    series.end().unwrap_or(end)
}

fn tools(sheet: &mut Sheet, frame: &Frame, records: &[&Record], scale: &Scale, span: (f64, f64)) {
    let pixel = (WIDTH - LEFT - RIGHT) / (span.1 - span.0);
    let count = records.len() as f64;
    for (n, record) in records.iter().enumerate() {
        let color = if records.len() == 1 { CURVE.color } else { PAIR[n].color };
        for stretch in &record.tools {
            let Some(row) = scale.tools.iter().position(|tool| *tool == stretch.tool) else { continue };
            if stretch.end <= stretch.start {
                continue;
            }
            let slot = 0.76 / count;
            let high = (scale.tools.len() - row) as f64 - 0.12 - n as f64 * slot;
            // At least a pixel, or a short one would not be seen.
            let least = 1.0 / pixel;
            let right = stretch.end.max(stretch.start + least).min(span.1.max(stretch.start + least));
            let (from, to) = (frame.place((stretch.start, high)), frame.place((right, high - slot)));
            sheet.bar("tool", from, to, color);
            let text = duration(stretch.end - stretch.start);
            let wide = (stretch.end - stretch.start) * pixel;
            if records.len() == 1 && wide > about_wide(&text, 11.0) + 12.0 && scale.tools.len() <= 12 {
                let at = frame.place(((stretch.start + right) / 2.0, high - slot / 2.0));
                let at = (f64::from(at.0) / f64::from(UNIT), f64::from(at.1) / f64::from(UNIT));
                sheet.text(&text, at, style(11.0, "#ffffff", Anchor::Middle));
            }
        }
    }
}

/// The upright axis of a panel.
struct Scale {
    low: f64,
    high: f64,
    marks: Vec<f64>,
    step: f64,
    powers: bool,
    tools: Vec<i64>,
}

impl Scale {
    fn of(panel: &Panel<'_>) -> Scale {
        let most = (panel.height / 28.0).max(2.0) as usize;
        match &panel.show {
            Show::Curves { curves, powers: true } => {
                let (least, greatest) = above_zero(curves);
                let (low, high) = (least / 1.6, greatest * 1.25);
                let mut marks: Vec<f64> =
                    power_marks(low * 1.3, high, most).into_iter().map(f64::log10).collect();
                // At the bottom lies what is not above 0.
                marks.push(low.log10());
                Scale { low: low.log10(), high: high.log10(), marks, step: 1.0, powers: true, tools: vec![] }
            }
            Show::Curves { curves, powers: false } => {
                let ranges = curves.iter().filter_map(|curve| curve.2.range());
                let range = ranges.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
                Scale::linear(range.unwrap_or_default(), most)
            }
            Show::Later(line) => {
                let ends = line.iter().map(|point| (point.1, point.1));
                let range = ends.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
                let (low, high) = range.unwrap_or_default();
                // What binary numbers are off is no difference.
                let least = (high - low).max(0.01) / 2.0;
                Scale::linear((low.min(-least), high.max(least)), most)
            }
            Show::Tools(records) => {
                let tools = rows(records);
                let all = tools.len().max(1);
                let every = all.div_ceil((panel.height / 15.0) as usize).max(1);
                let rows = (0..tools.len()).step_by(every);
                Scale {
                    low: 0.0,
                    high: all as f64,
                    marks: rows.map(|row| (all - row) as f64 - 0.5).collect(),
                    step: 1.0,
                    powers: false,
                    tools,
                }
            }
        }
    }

    fn linear((low, high): (f64, f64), most: usize) -> Scale {
        // A value that never changes lies in the middle; a step is not drawn on the frame.
        let room = if high > low { (high - low) * 0.08 } else { high.abs().max(1.0) * 0.5 };
        let floor = if low == 0.0 { 0.0 } else { low - room };
        let (low, high) = (floor, high + room);
        let (marks, step) = marks(low, high, most);
        Scale { low, high, marks, step, powers: false, tools: Vec::new() }
    }

    /// Where a value lies.
    fn at(&self, value: f64) -> f64 {
        match self.powers {
            true if value > 0.0 => value.log10().max(self.low),
            true => self.low,
            false => value,
        }
    }

    /// What a mark says.
    fn words(&self, mark: f64) -> String {
        if let Some(tool) = self.tools.get((self.high - mark) as usize) {
            return tool_name(*tool);
        }
        match self.powers {
            true if mark <= self.low => number(0.0, 1.0),
            true => number(10f64.powf(mark), 10f64.powf(mark.floor())),
            false => number(mark, self.step),
        }
    }
}
