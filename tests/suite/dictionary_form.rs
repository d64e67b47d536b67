//! `docs/book/src/reference/dialect.md`, the documented form of a dictionary, is that of the Rust types.
//!
//! Its reference is made from the types' own comments (`UPDATE_EXPECT=1` writes it), and the fields and
//! values it names are those that the loader itself names when it meets one that there is not.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;

use ncc_tests::corpus::root;
use ncc_tests::expect::{self, Failures};

/// Where the reference begins.
const REFERENCE: &str = "# Reference\n";

/// Types of the reference: heading, type, and a text in which its fields can be asked for.
const TABLES: &[(&str, &str, &str)] = &[
    ("The file", "Dialect", "@"),
    ("`[program]`", "ProgramRules", "[program]\n@"),
    ("`[comment]`", "CommentRules", "[comment]\n@"),
    ("`[block]`", "BlockRules", "[block]\n@"),
    ("`[number.…]`", "NumberRules", "[number.length]\n@"),
    ("`[[address]]`", "Address", "[[address]]\nletter = \"X\"\n@"),
    ("`[arc]`", "ArcRules", "[arc]\n@"),
    ("`[corner]`", "CornerRules", "[corner]\n@"),
    ("`[repeat]`", "RepeatRules", "[repeat]\n@"),
    ("`[polar]`", "PolarRules", "[polar]\n@"),
    ("`[formula]`", "FormulaRules", "[formula]\n@"),
    ("`[cycles]`", "CycleRules", "[cycles]\n@"),
    ("`[[cycle]]`", "CycleRow", "[[cycle]]\ncode = \"G84\"\n@"),
    ("`dwell` of a cycle, `dwell` of a code", "DwellWord", "[[code]]\ncode = \"G04\"\ndwell = [{ @ }]"),
    ("`dwell_by` of a cycle", "AskedDwell", "[[cycle]]\ncode = \"G83\"\ndwell_by = { @ }"),
    ("`[[code]]`", "CodeRow", "[[code]]\ncode = \"G04\"\n@"),
    ("`[[data]]`", "DataRow", "[[data]]\nname = \"G10 L2\"\n@"),
    ("`values` of a table", "ValueWord", "[[data]]\nname = \"G10 L2\"\nvalues = [{ @ }]"),
    ("`[[name]]`", "NameRow", "[[name]]\nname = \"ZZ\"\n@"),
    ("`[[call]]`", "CallRow", "[[call]]\nname = \"ZZ\"\n@"),
    ("`parameters` of a call", "Parameter", "[[call]]\nname = \"ZZ\"\nparameters = [{ @ }]"),
    ("`[power_on]`", "PowerOn", "[power_on]\n@"),
    ("a fact of `[power_on]`", "PowerOnFact", "[power_on.units]\n@"),
    ("`[[option]]`", "OptionRow", "[[option]]\nname = \"tapping\"\n@"),
    ("`[[behaviour]]`", "BehaviourRow", "[[behaviour]]\nname = \"spindle-at-change\"\n@"),
    ("`[functions.…]`", "FunctionRow", "[functions.G200]\n@"),
    ("`[can]`", "Can", "[can]\n@"),
    ("`[[variant]]`", "VariantRow", "[[variant]]\nwhen = { a = \"b\" }\n@"),
    ("`[variant.block]`", "VariantBlock", "[[variant]]\nwhen = { a = \"b\" }\n[variant.block]\n@"),
    ("`[variant.can]`", "VariantCan", "[[variant]]\nwhen = { a = \"b\" }\n[variant.can]\n@"),
];

/// Lists of values, and a text in which they can be asked for.
const VALUES: &[(&str, &str)] = &[
    ("Family", "family = \"@\""),
    ("Quantity", "[[address]]\nletter = \"X\"\nquantity = \"@\""),
    ("Bare", "[number.length]\nbare = \"@\""),
    ("PointRule", "[number.length]\npoint = \"@\""),
    ("Role", "[[address]]\nletter = \"X\"\nrole = \"@\""),
    ("NameRole", "[[name]]\nname = \"ZZ\"\nrole = \"@\""),
    ("CallKind", "[[call]]\nname = \"ZZ\"\nkind = \"@\""),
    ("ParameterRole", "[[call]]\nname = \"ZZ\"\nparameters = [{ role = \"@\" }]"),
    ("DataKind", "[[data]]\nname = \"G10 L2\"\nkind = \"@\""),
    ("ValueName", "[[data]]\nname = \"G10 L2\"\nvalues = [{ of = \"@\" }]"),
    ("Sureness", "[[behaviour]]\nname = \"spindle-at-change\"\nsure = \"@\""),
    ("RefusalHelp", "[[code]]\ncode = \"G1\"\nhelp = \"@\""),
    ("SafeStart", "safe_start = [\"@\"]"),
    ("Statement", "[formula]\nstatements = [\"@\"]"),
    ("Operator", "[formula.operators]\n@ = \"zz\""),
    ("FunctionName", "[formula.functions]\n@ = \"zz\""),
];

