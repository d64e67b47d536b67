//! The user of a request, a job or a command, with the rights that hold now.

use std::net::IpAddr;

use super::{Act, Right, Scope};

/// The way by which a user has come.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Via {
    /// This computer, where no account is there.
    Local,
    /// A login: the digest of its secret.
    Login(String),
    /// A token: its name in the database, and its scopes.
    Token(String, Vec<Scope>),
    /// A job of an account, or of the local user.
    Job,
    /// The command line.
    Command,
    /// The service itself.
    Service,
}

/// The user of a request, a job or a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Who {
    /// Author of the changes.
    pub(crate) name: String,
    /// Rights of the account; those of the local user, the command line and the service are all.
    pub(crate) rights: Vec<Right>,
    /// The way.
    pub(crate) via: Via,
    /// The client's address.
    pub(crate) address: Option<IpAddr>,
    /// The name of the request; empty without one.
    pub(crate) request: String,
}

impl Who {
    fn all(name: &str, via: Via) -> Who {
        Who { name: name.to_owned(), rights: vec![Right::all()], via, address: None, request: String::new() }
    }

    /// The one user of a service without accounts, who may do everything.
    pub(crate) fn local(name: &str) -> Who {
        Who::all(name, Via::Local)
    }

    /// The user of the command line.
    pub(crate) fn command(name: &str) -> Who {
        Who::all(name, Via::Command)
    }

    /// The service itself.
    pub(crate) fn service() -> Who {
        Who::all("", Via::Service)
    }

    /// An account.
    pub(crate) fn account(name: &str, rights: Vec<Right>, via: Via) -> Who {
        Who { rights, ..Who::all(name, via) }
    }

    /// Whether it is an account.
    pub(crate) fn is_account(&self) -> bool {
        matches!(self.via, Via::Login(_) | Via::Token(..))
    }

    /// Whether the token, if it is one, allows an act.
    pub(crate) fn scope_has(&self, act: Act) -> bool {
        match &self.via {
            Via::Token(_, scopes) => scopes.iter().any(|scope| scope.has(act)),
            _ => true,
        }
    }

    /// Whether an act is allowed in a folder; empty is the top, which has everything below it.
    pub(crate) fn may(&self, act: Act, folder: &str) -> bool {
        self.scope_has(act) && self.rights.iter().any(|own| own.role.has(act) && own.holds_in(folder))
    }

    /// Whether anything may be read.
    pub(crate) fn reads_anything(&self) -> bool {
        !self.rights.is_empty() && self.scope_has(Act::Read)
    }

    /// The way, for the audit.
    pub(crate) fn way(&self) -> String {
        match &self.via {
            Via::Local => "local".to_owned(),
            Via::Login(_) => "login".to_owned(),
            Via::Token(id, _) => format!("token {id}"),
            Via::Job => "job".to_owned(),
            Via::Command => "command".to_owned(),
            Via::Service => "service".to_owned(),
        }
    }
}
