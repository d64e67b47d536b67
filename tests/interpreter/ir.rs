//! Programs in the text form of the neutral program, as its own description has it: the functions
//! with their arguments, procedures, cycles, patterns and frames. No expressions, no loops.

mod cycles;
mod data;
mod moves;
mod text;
mod threads;
mod tilt;

use std::collections::HashMap;

use super::siemens::frame::Frame;
use super::{ArcFeed, Corner, Cut, Halt, Machine, Per, Place, Setup, Spindle, What};
use text::{Line, Token, label, tokens};

/// Runs a program.
///
/// # Errors
/// The program is wrong, or out of scope.
pub fn run(text: &[u8], setup: Setup) -> Result<Machine, Halt> {
    let text = String::from_utf8_lossy(text);
    let mut control = Control {
        motion: setup.power_on.motion,
        return_initial: setup.power_on.return_initial,
        m: Machine::new(setup),
        cycle: None,
        frame: Frame::NONE,
        edge: None,
        machine_once: false,
        probing: None,
        kept: [None; 6],
        by_kept: false,
        without_length: false,
        tangent: None,
        pole: moves::Pole::default(),
        polar: None,
        along: None,
        procedures: HashMap::new(),
        depth: 0,
    };
    let mut main = Vec::new();
    let mut open: Option<(String, Vec<Line>)> = None;
    let mut nested = 0;
    for (index, line) in text.lines().enumerate() {
        control.m.line = index + 1;
        let tokens = tokens(line).or_else(|why| control.m.halt(why))?;
        let Some(first) = tokens.first() else { continue };
        match (first, &mut open) {
            (Token::Name(n), _) if n == "ncc-ir" || n == "program" => {}
            (Token::Name(n), _) if n == "assumed" => control.assume(&tokens)?,
            (Token::Name(n), None) if n == "procedure" => {
                let Some(name) = text::name(tokens.get(1)) else {
                    return control.m.halt("a procedure without a name");
                };
                open = Some((name, Vec::new()));
            }
            (Token::Sign('}'), Some(_)) if nested == 0 => {
                if let Some((name, body)) = open.take() {
                    control.procedures.insert(name, body);
                }
            }
            (first, open) => {
                nested += i32::from(tokens.last() == Some(&Token::Sign('{')));
                nested -= i32::from(*first == Token::Sign('}'));
                let body = open.as_mut().map_or(&mut main, |(_, body)| body);
                body.push((index + 1, tokens));
            }
        }
    }
    if !matches!(control.body(&main)?, Next::End) {
        control.m.record(What::TextEnd);
    }
    control.m.with_corners()
}

enum Next {
    On,
    Back,
    End,
}

struct Control {
    m: Machine,
    motion: u32,
    return_initial: bool,
    cycle: Option<cycles::Cycle>,
    /// The chain of frames.
    frame: Frame,
    /// An edge whose length is in force, of the tool that was in the spindle then; else it is the
    /// length table's.
    edge: Option<(Option<u32>, u32)>,
    /// The move that follows in the block is in machine coordinates.
    machine_once: bool,
    /// The next straight move at feed probes: away from a contact, and whether finding nothing is an error.
    probing: Option<(bool, bool)>,
    /// By way of which points axes went to a point of the machine, and whether the next move goes by them.
    kept: [Option<f64>; 6],
    by_kept: bool,
    /// Whether that is without the tool's length.
    without_length: bool,
    /// Direction in which the last move at feed ended, in program coordinates.
    tangent: Option<[f64; 3]>,
    /// The pole, its plane, and the last radius and angle about it.
    pole: moves::Pole,
    /// Where a polar point puts the axes of the move that follows.
    polar: Option<[(usize, f64); 2]>,
    /// A line by its angle: its plane and the angle.
    along: Option<([usize; 2], f64)>,
    procedures: HashMap<String, Vec<Line>>,
    depth: u32,
}

impl Control {
    fn assume(&mut self, tokens: &[Token]) -> Result<(), Halt> {
        for pair in tokens.windows(2) {
            let Token::Name(fact) = &pair[0] else { continue };
            match (fact.as_str(), &pair[1]) {
                ("distance", Token::Name(v)) => self.m.absolute = v == "absolute",
                ("units", Token::Name(v)) => self.m.inch = v == "inch",
                ("plane", Token::Name(v)) => self.m.plane = self.plane(v)?,
                ("return-level", Token::Name(v)) => self.return_initial = v == "initial",
                ("work-offset", Token::Number(v, _)) => self.m.offset = *v as u32,
                ("length-offset", Token::Number(v, _)) => self.m.entry = *v as u32,
                ("motion", Token::Name(v)) => self.motion = u32::from(v == "feed"),
                _ => {}
            }
        }
        Ok(())
    }

