//! The engine: the compiler of ncc for a page in a browser, and for programs in other languages.
//!
//! It is given files by name, does one request, and gives outputs back by name. Nothing is read from a disk or printed.
//!
//! ```
//! use ncc_engine::Engine;
//!
//! let mut engine = Engine::default();
//! engine.put("part.nc", b"G21 G90 G17 G40\nG00 Z50.\nG00 X10. Y5.\nM30\n".to_vec());
//! let code = engine.run(r#"{ "verb": "translate", "file": "part.nc", "from": "haas", "to": "siemens" }"#);
//! assert_eq!(code, 0, "{:?}", engine.output("messages").map(String::from_utf8_lossy));
//! assert!(engine.output("output").is_some_and(|text| text.ends_with(b"M30\n")));
//! ```
//!
//! [`request`] has the form of a request, `verbs` does it, and [`interface`] are the same steps as five C functions.
//! The codes are the exit codes of the command line. Not here: any work of the compiler (`ncc_driver`).

mod colours;
pub mod dialects;
mod editing;
#[expect(unsafe_code, reason = "memory crosses the C interface here, and nowhere else")]
pub mod interface;
mod program;
mod project;
pub mod request;
mod simulate;
mod time;
mod verbs;
mod words;

use self::dialects::Dialects;
use self::program::Files;

/// Files by their names, and what the last request has made.
#[derive(Debug, Default)]
pub struct Engine {
    files: Files,
    outputs: Vec<(&'static str, Vec<u8>)>,
    kept: simulate::Kept,
}

impl Engine {
    /// Keeps a file, in the place of another of its name.
    pub fn put(&mut self, name: &str, bytes: Vec<u8>) {
        self.kept.forget_moves();
        self.files.put(name, bytes);
    }

    /// Makes dialects known to the requests from now on; without it, the built-in ones are.
    pub fn know(&mut self, dialects: Dialects) {
        self.kept.forget_moves();
        self.files.dialects = dialects;
    }

    /// Does a request, which is JSON ([`request::Request`]); its outputs take the place of those of the one before. The
    /// code is an exit code of the command line: 0 is done.
    pub fn run(&mut self, request: &str) -> u8 {
        let (code, outputs) = verbs::run(request, &self.files, &mut self.kept);
        self.outputs = outputs;
        code
    }

    /// An output of the last request: its names are those of [`request::Request`].
    pub fn output(&self, name: &str) -> Option<&[u8]> {
        self.outputs.iter().find(|(own, _)| *own == name).map(|(_, bytes)| bytes.as_slice())
    }

    /// All outputs of the last request, with their names.
    pub fn outputs(&self) -> impl Iterator<Item = (&'static str, &[u8])> {
        self.outputs.iter().map(|(name, bytes)| (*name, bytes.as_slice()))
    }

    /// Lets go of all files, dialects of a shop and outputs.
    pub fn clear(&mut self) {
        *self = Engine::default();
    }
}
