//! Facts of a program, from its execution: tools, codes, times, extents; and the terms by which it is found.
//!
//! ```text
//! T3 M6, G81 … in 42 s    { "tools": [3], "codes": ["G81", "M6"], "seconds": 42.0, "extents": { "x": [0, 80], … } }
//! ```
//!
//! A program that cannot be executed has the facts of its text alone, with the reason. Facts are computed again when the
//! program, one that it calls, its machine or ncc is another one; if nothing of this has changed, as after a change of a tag,
//! the program is not executed again. Not here: who waits and who computes (`store::facts`, `workers`).

mod line;
mod words;

use std::collections::BTreeMap;
use std::io::Cursor;
use std::time::Duration;

use ncc_dialects::Dialect;
use ncc_driver::guess::recognise;
use ncc_driver::source::Source;
use ncc_engine::Engine;
use ncc_engine::dialects::Dialects;
use ncc_exec::halt;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::compiler::{self, DONE, put_machine};
use crate::http::Problem;
use crate::shop::{self, dictionary, stated_dialect};
use crate::store::{CALLS_ABSENT, Claimed, Computed, Revision, Store, Term, calls};
use crate::translating::{NOT_THERE, calls_the_same, profile, run_with_called, stale};

pub(crate) use self::line::{duration, line};
use self::words::Words;
pub(crate) use self::words::{code, words};

/// Seconds for which a program is claimed; more than its execution may take.
const CLAIM: i64 = 90;

/// Bytes of a text by which its dialect is recognised; more than are looked at.
const BEGINNING: usize = 1 << 17;

/// Translations of a program of which it is found out whether they are stale.
const TRANSLATIONS: u32 = 1000;

/// Digests of what the facts of a program depend on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Inputs {
    /// Of its text.
    program: String,
    /// Its dialect as it is stated.
    dialect: String,
    /// The name of its machine.
    machine: String,
    /// Of the machine's profile; none of a machine that is not there.
    profile: Option<String>,
    /// Of the dictionary, where the dialect is stated.
    dictionary: Option<String>,
    /// The version of ncc.
    ncc: String,
    /// Of the programs that it calls, by their names in its folder.
    called: BTreeMap<String, String>,
    /// Whether one that it calls was not there.
    is_absent: bool,
}

/// The end of a look for a program that waits for its facts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Next {
    /// The facts of one were computed.
    Done,
    /// None waits.
    Nothing,
    /// The process ends: the program waits for another one.
    Stopped,
}

/// Computes the facts of the program that waits longest. It is done under the limit of time of the compiler's work.
///
/// # Errors
/// The store. The program is claimed again after a while.
pub(crate) fn next(store: &Store, worker: &str, limit: Duration) -> Result<Next, Problem> {
    let Some(claimed) = store.claim_facts(worker, CLAIM)? else { return Ok(Next::Nothing) };
    let computed = compute(store, &claimed, limit);
    // The halt of this work alone was asked for when its time was over; this one is that of the process.
    if halt::under(None, halt::is_asked) {
        store.give_facts_back(worker, &claimed)?;
        return Ok(Next::Stopped);
    }
    if let Some(computed) = computed? {
        store.keep_facts(worker, &claimed, &computed)?;
    }
    Ok(Next::Done)
}

/// The machine of a program.
struct Machine {
    /// The text of its profile; none of one that comes with ncc.
    text: Option<String>,
    /// The digest of its profile.
    digest: String,
}

