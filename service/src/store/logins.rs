//! Sessions and tokens: the digests of their secrets, and the accounts that have them.

use super::accounts::holding;
use super::documents::now;
use super::session::{Row, values};
use super::{Store, StoreError};
use crate::rights::{Right, Scope, Via, Who};

/// Seconds after which a session that is used is marked as used: not each request writes.
const MARKED: i64 = 60;

/// Seconds after which a session ends, however much it is used.
pub(crate) const LONGEST: i64 = 7 * 86_400;

/// A token without its secret.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Token {
    /// Its name in addresses.
    pub(crate) id: String,
    /// The name that its owner gave it.
    pub(crate) name: String,
    /// Its share of the rights of its account.
    pub(crate) scopes: Vec<Scope>,
    /// When it was made, seconds since 1970 (UTC).
    pub(crate) made: i64,
    /// When it ends, seconds since 1970 (UTC).
    pub(crate) expires: i64,
}

impl Store {
    /// The account of a session that was used within so many seconds, with its rights.
    pub(crate) fn of_login(&self, digest: &str, idle: i64) -> Result<Option<Who>, StoreError> {
        let time = now();
        let found = self.database.read(|from| {
            let row = from.maybe_row(
                "SELECT l.account, l.seen FROM login l JOIN account a ON a.name = l.account
                 WHERE l.digest = $1 AND l.seen > $2 AND l.made > $3 AND NOT a.is_disabled",
                values![digest, time - idle, time - LONGEST],
            )?;
            let Some(mut row) = row else { return Ok(None) };
            let name = row.text(0)?;
            let who = Who::account(&name, holding(from, &name)?, Via::Login(digest.to_owned()));
            Ok(Some((who, row.int(1)?)))
        })?;
        if found.as_ref().is_some_and(|(_, seen)| *seen < time - MARKED) {
            self.database.write(|to| {
                to.change("UPDATE login SET seen = $2 WHERE digest = $1", values![digest, time])
            })?;
        }
        Ok(found.map(|(who, _)| who))
    }

    /// The same store with the rights that the user has now, for an answer that goes on for long.
    ///
    /// # Errors
    /// The session or the token has ended meanwhile.
    pub(crate) fn renewed(&self) -> Result<Store, StoreError> {
        let (sql, of) = match &self.who.via {
            Via::Login(digest) => (
                "SELECT l.account FROM login l JOIN account a ON a.name = l.account
                 WHERE l.digest = $1 AND l.made <= $2 AND NOT a.is_disabled",
                digest,
            ),
            Via::Token(id, _) => (
                "SELECT t.account FROM token t JOIN account a ON a.name = t.account
                 WHERE t.id = $1 AND t.expires > $2 AND NOT a.is_disabled",
                id,
            ),
            _ => return Ok(self.clone()),
        };
        self.database.read(|from| {
            from.row(sql, values![of, now()])?;
            let rights = holding(from, &self.who.name)?;
            Ok(self.of(Who { rights, ..Who::clone(&self.who) }.into()))
        })
    }

    /// Begins a session of an account; sessions that are over are let go of, and so is the one before it.
    pub(crate) fn log_in(
        &self,
        name: &str,
        digest: &str,
        before: Option<&str>,
        idle: i64,
    ) -> Result<Vec<Right>, StoreError> {
        self.database.write(|to| {
            let time = now();
            to.change(
                "DELETE FROM login WHERE seen <= $1 OR made <= $2",
                values![time - idle, time - LONGEST],
            )?;
            if let Some(before) = before {
                to.change("DELETE FROM login WHERE digest = $1", values![before])?;
            }
            to.change(
                "INSERT INTO login (digest, account, made, seen) VALUES ($1, $2, $3, $4)",
                values![digest, name, time, time],
            )?;
            self.note(to, "login", name, "")?;
            holding(to, name)
        })
    }

    /// Ends a session.
    pub(crate) fn log_out(&self, digest: &str) -> Result<(), StoreError> {
        self.database.write(|to| {
            to.change("DELETE FROM login WHERE digest = $1", values![digest])?;
            self.note(to, "logout", &self.who.name, "")
        })
    }

    /// The account of a token that has not ended, with its rights.
    pub(crate) fn of_token(&self, digest: &str) -> Result<Option<Who>, StoreError> {
        self.database.read(|from| {
            let row = from.maybe_row(
                "SELECT t.id, t.account, t.scopes FROM token t JOIN account a ON a.name = t.account
                 WHERE t.digest = $1 AND t.expires > $2 AND NOT a.is_disabled",
                values![digest, now()],
            )?;
            let Some(mut row) = row else { return Ok(None) };
            let (id, name) = (row.text(0)?, row.text(1)?);
            let scopes = scopes(&row.text(2)?);
            Ok(Some(Who::account(&name, holding(from, &name)?, Via::Token(id, scopes))))
        })
    }

    /// Keeps a token of an account.
    pub(crate) fn create_token(&self, account: &str, token: &Token, digest: &str) -> Result<(), StoreError> {
        let scopes = token.scopes.iter().map(|scope| scope.name()).collect::<Vec<_>>().join(" ");
        self.database.write(|to| {
            to.row("SELECT name FROM account WHERE name = $1 AND NOT is_disabled", values![account])?;
            to.change(
                "INSERT INTO token (id, digest, account, name, scopes, made, expires) VALUES ($1, $2, $3, $4, $5, $6, $7)",
                values![&token.id, digest, account, &token.name, &scopes, token.made, token.expires],
            )?;
            self.note(to, "token.create", &token.id, &format!("{account}: {scopes}"))
        })
    }

    /// Tokens of the user's account, in the order of their names in addresses, those after one, so many at most.
    pub(crate) fn tokens(&self, after: &str, most: u32) -> Result<Vec<Token>, StoreError> {
        self.database.read(|from| {
            let token = |mut row: Row| {
                Ok(Token {
                    id: row.text(0)?,
                    name: row.text(1)?,
                    scopes: scopes(&row.text(2)?),
                    made: row.int(3)?,
                    expires: row.int(4)?,
                })
            };
            from.read(
                "SELECT id, name, scopes, made, expires FROM token
                 WHERE account = $1 AND id > $2 ORDER BY id LIMIT $3",
                values![&self.who.name, after, most],
                token,
            )
        })
    }

    /// Takes a token of the user's account back.
    pub(crate) fn delete_token(&self, id: &str) -> Result<(), StoreError> {
        self.database.write(|to| {
            let sql = "DELETE FROM token WHERE id = $1 AND account = $2";
            if to.change(sql, values![id, &self.who.name])? == 0 {
                return Err(StoreError::Absent);
            }
            self.note(to, "token.delete", id, &self.who.name)
        })
    }
}

fn scopes(words: &str) -> Vec<Scope> {
    words.split(' ').filter_map(Scope::named).collect()
}
