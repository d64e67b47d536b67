//! A copy of a database, and a database made of one.
//!
//! The copy of either database is an SQLite file, which `ncc serve --database` could use as it is; so a backup of an SQLite
//! file is restored to a server too, and the other way round. It is of one moment, while others write. Tables are listed by
//! the schema itself, so that none can be forgotten. Not here: the command line.

use std::collections::BTreeMap;
use std::fs::{File as Bytes, OpenOptions};
use std::io;
use std::path::Path;

use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags};
use sha2::{Digest, Sha256};

use super::database::Database;
use super::migrations::{self, STEPS};
use super::postgres;
use super::session::{Session, Value};
use super::sqlite::{self, MARK};
use super::{Place, StoreError, hex};

/// A table of the schema.
#[derive(Debug)]
struct Table {
    name: String,
    /// Its columns.
    columns: Vec<Column>,
    /// Tables that rows of it refer to.
    refers: Vec<String>,
}

#[derive(Debug)]
struct Column {
    name: String,
    /// Whether it holds yes or no: SQLite keeps them as numbers.
    is_boolean: bool,
    /// Whether the database counts it up.
    is_counted: bool,
}

impl Table {
    fn names(&self) -> String {
        self.columns.iter().map(|column| column.name.as_str()).collect::<Vec<_>>().join(", ")
    }

    fn places(&self) -> String {
        (1..=self.columns.len()).map(|at| format!("${at}")).collect::<Vec<_>>().join(", ")
    }
}

/// Tables of an SQLite file, those that others refer to first.
fn tables(of: &Connection) -> Result<Vec<Table>, StoreError> {
    let mut names = of.prepare(
        "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite!_%' ESCAPE '!' ORDER BY name",
    )?;
    let names: Vec<String> = names.query_map([], |row| row.get(0))?.collect::<Result<_, _>>()?;
    let mut all = BTreeMap::new();
    for name in names {
        let mut columns = of.prepare("SELECT name, type, pk FROM pragma_table_info($1) ORDER BY cid")?;
        let columns = columns.query_map([&name], |row| {
            let kind: String = row.get(1)?;
            let is_counted = kind == "INTEGER" && row.get::<_, i64>(2)? == 1;
            Ok(Column { name: row.get(0)?, is_boolean: kind == "BOOLEAN", is_counted })
        })?;
        let columns = columns.collect::<Result<_, _>>()?;
        let mut refers = of.prepare("SELECT DISTINCT \"table\" FROM pragma_foreign_key_list($1)")?;
        let refers =
            refers.query_map([&name], |row| row.get::<_, String>(0))?.collect::<Result<Vec<_>, _>>()?;
        let refers = refers.into_iter().filter(|other| *other != name).collect();
        all.insert(name.clone(), Table { name, columns, refers });
    }
    let mut ordered: Vec<Table> = Vec::new();
    while !all.is_empty() {
        let is_free = |table: &Table| !table.refers.iter().any(|other| all.contains_key(other));
        let Some(next) = all.values().find(|table| is_free(table)).map(|table| table.name.clone()) else {
            return Err(StoreError::Database("its tables refer to each other in a circle".to_owned()));
        };
        ordered.extend(all.remove(&next));
    }
    Ok(ordered)
}

fn failed(error: &io::Error) -> StoreError {
    match error.kind() {
        io::ErrorKind::StorageFull => StoreError::Full,
        _ => StoreError::Database(error.to_string()),
    }
}

/// A new file that nobody else may read.
fn new_file(path: &Path) -> Result<(), StoreError> {
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(path).map(|_| ()).map_err(|error| failed(&error))
}

/// Copies a database into a new file; gives how many rows it has.
///
/// # Errors
/// The file is there already, the database is none of ncc's or cannot be read, or the disk is full. Then no file is left.
pub(crate) fn backup(place: &Place, into: &Path) -> Result<u64, StoreError> {
    new_file(into)?;
    let done = match place {
        Place::File(path) => of_file(path, into),
        Place::Server(address) => of_server(address, into),
    };
    let done = done.and_then(|rows| {
        let sync = OpenOptions::new().write(true).open(into).and_then(|file| file.sync_all());
        sync.map(|()| rows).map_err(|error| failed(&error))
    });
    if done.is_err() {
        // The reason of the failure is more than that of this one.
        let _ = std::fs::remove_file(into);
    }
    done
}

