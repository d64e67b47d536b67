//! What a grblHAL has besides Grbl 1.1, from its own source (core at commit f80fc34: gcode.c, motion_control.c,
//! tool_change.c): the cycles that it executes, the level of return, a table of lengths, M6, and the switch of `/`.

use super::grbl::{Control, Words};
use super::{Halt, Machine, What};

/// Modal groups of G codes; a block has one code of each.
pub(super) const GROUPS: [&[u32]; 12] = [
    &[40, 100, 280, 281, 300, 301, 530, 920, 921],
    &[0, 10, 20, 30, 382, 383, 384, 385, 730, 800, 810, 820, 830],
    &[170, 180, 190],
    &[900, 910],
    &[911],
    &[930, 940],
    &[200, 210],
    &[400],
    &[430, 431, 490],
    &[540, 550, 560, 570, 580, 590, 591, 592, 593],
    &[610],
    &[980, 990],
];

/// Modal groups of M codes.
pub(super) const M_GROUPS: &[&[u32]] =
    &[&[0, 10, 20, 300, 600], &[30, 40, 50], &[70, 80, 90], &[60, 610], &[480, 490]];

/// What the cycle in force keeps, millimetres in the machine, and seconds.
#[derive(Default)]
pub(super) struct Series {
    /// G99.
    pub(super) to_r: bool,
    retract: f64,
    bottom: f64,
    /// A stroke of the feed.
    stroke: f64,
    dwell: f64,
}

/// Seconds that it stays after each stroke of G73 and G83.
const STAY: f64 = 0.25;

impl Machine {
    /// Along one axis by rapid.
    fn rise(&mut self, axis: usize, level: f64) {
        let mut to = self.at;
        to[axis] = level;
        self.traverse(to);
    }
}

impl Control {
    /// M6 and M61.
    pub(super) fn hal_tools(&mut self, words: &Words, m: &[u32]) -> Result<(), Halt> {
        if m.contains(&610) {
            let Some(tool) = words.get('Q') else { return self.m.halt("M61 without Q") };
            self.m.store_tool(tool as u32);
        }
        if m.contains(&60) { self.m.change_tool() } else { Ok(()) }
    }

    /// G43 H.
    pub(super) fn hal_length(&mut self, words: &Words) -> Result<(), Halt> {
        match words.get('H') {
            Some(entry) if entry > 0.0 => {
                self.m.use_length(entry as u32);
                Ok(())
            }
            _ => self.m.halt("G43 of the tool that was selected last"),
        }
    }

    /// G99 ends with every move that is no cycle's, and with every block while G80 is in force.
    pub(super) fn level_lost(&mut self, moved: bool) {
        let cycle = matches!(self.motion, Some(730 | 810..=830));
        if let Some(series) = self.hal.as_mut().filter(|_| !cycle && (moved || self.motion.is_none())) {
            series.to_r = false;
        }
    }

    /// A block of a cycle.
    pub(super) fn hal_cycle(
        &mut self,
        code: u32,
        another: bool,
        words: &Words,
        axes: [Option<f64>; 6],
        unit: f64,
    ) -> Result<(), Halt> {
        let (first, second, normal) = self.m.axes();
        let Some(series) = &mut self.hal else { return self.m.halt("error 20: a canned cycle") };
        let (r, z) = (words.get('R').map(|r| r * unit), axes[normal]);
        if axes.iter().all(Option::is_none) {
            return match words.get('R').is_some() || another {
                true => self.m.halt("a cycle without a word of an axis"),
                false => Ok(()),
            };
        }
        if another && (r.is_none() || z.is_none()) {
            return self.m.halt("error 28: R and the bottom are needed");
        }
        let zero = self.m.shift(normal);
        let here = self.m.at[normal];
        if let Some(r) = r {
            series.retract = r + if self.m.absolute { zero } else { here };
        }
        if let Some(z) = z {
            series.bottom = z + if self.m.absolute { zero } else { series.retract };
        }
        series.stroke = match (code, words.get('Q')) {
            (730 | 830, Some(q)) if q > 0.0 => q * unit,
            (730 | 830, None) if !another => series.stroke,
            (730 | 830, _) => return self.m.halt("error 28: Q is needed"),
            _ => f64::INFINITY,
        };
        series.dwell = match (code, words.get('P')) {
            (730 | 830, _) => STAY,
            (820, Some(p)) => p,
            (820, None) if !another => series.dwell,
            (820, None) => return self.m.halt("error 28: P is needed"),
            _ => 0.0,
        };
        let (r, bottom, stroke, dwell) = (series.retract, series.bottom, series.stroke, series.dwell);
        let to_r = series.to_r;
        if bottom > r {
            return self.m.halt("the bottom lies above R");
        }
        let times = words.get('L').unwrap_or(1.0) as u32;
        let step = [first, second].map(|axis| axes[axis].unwrap_or(0.0));
        if times == 0 {
            return self.m.halt("error: L is not positive");
        }
        let mut over = self.target(axes);
        self.m.rise(normal, r.max(self.m.at[normal]));
        let level = self.m.at[normal];
        let back = if to_r { r } else { level };
        over[normal] = level;
        self.m.traverse(over);
        for turn in 0..times {
            if turn > 0 && !self.m.absolute {
                let mut next = self.m.at;
                next[first] += step[0];
                next[second] += step[1];
                self.m.traverse(next);
            }
            self.m.rise(normal, r.min(self.m.at[normal]));
            let mut depth = self.m.at[normal];
            loop {
                depth = (depth - stroke).max(bottom);
                let mut down = self.m.at;
                down[normal] = depth;
                self.m.straight(down)?;
                if dwell > 0.0 {
                    self.m.record(What::Dwell(dwell));
                }
                if depth <= bottom + 1e-9 {
                    break;
                }
                let lift = self.m.setup.break_lift;
                self.m.rise(normal, if code == 730 { depth + lift } else { back });
            }
            self.m.rise(normal, back);
        }
        Ok(())
    }
}
