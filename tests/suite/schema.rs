//! The JSON Schema that ships with the case study's document, held against what is written.
//!
//! A small judge of its own: it knows the keywords that the schema uses, and refuses the schema if
//! it meets another one, so that nothing goes unchecked.

use std::fs;

use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::Failures;
use serde_json::{Map, Value, json};

use crate::time::time;

/// Keywords that say nothing about a value.
const SILENT: [&str; 6] = ["$schema", "$id", "$defs", "title", "description", "$comment"];

/// What is wrong with a value, each with its place.
fn check(schema: &Value, root: &Value, value: &Value, at: &str, wrong: &mut Vec<String>) {
    let rules = schema.as_object().unwrap_or_else(|| panic!("{at}: the schema is no object: {schema}"));
    let empty = Map::new();
    let object = value.as_object();
    for (keyword, rule) in rules {
        match keyword.as_str() {
            silent if SILENT.contains(&silent) => {}
            "$ref" => {
                let path = rule.as_str().and_then(|r| r.strip_prefix('#')).expect("a place in the schema");
                let target = root.pointer(path).unwrap_or_else(|| panic!("{path} is not in the schema"));
                check(target, root, value, at, wrong);
            }
            "type" => {
                let names: Vec<&str> = match rule {
                    Value::Array(names) => names.iter().filter_map(Value::as_str).collect(),
                    one => one.as_str().into_iter().collect(),
                };
                if !names.iter().any(|name| is(name, value)) {
                    wrong.push(format!("{at}: {value} is no {}", names.join(" or ")));
                }
            }
            "enum" => {
                if !rule.as_array().expect("a list").contains(value) {
                    wrong.push(format!("{at}: {value} is none of the names"));
                }
            }
            "minimum" => {
                if value.as_f64().is_some_and(|v| v < rule.as_f64().expect("a number")) {
                    wrong.push(format!("{at}: {value} is too small"));
                }
            }
            "required" => {
                for name in rule.as_array().expect("a list").iter().filter_map(Value::as_str) {
                    if object.is_some_and(|o| !o.contains_key(name)) {
                        wrong.push(format!("{at}: no {name}"));
                    }
                }
            }
            "dependentRequired" => {
                for (name, others) in rule.as_object().expect("an object") {
                    let all = others.as_array().expect("a list").iter().filter_map(Value::as_str);
                    let missing = |o: &Map<String, Value>| all.clone().any(|other| !o.contains_key(other));
                    if object.is_some_and(|o| o.contains_key(name) && missing(o)) {
                        wrong.push(format!("{at}: {name} without the others"));
                    }
                }
            }
            "properties" => {
                for (name, part) in object.unwrap_or(&empty) {
                    if let Some(rule) = rule.get(name) {
                        check(rule, root, part, &format!("{at}/{name}"), wrong);
                    }
                }
            }
            "additionalProperties" => {
                let known = rules.get("properties").and_then(Value::as_object).unwrap_or(&empty);
                for (name, part) in object.unwrap_or(&empty).iter().filter(|(n, _)| !known.contains_key(*n)) {
                    match rule {
                        Value::Bool(true) => {}
                        Value::Bool(false) => wrong.push(format!("{at}: {name} is not in the schema")),
                        rule => check(rule, root, part, &format!("{at}/{name}"), wrong),
                    }
                }
            }
            "minItems" | "maxItems" => {
                let limit = rule.as_u64().expect("a number") as usize;
                let count = value.as_array().map_or(limit, Vec::len);
                if (keyword == "minItems" && count < limit) || (keyword == "maxItems" && count > limit) {
                    wrong.push(format!("{at}: {count} entries"));
                }
            }
            "items" => {
                for (i, item) in value.as_array().into_iter().flatten().enumerate() {
                    check(rule, root, item, &format!("{at}/{i}"), wrong);
                }
            }
            other => panic!("the schema uses `{other}`, which this test does not know"),
        }
    }
}

fn is(name: &str, value: &Value) -> bool {
    match name {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        other => panic!("the schema uses the type `{other}`"),
    }
}

/// What is wrong with a document by a schema.
pub(crate) fn faults_by(schema: &Value, value: &Value) -> Vec<String> {
    let mut wrong = Vec::new();
    check(schema, schema, value, "", &mut wrong);
    wrong
}

fn schema() -> Value {
    serde_json::from_str(ncc::time::SCHEMA).expect("the schema is JSON")
}

/// What is wrong with a document by a schema.
pub(crate) fn faults_of(schema: &str, value: &Value) -> Vec<String> {
    let root: Value = serde_json::from_str(schema).expect("the schema is JSON");
    let mut wrong = Vec::new();
    check(&root, &root, value, "", &mut wrong);
    wrong
}

