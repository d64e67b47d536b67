//! The units of length that a program's text says, or that were assumed where it begins.
//!
//! Not here: which of them is active where: that is found on the way through the program.

use crate::canon::Units;
use crate::program::{Op, Program, Stmt};

/// Which of them are stated anywhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Said {
    /// Millimetres.
    pub mm: bool,
    /// Inches.
    pub inch: bool,
}

impl Said {
    /// By a program.
    pub fn by(program: &Program) -> Said {
        let mut said = Said::default();
        program.assumed.units.into_iter().for_each(|units| said.says(units));
        program.procedures.iter().for_each(|procedure| said.body(&procedure.body));
        said
    }

    /// The unit that no other is stated beside; none if nothing says any.
    pub const fn only(self) -> Option<Units> {
        match (self.mm, self.inch) {
            (true, false) => Some(Units::Mm),
            (false, true) => Some(Units::Inch),
            (false, false) | (true, true) => None,
        }
    }

    fn body(&mut self, body: &[Stmt]) {
        for stmt in body {
            match &stmt.op {
                Op::UseLengthUnits(units) => self.says(*units),
                Op::Control(control) => control.bodies().for_each(|body| self.body(body)),
                _ => {}
            }
        }
    }

    const fn says(&mut self, units: Units) {
        match units {
            Units::Mm => self.mm = true,
            Units::Inch => self.inch = true,
        }
    }
}