/// Whether a file is a database of ncc, and the number of its migrations.
fn version(of: &Connection) -> Result<i64, StoreError> {
    let number = |name| of.pragma_query_value(None, name, |row| row.get::<_, i32>(0));
    if number("application_id")? != MARK {
        return Err(StoreError::Database("it is no database of ncc".to_owned()));
    }
    let taken = number("user_version")?.into();
    migrations::left(taken)?;
    Ok(taken)
}

fn count(of: &Connection) -> Result<u64, StoreError> {
    let mut rows = 0;
    for table in tables(of)? {
        let own: i64 = of.query_row(&format!("SELECT count(*) FROM {}", table.name), [], |row| row.get(0))?;
        rows += own.unsigned_abs();
    }
    Ok(rows)
}

fn of_file(path: &Path, into: &Path) -> Result<u64, StoreError> {
    // Without the flag that makes it, a file that is not there is an error.
    let from = Connection::open_with_flags(
        path,
        OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX,
    )?;
    from.busy_timeout(super::database::PATIENCE)?;
    version(&from)?;
    let name =
        into.to_str().ok_or_else(|| StoreError::Database("its name is no text in UTF-8".to_owned()))?;
    from.execute("VACUUM INTO $1", [name])?;
    let made = Connection::open_with_flags(into, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
    count(&made)
}

fn of_server(address: &str, into: &Path) -> Result<u64, StoreError> {
    let mut made = Connection::open(into)?;
    sqlite::migrate(&mut made)?;
    let tables = tables(&made)?;
    let change = made.transaction()?;
    let mut rows = 0;
    postgres::at_one_moment(address, super::database::PATIENCE, STEPS.len() as i64, |moment| {
        for table in &tables {
            let (name, names) = (&table.name, table.names());
            let mut insert =
                change.prepare(&format!("INSERT INTO {name} ({names}) VALUES ({})", table.places()))?;
            moment.rows(&format!("SELECT {names} FROM {name}"), &mut |values| {
                for (at, value) in values.iter().enumerate() {
                    insert.raw_bind_parameter(at + 1, value)?;
                }
                insert.raw_execute()?;
                rows += 1;
                Ok(())
            })?;
        }
        Ok(())
    })?;
    change.commit()?;
    Ok(rows)
}

/// Makes an empty database what a backup has; gives how many rows. All of it is there then, or nothing.
///
/// # Errors
/// The file is no backup, or damaged, or one of a later ncc; the database is not empty, or cannot be written.
pub(crate) fn restore(place: &Place, file: &Path) -> Result<u64, StoreError> {
    Bytes::open(file).map_err(|error| failed(&error))?;
    let mut from = Connection::open_with_flags(file, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
    if version(&from)? < STEPS.len() as i64 {
        // A copy comes to the form of this ncc; the backup stays as it is.
        let mut copy = Connection::open("")?;
        rusqlite::backup::Backup::new(&from, &mut copy)?.run_to_completion(
            1000,
            std::time::Duration::ZERO,
            None,
        )?;
        sqlite::migrate(&mut copy)?;
        from = copy;
    }
    is_whole(&from)?;
    let tables = tables(&from)?;
    Database::open(place)?.write(|to| {
        for table in &tables {
            if to.maybe_row(&format!("SELECT 1 FROM {} LIMIT 1", table.name), &[])?.is_some() {
                return Err(StoreError::Exists);
            }
        }
        let mut rows = 0;
        for table in &tables {
            rows += copy(&from, table, to)?;
        }
        Ok(rows)
    })
}

/// Copies the rows of a table.
fn copy(from: &Connection, table: &Table, to: &dyn Session) -> Result<u64, StoreError> {
    let (name, names) = (&table.name, table.names());
    let insert = format!("INSERT INTO {name} ({names}){} VALUES ({})", to.with_numbers(), table.places());
    let mut select = from.prepare(&format!("SELECT {names} FROM {name}"))?;
    let mut rows = select.query([])?;
    let mut count = 0;
    while let Some(row) = rows.next()? {
        let value = |(at, column): (usize, &Column)| {
            Ok::<_, StoreError>(match row.get_ref(at)? {
                ValueRef::Null => Value::Null,
                ValueRef::Integer(number) if column.is_boolean => Value::Bool(number != 0),
                ValueRef::Integer(number) => Value::Int(number),
                ValueRef::Text(text) => Value::Text(String::from_utf8_lossy(text).into_owned()),
                ValueRef::Blob(bytes) => Value::Bytes(bytes.to_vec()),
                ValueRef::Real(_) => return Err(rusqlite::Error::InvalidQuery.into()),
            })
        };
        let values: Vec<Value> = table.columns.iter().enumerate().map(value).collect::<Result<_, _>>()?;
        to.change(&insert, &values)?;
        count += 1;
    }
    for column in table.columns.iter().filter(|column| column.is_counted) {
        to.count_on(name, &column.name)?;
    }
    Ok(count)
}

/// Whether nothing of a backup is damaged: its pages, its references, and each content by its SHA-256.
fn is_whole(of: &Connection) -> Result<(), StoreError> {
    let damaged = |words: &str| StoreError::Database(format!("the backup is damaged: {words}"));
    let check: String = of.query_row("PRAGMA integrity_check(1)", [], |row| row.get(0))?;
    if check != "ok" {
        return Err(damaged(&check));
    }
    if of.prepare("PRAGMA foreign_key_check")?.exists([])? {
        return Err(damaged("a row refers to one that is not there"));
    }
    let mut contents = of.prepare("SELECT id, sha256, bytes FROM content WHERE sha256 IS NOT NULL")?;
    let mut pieces = of.prepare("SELECT bytes FROM content_piece WHERE content = $1 ORDER BY number")?;
    let mut contents = contents.query([])?;
    while let Some(content) = contents.next()? {
        let (id, sha256, length): (i64, String, i64) = (content.get(0)?, content.get(1)?, content.get(2)?);
        let (mut digest, mut bytes) = (Sha256::new(), 0);
        let mut pieces = pieces.query([id])?;
        while let Some(piece) = pieces.next()? {
            let ValueRef::Blob(piece) = piece.get_ref(0)? else {
                return Err(damaged("a content is no bytes"));
            };
            digest.update(piece);
            bytes += piece.len() as i64;
        }
        if hex(&digest.finalize()) != sha256 || bytes != length {
            return Err(damaged(&format!("the content {sha256} has another digest")));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::Store;
    use super::*;

    #[test]
    fn a_backup_of_an_earlier_ncc_comes_to_the_form_of_this_one() {
        let folder = tempfile::tempdir().expect("a folder");
        let (file, to) = (folder.path().join("old.sqlite"), Place::File(folder.path().join("new.sqlite")));
        let old = Connection::open(&file).expect("a file");
        STEPS[..5].iter().for_each(|step| old.execute_batch(step).expect("a step"));
        let program = format!(
            "INSERT INTO content (id, sha256, bytes, begun) VALUES (7, '{}', 2, 0);
             INSERT INTO content_piece (content, number, bytes) VALUES (7, 0, CAST('M5' AS BLOB));
             INSERT INTO program (id, folder, name, head, is_deleted) VALUES ('p', 'f', 'a.nc', 1, FALSE);
             INSERT INTO revision (program, number, content, folder, name, dialect, machine, tags, change, author, message, made)
             VALUES ('p', 1, 7, 'f', 'a.nc', '', '', '', 'created', 'ana', '', 0)",
            hex(&Sha256::digest(b"M5"))
        );
        old.execute_batch(&program).expect("a program");
        old.pragma_update(None, "application_id", MARK).expect("a mark");
        old.pragma_update(None, "user_version", 5).expect("a version");
        drop(old);
        // With the program, its content, its piece, its revision and its row of facts.
        assert_eq!(restore(&to, &file).expect("restored"), 5);
        let store = Store::open(&to).expect("a store");
        let program = store.program("p").expect("a program");
        assert_eq!(store.whole(&program.content).expect("a text"), b"M5");
        assert!(store.facts_wait().expect("a store"));
        let still = Connection::open(&file).expect("a file");
        assert_eq!(version(&still).expect("a version"), 5);
    }
}
