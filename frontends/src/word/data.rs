//! Lowering of work offsets that a word of the block names, and of values put into the control's tables.
//!
//! Refused: tables that the dictionary does not have, entries outside their numbers, and values
//! put in while a cycle is active or where it is not known whether they are added.

use ncc_dialects::{AT_ZERO, DataKind, DataRow, Meaning, Quantity, RADIUS_DATA, STORED_POSITION};
use ncc_ir::canon::{AXES, Axis, Distance, Fact};
use ncc_ir::computed::computed_code::of_number;
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Num;
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Expr, Node, Var};
use ncc_ir::program::{Data, DataMode, Op, ToolLength, ToolValue};
use ncc_ir::unsupported::TableUnsupported;

use super::block_words::{Code, Words};
use super::lower::Lower;
use super::word_state::CycleState;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::words::{Value, Word};

impl Lower {
    /// A work offset of several that share a code.
    pub(super) fn counted_offset(
        &mut self,
        code: &Code,
        first: u16,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        self.check_shut(code, out);
        let letter = code.row.words.bytes().next().unwrap_or(b'P');
        let Some(word) = words.take(letter) else {
            let word = char::from(letter).to_string().into();
            let code_text = code.row.code.as_str().into();
            return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
        };
        let Some(which) = self.read_whole(&word, src, out) else { return };
        let count = u32::from(code.row.count.unwrap_or(0));
        let Some(offset) = (1..=count).contains(&which).then(|| first + (which - 1) as u16) else {
            return self.fault(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
        };
        self.state.modes.work_offset = Know::Said(offset);
        self.push(code.span.to(word.span), Op::SetOriginOffsets(offset), out);
    }

    /// Values put into a table.
    pub(super) fn data(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) {
        let code_text: Box<str> = code.row.code.as_str().into();
        let dialect = self.settings.dialect;
        let rows = || dialect.tables_of(&code.row.code).filter_map(|row| Some((row, row.selected()?)));
        let Some(letter) = rows().next().map(|(_, (_, letter, _))| letter) else { return };
        let Some(word) = words.take(letter) else {
            let word = char::from(letter).to_string().into();
            return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
        };
        let Some(number) = self.read_whole(&word, src, out) else { return };
        let Some((row, _)) = rows().find(|(_, (.., own))| *own == number) else {
            // What the other words are for is another table's matter.
            words.left = 0;
            let text = format!("{code_text} {}{number}", char::from(letter)).into();
            let what = TableUnsupported::Kind.into();
            return self.fault(Fault::NotSupported { code: text, what }, code.span.to(word.span), out);
        };
        self.table(code, row, words, src, out);
    }

    fn table(&mut self, code: &Code, row: &'static DataRow, words: &mut Words, src: Source, out: &mut Batch) {
        let row_name = || Box::<str>::from(row.name.as_str());
        // Execution looks at what is not known here: where a caller, or a block that may be skipped, has an active cycle.
        let active = matches!(self.state.cycle, CycleState::Active(_));
        if active {
            let what = TableUnsupported::InCycle.into();
            self.fault(Fault::NotSupported { code: row_name(), what }, code.span, out);
        }
        let Some(entry) = words.take(row.entry as u8) else {
            let word = row.entry.to_string().into();
            return self.fault(Fault::WordMissing { code: row_name(), word }, code.span, out);
        };
        // Of which work offset, may be computed when the program runs.
        let computed = match entry.value {
            Value::Computed(place) if row.kind == DataKind::Offset => {
                Some(self.entry_number(words.exprs[usize::from(place)].clone(), &entry, out))
            }
            _ => None,
        };
        let found = match entry.value {
            _ if computed.is_some() => Some(1),
            Value::Computed(place) => {
                let number = self.entry_number(words.exprs[usize::from(place)].clone(), &entry, out);
                let Some(known) = self.known_number(&number) else {
                    let code = format!("{} {}", row.name, src.text(entry.span)).into();
                    let what = self.unknown_entry(&number).into();
                    return self.fault(Fault::NotSupported { code, what }, entry.span, out);
                };
                Some(known)
            }
            _ => self.read_whole(&entry, src, out),
        };
        let Some(number) = found.and_then(|number| self.existing(number, code, row, &entry, src, out)) else {
            return;
        };
        let added = match row.adds {
            false => false,
            true => match self.distance(code.span, out) {
                Fact::Known(distance) => distance == Distance::Incremental,
                Fact::Entry => {
                    let what = TableUnsupported::UnknownMode.into();
                    return self.fault(Fault::NotSupported { code: row_name(), what }, code.span, out);
                }
            },
        };
        if row.kind == DataKind::Tool {
            return self.tool_data(code, row, number, added, words, src, out);
        }
        if row.kind == DataKind::ToolHere {
            return self.measured(code, row, number, words, src, out);
        }
        self.check_shut(code, out);
        // A zero that is stated is what it is, whatever length counts; one from where the tool is is not.
        if row.kind == DataKind::OffsetHere && words.get(b'Z').is_some() && self.level_open() {
            words.left = 0;
            return self.refuse_level(code.span, out);
        }
        let mut by = [const { None }; AXES];
        for axis in Axis::ALL {
            let Some(axis_row) = self.axis_row(axis) else { continue };
            if let Some(word) = words.take(axis.letter()) {
                by[axis as usize] = self.amount(&word, axis_row.quantity, words, src, out);
            }
        }
        let turn = row.turns.and_then(|letter| words.take(letter as u8));
        if let Some(word) = turn.filter(|_| row.kind == DataKind::OffsetHere) {
            let code = format!("{} {}", row.name, src.text(word.span)).into();
            let what = TableUnsupported::TurnFromPosition.into();
            return self.fault(Fault::NotSupported { code, what }, word.span, out);
        }
        let turn = turn.and_then(|word| self.number(&word, Quantity::Angle, src, out)).map(Expr::Num);
        if by.iter().all(Option::is_none) && turn.is_none() && !self.now.failed {
            return self.fault(Fault::WordMissing { code: row_name(), word: "X".into() }, code.span, out);
        }
        let mode = match (row.kind, added) {
            (DataKind::OffsetHere, _) => {
                self.rely_on_frames(by[Axis::Z as usize].is_some(), code.span, out);
                DataMode::Here
            }
            (_, true) => DataMode::Add,
            (_, false) => DataMode::Set,
        };
        let input = |number: u32| {
            let offset = row.first + (number - 1) as u16;
            let data = Data::Offset { offset, mode, words: Box::new(by.clone()), turn: turn.clone() };
            Op::SetData(Box::new(data))
        };
        let Some(computed) = computed else { return self.push(code.span, input(number), out) };
        out.whole = true;
        let cases = (1..=u32::from(row.count)).map(|number| (i64::from(number), input(number)));
        self.computes.saved.entry(code.span, &row.name);
        self.push(code.span, of_number(&computed, cases.collect(), code.span), out);
        self.end_block_here();
    }

    /// The number of an entry that the table has; 0 may be the active one.
    fn existing(
        &mut self,
        mut number: u32,
        code: &Code,
        row: &'static DataRow,
        entry: &Word,
        src: Source,
        out: &mut Batch,
    ) -> Option<u32> {
        if number == 0 && row.zero_current {
            self.rely_on_frames(false, code.span, out);
            let own = self.state.modes.work_offset.value().and_then(|own| (own + 1).checked_sub(row.first));
            let Some(own) = own.filter(|own| (1..=row.count).contains(own)) else {
                let code = format!("{} {}", row.name, src.text(entry.span)).into();
                let what = TableUnsupported::UnknownOffset.into();
                return self.refuse(Fault::NotSupported { code, what }, entry.span, out);
            };
            number = u32::from(own);
        }
        if !(1..=u32::from(row.count)).contains(&number) {
            let what = match number {
                0 => TableUnsupported::NoEntryZero,
                _ => TableUnsupported::NoEntry,
            };
            let code = format!("{} {}", row.name, src.text(entry.span)).into();
            return self.refuse(Fault::NotSupported { code, what: what.into() }, entry.span, out);
        }
        Some(number)
    }

    /// A whole number that the text settles: a literal, or the tool that it has selected last by one.
    fn known_number(&self, number: &Expr) -> Option<u32> {
        match number {
            Expr::Num(n) => n.whole_number().and_then(|n| u32::try_from(n).ok()),
            Expr::Node(node) => match (&**node, self.state.modes.tool) {
                (Node::Var(Var::System(System::SelectedTool)), Know::Said(tool)) => tool,
                _ => None,
            },
        }
    }

    /// Why the number of an entry is refused: it is the T or H code active before the program has said one, or only
    /// known when it runs.
    fn unknown_entry(&self, number: &Expr) -> TableUnsupported {
        let asked = |node: &Node| match node {
            Node::Var(Var::System(System::SelectedTool)) => self.state.modes.tool == Know::Unsaid,
            Node::Var(Var::System(System::LengthEntry)) => self.state.length_entry == Know::Unsaid,
            _ => false,
        };
        match number {
            Expr::Node(node) if asked(node) => TableUnsupported::EntryAtStart,
            _ => TableUnsupported::EntryComputed,
        }
    }

    /// The number of a table's entry, where it is computed.
    fn entry_number(&mut self, mut number: Expr, word: &Word, out: &mut Batch) -> Expr {
        if !self.settings.dialect.program.o_words {
            return self.value(&number, word.span, out);
        }
        self.parameters(&mut number, word.span, out);
        number
    }

    /// Where the axes stand becomes a stored position; or the number of the tool in the spindle is stated.
    pub(super) fn stored(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) {
        let code_text: Box<str> = code.row.code.as_str().into();
        let data = match code.meaning {
            Meaning::StorePosition(_) if self.has_axis_word(words) => {
                let what = TableUnsupported::StoredWithAxes.into();
                return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
            }
            // What is stated of it holds for the whole program.
            Meaning::StorePosition(_) if self.settings.get(STORED_POSITION) == AT_ZERO => {
                let what = TableUnsupported::StoredZero.into();
                return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
            }
            Meaning::StorePosition(place) => Data::Position(place),
            _ => {
                let letter = code.row.words.bytes().next().unwrap_or(b'Q');
                let Some(word) = words.take(letter) else {
                    let word = char::from(letter).to_string().into();
                    return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
                };
                let Some(tool) = self.read_whole(&word, src, out) else { return };
                Data::ToolInSpindle(Expr::int(i64::from(tool)))
            }
        };
        self.push(code.span, Op::SetData(Box::new(data)), out);
    }

    /// A length of the tool by its value, or one that is added to the active one.
    pub(super) fn stated_length(
        &mut self,
        code: &Code,
        added: bool,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let code_text: Box<str> = code.row.code.as_str().into();
        let entry = words.take(if added { self.roles.length_entry } else { 0 });
        let by = self.offset_words(words, src, out);
        let along: Vec<usize> = (0..AXES).filter(|axis| by[*axis].is_some()).collect();
        if self.has_axis_word(words) || entry.is_some() && !along.is_empty() {
            let what = match entry {
                Some(_) => TableUnsupported::LengthWithAxes,
                None => TableUnsupported::OffsetAxis,
            };
            words.left = 0;
            return self.fault(Fault::NotSupported { code: code_text, what: what.into() }, code.span, out);
        }
        let [x, y, z, ..] = by;
        let length = match (entry, &along[..], z) {
            (Some(word), ..) => self
                .read_whole(&word, src, out)
                .map(|entry| ToolLength::AddedEntry(Expr::int(i64::from(entry)))),
            (None, [], _) if self.now.failed => None,
            (None, [], _) => {
                return self.fault(Fault::WordMissing { code: code_text, word: "Z".into() }, code.span, out);
            }
            (None, [2], Some(value)) if added => Some(ToolLength::Added(value)),
            (None, [2], Some(value)) => Some(ToolLength::Value(value)),
            (None, _, z) => {
                let words = Box::new([x, y, z, None, None, None]);
                Some(ToolLength::Offsets { added, words })
            }
        };
        let Some(length) = length else { return };
        if added {
            // What it is added to counts.
            self.rely_on_frames(true, code.span, out);
        }
        self.end_tip(code.span, out);
        self.state.length_open(true);
        self.push(code.span, Op::UseToolLength(Box::new(length)), out);
    }

    /// Words for X, Y and Z that are offsets of a tool.
    fn offset_words(&mut self, words: &mut Words, src: Source, out: &mut Batch) -> [Option<Expr>; AXES] {
        let mut by = [const { None }; AXES];
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            if let Some(word) = words.take(axis.letter()) {
                by[axis as usize] = self.amount(&word, Quantity::Length, words, src, out);
            }
        }
        by
    }

