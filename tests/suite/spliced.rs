//! Programs that nobody wrote: blocks of the corpus put into other programs of the corpus, where every row
//! of the dictionaries is met. Most say something that their author would not have, which is what they are
//! for: each is translated and verified, or refused. Where the second interpreter runs both sides of what was
//! released, it has the last word. Few may be held back by the verification, which tells them as a fault of
//! the compiler: there a refusal by name is missing.
//!
//! `NCC_SPLICED=2000` makes so many of each dialect, and prints those that are held back. `NCC_TEXTS=DIR` keeps the
//! texts for LinuxCNC there, of which its own interpreter is a judge (`.ci/rs274`).

use ncc_driver::job::{Failure, Job};
use ncc_ir::diag::Fault;
use ncc_tests::besides;
use ncc_tests::corpus::{self, DIALECTS, Program};
use ncc_tests::expect::Failures;
use ncc_tests::plain::{self, Corners, Happening, Tolerance};
use ncc_tests::translate::{computes, job, keep, rendered, translate};

/// Programs of a dialect in a usual run.
const USUAL: usize = 60;

/// One in so many programs may be held back.
const MOST_HELD_BACK: usize = 100;

#[test]
fn blocks_in_other_programs() {
    let many = std::env::var("NCC_SPLICED").ok().and_then(|n| n.parse().ok()).unwrap_or(USUAL);
    let mut failures = Failures::default();
    let (mut done, mut refused, mut judged, mut held_back) = (0, 0, 0, Vec::new());
    // The compiler's own forms are written by it, and seldom by hand.
    for dialect in DIALECTS.into_iter().filter(|dialect| !matches!(*dialect, "canon" | "ir")) {
        // What computes is made by `generated`, with an end.
        let programs: Vec<_> = corpus::of(dialect).into_iter().filter(|program| !computes(program)).collect();
        for seed in 0..many {
            let mut dice = fastrand::Rng::with_seed(seed as u64 * 31 + 7);
            let (name, text) = spliced(&programs, &mut dice);
            let to = DIALECTS[dice.usize(..DIALECTS.len())];
            let what = format!("{dialect} {seed} ({name}) to {to}");
            let job = job(dialect, to, &name);
            let (outcome, written) = translate(&job, &text);
            match outcome.release {
                Ok(()) => {
                    done += 1;
                    if to == "linuxcnc" {
                        keep(&format!("{dialect} {seed}"), &written);
                    }
                    // The one work offset of a control without words for it is the one that is named.
                    let only = outcome.diagnostics.iter().find_map(|d| match d.fault {
                        Fault::AssumedWorkOffset { offset }
                            if job.to.dialect.caps.frames.work_offsets == 0 =>
                        {
                            Some(offset)
                        }
                        _ => None,
                    });
                    match second_opinion(&job, (dialect, &text), (to, &written), only) {
                        None => {}
                        Some(Ok(())) => judged += 1,
                        Some(Err(fault)) => failures.add(
                            &what,
                            format!(
                                "{fault}\n{}\n{}",
                                String::from_utf8_lossy(&text),
                                String::from_utf8_lossy(&written)
                            ),
                        ),
                    }
                }
                Err(Failure::Refused) => refused += 1,
                Err(Failure::VerificationFailed) => {
                    let told = rendered(&job, &name, &text, &outcome.diagnostics);
                    held_back.push(format!("── {what}\n{told}\n{}", String::from_utf8_lossy(&text)));
                }
            }
        }
    }
    println!(
        "{done} translated and verified, {judged} of them judged by the second interpreter too, {refused} refused"
    );
    println!("{} held back by the verification", held_back.len());
    if std::env::var_os("NCC_SPLICED").is_some() {
        held_back.iter().for_each(|program| println!("{program}"));
    }
    // A few by chance, where they are few programs.
    if held_back.len() > (done + refused) / MOST_HELD_BACK + 3 {
        failures.add("held back", held_back.join("\n"));
    }
    failures.finish();
}

/// Programs that were held back once, and are sayable.
const WRONG_ONCE: [(&str, &str, &str); 4] = [
    // The safe start calls a length off, which the thread would have taken up.
    (
        "linuxcnc",
        "fanuc",
        "G21 G17 G90 G94 G54\nT2 M6\nS900 M3\nG0 X12 Y8\nG33 Z-15 K1.5\nG0 X30\nG43 H2 Z20\nM5\nM2\n",
    ),
    // A line of modes that are in force already, between a feed and a tap with one of its own.
    (
        "siemens",
        "fanuc",
        "G17 G90 G71 G94 G40\nG54\nT5 M6\nD1\nS600 M3\nG0 X0 Y0\nZ20\nF200\nG17 G90 G71 G94 G40\n\
         MCALL CYCLE84(20,0,3,-18,,,3,,1.25,,500,500)\nX10 Y10\nMCALL\nG1 X40\nG0 Z50\nM30\n",
    ),
    // The first tool change by hand moves Z to machine zero by its own words, and the moves after it rely on that.
    (
        "grbl",
        "ir",
        "G21 G90 G94 G17 G54\nM5 M9 G53 G0 Z0 T1 M0 (6 mm flat)\nS10000 M3\nG4 P3\nG28 G91 Z0\nG90\n\
         G28 G91 X0 Y0\nG90 G94\nG0 X10 Y10\nZ15\nG1 Z-6 F100\nG0 Z15\nM5\nM30\n",
    ),
    // Under feed per revolution, F of a tap is its lead. (The second interpreter was wrong.)
    (
        "fanuc",
        "siemens",
        "%\nO1\nG21 G17 G40 G49 G80 G90 G94 G54\nT3 M06\nS1500 M03\nG00 X0 Y0\nG43 H3 Z20.\nG95\nM29 S1500\n\
         G84 X10. Y10. Z-8. R5. F1.25\nG80\nG94\nG00 Z50.\nM30\n%\n",
    ),
];

