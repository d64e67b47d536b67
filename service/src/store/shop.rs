//! Texts of a shop that programs depend on, by their names, and their revisions: profiles of machines, and dictionaries of
//! dialects. Whoever may read anything may read them: programs are made for them, and in them.

use super::documents::{Condition, now};
use super::facts::shop_changed;
use super::session::{Row, Session, values};
use super::{Store, StoreError, digest};
use crate::rights::Act;

/// A sort of texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sort {
    /// Profiles.
    Machine,
    /// Dictionaries.
    Dialect,
}

impl Sort {
    /// Its name, in addresses, in the audit and of its table.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Sort::Machine => "machine",
            Sort::Dialect => "dialect",
        }
    }
}

/// A profile or a dictionary.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ShopText {
    /// Its name.
    pub(crate) name: String,
    /// Its text, as its owner wrote it.
    pub(crate) text: String,
    /// Changes whenever its text does.
    pub(crate) tag: String,
}

/// A revision of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ShopRevision {
    /// Its number, from 1.
    pub(crate) number: i64,
    /// The text from then on; `None` where it was deleted.
    pub(crate) text: Option<String>,
    /// The tag of that text; empty without a text.
    pub(crate) tag: String,
    /// The account that made it; empty of profiles that are older than their revisions.
    pub(crate) author: String,
    /// Its time, seconds since 1970 (UTC).
    pub(crate) made: i64,
}

fn revision(mut row: Row) -> Result<ShopRevision, StoreError> {
    let text = Some(row.text(1)?).filter(|text| !text.is_empty());
    Ok(ShopRevision { number: row.int(0)?, text, tag: row.text(2)?, author: row.text(3)?, made: row.int(4)? })
}

fn shop_text(mut row: Row) -> Result<ShopText, StoreError> {
    Ok(ShopText { name: row.text(0)?, text: row.text(1)?, tag: row.text(2)? })
}

impl Store {
    /// The text of a name.
    pub(crate) fn shop_text(&self, sort: Sort, name: &str) -> Result<ShopText, StoreError> {
        if !self.who.reads_anything() {
            return Err(StoreError::Absent);
        }
        let one = format!("SELECT name, text, tag FROM {} WHERE name = $1", sort.name());
        self.database.read(|from| shop_text(from.row(&one, values![name])?))
    }

    /// All texts, in the order of their names.
    pub(crate) fn shop_texts(&self, sort: Sort) -> Result<Vec<ShopText>, StoreError> {
        if !self.who.reads_anything() {
            return Ok(Vec::new());
        }
        let all = format!("SELECT name, text, tag FROM {} ORDER BY name", sort.name());
        self.database.read(|from| from.read(&all, values![], shop_text))
    }

    /// Keeps a text; gives its tag, and whether the name is new. `touched` are names of others that it changes too.
    pub(crate) fn keep_shop_text(
        &self,
        sort: Sort,
        name: &str,
        text: &str,
        touched: &[String],
        over: &Condition,
    ) -> Result<(String, bool), StoreError> {
        self.may(Act::Administer, "")?;
        let table = sort.name();
        self.database.write(|to| {
            let before = format!("SELECT tag FROM {table} WHERE name = $1");
            let before = to.maybe_row(&before, values![name])?.map(|mut row| row.text(0)).transpose()?;
            match (&before, over) {
                (None, Condition::OneOf(_)) => return Err(StoreError::Changed),
                (None, Condition::Any) => {}
                (Some(tag), over) => over.holds(tag)?,
            }
            let tag = digest(&[text.as_bytes()]);
            to.change(
                &format!(
                    "INSERT INTO {table} (name, text, tag, changed) VALUES ($1, $2, $3, $4)
                     ON CONFLICT (name) DO UPDATE SET text = excluded.text, tag = excluded.tag, changed = excluded.changed"
                ),
                values![name, text, &tag, now()],
            )?;
            if before.as_ref() != Some(&tag) {
                self.revised(to, sort, name, [text, &tag])?;
            }
            shop_changed(to, name)?;
            touched.iter().try_for_each(|other| shop_changed(to, other))?;
            self.note(to, &format!("{table}.put"), name, &tag)?;
            Ok((tag, before.is_none()))
        })
    }

    /// Lets go of a text.
    pub(crate) fn delete_shop_text(
        &self,
        sort: Sort,
        name: &str,
        over: &Condition,
    ) -> Result<(), StoreError> {
        self.may(Act::Administer, "")?;
        let table = sort.name();
        self.database.write(|to| {
            let tag = format!("SELECT tag FROM {table} WHERE name = $1");
            over.holds(&to.row(&tag, values![name])?.text(0)?)?;
            to.change(&format!("DELETE FROM {table} WHERE name = $1"), values![name])?;
            self.revised(to, sort, name, ["", ""])?;
            shop_changed(to, name)?;
            self.note(to, &format!("{table}.delete"), name, "")
        })
    }

    /// Adds a revision with a text and its tag.
    fn revised(
        &self,
        to: &dyn Session,
        sort: Sort,
        name: &str,
        [text, tag]: [&str; 2],
    ) -> Result<(), StoreError> {
        let table = sort.name();
        let last = format!("SELECT COALESCE(MAX(number), 0) FROM {table}_revision WHERE name = $1");
        let number = to.row(&last, values![name])?.int(0)? + 1;
        to.change(
            &format!(
                "INSERT INTO {table}_revision (name, number, text, tag, author, made) VALUES ($1, $2, $3, $4, $5, $6)"
            ),
            values![name, number, text, tag, &self.who.name, now()],
        )?;
        Ok(())
    }

    /// Revisions of a text before a number, the newest first, so many at most. A deleted one has them too.
    pub(crate) fn shop_revisions(
        &self,
        sort: Sort,
        name: &str,
        before: i64,
        most: u32,
    ) -> Result<Vec<ShopRevision>, StoreError> {
        if !self.who.reads_anything() {
            return Err(StoreError::Absent);
        }
        let table = sort.name();
        self.database.read(|from| {
            let any = format!("SELECT 1 FROM {table}_revision WHERE name = $1 LIMIT 1");
            from.row(&any, values![name])?;
            from.read(
                &format!(
                    "SELECT number, text, tag, author, made FROM {table}_revision WHERE name = $1 AND number < $2
                     ORDER BY number DESC LIMIT $3"
                ),
                values![name, before, i64::from(most)],
                revision,
            )
        })
    }

    /// A revision of a text.
    pub(crate) fn shop_revision(
        &self,
        sort: Sort,
        name: &str,
        number: i64,
    ) -> Result<ShopRevision, StoreError> {
        if !self.who.reads_anything() {
            return Err(StoreError::Absent);
        }
        let one = format!(
            "SELECT number, text, tag, author, made FROM {}_revision WHERE name = $1 AND number = $2",
            sort.name()
        );
        self.database.read(|from| revision(from.row(&one, values![name, number])?))
    }
}
