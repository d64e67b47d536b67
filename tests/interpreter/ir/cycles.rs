//! Cycles and patterns of the neutral program, in program coordinates.

use super::super::{Halt, Per, Place, Spindle, What};
use super::Control;
use super::text::{Token, split};

/// A cycle in force; levels in program coordinates.
#[derive(Clone, Copy)]
pub(super) struct Cycle {
    hole: Hole,
    retract: f64,
    depth: f64,
    /// In machine coordinates; not known after a change of offsets.
    initial: Option<f64>,
    /// The same by the zero it was called up with: a control that looks whether it is above the retract plane keeps
    /// the number.
    initial_number: Option<f64>,
    back_initial: Option<bool>,
    back_plane: Option<f64>,
    raise_first: bool,
    retract_first: bool,
    clear_first: bool,
    feed: Option<f64>,
    /// 17, 18, 19.
    plane: u32,
}

/// How a hole is made.
#[derive(Clone, Copy)]
enum Hole {
    Drill {
        dwell: Option<f64>,
    },
    Strokes {
        first: f64,
        peck: f64,
        /// How much less than the one before it a peck is, down to the least.
        less: Option<f64>,
        pause: Option<f64>,
        dwell: Option<f64>,
        out: Out,
    },
    Bore {
        dwell: Option<f64>,
        feed_out: Option<f64>,
        to_level: bool,
    },
    Tap {
        into: Spindle,
        rigid: bool,
        pitch: Option<f64>,
        dwell: Option<f64>,
        back: Option<f64>,
        settle: Option<f64>,
        after: Spindle,
        to_level: bool,
    },
    Stop {
        turn: Option<Spindle>,
        dwell: Option<f64>,
        stop: bool,
        /// As it turned before, or so.
        after: Option<Spindle>,
    },
    Fine {
        turn: Option<Spindle>,
        dwell: Option<f64>,
        angle: Option<f64>,
        shift: [f64; 3],
        after: Spindle,
    },
}

/// What is done between strokes.
#[derive(Clone, Copy)]
enum Out {
    Clear { clearance: f64, settle: Option<f64> },
    Break { lift: f64, at_feed: bool },
}

/// A name of what the spindle does.
fn spindle(name: &str) -> Option<Spindle> {
    match name {
        "clockwise" => Some(Spindle::Clockwise),
        "counterclockwise" => Some(Spindle::Counterclockwise),
        "stopped" => Some(Spindle::Stopped),
        _ => None,
    }
}

/// What the spindle does, said after a word or a bracket.
fn sense(kind: &[Token], after: &str) -> Option<Spindle> {
    kind.windows(2).find_map(|pair| match pair {
        [Token::Name(word), Token::Name(name)] if word == after => spindle(name),
        [Token::Sign(sign), Token::Name(name)] if after == "(" && *sign == '(' => spindle(name),
        _ => None,
    })
}

/// The axis along which a cycle in a plane drills.
fn normal(plane: u32) -> usize {
    [2, 1, 0][(plane - 17) as usize]
}

impl Control {
    /// The sense in which the spindle turns into a bore, if it is said.
    fn turn_in(kind: &[Token]) -> Option<Spindle> {
        kind.iter().enumerate().find_map(|(at, token)| match (token, at.checked_sub(1)) {
            (Token::Name(n), Some(before)) if !matches!(&kind[before], Token::Name(b) if b == "after") => {
                spindle(n)
            }
            _ => None,
        })
    }

