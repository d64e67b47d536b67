//! Bytes that are written once and read again: kept in memory, and beyond a limit wherever the host keeps more.
//!
//! A library or a page keeps all of it in memory. A host that has files gives a way to make them, once ([`overflow_to`]).

use std::fmt;
use std::io::{self, Cursor, Read, Seek, SeekFrom, Write};
use std::path::PathBuf;
use std::sync::OnceLock;

/// Bytes of an output that are kept in memory.
pub const IN_MEMORY: usize = 1 << 20;

/// Where a host keeps what is too long for memory. Its errors may be a [`Lacking`].
pub trait Store: Read + Write + Seek + Send + fmt::Debug {}

impl<T: Read + Write + Seek + Send + fmt::Debug> Store for T {}

/// Makes a store without anything in it.
pub type MakeStore = fn() -> io::Result<Box<dyn Store>>;

static OVERFLOW: OnceLock<MakeStore> = OnceLock::new();

/// Has what is longer than a spool's limit kept in stores of the host from now on; the first call counts.
pub fn overflow_to(make: MakeStore) {
    let _ = OVERFLOW.set(make);
}

/// A store of the host that cannot be made, or cannot be written further.
#[derive(Debug)]
pub struct Lacking {
    /// The folder of temporary files.
    pub folder: PathBuf,
    /// Why.
    pub reason: String,
}

impl fmt::Display for Lacking {
    /// For a developer; users get the words of the messages.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}: {}", self.folder.display(), self.reason)
    }
}

impl std::error::Error for Lacking {}

/// Bytes kept in memory, and beyond a limit in a store of the host if it has any.
#[derive(Debug)]
pub struct Spool {
    held: Held,
    in_memory: usize,
}

#[derive(Debug)]
enum Held {
    Memory(Cursor<Vec<u8>>),
    Store(Box<dyn Store>),
}

impl Spool {
    /// So many bytes stay in memory.
    pub fn new(in_memory: usize) -> Spool {
        Spool { held: Held::Memory(Cursor::new(Vec::new())), in_memory }
    }

    /// One that holds a text, and stands at its beginning.
    pub fn of(text: Vec<u8>) -> Spool {
        Spool { held: Held::Memory(Cursor::new(text)), in_memory: IN_MEMORY }
    }

    /// Lets go of all that it holds.
    pub fn clear(&mut self) {
        self.held = Held::Memory(Cursor::new(Vec::new()));
    }
}

impl Default for Spool {
    fn default() -> Spool {
        Spool::new(IN_MEMORY)
    }
}

impl Write for Spool {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        if let Held::Memory(memory) = &mut self.held {
            let end = memory.position() + text.len() as u64;
            let store = OVERFLOW.get().filter(|_| end > self.in_memory as u64);
            let Some(make) = store else { return memory.write(text) };
            let mut store = make()?;
            store.write_all(memory.get_ref())?;
            store.seek(SeekFrom::Start(memory.position()))?;
            self.held = Held::Store(store);
        }
        match &mut self.held {
            Held::Memory(memory) => memory.write(text),
            Held::Store(store) => store.write(text),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.held {
            Held::Memory(_) => Ok(()),
            Held::Store(store) => store.flush(),
        }
    }
}

impl Read for Spool {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        match &mut self.held {
            Held::Memory(memory) => memory.read(into),
            Held::Store(store) => store.read(into),
        }
    }
}

impl Seek for Spool {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match &mut self.held {
            Held::Memory(memory) => memory.seek(to),
            Held::Store(store) => store.seek(to),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_written_is_read_again_past_the_limit_too() {
        overflow_to(|| Ok(Box::new(Cursor::new(Vec::new()))));
        let mut spool = Spool::new(4);
        let mut all = Vec::new();
        for piece in [&b"ab"[..], b"cd", b"e", b"", b"fghij"] {
            spool.write_all(piece).expect("memory");
        }
        assert!(matches!(spool.held, Held::Store(_)));
        spool.seek(SeekFrom::Start(3)).expect("memory");
        spool.write_all(b"DE").expect("memory");
        spool.rewind().expect("memory");
        spool.read_to_end(&mut all).expect("memory");
        assert_eq!(all, b"abcDEfghij");
        spool.clear();
        all.clear();
        spool.read_to_end(&mut all).expect("memory");
        assert!(all.is_empty() && matches!(spool.held, Held::Memory(_)));
    }
}
