//! Faults in words: which entry of `messages/` a fault has, the values in it, and what to do.
//!
//! ```text
//! Fault::WordWithoutNumber { letter: 'X' }    NC0106, letter = X    `X` without a number
//! ```
//!
//! `facts` and `advice` choose entries and helps, `message` formats them, `words` is their face. No sentence is here: all
//! are in `driver/messages`, one folder a code. Not here: how a message is laid out (`human`, `json`).

pub mod advice;
pub mod codes;
mod context;
pub mod facts;
mod file_needs;
pub mod files;
pub mod message;
#[cfg(test)]
mod samples;
mod unsupported;
mod unwritable;
pub mod words;
