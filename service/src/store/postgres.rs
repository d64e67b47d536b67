//! A pool of connections to a PostgreSQL server.
//!
//! Changes wait for each other, as in SQLite: each takes one lock of the database first. So a change sees all that were
//! acknowledged before it, whatever process made them. Readers do not wait. Connections are without TLS: the server is on
//! this computer, or behind a tunnel.

use std::cell::RefCell;
use std::collections::HashMap;
use std::error::Error;
use std::time::Duration;

use bytes::BytesMut;
use postgres::error::SqlState;
use postgres::fallible_iterator::FallibleIterator;
use postgres::types::{IsNull, ToSql, Type, to_sql_checked};
use postgres::{Client, Config, IsolationLevel, NoTls, Statement};
use r2d2::ManageConnection;

use super::StoreError;
use super::migrations;
use super::session::{Row, Session, Value};

/// The lock of changes, and of migrations: `ncc1` in ASCII.
const LOCK: i64 = 0x6e63_6331;

/// Statements that a connection keeps at most.
const STATEMENTS: usize = 256;

/// The server.
pub(super) struct Server {
    pub(super) config: Config,
}

impl Server {
    /// The one at an address: `postgres://user:password@host/database`.
    pub(super) fn at(address: &str, patience: Duration) -> Result<Server, StoreError> {
        let wrong = |error: postgres::Error| StoreError::Database(words(&error));
        let mut config: Config = address.parse().map_err(wrong)?;
        config.connect_timeout(patience).application_name("ncc serve");
        Ok(Server { config })
    }
}

/// A connection, with the statements that it has prepared.
pub(super) struct Link {
    client: Client,
    statements: HashMap<String, Statement>,
}

impl ManageConnection for Server {
    type Connection = Link;
    type Error = postgres::Error;

    fn connect(&self) -> Result<Link, postgres::Error> {
        let mut client = self.config.connect(NoTls)?;
        // Payloads are compressed while others wait for the lock; a server without this way keeps its slower one.
        let _ = client.batch_execute("SET default_toast_compression = 'lz4'");
        Ok(Link { client, statements: HashMap::new() })
    }

    fn is_valid(&self, link: &mut Link) -> Result<(), postgres::Error> {
        link.client.simple_query("").map(|_| ())
    }

    fn has_broken(&self, link: &mut Link) -> bool {
        link.client.is_closed()
    }
}

/// A step in the words of PostgreSQL. Text is compared by its bytes, as SQLite does.
fn translated(step: &str) -> String {
    step.replace("INTEGER PRIMARY KEY", "BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY")
        .replace(" WITHOUT ROWID", "")
        .replace(" BLOB ", " BYTEA ")
        .replace(" TEXT ", " TEXT COLLATE \"C\" ")
        .replace(" TEXT,", " TEXT COLLATE \"C\",")
}

/// Takes the migrations that are still to be taken.
pub(super) fn migrate(link: &mut Link) -> Result<(), StoreError> {
    let mut change = link.client.transaction()?;
    change.execute("SELECT pg_advisory_xact_lock($1)", &[&LOCK])?;
    change.batch_execute("CREATE TABLE IF NOT EXISTS ncc_migration (number BIGINT PRIMARY KEY)")?;
    let taken: i64 =
        change.query_one("SELECT coalesce(max(number), 0) FROM ncc_migration", &[])?.try_get(0)?;
    for (at, step) in migrations::left(taken)?.iter().enumerate() {
        change.batch_execute(&translated(&migrations::lines_for(step, "postgres")))?;
        change.execute("INSERT INTO ncc_migration (number) VALUES ($1)", &[&(taken + at as i64 + 1)])?;
    }
    Ok(change.commit()?)
}

/// Does something in a transaction.
pub(super) fn within<T>(
    link: &mut Link,
    writes: bool,
    work: impl FnOnce(&dyn Session) -> Result<T, StoreError>,
) -> Result<T, StoreError> {
    link.client.batch_execute(&match writes {
        true => format!("BEGIN; SELECT pg_advisory_xact_lock({LOCK})"),
        false => "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY".to_owned(),
    })?;
    let open = Open(RefCell::new(link));
    let done = work(&open);
    let client = &mut open.0.into_inner().client;
    match done {
        Ok(done) => {
            client.batch_execute("COMMIT")?;
            Ok(done)
        }
        Err(error) => {
            // A connection that cannot do this is broken, and is not used again.
            let _ = client.batch_execute("ROLLBACK");
            Err(error)
        }
    }
}

/// A transaction that is open.
struct Open<'l>(RefCell<&'l mut Link>);

impl Open<'_> {
    fn statement(link: &mut Link, sql: &str) -> Result<Statement, StoreError> {
        if let Some(statement) = link.statements.get(sql) {
            return Ok(statement.clone());
        }
        let statement = link.client.prepare(sql)?;
        if link.statements.len() >= STATEMENTS {
            link.statements.clear();
        }
        link.statements.insert(sql.to_owned(), statement.clone());
        Ok(statement)
    }
}

/// Values as the client takes them.
fn bound(values: &[Value]) -> Vec<&(dyn ToSql + Sync)> {
    values.iter().map(|value| value as &(dyn ToSql + Sync)).collect()
}

