//! The language of O words: settings of parameters, structures and subprograms.
//!
//! ```text
//! o100 if [#<depth> LT 0]    a branch
//! o<drill> call [5] [2]      a call with two arguments
//! ```
//!
//! Not here: the lexer, which `text` has for both languages.

pub(super) mod o_formula;
pub(super) mod o_state;
pub(super) mod o_subs;
pub(super) mod o_words;
pub(super) mod operator_text;
pub(super) mod parameters;
pub(super) mod standalone_osub;
pub(super) mod statements;
mod structure_paths;
