//! One way of speaking to both databases: statements with `$1`, values, rows.
//!
//! Statements are in the part of SQL that SQLite and PostgreSQL have in common. A value of which a statement does not say
//! what it is compared with is cast: `CAST($1 AS TEXT) IS NULL`.

use super::StoreError;

/// A value of a statement, or of a row.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    Null,
    Bool(bool),
    Int(i64),
    Text(String),
    Bytes(Vec<u8>),
}

/// Makes values of anything that can be one.
macro_rules! values {
    ($($value:expr),* $(,)?) => { &[$($crate::store::session::Value::from($value)),*] };
}

pub(super) use values;

impl From<bool> for Value {
    fn from(value: bool) -> Value {
        Value::Bool(value)
    }
}

impl From<i64> for Value {
    fn from(value: i64) -> Value {
        Value::Int(value)
    }
}

impl From<u32> for Value {
    fn from(value: u32) -> Value {
        Value::Int(value.into())
    }
}

impl From<&str> for Value {
    fn from(value: &str) -> Value {
        Value::Text(value.to_owned())
    }
}

impl From<&String> for Value {
    fn from(value: &String) -> Value {
        Value::Text(value.clone())
    }
}

impl From<String> for Value {
    fn from(value: String) -> Value {
        Value::Text(value)
    }
}

impl From<&[u8]> for Value {
    fn from(value: &[u8]) -> Value {
        Value::Bytes(value.to_vec())
    }
}

impl<T: Into<Value>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Value {
        value.map_or(Value::Null, T::into)
    }
}

impl From<&Option<String>> for Value {
    fn from(value: &Option<String>) -> Value {
        value.as_deref().into()
    }
}

/// A row. Each value is taken once, in any order.
#[derive(Debug)]
pub(super) struct Row(pub(super) Vec<Value>);

impl Row {
    fn take(&mut self, column: usize) -> Value {
        self.0.get_mut(column).map_or(Value::Null, |value| std::mem::replace(value, Value::Null))
    }

    fn wrong<T>(column: usize, value: &Value) -> Result<T, StoreError> {
        Err(StoreError::Database(format!("column {column} has another type: {value:?}")))
    }

    /// Text.
    pub(super) fn text(&mut self, column: usize) -> Result<String, StoreError> {
        match self.take(column) {
            Value::Text(text) => Ok(text),
            other => Row::wrong(column, &other),
        }
    }

    /// Text, or nothing.
    pub(super) fn maybe_text(&mut self, column: usize) -> Result<Option<String>, StoreError> {
        match self.take(column) {
            Value::Null => Ok(None),
            Value::Text(text) => Ok(Some(text)),
            other => Row::wrong(column, &other),
        }
    }

    /// A number.
    pub(super) fn int(&mut self, column: usize) -> Result<i64, StoreError> {
        match self.take(column) {
            Value::Int(number) => Ok(number),
            other => Row::wrong(column, &other),
        }
    }

    /// A number, or nothing.
    pub(super) fn maybe_int(&mut self, column: usize) -> Result<Option<i64>, StoreError> {
        match self.take(column) {
            Value::Null => Ok(None),
            Value::Int(number) => Ok(Some(number)),
            other => Row::wrong(column, &other),
        }
    }

    /// Yes or no. SQLite keeps it as a number.
    pub(super) fn is(&mut self, column: usize) -> Result<bool, StoreError> {
        match self.take(column) {
            Value::Bool(value) => Ok(value),
            Value::Int(number) => Ok(number != 0),
            other => Row::wrong(column, &other),
        }
    }

    /// Bytes, or nothing.
    pub(super) fn maybe_bytes(&mut self, column: usize) -> Result<Option<Vec<u8>>, StoreError> {
        match self.take(column) {
            Value::Null => Ok(None),
            Value::Bytes(bytes) => Ok(Some(bytes)),
            other => Row::wrong(column, &other),
        }
    }

    /// Bytes.
    pub(super) fn bytes(&mut self, column: usize) -> Result<Vec<u8>, StoreError> {
        match self.take(column) {
            Value::Bytes(bytes) => Ok(bytes),
            other => Row::wrong(column, &other),
        }
    }
}

/// A transaction that is open.
pub(super) trait Session {
    /// The rows of a statement.
    fn rows(&self, sql: &str, values: &[Value]) -> Result<Vec<Row>, StoreError>;

    /// Carries a statement out; gives how many rows it has changed.
    fn change(&self, sql: &str, values: &[Value]) -> Result<u64, StoreError>;

    /// The words with which a new row has the number that a statement says, in a column that the database counts up.
    fn with_numbers(&self) -> &'static str;

    /// Has the database count a column up from its greatest number on. Names are those of the schema.
    fn count_on(&self, table: &str, column: &str) -> Result<(), StoreError>;
}

impl dyn Session + '_ {
    /// The first row of a statement, if it has one.
    pub(super) fn maybe_row(&self, sql: &str, values: &[Value]) -> Result<Option<Row>, StoreError> {
        Ok(self.rows(sql, values)?.into_iter().next())
    }

    /// The first row of a statement.
    ///
    /// # Errors
    /// It has none: [`StoreError::Absent`].
    pub(super) fn row(&self, sql: &str, values: &[Value]) -> Result<Row, StoreError> {
        self.maybe_row(sql, values)?.ok_or(StoreError::Absent)
    }

    /// The rows of a statement, read.
    pub(super) fn read<T>(
        &self,
        sql: &str,
        values: &[Value],
        read: impl Fn(Row) -> Result<T, StoreError>,
    ) -> Result<Vec<T>, StoreError> {
        self.rows(sql, values)?.into_iter().map(read).collect()
    }
}
