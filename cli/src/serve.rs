//! `ncc serve`: the service in this process.
//!
//! Not here: what it answers (`ncc_service`).

use std::net::SocketAddr;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use ncc_driver::problem::Problem;
use ncc_service::{OpenError, Part, Place, Service};

use crate::files;

/// `ncc serve`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  ncc serve                                     all services, the documents in ncc.sqlite
  NCC_DATABASE_URL=postgres://ncc@localhost/ncc ncc serve
                                                the documents in a PostgreSQL database
  ncc serve --only persistence --listen 127.0.0.1:8275
  ncc serve --only transpiler --persistence http://127.0.0.1:8275

It answers this computer alone (127.0.0.1), without a login. Ctrl-C ends it: requests that are being answered end first.")]
pub struct Serve {
    /// Address and port; port 0 is any that is free
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:8274")]
    pub listen: SocketAddr,
    /// The file of the database; it is made where it is not there [default: the server that NCC_DATABASE_URL names, or ncc.sqlite]
    #[arg(long, value_name = "FILE")]
    pub database: Option<PathBuf>,
    /// The name under which changes are kept [default: that of the user of this computer]
    #[arg(long, value_name = "NAME")]
    pub author: Option<String>,
    /// One of the services alone
    #[arg(long, value_name = "SERVICE")]
    pub only: Option<Only>,
    /// The address of PERSISTENCE, for `--only transpiler` and `--only output`
    #[arg(long, value_name = "URL")]
    pub persistence: Option<String>,
}

/// One of the services.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Only {
    /// A program in, its document stored
    Transpiler,
    /// Documents stored and restored
    Persistence,
    /// Tables and lists from a stored document
    Output,
}

/// The variable that names a PostgreSQL server. Its password is no argument, which others could read.
const URL: &str = "NCC_DATABASE_URL";

/// The place of the database.
fn place(args: &Serve) -> Result<Place, Problem> {
    let wrong = || {
        Problem::usage(
            format!("{URL} is no address of a database"),
            "postgres://USER:PASSWORD@HOST/DATABASE, or sqlite:FILE",
        )
    };
    let url = std::env::var_os(URL).filter(|url| !url.is_empty());
    match (&args.database, url) {
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

/// The name under which changes are kept.
fn author(args: &Serve) -> String {
    let of_the_computer = || ["USER", "USERNAME"].iter().find_map(|name| std::env::var(name).ok());
    let name = args.author.clone().or_else(of_the_computer).filter(|name| !name.is_empty());
    name.unwrap_or_else(|| "unknown".to_owned())
}

/// The services that the command line asks for.
fn part(args: &Serve) -> Result<Part, Problem> {
    let elsewhere = || {
        let needed = || Problem::usage("this service needs the address of PERSISTENCE", "--persistence URL");
        let address = args.persistence.clone().ok_or_else(needed)?;
        let plain = Problem::usage(format!("`{address}` is no address of a service"), "http://HOST:PORT");
        if address.starts_with("http://") { Ok(address) } else { Err(plain) }
    };
    let part = match args.only {
        None => Part::All { database: place(args)? },
        Some(Only::Persistence) => Part::Persistence { database: place(args)? },
        Some(Only::Transpiler) => return Ok(Part::Transpiler { persistence: elsewhere()? }),
        Some(Only::Output) => return Ok(Part::Output { persistence: elsewhere()? }),
    };
    match args.persistence {
        None => Ok(part),
        Some(_) => Err(Problem::usage(
            "--persistence with a process that has the store itself",
            "leave it out, or say which service runs alone: --only transpiler, --only output",
        )),
    }
}

/// Opens the service, and serves until the process is asked to stop.
///
/// # Errors
/// Wrong usage, an address that is taken, a database that cannot be used, or the network.
pub fn run(args: &Serve) -> Result<(), Problem> {
    let service = Service::open(args.listen, &part(args)?, &author(args)).map_err(|error| match error {
        OpenError::NotThisComputer => Problem::usage(
            format!("{} is no address of this computer alone", args.listen),
            "there are no logins yet, so it answers this computer only: --listen 127.0.0.1:8274",
        ),
        OpenError::Address(error) => Problem::usage(
            format!("cannot listen on {}: {error}", args.listen),
            "name another port, such as --listen 127.0.0.1:8275, or 0 for any that is free",
        ),
        OpenError::Database(reason) => Problem {
            exit: ncc_driver::problem::Exit::File,
            message: format!("cannot use the database: {reason}"),
            help: vec![format!("name a file: --database FILE, or a server: {URL}=postgres://…")],
        },
    })?;
    files::to_stdout(&mut |out| writeln!(out, "{}", service.address()))?;
    service.serve().map_err(|error| Problem::file("serve", &args.listen.to_string(), &error))
}
