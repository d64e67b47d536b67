//! Accounts and their rights.

use super::documents::now;
use super::session::{Row, Session, values};
use super::{Store, StoreError};
use crate::rights::{Act, Right, Role};

/// An account.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Account {
    /// Its name.
    pub(crate) name: String,
    /// Whether it can do nothing any more.
    pub(crate) is_disabled: bool,
    /// When it was made, seconds since 1970 (UTC).
    pub(crate) made: i64,
    /// Its rights, in the order of their folders.
    pub(crate) rights: Vec<Right>,
}

/// Changes of an account; a field without a value stays.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct AccountChange {
    /// All of its rights.
    pub(crate) rights: Option<Vec<Right>>,
    /// Whether it can do nothing any more.
    pub(crate) is_disabled: Option<bool>,
    /// A digest of its password, as a PHC string.
    pub(crate) password: Option<String>,
}

impl Store {
    /// Whether there is an account: then a login is needed.
    pub(crate) fn has_accounts(&self) -> Result<bool, StoreError> {
        self.database
            .read(|from| Ok(from.maybe_row("SELECT name FROM account LIMIT 1", values![])?.is_some()))
    }

    /// Makes an account; the first one has to be an admin of everything.
    pub(crate) fn create_account(
        &self,
        name: &str,
        password: &str,
        rights: &[Right],
    ) -> Result<Account, StoreError> {
        self.may(Act::Administer, "")?;
        self.database.write(|to| {
            if to.maybe_row("SELECT name FROM account WHERE name = $1", values![name])?.is_some() {
                return Err(StoreError::Exists);
            }
            to.change(
                "INSERT INTO account (name, password, is_disabled, made) VALUES ($1, $2, FALSE, $3)",
                values![name, password, now()],
            )?;
            put_rights(to, name, rights)?;
            has_admin(to)?;
            self.note(to, "account.create", name, &described(rights))?;
            account(to, name)
        })
    }

    /// Changes an account. Another password, and the end of the account, end its sessions and its tokens.
    pub(crate) fn change_account(&self, name: &str, change: &AccountChange) -> Result<Account, StoreError> {
        self.may(Act::Administer, "")?;
        self.database.write(|to| {
            account(to, name)?;
            if let Some(rights) = &change.rights {
                put_rights(to, name, rights)?;
                self.note(to, "account.rights", name, &described(rights))?;
            }
            if let Some(password) = &change.password {
                to.change("UPDATE account SET password = $2 WHERE name = $1", values![name, password])?;
                self.note(to, "account.password", name, "")?;
            }
            if let Some(is_disabled) = change.is_disabled {
                to.change("UPDATE account SET is_disabled = $2 WHERE name = $1", values![name, is_disabled])?;
                self.note(to, if is_disabled { "account.disable" } else { "account.enable" }, name, "")?;
            }
            if change.password.is_some() || change.is_disabled == Some(true) {
                to.change("DELETE FROM login WHERE account = $1", values![name])?;
                to.change("DELETE FROM token WHERE account = $1", values![name])?;
            }
            has_admin(to)?;
            account(to, name)
        })
    }

    /// Changes the password of the user's account; its other sessions end.
    pub(crate) fn change_own_password(&self, password: &str, login: &str) -> Result<(), StoreError> {
        self.database.write(|to| {
            let name = &self.who.name;
            to.change("UPDATE account SET password = $2 WHERE name = $1", values![name, password])?;
            to.change("DELETE FROM login WHERE account = $1 AND digest <> $2", values![name, login])?;
            self.note(to, "account.password", name, "")
        })
    }

    /// An account.
    pub(crate) fn account(&self, name: &str) -> Result<Account, StoreError> {
        self.may(Act::Administer, "")?;
        self.database.read(|from| account(from, name))
    }

    /// Accounts in the order of their names, those after a name, so many at most.
    pub(crate) fn accounts(&self, after: &str, most: u32) -> Result<Vec<Account>, StoreError> {
        self.may(Act::Administer, "")?;
        self.database.read(|from| {
            let names = from.read(
                "SELECT name FROM account WHERE name > $1 ORDER BY name LIMIT $2",
                values![after, most],
                |mut row| row.text(0),
            )?;
            names.iter().map(|name| account(from, name)).collect()
        })
    }

    /// The digest of an account's password, and whether the account is disabled; nothing where there is no such account.
    pub(crate) fn password(&self, name: &str) -> Result<Option<(String, bool)>, StoreError> {
        self.database.read(|from| {
            let row =
                from.maybe_row("SELECT password, is_disabled FROM account WHERE name = $1", values![name])?;
            row.map(|mut row| Ok((row.text(0)?, row.is(1)?))).transpose()
        })
    }

    /// The rights that an account has now; none where it is disabled, or not there.
    pub(crate) fn rights(&self, name: &str) -> Result<Vec<Right>, StoreError> {
        self.database.read(|from| holding(from, name))
    }
}

/// The rights that an account has now.
pub(super) fn holding(from: &dyn Session, name: &str) -> Result<Vec<Right>, StoreError> {
    from.read("SELECT folder, rank FROM holding WHERE account = $1 ORDER BY folder", values![name], right)
}

fn right(mut row: Row) -> Result<Right, StoreError> {
    let (folder, rank) = (row.text(0)?, row.int(1)?);
    let role = Role::ranked(rank).ok_or_else(|| StoreError::Database(format!("no role has rank {rank}")))?;
    Ok(Right { folder, role })
}

fn account(from: &dyn Session, name: &str) -> Result<Account, StoreError> {
    let mut row = from.row("SELECT is_disabled, made FROM account WHERE name = $1", values![name])?;
    let rights = from.read(
        "SELECT folder, rank FROM account_right WHERE account = $1 ORDER BY folder",
        values![name],
        right,
    )?;
    Ok(Account { name: name.to_owned(), is_disabled: row.is(0)?, made: row.int(1)?, rights })
}

fn put_rights(to: &dyn Session, name: &str, rights: &[Right]) -> Result<(), StoreError> {
    to.change("DELETE FROM account_right WHERE account = $1", values![name])?;
    for right in rights {
        to.change(
            "INSERT INTO account_right (account, folder, rank) VALUES ($1, $2, $3)",
            values![name, &right.folder, right.role.rank()],
        )?;
    }
    Ok(())
}

/// Somebody can still administer.
fn has_admin(from: &dyn Session) -> Result<(), StoreError> {
    let admin = from.maybe_row(
        "SELECT account FROM holding WHERE folder = '' AND rank = $1 LIMIT 1",
        values![Role::Admin.rank()],
    )?;
    if admin.is_some() { Ok(()) } else { Err(StoreError::LastAdmin) }
}

/// Rights in one line.
fn described(rights: &[Right]) -> String {
    let one = |right: &Right| format!("{}:{}", right.role.name(), right.folder);
    rights.iter().map(one).collect::<Vec<_>>().join(" ")
}
