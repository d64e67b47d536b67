//! Pages of the book that are made: of each dialect, from its dictionary (`reference/dialects`), with the meaning of each word, what it
//! does besides, what is refused, and who says so; and of all messages, from the pages of `ncc explain` (`reference/messages`).

use std::fmt::Write as _;
use std::fs;

use ncc_dialects::{CodeRow, Dialect, builtins};
use ncc_driver::render::dialects::spaced;
use ncc_tests::corpus::root;
use ncc_tests::expect::{self, Failures};

/// Text in a cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "/").replace('<', "&lt;")
}

/// A table, if it has rows.
fn table(page: &mut String, heading: &str, columns: &[&str], rows: &[Vec<String>]) {
    if rows.is_empty() {
        return;
    }
    let _ =
        writeln!(page, "\n## {heading}\n\n| {} |\n|{}", columns.join(" | "), "---|".repeat(columns.len()));
    for row in rows {
        let cells: Vec<String> = row.iter().map(|text| cell(text)).collect();
        let _ = writeln!(page, "| {} |", cells.join(" | "));
    }
}

fn confirmed(sure: bool) -> String {
    if sure { String::new() } else { "not confirmed".into() }
}

/// The letters of a code and its number, if it is a whole one.
fn numbered(code: &str) -> Option<(&str, u32)> {
    let at = code.find(|c: char| c.is_ascii_digit())?;
    Some((&code[..at], code[at..].parse().ok()?))
}

fn meaning(dialect: &Dialect, row: &CodeRow) -> String {
    let means = row.means.map(|means| means.to_string()).unwrap_or_default();
    match dialect.cycle_row(&row.code) {
        Some(cycle) => format!("{means} {}", cycle.kind),
        None => means,
    }
}

/// Codes with their meanings; those of work offsets one after the other are one row.
fn codes(dialect: &Dialect) -> Vec<Vec<String>> {
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut last: Option<(&CodeRow, String)> = None;
    for row in dialect.code.iter().filter(|row| row.refuse.is_none()) {
        let means = meaning(dialect, row);
        let follows = last.as_ref().is_some_and(|(before, _)| {
            let next = numbered(&before.code).zip(numbered(&row.code));
            let counts = next.is_some_and(|((a, n), (b, m))| a == b && n + 1 == m);
            counts && before.source == row.source && means.starts_with("SET_ORIGIN_OFFSETS ")
        });
        match rows.last_mut().filter(|_| follows) {
            Some(group) => {
                let first = group[0].split(" to ").next().unwrap_or_default().to_owned();
                group[0] = format!("{first} to {}", row.code);
                let first = group[1].split(" to ").next().unwrap_or_default().to_owned();
                group[1] = format!("{first} to {}", means.trim_start_matches("SET_ORIGIN_OFFSETS "));
            }
            None => rows.push(vec![row.code.clone(), means.clone(), confirmed(row.sure), row.source.clone()]),
        }
        last = Some((row, means));
    }
    rows
}

