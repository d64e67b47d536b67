//! G codes of which the number is computed (16-C, custom macro: a variable stands for the value of any address but `O`
//! and `N`; its bolt circle saves `#3=#4003` and puts that back by `G#3 G80`): a branch for each code of a group, and
//! an alarm where none has the number. The group is that of which a variable was given the active code, or that of
//! the number that comes of the constants that its variables were given last.
//!
//! That the number is one of the group's on every path to the code is looked at when the whole text has been read (`structure_paths`);
//! any other is refused, since any code might come of it.

use std::mem::discriminant;

use ncc_dialects::{Statement as Says, SystemRow};
use ncc_ir::canon::Motion;
use ncc_ir::computed::computed_code::of_number;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Expr, Node, Target, Var};
use ncc_ir::program::{Move, Op, Point, Text};
use ncc_ir::unsupported::CodeUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::saved::{ANY, GroupSource, paths};
use crate::common::setting::setting;
use crate::common::words::{Digits, Value, Word};
use crate::word::block_words::{Code, motion_of};
use crate::word::lower::Lower;
use crate::word::text::block::Block;
use crate::word::word_state::CycleState;

impl Lower {
    /// A variable gets a value as the text has it.
    pub(in crate::word) fn saves(&mut self, to: &Target, value: &Expr) {
        let own = self.sub.as_ref().map(|sub| sub.name.clone()).unwrap_or_default();
        if self.settings.states_values() {
            let set = if let Target::Var(var) = to { Some(var.clone()) } else { None };
            self.computes.saved.set.push((own.clone(), set));
        }
        let Target::Var(var) = to else { return };
        let node = match value {
            Expr::Num(number) => {
                let number = number.whole_number().filter(|_| !matches!(var, Var::System(_)));
                self.computes.saved.numbers.extend(number.map(|number| (own, var.clone(), number)));
                return;
            }
            Expr::Node(node) => node,
        };
        let Node::Var(Var::System(System::Other(name))) = &**node else { return };
        if let Some((row, 0)) = self.row_of(name)
            && row.refuse.is_none()
            && !row.sum.is_empty()
        {
            self.computes.saved.rows.push((own, var.clone(), row));
        }
    }

    /// Whether a code is one of those that the text may compute.
    pub(in crate::word) fn may_be_computed(&self, word: &Word) -> bool {
        word.letter == b'G' && self.settings.dialect.formula.statements.contains(&Says::CodeOf)
    }

    /// An M code of which the number is a variable that the main program never sets, and whose value at the start the
    /// user states: that code. Whether the program sets it anywhere is looked at when the whole text has been read.
    pub(in crate::word) fn stated_code(
        &mut self,
        word: &Word,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) -> Option<Word> {
        let Value::Computed(place) = word.value else { return None };
        let Expr::Node(node) = block.exprs.get(usize::from(place))? else { return None };
        let Node::Var(var) = &**node else { return None };
        if word.letter != b'M' || self.sub.is_some() && matches!(var, Var::Local(_)) {
            return None;
        }
        let number = self.settings.stated_value(&var.name())?;
        let (name, value) = (var.name().into(), number.to_string().into());
        out.report(Fault::AssumedFact { fact: ControlFact::VariableAtStart { name, value } }, word.span);
        self.computes.saved.stated.push((word.span, src.text(word.span), var.clone()));
        let value = Value::Number(Digits { mantissa: number, scale: 0, point: false });
        Some(Word { value, ..*word })
    }

    /// The codes of a block of which the number is a variable: they come first, as modes do.
    pub(in crate::word) fn computed_codes(
        &mut self,
        block: &Block,
        codes: &[Code],
        src: Source,
        out: &mut Batch,
    ) {
        let computed = |word: &&Word| matches!((word.letter, word.value), (b'G', Value::Computed(_)));
        let mut groups = Vec::new();
        for word in block.words.iter().filter(computed) {
            groups.extend(self.computed_code(word, block, (codes, &groups), src, out));
        }
    }

    /// Beside the other codes of the block and the groups of those that are computed. Gives its own group.
    fn computed_code(
        &mut self,
        word: &Word,
        block: &Block,
        (codes, computed): (&[Code], &[&'static str]),
        src: Source,
        out: &mut Batch,
    ) -> Option<&'static str> {
        let Value::Computed(place) = word.value else { return None };
        let refused = |lower: &mut Lower, what: CodeUnsupported, out: &mut Batch| {
            lower.fault(Fault::not_supported(src.text(word.span), what), word.span, out);
            None
        };
        let number = block.exprs[usize::from(place)].clone();
        let saved = match &number {
            Expr::Node(node) => match &**node {
                Node::Var(var) => self.row_saved(var).map(|row| (var.clone(), row)),
                _ => None,
            },
            Expr::Num(_) => None,
        };
        let (group, told) = match saved {
            Some((var, row)) => (self.codes_of(row), GroupSource::Saved(row, var)),
            None => (self.codes_beside(&number), GroupSource::Range),
        };
        let Some(own) = group.first().map(|(_, _, own)| *own) else { return refused(self, ANY, out) };
        let same = |code: &Code| group.iter().any(|(_, _, group)| **group == *code.row.group);
        if codes.iter().any(same) || group.iter().any(|(_, _, group)| computed.contains(group)) {
            return refused(self, CodeUnsupported::VariableInGroup, out);
        }
        let number = self.value(&number, word.span, out);
        out.whole = true;
        self.leave_motion(None, out);
        if !self.forget_group(&group) {
            return refused(self, CodeUnsupported::VariableInCycle, out);
        }
        self.computes.saved.back.push((word.span, told));
        let group = group.into_iter().map(|(code, op, _)| (code, op)).collect();
        self.push(word.span, of_number(&number, group, word.span), out);
        self.end_block_here();
        Some(own)
    }

    /// The group whose code a variable was given last.
    fn row_saved(&self, var: &Var) -> Option<&'static SystemRow> {
        let own = self.sub.as_ref().map(|sub| &*sub.name).unwrap_or_default();
        let here = |(program, of, _): &&(Text, Var, _)| {
            of == var && (!matches!(var, Var::Local(_)) || **program == *own)
        };
        self.computes.saved.rows.iter().rev().find(here).map(|(_, _, row)| *row)
    }

