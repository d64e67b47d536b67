//! RS274/NGC programs of the corpus' scope, as the NIST report on its interpreter, version 3, and the
//! documentation of LinuxCNC 2.9 have them (chapters G-Codes, M-Codes, O Codes, Overview), and where
//! these are silent as `reference/canon.md` notes from runs: the order of a block (its section 5) and
//! how a series of holes goes on (its section 6).

mod holes;
mod o_words;
mod parameters;
mod polar;
mod words;

use o_words::Go;
use parameters::Parameters;
use words::Words;

use super::{Corner, Halt, Machine, Per, Place, Setup, Spindle, What, characters};

/// Most programs called one within another.
const DEEPEST: u32 = 10;

/// Runs the main program of a text.
///
/// # Errors
/// The program is wrong, out of scope, or says something that the sources leave open.
pub fn run(text: &[u8], setup: Setup) -> Result<Machine, Halt> {
    let programs = programs(&characters(text));
    let modes = setup.power_on;
    let m = Machine::new(setup);
    let mut control = Control {
        motion: None,
        absolute_centre: false,
        shift_numbers: None,
        return_initial: modes.return_initial,
        initial: None,
        kept: Kept::default(),
        depth: 0,
        parameters: Parameters::found(&m.stored.variables),
        repeats: Vec::new(),
        m,
    };
    let main = programs.first().map_or(&[][..], |p| &p.lines[..]);
    if !matches!(control.program(main, &programs)?, Next::End) {
        control.m.record(What::TextEnd);
    }
    control.m.stored.variables = control.parameters.shared;
    Ok(control.m)
}

/// The main program, or one that stands behind it under a number.
struct Program {
    number: Option<u32>,
    lines: Vec<(usize, String)>,
}

/// Parts a text at the lines of `%` and at those that only number a program.
fn programs(text: &str) -> Vec<Program> {
    let framed = text.lines().map(str::trim).find(|line| !remark(line)).is_some_and(|l| l.starts_with('%'));
    let mut frames = 0;
    let mut programs = vec![Program { number: None, lines: Vec::new() }];
    for (index, line) in text.lines().enumerate() {
        if framed && line.trim().starts_with('%') {
            frames += 1;
            continue;
        }
        if framed && frames != 1 {
            continue;
        }
        let bare: String = line.split(['(', ';']).next().unwrap_or("").split_whitespace().collect();
        let number = bare.strip_prefix(['O', 'o']).and_then(|digits| digits.parse().ok());
        match (number, programs.last_mut()) {
            (Some(number), Some(main))
                if main.number.is_none() && main.lines.iter().all(|l| remark(&l.1)) =>
            {
                main.number = Some(number);
            }
            (Some(_), _) => programs.push(Program { number, lines: Vec::new() }),
            (None, Some(program)) => program.lines.push((index + 1, line.to_owned())),
            (None, None) => {}
        }
    }
    programs
}

/// Whether a line says nothing but remarks.
fn remark(line: &str) -> bool {
    line.split(['(', ';']).next().unwrap_or("").trim().is_empty()
}

/// What a cycle keeps for its next block, millimetres as they were written, and seconds.
#[derive(Clone, Copy, Default)]
struct Kept {
    r: Option<f64>,
    bottom: Option<f64>,
    q: Option<f64>,
    /// Whatever cycle said it.
    p: Option<f64>,
}

struct Control {
    m: Machine,
    /// Motion code in force, tenths; none after G80.
    motion: Option<u32>,
    absolute_centre: bool,
    /// The numbers kept for G92.3; none is known of what an earlier program has left there.
    shift_numbers: Option<Place>,
    return_initial: bool,
    /// Level along the normal axis where the tool stood before the series of cycles in force, in
    /// program coordinates.
    initial: Option<f64>,
    kept: Kept,
    depth: u32,
    parameters: Parameters,
    /// Labels of the repeats that are open, and how many turns are left.
    repeats: Vec<(String, u64)>,
}

enum Next {
    Block,
    Back,
    End,
}