/// `docs/book/src/reference/behaviours.md` is made from the dictionaries: what codes do besides their names, with source and how sure.
#[test]
fn what_codes_do_besides_is_documented() {
    let mut text = String::from(concat!(
        "# What codes do besides their names\n\n",
        "Made from the dictionaries. ncc executes both programs with these values. An *open* value is decided by a\n",
        "parameter, a machine datum or the machine builder: ncc runs the program with each value, the one of the\n",
        "table first, and reports where they make another cut. State it with `--from-option` or `--to-option`, or\n",
        "under `[options]` of a machine's profile; the name of the option has `_` for `-`.\n",
    ));
    for dialect in ncc_dialects::builtins().filter(|d| !d.behaviour.is_empty()) {
        let _ = write!(
            text,
            "\n## {}\n\n| codes | behaviour | value | how sure | source |\n|---|---|---|---|---|\n",
            dialect.id
        );
        for row in &dialect.behaviour {
            let value = if row.open { format!("{} (open)", row.value) } else { row.value.clone() };
            let sure = match row.sure {
                ncc_dialects::Sureness::Read => "read",
                ncc_dialects::Sureness::SecondHand => "second hand",
                ncc_dialects::Sureness::Memory => "from memory",
            };
            let codes = row.codes.join(" ");
            let _ = writeln!(
                text,
                "| {codes} | `{}` | {value} | {sure} | {} |",
                row.name,
                row.source.replace('|', "/")
            );
        }
    }
    let mut failures = Failures::default();
    failures.check(
        "docs/book/src/reference/behaviours.md",
        expect::file(&root().join("docs/book/src/reference/behaviours.md"), text.as_bytes()),
    );
    failures.finish();
}

/// A field, or a value.
struct Entry {
    name: String,
    form: String,
    doc: String,
    optional: bool,
}

fn sources() -> String {
    [
        "schema.rs",
        "codes.rs",
        "cycles.rs",
        "corners.rs",
        "repeats.rs",
        "formula.rs",
        "functions.rs",
        "names.rs",
        "power_on.rs",
        "stored.rs",
        "words.rs",
        "behaviours.rs",
        "variants.rs",
    ]
    .map(|f| fs::read_to_string(root().join("ir/dialects/src").join(f)).expect("a source"))
    .join("\n")
}

/// The lines of a type's body, and whether every field may be left out.
fn body(sources: &str, name: &str) -> (Vec<String>, bool, String) {
    let lines: Vec<&str> = sources.lines().collect();
    let opens = |l: &str| {
        ["struct", "enum"].iter().any(|k| {
            l.strip_prefix(&format!("pub {k} {name}"))
                .is_some_and(|rest| rest.starts_with([' ', '<']) && rest.ends_with('{'))
        })
    };
    let at = lines.iter().position(|l| opens(l)).unwrap_or_else(|| panic!("no type {name}"));
    let above: Vec<&str> = lines[..at]
        .iter()
        .rev()
        .take_while(|l| l.starts_with("///") || l.starts_with("#["))
        .copied()
        .collect();
    let optional = above.iter().any(|l| l.contains("serde(default"));
    let doc: Vec<&str> = above.iter().rev().filter_map(|l| l.strip_prefix("/// ")).collect();
    let body = lines[at + 1..].iter().take_while(|l| **l != "}").map(|l| l.trim().to_owned()).collect();
    (body, optional, doc.join(" "))
}

fn fields(sources: &str, name: &str) -> Vec<Entry> {
    let (body, all_optional, _) = body(sources, name);
    let (mut doc, mut attributes, mut fields) = (String::new(), String::new(), Vec::new());
    for line in body {
        if let Some(text) = line.strip_prefix("///") {
            doc.push_str(text);
        } else if line.starts_with("#[") {
            attributes.push_str(&line);
        } else if let Some((field, form)) = line.strip_prefix("pub ").and_then(|l| l.split_once(": ")) {
            let form = form.trim_end_matches(',').to_owned();
            let optional =
                all_optional || attributes.contains("serde(default") || form.starts_with("Option<");
            if !attributes.contains("serde(skip)") {
                fields.push(Entry { name: field.to_owned(), form, doc: plain(&doc), optional });
            }
            doc.clear();
            attributes.clear();
        }
    }
    fields
}

