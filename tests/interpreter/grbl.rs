//! Programs of Grbl 1.1, from the reference notes on its source: which code is in which group, the order of a block, and
//! what it refuses. A change of tools by hand is a block of its own, as the notes have it for a writer.

use super::grblhal::{self, Series};
use super::{Halt, Machine, Per, Place, Setup, Spindle, What, characters};

/// Runs a text.
///
/// # Errors
/// The program is wrong, out of scope, or says something that the notes leave open.
pub fn run(text: &[u8], setup: Setup) -> Result<Machine, Halt> {
    run_as(text, setup, None)
}

/// Runs a text as a grblHAL does, one with M6 and a table of tools.
///
/// # Errors
/// As of [`run`].
pub fn run_hal(text: &[u8], setup: Setup) -> Result<Machine, Halt> {
    run_as(text, setup, Some(Series::default()))
}

fn run_as(text: &[u8], setup: Setup, hal: Option<Series>) -> Result<Machine, Halt> {
    let tool = setup.power_on.tool;
    let mut control = Control { m: Machine::new(setup), motion: Some(0), hal };
    if let Some(tool) = tool {
        // The operator has put it in, and set the zero of Z by it.
        control.m.tool = Some(tool);
        control.m.zero_moved = (control.m.setup.put_in)(tool);
    }
    let mut ended = false;
    for (index, line) in characters(text).lines().enumerate() {
        control.m.line = index + 1;
        if !ended {
            ended = control.block(line)?;
        }
    }
    if !ended {
        control.m.record(What::TextEnd);
    }
    Ok(control.m)
}

pub(super) struct Control {
    pub(super) m: Machine,
    /// Motion in force, in tenths; none after G80.
    pub(super) motion: Option<u32>,
    /// Of a grblHAL, what its cycles keep.
    pub(super) hal: Option<Series>,
}

/// Modal groups (table 1.1 of the notes); a block has one code of each.
const GROUPS: [&[u32]; 12] = [
    &[40, 100, 280, 281, 300, 301, 530, 920, 921],
    &[0, 10, 20, 30, 382, 383, 384, 385, 800],
    &[170, 180, 190],
    &[900, 910],
    &[911],
    &[930, 940],
    &[200, 210],
    &[400],
    &[431, 490],
    &[540, 550, 560, 570, 580, 590],
    &[610],
    &[],
];
const M_GROUPS: [&[u32]; 3] = [&[0, 10, 20, 300], &[30, 40, 50], &[70, 80, 90]];

/// Letters and numbers of a line, without remarks and blanks.
pub(super) struct Words(Vec<(char, f64)>);

impl Words {
    pub(super) fn get(&self, letter: char) -> Option<f64> {
        self.0.iter().find(|word| word.0 == letter).map(|word| word.1)
    }

    fn codes(&self, letter: char) -> Vec<u32> {
        self.0.iter().filter(|word| word.0 == letter).map(|word| (word.1 * 10.0).round() as u32).collect()
    }
}

