//! The document that TRANSPILER makes of a program: the payload of the case study in both stages, and the list of
//! canonical functions.
//!
//! | part | what |
//! |---|---|
//! | `before`, `after` | the payload before and after processing, in ncc's form, or as it was put in |
//! | `cmf` | the list of canonical functions, a verified translation of the program |
//! | `cmf-refused` | why there is no such list: diagnostics as JSON |
//!
//! A payload has no work offsets, cutter compensation or path modes, so the list is made of the program, and kept beside.

use std::collections::BTreeMap;

use ncc_driver::time::payload::{self, Document};
use ncc_engine::Engine;
use ncc_engine::dialects::Dialects;
use ncc_machines::Profile;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use utoipa::ToSchema;

use crate::compiler::{self, DONE, put_machine, refusal};
use crate::http::Problem;
use crate::http::body::NAME;
use crate::shop::profile;
use crate::store::Parts;

/// The payload before processing.
pub(crate) const BEFORE: &str = "before";
/// The payload after processing.
pub(crate) const AFTER: &str = "after";
/// The list of canonical functions.
pub(crate) const CMF: &str = "cmf";
/// Diagnostics of a program without such a list.
pub(crate) const CMF_REFUSED: &str = "cmf-refused";

/// The media type of a [`Whole`].
pub(crate) const WHOLE_MEDIA: &str = "application/vnd.ncc.document+json";

/// A document with all its parts, as the services send it to each other.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Document)]
pub(crate) struct Whole {
    /// The short name of the machine; empty where there is none.
    pub(crate) machine: String,
    /// The name of the dialect.
    pub(crate) dialect: String,
    /// The parts by their names; all are text.
    pub(crate) parts: BTreeMap<String, String>,
}

impl Whole {
    /// A document that was sent, for a program of this name.
    ///
    /// # Errors
    /// A part is unknown, or no payload of this program.
    pub(crate) fn checked(self, name: &str) -> Result<(Parts, [String; 2]), Problem> {
        for (part, text) in &self.parts {
            match part.as_str() {
                BEFORE | AFTER => {
                    read(text.as_bytes(), name)?;
                }
                CMF | CMF_REFUSED => {}
                other => return Err(Problem::content(format!("a document has no part `{other}`"))),
            }
        }
        if !self.parts.contains_key(BEFORE) && !self.parts.contains_key(AFTER) {
            return Err(Problem::content("it has no payload"));
        }
        let parts = self.parts.into_iter().map(|(part, text)| (part, text.into_bytes())).collect();
        Ok((parts, short([self.machine, self.dialect])?))
    }
}

/// The names of a machine and a dialect, which every list of documents has.
fn short(names: [String; 2]) -> Result<[String; 2], Problem> {
    match names.iter().all(|name| name.len() <= NAME) {
        true => Ok(names),
        false => Err(Problem::content(format!("its machine or its dialect has more than {NAME} bytes"))),
    }
}

/// Reads a payload of a program.
///
/// # Errors
/// It is none, or of another program.
pub(crate) fn read(text: &[u8], name: &str) -> Result<Document, Problem> {
    let document =
        payload::read(text).map_err(|unread| Problem::content(unread.problem("the body").message))?;
    match document.prog_name == name {
        true => Ok(document),
        false => Err(Problem::content(format!(
            "its prog_name is {:?}, and the address says {name:?}",
            document.prog_name
        ))),
    }
}

/// A payload that was put in by itself.
///
/// # Errors
/// As of [`read`].
pub(crate) fn of_payload(text: &[u8], name: &str) -> Result<(Parts, [String; 2]), Problem> {
    let document = read(text, name)?;
    let part = if document.processed().is_ok() { AFTER } else { BEFORE };
    let of = short([document.machine_name, document.dialect])?;
    Ok((Parts::from([(part.to_owned(), text.to_vec())]), of))
}

/// Settings for the processing of a program.
#[derive(Clone, Debug, Default)]
pub(crate) struct Setting {
    /// The name of its dialect; none is recognised.
    pub(crate) dialect: Option<String>,
    /// The name of its machine.
    pub(crate) machine: Option<String>,
    /// The machine's profile, where it is not one that comes with ncc.
    pub(crate) profile: Option<String>,
    /// Dialects that its dialect and its profile are looked for among.
    pub(crate) dialects: Dialects,
    /// Choices where the dictionary leaves a question open.
    pub(crate) options: BTreeMap<String, String>,
    /// Position of the tool before the first block, program coordinates: `X-9,Y15.588,Z3`.
    pub(crate) start: Option<String>,
    /// Seconds on the clock before the first block.
    pub(crate) start_time: f64,
    /// The model of the times.
    pub(crate) model: Option<String>,
    /// The function that takes the time of a tool change.
    pub(crate) tool_change_on: Option<String>,
    /// Units at power-on.
    pub(crate) units: Option<String>,
    /// Whether it is for a mill, whatever it looks like.
    pub(crate) assume_milling: bool,
}

