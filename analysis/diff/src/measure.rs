//! When two records are the same: within how much, and in which respects they are not.

use ncc_exec::verify::Resolution;
use ncc_ir::canon::{AXES, Spindle};
use ncc_ir::expr::num::{Nanos, POW10};

use crate::record::{Record, Still, Style, What};

/// Differences that still count as the same, in nanos.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measure {
    /// Of lengths: of a program in millimetres, and in inches.
    pub lengths: [Nanos; 2],
    /// Of angles.
    pub degrees: Nanos,
    /// Of feeds, likewise.
    pub feeds: [Nanos; 2],
    /// Of a dwell's seconds.
    pub seconds: Nanos,
}

/// Respects in which two aligned records differ, one bit each.
pub mod bits {
    /// Feed.
    pub const FEED: u8 = 1;
    /// Speed of the turning spindle, or what it counts.
    pub const SPEED: u8 = 2;
    /// Sense of the spindle.
    pub const SPINDLE: u8 = 4;
    /// Tool.
    pub const TOOL: u8 = 8;
    /// Coolant.
    pub const COOLANT: u8 = 16;
    /// Cutter radius compensation.
    pub const COMPENSATION: u8 = 64;
    /// Where offsets and lengths put it.
    pub const FRAME: u8 = 32;
    /// Limit of the turning spindle's speed.
    pub const LIMIT: u8 = 128;
}

impl Measure {
    /// Half the least increment of the coarser side.
    pub fn of(a: &Resolution, b: &Resolution) -> Measure {
        let half = |a: u8, b: u8, inch: bool| {
            let unit = POW10[9 - a.min(b).min(9) as usize];
            (if inch { unit * 254 / 10 } else { unit }) / 2
        };
        Measure {
            lengths: [half(a.mm, b.mm, false), half(a.inch, b.inch, true)],
            degrees: half(a.degree, b.degree, false),
            feeds: [half(a.feed, b.feed, false), half(a.feed_inch, b.feed_inch, true)],
            seconds: half(a.second, b.second, false),
        }
    }

    /// How far lengths of two records may be apart.
    #[inline]
    pub fn length(&self, a: &Record, b: &Record) -> Nanos {
        let own = |r: &Record| self.lengths[usize::from(r.inch())];
        own(a).max(own(b))
    }

    /// Whether two records are the same event at the same place, `b` shifted by so much: kind, end
    /// point, arc, seconds, text. With what it is done is another question.
    #[inline]
    pub fn same(&self, a: &Record, b: &Record, shift: &Shift) -> bool {
        if a.what != b.what || !a.same_form(b) || a.world != b.world {
            return false;
        }
        let near = |x: Nanos, y: Nanos, by: Nanos, most: Nanos| y.wrapping_sub(x).abs_diff(by) <= most as u64;
        match a.what {
            What::Traverse | What::Feed | What::Thread | What::Arc => {
                // Both ends of a shift are rounded.
                let most = self.length(a, b) << u8::from(shift.on);
                if !(0..3).all(|i| near(a.end[i], b.end[i], shift.by[i], most)) {
                    return false;
                }
                if a.what == What::Arc {
                    let (plane, ..) = a.arc();
                    let (first, second, _) = plane.axes();
                    let most = most * 3 / 2;
                    return near(a.more[0], b.more[0], shift.by[first as usize], most)
                        && near(a.more[1], b.more[1], shift.by[second as usize], most);
                }
                a.more == b.more && !shift.on
                    || (0..3).all(|i| near(a.more[i], b.more[i], shift.by[3 + i], self.degrees))
            }
            What::Orient => near(a.more[0], b.more[0], 0, self.degrees),
            What::Dwell => near(a.more[0], b.more[0], 0, self.seconds),
            What::Function | What::Message | What::Alarm => a.more[0] == b.more[0],
            What::ToolChange
            | What::Stop
            | What::OptionalStop
            | What::End
            | What::BeginAgain
            | What::TextEnd => true,
        }
    }

    /// Whether two records go the same way from where their tools stood before.
    pub fn same_way(&self, a: &Record, b: &Record, from: [&[Nanos; 3]; 2]) -> bool {
        let by = std::array::from_fn(|i| if i < 3 { from[1][i].wrapping_sub(from[0][i]) } else { 0 });
        self.same(a, b, &Shift { by, on: true })
    }

    /// Whether a straight move goes nowhere, as seen from a place.
    pub fn stays(&self, a: &Record, style: &Style, at: &[Nanos; AXES]) -> bool {
        let place = a.place(style);
        a.world == 0
            && matches!(a.what, What::Traverse | What::Feed)
            && (0..3).all(|i| place[i].abs_diff(at[i]) <= self.length(a, a) as u64)
            && (3..AXES).all(|i| place[i].abs_diff(at[i]) <= self.degrees as u64)
    }

    /// In which respects the styles of two aligned records differ.
    pub fn styles(&self, a: &Style, b: &Style, inch: bool) -> u8 {
        let (s, t): (&Still, &Still) = (&a.state, &b.state);
        let turning = s.spindle != Spindle::Stopped && t.spindle != Spindle::Stopped;
        let feed =
            a.rate != 0 && b.rate != 0 && a.rate.abs_diff(b.rate) > self.feeds[usize::from(inch)] as u64;
        let linear = self.lengths[usize::from(inch)];
        let apart = |axis: usize| if axis < 3 { linear } else { self.degrees } as u64;
        let frame = a.apart != b.apart
            && a.apart.iter().zip(&b.apart).any(|(x, y)| (0..AXES).any(|i| x[i].abs_diff(y[i]) > apart(i)));
        let turned = (0..3).any(|i| a.turned[i].abs_diff(b.turned[i]) > self.degrees as u64);
        let speed = |s: &Still| (s.speed, s.spindle_mode);
        let bit = |is: bool, bit: u8| if is { bit } else { 0 };
        bit(feed, bits::FEED)
            | bit(turning && speed(s) != speed(t), bits::SPEED)
            | bit(turning && s.limit != t.limit, bits::LIMIT)
            | bit(s.spindle != t.spindle, bits::SPINDLE)
            | bit(s.tool != t.tool, bits::TOOL)
            | bit((s.flood, s.mist) != (t.flood, t.mist), bits::COOLANT)
            | bit(s.compensation != t.compensation, bits::COMPENSATION)
            | bit(frame || turned || s.ways() != t.ways(), bits::FRAME)
    }
}

/// By how much a stream is shifted against the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shift {
    /// The second less the first, nanos.
    pub by: [Nanos; AXES],
    /// Whether there is one.
    pub on: bool,
}