/// Modal groups of G codes; codes of none stand alone.
const GROUPS: [&[u32]; 13] = [
    &[0, 10, 20, 30, 330, 331, 382, 383, 384, 385, 730, 740, 800, 810, 820, 830, 840, 850, 860, 890],
    &[40, 100, 280, 281, 300, 301, 520, 530, 920, 921, 922, 923],
    &[170, 180, 190],
    &[200, 210],
    &[400, 410, 411, 420, 421],
    &[430, 431, 432, 490],
    &[540, 550, 560, 570, 580, 590, 591, 592, 593],
    &[610, 611, 640],
    &[900, 910],
    &[901, 911],
    &[930, 940, 950],
    &[980, 990],
    &[960, 970],
];

/// Modal groups of M codes; switches of the operator's overrides change no move of their own.
const M_GROUPS: [&[u32]; 9] = [
    &[0, 10, 20, 300, 600, 980, 990],
    &[60],
    &[610],
    &[30, 40, 50, 190],
    &[70, 80, 90],
    &[480, 490],
    &[500],
    &[510],
    &[530],
];

fn cycle(code: u32) -> bool {
    matches!(code, 730 | 740 | 810 | 820 | 830 | 840 | 850 | 860 | 890)
}

impl Control {
    /// Runs lines, to their end, a return or the end of all.
    fn program(&mut self, lines: &[(usize, String)], all: &[Program]) -> Result<Next, Halt> {
        let mut at = 0;
        while let Some((line, text)) = lines.get(at) {
            self.m.line = *line;
            if o_words::has_word(text) {
                match self.o_word(lines, at, all)? {
                    Go::To(next) => at = next,
                    Go::Back => return Ok(Next::Back),
                    Go::End => return Ok(Next::End),
                }
                continue;
            }
            match self.block(text, all)? {
                Next::Block => at += 1,
                next => return Ok(next),
            }
        }
        Ok(Next::Block)
    }

    fn unit(&self) -> f64 {
        if self.m.inch { 25.4 } else { 1.0 }
    }

    fn axis_words(&self, words: &Words) -> [Option<f64>; 6] {
        let mut axes = ['X', 'Y', 'Z', 'A', 'B', 'C'].map(|letter| words.get(letter));
        for linear in axes.iter_mut().take(3).flatten() {
            *linear *= self.unit();
        }
        axes
    }

