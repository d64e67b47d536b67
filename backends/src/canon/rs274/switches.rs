//! The operator's switches, and the stop of the spindle at an angle.

use std::fmt::Write;

use ncc_ir::canon::AdviceKind;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::lack::WordsLack;
use ncc_ir::program::{Advice, Stmt};

use super::{Printer, cannot, literal};

impl Printer<'_> {
    /// Whether a switch counts.
    pub(super) fn switch(&mut self, advice: &Advice) -> Result<(), Fault> {
        let (what, spindle) = match advice.kind {
            AdviceKind::FeedOverride => ("FEED_OVERRIDE", ""),
            AdviceKind::SpeedOverride => ("SPEED_OVERRIDE", "0"),
            AdviceKind::FeedStop => ("FEED_HOLD", ""),
            AdviceKind::LookAhead
            | AdviceKind::ContourControl
            | AdviceKind::HighPrecision
            | AdviceKind::FeedForward
            | AdviceKind::Acceleration
            | AdviceKind::Compressor
            | AdviceKind::Dynamics
            | AdviceKind::ExactStopWindow
            | AdviceKind::Orientation
            | AdviceKind::WorkingArea
            | AdviceKind::StrokeCheck
            | AdviceKind::PathTolerance
            | AdviceKind::CompensatedFeed
            | AdviceKind::Smoothness
            | AdviceKind::ReadAhead
            | AdviceKind::ChipConveyor
            | AdviceKind::Door
            | AdviceKind::Screen => return Err(cannot(WordsLack::Function { function: "ADVISE" })),
        };
        let able = if advice.value_name() == "on" { "ENABLE" } else { "DISABLE" };
        let _ = writeln!(self.out, "{able}_{what}({spindle})");
        Ok(())
    }

    /// The shortest way to an angle; how long it may take is the block's Q, which changes nothing about the cut.
    pub(super) fn orient(&mut self, angle: Option<&Expr>, stmt: &Stmt) -> Result<(), Fault> {
        let angle = angle.map_or(Ok(0.0), literal)?;
        let _ = writeln!(self.out, "ORIENT_SPINDLE(0, {angle:.4}, 0)");
        if let Some(wait) = self.word_of_line(stmt, b'Q') {
            let _ = writeln!(self.out, "SPINDLE.0.WAIT_ORIENT_COMPLETE({wait:.4})");
        }
        Ok(())
    }

    /// The number after a letter on a statement's line, where it stands as a number.
    fn word_of_line(&self, stmt: &Stmt, letter: u8) -> Option<f64> {
        let line = self.source.get(stmt.span.start as usize..)?.split(|b| *b == b'\n').next()?;
        let words = line.split(|b| matches!(b, b'(' | b';')).next()?;
        let at = words.iter().position(|b| b.eq_ignore_ascii_case(&letter))?;
        let number = words[at + 1..].trim_ascii_start();
        let end = number.iter().position(|b| !matches!(b, b'0'..=b'9' | b'.')).unwrap_or(number.len());
        std::str::from_utf8(&number[..end]).ok()?.parse().ok()
    }
}
