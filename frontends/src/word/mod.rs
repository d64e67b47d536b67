//! The reader of the word-address family: all dialects of letters and numbers, distinguished by their
//! dictionaries alone.
//!
//! A plain move goes from the line straight to its statement (`common::fast_lower`), and so do the other usual blocks
//! of one move (`common::fast_block`). Any other line goes to the
//! recogniser of plain blocks (`common::fast_parse`), and to the lexer (`text::token`) and the grammar
//! (`text/block.lalrpop`) if it is not one. Its words are then lowered to statements (`lower` and its
//! neighbours) with what the program has stated so far (`word_state`).
//!
//! Reading never fails: a block with a fault gives diagnostics and no statements, and reading goes
//! on at the next one. What a dictionary does not have is refused, never skipped.
//!
//! Not here: what execution makes of a program, and everything about files.

mod active_codes;
mod block_words;
mod by_hand;
mod calls;
mod cycles;
mod data;
mod doubts;

mod fast_lower;
mod frames;
mod framing;
mod functions;
mod lower;
mod macros;
mod mode_queries;
mod moves;
mod number;
mod o_code;
mod reader;
mod sort;
mod spindle;
#[cfg(test)]
#[path = "../../tests/word/mod.rs"]
mod tests;
pub(crate) mod text;
mod text_facts;
mod word_state;

pub(crate) use calls::repetition::may_repeat;
pub(crate) use macros::computing::may_jump;
pub use reader::Reader;
