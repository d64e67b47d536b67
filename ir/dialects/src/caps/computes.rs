//! Capabilities for computed programs: derives [`Computes`] from a dialect's dictionary.
//!
//! Variables, operators, functions, loops and table entries come from the `[formula]` and `[[system]]` rows.
//! Not here: the spelling of expressions, and rewriting for a target that lacks one of them (the passes).

use std::sync::Arc;

use ncc_ir::alarms::Alarms;
use ncc_ir::computed::computes::Computes;
use ncc_ir::expr::Function;
use ncc_ir::expr::system::System;

use crate::formula::{Handing, Statement};
use crate::meaning::Meaning;
use crate::schema::{Dialect, Family};
use crate::stored::VariableName;

/// Default number of digits of a value in a message (LinuxCNC 2.9, gcode/overview, comment parameters).
const VALUE_DIGITS: u8 = 6;

/// Option of a dictionary: the range of arc sine and arc tangent, in degrees. `turn` is 0 to 360 (arc sine: 270 to
/// 90). `half` is half a turn to each side (arc sine: -90 to 90).
pub const ANGLE_RANGE: &str = "angle_range";

/// Value of [`ANGLE_RANGE`] for 0 to 360 degrees.
pub(crate) const TURN: &str = "turn";

/// The dialect's capabilities for computed programs; `None` if it has no formulas or no operators.
pub(super) fn computes(dialect: &Dialect) -> Option<Arc<Computes>> {
    if !reads_formulas(dialect) || dialect.formula.operators.is_empty() {
        return None;
    }
    let says = |meaning| dialect.code_for(meaning).is_some();
    let rules = &dialect.formula;
    let (system, entries) = systems(dialect);
    Some(Arc::new(Computes {
        statements: rules.statements.iter().map(|statement| (*statement).into()).collect(),
        operators: rules.operators.keys().map(|operator| (*operator).into()).collect(),
        functions: {
            let by_bits = [Function::BitAnd, Function::BitOr, Function::BitXor];
            let own = rules.functions.keys().map(|function| (*function).into());
            let remainder = rules.remainder.iter().map(|_| Function::Remainder);
            let given = rules.exists.iter().map(|_| Function::Given);
            let by_bits = by_bits.into_iter().filter(|f| rules.by_bits(*f).is_some());
            let between = rules.between.keys().map(|function| (*function).into());
            own.chain(between).chain(remainder).chain(given).chain(by_bits).collect()
        },
        remainders: rules.remainders.into(),
        values: dialect.named_values().map(|(.., value)| value).collect(),
        local: rules.local.clone(),
        common: rules.common.clone(),
        retentive: rules.retentive.clone(),
        loops: rules.loops,
        calls: rules.calls,
        arguments: says(Meaning::CallMacro) || rules.parameters != Handing::Letters,
        handed: rules.parameters.into(),
        shares: rules.parameters == Handing::Letters,
        mark: rules.variable.as_str().into(),
        named: rules.with_names(dialect.name.iter().map(|row| row.name.as_str())),
        arguments_again: rules.arguments_again,
        exists: rules.exists.is_some(),
        equal_within: rules.tolerance(),
        whole: rules.whole,
        alarms: rules.statements.contains(&Statement::Alarm).then_some(Alarms {
            numbers: rules.alarms,
            signs: dialect.comment.upper_ascii.then(|| dialect.comment.signs.as_str().into()),
            longest: (rules.alarm_text > 0).then_some(rules.alarm_text),
        }),
        values_in_full: (!dialect.comment.shown.is_empty()).then_some(VALUE_DIGITS),
        output_opened: rules.output_opened,
        planes_alarm: dialect.cycles.planes_alarm.map(i64::from),
        system,
        entries,
        worth: rules.not_behind.is_some(),
        named_programs: dialect.program.o_words,
        prefix: rules.prefix.as_str().into(),
        vacant: rules.vacant.is_some(),
        rounds: rules.rounds,
        increments: {
            let lengths = dialect.numbers(crate::Quantity::Length);
            [lengths.increment, lengths.increment_inch.unwrap_or(lengths.increment)]
        },
        // The default only: an option that the user chooses overrides it ([`crate::Settings::caps`]).
        turn: dialect.option.iter().any(|option| option.name == ANGLE_RANGE && option.default == TURN),
        blocks: rules.blocks,
        opposite: rules.not.is_some() || rules.not_behind.is_some(),
        near: rules.near,
        restates: rules.restates,
    }))
}

/// System variables that a program of the dialect can read. The second list repeats those that are table entries.
/// Each entry has the number that a program writes: the number of the variable, or the entry within a name.
fn systems(dialect: &Dialect) -> (Vec<System>, Vec<(System, i64)>) {
    let (mut all, mut entries) = (Vec::new(), Vec::new());
    for (system, spelt) in dialect.system.iter().flat_map(|row| row.says()) {
        let number = match (&system, spelt) {
            (System::WorkOffset { .. } | System::ToolTable { .. }, VariableName::Number(parameter)) => {
                Some(i64::from(parameter))
            }
            (
                System::WorkOffset { number, .. } | System::ToolTable { entry: number, .. },
                VariableName::Whole { .. },
            ) => Some(i64::from(*number)),
            _ => None,
        };
        entries.extend(number.map(|number| (system.clone(), number)));
        all.push(system);
    }
    (all, entries)
}

/// Whether a program of this dialect can compute. A word dialect may inherit formula rows for a language that it does
/// not read. Those rows do not count.
fn reads_formulas(dialect: &Dialect) -> bool {
    match dialect.family {
        Family::Word => dialect.program.macro_b || dialect.program.o_words,
        Family::Sinumerik | Family::Canon | Family::Ir => true,
    }
}
