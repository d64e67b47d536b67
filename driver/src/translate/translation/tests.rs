//! Numbers of two machines on their way through: maps in the pass that are not the verifier's must be
//! found out.

use std::collections::BTreeMap;
use std::sync::Arc;

use ncc_dialects::{Settings, builtin};
use ncc_exec::maps::Maps;
use ncc_ir::diag::{Fault, Verdict};
use ncc_machines::Profile;

use super::*;
use crate::job::{Failure, Outcome};
use crate::machines::pair::Machines;

const PART: &str = "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT3 M06\nS500 M03\nG00 X0. Y0.\nG43 H23 Z5.\nG01 Z-1. F100.\nX10.\nY10.\nG00 Z50.\nT4 M06\nG43 H4 Z5.\nG55\nG00 X1. Y2. Z3.\nM30\n%\n";

fn machine(rows: &str) -> Option<Arc<Profile>> {
    let text = format!("id = \"shop\"\ntitle = \"\"\ndialect = \"fanuc\"\n{rows}");
    Some(Arc::new(Profile::parse(&text, &builtin).expect("a profile")))
}

fn job() -> Job {
    let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
    let from = machine(
        "[[tool]]\nnumber = 3\nname = \"drill\"\nlength_entry = 23\n[[tool]]\nnumber = 4\nname = \"mill\"\n[[work_offset]]\nnumber = 1\nname = \"vice\"\n[[work_offset]]\nnumber = 2\nname = \"plate\"\n",
    );
    let to = machine(
        "[[tool]]\nnumber = 7\nname = \"drill\"\nlength_entry = 27\n[[tool]]\nnumber = 3\nname = \"mill\"\n[[work_offset]]\nnumber = 2\nname = \"vice\"\n[[work_offset]]\nnumber = 3\nname = \"plate\"\n",
    );
    Job { machines: Machines { from, to }, ..Job::new(settings.clone(), settings, "part.nc") }
}

/// Translates with maps in the pass that are not the verifier's.
fn with(change: impl Fn(&mut Maps), text: &str) -> Outcome {
    let job = job();
    let mut maps = job.machines.maps(job.to.dialect);
    change(&mut maps);
    let mut translation = Translation::new(&job);
    translation.renumbering = Renumbering::new(maps);
    // Piece by piece, so that one without any number is among them.
    let mut base = 0;
    for piece in text.split_inclusive('\n') {
        translation.piece(piece.as_bytes(), base).expect("an output in memory");
        base += piece.len() as u32;
    }
    translation.end().expect("an output in memory");
    translation.outcome([0; 32], text.len() as u64).expect("no file is written")
}

fn told(outcome: &Outcome) -> Vec<u16> {
    let errors = outcome.diagnostics.iter().filter(|d| d.fault.gravity() == Gravity::Error);
    errors.map(|d| d.fault.code()).collect()
}

/// The same part with its last moves in a subprogram, so that it is kept whole.
fn whole() -> String {
    PART.replace("M30\n", "M98 P20\nM30\nO20\nT3 M06\nG43 H23 Z9.\nG54\nX5. Y5.\nM99\n")
}

#[test]
fn the_maps_of_the_profiles_are_verified() {
    for text in [PART, &whole()] {
        let outcome = with(|_| {}, text);
        assert_eq!((told(&outcome), outcome.release), (Vec::new(), Ok(())));
        assert!(outcome.verified.is_some_and(|v| v.events > 0));
    }
}

