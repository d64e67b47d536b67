//! Blocks that run more than once: modes at the start of repeated blocks and of subprograms.
//!
//! The front-end parses a block once, with the modes that are active at its first run. A later run must find the
//! same modes, or ncc refuses the repetition. In `G1 F100`, `A: X10`, `G0 X0`, `REPEAT A`, the second X10 would be a
//! rapid move. A subprogram leaves the modal call of `MCALL` unchanged.
//!
//! Not here: the repeated statements, and the messages (`calls`).

use std::collections::HashMap;

use ncc_ir::program::Text;
use ncc_ir::source::Span;

use crate::common::known::Know;
use crate::siemens::siemens_state::{ModalCall, SiemensState};

// Bits of the modes that a statement may set or use.
pub(in crate::siemens) const UNITS: u8 = 1;
pub(in crate::siemens) const SCALED: u8 = 2;
pub(in crate::siemens) const DISTANCE: u8 = 4;
pub(in crate::siemens) const PLANE: u8 = 8;
pub(in crate::siemens) const MOTION: u8 = 16;
pub(in crate::siemens) const CYCLE: u8 = 32;

/// A label with the modes at its block.
#[derive(Clone, Debug)]
pub(in crate::siemens) struct Label {
    name: Text,
    /// Whether it is `ENDLABEL`, the common end of a repetition.
    end: bool,
    /// Modes before its block.
    before: SiemensState,
    /// Modes after its block; `None` until the block ends.
    after: Option<SiemensState>,
    /// Bits of modes that its block or a later one has set.
    said: u8,
    /// Bits of modes that its block or a later one used before any of them set the mode.
    used: u8,
}

/// Modal call that is active at the calls of a subprogram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::siemens) enum Under {
    Nothing,
    Cycle {
        /// Whether the cycle may have its own feed.
        own_feed: bool,
    },
    /// A cycle at some calls, no cycle at others.
    Either {
        own_feed: bool,
    },
}

impl Under {
    fn own_feed(self) -> bool {
        match self {
            Under::Nothing => false,
            Under::Cycle { own_feed } | Under::Either { own_feed } => own_feed,
        }
    }

    /// Whether a subprogram that was parsed for `self` can also be called under `other`.
    fn allows(self, other: Under) -> bool {
        let fed = self.own_feed() || !other.own_feed();
        match self {
            Under::Nothing => other == Under::Nothing,
            Under::Cycle { .. } => matches!(other, Under::Cycle { .. }) && fed,
            Under::Either { .. } => fed,
        }
    }
}

/// A subprogram: its calls so far, and whether its text has been parsed.
#[derive(Clone, Debug)]
struct Sub {
    under: Under,
    /// First call: the name as written, and its span.
    called: Option<(Text, Span)>,
    /// Whether its text has begun in the source.
    met: bool,
}

/// Labels of the current unit, and all subprograms of the source.
#[derive(Debug, Default)]
pub(in crate::siemens) struct RepeatedBlocks {
    /// Labels of the current unit, in the order of the text.
    labels: Vec<Label>,
    subs: HashMap<Text, Sub>,
}

/// Bits of the modes that differ between two states.
fn differing(a: &SiemensState, b: &SiemensState) -> u8 {
    let bit = |differs: bool, bit: u8| if differs { bit } else { 0 };
    bit(changed(a.modes.units, b.modes.units), UNITS)
        | bit(changed(a.scaled, b.scaled), SCALED)
        | bit(changed(a.modes.distance, b.modes.distance), DISTANCE)
        | bit(changed(a.modes.plane, b.modes.plane), PLANE)
        | bit(changed(a.modes.motion, b.modes.motion), MOTION)
        | bit(a.cycle != b.cycle, CYCLE)
}

/// Whether a mode has another value. A mode that ncc assumed in between counts as unchanged.
fn changed<T: Copy + PartialEq>(before: Know<T>, now: Know<T>) -> bool {
    let taken = matches!((before, now), (Know::Unsaid, Know::Taken(_)));
    before.value() != now.value() && !taken
}

/// Reason why blocks cannot be repeated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::siemens) enum NotRepeatable {
    /// A label is missing before the repetition.
    Unknown,
    /// Another mode is active at the repetition.
    Differs,
}

impl RepeatedBlocks {
    /// Whether noting these bits again would change nothing: either no label exists, or every label already has them
    /// as set or used.
    pub(in crate::siemens) fn knows(&self, facts: u8) -> bool {
        // All earlier labels have the bits of the last one.
        self.labels.last().is_none_or(|label| (label.used | label.said) & facts == facts)
    }

    /// Notes the start of a block with a label; `before` has the modes before it.
    pub(in crate::siemens) fn label(&mut self, name: Text, before: &SiemensState) {
        let label = Label { name, end: false, before: before.clone(), after: None, said: 0, used: 0 };
        self.labels.push(label);
    }

    /// A free name for an `ENDLABEL`: `ENDLABEL_1`, `ENDLABEL_2`, …
    pub(in crate::siemens) fn end_name(&self) -> Text {
        let mut numbers = 1u32..;
        let free = numbers.find_map(|n| {
            let name = format!("ENDLABEL_{n}");
            (!self.has_label(&name)).then_some(name)
        });
        free.unwrap_or_default().into()
    }

