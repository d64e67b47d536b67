//! Moves of the neutral program: straight lines, arcs in all forms, and the chain of frames. Places
//! are reckoned in program coordinates and then put into the machine's.

use super::super::siemens::arcs;
use super::super::siemens::frame::Frame;
use super::super::{Halt, Place};
use super::Control;
use super::text::{Token, split};

const AXES: [&str; 6] = ["X", "Y", "Z", "A", "B", "C"];

/// The pole in force, and the last words about it.
#[derive(Clone, Copy, Default)]
pub(super) struct Pole {
    at: (f64, f64),
    radius: Option<f64>,
    angle: Option<f64>,
}

impl Control {
    fn in_plane(&mut self, plane: &[Token]) -> Result<[usize; 2], Halt> {
        let [Token::Name(plane)] = plane else { return self.m.halt("polar words without a plane") };
        let before = self.m.plane;
        self.m.plane = self.plane(plane)?;
        let (first, second, _) = self.m.axes();
        self.m.plane = before;
        Ok([first, second])
    }

    /// `SET_POLE`: from zero, from here or from the last pole, by coordinates or by radius and angle.
    pub(super) fn set_pole(&mut self, a: &[Token]) -> Result<(), Halt> {
        let parts = split(a);
        let [plane, [Token::Name(from)], ..] = parts[..] else { return self.m.halt("a pole") };
        let axes = self.in_plane(plane)?;
        let here = self.here();
        let mut at = match from.as_str() {
            "zero" => (0.0, 0.0),
            "here" => (here[axes[0]], here[axes[1]]),
            _ => self.pole.at,
        };
        if let (Some(radius), Some(angle)) = (self.after(a, "radius"), self.after(a, "angle")) {
            at.0 += radius * angle.to_radians().cos();
            at.1 += radius * angle.to_radians().sin();
        } else {
            at.0 += self.after(a, AXES[axes[0]]).unwrap_or(0.0);
            at.1 += self.after(a, AXES[axes[1]]).unwrap_or(0.0);
        }
        self.pole = Pole { at, radius: None, angle: None };
        Ok(())
    }

    /// `POLAR`: where the move that follows leads in its plane.
    pub(super) fn polar_point(&mut self, a: &[Token]) -> Result<(), Halt> {
        let parts = split(a);
        let axes = self.in_plane(parts.first().copied().unwrap_or_default())?;
        for part in &parts[1..] {
            let [Token::Name(name), rest @ ..] = part else { return self.m.halt("a polar word") };
            let (absolute, rest) = self.distance(rest);
            let [Token::Number(v, u)] = rest else { return self.m.halt("a polar word without a number") };
            let value = self.base(*v, u);
            if name == "along" {
                self.along = Some((axes, value));
                return Ok(());
            }
            let word = if name == "radius" { &mut self.pole.radius } else { &mut self.pole.angle };
            *word = if absolute { Some(value) } else { word.map(|last| last + value) };
        }
        let (Some(radius), Some(angle)) = (self.pole.radius, self.pole.angle) else {
            return self.m.halt("polar words of which one is missing");
        };
        let (sin, cos) = angle.to_radians().sin_cos();
        self.polar =
            Some([(axes[0], self.pole.at.0 + radius * cos), (axes[1], self.pole.at.1 + radius * sin)]);
        Ok(())
    }

    /// Axis words, each with its own measure: `X 1.mm`, `Y inc 2.mm`, `Z entry 3.mm`; the place in
    /// program coordinates, and which axes have a word.
    pub(super) fn target(&mut self, tokens: &[Token]) -> Result<(Place, [bool; 6]), Halt> {
        let from = self.here();
        let mut to = from;
        let mut named = [false; 6];
        for (axis, at) in self.polar.take().into_iter().flatten() {
            to[axis] = at;
            named[axis] = true;
            self.m.settled[axis] = true;
        }
        let mut rest = tokens;
        while !rest.is_empty() {
            if let [Token::Sign(','), after @ ..] = rest {
                rest = after;
            }
            let [Token::Name(letter), after @ ..] = rest else { return self.m.halt("no axis") };
            let Some(axis) = AXES.iter().position(|a| a == letter) else {
                return self.m.halt(format!("no axis: {letter}"));
            };
            let (absolute, after) = self.distance(after);
            let [Token::Number(v, u), after @ ..] = after else { return self.m.halt("no number") };
            let value = self.base(*v, u);
            if absolute {
                to[axis] = value;
                self.m.settled[axis] = !self.machine_once;
            } else if self.machine_once || (!self.m.settled[axis] && value != 0.0) {
                return self.m.halt("an incremental word after a change of offsets or frames");
            } else {
                to[axis] = from[axis] + value;
            }
            named[axis] = true;
            rest = after;
        }
        if let Some((axes, angle)) = self.along.take() {
            let way = [angle.to_radians().cos(), angle.to_radians().sin()];
            let own = match axes.map(|axis| named[axis]) {
                [true, false] => 0,
                [false, true] => 1,
                _ => return self.m.halt("a line by its angle without one coordinate"),
            };
            let (known, sought) = (axes[own], axes[1 - own]);
            if way[own].abs() < 1e-12 || !self.m.settled[sought] {
                return self.m.halt("a line by its angle that leads nowhere");
            }
            let length = (to[known] - from[known]) / way[own];
            if length < 0.0 {
                return self.m.halt("a line by its angle away from its end");
            }
            to[sought] = from[sought] + length * way[1 - own];
            named[sought] = true;
        }
        Ok((to, named))
    }