    pub(super) fn start(&mut self, a: &[Token]) -> Result<(), Halt> {
        let parts = split(a);
        let [kind, [Token::Name(plane)], ..] = &parts[..] else { return self.m.halt("no cycle") };
        let plane = self.plane(plane)?;
        let normal = normal(plane);
        let Some(Token::Name(name)) = kind.first() else { return self.m.halt("no cycle") };
        let number = |word: &str| self.after(kind, word);
        let to_level = kind.iter().any(|t| matches!(t, Token::Name(n) if n == "to-level"));
        let hole = match (name.as_str(), number("dwell"), number("peck")) {
            ("drill", ..) => Hole::Drill { dwell: None },
            ("drill-dwell", dwell, _) => Hole::Drill { dwell },
            ("drill-peck" | "drill-break", dwell, Some(peck)) => Hole::Strokes {
                first: number("first").unwrap_or(peck),
                peck,
                less: number("less"),
                pause: number("pause"),
                dwell,
                out: if name == "drill-peck" {
                    let clearance = number("clearance").unwrap_or(self.m.setup.peck_clearance);
                    Out::Clear { clearance, settle: number("settle") }
                } else {
                    let at_feed = kind.iter().any(|t| matches!(t, Token::Name(n) if n == "at-feed"));
                    Out::Break { lift: number("lift").unwrap_or(self.m.setup.break_lift), at_feed }
                },
            },
            ("bore", dwell, _) => Hole::Bore { dwell, feed_out: number("feed-out"), to_level },
            ("tap" | "tap-rigid", dwell, _) => {
                let (Some(into), Some(after)) = (sense(kind, "("), sense(kind, "after")) else {
                    return self.m.halt("a tap without its senses");
                };
                let (pitch, settle) = (number("pitch"), number("settle"));
                Hole::Tap {
                    into,
                    rigid: name == "tap-rigid",
                    pitch,
                    dwell,
                    back: number("back"),
                    settle,
                    after,
                    to_level,
                }
            }
            ("bore-fine", dwell, _) => {
                let Some(after) = sense(kind, "after") else {
                    return self.m.halt("a spindle as before");
                };
                let turn = Control::turn_in(kind);
                let shift = match (number("parameter"), ["X", "Y", "Z"].map(number)) {
                    (Some(by), _) => {
                        let (axis, sign) = self.m.setup.bore_shift;
                        std::array::from_fn(|a| if a == axis { by * sign } else { 0.0 })
                    }
                    (None, along) => along.map(|by| by.unwrap_or(0.0)),
                };
                Hole::Fine { turn, dwell, angle: number("angle"), shift, after }
            }
            ("bore-stop", dwell, _) => {
                let after = sense(kind, "after");
                let turn = Control::turn_in(kind);
                let stop = kind.iter().any(|t| matches!(t, Token::Name(n) if n == "program-stop"));
                Hole::Stop { turn, dwell, stop, after }
            }
            _ => return self.m.halt("a cycle of another kind"),
        };
        let initial = match &self.cycle {
            Some(cycle) => cycle.initial,
            None => self.m.settled[normal].then_some(self.m.at[normal]),
        };
        let initial_number = match &self.cycle {
            Some(cycle) => cycle.initial_number,
            None => self.m.settled[normal].then(|| self.here()[normal]),
        };
        let from = initial.map(|z| {
            let mut at = self.m.at;
            at[normal] = z;
            self.program(at)[normal]
        });
        let (mut retract, mut depth, mut back_initial, mut back_plane) = (None, None, None, None);
        let (mut raise_first, mut retract_first, mut clear_first, mut feed) = (false, false, false, None);
        for part in &parts[2..] {
            let level = |from: Option<f64>, rest: &[Token]| match rest {
                [Token::Number(v, u)] => Some(self.base(*v, u)),
                [Token::Name(n), Token::Number(v, u)] if n == "entry" && self.m.absolute => {
                    Some(self.base(*v, u))
                }
                [Token::Name(_), Token::Number(v, u)] => from.map(|from| from + self.base(*v, u)),
                _ => None,
            };
            match part {
                [Token::Name(n), rest @ ..] if n == "retract" => retract = level(from, rest),
                [Token::Name(n), ..] if n == "reference" => {}
                [Token::Name(n), rest @ ..] if n == "depth" => depth = level(retract, rest),
                [Token::Name(n), rest @ ..] if n == "return-plane" => back_plane = level(None, rest),
                [Token::Name(n), Token::Name(v)] if n == "return" => {
                    back_initial = (v != "entry").then(|| v == "initial");
                }
                [Token::Name(n)] => {
                    (raise_first, retract_first) = (n == "raise-first", n == "retract-first");
                    clear_first = n == "clear-first";
                }
                [Token::Name(n), Token::Number(v, u)] if n == "feed" => feed = Some(self.base(*v, u)),
                _ => return self.m.halt("another word in a cycle"),
            }
        }
        if feed.is_some() {
            self.m.feed = feed;
        }
        let (Some(retract), Some(depth)) = (retract, depth) else {
            return self.m.halt("a cycle without its levels");
        };
        if depth > retract {
            return self.m.halt("the bottom lies above the retract plane");
        }
        self.cycle = Some(Cycle {
            hole,
            retract,
            depth,
            initial,
            initial_number,
            back_initial,
            back_plane,
            raise_first,
            retract_first,
            clear_first,
            feed,
            plane,
        });
        Ok(())
    }

