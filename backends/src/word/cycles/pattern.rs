//! Patterns of holes: circles and grids by their own codes.

use ncc_ir::canon::{Axis, Motion};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::lack::{HolesLack, PatternsLack};
use ncc_ir::program::cycle::{Along, First, Pattern, Row};
use ncc_ir::program::{Coord, Stmt};
use ncc_ir::source::Span;

use super::super::Writer;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Code;
use crate::common::fault::cannot;
use crate::common::number::WordValue;
use crate::common::setting::Inserted;
use crate::common::{Sink, number};

impl Writer {
    /// A pattern of holes with the active cycle.
    pub(crate) fn pattern(&mut self, pattern: &Pattern, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        match self.held.take() {
            Some(held) if self.dialect.cycles.hole_on_definition => {
                self.held = Some(held);
                return Err(cannot(PatternsLack::Pattern));
            }
            Some(held) if !held.in_text || self.words.active.motion != Some(Motion::Cycle) => {
                self.call_up(held, None, true, stmt, sink)?;
            }
            Some(held) => self.held = Some(held),
            None => return Err(cannot(HolesLack::HolesOfUnknownCycle)),
        }
        match pattern {
            Pattern::Circle { first: First::Polar { .. }, .. } => Err(cannot(PatternsLack::CircleByRadius)),
            Pattern::Line { .. } => Err(cannot(PatternsLack::Line)),
            Pattern::List(_) => Err(cannot(PatternsLack::List)),
            Pattern::Grid { start: Some(_), .. } => Err(cannot(PatternsLack::GridFromPosition)),
            Pattern::Circle { centre, first: First::At(first), step, count } => {
                self.circle(centre.as_ref(), first, step, *count, stmt.span, sink)
            }
            Pattern::Grid { start: None, columns, rows, serpentine } => {
                self.grid(columns, rows, *serpentine, stmt.span, sink)
            }
        }
    }

    fn circle(
        &mut self,
        centre: Option<&[Coord; 2]>,
        first: &[Coord; 2],
        step: &Expr,
        count: u32,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let row = self.words.codes.circle.ok_or_else(|| cannot(PatternsLack::Circle))?;
        if centre.is_none() {
            let at = [
                self.words.tracker.position[Axis::X as usize],
                self.words.tracker.position[Axis::Y as usize],
            ];
            if self.options.circle_about_zero {
                let zero = self.words.axis_position(Axis::X)? == 0 && self.words.axis_position(Axis::Y)? == 0;
                if !zero {
                    return Err(cannot(PatternsLack::CircleAboutTool));
                }
            } else if at != [Some(0); 2] {
                self.words.rely("g24_centre", span, sink);
            }
        }
        self.words.rely("g24_direction", span, sink);
        let mut inserted = Inserted::default();
        self.words.need_distance(first.iter().chain(centre.into_iter().flatten()), &mut inserted)?;
        let mut words = Vec::with_capacity(6);
        for (letter, coord) in row.first.iter().zip(first) {
            words.push((letter.letter, self.words.value(letter, &coord.value, span, sink)?));
        }
        for (letter, coord) in row.centre.iter().zip(centre.into_iter().flatten()) {
            words.push((letter.letter, self.words.value(letter, &coord.value, span, sink)?));
        }
        let step = match (step.literal(), self.options.circle_clockwise) {
            (Some(n), true) => Expr::Num(Num { mantissa: n.mantissa.saturating_neg(), ..n }),
            _ => step.clone(),
        };
        words.push((row.step.letter, self.words.value(&row.step, &step, span, sink)?));
        words.push((row.count.letter, self.words.value(&row.count, &Expr::int(count.into()), span, sink)?));
        self.pattern_block(row.code, &words, inserted, sink)
    }

    fn grid(
        &mut self,
        columns: &Row,
        rows: &Row,
        serpentine: bool,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let row = self.words.codes.grid.ok_or_else(|| cannot(PatternsLack::Grid))?;
        let (x, y) = (Axis::from_letter(row.pitch[0].letter), Axis::from_letter(row.pitch[1].letter));
        // The order of the holes shows only where there is more than one row.
        let order = serpentine == row.serpentine || rows.count <= 1 || columns.count <= 1;
        let along = |row: &Row, axis: Option<Axis>| axis.is_some_and(|a| row.along == Along::Axis(a));
        if !along(columns, x) || !along(rows, y) || !order {
            return Err(cannot(PatternsLack::GridOrder));
        }
        if columns.count > 2 || rows.count > 2 {
            self.words.rely("g25_xy", span, sink);
        }
        let mut words = Vec::with_capacity(4);
        for (letter, line) in row.pitch.iter().zip([columns, rows]) {
            let pitch = match (line.pitch.literal(), self.options.grid_extent) {
                (Some(n), true) => {
                    let steps = i64::from(line.count.saturating_sub(1));
                    let mantissa = n.mantissa.checked_mul(steps);
                    let too_far = || Fault::TargetRange { word: number::spell(letter.letter, n) };
                    Expr::Num(Num { mantissa: mantissa.ok_or_else(too_far)?, ..n })
                }
                _ => line.pitch.clone(),
            };
            words.push((letter.letter, self.words.value(letter, &pitch, span, sink)?));
        }
        for (letter, line) in row.counts.iter().zip([columns, rows]) {
            words.push((letter.letter, self.words.value(letter, &Expr::int(line.count.into()), span, sink)?));
        }
        self.pattern_block(row.code, &words, Inserted::default(), sink)
    }

    fn pattern_block(
        &mut self,
        code: Code,
        words: &[(u8, WordValue)],
        inserted: Inserted,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let need = words.iter().fold(Need::new(Rank::Motion).code(Some(code)), |n, (l, _)| n.letter(*l));
        self.words.admit_with(need, inserted, sink)?;
        self.words.block.code(Part::Motion, &code);
        for (letter, value) in words {
            self.words.block.word(Part::Axes, *letter, *value);
        }
        Ok(())
    }
}