/// A processed program, for its writer.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Processed)]
pub(crate) struct Account {
    prog_name: String,
    /// Short name of the machine; empty where there is none.
    machine_name: String,
    dialect: String,
    /// Blocks of the payload after processing.
    blocks: usize,
    /// Time stamp at the end of the program, s.
    seconds: f64,
    /// Diagnostics of the program, each as a line of `ncc --format json`.
    diagnostics: Value,
    /// Settings of the control that ncc assumed.
    assumed: Value,
    /// The list of canonical functions is kept.
    cmf: bool,
    /// Diagnostics, where the list is refused.
    cmf_refused: Option<Value>,
}

/// Results of a processed program.
#[derive(Debug)]
pub(crate) struct Made {
    /// The parts of its document.
    pub(crate) parts: Parts,
    /// The short name of its machine, and the name of its dialect.
    pub(crate) of: [String; 2],
    /// The answer to the writer.
    pub(crate) account: Account,
}

/// The parts of a payload that an account of it has; the others are passed over.
#[derive(Deserialize)]
struct Glance {
    dialect: String,
    blocks: Vec<Stamp>,
}

/// The time stamp of a block, s.
#[derive(Deserialize)]
struct Stamp {
    timestamp: f64,
}

/// Processes a program. Each payload has `most` bytes at most.
///
/// # Errors
/// The program is refused, or what it is processed with.
pub(crate) fn process(name: &str, program: &[u8], setting: &Setting, most: u64) -> Result<Made, Problem> {
    let mut engine = Engine::default();
    engine.know(setting.dialects.clone());
    engine.put(name, program.to_vec());
    let profile = setting.profile.as_deref();
    let machine = setting.machine.as_ref().map(|name| put_machine(&mut engine, name, profile));
    let mut time = json!({ "verb": "time", "file": name, "findings": true, "most": most });
    state(&mut time, setting, machine.as_deref());
    let after = timed(&mut engine, &time)?;
    let [findings, assumed] = ["findings", "assumed"].map(|name| compiler::json(&engine, name));
    time["stage"] = "before".into();
    let before = timed(&mut engine, &time)?;
    let Glance { dialect, blocks } = serde_json::from_slice(&after).map_err(|_| Problem::fault())?;
    let mut parts = Parts::from([(AFTER.to_owned(), after), (BEFORE.to_owned(), before)]);
    let refused = match canonical(&mut engine, name, setting, machine.as_deref(), &dialect) {
        Ok(list) => {
            parts.insert(CMF.to_owned(), list);
            None
        }
        Err(found) => {
            parts.insert(CMF_REFUSED.to_owned(), serde_json::to_vec(&found).unwrap_or_default());
            Some(found)
        }
    };
    let account = Account {
        prog_name: name.to_owned(),
        machine_name: setting.machine.clone().unwrap_or_default(),
        dialect: dialect.clone(),
        blocks: blocks.len(),
        seconds: blocks.last().map_or(0.0, |block| block.timestamp),
        diagnostics: findings,
        assumed,
        cmf: refused.is_none(),
        cmf_refused: refused,
    };
    Ok(Made { parts, of: [setting.machine.clone().unwrap_or_default(), dialect], account })
}

/// States in a request what a program is processed with.
fn state(request: &mut Value, setting: &Setting, machine: Option<&str>) {
    request["from"] = json!(setting.dialect);
    request["machine"] = json!(machine);
    request["from_option"] = json!(setting.options);
    request["start"] = json!(setting.start);
    request["start_time"] = json!(setting.start_time);
    request["model"] = json!(setting.model);
    request["tool_change_on"] = json!(setting.tool_change_on);
    request["units"] = json!(setting.units);
    request["assume_milling"] = json!(setting.assume_milling);
}

fn timed(engine: &mut Engine, request: &Value) -> Result<Vec<u8>, Problem> {
    let code = engine.run(&request.to_string());
    match (code, engine.output("times")) {
        (DONE, Some(times)) => Ok(times.to_vec()),
        _ => Err(refusal(engine, code, compiler::json(engine, "findings"), Value::Null)),
    }
}

/// The program as a list of canonical functions, verified; or the diagnostics that keep it from being one.
fn canonical(
    engine: &mut Engine,
    name: &str,
    setting: &Setting,
    machine: Option<&str>,
    dialect: &str,
) -> Result<Vec<u8>, Value> {
    // What a profile states of its control holds for programs in that control's language alone.
    let is_own = |profile: &Profile| !profile.any_control && profile.dialect.id == dialect;
    let names_control = match (&setting.profile, &setting.machine) {
        (Some(text), _) => profile(text, &setting.dialects).is_ok_and(|own| is_own(&own)),
        (None, Some(name)) => ncc_machines::find(name).is_some_and(is_own),
        (None, None) => false,
    };
    let request = json!({
        "verb": "translate",
        "file": name,
        "from": dialect,
        "to": "canon",
        "machine_from": machine.filter(|_| names_control),
        "from_option": setting.options,
        "start": setting.start,
        "units": setting.units,
        "assume_milling": setting.assume_milling,
        "no_head": true,
    });
    let code = engine.run(&request.to_string());
    match (code, engine.output("output")) {
        (DONE, Some(list)) => Ok(list.to_vec()),
        _ => {
            let report = compiler::json(engine, "report");
            Err(json!({
                "questions": report.get("questions"),
                "diagnostics": report.get("diagnostics"),
                "messages": compiler::text(engine, "messages"),
            }))
        }
    }
}
