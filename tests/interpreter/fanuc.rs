//! Fanuc programs of the corpus' scope, from `reference/fanuc.md` alone; and those of a Haas, which
//! differ as its section on close relatives says: the feed's increments, P in seconds where it has a
//! point, L for repetition, five digits, work offsets G110 to G129.

mod machine;
mod macro_b;
mod own;
mod polar;
mod programs;
mod tilt;
mod tools;
mod words;

use macro_b::{Go, Modal, Variables, jump, loops};
use programs::{Program, programs, without_name};

use super::{Corner, Cut, Feeds, Halt, Hole, Machine, Per, Rotary, Setup, Spindle, What, characters};

/// Runs the first program of a text.
///
/// # Errors
/// The program is wrong, out of scope, or says something that the notes leave open.
pub fn run(text: &[u8], setup: Setup) -> Result<Machine, Halt> {
    run_on(text, setup, false)
}

/// Runs the first program of a text on a Haas.
///
/// # Errors
/// As of [`run`].
pub fn run_haas(text: &[u8], setup: Setup) -> Result<Machine, Halt> {
    run_on(text, setup, true)
}

fn run_on(text: &[u8], setup: Setup, haas: bool) -> Result<Machine, Halt> {
    let programs = programs(&characters(text));
    let mut control = Control {
        motion: setup.power_on.motion,
        cycle: None,
        kept: Kept::default(),
        by_point: [None; 6],
        initial: 0.0,
        initial_known: false,
        return_initial: setup.power_on.return_initial,
        depth: 0,
        on: None,
        rigid: false,
        polar: None,
        radius: None,
        entry: setup.codes_at_start[1],
        lead: None,
        variables: Variables::found(haas, &setup.left),
        m: Machine::new(setup),
        steps: 0,
        haas,
        modal: None,
        by_words: None,
        in_modal: false,
        moved: false,
        placed: true,
    };
    let rotary = if haas { Rotary::Diameter } else { Rotary::Degrees };
    let [tool, _] = control.m.setup.codes_at_start;
    (control.m.tool, control.m.selected) = (tool, tool);
    control.m.feeds = Feeds { rotary, arcs_by_radius: !haas, ..Feeds::default() };
    let main = programs.first().map_or(&[][..], |p| &p.blocks[..]);
    if !control.program(main, &programs)? {
        control.m.record(What::TextEnd);
    }
    control.m.stored.variables = control.variables.left();
    control.m.with_corners()
}

/// What a cycle keeps from block to block: a word, and whether it was incremental.
#[derive(Clone, Copy, Default)]
struct Kept {
    r: Option<(f64, bool)>,
    z: Option<(f64, bool)>,
    q: Option<f64>,
    ijk: Option<[f64; 3]>,
    p: Option<f64>,
}

struct Control {
    m: Machine,
    motion: u32,
    cycle: Option<u32>,
    kept: Kept,
    /// By way of which point of the work each axis went to a point of the machine last.
    by_point: [Option<f64>; 6],
    initial: f64,
    /// Whether the program has said where that is.
    initial_known: bool,
    return_initial: bool,
    depth: u32,
    /// The block at which the caller goes on, where M99 names one.
    on: Option<u32>,
    /// M29 was said.
    rigid: bool,
    /// G16 is on: the last point in polar words, if nothing else has moved the plane since.
    polar: Option<Option<(f64, f64)>>,
    /// The D that was said last.
    radius: Option<u32>,
    /// The H that was said last, whether its length counts or not (custom macro: #4111 is modal).
    entry: Option<u32>,
    /// Of G33.
    lead: Option<f64>,
    /// Of the macro language.
    variables: Variables,
    /// How many blocks were run.
    steps: u32,
    haas: bool,
    /// What G66 has called behind each block that moves.
    modal: Option<Modal>,
    /// What G66.1 calls with the words of each block, and how often.
    by_words: Option<(String, u32)>,
    /// Whether that is running: how another within it works is open.
    in_modal: bool,
    /// Whether the block at hand has moved an axis.
    moved: bool,
    /// Z stands at a place of the machine, where no length counts.
    placed: bool,
}

