//! What a user chooses of a dialect: its options, and units at power-on.

use ncc_dialects::{SettingError, Settings};
use ncc_ir::canon::Units;

use crate::problem::{Exit, Problem, problem};
use crate::render::messages::message::Help;

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
    let message = problem("other-units").text("dialect", &settings.dialect.id).text("units", own);
    Err(Problem::of(Exit::Usage, &message, None))
}

/// Settings with what the user has chosen.
///
/// # Errors
/// There is no such option, or it does not take the value.
pub fn choose(mut settings: Settings, chosen: &[(String, String)]) -> Result<Settings, Problem> {
    let dialect = settings.dialect;
    for (option, value) in chosen {
        settings.choose(option, value).map_err(|error| match error {
            SettingError::NoOption(option) => {
                let names: Vec<&str> = dialect.option.iter().map(|o| o.name.as_str()).collect();
                let help = match names.is_empty() {
                    true => Help::new("help-none"),
                    false => Help::new("help").text("options", names.join(", ")),
                };
                let message = problem("no-option").text("dialect", &dialect.id).text("option", option);
                Problem::of(Exit::Usage, &message, Some(vec![help]))
            }
            SettingError::NoValue { option, values } => {
                let help = match values.is_empty() {
                    true => Help::new("help-number"),
                    false => Help::new("help").text("values", values.join(", ")),
                };
                let message = problem("no-value").text("value", value).text("option", option);
                Problem::of(Exit::Usage, &message, Some(vec![help]))
            }
        })?;
    }
    Ok(settings)
}
