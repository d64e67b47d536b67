//! Access: the user of a request, and the acts that are allowed to this user.
//!
//! Not here: which acts a role has ([`crate::rights`]).

use std::sync::Arc;

use axum::extract::FromRequestParts;
use axum::http::request::Parts;

use crate::Shared;
use crate::http::Problem;
use crate::rights::{Act, Who};

/// The user of a request. Each handler takes one, and passes it on to the store.
#[derive(Clone, Debug)]
pub(crate) struct Caller(Arc<Who>);

impl Caller {
    /// A user without a request, such as the author of a job.
    pub(crate) fn of(who: Who) -> Caller {
        Caller(Arc::new(who))
    }

    /// Author of the changes.
    pub(crate) fn name(&self) -> &str {
        &self.0.name
    }

    /// The user, for the store.
    pub(crate) fn who(&self) -> Arc<Who> {
        Arc::clone(&self.0)
    }

    /// The act is allowed in a folder; empty is the top. A folder that may not be read is as one that is not there.
    ///
    /// # Errors
    /// 404 where the user may not even read, 403 otherwise.
    pub(crate) fn may(&self, act: Act, folder: &str) -> Result<(), Problem> {
        if self.0.may(act, folder) {
            return Ok(());
        }
        Err(match self.0.may(Act::Read, folder) {
            true => Problem::forbidden("your rights do not include this"),
            false => Problem::absent("there is none"),
        })
    }
}

impl FromRequestParts<Arc<Shared>> for Caller {
    type Rejection = Problem;

    async fn from_request_parts(_: &mut Parts, shared: &Arc<Shared>) -> Result<Caller, Problem> {
        Ok(Caller(Arc::new(Who::local(&shared.author))))
    }
}
