//! Lines that turn rotary axes, in a program that streams: compared by their moves, where both controls go by their words
//! alone.
//!
//! ```text
//! source: G94 X10. A90. F100. | output: G93 X10 A90 F1.104    one move each, of one end point and time
//! ```
//!
//! The source is executed before its text is written, as a copy of its control. When the text is read, a copy of the
//! target's control executes that, and the moves of both are compared: `ncc_exec` says why that proves what a comparison of
//! events would (`moves::lines::paced`). Anything else has the source's moves compared as the events that they are.
//!
//! Where a fact of either control is open that these lines reach, they are left to execution, with a run for each of
//! its values.
//!
//! Not here: lines without rotary axes ([`Verifier::piece`]), and programs that are kept whole.

use ncc_ir::program::Stmt;

use super::facts::come_to;
use super::levels::levels;
use super::verifier::{PacedMade, Run, Verifier};

impl Verifier {
    /// Executes the source's lines for their moves, where the target is likely to make the same; `false`, and nothing done,
    /// where it is not.
    pub(super) fn hold_paced(&mut self, stmts: &[Stmt]) -> bool {
        let paces = |run: &Run| run.level && run.source.paces_as(&run.target);
        if !self.others.is_empty() || self.watched || !self.runs.iter().all(paces) {
            return false;
        }
        let Some(lines) = self.runs.first().and_then(|run| run.source.value_paced(stmts)) else {
            return false;
        };
        let mut made = Vec::with_capacity(self.runs.len());
        for run in &self.runs {
            let mut behind = run.source.clone();
            let Some(moves) = behind.pass_paced(&lines) else { return false };
            made.push(PacedMade { behind, moves });
        }
        self.paced_ahead = Some(made);
        if let Some(stmt) = stmts.last() {
            self.last = stmt.span;
        }
        true
    }

    /// Lets lines pass whose moves the text just read makes as the source does; `false` where it does not, or none are
    /// ahead.
    pub(super) fn pass_paced(&mut self) -> bool {
        let Some(targets) = self.paced_targets() else {
            self.make_paced();
            return false;
        };
        let made = self.paced_ahead.take().unwrap_or_default();
        for (run, (made, target)) in self.runs.iter_mut().zip(made.into_iter().zip(targets)) {
            (run.source, run.target) = (made.behind, target.behind);
            run.comparison.pass(made.moves.len() as u64, run.source.machine());
        }
        self.batch.stmts.clear();
        true
    }

    /// The target's controls after the text just read, if all make the moves of it that the source has made.
    fn paced_targets(&self) -> Option<Vec<PacedMade>> {
        let ahead = self.paced_ahead.as_ref().filter(|_| self.others.is_empty())?;
        let (read, open) = (&self.batch.stmts, self.open[1]);
        let comes = open != 0 && !self.met_by(|run| open & come_to(&run.target, read)).is_empty();
        // Reading may have told the target's controls more since the source was executed.
        let paces = |run: &Run| run.level && run.source.paces_as(&run.target);
        if comes || levels(read) & !self.levels != 0 || !self.runs.iter().all(paces) {
            return None;
        }
        let lines = self.runs.first()?.target.value_paced(read)?;
        let mut targets = Vec::with_capacity(self.runs.len());
        for (run, made) in self.runs.iter().zip(ahead) {
            let mut behind = run.target.clone();
            let moves = behind.pass_paced(&lines)?;
            if !run.comparison.same_paced(&made.moves, &moves, lines.inch()) {
                return None;
            }
            targets.push(PacedMade { behind, moves });
        }
        Some(targets)
    }

    /// Has the moves that the source has made ahead compared as events.
    pub(super) fn make_paced(&mut self) {
        let Some(made) = self.paced_ahead.take() else { return };
        for (run, PacedMade { behind, moves }) in self.runs.iter_mut().zip(made) {
            run.source_events.extend(behind.events_of(&moves));
            run.source = behind;
        }
    }
}

#[cfg(test)]
mod tests {
    use ncc_dialects::{Settings, builtin};
    use ncc_frontends::{Batch, Reader};
    use ncc_ir::behaviour::Behaviour;

    use super::*;
    use crate::job::Job;
    use crate::verify_run::Stop;

    const HEADS: [&str; 2] = [
        "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT1 M06\nS500 M03\nG00 X0. Y0. A0.\nG43 H1 Z5.\nG01 Z-1. F100.\n",
        "G71 G17 G90 G40 G94\nG54\nT1 M6\nS500 M3\nG0 X0 Y0 A0\nD1 Z5\nG1 Z-1 F100\n",
    ];

