//! The JSON Schemas of the files that users write: dictionaries, machine profiles, `ncc.toml`. An editor completes and
//! checks these files with them.
//!
//! ```text
//! #:schema ../driver/schema/profile.schema.json      the first line of a profile, for Taplo
//! ```
//!
//! The schemas are made from what reads the files: from the types of `ncc-dialects` with their doc comments, and from the
//! tables of `ncc-machines`. `UPDATE_EXPECT=1` writes them anew. All shipped files are held against them, and so are the
//! keys that the readers themselves name.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;

use ncc_driver::machines::words::takes_words;
use ncc_machines::project;
use ncc_machines::schema::{
    AxisRow, EdgeRow, Emit, MCodeRow, PowerOn, ProgramRow, Rates, Spindle, Times, ToolRow, ValueRow,
    WorkOffsetRow,
};
use ncc_machines::table::{Key, Table};
use ncc_tests::corpus;
use ncc_tests::expect::{self, Failures};
use serde_json::{Map, Value, json};

use crate::schema::faults_by;

/// The draft that the schemas are written in.
const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

/// A type of the dictionary's reader.
enum Type {
    /// Fields: name, type, doc comment.
    Struct(Vec<(String, String, String)>),
    /// Names in a data file.
    Enum(Vec<String>),
}

/// The name of a variant in a data file.
fn kebab(name: &str) -> String {
    let mut out = String::new();
    for (at, c) in name.char_indices() {
        if c.is_ascii_uppercase() && at > 0 {
            out.push('-');
        }
        out.push(c.to_ascii_lowercase());
    }
    out
}

/// The text between a brace and the one that closes it.
fn body(text: &str) -> &str {
    let mut depth = 1;
    for (at, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return &text[..at];
        }
    }
    text
}

/// Types that a data file is read into, by their names.
fn types() -> BTreeMap<String, Type> {
    let mut all = BTreeMap::new();
    let folder = corpus::root().join("ir/dialects/src");
    for entry in fs::read_dir(folder).expect("the reader's sources").map(|entry| entry.expect("an entry")) {
        if entry.path().is_dir() {
            continue;
        }
        let text = fs::read_to_string(entry.path()).expect("a source file");
        for (at, _) in text.match_indices("pub struct ") {
            let Some((head, rest)) = text[at + 11..].split_once(" {\n") else { continue };
            let name = head.split('<').next().unwrap_or(head);
            if name.contains(';') || name.contains('(') {
                continue;
            }
            all.insert(name.to_owned(), Type::Struct(fields(body(rest))));
        }
        for (at, _) in text.match_indices("pub enum ") {
            let before = text[..at].rsplit("\n\n").next().unwrap_or("");
            let Some((name, rest)) = text[at + 9..].split_once(" {\n") else { continue };
            let Some((_, rule)) = before.split_once("rename_all = \"") else { continue };
            let lower = rule.starts_with("lowercase");
            let names = body(rest).lines().map(str::trim).filter_map(|line| line.strip_suffix(','));
            let names: Vec<&str> = names.collect();
            if names.iter().all(|name| name.chars().all(|c| c.is_ascii_alphanumeric())) {
                let spelt = |name: &&str| if lower { name.to_lowercase() } else { kebab(name) };
                all.insert(name.to_owned(), Type::Enum(names.iter().map(spelt).collect()));
            }
        }
        // `UnitsName => Units { Mm, Inch }` of the macro that makes such enums.
        for line in text.lines().map(str::trim) {
            let Some((name, rest)) = line.split_once(" => ") else { continue };
            let Some((_, variants)) = rest.split_once(" { ") else { continue };
            if name.ends_with("Name")
                && let Some(variants) = variants.strip_suffix(" }")
            {
                all.insert(name.to_owned(), Type::Enum(variants.split(", ").map(kebab).collect()));
            }
        }
    }
    all
}

