//! Expected files: compared byte for byte, shown as a diff, written anew with `UPDATE_EXPECT=1`.

use std::fs;
use std::path::Path;

use similar::TextDiff;

/// Whether expected files are to be written anew.
pub fn updating() -> bool {
    std::env::var_os("UPDATE_EXPECT").is_some_and(|v| v == "1")
}

/// What went wrong in a test that goes on after a fault.
#[derive(Debug, Default)]
pub struct Failures(Vec<String>);

impl Failures {
    /// Notes a fault of `what`.
    pub fn add(&mut self, what: impl std::fmt::Display, fault: impl std::fmt::Display) {
        self.0.push(format!("── {what}\n{fault}"));
    }

    /// Notes the fault of a result, if it has one.
    pub fn check<T>(&mut self, what: impl std::fmt::Display, result: Result<T, String>) -> Option<T> {
        result.map_err(|fault| self.add(what, fault)).ok()
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Fails the test if there are any.
    ///
    /// # Panics
    /// There are.
    pub fn finish(self) {
        const SHOWN: usize = 40;
        let all = self.0.len();
        let shown = self.0.iter().take(SHOWN).cloned().collect::<Vec<_>>().join("\n");
        assert!(all == 0, "{all} faults{}\n{shown}", if all > SHOWN { ", the first of them:" } else { "" });
    }
}

/// Compares with an expected file.
///
/// # Errors
/// They differ: a readable account of it.
pub fn file(path: &Path, actual: &[u8]) -> Result<(), String> {
    let expected = fs::read(path).ok();
    if expected.as_deref() == Some(actual) {
        return Ok(());
    }
    if updating() {
        let folder = path.parent().ok_or("no folder")?;
        fs::create_dir_all(folder).map_err(|e| e.to_string())?;
        return fs::write(path, actual).map_err(|e| format!("{}: {e}", path.display()));
    }
    match expected {
        None => Err(format!("{}: no such file; UPDATE_EXPECT=1 writes it", path.display())),
        Some(expected) => Err(format!("{}\n{}", path.display(), diff(&expected, actual))),
    }
}

/// The lines in which two texts differ.
pub fn diff(expected: &[u8], actual: &[u8]) -> String {
    let (old, new) = (readable(expected), readable(actual));
    TextDiff::from_lines(&old, &new).unified_diff().context_radius(2).header("expected", "actual").to_string()
}

/// Text with every byte visible: carriage returns and bytes that are no UTF-8.
fn readable(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).replace('\r', "␍")
}
