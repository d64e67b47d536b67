//! The programs of a file or a folder: read, watched, saved back.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::Json;
use axum::body::Bytes;
use axum::extract::{Path as Part, Query, State};
use axum::http::header::{ETAG, IF_MATCH, IF_NONE_MATCH};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::Shared;

/// The largest program that is listed, bytes.
const LARGEST: u64 = 256 << 20;

/// Programs that are listed at most.
const MOST: usize = 10_000;

/// The project file.
const PROJECT: &str = "ncc.toml";

/// How long a request waits for a change.
const PATIENCE: Duration = Duration::from_secs(20);

/// How often the folder is looked at meanwhile.
const GLANCE: Duration = Duration::from_millis(300);

/// What may be read and written.
pub(crate) struct Programs {
    folder: PathBuf,
    /// The only one, where a file was named; its project file goes with it.
    only: Option<String>,
}

/// A program in a list.
#[derive(Serialize)]
pub(crate) struct Listed {
    name: String,
    bytes: u64,
}

/// All programs.
#[derive(Serialize)]
pub(crate) struct List {
    folder: String,
    /// Whether further ones may be written.
    open: bool,
    programs: Vec<Listed>,
    stamp: String,
}

/// Which stamp is known already.
#[derive(Deserialize)]
pub(crate) struct Since {
    stamp: Option<String>,
}

impl Programs {
    pub(crate) fn of(path: &Path) -> io::Result<Programs> {
        let path = fs::canonicalize(path)?;
        if path.is_dir() {
            return Ok(Programs { folder: path, only: None });
        }
        let name = path.file_name().and_then(|name| name.to_str()).map(str::to_owned);
        let only = name.ok_or(io::ErrorKind::InvalidFilename)?;
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        Ok(Programs { folder, only: Some(only) })
    }

    /// Where a program is, if its name is one of a file in the folder.
    fn path(&self, name: &str) -> Option<PathBuf> {
        let plain = !name.is_empty() && !name.starts_with('.') && !name.contains(['/', '\\', ':', '\0']);
        let known = self.only.as_ref().is_none_or(|only| only == name || name == PROJECT);
        (plain && known).then(|| self.folder.join(name))
    }

    /// A file that is no link.
    fn file(path: &Path) -> io::Result<fs::Metadata> {
        let about = fs::symlink_metadata(path)?;
        if about.is_file() { Ok(about) } else { Err(io::ErrorKind::NotFound.into()) }
    }

    fn list(&self) -> io::Result<List> {
        let mut programs = Vec::new();
        let mut stamp = Sha256::new();
        let mut entries: Vec<_> = fs::read_dir(&self.folder)?.filter_map(Result::ok).collect();
        entries.sort_by_key(fs::DirEntry::file_name);
        for entry in entries {
            let Ok(name) = entry.file_name().into_string() else { continue };
            let Some(path) = self.path(&name) else { continue };
            let Ok(about) = Programs::file(&path) else { continue };
            if about.len() > LARGEST || programs.len() >= MOST {
                continue;
            }
            stamp.update(format!("{name}\0{}\0{:?}\0", about.len(), about.modified().ok()));
            programs.push(Listed { name, bytes: about.len() });
        }
        let folder =
            self.folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        Ok(List { folder, open: self.only.is_none(), programs, stamp: hex(&stamp.finalize()) })
    }

    /// A program and its tag.
    fn read(&self, name: &str) -> io::Result<(Vec<u8>, String)> {
        let path = self.path(name).ok_or(io::ErrorKind::NotFound)?;
        Programs::file(&path)?;
        let bytes = fs::read(path)?;
        let tag = tag(&bytes);
        Ok((bytes, tag))
    }

    /// Writes a program over the one with a tag, or a new one; gives its tag, or none where another one is there.
    fn write(&self, name: &str, over: Option<&str>, bytes: &[u8]) -> io::Result<Option<String>> {
        let path = self.path(name).ok_or(io::ErrorKind::NotFound)?;
        let there = match self.read(name) {
            Ok((_, tag)) => Some(tag),
            Err(error) if error.kind() == io::ErrorKind::NotFound && fs::symlink_metadata(&path).is_err() => {
                None
            }
            Err(error) => return Err(error),
        };
        if there.as_deref() != over {
            return Ok(None);
        }
        let mut file = tempfile::NamedTempFile::new_in(&self.folder)?;
        file.write_all(bytes)?;
        if let Ok(about) = fs::metadata(&path) {
            file.as_file().set_permissions(about.permissions())?;
        }
        file.as_file().sync_all()?;
        file.persist(&path).map_err(|error| error.error)?;
        Ok(Some(tag(bytes)))
    }
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn tag(bytes: &[u8]) -> String {
    format!("\"{}\"", hex(&Sha256::digest(bytes)))
}

fn status(error: &io::Error) -> StatusCode {
    match error.kind() {
        io::ErrorKind::NotFound => StatusCode::NOT_FOUND,
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => StatusCode::FORBIDDEN,
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => StatusCode::INSUFFICIENT_STORAGE,
        _ => StatusCode::INTERNAL_SERVER_ERROR,
    }
}

/// Work with files, on a thread of its own.
async fn blocking<T: Send + 'static>(
    shared: &Arc<Shared>,
    work: impl FnOnce(&Programs) -> io::Result<T> + Send + 'static,
) -> Result<T, StatusCode> {
    let shared = Arc::clone(shared);
    let done = tokio::task::spawn_blocking(move || work(&shared.programs)).await;
    done.map_err(|_| StatusCode::INTERNAL_SERVER_ERROR)?.map_err(|error| status(&error))
}

/// All programs, as soon as the stamp is not the one that is known.
pub(crate) async fn list(
    State(shared): State<Arc<Shared>>,
    Query(since): Query<Since>,
) -> Result<Json<List>, StatusCode> {
    let begun = Instant::now();
    loop {
        let list = blocking(&shared, Programs::list).await?;
        if since.stamp.as_ref() != Some(&list.stamp) || begun.elapsed() > PATIENCE {
            return Ok(Json(list));
        }
        tokio::time::sleep(GLANCE).await;
    }
}

/// A program.
pub(crate) async fn read(
    State(shared): State<Arc<Shared>>,
    Part(name): Part<String>,
) -> Result<Response, StatusCode> {
    let (bytes, tag) = blocking(&shared, move |programs| programs.read(&name)).await?;
    Ok(([(ETAG, tag)], bytes).into_response())
}

/// Saves a program: `If-Match` says over which one, `If-None-Match: *` that there is none.
pub(crate) async fn write(
    State(shared): State<Arc<Shared>>,
    Part(name): Part<String>,
    headers: HeaderMap,
    bytes: Bytes,
) -> Result<Response, StatusCode> {
    let over = headers.get(IF_MATCH).and_then(|tag| tag.to_str().ok()).map(str::to_owned);
    let new = headers.get(IF_NONE_MATCH).is_some_and(|tag| tag == "*");
    if over.is_some() == new {
        return Err(StatusCode::PRECONDITION_REQUIRED);
    }
    let written = blocking(&shared, move |programs| programs.write(&name, over.as_deref(), &bytes)).await?;
    let tag = written.ok_or(StatusCode::PRECONDITION_FAILED)?;
    Ok((StatusCode::NO_CONTENT, [(ETAG, tag)]).into_response())
}