/// The fields of a struct that a data file may have.
fn fields(body: &str) -> Vec<(String, String, String)> {
    let (mut all, mut doc, mut skipped) = (Vec::new(), String::new(), false);
    for line in body.lines().map(str::trim) {
        if let Some(words) = line.strip_prefix("/// ") {
            doc += if doc.is_empty() { "" } else { " " };
            doc += words;
        } else if line.starts_with("#[serde(skip)]") {
            skipped = true;
        } else if let Some((name, kind)) = line.strip_prefix("pub ").and_then(|line| line.split_once(": ")) {
            let doc = std::mem::take(&mut doc);
            if !std::mem::take(&mut skipped) {
                all.push((name.to_owned(), kind.trim_end_matches(',').to_owned(), doc));
            }
        }
    }
    all
}

/// The schema of a Rust type.
fn of_type(kind: &str, types: &BTreeMap<String, Type>) -> Value {
    let inside = |outer: &str| kind.strip_prefix(outer).and_then(|rest| rest.strip_suffix('>'));
    if let Some(inner) = inside("Option<") {
        return of_type(inner, types);
    }
    if let Some(inner) = inside("Vec<") {
        return json!({ "type": "array", "items": of_type(inner, types) });
    }
    if let Some(inner) = inside("BTreeMap<") {
        let value = inner.split_once(", ").map_or("String", |(_, value)| value);
        let value = of_type(value, types);
        return json!({ "type": "object", "properties": merging(), "additionalProperties": value });
    }
    if let Some(inner) = kind.strip_prefix('[').and_then(|rest| rest.split_once("; ")).map(|(inner, _)| inner)
    {
        return json!({ "type": "array", "items": of_type(inner, types) });
    }
    if let Some(inner) = inside("PowerOnFact<") {
        let Some(Type::Struct(fields)) = types.get("PowerOnFact") else { panic!("no PowerOnFact") };
        let fields: Vec<_> = fields
            .iter()
            .map(|(name, kind, doc)| {
                let kind = if kind == "T" { inner } else { kind };
                (name.clone(), kind.to_owned(), doc.clone())
            })
            .collect();
        return of_struct(&fields, types);
    }
    match kind {
        "bool" => json!({ "type": "boolean" }),
        "f64" => json!({ "type": "number" }),
        "u8" | "u16" | "u32" | "usize" => json!({ "type": "integer", "minimum": 0 }),
        "i64" => json!({ "type": "integer" }),
        // Its form depends on its kind.
        "PatternRow" => json!({ "type": "object" }),
        named => match types.get(named) {
            Some(Type::Struct(_)) => json!({ "$ref": format!("#/$defs/{named}") }),
            Some(Type::Enum(names)) => json!({ "enum": names }),
            // Text that is read further: a meaning, a letter.
            None => json!({ "type": "string" }),
        },
    }
}

/// The words by which a table or row takes its base's away, or replaces it whole.
fn merging() -> Map<String, Value> {
    let words = [
        ("remove", "With `base`: takes the base's row or table away."),
        ("replace", "With `base`: replaces the base's row or table as a whole."),
    ];
    let rules = |doc| json!({ "type": "boolean", "description": doc });
    words.into_iter().map(|(word, doc)| (word.to_owned(), rules(doc))).collect()
}

/// The schema of a table. Each may take a row of its base away, or stand in its place whole.
fn of_struct(fields: &[(String, String, String)], types: &BTreeMap<String, Type>) -> Value {
    let mut properties = Map::new();
    for (name, kind, doc) in fields {
        let mut value = of_type(kind, types);
        if let (Some(rules), false) = (value.as_object_mut(), doc.is_empty()) {
            rules.insert("description".to_owned(), json!(doc));
        }
        properties.insert(name.clone(), value);
    }
    for (word, rules) in merging() {
        properties.entry(word).or_insert(rules);
    }
    json!({ "type": "object", "properties": properties, "additionalProperties": false })
}

