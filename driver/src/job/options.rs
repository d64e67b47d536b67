//! What a user chooses of a dialect: its options, and units at power-on.

use ncc_dialects::{SettingError, Settings};
use ncc_ir::canon::Units;

use crate::problem::Problem;

/// States the units at power-on of a source, as far as the user has.
///
/// # Errors
/// Its control always has others, or its machine's profile states them.
pub fn state_units(settings: &mut Settings, units: Option<Units>) -> Result<(), Problem> {
    let Some(units) = units else { return Ok(()) };
    if settings.state_units(units) {
        return Ok(());
    }
    let own = match units {
        Units::Mm => "inch",
        Units::Inch => "mm",
    };
    Err(Problem::usage(
        format!("--units contradicts what is known: {} begins in {own}", settings.dialect.id),
        "leave --units out, or correct the profile of the machine",
    ))
}

/// Settings with what the user has chosen.
///
/// # Errors
/// There is no such option, or it does not take the value.
pub fn choose(mut settings: Settings, chosen: &[(String, String)]) -> Result<Settings, Problem> {
    let dialect = settings.dialect;
    for (option, value) in chosen {
        settings.choose(option, value).map_err(|error| match error {
            SettingError::NoOption(option) => Problem::usage(
                format!("{} has no option `{option}`", dialect.id),
                match dialect.option.is_empty() {
                    true => "it has no options at all".to_owned(),
                    false => {
                        let names: Vec<&str> = dialect.option.iter().map(|o| o.name.as_str()).collect();
                        format!("it has: {}", names.join(", "))
                    }
                },
            ),
            SettingError::NoValue { option, values } => Problem::usage(
                format!("`{value}` is no value of {option}"),
                match values.is_empty() {
                    true => "it takes a number from 0, such as 0.02".to_owned(),
                    false => format!("it takes: {}", values.join(", ")),
                },
            ),
        })?;
    }
    Ok(settings)
}