    fn block(&mut self, line: &str, all: &[Program]) -> Result<Next, Halt> {
        let Some(words) = self.words(line)? else { return Ok(Next::Block) };
        self.m.begin_block();
        if let Some(message) = words.message {
            self.m.record(message);
        }
        if words.alarm {
            self.m.record(What::Alarm);
            return Ok(Next::End);
        }
        let (mut g, m) = (words.codes('G'), words.codes('M'));
        // G80 counts for nothing beside another code of motion, nor a second time (rs274, run).
        let others = g.iter().any(|code| *code != 800 && GROUPS[0].contains(code));
        let mut first = !others;
        g.retain(|code| *code != 800 || std::mem::take(&mut first));
        let of = |group: &[u32]| g.iter().copied().find(|code| group.contains(code));
        for group in GROUPS {
            if g.iter().filter(|code| group.contains(code)).count() > 1 {
                return self.m.halt("two G codes of a group");
            }
        }
        for group in M_GROUPS {
            if m.iter().filter(|code| group.contains(code)).count() > 1 {
                return self.m.halt("two M codes of a group");
            }
        }
        if let Some(code) = g.iter().find(|code| !GROUPS.iter().any(|group| group.contains(code))) {
            return self.m.halt(format!("G{}", f64::from(*code) / 10.0));
        }
        if let Some(code) = m.iter().find(|code| !M_GROUPS.iter().any(|group| group.contains(code))) {
            return self.m.halt(format!("M{}", f64::from(*code) / 10.0));
        }
        if m.len() > 4 {
            return self.m.halt("more than four M codes");
        }

        match of(GROUPS[12]) {
            Some(970) => self.m.count_speed(false),
            Some(_) => {
                self.m.count_speed(true);
                self.m.fastest = words.get('D');
                if words.get('S').is_none() {
                    return self.m.halt("G96 without S");
                }
            }
            None => {}
        }

        // Feed, speed and tool; F is in the unit that was in force before the block.
        let mode = of(GROUPS[10]);
        if mode.is_some() {
            // Said anew, it ends the feed as well.
            self.m.feed = None;
        }
        match mode {
            Some(930) => self.m.count_feed(Per::Move),
            Some(940) => self.m.count_feed(Per::Minute),
            Some(_) => self.m.count_feed(Per::Turn),
            None => {}
        }
        if let Some(feed) = words.get('F') {
            self.m.feed = Some(if self.m.per == Per::Move { feed } else { feed * self.unit() });
        }
        if let Some(speed) = words.get('S') {
            self.m.say_speed(speed);
        }
        if let Some(tool) = words.get('T') {
            self.m.selected = Some(tool as u32);
        }
        if m.contains(&60) {
            // The spindle stands for the change.
            let turning = self.m.spindle != Spindle::Stopped;
            self.m.turn(Spindle::Stopped);
            self.m.by_itself.spindle = turning;
            self.m.change_tool()?;
            self.m.by_itself.spindle = false;
        }
        if m.contains(&610) {
            match words.get('Q') {
                Some(tool) if tool >= 0.0 => self.m.store_tool(tool as u32),
                _ => return self.m.halt("M61 without Q"),
            }
        }
        for code in &m {
            match code {
                30 => self.m.turn(Spindle::Clockwise),
                40 => self.m.turn(Spindle::Counterclockwise),
                50 => self.m.turn(Spindle::Stopped),
                190 => {
                    // Without Q the program goes on while the spindle still turns.
                    let (Some(angle), Some(_)) = (words.get('R'), words.get('Q')) else {
                        return self.m.halt("M19 without R and Q");
                    };
                    if words.get('P').is_some_and(|way| way != 0.0) {
                        return self.m.halt("M19 with a sense");
                    }
                    self.m.orient(Some(angle));
                }
                70 => self.m.cool(self.m.coolant.0, true),
                80 => self.m.cool(true, self.m.coolant.1),
                90 => self.m.cool(false, false),
                _ => {}
            }
        }
        let once = of(GROUPS[1]);
        if once == Some(40) {
            let Some(seconds) = words.get('P') else { return self.m.halt("G4 without P") };
            self.m.record(What::Dwell(seconds));
        }

        // Modes.
        self.m.plane = of(GROUPS[2]).map_or(self.m.plane, |code| code / 10);
        self.m.inch = of(GROUPS[3]).map_or(self.m.inch, |code| code == 200);
        match (of(GROUPS[4]), words.get('D')) {
            (Some(400), None) => self.m.go_on(),
            (Some(code @ (411 | 421)), Some(diameter)) => {
                self.m.go_beside_by(code == 411, false, diameter * self.unit())?;
            }
            (Some(411 | 421), None) => return self.m.halt("G41.1 without D"),
            (Some(code), entry) if code != 400 => {
                // Without D the tool in the spindle.
                let entry = entry.map_or(self.m.tool, |entry| Some(entry as u32));
                self.m.go_beside(code == 410, false, Some(entry.unwrap_or(0)))?;
            }
            (None, None) => {}
            (None, Some(_)) if of(GROUPS[12]) == Some(960) => {}
            _ => return self.m.halt("D without G41"),
        }
        let z = words.get('Z').map(|z| z * self.unit());
        let lengthways = matches!(of(GROUPS[5]), Some(431 | 432));
        if lengthways && "ABC".chars().any(|letter| words.get(letter).is_some()) {
            return self.m.halt("G43.1 or G43.2 along a rotary axis");
        }
        match (of(GROUPS[5]), words.get('H')) {
            (Some(code @ (431 | 432)), None) => {
                let by = ['X', 'Y', 'Z'].map(|letter| words.get(letter).map(|value| value * self.unit()));
                match by {
                    [None, None, None] => return self.m.halt("G43.1 or G43.2 without a length"),
                    [None, None, Some(z)] => self.m.use_stated_length(z, code == 432),
                    by => self.m.use_stated_offsets(by, code == 432),
                }
            }
            (Some(432), Some(entry)) if z.is_none() => {
                let length = self.m.length_of(entry as u32);
                self.m.use_stated_length(length, true);
            }
            (Some(430), Some(entry)) => self.m.use_length(entry as u32),
            (Some(430), None) => match self.m.tool {
                Some(tool) => self.m.use_length(tool),
                // A length that nothing is known of: it shows in the first move with it.
                None => self.m.use_length(u32::MAX),
            },
            (Some(_), None) => self.m.use_length(0),
            (None, None) => {}
            (_, Some(_)) => return self.m.halt("H without G43"),
        }
        if let Some(code) = of(GROUPS[6]) {
            self.m.use_offset(if code > 590 { code - 584 } else { code / 10 - 53 });
        }
        match of(GROUPS[7]) {
            Some(610) => self.m.corners = Corner::Through,
            Some(611) => self.m.corners = Corner::Stop,
            Some(_) => self.m.corners = Corner::Rounded,
            None => {}
        }
        self.m.absolute = of(GROUPS[8]).map_or(self.m.absolute, |code| code == 900);
        self.absolute_centre = of(GROUPS[9]).map_or(self.absolute_centre, |code| code == 901);
        self.return_initial = of(GROUPS[11]).map_or(self.return_initial, |code| code == 980);

        // The axis words of a length are its own.
        match lengthways {
            true if of(GROUPS[0]).is_some() || once.is_some() => {
                return self.m.halt("motion beside G43.1 or G43.2");
            }
            true => {}
            false => self.act(&words, of(GROUPS[0]), once)?,
        }

        match m.iter().find(|code| M_GROUPS[0].contains(code)) {
            // What the pallets do is no matter of the axes.
            Some(0 | 600) => self.m.record(What::Stop),
            Some(10) => self.m.record(What::OptionalStop),
            Some(20 | 300) => {
                self.m.switch_off();
                self.m.record(What::End);
                return Ok(Next::End);
            }
            Some(980) => return self.call(&words, all),
            Some(_) if self.depth == 0 => {
                self.m.record(What::BeginsAgain);
                return Ok(Next::End);
            }
            Some(_) => return Ok(Next::Back),
            None => {}
        }
        Ok(Next::Block)
    }