/// A word: its letter, its number and whether that has a decimal point.
type Word = (char, f64, bool);

fn number(words: &[Word], letter: char) -> Option<(f64, bool)> {
    // The last of an address wins.
    words.iter().rev().find(|w| w.0 == letter).map(|w| (w.1, w.2))
}

impl Control {
    /// Runs blocks; true when the program has ended for good.
    fn program(&mut self, blocks: &[(usize, String)], all: &[Program]) -> Result<bool, Halt> {
        self.program_from(blocks, 0, all)
    }

    fn program_from(
        &mut self,
        blocks: &[(usize, String)],
        mut at: usize,
        all: &[Program],
    ) -> Result<bool, Halt> {
        let loops = loops(blocks)?;
        while let Some((line, block)) = blocks.get(at) {
            self.m.line = *line;
            self.look(block);
            at = match self.statement(block)? {
                Go::Not => match self.block_and_macro(block, all)? {
                    Next::Block => match self.on.take() {
                        Some(number) => jump(blocks, &loops, at, number).or_else(|why| self.m.halt(why))?,
                        None => at + 1,
                    },
                    Next::Local(from, times) => match self.local(blocks, at, (from, times), all)? {
                        Next::End => return Ok(true),
                        _ => at + 1,
                    },
                    Next::Back => return Ok(false),
                    Next::End => return Ok(true),
                },
                Go::On => at + 1,
                Go::To(number) => jump(blocks, &loops, at, number).or_else(|why| self.m.halt(why))?,
                Go::Perhaps(number) => match jump(blocks, &loops, at, number) {
                    Ok(to) => to,
                    Err(_) => {
                        self.m.record(What::Alarm);
                        return Ok(true);
                    }
                },
                Go::Alarm => {
                    self.m.record(What::Alarm);
                    return Ok(true);
                }
                Go::Behind => loops.iter().find(|l| l.0 == at).map_or(at, |l| l.1) + 1,
                Go::Again => loops.iter().find(|l| l.1 == at).map_or(at, |l| l.0),
            };
            self.steps += 1;
            if self.steps > 100_000 {
                return self.m.halt("a program without an end");
            }
        }
        Ok(false)
    }

