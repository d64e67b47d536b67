//! Blocks with axis words: straight lines, and arcs in all the forms that a Sinumerik knows.

use super::super::{ArcFeed, Halt, Place};
use super::text::{Mark, Value};
use super::{AXES, Control, Motion, Words, arcs};

impl Control<'_> {
    /// Length is that of an edge of the tool in the spindle; like another work offset it moves nothing.
    pub(super) fn take_edge(&mut self, edge: u32, tool: Option<u32>) {
        if (edge, tool) != (self.edge, self.m.tool) {
            self.m.settled[2] = false;
            if self.frame.turns() {
                self.m.settled[..3].fill(false);
            }
        }
        self.edge = edge;
        self.m.entry = if edge == 0 { 0 } else { tool.unwrap_or(0) };
    }

    /// G41 and G42: by the radius of the edge that the block, or one before it, has made active.
    pub(super) fn compensate(&mut self, w: &Words) -> Result<(), Halt> {
        for name in &w.names {
            match *name {
                "CFC" => self.m.feeds.arcs = ArcFeed::Contour,
                "CFTCP" => self.m.feeds.arcs = ArcFeed::Centre,
                "CFIN" => self.m.feeds.arcs = ArcFeed::Inner,
                _ => {}
            }
        }
        let side = w.letters.iter().find_map(|(letter, value, _)| match (letter, value.number as u32) {
            ('G', code @ (41 | 42)) => Some(code == 41),
            _ => None,
        });
        let Some(left) = side else { return Ok(()) };
        let (first, second, normal) = self.m.axes();
        let Some(reversed) = self.chain().reverses(first, second, normal) else {
            return self.m.halt("compensation in a frame that makes circles ellipses");
        };
        let entry = match self.edge {
            0 => Some(0),
            1 => Some(self.m.tool.unwrap_or(0)),
            _ => None,
        };
        self.m.go_beside_again(left, reversed, entry)
    }

    pub(super) fn go(&mut self, w: &Words, axes: &[usize]) -> Result<(), Halt> {
        let from = self.here();
        let mut to = from;
        for &axis in axes {
            let Some(value) = w.letter(AXES[axis]) else { continue };
            let number = value.number * if axis < 3 { self.unit() } else { 1.0 };
            let absolute = match value.mark {
                Mark::None => self.m.absolute,
                mark => mark == Mark::Absolute,
            };
            if absolute {
                to[axis] = number;
                self.m.settled[axis] = !self.suppressed;
            } else if self.suppressed {
                return self.m.halt("an incremental word with SUPA");
            } else if self.m.settled[axis] || number == 0.0 {
                to[axis] = from[axis] + number;
            } else {
                return self.m.halt("an incremental word after a change of offsets or frames");
            }
        }
        if self.floating {
            return self.floating_thread(axes, to);
        }
        let Some(motion) = self.motion else { return self.m.halt("a motion and no code for it yet") };
        let polar = w.named("AP").is_some() || w.named("RP").is_some();
        if polar {
            let (first, second, _) = self.m.axes();
            if self.suppressed || axes.contains(&first) || axes.contains(&second) {
                return self.m.halt("polar words with SUPA or coordinates of the plane");
            }
            (to[first], to[second]) = self.polar_point(w)?;
            (self.m.settled[first], self.m.settled[second]) = (true, true);
        }
        if let Some(angle) = w.named("ANG") {
            self.by_angle(angle.number, &motion, axes, from, &mut to)?;
        }
        if let Motion::Thread(turns) = motion {
            return self.thread(turns, w, axes, to);
        }
        let straight = matches!(motion, Motion::Rapid | Motion::Straight);
        let extra = w.letters.iter().any(|l| "IJK".contains(l.0))
            || w.named.iter().any(|n| super::CENTRE.contains(&n.0));
        if (straight || polar) && extra {
            return self.m.halt("a centre or radius without an arc");
        }
        match motion {
            Motion::Rapid => {
                self.m.traverse(self.machine(to));
                self.tangent = None;
            }
            Motion::Straight => self.straight(from, to)?,
            _ if self.suppressed => return self.m.halt("an arc with SUPA"),
            Motion::Clockwise | Motion::Counterclockwise if polar => {
                // The pole is the centre.
                self.circle(from, to, self.pole, motion == Motion::Clockwise, 0)?;
            }
            _ if polar => return self.m.halt("polar words of this motion"),
            Motion::ThroughPoint => self.through_point(w, from, to)?,
            Motion::Thread(_) | Motion::Tangent => self.tangential(extra, from, to)?,
            Motion::Clockwise | Motion::Counterclockwise => {
                self.arc(w, axes, from, to, motion == Motion::Clockwise)?;
            }
        }
        Ok(())
    }

    /// G110 from the place reached last, G111 from zero, G112 from the last pole: by coordinates or by
    /// radius and angle. What was said about the pole before is forgotten.
    pub(super) fn set_pole(&mut self, w: &Words) -> Result<(), Halt> {
        let (first, second, _) = self.m.axes();
        let code = w.letter('G').map_or(0.0, |v| v.number);
        let others = w.letters.iter().any(|l| l.0 != 'G' && l.0 != AXES[first] && l.0 != AXES[second]);
        if w.letters.iter().filter(|l| l.0 == 'G').count() != 1 || others || !w.names.is_empty() {
            return self.m.halt("a pole and other words");
        }
        let unit = self.unit();
        let along = |letter| w.letter(letter).map_or(0.0, |v| v.number * unit);
        let by = match (w.named("RP"), w.named("AP")) {
            (None, None) => (along(AXES[first]), along(AXES[second])),
            (Some(radius), Some(angle)) if angle.mark == Mark::None && w.letters.len() == 1 => {
                let turn = angle.number.to_radians();
                (radius.number * unit * turn.cos(), radius.number * unit * turn.sin())
            }
            _ => return self.m.halt("a pole by some of its words"),
        };
        let here = self.here();
        let from = match code as u32 {
            110 => (here[first], here[second]),
            111 => (0.0, 0.0),
            _ => self.pole,
        };
        self.pole = (from.0 + by.0, from.1 + by.1);
        (self.radius, self.angle) = (None, None);
        Ok(())
    }

    fn polar_point(&mut self, w: &Words) -> Result<(f64, f64), Halt> {
        if let Some(radius) = w.named("RP") {
            self.radius = Some(radius.number * self.unit());
        }
        if let Some(angle) = w.named("AP") {
            self.angle = match (angle.mark, self.angle) {
                (Mark::Absolute, _) => Some(angle.number),
                (Mark::None, _) if self.m.absolute => Some(angle.number),
                (Mark::None, _) => return self.m.halt("AP under G91 without AC or IC"),
                (_, Some(last)) => Some(last + angle.number),
                (_, None) => None,
            };
        }
        match (self.radius, self.angle) {
            (Some(radius), Some(angle)) if radius >= 0.0 => {
                let turn = angle.to_radians();
                Ok((self.pole.0 + radius * turn.cos(), self.pole.1 + radius * turn.sin()))
            }
            _ => self.m.halt("polar words of which one is missing"),
        }
    }

    /// ANG=: one coordinate of the plane is given, the other follows from the line's angle.
    fn by_angle(
        &mut self,
        angle: f64,
        motion: &Motion,
        axes: &[usize],
        from: Place,
        to: &mut Place,
    ) -> Result<(), Halt> {
        let (first, second, _) = self.m.axes();
        let given: Vec<usize> = axes.iter().copied().filter(|a| *a == first || *a == second).collect();
        let ([own], Motion::Rapid | Motion::Straight, false) = (&given[..], motion, self.suppressed) else {
            return self.m.halt("ANG without a line, or without one coordinate of the plane");
        };
        let other = if *own == first { second } else { first };
        if !self.m.settled[other] {
            return self.m.halt("ANG from a place that is not known");
        }
        let way = |axis: usize| {
            let part = if axis == first { angle.to_radians().cos() } else { angle.to_radians().sin() };
            if part.abs() < 1e-12 { 0.0 } else { part }
        };
        let length = (to[*own] - from[*own]) / way(*own);
        if !length.is_finite() || length < 0.0 {
            return self.m.halt("ANG that does not lead to the coordinate");
        }
        to[other] = from[other] + length * way(other);
        Ok(())
    }

    fn straight(&mut self, from: Place, to: Place) -> Result<(), Halt> {
        self.m.straight(self.machine(to))?;
        let way: [f64; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
        if way.iter().any(|d| d.abs() > 1e-9) {
            self.tangent = (!self.suppressed).then_some(way);
        }
        Ok(())
    }

    /// G2 and G3.
    fn arc(&mut self, w: &Words, axes: &[usize], from: Place, mut to: Place, cw: bool) -> Result<(), Halt> {
        let (first, second, _) = self.m.axes();
        let start = (from[first], from[second]);
        let ended = axes.iter().any(|axis| *axis == first || *axis == second);
        let centre_words: Vec<Option<Value>> = [first, second].map(|k| w.letter(['I', 'J', 'K'][k])).into();
        let given = centre_words.iter().any(Option::is_some);
        let place = |k: usize, from: f64| {
            let Some(value) = centre_words[k] else { return from };
            let number = value.number * self.unit();
            if value.mark == Mark::Absolute { number } else { from + number }
        };
        let centre = (place(0, start.0), place(1, start.1));
        let end = (to[first], to[second]);
        let radius = w.named("CR").map(|v| v.number * self.unit());
        let angle = w.named("AR").map(|v| v.number);
        if angle.is_some_and(|a| a <= 0.0 || a >= 360.0)
            || ["I1", "J1", "K1"].iter().any(|n| w.named(n).is_some())
        {
            return self.m.halt("AR= out of range, or a point on the way");
        }
        let found = match (given, radius, angle) {
            (true, None, None) => Ok(centre),
            (false, Some(r), None) if ended => arcs::by_radius(start, end, r, cw),
            (false, None, Some(angle)) if ended => arcs::by_angle(start, end, angle, cw),
            (true, None, Some(angle)) if !ended => {
                (to[first], to[second]) = arcs::end_of(start, centre, angle, cw);
                Ok(centre)
            }
            _ => Err("an arc of too few words or too many"),
        };
        let turns = w.named("TURN").map_or(Ok(0), |v| self.whole(v.number))?;
        match found {
            Ok(centre) if turns < 1000 => self.circle(from, to, centre, cw, turns),
            Ok(_) => self.m.halt("TURN="),
            Err(why) => self.m.halt(why),
        }
    }

    /// Along a circle in the plane in force, in program coordinates.
    fn circle(
        &mut self,
        from: Place,
        to: Place,
        centre: (f64, f64),
        cw: bool,
        turns: u32,
    ) -> Result<(), Halt> {
        let (first, second, normal) = self.m.axes();
        let Some(reversed) = self.frame.reverses(first, second, normal) else {
            return self.m.halt("a circle that the frame makes an ellipse, or turns out of its plane");
        };
        let mut middle = from;
        (middle[first], middle[second]) = centre;
        let middle = self.machine(middle);
        let mut end = self.machine(to);
        if (from[first] - to[first]).abs() < 1e-9 && (from[second] - to[second]).abs() < 1e-9 {
            // A full circle ends where it began, to the last digit.
            (end[first], end[second]) = (self.m.at[first], self.m.at[second]);
        }
        self.m.arc_of_turns(end, (middle[first], middle[second]), cw != reversed, turns)?;
        let mut tangent = [0.0; 3];
        let (x, y) = (to[first] - centre.0, to[second] - centre.1);
        (tangent[first], tangent[second]) = if cw { (y, -x) } else { (-y, x) };
        self.tangent = Some(tangent);
        Ok(())
    }

    /// CIP.
    fn through_point(&mut self, w: &Words, from: Place, to: Place) -> Result<(), Halt> {
        if w.letters.iter().any(|l| "IJK".contains(l.0)) || w.named.iter().any(|n| !n.0.ends_with('1')) {
            return self.m.halt("CIP and other words than a point on the way");
        }
        let mut via = [0.0; 3];
        for axis in 0..3 {
            via[axis] = match w.named(["I1", "J1", "K1"][axis]) {
                Some(value) => {
                    let number = value.number * self.unit();
                    match value.mark {
                        Mark::None if self.m.absolute => number,
                        Mark::Absolute => number,
                        _ => from[axis] + number,
                    }
                }
                None if (from[axis] - to[axis]).abs() < 1e-9 => from[axis],
                None => return self.m.halt("a point on the way that is not said whole"),
            };
        }
        let flat =
            |axis: usize| (from[axis] - to[axis]).abs() < 1e-9 && (from[axis] - via[axis]).abs() < 1e-9;
        let plane = self.m.plane;
        let planes = [plane, 17, 18, 19];
        let Some(own) = planes.into_iter().find(|p| flat([2, 1, 0][(*p - 17) as usize])) else {
            return self.m.halt("a circle in no plane of the axes");
        };
        self.m.plane = own;
        let (first, second, _) = self.m.axes();
        let point = |p: &[f64]| (p[first], p[second]);
        let result = match arcs::by_three(point(&from), point(&via), point(&to)) {
            Some((centre, cw)) => self.circle(from, to, centre, cw, 0),
            None => self.m.halt("three points of a line"),
        };
        self.m.plane = plane;
        result
    }

    /// CT.
    fn tangential(&mut self, extra: bool, from: Place, to: Place) -> Result<(), Halt> {
        let (first, second, _) = self.m.axes();
        let direction = self.tangent.map(|t| (t[first], t[second]));
        let Some(direction) = direction.filter(|d| !extra && d.0.hypot(d.1) > 1e-9) else {
            return self.m.halt("CT with other words, or after no move at feed in the plane");
        };
        let (start, end) = ((from[first], from[second]), (to[first], to[second]));
        if (start.0 - end.0).hypot(start.1 - end.1) < 1e-9 {
            return self.m.halt("CT and no way to go");
        }
        match arcs::by_tangent(start, end, direction) {
            Some((centre, cw)) => self.circle(from, to, centre, cw, 0),
            None if (end.0 - start.0) * direction.0 + (end.1 - start.1) * direction.1 > 0.0 => {
                self.straight(from, to)
            }
            None => self.m.halt("CT straight back"),
        }
    }
}