#[test]
fn what_was_wrong_once() {
    for (from, to, text) in WRONG_ONCE {
        let job = job(from, to, "once");
        let (outcome, written) = translate(&job, text.as_bytes());
        let told = rendered(&job, "once", text.as_bytes(), &outcome.diagnostics);
        assert!(outcome.release.is_ok(), "{from} to {to}: {told}");
        assert_eq!(
            second_opinion(&job, (from, text.as_bytes()), (to, &written), None),
            Some(Ok(())),
            "{from} to {to}"
        );
    }
}

/// A program of the corpus with up to four pieces of others put in, left out, or said twice.
fn spliced(programs: &[Program], dice: &mut fastrand::Rng) -> (String, Vec<u8>) {
    let of = |program: &Program| -> Vec<Vec<u8>> {
        program.text.split(|b| *b == b'\n').map(<[u8]>::to_vec).collect()
    };
    let base = &programs[dice.usize(..programs.len())];
    let mut lines = of(base);
    for _ in 0..dice.usize(1..5) {
        let at = dice.usize(..lines.len());
        match dice.u8(..6) {
            0 => drop(lines.remove(at)),
            1 => lines.insert(at, lines[at].clone()),
            _ => {
                let other = of(&programs[dice.usize(..programs.len())]);
                let from = dice.usize(..other.len());
                let to = (from + dice.usize(1..6)).min(other.len());
                lines.splice(at..at, other[from..to].iter().cloned());
            }
        }
        if lines.is_empty() {
            break;
        }
    }
    (base.file.clone(), lines.join(&b'\n'))
}

/// Whether a program of a Sinumerik, which has no other in its text, ends as one that is called.
fn goes_back(text: &[u8]) -> bool {
    let text = String::from_utf8_lossy(text);
    let last = text.lines().rev().find(|line| !line.trim().is_empty());
    !text.contains("%_N_") && last.is_some_and(|line| line.split_whitespace().last() == Some("M17"))
}

/// What the second interpreter says, if it runs both: the same moves or not, in two worlds.
fn second_opinion(
    job: &Job,
    (from, source): (&str, &[u8]),
    (to, written): (&str, &[u8]),
    only: Option<u16>,
) -> Option<Result<(), String>> {
    let text = String::from_utf8_lossy(written);
    let says = |word: &str| text.lines().any(|line| line.starts_with('o') && line.contains(word));
    if to == "linuxcnc" && says(" sub") && !says(" call") {
        // A subprogram by itself, which nothing calls.
        return None;
    }
    let corners = Corners::between(from, to);
    // A feed in inches has three digits.
    let within = Tolerance { corners, arcs: plain::says_arcs(to), feed: 0.015, ..Tolerance::ROUNDED };
    for seed in [0, 1] {
        let world = besides::zeroed(plain::of_dialect(plain::world(seed), from), [from, to]);
        let start = world.start.map(|n| n as f64 / 1e9);
        let list = |dialect: &str, text: &[u8], only: Option<u16>| {
            let mut setup = plain::setup(&world, 0);
            // As its dictionary has it at power-on.
            setup.power_on.inch = dialect == "haas";
            setup.power_on.offset = only.map_or(setup.power_on.offset, u32::from);
            let mut list = plain::of_machine(&plain::second(dialect, text, setup).ok()?, start);
            if [from, to].iter().any(|dialect| ["mach9", "fanuc", "haas"].contains(dialect)) {
                // Such a control shows a text where it stops, and none to be taken away.
                list.retain(|event| event.what != Happening::MessageCleared);
            }
            if let Some(last) =
                list.last_mut().filter(|_| dialect == "siemens" && from != "siemens" && goes_back(text))
            {
                // Where nothing calls it, it ends.
                last.what = Happening::TextEnd;
            }
            // A way as short as a rounding is one on the other side alone.
            let mut from = start;
            list.retain(|event| {
                let near = event.at.iter().zip(from).all(|(a, b)| (a - b).abs() < within.place);
                let straight = matches!(event.what, Happening::Traverse | Happening::Feed);
                if !(near && straight) {
                    from = event.at;
                }
                !(near && straight)
            });
            Some(list)
        };
        let expected = besides::for_target(list(from, source, None)?, job);
        if let Err(fault) = plain::compare(&expected, &list(to, written, only)?, within) {
            return Some(Err(fault));
        }
    }
    Some(Ok(()))
}
