//! A translation of a program that is kept here: what goes in, what comes out, and whether it still holds.
//!
//! The inputs are texts: the program, those that it calls, both machines' profiles, both dialects' dictionaries, and
//! ncc itself. Their digests are kept with the translation; it is *stale* as soon as one of them is another one now. Not
//! here: HTTP, and the translation itself (`ncc_driver`).

use std::collections::BTreeMap;

use ncc_engine::Engine;
use ncc_engine::dialects::Dialects;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use utoipa::ToSchema;

use crate::compiler::{self, DONE, put_machine, refusal};
use crate::http::Problem;
use crate::rights::Act;
use crate::shop::{dialects, dictionary};
use crate::store::{Outcome, Revision, Sort, State, Store, StoreError, Translation, Wanted, digest};

/// Bytes of the programs of a folder that are looked through for called ones, at most.
const FOLDER: u64 = 64 << 20;

/// Programs of a folder that are looked through, at most.
const PROGRAMS: u32 = 10_000;

/// The code of a called program that is not there.
pub(crate) const NOT_THERE: &str = "NC0217";

/// A request for a translation. Names and values are those of the command line's options.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default, deny_unknown_fields)]
#[schema(as = TranslationRequest)]
pub(crate) struct Asked {
    /// The program.
    pub(crate) program: String,
    /// The revision; without, the latest.
    pub(crate) revision: Option<i64>,
    /// Its dialect; without, what is known of the program.
    from: Option<String>,
    /// The machine that it was written for; without, what is known of the program.
    machine_from: Option<String>,
    /// The dialect of the output; without, that of the machine.
    to: Option<String>,
    /// The machine to translate for.
    machine_to: Option<String>,
    /// Choices where the source's dictionary leaves a question open.
    from_option: BTreeMap<String, String>,
    /// Choices where the target's dictionary does.
    to_option: BTreeMap<String, String>,
    /// Values of variables that the program reads and never sets.
    value: BTreeMap<String, String>,
    /// The source's units at power-on.
    units: Option<String>,
    /// Position of the tool before the first block, program coordinates: `X-9,Y15.588,Z3`.
    start: Option<String>,
    /// Program number of the output.
    program_number: Option<u32>,
    /// Whether open questions are answered with ncc's own readings.
    assume: bool,
    /// Whether it is for a mill, whatever it looks like.
    assume_milling: bool,
}

/// Digests of what goes in.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Inputs {
    /// Of the program's text.
    program: String,
    /// Of the profile of the machine that it was written for.
    machine_from: Option<String>,
    /// Of the profile of the machine to translate for.
    machine_to: Option<String>,
    /// Of the dictionaries of both dialects: none of a dialect that is recognised, nor of a built-in one that a machine names.
    dialects: [Option<String>; 2],
    /// The version of ncc.
    ncc: String,
    /// Of the programs that it calls, by their names in its folder.
    called: BTreeMap<String, String>,
}

/// A translation to be made.
struct Ready {
    asked: Asked,
    of: Revision,
    text: Vec<u8>,
    profiles: BTreeMap<String, String>,
    dialects: Dialects,
    inputs: Inputs,
    key: String,
}

/// Results of a translation.
struct Made {
    output: Vec<u8>,
    report: Vec<u8>,
    map: Vec<u8>,
}

/// The profile of a machine, with its digest; one that comes with ncc has no text of its own.
pub(crate) fn profile(store: &Store, name: &str) -> Result<(Option<String>, String), Problem> {
    if let Some(text) = ncc_machines::shipped_text(name) {
        return Ok((None, digest(&[text.as_bytes()])));
    }
    match store.shop_text(Sort::Machine, name) {
        Ok(machine) => Ok((Some(machine.text), machine.tag)),
        Err(StoreError::Absent) => {
            Err(Problem::request(format!("there is no machine `{name}`"))
                .help("GET /api/v1/machines lists them"))
        }
        Err(error) => Err(error.into()),
    }
}

