//! The report: its text, its data, and its script.

use std::process::{Command, Stdio};

use ncc_plot::{Listing, Page, Record, report};

use crate::made::part;

fn page(record: Record, source: &str) -> Page {
    let listing = Listing::read(&record, &mut source.as_bytes()).unwrap();
    Page {
        record,
        facts: vec![("Machine".to_owned(), "A & B <C>".to_owned())],
        assumed: vec!["the <b>start</b> is program zero".to_owned()],
        listing,
    }
}

fn data(html: &str) -> serde_json::Value {
    let start = html.find("id=\"data\">").unwrap() + "id=\"data\">".len();
    let end = start + html[start..].find("</script>").unwrap();
    serde_json::from_str(&html[start..end]).unwrap()
}

const SOURCE: &str =
    "T1M6\nS1263M3\nG0Y20.Z5.\nG1X40.Z-1.\n(</script><b>&amp;\"'<!--)\nG4F1.5\nG81X10.Y5.\nX20.\nX30.\nM5\n";

#[test]
fn a_report_is_one_file_and_text_stays_text() {
    let mut record = part();
    record.name = "</title><script>alert(1)</script>.nc".to_owned();
    let html = report(&[page(record, SOURCE)], "1<2");
    for wrong in ["http://", "https://", "src=", "href=", "@import", "url("] {
        assert!(!html.contains(wrong), "{wrong}");
    }
    assert!(
        !html.contains("alert(1)</script>.nc") && !html.contains("<b>start") && !html.contains("<b>&amp;")
    );
    assert_eq!(html.matches("<script").count(), 2);
    assert_eq!(html.matches("</script>").count(), 2);
    assert!(!html.contains("<!--"));
    let text = data(&html)["programs"][0]["source"]["text"].as_str().unwrap().to_owned();
    assert_eq!(text, SOURCE.trim_end());
}

#[test]
fn a_report_has_the_moves_and_their_lines() {
    let html = report(&[page(part(), SOURCE)], "0");
    let data = data(&html);
    let way = &data["programs"][0]["way"];
    let kinds = way["kinds"].as_str().unwrap();
    assert_eq!(kinds.matches('a').count(), 128);
    assert_eq!(kinds.matches('h').count(), 3);
    for column in ["x", "y", "z", "ends", "first", "last"] {
        assert_eq!(way[column].as_array().unwrap().len(), kinds.len(), "{column}");
    }
    let sum = |column: &str| way[column].as_array().unwrap().iter().map(|n| n.as_i64().unwrap()).sum::<i64>();
    assert_eq!((sum("x"), sum("y"), sum("z"), sum("ends")), (300_000, 50_000, 30_000, 366_000));
    assert_eq!(sum("last"), 10);
    assert_eq!(data["programs"][0]["holes"].as_array().unwrap().len(), 3);
}

#[test]
fn reports_of_little_and_of_two() {
    let mut nothing = Record::new("nothing");
    nothing.finish();
    let html = report(&[page(nothing.clone(), "")], "0");
    assert!(html.contains("<h1>nothing</h1>") && !html.contains("NaN"));
    assert_eq!(data(&html)["programs"][0]["way"]["start"], serde_json::Value::Null);
    let both = report(&[page(part(), SOURCE), page(nothing, "")], "0");
    assert!(both.contains("do not make the same number of moves"));
    assert_eq!(data(&both)["later"], serde_json::Value::Null);
    let same = report(&[page(part(), SOURCE), page(part(), SOURCE)], "0");
    assert!(data(&same)["later"]["t"].is_array());
}

/// The script's own functions, run without a page where there is node; a browser is not asked for.
#[test]
fn the_script_reads_what_is_written() {
    if Command::new("node").arg("--version").stdout(Stdio::null()).status().is_err() {
        return;
    }
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let html = report(&[page(part(), SOURCE)], "0");
    let run = Command::new("node")
        .arg(folder.join("tests/suite/script.js"))
        .arg(folder.join("src"))
        .arg(data(&html).to_string())
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}