    fn block(&mut self, block: &str, all: &[Program]) -> Result<Next, Halt> {
        let (block, called) = without_name(block);
        let Some(raw) = self.words(&block)? else { return Ok(Next::Block) };
        if raw.contains(&('G', "65")) {
            return self.macro_call(&raw, called.as_deref(), all);
        }
        if raw.contains(&('G', "66")) && !self.haas {
            return self.begin_modal(&raw);
        }
        if raw.contains(&('G', "66.1")) && !self.haas {
            return self.begin_words(&raw, all);
        }
        if self.by_words.is_some() && raw.iter().any(|(letter, _)| *letter != 'N') {
            return self.words_call(&raw, all);
        }
        let words = self.values(&raw).or_else(|why| self.m.halt(why))?;
        // How far corners may be rounded, beside G187.
        let smooth = self.haas && raw.contains(&('G', "187"));
        let known = |letter| "XYZABCIJKRFSTHDPQLGMrc".contains(letter) || smooth && letter == 'E';
        if let Some((letter, ..)) = words.iter().find(|word| !known(word.0)) {
            return self.m.halt(format!("the word {letter}"));
        }
        let codes = |letter: char| -> Vec<u32> {
            words.iter().filter(|w| w.0 == letter).map(|w| (w.1 * 10.0).round() as u32).collect()
        };
        let m_codes = codes('M');
        if m_codes.len() > 1 {
            return self.m.halt("several M codes");
        }
        let m = m_codes.first().map(|m| m / 10);

        let mut dwell = false;
        let mut table = false;
        let mut length = None;
        let mut motion_last = None;
        let mut slot = None;
        let mut machine = None;
        self.m.begin_block();
        let mut side = None;
        for g in codes('G') {
            // High precision and contour control, with P or Q: the programmed path stays.
            if g == 51 {
                continue;
            }
            if matches!(g, 500 | 501 | 510 | 511 | 520 | 680 | 690 | 920) {
                slot = Some(g);
                continue;
            }
            if g == 541 && !self.haas || g == 1540 && self.haas {
                let most = if self.haas { 99 } else { 48 };
                match number(&words, 'P') {
                    Some((p, false)) if (1.0..=f64::from(most)).contains(&p) => {
                        self.m.use_offset(6 + p as u32)
                    }
                    _ => return self.m.halt("a further work offset without its P"),
                }
                continue;
            }
            if self.five_axes(g, &mut length, &mut slot) {
                continue;
            }
            if g % 10 != 0 {
                return self.m.halt(format!("G{}", f64::from(g) / 10.0));
            }
            match g / 10 {
                g @ (0..=3 | 33) => motion_last = Some(g),
                g @ (73 | 74 | 76 | 80..=86 | 89) => motion_last = Some(g),
                4 => dwell = true,
                10 => table = true,
                15 if !self.haas => self.polar = None,
                16 if !self.haas => self.polar = Some(self.polar.flatten()),
                g @ 17..=19 => self.m.plane = g,
                code @ (20 | 21) => self.m.units(code == 20, !self.haas),
                // Every call of its kind is over.
                67 if !self.haas => self.modal = None,
                40 => self.m.go_on(),
                41 => side = Some(true),
                42 => side = Some(false),
                // Its P is of this block: look-ahead asks for no other path.
                5 | 8 => {}
                103 | 187 if self.haas => {}
                // The stroke check moves nothing; with words it would set its limits.
                22 | 23 if !self.haas && self.axis_words(&words) == [None; 6] => {}
                9 => self.m.stop_once = true,
                61 => self.m.corners = Corner::Stop,
                62 | 63 if !self.haas => self.m.corners = Corner::Rounded,
                64 => self.m.corners = Corner::Rounded,
                93 => self.m.count_feed(Per::Move),
                94 => self.m.count_feed(Per::Minute),
                95 => self.m.count_feed(Per::Turn),
                g @ (96 | 97) if g == 97 || !self.haas => self.m.count_speed(g == 96),
                g @ (43 | 49) => length = Some(g),
                g @ (28..=31 | 60) => machine = Some(g),
                53 => machine = Some(53),
                g @ 54..=59 => self.m.use_offset(g - 53),
                g @ 110..=129 if self.haas => self.m.use_offset(g - 103),
                90 => self.m.absolute = true,
                91 => self.m.absolute = false,
                98 => self.return_initial = true,
                99 => self.return_initial = false,
                other => return self.m.halt(format!("G{other}")),
            }
        }

        let leads_away = slot.is_some() || machine.is_some() || matches!(m, Some(98 | 99));
        if self.polar.is_some() && leads_away {
            return self.m.halt("G16, and something that leads away from it");
        }
        match slot {
            Some(500) => {
                self.m.slots.scale = None;
                self.m.use_slots([true, true, true, false, false, false]);
            }
            Some(690) if self.m.plane_set => self.m.leave_plane()?,
            Some(code @ (682 | 531)) => {
                self.plane(code, &words)?;
                return Ok(Next::Block);
            }
            Some(690) => {
                let axes = self.m.slots.rotation.take().map_or([0, 1], |(axes, ..)| axes);
                self.m.use_slots(std::array::from_fn(|axis| axes.contains(&axis)));
            }
            Some(920) if self.highest_speed(&words) => return Ok(Next::Block),
            Some(code) => {
                self.fill(code, &words)?;
                return Ok(Next::Block);
            }
            None => {}
        }
        // In a thread's block, or behind it without another code, F is its lead.
        let threads = motion_last.map_or(self.cycle.is_none() && self.motion == 33, |g| g == 33);
        if let Some((lead, true)) = number(&words, 'F').filter(|_| threads && !self.haas) {
            self.lead = Some(lead * if self.m.inch { 25.4 } else { 1.0 });
            self.m.feed = None;
        } else if let Some((feed, point)) = number(&words, 'F') {
            if threads {
                return self.m.halt("a lead without a point, or on a Haas");
            }
            if !point && self.m.per != Per::Minute {
                return self.m.halt("a feed of a turn or of a move without a point");
            }
            let step = match (point, self.haas, self.m.inch) {
                (true, ..) | (false, false, false) => 1.0,
                (false, false, true) => 0.01,
                (false, true, false) => 0.001,
                (false, true, true) => 0.0001,
            };
            let inch = self.m.inch && self.m.per != Per::Move;
            self.m.feed = Some(feed * step * if inch { 25.4 } else { 1.0 });
        }
        number(&words, 'S').into_iter().for_each(|(speed, _)| self.m.say_speed(speed));
        let waited = self.select(&words);
        match m {
            Some(6 | 16) if self.haas => self.m.change_up_there()?,
            Some(6) => self.change(waited)?,
            Some(7) if self.haas => return self.m.halt("M07: shower coolant"),
            Some(3) => self.m.turn(Spindle::Clockwise),
            Some(4) => self.m.turn(Spindle::Counterclockwise),
            Some(7) => self.m.cool(self.m.coolant.0, true),
            Some(8) => self.m.cool(true, self.m.coolant.1),
            Some(19) => self.stop_at_angle(&words)?,
            Some(88) if self.haas => self.m.record(What::Through(true)),
            // What is switched off is so behind the block's move.
            Some(89) if self.haas => {}
            Some(29) if !self.haas => self.rigid = true,
            // Chips, screen and door: nothing that cuts.
            Some(31 | 33 | 76 | 77 | 80 | 81 | 97) if self.haas => {}
            Some(0 | 1 | 2 | 5 | 9 | 30 | 98 | 99) | None => {}
            Some(other) => return self.m.halt(format!("M{other}")),
        }
        if let Some(code) = length {
            self.m.use_tip(code == 434)?;
        }
        let old = self.standing_length();
        self.length_code(length, number(&words, 'H').map(|(entry, _)| entry as u32))?;
        self.bare_length(length, machine, &words, old)?;
        if let Some((entry, _)) = number(&words, 'D') {
            if self.m.beside.is_some() && self.radius != Some(entry as u32) {
                return self.m.halt("another D under compensation");
            }
            self.radius = Some(entry as u32);
        }
        if let Some(left) = side {
            let (first, second, normal) = self.m.axes();
            let Some(entry) = self.radius else { return self.m.halt("compensation without D") };
            let Some(reversed) = self.m.turn.reverses(first, second, normal) else {
                return self.m.halt("compensation in a frame that makes circles ellipses");
            };
            self.m.go_beside_again(left, reversed, Some(entry))?;
        }

        let tap = matches!(motion_last, Some(74 | 80 | 84));
        if self.rigid && self.cycle.is_none() && !tap && !dwell && m != Some(29) {
            let moves = self.axis_words(&words).iter().any(Option::is_some);
            if moves || number(&words, 'S').is_some() {
                return self.m.halt("a move or a speed between M29 and its tap");
            }
        }

        match motion_last {
            Some(80) => self.end_cycle(),
            Some(cycle @ (73 | 74 | 76 | 81..=89)) => {
                if self.cycle.is_none() {
                    self.initial = self.m.at[2];
                    self.initial_known = self.m.settled[2];
                }
                self.cycle = Some(cycle);
            }
            Some(motion) => {
                self.end_cycle();
                self.motion = motion;
            }
            None => {}
        }

        if table {
            self.table(&words)?;
        } else if dwell {
            self.dwell(&words)?;
        } else if let Some(code) = machine {
            self.moved = true;
            self.machine_point(code, &words)?;
        } else if let Some(cycle) = self.cycle {
            self.hole(cycle, &words)?;
        } else {
            self.go(&words)?;
        }

        match m {
            Some(5) => self.m.turn(Spindle::Stopped),
            Some(9) => self.m.cool(false, false),
            Some(89) => self.m.record(What::Through(false)),
            Some(0) => {
                if self.haas {
                    self.m.switch_off();
                }
                self.m.record(What::Stop);
            }
            Some(1) => self.m.record(What::OptionalStop),
            Some(2 | 30) => {
                if self.haas {
                    self.m.switch_off();
                }
                self.m.record(What::End);
                return Ok(Next::End);
            }
            Some(m) if self.calls_block(m.into(), &words) => return self.local_call(&words),
            Some(98) => return self.call(&words, called.as_deref(), all),
            _ if called.is_some() => return self.m.halt("a name without a call"),
            Some(99) => {
                // In the first program of a text, it goes back to one that is not there.
                self.on = number(&words, 'P').map(|(p, _)| p as u32);
                if self.haas && self.on.is_some() {
                    return Ok(Next::Block);
                }
                if number(&words, 'L').is_some() || self.on.is_some() && self.depth == 0 {
                    return self.m.halt("M99 with L, or with P in the first program");
                }
                return Ok(self.back(all));
            }
            _ => {}
        }
        Ok(Next::Block)
    }

