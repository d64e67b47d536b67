//! The Sinumerik's language: from text to statements.
//!
//! A block is one line. `token` makes tokens of its bytes, the grammar (`block.lalrpop`, with its
//! actions in `build`) a tree of them (`tree`); `unit` tells lines that frame programs. The whole
//! language is read, so that what is not translated can be refused by its name and not for its
//! form. Reading never fails: a faulty block gives its fault, and the next line is read as if
//! nothing had happened.
//!
//! `reader` takes a text line by line and gives each block to `lower`, which with its neighbours
//! makes statements of it: by the dictionary, and by what the program has stated so far (`siemens_state`).
//!
//! Not here: what execution makes of a program, and everything about files.

mod block_words;
mod cycles;

mod frames;
mod functions;
mod lower;
mod message;
mod mode_queries;
mod moves;
mod program;
mod reader;
mod siemens_state;
mod sort;
mod speed;
mod spindles;
#[cfg(test)]
#[path = "../../tests/siemens/mod.rs"]
mod tests;
pub(crate) mod text;
mod text_facts;
mod values;

pub use reader::Reader;
pub use text::parse::form;
pub use text::token::is_key_word;