fn faults(part: &str, value: &Value) -> Vec<String> {
    let root = schema();
    let mut wrong = Vec::new();
    let schema = root.pointer(part).expect("a part of the schema");
    check(schema, &root, value, "", &mut wrong);
    wrong
}

/// Every program of the corpus, in both stages and all forms.
#[test]
fn every_document_is_as_the_schema_says() {
    let mut failures = Failures::default();
    let mut documents = 0;
    for dialect in DIALECTS {
        for program in corpus::of(dialect) {
            let path = corpus::root().join("corpus").join(dialect).join(&program.file);
            for stage in ["before", "after"] {
                let arguments = ["--from", dialect, "--machine", "sinumerik-vmc", "--stage", stage, "--as"];
                let what = format!("{dialect}/{} {stage}", program.file);
                let Ok(text) = time(&[&arguments[..], &["payload"]].concat(), &[&path]) else { continue };
                let Ok(lines) = time(&[&arguments[..], &["ndjson"]].concat(), &[&path]) else { continue };
                let printed =
                    time(&[&arguments[..], &["payload-printed"]].concat(), &[&path]).expect("it is timed");
                let printed: Value = serde_json::from_slice(&printed).expect("JSON");
                let document: Value = match serde_json::from_slice(&text) {
                    Ok(document) => document,
                    Err(fault) => {
                        failures.add(&what, fault);
                        continue;
                    }
                };
                let mut wrong = faults("", &document);
                let lines: Vec<Value> = String::from_utf8_lossy(&lines)
                    .lines()
                    .map(|l| serde_json::from_str(l).expect("JSON"))
                    .collect();
                wrong.extend(faults("/$defs/header", &lines[0]));
                if document["blocks"].as_array().map(Vec::as_slice) != Some(&lines[1..]) {
                    wrong.push("the lines are not the document's blocks".to_owned());
                }
                wrong.extend(faults("", &printed));
                let blocks = |document: &Value| document["blocks"].as_array().map(Vec::len);
                if blocks(&document) != blocks(&printed) {
                    wrong.push("the printed form has other blocks".to_owned());
                }
                wrong.truncate(3);
                if !wrong.is_empty() {
                    failures.add(&what, wrong.join("\n"));
                }
                documents += 1;
            }
        }
    }
    assert!(documents > 250, "{documents}");
    failures.finish();
}

/// The judge sees what is wrong.
#[test]
fn wrong_documents_are_seen() {
    let path = corpus::root().join("tests/time/teste-before.json");
    let good: Value = serde_json::from_slice(&fs::read(path).expect("a document")).expect("JSON");
    assert_eq!(faults("", &good), [""; 0]);
    let wrong: [(&str, Value); 9] = [
        ("/blocks/0/time", json!(-1.0)),
        ("/blocks/0/time", json!("1")),
        ("/blocks/0/tool", json!(1.5)),
        ("/blocks/0/function_name", json!("MOVE")),
        ("/blocks/0/cut_offset", json!(-1)),
        ("/blocks/0/parameters", json!({ "z": [1] })),
        ("/blocks/0/parameters", json!([{}, {}])),
        ("/machine_name", json!(null)),
        ("/blocks", json!({})),
    ];
    for (place, value) in wrong {
        let mut document = good.clone();
        *document.pointer_mut(place).expect("a place") = value;
        assert_ne!(faults("", &document), [""; 0], "{place}");
    }
    let mut document = good.clone();
    document["blocks"][0]["a0"] = json!(0.0);
    document["blocks"][0].as_object_mut().expect("a block").remove("dx");
    document["more"] = json!(1);
    assert_eq!(faults("", &document).len(), 3);
}

/// The documents that stand with the tests of batches, which hold them against what is printed.
#[test]
fn documents_of_batches_are_as_their_schema_says() {
    let folder = corpus::root().join("cli/tests/expected/batch");
    let mut seen = 0;
    for path in corpus::files(&folder) {
        let text = fs::read_to_string(&path).expect("a text");
        if !path.to_string_lossy().ends_with("-json.txt") {
            continue;
        }
        let document = text.split_once("--- stdout\n").and_then(|(_, rest)| rest.split_once("--- stderr\n"));
        let document: Value = serde_json::from_str(document.expect("a document").0).expect("JSON");
        assert_eq!(faults_of(ncc::batch::SCHEMA, &document), [""; 0], "{}", path.display());
        for (place, wrong) in
            [("/version", json!(2)), ("/files/0/result", json!("fine")), ("/exit", json!(-1))]
        {
            let mut document = document.clone();
            *document.pointer_mut(place).expect("it is there") = wrong;
            assert_ne!(faults_of(ncc::batch::SCHEMA, &document), [""; 0], "{place}");
        }
        seen += 1;
    }
    assert!(seen >= 2, "{seen}");
}