/// Values of a row.
fn taken_apart(row: &postgres::Row) -> Result<Vec<Value>, postgres::Error> {
    let columns = row.columns().iter().enumerate();
    let value = |(at, column): (usize, &postgres::Column)| {
        Ok(match *column.type_() {
            Type::BOOL => row.try_get::<_, Option<bool>>(at)?.map_or(Value::Null, Value::Bool),
            Type::INT4 => {
                row.try_get::<_, Option<i32>>(at)?.map_or(Value::Null, |number| Value::Int(number.into()))
            }
            Type::INT8 => row.try_get::<_, Option<i64>>(at)?.map_or(Value::Null, Value::Int),
            Type::BYTEA => row.try_get::<_, Option<Vec<u8>>>(at)?.map_or(Value::Null, Value::Bytes),
            _ => row.try_get::<_, Option<String>>(at)?.map_or(Value::Null, Value::Text),
        })
    };
    columns.map(value).collect()
}

/// All that a database has at one moment.
pub(super) struct Moment<'t>(postgres::Transaction<'t>);

impl Moment<'_> {
    /// The rows of a statement, one after the other.
    pub(super) fn rows(
        &mut self,
        sql: &str,
        take: &mut dyn FnMut(Vec<Value>) -> Result<(), StoreError>,
    ) -> Result<(), StoreError> {
        let none: [&(dyn ToSql + Sync); 0] = [];
        let mut rows = self.0.query_raw(sql, none)?;
        while let Some(row) = rows.next()? {
            take(taken_apart(&row)?)?;
        }
        Ok(())
    }
}

/// Reads from a server what it has at one moment, if so many migrations have been taken there.
pub(super) fn at_one_moment<T>(
    address: &str,
    patience: Duration,
    migrations: i64,
    work: impl FnOnce(&mut Moment) -> Result<T, StoreError>,
) -> Result<T, StoreError> {
    let mut link = Server::at(address, patience)?.connect()?;
    let begin =
        link.client.build_transaction().isolation_level(IsolationLevel::RepeatableRead).read_only(true);
    let mut moment = Moment(begin.start()?);
    let taken = moment.0.query_one("SELECT coalesce(max(number), 0) FROM ncc_migration", &[]);
    let other = || StoreError::Database("it is no database of ncc".to_owned());
    let taken: i64 = taken.map_err(|_| other())?.try_get(0)?;
    if taken != migrations {
        let words = "it is a database of another version of ncc: begin `ncc serve` of this one on it, then it has this form";
        return Err(StoreError::Database(words.to_owned()));
    }
    work(&mut moment)
}

impl Session for Open<'_> {
    fn rows(&self, sql: &str, values: &[Value]) -> Result<Vec<Row>, StoreError> {
        let mut link = self.0.borrow_mut();
        let statement = Open::statement(&mut link, sql)?;
        let rows = link.client.query(&statement, &bound(&values[..statement.params().len()]))?;
        rows.iter().map(|row| Ok(Row(taken_apart(row)?))).collect()
    }

    fn change(&self, sql: &str, values: &[Value]) -> Result<u64, StoreError> {
        let mut link = self.0.borrow_mut();
        let statement = Open::statement(&mut link, sql)?;
        Ok(link.client.execute(&statement, &bound(&values[..statement.params().len()]))?)
    }

    fn with_numbers(&self) -> &'static str {
        " OVERRIDING SYSTEM VALUE"
    }

    fn count_on(&self, table: &str, column: &str) -> Result<(), StoreError> {
        let sql = format!(
            "SELECT setval(pg_get_serial_sequence('{table}', '{column}'), max({column})) FROM {table} HAVING max({column}) > 0"
        );
        self.rows(&sql, &[]).map(|_| ())
    }
}

impl ToSql for Value {
    fn to_sql(&self, kind: &Type, out: &mut BytesMut) -> Result<IsNull, Box<dyn Error + Sync + Send>> {
        match self {
            Value::Null => Ok(IsNull::Yes),
            Value::Bool(value) => value.to_sql(kind, out),
            Value::Int(number) if *kind == Type::INT4 => i32::try_from(*number)?.to_sql(kind, out),
            Value::Int(number) => number.to_sql(kind, out),
            Value::Text(text) => text.to_sql(kind, out),
            Value::Bytes(bytes) => bytes.to_sql(kind, out),
        }
    }

    fn accepts(kind: &Type) -> bool {
        [Type::BOOL, Type::INT4, Type::INT8, Type::TEXT, Type::VARCHAR, Type::BYTEA].contains(kind)
    }

    to_sql_checked!();
}

/// The message of the server, or the reason why no server answers.
pub(super) fn words(error: &postgres::Error) -> String {
    let own = error.as_db_error().map(|said| said.message().to_owned());
    own.unwrap_or_else(|| match error.source() {
        Some(source) => format!("{error}: {source}"),
        None => error.to_string(),
    })
}

impl From<postgres::Error> for StoreError {
    fn from(error: postgres::Error) -> StoreError {
        let state = error.code();
        if state == Some(&SqlState::UNIQUE_VIOLATION) {
            return StoreError::Exists;
        }
        if state == Some(&SqlState::DISK_FULL) {
            return StoreError::Full;
        }
        // The server ends, or the connection is gone: whether a change was made is to be asked again.
        let gone = error.is_closed()
            || state.is_none_or(|state| {
                [&SqlState::ADMIN_SHUTDOWN, &SqlState::CRASH_SHUTDOWN, &SqlState::CANNOT_CONNECT_NOW]
                    .contains(&state)
            });
        match gone {
            true => StoreError::Busy,
            false => StoreError::Database(words(&error)),
        }
    }
}