    /// What the axis words of a block are for.
    fn act(&mut self, words: &Words, code: Option<u32>, once: Option<u32>) -> Result<(), Halt> {
        let axes = self.with_polar(words, self.axis_words(words), once == Some(530))?;
        let any = axes.iter().any(Option::is_some);
        if code.is_some_and(|code| !cycle(code)) || self.motion.is_some_and(|motion| !cycle(motion)) {
            self.initial = None;
        }
        match once {
            Some(920) => {
                // The present point gets these coordinates.
                let here = self.here();
                for (axis, word) in axes.into_iter().enumerate() {
                    if let Some(value) = word {
                        let now = here[axis];
                        self.m.slots.origin[axis] += now - value;
                    }
                }
                self.shift_numbers = Some(self.m.slots.origin);
            }
            Some(520) => {
                // While other numbers are kept than are in force, what G52 keeps is not said.
                let alike = self.shift_numbers == Some(self.m.slots.origin);
                for (origin, word) in self.m.slots.origin.iter_mut().zip(axes) {
                    *origin = word.unwrap_or(*origin);
                }
                self.shift_numbers = alike.then_some(self.m.slots.origin);
            }
            Some(921) => (self.m.slots.origin, self.shift_numbers) = ([0.0; 6], Some([0.0; 6])),
            Some(922) => self.m.slots.origin = [0.0; 6],
            Some(923) => match self.shift_numbers {
                Some(numbers) => self.m.slots.origin = numbers,
                None => return self.m.halt("G92.3 with numbers of an earlier program"),
            },
            Some(code @ (280 | 300)) => {
                let way = self.target(axes);
                if way != self.m.at {
                    self.m.traverse(way);
                }
                let stored = self.m.position_of(if code == 280 { 1 } else { 2 });
                let to = std::array::from_fn(|axis| match axes[axis] {
                    None if any => way[axis],
                    _ => stored[axis],
                });
                self.m.traverse(to);
            }
            Some(code @ (281 | 301)) if !any => self.m.store_position(if code == 281 { 1 } else { 2 }),
            Some(281 | 301) => return self.m.halt("G28.1 or G30.1 with axis words"),
            Some(100) => self.table(words, axes)?,
            _ => {
                if code == Some(800) {
                    self.motion = None;
                    if any {
                        return self.m.halt("axis words with G80");
                    }
                    return Ok(());
                }
                let motion = code.or(self.motion);
                let centre = ['I', 'J', 'K'].iter().any(|letter| words.get(*letter).is_some());
                let arc = matches!(motion, Some(20 | 30));
                if code.is_none() && !any && !(arc && centre) {
                    return self.unused(words, once);
                }
                match motion {
                    Some(code) if cycle(code) && once != Some(530) => self.holes(code, words, axes)?,
                    Some(0 | 10) => {
                        if words.get('R').is_some() || centre {
                            return self.m.halt("a centre or radius without an arc");
                        }
                        let to = match once {
                            Some(530) => std::array::from_fn(|i| axes[i].unwrap_or(self.m.at[i])),
                            _ => self.target(axes),
                        };
                        // A code alone only puts itself in force.
                        match motion {
                            _ if !any => {}
                            Some(0) => self.m.traverse(to),
                            _ => self.m.straight(to)?,
                        }
                    }
                    Some(code @ (20 | 30)) if once != Some(530) => self.arc(code, words, axes)?,
                    Some(code @ (330 | 331)) if once.is_none() => {
                        let (along, to) =
                            (axes.iter().filter(|word| word.is_some()).count(), self.target(axes));
                        let Some(lead) = words.get('K').filter(|_| along == 1) else {
                            return self.m.halt("a thread without K, or along several axes");
                        };
                        if words.get('I').or(words.get('J')).or(words.get('R')).is_some() {
                            return self.m.halt("a thread with other words");
                        }
                        match code {
                            330 => self.m.cut_thread(to, lead * self.unit())?,
                            _ => self.m.tap_and_back(to, lead * self.unit())?,
                        }
                    }
                    // It stays in force: bare axis words probe again.
                    Some(code @ 382..=385) if once.is_none() && any => {
                        let to = self.target(axes);
                        self.m.probe(to, code > 383, code % 2 == 0)?;
                    }
                    Some(_) => return self.m.halt("G53 without a straight move"),
                    None => return self.m.halt("axis words and no motion code"),
                }
                self.motion = motion;
            }
        }
        Ok(())
    }

