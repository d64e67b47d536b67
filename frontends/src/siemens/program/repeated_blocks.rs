//! Blocks that run more than once: what repeated blocks and subprograms find active.
//!
//! Statements say what is known of the modes where they stand. A block that is repeated, or a
//! subprogram that is called from several places, must find there what was found the first time,
//! or it is refused. Subprograms leave the cycle of `MCALL` as they found it.
//!
//! Not here: the statements themselves.

use std::collections::HashMap;

use ncc_ir::program::Text;
use ncc_ir::source::Span;

use crate::common::known::Know;
use crate::siemens::siemens_state::{ModalCall, SiemensState};

// Facts that a statement keeps as known.
pub(in crate::siemens) const UNITS: u8 = 1;
pub(in crate::siemens) const SCALED: u8 = 2;
pub(in crate::siemens) const DISTANCE: u8 = 4;
pub(in crate::siemens) const PLANE: u8 = 8;
pub(in crate::siemens) const MOTION: u8 = 16;
pub(in crate::siemens) const CYCLE: u8 = 32;

/// A label.
#[derive(Clone, Debug)]
pub(in crate::siemens) struct Label {
    name: Text,
    /// Whether it is an end that no label is named for.
    end: bool,
    /// What was active before its block.
    before: SiemensState,
    /// What was active after its block.
    after: Option<SiemensState>,
    /// Facts that its block or a later one has said.
    said: u8,
    /// Facts that its block or a later one relied on before any had said them.
    used: u8,
}

/// Whether a cycle is active where a subprogram is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::siemens) enum Under {
    Nothing,
    Cycle {
        /// Whether it may have a feed of its own.
        own_feed: bool,
    },
    /// Now a cycle, now none.
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

    /// Whether what was read as if it were called so can be called otherwise.
    fn allows(self, other: Under) -> bool {
        let fed = self.own_feed() || !other.own_feed();
        match self {
            Under::Nothing => other == Under::Nothing,
            Under::Cycle { .. } => matches!(other, Under::Cycle { .. }) && fed,
            Under::Either { .. } => fed,
        }
    }
}

/// A subprogram, as far as its callers and itself are known.
#[derive(Clone, Debug)]
struct Sub {
    under: Under,
    /// The first call: the name as it is written there, and the place.
    called: Option<(Text, Span)>,
    /// Whether its text has been met.
    met: bool,
}

/// What is known of labels and subprograms.
#[derive(Debug, Default)]
pub(in crate::siemens) struct RepeatedBlocks {
    /// Labels of the program that is being read.
    labels: Vec<Label>,
    subs: HashMap<Text, Sub>,
}

/// Facts that differ.
fn differing(a: &SiemensState, b: &SiemensState) -> u8 {
    let bit = |differs: bool, bit: u8| if differs { bit } else { 0 };
    bit(changed(a.modes.units, b.modes.units), UNITS)
        | bit(changed(a.scaled, b.scaled), SCALED)
        | bit(changed(a.modes.distance, b.modes.distance), DISTANCE)
        | bit(changed(a.modes.plane, b.modes.plane), PLANE)
        | bit(changed(a.modes.motion, b.modes.motion), MOTION)
        | bit(a.cycle != b.cycle, CYCLE)
}

/// Whether a fact is another one. What was assumed since held before as well.
fn changed<T: Copy + PartialEq>(before: Know<T>, now: Know<T>) -> bool {
    let taken = matches!((before, now), (Know::Unsaid, Know::Taken(_)));
    before.value() != now.value() && !taken
}

/// Why blocks cannot be repeated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::siemens) enum NotRepeatable {
    /// No such label before.
    Unknown,
    /// They would find something else active.
    Differs,
}

impl RepeatedBlocks {
    /// Whether nothing comes of relying on these facts, or of saying one of them: no block can be repeated, or it is
    /// known of every label already that they are stated after it, or relied on.
    pub(in crate::siemens) fn knows(&self, facts: u8) -> bool {
        // What the last one knows, all before it do.
        self.labels.last().is_none_or(|label| (label.used | label.said) & facts == facts)
    }

    /// A block with a label begins.
    pub(in crate::siemens) fn label(&mut self, name: Text, before: &SiemensState) {
        let label = Label { name, end: false, before: before.clone(), after: None, said: 0, used: 0 };
        self.labels.push(label);
    }

    /// A name for an end that has none of its own.
    pub(in crate::siemens) fn end_name(&self) -> Text {
        let mut numbers = 1u32..;
        let free = numbers.find_map(|n| {
            let name = format!("ENDLABEL_{n}");
            (!self.has_label(&name)).then_some(name)
        });
        free.unwrap_or_default().into()
    }

    /// The last label is an end that no label is named for.
    pub(in crate::siemens) fn is_end(&mut self) {
        if let Some(label) = self.labels.last_mut() {
            label.end = true;
        }
    }

    /// The end that stands first after the last label of this name.
    pub(in crate::siemens) fn end_behind(&self, from: &str) -> Option<Text> {
        let first = self.labels.iter().rposition(|l| &*l.name == from)?;
        self.labels[first..].iter().find(|l| l.end).map(|l| l.name.clone())
    }

    /// Whether a label of this name has been met.
    pub(in crate::siemens) fn has_label(&self, name: &str) -> bool {
        self.labels.iter().any(|l| &*l.name == name)
    }

    /// The last label's block is over.
    pub(in crate::siemens) fn label_over(&mut self, after: &SiemensState) {
        if let Some(label) = self.labels.last_mut() {
            label.after = Some(after.clone());
        }
    }

    /// A fact is relied on. What an older label knows of it is known of every one before.
    pub(in crate::siemens) fn use_fact(&mut self, fact: u8) {
        for label in self.labels.iter_mut().rev() {
            if (label.used | label.said) & fact != 0 {
                return;
            }
            label.used |= fact;
        }
    }

    /// Control divides here, or comes together: every fact may be relied on.
    pub(in crate::siemens) fn use_all(&mut self) {
        self.labels.iter_mut().for_each(|label| label.used = u8::MAX);
    }

    /// A fact is stated.
    pub(in crate::siemens) fn say(&mut self, fact: u8) {
        for label in self.labels.iter_mut().rev() {
            if label.said & fact != 0 {
                return;
            }
            label.said |= fact;
        }
    }

    /// Blocks from a label to here, or to another label's block, are to run again, once or several times: finds whether
    /// they mean the same then, and what is known afterwards.
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
            // From the second time on they find what they leave.
            if several && differing(&label.before, after) & label.used != 0 {
                return Err(NotRepeatable::Differs);
            }
            let before = now.clone();
            *now = after.clone();
            now.join(&before);
        }
        Ok(())
    }

    /// A subprogram is called; `false` if it cannot be, because it was read as if it were called
    /// under another cycle.
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

    /// Whether the text of a subprogram has been met.
    pub(in crate::siemens) fn has_met(&self, name: &str) -> bool {
        self.subs.get(name).is_some_and(|sub| sub.met)
    }

    /// Subprograms that are called and have not been met, each where it is called first.
    pub(in crate::siemens) fn unknown(&self) -> Vec<(Text, Span)> {
        let missing = self.subs.values().filter(|sub| !sub.met);
        let mut missing: Vec<_> = missing.filter_map(|sub| sub.called.clone()).collect();
        missing.sort_by_key(|(_, at)| at.start);
        missing
    }

    /// The text of a subprogram begins; gives what it finds active, or nothing if it has been met
    /// before.
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