    /// Marks the last label as `ENDLABEL`.
    pub(in crate::siemens) fn is_end(&mut self) {
        if let Some(label) = self.labels.last_mut() {
            label.end = true;
        }
    }

    /// Name of the first `ENDLABEL` after the last label `from`; `None` if none follows.
    pub(in crate::siemens) fn end_behind(&self, from: &str) -> Option<Text> {
        let first = self.labels.iter().rposition(|l| &*l.name == from)?;
        self.labels[first..].iter().find(|l| l.end).map(|l| l.name.clone())
    }

    /// Whether the unit has such a label so far.
    pub(in crate::siemens) fn has_label(&self, name: &str) -> bool {
        self.labels.iter().any(|l| &*l.name == name)
    }

    /// Notes the modes after the block of the last label.
    pub(in crate::siemens) fn label_over(&mut self, after: &SiemensState) {
        if let Some(label) = self.labels.last_mut() {
            label.after = Some(after.clone());
        }
    }

    /// Notes the use of a mode for every label. An older label that has the bit ends the search: all before it
    /// have it too.
    pub(in crate::siemens) fn use_fact(&mut self, fact: u8) {
        for label in self.labels.iter_mut().rev() {
            if (label.used | label.said) & fact != 0 {
                return;
            }
            label.used |= fact;
        }
    }

    /// At a branch or a merge, every mode counts as used.
    pub(in crate::siemens) fn use_all(&mut self) {
        self.labels.iter_mut().for_each(|label| label.used = u8::MAX);
    }

    /// Notes for every label that a block sets this mode.
    pub(in crate::siemens) fn say(&mut self, fact: u8) {
        for label in self.labels.iter_mut().rev() {
            if label.said & fact != 0 {
                return;
            }
            label.said |= fact;
        }
    }

    /// Checks a repetition of the blocks from label `from` to the current block, or to the block of label `to`.
    /// `several` is true for more than one repetition. Sets `now` to the modes after the repetition.
    ///
    /// # Errors
    /// A label is missing, or a mode that the blocks use has another value at the repetition.
    pub(in crate::siemens) fn repeat(
        &self,
        from: &str,
        to: Option<&str>,
        several: bool,
        now: &mut SiemensState,
    ) -> Result<(), NotRepeatable> {
        let place = |name: &str| self.labels.iter().rposition(|l| &*l.name == name);
        let first = place(from).ok_or(NotRepeatable::Unknown)?;
        let label = &self.labels[first];
        if differing(&label.before, now) & label.used != 0 {
            return Err(NotRepeatable::Differs);
        }
        if let Some(to) = to {
            let last = place(to).filter(|last| *last >= first).ok_or(NotRepeatable::Unknown)?;
            let after = self.labels[last].after.as_ref().ok_or(NotRepeatable::Unknown)?;
            // From the second repetition on, the blocks start with the modes of their own end.
            if several && differing(&label.before, after) & label.used != 0 {
                return Err(NotRepeatable::Differs);
            }
            let before = now.clone();
            *now = after.clone();
            now.join(&before);
        }
        Ok(())
    }

    /// Notes a call of a subprogram. `false` if its text was already parsed for another modal call and does not
    /// allow this one.
    pub(in crate::siemens) fn call(&mut self, name: &str, written: &str, at: Span, under: Under) -> bool {
        match self.subs.get_mut(name) {
            None => {
                let called = Some((written.into(), at));
                self.subs.insert(name.into(), Sub { under, called, met: false });
                true
            }
            Some(sub) if sub.met => sub.under.allows(under),
            Some(sub) => {
                let own_feed = sub.under.own_feed() || under.own_feed();
                sub.under = match (sub.under, under) {
                    (Under::Nothing, Under::Nothing) => Under::Nothing,
                    (Under::Cycle { .. }, Under::Cycle { .. }) => Under::Cycle { own_feed },
                    _ => Under::Either { own_feed },
                };
                true
            }
        }
    }

    /// Whether the text of a subprogram has begun in the source.
    pub(in crate::siemens) fn has_met(&self, name: &str) -> bool {
        self.subs.get(name).is_some_and(|sub| sub.met)
    }

    /// Called subprograms without a text, each with its first call, in the order of the text.
    pub(in crate::siemens) fn unknown(&self) -> Vec<(Text, Span)> {
        let missing = self.subs.values().filter(|sub| !sub.met);
        let mut missing: Vec<_> = missing.filter_map(|sub| sub.called.clone()).collect();
        missing.sort_by_key(|(_, at)| at.start);
        missing
    }

    /// Starts the text of a subprogram. Returns the modal call that is active at its start; `None` for a second
    /// text of the same name.
    pub(in crate::siemens) fn enter(&mut self, name: &str) -> Option<ModalCall> {
        self.labels.clear();
        let sub =
            self.subs.entry(name.into()).or_insert(Sub { under: Under::Nothing, called: None, met: false });
        if std::mem::replace(&mut sub.met, true) {
            return None;
        }
        Some(match sub.under {
            Under::Nothing => ModalCall::None,
            Under::Cycle { own_feed } => ModalCall::Inherited { own_feed },
            Under::Either { own_feed } => ModalCall::Lost { own_feed },
        })
    }
}