fn compute(store: &Store, claimed: &Claimed, limit: Duration) -> Result<Option<Computed>, Problem> {
    let of = match store.program(&claimed.program) {
        Ok(of) => of,
        // It was deleted meanwhile.
        Err(crate::store::StoreError::Absent) => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    let text = store.whole(&of.content)?;
    let machine = match of.details.machine.as_str() {
        "" => None,
        name => match profile(store, name) {
            Ok((text, digest)) => Some(Ok(Machine { text, digest })),
            Err(problem) if problem.is_request() => Some(Err(problem.detail().to_owned())),
            Err(problem) => return Err(problem),
        },
    };
    let there = machine.as_ref().and_then(|machine| machine.as_ref().ok());
    let dialects = shop::dialects(store)?;
    let stated = Some(of.details.dialect.as_str()).filter(|dialect| !dialect.is_empty());
    let own = there.and_then(|machine| machine.text.as_deref());
    let mut inputs = Inputs {
        program: of.content.sha256.clone(),
        dialect: of.details.dialect.clone(),
        machine: of.details.machine.clone(),
        profile: there.map(|machine| machine.digest.clone()),
        dictionary: dictionary(&dialects, stated, own),
        ncc: env!("CARGO_PKG_VERSION").to_owned(),
        called: BTreeMap::new(),
        is_absent: false,
    };
    let dialect = dialect_of(&of, &dialects, stated, there, &text);
    let words = Words::of(&text, dialect);
    let mut executed = match still_holding(store, &of, claimed, &mut inputs)? {
        Some(executed) => executed,
        None => match machine.transpose() {
            Err(no_machine) => refused(None, no_machine),
            Ok(_) if !claimed.may_run => refused(None, "ncc ended while it executed the program".to_owned()),
            Ok(machine) => execute(store, &of, (text, dialects), machine, &mut inputs, limit)?,
        },
    };
    executed.insert("dialect".to_owned(), json!(dialect.map(|dialect| &dialect.id)));
    executed.insert("codes".to_owned(), json!(words.codes));
    executed.insert("cycles".to_owned(), json!(words.cycles));
    executed.insert("lines".to_owned(), json!(words.lines));
    executed.insert("text_is_cut".to_owned(), json!(words.is_cut));
    let document = Value::Object(executed);
    let translations = store.translations(Some(&of.program), None, "", TRANSLATIONS)?;
    let is_stale = |own: &crate::store::Translation| Ok((own.id.clone(), stale(store, own)?));
    let stale = translations.iter().map(is_stale).collect::<Result<_, Problem>>()?;
    Ok(Some(Computed {
        inputs: serde_json::to_string(&inputs).unwrap_or_default(),
        document: document.to_string(),
        ms: document["seconds"].as_f64().map(|seconds| (seconds * 1e3).round() as i64),
        extents: extents(&document),
        terms: terms(&of, &document, &words, &inputs),
        stale,
    }))
}

/// Extents in µm.
fn extents(document: &Value) -> Option<[[i64; 2]; 3]> {
    let end = |axis: &str, at: usize| Some((document["extents"][axis][at].as_f64()? * 1e3).round() as i64);
    let both = |axis| Some([end(axis, 0)?, end(axis, 1)?]);
    Some([both("x")?, both("y")?, both("z")?])
}

/// The dialect that the program is executed in: the one that is stated, that of its machine, or the one that is recognised.
fn dialect_of(
    of: &Revision,
    dialects: &Dialects,
    stated: Option<&str>,
    machine: Option<&Machine>,
    text: &[u8],
) -> Option<&'static Dialect> {
    if let Some(dialect) = stated.and_then(|id| dialects.get(id)) {
        return Some(dialect);
    }
    let shipped = ncc_machines::find(&of.details.machine).map(|profile| profile.dialect);
    let own = || stated_dialect(dialects, None, Some(machine?.text.as_deref()?));
    let recognised = || {
        let all: Vec<_> = ncc_dialects::builtins().collect();
        let beginning = &text[..text.len().min(BEGINNING)];
        let mut source = Source::of(Cursor::new(beginning.to_vec()), &of.details.name);
        recognise(&mut source, &all).ok().map(|found| found.dialect)
    };
    shipped.or_else(own).or_else(recognised)
}

/// The facts that are there, if they were computed from the same.
fn still_holding(
    store: &Store,
    of: &Revision,
    claimed: &Claimed,
    inputs: &mut Inputs,
) -> Result<Option<Map<String, Value>>, Problem> {
    let Ok(before) = serde_json::from_str::<Inputs>(&claimed.inputs) else { return Ok(None) };
    let same = Inputs { called: before.called.clone(), ..inputs.clone() } == before;
    if !same || !calls_the_same(store, of, &before.called)? {
        return Ok(None);
    }
    inputs.called = before.called;
    Ok(serde_json::from_str(&claimed.document).ok())
}

/// Facts of a program that was not executed to its end.
fn refused(code: Option<&str>, reason: String) -> Map<String, Value> {
    Map::from_iter([
        ("refused".to_owned(), json!(true)),
        ("code".to_owned(), json!(code)),
        ("reason".to_owned(), json!(reason)),
    ])
}

