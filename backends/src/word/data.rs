//! Values put into the control's tables: a code with the words that say which table and which entry.

use ncc_dialects::{DataKind, RADIUS_DATA};
use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Expr, Node, Target, Var};
use ncc_ir::lack::{FramesLack, LengthsLack, TablesLack};
use ncc_ir::program::{Coord, Data, DataMode, ToolLength, ToolValue};
use ncc_ir::source::Span;

use super::Writer;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::DataCode;
use crate::common::codes::{Code, Letter};
use crate::common::fault::cannot;
use crate::common::formula::rounding;
use crate::common::number::WordValue;
use crate::common::setting::Inserted;

impl Writer {
    /// Puts values into a table, in a block of its own.
    pub(crate) fn data(&mut self, data: &Data, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        // The code's words count as the distance mode says; where nobody knows it, the control's variable is set.
        if self.dialect.program.macro_b
            && self.words.active.distance != Some(Distance::Absolute)
            && let Some(text) = self.data_setting(data, span, sink)?
        {
            return self.statement_alone(&text, sink);
        }
        let tables = &self.words.codes.tables;
        match data {
            Data::Position(place) => {
                let code = self.words.codes.store_position[usize::from(*place == 2)];
                let code = code.ok_or_else(|| cannot(TablesLack::AxesPosition))?;
                self.alone(code, Vec::new(), sink)
            }
            Data::ToolInSpindle(tool) => {
                let code = self.words.codes.tool_number.filter(|_| tool.literal().is_some());
                let (code, letter) = code.ok_or_else(|| cannot(TablesLack::ToolInSpindle))?;
                let value = self.words.value(&letter, tool, span, sink)?;
                self.alone(code, vec![(letter.letter, value)], sink)
            }
            Data::Offset { offset, mode, words, turn } => {
                let kind = match mode {
                    DataMode::Set | DataMode::Add => DataKind::Offset,
                    DataMode::Here => DataKind::OffsetHere,
                };
                let has = |table: &&DataCode| {
                    let row = table.row;
                    row.kind == kind && offset.checked_sub(row.first).is_some_and(|n| n < row.count)
                };
                let what = || cannot(TablesLack::OffsetZero { offset: *offset });
                let table = tables.iter().find(has).ok_or_else(what)?.clone();
                let mut own = self.words.along(&words[..])?;
                if let Some(turn) = turn {
                    let letter = table.turn.ok_or_else(|| cannot(FramesLack::OffsetRotation))?;
                    own.push((letter, turn.clone()));
                }
                let entry = u32::from(offset - table.row.first) + 1;
                self.stored(&table, &entry.to_string(), *mode == DataMode::Add, &own, span, sink)
            }
            Data::Measured { entry, offset, words } => {
                let has = |table: &&DataCode| {
                    let row = table.row;
                    row.kind == DataKind::ToolHere
                        && row.in_offset == offset.unwrap_or(0)
                        && *entry <= u32::from(row.count)
                };
                let table = tables.iter().find(has).ok_or_else(|| cannot(TablesLack::MeasuredTool))?;
                let own = self.words.along(&words[..])?;
                self.stored(&table.clone(), &entry.to_string(), false, &own, span, sink)
            }
            Data::Tool { entry, which, added, value, .. } => {
                let has = |table: &DataCode| {
                    let letter = table.values.iter().find(|(own, _)| own == which)?.1;
                    (*entry <= u32::from(table.row.count)).then(|| (table.clone(), letter))
                };
                let found = tables.iter().find_map(has);
                let (table, letter) = found.ok_or_else(|| cannot(TablesLack::Value))?;
                let radius = matches!(which, ToolValue::Radius | ToolValue::RadiusWear);
                let mut value = value.clone();
                if radius && self.words.settings.get(RADIUS_DATA) == "diameter" {
                    value = twice(&value).ok_or_else(|| cannot(TablesLack::Diameter))?;
                }
                if radius {
                    self.words.rely(RADIUS_DATA, span, sink);
                }
                self.stored(&table, &entry.to_string(), *added, &[(letter, value)], span, sink)
            }
        }
    }

    /// What is computed for a table, as an assignment to the control's variable of that value; `None` where it has none,
    /// or rounds it otherwise.
    fn data_setting(&mut self, data: &Data, span: Span, sink: &mut Sink) -> Result<Option<String>, Fault> {
        let system = match data {
            Data::Offset { offset, mode: DataMode::Set, words, turn: None } => {
                let mut said = Axis::ALL.into_iter().filter(|axis| words[*axis as usize].is_some());
                let (Some(axis), None) = (said.next(), said.next()) else { return Ok(None) };
                System::WorkOffset { number: *offset, axis, unit: None }
            }
            Data::Tool { entry, which, added: false, .. } => {
                let Ok(entry) = u16::try_from(*entry) else { return Ok(None) };
                System::ToolTable { value: *which, entry }
            }
            Data::Offset { .. }
            | Data::Tool { .. }
            | Data::Measured { .. }
            | Data::Position(_)
            | Data::ToolInSpindle(_) => return Ok(None),
        };
        let Ok(name) = self.words.spelling(None)?.target(&Target::Var(Var::System(system.clone()))) else {
            return Ok(None);
        };
        self.data_setting_of(&name, &system, data, span, sink)
    }

