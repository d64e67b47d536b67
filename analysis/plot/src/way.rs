//! The tool path, in memory that does not grow with the program.
//!
//! A leg is a straight piece of it, in the program's coordinates. Once there are more of them than
//! [`MOST`], legs that one line replaces within half a pixel become one, and if that is not enough,
//! legs that lie wholly where others of their kind have drawn already, to half a pixel, are no longer
//! drawn. What a pixel is follows from the extent so far; only where even that leaves too many does it
//! grow, and [`Way::off`] says so.

use crate::project::{View, project};

/// Legs that are kept at most.
pub const MOST: usize = 1 << 17;
/// Pixels of the longer side of a picture.
const PIXELS: f64 = 1000.0;
/// Legs that are simplified in one go.
const RUN: usize = 1024;

/// What a leg is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stroke {
    /// Rapid.
    Rapid,
    /// Straight at feed.
    Feed,
    /// A chord of an arc.
    Arc,
    /// In a hole.
    Hole,
    /// The tool stands; time passes.
    Still,
    /// Not drawn: the coordinates change and not the machine, or others of its kind hide it.
    Unseen,
}

impl Stroke {
    /// Those that are drawn, in the order in which they are: what is above comes last.
    pub const DRAWN: [Stroke; 4] = [Stroke::Rapid, Stroke::Feed, Stroke::Arc, Stroke::Hole];

    /// Whether it leaves a line.
    pub fn is_drawn(self) -> bool {
        Stroke::DRAWN.contains(&self)
    }

    /// Its name in pictures.
    pub fn name(self) -> &'static str {
        match self {
            Stroke::Rapid => "rapid",
            Stroke::Feed => "feed",
            Stroke::Arc => "arc",
            Stroke::Hole => "hole",
            Stroke::Still => "still",
            Stroke::Unseen => "unseen",
        }
    }
}

/// A straight piece of the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// What it is.
    pub stroke: Stroke,
    /// Where it ends, X Y Z in mm.
    pub to: [f64; 3],
    /// When it ends, seconds.
    pub end: f64,
    /// First and last line of the source that it comes from; 0 if not known.
    pub lines: [u32; 2],
}

/// The way.
#[derive(Clone, Debug, Default)]
pub struct Way {
    /// Where it begins; `None` if there is no move.
    pub start: Option<[f64; 3]>,
    /// Its legs.
    pub legs: Vec<Leg>,
    /// Least and greatest coordinates.
    pub extent: Extent,
    /// How far a line that is drawn may be from the full way, mm; 0 if it is the full way.
    pub off: f64,
    pixel: f64,
    /// What simplified lines may be off, mm.
    spent: f64,
    /// Legs that are simplified to this pixel already.
    settled: usize,
}

/// Least and greatest coordinates X Y Z, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Least.
    pub low: [f64; 3],
    /// Greatest.
    pub high: [f64; 3],
}

impl Default for Extent {
    fn default() -> Extent {
        Extent { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] }
    }
}

impl Extent {
    /// Takes a point in.
    pub fn add(&mut self, point: [f64; 3]) {
        self.low = std::array::from_fn(|i| self.low[i].min(point[i]));
        self.high = std::array::from_fn(|i| self.high[i].max(point[i]));
    }

    /// Whether no point is in it.
    pub fn is_empty(&self) -> bool {
        self.low[0] > self.high[0]
    }

    /// The longest side.
    fn longest(&self) -> f64 {
        (0..3).map(|i| self.high[i] - self.low[i]).fold(0.0, f64::max)
    }

    /// The corners.
    pub fn corners(&self) -> [[f64; 3]; 8] {
        std::array::from_fn(|n| {
            std::array::from_fn(|i| if n >> i & 1 == 0 { self.low[i] } else { self.high[i] })
        })
    }
}

impl Way {
    /// The tool is somewhere, and no leg leads there.
    pub fn stand(&mut self, at: [f64; 3], time: f64, line: u32) {
        self.extent.add(at);
        match (self.start, self.here()) {
            (None, _) => self.start = Some(at),
            (Some(_), Some(here)) if here == at => {}
            (Some(_), _) => {
                self.add(Leg { stroke: Stroke::Unseen, to: at, end: time, lines: [line; 2] });
            }
        }
    }

    /// Where the tool is.
    pub fn here(&self) -> Option<[f64; 3]> {
        self.legs.last().map(|leg| leg.to).or(self.start)
    }

    /// The next leg.
    pub fn add(&mut self, leg: Leg) {
        self.extent.add(leg.to);
        self.legs.push(leg);
        if self.legs.len() >= 2 * MOST {
            self.reduce(MOST);
        }
    }

    /// The way is over.
    pub fn finish(&mut self) {
        if self.legs.len() > MOST / 4 * 3 {
            self.reduce(MOST / 4 * 3);
        }
    }

    /// Brings the legs down to a number.
    fn reduce(&mut self, most: usize) {
        let shown = (self.extent.longest() / PIXELS).max(1e-6);
        if self.pixel == 0.0 {
            self.grow(shown);
        }
        loop {
            self.legs = simplify(self.start, &self.legs, self.settled, self.pixel / 4.0);
            self.off = self.spent;
            if self.legs.len() > most {
                let cell = self.pixel.max(shown) / 2.0;
                self.legs = hide(self.start, &self.legs, self.extent, cell);
                self.off = self.spent + cell;
            }
            self.settled = self.legs.len();
            if self.legs.len() <= most {
                return;
            }
            // To the pixel that would be chosen now, else by as little as helps.
            self.grow(shown.clamp(self.pixel * 1.25, self.pixel * 2.0));
        }
    }

