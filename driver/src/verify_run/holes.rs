//! Holes of a program that streams: made once for both sides, where both controls make the same of them.
//!
//! ```text
//! source: X10. Y20. under G81 | output: X10 Y20 under MCALL CYCLE81    counted as the events that both make
//! ```
//!
//! The source is executed before its text is written, and for its effect on the state alone. When the text is read, and
//! says holes at the same places under a cycle that gives the same, the target's control follows: `ncc_exec` says why
//! that proves what two executions would (`moves::holes::same`). Anything else has the source executed event by event,
//! and compared.
//!
//! Where the target has no such cycle, and says moves in the place of each hole, both sides execute their statements, and
//! their straight moves are compared without the events that these are (`moves::holes::strokes`). Such a text is read as a
//! table.
//!
//! A piece that ends in many holes is taken as two: the statements before them are executed and compared by themselves, so
//! that the events of a piece with the beginning of a cycle are few too. The holes stand for both sides only if all
//! controls agree after those statements, and no run with another fact is left.
//!
//! Not here: plain moves ([`Verifier::piece`]), and programs that are kept whole.

use ncc_exec::are_holes;
use ncc_ir::program::rows::Rows;
use ncc_ir::program::{Op, Stmt};

use super::facts::{come_to, stopped};
use super::verifier::{HoleForm, HolesAhead, HolesMade, Run, Stop, Verifier};

/// Holes at the end of a piece of which fewer are executed with it.
const MANY: usize = 32;

fn is_silent(stmt: &Stmt) -> bool {
    matches!(stmt.op, Op::Comment(_) | Op::Blank)
}

/// Where the block begins after which statements are nothing but holes, these and remarks; their end, if there is none.
fn before_holes(stmts: &[Stmt]) -> usize {
    let other = |stmt: &Stmt| !is_silent(stmt) && !are_holes(std::slice::from_ref(stmt));
    let from = stmts.iter().rposition(other).map_or(0, |at| at + 1);
    let block = stmts[from..].iter().position(|stmt| !stmt.joined);
    block.map_or(stmts.len(), |at| from + at)
}

impl Verifier {
    /// Executes the source's holes for their effect alone, where the target is likely to make the same of them; `false`,
    /// and nothing done, where it is not.
    pub(super) fn hold_holes(&mut self, stmts: &[Stmt]) -> Result<bool, Stop> {
        let level = self.others.is_empty() && self.runs.iter().all(|run| run.level);
        let begins = stmts.iter().any(|stmt| matches!(stmt.op, Op::StartCycle(_)));
        self.holes_differ &= !begins;
        self.strokes_differ &= !begins;
        if !level || !are_holes(stmts) {
            return Ok(false);
        }
        // What the source assumes from here on, the target does when its text is read.
        if !self.holes_differ && self.runs.iter().all(|run| run.source.has_cycle_like(&run.target)) {
            self.pass_ahead(stmts, false)?;
            return Ok(true);
        }
        let along = |run: &Run| run.source.makes_strokes_of(&run.target);
        if self.strokes_differ || self.watched || !self.runs.iter().all(along) {
            return Ok(false);
        }
        self.strokes_differ = !self.pass_along(stmts)?;
        Ok(!self.strokes_differ)
    }

    /// Executes the source's holes for their strokes; `false`, and nothing done, where they make anything else.
    fn pass_along(&mut self, stmts: &[Stmt]) -> Result<bool, Stop> {
        let mut runs = Vec::with_capacity(self.runs.len());
        let valued = self.runs.first().and_then(|run| run.source.value_holes(stmts));
        for run in &self.runs {
            let mut behind = run.source.clone();
            let strokes = behind.pass_strokes(stmts, valued.as_ref()).map_err(Stop::Source)?;
            let Some(strokes) = strokes else { return Ok(false) };
            let events = strokes.len() as u64;
            runs.push(HolesMade { behind, form: HoleForm::Strokes(strokes), events });
        }
        self.hold(stmts, runs, false);
        Ok(true)
    }