/// The structs that a dictionary has, from its own down.
fn dialect_schema() -> Value {
    let types = types();
    let Some(Type::Struct(fields)) = types.get("Dialect") else { panic!("no Dialect") };
    let mut schema = of_struct(fields, &types);
    let mut definitions = Map::new();
    let mut open = vec![schema.clone()];
    while let Some(part) = open.pop() {
        let text = part.to_string();
        for (at, start) in text.match_indices("#/$defs/") {
            let name: String =
                text[at + start.len()..].chars().take_while(char::is_ascii_alphanumeric).collect();
            if let (false, Some(Type::Struct(fields))) = (definitions.contains_key(&name), types.get(&name)) {
                let made = of_struct(fields, &types);
                open.push(made.clone());
                definitions.insert(name, made);
            }
        }
    }
    let rules = schema.as_object_mut().expect("a table");
    rules.insert("$schema".to_owned(), json!(DRAFT));
    rules.insert("title".to_owned(), json!("A dictionary of ncc: the words of a control, and their meaning"));
    rules.insert("$defs".to_owned(), Value::Object(definitions));
    rules.insert("required".to_owned(), json!(["id"]));
    schema
}

/// The schema of a table with a fixed set of keys. A fact is a value, or a table with its source.
fn of_keys(keys: &[Key]) -> Value {
    let fact = |key: &Key| {
        let about = format!("{} Takes {}.", key.about, takes_words(key.takes));
        json!({
            "type": ["string", "number", "boolean", "array", "object"],
            "description": about,
            "properties": {
                "value": {},
                "source": { "type": "string", "description": "Who says so." },
                "assumed": { "type": "boolean", "description": "Whether it is assumed." },
            },
            "additionalProperties": false,
        })
    };
    let properties: Map<String, Value> = keys.iter().map(|key| (key.name.to_owned(), fact(key))).collect();
    json!({ "type": "object", "properties": properties, "additionalProperties": false })
}

/// The tables of a profile: the name of each, and its schema.
fn profile_tables() -> Map<String, Value> {
    fn table<T: Table>(all: &mut Map<String, Value>) {
        let (name, rows) = (T::HEAD.trim_matches(['[', ']']), T::HEAD.starts_with("[["));
        let keys = of_keys(T::KEYS);
        let value = match rows {
            true => json!({ "type": "array", "items": keys, "description": T::ABOUT }),
            false => {
                let mut keys = keys;
                keys.as_object_mut().expect("a table").insert("description".to_owned(), json!(T::ABOUT));
                keys
            }
        };
        all.insert(name.to_owned(), value);
    }
    let mut all = Map::new();
    table::<PowerOn>(&mut all);
    table::<Rates>(&mut all);
    table::<Times>(&mut all);
    table::<Spindle>(&mut all);
    table::<AxisRow>(&mut all);
    table::<ToolRow>(&mut all);
    table::<EdgeRow>(&mut all);
    table::<WorkOffsetRow>(&mut all);
    table::<ProgramRow>(&mut all);
    table::<MCodeRow>(&mut all);
    table::<ValueRow>(&mut all);
    table::<Emit>(&mut all);
    all
}

fn profile_properties() -> Map<String, Value> {
    let mut all = profile_tables();
    let text = |doc: &str| json!({ "type": "string", "description": doc });
    let fact = |doc: &str| json!({ "type": "object", "description": doc });
    all.insert("id".to_owned(), text("The name on the command line."));
    all.insert("title".to_owned(), text("What it is, for people."));
    all.insert("dialect".to_owned(), text("The dialect of the control."));
    let typical = "Whether it stands for a kind of machine, not for one that somebody has measured.";
    all.insert("typical".to_owned(), json!({ "type": "boolean", "description": typical }));
    all.insert("notes".to_owned(), text("Anything else that a reader should know."));
    all.insert("sources".to_owned(), fact("Sources that facts name by a short tag."));
    all.insert("options".to_owned(), fact("Options of the dialect's dictionary: see `ncc dialects show`."));
    all.insert("confirmed".to_owned(), fact("Rows of the dictionary: whether it is so on this machine."));
    all
}