    /// A degree counts as a millimetre on the source's control: 100 mm each.
    const LINES: [&str; 2] = [
        "G01 X72. A89. F100.\n(A REMARK)\nY80. A29. F200.\nG00 Z5. A0.\nX0.\nG01 Z-1. F100.\nY20. A80.\n",
        "G93 X72 A89 F1\nY80 A29 F2\nG0 Z5 A0\n; another remark\nX0\nG94 G1 Z-1 F100\nG93 Y20 A80 F1\n",
    ];

    /// Events of both sides, where a later piece has such lines, and whether these passed by their moves. By itself the
    /// output is executed for each piece.
    fn verified([said, written]: [&str; 2], by_itself: bool) -> Result<(u64, bool), Stop> {
        let settings = |id| Settings::new(builtin(id).expect("a built-in dialect"));
        let job = Job::new(settings("fanuc"), settings("siemens"), "lines.nc");
        let (mut reader, mut batch) = (Reader::new(job.from.clone(), true), Batch::default());
        let mut verifier = Verifier::new(&job);
        if by_itself {
            verifier.watch();
        }
        let mut passed = false;
        // The first lines by time are met with a run for each value of what F counts.
        let first = ["G01 X12. A9. F100.\n", "G93 X12 A9 F6.667\n"];
        let pieces = [HEADS, first, [said, written], ["G00 Z50.\nM30\n", "G94 G0 Z50\nM30\n"]];
        for [said, written] in pieces {
            reader.read(said.as_bytes(), 0, &mut batch);
            let stmts = std::mem::take(&mut batch.stmts);
            verifier.source(&stmts, &batch.assumed)?;
            let held = verifier.paced_ahead.is_some();
            verifier.target(written.as_bytes(), 0, &batch.assumed)?;
            let compared = |run: &Run| run.source_events.capacity() > 0 && said == LINES[0];
            passed |= held && verifier.runs.iter().all(|run| run.level && !compared(run));
        }
        verifier.finish()?;
        Ok((verifier.covered().events, passed))
    }

    #[test]
    fn paced_lines_count_as_all_events_that_both_make() {
        let events = |by_itself| verified(LINES, by_itself).expect("the same program");
        assert_eq!([events(false), events(true)], [(events(true).0, true), (events(false).0, false)]);
    }

    #[test]
    fn other_moves_are_seen() {
        for (from, to) in [
            ("X72 A89", "X72.001 A89"),
            ("X72 A89", "X72 A89.001"),
            ("A89 F1", "A89 F1.01"),
            ("F2", "F2.02"),
            ("Y80 A29 F2\n", ""),
            ("Y80 A29 F2\n", "Y80 F2\nA29 F2\n"),
            ("G0 Z5 A0", "G0 Z5 A360"),
            ("G0 Z5 A0", "G1 Z5 A0 F9"),
            ("X0\n", "X0 A0.5\n"),
            ("G94 G1 Z-1 F100", "G1 Z-1 F100"),
            ("G94 G1 Z-1 F100", "G94 G1 Z-1 F101"),
            ("G93 Y20", "Y20"),
            ("G0 Z5 A0", "S501\nG0 Z5 A0"),
            ("G0 Z5 A0", "G55\nG0 Z5 A0"),
        ] {
            let written = LINES[1].replacen(from, to, 1);
            assert!(written != LINES[1], "{from}");
            let verdict = verified([LINES[0], &written], false);
            assert!(matches!(verdict, Err(Stop::Target(_))), "{from} → {to}: {verdict:?}");
        }
    }

    /// What a feed counts with rotary axes is open for the target's control: with another value of it, such lines differ.
    #[test]
    fn an_open_fact_that_lines_come_to_is_tried() {
        let settings = |id| Settings::new(builtin(id).expect("a built-in dialect"));
        let job = Job::new(settings("fanuc"), settings("siemens"), "lines.nc");
        let (mut reader, mut batch) = (Reader::new(job.from.clone(), true), Batch::default());
        let mut verifier = Verifier::new(&job);
        let own = job.from.behaviours().get(Behaviour::RotaryFeed);
        for run in &mut verifier.runs {
            run.target.behave(Behaviour::RotaryFeed, own);
        }
        let plainly = ["G01 X10. A9. F100.\nY5. A3.\nX20. A9.\n", "X10 A9 F100\nY5 A3\nX20 A9\n"];
        for [said, written] in [HEADS, plainly] {
            reader.read(said.as_bytes(), 0, &mut batch);
            let stmts = std::mem::take(&mut batch.stmts);
            verifier.source(&stmts, &batch.assumed).expect("the source");
            verifier.target(written.as_bytes(), 0, &batch.assumed).expect("the same with the usual value");
        }
        let feed = |other: &super::super::verifier::Other| {
            matches!(other, super::super::verifier::Other::Behaviour { behaviour, source: false, .. }
                if *behaviour == Behaviour::RotaryFeed)
        };
        assert!(verifier.matters.iter().any(|(other, _)| feed(other)), "{:?}", verifier.matters);
    }
}