/// Gathers what goes in.
fn ready(store: &Store, mut asked: Asked) -> Result<Ready, Problem> {
    let of = match asked.revision {
        None => store.program(&asked.program)?,
        Some(number) => store.revision(&asked.program, number)?,
    };
    asked.revision = Some(of.number);
    let known = |name: &str| Some(name.to_owned()).filter(|name| !name.is_empty());
    asked.from = asked.from.or_else(|| known(&of.details.dialect));
    asked.machine_from = asked.machine_from.or_else(|| known(&of.details.machine));
    let text = store.whole(&of.content)?;
    let (mut profiles, mut digests) = (BTreeMap::new(), Vec::new());
    for name in [&asked.machine_from, &asked.machine_to] {
        digests.push(match name {
            None => None,
            Some(name) => {
                let (text, digest) = profile(store, name)?;
                profiles.extend(text.map(|text| (name.clone(), text)));
                Some(digest)
            }
        });
    }
    let dialects = dialects(store)?;
    let dictionaries =
        [(&asked.from, &asked.machine_from), (&asked.to, &asked.machine_to)].map(|(id, machine)| {
            let own = machine.as_ref().and_then(|name| profiles.get(name));
            dictionary(&dialects, id.as_deref(), own.map(String::as_str))
        });
    let inputs = Inputs {
        program: of.content.sha256.clone(),
        machine_to: digests.pop().flatten(),
        machine_from: digests.pop().flatten(),
        dialects: dictionaries,
        ncc: env!("CARGO_PKG_VERSION").to_owned(),
        called: BTreeMap::new(),
    };
    // The same of another revision with the same text.
    let stated = json!([{ "name": of.details.name }, Asked { revision: None, ..asked.clone() }, inputs]);
    let key = digest(&[stated.to_string().as_bytes()]);
    Ok(Ready { asked, of, text, profiles, dialects, inputs, key })
}

/// Programs in the folder of a program, as they are now, but for itself.
fn neighbours(store: &Store, of: &Revision) -> Result<Vec<Revision>, Problem> {
    let folder = Some(of.details.folder.clone());
    let all = store.programs(&Wanted { folder, most: PROGRAMS, ..Wanted::default() })?;
    Ok(all
        .into_iter()
        .filter(|other| other.program != of.program && other.details.name != of.details.name)
        .collect())
}

/// The same, as far as they are not too large to be looked through for called ones.
pub(crate) fn callable(store: &Store, of: &Revision) -> Result<Vec<Revision>, Problem> {
    let all = neighbours(store, of)?;
    match all.iter().map(|own| own.content.bytes).sum::<u64>() > FOLDER {
        false => Ok(all),
        true => Err(Problem::not_made(
            format!("it calls a program, and those of its folder have more than {FOLDER} bytes"),
            None,
        )),
    }
}

/// Whether the programs that another one calls are still the same.
pub(crate) fn calls_the_same(
    store: &Store,
    of: &Revision,
    called: &BTreeMap<String, String>,
) -> Result<bool, Problem> {
    if called.is_empty() {
        return Ok(true);
    }
    let now: BTreeMap<String, String> =
        neighbours(store, of)?.into_iter().map(|own| (own.details.name, own.content.sha256)).collect();
    Ok(called.iter().all(|(name, digest)| now.get(name) == Some(digest)))
}

/// Digests of what went in, as they were kept.
fn inputs(of: &Translation) -> Result<Inputs, Problem> {
    serde_json::from_str(&of.inputs).map_err(|_| Problem::fault())
}

/// The stored request of a translation.
fn asked(of: &Translation) -> Result<Asked, Problem> {
    serde_json::from_str(&of.asked).map_err(|_| Problem::fault())
}

