//! Values that a program puts into the control's tables: settable frames, lengths and radii of tools.
//!
//! A work offset counts with its new values when it is activated the next time (PGA, frames); one that is active is
//! activated again at once. Fine shifts of work offsets are taken for zero, and that is reported.

use ncc_dialects::{DataKind, DataRow, Meaning, Quantity};
use ncc_ir::canon::{Axis, Units};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Unit;
use ncc_ir::lack::TablesLack;
use ncc_ir::program::{Data, DataMode, Op, Stmt};
use ncc_ir::source::Span;

use super::{Sink, Writer, digits};
use crate::common::fault::cannot;

/// Work offsets that every machine has: G54 to G57.
const FACTORY_OFFSETS: u16 = 4;

/// Option of the dictionary: how many settable frames the machine has.
const USER_FRAMES: &str = "user_frames";

impl Writer {
    /// A value of a table.
    ///
    /// # Errors
    /// A value that no variable holds, or one of a work offset that may be active, and nobody knows.
    pub(super) fn data(&mut self, data: &Data, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let units = self.words.tracker.modes.units;
        let metric =
            (units == Some(Units::Inch) && self.basic_units == Units::Mm).then(|| in_millimetres(data));
        let Some(metric) = metric.flatten() else { return self.put(data, span, sink) };
        let code = |units| self.dialect.code_for(Meaning::UseLengthUnits(units)).map(|row| row.code.as_str());
        let (Some(mm), Some(inch)) = (code(Units::Mm), code(Units::Inch)) else {
            return self.put(data, span, sink);
        };
        self.alone(mm, sink)?;
        let in_force = self.words.active.units.replace(Units::Mm);
        self.words.tracker.modes.units = Some(Units::Mm);
        let put = self.put(&metric, span, sink);
        self.words.tracker.modes.units = units;
        self.words.active.units = in_force;
        put?;
        // A code of units loses the feed.
        self.standing.feed_said = false;
        self.alone(inch, sink)
    }

    fn put(&mut self, data: &Data, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        match data {
            Data::Offset { offset, mode: DataMode::Set, words, turn: None } => {
                let row = self.table(|row| row.kind == DataKind::Offset && *offset <= row.count);
                let row = row.ok_or_else(|| cannot(TablesLack::OffsetZero { offset: *offset }))?;
                let mut texts = Vec::new();
                for (axis, word) in Axis::ALL.into_iter().zip(words.iter()) {
                    let Some(word) = word else { continue };
                    let letter = char::from(axis.letter());
                    let name = row.name.replace('#', &offset.to_string()).replace('@', &letter.to_string());
                    texts.push(self.set(&name, axis, word, span, sink)?);
                }
                self.tell_fine_shifts(span, sink);
                self.alone(&texts.join(" "), sink)?;
                match self.words.tracker.modes.work_offset {
                    // Where blocks are come to from elsewhere, a reader may not know that it is another one.
                    Some(now) if now != *offset && !self.is_come_to() => Ok(()),
                    _ => self.call_up_again(span, sink),
                }
            }
            Data::Tool { entry, which, added: false, kept, value } => {
                let tracker = &self.words.tracker;
                if *kept && (tracker.tool.is_some() || tracker.selected.is_some()) {
                    return Err(cannot(TablesLack::ToolMaybeInUse));
                }
                let row = self.table(|row| {
                    let own = row.values.first().is_some_and(|word| *which == word.of.into());
                    own && *entry <= u32::from(row.count)
                });
                let row = row.ok_or_else(|| cannot(TablesLack::Value))?;
                let name = row.name.replace('#', &entry.to_string());
                let text = self.set(&name, Axis::Z, value, span, sink)?;
                self.alone(&text, sink)
            }
            Data::Offset { .. }
            | Data::Tool { .. }
            | Data::Measured { .. }
            | Data::Position(_)
            | Data::ToolInSpindle(_) => Err(cannot(TablesLack::Value)),
        }
    }

    /// The active work offset counts with its new values; where nobody knows it, it must be activated before it counts.
    pub(super) fn call_up_again(&mut self, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let Some(now) = self.words.tracker.modes.work_offset else {
            self.stale = true;
            return Ok(());
        };
        self.words.flush(false, sink);
        self.words.split = true;
        self.words.tracker.modes.work_offset = None;
        let again = self.words.statement(&Stmt::new(span, Op::SetOriginOffsets(now)), sink);
        self.words.tracker.modes.work_offset = Some(now);
        again
    }