    /// G10: L says which table, P which entry; in force at once.
    fn table(&mut self, words: &Words, axes: [Option<f64>; 6]) -> Result<(), Halt> {
        let whole = |letter| words.get(letter).map(|value| value as u32);
        let (Some(table), Some(entry)) = (whole('L'), whole('P')) else {
            return self.m.halt("G10 without L or P");
        };
        // P0 of L2 and L20 is the offset in force.
        let entry = if entry == 0 && matches!(table, 2 | 20) { self.m.offset } else { entry };
        let radius = words.get('R').map(|r| r * self.unit());
        let turn = words.get('R').unwrap_or(self.m.turn_of(entry));
        match table {
            // R turns the offset; without, it is turned as before.
            2 if (1..=9).contains(&entry) && (words.get('R').is_some() || turn != 0.0) => {
                self.m.store_turned_zero(entry, axes, turn);
            }
            20 if turn != 0.0 || self.m.turn_of(self.m.offset) != 0.0 => {
                return self.m.halt("G10 L20 and a turned offset");
            }
            2 | 20 if (1..=9).contains(&entry) && radius.is_none() => {
                let zero = |axis: usize, value: f64| match table {
                    2 => value,
                    // The present position gets these coordinates.
                    _ if entry == self.m.offset => {
                        self.m.zero_of(entry)[axis] + self.m.at[axis] - self.m.shift(axis) - value
                    }
                    _ => {
                        let own = self.m.zero_of(self.m.offset)[axis];
                        self.m.at[axis] - (self.m.shift(axis) - own) - value
                    }
                };
                let zeros = std::array::from_fn(|axis| axes[axis].map(|value| zero(axis, value)));
                self.m.store_zero(entry, zeros, false);
            }
            1 if axes[3..].iter().all(Option::is_none) => {
                if axes.iter().any(Option::is_some) {
                    self.m.hold_entry(entry);
                }
                self.m.store_aside(entry, [axes[0], axes[1]]);
                if let Some(length) = axes[2] {
                    self.m.store_length(entry, length, false, false)?;
                }
                if let Some(radius) = radius {
                    self.m.store_radius(entry, radius, false, false);
                }
            }
            10 | 11 if axes[3..].iter().all(Option::is_none) && radius.is_none() => {
                self.measure(entry, axes, table == 11)?;
            }
            _ => return self.m.halt("G10 of another kind"),
        }
        Ok(())
    }