    /// What a value is likely to be: with what its variables were last given as the text has it.
    pub(in crate::word) fn likely(&self, number: &Expr) -> Option<i64> {
        let own = self.sub.as_ref().map(|sub| &*sub.name).unwrap_or_default();
        let given = |var: &Var| {
            let here = |(program, of, _): &&(Text, Var, i64)| {
                of == var && (!matches!(var, Var::Local(_)) || **program == *own)
            };
            let found = self.computes.saved.numbers.iter().rev().find(here);
            found.and_then(|(_, _, number)| paths::Range::only(*number))
        };
        paths::range(number, &given).map(|range| range.from)
    }

    /// The codes of the group that a computed number is likely to be of: with what its variables were last given as the
    /// text has it, or one more or less where they are counted first.
    fn codes_beside(&self, number: &Expr) -> Vec<(i64, Op, &'static str)> {
        let Some(likely) = self.likely(number) else { return Vec::new() };
        let near = [0, 1, -1].into_iter().filter_map(|by| self.setting_of(likely.checked_add(by)?));
        let mut near = near.filter(|(_, op, _)| is_mode(op));
        let Some((_, one, group)) = near.next() else { return Vec::new() };
        let codes = (0..=999).filter_map(|number| self.setting_of(number));
        let own = codes.filter(|(_, op, own)| *own == group && is_alike(op, &one));
        own.collect()
    }

    /// The codes that a group's variable may have the numbers of, what they do, and their group.
    fn codes_of(&self, row: &'static SystemRow) -> Vec<(i64, Op, &'static str)> {
        let base: i64 = row.sum.iter().filter(|term| term.means.is_empty()).map(|term| term.times).sum();
        let numbers = row.sum.iter().filter(|term| !term.means.is_empty()).flat_map(|term| {
            let each = if System::named(&term.means) == System::FirstWorkOffset { 1..=6 } else { 1..=1 };
            each.map(move |worth| base + worth * term.times)
        });
        numbers.filter_map(|number| self.setting_of(number)).collect()
    }

    /// A code that activates a mode or begins a motion, by its number; what it does, and its group.
    fn setting_of(&self, number: i64) -> Option<(i64, Op, &'static str)> {
        let nowhere = || Move { to: Point::default(), said: true };
        let row = self.settings.dialect.code_row(b'G', u32::try_from(number.checked_mul(10)?).ok()?)?;
        let op = match motion_of(row.means?) {
            Some(Motion::Traverse) => Op::StraightTraverse(nowhere()),
            Some(Motion::Feed) => Op::StraightFeed(nowhere()),
            Some(Motion::Arc(_) | Motion::Cycle) => return None,
            None => setting(row.means?)?,
        };
        Some((number, op, &*row.group))
    }

    /// What such a code says is not known any more; `false` where an active cycle goes by it.
    fn forget_group(&mut self, codes: &[(i64, Op, &str)]) -> bool {
        let Some((_, op, _)) = codes.first() else { return false };
        let active = matches!(self.state.cycle, CycleState::Active(_));
        match op {
            Op::SetDistanceMode(_) => self.state.modes.distance = Know::Lost,
            Op::SetOriginOffsets(_) if self.state.turned == 0 => self.state.modes.work_offset = Know::Lost,
            Op::SetFeedMode(_) if !active => {
                self.state.modes.feed_mode = Know::Lost;
                self.state.modes.feed = Know::Lost;
            }
            Op::UseLengthUnits(_) if !active => self.state.modes.units = Know::Lost,
            Op::SelectPlane(_) if !active => self.state.modes.plane = Know::Lost,
            Op::SetReturnLevel(_) if !active => {
                self.state.return_level = Know::Lost;
                self.state.level_changed |= self.state.cycle == CycleState::Lost;
            }
            // It ends a cycle.
            Op::StraightTraverse(_) | Op::StraightFeed(_) => {
                self.state.cycle = CycleState::None;
                self.state.after_cycle = false;
                self.state.rigid = None;
                self.state.modes.motion = Know::Lost;
                (self.state.thread, self.state.lead) = (None, None);
                self.state.no_motion = false;
            }
            _ => return false,
        }
        true
    }
}

/// Whether a code is one of those that are followed here.
fn is_mode(op: &Op) -> bool {
    matches!(
        op,
        Op::SetDistanceMode(_)
            | Op::SetOriginOffsets(_)
            | Op::SetFeedMode(_)
            | Op::UseLengthUnits(_)
            | Op::SelectPlane(_)
            | Op::SetReturnLevel(_)
            | Op::StraightTraverse(_)
            | Op::StraightFeed(_)
    )
}

/// Whether two codes say the same thing in another way.
fn is_alike(one: &Op, other: &Op) -> bool {
    let moves = |op: &Op| matches!(op, Op::StraightTraverse(_) | Op::StraightFeed(_));
    discriminant(one) == discriminant(other) || moves(one) && moves(other)
}
