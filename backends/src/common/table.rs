//! Lines of a table, written row by row.
//!
//! Not here: how a plain line is written (`words::plain`).

use ncc_ir::canon::Modes;
use ncc_ir::expr::num::Num;
use ncc_ir::program::Stmt;
use ncc_ir::program::line_table::LineTable;

use super::Sink;
use super::words::Words;

/// A writer of blocks of words.
pub(crate) trait WritesBlocks {
    /// What writes its words.
    fn words(&mut self) -> &mut Words;

    /// Whether a block that is nothing but a straight move is written as one now.
    fn writes_plainly(&self) -> bool;

    /// Such a block has stated a feed.
    fn feed_stated(&mut self, feed: Num);

    /// Writes whole blocks of a body.
    fn blocks(&mut self, stmts: &[Stmt], sink: &mut Sink);
}

/// Writes the lines of a table; `false`, and then nothing was done, where they are to be written as statements.
pub(crate) fn write_table(
    writer: &mut impl WritesBlocks,
    table: &LineTable,
    assumed: &Modes,
    sink: &mut Sink,
) -> bool {
    let words = writer.words();
    // The safe start looks at the statements before it, and a record of lines at those of each block.
    if words.preamble.is_some() || words.trace.is_some() {
        return false;
    }
    words.take_for_granted(assumed);
    let (mut feeds, mut block) = (table.feeds().iter(), Vec::new());
    for row in table.rows() {
        let feed = if row.has_feed() { feeds.next() } else { None };
        if writer.writes_plainly() && writer.words().plain_row(row, table.unit(), feed, sink.out) {
            if let Some((feed, _)) = feed {
                writer.feed_stated(*feed);
            }
            continue;
        }
        writer.words().pass_on(sink.out);
        block.clear();
        table.unpack_row(row, feed, &mut block);
        writer.blocks(&block, sink);
    }
    writer.words().pass_on(sink.out);
    true
}