    /// Executes the source's statements up to the holes with which they end, and these for their effect alone.
    pub(super) fn run_source_to_holes(&mut self, stmts: &[Stmt]) -> Result<(), Stop> {
        let from = before_holes(stmts);
        let held = self.holes_differ || self.renamed || self.watched;
        if held || from == 0 || stmts.len() - from < MANY {
            return self.run_source(stmts);
        }
        let (head, holes) = stmts.split_at(from);
        self.run_source(head)?;
        self.pass_ahead(holes, true)
    }

    fn pass_ahead(&mut self, stmts: &[Stmt], at_end: bool) -> Result<(), Stop> {
        let mut runs = Vec::with_capacity(self.runs.len());
        let valued = self.runs.first().and_then(|run| run.source.value_holes(stmts));
        for run in &self.runs {
            let (mut behind, mut places) = (run.source.clone(), Vec::with_capacity(stmts.len()));
            let events = behind.pass_holes(stmts, valued.as_ref(), &mut places).map_err(Stop::Source)?;
            runs.push(HolesMade { behind, form: HoleForm::Places(places), events });
        }
        self.hold(stmts, runs, at_end);
        Ok(())
    }

    fn hold(&mut self, stmts: &[Stmt], runs: Vec<HolesMade>, at_end: bool) {
        self.holes_ahead = Some(HolesAhead { stmts: stmts.to_vec(), runs, at_end });
        if let Some(stmt) = stmts.last() {
            self.last = stmt.span;
        }
    }

    /// Takes the holes out of the text just read with which it ends, where those of the source are at the end of a piece.
    pub(super) fn take_holes_read(&mut self) -> Option<Vec<Stmt>> {
        let ahead = self.holes_ahead.as_ref().filter(|ahead| ahead.at_end)?;
        let HoleForm::Places(places) = &ahead.runs.first()?.form else { return None };
        let holes = places.len();
        let read = &mut self.batch.stmts;
        let spoken = read.iter().enumerate().rev().filter(|(_, stmt)| !is_silent(stmt));
        let (from, first) = spoken.take(holes).last()?;
        (!first.joined && are_holes(&read[from..])).then(|| read.split_off(from))
    }

    /// Whether the text that comes next is likely to be the strokes of holes that the source has made: plain lines, which
    /// are read as a table.
    pub(super) fn reads_strokes(&self) -> bool {
        let first = self.holes_ahead.as_ref().and_then(|ahead| ahead.runs.first());
        matches!(first, Some(HolesMade { form: HoleForm::Strokes(_), .. }))
    }

    /// Lets holes pass that the text just read says as the source does; `false` where it does not. All that was read is
    /// statements then.
    pub(super) fn pass_holes(&mut self) -> Result<bool, Stop> {
        let along = self.reads_strokes();
        if !along || !self.batch.stmts.is_empty() {
            self.batch.unpack_table();
        }
        let Some(ahead) = &self.holes_ahead else { return Ok(false) };
        let (read, open) = (&self.batch.stmts, self.open[1]);
        let rows = Rows::of(&self.batch.table);
        let level = self.others.is_empty() && self.runs.iter().all(|run| run.level);
        let first = self.runs.first().filter(|_| along);
        // A table is lines by words from zero alone, which come to no open fact.
        let mut lines = first.and_then(|run| match rows.is_empty() {
            true => run.target.value_lines(read),
            false => run.target.value_rows(rows),
        });
        let holes = self.runs.first().filter(|_| !along).and_then(|run| run.target.value_holes(read));
        let same = self.runs.iter_mut().zip(&ahead.runs).all(|(run, made)| {
            level
                && (open == 0 || open & come_to(&run.target, read) == 0)
                && match (&made.form, &lines, &holes) {
                    (HoleForm::Places(places), _, Some(holes)) => {
                        run.source.makes_holes_of(&run.target) && run.target.has_holes_at(holes, places)
                    }
                    (HoleForm::Strokes(strokes), Some(lines), _) => {
                        run.source.makes_strokes_of(&run.target) && run.target.goes_along(lines, strokes)
                    }
                    (HoleForm::Places(_), _, None) | (HoleForm::Strokes(_), None, _) => false,
                }
        });
        if !same {
            let differ = if along { &mut self.strokes_differ } else { &mut self.holes_differ };
            *differ = level;
            self.batch.unpack_table();
            return self.make_holes().map(|()| false);
        }
        let ahead = self.holes_ahead.take().into_iter().flat_map(|ahead| ahead.runs);
        let last = self.last;
        for (run, made) in self.runs.iter_mut().zip(ahead) {
            run.source = made.behind;
            match &mut lines {
                None => run.target.follow(&run.source),
                Some(lines) => {
                    let (stmts, rows) = (&self.batch.stmts, Rows::of(&self.batch.table));
                    let passed = match rows.is_empty() {
                        true => run.target.pass_valued(lines).map_or_else(|| run.target.pass(stmts), Ok),
                        false => run.target.pass_rows(rows, lines),
                    };
                    passed.map_err(|fault| stopped(&fault, None, last))?;
                }
            }
            run.comparison.pass(made.events, run.source.machine());
        }
        self.batch.stmts.clear();
        self.batch.table.clear();
        Ok(true)
    }

