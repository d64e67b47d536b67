//! Dictionaries as their variants make them: the rows of a variant laid over those of its dictionary.

use std::sync::{Mutex, PoisonError};

use crate::load::merge::same;
use crate::load::renew;
use crate::schema::Dialect;
use crate::variants::VariantRow;

impl VariantRow {
    /// The dictionary with this variant's rows in, and with its options at their values.
    pub(crate) fn put_into(&self, dialect: &mut Dialect) {
        let block = &mut dialect.block;
        block.skip_levels = self.block.skip_levels.unwrap_or(block.skip_levels);
        block.longest = self.block.longest.unwrap_or(block.longest);
        block.longest_bare = self.block.longest_bare.unwrap_or(block.longest_bare);
        let can = &mut dialect.can;
        can.change_by_hand = self.can.change_by_hand.unwrap_or(can.change_by_hand);
        can.length_at_once = self.can.length_at_once.unwrap_or(can.length_at_once);
        if let Some(cycles) = &self.cycles {
            dialect.cycles = cycles.clone();
        }
        lay(&mut dialect.address, &self.address, |row| row.letter.to_string());
        lay(&mut dialect.cycle, &self.cycle, |row| same(&row.code));
        lay(&mut dialect.code, &self.code, |row| same(&row.code));
        lay(&mut dialect.data, &self.data, |row| row.name.clone());
        lay(&mut dialect.name, &self.name, |row| row.name.clone());
        lay(&mut dialect.behaviour, &self.behaviour, |row| row.name.clone());
        for (option, value) in &self.when {
            dialect.option.iter_mut().filter(|row| row.name == *option).for_each(|row| {
                row.default.clone_from(value);
            });
        }
    }
}

/// Lays rows over others.
fn lay<T: Clone>(under: &mut Vec<T>, over: &[T], key: impl Fn(&T) -> String) {
    for row in over {
        match under.iter_mut().find(|own| key(own) == key(row)) {
            Some(own) => own.clone_from(row),
            None => under.push(row.clone()),
        }
    }
}

/// The dictionary as it is with these options. Each is made once and lives as long as the process.
pub(crate) fn chosen(dialect: &'static Dialect, value: impl Fn(&str) -> String) -> &'static Dialect {
    static MADE: Mutex<Vec<(&'static Dialect, Vec<usize>, &'static Dialect)>> = Mutex::new(Vec::new());
    let fits = |row: &VariantRow| row.when.iter().all(|(option, wanted)| value(option) == *wanted);
    let at: Vec<usize> =
        dialect.variant.iter().enumerate().filter(|(_, row)| fits(row)).map(|(at, _)| at).collect();
    if at.is_empty() {
        return dialect;
    }
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((.., derived)) = made.iter().find(|(own, rows, _)| std::ptr::eq(*own, dialect) && *rows == at)
    {
        return derived;
    }
    let mut derived = dialect.clone();
    for row in at.iter().filter_map(|at| dialect.variant.get(*at)) {
        row.put_into(&mut derived);
    }
    // What a user has chosen is never left out in silence.
    renew(&mut derived).expect("variants of which the loader has tried each two together");
    let derived: &'static Dialect = Box::leak(Box::new(derived));
    made.push((dialect, at, derived));
    derived
}

impl Dialect {
    /// The dictionary as each of its variants makes it, with that variant.
    pub fn variants(&'static self) -> impl Iterator<Item = (&'static VariantRow, &'static Dialect)> {
        self.variant.iter().map(move |row| {
            let value = |option: &str| {
                let own = || self.option.iter().find(|own| own.name == option).map(|own| own.default.clone());
                row.when.get(option).cloned().or_else(own).unwrap_or_default()
            };
            (row, chosen(self, value))
        })
    }
}
