//! The command line as a process: usage, exit codes, what goes to which stream, which files appear.

mod alone;
mod arrow;
mod batch;
mod book;
mod called;
mod check;
mod cycles;
mod dialects;
mod diff;
mod files;
mod fmt;
#[cfg(unix)]
mod functions;
mod given;
#[cfg(unix)]
mod interrupt;
mod linuxcnc_cases;
mod machines;
mod messages;
mod milling;
mod plot;
mod project;
mod provenance;
mod questions;
#[cfg(feature = "serve")]
mod serve;
mod sessions;
mod simulate;
mod stored;
mod terminal;
mod time;
mod tools;
mod usage;
mod verify;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The binary.
const NCC: &str = env!("CARGO_BIN_EXE_ncc");

/// A small program that translates without any fault.
const GOOD: &str = "G90\nG71\nG17\nT1M6\nO1S1000M3\nG0X0.Y0.\nZ5.\nG1Z-1.F100\nX10.\nG0Z50.\nM5\nM2\n";

/// A program with an error in line 2.
const BAD: &str = "G90\nGOX-15.\nM2\n";

/// What a process left behind.
#[derive(Debug)]
struct Done {
    code: i32,
    out: String,
    err: String,
}

impl Done {
    /// Checks the exit code, showing both streams if it is another.
    #[track_caller]
    fn exits(self, code: i32) -> Done {
        assert_eq!(self.code, code, "stdout:\n{}\nstderr:\n{}", self.out, self.err);
        self
    }

    /// Checks that stderr contains a text.
    #[track_caller]
    fn says(self, text: &str) -> Done {
        assert!(self.err.contains(text), "stderr has no `{text}`:\n{}", self.err);
        self
    }
}

/// A folder with `good.cn` and `bad.cn` in it.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("good.cn"), GOOD).unwrap();
    std::fs::write(folder.path().join("bad.cn"), BAD).unwrap();
    folder
}

fn command(program: &str, folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    command.env_remove("NO_COLOR").env("COLUMNS", "100");
    command
}

fn finish(mut command: Command) -> Done {
    let output = command.output().unwrap();
    Done {
        code: output.status.code().expect("an exit code, no signal"),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

/// Runs ncc.
fn ncc(folder: &Path, arguments: &[&str]) -> Done {
    finish(command(NCC, folder, arguments))
}

/// Runs ncc with a text on stdin.
fn ncc_with(folder: &Path, arguments: &[&str], stdin: &[u8]) -> Done {
    let mut command = command(NCC, folder, arguments);
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // A process that refuses before it reads closes its end.
    let _ = child.stdin.take().unwrap().write_all(stdin);
    let output = child.wait_with_output().unwrap();
    Done {
        code: output.status.code().expect("an exit code, no signal"),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

/// Compares with a file in `tests/expected`. `UPDATE_EXPECT=1` writes the file instead.
#[track_caller]
fn expect(name: &str, actual: &str) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/expected").join(name);
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, actual).unwrap();
        return;
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        expected == actual,
        "{name} differs; if the change is meant, run the tests with UPDATE_EXPECT=1 and read the diff\n\
         --- expected\n{expected}\n--- actual\n{actual}"
    );
}