    /// A block that fills a slot; its axis words are the slot's.
    fn fill(&mut self, code: u32, words: &[Word]) -> Result<(), Halt> {
        if !self.m.absolute || self.cycle.is_some() {
            return self.m.halt("a frame under G91 or in a cycle");
        }
        let axes = self.axis_words(words);
        let at = self.m.in_offset();
        let (first, second, _) = self.m.axes();
        let mut changed = axes.map(|word| word.is_some());
        match code {
            520 => self.m.slots.shift_locally(axes),
            920 => {
                let mut slots = self.m.slots.clone();
                slots.set_position(&self.m, at, axes)?;
                self.m.slots = slots;
                // From here on it is known where they are.
                for (settled, named) in self.m.settled.iter_mut().zip(changed) {
                    *settled |= named;
                }
                changed = [false; 6];
            }
            680 => {
                let Some(degrees) = self.angle(words, 'R') else { return self.m.halt("G68 without R") };
                let mut centre = self.m.slots.before_rotation(at);
                for axis in [first, second] {
                    centre[axis] = axes[axis].unwrap_or(centre[axis]);
                }
                self.m.slots.rotation = Some(([first, second], centre, degrees));
                changed = std::array::from_fn(|axis| axis == first || axis == second);
            }
            510 => {
                let factor = |letter| {
                    let (value, point) = number(words, letter)?;
                    Some(if point || self.haas { value } else { value * 0.001 })
                };
                let factors = match (factor('P'), ['I', 'J', 'K'].map(factor)) {
                    (Some(all), [None, None, None]) => [all; 3],
                    (None, [Some(x), Some(y), Some(z)]) => [x, y, z],
                    _ => return self.m.halt("G51 without factors"),
                };
                self.m.slots.scale = None;
                let here = self.m.slots.turn().undo(std::array::from_fn(|i| at[i] - self.m.slots.shift()[i]));
                let centre = std::array::from_fn(|axis| axes[axis].unwrap_or(here[axis]));
                self.m.slots.scale = Some((centre, factors));
                changed = [true, true, true, false, false, false];
            }
            511 => {
                for (line, value) in self.m.slots.mirror.iter_mut().zip(axes) {
                    *line = value.or(*line);
                }
            }
            _ => {
                for (line, value) in self.m.slots.mirror.iter_mut().zip(axes) {
                    *line = line.filter(|_| value.is_none());
                }
            }
        }
        self.m.use_slots(changed);
        Ok(())
    }

