//! The database that a command is about.

use std::path::PathBuf;

use clap::Args;
use ncc_driver::problem::{Exit, Problem};
use ncc_service::Place;

/// The variable that names a PostgreSQL server. Its password is no argument, which others could read.
const URL: &str = "NCC_DATABASE_URL";

/// The database.
#[derive(Debug, Args)]
pub struct Database {
    /// The file of the database; it is made where it is not there [default: the server that NCC_DATABASE_URL names, or ncc.sqlite]
    #[arg(long, value_name = "FILE")]
    pub database: Option<PathBuf>,
}

impl Database {
    /// Its place.
    ///
    /// # Errors
    /// The variable names none.
    pub fn place(&self) -> Result<Place, Problem> {
        let wrong = || {
            Problem::usage(
                format!("{URL} is no address of a database"),
                "postgres://USER:PASSWORD@HOST/DATABASE, or sqlite:FILE",
            )
        };
        let url = std::env::var_os(URL).filter(|url| !url.is_empty());
        match (&self.database, url) {
            (Some(file), _) => Ok(Place::File(file.clone())),
            (None, None) => Ok(Place::File(PathBuf::from("ncc.sqlite"))),
            (None, Some(url)) => {
                let url = url.into_string().map_err(|_| wrong())?;
                if url.starts_with("postgres://") || url.starts_with("postgresql://") {
                    return Ok(Place::Server(url));
                }
                url.strip_prefix("sqlite:").map(|file| Place::File(PathBuf::from(file))).ok_or_else(wrong)
            }
        }
    }
}

/// A database that cannot be used.
pub(super) fn unusable(reason: &str) -> Problem {
    Problem {
        exit: Exit::File,
        message: format!("cannot use the database: {reason}"),
        help: vec![format!("name a file: --database FILE, or a server: {URL}=postgres://…")],
    }
}

/// The name under which changes are kept: the stated one, or that of the user of this computer.
pub(super) fn author(stated: Option<&str>) -> String {
    let of_the_computer = || ["USER", "USERNAME"].iter().find_map(|name| std::env::var(name).ok());
    let name = stated.map(str::to_owned).filter(|name| !name.is_empty()).or_else(of_the_computer);
    name.filter(|name| !name.is_empty()).unwrap_or_else(|| "unknown".to_owned())
}
