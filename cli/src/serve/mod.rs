//! `ncc serve`: the service in this process.
//!
//! Not here: what it answers (`ncc_service`), and accounts (`users`).

mod backup;
mod database;
mod import;
mod users;

use std::net::SocketAddr;
use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::problem::{Exit, Problem};
use ncc_service::{Hooks, Listen, LogForm, LogLevel, OpenError, Part, Service};

pub use self::database::Database;
use self::database::{author, unusable};
pub use self::users::User;
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
  ncc serve import programs/                    the programs of a folder
  ncc serve backup monday.sqlite                a copy of the database
  ncc serve user add ana --role admin           the first account
  ncc serve --listen 0.0.0.0:8274 --host ncc.shop.example --tls-cert cert.pem --tls-key key.pem
  ncc serve --hook-target https://erp.shop.example/ncc --hook-ca shop.pem
                                                hooks may tell these addresses of releases

It answers this computer alone (127.0.0.1), without a login, until there is an account. To answer
other computers it needs an account, TLS, and the names by which they ask. Ctrl-C ends it: requests
that are being answered end first.")]
#[command(args_conflicts_with_subcommands = true)]
pub struct Serve {
    /// Something else than to serve
    #[command(subcommand)]
    pub verb: Option<Verb>,
    /// Address and port; port 0 is any that is free
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:8274")]
    pub listen: SocketAddr,
    /// The database
    #[command(flatten)]
    pub database: Database,
    /// A name by which others ask for this server, with or without a port; may be given several times
    #[arg(long = "host", value_name = "NAME")]
    pub hosts: Vec<String>,
    /// The certificate and those that it rests on, PEM
    #[arg(long, value_name = "FILE", requires = "tls_key")]
    pub tls_cert: Option<PathBuf>,
    /// The private key of the certificate, PEM; other users of this computer cannot read it
    #[arg(long, value_name = "FILE", requires = "tls_cert")]
    pub tls_key: Option<PathBuf>,
    /// No TLS here: only behind a proxy on another host that ends TLS, in a network where nobody else listens
    #[arg(long, conflicts_with = "tls_cert")]
    pub plain_http: bool,
    /// The name under which changes are kept while there is no account [default: that of the user of this computer]
    #[arg(long, value_name = "NAME")]
    pub author: Option<String>,
    /// One of the services alone
    #[arg(long, value_name = "SERVICE")]
    pub only: Option<Only>,
    /// The address of PERSISTENCE, for `--only transpiler` and `--only output`
    #[arg(long, value_name = "URL")]
    pub persistence: Option<String>,
    /// An address, https or http, that hooks may tell of events, and all below it; may be given several times
    #[arg(long = "hook-target", value_name = "URL", conflicts_with = "only")]
    pub hook_targets: Vec<String>,
    /// Certificates of authorities for the targets of hooks, beside those of the web, PEM
    #[arg(long, value_name = "FILE", requires = "hook_targets")]
    pub hook_ca: Option<PathBuf>,
    /// Lines of the log, on stderr
    #[arg(long, value_name = "LINES", default_value = "faults")]
    pub log: Log,
    /// Form of the log
    #[arg(long, value_name = "FORM", default_value = "text")]
    pub log_format: LogFormat,
}

/// Lines of the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Log {
    /// Faults of the service
    Faults,
    /// Each request too: its name, method, path, status and time
    Requests,
}

/// Form of the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LogFormat {
    /// Lines for people
    Text,
    /// A JSON object a line
    Json,
}

/// Commands about the database of the service.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Accounts: as soon as there is one, a login is needed
    #[command(subcommand)]
    User(User),
    /// Puts the programs of a folder into the database
    Import(import::Import),
    /// Copies the database into a new file
    Backup(backup::Backup),
    /// Makes an empty database what a backup has
    Restore(backup::Restore),
    /// Follows the chain of the audit: whether an entry was changed, put in or taken out
    Audit(Database),
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

/// The services that the command line asks for.
fn part(args: &Serve) -> Result<Part, Problem> {
    let elsewhere = || {
        let needed = || Problem::usage("this service needs the address of PERSISTENCE", "--persistence URL");
        let address = args.persistence.clone().ok_or_else(needed)?;
        let plain = Problem::usage(format!("`{address}` is no address of a service"), "http://HOST:PORT");
        if address.starts_with("http://") { Ok(address) } else { Err(plain) }
    };
    let part = match args.only {
        None => Part::All { database: args.database.place()? },
        Some(Only::Persistence) => Part::Persistence { database: args.database.place()? },
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

/// The address, and the names by which the server is asked.
fn listen(args: &Serve) -> Listen {
    let tls = args.tls_cert.clone().zip(args.tls_key.clone());
    Listen {
        address: args.listen,
        hosts: args.hosts.clone(),
        tls: tls.map(|(certificate, key)| [certificate, key]),
        behind_proxy: args.plain_http,
    }
}

/// Opens the service, and serves until the process is asked to stop; or does another command about its database.
///
/// # Errors
/// Wrong usage, an address that is taken, a database that cannot be used, or the network.
pub fn run(args: &Serve, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    let done = |()| Exit::Done;
    match &args.verb {
        None => serve(args).map(done),
        Some(Verb::User(user)) => users::run(user).map(done),
        Some(Verb::Import(args)) => import::run(args, err),
        Some(Verb::Backup(args)) => backup::backup(args),
        Some(Verb::Restore(args)) => backup::restore(args),
        Some(Verb::Audit(database)) => users::audit(database).map(done),
    }
}

/// Begins the log.
fn log(args: &Serve) {
    let level = match args.log {
        Log::Faults => LogLevel::Faults,
        Log::Requests => LogLevel::Requests,
    };
    let form = match args.log_format {
        LogFormat::Text => LogForm::Text,
        LogFormat::Json => LogForm::Json,
    };
    ncc_service::log(level, form);
}

/// A service that cannot be opened, in words.
fn refused(args: &Serve, error: OpenError) -> Problem {
    match error {
        OpenError::NoAccount => Problem::usage(
            "other computers could ask, and there is no account",
            "make one: ncc serve user add NAME --role admin; or answer this computer alone: --listen 127.0.0.1:8274",
        ),
        OpenError::NoTls => Problem::usage(
            format!("{} is asked by other computers, without TLS", args.listen),
            "--tls-cert FILE --tls-key FILE; or --plain-http behind a proxy that ends TLS",
        ),
        OpenError::Tls(reason) => Problem::usage(
            format!("cannot use the certificate: {reason}"),
            "both files are PEM, and the key is that of the first certificate",
        ),
        OpenError::Address(error) => Problem::usage(
            format!("cannot listen on {}: {error}", args.listen),
            "name another port, such as --listen 127.0.0.1:8275, or 0 for any that is free",
        ),
        OpenError::Database(reason) => unusable(&reason),
        OpenError::Hooks(reason) => Problem::usage(
            format!("cannot tell hooks of events: {reason}"),
            "--hook-target https://erp.shop.example/ncc, --hook-ca FILE with PEM certificates",
        ),
    }
}

fn serve(args: &Serve) -> Result<(), Problem> {
    log(args);
    let hooks = Hooks { targets: args.hook_targets.clone(), authorities: args.hook_ca.clone() };
    let service = Service::open(listen(args), &part(args)?, &author(args.author.as_deref()))
        .and_then(|service| service.with_hooks(&hooks))
        .map_err(|error| refused(args, error))?;
    files::to_stdout(&mut |out| writeln!(out, "{}", service.address()))?;
    service.serve().map_err(|error| Problem::file("serve", &args.listen.to_string(), &error))
}
