//! How a program begins, as far as it relies on it and never says it: the dictionary's state at power-on, assumed and reported
//! where the program first relies on it.
//!
//! A subprogram begins as its caller leaves things. What it relies on is known when the whole text has been read:
//! where no text on the way from the program's start to it has said a mode, it is how the program begins.
//!
//! Not here: the modes themselves (`common::modal_state`).

use std::collections::HashMap;

use ncc_dialects::{Dialect, PowerOnFact};
use ncc_ir::canon::{Distance, FeedMode, Motion, Plane, ReturnLevel, Units};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::program::Text;
use ncc_ir::source::Span;

use crate::batch::Batch;
use crate::common::known::Know;

/// Takes a fact for granted. Gives what is to be reported: the value, if not every such control
/// has it so.
pub(crate) fn take<T: Copy, U: Copy + From<T>>(
    know: &mut Know<U>,
    assumed: &mut Option<U>,
    power_on: &Option<PowerOnFact<T>>,
) -> Option<U> {
    let row = power_on.as_ref()?;
    let value = U::from(row.value);
    know.take(value);
    *assumed = Some(value);
    (!row.always).then_some(value)
}

/// Tells what was assumed, if it is not always so.
pub(crate) fn report(out: &mut Batch, at: Span, fact: ModeName, value: Option<&str>) {
    if let Some(value) = value {
        out.report(Fault::AssumedMode { fact, value: value.into() }, at);
    }
}

/// A block that relies on modes.
pub(crate) struct Asker<'b> {
    pub(crate) inherited: &'b mut Inherited,
    pub(crate) dialect: &'static Dialect,
    /// Whether a mode that the text has not said is taken from power-on and reported.
    pub(crate) assume: bool,
    pub(crate) at: Span,
    pub(crate) out: &'b mut Batch,
}

impl Asker<'_> {
    /// The block relies on a mode; `true` if its power-on value was looked up just now, by `take`.
    pub(crate) fn relies<T: Copy + PartialEq>(
        &mut self,
        know: &mut Know<T>,
        mode: ModeName,
        take: fn(&mut Know<T>, &Dialect, Span, &mut Batch),
    ) -> bool {
        self.inherited.rely(know, mode, self.at);
        let open = self.assume && know.unsaid();
        if open {
            take(know, self.dialect, self.at, self.out);
        }
        open
    }
}

/// Whether lengths are absolute.
pub(crate) fn distance(know: &mut Know<Distance>, dialect: &Dialect, at: Span, out: &mut Batch) {
    let value = take(know, &mut out.assumed.distance, &dialect.power_on.distance).map(|d| match d {
        Distance::Absolute => "absolute",
        Distance::Incremental => "incremental",
    });
    report(out, at, ModeName::Distance, value);
}

/// The units of lengths.
pub(crate) fn units(know: &mut Know<Units>, dialect: &Dialect, at: Span, out: &mut Batch) {
    let value = take(know, &mut out.assumed.units, &dialect.power_on.units).map(|u| match u {
        Units::Mm => "mm",
        Units::Inch => "inch",
    });
    report(out, at, ModeName::Units, value);
}

/// The plane of arcs and cycles.
pub(crate) fn plane(know: &mut Know<Plane>, dialect: &Dialect, at: Span, out: &mut Batch) {
    let value = take(know, &mut out.assumed.plane, &dialect.power_on.plane).map(|p| match p {
        Plane::Xy => "XY",
        Plane::Zx => "ZX",
        Plane::Yz => "YZ",
    });
    report(out, at, ModeName::Plane, value);
}

/// What a feed counts.
pub(crate) fn feed_mode(know: &mut Know<FeedMode>, dialect: &Dialect, at: Span, out: &mut Batch) {
    let value = take(know, &mut out.assumed.feed_mode, &dialect.power_on.feed_mode).map(|f| match f {
        FeedMode::PerMinute => "per minute",
        FeedMode::PerRevolution => "per revolution",
        FeedMode::InverseTime => "inverse time",
    });
    report(out, at, ModeName::FeedMode, value);
}

/// Where cycles leave the tool.
pub(crate) fn return_level(know: &mut Know<ReturnLevel>, dialect: &Dialect, at: Span, out: &mut Batch) {
    let value = take(know, &mut out.assumed.return_level, &dialect.power_on.return_level).map(|r| match r {
        ReturnLevel::Initial => "initial level",
        ReturnLevel::Retract => "retract plane",
    });
    report(out, at, ModeName::ReturnLevel, value);
}

