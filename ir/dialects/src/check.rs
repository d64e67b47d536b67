//! Rows of a dictionary that stand for several, and whether rows fit together.
//!
//! What a row means is not judged here: `ncc dialects test` shows whether it reads back.

mod functions;
mod readable;
pub(crate) mod unknown;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use ncc_ir::reason::{Reason, Values};

use crate::codes::{CodeIndex, CodeRow};
use crate::fault::{DialectFault, RowFault, Unreadable};
use crate::meaning::Meaning;
use crate::names::{NameMeaning, NameRow, ParameterRole};
use crate::schema::{Dialect, OptionRow, UNKNOWN};
use crate::stored::DataKind;

/// A fault, and the place of its row in the texts laid end to end.
pub(crate) type Fault = (DialectFault, Option<Range<usize>>);

/// Places of the rows, table by table; empty for a dictionary that was not read from a text.
#[derive(Debug, Default)]
pub(crate) struct Places {
    pub(crate) address: Vec<Range<usize>>,
    pub(crate) cycle: Vec<Range<usize>>,
    pub(crate) pattern: Vec<Range<usize>>,
    pub(crate) code: Vec<Range<usize>>,
    pub(crate) name: Vec<Range<usize>>,
    pub(crate) call: Vec<Range<usize>>,
    pub(crate) option: Vec<Range<usize>>,
    pub(crate) behaviour: Vec<Range<usize>>,
    pub(crate) data: Vec<Range<usize>>,
    pub(crate) variant: Vec<Range<usize>>,
    pub(crate) functions: BTreeMap<String, Range<usize>>,
}

/// Kinds of cycles, as `ncc_ir::program::cycle::CycleKind::name` has them.
pub(crate) const CYCLE_KINDS: &[&str] = &[
    "drill",
    "drill-dwell",
    "drill-peck",
    "drill-break",
    "bore",
    "tap",
    "tap-rigid",
    "bore-fine",
    "bore-stop",
];

/// Makes a row of each code and word that a row stands for.
pub(crate) fn spread(dialect: &mut Dialect, places: &mut Places) -> Result<(), Fault> {
    let mut codes = Vec::with_capacity(dialect.code.len());
    let mut at = Vec::with_capacity(dialect.code.len());
    for (i, row) in std::mem::take(&mut dialect.code).into_iter().enumerate() {
        let place = places.code.get(i).cloned();
        let before = codes.len();
        each_code(row, &mut codes).map_err(|fault| (fault, place.clone()))?;
        at.extend(place.into_iter().cycle().take(codes.len() - before));
    }
    (dialect.code, places.code) = (codes, at);
    let mut names = Vec::with_capacity(dialect.name.len());
    let mut at = Vec::with_capacity(dialect.name.len());
    for (i, row) in std::mem::take(&mut dialect.name).into_iter().enumerate() {
        let before = names.len();
        if row.name.contains(' ') {
            names.extend(row.name.split(' ').map(|name| NameRow { name: name.to_owned(), ..row.clone() }));
        } else {
            names.push(row);
        }
        at.extend(places.name.get(i).into_iter().cycle().take(names.len() - before).cloned());
    }
    (dialect.name, places.name) = (names, at);
    open_behaviours(dialect, places)
}

/// Checks the rows of behaviours, and makes an option of each open one; of those of variants too, so that an option can be
/// chosen whatever the order.
fn open_behaviours(dialect: &mut Dialect, places: &mut Places) -> Result<(), Fault> {
    let of_variants = dialect
        .variant
        .iter()
        .enumerate()
        .flat_map(|(at, variant)| variant.behaviour.iter().map(move |row| (row, at, true)));
    let own = dialect.behaviour.iter().enumerate().map(|(at, row)| (row, at, false));
    let mut options: Vec<(OptionRow, Range<usize>)> = Vec::new();
    for (row, at, of_variant) in own.chain(of_variants) {
        let rows = if of_variant { &places.variant } else { &places.behaviour };
        let Some((behaviour, _)) = row.meaning() else {
            return Err(fault(&row.name, RowFault::NoBehaviour, rows, at));
        };
        if !row.others.iter().all(|name| behaviour.value(name).is_some()) {
            return Err(fault(&row.name, RowFault::OtherValues, rows, at));
        }
        let name = behaviour.option();
        let mut known = dialect.option.iter().chain(options.iter().map(|(option, _)| option));
        if !row.open || known.any(|option| option.name == name) {
            continue;
        }
        let values = behaviour.values().iter().chain([&UNKNOWN]);
        let option = OptionRow {
            name,
            values: values.map(|value| (*value).to_owned()).collect(),
            default: UNKNOWN.to_owned(),
            // Its words follow from the behaviour.
            doc: String::new(),
            source: row.source.clone(),
        };
        options.push((option, rows.get(at).cloned().unwrap_or_default()));
    }
    for (option, place) in options {
        dialect.option.push(option);
        places.option.push(place);
    }
    Ok(())
}