fn values(sources: &str, name: &str) -> Vec<Entry> {
    let (body, _, _) = body(sources, name);
    let (mut doc, mut values) = (String::new(), Vec::new());
    for line in body {
        if let Some(text) = line.strip_prefix("///") {
            doc.push_str(text);
        } else if let Some(variant) = line.strip_suffix(',').filter(|l| l.chars().all(char::is_alphanumeric))
        {
            let name = kebab(variant);
            values.push(Entry { name, form: String::new(), doc: plain(&doc), optional: false });
            doc.clear();
        }
    }
    values
}

fn kebab(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !out.is_empty() {
            out.push('-');
        }
        out.push(c.to_ascii_lowercase());
    }
    out
}

/// A comment without its links.
fn plain(doc: &str) -> String {
    let mut text = doc.trim().to_owned();
    for (link, word) in [("[`Role::CentreX`]", "`centre-x`"), ("[`ParameterRole::Way`]", "`way`")] {
        text = text.replace(link, word);
    }
    text.replace("[`", "`").replace("`]", "`").replace('|', "\\|")
}

/// A type as a file has it.
fn form(of: &str) -> String {
    if let Some(inner) = of.strip_prefix("Option<").and_then(|t| t.strip_suffix('>')) {
        return form(inner);
    }
    if let Some(inner) = of.strip_prefix("Vec<").and_then(|t| t.strip_suffix('>')) {
        return match inner {
            "Address" | "CycleRow" | "PatternRow" | "CodeRow" | "DataRow" | "NameRow" | "CallRow"
            | "OptionRow" => "rows".into(),
            inner => format!("list of {}", form(inner)),
        };
    }
    if let Some(inner) = of.strip_prefix("PowerOnFact<").and_then(|t| t.strip_suffix('>')) {
        return format!("fact: {}", form(inner));
    }
    match of {
        "String" => "text".into(),
        "bool" => "true or false".into(),
        "char" => "letter or sign".into(),
        "[char; 3]" => "list of letters".into(),
        "[u32; 2]" => "two whole numbers".into(),
        "u8" | "u16" | "u32" | "usize" | "i64" => "whole number".into(),
        "f64" => "number".into(),
        "Meaning" | "NameMeaning" => "a meaning".into(),
        "DwellWord" => "table".into(),
        "Parameter" => "table".into(),
        "UnitsName" => "`mm` `inch`".into(),
        "DistanceName" => "`absolute` `incremental`".into(),
        "PlaneName" => "`xy` `zx` `yz`".into(),
        "FeedModeName" => "`per-minute` `per-revolution` `inverse-time`".into(),
        "ReturnLevelName" => "`initial` `retract`".into(),
        "ApproachName" => "`plane-first` `raise-first` `retract-first` `clear-first`".into(),
        "MotionName" => "`traverse` `feed`".into(),
        "RemainderRule" => "`of-any` `typed` `made-whole`".into(),
        "T" => "the value".into(),
        of if of.starts_with("BTreeMap<Quantity") => "a table for each kind of quantity".into(),
        "BTreeMap<String, FunctionRow>" => "a table for each function".into(),
        of if of.starts_with("BTreeMap") => "table of texts".into(),
        of if VALUES.iter().any(|(name, _)| *name == of) => format!("a {}", spoken(of)),
        _ => "table".into(),
    }
}

fn spoken(name: &str) -> String {
    kebab(name).replace('-', " ")
}

