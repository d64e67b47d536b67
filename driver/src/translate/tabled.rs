//! The steps for the lines of a piece that were read as a table, where none of them has anything to do with a line.
//!
//! ```text
//! table ── passes look at the statements that stand for it ── written row by row ── read back as a table, compared
//! ```
//!
//! Most of a long program goes this way. What cannot is made statements of, and goes the usual one (`pipeline`). The
//! passes have followed the statements that stand for a table before they are known to leave it alone; should one of them
//! change or report any, the attempt is thrown away, and the program is translated again without tables.

use std::io;

use ncc_ir::canon::Modes;
use ncc_ir::program::line_table::LineTable;
use ncc_ir::program::{Lines, Stmt};
use ncc_machines::reading::Told;
use ncc_passes::Touch;

use super::translation::Translation;
use super::writing::Said;

impl Translation<'_> {
    /// Whether lines are read as tables now.
    pub(super) fn takes_tables(&self) -> bool {
        self.tables
            && !self.batch.whole
            && self.job.passes.is_empty()
            && self.folder.is_none()
            && self.per_tool.is_none()
    }

    /// Sends the table of what was read through all steps, or makes statements of it.
    pub(super) fn tabled(&mut self) -> io::Result<()> {
        let mut table = std::mem::take(&mut self.batch.table);
        if table.is_empty() || self.errors > 0 {
            table.clear();
            self.batch.table = table;
            return Ok(());
        }
        let (stand, lines) = (table.stand_in(), table.lines());
        if !self.leaves_table(&stand, lines) {
            self.batch.table = table;
            self.batch.unpack_table();
            return Ok(());
        }
        self.send_table(&mut table, stand, lines)?;
        // Its memory serves the next piece.
        table.clear();
        self.batch.table = table;
        Ok(())
    }

    /// Whether no step changes the statements that stand for a table.
    fn leaves_table(&mut self, stand: &[Stmt], lines: Lines) -> bool {
        self.still_to_give() == Modes::default()
            && !self.renumbering.touches(stand)
            && self.side_effects.passes(lines)
            && self.legaliser.follows(stand, lines)
    }

    fn send_table(&mut self, table: &mut LineTable, mut stand: Vec<Stmt>, lines: Lines) -> io::Result<()> {
        let (assumed, mut found) = (self.batch.assumed, Vec::new());
        let target_modes = self.modes_in_target(&stand, &assumed, &mut found);
        let (before, told) = (stand.clone(), found.len());
        self.legaliser.run_touching(&mut stand, &target_modes, (Some(lines), Touch::Passes), &mut found);
        if stand != before || found.len() > told {
            self.discarded = true;
            return Ok(());
        }
        let taken = target_modes.without(&self.given);
        if self.writer.table(table, &taken, &mut self.text, &mut found) {
            self.take(found, Told::Writer);
            return self.release_text(&assumed, Said::Table(table));
        }
        let mut stmts = Vec::new();
        table.unpack(&mut stmts);
        self.write_main(&stmts, &target_modes, &mut found);
        self.take(found, Told::Writer);
        self.release_text(&assumed, Said::Lines(&mut stmts))
    }
}
