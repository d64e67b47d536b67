//! Whether a program is translated does not depend on where its source is cut: a long one streams in pieces, and each of the
//! steps goes on where the piece before has left it. (What is taken for granted is stated with the piece that relies on it,
//! so that the text may differ.)

use ncc_driver::translate::rewrite::pass;
use ncc_tests::corpus;
use ncc_tests::translate::{job, translate};

/// Bytes of a piece; every program of the corpus has several of them.
const PIECE: usize = 300;

#[test]
fn a_program_in_many_pieces_is_translated_as_in_one() {
    let targets = ["fanuc", "siemens", "linuxcnc", "mach9", "grbl"];
    let mut differing = Vec::new();
    let mut cut = 0;
    // Whether a file is a subprogram alone is asked of its first piece.
    let subprograms = |program: &corpus::Program| {
        program.dialect == "linuxcnc" && program.text.windows(3).any(|word| word.eq_ignore_ascii_case(b"sub"))
    };
    for program in corpus::all().into_iter().filter(|program| !subprograms(program)) {
        let longest = program.text.split(|byte| *byte == b'\n').map(<[u8]>::len).max().unwrap_or(0);
        for to in targets.into_iter().filter(|_| longest < PIECE) {
            let mut job = job(program.dialect, to, &program.file);
            let (whole, _) = translate(&job, &program.text);
            job.piece = PIECE;
            let (pieces, _) = translate(&job, &program.text);
            cut += usize::from(program.text.len() > PIECE);
            if whole.release != pieces.release {
                let told = pieces.diagnostics.iter().filter(|found| !whole.diagnostics.contains(found));
                let told = told.map(|found| format!("{:?}", found.fault)).collect::<Vec<_>>().join(", ");
                differing.push(format!(
                    "{} {} to {to}: {:?}, {told}",
                    program.dialect, program.file, pieces.release
                ));
            }
        }
    }
    assert!(cut > 500, "{cut}");
    assert!(differing.is_empty(), "{} of {cut}:\n{}", differing.len(), differing.join("\n"));
}

/// Nor on which thread the verification runs, also where it stops: text, verdict and what is told are the same.
#[test]
fn a_program_is_verified_on_a_second_thread_as_on_one() {
    let targets = ["fanuc", "siemens"];
    let mut differing = Vec::new();
    for program in corpus::all() {
        let longest = program.text.split(|byte| *byte == b'\n').map(<[u8]>::len).max().unwrap_or(0);
        for to in targets.into_iter().filter(|_| longest < PIECE) {
            let mut job = job(program.dialect, to, &program.file);
            job.piece = PIECE;
            let (two, two_written) = translate(&job, &program.text);
            job.one_thread = true;
            let (one, one_written) = translate(&job, &program.text);
            let same = one.release == two.release
                && one_written == two_written
                && one.diagnostics == two.diagnostics
                && one.verified.map(|own| own.events) == two.verified.map(|own| own.events);
            if !same {
                differing.push(format!("{} {} to {to}: {:?}", program.dialect, program.file, two.release));
            }
        }
    }
    assert!(differing.is_empty(), "{}:\n{}", differing.len(), differing.join("\n"));
}

/// Nor on whether lines are read as tables: text, verdict and what is told are the same.
#[test]
fn a_program_in_tables_is_translated_as_in_statements() {
    let targets = ["fanuc", "haas", "siemens", "linuxcnc", "mach9", "grbl", "canon", "ir"];
    let mut differing = Vec::new();
    let inches = |text: &[u8]| String::from_utf8_lossy(text).replace("G21", "G20").into_bytes();
    let all = corpus::all().into_iter();
    for (program, in_inches) in all.flat_map(|program| [(program.clone(), false), (program, true)]) {
        let text = if in_inches { inches(&program.text) } else { program.text.clone() };
        if in_inches && text == program.text {
            continue;
        }
        for (to, one_thread) in targets.into_iter().zip([false, true].into_iter().cycle()) {
            let mut job = job(program.dialect, to, &program.file);
            (job.piece, job.one_thread) = (PIECE, one_thread);
            let (tables, tables_written) = translate(&job, &text);
            job.tables = false;
            let (plain, plain_written) = translate(&job, &text);
            let same = plain.release == tables.release
                && plain_written == tables_written
                && plain.diagnostics == tables.diagnostics
                && plain.counts == tables.counts
                && plain.verified.map(|own| own.events) == tables.verified.map(|own| own.events);
            if !same {
                differing.push(format!("{} {} to {to}: {:?}", program.dialect, program.file, tables.release));
            }
        }
    }
    assert!(differing.is_empty(), "{}:\n{}", differing.len(), differing.join("\n"));
}

