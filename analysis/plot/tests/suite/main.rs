//! Pictures as others see them: what is drawn, what is kept, what becomes of text.

mod drawn;
mod laws;
mod made;
mod pages;
mod svg;
