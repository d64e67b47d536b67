//! Rounded and chamfered corners: both moves are made to the corner first; when the program is over, what
//! lies between them is found by going back from the corner until a circle of the radius fits.
//!
//! Written from the manuals: the corner is that of a line or an arc at feed and the very next one, in the
//! plane in force; where they are tangent nothing is put in.

use super::{ArcFeed, Event, Halt, Machine, What};

/// What a corner becomes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cut {
    /// An arc of this radius.
    Round(f64),
    /// A line that begins so far before it.
    Leg(f64),
    /// A line so long.
    Long(f64),
}

/// A cut behind an event, in the plane of two axes.
pub(super) type Planned = (usize, Cut, (usize, usize, usize), ArcFeed);

type Flat = (f64, f64);

/// A move in the plane: start, end, and centre with the sense of its arc.
#[derive(Clone, Copy)]
struct Side {
    from: Flat,
    to: Flat,
    about: Option<(Flat, f64)>,
}

impl Side {
    /// Unit direction at a point of it.
    fn direction(&self, at: Flat) -> Flat {
        let (x, y) = match self.about {
            None => (self.to.0 - self.from.0, self.to.1 - self.from.1),
            Some((c, sense)) => (-(at.1 - c.1) * sense, (at.0 - c.0) * sense),
        };
        let length = x.hypot(y);
        (x / length, y / length)
    }

    fn radius(&self) -> f64 {
        self.about.map_or(0.0, |(c, _)| (self.from.0 - c.0).hypot(self.from.1 - c.1))
    }

    /// Length of it between two of its points.
    fn length(&self, from: Flat, to: Flat) -> f64 {
        match self.about {
            None => (to.0 - from.0).hypot(to.1 - from.1),
            Some(_) => self.sweep(from, to).abs().to_radians() * self.radius(),
        }
    }

    /// Degrees from a point to another, as it turns.
    fn sweep(&self, from: Flat, to: Flat) -> f64 {
        let Some((c, sense)) = self.about else { return 0.0 };
        let angle = |p: Flat| (p.1 - c.1).atan2(p.0 - c.0).to_degrees();
        let by = ((angle(to) - angle(from)) * sense).rem_euclid(360.0);
        if by > 359.999_999 { 0.0 } else { by * sense }
    }

    /// So far back from its end.
    fn back(&self, by: f64) -> Flat {
        match self.about {
            None => {
                let d = self.direction(self.to);
                (self.to.0 - d.0 * by, self.to.1 - d.1 * by)
            }
            Some((c, sense)) => {
                let angle = (self.to.1 - c.1).atan2(self.to.0 - c.0) - sense * by / self.radius();
                (c.0 + self.radius() * angle.cos(), c.1 + self.radius() * angle.sin())
            }
        }
    }

    /// How far a point lies to the left of it.
    fn left(&self, p: Flat) -> f64 {
        match self.about {
            None => {
                let d = self.direction(self.from);
                d.0 * (p.1 - self.from.1) - d.1 * (p.0 - self.from.0)
            }
            Some((c, sense)) => (self.radius() - (p.0 - c.0).hypot(p.1 - c.1)) * sense,
        }
    }

    /// The point of it nearest to another.
    fn nearest(&self, p: Flat) -> Flat {
        match self.about {
            None => {
                let d = self.direction(self.from);
                let by = d.0 * (p.0 - self.from.0) + d.1 * (p.1 - self.from.1);
                (self.from.0 + d.0 * by, self.from.1 + d.1 * by)
            }
            Some((c, _)) => {
                let far = (p.0 - c.0).hypot(p.1 - c.1);
                (c.0 + (p.0 - c.0) / far * self.radius(), c.1 + (p.1 - c.1) / far * self.radius())
            }
        }
    }
}

impl Machine {
    /// Makes the corners that the program has asked for.
    ///
    /// # Errors
    /// There is no such corner.
    pub fn with_corners(mut self) -> Result<Machine, Halt> {
        if self.asked.is_some() {
            return self.halt("a corner and no move");
        }
        while let Some((at, cut, axes, arcs)) = self.cuts.pop() {
            self.feeds.arcs = arcs;
            if let Err(why) = self.cut(at, cut, axes) {
                self.line = self.events[at].line;
                return self.halt(why);
            }
        }
        Ok(self)
    }