    /// G10: L says which table, P which entry; under G91 values are added.
    fn table(&mut self, words: &[Word]) -> Result<(), Halt> {
        let whole = |letter| number(words, letter).map(|(value, _)| value as u32);
        let (Some(table), Some(entry @ 1..)) = (whole('L'), whole('P')) else {
            return self.m.halt("G10 without L, or P0");
        };
        if self.cycle.is_some() {
            return self.m.halt("G10 within a cycle");
        }
        let added = !self.m.absolute;
        let value = self.length(words, 'R');
        match (table, entry, value) {
            (2, 1..=6, None) => self.m.store_zero(entry, self.axis_words(words), added),
            (20, _, None) => self.m.store_zero(6 + entry, self.axis_words(words), added),
            (10 | 11, _, Some(value)) => self.m.store_length(entry, value, table == 11, added)?,
            // On a Haas the value is a diameter.
            (12 | 13, _, Some(value)) => {
                let radius = if self.haas { value / 2.0 } else { value };
                self.m.store_radius(entry, radius, table == 13, added);
            }
            _ => return self.m.halt("G10 of another kind"),
        }
        Ok(())
    }

    fn end_cycle(&mut self) {
        self.cycle = None;
        self.rigid = false;
        self.kept = Kept::default();
    }

    fn axis_words(&self, words: &[Word]) -> [Option<f64>; 6] {
        [
            self.length(words, 'X'),
            self.length(words, 'Y'),
            self.length(words, 'Z'),
            self.angle(words, 'A'),
            self.angle(words, 'B'),
            self.angle(words, 'C'),
        ]
    }

