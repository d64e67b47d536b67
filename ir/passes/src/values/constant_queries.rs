//! Modes that a program asks the control for and that are known there: their values in the places of the questions, for a
//! control that cannot be asked. A macro that saves `#3=#4003` where G90 is active on every path saves 90, and `G#3` is G90.
//!
//! Not here: what is known where (`mode_analysis`).

use ncc_ir::canon::{Modes, Motion};
use ncc_ir::computed::computed_code::computed_code;
use ncc_ir::computed::computes::Computes;
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Expr, Node, Target, Var};
use ncc_ir::program::{Control, Op};

use crate::support::shared_map::SharedMap;

/// Variables that have whole numbers, as far as is known.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Saved(SharedMap<Var, i64>);

impl Saved {
    /// A variable gets a value; `None` is one that is not known.
    pub(crate) fn set(&mut self, to: &Target, worth: Option<i64>) {
        match to {
            Target::Var(var) => match worth {
                Some(worth) => self.0.insert(var.clone(), worth),
                None => self.0.remove(var),
            },
            Target::Element(_) => self.0.clear(),
        }
    }

    /// Nothing is known.
    pub(crate) fn forget(&mut self) {
        self.0.clear();
    }

    /// What is known where two ways meet.
    pub(crate) fn join(&mut self, other: &Saved) {
        self.0.join(&other.0, |own, other| own.filter(|own| other == Some(own)).copied());
    }

    /// What a program that is called knows, with its caller's own variables or without.
    pub(crate) fn entered(mut self, shared: bool) -> Saved {
        self.0.retain(|var, _| shared || !matches!(var, Var::Local(_)));
        self
    }

    /// What its caller knows after the call.
    pub(crate) fn left(self, caller: &Saved, shared: bool) -> Saved {
        let mut behind = self.entered(shared);
        let own = caller.0.iter().filter(|(var, _)| !shared && matches!(var, Var::Local(_)));
        behind.0.extend(own.cloned());
        behind
    }

    /// What the code does whose number a variable has, if it is known.
    pub(crate) fn code(&self, control: &Control) -> Option<Op> {
        let code = computed_code(control)?;
        let Expr::Node(node) = code.number else { return None };
        let Node::Var(var) = &**node else { return None };
        let worth = self.0.get(var)?;
        let (_, op) = code.codes.into_iter().find(|(number, _)| number == worth)?;
        Some(op.clone())
    }
}

/// The whole number that an expression is worth, where modes that it asks for are known.
pub(crate) fn constant_value(value: &Expr, known: &Modes) -> Option<i64> {
    if let Expr::Num(n) = value {
        return n.whole_number();
    }
    let mut value = value.clone();
    match fill(&mut value, known, None) {
        true => value.literal().and_then(|n| n.whole_number()),
        false => None,
    }
}

/// Puts the answers into an expression that the target cannot say.
pub(crate) fn put_in(value: &mut Expr, known: &Modes, target: &Computes) {
    let asks = |part: &Node| matches!(part, Node::Var(Var::System(asked)) if !target.system.contains(asked));
    if !value.has(&asks) {
        return;
    }
    let mut answered = value.clone();
    if fill(&mut answered, known, Some(target)) {
        *value = answered;
    }
}

/// `false` where one of them is not known. Sums of products of what is whole are computed.
fn fill(value: &mut Expr, known: &Modes, target: Option<&Computes>) -> bool {
    let Expr::Node(node) = value else { return true };
    if let Node::Var(Var::System(asked)) = &**node {
        if target.is_some_and(|target| target.system.contains(asked)) {
            return true;
        }
        let Some(worth) = answer(asked, known) else { return false };
        *value = Expr::int(worth);
        return true;
    }
    let mut all = true;
    for part in value.parts_mut() {
        all &= fill(part, known, target);
    }
    if let Expr::Node(node) = value
        && let Node::Binary(operator @ (Binary::Add | Binary::Multiply), Expr::Num(a), Expr::Num(b)) = &**node
        && let (Some(a), Some(b)) = (a.whole_number(), b.whole_number())
    {
        let worth = if *operator == Binary::Add { a.checked_add(b) } else { a.checked_mul(b) };
        if let Some(worth) = worth {
            *value = Expr::int(worth);
        }
    }
    all
}

/// What such a question has for an answer, where these modes are active.
fn answer(asked: &System, known: &Modes) -> Option<i64> {
    fn is<T: PartialEq>(known: Option<T>, this: &T) -> Option<i64> {
        known.map(|known| i64::from(known == *this))
    }
    match asked {
        System::Units(units) => is(known.units, units),
        System::Distance(distance) => is(known.distance, distance),
        System::Plane(plane) => is(known.plane, plane),
        System::FeedMode(mode) => is(known.feed_mode, mode),
        System::ReturnLevel(level) => is(known.return_level, level),
        System::FirstWorkOffset => known.work_offset.filter(|of| (1..=6).contains(of)).map(i64::from),
        System::Motion(motion) => {
            is(known.motion.filter(|own| matches!(own, Motion::Traverse | Motion::Feed)), motion)
        }
        _ => None,
    }
}