impl Control {
    fn words(&self, line: &str) -> Result<Words, Halt> {
        let mut bare = String::new();
        let mut remark = false;
        // A grblHAL drops the mark where the switch is off.
        let line = if self.hal.is_some() { line.trim_start().trim_start_matches('/') } else { line };
        for c in line.chars() {
            match c {
                ';' if !remark => break,
                '(' if !remark => remark = true,
                ')' if remark => remark = false,
                _ if remark || c.is_whitespace() => {}
                _ => bare.push(c.to_ascii_uppercase()),
            }
        }
        if self.hal.is_none() && bare.len() > 79 || line.len() > 256 {
            return self.m.halt("error 11: a line of more than 79 characters, of a grblHAL 256");
        }
        let mut words: Vec<(char, f64)> = Vec::new();
        let mut rest = &bare[..];
        while let Some(letter) = rest.chars().next() {
            if !"FGIJKLMNPRSTXYZ".contains(letter) && (self.hal.is_none() || !"HQ".contains(letter)) {
                return self.m.halt(format!("{letter} is no word"));
            }
            rest = &rest[1..];
            let end = rest.find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).unwrap_or(rest.len());
            let Ok(value) = rest[..end].parse::<f64>() else { return self.m.halt("error 2: no number") };
            rest = &rest[end..];
            if !matches!(letter, 'G' | 'M') && words.iter().any(|word| word.0 == letter) {
                return self.m.halt(format!("error 25: {letter} twice"));
            }
            words.push((letter, value));
        }
        Ok(Words(words))
    }

    fn block(&mut self, line: &str) -> Result<bool, Halt> {
        if self.hal.is_some() && line.trim_start().starts_with('/') && self.m.setup.skip[1] {
            return Ok(false);
        }
        let words = self.words(line)?;
        if words.0.is_empty() {
            return Ok(false);
        }
        self.m.begin_block();
        let (g, m) = (words.codes('G'), words.codes('M'));
        let own = if self.hal.is_some() { grblhal::GROUPS } else { GROUPS };
        let of = |group: usize| g.iter().copied().find(|code| own[group].contains(code));
        let own_m = if self.hal.is_some() { grblhal::M_GROUPS } else { &M_GROUPS };
        for (codes, groups) in [(&g, &own[..]), (&m, own_m)] {
            if groups.iter().any(|group| codes.iter().filter(|code| group.contains(code)).count() > 1) {
                return self.m.halt("error 21: two codes of a modal group");
            }
            if let Some(code) = codes.iter().find(|code| !groups.iter().any(|group| group.contains(code))) {
                return self.m.halt(format!("error 20: code {}", f64::from(*code) / 10.0));
            }
        }
        if self.change(&words, &g, &m)? {
            return Ok(false);
        }
        // Units count for the words of their own block, F too.
        self.m.inch = of(6).map_or(self.m.inch, |code| code == 200);
        let unit = if self.m.inch { 25.4 } else { 1.0 };
        if let Some(mode) = of(5) {
            self.m.count_feed(if mode == 930 { Per::Move } else { Per::Minute });
        }
        if let Some(feed) = words.get('F') {
            self.m.feed = Some(if self.m.per == Per::Move { feed } else { feed * unit });
        }
        if let Some(speed) = words.get('S') {
            self.m.say_speed(speed);
        }
        if let Some(tool) = words.get('T') {
            self.m.selected = Some(tool as u32);
        }
        self.hal_tools(&words, &m)?;
        for code in &m {
            match code {
                30 => self.m.turn(Spindle::Clockwise),
                40 => self.m.turn(Spindle::Counterclockwise),
                50 => self.m.turn(Spindle::Stopped),
                _ => {}
            }
        }
        for code in &m {
            match code {
                70 => self.m.cool(self.m.coolant.0, true),
                80 => self.m.cool(true, self.m.coolant.1),
                90 => self.m.cool(false, false),
                _ => {}
            }
        }
        let once = of(0);
        if once == Some(40) {
            let Some(seconds) = words.get('P') else { return self.m.halt("error 28: G4 without P") };
            self.m.record(What::Dwell(seconds));
        }
        self.m.plane = of(2).map_or(self.m.plane, |code| code / 10);
        let length = of(8);
        match (length, words.get('Z')) {
            (Some(490), _) => self.m.use_length(0),
            (Some(430), _) => self.hal_length(&words)?,
            (Some(431), Some(z)) => self.m.use_stated_length(z * unit, false),
            (Some(_), _) => return self.m.halt("error 37: G43.1 without Z"),
            (None, _) => {}
        }
        match of(9) {
            Some(code @ 591..) => self.m.use_offset(code - 584),
            Some(code) => self.m.use_offset(code / 10 - 53),
            None => {}
        }
        self.m.absolute = of(3).map_or(self.m.absolute, |code| code == 900);
        let axes = ['X', 'Y', 'Z'].map(|letter| words.get(letter).map(|value| value * unit));
        let axes = [axes[0], axes[1], axes[2], None, None, None];
        let own = usize::from(length == Some(431));
        let others = axes.iter().flatten().count() > own || of(1).is_some_and(|code| code != 800);
        if matches!(length, Some(431 | 490)) && (others || matches!(once, Some(100 | 280 | 300 | 920))) {
            return self.m.halt("error 24: two commands of axes");
        }
        let axes = if matches!(length, Some(431 | 490)) { [None; 6] } else { axes };
        if let Some(series) = &mut self.hal {
            series.to_r = of(11).map_or(series.to_r, |code| code == 990);
        }
        self.act(&words, axes, of(1), once, unit)?;
        self.level_lost(
            of(1).is_some()
                || axes.iter().any(Option::is_some) && !matches!(once, Some(100 | 280 | 300 | 920)),
        );
        match m.iter().find(|code| own_m[0].contains(code)) {
            Some(0 | 600) => self.m.record(What::Stop),
            Some(10) if self.hal.is_some() => self.m.record(What::OptionalStop),
            Some(20 | 300) => {
                self.m.switch_off();
                self.m.record(What::End);
                return Ok(true);
            }
            // M1 is passed over.
            Some(_) | None => {}
        }
        Ok(false)
    }

    /// The block of a change by hand: it says all that happens.
    fn change(&mut self, words: &Words, g: &[u32], m: &[u32]) -> Result<bool, Halt> {
        let has = |codes: &[u32], wanted: &[u32]| {
            codes.len() == wanted.len() && wanted.iter().all(|code| codes.contains(code))
        };
        let others = words.0.iter().filter(|word| !matches!(word.0, 'G' | 'M' | 'N')).count();
        let Some(tool) = words.get('T').filter(|_| others == 2 && words.get('Z') == Some(0.0)) else {
            return Ok(false);
        };
        if !has(g, &[0, 530]) || !has(m, &[0, 50, 90]) {
            return Ok(false);
        }
        self.m.selected = Some(tool as u32);
        self.motion = Some(0);
        self.m.change_up_there()?;
        Ok(true)
    }

    pub(super) fn target(&self, axes: [Option<f64>; 6]) -> Place {
        std::array::from_fn(|axis| match axes[axis] {
            None => self.m.at[axis],
            Some(value) if self.m.absolute => value + self.m.shift(axis),
            Some(value) => self.m.at[axis] + value,
        })
    }

    fn act(
        &mut self,
        words: &Words,
        axes: [Option<f64>; 6],
        code: Option<u32>,
        once: Option<u32>,
        unit: f64,
    ) -> Result<(), Halt> {
        let any = axes.iter().any(Option::is_some);
        match once {
            Some(920) => {
                for (axis, word) in axes.into_iter().enumerate() {
                    if let Some(value) = word {
                        let here = self.m.at[axis] - self.m.shift(axis);
                        self.m.slots.origin[axis] += here - value;
                    }
                }
            }
            Some(921) => self.m.slots.origin = [0.0; 6],
            Some(code @ (280 | 300)) => {
                let way = self.target(axes);
                if way != self.m.at {
                    self.m.traverse(way);
                }
                let stored = self.m.position_of(if code == 280 { 1 } else { 2 });
                let mut to = self.m.at;
                for axis in 0..3 {
                    if axes[axis].is_some() || !any {
                        to[axis] = stored[axis];
                    }
                }
                self.m.traverse(to);
            }
            Some(code @ (281 | 301)) => self.m.store_position(if code == 281 { 1 } else { 2 }),
            Some(100) => self.table(words, axes)?,
            Some(_) | None => self.moves(words, axes, code, once == Some(530), unit)?,
        }
        Ok(())
    }

    fn moves(
        &mut self,
        words: &Words,
        axes: [Option<f64>; 6],
        code: Option<u32>,
        machine: bool,
        unit: f64,
    ) -> Result<(), Halt> {
        let any = axes.iter().any(Option::is_some);
        if code == Some(800) {
            self.motion = None;
            return if any { self.m.halt("error 31: axis words with G80") } else { Ok(()) };
        }
        let before = self.motion;
        self.motion = code.or(self.motion);
        if let Some(code @ (730 | 810..=830)) = self.motion {
            if machine {
                return self.m.halt("error 30: G53 without G0 or G1");
            }
            return self.hal_cycle(code, before != self.motion, words, axes, unit);
        }
        if !any {
            let arc =
                matches!(code, Some(20 | 30)) || "IJKR".chars().any(|letter| words.get(letter).is_some());
            return if arc { self.m.halt("error 26: an arc without an end") } else { Ok(()) };
        }
        match self.motion {
            Some(code @ (0 | 10)) => {
                let to = match machine {
                    true => std::array::from_fn(|axis| axes[axis].unwrap_or(self.m.at[axis])),
                    false => self.target(axes),
                };
                if code == 0 {
                    self.m.traverse(to);
                    return Ok(());
                }
                self.m.straight(to)
            }
            Some(_) if machine => self.m.halt("error 30: G53 without G0 or G1"),
            Some(code @ (20 | 30)) => self.arc(words, axes, code == 20, unit),
            Some(code @ 382..=385) => {
                let to = self.target(axes);
                self.m.probe(to, code > 383, code % 2 == 0)
            }
            _ => self.m.halt("error 31: axis words after G80"),
        }
    }

    fn arc(&mut self, words: &Words, axes: [Option<f64>; 6], clockwise: bool, unit: f64) -> Result<(), Halt> {
        let (first, second, _) = self.m.axes();
        if axes[first].is_none() && axes[second].is_none() {
            return self.m.halt("error 32: no end in the plane");
        }
        let to = self.target(axes);
        let way = ['I', 'J', 'K'].map(|letter| words.get(letter).map(|value| value * unit));
        let centre = match words.get('R') {
            Some(r) => self.m.centre_by_radius(to, r * unit, clockwise)?,
            // A word of the third axis is passed over.
            None if way[first].or(way[second]).is_none() => {
                return self.m.halt("error 35: no centre in the plane");
            }
            None => {
                (self.m.at[first] + way[first].unwrap_or(0.0), self.m.at[second] + way[second].unwrap_or(0.0))
            }
        };
        self.m.arc_of_turns(to, centre, clockwise, 0)
    }

    /// G10 L2 and L20: P0 is the offset in force.
    fn table(&mut self, words: &Words, axes: [Option<f64>; 6]) -> Result<(), Halt> {
        let (Some(table), Some(entry)) = (words.get('L'), words.get('P')) else {
            return self.m.halt("error 28: G10 without L or P");
        };
        let entry = if entry == 0.0 { self.m.offset } else { entry as u32 };
        let last = if self.hal.is_some() { 9 } else { 6 };
        if !(1..=last).contains(&entry) || words.get('R').is_some() || !matches!(table as u32, 2 | 20) {
            return self.m.halt("G10 of another kind");
        }
        let own = self.m.zero_of(self.m.offset);
        let zero = |axis: usize, value: f64| match table as u32 {
            2 => value,
            _ => self.m.at[axis] - (self.m.shift(axis) - own[axis]) - value,
        };
        let zeros = std::array::from_fn(|axis| axes[axis].map(|value| zero(axis, value)));
        self.m.store_zero(entry, zeros, false);
        Ok(())
    }
}
