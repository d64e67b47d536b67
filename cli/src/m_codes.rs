//! M codes of a machine that its dialect does not have, and calls of programs that are not at hand: what becomes of them,
//! as the user says with `--m-code` and `--call`.
//!
//! Not here: those that a machine's profile names (`ncc_machines`).

use ncc_dialects::{Dialect, Meaning, Settings};
use ncc_driver::problem::Problem;
use ncc_driver::render::messages::codes::may_be_stated;
use ncc_machines::reading::Side;

use crate::args::typed::MCode;
use crate::registry::DialectRegistry;

/// Puts what the user has said of M codes and calls into the dictionary of a side.
///
/// # Errors
/// A code that is left out or carried has a meaning in the source's dialect, or the code that is written for it has
/// one in the target's.
pub(crate) fn state(settings: &mut Settings, side: Side, known: &DialectRegistry) -> Result<(), Problem> {
    let own = |code: &MCode| match side {
        Side::From => Some(code.number),
        Side::To => code.written,
    };
    let numbers: Vec<(MCode, u16)> =
        known.m_codes().iter().filter_map(|code| Some((*code, own(code)?))).collect();
    let calls = if side == Side::From { known.calls_left_out() } else { &[] };
    let variables = if side == Side::From { known.variables_elsewhere() } else { &[] };
    if numbers.is_empty() && calls.is_empty() && variables.is_empty()
        || side == Side::To && (settings.dialect.can.flat || settings.dialect.can.everything)
    {
        return Ok(());
    }
    let source = settings.dialect;
    let coolant_code =
        |code: &MCode| coolant(source, code.written.filter(|written| *written != code.number)?);
    // The target has its coolant codes already.
    let numbers: Vec<_> =
        numbers.into_iter().filter(|(code, _)| side == Side::From || coolant_code(code).is_none()).collect();
    for (code, number) in &numbers {
        at_odds(code, *number, side, source)?;
    }
    let put = |dialect: &mut Dialect| {
        dialect.program.calls_left_out = calls.to_vec();
        // The command line goes before the machine's profile.
        dialect.program.variables_elsewhere.splice(0..0, variables.iter().cloned());
        for (code, number) in &numbers {
            let means = match code.written {
                // Read as that code of coolant.
                Some(_) if let Some(means) = coolant_code(code) => means,
                // A derived dictionary lives as long as the process.
                Some(_) => Meaning::MachineFunction(format!("m{}", code.number).leak()),
                None => Meaning::LeftOut,
            };
            let read_as = code.written.filter(|_| coolant_code(code).is_some());
            dialect.put_m_code(*number, means, "--m-code");
            if let Some(row) = dialect.code.iter_mut().find(|row| row.code == format!("M{number:02}")) {
                row.read_as = read_as.map(|written| format!("M{written:02}"));
            }
        }
    };
    settings.change(|plain| known.derived(plain, side, put));
    Ok(())
}

/// The meaning of a code that switches coolant.
fn coolant(dialect: &Dialect, number: u16) -> Option<Meaning> {
    let means = dialect.code_row(b'M', u32::from(number) * 10)?.means?;
    matches!(means, Meaning::FloodOn | Meaning::MistOn | Meaning::CoolantOff).then_some(means)
}

/// A code that has a meaning cannot have another one; in the target, one that its dialect refuses does something too.
fn at_odds(code: &MCode, number: u16, side: Side, dialect: &Dialect) -> Result<(), Problem> {
    let Some(row) = dialect.code_row(b'M', u32::from(number) * 10) else { return Ok(()) };
    if side == Side::From && code.written.is_none() && row.means == Some(Meaning::OptionalProgramStop) {
        // With its switch off it does nothing.
        return Ok(());
    }
    if side == Side::From && row.means == Some(Meaning::MistOn) && code.written != Some(code.number) {
        // The builder decides which coolant it is; without it, or with the other one, the cut is the same.
        return Ok(());
    }
    let (id, name) = (&dialect.id, &row.code);
    let does = match (row.means, &row.refuse) {
        (Some(Meaning::MachineFunction(function)), _) => function.to_owned(),
        (Some(meaning), _) => meaning.to_string(),
        (None, Some(refuse)) if side == Side::To || !may_be_stated(Some(row)) => refuse.clone(),
        (None, _) => return Ok(()),
    };
    let help = match side {
        Side::From => "it is for codes that the dialect does not have, or refuses".to_owned(),
        Side::To => {
            format!("name the code that does it there: --m-code M{}=M…, or leave it out: =drop", code.number)
        }
    };
    Err(Problem::usage(format!("--m-code: {name} of {id} is known: {does}"), help))
}