    /// G10 L10 and L11: the entry gets offsets by which the tool, called up where it stands, reads the words; L11 in
    /// the coordinates of G59.3, with nothing shifted.
    fn measure(&mut self, entry: u32, axes: [Option<f64>; 6], fixture: bool) -> Result<(), Halt> {
        let offset = if fixture { 9 } else { self.m.offset };
        if self.m.turn_of(offset) != 0.0 || self.m.beside.is_some() {
            return self.m.halt("a tool measured in a turned offset or beside a contour");
        }
        let shift = if fixture { [0.0; 6] } else { self.m.slots.shift() };
        let zero = self.m.zero_of(offset);
        let by = |axis: usize| axes[axis].map(|word| self.m.at[axis] - zero[axis] - shift[axis] - word);
        let (x, y, z) = (by(0), by(1), by(2));
        self.m.hold_entry(entry);
        // Both are put in, the one without a word as it was.
        if x.is_some() || y.is_some() {
            let [own_x, own_y] = self.m.aside_of(entry);
            self.m.store_aside(entry, [x.or(Some(own_x)), y.or(Some(own_y))]);
        }
        match z {
            // What the entry has of wear is in it.
            Some(z) => self.m.store_length(entry, z - self.m.wear_of(entry), false, false),
            None => Ok(()),
        }
    }

    /// Words that nothing in the block uses are an error.
    fn unused(&self, words: &Words, once: Option<u32>) -> Result<(), Halt> {
        let control = words.codes('M').contains(&980);
        let switch = words.codes('M').iter().any(|code| matches!(code, 500 | 510 | 530));
        let path = words.codes('G').contains(&640) || words.codes('M').contains(&610);
        let stop = words.codes('M').contains(&190);
        for (letter, _) in &words.words {
            let used = match letter {
                'P' => once == Some(40) || control || path || switch || stop,
                'L' => control,
                'Q' => path || stop,
                'R' if stop => true,
                'D' => words.codes('G').iter().any(|code| matches!(code, 410 | 420 | 960)),
                'R' | 'I' | 'J' | 'K' | '@' | '^' => false,
                _ => true,
            };
            if !used {
                return self.m.halt(format!("{letter} is used by nothing"));
            }
        }
        Ok(())
    }

    /// A vector of the work offset in force as the machine has it.
    fn turned(&self, [x, y]: [f64; 2], back: bool) -> [f64; 2] {
        let degrees = self.m.turn_of(self.m.offset);
        let (sin, cos) = if back { -degrees } else { degrees }.to_radians().sin_cos();
        [x * cos - y * sin, x * sin + y * cos]
    }

    /// Where the tool stands, in program coordinates: from the offset's zero, turned back with it, less what
    /// G52 and G92 shift.
    fn here(&self) -> Place {
        let mut here: Place = std::array::from_fn(|axis| self.m.at[axis] - self.m.shift(axis));
        if self.m.turn_of(self.m.offset) != 0.0 {
            let origin = self.m.slots.origin;
            let back = self.turned([here[0] + origin[0], here[1] + origin[1]], true);
            (here[0], here[1]) = (back[0] - origin[0], back[1] - origin[1]);
        }
        here
    }

