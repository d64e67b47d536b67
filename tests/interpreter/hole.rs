//! How a hole of a canned cycle is made: its moves, in machine coordinates.

use super::{Halt, Machine, Per, Place, Spindle, What};

/// How a hole is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hole {
    /// Feed in, rapid out.
    Drill,
    /// Feed in, dwell, rapid out.
    DrillDwell(f64),
    /// Pecks of so much, dwell behind the last one if not zero.
    Peck(f64, f64),
    /// Pecks of so much, the tool staying in the hole; dwell behind the last one if not zero.
    Break(f64, f64),
    /// Pecks of which the first is so deep, each further one so much less, and none less than the last number; in
    /// the hole, or out of it; dwell behind the last one if not zero.
    Fewer([f64; 3], bool, f64),
    /// Feed in, dwell if not zero, feed out to R.
    Bore(f64),
    /// In and out in step with the spindle, which turns this way first; rigid, or in a chuck; a dwell at
    /// both ends if not zero.
    Tap(Spindle, bool, f64),
    /// Feed in, spindle stopped, rapid out, spindle clockwise.
    Stop,
    /// Feed in, dwell if not zero, spindle stopped at its angle, off the wall by so much, rapid out, back
    /// over the hole, spindle clockwise.
    Fine(f64, f64),
}

impl Machine {
    /// The moves at one hole position, the tool standing over it: to R, in, out. Levels are in
    /// machine coordinates.
    pub fn hole(&mut self, hole: Hole, r: f64, z: f64, back: f64) -> Result<(), Halt> {
        if self.beside.is_some() {
            return self.halt("a cycle under cutter radius compensation");
        }
        if z > r {
            return self.halt("the bottom lies above R");
        }
        // A stop for one block is that of the way to the hole.
        self.stop_once = false;
        let level = |at: Place, height: f64| [at[0], at[1], height, at[3], at[4], at[5]];
        self.traverse(level(self.at, r));
        match hole {
            Hole::Drill => self.straight(level(self.at, z))?,
            Hole::DrillDwell(seconds) => {
                self.straight(level(self.at, z))?;
                self.record(What::Dwell(seconds));
            }
            Hole::Peck(q, _) | Hole::Break(q, _) => {
                if q <= 0.0 || (r - z) / q > 10_000.0 {
                    return self.halt("a peck that leads nowhere");
                }
                let mut depth = r;
                loop {
                    depth -= q;
                    if depth <= z + 1e-9 {
                        break;
                    }
                    self.straight(level(self.at, depth))?;
                    if let Hole::Break(..) = hole {
                        self.traverse(level(self.at, depth + self.setup.break_lift));
                    } else {
                        self.traverse(level(self.at, r));
                        self.traverse(level(self.at, depth + self.setup.peck_clearance));
                    }
                }
                self.straight(level(self.at, z))?;
                if let Hole::Peck(_, seconds) | Hole::Break(_, seconds) = hole {
                    self.stay(seconds);
                }
            }
            Hole::Fewer([first, less, least], stays, seconds) => {
                if first < least || less < 0.0 || least <= 0.0 {
                    return self.halt("pecks that do not decrease");
                }
                // Depths below R, as the manual's first, second, third pass have them.
                let (mut below, mut pass) = (first, first);
                while below < r - z - 1e-9 {
                    self.straight(level(self.at, r - below))?;
                    if stays {
                        self.traverse(level(self.at, r - below + self.setup.break_lift));
                    } else {
                        self.traverse(level(self.at, r));
                        self.traverse(level(self.at, r - below + self.setup.peck_clearance));
                    }
                    pass = if pass - less < least { least } else { pass - less };
                    below += pass;
                }
                self.straight(level(self.at, z))?;
                self.stay(seconds);
            }
            Hole::Tap(into, rigid, seconds) => {
                let (Some(feed), Some(speed)) = (self.feed, self.speed.filter(|s| *s > 0.0)) else {
                    return self.halt("a thread without feed or speed");
                };
                let lead = match self.per {
                    Per::Minute => feed / speed,
                    Per::Turn => feed,
                    Per::Move => return self.halt("a thread by inverse time"),
                };
                let back = match into {
                    Spindle::Clockwise => Spindle::Counterclockwise,
                    _ => Spindle::Clockwise,
                };
                if rigid {
                    self.turn(into);
                }
                self.thread(level(self.at, z), lead, !rigid);
                if rigid {
                    self.turn(Spindle::Stopped);
                }
                self.stay(seconds);
                self.turn(back);
                self.thread(level(self.at, r), lead, !rigid);
                if rigid {
                    self.turn(Spindle::Stopped);
                }
                self.stay(seconds);
                if !rigid {
                    self.turn(into);
                }
            }
            Hole::Stop => {
                self.straight(level(self.at, z))?;
                self.turn(Spindle::Stopped);
            }
            Hole::Fine(by, seconds) => {
                self.straight(level(self.at, z))?;
                self.stay(seconds);
                self.orient(None);
                self.shift_tool(self.off_the_wall(by));
            }
            Hole::Bore(seconds) => {
                self.straight(level(self.at, z))?;
                if seconds > 0.0 {
                    self.record(What::Dwell(seconds));
                }
                self.straight(level(self.at, r))?;
            }
        }
        self.traverse(level(self.at, back));
        if let Hole::Fine(by, _) = hole {
            self.shift_tool(self.off_the_wall(-by));
        }
        if matches!(hole, Hole::Stop | Hole::Fine(..)) {
            self.turn(Spindle::Clockwise);
        }
        self.settled[2] = true;
        Ok(())
    }

    /// The way off the wall of a bore in XY.
    fn off_the_wall(&self, by: f64) -> [f64; 3] {
        let (axis, sign) = self.setup.bore_shift;
        std::array::from_fn(|a| if a == axis { by * sign } else { 0.0 })
    }
}