fn reference() -> String {
    let sources = sources();
    let mut out = String::from(REFERENCE);
    out.push_str("\nMade from the types that read the file. A field with * may be left out.\n");
    for (heading, name, _) in TABLES {
        let (.., doc) = body(&sources, name);
        let _ = write!(out, "\n## {heading}\n\n{}\n\n| field | form | |\n|---|---|---|\n", plain(&doc));
        for field in fields(&sources, name) {
            let mark = if field.optional { "*" } else { "" };
            let doc = if field.doc.is_empty() { String::new() } else { field.doc };
            let _ = writeln!(out, "| `{}`{mark} | {} | {doc} |", field.name, form(&field.form));
        }
    }
    out.push_str("\n## `[[pattern]]`\n\nA pattern of positions: `kind = \"circle\"` with `code`, `first` (two letters), `centre` (two letters), `step`,\n`count`, `source`; or `kind = \"grid\"` with `code`, `pitch` (two letters), `counts` (two letters), `serpentine`,\n`source`.\n");
    for (name, _) in VALUES {
        let (.., doc) = body(&sources, name);
        let _ = write!(out, "\n## A {}\n\n{}\n\n| value | |\n|---|---|\n", spoken(name), plain(&doc));
        for value in values(&sources, name) {
            let _ = writeln!(out, "| `{}` | {} |", value.name, value.doc);
        }
    }
    out.push_str(
        "\n## Meanings\n\nOf a code or a word of several letters, with the argument after a blank:\n\n",
    );
    for meaning in meanings("meaning.rs") {
        let _ = writeln!(out, "- `{meaning}`");
    }
    out.push_str("\nOf a word of several letters only:\n\n");
    for meaning in meanings("names.rs") {
        let _ = writeln!(out, "- `{meaning}`");
    }
    out
}

/// The meanings that a file of the loader reads, as its `FromStr` has them.
fn meanings(file: &str) -> Vec<String> {
    let text = fs::read_to_string(root().join("ir/dialects/src").join(file)).expect("a source");
    let mut all = Vec::new();
    for line in text.lines().map(str::trim) {
        let Some(rest) = line.strip_prefix("(\"") else { continue };
        let Some((name, rest)) = rest.split_once("\", ") else { continue };
        let argument = rest.strip_prefix('"').and_then(|r| r.split_once('"')).map(|(a, _)| a);
        all.push(match argument {
            Some("") => name.to_owned(),
            Some(argument) => format!("{name} {argument}"),
            None if name.ends_with("FRAME") => format!("{name} translate, rotate, scale or mirror"),
            None if name.ends_with("OFFSETS") => format!("{name} and a number"),
            None if name == "SET_MOTION_CONTROL_MODE" => format!("{name} and a way of taking corners"),
            None if name == "ADVISE" => format!("{name}, a kind and mostly its value"),
            None => format!("{name} and a name"),
        });
    }
    all
}

#[test]
fn the_reference_is_that_of_the_types() {
    let path = root().join("docs/book/src/reference/dialect.md");
    let text = fs::read_to_string(&path).expect("the page");
    let prose = text.split(REFERENCE).next().unwrap_or_default();
    let mut failures = Failures::default();
    let whole = format!("{}\n{}", prose.trim_end(), format!("\n{}", reference()).trim_end()) + "\n";
    failures.check("docs/book/src/reference/dialect.md", expect::file(&path, whole.as_bytes()));
    failures.finish();
}

/// The words in backquotes behind `expected`.
fn expected(message: &str) -> BTreeSet<String> {
    let behind = message.split_once("expected ").map_or("", |(_, rest)| rest);
    behind.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

#[test]
fn the_loader_knows_the_same_fields_and_values() {
    let sources = sources();
    let mut failures = Failures::default();
    let ask = |text: &str| {
        let text = match text.starts_with("family") {
            true => format!("id = \"zz\"\ntitle = \"\"\n{text}\n"),
            false => format!("id = \"zz\"\ntitle = \"\"\nbase = \"fanuc\"\n{text}\n"),
        };
        ncc_dialects::parse(&text).expect_err("an unknown word").to_string()
    };
    for (heading, name, place) in TABLES {
        let message = ask(&place.replace('@', "zzz = 1"));
        let own: BTreeSet<String> = fields(&sources, name).into_iter().map(|f| f.name).collect();
        if expected(&message) != own {
            failures.add(heading, format!("documented: {own:?}\nthe loader: {message}"));
        }
    }
    for (name, place) in VALUES {
        let message = ask(&place.replace('@', "zzz"));
        let own: BTreeSet<String> = values(&sources, name).into_iter().map(|v| v.name).collect();
        if expected(&message) != own {
            failures.add(name, format!("documented: {own:?}\nthe loader: {message}"));
        }
    }
    for file in ["meaning.rs", "names.rs"] {
        for meaning in meanings(file) {
            let meaning = meaning
                .replace("translate, rotate, scale or mirror", "rotate")
                .replace("and a number", "3")
                .replace("and a way of taking corners", "continuous")
                .replace(", a kind and mostly its value", " look-ahead on")
                .replace("and a name", "zz");
            if meaning.parse::<ncc_dialects::NameMeaning>().is_err() {
                failures.add(&meaning, "is no meaning");
            }
        }
    }
    failures.finish();
}
