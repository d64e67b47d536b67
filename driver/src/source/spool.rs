//! A buffer that ncc writes and reads again: in memory up to a limit, then spilled to a store of the host.
//!
//! A library or a web page keeps all bytes in memory. A host with files registers a store once ([`overflow_to`]).
//! Not here: the temporary files themselves (the host makes them).

use std::fmt;
use std::io::{self, Cursor, Read, Seek, SeekFrom, Write};
use std::path::PathBuf;
use std::sync::OnceLock;

/// Default limit of a spool in memory: 1 MiB.
pub const IN_MEMORY: usize = 1 << 20;

/// Storage of a host for a spilled buffer, for example a temporary file. Its errors may be a [`Lacking`].
pub trait Store: Read + Write + Seek + Send + fmt::Debug {}

impl<T: Read + Write + Seek + Send + fmt::Debug> Store for T {}

/// Makes an empty store.
pub type MakeStore = fn() -> io::Result<Box<dyn Store>>;

static OVERFLOW: OnceLock<MakeStore> = OnceLock::new();

/// Registers the host's store for spools that pass their limit. Only the first call has an effect.
pub fn overflow_to(make: MakeStore) {
    let _ = OVERFLOW.set(make);
}

/// Error: the host cannot make a store or write to it.
#[derive(Debug)]
pub struct Lacking {
    /// Folder of the temporary files.
    pub folder: PathBuf,
    /// Reason, for example the text of the I/O error.
    pub reason: String,
}

impl fmt::Display for Lacking {
    /// For developers; users see the texts in `messages/`.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}: {}", self.folder.display(), self.reason)
    }
}

impl std::error::Error for Lacking {}

/// Bytes in memory, or in a store of the host once they pass the limit. Without a store, all stay in memory.
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
    /// Makes an empty spool; `in_memory` is its limit in bytes.
    pub fn new(in_memory: usize) -> Spool {
        Spool { held: Held::Memory(Cursor::new(Vec::new())), in_memory }
    }

    /// Makes a spool with this content; the next read starts at its first byte.
    pub fn of(text: Vec<u8>) -> Spool {
        Spool { held: Held::Memory(Cursor::new(text)), in_memory: IN_MEMORY }
    }

    /// Empties the spool and frees its memory or its store.
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