    pub(super) fn hole_word(&mut self, a: &[Token]) -> Result<(), Halt> {
        let (to, _) = self.target(a)?;
        self.hole_at(to)
    }

    fn at_level(&self, z: f64) -> Place {
        let mut at = self.here();
        at[self.cycle.map_or(2, |cycle| normal(cycle.plane))] = z;
        self.machine(at)
    }

    fn rapid(&mut self, z: f64) {
        let to = self.at_level(z);
        self.m.traverse(to);
    }

    fn feed(&mut self, z: f64) -> Result<(), Halt> {
        let to = self.at_level(z);
        self.m.straight(to)
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

    fn stay(&mut self, seconds: Option<f64>) {
        if let Some(seconds) = seconds.filter(|seconds| *seconds > 0.0) {
            self.m.record(What::Dwell(seconds));
        }
    }

    /// A hole over a place, in program coordinates; what it says along the normal is not used.
    fn hole_at(&mut self, mut over: Place) -> Result<(), Halt> {
        let Some(cycle) = self.cycle else { return self.m.halt("a hole without a cycle") };
        let normal = normal(cycle.plane);
        let (r, z) = (cycle.retract, cycle.depth);
        let turned = self.m.spindle;
        if let Hole::Tap { rigid: true, .. } = cycle.hole {
            self.m.turn(Spindle::Stopped);
        }
        let back = match (cycle.back_plane, cycle.back_initial.unwrap_or(self.return_initial)) {
            (Some(plane), _) => Some(plane),
            (None, false) => Some(r),
            (None, true) if cycle.clear_first => cycle.initial_number.map(|initial| initial.max(r)),
            (None, true) => cycle.initial.map(|initial| {
                let mut at = self.m.at;
                at[normal] = initial;
                let initial = self.program(at)[normal];
                if cycle.raise_first { initial.max(r) } else { initial }
            }),
        };
        if cycle.retract_first || cycle.raise_first && self.here()[normal] < r {
            self.rapid(r);
        }
        let mut level = self.here()[normal];
        if cycle.clear_first {
            let (Some(initial), Some(back)) = (cycle.initial_number, back) else {
                return self.m.halt("the initial level is not known");
            };
            if initial < r {
                self.rapid(r);
                level = r;
            } else if level <= r {
                level = back;
            }
        }
        over[normal] = level;
        let to = self.machine(over);
        self.m.traverse(to);
        // A stop for one block is that of the way to the hole.
        self.m.stop_once = false;
        self.rapid(r);
        if cycle.feed.is_some() {
            self.m.feed = cycle.feed;
        }
        let up = |to_level: bool| if to_level { back.unwrap_or(r) } else { r };
        match cycle.hole {
            Hole::Drill { dwell } => {
                self.feed(z)?;
                self.stay(dwell);
            }
            Hole::Strokes { first, peck, less, pause, dwell, out } => {
                if peck <= 0.0 || first <= 0.0 || (r - z) / peck > 10_000.0 {
                    return self.m.halt("a peck that leads nowhere");
                }
                let mut stroke = first;
                let mut bottom = r - stroke;
                while bottom > z + 1e-9 {
                    self.feed(bottom)?;
                    self.stay(pause);
                    match out {
                        Out::Clear { clearance, settle } => {
                            self.rapid(r);
                            self.stay(settle);
                            self.rapid(bottom + clearance);
                        }
                        Out::Break { lift, at_feed: true } => self.feed(bottom + lift)?,
                        Out::Break { lift, at_feed: false } => self.rapid(bottom + lift),
                    }
                    stroke = less.map_or(peck, |less| f64::max(peck, stroke - less));
                    bottom -= stroke;
                }
                self.feed(z)?;
                self.stay(dwell);
            }
            Hole::Tap { into, rigid, pitch, dwell, back: turned_dwell, settle, after, to_level } => {
                let speed = self.m.speed.filter(|speed| *speed > 0.0);
                let by_feed = match self.m.per {
                    Per::Turn => self.m.feed,
                    Per::Minute | Per::Move => self.m.feed.zip(speed).map(|(feed, speed)| feed / speed),
                };
                let Some(pitch) = pitch.or(by_feed) else { return self.m.halt("a thread without pitch") };
                let back = match into {
                    Spindle::Clockwise => Spindle::Counterclockwise,
                    _ => Spindle::Clockwise,
                };
                let (bottom, out) = (self.at_level(z), self.at_level(up(to_level)));
                if rigid {
                    self.m.turn(into);
                }
                self.m.thread(bottom, pitch, !rigid);
                if rigid {
                    self.m.turn(Spindle::Stopped);
                }
                self.stay(dwell);
                self.m.turn(back);
                self.stay(turned_dwell);
                self.m.thread(out, pitch, !rigid);
                self.m.turn(if rigid { Spindle::Stopped } else { back });
                self.stay(settle);
                if !rigid {
                    self.m.turn(after);
                }
            }
            Hole::Stop { turn, dwell, stop, .. } => {
                if let Some(turn) = turn {
                    self.m.turn(turn);
                }
                self.feed(z)?;
                self.stay(dwell);
                self.m.turn(Spindle::Stopped);
                if stop {
                    self.m.record(What::Stop);
                }
            }
            Hole::Fine { turn, dwell, angle, shift, .. } => {
                if let Some(turn) = turn {
                    self.m.turn(turn);
                }
                self.feed(z)?;
                self.stay(dwell);
                self.m.orient(angle);
                self.move_by(shift);
            }
            Hole::Bore { dwell, feed_out, to_level } => {
                self.feed(z)?;
                self.stay(dwell);
                let feed_in = self.m.feed;
                self.m.feed = feed_out.or(feed_in);
                self.feed(up(to_level))?;
                self.m.feed = feed_in;
            }
        }
        match back {
            Some(back) => self.rapid(back),
            None => return self.m.halt("the initial level is not known"),
        }
        match cycle.hole {
            Hole::Tap { rigid: true, after, .. } => self.m.turn(after),
            Hole::Stop { after, .. } => self.m.turn(after.unwrap_or(turned)),
            Hole::Fine { shift, after, .. } => {
                // Back over the hole; how far out of it the tool is is not taken back.
                let normal = match cycle.plane {
                    17 => 2,
                    18 => 1,
                    _ => 0,
                };
                self.move_by(std::array::from_fn(|axis| if axis == normal { 0.0 } else { -shift[axis] }));
                self.m.turn(after);
            }
            _ => {}
        }
        self.m.settled[normal] = true;
        self.tangent = None;
        Ok(())
    }

    /// A hole of a pattern, whose places are absolute.
    fn hole_of_pattern(&mut self, place: (f64, f64)) -> Result<(), Halt> {
        if self.cycle.is_some_and(|cycle| cycle.plane != 17) {
            return self.m.halt("a pattern out of XY");
        }
        let mut over = self.here();
        (over[0], over[1]) = place;
        self.hole_at(over)?;
        self.m.settled[..2].fill(true);
        Ok(())
    }

    /// A place in the plane: `(1.mm, inc 2.mm)`.
    fn pair(&self, tokens: &[Token]) -> Option<(f64, f64)> {
        let [Token::Sign('('), inner @ .., Token::Sign(')')] = tokens else { return None };
        let here = self.here();
        let parts = split(inner);
        let [x, y] = &parts[..] else { return None };
        let value = |axis: usize, part: &[Token]| match part {
            [Token::Number(v, u)] => Some(self.base(*v, u)),
            [Token::Name(n), Token::Number(v, u)] if n == "entry" && self.m.absolute => {
                Some(self.base(*v, u))
            }
            [Token::Name(_), Token::Number(v, u)] => Some(here[axis] + self.base(*v, u)),
            _ => None,
        };
        Some((value(0, x)?, value(1, y)?))
    }

    /// What stands after a word, in one of the parts.
    fn part<'t>(&self, parts: &[&'t [Token]], word: &str) -> Option<&'t [Token]> {
        parts.iter().find_map(|part| match part {
            [Token::Name(n), rest @ ..] if n == word => Some(rest),
            _ => None,
        })
    }

    fn place_of(&self, parts: &[&[Token]], word: &str) -> Result<(f64, f64), Halt> {
        let here = self.here();
        match self.part(parts, word) {
            None => Ok((here[0], here[1])),
            Some([Token::Name(n)]) if n == "here" => Ok((here[0], here[1])),
            Some(tokens) => self.pair(tokens).map_or_else(|| self.m.halt(format!("no place: {word}")), Ok),
        }
    }

    fn number_of(&self, parts: &[&[Token]], word: &str) -> Result<f64, Halt> {
        match self.part(parts, word) {
            Some([Token::Number(v, u)]) => Ok(self.base(*v, u)),
            _ => self.m.halt(format!("no number: {word}")),
        }
    }

    pub(super) fn circle_pattern(&mut self, a: &[Token]) -> Result<(), Halt> {
        let parts = split(a);
        let centre = self.place_of(&parts, "centre")?;
        let first = match self.part(&parts, "first") {
            Some(tokens) if self.after(tokens, "radius").is_some() => {
                let radius = self.after(tokens, "radius").unwrap_or(0.0);
                let (sin, cos) = self.after(tokens, "angle").unwrap_or(0.0).to_radians().sin_cos();
                (centre.0 + radius * cos, centre.1 + radius * sin)
            }
            _ => self.place_of(&parts, "first")?,
        };
        let (step, count) = (self.number_of(&parts, "step")?, self.number_of(&parts, "count")?);
        for k in 0..count as u32 {
            let (sin, cos) = (f64::from(k) * step).to_radians().sin_cos();
            let (dx, dy) = (first.0 - centre.0, first.1 - centre.1);
            self.hole_of_pattern((centre.0 + dx * cos - dy * sin, centre.1 + dx * sin + dy * cos))?;
        }
        Ok(())
    }

    pub(super) fn line(&mut self, a: &[Token]) -> Result<(), Halt> {
        let parts = split(a);
        let start = self.place_of(&parts, "start")?;
        let number = |word: &str| self.number_of(&parts, word);
        let (angle, offset, pitch, count) =
            (number("angle")?, number("offset")?, number("pitch")?, number("count")?);
        let (sin, cos) = angle.to_radians().sin_cos();
        for k in 0..count as u32 {
            let way = offset + f64::from(k) * pitch;
            self.hole_of_pattern((start.0 + way * cos, start.1 + way * sin))?;
        }
        Ok(())
    }

    pub(super) fn list(&mut self, a: &[Token]) -> Result<(), Halt> {
        for part in split(a) {
            let [Token::Sign('('), inner @ .., Token::Sign(')')] = part else {
                return self.m.halt("no position of a list");
            };
            self.hole_word(inner)?;
        }
        Ok(())
    }

    pub(super) fn grid(&mut self, a: &[Token]) -> Result<(), Halt> {
        let parts = split(a);
        let start = self.place_of(&parts, "start")?;
        let row = |word: &str| -> Result<(f64, f64, u32), Halt> {
            let inner = match self.part(&parts, word) {
                Some([Token::Sign('('), inner @ .., Token::Sign(')')]) => split(inner),
                _ => Vec::new(),
            };
            let [along, [Token::Number(pitch, u)], [Token::Number(count, _)]] = &inner[..] else {
                return self.m.halt("no row of a grid");
            };
            let pitch = self.base(*pitch, u);
            let (sin, cos) = match along {
                [Token::Name(axis)] => [(0.0, 1.0), (1.0, 0.0)][usize::from(axis == "Y")],
                [_, Token::Number(angle, _)] => angle.to_radians().sin_cos(),
                _ => return self.m.halt("no direction of a row"),
            };
            Ok((pitch * cos, pitch * sin, *count as u32))
        };
        let (columns, rows) = (row("columns")?, row("rows")?);
        let serpentine = parts.iter().any(|p| matches!(p, [Token::Name(n)] if n == "serpentine"));
        for j in 0..rows.2 {
            for i in 0..columns.2 {
                let i = if serpentine && j % 2 == 1 { columns.2 - 1 - i } else { i };
                let (i, j) = (f64::from(i), f64::from(j));
                self.hole_of_pattern((
                    start.0 + i * columns.0 + j * rows.0,
                    start.1 + i * columns.1 + j * rows.1,
                ))?;
            }
        }
        Ok(())
    }
}