    fn go(&mut self, words: &[Word]) -> Result<(), Halt> {
        let axes = self.axis_words(words);
        let ijk = ['I', 'J', 'K'].map(|letter| self.length(words, letter));
        let r = self.length(words, 'R').filter(|_| number(words, 'M') != Some((19.0, false)));
        let any_centre = ijk.iter().any(Option::is_some) || r.is_some();
        if axes.iter().all(Option::is_none) && !any_centre {
            return Ok(());
        }
        if any_centre && self.motion < 2 {
            return self.m.halt("a centre or radius without an arc");
        }
        self.moved = true;
        let to = self.place(axes, words)?;
        self.m.asked = self.length(words, 'r').map(Cut::Round).or(self.length(words, 'c').map(Cut::Leg));
        match self.motion {
            0 => self.m.traverse(to),
            1 => self.m.straight(to)?,
            2 | 3 if !any_centre && self.m.setup.line_without_centre && !self.haas => self.m.straight(to)?,
            33 => {
                let along = axes.iter().filter(|word| word.is_some()).count();
                let Some(lead) = self.lead.filter(|_| along == 1 && !self.haas) else {
                    return self.m.halt("a thread without a lead, along several axes, or on a Haas");
                };
                self.m.cut_thread(to, lead)?;
            }
            motion => {
                let (first, second, normal) = self.m.axes();
                let turn = self.m.turn;
                let Some(reversed) = turn.reverses(first, second, normal) else {
                    return self.m.halt("a circle that the frame makes an ellipse");
                };
                let clockwise = (motion == 2) != reversed;
                let centre = match r {
                    Some(r) if ijk.iter().all(Option::is_none) => {
                        let r = r * turn.m[first][first].hypot(turn.m[second][first]);
                        self.m.centre_by_radius(to, r, clockwise)?
                    }
                    None if any_centre => {
                        let way = ijk.map(|word| word.unwrap_or(0.0));
                        let along = |i: usize| {
                            self.m.at[i] + turn.m[i][first] * way[first] + turn.m[i][second] * way[second]
                        };
                        (along(first), along(second))
                    }
                    _ => return self.m.halt("an arc without centre, or with centre and radius"),
                };
                self.m.arc(to, centre, clockwise)?;
            }
        }
        Ok(())
    }

