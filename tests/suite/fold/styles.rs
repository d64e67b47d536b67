//! How CAM systems write holes long-hand, and what becomes of it.
//!
//! `tests/fold/<style>.nc` begins with `#` lines that say what is characteristic and where it was
//! seen; then comes a program of our own in that style, `---`, and what it is folded to, in the text
//! form. The whole way is gone: read, folded, written, read back and verified.

use std::fs;
use std::path::Path;

use ncc_tests::corpus::files;
use ncc_tests::expect::{self, Failures};
use ncc_tests::translate::{job, rendered, translate};

#[test]
fn styles_of_cam_systems() {
    let mut failures = Failures::default();
    let mut styles = 0;
    for path in files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("fold")) {
        styles += 1;
        failures.check(path.display(), style(&path));
    }
    failures.finish();
    assert!(styles >= 8, "{styles} styles");
}

fn style(path: &Path) -> Result<(), String> {
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    let source = text.split("---\n").next().unwrap_or_default();
    let start = source.lines().take_while(|line| line.starts_with('#')).map(|line| line.len() + 1).sum();
    let (about, program) = source.split_at(start);
    if !about.contains("Seen in") {
        return Err("a style says where it was seen".into());
    }
    let mut job = job("fanuc", "ir", "style");
    job.head = false;
    job.fold = Some(true);
    let (outcome, written) = translate(&job, program.as_bytes());
    if outcome.release.is_err() {
        return Err(rendered(&job, "style", program.as_bytes(), &outcome.diagnostics));
    }
    let written = String::from_utf8(written).map_err(|e| e.to_string())?;
    expect::file(path, format!("{source}---\n{written}").as_bytes())
}