fn profile_schema() -> Value {
    json!({
        "$schema": DRAFT,
        "title": "A machine profile of ncc",
        "type": "object",
        "properties": profile_properties(),
        "additionalProperties": false,
        "required": ["dialect"],
    })
}

fn project_schema() -> Value {
    let mut row = Map::new();
    for key in project::KEYS {
        let about = format!("{} Takes {}.", key.about, takes_words(key.takes));
        let value = match key.name {
            "machine" | "to" => json!({
                "type": ["string", "object"],
                "description": about,
                "$ref": "#/$defs/profile",
            }),
            "output" => json!({ "type": "string", "description": about }),
            _ => json!({ "type": ["string", "array"], "items": { "type": "string" }, "description": about }),
        };
        row.insert(key.name.to_owned(), value);
    }
    json!({
        "$schema": DRAFT,
        "title": "A project file of ncc, `ncc.toml`",
        "type": "object",
        "$defs": { "profile": { "properties": profile_properties(), "additionalProperties": false } },
        "properties": {
            "programs": {
                "type": "array",
                "description": "Programs of this folder, and their machines.",
                "items": { "type": "object", "properties": row, "additionalProperties": false, "required": ["files"] },
            },
        },
        "additionalProperties": false,
        "required": ["programs"],
    })
}

#[test]
fn are_as_the_readers_have_it() {
    let folder = corpus::root().join("driver/schema");
    let mut failures = Failures::default();
    for (name, schema) in
        [("dialect", dialect_schema()), ("profile", profile_schema()), ("project", project_schema())]
    {
        let text = serde_json::to_string_pretty(&schema).expect("JSON") + "\n";
        if let Err(differs) = expect::file(&folder.join(format!("{name}.schema.json")), text.as_bytes()) {
            failures.add(name, differs);
        }
    }
    failures.finish();
}

#[test]
fn shipped_files_are_as_their_schemas_say() {
    let mut failures = Failures::default();
    let mut hold = |schema: &Value, name: &str, text: &str| {
        let value: Value = toml::from_str(text).expect("a file of TOML");
        for fault in faults_by(schema, &value) {
            failures.add(name, fault);
        }
    };
    let (dialect, profile) = (dialect_schema(), profile_schema());
    let mut dialects = 0;
    while let Some((id, text)) = ncc_dialects::builtin_text(dialects) {
        hold(&dialect, id, text);
        dialects += 1;
    }
    assert!(dialects >= 9, "{dialects}");
    let folder = corpus::root().join("machines/data");
    for entry in fs::read_dir(folder).expect("the profiles").map(|entry| entry.expect("an entry")) {
        let text = fs::read_to_string(entry.path()).expect("a profile");
        hold(&profile, &entry.file_name().to_string_lossy(), &text);
    }
    let project =
        "[[programs]]\nfiles = [\"old/*.nc\"]\nmachine = \"haas-vf2\"\nto = { dialect = \"siemens\" }\n";
    hold(&project_schema(), "ncc.toml", project);
    failures.finish();
    // A key that is in no schema is one that they do not let through.
    for (schema, wrong) in [
        (&dialect, "id = \"x\"\n[program]\nframes = \"%\"\n"),
        (&profile, "dialect = \"fanuc\"\n[rates]\nrapids = 5\n"),
        (&project_schema(), "[[programs]]\nfile = \"a\"\nfiles = \"a\"\n"),
    ] {
        let value: Value = toml::from_str(wrong).expect("TOML");
        assert_eq!(faults_by(schema, &value).len(), 1, "{wrong}");
    }
}

