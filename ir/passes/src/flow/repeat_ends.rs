//! Both ends of repeated blocks named by blocks that say something, as a target with block numbers needs it.
//!
//! Part of `expand-repeats`. Not here: the numbers themselves, which the writer gives.

use std::collections::BTreeSet;

use ncc_exec::again;
use ncc_ir::canon::Axis;
use ncc_ir::program::{Centre, CentreFrom, Op, Stmt, Text};
use ncc_ir::track::Tracker;

/// Whether blocks that are repeated repeat others.
pub(crate) fn nested(body: &[Stmt]) -> bool {
    body.iter().enumerate().any(|(at, stmt)| {
        let Op::RepeatBlocks(repeat) = &stmt.op else { return false };
        let blocks = again(body, at, &repeat.from, repeat.to.as_deref()).unwrap_or_default();
        blocks.iter().any(|s| matches!(s.op, Op::RepeatBlocks(_)))
    })
}

/// Whether blocks that are repeated have an arc whose centre is measured from its start, and it is another
/// start each time, or not known to be the same.
pub(crate) fn moves_arcs(body: &[Stmt]) -> bool {
    body.iter().enumerate().any(|(at, stmt)| {
        let Op::RepeatBlocks(repeat) = &stmt.op else { return false };
        let mut here = Tracker::unknown();
        let blocks = again(body, at, &repeat.from, repeat.to.as_deref()).unwrap_or_default();
        blocks.iter().any(|stmt| {
            let open = match &stmt.op {
                Op::ArcFeed(arc) => here.plane(arc.plane).is_none_or(|plane| {
                    let (first, second, _) = plane.axes();
                    let known = |axis: Axis| here.position[axis as usize].is_some();
                    let from_start = matches!(arc.centre, Centre::Point { from: CentreFrom::Start, .. });
                    from_start && !(known(first) && known(second))
                }),
                _ => false,
            };
            here.step(stmt);
            open
        })
    })
}

/// Whether blocks that make holes are repeated under another cycle than they stand under.
pub(crate) fn under_another_cycle(body: &[Stmt]) -> bool {
    let cycle_at = |at: usize| {
        let mut before = body[..at].iter().rev().map(|s| &s.op);
        before.find(|op| matches!(op, Op::StartCycle(_) | Op::EndCycle))
    };
    body.iter().enumerate().any(|(at, stmt)| {
        let Op::RepeatBlocks(repeat) = &stmt.op else { return false };
        let blocks = again(body, at, &repeat.from, repeat.to.as_deref()).unwrap_or_default();
        let holes = blocks.iter().any(|s| matches!(s.op, Op::Hole(_) | Op::Pattern(_)));
        let is_first = |s: &Stmt| matches!(&s.op, Op::Label(label) if *label == repeat.from);
        let start = body[..at].iter().rposition(is_first).unwrap_or(at);
        holes && cycle_at(start) != cycle_at(at)
    })
}

/// Whether a cycle is activated, or ends, within blocks that are repeated.
pub(crate) fn changes_cycle(body: &[Stmt]) -> bool {
    body.iter().enumerate().any(|(at, stmt)| {
        let Op::RepeatBlocks(repeat) = &stmt.op else { return false };
        let blocks = again(body, at, &repeat.from, repeat.to.as_deref()).unwrap_or_default();
        blocks.iter().any(|s| matches!(s.op, Op::StartCycle(_) | Op::EndCycle))
    })
}

/// Whether a block that is repeated alone calls a cycle up or ends one, which takes blocks of their own.
pub(crate) fn is_one_block_of_several(body: &[Stmt]) -> bool {
    body.iter().enumerate().any(|(at, stmt)| {
        let Op::RepeatBlocks(repeat) = &stmt.op else { return false };
        let alone = repeat.to.as_ref() == Some(&repeat.from);
        let blocks = again(body, at, &repeat.from, repeat.to.as_deref()).unwrap_or_default();
        alone && blocks.iter().any(|s| matches!(s.op, Op::StartCycle(_) | Op::EndCycle))
    })
}

/// Names the last block of every repetition that says something.
pub(crate) fn name(body: &mut Vec<Stmt>, known: &BTreeSet<Text>) {
    let mut last = 0u32;
    let mut at = 0;
    while at < body.len() {
        let Op::RepeatBlocks(repeat) = &body[at].op else {
            at += 1;
            continue;
        };
        let Some(blocks) = again(body, at, &repeat.from, repeat.to.as_deref()) else {
            at += 1;
            continue;
        };
        // Where the blocks stand is reported by the label at which they begin.
        let from = repeat.from.clone();
        let length = blocks.len();
        let is_first = |s: &Stmt| matches!(&s.op, Op::Label(label) if *label == from);
        let start = body[..at].iter().rposition(is_first).unwrap_or(at);
        let says = |s: &Stmt| !matches!(s.op, Op::Label(_) | Op::Blank | Op::Comment(_));
        let Some(place) = (start..start + length).rev().find(|i| says(&body[*i])) else {
            // Nothing is repeated.
            body[at].op = Op::Blank;
            at += 1;
            continue;
        };
        let place = (start..=place).rev().find(|i| !body[*i].joined).unwrap_or(start);
        let name = match &body[place].op {
            Op::Label(name) => name.clone(),
            _ => {
                let name = loop {
                    last += 1;
                    let name: Text = format!("LAST{last}").into();
                    if !known.contains(&name) {
                        break name;
                    }
                };
                let first = &mut body[place];
                let mut label = Stmt::new(first.span, Op::Label(name.clone()));
                (label.number, label.skip) = (first.number.take(), first.skip);
                first.joined = true;
                body.insert(place, label);
                at += 1;
                name
            }
        };
        if let Op::RepeatBlocks(repeat) = &mut body[at].op {
            repeat.to = Some(name);
        }
        at += 1;
    }
}
