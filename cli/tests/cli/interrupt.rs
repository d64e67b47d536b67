//! Ctrl-C while a program is executed or read: the place is told, nothing is written, and the exit code is 130.

use std::io::Read;
use std::time::{Duration, Instant};

use super::*;

/// A loop that takes many seconds.
const LOOP: &str = "%\nO1\nG21 G17 G90 G94 G54 G40 G49 G80\n#1=0\nWHILE[#1 LT 20000000] DO1\nG01 X1. F100.\nX2.\n\
                    #1=#1+1\nEND1\nM30\n%\n";

/// Calls ncc, interrupts it once it is at work, and gives how long it took to end.
fn interrupted(folder: &Path, arguments: &[&str]) -> (Done, Duration) {
    let mut child = Command::new(NCC)
        .current_dir(folder)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(700));
    assert!(child.try_wait().unwrap().is_none(), "{arguments:?} is over before it can be interrupted");
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let begun = Instant::now();
    let status = child.wait().unwrap();
    let (mut out, mut err) = (String::new(), String::new());
    child.stdout.take().unwrap().read_to_string(&mut out).unwrap();
    child.stderr.take().unwrap().read_to_string(&mut err).unwrap();
    (Done { code: status.code().unwrap_or(-1), out, err }, begun.elapsed())
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_run_says_where_it_was_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("loop.nc"), LOOP).unwrap();
    std::fs::write(folder.join("out.nc"), "before").unwrap();
    let all: [&[&str]; 6] = [
        &["fanuc", "to", "haas", "loop.nc", "-o", "out.nc", "--report", "report.json"],
        &["time", "--from", "fanuc", "loop.nc", "-o", "time.txt"],
        &["plot", "--from", "fanuc", "loop.nc", "-o", "plot.svg"],
        &["check", "fanuc:loop.nc", "-o", "found.sarif", "--format", "sarif"],
        &["verify", "fanuc:loop.nc", "fanuc:loop.nc", "--cert", "cert.json"],
        &["diff", "fanuc:loop.nc", "fanuc:loop.nc", "--html", "diff.html"],
    ];
    for arguments in all {
        let (done, took) = interrupted(folder, arguments);
        let done = done.exits(130);
        assert!(took < Duration::from_secs(5), "{arguments:?}: {took:?}");
        // A run with other facts may just have begun.
        let named = (3..=9).any(|line| {
            done.err.contains(&format!("loop.nc:{line}:"))
                || done.err.contains(&format!("line {line} of loop.nc"))
        });
        assert!(named && done.err.contains("interrupted"), "{arguments:?}: {}", done.err);
        assert_eq!(done.out, "", "{arguments:?}");
        assert_eq!(names(folder), ["loop.nc", "out.nc"], "{arguments:?}");
        assert_eq!(std::fs::read_to_string(folder.join("out.nc")).unwrap(), "before", "{arguments:?}");
    }
}

#[test]
fn reading_says_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let long = format!("%\nO1\nG21 G17 G90 G94\n{}M30\n%\n", "G00 X1. Y2.\nX5.\n".repeat(4_000_000));
    std::fs::write(folder.join("long.nc"), long).unwrap();
    let (done, _) = interrupted(folder, &["fanuc", "to", "siemens", "long.nc", "-o", "out.mpf"]);
    done.exits(130).says("interrupted at line ").says(" of long.nc; nothing was written");
    assert_eq!(names(folder), ["long.nc"]);
}