    /// A point of the program in machine coordinates.
    fn machine(&self, point: Place) -> Place {
        let mut at: Place = std::array::from_fn(|axis| point[axis] + self.m.shift(axis));
        let origin = self.m.slots.origin;
        let to = self.turned([point[0] + origin[0], point[1] + origin[1]], false);
        (at[0], at[1]) = (at[0] - point[0] - origin[0] + to[0], at[1] - point[1] - origin[1] + to[1]);
        at
    }

    /// Where axis words lead to.
    fn target(&self, axes: [Option<f64>; 6]) -> Place {
        if self.m.turn_of(self.m.offset) != 0.0 {
            let mut to = self.here();
            for (to, word) in to.iter_mut().zip(axes) {
                *to = word.map_or(*to, |word| if self.m.absolute { word } else { *to + word });
            }
            return self.machine(to);
        }
        std::array::from_fn(|axis| match axes[axis] {
            None => self.m.at[axis],
            Some(value) if self.m.absolute => value + self.m.shift(axis),
            Some(value) => self.m.at[axis] + value,
        })
    }

    fn arc(&mut self, code: u32, words: &Words, axes: [Option<f64>; 6]) -> Result<(), Halt> {
        let (first, second, normal) = self.m.axes();
        let way = ['I', 'J', 'K'].map(|letter| words.get(letter).map(|value| value * self.unit()));
        let to = self.target(axes);
        let clockwise = code == 20;
        let turns = match words.get('P') {
            None => 1.0,
            Some(turns) if turns >= 1.0 && turns.fract() == 0.0 => turns,
            Some(_) => return self.m.halt("P of an arc counts its turns"),
        };
        let centre = match words.get('R').map(|r| r * self.unit()) {
            Some(_) if way.iter().any(Option::is_some) => return self.m.halt("centre and radius"),
            Some(r) => self.m.centre_by_radius(to, r, clockwise)?,
            None if way[normal].is_some() => return self.m.halt("a centre off the plane"),
            None if self.m.turn_of(self.m.offset) != 0.0 => match (way[first], way[second]) {
                // About Z alone X and Y stay a plane.
                (a, b) if normal == 2 && (a.or(b).is_some() && !self.absolute_centre) => {
                    let by = self.turned([a.unwrap_or(0.0), b.unwrap_or(0.0)], false);
                    (self.m.at[0] + by[0], self.m.at[1] + by[1])
                }
                (Some(a), Some(b)) if normal == 2 => {
                    let at = self.machine([a, b, 0.0, 0.0, 0.0, 0.0]);
                    (at[0], at[1])
                }
                _ => return self.m.halt("an arc in a turned offset, in another plane or by half a centre"),
            },
            None => match (way[first], way[second], self.absolute_centre) {
                (None, None, _) => return self.m.halt("an arc without centre and radius"),
                (Some(a), Some(b), true) => (a + self.m.shift(first), b + self.m.shift(second)),
                (_, _, true) => return self.m.halt("half a centre"),
                (a, b, false) => (self.m.at[first] + a.unwrap_or(0.0), self.m.at[second] + b.unwrap_or(0.0)),
            },
        };
        self.m.arc_of_turns(to, centre, clockwise, turns as u32 - 1)
    }

    /// M98: the program of the number P, L times.
    fn call(&mut self, words: &Words, all: &[Program]) -> Result<Next, Halt> {
        let Some(number) = words.get('P').map(|p| p as u32) else { return self.m.halt("M98 without P") };
        let Some(program) = all.iter().skip(1).find(|program| program.number == Some(number)) else {
            return self.m.halt(format!("no program {number}"));
        };
        if self.depth == DEEPEST {
            return self.m.halt("calls too deep");
        }
        for _ in 0..words.get('L').map_or(1, |times| times as u32) {
            self.depth += 1;
            // Numbers are the caller's, names the program's own.
            let names = std::mem::take(&mut self.parameters.levels.last_mut().expect("a level").names);
            let ended = self.program(&program.lines, all)?;
            self.parameters.levels.last_mut().expect("a level").names = names;
            self.depth -= 1;
            if let Next::End = ended {
                return Ok(Next::End);
            }
        }
        Ok(Next::Block)
    }
}
