//! What the tests share: the corpus, expected files, the second interpreter, and the plain form in
//! which its events, the compiler's and those cited from books are compared.
//!
//! Not here: tests (`suite/`), and anything that the compiler itself uses.

pub mod besides;
pub mod corners;
pub mod corpus;
pub mod expect;
pub use ncc_interpreter as interpreter;
pub mod page;
pub mod plain;
pub mod sketch;
pub mod translate;
