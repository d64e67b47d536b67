//! The arrow, through real shells.

use std::path::Path;

use super::*;

/// Runs a line in every POSIX shell that is there; `sh` and `bash` must be.
#[track_caller]
fn shells(prepare: &dyn Fn(&Path), line: &str, check: &dyn Fn(Done, &Path)) {
    for shell in ["sh", "bash", "dash", "zsh", "ksh"] {
        let folder = folder();
        prepare(folder.path());
        let mut command = command(shell, folder.path(), &["-c", line]);
        command.env("PATH", path_with_ncc(folder.path()));
        match command.output() {
            Err(error) if !["sh", "bash"].contains(&shell) => {
                assert_eq!(error.kind(), std::io::ErrorKind::NotFound, "{shell}");
            }
            Err(error) => panic!("{shell}: {error}"),
            Ok(output) => {
                let done = Done {
                    code: output.status.code().expect("an exit code, no signal"),
                    out: String::from_utf8(output.stdout).unwrap(),
                    err: String::from_utf8(output.stderr).unwrap(),
                };
                check(done, folder.path());
            }
        }
    }
}

/// A path on which `ncc` is found.
fn path_with_ncc(_folder: &Path) -> std::ffi::OsString {
    let own = Path::new(NCC).parent().unwrap().to_owned();
    let rest = std::env::var_os("PATH").unwrap_or_default();
    std::env::join_paths(std::iter::once(own).chain(std::env::split_paths(&rest))).unwrap()
}

fn nothing(_folder: &Path) {}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

/// What the same translation prints without an arrow.
fn plain(folder: &Path) -> String {
    ncc(folder, &["mach9", "to", "fanuc", "good.cn"]).exits(0).out
}

#[test]
fn unquoted_it_works() {
    for line in [
        "ncc mach9 -> fanuc good.cn",
        "ncc mach9->fanuc good.cn",
        "ncc mach9 => fanuc good.cn",
        "ncc -v mach9 -> fanuc good.cn",
        "ncc mach9 -> fanuc good.cn --verbose",
        "ncc mach9 -> ./fanuc good.cn",
        "ncc mach9 -> fanuc - < good.cn",
        // What was in the file is gone before we run, as with any redirection.
        "echo OLD > fanuc; ncc mach9 -> fanuc good.cn",
    ] {
        shells(&nothing, line, &|done, folder| {
            let done = done.exits(0).says("The program is in the file `fanuc`").says("-o NAME");
            assert_eq!(done.out, "", "{line}");
            let written = read(folder, "fanuc");
            assert!(written.starts_with("%\nO") && written.ends_with("%\n"), "{line}: {written}");
            if !line.contains(" - <") {
                assert_eq!(written, plain(folder), "{line}");
            }
        });
    }
}

#[test]
fn unquoted_it_says_where_even_to_other_dialects() {
    shells(&nothing, "ncc auto -> canon good.cn", &|done, folder| {
        done.exits(0).says("mv canon NAME");
        assert!(read(folder, "canon").contains("STRAIGHT_FEED("));
    });
}

#[test]
fn quoted_it_is_no_redirection() {
    for line in [
        "ncc mach9 '->' fanuc good.cn",
        "ncc 'mach9->fanuc' good.cn",
        "ncc mach9 '=>' fanuc good.cn",
        "ncc mach9=\\>fanuc good.cn",
        "ncc mach9 → fanuc good.cn",
        "ncc mach9→fanuc good.cn",
        "ncc mach9:fanuc good.cn",
        "ncc mach9 to fanuc good.cn",
    ] {
        shells(&nothing, line, &|done, folder| {
            let done = done.exits(0);
            assert_eq!(done.out, plain(folder), "{line}");
            assert!(!folder.join("fanuc").exists(), "{line}");
            assert!(!done.err.contains("redirection"), "{line}");
        });
    }
}

/// Every doubt: exit 2, the hint, and not a byte written.
#[track_caller]
fn refused(prepare: &dyn Fn(&Path), line: &str, file: &str, content: &str) {
    shells(prepare, line, &|done, folder| {
        let done = done.exits(2).says("redirection").says("to DIALECT FILE -o NAME");
        assert_eq!(done.out, "", "{line}");
        if !file.is_empty() {
            assert_eq!(read(folder, file), content, "{line}");
        }
    });
}

#[test]
fn in_doubt_nothing_is_written() {
    let old = |folder: &Path| std::fs::write(folder.join("fanuc"), "OLD\n").unwrap();
    refused(&nothing, "ncc mach9 - good.cn >> fanuc", "fanuc", "");
    refused(&old, "ncc mach9 - good.cn >> fanuc", "fanuc", "OLD\n");
    refused(&old, "ncc mach9 - good.cn 1<> fanuc", "fanuc", "OLD\n");
    refused(&nothing, "ncc mach9 - good.cn > part.nc", "part.nc", "");
    refused(&nothing, "mkdir d; ncc mach9 - good.cn > d/fanuc", "d/fanuc", "");
    refused(&nothing, "ncc mach9 - good.cn > fanuk", "fanuk", "");
    refused(&nothing, "ncc mach9 - good.cn > /dev/null", "", "");
    refused(&nothing, "{ echo FIRST; ncc mach9 - good.cn; } > fanuc", "fanuc", "FIRST\n");
    // Through a pipe the exit code is that of the last command.
    shells(&nothing, "ncc mach9 - good.cn | cat; ls", &|done, _| {
        assert_eq!(done.out, "bad.cn\ngood.cn\n");
        done.says("redirection");
    });
}

#[test]
fn several_inputs_or_two_places_are_refused() {
    shells(&nothing, "ncc mach9 -> fanuc good.cn bad.cn", &|done, folder| {
        done.exits(2).says("2 files and folders: no output folder");
        assert_eq!(read(folder, "fanuc"), "");
    });
    shells(&nothing, "ncc mach9 -> fanuc good.cn -o part.nc", &|done, folder| {
        done.exits(2).says("two places to write to");
        assert_eq!(read(folder, "fanuc"), "");
        assert!(!folder.join("part.nc").exists());
    });
    shells(&nothing, "ncc mach9 -> fanuc", &|done, folder| {
        done.exits(2);
        assert_eq!(read(folder, "fanuc"), "");
    });
    shells(&nothing, "ncc mack9 -> fanuc good.cn", &|done, folder| {
        done.exits(2).says("did you mean mach9?");
        assert_eq!(read(folder, "fanuc"), "");
    });
}

#[test]
fn a_wrong_program_leaves_the_file_empty() {
    shells(&nothing, "ncc mach9 -> fanuc bad.cn", &|done, folder| {
        done.exits(1).says("NC0107");
        assert_eq!(read(folder, "fanuc"), "");
    });
}

/// Whoever asked for JSON gets it, of an arrow that leads nowhere too.
#[test]
fn a_doubt_is_told_in_the_form_that_is_asked_for() {
    let folder = folder();
    let done = ncc(folder.path(), &["mach9", "-", "good.cn", "--format", "json"]).exits(2);
    assert!(done.err.starts_with('{') && done.err.contains("stdout is not a file"), "{}", done.err);
}
