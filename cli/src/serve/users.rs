//! `ncc serve user`: accounts of the service, and `ncc serve audit`: the chain of its audit.
//!
//! A password is typed, or comes by a pipe. It is never an argument, which other users of the computer could read. Not
//! here: accounts themselves (`ncc_service`).

use std::io::{BufRead, IsTerminal, Read};

use clap::builder::PossibleValuesParser;
use clap::{Args, Subcommand};
use ncc_driver::problem::{Exit, Problem};
use ncc_service::{Role, Scope, Users, UsersError};

use super::database::{Database, author};
use crate::files;

/// Bytes of a password that are read at most.
const LONGEST: u64 = 4096;

/// `ncc serve user`.
#[derive(Debug, Subcommand)]
pub enum User {
    /// Makes an account; its password is asked for, or read from a pipe
    Add(Add),
    /// Lists the accounts, with their rights
    List(Database),
    /// Disables an account: its sessions and tokens end
    Disable(Named),
    /// Gives an account another password: its sessions and tokens end
    Password(Named),
    /// Makes a token of an account, and prints it once
    Token(Token),
}

/// `ncc serve user add`.
#[derive(Debug, Args)]
pub struct Add {
    /// The name: small letters, digits, `.`, `_`, `-`, `@`
    pub name: String,
    /// Its role
    #[arg(long, value_name = "ROLE", value_parser = PossibleValuesParser::new(Role::NAMES))]
    pub role: String,
    /// The folder in which it has the role, with those below it [default: everything]
    #[arg(long, value_name = "FOLDER", default_value = "", hide_default_value = true)]
    pub folder: String,
    /// The database
    #[command(flatten)]
    pub database: Database,
}

/// An account of a database.
#[derive(Debug, Args)]
pub struct Named {
    /// The name of the account
    pub name: String,
    /// The database
    #[command(flatten)]
    pub database: Database,
}

/// `ncc serve user token`.
#[derive(Debug, Args)]
pub struct Token {
    /// The name of the account
    pub name: String,
    /// The name of the token
    #[arg(long = "for", value_name = "NAME")]
    pub purpose: String,
    /// Its share of the rights of the account; each includes to read
    #[arg(long = "scope", value_name = "SCOPE", default_value = "read", value_parser = PossibleValuesParser::new(Scope::NAMES))]
    pub scopes: Vec<String>,
    /// Its end: 2027-01-01T00:00:00Z [default: in 90 days]
    #[arg(long, value_name = "MOMENT")]
    pub expires: Option<String>,
    /// The database
    #[command(flatten)]
    pub database: Database,
}

fn problem(error: UsersError) -> Problem {
    Problem { exit: Exit::Usage, message: error.reason, help: error.help.into_iter().collect() }
}

fn open(database: &Database) -> Result<Users, Problem> {
    Users::open(&database.place()?, &author(None)).map_err(|error| super::database::unusable(&error.reason))
}

/// Reads a password: without echo from a terminal, twice, or a line from a pipe.
fn password() -> Result<String, Problem> {
    let cannot = |error: std::io::Error| Problem::file("read", "the password", &error);
    let stdin = std::io::stdin();
    if !stdin.is_terminal() {
        let mut line = String::new();
        stdin.lock().take(LONGEST).read_line(&mut line).map_err(cannot)?;
        return Ok(line.trim_end_matches(['\n', '\r']).to_owned());
    }
    let first = rpassword::prompt_password("password: ").map_err(cannot)?;
    let again = rpassword::prompt_password("the same again: ").map_err(cannot)?;
    if first == again { Ok(first) } else { Err(Problem::usage("the passwords differ", "type it twice")) }
}

/// Carries a command about accounts out.
///
/// # Errors
/// Wrong usage, or a database that cannot be used.
pub(super) fn run(user: &User) -> Result<(), Problem> {
    match user {
        User::Add(args) => {
            let role = Role::named(&args.role).unwrap_or(Role::Reader);
            Users::check(&args.name, role, &args.folder).map_err(problem)?;
            let users = open(&args.database)?;
            users.add(&args.name, role, &args.folder, &password()?).map_err(problem)
        }
        User::List(database) => {
            let lines = open(database)?.list().map_err(problem)?;
            files::to_stdout(&mut |out| lines.iter().try_for_each(|line| writeln!(out, "{line}")))
        }
        User::Disable(args) => open(&args.database)?.disable(&args.name).map_err(problem),
        User::Password(args) => {
            let users = open(&args.database)?;
            users.is_there(&args.name).map_err(problem)?;
            users.password(&args.name, &password()?).map_err(problem)
        }
        User::Token(args) => {
            let scopes = args.scopes.iter().filter_map(|name| Scope::named(name)).collect();
            let users = open(&args.database)?;
            let token = users.token(&args.name, &args.purpose, scopes, args.expires.as_deref());
            let token = token.map_err(problem)?;
            files::to_stdout(&mut |out| writeln!(out, "{token}"))
        }
    }
}

/// Follows the chain of the audit.
///
/// # Errors
/// It is broken: exit code 1; or the database cannot be used.
pub(super) fn audit(database: &Database) -> Result<(), Problem> {
    let users = open(database)?;
    let broken = |error: UsersError| Problem { exit: Exit::Refused, ..problem(error) };
    let line = users.audit().map_err(broken)?;
    files::to_stdout(&mut |out| writeln!(out, "{line}"))
}
