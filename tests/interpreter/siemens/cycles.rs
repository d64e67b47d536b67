//! Drilling cycles and patterns of positions, from `reference/siemens.md` section 9.
//!
//! Lengths are in millimetres as soon as a call is read. Not here: patterns out of G17, degression,
//! a first feed of its own, dwells in revolutions, the newer lists' ways of meaning something else.

use super::super::{Halt, Spindle, What};
use super::Control;
use super::text::Argument;

/// A cycle, its arguments worked out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cycle {
    kind: Kind,
    /// Where the tool ends.
    retract: f64,
    /// Where the first stroke of a deep hole is measured from.
    reference: f64,
    /// Down to here in rapid: the reference plane and the safety clearance on it.
    safe: f64,
    depth: f64,
    dwell: f64,
    /// The unit in force at the call.
    inch: bool,
    /// The plane that was in force when it was called.
    plane: u32,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Drill,
    Bore {
        feed_in: f64,
        feed_out: f64,
    },
    /// The control turns the spindle itself: pitch, sense in, speed, what it does after.
    Rigid {
        pitch: f64,
        into: Spindle,
        speed: Option<f64>,
        after: Spindle,
    },
    /// In a chuck: pitch, or feed and speed; sense out, what the spindle does after.
    Chuck {
        pitch: Option<f64>,
        back: Spindle,
        after: Spindle,
    },
    /// Spindle and program stop at the bottom.
    Stop {
        turn: Spindle,
    },
    /// Spindle stopped at an angle, off the wall, rapid out, back over the hole.
    Fine {
        turn: Spindle,
        angle: f64,
        shift: [f64; 3],
    },
    /// Out at the feed in force.
    Same,
    Deep {
        stroke: f64,
        at_start: f64,
        last_dwell: f64,
        clear: bool,
        step: f64,
    },
}

/// Arguments of a call, by place.
struct Arguments<'a> {
    given: &'a [Argument],
    unit: f64,
}

impl Arguments<'_> {
    fn number(&self, place: usize) -> Option<f64> {
        match self.given.get(place) {
            Some(Argument::Number(number, _)) => Some(*number),
            _ => None,
        }
    }

    fn length(&self, place: usize) -> Option<f64> {
        self.number(place).map(|number| number * self.unit)
    }

    fn or_zero(&self, place: usize) -> f64 {
        self.number(place).unwrap_or(0.0)
    }

    /// All from a place on are empty or zero.
    fn unused(&self, from: usize) -> bool {
        self.all_unused(from, self.given.len())
    }

    fn all_unused(&self, from: usize, before: usize) -> bool {
        (from..before.min(self.given.len())).all(|place| match self.given[place] {
            Argument::Empty => true,
            Argument::Number(number, _) => number == 0.0,
            Argument::Text | Argument::Array(_) => false,
        })
    }
}

/// Whether a name is one of the drilling cycles here.
pub(super) fn is_cycle(name: &str) -> bool {
    matches!(
        name,
        "CYCLE81"
            | "CYCLE82"
            | "CYCLE83"
            | "CYCLE84"
            | "CYCLE840"
            | "CYCLE85"
            | "CYCLE86"
            | "CYCLE87"
            | "CYCLE88"
            | "CYCLE89"
    )
}

