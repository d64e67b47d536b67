//! A profile as its control: the dictionary of its dialect with what the profile states put in.
//!
//! A fact at power-on that is stated always holds; the shop's choices that decide how words are
//! written are rows of the dictionary too. A derived dictionary is made once for all profiles that
//! state the same of their control, and lives as long as the process.

use std::collections::HashMap;
use std::sync::{LazyLock, Mutex, PoisonError};

use ncc_dialects::{Dialect, ElsewhereRow, Meaning, PowerOnFact, Quantity, Settings};

use crate::fact::Fact;
use crate::profile::Profile;
use crate::schema::{BlockNumbers, Characters, Effect, LineEnds, MCodeRow, ToolChangeForm};

/// How programs for the machine are laid out, as far as the shop has said.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Block numbers, with first and step of new ones.
    pub numbers: Option<(BlockNumbers, u32, u32)>,
    /// Line ends.
    pub line_ends: Option<LineEnds>,
    /// Characters.
    pub characters: Option<Characters>,
    /// Blocks of a tool change.
    pub tool_change: Option<ToolChangeForm>,
    /// Comments at the beginning.
    pub header: Vec<String>,
    /// Comments before the end.
    pub footer: Vec<String>,
}

impl Profile {
    /// The dialect with what the profile states of it: options chosen, power-on facts fixed.
    pub fn settings(&self) -> Settings {
        let mut settings = Settings::new(self.derived());
        for (option, choice) in &self.schema.options {
            if let Some(value) = &choice.value {
                // The profile has been checked: the option takes the value.
                let _ = settings.choose(option.get_ref(), &value.0);
            }
        }
        settings
    }

    /// The dictionary with what the profile states. A server derives it for each request: all of them have one.
    fn derived(&self) -> &'static Dialect {
        static MADE: LazyLock<Mutex<HashMap<String, &'static Dialect>>> = LazyLock::new(Mutex::default);
        let names = self.values().map(|(name, _)| name).collect::<Vec<_>>();
        let schema = &self.schema;
        // Dictionaries live as long as the process, so each is known by its address.
        let dialect = std::ptr::from_ref(self.dialect);
        let stated = format!("{:?}", (dialect, &schema.power_on, &schema.m_code, names, &schema.emit));
        let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
        made.entry(stated).or_insert_with(|| Box::leak(Box::new(self.derive())))
    }

    fn derive(&self) -> Dialect {
        let mut dialect = self.dialect.clone();
        let (said, facts) = (&self.schema.power_on, &mut dialect.power_on);
        put(&mut facts.units, &said.units, Some);
        put(&mut facts.distance, &said.distance, Some);
        put(&mut facts.plane, &said.plane, Some);
        put(&mut facts.feed_mode, &said.feed_mode, Some);
        put(&mut facts.return_level, &said.return_level, Some);
        put(&mut facts.motion, &said.motion, Some);
        put(&mut facts.work_offset, &said.work_offset, |n| u16::try_from(n).ok());
        put(&mut facts.length_offset, &said.length_offset, Some);
        put(&mut facts.no_origin_shift, &said.no_origin_shift, Some);
        for row in &self.schema.m_code {
            machine_function(row.get_ref(), &mut dialect);
        }
        let elsewhere =
            self.values().map(|(name, _)| ElsewhereRow { name: name.to_ascii_uppercase(), left_out: false });
        dialect.program.variables_elsewhere = elsewhere.collect();
        let emit = &self.schema.emit;
        if let Some(blanks) = emit.blanks.value {
            dialect.block.blanks = blanks;
        }
        if let Some(rules) = dialect.number.get_mut(&Quantity::Length) {
            let digits = |n: u32| u8::try_from(n).unwrap_or(u8::MAX);
            let inch = rules.decimals_inch.unwrap_or(rules.decimals);
            if let Some(n) = emit.decimals.value {
                rules.decimals = digits(n).min(rules.decimals);
            }
            rules.decimals_inch = Some(emit.decimals_inch.value.map_or(inch, |n| digits(n).min(inch)));
        }
        if emit.characters.value == Some(Characters::Capitals) && !dialect.comment.upper_ascii {
            dialect.comment.upper_ascii = true;
            dialect.comment.signs = ".,=_-+/*:".to_owned();
        }
        dialect
    }

    /// The shop's choices for emitted programs.
    pub fn layout(&self) -> Layout {
        let emit = &self.schema.emit;
        let number = |fact: &Fact<u32>| fact.value.unwrap_or(0);
        Layout {
            numbers: emit
                .block_numbers
                .value
                .map(|numbers| (numbers, number(&emit.first_number), number(&emit.number_step))),
            line_ends: emit.line_ends.value,
            characters: emit.characters.value,
            tool_change: emit.tool_change.value,
            header: emit.header.value.clone().unwrap_or_default(),
            footer: emit.footer.value.clone().unwrap_or_default(),
        }
    }
}

/// Puts an M code of the machine in.
fn machine_function(row: &MCodeRow, dialect: &mut Dialect) {
    let Some(number) = row.code.value.as_deref().and_then(|code| code.get(1..)?.parse().ok()) else { return };
    let means = match (&row.function.value, row.effect.value) {
        // A derived dictionary lives as long as the process.
        (Some(function), _) => Meaning::MachineFunction(Box::leak(function.clone().into_boxed_str())),
        (None, Some(Effect::None)) => Meaning::LeftOut,
        (None, None) => return,
    };
    // The profile has been checked: it is a code that the dialect does not have, or refuses.
    dialect.put_m_code(number, means, "machine profile");
}

/// Puts a stated fact in, as one that always holds.
fn put<T: Copy, U>(row: &mut Option<PowerOnFact<U>>, said: &Fact<T>, as_row: impl Fn(T) -> Option<U>) {
    if let Some(value) = said.value.and_then(as_row) {
        *row = Some(PowerOnFact {
            value,
            always: true,
            of_the_machine: false,
            source: "machine profile".to_owned(),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dictionary_is_derived_once() {
        for own in crate::shipped() {
            let again =
                Profile::parse(crate::shipped_text(own.id()).expect("a text"), &ncc_dialects::builtin);
            let again = again.expect("a profile");
            assert!(std::ptr::eq(own.derived(), again.derived()), "{}", own.id());
            let mut other = again.clone();
            other.schema.emit.blanks.value = Some(!own.derived().block.blanks);
            assert_eq!(other.derived().block.blanks, !own.derived().block.blanks, "{}", own.id());
        }
    }
}
