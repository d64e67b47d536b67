//! Folding: long-hand text gets its cycles and patterns back, and the machine does the same.

mod assumed;
mod corpus;
mod law;
mod made;
mod soup;
mod styles;
