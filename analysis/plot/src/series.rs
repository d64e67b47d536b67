//! A value over time, in memory that does not grow with the program.
//!
//! Up to some thousand points are kept as they are. Then time is divided into bins, and of each bin
//! the first, the least, the greatest and the last value are kept: what a column of pixels shows.
//! When the bins no longer reach, two become one. Nothing is drawn here.

/// Points that are kept as they are.
const POINTS: usize = 4096;
/// Bins after that.
const BINS: usize = 2048;
/// Shortest bin, seconds: a program that takes no time at all is one bin.
const SHORTEST: f64 = 1e-6;

/// How a value goes from one point to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Course {
    /// It stays, and jumps when the next one comes.
    Step,
    /// It goes there in a straight line.
    Line,
}

/// A value over time.
#[derive(Clone, Debug)]
pub struct Series {
    course: Course,
    points: Vec<(f64, f64)>,
    bins: Vec<Bin>,
    width: f64,
    last: Option<(f64, f64)>,
    /// Time of the first point, from which bins are counted.
    zero: f64,
}

/// The values of a stretch of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bin {
    /// Value at its start.
    pub first: f64,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// Value at its end.
    pub last: f64,
}

impl Bin {
    fn of(from: f64, to: f64) -> Bin {
        Bin { first: from, min: from.min(to), max: from.max(to), last: to }
    }

    fn and(self, next: Bin) -> Bin {
        Bin { first: self.first, min: self.min.min(next.min), max: self.max.max(next.max), last: next.last }
    }
}

impl Series {
    /// A value of which nothing is known yet.
    pub fn new(course: Course) -> Series {
        Series { course, points: Vec::new(), bins: Vec::new(), width: 0.0, last: None, zero: 0.0 }
    }

    /// The value at a time, seconds; times never decrease. Of several values of a [`Course::Step`] at
    /// one time the last counts: the others last no time.
    pub fn push(&mut self, time: f64, value: f64) {
        if !time.is_finite() || !value.is_finite() {
            return;
        }
        if self.last.is_none() {
            self.zero = time;
        }
        let time = time - self.zero;
        if self.bins.is_empty() {
            self.keep(time, value);
            if self.points.len() > POINTS {
                self.begin_bins();
            }
        } else if let Some(last) = self.last {
            self.spread(last, (time, value));
        }
        self.last = Some((time, value));
    }

    fn keep(&mut self, time: f64, value: f64) {
        match (self.course, self.points.as_mut_slice()) {
            (Course::Step, [.., last]) if last.1 == value => {}
            (Course::Step, [.., last]) if last.0 == time => last.1 = value,
            (Course::Line, [.., last]) if *last == (time, value) => {}
            (Course::Line, [.., before, last]) if before.1 == value && last.1 == value => last.0 = time,
            _ => self.points.push((time, value)),
        }
    }

    fn begin_bins(&mut self) {
        let points = std::mem::take(&mut self.points);
        let end = points.last().map_or(0.0, |point| point.0);
        self.width = (end / BINS as f64).max(SHORTEST);
        let mut points = points.into_iter();
        let Some(mut last) = points.next() else { return };
        for point in points {
            self.spread(last, point);
            last = point;
        }
    }

    /// Puts the way between two points into the bins.
    fn spread(&mut self, from: (f64, f64), to: (f64, f64)) {
        while to.0 >= self.width * BINS as f64 {
            self.halve();
        }
        if self.course == Course::Step {
            if to.0 > from.0 {
                self.cover(from.0, to.0, |_| from.1);
            }
            return;
        }
        let slope = if to.0 > from.0 { (to.1 - from.1) / (to.0 - from.0) } else { 0.0 };
        if to.0 > from.0 {
            let (low, high) = (from.1.min(to.1), from.1.max(to.1));
            self.cover(from.0, to.0, |time| match time {
                t if t >= to.0 => to.1,
                t => (from.1 + slope * (t - from.0)).clamp(low, high),
            });
        } else {
            self.put(self.bin(to.0), Bin::of(from.1, to.1));
        }
    }

    fn cover(&mut self, start: f64, end: f64, value: impl Fn(f64) -> f64) {
        for at in self.bin(start)..=self.bin(end) {
            let left = (at as f64 * self.width).max(start);
            let right = ((at + 1) as f64 * self.width).min(end);
            if left < right {
                self.put(at, Bin::of(value(left), value(right)));
            }
        }
    }

    fn bin(&self, time: f64) -> usize {
        ((time / self.width).max(0.0) as usize).min(BINS - 1)
    }

    fn put(&mut self, at: usize, part: Bin) {
        // A point at the very end of a bin may begin the next one before time goes on.
        while self.bins.len() < at {
            let value = self.bins.last().map_or(part.first, |bin| bin.last);
            self.bins.push(Bin::of(value, value));
        }
        match self.bins.get_mut(at) {
            Some(bin) => *bin = bin.and(part),
            None => self.bins.push(part),
        }
    }

    fn halve(&mut self) {
        let half = self.bins.chunks(2).map(|pair| pair[1..].iter().fold(pair[0], |a, b| a.and(*b)));
        self.bins = half.collect();
        self.width *= 2.0;
    }

    /// The last value; 0 before the first.
    pub fn value(&self) -> f64 {
        self.last.map_or(0.0, |last| last.1)
    }

    /// Time of the last point.
    pub fn end(&self) -> Option<f64> {
        self.last.map(|last| last.0 + self.zero)
    }

    /// The width of a bin in seconds and the bins, from the first time on; none while all points are
    /// kept.
    pub fn bins(&self) -> (f64, &[Bin]) {
        (self.width, &self.bins)
    }

    /// Least and greatest value.
    pub fn range(&self) -> Option<(f64, f64)> {
        let ends = self.points.iter().map(|point| (point.1, point.1));
        let bins = self.bins.iter().map(|bin| (bin.min, bin.max));
        // A step that has only just come is in no bin yet.
        let last = self.last.map(|last| (last.1, last.1));
        ends.chain(bins).chain(last).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }

    /// The curve as a polyline until a time.
    pub fn polyline(&self, end: f64) -> Vec<(f64, f64)> {
        let end = end - self.zero;
        let mut line = Vec::with_capacity(2 * self.points.len() + 4 * self.bins.len() + 1);
        for &(time, value) in &self.points {
            match (self.course, line.last()) {
                (Course::Step, Some(&(_, before))) => line.extend([(time, before), (time, value)]),
                (Course::Step, None) | (Course::Line, _) => line.push((time, value)),
            }
        }
        for (i, bin) in self.bins.iter().enumerate() {
            let (left, right) = (i as f64 * self.width, ((i + 1) as f64 * self.width).min(end));
            let middle = (left + right) / 2.0;
            line.push((left, bin.first));
            if bin.min < bin.first.min(bin.last) || bin.max > bin.first.max(bin.last) {
                // The extreme that the end is farther from comes first, so that little is drawn twice.
                let up = bin.last < bin.first;
                let (one, other) = if up { (bin.max, bin.min) } else { (bin.min, bin.max) };
                line.extend([(middle, one), (middle, other)]);
            }
            line.push((right, bin.last));
        }
        if let Some((_, value)) = self.last {
            line.push((line.last().map_or(0.0, |last| last.0).max(end), value));
        }
        line.dedup();
        for point in &mut line {
            point.0 += self.zero;
        }
        line
    }
}
