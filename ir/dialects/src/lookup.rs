//! Rows of a dictionary, found by what is asked for; and the row of an M code that a machine adds.
//!
//! ```text
//! call_for(CallKind::…)    the row of the call that is written for that cycle
//! ```
//!
//! Not here: what a row holds (`codes`, `names`, `stored`).

use crate::fault::RowFault;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::expr::Expr;
use ncc_ir::program::ToolValue;

use crate::codes::{CodeIndex, CodeRow};
use crate::meaning::Meaning;
use crate::names::{CallKind, CallRow, NameMeaning, NameRole, NameRow};
use crate::schema::{Dialect, OptionRow};
use crate::stored::{DataKind, DataRow, SystemRow};
use crate::words::RefusalHelp;

impl Dialect {
    /// Puts what an M code means on one machine in; where a row has its number, in the place of that one.
    pub fn put_m_code(&mut self, number: u16, means: Meaning, source: &str) {
        let row = CodeRow {
            passed_over: false,
            read_as: None,
            alone_all_axes: false,
            after_move: false,
            code: format!("M{number:02}"),
            upto: None,
            count: None,
            means: Some(means),
            refuse: None,
            help: None,
            group: String::new(),
            words: String::new(),
            turns: String::new(),
            blocks: String::new(),
            no_entry_zero: false,
            own_feed: false,
            feed_stays: false,
            feed_mode: None,
            limits_speed: false,
            limit: None,
            orient: None,
            other_machine: false,
            own_tool: false,
            dwell: Vec::new(),
            on: None,
            refused_under_compensation: None,
            write: true,
            sure: true,
            source: source.to_owned(),
        };
        let tenths = usize::from(number) * 10;
        if self.index.m.len() <= tenths {
            self.index.m.resize(tenths + 1, None);
        }
        match self.index.m[tenths] {
            Some(at) => self.code[usize::from(at)] = row,
            None => {
                let Ok(at) = u16::try_from(self.code.len()) else { return };
                self.index.m[tenths] = Some(at);
                self.code.push(row);
            }
        }
        self.index.find_meanings(&self.code, &self.name);
    }

    /// The word of several letters that is written for a meaning.
    pub fn name_for(&self, meaning: NameMeaning) -> Option<&NameRow> {
        self.index.name_meaning.get(&meaning).map(|at| &self.name[usize::from(*at)])
    }

    /// The address of several letters that has a role.
    pub fn name_with(&self, role: NameRole) -> Option<&NameRow> {
        self.name.iter().find(|row| row.write && row.role == Some(role))
    }

    /// The call that is written for a cycle or a pattern.
    pub fn call_for(&self, kind: CallKind) -> Option<&CallRow> {
        self.call.iter().find(|row| row.kind == kind)
    }

    /// The tables of a code.
    pub fn tables_of(&self, code: &str) -> impl Iterator<Item = &DataRow> {
        self.data.iter().filter(move |row| row.selected().is_some_and(|(own, ..)| own == code))
    }

    /// Whether zeros of work offsets can be set, added to, and set so that the present position reads the
    /// words.
    pub(crate) fn sets_offsets(&self) -> [bool; 3] {
        let any = |kind: DataKind, adds: bool| self.data.iter().any(|r| r.kind == kind && (r.adds || !adds));
        [any(DataKind::Offset, false), any(DataKind::Offset, true), any(DataKind::OffsetHere, false)]
    }

    /// What to do instead of what is refused by this name.
    pub fn refusal_help(&self, name: &str) -> Option<RefusalHelp> {
        let codes = self.code.iter().map(|row| (&row.refuse, row.help));
        let names = self.name.iter().map(|row| (&row.refuse, row.help));
        let system = self.system.iter().map(|row| (&row.refuse, row.help));
        let mut all = codes.chain(names).chain(system);
        all.find_map(|(refuse, help)| help.filter(|_| refuse.as_deref() == Some(name)))
    }

    /// Values of the control's own that have numbers, with these; in the active unit.
    pub fn named_values(&self) -> impl Iterator<Item = (&SystemRow, u32, Expr)> {
        let rows = self.system.iter().filter(|row| row.refuse.is_none() && !row.machine_units && !row.zero);
        // One of many entries is found by its meaning.
        let rows = rows.filter(|row| !row.entries);
        rows.flat_map(|row| {
            row.numbers().filter_map(move |number| Some((row, number, row.value(number - row.number, "")?)))
        })
    }

    /// Which values of tools can be set, in the order of [`ToolValue::ALL`].
    pub(crate) fn sets_tools(&self) -> [bool; 6] {
        let words = || self.data.iter().flat_map(|row| &row.values);
        ToolValue::ALL.map(|value| words().any(|word| ToolValue::from(word.of) == value))
    }

    /// Whether tools can be measured in the active coordinates, and in those of a work offset.
    pub(crate) fn measures_tools(&self) -> [bool; 2] {
        let rows = || self.data.iter().filter(|row| row.kind == DataKind::ToolHere);
        [rows().any(|row| row.in_offset == 0), rows().any(|row| row.in_offset != 0)]
    }
}

impl CodeIndex {
    /// Finds the rows of a dictionary that has been checked before (`check::index` finds and checks).
    pub(crate) fn of(dialect: &Dialect) -> Result<CodeIndex, RowFault> {
        let mut index = CodeIndex::default();
        dialect.code.iter().enumerate().try_for_each(|(at, row)| index.put_code(at, row))?;
        dialect.address.iter().enumerate().try_for_each(|(at, row)| index.put_letter(at, row))?;
        index.find_meanings(&dialect.code, &dialect.name);
        index.find_behaviours(&dialect.option);
        Ok(index)
    }

    /// Finds the options that state what codes do besides their names.
    pub(crate) fn find_behaviours(&mut self, options: &[OptionRow]) {
        let found = |(at, row): (usize, &OptionRow)| Some((at as u16, Behaviour::of_option(&row.name)?));
        self.behaviour = options.iter().enumerate().filter_map(found).collect();
    }
}
