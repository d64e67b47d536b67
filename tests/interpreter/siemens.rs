//! Sinumerik programs of the corpus' scope, from `reference/siemens.md` and its sources alone.
//!
//! What it takes for granted of the machine: M6 changes and takes edge 1 with it; a tool's length
//! lies along Z in every plane; the plain slash is the first skip level; F stays in millimetres under
//! G70. Not here: rounded corners, frames about other axes than the plane's, patterns out of G17.

pub(super) mod arcs;
mod cycles;
mod flow;
mod formula;
pub(super) mod frame;
mod moves;
mod shape;
mod text;
mod threads;
mod tilt;
mod variables;

use std::collections::BTreeMap;

use super::{ArcFeed, Corner, Cut, Halt, Machine, Per, Place, Setup, Spindle, What, characters};
use frame::Frame;
use text::{ADVICE, Argument, Item, Mark, NOTHING, Unit, Value};
use variables::Variables;

/// Runs the main program of a text.
///
/// # Errors
/// The program is wrong, out of scope, or says something that the notes leave open.
pub fn run(text: &[u8], setup: Setup) -> Result<Machine, Halt> {
    let units = text::units(&characters(text));
    let modes = setup.power_on;
    let mut m = Machine::new(setup);
    (m.tool, m.feeds.arcs) = (modes.tool, ArcFeed::Contour);
    let mut control = Control {
        units: &units,
        motion: None,
        frame: Frame::NONE,
        suppressed: false,
        edge: modes.edge,
        feed_inch: false,
        modal: None,
        modal_call: None,
        uncalled: None,
        tangent: None,
        pole: (0.0, 0.0),
        radius: None,
        angle: None,
        floating: false,
        depth: 0,
        variables: Variables::found(&m.stored.variables),
        bounds: BTreeMap::new(),
        steps: 0,
        m,
    };
    let Some(main) = units.iter().find(|unit| unit.main) else { return control.m.halt("no main program") };
    if control.blocks(main, 0, main.blocks.len())? != Next::End {
        control.m.record(What::TextEnd);
    }
    control.m.stored.variables = control.variables.r;
    control.m.with_corners()
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Motion {
    Rapid,
    Straight,
    Clockwise,
    Counterclockwise,
    ThroughPoint,
    Tangent,
    /// G33, and the sense in which the control turns for a positive lead of G331 and G332.
    Thread(Option<Spindle>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Next {
    Block,
    Back,
    End,
}

struct Control<'a> {
    units: &'a [Unit],
    m: Machine,
    motion: Option<Motion>,
    /// The programmable chain.
    frame: Frame,
    /// Frames and work offset are off in this block.
    suppressed: bool,
    /// Edge of the tool in the spindle.
    edge: u32,
    /// G700: F in inches.
    feed_inch: bool,
    /// The cycle of MCALL.
    modal: Option<cycles::Cycle>,
    /// The subprogram of MCALL, and what it is given: its values where MCALL stands.
    modal_call: Option<(String, Vec<Argument>)>,
    /// Direction in which the last move at feed ended, in program coordinates.
    tangent: Option<[f64; 3]>,
    /// The pole, and the last radius and angle about it.
    pole: (f64, f64),
    radius: Option<f64>,
    angle: Option<f64>,
    /// G63 stands in the block.
    floating: bool,
    depth: u32,
    /// The work offset in force has other values than it counts with.
    uncalled: Option<u32>,
    variables: Variables,
    /// Ends of the FOR loops that were begun, by how deep their program was called and their place in it.
    bounds: BTreeMap<(u32, usize), f64>,
    /// Blocks so far.
    steps: u64,
}

/// The words of a block.
#[derive(Default)]
struct Words<'b> {
    letters: Vec<(char, Value, &'b str)>,
    named: Vec<(&'b str, Value)>,
    names: Vec<&'b str>,
    call: Option<(&'b str, &'b [Argument])>,
    /// A tool by its name.
    tool: Option<&'b str>,
}

/// Whether a G code calls up a work offset.
fn is_offset(code: f64) -> bool {
    (54.0..=57.0).contains(&code) || code == 500.0 || (505.0..=599.0).contains(&code)
}

impl Words<'_> {
    /// Whether anything in the block may move an axis.
    fn may_move(&self) -> bool {
        let moves = |letter: char| AXES.contains(&letter) || "IJK".contains(letter);
        self.call.is_some()
            || !self.named.is_empty()
            || self.letters.iter().any(|(letter, ..)| moves(*letter))
    }

    fn is_empty(&self) -> bool {
        self.letters.is_empty()
            && self.named.is_empty()
            && self.names.is_empty()
            && self.call.is_none()
            && self.tool.is_none()
    }

    fn letter(&self, letter: char) -> Option<Value> {
        self.letters.iter().find(|w| w.0 == letter).map(|w| w.1)
    }

    fn named(&self, name: &str) -> Option<Value> {
        self.named.iter().find(|w| w.0 == name).map(|w| w.1)
    }

    fn name(&self, name: &str) -> bool {
        self.names.contains(&name)
    }
}

const AXES: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
const FRAMES: [&str; 8] = ["TRANS", "ATRANS", "ROT", "AROT", "SCALE", "ASCALE", "MIRROR", "AMIRROR"];
const SUPPRESS: [u32; 2] = [53, 153];
/// Words of an arc.
const CENTRE: [&str; 6] = ["CR", "AR", "TURN", "I1", "J1", "K1"];
/// Polar words.
const POLAR: [&str; 3] = ["AP", "RP", "ANG"];
/// How far from a corner rounding begins; the limit of a speed, and the angle at which the spindle stops; the
/// corner behind a move.
const ROUNDING: [&str; 8] = ["ADIS", "ADISPOS", "LIMS", "SPOS", "RND", "RNDM", "CHF", "CHR"];

impl Control<'_> {
    fn whole(&self, number: f64) -> Result<u32, Halt> {
        if !(0.0..=9999.0).contains(&number) || number.fract() != 0.0 {
            return self.m.halt(format!("a whole number, not {number}"));
        }
        Ok(number as u32)
    }

    /// A block of words.
    fn block(&mut self, items: &[Item]) -> Result<Next, Halt> {
        let mut w = Words::default();
        let mut tables = Vec::new();
        for item in items {
            match item {
                Item::Word(letter, value, written) => {
                    let twice = *letter != 'G' && *letter != 'M' && w.letter(*letter).is_some();
                    if twice
                        || (!AXES.contains(letter) && !"IJK".contains(*letter) && value.mark != Mark::None)
                    {
                        return self.m.halt(format!("{letter} twice, or with AC or IC"));
                    }
                    w.letters.push((*letter, *value, written));
                }
                Item::Named(name, value) => {
                    let centre = ["I1", "J1", "K1", "AP"].contains(&name.as_str());
                    let centre = centre || name == "SPOS" && value.mark == Mark::Absolute;
                    if w.named(name).is_some() || (!centre && value.mark != Mark::None) {
                        return self.m.halt(format!("{name} twice, or with AC or IC"));
                    }
                    w.named.push((name, *value));
                }
                Item::Quoted('T', name) if w.tool.is_none() => w.tool = Some(name),
                Item::Quoted(letter, _) => return self.m.halt(format!("{letter} with a text")),
                Item::Name(name) => w.names.push(name),
                Item::Call(name, arguments) if w.call.is_none() => w.call = Some((name, arguments)),
                Item::Call(..) => return self.m.halt("two calls in a block"),
                Item::Set(..) => {}
                Item::Table(name, which, value) => tables.push((name.as_str(), which, *value)),
            }
        }
        let events = self.m.events.len();
        if !tables.is_empty() {
            if !w.is_empty() {
                return self.m.halt("tables beside other words");
            }
            return self.tables(&tables);
        }
        if let Some(uncalled) = self.uncalled
            && w.may_move()
            && !w.letters.iter().any(|(letter, value, _)| *letter == 'G' && is_offset(value.number))
        {
            return self.m.halt(format!("work offset {uncalled} has new values, and is not called up"));
        }
        if let Some(next) = self.alone(&w)? {
            if w.call.is_some() {
                self.tell_places(events);
            }
            return Ok(next);
        }
        self.words(&w)
    }

    /// Settable frames and tools. A frame that is in force counts with its values when it is called up the next time
    /// (Job planning, frames), a tool's when its edge is: none is to be in use.
    fn tables(&mut self, tables: &[(&str, &Vec<String>, f64)]) -> Result<Next, Halt> {
        let mut at = 0;
        while let Some((name, which, value)) = tables.get(at).copied() {
            at += 1;
            let which: Vec<&str> = which.iter().map(String::as_str).collect();
            let number = which.first().and_then(|number| number.parse::<u32>().ok());
            match (name, number, &which[..]) {
                ("P_UIFR", Some(offset), [_, _, "TR"]) if !self.m.inch => {
                    let mut values = [None; 6];
                    at -= 1;
                    while let Some((_, which, value)) = tables.get(at).filter(|(next, which, _)| {
                        *next == name && which.first().and_then(|n| n.parse().ok()) == Some(offset)
                    }) {
                        let letter = which.get(1).and_then(|axis| axis.chars().next()).unwrap_or(' ');
                        let place = AXES.iter().position(|axis| *axis == letter);
                        match place.filter(|place| values[*place].is_none()) {
                            Some(place) => values[place] = Some(*value),
                            None => return self.m.halt("an axis twice, or none"),
                        }
                        at += 1;
                    }
                    self.m.store_zero(offset, values, false);
                    if offset == self.m.offset {
                        self.uncalled = Some(offset);
                    }
                }
                ("TC_DP3" | "TC_DP12", Some(tool), [_, "1"]) if !self.m.inch => {
                    self.m.store_length(tool, value, name == "TC_DP12", false)?;
                }
                ("TC_DP6" | "TC_DP15", Some(tool), [_, "1"]) if !self.m.inch => {
                    self.m.store_radius(tool, value, name == "TC_DP15", false);
                }
                _ => return self.m.halt(format!("${name} is set")),
            }
        }
        Ok(Next::Block)
    }

    /// The machine does not know the frame, in whose coordinates the program's places are.
    fn tell_places(&mut self, from: usize) {
        for event in from..self.m.events.len() {
            self.m.events[event].program = self.program(self.m.events[event].machine);
        }
    }

    /// Statements that stand alone in their block.
    fn alone(&mut self, w: &Words) -> Result<Option<Next>, Halt> {
        if self.five_axes(w)? {
            return Ok(Some(Next::Block));
        }
        let bare = w.letters.is_empty() && w.named.is_empty();
        if let Some((name, arguments)) = w.call.filter(|call| self.has_program(call.0)) {
            if bare && w.names[..] == ["MCALL"] {
                let fixed = |argument: &Argument| match argument {
                    Argument::Number(number, _) => Argument::Number(*number, None),
                    other => other.clone(),
                };
                let given = arguments.iter().map(fixed).collect();
                (self.modal, self.modal_call) = (None, Some((name.to_owned(), given)));
                return Ok(Some(Next::Block));
            }
            return self.call(name, w, 0, arguments).map(Some);
        }
        if let Some((name, arguments)) = w.call {
            match (name, bare, &w.names[..]) {
                ("MSG", true, []) => {
                    if arguments.len() != 1 || matches!(arguments[0], Argument::Number(..)) {
                        return self.m.halt("MSG of something else than a text");
                    }
                    let cleared = arguments[0] == Argument::Empty;
                    self.m.record(if cleared { What::MessageCleared } else { What::Message });
                }
                (_, true, ["MCALL"]) if cycles::is_cycle(name) => {
                    self.modal = Some(self.cycle(name, arguments)?);
                    self.modal_call = None;
                }
                (_, true, []) if cycles::is_cycle(name) => {
                    if self.modal.is_some() {
                        return self.m.halt("a cycle called while another is modal");
                    }
                    let cycle = self.cycle(name, arguments)?;
                    self.run_cycle(cycle)?;
                }
                // The master spindle is the first one, and a tolerance of the path is advice.
                ("SETMS", true, []) if matches!(arguments, [Argument::Number(n, _)] if *n == 1.0) => {}
                ("CYCLE832", true, []) => {}
                (name, true, []) if NOTHING.contains(&name) => {}
                ("HOLES1" | "HOLES2" | "CYCLE801" | "CYCLE802", true, []) => self.pattern(name, arguments)?,
                _ => return self.m.halt(format!("the call of {name}, or other words beside it")),
            }
            return Ok(Some(Next::Block));
        }
        if let Some((_, value, digits)) = w.letters.iter().find(|l| l.0 == 'L') {
            if digits.is_empty() || value.number.fract() != 0.0 {
                return self.m.halt("L and no number");
            }
            let name = format!("L{digits}");
            if w.names[..] == ["MCALL"] && w.letters.len() == 1 && w.named.is_empty() {
                (self.modal, self.modal_call) = (None, Some((name, Vec::new())));
                return Ok(Some(Next::Block));
            }
            return self.call(&name, w, 1, &[]).map(Some);
        }
        let Some(first) = w.names.first() else { return Ok(None) };
        match *first {
            "SUPA" | "CIP" | "CT" => return Ok(None),
            name if ADVICE.contains(&name) => return Ok(None),
            "MCALL" if bare && w.names.len() == 1 => (self.modal, self.modal_call) = (None, None),
            "MCALL" if bare && w.names.len() == 2 => {
                (self.modal, self.modal_call) = (None, Some((w.names[1].to_owned(), Vec::new())))
            }
            "RET" if bare && w.names.len() == 1 => {
                if self.depth == 0 {
                    return self.m.halt("RET in the main program");
                }
                return Ok(Some(Next::Back));
            }
            "SETMS" if bare && w.names.len() == 1 => {}
            name if FRAMES.contains(&name) && w.names.len() == 1 => self.change_frame(name, w)?,
            name if w.names.len() == 1 => return self.call(name, w, 0, &[]).map(Some),
            name => return self.m.halt(format!("{name} and other names")),
        }
        Ok(Some(Next::Block))
    }

    fn change_frame(&mut self, name: &str, w: &Words) -> Result<(), Halt> {
        let kind = name.strip_prefix('A').unwrap_or(name);
        let scale = if kind == "TRANS" { self.unit() } else { 1.0 };
        let mut by = [None; 3];
        for (letter, value, _) in &w.letters {
            let axis = AXES.iter().position(|a| a == letter).filter(|axis| *axis < 3);
            let (Some(axis), Mark::None) = (axis, value.mark) else {
                return self.m.halt(format!("{name} and {letter}"));
            };
            by[axis] = Some(value.number * scale);
        }
        let angle = w.named("RPL").map(|v| v.number);
        if w.named.len() > usize::from(angle.is_some()) {
            return self.m.halt(format!("{name} and other words"));
        }
        let (first, second, normal) = self.m.axes();
        let inner = match (kind, angle) {
            ("TRANS", None) => Frame::shift(by.map(|v| v.unwrap_or(0.0))),
            ("SCALE", None) if !by.contains(&Some(0.0)) => Frame::factors(by.map(|v| v.unwrap_or(1.0))),
            ("MIRROR", None) => Frame::factors(by.map(|v| if v.is_some() { -1.0 } else { 1.0 })),
            ("ROT", Some(angle)) if by == [None; 3] => Frame::turn(angle, first, second),
            ("ROT", None) => {
                let others = (0..3).any(|axis| axis != normal && by[axis].is_some());
                if others {
                    return self.m.halt("a rotation out of the plane");
                }
                by[normal].map_or(Frame::NONE, |angle| Frame::turn(angle, first, second))
            }
            _ => return self.m.halt(format!("{name} with these words")),
        };
        let before = self.frame;
        self.frame = if name.starts_with('A') { before.then(&inner) } else { inner };
        // What SD 42440 FRAME_OFFSET_INCR_PROG settles is open where an axis is called something else.
        for axis in 0..3 {
            self.m.settled[axis] &= self.frame.agrees(&before, axis);
        }
        Ok(())
    }

    /// Millimetres to a unit of length.
    fn unit(&self) -> f64 {
        if self.m.inch { 25.4 } else { 1.0 }
    }

    /// What lies between program and machine beside the frame.
    fn shift(&self) -> Place {
        let mut shift = if self.suppressed { [0.0; 6] } else { self.m.zero_of(self.m.offset) };
        if !(self.suppressed && self.m.setup.length_suppressed) {
            shift[2] += self.m.length_of_edge(self.m.tool, self.edge);
        }
        if !self.suppressed {
            (0..3).for_each(|axis| shift[axis] += self.m.apart(axis));
        }
        shift
    }

    fn chain(&self) -> Frame {
        if self.suppressed { Frame::NONE } else { self.frame }
    }

    /// Where the machine stands, in program coordinates.
    fn here(&self) -> Place {
        self.program(self.m.at)
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

    fn words(&mut self, w: &Words) -> Result<Next, Halt> {
        self.m.begin_block();
        if w.letters.iter().any(|l| l.0 == 'G' && (110.0..=112.0).contains(&l.1.number)) {
            self.set_pole(w)?;
            return Ok(Next::Block);
        }
        if let Some((letter, ..)) = w.letters.iter().find(|l| !"XYZABCIJKFSTDMG".contains(l.0)) {
            return self.m.halt(format!("the word {letter}"));
        }
        if let Some((name, _)) = w
            .named
            .iter()
            .find(|n| !CENTRE.contains(&n.0) && !ROUNDING.contains(&n.0) && !POLAR.contains(&n.0))
        {
            return self.m.halt(format!("the word {name}"));
        }
        if let Some(name) = w.names.iter().find(|n| !["SUPA", "CIP", "CT"].contains(n) && !ADVICE.contains(n))
        {
            return self.m.halt(format!("{name} among other words"));
        }
        self.suppressed = w.name("SUPA");
        let events = self.m.events.len();
        let result = self.with_modes(w);
        self.tell_places(events);
        self.suppressed = false;
        result
    }

    fn with_modes(&mut self, w: &Words) -> Result<Next, Halt> {
        self.floating = false;
        let dwell = self.modes(w)?;
        let m_codes: Vec<u32> = w
            .letters
            .iter()
            .filter(|l| l.0 == 'M')
            .map(|l| self.whole(l.1.number))
            .collect::<Result<_, _>>()?;
        let axes: Vec<usize> = (0..6).filter(|axis| w.letter(AXES[*axis]).is_some()).collect();
        let centre = w.letters.iter().any(|l| "IJK".contains(l.0))
            || w.named.iter().any(|n| CENTRE.contains(&n.0) || POLAR.contains(&n.0));
        let moves = !axes.is_empty() || centre;
        if dwell {
            let (1, Some(seconds)) = (w.letters.len() - 1, w.letter('F')) else {
                return self.m.halt("G4 and other words than F");
            };
            self.m.record(What::Dwell(seconds.number));
            return Ok(Next::Block);
        }
        if let Some(feed) = w.letter('F') {
            let inch = self.feed_inch && self.m.per != Per::Move;
            self.m.feed = Some(feed.number * if inch { 25.4 } else { 1.0 });
        }
        if let Some(speed) = w.letter('S') {
            self.m.say_speed(speed.number);
        }
        if let Some(limit) = w.named("LIMS") {
            self.m.fastest = Some(limit.number);
        }
        if let Some(tool) = w.letter('T') {
            self.m.selected = Some(self.whole(tool.number)?);
        }
        if let Some(name) = w.tool {
            self.m.selected = Some((self.m.setup.named_tool)(name));
        }
        let edge = w.letter('D').map(|d| self.whole(d.number)).transpose()?;
        if m_codes.contains(&6) {
            // A spindle that stops with it stands after it in either order.
            if moves || m_codes.iter().any(|code| !matches!(code, 5 | 6)) {
                return self.m.halt("M6 with a move or another M");
            }
            let tool = self.m.selected;
            self.take_edge(edge.unwrap_or(1), tool);
            self.m.change_tool()?;
        } else if let Some(edge) = edge {
            self.take_edge(edge, self.m.tool);
        }
        if let Some(angle) = w.named("SPOS") {
            if moves {
                return self.m.halt("SPOS with a move");
            }
            self.m.orient(Some(angle.number));
        }
        // In whichever order they stand, the spindle is told from the coolant by what it does first.
        let mut m_codes = m_codes;
        m_codes.sort_by_key(|code| !matches!(code, 3 | 4));
        self.compensate(w)?;
        for code in &m_codes {
            match code {
                3 => self.m.turn(Spindle::Clockwise),
                4 => self.m.turn(Spindle::Counterclockwise),
                7 => self.m.cool(self.m.coolant.0, true),
                8 => self.m.cool(true, self.m.coolant.1),
                19 if !moves => self.m.orient(None),
                40..=45 => self.m.record(What::Gear(code - 40)),
                5 | 9 if moves => {
                    return self.m.halt("M5 or M9 with a move: machine data decide which is first");
                }
                5 => self.m.turn(Spindle::Stopped),
                9 => self.m.cool(false, false),
                0 | 1 | 2 | 6 | 17 | 30 => {}
                other => return self.m.halt(format!("M{other}")),
            }
        }
        if let Some(radius) = w.named("RNDM") {
            self.m.round_all = Some(radius.number * self.unit()).filter(|r| *r > 0.0);
        }
        if moves {
            if !axes.contains(&self.m.axes().2) && self.motion == Some(Motion::Rapid) && !self.suppressed {
                self.hold_spindle();
            }
            self.ask_corner(w);
            self.go(w, &axes)?;
            if let Some(cycle) = self.modal {
                self.suppressed = false;
                self.run_cycle(cycle)?;
            }
            if let Some((name, given)) = self.modal_call.take() {
                let alone = Words { names: vec![""], ..Words::default() };
                self.call(&name, &alone, 0, &given)?;
                self.modal_call = Some((name, given));
            }
        }
        self.end_codes(&m_codes)
    }

    /// The corner behind the block's move.
    fn ask_corner(&mut self, w: &Words) {
        let word = |name: &str| w.named(name).map(|v| v.number * self.unit());
        let own = word("RND").map(Cut::Round).or(word("CHR").map(Cut::Leg)).or(word("CHF").map(Cut::Long));
        let (first, second, _) = self.m.axes();
        let in_plane = (0..6).all(|axis| axis == first || axis == second || w.letter(AXES[axis]).is_none());
        let rapid = matches!(self.motion, None | Some(Motion::Rapid));
        let all = self.m.round_all.filter(|_| in_plane && !rapid).map(Cut::Round);
        self.m.asked = own.or(all);
    }

    /// G codes and their like; true at G4.
    fn modes(&mut self, w: &Words) -> Result<bool, Halt> {
        let mut seen = Vec::new();
        let mut group = |number: u32| {
            let twice = seen.contains(&number);
            seen.push(number);
            twice
        };
        let mut twice = false;
        let mut dwell = false;
        for (_, value, _) in w.letters.iter().filter(|l| l.0 == 'G') {
            let code = self.whole(value.number)?;
            twice |= match code {
                0..=3 => {
                    self.motion = Some(
                        [Motion::Rapid, Motion::Straight, Motion::Clockwise, Motion::Counterclockwise]
                            [code as usize],
                    );
                    group(1)
                }
                33 | 331 | 332 => {
                    let turns = match code {
                        33 => None,
                        331 => Some(Spindle::Clockwise),
                        _ => Some(Spindle::Counterclockwise),
                    };
                    self.motion = Some(Motion::Thread(turns));
                    group(1)
                }
                63 => {
                    self.floating = true;
                    group(2)
                }
                4 => {
                    dwell = true;
                    group(2)
                }
                17..=19 => {
                    self.m.plane = code;
                    group(6)
                }
                40 => {
                    self.m.go_on();
                    group(7)
                }
                // By the radius of the edge, when the block's D and T are known.
                41 | 42 => group(7),
                93..=95 => {
                    self.m.count_feed([Per::Move, Per::Minute, Per::Turn][code as usize - 93]);
                    self.m.count_speed(false);
                    group(15)
                }
                // The speed of a surface or in turns, and the feed's mode with it.
                96 | 97 | 961 | 971 => {
                    self.m.count_feed(if code < 100 { Per::Turn } else { Per::Minute });
                    self.m.count_speed(code / 10 == 96 || code == 96);
                    group(15)
                }
                9 => {
                    self.m.stop_once = true;
                    group(11)
                }
                60 => {
                    self.m.corners = Corner::Stop;
                    group(10)
                }
                64 | 641..=645 => {
                    self.m.corners = Corner::Rounded;
                    group(10)
                }
                // How near is near enough for a stop.
                601..=603 => group(12),
                // How compensation goes round corners and how it begins, where none is on.
                450 | 451 => group(18),
                460..=462 => group(48),
                290 => group(47),
                code if SUPPRESS.contains(&code) => {
                    self.suppressed = true;
                    group(9)
                }
                54..=57 | 500 | 505..=599 => {
                    self.uncalled = None;
                    self.m.use_offset(if code < 58 { code - 53 } else { code - 500 });
                    group(8)
                }
                70 | 71 | 700 | 710 => {
                    self.m.inch = code % 100 == 70 || code == 700;
                    let feed_inch = code == 700;
                    if feed_inch != self.feed_inch {
                        // A feed without its unit is no feed.
                        self.m.feed = None;
                    }
                    self.feed_inch = feed_inch;
                    group(13)
                }
                90 | 91 => {
                    self.m.absolute = code == 90;
                    group(14)
                }
                other => return self.m.halt(format!("G{other}")),
            };
        }
        for name in &w.names {
            twice |= match *name {
                "CIP" => {
                    self.motion = Some(Motion::ThroughPoint);
                    group(1)
                }
                "CT" => {
                    self.motion = Some(Motion::Tangent);
                    group(1)
                }
                "SUPA" => group(9),
                _ => false,
            };
        }
        if twice { self.m.halt("two codes of a group") } else { Ok(dwell) }
    }
}
