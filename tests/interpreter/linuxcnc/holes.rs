//! How LinuxCNC makes holes by its cycles: series of them, levels, taps.

use super::{Control, Kept, Words};
use crate::{Halt, Per, Place, Spindle, What};

impl Control {
    /// A block of a cycle: a hole, or several one step apart.
    pub(super) fn holes(&mut self, code: u32, words: &Words, axes: [Option<f64>; 6]) -> Result<(), Halt> {
        let (first, second, normal) = self.m.axes();
        if axes.iter().all(Option::is_none) || axes[3..].iter().any(Option::is_some) {
            return self.m.halt("a cycle without a place, or with a rotary axis");
        }
        if self.m.per == Per::Move || self.m.feed.is_none_or(|feed| feed <= 0.0) {
            return self.m.halt("a cycle without feed, or by inverse time");
        }
        let unit = self.unit();
        if matches!(code, 820 | 860 | 890) && self.motion != Some(code) && words.get('P').is_none() {
            return self.m.halt("a cycle with a dwell, called up without P");
        }
        if self.motion != Some(code) {
            // Only P outlasts its cycle.
            self.kept = Kept { p: self.kept.p, ..Kept::default() };
        }
        self.kept.r = words.get('R').map(|r| r * unit).or(self.kept.r);
        self.kept.q = words.get('Q').map(|q| q * unit).or(self.kept.q);
        self.kept.p = words.get('P').or(self.kept.p);
        self.kept.bottom = axes[normal].or(self.kept.bottom);
        let (Some(r), Some(bottom)) = (self.kept.r, self.kept.bottom) else {
            return self.m.halt("a cycle without R and the bottom");
        };
        let shift = self.m.shift(normal);
        let initial = *self.initial.get_or_insert(self.m.at[normal] - shift) + shift;
        let (r, bottom) = match self.m.absolute {
            true => (r + shift, bottom + shift),
            false => (initial + r, initial + r + bottom),
        };
        if bottom > r {
            return self.m.halt("the bottom lies above R");
        }
        let times = match words.get('L') {
            None => 1,
            Some(times) if times >= 1.0 => times as u32,
            Some(_) => return self.m.halt("no repetition"),
        };
        let clear = if self.return_initial { initial.max(r) } else { r };
        if initial < r {
            self.rapid(normal, r);
        }
        for time in 0..times {
            let mut in_plane = [None; 6];
            (in_plane[first], in_plane[second]) = (axes[first], axes[second]);
            let mut over = self.target(in_plane);
            // The first time from where the tool stands above R, later on from the level of return.
            if time > 0 || self.m.at[normal] <= r {
                over[normal] = clear;
            }
            self.m.traverse(over);
            self.rapid(normal, r);
            self.hole(code, normal, [r, bottom, clear])?;
        }
        Ok(())
    }

    fn level(&self, normal: usize, level: f64) -> Place {
        let mut to = self.m.at;
        to[normal] = level;
        to
    }

    fn rapid(&mut self, normal: usize, level: f64) {
        self.m.traverse(self.level(normal, level));
    }

    fn feed(&mut self, normal: usize, level: f64) -> Result<(), Halt> {
        self.m.straight(self.level(normal, level))
    }

    fn stay(&mut self, seconds: f64) {
        if seconds > 0.0 {
            self.m.record(What::Dwell(seconds));
        }
    }

    /// One hole, the tool standing at R over it.
    fn hole(&mut self, code: u32, normal: usize, [r, bottom, clear]: [f64; 3]) -> Result<(), Halt> {
        match code {
            810 => self.feed(normal, bottom)?,
            820 | 890 => {
                let Some(seconds) = self.kept.p else { return self.m.halt("a dwell without P") };
                self.feed(normal, bottom)?;
                self.stay(seconds);
                if code == 890 {
                    self.feed(normal, clear)?;
                }
            }
            730 | 830 => {
                let Some(q) = self.kept.q.filter(|q| *q > 0.0) else { return self.m.halt("pecks without Q") };
                let mut depth = r - q;
                while depth > bottom + 1e-9 {
                    self.feed(normal, depth)?;
                    if code == 730 {
                        self.rapid(normal, depth + self.m.setup.break_lift);
                    } else {
                        self.rapid(normal, r);
                        self.rapid(normal, depth + self.m.setup.peck_clearance);
                    }
                    depth -= q;
                }
                self.feed(normal, bottom)?;
            }
            850 => {
                self.feed(normal, bottom)?;
                self.feed(normal, r)?;
            }
            860 => {
                let before = self.m.spindle;
                if before == Spindle::Stopped {
                    return self.m.halt("G86 and the spindle stands");
                }
                self.feed(normal, bottom)?;
                self.stay(self.kept.p.unwrap_or(0.0));
                self.m.turn(Spindle::Stopped);
                self.rapid(normal, clear);
                self.m.turn(before);
            }
            _ => return self.tap(code, normal, bottom, clear),
        }
        self.rapid(normal, clear);
        Ok(())
    }

    /// In and, the spindle turned round, out to the level of return; a holder makes good the rest.
    fn tap(&mut self, code: u32, normal: usize, bottom: f64, clear: f64) -> Result<(), Halt> {
        let (into, back) = match code {
            840 => (Spindle::Clockwise, Spindle::Counterclockwise),
            _ => (Spindle::Counterclockwise, Spindle::Clockwise),
        };
        if self.m.spindle != into {
            return self.m.halt("a thread and the spindle does not turn so");
        }
        if normal != 2 {
            return self.m.halt("a thread in another plane, which the interpreter feeds elsewhere");
        }
        let (Some(feed), Some(speed)) = (self.m.feed, self.m.speed.filter(|speed| *speed > 0.0)) else {
            return self.m.halt("a thread without feed or speed");
        };
        let pitch = if self.m.per == Per::Turn { feed } else { feed / speed };
        self.m.thread(self.level(normal, bottom), pitch, true);
        self.m.turn(Spindle::Stopped);
        self.m.turn(back);
        self.stay(self.kept.p.unwrap_or(0.0));
        self.m.thread(self.level(normal, clear), pitch, true);
        self.m.turn(Spindle::Stopped);
        self.m.turn(into);
        Ok(())
    }
}
