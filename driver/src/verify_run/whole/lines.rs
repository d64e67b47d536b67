//! Stretches of plain moves of programs that are kept whole: executed once for both sides.
//!
//! ```text
//! source: X10. | output: X10    one state, the same words: one execution counts for both
//! ```
//!
//! Why that proves the same as two executions: a control is a function of its state and of the statement, and events are
//! made of nothing else. Where both states agree in all that a plain move reads (`Exec::agrees_on_lines`), and both statements say
//! the same ([`same_plain`]), both sides make the same event and reach states that agree again.
//!
//! Words that are computed are there as their values on each side: each program's own expressions, with its own
//! variables. No move gives a variable a value, so that what the next ones are worth is known before they are executed; and
//! a statement that has no value ends the ones that are looked at, so that the fault is found where it is.

use ncc_exec::Runner;
use ncc_exec::verify::same_plain;
use ncc_ir::diag::Diagnostic;

use super::super::forks::Forks;
use super::super::verifier::{Run, Verifier};

impl Verifier {
    /// Plain moves that come next in both programs, and are the same, are executed once where both controls are in one
    /// state, because both do the same; `false` where that is not so. Halts both where such moves begin, if they are not
    /// there.
    pub(super) fn pass_lines<'p>(
        &self,
        run: &mut Run,
        runners: &mut [Runner<'p>; 2],
        forks: Option<&Forks<'p>>,
    ) -> Result<bool, Diagnostic> {
        let [one, other] = runners;
        let there = !one.lines_ahead(&run.source).is_empty() || !other.lines_ahead(&run.target).is_empty();
        runners.iter_mut().for_each(|runner| runner.halt_at_lines(!there));
        let [one, other] = runners;
        let [source, target] = [one.lines_ahead(&run.source), other.lines_ahead(&run.target)];
        let same = source.iter().zip(target).take_while(|(a, b)| same_plain(a, b)).count();
        let (source, target) = (&source[..same], &target[..same]);
        let level = run.source_events.is_empty() && run.target_events.is_empty();
        if same == 0 || !level || self.renamed || self.watched {
            return Ok(false);
        }
        let quiet = forks.is_none_or(|forks| forks.let_pass([&run.source, &run.target], source));
        if !quiet || !run.source.agrees_on_lines(&run.target) || !run.source.counts_alike(&run.target, source)
        {
            return Ok(false);
        }
        let events = run.source.pass(source)?;
        run.target.follow(&run.source);
        run.target.has_moved(target);
        run.comparison.pass(events, run.source.machine());
        runners.iter_mut().try_for_each(|runner| runner.has_passed(same, events))?;
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use ncc_dialects::{Settings, builtin};
    use ncc_frontends::{Batch, Reader};
    use ncc_ir::program::Program;

    use super::super::super::verifier::Stop;
    use super::*;
    use crate::job::Job;
    use crate::stretches::{SHORTEST, Words, pack, stretches};

    /// A loop keeps the program whole; after it are plain moves.
    fn program(moves: &str) -> String {
        format!(
            "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT1 M06\nS500 M03\nG00 X0. Y0.\nG43 H1 Z5.\nG01 Z-1. F100.\n\
             #1=0\nWHILE [#1 LT 3] DO1\nX#1\n#1=#1+1\nEND1\nG01 X0.\n{moves}M30\n%\n"
        )
    }

    fn verified(said: &str, written: &str) -> Result<u64, Stop> {
        let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
        let job = Job::new(settings.clone(), settings, "lines.nc");
        let (mut reader, mut batch) = (Reader::new(job.from.clone(), true), Batch::default());
        reader.read(program(said).as_bytes(), 0, &mut batch);
        reader.finish(&mut batch);
        let mut body = std::mem::take(&mut batch.stmts);
        pack(&mut body, SHORTEST, Words::All);
        assert!(!stretches(&body).is_empty());
        let source =
            Program { assumed: batch.assumed, procedures: vec![batch.main(body)], ..Program::default() };
        let mut verifier = Verifier::new(&job);
        verifier.verify_rest(&source, program(written).as_bytes(), 0, &source.assumed)?;
        Ok(verifier.covered().events)
    }

    #[test]
    fn a_move_among_many_that_says_something_else_is_seen() {
        let moves: String = (0..100).map(|n| format!("X{n}.5 Y{}.\n", n % 7)).collect();
        let events = verified(&moves, &moves).expect("the same program");
        assert!(events > 200, "{events}");
        for (from, to) in
            [("X3.5", "X3.501"), ("X50.5", "X50.6"), ("X99.5", "G00 X99.5"), ("X98.5 Y0.\n", "")]
        {
            let written = moves.replacen(from, to, 1);
            assert!(matches!(verified(&moves, &written), Err(Stop::Target(_))), "{from} → {to}");
        }
    }

    /// The same of moves whose words are computed: what is compared is their values.
    #[test]
    fn a_computed_move_that_is_worth_something_else_is_seen() {
        let set = "#2=0.25\n";
        let moves: String = (0..200).map(|n| format!("X[#1+{n}.5] Y[{}.*#2]\n", n % 7)).collect();
        let (said, other) = (format!("{set}{moves}"), moves.replace("X[#1+", "X[3.+"));
        let events = verified(&said, &said).expect("the same program");
        assert!(events > 400, "{events}");
        assert_eq!(verified(&said, &format!("{set}{other}")).expect("the same values"), events);
        for (from, to) in [
            ("#2=0.25", "#2=0.26"),
            ("X[#1+3.5]", "X[#1+3.501]"),
            ("X[#1+100.5]", "X[#1+100.6]"),
            ("X[#1+100.5]", "X[#2+100.5]"),
            ("X[#1+101.5]", "X[#1-101.5]"),
            ("X[#1+198.5]", "G00 X[#1+198.5]"),
            ("X[#1+150.5] Y[3.*#2]\n", ""),
        ] {
            let written = said.replacen(from, to, 1);
            assert!(written != said && matches!(verified(&said, &written), Err(Stop::Target(_))), "{from}");
        }
    }
}