    /// Before another statement, where a work offset has new values that may be active.
    ///
    /// # Errors
    /// It counts from there on, or another path reaches it.
    pub(super) fn called_up(&mut self, op: &Op) -> Result<(), Fault> {
        self.stale &= !matches!(op, Op::SetOriginOffsets(_));
        let counts = matches!(
            op,
            Op::StraightTraverse(_)
                | Op::StraightFeed(_)
                | Op::SynchronisedFeed(_)
                | Op::GoToReference(_)
                | Op::ArcFeed(_)
                | Op::ArcForm(_)
                | Op::Polar(_)
                | Op::Position(_)
                | Op::StartCycle(_)
                | Op::Hole(_)
                | Op::Pattern(_)
                | Op::Call(_)
                | Op::Return
                | Op::RepeatBlocks(_)
                | Op::Control(_)
                | Op::Goto(_)
                | Op::Label(_)
        );
        if self.stale && counts {
            return Err(cannot(TablesLack::OffsetNotActivatedAgain));
        }
        Ok(())
    }

    pub(super) fn table(&self, of: impl Fn(&DataRow) -> bool) -> Option<&'static DataRow> {
        self.dialect.data.iter().find(|row| row.is_variable() && of(row))
    }

    /// `$P_UIFR[1,X,TR]=100`
    pub(super) fn set(
        &mut self,
        name: &str,
        axis: Axis,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        // Tables count in the control's own unit.
        let units = self.words.tracker.modes.units.or(self.words.assumed.units);
        if units == Some(Units::Inch) || units.is_none() && self.inches {
            return Err(cannot(TablesLack::NotMillimetres));
        }
        if let Expr::Node(_) = value {
            return Ok(format!("{name}{}", self.words.behind(value, None, span, sink)?));
        }
        let quantity = if axis.is_rotary() { Quantity::Angle } else { Quantity::Length };
        let letter = self.letter(name, quantity);
        let value = self.words.number(&letter, value, span, sink)?;
        Ok(format!("{name}={}", digits(value)))
    }

    pub(super) fn tell_fine_shifts(&mut self, span: Span, sink: &mut Sink) {
        if self.reported.insert("fine shifts") {
            sink.report(Fault::AssumedFact { fact: ControlFact::FineShifts }, span);
        }
    }

    /// Whether the control has a work offset: those after G57 by its own datum.
    ///
    /// # Errors
    /// It is stated that it has not.
    pub(super) fn settable_frame(&mut self, number: u16, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if number <= FACTORY_OFFSETS {
            return Ok(());
        }
        self.words.rely(USER_FRAMES, span, sink);
        // The first of them is G500.
        let most = self.words.settings.get(USER_FRAMES).parse::<f64>().unwrap_or(0.0) - 1.0;
        match f64::from(number) <= most {
            true => Ok(()),
            false => Err(Fault::TargetRange { word: format!("G{}", 500 + number).into() }),
        }
    }
}

/// The same values in millimetres, as a control of that basic system keeps them, whose tables count in no unit of the
/// program; `None` where one is not a number of inches.
fn in_millimetres(data: &Data) -> Option<Data> {
    fn metric(value: &mut Expr) -> Option<()> {
        let Expr::Num(n) = value else { return None };
        if n.mantissa == 0 {
            n.unit = Unit::Mm;
            return Some(());
        }
        // One that counts what is active is inches here.
        if !matches!(n.unit, Unit::Inch | Unit::Entry) {
            return None;
        }
        (n.mantissa, n.scale, n.unit) = (n.mantissa.checked_mul(254)?, n.scale.checked_add(1)?, Unit::Mm);
        Some(())
    }
    let mut data = data.clone();
    match &mut data {
        Data::Offset { words, turn: None, .. } => {
            words.iter_mut().take(3).flatten().try_for_each(metric)?;
        }
        Data::Tool { value, .. } => metric(value)?,
        Data::Offset { .. } | Data::Measured { .. } | Data::Position(_) | Data::ToolInSpindle(_) => {
            return None;
        }
    }
    Some(data)
}