/// The active work offset.
pub(crate) fn work_offset(know: &mut Know<u16>, dialect: &Dialect, at: Span, out: &mut Batch) {
    let Some(offset) = take(know, &mut out.assumed.work_offset, &dialect.power_on.work_offset) else {
        return;
    };
    if dialect.caps.frames.work_offsets == 0 {
        out.report(Fault::AssumedWorkOffset { offset }, at);
    } else {
        report(out, at, ModeName::WorkOffset, Some(&offset.to_string()));
    }
}

/// Whether the origin is not shifted.
pub(crate) fn no_shift(know: &mut Know<bool>, dialect: &Dialect, at: Span, out: &mut Batch) {
    let value = take(know, &mut out.assumed.no_origin_shift, &dialect.power_on.no_origin_shift);
    report(out, at, ModeName::OriginShift, value.map(|none| if none { "none" } else { "one" }));
}

/// The entry of the active tool length offset; 0 is none.
pub(crate) fn length_offset(know: &mut Know<bool>, dialect: &Dialect, at: Span, out: &mut Batch) {
    let Some(row) = &dialect.power_on.length_offset else { return };
    know.take(row.value != 0);
    out.assumed.length_offset = Some(row.value);
    if !row.always {
        report(out, at, ModeName::LengthOffset, Some(&row.value.to_string()));
    }
}

/// What axis words do that no motion code precedes.
pub(crate) fn motion_name(motion: Motion) -> &'static str {
    match motion {
        Motion::Traverse => "rapid",
        Motion::Feed => "feed",
        Motion::Arc(_) => "arc",
        Motion::Cycle => "cycle",
    }
}

/// What a subprogram may rely on.
const MODES: [ModeName; 8] = [
    ModeName::OriginShift,
    ModeName::WorkOffset,
    ModeName::LengthOffset,
    ModeName::Distance,
    ModeName::Units,
    ModeName::Plane,
    ModeName::FeedMode,
    ModeName::ReturnLevel,
];

/// Some of [`MODES`], a bit each.
pub(crate) type ModeSet = u8;

/// The set of one mode; none where a subprogram cannot rely on it.
const fn bit(mode: ModeName) -> ModeSet {
    match mode {
        ModeName::Distance => 1,
        ModeName::Units => 2,
        ModeName::Plane => 4,
        ModeName::FeedMode => 8,
        ModeName::ReturnLevel => 16,
        ModeName::WorkOffset => 32,
        ModeName::LengthOffset => 64,
        ModeName::OriginShift => 128,
        ModeName::Motion => 0,
    }
}

/// What the texts of a program find active, and hand on to those that they call.
#[derive(Debug, Default)]
pub(crate) struct Inherited {
    main: Own,
    subs: Vec<(Text, Own)>,
    /// Whether a subprogram is being read: the last of them.
    in_sub: bool,
}

/// What one text finds active, and hands on.
#[derive(Debug, Default)]
struct Own {
    /// Modes that it relies on as it finds them, and where it first does.
    relied: Vec<(ModeName, Span)>,
    /// What it calls, and which modes it has not said there. No name: whatever is called by a number that is computed.
    calls: Vec<(Option<Text>, ModeSet)>,
}

impl Own {
    fn relies(&self) -> ModeSet {
        self.relied.iter().fold(0, |all, (mode, _)| all | bit(*mode))
    }
}

/// Which modes of a text are as the program began, or as its caller left them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Unsaid(pub(crate) ModeSet);

impl Unsaid {
    /// Those, and those of another way to the same place.
    pub(crate) fn and(self, other: Unsaid) -> Unsaid {
        Unsaid(self.0 | other.0)
    }

    /// A mode that was lost is open where it is one of them: on one way it is as the text began.
    pub(crate) fn open<T>(self, mode: ModeName, know: &mut Know<T>, in_sub: bool) {
        if self.0 & bit(mode) != 0 && matches!(know, Know::Lost) {
            *know = if in_sub { Know::Callers } else { Know::Open };
        }
    }

    /// With a mode, as far as it is known.
    pub(crate) fn with<T: PartialEq + Copy>(self, mode: ModeName, know: Know<T>) -> Unsaid {
        Unsaid(if know.unsaid() || know == Know::Callers { self.0 | bit(mode) } else { self.0 })
    }
}

/// Which modes control has not said where it goes on at a block with a number.
#[derive(Debug, Default)]
pub(crate) struct Jumps {
    to: HashMap<u32, ModeSet>,
    /// Jumps to a number that is computed.
    anywhere: ModeSet,
}

impl Jumps {
    /// A jump to a block, or to any.
    pub(crate) fn jump(&mut self, to: Option<u32>, unsaid: Unsaid) {
        *to.map_or(&mut self.anywhere, |to| self.to.entry(to).or_default()) |= unsaid.0;
    }