fn page(dialect: &Dialect) -> String {
    let mut page = format!("# {}\n\nThe dialect `{}`, made from its dictionary.", dialect.title, dialect.id);
    if let Some(base) = &dialect.base {
        let _ = write!(page, " It builds on `{base}`.");
    }
    let _ = writeln!(page, " [Limits](../limits.md) has what is refused in general.");
    let means = ["word", "meaning", "", "source"];
    let text = |means: Option<String>| means.unwrap_or_default();
    table(&mut page, "Codes", &means, &codes(dialect));
    let row = |name: &str, what: String, sure: bool, source: &str| {
        vec![name.to_owned(), what, confirmed(sure), source.to_owned()]
    };
    let named = |refused: bool| {
        let rows = dialect.name.iter().filter(move |row| row.refuse.is_some() == refused);
        rows.map(|name| {
            let role = || name.role.map(|role| spaced(&format!("{role:?}")));
            let what =
                name.means.map(|means| means.to_string()).or_else(role).or_else(|| name.refuse.clone());
            row(&name.name, text(what), name.sure, &name.source)
        })
        .collect::<Vec<_>>()
    };
    table(&mut page, "Words of several letters", &means, &named(false));
    let calls: Vec<Vec<String>> = dialect
        .call
        .iter()
        .map(|call| {
            let arguments: Vec<&str> = call.parameters.iter().map(|p| p.name.as_str()).collect();
            let name = format!("{}({})", call.name, arguments.join(", "));
            row(&name, spaced(&format!("{:?}", call.kind)), call.sure, &call.source)
        })
        .collect();
    table(&mut page, "Cycles and patterns that are called", &means, &calls);
    let addresses: Vec<Vec<String>> = dialect
        .address
        .iter()
        .map(|address| {
            let what = spaced(&format!("{:?}, {:?}", address.role, address.quantity));
            row(&address.letter.to_string(), what, address.sure, &address.source)
        })
        .collect();
    table(&mut page, "Addresses", &["address", "meaning", "", "source"], &addresses);
    let refused: Vec<Vec<String>> = dialect
        .code
        .iter()
        .filter_map(|code| Some(row(&code.code, code.refuse.clone()?, code.sure, &code.source)))
        .chain(named(true))
        .collect();
    table(&mut page, "Known and refused", &["word", "what it is", "", "source"], &refused);
    let besides: Vec<Vec<String>> = dialect
        .behaviour
        .iter()
        .map(|fact| {
            let open = if fact.open { "open" } else { "" };
            vec![
                fact.codes.join(" "),
                fact.name.to_string(),
                fact.value.to_string(),
                open.into(),
                fact.source.clone(),
            ]
        })
        .collect();
    let columns = ["codes", "behaviour", "value", "", "source"];
    table(&mut page, "What codes do besides their names", &columns, &besides);
    let options: Vec<Vec<String>> = dialect
        .option
        .iter()
        .map(|option| {
            let values =
                if option.values.is_empty() { "a number".to_owned() } else { option.values.join(", ") };
            vec![
                option.name.clone(),
                values,
                option.default.clone(),
                ncc_driver::render::dialects::option_about(dialect, option),
                option.source.clone(),
            ]
        })
        .collect();
    let columns = ["option", "values", "without it", "what it states", "source"];
    table(&mut page, "Options (`--from-option`, `--to-option`)", &columns, &options);
    let sources: Vec<Vec<String>> =
        dialect.sources.iter().map(|(tag, source)| vec![tag.clone(), source.clone()]).collect();
    table(&mut page, "Sources", &["tag", "source"], &sources);
    page
}

#[test]
fn each_dialect_has_a_page_in_the_book() {
    let folder = root().join("docs/book/src/reference/dialects");
    let mut failures = Failures::default();
    for dialect in builtins().filter(|dialect| !dialect.code.is_empty()) {
        let name = format!("{}.md", dialect.id);
        failures.check(&name, expect::file(&folder.join(&name), page(dialect).as_bytes()));
    }
    failures.finish();
}

/// Hundreds of the codes of messages, with the name of their page and what they are about.
const MESSAGES: [(&str, &str, &str); 9] = [
    ("NC01", "text", "the text of a program"),
    ("NC02", "meaning", "what a block means"),
    ("NC03", "assumptions", "assumptions and questions"),
    ("NC04", "changes", "what reads differently"),
    ("NC05", "target", "what the target lacks"),
    ("NC06", "verification", "verification"),
    ("NC07", "files", "your own files: dialects, profiles, `ncc.toml`"),
    ("NC08", "checks", "checks"),
    ("NC09", "simulation", "simulation"),
];

#[test]
fn each_message_has_a_place_in_the_book() {
    let pages = root().join("driver/messages");
    let mut names: Vec<String> = fs::read_dir(&pages)
        .expect("the pages of messages")
        .map(|entry| entry.expect("a folder").file_name().to_string_lossy().into_owned())
        .filter(|name| name.starts_with("NC"))
        .collect();
    names.sort();
    assert!(names.len() > 150, "{}", names.len());
    let mut failures = Failures::default();
    let mut placed = 0;
    for (code, name, about) in MESSAGES {
        let mut page = format!("# Messages {code}xx: {about}\n\nMade from the pages of `ncc explain`.\n");
        for file in names.iter().filter(|file| file.starts_with(code)) {
            placed += 1;
            // One level deeper, as each is a part here.
            let text = fs::read_to_string(pages.join(file).join("page.md")).expect("a page");
            let mut fenced = false;
            for line in text.trim_end().lines() {
                fenced ^= line.starts_with("```");
                let deeper = if line.starts_with('#') && !fenced { "#" } else { "" };
                let above = if line.starts_with("# ") { "\n" } else { "" };
                let _ = writeln!(page, "{above}{deeper}{line}");
            }
        }
        let name = format!("{name}.md");
        let file = root().join("docs/book/src/reference/messages").join(&name);
        failures.check(&name, expect::file(&file, page.as_bytes()));
    }
    assert_eq!(placed, names.len(), "a message is on no page");
    failures.finish();
}
