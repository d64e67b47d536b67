//! Accounts and the audit for the command line, without a server.

use super::checks::{account, password_fits, rights};
use super::passwords;
use super::secrets;
use super::tokens::make;
use crate::Cost;
use crate::http::Problem;
use crate::rights::{Right, Role, Scope, Who};
use crate::store::{AccountChange, Place, Store, StoreError};

/// Accounts that are read at once.
const PIECE: u32 = 1000;

/// A reason, and help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UsersError {
    /// The reason.
    pub reason: String,
    /// An action of the user, if there is one.
    pub help: Option<String>,
}

impl From<Problem> for UsersError {
    fn from(problem: Problem) -> UsersError {
        UsersError { reason: problem.detail().to_owned(), help: problem.first_help().map(str::to_owned) }
    }
}

impl From<StoreError> for UsersError {
    fn from(error: StoreError) -> UsersError {
        let help = match error {
            StoreError::LastAdmin => {
                Some("the first account, and one at least, has --role admin without --folder")
            }
            _ => None,
        };
        UsersError { reason: error.to_string(), help: help.map(str::to_owned) }
    }
}

/// The accounts of a database.
pub struct Users {
    store: Store,
    cost: Cost,
}

impl Users {
    /// Those of a database; what changes is noted under the name of the user of this computer.
    ///
    /// # Errors
    /// The database cannot be used.
    pub fn open(place: &Place, author: &str) -> Result<Users, UsersError> {
        Users::with_cost(place, author, Cost::default())
    }

    /// The same, with passwords of another cost.
    ///
    /// # Errors
    /// As of [`Users::open`].
    pub fn with_cost(place: &Place, author: &str, cost: Cost) -> Result<Users, UsersError> {
        let store = Store::open(place)?.of(Who::command(author).into());
        Ok(Users { store, cost })
    }

    /// The name and the rights fit.
    ///
    /// # Errors
    /// One does not.
    pub fn check(name: &str, role: Role, folder: &str) -> Result<(), UsersError> {
        account(name)?;
        Ok(rights(&[Right { folder: folder.to_owned(), role }])?)
    }

    fn digest(&self, password: &str) -> Result<String, UsersError> {
        password_fits(password)?;
        Ok(passwords::digest(password, self.cost).ok_or_else(Problem::fault)?)
    }

    /// Makes an account with a role in a folder; the empty folder is everything.
    ///
    /// # Errors
    /// The name is taken, it is the first one and no admin of everything, or the password is too short.
    pub fn add(&self, name: &str, role: Role, folder: &str, password: &str) -> Result<(), UsersError> {
        Users::check(name, role, folder)?;
        let digest = self.digest(password)?;
        let right = Right { folder: folder.to_owned(), role };
        Ok(self.store.create_account(name, &digest, &[right]).map(|_| ())?)
    }

    /// Whether there is such an account.
    ///
    /// # Errors
    /// There is none.
    pub fn is_there(&self, name: &str) -> Result<(), UsersError> {
        Ok(self.store.account(name).map(|_| ())?)
    }

    /// A line for each account: its name, its rights, and whether it is disabled.
    ///
    /// # Errors
    /// The database.
    pub fn list(&self) -> Result<Vec<String>, UsersError> {
        let (mut lines, mut after) = (Vec::new(), String::new());
        loop {
            let piece = self.store.accounts(&after, PIECE)?;
            let Some(last) = piece.last() else { return Ok(lines) };
            after.clone_from(&last.name);
            for own in piece {
                let right = |right: &Right| match right.folder.as_str() {
                    "" => right.role.name().to_owned(),
                    folder => format!("{} in {folder}", right.role.name()),
                };
                let rights = own.rights.iter().map(right).collect::<Vec<_>>().join(", ");
                let disabled = if own.is_disabled { " (disabled)" } else { "" };
                lines.push(format!("{}: {rights}{disabled}", own.name));
            }
        }
    }

    /// Disables an account: its sessions and tokens end.
    ///
    /// # Errors
    /// There is none, or it is the last admin.
    pub fn disable(&self, name: &str) -> Result<(), UsersError> {
        let change = AccountChange { is_disabled: Some(true), ..AccountChange::default() };
        Ok(self.store.change_account(name, &change).map(|_| ())?)
    }

    /// Gives an account another password: its sessions and tokens end.
    ///
    /// # Errors
    /// There is none, or the password is too short.
    pub fn password(&self, name: &str, password: &str) -> Result<(), UsersError> {
        let change = AccountChange { password: Some(self.digest(password)?), ..AccountChange::default() };
        Ok(self.store.change_account(name, &change).map(|_| ())?)
    }

    /// Makes a token of an account, and gives its secret.
    ///
    /// # Errors
    /// There is no such account, or its end is not of the form.
    pub fn token(
        &self,
        account: &str,
        name: &str,
        scopes: Vec<Scope>,
        expires: Option<&str>,
    ) -> Result<String, UsersError> {
        let made = make(name, scopes, expires)?;
        self.store.create_token(account, &made.token, &secrets::kept(&made.secret))?;
        Ok(made.secret)
    }

    /// Follows the chain of the audit: a line about its end.
    ///
    /// # Errors
    /// An entry was changed, put in or taken out.
    pub fn audit(&self) -> Result<String, UsersError> {
        let chain = self.store.follow_chain()?;
        match chain.broken {
            Some(number) => Err(UsersError {
                reason: format!("entry {number} of the audit does not follow the one before it"),
                help: Some("an entry was changed, put in or taken out in the database itself".to_owned()),
            }),
            None => Ok(format!(
                "{} entries, each follows the one before it; the last has {}",
                chain.entries, chain.digest
            )),
        }
    }
}