    /// Executes holes that the source has passed for their effect alone, so that their events are compared; and has the
    /// events of lines that it has made ahead compared.
    pub(super) fn make_holes(&mut self) -> Result<(), Stop> {
        self.make_paced();
        match self.holes_ahead.take() {
            Some(ahead) => self.run_source(&ahead.stmts),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use ncc_dialects::{Settings, builtin};
    use ncc_frontends::{Batch, Reader};

    use super::*;
    use crate::job::Job;

    const HEAD: &str = "G71 G17 G90 G94 G40\nG54\nT1 M6\nD1\nG0 X0 Y0 S500 M3\nZ50\nF150\n";

    /// A reader of the source, and a verification in which, by itself, the output is executed for each piece.
    fn sides(by_itself: bool) -> (Reader, Verifier) {
        let settings = Settings::new(builtin("siemens").expect("a built-in dialect"));
        let job = Job::new(settings.clone(), settings, "holes.mpf");
        let mut verifier = Verifier::new(&job);
        if by_itself {
            verifier.watch();
        }
        (Reader::new(job.from.clone(), true), verifier)
    }

    /// Events of both sides, where the source calls a cycle up and makes holes in a later piece, and the output does it
    /// in these words.
    fn verified(cycles: [&str; 2], holes: [&str; 2], by_itself: bool) -> Result<u64, Stop> {
        let (mut reader, mut verifier) = sides(by_itself);
        let mut batch = Batch::default();
        let heads = cycles.map(|cycle| format!("{HEAD}{cycle}\n"));
        let ends = ["MCALL\nG0 Z50\nM30\n"; 2];
        for [said, written] in [heads.each_ref().map(String::as_str), holes, ends] {
            reader.read(said.as_bytes(), 0, &mut batch);
            let stmts = std::mem::take(&mut batch.stmts);
            verifier.source(&stmts, &batch.assumed)?;
            let held = verifier.holes_ahead.is_some();
            verifier.target(written.as_bytes(), 0, &batch.assumed)?;
            let passes = said == holes[0] && !by_itself;
            assert!(!passes || held == (cycles[0] == cycles[1]), "{cycles:?}");
        }
        verifier.finish()?;
        Ok(verifier.covered().events)
    }

    /// Events of both sides, where the source makes holes for which the output goes along these lines; and whether these
    /// were held against the strokes of the holes.
    fn verified_along(lines: &str, by_itself: bool) -> Result<(u64, bool), Stop> {
        let settings = |id| Settings::new(builtin(id).expect("a built-in dialect"));
        let job = Job::new(settings("siemens"), settings("fanuc"), "holes.mpf");
        let (mut reader, mut verifier) = (Reader::new(job.from.clone(), true), Verifier::new(&job));
        if by_itself {
            verifier.watch();
        }
        let (mut batch, mut along) = (Batch::default(), false);
        let head = "G21 G17 G90 G94 G40 G49 G80\nG54\nT1 M06\nG00 X0. Y0. S500 M03\nG43 H1 Z50.\nF150.\n";
        let first = "X0 Y0\n";
        let pieces = [
            (format!("{HEAD}{}\n{first}", CYCLES[0]), format!("{head}G00 Z2.\nG01 Z-20.\nG00 Z5.\n")),
            (HOLES.to_owned(), lines.to_owned()),
            ("MCALL\nG0 Z50\nM30\n".to_owned(), "G00 Z50.\nM30\n".to_owned()),
        ];
        for (at, (said, written)) in pieces.iter().enumerate() {
            reader.read(said.as_bytes(), 0, &mut batch);
            let stmts = std::mem::take(&mut batch.stmts);
            verifier.source(&stmts, &batch.assumed)?;
            let held = verifier.reads_strokes();
            verifier.target(written.as_bytes(), 0, &batch.assumed)?;
            along |= held && at == 1 && !verifier.strokes_differ;
        }
        verifier.finish()?;
        Ok((verifier.covered().events, along))
    }

    #[test]
    fn lines_along_the_strokes_of_holes_count_as_all_events_that_both_make() {
        let places = ["X1. Y1.", "X2.5", "Y7.", "X-3. Y4.", "X0. Y0."];
        let hole = |place: &str| format!("G00 {place}\nG00 Z2.\nG01 Z-20.\nG00 Z5.\n");
        let lines: String = places.map(hole).concat();
        let remarks = lines.replacen("Z-20.\n", "Z-20. (A REMARK)\n", 3);
        for lines in [&lines, &remarks] {
            let events = |by_itself| verified_along(lines, by_itself).expect("the same program");
            assert_eq!([events(false), events(true)], [(events(true).0, true), (events(false).0, false)]);
        }
        for (from, to) in [
            ("X2.5", "X2.501"),
            ("Y7.\n", "Y7.\nY7.001\n"),
            ("G01 Z-20.\nG00 Z5.\nG00 Y7.", "G01 Z-20.01\nG00 Z5.\nG00 Y7."),
            ("G01 Z-20.\nG00 Z5.\nG00 Y7.", "G00 Z-20.\nG00 Z5.\nG00 Y7."),
            ("G01 Z-20.\nG00 Z5.\nG00 Y7.", "G01 Z-20.\nG01 Z5.\nG00 Y7."),
            ("G01 Z-20.\nG00 Z5.\nG00 Y7.", "G01 Z-20. F151.\nG00 Z5.\nG00 Y7."),
            ("G00 X0. Y0.\nG00 Z2.\nG01 Z-20.\nG00 Z5.\n", ""),
        ] {
            for lines in [&lines, &remarks] {
                let written = lines.replacen(from, to, 1);
                let verdict = verified_along(&written, false);
                assert!(written == **lines || matches!(verdict, Err(Stop::Target(_))), "{from} → {to}");
            }
        }
    }

    const HOLES: &str = "X1 Y1\nX2.5\nY7\n; a remark\nX-3 Y4\nX0 Y0\n";

    const CYCLES: [&str; 6] = [
        "MCALL CYCLE81(5,0,2,-20)",
        "MCALL CYCLE81(2,0,2,-20)",
        "MCALL CYCLE82(5,0,2,-20,,1)",
        "MCALL CYCLE83(5,0,2,-20,,-4,,0,0,0,1,1)",
        "MCALL CYCLE83(5,0,2,-20,,-5,,0,0,0,1,1)",
        "MCALL CYCLE83(5,0,2,-20,,-5,,0,0,0,1,0)",
    ];

    #[test]
    fn holes_count_as_all_events_that_both_make() {
        for cycle in CYCLES {
            let events = |by_itself| verified([cycle; 2], [HOLES; 2], by_itself).expect("the same program");
            assert_eq!(events(false), events(true), "{cycle}");
        }
    }

    #[test]
    fn another_cycle_is_seen() {
        for (said, written) in CYCLES.iter().flat_map(|a| CYCLES.iter().map(move |b| (a, b))) {
            let verdict = verified([said, written], [HOLES; 2], false);
            assert_eq!(verdict.is_ok(), said == written, "{said} and {written}");
        }
    }

    /// Nothing is reported of these before a hole is made with them.
    #[test]
    fn another_state_is_seen() {
        for state in ["F151", "S501", "M4", "G55", "M8", "G91"] {
            let written = format!("{}\n{state}", CYCLES[0]);
            assert!(verified([CYCLES[0], &written], [HOLES; 2], false).is_err(), "{state}");
        }
    }

    #[test]
    fn another_place_is_seen() {
        for (from, to) in [
            ("Y7", "Y7.001"),
            ("X0 Y0\n", ""),
            ("X2.5\n", ""),
            ("X0 Y0", "X0 Y0\nX0 Y0"),
            ("X-3 Y4", "X-3 Y4.5"),
        ] {
            let written = HOLES.replacen(from, to, 1);
            let verdict = verified([CYCLES[0]; 2], [HOLES, &written], false);
            assert!(matches!(verdict, Err(Stop::Target(_))), "{from} → {to}");
        }
    }

    /// Events of both sides, where the source calls a cycle up and makes many holes in the same piece; and whether one
    /// execution of the holes stood for both.
    fn verified_at_end(heads: [&str; 2], holes: [&str; 2], by_itself: bool) -> Result<(u64, bool), Stop> {
        let (mut reader, mut verifier) = sides(by_itself);
        let mut batch = Batch::default();
        let [said, written] = [0, 1].map(|side| format!("{HEAD}{}\n{}", heads[side], holes[side]));
        reader.read(said.as_bytes(), 0, &mut batch);
        let stmts = std::mem::take(&mut batch.stmts);
        verifier.source(&stmts, &batch.assumed)?;
        verifier.target(written.as_bytes(), 0, &batch.assumed)?;
        let once = verifier.runs.iter().all(|run| run.level && run.source_events.capacity() < 100);
        let end = "MCALL\nG0 Z50\nM30\n";
        reader.read(end.as_bytes(), 0, &mut batch);
        verifier.source(&batch.stmts, &batch.assumed)?;
        verifier.target(end.as_bytes(), 0, &batch.assumed)?;
        verifier.finish()?;
        Ok((verifier.covered().events, once))
    }

    fn many() -> String {
        (0..200)
            .map(|n| format!("X{n} Y{}\n{}", n % 7, if n % 50 == 9 { "; a remark\n" } else { "" }))
            .collect()
    }

    #[test]
    fn holes_behind_their_cycle_count_as_all_events_that_both_make() {
        let holes = many();
        for cycle in CYCLES {
            let events =
                |by_itself| verified_at_end([cycle; 2], [&holes; 2], by_itself).expect("the same program");
            assert_eq!([events(false), events(true)], [(events(true).0, true), (events(false).0, false)]);
        }
    }

    #[test]
    fn another_hole_behind_its_cycle_is_seen() {
        let holes = many();
        for (from, to) in [
            ("X150 Y3", "X150 Y3.001"),
            ("X0 Y0\n", ""),
            ("X199 Y3\n", ""),
            ("X199 Y3", "X199 Y3\nX199 Y3"),
            ("X10 Y3", "F151\nX10 Y3"),
            ("X10 Y3", "G0 X10 Y3 Z50\nMCALL\nMCALL CYCLE81(2,0,2,-20)"),
        ] {
            let written = holes.replacen(from, to, 1);
            assert!(written != holes, "{from}");
            let verdict = verified_at_end([CYCLES[0]; 2], [&holes, &written], false);
            assert!(matches!(verdict, Err(Stop::Target(_))), "{from} → {to}");
        }
        for (said, written) in CYCLES.iter().flat_map(|a| CYCLES.iter().map(move |b| (a, b))) {
            let verdict = verified_at_end([said, written], [&holes; 2], false);
            assert_eq!(verdict.is_ok(), said == written, "{said} and {written}");
        }
        for state in ["F151", "S501", "M4", "G55", "M8", "G91"] {
            let written = format!("{}\n{state}", CYCLES[0]);
            assert!(verified_at_end([CYCLES[0], &written], [&holes; 2], false).is_err(), "{state}");
        }
    }

    /// Lines in the place of [`HOLES`] under the first cycle.
    fn lines() -> String {
        let place = |place: &str| match place.starts_with(';') {
            true => format!("{place}\n"),
            false => format!("G0 {place}\nG0 Z2\nG1 Z-20\nG0 Z5\n"),
        };
        HOLES.lines().map(place).collect()
    }

    /// Events of both sides, where the output says lines for holes; whether the last of them passed without events.
    fn verified_by_lines(
        [said, written]: [&str; 2],
        state: &str,
        by_itself: bool,
    ) -> Result<(u64, bool), Stop> {
        let (mut reader, mut verifier) = sides(by_itself);
        let mut batch = Batch::default();
        let (cycle, first) = (format!("{HEAD}{}\nX8 Y9\n", CYCLES[0]), "G0 X8 Y9\nZ2\nG1 Z-20\nG0 Z5\n");
        let first = format!("{HEAD}{first}{state}");
        let mut passed = false;
        for [said, written] in
            [[&*cycle, &*first], [said, written], ["MCALL\nG0 Z50\nM30\n", "G0 Z50\nM30\n"]]
        {
            reader.read(said.as_bytes(), 0, &mut batch);
            let stmts = std::mem::take(&mut batch.stmts);
            verifier.source(&stmts, &batch.assumed)?;
            let held = verifier.holes_ahead.is_some();
            verifier.target(written.as_bytes(), 0, &batch.assumed)?;
            passed |= held && !verifier.strokes_differ;
        }
        verifier.finish()?;
        Ok((verifier.covered().events, passed))
    }

    #[test]
    fn lines_for_holes_count_as_all_events_that_both_make() {
        let lines = lines();
        let [short, long] = [false, true]
            .map(|by_itself| verified_by_lines([HOLES, &lines], "", by_itself).expect("the same"));
        assert_eq!([(long.0, true), (short.0, false)], [short, long]);
    }

    #[test]
    fn other_lines_for_holes_are_seen() {
        let lines = lines();
        for (from, to) in [
            ("G0 X2.5\n", "G0 X2.501\n"),
            ("G0 X2.5\n", "G1 X2.5\n"),
            ("G0 Z2\nG1", "G1 Z2\nG1"),
            ("G0 Z2\nG1", "G0 Z1.9\nG1"),
            ("G1 Z-20", "G0 Z-20"),
            ("G1 Z-20", "G1 Z-20.001"),
            ("G1 Z-20", "G1 Z-19\nG1 Z-20"),
            ("G0 X0 Y0\nG0 Z2\nG1 Z-20\nG0 Z5\n", ""),
            ("G0 X0 Y0\n", "F151\nG0 X0 Y0\n"),
            ("G0 X0 Y0\n", "M8\nG0 X0 Y0\n"),
            ("G0 X0 Y0\nG0 Z2", "G0 X0 Y0 Z2"),
        ] {
            let written = lines.replacen(from, to, 1);
            assert!(written != lines, "{from}");
            let verdict = verified_by_lines([HOLES, &written], "", false);
            assert!(matches!(verdict, Err(Stop::Target(_))), "{from} → {to}: {verdict:?}");
        }
        for state in ["F151", "S501", "M4", "G55", "M8", "G91"] {
            let verdict = verified_by_lines([HOLES, &lines], &format!("{state}\n"), false);
            assert!(verdict.is_err(), "{state}");
        }
    }
}