    /// What the jumps to a block so far have not said.
    pub(crate) fn unsaid(&self, at: u32) -> Unsaid {
        Unsaid(self.anywhere | self.to.get(&at).copied().unwrap_or(0))
    }
}

impl Inherited {
    /// A subprogram begins.
    pub(crate) fn enter(&mut self, name: Text) {
        self.subs.push((name, Own::default()));
        self.in_sub = true;
    }

    /// It is over, and the main program goes on.
    pub(crate) fn leave(&mut self) {
        self.in_sub = false;
    }

    fn own(&mut self) -> &mut Own {
        match self.subs.last_mut() {
            Some((_, own)) if self.in_sub => own,
            _ => &mut self.main,
        }
    }

    /// A block relies on a mode.
    #[inline]
    pub(crate) fn rely<T: PartialEq>(&mut self, know: &Know<T>, mode: ModeName, at: Span) {
        if *know == Know::Callers {
            let own = self.own();
            if !own.relied.iter().any(|(other, _)| *other == mode) {
                own.relied.push((mode, at));
            }
        }
    }

    /// Whether nothing more is noted where a block relies on this mode.
    pub(crate) fn has_noted<T: PartialEq>(&self, know: &Know<T>, mode: ModeName) -> bool {
        let own = self.subs.last().filter(|_| self.in_sub).map_or(&self.main, |(_, own)| own);
        *know != Know::Callers || own.relied.iter().any(|(other, _)| *other == mode)
    }

    /// A text calls another one.
    pub(crate) fn call(&mut self, name: Option<Text>, unsaid: Unsaid) {
        if unsaid.0 != 0 {
            self.own().calls.push((name, unsaid.0));
        }
    }

    /// The text is over: assumes what subprograms find as the program began.
    pub(crate) fn settle(&self, dialect: &Dialect, out: &mut Batch) {
        let mut places: HashMap<&Text, Vec<usize>> = HashMap::new();
        for (at, (name, _)) in self.subs.iter().enumerate() {
            places.entry(name).or_default().push(at);
        }
        let all: Vec<usize> = (0..self.subs.len()).collect();
        let mut found: Vec<ModeSet> = vec![0; self.subs.len()];
        // Subprograms that have been handed something since what they call was looked at.
        let mut ahead = Vec::new();
        let hand_on = |calls: &[(Option<Text>, ModeSet)],
                       has: ModeSet,
                       found: &mut [ModeSet],
                       ahead: &mut Vec<usize>| {
            for (name, unsaid) in calls {
                let to = name.as_ref().map_or(Some(&all), |name| places.get(name));
                for &at in to.into_iter().flatten() {
                    if found[at] | unsaid & has != found[at] {
                        found[at] |= unsaid & has;
                        ahead.push(at);
                    }
                }
            }
        };
        hand_on(&self.main.calls, !0, &mut found, &mut ahead);
        while let Some(at) = ahead.pop() {
            let has = found[at];
            hand_on(&self.subs[at].1.calls, has, &mut found, &mut ahead);
        }
        for mode in MODES {
            let mut relied = self
                .subs
                .iter()
                .zip(&found)
                .filter(|((_, own), found)| **found & own.relies() & bit(mode) != 0);
            let Some(((_, own), _)) = relied.next() else { continue };
            let Some((_, at)) = own.relied.iter().find(|(other, _)| *other == mode) else { continue };
            match mode {
                ModeName::WorkOffset if out.assumed.work_offset.is_none() => {
                    work_offset(&mut Know::Unsaid, dialect, *at, out);
                }
                ModeName::OriginShift if out.assumed.no_origin_shift.is_none() => {
                    no_shift(&mut Know::Unsaid, dialect, *at, out);
                }
                ModeName::LengthOffset if out.assumed.length_offset.is_none() => {
                    length_offset(&mut Know::Unsaid, dialect, *at, out);
                }
                ModeName::Distance if out.assumed.distance.is_none() => {
                    distance(&mut Know::Unsaid, dialect, *at, out);
                }
                ModeName::Units if out.assumed.units.is_none() => units(&mut Know::Unsaid, dialect, *at, out),
                ModeName::Plane if out.assumed.plane.is_none() => plane(&mut Know::Unsaid, dialect, *at, out),
                ModeName::FeedMode if out.assumed.feed_mode.is_none() => {
                    feed_mode(&mut Know::Unsaid, dialect, *at, out);
                }
                ModeName::ReturnLevel if out.assumed.return_level.is_none() => {
                    return_level(&mut Know::Unsaid, dialect, *at, out);
                }
                _ => {}
            }
        }
    }
}
