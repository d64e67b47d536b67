//! Text in a program.

/// Text of a comment or message, as Unicode. Front-ends decode (UTF-8, else Latin-1).
pub type Text = Box<str>;
