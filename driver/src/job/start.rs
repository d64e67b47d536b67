//! What the user states of the machine before the program begins: where its axes stand, and which tool is in the spindle.
//!
//! The tool is that of the T code active (Fanuc `--value '#4120=2'`): a program that begins without a tool change cuts
//! with it.

use ncc_backends::Writer;
use ncc_exec::Exec;
use ncc_ir::canon::{AXES, Axis};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Nanos;
use ncc_ir::expr::system::System;
use ncc_ir::source::Span;
use ncc_passes::Legaliser;

use super::Job;
use super::initial_variables::{InitialVariables, decimal};
use crate::problem::problem;
use crate::render::numbers::signed;

/// What is stated of the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    at: [Option<Nanos>; AXES],
    tool: Option<u32>,
}

impl Start {
    /// What a job states.
    pub(crate) fn of(job: &Job) -> Start {
        Start { at: job.start, tool: job.tool_at_start() }
    }

    /// Has source and target begin with it; the target's axes then go to where the source's are.
    pub(crate) fn put(&self, [source, target]: [&mut Exec; 2]) {
        source.stand_at(&self.at);
        if let Some(tool) = self.tool {
            source.hold_tool(tool);
            target.hold_tool(tool);
        }
    }
}

/// Why a text is no position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoPosition {
    /// A word does not begin with an axis.
    NoAxis(String),
    /// A word has no decimal behind its axis.
    NoDecimal(String, Axis),
    /// An axis is given twice.
    Twice(Axis),
}

impl NoPosition {
    /// In words.
    pub fn words(&self) -> String {
        let letter = |axis: &Axis| char::from(axis.letter()).to_string();
        let message = match self {
            NoPosition::NoAxis(word) => problem("start-axis").text("word", word.as_str()),
            NoPosition::NoDecimal(word, axis) => {
                problem("start-decimal").text("word", word.as_str()).text("axis", letter(axis))
            }
            NoPosition::Twice(axis) => problem("start-twice").text("axis", letter(axis)),
        };
        message.headline()
    }
}

/// Reads a position: `X-9,Y15.588,Z3`, mm and degrees; gives nanos, and none of axes that are not named.
///
/// # Errors
/// It is not of this form.
pub fn position(text: &str) -> Result<[Option<Nanos>; AXES], NoPosition> {
    let mut position = [None; AXES];
    for word in text.split(',').map(str::trim) {
        let mut chars = word.chars();
        let axis = chars.next().map(|c| c.to_ascii_uppercase());
        let axis = axis.and_then(|c| u8::try_from(c).ok()).and_then(Axis::from_letter);
        let axis = axis.ok_or_else(|| NoPosition::NoAxis(word.to_owned()))?;
        let value = decimal(chars.as_str()).ok_or_else(|| NoPosition::NoDecimal(word.to_owned(), axis))?;
        if position[axis as usize].replace(value).is_some() {
            return Err(NoPosition::Twice(axis));
        }
    }
    Ok(position)
}

/// Where the axes stand before the program begins, as assumptions for head and report.
pub fn assumed(at: &[Option<Nanos>; AXES]) -> Vec<Diagnostic> {
    let stated = Axis::ALL.iter().zip(at).filter_map(|(axis, at)| Some((axis, (*at)?)));
    let fault = |(axis, at): (&Axis, Nanos)| Fault::AssumedFact {
        fact: ControlFact::AxisAtStart { axis: *axis, place: signed(at).into() },
    };
    stated.map(|stated| Diagnostic::new(fault(stated), Span::default())).collect()
}

impl Job {
    /// Has passes and writer begin with it.
    pub(crate) fn stand(&self, legaliser: &mut Legaliser, writer: &mut Writer) {
        legaliser.stand_at(&self.start);
        writer.stand_at(&self.start);
        if let Some(tool) = self.tool_at_start() {
            legaliser.hold_tool(tool);
            writer.hold_tool(tool);
        }
    }

    /// What variables may be given when the program runs: not the T and H code active at the start, which are read with
    /// the text.
    pub(crate) fn given_to_runs(&self) -> InitialVariables {
        if self.given.names().next().is_none() {
            return self.given.clone();
        }
        let with_text = [System::SelectedTool, System::LengthEntry].map(|of| self.from.variable_of(&of));
        with_text.into_iter().flatten().fold(self.given.clone(), |given, name| given.without(&name))
    }

    /// The tool in the spindle before the program begins, as far as the user states the T code active.
    pub fn tool_at_start(&self) -> Option<u32> {
        self.from.stated_of(&System::SelectedTool).and_then(|(_, tool)| u32::try_from(tool).ok())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stated_start_is_exact() {
        let s = position("X-9,Y15.588,z+3").expect("a position");
        assert_eq!(s[..3], [Some(-9_000_000_000), Some(15_588_000_000), Some(3_000_000_000)]);
        for wrong in ["", "X", "X.", "Q1", "X1,X2", "X1e3", "X1.2.3", "X99999999999", "X0.1234567890"] {
            assert!(position(wrong).is_err(), "{wrong}");
        }
    }
}