/// Inputs that have changed since a translation was made; empty if the translation is up to date.
pub(crate) fn stale(store: &Store, of: &Translation) -> Result<Vec<&'static str>, Problem> {
    let (before, asked) = (inputs(of)?, asked(of)?);
    let head = store.program(&of.program)?;
    let machine = |name: &Option<String>| match name {
        None => Ok((None, None)),
        Some(name) => match profile(store, name) {
            Ok((text, digest)) => Ok((text, Some(digest))),
            // It has been deleted since.
            Err(problem) if problem.is_request() => Ok((None, None)),
            Err(problem) => Err(problem),
        },
    };
    let (own_from, machine_from) = machine(&asked.machine_from)?;
    let (own_to, machine_to) = machine(&asked.machine_to)?;
    let now = dialects(store)?;
    let dialects = [(&asked.from, own_from), (&asked.to, own_to)]
        .map(|(id, own)| dictionary(&now, id.as_deref(), own.as_deref()));
    let then = store.revision(&of.program, of.revision)?;
    let changed = [
        ("program", head.content.sha256 != before.program),
        ("machine_from", machine_from != before.machine_from),
        ("machine_to", machine_to != before.machine_to),
        ("dialect", dialects != before.dialects),
        ("ncc", before.ncc != env!("CARGO_PKG_VERSION")),
        ("called programs", !calls_the_same(store, &then, &before.called)?),
    ];
    Ok(changed.into_iter().filter(|(_, changed)| *changed).map(|(what, _)| what).collect())
}

/// Translates a program, or gives the translation that has been made of the same already: then not as a new one.
///
/// # Errors
/// There is no such program or machine; it is refused, or a question is open.
pub(crate) fn translate(
    store: &Store,
    asked: Asked,
    id: String,
    author: &str,
) -> Result<(Translation, bool), Problem> {
    store.allows(Act::Change, &asked.program)?;
    let is_named = asked.revision.is_some();
    let mut ready = ready(store, asked)?;
    for there in store.same_translations(&ready.key)? {
        if calls_the_same(store, &ready.of, &inputs(&there)?.called)? {
            return Ok((there, false));
        }
    }
    let made = run(store, &mut ready)?;
    let record = Translation {
        id: id.clone(),
        key: ready.key,
        program: ready.of.program.clone(),
        revision: ready.of.number,
        asked: serde_json::to_string(&ready.asked).unwrap_or_default(),
        inputs: serde_json::to_string(&ready.inputs).unwrap_or_default(),
        target: target(&ready.asked),
        state: State::default(),
        author: author.to_owned(),
        made: 0,
    };
    let kept = store.keep_translation(&record, [&made.output, &made.report, &made.map])?;
    let is_new = kept.id == id;
    // One of an earlier revision is stale from its beginning.
    if is_new && is_named && !stale(store, &kept)?.is_empty() {
        store.note_stale(&kept.id)?;
    }
    Ok((kept, is_new))
}

/// The target of a translation, machine and dialect. At most one translation for a target is released.
fn target(asked: &Asked) -> String {
    [&asked.machine_to, &asked.to].map(|name| name.clone().unwrap_or_default()).join(" ").trim().to_owned()
}

/// An engine with the program and the profiles of both machines, and the names of both machines there.
fn engine(ready: &Ready) -> (Engine, [Option<String>; 2]) {
    let mut engine = Engine::default();
    engine.know(ready.dialects.clone());
    engine.put(&ready.of.details.name, ready.text.clone());
    let machines = [&ready.asked.machine_from, &ready.asked.machine_to].map(|name| {
        let name = name.as_ref()?;
        Some(put_machine(&mut engine, name, ready.profiles.get(name).map(String::as_str)))
    });
    (engine, machines)
}

