//! Text for the device that the control has for it: `POPEN`, `DPRNT[…]`, `PCLOS` (96-8000 Rev AC, macros, formatted output;
//! NCT 2000M, page 193; 8520-GUM, chapter 20).

use ncc_dialects::Statement;
use ncc_ir::diag::Fault;
use ncc_ir::lack::OperatorLack;
use ncc_ir::program::{Output, Piece, Stmt};

use crate::common::Sink;
use crate::common::fault::cannot;
use crate::word::Writer;

impl Writer {
    /// Text for a device.
    pub(in crate::word) fn output(
        &mut self,
        output: &Output,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        if !self.dialect.formula.statements.contains(&Statement::Output) {
            return Err(cannot(OperatorLack::DeviceText));
        }
        self.flow(stmt, sink)?;
        let text = match output {
            Output::Open => "POPEN".to_owned(),
            Output::Close => "PCLOS".to_owned(),
            Output::Line(pieces) => self.line_for_device(pieces, stmt, sink)?,
        };
        self.statement_alone(&text, sink)
    }

    fn line_for_device(&mut self, pieces: &[Piece], stmt: &Stmt, sink: &mut Sink) -> Result<String, Fault> {
        let mut text = String::from("DPRNT[");
        for piece in pieces {
            match piece {
                Piece::Text(plain) => {
                    for c in plain.chars() {
                        match c {
                            ' ' => text.push('*'),
                            'A'..='Z' | '0'..='9' | '+' | '-' | '/' => text.push(c),
                            _ => return Err(cannot(OperatorLack::DeviceCharacters)),
                        }
                    }
                }
                Piece::Value { value, digits, short, places } => {
                    let most = self.dialect.formula.output_digits;
                    if *short || *digits > 9 || *places > 9 || !(1..=most).contains(&(places + digits)) {
                        return Err(cannot(OperatorLack::DeviceDigits));
                    }
                    let value = self.words.behind(value, None, stmt.span, sink)?;
                    let number = value.strip_prefix('#').unwrap_or_default();
                    if number.is_empty() || !number.bytes().all(|byte| byte.is_ascii_digit()) {
                        return Err(cannot(OperatorLack::DeviceValueNoVariable));
                    }
                    text.push_str(&format!("{value}[{places}{digits}]"));
                }
            }
        }
        text.push(']');
        Ok(text)
    }
}