/// Checks that the options of variants are there, and that their rows fit into the dictionary: those of each alone, and
/// those of each two that can hold together. (A fault is one of a row, or of two that exclude each other.)
pub(crate) fn variants(dialect: &Dialect, places: &Places) -> Result<(), Fault> {
    for (at, variant) in dialect.variant.iter().enumerate() {
        let wrong = |row: &str, wrong| fault(row, wrong, &places.variant, at);
        for (option, value) in &variant.when {
            let row = dialect.option.iter().find(|row| row.name == *option);
            let row = row.ok_or_else(|| wrong(option, RowFault::NoOption))?;
            if !row.values.contains(value) {
                return Err(wrong(value, RowFault::NoOptionValue));
            }
            if variant.when.len() == 1 && row.default == *value {
                return Err(wrong(value, RowFault::DefaultValue));
            }
        }
        let others = dialect.variant[..at].iter().filter(|other| variant.goes_with(other)).map(Some);
        for other in std::iter::once(None).chain(others) {
            let mut with = dialect.clone();
            other.into_iter().chain([variant]).for_each(|row| row.put_into(&mut with));
            let own = |(wrong, _): Fault| (wrong, places.variant.get(at).cloned());
            spread(&mut with, &mut Places::default()).map_err(own)?;
            index(&with, &Places::default()).map_err(own)?;
        }
    }
    Ok(())
}

/// The rows that a row of a code stands for.
fn each_code(row: CodeRow, all: &mut Vec<CodeRow>) -> Result<(), DialectFault> {
    let Some(upto) = row.upto else {
        all.push(row);
        return Ok(());
    };
    let wrong = |wrong| DialectFault::Row { row: row.code.clone(), wrong };
    let first = row
        .code
        .get(1..)
        .and_then(|n| n.parse::<u16>().ok())
        .ok_or_else(|| DialectFault::Unreadable { row: row.code.clone(), why: Unreadable::Number })?;
    let Some(Meaning::SetOriginOffsets(number)) = row.means else {
        return Err(wrong(RowFault::SeveralCodes));
    };
    for code in first..=upto.min(first.saturating_add(999)) {
        let means = Some(Meaning::SetOriginOffsets(number.saturating_add(code - first)));
        all.push(CodeRow { code: format!("{}{code}", &row.code[..1]), upto: None, means, ..row.clone() });
    }
    Ok(())
}