/// Has the engine translate; where a program that is called is not in the text, again with those of its folder.
fn run(store: &Store, ready: &mut Ready) -> Result<Made, Problem> {
    let asked = &ready.asked;
    let (mut engine, [machine_from, machine_to]) = engine(ready);
    let request = json!({
        "verb": "translate",
        "file": ready.of.details.name,
        "from": asked.from,
        "to": asked.to,
        "machine_from": machine_from,
        "machine_to": machine_to,
        "from_option": asked.from_option,
        "to_option": asked.to_option,
        "value": asked.value,
        "units": asked.units,
        "start": asked.start,
        "program_number": asked.program_number,
        "assume": asked.assume,
        "assume_milling": asked.assume_milling,
        "map": true,
    })
    .to_string();
    let (code, folder) = run_with_called(store, &ready.of, &mut engine, &request)?;
    let report = engine.output("report").unwrap_or_default().to_vec();
    let (DONE, Some(text)) = (code, engine.output("output")) else {
        let told = compiler::json(&engine, "report");
        return Err(refusal(&engine, code, told["diagnostics"].clone(), told["questions"].clone()));
    };
    let lines = engine.output("lines").unwrap_or_default();
    let (lines, _) = lines.as_chunks::<4>();
    let lines: Vec<u32> = lines.iter().map(|bytes| u32::from_le_bytes(*bytes)).collect();
    let told = compiler::json(&engine, "report");
    let called = told["source"]["called"].as_array().into_iter().flatten();
    let called = called.filter_map(|file| file["file"].as_str());
    ready.inputs.called =
        called.filter_map(|name| Some((name.to_owned(), folder.get(name)?.clone()))).collect();
    Ok(Made { output: text.to_vec(), report, map: serde_json::to_vec(&lines).unwrap_or_default() })
}

/// Does a request of a program; where one that it calls is not in its text, again with those of its folder. Gives the code,
/// and the digests of the programs that stand beside it.
pub(crate) fn run_with_called(
    store: &Store,
    of: &Revision,
    engine: &mut Engine,
    request: &str,
) -> Result<(u8, BTreeMap<String, String>), Problem> {
    let code = engine.run(request);
    if code == DONE || !compiler::text(engine, "messages").contains(NOT_THERE) {
        return Ok((code, BTreeMap::new()));
    }
    let folder = with_folder(store, of, engine)?;
    Ok((engine.run(request), folder))
}

/// Puts the programs of the folder beside the program; gives their digests.
fn with_folder(
    store: &Store,
    of: &Revision,
    engine: &mut Engine,
) -> Result<BTreeMap<String, String>, Problem> {
    let mut folder = BTreeMap::new();
    for own in callable(store, of)? {
        engine.put(&own.details.name, store.whole(&own.content)?);
        folder.insert(own.details.name, own.content.sha256);
    }
    Ok(folder)
}

/// The certificate of a translation: both programs executed and compared once more.
///
/// # Errors
/// A profile has been deleted or changed since.
pub(crate) fn certificate(store: &Store, of: &Translation) -> Result<Vec<u8>, Problem> {
    if let Some(content) = store.outcome(&of.id, Outcome::Certificate)? {
        return Ok(store.whole(&content)?);
    }
    let ready = ready(store, asked(of)?)?;
    let before = inputs(of)?;
    let same = Inputs { called: before.called.clone(), ..ready.inputs.clone() } == before
        && calls_the_same(store, &ready.of, &before.called)?;
    if !same {
        return Err(Problem::not_made(
            "the translation is stale, and its certificate was not asked for before",
            None,
        )
        .help("translate the program again"));
    }
    let (mut engine, [machine_from, machine_to]) = engine(&ready);
    if !before.called.is_empty() {
        with_folder(store, &ready.of, &mut engine)?;
    }
    let text = store.outcome(&of.id, Outcome::Output)?.ok_or(StoreError::Absent)?;
    let translated = format!("{} (translated)", ready.of.details.name);
    engine.put(&translated, store.whole(&text)?);
    let report = store.outcome(&of.id, Outcome::Report)?.ok_or(StoreError::Absent)?;
    let report: Value = serde_json::from_slice(&store.whole(&report)?).unwrap_or_default();
    let asked = &ready.asked;
    let request = json!({
        "verb": "verify",
        "a": {
            "file": ready.of.details.name,
            "from": report["source"]["dialect"],
            "machine": machine_from,
            "from_option": asked.from_option,
            "units": asked.units,
            "assume_milling": asked.assume_milling,
        },
        "b": {
            "file": translated,
            "from": report["target"]["dialect"],
            "machine": machine_to,
            "from_option": asked.to_option,
        },
    });
    let code = engine.run(&request.to_string());
    let Some(document) = engine.output("document") else {
        return Err(refusal(&engine, code, Value::Null, Value::Null));
    };
    store.keep_certificate(&of.id, document)?;
    Ok(document.to_vec())
}