    /// Whether a word counts from zero, and what stands after its mark.
    fn distance<'t>(&self, tokens: &'t [Token]) -> (bool, &'t [Token]) {
        match tokens {
            [Token::Name(n), after @ ..] if n == "inc" => (false, after),
            [Token::Name(n), after @ ..] if n == "entry" => (self.m.absolute, after),
            _ => (true, tokens),
        }
    }

    pub(super) fn go(&mut self, a: &[Token]) -> Result<(), Halt> {
        if std::mem::take(&mut self.by_kept) {
            let (_, named) = self.target(a)?;
            let mut by = self.m.at;
            for axis in (0..6).filter(|axis| named[*axis]) {
                let Some(kept) = self.kept[axis] else { return self.m.halt("no intermediate point") };
                by[axis] = kept + self.m.shift(axis);
            }
            if by != self.m.at {
                self.m.traverse(by);
            }
        }
        let from = self.here();
        let (to, named) = self.target(a)?;
        let machine = self.machine(to);
        let in_machine = std::mem::take(&mut self.machine_once);
        if !named.contains(&true) {
            return Ok(());
        }
        match self.motion {
            0 => {
                self.m.traverse(machine);
                self.tangent = None;
            }
            1 if self.probing.is_some() => {
                let (away, error) = self.probing.take().unwrap_or_default();
                self.m.probe(machine, away, error)?;
                self.tangent = None;
            }
            1 => {
                self.m.straight(machine)?;
                self.remember(from, to, in_machine);
            }
            _ => return self.m.halt("a position while an arc is in force"),
        }
        Ok(())
    }

    /// A rapid move to the machine's zero, by way of a point; what bare words do stays.
    pub(super) fn reference(&mut self, a: &[Token]) -> Result<(), Halt> {
        let [Token::Name(point), rest @ ..] = a else { return self.m.halt("no point") };
        let (point, rest) = match (point.as_str(), rest) {
            ("home", rest) => ([0.0; 6], rest),
            ("further", [Token::Number(n, _), rest @ ..]) => ((self.m.setup.reference)(*n as u32), rest),
            ("stored", [Token::Number(n, _), rest @ ..]) => (self.m.position_of(*n as u32), rest),
            _ => return self.m.halt(format!("the point {point}")),
        };
        let via = rest.iter().position(|t| matches!(t, Token::Name(n) if n == "via"));
        if let Some(at) = via {
            let open = rest[at..].iter().position(|t| *t == Token::Sign('('));
            let close = rest[at..].iter().position(|t| *t == Token::Sign(')'));
            let (Some(open), Some(close)) = (open, close) else { return self.m.halt("no way") };
            let (to, _) = self.target(&rest[at + open + 1..at + close])?;
            let to = self.machine(to);
            if to != self.m.at {
                self.m.traverse(to);
            }
        }
        let mut to = self.m.at;
        for token in &rest[..via.unwrap_or(rest.len())] {
            if let Token::Name(name) = token
                && let Some(axis) = AXES.iter().position(|a| a == name)
            {
                self.kept[axis] = Some(to[axis] - self.m.shift(axis));
                to[axis] = point[axis];
                self.m.settled[axis] = false;
            }
        }
        if self.frame.turns() {
            self.m.settled[..3].fill(false);
        }
        self.m.traverse(to);
        self.tangent = None;
        Ok(())
    }

    fn remember(&mut self, from: Place, to: Place, in_machine: bool) {
        let way: [f64; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
        if way.iter().any(|d| d.abs() > 1e-9) {
            self.tangent = (!in_machine).then_some(way);
        }
    }

    pub(super) fn arc(&mut self, a: &[Token]) -> Result<(), Halt> {
        let mut parts = split(a).into_iter();
        let (Some([Token::Name(plane)]), Some([Token::Name(turn)])) = (parts.next(), parts.next()) else {
            return self.m.halt("an arc without plane or turn");
        };
        let clockwise = turn == "clockwise";
        let plane_before = self.m.plane;
        let plane = self.plane(plane)?;
        self.cycle = None;
        self.motion = if clockwise { 2 } else { 3 };
        let (mut words, mut centre, mut radius, mut turns): (Vec<Token>, Option<&[Token]>, _, _) =
            (Vec::new(), None, None, 0.0);
        for part in parts {
            match part {
                [Token::Name(n), Token::Sign('('), inner @ .., Token::Sign(')')] if n == "centre" => {
                    centre = Some(inner);
                }
                [Token::Name(n), Token::Number(v, u)] if n == "radius" => radius = Some(self.base(*v, u)),
                [Token::Name(n), Token::Number(v, _)] if n == "turns" => turns = *v,
                part => append(&mut words, part),
            }
        }
        let from = self.here();
        let (to, _) = self.target(&words)?;
        self.m.plane = plane;
        let (first, second, _) = self.m.axes();
        let middle = match (centre, radius) {
            (Some(inner), None) => {
                let from_start = matches!(inner.first(), Some(Token::Name(n)) if n == "start");
                let place = |axis: usize| {
                    let word = self.after(inner, ["I", "J", "K"][axis]);
                    match from_start {
                        true => from[axis] + word.unwrap_or(0.0),
                        false => word.unwrap_or(from[axis]),
                    }
                };
                (place(first), place(second))
            }
            (None, Some(r)) => {
                arcs::by_radius((from[first], from[second]), (to[first], to[second]), r, clockwise)
                    .or_else(|why| self.m.halt(why))?
            }
            _ => return self.m.halt("an arc without a centre"),
        };
        self.circle(from, to, middle, clockwise, turns as u32)?;
        self.m.plane = plane_before;
        Ok(())
    }

    /// `ARC_BY_ANGLE`, `ARC_ABOUT_BY_ANGLE`, `ARC_ABOUT`, `ARC_THROUGH`, `ARC_TANGENT`.
    pub(super) fn arc_form(&mut self, name: &str, a: &[Token]) -> Result<(), Halt> {
        let parts = split(a);
        let Some([Token::Name(plane)]) = parts.first() else { return self.m.halt("an arc without plane") };
        let plane_before = self.m.plane;
        let plane = self.plane(plane)?;
        self.cycle = None;
        let (mut words, mut about, mut via): (Vec<Token>, Option<&[Token]>, Option<&[Token]>) =
            (Vec::new(), None, None);
        let (mut clockwise, mut angle, mut turns) = (false, 0.0, 0.0);
        for part in &parts[1..] {
            match part {
                [Token::Name(n)] if n == "clockwise" => clockwise = true,
                [Token::Name(n)] if n == "counterclockwise" || n == "tangent" => {}
                [Token::Name(n), Token::Number(v, _), after @ ..] if n == "angle" => {
                    angle = *v;
                    if let [Token::Name(_), Token::Name(_), Token::Sign('('), inner @ .., Token::Sign(')')] =
                        after
                    {
                        about = Some(inner);
                    }
                }
                [Token::Name(n), Token::Sign('('), inner @ .., Token::Sign(')')] if n == "centre" => {
                    about = Some(inner);
                }
                [Token::Name(n), Token::Sign('('), inner @ .., Token::Sign(')')] if n == "through" => {
                    via = Some(inner);
                }
                [Token::Name(n), Token::Number(v, _)] if n == "turns" => turns = *v,
                part => append(&mut words, part),
            }
        }
        let from = self.here();
        let (mut to, _) = self.target(&words)?;
        let via = via.map(|inner| self.target(inner)).transpose()?.map(|(place, _)| place);
        self.m.plane = plane;
        let (first, second, _) = self.m.axes();
        let flat = |p: &[f64]| (p[first], p[second]);
        let mut centre = flat(&from);
        if let Some(about) = about {
            for word in split(about) {
                let [Token::Name(letter), value @ ..] = word else { return self.m.halt("no centre") };
                // A centre counts from the start of the arc unless it is said to count from zero.
                let (absolute, value) = match value {
                    [Token::Name(n), after @ ..] if n == "inc" || n == "entry" => (false, after),
                    value => (true, value),
                };
                let [Token::Number(v, u)] = value else { return self.m.halt("no centre") };
                let axis = ["I", "J", "K"].iter().position(|l| l == letter);
                let value = self.base(*v, u);
                let place = |axis: usize| if absolute { value } else { from[axis] + value };
                if axis == Some(first) {
                    centre.0 = place(first);
                } else if axis == Some(second) {
                    centre.1 = place(second);
                }
            }
        }
        let found = match name {
            "ARC_BY_ANGLE" => arcs::by_angle(flat(&from), flat(&to), angle, clockwise).map(Some),
            "ARC_ABOUT_BY_ANGLE" => {
                (to[first], to[second]) = arcs::end_of(flat(&from), centre, angle, clockwise);
                Ok(Some(centre))
            }
            "ARC_ABOUT" => Ok(Some(centre)),
            "ARC_THROUGH" => match via.and_then(|v| arcs::by_three(flat(&from), flat(&v), flat(&to))) {
                Some((centre, cw)) => {
                    clockwise = cw;
                    Ok(Some(centre))
                }
                None => Err("three points of a line"),
            },
            _ => {
                let direction = self.tangent.map(|t| (t[first], t[second]));
                match direction.filter(|d| d.0.hypot(d.1) > 1e-9) {
                    None => Err("a tangent arc after no move at feed in the plane"),
                    Some(d) => Ok(arcs::by_tangent(flat(&from), flat(&to), d).map(|(centre, cw)| {
                        clockwise = cw;
                        centre
                    })),
                }
            }
        };
        match found {
            Ok(Some(centre)) => self.circle(from, to, centre, clockwise, turns as u32)?,
            Ok(None) => {
                let machine = self.machine(to);
                self.m.straight(machine)?;
                self.remember(from, to, false);
            }
            Err(why) => return self.m.halt(why),
        }
        // What a position does after an arc in such a form is not said.
        self.motion = 2;
        self.m.plane = plane_before;
        Ok(())
    }

    /// Along a circle in the plane in force, in program coordinates.
    fn circle(
        &mut self,
        from: Place,
        to: Place,
        centre: (f64, f64),
        clockwise: bool,
        turns: u32,
    ) -> Result<(), Halt> {
        let (first, second, normal) = self.m.axes();
        let Some(reversed) = self.chain().reverses(first, second, normal) else {
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
        self.m.arc_of_turns(end, (middle[first], middle[second]), clockwise != reversed, turns)?;
        let mut tangent = [0.0; 3];
        let (x, y) = (to[first] - centre.0, to[second] - centre.1);
        (tangent[first], tangent[second]) = if clockwise { (y, -x) } else { (-y, x) };
        self.tangent = Some(tangent);
        Ok(())
    }

    /// What fills a slot: `SET_SHIFT` and its like.
    pub(super) fn fill(&mut self, name: &str, a: &[Token]) -> Result<(), Halt> {
        let mut axes = [None; 6];
        let mut centre = [None; 6];
        let mut angle = None;
        let mut kind = "";
        let mut plane = self.m.plane;
        for part in &split(a) {
            match part {
                [Token::Name(n), Token::Sign('('), within @ .., Token::Sign(')')] if n == "centre" => {
                    for part in &split(within) {
                        if let [Token::Name(n), Token::Number(v, u)] = part
                            && let Some(axis) = AXES.iter().position(|a| a == n)
                        {
                            centre[axis] = Some(self.base(*v, u));
                        }
                    }
                }
                [Token::Name(n), Token::Number(v, u)] if AXES.contains(&n.as_str()) => {
                    axes[AXES.iter().position(|a| a == n).unwrap_or(0)] = Some(self.base(*v, u));
                }
                [Token::Name(n)] if AXES.contains(&n.as_str()) => {
                    axes[AXES.iter().position(|a| a == n).unwrap_or(0)] = Some(0.0);
                }
                [Token::Name(n), Token::Number(v, _)] if n == "angle" => angle = Some(*v),
                [Token::Name(n)] if n == "shift" || n == "local" => kind = n,
                [Token::Name(n)] => plane = self.plane(n)?,
                _ => return self.m.halt("another word of a frame"),
            }
        }
        let at = self.m.at;
        let below = self.shift();
        let slots = self.m.slots.shift();
        let at: Place = std::array::from_fn(|i| at[i] - below[i] + slots[i]);
        match (name, angle) {
            ("SET_SHIFT", None) if kind == "local" => self.m.slots.shift_locally(axes),
            ("SET_SHIFT", None) => {
                self.m.slots.aside = None;
                for (origin, value) in self.m.slots.origin.iter_mut().zip(axes) {
                    *origin = value.unwrap_or(*origin);
                }
            }
            ("SET_POSITION", None) => {
                let mut slots = self.m.slots.clone();
                slots.aside = None;
                slots.set_position(&self.m, at, axes)?;
                self.m.slots = slots;
            }
            ("SET_ROTATION", Some(degrees)) => {
                let (first, second) = [(0, 1), (2, 0), (1, 2)][(plane - 17) as usize];
                let mut about = self.m.slots.before_rotation(at);
                for axis in [first, second] {
                    about[axis] = axes[axis].unwrap_or(about[axis]);
                }
                self.m.slots.rotation = Some(([first, second], about, degrees));
            }
            ("SET_SCALE", None) => {
                self.m.slots.scale = None;
                let here = self.m.slots.turn().undo(std::array::from_fn(|i| at[i] - slots[i]));
                let about = std::array::from_fn(|i| centre[i].unwrap_or(here[i]));
                let factors = std::array::from_fn(|i| axes[i].unwrap_or(1.0));
                self.m.slots.scale = Some((about, factors));
            }
            ("SET_MIRROR", None) => {
                for (line, value) in self.m.slots.mirror.iter_mut().zip(axes) {
                    *line = value.or(*line);
                }
            }
            ("CLEAR_MIRROR", None) => {
                for (line, value) in self.m.slots.mirror.iter_mut().zip(axes) {
                    *line = line.filter(|_| value.is_none());
                }
            }
            _ => return self.m.halt("a frame of another kind"),
        }
        self.m.use_slots([name != "SET_POSITION"; 6]);
        Ok(())
    }

    /// `SET_FRAME` after `Frame::NONE`, `ADD_FRAME` after what is in force.
    pub(super) fn set_frame(&mut self, outer: Frame, a: &[Token]) -> Result<(), Halt> {
        let parts = split(a);
        let Some([Token::Name(kind)]) = parts.first() else { return self.m.halt("no frame") };
        let mut by = [None; 3];
        let mut angle = None;
        let mut plane = self.m.plane;
        for part in &parts[1..] {
            match part {
                [Token::Name(n)] if AXES[..3].contains(&n.as_str()) => {
                    by[AXES.iter().position(|a| a == n).unwrap_or(0)] = Some(-1.0);
                }
                [Token::Name(n)] => plane = self.plane(n)?,
                [Token::Name(n), Token::Number(v, u)] if AXES[..3].contains(&n.as_str()) => {
                    by[AXES.iter().position(|a| a == n).unwrap_or(0)] = Some(self.base(*v, u));
                }
                [Token::Number(v, _)] => angle = Some(*v),
                [Token::Name(n), Token::Number(v, _)] if AXES.contains(&n.as_str()) && *v == 0.0 => {}
                _ => return self.m.halt("another word in a frame"),
            }
        }
        let inner = match (kind.as_str(), angle) {
            ("translate", None) => Frame::shift(by.map(|v| v.unwrap_or(0.0))),
            ("scale" | "mirror", None) => Frame::factors(by.map(|v| v.unwrap_or(1.0))),
            ("rotate", Some(angle)) => {
                let (first, second) = [(0, 1), (2, 0), (1, 2)][(plane - 17) as usize];
                Frame::turn(angle, first, second)
            }
            _ => return self.m.halt("a frame of another kind"),
        };
        let frame = outer.then(&inner);
        self.use_frame(frame);
        Ok(())
    }

    /// Another chain: an incremental word of an axis that is called something else by it is undecided.
    pub(super) fn use_frame(&mut self, frame: Frame) {
        for axis in 0..3 {
            self.m.settled[axis] &= frame.agrees(&self.frame, axis);
        }
        self.frame = frame;
    }
}

fn append(words: &mut Vec<Token>, part: &[Token]) {
    if !words.is_empty() {
        words.push(Token::Sign(','));
    }
    words.extend_from_slice(part);
}
