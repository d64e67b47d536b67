//! Lines of a table that the text is to say one by one.
//!
//! ```text
//! source: X0.4 Z-0.1 | output: X0.4 Z-0.1    two rows with the same numbers: executed once for both controls
//! ```
//!
//! It is what [`Verifier::piece`] does with the statements of such lines, and rests on the same: both controls are in one
//! state, and read the same words from it. Where that is not so, the statements are compared.
//!
//! Not here: what a row is (`ncc_ir::program::line_table`).

use ncc_ir::canon::Modes;
use ncc_ir::program::line_table::LineTable;
use ncc_ir::program::rows::Rows;

use super::verifier::{Run, Stop, Verifier};

impl Verifier {
    /// A piece of which the text is to say the source's lines one by one: executes and compares both.
    pub fn table(
        &mut self,
        table: &LineTable,
        assumed: &Modes,
        text: &[u8],
        base: u32,
        inherited: &Modes,
    ) -> Result<(), Stop> {
        self.make_holes()?;
        let level = self.others.is_empty() && !self.watched && self.runs.iter().all(|run| run.level);
        if level {
            self.reader.read_to_table(text, base, &mut self.batch);
        } else {
            self.reader.read(text, base, &mut self.batch);
        }
        let same = level && self.batch.stmts.is_empty() && table.says_the_same(&self.batch.table);
        if same && self.pass_table(table, assumed, inherited)? {
            self.batch.table.clear();
            if let Some(row) = table.rows().last() {
                self.last = row.span();
            }
            return Ok(());
        }
        let mut stmts = Vec::new();
        table.unpack(&mut stmts);
        self.batch.unpack_table();
        self.piece_read(&stmts, assumed, inherited)
    }

    /// Executes lines that both texts say once for both controls; `false` where these are not in one state.
    fn pass_table(&mut self, table: &LineTable, assumed: &Modes, inherited: &Modes) -> Result<bool, Stop> {
        let absolute = |run: &Run| run.source.counts_absolute() && run.target.counts_absolute();
        if !(self.stood && self.runs.iter().all(absolute)) {
            return Ok(false);
        }
        self.assume(assumed);
        self.read_back(inherited)?;
        let rows = Rows::of(table);
        let mut valued = self.runs.first().and_then(|run| run.source.value_rows(rows));
        let agree = |run: &Run| run.source.agrees_on_rows(&run.target);
        let Some(valued) = valued.as_mut().filter(|_| self.runs.iter().all(agree)) else { return Ok(false) };
        for run in &mut self.runs {
            let events = run.source.pass_rows(rows, valued).map_err(Stop::Source)?;
            run.target.follow(&run.source);
            run.comparison.pass(events, run.source.machine());
        }
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify_run::tests::{FIRST, SECOND, job};
    use ncc_frontends::{Batch, Reader};

    /// Verifies a first piece as statements, and of a second one the lines that are read as a table, of which the output
    /// says something else.
    fn second_table(first: [&str; 2], said: &str, written: &str) -> Result<Verifier, Stop> {
        let job = job();
        let mut reader = Reader::new(job.from.clone(), true);
        let (mut verifier, mut batch) = (Verifier::new(&job), Batch::default());
        let [said_first, written_first] = first;
        reader.read(said_first.as_bytes(), 0, &mut batch);
        let stmts = std::mem::take(&mut batch.stmts);
        let first = verifier.piece(&stmts, &batch.assumed, written_first.as_bytes(), 0, &batch.assumed);
        first.expect("no difference yet");
        reader.read_to_table(said.as_bytes(), 0, &mut batch);
        assert!(batch.stmts.is_empty() && !batch.table.is_empty(), "{said}");
        verifier.table(&batch.table, &batch.assumed, written.as_bytes(), 0, &batch.assumed)?;
        Ok(verifier)
    }

    #[test]
    fn a_table_that_the_output_says_too_is_executed_once() {
        let verifier = second_table([FIRST; 2], SECOND, SECOND).expect("the same program");
        let once = |run: &Run| run.level && run.source.agrees(&run.target) && run.target_events.is_empty();
        assert!(verifier.runs.iter().all(once));
        // A tool change and three moves, then four moves, in each world.
        assert_eq!(verifier.covered().events, verifier.runs.len() as u64 * 8);
        // Numbers may be written otherwise.
        second_table([FIRST; 2], SECOND, "X10.00\nY10.0 Z-1.50\nX0. F200.\nG0 Z5.\n")
            .expect("the same program");
    }

    #[test]
    fn a_table_that_the_output_says_otherwise_is_seen() {
        for (from, to) in [
            ("Y10.", "Y10.001"),
            ("Y10.", "Y-10."),
            ("Y10. ", ""),
            ("F200.", "F201."),
            (" F200.", ""),
            ("G00 Z5.", "Z5."),
            ("X10.\n", ""),
            ("X10.\n", "X10.\nX11.\n"),
            ("Y10. Z-1.5\n", "G91 Y10. Z-1.5\nG90\n"),
            ("X10.\n", "X10.\nM5\n"),
        ] {
            let written = SECOND.replacen(from, to, 1);
            let seen = second_table([FIRST; 2], SECOND, &written);
            assert!(matches!(seen, Err(Stop::Target(_))), "{from} → {to}");
        }
    }

    /// The same words make other moves where the controls are in other states.
    #[test]
    fn a_table_is_compared_by_its_events_where_controls_differ() {
        for last in ["G91", "G52 X1.", "G20", "F90.", "G0", "G10 L2 P1 X1.", "M5"] {
            let seen = second_table([FIRST, &format!("{FIRST}{last}\n")], SECOND, SECOND);
            assert!(matches!(seen, Err(Stop::Target(_))), "{last}");
        }
    }
}