/// Checks all rows, and finds them by their numbers and letters.
pub(crate) fn index(dialect: &Dialect, places: &Places) -> Result<CodeIndex, Fault> {
    let mut index = CodeIndex::default();
    for (at, row) in dialect.code.iter().enumerate() {
        let wrong = |wrong| fault(&row.code, wrong, &places.code, at);
        readable::code(dialect, row).map_err(|why| unreadable(&row.code, why, &places.code, at))?;
        index.put_code(at, row).map_err(wrong)?;
        if row.means.is_some() == row.refuse.is_some() {
            return Err(wrong(RowFault::MeansOrRefuse));
        }
        let offsets = matches!(row.means, Some(Meaning::SetOriginOffsets(1..)));
        if row.feed_mode.is_some() && !matches!(row.means, Some(Meaning::SetSpindleMode(_))) {
            return Err(wrong(RowFault::FeedModeAlone));
        }
        if (row.means == Some(Meaning::SetTilt)) != row.turns_about().is_some() {
            return Err(wrong(RowFault::TurnsAxis));
        }
        if row.count.is_some() && (row.words.is_empty() || !offsets) {
            return Err(wrong(RowFault::CountAlone));
        }
        if row.means == Some(Meaning::StartCycle) && dialect.cycle_row(&row.code).is_none() {
            return Err(wrong(RowFault::NoCycleRow));
        }
        if row.means == Some(Meaning::Pattern) && dialect.pattern_row(&row.code).is_none() {
            return Err(wrong(RowFault::NoPatternRow));
        }
        if !row.blocks.bytes().all(|letter| letter.is_ascii_uppercase()) {
            return Err(wrong(RowFault::BlockLetters));
        }
        if row.source.is_empty() {
            return Err(wrong(RowFault::NoSource));
        }
    }
    cycles(dialect, places)?;
    names(dialect, places)?;
    tables(dialect, places)?;
    for (at, row) in dialect.address.iter().enumerate() {
        let wrong = |wrong| fault(&row.letter.to_string(), wrong, &places.address, at);
        let letter = row.letter.to_string();
        readable::address(dialect, row).map_err(|why| unreadable(&letter, why, &places.address, at))?;
        index.put_letter(at, row).map_err(wrong)?;
        if row.source.is_empty() {
            return Err(wrong(RowFault::NoSource));
        }
    }
    for (at, row) in dialect.option.iter().enumerate() {
        let wrong = |wrong| fault(&row.name, wrong, &places.option, at);
        let fits = match row.values.is_empty() {
            true => row.default.parse::<f64>().is_ok_and(f64::is_finite),
            false => row.values.contains(&row.default),
        };
        if !fits && row.values.is_empty() {
            return Err(wrong(RowFault::NoNumberDefault));
        }
        if !fits {
            let (name, among) = (row.default.as_str().into(), row.values.as_slice().into());
            return Err((DialectFault::NoDefaultValue { name, among }, places.option.get(at).cloned()));
        }
    }
    functions::check(dialect, &index)
        .map_err(|(name, fault)| (fault, places.functions.get(name).cloned()))?;
    index.find_meanings(&dialect.code, &dialect.name);
    index.find_behaviours(&dialect.option);
    Ok(index)
}

/// Checks cycles and patterns of holes.
fn cycles(dialect: &Dialect, places: &Places) -> Result<(), Fault> {
    let means = |code: &str, meaning| dialect.code.iter().any(|c| c.code == code && c.means == Some(meaning));
    for (at, row) in dialect.cycle.iter().enumerate() {
        let wrong = |wrong| fault(&row.code, wrong, &places.cycle, at);
        if !CYCLE_KINDS.contains(&row.kind.as_str()) {
            let (row, kind) = (row.code.as_str().into(), row.kind.as_str().into());
            return Err((DialectFault::NoCycleKind { row, kind }, places.cycle.get(at).cloned()));
        }
        if row.kind.starts_with("tap") != row.hand.is_some() {
            return Err(wrong(RowFault::HandOfTap));
        }
        if (row.kind == "bore-fine") != row.shift.is_some() {
            return Err(wrong(RowFault::ShiftOfBore));
        }
        if row.shrinking.is_some() && row.peck.is_none() {
            return Err(wrong(RowFault::ShrinkingAlone));
        }
        let asked = |asked: &crate::cycles::AskedDwell| dialect.option.iter().any(|o| o.name == asked.option);
        if row.dwell_by.as_ref().is_some_and(|by| row.dwell.is_some() || !asked(by)) {
            return Err(wrong(RowFault::DwellBy));
        }
        if dialect.cycle.iter().take(at).any(|other| other.code == row.code) {
            return Err(wrong(RowFault::Twice));
        }
        if !means(&row.code, Meaning::StartCycle) {
            return Err(wrong(RowFault::CycleNotStarted));
        }
        readable::cycle(dialect, row).map_err(|why| unreadable(&row.code, why, &places.cycle, at))?;
    }
    for (at, row) in dialect.pattern.iter().enumerate() {
        if !means(row.code(), Meaning::Pattern) {
            return Err(fault(row.code(), RowFault::PatternNotStarted, &places.pattern, at));
        }
        readable::pattern(dialect, row).map_err(|why| unreadable(row.code(), why, &places.pattern, at))?;
    }
    Ok(())
}

