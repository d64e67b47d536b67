//! Arcs of a program that streams: executed once for both sides, where both controls accept them alike.
//!
//! ```text
//! source: G2 X10. Y0. R5. | output: G2 X10 Y0 CR=5    counted as the events that both make
//! ```
//!
//! The source is executed before its text is written, and for its effect on the state alone. When the text is read, and
//! says the same arcs and lines, the target's control follows: `ncc_exec` says why that proves what two executions would
//! (`moves::arcs::same`). Anything else has the source executed once more, from where it stood, and compared event by
//! event. No open fact of a control concerns such arcs: a time of the block, a contour and rotary axes are left to
//! execution.
//!
//! Not here: plain moves alone ([`Verifier::piece`]), and programs that are kept whole.

use ncc_exec::are_arcs;
use ncc_exec::verify::same_arcs;
use ncc_ir::canon::Modes;
use ncc_ir::program::Stmt;

use super::levels::levels;
use super::verifier::{ArcsMade, Run, Stop, Verifier};

impl Verifier {
    /// Executes statements of the source that the output is to say one by one: for their effect alone, where the target is
    /// likely to make the same arcs of them. [`Verifier::target_saying`] is called next.
    pub fn source_said(&mut self, stmts: &[Stmt], assumed: &Modes) -> Result<(), Stop> {
        self.make_holes()?;
        self.prepare(stmts, assumed);
        if self.hold_arcs(stmts)? {
            return Ok(());
        }
        self.run_source(stmts)
    }

    fn hold_arcs(&mut self, stmts: &[Stmt]) -> Result<bool, Stop> {
        let takes = |run: &Run| run.level && run.source.takes_arcs();
        if !self.others.is_empty() || !self.runs.iter().all(takes) || !are_arcs(stmts) {
            return Ok(false);
        }
        let mut made = Vec::with_capacity(self.runs.len());
        for run in &mut self.runs {
            let before = run.source.clone();
            match run.source.pass_arcs(stmts, &run.target).map_err(Stop::Source)? {
                Some(events) => made.push(ArcsMade { before, events }),
                None => {
                    run.source = before;
                    self.put_back(made);
                    return Ok(false);
                }
            }
        }
        self.arcs_ahead = Some(made);
        if let Some(stmt) = stmts.last() {
            self.last = stmt.span;
        }
        Ok(true)
    }

    /// The source's controls stand where they stood before arcs.
    fn put_back(&mut self, made: Vec<ArcsMade>) {
        for (run, made) in self.runs.iter_mut().zip(made) {
            run.source = made.before;
        }
    }

    /// Reads a piece of emitted text back that is to say these statements of the source, which has executed them
    /// ([`Verifier::source_said`]), and compares.
    pub fn target_saying(
        &mut self,
        stmts: &[Stmt],
        text: &[u8],
        base: u32,
        inherited: &Modes,
    ) -> Result<(), Stop> {
        self.reader.read(text, base, &mut self.batch);
        self.read_back(inherited)?;
        match self.pass_arcs(stmts)? {
            true => Ok(()),
            false => self.target_step(),
        }
    }