/// A program with each plain move of it many times, so that there are stretches of them.
fn stretched(text: &[u8]) -> Vec<u8> {
    // Computed words stand in brackets, or behind an equals sign.
    let plain = |line: &[u8]| {
        let words = line.trim_ascii();
        let number = |byte: &u8| byte.is_ascii_digit() || b" .-XYZ#[]+*/=R".contains(byte);
        words.first().is_some_and(|first| b"XYZ".contains(first)) && words.iter().all(number)
    };
    let mut made = Vec::new();
    for line in text.split_inclusive(|byte| *byte == b'\n') {
        let times = if plain(line) { 16 } else { 1 };
        (0..times).for_each(|_| made.extend_from_slice(line));
    }
    made
}

/// Nor does it depend on whether stretches of moves are packed: text, verdict and what is told are the same.
#[test]
fn a_program_with_packed_moves_is_translated_as_with_all_of_them() {
    let targets = ["fanuc", "haas", "siemens", "linuxcnc", "mach9", "grbl"];
    let (mut differing, mut longer) = (Vec::new(), 0);
    let computing = corpus::DIALECTS.into_iter().flat_map(corpus::computing);
    let all = corpus::all().into_iter().chain(computing);
    // In small pieces, moves are packed while more of the program is read.
    let pieces = corpus::DIALECTS.into_iter().flat_map(corpus::computing).map(|own| (own, Some(200)));
    for (program, piece) in all.map(|own| (own, None)).chain(pieces) {
        let text = stretched(&program.text);
        longer += usize::from(text.len() > program.text.len());
        for to in targets {
            let mut job = job(program.dialect, to, &program.file);
            job.piece = piece.unwrap_or(job.piece);
            job.shortest_stretch = usize::MAX;
            let (all, written) = translate(&job, &text);
            job.shortest_stretch = 3;
            let (packed, packed_written) = translate(&job, &text);
            let same = all.release == packed.release
                && written == packed_written
                && all.diagnostics == packed.diagnostics
                && all.verified.map(|own| own.events) == packed.verified.map(|own| own.events);
            if !same {
                let told = packed.diagnostics.iter().filter(|found| !all.diagnostics.contains(found));
                let told = told.map(|found| format!("{:?}", found.fault)).collect::<Vec<_>>().join(", ");
                differing.push(format!("{} to {to}: {:?}, {told}", program.file, packed.release));
            }
        }
    }
    assert!(longer > 100, "{longer}");
    assert!(differing.is_empty(), "{}:\n{}", differing.len(), differing.join("\n"));
}

/// The same of what `flatten` executes: a step that changes moves changes all of them.
#[test]
fn a_program_that_is_executed_is_translated_packed_as_with_all_of_its_moves() {
    let flatten = pass("flatten").expect("a pass of that name");
    let (mut differing, mut flattened) = (Vec::new(), 0);
    for program in corpus::DIALECTS.into_iter().flat_map(corpus::computing) {
        let text = stretched(&program.text);
        for to in ["fanuc", "siemens", "linuxcnc", "mach9"] {
            let mut job = job(program.dialect, to, &program.file);
            job.passes = vec![flatten];
            job.shortest_stretch = usize::MAX;
            let (all, written) = translate(&job, &text);
            job.shortest_stretch = 3;
            let (packed, packed_written) = translate(&job, &text);
            flattened += usize::from(all.release.is_ok() && written.len() > 1000);
            let same = all.release == packed.release
                && written == packed_written
                && all.diagnostics == packed.diagnostics
                && all.counts == packed.counts
                && all.verified.map(|own| own.events) == packed.verified.map(|own| own.events);
            if !same {
                differing.push(format!("{} to {to}: {:?}", program.file, packed.release));
            }
        }
    }
    assert!(flattened > 50, "{flattened}");
    assert!(differing.is_empty(), "{}:\n{}", differing.len(), differing.join("\n"));
}