#[test]
fn a_wrong_map_is_found_by_the_verification() {
    fn swap<T: Ord + Copy>(map: &mut Option<BTreeMap<T, T>>, a: T, b: T) {
        let map = map.as_mut().expect("an active map");
        let (x, y) = (map[&a], map[&b]);
        map.insert(a, y);
        map.insert(b, x);
    }
    fn put(map: &mut Option<BTreeMap<u32, u32>>, from: u32, to: u32) {
        map.as_mut().expect("an active map").insert(from, to);
    }
    type Wrong = (&'static str, fn(&mut Maps));
    let wrongs: [Wrong; 9] = [
        ("two tools for each other", |maps| swap(&mut maps.tools, 3, 4)),
        ("a tool that nobody named", |maps| put(&mut maps.tools, 4, 99)),
        ("tools as they were", |maps| maps.tools = None),
        ("two entries for each other", |maps| swap(&mut maps.entries, 23, 4)),
        ("entries as they were", |maps| maps.entries = None),
        ("an entry that nobody named", |maps| put(&mut maps.entries, 4, 99)),
        ("two work offsets for each other", |maps| swap(&mut maps.offsets, 1, 2)),
        ("work offsets as they were", |maps| maps.offsets = None),
        ("no map at all", |maps| *maps = Maps::default()),
    ];
    for (what, wrong) in wrongs {
        for text in [PART, &whole()] {
            let outcome = with(wrong, text);
            assert_eq!(told(&outcome), [601], "{what}");
            assert_eq!(outcome.release, Err(Failure::VerificationFailed), "{what}");
        }
    }
}

/// A number that neither machine has by name is no other's, though the same number of the source is one.
#[test]
fn a_number_without_a_name_is_like_no_other() {
    let part = PART.replace("G55\n", "");
    assert_eq!(told(&with(|maps| maps.offsets = None, &part)), [601]);
    let part = "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT4 M06\nG00 G43 H4 Z5.\nM30\n%\n";
    assert_eq!(told(&with(|maps| maps.entries = None, part)), [601]);
    assert_eq!(told(&with(|maps| maps.tools = None, part)), [601]);
}

/// Numbers differ, so no move may pass for both sides unexecuted, however plain.
#[test]
fn with_a_map_both_sides_are_executed() {
    // Tool 3 and all that is used with it have one number: the controls could be in one state.
    let rows = |mill: u32| {
        machine(&format!(
            "[[tool]]\nnumber = 3\nname = \"drill\"\nlength_entry = 23\n[[tool]]\nnumber = {mill}\nname = \"mill\"\n"
        ))
    };
    let job = Job { machines: Machines { from: rows(4), to: rows(7) }, ..job() };
    let mut translation = Translation::new(&job);
    let mut base = 0;
    for piece in PART.split_inclusive('\n') {
        translation.piece(piece.as_bytes(), base).expect("an output in memory");
        base += piece.len() as u32;
        assert!(!translation.verifier.as_ref().is_some_and(Verifier::is_level), "{piece}");
    }
    // The same machines without names: there plain moves are executed once.
    let job = Job { machines: Machines::default(), ..job };
    let mut translation = Translation::new(&job);
    let mut level = false;
    for piece in PART.split_inclusive('\n') {
        translation.piece(piece.as_bytes(), 0).expect("an output in memory");
        level |= translation.verifier.as_ref().is_some_and(Verifier::is_level);
    }
    assert!(level, "nothing would be shown");
}

/// What differs after the first pieces is seen on the second thread too, and ends the attempt.
#[test]
fn a_difference_on_a_second_thread_ends_the_attempt() {
    let job = job();
    let text = PART.replace("T4 M06", &format!("{}T4 M06", "X11.\nX12.\n".repeat(10)));
    for wrong in [false, true] {
        let mut translation = Translation::new(&job);
        let mut maps = job.machines.maps(job.to.dialect);
        if let (true, Some(entries)) = (wrong, &mut maps.entries) {
            // The length of the second tool.
            entries.insert(4, 27);
        }
        translation.renumbering = Renumbering::new(maps);
        translation.goes_beside = true;
        let (mut base, mut went) = (0, false);
        for piece in text.split_inclusive('\n') {
            translation.piece(piece.as_bytes(), base).expect("an output in memory");
            base += piece.len() as u32;
            went |= translation.beside.is_some();
        }
        translation.end().expect("an output in memory");
        assert_eq!((went, translation.is_verified_here()), (true, !wrong));
    }
}

/// A part of a control that calls tools by name.
const NAMED: &str = "G710 G17 G90 G40 G94\nG54\nT=\"drill\" M6\nD1\nS500 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\nX10\nG0 Z50\nT=\"mill\" M6\nD1\nG0 X1 Y2 Z3\nM30\n";

fn named(both: bool, change: impl Fn(&mut Maps)) -> Outcome {
    let settings = |id| Settings::new(builtin(id).expect("a built-in dialect"));
    let rows = |entry: &str, from: u32| {
        format!("[[tool]]\nnumber = {from}\nname = \"drill\"\n{entry}[[tool]]\nnumber = 3\nname = \"mill\"\n")
    };
    let to = match both {
        true => machine(&rows("length_entry = 27\n", 7)),
        false => machine(&rows("", 7)),
    };
    let text = format!("id = \"shop\"\ntitle = \"\"\ndialect = \"siemens\"\n{}", rows("", 5));
    let from = both.then(|| Arc::new(Profile::parse(&text, &builtin).expect("a profile")));
    let job = Job::new(settings("siemens"), settings("fanuc"), "part.mpf");
    let job = Job { machines: Machines { from, to }, ..job };
    let mut maps = job.machines.maps(job.to.dialect);
    change(&mut maps);
    let mut translation = Translation::new(&job);
    translation.renumbering = Renumbering::new(maps);
    translation.piece(NAMED.as_bytes(), 0).expect("an output in memory");
    translation.end().expect("an output in memory");
    translation.outcome([0; 32], NAMED.len() as u64).expect("no file is written")
}

#[test]
fn a_tool_by_name_gets_the_number_of_the_target() {
    for both in [false, true] {
        let outcome = named(both, |_| {});
        assert_eq!((told(&outcome), outcome.release), (Vec::new(), Ok(())), "{both}");
        let swapped = named(both, |maps| {
            maps.tool_names.insert("drill".into(), 3);
            maps.tool_names.insert("mill".into(), 7);
        });
        assert_eq!(told(&swapped), [601], "{both}");
        let other = named(both, |maps| {
            maps.tool_names.insert("mill".into(), 99);
        });
        assert_eq!(told(&other), [601], "{both}");
        // One that the target's machine has no number for cannot be stated.
        assert!(told(&named(both, |maps| maps.tool_names.clear())).contains(&501), "{both}");
    }
}

/// What becomes of a word in block after block is kept so many times, and then counted.
#[test]
fn very_many_rounded_numbers_are_counted() {
    let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
    let job = Job::new(settings.clone(), settings, "part.nc");
    let lines: String = (0..10_050).map(|n| format!("X{}.00004\n", n % 1000)).collect();
    let text = PART.replace("X10.\n", &lines);
    let outcome = crate::translate::translate(&job, &mut std::io::Cursor::new(text)).expect("memory");
    let rounded = |d: &&Diagnostic| matches!(d.fault, Fault::Rounded { .. });
    assert_eq!(outcome.diagnostics.iter().filter(rounded).count(), 10_000);
    assert_eq!(outcome.further().collect::<Vec<_>>(), [("NC0403".to_owned(), 50)]);
    assert_eq!(outcome.counts[Verdict::WithinTolerance as usize], 10_050);
}
