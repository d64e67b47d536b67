//! Laws of the two text forms, `ir` and `canon`: what is written is read back as the same.

mod any;
mod canon;
mod ir;