    /// Takes a larger pixel. Lines that are simplified once more may leave the way by what they had left
    /// it before and a quarter of the new pixel.
    fn grow(&mut self, pixel: f64) {
        self.pixel = pixel;
        self.spent += pixel / 4.0;
        self.settled = 0;
    }
}

/// Replaces legs of one kind by lines that are never farther from them than `off`; those before
/// `settled` stay.
pub fn simplify(start: Option<[f64; 3]>, legs: &[Leg], settled: usize, off: f64) -> Vec<Leg> {
    let mut out = legs[..settled].to_vec();
    let mut from = out.last().map(|leg| leg.to).or(start).unwrap_or_default();
    let mut rest = &legs[settled..];
    while let Some(first) = rest.first() {
        let run = rest.iter().take(RUN).take_while(|leg| leg.stroke == first.stroke).count();
        let (these, after) = rest.split_at(run);
        let last = these[run - 1];
        if first.stroke.is_drawn() {
            straighten(from, these, off, &mut out);
        } else {
            out.push(Leg { lines: [first.lines[0], last.lines[1]], ..last });
        }
        from = last.to;
        rest = after;
    }
    out
}

/// Douglas and Peucker's way: a line from end to end is good, or the farthest point divides it.
fn straighten(from: [f64; 3], legs: &[Leg], off: f64, out: &mut Vec<Leg>) {
    let mut todo = vec![(from, legs)];
    while let Some((from, legs)) = todo.pop() {
        let Some((last, inner)) = legs.split_last() else { continue };
        let far = inner.iter().map(|leg| distance(leg.to, from, last.to));
        let farthest = far.enumerate().fold((0, off), |most, now| if now.1 > most.1 { now } else { most });
        if farthest.1 > off {
            let (a, b) = legs.split_at(farthest.0 + 1);
            todo.push((a[a.len() - 1].to, b));
            todo.push((from, a));
        } else {
            out.push(Leg { lines: [legs[0].lines[0], last.lines[1]], ..*last });
        }
    }
}

/// Distance of a point to a straight piece.
pub fn distance(point: [f64; 3], from: [f64; 3], to: [f64; 3]) -> f64 {
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (along, arm) = (minus(to, from), minus(point, from));
    let length = dot(along, along);
    let at = if length > 0.0 { (dot(arm, along) / length).clamp(0.0, 1.0) } else { 0.0 };
    let rest: [f64; 3] = std::array::from_fn(|i| arm[i] - at * along[i]);
    dot(rest, rest).sqrt()
}

/// Takes legs out of the picture that lie, in both views, where others of their kind have drawn.
fn hide(start: Option<[f64; 3]>, legs: &[Leg], extent: Extent, pixel: f64) -> Vec<Leg> {
    let mut sheets: Vec<Sheet> = Vec::new();
    for _ in Stroke::DRAWN {
        sheets.extend([View::Plan, View::Isometric].map(|view| Sheet::new(view, extent, pixel)));
    }
    let mut out: Vec<Leg> = Vec::new();
    let mut from = start.unwrap_or_default();
    for leg in legs {
        let mut leg = *leg;
        if let Some(at) = Stroke::DRAWN.iter().position(|stroke| *stroke == leg.stroke) {
            // Both sheets have to be inked, so no short cut.
            let new = sheets[2 * at].ink(from, leg.to) | sheets[2 * at + 1].ink(from, leg.to);
            if !new {
                leg.stroke = Stroke::Unseen;
            }
        }
        from = leg.to;
        match out.last_mut() {
            Some(last) if last.stroke == Stroke::Unseen && !leg.stroke.is_drawn() => {
                *last = Leg { lines: [last.lines[0], leg.lines[1]], stroke: Stroke::Unseen, ..leg };
            }
            Some(_) | None => out.push(leg),
        }
    }
    out
}

/// Which pixels of a view are inked.
struct Sheet {
    view: View,
    low: [f64; 2],
    pixel: f64,
    wide: usize,
    bits: Vec<u64>,
}

impl Sheet {
    fn new(view: View, extent: Extent, pixel: f64) -> Sheet {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for corner in extent.corners() {
            let p = project(view, corner);
            for i in 0..2 {
                low[i] = low[i].min(p[i]);
                high[i] = high[i].max(p[i]);
            }
        }
        let size = |i: usize| ((high[i] - low[i]) / pixel) as usize + 2;
        let wide = size(0);
        Sheet { view, low, pixel, wide, bits: vec![0; wide * size(1) / 64 + 1] }
    }

    /// Inks a line; whether a pixel is new.
    fn ink(&mut self, from: [f64; 3], to: [f64; 3]) -> bool {
        let place = |p: [f64; 3]| {
            let p = project(self.view, p);
            [(p[0] - self.low[0]) / self.pixel, (p[1] - self.low[1]) / self.pixel]
        };
        let (a, b) = (place(from), place(to));
        let steps = (2.0 * (b[0] - a[0]).abs().max((b[1] - a[1]).abs())).ceil().max(1.0);
        let mut new = false;
        for step in 0..=steps as usize {
            let part = step as f64 / steps;
            let cell = [0, 1].map(|i| (a[i] + part * (b[i] - a[i])).max(0.0) as usize);
            let at = cell[1] * self.wide + cell[0];
            if let Some(word) = self.bits.get_mut(at / 64) {
                new |= *word >> (at % 64) & 1 == 0;
                *word |= 1 << (at % 64);
            }
        }
        new
    }
}
