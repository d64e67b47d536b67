//! Programs are started by the command line alone: what a dictionary names is never started by a service, a studio or an
//! editor, whatever its user sends.

use ncc_tests::corpus::root;

use crate::tidy::{code, files, text};

/// The file that starts programs, for custom functions.
const STARTER: &str = "cli/src/registry/functions.rs";

#[test]
fn only_the_command_line_starts_programs() {
    let folders = [
        "ir",
        "frontends",
        "backends",
        "machines",
        "analysis",
        "driver",
        "engine",
        "service",
        "studio",
        "cli",
    ];
    let mut found = Vec::new();
    for path in folders.iter().flat_map(|folder| files(folder, &[".rs"])) {
        let name = path.strip_prefix(root()).unwrap_or(&path).display().to_string();
        let starts = |line: &str| line.contains("process::") && line.contains("Command");
        if name.contains("/src/") && code(&text(&path), false).lines().any(starts) {
            found.push(name);
        }
    }
    assert_eq!(found, [STARTER]);
}