    /// The same for the variable of that name, which is this value of the control's or another one of its kind.
    pub(super) fn data_setting_of(
        &mut self,
        name: &str,
        system: &System,
        data: &Data,
        span: Span,
        sink: &mut Sink,
    ) -> Result<Option<String>, Fault> {
        let value = match data {
            Data::Offset { words, .. } => words.iter().flatten().next(),
            Data::Tool { value, .. } => Some(value),
            Data::Measured { .. } | Data::Position(_) | Data::ToolInSpindle(_) => None,
        };
        let Some(value) = value else { return Ok(None) };
        let rounds = self.words.codes.axes[Axis::X as usize].and_then(|letter| letter.format.rounds);
        let (said, value) = rounding(value);
        let mut value = value.clone();
        match (said, rounds, &mut value) {
            (None, _, Expr::Num(num)) if num.unit != Unit::Entry => {
                self.words.check_unit(Num::int(1, num.unit), span)?;
                num.unit = Unit::One;
            }
            // What counts in the active unit does so in the control's variable as well.
            (None, Some([mm, inch]), Expr::Num(num)) if num.trimmed().scale <= mm.min(inch) => {
                num.unit = Unit::One;
            }
            (Some(said), Some([mm, inch]), _) if mm == inch && said == mm => {}
            (Some(said), Some([mm, inch]), _) if said == mm || said == inch => {
                let unit = if said == mm { Unit::Mm } else { Unit::Inch };
                self.words.check_unit(Num::int(1, unit), span)?;
            }
            _ => return Ok(None),
        }
        let own = Expr::Node(Box::new(Node::Var(Var::System(system.clone()))));
        self.words.rely_on(&own, span, sink);
        let value = self.words.expression(&value, span, sink)?;
        Ok(Some(self.sets(name, &value)))
    }

    /// A length that is no entry of the table, in a block of its own.
    pub(crate) fn stated_length(
        &mut self,
        length: &ToolLength,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let [stated, added] = self.words.codes.stated_length;
        let z = self.words.codes.axes[Axis::Z as usize];
        let (code, letter, value) = match length {
            ToolLength::Value(value) => (stated, z, value),
            ToolLength::Added(value) => (added, z, value),
            ToolLength::AddedEntry(entry) => (added, self.words.codes.entry, entry),
            ToolLength::Offsets { added: adds, words } => {
                let code = if *adds { added } else { stated };
                let code = code.ok_or_else(|| cannot(LengthsLack::OffsetsByValue))?;
                let own = self.words.along(&words[..])?;
                let mut said = Vec::with_capacity(own.len());
                for (letter, value) in &own {
                    said.push((letter.letter, self.words.value(letter, value, span, sink)?));
                }
                return self.alone(code, said, sink);
            }
        };
        let (code, letter) = code.zip(letter).ok_or_else(|| cannot(LengthsLack::ByValue))?;
        let value = self.words.value(&letter, value, span, sink)?;
        self.alone(code, vec![(letter.letter, value)], sink)
    }

    /// A code in a block of its own, with its words.
    fn alone(&mut self, code: Code, words: Vec<(u8, WordValue)>, sink: &mut Sink) -> Result<(), Fault> {
        if !self.words.block.is_empty() {
            self.words.flush(false, sink);
            self.words.split = true;
        }
        let need = Need::new(Rank::Alone).code(Some(code));
        self.words.admit(&words.iter().fold(need, |need, (letter, _)| need.letter(*letter)), sink)?;
        self.words.block.code(Part::Mode, &code);
        for (letter, value) in words {
            self.words.block.word(Part::Mode, letter, value);
        }
        Ok(())
    }

    pub(super) fn stored(
        &mut self,
        table: &DataCode,
        entry: &str,
        added: bool,
        own: &[(Letter, Expr)],
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let mut inserted = Inserted::default();
        if table.row.adds {
            // Whether values are added, the text says where it is read.
            if std::mem::take(&mut self.words.facts.unsaid) {
                self.words.active.distance = None;
            }
            let distance = if added { Distance::Incremental } else { Distance::Absolute };
            let counted =
                |(_, value): &(Letter, Expr)| Coord { value: value.clone(), distance: Fact::Known(distance) };
            let coords: Vec<Coord> = own.iter().map(counted).collect();
            self.words.need_distance(coords.iter(), &mut inserted)?;
        } else if added {
            return Err(cannot(TablesLack::AddedValue));
        }
        if !self.words.block.is_empty() {
            self.words.flush(false, sink);
            self.words.split = true;
        }
        let mut need =
            Need::new(Rank::Alone).code(Some(table.code)).letter(table.select.0).letter(table.entry);
        let mut shaped = Vec::new();
        for (letter, value) in own {
            need = need.letter(letter.letter);
            shaped.push((letter.letter, self.words.value(letter, value, span, sink)?));
        }
        self.words.admit_with(need, inserted, sink)?;
        self.words.block.code(Part::Mode, &table.code);
        self.words.block.digits(Part::Mode, table.select.0, &table.select.1.to_string());
        self.words.block.digits(Part::Mode, table.entry, entry);
        for (letter, value) in shaped {
            self.words.block.word(Part::Axes, letter, value);
        }
        Ok(())
    }
}

/// Twice a literal.
fn twice(value: &Expr) -> Option<Expr> {
    let num = value.literal()?;
    Some(Expr::Num(Num { mantissa: num.mantissa.checked_mul(2)?, ..num }))
}