    /// Offsets of a tool by where the axes stand.
    fn measured(
        &mut self,
        code: &Code,
        row: &'static DataRow,
        entry: u32,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let row_name = || Box::<str>::from(row.name.as_str());
        let by = self.offset_words(words, src, out);
        if self.has_axis_word(words) || words.get(b'R').is_some() {
            words.left = 0;
            let what = TableUnsupported::OtherValue.into();
            return self.fault(Fault::NotSupported { code: row_name(), what }, code.span, out);
        }
        if by.iter().all(Option::is_none) && !self.now.failed {
            return self.fault(Fault::WordMissing { code: row_name(), word: "Z".into() }, code.span, out);
        }
        self.rely_on_frames(by[Axis::Z as usize].is_some(), code.span, out);
        let offset = (row.in_offset != 0).then_some(row.in_offset);
        let data = Data::Measured { entry, offset, words: Box::new(by) };
        self.push(code.span, Op::SetData(Box::new(data)), out);
    }

    #[allow(clippy::too_many_arguments)] // All that the block says.
    fn tool_data(
        &mut self,
        code: &Code,
        row: &'static DataRow,
        entry: u32,
        added: bool,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let mut any = false;
        for value in &row.values {
            let Some(word) = words.take(value.letter as u8) else { continue };
            any = true;
            let which = ToolValue::from(value.of);
            let Some(value) = self.amount(&word, Quantity::Length, words, src, out) else { continue };
            let radius = matches!(which, ToolValue::Radius | ToolValue::RadiusWear);
            let value = if radius && self.option(RADIUS_DATA, word.span, out) == "diameter" {
                let Some(half) = value.literal().and_then(half) else {
                    self.fault(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
                    continue;
                };
                Expr::Num(half)
            } else {
                value
            };
            let data = Data::Tool { entry, which, added, kept: row.kept && which.is_offset(), value };
            self.push(code.span, Op::SetData(Box::new(data)), out);
        }
        if !any {
            let word = row.values.first().map_or(' ', |value| value.letter).to_string().into();
            self.fault(Fault::WordMissing { code: row.name.as_str().into(), word }, code.span, out);
        }
    }
}

/// Half of a number, exactly.
fn half(num: Num) -> Option<Num> {
    if num.mantissa % 2 == 0 {
        return Some(Num { mantissa: num.mantissa / 2, ..num });
    }
    Some(Num { mantissa: num.mantissa.checked_mul(5)?, scale: num.scale + 1, point: true, ..num })
}
