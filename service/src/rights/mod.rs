//! Acts, and the user who asks for them.
//!
//! Not here: requests ([`crate::access`]), and the tables of users ([`crate::store`]).

/// An act on programs of a folder, or on the service.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Act {
    /// Reads programs, translations and jobs.
    Read,
    /// Changes programs, makes translations and jobs, puts drafts into review.
    Change,
    /// Approves a translation, or makes it a draft again.
    Review,
    /// Releases a translation, or makes it obsolete.
    Release,
    /// Changes machines and accounts, reads the audit.
    Administer,
}

/// The user of a request, or of a job.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Who {
    /// Author of the changes.
    pub(crate) name: String,
}

impl Who {
    /// The one user of a service without accounts, who may do everything.
    pub(crate) fn local(name: &str) -> Who {
        Who { name: name.to_owned() }
    }

    /// Whether an act is allowed in a folder; empty is the top, which has everything below it.
    pub(crate) fn may(&self, _act: Act, _folder: &str) -> bool {
        true
    }
}