    fn plane(&self, name: &str) -> Result<u32, Halt> {
        match name {
            "XY" => Ok(17),
            "ZX" => Ok(18),
            "YZ" => Ok(19),
            "entry" => Ok(self.m.plane),
            _ => self.m.halt(format!("no plane: {name}")),
        }
    }

    fn body(&mut self, lines: &[Line]) -> Result<Next, Halt> {
        let all = lines;
        let mut skip = 0;
        let mut lines = lines;
        while let [(line, tokens), after @ ..] = lines {
            lines = after;
            let at = all.len() - lines.len() - 1;
            self.m.line = *line;
            self.m.stop_once = false;
            let mut rest = &tokens[..];
            if let [Token::Name(n), Token::Number(times, _), Token::Sign('{')] = rest
                && n == "repeat"
            {
                let mut depth = 1;
                let Some(end) = lines.iter().position(|(_, tokens)| {
                    depth += i32::from(tokens.last() == Some(&Token::Sign('{')));
                    depth -= i32::from(tokens.first() == Some(&Token::Sign('}')));
                    depth == 0
                }) else {
                    return self.m.halt("a body that does not end");
                };
                for _ in 0..*times as u32 {
                    match self.body(&lines[..end])? {
                        Next::On => {}
                        other => return Ok(other),
                    }
                }
                lines = &lines[end + 1..];
                continue;
            }
            let mut joined = false;
            while !rest.is_empty() {
                if let [Token::Sign('&'), after @ ..] = rest {
                    joined = true;
                    rest = after;
                }
                let mut level = if joined { skip } else { 0 };
                if let [Token::Sign('/'), after @ ..] = rest {
                    (level, rest) = match after {
                        [Token::Number(n, _), after @ ..] => (*n as usize, after),
                        after => (1, after),
                    };
                }
                if let [Token::Name(n), after @ ..] = rest
                    && n.starts_with('N')
                    && n[1..].chars().all(|c| c.is_ascii_digit())
                {
                    rest = after;
                }
                if let [Token::Name(n), after @ ..] = rest
                    && n == "said"
                {
                    rest = after;
                }
                let [Token::Name(name), Token::Sign('('), after @ ..] = rest else {
                    return self.m.halt("no function");
                };
                let mut depth = 1;
                let Some(end) = after.iter().position(|t| {
                    depth += match t {
                        Token::Sign('(') => 1,
                        Token::Sign(')') => -1,
                        _ => 0,
                    };
                    depth == 0
                }) else {
                    return self.m.halt("a function without its end");
                };
                let arguments = &after[..end];
                rest = &after[end + 1..];
                if let [Token::Text(_), after @ ..] = rest {
                    rest = after;
                }
                skip = level;
                if level == 0 || !self.m.setup.skip[level] {
                    let next = match name.as_str() {
                        "REPEAT_BLOCKS" => self.again(all, at, arguments)?,
                        "POLAR" => {
                            // The move itself follows, under the same switch.
                            joined = true;
                            self.polar_point(arguments)?;
                            Next::On
                        }
                        name => self.call(name, arguments)?,
                    };
                    match next {
                        Next::On => {}
                        other => return Ok(other),
                    }
                }
                if !rest.is_empty() && rest[0] != Token::Sign('&') && name != "POLAR" {
                    return self.m.halt("words after a function");
                }
            }
        }
        Ok(Next::On)
    }

    /// `REPEAT_BLOCKS(from, times n)` and `REPEAT_BLOCKS(from to last, times n)`: from the last such
    /// label before this line.
    fn again(&mut self, lines: &[Line], at: usize, a: &[Token]) -> Result<Next, Halt> {
        let place = |wanted: &str| lines[..at].iter().rposition(|l| label(l).as_deref() == Some(wanted));
        let from = text::name(a.first()).and_then(|n| place(&n));
        let to = match a.get(1) {
            Some(Token::Name(n)) if n == "to" => text::name(a.get(2)).and_then(|n| place(&n)).map(|l| l + 1),
            _ => Some(at),
        };
        let (Some(from), Some(to)) = (from, to) else { return self.m.halt("a repetition without its label") };
        if from >= to {
            return self.m.halt("a repetition of nothing");
        }
        for _ in 0..self.after(a, "times").unwrap_or(1.0) as u32 {
            match self.body(&lines[from..to])? {
                Next::On => {}
                other => return Ok(other),
            }
        }
        Ok(Next::On)
    }