    /// Lets arcs pass that the text just read says as the source does; `false` where it does not, or none are ahead.
    fn pass_arcs(&mut self, stmts: &[Stmt]) -> Result<bool, Stop> {
        let Some(made) = self.arcs_ahead.take() else { return Ok(false) };
        let levels = levels(stmts);
        let agree = self.runs.iter().zip(&made).all(|(run, made)| {
            made.before.makes_arcs_of(&run.target) && made.before.skips_as(&run.target, levels)
        });
        if !agree || !same_arcs(stmts, &self.batch.stmts) {
            self.put_back(made);
            return self.run_source(stmts).map(|()| false);
        }
        for (run, made) in self.runs.iter_mut().zip(&made) {
            run.target.follow(&run.source);
            run.comparison.pass(made.events, run.source.machine());
        }
        self.batch.stmts.clear();
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use ncc_dialects::{Settings, builtin};
    use ncc_frontends::{Batch, Reader};
    use ncc_ir::expr::Expr;
    use ncc_ir::program::Op;
    use ncc_ir::source::Span;

    use super::*;
    use crate::job::Job;

    const HEADS: [&str; 2] = [
        "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT1 M06\nS500 M03\nG00 X0. Y0.\nG43 H1 Z5.\nG01 Z-1. F100.\n",
        "G71 G17 G90 G40 G94\nG54\nT1 M6\nS500 M3\nG0 X0 Y0\nD1 Z5\nG1 Z-1 F100\n",
    ];

    const ARCS: [&str; 2] = [
        "G02 X10. Y0. I5. J0.\nG03 X20. Y10. R10. F200.\n(A REMARK)\nG01 X21.\nG02 X20. Y11. Z-2. R1.\nG01 X0. Y0.\n",
        "G2 X10 Y0 I5\nG3 X20 Y10 CR=10 F200\nG1 X21\nG2 X20 Y11 Z-2 CR=1\n; another remark\nG1 X0 Y0\n",
    ];

    /// Events of both sides, where a later piece has arcs, and whether one execution stood for both. By itself the output
    /// is executed for each piece.
    fn verified([said, written]: [&str; 2], by_itself: bool) -> Result<(u64, bool), Stop> {
        let settings = |id| Settings::new(builtin(id).expect("a built-in dialect"));
        let job = Job::new(settings("fanuc"), settings("siemens"), "arcs.nc");
        let (mut reader, mut batch) = (Reader::new(job.from.clone(), true), Batch::default());
        let mut verifier = Verifier::new(&job);
        if by_itself {
            verifier.watch();
        }
        let mut once = false;
        for [said, written] in [HEADS, [said, written], ["M30\n", "M30\n"]] {
            reader.read(said.as_bytes(), 0, &mut batch);
            let stmts = std::mem::take(&mut batch.stmts);
            verifier.source_said(&stmts, &batch.assumed)?;
            verifier.reader.read(written.as_bytes(), 0, &mut verifier.batch);
            verifier.read_back(&batch.assumed)?;
            match verifier.pass_arcs(&stmts)? {
                true => once = true,
                false => verifier.target_step()?,
            }
        }
        verifier.finish()?;
        Ok((verifier.covered().events, once))
    }

    #[test]
    fn arcs_count_as_all_events_that_both_make() {
        let events = |by_itself| verified(ARCS, by_itself).expect("the same program");
        assert_eq!(events(false), (events(true).0, true));
    }

    #[test]
    fn another_arc_is_seen() {
        for (from, to) in [
            ("X10 Y0 I5", "X10 Y0 I5.1"),
            ("X10 Y0 I5", "X10.002 Y0 I5.001"),
            ("G2 X10", "G3 X10"),
            ("CR=10", "CR=-10"),
            ("CR=10", "CR=10.01"),
            ("F200", "F201"),
            ("Z-2", "Z-2.002"),
            ("G1 X21\n", ""),
            ("G1 X0 Y0", "G0 X0 Y0"),
            ("G2 X10", "S501\nG2 X10"),
            ("G2 X10", "G18\nG2 X10"),
        ] {
            let written = ARCS[1].replacen(from, to, 1);
            let verdict = verified([ARCS[0], &written], false);
            assert!(written != ARCS[1] && matches!(verdict, Err(Stop::Target(_))), "{from} → {to}");
        }
    }

    /// The source has executed its arcs before anything is known of the target's state where its text begins.
    #[test]
    fn another_state_of_the_target_is_seen() {
        let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
        let job = Job::new(settings.clone(), settings, "arcs.nc");
        let (mut reader, mut batch) = (Reader::new(job.from.clone(), true), Batch::default());
        let mut verifier = Verifier::new(&job);
        let mut read = |text: &str| {
            reader.read(text.as_bytes(), 0, &mut batch);
            (std::mem::take(&mut batch.stmts), batch.assumed)
        };
        let (stmts, assumed) = read(HEADS[0]);
        verifier.source_said(&stmts, &assumed).expect("a head");
        verifier.target_saying(&stmts, HEADS[0].as_bytes(), 0, &assumed).expect("the same head");
        let arc = "G02 X10. Y0. I5. J0.\n";
        let (stmts, assumed) = read(arc);
        verifier.source_said(&stmts, &assumed).expect("an arc");
        assert!(verifier.arcs_ahead.is_some());
        let faster = Stmt::new(Span::default(), Op::SetFeedRate(Expr::int(101)));
        for run in &mut verifier.runs {
            run.target.step(&faster, &mut run.target_events).expect("a feed");
        }
        let verdict = verifier.target_saying(&stmts, arc.as_bytes(), 0, &assumed);
        assert!(matches!(verdict, Err(Stop::Target(_))));
    }

    /// Radii at start and end that differ: what one control accepts alone is seen, as where both are executed.
    #[test]
    fn an_arc_that_the_target_refuses_is_seen() {
        let mut refused = 0;
        for off in 0..60 {
            let radius = format!("5.{off:03}");
            let arcs = [format!("G02 X10. Y0. I{radius}\n"), format!("G2 X10 Y0 I{radius}\n")];
            let both = [false, true].map(|by_itself| verified([&arcs[0], &arcs[1]], by_itself));
            let told = both.each_ref().map(|verdict| match verdict {
                Ok(_) => 0,
                Err(Stop::Source(_)) => 1,
                Err(Stop::Target(_)) => 2,
            });
            assert_eq!(told[0], told[1], "{off}");
            refused += u32::from(told[0] == 2);
        }
        assert!(refused > 0, "the rules of both controls differ");
    }
}