fn unreadable(row: &str, why: Unreadable, places: &[Range<usize>], at: usize) -> Fault {
    (DialectFault::Unreadable { row: row.to_owned(), why }, places.get(at).cloned())
}

fn fault(row: &str, wrong: RowFault, places: &[Range<usize>], at: usize) -> Fault {
    (DialectFault::Row { row: row.to_owned(), wrong }, places.get(at).cloned())
}

/// Checks the tables that a program puts values into.
fn tables(dialect: &Dialect, places: &Places) -> Result<(), Fault> {
    for (at, row) in dialect.data.iter().enumerate() {
        let wrong = |wrong| fault(&row.name, wrong, &places.data, at);
        if !row.is_variable() {
            let (code, ..) = row.selected().ok_or_else(|| wrong(RowFault::NoCodeWithWord))?;
            let sets = |c: &CodeRow| c.code == code && c.means == Some(Meaning::SetData);
            if !dialect.code.iter().any(sets) {
                return Err(wrong(RowFault::TableNotSet));
            }
        }
        if (row.kind == DataKind::Tool) == row.values.is_empty() {
            return Err(wrong(RowFault::ValuesOfTools));
        }
        if row.first == 0 || row.count == 0 {
            return Err(wrong(RowFault::NoEntries));
        }
        if row.source.is_empty() {
            return Err(wrong(RowFault::NoSource));
        }
        if dialect.data.iter().take(at).any(|other| other.name == row.name) {
            return Err(wrong(RowFault::Twice));
        }
    }
    let sets = |row: &CodeRow| row.means == Some(Meaning::SetData);
    for (at, row) in dialect.code.iter().enumerate().filter(|(_, row)| sets(row)) {
        if dialect.tables_of(&row.code).next().is_none() {
            return Err(fault(&row.code, RowFault::NoDataRow, &places.code, at));
        }
    }
    Ok(())
}

/// Checks the words of several letters and the calls.
fn names(dialect: &Dialect, places: &Places) -> Result<(), Fault> {
    let mut seen = BTreeSet::new();
    let names = dialect.name.iter().enumerate().map(|(i, row)| (&row.name, &row.source, &places.name, i));
    let calls = dialect.call.iter().enumerate().map(|(i, row)| (&row.name, &row.source, &places.call, i));
    for (name, source, places, at) in names.chain(calls) {
        let wrong = |wrong| fault(name, wrong, places, at);
        readable::name(dialect).map_err(|why| unreadable(name, why, places, at))?;
        if !seen.insert(name) {
            return Err(wrong(RowFault::Twice));
        }
        if name.is_empty() || !name.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit() || b == b'_')
        {
            return Err(wrong(RowFault::NoCapitals));
        }
        if source.is_empty() {
            return Err(wrong(RowFault::NoSource));
        }
    }
    for (at, row) in dialect.name.iter().enumerate() {
        let wrong = |wrong| fault(&row.name, wrong, &places.name, at);
        let uses = [row.means.is_some(), row.role.is_some(), row.refuse.is_some()];
        if uses.into_iter().filter(|u| *u).count() != 1 {
            return Err(wrong(RowFault::OneUse));
        }
        if row.role.is_some() != row.quantity.is_some() {
            return Err(wrong(RowFault::RoleQuantity));
        }
        if row.arguments && row.means != Some(NameMeaning::Code(Meaning::NoEffect)) {
            return Err(wrong(RowFault::ArgumentsEffect));
        }
    }
    for (at, row) in dialect.call.iter().enumerate() {
        let wrong = |wrong| fault(&row.name, wrong, &places.call, at);
        for p in &row.parameters {
            if p.role.is_some() == p.refuse.is_some() || p.role.is_some() != p.quantity.is_some() {
                return Err(wrong(RowFault::ParameterUse));
            }
            use ParameterRole as Role;
            let several = matches!(p.role, Some(Role::PointFirst | Role::PointSecond | Role::FormText));
            let same = row.parameters.iter().filter(|q| q.role == p.role).count();
            if p.role.is_some() && !several && same > 1 {
                return Err(wrong(RowFault::RoleTwice));
            }
        }
    }
    Ok(())
}

impl Reason for RowFault {
    fn name(&self) -> String {
        format!("{self:?}")
    }

    fn values(&self, _: &mut Values) {}
}
