//! Lowering of patterns of hole positions: bolt circles and grids.
//!
//! What the sources leave open is a dictionary option, and reported where it decides. The
//! positions are not made here: a pattern stays a pattern.

use ncc_dialects::{CYCLE_APPROACH, PatternRow, Quantity};
use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::{Along, First, Pattern, Row};
use ncc_ir::program::{Coord, Op};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CycleUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::Word;
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;
use crate::word::word_state::CycleState;

impl Lower {
    /// A pattern of holes.
    pub(in crate::word) fn pattern(
        &mut self,
        code: &Code,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let Some(row) = self.settings.dialect.pattern_row(&code.row.code) else {
            return;
        };
        if self.state.cycle == CycleState::None {
            self.fault(Fault::NoCycle, code.span, out);
        }
        let distance = self.distance(code.span, out);
        if self.incremental_unknown(distance) {
            let what = CycleUnsupported::PatternIncrements.into();
            self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), what }, code.span, out);
        }
        let pattern = match row {
            PatternRow::Circle { first, centre, step, count, .. } => {
                self.circle(code, [*first, *centre], *step, *count, distance, words, src, out)
            }
            PatternRow::Grid { pitch, counts, serpentine, .. } => {
                self.grid(code, *pitch, *counts, *serpentine, words, src, out)
            }
        };
        if self.now.recall && matches!(self.state.cycle, CycleState::Active(_)) {
            self.call_up(block, out);
        }
        if let Some(pattern) = pattern {
            self.rely_on_frames(true, block, out);
            self.push(block, Op::Pattern(Box::new(pattern)), out);
            self.holes_made();
        }
    }

    #[allow(clippy::too_many_arguments)] // The columns of the row.
    fn circle(
        &mut self,
        code: &Code,
        [first, centre]: [[char; 2]; 2],
        step: char,
        count: char,
        distance: Fact<Distance>,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<Pattern> {
        let count = self.count(code, count, words, src, out);
        let x = self.needed(code, first[0], Quantity::Length, words, src, out);
        let y = self.needed(code, first[1], Quantity::Length, words, src, out);
        let mut turn = self.needed(code, step, Quantity::Angle, words, src, out);
        let coord = |num: Num, distance| Coord { value: Expr::Num(num), distance };
        let absolute = Fact::Known(Distance::Absolute);
        let centre = if words.get(centre[0] as u8).or_else(|| words.get(centre[1] as u8)).is_some() {
            let i = self.needed(code, centre[0], Quantity::Length, words, src, out)?;
            let j = self.needed(code, centre[1], Quantity::Length, words, src, out)?;
            Some([coord(i, absolute), coord(j, absolute)])
        } else if self.option("g24_centre", code.span, out) == "zero" {
            let zero = Num::int(0, Unit::Mm);
            Some([coord(zero, absolute), coord(zero, absolute)])
        } else {
            None
        };
        // The first hole is not where the tool is: the way to it is open in some dictionaries.
        self.option(CYCLE_APPROACH, code.span, out);
        let count = count?;
        if count > 1 && self.option("g24_direction", code.span, out) == "cw" {
            turn = turn.map(|t| Num { mantissa: -t.mantissa, ..t });
        }
        Some(Pattern::Circle {
            centre,
            first: First::At([coord(x?, distance), coord(y?, distance)]),
            step: Expr::Num(turn?),
            count,
        })
    }

    #[allow(clippy::too_many_arguments)] // The columns of the row.
    fn grid(
        &mut self,
        code: &Code,
        pitch: [char; 2],
        counts: [char; 2],
        serpentine: bool,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<Pattern> {
        let columns = self.count(code, counts[0], words, src, out);
        let rows = self.count(code, counts[1], words, src, out);
        let x = self.needed(code, pitch[0], Quantity::Length, words, src, out);
        let y = self.needed(code, pitch[1], Quantity::Length, words, src, out);
        let (columns, rows) = (columns?, rows?);
        // With two of a kind the pitch is the extent, whatever the words mean.
        let extent = columns.max(rows) > 2 && self.option("g25_xy", code.span, out) == "extent";
        let mut row = |letter: char, num: Option<Num>, count: u32| {
            let num = num?;
            let pitch = match extent && count > 2 {
                false => num,
                true => match divided(num, count - 1) {
                    Some(pitch) => pitch,
                    None => {
                        let word = letter.to_string().into();
                        return self.refuse(Fault::OutOfRange { word }, code.span, out);
                    }
                },
            };
            let axis = Axis::from_letter(letter as u8)?;
            Some(Row { along: Along::Axis(axis), pitch: Expr::Num(pitch), count })
        };
        let columns = row(pitch[0], x, columns);
        let rows = row(pitch[1], y, rows);
        Some(Pattern::Grid { start: None, columns: columns?, rows: rows?, serpentine })
    }

    /// A word that the code needs.
    fn needed(
        &mut self,
        code: &Code,
        letter: char,
        quantity: Quantity,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<Num> {
        match words.take(letter as u8) {
            Some(word) => self.number(&word, quantity, src, out),
            None => {
                self.missing(code, letter, out);
                None
            }
        }
    }

    /// A number of holes, at least one.
    fn count(
        &mut self,
        code: &Code,
        letter: char,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<u32> {
        let Some(word): Option<Word> = words.take(letter as u8) else {
            self.missing(code, letter, out);
            return None;
        };
        match self.read_whole(&word, src, out)? {
            count @ 1..=9999 => Some(count),
            _ => self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out),
        }
    }
}

/// A length divided by a count: exactly, or to a nano.
fn divided(num: Num, by: u32) -> Option<Num> {
    let by = i64::from(by);
    if num.mantissa % by == 0 {
        return Some(Num { mantissa: num.mantissa / by, ..num });
    }
    // Digits are added until it comes out even, at most nine after the point.
    let mut wide = num;
    while wide.scale < 9 {
        wide = Num { mantissa: wide.mantissa.checked_mul(10)?, scale: wide.scale + 1, point: true, ..wide };
        if wide.mantissa % by == 0 {
            return Some(Num { mantissa: wide.mantissa / by, ..wide });
        }
    }
    let half = by / 2 * wide.mantissa.signum();
    Some(Num { mantissa: (wide.mantissa + half) / by, ..wide })
}