impl Control<'_> {
    /// Reads the call of a cycle.
    pub(super) fn cycle(&self, name: &str, given: &[Argument]) -> Result<Cycle, Halt> {
        // Three places of the taps hold texts that the form alone shows.
        let shown = match name {
            "CYCLE84" => 18..21,
            "CYCLE840" => 14..17,
            _ => 0..0,
        };
        let text =
            |(place, argument): (usize, &Argument)| *argument == Argument::Text && !shown.contains(&place);
        if given.iter().enumerate().any(text) {
            return self.m.halt("a text as an argument of a cycle");
        }
        let a = Arguments { given, unit: self.unit() };
        let Some(retract) = a.length(0) else { return self.m.halt("a cycle without RTP") };
        let reference = a.length(1).unwrap_or(0.0);
        let clearance = a.length(2).unwrap_or(0.0);
        let depth = match (a.length(3), a.length(4)) {
            (Some(depth), None) => depth,
            (None, Some(down)) if down > 0.0 && retract > reference => reference - down,
            (None, Some(_)) => return self.m.halt("alarm 61101: DPR with RTP = RFP, or no depth"),
            _ => return self.m.halt("DP and DPR, or neither"),
        };
        if clearance < 0.0 || retract < reference || depth > reference {
            return self.m.halt("alarm 61101: planes out of order");
        }
        // Place of the dwell, and of the list that newer controls append.
        let (dwell, appended, mode) = match name {
            "CYCLE81" => (Some(5), 6, 10.0),
            "CYCLE82" => (Some(5), 6, 10.0),
            "CYCLE85" => (Some(5), 8, 10.0),
            "CYCLE84" => (Some(5), 21, 10.0),
            "CYCLE840" => (Some(5), 17, 10.0),
            "CYCLE86" => (Some(5), 11, 10.0),
            "CYCLE87" => (None, 6, 10.0),
            "CYCLE88" => (Some(5), 7, 10.0),
            "CYCLE89" => (Some(5), 6, 10.0),
            _ => (Some(8), 17, 1_001_110.0),
        };
        let dwell = dwell.map_or(0.0, |place| a.or_zero(place));
        let modes = [0, 1, 2].map(|k| a.or_zero(appended + k));
        // The last digit of the third: whether the depth stands as DPR (1) or DP (2), which it then does.
        let stated = modes[2] % 10.0;
        let agrees = stated == 0.0 || stated == if a.length(3).is_some() { 2.0 } else { 1.0 };
        let others = [0.0, mode].contains(&(modes[2] - stated));
        if modes[0] != 0.0 || !agrees || !others || !a.unused(appended + 3) {
            return self.m.halt("a way of machining in the appended arguments");
        }
        self.own_plane(modes[1])?;
        let kind = match name {
            "CYCLE81" | "CYCLE82" => Kind::Drill,
            "CYCLE84" => {
                if !a.all_unused(12, 18) || a.or_zero(9) != 0.0 {
                    return self.m.halt("CYCLE84 with more than is known");
                }
                let (pitch, into) = self.pitch(&a, 7)?;
                let speed = a.number(10).filter(|s| *s > 0.0);
                if a.number(11).is_some_and(|s| s != 0.0 && Some(s) != speed) {
                    return self.m.halt("SST1");
                }
                let Some(pitch) = pitch else { return self.m.halt("CYCLE84 without MPIT and PIT") };
                Kind::Rigid { pitch, into, speed, after: self.sense(a.or_zero(6))? }
            }
            "CYCLE840" => {
                if !a.all_unused(11, 14) {
                    return self.m.halt("CYCLE840 with more than is known");
                }
                let (pitch, _) = self.pitch(&a, 9)?;
                if pitch.is_some() == (a.or_zero(8) == 1.0) {
                    return self.m.halt("ENC");
                }
                Kind::Chuck { pitch, back: self.sense(a.or_zero(6))?, after: self.sense(a.or_zero(7))? }
            }
            "CYCLE86" => Kind::Fine {
                turn: self.sense(a.or_zero(6))?,
                angle: a.or_zero(10),
                shift: [7, 8, 9].map(|place| a.length(place).unwrap_or(0.0)),
            },
            "CYCLE87" => Kind::Stop { turn: self.sense(a.or_zero(5))? },
            "CYCLE88" => Kind::Stop { turn: self.sense(a.or_zero(6))? },
            "CYCLE89" => Kind::Same,
            "CYCLE85" => {
                let scale = if self.feed_inch { 25.4 } else { 1.0 };
                let (Some(feed_in), Some(feed_out)) = (a.number(6), a.number(7)) else {
                    return self.m.halt("CYCLE85 without FFR and RFF");
                };
                if feed_in <= 0.0 || feed_out <= 0.0 {
                    return self.m.halt("CYCLE85 and a feed that is none");
                }
                Kind::Bore { feed_in: feed_in * scale, feed_out: feed_out * scale }
            }
            _ => self.deep(&a, reference, depth, dwell)?,
        };
        if dwell < 0.0 {
            return self.m.halt("a dwell in revolutions");
        }
        let safe = reference + clearance;
        Ok(Cycle { kind, retract, reference, safe, depth, dwell, inch: self.m.inch, plane: self.m.plane })
    }

    /// A cycle's own plane: none, or G17, G18, G19 by 1, 2, 3, which is in force.
    fn own_plane(&self, said: f64) -> Result<(), Halt> {
        if said != 0.0 && said + 16.0 != f64::from(self.m.plane) {
            return self.m.halt("a cycle of another plane than the one in force");
        }
        Ok(())
    }

    /// 3, 4 and 5 are M3, M4 and M5.
    fn sense(&self, value: f64) -> Result<Spindle, Halt> {
        match value as i64 {
            3 => Ok(Spindle::Clockwise),
            4 => Ok(Spindle::Counterclockwise),
            5 => Ok(Spindle::Stopped),
            _ => self.m.halt("3, 4 or 5"),
        }
    }

    /// Pitch from MPIT or, at the next place, PIT; negative is left-hand.
    fn pitch(&self, a: &Arguments, size: usize) -> Result<(Option<f64>, Spindle), Halt> {
        let value = match (a.number(size), a.length(size + 1)) {
            (Some(m), None) if m != 0.0 => {
                let table =
                    [(3, 0.5), (4, 0.7), (5, 0.8), (6, 1.0), (8, 1.25), (10, 1.5), (12, 1.75), (16, 2.0)];
                let Some((_, pitch)) = table.iter().find(|(n, _)| *n == m.abs() as i64) else {
                    return self.m.halt("a size of the metric series");
                };
                Some(pitch * m.signum())
            }
            (_, Some(pitch)) if pitch != 0.0 => Some(pitch),
            _ => None,
        };
        let left = value.is_some_and(|v| v < 0.0);
        let into = if left { Spindle::Counterclockwise } else { Spindle::Clockwise };
        Ok((value.map(f64::abs), into))
    }

    fn deep(&self, a: &Arguments, reference: f64, depth: f64, dwell: f64) -> Result<Kind, Halt> {
        let stroke = match (a.length(5), a.length(6)) {
            (Some(first), None) => reference - first,
            (None, Some(down)) => down,
            _ => return self.m.halt("FDEP and FDPR, or neither"),
        };
        if stroke <= 0.0 || reference - stroke < depth - 1e-9 {
            return self.m.halt("alarm 61107: the first depth");
        }
        // What is left out comes as zero, which is none of a factor's values.
        if a.or_zero(7) != 0.0 || ![0.0, 1.0].contains(&a.or_zero(10)) {
            return self.m.halt("DAM or FRF");
        }
        if ![None, Some(3.0), Some(0.0)].contains(&a.number(12)) {
            return self.m.halt("_AXN");
        }
        let clear = match a.number(11) {
            None | Some(0.0) => false,
            Some(1.0) => true,
            _ => return self.m.halt("VARI"),
        };
        let own = |place: usize| a.length(place).filter(|v| *v != 0.0);
        let step = if clear {
            let hole = reference - depth;
            own(16).unwrap_or(if hole <= 30.0 { 0.6 } else { (hole / 50.0).min(7.0) })
        } else {
            own(14).unwrap_or(1.0)
        };
        let last_dwell = a.number(15).filter(|v| *v != 0.0).unwrap_or(dwell);
        let at_start = a.or_zero(9);
        if step < 0.0 || last_dwell < 0.0 || at_start < 0.0 {
            return self.m.halt("a negative argument: another unit");
        }
        Ok(Kind::Deep { stroke, at_start, last_dwell, clear, step })
    }

    /// Whether the spindle turns on the way in the plane to a rigid tap is not looked at: it stands. A way
    /// along the drilling axis is a block's own, before the cycle.
    pub(super) fn hold_spindle(&mut self) {
        if let Some(Cycle { kind: Kind::Rigid { .. }, .. }) = self.modal {
            self.m.turn(Spindle::Stopped);
        }
    }

    /// Runs a cycle where the tool stands.
    pub(super) fn run_cycle(&mut self, cycle: Cycle) -> Result<(), Halt> {
        // A stop for one block is that of the block's own way.
        self.m.stop_once = false;
        // The bottom lies along the axis that is not in the plane.
        let normal = self.m.axes().2;
        if cycle.plane != self.m.plane {
            return self.m.halt("a cycle called in another plane than defined");
        }
        if cycle.inch != self.m.inch {
            return self.m.halt("a cycle called in another unit than defined");
        }
        if let Kind::Rigid { speed, .. } = cycle.kind {
            self.m.turn(Spindle::Stopped);
            self.m.speed = speed.or(self.m.speed);
        }
        self.rapid_to(cycle.safe);
        match cycle.kind {
            Kind::Rigid { pitch, into, .. } => {
                self.m.turn(into);
                self.thread_to(cycle.depth, pitch, false);
                self.m.turn(Spindle::Stopped);
                self.stay(cycle.dwell);
                self.m.turn(if into == Spindle::Clockwise {
                    Spindle::Counterclockwise
                } else {
                    Spindle::Clockwise
                });
                self.thread_to(cycle.safe, pitch, false);
                self.m.turn(Spindle::Stopped);
            }
            Kind::Chuck { pitch, back, after } => {
                let by_feed = self.m.feed.zip(self.m.speed).map(|(feed, speed)| feed / speed);
                let Some(pitch) = pitch.or(by_feed) else { return self.m.halt("a thread without pitch") };
                self.thread_to(cycle.depth, pitch, true);
                self.stay(cycle.dwell);
                self.m.turn(back);
                self.thread_to(cycle.safe, pitch, true);
                self.m.turn(after);
            }
            Kind::Stop { turn } => {
                self.m.turn(turn);
                self.feed_to(cycle.depth)?;
                self.stay(cycle.dwell);
                self.m.turn(Spindle::Stopped);
                self.m.record(What::Stop);
            }
            Kind::Fine { turn, angle, shift } => {
                let shift = self.along(shift);
                self.m.turn(turn);
                self.feed_to(cycle.depth)?;
                self.stay(cycle.dwell);
                self.m.orient(Some(angle));
                self.move_by(shift);
            }
            Kind::Same => {
                self.feed_to(cycle.depth)?;
                self.stay(cycle.dwell);
                self.feed_to(cycle.safe)?;
            }
            Kind::Drill => {
                self.feed_to(cycle.depth)?;
                self.stay(cycle.dwell);
            }
            Kind::Bore { feed_in, feed_out } => {
                self.m.feed = Some(feed_in);
                self.feed_to(cycle.depth)?;
                self.stay(cycle.dwell);
                self.m.feed = Some(feed_out);
                self.feed_to(cycle.safe)?;
            }
            Kind::Deep { stroke, at_start, last_dwell, clear, step } => {
                let mut strokes = 1.0;
                loop {
                    let bottom = cycle.reference - strokes * stroke;
                    if bottom <= cycle.depth + 1e-9 {
                        break;
                    }
                    self.feed_to(bottom)?;
                    self.stay(cycle.dwell);
                    if clear {
                        self.rapid_to(cycle.safe);
                        self.stay(at_start);
                        self.rapid_to(bottom + step);
                    } else {
                        self.feed_to(bottom + step)?;
                    }
                    strokes += 1.0;
                }
                self.feed_to(cycle.depth)?;
                self.stay(last_dwell);
            }
        }
        self.rapid_to(cycle.retract);
        if let Kind::Fine { shift: [first, second, _], .. } = cycle.kind {
            self.move_by(self.along([-first, -second, 0.0]));
        }
        if let Kind::Rigid { after, .. } = cycle.kind {
            self.m.turn(after);
        }
        if let Kind::Bore { .. } = cycle.kind {
            // Which of the feeds stays in force is not said.
            self.m.feed = None;
        }
        self.m.settled[normal] = true;
        self.tangent = None;
        Ok(())
    }

    fn at_level(&self, z: f64) -> [f64; 6] {
        let mut at = self.here();
        at[self.m.axes().2] = z;
        at
    }

    /// Ways along first and second axis of the plane and its normal, as those along X, Y, Z.
    fn along(&self, way: [f64; 3]) -> [f64; 3] {
        let (first, second, normal) = self.m.axes();
        let mut by = [0.0; 3];
        (by[first], by[second], by[normal]) = (way[0], way[1], way[2]);
        by
    }

    /// A rapid by so much along the program's axes.
    fn move_by(&mut self, by: [f64; 3]) {
        let mut to = self.here();
        for (to, by) in to.iter_mut().zip(by) {
            *to += by;
        }
        let to = self.machine(to);
        self.m.traverse(to);
    }

    fn rapid_to(&mut self, z: f64) {
        if (self.here()[self.m.axes().2] - z).abs() > 1e-9 {
            let to = self.machine(self.at_level(z));
            self.m.traverse(to);
        }
    }

    fn feed_to(&mut self, z: f64) -> Result<(), Halt> {
        if (self.here()[self.m.axes().2] - z).abs() > 1e-9 {
            let to = self.machine(self.at_level(z));
            self.m.straight(to)?;
        }
        Ok(())
    }

    fn thread_to(&mut self, z: f64, pitch: f64, chuck: bool) {
        let to = self.machine(self.at_level(z));
        self.m.thread(to, pitch, chuck);
    }

    fn stay(&mut self, seconds: f64) {
        if seconds > 0.0 {
            self.m.record(What::Dwell(seconds));
        }
    }

    /// A pattern: the cycle in force at each of its positions.
    pub(super) fn pattern(&mut self, name: &str, given: &[Argument]) -> Result<(), Halt> {
        let Some(cycle) = self.modal else { return self.m.halt("a pattern and no cycle in force") };
        if self.m.plane != 17 {
            return self.m.halt("a pattern out of G17");
        }
        for (x, y) in self.positions(name, given)? {
            let mut to = self.here();
            (to[0], to[1]) = (x, y);
            let to = self.machine(to);
            self.hold_spindle();
            self.m.traverse(to);
            self.m.settled[0] = true;
            self.m.settled[1] = true;
            self.run_cycle(cycle)?;
        }
        Ok(())
    }

    fn positions(&self, name: &str, given: &[Argument]) -> Result<Vec<(f64, f64)>, Halt> {
        let a = Arguments { given, unit: self.unit() };
        // _VARI 1 of CYCLE801 is a frame: the border of the grid (reference, 9).
        let frame = name == "CYCLE801" && a.or_zero(7) == 1.0;
        let appended = match name {
            "HOLES1" | "HOLES2" => 6,
            "CYCLE801" => 7 + usize::from(frame),
            _ => return self.points(&a),
        };
        let last = if name == "CYCLE801" { 13 } else { 10 };
        self.own_plane(a.or_zero(last))?;
        // An empty argument is zero (section 8), which is no number of holes.
        if !a.all_unused(appended, last) || !a.unused(last + 1) {
            return self.m.halt(format!("an appended argument of {name}"));
        }
        let number = |place: usize| a.or_zero(place);
        let length = |place: usize| a.or_zero(place) * a.unit;
        let count = |place: usize| {
            let n = number(place);
            if (1.0..=10_000.0).contains(&n) && n.fract() == 0.0 {
                Ok(n as u32)
            } else {
                self.m.halt(format!("so many positions: {n}"))
            }
        };
        let turned = |x: f64, y: f64, degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            (length(0) + x * cos - y * sin, length(1) + x * sin + y * cos)
        };
        let list = match name {
            "HOLES1" => {
                (0..count(5)?).map(|k| turned(length(3) + f64::from(k) * length(4), 0.0, number(2))).collect()
            }
            "HOLES2" => {
                let step = if number(4) == 0.0 { 360.0 / f64::from(count(5)?) } else { number(4) };
                if length(2) <= 0.0 {
                    return self.m.halt("HOLES2 and no radius");
                }
                (0..count(5)?).map(|k| turned(length(2), 0.0, number(3) + f64::from(k) * step)).collect()
            }
            _ => {
                let (columns, rows) = (count(5)?, count(6)?);
                let mut list = Vec::new();
                if frame && columns > 1 && rows > 2 {
                    // Once round: to the right, up, to the left and down, a side each.
                    let (mut column, mut row) = (0, 0);
                    for (dx, dy, steps) in
                        [(1, 0, columns - 1), (0, 1, rows - 1), (-1, 0, columns - 1), (0, -1, rows - 1)]
                    {
                        for _ in 0..steps {
                            let (x, y) = (f64::from(column) * length(3), f64::from(row) * length(4));
                            list.push(turned(x, y, number(2)));
                            (column, row) = (column + dx, row + dy);
                        }
                    }
                    return Ok(list);
                }
                for row in 0..rows {
                    for k in 0..columns {
                        // Every other row is run backwards.
                        let column = if row % 2 == 0 { k } else { columns - 1 - k };
                        let (x, y) = (f64::from(column) * length(3), f64::from(row) * length(4));
                        list.push(turned(x, y, number(2)));
                    }
                }
                list
            }
        };
        Ok(list)
    }

    /// CYCLE802: two flags of nine digits, up to nine pairs, then three more arguments.
    fn points(&self, a: &Arguments) -> Result<Vec<(f64, f64)>, Halt> {
        if [0, 1].iter().any(|place| a.number(*place) != Some(111_111_111.0)) {
            return self.m.halt("CYCLE802: positions that are not all absolute");
        }
        if ![None, Some(0.0), Some(1.0)].contains(&a.number(22))
            || ![20, 21].iter().all(|p| a.or_zero(*p) == 0.0)
        {
            return self.m.halt("CYCLE802: appended arguments");
        }
        let mut list = Vec::new();
        for pair in 0..9 {
            match (a.length(2 + 2 * pair), a.length(3 + 2 * pair)) {
                (Some(x), Some(y)) if list.len() == pair => list.push((x, y)),
                (None, None) => {}
                _ => return self.m.halt("CYCLE802: a gap between the positions"),
            }
        }
        if list.is_empty() || a.given.len() > 23 {
            return self.m.halt("CYCLE802: no positions, or too many arguments");
        }
        Ok(list)
    }
}
