//! Alarms, and stops with a message: a variable of the control's own that is set, with the text as the comment of its
//! block. Which variable that is, the dictionary says (`[[system]]`).

use ncc_ir::diag::Fault;
use ncc_ir::lack::OperatorLack;
use ncc_ir::program::{Alarm, Op, Stmt};
use ncc_ir::run_time::RunTimeWord;

use crate::common::Sink;
use crate::common::fault::{cannot, cannot_compute};
use crate::word::Writer;

impl Writer {
    /// A message must be that of a program stop.
    ///
    /// # Errors
    /// It is not.
    pub(in crate::word) fn stop_has_text(&mut self, stmt: &Stmt) -> Result<(), Fault> {
        if self.stop_text.is_some() && !matches!(stmt.op, Op::ProgramStop) {
            self.stop_text = None;
            return Err(cannot(OperatorLack::OperatorMessage));
        }
        Ok(())
    }

    /// A program stop with the text that waits for it.
    pub(in crate::word) fn stop_with_text(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        self.flow(stmt, sink)?;
        let text = self.stop_setting(stmt, sink)?;
        self.statement_alone(&text, sink)
    }

    pub(in crate::word) fn stop_setting(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<String, Fault> {
        let text = self.stop_text.take();
        let number = self.variable_of("stop").ok_or_else(|| cannot(OperatorLack::StopMessage))?;
        if let Some(text) = text {
            self.comment_text(&text, stmt, sink)?;
        }
        Ok(self.sets(&number, "1"))
    }

    /// An alarm.
    pub(in crate::word) fn alarm(
        &mut self,
        alarm: &Alarm,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        self.flow(stmt, sink)?;
        let text = self.alarm_setting(alarm, stmt, sink)?;
        self.statement_alone(&text, sink)
    }

    pub(in crate::word) fn alarm_setting(
        &mut self,
        alarm: &Alarm,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        let variable = self.variable_of("alarm").ok_or_else(|| cannot(OperatorLack::Alarm))?;
        let number = alarm.number.as_ref().ok_or_else(|| cannot_compute(RunTimeWord::AlarmWithoutNumber))?;
        if let (Some(n), Some([from, to])) = (number.literal(), self.dialect.formula.alarms) {
            let known = n.whole_number().is_some_and(|n| (i64::from(from)..=i64::from(to)).contains(&n));
            if !known {
                return Err(cannot(OperatorLack::AlarmNumber));
            }
        }
        let value = self.words.expression(number, stmt.span, sink)?;
        if !alarm.text.is_empty() {
            self.comment_text(&alarm.text, stmt, sink)?;
        }
        Ok(self.sets(&variable, &value))
    }

    /// The variable of the control's own by which it does something.
    fn variable_of(&self, means: &str) -> Option<String> {
        let row = self.dialect.system.iter().find(|row| row.means == means)?;
        Some(format!("{}{}", self.dialect.formula.variable, row.number))
    }

    /// A comment that is a text for the operator: as it is, and the only one of its block.
    fn comment_text(&mut self, text: &str, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        if stmt.comment.is_some() {
            return Err(cannot(OperatorLack::CommentBesideText));
        }
        if text.chars().count() > self.dialect.formula.alarm_text {
            let most = self.dialect.formula.alarm_text;
            return Err(cannot(OperatorLack::TextLength { most }));
        }
        if !self.words.comments.keeps(text) {
            return Err(cannot(OperatorLack::TextCharacters));
        }
        self.words.comment(text, stmt.span, sink);
        Ok(())
    }
}
