//! `ncc check`: cases of every rule, the examples of their pages, the labelled reports of real programs,
//! and the forms of JSON and SARIF.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Parser;
use codespan_reporting::term::termcolor::NoColor;
use ncc::args::typed::Color;
use ncc::args::{Cli, Verb};
use ncc::registry::DialectRegistry;
use ncc_driver::problem::Exit;
use ncc_tests::corpus::{self, DIALECTS, files};
use ncc_tests::expect::{self, Failures};
use serde_json::Value;

use crate::schema;
use crate::shared::beside;

/// Most of a hundred reports of real programs that may be false.
const MOST_FALSE: usize = 5;

/// Runs `ncc check`; what it wrote, or the exit code of a problem.
fn check(arguments: &[String], files: &[&Path]) -> Result<(Exit, Vec<u8>), Exit> {
    let folder = tempfile::tempdir().expect("a folder");
    let output = folder.path().join("output");
    let mut all: Vec<OsString> = ["ncc", "check", "-o"].map(OsString::from).into();
    all.push(output.clone().into());
    all.extend(arguments.iter().map(OsString::from));
    all.extend(files.iter().map(|path| path.as_os_str().to_owned()));
    let cli = Cli::try_parse_from(&all).unwrap_or_else(|e| panic!("{all:?}: {e}"));
    let Verb::Check(asked) = cli.verb else { panic!("another verb") };
    let mut told = NoColor::new(Vec::new());
    match ncc::check::run(&asked, &DialectRegistry::built_in(), Color::Never, &mut told) {
        Ok(exit) => Ok((exit, fs::read(&output).expect("an output"))),
        Err(problem) => Err(problem.exit),
    }
}

/// The same of a text, in which the file is called `part`.
fn check_text(options: &str, text: &str, form: &str) -> (Exit, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("part");
    fs::write(&path, text).expect("a file");
    let root = corpus::root();
    let mut arguments: Vec<String> = vec!["--format".into(), form.into()];
    arguments.extend(options.split_whitespace().map(|word| match word.starts_with("tests/") {
        true => root.join(word).display().to_string(),
        false => word.to_owned(),
    }));
    let (exit, out) = check(&arguments, &[&path]).unwrap_or_else(|e| panic!("{options}: {e:?}"));
    let shown = path.display().to_string();
    (exit, String::from_utf8(out).expect("UTF-8").replace(&shown, "part"))
}

fn document(arguments: &[&str], path: &Path) -> Value {
    let mut all = vec!["--format".to_owned(), "json".to_owned()];
    all.extend(arguments.iter().map(|a| (*a).to_owned()));
    let (_, out) = check(&all, &[path]).unwrap_or_else(|e| panic!("{}: {e:?}", path.display()));
    serde_json::from_slice(&out).expect("JSON")
}

/// Ids that a text gives.
fn ids(options: &str, text: &str) -> BTreeSet<String> {
    let (_, out) = check_text(options, text, "json");
    let document: Value = serde_json::from_str(&out).expect("JSON");
    let findings = document["programs"][0]["findings"].as_array().expect("a list").clone();
    findings.iter().filter_map(|f| f["id"].as_str().map(str::to_owned)).collect()
}

fn is_rule(id: &str) -> bool {
    id.starts_with("NC08")
}

/// Every file of cases: after each program, what is told of it. Under `## Bad` it has the finding that
/// the file is named by, under `## Good` it has not.
#[test]
fn every_case_tells_what_it_should() {
    let mut failures = Failures::default();
    let mut ruled: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for path in files(&corpus::root().join("tests/check/cases")) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let id = name.split('-').next().unwrap_or_default().to_owned();
        let text = fs::read_to_string(&path).expect("a file of cases");
        let (mut written, mut heading, mut lines) = (String::new(), String::new(), text.lines());
        while let Some(line) = lines.next() {
            written.push_str(line);
            written.push('\n');
            if let Some(title) = line.strip_prefix("## ") {
                heading = title.to_owned();
            }
            let Some(info) = line.strip_prefix("```").filter(|info| !info.is_empty()) else { continue };
            let body: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
            let body = body.join("\n");
            if info == "text" {
                // Written anew after its program.
                written.truncate(written.len() - "```text\n".len());
                continue;
            }
            let program = format!("{body}\n");
            let options = format!("--from {info}");
            let (exit, told) = check_text(&options, &program, "text");
            let has = ids(&options, &program).contains(&id);
            if has != heading.starts_with("Bad") {
                failures.add(&name, format!("{heading}: {info}\n{told}"));
            }
            let findings = told.contains("error") || told.contains("warning");
            if (exit == Exit::Done) == findings {
                failures.add(&name, format!("{heading}: exit {exit:?}\n{told}"));
            }
            let dialect = info.split(' ').next().unwrap_or_default().to_owned();
            ruled.entry(format!("{id} {}", &heading[..3.min(heading.len())])).or_default().insert(dialect);
            written.push_str(&format!("{program}```\n```text\n{told}```\n"));
        }
        failures.check(&name, expect::file(&path, written.as_bytes()));
    }
    for code in ncc_check::Rule::CODES {
        for kind in ["Bad", "Goo"] {
            let dialects = ruled.get(&format!("NC{code:04} {kind}")).map_or(0, BTreeSet::len);
            if dialects == 0 {
                failures.add(format!("NC{code:04}"), format!("no case: {kind}"));
            }
        }
    }
    failures.finish();
}

