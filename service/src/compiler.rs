//! Requests to the engine, and its refusals as problems.
//!
//! Not here: the requests of each service, and the compiler (`ncc_engine`, `ncc_driver`).

use ncc_driver::problem::Exit;
use ncc_engine::Engine;
use serde_json::Value;

use crate::http::Problem;

/// The request is done.
pub(crate) const DONE: u8 = Exit::Done as u8;

/// The program has errors; of a check: it has findings.
pub(crate) const REFUSED: u8 = Exit::Refused as u8;

/// An output as text; empty if the engine has none of this name.
pub(crate) fn text(engine: &Engine, name: &str) -> String {
    engine.output(name).map(|text| String::from_utf8_lossy(text).into_owned()).unwrap_or_default()
}

/// An output as JSON; `null` if the engine has none of this name.
pub(crate) fn json(engine: &Engine, name: &str) -> Value {
    engine.output(name).and_then(|bytes| serde_json::from_slice(bytes).ok()).unwrap_or_default()
}

/// Puts the profile of a machine among the files, and gives its name there. A program may have the machine's name, so the
/// profile has a prefix. A machine without a profile text comes with ncc, and keeps its name.
pub(crate) fn put_machine(engine: &mut Engine, machine: &str, profile: Option<&str>) -> String {
    let Some(profile) = profile else { return machine.to_owned() };
    let name = format!("machine {machine}");
    engine.put(&name, profile.as_bytes().to_vec());
    name
}

/// The refusal of a request as a problem, with its diagnostics and open questions.
pub(crate) fn refusal(engine: &Engine, code: u8, diagnostics: Value, questions: Value) -> Problem {
    let messages = text(engine, "messages");
    if code == Exit::Usage as u8 {
        return usage(&messages);
    }
    let is_asked = questions.as_array().is_some_and(|all| !all.is_empty());
    let detail = if is_asked {
        "a question is open: answer it by one of the options that it names"
    } else if code == Exit::VerificationFailed as u8 {
        "the output was not shown to make the same cut: please report it"
    } else {
        "the messages say why, and where"
    };
    let mut diagnostics = diagnostics;
    // Errors come before warnings and assumptions.
    if let Some(all) = diagnostics.as_array_mut() {
        all.sort_by_key(|diagnostic| diagnostic["severity"] != "error");
    }
    let diagnostics = Some(diagnostics).filter(|all| !all.is_null());
    Problem::refused(detail, diagnostics, messages).asking(Some(questions).filter(|_| is_asked))
}

/// A request in the wrong form. The engine prints `error: …` and lines of help.
fn usage(messages: &str) -> Problem {
    let mut lines = messages.trim().lines().map(str::trim);
    let detail = lines.next().unwrap_or_default().trim_start_matches("error: ").to_owned();
    lines.fold(Problem::request(detail), |problem, line| problem.help(line.trim_start_matches("help: ")))
}
