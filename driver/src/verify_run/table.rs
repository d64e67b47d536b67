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
use ncc_ir::program::Stmt;
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
        let agree = |run: &Run| run.source.agrees_on_lines(&run.target) && !run.target.carries_linear();
        let mut valued = self.runs.first().and_then(|run| run.source.value_rows(Rows::of(table)));
        let Some(valued) = valued.as_mut().filter(|_| self.runs.iter().all(agree)) else { return Ok(false) };
        let mut stmts: Vec<Stmt> = Vec::new();
        for run in &mut self.runs {
            let events = match run.source.pass_valued(valued) {
                Some(events) => events,
                None => {
                    if stmts.is_empty() {
                        table.unpack(&mut stmts);
                    }
                    run.source.pass(&stmts).map_err(Stop::Source)?
                }
            };
            run.target.follow(&run.source);
            run.comparison.pass(events, run.source.machine());
        }
        Ok(true)
    }
}
