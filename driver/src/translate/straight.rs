//! The way out of a program that computes and is refused: whether it goes through as straight blocks, with
//! `--pass flatten`.
//!
//! `WHILE [#1 LE 3] DO1`, `X#2`, … is refused where the target lacks what X#2 may be. Executed, it is X10., X20.
//! and X30. The answer is found by doing it, so that the message names only what works.

use std::io;

use ncc_dialects::{BLOCK_SKIP, BLOCK_WITHOUT_WAY, LOOKED_OVER};
use ncc_ir::diag::{Fault, Gravity};
use ncc_ir::lack::{CompensationLack, FlowLack, Lack};
use ncc_passes::PASSES;
use ncc_passes::watch::unwatched;

use super::rewrite::FLATTEN;
use super::translation::Translation;
use crate::job::{Job, Straight};
use crate::questions::Policy;
use crate::source::Readable;

/// Most steps and blocks of a program that is tried: a refusal must not cost more than a translation, and nobody reads
/// more straight blocks than that.
const MOST: u32 = 100_000;

/// Whether a message about straight blocks is missing: the program computes, and is refused for what the target lacks
/// alone.
pub(super) fn is_open(translation: &Translation) -> bool {
    let mut errors =
        translation.diagnostics.iter().filter(|d| d.fault.gravity() == Gravity::Error).peekable();
    let job = translation.job;
    translation.computes
        && job.passes.is_empty()
        && job.verify
        && errors.peek().is_some()
        && errors.all(|d| matches!(d.fault, Fault::TargetLacks { .. } | Fault::EntryFactNeeded { .. }))
}

/// The options with which ncc can write the program as straight blocks, if there are any.
///
/// # Errors
/// Reading the source failed.
pub(super) fn options(job: &Job, source: &mut dyn Readable) -> io::Result<Option<Straight>> {
    let passes = PASSES.iter().filter(|pass| pass.name == FLATTEN).collect();
    let mut job = Job { passes, questions: Policy::Assume, tried_upto: Some(MOST), ..job.clone() };
    let mut try_with = |job: &Job| {
        source.rewind()?;
        let outcome = unwatched(|| super::translate(job, source))?;
        let refused = |lack: Lack| {
            let is = |fault: &Fault| matches!(fault, Fault::TargetLacks { lack: own } if *own == lack);
            outcome.diagnostics.iter().any(|d| is(&d.fault))
        };
        let goes_through = outcome.release.is_ok() && outcome.verified.is_some();
        Ok::<_, io::Error>(match goes_through {
            true => Tried::GoesThrough,
            false if refused(FlowLack::SkippedDecision.into()) => Tried::Switch,
            false if refused(CompensationLack::WithoutMotion.into()) => Tried::WithoutWay,
            false => Tried::Refused,
        })
    };
    match try_with(&job)? {
        Tried::GoesThrough => return Ok(Some(Straight::Flattened)),
        Tried::Refused => return Ok(None),
        Tried::WithoutWay => {
            let stated = job.from.choose(BLOCK_WITHOUT_WAY, LOOKED_OVER).is_ok();
            let goes_through = stated && try_with(&job)? == Tried::GoesThrough;
            return Ok(goes_through.then_some(Straight::WithoutMotion));
        }
        Tried::Switch => {}
    }
    for stated in ["on", "off"] {
        if job.from.choose(BLOCK_SKIP, stated).is_err() || try_with(&job)? != Tried::GoesThrough {
            return Ok(None);
        }
    }
    Ok(Some(Straight::Switch))
}

/// What becomes of the program in straight blocks.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Tried {
    GoesThrough,
    /// It must be stated how the block-skip switch stands.
    Switch,
    /// It must be stated what a block without a way does to a compensated contour.
    WithoutWay,
    Refused,
}
