//! Which files stand behind a text that calls their programs.

/// What stands behind a text's own lines, and the text itself as it was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Called {
    /// SHA-256 of the calling text's bytes.
    pub sha256: [u8; 32],
    /// Its length.
    pub bytes: u64,
    /// The files, in the order of their first calls.
    pub files: Vec<CalledFile>,
}

/// A file with a called program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CalledFile {
    /// Its path.
    pub name: String,
    /// SHA-256 of its bytes.
    pub sha256: [u8; 32],
    /// Its length.
    pub bytes: u64,
    /// Places of its text in the whole: the first byte, and one past the last.
    pub places: (u32, u32),
    /// Lines of the whole before the one that would be the file's first.
    pub lines_before: u64,
}

impl Called {
    /// The file in which a place stands; `None` for the text's own.
    pub fn file(&self, place: u32) -> Option<&CalledFile> {
        let behind = self.files.partition_point(|file| file.places.1 < place);
        self.files.get(behind).filter(|file| file.places.0 <= place)
    }
}
