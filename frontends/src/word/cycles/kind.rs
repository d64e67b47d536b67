//! How the hole of a cycle's row is made, and whether it has a dwell.

use ncc_dialects::{CycleRow, DWELL_REFUSED, DWELLS, Hand};
use ncc_ir::canon::Spindle;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::program::Pitch;
use ncc_ir::program::cycle::{BoreStop, Clearance, CycleKind, FineBore, Shift, Tap};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CycleUnsupported;

use crate::batch::Batch;
use crate::word::lower::Lower;

/// How deep pecks are.
#[derive(Clone, Debug)]
pub(super) struct Pecks {
    /// Each of them; the least of those that decrease.
    pub(super) peck: Expr,
    /// The first, and how much less each further one is.
    pub(super) shrinking: Option<[Num; 2]>,
}

/// The cycle of a row; `Err` with the letter of the word that it lacks.
pub(super) fn kind_of(
    row: &CycleRow,
    rigid: bool,
    dwell: Option<Num>,
    pecks: Option<Pecks>,
) -> Result<CycleKind, char> {
    let (own, to_level) = (row.own(), row.feed_to_level);
    let shrinking = pecks.as_ref().and_then(|pecks| pecks.shrinking);
    let peck = pecks.map(|pecks| pecks.peck);
    let (first, less) = (shrinking.map(|s| Expr::Num(s[0])), shrinking.map(|s| Expr::Num(s[1])));
    if row.dwell_needed && dwell.is_none() {
        return Err(row.dwell.map_or(' ', |d| d.letter));
    }
    // A dwell of no seconds is none, where a cycle can go without.
    let none = row.kind != "drill-dwell";
    let is_one = |dwell: &Num| !(none && dwell.is_zero());
    let bottom = dwell.filter(is_one).map(Expr::Num);
    let own_pause = row.own_pause().map(Expr::Num);
    Ok(match row.kind.as_str() {
        "drill-dwell" => CycleKind::DrillDwell { dwell: bottom.ok_or(row.dwell.map_or(' ', |d| d.letter))? },
        "drill-peck" => CycleKind::DrillPeck {
            peck: peck.ok_or(row.peck.unwrap_or(' '))?,
            first,
            less,
            clearance: if row.from_return { Clearance::FromReturn } else { Clearance::Parameter },
            pause: own_pause.clone(),
            settle: None,
            dwell: own_pause.or(bottom),
        },
        "drill-break" => CycleKind::DrillBreak {
            peck: peck.ok_or(row.peck.unwrap_or(' '))?,
            first,
            less,
            lift: Clearance::Parameter,
            lift_at_feed: false,
            pause: own_pause.clone(),
            dwell: own_pause.or(bottom),
        },
        "tap" | "tap-rigid" => {
            let turn = row.hand.unwrap_or(Hand::Right).turn();
            let chuck = !rigid;
            let after = if chuck { turn.spindle() } else { Spindle::Stopped };
            let (dwell, back, settle) = match own.dwells_turned {
                true => (None, bottom, None),
                false => (bottom.clone(), None, bottom),
            };
            let pitch = Pitch::Feed;
            CycleKind::Tap(Box::new(Tap { turn, pitch, chuck, dwell, back, settle, after, to_level }))
        }
        "bore-fine" => {
            let shift = Shift::Parameter(peck.ok_or(row.shift.unwrap_or(' '))?);
            let after = own.after();
            CycleKind::FineBore(Box::new(FineBore { turn: None, dwell: bottom, angle: None, shift, after }))
        }
        "bore-stop" => {
            CycleKind::BoreStop(BoreStop { turn: None, dwell: bottom, stop: false, after: own.after() })
        }
        "bore" => CycleKind::Bore { dwell: bottom, feed_out: None, to_level },
        // The loader lets no other kind pass.
        _ => bottom.map_or(CycleKind::Drill, |dwell| CycleKind::DrillDwell { dwell }),
    })
}

impl Lower {
    /// The dwell of a cycle, of the one that is active: where the sources do not agree whether it has one,
    /// an option is asked. A cycle that refuses one says nothing of what an earlier cycle has left.
    pub(super) fn dwells(
        &mut self,
        row: &'static CycleRow,
        [given, dwell]: [Option<Num>; 2],
        at: Span,
        out: &mut Batch,
    ) -> Option<Num> {
        let dwell = dwell.filter(|_| row.dwell.is_some() || row.dwell_by.is_some())?;
        let Some(asked) = row.dwell_by.as_ref().filter(|_| !dwell.is_zero()) else {
            return Some(dwell);
        };
        if given.is_none() && self.settings.get(&asked.option) == DWELL_REFUSED {
            return None;
        }
        match self.option(&asked.option, at, out) {
            DWELLS => Some(dwell),
            DWELL_REFUSED => {
                let option = asked.option.as_str().into();
                let what = CycleUnsupported::DwellByOption { letter: asked.letter, option };
                self.refuse(Fault::not_supported(row.code.as_str(), what), at, out)
            }
            _ => None,
        }
    }
}