/// The example of each rule's page gives its finding.
#[test]
fn the_example_of_every_page_is_found() {
    let mut failures = Failures::default();
    for code in ncc_check::Rule::CODES {
        let id = format!("NC{code:04}");
        let page = ncc_driver::render::explain::page(&id).unwrap_or_else(|| panic!("{id} has no page"));
        let mut lines = page.lines().skip_while(|line| !line.starts_with("    ncc check "));
        let call = lines.next().unwrap_or_else(|| panic!("{id}: no call in its example"));
        let options: Vec<&str> =
            call.split_whitespace().filter(|w| !["ncc", "check", "part.nc"].contains(w)).collect();
        let program: Vec<&str> =
            lines.skip(1).take_while(|line| line.starts_with("    ")).map(|line| &line[4..]).collect();
        let program = format!("{}\n", program.join("\n"));
        if !ids(&options.join(" "), &program).contains(&id) {
            failures.add(&id, check_text(&options.join(" "), &program, "text").1);
        }
    }
    failures.finish();
}

/// A report of a rule, and whether it is true.
#[derive(Debug)]
struct Label {
    is_false: bool,
}

fn labels() -> BTreeMap<(String, u64, String), Label> {
    let text = fs::read_to_string(corpus::root().join("tests/check/labels.tsv")).expect("the labels");
    let rows = text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    rows.map(|row| {
        let cells: Vec<&str> = row.split('\t').collect();
        let [path, line, rule, verdict, reason] = cells[..] else { panic!("five cells: {row}") };
        assert!(["true", "false"].contains(&verdict) && reason.len() > 10, "{row}");
        let line: u64 = line.parse().unwrap_or_else(|_| panic!("a line: {row}"));
        ((path.to_owned(), line, rule.to_owned()), Label { is_false: verdict == "false" })
    })
    .collect()
}

/// Reports of programs under a folder.
fn reports(folder: &Path, prefix: &str, dialect: &str) -> BTreeSet<(String, u64, String)> {
    let mut found = BTreeSet::new();
    for path in files(folder) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let document = document(&["--from", dialect], &path);
        for finding in document["programs"][0]["findings"].as_array().expect("a list") {
            let id = finding["id"].as_str().expect("an id");
            if is_rule(id) {
                let line = finding["place"]["line"].as_u64().expect("a line");
                found.insert((format!("{prefix}/{dialect}/{name}"), line, id.to_owned()));
            }
        }
    }
    found
}

/// Every report of a rule on the corpus and on programs that nobody here wrote is labelled, and few of
/// them are false.
#[test]
fn every_report_of_real_programs_is_labelled_and_few_are_false() {
    let labels = labels();
    let mut found = BTreeSet::new();
    for dialect in DIALECTS {
        found.extend(reports(&corpus::root().join("corpus").join(dialect), "corpus", dialect));
    }
    let mut with_shared = true;
    for dialect in ["fanuc", "siemens"] {
        match beside(&format!("programs/{dialect}")) {
            Some(folder) => found.extend(reports(&folder, "programs", dialect)),
            None => with_shared = false,
        }
    }
    let missing: Vec<_> = found.iter().filter(|report| !labels.contains_key(*report)).collect();
    assert!(missing.is_empty(), "reports without a label: {missing:#?}");
    let gone: Vec<_> = labels
        .keys()
        .filter(|(path, ..)| with_shared || path.starts_with("corpus/"))
        .filter(|report| !found.contains(*report))
        .collect();
    assert!(gone.is_empty(), "labels without a report: {gone:#?}");
    for prefix in ["programs/", "corpus/", ""] {
        let of: Vec<&Label> =
            labels.iter().filter(|((path, ..), _)| path.starts_with(prefix)).map(|(_, l)| l).collect();
        let wrong = of.iter().filter(|label| label.is_false).count();
        println!("{prefix}: {} reports, {wrong} false", of.len());
        assert!(wrong * 100 < of.len() * MOST_FALSE, "{prefix}: {wrong} of {} are false", of.len());
    }
}

