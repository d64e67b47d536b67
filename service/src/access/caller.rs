//! The user of a request, for its handler.

use std::sync::Arc;

use axum::extract::FromRequestParts;
use axum::http::HeaderValue;
use axum::http::request::Parts;

use crate::http::Problem;
use crate::rights::{Act, Via, Who};

/// The user of a request. Each handler takes one, and passes it on to the store.
#[derive(Clone, Debug)]
pub(crate) struct Caller {
    who: Arc<Who>,
    /// The token as it came, for another service that decides about it.
    bearer: Option<HeaderValue>,
}

impl Caller {
    /// A user without a request, such as the author of a job.
    pub(crate) fn of(who: Who) -> Caller {
        Caller { who: Arc::new(who), bearer: None }
    }

    /// The same with the token of the request.
    pub(crate) fn with_bearer(self, bearer: Option<HeaderValue>) -> Caller {
        Caller { bearer, ..self }
    }

    /// Author of the changes.
    pub(crate) fn name(&self) -> &str {
        &self.who.name
    }

    /// The user, for the store.
    pub(crate) fn who(&self) -> Arc<Who> {
        Arc::clone(&self.who)
    }

    /// The token as it came.
    pub(crate) fn bearer(&self) -> Option<HeaderValue> {
        self.bearer.clone()
    }

    /// The digest of the secret of its session.
    ///
    /// # Errors
    /// It has come by a token, or without an account.
    pub(crate) fn login(&self) -> Result<&str, Problem> {
        match &self.who.via {
            Via::Login(digest) => Ok(digest),
            Via::Token(..) => {
                Err(Problem::forbidden("a token cannot do this").help("log in with the password"))
            }
            _ => Err(Problem::conflict("there are no accounts")
                .help("`ncc serve user add NAME --role admin` makes one")),
        }
    }

    /// The act is allowed in a folder; empty is the top. A folder that may not be read is as one that is not there.
    ///
    /// # Errors
    /// 404 where the user may not even read, 403 otherwise.
    pub(crate) fn may(&self, act: Act, folder: &str) -> Result<(), Problem> {
        if self.who.may(act, folder) {
            return Ok(());
        }
        Err(match act == Act::Administer || self.who.may(Act::Read, folder) {
            true => forbidden(),
            false => Problem::absent("there is none"),
        })
    }

    /// The act is allowed in a folder that the user has named, whether it is there or not.
    ///
    /// # Errors
    /// 403.
    pub(crate) fn may_in(&self, act: Act, folder: &str) -> Result<(), Problem> {
        if self.who.may(act, folder) { Ok(()) } else { Err(forbidden()) }
    }

    /// The act is allowed in some folder.
    ///
    /// # Errors
    /// 403.
    pub(crate) fn may_somewhere(&self, act: Act) -> Result<(), Problem> {
        let is_allowed = self.who.rights.iter().any(|right| self.who.may(act, &right.folder));
        if is_allowed { Ok(()) } else { Err(forbidden()) }
    }
}

fn forbidden() -> Problem {
    Problem::forbidden("your rights do not include this")
}

impl<S: Send + Sync> FromRequestParts<S> for Caller {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Caller, Problem> {
        // Without one the guard has let nobody in.
        parts.extensions.get::<Caller>().cloned().ok_or_else(Problem::login_needed)
    }
}