/// The reader itself names the keys of a table when it meets another one.
#[test]
fn keys_are_those_that_the_reader_names() {
    let schema = dialect_schema();
    let own = |table: &str| -> Vec<String> {
        let part = match table {
            "" => &schema,
            table => {
                let part = &schema["properties"][table];
                let place = part["$ref"].as_str().or(part["items"]["$ref"].as_str());
                schema.pointer(place.expect("a place").trim_start_matches("#")).expect("a definition")
            }
        };
        let words = part["properties"].as_object().expect("a table").keys();
        words.filter(|word| !["remove", "replace"].contains(&word.as_str())).cloned().collect()
    };
    let tables =
        ["", "program", "comment", "block", "arc", "corner", "repeat", "polar", "formula", "cycles", "can"];
    let rows = [
        ("code", "code = \"G1\""),
        ("cycle", "code = \"G81\""),
        ("address", "letter = \"X\""),
        ("name", "name = \"FOO\""),
        ("call", "name = \"FOO\""),
        ("option", "name = \"arc_tolerance\""),
        ("behaviour", "name = \"spindle-at-stop\""),
        ("data", "name = \"G10 L2\""),
        ("system", "number = 5021"),
    ];
    let head = |table: &str| if table.is_empty() { String::new() } else { format!("[{table}]\n") };
    let tables = tables.map(|table| (table, head(table)));
    let rows = rows.map(|(table, key)| (table, format!("[[{table}]]\n{key}\n")));
    for (table, head) in tables.into_iter().chain(rows) {
        let text = format!("id = \"x\"\ntitle = \"x\"\nbase = \"fanuc\"\n{head}zzz = 1\n");
        let error = ncc_dialects::parse(&text).expect_err("a key that is not there");
        let told = format!("{error:?}");
        let mut named: Vec<String> = told
            .split("expected one of ")
            .nth(1)
            .expect("keys")
            .split('`')
            .skip(1)
            .step_by(2)
            .map(str::to_owned)
            .collect();
        named.sort();
        assert_eq!(own(table), named, "{table}: {told}");
    }
}

/// The table of keys of a page of the book.
fn book_table(keys: &[Key]) -> String {
    let mut text = "| key | takes | what it is |\n|---|---|---|\n".to_owned();
    for key in keys {
        let _ = writeln!(text, "| `{}` | {} | {} |", key.name, takes_words(key.takes), key.about.trim());
    }
    text
}

#[test]
fn the_pages_of_profiles_and_project_files_have_every_key() {
    fn table<T: Table>() -> String {
        format!("### `{}`\n\n{}\n\n{}", T::HEAD, T::ABOUT.trim(), book_table(T::KEYS))
    }
    let parts = [
        table::<PowerOn>(),
        table::<Rates>(),
        table::<Times>(),
        table::<Spindle>(),
        table::<AxisRow>(),
        table::<ToolRow>(),
        table::<EdgeRow>(),
        table::<WorkOffsetRow>(),
        table::<ProgramRow>(),
        table::<MCodeRow>(),
        table::<ValueRow>(),
        table::<Emit>(),
    ];
    let page = include_str!("../../docs/book/src/reference/machine-profile.md");
    let tables = parts.join("\n");
    assert!(page.contains(&tables), "docs/book/src/reference/machine-profile.md differs from:\n{tables}");
    use ncc_machines::reading::{BARE_NUMBERS, EDGE_IS_ENTRY, MOTION_AT_CYCLES, OFFSET_WITH_Z};
    let further = ["id", "title", "dialect", "typical", "notes"];
    for key in [BARE_NUMBERS, EDGE_IS_ENTRY, MOTION_AT_CYCLES, OFFSET_WITH_Z].into_iter().chain(further) {
        assert!(page.contains(&format!("| `{key}` |")), "{key}");
    }
    let page = include_str!("../../docs/book/src/reference/project-file.md");
    let keys = book_table(project::KEYS);
    assert!(page.contains(&keys), "docs/book/src/reference/project-file.md differs from:\n{keys}");
}