    fn cut(
        &mut self,
        at: usize,
        cut: Cut,
        (first, second, normal): (usize, usize, usize),
    ) -> Result<(), String> {
        let start = |i: usize| if i == 0 { self.setup.start } else { self.events[i - 1].machine };
        let side = |i: usize| -> Result<Side, String> {
            let event: &Event = self.events.get(i).ok_or("a corner and no next move")?;
            let from = start(i);
            let apart = event.machine.iter().zip(from).map(|(to, from)| (to - from).abs() > 1e-6);
            if apart.enumerate().any(|(axis, apart)| apart && axis != first && axis != second) {
                return Err("a corner of a move that leaves the plane".to_owned());
            }
            let about = match event.what {
                What::Feed => None,
                What::Arc { normal: own, centre, sweep } if own == normal => {
                    Some(((centre[first], centre[second]), sweep.signum()))
                }
                _ => return Err("a corner beside something else than a move at feed".to_owned()),
            };
            let flat = |p: [f64; 6]| (p[first], p[second]);
            Ok(Side { from: flat(from), to: flat(event.machine), about })
        };
        let (a, b) = (side(at)?, side(at + 1)?);
        if self.events[at].feed != self.events[at + 1].feed {
            return Err("a corner between two feeds".to_owned());
        }
        let (u, v) = (a.direction(a.to), b.direction(b.from));
        let turn = (u.0 * v.1 - u.1 * v.0).atan2(u.0 * v.0 + u.1 * v.1);
        if turn.to_degrees().abs() < 0.01 {
            return Ok(());
        }
        let left = turn.signum();
        let (from, to, centre) = match cut {
            Cut::Round(r) => {
                // So far back that a circle beside the first touches the second.
                let middle = |by: f64| {
                    let p = a.back(by);
                    let d = a.direction(p);
                    (p.0 - d.1 * r * left, p.1 + d.0 * r * left)
                };
                let missing = |by: f64| b.left(middle(by)) * left - r;
                // Beside an arc it may fit near the corner and not further back: the first place counts.
                let step = a.length(a.from, a.to) / 10_000.0;
                let first = (1..=10_000).map(|k| f64::from(k) * step).find(|by| missing(*by) >= -1e-6);
                let Some(mut far) = first else {
                    return Err("a rounding that does not fit".to_owned());
                };
                let mut near = far - step;
                for _ in 0..200 {
                    let half = (near + far) / 2.0;
                    if missing(half) < 0.0 {
                        near = half;
                    } else {
                        far = half;
                    }
                }
                (a.back(far), b.nearest(middle(far)), Some(middle(far)))
            }
            Cut::Leg(_) | Cut::Long(_) if a.about.is_some() || b.about.is_some() => {
                return Err("a chamfer beside an arc".to_owned());
            }
            Cut::Leg(leg) => (a.back(leg), (b.from.0 + v.0 * leg, b.from.1 + v.1 * leg), None),
            Cut::Long(long) => {
                let leg = long / 2.0 / (turn / 2.0).cos();
                (a.back(leg), (b.from.0 + v.0 * leg, b.from.1 + v.1 * leg), None)
            }
        };
        let fits = |whole: f64, part: f64| part <= whole + 1e-6;
        if !fits(a.length(a.from, a.to), a.length(from, a.to))
            || !fits(b.length(b.from, b.to), b.length(b.from, to))
        {
            return Err("a corner that does not fit".to_owned());
        }
        let mut inserted = self.events[at].clone();
        let place = |event: &mut Event, p: Flat| {
            for (axis, value) in [(first, p.0), (second, p.1)] {
                event.program[axis] += value - event.machine[axis];
                event.machine[axis] = value;
            }
        };
        place(&mut inserted, to);
        inserted.what = match centre {
            None => What::Feed,
            Some(c) => {
                let arc = Side { from, to, about: Some((c, left)) };
                let mut centre = [0.0; 3];
                (centre[first], centre[second]) = c;
                centre[normal] = inserted.machine[normal];
                What::Arc { normal, centre, sweep: arc.sweep(from, to) }
            }
        };
        // The tool is beside the corner as it was beside the move before it.
        inserted.beside = self.fed(inserted.beside, &inserted.what);
        place(&mut self.events[at], from);
        if let What::Arc { sweep, .. } = &mut self.events[at].what {
            *sweep = a.sweep(a.from, from);
        }
        if let What::Arc { sweep, .. } = &mut self.events[at + 1].what {
            *sweep = b.sweep(to, b.to);
        }
        self.events.insert(at + 1, inserted);
        Ok(())
    }
}
