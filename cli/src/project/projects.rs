//! Project files as they were read, and the rows that a call has met.
//!
//! ```text
//! ncc.toml, a row with files = "old/*.nc"    an InForce: its machines, folders, and the line of each
//! ```
//!
//! Not here: how they are found and read (`load`).

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use ncc_driver::simulate::raw;
use ncc_machines::Profile;
use ncc_machines::project::Project;

/// Project files that a call has met, each read once.
#[derive(Debug, Default)]
pub(crate) struct Projects {
    /// By the path of the file.
    pub(super) read: Mutex<HashMap<PathBuf, Arc<Loaded>>>,
    /// Rows with their machines, by the path of the file and the number of the row.
    pub(super) rows: Mutex<HashMap<(PathBuf, usize), Arc<InForce>>>,
}

/// A project file.
#[derive(Debug)]
pub(crate) struct Loaded {
    /// Its path.
    pub(super) path: PathBuf,
    /// Its path in messages: relative to the working folder where that is shorter.
    pub(crate) shown: String,
    /// Its text.
    pub(crate) text: String,
    /// SHA-256 of its bytes.
    pub(crate) sha256: [u8; 32],
    /// What it says.
    pub(crate) project: Project,
}

/// A value of a project file, with its line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Value<T> {
    /// The value.
    pub(crate) value: T,
    /// The line in which it stands, from 1.
    pub(crate) line: usize,
}

/// A machine of a row.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// Its profile.
    pub(crate) profile: Arc<Profile>,
    /// As the file names it; `None` is one in the file.
    pub(crate) named: Option<String>,
    /// The name by which `machines::find` finds it: a shipped one's, or a path.
    pub(crate) found: Option<String>,
    /// The line in which it stands, from 1.
    pub(crate) line: usize,
}

/// What a project file says of programs of one row.
#[derive(Debug)]
pub(crate) struct InForce {
    /// The file.
    pub(crate) file: Arc<Loaded>,
    /// The patterns of the row.
    pub(crate) files: Vec<Value<String>>,
    /// The machine that they were written for.
    pub(crate) machine: Option<Row>,
    /// The machine to translate for.
    pub(crate) to: Option<Row>,
    /// Folders of called programs, as they are written and where they are.
    pub(crate) include: Vec<Value<(String, PathBuf)>>,
    /// The folder of the outputs, likewise.
    pub(crate) output: Option<Value<(String, PathBuf)>>,
    /// The raw part, as it is written and as it is read: a file's name is a path from the working folder.
    pub(crate) stock: Option<Value<(String, raw::Stated)>>,
    /// Fixtures, likewise.
    pub(crate) fixtures: Vec<Value<(String, raw::Stated)>>,
    /// Z of the table, mm.
    pub(crate) table: Option<Value<f64>>,
}