/// Executes a program.
fn execute(
    store: &Store,
    of: &Revision,
    (text, dialects): (Vec<u8>, Dialects),
    machine: Option<Machine>,
    inputs: &mut Inputs,
    limit: Duration,
) -> Result<Map<String, Value>, Problem> {
    let mut engine = Engine::default();
    engine.know(dialects);
    let name = machine.map(|own| put_machine(&mut engine, &of.details.machine, own.text.as_deref()));
    engine.put(&of.details.name, text);
    let stated = Some(&of.details.dialect).filter(|dialect| !dialect.is_empty());
    let request = json!({
        "verb": "summary",
        "file": of.details.name,
        "from": stated,
        "machine": name,
        "findings": true,
    });
    let (code, folder) = match run_with_called(store, of, &mut engine, &request.to_string()) {
        Ok(done) => done,
        Err(problem) if problem.is_of_the_service() => return Err(problem),
        Err(problem) => return Ok(refused(None, problem.detail().to_owned())),
    };
    let called = compiler::json(&engine, "called");
    let called = called.as_array().into_iter().flatten().filter_map(Value::as_str);
    inputs.called = called.filter_map(|name| Some((name.to_owned(), folder.get(name)?.clone()))).collect();
    if halt::is_asked() {
        return Ok(refused(None, format!("it was stopped after {} s", limit.as_secs())));
    }
    if code == DONE {
        return Ok(done(&compiler::json(&engine, "document")["programs"][0]));
    }
    let messages = compiler::text(&engine, "messages");
    inputs.is_absent = messages.contains(NOT_THERE);
    let findings = compiler::json(&engine, "findings");
    let error = findings.as_array().into_iter().flatten().find(|finding| finding["severity"] == "error");
    Ok(match error {
        Some(error) => {
            refused(error["code"].as_str(), error["message"].as_str().unwrap_or_default().to_owned())
        }
        None => {
            let line = messages.lines().next().unwrap_or_default().trim();
            let code = code_in(line);
            let words = line.split_once(": ").map_or(line, |(_, words)| words);
            refused(code, words.to_owned())
        }
    })
}

/// The code of a message: `error[NC0103]: …`.
fn code_in(line: &str) -> Option<&str> {
    let (_, rest) = line.split_once('[')?;
    let (code, _) = rest.split_once(']')?;
    code.starts_with("NC").then_some(code)
}

/// Facts from the summary of a program that was executed.
fn done(timing: &Value) -> Map<String, Value> {
    let total = &timing["total"];
    let extents = total["extents"].as_array().filter(|all| all.len() == 3);
    let extents = extents.map(|all| json!({ "x": all[0], "y": all[1], "z": all[2] }));
    let lowest = extents.as_ref().and_then(|all| all["z"][0].as_f64());
    let tools = timing["tools"].as_array().into_iter().flatten();
    let tools: Vec<i64> = tools.filter_map(|tool| tool["tool"].as_i64()).collect();
    Map::from_iter([
        ("refused".to_owned(), json!(false)),
        // Without them a time would look surer than it is.
        ("assumed".to_owned(), timing["assumed"].clone()),
        ("seconds".to_owned(), total["time"].clone()),
        ("cutting_seconds".to_owned(), total["cutting"].clone()),
        ("holes".to_owned(), total["holes"].clone()),
        ("blocks".to_owned(), timing["blocks"].clone()),
        ("functions".to_owned(), timing["functions"].clone()),
        ("tools".to_owned(), json!(tools)),
        ("extents".to_owned(), json!(extents)),
        ("depth".to_owned(), json!(lowest.map(|lowest| (-lowest).max(0.0)))),
    ])
}

/// The terms of a program.
fn terms(of: &Revision, document: &Value, words: &Words, inputs: &Inputs) -> Vec<Term> {
    let mut all: BTreeMap<String, (i64, i64)> = BTreeMap::new();
    let nowhere = (0, -1);
    for (word, at) in &words.words {
        all.insert(format!("w {word}"), *at);
    }
    let details = &of.details;
    for text in [&details.name, &details.folder].into_iter().chain(&details.tags) {
        self::words(text, |word| {
            all.entry(format!("w {word}")).or_insert(nowhere);
        });
    }
    let mut put = |term: String| {
        all.insert(term, nowhere);
    };
    words.codes.iter().chain(&words.cycles).for_each(|code| put(format!("c {code}")));
    let tools = document["tools"].as_array().into_iter().flatten();
    tools.for_each(|tool| put(format!("t {tool}")));
    details.tags.iter().for_each(|tag| put(format!("g {tag}")));
    document["dialect"].as_str().into_iter().for_each(|dialect| put(format!("d {dialect}")));
    put(format!("m {}", details.machine));
    put(format!("r {}", if document["refused"] == true { "refused" } else { "executed" }));
    inputs.called.keys().for_each(|name| put(calls(name)));
    if inputs.is_absent {
        put(CALLS_ABSENT.to_owned());
    }
    all.into_iter().map(|(text, (line, place))| Term { text, line, place }).collect()
}