    /// Millimetres, degrees, seconds, or the bare number.
    fn base(&self, value: f64, unit: &str) -> f64 {
        let inch = unit == "in" || (unit == "u" && self.m.inch);
        if inch { value * 25.4 } else { value }
    }

    /// The number after a word.
    fn after(&self, tokens: &[Token], word: &str) -> Option<f64> {
        let at = tokens.iter().position(|t| matches!(t, Token::Name(n) if n == word))?;
        match tokens.get(at + 1..)? {
            [Token::Number(v, u), ..] => Some(self.base(*v, u)),
            _ => None,
        }
    }

    fn first(&self, tokens: &[Token]) -> Result<f64, Halt> {
        match tokens {
            [Token::Number(v, u)] => Ok(self.base(*v, u)),
            _ => self.m.halt("one number is needed"),
        }
    }

    fn word<'t>(&self, tokens: &'t [Token]) -> Result<&'t str, Halt> {
        match tokens {
            [Token::Name(n)] => Ok(n),
            _ => self.m.halt("one word is needed"),
        }
    }

    /// What lies between program and machine beside the frames.
    fn shift(&self) -> Place {
        let setup = &self.m.setup;
        let mut shift = if self.machine_once { [0.0; 6] } else { self.m.zero_of(self.m.offset) };
        if !self.machine_once {
            let mut slots = self.m.slots.shift();
            if self.m.turn_of(self.m.offset) != 0.0 {
                // It is turned with the offset.
                slots[..3].fill(0.0);
            }
            shift = std::array::from_fn(|axis| shift[axis] + slots[axis] + self.m.apart(axis));
        }
        let none = self.machine_once && self.without_length;
        shift[2] += match self.edge {
            _ if none => 0.0,
            Some((Some(tool), 1)) => {
                self.m.stored_length(tool).unwrap_or_else(|| (setup.edge_length)(Some(tool), 1))
            }
            Some((tool, edge)) => (setup.edge_length)(tool, edge),
            None => self.m.length_of(self.m.entry),
        };
        if !none {
            shift[0] += self.m.aside(0);
            shift[1] += self.m.aside(1);
        }
        shift
    }

    fn chain(&self) -> Frame {
        if self.machine_once {
            return Frame::NONE;
        }
        let inside = self.m.turn.then(&self.frame);
        match self.m.turn_of(self.m.offset) {
            0.0 => inside,
            degrees => {
                let [x, y, z, ..] = self.m.slots.shift();
                Frame::turn(degrees, 0, 1).then(&Frame::shift([x, y, z])).then(&inside)
            }
        }
    }

    /// Machine to program coordinates.
    fn program(&self, place: Place) -> Place {
        let shift = self.shift();
        let mut at: Place = std::array::from_fn(|axis| place[axis] - shift[axis]);
        let xyz = self.chain().undo([at[0], at[1], at[2]]);
        at[..3].copy_from_slice(&xyz);
        at
    }

    /// Program to machine coordinates.
    fn machine(&self, place: Place) -> Place {
        let shift = self.shift();
        let xyz = self.chain().apply([place[0], place[1], place[2]]);
        std::array::from_fn(|axis| shift[axis] + if axis < 3 { xyz[axis] } else { place[axis] })
    }

    /// Where the machine stands, in program coordinates.
    fn here(&self) -> Place {
        self.program(self.m.at)
    }

    /// A length offset: it moves nothing.
    fn take_length(&mut self, edge: Option<(Option<u32>, u32)>, entry: u32) {
        let before = self.shift()[2];
        let of = match edge {
            Some((Some(tool), 1)) => tool,
            Some(_) => 0,
            None => entry,
        };
        self.m.use_aside(self.m.aside_of(of));
        self.edge = edge;
        self.m.entry = entry;
        if self.shift()[2] != before {
            self.unsettle_length();
        }
    }

    /// A length that is in no table, in place of the one in force or added to it.
    fn state_length(&mut self, value: f64, added: bool) {
        let before = self.shift()[2];
        let own = before - self.m.zero_of(self.m.offset)[2] - self.m.slots.shift()[2] - self.m.apart(2);
        self.edge = None;
        self.m.use_stated_length(value + if added { own } else { 0.0 }, false);
        if self.shift()[2] != before {
            self.unsettle_length();
        }
    }

    fn unsettle_length(&mut self) {
        self.m.settled[2] = false;
        if self.frame.turns() {
            self.m.settled[..3].fill(false);
        }
    }

    fn call(&mut self, name: &str, a: &[Token]) -> Result<Next, Halt> {
        match name {
            "COMMENT" | "NO_EFFECT" | "BLANK" | "LABEL" => {}
            "STOP_CUTTER_RADIUS_COMPENSATION" => self.m.go_on(),
            "START_CUTTER_RADIUS_COMPENSATION" => self.compensate(a)?,
            "USE_TOOL_CENTRE_POINT" | "SET_TILT" | "ORIENT_TOOL_AXIS" => self.five_axes(name, a)?,
            "CLEAR_FRAME" if self.word(a)? == "tilt" => self.m.leave_plane()?,
            "CLEAR_FRAME" if self.word(a)? != "chain" => {
                match self.word(a)? {
                    "shift" => (self.m.slots.origin, self.m.slots.aside) = ([0.0; 6], None),
                    "local" => self.m.slots.local = [0.0; 6],
                    "rotation" => self.m.slots.rotation = None,
                    "scale" => self.m.slots.scale = None,
                    "mirror" => self.m.slots.mirror = [None; 3],
                    _ => return self.m.halt("another frame"),
                }
                self.m.use_slots([true; 6]);
            }
            "USE_ORIGIN_SHIFT" => {
                match (self.word(a)?, self.m.slots.aside) {
                    ("off", aside) => {
                        let origin = std::mem::take(&mut self.m.slots.origin);
                        self.m.slots.aside = aside.filter(|_| origin == [0.0; 6]).or(Some(origin));
                    }
                    (_, Some(aside)) => (self.m.slots.origin, self.m.slots.aside) = (aside, None),
                    (_, None) => {}
                }
                self.m.use_slots([true; 6]);
            }
            "SET_SHIFT" | "SET_POSITION" | "SET_ROTATION" | "SET_SCALE" | "SET_MIRROR" | "CLEAR_MIRROR" => {
                self.fill(name, a)?;
            }
            "CLEAR_FRAME" => {
                if self.word(a)? == "chain" {
                    self.use_frame(Frame::NONE);
                }
            }
            "SET_FRAME" => self.set_frame(Frame::NONE, a)?,
            "ADD_FRAME" => self.set_frame(self.frame, a)?,
            "USE_MACHINE_COORDINATES" => {
                self.machine_once = true;
                self.without_length = !a.is_empty();
            }
            "PROBE" => {
                let says = |word: &str| a.iter().any(|t| matches!(t, Token::Name(n) if n == word));
                self.probing = Some((says("no-contact"), says("or-error")));
            }
            // From which side an end is come to is not looked at.
            "DETOUR" => self.by_kept = a.iter().any(|t| matches!(t, Token::Name(n) if n == "intermediate")),
            "GO_TO_REFERENCE" => self.reference(a)?,
            "USE_TOOL_EDGE" => {
                let edge = self.first(a)? as u32;
                self.take_length(Some((self.m.tool, edge)), 0);
            }
            "SET_FEED_MODE" => match self.word(a)? {
                "per-minute" => self.m.count_feed(Per::Minute),
                "per-revolution" => self.m.count_feed(Per::Turn),
                "inverse-time" => self.m.count_feed(Per::Move),
                _ => return self.m.halt("another feed mode"),
            },
            "EXACT_STOP" => self.m.stop_once = true,
            // Which way round leads to the same angle.
            "TURN_ROTARY_AXES" => {}
            "ROUND_CORNER" => self.m.asked = Some(Cut::Round(self.first(a)?)),
            "CHAMFER_CORNER" => self.m.asked = Some(Cut::Leg(self.first(a)?)),
            "CHAMFER_CORNER_BY_LENGTH" => self.m.asked = Some(Cut::Long(self.first(a)?)),
            "SET_MOTION_CONTROL_MODE" => {
                self.m.corners = match a.first() {
                    Some(Token::Text(name)) => match name.as_str() {
                        "exact-stop" => Corner::Stop,
                        "exact-path" => Corner::Through,
                        _ => Corner::Rounded,
                    },
                    _ => return self.m.halt("a path mode without its name"),
                };
            }
            "ADVISE" => self.advise(a),
            "LIMIT_SPINDLE_SPEED" => self.m.fastest = Some(self.first(a)?),
            "ORIENT_SPINDLE" => {
                let angle = if a.is_empty() { None } else { Some(self.first(a)?) };
                self.m.orient(angle);
            }
            "USE_LENGTH_UNITS" => self.m.inch = self.word(a)? == "inch",
            "SET_DISTANCE_MODE" => self.m.absolute = self.word(a)? == "absolute",
            "SELECT_PLANE" => self.m.plane = self.plane(self.word(a)?)?,
            "SET_RETURN_LEVEL" => self.return_initial = self.word(a)? == "initial",
            "SET_ORIGIN_OFFSETS" => {
                let number = self.first(a)? as u32;
                self.m.use_offset(number);
            }
            "SET_OFFSET_DATA" => self.offset_data(a)?,
            "SET_TOOL_DATA" => self.tool_data(a)?,
            "MEASURE_TOOL" => self.measure_tool(a)?,
            "USE_TOOL_OFFSETS" | "ADD_TOOL_OFFSETS" => {
                if self.edge.is_some_and(|(_, edge)| edge != 0) {
                    return self.m.halt("offsets behind an edge");
                }
                self.edge = None;
                let by = ["X", "Y", "Z"].map(|axis| self.after(a, axis));
                self.m.use_stated_offsets(by, name == "ADD_TOOL_OFFSETS");
            }
            "USE_TOOL_LENGTH" | "ADD_TOOL_LENGTH" => {
                let Some(Token::Number(value, unit)) = a.first() else { return self.m.halt("a length") };
                let value = self.base(*value, unit);
                self.state_length(value, name == "ADD_TOOL_LENGTH");
            }
            "ADD_TOOL_LENGTH_OFFSET" => {
                let value = self.m.length_of(self.first(a)? as u32);
                self.state_length(value, true);
            }
            "STORE_POSITION" => {
                let place = self.first(a)? as u32;
                self.m.store_position(place);
            }
            "SET_TOOL_NUMBER" => {
                let tool = self.first(a)? as u32;
                self.m.store_tool(tool);
            }
            "SET_FEED_RATE" => self.m.feed = Some(self.first(a)?),
            "SET_SPINDLE_MODE" => {
                let surface = matches!(a, [Token::Text(mode)] if mode == "surface");
                self.m.count_speed(surface);
            }
            "SET_SPINDLE_SPEED" => {
                let speed = self.first(a)?;
                self.m.say_speed(speed);
            }
            "SELECT_TOOL" => self.m.selected = Some(self.first(a)? as u32),
            "SELECT_TOOL_BY_NAME" => {
                let [Token::Text(name)] = a else { return self.m.halt("a name is needed") };
                self.m.selected = Some((self.m.setup.named_tool)(name));
            }
            "CHANGE_TOOL" => self.m.change_tool()?,
            "USE_TOOL_LENGTH_OFFSET" => {
                let entry = self.first(a)? as u32;
                self.take_length(None, entry);
            }
            "START_SPINDLE_CLOCKWISE" => self.m.turn(Spindle::Clockwise),
            "START_SPINDLE_COUNTERCLOCKWISE" => self.m.turn(Spindle::Counterclockwise),
            "STOP_SPINDLE_TURNING" => self.m.turn(Spindle::Stopped),
            "FLOOD_ON" => self.m.cool(true, self.m.coolant.1),
            "MIST_ON" => self.m.cool(self.m.coolant.0, true),
            "COOLANT_OFF" => self.m.cool(false, false),
            "DWELL" => {
                let seconds = self.first(a)?;
                self.m.record(What::Dwell(seconds));
            }
            "SET_POLE" => self.set_pole(a)?,
            "STRAIGHT_TRAVERSE" | "STRAIGHT_FEED" => {
                self.motion = u32::from(name == "STRAIGHT_FEED");
                self.cycle = None;
                self.go(a)?;
                self.m.begin_block();
            }
            "SYNCHRONISED_FEED" => self.thread(a)?,
            "POSITION" if self.cycle.is_some() => self.hole_word(a)?,
            "POSITION" => self.go(a)?,
            "ARC_FEED" => {
                self.arc(a)?;
                self.m.begin_block();
            }
            "ARC_BY_ANGLE" | "ARC_ABOUT_BY_ANGLE" | "ARC_ABOUT" | "ARC_THROUGH" | "ARC_TANGENT" => {
                self.arc_form(name, a)?;
                self.m.begin_block();
            }
            "START_CYCLE" => self.start(a)?,
            "HOLE" => self.hole_word(a)?,
            "CIRCLE_PATTERN" => self.circle_pattern(a)?,
            "LINE_PATTERN" => self.line(a)?,
            "POSITION_LIST" => self.list(a)?,
            "RECTANGULAR_LAYOUT" => self.grid(a)?,
            "END_CYCLE" => self.cycle = None,
            "MACHINE_FUNCTION" => {
                let [Token::Text(name)] = a else { return self.m.halt("a function without its name") };
                let Some(what) = super::function(name) else { return self.m.halt("a function") };
                self.m.record(what);
            }
            "MESSAGE" => {
                let cleared = matches!(a, [Token::Text(text)] if text.is_empty());
                self.m.record(if cleared { What::MessageCleared } else { What::Message });
            }
            "PROGRAM_STOP" => self.m.record(What::Stop),
            "OPTIONAL_PROGRAM_STOP" => self.m.record(What::OptionalStop),
            "PROGRAM_END" => {
                self.m.record(What::End);
                return Ok(Next::End);
            }
            "BEGIN_AGAIN" => {
                self.m.record(What::BeginsAgain);
                return Ok(Next::End);
            }
            "RETURN" => return Ok(Next::Back),
            "CALL" => return self.procedure(a),
            _ => return self.m.halt(format!("the function {name}")),
        }
        Ok(Next::On)
    }

    /// Side and radius: an entry, that of the tool's number, or that whose length is in force.
    /// What F counts on arcs beside a contour; all other advice changes nothing that can be seen.
    fn advise(&mut self, a: &[Token]) {
        let [Token::Text(kind), Token::Sign(','), Token::Text(value), ..] = a else { return };
        self.m.feeds.arcs = match (kind.as_str(), value.as_str()) {
            ("compensated-feed", "contour") => ArcFeed::Contour,
            ("compensated-feed", "centre") => ArcFeed::Centre,
            ("compensated-feed", "inside") => ArcFeed::Inner,
            _ => return,
        };
    }

    fn compensate(&mut self, a: &[Token]) -> Result<(), Halt> {
        let (first, second, normal) = self.m.axes();
        let Some(reversed) = self.chain().reverses(first, second, normal) else {
            return self.m.halt("compensation in a frame that makes circles ellipses");
        };
        let (left, rest) = match a {
            [Token::Name(side), Token::Sign(','), rest @ ..] if side == "left" || side == "right" => {
                (side == "left", rest)
            }
            _ => return self.m.halt("compensation without its side"),
        };
        if let [Token::Name(n), diameter @ ..] = rest
            && n == "diameter"
        {
            let diameter = self.first(diameter)?;
            return self.m.go_beside_by(left, reversed, diameter);
        }
        let entry = match rest {
            [Token::Name(n)] if n == "tool" => Some(self.m.tool.unwrap_or(0)),
            [Token::Name(n)] if n == "in-force" => match self.edge {
                None => Some(self.m.entry),
                Some((_, 0)) => Some(0),
                Some((tool, 1)) => Some(tool.unwrap_or(0)),
                Some(_) => None,
            },
            _ => Some(self.first(rest)? as u32),
        };
        self.m.go_beside(left, reversed, entry)
    }

    fn procedure(&mut self, a: &[Token]) -> Result<Next, Halt> {
        let Some(name) = text::name(a.first()) else { return self.m.halt("a call without a name") };
        let Some(body) = self.procedures.get(&name).cloned() else {
            return self.m.halt(format!("no procedure {name}"));
        };
        if self.depth == 20 {
            return self.m.halt("calls too deep");
        }
        for _ in 0..self.after(a, "times").unwrap_or(1.0) as u32 {
            self.depth += 1;
            let next = self.body(&body)?;
            self.depth -= 1;
            if matches!(next, Next::End) {
                return Ok(Next::End);
            }
        }
        Ok(Next::On)
    }
}