/// Every document is as its schema says, in JSON and in SARIF.
#[test]
fn documents_are_as_their_schemas_say() {
    let own: Value = serde_json::from_str(ncc::check::SCHEMA).expect("JSON");
    let sarif = fs::read_to_string(corpus::root().join("tests/check/sarif.schema.json")).expect("a schema");
    let sarif: Value = serde_json::from_str(&sarif).expect("JSON");
    let mut failures = Failures::default();
    let mut results = 0;
    for dialect in DIALECTS {
        for program in corpus::of(dialect) {
            let path: PathBuf = corpus::root().join("corpus").join(dialect).join(&program.file);
            for (form, schema) in [("json", &own), ("sarif", &sarif)] {
                let arguments =
                    ["--from", dialect, "--machine", "fanuc-vmc", "--format", form].map(str::to_owned);
                let (_, out) = check(&arguments, &[&path]).expect("a document");
                let document: Value = serde_json::from_slice(&out).expect("JSON");
                let wrong = schema::faults_by(schema, &document);
                if !wrong.is_empty() {
                    failures.add(format!("{dialect}/{} {form}", program.file), wrong.join("\n"));
                }
                if form == "sarif" {
                    results += places(&document, &program.text, &mut failures);
                }
            }
        }
    }
    assert!(results > 10, "{results}");
    failures.finish();
}

/// Whether the bytes of each region are where its line and column are; how many there were.
fn places(log: &Value, text: &[u8], failures: &mut Failures) -> usize {
    let run = &log["runs"][0];
    let rules = run["tool"]["driver"]["rules"].as_array().expect("rules");
    let results = run["results"].as_array().expect("results");
    for result in results {
        let index = result["ruleIndex"].as_u64().expect("an index") as usize;
        if rules[index]["id"] != result["ruleId"] {
            failures.add("ruleIndex", result);
        }
        let region = &result["locations"][0]["physicalLocation"]["region"];
        let number = |name: &str| region[name].as_u64().expect("a number") as usize;
        let before = &text[..number("byteOffset")];
        let line = before.iter().filter(|b| **b == b'\n').count() + 1;
        let start = before.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1);
        let column = match std::str::from_utf8(&before[start..]) {
            Ok(text) => text.chars().count() + 1,
            Err(_) => before.len() - start + 1,
        };
        if (line, column) != (number("startLine"), number("startColumn")) {
            failures.add("region", format!("{region} is at {line}:{column}"));
        }
    }
    results.len()
}

/// The judge sees what is wrong with a log.
#[test]
fn wrong_logs_are_seen() {
    let sarif = fs::read_to_string(corpus::root().join("tests/check/sarif.schema.json")).expect("a schema");
    let sarif: Value = serde_json::from_str(&sarif).expect("JSON");
    let text = "%\nO1\nG21 G17 G90 G94 G54\nG1 X1.\nM30\n%\n";
    let good: Value = serde_json::from_str(&check_text("--from fanuc", text, "sarif").1).expect("JSON");
    assert_eq!(schema::faults_by(&sarif, &good), [""; 0]);
    let wrong: [(&str, Value); 5] = [
        ("/version", "2.0.0".into()),
        ("/runs/0/results/0/level", "bad".into()),
        ("/runs/0/results/0/message", "text".into()),
        ("/runs/0/results/0/locations/0/physicalLocation/region/startLine", 0.into()),
        ("/runs/0/tool/driver/name", Value::Null),
    ];
    for (place, value) in wrong {
        let mut document = good.clone();
        *document.pointer_mut(place).unwrap_or_else(|| panic!("{place}: {good}")) = value;
        assert_ne!(schema::faults_by(&sarif, &document), [""; 0], "{place}");
    }
}

/// Rules by id: allowed ones are counted, denied ones are errors.
/// Of a thousand findings of a rule each has its place; the others are counted.
#[test]
fn findings_beyond_the_most_are_counted() {
    let lines: String = (0..1200).map(|n| format!("X{}\n", 10 + n % 2)).collect();
    let text = format!("%\nO1\nG21 G17 G90 G94 G54\nG0 X1.5\n{lines}M30\n%\n");
    let (_, out) = check_text("--from fanuc", &text, "json");
    let document: Value = serde_json::from_str(&out).expect("JSON");
    let program = &document["programs"][0];
    let findings = program["findings"].as_array().expect("a list");
    assert_eq!(findings.iter().filter(|f| f["id"] == "NC0808").count(), 1000);
    let counted: u64 = ["errors", "warnings", "notes"].iter().filter_map(|k| program[k].as_u64()).sum();
    assert_eq!(counted, findings.len() as u64 + 200, "{counted}");
}

#[test]
fn rules_are_allowed_and_denied_by_id() {
    let text = "%\nO1\nG21 G17 G90 G94 G54\nS100 M3\nG0 X1.\nM30\n%\n";
    assert_eq!(check_text("--from fanuc", text, "json").0, Exit::Done);
    assert_eq!(check_text("--from fanuc --deny NC0810", text, "json").0, Exit::Refused);
    let (exit, told) = check_text("--from fanuc --allow nc0810", text, "text");
    assert!(exit == Exit::Done && told.contains("nothing found, 1 allowed"), "{told}");
    assert!(Cli::try_parse_from(["ncc", "check", "--allow", "NC9999", "a"]).is_err());
}