    /// A block while a cycle is in force: a hole if it has X, Y, Z, R or another axis.
    fn hole(&mut self, cycle: u32, words: &[Word]) -> Result<(), Halt> {
        let (repeat, other) = if self.haas { ('L', 'K') } else { ('K', 'L') };
        if number(words, other).is_some() && number(words, 'M').is_none() && !self.haas {
            return self.m.halt(format!("{other} in a cycle"));
        }
        // K0, on a Haas L0, stores the data and makes no hole.
        let times = match number(words, repeat) {
            Some((k, _)) if k.fract() != 0.0 => return self.m.halt("a part of a hole"),
            k => k.map_or(1, |(k, _)| k as u32),
        };
        let mut axes = self.axis_words(words);
        let r = self.length(words, 'R');
        if axes.iter().all(Option::is_none) && r.is_none() {
            return Ok(());
        }
        if self.m.plane != 17 {
            return self.m.halt("a cycle out of G17: a parameter decides");
        }
        let incremental = !self.m.absolute;
        if let Some(z) = axes[2].take() {
            self.kept.z = Some((z, incremental));
        }
        if let Some(r) = r {
            self.kept.r = Some((r, incremental));
        }
        if let Some(q) = self.length(words, 'Q') {
            self.kept.q = Some(q.abs());
        }
        match ['I', 'J', 'K'].map(|letter| self.length(words, letter)) {
            [None, None, None] => {}
            [Some(i), Some(j), Some(k)] if self.haas && matches!(cycle, 73 | 83) => {
                self.kept.ijk = Some([i, j, k])
            }
            [None, None, Some(_)] if !self.haas => {}
            _ => return self.m.halt("I J K in a cycle"),
        }
        if self.kept.q.is_some() && self.kept.ijk.is_some() {
            return self.m.halt("Q, and I J K");
        }
        // The P of a call is a program number.
        if let Some((p, point)) =
            number(words, 'P').filter(|_| number(words, 'M').is_none_or(|m| m.0 != 98.0))
        {
            self.kept.p = Some(if self.haas && point { p } else { p * 0.001 });
        }
        let (Some((r, r_inc)), Some((z, z_inc))) = (self.kept.r, self.kept.z) else {
            return self.m.halt("a cycle without Z and R");
        };
        let shift = self.m.shift(2);
        if (r_inc || self.return_initial) && !self.initial_known {
            return self.m.halt("the initial level is not known");
        }
        let r = if r_inc { self.initial + r } else { r + shift };
        let z = if z_inc { r + z } else { z + shift };
        let seconds = self.kept.p.filter(|_| self.haas).unwrap_or(0.0);
        let hole = match (cycle, self.kept.q, self.kept.p) {
            (73 | 83, None, _) if self.kept.ijk.is_some() => {
                Hole::Fewer(self.kept.ijk.unwrap_or_default(), cycle == 73, seconds)
            }
            (81, ..) => Hole::Drill,
            (82, _, Some(p)) => Hole::DrillDwell(p),
            (73, Some(q), _) if q > 0.0 => Hole::Break(q, seconds),
            (83, Some(q), _) if q > 0.0 => Hole::Peck(q, seconds),
            (85, ..) => Hole::Bore(0.0),
            (74 | 84, _, p) => {
                let into = if cycle == 74 { Spindle::Counterclockwise } else { Spindle::Clockwise };
                Hole::Tap(into, self.rigid || self.haas, p.unwrap_or(0.0))
            }
            (76, Some(q), p) => Hole::Fine(q, p.unwrap_or(0.0)),
            (86, ..) => Hole::Stop,
            (89, _, p) => Hole::Bore(p.unwrap_or(0.0)),
            _ => return self.m.halt("a cycle without its Q or P"),
        };
        self.moved = true;
        let back = if self.return_initial { self.initial } else { r };
        for _ in 0..times {
            let to = self.place(axes, words)?;
            if let Hole::Tap(_, true, _) = hole {
                self.m.turn(Spindle::Stopped);
            }
            self.m.traverse(to);
            self.m.hole(hole, r, z, back)?;
        }
        Ok(())
    }
}

enum Next {
    Block,
    /// The blocks from a number on to their return, so often.
    Local(u32, u32),
    Back,
    End,
}
